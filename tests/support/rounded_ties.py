"""Scenes of rounded shapes made by hand, most of them with ties, and their Euler numbers."""

from __future__ import annotations

from fractions import Fraction

import cfree._core as core
from cfree import Curved, Polygon, Scene
from cfree.curves import Arc

Corners = list[complex]
Grown = tuple[Corners, float]

I = 1j
L: Corners = [0, 2, 2 + I, 1 + I, 1 + 2j, 2j]
U: Corners = [0, 3, 3 + 2j, 2 + 2j, 2 + I, 1 + I, 1 + 2j, 2j]
V: Corners = [0, 3, 3 + 2.5j, 2 + 2.5j, 2 + I, 1 + I, 1 + 2j, 2j]
T: Corners = [0, 1, 0.25 + I]


def rect(w: float, h: float) -> Corners:
    return [complex(-w, -h), complex(w, -h), complex(w, h), complex(-w, h)]


def moved(points: Corners, by: complex, factor: float = 1) -> Corners:
    return [factor * p + by for p in points]


def frame(a: float, b: float, radius: float = 0) -> list[Grown]:
    inner, outer = rect(a, a), rect(b, b)
    return [([outer[k], outer[(k + 1) % 4], inner[(k + 1) % 4], inner[k]], radius) for k in range(4)]


def points(places: Corners, radius: float) -> list[Grown]:
    return [([p], radius) for p in places]


SQUARE = rect(0.5, 0.5)
CORNERS: Corners = [0, 1, I, 1 + I]
U2, UC, V2 = moved(U, -1.5 - I), moved(U, -1.5 - 1.5j), moved(V, -1.5 - I)
LATTICE: list[Grown] = [(moved(SQUARE, complex(a, b)), 0) for a in (0, 1.6) for b in (0, 1.6)]

# name: robot, obstacles, Euler number of all surfaces, their number
SCENES: dict[str, tuple[Grown, list[Grown], int, int]] = {
    "A1": (([-1, 1], 0.25), points([0], 0.25), 0, 1),
    "A2": ((T, 0.2), [(rect(1, 0.7), 0)], 0, 1),
    "A3": ((moved(L, -0.3 - 0.2j, 0.5), 0.15), [([0, 1.5, 0.5 + 1.25j], 0)], 0, 1),
    "A4": (([0], 0.25), [(U, 0)], 0, 1),
    "A5": (([0], 0.5), frame(1, 1.5), 0, 2),
    "A6": ((rect(0.9, 0.2), 0.05), frame(1, 1.5), 0, 2),
    "A7": ((rect(1.1, 0.2), 0.05), frame(1, 1.5), 8, 5),
    "A8": (([-1.2, 1.2], 0.1), frame(1, 1.5), 8, 5),
    "A9": ((moved(U, -0.75 - 0.5j, 0.5), 0.1), points([0], 0.1), 0, 1),
    "A10": ((U2, 0.1), points([0], 0.45), 0, 1),
    "A11": ((SQUARE, 0.1), points([1 + I, 1 - I, -1 + I, -1 - I], 0.1), 0, 4),
    "A12": (([-1, 1], 0.1), points([0, 1.5, 0.5 + 1.25j], 0.1), -12, 1),
    "A13": ((moved(L, -0.3 - 0.3j, 0.45), 0.05), [(U, 0)], 0, 1),
    "A15": ((rect(0.75, 0.1), 0.05), frame(1, 1.5) + points([0.3 + 0.2j], 0.1) + points([-0.4 - 0.1j], 0.05), 12, 7),
    "B1": (([0], 0.25), points(CORNERS, 0.25), 0, 2),
    "B2": (([0], 0.3), points(CORNERS, 0.3), 0, 2),
    "B3": (([0], 0), points([3, -3], 5) + points([0], 4), 0, 1),
    "B3b": (([1], 1), points([3, -3], 4) + points([0], 3), 0, 1),
    "B3c": (([0], 0), points([0], 4) + points([3, -3], 5), 0, 1),
    "B4": (([0, 1], 0.1), points(CORNERS, 0.1), -16, 1),
    "B5": ((SQUARE, 0.1), points([0, 1], 0.1), 0, 1),
    "B6": ((SQUARE, 0.1), points(CORNERS, 0.1), 8, 5),
    "B7": ((SQUARE, 0.1), [(SQUARE, 0)], 0, 1),
    "B8": ((SQUARE, 0.1), [(SQUARE, 0), (moved(SQUARE, 2 + 2j), 0)], -8, 1),
    "B9": ((SQUARE, 0.1), [(SQUARE, 0), (moved(SQUARE, 2.2), 0)], 0, 1),
    "B10": ((SQUARE, 0.1), [(SQUARE, 0), (moved(SQUARE, 2.3), 0)], -8, 1),
    "B11": (([0], 0.25), [(SQUARE, 0), (moved(SQUARE, 1.5), 0)], 4, 3),  # a slit in each chart, closed at its ends
    "B12": (([0], 0.25), LATTICE, 0, 4),
    "B13": (
        (SQUARE, 0.1),
        [(moved(rect(1, 0.5), -1.5 - 0.5j), 0.2), (moved(rect(1, 0.6), 1.5 - 0.4j), 0)],
        0, 1,
    ),
    "B14": (([0, 4, 3j], 0.1), points([0, 5.4], 0.1), 0, 2),
    "B14b": (([0, 4, 3j], 0.1), points([0, 5.39], 0.1), -4, 1),
    "B15": (([-1, 1], 0.2), points([0, 0.8], 0.2), 0, 1),
    "B16": ((rect(0.5, 0.2), 0.1), frame(0.6, 1), 8, 5),
    "B17": ((UC, 0.1), points([0], 0.4), 4, 3),  # the same: the mouth is as wide as the disc
    "B18": ((SQUARE, 0.1), frame(0.6, 1), 0, 1),
    "B19": ((SQUARE, 0.1), frame(1, 1.5), 0, 2),
    "B20": ((SQUARE, 0.1), [(SQUARE, 0), (moved(SQUARE, 2 + I), 0.2)], 0, 1),
    "B21": ((U2, 0.1), points([0, 2], 0), -4, 1),
    "B22": ((U2, 0.1), [(U, 0)], 0, 1),
    "B23": ((U2, 0.1), points([0, 2, 4], 0.1), -8, 1),
    "B24": ((U2, 0.1), [([0, 0.8], 0)], 0, 1),
    "B25": ((U2, 0.1), [([0, 0.7], 0)], 0, 1),
    "B26": (([0, 1], 0.1), points([0, 1], 0.1), -4, 1),
    "B27": ((V2, 0.125), points([0, 2 + 0.5j], 0), -4, 1),
    "B28": ((V2, 0.125), points([0, 2 + 0.5j, 4 + I], 0) + points([-3 + 2j], 0.125), -20, 1),
    "C1": (([0, 0.6], 0.05), [*points([0], 1), (moved(rect(2, 0.05), 0.9j), 0)], 0, 1),
    "C5": (([0, 1], 0.1), points([0], 0) + points([1.3], 0.2) + points([2.6], 0.4), -8, 1),
    "C6": (
        (moved(L, -0.3 - 0.3j, 0.5), 0),
        [([0, 1, 0.3 + 0.9j], 0.2), (moved(rect(0.4, 0.4), 1.6 + 0.9j), 0)],
        0, 1,
    ),
    "C7": ((rect(1.1, 0.2), 0.05), frame(1.05, 1.5, 0.05), 8, 5),
    "C8": ((UC, 0.05), [(rect(0.2, 0.2), 0.1)], 0, 1),
    "C9": ((U2, 0.05), [(moved(U, 3 + 2j, -1), 0), *points([4.2 + I], 0.3)], 0, 1),
}  # fmt: skip


def exact(x: float) -> Fraction:
    return Fraction(round(1200 * x), 1200)


def handle(corners: Corners) -> core.Polygon:
    places = [(exact(p.real), exact(p.imag)) for p in map(complex, corners)]
    if len(places) > 2:
        return Polygon(places)._handle
    thin = core.Polygon.thin([list(p) for p in places])
    assert thin is not None
    return thin


def features_of(name: str) -> core.SceneFeatures:
    """The features of one of the scenes, in the core."""
    (robot, r), obstacles, *_ = SCENES[name]
    rounding = [(exact(radius), ()) for radius in (r, *(radius for _, radius in obstacles))]
    return core.SceneFeatures([handle(robot)], [handle(c) for c, _ in obstacles], None, None, None, rounding)


def scene_of(name: str) -> Scene | None:
    """The scene with shapes of files; None if it has a point or a segment without radius."""
    robot, obstacles, *_ = SCENES[name]
    shapes = [_shape(*grown) for grown in (robot, *obstacles)]
    return None if None in shapes else Scene(shapes[0], shapes[1:])


def _shape(corners: Corners, radius: float) -> Curved | Polygon | None:
    points, r = [(exact(complex(p).real), exact(complex(p).imag)) for p in corners], exact(radius)
    if len(points) > 2:
        return Curved(points, grown=r) if r else Polygon(points)
    if r == 0:
        return None
    if len(points) == 1:
        return Curved.circle(points[0], r)
    (a, b), (c, d) = sorted(points)
    if b == d:  # along the x-axis, else along the y-axis
        return Curved(
            [(a, b - r), (c, b - r), Arc((c, b + r), center=(c, b)), (a, b + r), Arc((a, b - r), center=(a, b))]
        )
    assert a == c
    return Curved([(a + r, b), (a + r, d), Arc((a - r, d), center=(a, d)), (a - r, b), Arc((a + r, b), center=(a, b))])
