"""How a part fits into a hole: all orientations at which it does, exact fits included.

The part is a robot whose workspace is the hole. At an orientation at which it fits the free positions are a closed and
bounded set; a pose on its rim is on a trapezoid of the boundary or on an isolated part. So the orientations are those
of all trapezoids and isolated parts: closed intervals, united by the exact order of their ends.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, cmp_to_key
from typing import Any

from cfree.exact.algebraic import Root, between
from cfree.exact.algebraic import part as set_apart
from cfree.exact.angle_interval import AlgebraicAngle, AngleInterval
from cfree.exact.half_angle import normalize_angles, tau_in_chart
from cfree.exact.pose import Pose
from cfree.forbidden.boundary import Boundary, boundary
from cfree.forbidden.columns import Trapezoids
from cfree.scene.scene import Scene, polygons_of
from cfree.verify.isolated import IsolatedPart
from cfree.verify.surfaces import Turn
from cfree.verify.trapezoids import Reader


@dataclass(frozen=True)
class Fit:
    """Neighbouring orientations at which a part fits.

    Attributes
    ----------
    orientations : AngleInterval
    place : (x, y, theta)
        A position at one of them, rounded.
    pose : Pose or None
        The same, exactly, and free; None if it is not rational: at a single orientation with an irrational tangent.
    """

    orientations: AngleInterval
    place: tuple[float, float, float]
    pose: Pose | None


def fits(part: Any, hole: Any) -> tuple[Fit, ...]:
    """All orientations at which a part fits into a hole, touching allowed, each interval with a position.

    Parameters
    ----------
    part : shape or sequence of shapes
        As the robot of a `Scene`: it is turned about the origin, then moved.
    hole : shape
        One polygon, all of which is free: the part has to be inside. Holes in it are forbidden.

    Returns
    -------
    tuple of Fit
        Disjoint closed intervals, counter-clockwise; empty if it does not fit.

    Raises
    ------
    InvalidPolygonError
        If a shape is not a polygon.

    Notes
    -----
    That of `boundary`, and about a millisecond for each critical angle that doubles do not order. At a given
    orientation the part may fit in several places; `free_space` tells which of them are connected.

    Examples
    --------
    A square into itself, and into one a hundredth wider:

    >>> import math
    >>> square, wider = ([(0, 0), (c, 0), (c, c), (0, c)] for c in (1, "1.01"))
    >>> [(fit.orientations.is_single, round(math.degrees(fit.place[2]))) for fit in fits(square, square)]
    [(True, 0), (True, 90), (True, 180), (True, 270)]
    >>> first = fits(square, wider)[0]
    >>> [round(math.degrees(theta), 4) for theta in first.orientations.theta], first.pose is not None
    ([89.4241, 90.5759], True)
    >>> fits(wider, square)
    ()
    """
    scene = Scene(polygons_of(part, "part"), workspace=polygons_of(hole, "hole"))
    return Orientations(boundary(scene)).fits()


@dataclass(frozen=True, eq=False)
class _End:
    """One end, in angle, of a trapezoid or an isolated part."""

    reader: Reader
    columns: Trapezoids
    row: int
    side: str
    chart: int
    lo: float
    hi: float

    @cached_property
    def root(self) -> Root:
        patches = getattr(self.columns, f"{self.side}_patch", self.columns.patch)
        return self.reader.angle(self.columns, self.row, self.side, int(patches[self.row]))


def _compare(p: _End, q: _End) -> int:
    """Order of two angles from the beginning of chart 0 on; the end of chart 0 is the beginning of chart 1."""
    if p.chart != q.chart:
        early, late = (p, q) if p.chart == 0 else (q, p)
        if early.lo == 1 and late.hi == -1:
            return 0
        return -1 if p is early else 1
    if p.hi < q.lo or q.hi < p.lo:
        return -1 if p.hi < q.lo else 1
    if p.lo == p.hi == q.lo == q.hi:
        return 0
    return (p.root > q.root) - (p.root < q.root)


@dataclass(eq=False)
class _Run:
    start: _End
    stop: _End
    widest: _End  # start of its widest trapezoid or isolated part
    width: float


class Orientations:
    """Those at which some position is free, where positions are bounded."""

    def __init__(self, of: Boundary) -> None:
        of.require_complete()
        self.boundary = of
        contacts = of.contact_kind, of.contact_robot, of.contact_obstacle
        self.reader = Reader(of.scene, contacts, of.trapezoids, of.isolated)

    def fits(self) -> tuple[Fit, ...]:
        found = [Fit(self._interval(run), *self._place(run.widest)) for run in self._runs()]
        return tuple(sorted(found, key=lambda fit: fit.orientations.theta))

    def _ends(self, columns: Trapezoids) -> Iterator[tuple[_End, _End]]:
        names = ("chart", "from_lo", "from_hi", "to_lo", "to_hi")
        values: list[list[Any]] = [getattr(columns, name).tolist() for name in names]
        for k, (chart, a, b, c, d) in enumerate(zip(*values, strict=True)):
            start = _End(self.reader, columns, k, "from", chart, a, b)
            yield start, _End(self.reader, columns, k, "to", chart, c, d)

    def _runs(self) -> list[_Run]:
        """Unions of intervals that meet."""
        spans = [*self._ends(self.boundary.trapezoids), *self._ends(self.boundary.isolated)]
        key = cmp_to_key(_compare)
        spans.sort(key=lambda span: key(span[0]))
        runs: list[_Run] = []
        for start, stop in spans:
            if not runs or _compare(runs[-1].stop, start) < 0:
                runs.append(_Run(start, stop, start, -math.inf))
            run, width = runs[-1], stop.lo - start.hi
            if _compare(run.stop, stop) < 0:
                run.stop = stop
            if width > run.width:
                run.widest, run.width = start, width
        if len(runs) > 1 and _is_wall(runs[0].start, 0, -1) and _is_wall(runs[-1].stop, 1, 1):
            last = runs.pop()
            runs[0].start = last.start
            if last.width > runs[0].width:
                runs[0].widest = last.widest
        return runs

    def _interval(self, run: _Run) -> AngleInterval:
        if _is_wall(run.start, 0, -1) and _is_wall(run.stop, 1, 1):
            return AngleInterval(None, None)
        return AngleInterval(*(AlgebraicAngle(end.chart, end.root) for end in (run.start, run.stop)))

    def _place(self, start: _End) -> tuple[tuple[float, float, float], Pose | None]:
        """A position at an angle of a trapezoid or an isolated part: in the midst of the slice if that is free."""
        if start.columns is self.boundary.trapezoids:
            trapezoid = self.reader.trapezoid(start.row)
            turn = trapezoid.turn()
            t = (trapezoid.lower.at(turn.tau) + trapezoid.upper.at(turn.tau)) / 2
            point = turn.line(trapezoid.surface).point(t)
        else:
            isolated = IsolatedPart(self.reader, start.row)
            root = isolated.start
            if root < isolated.stop:
                set_apart(root, isolated.stop)
                root = Root.of(between(root.hi, isolated.stop.lo))
            turn = Turn(isolated.chart, root)
            _, point = isolated.end(turn, root, isolated.lower)
        if not isinstance(turn.tau, Fraction):
            x, y, theta = self.boundary.isolated_part(start.row).ends[0]
            return (x, y, float(normalize_angles(theta))), None
        unit = self.reader.world.scale * turn.w
        angle = {"tau": tau_in_chart(turn.chart, turn.tau)}
        exact = Pose(Fraction(point[0]) / unit, Fraction(point[1]) / unit, angle)
        segments = self.boundary.slice(angle).segments
        middle = exact
        if len(segments):
            middle = Pose(float(segments[..., 0].mean()), float(segments[..., 1].mean()), angle)
        pose = middle if self.boundary.checker.is_free(middle) else exact
        return (float(pose.x), float(pose.y), pose.theta), pose


def _is_wall(end: _End, chart: int, tau: int) -> bool:
    return (end.chart, end.lo, end.hi) == (chart, tau, tau)
