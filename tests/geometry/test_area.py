"""Developments and areas, against isometry, quadrature, slices and python-flint's elliptic integrals."""

from __future__ import annotations

import math

import flint
import numpy as np
import pytest

from cfree.contact.contact import EdgeVertex, VertexEdge, angle_range, contacts
from cfree.contact.surface import contact_surface
from cfree.errors import IncompleteError
from cfree.forbidden.boundary import boundary
from cfree.formats.scene_file import load_scene
from cfree.geometry.development import develop
from cfree.geometry.elliptic import second_kind
from cfree.geometry.integrals import patch_areas, trapezoid_areas
from cfree.geometry.local import local_geometry
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene

TRIANGLE = Polygon([(-1, -1), (3, -1), (0, 2)])
SQUARE = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
FAR = Polygon([(5, 1), (7, 2), (6, 4)])
SCENES = ["five_convex", "degenerate_island", "degenerate_workspace", "benchmr_parking1"]


def v_e_rows(rng: np.random.Generator, n: int) -> np.ndarray:
    rows = rng.normal(size=(n, 8))
    rows[:, 6:8] = 0
    rows[:3, 4:6] = 0
    return rows


# the elliptic integral


def test_the_elliptic_integral_agrees_with_another_library() -> None:
    rng = np.random.default_rng(2)
    angles = [rng.uniform(-20, 20, 300), rng.uniform(-1, 1, 100) * 10 ** rng.uniform(-9, 0, 100)]
    psi = np.concatenate([*angles, np.arange(-6, 7) * math.pi / 2])
    n = np.where(rng.uniform(size=len(psi)) < 0.2, 0, 10 ** rng.uniform(-12, 12, len(psi)))
    exact = [flint.acb.elliptic_e_inc(flint.acb(p), flint.acb(-m)).real for p, m in zip(psi, n, strict=True)]
    np.testing.assert_allclose(second_kind(psi, n), [float(value) for value in exact], rtol=1e-14)
    assert second_kind(np.empty(0), np.empty(0)).shape == (0,)


# development


@pytest.mark.parametrize("w", [0.2, 1.0, 5.0])
def test_developments_are_isometries(w: float) -> None:
    rng = np.random.default_rng(4)
    rows, t, phi, d = v_e_rows(rng, 200), rng.uniform(-1, 2, 200), rng.uniform(-9, 9, 200), 1e-5
    at = local_geometry(rows, t, phi, angle_scale=w)

    def moved(i: int, j: int) -> np.ndarray:
        return develop(rows, t + i * d, phi + j * d, angle_scale=w)

    by_t, by_phi = (moved(1, 0) - moved(-1, 0)) / (2 * d), (moved(0, 1) - moved(0, -1)) / (2 * d)
    np.testing.assert_allclose((by_t**2).sum(axis=1), at.E, atol=1e-7)
    np.testing.assert_allclose((by_t * by_phi).sum(axis=1), at.F, atol=1e-7)
    np.testing.assert_allclose((by_phi**2).sum(axis=1), at.G, rtol=1e-6)
    np.testing.assert_allclose(by_phi[:, 0] * by_t[:, 1] - by_phi[:, 1] * by_t[:, 0], at.v, rtol=1e-6)


def test_helices_and_rulings_keep_their_lengths() -> None:
    S, r, w = contact_surface(TRIANGLE, SQUARE, VertexEdge(1, 2)), angle_range(TRIANGLE, SQUARE, VertexEdge(1, 2)), 0.7
    phi = r.phi_min + np.linspace(0, r.phi_range, 20_001)
    for t in (0.0, 0.4, 1.0):
        curve = develop(S.ruled, t, phi, angle_scale=w)
        length = np.hypot(*np.diff(curve, axis=0).T).sum()
        assert length == pytest.approx(r.phi_range * math.hypot(w, math.hypot(*map(float, S.a))), rel=1e-8)
    ends = develop(S.ruled, [[0], [1]], phi[:3], angle_scale=w)
    np.testing.assert_allclose(ends[1] - ends[0], np.tile([0, 2], (3, 1)), atol=1e-12)


def test_developments_broadcast() -> None:
    rows = v_e_rows(np.random.default_rng(5), 4)
    table = develop(rows[:, None], [0, 1, 2], 0.5)
    assert table.shape == (4, 3, 2)
    np.testing.assert_array_equal(table[3, 2], develop(rows[3], 2, 0.5))


def test_e_v_surfaces_are_not_developable() -> None:
    with pytest.raises(ValueError, match="e-v contact is not developable; give those of v-e"):
        develop(contact_surface(TRIANGLE, SQUARE, EdgeVertex(0, 0)).ruled, 0, 0)
    for arguments, message in (
        ((math.nan, 0, 1.0), "t: nan"),
        ((0, math.inf, 1.0), "phi: inf"),
        ((0, 0, -1.0), "scale"),
    ):
        t, phi, w = arguments
        with pytest.raises(ValueError, match=message):
            develop(v_e_rows(np.random.default_rng(6), 1), t, phi, angle_scale=w)


# areas of patches


@pytest.mark.slow
@pytest.mark.parametrize("w", [0.3, 1.0, 6.0])
@pytest.mark.parametrize(("A", "O"), [(TRIANGLE, SQUARE), (SQUARE, TRIANGLE), (FAR, SQUARE)])
def test_areas_of_patches_are_integrals_of_the_area_element(A: Polygon, O: Polygon, w: float) -> None:
    nodes, weights = np.polynomial.legendre.leggauss(20)
    x = ((nodes + 1) / 2 + np.arange(16)[:, None]).ravel() / 16
    weight = np.tile(weights / 32, 16)
    found = contacts(A, O)
    rows = np.array([contact_surface(A, O, contact).ruled for contact in found])
    ranges = [angle_range(A, O, contact) for contact in found]
    start, width = np.array([(r.phi_min, r.phi_range) for r in ranges]).T
    phi = start[:, None, None] + width[:, None, None] * x
    v = local_geometry(rows[:, None, None], x[:, None], phi, angle_scale=w).v
    expected = width * np.einsum("nij,i,j->n", v, weight, weight)
    np.testing.assert_allclose(patch_areas(rows, start, width, angle_scale=w), expected, rtol=1e-10)


def test_the_closed_form_of_an_e_v_patch_for_w_1() -> None:
    S, r = contact_surface(FAR, SQUARE, EdgeVertex(0, 0)), angle_range(FAR, SQUARE, EdgeVertex(0, 0))
    s = np.array([11, 16]) / math.sqrt(5)  # a.g / |g| at both ends
    before, after = (s * np.sqrt(1 + s * s) + np.arcsinh(s)) / 2
    assert float(patch_areas(S.ruled, r.phi_min, r.phi_range)) == pytest.approx(r.phi_range * (after - before))


def test_areas_of_v_e_patches_are_those_of_their_developments() -> None:
    S, r = contact_surface(TRIANGLE, SQUARE, VertexEdge(2, 1)), angle_range(TRIANGLE, SQUARE, VertexEdge(2, 1))
    phi = r.phi_min + np.linspace(0, r.phi_range, 4001)
    rim = np.concatenate([develop(S.ruled, 0, phi), develop(S.ruled, 1, phi[::-1])])
    x, y = rim.T
    shoelace = abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
    assert float(patch_areas(S.ruled, r.phi_min, r.phi_range)) == pytest.approx(shoelace, rel=1e-6)


def test_bad_ranges_are_refused() -> None:
    row = v_e_rows(np.random.default_rng(8), 5)
    with pytest.raises(ValueError, match=r"phi_range: -0\.5 is negative; give the width"):
        patch_areas(row, 0, [0, 1, -0.5, 2, 0])
    with pytest.raises(ValueError, match="phi_min: nan"):
        patch_areas(row, math.nan, 0)


# areas of trapezoids


@pytest.mark.parametrize("w", [0.01, 0.4, 1.0, 8.0])
def test_trapezoids_of_one_convex_pair_add_up_to_the_patches(w: float) -> None:
    for robot, obstacle in ((TRIANGLE, SQUARE), (FAR, TRIANGLE)):
        result = boundary(Scene(robot=robot, obstacles=obstacle))
        whole = patch_areas(result.ruled, result.phi_min, result.phi_range, angle_scale=w)
        parts = np.bincount(result.trapezoids.patch, trapezoid_areas(result, angle_scale=w), len(whole))
        np.testing.assert_allclose(parts, whole, rtol=1e-10)


@pytest.mark.parametrize("name", SCENES)
def test_for_a_long_radian_areas_are_lengths_of_slices(name: str) -> None:
    result = boundary(load_scene(f"examples/scenes/{name}.json"))
    w, count = 1e6, 400
    lengths = []
    for theta in (np.arange(count) + 0.5) * math.tau / count:
        ends = result.slice(float(theta)).segments
        lengths.append(np.hypot(*(ends[:, 1] - ends[:, 0]).T).sum())
    assert trapezoid_areas(result, angle_scale=w).sum() / w == pytest.approx(np.mean(lengths) * math.tau, rel=3e-3)


def test_limits_and_empty_boundaries() -> None:
    assert trapezoid_areas(boundary(Scene(robot=TRIANGLE))).shape == (0,)
    with pytest.raises(ValueError, match="angle_scale"):
        trapezoid_areas(boundary(Scene(robot=TRIANGLE)), angle_scale=0)
    stopped = boundary(load_scene("examples/scenes/benchmr_parking1.json"), max_seconds=0)
    if not stopped.complete:
        with pytest.raises(IncompleteError):
            trapezoid_areas(stopped)
