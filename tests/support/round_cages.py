"""Random cages of rounded shapes about the origin, and queries that a flood of slices decides."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import cfree
from arc_rings import CONCAVE, RINGS, Ring, plate, shape
from cfree import Curved, Pose, Scene
from flood import flood
from shapes import PlainScene

SIZE = 20  # of the bounds, on all sides
STEPS = 40  # orientations of a flood
ERROR = 0.02  # of its polygons


def random_part(rng: random.Random, place: tuple[Any, Any], size: Fraction) -> Any:
    """A shape of about a size at a place: a ring with arcs, a disc, or a grown triangle."""
    x, y = place
    name = rng.choice([*RINGS, "disc", "triangle"])
    if name == "disc":
        return Curved.circle((x, y), size / 2)
    if name == "triangle":
        third = size / 3
        return Curved([(x - third, y - third), (x + third, y - third), (x, y + third)], grown=size / rng.randint(8, 20))
    return shape(RINGS[name], x, y, size / 10)


def random_robot(rng: random.Random) -> list[Any]:
    """One part, or two of different kinds and radii that overlap or not."""
    first = random_part(rng, (0, 0), Fraction(rng.randint(12, 56), 8))
    if rng.random() < 0.5:
        return [first]
    place = Fraction(rng.randint(-12, 12), 8), Fraction(rng.randint(-12, 12), 8)
    return [first, random_part(rng, place, Fraction(rng.randint(4, 24), 8))]


def random_cage(seed: int) -> Scene:
    """Four to seven shapes around the origin, with gaps between them that are about as wide as the robot."""
    rng = random.Random(f"cage {seed}")
    count, far = rng.randint(4, 7), rng.randint(7, 11)
    obstacles = []
    for k in range(count):
        angle = 2 * math.pi * (k + rng.uniform(-0.15, 0.15)) / count
        place = Fraction(round(8 * far * math.cos(angle)), 8), Fraction(round(8 * far * math.sin(angle)), 8)
        chord = 2 * far * math.sin(math.pi / count)
        obstacles.append(random_part(rng, place, Fraction(round(8 * chord * rng.uniform(0.9, 1.6)), 8)))
    return Scene(random_robot(rng), obstacles, bounds=(-SIZE, -SIZE, SIZE, SIZE))


JAR: Ring = [(-8, -8), (8, -8), (8, 4), (3, 4, (0, 0), "concave"), (-3, 4), (-8, 4)]
TUB: Ring = [(-8, -8), (8, -8), (8, 0), (5, 0, (0, 0), "concave"), (-5, 0), (-8, 0)]


def random_hollow_cage(seed: int) -> Scene:
    """A jar or a tub below shapes with concave arcs; or a robot that has them among discs and grown triangles."""
    rng = random.Random(f"hollow {seed}")

    def plain(x: Any, y: Any, size: Fraction) -> Any:
        third = size / 3
        ring = [(x - third, y - third), (x + third, y - third), (x, y + third)]
        return rng.choice([Curved.circle((x, y), size / 2), Curved(ring, grown=size / 12), ring])

    def eighths(low: int, high: int) -> Fraction:
        return Fraction(rng.randint(8 * low, 8 * high), 8)

    bounds = (-SIZE, -SIZE, SIZE, SIZE)
    if seed % 3 == 2:
        robot = shape(CONCAVE[rng.choice(["bay", "bracket"])], by=Fraction(rng.randint(3, 6), 10))
        places = [(8 * math.cos(k), 8 * math.sin(k)) for k in range(6)]
        cage = [plain(Fraction(round(8 * x), 8), Fraction(round(8 * y), 8), eighths(5, 10)) for x, y in places]
        return Scene(robot, cage, bounds=bounds)
    lid = plate(eighths(-4, 4), 14) if seed % 2 else shape(CONCAVE["bracket"], -4, eighths(6, 8))
    parts = [plain(0, 0, eighths(3, 8)), plain(eighths(-2, 2), eighths(-2, 2), eighths(2, 4))]
    return Scene(parts[: rng.randint(1, 2)], [shape(rng.choice([JAR, TUB])), lid], bounds=bounds)


def random_facing_cage(seed: int) -> Scene:
    """A jar or a tub with a lid that has concave arcs, and a robot with convex ones."""
    rng = random.Random(f"facing {seed}")
    size = Fraction(rng.randint(24, 60), 8)
    robot = shape(RINGS[rng.choice([*RINGS])], 0, 0, size / 10)
    at = Fraction(rng.randint(-32, 32), 8)
    lid = plate(at, 14) if seed % 2 else shape(CONCAVE["bracket"], -4, 6 + abs(at) / 2)
    return Scene(robot, [shape(rng.choice([JAR, TUB])), lid], bounds=(-SIZE, -SIZE, SIZE, SIZE))


def decided(scene: Scene, most: int, seed: int) -> Iterator[tuple[Pose, Pose, bool]]:
    """Yield start, goal, and True if polygons around the shapes prove them joined, False if those inside prove not."""
    rng = random.Random(seed)
    for outward in (True, False):
        known = flood(_plain(scene.outer(ERROR) if outward else scene.inner(ERROR)), STEPS)
        labels = known.certain if outward else known.possible
        poses = [Pose(x, y, t) for (x, y), t in zip(known.xy.tolist(), known.theta.tolist(), strict=True)]
        free = [k for k, pose in enumerate(poses) if outward or cfree.is_free(scene, pose)]
        pairs = [(a, b) for a in free for b in free if a < b and (labels[a] == labels[b]) == outward]
        for a, b in rng.sample(pairs, min(most, len(pairs))):
            yield poses[a], poses[b], outward


def _plain(scene: Scene) -> PlainScene:
    robot, obstacles = ([_rings(part) for part in parts] for parts in (scene.robot, scene.obstacles))
    assert scene.bounds is not None
    return PlainScene(robot, obstacles, tuple(map(float, scene.bounds)))


def _rings(polygon: Any) -> tuple[list[Any], list[list[Any]]]:
    outer, *holes = ([(float(x), float(y)) for x, y in ring] for ring in polygon.exact_rings)
    return outer, holes
