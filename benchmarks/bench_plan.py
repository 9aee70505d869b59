"""From start to goal: `cfree.plan` beside OMPL's RRTConnect, over seeded families of questions and the real scenes.

Times are the process's, of all its threads: other work on the machine matters little. In the environment CAP=5 gives
RRTConnect five seconds a run, RUNS=5 more runs; FAMILIES="maze nest" only these.
"""

from __future__ import annotations

import math
import os
import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec

from families import QUESTIONS, SEEDS
from measure import POLYGONS, Report
from ompl_rival import SIMPLIFY, Runs, rival

import cfree
import cfree.verify
from cfree.formats.scene_file import scene_from_text, scene_text
from cfree.scene.scene import robot_radius

CAP, RUNS = float(os.environ.get("CAP", 5)), int(os.environ.get("RUNS", 3))
ROUNDS = 3
TOY = 5  # obstacles at most of a scene that counts in no median
MANY = 30  # obstacles at least of a scene whose proof is compared with its boundary
SOON = 0.01  # seconds; default paths are compared with first ones that take as long, or longer
SLOW = 0.02  # seconds of RRTConnect that are worth saving
BAD = 2  # ratio of a scene that is named below the table
COLUMNS = ("scene", "obstacles", "answer", "first ms", "default ms", "boundary ms", "RRTConnect ms", "solved", "clip",
           "first / RRT", "first / boundary", "default / first*", "motions", "waypoints",
           "length / OMPL's")  # fmt: skip


@dataclass(slots=True)
class Row:
    """Of one scene; ratios that do not apply are nan."""

    name: str
    obstacles: int
    is_path: bool
    free: bool
    first_to_rival: float  # of unsolved ones, to the time given up at
    first_to_slow_rival: float
    first_to_boundary: float
    default_to_first: float
    motions_to_waypoints: float
    length_to_rival: float
    verify_to_first: float  # of proofs


def run(quick: bool) -> list[Report]:
    if missing := [name for name in ("numba", "ompl") if find_spec(name) is None]:
        return [Report("From start to goal", (), notes=[f"no {', no '.join(missing)}; pip install -e '.[bench,ompl]'"])]
    stored = {path.stem: cfree.load_scene(path) for path in POLYGONS}
    stored = {name: scene for name, scene in stored.items() if scene.start and scene.goal}
    counted: dict[str, Callable[[], cfree.Scene]] = {
        f"{name} {seed}": lambda make=QUESTIONS[name], seed=seed: make(seed)  # type: ignore[misc]
        for name in os.environ.get("FAMILIES", " ".join(QUESTIONS)).split()
        for seed in (SEEDS[:3] if quick else SEEDS)
    }
    counted |= {name: lambda s=scene: s for name, scene in stored.items() if len(scene.obstacles) > TOY}  # type: ignore[misc]
    toys = {name: scene for name, scene in stored.items() if len(scene.obstacles) <= TOY}
    report = Report(
        "From start to goal",
        COLUMNS,
        notes=[
            f"milliseconds of the processor, medians of {ROUNDS} from a scene just read; RRTConnect: of {RUNS} runs of",
            f"{CAP:g} s at most, motions looked at every 0.1 % of the space's extent; no run where there is no path",
            "first: cfree.plan with improve=0; imports and compilation are not counted, convex pieces are, on both",
            f"first*: the first path's, but at least {1e3 * SOON:g} ms",
            "clip: solutions that are not free; those with ? come too close to an obstacle to tell",
            f"waypoints, length: of OMPL's paths simplified for {SIMPLIFY:g} s, medians of those that do not clip;",
            'ours: of the default path, and of one with objective="short", improved as long',
        ],
    )
    rows = [compare(name, make(), report) for name, make in counted.items()]
    figures(report, rows)
    small = Report(f"Toys, {TOY} obstacles at most, in no median", COLUMNS)
    for name, scene in list(toys.items())[: 1 if quick else None]:
        compare(name, scene, small)
    return [report, small]


def figures(report: Report, rows: list[Row]) -> None:
    """Medians and worst ratios; the scenes that are worse than they should be."""
    joined = [row for row in rows if row.is_path]
    proved = [row for row in rows if not row.is_path]
    separated = [row for row in proved if row.obstacles >= MANY]
    for what, chosen, ratio, most, worst in (  # no target for the worst: None
        ("first path, in RRTConnect's time", joined, "first_to_rival", 0.7, 2),
        (f"first path, in RRTConnect's time over {1e3 * SLOW:g} ms", joined, "first_to_slow_rival", 0.25, 0.8),
        (f"proof, in its whole boundary's time, {MANY} obstacles or more", separated, "first_to_boundary", 0.3, 1.2),
        (f"default path, in the first one's time or {1e3 * SOON:g} ms", joined, "default_to_first", 2.5, 5),
        ("verify of a proof, in the time of proving it", proved, "verify_to_first", 2, 2),
        ("motions, to OMPL's simplified waypoints", joined, "motions_to_waypoints", 1.5, None),
        ("length, to OMPL's simplified", joined, "length_to_rival", 1.05, None),
    ):
        ratios = {row.name: value for row in chosen if math.isfinite(value := getattr(row, ratio))}
        if not ratios:
            continue
        last = max(ratios, key=ratios.__getitem__)
        report.figure(what, f"median of {len(ratios)} scenes", statistics.median(ratios.values()), "<=", most)
        if worst is not None:
            report.figure(what, f"the worst: {last}", ratios[last], "<=", worst)
        bad = [
            f"{name} {value:.3g}" for name, value in sorted(ratios.items(), key=lambda item: -item[1]) if value > BAD
        ]
        if bad:
            report.notes.append(f"{what}: worse than {BAD}: {', '.join(bad)}")
    report.figure(
        "plan, paths that are free", f"{len(joined)} scenes", min((row.free for row in joined), default=1), ">=", 1
    )


def compare(name: str, scene: cfree.Scene, report: Report) -> Row:
    text = scene_text(scene)

    def fresh() -> cfree.Scene:
        return scene_from_text(name, text)

    answer = cfree.plan(scene)
    is_path = isinstance(answer, cfree.Path)
    first, default, boundary = (
        statistics.median(spent(call, fresh()) for _ in range(ROUNDS))
        for call in (lambda s: cfree.plan(s, improve=0), cfree.plan, cfree.boundary)
    )
    verify = math.nan
    if not is_path:
        verify = statistics.median(spent(lambda s: cfree.verify.answer(s, answer), fresh()) for _ in range(ROUNDS))
    runs = rival(fresh, CAP, RUNS) if is_path else Runs()
    theirs, waypoints, length = (median(values) for values in (runs.seconds, runs.waypoints, runs.lengths))
    ours = math.nan
    if is_path:
        short = cfree.plan(scene, objective="short", improve=SIMPLIFY)
        assert isinstance(short, cfree.Path)
        ours = short.length + robot_radius(scene) * short.turning
    motions = len(answer.motions) if isinstance(answer, cfree.Path) else 0
    free = isinstance(answer, cfree.Path) and answer.is_free(cfree.MotionChecker(scene))
    in_slow = first / theirs if theirs > SLOW else math.nan
    later = default / max(first, SOON) if is_path else math.nan
    row = Row(name, len(scene.obstacles), is_path, free, first / theirs, in_slow, first / boundary, later,
              motions / waypoints, ours / length, verify / first)  # fmt: skip
    clip = str(runs.clip) + (f" +{runs.undecided}?" if runs.undecided else "")
    solved = (f"{runs.solved}/{len(runs.seconds)}", clip) if is_path else ("", "")
    times = (_number(1e3 * seconds) for seconds in (first, default, boundary, theirs))
    ratios = map(_number, (row.first_to_rival, row.first_to_boundary, row.default_to_first))
    counts = str(motions) if is_path else "", _number(waypoints), _number(row.length_to_rival)
    report.rows.append(
        (name, str(row.obstacles), "path" if is_path else "separated", *times, *solved, *ratios, *counts)
    )
    print(*report.rows[-1], file=sys.stderr, flush=True)
    return row


def spent(call: Callable[[cfree.Scene], object], scene: cfree.Scene) -> float:
    """Seconds of the process."""
    start = time.process_time()
    call(scene)
    return time.process_time() - start


def median(values: list[float] | list[int]) -> float:
    return statistics.median(values) if values else math.nan


def _number(value: float) -> str:
    return f"{value:.3g}" if math.isfinite(value) else ""
