"""Boundaries in folders, for commands: make, query and check them, here or on a cluster."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from cfree.cli.reading import is_strict, report
from cfree.cli.terminal import status
from cfree.words import counted

if TYPE_CHECKING:
    from cfree.distributed.sharded import Sharded
    from cfree.exact.pose import Pose
    from cfree.free.space import FreeSpace
    from cfree.paths.path import Path as Motions
    from cfree.paths.preferences import Preferences
    from cfree.planning.proof import Proof
    from cfree.scene.scene import Scene
    from cfree.vehicles.vehicle import Vehicle
    from cfree.verify.result import Verification

SECOND, MINUTE, HOUR = 1, 60, 3600


def make(
    source: Path, obstacles: Sequence[Path], folder: Path, tiles: int | None, workers: int | None, scheduler: str | None
) -> Sharded:
    """Compute the boundary of a scene in a folder, in this number of tiles."""
    from cfree.distributed.building import boundary
    from cfree.distributed.reading import notes_of

    if is_strict():
        for file in (source, *obstacles):
            report(notes_of(file), file)
    with cluster(workers, scheduler) as client, stages() as progress:
        result = boundary([source, *obstacles], folder=folder, client=client, tiles=tiles, progress=progress)
    report(result.head.reading, source)
    return result


def verified(folder: Path, answer: Path | None, sample: int | None, seed: int, client: Any) -> Verification:
    """Check the shards of a folder, or an answer among its obstacles."""
    from cfree.distributed.sharded import Sharded
    from cfree.formats.files import load
    from cfree.paths.path import Path as Motions
    from cfree.planning.proof import Proof
    from cfree.verify.answers import answer as verified_answer
    from cfree.verify.result import REFUTED, Check, Finding, Verification

    sharded = Sharded(folder)
    report(sharded.head.reading, folder)
    if answer is None:
        with stages() as progress:
            return sharded.verify(sample=sample, seed=seed, client=client, progress=progress)
    given = load(answer)
    if not isinstance(given, Motions | Proof):
        raise ValueError(f"{answer}: no path and no proof; give an answer of the folder")
    if given.whole is not None and given.whole.sha256 != sharded.scene_sha256:
        text = f"the answer is for the one of sha256 {given.whole.sha256[:12]}..., and this folder is of another"
        finding = Finding("scene", "another scene", f"{text}; give its own, or plan anew")
        return Verification((Check("scene", REFUTED, "nothing else was checked"),), (finding,), (), 0.0)
    scene, asked = sharded.scene_for(given)
    return verified_answer(scene, asked)


@contextmanager
def cluster(workers: int | None, scheduler: str | None) -> Iterator[Any]:
    """Yield a client of local workers, or of a cluster at an address; None if neither is wanted."""
    if workers is None and scheduler is None:
        yield None
        return
    if workers is not None and scheduler is not None:
        raise ValueError("--workers and --scheduler: give one of them")
    try:
        from distributed import Client, LocalCluster
    except ImportError as error:
        raise ValueError("a cluster needs Dask; install it: pip install 'cfree[dask]'") from error
    if scheduler is not None:
        try:
            client = Client(scheduler, timeout="30s")
        except (OSError, ValueError) as error:
            raise ValueError(f"--scheduler: {scheduler}: {error}") from error
        with client:
            yield client
        return
    local = LocalCluster(
        n_workers=workers, threads_per_worker=1, host="127.0.0.1", dashboard_address="127.0.0.1:0", silence_logs=50
    )
    try:
        with Client(local) as client:
            yield client
    finally:
        with suppress(AssertionError):  # Dask's, if a worker is just being restarted
            local.close()


@contextmanager
def stages() -> Iterator[Callable[[str, int, int], None]]:
    """Yield a function to call with the number of finished tiles; it shows them, the speed, and the time left."""
    began: dict[str, float] = {}

    def tell(say: Callable[[str], None], stage: str, done: int, total: int) -> None:
        seconds = time.monotonic() - began.setdefault(stage, time.monotonic())
        text = f"{stage} {done:,} of {counted(total, 'tile')}" if total else f"{stage} {counted(done, 'obstacle')}"
        if 0 < done < total and seconds > SECOND:
            text += f", {MINUTE * done / seconds:.3g} a minute, {_duration(seconds * (total - done) / done)} left"
        say(text)

    with status() as say:
        yield partial(tell, say)


def _duration(seconds: float) -> str:
    if seconds < 2 * MINUTE:
        return f"{seconds:.0f} s"
    return f"{seconds / MINUTE:.0f} min" if seconds < 2 * HOUR else f"{seconds / HOUR:.1f} h"


def facts(sharded: Sharded, *, for_machines: bool) -> dict[str, Any]:
    """Describe a boundary in a folder, in words or numbers."""
    counts = {name: getattr(sharded, name) for name in ("obstacles", "vertices", "tiles", "trapezoids")}
    counts |= {"surfaces": len(sharded.surfaces), "cells": len(sharded.cells)}
    shown = counts if for_machines else {name: f"{count:,}" for name, count in counts.items()}
    return {"folder": os.fspath(sharded.folder)} | shown | {"digest": sharded.digest}


class FolderPlanner:
    """A planner for a folder, with the interface of `Planner`.

    Attributes
    ----------
    scene : Scene
        The scene without obstacles before a query; then the one of the answer.
    exact : Scene
        The same with its round shapes, where the answer has polygons in their place.
    """

    def __init__(self, folder: Path, preferences: Preferences, vehicle: Vehicle | Literal["any"] | None = None) -> None:
        from cfree.distributed.sharded import Sharded
        from cfree.scene.scene import vehicle_for

        self.sharded = Sharded(folder)
        self.preferences = preferences
        self.scene: Scene = self.sharded.head
        self.exact: Scene = self.scene
        self.vehicle = vehicle_for(self.scene, vehicle)

    def plan(
        self, start: Pose, goal: Pose, *, clearance: Any, improve: float | None, objective: Any
    ) -> Motions | Proof:
        if clearance is not None:
            raise ValueError("--clearance: not in a folder; give the scene itself")
        wishes: dict[str, Any] = {"improve": improve, "objective": objective, "preferences": self.preferences}
        answer = self.sharded.plan(start, goal, vehicle=self.vehicle or "any", **wishes)
        scenes = [scene for scene in (answer.scene, answer.curved) if scene is not None]
        self.scene, self.exact = scenes[0], scenes[-1]
        return answer

    def obstacle_of(self, number: int, *, outward: bool = False) -> int:
        """Return the obstacle of `exact` that an obstacle of `scene` stands for, by its name; others unchanged.

        Its side, `outward`, does not matter.
        """
        if number < 0 or self.scene is self.exact:
            return number
        name = self.scene.obstacle_names[number]  # or "obstacle 1 (name)", if another number stood there
        return self.exact.obstacle_names.index(name.partition("(")[2].removesuffix(")") or name)

    def plan_any(self, *_: Any, **__: Any) -> Any:
        raise ValueError("--goal: a folder takes one goal, with theta")

    @property
    def angle_scale(self) -> float:
        from cfree.scene.scene import robot_radius

        return robot_radius(self.scene)

    @cached_property
    def free_space(self) -> FreeSpace:
        from cfree.forbidden.boundary import boundary
        from cfree.free.space import free_space

        return free_space(boundary(self.scene, max_seconds=math.inf))
