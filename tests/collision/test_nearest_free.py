"""Forbidden poses: what the message says, and that what it suggests is free."""

from __future__ import annotations

import math
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import oracles
from cfree import (
    Curved,
    InvalidPoseError,
    Polygon,
    Pose,
    PoseChecker,
    Poses,
    Scene,
    boundary,
    free_space,
    is_free,
    largest_disc,
    load_scene,
    nearest_free,
    require_free,
)
from cfree.collision import free_nearby
from cfree.curves import Circle
from compared import plain_of, scene_of
from shapes import KINDS, box, random_scene

ROOT = Path(__file__).parents[2]
SQUARE = box(0, 0, 1, 1)[0]


def fault(scene: Scene, pose: Pose) -> str:
    with pytest.raises(InvalidPoseError) as caught:
        require_free(scene, pose, "goal")
    return str(caught.value)


def test_messages_name_who_overlaps_whom() -> None:
    scene = Scene(
        [SQUARE, box(3, 0, 4, 1)[0]], [box(9, 9, 10, 10)[0], box(5, 0, 6, 1)[0]], obstacle_names=[None, "post"]
    )
    assert fault(scene, Pose(1.5, 0)).startswith(
        "goal (1.5, 0, 0 deg) is forbidden: robot part 1 overlaps obstacle 1 (post), 1 x 1 at (5.5, 0.5); ("
    )
    assert "robot part 0 overlaps obstacle 0, 1 x 1 at (9.5, 9.5); " in fault(scene, Pose("9.5", "9.5"))
    assert "the reference point is outside the bounds; " in fault(Scene(SQUARE, bounds=(0, 0, 1, 1)), Pose(2, 0))
    room = Scene(SQUARE, workspace=box(0, 0, 9, 9)[0])
    for x in (8.5, 30):
        assert "robot part 0 is not inside the workspace; " in fault(room, Pose(x, 0))


@pytest.mark.parametrize("kind", KINDS)
def test_suggestions_are_free_by_another_test_and_always_the_same(kind: str) -> None:
    rng, suggested = np.random.default_rng(2), 0
    for seed in range(3):
        plain = random_scene(seed, kind)
        scene = scene_of(plain)
        xy = np.concatenate([polygon.vertices for polygon in scene.obstacles])
        for _ in range(6):
            pose = Pose(*rng.uniform(xy.min(0), xy.max(0)).tolist(), {"tau": int(rng.integers(-3, 4))})
            if is_free(scene, pose):
                require_free(scene, pose)
                continue
            with pytest.raises(InvalidPoseError) as caught:
                require_free(PoseChecker(scene), pose)
            q = caught.value.free
            if q is not None:
                suggested += 1
                assert not oracles.exact_is_forbidden(
                    plain.robot, plain.obstacles, q.x, q.y, q.tau, plain.bounds, plain.workspace
                )
                assert q == free_nearby(scene, pose) and "is free and near by" in str(caught.value)
    assert suggested > 0


def test_a_suggestion_is_about_as_near_as_it_can_be() -> None:
    scene = Scene(SQUARE, [box(1, -50, 9, 50)[0]])
    for depth in (1e-5, 1e-3, 0.1, 1.0, 5.0):
        q = free_nearby(scene, Pose(depth, 0.0))
        assert q is not None
        away = np.hypot(depth - float(q.x), float(q.y)) + abs(np.remainder(q.theta + np.pi, 2 * np.pi) - np.pi)
        assert 0.8 * depth <= away < 1.8 * depth  # turned, it may be nearer


def test_nothing_is_suggested_where_nothing_is_free() -> None:
    message = fault(Scene(box(0, 0, 3, 3)[0], workspace=box(0, 0, 1, 1)[0]), Pose(0, 0))
    assert message.endswith("no free pose was found near by; give another")


def test_reachable_cells() -> None:
    scene = load_scene(ROOT / "examples/scenes/flat.json")
    space = free_space(boundary(scene))
    for cell in space.cells:
        assert largest_disc(cell) is not None
        assert space.reachable(largest_disc(cell)[0]) is cell
    plain = plain_of(scene)
    corner = Pose(*map(float, plain.obstacles[0][0][0]))
    with pytest.raises(InvalidPoseError, match=r"start .* is forbidden"):
        space.reachable(corner)


def test_an_exact_fit_is_in_no_cell() -> None:
    tight = Scene(SQUARE, Polygon(box(-1, -1, 2, 2)[0], [box(0, 0, 1, 1)[0]]))
    with pytest.raises(InvalidPoseError, match="exact fit"):
        free_space(boundary(tight)).reachable(Pose(0, 0))


# the nearest


def test_the_nearest_free_pose_touches_in_short_numbers() -> None:
    scene = Scene(SQUARE, [box(2, 0, 3, 9)[0]])
    for pose, nearest in (((1.25, 2), (1, 2)), ((2.25, 2), (3, 2)), (("2.4", "8.7"), ("2.4", 9)), ((0, 0), (0, 0))):
        assert nearest_free(scene, Pose(*pose)) == Pose(*nearest)
    bounded = Scene(SQUARE, bounds=(0, 0, 1, 1))
    assert nearest_free(bounded, Pose(500, "0.5")) == Pose(1, "0.5")
    assert nearest_free(Scene(SQUARE, [box(-3, -3, 9, 9)[0]], bounds=(0, 0, 1, 1)), Pose(0, 0)) is None
    deep = Scene(SQUARE, [box(-500, -300, 500, 300)[0]])
    assert nearest_free(deep, Pose(0, 200)) == Pose(0, 300)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_no_pose_of_a_fine_grid_is_much_nearer(kind: str) -> None:
    """Those within a tenth of the way that was found, at 40,000 places and 15 angles each."""
    for seed in range(3):
        scene, rng = scene_of(random_scene(seed, kind)), np.random.default_rng(seed)
        checker = PoseChecker(scene)
        low, high = np.array([o.bounds for o in scene.obstacles]).reshape(-1, 2, 2).mean(axis=0)
        length = max(float(np.ptp(part.vertices, axis=0).max()) for part in scene.robot)
        for x, y, theta in rng.uniform((*low, 0), (*high, 6), size=(6, 3)):
            pose = Pose(x, y, theta)
            found = nearest_free(checker, pose)
            if found is None or found == pose:
                continue
            assert checker.is_free(found)
            turn = abs(math.remainder(found.theta - theta, math.tau))
            way = math.hypot(float(found.x) - x, float(found.y) - y) + length * turn
            for share in np.linspace(-0.9, 0.9, 15):
                left = 0.9 * way * (1 - abs(share))
                grid = rng.uniform(-left, left, size=(40_000, 2))
                near = grid[np.hypot(*grid.T) < left]
                turned = np.full(len(near), theta + share * way / length)
                assert not checker.is_free(Poses(near + np.array([x, y]), turned)).any(), (kind, seed, x, y, theta)


def test_among_arcs_the_nearest_pose_is_free_on_the_true_shapes() -> None:
    """Discs in contact: exactly, where that is rational; radii from 2**-20 on; in a hole with a little room."""
    two = Scene(Curved.circle((0, 0), 1), [Curved.circle((3, 0), 2)])
    assert nearest_free(two, Pose("1/2", 0)) == Pose(0, 0)
    slanted = nearest_free(two, Pose(1, "0.7"))
    assert slanted is not None and is_free(two, slanted) is True
    away = math.hypot(float(slanted.x) - 1, float(slanted.y) - 0.7)
    assert 0 < away - (3 - math.hypot(2, 0.7)) < 0.02
    tiny = Scene(Curved.circle((0, 0), Fraction(1, 2**20)), [Curved.circle((3, 0), 2)])
    found = nearest_free(tiny, Pose("1.001", 0))
    assert found is not None and is_free(tiny, found) is True and abs(float(found.x) - 1) < 2.0**-19
    room = Curved([(-3, -3), (3, -3), (3, 3), (-3, 3)], [Circle((0, 0), "1.01")])
    inside = nearest_free(Scene(Curved.circle((0, 0), 1), [room], bounds=(-1, -1, 1, 1)), Pose("0.3", "0.1"))
    assert inside is not None and math.hypot(float(inside.x), float(inside.y)) <= 0.01
    fit = Curved([(-3, -3), (3, -3), (3, 3), (-3, 3)], [Circle((0, 0), 1)])
    inside = nearest_free(Scene(Curved.circle((0, 0), 1), [fit], bounds=(-1, -1, 1, 1)), Pose("0.3", "0.1"))
    assert inside == Pose(0, 0)  # it fits exactly
    assert nearest_free(two, Pose(0, 0)) == Pose(0, 0)


def test_among_ellipses_the_nearest_pose_is_free_among_polygons() -> None:
    scene = Scene(Curved.ellipse((0, 0), (2, 1)), [Curved.circle((3, 0), 2)])
    found = nearest_free(scene, Pose("1/2", 0))
    assert found is not None and is_free(scene, found) is True
    assert nearest_free(scene, Pose("-1.001", 0)) == Pose("-1.001", 0)  # free itself, nearer than the polygons


def test_messages_among_arcs_name_a_free_pose() -> None:
    scene = Scene(Curved.circle((0, 0), 1), [Curved.circle((3, 0), 2)])
    require_free(scene, Pose(0, 0))
    assert "robot part 0 overlaps obstacle 0, 4 x 4 at (3, 0); (-0.08, 0, 0 deg) is free and near by" in fault(
        scene, Pose("1/2", 0)
    )
    near = free_nearby(scene, Pose("1/2", 0))
    assert near is not None and is_free(scene, near) is True
