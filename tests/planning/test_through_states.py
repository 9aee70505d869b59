"""Words between given states, made exact: they stay near, end exactly, keep radii and gears; clips are named."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from cfree import Car, DifferentialDrive, MotionChecker, Path, Pose, Scene, _core, is_drivable
from cfree.planning.given_words import given_words
from cfree.planning.through_states import FARTHEST, driven_path
from shapes import box

Floats = NDArray[np.float64]
OPEN = Scene(box(-1, -1, 1, 1)[0], [])


def random_rows(seed: int) -> Floats:
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 7))
    return np.column_stack([rng.uniform(-8, 8, (count, 2)), rng.uniform(-3, 3, count)])


def along(start: tuple[float, float, float], word: list[tuple[int, float]], radius: float, distance: float) -> Floats:
    """Where a word leads after a distance, by its definition."""
    x, y, theta = start
    for kind, length in word:
        step = math.copysign(min(abs(length) * radius, distance), length)
        distance -= abs(step)
        turned = theta + kind * step / radius
        if kind:
            x += kind * radius * (math.sin(turned) - math.sin(theta))
            y -= kind * radius * (math.cos(turned) - math.cos(theta))
        else:
            x, y = x + step * math.cos(theta), y + step * math.sin(theta)
        theta = turned
    return np.array([x, y, theta])


def looked_up(path: Path, shares: int) -> Floats:
    """Axle poses of a path in the open, densely."""
    assert path.vehicle is not None
    rows = []
    for pose, motion in zip(path.poses, path.motions, strict=False):
        for share in np.linspace(0, 1, shares):
            axle = motion.at(pose, motion.parameter(float(share))) @ path.vehicle.frame
            rows.append((float(axle.x), float(axle.y), axle.theta))
    return np.array(rows)


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize(
    "car",
    [
        Car(2),
        Car("1.99"),
        Car(2, gears="forward"),
        Car((1, 2), axle=("-0.7", "0.1"), heading="90deg"),
        DifferentialDrive(),
    ],
    ids=["same radius", "smaller radius", "forward", "axle", "differential"],
)
def test_paths_through_states_are_exact_and_can_be_driven(car: Car | DifferentialDrive, seed: int) -> None:
    rows = random_rows(seed)
    path = driven_path(rows, OPEN, car)
    assert is_drivable(path, car)
    assert path.start @ car.frame == Pose(*rows[0].tolist())
    assert path.goal @ car.frame == Pose(*rows[-1].tolist())
    assert car.gears == "both" or all(part.gear == "forward" for part in path.driving)


@pytest.mark.parametrize("gears", ["both", "forward"])
def test_exact_poses_are_near_those_in_doubles(gears: str) -> None:
    car = Car(2, gears=gears)  # type: ignore[arg-type]
    for seed in range(20):
        rows = random_rows(seed)
        path = driven_path(rows, OPEN, car)
        words = given_words(rows, car).words
        there = []
        for row, word in zip(rows, words, strict=False):
            pairs = [(piece.kind, piece.length) for piece in word]
            total = 2 * sum(abs(length) for _, length in pairs)
            there += [along(tuple(row), pairs, 2, d) for d in np.linspace(0, total, 200)]
        track = looked_up(path, 20)
        gaps = np.linalg.norm(np.array(there)[None, :, :2] - track[:, None, :2], axis=2).min(axis=1)
        steps = max(np.linalg.norm(a[:2] - b[:2]) for a, b in pairwise(there))
        assert gaps.max() <= 2 * FARTHEST + steps


def test_a_larger_radius_is_told_from_the_length_and_states_are_kept() -> None:
    rows = random_rows(5)
    states = [Pose(*row.tolist()) for row in rows]
    length = 2.5 * sum(sum(abs(d) for _, d in _core.shortest_word(*_local(a, b, 2.5))) for a, b in pairwise(rows))
    words = given_words(rows, Car(2), length=length)
    assert words.radius == pytest.approx(2.5, rel=1e-6)
    path = driven_path(rows, OPEN, Car(2), length=length)
    assert set(states) <= set(path.poses)
    assert sum(part.length for part in path.driving) == pytest.approx(length, rel=1e-6)


def _local(a: Floats, b: Floats, radius: float) -> tuple[float, float, float]:
    dx, dy, c, s = b[0] - a[0], b[1] - a[1], math.cos(a[2]), math.sin(a[2])
    return (c * dx + s * dy) / radius, (c * dy - s * dx) / radius, b[2] - a[2]


def test_middles_tell_words_of_equal_length_apart() -> None:
    rows = np.array([(0.0, 0.0, 0.0), (0.0, 0.0, math.pi)])  # a turn on the spot, to either side
    turns = []
    for side in (1, -1):
        word = next(w for w in _core.vehicle_words(0, 0, side * math.pi, False) if len(w) == 3 and w[0][0] == side)
        assert sum(abs(d) for _, d in word) == pytest.approx(math.pi)
        middles = np.array([[along((0, 0, 0), word, 1, math.pi * k / 4) for k in (1, 2, 3)]])
        path = driven_path(rows, OPEN, Car("0.999"), length=math.pi, middles=middles)
        turns.append(path.motions[0].turn)
    assert turns[0] * turns[1] < 0


def test_arcs_in_pieces_share_the_change_of_their_radius() -> None:
    # each state is on OMPL's arc: a larger radius cannot pass all of them, but the whole path has room for it
    word = [(1, 1.0), (0, 3.0), (-1, 1.2)]
    rows = np.array([along((0, 0, 0), word, 1, d) for d in (0, 0.3, 0.7, 2, 3, 4.4, 4.9, 5.2)])
    path = driven_path(rows, OPEN, Car(1))
    assert is_drivable(path, Car(1)) and path.cusps == 0
    assert path.goal == Pose(*rows[-1].tolist())


def test_an_arc_with_exactly_the_radius_has_no_room_and_the_remedy_is_named() -> None:
    rows = np.array([(0, 0, 0), (math.sin(1), 1 - math.cos(1), 1)])
    with pytest.raises(ValueError, match=r"motion 0 of 1: no arcs .* at least 1 .*; give .* such as 1\.0009"):
        driven_path(rows, OPEN, Car(1))
    assert driven_path(rows, OPEN, Car("0.9999")).cusps == 0


def test_equal_states_and_straight_ways_are_no_trouble() -> None:
    rows = np.array([(0, 0, 0.1), (0, 0, 0.1), *[(k * math.cos(0.1), k * math.sin(0.1), 0.1) for k in (1, 3, 3, 2)]])
    path = driven_path(rows, OPEN, Car(1))
    assert path.goal == Pose(*rows[-1].tolist()) and path.cusps == 1
    assert driven_path(rows[:2], OPEN, Car(1)).motions == ()


def test_the_motion_that_clips_is_named_with_its_place_and_obstacle() -> None:
    scene = Scene(box(-1, -1, 1, 1)[0], [box(20, -9, 21, -8)[0], box(6, 6, 8, 8)[0]], bounds=(-9, -9, 30, 9))
    rows = np.array([(-3, 0, 0), (1, 0, 0), (5.5, 4.5, math.pi / 2), (5.5, 8, math.pi / 2)])
    text = r"at \(5\.5, 5, 90 deg\) robot part 0 runs into obstacle 1, 2 x 2 at \(7, 7\)$"
    with pytest.raises(ValueError, match=r"^motion 2 of 3 is not free near 0\.142857 of it: " + text):
        driven_path(rows, scene, Car(4))
    with pytest.raises(ValueError, match=r"^motion 0 of 3 is not free near 0\.25 of it: at \(-9, 9, .* the bounds$"):
        driven_path(np.array([(-8, 9, 0), (-12, 9, 0), *rows[2:]]), replace(scene, bounds=(-9, 0, 9, 20)), Car(4))


def test_the_place_of_a_clip_is_a_share_of_its_whole_motion() -> None:
    scene = Scene(box(-1, -1, 1, 1)[0], [box(2, 7, 6, 8)[0]])  # an arc of 2 pi, and 2 of the 5 after it
    with pytest.raises(ValueError, match=r"^motion 0 of 1 is not free near 0\.734\d+ of it: at \(4, 6, 90 deg\)"):
        driven_path(np.array([(0, 0, 0), (4, 9, math.pi / 2)]), scene, Car("3.99"), length=2 * math.pi + 5)


def test_every_motion_is_proved_free() -> None:
    wall = box(-50, "1.0000001", 50, 3)[0]
    scene = Scene(box(-1, -1, 1, 1)[0], [wall])
    rows = np.array([(0, 0, 0), (5, 0, 0), (9, 0, 0)])
    path = driven_path(rows, scene, Car(2))
    assert path.is_free(MotionChecker(scene))
    with pytest.raises(ValueError, match="motion 1 of 2 is not free"):
        driven_path(np.array([(0, 0, 0), (5, 0, 0), (9, 0, 1e-6)]), scene, Car(2))


def test_ends_equal_to_the_scene_s_up_to_rounding_are_exactly_these() -> None:
    car = Car(1, axle=("-1/3", "1/7"))
    start, goal = Pose("1/3", "1/7", {"tau": "1/3"}), Pose(5, "2/7", {"tau": "-1/5"})
    scene = Scene(box(-1, -1, 1, 1)[0], [], start=start, goal=goal)
    axles = [pose @ car.frame for pose in (start, goal)]
    rows = np.array([(float(pose.x), float(pose.y), pose.theta) for pose in axles])
    path = driven_path(rows, scene, car)
    assert (path.start, path.goal) == (start, goal)
    moved = driven_path(rows + np.array([1e-6, 0, 0]), scene, car)
    assert moved.start != start and moved.goal != goal


def test_motions_of_another_radius_or_kind_are_refused() -> None:
    rows = np.array([(0, 0, 0), (0, 1, math.pi)])
    with pytest.raises(ValueError, match=r"shorter than those of a car .* turning radius of at least 2$"):
        given_words(rows, Car(2), length=math.pi)
    straight = np.array([[(0.0, 0.25, math.pi / 4), (0.0, 0.5, math.pi / 2), (0.0, 0.75, math.pi * 3 / 4)]])
    with pytest.raises(ValueError, match=r"not those of a car .* plan in a ReedsSheppStateSpace\(0\.1\)"):
        given_words(rows, Car("0.1"), length=1.2, middles=straight)
    with pytest.raises(ValueError, match=r"plan in a DubinsStateSpace\(0\.1\)"):
        given_words(rows, Car("0.1", gears="forward"), length=1.2, middles=straight)
