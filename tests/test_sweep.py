from itertools import combinations

from hypothesis import given
from hypothesis import strategies as st

from cfree.predicates import Meeting, Orientation, meet, orient
from cfree.sweep import Below, EdgesMeet, sweep

Point = tuple[int, int]


def edges_of(rings: list[list[Point]]) -> list[tuple[int, int]]:
    """(start, end) of each edge, as indices of points."""
    edges, first = [], 0
    for ring in rings:
        edges += [(first + k, first + (k + 1) % len(ring)) for k in range(len(ring))]
        first += len(ring)
    return edges


def run(rings: list[list[Point]]) -> EdgesMeet | Below:
    offsets = [0]
    for ring in rings:
        offsets.append(offsets[-1] + len(ring))
    return sweep([point for ring in rings for point in ring], offsets)


def without_straight_vertices(ring: list[Point]) -> list[Point]:
    while True:
        n = len(ring)
        kept = [
            ring[k]
            for k in range(n)
            if orient(ring[k - 1], ring[k], ring[(k + 1) % n]) is not Orientation.COLLINEAR
        ]
        if len(kept) == n:
            return ring
        ring = kept


small = st.tuples(st.integers(0, 5), st.integers(0, 5))
rings = (
    st.lists(small, min_size=3, max_size=7).map(without_straight_vertices).filter(lambda ring: len(ring) > 2)
)


def test_the_first_fault_of_a_bow_tie_is_its_crossing() -> None:
    assert run([[(0, 0), (2, 2), (2, 0), (0, 2)]]) == EdgesMeet((0, 2))


def test_a_hole_lies_above_an_edge_of_its_container() -> None:
    outer, hole = [(0, 0), (9, 0), (9, 9), (0, 9)], [(1, 1), (1, 8), (8, 8), (8, 1)]
    found = run([outer, hole, [(3, 3), (4, 3), (3, 4)]])
    assert isinstance(found, Below)
    assert found.edges == (None, 0, 7)
    assert found.rightward[0] and not found.rightward[7]


@given(st.lists(rings, min_size=1, max_size=3))
def test_the_sweep_finds_a_meeting_exactly_if_comparing_all_pairs_does(shapes: list[list[Point]]) -> None:
    points, edges = [p for ring in shapes for p in ring], edges_of(shapes)

    def do_meet(e: int, f: int) -> bool:
        (p, q), (r, s) = edges[e], edges[f]
        if q == r or s == p:
            return False
        return meet(points[p], points[q], points[r], points[s]) is not Meeting.APART

    found = run(shapes)
    if isinstance(found, EdgesMeet):
        e, f = found.edges
        assert do_meet(e, f) or points[e] == points[f]
    else:
        assert not any(do_meet(e, f) for e, f in combinations(range(len(edges)), 2))
        assert len(set(points)) == len(points)


def test_a_vertical_comb_is_swept() -> None:
    comb = [(0, 0), (20, 0), (20, 9)]
    for x in range(19, 1, -2):
        comb += [(x, 9), (x, 1), (x - 1, 1), (x - 1, 9)]
    comb = without_straight_vertices([*comb, (0, 9)])
    assert isinstance(run([comb]), Below)
    comb[5] = (comb[5][0], -1)
    assert isinstance(run([comb]), EdgesMeet)


def test_equal_points_of_different_rings_meet() -> None:
    triangle = [(0, 0), (2, 0), (1, 1)]
    for dx, dy in ((2, 0), (-2, 0), (1, 1), (-1, -1)):
        assert isinstance(run([triangle, [(x + dx, y + dy) for x, y in triangle]]), EdgesMeet)
    assert isinstance(run([triangle, triangle]), EdgesMeet)
