"""The boundary and the cells of a scene of any size, tile by tile, into a folder; and portals for routes across it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from cfree.arguments import checked
from cfree.distributed import tasks
from cfree.distributed.division import Division, Features, divide_scene
from cfree.distributed.joining import JoinedSurfaces, join
from cfree.distributed.nesting import Answer, Nesting, Question, nest
from cfree.distributed.portals import groups_of, portals_task, write_rooms
from cfree.distributed.reading import read_source, source_key
from cfree.distributed.round_nesting import nest_round
from cfree.distributed.running import check_client, run
from cfree.distributed.shard import VERSION, key_of, read_json, read_shard, write_json, write_shard
from cfree.distributed.sharded import Sharded
from cfree.distributed.store import SceneStore, store_scene
from cfree.distributed.trim import MODULUS
from cfree.errors import FormatError
from cfree.polygons.polygon import Polygon
from cfree.scene.reading import Note
from cfree.scene.scene import Scene

TILE = 20_000
ROUNDS = 3
BLOCK = 1_000  # obstacles
SIGNED = ("source.json", "plan.json", "manifest.json", "scene/facts.json")  # with the key of the source
Progress = Callable[[str, int, int], object]


@checked
def boundary(
    source: Scene | str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
    *,
    folder: str | os.PathLike[str],
    client: Any = None,
    tile: int = TILE,
    tiles: int | None = None,
    progress: Callable[..., object] | None = None,
) -> Sharded:
    """Trim every contact patch of a scene, tile by tile, and find its cells.

    Parameters
    ----------
    source : Scene, path, or sequence of paths
        The first of several files is a scene. The others are GeoJSON (also one feature a line), WKT or GeoParquet of
        more obstacles, which are read one after the other.
    folder : path
        Where everything is kept. If it has the boundary of the same source, every file in it is checked: missing or
        damaged files are made again, and no others.
    client : distributed.Client, optional
        Its workers must share the folder. Without one the same tasks run here, one after the other.
    tile : int
        Approximate number of obstacle vertices in a tile.
    tiles : int, optional
        Number of tiles instead.
    progress : callable, optional
        Function called with the name of the stage, the number of tiles done and that of all tiles. While obstacles are
        read, it is called with their number so far, and 0.

    Returns
    -------
    Sharded
        The trapezoids are the same for any tiles and workers, and the cells are those that one process finds.

    Raises
    ------
    FormatError
        If a file cannot be read, or the folder holds something else.
    UnsupportedError
        If a shape is not rounded, as for `cfree.boundary`, or a file after the first one has round shapes.
    TaskError
        If a tile ends every worker that begins it.
    OSError
        If the disk is full: finished files are kept.

    Notes
    -----
    Time is about linear in the vertices, memory of a process in the vertices of a tile. Besides, the calling process
    holds about 90 bytes a vertex, and 1.2 kB a closed surface. Isolated parts, which have no width, are not looked for.

    Examples
    --------
    >>> import tempfile
    >>> scene = Scene(robot=[(0, 0), (2, 0), (0, 1)], obstacles=[[(5, 5), (8, 5), (6, 7)], [(9, 9), (9, 8), (12, 8)]])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     found = boundary(scene, folder=folder, tile=3)
    ...     again = boundary(scene, folder=f"{folder}/whole")
    ...     found.tiles, again.tiles, found.digest == again.digest, len(found.cells)
    (2, 1, True, 1)
    """
    check_client(client)
    for name, count in (("tile", tile), ("tiles", tiles)):
        if count is not None and count < 1:
            raise ValueError(f"{name}: {count}; give at least 1")
    return _Build(source, Path(folder), client, tile, tiles, progress or (lambda stage, done, of: None)).run()


class _Build:
    """One computation, stage after stage."""

    def __init__(
        self, source: Any, folder: Path, client: Any, tile: int, tiles: int | None, progress: Progress
    ) -> None:
        self.source, self.folder, self.client, self.progress = source, folder, client, progress
        self.vertices_a_tile, self.tiles = tile, tiles
        self.key = key_of(VERSION, source_key(source), tile if tiles is None else -tiles)

    def run(self) -> Sharded:
        self._claim()
        store = self._stored()
        division = self._divided(store)
        self._describe()
        counts = {"tiles": len(division), "obstacles": len(store), "vertices": store.vertices} | self._trim(division)
        components = self._glue(division)
        if not self._is_finished(counts):
            self._finish(store, counts, *self._cells(store, division, components))
        self._open_portals()
        return Sharded(self.folder)

    def _claim(self) -> None:
        """Make the folder, or check that it is that of the same computation."""
        path, known = self.folder / "source.json", None
        for name in SIGNED:  # one of them may be damaged
            with suppress(FormatError):
                known = known or read_json(self.folder / name).get("key")
        if known is not None and known != self.key:
            raise FormatError(
                f"{self.folder}: the folder of another scene, or of other tiles ({known}); give another", path=str(path)
            )
        if known is None and self.folder.exists() and any(self.folder.iterdir()):
            raise FormatError(
                f"{self.folder}: the folder is not empty, and no file tells that it is of this scene; "
                "give another, or delete it",
                path=str(self.folder),
            )
        self.folder.mkdir(parents=True, exist_ok=True)
        if not _is_sound(path):
            write_json(path, {"key": self.key, "version": VERSION})

    def _stored(self) -> SceneStore:
        """Scene as files; `facts.json` is written last."""
        place = self.folder / "scene"
        with suppress(FormatError):
            store = SceneStore(place)
            if store.facts["key"] == self.key:
                store.check()
                return store
        notes: list[Note] = []
        head, obstacles = read_source(self.source, notes)
        return store_scene(head, self._counted(obstacles), place, self.key, notes)

    def _is_finished(self, counts: Mapping[str, Any]) -> bool:
        """True if there are cells, and the manifest is of the same shards."""
        try:
            manifest = read_json(self.folder / "manifest.json")
            read_shard(self.folder / "cells.npz", self.key)
        except FormatError:
            return False
        return counts.items() <= manifest.items()

    def _counted(self, obstacles: Iterator[Polygon]) -> Iterator[Polygon]:
        self.progress("read", 0, 0)
        for count, obstacle in enumerate(obstacles, 1):
            yield obstacle
            if count % BLOCK == 0:
                self.progress("read", count, 0)

    def _divided(self, store: SceneStore) -> Division:
        place = self.folder / "tiles"
        try:
            return Division.open(place, self.key)
        except FormatError:
            tiles = self.tiles or max(1, -(-store.vertices // self.vertices_a_tile))
            return divide_scene(store, tiles, place, self.key)

    def _describe(self) -> None:
        """Write the key that tasks need."""
        path = self.folder / "plan.json"
        if not _is_sound(path):
            write_json(path, {"key": self.key})

    def _each(self, task: Any, stage: str, tiles: Iterable[int], *more: Any) -> Any:
        """Results of a task for all tiles."""
        asked = {tile: more for tile in tiles}
        self.progress(stage, 0, len(asked))
        for done, (number, result) in enumerate(self._run(task, asked), 1):
            self.progress(stage, done, len(asked))
            yield number, result

    def _run(self, task: Any, asked: Mapping[int, tuple[Any, ...]]) -> Iterator[tuple[int, Any]]:
        """Results of a task for some tiles, each with arguments beside its number."""
        stamp = tasks.stamp_of(self.folder)
        return run(task, [(tile, (str(self.folder), stamp, tile, *more)) for tile, more in asked.items()], self.client)

    def _trim(self, division: Division) -> dict[str, Any]:
        tiles = range(len(division))
        results = dict(self._each(tasks.trim_task, "trim", tiles, False))
        if any(one["slits"] for one in results.values()):
            plan = read_json(self.folder / "plan.json")
            if not plan.get("slits"):
                write_json(self.folder / "plan.json", plan | {"slits": True})
            for _ in self._each(tasks.trim_task, "trim again", tiles, True):
                pass
        return {
            "trapezoids": sum(one["trapezoids"] for one in results.values()),
            "digest": f"{sum(int(one['digest'], 16) for one in results.values()) % MODULUS:064x}",
        }

    def _glue(self, division: Division) -> dict[int, int]:
        """Components of each tile; a damaged shard is made again."""
        for attempt in range(ROUNDS):
            try:
                return dict(self._each(tasks.glue_task, "glue", range(len(division))))
            except FormatError as error:
                if attempt == ROUNDS - 1 or error.path is None:
                    raise
                Path(error.path).unlink(missing_ok=True)
                self._trim(division)
        raise AssertionError

    def _cells(
        self, store: SceneStore, division: Division, components: Mapping[int, int]
    ) -> tuple[JoinedSurfaces, Nesting, Any]:
        self.progress("join", 0, 1)
        work = tasks.Work(self.folder)
        joined = join(len(division), lambda tile: work.shard(tasks.GLUED, tile))
        present = {tile: np.unique(tasks.surfaces_in(joined, tile)) for tile, count in components.items() if count}

        def ask(questions: Mapping[int, list[Any]]) -> Iterator[tuple[int, Any]]:
            self.progress("nest", 0, 1)
            asked = {tile: (tasks.surfaces_in(joined, tile), lines) for tile, lines in sorted(questions.items())}
            for tile, answers in self._run(tasks.nest_round_task if store.is_round else tasks.nest_task, asked):
                yield from ((tile, answer) for answer in answers)

        def ask_for_lines(questions: Mapping[int, list[Question]]) -> Iterable[Answer]:
            return (answer for _, answer in ask(questions))

        rest = work.store.rest
        is_bounded, scale = rest.rim is not None, float(rest.scale)
        if store.is_round:
            nesting = nest_round(len(joined), present, division.boxes, ask, is_bounded, scale)
        else:
            nesting = nest(joined, present, division.boxes, ask_for_lines, is_bounded, scale)
        return joined, nesting, self._measure(store, joined, present, len(joined))

    def _open_portals(self) -> None:
        """Divide the plane into rooms, and find the portals between them."""
        groups = groups_of(write_rooms(tasks.Work(self.folder)))
        for _ in self._each(portals_task, "portals", groups):
            pass

    def _measure(
        self, store: SceneStore, joined: JoinedSurfaces, present: dict[int, Any], count: int
    ) -> tuple[list[Fraction], list[Fraction], list[bool]]:
        """Volumes between closed surfaces and their free sides, estimates of the errors, and flags.

        A flag is True if more than obstacles bound the surface.
        """
        values, errors, foreign = [Fraction(0)] * count, [Fraction(0)] * count, [False] * count
        features = Features(store)
        x, y, *_ = store.rest.frame
        near = features.points(joined.lead) - np.array([x, y])
        asked = {tile: (tasks.surfaces_in(joined, tile), near[surfaces]) for tile, surfaces in present.items()}
        for done, (_, volumes) in enumerate(self._run(tasks.measure_task, asked), 1):
            self.progress("volumes", done, len(asked))
            for surface, (value, error, others) in volumes.items():
                values[surface] += value
                errors[surface] += error
                foreign[surface] |= others
        return values, errors, foreign

    def _finish(
        self,
        store: SceneStore,
        counts: dict[str, Any],
        joined: JoinedSurfaces,
        nesting: Nesting,
        measured: tuple[list[Fraction], list[Fraction], list[bool]],
    ) -> None:
        outside = -1 if store.rest.rim is not None else 0
        own = outside + np.cumsum(nesting.free_inside)
        around = np.where(nesting.parent >= 0, own[nesting.parent], outside) if len(own) else own
        cell_of = np.where(nesting.free_inside, own, around).astype(np.int64)
        cells = int(cell_of.max(initial=outside)) + 1
        values, errors, caged = [Fraction(0)] * cells, [Fraction(0)] * cells, np.ones(cells, np.bool_)
        for surface, cell in enumerate(cell_of.tolist()):
            values[cell] += measured[0][surface]
            errors[cell] += measured[1][surface]
            caged[cell] &= not measured[2][surface]
        volumes = np.array([float(value) for value in values])
        # one rounding of an exact sum
        estimates = np.array([float(error) for error in errors]) + np.spacing(np.abs(volumes))
        if outside == 0:
            volumes[0] = estimates[0] = np.inf
            caged[0] = False
        arrays = {name: getattr(joined, name) for name in ("faces", "euler", "turns", "surface", "lift", "first")}
        arrays |= {"parent": nesting.parent, "free_inside": nesting.free_inside, "cell_of": cell_of}
        arrays |= {"volume": volumes, "volume_error": estimates, "caged": caged}
        write_shard(self.folder / "cells.npz", arrays, self.key)
        write_json(
            self.folder / "manifest.json",
            {"version": VERSION, "key": self.key, "surfaces": len(joined), "cells": cells} | counts,
        )


def _is_sound(path: Path) -> bool:
    """True if the file is as it was written."""
    try:
        return bool(read_json(path))
    except FormatError:
        return False
