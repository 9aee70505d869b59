"""Answers of folders verify in the scene that a folder was made from, in the folder, and among their own obstacles."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

import cfree
from cfree.cli.app import app
from cfree.collision.slide import Slide
from cfree.distributed import boundary
from cfree.paths.numbering import renumbered
from cfree.scene.digest import Whole, stamp_of
from second_opinion import check_answer
from stones import SCENE as STONES
from stones import stones

BOX = [(0, 0), (2, 0), (2, 2), (0, 2)]
COURT = [(0, 0), (30, 0), (30, 30), (0, 30), (0, 12), (1, 12), (1, 29), (29, 29), (29, 1), (1, 1), (1, 11), (0, 11)]
FAR = [[(60 + 10 * k, 0), (64 + 10 * k, 0), (64 + 10 * k, 4), (60 + 10 * k, 4)] for k in range(6)]
SHUT = cfree.Scene(BOX, [*FAR[:3], COURT, *FAR[3:]], start=(10, 10, 0), goal=(-10, 10, 0))
ROOM = cfree.Scene(BOX, [*FAR[:3], COURT, *FAR[3:]], workspace=[(-50, -50), (200, -50), (200, 50), (-50, 50)],
                   bounds=(-40, -40, 190, 40), start=(10, 10, 0), goal=(-10, 10, 0))  # fmt: skip
SCENES = {"path": STONES, "shut": SHUT, "room": ROOM}


@pytest.fixture(scope="module", params=SCENES)
def answered(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Any:
    scene, folder = SCENES[request.param], tmp_path_factory.mktemp("answers")
    cfree.save(scene, folder / "scene.json")
    found = boundary(scene, folder=folder / "city", tiles=4)
    answer = found.plan(improve=0.0)
    assert answer.scene is not None
    cfree.save(answer, folder / "answer.json")
    cfree.save(answer.scene, folder / "part.json")
    return scene, found, answer


def run(*words: Any) -> Any:
    return CliRunner().invoke(app, [str(word) for word in words])


def test_an_answer_of_a_folder_verifies_in_its_scene_its_folder_and_its_part(answered: Any) -> None:
    scene, found, answer = answered
    folder = found.folder.parent
    for place in ("scene.json", "city", "part.json"):
        result = run("verify", folder / place, folder / "answer.json")
        assert result.exit_code == 0, result.output
    for place in ("scene.json", "part.json"):
        code, said = check_answer.verdict((folder / place).read_text(), (folder / "answer.json").read_text())
        assert code == 0, said
    for given in (answer, cfree.load(folder / "answer.json")):
        assert cfree.verify.answer(scene, given).verified
        assert cfree.verify.answer(*found.scene_for(given)).verified
    assert cfree.load(folder / "answer.json") == answer
    assert cfree.load(folder / "answer.json").whole == answer.whole


def test_an_answer_of_a_folder_says_which_obstacles_it_is_about(answered: Any) -> None:
    scene, found, answer = answered
    assert (
        answer.whole == Whole(stamp_of(scene).sha256, answer.whole.obstacles)
        and found.scene_sha256 == answer.whole.sha256
    )
    assert [scene.obstacles[k] for k in answer.whole.obstacles] == list(answer.scene.obstacles)
    assert len(answer.whole.obstacles) < len(scene.obstacles)


def test_an_answer_of_another_folder_is_refuted(answered: Any, tmp_path: Path) -> None:
    _, found, _ = answered
    other = cfree.Scene(BOX, stones(2))
    cfree.save(other, tmp_path / "other.json")
    boundary(other, folder=tmp_path / "city")
    for place in ("other.json", "city"):
        result = run("verify", tmp_path / place, found.folder.parent / "answer.json")
        assert result.exit_code == 1 and "another scene" in result.output, result.output


def test_a_proof_whose_obstacles_are_said_to_be_others_is_refuted(answered: Any, tmp_path: Path) -> None:
    scene, found, _ = answered
    file = found.folder.parent / "answer.json"
    for numbers in ([0], [1, 2], [*range(len(scene.obstacles))], [len(scene.obstacles)], [10**9]):
        data = json.loads(file.read_text())
        data["whole"]["obstacles"] = numbers
        (tmp_path / "wrong.json").write_text(json.dumps(data))
        result = run("verify", found.folder.parent / "scene.json", tmp_path / "wrong.json")
        assert result.exit_code == 1 and "its obstacles are not those" in result.output, result.output
        texts = (path.read_text() for path in (found.folder.parent / "scene.json", tmp_path / "wrong.json"))
        assert check_answer.verdict(*texts)[0] == 1


@pytest.mark.parametrize("wrong", [[1, 0], [0, 0], [-1], ["0"], [0.5], 3, None])
def test_obstacles_of_the_whole_scene_are_increasing_numbers(wrong: Any, answered: Any, tmp_path: Path) -> None:
    _, found, _ = answered
    data = json.loads((found.folder.parent / "answer.json").read_text())
    data["whole"]["obstacles"] = wrong
    (tmp_path / "wrong.json").write_text(json.dumps(data))
    result = run("verify", found.folder.parent / "scene.json", tmp_path / "wrong.json")
    assert result.exit_code == 2 and "Traceback" not in result.output


def test_a_path_is_checked_among_all_obstacles_and_not_only_its_own() -> None:
    """One that an obstacle blocks of which it does not speak."""
    scene = cfree.Scene(BOX, [[(10, 0), (12, 0), (12, 9)], [(0, 20), (2, 20), (2, 29)]])
    path = cfree.Path((0, 0, 0), [cfree.Translation((20, 0))], whole=Whole(stamp_of(scene).sha256, (1,)))
    assert cfree.verify.answer(cfree.Scene(BOX, scene.obstacles[1:]), path).verified
    assert not cfree.verify.answer(scene, path).verified


def test_slides_of_a_folder_keep_contacts_with_the_obstacles_of_the_whole_scene() -> None:
    """A ladder slides down between floor and wall, which have other numbers among all obstacles."""
    touch = cfree.collision.Touch("vertex-edge", (0, 0), (0, 2)), cfree.collision.Touch("vertex-edge", (0, 1), (1, 1))
    ladder = Slide(touch, [0, 0, 2], [0, 2], [1, 0, 1], 1)
    path = cfree.Path((0, 0, 0), [ladder])
    moved = renumbered(path, [4, 9])
    assert [contact.obstacle for contact in moved.motions[0].contacts] == [(4, 2), (9, 1)]
    assert moved.goal == path.goal


def test_a_separation_that_names_no_obstacles_of_a_folder_is_refused(tmp_path: Path) -> None:
    found = boundary(SHUT, folder=tmp_path / "city")
    with pytest.raises(ValueError, match="a proof that names no obstacles of a folder"):
        found.scene_for(replace(found.plan(improve=0.0), whole=None))


@pytest.mark.slow
@pytest.mark.parametrize("goal", [(0, 12, 0), (-30, 12, 0)])
@pytest.mark.parametrize("is_held", [True, False])
def test_the_vehicle_of_a_scene_drives_in_its_folder_or_is_stuck_there(
    is_held: bool, goal: tuple[int, int, int], tmp_path: Path
) -> None:
    touched = [[(2, -1), (3, -1), (3, 1), (2, 1)], [(-3, -1), (-2, -1), (-2, 1), (-3, 1)]][: 2 if is_held else 1]
    robot, car = [(-2, -1), (2, -1), (2, 1), (-2, 1)], cfree.Car(4, axle=(-1, 0))
    scene = cfree.Scene(robot, [*FAR[:4], *touched, *FAR[4:]], start=(0, 0, 0), goal=goal, vehicle=car)
    answer = boundary(scene, folder=tmp_path / "city", tiles=4).plan(improve=0.0)
    assert isinstance(answer, cfree.Stuck if is_held else cfree.Path) and answer.vehicle == car
    assert answer.scene is not None and answer.whole is not None
    cfree.save(scene, tmp_path / "scene.json")
    cfree.save(answer, tmp_path / "answer.json")
    cfree.save(answer.scene, tmp_path / "part.json")
    for place in ("scene.json", "city", "part.json"):
        result = run("verify", tmp_path / place, tmp_path / "answer.json")
        assert result.exit_code == 0, result.output
        if place != "city":
            files = [(tmp_path / name).read_text() for name in (place, "answer.json")]
            assert check_answer.verdict(*files)[0] == 0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("vehicle", "words"),
    [
        (cfree.Car(4, axle=(-1, 0)), ["car", "--turning-radius", "4", "--axle", "-1,0"]),
        (cfree.DifferentialDrive(), ["differential"]),
    ],
)
def test_any_vehicle_drives_in_a_folder_as_in_its_scene(vehicle: Any, words: list[str], tmp_path: Path) -> None:
    posts = [[(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)] for x in range(0, 60, 12) for y in (-6, 6)]
    robot = [(-2, -1), (2, -1), (2, 1), (-2, 1)]
    for own in (None, cfree.Car(9)):  # the scene's own vehicle does not matter
        folder = tmp_path / f"city {own}"
        scene = cfree.Scene(robot, posts, start=(-5, 0, 0), goal=(55, 2, "90deg"), vehicle=own)
        answers = [boundary(scene, folder=folder, tiles=4).plan(improve=0.0, vehicle=vehicle)]
        many = cfree.distributed.Sharded(folder).plan_many
        answers += many([(scene.start, scene.goal)], improve=0.0, vehicle=vehicle)
        result = run("plan", folder, "--vehicle", *words, "--improve", "0", "-o", tmp_path / "way.json")
        assert result.exit_code == 0, result.output
        for answer in (*answers, cfree.load(tmp_path / "way.json")):
            assert isinstance(answer, cfree.Path) and answer.vehicle == vehicle
            assert cfree.is_drivable(answer, vehicle) and cfree.verify.answer(scene, answer).verified
    plain = run("plan", folder, "--vehicle", "any", "--improve", "0", "-o", tmp_path / "way.json")
    assert plain.exit_code == 0 and cfree.load(tmp_path / "way.json").vehicle is None


@pytest.mark.slow
def test_a_car_in_a_folder_that_needs_too_many_manoeuvres_has_a_path_among_all_obstacles(tmp_path: Path) -> None:
    posts = [[(x, 3), (x + 1, 3), (x + 1, 4), (x, 4)] for x in range(0, 60, 12)]
    robot, ends = [(-2, -1), (2, -1), (2, 1), (-2, 1)], {"start": (-5, 0, 0), "goal": (55, 2, "90deg")}
    scene = cfree.Scene(robot, posts, bounds=(-20, -20, 80, 20), **ends)
    with pytest.raises(cfree.UndecidedError, match=r"a path of a car .* exists") as caught:
        boundary(scene, folder=tmp_path / "city", tiles=4).plan(improve=0.0, vehicle=cfree.Car("1e12"))
    assert isinstance(caught.value.path, cfree.Path)
    assert caught.value.path.is_free(cfree.MotionChecker(scene))
    with pytest.raises(cfree.UndecidedError, match=r"too long .* give the scene bounds"):
        boundary(cfree.Scene(robot, posts, **ends), folder=tmp_path / "plain").plan(vehicle=cfree.Car("1e12"))
