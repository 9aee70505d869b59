"""Random degenerate scenes, their slices compared exactly, until a time is up or one is wrong; that one is made small.

    python tests/support/fuzz.py --seconds 600 --seed 7 --kinds boxes fit
    python tests/support/fuzz.py SCENE.json

A scene is named by its kind and number: the same name is the same scene for ever.
"""

from __future__ import annotations

import argparse
import math
import multiprocessing
import random
import sys
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import count
from pathlib import Path
from typing import Any

import shapely

import shapes
from cfree import Boundary, boundary, load_scene
from cfree.errors import InvalidPolygonError
from cfree.formats.scene_file import scene_text
from compared import plain_of, scene_of
from compared_exactly import Undecided, differences, rational_angles
from shapes import PlainScene, Point, Shape, box, l_shape, mapped, moved, quarter_turned, random_lattice_shape, scaled
from strategies import convex_ring

PRIME = 1_000_003  # no critical angle of a small scene has this denominator
TURNS = [(Fraction(3, 5), Fraction(4, 5)), (Fraction(12, 13), Fraction(5, 13)), (Fraction(4, 5), Fraction(-3, 5))]
UNLUCKY = (2**61 - 1, 4342619061296019901, 3612245056613796809)  # the last two are the first in curve_hashes.cpp
PATIENCE = 20.0  # seconds for one boundary


def mistakes(plain: PlainScene, seed: str) -> tuple[list[str], int]:
    """Faults of a scene's boundary, and the number of slices compared; none if the scene is not valid."""
    try:
        scene = scene_of(plain)
    except InvalidPolygonError:
        return [], 0
    rng, compared = random.Random(seed), 0
    try:
        result = boundary(scene, threads=1, progress=_deadline())
        assert result.complex.components or not len(result.trapezoids)
        generic = [Fraction(rng.randint(-3 * PRIME, 3 * PRIME), PRIME) for _ in range(2)]
        for half_tangent in [*generic, *_critical(result, rng)]:
            try:
                wrong = differences(result, half_tangent, plain)
            except Undecided:
                continue
            compared += 1
            if wrong:
                return wrong, compared
    except Exception:
        return [traceback.format_exc()], compared
    return [], compared


def _critical(result: Boundary, rng: random.Random) -> list[Fraction | None]:
    """Right angles, some rational critical angles, and simple ones."""
    angles = rational_angles(result)
    chosen = rng.sample(angles, min(4, len(angles)))
    return list({*chosen, rng.choice([None, Fraction(0), Fraction(1), Fraction(-1)]), Fraction(rng.randint(-3, 3), 2)})


def _deadline() -> Callable[[float], None]:
    end = time.monotonic() + PATIENCE

    def check(_: float) -> None:
        if time.monotonic() > end:
            raise TimeoutError(f"not finished after {PATIENCE} s")

    return check


# --- scenes ---


def scene(kind: str, number: int) -> PlainScene:
    """A scene of a kind, half of the time changed so that it degenerates further."""
    rng = random.Random(f"{kind} {number}")
    plain = KINDS[kind](rng)
    if rng.random() < 0.15:
        turn = rng.choice(TURNS)
        plain = plain._replace(robot=[turned(shape, turn) for shape in plain.robot])
    if rng.random() < 0.2:
        plain = bounded(rng, plain)
    if rng.random() < 0.15:
        plain = walled(rng, plain)
    if rng.random() < 0.1:
        plain = everywhere(plain, lambda x, y: (x / 3, y / 3))
    return plain


def lattice(rng: random.Random, size: int = 5) -> Shape:
    """A simple or convex polygon, a box, or a box with a lattice hole; small integers."""
    make = rng.choice([_simple, _simple, _convex, _box, _holed])
    return make(rng, size)


def _simple(rng: random.Random, size: int) -> Shape:
    return random_lattice_shape(rng, size, rng.randint(3, 7))


def _convex(rng: random.Random, size: int) -> Shape:
    return convex_ring(_simple(rng, size)[0]), []


def _box(rng: random.Random, size: int) -> Shape:
    return box(0, 0, rng.randint(1, size), rng.randint(1, size))


def _holed(rng: random.Random, size: int) -> Shape:
    hole = _simple(rng, max(2, size - 2))[0]
    xs, ys = zip(*hole, strict=True)
    return box(min(xs) - 1, min(ys) - 1, max(xs) + 1, max(ys) + 1)[0], [hole[::-1]]


def placed(rng: random.Random, shape: Shape, reach: int = 5) -> Shape:
    shape = quarter_turned(shape, rng.randint(0, 3))
    return moved(shape, rng.randint(-reach, reach), rng.randint(-reach, reach))


def boxes(rng: random.Random) -> PlainScene:
    """Overlapping, touching and aligned boxes; the robot is one or a few."""
    robot = [placed(rng, _box(rng, 2), 1) for _ in range(rng.choice([1, 1, 2, 3]))]
    return PlainScene(robot, [placed(rng, _box(rng, 4)) for _ in range(rng.randint(1, 6))])


def lattices(rng: random.Random) -> PlainScene:
    robot = [placed(rng, lattice(rng, 3), 2) for _ in range(rng.choice([1, 1, 2]))]
    return PlainScene(robot, [placed(rng, lattice(rng)) for _ in range(rng.randint(1, 4))])


def congruent(rng: random.Random) -> PlainScene:
    """Robot and obstacles are copies, turned and mirrored, of one shape: all directions are common."""
    shape = lattice(rng, 4)
    copies = [placed(rng, rng.choice([shape, shapes.mirrored(shape)])) for _ in range(rng.randint(1, 3))]
    return PlainScene([placed(rng, shape, 2)], copies)


def fit(rng: random.Random) -> PlainScene:
    """A robot that fits a hole of its own shape exactly, or by a hair, or by a hair does not."""
    shape = rng.choice([_simple, _convex, _box])(rng, 4)
    hair = rng.choice([0, 0, 0, Fraction(1, 2**40), -Fraction(1, 2**40), Fraction(1, 10)])
    wall = box(-1, -1, 5, 5)[0], [scaled(shape, 1 + hair)[0][::-1]] if hair < Fraction(1, 20) else []
    walls = [wall] if rng.random() < 0.6 else [box(-1, -1, 5, 0), box(-1, -1, 0, 5), placed(rng, shape, 2)]
    return PlainScene([moved(shape, rng.randint(-2, 2), rng.randint(-2, 2))], [*walls, *_some(rng, lattice)])


def corridor(rng: random.Random) -> PlainScene:
    """Two walls as far apart as the robot is wide, or as its diagonal is long: 3-4-5 and 5-12-13 rectangles."""
    a, b, diagonal = rng.choice([(3, 4, 5), (5, 12, 13), (1, 2, 1), (2, 1, 2), (1, 1, 1)])
    gap = rng.choice([a, b, diagonal]) + rng.choice([0, 0, Fraction(1, 10**12), -Fraction(1, 10**12)])
    long = 2 * b + rng.randint(1, 9)
    walls = [box(0, -rng.randint(1, 3), long, 0), box(rng.randint(0, 3), gap, long, gap + rng.randint(1, 2))]
    walls += rng.choice([[], [box(long, -1, long + 1, gap + 1)], [box(-1, -1, 0, gap + 1)]])
    if rng.random() < 0.3:
        turn = rng.choice(TURNS)
        walls = [turned(wall, turn) for wall in walls]
    return PlainScene([moved(box(0, 0, a, b), -rng.choice([0, 1, a]), -rng.choice([0, 1, b]))], walls)


def cut(rng: random.Random) -> PlainScene:
    """A convex polygon cut into a fan of triangles, some of them missing, some twice."""
    ring = _convex(rng, 6)[0]
    fan = [([ring[0], ring[k], ring[k + 1]], []) for k in range(1, len(ring) - 1)]
    obstacles = rng.choices(fan, k=rng.randint(1, len(fan) + 1)) if rng.random() < 0.5 else fan
    return PlainScene([placed(rng, lattice(rng, 3), 2)], [*obstacles, *_some(rng, lattice)])


def chain(rng: random.Random) -> PlainScene:
    """Polygons that touch at vertices or along edges; the robot is like them."""
    link = rng.choice([
        [(1, 0), (0, 1), (-1, 0), (0, -1)],
        [(1, 0), (Fraction(3, 5), Fraction(4, 5)), (-Fraction(3, 5), Fraction(4, 5)), (-1, 0), (0, -1)],
        [(2, 0), (1, 1), (-1, 1), (-2, 0), (-1, -1), (1, -1)],
        [(0, 0), (2, 0), (1, 2)],
    ])  # fmt: skip
    step = rng.choice([(2, 0), (0, 2), (1, 1), (4, 0), (2, 2), (3, 1)])
    links = [moved((link, []), k * step[0], k * step[1]) for k in range(rng.randint(2, 4))]
    return PlainScene([placed(rng, (link, []), 1) if rng.random() < 0.6 else placed(rng, lattice(rng, 2), 1)], links)


def sliver(rng: random.Random) -> PlainScene:
    """Lattice shapes with vertices moved by a hair: nearly collinear edges, nearly coincident vertices."""
    hair = Fraction(1, rng.choice([2**40, 10**12, 2**52, 10**15]))
    plain = lattices(rng)

    def shaken(x: Any, y: Any) -> Point:
        return x + hair * rng.choice([0, 0, 0, 1, -1]), y + hair * rng.choice([0, 0, 0, 1, -1])

    return plain._replace(obstacles=[mapped(shape, shaken) for shape in plain.obstacles])


def words(rng: random.Random) -> PlainScene:
    """Lattice shapes moved by powers of two, short modulo 2^61 - 1, or times numbers that are 0 modulo a prime."""
    plain = rng.choice([boxes, lattices, fit, sliver])(rng)
    powers = rng.sample([58, 59, 60, 61, 62, 119, 120, 121, 122, 183], 2)
    hairs = [Fraction(n, 2**k) for k in powers for n in (0, 0, 1, 1, -1, 2)]
    factor = rng.choice([1, 1, *UNLUCKY, UNLUCKY[0] * UNLUCKY[1]])

    def shaken(x: Any, y: Any) -> Point:
        return x + rng.choice(hairs), y + rng.choice(hairs)

    robot = [mapped(shape, shaken) for shape in plain.robot] if rng.random() < 0.5 else plain.robot
    obstacles = [mapped(shape, shaken) for shape in plain.obstacles]
    return everywhere(plain._replace(robot=robot, obstacles=obstacles), lambda x, y: (x * factor, y * factor))


def feet(rng: random.Random) -> PlainScene:
    """A robot of points that touch at once: small triangles at lattice points, among lattice shapes."""
    foot = [(0, 0), (Fraction(1, 2), 0), (0, Fraction(1, 2))]
    robot = [placed(rng, (foot, []), 3) for _ in range(rng.randint(2, 4))]
    return PlainScene(robot, [placed(rng, lattice(rng, 4), 3) for _ in range(rng.randint(1, 3))])


def pythagorean(rng: random.Random) -> PlainScene:
    """Lattice shapes, each turned by a rational angle: critical angles are rational."""
    plain = rng.choice([boxes, lattices, congruent])(rng)
    return plain._replace(obstacles=[turned(shape, rng.choice(TURNS)) for shape in plain.obstacles])


def parts(rng: random.Random) -> PlainScene:
    """Robots of several parts and with holes, an obstacle inside one perhaps."""
    robot = [placed(rng, _holed(rng, 4), 2)]
    if rng.random() < 0.6:
        robot.append(placed(rng, lattice(rng, 2), 3))
    small = [placed(rng, scaled(lattice(rng, 3), Fraction(1, 4)), 2) for _ in range(rng.randint(1, 3))]
    return PlainScene(robot, small)


def tiny(rng: random.Random) -> PlainScene:
    """Some obstacles 2^-k of the others' size, at a vertex or on an edge of one, or just beside it."""
    plain, e = lattices(rng), Fraction(1, 2 ** rng.randint(5, 200))
    small = []
    for _ in range(rng.randint(1, 3)):
        ring = rng.choice(plain.obstacles)[0]
        k = rng.randrange(len(ring))
        (x0, y0), (x1, y1) = ring[k], ring[(k + 1) % len(ring)]
        share = rng.choice([Fraction(0), Fraction(1, 2), Fraction(1, 3), e])
        x, y = x0 + share * (x1 - x0), y0 + share * (y1 - y0)
        part = scaled(lattice(rng, 3), e)
        small.append(moved(part, x + e * rng.randint(-3, 3), y + e * rng.randint(-3, 3)))
    if rng.random() < 0.2:
        plain = plain._replace(robot=[*plain.robot, scaled(lattice(rng, 3), e)])
    return plain._replace(obstacles=[*plain.obstacles, *small])


def rims(rng: random.Random) -> PlainScene:
    """Bounds through vertices and along edges of obstacles."""
    plain = lattices(rng)
    xs = sorted({x for shape in plain.obstacles for x, _ in shape[0]} | {rng.randint(-6, 6)})
    ys = sorted({y for shape in plain.obstacles for _, y in shape[0]} | {rng.randint(-6, 6)})
    (x0, x1), (y0, y1) = sorted(rng.sample(xs, 2)), sorted(rng.sample(ys, 2))
    return plain._replace(bounds=(x0, y0, x1, y1))


def mazes(rng: random.Random) -> PlainScene:
    """Boxes that leave corridors as wide as the robot is, or nearly, in a room."""
    size, walls = 3, []
    for x in range(size):
        for y in range(size):
            if rng.random() < 0.45:
                walls.append(box(2 * x, 2 * y, 2 * x + rng.choice([1, 2]), 2 * y + rng.choice([1, 2])))
    robot = rng.choice([box(0, 0, 1, 1), box(0, 0, 1, 2), l_shape(2, 1), box(0, 0, 1, Fraction(1, 2))])
    outer = box(0, 0, 2 * size, 2 * size)
    return PlainScene([quarter_turned(robot, rng.randint(0, 3))], walls, None, outer)


def crowds(rng: random.Random) -> PlainScene:
    """A room full of lattice shapes, the robot about as large as they are, and gaps as wide as it."""
    walls = [moved(lattice(rng, 3), rng.randint(-1, 6), rng.randint(-1, 6)) for _ in range(rng.randint(2, 5))]
    robot = [placed(rng, lattice(rng, 2), 1) for _ in range(rng.choice([1, 1, 2]))]
    return PlainScene(robot, walls, None, box(0, 0, rng.randint(5, 7), rng.randint(5, 7)))


def spikes(rng: random.Random) -> PlainScene:
    """A star of many convex pieces among shapes as large as it: most patches are deep inside of pillars."""
    count = rng.randint(8, 16)
    radii = [rng.randint(4, 8) if k % 2 else rng.randint(1, 3) for k in range(count)]
    angles = [math.tau * k / count for k in range(count)]
    ring = [(round(r * math.cos(a)), round(r * math.sin(a))) for r, a in zip(radii, angles, strict=True)]
    if len({*ring}) < count or not shapely.Polygon(ring).is_valid:
        return spikes(rng)
    return PlainScene([(ring, [])], [placed(rng, lattice(rng, 9), 9) for _ in range(rng.randint(1, 4))])


def far(rng: random.Random) -> PlainScene:
    """Scene turned by a long rational, offset by 1e9, its reference point 100 or a million away: all, or some of it."""
    plain = rng.choice([boxes, lattices, corridor, fit, parts])(rng)
    tau, tilt = (rng.choice([Fraction(0), rational(rng, rng.randint(2, 20))]) for _ in range(2))
    x, y = rng.choice([(0, 0), (10**9, -(10**9)), (2**40, Fraction(1, 3))])
    dx, dy = rng.choice([(0, 0), (rng.randint(-100, 100), 60), (10**6, 1)])
    turn, back = (((1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)) for t in (tau, tilt))
    obstacles = [moved(turned(shape, turn), x, y) for shape in plain.obstacles]
    return plain._replace(robot=[turned(moved(shape, dx, dy), back) for shape in plain.robot], obstacles=obstacles)


def _some(rng: random.Random, make: Callable[[random.Random, int], Shape]) -> list[Shape]:
    return [placed(rng, make(rng, 3)) for _ in range(rng.choice([0, 0, 1, 2]))]


def rational(rng: random.Random, digits: int) -> Fraction:
    """p / q of so many digits, of either sign."""
    p, q = (rng.randrange(10 ** (digits - 1), 10**digits) for _ in range(2))
    return Fraction(rng.choice([-1, 1]) * p, q)


def turned(shape: Shape, turn: Point) -> Shape:
    c, s = turn
    return mapped(shape, lambda x, y: (c * x - s * y, s * x + c * y))


def everywhere(plain: PlainScene, image: Callable[[Fraction, Fraction], Point]) -> PlainScene:
    """The same map, which keeps axes, on every coordinate."""

    def shape_of(shape: Shape) -> Shape:
        return mapped(shape, lambda x, y: image(Fraction(x), Fraction(y)))

    bounds = plain.bounds and (*image(*map(Fraction, plain.bounds[:2])), *image(*map(Fraction, plain.bounds[2:])))
    workspace = plain.workspace and shape_of(plain.workspace)
    return PlainScene([*map(shape_of, plain.robot)], [*map(shape_of, plain.obstacles)], bounds, workspace)


def bounded(rng: random.Random, plain: PlainScene) -> PlainScene:
    """Bounds that may coincide with walls."""
    x0, y0 = rng.randint(-3, 2), rng.randint(-3, 2)
    return plain._replace(bounds=(x0, y0, x0 + rng.randint(1, 8), y0 + rng.randint(1, 8)))


def walled(rng: random.Random, plain: PlainScene) -> PlainScene:
    """A workspace that may coincide with walls, or with the robot."""
    shape = rng.choice([_box, _simple, _holed])(rng, 8)
    return plain._replace(workspace=rng.choice([moved(shape, -2, -2), plain.robot[0], moved(box(0, 0, 9, 9), -3, -3)]))


KINDS: dict[str, Callable[[random.Random], PlainScene]] = {
    f.__name__: f
    for f in (boxes, lattices, congruent, fit, corridor, cut, chain, sliver, words, feet, pythagorean,
              parts, tiny, rims, mazes, crowds, spikes, far)
}  # fmt: skip


# --- making a wrong scene small ---


def reduced(plain: PlainScene, is_wrong: Callable[[PlainScene], bool]) -> PlainScene:
    """Smaller scene that is still wrong; nothing more can be left out or made simpler."""
    while True:
        smaller = next((other for other in simpler(plain) if other != plain and is_wrong(other)), None)
        if smaller is None:
            return plain
        plain = smaller


def simpler(plain: PlainScene) -> Iterator[PlainScene]:
    """Large steps first: without bounds, an obstacle, a part, a hole, a vertex; then with simpler numbers."""
    if plain.bounds:
        yield plain._replace(bounds=None)
    if plain.workspace:
        yield plain._replace(workspace=None)
    for name, least in (("obstacles", 0), ("robot", 1)):
        shapes_of: list[Shape] = getattr(plain, name)
        for k, (outer, holes) in enumerate(shapes_of):

            def with_shape(*now: Shape, name: str = name, k: int = k, old: list[Shape] = shapes_of) -> PlainScene:
                return plain._replace(**{name: [*old[:k], *now, *old[k + 1 :]]})

            if len(shapes_of) > least:
                yield with_shape()
            for h in range(len(holes)):
                yield with_shape((outer, holes[:h] + holes[h + 1 :]))
            for r, ring in enumerate([outer, *holes]):
                for v in range(len(ring) if len(ring) > 3 else 0):
                    rings = [outer, *holes]
                    rings[r] = ring[:v] + ring[v + 1 :]
                    yield with_shape((rings[0], rings[1:]))
    numbers = {abs(Fraction(v)) for v in _numbers(plain)}
    for old in sorted(numbers, key=lambda v: (v.denominator, v), reverse=True):
        for new in {Fraction(0), Fraction(round(old)), old / 2 if old > 1 else old, old - 1 if old > 1 else old}:
            if _size(new) < _size(old):
                yield everywhere(plain, lambda x, y: tuple(_replaced(v, old, new) for v in (x, y)))  # type: ignore  # noqa: B023


def _size(v: Fraction) -> tuple[int, int]:
    return v.denominator, abs(v.numerator)


def _replaced(v: Fraction, old: Fraction, new: Fraction) -> Fraction:
    return v if abs(v) != old else (new if v > 0 else -new)


def _numbers(plain: PlainScene) -> Iterator[Any]:
    for outer, holes in [*plain.robot, *plain.obstacles, *([plain.workspace] if plain.workspace else [])]:
        for ring in [outer, *holes]:
            for p in ring:
                yield from p
    yield from plain.bounds or ()


# --- the run ---


def work(name: tuple[str, int]) -> tuple[str, int, list[str], int]:
    kind, number = name
    return kind, number, *mistakes(scene(kind, number), f"{kind} {number}")


def run(kinds: list[str], seed: int, seconds: float) -> int:
    end, scenes, slices = time.monotonic() + seconds, Counter[str](), 0
    names = ((kind, number) for number in count(seed * 10_000_000) for kind in kinds)
    with multiprocessing.Pool(2) as pool:
        for kind, number, wrong, compared in pool.imap_unordered(work, names, chunksize=4):
            scenes[kind] += 1
            slices += compared
            if sum(scenes.values()) % 20 == 0:
                print(f"\r{sum(scenes.values())} scenes, {slices} slices", end="", flush=True)
            if wrong:
                print(f"\n{kind} {number} is wrong:", *wrong[:5], sep="\n")
                report(scene(kind, number), f"{kind} {number}")
                return 1
            if time.monotonic() > end:
                break
        pool.terminate()
    print(f"\r{sum(scenes.values())} scenes, {slices} slices compared exactly, none wrong: {dict(scenes)}")
    return 0


def report(plain: PlainScene, seed: str) -> None:
    small = reduced(plain, lambda other: bool(mistakes(other, seed)[0]))
    print("reduced:", *mistakes(small, seed)[0][:5], sep="\n")
    print(scene_text(scene_of(small)))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", type=Path, help="scene files to compare instead of random scenes")
    parser.add_argument("--seconds", type=float, default=600)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--kinds", nargs="+", default=list(KINDS), choices=list(KINDS))
    options = parser.parse_args()
    if not options.scenes:
        return run(options.kinds, options.seed, options.seconds)
    wrong = {str(path): mistakes(plain_of(load_scene(path)), "0")[0] for path in options.scenes}
    for path, lines in wrong.items():
        print(path, *(lines or ["all slices are right"]), sep="\n  ")
    return int(any(wrong.values()))


if __name__ == "__main__":
    sys.exit(main())
