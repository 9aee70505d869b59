"""The Euler characteristic from slices, and `deep`: components and holes between critical angles, and at them."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import cfree.verify
from cfree import Boundary, Polygon, Scene, boundary, load_scene
from cfree.verify.euler import Outlines, after, critical_turns, euler_from_slices, touching
from cfree.verify.surfaces import Turn
from cfree.verify.trapezoids import Reader
from cfree.verify.world import World
from examples import FOLDER, POLYGONS
from regluing import exchanged, reglued

CASES = Path(__file__).parents[1] / "cases"
LARGE = [
    "benchmr_parking1",
    "benchmr_warehouse",
    "flat",
    "nest_shirts",
    "nest_swim",
    "parking_bay",
    "sofa_corner",
    "street_Berlin",
]
SQUARE = [(0, 0), (2, 0), (2, 2), (0, 2)]


def reader_of(result: Boundary) -> Reader:
    contacts = result.contact_kind, result.contact_robot, result.contact_obstacle
    return Reader(result.scene, contacts, result.trapezoids, result.isolated)


def check(scene: Scene) -> None:
    result = boundary(scene, threads=1)
    total, slices = euler_from_slices(reader_of(result))
    assert slices >= 2 and total == result.complex.euler.sum()


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("path", [p for p in POLYGONS if p.stem not in LARGE], ids=lambda path: path.stem)
def test_slices_have_the_euler_characteristic_of_the_surfaces_on_all_small_example_scenes(path: Path) -> None:
    check(load_scene(path))


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "count"),
    [
        ("flat", 3),
        ("nest_shirts", 2),
        ("nest_swim", 1),
        ("parking_bay", 1),
        ("street_Berlin", 3),
    ],
)
def test_slices_have_the_euler_characteristic_of_the_surfaces_in_parts_of_large_example_scenes(
    name: str, count: int
) -> None:
    whole = load_scene(FOLDER / f"{name}.json")
    check(Scene(whole.robot, sorted(whole.obstacles, key=lambda shape: len(shape.vertices))[:count]))


@pytest.mark.slow
@pytest.mark.parametrize("folder", ["fits", "tangencies", "bounds", "symmetry"])
def test_slices_have_the_euler_characteristic_of_the_surfaces_where_much_is_degenerate(folder: str) -> None:
    for path in sorted((CASES / folder).glob("*.json")):
        result = boundary(load_scene(path), threads=1)
        if len(result.trapezoids) < 80:
            total, _ = euler_from_slices(reader_of(result))
            assert total in (None, result.complex.euler.sum()), path.stem


def test_components_and_holes_of_a_slice() -> None:
    ring = Polygon([(0, 0), (6, 0), (6, 6), (0, 6)], [[(1, 1), (1, 5), (5, 5), (5, 1)]])
    scene = Scene([(0, 0), (1, 0), (0, 1)], [ring, [(20, 0), (22, 0), (21, 2)]])
    world, upright = World(scene), Turn.of(0, Fraction(0))
    assert Outlines(world, upright).characteristic == 1  # two components, one hole
    assert Outlines(World(Scene(scene.robot, scene.obstacles[1:])), upright).characteristic == 1


def test_obstacles_that_only_touch_in_a_pose_count_as_apart() -> None:
    # a unit square just fits between two corners upright, and easily just before and after
    robot = [(0, 0), (1, 0), (1, 1), (0, 1)]
    corners = Scene(robot, [[(0, 0), (-2, 0), (-2, -2), (0, -2)], [(1, 1), (3, 1), (3, 3), (1, 3)]])
    upright = Outlines(World(corners), Turn.of(0, Fraction(0)))
    assert [touching(upright, point) for point in upright.pinches] == [1]
    check(corners)


def test_obstacles_that_meet_after_they_touch_are_told_from_those_that_do_not() -> None:
    world = World(load_scene(FOLDER / "five_convex.json"))
    turned = Outlines(world, Turn.of(1, Fraction(0)))  # a hole begins in one pose, and obstacles only touch in another
    assert sorted(touching(turned, point) for point in turned.pinches) == [0, 1]


def test_sheets_without_width_are_left_to_others() -> None:
    result = boundary(load_scene(CASES / "bounds" / "sheets_on_a_wall.json"), threads=1)
    assert euler_from_slices(reader_of(result))[0] is None
    found = cfree.verify.boundary(result, slices=0, deep=True)
    assert found.verified and [(c.name, c.how) for c in found.checks[-2:]] == [
        ("Euler by slices", "SKIPPED"),
        ("Gauss map", "MEASURED"),
    ]


def test_critical_angles_follow_each_other_around_the_circle() -> None:
    result = boundary(load_scene(FOLDER / "paper_fig9.json"), threads=1)
    turns = critical_turns(reader_of(result))
    between = [after(turn, following) for turn, following in zip(turns, [*turns[1:], turns[0]], strict=True)]
    angles = [
        float(2 * np.arctan(float(t.root.lo)) + np.pi * t.chart)
        for pair in zip(turns, between, strict=True)
        for t in pair
    ]
    assert angles == sorted(angles) and len(set(angles)) == len(angles)


def test_deep_verification_counts_euler_numbers_in_two_more_ways() -> None:
    found = cfree.verify.boundary(boundary(load_scene(FOLDER / "degenerate_workspace.json")), slices=0, deep=True)
    assert (
        found.verified
        and "together -8" in found.checks[-2].extent
        and "half its Euler number" in found.checks[-1].extent
    )


def test_deep_verification_refutes_a_wrong_gluing(monkeypatch: pytest.MonkeyPatch) -> None:
    result = boundary(load_scene(FOLDER / "degenerate_island.json"), threads=1)
    cells = result.complex
    a, b = np.flatnonzero(cells.side == 1)[[0, 9]]
    monkeypatch.setitem(result.__dict__, "complex", reglued(cells, exchanged(cells, int(a), int(b))))
    monkeypatch.setattr("cfree.verify.driver.read_boundary", lambda path: result)
    found = cfree.verify.boundary("any", slices=0, deep=True)
    assert {finding.kind for finding in found.findings} == {"Gauss map"}


def test_deep_verification_refutes_a_count_that_slices_do_not_have(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("cfree.verify.driver.euler_from_slices", lambda reader, report: (2, 4))
    found = cfree.verify.boundary(boundary(load_scene(FOLDER / "paper_fig9.json")), slices=0, deep=True)
    assert [str(finding) for finding in found.findings] == [
        "Euler by slices: all surfaces: 2 by slices, 0 by V - E + F"
    ]


def test_deep_verification_needs_every_trapezoid() -> None:
    found = cfree.verify.boundary(boundary(Scene(SQUARE, [SQUARE])), slices=0, sample=3, deep=True)
    assert [check.how for check in found.checks[-2:]] == ["SKIPPED", "SKIPPED"]
