"""Round shapes beside polygons with as many edges as one would give them: `cfree.plan` among curves and among 32-gons.

Scenes are seeded, and none is chosen by its answer: a disc, a stadium or a rounded rectangle among at least 20 discs,
or among ellipses and closed splines in a disc; one that just gets out of a ring; and the examples. 32-gons around discs
decide where there is a path among them, 32-gons inside where there is none among these. Only there times are compared,
with that of the one that decides: the processor's, of all threads, with polygons for curves made anew, refinement
included.
"""

from __future__ import annotations

import gc
import math
import random
import statistics
import time
from collections.abc import Callable

from measure import SCENES, Report

import cfree
from cfree.curves import Arc, Ellipse, Spline, curved
from cfree.formats.scene_file import scene_from_text, scene_text
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import AnyShape

ROUNDS, EDGES, SEEDS = 3, 32, 9
FAR = 1 / math.cos(math.pi / EDGES) - 1  # corners of a circumscribed polygon, beyond the rim of a disc of radius 1
COLUMNS = ("scene", "round", "answer", "32-gons", "plan ms", "32-gons ms", "ratio")


def run(quick: bool) -> Report:
    report = Report("Round shapes", COLUMNS, notes=[f"ms of the processor, the fastest of {ROUNDS} rounds"])
    seeds = range(1 if quick else SEEDS)
    made = {f"{name} {seed}": make(seed) for name, make in FAMILIES.items() for seed in seeds}
    shipped = {path.stem: cfree.load_scene(path) for path in sorted(SCENES.glob("round_*.json"))}
    for what, scenes in {"seeded": made, "examples": shipped}.items():
        ratios = [ratio for name, scene in scenes.items() if (ratio := compare(name, scene, report)) is not None]
        case = f"{len(ratios)} of {len(scenes)} {what}"
        report.figure("plan among curves, to 32-gons, median", case, statistics.median(ratios), "<=", 3)
        report.figure("plan among curves, to 32-gons, worst", case, max(ratios), "<=", 3)
    return report


def compare(name: str, scene: cfree.Scene, report: Report) -> float | None:
    """A row of the table; the ratio of times if 32-gons decide."""
    seconds, answer = timed(scene)
    least, same = timed(straight(scene, outward=answer != "Separated"))
    ratio = seconds / least if same == answer else None
    count = sum(isinstance(shape, cfree.Curved) for shape in (*scene.robot, *scene.obstacles, scene.workspace))
    shown = f"{1e3 * seconds:.0f}", f"{1e3 * least:.0f}", "" if ratio is None else f"{ratio:.2f}"
    report.rows.append((name, str(count), answer, same, *shown))
    return ratio


def timed(given: cfree.Scene) -> tuple[float, str]:
    """Least seconds, and the kind of answer, from a scene just read, with no polygon for a curve in memory."""
    found, answer, text = [], "", scene_text(given)
    for _ in range(ROUNDS):
        scene = scene_from_text("scene", text)
        for kept in (curved._near, curved._grown, curved._pieces):
            kept.cache_clear()
        gc.collect()
        start = time.process_time()
        try:
            answer = type(cfree.plan(scene)).__name__
        except (cfree.InvalidPoseError, cfree.UndecidedError) as error:
            answer = type(error).__name__
        found.append(time.process_time() - start)
    return min(found), answer


def straight(scene: cfree.Scene, *, outward: bool) -> cfree.Scene:
    """With 32-gons for discs, around or inside, and polygons as near to other curves; a workspace the other way."""

    def of(shape: AnyShape, outward: bool) -> tuple[Polygon, ...]:
        if not isinstance(shape, cfree.Curved):
            return (shape,)
        return shape.outer(error_of(shape)) if outward else shape.inner(error_of(shape))

    (room,) = of(scene.workspace, not outward) if scene.workspace else (None,)
    parts, obstacles = (
        [p for shape in shapes for p in of(shape, outward)] for shapes in (scene.robot, scene.obstacles)
    )
    assert scene.start and scene.goal
    return cfree.Scene(
        parts, obstacles, workspace=room, bounds=scene.bounds, start=scene.start, goal=scene.goal, name=scene.name
    )


def error_of(shape: cfree.Curved) -> float:
    """At which a disc of its size has 32 edges, as `Curved.outer` divides errors; of a grown shape, its disc."""
    return 1.001 * FAR * (2 * float(shape.grown) if shape.grown else shape.size / 2 * math.sqrt(2) / 0.9)


# scenes


def number(value: float) -> str:
    return f"{value:.6f}"


def stadium(length: float, width: float) -> cfree.Curved:
    x, y = number(length / 2), number(width / 2)
    ends = (f"-{x}", f"-{y}"), (x, f"-{y}"), (x, y), (f"-{x}", y)
    return cfree.Curved([ends[0], ends[1], Arc(ends[2], center=(x, 0)), ends[3], Arc(ends[0], center=(f"-{x}", 0))])


def rounded(length: float, width: float, radius: float) -> cfree.Curved:
    x, y = number(length / 2 - radius), number(width / 2 - radius)
    return cfree.Curved([(f"-{x}", f"-{y}"), (x, f"-{y}"), (x, y), (f"-{x}", y)], grown=number(radius))


def discs(robot: cfree.Curved, seed: int, count: int) -> cfree.Scene:
    """Discs of many sizes at random in a square, none near its lower left and upper right corner."""
    rng, found = random.Random(seed), list[cfree.Curved]()
    while len(found) < count:
        x, y, r = rng.uniform(0, 14), rng.uniform(0, 14), rng.uniform(0.3, 1.1)
        if min(math.hypot(x - 1, y - 1), math.hypot(x - 13, y - 13)) > r + 1.2:
            found.append(cfree.Curved.circle((number(x), number(y)), number(r)))
    return cfree.Scene(robot, found, bounds=(0, 0, 14, 14), start=(1, 1, 0), goal=(13, 13, "90deg"))


def ring(seed: int) -> cfree.Scene:
    """A disc in a ring of pillars, with one gap that is wider by 0.4 % to 4 %."""
    turns, far = [2 * math.pi * k / 14 for k in range(14)], 3.4
    radius = far * math.sin(math.pi / 14) - (1.004 + 0.004 * seed) / 2
    found = [
        cfree.Curved.circle((number(far * math.cos(t)), number(far * math.sin(t))), number(radius + 0.02 * (k > 1)))
        for k, t in enumerate(turns)
    ]
    disc = cfree.Curved.circle((0, 0), "1/2")
    return cfree.Scene(disc, found, bounds=(-7, -7, 7, 7), start=(0, 0, 0), goal=(6, 1, 0))


def garden(seed: int) -> cfree.Scene:
    """Ellipses and closed splines in a disc, none near to where the stadium begins and ends."""
    rng, found = random.Random(seed), list[cfree.Curved]()
    while len(found) < 24:
        x, y = (rng.uniform(-9, 9) for _ in range(2))
        if min(math.hypot(x + 7.5, y), math.hypot(x - 7.5, y)) < 2.2:
            continue
        if len(found) % 2:
            a, b, turn = number(rng.uniform(0.4, 1)), number(rng.uniform(0.3, 0.7)), f"{rng.uniform(0, 360):.1f}deg"
            found.append(cfree.Curved(Ellipse((number(x), number(y)), (a, b), turn)))
            continue
        radii = [rng.uniform(0.5, 1.2) for _ in range(7)]
        around = [(x + r * math.cos(k), y + r * math.sin(k)) for k, r in zip(map(float, range(7)), radii, strict=True)]
        ring = [(number(p), number(q)) for p, q in around[:6]]
        found.append(cfree.Curved([ring[0], Spline([*ring[1:], ring[0]])]))
    ends = {"start": cfree.Pose("-7.5", 0, "90deg"), "goal": cfree.Pose("7.5", 0, "90deg")}
    return cfree.Scene(stadium(0.7, 0.5), found, workspace=cfree.Curved.circle((0, 0), 10), **ends)


FAMILIES: dict[str, Callable[[int], cfree.Scene]] = {
    "disc": lambda seed: discs(cfree.Curved.circle((0, 0), number(0.35 + 0.05 * (seed % 5))), seed, 40),
    "stadium": lambda seed: discs(stadium(1 + 0.1 * (seed % 5), 0.6), seed + 100, 36),
    "rounded": lambda seed: discs(rounded(1.4, 0.7 + 0.05 * (seed % 5), 0.2), seed + 200, 36),
    "garden": garden,
    "ring": ring,
}
