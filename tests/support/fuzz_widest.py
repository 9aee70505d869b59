"""Largest discs that get from start to goal, compared with the exact cells of discs a little smaller and larger.

Run it for many scenes: `python tests/support/fuzz_widest.py FIRST LAST`, with `--arcs` among shapes with arcs as sides.
"""

from __future__ import annotations

import random
import sys
from collections.abc import Callable
from fractions import Fraction
from typing import Any

from cfree import Curved, Polygon, Pose, Scene, UnsupportedError, boundary, free_space
from cfree.curves import Arc, Circle
from cfree.planning.widest_way import WidestWay, widest_way

NEAR = Fraction(1, 2**40)
BOX = [(-12, -12), (12, -12), (12, 12), (-12, 12)]


def straight(r: random.Random, x: int, y: int, w: int, h: int) -> Any:
    """A box, a box that leans, a disc, a rounded box or a frame; of small numbers, so that many things are tied."""
    box = [(x, y), (x + w, y - r.randint(0, 1) * (h > 1)), (x + w, y + h), (x, y + h)]
    match r.randrange(5):
        case 0 | 1:
            return box
        case 2:
            return Curved.circle((x + Fraction(w, 2), y), Fraction(w, 2))
        case 3:
            return Curved(box, grown=Fraction(r.randint(1, 3), 2))
    side = w + 2
    inner = [(x + 1, y + 1), (x + side - 1, y + 1), (x + side - 1, y + side - 1), (x + 1, y + side - 1)]
    return Polygon([(x, y), (x + side, y), (x + side, y + side), (x, y + side)], [inner])


def with_arcs(r: random.Random, x: int, y: int, w: int, h: int) -> Any:
    """Half a disc, a lens, a moon, or a box with a bay, a round hole or a fillet; or a shape without arcs as sides."""
    half, turn = Fraction(w, 2), r.choice(((1, 0), (0, 1), (Fraction(3, 5), Fraction(4, 5))))

    def at(u: Any, v: Any) -> tuple[Any, Any]:
        return x + turn[0] * u - turn[1] * v, y + turn[1] * u + turn[0] * v

    ends, top = [at(-w, 0), Arc(at(w, 0), center=at(0, Fraction(3 * w, 4)))], h + half
    match r.randrange(8):
        case 0:
            return Curved([at(w, 0), Arc(at(-w, 0), center=at(0, 0))])
        case 1:
            return Curved([*ends, Arc(at(-w, 0), center=at(0, -Fraction(3 * w, 4)))])
        case 2:
            moon = at(-w, 0), Arc(at(w, 0), center=at(0, 0))
            return Curved([*moon, Arc(at(-w, 0), center=at(0, Fraction(3 * w, 4)), clockwise=True)])
        case 3:
            bay = at(half, top), Arc(at(-half, top), center=at(0, top), clockwise=True)
            return Curved([at(-w, 0), at(w, 0), at(w, top), *bay, at(-w, top)])
        case 4:
            return Curved([at(-w, -w), at(w, -w), at(w, w), at(-w, w)], [Circle(at(0, 0), half)])
        case 5:
            fillet = at(1 + h, 1), Arc(at(1, 1 + h), center=at(1 + h, 1 + h), clockwise=True)
            return Curved([at(0, 0), at(h + 2, 0), at(h + 2, 1), *fillet, at(1, h + 2), at(0, h + 2)])
    return straight(r, x, y, w, h)


def scene_of(seed: int, shape: Callable[..., Any] = straight) -> Scene:
    """A scene with obstacles at random, often some along a line; start is above it, and goal mostly below."""
    r = random.Random(seed)
    obstacles = [
        shape(r, r.randint(-9, 9), r.randint(-5, 3), r.randint(1, 4), r.randint(1, 4)) for _ in range(r.randint(0, 5))
    ]
    x = -12
    while r.random() < 0.95 and x < 12:
        w = r.randint(1, 5)
        obstacles.append(shape(r, x, r.randint(-1, 1), w, 1))
        x += w + r.randint(1, 4)
    limits: dict[str, Any] = {"workspace": BOX} if r.random() < 0.5 else {}
    if shape is with_arcs and r.random() < 0.3:
        limits["workspace"] = Curved.circle((0, 0), r.randint(13, 15))
    center: Any = (0, 0)
    if r.random() < 0.4:
        limits["bounds"] = tuple(sign * r.randint(7, 13) for sign in (-1, -1, 1, 1))
    elif r.random() < 0.3:
        center = (1, "1/2")
    start = Pose(r.randint(-10, 10), r.randint(6, 10), 0)
    goal = Pose(r.randint(-10, 10), r.choice([-1, -1, 1]) * r.randint(6, 10), r.choice([0, "90deg"]))
    return Scene(Curved.circle(center, 1), obstacles, start=start, goal=goal, **limits)


def joined(scene: Scene, way: WidestWay, radius: Fraction) -> bool:
    """True if a disc of some radius gets from start to goal without touching."""
    robot = Curved.circle(way.center, radius)
    other = Scene(robot, scene.obstacles, workspace=scene.workspace, bounds=scene.bounds)
    assert scene.start and scene.goal
    return free_space(boundary(other)).common_cell(scene.start, scene.goal) is not None


def check(seed: int, shape: Callable[..., Any] = straight) -> str:
    """Compare one scene; return what stopped the disc. Poses on the rim of bounds belong to no cell there."""
    scene = scene_of(seed, shape)
    assert scene.start and scene.goal
    way = widest_way(scene, scene.start, scene.goal)
    assert way is not None
    if way.radius is None:
        return "free"
    on_rim = scene.bounds and any(
        pose.x in scene.bounds[::2] or pose.y in scene.bounds[1::2] for pose in (scene.start, scene.goal)
    )
    low, high = way.radius.neighbours(40) if way.radius.q else (way.radius.p - NEAR, way.radius.p + NEAR)
    try:
        assert not joined(scene, way, high), (seed, way)
        assert low <= 0 or on_rim or joined(scene, way, low), (seed, way)
    except UnsupportedError:
        return "unsupported"
    return "nothing" if way.at is None else way.at.end or ("rim" if -1 in way.at.obstacles else "gap")


def main(first: int, last: int, shape: Callable[..., Any]) -> None:
    counts: dict[str, int] = {}
    for seed in range(first, last):
        found = check(seed, shape)
        counts[found] = counts.get(found, 0) + 1
    print(counts)


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]), with_arcs if "--arcs" in sys.argv else straight)
