"""Rooms and portals of a folder, in files: made after the cells by tasks of their own, and read where a route leads.

``rooms.npz`` has the division. ``portals/000123.npz`` has the portals of 64 rooms that are near each other.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from cfree.collision.pose_checker import PoseChecker
from cfree.distributed.division import Features
from cfree.distributed.shard import Shard, read_shard, write_shard
from cfree.distributed.tasks import Work, opened
from cfree.distributed.tiles import BoxIndex, grown_by
from cfree.errors import FormatError
from cfree.planning.atlas import Entry, LazyAtlas, Ways
from cfree.planning.portals import Borders, Portal, parts_of, portals_of
from cfree.planning.rooms import Box, Ints, Rooms, divided
from cfree.scene.scene import Scene, with_bounds

PORTALS = "portals"
GROUP = 64  # rooms in a file
KEPT = 64  # groups kept in memory


@dataclass
class StoredGround:
    """Obstacles of a folder, and its robot's radius."""

    work: Work

    def __post_init__(self) -> None:
        self.radius = self.work.store.radius

    @cached_property
    def _spans(self) -> BoxIndex:
        return BoxIndex(self.work.division.spans)

    def near(self, box: Box) -> Ints:
        """Obstacles whose boxes are within the robot's radius of a box."""
        return self.among(self.listed(box), box)

    def listed(self, box: Box) -> Ints:
        """Obstacles of all tiles that may have some near a box."""
        lists = [self.work.obstacles(tile) for tile in self.tiles(box)]
        return np.unique(np.concatenate([np.zeros(0, np.int64), *lists]))

    def tiles(self, box: Box) -> list[int]:
        """Tiles that may have obstacles near a box."""
        tiles: list[int] = self._spans.near(np.array([box]), self.radius).tolist()
        return tiles

    def among(self, numbers: Ints, box: Box) -> Ints:
        """Those of some obstacles whose boxes are within the robot's radius of a box."""
        x0, y0, x1, y1 = grown_by(np.array([box]), self.radius)[0].tolist()
        boxes = self.work.store.column("box")[numbers]
        near: Ints = numbers[(boxes[:, 0] <= x1) & (boxes[:, 2] >= x0) & (boxes[:, 1] <= y1) & (boxes[:, 3] >= y0)]
        return near

    def part(self, numbers: Ints, bounds: Box | None) -> Scene:
        """Scene with some of the obstacles."""
        scene = self.work.store.scene(numbers)
        return scene if bounds is None else with_bounds(scene, bounds)


def rooms_of(work: Work) -> Rooms:
    """Divide the plane around the obstacles of a folder."""
    features = Features(work.store)
    edges = features.boxes(features.numbers)
    bounds = work.store.head.bounds
    return divided(edges, work.store.radius, bounds)


def write_rooms(work: Work) -> Rooms:
    """Return the division that is stored in a folder, or else make and store it."""
    try:
        return read_rooms(work)
    except FormatError:
        rooms = rooms_of(work)
        columns = {"boxes": rooms.boxes, "cuts": rooms.cuts, "halves": rooms.halves}
        write_shard(work.folder / "rooms.npz", columns, work.plan["key"])
        return rooms


def read_rooms(work: Work) -> Rooms:
    """Read the division.

    Raises
    ------
    FormatError
        If it is not there, or damaged.
    """
    return Rooms(**read_shard(work.folder / "rooms.npz", work.plan["key"]))


def groups_of(rooms: Rooms) -> range:
    """Numbers of the files of portals."""
    return range(-(-len(rooms) // GROUP))


def portals_task(folder: str, stamp: str, group: int) -> int:
    """Find the portals of some rooms, and what they join; return their number."""
    work = opened(folder, stamp)
    return len(work.make(PORTALS, group, lambda: _portals(work, group))["x"])


def _portals(work: Work, group: int) -> Shard:
    rooms, ground = _rooms(str(work.folder), work.stamp), StoredGround(work)
    numbers = range(group * GROUP, min(len(rooms), (group + 1) * GROUP))
    own = rooms.boxes[numbers.start : numbers.stop]
    x0, y0 = own[:, :2].min(axis=0).tolist()
    x1, y1 = own[:, 2:].max(axis=0).tolist()
    listed = ground.listed((x0, y0, x1, y1))
    first, portals, parts, borders = [0], list[Portal](), [np.zeros(0, np.int64)], Borders()
    for room in numbers:
        box = rooms.box(room)
        scene = ground.part(ground.among(listed, box), box)
        some = portals_of(rooms, room, PoseChecker(scene), ground.radius, borders)
        portals += some
        parts.append(parts_of(scene, some))
        first.append(len(portals))
    return {
        "first": np.array(first),
        "key": np.array([portal.key for portal in portals], np.int64).reshape(-1, 3),
        "x": np.array([portal.x for portal in portals], np.float64),
        "y": np.array([portal.y for portal in portals], np.float64),
        "turn": np.array([portal.turn for portal in portals], np.int8),
        "part": np.concatenate(parts),
    }


@lru_cache(maxsize=2)
def _rooms(folder: str, stamp: str) -> Rooms:
    return read_rooms(opened(folder, stamp))


class StoredAtlas:
    """Rooms and portals in the files of a folder.

    Parameters
    ----------
    work : Work
    """

    def __init__(self, work: Work) -> None:
        self.work, self.ground = work, StoredGround(work)
        self.rooms = read_rooms(work)
        self.ways: Ways = {}
        self._shard = lru_cache(maxsize=KEPT)(self._group)
        self._entry = lru_cache(maxsize=KEPT * GROUP)(self._read)

    def entry(self, room: int) -> Entry:
        """Return the portals of a room."""
        return self._entry(room)

    def _group(self, group: int) -> Shard:
        """Read the portals of a group; if its task was not run, they are made in memory."""
        if not self.work.path(PORTALS, group).exists():
            return _portals(self.work, group)
        return self.work.shard(PORTALS, group)

    def _read(self, room: int) -> Entry:
        group, place = divmod(room, GROUP)
        shard = self._shard(group)
        own = slice(*shard["first"][place : place + 2].tolist())
        columns = (shard[name][own].tolist() for name in ("key", "x", "y", "turn"))
        portals = [Portal((key[0], key[1], key[2]), x, y, turn) for key, x, y, turn in zip(*columns, strict=True)]
        return Entry(portals, shard["part"][own].tolist())


@lru_cache(maxsize=2)
def atlas_of(folder: str, stamp: str) -> StoredAtlas | LazyAtlas:
    """Rooms and portals of a folder; of one that has none, made on the way."""
    work = opened(folder, stamp)
    if (work.folder / "rooms.npz").exists():
        return StoredAtlas(work)
    return LazyAtlas(StoredGround(work), rooms_of(work))
