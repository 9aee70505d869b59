"""Before the core's first patch: polygons read and checked, convex pieces, one number for every feature."""

from __future__ import annotations

import json
import math
import random
import sys
import time
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory

from measure import ROOT, SCENES, Report, measured

import cfree
from cfree.scene.features import scene_features

sys.path.append(str(ROOT / "tests" / "support"))
from reference_features import scene_features as features_in_python
from reference_pieces import convex_pieces
from reference_rings import read_rings

Rings = list[list[tuple[str | float, str | float]]]
AT_MOST = {  # ms
    "nest_shirts": 2,
    "nest_swim": 4,
    "street_Berlin": 5,
    "benchmr_warehouse": 5,
    "robot of 68 vertices, 8,400": 40,
    "25,000 obstacles": 300,
}


def run(quick: bool) -> Report:
    report = Report(
        "Scenes before the core's first patch, processor time",
        ("scene", "vertices", "from lists, ms", "from a file, ms", "from lists in Python, ms", "ratio"),
        notes=["lists: of text for scenes of files, else of floats; Python: what the tests compare with"],
    )
    with TemporaryDirectory() as folder:
        for name in list(AT_MOST)[:4]:
            file = Path(SCENES) / f"{name}.json"
            scene = cfree.load_scene(file)
            compare(report, name, file, *(as_text(shapes) for shapes in (scene.robot, scene.obstacles)), quick)
        for name, robot, obstacles in (stars(), quads(2_500 if quick else 25_000)):
            file = Path(folder) / "scene.json"
            shapes = ([{"outer": outer, "holes": holes} for outer, *holes in part] for part in (robot, obstacles))
            file.write_text(json.dumps(dict(zip(("robot", "obstacles"), shapes, strict=True))))
            compare(report, name, file, robot, obstacles, quick)
    return report


def compare(report: Report, name: str, file: Path, robot: list[Rings], obstacles: list[Rings], quick: bool) -> None:
    scene = scene_of(robot, obstacles)
    lists, texts = measured(
        lambda: seconds(lambda: scene_features(scene_of(robot, obstacles))),
        lambda: seconds(lambda: scene_features(cfree.load_scene(file))),
        rounds=3 if quick else 7,
    )
    python = lambda: seconds(lambda: by_reference(scene, robot, obstacles))  # noqa: E731
    (reference,) = measured(python, rounds=1 if quick else 2, warm_up=False)
    vertices = f"{sum(map(len, scene.robot))} + {sum(map(len, scene.obstacles)):,}"
    ratio = f"{reference.best / lists.best:.0f}"
    report.rows.append((name, vertices, lists.text(), texts.text(), reference.text(), ratio))
    if not quick:
        report.figure("scene from lists", name, 1e3 * lists.best, "<=", AT_MOST[name], " ms")


def as_text(shapes: tuple[cfree.Polygon, ...]) -> list[Rings]:
    return [
        [[(str(x), str(y)) for x, y in shape.exact_vertices[i:j]] for i, j in pairwise(shape.ring_offsets)]
        for shape in shapes
    ]


def star(rng: random.Random, n: int, x: float = 0, y: float = 0) -> Rings:
    radii = [1 + rng.random() / 2 for _ in range(n)]
    return [[(x + r * math.cos(math.tau * k / n), y + r * math.sin(math.tau * k / n)) for k, r in enumerate(radii)]]


def stars() -> tuple[str, list[Rings], list[Rings]]:
    rng = random.Random(1)
    around = [star(rng, 60, 4.0 * (k % 12), 4.0 * (k // 12)) for k in range(140)]
    return "robot of 68 vertices, 8,400", [star(rng, 68)], around


def quads(count: int) -> tuple[str, list[Rings], list[Rings]]:
    rng = random.Random(2)
    obstacles: list[Rings] = []
    for k in range(count):
        x, y, u = 3.0 * (k % 160), 3.0 * (k // 160), [rng.random() / 2 for _ in range(8)]
        lower = [(x + u[0], y + u[1]), (x + 2 - u[2], y + u[3])]
        upper = [(x + 2 - u[4], y + 2 - u[5]), (x + u[6], y + 2 - u[7])]
        obstacles.append([lower + upper])
    return f"{count:,} obstacles", [[[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]]], obstacles


def scene_of(robot: list[Rings], obstacles: list[Rings]) -> cfree.Scene:
    return cfree.Scene(
        *(
            [outer if not holes else cfree.Polygon(outer, holes) for outer, *holes in shapes]
            for shapes in (robot, obstacles)
        )
    )


def by_reference(scene: cfree.Scene, robot: list[Rings], obstacles: list[Rings]) -> None:
    """The same by Python: rings, pieces, numbers."""
    for outer, *holes in (*robot, *obstacles):
        read_rings(outer, holes)
    for polygon in (*scene.robot, *scene.obstacles):
        vars(polygon)["pieces"] = convex_pieces(polygon)
    _ = features_in_python(scene).core


def seconds(call: Callable[[], object]) -> float:
    start = time.process_time()
    call()
    return time.process_time() - start
