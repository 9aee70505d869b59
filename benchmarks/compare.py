"""The page docs/comparison.md: cfree, OMPL, grid search, stacks of slices and CGAL, on the same scenes in one run.

python benchmarks/compare.py [--only NAME ...] [--pictures FOLDER]     # tables in Markdown; 25 minutes for all scenes

Whether there is a path is what cfree says, after `cfree.verify` has proved it by other code. Paths of others clip if
one of many poses along their motions overlaps an obstacle, where `PoseChecker.sweep_is_free` does not prove them free.
"""

from __future__ import annotations

import argparse
import math
import statistics
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from pathlib import Path

import cgal_slices
import compare_pictures
import grid_search
import numpy as np
import shapely
from bench_free import numba_tables, pieces_of
from families import QUESTIONS
from measure import REAL, SCENES, machine
from ompl_rival import Sweep, looked_at_again, motion_kernel, rival
from shapely_slices import grouped, sums_by_merging
from slice_stack import Stack, orientations

import cfree
import cfree.verify
from cfree.formats.scene_file import scene_from_text, scene_text
from cfree.scene.features import scene_features
from cfree.scene.scene import robot_radius

BOTH = ("maze", "trap", "barrier", "nest", "throat")  # of these seeds 0 and 2, of which one is shut; of others seed 0
NAMES = (*REAL, "flat", *(f"{name} {seed}" for name in QUESTIONS for seed in ((0, 2) if name in BOTH else (0,))))
CAP, RUNS = 5.0, 3
FINE = 1e-4  # of the extent: how far apart poses are at which a motion is looked at that is not proved free
SLICES = 20
SURE, RIGHT, CLIPS, MISSED, FALSE, NOTHING = "sure", "right", "clips", "missed", "false", "nothing"
MARKS = {SURE: "", RIGHT: "", NOTHING: " **–**", CLIPS: " **c**", MISSED: " **m**", FALSE: " **f**"}  # ever worse


@dataclass(frozen=True)
class Question:
    """A scene that nobody has looked at yet, and where it is searched."""

    name: str
    scene: cfree.Scene

    def fresh(self) -> cfree.Scene:
        return scene_from_text(self.name, self.text)

    @cached_property
    def text(self) -> str:
        return scene_text(self.scene)

    @cached_property
    def box(self) -> tuple[float, float, float, float]:
        from cfree.ompl import state_space

        bounds = state_space(self.scene).getBounds()
        return bounds.low[0], bounds.low[1], bounds.high[0], bounds.high[1]

    @cached_property
    def finer(self) -> float:
        return FINE * math.hypot(self.box[2] - self.box[0], self.box[3] - self.box[1])

    @cached_property
    def ends(self) -> tuple[np.ndarray, np.ndarray]:
        start, goal = (np.array([float(p.x), float(p.y), p.theta]) for p in (self.scene.start, self.scene.goal))
        return start, goal

    @cached_property
    def checker(self) -> cfree.PoseChecker:
        return cfree.PoseChecker(self.scene)

    @cached_property
    def has_path(self) -> bool:
        """What is true, proved."""
        answer = cfree.plan(self.scene)
        verified = cfree.verify.answer(self.scene, answer)
        if not verified.verified:
            raise RuntimeError(f"{self.name}: {verified}")
        return isinstance(answer, cfree.Path)

    def judged(self, sweeps: Sequence[Sweep] | None, sure_paths: bool) -> str:
        """An answer: motions of which none may clip, or None for no path; whether all paths of this way are free."""
        if sweeps is None:
            return MISSED if self.has_path else RIGHT
        if not self.has_path:
            return FALSE
        if looked_at_again(self.checker, sweeps, self.finer) == "clips":
            return CLIPS
        return SURE if sure_paths else RIGHT


@dataclass(frozen=True, slots=True)
class Answers:
    """Of one way to answer and one question: what the answers are worth, and processor seconds of each."""

    verdicts: tuple[str, ...]
    seconds: tuple[float, ...]

    @property
    def pairs(self) -> list[tuple[str, float]]:
        """Each answer once: what it is worth, and its seconds, or the median of a way that always says the same."""
        if len(self.verdicts) == 1:
            return [(self.verdicts[0], statistics.median(self.seconds))]
        return list(zip(self.verdicts, self.seconds, strict=True))

    @property
    def text(self) -> str:
        worst = max(self.verdicts, key=list(MARKS).index)
        return shown(statistics.median(self.seconds)) + MARKS[worst]


Way = Callable[[Question], Answers]


def by_cfree(**options: float) -> Way:
    def ask(question: Question) -> Answers:
        verdicts, seconds = [], []
        for _ in range(RUNS):
            scene, start = question.fresh(), time.process_time()
            answer = cfree.plan(scene, **options)
            seconds.append(time.process_time() - start)
            right = cfree.verify.answer(question.scene, answer).verified
            verdicts.append(SURE if right and isinstance(answer, cfree.Path) == question.has_path else FALSE)
        return Answers(tuple(verdicts), tuple(seconds))

    return ask


def by_ompl(step: float) -> Way:
    def ask(question: Question) -> Answers:
        runs = rival(question.fresh, CAP, RUNS, step)
        solved = [CLIPS] * runs.clip + [RIGHT] * (runs.solved - runs.clip)
        if not question.has_path:
            solved = [FALSE] * runs.solved
        return Answers((*solved, *[NOTHING] * (RUNS - runs.solved)), tuple(runs.seconds))

    return ask


def by_grid(across: int, turns: int) -> Way:
    def search(question: Question) -> list[Sweep] | None:
        scene = question.fresh()
        features = scene_features(scene)
        tables = numba_tables(pieces_of(features.robot), pieces_of(features.obstacles))
        poses = grid_search.search(question.box, across, turns, robot_radius(scene), *question.ends, tables)
        if poses is None:
            return None
        return [(tuple(a), (*(b - a)[:2], math.remainder(b[2] - a[2], math.tau))) for a, b in pairwise(poses)]

    return lambda question: once(question, search, sure_paths=False)


def by_slices(count: int, swept: bool) -> Way:
    def search(question: Question) -> list[Sweep] | None:
        features = scene_features(question.fresh())
        thetas = orientations(count, *question.ends)
        pieces = pieces_of(features.robot), pieces_of(features.obstacles)
        turns = Stack(*pieces, question.box, thetas, swept).search(*question.ends)
        return None if turns is None else [((x, y, theta), (0.0, 0.0, by)) for x, y, theta, by in turns]

    return lambda question: once(question, search, sure_paths=swept)


def once(question: Question, search: Callable[[Question], list[Sweep] | None], sure_paths: bool) -> Answers:
    """Of a way that says the same every time: three times where it is quick."""
    seconds: list[float] = []
    while len(seconds) < RUNS and sum(seconds) < 1:
        start = time.process_time()
        found = search(question)
        seconds.append(time.process_time() - start)
    return Answers((question.judged(found, sure_paths),), tuple(seconds))


WAYS: dict[str, Way] = {
    "cfree, first": by_cfree(improve=0),
    "cfree, default": by_cfree(),
    "RRTConnect, 1 %": by_ompl(0.01),
    "RRTConnect, 0.1 %": by_ompl(0.001),
    "grid 100, 36": by_grid(100, 36),
    "grid 200, 72": by_grid(200, 72),
    "grid 400, 144": by_grid(400, 144),
    "45 slices": by_slices(45, swept=False),
    "120 slices": by_slices(120, swept=False),
    "360 slices": by_slices(360, swept=False),
    "45 swept slices": by_slices(45, swept=True),
    "120 swept slices": by_slices(120, swept=True),
    "360 swept slices": by_slices(360, swept=True),
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", choices=NAMES, default=NAMES, metavar="NAME", help="scenes")
    parser.add_argument("--pictures", type=Path, metavar="FOLDER")
    options = parser.parse_args()
    about, start = machine(), time.perf_counter()
    warm_up()
    results: dict[str, dict[str, Answers]] = {}
    slices, questions = [], [asked(name) for name in options.only]
    for question in questions:
        results[question.name] = {way: ask(question) for way, ask in WAYS.items()}
        slices.append((question.name, *one_slice(question.scene)))
        print(*slices[-1], *(answers.text for answers in results[question.name].values()), file=sys.stderr, flush=True)
    print_summary(results)
    print_table(
        ("scene", "obstacles", "path", *WAYS),
        [(q.name, str(len(q.scene.obstacles)), "yes" if q.has_path else "no",
          *(answers.text for answers in results[q.name].values())) for q in questions],
    )  # fmt: skip
    print_table(("scene", "cfree, all", "a slice of it", "Shapely", "CGAL, polygons", "CGAL, pieces"), slices)
    needle = Question("needle", compare_pictures.needle())
    ways = {way: ask(needle).verdicts[0] for way, ask in WAYS.items() if way.endswith("slices")}
    print("needle:", ", ".join(f"{way} {verdict}" for way, verdict in ways.items()))
    print(f"\n{time.perf_counter() - start:.0f} s in all;", "; ".join(f"{key} {value}" for key, value in about.items()))
    if options.pictures:
        dots = {way: [pair for row in results.values() for pair in row[way].pairs] for way in WAYS}
        compare_pictures.draw_times(dots).savefig(options.pictures / "comparison-times.png", dpi=100)
        compare_pictures.draw_slices(asked("throat 0").scene).savefig(
            options.pictures / "comparison-slices.png", dpi=100
        )


def asked(name: str) -> Question:
    family, _, seed = name.partition(" ")
    scene = QUESTIONS[family](int(seed)) if seed else cfree.load_scene(SCENES / f"{name}.json")
    return Question(name, scene)


def warm_up() -> None:
    """Compile what numba compiles, and load what is loaded late."""
    motion_kernel()
    question = asked("nest 2")
    for way in ("cfree, default", "grid 100, 36", "45 slices"):
        WAYS[way](question)


def one_slice(scene: cfree.Scene) -> tuple[str, ...]:
    """Processor milliseconds: the boundary on one thread, a slice of it, one by others; no bounds, no workspace."""
    scene = replace(scene, bounds=None, workspace=None)
    thetas = np.random.default_rng(7).uniform(-3, 3, SLICES).tolist()
    robot, obstacles = ([p.vertices[list(piece)] for p in shapes for piece in p.pieces]
                        for shapes in (scene.robot, scene.obstacles))  # fmt: skip
    pieces = grouped(robot), grouped(obstacles)
    whole = median_seconds(lambda _: cfree.boundary(replace(scene), threads=1), thetas[:5])
    boundary = cfree.boundary(scene)
    boundary.slice(thetas[0])  # builds what is looked up
    ours = median_seconds(lambda theta: boundary.slice(theta).forbidden, thetas)
    theirs = median_seconds(lambda theta: shapely.union_all(sums_by_merging(*pieces, theta)), thetas)
    exact = [
        cgal_slices.seconds(*polygons, thetas)
        for polygons in (
            [[polygon.rings for polygon in shapes] for shapes in (scene.robot, scene.obstacles)],
            [[[piece] for piece in pieces] for pieces in (robot, obstacles)],
        )
    ]
    return tuple("" if seconds is None else shown(seconds) for seconds in (whole, ours, theirs, *exact))


def median_seconds(call: Callable[[float], object], values: list[float]) -> float:
    seconds = []
    for value in values:
        start = time.process_time()
        call(value)
        seconds.append(time.process_time() - start)
    return statistics.median(seconds)


def print_summary(results: dict[str, dict[str, Answers]]) -> None:
    rows = []
    for way in WAYS:
        pairs = [pair for row in results.values() for pair in row[way].pairs]
        verdicts = [verdict for verdict, _ in pairs]
        medians = [statistics.median(row[way].seconds) for row in results.values()]
        counts = [str(verdicts.count(verdict)) for verdict in MARKS]
        rows.append((way, str(len(pairs)), *counts, shown(statistics.median(medians)), shown(max(medians))))
    print_table(("", "answers", "right and sure", "right", "no answer", "path clips", "path missed",
                 "path where none is", "median ms", "worst ms"), rows)  # fmt: skip


def shown(seconds: float) -> str:
    """In milliseconds."""
    ms = 1e3 * seconds
    if math.isnan(ms):
        return "gives up"
    return f"{ms:,.0f}" if ms >= 100 else f"{ms:.2g}" if ms < 10 else f"{ms:.3g}"


def print_table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    lines = [header, ["---", *["--:"] * (len(header) - 1)], *rows]
    print(*("| " + " | ".join(line) + " |" for line in lines), "", sep="\n")


if __name__ == "__main__":
    main()
