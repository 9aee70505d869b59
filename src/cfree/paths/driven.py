"""`Driven`: a part of a path as a vehicle drives it."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from cfree.arguments import checked

Gear = Literal["forward", "backward", "turning"]


@checked
@dataclass(frozen=True)
class Driven:
    """A part of a path on one line or arc in one gear.

    Parameters
    ----------
    gear : "forward", "backward" or "turning"
        "turning" is a turn in place.
    radius : Fraction or None
        Distance of the pole from the axle point, exactly: positive to the left, 0 for a turn in place, None on a line.
    length : float
        Travel of the axle point.
    angle : float, radians
        Counter-clockwise if positive.
    first, last : int
        The motions of the path.
    """

    gear: Gear
    radius: Fraction | None
    length: float
    angle: float
    first: int
    last: int

    @property
    def curvature(self) -> float:
        """The reciprocal of the radius: 0 on a line, infinite for a turn in place."""
        if self.radius is None:
            return 0.0
        return 1 / float(self.radius) if self.radius else float("inf")
