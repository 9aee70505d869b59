"""The rule of effect: decimals of an answer are judged by what they do, and say what may be relied on."""

from __future__ import annotations

import json
from decimal import Decimal
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import cfree.verify
from cfree import FormatError, Path, Pose, Rotation, Scene, Translation, save
from cfree.formats.answers.answer_file import load_answer
from cfree.formats.answers.effect import Effect
from cfree.scene.digest import stamp_of
from moving import TEE, motions, poses, way
from moving import UNIT_SQUARE as SQUARE
from replay import deviation
from shapes import box

paths = st.builds(Path, poses, st.lists(motions, max_size=4))


def read(file: FilePath) -> dict[str, Any]:
    return json.loads(file.read_text(), parse_float=Decimal)  # type: ignore[no-any-return]


def write(file: FilePath, data: Any) -> None:
    """Decimals as they are."""
    text = json.dumps(data, default=lambda value: f"<{value}>")
    file.write_text(text.replace('"<', "").replace('>"', ""))


def file_of(path: Path, folder: FilePath, scene: Scene) -> FilePath:
    save(path, folder / "way.json", scene=scene)
    return folder / "way.json"


def doubles_of(data: dict[str, Any]) -> dict[str, Any]:
    """What is left without exact numbers, and with doubles."""
    motions = [{key: value for key, value in m.items() if key not in ("to", "exact")} for m in data["motions"]]
    kept = {key: data[key] for key in ("answer", "start", "goal")} | {"motions": motions}
    return json.loads(json.dumps(kept, default=float))  # type: ignore[no-any-return]


@pytest.mark.slow
@settings(max_examples=40, deadline=None)
@given(paths, st.integers(-3, 9), st.integers(0, 10**6), st.fractions(0, 50, max_denominator=9))
def test_no_decimals_that_are_read_lead_further_astray_than_the_rule_allows(
    tmp_path_factory: pytest.TempPathFactory, path: Path, power: int, seed: int, away: Fraction
) -> None:
    """Also if every one of them is as wrong as it may be, and the reference point is far from the robot."""
    scene = Scene([(away, 0), (away + 3, 0), (away, 1)])
    file = file_of(path, tmp_path_factory.mktemp("effect"), scene)
    assert deviation(scene, path, file) < 5e-10
    data, by = read(file), Decimal(10) ** (-9 - power)
    for k, motion in enumerate(data["motions"]):
        for j, name in enumerate(("vector", "pole", "to", "angle")):
            if name in motion:
                sign = 1 if (seed >> (k + j)) & 1 else -1
                values = motion[name] if isinstance(motion[name], list) else [motion[name]]
                values = [value + sign * by for value in values]
                motion[name] = values if isinstance(motion[name], list) else values[0]
    write(file, data)
    try:
        load_answer(file)
    except FormatError as error:
        assert "beside the exact" in str(error) and power < 8
    else:
        assert deviation(scene, path, file) <= 1e-9


def test_decimals_have_as_many_digits_as_their_effect_needs(tmp_path: FilePath) -> None:
    """A pole beyond 10^12, map coordinates, and a robot a millimetre long."""
    scene = Scene([(0, 0), ("0.001", 0), (0, "0.001")])
    start = Pose("5000000.123", "-4999999.7", {"tau": "1/3"})
    turns = Rotation(("7e12", "1/3"), {"tau": "1e-13"}), Rotation((5000001, -4999999), {"tau": "1/7"})
    path = Path(start, [turns[0], Translation(("1/3", 1)), turns[1]])
    file = file_of(path, tmp_path, scene)
    assert load_answer(file) == path
    assert deviation(scene, path, file) < 5e-10
    text = file.read_text()
    assert "-5000000.2082254266" in text  # the nearest double is -5000000.208225427
    # what a double keeps of it is not enough: 1e-9 of a millimetre
    write(file, json.loads(text))
    with pytest.raises(FormatError, match=r"beside the exact .* moves the robot by .*, and all decimals may by 1e-12"):
        load_answer(file)


def changed(file: FilePath, place: str, value: str, folder: FilePath) -> FilePath:
    """The file with another number at a place."""
    data = read(file)
    *outer, last = place.split(".")
    target: Any = data
    for step in outer:
        target = target[int(step) if step.isdigit() else step]
    target[int(last) if last.isdigit() else last] = Decimal(value)
    write(folder / "changed.json", data)
    return folder / "changed.json"


FAR = Path(Pose(5000000, 5000000), [Rotation((5000000, 4999000), {"tau": "6e-12"}), Rotation((5000000, 0), "180deg")])


@pytest.mark.parametrize(
    ("place", "value", "message"),
    [
        ("motions.0.angle", "0", r"motions\[0\].angle: 0 beside the exact 1.2E-11 moves the robot by 1.2e-08, "),
        ("motions.1.pole.0", "5000000.005", r"motions\[1\].pole\[0\]: 5000000.005 beside the exact 5000000.0 moves"),
        ("motions.1.to.2", "-3.141592653589793", r"motions\[1\].to\[2\]: -3.1\d* beside the exact 3.14\d* moves"),
        ("motions.0.to.1", "5000000.00000001", r"motions\[0\].to\[1\]: 5000000.00000001 beside the exact 5000000.0 "),
        ("goal.2", "3.1415927", r"goal\[2\]: 3.1415927 beside the exact 3.14159265\d* moves"),
        ("start.0", "4999999.999999998", r"start\[0\]: 4999999.999999998 beside the exact 5000000.0 moves"),
    ],
)  # fmt: skip
def test_differences_with_an_effect_are_refused_however_small(
    tmp_path: FilePath, place: str, value: str, message: str
) -> None:
    file = file_of(FAR, tmp_path, SQUARE)
    assert load_answer(file) == FAR
    with pytest.raises(FormatError, match=message):
        load_answer(changed(file, place, value, tmp_path))


def test_turns_are_counted_and_ends_are_not(tmp_path: FilePath) -> None:
    path = Path(Pose(1, 1, "270deg"), [Rotation((1, 1), "180deg")] * 5)
    file = file_of(path, tmp_path, SQUARE)
    thetas = [float(motion["to"][2]) for motion in read(file)["motions"]]
    assert thetas == pytest.approx([4.71238898 + 3.14159265 * k for k in range(1, 6)])
    write(file, read(file) | {"start": [1, 1, Decimal("-1.5707963267948966")]})  # so is it counted on from there
    with pytest.raises(FormatError, match=r"motions\[0\].to\[2\]"):
        load_answer(file)
    assert load_answer(changed(file_of(path, tmp_path, SQUARE), "goal.2", "-4.71238898038469", tmp_path)) == path


def test_beside_exact_numbers_all_is_there_and_a_number(tmp_path: FilePath) -> None:
    file = file_of(FAR, tmp_path, SQUARE)
    for change, message in (
        (lambda d: d["motions"][0].pop("to"), r'motions\[0\]: key "to" is missing'),
        (lambda d: d.pop("scene"), 'key "scene" is missing'),
        (lambda d: d.pop("decimals"), 'only one of "exact" and "decimals"'),
        (lambda d: d["motions"][1].pop("exact"), r'motions\[1\]: "exact" belongs here'),
        (lambda d: d.pop("exact"), 'only one of "exact" and "decimals"'),
        (lambda d: d["motions"][1].update(angle="180deg"), r'motions\[1\].angle: expected a number, .*got "180deg"'),
        (lambda d: d["motions"][1]["pole"].__setitem__(1, "0"), r"motions\[1\].pole\[1\]: expected a number"),
        (lambda d: d["start"].__setitem__(2, {"tau": "0"}), r"start\[2\]: expected a number"),
        (lambda d: d["scene"].update(sha256="F" * 64), r"scene.sha256: expected 64 digits"),
        (lambda d: d["scene"].update(robot=[0, 0, 0, 1]), r"scene.robot: .* is empty"),
        (lambda d: d.update(decimals="exact"), 'decimals: expected "free" or "approximate"'),
    ):
        data = read(file)
        change(data)
        write(tmp_path / "changed.json", data)
        with pytest.raises(FormatError, match=message):
            load_answer(tmp_path / "changed.json")


def test_repeated_keys_are_refused(tmp_path: FilePath) -> None:
    file = file_of(FAR, tmp_path, SQUARE)
    text = file.read_text()
    for key in ('"goal"', '"angle"', '"tau"', '"version"'):
        at = text.index(key)
        value = text[at:].split("]")[0] + "]" if key == '"goal"' else text[at:].split(",")[0].split("}")[0]
        file.write_text(f"{text[:at]}{value}, {text[at:]}")
        with pytest.raises(FormatError, match=f"key {key} is there twice; keep one"):
            load_answer(file)


# --- what they say of collisions ---

WALL = Scene(
    [(0, 0), (1, 0), (1, 1), (0, 1)], [box(-9, "1.5", 20, 3)[0], box(-9, -3, 20, -1)[0]], bounds=(-1, -1, 9, 1)
)


@pytest.mark.parametrize(
    ("path", "claim"),
    [
        (Path(Pose(0, 0), [Rotation(("1/2", "1/2"), "90deg"), Translation(("1/3", "1/7"))]), "free"),
        (Path(Pose(0, 0), [Translation(("1/3", "0.4999999999"))]), "free"),
        (Path(Pose(0, 0), [Translation(("1/3", "0.5"))]), "approximate"),  # it touches the wall
        (Path(Pose(0, 0), [Translation((3, "-1"))]), "free"),  # also touches, but nothing is rounded
        (Path(Pose(0, 0), [Translation(("1/3", "-0.9999999999999999"))]), "approximate"),  # too near to the bounds
        (Path(Pose("1/3", "1/2"), []), "approximate"),
        (Path(Pose("1/3", "1/4"), []), "free"),
    ],
)
def test_decimals_are_free_if_the_path_keeps_four_times_what_they_are_off(
    tmp_path: FilePath, path: Path, claim: str
) -> None:
    file = file_of(path, tmp_path, WALL)
    data = read(file)
    assert data["decimals"] == claim
    found = cfree.verify.answer(WALL, file)
    assert found.verified and ("decimals are approximate" in found.proved) == (claim == "approximate")
    if claim == "free" and path.motions:
        write(tmp_path / "doubles.json", doubles_of(data))
        assert load_answer(tmp_path / "doubles.json").is_free(cfree.MotionChecker(WALL))
    other = {"free": "approximate", "approximate": "free"}[claim]
    write(file, data | {"decimals": other})
    found = cfree.verify.answer(WALL, file)
    assert found.verified == (other == "approximate")
    assert {finding.kind for finding in found.findings} <= {"decimals"}


def test_the_way_of_a_slide_is_not_in_its_decimals(tmp_path: FilePath) -> None:
    data = read(file_of(way(), tmp_path, TEE))
    assert data["decimals"] == "approximate"
    write(tmp_path / "way.json", data | {"decimals": "free"})
    found = cfree.verify.answer(TEE, tmp_path / "way.json")
    assert [finding.kind for finding in found.findings] == ["decimals"]


def test_numbers_of_maps_that_doubles_do_not_hold_are_approximate(tmp_path: FilePath) -> None:
    """A gap of a nanometre, at 5,000,000 metres."""
    scene = Scene([(0, 0), (1, 0), (1, 1), (0, 1)], box("5000001.333333334", 0, 5000009, 9)[0])
    path = Path(Pose("5000000.1", 0), [Translation(("0.23333333333", "1/3"))])
    file = file_of(path, tmp_path, scene)
    assert read(file)["decimals"] == "approximate" and cfree.verify.answer(scene, file).verified
    assert deviation(scene, path, file) < 5e-10


@pytest.mark.slow
@settings(max_examples=20, deadline=None)
@given(paths, st.fractions(0, 9, max_denominator=10))
def test_what_is_written_as_free_is_verified(tmp_path_factory: pytest.TempPathFactory, path: Path, x: Fraction) -> None:
    scene = Scene([(0, 0), (2, 0), (0, 1)], box(x, -1, x + 1, 9)[0])
    file = file_of(path, tmp_path_factory.mktemp("effect"), scene)
    is_free = path.is_free(cfree.MotionChecker(scene))
    assert cfree.verify.answer(scene, file).verified == is_free
    assert is_free or read(file)["decimals"] == "approximate"


# --- which scene ---


def test_an_answer_for_another_scene_says_so_first(tmp_path: FilePath) -> None:
    file = file_of(Path(Pose(0, 0), [Translation((1, 0))]), tmp_path, WALL)
    parts = {"robot": WALL.robot, "obstacles": WALL.obstacles, "bounds": WALL.bounds}
    same = Scene(**parts, name="other", units="km", start=(0, 0, 0), goal=(1, 0, 0), obstacle_names=["a", "b"])
    assert stamp_of(same) == stamp_of(WALL) and cfree.verify.answer(same, file).verified
    for key, other in (
        ("robot", [(0, 0), (1, 0), (0, 1)]),
        ("obstacles", WALL.obstacles[:1]),
        ("obstacles", WALL.obstacles[::-1]),
        ("bounds", None),
        ("workspace", box(-30, -30, 30, 30)[0]),
    ):
        scene = Scene(**{**parts, key: other})
        (finding,) = cfree.verify.answer(scene, file).findings
        assert (finding.kind, finding.where) == ("scene", "another scene")
        assert cfree.verify.answer(scene, load_answer(file)).verified  # in memory nobody asks
    data = read(file)
    data["scene"]["robot"][2] = "1.0000001"
    write(file, data)
    (finding,) = cfree.verify.answer(WALL, file).findings
    assert (finding.kind, finding.where) == ("scene", "scene.robot")


def test_effect_is_no_less_than_what_happens() -> None:
    """Turned by 0.1 too much about a pole 3 off: the farthest corner moves by both."""
    path = Path(Pose(0, 0), [Rotation((10, 0), "90deg")])
    effect = Effect(path, path.goal, stamp_of(SQUARE))
    exact = {term.place: term.value.middle for term in effect.terms({("start", 2): 0, ("motions", 0, "angle"): 0})}
    wrong = exact | {("motions", 0, "angle"): exact["motions", 0, "angle"] + Fraction(1, 10)}
    assert float(effect.total(wrong)) == pytest.approx(0.1 * (10 + 2))
    wrong = exact | {("motions", 0, "pole", 1): Fraction(3)}
    assert float(effect.total(wrong)) == pytest.approx(3 * 1.5707963)
