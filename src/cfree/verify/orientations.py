"""Do some poses at a place stand for every free orientation there? Exact.

The circle is cut where two convex pieces touch, a quarter of it at a time: turned by 2 atan(u), 0 <= u <= 1, the
heights of vertices over edges are polynomials in u. What a pair of pieces forbids is a union of open arcs; what all of
them leave is a union of closed intervals, single orientations among them.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import groupby, pairwise
from typing import TYPE_CHECKING

from flint import fmpz_poly

from cfree.collision.motion import Rotation
from cfree.exact.algebraic import Root, at, between, part, roots, sign
from cfree.exact.half_angle import sum_of_angles
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.verify.course import ALL, Course, Poly, place_of
from cfree.verify.polygons import near

if TYPE_CHECKING:
    from cfree.verify.world import World

QUARTERS = Fraction(0), Fraction(1), None, Fraction(-1)  # half-angle tangents of where they begin
FIRST, LAST = Root.of(Fraction(0)), Root.of(Fraction(1))
Arc = tuple[Root, Root]


def left_out(world: World, place: ExactPoint, poses: Sequence[Pose]) -> tuple[int, int]:
    """How many intervals of free orientations, and how many single ones, none of the poses is in."""
    ends: list[list[Root]] = []  # of each quarter, in order, the first its beginning
    is_covered: list[bool] = []  # of all ends and of the gaps after them, in turn
    for tau in QUARTERS:
        begins_in, arcs = _forbidden(world, Pose(*place, {"tau": tau}))
        found = sorted({FIRST, *(end for arc in arcs for end in arc if end != LAST)})
        number = {end: 2 * k for k, end in enumerate(found)} | {LAST: 2 * len(found)}
        row = [begins_in, *[False] * (2 * len(found) - 1)]
        for first, last in arcs:
            inside = slice(number[first] + 1, number[last])
            row[inside] = [True] * (number[last] - number[first] - 1)
        ends.append(found)
        is_covered += row
    held = {_number(ends, pose) for pose in poses}
    begin = is_covered.index(True) if True in is_covered else 0
    order = [*range(begin, len(is_covered)), *range(begin)]
    runs = [list(run) for covered, run in groupby(order, is_covered.__getitem__) if not covered]
    empty = [run for run in runs if not held & set(run)]
    return sum(len(run) > 1 for run in empty), sum(len(run) == 1 for run in empty)


def _number(ends: list[list[Root]], pose: Pose) -> int:
    """Of the end or gap that an orientation is."""
    before = 0
    for tau, found in zip(QUARTERS, ends, strict=True):
        turned = sum_of_angles(pose.tau, None if tau is None else -tau)
        if turned is not None and 0 <= turned < 1:
            angle = Root.of(turned)
            k = bisect_left(found, angle)
            return before + (2 * k if k < len(found) and found[k] == angle else 2 * k - 1)
        before += 2 * len(found)
    raise AssertionError("an orientation in no quarter")


def _forbidden(world: World, pose: Pose) -> tuple[bool, list[Arc]]:
    """Of a quarter from a pose on: is its beginning forbidden; and open arcs that are."""
    course = Course(place_of(pose, world.scale), Rotation((pose.x, pose.y), {"tau": 1}), world.scale)
    begins_in, arcs = False, list[Arc]()
    for ring in world.parts:
        for k in near(world.obstacle_boxes, course.box(ring, ALL, world.unit)):
            edges = list(course.heights(ring, world.obstacle_pieces[k]))
            begins_in = begins_in or _overlap(edges, FIRST)
            arcs += _arcs(edges)
    return begins_in, arcs


def _arcs(edges: list[list[Poly]]) -> Iterator[Arc]:
    """Where two pieces overlap."""
    found = {FIRST, LAST}
    for height in {height for heights in edges for height in heights}:
        if any(height[1:]):
            found |= {root for root, _ in roots(fmpz_poly(list(height)), FIRST.lo, LAST.lo)}
    first: Root | None = None
    for one, other in pairwise(sorted(found)):
        part(one, other)
        if first is not None and not _overlap(edges, one):
            yield first, one
            first = None
        if first is None and _overlap(edges, Root.of(between(one.hi, other.lo))):
            first = one
    if first is not None:
        yield first, LAST


def _overlap(edges: list[list[Poly]], angle: Root) -> bool:
    """Is a vertex inside every edge?"""
    if angle.lo == angle.hi:
        return all(any(sign(height, angle.lo) > 0 for height in heights) for heights in edges)
    return all(any(at(fmpz_poly(list(height)), angle.value) > 0 for height in heights) for heights in edges)
