"""The page's core asked with wishes: a clearance, preferences; and how much is missing where no motion exists."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cfree
from cfree import Curved, Pose, Scene, verify
from cfree.curves import Arc
from cfree.formats.scene_file import scene_text
from page_core import NODE, asked, columns_of, said

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(NODE is None, reason="node is not installed: the page's core was not run"),
]

WALLS = [[(-9, -1), (-1, -1), (-1, 1), (-9, 1)], [(1, -1), (9, -1), (9, 1), (1, 1)]]
ROOM = [(-9, -9), (9, -9), (9, 9), (-9, 9)]
BAR = [("-0.5", -1), ("0.5", -1), ("0.5", 1), ("-0.5", 1)]
START, GOAL = Pose(0, 5), Pose(0, -5)


def room(robot: Any, walls: Any = WALLS) -> Scene:
    return Scene(robot, walls, workspace=ROOM, start=START, goal=GOAL)


def square(half: str) -> list[tuple[str, str]]:
    return [(f"-{half}", f"-{half}"), (half, f"-{half}"), (half, half), (f"-{half}", half)]


def planned(scene: Scene, clearance: str = "", wishes: str = "") -> dict[str, Any]:
    return asked(["open", scene_text(scene), clearance], ["all plan", said(START), said(GOAL), "", 0, wishes])[1]


def saved(scene: Scene, clearance: str, folder: Path) -> Any:
    """The answer about a clearance as the page saves it, verified in Python."""
    *_, written = asked(
        ["open", scene_text(scene), clearance], ["plan", said(START), said(GOAL), "", 0, ""], ["written"]
    )
    file = folder / "answer.json"
    file.write_text(written["answer"].replace("{sha256}", hashlib.sha256(written["scene"].encode()).hexdigest()))
    answer = cfree.load(file)
    assert verify.answer(scene, answer).verified
    return answer


def test_a_path_keeps_the_clearance_and_is_verified_with_it(tmp_path: Path) -> None:
    path = saved(room(BAR), "0.4", tmp_path)
    assert isinstance(path, cfree.Path) and path.clearance == cfree.Pose("0.4", 0).x
    assert min(planned(room(BAR), "0.4")["clearance"]["values"]) >= 0.4


@pytest.mark.parametrize("robot", [BAR, Curved.circle((0, 0), "1/2")], ids=["bar", "disc"])
def test_no_path_keeps_a_larger_clearance_and_the_proof_is_verified(robot: Any, tmp_path: Path) -> None:
    proof = saved(room(robot), "0.6", tmp_path)
    assert isinstance(proof, cfree.Separated) and str(proof.clearance) == "3/5" and proof.rounded is not None


def test_a_start_nearer_than_the_clearance_is_refused_and_its_outline_is_that_of_the_grown_robot() -> None:
    near = planned(Scene(BAR, [[(-2, "6.2"), (2, "6.2"), (2, 7), (-2, 7)]]), "0.3")
    assert near["verdict"] == "start forbidden" and near["pair"]["values"] == [0, 0]
    far = planned(room(BAR), "0.3")
    assert max(far["grown.xy"]["values"]) == pytest.approx(1.3) and set(far["grown.bend"]["values"]) == {0, 0.3}


def test_a_robot_that_prefers_not_to_go_sideways_turns_first() -> None:
    scene = room(square("0.5"))
    plain, turned = planned(scene, wishes="short 1 1 1"), planned(scene, wishes="short 5 1 1")
    assert plain["turning"]["values"] == [0] and turned["turning"]["values"][0] > 1
    assert "1 or more" in planned(scene, wishes="short 0 1 1")["fault"]


def test_a_path_away_from_obstacles_has_more_distance() -> None:
    pillar = [(-3, 2), (1, 2), (1, 3), (-3, 3)]
    scene = Scene(square("0.2"), [pillar], bounds=(-9, -9, 9, 9))
    short, clear = (min(planned(scene, wishes=f"{way} 1 1 1")["clearance"]["values"]) for way in ("short", "clear"))
    assert clear > 2 * short


@pytest.mark.parametrize(
    ("robot", "inset"),
    [
        (square("1.25"), 0.25),
        (Curved.circle((0, 0), "1.2"), 0.2),
        (Curved(square("0.9"), grown="0.3"), 0.2),
        (Curved(square("1.2"), grown="0.1"), 0.3),  # more than the disc
    ],
    ids=["square", "disc", "grown", "grown little"],
)
def test_the_inset_that_is_missing_is_bounded_from_both_sides(robot: Any, inset: float) -> None:
    [_, missing] = asked(["open", scene_text(room(robot))], ["missing", said(START), said(GOAL)])
    low, high = missing["lo"]["values"][0], missing["hi"]["values"][0]
    assert low - 1e-9 <= inset <= high + 1e-9 and high - low <= 0.0101 * high and missing["proved"]["values"] == [1]


def test_no_inset_opens_a_closed_wall_and_arcs_as_sides_have_none() -> None:
    wall = [[(-9, -1), (9, -1), (9, 1), (-9, 1)]]
    half = Curved([(1, 0), Arc((-1, 0), center=(0, 0))])
    for robot, verdict in [(square("0.5"), "none"), (half, "unknown")]:
        [_, missing] = asked(["open", scene_text(room(robot, wall))], ["missing", said(START), said(GOAL)])
        assert missing["verdict"] == verdict


def test_a_boundary_that_reuses_the_last_one_has_the_same_bytes() -> None:
    scene = cfree.load_scene(Path(__file__).parents[2] / "examples" / "scenes" / "five_convex.json")
    before, after = scene, scene.moved(1, Pose("0.25", "-1/8", "90deg"))
    calls = [call for text in map(scene_text, (before, after)) for call in (["open", text], ["trimmed"], ["boundary"])]
    *_, columns = asked(*calls, ["columns"])
    for name, content in columns_of(after).items():
        assert columns[name]["sha256"] == hashlib.sha256(np.ascontiguousarray(content).tobytes()).hexdigest(), name


def test_slices_need_no_cells() -> None:
    _, _, cut, mesh = asked(["open", scene_text(room(BAR))], ["trimmed"], ["slice", 0.3], ["mesh", 0.1, 1000])
    assert cut["segments"]["length"] > 0 and mesh["fault"] == "the boundary is not computed yet"
