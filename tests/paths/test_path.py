from __future__ import annotations

import json
import math
import random
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

import numpy as np
import pytest
import shapely
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

import cfree
import strategies
from cfree import save
from cfree.collision.distance import EdgeDistances
from cfree.collision.motion import Rotation, Translation
from cfree.collision.motion_checker import MotionChecker
from cfree.errors import FormatError, UnsupportedError
from cfree.exact.pose import Pose, Poses
from cfree.formats.answers.answer_file import load_answer
from cfree.paths.clearance import clearance, narrowest
from cfree.paths.path import Path
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene
from moving import UNIT_SQUARE as SQUARE
from moving import box, motions, paths, pose_of

poses = st.builds(pose_of, strategies.poses(6))
MOVES = [Translation((2, "1/3")), Rotation((2, 1), "-90deg"), Rotation((0, 0), "180deg")]
WAY = Path(Pose(0, 0), MOVES, "m", "map", SQUARE)


@pytest.mark.slow
@settings(max_examples=100, deadline=None)
@given(paths)
def test_files_hold_paths_exactly(tmp_path_factory: pytest.TempPathFactory, path: Path) -> None:
    file = tmp_path_factory.mktemp("paths") / "way.json"
    save(path, file, scene=SQUARE)
    again = load_answer(file)
    assert again == path and again.poses == path.poses
    text = file.read_text()
    save(again, file)  # it does not know its scene any more, but whose it is
    assert again.scene is None and file.read_text() == text.replace('"free"', '"approximate"')


def test_decimals_alone_are_read_as_well(tmp_path: FilePath) -> None:
    save(WAY, tmp_path / "way.json")
    data = json.loads((tmp_path / "way.json").read_text())
    assert data["answer"] == "path" and data["motions"][0]["vector"] == [2, 1 / 3]
    del data["exact"], data["decimals"]
    for motion in data["motions"]:
        del motion["exact"]
    (tmp_path / "way.json").write_text(json.dumps(data))
    again = load_answer(tmp_path / "way.json")
    assert (again.units, again.frame) == ("m", "map")
    assert float(again.goal.x) == pytest.approx(float(WAY.goal.x), abs=1e-12)
    assert again.motions[1:] == WAY.motions[1:]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"answer": "path"', '"answer": "way"', r'answer: expected "path", "separated", .*, got "way"'),
        ('"type": "rotation"', '"type": "turn"', r'motions\[1\]: expected a motion with "type"'),
        ('"vector": [2.0', '"vectr": [2.0', r'motions\[0\].vectr: unknown key "vectr"; did you mean "vector"\?'),
        ('"tau": "-1"', '"tau": "x"', r'motions\[1\].exact.tau: expected the tangent of half the angle, .*got "x"'),
        ('"tau": "-1"', '"tau": "-1/2"', "the motions do not lead to the exact goal"),
        (
            '"vector": [2.0',
            '"vector": [2.1',
            r"motions\[0\].vector\[0\]: 2.1 beside the exact 2.0 moves the robot by 0.1, .*may by 1e-09",
        ),
        (
            '"pole": [2.0, 1.0]',
            '"pole": [2.0, 1e308]',
            r"motions\[1\].pole\[1\]: 1e308 beside the exact 1.0 moves the robot by 1e\+300",
        ),
        ('"goal": [-1.3333333333333333', '"goal": [-1.3333', r"goal\[0\]: -1.3333 beside the exact -1.33333"),
        ('"start": [0.0, 0.0', '"start": [1e999, 0.0', r"start: a position beyond 1e150"),
        ('"vector": ["2", "1/3"]', '"vector": ["2", "0.333333333333"]', "the motions do not lead to the exact goal"),
        ('"pole": [2.0, 1.0]', '"pole": [2.0]', r"motions\[1\].pole: expected a point \[x, y\], got \[2.0\]"),
        ('"motions": [', '"motions": [7, ', r"motions\[0\]: expected .*got 7"),
        ('"version": 1', '"version": 2', "version: expected version 1"),
        ('"goal"', '"gaol"', "gaol: unknown key"),
    ],
)
def test_faults_of_files_say_place_value_and_remedy(tmp_path: FilePath, old: str, new: str, message: str) -> None:
    file = tmp_path / "way.json"
    save(WAY, file)
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))
    with pytest.raises(FormatError, match=message):
        load_answer(file)


def test_motions_that_miss_the_goal_are_refused(tmp_path: FilePath) -> None:
    file = tmp_path / "way.json"
    move = {"type": "translation", "vector": [1, 0]}
    file.write_text(json.dumps({"answer": "path", "start": [0, 0, 0], "goal": [1, 1, 0], "motions": [move]}))
    with pytest.raises(FormatError, match=r"the motions lead to \[1, 0, 0\] and not to the goal"):
        load_answer(file)


@settings(max_examples=50, deadline=None)
@given(paths, st.floats(0.1, 2), st.floats(0.1, 2))
def test_samples_are_close_together_and_on_the_path(path: Path, step: float, turn: float) -> None:
    samples = path.sample(step, turn)
    moved = np.hypot(*np.diff(samples.xy, axis=0).T)
    assert (moved <= step + 1e-9).all()
    assert moved.sum() <= path.length + 1e-9
    turned = np.abs((np.diff(samples.theta) + np.pi) % math.tau - np.pi)
    assert (turned <= turn + 1e-9).all()
    assert turned.sum() == pytest.approx(path.turning)
    assert np.allclose(samples.xy[-1], [float(path.goal.x), float(path.goal.y)])


def test_a_path_is_a_sequence_of_its_motions() -> None:
    assert (len(WAY), [*WAY], WAY[0], WAY[-1]) == (3, MOVES, MOVES[0], MOVES[2])
    assert MOVES[1] in WAY and [*reversed(WAY)] == MOVES[::-1] and WAY[np.int64(1)] == MOVES[1]
    for index in (3, -4):
        with pytest.raises(IndexError, match=rf"motion {index}: the number of motions is 3; give -3 to 2"):
            WAY[index]
    with pytest.raises(IndexError, match="motion 0: the number of motions is none"):
        Path(Pose(0, 0), [])[0]
    with pytest.raises(TypeError, match="index: '1' is a str"):
        WAY["1"]  # type: ignore[call-overload]


@pytest.mark.parametrize(
    "part", [slice(1, 3), slice(None, -1), slice(2, 2), slice(3, None), slice(2, 1), slice(-9, 99)]
)
def test_a_slice_of_a_path_is_the_part_of_it(part: slice) -> None:
    whole = Path(Pose(1, "1/3", "30deg"), MOVES, "m", "map", SQUARE, clearance=Fraction(1, 9))
    found = whole[part]
    first = part.indices(3)[0]
    assert isinstance(found, Path) and found.motions == whole.motions[part]
    assert found.poses == whole.poses[first : first + len(found) + 1]
    assert (found.units, found.frame, found.scene, found.clearance) == ("m", "map", SQUARE, Fraction(1, 9))
    assert whole[:2].goal == whole[2:].start and whole[:] == whole
    for step in (-1, 2):
        with pytest.raises(ValueError, match=f"step {step}: only motions that follow each other"):
            whole[part.start : part.stop : step]


def test_a_path_is_true_without_motions_as_well() -> None:
    for path in (WAY, WAY[:0], Path(Pose(0, 0), [])):
        assert bool(path) is True and len(path) == len(path.motions)


def test_positions_count_motions() -> None:
    assert [WAY.at(k) for k in range(4)] == list(WAY.poses)
    assert WAY.at("1/2") == Pose(1, "1/6")
    assert Path(Pose(1, 2), []).at(0) == Pose(1, 2)
    with pytest.raises(ValueError, match="position 4 is not on the path; give one from 0 to 3"):
        WAY.at(4)


def test_poses_are_written_without_a_step(tmp_path: FilePath) -> None:
    """A twentieth of the robot's radius, as on the command line; of a robot that only a file tells, of its reach."""
    file, moves, rod = tmp_path / "way.csv", [Translation((8, 0))], Scene([(0, 0), (3, 0), (3, 4)])

    def steps(path: Path, **more: Any) -> float:
        save(path, file, **more)
        x = np.loadtxt(file, delimiter=",", skiprows=1)[:, 0]
        return float(np.diff(x).max())

    assert steps(Path(Pose(0, 0), moves, scene=rod)) == steps(Path(Pose(0, 0), moves), scene=rod) == 5 / 20
    assert steps(Path(Pose(0, 0), moves)) == pytest.approx(8 / 100)
    save(Path(Pose(0, 0), moves, scene=rod), tmp_path / "way.json")
    again = cfree.load(tmp_path / "way.json")
    assert isinstance(again, Path) and again.scene is None and 5 / 20 < steps(again) <= 7 / 20
    for suffix in ("yaml", "geojson"):
        save(WAY, tmp_path / f"way.{suffix}")
    for turned in (Path(Pose(0, 0), []), Path(Pose(0, 0), [Rotation((0, 0), "90deg")])):
        save(turned, file)
    disc = cfree.Curved.circle((0, 0), 2)
    hall = Scene(disc, [], bounds=(-9, -9, 9, 9), start=(0, 0, 0), goal=(8, 0, 0))
    path = cfree.plan(hall)
    assert isinstance(path, Path) and steps(path, scene=hall) == pytest.approx(2 / 20, rel=0.1)
    with pytest.raises(ValueError, match="step 0"):
        save(WAY, file, step=0)


def test_exports_for_others(tmp_path: FilePath) -> None:
    save(WAY, tmp_path / "way.csv", step=0.5)
    header, *rows = (tmp_path / "way.csv").read_text().splitlines()
    samples = WAY.sample(0.5)
    assert header == "x,y,theta"
    read = np.array([[*map(float, row.split(","))] for row in rows])
    assert np.array_equal(read[:, :2], samples.xy) and np.allclose(read[:, 2] % math.tau, samples.theta)
    assert (np.abs(np.diff(read[:, 2])) <= math.radians(5) + 1e-12).all() and read[-1, 2] == math.pi / 2
    with pytest.raises(UnsupportedError, match=r"way\.txt: paths are written as"):
        save(WAY, tmp_path / "way.txt")
    with pytest.raises(ValueError, match="no scene"):
        save(Path(Pose(0, 0), MOVES), tmp_path / "way.geojson", step=1)
    with pytest.raises(ValueError, match=r"way\.json: no scene; give the one that it is an answer for"):
        save(Path(Pose(0, 0), MOVES), tmp_path / "way.json")


@pytest.mark.slow
@settings(max_examples=50, deadline=None)
@given(paths, st.text(st.characters(exclude_categories=["Cs"]), max_size=6))
def test_yaml_is_the_message_of_ros(tmp_path_factory: pytest.TempPathFactory, path: Path, frame: str) -> None:
    """nav_msgs/Path: a header and stamped poses; each has a header and a pose of a Point and a Quaternion."""
    file = tmp_path_factory.mktemp("paths") / "way.yaml"
    save(Path(path.start, path.motions, frame=frame), file, step=0.5, turn=0.5)
    message = yaml.safe_load(file.read_text(encoding="utf-8"))
    header = {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": frame}
    samples = path.sample(0.5, 0.5)
    assert message.keys() == {"header", "poses"} and message["header"] == header
    assert len(message["poses"]) == len(samples)
    before = None
    for stamped, (x, y), theta in zip(message["poses"], samples.xy, samples.theta, strict=True):
        assert stamped.keys() == {"header", "pose"} and stamped["header"] == header
        assert stamped["pose"].keys() == {"position", "orientation"}
        position, turned = stamped["pose"]["position"], stamped["pose"]["orientation"]
        assert position == {"x": x, "y": y, "z": 0} and turned.keys() == {"x", "y", "z", "w"}
        assert all(type(value) is float for value in (*position.values(), *turned.values()))
        assert before is None or before["z"] * turned["z"] + before["w"] * turned["w"] > 0  # no change of sign
        before = turned
        assert turned["x"] == turned["y"] == 0 and math.hypot(turned["z"], turned["w"]) == pytest.approx(1)
        assert math.remainder(2 * math.atan2(turned["z"], turned["w"]) - theta, math.tau) == pytest.approx(0, abs=1e-9)


def test_tiny_numbers_are_numbers_in_yaml(tmp_path: FilePath) -> None:
    save(Path(Pose("1e-7", "-2e20"), [Translation(("1e-9", 0))]), tmp_path / "way.yaml", step=1)
    (first, _) = yaml.safe_load((tmp_path / "way.yaml").read_text())["poses"]
    assert first["pose"]["position"] == {"x": 1e-7, "y": -2e20, "z": 0}


RING = Polygon([(-1, -1), (2, -1), (2, 1), (-1, 1)], [[("-0.5", "-0.5"), ("0.5", "-0.5"), ("0.5", "0.5")]])


@pytest.mark.slow
@settings(max_examples=50, deadline=None)
@given(paths, st.sampled_from([[RING], [[(0, 0), (3, 0), (0, 1)]], [RING, [(5, 0), (6, 0), (6, 1)]]]))
def test_geojson_has_the_way_and_the_outlines(
    tmp_path_factory: pytest.TempPathFactory, path: Path, robot: list
) -> None:
    file = tmp_path_factory.mktemp("paths") / "way.geojson"
    scene = Scene(robot=robot)
    save(Path(path.start, path.motions, "m", "map"), file, step=0.7, turn=0.5, scene=scene)
    data = json.loads(file.read_text())
    assert (data["type"], data["units"], data["frame"]) == ("FeatureCollection", "m", "map")
    trace, *outlines = data["features"]
    way = shapely.geometry.shape(trace["geometry"])
    samples = path.sample(0.7, 0.5)
    count = max(len(samples), 2)
    assert trace["properties"] == {"role": "trace", "length": path.length, "turning": path.turning}
    assert way.geom_type == "LineString" and len(way.coords) == len(outlines) == count
    assert [f["properties"]["role"] for f in outlines] == ["start", *["pose"] * (count - 2), "goal"]
    area = sum(part.area for part in scene.robot)
    assert (np.abs(np.diff([f["properties"]["theta"] for f in outlines])) <= 0.5 + 1e-9).all()
    for feature, place in zip(outlines, way.coords, strict=True):
        shape, at = shapely.geometry.shape(feature["geometry"]), feature["properties"]
        assert shape.is_valid and shape.area == pytest.approx(area) and (at["x"], at["y"]) == place
        assert all(part.exterior.is_ccw for part in getattr(shape, "geoms", [shape]))
        assert len(getattr(shape, "geoms", [shape])) == len(robot)
        if path.motions:
            (pose,) = path.motions[at["motion"]].sample(path.poses[at["motion"]], [at["share"]])
            assert (float(pose.x), float(pose.y)) == pytest.approx(place, abs=1e-9)
            assert math.remainder(pose.theta - at["theta"], math.tau) == pytest.approx(0, abs=1e-9)
    for feature, pose in ((outlines[0], path.start), (outlines[-1], path.goal)):
        wanted = shapely.union_all(
            [shapely.Polygon(pose.apply(part.vertices[: part.ring_offsets[1]])) for part in scene.robot]
        )
        hull = shapely.geometry.shape(feature["geometry"]).convex_hull
        assert hull.hausdorff_distance(wanted.convex_hull) < 1e-6


@pytest.mark.parametrize("gap", [Fraction(1), Fraction(1, 100)])
def test_clearance_is_known_beside_a_turning_rod(gap: Fraction) -> None:
    """The end of the rod runs on a circle of radius 5, and a wall is 5 + gap away."""
    scene = Scene(robot=[(-5, 0), (0, -1), (5, 0), (0, 1)], obstacles=box(5 + gap, -9, 7, 9))
    path = Path(Pose(0, 0, "30deg"), [Rotation((0, 0), "-60deg"), Translation((-1, 0))])
    found = cfree.clearance(path, scene)
    assert found is not None
    assert found.least <= gap <= found.found + 1e-12
    assert found.least > gap - Fraction("0.0051")
    assert found.motion == 0 and found.obstacle == (0, 3)
    assert found.share == pytest.approx(0.5, abs=0.05)
    assert cfree.clearance(path, Scene(robot=scene.robot, obstacles=[])) is None


def test_what_a_translation_keeps_is_known_however_long_and_narrow_its_way_is() -> None:
    gap = 2.0**-20
    scene = Scene(robot=box(-1, -1, 1, 1), obstacles=[box(-9, -3, 999, -1 - gap), box(-9, 1 + 2 * gap, 999, 3)])
    found = cfree.clearance(Path(Pose(0, 0), [Translation((900, 0))]), scene, tolerance=1.0)
    assert found is not None and found.obstacle == (0, 2)
    assert found.found == pytest.approx(gap) and found.least > 0.99 * gap


@given(seed=st.integers(0, 10**6))
def test_the_narrowest_place_of_a_translation_is_that_of_samples(seed: int) -> None:
    rng = random.Random(seed)
    pegs = [[(x, y), (x + 1, y), (x, y + 1)] for x in range(0, 20, 5) for y in (rng.uniform(-7, -4), rng.uniform(3, 6))]
    scene = Scene(robot=[(-1, -1), (2, 0), (0, rng.uniform(0.5, 1.5))], obstacles=pegs)
    path = Path(Pose(-3, 0, rng.uniform(0, 6)), [Translation((23, rng.uniform(-0.5, 0.5)))])
    found = cfree.clearance(path, scene)
    distances = EdgeDistances(scene)
    shares = np.array([*np.linspace(0, 1, 2000), found.share])
    sampled, _, _ = distances.nearest(distances.at(path.motions[0].sample(path.start, shares)))
    assert sampled[-1] == pytest.approx(found.found, abs=1e-12) and found.least <= found.found
    assert found.found - 1e-12 <= sampled.min() <= found.found + 0.02


@pytest.mark.parametrize("unit", [1, Fraction(1, 10**140), 10**140])
def test_the_clearance_of_one_pose_is_the_distance_there(unit: Any) -> None:
    """By shapely's distances of all edges, and the two closest edges are as far apart."""
    rng = random.Random(3)
    pegs = [[(x, y), (x + 1, y), (x, y + 1)] for x in range(0, 20, 5) for y in (-6, 3)]
    robot = [(-1, -1), (2, 0), (0, 1)]
    scene = Scene(*([[(x * unit, y * unit) for x, y in ring] for ring in rings] for rings in ([robot], pegs)))
    distances = EdgeDistances(scene)
    for _ in range(40):
        pose = Pose(rng.randint(-90, 90) * unit / 5, rng.randint(-40, 40) * unit / 5, rng.uniform(-9, 9))
        if not cfree.is_free(scene, pose):
            continue
        found = cfree.clearance(Path(pose, []), scene)
        placed = distances.at(Poses.from_poses([pose]))
        (expected,), _, _ = distances.nearest(placed)
        assert found is not None and (found.motion, found.share) == (0, 0)
        assert found.found == pytest.approx(expected, rel=1e-12, abs=1e-14 * float(unit)) and found.least <= found.found
        edge = placed[0, distances.robot_names.index(found.robot)]
        near = np.hypot(*np.subtract(*distances.between(edge, distances.names.index(found.obstacle))))
        assert near == pytest.approx(expected, rel=1e-9, abs=1e-12 * float(unit))


def test_a_path_that_touches_has_no_clearance() -> None:
    scene = Scene(robot=box(-1, -1, 1, 1), obstacles=box(-9, -3, 9, -1), workspace=box(-9, -9, 9, 9))
    path = Path(Pose(0, 4), [Translation((0, -4)), Translation((3, 0))])
    assert path.is_free(MotionChecker(scene))
    found = cfree.clearance(path, scene)
    assert found is not None and (found.least, found.found, found.motion, found.share) == (0, 0, 0, 1)
    with pytest.raises(ValueError, match="the path is not free"):
        cfree.clearance(Path(Pose(0, 4), [Translation((0, -5))]), scene)
    with pytest.raises(ValueError, match="tolerance 0: give a positive one"):
        cfree.clearance(path, scene, tolerance=0)
    assert not Path(Pose(0, -2), []).is_free(MotionChecker(scene))


@settings(max_examples=25, deadline=None)
@given(strategies.convex_polygons(3), strategies.simple_polygons(5), poses, st.lists(motions, min_size=1, max_size=2))
def test_no_sample_has_less_than_the_least_clearance(
    robot: strategies.Shape, obstacle: strategies.Shape, start: Pose, moves: list[cfree.Translation | cfree.Rotation]
) -> None:
    import shapely

    scene = Scene(robot=robot[0], obstacles=cfree.Polygon(*obstacle))
    path = Path(start, moves)
    if not path.is_free(MotionChecker(scene)):
        return
    found = cfree.clearance(path, scene, tolerance=0.05)
    assert found is not None
    samples = path.sample(0.05, 0.02)
    rings = samples.apply(scene.robot[0].vertices)
    least = shapely.distance(shapely.polygons(rings), scene.obstacles[0].to_shapely()).min()
    assert found.least <= least + 1e-9
    assert found.least >= found.found - 0.05 - 1e-9
    assert least >= found.found - 0.05 - 1e-9


def test_the_example_of_the_format_page_is_what_is_written(request: pytest.FixtureRequest, tmp_path: FilePath) -> None:
    page = (request.config.rootpath / "docs" / "answer-format.md").read_text()
    example = page.split("```json\n")[1].split("```")[0]
    file = tmp_path / "way.json"
    save(Path(Pose(0, 0), MOVES[:2], units="m", scene=SQUARE), file)
    assert file.read_text() == example
    fault = page.split("```\nway.json:")[1].split("\n")[0]
    file.write_text(example.replace('"tau": "-1"}}', '"tau": "x"}}'))
    with pytest.raises(FormatError) as caught:
        load_answer(file)
    assert str(caught.value) == f"{file}:{fault}"


def test_decimals_alone_lead_all_the_way_to_the_goal_they_state(tmp_path: FilePath) -> None:
    """What is missing is one motion more, and checked as any other."""
    file = tmp_path / "way.json"
    scene = Scene(robot=[(-1, -1), (1, -1), (1, 1), (-1, 1)], obstacles=[[(1, -5), (3, -5), (3, 5), (1, 5)]])
    move = '{"type": "translation", "vector": [1, 0]}'
    for goal, is_free in (("-1e-7", True), ("1e-7", False)):
        file.write_text(f'{{"answer": "path", "start": [-1, 0, 0], "goal": [{goal}, 0, 0], "motions": [{move}]}}')
        path = load_answer(file)
        assert isinstance(path, Path)
        assert path.goal == Pose(goal, 0)
        assert path.is_free(MotionChecker(scene)) == is_free
        assert cfree.verify.answer(scene, file).verified == is_free


def test_places_after_a_distance_are_where_samples_are() -> None:
    path = Path(Pose(0, 0), [Rotation((1, 0), "180deg"), Translation((3, 4)), Rotation((9, 9), {"tau": "-3/7"})])
    total = path.length + 2 * path.turning
    for k in range(101):
        distance = k * total / 100
        pose = path.after(distance, angle_scale=2)
        done = 0.0
        for start, motion in zip(path.poses, path.motions, strict=False):
            part = Path(start, [motion])
            whole = part.length + 2 * part.turning
            if distance <= done + whole + 1e-12:
                (expected,) = motion.sample(start, [min(1.0, (distance - done) / whole)])
                assert np.allclose([float(pose.x), float(pose.y)], [float(expected.x), float(expected.y)], atol=1e-9)
                assert abs(math.remainder(pose.theta - expected.theta, math.tau)) < 1e-9
                break
            done += whole
    assert path.after(0) == path.start and path.after(path.length + path.turning) == path.goal
    with pytest.raises(ValueError, match="is not on the path"):
        path.after(total + 1, angle_scale=2)


def test_narrowest_places_are_those_of_dense_samples() -> None:
    gates = [box(x, -9, x + 1, Fraction(-gap, 8)) for x, gap in ((4, 11), (9, 8), (14, 16), (20, 9))]
    scene = Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)], obstacles=gates)
    path = Path(Pose(0, 0), [Translation((10, 0)), Rotation(("10.5", "0.5"), "90deg"), Translation((14, 0))])
    found = narrowest(path, scene, 4)
    assert [place.obstacle[0] for place in found] == [1, 3, 0, 2]
    for place in found:
        assert place.least <= place.found
        pose = path.poses[place.motion]
        (sample,) = path.motions[place.motion].sample(pose, [place.share])
        placed = shapely.Polygon(sample.apply(scene.robot[0].vertices))
        assert place.found == pytest.approx(placed.distance(gates[place.obstacle[0]].to_shapely()), abs=1e-9)
    assert narrowest(path, scene, 1)[0].found == cfree.clearance(path, scene).found


@pytest.mark.parametrize("tau", ["0", "1/3", "1/7", "2/5", "3/8"])
def test_a_path_that_touches_has_a_clearance_of_0(tau: str) -> None:
    """A slot that just fits, in any direction: rounding leaves 2e-16 for 1/3."""
    place = Pose("1/3", "2/7", {"tau": tau})
    box, walls = [(-2, -1), (2, -1), (2, 1), (-2, 1)], [(1, 9), (-9, -1)]
    corners = [[(Fraction(x), Fraction(y)) for x, y in ((-3, a), (3, a), (3, b), (-3, b))] for a, b in walls]
    scene = Scene(box, [place.apply_exact(points) for points in corners])
    start, goal = place @ Pose(-8, 0), place @ Pose(8, 0)
    path = Path(start, [Translation((goal.x - start.x, goal.y - start.y))])
    found = clearance(path, scene)
    assert found is not None and (found.least, found.found) == (0, 0)
