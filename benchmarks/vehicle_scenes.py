"""Questions of cars: real car parks and warehouses, 70 seeded questions of `families.py`, and corners of narrow aisles.

The files in `scenes` are from the same source as those in `examples/scenes`; see the README there.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from families import QUESTIONS, SEEDS

import cfree
from cfree.scene.scene import robot_radius

HERE = Path(__file__).parent
EXAMPLES = HERE.parent / "examples" / "scenes"

PARKING = cfree.Car(4, axle=("-1.3", "0.111"))
WAREHOUSE = cfree.Car(4, axle=("-1.2", "-0.164"))
REAL: dict[str, tuple[Path, cfree.Car]] = {
    "parking1": (EXAMPLES / "benchmr_parking1.json", PARKING),
    "parking2": (HERE / "scenes" / "benchmr_parking2.json", PARKING),
    "parking3": (HERE / "scenes" / "benchmr_parking3.json", PARKING),
    "warehouse1": (EXAMPLES / "benchmr_warehouse.json", WAREHOUSE),
    "warehouse2": (HERE / "scenes" / "benchmr_warehouse2.json", WAREHOUSE),
    "flat": (EXAMPLES / "flat.json", cfree.Car(1, axle=("-0.5", 0))),
    "sofa_corner": (EXAMPLES / "sofa_corner.json", cfree.Car("0.5", axle=(0, "0.3"))),
    "street_Berlin": (EXAMPLES / "street_Berlin.json", cfree.Car(6, axle=("-2.5", 0))),
}
AISLES = 20
WIDEST = 1.3  # of the least width, for the last aisle
LENGTH, WIDTH = 0.9, 0.62  # of a robot in an aisle


@dataclass(frozen=True)
class Question:
    """A scene with start and goal, and the car that is asked about; the scene is made anew each time."""

    name: str
    fresh: Callable[[], cfree.Scene]
    car: cfree.Car


def real(name: str) -> Question:
    path, car = REAL[name]
    return Question(name, lambda: cfree.load_scene(path), car)


def seeded(family: str, seed: int) -> Question:
    """A question of a family; the car's radius is 1.5 times the robot's, its axle half of that behind the middle."""
    make = QUESTIONS[family]
    size = Fraction(robot_radius(make(seed))).limit_denominator(1000)
    return Question(f"{family} {seed}", lambda: make(seed), cfree.Car(size * 3 / 2, axle=(-size / 2, 0)))


def least_width() -> float:
    """Width of two aisles of equal width at a right angle that a rectangle just gets round.

    Turned by the angle a, the rectangle touches both outer walls. It clears the inner corner if w (sin a + cos a) is at
    least WIDTH + LENGTH sin a cos a. This is worst half way round, or at the ends.

    Examples
    --------
    >>> round(least_width(), 4)
    0.7566
    """
    return max(WIDTH, (LENGTH / 2 + WIDTH) / math.sqrt(2))


def aisle(k: int, count: int = AISLES) -> Question:
    """Aisle k of a number of aisles, the first a little wider than the least; radius 0.4 or 1 in turns."""
    width = Fraction(least_width() * (1 + (WIDEST - 1) * (k + 1) / count)).limit_denominator(10_000)
    long, half, wide = Fraction(4), Fraction(str(LENGTH)) / 2, Fraction(str(WIDTH)) / 2
    corner = [(0, 0), (long, 0), (long, long), (long - width, long), (long - width, width), (0, width)]
    scene = cfree.Scene(
        [(-half, -wide), (half, -wide), (half, wide), (-half, wide)],
        [],
        workspace=corner,
        start=cfree.Pose("0.6", width / 2),
        goal=cfree.Pose(long - width / 2, long - Fraction("0.6"), "90deg"),
    )
    car = cfree.Car(("0.4", "1")[k % 2], axle=("-0.3", 0))
    return Question(f"aisle {float(width):.4g}", lambda: scene, car)


def questions(quick: bool, families: str | None = None, aisles: int = AISLES) -> list[Question]:
    """All questions, or a few; `families` are those wanted, "real" and "aisle" among them."""
    wanted = (families or " ".join(("real", *QUESTIONS, "aisle"))).split()
    chosen = [real(name) for name in REAL if "real" in wanted and not (quick and name in ("warehouse2", "sofa_corner"))]
    chosen += [seeded(name, seed) for name in QUESTIONS if name in wanted for seed in (SEEDS[:1] if quick else SEEDS)]
    count = 3 if quick else aisles
    return chosen + [aisle(k, count) for k in range(count) if "aisle" in wanted]
