"""A boundary in the files of a folder; its queries read only the files that they need."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path as FilePath
from typing import Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cfree.arguments import checked
from cfree.collision.pose_checker import rows_of
from cfree.distributed.locating import CellsOf, cells_of, with_rational_tangents
from cfree.distributed.planning import Surroundings, plan_among
from cfree.distributed.questions import Rows, free_task, groups, plan_task, taken
from cfree.distributed.running import check_client, run
from cfree.distributed.shard import read_json, read_shard
from cfree.distributed.tasks import TRIMMED, Work, opened, stamp_of
from cfree.distributed.verifying import cells_findings, summary, verify_task
from cfree.errors import FormatError
from cfree.exact.pose import OnePose, Pose, PoseLike, Poses, one_pose, to_pose
from cfree.free.space import FORBIDDEN, NO_CELL
from cfree.paths.numbering import renumbered
from cfree.paths.path import Objective, Path
from cfree.paths.preferences import Preferences
from cfree.planning.proof import Proof
from cfree.scene.scene import Scene, required
from cfree.value import Value
from cfree.vehicles.vehicle import Vehicle
from cfree.verify.result import Verification
from cfree.words import counted

Ints = NDArray[np.int64]


@dataclass(frozen=True)
class Surfaces:
    """Closed surfaces, numbered by their first trapezoid.

    Attributes
    ----------
    faces, euler, turns, parent, cell_of : (n,) int64
        As in `cfree.FreeSpace` and `cfree.forbidden.CellComplex`.
    free_inside : (n,) bool
    """

    faces: Ints
    euler: Ints
    turns: Ints
    parent: Ints
    free_inside: NDArray[np.bool_]
    cell_of: Ints

    def __len__(self) -> int:
        return len(self.faces)


@dataclass(frozen=True)
class Cells:
    """Cells of the free space, an unbounded one first.

    Attributes
    ----------
    volume, volume_error : (n,) float64
        Volume in length^2 radians, and an estimate of the error; infinite if unbounded.
    caged : (n,) bool
        True if obstacles alone enclose it.
    """

    volume: NDArray[np.float64]
    volume_error: NDArray[np.float64]
    caged: NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.volume)


class Sharded(Value):
    """A boundary whose trapezoids are in the files of a folder; see `boundary`.

    Parameters
    ----------
    folder : path

    Attributes
    ----------
    tiles, obstacles, vertices, trapezoids : int
        Their numbers.
    digest : str
        Hash of all trapezoids: the same for any tiles, any number of workers, and any order.
    tiles_read : int
        Number of tiles that the last query has read.

    Raises
    ------
    FormatError
        If there is no boundary in the folder, or it is not finished, or a file of it is damaged. Any query may raise
        this: the error names the file and the remedy.
    """

    @checked
    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = FilePath(folder)
        self.manifest = _manifest(self.folder)
        self.tiles, self.obstacles, self.vertices, self.trapezoids = (
            int(self.manifest[name]) for name in ("tiles", "obstacles", "vertices", "trapezoids")
        )
        self.digest = str(self.manifest["digest"])
        self.tiles_read = 0

    @property
    def _content(self) -> tuple[Any, ...]:
        return tuple(sorted(self.manifest.items()))

    def __reduce__(self) -> tuple[Any, ...]:
        return Sharded, (self.folder,)

    def __repr__(self) -> str:
        return (
            f"Sharded({os.fspath(self.folder)!r}, {counted(self.vertices, 'vertex')}, "
            f"{counted(self.trapezoids, 'trapezoid')} "
            f"in {counted(self.tiles, 'tile')}, {counted(self.manifest['cells'], 'cell')})"
        )

    @property
    def work(self) -> Work:
        return opened(str(self.folder), stamp_of(self.folder))

    @property
    def scene_sha256(self) -> str:
        """Hash of the whole scene, which answers of the folder contain; see `docs/answer-format.md`."""
        return str(self.work.store.facts["scene"])

    @cached_property
    def head(self) -> Scene:
        """The scene without its obstacles."""
        return self.work.store.head

    @cached_property
    def surfaces(self) -> Surfaces:
        """Closed surfaces, and their nesting."""
        return Surfaces(**{name: self._table[name] for name in Surfaces.__annotations__})

    @cached_property
    def cells(self) -> Cells:
        """The cells of the free space."""
        return Cells(**{name: self._table[name] for name in Cells.__annotations__})

    @cached_property
    def _table(self) -> dict[str, NDArray[Any]]:
        return read_shard(self.folder / "cells.npz", self.manifest["key"])

    @checked
    def plan(
        self,
        start: PoseLike | None = None,
        goal: PoseLike | None = None,
        *,
        improve: float | None = None,
        objective: Objective = "balanced",
        preferences: Preferences | None = None,
        vehicle: Vehicle | Literal["any"] | None = None,
    ) -> Path | Proof:
        """A path among all obstacles, each motion proved free, or a proof that there is none.

        Only tiles near the paths tried are read: `tiles_read` is their number. To a far goal the path leads through
        portals, from room to room.

        Parameters
        ----------
        start, goal : Pose or (x, y, theta), optional
            Those of the scene by default.
        improve, objective, preferences, vehicle
            Options of `cfree.plan`.

        Returns
        -------
        Path, Separated, Stuck or Unreachable
            Its `scene` has the obstacles that it is about, named by their numbers; `cfree.verify` can check it.

        Raises
        ------
        InvalidPoseError
            If there is no start or goal, or it is forbidden.
        """
        known = Surroundings(self.work)
        ends = required(self.head, start, goal)
        wishes: dict[str, Any] = {"improve": improve, "objective": objective, "preferences": preferences}
        answer = plan_among(known, *ends, vehicle=vehicle, **wishes)
        self.tiles_read = len(known.read)
        return answer

    @checked
    def plan_many(
        self,
        queries: Iterable[tuple[PoseLike, PoseLike]],
        *,
        improve: float | None = None,
        objective: Objective = "balanced",
        preferences: Preferences | None = None,
        vehicle: Vehicle | Literal["any"] | None = None,
        client: Any = None,
    ) -> list[Path | Proof]:
        """Answers to many queries, each as from `plan`, in their order.

        Parameters
        ----------
        queries : pairs (start, goal) of Pose or (x, y, theta)
        improve, objective, preferences, vehicle
            Options of `cfree.plan`.
        client : distributed.Client, optional
            Client, as in `boundary`.
        """
        check_client(client)
        wishes = {"improve": improve, "objective": objective, "preferences": preferences, "vehicle": vehicle}
        asked = [
            (k, (str(self.folder), self.work.stamp, to_pose(start, f"start {k}"), to_pose(goal, f"goal {k}"), wishes))
            for k, (start, goal) in enumerate(queries)
        ]
        answers = dict(run(plan_task, asked, client))
        return [answers[k] for k in range(len(asked))]

    @overload
    def is_free(self, poses: OnePose, *, client: Any = None) -> bool: ...
    @overload
    def is_free(self, poses: Poses | Iterable[PoseLike] | ArrayLike, *, client: Any = None) -> NDArray[np.bool_]: ...
    @checked
    def is_free(
        self, poses: OnePose | Poses | Iterable[PoseLike] | ArrayLike, *, client: Any = None
    ) -> bool | NDArray[np.bool_]:
        """True if a pose is free: decided exactly, with the verdict of `cfree.is_free` for the whole scene.

        Parameters
        ----------
        poses : Pose or (x, y, theta), Poses, sequence of the former, or (n, 3) float64
            Poses, as in `cfree.is_free`.
        client : distributed.Client, optional
            Client, as in `boundary`.

        Returns
        -------
        bool, or (n,) bool
        """
        check_client(client)
        if (pose := one_pose(poses, "poses")) is not None:
            return bool(self._are_free([pose], client)[0])
        listed: Any = poses if isinstance(poses, Poses | np.ndarray) else [*poses]  # type: ignore[misc]
        return self._are_free(rows_of(listed) if len(listed) else [], client)

    def _are_free(self, rows: Rows, client: Any) -> NDArray[np.bool_]:
        parts = groups(self.work, rows)
        asked = [(k, (str(self.folder), self.work.stamp, taken(rows, part))) for k, part in enumerate(parts)]
        result = np.zeros(len(rows), np.bool_)
        for k, free in run(free_task, asked, client):
            result[parts[k]] = free
        return result

    @overload
    def locate(self, poses: OnePose, *, client: Any = None) -> int: ...
    @overload
    def locate(self, poses: Poses | Iterable[PoseLike], *, client: Any = None) -> Ints: ...
    @checked
    def locate(self, poses: OnePose | Poses | Iterable[PoseLike], *, client: Any = None) -> int | Ints:
        """Cell of each pose, exactly, as from `cfree.FreeSpace.locate`.

        Only tiles between a pose and the nearest face on its left are read; if it is on a face, or its orientation is
        critical, all to its left. `tiles_read` is their number.

        Parameters
        ----------
        poses : Pose or (x, y, theta), Poses, or sequence of the former
        client : distributed.Client, optional
            Client, as in `boundary`.

        Returns
        -------
        int, or (n,) int64
            Number of the cell; -1 if forbidden. A pose on the boundary is free: the first cell that a face through it
            bounds. A pose that is free and on no face has -2: an exact fit, which is in the closure of no cell.
        """
        check_client(client)
        if (pose := one_pose(poses, "poses")) is not None:
            return int(self._locate([pose], client)[0])
        if isinstance(poses, Poses):
            return self._locate(with_rational_tangents(poses), client)
        return self._locate([to_pose(pose, f"poses[{k}]") for k, pose in enumerate(poses)], client)  # type: ignore[arg-type]

    def _locate(self, poses: list[Pose], client: Any) -> Ints:
        work, here = self.work, (str(self.folder), self.work.stamp)
        which, table, rest = np.flatnonzero(self._are_free(poses, client)), self._table, work.store.rest
        places = [rest.in_chart(poses[k]) for k in which.tolist()]
        first, read = table["first"], set[int]()

        def ask(task: Any, questions: Mapping[int, list[int]]) -> Iterator[tuple[int, list[Any]]]:
            read.update(questions)
            return run(task, [(tile, (*here, tile, table["surface"][first[tile] : first[tile + 1]],
                                      [places[k] for k in numbers])) for tile, numbers in questions.items()],
                       client)  # fmt: skip

        known = CellsOf(table["parent"], table["cell_of"], table["free_inside"], NO_CELL if rest.rim is not None else 0)
        present = np.flatnonzero(np.diff(first))
        result = np.full(len(poses), FORBIDDEN, np.int64)
        result[which] = cells_of(places, present, work.division.boxes, float(rest.scale), ask, known, client is None)
        self.tiles_read = len(read)
        return result

    @checked
    def scene_near(self, path: Path) -> Scene:
        """The scene with all obstacles that may be touched on a path, and perhaps others."""
        known = Surroundings(self.work)
        known.add_around(path)
        self.tiles_read = len(known.read)
        return known.scene

    @checked
    def scene_for(self, answer: Path | Proof) -> tuple[Scene, Path | Proof]:
        """Scene in which `cfree.verify.answer` checks an answer of this folder, and the answer in its numbers.

        A path is checked among all obstacles near it, a proof among those that it is about.

        Raises
        ------
        ValueError
            If it is an answer of another folder, or a proof that does not name its obstacles.
        """
        whole = answer.whole
        if whole is not None and whole.sha256 != (mine := self.scene_sha256):
            what = f"about the scene of sha256 {whole.sha256[:12]}..., and this is the folder of {mine[:12]}..."
            raise ValueError(f"answer: {what}; give its own folder")
        if not isinstance(answer, Path):
            if whole is None:
                raise ValueError("answer: a proof that names no obstacles of a folder; give the scene it is about")
            return self.work.store.scene(whole.obstacles), replace(answer, whole=None)
        known = Surroundings(self.work)
        known.add_around(answer)
        self.tiles_read = len(known.read)
        numbers = sorted(known.numbers | set(whole.obstacles if whole is not None else ()))
        place = {number: k for k, number in enumerate(numbers)}
        if whole is not None:
            answer = renumbered(answer, [place[number] for number in whole.obstacles])
        return self.work.store.scene(numbers), replace(answer, whole=None)

    @checked
    def verify(
        self,
        *,
        sample: int | None = None,
        seed: int = 0,
        client: Any = None,
        progress: Callable[..., object] | None = None,
    ) -> Verification:
        """Check the shards, each alone and then its borders, by the code of `cfree.verify`.

        Parameters
        ----------
        sample : int, optional
            Check so many trapezoids of each tile, chosen at random, and no sides; all by default.
        seed : int
            Seed of the random choices.
        client : distributed.Client, optional
            Client, as in `boundary`.
        progress : callable, optional
            Function called with the name of the stage, the number of tiles done and that of all tiles.

        Returns
        -------
        Verification

        Notes
        -----
        Time is about 0.25 ms a trapezoid.
        """
        check_client(client)
        begin, stamp = time.perf_counter(), self.work.stamp
        asked = [(k, (str(self.folder), stamp, k, sample, seed)) for k in range(self.tiles)]
        checks = {}
        for tile, check in run(verify_task, asked, client):
            checks[tile] = check
            if progress is not None:
                progress("verify", len(checks), self.tiles)
        wrong = cells_findings(self.folder, self.manifest["key"])
        found, is_round = [checks[k] for k in sorted(checks)], self.work.store.is_round
        return summary(found, wrong, self.digest, begin, is_round=is_round)

    @checked
    def tile(self, number: int) -> dict[str, NDArray[Any]]:
        """The trapezoids of a tile, as `docs/shards.md` describes them."""
        return self.work.shard(TRIMMED, range(self.tiles)[number])


def _manifest(folder: FilePath) -> dict[str, Any]:
    path = folder / "manifest.json"
    if not path.exists():
        what = "is not finished; run it again" if (folder / "source.json").exists() else "there is no boundary in it"
        raise FormatError(f"{folder}: {what}: cfree boundary SCENE --folder {folder}", path=str(folder))
    return read_json(path)
