"""Routes in folders: rooms and portals are files, made by tasks, whole or not there; folders without them are read."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cfree
from cfree.distributed import Sharded, boundary, planning, portals
from cfree.distributed.division import Features
from cfree.distributed.planning import Surroundings, plan_among
from cfree.distributed.portals import StoredAtlas, atlas_of
from cfree.errors import FormatError
from cfree.exact.pose import Pose
from cfree.planning import pose_planner
from cfree.planning.atlas import LazyAtlas
from cfree.planning.rooms import divided
from cfree.planning.routes import Router
from stones import ROBOT, ROUND_ROBOT, pebbles, stones

STONES = cfree.Scene(ROBOT, stones(9))
COURT = cfree.Curved([(-40, 0), (-20, 0), (-20, 20), (-40, 20)], [[(-38, 2), (-38, 18), (-22, 18), (-22, 2)]], grown=1)
PEBBLES = cfree.Scene(ROUND_ROBOT, [*pebbles(9), COURT])
START, GOAL = (-3, -3, 0), (95, 95, "90deg")
EDGES = 12  # in a room


@pytest.fixture(scope="module")
def small_rooms() -> Iterator[None]:
    """Rooms have few edges, and there are two files of portals or more."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(portals, "divided", lambda edges, radius, bounds: divided(edges, radius, bounds, EDGES))
        patch.setattr(portals, "GROUP", 8)
        yield


@pytest.fixture(scope="module")
def town(tmp_path_factory: pytest.TempPathFactory, small_rooms: None) -> Sharded:
    return boundary(STONES, folder=tmp_path_factory.mktemp("routes") / "town", tiles=3)


@pytest.fixture(scope="module")
def round_town(tmp_path_factory: pytest.TempPathFactory, small_rooms: None) -> Sharded:
    return boundary(PEBBLES, folder=tmp_path_factory.mktemp("routes") / "round", tiles=3)


def atlas(found: Sharded) -> Any:
    return atlas_of(str(found.folder), found.work.stamp)


def copied(found: Sharded, folder: Path) -> Sharded:
    shutil.copytree(found.folder, folder)
    return Sharded(folder)


def test_a_path_follows_the_portals_of_the_folder(town: Sharded, monkeypatch: pytest.MonkeyPatch) -> None:
    assert isinstance(atlas(town), StoredAtlas) and len([*(town.folder / "portals").iterdir()]) > 1
    monkeypatch.setattr(planning, "plan_around", None)  # not needed
    path = town.plan(START, GOAL, improve=0)
    assert isinstance(path, cfree.Path) and path.goal == Pose(*GOAL) and town.tiles_read == 3
    assert path.is_free(cfree.MotionChecker(STONES))
    assert cfree.verify.answer(*town.scene_for(path)).verified


def test_portals_in_files_are_those_found_on_the_way(town: Sharded) -> None:
    stored = atlas(town)
    lazy = LazyAtlas(stored.ground, stored.rooms)
    for room in range(len(stored.rooms)):
        assert stored.entry(room).portals == lazy.entry(room).portals


def test_an_old_folder_without_portals_is_read_and_gets_them_by_the_same_command(town: Sharded, tmp_path: Path) -> None:
    old = copied(town, tmp_path / "old")
    shutil.rmtree(old.folder / "portals")
    (old.folder / "rooms.npz").unlink()
    assert isinstance(atlas(old), LazyAtlas)
    assert old.plan(START, GOAL, improve=0).goal == Pose(*GOAL)
    again = boundary(STONES, folder=old.folder, tiles=3)
    for path in (town.folder / "portals").iterdir():
        assert (old.folder / "portals" / path.name).read_bytes() == path.read_bytes()
    assert again.digest == town.digest


def test_portals_that_were_not_made_before_ctrl_c_are_made_in_memory(town: Sharded, tmp_path: Path) -> None:
    left = copied(town, tmp_path / "left")
    for path in sorted((left.folder / "portals").iterdir())[1:]:
        path.unlink()
    path = left.plan(START, GOAL, improve=0)
    assert path.motions == town.plan(START, GOAL, improve=0).motions


def test_damaged_portals_are_named_and_mended(town: Sharded, tmp_path: Path) -> None:
    damaged = copied(town, tmp_path / "damaged")
    file = min((damaged.folder / "portals").iterdir())
    sound = file.read_bytes()
    file.write_bytes(sound[: len(sound) // 2])
    with pytest.raises(FormatError, match=f"{file.name}: damaged"):
        damaged.plan(START, GOAL, improve=0)
    boundary(STONES, folder=damaged.folder, tiles=3)
    assert file.read_bytes() == sound


def test_ctrl_c_leaves_no_half_file_of_portals(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*_: Any) -> Any:
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(portals, "parts_of", interrupt)
        with pytest.raises(KeyboardInterrupt):
            boundary(STONES, folder=tmp_path / "town", tiles=1)
    assert not (tmp_path / "town" / "portals").exists() and Sharded(tmp_path / "town").tiles == 1
    boundary(STONES, folder=tmp_path / "town", tiles=1)
    assert (tmp_path / "town" / "portals" / "000000.npz").exists()


def test_no_plan_is_made_twice(town: Sharded, monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[Any] = []
    plain = pose_planner.PosePlanner.way

    def counted(self: Any, *arguments: Any, **named: Any) -> Any:
        calls.append(self.scene)
        return plain(self, *arguments, **named)

    monkeypatch.setattr(pose_planner.PosePlanner, "way", counted)
    for improve in (0.0, None):
        calls.clear()
        assert isinstance(town.plan((-3, -3, 0), (6, -3, 0), improve=improve), cfree.Path)
        assert len({len(scene.obstacles) for scene in calls}) == len(calls)


def test_a_vehicle_drives_along_a_route(town: Sharded) -> None:
    path = town.plan(START, GOAL, improve=0, vehicle=cfree.Car(1))
    assert isinstance(path, cfree.Path) and path.vehicle == cfree.Car(1) and path.goal == Pose(*GOAL)
    assert path.is_free(cfree.MotionChecker(STONES))


def test_a_path_among_round_shapes_follows_the_portals(
    round_town: Sharded, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stored = atlas(round_town)
    lazy = LazyAtlas(stored.ground, stored.rooms)
    for room in range(len(stored.rooms)):
        assert stored.entry(room).portals == lazy.entry(room).portals
    monkeypatch.setattr(planning, "_plan_around_rounds", None)  # not needed
    for improve in (0, 0.1):
        path = round_town.plan(START, GOAL, improve=improve)
        assert isinstance(path, cfree.Path) and path.goal == Pose(*GOAL) and round_town.tiles_read == 3
        assert path.is_free(cfree.MotionChecker(PEBBLES)) and path.curved is not None
        assert cfree.verify.answer(*round_town.scene_for(path)).verified
    cfree.save(path, tmp_path / "way.json")
    assert cfree.verify.answer(PEBBLES, tmp_path / "way.json").verified
    with pytest.raises(cfree.InvalidPoseError, match=r"goal .* overlaps obstacle 80"):
        round_town.plan(START, (80, 80, 0))


@pytest.mark.slow
def test_a_vehicle_drives_along_a_route_among_round_shapes(round_town: Sharded) -> None:
    path = round_town.plan(START, GOAL, improve=0, vehicle=cfree.Car(1))
    assert isinstance(path, cfree.Path) and path.vehicle == cfree.Car(1) and path.goal == Pose(*GOAL)
    assert path.is_free(cfree.MotionChecker(PEBBLES))


def test_a_route_into_a_round_court_ends_with_a_proof(round_town: Sharded, tmp_path: Path) -> None:
    proof = round_town.plan((90, 0, 0), (-30, 10, 0))
    assert isinstance(proof, cfree.Separated) and proof.whole is not None and 81 in proof.whole.obstacles
    assert cfree.verify.answer(*round_town.scene_for(proof)).verified
    cfree.save(proof, tmp_path / "proof.json")
    assert cfree.verify.answer(PEBBLES, tmp_path / "proof.json").verified


def test_many_questions_follow_routes(town: Sharded) -> None:
    there, back = town.plan_many([(START, GOAL), (GOAL, START)], improve=0)
    assert isinstance(there, cfree.Path) and isinstance(back, cfree.Path)
    assert there.goal == back.start == Pose(*GOAL)


@pytest.mark.slow
@pytest.mark.parametrize("most", [4, 10, 30])
def test_answers_are_those_without_portals_for_ends_on_borders_and_in_corners(town: Sharded, most: int) -> None:
    features, ground = Features(town.work.store), portals.StoredGround(town.work)
    rooms = divided(features.boxes(features.numbers), ground.radius / 2, None, most)
    checker = cfree.PoseChecker(STONES)
    places = [(x, y) for x, y, _, top in rooms.boxes.tolist() for y in (y, (y + top) / 2)]
    ends = [Pose(x, y) for x, y in places if checker.is_free((x, y, 0))]
    rng = np.random.default_rng(46)
    for _ in range(3):
        start, goal = (ends[k] for k in rng.integers(0, len(ends), 2))
        known = Surroundings(town.work)
        known.__dict__["atlas"] = LazyAtlas(ground, rooms)
        answer = plan_among(known, start, goal, improve=0.0)
        assert isinstance(answer, cfree.Path) == isinstance(cfree.plan(STONES, start, goal, improve=0), cfree.Path)
        assert cfree.verify.answer(*town.scene_for(answer)).verified


def test_a_chamber_that_is_left_only_through_a_neighbour_and_back(tmp_path: Path) -> None:
    """A wall parts the room of start and goal; the way around it is in the room next to it."""
    wall = [(0, -20), (1, -20), (1, 30), (0, 30)]
    beyond = [[(x, y), (x + 2, y), (x, y + 2)] for x in (-12, 12) for y in range(-18, 60, 6)]
    scene = cfree.Scene(ROBOT, [wall, *beyond], bounds=(-20, -20, 20, 60))
    found = boundary(scene, folder=tmp_path / "wall", tiles=2)
    start, goal = Pose(-5, -15), Pose(5, -15)
    rooms = divided(Features(found.work.store).boxes(np.arange(found.vertices)), 0.5, scene.bounds, 20)
    ground = portals.StoredGround(found.work)
    router = Router(LazyAtlas(ground, rooms), start, goal, cfree.planning.options.Options(improve=0.0))
    legs = router.legs(lambda: None)
    assert len(rooms) > 3 and legs is not None
    path = cfree.Path(start, [motion for leg in legs for motion in leg.motions])
    assert (
        path.goal == goal
        and max(float(pose.y) for pose in path.poses) > 28
        and path.is_free(cfree.MotionChecker(scene))
    )
