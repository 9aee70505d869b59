"""Rings of segments and convex arcs of rational radii, and random scenes of them."""

from __future__ import annotations

import random
from fractions import Fraction
from typing import Any

from cfree import Curved, Scene
from cfree.curves import Arc

Ring = list[tuple[int, int] | tuple[int, int, tuple[int, int]]]

# corners, with the centre of the arc from one to the next
HALF: Ring = [(5, 0, (0, 0)), (-5, 0)]
DOME: Ring = [(4, 3, (0, 0)), (-4, 3)]
SECTOR: Ring = [(0, 0), (5, 0, (0, 0)), (3, 4)]
LENS: Ring = [(0, -4, (-3, 0)), (0, 4, (3, 0))]
CORNERS: Ring = [(2, 0), (9, 0, (9, 1)), (10, 1), (10, 5, (7, 5)), (7, 8), (0, 8), (0, 2, (2, 2))]
HAT: Ring = [(-6, -3), (6, -3), (6, 0), (5, 0, (0, 0)), (-5, 0), (-6, 0)]
DROP: Ring = [(-4, 3, (0, 0)), (4, 3), (0, 6)]
RINGS = {"half": HALF, "dome": DOME, "sector": SECTOR, "lens": LENS, "corners": CORNERS, "hat": HAT, "drop": DROP}
CONVEX = ("half", "dome", "sector", "lens", "corners")


def shape(ring: Ring, x: Any = 0, y: Any = 0, by: Any = 1) -> Curved:
    """A ring times a factor, then moved."""

    def place(p: Any) -> tuple[Fraction, Fraction]:
        return p[0] * Fraction(by) + Fraction(x), p[1] * Fraction(by) + Fraction(y)

    path: list[Any] = [place(ring[0])]
    for k, corner in enumerate(ring):
        after = ring[(k + 1) % len(ring)]
        path.append(Arc(place(after), center=place(corner[2])) if len(corner) == 3 else place(after))
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
