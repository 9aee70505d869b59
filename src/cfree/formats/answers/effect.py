"""The rule of effect: a limit on the error of the robot's path if decimals replace the exact numbers beside them.

docs/answer-format.md, "Decimals", states it. A decimal's weight is the largest displacement of a point of the robot
per unit of the decimal's error. Angles are irrational, and enclosed in intervals.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import cached_property

from cfree.collision.motion import Motion
from cfree.exact.arctangent import arctangent, pi
from cfree.exact.pose import Pose
from cfree.formats.text.json_positions import Path as Place
from cfree.paths.path import Path
from cfree.scene.digest import Stamp

PART = Fraction(1, 10**9)  # how far decimals may displace a point of the robot, as a share of the robot's size
BITS = 300  # precision of angles: more than weights need

Decimals = Mapping[Place, Fraction]
Written = Mapping[Place, Decimal]  # decimals as written in a file


@dataclass(frozen=True, slots=True)
class Enclosed:
    """A real number, at most `radius` from `middle`."""

    middle: Fraction
    radius: Fraction = Fraction(0)

    def __add__(self, other: Enclosed) -> Enclosed:
        return Enclosed(self.middle + other.middle, self.radius + other.radius)

    def times(self, factor: int) -> Enclosed:
        return Enclosed(factor * self.middle, abs(factor) * self.radius)

    def off(self, decimal: Fraction) -> Fraction:
        """Return an upper bound of a decimal's distance from the number."""
        return abs(decimal - self.middle) + self.radius


@dataclass(frozen=True, slots=True)
class Term:
    """An exact number beside a decimal."""

    place: Place
    value: Enclosed
    weight: Fraction

    def effect(self, decimals: Decimals) -> Fraction:
        return self.weight * self.value.off(decimals[self.place])


class Effect:
    """The effect of decimals beside the exact numbers of a path.

    Parameters
    ----------
    path : Path
        A path without motions stands for the start of a separation.
    goal : Pose
    stamp : Stamp
    """

    def __init__(self, path: Path, goal: Pose, stamp: Stamp) -> None:
        self.path, self.goal, self.stamp = path, goal, stamp
        self.limit = PART * stamp.size
        farthest = max([stamp.reach, *map(_arm, path.poses, path.motions)]) / self.limit
        self._bits = BITS + math.ceil(farthest * (len(path.motions) + 1)).bit_length()

    def terms(self, decimals: Decimals) -> Iterator[Term]:
        """Yield the terms of start and motions; the angle comes before the pole, whose weight depends on it."""
        start, reach = self.path.start, self.stamp.reach
        yield from self._pose(("start",), start, self._counted(start, decimals["start", 2]))
        for k, (pose, motion) in enumerate(zip(self.path.poses, self.path.motions, strict=False)):
            place: Place = ("motions", k)
            if motion.kind != "translation":
                yield Term((*place, "angle"), self._turns[k], _arm(pose, motion) + reach)
            if motion.pole is None:
                yield from _point((*place, "vector"), motion.vector)
            else:
                weight = min(Fraction(2), abs(decimals[(*place, "angle")]))
                yield from _point((*place, "pole"), motion.pole, weight)

    def poses(self, decimals: Decimals) -> Iterator[list[Term]]:
        """Yield the terms of each pose that a motion leads to, and of the goal."""
        theta = self._counted(self.path.start, decimals["start", 2])
        for k, (pose, turn) in enumerate(zip(self.path.poses[1:], self._turns, strict=True)):
            theta += turn
            yield list(self._pose(("motions", k, "to"), pose, theta))
        yield list(self._pose(("goal",), self.goal, self._counted(self.goal, decimals["goal", 2])))

    def total(self, decimals: Decimals) -> Fraction:
        """Return an upper bound of the displacement of any point of the robot along the path."""
        return sum((term.effect(decimals) for term in self.terms(decimals)), Fraction(0))

    def decimals(self) -> Written:
        """Return decimals that keep the rule, most of them with half of the allowed effect."""
        count = 3 + sum(2 + (motion.kind != "translation") for motion in self.path.motions)
        written: dict[Place, Decimal] = {}
        values: dict[Place, Fraction] = {
            ("start", 2): Fraction(self.path.start.theta),
            ("goal", 2): Fraction(self.goal.theta),
        }

        def write(term: Term, share: Fraction) -> None:
            written[term.place] = decimal_near(term.value, share / term.weight if term.weight else share)
            values[term.place] = Fraction(written[term.place])

        for term in self.terms(values):
            write(term, self.limit / (2 * count))
        for pose in self.poses(values):
            for term in pose:
                write(term, self.limit / 6)
        return written

    def leeway(self, decimals: Written) -> Fraction | None:
        """Return the clearance of the exact path that makes the path of the decimals, as doubles, free.

        None if none is enough: decimals do not determine slides.
        """
        if any(motion.kind == "slide" for motion in self.path.motions):
            return None
        try:
            doubles = {place: Fraction(float(value)) for place, value in decimals.items()}
        except OverflowError:
            return None
        most = 4 * max(self.total({place: Fraction(value) for place, value in decimals.items()}), self.total(doubles))
        if most == 0:
            return most
        power = most.numerator.bit_length() - most.denominator.bit_length()  # 2**power is from most / 2 to 2 * most
        return Fraction(2) ** (power if most <= Fraction(2) ** power else power + 1)

    def _counted(self, pose: Pose, decimal: Fraction) -> Enclosed:
        """Return the angle of a pose, plus the whole turns that bring it nearest to the decimal angle."""
        angle, turn = self._angle(pose.tau), self._half_turn.times(2)
        return angle + turn.times(round((decimal - angle.middle) / turn.middle))

    def _pose(self, place: Place, pose: Pose, theta: Enclosed) -> Iterator[Term]:
        yield from _point(place, (pose.x, pose.y))
        yield Term((*place, 2), theta, self.stamp.reach)

    @cached_property
    def _turns(self) -> list[Enclosed]:
        """The rotation angle of each motion."""
        return [self._turn(motion) for motion in self.path.motions]

    def _turn(self, motion: Motion) -> Enclosed:
        is_back = motion.tau is None and motion.clockwise
        return self._angle(motion.tau).times(-1 if is_back else 1)

    def _angle(self, tau: Fraction | None) -> Enclosed:
        if tau is None:
            return self._half_turn
        return Enclosed(arctangent(tau, self._bits + 1), self._radius / 2).times(2) if tau else Enclosed(tau)

    @property
    def _half_turn(self) -> Enclosed:
        return Enclosed(pi(self._bits), self._radius)

    @property
    def _radius(self) -> Fraction:
        return Fraction(1, 1 << self._bits)


def decimal_near(value: Enclosed, tolerance: Fraction) -> Decimal:
    """Return the shortest decimal of a double if it is near enough, else one with the digits needed.

    Examples
    --------
    >>> third = Enclosed(Fraction(1, 3))
    >>> decimal_near(third, Fraction(1, 10**9)), decimal_near(third, Fraction(1, 10**18))
    (Decimal('0.3333333333333333'), Decimal('0.3333333333333333333'))
    """
    middle = value.middle if abs(value.middle) > value.radius else Fraction(0)  # no remainder of a sum
    try:
        short = Decimal(repr(float(middle)))
    except OverflowError:
        short = Decimal(0)
    if value.off(Fraction(short)) <= tolerance:
        return short
    room = tolerance - value.radius  # above 2^-bits, and so above 10^-places
    bits = room.denominator.bit_length() - room.numerator.bit_length() + 1
    places = max(0, math.ceil(bits * math.log10(2)))
    whole = round(value.middle * 10**places)
    return Decimal((int(whole < 0), tuple(map(int, str(abs(whole)))), -places))


def _point(place: Place, point: tuple[Fraction, Fraction], weight: Fraction = Fraction(1)) -> Iterator[Term]:
    for k, value in enumerate(point):
        yield Term((*place, k), Enclosed(value), weight)


def _arm(pose: Pose, motion: Motion) -> Fraction:
    """Return an upper bound of the distance from the pole to the reference point."""
    if motion.pole is None:
        return Fraction(0)
    return abs(pose.x - motion.pole[0]) + abs(pose.y - motion.pole[1])
