"""Isolated parts of a boundary as ways: segments and points at one orientation, curves along two contacts."""

from __future__ import annotations

from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

from cfree.exact.pose import Pose
from cfree.forbidden.columns import CURVE
from cfree.forbidden.critical_angle import rational_critical_angle
from cfree.planning.exact_face import Sheet, Vector, between, cross, dot, isolated_end, minus

if TYPE_CHECKING:
    from cfree.planning.boundary_walk import Walker

SAMPLES = 8  # of a curve
MOST_PARTS = 64  # of a curve: one slide does unless its formula cannot be seen to be defined on all of it


class ThinPart:
    """An isolated part with its rational places.

    Attributes
    ----------
    is_curve : bool
        Else it is a segment or a point, at one orientation.
    tau : (Fraction or None, Fraction or None)
        Its first and last orientation in its chart, where they are rational.
    """

    def __init__(self, walker: Walker, k: int) -> None:
        self.walker, self.k = walker, k
        self.boundary = walker.space.boundary
        self.table = self.boundary.isolated
        self.is_curve = bool(self.table.kind[k] == CURVE)
        self.sheet = Sheet.isolated(self.boundary, k)
        self.tau = self._angle(False), self._angle(True)

    def _angle(self, last: bool) -> Fraction | None:
        return rational_critical_angle(self.boundary, self.table, self.k, last)

    @cached_property
    def ends(self) -> tuple[Pose | None, Pose | None]:
        """Where they are rational."""
        return self._end(False), self._end(True)

    @property
    def theta(self) -> tuple[float, float]:
        """Its first and last orientation, rounded."""
        return float(self.table.theta_from[self.k]), float(self.table.theta_to[self.k])

    @property
    def rounded(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """(x, y, theta) of its ends."""
        return self.boundary.isolated_part(self.k).ends

    def box(self, margin: float) -> tuple[float, float, float, float]:
        """xmin, ymin, xmax, ymax of its positions, and a margin; of a curve by samples, to look near."""
        points = [end[:2] for end in self.rounded]
        low, high = self.sheet.low, self.sheet.high
        if self.is_curve and low < high:
            taus = (low + (high - low) * Fraction(k, SAMPLES) for k in range(1, SAMPLES))
            poses = [self.at(tau) for tau in taus]
            points += [(float(pose.x), float(pose.y)) for pose in poses]
        (x0, *_, x1), (y0, *_, y1) = (sorted(axis) for axis in zip(*points, strict=True))
        if self.is_curve:
            margin += ((x1 - x0) + (y1 - y0)) / 8
        return x0 - margin, y0 - margin, x1 + margin, y1 + margin

    def _end(self, last: bool) -> Pose | None:
        if (tau := self.tau[last]) is None:
            return None
        if self.is_curve:
            return self.at(tau)
        return isolated_end(self.boundary, self.k, last, tau)

    def at(self, tau: Fraction) -> Pose:
        """The pose of a curve at an orientation."""
        return self.sheet.pose(self.sheet.limits(tau)[0], tau)

    def local(self, pose: Pose) -> Fraction | None:
        """tau of a pose in its chart, None if it has none there."""
        chart, tau = pose.chart
        return tau if chart == self.sheet.chart else -tau if abs(tau) == 1 else None

    def holds(self, pose: Pose) -> bool:
        """Is a pose on it?"""
        if (tau := self.local(pose)) is None:
            return False
        if self.is_curve:
            within = self.sheet.low, self.sheet.high
            low, high = (near if exact is None else exact for exact, near in zip(self.tau, within, strict=True))
            return low <= tau <= high and self.at(tau) == pose
        first, last = self.ends
        if first is None or last is None or tau != self.tau[0]:
            return False
        start, along = (first.x, first.y), minus((last.x, last.y), (first.x, first.y))
        to = minus((pose.x, pose.y), start)
        return cross(along, to) == 0 and 0 <= dot(along, to) <= dot(along, along)

    def crossing(self, other: ThinPart) -> Pose | None:
        """Where a segment or point meets another part at its orientation, if that is not a piece of both."""
        tau, first, last = self.tau[0], *self.ends
        if self.is_curve or tau is None or first is None or last is None:
            return None
        if other.is_curve:
            if (there := other.local(first)) is None or not other.sheet.low < there < other.sheet.high:
                return None
            pose = other.at(there)
            return pose if self.holds(pose) else None
        start, end = other.ends
        if start is None or end is None or start.tau != first.tau:
            return None
        P, U = (first.x, first.y), _between(first, last)
        Q, V = (start.x, start.y), _between(start, end)
        if (d := cross(U, V)) == 0:
            return None
        t = cross(minus(Q, P), V) / d
        pose = Pose(P[0] + t * U[0], P[1] + t * U[1], {"tau": first.tau})
        return pose if self.holds(pose) and other.holds(pose) else None

    def way(self, start: Pose, goal: Pose) -> list[Pose] | None:
        """Along it, from one pose on it to another."""
        code = self.sheet.codes[0]
        if not self.is_curve:
            return [start, goal] if self.walker.checker.joins([start, goal]) else None
        first, last = self.local(start), self.local(goal)
        assert first is not None and last is not None
        way, stack = [start], [last]
        while stack and len(stack) + len(way) < MOST_PARTS:
            end = goal if stack[-1] == last else self.at(stack[-1])
            if self.walker.curves.along(way[-1], end, self.sheet, code):
                way.append(end)
                stack.pop()
            else:
                tau = self.local(way[-1])
                assert tau is not None
                stack.append(between(min(tau, stack[-1]), max(tau, stack[-1])))
        return None if stack else way


def _between(first: Pose, last: Pose) -> Vector:
    return minus((last.x, last.y), (first.x, first.y))
