"""Margins of the robot between two poses: the smallest inset that joins them, the largest scale and clearance.

All are found by bisection over exact decisions: start and goal are in one cell of a scene with another robot, or not.
So both ends of an interval are proved, each for the polygons that were decided. Then a few rational numbers between are
tried: see `exact_values`. Of a disc the number is computed instead: see `planning.widest_way`. Among other round shapes
a path is searched on these, and polygons inside of them prove that there is none; see `among_rounds`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction

from cfree.analysis.among_rounds import FARTHEST, Progress, margin_bounds, miss_bounds, rounded, scale_bounds
from cfree.analysis.bottleneck import Bottleneck, bottlenecks
from cfree.analysis.exact_values import (
    exact_value,
    only_touches,
    shrinks_into_itself,
    widths_and_gaps,
)
from cfree.analysis.inset_shapes import exact_inset
from cfree.arguments import checked
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose, PoseLike
from cfree.exact.surd import Surd
from cfree.forbidden.boundary import boundary
from cfree.free.space import FreeSpace, free_space
from cfree.planning.separation import Insets
from cfree.planning.widest_way import NarrowPlace, WidestWay, widest_way
from cfree.polygons.offset import inset
from cfree.polygons.polygon import Polygon
from cfree.scene.dilation import FARTHEST_OUT, grown
from cfree.scene.scene import Scene, grown_scene, required, with_robot, with_shapes

BITS = 16  # bits of the numbers that are tried
BITS_OF_INSET = 48


@dataclass(frozen=True, repr=False)
class Interval:
    """Two numbers with a proof for each: the number sought is between them.

    Attributes
    ----------
    lo, hi : float
        If the number is known exactly, the doubles next to it, or twice itself.
    undecided : str
        The reason why they are farther apart than the tolerance, among round shapes; empty if they are not.
    exact : Surd or None
        The number sought itself, if it is known. Only a path that touches belongs to it.
    at : NarrowPlace or None
        The place that decides it: of a disc.
    """

    lo: float
    hi: float
    undecided: str = field(default="", compare=False)
    exact: Surd | None = None
    at: NarrowPlace | None = field(default=None, compare=False)

    def __repr__(self) -> str:
        why = f", undecided={self.undecided!r}" if self.undecided else ""
        known = "" if self.exact is None else f", exact={self.exact}"
        where = "" if self.at is None else f", {self.at}"
        return f"Interval(lo={self.lo!r}, hi={self.hi!r}{why}{known}{where})"


@dataclass(frozen=True)
class NearestMiss:
    """The smallest inset of the robot with which a motion from start to goal exists.

    Attributes
    ----------
    lo, hi : float
        With an inset of `lo` there is still no path that keeps a distance, with one of `hi` there is. `lo` is 0 if no
        inset that was tried is too small. If the inset is known exactly, they are the doubles next to it.
    undecided : str
        The reason why `lo` and `hi` are farther apart than the tolerance, among round shapes; empty if they are not.
    exact : Surd or None
        The inset itself, if it is known: with it only a path that touches exists.
    bottlenecks : tuple of Bottleneck
        Places where space opens between the two, in order from start to goal. May be empty: an inset is decided
        exactly, but its places are searched by samples.
    """

    lo: float
    hi: float
    bottlenecks: tuple[Bottleneck, ...]
    undecided: str = field(default="", compare=False)
    exact: Surd | None = None

    def __str__(self) -> str:
        size = f"an inset of {self.lo:.4g} to {self.hi:.4g} would do{f' ({self.undecided})' if self.undecided else ''}"
        if self.exact is not None:
            size = f"an inset of exactly {self.exact} would just do"
        if not self.bottlenecks:
            return size
        places = "; ".join(f"between {place}" for place in self.bottlenecks)
        return f"{size}: about {2 * self.hi:.2g} too wide {places}"


@checked
def nearest_miss(
    scene: Scene,
    start: PoseLike | None = None,
    goal: PoseLike | None = None,
    tolerance: float = 0.01,
    progress: Progress | None = None,
) -> NearestMiss | None:
    """Find the smallest inset of the robot that joins two separated poses, and the places where space opens.

    Parameters
    ----------
    scene : Scene
    start, goal : Pose or (x, y, theta), optional
        By default those of the scene.
    tolerance : float
        Greatest width of the interval, relative to its ends.
    progress : callable, optional
        Called with the completed share, from 0 to 1.

    Returns
    -------
    NearestMiss, or None if no inset that leaves something of the robot joins them

    Raises
    ------
    ValueError
        If a path that keeps a distance joins them without an inset, or the tolerance is not positive; among round
        shapes also if a path that touches joins them.
    UndecidedError
        If polygons near round shapes do not decide whether the smallest robot gets there.

    Notes
    -----
    All edges move inwards by the inset, corners are mitred; parts that are too thin vanish.
    It takes about a dozen times as long as the scene's free space.

    Arcs keep their centers. Among segments and arcs the path at `hi` is free for the shapes themselves, and polygons
    inside of them prove that there is none at `lo`. Round shapes of the robot with curves other than arcs, or with
    irrational corners, are replaced by polygons first: by ones around them for the path, and inside for the proof.

    Examples
    --------
    >>> walls = [[(-9, -1), (-1, -1), (-1, 1), (-9, 1)], [(1, -1), (9, -1), (9, 1), (1, 1)]]
    >>> box = [(-9, -9), (9, -9), (9, 9), (-9, 9)]
    >>> square = [(-1.25, -1.25), (1.25, -1.25), (1.25, 1.25), (-1.25, 1.25)]
    >>> scene = Scene(square, walls, workspace=box)
    >>> miss = nearest_miss(scene, (0, 5, 0), (0, -5, 0))
    >>> str(miss.exact), sorted(miss.bottlenecks[0].obstacles)
    ('1/4', [0, 1])
    """
    start, goal = required(scene, start, goal)
    check_tolerance(tolerance)
    if scene.curved:
        if way := widest_way(scene, start, goal):
            return _miss_of_disc(way)
        miss = miss_bounds(scene, start, goal, tolerance, progress)
        if miss is None:
            return None
        below, above, places, why = miss
        exact = _miss_between(scene, Fraction(below), Fraction(above), (start, goal)) if below else None
        if exact is not None:
            return NearestMiss(*exact.floats_around, places, exact=exact)
        return NearestMiss(below, above, places, why)
    if _space(scene).common_cell(start, goal) is not None:
        raise ValueError("start and goal are joined: nothing is missing")
    spaces: dict[Fraction, FreeSpace | None] = {}

    def smaller_robot(by: Fraction) -> list[Polygon]:
        return [smaller for part in scene.robot for smaller in inset(part, by)]

    def separated(by: Fraction) -> bool:
        robot = smaller_robot(by)
        spaces[by] = _space(with_robot(scene, robot, scene.bounds)) if robot else None
        space = spaces[by]
        return space is None or space.common_cell(start, goal) is None

    known = Insets(scene)
    most = deepest(smaller_robot, Fraction(2) ** known.size)
    if not most or separated(most):
        return None
    insets = [by for power in known.powers if (by := Fraction(2) ** (known.size + power)) < most]
    least = next(filter(separated, insets), None)
    if least is None:
        if only_touches(scene, start, goal):
            return NearestMiss(0.0, 0.0, (), exact=Surd(0))
        return NearestMiss(0.0, float(min([*insets, most])), ())
    lo, hi = bisected(separated, least, most, tolerance, progress)
    one, other = spaces[lo], spaces[hi]
    if one is None or other is None:
        return NearestMiss(0.0, float(hi), ())
    exact = _miss_between(scene, lo, hi, (start, goal))
    below, above = (float(lo), float(hi)) if exact is None else exact.floats_around
    return NearestMiss(below, above, bottlenecks(one, other, start, goal), exact=exact)


@checked
def max_scale(
    scene: Scene,
    start: PoseLike | None = None,
    goal: PoseLike | None = None,
    tolerance: float = 0.01,
    progress: Progress | None = None,
) -> Interval:
    """Find the largest scale of the robot about its reference point at which a motion exists.

    Parameters
    ----------
    scene, start, goal, tolerance, progress
        As in `nearest_miss`.

    Returns
    -------
    Interval
        At scale `lo` a path that keeps a distance joins them; at `hi` none does, or an end pose is forbidden. The scale
        of an exact fit, which a path that touches may pass, is between the two. `hi` is infinite if a path exists for a
        robot 2**63 times as large, `lo` is 0 if none exists for one 2**63 times smaller.

    Notes
    -----
    If the robot is star-shaped about its reference point, a smaller one is inside it, and a path exists at all scales
    below `lo`. Else it may not exist at some of them.

    Among segments and arcs the path at `lo` is one on the shapes themselves, which may touch; a proof at `hi` uses
    polygons inside of them. Among other curves both use polygons. `Interval.undecided` tells why an interval is wider
    than the tolerance.

    Examples
    --------
    >>> walls = [[(-9, -1), (-1, -1), (-1, 1), (-9, 1)], [(1, -1), (9, -1), (9, 1), (1, 1)]]
    >>> scene = Scene([(-1, -1), (1, -1), (1, 1), (-1, 1)], walls, workspace=[(-9, -9), (9, -9), (9, 9), (-9, 9)])
    >>> found = max_scale(scene, (0, 5, 0), (0, -5, 0))
    >>> found
    Interval(lo=1.0, hi=1.0, exact=1)
    """
    start, goal = required(scene, start, goal)
    check_tolerance(tolerance)
    if scene.curved:
        way = widest_way(scene, start, goal)
        if way and not any(way.center):
            return _known(None if way.radius is None else way.radius / way.disc.radius, way.at)
        return Interval(*scale_bounds(scene, start, goal, tolerance, progress))

    def scaled(scale: Fraction) -> Scene:
        robot = [_mapped(part, lambda p: (scale * p[0], scale * p[1])) for part in scene.robot]
        return with_robot(scene, robot, scene.bounds)

    def is_joined(scale: Fraction) -> bool:
        return _space(scaled(scale)).common_cell(start, goal) is not None

    lo, hi = bracket(is_joined, Fraction(1))
    if lo and hi:
        lo, hi = bisected(is_joined, lo, hi, tolerance, progress)
        if shrinks_into_itself(scene.robot):
            likely = (gap / width for width, gap in widths_and_gaps(scene))
            exact = exact_value(scaled, lo, hi, likely, (start, goal))
            if exact is not None:
                return _known(exact)
    return Interval(float(lo), float(hi) if hi else math.inf)


@checked
def max_margin(
    scene: Scene,
    start: PoseLike | None = None,
    goal: PoseLike | None = None,
    tolerance: float = 0.01,
    progress: Progress | None = None,
) -> Interval:
    """Find the largest clearance from obstacles and workspace that a whole motion can keep.

    Parameters
    ----------
    scene, start, goal, tolerance, progress
        As in `nearest_miss`.

    Returns
    -------
    Interval
        Some path has a clearance of `lo` all along, start and goal included; none has `hi`. The decision replaces a
        disc by a polygon of 16 sides around it, 2 % too wide at the corners; the interval includes this. `hi` is
        infinite if nothing is in the way. Among round shapes the disc stays one, and the interval is as that of
        `max_scale`.

    Raises
    ------
    ValueError
        If start and goal are not joined at all.
    UndecidedError
        If polygons near round shapes do not decide whether they are.

    Notes
    -----
    The robot grows by Minkowski sums of its convex pieces with the polygon, in fractions, and then has many vertices.

    Examples
    --------
    >>> walls = [[(-9, -1), (-1, -1), (-1, 1), (-9, 1)], [(1, -1), (9, -1), (9, 1), (1, 1)]]
    >>> scene = Scene([(0, 0), ("1/2", 0), (0, "1/2")], walls, workspace=[(-9, -9), (9, -9), (9, 9), (-9, 9)])
    >>> found = max_margin(scene, (0, 5, 0), (0, -5, 0), tolerance=0.05)
    >>> found.lo < 1 - 2**0.5 / 8 < found.hi < 1.08 * found.lo      # the triangle's height is 2**0.5 / 4
    True
    >>> from cfree.curves.curved import Curved
    >>> posts = [Curved.circle(p, 1) for p in ((0, 0), (3, 2))]
    >>> scene = Scene(Curved.circle((0, 0), "1/2"), posts, workspace=[(-2, -2), (5, -2), (5, 5), (-2, 5)])
    >>> found = max_margin(scene, ("-1/2", "7/2", 0), ("7/2", "-1/2", 0))
    >>> print(found.exact)
    -3/2 + 1/2 sqrt(13)
    >>> print(found.at)
    between obstacle 0, 2 x 2 at (0, 0) and obstacle 1, 2 x 2 at (3, 2) at (1.5, 1)
    """
    start, goal = required(scene, start, goal)
    check_tolerance(tolerance)
    if scene.curved:
        if way := widest_way(scene, start, goal):
            if way.margin is not None and way.margin < 0:
                raise ValueError("start and goal are not joined without touching; see cfree.nearest_miss")
            return _known(way.margin, way.at)
        below, above, why = margin_bounds(scene, start, goal, tolerance, progress)
        if below and above < math.inf:
            exact = _margin_between(scene, Fraction(below), Fraction(above), (start, goal))
            if exact is not None:
                return _known(exact)
        return Interval(below, above, why)
    if _space(scene).common_cell(start, goal) is None:
        raise ValueError("start and goal are not joined without touching; see cfree.nearest_miss")

    def is_joined(radius: Fraction) -> bool:
        return _space(with_robot(scene, grown(scene, radius), scene.bounds)).common_cell(start, goal) is not None

    lo, hi = bracket(is_joined, Fraction(2) ** (Insets(scene).size - 3))
    if lo and hi:
        lo, hi = bisected(is_joined, lo, hi, tolerance, progress)
        exact = _margin_between(scene, lo, hi * Fraction(FARTHEST_OUT), (start, goal))
        if exact is not None:
            return _known(exact)
    return Interval(float(lo), math.nextafter(float(hi) * FARTHEST_OUT, math.inf) if hi else math.inf)


# --- known numbers ---


def _known(number: Surd | None, at: NarrowPlace | None = None) -> Interval:
    """Return a number that is known; None is infinite."""
    if number is None:
        return Interval(math.inf, math.inf)
    return Interval(*number.floats_around, exact=number, at=at)


def _miss_of_disc(way: WidestWay) -> NearestMiss | None:
    """Return the smallest inset of a disc."""
    if way.margin is None or way.margin >= 0:
        raise ValueError("start and goal are joined: nothing is missing")
    if way.radius == 0:
        return None
    exact, places = -1 * way.margin, tuple[Bottleneck, ...]()
    if way.at and not way.at.end:
        (x, y), (u, v) = way.at.point, map(float, way.center)
        (one, other), (name, other_name) = way.at.obstacles, way.at.names
        places = (Bottleneck(Pose(x - u, y - v), (one, other), (name, other_name)),)
    return NearestMiss(*exact.floats_around, places, exact=exact)


def _miss_between(scene: Scene, lo: Fraction, hi: Fraction, ends: tuple[Pose, Pose]) -> Surd | None:
    """Return the smallest inset, if it is one of those tried."""

    def smaller(by: Fraction) -> Scene | None:
        robot = [exact_inset(shape, by) for shape in scene.robot]
        parts = [part for part in robot if part is not None]
        return with_shapes(scene, parts) if len(parts) == len(robot) else None

    return exact_value(smaller, lo, hi, ((width - gap) / 2 for width, gap in widths_and_gaps(scene)), ends)


def _margin_between(scene: Scene, lo: Fraction, hi: Fraction, ends: tuple[Pose, Pose]) -> Surd | None:
    """Return the largest clearance, if it is one of those tried."""
    likely = ((gap - width) / 2 for width, gap in widths_and_gaps(scene))
    return exact_value(lambda radius: grown_scene(scene, radius), lo, hi, likely, ends)


# --- decisions ---


def deepest(smaller_robot: Callable[[Fraction], list[Polygon]], size: Fraction) -> Fraction:
    """Return the largest inset that leaves something of a robot, within 2**-BITS_OF_INSET of its size; 0 for none."""
    lo, hi = Fraction(0), size
    for _ in range(BITS_OF_INSET):
        middle = (lo + hi) / 2
        lo, hi = (middle, hi) if smaller_robot(middle) else (lo, middle)
    return lo


def check_tolerance(tolerance: float) -> None:
    """Raise a ValueError if bisection cannot reach a tolerance."""
    if not 2.0 ** (2 - BITS) < tolerance < math.inf:
        raise ValueError(f"tolerance {tolerance}: give a number, more than {2.0 ** (2 - BITS):g}")


def _space(scene: Scene) -> FreeSpace:
    return free_space(boundary(scene))


def bracket(holds: Callable[[Fraction], bool], first: Fraction) -> tuple[Fraction, Fraction]:
    """Return a number where something holds and a larger one where it does not, from growing steps; 0 for none."""
    step = 1
    if holds(first):
        lo = first
        while step <= FARTHEST:
            hi = lo * 2**step
            if not holds(hi):
                return lo, hi
            lo, step = hi, 2 * step
        return lo, Fraction(0)
    hi = first
    while step <= FARTHEST:
        lo = hi / 2**step
        if holds(lo):
            return lo, hi
        hi, step = lo, 2 * step
    return Fraction(0), hi


def bisected(
    holds: Callable[[Fraction], bool], lo: Fraction, hi: Fraction, tolerance: float, progress: Progress | None
) -> tuple[Fraction, Fraction]:
    """Return close numbers with the property of `lo` and `hi`: something holds at the first, not at the second."""
    whole = math.log(hi / lo)
    while hi > lo * (1 + Fraction(tolerance)):
        if progress is not None:
            progress(1 - math.log2(1 + math.log(hi / lo) / tolerance) / math.log2(1 + whole / tolerance))
        middle = rounded(math.sqrt(lo) * math.sqrt(hi), BITS)
        lo, hi = (middle, hi) if holds(middle) else (lo, middle)
    if progress is not None:
        progress(1.0)
    return lo, hi


# --- robots ---


def _mapped(polygon: Polygon, image: Callable[[ExactPoint], ExactPoint]) -> Polygon:
    outer, *holes = ([image(p) for p in ring] for ring in polygon.exact_rings)
    return Polygon(outer, holes)
