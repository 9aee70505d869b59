"""Rooms: a division of the plane around obstacles that covers it, and whose neighbours share borders."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from cfree.planning.rooms import divided

RNG = np.random.default_rng(46)
LOW = RNG.uniform(0, 100, (600, 2))
EDGES = np.concatenate([LOW, LOW + RNG.uniform(0, 3, (600, 2))], axis=1)


@pytest.mark.parametrize("most", [5, 40, 1000])
def test_rooms_cover_the_plane_around_all_edges_once(most: int) -> None:
    rooms = divided(EDGES, 0.25, most=most)
    sides = rooms.boxes[:, 2:] - rooms.boxes[:, :2]
    whole = rooms.boxes[:, 2:].max(axis=0) - rooms.boxes[:, :2].min(axis=0)
    assert np.isclose(sides.prod(axis=1).sum(), whole.prod()) and np.all(sides >= 8 * 0.25)
    assert np.all(rooms.boxes[:, :2].min(axis=0) < EDGES[:, :2].min(axis=0) - 3)
    for x, y in RNG.uniform(0, 100, (50, 2)).tolist():
        inside = [k for k, (x0, y0, x1, y1) in enumerate(rooms.boxes.tolist()) if x0 <= x <= x1 and y0 <= y <= y1]
        assert sorted(rooms.meeting((x, y, x, y))) == inside and len(inside) == 1


def test_neighbours_share_each_border() -> None:
    rooms = divided(EDGES, 0.25, most=20)
    borders = {room: dict(rooms.borders(room)) for room in range(len(rooms))}
    assert len(rooms) > 20
    for room, others in borders.items():
        for other, (x0, y0, x1, y1) in others.items():
            assert borders[other][room] == (x0, y0, x1, y1)
            assert (x0 == x1) != (y0 == y1)


def test_a_border_is_in_the_middle_of_a_street() -> None:
    low = np.array([(x, y) for x in (0, 30) for y in range(0, 100, 2)], float)
    blocks = np.concatenate([low, low + 20], axis=1)
    assert 25 in divided(blocks, 0.5, (0, 0, 50, 118), most=60).boxes[:, 2]


def test_rooms_stay_within_bounds_that_are_no_doubles() -> None:
    bounds = (Fraction(1, 3), Fraction(-1, 3), Fraction(10, 3), Fraction(1, 3))
    x0, y0, x1, y1 = map(Fraction, divided(EDGES[:3], 1, bounds).boxes[0].tolist())
    assert bounds[0] <= x0 and bounds[1] <= y0 and x1 <= bounds[2] and y1 <= bounds[3]


def test_many_long_edges_do_not_divide_rooms_for_ever() -> None:
    long = np.array([(0, k / 10, 1000, k / 10) for k in range(500)])
    assert len(divided(np.concatenate([long, long[:, [1, 0, 3, 2]]]), 0.25)) < 100
