"""Would one send it to a machine? What paths keep of the distance they could, how much they turn, what that costs.

Seeded scenes with one way that is narrow somewhere, and the project's larger ones. The distance that they could keep is
`max_margin`'s, of any way; times are of the process, from a scene just read.
"""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable

import numpy as np
from measure import SCENES, Report

import cfree

Ring = list[tuple[float, float]]
Maker = Callable[[], cfree.Scene]
STORED = ("benchmr_parking1", "flat", "sofa_corner", "comb_hook")


def run(quick: bool) -> Report:
    report = Report(
        "What paths keep",
        ("scene", "first ms", "default ms", "ratio", "proved", "margin", "share", "motions", "turning deg"),
        notes=["first: improve=0; proved: least clearance of the default path; margin: the largest of any way, +- 5 %"],
    )
    makers: dict[str, Maker] = {f"throat {width:g}": lambda w=width: throat(w) for width in (1e-1, 1e-2)}  # type: ignore[misc]
    makers |= {f"maze {seed}": lambda s=seed: maze(s) for seed in range(3)}  # type: ignore[misc]
    makers |= {f"gates {seed}": lambda s=seed: gates(s) for seed in range(3)}  # type: ignore[misc]
    makers |= {name: lambda n=name: cfree.load_scene(SCENES / f"{n}.json") for name in STORED}  # type: ignore[misc]
    shares, ratios = zip(
        *(row(name, make, report) for name, make in list(makers.items())[: 2 if quick else None]), strict=True
    )
    count = f"{len(shares)} scenes"
    report.figure("default path, share of the largest margin, least", count, min(shares), ">=", 0.5)
    report.figure("default path, in the first answer's time", f"median of {count}", statistics.median(ratios), "<=", 3)
    return report


def row(name: str, make: Maker, report: Report) -> tuple[float, float]:
    _, first = spent(lambda: cfree.plan(make(), improve=0))
    path, default = spent(lambda: cfree.plan(make()))
    assert isinstance(path, cfree.Path)
    scene = make()
    margin = cfree.max_margin(scene, tolerance=0.05).lo
    place = cfree.clearance(path, scene, tolerance=margin / 50)
    assert place is not None
    share, turning = place.least / margin, math.degrees(path.turning)
    numbers = f"{first:.3g}", f"{default:.3g}", f"{default / first:.2f}", f"{place.least:.3g}", f"{margin:.3g}"
    report.rows.append((name, *numbers, f"{share:.2f}", str(len(path.motions)), f"{turning:.0f}"))
    return share, default / first


def spent(work: Callable[[], object]) -> tuple[object, float]:
    """What it gives, and the fewest milliseconds of the process in three rounds."""
    times = []
    for _ in range(3):
        start = time.process_time()
        found = work()
        times.append(1e3 * (time.process_time() - start))
    return found, min(times)


# --- scenes ---


def box(x: float, y: float, width: float, height: float) -> Ring:
    return [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]


def throat(width: float) -> cfree.Scene:
    """Two rooms, joined by a throat so much wider than the robot."""
    gap = 0.5 + width / 2
    walls = [box(4, -5, 1, 5 - gap), box(4, gap, 1, 5 - gap)]
    ends = {"start": cfree.Pose(1.5, 0.5, 0.3), "goal": cfree.Pose(8, -0.5, 2.0)}
    return cfree.Scene(box(-1, -0.5, 2, 1), walls, workspace=box(0, -5, 10, 10), **ends)


def gates(seed: int, count: int = 6) -> cfree.Scene:
    """Walls one after the other, a gate in each."""
    rng = np.random.default_rng(seed)
    walls = []
    for k in range(count):
        width, y = rng.uniform(0.8, 1.6), rng.uniform(-1.5, 1.5)
        x, low, high = 3 * k + 3, 3 + y - width / 2, 3 - y - width / 2
        walls += [box(x, -3, 0.4, low), box(x, y + width / 2, 0.4, high)]
    ends = {"start": cfree.Pose(1, 0), "goal": cfree.Pose(3 * count + 2, 0)}
    return cfree.Scene(box(-0.6, -0.3, 1.2, 0.6), walls, workspace=box(0, -3, 3 * count + 3, 6), **ends)


def maze(seed: int, side: int = 6) -> cfree.Scene:
    """One way between any two of the cells of a square: walls that a walk over all of them did not pass."""
    rng = np.random.default_rng(seed)
    way, seen, opened = [(0, 0)], {(0, 0)}, set()
    while way:
        x, y = way[-1]
        near = [(x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)]
        fresh = [cell for cell in near if min(cell) >= 0 and max(cell) < side and cell not in seen]
        if not fresh:
            way.pop()
            continue
        cell = fresh[rng.integers(len(fresh))]
        seen.add(cell)
        opened.add(frozenset((way[-1], cell)))
        way.append(cell)
    half, walls = 1 / 16, []
    for x in range(side):
        for y in range(side):
            if x + 1 < side and frozenset(((x, y), (x + 1, y))) not in opened:
                walls.append(box(x + 1 - half, y - half, 2 * half, 1 + 2 * half))
            if y + 1 < side and frozenset(((x, y), (x, y + 1))) not in opened:
                walls.append(box(x - half, y + 1 - half, 1 + 2 * half, 2 * half))
    ends = {"start": cfree.Pose(0.5, 0.5), "goal": cfree.Pose(side - 0.5, side - 0.5)}
    return cfree.Scene(box(-0.3, -0.12, 0.6, 0.24), walls, workspace=box(0, 0, side, side), **ends)
