"""`Planner.updated`: what still holds in a changed scene is shared, and answers are right."""

import random
import threading
import time
from fractions import Fraction
from pathlib import Path

import pytest

import cfree
from cfree import verify
from cfree.errors import CfreeError
from cfree.exact.pose import PoseLike
from cfree.planning.caller import Caller, Work
from cfree.planning.core_ways import numbers_of
from cfree.planning.planner import Planner
from cfree.scene.scene import Scene
from changes import BAR, box, changed, random_scene

ROOT = Path(__file__).parents[2]
WALLS = [box(0, 0, 1, 5), box(4, 0, 1, 5)]
ROOM = box(-3, -3, 12, 12)
SCENE = Scene(BAR, WALLS, workspace=ROOM)
TEETH = [point for k in range(9, 0, -1) for point in ((69, 2 * k + 1), (66, 2 * k))]
RING = cfree.Polygon([(50, 0), (70, 0), (70, 20), (50, 20)], [[(52, 2), (52, 18), *TEETH, (66, 1)]])
SHUT = Scene(BAR, [RING, box(100, 0, 2, 2), box(110, 0, 2, 2)])
INSIDE, OUTSIDE = (60, 10, 0), (30, 10, 0)


def plan(planner: Planner, start: PoseLike, goal: PoseLike) -> object:
    return planner.plan(start, goal, improve=0)


def assert_right(answer: object, scene: Scene) -> None:
    assert isinstance(answer, cfree.Path | cfree.Separated)
    assert answer.scene == scene
    assert not verify.answer(scene, answer).findings


def trimmed(planner: Planner, start: PoseLike, goal: PoseLike) -> int:
    """Return the number of patches that a search for a proof has trimmed in the scene itself."""
    work = Work(10**9)
    ends = (numbers_of(cfree.Pose(*pose)) for pose in (start, goal))
    planner._poses._known.barrier(*ends, Caller(work=work))
    return work.patches - work.left


# paths


def test_the_updated_planner_answers_in_the_new_scene() -> None:
    planner = Planner(SCENE)
    assert_right(plan(planner, (2, 2, 0), (6, 2, 0)), SCENE)
    moved = SCENE.moved(1, (0, 1, 0))
    updated = planner.updated(moved)
    assert updated.scene == moved
    assert_right(plan(updated, (2, 2, 0), (6, 2, 0)), moved)


def test_a_path_that_is_still_free_is_not_searched_again() -> None:
    planner = Planner(SCENE)
    assert isinstance(plan(planner, (2, 2, 0), (6, 2, 0)), cfree.Path)
    moved = SCENE.moved(0, (-1, 0, 0))
    phases: list[str] = []

    class Named:
        def __init__(self, name: str) -> None:
            phases.append(name)

        def __enter__(self) -> None:
            return None

        def __exit__(self, *_: object) -> None:
            return None

    updated = planner.updated(moved)
    updated.phase = Named
    assert_right(plan(updated, (2, 2, 0), (6, 2, 0)), moved)
    assert "search" not in phases
    assert_right(plan(updated, (2, 2, 0), (6, "2.5", 0)), moved)  # from a pose beside its end
    assert_right(plan(updated, (6, 2, 0), (2, 2, 0)), moved)
    assert "search" not in phases


def test_a_path_that_an_obstacle_blocks_is_not_taken() -> None:
    planner = Planner(SCENE)
    path = plan(planner, (2, 2, 0), (6, 2, 0))
    assert isinstance(path, cfree.Path)
    middle = path.poses[len(path.poses) // 2]
    beside = [box(middle.x - Fraction(1, 4), middle.y - Fraction(1, 4), width, Fraction(1, 2)) for width in (0.5, 2)]
    for block in (*beside, box("5.25", -3, "0.5", 12)):  # the last one shuts the way
        moved = SCENE.with_obstacle(block)
        assert not path.is_free(cfree.MotionChecker(moved))
        answer = plan(planner.updated(moved), (2, 2, 0), (6, 2, 0))
        assert_right(answer, moved)
        assert type(answer) is type(plan(Planner(moved), (2, 2, 0), (6, 2, 0)))


def test_the_old_planner_stays_usable() -> None:
    planner = Planner(SCENE)
    before = plan(planner, (2, 2, 0), (6, 2, 0))
    updated = planner.updated(SCENE.with_obstacle(box(2, 5, 1, 1)))
    plan(updated, (2, 2, 0), (6, 2, 0))
    assert plan(planner, (2, 2, 0), (6, 2, 0)) == before
    assert_right(plan(planner, (2, 3, 0), (6, 3, 0)), SCENE)


def test_settings_stay() -> None:
    planner = Planner(SCENE, max_seconds=50, vehicle=cfree.DifferentialDrive())
    updated = planner.updated(SCENE.moved(0, (-1, 0, 0)))
    assert (updated.max_seconds, updated.vehicle, updated.space) == (50, planner.vehicle, None)
    planner.stop.set()
    assert not updated.stop.is_set()


# proofs


def test_a_proof_far_from_the_change_is_not_proved_again() -> None:
    planner = Planner(SHUT)
    assert isinstance(plan(planner, INSIDE, OUTSIDE), cfree.Separated)
    for change in (
        SHUT.moved(1, (0, 3, 0)),
        SHUT.without_obstacle(1),
        SHUT.with_obstacle(box(120, 0, 1, 1)),
        Scene(BAR, SHUT.obstacles[::-1]),
    ):
        updated = planner.updated(change)
        proof = plan(updated, INSIDE, OUTSIDE)
        assert isinstance(proof, cfree.Separated)
        assert_right(proof, change)
        assert proof.obstacles == (list(change.obstacles).index(RING),)
        spent = [trimmed(x, INSIDE, OUTSIDE) for x in (Planner(change), taken_from(planner, change))]
        assert spent[0] > 50
        assert spent[1] == 0


def taken_from(planner: Planner, scene: Scene) -> Planner:
    """Return the updated planner of one that has computed the surfaces of the robot itself."""
    trimmed(planner, INSIDE, OUTSIDE)
    return planner.updated(scene)


def test_a_proof_near_the_change_is_proved_again() -> None:
    planner = Planner(SHUT)
    assert isinstance(plan(planner, INSIDE, OUTSIDE), cfree.Separated)
    outer, inner = [(50, 0), (70, 0), (70, 20), (50, 20)], [(52, 18), (68, 18), (68, 2), (52, 2)]
    door = cfree.Polygon([*outer, (50, 12), (52, 12), *inner, (52, 8), (50, 8)])
    opened = Scene(BAR, [door, *SHUT.obstacles[1:]])
    answer = plan(planner.updated(opened), INSIDE, OUTSIDE)
    assert isinstance(answer, cfree.Path)
    assert_right(answer, opened)
    assert_right(plan(planner.updated(opened).updated(SHUT), INSIDE, OUTSIDE), SHUT)


def test_the_free_space_takes_that_of_the_old_planner() -> None:
    scene = Scene(BAR, [*[box(10 * x, 10 * y, 3, 2 + x) for x in range(4) for y in range(3)], RING])
    planner = Planner(scene)
    assert planner.free_space.boundary.kept_patches == 0
    moved = scene.moved(0, (1, 0, 0))
    space = planner.updated(moved).free_space
    assert space.boundary.kept_patches > 0
    anew = cfree.free_space(cfree.boundary(moved))
    assert space.component.tobytes() == anew.component.tobytes()
    again = planner.updated(moved).updated(moved.moved(1, (1, 0, 0))).free_space  # over one that computed nothing
    assert again.boundary.kept_patches > 0


# limits


def test_round_shapes_share_nothing() -> None:
    disc = cfree.Curved.circle((8, 8), 1)
    planner = Planner(SCENE)
    plan(planner, (2, 2, 0), (6, 2, 0))
    assert planner.updated(SCENE.with_obstacle(disc)).scene.curved


def test_another_robot_shares_nothing() -> None:
    planner = Planner(SCENE)
    plan(planner, (2, 2, 0), (6, 2, 0))
    other = Scene(box(0, 0, 1, 1), WALLS, workspace=ROOM)
    assert_right(plan(planner.updated(other), (2, 2, 0), (6, 2, 0)), other)


def test_updated_takes_a_scene() -> None:
    with pytest.raises(TypeError, match=r"scene: .* give a Scene"):
        Planner(SCENE).updated(BAR)  # type: ignore[arg-type]


@pytest.mark.slow
def test_a_query_in_another_thread_is_waited_for() -> None:
    scene = cfree.load_scene(ROOT / "examples" / "scenes" / "nest_swim.json")
    planner, answers = Planner(scene), []
    thread = threading.Thread(target=lambda: answers.append(plan(planner, scene.start, scene.goal)))
    thread.start()
    time.sleep(0.05)
    moved = scene.moved(0, (0, 0, 0))
    answer = plan(planner.updated(moved), scene.start, scene.goal)
    thread.join()
    assert type(answer) is type(answers[0])


# properties


def place(generator: random.Random, size: int) -> Fraction:
    return Fraction(generator.randint(-4, 4 * size), 4)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(25))
def test_answers_after_random_changes_are_those_of_new_planners(seed: int) -> None:
    generator = random.Random(5000 + seed)
    scene, size, digits = random_scene(generator)
    planner = Planner(scene)
    for step in range(5):
        ends = [(place(generator, size), place(generator, size), generator.choice([0, "90deg", 1])) for _ in range(2)]
        if generator.random() < 0.3:
            planner.free_space  # noqa: B018
        try:
            fresh = plan(Planner(scene), *ends)
        except CfreeError as error:
            with pytest.raises(type(error)):
                plan(planner, *ends)
        else:
            answer = plan(planner, *ends)
            assert type(answer) is type(fresh)
            assert getattr(answer, "of", None) == getattr(fresh, "of", None)
            if step % 2:
                assert_right(answer, scene)
        scene = changed(generator, scene, size, digits)
        planner = planner.updated(scene)
