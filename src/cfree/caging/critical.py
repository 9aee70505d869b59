"""How far a cage is from opening: spread of the fingers, size and clearance of the body, each with the place.

Every number tried is decided by `is_caged`: the interval has a proof at one end and a path at the other.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, Literal

import numpy as np

from cfree.analysis.inset_shapes import inset_shapes
from cfree.arguments import checked
from cfree.caging.cage import Cage, Progress, cage_of
from cfree.caging.fingers import center_of, spread, to_body, to_fingers
from cfree.curves.similar import similar
from cfree.errors import InvalidPoseError, UndecidedError
from cfree.exact.number import ExactPoint, Number, to_fraction
from cfree.exact.pose import Pose, PoseLike
from cfree.paths.path import Path
from cfree.scene.scene import AnyShape, Scene, box_of, polygons_for, size_of
from cfree.value import Value
from cfree.words import ends

BITS = 6  # the first step away from a cage is 2**-BITS
MOST = 40  # more steps, each twice as long
NEAR = 1.5  # fingers at a narrow place: those at most so many times as far away as the second nearest
SAMPLES = 400  # poses of a path at which fingers are measured
ROUND = 2.0**-10  # error, in shares of the size, of polygons that measure distances


@dataclass(frozen=True, repr=False)
class Puncture:
    """The place at which a body escapes from a cage that has just opened: the puncture of the cage.

    It is measured on the path, and not proved to be the only one.

    Attributes
    ----------
    pose : Pose
        The narrowest pose on the way out, rounded.
    fingers : tuple of int
        The fingers beside the body there, the nearest first.
    distance : float
        Distance of the nearest.
    """

    pose: Pose
    fingers: tuple[int, ...]
    distance: float

    def __str__(self) -> str:
        x, y, theta = float(self.pose.x), float(self.pose.y), math.degrees(self.pose.theta)
        names = " and ".join(f"finger {k}" for k in sorted(self.fingers))
        where = f"between {names}" if len(self.fingers) > 1 else f"past {names}" if names else "freely"
        return f"it passes {where}, at ({x:.4g}, {y:.4g}, {theta:.4g} deg)"

    def __repr__(self) -> str:
        return f"Puncture({self})"


@dataclass(frozen=True, eq=False, repr=False)
class Critical(Value):
    """The number at which a cage opens, between two that are decided.

    Attributes
    ----------
    what : "spread", "size" or "clearance"
    caged : float
        The body is caged there: `cage` has the proof.
    escapes : float or None
        It is not caged there: `opened` has the path. None if it stays caged as far as can be tried; see `end`.
    cage : Cage
    opened : Cage or None
    puncture : Puncture or None
        The place through which it escapes, on that path.
    end : str
        The reason why no escape was found: a finger touches the body, or nothing is left of it; or why the interval is
        wider than the tolerance. Empty otherwise.
    """

    what: Literal["spread", "size", "clearance"]
    caged: float
    escapes: float | None
    cage: Cage
    opened: Cage | None = None
    puncture: Puncture | None = None
    end: str = field(default="")

    def __repr__(self) -> str:
        return f"Critical({self})"

    def __str__(self) -> str:
        if self.escapes is None:
            return f"{self.what} {self.caged:.6g}: still caged; {self.end}"
        one, other = sorted((self.caged, self.escapes))
        low, high = ends(one, other, 6)
        place = f"; {self.puncture}" if self.puncture else ""
        return f"{self.what} {low} to {high}{place}{f' ({self.end})' if self.end else ''}"


@checked
def critical_spread(
    body: Any,
    fingers: Sequence[Any],
    pose: PoseLike = (0, 0, 0),
    *,
    direction: Literal["open", "close"] = "open",
    center: tuple[Number, Number] | None = None,
    tolerance: float = 0.01,
    progress: Progress | None = None,
) -> Critical:
    """Find the spread of the fingers at which a caged body escapes.

    Parameters
    ----------
    body, fingers, pose
        As in `is_caged`; the body is caged.
    direction : "open" or "close"
        Move the fingers apart, or together.
    center : (x, y), optional
        The place that stays: the distance of each finger's middle from it is scaled by the spread, 1 as they are. Their
        shapes stay. By default the mean of the fingers' middles.
    tolerance : float
        Greatest width of the interval.
    progress : callable, optional
        Called with the completed share, from 0 to 1.

    Returns
    -------
    Critical
        The body keeps its pose. If a finger touches it before it escapes, `end` names that finger.

    Raises
    ------
    ValueError
        If it is not caged, or the tolerance is not positive.

    Notes
    -----
    Between 1 and the spread at which it is still caged, steps are tried and not all numbers: the cage may open and
    close again in between.

    Examples
    --------
    >>> square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    >>> found = critical_spread(square, [("1.1", 0), (0, "1.1"), ("-1.1", 0), (0, "-1.1")])
    >>> 1.1 * found.caged <= 2**0.5 <= 1.1 * found.escapes, len(found.puncture.fingers)   # gaps as wide as the side
    (True, 2)
    """
    shapes, start = to_body(body, pose)
    tips = to_fingers(fingers)
    about = _exact(center) if center is not None else _mean(list(map(center_of, tips)))

    def decide(scale: Fraction) -> Cage:
        return cage_of(shapes, spread(tips, scale, about), start, improve=0)

    numbers = _growing(Fraction(1), Fraction(1)) if direction == "open" else _falling()
    return _critical("spread", decide, Fraction(1), numbers, tolerance, progress)


@checked
def critical_size(
    body: Any,
    fingers: Sequence[Any],
    pose: PoseLike = (0, 0, 0),
    *,
    center: tuple[Number, Number] | None = None,
    tolerance: float = 0.01,
    progress: Progress | None = None,
) -> Critical:
    """Find the scale of a caged body at which it is small enough to escape.

    Parameters
    ----------
    body, fingers, pose, tolerance, progress
        As in `critical_spread`.
    center : (x, y), optional
        The point in the body's frame about which it is scaled. By default the middle of its box.

    Returns
    -------
    Critical
        `caged` is a scale of 1 or less, `escapes` a smaller one.

    Examples
    --------
    >>> square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    >>> found = critical_size(square, [(1, 0), (0, 1), (-1, 0), (0, -1)])
    >>> found.escapes <= 2**-0.5 <= found.caged
    True
    """
    shapes, start = to_body(body, pose)
    tips = to_fingers(fingers)
    about = _exact(center) if center is not None else _middle(shapes)

    def decide(scale: Fraction) -> Cage:
        return cage_of(
            tuple(similar(part, scale, ((1 - scale) * about[0], (1 - scale) * about[1])) for part in shapes),
            tips,
            start,
            improve=0,
        )

    return _critical("size", decide, Fraction(1), _falling(), tolerance, progress)


@checked
def critical_clearance(
    body: Any,
    fingers: Sequence[Any],
    pose: PoseLike = (0, 0, 0),
    *,
    tolerance: float = 0.01,
    progress: Progress | None = None,
) -> Critical:
    """Find the clearance at which a caged body escapes: the distance by which its rim moves inwards.

    Parameters
    ----------
    body, fingers, pose, progress
        As in `critical_spread`.
    tolerance : float
        Greatest width of the interval, relative to the body's size.

    Returns
    -------
    Critical
        With `caged` it is still caged, with the larger `escapes` it is not. Corners are mitred; `nearest_miss` answers
        the same question for a start and a goal.

    Examples
    --------
    >>> square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    >>> found = critical_clearance(square, [(1, 0), (0, 1), (-1, 0), (0, -1)])
    >>> found.caged <= 1 - 2**-0.5 <= found.escapes
    True
    """
    shapes, start = to_body(body, pose)
    tips = to_fingers(fingers)
    size = max(map(size_of, shapes))

    def decide(by: Fraction) -> Cage:
        smaller = tuple(inset_shapes(shapes, by, size / 4096, outward=True)) if by else shapes
        if not smaller:
            raise _NothingError("nothing is left of the body")
        return cage_of(smaller, tips, start, improve=0)

    unit = Fraction(2) ** (math.ceil(math.log2(size)) - 1)
    return _critical("clearance", decide, Fraction(0), _growing(Fraction(0), unit), tolerance * size, progress)


class _NothingError(Exception):
    """Nothing is left of the body."""


def _growing(first: Fraction, unit: Fraction) -> Iterator[Fraction]:
    """Yield numbers away from the first one, each step twice as long."""
    for k in range(BITS + MOST):
        yield first + unit * Fraction(2**k, 2**BITS)


def _falling() -> Iterator[Fraction]:
    """Yield numbers from nearly 1 towards 0."""
    for k in range(BITS):
        yield 1 - Fraction(2**k, 2**BITS)
    for k in range(2, MOST):
        yield Fraction(1, 2**k)


def _critical(
    what: Literal["spread", "size", "clearance"],
    decide: Callable[[Fraction], Cage],
    first: Fraction,
    numbers: Iterator[Fraction],
    tolerance: float,
    progress: Progress | None,
) -> Critical:
    """Step away from a cage until it opens, and bisect."""
    if not 0 < tolerance < math.inf:
        raise ValueError(f"tolerance {tolerance}: give a number above 0")
    cage = decide(first)
    if not cage:
        raise ValueError("the body is not caged, so that nothing opens; is_caged has its path out")
    tell = progress or (lambda _: None)
    lo, hi, opened, end = first, None, None, "it stays caged at all numbers that were tried"
    while hi is None or abs(hi - lo) > tolerance:
        middle = next(numbers, None) if hi is None else (lo + hi) / 2
        if middle is None:
            break
        tell(0.0 if hi is None else 1 / (1 + float(abs(hi - lo)) / tolerance))
        try:
            result = decide(middle)
        except (InvalidPoseError, _NothingError) as error:
            hi, opened, end = middle, None, str(error).split(";")[0]
            continue
        except UndecidedError as error:
            end = f"at {float(middle):.6g} {error}"
            break
        if result:
            cage, lo = result, middle
        else:
            hi, opened, end = middle, result, ""
    tell(1.0)
    if opened is None or hi is None:
        return Critical(what, float(lo), None, cage, None, None, end)
    return Critical(what, float(lo), float(hi), cage, opened, puncture(opened, cage), end)


# --- places ---


def puncture(opened: Cage, cage: Cage | None = None) -> Puncture | None:
    """Return the narrowest place of the path of an open cage, measured at samples: between its two nearest fingers.

    With `cage` only its fingers that hold the body count.
    """
    import shapely

    from cfree.planning.plan import plan

    path = opened.path
    if path is None:
        return None
    wider = plan(opened.scene, opened.pose, path.goal)
    path = wider if isinstance(wider, Path) else path
    shapes = _outlines(opened.scene)
    chosen = [k for k in range(len(shapes)) if cage is None or not cage.holding or k in cage.holding]
    if not chosen:
        return None
    parts = [polygon for part in opened.body for polygon in polygons_for(part, ROUND * size_of(part), True)]
    outline = shapely.union_all([polygon.to_shapely() for polygon in parts])
    poses = (
        [path.at(Fraction(k * len(path.motions), SAMPLES)) for k in range(SAMPLES + 1)]
        if path.motions
        else [path.start]
    )
    best: tuple[float, Puncture] | None = None
    for pose in poses:
        c, s = math.cos(pose.theta), math.sin(pose.theta)
        placed = shapely.transform(outline, lambda p, c=c, s=s, pose=pose: p @ np.array([[c, s], [-s, c]])
                                   + (float(pose.x), float(pose.y)))  # fmt: skip
        distances = sorted((float(placed.distance(shapes[k])), k) for k in chosen)
        second = distances[min(1, len(distances) - 1)][0]
        if best is None or second < best[0]:
            beside = tuple(k for distance, k in distances if distance <= NEAR * second + 1e-12)[:3]
            best = second, Puncture(pose, beside, distances[0][0])
    return best and best[1]


def _outlines(scene: Scene) -> list[Any]:
    import shapely

    return [
        shapely.union_all([p.to_shapely() for p in polygons_for(shape, ROUND * size_of(shape), True)])
        for shape in scene.obstacles
    ]


def _exact(point: tuple[Number, Number]) -> ExactPoint:
    x, y = map(to_fraction, point)
    return x, y


def _mean(points: Sequence[ExactPoint]) -> ExactPoint:
    count = max(1, len(points))
    return sum((x for x, _ in points), Fraction(0)) / count, sum((y for _, y in points), Fraction(0)) / count


def _middle(shapes: Sequence[AnyShape]) -> ExactPoint:
    """Return the middle of the box around shapes."""
    x0, y0, x1, y1 = zip(*map(box_of, shapes), strict=True)
    return Fraction((min(x0) + max(x1)) / 2), Fraction((min(y0) + max(y1)) / 2)
