"""Folders that are continued, damaged, of something else; sources of many files; questions to folders."""

from __future__ import annotations

import json
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from click.testing import CliRunner

import cfree
from cfree import Pose
from cfree.cli.app import app
from cfree.distributed import Sharded, boundary, reading
from cfree.distributed.tasks import Work
from cfree.errors import FormatError
from cfree.formats.drawings.geojson import geojson_shapes
from stones import ROBOT, ROUND_ROBOT, SCENE, pebbles, stones


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Sharded:
    return boundary(SCENE, folder=tmp_path_factory.mktemp("shards") / "city", tiles=6)


class Ended(Exception):
    """What a user, or a crash, does."""


@pytest.mark.slow
@pytest.mark.parametrize("stage", ["read", "trim", "glue", "join", "nest"])
def test_what_was_ended_goes_on(stage: str, made: Sharded, tmp_path: Path) -> None:
    def stop(at: str, done: int, of: int) -> None:
        if at == stage and (done or of < 2):
            raise Ended

    with pytest.raises(Ended):
        boundary(SCENE, folder=tmp_path / "x", tiles=6, progress=stop)
    with pytest.raises(FormatError, match="not finished"):
        Sharded(tmp_path / "x")
    before = {path: path.stat().st_mtime_ns for path in (tmp_path / "x").rglob("*.npz")}
    found = boundary(SCENE, folder=tmp_path / "x", tiles=6)
    assert found == made
    assert all(path.stat().st_mtime_ns == time for path, time in before.items())


@pytest.mark.slow
def test_damaged_shards_are_found_and_made_again(made: Sharded, tmp_path: Path) -> None:
    found = boundary(SCENE, folder=tmp_path / "x", tiles=6)
    path = Work(found.folder).path("trim", 2)
    data = bytearray(path.read_bytes())
    middle = len(data) // 2
    data[middle : middle + 64] = bytes(64)
    path.write_bytes(bytes(data))
    result = found.verify(sample=1)
    assert not result.verified and "tile 2" in str(result) and "damaged" in str(result)
    for name in ("manifest.json", "glue"):
        place = found.folder / name
        for file in place.iterdir() if place.is_dir() else [place]:
            file.unlink()
    assert boundary(SCENE, folder=tmp_path / "x", tiles=6) == made


def test_a_folder_of_something_else_is_refused(made: Sharded, tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="another scene"):
        boundary(cfree.Scene(ROBOT, stones(2)), folder=made.folder, tiles=6)
    with pytest.raises(FormatError, match="of other tiles"):
        boundary(SCENE, folder=made.folder, tiles=5)
    (tmp_path / "mine.txt").write_text("do not touch")
    with pytest.raises(FormatError, match="not empty"):
        boundary(SCENE, folder=tmp_path)
    with pytest.raises(FormatError, match="no boundary"):
        Sharded(tmp_path)
    with pytest.raises(TypeError, match=r"give a distributed\.Client"):
        boundary(SCENE, folder=tmp_path, client="tcp://localhost")


@pytest.mark.slow
def test_obstacles_come_from_many_files(made: Sharded, tmp_path: Path) -> None:
    head = cfree.Scene(ROBOT, bounds=SCENE.bounds, start=SCENE.start, goal=SCENE.goal)
    cfree.save(head, tmp_path / "head.json")
    shapes = [
        {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [[*ring, ring[0]]]}}
        for ring in stones(4)
    ]
    (tmp_path / "tiles").mkdir()
    (tmp_path / "tiles" / "a.geojsonl").write_text("".join(json.dumps(shape) + "\n" for shape in shapes[:10]))
    (tmp_path / "tiles" / "b.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": shapes[10:]}))
    found = boundary([tmp_path / "head.json", tmp_path / "tiles"], folder=tmp_path / "x", tiles=3)
    assert (found.digest, len(found.cells)) == (made.digest, len(made.cells))
    with (tmp_path / "tiles" / "a.geojsonl").open("a") as file:
        file.write('{"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [1, "x"]]]}}\n')
    with pytest.raises(FormatError, match=r"a\.geojsonl:11:"):
        boundary([tmp_path / "head.json", tmp_path / "tiles"], folder=tmp_path / "y")


def test_obstacles_come_from_geoparquet(made: Sharded, tmp_path: Path) -> None:
    pyarrow = pytest.importorskip("pyarrow", reason="pyarrow is not installed: GeoParquet was not read")
    parquet = pytest.importorskip("pyarrow.parquet")
    head = cfree.Scene(ROBOT, bounds=SCENE.bounds, start=SCENE.start, goal=SCENE.goal)
    cfree.save(head, tmp_path / "head.json")

    def read(name: str, **columns: list[Any]) -> Sharded:
        parquet.write_table(pyarrow.table(columns), tmp_path / f"{name}.parquet", row_group_size=5)
        return boundary([tmp_path / "head.json", tmp_path / f"{name}.parquet"], folder=tmp_path / name, tiles=3)

    shapes = [shapely.to_wkb(shapely.Polygon(ring)) for ring in stones(4)]
    assert read("stones", geometry=[*shapes, None]).digest == made.digest
    for name, columns, said in (
        ("broken", {"geometry": [shapes[0], b"xx"]}, "row 2: "),
        ("points", {"geometry": [shapely.to_wkb(shapely.Point(1, 2))]}, "row 1: a Point; give polygons"),
        ("none", {"shape": [b""]}, 'no column "geometry" among shape'),
    ):
        with pytest.raises(FormatError, match=said):
            read(name, **columns)
    (tmp_path / "text.parquet").write_text("nonsense")
    with pytest.raises(FormatError, match=r"text\.parquet"):
        boundary([tmp_path / "head.json", tmp_path / "text.parquet"], folder=tmp_path / "text")


def test_plans_read_what_is_near(made: Sharded) -> None:
    answer = made.plan()
    assert isinstance(answer, cfree.Path) and (answer.start, answer.goal) == (SCENE.start, SCENE.goal)
    assert answer.is_free(cfree.MotionChecker(SCENE)) and answer.scene is not None
    assert cfree.verify.answer(made.scene_near(answer), answer).verified
    near = made.plan((-5, -5, 0), (-4, -5, 0))
    assert isinstance(near, cfree.Path) and made.tiles_read < made.tiles
    with pytest.raises(cfree.ForbiddenPoseError, match="goal"):
        made.plan((-5, -5, 0), (1, 1, 0))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(6))
def test_verdicts_are_those_of_the_whole_scene(seed: int, tmp_path: Path) -> None:
    """Courtyards with and without doors, in which there are stones."""
    rng = random.Random(seed)

    def court(x: int, y: int) -> list[tuple[int, int]]:
        door = rng.choice([0, 1, 3])
        return [
            (x, y), (x + 20, y), (x + 20, y + 20), (x, y + 20), (x, y + 8 + door), (x + 1, y + 8 + door),
            (x + 1, y + 19), (x + 19, y + 19), (x + 19, y + 1), (x + 1, y + 1), (x + 1, y + 8), (x, y + 8),
        ] if door else [(x, y), (x + 20, y), (x + 20, y + 1), (x, y + 1)]  # fmt: skip

    courts = [court(26 * i, 26 * j) for i in range(3) for j in range(3)]
    scene = cfree.Scene(ROBOT, courts, bounds=(-9, -9, 90, 90))
    found = boundary(scene, folder=tmp_path / "x", tiles=8)
    for _ in range(4):
        ends = [Pose(26 * rng.randrange(3) + 6, 26 * rng.randrange(3) + 12) for _ in range(2)]
        here, there = found.plan(*ends, improve=0), cfree.plan(scene, *ends, improve=0)
        assert type(here) is type(there)
        if isinstance(here, cfree.Path):
            assert here.is_free(cfree.MotionChecker(scene))
        else:
            assert here.scene is not None and cfree.verify.answer(here.scene, here).verified


def test_many_questions_have_the_same_answers(made: Sharded) -> None:
    poses = cfree.Poses(np.random.default_rng(1).uniform(-9, 49, (500, 2)), np.linspace(0, 6, 500))
    assert np.array_equal(made.is_free(poses), cfree.is_free(SCENE, poses))
    queries = [((-5, -5, 0), (45, 45, 0)), ((-5, -5, 0), (45, -5, 1))]
    answers = made.plan_many(queries, improve=0)
    assert [type(answer) for answer in answers] == [cfree.Path, cfree.Path]
    assert [answer.start.x for answer in answers] == [-5, -5]


def test_poses_are_located_where_tiles_are_needed(made: Sharded) -> None:
    """Some poses need the tile they are in alone; exact fits are in no cell."""
    assert made.locate((45, 45, 0)) == 0 and 0 < made.tiles_read < made.tiles
    assert made.locate(Pose(1, 1)) == -1 and made.tiles_read == 0
    assert made.locate([]).shape == (0,)


@pytest.mark.slow
def test_a_pose_that_fits_exactly_is_in_no_cell(tmp_path: Path) -> None:
    """A square in a hole of its size, one that touches a corner of a room, and one in the middle of it."""
    square, block = [(0, 0), (2, 0), (2, 2), (0, 2)], [(10, 0), (20, 0), (20, 9), (10, 9)]
    hole = cfree.Polygon(block, [[(12, 3), (12, 5), (14, 5), (14, 3)]])
    floor = [(-9, -9), (30, -9), (30, -8), (-9, -8)]
    scene = cfree.Scene(square, [hole, floor], workspace=[(-9, -9), (30, -9), (30, 20), (-9, 20)])
    space = cfree.free_space(cfree.boundary(scene))
    poses = [Pose(12, 3), Pose(14, 5, "180deg"), Pose(-9, 18), Pose(0, 5), Pose(12, 3, "1deg"), Pose(8, 0), Pose(8, 9)]
    for tiles in (1, 4):
        found = boundary(scene, folder=tmp_path / str(tiles), tiles=tiles)
        cells = found.locate(poses).tolist()
        assert cells == space.locate(poses).tolist() == [-2, -2, 0, 0, -1, 0, 0]


@pytest.mark.slow
def test_shards_are_verified(made: Sharded, tmp_path: Path) -> None:
    result = made.verify()
    assert result.verified and all(check.how != "SKIPPED" for check in result.checks)
    sampled = made.verify(sample=3)
    assert sampled.verified and "SAMPLED" in str(sampled)


@pytest.mark.slow
def test_the_command_makes_asks_and_checks_folders(tmp_path: Path) -> None:
    def run(*words: Any) -> Any:
        return CliRunner().invoke(app, [str(word) for word in words])

    cfree.save(SCENE, tmp_path / "scene.json")
    folder, way, part = tmp_path / "city", tmp_path / "way.json", tmp_path / "part.json"
    made = run("boundary", tmp_path / "scene.json", "--folder", folder, "--tiles", 4, "--json")
    assert made.exit_code == 0, made.output
    assert json.loads(made.output)["tiles"] == 4
    planned = run("plan", folder, "-o", way, "--part", part)
    assert planned.exit_code == 0 and "tiles read" in planned.output, planned.output
    assert run("verify", part, way).exit_code == 0
    assert run("verify", folder, way).exit_code == 0
    assert run("verify", folder, "--sample", 2).exit_code == 0
    for words, said in (
        (("boundary", tmp_path / "scene.json", "--tiles", 3), "need --folder"),
        (("boundary", tmp_path / "scene.json", "--folder", folder, "-o", way), "--output: not with --folder"),
        (("plan", folder, "--clearance", 1), "--clearance"),
        (("plan", tmp_path), "no boundary"),
        (("verify", folder, part), "no path"),
    ):
        refused = run(*words)
        assert refused.exit_code == 2 and said in refused.output, refused.output


def test_the_command_answers_in_folders_of_round_shapes(tmp_path: Path) -> None:
    """Paths are among the shapes themselves; a proof has polygons for them, whose obstacles are those of the scene."""

    def run(*words: Any) -> Any:
        return CliRunner().invoke(app, [str(word) for word in words])

    court = cfree.Curved([(-9, 0), (-1, 0), (-1, 8), (-9, 8)], [[(-8, 1), (-8, 7), (-2, 7), (-2, 1)]], grown="1/4")
    scene = cfree.Scene(ROUND_ROBOT, [*pebbles(2), court], start=(-12, -3, 0))
    cfree.save(scene, tmp_path / "scene.json")
    folder, answer, part = tmp_path / "city", tmp_path / "answer.json", tmp_path / "part.json"
    assert run("boundary", tmp_path / "scene.json", "--folder", folder).exit_code == 0
    for goal, code in (("18,18,0", 0), ("-6,3,0", 1)):
        planned = run("plan", folder, "--goal", goal, "-o", answer, "--part", part)
        assert planned.exit_code == code, planned.output
        for where in (folder, tmp_path / "scene.json", part):
            assert run("verify", where, answer).exit_code == 0
    assert "blocking obstacles  obstacle 4, 8.5 x 8.5 at (-5, 4)" in planned.output


def test_a_polygon_larger_than_memory_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(findings: Any, value: Any) -> Any:
        if "9" in findings.text:
            raise MemoryError
        return geojson_shapes(findings, value)

    monkeypatch.setattr(reading, "geojson_shapes", full)
    triangle = '{"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [0, %d], [0, 0]]]}\n'
    (tmp_path / "city.geojsonl").write_text(triangle % 1 + triangle % 9)
    (tmp_path / "robot.json").write_text('{"robot": {"outer": [[0, 0], [1, 0], [0, 1]]}, "obstacles": []}')
    with pytest.raises(FormatError, match=r"city.geojsonl: line 2: too large for memory"):
        boundary([tmp_path / "robot.json", tmp_path / "city.geojsonl"], folder=tmp_path / "folder")
