"""`verify` refutes paths that a vehicle cannot drive, by the least bit; both checkers agree."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import pytest

from cfree import Car, DifferentialDrive, Path, Pose, Rotation, Scene, Translation, is_drivable
from cfree.collision.motion import Motion
from second_opinion import verified_in_a_file

BIT = Fraction(1, 10**30)
SCENE = Scene([(0, 0), (2, 0), (2, 1), (0, 1)], [[(50, 50), (60, 50), (55, 60)]])
HEADING = {"tau": Fraction(1, 3)}
CAR = Car(3, axle=("1/2", "1/2"), heading=HEADING)
AXLE = CAR.frame.inverse()  # the start: the axle is at the origin, and forward is the x axis


def driven(*motions: Motion, vehicle: Any = CAR) -> Path:
    return Path(AXLE, motions, scene=SCENE, vehicle=vehicle)


GOOD = driven(Translation((2, 0)), Rotation((2, 3), {"tau": "1/4"}), Rotation((2, 3), {"tau": "-1/9"}))


def findings(path: Path) -> list[str]:
    return [f"{finding.kind}, {finding.where}: {finding.text}" for finding in verified_in_a_file(SCENE, path).findings]


def test_a_path_that_the_vehicle_can_drive_is_verified() -> None:
    result = verified_in_a_file(SCENE, GOOD)
    assert result.verified and result.proved.endswith("; a car with a turning radius of 3 can drive it.")
    assert is_drivable(GOOD, CAR)


@pytest.mark.parametrize(
    ("path", "why"),
    [
        (driven(Translation((2, BIT))), "motion 0: its vector is not along"),
        (driven(Rotation((BIT, 3), {"tau": "1/4"})), "motion 0: its pole is not on"),
        (driven(Translation((2, 0)), Rotation((2 + BIT, 3), {"tau": "1/4"})), "motion 1: its pole is not on"),
        (driven(Rotation((0, 3 - BIT), {"tau": "1/4"})), "motion 0: its pole is nearer"),
        (driven(Rotation((0, -3 + BIT), {"tau": "1/4"})), "motion 0: its pole is nearer"),
        (driven(Rotation((0, 0), {"tau": "1/4"})), "motion 0: its pole is nearer"),
        (replace(GOOD, vehicle=Car(3 + BIT, CAR.axle, HEADING)), "motion 1: its pole is nearer"),
        (replace(GOOD, vehicle=Car((3 + BIT, 1), CAR.axle, HEADING)), "motion 1: its pole is nearer"),
        (
            replace(GOOD, vehicle=Car(3, (Fraction(1, 2) + BIT, CAR.axle[1]), HEADING)),
            "motion 1: its pole",
        ),
        (replace(GOOD, vehicle=Car(3, CAR.axle, {"tau": Fraction(1, 3) + BIT})), "motion 0: its vector"),
        (replace(GOOD, vehicle=Car(3, CAR.axle, HEADING, "forward")), "motion 2: it goes backward"),
        (
            driven(Translation((-BIT, 0)), vehicle=Car(3, CAR.axle, HEADING, "forward")),
            "motion 0: it goes",
        ),
        (
            driven(Translation((0, 1)), vehicle=DifferentialDrive(CAR.axle, HEADING)),
            "motion 0: its vector",
        ),
    ],
)
def test_a_motion_that_the_vehicle_cannot_do_is_refuted(path: Path, why: str) -> None:
    found = findings(path)
    assert found[0].startswith(f"drivable, {why}") and all(finding.startswith("drivable") for finding in found)
    assert not is_drivable(path, path.vehicle) and is_drivable(path, path.vehicle).motion == int(why[7])  # type: ignore[arg-type]


def test_a_differential_drive_turns_in_place_and_a_car_without_limits_does_not() -> None:
    turn = Rotation((0, 0), {"tau": "inf"})
    assert findings(driven(turn, vehicle=DifferentialDrive(CAR.axle, HEADING))) == []
    assert findings(driven(turn, vehicle=Car(BIT, CAR.axle, HEADING))) != []


@pytest.mark.parametrize(
    ("tau", "radius", "free"), [("1/4", 3, True), ("-1/4", 3, False), ("1/4", -3, False), ("-1/4", -3, True)]
)
def test_a_vehicle_without_reverse_gear_turns_to_both_sides(tau: str, radius: int, free: bool) -> None:
    car = Car(3, CAR.axle, HEADING, "forward")
    path = driven(Rotation((0, radius), {"tau": tau}), vehicle=car)
    assert (findings(path) == []) is free is bool(is_drivable(path, car))


@pytest.mark.parametrize(("tau", "free"), [("inf", True), ("-inf", False)])
def test_half_turns_have_a_gear(tau: str, free: bool) -> None:
    path = driven(Rotation((0, 3), {"tau": tau}), vehicle=Car(3, CAR.axle, HEADING, "forward"))
    assert (findings(path) == []) is free


def test_motions_that_stand_still_can_be_done() -> None:
    assert findings(driven(Translation((0, 0)), Rotation((7, 1), {"tau": 0}))) == []


def test_the_parts_of_a_path_have_gear_radius_length_and_angle() -> None:
    parts = GOOD.driving
    assert [(part.gear, part.radius, part.first, part.last) for part in parts] == [
        ("forward", None, 0, 0), ("forward", 3, 1, 1), ("backward", 3, 2, 2),
    ]  # fmt: skip
    assert (GOOD.cusps, parts[1].curvature, parts[0].length) == (1, 1 / 3, 2)
    assert parts[1].angle > 0 > parts[2].angle


def test_a_path_that_its_vehicle_cannot_drive_has_no_parts() -> None:
    with pytest.raises(ValueError, match="motion 0: it moves the axle point sideways"):
        driven(Translation((0, 1))).driving  # noqa: B018


def test_the_start_alone_can_be_driven() -> None:
    assert findings(Path(Pose(0, 0), [], scene=SCENE, vehicle=CAR)) == []
