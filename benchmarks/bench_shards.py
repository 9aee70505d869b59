"""A city tile by tile, from files: in one process, and by two workers; then plans in it.

Each run is in a process of its own, and memory is that of all its processes together, the most of what is seen twice a
second. `python bench_shards.py BLOCKS WORKERS` prints one run, of any size.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import threading
import time
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import psutil
from families import BLOCK, SIZES
from measure import Report
from write_city import is_closed, write_city

from cfree.cli.folders import cluster
from cfree.distributed import Sharded, boundary

VERTICES, MINUTES, GIGABYTES = 1_000_000, 10, 8
STREET = (-7.0, -7.0, 0.0)
STAGES = ("read", "trim", "glue", "nest", "volumes")


def run(quick: bool) -> Report:
    report = Report(
        "A city in tiles",
        ("blocks", "vertices", "tiles", "workers", "trapezoids", *(f"{stage} s" for stage in STAGES), "all s",
         "all processes MB", "largest process MB", "bytes/trapezoid"),
    )  # fmt: skip
    sizes = SIZES["city"][:1] if quick else (1_250, 2_500)
    seconds: dict[tuple[int, int], float] = {}
    for size in sizes:
        for workers in (0, 2):
            row = of_child(size, workers)
            seconds[size, workers] = row["seconds"]["all"]
            report.rows.append((
                f"{size:,}", f"{row['vertices']:,}", str(row["tiles"]), str(workers or "here"),
                f"{row['trapezoids']:,}", *(f"{row['seconds'].get(stage, 0):.3g}" for stage in (*STAGES, "all")),
                f"{row['memory'] / 1e6:,.0f}", f"{row['largest'] / 1e6:,.0f}",
                f"{row['bytes'] / row['trapezoids']:.0f}",
            ))  # fmt: skip
    for plan in row["plans"]:
        report.notes.append(
            f"{size:,} blocks, {plan['where']}: {plan['answer']}, {plan['tiles']} of {row['tiles']} tiles read, "
            f"{plan['seconds']:.2f} s"
        )
    more = VERTICES / row["vertices"]
    case = f"{VERTICES:,} vertices, from {row['vertices']:,} linearly"
    report.figure("two workers, boundary and cells", case, more * seconds[sizes[-1], 2] / 60, "<=", MINUTES, " min")
    report.figure("second worker", f"{sizes[-1]:,} blocks", seconds[sizes[-1], 0] / seconds[sizes[-1], 2], ">=", 1.7)
    if not quick:
        report.figure("twice the city", "here", seconds[sizes[1], 0] / seconds[sizes[0], 0], "<=", 2**1.05)
    return report


def of_child(size: int, workers: int) -> dict[str, Any]:
    command = [sys.executable, __file__, str(size), str(workers)]
    output = subprocess.run(command, stdout=subprocess.PIPE, check=True)
    row: dict[str, Any] = json.loads(output.stdout.splitlines()[-1])
    return row


def measured(size: int, workers: int) -> dict[str, Any]:
    """Seconds of each stage, memory, what is on the disk, and plans."""
    began: dict[str, float] = {}

    def note(stage: str, done: int, of: int) -> None:
        began.setdefault("nest" if stage == "join" else stage, time.perf_counter())

    with tempfile.TemporaryDirectory() as name, cluster(workers or None, None) as client:
        folder, most = Path(name), Memory()
        side = write_city(folder, size)
        start = time.perf_counter()
        tile = max(1_000, min(20_000, 39 * side * side // 8))
        files = [folder / "robot.json", folder / "city.geojsonl"]
        with most, stream(client) as tasks:
            found = boundary(files, folder=folder / "tiles", client=client, tile=tile, progress=note)
        end = time.perf_counter()
        times = [*began.values(), end]
        seconds = {stage: times[k + 1] - times[k] for k, stage in enumerate(began)} | {"all": end - start}
        return {
            "workers": workers,
            "vertices": found.vertices, "tiles": found.tiles, "trapezoids": found.trapezoids, "cells": len(found.cells),
            "digest": found.digest, "seconds": seconds, "memory": most.together, "largest": most.largest,
            "tasks": seconds_of(tasks), "borders": borders(found),
            "bytes": sum(path.stat().st_size for path in (folder / "tiles").rglob("*.npz")),
            "plans": [planned(found, *place) for place in places(side)],
        }  # fmt: skip


def stream(client: Any) -> Any:
    """What the workers do while it is open."""
    if client is None:
        return nullcontext()
    from distributed import get_task_stream

    return get_task_stream(client)


def seconds_of(stream: Any) -> dict[str, list[float]]:
    """Of each kind of task how long each took."""
    found: dict[str, list[float]] = {}
    for task in stream.data if stream is not None else ():
        name = str(task["key"]).split("-")[0]
        found.setdefault(name, []).append(sum(s["stop"] - s["start"] for s in task["startstops"]))
    return found


def borders(found: Sharded) -> dict[str, float]:
    """Which share of what glue tasks hold is other tiles', and which share of sides leads into them."""
    work, own, held, sides, out = found.work, 0, 0, 0, 0
    for tile in range(0, found.tiles, max(1, found.tiles // 8)):
        rows, glued = work.rows(tile, work.surfaces, around=True), work.shard("glue", tile)
        own, held = own + int((rows.tile == tile).sum()), held + len(rows.tile)
        sides, out = sides + int(glued["sides"].sum()), out + len(glued["border"])
    return {"halo": held / own - 1, "border": out / sides}


def places(side: int) -> list[tuple[str, float, float]]:
    """Courtyards to drive to from a street at a corner: near, far, as far as there are, and one that is shut."""
    found = []
    for where, k in (("a block", 0), ("half way", side // 2), ("the whole way", side - 1)):
        column = next(c for c in range(k, -1, -1) if not is_closed(k, c))
        found.append((where, BLOCK * column + 30, BLOCK * k + 30))
    row, column = max((r, c) for r in range(side) for c in range(side) if is_closed(r, c))
    return [*found, ("a courtyard without a door", BLOCK * column + 30, BLOCK * row + 30)]


def planned(found: Sharded, where: str, x: float, y: float) -> dict[str, Any]:
    start = time.perf_counter()
    answer = found.plan(STREET, (x, y, 0))
    return {
        "where": where,
        "answer": type(answer).__name__,
        "tiles": found.tiles_read,
        "seconds": time.perf_counter() - start,
    }


class Memory:
    """The most memory that this process and those it has started have held, in bytes."""

    def __init__(self) -> None:
        self.together = self.largest = 0
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._watch, daemon=True)

    def __enter__(self) -> None:
        self._thread.start()

    def __exit__(self, *_: object) -> None:
        self._over.set()
        self._thread.join()

    def _watch(self) -> None:
        this = psutil.Process()
        while True:
            held = []
            for process in (this, *this.children(recursive=True)):
                try:
                    held.append(process.memory_info().rss)
                except psutil.NoSuchProcess:
                    continue
            self.together, self.largest = max(self.together, sum(held)), max(self.largest, *held)
            if self._over.wait(0.5):
                return


if __name__ == "__main__":
    print(json.dumps(measured(int(sys.argv[1]), int(sys.argv[2]))))
