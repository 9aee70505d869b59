"""Words of vehicles: in doubles they lead to the goal, and their exact forms end there to the last digit."""

import math
import random
from fractions import Fraction
from itertools import pairwise
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cfree import Car, DifferentialDrive, Path, Pose, _core, is_drivable, motion_between
from cfree.planning.core_ways import from_numbers, numbers_of
from cfree.planning.vehicles import numbers_of_vehicle

Word = list[tuple[int, float]]


def end_of(word: Word) -> tuple[float, float, float]:
    """Where a word leads, from (0, 0, 0), with radius 1."""
    x = y = theta = 0.0
    for kind, length in word:
        if kind == 0:
            x, y = x + length * math.cos(theta), y + length * math.sin(theta)
            continue
        turned = theta + kind * length
        x += kind * (math.sin(turned) - math.sin(theta))
        y -= kind * (math.cos(turned) - math.cos(theta))
        theta = turned
    return x, y, theta


def misses(word: Word, goal: tuple[float, float, float]) -> float:
    x, y, theta = end_of(word)
    return max(abs(x - goal[0]), abs(y - goal[1]), abs(math.remainder(theta - goal[2], math.tau)))


def length_of(word: Word) -> float:
    return sum(abs(length) for _, length in word)


def random_goal(rng: random.Random) -> tuple[float, float, float]:
    size = 10 ** rng.uniform(-3, 1)
    return rng.uniform(-size, size), rng.uniform(-size, size), rng.uniform(-math.pi, math.pi)


def exact(vehicle: Car | DifferentialDrive, start: Pose, goal: Pose, kind: str, angle: float = 0.0) -> list[Any]:
    """Exact words between axle poses; None where there is none."""
    numbers = numbers_of_vehicle(vehicle), numbers_of(start), numbers_of(goal)
    found = _core.exact_words(*numbers, kind, angle)
    return [word and [from_numbers(pose) for pose in word] for word in found]


def require(vehicle: Car | DifferentialDrive, start: Pose, goal: Pose, joints: list[Pose]) -> None:
    """The word leads exactly from start to goal, and the vehicle can drive it."""
    path = Path(joints[0], [motion_between(a, b) for a, b in pairwise(joints)])
    assert joints[0] == start and joints[-1] == path.goal == goal
    assert is_drivable(path, vehicle)
    assert all(abs(motion.turn) < 2.9 for motion in path.motions)


@pytest.mark.parametrize("forward_only", [False, True])
def test_every_word_in_doubles_leads_to_the_goal(forward_only: bool) -> None:
    rng = random.Random(3)
    for _ in range(500):
        goal = random_goal(rng)
        words = _core.vehicle_words(*goal, forward_only)
        assert len(words) >= 2
        assert max(misses(word, goal) for word in words) < 1e-12
        assert not forward_only or all(length >= 0 for word in words for _, length in word)


def test_the_shortest_word_is_as_long_after_reflection_reversal_and_exchange_of_the_ends() -> None:
    rng = random.Random(4)
    for _ in range(500):
        x, y, theta = random_goal(rng)
        length = length_of(_core.shortest_word(x, y, theta))
        c, s = math.cos(theta), math.sin(theta)
        for goal in ((x, -y, -theta), (-x, y, -theta), (-c * x - s * y, s * x - c * y, -theta)):
            assert length_of(_core.shortest_word(*goal)) == pytest.approx(length, abs=1e-9)
        assert length >= math.hypot(x, y) - 1e-9


def test_known_shortest_words() -> None:
    assert length_of(_core.shortest_word(5, 0, 0)) == pytest.approx(5)
    assert length_of(_core.shortest_word(-5, 0, 0)) == pytest.approx(5)
    assert length_of(_core.shortest_word(1, 1, math.pi / 2)) == pytest.approx(math.pi / 2)
    # half a turn on the spot takes three arcs of a third of it
    assert length_of(_core.shortest_word(0, 0, math.pi)) == pytest.approx(math.pi)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10**6), st.sampled_from([Car(1), Car("1/3"), Car((2, 3)), Car("5/2", gears="forward")]))
def test_exact_words_end_exactly_at_their_goal(seed: int, car: Car) -> None:
    rng = random.Random(seed)
    x, y, theta = random_goal(rng)
    start = Pose(rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(-3, 3))
    goal = Pose(float(start.x) + x, float(start.y) + y, start.theta + theta)
    words = exact(car, start, goal, "words")
    assert words[0] is not None or words[1] is not None
    for word in words:
        if word is not None:
            require(car, start, goal, word)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10**6), st.sampled_from([0, 1, 2, 4, 6, 10, 20, 30]))
def test_steering_works_at_any_scale(seed: int, exponent: int) -> None:
    rng, size = random.Random(seed), Fraction(1, 10**exponent)
    start = Pose(rng.uniform(-9, 9), rng.uniform(-9, 9), {"tau": Fraction(rng.randrange(-999, 999), 500)})
    tau = Fraction(rng.randrange(-1000, 1000), 1000) * size
    goal = start @ Pose(
        Fraction(rng.randrange(-99, 99), 99) * size, Fraction(rng.randrange(-99, 99), 150) * size, {"tau": tau}
    )
    if goal == start:
        return
    car, drive = Car(1), DifferentialDrive()
    (word,) = exact(car, start, goal, "steer")
    require(car, start, goal, word)
    path = Path(word[0], [motion_between(a, b) for a, b in pairwise(word)], vehicle=car)
    local = start.inverse() @ goal
    bound = 4 * abs(local.x) + 7 * abs(2 * (local.tau or 0))
    assert sum(part.length for part in path.driving) <= float(bound) + 6 * math.sqrt(abs(local.y)) + 1e-300
    across = abs(float(local.y)) + abs(float(tau)) * abs(float(local.x))
    for kind, angle in (("turns", 0.0), ("zigzag", min(1.4, max(1e-9, math.sqrt(across))))):
        made = [word for word in exact(drive, start, goal, kind, angle) if word is not None]
        assert made or kind == "turns"
        for word in made:
            require(drive, start, goal, word)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10**6), st.sampled_from([0, 1e-3, 1e-9, 1e-15]))
def test_nearly_straight_ways_are_two_arcs(seed: int, turn: float) -> None:
    rng = random.Random(seed)
    start = Pose(rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(-3, 3))
    ahead = rng.choice([-1, 1]) * rng.uniform(1, 9)
    goal = start @ Pose(ahead, rng.uniform(-1, 1) * 1e-12, {"tau": Fraction(rng.uniform(-1, 1) * turn)})
    (word,) = exact(Car(1), start, goal, "biarc")
    if word is not None:  # a radius may be too small
        require(Car(1), start, goal, word)
        assert len(word) <= 3
    elif turn == 0:
        raise AssertionError("equal headings always have one here")


def test_a_straight_way_is_one_exact_motion() -> None:
    start, goal = Pose(1, 2, {"tau": "1/3"}), Pose(1, 2, {"tau": "1/3"}) @ Pose("7/3", 0)
    for vehicle, kind in ((Car(1), "biarc"), (DifferentialDrive(), "turns")):
        word = exact(vehicle, start, goal, kind)[0]
        assert word == [start, goal]


@pytest.mark.slow
def test_words_take_a_few_microseconds() -> None:
    car, start, goal = Car(1), Pose(0.1, 0.2, 0.3), Pose(2.3, -0.7, 1.9)
    numbers = numbers_of_vehicle(car), numbers_of(start), numbers_of(goal)
    best = [min(_core.time_words(*numbers, 1000)[k] for _ in range(5)) for k in (0, 1)]
    assert best[0] < 2e-6 * 4 and best[1] < 20e-6 * 4, "targets are 2 and 20 us on an idle machine"
