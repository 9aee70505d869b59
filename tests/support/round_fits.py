"""Scenes of rounded shapes that fit exactly, at random, and an oracle for their isolated parts: exact tests of poses.

python tests/support/round_fits.py --count 40
"""

from __future__ import annotations

import argparse
import cmath
import itertools
import math
import random
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from fractions import Fraction as F

import numpy as np

import cfree
from cfree import Boundary, Curved, Polygon, Scene
from cfree.collision.arcs import arcs_of
from cfree.curves import Arc
from cfree.exact.number import ExactPoint, rational_root
from cfree.exact.pose import Pose, pose_at
from cfree.forbidden.isolated import isolated_at, isolated_lines
from cfree.planning.contact_fits import Fits

Shape = Curved | Polygon
Place = tuple[float, float, float]
TURNS = [(F(1), F(0)), (F(3, 5), F(4, 5)), (F(-20, 29), F(21, 29)), (F(0), F(1)), (F(5, 13), F(-12, 13))]
AROUND = [(5, 0), (-5, 0), (0, 5), (0, -5), *itertools.product((3, -3), (4, -4)), *itertools.product((4, -4), (3, -3))]
BESIDE = 2.0**-19  # of the size
SLIVERS = 20_000  # places at random
WAYS = [(math.cos(0.123 + math.tau * k / 24), math.sin(0.123 + math.tau * k / 24)) for k in range(24)]


# --- scenes ---


def points(*places: tuple[object, object]) -> list[ExactPoint]:
    return [(F(x), F(y)) for x, y in places]  # type: ignore[arg-type]


def box(x0: object, y0: object, x1: object, y1: object) -> list[ExactPoint]:
    return points((x0, y0), (x1, y0), (x1, y1), (x0, y1))


def grown(core: Sequence[ExactPoint], radius: object) -> Shape:
    """A disc, a stadium whose length is rational, or a grown polygon."""
    r = F(radius)  # type: ignore[arg-type]
    if len(core) == 1:
        return Curved.circle(core[0], r)
    if len(core) > 2:
        return Curved(core, grown=r) if r else Polygon(core)
    (x, y), (u, v) = core
    length = rational_root((u - x) ** 2 + (v - y) ** 2)
    assert length
    a, b = (v - y) / length * r, (x - u) / length * r
    ends = Arc((u - a, v - b), center=(u, v)), Arc((x + a, y + b), center=(x, y))
    return Curved([(x + a, y + b), (u + a, v + b), ends[0], (x - a, y - b), ends[1]])


class Draw(random.Random):
    """Random scenes around the origin, in a random frame."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.turned, self.factor = self.choice(TURNS), self.choice([F(1), F(3), F(1, 7), F(1, 1000), F(10**6)])
        self.far = self.choice([(F(0), F(0)), (F(5), F(-3)), (F(10**7), F(3, 2))])
        self.reference = self.choice([(F(0), F(0)), (F(1, 2), F(-1, 3)), (F(40), F(7))])

    def still(self, core: Sequence[ExactPoint], radius: object) -> Shape:
        (c, s), f, (x0, y0) = self.turned, self.factor, self.far
        return grown([(f * (c * x - s * y) + x0, f * (s * x + c * y) + y0) for x, y in core], f * F(radius))  # type: ignore[arg-type]

    def moving(self, core: Sequence[ExactPoint], radius: object) -> Shape:
        f, (a, b) = self.factor, self.reference
        return grown([(f * (x + a), f * (y + b)) for x, y in core], f * F(radius))  # type: ignore[arg-type]

    def parts(self, low: int, high: int, of: int) -> Fraction:
        return F(self.randint(low, high), of)


def slot(r: Draw) -> Scene:
    """A rounded peg in a slot of its own width; its walls are rounded or not, and one is perhaps a row of discs."""
    w, h, radius, wall = r.parts(1, 4, 2), r.parts(1, 4, 2), r.parts(1, 4, 4), r.parts(0, 3, 4)
    core = r.choice([points((0, 0), (2 * w, 0)), box(-w, -h, w, h), points((0, -h), (0, h)), box(0, 0, 2 * w, h)])
    high, low = max(y for _, y in core) + radius + wall, min(y for _, y in core) - radius - wall
    end = r.randint(3, 8)
    others = [r.still(box(-end, high, end, high + 1), wall)]
    if r.random() < 0.5:
        others.append(r.still(box(-end - 1, low - 1, end + r.randint(0, 2), low), wall))
    elif wall:
        others += [r.still(points((x, low)), wall) for x in r.sample(range(-4, 5), 3)]
    else:
        others += [r.still(box(-end, low - 2, -1, low), 0), r.still(box(1, low - 2, end, low), 0)]
    return Scene(r.moving(core, radius), others)


def hole(r: Draw) -> Scene:
    """A rounded rectangle among walls that it touches on all sides, or on three."""
    h = r.parts(1, 3, 1)
    k, radius, wall = r.choice([h, h + 1]), r.parts(1, 4, 4), r.parts(0, 2, 2)
    a, b = h + radius + wall, k + radius + wall
    walls = [box(-a - 2, b, a + 2, b + 1), box(-a - 2, -b - 1, a + 2, -b), box(a, -b - 2, a + 1, b + 2)]
    if r.random() < 0.7:
        walls.append(box(-a - 1, -b - 2, -a, b + 2))
    return Scene(r.moving(box(-h, -k, h, k), radius), [r.still(points, wall) for points in walls])


def among(r: Draw) -> Scene:
    """A disc among discs that touch it, and perhaps a wall; perhaps another disc of the robot in a hole of its own."""
    own = r.randint(1, 4)
    robot = [r.moving(points((0, 0)), own)]
    others = [r.still(points(at), 5 - own) for at in r.sample(AROUND, r.randint(2, 4))]
    if r.random() < 0.3:
        others.append(r.still(box(-9, -own - 1, 9, -own), 0))
    if r.random() < 0.4:
        (x, y), second = r.choice([(30, 0), (0, -25), (18, 24)]), r.choice([F(own), F(own, 2)])
        robot.append(r.moving(points((x, y)), second))
        if r.random() < 0.5:
            others += [r.still(points((a + x, b + y)), 5 - second) for a, b in r.sample(AROUND, 3)]
    return Scene(robot, others)


def around(r: Draw) -> Scene:
    """Discs of the robot around a disc that they touch, and perhaps another disc."""
    own = r.randint(1, 4)
    robot = [r.moving(points(at), 5 - own) for at in r.sample(AROUND, r.randint(2, 4))]
    others = [r.still(points((0, 0)), own)]
    if r.random() < 0.4:
        others.append(r.still(points((r.choice([12, -30]), r.choice([0, 9]))), own))
    return Scene(robot, others)


def lattice(r: Draw) -> Scene:
    """Equal discs of the robot on a lattice of equal discs, with holes of their own size."""
    places = [(x, y) for x in range(r.randint(2, 4)) for y in range(r.randint(2, 3)) if r.random() < 0.8] or [(0, 0)]
    own, other = F(1, 2), F(1, 2)
    if r.random() < 0.5:
        places, other = [(3 * x, 4 * y) for x, y in places], F(2)
    chosen = r.sample(places, min(len(places), r.randint(1, 2)))
    x, y = chosen[0]
    robot = [r.moving(points((a - x, b - y)), own) for a, b in chosen]
    return Scene(robot, [r.still(points(at), other) for at in places])


def stadiums(r: Draw) -> Scene:
    """A stadium between discs, and perhaps walls at its ends."""
    radius, half, other = r.parts(1, 3, 2), r.randint(1, 3), r.parts(1, 4, 2)
    others = [
        r.still(points((x, side * (radius + other))), other)
        for side in (1, -1)
        for x in r.sample(range(-2, 3), r.randint(1, 2))
    ]
    end = half + radius
    others += [r.still(wall, 0) for wall in (box(end, -3, end + 1, 3), box(-end - 1, -3, -end, 3)) if r.random() < 0.5]
    return Scene(r.moving(points((-half, 0), (half, 0)), radius), others)


FAMILIES: dict[str, Callable[[Draw], Scene]] = {f.__name__: f for f in (slot, hole, among, around, lattice, stadiums)}


def scene(family: str, seed: int) -> Scene:
    return FAMILIES[family](Draw(f"{family} {seed}"))


# --- the oracle ---


def size_of(where: Scene) -> float:
    """The size of the largest obstacle; or what doubles far away tell apart, if that is more."""
    shapes = [*where.obstacles, *([where.workspace] if where.workspace else [])]
    boxes = [[float(v) for v in (o.box if isinstance(o, Curved) else o.bounds)] for o in shapes]
    largest = max(b[2] - b[0] + b[3] - b[1] for b in boxes)
    return max(largest / 8, max(abs(v) for b in boxes for v in b) * BESIDE)


class Oracle:
    """Exact tests of poses in a scene."""

    def __init__(self, where: Scene) -> None:
        arcs = arcs_of(where)
        assert arcs is not None
        self.scene, self.arcs = where, arcs
        self.size = size_of(where)
        boxes = [[float(v) for v in (part.box if isinstance(part, Curved) else part.bounds)] for part in where.robot]
        self.poles = [complex(b[0] + b[2], b[1] + b[3]) / 2 for b in boxes]  # middles of the robot's parts
        self.middle = sum(self.poles) / len(boxes)
        self.reach = max(abs(complex(b[i], b[j]) - self.middle) for b in boxes for i in (0, 2) for j in (1, 3))

    def turned(self, at: Place, by: float, pole: complex | None = None) -> Place:
        """The pose turned about a point of the robot, or its middle, by a length at its reach."""
        x, y, theta = at
        there = theta + by / self.reach
        moved = (self.middle if pole is None else pole) * (cmath.exp(1j * theta) - cmath.exp(1j * there))
        return x + moved.real, y + moved.imag, there % math.tau

    def free_beside(self, at: Place, by: float, along: tuple[float, float] | None = None, *, turning: bool) -> int:
        """Number of free poses beside one, by two distances in 24 directions, turned or not; not along a segment."""
        rows = [self.turned(at, t * by) for t in (-1, 1) if turning]
        for d in (by, by / 64):
            for x, y, theta in (self.turned(at, t * d) for t in (-1, 0, 1)):
                rows += [
                    (x + d * u, y + d * v, theta)
                    for u, v in WAYS
                    if along is None or abs(u * along[1] - v * along[0]) > 0.02
                ]
        return int(self.arcs.are_free(np.array(rows), 1).sum())

    def faults(self, found: Boundary) -> list[str]:
        """Parts that are forbidden, or with room beside them."""
        wrong = []
        for k in range(len(found.isolated)):
            part = found.isolated_part(k)
            (x0, y0, t0), (x1, y1, t1) = part.ends
            inside: list[tuple[Place, tuple[float, float] | None]] = []
            if part.kind == "point":
                inside = [(part.ends[0], None)]
            if part.kind == "segment":
                length = math.hypot(x1 - x0, y1 - y0)
                along = (x1 - x0) / length, (y1 - y0) / length
                inside = [((x0 + s * (x1 - x0), y0 + s * (y1 - y0), t0), along) for s in (0.5, 0.3, 0.77)]
            if part.kind == "arc":
                for p, q in itertools.pairwise(isolated_lines(found)[k][::3]):
                    length = math.hypot(q[0] - p[0], q[1] - p[1])
                    inside.append(((p[0], p[1], t0), ((q[0] - p[0]) / length, (q[1] - p[1]) / length)))
            if part.kind == "curve":
                for s in (0.5, 0.31, 0.77):
                    theta = t0 + s * (t1 - t0)
                    inside.append(((*nearest(found, k, theta), theta), None))
            for at, along in inside:
                if free := self.free_beside(at, BESIDE * self.size, along, turning=part.kind != "curve"):
                    wrong.append(f"{part.kind} {k} at {at}: {free} free poses beside it")
            for at in [*(at for at, _ in inside), *part.ends]:
                pose = simple_pose(at)
                if pose is not None and not self.arcs.is_free(pose):
                    wrong.append(f"{part.kind} {k} at {at}: forbidden")
        return wrong

    def missing(self, found: Boundary, seed: int) -> tuple[list[Pose], int]:
        """Free poses without room beside them that contacts propose and no part holds, and the number of all."""
        fits, wrong, number = Fits(self.scene), [], 0
        for pose in candidates(self.scene, fits, random.Random(seed)):
            if not self.arcs.is_free(pose):
                continue
            at = float(pose.x), float(pose.y), pose.theta
            if self.free_beside(at, BESIDE * self.size, turning=False) or self._has_room(fits, pose, at):
                continue
            number += 1
            if any(distance(line, at[:2]) < 1e-7 * self.size for line in isolated_at(found, pose.theta)):
                continue
            slits = [line for line in found.slice(pose.theta).segments if distance(line, at[:2]) < 1e-6 * self.size]
            if len(slits) < 2:  # on one, both sides are trapezoids
                wrong.append(pose)
        return wrong, number

    def _has_room(self, fits: Fits, pose: Pose, at: Place) -> bool:
        """True if room of second order is found in cusps along tangents."""
        ways = {(0.0, 0.0)}
        for u, v in itertools.islice(fits.tangents(pose, 1e-9 * self.size), 40):
            n = math.hypot(u, v)
            ways |= {(round(float(s * u) / n, 12), round(float(s * v) / n, 12)) for s in (1, -1)}
        for e, turn, pole in itertools.product((2.0**-9, 2.0**-13), (-1, 0, 1), {self.middle, *self.poles}):
            x, y, theta = self.turned(at, turn * e * self.size, pole)
            for (u, v), k in itertools.product(ways, (8, 32)):
                if not (turn or u or v):
                    continue
                there = x + e * self.size * u, y + e * self.size * v, theta
                if self.free_beside(there, self.size * e * e / k, turning=False):
                    return True
        return all(self._has_slivers(at, e) for e in (2.0**-5, 2.0**-7))

    def _has_slivers(self, at: Place, e: float) -> bool:
        """True if places at random beside a pose that is turned a little are free: room as wide as its square."""
        numbers = np.random.default_rng(0)
        for turn, pole in itertools.product((-1, 1), {self.middle, *self.poles}):
            x, y, theta = self.turned(at, turn * e * self.size, pole)
            steps = numbers.uniform(-e * self.size, e * self.size, (SLIVERS, 2))
            table = np.column_stack([x + steps[:, 0], y + steps[:, 1], np.full(SLIVERS, theta)])
            if self.arcs.are_free(table, 1).any():
                return True
        return False


def nearest(found: Boundary, k: int, theta: float) -> tuple[float, float]:
    """Point of isolated curve k at an angle."""
    from cfree.forbidden.isolated import _on_curve

    x, y = _on_curve(found, k, np.array([theta]))[0]
    return float(x), float(y)


def distance(line: np.ndarray, at: tuple[float, float]) -> float:
    """Distance of a point from a segment, a point or an arc, of which there are more points."""
    if len(line) > 2:
        p, q, r = (complex(x, y) for x, y in line[[0, len(line) // 2, -1], :2])
        u, v = q - p, r - p
        center = p + 1j * (u * abs(v) ** 2 - v * abs(u) ** 2) / (2 * (u.conjugate() * v).imag)
        share = cmath.phase((complex(*at) - center) / (p - center)) / cmath.phase((r - center) / (p - center))
        if -1e-9 < share < 1 + 1e-9:
            return abs(abs(complex(*at) - center) - abs(p - center))
    (x0, y0), (x1, y1) = line[0], line[-1]
    dx, dy = x1 - x0, y1 - y0
    square = dx * dx + dy * dy
    s = min(1.0, max(0.0, ((at[0] - x0) * dx + (at[1] - y0) * dy) / square)) if square else 0.0
    return math.hypot(at[0] - x0 - s * dx, at[1] - y0 - s * dy)


def simple_pose(at: Place) -> Pose | None:
    """The pose of small numbers that a rounded one stands for, if there is one."""
    x, y = (F(v).limit_denominator(5000) for v in at[:2])
    is_half = abs(abs(math.remainder(at[2], math.tau)) - math.pi) < 1e-9
    tau = None if is_half else F(math.tan(at[2] / 2)).limit_denominator(2000)
    if tau is not None and abs(float(tau) - math.tan(at[2] / 2)) > 1e-10 * (1 + float(tau) ** 2):
        return None
    return pose_at(x, y, tau) if max(abs(float(x) - at[0]), abs(float(y) - at[1])) < 1e-9 else None


def candidates(where: Scene, fits: Fits, r: random.Random) -> Iterator[Pose]:
    """Poses at which two contacts hold the robot on a line, and where two such lines cross."""
    far = 4e9
    taus: dict[Fraction | None, None] = dict.fromkeys([F(0), F(1), F(-1), None])
    for theta in np.linspace(0, math.tau, 17):
        taus |= dict.fromkeys(
            tau for tau in fits.angles(0, 0, theta, far, 0.25) if tau is None or tau.denominator < 200
        )
    for tau in r.sample([*taus], min(len(taus), 14)):
        lines = [
            ((line.pose.x, line.pose.y), line.along)
            for line in itertools.islice(fits.lines((F(0), F(0)), tau, far), 1200)
        ]
        r.shuffle(lines)
        places = [p for p, _ in lines]
        for (p, a), (q, b) in itertools.islice(itertools.combinations(lines[:30], 2), 400):
            if across := a[0] * b[1] - a[1] * b[0]:
                s = ((q[0] - p[0]) * b[1] - (q[1] - p[1]) * b[0]) / across
                places.append((p[0] + s * a[0], p[1] + s * a[1]))
        for x, y in [*dict.fromkeys(places)][:400]:
            yield pose_at(x, y, tau)


def compared(family: str, seed: int) -> tuple[Boundary, list[str], int]:
    """The boundary of a scene, its faults, and how many fits were found without it."""
    where = scene(family, seed)
    found, oracle = cfree.boundary(where, threads=1), Oracle(where)
    missing, number = oracle.missing(found, seed)
    return found, oracle.faults(found) + [f"missing {pose}" for pose in missing], number


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--families", nargs="*", default=[*FAMILIES])
    options = parser.parse_args()
    scenes = parts = without = bad = 0
    for seed in range(options.seed, options.seed + options.count):
        for family in options.families:
            found, faults, number = compared(family, seed)
            scenes, parts, without, bad = scenes + 1, parts + len(found.isolated), without + number, bad + bool(faults)
            for fault in faults[:3]:
                print(family, seed, fault, flush=True)
    print(f"{scenes} scenes, {parts} parts, {without} poses found without them, {bad} scenes with faults")


if __name__ == "__main__":
    main()
