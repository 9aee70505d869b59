"""Rings of segments and arcs of rational radii, and random scenes of them."""

from __future__ import annotations

import random
from fractions import Fraction
from typing import Any

from cfree import Curved, Scene
from cfree.curves import Arc, Circle

Ring = list[tuple[int, int] | tuple[int, int, tuple[int, int]] | tuple[int, int, tuple[int, int], str]]

# corners, with the centre of the arc from one to the next, and "concave" if it is
HALF: Ring = [(5, 0, (0, 0)), (-5, 0)]
DOME: Ring = [(4, 3, (0, 0)), (-4, 3)]
SECTOR: Ring = [(0, 0), (5, 0, (0, 0)), (3, 4)]
LENS: Ring = [(0, -4, (-3, 0)), (0, 4, (3, 0))]
CORNERS: Ring = [(2, 0), (9, 0, (9, 1)), (10, 1), (10, 5, (7, 5)), (7, 8), (0, 8), (0, 2, (2, 2))]
HAT: Ring = [(-6, -3), (6, -3), (6, 0), (5, 0, (0, 0)), (-5, 0), (-6, 0)]
DROP: Ring = [(-4, 3, (0, 0)), (4, 3), (0, 6)]
RINGS = {"half": HALF, "dome": DOME, "sector": SECTOR, "lens": LENS, "corners": CORNERS, "hat": HAT, "drop": DROP}
CONVEX = ("half", "dome", "sector", "lens", "corners")

BAY: Ring = [(-5, -5), (5, -5), (5, 3), (3, 3, (0, 3), "concave"), (-3, 3), (-5, 3)]
BRACKET: Ring = [(0, 0), (9, 0), (9, 2), (5, 2, (5, 5), "concave"), (2, 5), (2, 9), (0, 9)]
CRESCENT: Ring = [(4, 3, (0, 0)), (4, -3, (8, 0), "concave")]
HOOK: Ring = [(0, -5, (0, 0)), (0, 5), (0, 2, (0, 0), "concave"), (0, -2)]
WAVE: Ring = [(0, -4), (8, -4), (8, 2, (6, 2)), (6, 4, (6, 6), "concave"), (4, 6), (0, 6)]
CONCAVE = {"bay": BAY, "bracket": BRACKET, "crescent": CRESCENT, "hook": HOOK, "wave": WAVE}


def shape(ring: Ring, x: Any = 0, y: Any = 0, by: Any = 1) -> Curved:
    """A ring times a factor, then moved."""

    def place(p: Any) -> tuple[Fraction, Fraction]:
        return p[0] * Fraction(by) + Fraction(x), p[1] * Fraction(by) + Fraction(y)

    path: list[Any] = [place(ring[0])]
    for k, corner in enumerate(ring):
        after = ring[(k + 1) % len(ring)]
        path.append(
            place(after) if len(corner) == 2 else Arc(place(after), center=place(corner[2]), clockwise=len(corner) == 4)
        )
    if path[-1] == path[0]:
        path.pop()
    return Curved(path)


def random_shape(rng: random.Random, far: int) -> Any:
    x, y = rng.randint(-far, far), rng.randint(-far, far)
    grown = Fraction(rng.randint(1, 6), 3)
    name = rng.choice([*RINGS, "disc", "triangle"])
    if name == "disc":
        return Curved.circle((x, y), Fraction(rng.randint(1, 9), 2))
    if name == "triangle":
        ring = [(x, y), (x + rng.randint(1, 6), y), (x, y + rng.randint(1, 6))]
        return Curved(ring, grown=grown) if rng.random() < 0.5 else ring
    return shape(RINGS[name], x, y, rng.choice([1, 1, "1/2"]))


def random_arcs(seed: int) -> Scene:
    """One or two parts among one to three obstacles, one of which at least has arcs as sides."""
    rng = random.Random(seed)
    parts = [random_shape(rng, 2) for _ in range(1 + seed % 2)]
    obstacles = [random_shape(rng, 14) for _ in range(rng.randint(0, 2))]
    name = rng.choice([*RINGS])
    return Scene(parts, [*obstacles, shape(RINGS[name], rng.randint(-14, 14), rng.randint(-14, 14))])


def plate(x: Any = 0, y: Any = 0, side: Any = 5, hole: Any = 3) -> Curved:
    """A square with a round hole in its middle."""
    x, y, side, hole = Fraction(x), Fraction(y), Fraction(side), Fraction(hole)
    square = [(x - side, y - side), (x + side, y - side), (x + side, y + side), (x - side, y + side)]
    ends = [(x - hole, y), (x + hole, y)]
    return Curved(square, [[ends[0], Arc(ends[1], center=(x, y)), Arc(ends[0], center=(x, y))]])


def random_plain(rng: random.Random, far: int) -> Any:
    """A disc, or a triangle that may be grown: what concave arcs are taken with."""
    x, y = rng.randint(-far, far), rng.randint(-far, far)
    if rng.random() < 0.4:
        return Curved.circle((x, y), Fraction(rng.randint(1, 7), 2))
    ring = [(x, y), (x + rng.randint(1, 6), y), (x + rng.randint(-1, 1), y + rng.randint(1, 6))]
    return Curved(ring, grown=Fraction(rng.randint(1, 6), 3)) if rng.random() < 0.5 else ring


def random_concave(seed: int) -> Scene:
    """One or two convex parts among one or two obstacles, one of which has concave arcs; or a robot that has them."""
    rng = random.Random(seed)

    def concave(far: int, names: tuple[str, ...] = (*CONCAVE, "plate")) -> Curved:
        x, y = rng.randint(-far, far), rng.randint(-far, far)
        name, by = rng.choice(names), rng.choice([1, 1, "1/2"])
        return plate(x, y, 5 * Fraction(by), 3 * Fraction(by)) if name == "plate" else shape(CONCAVE[name], x, y, by)

    parts = [random_plain(rng, 2) for _ in range(1 + seed % 2)]
    others = [random_plain(rng, 12) for _ in range(rng.randint(0, 1))]
    if seed % 5 == 4:
        return Scene([concave(2)], [*parts, *others])
    if seed % 5 == 3:
        some = "bay", "bracket", "plate"
        return Scene([concave(2, some)], [concave(10, some), *others])
    return Scene(parts, [*others, concave(8)])


def random_hall(seed: int) -> Scene:
    """A part in a round workspace, which may have concave arcs, a hole, obstacles and bounds."""
    rng = random.Random(f"hall {seed}")
    robot = random_shape(rng, 0) if rng.random() < 0.6 else random_plain(rng, 0)
    obstacles = [random_shape(rng, 3) for _ in range(rng.randint(0, 2))]
    bounds = (-3, -3, Fraction(7, 2), 3) if rng.random() < 0.3 else None
    ring = rng.choice([None, *RINGS.values(), *CONCAVE.values()])
    if ring is None:
        circle = Circle((rng.randint(-2, 2), Fraction(rng.randint(-3, 3), 2)), Fraction(rng.randint(4, 12), 2))
        hall = Curved(circle, [Circle((0, 0), Fraction(1, 2))] if rng.random() < 0.4 else [])
    else:
        hall = shape(ring, Fraction(rng.randint(-3, 3), 2), 0, rng.choice([2, 3, Fraction(5, 2)]))
    return Scene(robot, obstacles, workspace=hall, bounds=bounds)
