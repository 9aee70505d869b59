"""Turning in place, against dense sampling, closed forms, and exact checks of rotations up to the ends and beyond."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest

import cfree
from cfree import MotionChecker, Pose, PoseChecker, Rotation, Scene, turn_in_place
from cfree.exact import AngleInterval
from cfree.exact.angle_set import union_of_intersections, where_not_positive
from compared import scene_of
from shapes import KINDS, box, random_scene

SQUARE = box(-1, -1, 1, 1)[0]


def rotation(start: Fraction | None, stop: Fraction | None, pole: tuple[Fraction, Fraction]) -> list[Rotation]:
    """Counter-clockwise, in two halves, so that each is less than half a turn."""
    p, q = Pose(0, 0, {"tau": start}), Pose(0, 0, {"tau": stop})
    whole = math.fmod(q.theta - p.theta + math.tau, math.tau)
    middle = Pose(0, 0, p.theta + whole / 2)
    return [Rotation(pole, {"tau": (b @ a.inverse()).tau}) for a, b in ((p, middle), (middle, q))]


def check_by_motions(scene: Scene, interval: AngleInterval, pose: Pose, pole: tuple[Fraction, Fraction]) -> None:
    """Turning from just inside one end to just inside the other is free; a bit beyond an end is not."""
    assert interval.start is not None and interval.stop is not None
    poses, checker, bits = PoseChecker(scene), MotionChecker(scene), 40

    def at(tau: Fraction | None) -> Pose:
        return Rotation(pole, {"tau": (Pose(0, 0, {"tau": tau}) @ Pose(0, 0, {"tau": pose.tau}).inverse()).tau}).apply(
            pose
        )

    first, last = interval.start.neighbours(bits)[1], interval.stop.neighbours(bits)[0]
    if interval.is_single:
        if len(interval.start.polynomial) == 2:
            assert poses.is_free(at(first))
    elif interval.theta[1] - interval.theta[0] > 1e-9:
        q = at(first)
        for turn in rotation(first, last, pole):
            assert checker.is_free(q, turn)
            q = turn.apply(q)
    step = Pose(0, 0, {"tau": Fraction(1, 1 << 30)})
    before, after = step.inverse() @ Pose(0, 0, {"tau": first}), step @ Pose(0, 0, {"tau": last})
    assert not poses.is_free(at(before.tau)) and not poses.is_free(at(after.tau))


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("own_pole", [True, False])
def test_sampled_orientations_are_free_exactly_in_the_intervals(kind: str, own_pole: bool) -> None:
    rng = np.random.default_rng(4)
    some = 0
    for seed in range(4):
        scene = scene_of(random_scene(seed, kind))
        xy, checker = np.concatenate([polygon.vertices for polygon in scene.obstacles]), PoseChecker(scene)
        for _ in range(8):
            x, y = (Fraction(round(4 * c), 4) for c in rng.uniform(xy.min(0), xy.max(0)))
            pose = Pose(x, y, {"tau": Fraction(int(rng.integers(-9, 9)), 7)})
            pole = (x, y) if own_pole else (x + Fraction(1, 3), y - 1)
            found = turn_in_place(scene, pose, None if own_pole else pole)
            turns = [Rotation(pole, {"tau": Fraction(k, 60)}) for k in range(-60, 60, 3)]
            for turn in turns:
                for q in (turn.apply(pose), Rotation(pole, {"tau": None}).apply(turn.apply(pose))):
                    assert checker.is_free(q) == any(interval.contains({"tau": q.tau}) for interval in found)
            for interval in found:
                if interval.start is not None:
                    some += 1
                    check_by_motions(scene, interval, pose, pole)
    assert some > 3


def test_closed_forms() -> None:
    # the half diagonal of the square, sqrt(2), meets walls at a distance of 5/4: at asin(5 / (4 sqrt 2)) - 45 degrees
    walls = [box(-9, "5/4", 9, 3)[0], box(-9, -3, 9, "-5/4")[0]]
    extreme = math.asin(1.25 / math.sqrt(2)) - math.pi / 4
    found = turn_in_place(Scene(SQUARE, walls), Pose(0, 0))
    assert len(found) == 4
    for k, interval in enumerate(sorted(found, key=lambda x: x.theta[1] % math.tau)):
        np.testing.assert_allclose(interval.theta[1] % math.tau, extreme + k * math.pi / 2, atol=1e-15 * 4)
        assert interval.stop is not None and len(interval.stop.polynomial) == 3
    assert turn_in_place(Scene(SQUARE, [box(2, -9, 3, 9)[0]]), Pose(0, 0)) == (AngleInterval(None, None),)
    assert turn_in_place(Scene(SQUARE, [box(0, -9, 3, 9)[0]]), Pose(0, 0)) == ()


def test_exact_fits_are_single_orientations() -> None:
    walls = [box(-9, 1, 9, 3)[0], box(-9, -3, 9, -1)[0]]
    found = turn_in_place(Scene(SQUARE, walls), Pose(0, 0))
    assert [interval.is_single for interval in found] == [True] * 4
    assert [interval.theta[0] / (math.pi / 2) for interval in found] == [0, 1, 2, 3]
    tiny = Fraction(1, 10**40)
    assert turn_in_place(Scene(SQUARE, walls), Pose(0, tiny)) == ()
    wider = [box(-9, 1 + tiny, 9, 3)[0], walls[1]]
    found = turn_in_place(Scene(SQUARE, wider), Pose(0, tiny / 2))
    assert [interval.is_single for interval in found] == [False] * 4
    assert all(interval.theta[1] - interval.theta[0] < 1e-15 for interval in found)


def test_an_arc_touched_from_outside_stays_whole() -> None:
    # a vertex passes through a corner's point, at 5 from the pole, and is free all the way
    disc = Scene([(5, 0), (0, 1), (-1, 0), (0, -1)], [[(3, 4), (9, 4), (9, 12)]])
    assert turn_in_place(disc, Pose(0, 0)) == (AngleInterval(None, None),)


def test_bounds_and_workspace() -> None:
    scene = Scene(SQUARE, bounds=(0, 0, 4, 4))
    assert turn_in_place(scene, Pose(0, 0)) == (AngleInterval(None, None),)
    assert turn_in_place(scene, Pose(-1, 0)) == ()
    (found,) = turn_in_place(scene, Pose(4, 0), pole=(0, 0))  # the reference point on a circle of radius 4
    assert found.theta == (0.0, math.pi / 2)
    room = Scene(SQUARE, workspace=box(0, 0, 4, 4)[0])
    assert [interval.theta[0] for interval in turn_in_place(room, Pose(1, 1))] == [
        0,
        math.pi / 2,
        math.pi,
        3 * math.pi / 2,
    ]
    assert turn_in_place(room, Pose(50, 2)) == ()
    assert turn_in_place(room, Pose(2, 2)) == (AngleInterval(None, None),)


def test_a_boundary_is_asked_for_its_scene() -> None:
    scene = Scene(SQUARE, [box(1, -9, 3, 9)[0]])
    assert turn_in_place(cfree.boundary(scene), Pose(0, 0)) == turn_in_place(scene, Pose(0, 0))


@pytest.mark.slow
def test_arcs_agree_with_their_forms_at_random_orientations() -> None:
    rng = np.random.default_rng(7)
    for _ in range(300):
        families = [[tuple(rng.integers(-3, 4, 3).tolist()) for _ in range(2)] for _ in range(2)]
        arcs = union_of_intersections([[where_not_positive(form) for form in family] for family in families])
        for k in range(-8, 9):
            for turned in (False, True):
                tau = Fraction(k, 8)
                c, s, w = 64 - k * k, 16 * k, 64 + k * k
                if turned:
                    c, s, tau = -c, -s, -1 / tau if tau else None
                expected = any(all(A * w + B * c + C * s <= 0 for A, B, C in family) for family in families)
                if isinstance(arcs, bool):
                    assert arcs == expected
                else:
                    found = [AngleInterval(start.exact, stop.exact).contains({"tau": tau}) for start, stop in arcs]
                    assert any(found) == expected and sum(found) <= 1
