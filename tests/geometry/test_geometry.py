"""Section 4: forms, curvatures and directions against finite differences, sympy and closed forms; rulings, exactly."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
import sympy
from hypothesis import assume, given
from hypothesis import strategies as st

import strategies
from cfree.contact.contact import EdgeVertex, VertexEdge, angle_range, contacts
from cfree.contact.definitions import is_forbidden
from cfree.contact.surface import Surface, contact_surface, helix_through
from cfree.exact.pose import Pose
from cfree.forbidden.boundary import boundary
from cfree.formats.scene_file import load_scene
from cfree.geometry.local import LocalGeometry, local_geometry
from cfree.geometry.rulings import (
    distribution_parameters,
    is_developable,
    is_helicoid,
    is_minimal,
    striction_curve,
    striction_is_on_patch,
    striction_parameter,
    striction_parameters,
)
from cfree.polygons.polygon import Polygon
from shapes import Shape

TRIANGLE = Polygon([(-1, -1), (3, -1), (0, 2)])
SQUARE = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])  # two edges through the reference point
FAR = Polygon([(5, 1), (7, 2), (6, 4)])  # no foot of a perpendicular on an edge but one
PAIRS = [(A, O) for A in (TRIANGLE, SQUARE, FAR) for O in (TRIANGLE, SQUARE)]
points = st.tuples(strategies.fractions(), strategies.fractions())
scales = st.sampled_from([0.1, 1.0, 2.5, 40.0])


def random_ruled(rng: np.random.Generator, n: int) -> np.ndarray:
    """Rows of v-e and e-v surfaces by turns, some with the edge or the vertex at the reference point."""
    rows = rng.normal(size=(n, 8))
    rows[::2, 6:8] = rows[1::2, 2:4] = 0
    rows[3::8, 4:6] = rng.normal(size=(len(rows[3::8]), 1)) * rows[3::8, 6:8]
    rows[4::8, 4:6] = 0
    return rows


def position(rows: np.ndarray, t: np.ndarray, phi: np.ndarray, w: float) -> np.ndarray:
    """S(t, phi) in complex numbers, written independently."""
    p, q, a, g = (rows[..., k] + 1j * rows[..., k + 1] for k in (0, 2, 4, 6))
    x = p + t * q - np.exp(1j * phi) * (a + t * g)
    return np.stack(np.broadcast_arrays(x.real, x.imag, w * phi), axis=-1)


def derivatives(rows: np.ndarray, t: np.ndarray, phi: np.ndarray, w: float, d: float = 1e-4) -> list[np.ndarray]:
    def S(i: int, j: int) -> np.ndarray:
        return position(rows, t + i * d, phi + j * d, w)

    twice = (S(1, 1) - S(1, -1) - S(-1, 1) + S(-1, -1)) / 4
    return [
        (S(1, 0) - S(-1, 0)) / (2 * d),
        (S(0, 1) - S(0, -1)) / (2 * d),
        (S(1, 0) - 2 * S(0, 0) + S(-1, 0)) / d**2,
        twice / d**2,
        (S(0, 1) - 2 * S(0, 0) + S(0, -1)) / d**2,
    ]


def dot(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    return (u * v).sum(axis=-1)


@pytest.fixture(params=[0.3, 1.0, 4.0])
def sampled(request: pytest.FixtureRequest) -> tuple[LocalGeometry, np.ndarray, np.ndarray, np.ndarray, float]:
    rng = np.random.default_rng(7)
    rows, t, phi = random_ruled(rng, 400), rng.uniform(-1, 2, 400), rng.uniform(-7, 7, 400)
    return local_geometry(rows, t, phi, angle_scale=request.param), rows, t, phi, request.param


Sampled = tuple[LocalGeometry, np.ndarray, np.ndarray, np.ndarray, float]


# forms


def test_forms_are_those_of_finite_differences(sampled: Sampled) -> None:
    at, *where = sampled
    St, Sp, Stt, Stp, Spp = derivatives(*where)
    N = np.cross(St, Sp)
    n = N / np.linalg.norm(N, axis=-1, keepdims=True)
    for name, value in (("E", dot(St, St)), ("F", dot(St, Sp)), ("G", dot(Sp, Sp)), ("v", np.linalg.norm(N, axis=-1))):
        np.testing.assert_allclose(getattr(at, name), value, atol=1e-6, rtol=1e-6, err_msg=name)
    np.testing.assert_allclose(at.v**2, at.E * at.G - at.F**2, rtol=1e-9)
    for name, value in (("e", dot(Stt, n)), ("f", dot(Stp, n)), ("g", dot(Spp, n))):
        np.testing.assert_allclose(getattr(at, name), value, atol=1e-5, err_msg=name)
    np.testing.assert_allclose(at.normal, n, atol=1e-6)
    np.testing.assert_allclose(at.frame[:, 0], St / np.linalg.norm(St, axis=-1, keepdims=True), atol=1e-6)
    np.testing.assert_allclose(at.frame @ at.frame.swapaxes(1, 2), np.broadcast_to(np.eye(3), (400, 3, 3)), atol=1e-12)


def symbolic(kind: str) -> tuple[dict[str, sympy.Expr], dict[str, sympy.Symbol]]:
    """Forms times powers of v, by differentiation."""
    names = "t phi px py ex ey ax ay"
    t, phi, px, py, ex, ey, ax, ay = symbols = sympy.symbols(names, real=True)
    w = sympy.Symbol("w", positive=True)
    R = sympy.Matrix([[sympy.cos(phi), -sympy.sin(phi)], [sympy.sin(phi), sympy.cos(phi)]])
    p, edge, a = sympy.Matrix([px, py]), sympy.Matrix([ex, ey]), sympy.Matrix([ax, ay])
    x = p + t * edge - R * a if kind == "v-e" else p - R * (a + t * edge)
    S = sympy.Matrix([*x, w * phi])
    St, Sp = S.diff(t), S.diff(phi)
    N = St.cross(Sp)
    forms = {"E": St.dot(St), "F": St.dot(Sp), "G": Sp.dot(Sp), "v2": N.dot(N)}
    forms |= {"ev": S.diff(t, 2).dot(N), "fv": St.diff(phi).dot(N), "gv": S.diff(phi, 2).dot(N)}
    return forms, dict(zip([*names.split(), "w"], [*symbols, w], strict=True))


def is_zero(expression: sympy.Expr) -> bool:
    return bool(sympy.simplify(sympy.expand(expression)) == 0)


@pytest.mark.slow
def test_lemma_2_symbolically() -> None:
    forms, s = symbolic("e-v")
    E, F, v2, w = forms["E"], s["ax"] * s["ey"] - s["ay"] * s["ex"], forms["v2"], s["w"]
    assert is_zero(E - s["ex"] ** 2 - s["ey"] ** 2)
    assert is_zero(forms["F"] - F)
    along = s["ax"] * s["ex"] + s["ay"] * s["ey"] + s["t"] * E  # s L
    assert is_zero(v2 - (E * w**2 + along**2))
    assert is_zero(v2 - (E * forms["G"] - F**2))
    assert forms["ev"] == 0
    assert is_zero(forms["fv"] + w * E) and is_zero(forms["gv"] + w * F)
    # K = -f^2 / v^2 and H = (g E - 2 f F) / (2 v^2), with f and g as above
    assert is_zero(-(forms["fv"] ** 2) - -(w**2) * E**2)
    assert is_zero((forms["gv"] * E - 2 * forms["fv"] * F) - w * E * F)


@pytest.mark.slow
@given(points, points, st.floats(-2, 3), st.floats(-7, 7))
def test_lemma_2_and_the_forms_are_those_printed(
    a: tuple[Fraction, Fraction], b: tuple[Fraction, Fraction], t: float, phi: float
) -> None:
    """The paper's formulas in a_i and a_{i+1} alone; and no e-v surface is developable."""
    assume(a != b)
    g = b[0] - a[0], b[1] - a[1]
    zero = Fraction(0), Fraction(0)
    S = Surface(EdgeVertex(0, 0), zero, zero, a, g)
    (x0, y0), (x1, y1) = ((float(x), float(y)) for x, y in (a, b))
    E, F = (x0 - x1) ** 2 + (y0 - y1) ** 2, x0 * y1 - y0 * x1
    G = 1 + ((1 - t) * x0 + t * x1) ** 2 + ((1 - t) * y0 + t * y1) ** 2
    v = math.sqrt(E * G - F * F)
    at, near = local_geometry(S.ruled, t, phi), {"rel": 1e-6, "abs": 1e-12}  # E G - F^2 cancels
    printed = {"E": E, "F": F, "G": G, "e": 0, "f": -E / v, "g": -F / v, "v": v}
    for name, value in printed.items():
        assert float(getattr(at, name)) == pytest.approx(value, **near), name
    assert float(at.gaussian_curvature) == pytest.approx(-(E**2) / v**4, **near)
    assert float(at.mean_curvature) == pytest.approx(E * F / (2 * v**3), **near)
    assert at.gaussian_curvature < 0 and not is_developable(S)


@pytest.mark.parametrize(("A", "O"), PAIRS)
def test_v_e_surfaces_are_developable_and_e_v_surfaces_are_not(A: Polygon, O: Polygon) -> None:
    """Section 3.1 and the sentence after Lemma 2: developable is what has the curvature 0 everywhere."""
    for contact in contacts(A, O):
        S = contact_surface(A, O, contact)
        K = local_geometry(S.ruled, np.linspace(-1, 2, 7), np.linspace(0, 6, 9)[:, None]).gaussian_curvature
        assert is_developable(S) == (K == 0).all() == isinstance(contact, VertexEdge)
        assert isinstance(contact, VertexEdge) or (K < 0).all()


def test_the_distribution_parameter_is_that_of_its_definition() -> None:
    """det(c', r, r') / r'.r' of unit rulings r over the directrix c, for any edge: the length of a radian."""
    names = "phi px py ax ay length alpha w"
    phi, px, py, ax, ay, length, alpha, w = sympy.symbols(names, positive=True)
    R = sympy.Matrix([[sympy.cos(phi), -sympy.sin(phi)], [sympy.sin(phi), sympy.cos(phi)]])
    edge = length * sympy.Matrix([sympy.cos(alpha), sympy.sin(alpha)])
    c = sympy.Matrix([*(sympy.Matrix([px, py]) - R * sympy.Matrix([ax, ay])), w * phi])
    r = sympy.Matrix([*(-R * edge / length), 0])
    turned = r.diff(phi)
    assert is_zero(c.diff(phi).dot(r.cross(turned)) / turned.dot(turned) - w)
    rows = random_ruled(np.random.default_rng(5), 40)
    for scale in (0.3, 1.0, 4.0):
        found = distribution_parameters(rows, angle_scale=scale)
        is_edge = rows[:, 6:8].any(axis=1)
        assert (found[is_edge] == scale).all() and np.isnan(found[~is_edge]).all()
        # K = -w^2 / (w^2 + s^2)^2 at the distance s from the striction curve: its root is 1 / w there
        at = local_geometry(rows[is_edge], striction_parameters(rows[is_edge]), 0.2, angle_scale=scale)
        np.testing.assert_allclose(1 / np.sqrt(-at.gaussian_curvature), found[is_edge])


def test_v_e_surfaces_symbolically() -> None:
    forms, s = symbolic("v-e")
    c, n = sympy.cos(s["phi"]), sympy.sin(s["phi"])
    turned = c * s["ax"] - n * s["ay"], n * s["ax"] + c * s["ay"]
    F = s["ex"] * turned[1] - s["ey"] * turned[0]
    across = -(s["ex"] * turned[0] + s["ey"] * turned[1])
    assert is_zero(forms["F"] - F)
    assert is_zero(forms["v2"] - (forms["E"] * s["w"] ** 2 + across**2))
    assert forms["ev"] == 0 and is_zero(forms["fv"])
    assert is_zero(forms["gv"] + s["w"] * F)


@pytest.mark.parametrize("w", [0.5, 1.0, 3.0])
def test_closed_forms_in_the_distance_from_the_striction_curve(w: float) -> None:
    rng = np.random.default_rng(3)
    rows, t, phi = random_ruled(rng, 300), rng.uniform(-2, 3, 300), rng.uniform(0, 7, 300)
    at, is_edge = local_geometry(rows, t, phi, angle_scale=w), rows[:, 6:8].any(axis=1)
    u = rows[is_edge, 6:8] / np.linalg.norm(rows[is_edge, 6:8], axis=1, keepdims=True)
    s = dot(rows[is_edge, 4:6] + t[is_edge, None] * rows[is_edge, 6:8], u)
    h = abs(rows[is_edge, 4] * u[:, 1] - rows[is_edge, 5] * u[:, 0])
    np.testing.assert_allclose(at.gaussian_curvature[is_edge], -(w**2) / (w**2 + s**2) ** 2, rtol=1e-9)
    np.testing.assert_allclose(abs(at.mean_curvature[is_edge]), w * h / (2 * (w**2 + s**2) ** 1.5), atol=1e-12)
    assert (at.gaussian_curvature[~is_edge] == 0).all()
    assert not np.signbit(at.gaussian_curvature[~is_edge]).any()
    H = -w * at.E * at.F / (2 * at.v**3)
    np.testing.assert_allclose(at.mean_curvature[~is_edge], H[~is_edge], atol=1e-12)


def test_curvatures_keep_their_digits_far_from_the_reference_point() -> None:
    # E G - F^2 would lose all of them
    row = [0, 0, 0, 0, 0, 1e9, 1, 0]
    at = local_geometry(row, 0.5, 0.0)
    assert at.v == math.hypot(1, 0.5)
    assert at.gaussian_curvature == pytest.approx(-1 / 1.25**2, rel=1e-15)
    k1, k2 = at.principal_curvatures
    assert k1 * k2 == pytest.approx(float(at.gaussian_curvature), rel=1e-14)


@pytest.mark.parametrize(("A", "O"), PAIRS)
def test_the_normal_points_to_the_free_side(A: Polygon, O: Polygon) -> None:
    for contact in contacts(A, O):
        S, r = contact_surface(A, O, contact), angle_range(A, O, contact)
        for t, share in ((0.5, 0.5), (0.25, 0.75), (0.75, 0.125)):
            phi = r.phi_min + share * r.phi_range
            for w in (0.5, 1.0, 7.0):
                n = local_geometry(S.ruled, t, phi, angle_scale=w).normal
                q = S(t, phi)
                for side in (1, -1):
                    x, y, theta = q + side * 1e-6 * n / (1, 1, w)
                    assert is_forbidden(A, O, Pose(x, y, theta)) == (side < 0)


# curvatures and directions


def test_principal_curvatures_are_the_extremes_of_the_normal_curvature(sampled: Sampled) -> None:
    at, *_ = sampled
    k1, k2 = at.principal_curvatures.T
    xi1, xi2 = at.principal_directions.T
    np.testing.assert_allclose(at.normal_curvature(xi1), k1, atol=1e-11)
    np.testing.assert_allclose(at.normal_curvature(xi2), k2, atol=1e-11)
    every = np.stack([at.normal_curvature(np.full(len(k1), xi)) for xi in np.linspace(0, math.pi, 50)])
    assert (every >= k1 - 1e-11).all() and (every <= k2 + 1e-11).all()
    # Remark 6: from the forms alone
    K, H = at.gaussian_curvature, at.mean_curvature
    np.testing.assert_allclose(k1 * k2, K, atol=1e-11)
    np.testing.assert_allclose((k1 + k2) / 2, H, atol=1e-11)
    root = np.sqrt(H**2 - K)
    np.testing.assert_allclose(np.stack([H - root, H + root]), [k1, k2], atol=1e-7)


def test_normal_curvature_is_that_of_a_curve_on_the_surface(sampled: Sampled) -> None:
    at, rows, t, phi, w = sampled
    for xi in (0.4, 2.0, -1.0):
        tangent = at.tangent(np.full(len(t), xi))
        dphi = tangent[:, 2] / w
        dt = (dot(tangent, at.frame[:, 0]) - dphi * at.F / np.sqrt(at.E)) / np.sqrt(at.E)
        d = 1e-4
        second = sum(k * position(rows, t + i * d * dt, phi + i * d * dphi, w) for i, k in ((-1, 1), (0, -2), (1, 1)))
        np.testing.assert_allclose(dot(second / d**2, at.normal), at.normal_curvature(xi), atol=2e-5)
        first = (position(rows, t + d * dt, phi + d * dphi, w) - position(rows, t, phi, w)) / d
        np.testing.assert_allclose(first, tangent, atol=1e-2)


def test_eq_10_as_printed() -> None:
    rng = np.random.default_rng(11)
    rows, t = random_ruled(rng, 200)[1::2], rng.uniform(-1, 2, 100)
    at, xi = local_geometry(rows, t, 0.3), rng.uniform(0, 7, 100)
    printed = at.E * np.sin(xi) * (at.F * np.sin(xi) - 2 * at.v * np.cos(xi)) / at.v**3
    np.testing.assert_allclose(at.normal_curvature(xi), printed, atol=1e-12)
    np.testing.assert_allclose(at.gaussian_curvature, -(at.E**2) / at.v**4, rtol=1e-12)
    np.testing.assert_allclose(at.mean_curvature, at.E * at.F / (2 * at.v**3), atol=1e-12)
    positive = at.F > 0
    np.testing.assert_allclose(at.principal_directions[positive, 0], np.arctan(2 * at.v[positive] / at.F[positive]) / 2)


def test_asymptotic_directions_have_no_normal_curvature(sampled: Sampled) -> None:
    at, *_ = sampled
    for k in (0, 1):
        np.testing.assert_allclose(at.normal_curvature(at.asymptotic_directions[:, k]), 0, atol=1e-11)
    assert ((at.asymptotic_directions >= 0) & (at.asymptotic_directions <= math.pi)).all()
    # the ruling, and on e-v surfaces with w = 1 the printed arctan(2 v / F): another one
    ruling, other = at.asymptotic_directions.T
    is_edge, one = at.gaussian_curvature < 0, local_geometry(*sampled[1:4])
    assert (ruling == 0).all() and (np.sin(other[is_edge]) > 1e-3).all()
    has_F = is_edge & (np.abs(one.F) > 1e-9)
    np.testing.assert_allclose(np.tan(one.asymptotic_directions[has_F, 1]), 2 * one.v[has_F] / one.F[has_F], rtol=1e-6)


def test_where_F_is_0_directions_are_halves_of_right_angles() -> None:
    S = contact_surface(SQUARE, TRIANGLE, EdgeVertex(0, 1))
    at = local_geometry(S.ruled, np.linspace(-1, 2, 7), 0.0, angle_scale=3.0)
    assert (at.mean_curvature == 0).all()
    np.testing.assert_allclose(at.asymptotic_directions, np.tile([0, math.pi / 2], (7, 1)))
    np.testing.assert_allclose(at.principal_directions, np.tile([math.pi / 4, 3 * math.pi / 4], (7, 1)))
    np.testing.assert_allclose(-at.principal_curvatures[:, 0], at.principal_curvatures[:, 1])


def test_a_plane_has_no_curvature() -> None:
    at = local_geometry(contact_surface(SQUARE, TRIANGLE, VertexEdge(0, 0)).ruled, 0.5, 1.0)
    assert at.principal_curvatures.tolist() == [0, 0]
    assert at.normal_curvature(1.2) == 0


# many at once


def test_many_patches_and_many_points_at_once() -> None:
    result = boundary(load_scene("examples/scenes/five_convex.json"))
    ruled, t = result.ruled, np.linspace(0, 1, 5)
    table = local_geometry(ruled[:, None], t, result.phi_min[:, None], angle_scale=2.0)
    assert table.E.shape == (len(ruled), 5) and table.frame.shape == (len(ruled), 5, 3, 3)
    for k in range(0, len(ruled), 17):
        for m in (0, 3):
            one = local_geometry(ruled[k], t[m], result.phi_min[k], angle_scale=2.0)
            for name in ("E", "F", "G", "e", "f", "g", "v", "frame", "gaussian_curvature", "principal_curvatures"):
                np.testing.assert_allclose(getattr(one, name), getattr(table, name)[k, m], rtol=1e-12, atol=1e-15)
    assert local_geometry(ruled[:0], [], []).principal_curvatures.shape == (0, 2)


def test_curvatures_of_e_v_surfaces_do_not_feel_the_angle_at_all() -> None:
    S = contact_surface(TRIANGLE, SQUARE, EdgeVertex(1, 1))
    at = local_geometry(S.ruled, 0.3, np.linspace(0, 1e6, 100))
    assert len(set(at.mean_curvature.tolist())) == len(set(at.gaussian_curvature.tolist())) == 1


RULED = contact_surface(TRIANGLE, SQUARE, EdgeVertex(1, 1)).ruled


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"angle_scale": 0.0}, "angle_scale: 0.0; give a finite length"),
        ({"angle_scale": -1.0}, "angle_scale: -1.0"),
        ({"angle_scale": math.nan}, "angle_scale: nan"),
        ({"angle_scale": math.inf}, "angle_scale: inf"),
        ({"t": math.nan}, "t: nan is not finite"),
        ({"phi": [0.0, math.inf]}, "phi: inf is not finite"),
        ({"ruled": RULED[:7]}, r"ruled: shape \(7,\)"),
        ({"ruled": RULED * math.nan}, "ruled: nan is not finite"),
        ({"ruled": np.ones(8)}, "is no contact surface; one of q and g must be 0"),
        ({"ruled": np.zeros((2, 8))}, "is no contact surface"),
    ],
)
def test_bad_input_is_refused(change: dict[str, object], message: str) -> None:
    arguments = {"ruled": RULED, "t": 0.0, "phi": 0.0} | change
    with pytest.raises(ValueError, match=message):
        local_geometry(**arguments)
    with pytest.raises(ValueError, match="xi: nan"):
        local_geometry(RULED, 0, 0).normal_curvature(math.nan)


# rulings


def e_v_surfaces(A: Polygon, O: Polygon) -> list[Surface]:
    return [contact_surface(A, O, EdgeVertex(i, 0)) for i in range(len(A))]


@given(points, points, st.none() | strategies.fractions())
def test_lemma_3_both_ways(a: tuple[Fraction, Fraction], g: tuple[Fraction, Fraction], along: Fraction | None) -> None:
    assume(g != (0, 0))
    if along is not None:  # on a line through the reference point
        a = along * g[0], along * g[1]
    S = Surface(EdgeVertex(0, 0), (Fraction(0), Fraction(0)), (Fraction(0), Fraction(0)), a, g)
    H = local_geometry(S.ruled, np.linspace(-1, 2, 5), 0.0).mean_curvature
    on_line = a[0] * g[1] == a[1] * g[0]
    assert is_minimal(S) == is_helicoid(S) == on_line
    if on_line:
        np.testing.assert_allclose(H, 0, atol=1e-12)
    else:
        assert (H != 0).all()


def test_lemma_3_has_no_tolerance() -> None:
    third = Fraction(1, 3)
    zero = (Fraction(0), Fraction(0))
    on = Surface(EdgeVertex(0, 0), zero, zero, (third, 2 * third), (Fraction(1), Fraction(2)))
    off = Surface(EdgeVertex(0, 0), zero, zero, (third + Fraction(1, 10**60), 2 * third), (Fraction(1), Fraction(2)))
    assert is_minimal(on) and not is_minimal(off)


def test_a_helicoid_is_one() -> None:
    S = contact_surface(SQUARE, TRIANGLE, EdgeVertex(0, 1))
    assert is_helicoid(S)
    t, phi = np.linspace(0, 1, 5), np.linspace(0, 6, 9)[:, None]
    x, y, z = np.moveaxis(S(t, phi) - (*map(float, S.p), 0), -1, 0)
    np.testing.assert_allclose(x * np.sin(z) - y * np.cos(z), 0, atol=1e-12)  # on the ruling through its own axis


def test_v_e_surfaces_are_minimal_only_in_a_plane() -> None:
    assert [is_minimal(contact_surface(SQUARE, TRIANGLE, VertexEdge(i, 0))) for i in range(4)] == [True, *[False] * 3]
    assert not is_helicoid(contact_surface(SQUARE, TRIANGLE, VertexEdge(0, 0)))


@pytest.mark.parametrize(("A", "O"), PAIRS)
def test_the_striction_curve_is_where_rulings_come_closest(A: Polygon, O: Polygon) -> None:
    for S in e_v_surfaces(A, O):
        t, C = striction_parameter(S), striction_curve(S)
        assert t is not None and C is not None
        (ax, ay), (gx, gy) = C.fixed, S.g
        assert ax * gx + ay * gy == 0  # the foot of the perpendicular, exactly
        assert striction_is_on_patch(S) == (0 <= t <= 1)
        assert striction_parameters(S.ruled) == pytest.approx(float(t))
        # |K| and |H| are greatest there and even about it
        d = np.linspace(0.01, 3, 40)
        middle, before, after = (local_geometry(S.ruled, float(t) + k * d, 0.0) for k in (0, -1, 1))
        assert (abs(middle.gaussian_curvature) > abs(after.gaussian_curvature)).all()
        for name in ("gaussian_curvature", "mean_curvature"):
            np.testing.assert_allclose(getattr(before, name), getattr(after, name), rtol=1e-9, atol=1e-15)
        assert (abs(middle.mean_curvature) >= abs(after.mean_curvature)).all()
        # the nearest points of two neighbouring rulings, and their distance
        here, there = (position(S.ruled, np.array([0.0, 1.0]), phi, 2.0) for phi in (0.0, 1e-4))
        u, v = here[1] - here[0], there[1] - there[0]
        across = np.cross(u, v)
        nearest = np.cross(there[0] - here[0], v) @ across / (across @ across)
        assert nearest == pytest.approx(float(t), abs=1e-3)
        distance = (there[0] - here[0]) @ across / np.linalg.norm(across)
        turned = np.linalg.norm(across) / (np.linalg.norm(u) * np.linalg.norm(v))
        assert abs(distance / turned) == pytest.approx(float(distribution_parameters(S.ruled, angle_scale=2.0)))


def test_striction_curves_inside_outside_and_at_an_end() -> None:
    assert [striction_parameter(S) for S in e_v_surfaces(FAR, SQUARE)] == [
        Fraction(-11, 5),
        Fraction(3, 5),
        Fraction(9, 5),
    ]
    assert [striction_is_on_patch(S) for S in e_v_surfaces(FAR, SQUARE)] == [False, True, False]
    assert [striction_parameter(S) for S in e_v_surfaces(SQUARE, SQUARE)] == [0, 0, 1, 1]
    assert all(map(striction_is_on_patch, e_v_surfaces(SQUARE, SQUARE)))


def test_v_e_surfaces_have_no_striction_curve() -> None:
    S = contact_surface(TRIANGLE, SQUARE, VertexEdge(0, 0))
    assert is_developable(S) and striction_parameter(S) is striction_curve(S) is None
    assert not striction_is_on_patch(S)
    assert np.isnan(striction_parameters(S.ruled)) and np.isnan(distribution_parameters(S.ruled))


# helices


@given(strategies.poses(), points, points)
def test_remark_2_every_pose_is_on_a_helix_of_every_point(
    pose: tuple[Fraction, Fraction, Fraction | None], a: tuple[Fraction, Fraction], b: tuple[Fraction, Fraction]
) -> None:
    x, y, tau = pose
    theta = {"tau": "inf" if tau is None else tau}
    q = Pose(x, y, theta)
    helix, other = helix_through(q, a), helix_through(q, b)
    assert helix.pose(theta) == q and helix.fixed == a
    turned = Pose(0, 0, "90deg") @ q
    assert helix.pose({"tau": "inf" if turned.tau is None else turned.tau}).apply_exact([a]) == (helix.centre,)
    assert (helix == other) == (a == b)


@given(strategies.convex_polygons(), st.data())
def test_remark_5_helices_are_congruent_in_pairs_about_the_striction_curve(shape: Shape, data: st.DataObject) -> None:
    A = Polygon(*shape)
    S = contact_surface(A, SQUARE, EdgeVertex(data.draw(st.integers(0, len(A) - 1)), 0))
    t, other = data.draw(strategies.fractions()), data.draw(strategies.fractions())
    middle = striction_parameter(S)
    assert middle is not None

    def radius_squared(t: Fraction) -> Fraction:
        return sum((c * c for c in S.helix(t, beyond=True).fixed), Fraction(0))

    assert radius_squared(t) == radius_squared(2 * middle - t)
    assert (radius_squared(t) == radius_squared(other)) == (other in (t, 2 * middle - t))
