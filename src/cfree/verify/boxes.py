"""Check that a car without reverse gear does not reach its goal: the listed boxes are closed under a step of travel.

All of it is recomputed in rationals. Sines and cosines are rounded to `TRIG` bits, and every length is then changed by
more than that is off: boxes are held to be forbidden less often than they are, and to follow more often.
docs/theory/vehicles.md, "Forward only", has the proof. A set of boxes of one slice is an integer with a bit for each.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, cached_property
from typing import TYPE_CHECKING

from cfree.exact.pose import Pose
from cfree.verify.result import Finding

if TYPE_CHECKING:
    from cfree.planning.unreachable import Unreachable
    from cfree.verify.world import World

REACH = "closed boxes"
TRIG, WORK_BITS = 64, 128
PI = 0x3243F6A8885A308D313198A2E03707344  # in units of 2^-128
UNITS = 2**44  # of length, in the size of the scene, at least
SLACK = Fraction(1, 2**40)  # of the size of the scene; and of radians
MOST_BOXES = 2**28
ZERO, ONE, HALF = Fraction(0), Fraction(1), Fraction(1, 2)

Point = tuple[Fraction, Fraction]
Ring = Sequence[Point]
Ints = Sequence[tuple[int, int]]


@cache
def cosine_sine(part: int, whole: int) -> Point:
    """Return cosine and sine of part / whole of half a turn, off by less than 2^-63.

    Examples
    --------
    >>> cosine_sine(0, 4), [float(x) for x in cosine_sine(1, 2)]
    ((Fraction(1, 1), Fraction(0, 1)), [0.0, 1.0])
    """
    angle = PI * (part % (2 * whole)) // whole
    sums, term, k = [0, 0], 1 << WORK_BITS, 0
    while term:
        sums[k % 2] += -term if k % 4 > 1 else term
        k += 1
        term = term * angle // (k << WORK_BITS)
    drop = WORK_BITS - TRIG
    c, s = (Fraction((x + (1 << drop - 1)) >> drop, 1 << TRIG) for x in sums)
    return c, s


@dataclass(frozen=True)
class Ends:
    """Where a step of travel ends, in a frame ahead: between `least` and `most` along, and `aside` across."""

    least: Fraction
    most: Fraction
    aside: Fraction


@dataclass(frozen=True)
class Drive:
    """What counts of the question: all in the frame of the axle, driven on from one end to the other."""

    robot: Sequence[Ring]
    reference: Point
    radii: tuple[Fraction, Fraction]
    begin: Pose
    end: Pose

    @classmethod
    def of(cls, proof: Unreachable, world: World) -> Drive:
        """Return that of a proof; back from the goal everything is turned by half a turn."""
        car, back = proof.vehicle, proof.vehicle.frame.inverse()
        robot = [back.apply_exact(piece) for piece in proof.pieces]
        (reference,) = back.apply_exact([(ZERO, ZERO)])
        ends = proof.start @ car.frame, proof.goal @ car.frame
        if proof.at == "start":
            return cls(robot, reference, car.radii, *ends)
        start, goal = (q @ Pose(0, 0, {"tau": None}) for q in ends)
        turned = [[(-x, -y) for x, y in ring] for ring in robot]
        return cls(turned, (-reference[0], -reference[1]), (car.radii[1], car.radii[0]), goal, start)

    def ends(self, step: Fraction, low: Fraction, high: Fraction, off: Fraction) -> Ends:
        """Return where a step ends that turns by an angle between two, in frames off by up to an angle."""
        left, right = 1 / self.radii[0], 1 / self.radii[1]
        bend = step * max(left, right) / 2
        best = min(max(step * (left - right) / 2, low), high)
        aside = max(ZERO, (best + right * step) * (left * step - best) / (left + right) / 2) + step * bend**3 / 6
        return Ends(step * (1 - (bend**2 + off**2) / 2) - aside * off, step + aside * off, aside + step * off)


def box_findings(proof: Unreachable, world: World, report: Callable[[float], object]) -> Iterator[Finding]:
    """Findings about a proof by boxes."""
    grid = proof.grid
    sizes = grid.side, grid.step, Fraction(grid.columns), Fraction(grid.rows)
    if min(sizes) <= 0 or grid.slices < 8 or grid.count > MOST_BOXES:
        yield Finding(REACH, "grid", f"it needs positive sizes, 8 slices, and at most {MOST_BOXES:,} boxes")
        return
    if grid.step > 3 * min(proof.vehicle.radii):  # less than half a turn: no step leads back
        yield Finding(REACH, "grid", "its step is longer than three times the turning radius")
        return
    if proof.vehicle.gears != "forward":
        yield Finding(REACH, "vehicle", "it has a reverse gear")
        return
    parts = [[(Fraction(x, world.scale), Fraction(y, world.scale)) for x, y in part] for part in world.parts]
    for k, piece in enumerate(proof.pieces):
        if not _is_convex(piece) or sum(_area(_within(piece, part)) for part in parts) != _area(piece):
            yield Finding(REACH, f"piece {k}", "it is not convex, or not inside the robot")
            return
    try:
        boxes = _Boxes(proof, world)
    except ValueError as error:
        yield Finding(REACH, "boxes", str(error))
        return
    yield from boxes.findings(report)


class _Boxes:
    """The boxes of a proof, in rows of `stride` bits, of which the last ones are empty."""

    def __init__(self, proof: Unreachable, world: World) -> None:
        self.grid, self.drive, self.world = proof.grid, Drive.of(proof, world), world
        grid = self.grid
        points = [p for ring in self.drive.robot for p in ring]
        points += [(Fraction(x, world.scale), Fraction(y, world.scale))
                   for ring in world.obstacle_pieces for x, y in ring]  # fmt: skip
        span = grid.side * max(grid.columns, grid.rows) + grid.step
        size = span + sum(map(abs, grid.corner)) + max(abs(x) + abs(y) for x, y in points)
        self.slack = size * SLACK
        self.far = max(abs(x) + abs(y) for ring in self.drive.robot for x, y in ring)
        self.half = Fraction(PI, grid.slices << WORK_BITS)  # of a slice, in radians
        common = math.lcm(2 * grid.side.denominator, *(x.denominator for x in grid.corner))
        while common * size < UNITS:
            common *= 2
        self.common = common
        self.tables = [[self.following(k, q) for q in self.turns] for k in range(grid.slices)]
        self.rim = max(max(abs(i), abs(j)) for table in self.tables for offsets in table for i, j in offsets)
        self.stride = 8 * -(-(grid.columns + self.rim) // 8)
        self.row = (1 << grid.columns) - 1
        self.inside = self.packed([self.row] * grid.rows)
        self.listed = self.read(proof.boxes)

    def read(self, data: bytes) -> list[int]:
        """Return the listed boxes of each slice."""
        grid = self.grid
        length = (grid.count + 7) // 8
        try:
            stream = zlib.decompressobj()
            bits = stream.decompress(data, length + 1)
        except zlib.error:
            raise ValueError("they are not compressed by zlib") from None
        if len(bits) != length or not stream.eof:
            raise ValueError(f"they are not the {grid.count:,} bits of the grid")
        listed = []
        for k in range(grid.slices):
            rows = []
            for j in range(grid.rows):
                first = (k * grid.rows + j) * grid.columns
                part = int.from_bytes(bits[first // 8 : (first + grid.columns) // 8 + 1], "little")
                rows.append(part >> first % 8 & self.row)
            listed.append(self.packed(rows))
        return listed

    def packed(self, rows: Sequence[int]) -> int:
        """Return rows as one integer."""
        return int.from_bytes(b"".join(row.to_bytes(self.stride // 8, "little") for row in rows), "little")

    @cached_property
    def turns(self) -> range:
        """Slices from a box to those that follow."""
        most = math.floor(self.grid.step / min(self.drive.radii) / (2 * self.half)) + 2
        return range(-most, most + 1)

    def allowed(self, low: Fraction, high: Fraction) -> tuple[Fraction, Fraction] | None:
        """Return the turns of a step between two angles that the radii allow; None if there are none."""
        left, right = self.drive.radii
        low, high = max(low - SLACK, -self.grid.step / right), min(high + SLACK, self.grid.step / left)
        return None if low > high else (low, high)

    def following(self, k: int, q: int) -> list[tuple[int, int]]:
        """Return the boxes of a slice, `q` further, that follow one of slice `k`: columns and rows from it."""
        grid, slices = self.grid, self.grid.slices
        turn = self.allowed((q - 1) * 2 * self.half, (q + 1) * 2 * self.half)
        if turn is None:
            return []
        ends = self.drive.ends(grid.step, *turn, self.half + SLACK)
        return [*self.meeting(cosine_sine(2 * k + 1 + q, slices), ends, (ZERO, ZERO), grid.side)]

    def meeting(self, ahead: Point, ends: Ends, place: Point, reach: Fraction) -> Iterator[tuple[int, int]]:
        """Yield columns and rows at which a square, of half side `reach`, meets the ends from a place."""
        (c, s), side, more, (x0, y0) = ahead, self.grid.side, self.slack, place
        xs = [c * u - s * v for u in (ends.least, ends.most) for v in (ends.aside, -ends.aside)]
        ys = [s * u + c * v for u in (ends.least, ends.most) for v in (ends.aside, -ends.aside)]
        wide = reach * (abs(c) + abs(s)) + more
        columns, rows = (
            range(math.ceil((at + min(zs) - reach - more) / side), math.floor((at + max(zs) + reach + more) / side) + 1)
            for at, zs in ((x0, xs), (y0, ys))
        )
        for j in rows:
            for i in columns:
                x, y = i * side - x0, j * side - y0
                if ends.least - wide <= c * x + s * y <= ends.most + wide and abs(c * y - s * x) <= ends.aside + wide:
                    yield i, j

    def findings(self, report: Callable[[float], object]) -> Iterator[Finding]:
        """Yield what is wrong: a box that follows is neither listed nor forbidden, or the goal's is listed."""
        grid = self.grid
        is_beyond = False
        for k, i, j in self.at(self.drive.end):
            is_within = 0 <= i < grid.columns and 0 <= j < grid.rows
            is_beyond |= not is_within
            if is_within and self.listed[k] >> (j * self.stride + i) & 1:
                yield Finding(REACH, _name(k, i, j), "it holds the end that is not to be reached")
                return
        follow = [0] * grid.slices
        for k, i, j in self.begin():
            if not (0 <= i < grid.columns and 0 <= j < grid.rows):
                yield Finding(REACH, "grid", "a step from the first pose leaves it")
                return
            follow[k] |= 1 << (j * self.stride + i)
        for k, table in enumerate(self.tables):
            report(0.5 * k / grid.slices)
            if not self.listed[k]:
                continue
            for q, offsets in zip(self.turns, table, strict=True):
                there = (k + q) % grid.slices
                for i, j in offsets:
                    by = j * self.stride + i
                    follow[there] |= self.listed[k] << by if by > 0 else self.listed[k] >> -by
        inner = (1 << max(0, grid.columns - 2 * self.rim)) - 1 << self.rim
        outer = [self.row ^ inner if self.rim <= j < grid.rows - self.rim else self.row for j in range(grid.rows)]
        rim = self.packed(outer)
        leaves = any(boxes & rim for boxes in self.listed)
        if leaves and is_beyond:
            yield Finding(REACH, "grid", "a step may leave it, and the end that is not to be reached is beyond")
            return
        for k in range(grid.slices):
            report(0.5 + 0.5 * k / grid.slices)
            if leaves:
                follow[k] |= rim
            missing = follow[k] & self.inside & ~self.listed[k]
            if missing:
                missing &= ~self.forbidden(k, missing)
            if missing:
                j, i = divmod(missing.bit_length() - 1, self.stride)
                yield Finding(REACH, _name(k, i, j), "it may be reached, and is not listed")
                return

    def at(self, pose: Pose) -> Iterator[tuple[int, int, int]]:
        """Yield the boxes that hold a pose, within the grid or beyond: slice, column and row."""
        grid, near = self.grid, self.slack
        turned = Fraction(pose.theta % math.tau) / (2 * self.half)
        off = SLACK / self.half
        for k in range(math.floor(turned - off), math.floor(turned + off) + 1):
            places = (
                range(math.floor((at - low - near) / grid.side), math.floor((at - low + near) / grid.side) + 1)
                for at, low in zip((pose.x, pose.y), grid.corner, strict=True)
            )
            columns, rows = places
            yield from ((k % grid.slices, i, j) for j in rows for i in columns)

    def begin(self) -> Iterator[tuple[int, int, int]]:
        """Yield the boxes of all poses within a step of the first one."""
        grid, pose, width = self.grid, self.drive.begin, 2 * self.half
        theta = Fraction(pose.theta)  # off by far less than the slack
        left, right = self.drive.radii
        low, high = theta - grid.step / right - SLACK, theta + grid.step / left + SLACK
        for q in range(math.floor(low / width), math.floor(high / width) + 1):
            turn = self.allowed(q * width - theta, (q + 1) * width - theta)
            if turn is None:
                continue
            middle = float(theta + (q + HALF) * width) / 2
            ahead = Fraction(math.cos(middle)), Fraction(math.sin(middle))
            ends = self.drive.ends(grid.step, *turn, self.half / 2 + SLACK)
            ends = replace(ends, least=-ends.aside)
            place = tuple(at - low - grid.side / 2 for at, low in zip((pose.x, pose.y), grid.corner, strict=True))
            for i, j in self.meeting(ahead, ends, place, grid.side / 2):  # type: ignore[arg-type]
                yield q % grid.slices, i, j

    # --- forbidden boxes ---

    def forbidden(self, k: int, asked: int) -> int:
        """Return boxes of a slice that are surely forbidden, of those asked for and others in their rows."""
        grid = self.grid
        first, last = (asked & -asked).bit_length() // self.stride, asked.bit_length() // self.stride
        rows = [0] * grid.rows
        for core in self.cores(k):
            for obstacle in self.obstacles:
                for j, run in self.inside_of(_sum(obstacle, core), first, last + 1):
                    rows[j] |= run
        for j, run in self.beyond(k, first, last + 1):
            rows[j] |= run
        return self.packed(rows)

    @cached_property
    def obstacles(self) -> list[Ints]:
        """Convex pieces of the obstacles, counterclockwise, in units."""
        scale = self.world.scale
        return [self.rounded([(Fraction(x, scale), Fraction(y, scale)) for x, y in ring])
                for ring in self.world.obstacle_pieces]  # fmt: skip

    def rounded(self, ring: Ring) -> Ints:
        """Return a ring in units, each coordinate off by half of one."""
        return [(round(x * self.common), round(y * self.common)) for x, y in ring]

    def cores(self, k: int) -> Iterator[Ints]:
        """Yield, for each piece of the robot, what it covers at every pose of a box; turned about the box's middle."""
        slices, side = self.grid.slices, self.grid.side
        widen = cosine_sine(1, slices)[0]
        for ring in self.drive.robot:
            core: Ring = [(-self.far, -self.far), (self.far, -self.far), (self.far, self.far), (-self.far, self.far)]
            for (ax, ay), (bx, by) in zip(ring, [*ring[1:], ring[0]], strict=True):
                nx, ny = by - ay, ax - bx
                height = nx * ax + ny * ay
                for c, s in (cosine_sine(2 * k, slices), cosine_sine(2 * k + 2, slices)):
                    ux, uy = c * nx - s * ny, s * nx + c * ny
                    less = (side / 2 + self.slack) * (abs(ux) + abs(uy))
                    core = _clipped(core, (ux, uy), (height * widen if height > 0 else height) - less)
            if len(core) > 2:
                yield [(-x, -y) for x, y in self.rounded(core)]

    def inside_of(self, ring: Ints, first: int, last: int) -> Iterator[tuple[int, int]]:
        """Yield rows, and the boxes there with their middles inside a convex ring."""
        grid, common = self.grid, self.common
        side = int(grid.side * common)
        x0, y0 = (int((at + grid.side / 2) * common) for at in grid.corner)
        low, high = min(y for _, y in ring), max(y for _, y in ring)
        first, last = max(first, -((y0 - low) // side)), min(last, grid.rows, (high - y0) // side + 1)
        if first >= last:
            return
        begin, end = [0] * (last - first), [grid.columns] * (last - first)
        for (ax, ay), (bx, by) in zip(ring, [*ring[1:], ring[0]], strict=True):
            if ay == by:
                continue
            height = by - ay
            bottom, top = min(ay, by), max(ay, by)
            for j in range(max(first, -((y0 - bottom) // side)), min(last, (top - y0) // side + 1)):
                # the edge's x is (ax - x0) + (y - ay) (bx - ax) / height from the first column
                over = (ax - x0) * height + (y0 + j * side - ay) * (bx - ax)
                if height > 0:
                    end[j - first] = min(end[j - first], -(-over // (side * height)))
                else:
                    begin[j - first] = max(begin[j - first], over // (side * height) + 1)
        for j, (a, b) in enumerate(zip(begin, end, strict=True), first):
            if a < b:
                yield j, (1 << b) - (1 << a)

    def beyond(self, k: int, first: int, last: int) -> Iterator[tuple[int, int]]:
        """Yield rows, and the boxes there in which the reference point is beyond its bounds."""
        grid, bounds = self.grid, self.world.scene.bounds
        if not bounds:
            return
        (rx, ry), slices = self.drive.reference, self.grid.slices
        sides = cosine_sine(2 * k, slices), cosine_sine(2 * k + 2, slices)
        arms = [(c * rx - s * ry, s * rx + c * ry) for c, s in sides]
        out = 1 / cosine_sine(1, slices)[0]
        more = grid.side / 2 + self.slack

        def range_within(axis: int, low: Fraction, high: Fraction, count: int) -> tuple[int, int]:
            """The first box of an axis that is not beyond, and the one after the last."""
            least, most = min(arm[axis] for arm in arms), max(arm[axis] for arm in arms)
            most, least = most * (out if most > 0 else 1) + more, least * (out if least < 0 else 1) - more
            middle = grid.corner[axis] + grid.side / 2
            begin, end = (low - most - middle) / grid.side, (high - least - middle) / grid.side
            return min(max(math.ceil(begin), 0), count), min(max(math.floor(end) + 1, 0), count)

        i0, i1 = range_within(0, bounds[0], bounds[2], grid.columns)
        j0, j1 = range_within(1, bounds[1], bounds[3], grid.rows)
        within = (1 << i1) - (1 << i0) if i0 < i1 else 0
        yield from ((j, self.row ^ within if j0 <= j < j1 else self.row) for j in range(first, min(last, grid.rows)))


def _name(k: int, i: int, j: int) -> str:
    return f"box ({i}, {j}, {k})"


def _clipped(ring: Ring, normal: Point, height: Fraction) -> Ring:
    """Return the part of a convex ring with normal . z <= height."""
    part = list[Point]()
    over = [normal[0] * x + normal[1] * y - height for x, y in ring]
    for k, ((ax, ay), u) in enumerate(zip(ring, over, strict=True)):
        (bx, by), v = ring[(k + 1) % len(ring)], over[(k + 1) % len(ring)]
        if u <= 0:
            part.append((ax, ay))
        if u * v < 0:
            t = u / (u - v)
            part.append((ax + t * (bx - ax), ay + t * (by - ay)))
    return part


def _within(ring: Ring, part: Ring) -> Ring:
    """Return the part of a convex ring in another one."""
    for (ax, ay), (bx, by) in zip(part, [*part[1:], part[0]], strict=True):
        ring = _clipped(ring, (by - ay, ax - bx), (by - ay) * ax + (ax - bx) * ay)
    return ring


def _area(ring: Ring) -> Fraction:
    """Return twice the area of a ring, positive if it is counterclockwise."""
    return sum((ring[k - 1][0] * y - ring[k - 1][1] * x for k, (x, y) in enumerate(ring)), ZERO)


def _is_convex(ring: Ring) -> bool:
    """True if a ring turns left at every vertex, and once around."""
    sides = [(x - ring[k - 1][0], y - ring[k - 1][1]) for k, (x, y) in enumerate(ring)]
    turns = [sides[k - 1][0] * y - sides[k - 1][1] * x for k, (x, y) in enumerate(sides)]
    ups = sum((sides[k - 1] < (ZERO, ZERO)) != (side < (ZERO, ZERO)) for k, side in enumerate(sides))
    return min(turns) > 0 and ups == 2


def _sum(a: Ints, b: Ints) -> Ints:
    """Return the ring of sums of points of two convex rings; all its vertices are such sums."""
    i, j = (min(range(len(ring)), key=lambda k: (ring[k][1], ring[k][0])) for ring in (a, b))
    m, n, ring = 0, 0, list[tuple[int, int]]()
    while m < len(a) or n < len(b):
        (px, py), (qx, qy) = a[(i + m) % len(a)], b[(j + n) % len(b)]
        ring.append((px + qx, py + qy))
        (rx, ry), (sx, sy) = a[(i + m + 1) % len(a)], b[(j + n + 1) % len(b)]
        turn = (rx - px) * (sy - qy) - (ry - py) * (sx - qx)
        if m < len(a) and (n == len(b) or turn >= 0):
            m += 1
        else:
            n += 1
    return ring
