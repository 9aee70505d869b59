"""Cars: `cfree.plan(vehicle=car)` beside OMPL's RRTConnect in a ReedsSheppStateSpace, native, with the same pose test.

Questions: real car parks and warehouses, the 70 seeded ones of `families.py`, corners of aisles of 1.0 to 1.3 times
the least width (`vehicle_scenes.py`). Every path is driven by its controls alone and looked at by shapely
(`integrate.py`).

Times are the process's; only the second in which a path is improved is the clock's. In the environment RUNS=3 is the
number of OMPL's runs, CAP=10 the seconds of each, BEST=10 the time for its simplified paths. FAMILIES="real maze aisle"
takes only these, AISLES=5 fewer aisles, ROOMS=10 fewer rooms for cars without reverse gear (`forward_rooms.py`).
"""

from __future__ import annotations

import math
import os
import random
import statistics
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from forward_rooms import CAR, forward_rooms
from integrate import driven
from measure import Report
from ompl_vehicles import STEP, Run, runs
from vehicle_scenes import AISLES, Question, questions

import cfree
from cfree import _core
from cfree.paths.preferences import NONE, dues_of
from cfree.planning.core_ways import numbers_of
from cfree.planning.vehicles import numbers_of_vehicle

RUNS, CAP, BEST = (float(os.environ.get(name, value)) for name, value in (("RUNS", 3), ("CAP", 10), ("BEST", 10)))
ROUNDS, SEED = 3, 7
ROOMS, ROOM_CAP = int(os.environ.get("ROOMS", 100)), 3  # for cars without reverse gear; OMPL's seconds in each
IMPROVE = 1.0  # seconds
PAIRS, CALLS = 50, 2000  # of words that are timed, and calls of each
CUSPS = {"parking1": (4, 3), "parking2": (3, 1), "parking3": (2, 1), "warehouse1": (2, 1), "warehouse2": (5, 3)}
COLUMNS = ("question", "answer", "holonomic ms", "first ms", "first cusps", "OMPL ms", "solved", "clip", "first / OMPL",
           "first / holonomic", "length", "cusps", "kept", "OMPL's", "cusps", "clip", "cost / OMPL's")  # fmt: skip


@dataclass(slots=True)
class Row:
    """Of one question; what does not apply is nan."""

    name: str
    is_contact_free: bool
    answer: str = ""
    holonomic: float = math.nan
    first: float = math.nan
    first_cusps: float = math.nan
    length: float = math.nan
    cusps: float = math.nan
    short_cusps: float = math.nan  # without balance
    kept: float = math.nan  # least distance, in what is to be kept
    driven: list[bool] = field(default_factory=list)  # of each path: true if it is right and free
    firsts: list[Run] = field(default_factory=list)
    best: Run | None = None
    radius: float = math.nan

    @property
    def is_decided(self) -> bool:
        return self.answer in ("path", "separated", "stuck")

    @property
    def rival(self) -> float:
        """Median seconds of the rival's first path; those of a run without one are the time given up at."""
        seconds = [CAP if math.isnan(run.seconds) else run.seconds for run in self.firsts]
        return statistics.median(seconds) if seconds else math.nan

    @property
    def fails(self) -> bool:
        """True if the rival finds nothing in half of its runs."""
        return bool(self.firsts) and 2 * sum(run.paths == 0 for run in self.firsts) >= len(self.firsts)

    @property
    def cost_to_rival(self) -> float:
        if self.best is None:
            return math.nan
        return (self.length + self.radius * self.cusps) / (self.best.length + self.radius * self.best.cusps)

    @property
    def cells(self) -> tuple[str, ...]:
        solved = f"{sum(run.paths for run in self.firsts)}/{len(self.firsts)}" if self.firsts else ""
        best = self.best or Run(math.nan, 0, 0, 0, math.nan, math.nan)
        clip = str(sum(run.clipped for run in self.firsts)) if self.firsts else ""
        its_clip = f"{best.clipped}/{best.paths}" if self.best else ""
        return (
            self.name, self.answer, _number(1e3 * self.holonomic), _number(1e3 * self.first), _number(self.first_cusps),
            _number(1e3 * self.rival), solved, clip, _number(self.first / self.rival),
            _number(self.first / self.holonomic), _number(self.length), _number(self.cusps), _number(self.kept),
            _number(best.length), _number(best.cusps), its_clip, _number(self.cost_to_rival),
        )  # fmt: skip


def run(quick: bool) -> list[Report]:
    report = Report(
        "Cars",
        COLUMNS,
        notes=[
            f"milliseconds of the processor, medians of {ROUNDS} from a scene just read; OMPL: of {RUNS:g} runs of",
            f"{CAP:g} s at most, motions tested every {STEP:.1%} of the space's extent; no run where there is no path",
            "first: cfree.plan(vehicle=car, improve=0), every motion proved; holonomic: the same without a vehicle",
            f"length, cusps: of the axle point, after {IMPROVE:g} s; kept: the least distance, in what is to be kept,",
            "half of the holonomic path's or a twentieth of the robot's length; OMPL's: the cheapest path by length +",
            f"radius x cusps of {BEST:g} s that does not clip, each simplified; clip: paths with a pose that is not",
            "free, by steps a hundred times finer",
        ],
    )
    chosen = questions(quick, os.environ.get("FAMILIES"), int(os.environ.get("AISLES", AISLES)))
    rows = []
    for question in chosen:
        rows.append(compare(question))
        report.rows.append(rows[-1].cells)
        print(*report.rows[-1], file=sys.stderr, flush=True)
    figures(report, rows)
    return [report, forward_only(3 if quick else ROOMS), words()]


def compare(question: Question) -> Row:
    """Ask both, and check the paths."""
    scene, car = question.fresh(), question.car
    row = Row(question.name, not _touches(scene), radius=float(car.turning_radius))
    row.holonomic, _ = _median(lambda: cfree.plan(question.fresh(), vehicle="any", improve=0))
    row.first, answer = _median(lambda: cfree.plan(question.fresh(), vehicle=car, improve=0))
    row.answer = _named(answer)
    if not isinstance(answer, cfree.Path):
        return row
    row.first_cusps, row.driven = answer.cusps, [driven(answer, scene).is_right]
    better = _asked(lambda: cfree.plan(scene, vehicle=car, improve=IMPROVE))
    assert isinstance(better, cfree.Path), "the first answer was a path"
    row.driven.append(driven(better, scene).is_right)
    row.length, row.cusps = sum(part.length for part in better.driving), better.cusps
    if question.name in CUSPS:
        short = _asked(lambda: cfree.plan(scene, vehicle=car, improve=IMPROVE, objective="short"))
        row.short_cusps = short.cusps
        row.driven.append(driven(short, scene).is_right)
        holonomic = _asked(lambda: cfree.plan(scene, vehicle="any"))
        wanted = min(cfree.clearance(holonomic, scene).least / 2, dues_of(NONE, scene, car).length / 20)
        row.kept = cfree.clearance(better, scene).least / wanted
    orders = [f"first {SEED + k} {CAP}" for k in range(int(RUNS))]
    found = runs(scene, car, [*orders, f"best {SEED} {BEST}"])
    if found:
        *row.firsts, row.best = found
    return row


def figures(report: Report, rows: Sequence[Row]) -> None:
    """Medians and worst ratios, and what is to be true of every path."""
    contact_free = [row for row in rows if row.is_contact_free]
    joined = [row for row in rows if row.answer == "path"]
    solved = [row for row in joined if row.firsts and not row.fails]
    paths = [is_right for row in rows for is_right in row.driven]
    count = f"{len(contact_free)} questions"
    report.figure("cars, answered", count, _mean(row.is_decided for row in contact_free), ">=", 1)
    report.figure("cars, paths that integrate to their ends and are free", f"{len(paths)}", _mean(paths), ">=", 1)
    report.figure("cars, paths that clip", f"{len(paths)}", len(paths) - sum(paths), "<=", 0)
    if undecided := [f"{row.name}, {row.answer}" for row in contact_free if not row.is_decided]:
        report.notes.append(f"not answered: {'; '.join(undecided)}")
    if any(row.firsts for row in joined):
        raw = [run for row in joined for run in row.firsts]
        best = [row.best for row in joined if row.best]
        (paths_raw, clipped), (simplified, its_clipped) = map(_counts, (raw, best))
        report.notes += [
            f"OMPL solves {paths_raw} of {len(raw)} runs; {clipped} of these paths clip,",
            f"and {its_clipped} of {simplified} simplified ones",
        ]
    else:
        report.notes.append("no OMPL: it takes libompl-dev (Debian), and the core built in this clone (make)")
    _ratios(
        report, "cars, first proved path, in OMPL's first one's time", joined, lambda row: row.first / row.rival, 0.5
    )
    worst = [row for row in solved if math.isfinite(row.first / row.rival)]
    if worst:
        last = max(worst, key=lambda row: row.first / row.rival)
        what = "cars, first proved path, in OMPL's first one's time"
        report.figure(what, f"the worst: {last.name}", last.first / last.rival, "<=", 3)
    if hard := [row for row in joined if row.fails]:
        last = max(hard, key=lambda row: row.first)
        what = "cars, first proved path where OMPL fails in half of its runs"
        report.figure(what, f"the slowest of {len(hard)}: {last.name}", last.first, "<=", 0.2, " s")
        median = statistics.median(row.first for row in hard)
        report.notes.append(f"the median of these {len(hard)} is {median:.3g} s")
    _ratios(report, "cars, first proved path, in the first holonomic one's time", joined,
            lambda row: row.first / row.holonomic, 3)  # fmt: skip
    _ratios(report, f"cars, length + radius x cusps after {IMPROVE:g} s, to OMPL's after {BEST:g} s", joined,
            lambda row: row.cost_to_rival, 1)  # fmt: skip
    for row in rows:
        if row.name in CUSPS and row.answer == "path":
            balanced, short = CUSPS[row.name]
            report.figure(f"cars, cusps after {IMPROVE:g} s", row.name, row.cusps, "<=", balanced)
            report.figure(f"cars, cusps after {IMPROVE:g} s, not balanced", row.name, row.short_cusps, "<=", short)
            report.figure("cars, least distance, in what is to be kept", row.name, row.kept, ">=", 1)


def forward_only(count: int) -> Report:
    """Cars without reverse gear in random rooms: a path, a proof that there is none, or neither."""
    tally, seconds, right, found = Counter[str](), dict[str, list[float]](), list[bool](), list[Run]()
    for scene in forward_rooms(count, SEED):
        start = time.process_time()
        answer = _asked(lambda scene=scene: cfree.plan(scene, vehicle=CAR, improve=0))  # type: ignore[misc]
        name = "open" if isinstance(answer, cfree.UndecidedError) else type(answer).__name__
        seconds.setdefault(name, []).append(time.process_time() - start)
        tally[name] += 1
        if isinstance(answer, cfree.Path):
            right.append(driven(answer, scene).is_right)
        found += runs(scene, CAR, [f"first {SEED} {ROOM_CAP}"]) or []
        print("room", sum(tally.values()), name, file=sys.stderr, flush=True)
    report = Report("Cars without reverse gear in random rooms", ("answer", "rooms", "median s", "most s"))
    for name, number in tally.most_common():
        times = seconds[name]
        report.rows.append((name, str(number), _number(statistics.median(times)), _number(max(times))))
    if found:
        solved, clipped = _counts(found)
        report.notes.append(
            f"OMPL's RRT in a DubinsStateSpace finds {solved} in {ROOM_CAP} s each; {clipped} of them clip"
        )
    decided = 1 - tally["open"] / count
    report.figure("cars without reverse gear, found or proved impossible", f"{count} rooms", decided, ">=", 0.7)
    if right:
        report.figure("cars without reverse gear, paths that are right", f"{len(right)}", _mean(right), ">=", 1)
    return report


def words() -> Report:
    """Times of a word of Reeds and Shepp, and of its exact form."""
    rng, car = random.Random(SEED), cfree.Car(1)
    times = []
    for _ in range(PAIRS):
        start, goal = (cfree.Pose(*(rng.uniform(-3, 3) for _ in range(3))) for _ in range(2))
        numbers: Any = numbers_of_vehicle(car), numbers_of(start), numbers_of(goal)
        rounds = [_core.time_words(*numbers, CALLS) for _ in range(3)]
        times.append(tuple(1e6 * min(seconds[k] for seconds in rounds) for k in (0, 1)))
    report = Report("Words of Reeds and Shepp", ("", "median µs", "worst µs"))
    for k, (what, most) in enumerate((("in doubles", 2), ("its exact form", 20))):
        its = [pair[k] for pair in times]
        report.rows.append((what, _number(statistics.median(its)), _number(max(its))))
        report.figure(
            f"word of Reeds and Shepp, {what}", f"median of {PAIRS}", statistics.median(its), "<=", most, " µs"
        )
    return report


def _ratios(report: Report, what: str, rows: Iterable[Row], ratio: Callable[[Row], float], most: float) -> None:
    values = [value for row in rows if math.isfinite(value := ratio(row))]
    if values:
        report.figure(what, f"median of {len(values)}", statistics.median(values), "<=", most)


def _counts(found: Iterable[Run]) -> tuple[int, int]:
    """Paths, and those of them that clip."""
    its = [*found]
    return sum(run.paths for run in its), sum(run.clipped for run in its)


def _touches(scene: cfree.Scene) -> bool:
    """True if the robot touches something at start or goal."""
    ends = (scene.start, scene.goal)
    return any(cfree.clearance(cfree.Path(pose, []), scene).least <= 0 for pose in ends if pose is not None)


def _median(ask: Callable[[], object]) -> tuple[float, Any]:
    """Median seconds of the process, and the last answer."""
    seconds = []
    for _ in range(ROUNDS):
        start = time.process_time()
        answer = _asked(ask)
        seconds.append(time.process_time() - start)
    return statistics.median(seconds), answer


def _asked(ask: Callable[[], Any]) -> Any:
    try:
        return ask()
    except cfree.UndecidedError as error:
        return error


def _named(answer: object) -> str:
    if isinstance(answer, cfree.UndecidedError):
        return "exists" if answer.path is not None else "undecided"
    return type(answer).__name__.lower()


def _mean(values: Iterable[bool]) -> float:
    return statistics.fmean(its) if (its := [*values]) else math.nan


def _number(value: float) -> str:
    return f"{value:.3g}" if math.isfinite(value) else ""
