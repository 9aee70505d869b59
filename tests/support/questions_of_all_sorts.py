"""Questions for pictures: seeded scenes with a start and a goal, in great variety."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import shapely

from cfree.exact.pose import Pose
from cfree.scene.scene import Scene


def scenes(seed: int, count: int = 5) -> Iterator[tuple[Scene, Pose, Pose]]:
    """Questions of all sorts: crowded or empty, long or square, in any unit, with bounds, walls, and long names."""
    random = np.random.default_rng(seed)
    for k in range(count):
        width, height = random.uniform(4, 30, 2) * (1, random.choice([1, 0.15]))
        unit = 10.0 ** random.choice([-3, 0, 4])
        sides = random.uniform(0.3, 1.5, 2)
        robot = np.array([(0, 0), (1, 0), (1, 1), (0, 1)]) * sides - random.uniform(0, 1, 2) * sides

        def convex(place: Any, size: float) -> list[Any]:
            angles = np.sort(random.uniform(0, 2 * np.pi, random.integers(3, 7)))
            points = place + size * np.column_stack((np.cos(angles), np.sin(angles)))
            return points.tolist()  # type: ignore[no-any-return]

        places = random.uniform((0, 0), (width, height), (int(random.integers(1, 14)), 2))
        obstacles = [convex(place, random.uniform(0.3, 1.4)) for place in places]
        free = shapely.union_all([shapely.Polygon(ring).buffer(float(np.hypot(*sides))) for ring in obstacles])
        ends = [p for p in random.uniform((0, 0), (width, height), (60, 2)) if not free.contains(shapely.Point(p))]
        if len(ends) < 2:
            continue
        goal = ends[0] if k == 3 else ends[1]
        bounds = (-1, -1, width + 1, height + 1) if random.random() < 0.6 else None
        around = None if k % 3 == 1 else [(-4, -4), (width + 4, -4), (width + 4, height + 4), (-4, height + 4)]
        scene = Scene(
            robot=(unit * robot).tolist(),
            obstacles=[(unit * np.array(ring)).tolist() for ring in obstacles],
            bounds=None if bounds is None else [unit * b for b in bounds],
            workspace=None if around is None else (unit * np.array(around)).tolist(),
            units=str(random.choice(["", "m", "corridor widths"])),
            name=str(random.choice(["", "a scene with a name as long as names of scenes come to be"])),
        )
        turns = random.uniform(0, 360, 2)
        start, end = (
            Pose(*(unit * p).tolist(), f"{turn:.1f}deg") for p, turn in zip((ends[0], goal), turns, strict=True)
        )
        yield scene, start, end
