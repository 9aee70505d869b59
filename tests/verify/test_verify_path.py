"""The checker of paths agrees with the core, touching or not, and uses nothing of it."""

from __future__ import annotations

import random
import subprocess
import sys
from fractions import Fraction
from pathlib import Path as FilePath

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import cfree.verify
import strategies
from answers import corridor
from cfree import MotionChecker, Path, Pose, Rotation, Scene, Translation, load_scene, save
from cfree.verify.motions import touches
from cfree.verify.positivity import is_nowhere_positive, samples
from cfree.verify.world import World
from compared import scene_of
from moving import motions, poses
from reading_only import READING_ONLY
from shapes import PlainScene, box
from spaces import ROD, TIGHT

ROOT = FilePath(__file__).parents[2]
SQUARE = box("-1/2", "-1/2", "1/2", "1/2")[0]


def verified(scene: Scene, start: Pose, *moves: Translation | Rotation) -> bool:
    return cfree.verify.answer(scene, Path(start, moves)).verified


@pytest.mark.slow
@settings(max_examples=150, deadline=None)
@given(strategies.scenes(), poses, st.lists(motions, max_size=2))
def test_paths_are_free_where_the_core_says_so(
    plain: PlainScene, start: Pose, moves: list[Translation | Rotation]
) -> None:
    scene = scene_of(plain)
    path = Path(start, moves)
    checker = MotionChecker(scene)
    free = path.is_free(checker) and checker.is_free(start, Translation((0, 0)))
    assert cfree.verify.answer(scene, path).verified == free


@settings(max_examples=300, deadline=None)
@given(st.tuples(*[st.integers(-9, 9)] * 3), st.integers(0, 6), st.integers(1, 6))
def test_a_quadratic_is_nowhere_positive(q: tuple[int, int, int], a: int, length: int) -> None:
    places = [1000 * a + length * k for k in range(1001)]  # times 7000, and values times 7000^2
    values = [q[0] * 7000**2 + q[1] * 7000 * u + q[2] * u * u for u in places]
    if max(values) > 0:
        assert not is_nowhere_positive(q, (a, a + length, 7))
    elif q[2] >= 0 or 4 * q[0] * q[2] >= q[1] ** 2:  # convex, or without two roots
        assert is_nowhere_positive(q, (a, a + length, 7))


def test_sliding_turning_on_a_corner_and_exact_fits() -> None:
    slot = Scene(SQUARE, [box(-9, "1/2", 9, 1)[0], box(-9, -1, 9, "-1/2")[0]])
    assert verified(slot, Pose(-12, 0), Translation((24, 0)))
    assert not verified(slot, Pose(-12, 0), Translation((24, "1e-30")))
    assert not verified(slot, Pose(-12, "1e-30"), Translation((24, 0)))
    room = Scene(box(-4, -3, 4, 3)[0], workspace=box(-5, -5, 5, 5)[0])  # its corners are 5 from the pole
    assert verified(room, Pose(0, 0), *[Rotation((0, 0), {"tau": "inf"})] * 2)
    assert not verified(room, Pose(0, 0), Rotation((0, "1e-30"), {"tau": "inf"}))
    peak = Scene([(0, 0), (2, -1), (2, 1)], [[(0, 0), (-2, 1), (-2, -1)]])
    assert verified(peak, Pose(0, 0), Rotation((0, 0), "90deg"), Rotation((0, 0), "-180deg"))
    assert not verified(peak, Pose(0, 0), Rotation((0, 0), "180deg"))


def test_two_edges_take_turns_at_a_contact_that_no_halving_meets(monkeypatch: pytest.MonkeyPatch) -> None:
    """A corner of the robot passes a corner of the obstacle, touching it at u = 5/7."""
    asked = []
    monkeypatch.setattr("cfree.verify.motions.samples", lambda *a: asked.append(a) or samples(*a))
    disc = Scene([(0, 0), (3, 0), (3, 1), (0, 1)], [[(1, 3), (9, 3), (9, 9), (1, 9)]])  # corners at sqrt 10
    turn = {"tau": "3/4"}
    assert verified(disc, Pose(0, 0), Rotation((0, 0), turn)) and asked
    assert not verified(disc, Pose(0, "1e-30"), Rotation((0, "1e-30"), turn))


def test_bounds_and_workspace_hold_all_the_way() -> None:
    scene = Scene(SQUARE, bounds=(0, 0, 4, 4), workspace=box(-9, -9, 9, 9)[0])
    assert verified(scene, Pose(0, 0), Translation((4, 0)), Rotation((4, 2), "-180deg"), Translation((-4, 0)))
    assert not verified(scene, Pose(0, 0), Rotation((2, 0), "180deg"))  # by the bounds' lower side
    assert not verified(Scene(SQUARE, workspace=box(0, 0, 9, 9)[0]), Pose(30, 3), Translation((1, 0)))
    assert not verified(scene, Pose(5, 0)) and verified(scene, Pose(4, 4))


def test_who_touches() -> None:
    world = World(Scene(SQUARE, [box(2, 2, 3, 3)[0]], bounds=(-4, -4, 4, 4), workspace=box(-8, -3, 8, 8)[0]))
    for x, y, expected in ((0, 0, False), ("3/2", 1, False), ("3/2", "3/2", True), ("3/2", 2, True), (-4, 0, True)):
        assert touches(world, Pose(x, y)) == expected
    assert touches(world, Pose(0, "-5/2"))


def test_many_motions_among_many_obstacles() -> None:
    scene = load_scene(ROOT / "examples/scenes/benchmr_warehouse.json")
    assert scene.start is not None
    rng, checker, moves = random.Random(0), MotionChecker(scene), []
    where = scene.start
    while len(moves) < 12:
        x, y = (Fraction(rng.randrange(-30, 31), 8) for _ in "xy")
        move = rng.choice([Translation((x, y)), Rotation((where.x + x, where.y + y), {"tau": x / 2})])
        if checker.is_free(where, move):
            moves.append(move)
            where = move.apply(where)
    bare = Scene(scene.robot, scene.obstacles, bounds=scene.bounds, workspace=scene.workspace)
    assert verified(bare, scene.start, *moves)


@pytest.mark.slow
def test_the_core_reads_the_scene_and_the_planner_is_not_used(tmp_path: FilePath) -> None:
    scene, path = corridor()
    save(scene, tmp_path / "scene.json")
    save(path, tmp_path / "path.json", scene=scene)
    program = (
        f"{READING_ONLY}\nimport cfree.verify\n"
        f"print(cfree.verify.answer(cfree.load_scene({str(tmp_path / 'scene.json')!r}), "
        f"{str(tmp_path / 'path.json')!r}).verified)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.stdout == "True\n", done.stderr


@pytest.mark.parametrize("degrees", ["0deg", "180deg"])
def test_a_pose_is_a_path(degrees: str) -> None:
    scene = scene_of(PlainScene([ROD], [TIGHT]))
    assert verified(scene, Pose(0, 0, degrees)) and not verified(scene, Pose(2, 0, degrees))
