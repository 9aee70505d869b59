"""Words of Reeds and Shepp, or of Dubins, between given states in doubles, made exact.

A planner such as OMPL joins states by arcs of one radius and straight lines. Words at exactly a car's turning radius
have in general no rational form, so that here they get a radius larger by a share of 2^-16. Most states stay where they
are. Where a word of the larger radius cannot have the same ends, such as a single arc, the states between some words
move; the words then share the change.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

import cfree._core as _core
from cfree.collision.motion import Motion, joining
from cfree.collision.motion_checker import MotionChecker
from cfree.exact.pose import Pose
from cfree.paths.driving import is_drivable
from cfree.paths.path import Path
from cfree.planning.core_ways import from_numbers, numbers_of
from cfree.scene.frame import frame_of
from cfree.scene.naming import placed
from cfree.scene.scene import Scene
from cfree.vehicles.vehicle import Car, Vehicle, described

Floats = NDArray[np.float64]
Place = tuple[float, float, float]
Family = Literal["Reeds-Shepp", "Dubins", "symmetric Dubins"]

SLACK = 2.0**-16  # share by which a radius is larger than the car's
FARTHEST = 2.0**-10  # most deviation, in radii
SAME = 1e-9  # share of a length, or of a radius, that counts as rounding
NEAR = 1e-6  # the same of poses within a motion
NOTHING = 1e-12  # shorter pieces are left out, in radii
SHORT = 1e-3  # shorter pieces may be left out, in radii
CLOSED = 1e-11  # greatest error of an end in doubles, in radii
TINY = 2.0**-20  # least radius of a differential drive's words that is told from their length, as a share of it
STEPS = 20  # of Newton's method
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


def driven_path(
    rows: Floats, scene: Scene, vehicle: Vehicle, *, length: float | None = None, middles: Floats | None = None
) -> Path:
    """Return the path of a vehicle through states of its axle, proved free.

    Parameters
    ----------
    rows, vehicle, length, middles
        As for `given_words`.
    scene : Scene

    Returns
    -------
    Path
        Its ends are the scene's start and goal if the first and last state are these up to rounding.

    Raises
    ------
    ValueError
        If the motions are not the vehicle's, or one is not free.

    Examples
    --------
    >>> scene = Scene([(-1, -1), (1, -1), (1, 1), (-1, 1)], [[(6, 6), (8, 6), (8, 8), (6, 8)]])
    >>> rows = np.array([(0, 0, 0), (4.5, 4.5, math.pi / 2), (4.5, 9, math.pi / 2)])
    >>> path = driven_path(rows, scene, Car(4))
    >>> path.goal == Pose(4.5, 9, math.pi / 2), path.cusps
    (True, 0)
    >>> driven_path(rows + (1, 0, 0), scene, Car(4))
    Traceback (most recent call last):
    ValueError: motion 1 of 2 is not free near 0.111111 of it: at (5.5, 5, 90 deg) robot part 0 \
runs into obstacle 0, 2 x 2 at (7, 7)
    """
    words = given_words(rows, vehicle, length=length, middles=middles)
    into_robot = vehicle.frame.inverse()
    start, goal = (
        _end(row, vehicle, pose, words.radius) for row, pose in ((rows[0], scene.start), (rows[-1], scene.goal))
    )
    checker, motions = MotionChecker(scene), list[Motion]()
    robot = start @ into_robot
    for k, poses in enumerate(exact_poses(words, vehicle, start, goal)):
        its = [pose @ into_robot for pose in poses]
        for m, (first, last) in enumerate(pairwise(its)):
            motion = joining(first, last)
            if not checker.is_free(first, motion):
                raise ValueError(f"motion {k} of {len(rows) - 1} {_clip(scene, checker, vehicle, its, m)}")
            motions.append(motion)
    path = Path(robot, motions, scene.units, frame_of(scene), scene, vehicle=vehicle)
    if not (answer := is_drivable(path, vehicle)):
        raise ValueError(f"motion {answer.motion} of {len(motions)} cannot be driven: {answer.why}")
    return path


def _end(row: Floats, vehicle: Vehicle, pose: Pose | None, radius: float) -> Pose:
    """Return the axle pose of a state; that of a pose if it is the same up to rounding."""
    x, y, theta = map(float, row)
    if pose is not None:
        axle = pose @ vehicle.frame
        turned = math.remainder(axle.theta - theta, math.tau)
        if max(abs(float(axle.x) - x), abs(float(axle.y) - y), radius * abs(turned)) <= SAME * radius:
            return axle
    return Pose(x, y, theta)


def _clip(scene: Scene, checker: MotionChecker, vehicle: Vehicle, poses: Sequence[Pose], piece: int) -> str:
    """Describe where a word overlaps; the first of its pieces that is not free is given."""
    motions = [joining(a, b) for a, b in pairwise(poses)]
    lengths = [motion.length(pose @ vehicle.frame) for pose, motion in zip(poses, motions, strict=False)]
    contact = checker.first_contact(poses[piece], motions[piece])
    assert contact is not None, "the motion is not free"
    at = min(1.0, max(0.0, float(contact.at)))
    share = (sum(lengths[:piece]) + motions[piece].share(at) * lengths[piece]) / (sum(lengths) or 1.0)
    pose = motions[piece].at(poses[piece], Fraction(at))
    what = placed(scene, contact.obstacle)
    verb = "leaves" if contact.obstacle < 0 else "runs into"
    place = f"({float(pose.x):.6g}, {float(pose.y):.6g}, {math.degrees(pose.theta):.3g} deg)"
    return f"is not free near {share:.6g} of it: at {place} robot part {contact.robot} {verb} {what}"


def exact_poses(words: GivenWords, vehicle: Vehicle, start: Pose, goal: Pose) -> list[list[Pose]]:
    """Return the axle poses between which each word has a single exact piece, from start to goal.

    Parameters
    ----------
    words : GivenWords
    vehicle : Car or DifferentialDrive
    start, goal : Pose
        Exact poses of the axle, equal to the first and last state up to rounding.

    Returns
    -------
    list of lists of poses
        One for each word; each begins where the one before it ends. No radius is less than the car's. No pose is
        farther from that of the word in doubles than 2^-10 of the radius.

    Raises
    ------
    ValueError
        If there is none so near.

    Examples
    --------
    >>> car, rows = Car(4), np.array([(0, 0, 0), (9, 3, 1)])
    >>> (poses,) = exact_poses(given_words(rows, car), car, Pose(0, 0), Pose(9, 3, 1.0))
    >>> poses[0] == Pose(0, 0), poses[-1] == Pose(9, 3, 1.0), len(poses)
    (True, True, 4)
    """
    count, slack = len(words.words), Fraction(1) + Fraction(SLACK)
    least = Fraction(vehicle.turning_radius)
    radius = max(words.radius, float(least * slack) * (1 + 2.0**-50))
    # the radii are tested against a car's that is smaller by the slack, but not below the vehicle's own
    tested = max(least, Fraction(radius) / slack)
    maker = _Maker(words, radius, Car(tested, gears="both"), start, goal)
    done: list[tuple[int, list[list[Pose]]]] = []  # first motion of a window, and its poses
    first, pose, shortest = 0, start, 1
    while first < count:
        for last in range(first + shortest, count + 1):
            if (poses := maker.window(first, last, pose)) is not None:
                done.append((first, poses))
                first, pose, shortest = last, poses[-1][-1], 1
                break
        else:
            if not done:
                more = f"{words.radius * (1 + 2**-10):.6g}"
                raise ValueError(
                    f"motion {first} of {count}: no arcs with radii of at least {float(least):.6g} are near it; give "
                    f"OMPL's space a turning radius a little larger than the car's, such as {more}"
                )
            # the last windows are made anew as one, with more freedom
            shortest = count - done[-1][0]
            first, pose = done[-1][0], done[-1][1][0][0]
            done.pop()
    return [poses for _, window in done for poses in window]


@dataclass(frozen=True)
class _Maker:
    """Makes words exact, at a radius and for a car at the axle."""

    given: GivenWords
    radius: float
    car: Car
    start: Pose
    goal: Pose

    def window(self, first: int, last: int, pose: Pose) -> list[list[Pose]] | None:
        """Return exact words from a pose near a state to a later state; None if none are near."""
        count = len(self.given.words)
        state = self.given.rows[last]
        goal = self.goal if last == count else Pose(*map(float, state))
        pieces = [piece for word in self.given.words[first:last] for piece in word]
        scaled = [p if p.kind else replace(p, length=p.length * self.given.radius / self.radius) for p in pieces]
        for left_out in (0.0, SHORT):
            lengths = self._closed(scaled, pose, goal, left_out)
            if lengths is None:
                continue
            fresh = [replace(p, length=length) for p, length in zip(scaled, lengths, strict=True)]
            if self._deviation(first, pieces, fresh, pose) > FARTHEST * self.radius:
                continue
            if (made := self._exact(first, last, fresh, pose, goal)) is not None:
                return made
        return None

    def _closed(self, pieces: Sequence[Piece], pose: Pose, goal: Pose, left_out: float) -> list[float] | None:
        """Change lengths as little as possible so that the word ends at the goal; None if a gear would change."""
        lengths = np.array([p.length for p in pieces])
        free = np.abs(lengths) >= left_out
        lengths[~free] = 0
        local = pose.inverse() @ goal
        target = np.array([float(local.x) / self.radius, float(local.y) / self.radius, local.theta])
        gears = np.sign(lengths)
        for _ in range(STEPS):
            joints = [*_joints((0.0, 0.0, 0.0), [replace(p, length=d) for p, d in zip(pieces, lengths, strict=True)])]
            x, y, theta = joints[-1]
            rest = target - (x, y, theta)
            rest[2] = math.remainder(rest[2], math.tau)
            if np.abs(rest).max() < CLOSED:
                return [float(length) for length in lengths]
            ends = joints[1:]
            columns = [
                (math.cos(h) - p.kind * (y - v), math.sin(h) + p.kind * (x - u), p.kind) if is_free else (0.0, 0.0, 0.0)
                for p, (u, v, h), is_free in zip(pieces, ends, free, strict=True)
            ]
            change = np.linalg.lstsq(np.array(columns).T, rest, rcond=1e-9)[0]
            if not np.abs(change).max() < 1:
                return None
            lengths = lengths + change
            if (np.sign(lengths) * gears < 0).any():
                return None
        return None

    def _deviation(self, first: int, pieces: Sequence[Piece], fresh: Sequence[Piece], pose: Pose) -> float:
        """Bound the distance of the poses of two words at equal shares of their pieces."""
        old = self.given.radius
        there = list[tuple[Place, Place]]()  # ends of each piece
        for motion in range(first, pieces[-1].motion + 1):
            row = self.given.rows[motion]
            local = [p for p in pieces if p.motion == motion]
            joints = [*_joints((row[0] / old, row[1] / old, row[2]), local)]
            there += pairwise(joints)
        at = float(pose.x) / self.radius, float(pose.y) / self.radius, pose.theta
        here = [*_joints(at, fresh)]
        most = 0.0
        for piece, other, (begin, end), p, q in zip(pieces, fresh, there, here, here[1:], strict=False):
            apart = math.hypot(begin[0] * old - p[0] * self.radius, begin[1] * old - p[1] * self.radius)
            long, length = abs(piece.length) * old, abs(other.length) * self.radius
            turned = max(abs(math.remainder(a[2] - b[2], math.tau)) for a, b in ((begin, p), (end, q)))
            most = max(most, apart + abs(long - length) + min(long, length) * turned)
        return most

    def _exact(self, first: int, last: int, pieces: Sequence[Piece], pose: Pose, goal: Pose) -> list[list[Pose]] | None:
        """Return the poses of exact words with these lengths; None if one has no rational form."""
        words = [[p for p in pieces if p.motion == motion and abs(p.length) > NOTHING] for motion in range(first, last)]
        final = max((k for k, word in enumerate(words) if word), default=-1)
        if final < 0:
            return [[pose] for _ in words] if pose == goal else None
        made, end = list[list[Pose]](), pose
        x, y, theta = float(pose.x) / self.radius, float(pose.y) / self.radius, pose.theta
        for k, word in enumerate(words):
            begin = end
            if not word:  # equal states
                made.append([begin])
                continue
            *_, (x, y, theta) = _joints((x, y, theta), word)
            wanted = x * self.radius, y * self.radius, math.remainder(theta, math.tau)
            end = goal if k == final else Pose(*wanted)
            if (poses := self._word(word, begin, end)) is None:
                return None
            made.append(poses)
        return made

    def _word(self, word: Sequence[Piece], start: Pose, goal: Pose) -> list[Pose] | None:
        """Return the poses of one exact word; None if it has no rational form with these gears and radii."""
        steps = [(p.kind, p.length) for p in word]
        ends = numbers_of(start), numbers_of(goal)
        car: Any = _numbers(self.car)
        found = _core.exact_word(car, *ends, steps, self.radius)
        if found is None and _is_nearly_straight(word):
            found = _core.exact_words(car, *ends, "biarc", 0.0)[0]
        return None if found is None else [from_numbers(pose) for pose in found]


def _is_nearly_straight(word: Sequence[Piece]) -> bool:
    """True if two arcs of great radius are near a word: by twice the product of its length and turning."""
    turning = sum(abs(piece.length) for piece in word if piece.kind)
    forward = [piece.length > 0 for piece in word]
    return len({*forward}) == 1 and 4 * turning * sum(abs(piece.length) for piece in word) <= FARTHEST


def _numbers(car: Car) -> tuple[Any, ...]:
    """Return the core's numbers of a car whose axle is the robot's reference point."""
    ratio = car.turning_radius.as_integer_ratio()
    return False, True, ratio, ratio, (0, 1), (0, 1), 1, 0


def _joints(start: Place, pieces: Sequence[Piece]) -> Iterator[Place]:
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
    *_, end = _joints(start, part)
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
