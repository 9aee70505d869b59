"""Poses at a place that stand for every free orientation there. Exact.

The circle is cut where two convex pieces touch, a quarter of it at a time: turned by 2 atan(u), 0 <= u <= 1, the
heights of vertices over edges are polynomials in u. A pair of pieces forbids a union of open arcs; all of them leave a
union of closed intervals, single orientations among them.
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

QUARTERS = Fraction(0), Fraction(1), None, Fraction(-1)  # half-angle tangents of their beginnings
FIRST, LAST = Root.of(Fraction(0)), Root.of(Fraction(1))
Arc = tuple[Root, Root]


def left_out(world: World, place: ExactPoint, poses: Sequence[Pose]) -> tuple[int, int]:
    """Number of intervals of free orientations, and of single ones, that hold none of the poses."""
    ends: list[list[Root]] = []  # for each quarter, in order, the first its beginning
    is_covered: list[bool] = []  # for all ends and the gaps after them, in turn
    for tau in QUARTERS:
        begins_in, arcs = _forbidden(world, Pose(*place, {"tau": tau}))
        angles = sorted({FIRST, *(end for arc in arcs for end in arc if end != LAST)})
        number = {end: 2 * k for k, end in enumerate(angles)} | {LAST: 2 * len(angles)}
        row = [begins_in, *[False] * (2 * len(angles) - 1)]
        for first, last in arcs:
            inside = slice(number[first] + 1, number[last])
            row[inside] = [True] * (number[last] - number[first] - 1)
        ends.append(angles)
        is_covered += row
    held = {_number(ends, pose) for pose in poses}
    begin = is_covered.index(True) if True in is_covered else 0
    order = [*range(begin, len(is_covered)), *range(begin)]
    runs = [list(run) for covered, run in groupby(order, is_covered.__getitem__) if not covered]
    empty = [run for run in runs if not held & set(run)]
    return sum(len(run) > 1 for run in empty), sum(len(run) == 1 for run in empty)


def _number(ends: list[list[Root]], pose: Pose) -> int:
    """Number of the end or gap that holds an orientation."""
    before = 0
    for tau, angles in zip(QUARTERS, ends, strict=True):
        turned = sum_of_angles(pose.tau, None if tau is None else -tau)
        if turned is not None and 0 <= turned < 1:
            angle = Root.of(turned)
            k = bisect_left(angles, angle)
            return before + (2 * k if k < len(angles) and angles[k] == angle else 2 * k - 1)
        before += 2 * len(angles)
    raise AssertionError("an orientation in no quarter")


def _forbidden(world: World, pose: Pose) -> tuple[bool, list[Arc]]:
    """Return, for the quarter turn from a pose on: True if its beginning is forbidden, and its open forbidden arcs."""
    course = Course(place_of(pose, world.scale), Rotation((pose.x, pose.y), {"tau": 1}), world.scale)
    begins_in, arcs = False, list[Arc]()
    for ring in world.parts:
        for k in near(world.obstacle_boxes, course.box(ring, ALL, world.unit)):
            edges = list(course.heights(ring, world.obstacle_pieces[k]))
            begins_in = begins_in or _overlap(edges, FIRST)
            arcs += _arcs(edges)
    return begins_in, arcs


def _arcs(edges: list[list[Poly]]) -> Iterator[Arc]:
    """Open arcs in which two pieces overlap."""
    angles = {FIRST, LAST}
    for height in {height for heights in edges for height in heights}:
        if any(height[1:]):
            angles |= {root for root, _ in roots(fmpz_poly(list(height)), FIRST.lo, LAST.lo)}
    first: Root | None = None
    for one, other in pairwise(sorted(angles)):
        part(one, other)
        if first is not None and not _overlap(edges, one):
            yield first, one
            first = None
        if first is None and _overlap(edges, Root.of(between(one.hi, other.lo))):
            first = one
    if first is not None:
        yield first, LAST


def _overlap(edges: list[list[Poly]], angle: Root) -> bool:
    """True if a vertex is inside every edge."""
    if angle.lo == angle.hi:
        return all(any(sign(height, angle.lo) > 0 for height in heights) for heights in edges)
    return all(any(at(fmpz_poly(list(height)), angle.value) > 0 for height in heights) for heights in edges)
