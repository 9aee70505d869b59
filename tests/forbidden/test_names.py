"""What a part of a boundary is called: the same whatever else the scene has, and in whatever order."""

from __future__ import annotations

import math
import random
from dataclasses import fields
from itertools import count, islice

import numpy as np
import pytest

from cfree import boundary
from cfree.contact.kind import Kind
from cfree.scene.features import ShapeFeatures, scene_features, unpacked
from compared import scene_of
from shapes import KINDS, PlainScene, Shape, moved, random_scene

Row = tuple[object, ...]
CODED = ("lower", "upper", "from_first", "from_second", "to_first", "to_second")


def box_of(shape: Shape) -> tuple[float, float, float, float]:
    x, y = zip(*shape[0], strict=True)
    return min(x), min(y), max(x), max(y)


def crowd(kind: str, seed: int) -> tuple[PlainScene, list[int]] | None:
    """Scenes of a kind on and beside one another; which obstacles are within the robot's diameter of the first."""
    plain, rng = random_scene(seed, kind), random.Random(f"{kind} {seed}")
    x0, y0, x1, y1 = np.array([box_of(part) for part in plain.robot]).T
    diameter = math.hypot(max(x1) - min(x0), max(y1) - min(y0))
    step = max(math.ceil(diameter) // 2, 1)
    obstacles = list(plain.obstacles)
    for k in range(5):
        others = random_scene(rng.randrange(10**6), kind) if k % 2 else plain
        dx, dy = (step * rng.randrange(-6, 7) for _ in "xy")
        obstacles += [moved(shape, dx, dy) for shape in others.obstacles]
    obstacles, reach = obstacles[:24], diameter * (1 + 1e-9)
    a0, b0, a1, b1 = box_of(obstacles[0])
    near = [
        k
        for k, (c0, d0, c1, d1) in enumerate(map(box_of, obstacles))
        if max(a0 - c1, c0 - a1, b0 - d1, d0 - b1) <= reach
    ]
    scene, part = PlainScene(plain.robot, obstacles), PlainScene(plain.robot, [obstacles[k] for k in near])
    # the same integers stand for the same numbers
    alike = len(near) < len(obstacles) and scene_features(scene_of(scene)).scale == scene_features(scene_of(part)).scale
    return (scene, near) if alike else None


def of_first(robot: list[Shape], obstacles: list[Shape], order: list[int]) -> dict[Row, list[Row]]:
    """Trapezoids on the first obstacle by contact: all columns, features as the places they stand for."""
    result = boundary(scene_of(PlainScene(robot, [obstacles[k] for k in order])), threads=1)
    features, table = result.features, result.trapezoids
    names: dict[int, Row] = {}

    def place(shape: ShapeFeatures, k: int, is_line: bool) -> Row:
        if not is_line:
            return shape.vertices[k]
        (x, y), (z, w) = shape.vertices[int(shape.v[k])], shape.vertices[int(shape.w[k])]
        divisor = math.gcd(z - x, w - y)
        dx, dy = (z - x) // divisor, (w - y) // divisor
        return dx, dy, dx * y - dy * x

    def name(code: int) -> Row:
        if code not in names:
            kind, i, j = (int(part[0]) for part in unpacked(np.array([code], np.uint64)))
            is_line = (
                kind not in (Kind.VERTEX_EDGE, Kind.VERTEX_VERTEX),
                kind not in (Kind.EDGE_VERTEX, Kind.VERTEX_VERTEX),
            )
            names[code] = (
                kind,
                place(features.robot, i, is_line[0]),
                place(features.obstacles, j, is_line[1]),
            )
        return names[code] if code else ()

    found: dict[Row, list[Row]] = {}
    columns = [
        (column.name, getattr(table, column.name).tolist()) for column in fields(table) if column.name != "patch"
    ]
    for k, patch in enumerate(table.patch.tolist()):
        j = int(result.contact_obstacle[patch])
        if order[features.obstacles.owner_polygon[j]] == 0:
            contact = (
                int(result.contact_kind[patch]),
                int(result.contact_robot[patch]),
                int(features.obstacles.owner_vertex[j]),
            )
            row = tuple(name(column[k]) if of in CODED else column[k] for of, column in columns)
            found.setdefault(contact, []).append(row)
    return found


@pytest.mark.slow
@pytest.mark.parametrize("kind", sorted({*KINDS} - {"bounds", "workspace"}))
def test_a_part_with_what_is_within_reach_and_far_obstacles_in_any_order(kind: str) -> None:
    crowds = (crowd(kind, seed) for seed in count())
    for (robot, obstacles, *_), near in islice(filter(None, crowds), 2):
        rng, every = random.Random(kind), range(len(obstacles))
        whole = of_first(robot, obstacles, [*every])
        assert of_first(robot, obstacles, near) == whole
        far = [k for k in every if k not in near]
        places, rest = sorted(rng.sample(every, len(near))), iter(rng.sample(far, len(far)))
        mixed = [near[places.index(k)] if k in places else next(rest) for k in every]
        assert of_first(robot, obstacles, mixed) == whole
