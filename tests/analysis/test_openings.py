"""Openings of floors: doors are found, and nothing else is."""

from __future__ import annotations

import math

import pytest
import shapely

from cfree.analysis.openings import bar, openings_of, to_walls

ROOM = shapely.box(0, 0, 12, 6)


def wall(x: float, gaps: list[tuple[float, float]], thickness: float = 0.2) -> shapely.Geometry:
    """A wall across the room with gaps from y to y."""
    solid = shapely.box(x, 0, x + thickness, 6)
    for low, high in gaps:
        solid -= shapely.box(x - 1, low, x + thickness + 1, high)
    return solid


def widths(floor: shapely.Geometry, widest: float = 2.0) -> list[float]:
    return [round(math.dist(*segment), 6) for segment in openings_of(floor, widest)]


def test_each_door_is_found_once_whatever_the_thickness_of_its_wall() -> None:
    for thickness in (0.01, 0.2, 1.5):
        assert widths(ROOM - wall(6, [(1, 1.9)], thickness)) == [0.9]


def test_two_doors_between_the_same_rooms_are_both_found() -> None:
    assert widths(ROOM - wall(6, [(1, 1.9), (4, 4.8)])) == [0.8, 0.9]


def test_a_corridor_is_no_opening_but_its_doors_are() -> None:
    corridor = ROOM - shapely.box(0, 2, 12, 2.2) - shapely.box(0, 3.4, 12, 3.6)
    doors = corridor | shapely.box(2, 1.9, 2.9, 2.3) | shapely.box(8, 3.3, 8.8, 3.7)
    assert widths(doors) == [0.8, 0.9]


def test_a_gap_beside_a_small_pillar_is_no_opening() -> None:
    assert widths(ROOM - shapely.box(6, 0.5, 6.2, 0.7)) == []


def test_wider_openings_than_asked_for_are_left_out() -> None:
    floor = ROOM - wall(4, [(1, 1.9)]) - wall(8, [(1, 3.5)])
    assert widths(floor, 1.0) == [0.9] and widths(floor, 3.0) == [0.9, 2.5]


def test_an_oblique_door_is_found() -> None:
    turned = shapely.affinity.rotate(ROOM - wall(6, [(1, 1.9)]), 33, (0, 0))
    assert widths(turned) == [0.9]


def test_a_door_is_found_once_in_spite_of_rounding() -> None:
    """Corners of a turned map differ in the last digits, so that two segments across one door do."""
    doorway = shapely.Polygon([(6, 1), (6.2, 1), (6.2, 1.9), (6, 1.9)])
    for shift in (1e-15, 1e-12, 1e-9):
        jamb = shapely.Polygon([(6, 1), (6.2, 1), (6.2, 0), (6, 0), (6, 0.5), (6 - shift, 1 - shift)])
        floor = ROOM - shapely.box(6, 1.9, 6.2, 6) - jamb | doorway
        assert len(openings_of(floor, 1.2)) == 1
    cells = [shapely.box(k, j, k + 1, j + 1) for k in range(60) for j in range(40)]
    walls = [shapely.box(30, j, 31, j + 1) for j in range(40) if not 18 <= j < 24]
    turned = shapely.affinity.rotate(shapely.MultiPolygon(cells).buffer(0), 17.2, (0, 0))
    for wall_cell in walls:
        turned -= shapely.affinity.rotate(wall_cell, 17.2, (0, 0))
    assert widths(turned, 9.0) == [6]


def test_bars_across_the_openings_part_the_floor() -> None:
    floor = ROOM - wall(4, [(1, 1.9)]) - wall(8, [(1, 1.8), (4, 4.8)])
    shut = floor.difference(shapely.union_all([bar(segment) for segment in openings_of(floor, 1.0)]))
    assert len([part for part in shapely.get_parts(shut) if part.area > 1]) == 3


def test_a_segment_is_moved_to_the_walls() -> None:
    floor = ROOM - wall(6, [(1, 1.9)])
    segment = to_walls(floor, ((6.1, 1.1), (6.1, 1.8)))
    assert segment is not None and math.dist(*segment) == pytest.approx(0.9)
    assert to_walls(floor, ((2, 2), (3, 3))) is None  # far from walls
