"""Closed surfaces of pieces, mod 2: sides along curves, and sides at critical angles.

A side that two pieces share is the same path in both up to a distance far below the margin by which the true robot is
larger. docs/theory/separations.md has the proof that this suffices.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from flint import arb

from cfree.verify.round_algebra import BALL_ERROR, Ball, Turn
from cfree.verify.round_pieces import SURDS, Piece, Scale, rounded
from cfree.verify.round_surfaces import AXES, BALLS, Curve, Surface, UndecidedError, axis, direction

Place = tuple[arb, arb]
APART = 1 << 16  # times `near`: places farther from each other are two


class Arc(NamedTuple):
    """A side along a curve, or a part of it between two angles."""

    piece: int
    curve: Curve
    chart: int
    start: int
    stop: int


class Level(NamedTuple):
    """A side at a critical angle, just before it or just after it."""

    piece: int
    surface: Surface
    quadrant: int
    turn: Turn
    ends: tuple[Place, Place]


def loose(pieces: Sequence[Piece], scale: Scale) -> Iterator[tuple[str, list[int]]]:
    """Sides without a partner, each with its place and the pieces that meet there. Raises UndecidedError."""
    yield from _loose_curves(pieces, scale)
    for levels in _levels(pieces, scale):
        yield from _loose_levels(levels, scale)


def merged(angles: Iterable[int], scale: Scale) -> dict[int, int]:
    """One integer for all angles that are one. Raises UndecidedError if two are neither one nor apart."""
    result: dict[int, int] = {}
    last: int | None = None
    for angle in sorted(set(angles)):
        if last is None or angle - last > 16:
            if last is not None and angle - last < 32 * scale.step:
                raise UndecidedError("two angles are too near to each other")
            last = angle
        result[angle] = last
    return result


def same_place(p: Place, q: Place, near: arb) -> bool:
    """True if two points are one. Raises UndecidedError if they are neither one nor apart."""
    gap = abs(p[0] - q[0]) + abs(p[1] - q[1])
    if gap < near:
        return True
    if gap > APART * near:
        return False
    raise UndecidedError("two places are neither one nor apart")


# --- along curves ---


def _loose_curves(pieces: Sequence[Piece], scale: Scale) -> Iterator[tuple[str, list[int]]]:
    sides = defaultdict(list)
    cuts: dict[Any, set[int]] = defaultdict(set)
    for piece in pieces:
        for number, curve in enumerate((piece.lower, piece.upper)):
            key = curve.name, piece.chart
            sides[key].append(Arc(piece.number, curve, piece.chart, piece.start, piece.stop))
            cuts[key].update((piece.start, piece.stop, *piece.touches[number]))
    left: list[Arc] = []
    for key, group in sides.items():
        for arcs, turn in _cut(group, cuts[key], scale):
            left += _odd(arcs, turn, scale)
    yield from _loose_ties(left, scale)


def _cut(arcs: Sequence[Arc], cuts: Iterable[int], scale: Scale) -> Iterator[tuple[list[Arc], Turn]]:
    """Parts of arcs of one chart between angles that follow each other, and an angle half-way.

    An arc that goes on through such an angle leaves out a part, around it, that must be short.
    """
    one = merged(cuts, scale)
    for start, stop in pairwise(sorted(set(one.values()))):
        there = [arc for arc in arcs if arc.start <= start + 16 and stop <= arc.stop + 16]
        for arc in there:
            if arc.start < start - 16:
                tau = scale.tau(start) + arb(0, scale.tau(2 * scale.step))
                if not all(c.rad() < scale.near for c in arc.curve.point(Turn.of(arc.chart, tau))):
                    raise UndecidedError("a side that goes on through an angle")
        if there:
            parts = [arc._replace(start=start, stop=stop) for arc in there]
            yield parts, scale.turn(there[0].chart, (start + stop) // 2)


def _odd(arcs: Sequence[Arc], turn: Turn, scale: Scale) -> list[Arc]:
    """One arc of each odd number that are in one place half-way: of one name, they are one everywhere."""
    return [arc for arc, _ in _pairs(arcs, turn, scale, lambda one, two: True)]


def _pairs(
    arcs: Sequence[Arc], turn: Turn, scale: Scale, are_one: Callable[[Arc, Arc], bool]
) -> list[tuple[Arc, Place]]:
    """Arcs that are left over if any two in one place are taken away."""
    left: list[tuple[Arc, Place]] = []
    for arc in arcs:
        place = arc.curve.point(turn)
        k = next((k for k, (_, other) in enumerate(left) if same_place(place, other, scale.near)), None)
        if k is None:
            left.append((arc, place))
        elif are_one(arc, left.pop(k)[0]):
            continue
        else:
            raise UndecidedError(f"sides of piece {arc.piece} and of another meet, at least at one angle")
    return left


def _loose_ties(left: list[Arc], scale: Scale) -> Iterator[tuple[str, list[int]]]:
    """Arcs that have a partner of another name, as three surfaces meet at all angles; the others are loose."""
    for chart in (0, 1):
        arcs = [arc for arc in left if arc.chart == chart]
        for there, turn in _cut(arcs, {angle for arc in arcs for angle in (arc.start, arc.stop)}, scale):

            def are_one(one: Arc, two: Arc, at_angle: Turn = turn) -> bool:
                return _is_one(one.curve, two.curve, at_angle, scale)

            for arc, _ in _pairs(there, turn, scale, are_one):
                yield f"a curve at tau = {float(turn.tau.mid()):.9g}, chart {chart}", [arc.piece]


def _is_one(one: Curve, two: Curve, turn: Turn, scale: Scale) -> bool:
    """True if it is proved that two curves that meet at an angle are one between the ends of both."""
    return _lies_on(one, two, turn, scale) or _lies_on(two, one, turn, scale)


def _lies_on(curve: Curve, other: Curve, turn: Turn, scale: Scale) -> bool:
    """True if a curve is on both surfaces of another: it is a curve of these, and at the angle it is that one."""
    if isinstance(other.other, int):
        return isinstance(curve.other, int) and _end(curve.on, curve.other) == _end(other.on, other.other)
    return all(_is_on(curve, surface, turn, scale) for surface in (other.on, other.other))


def _end(circle: Surface, axis: int) -> tuple[Any, ...]:
    """End of a quadrant: a point of the robot and one of the obstacles, which turn and stay."""
    e, rho = AXES[axis], circle.radius
    return circle.a, circle.b[0] + rho * e[0], circle.b[1] + rho * e[1]


def _is_on(curve: Curve, surface: Surface, turn: Turn, scale: Scale) -> bool:
    """True if a curve is on a surface at all angles: the polynomial of all branches is zero, others are not there."""
    x, y = curve.on, curve.other
    if surface.key in curve.key:
        return True
    if isinstance(y, int):
        return SURDS.axis(x, axis(y), surface).is_zero
    if not SURDS.meeting(x, y, surface, turn.chart).is_zero:
        return False
    if not curve.branch or any(form.is_zero for form in curve.existence(SURDS)):
        return True
    circle, line = (x, y) if x.edge is None else (y, x)
    if all(poly.is_zero for poly in SURDS.on_both(circle, line, surface, turn.chart)):
        return True
    rest = _distance(Curve(x, curve.quadrant, y, -curve.branch).point(turn), surface, turn)
    return bool(abs(rest) > scale.near)


def _distance(place: Place, surface: Surface, turn: Turn) -> Ball:
    """Number that is zero if a point is on a surface."""
    a, b, (x, y) = surface.a, surface.b, place
    u = x - arb(b[0]) + turn.cos * arb(a[0]) - turn.sin * arb(a[1])
    v = y - arb(b[1]) + turn.sin * arb(a[0]) + turn.cos * arb(a[1])
    rho = arb(surface.radius)
    if surface.edge is None:
        return u * u + v * v - rho * rho
    p, q = direction(surface, turn)
    return p * v - q * u + rho


# --- at critical angles ---


def _levels(pieces: Sequence[Piece], scale: Scale) -> Iterator[list[Level]]:
    """Sides at each critical angle."""
    one = [merged([a for p in pieces if p.chart == chart for a in (p.start, p.stop)], scale) for chart in (0, 1)]
    last = 1 << scale.bits
    sides = defaultdict(list)
    for piece in pieces:
        for angle, step in ((piece.start, scale.step), (piece.stop, -scale.step)):
            turn = scale.turn(piece.chart, angle + step)
            ends = piece.lower.point(turn), piece.upper.point(turn)
            at_end = abs(angle - last) <= 32
            where = (1 - piece.chart, -last) if at_end else (piece.chart, one[piece.chart][angle])
            sides[where[0], -last if abs(where[1] + last) <= 32 else where[1]].append(
                Level(piece.number, piece.surface, piece.quadrant, turn, ends)
            )
    yield from sides.values()


def _loose_levels(levels: list[Level], scale: Scale) -> Iterator[tuple[str, list[int]]]:
    sheets: dict[tuple[Any, ...], list[Level]] = defaultdict(list)
    for level in levels:
        sheets[level.surface.key, level.quadrant].append(level)
    for group in _one_line(list(sheets.values()), scale):
        ends = sorted((_step_of(place, group[0], scale), level.piece) for level in group for place in level.ends)
        cluster: list[int] = []
        last = 0
        for place, piece in [*ends, (None, -1)]:
            if place is not None and cluster and place - last <= 256:
                cluster.append(piece)
                last = place
                continue
            if len(cluster) % 2:
                turn = group[0].turn
                yield f"a side at tau = {float(turn.tau.mid()):.9g}, chart {turn.chart}", sorted(set(cluster))
            if place is None:
                break
            if cluster and place - last < APART:
                raise UndecidedError("two ends of sides are neither one nor apart")
            cluster, last = [piece], place


def _step_of(place: Place, level: Level, scale: Scale) -> int:
    """Position along a line or a quadrant, in 16ths of `near`."""
    if level.surface.edge is None:
        e, f = AXES[level.quadrant], AXES[(level.quadrant + 1) % 4]
        u, v = arb(f[0] - e[0]), arb(f[1] - e[1])
    else:
        u, v = direction(level.surface, level.turn)
    position = (place[0] * u + place[1] * v) / scale.near * 16
    if not position.rad() < BALL_ERROR:
        raise UndecidedError("the end of a side")
    return rounded(position)


def _one_line(sheets: list[list[Level]], scale: Scale) -> Iterator[list[Level]]:
    """Join sheets that are on one line, or on one circle and quadrant."""
    near = sorted((_rough(sheet[0]), k) for k, sheet in enumerate(sheets))
    parent = list(range(len(sheets)))

    def top(k: int) -> int:
        while parent[k] != k:
            k = parent[k]
        return k

    for n, (one, k) in enumerate(near):
        for two, other in near[n + 1 :]:
            if two[0] != one[0] or two[1] - one[1] > 1e-7 * (1 + abs(one[1])):
                break
            if top(k) != top(other) and _coincide(sheets[k], sheets[other], scale):
                parent[top(k)] = top(other)
    groups: dict[int, list[Level]] = defaultdict(list)
    for k, sheet in enumerate(sheets):
        groups[top(k)] += sheet
    yield from groups.values()


def _rough(level: Level) -> tuple[tuple[Any, ...], float]:
    """Number that is nearly equal for equal lines or circles."""
    (x, y), _ = level.ends
    if level.surface.edge is None:
        r = level.surface.radius
        # the points of a negative radius are in the opposite quadrant
        key = "circle", (level.quadrant + (2 if r < 0 else 0)) % 4, abs(int(r.p)), int(r.q)
        b, a, turn = level.surface.b, level.surface.a, level.turn
        return key, float((arb(b[0]) - turn.cos * arb(a[0]) + turn.sin * arb(a[1])).mid())
    u, v = direction(level.surface, level.turn)
    # the height over the origin, without its sign; the power of a ball around 0 is no number
    return ("line",), abs(float((u * y - v * x).mid()))


def _coincide(one: list[Level], two: list[Level], scale: Scale) -> bool:
    x, y = one[0], two[0]
    if x.surface.edge is None:
        gap = BALLS.apart(x.surface, y.surface).at(x.turn)
        if gap < scale.near**2:
            return True
        if gap > (APART * scale.near) ** 2:
            return False
        raise UndecidedError("two circles are neither one nor apart")
    u, v = direction(x.surface, x.turn)
    (p, q) = x.ends[0]
    # far ends of a line, in order that lines near a point are told apart
    reach = [place for level in two for place in level.ends]
    heights = [abs(u * (b - q) - v * (a - p)) for a, b in reach]
    s, t = direction(y.surface, y.turn)
    heights.append(abs(u * t - v * s))
    if all(h < scale.near for h in heights):
        return True
    if any(h > APART * scale.near for h in heights):
        return False
    raise UndecidedError("two lines are neither one nor apart")
