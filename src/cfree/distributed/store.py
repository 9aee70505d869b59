"""A scene as files, so that no process holds all of its obstacles.

``scene.json`` is the scene without obstacles. ``polygons.jsonl`` has the rings of one obstacle a line, with unchanged
coordinates; of a round one, the shape as in a scene. Columns give the beginning of each line, the box of each obstacle,
and its vertices: those of a polygon, or of the rings of a rounded shape's core.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import chain, pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import cfree._core as _core
from cfree.curves.curved import Curved
from cfree.distributed.shard import check_sums, file_sums, read_json, write_json
from cfree.errors import InvalidPolygonError, UnsupportedError
from cfree.formats.scene_file import load_scene, save_scene
from cfree.formats.scenes.curve_text import curved_text
from cfree.polygons.polygon import Polygon, polygon_of
from cfree.scene.complement import complement_among
from cfree.scene.core_shapes import core_shapes
from cfree.scene.digest import SceneDigest
from cfree.scene.features import SceneFeatures, features_of_cores
from cfree.scene.grown_cores import Cores, Rounded
from cfree.scene.reading import Note, together
from cfree.scene.rounded import rounded, why_not_rounded
from cfree.scene.scene import AnyShape, Scene, box_of, robot_radius, with_obstacles, with_reading

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]
Rounding = tuple[Fraction, list[tuple[Fraction, ...]]]
ROUND_VERTICES = 16  # counted for a round obstacle, whatever its arcs
BLOCK = 4_000  # vertices written at a time
ARCS_REACH = 2.0  # radii of a shape's discs by which its arcs reach at most beyond their own radii
COLUMNS: dict[str, tuple[type, int]] = {
    "line": (np.int64, 1),  # beginning of the obstacle's line
    "first": (np.int64, 1),  # its first vertex among all
    "box": (np.float64, 4),  # xmin, ymin, xmax, ymax, rounded
    "xy": (np.float64, 2),  # of vertices, rounded
    "next": (np.int64, 1),  # the vertex after each, in its ring
    "radius": (np.float64, 1),  # among round shapes: contacts of a vertex are not farther from it
    "end": (np.int64, 1),  # among round shapes: the first of an obstacle's ends of arcs among all
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

    @property
    def is_round(self) -> bool:
        """True if there are round shapes."""
        return self.facts["facing"] is not None

    def shapes(self, numbers: Sequence[int] | Ints) -> list[AnyShape]:
        """Some obstacles."""
        begin, obstacles = self.column("line"), list[AnyShape]()
        with (self.folder / "polygons.jsonl").open("rb") as file:
            for number in numbers:
                file.seek(int(begin[number]))
                shape = _shape_of(json.loads(file.readline()))
                if shape is None:
                    raise InvalidPolygonError(f"{file.name}: obstacle {number} cannot be read; store the scene again")
                obstacles.append(shape)
        return obstacles

    def features(self, obstacles: Sequence[AnyShape]) -> SceneFeatures:
        """Features of the scene with these obstacles alone, with the numbers of the whole."""
        facts, head = self.facts, self.head
        box, facing = facts["box"] and tuple(facts["box"]), facts["facing"]
        if facing is None:
            whole = _core.WholeScene(facts["scale"], box, facts["short_part"])
            robot, others, workspace, bounds = core_shapes(head.robot, obstacles, head.workspace, head.bounds)  # type: ignore[arg-type]
            return SceneFeatures.of(_core.SceneFeatures(robot, others, workspace, bounds, whole))
        whole = _core.WholeScene(facts["scale"], box, facts["short_part"], self._robot_roundings, _fractions(facing))
        return features_of_cores(self.cores(obstacles), head, head.bounds, whole)

    def cores(self, obstacles: Sequence[AnyShape]) -> Cores:
        """Cores of the scene with these obstacles alone, and the whole scene's complement of a round workspace."""
        return replace(self._frame, obstacles=(*map(_core_of, obstacles), *self._frame.obstacles))

    @cached_property
    def _robot_roundings(self) -> list[Rounding]:
        return [shape.rounding for shape in self._frame.robot]

    @cached_property
    def complement(self) -> tuple[AnyShape, ...]:
        """The complement of a round workspace, around all obstacles; else nothing."""
        return _complement_of(self.head, self.facts["around"])

    @cached_property
    def _frame(self) -> Cores:
        """The cores of the robot, and of the complement of a round workspace."""
        return _frame_of(self.head, self.complement)

    @cached_property
    def rest(self) -> SceneFeatures:
        """Features of robot, workspace and bounds."""
        return self.features([])

    def scene(self, numbers: Sequence[int] | Ints) -> Scene:
        """Scene with some of its obstacles, which are named by their numbers."""
        return with_obstacles(self.head, self.shapes(numbers), [f"obstacle {number}" for number in numbers])

    @cached_property
    def reach(self) -> float:
        """Reach of a feature: no obstacle farther from it changes its patches."""
        corners = self.rest.robot.xy
        if self.is_round:
            corners = np.array([box_of(part) for part in self.head.robot] + [(0.0,) * 4]).reshape(-1, 2)
        return float(np.hypot(*np.ptp(corners, axis=0))) * (1 + 1e-6)

    @cached_property
    def radius(self) -> float:
        """Radius of the robot: no point of it is farther from its reference point."""
        largest = robot_radius(self.head) if self.is_round else float(np.hypot(*self.rest.robot.xy.T).max())
        return largest * (1 + 1e-9)


def store_scene(
    head: Scene, obstacles: Iterable[AnyShape], folder: Path, key: str = "", notes: Sequence[Note] = ()
) -> SceneStore:
    """Write a scene to a folder, one obstacle after the other.

    Parameters
    ----------
    head : Scene
        All but the obstacles; those that it has come first.
    obstacles : iterable of shapes
        Round ones only if the scene has round shapes without them.
    folder : Path
        Made if it is not there.
    key : str
        Key of the source of the scene.
    notes : sequence of Note
        Notes about reading the obstacles, complete after the last of them.

    Raises
    ------
    UnsupportedError
        If a shape is not rounded, as for `cfree.boundary`.
    """
    folder.mkdir(parents=True, exist_ok=True)
    empty = with_obstacles(head, [])
    digest, blocks = SceneDigest(head), _blocks(chain(head.obstacles, obstacles))
    table = _RoundColumns(empty) if head.curved else _Columns()
    files = {name: (folder / f"{name}.bin").open("wb") for name in COLUMNS}
    try:
        with (folder / "polygons.jsonl").open("wb") as lines:
            for block in blocks:
                texts = [_line(shape) for shape in block]
                begins = lines.tell() + _sums(map(len, texts))
                columns = {"line": begins[:-1]} | table.add(block)
                lines.writelines(texts)
                for shape in block:
                    digest.add(shape)
                for name, values in columns.items():
                    files[name].write(np.ascontiguousarray(values, COLUMNS[name][0]).tobytes())
    finally:
        for file in files.values():
            file.close()
    record = together(head.reading, notes)
    save_scene(with_reading(empty, record), folder / "scene.json")
    facts = {"key": key, **table.facts(), "scene": digest.sha256}
    write_json(folder / "facts.json", facts | {"files": file_sums(folder / name for name in STORED)})
    return SceneStore(folder)


def _blocks(obstacles: Iterable[AnyShape]) -> Iterator[list[AnyShape]]:
    """Obstacles in their order, `BLOCK` vertices or a little more at a time."""
    block: list[AnyShape] = []
    vertices = 0
    for shape in obstacles:
        block.append(shape)
        vertices += len(shape) if isinstance(shape, Polygon) else ROUND_VERTICES
        if vertices >= BLOCK:
            yield block
            block, vertices = [], 0
    if block:
        yield block


class _Columns:
    """Columns of obstacles that are polygons, and facts about all of them."""

    def __init__(self) -> None:
        self.whole = _core.WholeScene(1, None, None)
        self.obstacles = self.vertices = 0

    def add(self, block: Sequence[AnyShape]) -> dict[str, NDArray[Any]]:
        """Return the columns of some more obstacles, except for their lines."""
        polygons: list[Polygon] = []
        for shape in block:
            if not isinstance(shape, Polygon):
                raise UnsupportedError("obstacles of a file are round, and the scene is not; give both in one scene")
            polygons.append(shape)
            self.whole.add(shape._handle)
        xy = np.concatenate([polygon.vertices for polygon in polygons])
        first = _sums(map(len, polygons))
        starts = np.concatenate([first[k] + np.array(p.ring_offsets[:-1]) for k, p in enumerate(polygons)])
        after = np.arange(1, len(xy) + 1)
        after[np.append(starts[1:], len(xy)) - 1] = starts
        low, high = np.minimum.reduceat(xy, first[:-1]), np.maximum.reduceat(xy, first[:-1])
        return self._placed(len(block), first, low, high, xy, after)

    def _placed(self, count: int, first: Ints, low: Floats, high: Floats, xy: Floats, after: Ints) -> dict[str, Any]:
        box = np.concatenate([np.nextafter(low, -np.inf), np.nextafter(high, np.inf)], axis=1)
        before = self.vertices
        self.obstacles, self.vertices = self.obstacles + count, before + len(xy)
        return {"first": first[:-1] + before, "box": box, "xy": xy, "next": after + before}

    def facts(self) -> dict[str, Any]:
        whole = self.whole
        frame = {"scale": whole.scale, "short_part": whole.short_part, "box": whole.box, "facing": None}
        return {"obstacles": self.obstacles, "vertices": self.vertices, **frame}


class _RoundColumns(_Columns):
    """The same of rounded shapes: of the rings of their cores. `empty` is the scene without obstacles."""

    def __init__(self, empty: Scene) -> None:
        super().__init__()
        self.empty, self.ends, self.around = empty, 0, [np.inf, np.inf, -np.inf, -np.inf]
        robot = [rounded(shape) for shape in empty.robot]
        known = Cores(tuple(filter(None, robot)), ())
        if len(known.robot) < len(robot) or None in map(rounded, _complement_of(empty, [])):
            raise UnsupportedError(why_not_rounded(empty))
        self.robot = known
        self.whole = _core.WholeScene(1, None, None, [shape.rounding for shape in known.robot])

    def add(self, block: Sequence[AnyShape]) -> dict[str, NDArray[Any]]:
        cores = [rounded(shape) for shape in block]
        if None in cores:
            k = cores.index(None)
            scene = with_obstacles(self.empty, [block[k]], [f"obstacle {self.obstacles + k}"])
            raise UnsupportedError(why_not_rounded(scene))
        known = replace(self.robot, obstacles=tuple(filter(None, cores)))
        for core in known.obstacles:
            self.whole.add(core.handle, core.rounding)
        plain = Scene(self.empty.robot)
        features = features_of_cores(known, plain, None).obstacles
        owner, rings = features.owner_polygon, len(features.previous)
        after = np.empty(rings, np.int64)
        after[features.previous] = np.arange(rings)
        grown = np.array([float(core.radius) for core in known.obstacles])
        has_arcs = np.array([bool(core.arcs) for core in known.obstacles])
        reach = np.abs(features.radius[:rings]) + np.where(has_arcs, ARCS_REACH * grown, 0.0)[owner]
        reach = np.nextafter(reach * (1 + 2.0**-50), np.inf)
        first = np.searchsorted(owner, np.arange(len(block) + 1)).astype(np.int64)
        xy = features.xy[:rings]
        low = np.minimum.reduceat(xy - reach[:, None], first[:-1])
        high = np.maximum.reduceat(xy + reach[:, None], first[:-1])
        columns = self._placed(len(block), first, low, high, xy, after)
        box = columns["box"]
        self.around = [*np.minimum(self.around[:2], box[:, :2].min(axis=0)).tolist(),
                       *np.maximum(self.around[2:], box[:, 2:].max(axis=0)).tolist()]  # fmt: skip
        ends = np.bincount(features.owner_of_end, minlength=len(block))
        columns |= {"radius": reach, "end": self.ends + _sums(ends)[:-1]}
        self.ends += int(ends.sum())
        return columns

    def facts(self) -> dict[str, Any]:
        around = [self.around] if self.obstacles else []
        for core in _frame_of(self.empty, _complement_of(self.empty, around)).obstacles:
            self.whole.add(core.handle, core.rounding)
        return super().facts() | {"around": around, "ends": self.ends, "facing": self.whole.facing}


def _complement_of(head: Scene, boxes: Sequence[Sequence[float]]) -> tuple[AnyShape, ...]:
    return complement_among(head, boxes) if isinstance(head.workspace, Curved) else ()


def _frame_of(head: Scene, around: Sequence[AnyShape]) -> Cores:
    return Cores(tuple(map(_core_of, head.robot)), tuple(map(_core_of, around)), len(around))


def _core_of(shape: AnyShape) -> Rounded:
    core = rounded(shape)
    assert core is not None, "shapes are stored if they are rounded"
    return core


def _fractions(facing: Sequence[Any]) -> list[Rounding]:
    """Return roundings as `WholeScene` takes them, from those that it gives."""
    return [(Fraction(*radius), [tuple(Fraction(*x) for x in arc) for arc in arcs]) for radius, arcs in facing]


def _sums(counts: Iterable[int]) -> Ints:
    """Sums before each count, and of all."""
    return np.cumsum([0, *counts])


def _line(shape: AnyShape) -> bytes:
    """Rings of a polygon in JSON, on one line: integers, or quotients of two in quotes; a round shape as in a scene."""
    if not isinstance(shape, Polygon):
        return f"{curved_text(shape, _number, lambda pose: _number(pose.tau))}\n".encode("ascii")
    d = shape.denominator
    points = [f"[{x},{y}]" if d == 1 else f'["{x}/{d}","{y}/{d}"]' for x, y in shape.numerators]
    rings = (f"[{','.join(points[i:j])}]" for i, j in pairwise(shape.ring_offsets))
    return f"[{','.join(rings)}]\n".encode("ascii")


def _number(x: Fraction | None) -> str:
    assert x is not None, "rounded shapes have no angles"
    return str(x.numerator) if x.denominator == 1 else f'"{x}"'


def _shape_of(data: Any) -> AnyShape | None:
    """Shape of a line; None if it is none."""
    if isinstance(data, list):
        core = _core.Polygon.of(data)
        return None if core is None else polygon_of(core)
    from cfree.formats.scenes.curve_format import curved_of

    try:
        return curved_of(data)
    except ValueError:
        return None
