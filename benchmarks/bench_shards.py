"""A city tile by tile: in one process, and by two workers; each run in a process of its own for its peak memory."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from bench_growth import peak_memory
from families import SIZES, city
from measure import Report

import cfree
from cfree.cli.folders import cluster
from cfree.distributed import boundary

VERTICES, MINUTES, GIGABYTES = 1_000_000, 10, 8


def run(quick: bool) -> Report:
    report = Report(
        "A city in tiles",
        ("blocks", "vertices", "tiles", "workers", "trapezoids", "read s", "trim s", "glue s", "cells s", "all s",
         "peak MB", "bytes/trapezoid"),
    )  # fmt: skip
    sizes = SIZES["city"][:1] if quick else (1_250, 2_500)
    seconds: dict[tuple[int, int], float] = {}
    for size in sizes:
        for workers in (0, 2):
            output = subprocess.run(
                [sys.executable, __file__, str(size), str(workers)], stdout=subprocess.PIPE, check=True
            )
            row = json.loads(output.stdout.splitlines()[-1])
            seconds[size, workers] = row["seconds"]["all"]
            report.rows.append((
                f"{size:,}", f"{row['vertices']:,}", str(row["tiles"]), str(workers or "here"),
                f"{row['trapezoids']:,}",
                *(f"{row['seconds'].get(stage, 0):.3g}" for stage in ("read", "trim", "glue", "cells", "all")),
                f"{row['peak'] / 1e6:,.0f}", f"{row['bytes'] / row['trapezoids']:.0f}",
            ))  # fmt: skip
    more = VERTICES / row["vertices"]
    case = f"{VERTICES:,} vertices, from {row['vertices']:,} linearly"
    report.figure("two workers, boundary and cells", case, more * seconds[sizes[-1], 2] / 60, "<=", MINUTES, " min")
    report.figure("second worker", f"{sizes[-1]:,} blocks", seconds[sizes[-1], 0] / seconds[sizes[-1], 2], ">=", 1.7)
    if not quick:
        report.figure("twice the city", "here", seconds[sizes[1], 0] / seconds[sizes[0], 0], "<=", 2**1.05)
    return report


def child(size: int, workers: int) -> dict[str, Any]:
    """Seconds of each stage, memory of the process that asks, and what is on the disk."""
    arrays = city(size)
    scene = cfree.Scene(arrays.robot, arrays.rings())
    began: dict[str, float] = {}

    def note(stage: str, done: int, of: int) -> None:
        began.setdefault("cells" if stage in ("join", "nest", "volumes") else stage, time.perf_counter())

    with tempfile.TemporaryDirectory() as folder, cluster(workers or None, None) as client:
        start = time.perf_counter()
        tile = max(5_000, min(20_000, len(arrays.vertices) // 8))
        found = boundary(scene, folder=f"{folder}/city", client=client, tile=tile, progress=note)
        end = time.perf_counter()
        names, times = [*began], [*began.values(), end]
        seconds = {name: times[k + 1] - times[k] for k, name in enumerate(names)} | {"all": end - start}
        size_on_disk = sum(path.stat().st_size for path in Path(folder).rglob("*.npz"))
        return {
            "vertices": found.vertices,
            "tiles": found.tiles,
            "trapezoids": found.trapezoids,
            "seconds": seconds,
            "peak": peak_memory(),
            "bytes": size_on_disk,
        }


if __name__ == "__main__":
    print(json.dumps(child(int(sys.argv[1]), int(sys.argv[2]))))
