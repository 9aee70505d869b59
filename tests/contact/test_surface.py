from __future__ import annotations

import cmath
import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import strategies
from cfree.contact.contact import EdgeEdge, EdgeVertex, VertexEdge, VertexVertex, angle_range, contact_curves, contacts
from cfree.contact.definitions import contact_features, is_contact, is_forbidden, is_pseudo_contact
from cfree.contact.surface import (
    contact_helix,
    contact_segment,
    contact_surface,
    edge_edge_surface,
    rotation_about,
    rotation_of_combination,
)
from cfree.exact.half_angle import Angle
from cfree.exact.pose import Pose
from cfree.polygons.polygon import Polygon
from shapes import Shape

SQUARE = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
L_SHAPE = Polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])
TRIANGLE = Polygon([(-1, -1), (3, -1), (0, 2)])
numbers = strategies.fractions()
points = st.tuples(numbers, numbers)
angles = strategies.half_tangents().map(lambda tau: {"tau": "inf" if tau is None else tau})
inner = st.fractions(Fraction(1, 9), Fraction(8, 9), max_denominator=9)
pairs = st.tuples(strategies.polygons(), strategies.polygons())


def polygons(shapes: tuple[Shape, Shape]) -> tuple[Polygon, Polygon]:
    return Polygon(*shapes[0]), Polygon(*shapes[1])


def pseudo_contacts(A: Polygon, O: Polygon) -> list[VertexEdge | EdgeVertex]:
    """All v-e and e-v pairs, at reflex vertices too."""
    return [kind(i, j) for kind in (VertexEdge, EdgeVertex) for i in range(len(A)) for j in range(len(O))]


# examples


def test_a_corner_slides_along_an_edge_while_the_robot_turns() -> None:
    S = contact_surface(TRIANGLE, SQUARE, VertexEdge(0, 2))
    np.testing.assert_allclose(S(0.5, 0), [2, 3, 0])
    np.testing.assert_allclose(S(0.5, math.pi / 2), [0, 3, math.pi / 2], atol=1e-15)
    assert S.pose("1/2", "90deg") == Pose(0, 3, "90deg")


def test_an_edge_slides_along_a_corner() -> None:
    S = contact_surface(TRIANGLE, SQUARE, EdgeVertex(0, 2))
    np.testing.assert_allclose(S([0, 0.25, 1], 0), [[3, 3, 0], [2, 3, 0], [-1, 3, 0]])


# eqs. (5) and (8), with complex numbers for vectors


@given(pairs, st.floats(0, 1), st.floats(-7, 7), st.data())
def test_eq_5_holds_at_every_angle(shapes: tuple[Shape, Shape], t: float, phi: float, data: st.DataObject) -> None:
    A, O = polygons(shapes)
    i, j = data.draw(st.integers(0, len(A) - 1)), data.draw(st.integers(0, len(O) - 1))
    S, (a, b) = contact_surface(A, O, VertexEdge(i, j)), (A.vertices @ (1, 1j), O.vertices @ (1, 1j))
    P = (1 - t) * b[j] + t * b[O.next[j]]
    x, y, theta = S(t, phi)
    assert abs(complex(x, y) - (P - cmath.exp(1j * phi) * a[i])) < 1e-12 and theta == phi
    assert np.abs(S.grid([t], [phi])[0, 0] - (x, y)).max() < 1e-12
    # the same as c(phi) + t r(phi), and r does not turn: cylindrical
    start, ruling = S(0, phi), S(1, phi) - S(0, phi)
    assert S(t, phi) == pytest.approx(start + t * ruling, abs=1e-12)
    assert ruling == pytest.approx([*O.edge(j), 0], abs=1e-12)


@given(pairs, st.floats(0, 1), st.floats(-7, 7), st.data())
def test_eq_8_holds_at_every_angle(shapes: tuple[Shape, Shape], t: float, phi: float, data: st.DataObject) -> None:
    A, O = polygons(shapes)
    i, j = data.draw(st.integers(0, len(A) - 1)), data.draw(st.integers(0, len(O) - 1))
    S, (a, b) = contact_surface(A, O, EdgeVertex(i, j)), (A.vertices @ (1, 1j), O.vertices @ (1, 1j))
    a_it = (1 - t) * a[i] + t * a[A.next[i]]
    x, y, theta = S(t, phi)
    assert abs(complex(x, y) - (b[j] - cmath.exp(1j * phi) * a_it)) < 1e-12 and theta == phi
    assert np.abs(S.grid([t], [phi])[0, 0] - (x, y)).max() < 1e-12
    # a horizontal segment that is translated and turned
    start, ruling = S(0, phi), S(1, phi) - S(0, phi)
    assert S(t, phi) == pytest.approx(start + t * ruling, abs=1e-12)
    assert abs(complex(*ruling[:2]) + cmath.exp(1j * phi) * complex(*A.edge(i))) < 1e-12 and ruling[2] == 0


# section 2


@given(points, points, angles)
def test_lemma_1_a_point_stays_where_it_is_fixed(
    P: tuple[Fraction, Fraction], a: tuple[Fraction, Fraction], theta: Angle
) -> None:
    C = rotation_about(P, a)
    q = C.pose(theta)
    assert q.apply_exact([a]) == (P,)
    np.testing.assert_allclose(C(q.theta), [float(q.x), float(q.y), q.theta], atol=1e-13)
    # eq. (4): a helix of the radius |a| about P, or the vertical line over P
    assert math.dist(C(q.theta)[:2], [float(c) for c in P]) == pytest.approx(math.hypot(*map(float, a)), abs=1e-12)


@given(strategies.poses(), points)
def test_lemma_1_every_pose_that_fixes_a_point_is_on_its_helix(
    pose: tuple[Fraction, Fraction, Fraction | None], a: tuple[Fraction, Fraction]
) -> None:
    x, y, tau = pose
    theta: Angle = {"tau": "inf" if tau is None else tau}
    q = Pose(x, y, theta)
    (P,) = q.apply_exact([a])
    assert rotation_about(P, a).pose(theta) == q


@pytest.mark.slow
@given(points, st.lists(st.tuples(numbers, points), min_size=1, max_size=5), angles)
def test_remark_2_a_combination_of_vertices_stays_where_it_is_fixed(
    P: tuple[Fraction, Fraction], terms: list[tuple[Fraction, tuple[Fraction, Fraction]]], theta: Angle
) -> None:
    weights, vertices = zip(*terms, strict=True)
    if sum(weights) == 0:
        with pytest.raises(ValueError, match="weights add up to 0"):
            rotation_of_combination(P, vertices, weights)
        return
    moved = rotation_of_combination(P, vertices, weights).pose(theta).apply_exact(vertices)
    assert tuple(sum(w * v[k] for w, v in zip(weights, moved, strict=True)) for k in (0, 1)) == P


def test_remark_2_weights_that_add_up_to_zero_leave_the_position_free() -> None:
    # sum lambda_k a_k(q) = R a whatever r is: erratum of the remark
    a, b = (0, 0), (1, 0)
    for r in (0, 5):
        (ax, ay), (bx, by) = Pose(r, r, "90deg").apply_exact([a, b])
        assert (bx - ax, by - ay) == (0, 1)
    with pytest.raises(ValueError, match="give weights with another sum"):
        rotation_of_combination((0, 1), [b, a], [1, -1])


# section 3


@given(pairs, angles, inner, st.data())
def test_points_of_a_surface_are_pseudo_contacts_exactly(
    shapes: tuple[Shape, Shape], theta: Angle, t: Fraction, data: st.DataObject
) -> None:
    A, O = polygons(shapes)
    contact = data.draw(st.sampled_from(pseudo_contacts(A, O)))
    S = contact_surface(A, O, contact)
    q = S.pose(t, theta)
    assert contact in contact_features(A, O, q)
    np.testing.assert_allclose(S(float(t), q.theta), [float(q.x), float(q.y), q.theta], atol=1e-12)


@given(pairs, angles, st.data())
def test_ends_of_rulings_lie_on_helices(shapes: tuple[Shape, Shape], theta: Angle, data: st.DataObject) -> None:
    A, O = polygons(shapes)
    i, j = data.draw(st.integers(0, len(A) - 1)), data.draw(st.integers(0, len(O) - 1))
    here = contact_helix(A, O, VertexVertex(i, j))
    slid = contact_surface(A, O, VertexEdge(i, j)), contact_helix(A, O, VertexVertex(i, int(O.next[j])))
    passed = contact_surface(A, O, EdgeVertex(i, j)), contact_helix(A, O, VertexVertex(int(A.next[i]), j))
    for S, there in (slid, passed):
        assert S.pose(0, theta) == here.pose(theta)
        assert S.pose(1, theta) == there.pose(theta)


@pytest.mark.slow
@given(pairs, st.tuples(inner, inner))
def test_remark_3_helices_of_one_vertex_are_congruent(
    shapes: tuple[Shape, Shape], t: tuple[Fraction, Fraction]
) -> None:
    A, O = polygons(shapes)
    for i in range(len(A)):
        fixed = {contact_surface(A, O, VertexEdge(i, j)).helix(s).fixed for j in range(len(O)) for s in t}
        assert len(fixed) == 1  # they differ by a translation of the centre only


@given(pairs, angles, inner, st.data())
def test_remark_3_and_5_helices_of_a_surface(
    shapes: tuple[Shape, Shape], theta: Angle, t: Fraction, data: st.DataObject
) -> None:
    """All on a v-e surface keep one point of the robot, and so one radius; on an e-v surface each its own."""
    A, O = polygons(shapes)
    i, j = data.draw(st.integers(0, len(A) - 1)), data.draw(st.integers(0, len(O) - 1))
    v_e, e_v = contact_surface(A, O, VertexEdge(i, j)), contact_surface(A, O, EdgeVertex(i, j))
    assert v_e.helix(t).fixed == A.exact_vertices[i] and e_v.helix(t).centre == O.exact_vertices[j]
    for S in (v_e, e_v):
        assert S.helix(t).pose(theta) == S.pose(t, theta)
    (px, py), (qx, qy) = v_e.helix(0).centre, v_e.helix(t).centre
    assert (qx - px, qy - py) == tuple(t * c for c in O.exact_edge(j))
    assert e_v.helix(t).fixed == tuple(a + t * g for a, g in zip(A.exact_vertices[i], A.exact_edge(i), strict=True))


def test_remark_5_helices_of_an_edge_vertex_surface_are_not_congruent() -> None:
    S = contact_surface(TRIANGLE, SQUARE, EdgeVertex(0, 0))
    radii = {sum(c * c for c in S.helix(Fraction(k, 4)).fixed) for k in range(5)}
    assert len(radii) > 2


def test_remark_3_regular_polygons_need_their_reference_point_in_the_middle() -> None:
    # erratum: with the reference point elsewhere, helices of different vertices have different radii
    def radii(robot: Polygon) -> set[Fraction]:
        return {sum(c * c for c in contact_surface(robot, SQUARE, VertexEdge(i, 0)).helix(0).fixed) for i in range(4)}

    assert len(radii(Polygon([(-1, -1), (1, -1), (1, 1), (-1, 1)]))) == 1
    assert len(radii(SQUARE)) == 3


@settings(max_examples=60)
@given(strategies.convex_polygons(), strategies.convex_polygons(), inner, inner, st.data())
def test_a_contact_surface_lies_in_the_closure_of_the_forbidden_space(
    one: Shape, other: Shape, t: Fraction, share: Fraction, data: st.DataObject
) -> None:
    """Definition 1 and its erratum: pseudo contacts that are no contacts are forbidden, and contacts nearly."""
    A, O = Polygon(*one), Polygon(*other)
    contact = data.draw(st.sampled_from(contacts(A, O)))
    S, Phi = contact_surface(A, O, contact), angle_range(A, O, contact)
    inside, beyond = (Pose(0, 0, Phi.phi_min + k * Phi.phi_range) for k in (share, 1 + share * math.pi / Phi.phi_range))
    for turned, touching in ((inside, True), (beyond, False), (inside @ Pose(0, 0, "180deg"), False)):
        theta: Angle = {"tau": turned.tau}
        q = S.pose(t, theta)
        assert contact in contact_features(A, O, q) and is_pseudo_contact(A, O, q)
        assert is_contact(A, O, q) == touching and is_forbidden(A, O, q) == (not touching)
        if touching:  # free, but a push across the edge, however small, is not
            ends = (A.exact_edge(contact.i), O.exact_edge(contact.j))
            (ux, uy), (vx, vy) = Pose(0, 0, theta).apply_exact([ends[0]])[0], ends[1]
            push = (-vy, vx) if isinstance(contact, VertexEdge) else (uy, -ux)
            tiny = Fraction(1, 10**40)
            assert is_forbidden(A, O, Pose(q.x + push[0] * tiny, q.y + push[1] * tiny, theta))
            assert not is_forbidden(A, O, Pose(q.x - push[0] * tiny, q.y - push[1] * tiny, theta))


@given(pairs, strategies.poses(), st.data())
def test_every_pose_with_a_pseudo_contact_is_on_its_contact_surface(
    shapes: tuple[Shape, Shape], at: tuple[Fraction, Fraction, Fraction | None], data: st.DataObject
) -> None:
    """Definition 1, the other way: the obstacle is put so that a vertex is on an edge at a given pose."""
    A, O = polygons(shapes)
    assume(len(O.ring_offsets) == 2)
    x, y, tau = at
    theta: Angle = {"tau": "inf" if tau is None else tau}
    q, contact, t = Pose(x, y, theta), data.draw(st.sampled_from(pseudo_contacts(A, O))), data.draw(inner)
    (bx, by), (vx, vy) = O.exact_vertices[contact.j], O.exact_edge(contact.j)
    (ax, ay), (ux, uy) = A.exact_vertices[contact.i], A.exact_edge(contact.i)
    if isinstance(contact, VertexEdge):
        here, ((mx, my),) = (bx + t * vx, by + t * vy), q.apply_exact([(ax, ay)])
    else:
        here, ((mx, my),) = (bx, by), q.apply_exact([(ax + t * ux, ay + t * uy)])
    moved = Polygon(Pose(mx - here[0], my - here[1]).apply_exact(O.exact_vertices))
    assert contact in contact_features(A, moved, q)
    assert contact_surface(A, moved, contact).pose(t, theta) == q


def test_contact_surfaces_end_in_helices_and_patches_in_segments_as_well() -> None:
    """Section 3.3's sentence and its erratum: at phi_min a surface goes on, and only its patch ends."""
    for contact in contacts(TRIANGLE, SQUARE):
        i, j, S = contact.i, contact.j, contact_surface(TRIANGLE, SQUARE, contact)
        after = VertexVertex(i, int(SQUARE.next[j]))
        if isinstance(contact, EdgeVertex):
            after = VertexVertex(int(TRIANGLE.next[i]), j)
        phi = np.linspace(0, 2 * math.pi, 50)
        for t, end in ((0, VertexVertex(i, j)), (1, after)):
            np.testing.assert_allclose(S(t, phi), contact_helix(TRIANGLE, SQUARE, end)(phi), atol=1e-12)
        np.testing.assert_allclose(S(0.3, phi + 2 * math.pi)[:, :2], S(0.3, phi)[:, :2], atol=1e-12)
        Phi = angle_range(TRIANGLE, SQUARE, contact)
        for end, k in ((Phi.phi_min, i), (Phi.phi_max, i if isinstance(contact, EdgeVertex) else i - 1)):
            over = j - 1 if isinstance(contact, EdgeVertex) and end == Phi.phi_min else j
            k, over = k % len(TRIANGLE), over % len(SQUARE)
            C = contact_segment(TRIANGLE, SQUARE, EdgeEdge(k, over))
            # the ruling there is a part of the e-e segment, which goes on beyond it
            assert math.remainder(C.phi - end, math.tau) == pytest.approx(0, abs=1e-12)
            ends, ruling = C(C.t_range)[:, :2], S([0, 1], end)[:, :2]
            along = ends[1] - ends[0]
            share = (ruling - ends[0]) @ along / (along @ along)
            np.testing.assert_allclose(ends[0] + share[:, None] * along, ruling, atol=1e-12)
            assert share.min() > -1e-12 and share.max() < 1 + 1e-12 and np.ptp(share) < 1 - 1e-3
            # the surface goes on on both sides of it: contacts on one, forbidden on the other
            for beyond, free in ((-1e-3, end == Phi.phi_max), (1e-3, end == Phi.phi_min)):
                q = S.pose("1/2", end + beyond)
                assert contact in contact_features(TRIANGLE, SQUARE, q)
                assert is_contact(TRIANGLE, SQUARE, q) == free != is_forbidden(TRIANGLE, SQUARE, q)


def test_segments_join_the_four_vertex_contacts_of_two_edges() -> None:
    A = Polygon([(0, 0), (3, 4), (-4, 3)])  # |E_0| = 5, |E_2 of the square| = 2
    C = contact_segment(A, SQUARE, EdgeEdge(0, 2))
    assert C.t_range == (0.0, 3.5)
    i, j, k, m = 0, 2, 1, 3
    for t, pair in ((0, (i, j)), (1, (i, m)), (2.5, (k, j)), (3.5, (k, m))):
        np.testing.assert_allclose(C(t), contact_helix(A, SQUARE, VertexVertex(*pair))(C.phi), atol=1e-14)


RIGHT_ANGLES = {(1, 0): "0deg", (0, 1): "90deg", (-1, 0): "180deg", (0, -1): "270deg"}


@pytest.mark.parametrize(("A", "O"), [(SQUARE, SQUARE), (SQUARE, L_SHAPE), (L_SHAPE, SQUARE), (L_SHAPE, L_SHAPE)])
def test_edges_are_in_contact_exactly_on_the_closed_range(A: Polygon, O: Polygon) -> None:
    found = {curve for curve in contact_curves(A, O) if isinstance(curve, EdgeEdge)}
    for contact in (EdgeEdge(i, j) for i in range(len(A)) for j in range(len(O))):
        u, v = A.exact_edge(contact.i), O.exact_edge(contact.j)
        c, s = -(u[0] * v[0] + u[1] * v[1]), -(u[0] * v[1] - u[1] * v[0])
        theta = RIGHT_ANGLES[(int(math.copysign(1, c)) if c else 0, int(math.copysign(1, s)) if s else 0)]
        S = contact_surface(A, O, VertexEdge(contact.i, contact.j))
        low, high = contact_segment(A, O, contact).t_range if contact in found else (1.0, 0.0)
        for t in (Fraction(k, 8) for k in range(-4, 30)):
            q = S.pose(t, theta, beyond=True)
            touching = is_contact(A, O, q)
            if touching and contact in contact_features(A, O, q):
                assert low <= t <= high
            if low <= t <= high and SQUARE in (A, O):  # two Ls may overlap elsewhere
                assert touching
    if A is L_SHAPE is O:
        with pytest.raises(ValueError, match="has no segment: reflex vertices"):
            contact_segment(A, O, EdgeEdge(2, 3))


@pytest.mark.parametrize(("A", "O"), [(SQUARE, SQUARE), (L_SHAPE, L_SHAPE)])
def test_edges_have_more_than_a_point_in_common_exactly_on_two_segments(A: Polygon, O: Polygon) -> None:
    for contact in (EdgeEdge(i, j) for i in range(0, len(A), 2) for j in range(len(O))):
        against, alongside = edge_edge_surface(A, O, contact)
        assert math.isclose(abs(math.remainder(against.phi - alongside.phi, math.tau)), math.pi)
        for right in RIGHT_ANGLES.values():
            (segment,) = [
                s for s in (against, alongside) if abs(math.remainder(s.phi - Pose(0, 0, right).theta, math.tau)) < 1
            ] or [None]
            for t in (Fraction(k, 4) for k in range(-9, 14)):
                q = against.surface.pose(t, right, beyond=True)
                inside = segment is not None and segment.t_range[0] < t < segment.t_range[1]
                assert (contact in contact_features(A, O, q)) == inside
                assert not inside or segment is against or is_forbidden(A, O, q)
    if (A, O) == (SQUARE, SQUARE):
        assert contact_segment(A, O, EdgeEdge(0, 2)) == edge_edge_surface(A, O, EdgeEdge(0, 2))[0]


@pytest.mark.slow
@given(strategies.convex_polygons(), strategies.convex_polygons(), inner)
def test_a_patch_ends_where_an_edge_lies_on_an_edge(one: Shape, other: Shape, t: Fraction) -> None:
    A, O = Polygon(*one), Polygon(*other)
    for contact in contacts(A, O):
        S, r = contact_surface(A, O, contact), angle_range(A, O, contact)
        for phi, i, j in (
            (r.phi_min, contact.i, contact.j if isinstance(contact, VertexEdge) else int(O.previous[contact.j])),
            (r.phi_max, int(A.previous[contact.i]) if isinstance(contact, VertexEdge) else contact.i, contact.j),
        ):
            C = contact_segment(A, O, EdgeEdge(i, j))
            assert math.isclose(math.cos(C.phi - phi), 1)
            ends, point = C(C.t_range)[:, :2], S(float(t), phi)[:2]
            d, e = ends[1] - ends[0], point - ends[0]
            assert math.isclose(d[0] * e[1] - d[1] * e[0], 0, abs_tol=1e-9)
            assert -1e-9 <= d @ e <= d @ d + 1e-9


# evaluation


def test_calls_broadcast_and_agree_with_the_grid() -> None:
    rng = np.random.default_rng(5)
    t, phi = rng.uniform(size=7), rng.uniform(0, 7, size=5)
    for contact in (VertexEdge(1, 2), EdgeVertex(1, 2)):
        S = contact_surface(TRIANGLE, L_SHAPE, contact)
        table = S(t, phi[:, None])
        assert table.shape == (5, 7, 3)
        np.testing.assert_allclose(table[..., :2], S.grid(t, phi), atol=1e-14)
        np.testing.assert_array_equal(table[..., 2], np.broadcast_to(phi[:, None], (5, 7)))
        np.testing.assert_array_equal(S(t[3], phi[2]), table[2, 3])


def test_no_points_are_no_error() -> None:
    S = contact_surface(TRIANGLE, SQUARE, VertexEdge(0, 0))
    assert S([], []).shape == (0, 3)
    assert S.grid([], [0, 1]).shape == (2, 0, 2)


def test_millions_of_points_are_evaluated_at_once() -> None:
    S = contact_surface(TRIANGLE, SQUARE, EdgeVertex(0, 0))
    assert S.grid(np.linspace(0, 1, 2000), np.linspace(0, 6, 1000)).shape == (1000, 2000, 2)


def test_huge_coordinates_do_not_matter() -> None:
    big = Polygon([(x * 10**100, y * 10**100) for x, y in SQUARE.numerators])
    S = contact_surface(big, big, VertexEdge(0, 2))
    np.testing.assert_allclose(S(0.5, 0.0), [1e100, 2e100, 0])
    assert is_contact(big, big, S.pose("1/3", "45deg"))


@pytest.mark.parametrize("t", [-0.1, 1.5, [0, 1, 2], math.nan])
def test_beyond_the_edge_is_on_the_surface_only_if_one_says_so(t: float | list[float]) -> None:
    S = contact_surface(SQUARE, SQUARE, VertexEdge(0, 2))
    for evaluate in (lambda: S(t, 0.3), lambda: S.grid(np.atleast_1d(t), [0.3])):
        with pytest.raises(ValueError, match=r"beyond=True|not finite"):
            evaluate()
    if isinstance(t, float) and math.isfinite(t):
        with pytest.raises(ValueError, match="beyond=True"):
            S.pose(t, 0)
        q = S.pose(t, 0, beyond=True)
        np.testing.assert_allclose(S(t, 0, beyond=True), [float(q.x), float(q.y), 0], atol=1e-15)
    with pytest.raises(ValueError, match="phi: nan is not finite"):
        S(0.5, math.nan)
