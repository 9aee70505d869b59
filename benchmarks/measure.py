"""What every benchmark here uses: rounds of timed calls, ratios with a target, a report, the machine it ran on.

A benchmark is a function ``run(quick) -> Report`` in a file ``bench_<name>.py``; `run.py` calls them.
"""

from __future__ import annotations

import gc
import math
import os
import platform
import statistics
import subprocess
import time
import zlib
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np
import shapely

ROOT = Path(__file__).resolve().parent.parent
SCENES = ROOT / "examples" / "scenes"
POLYGONS = [path for path in sorted(SCENES.glob("*.json")) if not path.stem.startswith("round_")]
REAL = ("benchmr_parking1", "benchmr_warehouse", "nest_shirts", "nest_swim", "street_Berlin")


@dataclass(frozen=True, slots=True)
class Times:
    """Seconds of one call in several rounds, after one to warm up.

    `best` is what ratios are made of: other work on the machine only ever adds time.
    """

    rounds: tuple[float, ...]

    @property
    def best(self) -> float:
        return min(self.rounds)

    def text(self, unit: str = "ms", per: float = 1) -> str:
        """Median and range of the seconds divided by `per`."""
        scale = {"s": 1, "ms": 1e3, "µs": 1e6}[unit] / per
        low, middle, high = (scale * f(self.rounds) for f in (min, statistics.median, max))
        return f"{middle:.3g} ({low:.3g}–{high:.3g})"


@dataclass(frozen=True, slots=True)
class Figure:
    """A measured value and what it has to be: at least, or at most, `target`."""

    what: str
    case: str
    value: float
    relation: str
    target: float
    unit: str = ""

    @property
    def passes(self) -> bool:
        return self.value >= self.target if self.relation == ">=" else self.value <= self.target


@dataclass(slots=True)
class Report:
    """A table of times, and the figures taken from it."""

    title: str
    columns: tuple[str, ...]
    rows: list[tuple[str, ...]] = field(default_factory=list)
    figures: list[Figure] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def figure(self, what: str, case: str, value: float, relation: str, target: float, unit: str = "") -> None:
        self.figures.append(Figure(what, case, value, relation, target, unit))


def timed(*calls: Callable[[], object], rounds: int, warm_up: bool = True) -> list[Times]:
    """Time rivals in turn, round by round, so that a busy minute hits all of them."""
    return measured(*(lambda call=call: _seconds(call) for call in calls), rounds=rounds, warm_up=warm_up)


def measured(*calls: Callable[[], float], rounds: int, warm_up: bool = True) -> list[Times]:
    """The same for calls that return their own seconds."""
    if warm_up:
        for call in calls:
            call()
    seconds = []
    for _ in range(rounds):
        gc.collect()
        seconds.append([call() for call in calls])
    return [Times(column) for column in zip(*seconds, strict=True)]


def each(call: Callable[[Any], object], arguments: list[Any], rounds: int = 9) -> float:
    """Microseconds of a call, on average: the best of some rounds for each of its arguments."""
    best = [math.inf] * len(arguments)
    for _ in range(rounds):
        for k, argument in enumerate(arguments):
            start = time.perf_counter()
            call(argument)
            best[k] = min(best[k], time.perf_counter() - start)
    return 1e6 * sum(best) / len(best)


def _seconds(call: Callable[[], object]) -> float:
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def checksum(arrays: Iterable[np.ndarray]) -> str:
    """CRC-32 of the bytes."""
    value = 0
    for array in arrays:
        value = zlib.crc32(np.ascontiguousarray(array).tobytes(), value)
    return f"{value:08x}"


def machine() -> dict[str, Any]:
    """Processor, compiler, versions, date and commit; no names."""
    cpu = {}
    if os.path.exists("/proc/cpuinfo"):
        lines = Path("/proc/cpuinfo").read_text().split("\n\n")[0].splitlines()
        cpu = {key.strip(): value.strip() for key, _, value in (line.partition(":") for line in lines)}
    return {
        "cores": os.cpu_count(),
        "processor": f"{cpu.get('model name', platform.machine())}, family {cpu.get('cpu family', '?')}, "
        f"cache {cpu.get('cache size', '?')}",
        "compiler": _output("g++", "--version").partition("\n")[0],
        "versions": f"Python {platform.python_version()}, numpy {np.__version__}, shapely {shapely.__version__} "
        f"with GEOS {shapely.geos_version_string}",
        "date": date.today().isoformat(),
        "commit": _output("git", "-C", str(ROOT), "rev-parse", "--short=10", "HEAD")
        + (" with changes" if _output("git", "-C", str(ROOT), "status", "--porcelain", "src", "cpp") else ""),
        "load": f"{os.getloadavg()[0]:.1f} at the start",
    }


def _output(*command: str) -> str:
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
