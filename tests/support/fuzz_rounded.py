"""Random scenes of rounded shapes against distances, against other scenes of the same forbidden space, and slices.

    python tests/support/fuzz_rounded.py --count 2000 --seed 7 --families lattice fit
    python tests/support/fuzz_rounded.py --one lattice 31

Closed surfaces have even Euler numbers, and each side a partner. Cells hold the free poses, decided by distances of
fractions. Short motions that distances prove free stay in one cell, and so do the free regions of a slice. Numbers of
surfaces and cells, Euler numbers and volumes are those of the scene moved, scaled and mirrored, of the robot turned,
with robot and obstacles exchanged, and with a part of the obstacles' radii given to the robot.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
import traceback
from collections import Counter
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
import shapely

import cfree._core as _core
from rounded_families import (
    FAMILIES,
    TURNS,
    Core,
    Draw,
    Point,
    RoundScene,
    Shape,
    all_mapped,
    is_defined,
    mapped,
    mirrored,
    scene,
    swapped,
    with_other_reference,
    with_radius_moved,
)

POSES = 40
ARC = 64  # chords of a quarter turn
SLICES = 96  # of a volume
DOUBT = 1e-7  # of a distance in doubles, in the scene's size


class Built(NamedTuple):
    """Boundary, surfaces and cells of a scene."""

    features: _core.SceneFeatures
    boundary: _core.Boundary
    cells: _core.CellComplex
    space: _core.FreeSpace


def handle(points: Core) -> _core.Polygon:
    made = (
        _core.Polygon.thin([list(p) for p in points])
        if len(points) < 3
        else _core.Polygon.of([[list(p) for p in points]])
    )
    assert made is not None
    return made


def built(plain: RoundScene) -> Built:
    robot, obstacles = ([handle(c) for c, _ in shapes] for shapes in (plain.robot, plain.obstacles))
    rounding = [(radius, ()) for _, radius in (*plain.robot, *plain.obstacles)]
    workspace = None if plain.workspace is None else handle(plain.workspace)
    features = _core.SceneFeatures(robot, obstacles, workspace, plain.bounds, None, rounding)
    regularized = _core.may_have_slits(features.scene)
    boundary = _core.compute_boundary(features.scene, 1, regularized, lambda share: True)
    cells = _core.glue(boundary, 1)
    return Built(features, boundary, cells, _core.free_space(cells))


def euler_numbers(cells: _core.CellComplex) -> list[int]:
    """Euler number of each closed surface."""
    of_half_edge = cells.component[cells.face]
    vertex_of = np.unique(np.stack([of_half_edge, cells.vertex]), axis=1)[0]
    return (
        np.bincount(vertex_of, minlength=cells.components)
        - np.bincount(of_half_edge, minlength=cells.components) // 2
        + np.bincount(cells.component, minlength=cells.components)
    ).tolist()


class Truth:
    """Distances of the robot from obstacles and walls, by shapely in doubles and in fractions."""

    def __init__(self, plain: RoundScene) -> None:
        self.plain, own = plain, plain.robot[0].radius
        self.others: list[tuple[tuple[Core, ...], Fraction]] = [((c,), own + s) for c, s in plain.obstacles]
        points = [p for c, _ in plain.obstacles for p in c] + list(plain.workspace or ())
        self.low, self.high = (tuple(f(p[k] for p in points) for k in (0, 1)) for f in (min, max))
        self.robot_points = [p for c, _ in plain.robot for p in c]
        middle = [sum(p[k] for p in self.robot_points) / len(self.robot_points) for k in (0, 1)]
        self.middle = tuple(Fraction(v) for v in middle)
        spread = max(math.hypot(float(x - middle[0]), float(y - middle[1])) for x, y in self.robot_points)
        self.spread = spread + float(own)
        # no point moves farther in a turn of a radian about the middle, the reference point included if it has bounds
        self.arm = max(self.spread, 0.0 if plain.bounds is None else math.hypot(*map(float, middle)))
        self.size = (
            max(float(self.high[k] - self.low[k]) for k in (0, 1)) + 2 * spread + float(max(s for _, s in self.others))
        )
        self.base = tuple(Fraction(round(v)) for v in self.low)
        self.shapes = [(self._near(c), float(s)) for (c,), s in self.others]
        self.walls: Any = None
        if plain.workspace is not None:
            inside = self._near(plain.workspace)
            self.walls = inside.buffer(4 * self.size).difference(inside)

    def _near(self, points: Core) -> Any:
        at = [(float(x - self.base[0]), float(y - self.base[1])) for x, y in points]
        return shapely.Point(at[0]) if len(at) == 1 else shapely.LineString(at) if len(at) == 2 else shapely.Polygon(at)

    def placed(self, x: Fraction, y: Fraction, turn: Point) -> list[Core]:
        return [mapped(c, x, y, turn) for c, _ in self.plain.robot]

    def room(self, x: Fraction, y: Fraction, turn: Point) -> float:
        """Least distance less the radii, in doubles; below 0 if forbidden, and at most the distance by which."""
        least = math.inf
        own = float(self.plain.robot[0].radius)
        for part in self.placed(x, y, turn):
            near = self._near(part)
            for shape, rho in [*self.shapes, *([(self.walls, own)] if self.walls is not None else [])]:
                d = near.distance(shape)
                if d == 0:
                    met = near.intersection(shape)
                    d = -math.sqrt(met.area) if rho == 0 else 0.0
                    if rho == 0 and near.area == 0:  # a segment within a polygon
                        d = -met.difference(shape.boundary.buffer(1e-9 * self.size)).length
                least = min(least, d - rho)
        if self.plain.bounds is not None:
            x0, y0, x1, y1 = self.plain.bounds
            least = min(least, *(float(v) for v in (x - x0, x1 - x, y - y0, y1 - y)))
        return least

    def sign(self, x: Fraction, y: Fraction, turn: Point) -> int | None:
        """1 if free without contact, 0 in contact, -1 if forbidden; None if not decided."""
        about = self.room(x, y, turn)
        if abs(about) > DOUBT * self.size:
            return 1 if about > 0 else -1
        if self.plain.workspace is not None or self.plain.bounds is not None:
            return None
        signs = []
        for part in self.placed(x, y, turn):
            for (other,), rho in self.others:
                if rho == 0 and self._near(part).distance(self._near(other)) < DOUBT * self.size:
                    return None
                square = square_distance(part, other)
                signs.append((square > rho * rho) - (square < rho * rho))
        return min(signs)


def square_distance(one: Core, other: Core) -> Fraction:
    """Square of the distance of two cores; 0 if they overlap."""
    if within(one[0], other) or within(other[0], one):
        return Fraction(0)
    return min(between_sides(a, b) for a in sides(one) for b in sides(other))


def sides(points: Core) -> list[tuple[Point, Point]]:
    return list(pairwise([*points, points[0]])) if len(points) != 2 else [(points[0], points[1])]


def turn_of(p: Point, q: Point, r: Point) -> Fraction:
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


def within(p: Point, ring: Core) -> bool:
    """True if a point is strictly inside a ring; arbitrary on its rim."""
    if len(ring) < 3:
        return False
    inside = False
    for a, b in sides(ring):
        if (a[1] > p[1]) != (b[1] > p[1]) and (turn_of(a, b, p) > 0) == (b[1] > a[1]):
            inside = not inside
    return inside


def between_sides(one: tuple[Point, Point], other: tuple[Point, Point]) -> Fraction:
    (a, b), (c, d) = one, other
    if turn_of(a, b, c) * turn_of(a, b, d) < 0 and turn_of(c, d, a) * turn_of(c, d, b) < 0:
        return Fraction(0)
    return min(from_side(p, side) for p, side in ((a, other), (b, other), (c, one), (d, one)))


def from_side(p: Point, side: tuple[Point, Point]) -> Fraction:
    (ax, ay), (bx, by) = side
    ux, uy, vx, vy = bx - ax, by - ay, p[0] - ax, p[1] - ay
    square = ux * ux + uy * uy
    t = max(Fraction(0), min(Fraction(1), (ux * vx + uy * vy) / square)) if square else Fraction(0)
    return Fraction((vx - t * ux) ** 2 + (vy - t * uy) ** 2)


def rotation(tau: Fraction, chart: int) -> Point:
    c, s = (1 - tau**2) / (1 + tau**2), 2 * tau / (1 + tau**2)
    return (-c, -s) if chart else (c, s)


class Pose(NamedTuple):
    x: Fraction
    y: Fraction
    tau: Fraction
    chart: int

    @property
    def turn(self) -> Point:
        return rotation(self.tau, self.chart)


def cell_at(space: Built, pose: Pose) -> int:
    scale = space.features.scene.scale
    unit = math.lcm(pose.x.denominator, pose.y.denominator)
    numbers = int(pose.x * unit) * scale, int(pose.y * unit) * scale, unit, pose.tau.numerator, pose.tau.denominator
    return space.space.locate_exactly(numbers, pose.chart)


def poses(truth: Truth, r: Draw) -> Iterator[Pose]:
    """Poses around the scene, some of them on lattices and in contact."""
    grow = Fraction(truth.spread).limit_denominator(16) + 1
    for k in range(POSES):
        if k % 3 != 0:
            tau = r.on(-1, 1, 64)
        elif r.random() < 0.6:
            tau = Fraction(r.choice([0, 1, -1]))
        else:
            tau = Fraction(r.choice([1, -1]), r.choice([2, 3]))
        chart = r.randint(0, 1)
        turn = rotation(tau, chart)
        parts = r.choice([2, 4, 61])
        at = [
            r.on(math.floor(lo - grow), math.ceil(hi + grow), parts)
            for lo, hi in zip(truth.low, truth.high, strict=True)
        ]
        if k % 4 == 0:  # a corner of the robot above a corner of an obstacle, one sum of radii away
            p = r.choice(truth.robot_points)
            core, s = r.choice(truth.plain.obstacles)
            q, (c, d) = r.choice(core), r.choice(TURNS)
            rho = s + truth.plain.robot[0].radius
            a = mapped((p,), turn=turn)[0]
            at = [q[0] + c * rho - a[0], q[1] + d * rho - a[1]]
        else:
            centre = mapped((truth.middle,), turn=turn)[0]  # type: ignore[arg-type]
            at = [at[0] - Fraction(round(centre[0] * 4), 4), at[1] - Fraction(round(centre[1] * 4), 4)]
        yield Pose(at[0], at[1], tau, chart)


def location_faults(space: Built, truth: Truth, r: Draw) -> Iterator[str]:
    """Poses in a wrong kind of place, and free motions from one cell to another."""
    free = []
    for pose in poses(truth, r):
        cell, sign = cell_at(space, pose), truth.sign(pose.x, pose.y, pose.turn)
        if (sign == 1 and cell < 0) or (sign == -1 and cell >= 0):
            yield f"cell {cell} at {pose}: sign {sign}, room {truth.room(pose.x, pose.y, pose.turn)}"
        if sign == 0 and cell < 0 and (other := free_beside(pose, truth, r)):
            yield f"no cell at {pose} in contact, and {other} is free"
        if sign == 1:
            free.append((pose, cell))
    for start, cell in free[:6]:
        pose = start
        for _ in range(20):
            pose = moved_freely(pose, truth, r)
        if (other := cell_at(space, pose)) != cell:
            yield f"cells {cell} and {other} at {start} and {pose}, joined by free motions"


def free_beside(pose: Pose, truth: Truth, r: Draw) -> Pose | None:
    """A free pose very near, if some are tried; the robot turns about its middle."""
    for _ in range(30):
        x, y, tau = (v + r.on(-100, 100, 1) * Fraction(1, 2**26) for v in (pose.x, pose.y, pose.tau))
        other = turned_to(Pose(x, y, pose.tau, pose.chart), max(Fraction(-1), min(Fraction(1), tau)), truth)
        if truth.sign(*other[:2], other.turn) == 1:
            return other
    return None


def cut(x: float) -> Fraction:
    """A number in few digits, towards 0."""
    return Fraction(math.trunc(x * 2**20), 2**20)


def moved_freely(pose: Pose, truth: Truth, r: Draw) -> Pose:
    """Translate or turn about the robot's middle by less than its distance allows."""
    room = truth.room(pose.x, pose.y, pose.turn)
    if room < 1e-3:
        return pose
    if r.random() < 0.6:
        step = [cut(room * 0.7 * f) for f in (r.uniform(-1, 1), r.uniform(-1, 1))]
        return pose._replace(x=pose.x + step[0], y=pose.y + step[1])
    by = min(0.3, 0.9 * room / (truth.arm + 1e-9)) * r.uniform(-1, 1)
    tau = pose.tau + cut(by / 2 * (1 + float(pose.tau) ** 2) * 0.9)
    tau = max(Fraction(-1), min(Fraction(1), tau))
    if tau == pose.tau:
        return pose
    return turned_to(pose, tau, truth)


def turned_to(pose: Pose, tau: Fraction, truth: Truth) -> Pose:
    """Turn a pose about the robot's middle."""
    before, after = (mapped((truth.middle,), turn=rotation(t, pose.chart))[0] for t in (pose.tau, tau))  # type: ignore[arg-type]
    return Pose(pose.x + before[0] - after[0], pose.y + before[1] - after[1], tau, pose.chart)


def forbidden_slice(truth: Truth, turn: Point, outwards: float) -> tuple[Any, Point]:
    """Forbidden positions near the scene at an orientation, a little larger or smaller, and their origin."""
    centre = mapped((truth.middle,), turn=turn)[0]  # type: ignore[arg-type]
    origin = truth.base[0] - centre[0], truth.base[1] - centre[1]
    regions = []
    for part, _ in truth.plain.robot:
        turned = [(float(x - centre[0]), float(y - centre[1])) for x, y in mapped(part, turn=turn)]
        for (shape, rho), (core, _) in zip(truth.shapes, truth.plain.obstacles, strict=True):
            regions.append(
                shapely.buffer(minkowski(shape, turned, core, part), max(0.0, rho + outwards), quad_segs=ARC)
            )
    return shapely.union_all(regions), origin


def minkowski(shape: Any, turned: list[tuple[float, float]], core: Core, part: Core) -> Any:
    """Sum of an obstacle and the robot's negative: of triangles and segments."""
    ours, theirs = (
        triangles(turned),
        triangles(list(shape.exterior.coords)[:-1] if shape.geom_type == "Polygon" else list(shape.coords)),
    )
    sums = [
        shapely.MultiPoint([(q[0] - p[0], q[1] - p[1]) for p in a for q in b]).convex_hull for a in ours for b in theirs
    ]
    return shapely.union_all(sums)


def triangles(points: list[tuple[float, float]]) -> list[list[tuple[float, float]]]:
    """The points themselves, of a convex shape, or triangles of it."""
    if len(points) < 3 or is_convex(points):
        return [points]
    pieces = shapely.constrained_delaunay_triangles(shapely.Polygon(points))
    return [list(t.exterior.coords)[:-1] for t in pieces.geoms]


def is_convex(points: list[tuple[float, float]]) -> bool:
    """True if a polygon is certainly convex."""
    turns = [
        (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
        for a, b, c in zip(points, points[1:] + points[:1], points[2:] + points[:2], strict=True)
    ]
    return all(turn > 0 for turn in turns) or all(turn < 0 for turn in turns)


def slice_faults(space: Built, truth: Truth, r: Draw) -> Iterator[str]:
    """Places of one free region of a slice in several cells, or in none; and another area of the forbidden ones."""
    if truth.plain.workspace is not None or truth.plain.bounds is not None:
        return
    tau, chart = r.on(-1, 1, 61), r.randint(0, 1)
    for found, region in slice_cells(space, truth, tau, chart, r):
        if len(found) > 1 or -1 in found:
            yield f"cells {sorted(found)} of one region of the slice at tau {tau}, chart {chart}: {region}"
    expected, _ = forbidden_slice(truth, rotation(tau, chart), 0.0)
    area = sum(signed_area(ring) for ring in slice_rings(space, chart, float(tau)))
    radius = max(float(rho) for _, rho in truth.others)
    if abs(area - expected.area) > 1e-3 * radius * expected.length + 1e-6 * truth.size**2:
        yield f"area {area} of the slice at tau {tau}, chart {chart}; it is {expected.area}"


def slice_rings(space: Built, chart: int, tau: float) -> list[Any]:
    """Rings of chords around the forbidden positions at an orientation, each from one of its points."""
    xy, start, *_ = _core.Slicer(space.boundary).rings(np.array([chart], np.int32), np.array([tau]))
    points = xy.reshape(-1, 2)
    return [points[i:j] - points[i] for i, j in pairwise(start.tolist())]


def signed_area(points: Any) -> float:
    x, y = points.T
    return float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2


def slice_cells(space: Built, truth: Truth, tau: Fraction, chart: int, r: Draw) -> Iterator[tuple[set[int], Any]]:
    """The cells of some places in each free region of a slice, within a box around the forbidden ones."""
    margin = 2e-3 * truth.size
    grown, origin = forbidden_slice(truth, rotation(tau, chart), margin)
    free = shapely.box(*grown.bounds).buffer(1).difference(grown)
    for region in getattr(free, "geoms", [free]):
        if region.area < margin**2:
            continue
        places = [region.representative_point()]
        x0, y0, x1, y1 = region.bounds
        trial = [shapely.Point(r.uniform(x0, x1), r.uniform(y0, y1)) for _ in range(8)]
        places += [p for p in trial if region.covers(p)]
        at = [Pose(origin[0] + Fraction(p.x), origin[1] + Fraction(p.y), tau, chart) for p in places]
        yield {cell_at(space, pose) for pose in at}, region


def volume_faults(space: Built, truth: Truth, r: Draw) -> Iterator[str]:
    """Volumes of bounded cells against areas of slices."""
    volumes, _ = space.space.volumes()
    bounded = np.flatnonzero(np.isfinite(volumes))
    if truth.plain.workspace is not None or truth.plain.bounds is not None or not len(bounded):
        return
    summed, edges = np.zeros(len(volumes)), np.zeros(len(volumes))
    step = math.tau / SLICES
    for k in range(SLICES):
        chart, half = divmod(((k + 0.5) * step + math.pi / 2) % math.tau, math.pi)
        tau = Fraction(math.tan((half - math.pi / 2) / 2)).limit_denominator(10**6)
        for found, region in slice_cells(space, truth, tau, int(chart), r):
            for cell in found:
                summed[cell] += step * region.area
                edges[cell] += step * region.length
    # regions are smaller by a margin, and so are sums; less than all of a slice is missing at both ends
    for cell in bounded.tolist():
        missing = volumes[cell] - summed[cell]
        most = 6e-3 * truth.size * edges[cell] + 0.05 * volumes[cell] + 0.05 * truth.size**2 * step
        if not -0.1 * most < missing < most:
            yield f"volume {volumes[cell]} of cell {cell}, {summed[cell]} in slices"


class Counts(NamedTuple):
    """Numbers that do not depend on the frame."""

    surfaces: list[tuple[int, int]]
    cells: int
    volumes: list[float]
    errors: float


def counts(space: Built) -> Counts:
    inside = space.space.surfaces.free_inside.tolist()
    volumes, errors = space.space.volumes()
    bounded = volumes[np.isfinite(volumes)]
    return Counts(
        sorted(zip(euler_numbers(space.cells), inside, strict=True)), len(volumes), sorted(bounded.tolist()),
        float(errors[np.isfinite(volumes)].sum()),
    )  # fmt: skip


def difference(one: Counts, other: Counts, unit: float, has_slits: bool) -> str | None:
    """A difference of two counts, volumes of the second times a unit; of full cells only where slits may be cut."""
    least = 1e-7 * (1 + max(one.volumes, default=0.0))
    volumes = [
        [v for v in (w * f for w in c.volumes) if not has_slits or v > least] for c, f in ((one, 1.0), (other, unit))
    ]
    if not has_slits and (one.surfaces, one.cells) != (other.surfaces, other.cells):
        return f"surfaces {one.surfaces} and {other.surfaces}, cells {one.cells} and {other.cells}"
    if len(volumes[0]) != len(volumes[1]):
        return f"volumes {volumes[0]} and {volumes[1]}"
    error = one.errors + unit * other.errors + 1e-8 * (1 + max(volumes[0], default=0.0))
    if any(abs(v - w) > error for v, w in zip(*volumes, strict=True)):
        return f"volumes {volumes[0]} and {volumes[1]}, errors {error}"
    return None


def thin_faults(plain: RoundScene) -> Iterator[str]:
    """Other surfaces of polygons than of the same ones with tiny radii; in general position they are as many."""
    if any(len(c) < 3 for c, _ in (*plain.robot, *plain.obstacles)):
        return
    tiny = Fraction(1, 2**40)
    versions = [
        plain._replace(
            robot=tuple(Shape(c, s) for c, _ in plain.robot), obstacles=tuple(Shape(c, s) for c, _ in plain.obstacles)
        )
        for s in (Fraction(0), tiny)
    ]
    if text := difference(*(counts(built(one))._replace(errors=1e-6) for one in versions), 1.0, False):
        yield f"polygons, and radii of 2^-40: {text}"


def laws(plain: RoundScene, r: Draw) -> Iterator[tuple[str, RoundScene, float, bool]]:
    """Scenes of the same forbidden space in other forms; factor of volumes; True if charts are cut elsewhere."""
    yield "mirrored", mirrored(plain), 1.0, False
    yield "moved", all_mapped(plain, Fraction(7, 3), -5), 1.0, False
    yield "scaled", all_mapped(plain, factor=Fraction(7, 3)), float(Fraction(3, 7) ** 2), False
    if plain.bounds is None:
        yield "turned half", all_mapped(plain, turn=(-1, 0)), 1.0, False
        yield "turned", all_mapped(plain, turn=r.choice(TURNS[1:4])), 1.0, True
        yield "another reference", with_other_reference(plain, Fraction(3, 2), Fraction(-1, 3)), 1.0, False
    turn = r.choice(TURNS[1:4])
    yield "robot turned", plain._replace(robot=tuple(Shape(mapped(c, turn=turn), s) for c, s in plain.robot)), 1.0, True
    if (other := swapped(plain)) is not None:
        yield "swapped", other, 1.0, False
    least = min([s for _, s in plain.obstacles], default=Fraction(0))
    for by in (least, least / 2, -plain.robot[0].radius / 3):
        if by and (other := with_radius_moved(plain, by)) is not None:
            yield f"radius {by} given to the robot", other, 1.0, False


def faults(plain: RoundScene, name: str, all_laws: bool = False) -> Iterator[str]:
    """Faults of a scene."""
    r, space = Draw(name), built(plain)
    yield from surface_faults(space)
    truth = Truth(plain)
    yield from location_faults(space, truth, r)
    yield from slice_faults(space, truth, r)
    if all_laws or r.random() < 0.1:
        yield from volume_faults(space, truth, r)
    if name.startswith("generic"):
        yield from thin_faults(plain)
    ours = counts(space)
    variants = list(laws(plain, r))
    for law, other, unit, cuts in variants if all_laws else [r.choice(variants)]:
        try:
            theirs = built(other)
            yield from (f"{law}: {fault}" for fault in surface_faults(theirs))
            volume = ours.volumes[:1] + counts(theirs).volumes[:1]
            is_cut = cuts and any(v < 1e-7 for v in volume)
            if text := difference(ours, counts(theirs), unit, is_cut):
                yield f"{law}: {text}"
        except Exception as error:
            yield f"{law}: {type(error).__name__}: {error}"


def surface_faults(space: Built) -> Iterator[str]:
    """Angles that are not known to a double's digits, sides without partner, and odd Euler numbers."""
    cells, rows = space.cells, space.boundary.trapezoids
    if max(np.max(rows.from_hi - rows.from_lo, initial=0.0), np.max(rows.to_hi - rows.to_lo, initial=0.0)) > 1e-10:
        yield "an angle in a wide interval"
    if np.any(cells.twin < 0) or np.any(cells.twin[cells.twin] != np.arange(len(cells.twin))):
        yield "sides without partners"
    euler = euler_numbers(cells)
    if any(number % 2 for number in euler):
        yield f"Euler numbers {euler}"


def all_faults(plain: RoundScene, name: str, all_laws: bool = False) -> list[str]:
    """Faults, exceptions among them."""
    try:
        return list(faults(plain, name, all_laws))
    except Exception as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        return [f"{type(error).__name__}: {error} ({place.name})"]


def smaller(plain: RoundScene) -> Iterator[RoundScene]:
    """Simpler scenes: without a shape, a wall or a corner, and with fewer digits."""
    if plain.workspace or plain.bounds:
        yield plain._replace(workspace=None, bounds=None)
    for name in ("obstacles", "robot"):
        shapes = getattr(plain, name)
        for k, (core, radius) in enumerate(shapes):
            if len(shapes) > 1:
                yield plain._replace(**{name: shapes[:k] + shapes[k + 1 :]})
            for m in range(len(core)):
                if len(core) > 1 and len(core) != 3:
                    yield plain._replace(
                        **{name: (*shapes[:k], Shape(core[:m] + core[m + 1 :], radius), *shapes[k + 1 :])}
                    )
            if len(core) == 3:
                yield plain._replace(**{name: (*shapes[:k], Shape(core[:2], radius), *shapes[k + 1 :])})
            for digits in (1, 2, 4, 10, 100):
                other = tuple(
                    (Fraction(round(x * digits), digits), Fraction(round(y * digits), digits)) for x, y in core
                )
                if other != core and sum(len(str(v)) for p in other for v in p) < sum(
                    len(str(v)) for p in core for v in p
                ):
                    yield plain._replace(**{name: (*shapes[:k], Shape(other, radius), *shapes[k + 1 :])})
    first = plain.obstacles[0].core[0]
    if first != (0, 0) and plain.bounds is None:
        yield all_mapped(plain, -first[0], -first[1])
    first = plain.robot[0].core[0]
    if first != (0, 0):
        yield with_other_reference(plain, -first[0], -first[1])


def made_small(plain: RoundScene, name: str) -> RoundScene:
    """A scene with a fault of the same kind that no simpler one has."""

    def kinds(texts: list[str]) -> set[str]:
        return {"".join(c for c in text.split("at Pose")[0] if c.isalpha())[:30] for text in texts}

    wanted, seen = kinds(all_faults(plain, name, True)), {plain}
    while True:
        for other in smaller(plain):
            if other not in seen and is_defined(other):
                seen.add(other)
                if wanted & kinds(all_faults(other, name, True)):
                    plain = other
                    break
        else:
            return plain


def shown(plain: RoundScene) -> str:
    """A scene in a few lines."""

    def line(shape: Any) -> str:
        points = " ".join(f"({x},{y})" for x, y in shape.core)
        return f"  radius {shape.radius}: {points}"

    rest = [f"  workspace: {plain.workspace}"] if plain.workspace else []
    rest += [f"  bounds: {plain.bounds}"] if plain.bounds else []
    return "\n".join([*map(line, plain.robot), "  among", *map(line, plain.obstacles), *rest])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=2000, help="scenes")
    parser.add_argument("--seed", type=int, default=0, help="number of the first scene of each family")
    parser.add_argument("--families", nargs="*", choices=FAMILIES, default=list(FAMILIES))
    parser.add_argument("--one", nargs=2, metavar=("FAMILY", "SEED"), help="one scene, by all laws")
    options = parser.parse_args()
    if options.one:
        family, seed = options.one[0], int(options.one[1])
        plain = scene(family, seed)
        print(shown(plain))
        found = all_faults(plain, f"{family} {seed}", True)
        print("\n".join(found) or "no fault")
        if found:
            plain = made_small(plain, f"{family} {seed}")
            print("smaller:", shown(plain), *all_faults(plain, f"{family} {seed}", True), sep="\n")
        return
    done, wrong = Counter[str](), Counter[str]()
    for k in range(options.count):
        family = options.families[k % len(options.families)]
        seed = options.seed + k // len(options.families)
        start, found = time.process_time(), all_faults(scene(family, seed), f"{family} {seed}")
        done[family] += 1
        seconds = time.process_time() - start
        if found or seconds > 20:
            wrong[family] += bool(found)
            print(f"{family} {seed} ({seconds:.1f} s):", *found, sep="\n  ", flush=True)
    for family in options.families:
        print(f"{family}: {done[family]} scenes, {wrong[family]} with faults")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
