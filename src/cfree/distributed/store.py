"""A scene as files, so that no process holds all of its obstacles.

``scene.json`` is the scene without obstacles. ``polygons.jsonl`` has the rings of one obstacle a line, with unchanged
coordinates. Columns give the beginning of each line, the box of each obstacle, and its vertices.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain, pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import cfree._core as _core
from cfree.distributed.shard import check_sums, file_sums, read_json, write_json
from cfree.errors import InvalidPolygonError
from cfree.formats.scene_file import load_scene, save_scene
from cfree.polygons.polygon import Polygon, polygon_of
from cfree.scene.core_shapes import core_shapes
from cfree.scene.digest import SceneDigest
from cfree.scene.features import SceneFeatures
from cfree.scene.reading import Note, together
from cfree.scene.scene import Scene, with_obstacles, with_reading

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]
BLOCK = 4_000  # vertices written at a time
COLUMNS: dict[str, tuple[type, int]] = {
    "line": (np.int64, 1),  # beginning of the obstacle's line
    "first": (np.int64, 1),  # its first vertex among all
    "box": (np.float64, 4),  # xmin, ymin, xmax, ymax, rounded
    "xy": (np.float64, 2),  # of vertices, rounded
    "next": (np.int64, 1),  # the vertex after each, in its ring
}
STORED = ("scene.json", "polygons.jsonl", *(f"{name}.bin" for name in COLUMNS))


@dataclass
class SceneStore:
    """Obstacles by their numbers, read when needed.

    Parameters
    ----------
    folder : Path
        Folder that `store_scene` has written.
    """

    folder: Path

    @cached_property
    def head(self) -> Scene:
        """The scene without its obstacles."""
        return load_scene(self.folder / "scene.json")

    @cached_property
    def facts(self) -> dict[str, Any]:
        """Numbers of obstacles and vertices, the common denominator, the box of all vertices times that; and hashes.

        ``scene`` is the hash of the whole scene, ``files`` are those of the other files.
        """
        return read_json(self.folder / "facts.json")

    def check(self) -> None:
        """Check that all files are unchanged.

        Raises
        ------
        FormatError
            If one has changed; the error names the remedy.
        """
        check_sums(self.folder, self.facts["files"])

    def __len__(self) -> int:
        return int(self.facts["obstacles"])

    @property
    def vertices(self) -> int:
        """Number of vertices of all obstacles."""
        return int(self.facts["vertices"])

    def column(self, name: str) -> NDArray[Any]:
        """One of `COLUMNS`, mapped from its file."""
        kind, width = COLUMNS[name]
        file = self.folder / f"{name}.bin"
        if file.stat().st_size == 0:
            return np.zeros((0, width) if width > 1 else 0, kind)
        values = np.memmap(file, kind, mode="r")
        return values.reshape(-1, width) if width > 1 else values

    def polygons(self, numbers: Sequence[int] | Ints) -> list[Polygon]:
        """Some obstacles."""
        begin, obstacles = self.column("line"), []
        with (self.folder / "polygons.jsonl").open("rb") as file:
            for number in numbers:
                file.seek(int(begin[number]))
                core = _core.Polygon.of(json.loads(file.readline()))
                if core is None:
                    raise InvalidPolygonError(f"{file.name}: obstacle {number} cannot be read; store the scene again")
                obstacles.append(polygon_of(core))
        return obstacles

    def features(self, polygons: Sequence[Polygon]) -> SceneFeatures:
        """Features of the scene with these obstacles alone, with the numbers of the whole."""
        box = self.facts["box"]
        whole = _core.WholeScene(self.facts["scale"], box and tuple(box), self.facts["short_part"])
        head = self.head
        robot, obstacles, workspace, bounds = core_shapes(head.robot, polygons, head.workspace, head.bounds)
        return SceneFeatures.of(_core.SceneFeatures(robot, obstacles, workspace, bounds, whole))

    @cached_property
    def rest(self) -> SceneFeatures:
        """Features of robot, workspace and bounds."""
        return self.features([])

    def scene(self, numbers: Sequence[int] | Ints) -> Scene:
        """Scene with some of its obstacles, which are named by their numbers."""
        return with_obstacles(self.head, self.polygons(numbers), [f"obstacle {number}" for number in numbers])

    @cached_property
    def reach(self) -> float:
        """Reach of a feature: no obstacle farther from it changes its patches."""
        return float(np.hypot(*np.ptp(self.rest.robot.xy, axis=0))) * (1 + 1e-9)

    @cached_property
    def radius(self) -> float:
        """Radius of the robot: no point of it is farther from its reference point."""
        return float(np.hypot(*self.rest.robot.xy.T).max()) * (1 + 1e-9)


def store_scene(
    head: Scene, obstacles: Iterable[Polygon], folder: Path, key: str = "", notes: Sequence[Note] = ()
) -> SceneStore:
    """Write a scene to a folder, one obstacle after the other.

    Parameters
    ----------
    head : Scene
        All but the obstacles; those that it has come first.
    obstacles : iterable of Polygon
    folder : Path
        Made if it is not there.
    key : str
        Key of the source of the scene.
    notes : sequence of Note
        Notes about reading the obstacles, complete after the last of them.
    """
    folder.mkdir(parents=True, exist_ok=True)
    digest = SceneDigest(head)
    whole = _core.WholeScene(1, None, 1)
    counts = {"obstacles": 0, "vertices": 0}
    files = {name: (folder / f"{name}.bin").open("wb") for name in COLUMNS}
    try:
        with (folder / "polygons.jsonl").open("wb") as lines:
            for block in _blocks(chain(head.obstacles, obstacles)):
                for polygon in block:
                    whole.add(polygon._handle)
                    digest.add(polygon)
                texts = [_line(polygon) for polygon in block]
                begins = lines.tell() + _sums(map(len, texts))
                lines.writelines(texts)
                columns = {"line": begins[:-1]} | _columns(block, counts["vertices"])
                for name, (kind, _) in COLUMNS.items():
                    files[name].write(np.ascontiguousarray(columns[name], kind).tobytes())
                counts["obstacles"] += len(block)
                counts["vertices"] += len(columns["xy"])
    finally:
        for file in files.values():
            file.close()
    record = together(head.reading, notes)
    save_scene(with_reading(with_obstacles(head, []), record), folder / "scene.json")
    frame = {"scale": whole.scale, "short_part": whole.short_part, "box": whole.box}
    facts = {"key": key, **counts, **frame, "scene": digest.sha256}
    write_json(folder / "facts.json", facts | {"files": file_sums(folder / name for name in STORED)})
    return SceneStore(folder)


def _blocks(obstacles: Iterable[Polygon]) -> Iterator[list[Polygon]]:
    """Obstacles in their order, `BLOCK` vertices or a little more at a time."""
    block: list[Polygon] = []
    vertices = 0
    for polygon in obstacles:
        block.append(polygon)
        vertices += len(polygon)
        if vertices >= BLOCK:
            yield block
            block, vertices = [], 0
    if block:
        yield block


def _columns(block: Sequence[Polygon], vertices: int) -> dict[str, NDArray[Any]]:
    """Compute `COLUMNS` of some obstacles, except for their lines, after so many vertices of others."""
    xy = np.concatenate([polygon.vertices for polygon in block])
    first = _sums(map(len, block))
    rings = [first[k] + np.array(polygon.ring_offsets[:-1]) for k, polygon in enumerate(block)]
    starts = np.concatenate(rings)
    after = np.arange(1, len(xy) + 1)
    after[np.append(starts[1:], len(xy)) - 1] = starts
    low, high = np.minimum.reduceat(xy, first[:-1]), np.maximum.reduceat(xy, first[:-1])
    box = np.concatenate([np.nextafter(low, -np.inf), np.nextafter(high, np.inf)], axis=1)
    return {"first": first[:-1] + vertices, "box": box, "xy": xy, "next": after + vertices}


def _sums(counts: Iterable[int]) -> Ints:
    """Sums before each count, and of all."""
    return np.cumsum([0, *counts])


def _line(polygon: Polygon) -> bytes:
    """Rings of a polygon in JSON, on one line: integers, or quotients of two in quotes."""
    d = polygon.denominator
    points = [f"[{x},{y}]" if d == 1 else f'["{x}/{d}","{y}/{d}"]' for x, y in polygon.numerators]
    rings = (f"[{','.join(points[i:j])}]" for i, j in pairwise(polygon.ring_offsets))
    return f"[{','.join(rings)}]\n".encode("ascii")
