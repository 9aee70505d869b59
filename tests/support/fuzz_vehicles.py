"""Plan for vehicles in random rooms: ``python tests/support/fuzz_vehicles.py 1000 --seed 1``.

Between poses that touch nothing, a vehicle that reverses has a path if and only if the robot has one. Each path is
integrated from its controls alone, compared with shapely, and verified by both checkers. It prints faults, and exits
with 1. With ``--forward`` the cars have no reverse gear: of a path and a proof by boxes, no room has both.
"""

from __future__ import annotations

import argparse
import random
import sys
import time
from collections import Counter

import cfree._core as _core
from cfree import Car, Path, Pose, Scene, Separated, UndecidedError, Unreachable, plan
from cfree.planning import reach
from cfree.scene.scene import with_ends
from second_opinion import verified_in_a_file
from vehicles import FORWARD, VEHICLES, faults, room

MOST_VERIFIED = 30  # motions


def mistakes(number: int, tally: Counter[str], slowest: list[float]) -> list[str]:
    """Faults of the answers in one room."""
    rng = random.Random(f"room {number}")
    scene, vehicle = room(rng), rng.choice(VEHICLES)
    if rng.random() < 0.5:
        scene = with_ends(scene, scene.goal, scene.start)
    plain = plan(scene, improve=0)
    begin = time.perf_counter()
    try:
        answer = plan(scene, vehicle=vehicle, improve=rng.choice((0, None)))
    except UndecidedError as error:  # it exists, and is too long to write down
        is_proof = isinstance(error.path, Path) and verified_in_a_file(scene, error.path).verified
        tally["too many manoeuvres"] += is_proof
        return [] if is_proof and isinstance(plain, Path) else [f"{vehicle}: {error}"]
    slowest.append(time.perf_counter() - begin)
    tally[type(answer).__name__] += 1
    if isinstance(plain, Separated):
        return [] if answer == plain else [f"{vehicle}: {answer}, and without a vehicle {plain}"]
    if not isinstance(answer, Path):
        return [f"{vehicle}: {answer}, and without a vehicle {plain}"]
    tally["cusps"] += answer.cusps
    wrong = faults(scene, answer)
    if len(answer) <= MOST_VERIFIED:
        tally["verified"] += 1
        wrong += map(str, verified_in_a_file(scene, answer).findings)
    return [f"{vehicle}: {fault}" for fault in wrong]


def reached(scene: Scene, car: Car, start: Pose, goal: Pose) -> list[_core.Boxes]:
    """Boxes of both directions, coarse ones and finer ones."""
    search = reach.Reach(scene, car, start, goal)
    found = []
    for count in reach.BOXES[:2]:
        for side in reach.SIDES:
            boxes = search.boxes(search.grid(count), side)
            boxes.run(10**12)
            found.append(boxes)
    return found


def forward_mistakes(number: int, tally: Counter[str], slowest: list[float]) -> list[str]:
    """Faults of the answers for a car without reverse gear in one room."""
    rng = random.Random(f"forward room {number}")
    scene, car = room(rng), rng.choice(FORWARD)
    assert scene.start is not None and isinstance(scene.goal, Pose)
    begin = time.perf_counter()
    try:
        answer = plan(scene, vehicle=car, improve=0)
    except UndecidedError as error:
        tally["undecided"] += 1
        return [] if error.margin > 0 or "contacts" in str(error) else [f"{car}: {error}"]
    slowest.append(time.perf_counter() - begin)
    tally[type(answer).__name__] += 1
    wrong = list[str]()
    if isinstance(answer, Path):
        wrong += faults(scene, answer)
        excluding = [boxes for boxes in reached(scene, car, scene.start, scene.goal) if not boxes.meets_goal]
        wrong += ["its goal is in none of the boxes"] * bool(excluding)
    if isinstance(answer, Unreachable) or len(answer if isinstance(answer, Path) else ()) <= MOST_VERIFIED:
        tally["verified"] += 1
        wrong += map(str, verified_in_a_file(scene, answer).findings)
    return [f"{car}: {fault}" for fault in wrong]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("count", type=int, help="rooms")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--forward", action="store_true", help="cars without reverse gear")
    chosen = parser.parse_args()
    tally, seconds = Counter[str](), list[float]()
    for number in range(chosen.seed * 1_000_000, chosen.seed * 1_000_000 + chosen.count):
        try:
            wrong = (forward_mistakes if chosen.forward else mistakes)(number, tally, seconds)
        except Exception as error:
            wrong = [repr(error)[:400]]
        tally["rooms"] += 1
        if wrong:
            tally["wrong"] += 1
            print(f"room {number}", *wrong, sep="\n  ", flush=True)
        if tally["rooms"] % 200 == 0:
            print(
                dict(tally), f"median {sorted(seconds)[len(seconds) // 2]:.3f} s, most {max(seconds):.2f} s", flush=True
            )
    print(dict(tally))
    sys.exit(tally["wrong"] > 0)


if __name__ == "__main__":
    main()
