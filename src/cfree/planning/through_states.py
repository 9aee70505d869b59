"""Paths of a vehicle through given states, exact and proved free.

Words at exactly a car's turning radius have in general no rational form, so that here they get a radius larger by a
share of 2^-16. Most states stay where they are. Where a word of the larger radius cannot have the same ends, such as a
single arc, the states between some words move; the words then share the change.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np

import cfree._core as _core
from cfree.collision.motion import Motion, joining
from cfree.collision.motion_checker import MotionChecker
from cfree.exact.pose import Pose
from cfree.paths.driving import is_drivable
from cfree.paths.path import Path
from cfree.planning.core_ways import from_numbers, numbers_of
from cfree.planning.given_words import NOTHING, SAME, Floats, GivenWords, Piece, Place, given_words, joints_of
from cfree.scene.frame import frame_of
from cfree.scene.naming import placed
from cfree.scene.scene import Scene
from cfree.vehicles.vehicle import Car, Vehicle

SLACK = 2.0**-16  # share by which a radius is larger than the car's
FARTHEST = 2.0**-10  # most deviation, in radii
SHORT = 1e-3  # shorter pieces may be left out, in radii
CLOSED = 1e-11  # greatest error of an end in doubles, in radii
STEPS = 20  # of Newton's method


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
            joints = [*joints_of((0.0, 0.0, 0.0), [replace(p, length=d) for p, d in zip(pieces, lengths, strict=True)])]
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
            joints = [*joints_of((row[0] / old, row[1] / old, row[2]), local)]
            there += pairwise(joints)
        at = float(pose.x) / self.radius, float(pose.y) / self.radius, pose.theta
        here = [*joints_of(at, fresh)]
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
            *_, (x, y, theta) = joints_of((x, y, theta), word)
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
