"""Random scenes in which concave arcs of one side face convex arcs of the other one, and what must hold of them."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np

from arc_rings import BAY, BRACKET, CONCAVE, CORNERS, CRESCENT, DOME, HALF, HOOK, LENS, RINGS, plate, shape
from cfree import Boundary, Curved, Polygon, Pose, Scene, boundary, free_space, is_free
from cfree.curves import Arc, Circle

POSES = 60
TURNS = [(Fraction(4, 5), Fraction(3, 5)), (Fraction(-5, 13), Fraction(12, 13)), (Fraction(0), Fraction(1))]
NEAR = (2.0**-20, 2.0**-8)  # distances of poses from contacts, in units of the scenes


def _hollow(rng: random.Random, far: int) -> Curved:
    x, y, by = rng.randint(-far, far), rng.randint(-far, far), rng.choice([1, 1, "1/2", 2])
    if rng.random() < 0.4:
        return plate(x, y, 5 * Fraction(by), 3 * Fraction(by))
    return shape(CONCAVE[rng.choice([*CONCAVE])], x, y, by)


def _bulging(rng: random.Random, far: int, by: tuple[Any, ...] = ("1/4", "1/2", "3/5", "1/3", 1)) -> Curved:
    x, y = Fraction(rng.randint(-2 * far, 2 * far), 2), Fraction(rng.randint(-2 * far, 2 * far), 2)
    return shape(RINGS[rng.choice([*RINGS])], x, y, rng.choice(by))


def mixed(rng: random.Random) -> Scene:
    """A part with convex arcs among one or two obstacles with concave ones."""
    return Scene([_bulging(rng, 2)], [_hollow(rng, 4) for _ in range(rng.randint(1, 2))])


def turned(rng: random.Random) -> Scene:
    """A robot with concave arcs among obstacles with convex ones."""
    return Scene([_hollow(rng, 2)], [_bulging(rng, 5) for _ in range(rng.randint(1, 2))])


def both(rng: random.Random) -> Scene:
    """Concave and convex arcs on both sides."""
    some = [lambda: shape(CRESCENT, by="1/2"), lambda: shape(HOOK, by="1/3"), lambda: shape(CONCAVE["wave"], by="1/4")]
    return Scene([rng.choice(some)()], [_hollow(rng, 3), *([_bulging(rng, 6)] if rng.random() < 0.5 else [])])


def fits(rng: random.Random) -> Scene:
    """A half disc, or another ring of one arc's radius, in a hole nearly or exactly as large, or far larger."""
    hole, hair = Fraction(rng.choice([3, "5/2", 1])), Fraction(1, 2**60)
    ratio = rng.choice([Fraction(1), 1 - hair, 1 + hair, Fraction(99, 100), Fraction(101, 100)])
    ratio = rng.choice([ratio, Fraction(1, 2), Fraction(9, 10), Fraction(7, 10), Fraction(1, 5)])
    ring, radius = rng.choice([(HALF, 5), (DOME, 5), (LENS, 5), (RINGS["sector"], 5), (CORNERS, 3)])
    others = plate(0, 0, 2 * hole, hole), shape(BAY, by=hole / 3), shape(BRACKET, by=hole / 3)
    return Scene([shape(ring, by=hole * ratio / radius)], [rng.choice(others)])


def lattice(rng: random.Random) -> Scene:
    """Holes and parts on a lattice, with equal radii."""
    names = rng.sample([HALF, LENS, DOME, RINGS["hat"], RINGS["sector"]], 2)
    plates = [plate(x, y, 2, 1) for x, y in rng.sample([(0, 0), (4, 0), (0, 4), (4, 4), (8, 0)], 2)]
    parts = [shape(names[0], 0, 0, "1/10"), *([shape(names[1], 1, 0, "1/5")] if rng.random() < 0.3 else [])]
    return Scene(parts, plates) if rng.random() < 0.7 else Scene(plates[:1], parts)


def blended(rng: random.Random) -> Scene:
    """A rectangle whose corners have different radii, in bays and holes, or around them."""
    a, b, c, d = (Fraction(rng.randint(1, 8), 4) for _ in range(4))
    w = max(a + b, c + d) + Fraction(rng.randint(0, 4), 2)
    h = max(b + c, a + d) + Fraction(rng.randint(0, 3), 2)
    corners = [((w - b, 0), (w, b), (w - b, b)), ((w, h - c), (w - c, h), (w - c, h - c))]
    corners += [((d, h), (0, h - d), (d, h - d)), ((0, a), (a, 0), (a, a))]
    path: list[Any] = [(a, Fraction(0))]
    for start, end, center in corners:
        if start != (path[-1].to if isinstance(path[-1], Arc) else path[-1]):
            path.append(start)
        path.append(Arc(end, center=center))
    room = rng.choice([2, 3, 4])
    others = plate(0, 0, 6, room), shape(BAY, by=Fraction(room, 3)), shape(CONCAVE["wave"], by=Fraction(room, 2))
    some, other = [Curved(path)], [rng.choice(others)]
    return Scene(some, other) if rng.random() < 0.7 else Scene(other, some)


def channels(rng: random.Random) -> Scene:
    """A disc, or a shape with one, that exactly fills the space between two arcs about one center, or nearly."""
    radius, inner = Fraction(rng.randint(1, 4), 4), Fraction(rng.randint(0, 6), 2)
    hair = rng.choice([Fraction(0), Fraction(0), Fraction(0), Fraction(1, 2**60), -Fraction(1, 2**60)])
    outer = inner + 2 * radius + hair
    by = rng.choice([Fraction(1), Fraction(1), Fraction(1, 2)])  # of the room below
    bay = [(outer, 0), Arc((-outer, 0), center=(0, 0)), (-outer, -2 * by), (outer, -2 * by)]
    walls: list[Any] = [Curved([(-6, -6), (6, -6), (6, 7), (-6, 7)], [bay])]
    arc = rng.choice(["half", "quarter", "disc"])
    if inner and arc == "disc":
        walls.append(Curved.circle((0, 0), inner))
    elif inner:
        x, y = (-inner, Fraction(0)) if arc == "half" else (Fraction(0), inner)
        walls.append(Curved([(inner, 0), Arc((x, y), center=(0, 0)), *([(0, 0)] if arc == "quarter" else [])]))
    if rng.random() < 0.3:  # the channel turned, which leaves no axis-parallel edges
        turn = rng.choice(TURNS)
        walls = [_image(wall, turn, 1, -1, Fraction(1)) for wall in walls]
    parts = [_part(rng, radius)]
    return Scene(parts, walls) if rng.random() < 0.7 else Scene(walls, parts)


def tears(rng: random.Random) -> Scene:
    """A shape with arcs of more than half a turn, or about its corner, in a corridor just as wide, or nearly."""
    radius = Fraction(rng.randint(1, 4), 2)
    hair = rng.choice([Fraction(0), Fraction(0), Fraction(1, 2**60), -Fraction(1, 2**60)])
    width = radius * rng.choice([1, 2, 2]) + hair
    ceiling = [(-4, width), (rng.choice([3, 4]), width), (4, width + 2), (-4, width + 2)]
    walls: list[Any] = [Polygon([(-4, -2), (4, -2), (4, 0), (-4, 0)]), Polygon(ceiling)]
    if rng.random() < 0.4:
        walls.append(Curved.circle((rng.randint(-7, 7), width + radius), radius))
    if rng.random() < 0.3:
        turn = rng.choice(TURNS)
        walls = [_image(wall, turn, 1, -1, Fraction(1)) for wall in walls]
    parts = [_part(rng, radius)]
    return Scene(parts, walls) if rng.random() < 0.7 else Scene(walls, parts)


def _part(rng: random.Random, radius: Fraction) -> Curved:
    """A disc, a drop, a quarter or another sector of a disc, a ring with a disc's side; anywhere."""
    x, y = rng.choice([(0, 0), (0, 0), (1, 0), (Fraction(1, 2), Fraction(-1, 2))])
    up, down = (Fraction(3, 5), Fraction(4, 5)), (Fraction(3, 5), Fraction(-4, 5))
    rings: list[list[Any]] = [
        [(Fraction(5, 3), 0), up, Arc(down, center=(0, 0))],
        [(0, 0), (1, 0), Arc((0, 1), center=(0, 0))],
        [(0, 0), up, Arc(down, center=(0, 0))],
        [down, Arc(up, center=(0, 0))],
        [(1, 0), Arc((-1, 0), center=(0, 0)), (Fraction(-1, 2), 0), Arc((Fraction(1, 2), 0), center=(0, 0))],
    ]
    if rng.random() < 0.3:
        return Curved.circle((x, y), radius)
    return _image(Curved(rng.choice(rings)), rng.choice([(Fraction(1), Fraction(0)), *TURNS]), x, y, radius)


FAMILIES: dict[str, Callable[[random.Random], Scene]] = {
    "mixed": mixed, "turned": turned, "both": both, "fits": fits, "lattice": lattice, "blended": blended,
    "channels": channels, "tears": tears,
}  # fmt: skip


def scene(family: str, seed: int) -> Scene:
    return FAMILIES[family](random.Random(f"{family} {seed}"))


def swapped(made: Scene) -> Scene:
    return Scene(made.obstacles, made.robot)


def _image(part: Any, turn: tuple[Fraction, Fraction], x: Any, y: Any, by: Fraction) -> Any:
    c, s = turn

    def at(p: Any) -> tuple[Fraction, Fraction]:
        return (c * p[0] - s * p[1]) * by + x, (s * p[0] + c * p[1]) * by + y

    def ring(path: Any) -> Any:
        if isinstance(path, Circle):
            return Circle(at(path.center), path.radius * by)
        return [
            Arc(at(p.to), center=at(p.center), clockwise=p.clockwise) if isinstance(p, Arc) else at(p) for p in path
        ]

    if isinstance(part, Polygon):
        return Polygon([at(p) for p in part.exact_vertices])
    return Curved(ring(part.path), [ring(hole) for hole in part.holes], grown=part.grown * by)


def moved(made: Scene, turn: tuple[Fraction, Fraction], x: Any, y: Any, by: Fraction) -> Scene:
    """The scene scaled, its obstacles turned and moved as well."""
    here = Fraction(1), Fraction(0)
    return Scene([_image(p, here, 0, 0, by) for p in made.robot], [_image(p, turn, x, y, by) for p in made.obstacles])


def contacts(found: Boundary, theta: float) -> Iterator[tuple[float, float]]:
    """Places in contact at an orientation."""
    for line in found.slice(theta).lines:
        for p, q in pairwise(line):
            yield float((p[0] + q[0]) / 2), float((p[1] + q[1]) / 2)
        yield float(line[0, 0]), float(line[0, 1])


def poses(made: Scene, found: Boundary, rng: random.Random) -> Iterator[Pose]:
    """Poses anywhere, and near contacts."""
    theta = rng.uniform(0, math.tau)
    cut = found.slice(theta)
    x0, y0 = cut.segments.reshape(-1, 2).min(axis=0) - 0.5
    x1, y1 = cut.segments.reshape(-1, 2).max(axis=0) + 0.5
    for _ in range(POSES // 2):
        yield Pose(rng.uniform(x0, x1), rng.uniform(y0, y1), rng.uniform(0, math.tau))
    for _ in range(4):
        theta = rng.uniform(0, math.tau)
        places = list(contacts(found, theta))
        for x, y in rng.sample(places, min(len(places), POSES // 4)):
            away = rng.choice(NEAR)
            yield Pose(x + rng.uniform(-away, away), y + rng.uniform(-away, away), theta)


def faults(made: Scene, rng: random.Random, *, is_compared: bool = True) -> Iterator[str]:
    """What is wrong with the boundary and the cells of a scene; also compared with those of the same space."""
    found = boundary(made)
    space = free_space(found)
    if np.any(found.complex.euler % 2 != 0):
        yield f"Euler numbers {found.complex.euler.tolist()}"
    for pose in poses(made, found, rng):
        if (space.locate(pose) >= 0) != is_free(made, pose):
            yield f"{pose} is {'free' if is_free(made, pose) else 'forbidden'}, in cell {space.locate(pose)}"
    if not is_compared:
        return
    by = Fraction(3, 7)
    for name, other, scale in (
        ("with robot and obstacles exchanged", swapped(made), 1),
        ("moved", moved(made, rng.choice(TURNS), Fraction(17, 3), -5, by), by * by),
    ):
        one, two = sorted(space.volumes), sorted(v / float(scale) for v in free_space(boundary(other)).volumes)
        if len(one) != len(two) or not np.allclose(one[:-1], two[:-1], rtol=1e-6, atol=1e-12):
            yield f"volumes {one}, {name} {two}"
