"""Random pairs and layouts: no-fit polygons against exact slices, layouts against an independent exact check.

    python tests/support/fuzz_nesting.py --count 10000 --seed 0

Shapes have small integer vertices, holes and coincident directions, so that most pairs are degenerate. A third are
turned by a rational angle.
"""

from __future__ import annotations

import argparse
import random
import time
from fractions import Fraction
from itertools import combinations

from cfree.exact.number import ExactPoint
from cfree.nesting.layout import Nesting, Part
from cfree.nesting.nofit import NFP, InnerFit, inner_fit, nfp
from cfree.nesting.placement import place
from cfree.polygons.polygon import Polygon
from exact_slices import ExactSlice, Segments, both, ends, exact_slice, on_some, oriented, reverse, united, without
from shapes import PlainScene, Shape, box, monotone_ring

TAUS = (Fraction(0), Fraction(1), None, Fraction(-1), Fraction(1, 2), Fraction(-1, 3), Fraction(2, 7), Fraction(3))


def random_shape(draw: random.Random, size: int = 6, hole: float = 0.3) -> Shape:
    """A monotone polygon of small integers, or a box with such a hole."""
    while True:
        points = [(draw.randint(0, size), draw.randint(0, size)) for _ in range(draw.randint(3, 9))]
        ring = monotone_ring(sorted(set(points)))
        if not ring:
            continue
        if draw.random() < hole:
            k = draw.randint(1, 3)
            box = [(-k, -k), (size + k, -k), (size + k, size + k), (-k, size + k)]
            return box, [ring[::-1]]
        return ring, []


def random_pair(draw: random.Random) -> tuple[Shape, Shape]:
    """Two shapes; the second often fits exactly into a hole of the first."""
    ring, _ = random_shape(draw, hole=0)
    if draw.random() < 0.7:
        return random_shape(draw), (ring, [])
    xs, ys = zip(*ring, strict=True)
    wall = box(min(xs) - 1, min(ys) - 1, max(xs) + 1, max(ys) + 1)[0]
    return (wall, [ring[::-1]]), (ring, [])


def rims(segments: Segments) -> Segments:
    """Oriented segments without those that run both ways."""
    return without(segments, reverse(segments))


def drawn(fit: NFP | InnerFit, *, outward: bool) -> ExactSlice:
    """Rings, segments and points of a fit in the form of the oracle, the overlap on the left."""
    edges = [(ring[k - 1], ring[k]) for ring in fit.rings for k in range(len(ring))]
    rings = united(oriented(*(edge if outward else edge[::-1])) for edge in edges)
    slits = united(oriented(*edge) for edge in fit.segments)
    return ExactSlice(both(both(rings, slits), reverse(slits)), set(fit.points))


def same(one: ExactSlice, other: ExactSlice) -> bool:
    """True if two slices have the same rims, slits and points."""
    return rims(one.segments) == rims(other.segments) and one.slits == other.slits and one.points == other.points


def check_pair(fixed: Shape, moving: Shape, tau: Fraction | None) -> None:
    """Compare the no-fit polygon of a pair, and the inner fit of the second in the first, with exact slices."""
    solid, part, theta = Polygon(*fixed), Polygon(*moving), {"tau": tau}
    expected = exact_slice(PlainScene([moving], [fixed]), tau)
    result = nfp(solid, part, theta)
    assert isinstance(result, NFP)
    assert same(drawn(result, outward=True), expected), (fixed, moving, tau)
    inside = inner_fit(solid, part, theta)
    expected = exact_slice(PlainScene([moving], [], workspace=fixed), tau)
    assert isinstance(inside, InnerFit)
    assert same(drawn(inside, outward=False), expected), ("inner", fixed, moving, tau)


def overlaps_exactly(first: list[list[ExactPoint]], second: list[list[ExactPoint]]) -> bool:
    """True if two polygons overlap: the position 0 is inside of the forbidden slice."""
    scene = exact_slice(PlainScene([(first[0], first[1:])], [(second[0], second[1:])]), Fraction(0))
    return not _is_on(scene) and _winding(scene) > 0


def is_inside_exactly(part: list[list[ExactPoint]], sheet: list[list[ExactPoint]]) -> bool:
    """True if a polygon is inside of a sheet."""
    scene = exact_slice(PlainScene([(part[0], part[1:])], [], workspace=(sheet[0], sheet[1:])), Fraction(0))
    return _is_on(scene) or _winding(scene) < 0


ORIGIN = Fraction(0), Fraction(0)


def _is_on(scene: ExactSlice) -> bool:
    return on_some(ORIGIN, scene.segments) or ORIGIN in scene.points


def _winding(scene: ExactSlice) -> int:
    """Winding number of the rims around the origin."""
    winding = 0
    for (x, y), (u, v) in ends(rims(scene.segments)):
        if (y > 0) != (v > 0):
            is_left = (v - y) * x - (u - x) * y > 0
            winding += (v > y) - (v < y) if (v > y) == is_left else 0
    return winding


def check_layout(nesting: Nesting) -> None:
    """Check by the oracle alone that no two parts overlap, and none is outside of its sheet."""
    shapes = [[[*ring] for ring in shape.exact_rings] for one in nesting.placed for shape in one.shapes]
    sheets = [[[*ring] for ring in sheet.exact_rings] for sheet in nesting.sheets]
    where = [one.sheet for one in nesting.placed]
    for i, j in combinations(range(len(shapes)), 2):
        if where[i] == where[j]:
            assert not overlaps_exactly(shapes[i], shapes[j]), ("overlap", i, j, nesting.placed)
    for k, shape in enumerate(shapes):
        assert is_inside_exactly(shape, sheets[where[k]]), ("outside", k, nesting.placed)


def random_layout(draw: random.Random) -> Nesting:
    """A few random parts on a sheet that may have a slanted side, a hole, or a gap."""
    parts = [
        Part(Polygon(*random_shape(draw, draw.choice([2, 4, 6]), 0.2)), f"part {k}", draw.randint(1, 2))
        for k in range(draw.randint(1, 5))
    ]
    x, y = draw.randint(8, 24), draw.randint(8, 24)
    hole = [[(1, 1), (1, 3), (3, 3), (3, 1)]] if draw.random() < 0.3 else []
    sheet = Polygon([(0, 0), (x, 0), (x - draw.randint(0, 4), y), (0, y)], hole)
    rotations = draw.choice([1, 2, 4, "any", ["30deg", {"tau": "1/3"}]])
    gap = draw.choice([0, 0, 0, "1/4"])
    return place(
        parts, sheet, rotations=rotations, gap=gap, kerf=draw.choice([0, gap]), toward=draw.choice(["bottom", "left"])
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000, help="pairs")
    parser.add_argument("--layouts", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    start = time.perf_counter()
    for k in range(arguments.count):
        draw = random.Random(f"pair {arguments.seed} {k}")
        check_pair(*random_pair(draw), draw.choice(TAUS))
    print(f"{arguments.count} pairs, {time.perf_counter() - start:.0f} s, no difference", flush=True)
    for k in range(arguments.layouts):
        draw = random.Random(f"layout {arguments.seed} {k}")
        check_layout(random_layout(draw))
    print(f"{arguments.layouts} layouts, {time.perf_counter() - start:.0f} s, no overlap", flush=True)


if __name__ == "__main__":
    main()
