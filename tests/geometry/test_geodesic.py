"""Geodesics, Dupin's indicatrix, helices: against differences, plane sections, sympy and quadrature."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
import sympy

from cfree.contact import EdgeVertex, Helix, contact_surface, rotation_about
from cfree.geometry import develop, geodesic, local_geometry
from cfree.geometry.ruled import read_ruled
from cfree.polygons.polygon import Polygon

TRIANGLE = Polygon([(-1, -1), (3, -1), (0, 2)])
SQUARE = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
FAR = Polygon([(5, 1), (7, 2), (6, 4)])


def rows(rng: np.random.Generator, n: int, on_edge: bool) -> np.ndarray:
    made = rng.normal(size=(n, 8))
    made[:, 6 : 8 if on_edge else 6] = 0
    made[:, slice(6, 8) if on_edge else slice(2, 4)] = 0
    return made


def embedded(ruled: np.ndarray, t: np.ndarray, phi: np.ndarray, w: float) -> np.ndarray:
    p, q, a, g = (ruled[..., k : k + 2] for k in (0, 2, 4, 6))
    arm = a + t[..., None] * g
    c, s = np.cos(phi)[..., None], np.sin(phi)[..., None]
    turned = c * arm + s * np.stack([-arm[..., 1], arm[..., 0]], axis=-1)
    return np.concatenate([p + t[..., None] * q - turned, w * phi[..., None]], axis=-1)


# geodesics


@pytest.mark.slow
@pytest.mark.parametrize("on_edge", [True, False])
@pytest.mark.parametrize("w", [0.3, 2.0])
def test_geodesics_go_straight_at_unit_speed(on_edge: bool, w: float) -> None:
    rng = np.random.default_rng(3)
    ruled, d = rows(rng, 60, on_edge), 1e-3
    t, phi, xi = rng.uniform(-1, 2, 60), rng.uniform(-4, 4, 60), rng.uniform(-7, 7, 60)
    length = rng.uniform(-1.5, 1.5, 60)
    three = [geodesic(ruled, t, phi, xi, length + k * d, angle_scale=w) for k in (-1, 0, 1)]
    before, at, after = (embedded(ruled, x.t, x.phi, w) for x in three)
    frame = local_geometry(ruled, three[1].t, three[1].phi, angle_scale=w).frame
    bend, speed = (after - 2 * at + before) / d**2, (after - before) / (2 * d)
    np.testing.assert_allclose(np.linalg.norm(speed, axis=1), 1, atol=1e-4)
    steep = np.linalg.norm(bend, axis=1)
    for k in (0, 1):  # no acceleration within the tangent plane
        assert np.all(np.abs((bend * frame[:, k]).sum(axis=1)) < 1e-3 * (1 + steep**3))
        ahead = np.where(k, np.sin(three[1].xi), np.cos(three[1].xi))
        np.testing.assert_allclose((speed * frame[:, k]).sum(axis=1), ahead, atol=1e-4)


def test_on_v_e_surfaces_they_are_straight_in_the_development() -> None:
    rng = np.random.default_rng(5)
    ruled, t, phi, xi = rows(rng, 40, True), rng.uniform(0, 1, 40), rng.uniform(-3, 3, 40), rng.uniform(-4, 4, 40)
    length = rng.uniform(-30, 30, 40)  # over many turns
    ruled[0, 4:6] = 0
    found = geodesic(ruled, t, phi, xi, length, angle_scale=0.4)
    start, end = develop(ruled, t, phi, angle_scale=0.4), develop(ruled, found.t, found.phi, angle_scale=0.4)
    np.testing.assert_allclose(end - start, (length * [np.sin(xi), np.cos(xi)]).T, atol=1e-11)
    assert not found.error.any() and np.array_equal(found.xi, xi)


def test_clairauts_relation_holds_on_e_v_surfaces() -> None:
    rng = np.random.default_rng(6)
    ruled, w = rows(rng, 50, False), 0.7
    ruled[:5, 4:6] = ruled[:5, 6:8] * rng.normal(size=(5, 1))  # helicoids
    t, phi, xi = rng.uniform(-1, 1, 50), rng.uniform(-3, 3, 50), rng.uniform(-4, 4, 50)
    t[0] = -1 * (ruled[0, 4:6] @ ruled[0, 6:8]) / (ruled[0, 6:8] @ ruled[0, 6:8])  # on the axis
    found = geodesic(ruled, t, phi, xi, 3.0, angle_scale=w)
    assert 0 < found.error.max() <= 3e-10
    momentum = []
    for at, around, heading in ((t, phi, xi), (found.t, found.phi, found.xi)):
        s, k = read_ruled(ruled).across_and_along(at, around)
        momentum.append(np.hypot(w, s) * np.sin(heading) + k * np.cos(heading))
    np.testing.assert_allclose(momentum[0], momentum[1], atol=1e-9)


def test_errors_on_helicoids_are_no_larger_than_stated() -> None:
    # k = 0: with p = R sin(alpha) < w the geodesic never turns back, and length and angle are integrals over s
    w, p, end = 0.7, 0.5, 5.0
    length = mpmath.quad(lambda s: mpmath.sqrt((w**2 + s**2) / (w**2 + s**2 - p**2)), [0, 0.3, 1, end])
    angle = mpmath.quad(lambda s: p / mpmath.sqrt((w**2 + s**2) * (w**2 + s**2 - p**2)), [0, 0.3, 1, end])
    found = geodesic([0, 0, 0, 0, 0, 0, 2, 0], 0, 0.25, math.asin(p / w), float(length), angle_scale=w)
    off = math.hypot(2 * found.t - end, math.hypot(w, end) * (found.phi - 0.25 - float(angle)))
    assert off <= found.error + 1e-14 and found.error <= 1e-10 * float(length)


def test_geodesics_broadcast_and_refuse_nonsense() -> None:
    S = contact_surface(TRIANGLE, SQUARE, EdgeVertex(0, 0))
    found = geodesic(S.ruled, 0.5, [[0.1], [0.2]], 1.0, [0.0, 1.0, 2.0])
    assert found.t.shape == (2, 3) and found.t[0, 0] == 0.5 and found.phi[1, 0] == 0.2
    with pytest.raises(ValueError, match="xi: nan"):
        geodesic(S.ruled, 0, 0, math.nan, 1)
    assert geodesic(S.ruled, [], 0, 0, 1).t.shape == (0,)


# Dupin's indicatrix


@pytest.mark.parametrize("on_edge", [True, False])
def test_sections_a_little_above_the_tangent_plane_look_like_the_indicatrix(on_edge: bool) -> None:
    rng = np.random.default_rng(9)
    ruled, w, h = rows(rng, 40, on_edge), 1.4, 1e-6
    t, phi, xi = rng.uniform(0, 1, 40), rng.uniform(-3, 3, 40), rng.uniform(0, 6, 40)
    at = local_geometry(ruled, t, phi, angle_scale=w)
    radius = at.dupin_radius(xi)
    X, Y = radius * np.cos(xi), radius * np.sin(xi)
    A, B, C = np.moveaxis(at.dupin_conic, -1, 0)
    np.testing.assert_allclose(np.abs(A * X**2 + 2 * B * X * Y + C * Y**2), 1, rtol=1e-10)
    # from the point go sqrt(2 h) times the radius along the geodesic: there the surface is h above or below
    reach = np.where(radius < 30, math.sqrt(2 * h) * radius, 0)
    there = geodesic(ruled, t, phi, xi, reach, angle_scale=w)
    step = embedded(ruled, there.t, there.phi, w) - embedded(ruled, t, phi, w)
    height = (step * at.normal).sum(axis=1)
    (asked,) = np.nonzero(reach)
    assert len(asked) > 20
    np.testing.assert_allclose(height[asked], h * np.sign(at.normal_curvature(xi))[asked], rtol=0.2)


def test_there_is_no_indicatrix_in_asymptotic_directions() -> None:
    at = local_geometry(contact_surface(TRIANGLE, SQUARE, EdgeVertex(1, 0)).ruled, 0.3, 0.2)
    assert at.dupin_radius(0.0) == math.inf and at.dupin_radius(at.asymptotic_directions[1]) > 1e7
    flat = local_geometry([0, 0, 1, 0, 0, 0, 0, 0], 0.5, 0.0)
    assert flat.dupin_radius(1.0) == math.inf and not flat.dupin_conic.any()


# helices


def test_helices_bend_and_wind_as_frenet_says() -> None:
    phi, a, b, P, Q, w = sympy.symbols("phi a b P Q w", real=True)
    c, s = sympy.cos(phi), sympy.sin(phi)
    curve = sympy.Matrix([P - (c * a - s * b), Q - (s * a + c * b), w * phi])
    first, second, third = (curve.diff(phi, k) for k in (1, 2, 3))
    both = first.cross(second)
    curvature = sympy.sqrt(both.dot(both)) / first.dot(first) ** sympy.Rational(3, 2)
    torsion = both.dot(third) / both.dot(both)
    for helix, scale in ((rotation_about((1, 2), (3, -4)), 0.7), (rotation_about((0, 0), ("1/3", 2)), 5.0)):
        values = {a: helix.fixed[0], b: helix.fixed[1], P: helix.centre[0], Q: helix.centre[1], w: scale, phi: 0.4}
        assert helix.curvature(angle_scale=scale) == pytest.approx(float(curvature.subs(values)), rel=1e-13)
        assert helix.torsion(angle_scale=scale) == pytest.approx(float(torsion.subs(values)), rel=1e-13)
        points = helix(np.linspace(-1, 2, 10_001)) * (1, 1, scale)
        length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
        assert helix.length(-1, 2, angle_scale=scale) == pytest.approx(length, rel=1e-7)
    axis = Helix(*((rotation_about((1, 1), (0, 0))).centre, (0, 0)))
    assert (axis.curvature(), axis.torsion(angle_scale=2.0), axis.length(0, 3, angle_scale=2.0)) == (0, 0.5, 6)
    with pytest.raises(ValueError, match="angle_scale"):
        axis.curvature(angle_scale=0)
