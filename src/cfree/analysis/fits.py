"""Fits of a part in a hole: all orientations at which it fits, exact fits included.

The part is a robot whose workspace is the hole. At an orientation at which it fits, the free positions are a closed and
bounded set. A pose on the rim of this set is on a trapezoid of the boundary or on an isolated part. So the orientations
are those of all trapezoids and isolated parts: closed intervals, united by the exact order of their ends.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np

import cfree._core as _core
from cfree.collision.nearest_free import centers
from cfree.contact.contact_lines import contact_lines, crossings
from cfree.exact.algebraic import between, part
from cfree.exact.angle_interval import AlgebraicAngle, AngleInterval
from cfree.exact.half_angle import normalize_angles, tau_in_chart, theta_in
from cfree.exact.pose import Pose, pose_at
from cfree.forbidden.boundary import Boundary, boundary
from cfree.forbidden.columns import Trapezoids
from cfree.forbidden.critical_angle import critical_angle
from cfree.planning.core_ways import from_numbers
from cfree.scene.scene import Scene, largest_of, shapes_in

SAME = 1e-6  # of the largest shape: exact places are looked for so near to rounded ones
SIMPLE = 1 << 20  # denominators of places that are tried
FINEST, DIRECTIONS = 48, 16  # halvings of that size, and directions, to look for a free place


@dataclass(frozen=True)
class Fit:
    """Neighbouring orientations at which a part fits.

    Attributes
    ----------
    orientations : AngleInterval
    place : (x, y, theta)
        A position at one of them, rounded.
    pose : Pose or None
        The same position as an exact free pose; None at a single orientation with an irrational half-angle tangent.
        Among round shapes also None of an exact fit whose position has no rational coordinates.
    """

    orientations: AngleInterval
    place: tuple[float, float, float]
    pose: Pose | None


def fits(part: Any, hole: Any) -> tuple[Fit, ...]:
    """Return all orientations at which a part fits into a hole, touching allowed, with a position for each interval.

    Parameters
    ----------
    part : shape or sequence of shapes
        Like the robot of a `Scene`: it is turned about the origin, then moved.
    hole : shape
        One shape that must contain the part. Holes in this shape are forbidden.

    Returns
    -------
    tuple of Fit
        Disjoint closed intervals, counter-clockwise; empty if it does not fit.

    Raises
    ------
    InvalidPolygonError
        If a shape is invalid.
    UnsupportedError
        If a shape is not rounded, as for `boundary`.

    Notes
    -----
    Time is that of `boundary`, plus about a millisecond for each critical angle that doubles do not order. At one
    orientation the part may fit in several places; `free_space` decides which of them are connected.

    Examples
    --------
    A square fits into itself, and into one a hundredth wider:

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
    scene = Scene(shapes_in(part, "part"), workspace=shapes_in(hole, "hole"))
    return Orientations(boundary(scene)).fits()


@dataclass
class _Run:
    """Intervals of orientations that meet: rows of trapezoids, then of isolated parts."""

    start: int
    stop: int
    widest: int


class Orientations:
    """Orientations with a free position in a scene with bounded positions."""

    def __init__(self, boundary: Boundary) -> None:
        boundary.require_complete()
        self.boundary = boundary
        self._from, self._to, _, self._last = boundary._handle.angle_ranks()

    def fits(self) -> tuple[Fit, ...]:
        result = [Fit(self._interval(run), *self._place(run.widest)) for run in self._runs()]
        return tuple(sorted(result, key=lambda fit: fit.orientations.theta))

    def _row(self, k: int) -> tuple[Trapezoids, int]:
        """Return the columns of a trapezoid or an isolated part, and its row in them."""
        faces = len(self.boundary.trapezoids)
        return (self.boundary.trapezoids, k) if k < faces else (self.boundary.isolated, k - faces)

    def _runs(self) -> list[_Run]:
        """Return unions of intervals that meet, in the order of their ranks."""
        tables = self.boundary.trapezoids, self.boundary.isolated
        width = np.concatenate([table.to_lo - table.from_hi for table in tables])
        first, last = self._from, self._to
        runs: list[_Run] = []
        for k in np.argsort(first, kind="stable").tolist():
            if not runs or last[runs[-1].stop] < first[k]:
                runs.append(_Run(k, k, k))
            run = runs[-1]
            run.stop = k if last[k] > last[run.stop] else run.stop
            run.widest = k if width[k] > width[run.widest] else run.widest
        if len(runs) > 1 and first[runs[0].start] == 0 and last[runs[-1].stop] == self._last:
            run = runs.pop()
            runs[0].start = run.start
            runs[0].widest = max(runs[0].widest, run.widest, key=lambda k: float(width[k]))
        return runs

    def _interval(self, run: _Run) -> AngleInterval:
        if self._from[run.start] == 0 and self._to[run.stop] == self._last:
            return AngleInterval(None, None)
        return AngleInterval(self._angle(run.start, False), self._angle(run.stop, True))

    def _angle(self, k: int, last: bool) -> AlgebraicAngle:
        table, row = self._row(k)
        return AlgebraicAngle(int(table.chart[row]), critical_angle(self.boundary, table, row, last))

    def _place(self, k: int) -> tuple[tuple[float, float, float], Pose | None]:
        """Return a position at an angle of a trapezoid or isolated part: the middle of the slice if that is free."""
        table, row = self._row(k)
        exact = (self._round_pose if self.boundary.scene.curved else self._pose)(table, row, k)
        if exact is None:
            if table is self.boundary.isolated:
                x, y, theta = self.boundary.isolated_part(row).ends[0]
            else:  # a slit among round shapes
                tau = float(table.tau_from[row] + table.tau_to[row]) / 2
                (x, y), theta = self._near(table, row, k, tau), float(theta_in(int(table.chart[row]), tau))
            return (x, y, float(normalize_angles(theta))), None
        angle = {"tau": exact.tau}
        segments = self.boundary.slice(angle).segments
        middle = exact
        if len(segments):
            middle = Pose(float(segments[..., 0].mean()), float(segments[..., 1].mean()), angle)
        pose = middle if self.boundary.checker.is_free(middle) else exact
        return (float(pose.x), float(pose.y), pose.theta), pose

    def _round_pose(self, table: Trapezoids, row: int, k: int) -> Pose | None:
        """Return a free pose on a trapezoid or isolated part, or near it; None if none is known that is rational."""
        ends = [critical_angle(self.boundary, table, row, last) for last in (False, True)]
        if self._from[k] == self._to[k]:
            tau = ends[0].value
            if not isinstance(tau, Fraction):
                return None
        else:
            part(*ends)
            tau = between(ends[0].hi, ends[1].lo)
        turned = pose_at(Fraction(0), Fraction(0), tau_in_chart(int(table.chart[row]), tau))
        x, y = self._near(table, row, k, float(tau))
        scene, size = self.boundary.scene, largest_of(self.boundary.scene)
        others = (*scene.obstacles, *([scene.workspace] if scene.workspace is not None else []))
        moved = turned.apply_exact(centers(scene.robot))
        fixed = [(b[0] - a[0], b[1] - a[1]) for a, b in product(moved, centers(others))]
        fixed += crossings(contact_lines(scene, turned))
        near = [p for p in dict.fromkeys(fixed) if abs(float(p[0]) - x) + abs(float(p[1]) - y) < SAME * size]
        near.append((Fraction(x).limit_denominator(SIMPLE), Fraction(y).limit_denominator(SIMPLE)))
        around = [
            (Fraction(x + size * 2.0**-n * math.cos(turn)), Fraction(y + size * 2.0**-n * math.sin(turn)))
            for n in range(3, FINEST)
            for turn in np.arange(DIRECTIONS) * (math.tau / DIRECTIONS)
        ]
        poses = (pose_at(*place, turned.tau) for place in [(Fraction(x), Fraction(y)), *near, *around])
        return next(filter(self.boundary.checker.is_free, poses), None)

    def _near(self, table: Trapezoids, row: int, k: int, tau: float) -> tuple[float, float]:
        """Return the middle of a trapezoid or isolated part at an orientation, rounded."""
        boundary, theta = self.boundary, theta_in(int(table.chart[row]), tau)
        if table is boundary.isolated:
            if self._from[k] == self._to[k]:
                x, y, _ = boundary.isolated_part(row).ends[0]
                return x, y
            t = boundary._slicer.isolated_curve(row, np.array([tau]))
            place = boundary.evaluate([boundary.isolated.lower_patch[row]], t, [theta])[0]
        else:
            lower, upper = boundary.limits([row], [theta])
            place = boundary.evaluate([table.patch[row]], (lower + upper) / 2, [theta])[0]
        return float(place[0]), float(place[1])

    def _pose(self, table: Trapezoids, row: int, k: int) -> Pose | None:
        """Return a pose on a trapezoid or isolated part; None if its only orientation has an irrational tangent."""
        core, is_isolated = self.boundary._handle, table is self.boundary.isolated
        if self._from[k] == self._to[k]:
            end = _core.isolated_end(core, row)
            return None if end is None else from_numbers(end)
        ends = [critical_angle(self.boundary, table, row, last) for last in (False, True)]
        part(*ends)
        tau = between(ends[0].hi, ends[1].lo)
        return from_numbers(_core.middle_of(core, is_isolated, row, tau.denominator, tau.numerator))
