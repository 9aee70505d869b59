"""What exactness costs: against a build that takes every sign from doubles; degenerate scenes against generic ones.

The second build has the same templates with `CFREE_DOUBLE_ONLY`; it lies in `build/double` and is called in a process
of its own, as the ordinary one is. It is wrong on degenerate scenes, and contradicts itself on most that are not in
general position: those are listed without a ratio, and again with every vertex moved. (Holes of Berlin would cross.)
"""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from families import FAMILIES, turned
from measure import REAL, ROOT, SCENES, Report, measured
from numpy.typing import NDArray

import cfree
from cfree.polygons.polygon import Polygon

Rings = list[list[NDArray[np.float64]]]  # of each polygon: the outer ring, then holes
MOVED = tuple(f"{case} moved" for case in REAL if case != "street_Berlin")
BESIDE_DOUBLES = ("convex 60", "convex 500", "convex 5000", *REAL, *MOVED)
DEGENERATE = ("flats 36", "flats 100", "warehouse on a grid of 1/4")
NEARLY = ("noisy 8", "noisy 14", "noisy 20", "flats 36 turned")  # ties but for the rounding of doubles
EXACT_FITS = ("grid 200",)  # the robot is as wide as the gaps, almost every contact a tie: shown, without a target
AT_MOST = {"doubles": 1.5, "generic": 3.0, "nearly": 5.0}


def run(quick: bool) -> list[Report]:
    rounds = 3 if quick else 9
    with Core(None) as exact, Core(double_build()) as double:
        return [against_doubles(exact, double, rounds), against_generic(exact, rounds)]


def against_doubles(exact: Core, double: Core, rounds: int) -> Report:
    report = Report(
        "Exact decisions beside the signs of doubles, one thread",
        ("scene", "trapezoids", *RUNGS, "trim ms", "doubles ms", "ratio"),
    )
    for case in BESIDE_DOUBLES:
        runs = Run(exact, case), Run(double, case)
        ours, theirs = measured(*runs, rounds=rounds)
        row = (case, f"{runs[0].stats['trapezoids']:,}", *runs[0].rungs(), ours.text())
        if runs[1].failed:
            report.rows.append((*row, "contradiction", ""))
            continue
        ratio = ours.best / theirs.best
        report.rows.append((*row, theirs.text(), f"{ratio:.2f}"))
        report.figure("trimming, exact over doubles", case, ratio, "<=", AT_MOST["doubles"])
    return report


def against_generic(exact: Core, rounds: int) -> Report:
    report = Report(
        "Degenerate scenes beside the same with every vertex moved at random by up to 1/1000, one thread",
        ("scene", "pairs", "trapezoids", *RUNGS, "trim ms", "µs/pair", "ratio a pair", "ratio a trapezoid"),
    )
    for case in DEGENERATE + NEARLY + EXACT_FITS:
        runs = Run(exact, case), Run(exact, f"{case} moved")
        times = measured(*runs, rounds=rounds)
        by_pair, by_trapezoid = (
            times[0].best / runs[0].stats[unit] / (times[1].best / runs[1].stats[unit])
            for unit in ("pairs", "trapezoids")
        )
        for run_, time, ratios in zip(runs, times, ((f"{by_pair:.2f}", f"{by_trapezoid:.2f}"), ("", "")), strict=True):
            stats = run_.stats
            row = (run_.case, f"{stats['pairs']:,}", f"{stats['trapezoids']:,}", *run_.rungs(), time.text())
            report.rows.append((*row, f"{1e6 * time.best / stats['pairs']:.2f}", *ratios))
        if case in DEGENERATE:
            report.figure("degenerate over generic, time a pair", case, by_pair, "<=", AT_MOST["generic"])
        if case in NEARLY:
            report.figure("nearly degenerate over generic, time a pair", case, by_pair, "<=", AT_MOST["nearly"])
    return report


RUNGS = ("identity", "doubles", "intervals", "exact (ms)")


WITH_LIBRARY = f"""
import sys
from importlib.util import module_from_spec, spec_from_file_location
spec = spec_from_file_location("cfree._core", sys.argv[1])
sys.modules["cfree._core"] = core = module_from_spec(spec)
spec.loader.exec_module(core)
sys.path.insert(0, {str(Path(__file__).parent)!r})
import bench_exact
bench_exact.serve()
"""


class Core:
    """A process that trims scenes with one build of the core."""

    def __init__(self, library: Path | None) -> None:
        command = [sys.executable, __file__] if library is None else [sys.executable, "-c", WITH_LIBRARY, library]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def __enter__(self) -> Core:
        return self

    def __exit__(self, *_: object) -> None:
        assert self.process.stdin
        self.process.stdin.close()
        self.process.wait()

    def trim(self, case: str) -> dict[str, Any]:
        assert self.process.stdin and self.process.stdout
        print(case, file=self.process.stdin, flush=True)
        answer: dict[str, Any] = json.loads(self.process.stdout.readline())
        return answer


class Run:
    """Trims one scene when called, and returns the seconds."""

    def __init__(self, core: Core, case: str) -> None:
        self.core, self.case = core, case
        self.failed = False

    def __call__(self) -> float:
        self.stats = self.core.trim(self.case)
        self.failed = "error" in self.stats
        return 1.0 if self.failed else float(self.stats["seconds"]["trim"])

    def rungs(self) -> tuple[str, ...]:
        s, seconds = self.stats, self.stats["seconds"]
        return (
            f"{s['decided_by_identity']:,}",
            f"{s['decided_by_filter']:,}",
            f"{s['decided_by_intervals']:,}",
            f"{s['decided_exactly']:,} ({1e3 * seconds['exact']:.1f})",
        )


def double_build() -> Path:
    """Build the core with the signs of doubles, outside the installed package."""
    import nanobind

    folder = ROOT / "build" / "double"
    tools = Path(sys.executable).parent
    options = [f"-DPython_EXECUTABLE={sys.executable}", f"-Dnanobind_DIR={nanobind.cmake_dir()}", "-DSKBUILD=1"]
    for command in (
        [tools / "cmake", "-S", ROOT, "-B", folder, *options, "-DCFREE_DOUBLE_ONLY=ON"],
        [tools / "cmake", "--build", folder, "-j", str(os.cpu_count())],
    ):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    (library,) = folder.glob("_core*.so")
    return library


@cache
def scene_of(case: str) -> cfree.Scene:
    """A family and its size, also turned, a real scene without bounds, or the warehouse with rounded coordinates."""
    if case.endswith(" moved"):
        by = 1e-6 if case[:-6] in REAL else 1e-3  # real scenes have short edges, which must not cross
        robot, obstacles = (moved(rings_of(shapes), by, seed) for seed, shapes in enumerate(parts(case[:-6])))
        return cfree.Scene([Polygon(r[0], r[1:]) for r in robot], [Polygon(r[0], r[1:]) for r in obstacles])
    if case.endswith(" turned"):
        robot, obstacles = ([turned(shape.vertices, 0.3) for shape in shapes] for shapes in parts(case[:-7]))
        return cfree.Scene(robot, obstacles)
    if case in REAL:
        return replace(cfree.load_scene(SCENES / f"{case}.json"), bounds=None)
    if case == "warehouse on a grid of 1/4":
        robot, obstacles = (
            [Polygon(*on_grid(rings)) for rings in rings_of(shapes)] for shapes in parts("benchmr_warehouse")
        )
        return cfree.Scene(robot, obstacles)
    family, size = case.split()
    arrays = FAMILIES[family](int(size))
    return cfree.Scene(arrays.robot, arrays.rings())


def parts(case: str) -> tuple[Sequence[Polygon], Sequence[Polygon]]:
    scene = scene_of(case)
    return scene.robot, scene.obstacles


def rings_of(shapes: Sequence[Polygon]) -> Rings:
    return [np.split(shape.vertices, shape.ring_offsets[1:-1]) for shape in shapes]


def on_grid(rings: list[NDArray[np.float64]]) -> tuple[NDArray[np.float64], list[NDArray[np.float64]]]:
    outer, *holes = (np.round(4 * ring) / 4 for ring in rings)
    return outer, holes


def moved(shapes: Rings, by: float, seed: int) -> Rings:
    rng = np.random.default_rng(seed)
    return [[ring + rng.uniform(-by, by, ring.shape) for ring in rings] for rings in shapes]


def serve() -> None:
    """Trim the scenes named on the standard input."""
    for line in sys.stdin:
        try:
            stats = cfree.boundary(scene_of(line.strip()), threads=1, max_seconds=math.inf).stats
            answer = {name: getattr(stats, name) for name in stats.__dataclass_fields__}
        except cfree.CfreeError as error:
            answer = {"error": str(error)}
        print(json.dumps(answer), flush=True)


if __name__ == "__main__":
    serve()
