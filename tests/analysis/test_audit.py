"""Audits of floor plans: doors, results with their proofs, missing widths, files and pictures."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import pytest

import cfree
import cfree.verify
from cfree.analysis.audit import Door
from cfree.formats.answers.audit_file import save_audit, save_proofs
from cfree.plot import plot_audit

ROOM = [(0, 0), (12, 0), (12, 6), (0, 6)]


def box(half: Any, thick: Any) -> list[tuple[Any, Any]]:
    return [(f"-{half}", f"-{thick}"), (half, f"-{thick}"), (half, thick), (f"-{half}", thick)]


BED, CHAIR = box("1", "0.45"), box("0.6", "0.35")


def wall(x: int, *gaps: tuple[Any, Any]) -> list[list[tuple[Any, Any]]]:
    """The pieces of a wall with gaps, 0.2 thick."""
    ends = [0, *(end for gap in gaps for end in gap), 6]
    return [
        [(x, low), (f"{x}.2", low), (f"{x}.2", high), (x, high)]
        for low, high in zip(ends[::2], ends[1::2], strict=True)
    ]


def plan_with(*walls: list[list[tuple[Any, Any]]], **more: Any) -> cfree.Scene:
    return cfree.Scene(BED, [piece for one in walls for piece in one], workspace=ROOM, **more)


@pytest.mark.slow
def test_a_door_is_passed_by_the_slim_and_blocked_for_the_wide_with_a_proof() -> None:
    result = cfree.audit(plan_with(wall(6, (2, "2.8"))), {"bed": BED, "chair": CHAIR})
    bed, chair = result.doors
    assert (bed.result, chair.result) == ("blocked", "passes") and result.blocked == (bed,)
    assert bed.missing is not None and bed.missing.lo <= 0.1 <= bed.missing.hi <= 1.02 * bed.missing.lo
    assert bed.width == pytest.approx(0.8) and chair.missing is None and bed.proofs
    for proof in bed.proofs:
        assert cfree.verify.answer(result.machines["bed"], proof).verified


def test_a_door_that_is_wide_enough_is_blocked_if_there_is_no_room_to_turn_into_it() -> None:
    corridor = [[(0, 1), (6, 1), (6, "1.2"), (0, "1.2")], [("7", 1), (12, 1), (12, "1.2"), (7, "1.2")]]
    (door,) = cfree.audit(plan_with(corridor), {"bed": BED}, widest=1.0, missing=False).doors
    assert door.width == pytest.approx(1.0) and door.result == "blocked"  # 1 wide, the bed 0.9, the corridor 1


@pytest.mark.slow
def test_an_opening_exactly_as_wide_as_the_machine_is_passed_by_touching() -> None:
    (door,) = cfree.audit(plan_with(wall(6, (2, "2.9"))), {"bed": BED}).doors
    assert door.result == "passes"


@pytest.mark.slow
def test_another_way_round_is_told_apart_from_the_door_itself() -> None:
    """Two doors between the rooms: the narrow one is not passed, and yet the bed gets there."""
    narrow, wide = cfree.audit(plan_with(wall(6, (1, "1.8"), (3, "4.1"))), {"bed": BED}).doors
    assert (narrow.result, wide.result) == ("around", "passes") and not narrow.proofs


@pytest.mark.slow
def test_the_missing_width_is_that_of_the_door_and_not_of_another_way() -> None:
    doors = cfree.audit(plan_with(wall(6, (1, "1.7"), (3, "3.8"))), {"bed": BED}).doors
    for door, missing in zip(doors, (0.2, 0.1), strict=True):
        assert door.result == "blocked" and door.missing is not None
        assert door.missing.lo <= missing <= door.missing.hi <= 1.02 * door.missing.lo


def test_widths_in_millimetres_have_no_exponent() -> None:
    assert "door, 1050 wide" in str(Door("door", "bot", ((0.0, 0.0), (1050.0, 0.0)), 1050.0, ("a", "b"), "passes"))


def test_places_of_doors_are_told_apart_far_from_the_origin() -> None:
    ends = (500000.25, 5400000.0), (500000.25, 5400000.9)
    assert "0.9 wide at (500000.25, 5400000.45), a - b" in str(Door("W1", "bot", ends, 0.9, ("a", "b"), "passes"))


def test_a_room_too_small_for_the_machine_is_named() -> None:
    closet = [
        [(10, "4.3"), ("10.6", "4.3"), ("10.6", "4.4"), (10, "4.4")],
        [("11.4", "4.3"), (12, "4.3"), (12, "4.4"), ("11.4", "4.4")],
    ]
    closet += [[(10, "4.3"), ("10.1", "4.3"), ("10.1", 6), (10, 6)]]
    doors = cfree.audit(plan_with(closet), {"long": box("2", "0.3")}, missing=False).doors
    assert [door.result for door in doors if abs(door.width - 0.8) < 1e-9] == ["no room"]


def test_doors_given_by_name_are_moved_to_the_walls_and_rooms_are_named() -> None:
    scene = plan_with(wall(4, (2, 3)), wall(8, (2, 3)))
    result = cfree.audit(
        scene, {"chair": CHAIR}, openings={"D1": (("4.1", "2.1"), ("4.1", "2.9"))}, places={"hall": (1, 1)}
    )
    (door,) = result.doors
    assert (door.name, door.rooms[0]) == ("D1", "hall") and door.width == pytest.approx(1.0)
    assert [*result.rooms] == ["room 1", "hall"]


def test_without_a_workspace_there_is_an_outside() -> None:
    walls = [[(0, 0), (6, 0), (6, "0.2"), (0, "0.2")], [(0, 4), (6, 4), (6, "4.2"), (0, "4.2")]]
    walls += [[(0, 0), ("0.2", 0), ("0.2", 4), (0, 4)], [("5.8", 0), (6, 0), (6, "1.5"), ("5.8", "1.5")]]
    walls += [[("5.8", "2.5"), (6, "2.5"), (6, 4), ("5.8", 4)]]
    (door,) = cfree.audit(cfree.Scene(CHAIR, walls)).doors
    assert door.rooms == ("outside", "room 1") and door.result == "passes" and door.machine == "robot"


@pytest.mark.slow
def test_round_machines_and_furniture_are_audited_as_they_are() -> None:
    scene = plan_with(wall(6, (2, "2.8"))).with_obstacle(cfree.Curved.circle((2, 2), "0.3"))
    discs = {name: cfree.Curved.circle((0, 0), radius) for name, radius in (("slim", "0.39"), ("wide", "0.41"))}
    slim, wide = cfree.audit(scene, discs).doors
    assert (slim.result, wide.result) == ("passes", "blocked")
    assert wide.missing is not None and wide.missing.lo <= 0.02 <= wide.missing.hi
    exact = cfree.audit(scene, {"chair": box("0.6", "0.4")}).doors  # slides through
    assert [door.result for door in exact] == ["passes"]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"machines": {}}, "machines: none"),
        ({"places": {"a": (6.1, 1)}}, r"places: a: \(6.1, 1\) is in a wall or outside"),
        ({"places": {"a": (1, 1), "b": (2, 2)}}, "places: b and a are in one room"),
        ({"places": {"a": "north"}}, "places: a: 'north'; give a point"),
        ({"openings": {"d": ((1, 1), (2, 2))}}, r"openings: d: \(1, 1\) to \(2, 2\) does not end near walls"),
        ({"openings": {"d": (1, 2)}}, r"openings: d: \(1, 2\); give two points"),
    ],
)
def test_faults_are_named_with_their_remedy(options: Any, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        cfree.audit(plan_with(wall(6, (2, "2.8"))), **options)


def test_a_plan_without_walls_and_a_car_without_reverse_gear_are_refused() -> None:
    with pytest.raises(ValueError, match="scene: no walls"):
        cfree.audit(cfree.Scene(BED))
    with pytest.raises(cfree.UnsupportedError, match="without reverse gear"):
        cfree.audit(plan_with(vehicle=cfree.Car(1, gears="forward")))


@pytest.mark.slow
def test_files_have_the_doors_the_rooms_and_the_proofs(tmp_path: Path) -> None:
    result = cfree.audit(plan_with(wall(6, (2, "2.8"))), {"a bed": BED, "chair": CHAIR})
    save_audit(result, tmp_path / "doors.csv")
    rows = list(csv.DictReader((tmp_path / "doors.csv").read_text().splitlines()))
    assert [(row["machine"], row["result"]) for row in rows] == [("a bed", "blocked"), ("chair", "passes")]
    assert float(rows[0]["missing_at_least"]) <= 0.1 <= float(rows[0]["missing_at_most"])
    save_audit(result, tmp_path / "doors.geojson")
    features = json.loads((tmp_path / "doors.geojson").read_text())["features"]
    assert [feature["properties"]["role"] for feature in features] == ["door", "door", "room", "room"]
    pairs = save_proofs(result, tmp_path / "proofs")
    assert {pair[0].name for pair in pairs} == {"a-bed-scene.json"} and len(pairs) == len(result.doors[0].proofs)
    for scene, proof in pairs:
        assert cfree.verify.answer(cfree.load_scene(scene), proof).verified
    with pytest.raises(cfree.UnsupportedError, match=r"name the file \.csv or \.geojson"):
        save_audit(result, tmp_path / "doors.txt")


@pytest.mark.slow
def test_a_picture_has_a_panel_for_each_machine() -> None:
    result = cfree.audit(plan_with(wall(6, (2, "2.8"))), {"bed": BED, "chair": CHAIR}, missing=False)
    assert [ax.get_title() for ax in plot_audit(result).axes] == [
        "bed: passes 0 of 1 door",
        "chair: passes 1 of 1 door",
    ]


@pytest.mark.slow
def test_the_flat_has_its_six_doors_and_the_narrow_place_of_its_hall() -> None:
    flat = cfree.load_scene("examples/scenes/flat.json")
    bed, chair = ([d for d in cfree.audit(flat, {"m": m}, missing=False).doors] for m in (BED, CHAIR))
    assert [round(door.width, 2) for door in bed] == [0.75, 0.9, 0.95, 0.95, 1.0, 1.0, 1.05]
    assert [door.result for door in bed] == ["no room", *["blocked"] * 3, "passes", "blocked", "passes"]
    assert {door.result for door in chair if door.width > 0.7} == {"passes"}
