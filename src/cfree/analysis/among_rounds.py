"""Numbers among round shapes, such as the largest scale of a robot: bounds by paths and by proofs.

A path is free among the segments and arcs themselves. That there is none is proved with polygons inside of the shapes.
Between these two some numbers stay undecided; then the polygons get finer, as long as that may help.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction

from cfree.analysis.bottleneck import Bottleneck, bottlenecks
from cfree.analysis.inset_shapes import inset_shapes
from cfree.collision.approximations import TOLERANCE, Approximations
from cfree.collision.motion_checker import MotionChecker
from cfree.curves.similar import similar
from cfree.errors import InvalidPoseError, UndecidedError
from cfree.exact.pose import Pose
from cfree.forbidden.boundary import boundary
from cfree.free.space import free_space
from cfree.paths.path import Path
from cfree.planning.caller import Work
from cfree.planning.curved import CurvedQuery
from cfree.planning.options import Options
from cfree.planning.planner import answer_for_one
from cfree.planning.pose_planner import PosePlanner
from cfree.planning.proof import Proof
from cfree.planning.separation import Separated
from cfree.polygons.offset import inset
from cfree.polygons.polygon import Polygon
from cfree.scene.naming import placed
from cfree.scene.scene import AnyShape, Scene, grown_scene, size_of, with_robot, with_shapes

Progress = Callable[[float], object]
BITS = 24  # bits of the numbers that are tried
FARTHEST = 32  # doublings in one step, after 1, 2, 4, 8, 16
WORK = 30_000  # most contact patches trimmed for one number
SMALLEST = 20  # halvings of the robot's size: the least inset that is tried
WIDER = 4  # times that polygons for a bottleneck are made smaller, each time twice as much
PATCHES = 8_000  # most contact patches of polygons that are searched for bottlenecks
TOTAL = 80_000  # contact patches trimmed for all numbers, after which nothing more is decided
SEARCH = 160  # patches that take about as long as searches in vain, for each piece of the robot's boundary
COARSE = 2.0**-8  # first error of the polygons, in robot sizes
FINER = 4  # divisor of that error
NARROW = 4  # part of an interval: what is not undecided counts as narrow
ROUGH = 1024  # parts of a robot's size: error of polygons that tell how deep it is
DEEP = 1 + Fraction(1, 2**10)  # ratio of insets that are tried before a robot vanishes


@dataclass
class Decisions:
    """Answers to one question for many numbers: is there a path for the robot that belongs to a number?

    Parameters
    ----------
    start, goal : Pose
    scenes : callable
        Returns, for a number and the error of polygons in robot sizes, two scenes. A path in the first one answers
        yes, a proof for the second one no; the second may be None. They differ only if polygons replace shapes of the
        robot. A robot without shapes has no scenes: None.

    Attributes
    ----------
    undecided : set of Fraction
        Numbers without an answer, with the polygons of now.
    proofs : dict
        The proof for a number, with the polygons near its scene.
    reason : str
        The reason why a number stayed undecided, at the finest polygons.
    """

    start: Pose
    goal: Pose
    scenes: Callable[[Fraction, float], tuple[Scene, Scene | None] | None]
    undecided: set[Fraction] = field(default_factory=set)
    proofs: dict[Fraction, tuple[Separated, Approximations]] = field(default_factory=dict)
    reason: str = ""
    _error: float = COARSE  # in robot sizes
    _left: int = field(default_factory=lambda: TOTAL)
    _may_help: bool = False  # True if finer polygons may decide a number that is undecided

    def joined(self, number: Fraction) -> bool | None:
        """True if a path exists, False if none does that keeps a distance; None if that stays undecided."""
        self.undecided.discard(number)
        if self._left < 0:
            self.undecided.add(number)
            return None
        pair = self.scenes(number, self._error)
        if pair is None:
            return False
        possible, impossible = pair
        verdict = self._answered(number, possible)
        if impossible is not possible and not verdict:  # a proof for the first scene is none
            verdict = False if impossible and self._answered(number, impossible) is False else None
        if verdict is None:
            self.undecided.add(number)
        return verdict

    def refine(self) -> bool:
        """Make polygons finer, and forget which numbers are undecided; False if that would not help."""
        if not self._may_help or self._left < 0:
            return False
        self._error, self._may_help = self._error / FINER, False
        self.undecided.clear()
        return True

    def _answered(self, number: Fraction, scene: Scene) -> bool | None:
        error, work = self._error * max(map(size_of, scene.robot)), Work(WORK)
        options = Options(improve=0.0, tolerance=error, work=work)

        def ask(planner: PosePlanner, options: Options) -> Path | Proof:
            return answer_for_one(planner, self.start, self.goal, options)

        query = CurvedQuery(Approximations(scene, error), options, thorough=False)
        try:
            answer = query.answer(ask, (self.start, self.goal)) if scene.curved else ask(PosePlanner(scene), options)
        except InvalidPoseError:
            return False
        except UndecidedError as undecided:
            self.reason = f"polygons within {undecided.error:.3g} of the round shapes do not decide the numbers between"
            self._left -= SEARCH * sum(map(_pieces, scene.robot))
            self._may_help |= self._error > TOLERANCE and work.left >= 0
            return None
        finally:
            self._left -= WORK - work.left
        if isinstance(answer, Separated):
            self.proofs[number] = answer, query.near
        return isinstance(answer, Path)


def scale_bounds(
    scene: Scene, start: Pose, goal: Pose, tolerance: float, progress: Progress | None
) -> tuple[float, float, str]:
    """Bound the scale of `cfree.max_scale` among round shapes, and say why the bounds are far apart if they are."""

    def scenes(scale: Fraction, error: float) -> tuple[Scene, Scene]:
        scaled = with_shapes(scene, [similar(shape, scale) for shape in scene.robot])
        return scaled, scaled

    return _largest(Decisions(start, goal, scenes), Fraction(1), tolerance, progress)


def margin_bounds(
    scene: Scene, start: Pose, goal: Pose, tolerance: float, progress: Progress | None
) -> tuple[float, float, str]:
    """Bound the clearance of `cfree.max_margin` among round shapes, and say why the bounds are far apart if they are.

    Raises
    ------
    ValueError
        If no path joins start and goal.
    UndecidedError
        If that is undecided.
    """

    def scenes(radius: Fraction, error: float) -> tuple[Scene, Scene]:
        larger = grown_scene(scene, radius) if radius else scene
        return larger, larger

    size, decisions = max(map(size_of, scene.robot)), Decisions(start, goal, scenes)
    while (joined := decisions.joined(Fraction(0))) is None and decisions.refine():
        pass
    if joined is None:
        raise UndecidedError(f"start and goal: it is undecided if they are joined: {decisions.reason}")
    if not joined:
        raise ValueError("start and goal are not joined without touching; see cfree.nearest_miss")
    return _largest(decisions, Fraction(2) ** (math.frexp(size)[1] - 3), tolerance, progress)


def miss_bounds(
    scene: Scene, start: Pose, goal: Pose, tolerance: float, progress: Progress | None
) -> tuple[float, float, tuple[Bottleneck, ...], str] | None:
    """Bound the inset of `cfree.nearest_miss` among round shapes; say where space opens, and why bounds are far apart.

    Raises
    ------
    ValueError
        If a path joins start and goal without an inset.
    UndecidedError
        If polygons do not decide whether the smallest robot gets there.
    """
    size = max(map(size_of, scene.robot))

    def scenes(by: Fraction, error: float) -> tuple[Scene, Scene | None] | None:
        if not by:
            return scene, scene
        one, other = (inset_shapes(scene.robot, by, error * size, outward=outward) for outward in (True, False))
        if not one:
            return None
        larger = with_shapes(scene, one)
        return larger, larger if one == other else with_shapes(scene, other) if other else None

    decisions = Decisions(start, goal, scenes)

    def apart(by: Fraction) -> bool | None:
        joined = decisions.joined(by)
        return None if joined is None else not joined

    if not apart(Fraction(0)) and not decisions.undecided:
        raise ValueError("start and goal are joined: nothing is missing")
    hi = _deepest(
        lambda by: bool(inset_shapes(scene.robot, by, size / ROUGH, outward=False)), Fraction(2) ** math.frexp(size)[1]
    )
    if not hi:
        raise UndecidedError("the robot: it is so thin that no polygon is inside; give a thicker one")
    while (nothing := apart(hi)) is None and decisions.refine():
        pass
    if nothing is None:
        raise UndecidedError(f"start and goal: it is undecided if the smallest robot gets there: {decisions.reason}")
    if nothing:
        return None
    lo = Fraction(0)
    while not lo:
        step, number = 1, hi
        while not lo and (number := number / 2**step) > size / 2**SMALLEST:
            verdict, step = apart(number), step + 1
            lo, hi = (number, hi) if verdict else (lo, number if verdict is False else hi)
        if not decisions.undecided or not decisions.refine():
            break
    if lo:
        lo, hi = _between(apart, decisions, lo, hi, tolerance, progress)
    wide = hi > lo * (1 + Fraction(tolerance))
    places = _bottlenecks(decisions, lo, hi) if lo else ()
    return float(lo), float(hi), places, decisions.reason if wide and decisions.undecided else ""


def _largest(
    decisions: Decisions, first: Fraction, tolerance: float, progress: Progress | None
) -> tuple[float, float, str]:
    """Bound the largest number for which a path exists, from a first one; a smaller robot counts as easier."""
    lo, hi = _around(decisions, first)
    if lo and hi is not None:
        lo, hi = _between(decisions.joined, decisions, lo, hi, tolerance, progress)
    wide = hi is None or hi > lo * (1 + Fraction(tolerance))
    return float(lo), math.inf if hi is None else float(hi), decisions.reason if wide and decisions.undecided else ""


def _between(
    holds: Callable[[Fraction], bool | None],
    decisions: Decisions,
    lo: Fraction,
    hi: Fraction,
    tolerance: float,
    progress: Progress | None,
) -> tuple[Fraction, Fraction]:
    """Return close numbers: something holds at the first and not at the second, as at `lo` and `hi`."""
    whole = math.log(hi / lo)
    while hi > lo * (1 + Fraction(tolerance)):
        if progress is not None:
            progress(1 - math.log2(1 + math.log(hi / lo) / tolerance) / math.log2(1 + whole / tolerance))
        unknown = [number for number in decisions.undecided if lo < number < hi]
        below, above = min(unknown, default=hi), max(unknown, default=lo)
        ends = (lo, below) if below / lo >= hi / above else (above, hi)
        if unknown and ends[1] / ends[0] - 1 <= max(Fraction(tolerance) / 2, (hi / lo - 1) / NARROW):
            if not decisions.refine():
                break
            continue
        middle = rounded(math.sqrt(ends[0]) * math.sqrt(ends[1]), BITS)
        verdict = holds(middle)
        lo = middle if verdict else lo
        hi = middle if verdict is False else hi
    if progress is not None:
        progress(1.0)
    return lo, hi


def _around(decisions: Decisions, first: Fraction) -> tuple[Fraction, Fraction | None]:
    """Return a number with a path and a larger one without, from growing steps; 0 and None if there is none."""
    verdict = decisions.joined(first)
    lo, hi = first if verdict else Fraction(0), first if verdict is False else None
    step, number = 1, first
    while hi is None and step <= FARTHEST:
        number, step = number * 2**step, 2 * step
        verdict = decisions.joined(number)
        lo, hi = number if verdict else lo, number if verdict is False else None
    step, number = 1, first
    while not lo and step <= FARTHEST:
        number, step = number / 2**step, 2 * step
        verdict = decisions.joined(number)
        lo, hi = number if verdict else lo, number if verdict is False else hi
    return lo, hi


def _deepest(leaves: Callable[[Fraction], bool], size: Fraction) -> Fraction:
    """Return a large inset that leaves something of a robot, within a 2**10th of the largest; 0 if none does."""
    lo, hi = Fraction(0), size
    while (lo or hi > size / 2**SMALLEST) and hi > lo * DEEP:
        middle = (lo + hi) / 2
        lo, hi = (middle, hi) if leaves(middle) else (lo, middle)
    return lo


def _bottlenecks(decisions: Decisions, lo: Fraction, hi: Fraction) -> tuple[Bottleneck, ...]:
    """Return the places where space opens between two insets, for the finest polygons of a proof that are not many."""
    few = [by for by, (proof, near) in decisions.proofs.items() if by <= lo and _patches(proof, near) <= PATCHES]
    if not few:
        return ()
    proof, near = decisions.proofs[max(few)]
    scene = _polygons(proof, near)
    assert scene is not None, "it has patches"
    space = free_space(boundary(scene))
    by = hi - max(few) + 2 * Fraction(max(near.errors))
    for _ in range(WIDER):
        robot = [part for shape in scene.robot for part in inset(shape, by)]
        other = free_space(boundary(with_robot(scene, robot, scene.bounds))) if robot else None
        if other is not None and other.common_cell(decisions.start, decisions.goal) is not None:
            places = bottlenecks(space, other, decisions.start, decisions.goal)
            return tuple(_among(near, place, outward=proof.rounded is not None) for place in places)
        by *= 2
    return ()


def _pieces(shape: AnyShape) -> int:
    """Count the vertices of a polygon, or the pieces of a round shape's path."""
    if isinstance(shape, Polygon):
        return len(shape)
    return len(shape.path) if isinstance(shape.path, tuple) else 1


def _polygons(proof: Separated, near: Approximations) -> Scene | None:
    """Return a scene of polygons without a path: a proof's, or polygons around the shapes; None if there are none."""
    if proof.rounded is None:
        return proof.scene
    with suppress(UndecidedError):
        return near.scene(outward=True)
    return None


def _patches(proof: Separated, near: Approximations) -> int:
    scene = _polygons(proof, near)
    return MotionChecker(scene).features.patches if scene else PATCHES + 1


def _among(near: Approximations, place: Bottleneck, *, outward: bool) -> Bottleneck:
    """Return a bottleneck between polygons as one between the shapes that they replace."""
    one, other = (near.obstacle_of(k, outward=outward) for k in place.obstacles)
    return Bottleneck(place.pose, (one, other), (placed(near.exact, one), placed(near.exact, other)))


def rounded(value: float, bits: int) -> Fraction:
    """Round to a number of few bits."""
    grid = Fraction(2) ** (math.frexp(value)[1] - bits)
    return round(Fraction(value) / grid) * grid
