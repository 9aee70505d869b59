"""Jumps of curvature that a vehicle drives through while its wheels turn, with bounds of its error.

docs/theory/vehicles.md, "Steering while driving", has the proof.
"""

from __future__ import annotations

from dataclasses import dataclass

from cfree.arguments import checked


@checked
@dataclass(frozen=True)
class Ramp:
    """A jump of curvature that is driven through; the figures are proved bounds, up to rounding.

    Parameters
    ----------
    motion : int
        The motion of the path that begins there.
    length : float
        Travel of the axle point within which the wheels can turn, at any speed up to the limit.
    jump : float
        The change of curvature.

    Notes
    -----
    If the wheels begin to turn at the joint, the axle point is at most `sideways` from its place on the path until
    they have turned, and the heading errs by at most `heading`. A tracker has to take this back. If instead the
    curvature changes evenly along `length`, with the joint in the middle, the figures are `centred_sideways` and
    `centred_heading`, and at the end the heading is right again.

    Examples
    --------
    >>> ramp = Ramp(3, 0.5, 0.25)
    >>> [round(value, 6) for value in (ramp.sideways, ramp.heading, ramp.centred_sideways, ramp.centred_heading)]
    [0.020833, 0.0625, 0.002604, 0.015625]
    """

    motion: int
    length: float
    jump: float

    @property
    def sideways(self) -> float:
        """Bound of the axle point's distance from its place."""
        return self.length**2 * self.jump / 3

    @property
    def heading(self) -> float:
        """Bound of the heading's error, in radians."""
        return self.length * self.jump / 2

    @property
    def centred_sideways(self) -> float:
        """As `sideways`, if the joint is in the middle of the change."""
        return self.length**2 * self.jump / 24

    @property
    def centred_heading(self) -> float:
        """As `heading`, if the joint is in the middle of the change."""
        return self.length * self.jump / 8

    @checked
    def room(self, reach: float) -> float:
        """Return the clearance that suffices for points of the robot up to `reach` away from the axle point."""
        return self.sideways + reach * self.heading


def ramp_length(speed: float, steer_rate: float, wheelbase: float, before: float, beyond: float) -> float:
    """Return the travel within which the curvature can change evenly, at any speed up to this one.

    Examples
    --------
    >>> ramp_length(1, 0.5, 2, 0, 0.25), ramp_length(1, 0.5, 2, 0.25, 0.5)
    (1.0, 0.8)
    """
    least = 0.0 if before * beyond <= 0 else min(abs(before), abs(beyond))
    return speed * wheelbase * abs(beyond - before) / (steer_rate * (1 + (wheelbase * least) ** 2))
