"""A car without reverse gear in random rooms: ``python benchmarks/forward_rooms.py [100] [--seed 7]``.

Each room has a path of the robot that moves in any direction and touches nothing at start and goal. It prints how many
have a path of the car, how many are proved to have none, and how many stay open.
"""

from __future__ import annotations

import argparse
import math
import random
import time
from collections import Counter
from collections.abc import Iterator

import cfree
from cfree import Car, Path, Pose, PoseChecker, Scene, UndecidedError, plan

SIDE = 16
ROBOT = [("-1.5", "-0.6"), ("1.5", "-0.6"), ("1.5", "0.6"), ("-1.5", "0.6")]
CAR = Car("5/2", axle=("-0.9", 0), gears="forward")


def forward_rooms(count: int = 100, seed: int = 7) -> Iterator[Scene]:
    """Yield rooms of 8 to 22 triangles to pentagons, in which a path of the robot joins start and goal."""
    rng = random.Random(seed)
    while count:
        obstacles = []
        for _ in range(rng.randint(8, 22)):
            x, y, first, corners = rng.uniform(0, SIDE), rng.uniform(0, SIDE), rng.uniform(0, 6.28), rng.randint(3, 5)
            radius, angles = rng.uniform(0.4, 2), (first + k * 6.283 / corners for k in range(corners))
            obstacles.append([(round(x + radius * math.cos(a), 2), round(y + radius * math.sin(a), 2)) for a in angles])
        scene = Scene(ROBOT, obstacles, workspace=[(0, 0), (SIDE, 0), (SIDE, SIDE), (0, SIDE)])
        checker, ends = PoseChecker(scene), list[Pose]()
        while len(ends) < 2:
            pose = round(rng.uniform(1, 15), 3), round(rng.uniform(1, 15), 3), rng.uniform(0, 6.28)
            if checker.is_free([pose], threads=1)[0]:
                ends.append(Pose(*pose))
        scene = Scene(ROBOT, obstacles, workspace=scene.workspace, start=ends[0], goal=ends[1])
        if isinstance(path := plan(scene, improve=0), Path) and cfree.clearance(path, scene).least > 0:
            count -= 1
            yield scene


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("count", type=int, nargs="?", default=100)
    parser.add_argument("--seed", type=int, default=7)
    chosen = parser.parse_args()
    tally, seconds = Counter[str](), list[float]()
    for k, scene in enumerate(forward_rooms(chosen.count, chosen.seed)):
        begin = time.perf_counter()
        try:
            answer: object = plan(scene, vehicle=CAR, improve=0)
        except UndecidedError as error:
            answer = error
        seconds.append(time.perf_counter() - begin)
        tally[type(answer).__name__] += 1
        print(f"room {k:3} {seconds[-1]:6.2f} s  {answer!r}", flush=True)
    print(dict(tally), f"median {sorted(seconds)[len(seconds) // 2]:.2f} s, most {max(seconds):.2f} s")


if __name__ == "__main__":
    main()
