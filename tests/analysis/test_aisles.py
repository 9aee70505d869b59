"""Smallest aisles: closed forms, both ends by paths and proofs, and laws."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import pytest

import cfree
from cfree.analysis.aisles import KINDS_WITHOUT_WIDTH

BED = [(-1, "-0.45"), (1, "-0.45"), (1, "0.45"), (-1, "0.45")]
LENGTH, WIDTH = 2.0, 0.9


def holds(interval: Any, value: float) -> bool:
    return bool(interval.lo <= value <= interval.hi <= 1.0101 * interval.lo)


@pytest.mark.slow
def test_a_straight_aisle_is_as_wide_as_the_machine_is_narrow() -> None:
    assert holds(cfree.smallest_aisle(BED, "straight"), WIDTH)
    turned = [cfree.Pose(1, 2, {"tau": "1/3"}).apply_exact([(Fraction(x), Fraction(y))])[0] for x, y in BED]
    assert holds(cfree.smallest_aisle(turned, "straight"), WIDTH)
    sideways = cfree.DifferentialDrive(heading="90deg")
    assert holds(cfree.smallest_aisle(BED, "straight", vehicle=sideways), LENGTH)
    assert holds(cfree.smallest_aisle(cfree.Curved.circle((3, 4), "0.4"), "straight"), 0.8)


def test_half_a_turn_takes_the_diagonal() -> None:
    assert holds(cfree.smallest_aisle(BED, "turn"), math.hypot(LENGTH, WIDTH))


def test_a_corner_takes_half_the_length_and_the_width_at_45_degrees() -> None:
    assert holds(cfree.smallest_aisle(BED, "corner"), (LENGTH / 2 + WIDTH) / math.sqrt(2))


@pytest.mark.slow
def test_a_disc_takes_its_diameter_everywhere() -> None:
    disc = cfree.Curved.circle((0, 0), "0.4")
    for kind in KINDS_WITHOUT_WIDTH:
        assert holds(cfree.smallest_aisle(disc, kind), 0.8)


def test_a_junction_takes_no_more_than_a_corner() -> None:
    angle = [(0, 0), (2, 0), (2, "0.5"), ("0.5", "0.5"), ("0.5", 2), (0, 2)]
    corner, junction = (cfree.smallest_aisle(angle, kind) for kind in ("corner", "junction"))
    assert junction.hi < corner.lo


@pytest.mark.slow
def test_bay_and_door_ask_the_same_from_both_sides() -> None:
    bay = cfree.smallest_aisle(BED, "bay", opening="1.5", tolerance=0.001)
    door = cfree.smallest_aisle(BED, "door", aisle=(bay.hi + bay.lo) / 2, tolerance=0.001)
    assert door.lo == pytest.approx(1.5, rel=0.01) and door.hi == pytest.approx(1.5, rel=0.01)
    wide = cfree.smallest_aisle(BED, "bay", opening="1.0")
    assert wide.lo > bay.hi


@pytest.mark.slow
def test_a_wider_machine_needs_wider_aisles() -> None:
    wider = [(x, Fraction(y) * Fraction(4, 3)) for x, y in BED]
    for kind in ("turn", "corner", "junction"):
        assert cfree.smallest_aisle(BED, kind).lo < cfree.smallest_aisle(wider, kind).hi


def test_the_reference_point_does_not_matter() -> None:
    far = [(x + 7, Fraction(y) + 3) for x, y in BED]
    here, there = (cfree.smallest_aisle(shape, "corner") for shape in (BED, far))
    assert here.lo < there.hi and there.lo < here.hi


@pytest.mark.parametrize("long", [8, 20])
def test_longer_aisles_change_nothing(long: int) -> None:
    """The corner drawn by hand, with legs of any length: a path at `hi`, a proof at `lo`."""
    interval = cfree.smallest_aisle(BED, "corner")
    for width, is_wide in ((interval.hi, True), (interval.lo, False)):
        w = Fraction(width)
        floor = [(-long, -w), (w, -w), (w, long), (0, long), (0, 0), (-long, 0)]
        start, goal = (2 - long, -w / 2, 0), (w / 2, long - 2, "90deg")
        assert isinstance(cfree.plan(cfree.Scene(BED, workspace=floor), start, goal), cfree.Path) is is_wide


def test_a_vehicle_gives_the_heading() -> None:
    ahead, across = (
        cfree.smallest_aisle(BED, "corner", vehicle=cfree.Car(3, axle=("-0.6", 0), heading=heading))
        for heading in ("0deg", "90deg")
    )
    assert holds(ahead, (LENGTH / 2 + WIDTH) / math.sqrt(2)) and holds(across, LENGTH)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"kind": "bay"}, 'opening: missing; kind "bay" needs the width of the opening'),
        ({"kind": "bay", "opening": "0.9"}, "opening: 0.9, and the machine is 0.9 wide; give a larger one"),
        ({"kind": "corner", "opening": 1}, 'opening: not for kind "corner"; leave it out'),
        ({"kind": "straight", "aisle": 1}, 'aisle: not for kind "straight"; leave it out'),
        ({"kind": "door", "aisle": "0.5"}, "aisle: 0.5, and the machine is 0.9 wide; give a larger one"),
        ({"kind": "turn", "tolerance": -1}, "tolerance -1: give a number"),
    ],
)
def test_faults_are_named_with_their_remedy(options: dict[str, Any], said: str) -> None:
    with pytest.raises(ValueError) as caught:
        cfree.smallest_aisle(BED, **options)
    assert str(caught.value).startswith(said)


def test_a_car_without_reverse_gear_is_refused() -> None:
    with pytest.raises(cfree.UnsupportedError, match="vehicle: a car without reverse gear"):
        cfree.smallest_aisle(BED, "turn", vehicle=cfree.Car(1, gears="forward"))
