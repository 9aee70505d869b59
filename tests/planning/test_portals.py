"""Portals: free poses on the borders between rooms, and what they join."""

from __future__ import annotations

import numpy as np

from cfree import PoseChecker, Scene
from cfree.planning.portals import TAUS, THETAS, Portal, parts_of, portals_of
from cfree.planning.rooms import Rooms

ROBOT = [(-2, -0.5), (2, -0.5), (2, 0.5), (-2, 0.5)]
ROOMS = Rooms(np.array([(-10.0, -10, 0, 10), (0.0, -10, 10, 10)]), np.array([(0.0, 0)]), np.array([(~0, ~1)]))
WALL = [[(-0.25, -12), (0.25, -12), (0.25, -3), (-0.25, -3)], [(-0.25, 2), (0.25, 2), (0.25, 12), (-0.25, 12)]]
BOX = (-10, -10, 10, 10)


def portals(scene: Scene, room: int = 0) -> list[Portal]:
    return portals_of(ROOMS, room, PoseChecker(scene), 2.1, {})


def test_a_door_has_one_portal_the_same_from_both_sides() -> None:
    scene = Scene(ROBOT, WALL)
    (portal,) = portals(scene)
    assert portals(scene, 1) == [portal] and portal.key == (0, 1, 0) and portal.beyond(0) == 1
    assert portal.x == 0 and -3 < portal.y < 2
    assert PoseChecker(scene).is_free(portal.pose)


def test_a_wall_without_a_door_has_none() -> None:
    assert portals(Scene(ROBOT, [[(-0.25, -12), (0.25, -12), (0.25, 12), (-0.25, 12)]])) == []


def test_a_narrow_door_is_crossed_in_the_orientation_that_fits() -> None:
    low, high = [(-3, -12), (3, -12), (3, -1), (-3, -1)], [(-3, 0.5), (3, 0.5), (3, 12), (-3, 12)]
    assert [(portal.turn, portal.y) for portal in portals(Scene(ROBOT, [low, high]))] == [(0, -0.25), (8, -0.25)]


def test_a_long_open_border_has_portals_along_it() -> None:
    rooms = Rooms(np.array([(-99.0, 0, 0, 500), (0.0, 0, 99, 500)]), ROOMS.cuts, ROOMS.halves)
    places = [portal.y for portal in portals_of(rooms, 0, PoseChecker(Scene(ROBOT)), 2.0, {})]
    assert len(places) > 10 and max(np.diff([0, *places, 500])) < 60


def test_orientations_are_a_16th_of_a_turn_apart() -> None:
    assert len(TAUS) == 16
    assert np.allclose(THETAS, np.arange(16) * np.pi / 8, atol=0.03)


def test_portals_are_parted_as_the_free_space_of_the_room_is() -> None:
    apart = Portal((0, 1, 0), 5.0, 5.0, 0), Portal((0, 1, 1), 5.0, -5.0, 0), Portal((0, 1, 2), 6.0, 5.5, 4)
    wall = [(-20, -0.5), (20, -0.5), (20, 0.5), (-20, 0.5)]
    parts = parts_of(Scene(ROBOT, [wall], bounds=BOX), [*apart]).tolist()
    assert parts[0] == parts[2] != parts[1]
    around = parts_of(Scene(ROBOT, [[(x / 10, y) for x, y in wall]], bounds=BOX), [*apart]).tolist()
    assert len(set(around)) == 1
