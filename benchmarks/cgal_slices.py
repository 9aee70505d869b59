"""Exact slices by CGAL, where g++ finds its headers: Debian's package `libcgal-dev`."""

from __future__ import annotations

import math
import subprocess
from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np

Polygons = Sequence[Sequence[np.ndarray]]  # each of its rings


def seconds(robot: Polygons, obstacles: Polygons, thetas: Iterable[float]) -> float | None:
    """Median seconds of one slice; nan if CGAL gives up, None if it is not here."""
    if (program := _compiled()) is None:
        return None
    taus = [round(math.tan(theta / 2) * 64) / 64 for theta in thetas]  # short rationals
    numbers: list[float] = [len(taus), *taus]
    for polygons in (robot, obstacles):
        numbers.append(len(polygons))
        for rings in polygons:
            numbers.append(len(rings))
            for ring in rings:
                numbers += [len(ring), *ring.ravel().tolist()]
    done = subprocess.run([program], input=" ".join(map(repr, numbers)), capture_output=True, text=True)
    return float(done.stdout) if done.returncode == 0 else math.nan


@cache
def _compiled() -> Path | None:
    source, program = Path(__file__).with_suffix(".cpp"), Path(mkdtemp()) / "cgal_slices"
    command = ["g++", "-std=c++17", "-O2", "-DNDEBUG", "-frounding-math", str(source), "-o", str(program)]
    try:
        subprocess.run([*command, "-lmpfr", "-lgmp"], capture_output=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    return program
