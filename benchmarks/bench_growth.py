"""Growth with the number of obstacles at constant density, each size in a process of its own for its peak memory."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
import tempfile
import time
from typing import Any

from families import SIZES, convex
from measure import Report, Times, checksum, measured
from memory import peak_memory

import cfree
from cfree import save
from cfree.forbidden.columns import COLUMNS

EXPONENT, BYTES = 1.1, 200


def run(quick: bool) -> Report:
    report = Report(
        "Growth: random convex obstacles at constant density, one thread",
        ("obstacles", "vertices", "patches", "trapezoids", "read s", "features s", "trim s", "trim µs/patch",
         "all µs/patch", "bytes/trapezoid", "peak MB", "checksum"),
    )  # fmt: skip
    sizes = SIZES["convex"][1:3] if quick else SIZES["convex"]
    rows = []
    for size in sizes:
        output = subprocess.run([sys.executable, __file__, str(size)], stdout=subprocess.PIPE, check=True).stdout
        row = json.loads(output)
        rows.append(row)
        read, features, trim = (Times(tuple(row[key])) for key in ("read", "features", "trim"))
        report.rows.append((
            f"{size:,}", f"{row['vertices']:,}", f"{row['patches']:,}", f"{row['trapezoids']:,}", read.text("s"),
            features.text("s"), trim.text("s"), trim.text("µs", row["patches"]),
            f"{1e6 * total(row) / row['patches']:.3g}", f"{row['bytes']:.1f}", f"{row['peak'] / 1e6:,.0f}",
            row["checksum"],
        ))  # fmt: skip
    first, last = rows[1 if len(rows) > 2 else 0], rows[-1]
    span = f"{first['vertices']:,} to {last['vertices']:,} vertices"
    by = math.log(last["patches"] / first["patches"])
    core = math.log(min(last["trim"]) / min(first["trim"])) / by
    report.figure("growth of core time, exponent in the patches", span, core, "<=", EXPONENT)
    whole = math.log(total(last) / total(first)) / by
    report.figure("growth of reading and all phases, exponent", span, whole, "<=", EXPONENT)
    report.figure("result, bytes a trapezoid", f"{last['vertices']:,} vertices", last["bytes"], "<=", BYTES)
    return report


def total(row: dict[str, Any]) -> float:
    """Seconds from a scene file to a boundary."""
    return float(min(row["read"]) + min(row["total"]))


def child(size: int) -> dict[str, Any]:
    """Measure one size: reading a file, then the boundary."""
    rounds = 2 if size > 10_000 else 3
    arrays = convex(size)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scene.json")
        save(cfree.Scene(arrays.robot, arrays.rings()), path)
        read: list[cfree.Scene] = []
        (reading,) = timed_reading(path, read, rounds)
    phases = []
    for _ in range(rounds):
        result = cfree.boundary(read[0], threads=1)
        phases.append(result.stats.seconds)
    columns = [getattr(result.trapezoids, name) for name in COLUMNS]
    patches = [result.contact_kind, result.contact_robot, result.contact_obstacle]
    return {
        "vertices": len(arrays.vertices),
        "patches": result.stats.patches,
        "trapezoids": result.stats.trapezoids,
        "read": reading.rounds,
        **{key: [p[key] for p in phases] for key in ("features", "trim", "total")},
        "bytes": sum(array.nbytes for array in columns + patches) / len(result.trapezoids),
        "peak": peak_memory(),
        "checksum": checksum(columns),
    }


def timed_reading(path: str, read: list[cfree.Scene], rounds: int) -> list[Times]:
    def load() -> float:
        start = time.perf_counter()
        read[:] = [cfree.load_scene(path)]
        return time.perf_counter() - start

    return measured(load, rounds=rounds)


if __name__ == "__main__":
    print(json.dumps(child(int(sys.argv[1]))))
