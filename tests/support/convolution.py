"""Winding numbers of convolutions, in doubles: if two simply connected shapes of segments and arcs overlap.

The convolution of the rims of an obstacle and of the reflected robot has, about the robot's position, a winding number
that is the number of parts of their intersection (Guibas, Ramshaw and Stolfi, 1983). Every vertex, arc and edge is a
circle, of signed radius, or a line; pairs whose normals agree make its parts. Nothing is decided near them.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from cfree.curves.drawn import Line

TURN = 2 * math.pi
TOUCH = 1e-9


class Round(NamedTuple):
    """A vertex or an arc: its normals from `low` to `high`, counter-clockwise; radius and sign below 0 if concave."""

    center: complex
    radius: float
    low: float
    high: float
    sign: int


class Straight(NamedTuple):
    start: complex
    end: complex
    normal: float


Feature = Round | Straight


def features(ring: Iterable[Any]) -> list[Feature]:
    """Features of a ring of `Line` and `Span`, the inside on its left."""
    spans = [_span(piece) for piece in ring]
    if sum(_area(*span) for span in spans) < 0:
        spans = [(end, start, center, -sweep) for start, end, center, sweep in reversed(spans)]
    result: list[Feature] = []
    for k, (start, end, center, sweep) in enumerate(spans):
        after = spans[(k + 1) % len(spans)]
        if not sweep:
            result.append(Straight(start, end, cmath.phase((end - start) / 1j)))
        else:
            first = cmath.phase(start - center) + (math.pi if sweep < 0 else 0.0)
            low, high = sorted((first, first + sweep))
            sign = 1 if sweep > 0 else -1
            result.append(Round(center, sign * abs(start - center), low, high, sign))
        leaves, enters = _direction(start, end, center, sweep, True), _direction(*after, False)
        turn = cmath.phase(enters / leaves)
        if abs(turn) > TOUCH:
            turn = math.pi if turn < -math.pi + TOUCH else turn  # a cusp
            normal = cmath.phase(leaves / 1j)
            low, high = sorted((normal, normal + turn))
            result.append(Round(end, 0.0, low, high, 1 if turn > 0 else -1))
    return result


def _span(piece: Any) -> tuple[complex, complex, complex, float]:
    if isinstance(piece, Line):
        return complex(*map(float, piece.start)), complex(*map(float, piece.end)), 0j, 0.0
    center, u, v = (complex(*map(float, p)) for p in (piece.center, piece.u, piece.v))
    sweep = piece.quarters * math.pi / 2 + 2 * math.atan(float(piece.rest))
    end = center + u * math.cos(sweep) + v * math.sin(sweep)
    return center + u, end, center, sweep if (v / u).imag > 0 else -sweep


def _area(start: complex, end: complex, center: complex, sweep: float) -> float:
    """Twice the area between the origin and a piece."""
    return (start.conjugate() * end).imag + abs(start - center) ** 2 * (sweep - math.sin(sweep))


def _direction(start: complex, end: complex, center: complex, sweep: float, at_end: bool) -> complex:
    if not sweep:
        return end - start
    return ((end if at_end else start) - center) * (1j if sweep > 0 else -1j)


def reflected(shape: list[Feature], theta: float) -> list[Feature]:
    """The robot turned by theta and reflected at the origin."""
    turn = -cmath.exp(1j * theta)
    result: list[Feature] = []
    for f in shape:
        if isinstance(f, Round):
            by = theta + math.pi
            result.append(Round(turn * f.center, f.radius, f.low + by, f.high + by, f.sign))
        else:
            result.append(Straight(turn * f.start, turn * f.end, f.normal + theta + math.pi))
    return result


def winding(obstacle: list[Feature], robot: list[Feature], place: complex) -> int | None:
    """Winding number of the convolution about a place; the robot is reflected.

    None if the convolution goes near the place, or edges of the two shapes are nearly parallel.
    """
    if any(abs((a - b + math.pi) % TURN - math.pi) < TOUCH for a in _normals(obstacle) for b in _normals(robot)):
        return None
    turns = 0
    for f in obstacle:
        for g in robot:
            if isinstance(f, Round) and isinstance(g, Round):
                for low, high in _common(f, g):
                    crossings = _arc(f.center + g.center, f.radius + g.radius, low, high, place)
                    if crossings is None:
                        return None
                    turns += f.sign * g.sign * crossings
            elif isinstance(f, Straight) != isinstance(g, Straight):
                line, circle = (f, g) if isinstance(f, Straight) else (g, f)
                assert isinstance(line, Straight) and isinstance(circle, Round)
                if _after(line.normal, circle.low) < circle.high:
                    by = circle.center + circle.radius * cmath.exp(1j * line.normal)
                    crossing = _segment(line.start + by, line.end + by, place)
                    if crossing is None:
                        return None
                    turns += circle.sign * crossing
    return turns


def _normals(shape: list[Feature]) -> set[float]:
    """Where sets of normals begin or end."""
    return {t for f in shape for t in ((f.low, f.high) if isinstance(f, Round) else (f.normal,))}


def _after(angle: float, low: float) -> float:
    """The angle, moved by turns to [low, low + 2 pi)."""
    return low + (angle - low) % TURN


def _common(f: Round, g: Round) -> Iterator[tuple[float, float]]:
    start = _after(g.low, f.low)
    for begin in (start, start - TURN):
        low, high = max(f.low, begin), min(f.high, begin + g.high - g.low)
        if high > low:
            yield low, high


def _segment(p: complex, q: complex, x: complex) -> int | None:
    length = abs(q - p)
    if not length:
        return 0
    share = ((x - p) / (q - p)).real
    if abs(x - (p + min(max(share, 0), 1) * (q - p))) < TOUCH:
        return None
    if (p.imag <= x.imag) == (q.imag <= x.imag):
        return 0
    is_right = p.real + (x.imag - p.imag) / (q.imag - p.imag) * (q.real - p.real) > x.real
    return (1 if q.imag > p.imag else -1) if is_right else 0


def _arc(center: complex, radius: float, low: float, high: float, x: complex) -> int | None:
    """Crossings of the ray to the right with an arc that runs with growing normal; up counts 1."""
    if abs(radius) < TOUCH / 100:
        return 0
    count = 0
    ends = [center + radius * cmath.exp(1j * t) for t in (low, high)]
    if abs(abs(x - center) - abs(radius)) < TOUCH or min(abs(x - e) for e in ends) < TOUCH:
        return None
    if min(abs(x.imag - e.imag) for e in ends) < 1e-12:
        return None  # the ray is through an end
    height = (x.imag - center.imag) / radius
    if abs(height) >= 1:
        return 0
    for psi in (math.asin(height), math.pi - math.asin(height)):
        if _after(psi, low) < high and center.real + radius * math.cos(psi) > x.real:
            count += 1 if radius * math.cos(psi) > 0 else -1
    return count
