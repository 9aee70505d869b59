"""Peak memory of a process. `python memory.py SCENE` prints the bytes a vertex that reading and a first plan add.

Such a plan is among far vertices: to the next block of a city. What a plan among few obstacles holds is not counted.
Nothing else is imported here, so that all is counted that such a plan imports.
"""

from __future__ import annotations

import os
import resource
import sys
import tempfile
from pathlib import Path

import cfree

SMALL = '{"robot": [[0, 0], [1, 0], [0, 1]], "obstacles": [[[3, -9], [4, -9], [4, 9]]]}'
STREET, NEXT = (-7, -7, 0), (30, -7, 0)


def peak_memory() -> int:
    """Bytes; from the system's own record where there is one: getrusage counts what the parent had, too."""
    if os.path.exists("/proc/self/status"):
        lines = Path("/proc/self/status").read_text().splitlines()
        return 1024 * int(next(line for line in lines if line.startswith("VmHWM")).split()[1])
    return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def added(path: str) -> float:
    """Bytes a vertex that a first plan in a city's file adds to a process that has planned in a small scene."""
    with tempfile.TemporaryDirectory() as folder:
        small = Path(folder) / "small.json"
        small.write_text(SMALL)
        cfree.plan(cfree.load_scene(small), (0, 0, 0), (9, 0, 0))
    before = peak_memory()
    scene = cfree.load_scene(path)
    cfree.plan(scene, STREET, NEXT)
    return (peak_memory() - before) / sum(map(len, scene.obstacles))


if __name__ == "__main__":
    print(added(sys.argv[1]))
