"""Poses and motions among segments and circular arcs, decided by the checker's own numbers."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import numpy as np
import pytest
import shapely
from flint import fmpq
from shapely.affinity import affine_transform

import cfree
from cfree import Curved, MotionChecker, Polygon, Pose, Rotation, Scene, Translation
from cfree.collision.motion import Motion
from cfree.curves import Arc, Circle
from cfree.scene.scene import AnyShape
from cfree.verify.arc_motions import ArcWorld
from cfree.verify.arcs import Region, Spot, overlap, rational, region_of
from cfree.verify.course import Course, Placed, place_of
from cfree.verify.surds import order, sum_sign

EPS = Fraction(1, 2**60)
DISC = Curved.circle((0, 0), 1)
HOLE = Curved([(-3, -3), (3, -3), (3, 3), (-3, 3)], [Circle((0, 0), 1)])
FLOOR = Polygon([(-9, -9), (9, -9), (9, 0), (-9, 0)])
STADIUM = Curved([(0, 0), (4, 0), Arc((4, 2), center=(4, 1)), (0, 2), Arc((0, 0), center=(0, 1))])
CORRIDOR = Polygon([(-9, -9), (9, -9), (9, 9), (-9, 9)], [[(-8, 0), (8, 0), (8, 2), (-8, 2)]])
GROWN = Curved([(0, 0), (2, 0), (2, 1), (0, 1)], grown="1/2")
BOX = [(-1, 0), (4, 0), (4, 2), (-1, 2)]
ROOM = Polygon([(-5, -5), (8, -5), (8, 8), (-5, 8)], [BOX])
SLOT = Curved([(-2, -1), (2, -1), Arc((2, 1), center=(2, 0)), (-2, 1), Arc((-2, -1), center=(-2, 0))])
SHAPES: list[AnyShape] = [
    DISC,
    STADIUM,
    HOLE,
    Curved([(0, 0), (3, 0), (3, 2), Arc((0, 2), through=(1.5, 1))]),
    Curved([(0, 0), (2, 0), Arc((0, 2), center=(0, 0))]),
    Curved([(0, 0), (2, 0), Arc((0, 2), center=(2, 2), clockwise=True)]),  # it has cusps
    Curved([(-2, 0), Arc((2, 0), center=(0, 0)), (1, 0), Arc((-1, 0), center=(0, 0), clockwise=True)]),
    Curved([(0, 0), (2, 0), Arc((0, 2), through=(2, 1))]),  # the square of its radius is rational
    Polygon([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]),
    Curved([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], grown="1/2"),
    Curved([(0, 0), (2, 0), (1, 1)], grown="1/4"),
]


def rounded(value: fmpq) -> float:
    return float(Fraction(int(value.p), int(value.q)))


def drawn(region: Region, count: int = 200) -> shapely.Polygon:
    """A polygon near a region without growth."""
    rings = []
    for ring in region.rings:
        points = []
        for part in ring:
            shares = 1 if part.center is None else count
            for k in range(shares):
                spot = part.at(fmpq(k, shares))
                root = math.sqrt(rounded(spot.k))
                points.append((rounded(spot.x0) + root * rounded(spot.x1), rounded(spot.y0) + root * rounded(spot.y1)))
        rings.append(points)
    shape = shapely.Polygon(rings[0], rings[1:])
    return shape.buffer(rounded(region.grown), quad_segs=count) if region.grown else shape


def random_pose(rng: random.Random) -> Placed:
    tau = Fraction(rng.randrange(-9, 10), rng.choice([1, 2, 3, 5, 7]))
    x, y = (Fraction(rng.randrange(-32, 33), 8) for _ in range(2))
    return x, y, (1 - tau * tau) / (1 + tau * tau), 2 * tau / (1 + tau * tau)


def turned(shape: shapely.Polygon, placed: Placed) -> shapely.Polygon:
    x, y, c, s = map(float, placed)
    return affine_transform(shape, [c, -s, s, c, x, y])


def test_signs_of_sums_of_roots_are_exact() -> None:
    a, b, c = (frozenset({k}) for k in range(3))
    squares = fmpq(2), fmpq(3), fmpq(5) + 2 * fmpq(1)
    assert sum_sign({a: fmpq(1), b: fmpq(1), c: fmpq(-1)}, squares) == 1
    zero = {frozenset({0}): fmpq(2), frozenset({1}): fmpq(-1)}  # 2 sqrt(2) - sqrt(8)
    assert sum_sign(zero, (fmpq(2), fmpq(8))) == 0
    one, other = (fmpq(0), fmpq(3), fmpq(2)), (fmpq(0), fmpq(1), fmpq(18))
    assert order(one, other) == 0 and order(one, (fmpq(0), fmpq(1), fmpq(18) + fmpq(1, 2**200))) == -1


@pytest.mark.parametrize(
    ("robot", "other", "x", "y", "meets"),
    [
        (DISC, FLOOR, 0, 1, False),
        (DISC, FLOOR, 0, 1 - EPS, True),
        (DISC, DISC, Fraction(6, 5), Fraction(8, 5), False),
        (DISC, DISC, 2 - EPS, 0, True),
        (DISC, DISC, 0, 0, True),
        (DISC, HOLE, 0, 0, False),
        (DISC, HOLE, EPS, 0, True),
        (STADIUM, CORRIDOR, 3, 0, False),
        (STADIUM, CORRIDOR, 3, EPS, True),
        (GROWN, FLOOR, 0, Fraction(1, 2), False),
        (GROWN, FLOOR, 0, Fraction(1, 2) - EPS, True),
        (GROWN, GROWN, 3, 0, False),
        (GROWN, GROWN, 3 - EPS, 0, True),
        (Curved.circle((0, 0), EPS), HOLE, 1 - EPS, 0, False),
        (Curved.circle((0, 0), EPS), HOLE, 1, 0, True),
    ],
)
def test_contacts_are_free_and_the_least_overlap_is_not(
    robot: AnyShape, other: AnyShape, x: Fraction, y: Fraction, meets: bool
) -> None:
    placed = [rational(Fraction(value)) for value in (x, y, 1, 0)]
    assert overlap(region_of(robot).moved(*placed), region_of(other)) is meets


def test_poses_are_those_of_fine_polygons() -> None:
    rng = random.Random(3)
    regions = [*map(region_of, SHAPES)]
    shapes = [*map(drawn, regions)]
    decided = 0
    for _ in range(300):
        i, j, placed = rng.randrange(len(SHAPES)), rng.randrange(len(SHAPES)), random_pose(rng)
        one, other = turned(shapes[i], placed), shapes[j]
        meets, apart = one.intersection(other).area > 1e-3, one.distance(other) > 1e-3
        if meets or apart:
            decided += 1
            assert overlap(regions[i].moved(*map(rational, placed)), regions[j]) is meets
    assert decided > 250


def test_a_point_is_inside_an_odd_number_of_rings() -> None:
    ring = region_of(Curved(Circle((0, 0), 2), [Circle((0, 0), 1)]))
    spots = [Spot.of((fmpq(x), fmpq(y))) for x, y in ((0, 0), (1, 1), (-1, 1), (3, 0), (0, 3), (-3, 2))]
    assert [ring.holds(spot) for spot in spots] == [False, True, True, False, False, False]


TURN = Rotation((0, 0), "170deg")


@pytest.mark.parametrize(
    ("robot", "obstacle", "workspace", "start", "motion", "is_free"),
    [
        (DISC, FLOOR, None, Pose(-3, 1), Translation((6, 0)), True),
        (DISC, FLOOR, None, Pose(-3, 1), Translation((6, -EPS)), False),
        (DISC, HOLE, None, Pose(0, 0), TURN, True),
        (DISC, HOLE, None, Pose(0, 0), Rotation((EPS, 0), "170deg"), False),
        (DISC, DISC, None, Pose(2, 0), TURN, True),
        (DISC, DISC, None, Pose(2, 0), Rotation((EPS, 0), "170deg"), False),
        (DISC, DISC, None, Pose(-5, 2), Translation((10, 0)), True),
        (DISC, DISC, None, Pose(-5, 2 - EPS), Translation((10, 0)), False),
        (STADIUM, CORRIDOR, None, Pose(-3, 0), Translation((6, 0)), True),
        (STADIUM, CORRIDOR, None, Pose(-3, 0), Translation((6, EPS)), False),
        (GROWN, ROOM, None, Pose("-1/2", "1/2"), Translation((2, 0)), True),
        (GROWN, ROOM, None, Pose("-1/2", "1/2"), Translation((2 + EPS, 0)), False),
        (SLOT, None, Curved(Circle((0, 0), 4)), Pose(1, 0), TURN, True),
        (SLOT, None, Curved(Circle((0, 0), 4)), Pose(1, 0), Rotation((0, EPS), "170deg"), False),
    ],
)
def test_motions_along_contacts_are_free_and_those_that_leave_them_inward_are_not(
    robot: AnyShape, obstacle: AnyShape | None, workspace: AnyShape | None, start: Pose, motion: Motion, is_free: bool
) -> None:
    world = ArcWorld(Scene([robot], [obstacle] if obstacle else [], workspace=workspace))
    assert world.is_free(place_of(start, 1))
    assert (world.collision(Course(place_of(start, 1), motion, 1)) is None) is is_free


def random_motion(rng: random.Random) -> Motion:
    x, y = (Fraction(rng.randrange(-32, 33), 8) for _ in range(2))
    return Translation((x, y)) if rng.random() < 0.5 else Rotation((x, y), f"{rng.randrange(-179, 180)}deg")


@pytest.mark.slow
def test_motions_of_polygons_are_those_of_the_core() -> None:
    rng, polygons = random.Random(5), [FLOOR, ROOM, SHAPES[8], Polygon([(0, 0), (2, 0), (0, 2)])]
    tried = 0
    for _ in range(200):
        scene = Scene([rng.choice(polygons[2:])], rng.choices(polygons, k=2))
        world = ArcWorld(scene)
        start = Pose(
            Fraction(rng.randrange(-8, 9)), Fraction(rng.randrange(-8, 9)), rng.choice(["0deg", "90deg", "30deg"])
        )
        if world.is_free(place_of(start, 1)):
            motion, tried = random_motion(rng), tried + 1
            found = world.collision(Course(place_of(start, 1), motion, 1))
            assert (found is None) is MotionChecker(scene).is_free(start, motion)
    assert tried > 50


@pytest.mark.slow
def test_motions_are_those_of_fine_polygons() -> None:
    rng = random.Random(6)
    for _ in range(100):
        robot, obstacle = rng.choice(SHAPES), rng.choice(SHAPES)
        world = ArcWorld(Scene([robot], [obstacle]))
        start, one, other = random_pose(rng), drawn(region_of(robot), 40), drawn(region_of(obstacle), 40)
        if not world.is_free(start):
            continue
        course = Course(start, random_motion(rng), 1)
        found = world.collision(course)
        if found is not None:
            assert overlap(world.robot[0].moved(*map(rational, course.at(found))), world.obstacles[0])
            continue
        for u in np.linspace(0, 1, 41):
            assert turned(one, course.at(Fraction(u))).intersection(other).area < 4e-3


def thin(halves: int) -> Curved:
    """A disc without a thin segment."""
    tau = Fraction(1, halves)
    c, s = (1 - tau**2) / (1 + tau**2), 2 * tau / (1 + tau**2)
    return Curved([(c, s), Arc((c, -s), center=(0, 0))])


@pytest.mark.slow
def test_the_core_and_the_checker_agree_at_contacts_and_beside_them() -> None:
    rng = random.Random(8)
    shapes = [*SHAPES, thin(20), thin(2000), thin(2**50), Curved(Circle((0, 0), 2), [Circle((Fraction(1, 2), 0), 1)])]
    for _ in range(150):
        scene = Scene(rng.choice(shapes), [rng.choice(shapes)])
        world, tau = ArcWorld(scene), rng.choice([Fraction(0), Fraction(0), Fraction(1), Fraction(1, 2)])
        x, y = (Fraction(rng.randrange(-10, 11), 2) + rng.choice([0, 0, EPS, -EPS]) for _ in range(2))
        start = Pose(x, y, {"tau": tau})
        assert cfree.is_free(scene, start) is world.is_free(place_of(start, 1))
        motion = random_motion(rng)
        is_free = world.collision(Course(place_of(start, 1), motion, 1)) is None
        assert cfree.is_free_motion(scene, start, motion) is is_free
