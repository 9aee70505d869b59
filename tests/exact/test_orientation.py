from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cfree.exact.orientation import (
    Location,
    Meeting,
    Order,
    Orientation,
    Vector,
    compare_directions,
    compare_lengths,
    crossing_point,
    is_opposed,
    locate,
    locate_in_sector,
    meet,
    orient,
    turn,
)

numbers = st.integers(-4, 4) | st.fractions(-4, 4, max_denominator=3)
points = st.tuples(numbers, numbers)
directions = points.filter(lambda d: d != (0, 0))
MIRROR = {
    Orientation.LEFT: Orientation.RIGHT,
    Orientation.RIGHT: Orientation.LEFT,
    Orientation.COLLINEAR: Orientation.COLLINEAR,
}
REVERSE = {Order.BEFORE: Order.AFTER, Order.AFTER: Order.BEFORE, Order.SAME: Order.SAME}


def test_a_hair_beside_a_line_is_seen() -> None:
    far = 10**30
    assert orient((0, 0), (far, far), (far - 1, far)) is Orientation.LEFT
    assert orient((0, 0), (3, 1), (1, Fraction(1, 3))) is Orientation.COLLINEAR


@given(points, points, points)
def test_orientation_turns_over_with_its_arguments(p: Vector, q: Vector, r: Vector) -> None:
    assert orient(p, q, r) is orient(q, r, p) is MIRROR[orient(q, p, r)]
    assert orient(p, q, r) is turn((q[0] - p[0], q[1] - p[1]), (r[0] - p[0], r[1] - p[1]))


def test_directions_are_ordered_round_the_circle() -> None:
    circle = [(1, 0), (2, 1), (1, 1), (0, 3), (-1, 2), (-5, 0), (-1, -1), (0, -1), (3, -1)]
    for k, u in enumerate(circle):
        for m, v in enumerate(circle):
            expected = Order.BEFORE if k < m else Order.AFTER if k > m else Order.SAME
            assert compare_directions(u, (2 * v[0], 2 * v[1])) is expected


@pytest.mark.slow
@given(directions, directions, directions)
def test_the_order_of_directions_is_total(u: Vector, v: Vector, w: Vector) -> None:
    assert compare_directions(u, v) is REVERSE[compare_directions(v, u)]
    if compare_directions(u, v) is compare_directions(v, w):
        assert compare_directions(u, w) is compare_directions(u, v)


@given(directions, directions, directions)
def test_a_sector_and_its_complement_share_only_their_ends(d: Vector, start: Vector, end: Vector) -> None:
    one, other = locate_in_sector(d, start, end), locate_in_sector(d, end, start)
    if Location.BOUNDARY in (one, other):
        assert one is other
    elif turn(start, end) is Orientation.COLLINEAR and not is_opposed(start, end):
        assert one is other is Location.INSIDE
    else:
        assert {one, other} == {Location.INSIDE, Location.OUTSIDE}


def test_sectors_of_every_width() -> None:
    east, north, west, south = (1, 0), (0, 1), (-1, 0), (0, -1)
    assert locate_in_sector(north, east, west) is Location.INSIDE
    assert locate_in_sector(south, east, west) is Location.OUTSIDE
    assert locate_in_sector(west, east, south) is Location.INSIDE
    assert locate_in_sector((1, -1), east, south) is Location.OUTSIDE
    assert locate_in_sector((2, 0), east, south) is Location.BOUNDARY
    assert locate_in_sector(west, east, (3, 0)) is Location.INSIDE


@given(points, points, points, points)
def test_meeting_agrees_with_a_solved_system(p: Vector, q: Vector, r: Vector, s: Vector) -> None:
    if p == q or r == s:
        return
    found = meet(p, q, r, s)
    assert found is meet(r, s, p, q) is meet(q, p, r, s)
    if turn((q[0] - p[0], q[1] - p[1]), (s[0] - r[0], s[1] - r[1])) is Orientation.COLLINEAR:
        return
    x = crossing_point(p, q, r, s)
    assert orient(p, q, x) is orient(r, s, x) is Orientation.COLLINEAR
    within = all(min(a, b) <= x <= max(a, b) for a, b in ((p, q), (r, s)))
    if x in (p, q, r, s):
        assert found is (Meeting.TOUCH if within else Meeting.APART)
    else:
        assert found is (Meeting.CROSS if within else Meeting.APART)


def test_collinear_segments_are_told_apart() -> None:
    assert meet((0, 0), (2, 0), (1, 0), (3, 0)) is Meeting.OVERLAP
    assert meet((0, 0), (2, 0), (2, 0), (3, 0)) is Meeting.TOUCH
    assert meet((0, 0), (2, 0), (3, 0), (4, 0)) is Meeting.APART
    assert meet((0, 0), (0, 2), (0, 5), (0, 1)) is Meeting.OVERLAP
    assert meet((0, 0), (2, 0), (0, 1), (2, 1)) is Meeting.APART


def test_lengths_are_compared_without_roots() -> None:
    assert compare_lengths((10**30, 1), (10**30, 0)) is Order.AFTER
    assert compare_lengths((1, 0), (Fraction(3, 5), Fraction(4, 5))) is Order.SAME


def test_points_are_located_in_a_square_with_a_hole() -> None:
    rings = [[(0, 0), (6, 0), (6, 6), (0, 6)], [(2, 2), (2, 4), (4, 4), (4, 2)]]
    edges = [(ring[k - 1], ring[k]) for ring in rings for k in range(4)]
    inside = {(1, 1), (1, 2), (5, 4), (3, 1), (1, 3), (5, 2), (2, 1)}
    boundary = {(0, 0), (3, 0), (6, 6), (2, 3), (4, 4), (3, 2), (0, 2), (6, 4)}
    outside = {(3, 3), (-1, 0), (7, 6), (-1, 2), (-1, 4), (7, 2), (3, 7), (-1, 3)}
    for place, samples in (
        (Location.INSIDE, inside),
        (Location.BOUNDARY, boundary),
        (Location.OUTSIDE, outside),
    ):
        assert {point for point in samples if locate(point, edges) is place} == samples
