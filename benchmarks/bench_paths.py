"""Would one send it to a machine? What paths keep of the distance they could, how much they turn, what that costs.

Seeded questions that have a path, and the project's larger scenes. The distance that a path could keep is that of
`max_margin`, of any way; times are of the process.
"""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable

from families import QUESTIONS
from measure import SCENES, Report

import cfree

Maker = Callable[[], cfree.Scene]
STORED = ("benchmr_parking1", "flat", "sofa_corner", "comb_hook")
ASKED = {
    "maze": (0, 1, 3),
    "trap": (0, 1, 3),
    "barrier": (0, 3, 4),
    "field": (0, 1),
    "throat": (0, 1, 3),
    "large": (0, 1),
}


def run(quick: bool) -> Report:
    report = Report(
        "What paths keep",
        ("scene", "first ms", "default ms", "ratio", "proved", "margin", "share", "motions", "turning deg"),
        notes=["first: improve=0; proved: least clearance of the default path; margin: the largest of any way, +- 5 %"],
    )
    makers: dict[str, Maker] = {
        f"{name} {seed}": lambda make=QUESTIONS[name], seed=seed: make(seed)  # type: ignore[misc]
        for name, seeds in ASKED.items()
        for seed in seeds
    }
    makers |= {name: lambda n=name: cfree.load_scene(SCENES / f"{n}.json") for name in STORED}  # type: ignore[misc]
    shares, ratios = zip(
        *(row(name, make, report) for name, make in list(makers.items())[: 2 if quick else None]), strict=True
    )
    count = f"{len(shares)} scenes"
    report.figure("default path, share of the largest margin, least", count, min(shares), ">=", 0.5)
    report.figure("default path, in the first answer's time", f"median of {count}", statistics.median(ratios), "<=", 3)
    return report


def row(name: str, make: Maker, report: Report) -> tuple[float, float]:
    _, first = spent(lambda scene: cfree.plan(scene, improve=0), make)
    path, default = spent(cfree.plan, make)
    assert isinstance(path, cfree.Path)
    scene = make()
    margin = cfree.max_margin(scene, tolerance=0.05).lo
    place = cfree.clearance(path, scene, tolerance=margin / 50)
    assert place is not None
    share, turning = place.least / margin, math.degrees(path.turning)
    numbers = f"{first:.3g}", f"{default:.3g}", f"{default / first:.2f}", f"{place.least:.3g}", f"{margin:.3g}"
    report.rows.append((name, *numbers, f"{share:.2f}", str(len(path.motions)), f"{turning:.0f}"))
    return share, default / first


def spent(work: Callable[[cfree.Scene], object], make: Maker) -> tuple[object, float]:
    """What it gives of a new scene, and the fewest milliseconds of the process in three rounds."""
    times = []
    for _ in range(3):
        scene = make()
        start = time.process_time()
        found = work(scene)
        times.append(1e3 * (time.process_time() - start))
    return found, min(times)
