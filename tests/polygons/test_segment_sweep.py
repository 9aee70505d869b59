from itertools import combinations

from hypothesis import given
from hypothesis import strategies as st

from cfree.exact.orientation import Location, Meeting, Orientation, locate, locate_in_sector, meet, orient
from reference_sweep import EdgesMeet, Nesting, sweep

Point = tuple[int, int]
Shapes = list[list[Point]]


def edges_of(rings: Shapes) -> list[tuple[int, int, int]]:
    """(start, end, ring) of each edge; ends are indices of points."""
    edges, first = [], 0
    for r, ring in enumerate(rings):
        edges += [(first + k, first + (k + 1) % len(ring), r) for k in range(len(ring))]
        first += len(ring)
    return edges


def run(rings: Shapes) -> EdgesMeet | Nesting:
    offsets = [0]
    for ring in rings:
        offsets.append(offsets[-1] + len(ring))
    return sweep([point for ring in rings for point in ring], offsets)


def without_straight_vertices(ring: list[Point]) -> list[Point]:
    while True:
        around = list(zip([ring[-1], *ring], ring, [*ring[1:], ring[0]], strict=False)) if ring else []
        kept = [q for p, q, r in around if orient(p, q, r) is not Orientation.COLLINEAR]
        if len(kept) == len(ring):
            return ring
        ring = kept


def do_cross(shapes: Shapes) -> bool:
    """By comparing all pairs: do edges meet as they must not? Touching rings are judged near their points."""
    points, edges = [p for ring in shapes for p in ring], edges_of(shapes)
    for (p, q, r), (s, t, u) in combinations(edges, 2):
        found = meet(points[p], points[q], points[s], points[t])
        if found in (Meeting.CROSS, Meeting.OVERLAP):
            return True
        if found is Meeting.TOUCH and r == u and q != s and t != p:
            return True
    corners = {p: [] for p in points}
    for p, corner in corners.items():
        for ring in shapes:
            for k, b in enumerate(ring):
                a, c = ring[k - 1], ring[(k + 1) % len(ring)]
                if b == p:
                    corner.append((a, c))
                elif orient(b, c, p) is Orientation.COLLINEAR and min(b, c) < p < max(b, c):
                    corner.append((b, c))
        for one, other in combinations(corner, 2):
            (a, b), (c, d) = ([(x - p[0], y - p[1]) for x, y in pair] for pair in (one, other))
            if locate_in_sector(c, a, b) is not locate_in_sector(d, a, b):
                return True
    return False


small = st.tuples(st.integers(0, 5), st.integers(0, 5))
rings = st.lists(small, min_size=3, max_size=7).map(without_straight_vertices).filter(lambda ring: len(ring) > 2)


def test_the_first_fault_of_a_bow_tie_is_its_crossing() -> None:
    assert run([[(0, 0), (2, 2), (2, 0), (0, 2)]]) == EdgesMeet((0, 2))


def test_a_hole_lies_above_an_edge_of_its_container() -> None:
    outer, hole = [(0, 0), (9, 0), (9, 9), (0, 9)], [(1, 1), (1, 8), (8, 8), (8, 1)]
    found = run([outer, hole, [(3, 3), (4, 3), (3, 4)]])
    assert isinstance(found, Nesting)
    assert found.below == {0: None, 1: 0, 2: 7}
    assert found.rightward[0] and not found.rightward[7]


@given(st.lists(rings, min_size=1, max_size=3))
def test_the_sweep_finds_a_crossing_exactly_if_comparing_all_pairs_does(shapes: Shapes) -> None:
    assert isinstance(run(shapes), EdgesMeet) == do_cross(shapes)


@given(st.lists(rings, min_size=2, max_size=4))
def test_a_ring_lies_in_another_if_it_lies_above_its_lower_side(shapes: Shapes) -> None:
    found = run(shapes)
    if isinstance(found, EdgesMeet):
        return
    edges = edges_of(shapes)
    points = [p for ring in shapes for p in ring]
    areas = [sum(points[p][0] * points[q][1] - points[p][1] * points[q][0] for p, q, r in edges if r == k)
             for k in range(len(shapes))]  # fmt: skip
    container: dict[int, int | None] = {}
    for ring, e in found.below.items():
        other = None if e is None else edges[e][2]
        inside = e is not None and other is not None and found.rightward[e] == (areas[other] > 0)
        container[ring] = other if inside or other is None else container[other]
    for ring, shape in enumerate(shapes):
        around = set()
        for other in range(len(shapes)):
            places = {locate(p, [(points[a], points[b]) for a, b, r in edges if r == other]) for p in shape}
            if other != ring and Location.INSIDE in places:
                around.add(other)
        chain, outside = set(), container[ring]
        while outside is not None:
            chain.add(outside)
            outside = container[outside]
        assert around <= chain


def test_a_vertical_comb_is_swept() -> None:
    comb = [(0, 0), (20, 0), (20, 9)]
    for x in range(19, 1, -2):
        comb += [(x, 9), (x, 1), (x - 1, 1), (x - 1, 9)]
    comb = without_straight_vertices([*comb, (0, 9)])
    assert isinstance(run([comb]), Nesting)
    comb[5] = (comb[5][0], -1)
    assert isinstance(run([comb]), EdgesMeet)


def test_rings_may_touch_in_points_but_not_along_edges() -> None:
    triangle = [(0, 0), (2, 0), (1, 1)]
    for dx, dy in ((2, 0), (-2, 0), (1, 1), (-1, -1), (1, -1)):
        assert isinstance(run([triangle, [(x + dx, y + dy) for x, y in triangle]]), Nesting)
    assert isinstance(run([triangle, triangle]), EdgesMeet)
    assert isinstance(run([triangle, [(1, 0), (3, 0), (2, -1)]]), EdgesMeet)


def test_a_ring_that_touches_itself_meets() -> None:
    assert isinstance(run([[(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)]]), EdgesMeet)
    assert isinstance(run([[(0, 0), (2, 1), (4, 0), (4, 4), (2, 1), (0, 4)]]), EdgesMeet)
