"""The rational model: contact holds with ==, ranges are exact, doubles agree with fractions."""

from __future__ import annotations

import math
import subprocess
import sys
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from cfree.contact.contact import (
    EdgeEdge,
    EdgeVertex,
    VertexEdge,
    VertexVertex,
    contact_curves,
    contacts,
    edge_edge_range,
)
from cfree.contact.definitions import contact_features, is_contact, is_forbidden
from cfree.contact.surface import edge_edge_surface
from cfree.errors import InvalidPoseError
from cfree.exact.half_angle import chart_intervals, half_tangent
from cfree.exact.orientation import Location
from cfree.exact.pose import Pose
from cfree.exact.surd import Surd
from cfree.polygons.polygon import Polygon
from cfree.rational.bezier import bezier_patches
from cfree.rational.model import (
    RationalSegment,
    rational_edge_edge_surface,
    rational_helix,
    rational_range,
    rational_segment,
    rational_surface,
    to_geometrical,
    to_rational,
)
from rational_pairs import (
    L_SHAPE,
    SQUARE,
    TRIANGLE,
    Vec,
    between,
    inner,
    of,
    pairs,
    placed,
    polygons,
    taus,
    ts,
)
from shapes import Shape

# exactly in contact


@pytest.mark.slow
@given(pairs, ts, taus, st.data())
def test_contacts_hold_with_equality(
    shapes: tuple[Shape, Shape], t: Fraction, tau: Fraction | None, data: st.DataObject
) -> None:
    A, O = polygons(shapes)
    a, b = A.exact_vertices, O.exact_vertices
    contact = data.draw(st.sampled_from(contacts(A, O)))
    i, j = contact.i, contact.j
    q = rational_surface(A, O, contact).point(t, tau)
    assert q[2] == tau
    if isinstance(contact, VertexEdge):  # a_i(q) lies on E_j
        assert placed(q, a[i]) == between(b[j], b[int(O.next[j])], t)
    else:  # E_i(q) goes through b_j
        assert between(placed(q, a[i]), placed(q, a[int(A.next[i])]), t) == b[j]


@pytest.mark.slow
@given(pairs, taus)
def test_a_vertex_stays_at_a_vertex_with_equality(shapes: tuple[Shape, Shape], tau: Fraction | None) -> None:
    A, O = polygons(shapes)
    for contact in contact_curves(A, O):
        if isinstance(contact, VertexVertex):
            q = rational_helix(A, O, contact).point(tau)
            assert placed(q, A.exact_vertices[contact.i]) == O.exact_vertices[contact.j]


@pytest.mark.slow
@settings(max_examples=50)
@given(pairs, inner)
def test_edges_lie_along_edges_with_equality_in_the_field_of_one_root(
    shapes: tuple[Shape, Shape], part: Fraction
) -> None:
    A, O = polygons(shapes)
    for contact in contact_curves(A, O):
        if not isinstance(contact, EdgeEdge):
            continue
        C = rational_segment(A, O, contact)
        low, high = (x.neighbours(20) for x in C.t_range)
        t = low[1] + part * (high[0] - low[1])
        n, (rx, ry, _) = C.angle.n, C.point(t)
        (bx, by), (ux, uy) = O.exact_vertices[contact.j], O.exact_edge(contact.j)

        def on_line(a: Vec, r: tuple[Surd, Surd] = (rx, ry), C: RationalSegment = C) -> tuple[Fraction, ...]:
            """Parts of a(q) beside sqrt(n) and without it: a(q) = r + (c a - s J a) / sqrt(n)."""
            c, s, n = C.angle.c, C.angle.s, C.angle.n
            if C.angle.cos.q == 0:  # n is a square
                k = math.isqrt(n)
                return r[0].p + (c * a[0] - s * a[1]) / k, r[1].p + (s * a[0] + c * a[1]) / k, Fraction(0), Fraction(0)
            return r[0].p, r[1].p, r[0].q + (c * a[0] - s * a[1]) / n, r[1].q + (s * a[0] + c * a[1]) / n

        x, y, x_root, y_root = on_line(A.exact_vertices[contact.i])
        assert (x, y, x_root, y_root) == (bx + t * ux, by + t * uy, 0, 0)
        x, y, x_root, y_root = on_line(A.exact_vertices[int(A.next[contact.i])])
        assert ux * (y - by) - uy * (x - bx) == 0 == ux * y_root - uy * x_root  # on the line of E_j
        assert n == C.angle.c**2 + C.angle.s**2


def test_known_points() -> None:
    S = rational_surface(TRIANGLE, SQUARE, VertexEdge(0, 2))
    assert S.point("1/2", 0) == (2, 3, 0)
    assert S.point("1/2", 1) == (0, 3, 1)  # a quarter turn
    assert S.point("1/2", None) == S.point("1/2", math.inf) == (0, 1, None)


@given(pairs, ts, taus, st.data())
def test_points_are_the_poses_of_the_geometrical_model(
    shapes: tuple[Shape, Shape], t: Fraction, tau: Fraction | None, data: st.DataObject
) -> None:
    A, O = polygons(shapes)
    S = rational_surface(A, O, data.draw(st.sampled_from(contacts(A, O))))
    x, y, _ = S.point(t, tau)
    assert S.surface.pose(t, {"tau": tau}) == Pose(x, y, {"tau": tau})


# remark 4


@given(pairs, st.data())
def test_remark_4_equation_7_is_solved_by_sums_of_products(shapes: tuple[Shape, Shape], data: st.DataObject) -> None:
    A, O = polygons(shapes)
    convex = [c for c in contacts(A, O) if isinstance(c, VertexEdge)]
    contact = data.draw(st.sampled_from(convex))
    phi = rational_range(A, O, contact).start
    (ux, uy), (vx, vy) = A.exact_edge(contact.i), O.exact_edge(contact.j)
    # M (x_0, y_0) = -|E_i| E_j / |E_j|, M = (E_i, J E_i): both sides times sqrt(n) are parallel, rational, as long
    left = ux * phi.c - uy * phi.s, uy * phi.c + ux * phi.s
    assert left[0] * vy - left[1] * vx == 0 and left[0] * vx + left[1] * vy < 0
    assert (left[0] ** 2 + left[1] ** 2) == (ux * ux + uy * uy) * phi.n


def test_remark_4_no_function_of_an_angle_is_called() -> None:
    program = """
import cmath, math, numpy
import cfree._core
from cfree.rational.bezier import bezier_patches
from cfree.contact.contact import EdgeEdge, EdgeVertex, VertexEdge, VertexVertex
from cfree.polygons.polygon import Polygon
from cfree.rational.model import rational_helix, rational_segment, rational_surface
A, O = Polygon([(0, 0), (2, 0), (1, 3)]), Polygon([(5, 0), (8, 1), (6, 4)])
def refused(*_, **__):
    raise AssertionError("a function of an angle")
for module in (math, cmath, numpy):
    for name in ("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "phase", "polar", "rect", "radians",
                 "arcsin", "arccos", "arctan", "arctan2", "degrees", "angle"):
        if hasattr(module, name):
            setattr(module, name, refused)
for contact in (VertexEdge(0, 1), EdgeVertex(1, 2)):
    S = rational_surface(A, O, contact)
    S.point("1/3", "2/7"), S.locate("1/3", None), S.Phi.domain, S(0.5, [0.1, numpy.inf])
    bezier_patches(S)[0]
C = rational_helix(A, O, VertexVertex(1, 1))
C.point("2/7"), C.locate("2/7"), C(0.5)
C = rational_segment(A, O, EdgeEdge(1, 1))
C.point("1/3"), C.locate("1/3"), C(0.5), C.t_range
"""
    subprocess.run([sys.executable, "-c", program], check=True)


# e-e


@pytest.mark.slow
@given(pairs)
def test_exact_limits_of_segments_are_those_in_doubles(shapes: tuple[Shape, Shape]) -> None:
    A, O = polygons(shapes)
    for contact in contact_curves(A, O):
        if isinstance(contact, EdgeEdge):
            C = rational_segment(A, O, contact)
            assert tuple(map(float, C.t_range)) == pytest.approx(edge_edge_range(A, O, contact), rel=1e-15)


@pytest.mark.parametrize("contact", [c for c in contact_curves(SQUARE, L_SHAPE) if isinstance(c, EdgeEdge)])
def test_segments_are_in_contact_from_end_to_end(contact: EdgeEdge) -> None:
    C = rational_segment(SQUARE, L_SHAPE, contact)
    for t in (Fraction(k, 8) for k in range(-4, 40)):
        assert C.angle.n == 1  # right angles: every t is a pose
        if C.locate(t) is Location.OUTSIDE:
            with pytest.raises(ValueError, match="give t in"):
                C.point(t)
        else:
            x, y, tau = C.point(t)
            assert is_contact(SQUARE, L_SHAPE, Pose(x.p, y.p, {"tau": None if tau is None else tau.p}))


def test_a_segment_ends_at_an_irrational_t() -> None:
    C = rational_segment(Polygon([(0, 0), (2, 0), (1, 1)]), SQUARE, EdgeEdge(1, 2))
    assert C.t_range == (Surd(0), Surd(1, "1/2", 2))
    assert C.locate(0) is Location.BOUNDARY
    assert C.locate("1.70710678118654752440") is Location.INSIDE
    assert C.locate("1.70710678118654752441") is Location.OUTSIDE
    root = math.sqrt(2)
    np.testing.assert_allclose(C([0, 1]), [[2 + root, 2 + root, -1 - root], [root, 2 + root, -1 - root]])


# doubles


@pytest.mark.slow
@given(pairs, ts, taus, st.data())
def test_doubles_agree_with_fractions(
    shapes: tuple[Shape, Shape], t: Fraction, tau: Fraction | None, data: st.DataObject
) -> None:
    A, O = polygons(shapes)
    number = math.inf if tau is None else float(tau)
    S = rational_surface(A, O, data.draw(st.sampled_from(contacts(A, O))))
    corners = [c for c in contact_curves(A, O) if isinstance(c, VertexVertex)]
    assume(corners)
    C = rational_helix(A, O, corners[0])
    for found, point in ((S(float(t), number), S.point(t, tau)), (C(number), C.point(tau))):
        assert found[:2] == pytest.approx([float(point[0]), float(point[1])], abs=1e-12)
        assert found[2] == number


def test_arrays_broadcast_and_tau_passes_through_infinity() -> None:
    S = rational_surface(TRIANGLE, SQUARE, EdgeVertex(1, 2))
    table = S(np.linspace(0, 1, 5), np.array([[-np.inf], [-1e300], [0], [1e300], [np.inf]]))
    assert table.shape == (5, 5, 3)
    for row in (1, 3, 4):
        np.testing.assert_allclose(table[row, :, :2], table[0, :, :2], atol=1e-12)
    np.testing.assert_allclose(S(0.3, 1e-200)[:2], S.surface(0.3, 0)[:2])
    assert S([], []).shape == (0, 3)


@given(pairs, st.floats(0, 1), st.floats(-1e6, 1e6), st.data())
def test_the_two_models_are_one_surface(shapes: tuple[Shape, Shape], t: float, tau: float, data: st.DataObject) -> None:
    A, O = polygons(shapes)
    S = rational_surface(A, O, data.draw(st.sampled_from(contacts(A, O))))
    x, y, theta = to_geometrical(S(t, tau))
    np.testing.assert_allclose(S.surface(t, theta), [x, y, theta], atol=1e-11)


# conversions


@given(st.lists(st.floats(-100, 100), min_size=1, max_size=20))
def test_angles_survive_there_and_back(angles: list[float]) -> None:
    points = np.column_stack((np.zeros((len(angles), 2)), angles))
    there_and_back = to_geometrical(to_rational(points))[:, 2]
    assert ((there_and_back >= 0) & (there_and_back < math.tau)).all()
    error = np.abs(np.mod(there_and_back - angles + math.pi, math.tau) - math.pi)
    assert (error <= 8 * np.spacing(np.maximum(np.abs(angles), math.tau))).all()


@given(st.floats(-1e12, 1e12).filter(lambda tau: abs(tau) > 1e-12))
def test_tangents_lose_digits_near_the_half_turn_as_stated(tau: float) -> None:
    back = to_rational(to_geometrical([0, 0, tau]))[2]
    sine = 2 * abs(tau) / (1 + tau * tau)
    assert abs(back - tau) <= abs(tau) * 2.0**-50 / sine * 4


def test_tangents_near_infinity() -> None:
    assert to_rational([0, 0, math.pi])[2] == math.inf == to_rational([0, 0, 3 * math.pi])[2]
    assert to_rational(to_geometrical([0, 0, 1e17]))[2] == math.inf
    assert to_geometrical([0, 0, -math.inf])[2] == math.pi == to_geometrical([0, 0, math.inf])[2]
    almost = to_rational([0, 0, math.nextafter(math.nextafter(math.pi, 0), 0)])[2]
    assert 1e15 < almost < 1e16


def test_conversions_keep_their_shape() -> None:
    points = np.arange(24.0).reshape(2, 4, 3)
    assert to_rational(points).shape == (2, 4, 3) == to_geometrical(points).shape
    np.testing.assert_array_equal(to_rational(points)[..., :2], points[..., :2])


@given(taus)
def test_exact_poses_hold_both_models(tau: Fraction | None) -> None:
    q, number = Pose(1, 2, {"tau": tau}), math.inf if tau is None else float(tau)
    assert q.tau == tau and q.theta_error == 0 and 0 <= q.theta < math.tau
    # eqs. (1) and (2): one pose, theta in [0, 2 pi) and tau = tan(theta / 2)
    assert (
        math.isclose(math.atan(number), math.remainder(q.theta / 2, math.pi), rel_tol=1e-13, abs_tol=1e-15)
        or abs(number) > 1e12
    )
    x, y, theta = to_geometrical([1, 2, number])
    assert (x, y) == (1, 2) and math.isclose(theta, q.theta, rel_tol=1e-15)
    if tau is None or abs(tau) < 1e6:  # near the half turn a little of theta is much of tau
        assert to_rational([1, 2, q.theta]) == pytest.approx([1, 2, number], rel=1e-13 * (1 + abs(tau or 0)))


@given(taus, taus)
def test_charts_tile_from_one_angle_to_another(start: Fraction | None, stop: Fraction | None) -> None:
    assume(start != stop)
    parts = chart_intervals(start, stop)
    angles = [chart * math.pi + 2 * math.atan(end) for chart, low, high in parts for end in (low, high)]
    for here, there in zip(angles[1::2], angles[2::2], strict=False):
        assert math.isclose(math.remainder(here - there, math.tau), 0, abs_tol=1e-12)
    for end, tau in ((angles[0], start), (angles[-1], stop)):
        expected = math.pi if tau is None else 2 * math.atan(tau)
        assert math.isclose(math.remainder(end - expected, math.tau), 0, abs_tol=1e-12)
    width = sum(b - a for a, b in zip(angles[::2], angles[1::2], strict=True))
    first, last = (math.pi if tau is None else 2 * math.atan(tau) for tau in (start, stop))
    assert math.isclose(math.remainder(width - (last - first), math.tau), 0, abs_tol=1e-9)
    assert all(low < high for _, low, high in parts)


# bad input


S = rational_surface(SQUARE, SQUARE, VertexEdge(0, 2))


@pytest.mark.parametrize("t", ["-1/1000000", "1.0000001", 2, -1])
def test_beyond_the_edge_is_no_contact(t: str | int) -> None:
    assert S.locate(t, 0) is Location.OUTSIDE
    with pytest.raises(ValueError, match=r"is not on the edge, and no contact of any sort; give t in \[0, 1\]"):
        S.point(t, 0)
    with pytest.raises(ValueError, match="is not on the edge"):
        S([0.5, float(Fraction(t))], 0)


def test_outside_phi_is_a_pseudo_contact() -> None:
    assert S.locate("1/2", -1) is Location.OUTSIDE
    assert S.point("1/2", -1) == (1, 2, -1)
    assert S.locate("1/2", "1/2") is Location.INSIDE
    assert S.locate(0, "1/2") is S.locate(1, "1/2") is S.locate("1/2", 0) is Location.BOUNDARY


@pytest.mark.parametrize("bad", [math.nan, "x", True, Decimal("nan"), [1], {"tau": 1}])
def test_what_is_no_number_is_refused(bad: object) -> None:
    for call in (lambda: S.point(bad, 0), lambda: S.point(0, bad), lambda: S.locate(0, bad), lambda: S.locate(bad, 0)):  # type: ignore[arg-type]
        with pytest.raises((TypeError, ValueError), match=r"give|write it like"):
            call()
    with pytest.raises(InvalidPoseError, match="tau: "):
        half_tangent(bad)  # type: ignore[arg-type]


def test_bad_arrays_are_refused() -> None:
    with pytest.raises(ValueError, match="not on the edge"):
        S(math.nan, 0)
    with pytest.raises(InvalidPoseError, match="inf for the half turn"):
        S(0.5, [0, math.nan])
    with pytest.raises(ValueError, match=r"shape \(2,\); give \(..., 3\)"):
        to_rational([1, 2])
    for bad in ([math.nan, 0, 0], [0, 0, math.inf], [0, math.inf, 0]):
        with pytest.raises(ValueError, match="not finite"):
            to_rational(bad)
    with pytest.raises(ValueError, match="not finite"):
        to_geometrical([math.inf, 0, 0])
    with pytest.raises(InvalidPoseError, match="nan is no number"):
        to_geometrical([0, 0, math.nan])


def test_reflex_vertices_have_no_patch() -> None:
    for contact, shape in ((VertexVertex(0, 3), SQUARE), (EdgeEdge(2, 3), L_SHAPE)):
        with pytest.raises(ValueError, match="never a contact"):
            of(shape, L_SHAPE, contact)
    for contact in (VertexEdge(3, 0), EdgeVertex(0, 3)):
        with pytest.raises(ValueError, match="never a contact"):
            rational_range(L_SHAPE, L_SHAPE, contact)
        with pytest.raises(ValueError, match="no patch"):
            bezier_patches(rational_surface(L_SHAPE, L_SHAPE, contact))


@settings(max_examples=20)
@given(pairs, st.data())
def test_both_segments_of_an_edge_edge_surface_place_edge_on_edge_exactly(
    shapes: tuple[Shape, Shape], data: st.DataObject
) -> None:
    A, O = polygons(shapes)
    i, j = data.draw(st.integers(0, len(A) - 1)), data.draw(st.integers(0, len(O) - 1))
    exact, rounded = (f(A, O, EdgeEdge(i, j)) for f in (rational_edge_edge_surface, edge_edge_surface))
    (against, alongside), L = exact, math.hypot(*A.edge(i)) / math.hypot(*O.edge(j))
    assert (against.angle.c, against.angle.s) == (-alongside.angle.c, -alongside.angle.s)
    (ux, uy), (vx, vy) = A.exact_edge(i), O.exact_edge(j)
    for C, other, sense in zip(exact, rounded, (-1, 1), strict=True):
        c, s = C.angle.c, C.angle.s
        along = (c * ux - s * uy, s * ux + c * uy)  # E_i, turned and scaled
        assert along[0] * vy == along[1] * vx and sense * (along[0] * vx + along[1] * vy) > 0
        assert tuple(map(float, C.t_range)) == pytest.approx(other.t_range)
        assert math.remainder(C.angle.theta - other.phi, math.tau) == pytest.approx(0, abs=1e-12)
        # at the ends one end of E_i is at one of E_j, and inside they overlap
        t = np.array([float(end) for end in C.t_range])
        assert sorted(t) == pytest.approx([0, 1 + L] if sense < 0 else [-L, 1])
        inside = Fraction(round(float(t.mean()) * 64), 64)
        assert C.locate(inside) is Location.INSIDE and C.locate(C.t_range[1].neighbours(9)[1] + 1) is Location.OUTSIDE


@pytest.mark.parametrize("contact", [VertexEdge(3, 0), EdgeVertex(0, 3)])
@settings(max_examples=20)
@given(ts, taus)
def test_at_a_reflex_vertex_there_are_pseudo_contacts_and_no_contact(
    contact: VertexEdge | EdgeVertex, t: Fraction, tau: Fraction | None
) -> None:
    S = rational_surface(L_SHAPE, L_SHAPE, contact)
    x, y, _ = S.point(t, tau)
    assert S.Phi is None and S.locate(t, tau) is Location.OUTSIDE
    assert (contact in contact_features(L_SHAPE, L_SHAPE, Pose(x, y, {"tau": tau}))) == (t not in (0, 1))
    assert is_forbidden(L_SHAPE, L_SHAPE, Pose(x, y, {"tau": tau})) or t in (0, 1)


def test_huge_coordinates_do_not_matter() -> None:
    big = Polygon([(x * 10**100, y * 10**100) for x, y in TRIANGLE.numerators])
    one, other = (rational_range(A, SQUARE, VertexEdge(0, 0)) for A in (TRIANGLE, big))
    assert one == other
    q = rational_surface(big, SQUARE, EdgeVertex(0, 0)).point("1/3", "1/7")
    p, r = (placed(q, big.exact_vertices[i]) for i in (0, 1))
    assert between(p, r, Fraction(1, 3)) == (0, 0)
