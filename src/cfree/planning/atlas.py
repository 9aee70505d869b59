"""Rooms and portals of a scene with many obstacles: those of a folder are in files, those of others made on the way."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

from cfree.collision.motion import Motion
from cfree.collision.pose_checker import PoseChecker
from cfree.planning.portals import Borders, Ground, Key, Portal, portals_of
from cfree.planning.rooms import Rooms

Ways = dict[tuple[Key, Key, int], tuple[Motion, ...]]
"""Motions between two portals, by both and the room."""


@dataclass
class Entry:
    """Portals of a room.

    Attributes
    ----------
    portals : list of Portal
    parts : list of int
        For each of them the part of the room that it leads to; those of one part are joined within the room.
    """

    portals: list[Portal]
    parts: list[int]
    _beside: dict[Key, list[Portal]] = field(init=False)

    def __post_init__(self) -> None:
        by_part: dict[int, list[Portal]] = {}
        for portal, part in zip(self.portals, self.parts, strict=True):
            by_part.setdefault(part, []).append(portal)
        self._beside = {p.key: by_part[part] for p, part in zip(self.portals, self.parts, strict=True)}

    def beside(self, key: Key) -> list[Portal]:
        """All portals of the part that one leads to."""
        return self._beside[key]


class Atlas(Protocol):
    """Rooms and portals of a scene.

    Attributes
    ----------
    rooms : Rooms
    ground : Ground
    ways : Ways
        Motions that have been planned.
    """

    rooms: Rooms
    ways: Ways

    @property
    def ground(self) -> Ground: ...

    def entry(self, room: int) -> Entry:
        """Return the portals of a room."""


class LazyAtlas:
    """Portals made where a route looks for them; all portals of a room count as joined until a plan refutes it.

    Parameters
    ----------
    ground : Ground
    rooms : Rooms
    """

    def __init__(self, ground: Ground, rooms: Rooms) -> None:
        self.ground, self.rooms = ground, rooms
        self.ways: Ways = {}
        self._entries: dict[int, Entry] = {}
        self._borders: Borders = {}

    def entry(self, room: int) -> Entry:
        """Return the portals of a room."""
        if room not in self._entries:
            box = self.rooms.box(room)
            checker = PoseChecker(self.ground.part(self.ground.near(box), None))
            portals = portals_of(self.rooms, room, checker, self.ground.radius, self._borders)
            self._entries[room] = Entry(portals, [0] * len(portals))
        return self._entries[room]
