"""OMPL for cars as a native program, `ompl_vehicles.cpp`, with cfree's own exact check of poses.

It is compiled where g++ finds OMPL's headers (Debian's package `libompl-dev`) and the core is built in this clone.
"""

from __future__ import annotations

import math
import subprocess
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import cfree
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import robot_radius

ROOT = Path(__file__).parents[1]
STEP = 0.001  # of the space's extent; OMPL's default is 0.01


@dataclass(frozen=True)
class Run:
    """Of one run: processor seconds to its first path, states tested, paths, those that clip; the cheapest free path.

    What there is none of is nan.
    """

    seconds: float
    looked: int
    paths: int
    clipped: int
    length: float
    cusps: float


def runs(scene: cfree.Scene, car: cfree.Car, orders: Sequence[str], step: float = STEP) -> list[Run] | None:
    """Answers to orders such as "first 7 10" or "best 7 10": kind, seed and seconds. None where there is no rival."""
    program = compiled()
    if program is None:
        return None
    text = "\n".join([*question(scene, car, step), *orders])
    done = subprocess.run([program], input=text, capture_output=True, text=True, check=True)
    return [_run(line) for line in done.stdout.splitlines()]


def question(scene: cfree.Scene, car: cfree.Car, step: float) -> Iterable[str]:
    """Lines of the rival's input."""
    for part in scene.robot:
        yield from rings("robot", "robot-hole", part)
    for obstacle in scene.obstacles:
        yield from rings("obstacle", "hole", obstacle)
    if scene.workspace is not None:
        yield from rings("workspace", "workspace", scene.workspace)
    if scene.bounds is not None:
        yield f"bounds {' '.join(map(str, scene.bounds))}"
    ax, ay = map(float, car.axle)
    heading = car.frame.theta
    yield f"car {float(car.turning_radius)!r} {ax!r} {ay!r} {heading!r}"
    x0, y0, x1, y1 = limits(scene)
    away = math.hypot(ax, ay)
    yield f"space {x0 - away!r} {y0 - away!r} {x1 + away!r} {y1 + away!r} {step!r}"
    for name, pose in (("start", scene.start), ("goal", scene.goal)):
        assert pose is not None
        axle = pose @ car.frame
        yield f"{name} {float(axle.x)!r} {float(axle.y)!r} {math.remainder(axle.theta, math.tau)!r}"
    if car.gears == "forward":
        yield "forward"


def limits(scene: cfree.Scene) -> tuple[float, float, float, float]:
    """Bounds of the scene; else the box of its workspace; else that of all it has, enlarged by the robot."""
    if scene.bounds is not None:
        x0, y0, x1, y1 = map(float, scene.bounds)
        return x0, y0, x1, y1
    polygons = [scene.workspace] if scene.workspace is not None else scene.obstacles
    points = [point for polygon in polygons for point in polygon.vertices.tolist()]
    more = 0.0 if scene.workspace is not None else 2 * robot_radius(scene)
    points += [(float(pose.x), float(pose.y)) for pose in (scene.start, scene.goal) if pose is not None]
    xs, ys = zip(*points, strict=True)
    return min(xs) - more, min(ys) - more, max(xs) + more, max(ys) + more


def rings(outer: str, hole: str, polygon: Polygon) -> Iterable[str]:
    """A line a ring, the outer one first."""
    for k, ring in enumerate(polygon.exact_rings):
        yield f"{hole if k else outer} {' '.join(f'{x} {y}' for x, y in ring)}"


def _run(line: str) -> Run:
    seconds, looked, paths, clipped, length, cusps = line.split()
    numbers = (math.nan if float(text) < 0 else float(text) for text in (seconds, length, cusps))
    first, its_length, its_cusps = numbers
    return Run(first, int(looked), int(paths), int(clipped), its_length, its_cusps)


@cache
def compiled() -> Path | None:
    try:
        import boost_headers
    except ImportError:
        return None
    libraries = sorted(ROOT.glob("build/*/libcfree_core.a"), key=lambda path: path.stat().st_mtime)
    headers = sorted(Path("/usr/include").glob("ompl-*"))
    if not libraries or not headers:
        return None
    source, program = Path(__file__).with_suffix(".cpp"), Path(mkdtemp()) / "ompl_vehicles"
    folders = [ROOT / "cpp/include", boost_headers.get_include(), headers[-1], "/usr/include/eigen3"]
    command = ["g++", "-std=c++20", "-O2", "-DNDEBUG", *(f"-I{folder}" for folder in folders), str(source)]
    subprocess.run([*command, str(libraries[-1]), "-lompl", "-lpthread", "-o", str(program)], check=True)
    return program
