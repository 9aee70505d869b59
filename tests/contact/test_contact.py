from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import strategies
from cfree.contact.contact import (
    AngleRange,
    EdgeEdge,
    EdgeVertex,
    VertexEdge,
    VertexVertex,
    angle_range,
    contact_curves,
    contacts,
    edge_edge_range,
)
from cfree.exact.number import IntPoint
from cfree.exact.orientation import Location, Order, Orientation, compare_directions, is_opposed, turn
from cfree.polygons.polygon import Polygon
from shapes import Shape

TRIANGLE = Polygon([(0, 0), (4, 0), (1, 3)])
SQUARE = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
L_SHAPE = Polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])
convex_pairs = st.tuples(strategies.convex_polygons(), strategies.convex_polygons())
pairs = st.tuples(strategies.polygons(), strategies.polygons())


def polygons(shapes: tuple[Shape, Shape]) -> tuple[Polygon, Polygon]:
    return Polygon(*shapes[0]), Polygon(*shapes[1])


def rotated(phi: IntPoint, u: IntPoint) -> IntPoint:
    """R(phi) u times the length of phi."""
    return phi[0] * u[0] - phi[1] * u[1], phi[1] * u[0] + phi[0] * u[1]


def is_angle_of(phi: float, direction: IntPoint) -> bool:
    return math.isclose(math.remainder(phi - math.atan2(direction[1], direction[0]), math.tau), 0, abs_tol=1e-12)


def is_opposite(u: IntPoint, v: IntPoint) -> bool:
    return turn(u, v) is Orientation.COLLINEAR and is_opposed(u, v)


# examples


def test_two_squares_touch_side_to_side_at_right_angles() -> None:
    #        O
    #   3---2    the lower left corner of A can stand on the top of O
    #   |   |    while A turns from 0 to 90 degrees
    #   0---1
    on_top = angle_range(SQUARE, SQUARE, VertexEdge(0, 2))
    assert on_top.domain == ((0.0, math.pi / 2),)
    assert (on_top.phi_min, on_top.phi_range, on_top.phi_max) == (0.0, math.pi / 2, math.pi / 2)
    assert angle_range(SQUARE, SQUARE, EdgeVertex(0, 2)).domain == ((1.5 * math.pi, 2 * math.pi), (0.0, 0.0))
    assert angle_range(SQUARE, SQUARE, VertexVertex(0, 2)).domain == ((1.5 * math.pi, 2 * math.pi), (0.0, math.pi / 2))
    assert angle_range(SQUARE, SQUARE, EdgeEdge(0, 2)).domain == ((0.0, 0.0),)


def test_a_corner_in_a_reflex_corner_is_a_helix() -> None:
    # the reflex vertex 3 of the L leaves 90 degrees: a square's corner fits exactly, a sharper one turns
    assert VertexVertex(0, 3) not in contact_curves(SQUARE, L_SHAPE)
    with pytest.raises(ValueError, match=r"VertexVertex\(i=0, j=3\) is never a contact"):
        angle_range(SQUARE, L_SHAPE, VertexVertex(0, 3))
    sharp = Polygon([(0, 0), (2, 0), (2, 1)])
    assert math.isclose(angle_range(sharp, L_SHAPE, VertexVertex(0, 3)).phi_range, math.pi / 2 - math.atan(0.5))


def test_a_wrong_index_is_named_with_the_count() -> None:
    square = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    with pytest.raises(IndexError, match=r"VertexEdge\(i=0, j=4\): the obstacle has 4 .* from 0 to 3"):
        angle_range(square, square, VertexEdge(0, 4))
    with pytest.raises(IndexError, match="the robot has 4"):
        edge_edge_range(square, square, EdgeEdge(-1, 0))


@pytest.mark.parametrize("contact", [VertexEdge(3, 0), VertexVertex(3, 3)])
def test_a_reflex_vertex_has_no_patch(contact: VertexEdge | VertexVertex) -> None:
    assert contact not in (*contacts(L_SHAPE, L_SHAPE), *contact_curves(L_SHAPE, L_SHAPE))
    with pytest.raises(ValueError, match="never a contact"):
        angle_range(L_SHAPE, L_SHAPE, contact)


def test_edges_slide_along_each_other_until_a_reflex_vertex() -> None:
    # E_0 of the square (length 2) on E_2 of the L, from (2, 1) to the reflex vertex (1, 1): L = 2
    assert edge_edge_range(SQUARE, L_SHAPE, EdgeEdge(0, 2)) == (0.0, 1.0)
    assert edge_edge_range(SQUARE, L_SHAPE, EdgeEdge(0, 3)) == (2.0, 3.0)
    assert edge_edge_range(SQUARE, L_SHAPE, EdgeEdge(0, 0)) == (0.0, 2.0)
    # E_2 of the L ends in a reflex vertex: the robot's foot must stand out on the obstacle's start
    assert edge_edge_range(L_SHAPE, SQUARE, EdgeEdge(2, 0)) == (0.0, 0.5)
    assert edge_edge_range(L_SHAPE, L_SHAPE, EdgeEdge(2, 3)) is None
    assert edge_edge_range(L_SHAPE, L_SHAPE, EdgeEdge(2, 2)) == (0.0, 1.0)


# properties: the paper


@settings(max_examples=30)
@given(st.lists(strategies.fractions(5), min_size=3, max_size=6, unique=True), strategies.convex_polygons())
def test_remark_4_for_vertices_on_a_circle(tangents: list[Fraction], shape: Shape) -> None:
    """Phi from the angles alpha_i of the vertices alone: an edge is normal to the bisector of its ends' angles."""
    robot, O = Polygon.from_polar([(2, {"tau": tau}) for tau in sorted(tangents)]), Polygon(*shape)
    alpha, (x, y) = robot.polar[:, 1], O.exact_edge(0)
    for i in range(len(robot)):
        found = angle_range(robot, O, VertexEdge(i, 0))
        before, after = (alpha[i] - alpha[i - 1]) % math.tau, (alpha[(i + 1) % len(alpha)] - alpha[i]) % math.tau
        phi_min = math.atan2(-y, -x) - (alpha[i] + after / 2 + math.pi / 2)
        assert math.isclose(math.remainder(found.phi_min - phi_min, math.tau), 0, abs_tol=1e-12)
        assert math.isclose(found.phi_range, (before + after) / 2, abs_tol=1e-12)
        # exactly, too: the direction of E_i is i (1 + i u) (1 + i v), u and v the tangents of half the ends' angles
        u, v = sorted(tangents)[i], sorted(tangents)[(i + 1) % len(tangents)]
        along = (-u - v, 1 - u * v)
        ex, ey = robot.exact_edge(i)
        assert along[0] * ey == along[1] * ex


@given(convex_pairs)
def test_a_convex_pair_has_2nm_contacts_and_as_many_curves(shapes: tuple[Shape, Shape]) -> None:
    A, O = polygons(shapes)
    n, m = len(A), len(O)
    assert len(contacts(A, O)) == 2 * n * m
    curves = contact_curves(A, O)
    assert len(curves) == 2 * n * m
    assert sum(isinstance(curve, VertexVertex) for curve in curves) == n * m


@pytest.mark.slow
@given(pairs)
def test_widths_are_those_of_the_paper(shapes: tuple[Shape, Shape]) -> None:
    A, O = polygons(shapes)
    for contact in (*contacts(A, O), *contact_curves(A, O)):
        rho, omega = A.interior_angles[contact.i], O.interior_angles[contact.j]
        expected = {
            VertexEdge: math.pi - rho,
            EdgeVertex: math.pi - omega,
            VertexVertex: 2 * math.pi - rho - omega,
            EdgeEdge: 0,
        }[type(contact)]
        assert math.isclose(angle_range(A, O, contact).phi_range, expected, rel_tol=1e-12, abs_tol=1e-14)


@given(convex_pairs)
def test_vertex_patches_over_one_edge_tile_the_circle(shapes: tuple[Shape, Shape]) -> None:
    A, O = polygons(shapes)
    for j in range(len(O)):
        ranges = [angle_range(A, O, VertexEdge(i, j)) for i in range(len(A))]
        assert math.isclose(sum(r.phi_range for r in ranges), 2 * math.pi)
        for i, r in enumerate(ranges):
            assert compare_directions(r.start, ranges[A.next[i]].end) is Order.SAME
    for i in range(len(A)):
        ranges = [angle_range(A, O, EdgeVertex(i, j)) for j in range(len(O))]
        for j, r in enumerate(ranges):
            assert compare_directions(r.end, ranges[O.next[j]].start) is Order.SAME


@given(pairs)
def test_ends_of_vertex_edge_patches_are_those_of_section_3_1_1(shapes: tuple[Shape, Shape]) -> None:
    A, O = polygons(shapes)
    EA, EO = A.edge_numerators, O.edge_numerators
    for contact in contacts(A, O):
        if isinstance(contact, VertexEdge):
            r, E = angle_range(A, O, contact), EO[contact.j]
            assert is_angle_of(r.phi_min, r.start) and is_angle_of(r.phi_max, r.end)
            assert math.isclose(r.phi_range, math.pi - A.interior_angles[contact.i], rel_tol=1e-12)
            to_next, from_previous = EA[contact.i], EA[A.previous[contact.i]]
            to_previous = (-from_previous[0], -from_previous[1])
            # a_{i+1} on the line of E_j behind a_i, a_{i-1} to its right; and the other way round
            assert is_opposite(rotated(r.start, to_next), E)
            assert turn(E, rotated(r.start, to_previous)) is Orientation.RIGHT
            assert turn(E, rotated(r.end, to_previous)) is Orientation.COLLINEAR
            assert not is_opposed(E, rotated(r.end, to_previous))
            assert turn(E, rotated(r.end, to_next)) is Orientation.RIGHT


@given(pairs)
def test_ends_of_edge_vertex_patches_are_those_of_section_3_2_1(shapes: tuple[Shape, Shape]) -> None:
    A, O = polygons(shapes)
    EA, EO = A.edge_numerators, O.edge_numerators
    for contact in contacts(A, O):
        if isinstance(contact, EdgeVertex):
            r, E = angle_range(A, O, contact), EA[contact.i]
            assert is_angle_of(r.phi_min, r.start) and is_angle_of(r.phi_max, r.end)
            assert math.isclose(r.phi_range, math.pi - O.interior_angles[contact.j], rel_tol=1e-12)
            arriving, leaving = EO[O.previous[contact.j]], EO[contact.j]
            # eq. (9): a_{i+1} on the line of E_{j-1}, towards b_{j-1}; a_i on the line of E_j, towards b_{j+1}
            assert is_opposite(rotated(r.start, E), arriving)
            assert is_opposite(rotated(r.end, E), leaving)
            # the obstacle is not on the robot's side, the left of its edge
            assert turn(rotated(r.start, E), leaving) is Orientation.RIGHT
            assert turn(rotated(r.end, E), (-arriving[0], -arriving[1])) is Orientation.RIGHT


@given(pairs)
def test_helices_begin_and_end_where_patches_do(shapes: tuple[Shape, Shape]) -> None:
    A, O = polygons(shapes)
    for contact in contact_curves(A, O):
        if isinstance(contact, VertexVertex):
            i, j = contact.i, contact.j
            before_i, before_j = int(A.previous[i]), int(O.previous[j])
            r = angle_range(A, O, contact)
            neighbours = [(VertexEdge(i, before_j), VertexEdge(i, j)), (EdgeVertex(i, j), EdgeVertex(before_i, j))]
            for convex, (first, last) in zip((A.convex[i], O.convex[j]), neighbours, strict=True):
                if convex:
                    assert compare_directions(angle_range(A, O, first).start, r.start) is Order.SAME
                    assert compare_directions(angle_range(A, O, last).end, r.end) is Order.SAME


@given(convex_pairs)
def test_two_patches_meet_at_every_angle_of_a_helix(shapes: tuple[Shape, Shape]) -> None:
    """The four patches with an end on it, and which two of them meet where."""
    A, O = polygons(shapes)
    for contact in contact_curves(A, O):
        if isinstance(contact, EdgeEdge):
            continue
        i, j, before_i, before_j = contact.i, contact.j, int(A.previous[contact.i]), int(O.previous[contact.j])
        helix, rho, omega = angle_range(A, O, contact), A.interior_angles[contact.i], O.interior_angles[contact.j]
        beside = {
            VertexEdge(i, before_j): (0.0, math.pi - rho),
            EdgeVertex(i, j): (0.0, math.pi - omega),
            EdgeVertex(before_i, j): (math.pi - rho, math.tau - rho - omega),
            VertexEdge(i, j): (math.pi - omega, math.tau - rho - omega),
        }
        found = {patch: angle_range(A, O, patch) for patch in beside}
        for patch, (low, high) in beside.items():
            from_start = math.remainder(found[patch].phi_min - helix.phi_min - low, math.tau)
            assert from_start == pytest.approx(0, abs=1e-9) and found[patch].phi_range == pytest.approx(high - low)
        for share in (0.001, 0.25, 0.5, 0.75, 0.999):
            angle = share * helix.phi_range
            if min(abs(angle - end) for ends in beside.values() for end in ends) < 1e-9:
                continue
            phi = helix.phi_min + angle
            meet = {patch for patch, r in found.items() if (phi - r.phi_min) % math.tau < r.phi_range}
            first, last = sorted((math.pi - rho, math.pi - omega))
            of_kind = VertexEdge if rho < omega else EdgeVertex
            if angle < first:
                assert meet == {VertexEdge(i, before_j), EdgeVertex(i, j)}
            elif angle > last:
                assert meet == {EdgeVertex(before_i, j), VertexEdge(i, j)}
            else:
                assert meet == {patch for patch in beside if isinstance(patch, of_kind)}


@pytest.mark.slow
@given(pairs)
def test_the_domain_of_equation_6_lies_in_one_turn_and_has_the_stated_width(shapes: tuple[Shape, Shape]) -> None:
    A, O = polygons(shapes)
    for contact in contacts(A, O):
        r = angle_range(A, O, contact)
        assert 0 <= r.phi_min < 2 * math.pi
        assert math.isclose(sum(high - low for low, high in r.domain), r.phi_range, abs_tol=1e-14)
        assert all(0 <= low <= high <= 2 * math.pi for low, high in r.domain)
        # one interval from phi_min to phi_max, or two that meet at 0: eq. (6)
        assert r.domain[0][0] == r.phi_min and r.domain[-1][1] % (2 * math.pi) == pytest.approx(
            r.phi_max % (2 * math.pi)
        )
        assert len(r.domain) == (1 if r.phi_max < 2 * math.pi else 2)
        assert len(r.domain) == 1 or (r.domain[0][1], r.domain[1][0]) == (2 * math.pi, 0)
        for phi, place in ((r.phi_min + r.phi_range / 2, Location.INSIDE), (r.phi_max + 1e-9, Location.OUTSIDE)):
            if r.phi_range > 1e-9:
                c, s = round(1e15 * math.cos(phi)), round(1e15 * math.sin(phi))
                assert r.locate((c, s)) is place
        assert r.locate(r.start) is r.locate(r.end) is Location.BOUNDARY


@pytest.mark.slow
@given(pairs, strategies.half_tangents())
def test_turning_the_robot_shifts_every_range(shapes: tuple[Shape, Shape], tau: Fraction | None) -> None:
    from cfree.exact.pose import Pose

    A, O = polygons(shapes)
    assume(len(A.ring_offsets) == 2)
    pose = Pose(1, 2, {"tau": "inf" if tau is None else tau})
    B = Polygon(pose.apply_exact(A.exact_vertices))
    back = pose.inverse().rotation[:2]
    assert contacts(A, O) == contacts(B, O)
    for contact in contacts(A, O):
        before, after = angle_range(A, O, contact), angle_range(B, O, contact)
        assert compare_directions(rotated(back, before.start), after.start) is Order.SAME
        assert compare_directions(rotated(back, before.end), after.end) is Order.SAME


# errata of the paper


def test_equation_7_needs_its_vectors_as_columns() -> None:
    # M = (E_i, R(pi/2) E_i) as columns gives the difference of the angles, as rows their sum
    E_A, E_O = np.array([2.0, 1.0]), np.array([-1.0, 3.0])
    A, O = Polygon([(0, 0), (2, 1), (0, 2)]), Polygon([(0, 0), (-1, 3), (-2, 0)])
    r = angle_range(A, O, VertexEdge(0, 0))
    M = np.column_stack((E_A, [-E_A[1], E_A[0]]))
    target = -np.linalg.norm(E_A) * E_O / np.linalg.norm(E_O)
    x, y = np.linalg.solve(M, target)
    assert math.isclose(math.atan2(y, x) % (2 * math.pi), r.phi_min)
    x, y = np.linalg.solve(M.T, target)
    assert not math.isclose(math.atan2(y, x) % (2 * math.pi), r.phi_min)


def test_its_twin_in_section_3_2_1_does_too() -> None:
    A, O, t = Polygon([(0, 0), (2, 1), (0, 2)]), Polygon([(0, 0), (-1, 3), (-2, 0)]), 0.25
    r = angle_range(A, O, EdgeVertex(0, 1))
    rest, arriving = (1 - t) * A.edge(0), O.edge(0)
    M = np.column_stack((rest, [-rest[1], rest[0]]))
    target = (t - 1) * np.linalg.norm(A.edge(0)) * arriving / np.linalg.norm(arriving)
    x, y = np.linalg.solve(M, target)
    assert math.isclose(math.atan2(y, x) % (2 * math.pi), r.phi_min)
    x, y = np.linalg.solve(M.T, target)
    assert not math.isclose(math.atan2(y, x) % (2 * math.pi), r.phi_min)


TABLE_1 = {  # signs of x_0 and y_0, and between which multiples of a right angle phi_min is
    (True, True): (0, 1),
    (False, True): (1, 2),
    (False, False): (2, 3),
    (True, False): (3, 4),
}


def test_phi_min_is_in_the_interval_of_table_1() -> None:
    compass = Polygon.from_polar([(1, f"{30 * k}deg") for k in range(12)])
    pairs = [(A, O) for A in (TRIANGLE, SQUARE, L_SHAPE, compass) for O in (TRIANGLE, SQUARE, compass)]
    seen = set()
    for A, O in pairs:
        for contact in contacts(A, O):
            j = contact.j if isinstance(contact, VertexEdge) else int(O.previous[contact.j])
            u, v, r = A.edge(contact.i), O.edge(j), angle_range(A, O, contact)
            # x_0 and y_0 up to the factor 1 / (|u| |v|), in integers: no arc cosine, and no rounding of a sign
            (p, q), (s, t) = A.edge_numerators[contact.i], O.edge_numerators[j]
            x, y = -(p * s + q * t), -(p * t - q * s)
            length = math.hypot(*u) * math.hypot(*v)
            assert math.cos(r.phi_min) == pytest.approx(-(u @ v) / length, abs=1e-12)
            assert math.sin(r.phi_min) == pytest.approx(-(u[0] * v[1] - u[1] * v[0]) / length, abs=1e-12)
            low, high = TABLE_1[x >= 0, y >= 0]
            assert low * math.pi / 2 <= r.phi_min <= high * math.pi / 2
            seen.add((x > 0) - (x < 0) + 3 * ((y > 0) - (y < 0)))
    assert len(seen) == 8  # all four rows, and all four borders between them


@given(pairs)
def test_cosine_and_sine_of_phi_min_need_one_square_root_only(shapes: tuple[Shape, Shape]) -> None:
    # remark 4 of the paper says they cannot be computed exactly: the direction is rational, and (x_0, y_0) is it
    # over the root of an integer
    A, O = polygons(shapes)
    for contact in contacts(A, O):
        r = angle_range(A, O, contact)
        for (c, s), phi in ((r.start, r.phi_min), (r.end, r.phi_max)):
            n = c * c + s * s
            assert isinstance(n, int) and n > 0
            assert c / math.sqrt(n) == pytest.approx(math.cos(phi), abs=1e-12)
            assert s / math.sqrt(n) == pytest.approx(math.sin(phi), abs=1e-12)


# degenerate


def test_a_needle_keeps_its_angle() -> None:
    needle = Polygon([(0, 0), (10**20, 0), (10**20, 1)])
    assert angle_range(needle, SQUARE, VertexEdge(0, 0)).phi_range == math.pi
    assert math.isclose(angle_range(needle, SQUARE, VertexEdge(0, 0)).phi_min, math.pi)
    blunt = Polygon([(0, 0), (10**20, -1), (2 * 10**20, 0), (10**20, 1)])
    assert math.isclose(angle_range(blunt, SQUARE, VertexEdge(1, 0)).phi_range, 2e-20)


def test_an_angle_range_at_zero_begins_at_zero() -> None:
    r = AngleRange(0.0, 1.0, (1, 0), (1, 1))
    assert r.domain == ((0.0, 1.0),)
    assert r.locate((1, -1)) is Location.OUTSIDE
