"""Files: what they mean, what is wrong with them and where, and that saving loses nothing."""

import doctest
import json
import math
import os
import random
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import cfree
from cfree import save
from cfree.errors import FormatError, UnsupportedError
from cfree.exact.pose import Pose
from cfree.formats.answers.answer_file import load_answer
from cfree.formats.scene_file import load_scene, number_text, save_scene, scene_text
from cfree.formats.text.findings import InvalidFileError
from cfree.formats.text.json_positions import places
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene
from examples import EXAMPLES, POLYGONS
from scene_texts import GEOJSON, WKT, faults, read

ROOT = Path(__file__).parents[2]
TRIANGLE = '{"outer": [[0, 0], [1, 0], [0, 1]]}'


# what files mean


@pytest.mark.parametrize("file", EXAMPLES, ids=lambda file: file.stem)
def test_shipped_scenes_load_and_survive_saving(file: Path, tmp_path: Path) -> None:
    scene = load_scene(file)
    assert scene.name == file.stem
    assert scene.curved == (file not in POLYGONS)
    assert scene.start is not None
    assert scene.goal is not None
    save_scene(scene, tmp_path / "again.json")
    assert load_scene(tmp_path / "again.json") == scene
    if "repo_path" not in scene.source:
        assert file.read_text() == scene_text(scene), "scenes of our own are in the form that saving gives"


def test_counts_of_the_scenes_from_elsewhere() -> None:
    scenes = [scene for file in EXAMPLES if (scene := load_scene(file)).source]
    points = [sum(len(shape) + len(shape.removed) for shape in scene.obstacles) for scene in scenes]
    assert {s.name: (len(s.robot[0]), len(s.obstacles), n) for s, n in zip(scenes, points, strict=True)} == {
        "benchmr_parking1": (20, 13, 225),
        "benchmr_warehouse": (20, 88, 1776),
        "nest_shirts": (4, 99, 603),
        "nest_swim": (10, 48, 958),
        "street_Berlin": (4, 40, 1382),
    }


def test_numbers_are_what_is_written(tmp_path: Path) -> None:
    scene = read(
        tmp_path,
        '{"robot": {"outer": [[0.1, 0], ["1/3", -2e-1], [12345678901234567890.5, " 1.50 "]]},'
        ' "start": [1e2, 0.1, {"tau": "2/7"}], "goal": [0, 0, 3.141592653589793], "bounds": [0, 0, "1/3", 1]}',
    )
    assert scene.robot[0].exact_vertices == (
        (Fraction(1, 10), 0),
        (Fraction(1, 3), Fraction(-1, 5)),
        (Fraction("12345678901234567890.5"), Fraction(3, 2)),
    )
    assert scene.start == Pose(100, "0.1", {"tau": "2/7"})
    assert scene.goal == Pose(0, 0, "180deg")
    assert scene.bounds == (0, 0, Fraction(1, 3), 1)


def test_a_robot_is_one_object_or_a_list(tmp_path: Path) -> None:
    one = read(tmp_path, f'{{"robot": {TRIANGLE}}}')
    many = read(tmp_path, f'{{"robot": [{TRIANGLE}, {TRIANGLE}]}}')
    assert one.robot == (Polygon([(0, 0), (1, 0), (0, 1)]),)
    assert many.robot == one.robot * 2


def test_a_byte_order_mark_is_skipped(tmp_path: Path) -> None:
    assert read(tmp_path, b"\xef\xbb\xbf" + f'{{"robot": {TRIANGLE}}}'.encode()).robot


def test_unnamed_obstacles_are_numbered_and_others_keep_their_names(tmp_path: Path) -> None:
    named = TRIANGLE.replace("{", '{"name": "K\u00fcche", ')
    scene = read(tmp_path, f'{{"robot": {TRIANGLE}, "obstacles": [{TRIANGLE}, {named}, {TRIANGLE}]}}')
    assert scene.obstacle_names == ("obstacle 0", "K\u00fcche", "obstacle 2")
    assert '"name": "K\u00fcche"' in scene_text(scene)
    assert "obstacle 0" not in scene_text(scene)


def test_goals_may_be_places_and_several(tmp_path: Path) -> None:
    scene = read(tmp_path, f'{{"robot": {TRIANGLE}, "goal": [1, "1/3"]}}')
    assert (scene.goal, scene.goals) == (None, ((1, Fraction(1, 3)),)) and scene == Scene(scene.robot, goal=(1, "1/3"))
    assert '"goal": [1, "1/3"]\n' in scene_text(scene)
    several = read(tmp_path, f'{{"robot": {TRIANGLE}, "goals": [[1, 2], [3, 4, "90deg"]]}}')
    assert several.goals == ((1, 2), Pose(3, 4, "90deg")) != scene.goals
    assert read(tmp_path, f'{{"robot": {TRIANGLE}, "goals": [[3, 4, "90deg"]]}}').goal == Pose(3, 4, "90deg")
    for each in (scene, several):
        save_scene(each, tmp_path / "again.json")
        assert load_scene(tmp_path / "again.json") == each
    with pytest.raises(ValueError, match="goal and goals: give one of them"):
        Scene(scene.robot, goal=(1, 2), goals=[(1, 2)])


@pytest.mark.parametrize(
    ("goals", "fault"),
    [
        ('"goal": [1]', "1:56 goal: expected [x, y, theta], or [x, y] for any theta, got [1]"),
        ('"goal": [1, "x"]', '1:60 goal[1]: expected a number or "p/q", got "x"'),
        ('"goals": [[1, 1e151]]', "1:58 goals[0]: a position beyond 1e150; give one nearer to the scene"),
        ('"goals": [[1, 2, "x"]]', '1:65 goals[0][2]: expected radians, "90deg" or {"tau": "p/q"}, got "x"'),
        ('"goals": [null]', "1:58 goals[0]: expected [x, y, theta], or [x, y] for any theta, got null"),
        ('"goals": 5', "1:57 goals: expected a list, got 5"),
        ('"goals": [[1, 2]], "goal": [1, 2]', '1:57 goals: there is also a "goal"; give one of them'),
    ],
)
def test_faults_of_goals_have_their_places(tmp_path: Path, goals: str, fault: str) -> None:
    assert faults(tmp_path, f'{{"robot": {TRIANGLE}, {goals}}}') == [f"scene.json:{fault}"]


# what is wrong with them


def test_the_half_turn_is_written_inf_in_files(tmp_path: Path) -> None:
    text = f'{{"robot": {TRIANGLE}, "start": [0, 0, {{"tau": null}}]}}'
    (fault,) = faults(tmp_path, text)
    assert 'expected radians, "90deg" or {"tau": "p/q"}' in fault
    start = read(tmp_path, text.replace("null", '"inf"')).start
    assert start is not None and start.tau is None


def test_all_problems_are_told_at_once_with_their_places(tmp_path: Path) -> None:
    text = """{
  "version": 2, "bunds": [0, 0, 1, 1], "name": 12,
  "robot": {"outer": [[0, 0], [9, 0], [0, 9]], "holes": [[[1, 1], [2, 1], [1, 2]], [[8, 8], [9, 8], [8, 9]]]},
  "obstacles": [
    {"outer": [[0, 0], [1, "x/2"], ["1/0", true], [NaN, 1e999999999]]},
    {"outer": [[0, 0], [2, 2], [2, 0], [0, 3]]},
    {"outer": [[0, 0], [1, 0]]},
    {"outer": [[0, 0], [1, 0], [2, 0, 3]], "hole": []},
    {"outer": [[0, 0], [1, 0], [0, 1]], "name": "a", "name": "b"},
    [[0, 0], [1, "y"], [0, 1]], {"holes": 5}
  ],
  "bounds": [0, 0, 0, 5],
  "start": [0, 0, "abc"], "goal": [0], "workspace": {"outer": []},
  "check": {"a": -Infinity, "b": 1},
  "source": {"licence": 5}
}"""
    found = faults(tmp_path, text)
    assert found == [
        "scene.json:2:14 version: expected version 1, the only one this cfree reads, got 2",
        'scene.json:2:17 bunds: unknown key "bunds"; did you mean "bounds"?',
        "scene.json:2:48 name: expected text in quotes, got 12",
        "scene.json:3:84 robot.holes[1]: hole 1: it lies outside the outer ring; move it, or leave it out",
        'scene.json:5:28 obstacles[0].outer[1][1]: expected a number or "p/q", got "x/2"',
        'scene.json:5:37 obstacles[0].outer[2][0]: "1/0" divides by zero; give a finite number',
        'scene.json:5:44 obstacles[0].outer[2][1]: expected a number or "p/q", got true',
        "scene.json:5:52 obstacles[0].outer[3][0]: NaN is not finite; give a finite number",
        "scene.json:5:57 obstacles[0].outer[3][1]: 1e999999999 has more than 4000 digits; give fewer",
        "scene.json:6:15 obstacles[1].outer: outer ring: edges 0 and 2 cross at (6/5, 6/5); "
        "split it into simple polygons",
        "scene.json:7:15 obstacles[2].outer: outer ring: 2 points; give at least 3: "
        "shapes are closures of their interiors: a segment or a point forbids nothing",
        "scene.json:8:32 obstacles[3].outer[2]: expected a point [x, y], got [2, 0, 3]",
        'scene.json:8:44 obstacles[3].hole: unknown key "hole"; did you mean "holes"?',
        'scene.json:9:54 obstacles[4].name: key "name" is there twice; keep one',
        'scene.json:10:18 obstacles[5][1][1]: expected a number or "p/q", got "y"',
        'scene.json:10:33 obstacles[6]: key "outer" is missing; add it',
        "scene.json:10:43 obstacles[6].holes: expected a list, got 5",
        "scene.json:12:13 bounds: [0, 0, 0, 5] is empty; "
        "give [xmin, ymin, xmax, ymax] with xmin < xmax and ymin < ymax",
        'scene.json:13:19 start[2]: expected radians, "90deg" or {"tau": "p/q"}, got "abc"',
        "scene.json:13:35 goal: expected [x, y, theta], or [x, y] for any theta, got [0]",
        "scene.json:13:63 workspace.outer: outer ring: 0 points; give at least 3",
        "scene.json:14:18 check.a: -Infinity is not finite; give a finite number",
        "scene.json:15:25 source.licence: expected text in quotes, got 5",
    ]
    lines = text.split("\n")
    for place in found:
        line, column = map(int, place.split(" ")[0].split(":")[1:])
        assert lines[line - 1][column - 1] not in " ,:", place


def test_the_error_carries_its_problems(tmp_path: Path) -> None:
    with pytest.raises(InvalidFileError) as caught:
        read(tmp_path, '{"robot":\n [], "note": 7}')
    error = caught.value
    assert (error.path, error.line, error.column) == (str(tmp_path / "scene.json"), 2, 2)
    assert [(problem.line, problem.column, problem.place) for problem in error.problems] == [
        (2, 2, "robot"),
        (2, 14, "note"),
    ]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "1:1 the file is empty; give a scene in JSON"),
        ("\n \n", "the file is empty; give a scene in JSON"),
        ('{"robot": {"outer": [[0, 0],', "1:29 the file ends in the middle of a value; is it complete?"),
        ('{"robot": {"outer": [[0, 0], "1/', "1:30 the file ends in the middle of a value; is it complete?"),
        (f'{{"robot": {TRIANGLE},}}', '1:47 expected a "key", got }; remove the comma before it'),
        ('{"robot": {"outer": [[0, .5]]}}', "1:26 expected a value, got .5; write a digit before the point"),
        ("{'robot': 1}", 'expected a "key", got \'robot\':; use double quotes "'),
        ("// scene\n{}", "1:1 expected a value, got //; JSON has no comments, use the note"),
        ('{"robot" 1}', "1:10 expected ':' delimiter, got 1"),
        (f'{{"robot": {TRIANGLE}}} x', "1:48 expected the end of the file, got x"),
        ('{"name": "a\tb"}', "1:12 invalid control character in a string; escape it as JSON does"),
        ('{"name": "\\x"}', "1:11 invalid \\escape in a string; escape it as JSON does"),
        ("null", '1:1 expected a scene {"robot": ..., "obstacles": [...]}, got null'),
        ("[]", '1:1 expected a scene {"robot": ..., "obstacles": [...]}, got []'),
        ("{}", '1:1 key "robot" is missing; add it'),
        (b"\x89PNG\r\n\x1a\n", "1:1 byte 0x89 is not UTF-8; save the file as UTF-8 text"),
        (b"{}\n \xff", "2:2 byte 0xff is not UTF-8; save the file as UTF-8 text"),
        ('{"robot": "\\ud800"}', '"\\ud800"'),
        (f'{{"robot": {TRIANGLE}, "name": "\\ud800"}}', "name: expected text without halves of surrogate pairs"),
        (f'{{"robot": {TRIANGLE}, "check": {{"\\ud800": 1}}}}', "there is half a surrogate pair"),
        (f'{{"robot": {TRIANGLE}, "check": {{"a": 1e400}}}}', "too large for a double"),
        (f'{{"robot": {TRIANGLE}, "check": {{"a": {"[" * 50}{"]" * 50}}}}}', "nested more than 32 deep"),
        (f'{{"robot": {TRIANGLE}, "start": [0, 0, 1e999]}}', "start[2]: theta: "),
        (f'{{"robot": {TRIANGLE}, "start": [0, 0, {{"tau": true}}]}}', "start[2]: "),
        (f'{{"robot": {TRIANGLE}, "start": [0, 0, {{"sin": 1}}]}}', "start[2]: expected radians"),
        ('{"robot": {"outer": [[0, 1e99999999999999999999], [1, 0], [0, 1]]}}', "robot.outer[0][1]: "),
    ],
)
def test_broken_files_get_one_clear_message(text: str | bytes, expected: str, tmp_path: Path) -> None:
    (found,) = faults(tmp_path, text)
    assert expected in found


@pytest.mark.slow
@pytest.mark.parametrize(
    "text",
    [
        "[" * 1_000_000,
        '{"robot": ' + "[" * 1_000_000 + "]" * 1_000_000 + "}",
        '{"robot": ' + '{"a":' * 300 + "1" + "}" * 300 + "}",
        '{"robot": "' + "a" * 10_000_000 + '"}',
        '{"robot": "' + "a" * 10_000_000,
        '{"' + "a" * 10_000_000 + '": 1, "robot": {"outer": []}}',
        '{"robot": {"outer": [[0, 0], [' + "1" * 10_000_000 + ', 0], [0, "' + "1" * 10_000_000 + '"]]}}',
        '{"robot": {"outer": [' + ", ".join(["[true, null]"] * 5_000) + "]}}",
    ],
    ids=["open", "deep", "objects", "long", "unterminated", "key", "number", "many"],
)
def test_monstrous_files_are_refused_briefly(text: str, tmp_path: Path) -> None:
    found = faults(tmp_path, text)
    assert len(found) <= 51
    assert all(len(line) < 400 for line in found)


def test_missing_files_and_directories_are_refused(tmp_path: Path) -> None:
    for path, words in ((tmp_path, "directory"), (tmp_path / "none.json", "No such file"), ("a\0b", "null")):
        with pytest.raises(FormatError, match=words):
            load_scene(path)


@pytest.mark.slow
def test_mutated_files_raise_format_errors_only(tmp_path: Path) -> None:
    rng = random.Random(5)
    seeds = {
        "a.json": (ROOT / "examples/scenes/degenerate_two_part_robot.json").read_bytes(),
        "b.json": (ROOT / "examples/scenes/degenerate_workspace.json").read_bytes(),
        "c.geojson": GEOJSON.encode(),
        "d.wkt": WKT.encode(),
    }
    pieces = (*(bytes([c]) for c in b'[]{},:"-()#/\xff'), b"NaN", b"1e9", b"null", b"\\u", b"Z", b"\n")
    refused = 0
    for name, seed in seeds.items():
        for _ in range(500):
            mutant = bytearray(seed)
            for _ in range(rng.randint(1, 4)):
                at, end = sorted(rng.randrange(len(mutant) + 1) for _ in range(2))
                end = min(end, at + rng.choice((0, 1, 10, 100)))
                mutant[at:end] = rng.choice((*pieces, b"", mutant[at:end] * 2, seed[at:end][::-1]))
            try:
                read(tmp_path, bytes(mutant), name)
            except FormatError as error:
                refused += 1
                assert str(error).startswith(f"{tmp_path / name}:")
                str(error).encode()
    assert refused > 1000


@pytest.mark.slow
@given(
    st.recursive(
        st.none() | st.booleans() | st.integers() | st.text(max_size=5),
        lambda part: st.lists(part, max_size=4) | st.dictionaries(st.text(max_size=5), part, max_size=4),
        max_leaves=20,
    ),
    st.sampled_from([None, 1, "\t"]),
)
@settings(max_examples=200, deadline=None)
def test_places_agree_with_the_decoder(value: object, indent: int | str | None) -> None:
    text = json.dumps(value, indent=indent, ensure_ascii=False)
    for path, place in places(text):
        part = value
        for step in path:
            part = part[step]  # type: ignore[index]
        assert json.loads(text[place.start : place.end]) == part
        assert not place.repeated
        if path and isinstance(path[-1], str):
            assert json.loads(text[place.key : place.start].rstrip(": \t\n")) == path[-1]


# saving


@given(st.fractions() | st.floats(allow_nan=False, allow_infinity=False).map(Fraction))
def test_numbers_are_written_exactly(value: Fraction) -> None:
    written = json.loads(number_text(value), parse_float=Decimal)
    assert Fraction(written) == value


@given(
    st.floats(-1e6, 1e6) | st.sampled_from([k * math.pi / 2 for k in range(-4, 5)]),
    st.fractions(max_denominator=1000),
)
@settings(deadline=None, max_examples=50)
def test_poses_survive_saving(tmp_path_factory: pytest.TempPathFactory, theta: float, tau: Fraction) -> None:
    path = tmp_path_factory.mktemp("poses") / "scene.json"
    scene = Scene(robot=[(0, 0), (1, 0), (0, 1)], start=(0.1, 0, theta), goal=(0, 0, {"tau": tau}))
    save(scene, path)
    again = load_scene(path)
    assert again == scene
    assert again.start is not None
    assert scene.start is not None
    assert again.start.theta == pytest.approx(scene.start.theta, abs=1e-15)


def test_saving_keeps_everything(tmp_path: Path) -> None:
    scene = Scene(
        robot=[[(0, 0), (1, 0), (0, 1)], [("1/3", 0), (0.1, 1e-150), (0, 10**149)]],
        obstacles=[Polygon([(0, 0), (9, 0), (0, 9)], [[(1, 1), (1, 2), (2, 1)], [(3, 3), (3, 4), (4, 3)]])],
        obstacle_names=['quoted "wall" \u2603'],
        workspace=[(-9, -9), (9, -9), (0, 9)],
        bounds=("-1/3", 0, 0.1, 1),
        start=(0, 0, "45deg"),
        goal=("1/7", 0, {"tau": "inf"}),
        units="m",
        name="all",
        note="two\nlines",
        source={"licence": "MIT"},
        check={"free": True, "clearance": 0.25, "list": [1, None, {"a": "b"}]},
    )
    save(scene, tmp_path / "scene.json")
    assert load_scene(tmp_path / "scene.json") == scene


def test_saving_is_all_or_nothing(tmp_path: Path) -> None:
    path = tmp_path / "scene.json"
    save(Scene(robot=[(0, 0), (1, 0), (0, 1)]), path)
    before = path.read_text()
    with pytest.raises(UnicodeEncodeError):
        save(Scene(robot=[(0, 0), (1, 0), (0, 1)], name="\ud800"), path)
    assert path.read_text() == before
    assert os.listdir(tmp_path) == ["scene.json"]


def test_saving_follows_links_and_keeps_permissions(tmp_path: Path) -> None:
    target, link = tmp_path / "scene.json", tmp_path / "link.json"
    target.write_text("old")
    target.chmod(0o640)
    link.symlink_to(target)
    save(Scene(robot=[(0, 0), (1, 0), (0, 1)]), link)
    assert link.is_symlink()
    assert target.stat().st_mode & 0o777 == 0o640
    assert load_scene(target) == load_scene(link)


@pytest.mark.parametrize("name", ["scene.wkt", "scene.Yaml", "scene.stl", "scene.npz", "scene.jsonl", "scene"])
def test_scenes_are_not_written_as_everything(name: str, tmp_path: Path) -> None:
    with pytest.raises(UnsupportedError, match=f"{name}: no scene format; name the file .json, .geojson, .svg or .dxf"):
        save(Scene(robot=[(0, 0), (1, 0), (0, 1)]), tmp_path / name)
    assert not list(tmp_path.iterdir())


# files of other kinds


def test_an_answer_given_as_a_scene_is_one_line_that_says_so(tmp_path: Path) -> None:
    answers = {"path": '"motions": []', "separated": '"surface": []', "all separated": '"proofs": []'}
    for kind, rest in answers.items():
        assert faults(tmp_path, f'{{"answer": "{kind}", {rest}, "start": [0, 0, 0]}}') == [
            "scene.json: an answer of cfree plan, no scene; give the scene that it is for"
        ]


def test_a_scene_given_as_an_answer_is_one_line_that_says_so() -> None:
    with pytest.raises(
        FormatError, match=r"^[^\n]*flat.json: a scene, no answer; give a file that cfree plan -o wrote$"
    ):
        load_answer(ROOT / "examples/scenes/flat.json")


def test_a_boundary_given_as_a_scene_is_one_line_that_says_so(tmp_path: Path) -> None:
    save(cfree.boundary(Scene([(0, 0), (1, 0), (0, 1)])), tmp_path / "b.npz")
    with pytest.raises(FormatError, match=r"^[^\n]*b.npz: a boundary or free space, no scene; give the scene"):
        load_scene(tmp_path / "b.npz")


def test_an_image_given_as_a_scene_names_the_yaml_beside_it(tmp_path: Path) -> None:
    for name in ("map.pgm", "plan.PNG"):
        image = tmp_path / name
        image.write_bytes(b"P5 1 1 255 0")
        for reader in (load_scene, cfree.load, cfree.load_shapes):
            with pytest.raises(FormatError, match=f"{name}: an image; .* a YAML file with the line image: {name}$"):
                reader(image)
        other = tmp_path / f"of_{image.stem}.yml"
        other.write_text(f"resolution: 1\nimage: maps/{name}\n")
        with pytest.raises(FormatError, match=f"{name}: an image; give the file that describes it, {other}$"):
            load_scene(image)
        beside = image.with_suffix(".yaml")
        beside.write_text(f"image: {name}")
        with pytest.raises(FormatError, match=f"{name}: an image; give the file that describes it, {beside}$"):
            load_scene(image)


def test_a_file_that_is_not_there_has_no_line_in_it(tmp_path: Path) -> None:
    for reader in (load_scene, cfree.load, load_answer):
        for name in ("none.json", "none.npz", "none.pgm"):
            with pytest.raises(
                FormatError, match=f"none.{name[5:]}: No such file or directory; give the path"
            ) as caught:
                reader(tmp_path / name)
            assert (caught.value.line, caught.value.column) == (None, None)


# rings alone


def test_a_ring_alone_is_a_polygon(tmp_path: Path) -> None:
    ring, shape = "[[0, 0], [1, 0], [0, 1]]", TRIANGLE
    for bare, full in (
        (f'"robot": {ring}', f'"robot": {shape}'),
        (f'"robot": [{ring}, {shape}]', f'"robot": [{shape}, {shape}]'),
        (f'"robot": {shape}, "obstacles": {ring}', f'"robot": {shape}, "obstacles": [{shape}]'),
        (f'"robot": {shape}, "obstacles": [{ring}, {shape}]', f'"robot": {shape}, "obstacles": [{shape}, {shape}]'),
        (f'"robot": {ring}, "workspace": {ring}', f'"robot": {shape}, "workspace": {shape}'),
    ):
        for more in ("", ', "goals": [[1, 1], [2, 2]]'):
            assert read(tmp_path, f"{{{bare}{more}}}") == read(tmp_path, f"{{{full}{more}}}")
    round_one = '{"circle": {"center": [5, 5], "radius": 1}}'
    mixed = read(tmp_path, f'{{"robot": {ring}, "obstacles": [{ring}, {round_one}]}}')
    assert mixed.obstacles[0] == mixed.robot[0] and mixed.curved


@pytest.mark.parametrize(
    ("keys", "fault"),
    [
        ('"robot": [[0, 0], [1, 0], [1, "x"]]', 'robot[2][1]: expected a number or "p/q", got "x"'),
        (f'"robot": {TRIANGLE}, "obstacles": [[0, 0], [1, 0]]', "obstacles: outer ring: 2 points; give at least 3"),
        (
            f'"robot": {TRIANGLE}, "obstacles": [[[0, 0], [9, 9], [9, 0], [0, 9]]]',
            "obstacles[0]: outer ring: edges 0 and",
        ),
        (
            f'"robot": {TRIANGLE}, "obstacles": [[[[0, 0], [1, 0], [0, 1]]]]',
            "obstacles[0][0]: expected a point [x, y], got",
        ),
        (
            f'"robot": {TRIANGLE}, "workspace": [[0, 0], [1e200, 0], [0, 1]]',
            "workspace: the coordinate 1e200 is larger",
        ),
        ('"robot": []', "robot: expected a polygon"),
    ],
)
def test_faults_of_rings_alone_have_their_places(tmp_path: Path, keys: str, fault: str) -> None:
    (found,) = faults(tmp_path, f"{{{keys}}}")
    assert found.startswith("scene.json:1:") and fault in found


# documents


def test_the_schema_is_that_of_the_models() -> None:
    from cfree.formats.scenes.scene_format import SceneModel

    written = json.loads((ROOT / "docs" / "scene.schema.json").read_text())
    meant = SceneModel.model_json_schema()
    assert written.pop("$schema") and written == meant


def test_examples_in_the_format_document_load(tmp_path: Path) -> None:
    document = (ROOT / "docs" / "scene-format.md").read_text()
    blocks = [block.split("```")[0] for block in document.split("```json\n")[1:]]
    assert [len(read(tmp_path, block).obstacles) for block in blocks] == [2, 5, 0, 1]
    assert doctest.testfile(str(ROOT / "docs" / "scene-format.md"), module_relative=False) == (0, 7)
    wkt = document.split("```\nrobot:")[1].split("```")[0]
    assert len(read(tmp_path, f"robot:{wkt}", "map.wkt").obstacles) == 3


def test_degrees_may_have_their_sign(tmp_path: Path) -> None:
    shapes = '"robot": {"outer": [[0, 0], [1, 0], [0, 1]]}, "obstacles": []'
    text = f'{{{shapes}, "start": [0, 0, "90°"], "goal": [0, 0, "-22.5 °"]}}'
    scene = read(tmp_path, text, "scene.json")
    assert (scene.start, scene.goal) == (Pose(0, 0, "90deg"), Pose(0, 0, "-22.5deg"))


@pytest.mark.parametrize("angle", ["90", "-90", "1e3", "22/3"])
def test_a_quoted_angle_of_more_than_a_turn_needs_its_unit(tmp_path: Path, angle: str) -> None:
    refused = f'{{"robot": {TRIANGLE}, "start": [0, 0, "{angle}"]}}'
    fault = f"start[2]: theta: {angle} is more than a whole turn in radians; write {angle}deg or {angle}rad"
    (found,) = faults(tmp_path, refused)
    assert found.endswith(fault)
    for unit in ("deg", "rad", " rad"):
        scene = read(tmp_path, f'{{"robot": {TRIANGLE}, "start": [0, 0, "{angle}{unit}"]}}')
        assert scene.start == Pose(0, 0, f"{angle}{unit}")


def test_numbers_of_radians_are_as_large_as_they_are(tmp_path: Path) -> None:
    scene = read(tmp_path, f'{{"robot": {TRIANGLE}, "start": [0, 0, 90], "goal": [0, 0, "6.28"]}}')
    assert (scene.start, scene.goal) == (Pose(0, 0, 90), Pose(0, 0, "6.28"))
