"""Arcs that are tangent to their neighbours but for rounding, made exactly tangent.

Files give an arc's bulge, or its radius and ends, in short decimals. A corner remains where it meets a line or an arc,
often of an angle of 1e-15, which exact decisions keep. If the directions of two lines are rational unit vectors, an arc
of rational radius is tangent to both at rational points. So lines get such directions, nearly their own, about their
middles; axis-parallel and Pythagorean ones stay. Arcs that follow each other are `tangent_chains`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from cfree.curves.drawn import Line
from cfree.curves.pieces import start_of
from cfree.curves.rings import Arc, Bezier, Cubic, GivenRing, Piece, Segment, Span
from cfree.curves.tangent_chains import Chain, Tangent, tangent_chain
from cfree.exact.number import ExactPoint, simplest_between
from cfree.exact.vectors import along, cross, dot, minus, unit

WIDEST_CORNER = 0.01  # angle of a corner that is still taken for rounding
CORNER_SHARE = 8  # a corner is rounding if moving its pieces' ends by this many tolerances could make it
CHOICE_SHARE = 16  # directions are chosen within this part of the tolerance
MOST_TURN = Fraction(1, 10**9)  # and within this, so that numbers stay short
ROUNDING = Fraction(1, 2**48)  # relative error of a radius in doubles


@dataclass(frozen=True, slots=True)
class Change:
    """One healed arc: a place, and the largest move of its ends and its middle."""

    at: ExactPoint
    size: float


def healed_ring(pieces: Sequence[Piece], tolerance: float) -> tuple[GivenRing, list[Change]] | None:
    """Return a ring whose arcs are exactly tangent where they nearly are, or None if there is nothing to heal.

    Parameters
    ----------
    pieces : sequence of Line, Span and Cubic
        A closed ring.
    tolerance : float
        Ends of pieces, and middles of arcs, move by this much at most.
    """
    runs = _runs(pieces, tolerance)
    whole = [_joined(run) for run in runs]
    smooth = {k for k in range(len(whole)) if len(whole) > 1 and _is_smooth(whole, k, tolerance)}
    while smooth := _movable(whole, smooth):
        ends, centers, bad = _places(whole, smooth, tolerance)
        if not bad:
            changes = _changes(runs, whole, ends, centers)
            bad = {k for k, change in changes.items() if change.size > tolerance}
        if not bad:
            new = [k for k, center in centers.items() if _is_new(whole[k], center, ends[k])]
            healed = [changes[k] for k in sorted(new)]
            return (_path(runs, whole, ends, centers), healed) if healed else None
        smooth -= _near(bad, smooth, len(whole))
    return None


def _near(bad: set[int], smooth: set[int], count: int) -> set[int]:
    """Return the smooth joints nearest to pieces that cannot be placed within the tolerance."""
    for reach in range(1, count + 1):
        near = {(k + j) % count for k in bad for j in range(1 - reach, 1 + reach)} & smooth
        if near:
            return near
    return smooth


def _runs(pieces: Sequence[Piece], tolerance: float) -> list[list[Piece]]:
    """Return the pieces in order; successive arcs of one circle, half a turn at most together, are one run."""
    count, is_within = len(pieces), isinstance(pieces[-1], Span)  # then its first piece may be within a run
    first = next((k for k in range(count) if not isinstance(pieces[k], Span)), 0) if is_within else 0
    runs: list[list[Piece]] = []
    for k in range(first, first + count):
        piece = pieces[k % count]
        if runs and _continues(runs[-1], piece, tolerance):
            runs[-1].append(piece)
        else:
            runs.append([piece])
    return runs


def _continues(run: list[Piece], piece: Piece, tolerance: float) -> bool:
    """True if a piece goes on along the circle of a run of arcs, to half a turn at most."""
    arcs = [arc for arc in (*run, piece) if isinstance(arc, Span) and arc.is_circular]
    if len(arcs) <= len(run):
        return False
    first, last = arcs[0], arcs[-1]
    return (
        cross(first.u, first.v) * cross(last.u, last.v) > 0
        and _distance(first.center, last.center) <= tolerance
        and abs(math.hypot(*map(float, first.u)) - math.hypot(*map(float, last.u))) <= tolerance
        and sum(arc.sweep for arc in arcs) <= math.pi + WIDEST_CORNER
    )


def _joined(run: Sequence[Piece]) -> Piece:
    """Return the one piece of a run: its first arc, continued through the angles of the others."""
    arc = run[0]
    if len(run) == 1 or not isinstance(arc, Span):
        return arc
    quarters, rest = arc.quarters, arc.rest
    for other in run[1:]:
        assert isinstance(other, Span)
        quarters += other.quarters
        rest = (rest + other.rest) / (1 - rest * other.rest)
        if rest >= 1:
            quarters, rest = quarters + 1, (rest - 1) / (rest + 1)
    return Span(arc.center, arc.u, arc.v, quarters, rest)


def _arcs(pieces: Sequence[Piece], smooth: set[int]) -> set[int]:
    """Return the arcs with a smooth joint; joint k is the start of piece k."""
    count = len(pieces)
    return {k for j in smooth for k in (j, (j - 1) % count) if isinstance(pieces[k], Span)}


def _movable(pieces: Sequence[Piece], smooth: set[int]) -> set[int]:
    """Return the joints whose lines can get rational directions: each such line ends at a line, or at such an arc."""
    count = len(pieces)
    while True:
        arcs = _arcs(pieces, smooth)
        stuck = {
            k
            for k in range(count)
            if isinstance(pieces[k], Line)
            and {k, (k + 1) % count} & smooth
            and unit(_vector(pieces[k])) is None
            and any(j % count not in arcs and not isinstance(pieces[j % count], Line) for j in (k - 1, k + 1))
        }
        if not stuck:
            return smooth
        smooth = smooth - {joint % count for k in stuck for joint in (k, k + 1)}


def _places(
    pieces: Sequence[Piece], smooth: set[int], tolerance: float
) -> tuple[dict[int, ExactPoint], dict[int, ExactPoint], set[int]]:
    """Return the new ends of pieces, the new centers of arcs, and the pieces that have no place."""
    count, arcs = len(pieces), _arcs(pieces, smooth)
    lines = {k for k in range(count) if isinstance(pieces[k], Line) and {k, (k + 1) % count} & smooth}
    on = {
        k: _line(piece, tolerance) if k in lines else (piece.start, _vector(piece))
        for k, piece in enumerate(pieces)
        if isinstance(piece, Line)
    }
    moved = {k for k in lines if unit(_vector(pieces[k])) is None}
    ends: dict[int, ExactPoint] = {}
    centers: dict[int, ExactPoint] = {}
    bad: set[int] = set()
    for chain in _chains(arcs, smooth, count):
        place = _chained(pieces, chain, smooth, {k: on[k] for k in lines}, tolerance)
        if place is None:
            bad |= {*chain}
            continue
        for k, start, end, center in zip(chain, place[0], place[0][1:], place[1], strict=False):
            ends[(k - 1) % count], ends[k], centers[k] = start, end, center
    for k in range(count):
        j = (k + 1) % count
        if not {k, j} & arcs and {k, j} & moved:
            if cross(on[k][1], on[j][1]):
                ends[k] = _meeting(on[k], on[j])
            else:
                bad |= {k, j} & moved
    return ends, centers, bad


def _chains(arcs: set[int], smooth: set[int], count: int) -> list[list[int]]:
    """Return the chains of arcs that follow each other smoothly."""
    firsts = [k for k in sorted(arcs) if k not in smooth or (k - 1) % count not in arcs]
    chains = [[k] for k in firsts or sorted(arcs)[:1]]
    for chain in chains:
        while (k := (chain[-1] + 1) % count) in arcs and k in smooth and k != chain[0]:
            chain.append(k)
    return chains


def _chained(
    pieces: Sequence[Piece],
    chain: Sequence[int],
    smooth: set[int],
    lines: Mapping[int, tuple[ExactPoint, ExactPoint]],
    tolerance: float,
) -> Tangent | None:
    """Return new joints and centers of a chain of arcs; None if there are none."""
    count, first, last = len(pieces), chain[0], (chain[-1] + 1) % len(pieces)
    arcs = [pieces[k] for k in chain]
    before, after = lines.get((first - 1) % count), lines.get(last)
    is_closed = first == last and first in smooth
    if len(chain) == 1 and first in smooth and last in smooth and before and after:
        (arc,) = arcs
        assert isinstance(arc, Span)
        if arc_place := _tangent_arc(arc, before, after):
            return [*arc_place[:2]], [arc_place[2]]
    spans = [arc for arc in arcs if isinstance(arc, Span)]
    longest = max(Fraction(math.hypot(*_float(arc.u))) for arc in spans)
    by = Fraction(tolerance) / longest / CHOICE_SHARE
    joints, normals = [*map(start_of, spans), spans[-1].end], list[ExactPoint | None]()
    for k, joint in enumerate(joints):
        line = before if k == 0 else after if k == len(spans) else None
        if line:
            joints[k] = along(line[0], dot(minus(joint, line[0]), line[1]) / dot(line[1], line[1]), line[1])
        if line and (first if k == 0 else last) in smooth:
            normals.append((-line[1][1], line[1][0]))
        elif 0 < k < len(spans) or is_closed:
            x, y = (p + q for p, q in zip(_leaving(spans[k - 1]), _entering(spans[k % len(spans)]), strict=True))
            u, v = unit_near(Fraction(x), Fraction(y), by)
            normals.append((-v, u))
        else:
            normals.append(None)
    if is_closed:
        normals[-1] = normals[0]
    if _is_tangent(spans, before if normals[0] else None, after if normals[-1] else None, is_closed=is_closed):
        return [start_of(spans[0]), *(arc.end for arc in spans)], [arc.center for arc in spans]
    place = tangent_chain(Chain((*joints,), (*normals,)), Fraction(tolerance) / CHOICE_SHARE)
    if place and all(dot(arc.u, minus(p, c)) > 0 for arc, p, c in zip(spans, *place, strict=False)):
        return place
    return None  # a center is on the other side


def _is_tangent(
    arcs: Sequence[Span],
    before: tuple[ExactPoint, ExactPoint] | None,
    after: tuple[ExactPoint, ExactPoint] | None,
    *,
    is_closed: bool,
) -> bool:
    """True if a chain of arcs is exactly tangent, also to lines before and after it."""
    follow = [*pairwise(arcs), *([(arcs[-1], arcs[0])] if is_closed else [])]
    touching = [(start_of(arcs[0]), arcs[0], before), (arcs[-1].end, arcs[-1], after)]
    return all(not cross(minus(one.end, one.center), minus(one.end, other.center)) for one, other in follow) and all(
        not (line and (cross(minus(p, line[0]), line[1]) or dot(minus(p, arc.center), line[1])))
        for p, arc, line in touching
    )


def _entering(arc: Span) -> tuple[float, float]:
    """Return the unit vector in which an arc begins."""
    x, y = _float(arc.v)
    length = math.hypot(x, y)
    return x / length, y / length


def _leaving(arc: Span) -> tuple[float, float]:
    """Return the unit vector in which an arc ends."""
    x, y = _float(minus(arc.end, arc.center))
    length = math.hypot(x, y) * arc.sense
    return -y / length, x / length


def _changes(
    runs: Sequence[Sequence[Piece]],
    pieces: Sequence[Piece],
    ends: Mapping[int, ExactPoint],
    centers: Mapping[int, ExactPoint],
) -> dict[int, Change]:
    """Return the largest move of each piece that has a new end or center."""
    changes = {}
    for k, piece in enumerate(pieces):
        before, after = _end(runs[k - 1][-1]), _end(runs[k][-1])
        start, end = ends.get(k - 1 if k else len(pieces) - 1, before), ends.get(k, after)
        moves = [_distance(start, before), _distance(end, after)]
        if k in centers and isinstance(piece, Span):
            middle = middle_of(piece.center, before, after, cross(piece.u, piece.v) > 0)
            moves.append(math.dist(middle, middle_of(centers[k], start, end, cross(piece.u, piece.v) > 0)))
        if k in centers or any(moves):
            # doubles hide moves of less than a rounding; that of the center is about the same
            least = _distance(centers[k], piece.center) if k in centers and isinstance(piece, Span) else 0.0
            changes[k] = Change(start, max(moves) or least)
    return changes


def _is_new(arc: Piece, center: ExactPoint, end: ExactPoint) -> bool:
    return isinstance(arc, Span) and (center, end) != (arc.center, arc.end)


def middle_of(center: ExactPoint, start: ExactPoint, end: ExactPoint, left: bool) -> tuple[float, float]:
    """Return the middle of an arc of about half a turn or less, relative to the origin, in doubles."""
    (x, y), (p, q) = _float(minus(start, center)), _float(minus(end, center))
    sign = 1.0 if left else -1.0
    turn = math.atan2(sign * (x * q - y * p), x * p + y * q) % math.tau / 2
    c, s = math.cos(turn), sign * math.sin(turn)
    return float(center[0]) + c * x - s * y, float(center[1]) + s * x + c * y


def _path(
    runs: Sequence[Sequence[Piece]],
    pieces: Sequence[Piece],
    ends: Mapping[int, ExactPoint],
    centers: Mapping[int, ExactPoint],
) -> GivenRing:
    path: list[Segment] = [ends.get(len(runs) - 1, _end(runs[-1][-1]))]
    for k, run in enumerate(runs):
        end, arc = ends.get(k, _end(run[-1])), pieces[k]
        if k in centers and isinstance(arc, Span):
            path.append(Arc(end, center=centers[k], clockwise=cross(arc.u, arc.v) < 0))
        elif isinstance(arc, Line):
            path.append(end)
        else:
            path += map(segment_of, run)
    return tuple(path)


def segment_of(piece: Piece) -> Segment:
    """Return a piece as the segment of a path that begins at its start."""
    if isinstance(piece, Line):
        return piece.end
    if isinstance(piece, Cubic):
        return Bezier(piece.points[1:])
    assert isinstance(piece, Span)
    return Arc(piece.end, center=piece.center, conjugate=piece.v, clockwise=cross(piece.u, piece.v) < 0)


def _is_smooth(pieces: Sequence[Piece], k: int, tolerance: float) -> bool:
    """True if a piece and the one before it are nearly tangent, and one or both are circular arcs."""
    before, after = pieces[k - 1], pieces[k]
    if not any(isinstance(piece, Span) for piece in (before, after)):
        return False
    if not all(isinstance(piece, Line) or (isinstance(piece, Span) and piece.is_circular) for piece in (before, after)):
        return False
    v = _leaving(before) if isinstance(before, Span) else _float(_vector(before))
    w = _entering(after) if isinstance(after, Span) else _float(_vector(after))
    widest = min(WIDEST_CORNER, CORNER_SHARE * tolerance / min(map(_length, (before, after))))
    return v[0] * w[0] + v[1] * w[1] > 0 and abs(v[0] * w[1] - v[1] * w[0]) <= widest * (v[0] * w[0] + v[1] * w[1])


def _length(piece: Piece) -> float:
    """Length of a line; of an arc, its radius if that is less."""
    if isinstance(piece, Span):
        return math.hypot(*_float(piece.u)) * min(piece.sweep, 1.0)
    return math.hypot(*_float(_vector(piece)))


def _tangent_arc(
    arc: Span, before: tuple[ExactPoint, ExactPoint], after: tuple[ExactPoint, ExactPoint]
) -> tuple[ExactPoint, ExactPoint, ExactPoint] | None:
    """Return start, end and center of an arc that is tangent to two lines with rational unit directions."""
    (a, d), (b, e) = before, after
    touching = ((start_of(arc), a, d), (arc.end, b, e))
    if not any(cross(minus(p, q), v) or dot(minus(p, arc.center), v) for p, q, v in touching):
        return start_of(arc), arc.end, arc.center
    turn = 1 if cross(arc.u, arc.v) > 0 else -1
    inward = (-turn * d[1], turn * d[0])
    sine, cosine = turn * cross(d, e), dot(d, e)
    if sine == 0:
        start = along(a, dot(minus(start_of(arc), a), d), d)
        radius = dot(minus(b, a), inward) / 2
        if cosine > 0 or radius <= 0:
            return None
        return start, along(start, 2 * radius, inward), along(start, radius, inward)
    if sine < 0:
        return None
    corner = _meeting(before, after)
    radius = _radius(arc, corner, (1 + cosine) / sine)
    length = radius * sine / (1 + cosine)
    start = along(corner, -length, d)
    return start, along(corner, length, e), along(start, radius, inward)


def _radius(arc: Span, corner: ExactPoint, ratio: Fraction) -> Fraction:
    """Return the simplest radius about as near to the arc's own as those are that its two ends have.

    The ends of a tangent arc are a radius divided by `ratio` away from the corner of its lines.
    """
    radii = [Fraction(math.sqrt(dot(arc.u, arc.u)))]
    radii += [Fraction(_distance(p, corner)) * ratio for p in (start_of(arc), arc.end)]
    spread = min(2 * (max(radii) - min(radii)) + radii[0] * ROUNDING, radii[0] * Fraction(WIDEST_CORNER))
    return simplest_between(min(radii) - spread, max(radii) + spread)


def _line(piece: Piece, tolerance: float) -> tuple[ExactPoint, ExactPoint]:
    """Return a point of a line, and a rational unit vector along it, or nearly so."""
    assert isinstance(piece, Line)
    x, y = _vector(piece)
    if (direction := unit((x, y))) is not None:
        return piece.start, direction
    by = Fraction(tolerance) / Fraction(math.hypot(x, y)) / CHOICE_SHARE
    (p, q), (r, s) = piece.start, piece.end
    return ((p + r) / 2, (q + s) / 2), unit_near(x, y, by)


def unit_near(x: Fraction, y: Fraction, by: Fraction) -> ExactPoint:
    """Return a rational unit vector whose half angle is that of a vector, or nearly so."""
    quarters = 0
    while not (x > 0 and -x < y <= x):
        x, y, quarters = y, -x, quarters + 1
    half, by = Fraction(math.tan(math.atan2(y, x) / 2)), min(by, MOST_TURN)
    t = simplest_between(half - by, half + by)
    x, y = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    for _ in range(quarters):
        x, y = -y, x
    return x, y


def _meeting(one: tuple[ExactPoint, ExactPoint], other: tuple[ExactPoint, ExactPoint]) -> ExactPoint:
    (a, d), (b, e) = one, other
    return along(a, cross(minus(b, a), e) / cross(d, e), d)


def _end(piece: Piece) -> ExactPoint:
    return piece.points[-1] if isinstance(piece, Cubic) else piece.end


def _vector(piece: Piece) -> ExactPoint:
    assert isinstance(piece, Line)
    return minus(piece.end, piece.start)


def _distance(a: ExactPoint, b: ExactPoint) -> float:
    return math.hypot(*_float(minus(a, b)))


def _float(vector: ExactPoint) -> tuple[float, float]:
    return float(vector[0]), float(vector[1])
