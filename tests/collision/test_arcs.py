"""Poses and motions among segments and arcs: contacts made on purpose, two lemmas by separation, fine polygons."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

import cfree
import cfree._core as _core
import fuzz_arcs
from cfree import Curved, Pose, Rotation, Scene, Translation, is_free
from cfree.collision.arcs import ArcScene, arcs_of
from cfree.collision.motion import joining
from cfree.contact import ArcArc
from cfree.curves import Arc, Circle
from cfree.exact.number import ExactPoint
from cfree.planning.core_ways import end_of, from_numbers
from cfree.scene.features import scene_features
from cfree.scene.scene import box_of

TINY = Fraction(1, 10**60)
FLOOR = [(-9, -1), (9, -1), (9, 0), (-9, 0)]
DISC = Curved.circle((0, 0), 1)
STADIUM = Curved([(-1, -1), (1, -1), Arc((1, 1), center=(1, 0)), (-1, 1), Arc((-1, -1), center=(-1, 0))])
ROUNDED = Curved([(-1, -1), (1, -1), (1, 1), (-1, 1)], grown="1/2")
CORRIDOR = [[(-9, 1), (9, 1), (9, 3), (-9, 3)], [(-9, -3), (9, -3), (9, -1), (-9, -1)]]
TURNS = [0, 1, "1/3", "-7/5", None]


def arcs(scene: Scene) -> ArcScene:
    found = arcs_of(scene)
    assert found is not None
    return found


def hole(radius: Any) -> Curved:
    return Curved([(-3, -3), (3, -3), (3, 3), (-3, 3)], [Circle((0, 0), radius)])


# --- contacts with a known answer: free exactly there, forbidden as soon as the robot moves that way ---

CONTACTS = {
    "disc on floor": (DISC, [FLOOR], (0, 1), (0, -1)),
    "disc on disc": (DISC, [Curved.circle((3, 4), 4)], (0, 0), (3, 4)),
    "disc on a corner": (DISC, [[(0, 0), (4, 0), (4, 4)]], ("-3/5", "-4/5"), (3, 4)),
    "disc in its own hole": (DISC, [hole(1)], (0, 0), (1, 2)),
    "disc in a larger hole": (DISC, [hole(2)], ("3/5", "4/5"), (3, 4)),
    "stadium in a corridor of its width": (STADIUM, CORRIDOR, (0, 0), (1, 1)),
    "rounded square on floor": (ROUNDED, [FLOOR], (0, "3/2"), (0, -1)),
    "rounded square on rounded square": (ROUNDED, [ROUNDED], (3, 1), (-1, 0)),
    "two round corners": (ROUNDED, [ROUNDED], ("13/5", "14/5"), (-3, -4)),
    "disc of radius sqrt(2) on one of sqrt(8)": (
        Curved([(1, 1), Arc((1, 1), center=(0, 0))]),
        [Curved([(2, 2), Arc((2, 2), center=(0, 0))])],
        (3, 3),
        (-1, 0),
    ),
    "disc in a workspace of its size": (DISC, DISC, (0, 0), (0, 1)),
}


@pytest.mark.parametrize("name", CONTACTS)
def test_contact_is_free_and_a_little_deeper_is_not(name: str) -> None:
    robot, others, (x, y), (dx, dy) = CONTACTS[name]
    scene = Scene(robot, workspace=others) if isinstance(others, Curved) else Scene(robot, others)
    at, deeper = Pose(x, y), Pose(Fraction(x) + TINY * dx, Fraction(y) + TINY * dy)
    assert cfree.is_free(scene, at) is True and cfree.is_free(scene, deeper) is False
    assert cfree.is_free(scene, [at, deeper]).tolist() == [True, False]
    assert cfree.is_free_motion(scene, at, Translation((0, 0)))
    found = cfree.first_contact(scene, at, Translation((dx, dy)))
    assert found is not None and found.at == cfree.exact.surd.Surd(0)


@pytest.mark.parametrize("tau", TURNS)
def test_a_disc_is_free_at_every_orientation_or_at_none(tau: Any) -> None:
    scene = Scene(DISC, [FLOOR])
    assert cfree.is_free(scene, Pose(0, 1, {"tau": tau}))
    assert not cfree.is_free(scene, Pose(0, 1 - TINY, {"tau": tau}))


def test_rows_of_doubles_mean_the_exact_poses() -> None:
    scene = Scene(STADIUM, CORRIDOR, bounds=(-5, -1, 5, 1))
    rows = np.array([[0, 0, 0], [0, 1e-300, 0], [0, 0, 1e-9], [5, 0, 0], [5.000001, 0, 0], [0, 0.5, 0]])
    assert cfree.is_free(scene, rows).tolist() == [True, False, False, True, False, False]
    assert [cfree.is_free(scene, tuple(row)) for row in rows.tolist()] == cfree.is_free(scene, rows).tolist()
    assert cfree.is_free(scene, rows).dtype == bool
    assert cfree.is_free(scene, np.empty((0, 3))).tolist() == []


def test_an_arc_there_and_back_forbids_nothing() -> None:
    """A ring without inside, as a segment is."""
    there = Curved([(0, 0), Arc((2, 0), through=(1, 1)), Arc((0, 0), through=(1, 1))])
    rows = np.random.default_rng(0).uniform(-2, 2, (20_000, 3)) % [4, 4, math.tau]
    for scene in (Scene(DISC, [there]), Scene(there, [DISC])):
        assert cfree.is_free(scene, Pose(0, 0)) and cfree.is_free(scene, rows).all()
        assert cfree.is_free_motion(scene, Pose(-5, 0), Translation((9, 1)))
    assert not cfree.is_free(Scene(DISC, workspace=there), Pose(0, 0))


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_a_full_circle_of_one_to_four_arcs(count: int) -> None:
    """Also of more than half a turn: 5-fold rational points of the unit circle."""
    points = [(1, 0), ("3/5", "4/5"), (-1, 0), ("-3/5", "-4/5")][:count]
    path: list[Any] = [points[0]]
    for k in range(count):
        path.append(Arc(points[(k + 1) % count], center=(0, 0)))
    scene = Scene(Curved(path), [FLOOR])
    assert cfree.is_free(scene, Pose(0, 1, 0.3)) and not cfree.is_free(scene, Pose(0, 1 - TINY, 0.3))
    assert not cfree.is_free(Scene(Curved(path), [DISC]), Pose(0, 0))


def test_radii_of_all_sizes_in_one_scene() -> None:
    small, large = Fraction(1, 2**60), 2**60
    scene = Scene(Curved.circle((0, 0), small), [Curved.circle((0, 0), large)])
    assert cfree.is_free(scene, Pose(large + small, 0)) and not cfree.is_free(scene, Pose(large + small - TINY, 0))
    assert cfree.is_free_motion(scene, Pose(large + small, -5), Translation((0, 10)))
    assert not cfree.is_free_motion(scene, Pose(large + small - TINY, -5), Translation((0, 10)))


def test_tangency_off_by_rounding_is_exact() -> None:
    """The line ends 1e-15 above the arc's horizontal tangent: a corner with a cone of that angle."""
    off = Fraction(1, 10**15)
    shape = Curved([(-2, -1 - off), (0, -1), Arc((0, 1), center=(0, 0)), (-2, 1)])
    scene = Scene(shape, [FLOOR])
    assert cfree.is_free(scene, Pose(0, 1 + off)) and not cfree.is_free(scene, Pose(0, 1 + off - TINY))


def test_cusps_and_touching_arcs() -> None:
    fillet = Curved([(0, 0), (1, 0), Arc((0, 1), center=(1, 1), clockwise=True)])
    assert cfree.is_free(Scene(DISC, [fillet]), Pose(1, 1)) and not cfree.is_free(
        Scene(DISC, [fillet]), Pose(1, 1 - TINY)
    )
    assert cfree.is_free(Scene(fillet, [fillet]), Pose(1, 0)) and not cfree.is_free(
        Scene(fillet, [fillet]), Pose(1 - TINY, 0)
    )


def test_other_curves_stay_certified_polygons() -> None:
    scene = Scene(Curved.ellipse((0, 0), (1, 1)), [Curved.ellipse((0, 0), (1, 2))])
    assert arcs_of(Scene(DISC, [Curved.ellipse((0, 0), (1, 2))])) is None
    assert cfree.is_free(scene, Pose(2, 0)) is None and cfree.is_free(scene, Pose("2.1", 0)) is True


def test_an_ellipse_of_equal_radii_is_a_circle() -> None:
    assert cfree.is_free(Scene(DISC, [Curved.ellipse((0, 0), (1, 1))]), Pose(2, 0)) is True


def test_wrong_arguments_are_refused() -> None:
    scene = Scene(DISC, [FLOOR])
    with pytest.raises(ValueError, match="tolerance"):
        cfree.is_free(scene, Pose(0, 1), tolerance=-1)
    with pytest.raises(ValueError, match="threads"):
        cfree.is_free(scene, Pose(0, 1), threads=0)
    contacts = (
        cfree.collision.Touch("vertex-edge", (0, 0), (-2, 1)),
        cfree.collision.Touch("edge-vertex", (0, 2), (-2, 6)),
    )
    slide = cfree.Slide(contacts, [0, 0, -2, 2], [0, 2, -2], [1, 0, 1], 1)
    with pytest.raises(cfree.UnsupportedError, match="slide"):
        cfree.is_free_motion(scene, Pose(0, 1), slide)


# --- Lemma B and Lemma C, in fractions: docs/theory/exact-arcs.md ---


def _cross(a: ExactPoint, b: ExactPoint) -> Fraction:
    return a[0] * b[1] - a[1] * b[0]


def _dot(a: ExactPoint, b: ExactPoint) -> Fraction:
    return a[0] * b[0] + a[1] * b[1]


def _to(a: ExactPoint, b: ExactPoint) -> ExactPoint:
    return b[0] - a[0], b[1] - a[1]


def by_lemma_b(one: list[ExactPoint], other: list[ExactPoint], rho: Fraction) -> bool:
    """True if two convex polygons, or segments, are at least rho apart; rho 0: if their interiors are."""
    for own, seen in ((one, other), (other, one)):
        for k, p in enumerate(own):
            e = _to(p, own[(k + 1) % len(own)])
            sides = [_cross(e, _to(p, q)) for q in seen]
            if all(s <= 0 and s * s >= rho * rho * _dot(e, e) for s in sides):
                return True
    if not rho:
        return False
    for i, a in enumerate(one):
        for j, b in enumerate(other):
            d = _to(a, b)
            if (
                _dot(d, d) >= rho * rho
                and all(_dot(d, _to(a, one[k])) <= 0 for k in (i - 1, (i + 1) % len(one)))
                and all(_dot(d, _to(b, other[k])) >= 0 for k in (j - 1, (j + 1) % len(other)))
            ):
                return True
    return False


CORE = [(Fraction(x), Fraction(y)) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]


def _triangle(rng: random.Random, size: int = 8) -> list[ExactPoint]:
    while True:
        p, q, r = ((Fraction(rng.randint(-size, size), 4), Fraction(rng.randint(-size, size), 4)) for _ in range(3))
        if turn := _cross(_to(p, q), _to(p, r)):
            return [p, q, r] if turn > 0 else [p, r, q]


def test_grown_polygons_follow_lemma_b() -> None:
    rng, free = random.Random(1), 0
    for _ in range(60):
        a, b, r, s = _triangle(rng), _triangle(rng), Fraction(rng.randint(1, 4), 4), Fraction(rng.randint(0, 4), 4)
        scene = Scene(Curved(a, grown=r), [Curved(b, grown=s)])
        for _ in range(8):
            x, y = (Fraction(rng.randint(-20, 20), 4) for _ in range(2))
            pose = Pose(x, y, {"tau": rng.choice([0, 1, "1/3"])})
            expected = by_lemma_b(pose.apply_exact(a), b, r + s)
            assert cfree.is_free(scene, pose) is expected, (a, b, r, s, pose)
            free += expected
    assert 100 < free < 400


def by_lemma_c(polygon: list[ExactPoint], rho: Fraction = Fraction(0)) -> bool:
    """True if a convex polygon is apart from the fillet between the unit circle and its tangents at (1, 0), (0, 1)."""
    p, m, q = ((Fraction(1), Fraction(0)), (Fraction(1), Fraction(1)), (Fraction(0), Fraction(1)))
    if by_lemma_b(polygon, [p, m, q], rho):
        return True
    if not (by_lemma_b(polygon, [p, m], rho) and by_lemma_b(polygon, [m, q], rho)):
        return False
    return all(_dot(v, v) <= 1 for v in polygon if v[0] <= 1 and v[1] <= 1 and v[0] + v[1] >= 1)


def test_fillets_follow_lemma_c() -> None:
    fillet = Curved([(1, 0), (1, 1), (0, 1), Arc((1, 0), center=(0, 0), clockwise=True)])
    rng, counts = random.Random(2), [0, 0]
    for _ in range(150):
        a = _triangle(rng, 4)
        scene = Scene(a, [fillet])
        for _ in range(4):
            x, y = (Fraction(rng.randint(-6, 6), 8) for _ in range(2))
            pose = Pose(x, y, {"tau": rng.choice([0, 1, "1/3"])})
            expected = by_lemma_c(pose.apply_exact(a))
            assert cfree.is_free(scene, pose) is expected, (a, pose)
            counts[expected] += 1
    assert min(counts) > 100


# --- motions ---


def test_exact_fits_along_a_line_and_about_a_point() -> None:
    corridor = Scene(STADIUM, CORRIDOR)
    assert cfree.is_free_motion(corridor, Pose(-15, 0), Translation((30, 0)))
    assert not cfree.is_free_motion(corridor, Pose(-15, 0), Translation((30, TINY)))
    peg = Scene(DISC, [hole(1)])
    assert cfree.is_free_motion(peg, Pose(0, 0), Rotation((0, 0), "180deg"))
    assert not cfree.is_free_motion(peg, Pose(0, 0), Rotation((TINY, 0), "1deg"))
    slot = Scene(STADIUM, [hole(2)])
    assert cfree.is_free_motion(slot, Pose(0, 0), Rotation((0, 0), "180deg"))
    assert not cfree.is_free_motion(slot, Pose(0, 0), Rotation((0, TINY), "180deg"))


def test_a_disc_rolls_around_a_disc() -> None:
    scene = Scene(DISC, [Curved.circle((0, 0), 2)])
    assert cfree.is_free_motion(scene, Pose(3, 0), Rotation((0, 0), "180deg"))
    assert not cfree.is_free_motion(scene, Pose(3, 0), Rotation((TINY, 0), "180deg"))
    assert cfree.is_free_motion(scene, Pose(3, 0), Rotation((-TINY, 0), "180deg"))


def test_the_first_contact_is_in_a_narrow_interval() -> None:
    scene = Scene(DISC, [[(20, 0), (21, 0), (21, 1)], Curved.circle((0, 0), 2)])
    found = cfree.first_contact(scene, Pose(1, 10), Translation((0, -10)))
    assert found is not None and (found.robot, found.obstacle, found.contact) == (0, 1, ArcArc(0, 0))
    assert abs(10 - 10 * float(found.at) - math.sqrt(8)) < 1e-14 and 0 < found.width <= Fraction(1, 2**60)
    assert cfree.first_contact(scene, Pose(3, 10), Translation((0, -20))) is None


def test_a_motion_stays_in_bounds_and_workspace() -> None:
    scene = Scene(DISC, workspace=Curved.circle((0, 0), 3), bounds=(-1, -2, 2, 2))
    assert cfree.is_free_motion(scene, Pose(2, 0), Translation((-3, 0)))
    found = cfree.first_contact(scene, Pose(2, 0), Translation((-4, 0)))
    assert found is not None and found.obstacle == -1 and abs(float(found.at) - 0.75) < 1e-15
    assert cfree.is_free_motion(Scene(DISC, workspace=Curved.circle((0, 0), 3)), Pose(2, 0), Rotation((0, 0), "180deg"))
    out = cfree.first_contact(scene, Pose(0, 0), Rotation((0, -2), "90deg"))
    assert out is not None and out.obstacle == -1


def test_distances_are_intervals_around_the_truth() -> None:
    scene = arcs(Scene(DISC, [Curved.circle((5, 0), 2), FLOOR]))
    low, high = scene.distance(Pose(2, 3))
    assert low <= math.sqrt(18) - 3 <= high and high - low < 1e-9
    assert scene.distance(Pose(0, 1))[0] == 0 and scene.distance(Pose(0, 1))[1] < 1e-9
    low, high = scene.clearance(Pose(-5, 4), Translation((10, 0)), 1e-7)
    assert low <= 1 <= high and high - low < 2e-7  # over (5, 4) the disc about (5, 0) is 1 away
    low, high = scene.clearance(Pose(0, 3), Rotation((5, 0), "-60deg"), 1e-7)
    assert high - low < 2e-7


@pytest.mark.parametrize("seed", range(6))
def test_poses_and_motions_agree_with_the_oracles(seed: int) -> None:
    counts = fuzz_arcs.run(seed, 15, 3)
    assert counts["poses"] == 15 and counts["undecided by polygons"] < 8


@pytest.mark.slow
def test_many_poses_and_motions_agree_with_the_oracles() -> None:
    for seed in range(1000, 1100):
        fuzz_arcs.run(seed, 20, 4)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(6))
def test_many_poses_are_decided_by_boxes_as_one_by_one(seed: int) -> None:
    """The second scene has no digits for doubles, so that each of its poses is decided exactly."""
    rng = random.Random(seed)
    robot = [moved_near(kind(rng)) for kind in rng.sample(fuzz_arcs.KINDS, 2)]
    room = Curved.circle((0, 0), 9) if seed % 2 else None
    scene = Scene(robot, [rng.choice(fuzz_arcs.KINDS)(rng) for _ in range(8)], workspace=room, bounds=(-8, -8, 8, 8))
    slow = Scene(
        robot, [*scene.obstacles, [(2**80, 0), (2**80 + 1, 0), (2**80, 1)]], workspace=room, bounds=scene.bounds
    )
    random_ = np.random.default_rng(seed)
    rows = np.column_stack([random_.uniform(-9, 9, (60_000, 2)), random_.uniform(0, 2 * math.pi, 60_000)])
    near = cfree.is_free(scene, rows)
    assert (near == cfree.is_free(scene, rows)).all()
    few = rng.sample(range(len(rows)), 1500)
    assert (near[few] == cfree.is_free(slow, rows[few])).all()
    assert [cfree.is_free(scene, tuple(row)) for row in rows[few[:200]].tolist()] == near[few[:200]].tolist()


def moved_near(shape: Any) -> Any:
    """A shape about the origin, so that the robot turns about itself."""
    x, y = (round(float(low + high) / 2) for low, high in zip(box_of(shape)[:2], box_of(shape)[2:], strict=True))
    if isinstance(shape, cfree.Polygon):
        return cfree.Polygon([(a - x, b - y) for a, b in shape.exact_vertices])
    if isinstance(shape.path, Circle):
        return Curved.circle((shape.path.center[0] - x, shape.path.center[1] - y), shape.path.radius)
    if shape.holes:
        return shape
    if shape.grown:
        return Curved([(a - x, b - y) for a, b in shape.path], grown=shape.grown)
    return fuzz_arcs.moved(list(shape.path), -x, -y)


# --- searches on the true shapes, with polygons around them as a guide ---


def test_searches_take_arcs_as_their_test_of_motions() -> None:
    """A stadium through a corridor of its width: among polygons around the two no path exists."""
    scene = Scene(STADIUM, CORRIDOR, bounds=(-20, -3, 20, 3))
    features = scene_features(scene.outer(0.01))
    known = _core.KnownScene(features.made, _core.MotionChecker(features.core, arcs(scene).motions))
    ends = [end_of(pose) for pose in (Pose(-15, 0), Pose(15, 0))]
    searcher = _core.Searcher(known, [place for _, place in ends], (2.0, 1.0, 1.0, 1.0), (0.0, 0.0, 0.0), None)
    shortener = searcher.shortener([*ends], 0)
    assert shortener.length() == 30
    shortener.merge()
    assert len(shortener.path()) == 2
    start, goal = [end_of(pose) for pose in (Pose(-15, 2), Pose(-15, -2, 2.0))]
    free = _core.Searcher(known, [start[1], goal[1]], (2.0, 1.0, 1.0, 1.0), (0.0, 0.0, 0.0), None)
    search, way = free.search(start, goal, 0), []
    for _ in range(50):
        if way := search.run(200):
            break
    poses = [from_numbers(numbers) for numbers in way]
    assert len(poses) > 1 and all(cfree.is_free_motion(scene, a, joining(a, b)) for a, b in pairwise(poses))


@pytest.mark.parametrize("halves", [20, 2000, 10**6, 10**12])
def test_a_disc_without_a_thin_segment_may_touch_a_wall_there(halves: int) -> None:
    tau = Fraction(1, halves)
    c, s = (1 - tau**2) / (1 + tau**2), 2 * tau / (1 + tau**2)
    cut = Curved([(c, s), Arc((c, -s), center=(0, 0))])
    scene = Scene(cut, [[(c, -5), (9, -5), (9, 5), (c, 5)]])
    assert is_free(scene, Pose(0, 0)) is True
    assert is_free(scene, Pose(Fraction(1, 10**40), 0)) is False
    assert is_free(scene, [[0, 0, 0]]).tolist() == [True]
