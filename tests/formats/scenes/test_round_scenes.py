"""Round shapes in JSON scenes: read, written again, and refused with their place."""

import json
import re
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

import cfree
from cfree.cli.app import app
from cfree.formats.scene_file import scene_from_text, scene_text
from cfree.scene.digest import stamp_of
from round_shapes import random_scene

ROBOT = {"outer": [[0, 0], [1, 0], [0, 1]]}


def read(shape: Any, role: str = "obstacles") -> cfree.Scene:
    data = {"robot": ROBOT} | ({"obstacles": [shape]} if role == "obstacles" else {role: shape})
    return scene_from_text("scene.json", json.dumps(data))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(40))
def test_scenes_are_written_and_read_again(seed: int, tmp_path: Path) -> None:
    scene = random_scene(seed)
    cfree.save(scene, tmp_path / "scene.json")
    again = cfree.load_scene(tmp_path / "scene.json")
    assert again == scene and hash(again) == hash(scene) and stamp_of(again) == stamp_of(scene)
    assert cfree.load(tmp_path / "scene.json") == scene
    shapes = cfree.load_shapes(tmp_path / "scene.json")
    assert shapes.scene() == scene
    with pytest.raises(cfree.UnsupportedError, match="round shapes"):
        _ = shapes.polygons


def test_both_spellings_of_a_ring() -> None:
    points = [[0, 0], [4, 0], [4, 1]]
    assert read({"path": points, "grown": 1}) == read({"outer": points, "grown": 1})
    holes = [
        [{"circle": {"center": [2, 2], "radius": 1}}],
        [{"path": [[1, 1], [3, 1], [2, 3]]}],
        [[[1, 1], [3, 1], [2, 3]]],
    ]
    for hole in holes:
        assert (
            len(read({"path": [[0, 0], [9, 0], {"arc": {"to": [0, 9], "center": [0, 0]}}], "holes": hole}).obstacles)
            == 1
        )


@pytest.mark.parametrize("role", ["robot", "obstacles", "workspace"])
def test_round_shapes_stand_wherever_polygons_do(role: str) -> None:
    scene = read({"circle": {"center": [0, 0], "radius": "1/3"}}, role)
    assert scene.curved and scene_from_text("again.json", scene_text(scene)) == scene


@pytest.mark.parametrize(
    ("shape", "message"),
    [
        ({"circle": {"center": [0], "radius": 1}}, 'obstacles[0].circle.center: expected a point [x, y], got [0]'),
        ({"circle": {"center": [0, 0], "radius": "x"}}, 'circle.radius: expected a number or "p/q", got "x"'),
        ({"circle": {"center": [0, 0]}}, 'obstacles[0].circle: key "radius" is missing; add it'),
        ({"circle": {"centre": [0, 0], "radius": 1}}, 'unknown key "centre"; did you mean "center"?'),
        ({"circle": {"center": [0, 0], "radius": 0}}, "obstacles[0]: radius: 0; give a length above 0"),
        ({"circle": 3}, "obstacles[0].circle: expected"),
        ({"path": []}, "obstacles[0]: a path begins with a point"),
        ({"path": [[0, 0], {"arc": {"to": [1]}}]}, "obstacles[0].path[1].arc.to: expected a point [x, y], got [1]"),
        ({"path": [[0, 0], {"arc": {"to": [1, 0]}}]}, "give one of them"),
        ({"path": [[0, 0], {"bow": {}}]}, 'obstacles[0].path[1].bow: unknown key "bow"'),
        ({"path": [[0, 0], {}]}, 'obstacles[0].path[1]: expected one of "arc", "bezier", "spline"'),
        ({"path": [[0, 0], {"bezier": [[1, 1]]}]}, "2 or 3 points"),
        ({"path": [[1, 0], {"arc": {"to": [0, 1.1], "center": [0, 0]}}]}, "obstacles[0]: item 1 of the path: (0, 1.1)"),
        ({"path": [[0, 0], [2, 2], {"arc": {"to": [2, 0], "through": [3, 1]}}, [0, 2]]}, "cross"),
        ({"circle": {"center": [0, 0], "radius": 1}, "outer": [[0, 0], [1, 0], [0, 1]]}, "expected one of"),
        ({"circle": {"center": [0, 0], "radius": 1}, "grown": 1}, "of polygons only"),
        ({"outer": [[0, 0], [1, 0], [0, 1]], "grown": -1}, "0 or more"),
        ({"ellipse": {"center": [0, 0], "radii": [1]}}, "2 radii"),
        ({"ellipse": {"center": [0, 0], "radii": [1, 2], "angle": "x"}}, "ellipse.angle: expected radians"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said_with_its_place(shape: Any, message: str) -> None:
    with pytest.raises(cfree.FormatError) as caught:
        read(shape)
    assert message in str(caught.value) and str(caught.value).startswith("scene.json:1:")


def test_a_grown_workspace_is_refused() -> None:
    with pytest.raises(cfree.FormatError, match=r"workspace: a grown shape"):
        read({"outer": [[0, 0], [9, 0], [0, 9]], "grown": 1}, "workspace")


ARC = [(1, 0), (0, 1), (-1, 0), (0, -1)]
BAD_ARCS = {
    "a radius of 0": {"circle": {"center": [0, 0], "radius": 0}},
    "an arc about its own start": {"path": [[0, 0], {"arc": {"to": [1, 0], "center": [0, 0]}}, [0, 1]]},
    "an arc through its own start": {"path": [[0, 0], {"arc": {"to": [2, 0], "through": [0, 0]}}, [0, 1]]},
    "arcs that cross": {"path": [[-2, 0], [2, 0], [2, 1], {"arc": {"to": [-2, 1], "through": [0, -1]}}]},
    "an arc twice around": {"path": [[1, 0], *[{"arc": {"to": [1, 0], "center": [0, 0]}}] * 2]},
    "a radius below doubles": {"circle": {"center": [0, 0], "radius": "1/1" + 400 * "0"}},
    "no number": {"circle": {"center": [0, 0], "radius": float("nan")}},
}


@pytest.mark.parametrize("name", BAD_ARCS)
@pytest.mark.parametrize("role", ["robot", "obstacles", "workspace"])
def test_bad_arcs_end_with_2_and_one_line_that_names_their_place(name: str, role: str, tmp_path: Path) -> None:
    data: dict[str, Any] = {"robot": [ROBOT], "obstacles": [], "start": [0, 0, 0], "goal": [1, 0, 0]}
    data[role] = BAD_ARCS[name] if role == "workspace" else [*data[role], BAD_ARCS[name]]
    file = tmp_path / "bad.json"
    file.write_text(json.dumps(data))
    for command in (["check", str(file)], ["plan", str(file)]):
        result = CliRunner().invoke(app, command)
        place = {"robot": "robot[1]", "obstacles": "obstacles[0]", "workspace": "workspace"}[role]
        assert result.exit_code == 2, result.output
        assert re.match(rf"error: \S*bad\.json:1:\d+ {re.escape(place)}", result.output), result.output
        assert result.output.count("\n") == 1, result.output


@pytest.mark.parametrize("count", [1, 2, 3, 4])
@pytest.mark.parametrize("is_clockwise", [False, True])
def test_a_full_circle_of_one_to_four_arcs_is_a_disc(count: int, is_clockwise: bool, tmp_path: Path) -> None:
    ends = [(x, -y if is_clockwise else y) for x, y in [*ARC[1:count], ARC[0]]]
    path = [[1, 0], *({"arc": {"to": end, "center": [0, 0], "clockwise": is_clockwise}} for end in ends)]
    scene = read({"path": path})
    cfree.save(scene, tmp_path / "scene.json")
    for one in (scene, cfree.load_scene(tmp_path / "scene.json")):
        assert cfree.is_free(one, (1, 0, 0)) and cfree.is_free(one, (0, 1, 0))
        assert not cfree.is_free(one, (cfree.Pose("0.999999999999999999", 0)))


@pytest.mark.slow
def test_radii_of_all_sizes_are_planned_from_a_file(tmp_path: Path) -> None:
    """A disc of radius 2**-60 goes around one of radius 2**60, from contact to contact."""
    large, unit = 2**60, 2**60
    far = f"{large * unit + 1}/{unit}"
    data = {
        "robot": {"circle": {"center": [0, 0], "radius": f"1/{unit}"}},
        "obstacles": [{"circle": {"center": [0, 0], "radius": large}}],
        "start": [far, 0, 0],
        "goal": [0, far, 0],
    }
    (tmp_path / "sizes.json").write_text(json.dumps(data))
    answer = tmp_path / "answer.json"
    for command in (["plan", "-o", str(answer), "--improve", "0"], ["verify"]):
        files = [str(tmp_path / "sizes.json"), *([str(answer)] if command == ["verify"] else [])]
        result = CliRunner().invoke(app, [command[0], *files, *command[1:]])
        assert result.exit_code == 0, result.output
    data["start"] = [f"{large * unit}/{unit}", 0, 0]
    (tmp_path / "sizes.json").write_text(json.dumps(data))
    result = CliRunner().invoke(app, ["plan", str(tmp_path / "sizes.json")])
    assert result.exit_code == 2 and "is forbidden" in result.output
