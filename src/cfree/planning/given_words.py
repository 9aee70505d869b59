"""Words of Reeds and Shepp, or of Dubins, that a planner in doubles has between states.

A planner such as OMPL joins states by the shortest words of one radius. Length and some poses of its path tell the
radius, and the word of each motion.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

import cfree._core as _core
from cfree.vehicles.vehicle import Vehicle, described

Floats = NDArray[np.float64]
Place = tuple[float, float, float]
Family = Literal["Reeds-Shepp", "Dubins", "symmetric Dubins"]

SAME = 1e-9  # share of a length, or of a radius, that counts as rounding
NEAR = 1e-6  # the same of poses within a motion
NOTHING = 1e-12  # shorter pieces are left out, in radii
TINY = 2.0**-20  # least radius of a differential drive's words that is told from their length, as a share of it
DOUBLINGS, HALVINGS = 60, 80  # of the search for a radius


@dataclass(frozen=True)
class Piece:
    """A piece of a word in doubles.

    Parameters
    ----------
    kind : int
        1 for an arc to the left, -1 to the right, 0 for a straight line.
    length : float
        Travel in radii, negative for going back.
    motion : int
        The pair of states that its word joins.
    """

    kind: int
    length: float
    motion: int


@dataclass(frozen=True)
class GivenWords:
    """States of an axle, and the words of one radius between them.

    Parameters
    ----------
    rows : (n, 3) array
        x, y and heading of the states.
    radius : float
    words : sequence of sequences of Piece
        One for each pair of states.
    """

    rows: Floats
    radius: float
    words: tuple[tuple[Piece, ...], ...]

    def travel(self, motion: int) -> float:
        """Return the length of a word."""
        return self.radius * sum(abs(piece.length) for piece in self.words[motion])


def given_words(
    rows: Floats, vehicle: Vehicle, *, length: float | None = None, middles: Floats | None = None
) -> GivenWords:
    """Find the words that a planner in doubles has between states.

    Parameters
    ----------
    rows : (n, 3) array
        x, y and heading of the axle.
    vehicle : Car or DifferentialDrive
    length : float, optional
        Length of the whole path. It tells a radius that is larger than the car's.
    middles : (n - 1, k, 3) array, optional
        Poses within each motion, at equal steps of its length. They tell words of equal length apart.

    Raises
    ------
    ValueError
        If the words have a smaller radius than the car's, or there are none of this length.

    Examples
    --------
    >>> from cfree import Car
    >>> words = given_words(np.array([(0, 0, 0), (4, 4, math.pi / 2)]), Car(4))
    >>> [(piece.kind, round(piece.length, 3)) for piece in words.words[0]], words.radius
    ([(1, 1.571)], 4.0)
    """
    least, greatest = float(vehicle.turning_radius), 0.0
    if vehicle.kind == "differential":  # any radius; a large one for straight lines alone
        least, greatest = (1.0, 0.0) if not length else (length * TINY, length)
    families: tuple[Family, ...] = ("Dubins",) if vehicle.gears == "forward" else get_args(Family)
    is_shorter = False
    for family in families:
        its = least if length is None else _radius(rows, family, (greatest or least, least), length)
        if its is None:
            is_shorter |= length is not None and _total(rows, family, least) > length * (1 + SAME)
        elif all(words := _shortest(rows, its, family, middles)):
            return GivenWords(rows, its, words)
    what, least_text = described(vehicle), f"{least:.6g}" if vehicle.kind == "car" else "1"
    if is_shorter:
        raise ValueError(
            f"path: its motions are shorter than those of {what}; give OMPL's space a turning radius of at least "
            f"{least_text}"
        )
    space = "DubinsStateSpace" if vehicle.gears == "forward" else "ReedsSheppStateSpace"
    raise ValueError(f"path: its motions are not those of {what}; plan in a {space}({least_text})")


def joints_of(start: Place, pieces: Sequence[Piece]) -> Iterator[Place]:
    """Yield the poses between the pieces of a word with radius 1, with the first and the last."""
    x, y, theta = start
    yield x, y, theta
    for piece in pieces:
        before = theta
        theta = before + piece.kind * piece.length
        if piece.kind:
            x += piece.kind * (math.sin(theta) - math.sin(before))
            y -= piece.kind * (math.cos(theta) - math.cos(before))
        else:
            x, y = x + piece.length * math.cos(theta), y + piece.length * math.sin(theta)
        yield x, y, theta


def _seen_from(a: Floats, b: Floats, radius: float) -> Place:
    dx, dy, c, s = b[0] - a[0], b[1] - a[1], math.cos(a[2]), math.sin(a[2])
    return (c * dx + s * dy) / radius, (c * dy - s * dx) / radius, math.remainder(b[2] - a[2], math.tau)


def _candidates(a: Floats, b: Floats, radius: float, family: Family) -> list[list[tuple[int, float]]]:
    if family == "Reeds-Shepp":
        return _core.vehicle_words(*_seen_from(a, b, radius), False)
    words = _core.vehicle_words(*_seen_from(a, b, radius), True)
    if family == "symmetric Dubins":  # driven the other way, in the other gear
        back = _core.vehicle_words(*_seen_from(b, a, radius), True)
        words = words + [[(kind, -length) for kind, length in reversed(word)] for word in back]
    return words


def _shortest(rows: Floats, radius: float, family: Family, middles: Floats | None) -> tuple[tuple[Piece, ...], ...]:
    """Return the shortest word of each motion that passes its middles; an empty one if none does."""
    chosen = list[tuple[Piece, ...]]()
    for k in range(len(rows) - 1):
        words = sorted(_candidates(rows[k], rows[k + 1], radius, family), key=_travel)
        least = _travel(words[0])
        words = [word for word in words if _travel(word) <= least * (1 + SAME) + SAME]
        its = [tuple(Piece(kind, length, k) for kind, length in word if abs(length) > NOTHING) for word in words]
        its = [word or (Piece(0, 0.0, k),) for word in its]
        if middles is not None:
            its = [word for word in its if _passes(word, rows[k], radius, middles[k])]
        chosen.append(its[0] if its else ())
    return tuple(chosen)


def _travel(word: Sequence[tuple[int, float]]) -> float:
    return sum(abs(length) for _, length in word)


def _passes(word: Sequence[Piece], row: Floats, radius: float, middles: Floats) -> bool:
    """True if a word passes poses at equal steps of its length."""
    total = sum(abs(piece.length) for piece in word)
    for k, (x, y, theta) in enumerate(middles, start=1):
        u, v, h = _at(word, (row[0] / radius, row[1] / radius, row[2]), total * k / (len(middles) + 1))
        apart = max(abs(u - x / radius), abs(v - y / radius), abs(math.remainder(h - theta, math.tau)))
        if apart > NEAR * (1 + total):
            return False
    return True


def _at(word: Sequence[Piece], start: Place, distance: float) -> Place:
    """Return the pose of a word with radius 1 after a distance."""
    part = list[Piece]()
    for piece in word:
        length = min(abs(piece.length), distance)
        part.append(replace(piece, length=math.copysign(length, piece.length)))
        distance -= length
    *_, end = joints_of(start, part)
    return end


def _total(rows: Floats, family: Family, radius: float) -> float:
    words = GivenWords(rows, radius, _shortest(rows, radius, family, None))
    return sum(words.travel(k) for k in range(len(words.words)))


def _radius(rows: Floats, family: Family, tried: tuple[float, float], length: float) -> float | None:
    """Return the radius with which the words have a total length: one of those tried, or a larger one; or None."""
    first, least = tried

    def is_same(radius: float) -> bool:
        return abs(_total(rows, family, radius) - length) <= SAME * length

    # words may be longer by whole turns if a radius is larger by rounding
    for radius in (first, least, least * (1 - SAME / 8)):
        if is_same(radius):
            return radius
    low, high = least, 2 * least
    for _ in range(DOUBLINGS):
        if _total(rows, family, high) >= length:
            break
        low, high = high, 2 * high
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (low, middle) if _total(rows, family, middle) >= length else (middle, high)
    return next((radius for radius in (high, low) if radius > least and is_same(radius)), None)
