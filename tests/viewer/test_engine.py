"""The core in the page and the core in Python give the same bytes, and the same verdicts."""

from __future__ import annotations

import hashlib
import json
from fractions import Fraction
from itertools import pairwise, permutations
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cfree
from cfree import verify
from cfree.collision.distance import EdgeDistances
from cfree.curves import Arc, Circle
from cfree.exact.pose import Pose
from cfree.formats.scene_file import scene_text
from cfree.geometry.local import local_geometry
from examples import POLYGONS
from page_core import NODE, asked, columns_of, said

SCENES = Path(__file__).parents[2] / "examples" / "scenes"
QUICK = ("degenerate_island", "sofa_corner")
pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed: the page's core was not run")


@pytest.mark.slow
@pytest.mark.parametrize(
    "path",
    [
        pytest.param(path, marks=() if path.stem in QUICK else pytest.mark.slow)
        for path in POLYGONS
        if path.stem != "benchmr_warehouse"
    ],
    ids=lambda path: path.stem,
)
def test_boundary_and_cells_have_the_same_bytes(path: Path) -> None:
    _, _, found = asked(["open", path.read_text()], ["boundary"], ["columns"])
    expected = columns_of(cfree.load_scene(path))
    assert set(found) == set(expected)
    for name, column in expected.items():
        assert found[name]["sha256"] == hashlib.sha256(np.ascontiguousarray(column).tobytes()).hexdigest(), name


@pytest.mark.slow
@pytest.mark.parametrize("name", ["paper_fig9", "comb_hook", "sofa_corner", "degenerate_island"])
def test_paths_of_the_page_are_free(name: str) -> None:
    scene = cfree.load_scene(SCENES / f"{name}.json")
    assert scene.start is not None and isinstance(scene.goal, Pose)
    _, answer = asked(["open", scene_text(scene)], ["plan", said(scene.start), said(scene.goal), "", 0])
    expected = cfree.plan(scene)
    assert (answer["verdict"] == "path") == isinstance(expected, cfree.Path)
    if answer["verdict"] == "path":
        poses = [Pose(x, y, {"tau": tau}) for x, y, tau in map(str.split, answer["poses"].splitlines())]
        motions = [cfree.motion_between(a, b) for a, b in pairwise(poses)]
        path = cfree.Path(poses[0], motions)
        assert (path.start, path.goal) == (scene.start, scene.goal) and path.is_free(cfree.MotionChecker(scene))


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [
        "benchmr_parking1",
        pytest.param("comb_hook", marks=pytest.mark.long),
        "degenerate_island",
        "degenerate_workspace",
    ],
)
def test_paths_of_vehicles_are_free_and_driven(name: str) -> None:
    scene = cfree.load_scene(SCENES / f"{name}.json")
    assert scene.start is not None and isinstance(scene.goal, Pose)
    vehicles = {
        "car 3 4 -1/2 0.1 0 both": cfree.Car((3, 4), axle=("-1/2", "0.1")),
        "car 1 1 0.2 0 1 both": cfree.Car(1, axle=("0.2", 0), heading="90deg"),
        "differential 0 1/3 inf": cfree.DifferentialDrive(axle=(0, "1/3"), heading="180deg"),
    }
    calls = [["plan", said(scene.start), said(scene.goal), words, 100] for words in vehicles]
    _, *answers = asked(["open", scene_text(scene)], *calls)
    for vehicle, answer in zip(vehicles.values(), answers, strict=True):
        assert answer["verdict"] == "path", answer
        poses = [Pose(x, y, {"tau": tau}) for x, y, tau in map(str.split, answer["poses"].splitlines())]
        motions = [cfree.motion_between(a, b) for a, b in pairwise(poses)]
        path = cfree.Path(poses[0], motions, scene=scene, vehicle=vehicle)
        assert (path.start, path.goal) == (scene.start, scene.goal) and path.is_free(cfree.MotionChecker(scene))
        assert cfree.is_drivable(path, vehicle)
        assert answer["cusps"]["values"] == [path.cusps]


@pytest.mark.parametrize(
    ("vehicle", "poses", "why"),
    [
        ("car 2 3 0 0 0 both", "0 0 0|1 0 0", ""),
        ("car 2 3 0 0 0 both", "0 0 0|2 2 1", ""),  # a quarter of the circle of radius 2 to the left
        ("car 201/100 1 0 0 0 both", "0 0 0|2 2 1", "turns too narrowly"),
        ("car 1 2 0 0 0 both", "0 0 0|2 -2 -1", ""),
        ("car 1 201/100 0 0 0 both", "0 0 0|2 -2 -1", "turns too narrowly"),
        ("car 1 1 0 0 0 forward", "0 0 0|-1 0 0", "goes backward"),
        ("car 1 1 0 0 0 both", "0 0 0|1 1e-30 0", "moves the axle point sideways"),
        ("car 1 1 0 0 1 both", "0 0 0|1 0 0", "moves the axle point sideways"),
        ("car 1 1 0 0 0 both", "0 0 0|0 0 1", "turns in place"),
        ("differential 0 0 0", "0 0 0|0 0 1", ""),
        ("differential 1 0 0", "0 0 0|0 0 1", "moves the axle point sideways"),
        ("car 0 1 0 0 0 both", "0 0 0|1 0 0", "give a length above 0"),
        ("boat 0 1 0", "0 0 0|1 0 0", "no vehicle: boat"),
    ],
)
def test_given_motions_that_no_vehicle_does_are_refused_exactly(vehicle: str, poses: str, why: str) -> None:
    scene = cfree.Scene([(-1, -1), (1, -1), (1, 1), (-1, 1)], bounds=(-99, -99, 99, 99))
    _, answer = asked(["open", scene_text(scene)], ["walk", poses.replace("|", "\n"), vehicle])
    assert why in answer.get("fault", "") if why else "gear" in answer, answer


@pytest.mark.slow
@pytest.mark.parametrize("ends", list(permutations([Pose(-7, 1), Pose(0, "1.5", "45deg")])))
def test_written_paths_slide_along_two_contacts(ends: tuple[Pose, Pose], tmp_path: Path) -> None:
    square, junction = (
        [(-1, -1), (1, -1), (1, 1), (-1, 1)],
        [(-9, 0), (9, 0), (9, 2), (1, 2), (1, 9), (-1, 9), (-1, 2), (-9, 2)],
    )
    scene = cfree.Scene(square, [], workspace=junction)
    _, _, written = asked(["open", scene_text(scene)], ["plan", *map(said, ends), "", 0], ["written"])
    (tmp_path / "answer.json").write_text(
        written["answer"].replace("{sha256}", hashlib.sha256(written["scene"].encode()).hexdigest())
    )
    path = cfree.load(tmp_path / "answer.json")
    assert isinstance(path, cfree.Path) and any(isinstance(motion, cfree.Slide) for motion in path.motions)
    assert (path.start, path.goal) == ends and verify.answer(scene, path).verified


def test_contact_is_reached_exactly() -> None:
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    scene = cfree.Scene(square, [[(3, 0), (4, 0), (4, 1), (3, 1)]], bounds=(-9, -9, 9, 9))
    calls = [
        ["open", scene_text(scene)],
        ["boundary"],
        ["stop", "0 0.3 0", "2.5 0.3 0"],
        ["pose", "2 0.3 0"],
        ["pose", "2.1 0.3 0"],
    ]
    _, _, stop, touching, overlapping = asked(*calls)
    assert Fraction(stop["pose"].split()[0]) == 2
    assert touching["free"]["values"] == [1] and touching["touching.obstacle"]["values"] == [0, 0]
    assert overlapping["free"]["values"] == [0] and overlapping["pair"]["values"] == [0, 0]


DISC = cfree.Curved.circle((0, 0), "1/2")
FLOOR = [(-9, -2), (9, -2), (9, "-1/2"), (-9, "-1/2")]
WALL = [(-1, "1/2"), (1, "1/2"), (1, 9), (-1, 9)], [(-1, -9), (1, -9), (1, "-1/2"), (-1, "-1/2")]
STADIUM = cfree.Curved(
    [(-1, "-1/2"), (1, "-1/2"), Arc((1, "1/2"), center=(1, 0)), (-1, "1/2"), Arc((-1, "-1/2"), through=("-3/2", 0))]
)
POSTS = [cfree.Curved.circle((0, y), 1) for y in ("3/2", "-3/2")]
RING = cfree.Curved([(-9, -9), (9, -9), (9, 9), (-9, 9)], [Circle((0, 0), 2)])
NARROW = [(-1, "0.4995"), (1, "0.4995"), (1, 9), (-1, 9)], [(-1, -9), (1, -9), (1, "-0.4995"), (-1, "-0.4995")]
LORRY = cfree.Curved([(-1, "-1/2"), (3, "-1/2"), (3, "1/2"), (-1, "1/2")], grown="1/4")
ROOM = (-5, -5, 5, 5)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "scene", "ends", "answer"),
    [
        ("a disc along the floor it lies on", cfree.Scene(DISC, [FLOOR]), [(-5, 0, 0), (5, 0, "180deg")], cfree.Path),
        (
            "a stadium through its own width",
            cfree.Scene(STADIUM, [*WALL], bounds=ROOM),
            [(-4, 0, 0), (4, 0, 0)],
            cfree.Path,
        ),
        (
            "a disc between posts its width apart",
            cfree.Scene(DISC, POSTS, bounds=ROOM),
            [(-4, 0, 0), (4, 0, 0)],
            cfree.Path,
        ),
        ("a disc along a round hole", cfree.Scene(DISC, [RING]), [("3/2", 0, 0), ("9/10", "6/5", 0)], cfree.Path),
        ("a gap 1e-3 too narrow", cfree.Scene(DISC, [*NARROW], bounds=ROOM), [(-4, 0, 0), (4, 0, 0)], cfree.Separated),
        ("a round hole without a way out", cfree.Scene(DISC, [RING]), [("3/2", 0, 0), (12, 0, 0)], cfree.Separated),
        ("a lane with round ends", cfree.Scene(DISC, [], workspace=STADIUM), [(-1, 0, 0), (1, 0, 0)], cfree.Path),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_round_shapes_are_decided_exactly_and_the_saved_answers_verified(
    name: str, scene: cfree.Scene, ends: list[Any], answer: type[cfree.Path | cfree.Separated], tmp_path: Path
) -> None:
    start, goal = (Pose(*end) for end in ends)
    _, _, written = asked(["open", scene_text(scene)], ["plan", said(start), said(goal), "", 0], ["written"])
    text = written["answer"].replace("{sha256}", hashlib.sha256(written["scene"].encode()).hexdigest())
    (tmp_path / "answer.json").write_text(text)
    saved = cfree.load(tmp_path / "answer.json")
    assert isinstance(saved, answer) and (saved.start, saved.goal) == (start, goal)
    assert verify.answer(scene, saved).verified
    assert "polygons" not in json.loads(text) or answer is cfree.Separated  # a path is one of the shapes themselves


@pytest.mark.slow
def test_vehicles_with_round_corners_drive_past_round_obstacles(tmp_path: Path) -> None:
    scene = cfree.Scene(LORRY, [cfree.Curved.circle((5, 0), 1)], bounds=(-20, -20, 20, 20))
    plan = ["plan", "0 0 0", "10 0 0", "car 4 4 0 0 0 both", 100]
    _, answer, written = asked(["open", scene_text(scene)], plan, ["written"])
    assert answer["verdict"] == "path"
    text = written["answer"].replace("{sha256}", hashlib.sha256(written["scene"].encode()).hexdigest())
    (tmp_path / "answer.json").write_text(text)
    assert verify.answer(scene, cfree.load(tmp_path / "answer.json")).verified


def test_round_contact_is_exact_and_reached_exactly() -> None:
    scene = cfree.Scene(DISC, [FLOOR, cfree.Curved.circle((3, 0), 1)])
    near = ["0 0 0", "3/2 0 0", "3/2 1e-30 0", "0 1e-15 0", "0 -1e-30 0"]
    stop = ["stop", "0 0.1 0", "2 0.1 0"], ["stop", "-3 5 0", "-3 -5 0"]
    _, *poses, aslant, down = asked(["open", scene_text(scene)], *(["pose", pose] for pose in near), *stop)
    assert [pose["free"]["values"] for pose in poses] == [[1], [1], [1], [1], [0]]
    assert [pose["touched"]["values"] for pose in poses[:4]] == [[0], [0, 1], [0, 1], []]
    assert poses[4]["pair"]["values"] == [0, 0]
    assert Fraction(down["pose"].split()[1]) == 0
    x, y = map(Fraction, aslant["pose"].split()[:2])
    assert 0 <= (x - 3) ** 2 + y**2 - Fraction(9, 4) < Fraction(1, 2**50)


FAR = cfree.Curved(
    [(20, 0), (22, 0), Arc((20, 0), center=(21, 0))]
)  # with an arc as a side the page has no proofs by cells


@pytest.mark.parametrize(("more", "verdict"), [([], "apart"), ([FAR], "round")], ids=["rounded", "others"])
def test_a_gap_closed_by_a_hair_has_a_proof_among_rounded_shapes_and_is_undecided_among_others(
    more: list[cfree.Curved], verdict: str
) -> None:
    barely = [
        [(x, Fraction(y) + side * Fraction("1e-9")) for x, y in wall] for wall, side in zip(WALL, (-1, 1), strict=True)
    ]
    scene = cfree.Scene(DISC, [*barely, *more], bounds=ROOM)
    _, answer = asked(["open", scene_text(scene)], ["plan", "-4 0 0", "4 0 0", "", 0])
    assert answer["verdict"] == verdict


@pytest.mark.parametrize(
    ("shape", "message"),
    [
        ({"circle": {"center": [0, 0], "radius": 0}}, "obstacle 0: radius: give a length above 0"),
        ({"path": [[1, 0], {"arc": {"to": [0.7, 0.7], "center": [0, 0]}}, [0, 0]]}, "is not on the arc, by a part of"),
        ({"path": [[0, 0], {"arc": {"to": [2, 0], "through": [1, 0]}}]}, "three points on one line"),
        (
            {"path": [[0, 0], [4, 0], {"arc": {"to": [0, 0], "through": [2, 0.1]}}, [2, 5]]},
            "obstacle 0: its outline crosses",
        ),
        ({"circle": {"center": [0, 0], "radius": 1}, "grown": 1}, "grown: of polygons only"),
        (
            {"ellipse": {"center": [0, 0], "radii": [1, 2]}},
            "obstacles[0].ellipse: the page takes lines and circular arcs",
        ),
        ({"path": [[1, 0], {"arc": {"to": [0, 2], "center": [0, 0], "conjugate": [0, 2]}}]}, ""),
    ],
)
def test_round_shapes_that_are_none_are_one_clear_message(shape: dict[str, Any], message: str) -> None:
    text = json.dumps({"robot": {"outer": [[0, 0], [1, 0], [0, 1]]}, "obstacles": [shape]})
    (answer,) = asked(["open", text])
    assert message in answer["fault"] and "fault of cfree" not in answer["fault"]


@pytest.mark.slow
def test_picked_point_is_in_contact_exactly() -> None:
    text = (SCENES / "paper_fig9.json").read_text()
    slice_ = asked(["open", text], ["boundary"], ["slice", 0.6])[-1]
    kinds, ends = slice_["kind"]["values"], slice_["segments"]["values"]
    k = next(k for k, kind in enumerate(kinds) if kind < 2)  # of the triangle, not of the bounds
    middle = [(ends[4 * k] + ends[4 * k + 2]) / 2, (ends[4 * k + 1] + ends[4 * k + 3]) / 2]
    picked = ["picked", slice_["trapezoid"]["values"][k], *middle, 0.6]
    pose = asked(["open", text], ["boundary"], picked)[-1]["pose"]
    touching = asked(["open", text], ["boundary"], ["pose", pose])[-1]
    assert touching["free"]["values"] == [1] and touching["touching.obstacle"]["values"] == [0]


@pytest.mark.slow
def test_what_is_told_of_patches_cells_and_poses_is_what_python_says() -> None:
    path = SCENES / "comb_hook.json"
    scene = cfree.load_scene(path)
    boundary = cfree.boundary(scene)
    space, k = cfree.free_space(boundary), len(boundary.trapezoids) // 2
    table = boundary.trapezoids
    phi = (table.theta_from[k] + table.theta_to[k]) / 2
    patch = table.patch[k]
    x, y = boundary.evaluate([patch], [0.5], [phi])[0]
    _, _, picked, cell, pose = asked(
        ["open", path.read_text()],
        ["boundary"],
        ["picked", k, x, y, phi],
        ["cell", 0],
        ["pose", f"{scene.start.x} {scene.start.y} {scene.start.tau}"],
    )
    edges = EdgeDistances(scene)
    rows = np.array([[float(scene.start.x), float(scene.start.y), scene.start.theta]])
    nearest = edges.nearest(edges.placed(rows))[0][0]
    at = local_geometry(boundary.ruled[patch], picked["t"]["values"][0], phi)
    assert picked["K"]["values"][0] == pytest.approx(float(at.gaussian_curvature), abs=1e-12)
    assert picked["H"]["values"][0] == pytest.approx(float(at.mean_curvature), abs=1e-12)
    assert picked["trims.kind"]["length"] > 0
    assert cell["volume"]["values"][0] == pytest.approx(space.volumes[0], rel=1e-12)
    assert bool(cell["caged"]["values"][0]) == space.cells[0].caged
    assert pose["clearance"]["values"][0] == pytest.approx(float(nearest), rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{}", "robot"),
        ('{"robot": {"outer": [[0,0],[1,0],["x",1]]}}', 'robot.outer[2][0]: expected a number or "p/q", got "x"'),
        ('{"robot": {"outer": [[0,0],[1,1],[1,0],[0,1]]}}', "robot: "),
        ('{"robot": {"outer": [[0,0],[1,0],[NaN,1]]}}', ""),
        ("[" * 100_000, "nested deeper"),
        ('{"robot": {"outer": [[0,0],[1,0],[0,1]]}, "<img onerror=alert(1)>": 1}', "unknown key"),
    ],
)
def test_what_is_no_scene_is_one_clear_message(text: str, message: str) -> None:
    (answer,) = asked(["open", text])
    assert message in answer["fault"]
    assert "fault of cfree" not in answer["fault"]
