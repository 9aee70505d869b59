"""Routes in folders against plans of the whole scene: rooms of all sizes, ends on borders and in corners.

    python fuzz_routes.py --count 200 --seed 0
    python fuzz_routes.py --count 200 --seed 0 --round

Scenes are mazes of chambers whose walls have doors, or none. Each is asked with rooms of several sizes, so that some
chambers are left only through a neighbour. Answers are paths exactly where those of the whole scene are, every path is
free in the whole scene, and proofs are checked among their own obstacles. With `--round` walls and robots are rounded,
with pillars, and doors that a disc just fits through; queries that one of the two leaves undecided are counted.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

import numpy as np

import cfree
from cfree import Curved
from cfree.curves import Arc
from cfree.distributed import boundary, planning
from cfree.distributed.division import Features
from cfree.distributed.planning import Surroundings, plan_among
from cfree.distributed.portals import StoredGround
from cfree.exact.pose import Pose
from cfree.planning import routes
from cfree.planning.atlas import Entry, LazyAtlas
from cfree.planning.portals import parts_of
from cfree.planning.rooms import Rooms, divided
from cfree.scene.scene import box_of

SIZE = 10  # of a chamber
ROBOTS = (
    [(0, 0), (2, 0), (0, 1)],
    [(-2, "-1/2"), (2, "-1/2"), (2, "1/2"), (-2, "1/2")],
    [(-1, -1), (1, -1), (1, 1), (-1, 1)],
)
DOORS = (0, 0, 0, 0, 0, 1, 2, 4, 5)  # widths; 0 is none


def maze(seed: int, *, is_round: bool = False) -> cfree.Scene:
    """Chambers in rows, most of them with doors to some of those beside them."""
    rng = np.random.default_rng([46, seed])
    rows, columns = rng.integers(2, 5, 2).tolist()
    walls: list[list[tuple[float, float]]] = []
    for i in range(rows + 1):
        for j in range(columns + 1):
            for along in (0, 1):
                walls += _wall(rng, (SIZE * j, SIZE * i), along, (j == columns, i == rows)[along])
    slant = int(rng.integers(0, 4)) == 0
    turned = [[(7 * x - y, 7 * y + x) if slant else (x, y) for x, y in wall] for wall in walls]
    robot = ROBOTS[int(rng.integers(0, len(ROBOTS)))]
    larger = [(7 * Fraction(x), 7 * Fraction(y)) for x, y in robot] if slant else robot
    bounds = (-8, -8, SIZE * columns + 8, SIZE * rows + 8) if rng.integers(0, 3) == 0 and not slant else None
    if is_round:
        return _rounded(rng, 7 if slant else 1, larger, turned, bounds)
    return cfree.Scene(larger, turned, bounds=bounds)


def _rounded(
    rng: np.random.Generator,
    size: int,
    robot: Sequence[Any],
    walls: Sequence[Sequence[tuple[float, float]]],
    bounds: Sequence[float] | None,
) -> cfree.Scene:
    """The same with walls that are grown by a disc, or not; other robots, too, and a pillar in some chambers."""
    robots = [
        Curved(robot, grown=Fraction(size, 4)),
        Curved.circle((0, 0), size),
        Curved.circle((size, 0), Fraction(size, 2)),
        Curved(robot, holes=[]),
        Curved([(-size, -size), (size, -size), Arc((size, size), center=(size, 0)), (-size, size)]),
    ]
    grown = Fraction(int(rng.integers(0, 3)), 8) * size
    obstacles = [Curved(wall, grown=grown) if grown and rng.integers(0, 4) else wall for wall in walls]
    for wall in walls:
        if rng.integers(0, 4) == 0:
            x, y = (round(value) + int(rng.integers(2, 8)) * size for value in wall[0])
            obstacles.append(Curved.circle((x, y), Fraction(int(rng.integers(1, 9)), 4) * size))
    return cfree.Scene(robots[int(rng.integers(0, len(robots)))], obstacles, bounds=bounds)


def _wall(
    rng: np.random.Generator, corner: tuple[int, int], along: int, is_beyond: bool
) -> Iterator[list[tuple[float, float]]]:
    """Wall from a corner, with a door or without one; sometimes none at all."""
    if is_beyond or rng.integers(0, 25) == 0:
        return
    door = DOORS[int(rng.integers(0, len(DOORS)))]
    begin = int(rng.integers(1, SIZE - door)) if door else SIZE
    for a, b in ((0, begin), (begin + door, SIZE)):
        if a < b:
            box = [(a, -0.25), (b, -0.25), (b, 0.25), (a, 0.25)]
            yield [(corner[0] + (x if along == 0 else y), corner[1] + (y if along == 0 else x)) for x, y in box]


class ExactAtlas(LazyAtlas):
    """Rooms whose portals are joined as their free space joins them, as in a folder."""

    def entry(self, room: int) -> Entry:
        if room not in self._entries:
            portals = super().entry(room).portals
            box = self.rooms.box(room)
            scene = self.ground.part(self.ground.near(box), box)
            self._entries[room] = Entry(portals, parts_of(scene, portals).tolist())
        return self._entries[room]


def ends(scene: cfree.Scene, rooms: Rooms, seed: int, count: int) -> list[Pose]:
    """Free poses, among them some on borders of rooms and in their corners."""
    rng = np.random.default_rng([47, seed])
    checker, result = cfree.PoseChecker(scene), []
    boxes = np.array([box_of(obstacle) for obstacle in scene.obstacles])
    low, high = boxes[:, :2].min(axis=0) - 1, boxes[:, 2:].max(axis=0) + 1
    for _ in range(50 * count):
        x, y = rng.uniform(low, high)
        room = rooms.boxes[int(rng.integers(0, len(rooms)))]
        kind = int(rng.integers(0, 4))
        x = float(room[rng.integers(0, 2) * 2]) if kind in (1, 3) else float(np.round(x, 2))
        y = float(room[rng.integers(0, 2) * 2 + 1]) if kind in (2, 3) else float(np.round(y, 2))
        pose = Pose(x, y, {"tau": str(Fraction(int(rng.integers(-8, 9)), 4))})
        if checker.is_free(pose):
            result.append(pose)
        if len(result) == count:
            break
    return result


def hunt(seed: int, folder: FilePath, *, is_round: bool = False) -> dict[str, int]:
    """Ask about one maze in many ways; return how many answers of each kind there were."""
    scene = maze(seed, is_round=is_round)
    found = boundary(scene, folder=folder, tiles=1 + seed % 4)
    features = Features(found.work.store)
    edges, ground = features.boxes(features.numbers), StoredGround(found.work)
    counts: dict[str, int] = {"path": 0, "proof": 0, "undecided": 0, "only here": 0}
    checker = cfree.MotionChecker(scene)
    plain, routed = planning.joined, list[Pose]()

    def joined(start: Pose, *rest: Any) -> Any:
        routed.append(start)
        return plain(start, *rest)

    planning.joined, routes.DISTANT = joined, 1  # all goals count as far
    for most in (2, 5, 12, 40):
        rooms = divided(edges, ground.radius / (4 if most < 12 else 1), scene.bounds, most)
        poses = ends(scene, rooms, seed, 6)
        for start, goal in zip(poses[::2], poses[1::2], strict=False):
            known = Surroundings(found.work)
            known.__dict__["atlas"] = (LazyAtlas, ExactAtlas)[seed // 2 % 2](ground, rooms)
            where = f"seed {seed}, {most} edges a room, from {start} to {goal}"
            expected = of_whole(scene, start, goal) if is_round else cfree.plan(scene, start, goal, improve=0.0)
            try:
                answer = plan_among(known, start, goal, improve=None if seed % 2 else 0.0)
            except cfree.errors.UndecidedError:
                assert is_round, where
                counts["undecided"] += 1
                assert expected is None, f"{where}: undecided, {expected}"
                continue
            if expected is None:
                counts["only here"] += 1
            else:
                is_same = isinstance(answer, cfree.Path) == isinstance(expected, cfree.Path)
                assert is_same, f"{where}: {answer}, {expected}"
            if isinstance(answer, cfree.Path) or not is_round or most == 5:
                checked = cfree.verify.answer(*found.scene_for(answer))
                assert checked.verified, f"{where}: {checked}"
            if isinstance(answer, cfree.Path):
                assert (answer.start, answer.goal) == (start, goal), where
                assert answer.is_free(checker), where
            counts["path" if isinstance(answer, cfree.Path) else "proof"] += 1
    planning.joined = plain
    return counts | {"routed": len(routed)}


def of_whole(scene: cfree.Scene, start: Pose, goal: Pose) -> cfree.Path | cfree.planning.proof.Proof | None:
    """Answer for the whole scene; None if it is undecided."""
    with suppress(cfree.errors.UndecidedError):
        return cfree.plan(scene, start, goal, improve=0.0)
    return None


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--round", action="store_true")
    options = parser.parse_args()
    total: dict[str, int] = {}
    for seed in range(options.seed, options.seed + options.count):
        with tempfile.TemporaryDirectory() as name:
            for kind, number in hunt(seed, FilePath(name) / "maze", is_round=options.round).items():
                total[kind] = total.get(kind, 0) + number
        print(f"{seed + 1 - options.seed:,} mazes: {total}", flush=True)
