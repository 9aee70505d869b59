"""Motions through places where a robot with round edges fits exactly: along a line, or about a point.

A path among polygons inside of the shapes passes such a place nearly. The contacts near it give the exact one: two
contacts that oppose each other hold the robot on a line, and an arc in an arc of its own radius turns about its center.
Each is tried if its numbers are rational; the motion through it is proved free, and searches join its ends.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain, combinations, islice, pairwise, product
from typing import TYPE_CHECKING

import numpy as np

from cfree.collision.arcs import Curve, curves_of
from cfree.exact.half_angle import half_angle_rotation, normalize_angles
from cfree.exact.number import ExactPoint, simplest_between
from cfree.exact.pose import Pose, pose_at

if TYPE_CHECKING:
    from cfree.paths.path import Path
    from cfree.planning.options import Options
    from cfree.planning.true_shapes import TruePlanner
    from cfree.scene.scene import AnyShape, Scene

SAMPLES = 600  # poses at which a path is looked at
MOST_PLACES = 8  # free parts of a path, and motions through fits, that are tried
MOST_TRIES = 40  # searches that join them
MOST_CONTACTS = 40  # contacts near one place that are paired
NEAR = 16  # errors of polygons within which a contact counts as near
ASKEW = 0.05  # radians by which an edge may be askew that is made parallel
FARTHER = (Fraction(5, 4), Fraction(2), Fraction(1), Fraction(1, 2))  # lengths of a motion through a place, relative

Way = list[Pose]


@dataclass(frozen=True)
class Round:
    """A vertex or arc: its radius grown by the shape's, negative if the shape is outside of it."""

    center: ExactPoint
    radius: Fraction


@dataclass(frozen=True)
class Side:
    """A segment from a point along a vector, of rational length; the shape is grown by a radius."""

    point: ExactPoint
    vector: ExactPoint
    length: Fraction
    radius: Fraction


@dataclass(frozen=True)
class Held:
    """A contact: the reference point is on a line n . p = h, n a unit vector; or at a distance from a center."""

    n: ExactPoint | None = None
    h: Fraction = Fraction(0)
    center: ExactPoint = (Fraction(0), Fraction(0))
    radius: Fraction = Fraction(0)


def way_through_fits(planner: TruePlanner, path: Path, options: Options, error: float) -> Way | None:
    """Return a way near one among polygons inside of the shapes, through places where the robot fits exactly.

    Parameters
    ----------
    planner : TruePlanner
    path : Path
        It is free among the polygons, not among the shapes.
    options : Options
    error : float
        That of the polygons.

    Returns
    -------
    list of Pose or None
        None if no such place is found, or the searches do not join them.
    """
    links = _links(planner, path, error)
    ways: dict[int, Way] = {-1: [path.start]}  # by the link at whose end they are
    todo, tries = [-1], 0
    while todo and tries < MOST_TRIES:
        k = todo.pop()
        for n in range(len(links), k, -1):
            if n in ways:
                continue
            tries += 1
            target = [path.goal] if n == len(links) else links[n]
            here = ways[k][-1]
            joined = [here] if here == target[0] else planner.quick(here, target[0], options)
            if joined:
                ways[n] = [*ways[k], *joined[1:], *target[1:]]
                if n == len(links):
                    return ways[n]
                todo.append(n)
    return None


def _links(planner: TruePlanner, path: Path, error: float) -> list[Way]:
    """Return ways that are free among the shapes, along a path: its longest free parts, and motions through fits."""
    robot, obstacles = features_of(planner.true)
    links = [(position, travel, _lengthened(planner, part)) for position, travel, part in _free_parts(planner, path)]
    for position, run in _narrow_runs(planner, path):
        portal = next(_portals(planner, robot, obstacles, run, NEAR * error), None)
        if portal is not None:
            links.append((position, math.hypot(*(float(v) for v in _apart(*portal))), [*portal]))
    longest = sorted(links, key=lambda link: -link[1])[:MOST_PLACES]
    return [way for _, _, way in sorted(longest, key=lambda link: link[0])]


def _lengthened(planner: TruePlanner, way: Way) -> Way:
    """Return a way that goes on straight at both ends, if its first and last motions are straight."""
    for _ in range(2):
        way = [*reversed(way)]
        one, other = way[-2:]
        travel = math.hypot(*map(float, _apart(one, other)))
        if one.tau != other.tau or not travel:
            continue
        x, y = _apart(one, other)
        for share in FARTHER:
            by = share * Fraction(2 * planner.angle_scale / travel).limit_denominator(1 << 12)
            beyond = pose_at(other.x + by * x, other.y + by * y, other.tau)
            if planner.checker.joins([other, beyond]):
                way = [*way[:-1], beyond]
                break
    return way


def _apart(one: Pose, other: Pose) -> ExactPoint:
    return other.x - one.x, other.y - one.y


def _free_parts(planner: TruePlanner, path: Path) -> Iterator[tuple[float, float, Way]]:
    """Yield the position on the path, the length and the poses of each part of it that is free among the shapes."""
    part, length, position = list[Pose](), 0.0, 0.0
    whole = max(path.length, 1e-300)
    for one, other in pairwise(path.poses):
        step = math.hypot(*map(float, _apart(one, other)))
        if planner.checker.joins([one, other]):
            part, length = [*(part or [one]), other], length + step
        else:
            if length > 0:
                yield position / whole, length, part
            part, length = [], 0.0
        position += step
    if length > 0:
        yield position / whole, length, part


def _narrow_runs(planner: TruePlanner, path: Path) -> Iterator[tuple[float, np.ndarray]]:
    """Yield the position, as a share, and rows x, y, theta of each run of poses that are forbidden among the shapes."""
    samples = path.sample(max(path.length, 1e-300) / SAMPLES, max(path.turning, 1e-9) / SAMPLES)
    rows = np.column_stack([samples.xy, samples.theta])
    turned = rows.copy()
    turned[:, 2] = np.mod(turned[:, 2], 2 * math.pi)
    is_free = planner.shapes.are_free(turned)
    travel = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(rows[:, :2], axis=0).T))])
    edges = np.flatnonzero(np.diff(np.concatenate([[True], is_free, [True]]).astype(int)))
    for begin, end in edges.reshape(-1, 2).tolist():
        middle = float(travel[(begin + end) // 2] / max(travel[-1], 1e-300)) if begin + end < 2 * len(travel) else 1.0
        yield middle, rows[max(0, begin - 1) : end + 1]


def features_of(scene: Scene) -> tuple[list[Round | Side], list[Round | Side]]:
    """Return the vertices, arcs and segments with rational numbers: of the robot, and of obstacles and workspace."""
    others: list[AnyShape] = [*scene.obstacles, *([scene.workspace] if scene.workspace else [])]
    robot, rest = ([*chain.from_iterable(map(_features, shapes))] for shapes in (scene.robot, others))
    return robot, rest


def _features(shape: AnyShape) -> Iterator[Round | Side]:
    curves = curves_of(shape)
    assert curves is not None
    grown, rings = curves
    for curve in chain.from_iterable(rings):
        yield from _feature(curve, grown)


def _feature(curve: Curve, grown: Fraction) -> Iterator[Round | Side]:
    (px, py), (qx, qy), (cx, cy), turn = curve
    yield Round((px, py), grown)
    if not turn:
        if (length := _root((qx - px) ** 2 + (qy - py) ** 2)) is not None:
            yield Side((px, py), (qx - px, qy - py), length, grown)
    elif (radius := _root((px - cx) ** 2 + (py - cy) ** 2)) is not None:
        yield Round((cx, cy), radius + grown)
        if radius > grown:
            yield Round((cx, cy), grown - radius)


def _root(square: Fraction) -> Fraction | None:
    """Square root, if it is rational."""
    n, d = math.isqrt(square.numerator), math.isqrt(square.denominator)
    return Fraction(n, d) if n * n == square.numerator and d * d == square.denominator else None


def _portals(
    planner: TruePlanner, robot: Sequence[Round | Side], others: Sequence[Round | Side], run: np.ndarray, near: float
) -> Iterator[tuple[Pose, Pose]]:
    """Yield the ends of motions through an exact fit near some poses, proved free."""
    x, y, theta = run[len(run) // 2].tolist()
    steps = run[-1, :2] - run[0, :2]
    for tau in _angles(robot, others, (x, y), theta, near):
        q, p, w = half_angle_rotation(tau)
        c, s = Fraction(q, w), Fraction(p, w)
        held = islice(_contacts(robot, others, (x, y), (c, s), near), MOST_CONTACTS)
        for place, along in _fits([*held], (Fraction(x), Fraction(y))):
            if along is None:
                ends = (_turned(place, float(row[2])) for row in (run[0], run[-1]))
                motions = [(next(ends), next(ends))]
            else:
                if float(along[0]) * steps[0] + float(along[1]) * steps[1] < 0:
                    along = -along[0], -along[1]
                motions = [*_lines(place, along, tau, run)]
            for begin, end in motions:
                if begin != end and planner.checker.joins([begin, end]):
                    yield begin, end


def _turned(place: ExactPoint, theta: float) -> Pose:
    return Pose(*place, theta)


def _lines(place: ExactPoint, along: ExactPoint, tau: Fraction | None, run: np.ndarray) -> Iterator[tuple[Pose, Pose]]:
    """Yield translations along a line through a place, about as long as the run, or longer."""
    (x, y), (u, v) = place, along
    lengths = [abs((row[0] - float(x)) * float(u) + (row[1] - float(y)) * float(v)) for row in (run[0], run[-1])]
    whole = max(sum(lengths), 1e-6)
    back, ahead = (
        Fraction(max(length, whole / 4)).limit_denominator(1 << 12) + Fraction(1, 1 << 12) for length in lengths
    )
    for m, n in product(FARTHER, repeat=2):
        yield pose_at(x - m * back * u, y - m * back * v, tau), pose_at(x + n * ahead * u, y + n * ahead * v, tau)


def _angles(
    robot: Sequence[Round | Side], others: Sequence[Round | Side], place: tuple[float, float], theta: float, near: float
) -> Iterator[Fraction | None]:
    """Yield half-angle tangents near an orientation: with near sides parallel, and the simplest."""
    seen: set[Fraction | None] = set()
    for tau in chain(_parallel(robot, others, place, theta, near), _simple(theta)):
        if tau not in seen:
            seen.add(tau)
            yield tau


def _simple(theta: float) -> Iterator[Fraction | None]:
    turn = float(normalize_angles(theta))
    if abs(abs(turn) - math.pi) < ASKEW:
        yield None
    if abs(turn) < 3:
        tau = math.tan(turn / 2)
        for width in (ASKEW / 2, 1e-3, 1e-6):
            yield simplest_between(Fraction(tau - width), Fraction(tau + width))


def _parallel(
    robot: Sequence[Round | Side], others: Sequence[Round | Side], place: tuple[float, float], theta: float, near: float
) -> Iterator[Fraction | None]:
    c, s = math.cos(theta), math.sin(theta)
    for side, other in product(robot, others):
        if not (isinstance(side, Side) and isinstance(other, Side)):
            continue
        (a, b), (u, v) = side.vector, other.vector
        for way in (1, -1):
            # the quotient of the vectors as complex numbers is that of their lengths times exp(i theta)
            re, im = way * (u * a + v * b), way * (v * a - u * b)
            off = math.atan2(float(im), float(re)) - theta
            if abs(float(normalize_angles(off))) > ASKEW or not _is_beside(side, other, place, (c, s), near):
                continue
            length = side.length * other.length
            yield None if re == -length else im / (length + re)


def _is_beside(side: Side, other: Side, place: tuple[float, float], turn: tuple[float, float], near: float) -> bool:
    """True if a robot's side, about parallel to another, is near its line."""
    (x, y), (c, s) = place, turn
    a, b = (float(side.point[k] + side.vector[k] / 2) for k in (0, 1))
    px, py = x + c * a - s * b - float(other.point[0]), y + s * a + c * b - float(other.point[1])
    height = (float(other.vector[0]) * py - float(other.vector[1]) * px) / float(other.length)
    return abs(abs(height) - float(side.radius + other.radius)) <= near + ASKEW * float(side.length)


def _contacts(
    robot: Sequence[Round | Side],
    others: Sequence[Round | Side],
    place: tuple[float, float],
    turn: ExactPoint,
    near: float,
) -> Iterator[Held]:
    """Yield the contacts near a place, at an exact orientation."""
    (x, y), (c, s) = place, turn
    for own, other in product(robot, others):
        (a, b) = own.center if isinstance(own, Round) else own.point
        arm = c * a - s * b, s * a + c * b
        (u, v) = other.center if isinstance(other, Round) else other.point
        offset = x + float(arm[0] - u), y + float(arm[1] - v)  # from the other's point to the robot's
        total = own.radius + other.radius
        if isinstance(own, Round) and isinstance(other, Round):
            if own.radius < 0 and other.radius < 0:
                continue
            if abs(math.hypot(*offset) - abs(float(total))) <= near and (total >= 0) == (
                min(own.radius, other.radius) >= 0
            ):
                yield Held(center=(u - arm[0], v - arm[1]), radius=abs(total))
            elif total == 0 and own.radius and math.hypot(*offset) <= near:
                yield Held(center=(u - arm[0], v - arm[1]))
        elif isinstance(own, Side) != isinstance(other, Side):
            side, circle = (own, other) if isinstance(own, Side) else (other, own)
            assert isinstance(side, Side) and isinstance(circle, Round)
            if circle.radius < 0:
                continue
            e = (
                side.vector
                if side is other
                else (c * side.vector[0] - s * side.vector[1], s * side.vector[0] + c * side.vector[1])
            )
            n = -e[1] / side.length, e[0] / side.length
            height = float(n[0]) * offset[0] + float(n[1]) * offset[1]
            if height < 0:
                n = -n[0], -n[1]
            foot = (
                (float(e[0]) * offset[0] + float(e[1]) * offset[1]) / float(side.length) * (1 if side is other else -1)
            )
            if abs(abs(height) - float(total)) <= near and -near <= foot <= float(side.length) + near:
                yield Held(n, n[0] * (u - arm[0]) + n[1] * (v - arm[1]) + total)


def _fits(contacts: Sequence[Held], near: ExactPoint) -> Iterator[tuple[ExactPoint, ExactPoint | None]]:
    """Yield places where two contacts oppose each other, with the direction of the motion; None for a turn."""
    for held in contacts:
        if held.n is None and held.radius == 0:
            yield held.center, None
    for one, other in combinations(contacts, 2):
        if one.n is not None and other.n is not None:
            if one.n == (-other.n[0], -other.n[1]) and one.h == -other.h:
                yield _foot(near, one), (-one.n[1], one.n[0])
        elif one.n is None and other.n is None:
            (a, b), (u, v) = one.center, other.center
            apart, total = (u - a, v - b), one.radius + other.radius
            if total and apart[0] ** 2 + apart[1] ** 2 == total**2:
                share = one.radius / total
                yield (a + share * apart[0], b + share * apart[1]), (-apart[1] / total, apart[0] / total)
        else:
            line, circle = (one, other) if one.n is not None else (other, one)
            assert line.n is not None
            height = line.n[0] * circle.center[0] + line.n[1] * circle.center[1] - line.h
            if circle.radius and height == circle.radius:
                yield _foot(circle.center, line), (-line.n[1], line.n[0])


def _foot(point: ExactPoint, line: Held) -> ExactPoint:
    assert line.n is not None
    (x, y), (u, v) = point, line.n
    height = u * x + v * y - line.h
    return x - height * u, y - height * v
