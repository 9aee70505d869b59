"""Scenes of rounded shapes: cores grown by discs, by hand and at random."""

from __future__ import annotations

import random
from fractions import Fraction
from typing import Any

import numpy as np

from cfree import Curved, Scene
from cfree.curves import Arc
from cfree.polygons.polygon import Polygon
from cfree.scene.rounded import rounded

TRIANGLE = [(-1, -1), (2, 0), (0, 1)]
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
ELL = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (0, 2)]


def grown(points: Any, by: Any, x: Any = 0, y: Any = 0) -> Curved:
    return Curved([(Fraction(a) + x, Fraction(b) + y) for a, b in points], grown=by)


def disc(x: Any, y: Any, radius: Any) -> Curved:
    return Curved.circle((x, y), radius)


def stadium(x: Any, y: Any, length: Any) -> Curved:
    """A stadium of radius 1 that begins at (x, y)."""
    return Curved(
        [(x, y - 1), (x + length, y - 1), Arc((x + length, y + 1), center=(x + length, y)), (x, y + 1),
         Arc((x, y - 1), center=(x, y))]
    )  # fmt: skip


def pieces(shape: Any) -> tuple[list[np.ndarray], float]:
    """Convex pieces of a rounded shape's core, and its radius."""
    form = rounded(shape)
    assert form is not None
    if isinstance(form.core, Polygon):
        return [form.core.vertices[list(piece)] for piece in form.core.pieces], float(form.radius)
    return [np.array([[float(c) for c in p] for p in form.core])], float(form.radius)


MIXED = Scene(
    grown(TRIANGLE, "1/10"), [disc(5, 0, 1), grown(SQUARE, "1/5", 0, 4), Polygon([(-6, -6), (-5, -6), (-5, 5)])]
)
ONE_RADIUS = Scene(grown(ELL, "1/4"), [grown(TRIANGLE, "1/4", 5, 1), disc(-3, 2, "1/4"), grown(ELL, "1/4", 0, 4)])
AXIS_PARALLEL = Scene(grown(SQUARE, "1/8"), [grown(SQUARE, "1/8", k, 2 * k) for k in (1, 3, 4)] + [disc(2, 0, "1/2")])
DISCS = Scene(disc("1/2", 0, 1), [disc(4, 0, 2), disc(8, 1, 1), disc(6, 4, "3/2")])
STADIUMS = Scene(stadium(0, 0, 3), [stadium(6, 0, 2), stadium(0, 6, 1), disc(6, 6, 1)])
NO_RADIUS = Scene([disc(0, 0, "1/3")], [SQUARE, [(3, 0), (5, 1), (3, 2)]])
SCENES = {
    "mixed": MIXED,
    "one radius": ONE_RADIUS,
    "axis-parallel": AXIS_PARALLEL,
    "discs": DISCS,
    "stadiums": STADIUMS,
    "disc robot": NO_RADIUS,
}


def random_scene(seed: int) -> Scene:
    """Two to five rounded shapes; even seeds are on a lattice of halves, and so full of ties."""
    rng = random.Random(seed)
    step = 2 if seed % 2 == 0 else 1000
    one = Fraction(rng.randint(1, 4), 4)

    def radius() -> Fraction:
        return one if seed % 3 else Fraction(rng.randint(1, 8), 8)

    def shape(far: int) -> Any:
        x, y = (Fraction(rng.randint(-far * step, far * step), step) for _ in range(2))
        ring = rng.choice([SQUARE, TRIANGLE, ELL, None])
        return disc(x, y, radius()) if ring is None else grown(ring, radius(), x, y)

    return Scene(shape(1), [shape(5) for _ in range(rng.randint(2, 5))])
