"""Closed intervals of orientations with exact ends: roots of polynomials in tau = tan(theta / 2)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from cfree.arguments import checked
from cfree.exact.algebraic import Exact, Root
from cfree.exact.half_angle import Angle, normalize_angles, tau_in_chart, theta_in, to_chart
from cfree.exact.pose import Pose, PoseLike, to_pose

FINE = Fraction(1, 1 << 60)


class AlgebraicAngle:
    """An orientation: the root of an irreducible integer polynomial in tau, in the chart that holds it.

    Attributes
    ----------
    chart : int
        The orientation is 2 atan(tau) + chart pi, with tau in [-1, 1].
    polynomial : tuple of int
        Its coefficients, the constant first. The degree is 1 if tau is rational.
    """

    def __init__(self, chart: int, root: Root) -> None:
        if root == Root.of(Fraction(1)):  # the charts share their ends
            chart, root = 1 - chart, Root.of(Fraction(-1))
        self.chart, self.polynomial, self._root = chart, root.poly, root

    @staticmethod
    @checked
    def of(pose: PoseLike) -> AlgebraicAngle:
        """The orientation of a pose."""
        return orientation_of(to_pose(pose, "pose").tau)

    def __repr__(self) -> str:
        return f"AlgebraicAngle({self.theta!r})"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, AlgebraicAngle):
            return NotImplemented
        return self.chart == other.chart and self._root == other._root

    def __hash__(self) -> int:
        return hash((self.chart, self._root))

    def __lt__(self, other: AlgebraicAngle) -> bool:
        """Order from -pi/2 on, counter-clockwise."""
        return self._root < other._root if self.chart == other.chart else self.chart < other.chart

    @property
    def coordinate(self) -> Exact:
        """tau in its chart, for arithmetic."""
        return self._root.value

    @property
    def theta(self) -> float:
        """Angle in radians, in [0, 2 pi), within 1e-15."""
        low, high = self._within(FINE)
        return float(normalize_angles(theta_in(self.chart, float((low + high) / 2))))

    @checked
    def neighbours(self, bits: int) -> tuple[Fraction | None, Fraction | None]:
        """Half-angle tangents of rational orientations next to it, clockwise and counter-clockwise.

        Both are the orientation itself if that is rational; else each is less than 2^(2 - bits) radians away. None is
        the half turn.

        Examples
        --------
        >>> AlgebraicAngle.of(Pose(0, 0, "90deg")).neighbours(60)
        (Fraction(1, 1), Fraction(1, 1))
        """
        low, high = self._within(Fraction(1, 1 << bits))
        return tau_in_chart(self.chart, low), tau_in_chart(self.chart, high)

    def _within(self, width: Fraction) -> tuple[Fraction, Fraction]:
        while self._root.hi - self._root.lo > width:
            self._root.narrow()
        return self._root.lo, self._root.hi


def orientation_of(tau: Fraction | None) -> AlgebraicAngle:
    """Return the orientation with a half-angle tangent."""
    chart, local = to_chart(tau)
    return AlgebraicAngle(chart, Root.of(local))


@dataclass(frozen=True)
class AngleInterval:
    """All orientations from one counter-clockwise to another, both included.

    Attributes
    ----------
    start, stop : AlgebraicAngle or None
        Equal for a single orientation; None for all orientations.

    Examples
    --------
    >>> quarter = AngleInterval(AlgebraicAngle.of(Pose(0, 0, "300deg")), AlgebraicAngle.of(Pose(0, 0, "30deg")))
    >>> quarter.contains("30deg"), quarter.contains("31deg"), quarter.contains(0)
    (True, False, True)
    >>> [round(math.degrees(theta)) for theta in quarter.theta]
    [300, 390]
    """

    start: AlgebraicAngle | None
    stop: AlgebraicAngle | None

    @property
    def theta(self) -> tuple[float, float]:
        """Ends in radians, within 1e-15: start in [0, 2 pi), and stop >= start; (0, 2 pi) for all orientations."""
        if self.start is None or self.stop is None:
            return 0.0, math.tau
        start, stop = self.start.theta, self.stop.theta
        return start, stop if stop >= start else stop + math.tau

    @property
    def is_single(self) -> bool:
        """True if it is one orientation: an exact fit."""
        return self.start is not None and self.start == self.stop

    @checked
    def contains(self, theta: Angle | AlgebraicAngle) -> bool:
        """True if an orientation is in it, decided exactly; numbers are read as `Pose` reads them."""
        if self.start is None or self.stop is None:
            return True
        angle = theta if isinstance(theta, AlgebraicAngle) else AlgebraicAngle.of(Pose(0, 0, theta))
        after, before = not angle < self.start, not self.stop < angle
        return after or before if self.stop < self.start else after and before
