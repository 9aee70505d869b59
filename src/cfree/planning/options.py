"""Options of a planning query, checked once and handed on whole."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import dataclass, field, replace
from fractions import Fraction

from cfree.exact.number import Number, to_fraction
from cfree.paths.path import Objective
from cfree.paths.preferences import NONE, Preferences
from cfree.planning.caller import Caller, Phase, Work
from cfree.vehicles.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class Options:
    """Options of one query, all of them checked.

    Attributes
    ----------
    improve, objective, preferences, tolerance, nearest_free, max_seconds, progress
        As in `cfree.plan`.
    clearance : Fraction
        As in `cfree.plan`; 0 if none is wanted.
    vehicle : Vehicle or None
        The machine that drives; None for a robot that moves in any direction.
    exact_discs : bool
        Search for a path that keeps a clearance with the disc itself where polygons leave it open; False in a scene of
        polygons that stands for another.
    phase, stop, work
        As in `Caller`.
    """

    improve: float | None = None
    clearance: Fraction = Fraction(0)
    objective: Objective = "balanced"
    preferences: Preferences = NONE
    tolerance: float | None = None
    nearest_free: bool = False
    max_seconds: float | None = None
    progress: Callable[[float], object] | None = None
    vehicle: Vehicle | None = None
    exact_discs: bool = True
    phase: Phase = nullcontext
    stop: threading.Event = field(default_factory=threading.Event)
    work: Work | None = None

    def caller(self) -> Caller:
        """Return a listener to one call of the core."""
        return Caller(self.phase, self.progress, self.max_seconds, self.stop, self.work)

    def shared(self, count: int) -> Options:
        """Return the options for one of several paths, which share the time for improving."""
        return replace(self, improve=self.improve and self.improve / count)


def to_seconds(improve: float | None) -> float | None:
    """Check a time for improving, and return it."""
    if improve is not None and not 0 <= improve < math.inf:
        raise ValueError(f"improve {improve}: give seconds, 0 or more")
    return improve


def to_distance(clearance: Number | None) -> Fraction:
    """Convert a clearance to an exact one, 0 if none is wanted."""
    distance = Fraction(0) if clearance is None else to_fraction(clearance)
    if clearance is not None and distance <= 0:
        raise ValueError(f"clearance {clearance}: give a length above 0")
    return distance
