"""Boundary and cells of generated cities, each size in a process of its own for its peak memory."""

from __future__ import annotations

import json
import subprocess
import sys
import time
from itertools import pairwise
from typing import Any

from families import SIZES, city
from measure import Report
from memory import peak_memory

import cfree

VERTICES, MINUTES, GIGABYTES = 1_000_000, 10, 12


def run(quick: bool) -> Report:
    report = Report(
        "A city: boundary and cells",
        ("blocks", "vertices", "trapezoids", "half-edges", "scene s", "boundary s", "gluing s", "cells s",
         "peak MB", "bytes/vertex"),
    )  # fmt: skip
    for size in SIZES["city"][: 1 if quick else 2]:
        output = subprocess.run([sys.executable, __file__, str(size)], stdout=subprocess.PIPE, check=True).stdout
        row = json.loads(output)
        peak = row["peak"] - row["before"]
        report.rows.append((
            f"{size:,}", f"{row['vertices']:,}", f"{row['trapezoids']:,}", f"{row['half-edges']:,}",
            *(f"{seconds:.3g}" for seconds in row["seconds"]), f"{row['peak'] / 1e6:,.0f}",
            f"{peak / row['vertices']:,.0f}",
        ))  # fmt: skip
    more = VERTICES / row["vertices"]
    case = f"{VERTICES:,} vertices, from {row['vertices']:,} linearly"
    report.figure("city, boundary and cells", case, more * sum(row["seconds"]) / 60, "<=", MINUTES, " min")
    report.figure("city, peak memory", case, (row["before"] + more * peak) / 1e9, "<=", GIGABYTES, " GB")
    return report


def child(size: int) -> dict[str, Any]:
    """Seconds of each step on all cores, and memory."""
    arrays = city(size)
    rings, before = arrays.rings(), peak_memory()
    times = [time.perf_counter()]
    scene = cfree.Scene(arrays.robot, rings)
    times.append(time.perf_counter())
    boundary = cfree.boundary(scene)
    times.append(time.perf_counter())
    cells = boundary._complex_handle
    times.append(time.perf_counter())
    cfree.free_space(boundary)
    times.append(time.perf_counter())
    return {
        "vertices": len(arrays.vertices),
        "trapezoids": len(boundary.trapezoids),
        "half-edges": len(cells.twin),
        "seconds": [end - start for start, end in pairwise(times)],
        "before": before,
        "peak": peak_memory(),
    }


if __name__ == "__main__":
    print(json.dumps(child(int(sys.argv[1]))))
