#!/usr/bin/env python3
"""Check an answer of cfree, a path or a proof that there is none, with Python's standard library and nothing else.

    python check_answer.py SCENE.json ANSWER.json

prints one line. Exit code 0: verified. 1: refuted. 2: a file cannot be read; that includes scenes in GeoJSON or WKT,
and answers without exact numbers. The formats are those of docs/scene-format.md and docs/answer-format.md.

The check trusts this file; Python's integers, `fractions`, `decimal`, `json`, `hashlib`; the mathematics below. All
signs are of integers; only the rational that an angle stands for is found in floating point. It uses no cfree.

A point a of the robot is at R(theta) a + r. A pose is forbidden if the interior of one of its polygons meets the
interior of an obstacle, or leaves the workspace, or if r leaves the bounds.

Paths. With tau = tan(theta / 2) every motion is a quotient of polynomials. Robot and obstacles are cut into convex
pieces. Two of these do not overlap exactly if a side of one has all of the other on its outer side. The sign of a
polynomial decides that for a vertex. So one moment stands for all between two neighbouring zeros of these.

Proofs that there is none. A contact surface is a set of poses at which a vertex is on an edge. A piece of it is {(t,
theta): lower(theta) <= t <= upper(theta), from <= theta <= to}, t the place on the edge. If every part of every edge
belongs to an even number of pieces, then they have no boundary, and a closed path crosses them an even number of times,
if properly. If a ray from the start does so an odd number of times, and one from the goal an even number, every path
between them meets a piece, where the robot touches something. So "interior" proofs exclude paths that keep a distance.
"closed" ones have contacts of a robot strictly inside the real one: where it touches, the real one overlaps. A
clearance is kept by a robot larger by a polygon around a disc; it is not if a robot all nearer touches.

Round shapes. Edges are segments and arcs of circles, perhaps grown by a disc. At one pose two shapes overlap if one of
finitely many vertical lines has a part inside both, or if edges are nearer than they are grown. Along a motion this
changes only where ends are on lines or circles, or these touch, at polynomials' zeros. Numbers with square roots are
compared as integers, with as many digits as tell them from zero.

Vehicles. A car drives along forward, or turns about a pole on the line of its axle: signs of rationals decide. Contacts
hold it if the first motion of every curvature overlaps something. Between neighbouring zeros of the rates one stands
for all. A car without reverse gear does not reach a goal that is in no listed box if every step of travel from a listed
box ends in listed boxes, or in boxes that are forbidden as a whole. Sines are rounded to 2^-64, and lengths changed by
more than that is off, to the safe side.
"""

from __future__ import annotations

import base64
import binascii
import contextlib
import hashlib
import json
import math
import re
import sys
import zlib
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from copy import copy
from dataclasses import dataclass, field
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from functools import cache, cmp_to_key, lru_cache
from itertools import chain, pairwise, zip_longest
from operator import mul
from pathlib import Path
from typing import Any

VERIFIED, REFUTED, UNREADABLE = 0, 1, 2
BOUNDS, WORKSPACE = -1, -2  # instead of the number of an obstacle

Point = tuple[Any, Any]  # of Fractions or integers
Ring = list[Point]
Poly = tuple[int, ...]  # coefficients, the constant first
Contact = tuple[str, tuple[int, int], tuple[int, int]]  # kind, robot's and obstacle's polygon and vertex
Fractions = Sequence[Fraction]
Interval = tuple[Fraction, Fraction]
ZERO, ONE = Fraction(0), Fraction(1)

class BadFileError(Exception):
    """The content of a file differs from its format."""

class RefutedError(Exception):
    """The answer is wrong, or not proved."""

def refuse_if(wrong: Any, text: str) -> None:
    if wrong:
        raise BadFileError(text)

def refute_if(wrong: Any, text: str) -> None:
    if wrong:
        raise RefutedError(text)

# === Files: JSON with exact numbers, no unknown and no repeated keys ===
MAX_DIGITS = 4000
LARGEST = 10**150  # largest coordinate
MAX_BITS = 1110  # bits of a scene's coordinates over their common denominator
QUOTIENT = re.compile(r"\s*([+-]?[0-9]+)\s*/\s*([+-]?[0-9]+)\s*")
BITS = 1300  # bits of angles: there may be 1024 in front of the point
REQUIRED, ROUND = object(), {"circle", "ellipse", "path", "grown"}  # keys of round shapes

def decoded(text: str) -> Any:
    """A JSON value: decimals as `Decimal`, integers as int."""
    def exact(literal: str) -> Any:
        if len(literal) > MAX_DIGITS:
            return literal  # a text of that length is no number
        return int(literal) if literal.lstrip("-").isdigit() else Decimal(literal)
    def unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        value = dict(pairs)
        refuse_if(len(value) < len(pairs), f"a key is there twice, one of {list(value)!a:.60}")
        return value
    try:
        return json.loads(text, parse_int=exact, parse_float=exact, parse_constant=int, object_pairs_hook=unique)
    except (ValueError, InvalidOperation, RecursionError) as error:
        raise BadFileError(f"no JSON: {error}") from None

def members(value: Any, place: str, /, **known: Any) -> dict[str, Any]:
    """Members of an object; `known` holds the keys, each with its default."""
    refuse_if(not isinstance(value, dict), f"{place}: expected an object")
    for key in value:
        refuse_if(key not in known, f"{place}: unknown key {key!a}")
    for key, default in known.items():
        refuse_if(default is REQUIRED and key not in value, f"{place}: {key!a} is missing")
    return {key: value.get(key, default) for key, default in known.items()}

def items(value: Any, place: str, least: int = 0, most: float = math.inf) -> list[Any]:
    refuse_if(not isinstance(value, list) or not least <= len(value) <= most, f"{place}: expected a list")
    return value  # type: ignore[no-any-return]

def one_of(value: Any, place: str, *choices: Any) -> Any:
    if not any(type(value) is type(choice) and value == choice for choice in choices):
        raise BadFileError(f"{place}: expected one of {', '.join(map(repr, choices))}")
    return value

def whole(value: Any, place: str, least: int, most: int = 2**31 - 1) -> Any:
    refuse_if(type(value) is not int or not least <= value <= most, f"{place}: expected an integer from {least} on")
    return value

def number(value: Any, place: str) -> Fraction:
    """Value of a JSON number in its own digits, or of a text "p/q" or of a decimal."""
    if type(value) is int:
        return Fraction(value)
    if isinstance(value, str) and len(value) <= MAX_DIGITS:
        if (match := QUOTIENT.fullmatch(value)) and int(match[2]):
            return Fraction(int(match[1]), int(match[2]))
        with contextlib.suppress(InvalidOperation):
            value = Decimal(value)
    if isinstance(value, Decimal) and value.is_finite():
        _, digits, exponent = value.as_tuple()
        if len(digits) + abs(int(exponent)) <= MAX_DIGITS:
            return Fraction(value)
    raise BadFileError(f'{place}: expected a number or "p/q", of at most {MAX_DIGITS} digits')

def numbers(value: Any, place: str, count: int) -> tuple[Fraction, ...]:
    return tuple(number(item, place) for item in items(value, place, count, count))

def read_point(value: Any, place: str) -> tuple[Fraction, Fraction]:
    x, y = numbers(value, place, 2)
    return x, y

def literals(value: Any, place: str, count: int) -> tuple[Fraction, ...]:
    """Numbers that are not in quotes."""
    refuse_if(any(isinstance(c, str) for c in items(value, place, count, count)), f"{place}: expected no text")
    return numbers(value, place, count)

# === Angles: tau = tan(theta / 2), a Fraction, or None for the half turn ===
# The formats define which rational an angle in radians or degrees stands for. Let k be the integer nearest to theta /
# (pi / 2), and r = theta - k pi / 2, which counts as 0 if it is at most an ulp of the double theta. Then tau is that of
# r, plus k right angles; that of r is the fraction of least denominator within 2^-53 t of the double t = tan(r / 2).

def coordinate(x: Fraction) -> str:
    """Write a coordinate with three decimals, or with six digits if these are more, and 16 at most."""
    before = math.floor(math.log10(abs(float(x)))) + 1 if float(x) else 0
    return f"{float(x):.{min(16, max(6, before + 3))}g}"

@dataclass
class Pose:
    """r = (x, y), and tau; that of a goal may be "any"."""

    x: Fraction
    y: Fraction
    tau: Any

    @property
    def rotation(self) -> tuple[Fraction, Fraction]:
        """Cosine and sine."""
        t = self.tau
        return (-ONE, ZERO) if t is None else ((1 - t * t) / (1 + t * t), 2 * t / (1 + t * t))

    def __str__(self) -> str:
        turn = "any" if self.tau == "any" else f"{math.degrees(float(angle_to(self.tau)) % math.tau):g} deg"
        return f"({coordinate(self.x)}, {coordinate(self.y)}, {turn})"

def tau_sum(one: Fraction | None, other: Fraction | None) -> Fraction | None:
    """Tangent of half the sum of two angles."""
    if one is None or other is None:
        finite = one if other is None else other
        return ZERO if finite is None else -1 / finite if finite else None
    return (one + other) / (1 - one * other) if one * other != 1 else None

@lru_cache(maxsize=1 << 12)
def angle_to(tau: Fraction | None) -> Fraction:
    """Angle 2 atan(tau), in (-pi, pi], with an error below 2^-1250: 8 halvings of the tangent, then its series."""
    if tau is None or abs(tau) > 1:
        return 2 * angle_to(ONE) if tau is None else sign(tau) * angle_to(None) - angle_to(1 / tau)
    unit = 1 << BITS
    x = tau.numerator * unit // tau.denominator
    for _ in range(8):
        x = x * unit // (unit + math.isqrt(unit * unit + x * x))
    total, power, k = 0, x, 1
    while abs(power) > 1:
        total, power, k = total + power // k, -(power * x // unit) * x // unit, k + 2
    return Fraction(total << 9, unit)

def turns_off(theta: Fraction, exact: Fraction) -> Fraction:
    """The distance of two angles but for whole turns."""
    circle = 2 * angle_to(None)
    return abs(theta - exact - circle * round((theta - exact) / circle))

def simplest_between(low: Fraction, high: Fraction) -> Fraction:
    """The fraction of least denominator in a closed interval."""
    if low <= 0 <= high:
        return Fraction(0)
    if high < 0:
        return -simplest_between(-high, -low)
    below = math.floor(low)
    if -math.floor(-low) <= high:
        return Fraction(-math.floor(-low))
    return below + 1 / simplest_between(1 / (high - below), 1 / (low - below))

def read_angle(value: Any, place: str) -> Fraction | None:
    """Tangent of half an angle: radians, "90deg", "90rad", or {"tau": "p/q"}; a text of over a turn needs its unit."""
    if isinstance(value, dict):
        return read_tau(members(value, place, tau=REQUIRED)["tau"], place)
    text = value.strip() if isinstance(value, str) else ""
    unit = next((unit for unit in ("deg", "\N{DEGREE SIGN}", "rad") if text.endswith(unit)), "")
    if unit in ("deg", "\N{DEGREE SIGN}"):
        degrees = number(text.removesuffix(unit), place)
        quarters = round(degrees / 90)
        rest = (degrees - 90 * quarters) / 180 * angle_to(None)
    else:
        radians = number(text.removesuffix(unit) if text else value, place)
        is_bare = text and not unit
        refuse_if(is_bare and abs(radians) > Fraction(math.tau), f"{place}: {text[:40]} needs a unit, deg or rad")
        try:
            ulp = math.ulp(float(radians))
        except OverflowError:
            raise BadFileError(f"{place}: the angle is too large") from None
        quarters = round(radians / angle_to(ONE))
        rest = radians - quarters * angle_to(ONE)
        rest = rest if abs(rest) > ulp else ZERO
    tangent = Fraction(math.tan(float(rest) / 2))
    margin = abs(tangent) / 2**53
    tau: Fraction | None = simplest_between(tangent - margin, tangent + margin)
    for _ in range(quarters % 4):
        tau = tau_sum(tau, ONE)
    return tau

def read_tau(value: Any, place: str) -> Fraction | None:
    return None if value in ("inf", "-inf", "1/0") and isinstance(value, str) else number(value, place)

def read_pose(value: Any, place: str, least: int = 3) -> Pose:
    x, y = numbers(items(value, place, least, 3)[:2], place, 2)
    refuse_if(max(abs(x), abs(y)) > LARGEST, f"{place}: a position beyond 1e150")
    return Pose(x, y, read_angle(value[2], place) if len(value) == 3 else "any")

# === Polygons ===
def cross(u: Point, v: Point) -> Any:
    return u[0] * v[1] - u[1] * v[0]

def dot(u: Point, v: Point) -> Any:
    return u[0] * v[0] + u[1] * v[1]

def minus(u: Any, v: Any) -> Point:
    return u[0] - v[0], u[1] - v[1]

def side(p: Any, q: Any, r: Any) -> int:
    """Side of the line from p to q: 1 if r is on its left, -1 if on its right, 0 if on it."""
    area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    return bool(area > 0) - bool(area < 0)

def edges_of(ring: Sequence[Any]) -> list[tuple[Any, Any]]:
    return list(zip(ring, [*ring[1:], ring[0]], strict=True))

class Polygon:
    """An outer ring, counter-clockwise, and holes, clockwise: the interior is on the left of every edge."""

    def __init__(self, outer: Ring, holes: Sequence[Ring], place: str) -> None:
        self.rings: list[Ring] = []
        for ring in (clean(ring, place) for ring in (outer, *holes)):
            is_left = sum(cross(p, q) for p, q in edges_of(ring)) > 0
            self.rings.append(ring if is_left == (not self.rings) else [ring[0], *ring[:0:-1]])
        self.unit = math.lcm(*(c.denominator for ring in self.rings for point in ring for c in point))
        refuse_if(self.unit.bit_length() > MAX_BITS, f"{place}: its common denominator is too long")
        check_rings(self.integers(self.unit), place)

    @property
    def words(self) -> list[str]:
        """Its rings in the text of a scene's hash."""
        return [" ".join(map(str, chain(*ring))) for ring in self.rings]

    @property
    def box(self) -> tuple[Fraction, ...]:
        xs, ys = zip(*self.rings[0], strict=True)
        return min(xs), min(ys), max(xs), max(ys)

    def integers(self, scale: int) -> list[Ring]:
        """Its rings times a multiple of all denominators."""
        return [scaled(ring, scale) for ring in self.rings]

def scaled(ring: Ring, scale: int) -> Ring:
    return [(x.numerator * (scale // x.denominator), y.numerator * (scale // y.denominator)) for x, y in ring]

def clean(points: Ring, place: str) -> Ring:
    """Drop the closing point, repeated ones, and those on a line with their neighbours."""
    points = points[: len(points) - (len(points) > 1 and points[0] == points[-1])]
    ring = [point for k, point in enumerate(points) if point != points[k - 1]]
    around = list(zip(ring[-1:] + ring[:-1], ring, ring[1:] + ring[:1], strict=True))
    corners = [q for p, q, r in around if side(p, q, r)]
    spikes = (side(p, q, r) == 0 > dot(minus(q, p), minus(r, q)) for p, q, r in around)
    refuse_if(len(points) < 3 or len(corners) < 3 or any(spikes), f"{place}: a ring without area, or with a spike")
    return corners

def check_rings(rings: list[Ring], place: str) -> None:
    """Rings must not cross themselves or each other; holes are in the outer ring, and in no other hole."""
    edges = sorted((min(e), max(e), k, i) for k, ring in enumerate(rings) for i, e in enumerate(edges_of(ring)))
    touching: dict[tuple[int, int], list[Point]] = defaultdict(list)  # points of other rings on an edge
    active: list[tuple[Point, Point, int, int]] = []
    for p, q, k, i in edges:
        active = [other for other in active if other[1][0] >= p[0]]
        for r, s, m, j in active:
            if k == m and abs(i - j) in (1, len(rings[k]) - 1):
                continue  # neighbours have one point in common, as they are not on one line
            common = common_points(p, q, r, s)
            if common is None or (common and k == m):
                raise BadFileError(f"{place}: edges that cross, overlap or touch")
            touching[k, i] += common
            touching[m, j] += common
        active.append((p, q, k, i))
    for p, q, k, i in edges if len(rings) > 1 else ():
        # rings may touch in points; between two of them an edge is on one side of all other rings
        for a, b in pairwise(sorted({p, q, *touching[k, i]})):
            middle = Fraction(a[0] + b[0]) / 2, Fraction(a[1] + b[1]) / 2
            for m, other in enumerate(rings):
                refuse_if(m != k and encloses([other], middle) != (k > 0 and m == 0), f"{place}: rings that cross")

def common_points(p: Point, q: Point, r: Point, s: Point) -> list[Point] | None:
    """Points in which two edges touch, p < q and r < s; None if they cross or overlap."""
    of_r, of_s, of_p, of_q = side(p, q, r), side(p, q, s), side(r, s, p), side(r, s, q)
    if of_r == of_s == 0:
        low, high = max(p, r), min(q, s)
        return None if low < high else [low] * (low == high)
    if of_r * of_s > 0 or of_p * of_q > 0:
        return []
    return [x for x, on in ((r, of_r), (s, of_s), (p, of_p), (q, of_q)) if on == 0] or None

def encloses(rings: Iterable[Ring], point: Point) -> bool:
    """True if a point that is on none of the rings is inside an odd number of them, by a ray towards +x."""
    inside = False
    for ring in rings:
        for p, q in edges_of(ring):
            if (p[1] > point[1]) != (q[1] > point[1]) and (side(p, q, point) > 0) == (q[1] > p[1]):
                inside = not inside
    return inside

def strictly_inside(inner: Polygon, outer: Polygon) -> bool:
    """True if all of one polygon, with its boundary, is in the interior of another. Their boundaries must not meet, the
    rings of the one must be inside the other, and no ring of the other, a hole, inside the one.
    """
    unit = math.lcm(inner.unit, outer.unit)
    one, other = inner.integers(unit), outer.integers(unit)
    edges = [[(min(e), max(e)) for ring in rings for e in edges_of(ring)] for rings in (one, other)]
    for p, q in edges[0]:
        if any(r[0] <= q[0] and p[0] <= s[0] and common_points(p, q, r, s) != [] for r, s in edges[1]):
            return False
    return all(encloses(other, ring[0]) for ring in one) and not any(encloses(one, ring[0]) for ring in other)

def is_near(point: Point, core: Ring, distance: Fraction) -> bool:
    """True if a point is nearer to a convex ring than a distance, or inside."""
    seen = [(minus(p, point), minus(q, p)) for p, q in edges_of(core)]
    feet = [(p, v, min(max(-dot(p, v) / dot(v, v), ZERO), ONE)) for p, v in seen]
    away = ((p[0] + share * v[0], p[1] + share * v[1]) for p, v, share in feet)
    return all(cross(p, v) >= 0 for p, v in seen) or any(dot(p, p) < distance**2 for p in away)

def is_convex(rings: list[Ring]) -> bool:
    """True if this is one ring, counter-clockwise, and all of its points are corners of their hull."""
    hull, ring = convex_hull(rings[0]), rings[0]
    first = ring.index(hull[0])
    return len(rings) == 1 and ring[first:] + ring[:first] == hull

def is_around_disc(ring: Ring, radius: Fraction) -> bool:
    """True if a ring is convex, with a disc about the origin inside."""
    sides = ((cross(p, q), minus(q, p)) for p, q in edges_of(ring))
    return is_convex([ring]) and all(h > 0 and h * h >= radius**2 * dot(u, u) for h, u in sides)

# === Round shapes: rings of segments and of arcs of circles ===
def root_sign(a: Fraction, *roots: tuple[int, Fraction]) -> int:
    """Sign of a + the sum of s sqrt(k) for all pairs (s, k), s = 1, 0 or -1.

    Over a common denominator all numbers are integers. The value and its conjugates, which have other signs of the n
    roots, are at most `most`, and their product is an integer. So if it is not 0, it is at least 1 / most^(2^n - 1).
    """
    roots = tuple((s, k) for s, k in roots if s and k)
    unit = math.lcm(a.denominator, *(k.denominator for _, k in roots))
    n, squares = int(a * unit), [(s, int(k * unit * unit)) for s, k in roots]
    most = abs(n) + sum(math.isqrt(k) + 1 for _, k in squares)
    bits, enough = 32, most.bit_length() * (2 ** len(squares) - 1) + 4
    while True:
        total = (n << bits) + sum(s * math.isqrt(k << 2 * bits) for s, k in squares)  # each off by less than 1
        if abs(total) >= max(1, len(squares)):
            return sign(total)
        if bits >= enough or not squares:
            return 0
        bits = min(8 * bits, enough)

class Edge:
    """A segment from p to q; or an arc of at most a right angle, counter-clockwise if turn is 1, clockwise if it is -1.

    Its rounds are circles: its beginning, with no radius, and that of the arc. Their radii are given squared.
    """

    def __init__(self, p: Point, q: Point, center: Point | None = None, turn: int = 0) -> None:
        self.p, self.q, self.center, self.turn, self.chord = p, q, center, turn, minus(q, p)
        self.corners, self.rounds = [p, q], [(p, ZERO)]
        if center is None:
            self.equation = 0, -self.chord[1], self.chord[0], cross(p, q)
        else:
            begin, end = minus(p, center), minus(q, center)
            self.square = dot(begin, begin)
            share = self.square / (self.square + dot(begin, end))  # to where both tangents meet
            self.corners.append((center[0] + share * (begin[0] + end[0]), center[1] + share * (begin[1] + end[1])))
            self.rounds.append((center, self.square))
            self.equation = 1, -2 * center[0], -2 * center[1], dot(center, center) - self.square
        (*xs,), (*ys,) = zip(*self.corners, strict=True)
        self.box = min(xs), min(ys), max(xs), max(ys)

    def moved(self, place: Fractions) -> Edge:
        """The edge after a rotation, by cosine and sine, and a translation."""
        x, y, c, s = place

        def there(p: Point) -> Point:
            return x + c * p[0] - s * p[1], y + s * p[0] + c * p[1]

        return Edge(there(self.p), there(self.q), self.center and there(self.center), self.turn)

    def is_near(self, other: Edge, gap: Fraction) -> bool:
        """True if boxes around them are no farther apart than a gap."""
        (a, b, c, d), (e, f, g, h) = self.box, other.box
        return bool(a <= g + gap and e <= c + gap and b <= h + gap and f <= d + gap)

    def points_to(self, v: Point) -> bool:
        """True if the arc has a point in this direction from its center: one on the outer side of its chord."""
        assert self.center
        a, b = cross(self.chord, minus(self.center, self.p)), cross(self.chord, v)
        return self.turn * root_sign(a, (sign(b), b * b * self.square / dot(v, v))) <= 0

    def stops_at(self, x: Fraction) -> bool:
        """True if the edge begins at this x, or its circle has a vertical tangent."""
        return x == self.p[0] or bool(self.center and self.square == (x - self.center[0]) ** 2)

    def heights(self, x: Fraction) -> list[tuple[Fraction, int, Fraction]]:
        """All (a, s, k) for which (x, a + s sqrt(k)) is on the edge; x is that of no end and of no vertical tangent."""
        (px, py), (qx, _), (u, v) = self.p, self.q, self.chord
        if self.center is None:
            return [(py + (x - px) * v / u, 0, ZERO)] if (px < x) != (qx < x) else []
        cy, k = self.center[1], self.square - (x - self.center[0]) ** 2
        a = u * (cy - py) - v * (x - px)
        up_and_down = (1, -1) if k > 0 else ()
        return [(cy, s, k) for s in up_and_down if self.turn * root_sign(a, (s * sign(u), u * u * k)) < 0]

    def common_points(self, other: Edge) -> list[tuple[Point, Point, Fraction]]:
        """All (p, v, k) for which p + v sqrt(k) is on both; of edges on one line or circle, ends alone."""
        if self.center is None and other.center:
            return other.common_points(self)
        (_, *first), (f, *second) = self.equation, other.equation
        if f:
            second = [a - b for a, b in zip(first, second, strict=True)]
        l, m, k = second
        places: list[tuple[Point, Point, Fraction]] = []
        if self.center:
            n, h = l * l + m * m, -(l * self.center[0] + m * self.center[1] + k)
            if n and (rest := self.square - h * h / n) >= 0:
                foot, along = (self.center[0] + h * l / n, self.center[1] + h * m / n), (-m, l)
                places = [(foot, (s * along[0], s * along[1]), rest / n) for s in ((1, -1) if rest else (1,))]
            on_one = not n and not k
        else:
            a, b, c = first
            d = a * m - b * l
            places = [((Fraction(b * k - c * m) / d, Fraction(c * l - a * k) / d), (ZERO, ZERO), ZERO)] if d else []
            on_one = not d and l * self.p[0] + m * self.p[1] + k == 0
        if on_one:
            places = [(p, (ZERO, ZERO), ZERO) for p in (self.p, self.q, other.p, other.q)]
        return [place for place in places if self.holds(*place) and other.holds(*place)]

    def holds(self, p: Point, v: Point, k: Fraction) -> bool:
        """True if p + v sqrt(k), a point of its line or circle, is on the edge."""
        def side_of(value: Any, other: Any) -> int:
            return root_sign(value, (sign(other), other * other * k))
        u, away = self.chord, minus(p, self.p)
        if self.center:
            return self.turn * side_of(cross(u, away), cross(u, v)) <= 0
        return side_of(dot(u, away), dot(u, v)) >= 0 >= side_of(dot(u, away) - dot(u, u), dot(u, v))

def meeting(one: Edge, other: Edge) -> list[Fraction]:
    """Polynomial in x, with a zero wherever two edges meet: without y, and in place of two circles one and a line."""
    if one.center is None and other.center:
        one, other = other, one
    (e, L, M, K), (f, l, m, k) = one.equation, other.equation
    if not e:
        return [K * m - M * k, L * m - M * l]
    if f:
        l, m, k = L - l, M - m, K - k
    return [k * k - M * m * k + K * m * m, 2 * l * k + L * m * m - M * m * l, m * m + l * l]

def whole_numbers(p: Sequence[Any]) -> Poly:
    """A polynomial, times its common denominator."""
    unit = math.lcm(*(c.denominator for c in p))
    return tuple(int(c * unit) for c in p)

def clear_line(edges: Sequence[Edge], ring: Sequence[Edge]) -> Fraction:
    """Some x on which a ring has points, and no edge begins or has a vertical tangent."""
    low, high, parts = min(edge.box[0] for edge in ring), max(edge.box[2] for edge in ring), 1
    while True:
        parts *= 2
        for x in (low + (high - low) * Fraction(k, parts) for k in range(1, parts, 2)):
            if not any(edge.stops_at(x) for edge in edges) and any(edge.heights(x) for edge in ring):
                return Fraction(x)

def stops(edges: Iterable[Edge]) -> Iterator[Poly]:
    """Yield polynomials in x with zeros at all ends and vertical tangents."""
    for edge in edges:
        yield whole_numbers([-edge.p[0], ONE])
        if edge.center:
            yield whole_numbers([edge.center[0] ** 2 - edge.square, -2 * edge.center[0], ONE])

@dataclass
class Region:
    """All that rings go around an odd number of times, an even number if `outside`; and what is nearer than `grown`."""

    rings: Sequence[Sequence[Edge]]
    grown: Fraction = ZERO
    outside: bool = False

    def __post_init__(self) -> None:
        self.edges = list(chain.from_iterable(self.rings))
        boxes = [edge.box for edge in self.edges]
        self.box = tuple(f(box[k] for box in boxes) for k, f in enumerate((min, min, max, max)))

    def moved(self, place: Fractions) -> Region:
        return Region([[edge.moved(place) for edge in ring] for ring in self.rings], self.grown)

def differ(p: Point, v: Point, k: Fraction, q: Point) -> bool:
    """True if p + v sqrt(k) is another point than q."""
    return any(root_sign(a - b, (sign(c), c * c * k)) for a, b, c in zip(p, q, v, strict=True))

class Round:
    """A round shape of a scene. Its rings are named by the ends of their edges."""

    def __init__(self, curves: Sequence[tuple[str, list[Edge]]], grown: Fraction, place: str) -> None:
        self.words, self.edges, self.grown = [words for words, _ in curves], [edges for _, edges in curves], grown
        self.rings = [[edge.p for edge in edges] for edges in self.edges]
        numbers = [c for edges in self.edges for e in edges for p in (e.p, e.center) if p for c in p]
        self.unit = math.lcm(grown.denominator, *(c.denominator for c in numbers))
        refuse_if(self.unit.bit_length() > MAX_BITS, f"{place}: its common denominator is too long")
        refuse_if(not all(self.edges), f"{place}: a ring without edges")
        every = list(chain.from_iterable(self.edges))
        for i, edge in enumerate(every):
            for other in every[:i]:
                joints = [a.q for a, b in ((edge, other), (other, edge)) if a.q == b.p]
                touched = edge.common_points(other) if edge.is_near(other, ZERO) else []
                folded = len(joints) == 2 and (edge.center, other.center) in ((None, None), (edge.center, edge.center))
                wrong = folded or any(all(differ(*place, q) for q in joints) for place in touched)
                refuse_if(wrong, f"{place}: edges that cross, overlap or touch")
        for k, hole in enumerate(self.edges[1:], 1):
            x = clear_line(every, hole)
            a, s, r = next(height for edge in hole for height in edge.heights(x))
            for m, ring in enumerate(self.edges):
                below = sum(root_sign(a - b, (s, r), (-t, q)) > 0 for edge in ring for b, t, q in edge.heights(x))
                refuse_if(m != k and below % 2 != (m == 0), f"{place}: a hole outside, or in another")

    @property
    def box(self) -> list[Fraction]:
        """Box around the outer ring, and its growth (docs/answer-format.md, "Round shapes")."""
        return [s * (extreme(self.edges[0], k, s) + self.grown) for s in (-1, 1) for k in (0, 1)]

def extreme(edges: Sequence[Edge], axis: int, s: int) -> Fraction:
    """The greatest coordinate on an axis, or that of its negative; where it is a square root, rounded up."""
    greatest = max(s * edge.p[axis] for edge in edges)
    for edge in edges:
        if edge.center:
            way = (Fraction(s), ZERO) if axis == 0 else (ZERO, Fraction(s))
            begin, end = minus(edge.p, edge.center), minus(edge.q, edge.center)
            if edge.turn * cross(begin, way) > 0 < edge.turn * cross(way, end):
                n, d = edge.square.as_integer_ratio()
                root = Fraction(math.isqrt(n), math.isqrt(d))
                scale = 1 << 2 * (60 + max(0, d.bit_length() - n.bit_length()))
                above = Fraction(math.isqrt(n * scale // d) + 1, math.isqrt(scale))
                greatest = max(greatest, s * edge.center[axis] + (root if root * root == edge.square else above))
    return Fraction(greatest)

def read_round(value: dict[str, Any], place: str, **more: Any) -> Round:
    got = members(value, place, circle=None, ellipse=None, path=None, outer=None, holes=[], grown=None, **more)
    grown = ZERO if got["grown"] is None else number(got["grown"], f"{place}.grown")
    refuse_if(grown < 0, f"{place}.grown: expected a length")
    outer = {key: got[key] for key in ("circle", "ellipse", "path", "outer") if got[key] is not None}
    curves = [read_curve(ring, place, "outer") for ring in [outer]]
    curves += [read_curve(ring, place) for ring in items(got["holes"], f"{place}.holes")]
    straight = all(edge.center is None for _, edges in curves for edge in edges)
    refuse_if(grown and not straight, f"{place}.grown: expected a polygon")
    return Round(curves, grown, place)

def read_curve(value: Any, place: str, *more: str) -> tuple[str, list[Edge]]:
    """A ring in the words of docs/answer-format.md, "Round shapes", and its edges."""
    known = dict.fromkeys(("circle", "ellipse", "path", *more))
    got = members({"path": value} if isinstance(value, list) else value, place, **known)
    refuse_if(sum(member is not None for member in got.values()) != 1, f"{place}: expected one of circle, path")
    refuse_if(got["ellipse"] is not None, f"{place}: an ellipse; `cfree verify` reads it")
    if got["circle"] is not None:
        circle = members(got["circle"], place, center=REQUIRED, radius=REQUIRED)
        (x, y), radius = read_point(circle["center"], place), number(circle["radius"], place)
        refuse_if(radius <= 0, f"{place}: expected a radius above 0")
        return arc((x + radius, y), (x + radius, y), (x, y), (ZERO, radius), place)
    path = items(got["outer"] if got["path"] is None else got["path"], place, 1)
    refuse_if(got["path"] is None and not all(isinstance(p, list) for p in path), f"{place}.outer: expected points")
    pieces: list[tuple[str, list[Edge]]] = []
    begin = end = read_point(path[0], place)
    for item in path[1:]:
        if isinstance(item, dict):
            pieces.append(read_arc(end, item, place))
            end = pieces[-1][1][-1].q
        else:
            begun, end = end, read_point(item, place)
            pieces += [line(begun, end)] if begun != end else []
    pieces += [line(end, begin)] if begin != end else []
    return " ".join(words for words, _ in pieces), [edge for _, edges in pieces for edge in edges]

def line(p: Point, q: Point) -> tuple[str, list[Edge]]:
    return f"line {q[0]} {q[1]}", [Edge(p, q)]

def read_arc(p: Point, value: Any, place: str) -> tuple[str, list[Edge]]:
    """An arc that begins in p."""
    segment = members(value, place, arc=None, bezier=None, spline=None)
    for key, name in {"bezier": "a Bezier curve", "spline": "a spline"}.items():
        refuse_if(segment[key] is not None, f"{place}: {name}; `cfree verify` reads it")
    optional = dict.fromkeys(("through", "center", "conjugate"))
    got = members(segment["arc"], f"{place}.arc", to=REQUIRED, clockwise=False, **optional)
    q, clockwise = read_point(got["to"], place), one_of(got["clockwise"], f"{place}.clockwise", False, True)
    refuse_if((got["through"] is None) == (got["center"] is None), f"{place}: expected one of through, center")
    if got["through"] is None:
        center = read_point(got["center"], place)
    else:
        refuse_if(clockwise or got["conjugate"] is not None, f"{place}: clockwise, conjugate: of arcs about a center")
        center, left = circle_through(p, read_point(got["through"], place), q, place)
        clockwise = left < 0
    u = minus(p, center)
    v = (-u[1], u[0]) if got["conjugate"] is None else read_point(got["conjugate"], place)
    against = got["conjugate"] is not None and cross(u, v) < 0
    return arc(p, q, center, v if clockwise == against else (-v[0], -v[1]), place)

def arc(p: Point, q: Point, center: Any, v: Point, place: str) -> tuple[str, list[Edge]]:
    """The arc from p to q on center + u cos t + v sin t: right angles, and the rest. From p to p it is a whole turn."""
    u, end = minus(p, center), minus(q, center)
    is_circular = dot(u, v) == 0 and dot(u, u) == dot(v, v)
    refuse_if(not is_circular, f"{place}: an arc of an ellipse; `cfree verify` reads it")
    turn, square, begin, points = sign(cross(u, v)), dot(u, u), u, [p]
    refuse_if(not turn or dot(end, end) != square, f"{place}: an arc whose end is not on it")
    while (p == q and len(points) < 5) or dot(begin, end) <= 0 or turn * cross(begin, end) < 0:
        begin = -turn * begin[1], turn * begin[0]
        points.append((center[0] + begin[0], center[1] + begin[1]))
    rest = turn * cross(begin, end) / (square + dot(begin, end))
    words = " ".join(map(str, ["arc", *center, *u, *v, len(points) - 1, rest]))
    return words, [Edge(a, b, center, turn) for a, b in pairwise(points + [q] * (rest != 0))]

def circle_through(p: Point, q: Point, r: Point, place: str) -> tuple[Point, Fraction]:
    """The center, and above 0 if the circle is counter-clockwise."""
    u, v = minus(q, p), minus(r, p)
    left = cross(u, v)
    refuse_if(left == 0, f"{place}: three points of an arc on one line")
    a, b = dot(u, u) / (2 * left), dot(v, v) / (2 * left)
    return (p[0] + a * v[1] - b * u[1], p[1] + b * u[0] - a * v[0]), left

# === Scenes ===
class Scene:
    """A robot of polygons, obstacles, perhaps a workspace, bounds, start and goal."""

    def __init__(
        self, robot: list[Any], obstacles: list[Any], workspace: Any, bounds: Fractions | None
    ) -> None:  # all shapes are a Polygon or a Round
        self.robot, self.obstacles, self.workspace, self.bounds = robot, obstacles, workspace, bounds
        self.asked: dict[str, list[Pose]] = {}  # any one of them
        polygons = [*robot, *obstacles, *filter(None, [workspace])]
        self.is_round = any(isinstance(polygon, Round) for polygon in polygons)
        self.scale = math.lcm(*(p.unit for p in polygons), *(b.denominator for b in bounds or ()))
        coordinates = [c for p in polygons for ring in p.rings for point in ring for c in point]
        largest = max(abs(c) for c in (*coordinates, *(bounds or ())))
        if largest > LARGEST or max(self.scale, int(largest * self.scale)).bit_length() > MAX_BITS:
            raise BadFileError("a coordinate is larger than 1e150, or the scene's have too long a common denominator")

    @property
    def box(self) -> tuple[Fraction, ...]:
        """Box around the robot, in its frame."""
        boxes = [part.box for part in self.robot]
        return tuple(f(box[k] for box in boxes) for k, f in enumerate((min, min, max, max)))

    @property
    def sha256(self) -> str:
        """Hash of all that decides whether a pose is free (docs/answer-format.md, "The scene")."""
        lines = ["cfree scene 1"]
        kinds = ("robot", self.robot), ("obstacle", self.obstacles), ("workspace", filter(None, [self.workspace]))
        for word, polygon in ((word, polygon) for word, polygons in kinds for polygon in polygons):
            lines.append(word)
            lines += [f"{'hole' if k else 'outer'} {ring}" for k, ring in enumerate(polygon.words)]
            lines += [f"grown {polygon.grown}"] if isinstance(polygon, Round) and polygon.grown else []
        lines += [f"bounds {' '.join(map(str, self.bounds))}"] if self.bounds else []
        return hashlib.sha256("".join(f"{line}\n" for line in lines).encode("ascii")).hexdigest()

def read_scene(data: Any) -> Scene:
    refuse_if(isinstance(data, dict) and "type" in data, "GeoJSON is not read here; save the scene as a JSON scene")
    optional = dict.fromkeys(("workspace", "bounds", "start", "goal", "name", "note", "units", "source", "check"))
    optional |= dict.fromkeys(("vehicle", "reading", "changed", "dropped"))
    got = members(data, "scene", version=1, robot=REQUIRED, obstacles=[], goals=[], **optional)
    one_of(got["version"], "version", 1)
    robot, obstacles = ([each] if is_ring(each) else each for each in (got["robot"], got["obstacles"]))
    robot = [robot] if isinstance(robot, dict) else items(robot, "robot", 1)
    scene = Scene(
        [read_shape(part, f"robot[{k}]") for k, part in enumerate(robot)],
        [read_shape(o, f"obstacles[{k}]", name=None) for k, o in enumerate(items(obstacles, "obstacles"))],
        None if got["workspace"] is None else read_shape(got["workspace"], "workspace"),
        None if got["bounds"] is None else read_bounds(got["bounds"], "bounds"),
    )
    refuse_if(getattr(scene.workspace, "grown", 0), "workspace: expected the ring of its lines and arcs, not grown")
    refuse_if(got["goal"] is not None and bool(got["goals"]), "goals: there is a goal, too")
    if got["vehicle"] is not None:
        Vehicle(got["vehicle"])
    scene.asked["start"] = [read_pose(value, "start") for value in [got["start"]] if value is not None]
    goals = items(got["goals"], "goals") or [goal for goal in [got["goal"]] if goal is not None]
    scene.asked["goal"] = [read_pose(goal, "goal", 2) for goal in goals]
    return scene

def is_ring(value: Any) -> bool:
    """True if a list begins with a point: a polygon without holes may be written as its ring alone."""
    first = value[0] if isinstance(value, list) and value else None
    return isinstance(first, list) and bool(first) and not isinstance(first[0], (list, dict))

def read_shape(value: Any, place: str, **more: Any) -> Polygon | Round:
    is_round = isinstance(value, dict) and value.keys() & ROUND
    return (read_round if is_round else read_polygon)(value, place, **more)

def read_polygon(value: Any, place: str, **more: Any) -> Polygon:
    got = members({"outer": value} if is_ring(value) else value, place, outer=REQUIRED, holes=[], **more)
    rings = [got["outer"], *items(got["holes"], f"{place}.holes")]
    read: list[Any] = [[numbers(point, place, 2) for point in items(ring, place)] for ring in rings]
    return Polygon(read[0], read[1:], place)

def read_bounds(value: Any, place: str) -> tuple[Fraction, ...]:
    x0, y0, x1, y1 = bounds = numbers(value, place, 4)
    refuse_if(x0 >= x1 or y0 >= y1, f"{place}: they are empty")
    return bounds

# === Vehicles ===
class Vehicle:
    """A car or a differential drive: radii to the left and right, axle point and heading in the robot's frame."""

    def __init__(self, value: Any) -> None:
        place = "vehicle"
        kind = one_of(value.get("type") if isinstance(value, dict) else None, f"{place}.type", "car", "differential")
        car = {"turning_radius": REQUIRED, "gears": "both", "wheelbase": 1} if kind == "car" else {}
        got = members(value, place, type=kind, axle=[0, 0], heading=0, **car)
        self.turns_in_place, self.radii = kind != "car", (ZERO, ZERO)
        if kind == "car":
            radius = got["turning_radius"]
            sides = radius if isinstance(radius, list) else [radius, radius]
            self.radii = numbers(items(sides, place, 2, 2), place, 2)  # type: ignore[assignment]
            refuse_if(min(self.radii) <= 0, f"{place}: expected a turning radius above 0")
            refuse_if(number(got["wheelbase"], place) <= 0, f"{place}: expected a wheelbase above 0")
        self.forward_only = one_of(got.get("gears", "both"), f"{place}.gears", "both", "forward") == "forward"
        self.axle, self.heading = numbers(got["axle"], place, 2), read_angle(got["heading"], place)
        left, right = (f"{float(radius):.6g}" for radius in self.radii)
        radii = f"a turning radius of {left}" if left == right else f"turning radii of {left} and {right}"
        car_text = f"a car with {radii}" + " and no reverse gear" * self.forward_only
        self.text = "a differential drive" if self.turns_in_place else car_text

    def axle_at(self, pose: Pose) -> Pose:
        """Pose of the axle, forward its x axis."""
        (c, s), (x, y) = pose.rotation, self.axle
        return Pose(pose.x + c * x - s * y, pose.y + s * x + c * y, tau_sum(pose.tau, self.heading))

    def fault(self, pose: Pose, motion: Motion) -> str:
        """Text if it cannot do a motion from a pose."""
        if motion.slide:
            return "it is a slide, which no vehicle drives"
        axle = self.axle_at(pose)
        c, s = axle.rotation
        if not motion.pole:
            x, y = motion.vector
            if x * s != y * c:
                return "its vector is not along forward"
            return "it goes back" * (self.forward_only and x * c + y * s < 0)
        if motion.tau == 0:
            return ""
        x, y = motion.pole[0] - axle.x, motion.pole[1] - axle.y
        if x * c + y * s != 0:
            return "its pole is off the axle line"
        left = c * y - s * x
        if not self.turns_in_place and abs(left) < self.radii[left < 0]:
            return "its radius is less than the turning radius"
        return "it goes back" * (self.forward_only and (left < 0) != motion.clockwise and left != 0)

# === Polynomials with integer coefficients, and their roots ===
def sign(value: Any) -> int:
    return bool(value > 0) - bool(value < 0)

def trimmed(p: Sequence[int]) -> Poly:
    """Polynomial without leading zeros; () is the zero polynomial."""
    return tuple(p[: max((k + 1 for k, c in enumerate(p) if c), default=0)])

def primitive(p: Sequence[int]) -> Poly:
    """Polynomial divided by its content; the leading coefficient is positive."""
    p = trimmed(p)
    content = math.gcd(*p) * sign(p[-1]) if p else 1
    return tuple(c // content for c in p)

def times(p: Sequence[Any], q: Sequence[Any]) -> tuple[Any, ...]:
    if not p or not q:
        return ()
    product = [0] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            product[i + j] += a * b
    return tuple(product)

def combined(factors: Sequence[int], *polys: Sequence[int]) -> Poly:
    """The sum of polynomials, each times a number."""
    return tuple([sum(map(mul, factors, column)) for column in zip_longest(*polys, fillvalue=0)])

def value(p: Sequence[int], x: Fraction) -> Fraction:
    return Fraction(*value_over(p, x))

def value_over(p: Sequence[int], x: Fraction) -> tuple[int, int]:
    """Numerator and denominator, positive and not reduced, of p(x)."""
    n, d = x.numerator, x.denominator
    total, power = 0, 1
    for k, c in enumerate(reversed(p)):
        power = power * d if k else 1
        total = total * n + c * power
    return total, power

def sign_at(p: Sequence[int], x: Fraction) -> int:
    return sign(value_over(p, x)[0])

def derivative(p: Poly) -> Poly:
    return tuple(k * c for k, c in enumerate(p))[1:]

@lru_cache(maxsize=1 << 14)
def common_divisor(p: Poly, q: Poly) -> Poly:
    """Greatest common divisor, primitive: Euclid's algorithm with pseudo-remainders."""
    p, q = primitive(p), primitive(q)
    while q:
        while len(p) >= len(q):
            p = primitive(combined((q[-1], -p[-1]), p, [0] * (len(p) - len(q)) + [*q]))
        p, q = q, p
    return p

def quotient(p: Poly, q: Poly) -> Poly:
    """p / q for a primitive q that divides p."""
    p, digits = trimmed(p), []
    while len(p) >= len(q):
        digits.append(p[-1] // q[-1])
        p = combined((1, -digits[-1]), p, [0] * (len(p) - len(q)) + [*q])[:-1]
    assert not any(p)
    return tuple(reversed(digits))

@lru_cache(maxsize=1 << 14)
def squarefree(p: Poly) -> Poly:
    """Polynomial with the same roots, each of them simple."""
    p = primitive(p)
    return quotient(p, common_divisor(p, derivative(p))) if len(p) > 2 else p

@lru_cache(maxsize=1 << 12)
def mapping(degree: int, lo: Fraction, hi: Fraction) -> list[list[int]]:
    """Rows that give the coefficients in s of (1 + s)^degree p((lo + hi s) / (1 + s)), times a positive number."""
    n = math.lcm(lo.denominator, hi.denominator)
    a, b = int(lo * n), int(hi * n)
    columns = []
    for k in range(degree + 1):
        p: Poly = (n ** (degree - k),)
        for factor in [(a, b)] * k + [(1, 1)] * (degree - k):
            p = times(p, factor)
        columns.append(p)
    return [list(row) for row in zip(*columns, strict=True)]

def mapped(p: Sequence[int], interval: Interval) -> list[int]:
    """Coefficients of p in s, 0 <= s <= oo from one end of an interval to the other.

    If all are positive, so is p there; the number of their changes of sign bounds that of its roots (Descartes).
    """
    return [sum(map(mul, row, p)) for row in mapping(len(p) - 1, *interval)]

class Root:
    """A real algebraic number: the only root of a squarefree polynomial in [lo, hi].

    Either lo = hi, or the polynomial has different signs, and not 0, at lo and hi.
    """

    def __init__(self, poly: Poly, lo: Fraction, hi: Fraction) -> None:
        self.poly, self.lo, self.hi, self.before = poly, lo, hi, sign_at(poly, lo)

    @classmethod
    def rational(cls, x: Fraction) -> Root:
        return cls((-x.numerator, x.denominator), x, x)

    def narrow(self) -> None:
        """Halve the interval."""
        if self.lo < self.hi:
            middle = (self.lo + self.hi) / 2
            here = sign_at(self.poly, middle)
            if here == 0:
                self.poly = -middle.numerator, middle.denominator
            self.lo = self.lo if here == -self.before else middle
            self.hi = self.hi if here == self.before else middle

    def sign(self, p: Poly) -> int:
        """Sign of another polynomial at this number."""
        while self.lo < self.hi:
            mapped_poly = mapped(p, (self.lo, self.hi)) if p else [0]
            if min(mapped_poly) > 0 or max(mapped_poly) < 0:
                return sign(mapped_poly[0])
            g = common_divisor(self.poly, trimmed(p))  # it has no root in the interval but this one
            if sign_at(g, self.lo) != sign_at(g, self.hi):
                return 0
            self.narrow()
        return sign_at(p, self.lo)

    def is_change(self, p: Poly) -> bool:
        """True if a polynomial changes its sign here: this is a root an odd number of times."""
        return self.sign(p) == 0 and not self.is_change(derivative(p))

    def compared(self, other: Root) -> int:
        """-1 if less, 0 if equal, 1 if greater than another number."""
        for _ in range(24):
            if self.hi < other.lo or other.hi < self.lo or self.lo == self.hi == other.lo == other.hi:
                return sign(self.lo - other.lo)
            self.narrow()
            other.narrow()
        if self.lo <= other.hi and other.lo <= self.hi:
            # equality: this is the only root of the other's polynomial between other.lo and other.hi
            low, high = (self.sign((-end.numerator, end.denominator)) for end in (other.lo, other.hi))
            if low >= 0 >= high and self.sign(other.poly) == 0:
                return 0
        while self.lo <= other.hi and other.lo <= self.hi:
            self.narrow()
            other.narrow()
        return -1 if self.hi < other.lo else 1

def roots_in(p: Poly, lo: Fraction, hi: Fraction) -> list[Root]:
    """All roots in a closed interval, each once, in order. Halved until Descartes' rule allows none or one."""
    isolated, rational, todo = [], set(), [(squarefree(p), lo, hi)]
    while todo:
        q, lo, hi = todo.pop()
        for end in {lo, hi}:
            if sign_at(q, end) == 0:  # divided out, so that ends are no roots
                rational.add(end)
                q = quotient(q, (-end.numerator, end.denominator))
        signs = [c > 0 for c in mapped(q, (lo, hi)) if c] if lo < hi else []
        count = sum(a != b for a, b in pairwise(signs))
        if count == 1:
            isolated.append(Root(q, lo, hi))
        elif count:
            middle = (lo + hi) / 2
            todo += [(q, lo, middle), (q, middle, hi)]
    return sorted([*isolated, *map(Root.rational, rational)], key=lambda root: (root.lo, root.hi))

def ordered(roots: Iterable[Root]) -> list[list[Root]]:
    """Roots in order, equal ones together."""
    groups: list[list[Root]] = []
    for root in sorted(roots, key=cmp_to_key(Root.compared)):
        if groups and groups[-1][0].compared(root) == 0:
            groups[-1].append(root)
        else:
            groups.append([root])
    return groups

def between(lo: Fraction, hi: Fraction) -> Fraction:
    """A dyadic number of few digits strictly between two."""
    power = 1
    while (n := math.floor(lo * power) + 1) >= hi * power:
        power *= 2
    return Fraction(n, power)

def samples(polys: Iterable[Poly], lo: Fraction, hi: Fraction) -> Iterator[Fraction]:
    """One number between any two neighbouring roots of all the polynomials in an interval, and its ends."""
    roots = [root for p in set(map(primitive, polys)) if len(p) > 1 for root in roots_in(p, lo, hi)]
    for (one, *_), (other, *_) in pairwise(ordered([*roots, Root.rational(lo), Root.rational(hi)])):
        one.compared(other)  # narrows both until they are apart
        yield between(one.hi, other.lo)


ALL = ZERO, ONE  # all of a motion: from u = 0 to u = 1

def is_nowhere_positive(p: Sequence[int], interval: Interval) -> bool:
    """True if a polynomial is certainly positive nowhere in an interval; False may be wrong."""
    return all(sum(map(mul, row, p)) <= 0 for row in mapping(len(p) - 1, *interval))

def positive_place(p: Poly) -> Fraction | None:
    """Some u from 0 to 1 at which p is positive, if there is one."""
    if is_nowhere_positive(p, ALL):
        return None
    return next((u for u in samples([p], *ALL) if sign_at(p, u) > 0), None)

# === Convex pieces ===
class Piece:
    """A convex polygon: counter-clockwise corners (x, y, z), which stand for (x / z, y / z), and lines (l, m, k)
    through them. On their left, where the piece is, l x + m y + k z > 0.
    """

    def __init__(self, points: Ring) -> None:
        self.points = points
        self.corners = []
        for x, y in points:
            z = math.lcm(x.denominator, y.denominator)
            self.corners.append((int(x * z), int(y * z), z))
        self.lines = []
        for (a, b, c), (d, e, f) in edges_of(self.corners):
            line = b * f - c * e, c * d - a * f, a * e - b * d
            unit = math.gcd(*line)
            self.lines.append(tuple(part // unit for part in line))

def convex_pieces(rings: list[Ring]) -> list[Piece]:
    """Trapezoids between the vertical lines through all vertices, put together where the same edges bound them.

    Between two neighbouring lines edges do not cross, so they have an order; every other gap between them is inside.
    """
    if len(rings) == 1 and len(convex_hull(rings[0])) == len(rings[0]):
        return [Piece(rings[0])]
    edges = [(min(p, q), max(p, q)) for ring in rings for p, q in edges_of(ring) if p[0] != q[0]]
    stops = sorted({p[0] for ring in rings for p in ring})
    open_ones: dict[Any, int] = {}  # pairs of edges with space between them, and where it begins
    pieces = []
    for left, right in [*pairwise(stops), (stops[-1], None)]:
        here = [] if right is None else [e for e in edges if e[0][0] <= left and right <= e[1][0]]
        here.sort(key=lambda e: height(e, left) + height(e, right))
        gaps = set(zip(here[::2], here[1::2], strict=True))
        for lower, upper in [gap for gap in open_ones if gap not in gaps]:
            begin = open_ones.pop((lower, upper))
            ring = [(x, height(e, x)) for e, x in ((lower, begin), (lower, left), (upper, left), (upper, begin))]
            pieces.append(Piece([point for k, point in enumerate(ring) if point != ring[k - 1]]))
        for gap in gaps:
            open_ones.setdefault(gap, left)
    return pieces

def height(edge: tuple[Point, Point], x: Any) -> Fraction:
    """Height y of an edge at an x."""
    (a, b), (c, d) = edge
    return Fraction(b * (c - a) + (d - b) * (x - a), c - a)

def convex_hull(points: Iterable[Point]) -> Ring:
    """Convex hull, counter-clockwise, from the leftmost point on."""
    ordered = sorted(set(points))
    half = []
    for run in (ordered, ordered[::-1]):
        turned: list[Point] = []
        for r in run:
            while len(turned) > 1 and side(turned[-2], turned[-1], r) <= 0:
                turned.pop()
            turned.append(r)
        half.append(turned[:-1])
    return half[0] + half[1]

class World:
    """Convex pieces of a scene's robot and obstacles, in coordinates of its own: the scene's times `scale`.

    The outside of the workspace is the outside of its box, and the part of the box outside the workspace.
    """

    def __init__(self, scene: Scene) -> None:
        self.scale = scene.scale
        self.robot = [piece for part in scene.robot for piece in convex_pieces(part.integers(self.scale))]
        self.walls = [piece for part in scene.obstacles for piece in convex_pieces(part.integers(self.scale))]
        self.bounds = [b * self.scale for b in scene.bounds or ()]  # of the reference point
        self.box: list[int] = []  # of all of the robot
        if scene.workspace:
            outer, *holes = scene.workspace.integers(self.scale)
            (x0, *_, x1), (y0, *_, y1) = (sorted(c) for c in zip(*outer, strict=True))
            self.box = [x0, y0, x1, y1]
            around = [(x0 - 1, y0 - 1), (x1 + 1, y0 - 1), (x1 + 1, y1 + 1), (x0 - 1, y1 + 1)]
            self.walls += convex_pieces([around, outer])
            self.walls += [piece for hole in holes for piece in convex_pieces([hole])]
        self.boxes = [box_around(piece.corners) for piece in self.walls]

    def larger(self, ring: Ring) -> World:
        """World of a robot larger by a convex polygon, in its own frame."""
        world, moves = copy(self), [(x * self.scale, y * self.scale) for x, y in ring]
        world.robot = [
            Piece(convex_hull((x + dx, y + dy) for x, y in piece.points for dx, dy in moves)) for piece in self.robot
        ]
        return world

    def roomier(self, leeway: Fraction) -> World:
        """World of a robot larger by the square [-leeway, leeway]^2, within bounds smaller by leeway on every side."""
        by = leeway * self.scale
        world = self.larger([(-leeway, -leeway), (leeway, -leeway), (leeway, leeway), (-leeway, leeway)])
        world.bounds = [b + (by if k < 2 else -by) for k, b in enumerate(self.bounds)]
        if self.bounds and (world.bounds[0] >= world.bounds[2] or world.bounds[1] >= world.bounds[3]):
            raise RefutedError("its decimals are not free, as it claims: of smaller bounds nothing would be left")
        return world

def box_around(points: Iterable[Any]) -> tuple[int, int, int, int]:
    """Box of points (x, y, z), larger by less than 1 / 1024."""
    xs, ys, zs = zip(*points, strict=True)
    low = [min(1024 * c // z for c, z in zip(axis, zs, strict=True)) for axis in (xs, ys)]
    high = [-min(-1024 * c // z for c, z in zip(axis, zs, strict=True)) for axis in (xs, ys)]
    return low[0], low[1], high[0], high[1]

# === Motions ===
class Course:
    """A motion as polynomials in u, 0 <= u <= 1. A point (a, b) of the robot is at ((X + C a - S b) / W,
    (Y + S a + C b) / W), W > 0. These are in `moving`; `back` has those for points of the world in the robot's frame.
    """

    def __init__(self, *polynomials: Fractions) -> None:
        unit = math.lcm(*(c.denominator for p in polynomials for c in p))
        polys = [[int(c * unit) for c in p] for p in polynomials]
        content = math.gcd(*(c for p in polys for c in p))
        W, C, S, X, Y = self.moving = padded([tuple(c // content for c in p) for p in polys])
        turned = combined((-1, -1), times(C, X), times(S, Y)), combined((1, -1), times(S, X), times(C, Y))
        self.back = padded([times(W, W), times(C, W), combined((-1,), times(S, W)), *turned])

def padded(polys: Sequence[Poly]) -> list[Poly]:
    """Polynomials of one length, padded with zeros."""
    length = max(len(trimmed(p)) for p in polys)
    return [(*p, *[0] * length)[:length] for p in polys]

@dataclass
class Motion:
    """A translation by a vector; a rotation about a pole, by at most half a turn; or a slide.

    In the parameter u the reference point moves by (x(u), y(u)) / d(u), and the robot turns by 2 atan(u tau). Half a
    turn has no tau: it is None. So `parts` divides rotations by more than a right angle.
    """

    vector: Fractions = ()
    pole: Fractions = ()
    tau: Fraction | None = ZERO
    clockwise: bool = False
    slide: Sequence[Fractions] = ()
    contacts: Sequence[Any] = ()

    @property
    def angle(self) -> Fraction:
        """Angle by which it turns, with an error below 2^-1250."""
        return -angle_to(None) if self.tau is None and self.clockwise else angle_to(self.tau)

    @property
    def parts(self) -> list[Motion]:
        if not self.pole or (self.tau is not None and abs(self.tau) <= 1):
            return [self]
        right = Fraction(-1 if self.clockwise else 1)
        return [Motion(pole=self.pole, tau=tau) for tau in (right, tau_sum(self.tau, -right))]

    def moved(self, pose: Pose) -> Sequence[Fractions]:
        """Polynomials x, y and d, for one part."""
        if self.pole:
            t, rx, ry = self.tau, pose.x - self.pole[0], pose.y - self.pole[1]
            assert t is not None
            return [ZERO, -2 * t * ry, -2 * t * t * rx], [ZERO, 2 * t * rx, -2 * t * t * ry], [ONE, ZERO, t * t]
        if self.slide:
            return self.slide
        return [ZERO, self.vector[0]], [ZERO, self.vector[1]], [ONE]

    def end(self, pose: Pose) -> Pose:
        for part in self.parts:
            x, y, d = (sum(p, ZERO) for p in part.moved(pose))
            pose = Pose(pose.x + x / d, pose.y + y / d, tau_sum(pose.tau, part.tau))
        return pose

    def courses(self, pose: Pose, scale: int) -> Iterator[Course]:
        """Courses of all parts."""
        for part in self.parts:
            t, (c, s) = part.tau, pose.rotation
            assert t is not None
            x, y, d = part.moved(pose)
            X = [scale * (pose.x * f + g) for f, g in zip_longest(d, x, fillvalue=ZERO)]
            Y = [scale * (pose.y * f + g) for f, g in zip_longest(d, y, fillvalue=ZERO)]
            W, C, S = [ONE, ZERO, t * t], [c, -2 * s * t, -c * t * t], [s, 2 * c * t, -s * t * t]
            if part.slide:  # else d is W, or both are 1
                yield Course(*(times(p, d) for p in (W, C, S)), times(W, X), times(W, Y))
            else:
                yield Course(W, C, S, X, Y)
            pose = part.end(pose)

def read_slide(exact: Any, contacts: list[tuple[Any, ...]], place: str) -> Motion:
    got = members(exact, place, x=REQUIRED, y=REQUIRED, d=REQUIRED, tau=REQUIRED)
    tau, terms = number(got["tau"], place), []
    for key in "xyd":
        listed = [number(c, f"{place}.{key}") for c in items(got[key], f"{place}.{key}")]
        if any(listed[5:]) or (key != "d" and any(listed[:1])):
            raise BadFileError(f"{place}.{key}: expected at most five coefficients; those of x and y begin with 0")
        terms.append((listed + [ZERO] * 5)[:5])
    unit = -1 if terms[2][0] < 0 else 1
    x, y, d = ([unit * c * tau**k for k, c in enumerate(p)] for p in terms)
    common = math.lcm(*(c.denominator for c in d))
    refuse_if(min(mapped([int(c * common) for c in d], ALL)) <= 0, f"{place}: d may be zero on the way")
    return Motion(vector=(sum(x, ZERO) / sum(d), sum(y, ZERO) / sum(d)), tau=tau, slide=(x, y, d), contacts=contacts)

# === Collisions ===
STANDING = Motion(vector=(ZERO, ZERO))
SHORT = Fraction(1, 2**8)  # parts of a motion are halved; roots are found in those as short as that

class Pair:
    """A piece of the robot on its course, and one of the walls."""

    def __init__(self, course: Course, part: Piece, wall: Piece) -> None:
        self.sides = [(line, part.corners, course.moving) for line in wall.lines]
        self.sides += [(line, wall.corners, course.back) for line in part.lines]
        self.known: dict[tuple[int, int], Poly] = {}

    def heights(self, i: int) -> Iterator[Poly]:
        """Yield heights of one's corners over a side of the other, times positive numbers; positive is inside."""
        (l, m, k), corners, polys = self.sides[i]
        for j, (x, y, z) in enumerate(corners):
            if (i, j) not in self.known:
                self.known[i, j] = combined((k * z, l * x + m * y, m * x - l * y, l * z, m * z), *polys)
            yield self.known[i, j]

    def is_apart(self, interval: Interval) -> bool:
        """True if one side certainly has all of the other piece on its outer side, all the time; False may be wrong."""
        return any(all(is_nowhere_positive(p, interval) for p in self.heights(i)) for i in range(len(self.sides)))

    def has_room(self, interval: Interval) -> bool:
        """True if one side certainly has all of the other piece at some distance on its outer side, all the time."""
        return any(all(max(mapped(p, interval)) < 0 for p in self.heights(i)) for i in range(len(self.sides)))

    def overlaps(self, u: Fraction) -> bool:
        return all(any(sign_at(p, u) > 0 for p in self.heights(i)) for i in range(len(self.sides)))

    def touches(self) -> bool:
        """True if the pieces have a point in common, at u = 0."""
        return all(any(p[0] >= 0 for p in self.heights(i)) for i in range(len(self.sides)))

def beyond(world: World | RoundWorld, course: Course) -> Iterator[Poly]:
    """Polynomials, positive where the reference point is out of the bounds, or a corner of the robot out of the box."""
    W, C, S, X, Y = course.moving
    lines = ((-1, 0, 1), (0, -1, 1), (1, 0, -1), (0, 1, -1))  # l x + m y + k b > 0 is beyond
    for (l, m, k), bound in zip(lines, world.bounds, strict=False):
        b, unit = bound.as_integer_ratio()
        yield combined((l * unit, m * unit, k * b), X, Y, W)
    for (l, m, k), b in zip(lines, world.box, strict=False):
        for x, y, z in (corner for part in world.robot for corner in part.corners):  # type: ignore[union-attr]
            yield combined((l * z, m * z, k * b * z, l * x + m * y, m * x - l * y), X, Y, W, C, S)

def collision(world: World | RoundWorld, course: Course) -> Fraction | None:
    """Some u at which the robot is where it may not be; None is a proof that there is none."""
    for p in beyond(world, course):
        if (place := positive_place(p)) is not None:
            return place
    if isinstance(world, RoundWorld):
        return world.collision(course)
    for part in world.robot:
        pairs: dict[int, Pair] = {}
        todo = [(ALL, list(range(len(world.walls))))]
        while todo:
            (lo, hi), walls = todo.pop()
            left, middle = [], (lo + hi) / 2
            for k in near(world, course, part, (lo, hi), walls):
                pair = pairs[k] = pairs.get(k) or Pair(course, part, world.walls[k])
                if pair.is_apart((lo, hi)):
                    continue
                is_long = hi - lo > SHORT
                every = [p for i in range(len(pair.sides)) for p in pair.heights(i)]
                for u in [middle] if is_long else samples(every, lo, hi):
                    if pair.overlaps(u):
                        return u
                left += [k] * is_long
            if left:
                todo += [((lo, middle), left), ((middle, hi), left)]
    return None

def near(world: World, course: Course, part: Piece, interval: Interval, walls: list[int]) -> list[int]:
    """Walls whose boxes meet one around all places of a piece: a quotient is between those of coefficients."""
    W, C, S, X, Y = (mapped(p, interval) for p in course.moving)
    if min(W) <= 0:
        return walls
    places = [
        (c * x + cos * a - sin * b, c * y + sin * a + cos * b, c * w)
        for a, b, c in part.corners
        for w, cos, sin, x, y in zip(W, C, S, X, Y, strict=True)
    ]
    x0, y0, x1, y1 = box_around(places)
    boxes = ((k, *world.boxes[k]) for k in walls)
    return [k for k, left, bottom, right, top in boxes if x0 <= right and left <= x1 and y0 <= top and bottom <= y1]

def touches(world: World, pose: Pose) -> bool:
    """True if the robot, at a free pose, has no distance from something."""
    course = next(STANDING.courses(pose, world.scale))
    if any(p[0] == 0 for p in beyond(world, course)):
        return True
    walls = list(range(len(world.walls)))
    pairs = ((part, k) for part in world.robot for k in near(world, course, part, ALL, walls))
    return any(Pair(course, part, world.walls[k]).touches() for part, k in pairs)

def check_pose(world: World | RoundWorld, pose: Pose, what: str) -> None:
    if collision(world, next(STANDING.courses(pose, world.scale))) is not None:
        raise RefutedError(f"{what}: {pose} is forbidden")

# === Round shapes: poses and motions ===
# One vertical line between any two neighbouring x of ends, vertical tangents and crossings stands for all of these: the
# edges have one order there. Grown shapes overlap if edges are nearer than both growths together, or the shapes do.

def overlap(one: Region, other: Region) -> bool:
    """True if the interiors of two regions meet; the first is bounded."""
    gap = one.grown + other.grown
    (lo, bottom, hi, top), (left, below, right, above) = one.box, other.box
    if not other.outside:
        if lo > right + gap or left > hi + gap or bottom > above + gap or below > top + gap:
            return False
        lo, hi = max(lo, left), min(hi, right)
    pairs = [(e, f) for e in one.edges for f in other.edges if e.is_near(f, gap)]
    if gap:
        if any(are_nearer(e, f, gap) for e, f in pairs):
            return True
        every = one.edges + other.edges  # none of one's meets one of the other, so one line through each ring is enough
        return any(overlap_on(one, other, clear_line(every, ring)) for ring in (*one.rings, *other.rings))
    if lo >= hi:
        return False
    edges = [edge for edge in (*one.edges, *other.edges) if edge.box[0] <= hi and lo <= edge.box[2]]
    polys = [*stops(edges), *(whole_numbers(meeting(e, f)) for e, f in pairs)]
    return any(overlap_on(one, other, x) for x in samples(polys, lo, hi))

def overlap_on(one: Region, other: Region, x: Fraction) -> bool:
    """True if the interiors meet on a vertical line: between two neighbouring heights it is inside both."""
    both = ((k, height) for k, region in enumerate((one, other)) for edge in region.edges for height in edge.heights(x))
    inside = [False, other.outside]
    for here, above in pairwise(sorted(both, key=cmp_to_key(compared_heights))):
        inside[here[0]] ^= True
        if all(inside) and compared_heights(here, above):
            return True
    return False

def compared_heights(one: Any, other: Any) -> int:
    (_, (a, s, k)), (_, (b, t, q)) = one, other
    return root_sign(a - b, (s, k), (-t, q))

def are_nearer(one: Edge, other: Edge, gap: Fraction) -> bool:
    """True if two edges meet, or if they or their beginnings are nearer than a gap on a line that is normal to both."""
    if one.common_points(other):
        return True
    pairs = [((one, *circle), (other, *another)) for circle in one.rounds for another in other.rounds]
    for edge, straight in ((one, other), (other, one)):
        p, v = straight.p, straight.chord
        for c, r in () if straight.center else edge.rounds:
            share = dot(minus(c, p), v) / dot(v, v)
            if 0 <= share <= 1:
                pairs.append(((edge, c, r), (straight, (p[0] + share * v[0], p[1] + share * v[1]), ZERO)))
    return any(rounds_are_nearer(*pair, gap) for pair in pairs)

def rounds_are_nearer(one: tuple[Edge, Point, Fraction], other: tuple[Edge, Point, Fraction], gap: Fraction) -> bool:
    """True if points of two edges on the line through the centers of their circles are nearer than a gap."""
    (e, c, r), (f, d, s) = one, other
    away = minus(d, c)
    if (square := dot(away, away)) == 0:
        return r == s == 0  # else ends of arcs are as near
    for i in (1, -1) if r else (1,):
        for j in (1, -1) if s else (1,):
            if all(root_sign(-gap, (k, square), (k * j, s), (-k * i, r)) < 0 for k in (1, -1)):
                ways = [(way * away[0], way * away[1]) for way in (i, j)]
                if (not r or e.points_to(ways[0])) and (not s or f.points_to(ways[1])):
                    return True
    return False

@lru_cache(maxsize=1 << 12)
def contact_squares(radii: tuple[Fraction, ...]) -> tuple[Poly, ...]:
    """Polynomials whose zeros are the squares of +-sqrt(k) +-sqrt(k') ... for all k given."""
    sums: list[tuple[Any, ...]] = [(ZERO, ONE)]
    for k in radii:
        n, d = k.as_integer_ratio()
        root = Fraction(math.isqrt(n), math.isqrt(d))
        shifted = []
        for p in sums:  # p(x + sqrt(k)) is even + odd sqrt(k)
            even, odd = [ZERO] * len(p), [ZERO] * len(p)
            for i, c in enumerate(p):
                for j in range(i + 1):
                    (odd if j % 2 else even)[i - j] += c * math.comb(i, j) * k ** (j // 2)
            if root * root == k:
                shifted += [tuple(a + s * root * b for a, b in zip(even, odd, strict=True)) for s in (1, -1)]
            else:
                shifted.append(combined((1, -k), times(even, even), times(odd, odd)))  # type: ignore[arg-type]
        sums = shifted
    mirrored = (times(p, [-c if j % 2 else c for j, c in enumerate(p)])[::2] for p in sums)  # p(x) p(-x) in x^2
    return tuple({squarefree(whole_numbers(p)) for p in mirrored})

def vanishing(n: Poly, m: Poly, *radii: Fraction) -> Iterator[Poly]:
    """Yield polynomials with zeros where n / m is the square of a sum of square roots with any signs."""
    for p in contact_squares(tuple(sorted(radii))):
        total: Poly = (p[-1],)
        power: Poly = (1,)
        for c in reversed(p[:-1]):
            power = times(power, m)
            total = combined((1, c), times(total, n), power)
        yield total

def contacts(course: Course, one: Edge, other: Edge, gap: Fraction) -> Iterator[Poly]:
    """Yield polynomials with zeros wherever a contact of an edge of the robot and one of a wall may begin or end: where
    ends are on lines or circles, or lines and circles touch; or where they are at a distance, the gap.
    """
    wide = [gap**2] if gap else []
    turned = primitive(course.moving[0])  # divides squares of distances, and heights in the robot's frame
    for c, r in one.rounds:
        for d, s in other.rounds:
            if radii := [q for q in (r, s, *wide) if q]:
                yield from vanishing(*distance(course, c, d, turned), *radii)
    back = padded([quotient(p, turned) for p in course.back])
    for mine, straight, polys in ((one, other, course.moving), (other, one, back)):
        if straight.center is None:
            l, m, k = whole_numbers(straight.equation[1:])
            for c, r in mine.rounds:
                x, y, z = homogeneous(c)
                height = combined((k * z, l * x + m * y, m * x - l * y, l * z, m * z), *polys)
                width = times(((l * l + m * m) * z * z,), times(polys[0], polys[0]))
                radii = [q for q in (r, *wide) if q]
                yield from vanishing(times(height, height), width, *radii) if radii else [height]

def distance(course: Course, one: Point, other: Point, turned: Poly) -> tuple[Poly, Poly]:
    """Square of the distance of a point of the robot and one of a wall, as a quotient of polynomials."""
    (x, y, z), (a, b, c), (W, C, S, X, Y) = homogeneous(one), homogeneous(other), course.moving
    right = combined((c * z, c * x, -c * y, -a * z), X, C, S, W)
    up = combined((c * z, c * x, c * y, -b * z), Y, S, C, W)
    square = combined((1, 1), times(right, right), times(up, up))
    return quotient(square, turned), times((c * c * z * z,), times(W, quotient(W, turned)))

def homogeneous(p: Point) -> tuple[int, int, int]:
    """Integers (x, y, z) that stand for (x / z, y / z)."""
    z = math.lcm(p[0].denominator, p[1].denominator)
    return int(p[0] * z), int(p[1] * z), z

class RoundWorld:
    """A robot and walls of edges; the outside of the workspace is a wall."""

    scale = 1

    def __init__(self, scene: Scene) -> None:
        self.robot, self.bounds = [region_around(part) for part in scene.robot], list(scene.bounds or ())
        self.walls = [region_around(part) for part in scene.obstacles]
        if scene.workspace:
            self.walls.append(Region(region_around(scene.workspace).rings, outside=True))
        self.box: list[int] = []
        self.edges = [(wall, edge) for wall in self.walls for edge in wall.edges]
        self.pieces = [piece_around(edge, wall.grown) for wall, edge in self.edges]
        self.boxes = [box_around(piece.corners) for piece in self.pieces]

    def grown(self, by: Fraction) -> RoundWorld:
        """World of a robot that a disc makes larger."""
        world = copy(self)
        world.robot = [Region(part.rings, part.grown + by) for part in self.robot]
        return world

    def roomier(self, leeway: Fraction) -> RoundWorld:
        """The same, in bounds that are smaller by as much on each side."""
        world = self.grown(leeway)
        world.bounds = [b + (leeway if k < 2 else -leeway) for k, b in enumerate(self.bounds)]
        if self.bounds and (world.bounds[0] >= world.bounds[2] or world.bounds[1] >= world.bounds[3]):
            raise RefutedError("its decimals are not free, as it claims: of smaller bounds nothing would be left")
        return world

    def overlaps(self, part: Region, course: Course, u: Fraction, walls: Iterable[Region]) -> bool:
        W, C, S, X, Y = (value(p, u) for p in course.moving)
        moved = part.moved((X / W, Y / W, C / W, S / W))
        return any(overlap(moved, wall) for wall in walls)

    def collision(self, course: Course) -> Fraction | None:
        """Some u at which a part of the robot overlaps a wall; None is a proof that there is none."""
        for part in self.robot:
            if self.overlaps(part, course, ZERO, self.walls):
                return ZERO
            if len(course.moving[0]) > 1 and (u := self.later(part, course)) is not None:
                return u
        return None

    def later(self, part: Region, course: Course) -> Fraction | None:
        """Some u for one part, free at u = 0: intervals are halved until little may happen; then samples decide."""
        pieces = [piece_around(edge, part.grown) for edge in part.edges]
        pairs: dict[tuple[int, int], Pair] = {}
        events: dict[tuple[int, int], set[Poly]] = {}
        todo = [(ALL, [list(range(len(self.edges))) for _ in pieces])]
        while todo:
            (lo, hi), walls = todo.pop()
            left, middle = [], (lo + hi) / 2
            for i, (piece, listed) in enumerate(zip(pieces, walls, strict=True)):
                left.append(near(self, course, piece, (lo, hi), listed))  # type: ignore[arg-type]
                for k in left[i]:
                    pairs[i, k] = pairs.get((i, k)) or Pair(course, piece, self.pieces[k])
                left[i] = [k for k in left[i] if not pairs[i, k].has_room((lo, hi))]
            close = [(i, k) for i, ks in enumerate(left) for k in ks]
            halves = [((lo, middle), left), ((middle, hi), left)] if hi - lo > SHORT else []
            if len(close) > MANY and halves:
                todo += halves
                continue
            for i, k in close:
                wall, edge = self.edges[k]
                if (i, k) not in events:
                    events[i, k] = set(map(primitive, contacts(course, part.edges[i], edge, part.grown + wall.grown)))
            polys = {p for pair in close for p in events[pair] if may_vanish(p, (lo, hi))}
            if len(polys) > FEW and halves:
                todo += halves
                continue
            there = list({id(wall): wall for wall in (self.edges[k][0] for _, k in close)}.values())
            for u in samples(polys, lo, hi) if there else ():
                if self.overlaps(part, course, u, there):
                    return u
        return None

MANY, FEW = 64, 8  # pairs of edges, and events, for which an interval is not halved

def may_vanish(p: Poly, interval: Interval) -> bool:
    """False if a polynomial certainly has no zero in an interval, or is zero all the time."""
    coefficients = mapped(p, interval) if p else [1]
    return min(coefficients) <= 0 <= max(coefficients)

def region_around(shape: Polygon | Round) -> Region:
    rings = shape.edges if isinstance(shape, Round) else [[Edge(*e) for e in edges_of(ring)] for ring in shape.rings]
    return Region(rings, shape.grown if isinstance(shape, Round) else ZERO)

def piece_around(edge: Edge, by: Fraction) -> Piece:
    """Convex polygon around an edge, larger by a square."""
    square = (by, by), (-by, by), (by, -by), (-by, -by)
    return Piece(convex_hull((x + dx, y + dy) for x, y in edge.corners for dx, dy in square))

# === Answers: exact numbers, and the decimals beside them (docs/answer-format.md, "Decimals") ===
class Answer:
    """Start, goal, the hash of the scene, and all decimals by place."""

    def __init__(self, data: dict[str, Any], **more: Any) -> None:
        refuse_if(data.get("exact") is None, "decimals alone are not read here; cfree also saves exact numbers")
        refuse_if("polygons" in data, "it is about polygons, not about the round shapes; `cfree verify` reads it")
        more |= dict.fromkeys(("answer", "scene", "start", "goal", "exact"), REQUIRED) | {"whole": {}, "moved": None}
        self.got = got = members(data, "answer", version=1, units="", frame="world", clearance=None, **more)
        one_of(got["version"], "version", 1)
        refuse_if(not all(isinstance(got[key], str) for key in ("units", "frame")), "units, frame: expected texts")
        self.clearance = ZERO if got["clearance"] is None else number(got["clearance"], "clearance")
        refuse_if(self.clearance <= 0 and got["clearance"] is not None, "clearance: expected a length above 0")
        ends = members(got["exact"], "exact", start=REQUIRED, goal=REQUIRED)
        self.start, self.goal = (read_pose(ends[end], f"exact.{end}") for end in ("start", "goal"))
        asked = {} if got["moved"] is None else members(got["moved"], "moved", start=None, goal=None)
        self.asked = {k: read_pose(v, f"moved.{k}", 3 - (k == "goal")) for k, v in asked.items() if v is not None}
        refuse_if(got["moved"] is not None and not self.asked, "moved: expected a start, a goal, or both")
        stamp = members(got["scene"], "scene", sha256=REQUIRED, robot=REQUIRED, reading=[])
        self.sha256, self.box = stamp["sha256"], read_bounds(stamp["robot"], "scene.robot")
        self.whole = members(got["whole"], "whole", sha256=self.sha256, obstacles=[])
        self.kept = [whole(k, "whole.obstacles", 0) for k in items(self.whole["obstacles"], "whole.obstacles")]
        is_hash = [isinstance(x, str) and re.fullmatch("[0-9a-f]{64}", x) for x in (self.sha256, self.whole["sha256"])]
        refuse_if(not all(is_hash), "sha256: expected 64 digits 0-9 and a-f")
        self.size = max(self.box[2] - self.box[0], self.box[3] - self.box[1])
        self.reach = sum(max(abs(self.box[k]), abs(self.box[k + 2])) for k in (0, 1))
        self.decimals: dict[Any, Fraction] = {}
        for end in ("start", "goal"):
            self.read_decimals(end, got[end], 3)
        self.check_decimals("goal", self.goal)

    def read_decimals(self, place: Any, value: Any, count: int) -> None:
        self.decimals |= {(place, k): c for k, c in enumerate(literals(value, str(place), count))}

    def check_decimals(self, place: Any, pose: Pose, theta: Fraction | None = None) -> None:
        """Check that they are a pose. Whole turns count if an angle is given."""
        angle = self.decimals[place, 2]
        apart = turns_off(angle, angle_to(pose.tau)) if theta is None else abs(angle - theta)
        if off(self.decimals, place, (pose.x, pose.y)) + self.reach * apart > self.size / 10**9:
            raise BadFileError(f"{place}: the decimals are another pose than the exact numbers")

    def check_asked(self, scene: Scene) -> Scene:
        """Scene that it is about: this one, or some of its obstacles (poses separated among these are so among all)."""
        part = copy(scene)
        if self.sha256 != scene.sha256 == self.whole["sha256"]:
            part.obstacles = [scene.obstacles[k] for k in self.kept if k < len(scene.obstacles)]
        refute_if(self.sha256 != part.sha256, "it is an answer for another scene")
        refute_if(self.box != scene.box, "scene.robot is not the box around the robot")
        for name, asked in scene.asked.items():
            pose = self.asked.get(name, getattr(self, name))
            known = not asked or any(q in (pose, Pose(pose.x, pose.y, "any")) for q in asked)
            refute_if(not known, f"the {name} is {pose}, and another in the scene")
        return part

    def end(self, name: str) -> str:
        """Text of an end, with the pose from which it was moved, if it was."""
        return str(getattr(self, name)) + (f" [moved from {self.asked[name]}]" if name in self.asked else "")

    def check_moved(self, world: World | RoundWorld) -> None:
        """Check that no free pose is moved. Places and poses with a clearance are not checked."""
        for name, pose in self.asked.items() if not self.clearance else ():
            is_free = pose.tau != "any" and collision(world, next(STANDING.courses(pose, world.scale))) is None
            refute_if(is_free, f"the {name} was moved from {pose}, which is free")

def off(decimals: dict[Any, Fraction], place: Any, exact: Fractions) -> Fraction:
    return sum((abs(decimals[place, k] - c) for k, c in enumerate(exact)), ZERO)

def read_contact(value: Any, place: str) -> Contact:
    got = members(value, place, kind=REQUIRED, robot=REQUIRED, obstacle=REQUIRED)
    features = []
    for key in ("robot", "obstacle"):
        polygon, vertex = items(got[key], f"{place}.{key}", 2, 2)
        features.append((whole(polygon, f"{place}.{key}", WORKSPACE), whole(vertex, f"{place}.{key}", 0)))
    return one_of(got["kind"], f"{place}.kind", "vertex-edge", "edge-vertex"), features[0], features[1]

# === Paths ===
class PathAnswer(Answer):
    """A start, and motions that lead to the goal."""

    def __init__(self, data: dict[str, Any]) -> None:
        super().__init__(data, decimals=REQUIRED, motions=REQUIRED, disc=[], vehicle=None)
        self.vehicle = None if self.got["vehicle"] is None else Vehicle(self.got["vehicle"])
        self.disc: Ring = [numbers(p, "disc", 2) for p in items(self.got["disc"], "disc")]  # type: ignore[misc]
        refuse_if(self.disc and (not self.clearance or len(self.disc) < 3), "disc: expected a polygon and a clearance")
        one_of(self.got["decimals"], "decimals", "free", "approximate")
        self.motions = [self.read_motion(k, m) for k, m in enumerate(items(self.got["motions"], "motions"))]
        refuse_if(self.effect(self.decimals) > self.size / 10**9, "the decimals lead elsewhere")
        circle, written, exact = 2 * angle_to(None), self.decimals["start", 2], angle_to(self.start.tau)
        pose, theta = self.start, exact + circle * round((written - exact) / circle)
        for k, motion in enumerate(self.motions):
            pose, theta = motion.end(pose), theta + motion.angle
            self.check_decimals((k, "to"), pose, theta)
        refuse_if(pose != self.goal, "the motions do not lead to the exact goal")

    def read_motion(self, k: int, data: Any) -> Motion:
        kind, place = data.get("type") if isinstance(data, dict) else None, f"motions[{k}]"
        keys = {"translation": {"vector": 2}, "rotation": {"pole": 2, "angle": 1}, "slide": {"vector": 2, "angle": 1}}
        written = keys[one_of(kind, f"{place}.type", *keys)] | {"to": 3}
        contacts = {"contacts": REQUIRED} if kind == "slide" else {}
        got = members(data, place, type=kind, exact=REQUIRED, **contacts, **dict.fromkeys(written, REQUIRED))
        for key, count in written.items():
            self.read_decimals((k, key), [got[key]] if key == "angle" else got[key], count)
        if kind == "slide":
            touching = [read_contact(c, f"{place}.contacts") for c in items(got["contacts"], f"{place}.contacts", 2, 2)]
            return read_slide(got["exact"], touching, f"{place}.exact")
        if kind == "translation":
            vector = members(got["exact"], f"{place}.exact", vector=REQUIRED)["vector"]
            return Motion(vector=numbers(vector, f"{place}.exact.vector", 2))
        exact = members(got["exact"], f"{place}.exact", pole=REQUIRED, tau=REQUIRED)
        tau = read_tau(exact["tau"], f"{place}.exact.tau")
        clockwise = exact["tau"] == "-inf" if tau is None else tau < 0
        return Motion(pole=numbers(exact["pole"], f"{place}.exact.pole", 2), tau=tau, clockwise=clockwise)

    def effect(self, decimals: dict[Any, Fraction]) -> Fraction:
        """Bound of the distance by which they may misplace a point of the robot."""
        turned = turns_off(decimals["start", 2], angle_to(self.start.tau))
        moved, pose = off(decimals, "start", (self.start.x, self.start.y)), self.start
        for k, motion in enumerate(self.motions):
            apart = abs((angle := decimals.get(((k, "angle"), 0), ZERO)) - motion.angle)
            turned += apart
            if motion.pole:
                moved += min(Fraction(2), abs(angle)) * off(decimals, (k, "pole"), motion.pole)
                moved += apart * (abs(pose.x - motion.pole[0]) + abs(pose.y - motion.pole[1]))
            else:
                moved += off(decimals, (k, "vector"), motion.vector)
            pose = motion.end(pose)
        return moved + self.reach * turned

    def leeway(self) -> Fraction:
        """Distance that the exact path must keep from everything to make the path of its decimals, as doubles, free."""
        if any(motion.slide for motion in self.motions):
            raise RefutedError("its decimals are not free, as it claims: there are slides")
        try:
            doubles = {place: Fraction(float(c)) for place, c in self.decimals.items()}
        except OverflowError:
            raise RefutedError("its decimals are not free, as it claims: they are no doubles") from None
        most = 4 * max(self.effect(self.decimals), self.effect(doubles))
        power = Fraction(2) ** (most.numerator.bit_length() - most.denominator.bit_length())
        return most and (power if most <= power else 2 * power)

def check_path(answer: PathAnswer, scene: Scene, part: Scene) -> str:
    """Sentence that states the result."""
    is_round = scene.is_round or (answer.clearance and not answer.disc)  # that is kept by the disc itself
    world: World | RoundWorld = RoundWorld(scene) if is_round else World(scene)
    only = "; its decimals are approximate"
    refute_if(is_round and any(motion.slide for motion in answer.motions), "slides are for polygons")
    answer.check_moved(world)
    check_pose(world, answer.start, "start")
    check_pose(world, answer.goal, "goal")
    worlds = {"the robot is where it may not be": world}
    if answer.got["decimals"] == "free":
        worlds, only = {}, ""
        said = "its decimals are not free, as it claims, or the robot is where it may not be"
        worlds[said] = world.roomier(answer.leeway())
    if answer.clearance:
        is_wrong = isinstance(world, World) and not is_around_disc(answer.disc, answer.clearance)
        refute_if(is_wrong, "disc: it is not convex, or not around a disc of that radius")
        there = world.larger(answer.disc) if isinstance(world, World) else world.grown(answer.clearance)
        worlds["the robot is nearer to something than the clearance"] = there
    for said, there in worlds.items():
        check_pose(there, answer.start, f"start: {said}")
    pose = answer.start
    for k, motion in enumerate(answer.motions):
        if answer.vehicle and (why := answer.vehicle.fault(pose, motion)):
            raise RefutedError(f"motion {k}: {why}")
        for course in motion.courses(pose, world.scale):
            for contact in motion.contacts:
                check_kept(part, course, contact, f"motion {k}")
            for said, there in worlds.items():
                if (u := collision(there, course)) is not None:
                    raise RefutedError(f"motion {k}: {said}, near u = {float(u):.6g}")
        pose = motion.end(pose)
    count = f"{len(answer.motions):,} motion{'s' * (len(answer.motions) != 1)}"
    keeps = f"keeps {float(answer.clearance):g} from obstacles and workspace"
    only = (keeps if answer.clearance else "is free of collisions") + only
    drives = f"; {answer.vehicle.text} can drive it" if answer.vehicle else ""
    return f"A path of {count} leads from {answer.end('start')} to {answer.end('goal')}, and {only}{drives}."

def check_kept(scene: Scene, course: Course, contact: Contact, what: str) -> None:
    """Check that a slide keeps a contact: the vertex is on the edge's line, and never beyond its ends."""
    surface = Features(scene).surface(contact)
    (ax, ay), (bx, by), (u, v) = surface.a, surface.b, surface.q
    W, C, S, X, Y = course.moving
    if contact[0] == "edge-vertex":
        (ax, ay), (bx, by), (u, v) = surface.b, surface.a, surface.g
        W, C, S, X, Y = course.back
    # from the beginning of the edge to the vertex, times W
    x, y = combined((1, ax, -ay, -bx), X, C, S, W), combined((1, ay, ax, -by), Y, C, S, W)
    refute_if(any(combined((u, -v), y, x)), f"{what}: the vertex of a contact is not on the edge's line all the way")
    for past in (combined((-u, -v), x, y), combined((u, v, -u * u - v * v), x, y, W)):
        refute_if(positive_place(past) is not None, f"{what}: the vertex of a contact is beyond the end of its edge")

# === Contact surfaces, and the names of their curves and angles ===
Form = tuple[int, int, int]  # (f, g, h) stands for f + g cos + h sin
CHARTS = (1, -1)  # in chart 1 angles are counted from the half turn: cosines and sines change their signs

def poly_of(form: Form, chart: int) -> Poly:
    """(1 + tau^2) times a form."""
    f, g, h = form[0], CHARTS[chart] * form[1], CHARTS[chart] * form[2]
    return f + g, 2 * h, f - g

@dataclass(eq=False)
class Surface:
    """Surface S(t) = b + t q - R (a + t g), t from 0 to 1, of the reference point at a contact.

    A vertex a of the robot on an edge has g = 0; an edge of the robot on a vertex b has q = 0. A contact is in its
    range where all limits are negative: there both edges at the vertex leave the other one on its outer side.
    """

    a: Point
    g: Point
    b: Point
    q: Point
    limits: Sequence[Form] = ()

    def form(self, beta: Point, alpha: Point) -> Form:
        """Form (q - R g) x (beta - R alpha)."""
        q, g = self.q, self.g
        return cross(q, beta) + cross(g, alpha), -cross(q, alpha) - cross(g, beta), dot(g, beta) - dot(q, alpha)

    def cut(self, other: Surface) -> tuple[Form, Form]:
        """Numerator and denominator of t where another surface's line meets this one's."""
        n, d = other.form(minus(self.b, other.b), minus(self.a, other.a)), other.form(self.q, self.g)
        refute_if(not any(d), "a curve is cut out by a surface that is parallel at every angle")
        return (-n[0], -n[1], -n[2]), d

@dataclass
class Shape:
    """Vertices of the robot or of the obstacles, by number, each with those before and after it."""

    vertices: list[Any] = field(default_factory=list)
    around: list[tuple[int, int]] = field(default_factory=list)
    owner: dict[tuple[int, int], int] = field(default_factory=dict)

    def add(self, rings: Iterable[Ring], polygon: int, backwards: bool = False) -> None:
        count = 0
        for ring in rings:
            first, n = len(self.vertices), len(ring)
            for k in range(n):
                vertex = -k % n if backwards else k
                self.owner[polygon, count + vertex] = first + k
                self.around.append((first + (k - 1) % n, first + (k + 1) % n))
                self.vertices.append(ring[vertex])
            count += n

class Features:
    """Meaning of the numbers in an answer (docs/answer-format.md, "Names")."""

    def __init__(self, scene: Scene, auxiliary: dict[tuple[str, str, int], Ring] | None = None) -> None:
        self.scale, self.auxiliary = scene.scale, auxiliary or {}
        for name in ("surface", "curve", "angle"):  # each is computed once
            setattr(self, name, lru_cache(None)(getattr(self, name)))
        self.shapes = {"robot": Shape(), "obstacles": Shape()}
        for name, polygons in (("robot", scene.robot), ("obstacles", scene.obstacles)):
            for k, polygon in enumerate(polygons):
                self.shapes[name].add(polygon.integers(self.scale), k)
        walls = self.shapes["obstacles"]
        if scene.workspace:
            walls.vertices += [None] * 4
            walls.around += [(0, 0)] * 4
            walls.add(scene.workspace.integers(self.scale), WORKSPACE, backwards=True)
        if scene.bounds:
            x0, y0, x1, y1 = (int(b * self.scale) for b in scene.bounds)
            walls.add([[(x0, y0), (x0, y1), (x1, y1), (x1, y0)]], BOUNDS)
            self.shapes["robot"].add([[(0, 0)]], BOUNDS)

    def points(self, owner: str, kind: str, k: int) -> Ring:
        """A vertex, or the ends of an edge; it may be outside the scene, as any feature may define an angle."""
        shape = self.shapes[owner]
        if k < len(shape.vertices) and shape.vertices[k] is not None:
            ends = [k] if kind == "vertex" else [k, shape.around[k][1]]
            return [shape.vertices[end] for end in ends]
        points = self.auxiliary.get((owner, kind, k), [])
        if not points or any(self.scale % c.denominator for point in points for c in point):
            raise RefutedError(f"{kind} {k} of the {owner} does not exist, or has another denominator than the scene")
        return scaled(points, self.scale)

    def point(self, owner: str, k: int) -> Point:
        return self.points(owner, "vertex", k)[0]

    def edge(self, owner: str, k: int) -> tuple[Point, Point]:
        """Beginning and vector of an edge."""
        begin, end = self.points(owner, "edge", k)
        return begin, minus(end, begin)

    def surface(self, contact: Contact) -> Surface:
        """Surface of a contact: a convex vertex and an edge."""
        kind, *named = contact
        numbers = []
        for owner, name in zip(("robot", "obstacles"), named, strict=True):
            if name not in self.shapes[owner].owner:
                raise RefutedError(f"there is no vertex {name[1]} of polygon {name[0]} of the {owner}")
            numbers.append(self.shapes[owner].owner[name])
        is_of_bounds = [name[0] == BOUNDS for name in named]
        (a, g), (b, q) = self.edge("robot", numbers[0]), self.edge("obstacles", numbers[1])
        if kind == "vertex-edge" and all(is_of_bounds):
            return Surface((0, 0), (0, 0), b, q)
        owner = "robot" if kind == "vertex-edge" else "obstacles"
        shape, k = self.shapes[owner], numbers[owner == "obstacles"]
        before, here, after = (shape.vertices[j] for j in (shape.around[k][0], k, shape.around[k][1]))
        if any(is_of_bounds) or side(before, here, after) <= 0:
            raise RefutedError("a contact of the bounds with an obstacle or the robot, or at a reflex vertex")
        both = minus(after, here), minus(before, here)
        if kind == "vertex-edge":  # q x R e < 0
            return Surface(a, (0, 0), b, q, [(0, cross(q, e), dot(q, e)) for e in both])
        return Surface(a, g, b, (0, 0), [(0, cross(g, f), -dot(g, f)) for f in both])  # R g x f < 0

    def t_of(self, surface: Surface, name: tuple[int, int, int]) -> tuple[Form, Form]:
        """Numerator and denominator of t on the curve that a pair of features names on a surface."""
        kind, i, j = name
        if kind == 1:
            return surface.cut(Surface(self.point("robot", i), (0, 0), *self.edge("obstacles", j)))
        if kind == 2:
            return surface.cut(Surface(*self.edge("robot", i), self.point("obstacles", j), (0, 0)))
        refute_if(kind != 3, "a curve that is named by two edges")
        # the reference point where two vertices meet: on the surface if t is the same for all of it
        alpha, beta = minus(self.point("robot", i), surface.a), minus(self.point("obstacles", j), surface.b)
        n, d = dot(beta, surface.q) + dot(alpha, surface.g), dot(surface.q, surface.q) + dot(surface.g, surface.g)
        start, along = (*beta, *alpha), (*surface.q, *surface.g)
        refute_if(any(d * c != n * u for c, u in zip(start, along, strict=True)), "a curve off its surface")
        return (n, 0, 0), (d, 0, 0)

    def zero(self, surface: Surface, names: Sequence[tuple[int, int, int]], chart: int) -> Poly:
        """Polynomial that is 0 at the angle that one or two pairs of features name on a surface."""
        if len(names) == 2:
            (n, d), (m, e) = ([poly_of(form, chart) for form in self.t_of(surface, name)] for name in names)
            return combined((1, -1), times(n, e), times(m, d))
        kind, i, j = names[0]
        if kind == 3:
            terms = surface.form(minus(self.point("obstacles", j), surface.b), minus(self.point("robot", i), surface.a))
        elif kind == 4:
            g, f = self.edge("robot", i)[1], self.edge("obstacles", j)[1]
            terms = 0, cross(g, f), -dot(g, f)
        else:
            raise RefutedError("an angle that is named by a vertex and an edge")
        return poly_of(terms, chart)

    def curve(self, contact: Contact, chart: int, name: tuple[int, int, int]) -> Curve:
        surface = self.surface(contact)
        return Curve(surface, chart, self.t_of(surface, name))

    def angle(self, contact: Contact, chart: int, names: Any, lo: Fraction, hi: Fraction, place: int) -> Root:
        """The only root in an interval, or the one that is counted."""
        if not names:
            refute_if(lo != hi or abs(lo) != 1 or place, "an angle without a name is no end of a chart")
            return Root.rational(lo)
        poly = trimmed(self.zero(self.surface(contact), names, chart))
        groups = ordered(roots_in(poly, lo, hi)) if poly and lo > -2 and hi < 2 else []
        if place > len(groups) or (len(groups) != 1) == (place == 0):
            raise RefutedError(f"{len(groups)} roots in the interval of an angle")
        root = groups[max(place, 1) - 1][0]
        for end in (Root.rational(-ONE), Root.rational(ONE)):
            if (order := root.compared(end)) == 0:
                return end
            refute_if(order == end.lo, "an angle beyond its chart")
        return root

    def trapezoid(self, piece: dict[str, Any]) -> Trapezoid:
        contact, chart = piece["contact"], piece["chart"]
        lower, upper = (self.curve(contact, chart, piece[key]) for key in ("lower", "upper"))
        start, stop = (self.angle(contact, chart, *piece[key]) for key in ("from", "to"))
        result = Trapezoid(self.surface(contact), chart, lower, upper, start, stop)
        result.check()
        return result

# === Separations ===
class Curve:
    """Curve t = n / d on a surface, and the reference point (X / Z, Y / Z) there, polynomials of degree 4 at most."""

    def __init__(self, surface: Surface, chart: int, t: tuple[Form, Form]) -> None:
        n, d = (trimmed(poly_of(form, chart)) for form in t)
        g = common_divisor(n, d)
        self.n, self.d = quotient(n, g), quotient(d, g)
        (a, b), (g, h), (u, v), (x, y) = surface.a, surface.g, surface.b, surface.q
        forms = ((u, -a, b), (x, -g, h)), ((v, -b, -a), (y, -h, -g))  # at t = 0, and along
        start, along = ([poly_of(form, chart) for form in both] for both in zip(*forms, strict=True))
        self.X, self.Y = (combined((1, 1), times(start[k], self.d), times(along[k], self.n)) for k in (0, 1))
        self.Z = times((1, 0, 1), self.d)
        # two quotients of degree 4 that agree at 9 places are one; what X, Y and Z have in common has no root there
        places = [Fraction(k, 1009) + Fraction(1, 10**9 + 7) for k in range(-4, 5)]
        polys = [(*p, *[0] * 5)[:5] for p in (self.X, self.Y, self.Z)]
        rows = [[value_over(p, tau)[0] for p in polys] for tau in places]
        units = [math.gcd(*row) * (sign(row[2]) or sign(row[1]) or sign(row[0])) for row in rows]
        self.key = tuple(tuple(c // unit for c in row) for row, unit in zip(rows, units, strict=True))

    def at(self, tau: Fraction) -> Fraction:
        d = value(self.d, tau)
        refute_if(d == 0, "a curve leaves its surface's line to infinity")
        return value(self.n, tau) / d

@dataclass
class Trapezoid:
    """A piece of a contact surface: lower <= t <= upper, start <= tau <= stop in a chart."""

    surface: Surface
    chart: int
    lower: Curve
    upper: Curve
    start: Root
    stop: Root

    def check(self) -> None:
        """Check that from start to stop 0 <= lower <= upper <= 1, and that the contact is in its range.

        This is checked at one angle strictly between them; no polynomial that decides it changes its sign on the way.
        """
        p, q, limits = self.lower, self.upper, [poly_of(form, self.chart) for form in self.surface.limits]
        refute_if(self.start.compared(self.stop) >= 0, "it does not end after it begins")
        gap = combined((1, -1), times(q.n, p.d), times(p.n, q.d))
        refute_if(not any(gap), "its two curves are one")
        tau = between(self.start.hi, self.stop.lo)
        while p.at(tau) == q.at(tau):
            tau = between(self.start.hi, tau)
        if not 0 <= p.at(tau) < q.at(tau) <= 1 or any(sign_at(limit, tau) >= 0 for limit in limits):
            raise RefutedError("it is no part of its contact: t or the angle is out of range")
        for root in (root for curve in (p, q) for root in self.roots(curve.d)):
            refute_if(root.compared(self.start) >= 0 >= root.compared(self.stop), "a curve leaves for infinity")
        for poly in map(trimmed, (p.n, combined((1, -1), q.d, q.n), gap, *limits)):
            for root in self.roots(poly):
                if root.compared(self.start) > 0 > root.compared(self.stop) and root.is_change(poly):
                    raise RefutedError("its curves cross, or t or the angle leave their range")

    def roots(self, p: Poly) -> list[Root]:
        """Roots from start to stop, and perhaps some beside them."""
        ends = self.start.lo, self.stop.hi
        return roots_in(p, *ends) if len(p) > 1 and min(images := mapped(p, ends)) <= 0 <= max(images) else []

class Proof(Answer):
    """Two poses, and pieces of contact surfaces between them."""

    def __init__(self, data: dict[str, Any]) -> None:
        if "rounded" in data:
            raise BadFileError("its surface is one among rounded shapes; `cfree verify` reads it")
        required = dict.fromkeys(("of", "obstacles", "surface"), REQUIRED)
        super().__init__(data, **required, smaller_robot=[], larger_bounds=None, auxiliary=[], cores=[])
        self.check_decimals("start", self.start)
        got = self.got
        self.is_closed = one_of(got["of"], "of", "closed", "interior") == "closed"
        for k in items(got["obstacles"], "obstacles"):
            whole(k, "obstacles", -2)
        parts = items(got["smaller_robot"], "smaller_robot")
        self.robot = [read_polygon(part, f"smaller_robot[{k}]") for k, part in enumerate(parts)]
        self.cores = [read_polygon(part, f"cores[{k}]") for k, part in enumerate(items(got["cores"], "cores"))]
        wanted = len(self.robot) if self.clearance else 0
        refuse_if(len(self.cores) != wanted, '"clearance" belongs to as many "cores" as "smaller_robot" has polygons')
        self.bounds = None if got["larger_bounds"] is None else read_bounds(got["larger_bounds"], "larger_bounds")
        if self.is_closed != bool(self.robot) or (not self.is_closed and (self.bounds or self.clearance)):
            raise BadFileError('"smaller_robot", "larger_bounds" and "clearance" belong to what is "closed"')
        self.auxiliary = dict(read_auxiliary(item) for item in items(got["auxiliary"], "auxiliary"))
        refuse_if(len(self.auxiliary) < len(got["auxiliary"]), "one of the auxiliary features is there twice")
        self.pieces = [read_piece(piece, f"surface[{k}]") for k, piece in enumerate(items(got["surface"], "surface"))]
        if set(got["obstacles"]) != {piece["contact"][2][0] for piece in self.pieces}:
            raise BadFileError('"obstacles" are not those of the surface')

def read_auxiliary(data: Any) -> tuple[tuple[str, str, int], Ring]:
    got = members(data, "auxiliary", of=REQUIRED, kind=REQUIRED, number=REQUIRED, points=REQUIRED)
    owner, kind = one_of(got["of"], "of", "robot", "obstacles"), one_of(got["kind"], "kind", "vertex", "edge")
    count = 1 + (kind == "edge")
    points = [numbers(point, "auxiliary", 2) for point in items(got["points"], "auxiliary", count, count)]
    refuse_if(len(set(points)) < count, "an auxiliary edge between two equal points")
    return (owner, kind, whole(got["number"], "auxiliary", 0)), points  # type: ignore[return-value]

def read_piece(data: Any, place: str) -> dict[str, Any]:
    got = members(data, place, **dict.fromkeys(("contact", "chart", "from", "to", "lower", "upper"), REQUIRED))
    got["contact"] = read_contact(got["contact"], f"{place}.contact")
    one_of(got["chart"], f"{place}.chart", 0, 1)
    for key in ("lower", "upper"):
        got[key] = read_name(got[key], f"{place}.{key}")
    for key in ("from", "to"):
        angle = members(got[key], f"{place}.{key}", names=REQUIRED, tau=REQUIRED, place=0)
        names = tuple(read_name(name, f"{place}.{key}") for name in items(angle["names"], f"{place}.{key}", 0, 2))
        ends = literals(angle["tau"], f"{place}.{key}.tau", 2)
        lo, hi = (Fraction(float(max(-3 * ONE, min(c, 3 * ONE)))) for c in ends)  # doubles, as they were
        refuse_if(not -2 <= lo <= hi <= 2, f"{place}.{key}.tau: expected an interval between -2 and 2")
        got[key] = names, lo, hi, whole(angle["place"], f"{place}.{key}.place", 0, 4)
    return got

def read_name(data: Any, place: str) -> tuple[int, int, int]:
    kind, i, j = items(data, place, 3, 3)
    return whole(kind, place, 1, 4), whole(i, place, 0, 2**30 - 1), whole(j, place, 0)

def check_closed(pieces: list[Trapezoid]) -> None:
    """Check that every part of a side of a piece is one of an even number of others. A sum mod 2 of intervals of one
    curve, or of segments of one line at one angle, is zero if every end of one is that of an even number of them.
    """
    angles: dict[int, tuple[Any, Root]] = {}  # by identity of roots: a number, and one root for all that are equal
    for chart in (0, 1):
        roots = {id(root): root for p in pieces if p.chart == chart for root in (p.start, p.stop)}
        for k, group in enumerate(ordered(roots.values())):
            one = next((root for root in group if root.lo == root.hi), group[0])
            is_end = one.lo == one.hi and abs(one.lo) == 1  # shared by the charts
            angles |= {id(root): (("end", chart == (one.lo < 0)) if is_end else (chart, k), one) for root in group}
    ends: Counter[Any] = Counter()
    walls: dict[Any, list[tuple[Trapezoid, Root]]] = defaultdict(list)
    for p in pieces:
        for curve in (p.lower, p.upper):
            ends.update((p.chart, curve.key, angles[id(root)][0]) for root in (p.start, p.stop))
        for root in (p.start, p.stop):
            angle, one = angles[id(root)]
            walls[angle].append((p, one))
    refute_if(any(n % 2 for n in ends.values()), "the surface is not closed: sides on a curve end without a partner")
    for wall in walls.values():
        check_wall(wall)

def check_wall(wall: list[tuple[Trapezoid, Root]]) -> None:
    """Check the same for the segments at one angle: from lower to upper on the line of each piece."""
    lines: list[tuple[Trapezoid, dict[Any, Curve]]] = []  # a piece on each, and the ends on it that are odd
    for p, root in wall:
        odd = next((ends for other, ends in lines if other.surface is p.surface or is_one_line(p, other, root)), None)
        if odd is None:
            odd = {}
            lines.append((p, odd))
        for curve in (p.lower, p.upper):
            key: Any = curve.key
            if root.lo == root.hi:
                x, y, z = (value(poly, root.lo) for poly in (curve.X, curve.Y, curve.Z))
                key = x / z, y / z
            elif key not in odd:
                key = next((k for k, other in odd.items() if is_one_point(curve, other, root)), key)
            if odd.pop(key, None) is None:
                odd[key] = curve
    refute_if(any(odd for _, odd in lines), "the surface is not closed: sides at an angle end without a partner")

def is_one_line(p: Trapezoid, other: Trapezoid, root: Root) -> bool:
    """True if two pieces have one line at an angle of p."""
    one, two = p.surface, other.surface
    forms = one.form(two.q, two.g), one.form(minus(two.b, one.b), minus(two.a, one.a))
    return all(root.sign(poly_of(form, p.chart)) == 0 for form in forms)

def is_one_point(one: Curve, other: Curve, root: Root) -> bool:
    both = (one.X, other.X), (one.Y, other.Y)
    return all(root.sign(combined((1, -1), times(p, other.Z), times(q, one.Z))) == 0 for p, q in both)

def crosses(p: Trapezoid, tau: Fraction, x: Fraction, y: Fraction) -> bool:
    """True if a ray from (x, y) towards -x meets a piece just after an angle. Ends level with it count as below."""
    S, unit = p.surface, math.lcm(x.denominator, y.denominator)
    above = []
    for curve in (p.lower, p.upper):
        over = combined((unit, -int(unit * y)), curve.Y, curve.Z)
        above.append(sign_after(over, tau) * sign_after(curve.Z, tau) > 0)
    beta = int(unit * (x - S.b[0])), int(unit * (y - S.b[1]))
    alpha = -unit * S.a[0], -unit * S.a[1]
    on_left = sign_after(poly_of(S.form(beta, alpha), p.chart), tau)  # of the piece's line, as t grows
    return above[0] != above[1] and (on_left < 0) == above[1]

def sign_after(p: Poly, tau: Fraction) -> int:
    """Sign of the first derivative that is not 0 at tau; 0 for the zero polynomial."""
    return (sign_at(p, tau) or sign_after(derivative(p), tau)) if any(p) else 0

def is_inside(pose: Pose, scale: int, pieces: list[Trapezoid]) -> bool:
    """True if a ray from a pose off the surface meets it an odd number of times, just after its angle."""
    chart, tau = 0, pose.tau
    if tau is None or not -1 <= tau < 1:
        chart, tau = 1, ZERO if tau is None else -1 / tau
    x, y, root = scale * pose.x, scale * pose.y, Root.rational(tau)
    here = [p for p in pieces if p.chart == chart and p.start.compared(root) <= 0 < p.stop.compared(root)]
    return sum(crosses(p, tau, x, y) for p in here) % 2 == 1

def check_proof(proof: Proof, scene: Scene) -> str:
    """Sentence that states the result."""
    world, inner, apart = World(scene), scene, False
    proof.check_moved(world)
    check_pose(world, proof.start, "start")
    check_pose(world, proof.goal, "goal")
    if proof.is_closed:
        for k, part in enumerate(proof.cores or proof.robot):
            if not any(strictly_inside(part, polygon) for polygon in scene.robot):
                what = "cores" if proof.cores else "smaller_robot"
                raise RefutedError(f"{what}[{k}] is not strictly inside one of the robot's polygons")
        for part, core in zip(proof.robot, proof.cores, strict=False):
            if not is_convex(core.rings) or not all(is_near(p, core.rings[0], proof.clearance) for p in part.rings[0]):
                raise RefutedError("a core is not convex, or not all of smaller_robot nearer to it than the clearance")
        if proof.bounds:
            x0, y0, x1, y1 = scene.bounds or proof.bounds
            left, bottom, right, top = proof.bounds
            refute_if(min(x0 - left, y0 - bottom, right - x1, top - y1) <= 0, "larger_bounds are not larger")
        inner = Scene(proof.robot, scene.obstacles, scene.workspace, proof.bounds)
    else:
        apart = touches(world, proof.start) or touches(world, proof.goal)
    features, pieces = Features(inner, proof.auxiliary), []
    for k, piece in enumerate(proof.pieces):
        try:
            pieces.append(features.trapezoid(piece))
        except RefutedError as error:
            raise RefutedError(f"piece {k}: {error}") from None
    check_closed(pieces)
    # where start or goal touches something, no path from it keeps a distance anyway
    if not apart and is_inside(proof.start, inner.scale, pieces) == is_inside(proof.goal, inner.scale, pieces):
        raise RefutedError("start and goal are on one side of the surface")
    from_to = f"leads from {proof.end('start')} to {proof.end('goal')}"
    clear = f"No path that keeps {float(proof.clearance):g} from obstacles and workspace {from_to}."
    closed = f"No path {from_to}, not even one that touches."
    touching = f"No path that keeps a distance from everything {from_to}; one that touches may."
    return clear if proof.clearance else closed if proof.is_closed else touching

# === Vehicles held by contacts ===
class Held(Answer):
    """A vehicle that contacts at one end hold: all poses at which it touches until something changes."""

    def __init__(self, data: dict[str, Any]) -> None:
        super().__init__(data, **dict.fromkeys(("vehicle", "at", "of", "obstacles", "rail"), REQUIRED))
        self.check_decimals("start", self.start)
        self.vehicle = Vehicle(self.got["vehicle"])
        self.at = one_of(self.got["at"], "at", "start", "goal")
        self.of = one_of(self.got["of"], "of", "pieces", "paths")
        for k in items(self.got["obstacles"], "obstacles"):
            whole(k, "obstacles", -2)
        self.rail = [read_pose(pose, "rail") for pose in items(self.got["rail"], "rail", 1)]
        refuse_if(self.rail[0] != getattr(self, self.at), f"rail: it does not begin at the {self.at}")

class Contacts:
    """All pairs of pieces at a pose, and the controls (v, w) at which a sign of theirs may change."""

    def __init__(self, world: World, vehicle: Vehicle, pose: Pose) -> None:
        self.world, self.vehicle, self.pose, self.axle = world, vehicle, pose, vehicle.axle_at(pose)

    def motion(self, v: Fraction, w: Fraction) -> Motion:
        """The motion of a control: speed along forward, and rate of turning."""
        c, s = self.axle.rotation
        if w == 0:
            return Motion(vector=(c * v, s * v))
        pole = self.axle.x - s * v / w, self.axle.y + c * v / w
        return Motion(pole=pole, tau=ONE if w > 0 else -ONE, clockwise=w < 0)

    def pairs(self, course: Course) -> Iterator[Pair]:
        for part in self.world.robot:
            for wall in self.world.walls:
                yield Pair(course, part, wall)

    def sign(self, v: Fraction, w: Fraction, first_only: bool = False) -> int:
        """1 if all parts, 0 if something keeps touching, -1 if something overlaps; from u = 0 on."""
        course = next(self.motion(v, w).courses(self.pose, self.world.scale))

        def outside(p: Poly) -> int:
            return -next((sign(c) for c in (p[:2] if first_only else p) if c), 0)

        sides = (max(min(map(outside, pair.heights(i))) for i in range(len(pair.sides))) for pair in self.pairs(course))
        return min(chain(sides, map(outside, beyond(self.world, course))), default=1)

    def curvatures(self) -> set[Fraction]:
        course, found = next(STANDING.courses(self.pose, self.world.scale)), {ZERO}
        scale, (c, s), reference = self.world.scale, self.axle.rotation, Pose(ZERO, ZERO, ZERO)

        def add(l: Any, m: Any, x: Fraction, y: Fraction) -> None:
            """A line's direction and a point on it, in the world."""
            x, y = x - self.axle.x, y - self.axle.y
            x, y, l, m = c * x + s * y, c * y - s * x, c * l + s * m, c * m - s * l
            if m * x - l * y:
                found.add(-l / (m * x - l * y))
            if y:
                found.add(1 / y)

        d, e = self.pose.rotation
        for pair in self.pairs(course):
            if not pair.touches():
                continue
            for i, ((l, m, _), corners, _) in enumerate(pair.sides):
                is_robots = i >= len(pair.sides) - len([1 for side in pair.sides if side[2] is course.back])
                for (x, y, z), p in zip(corners, pair.heights(i), strict=True):
                    px, py = Fraction(x, z * scale), Fraction(y, z * scale)
                    if p[0] == 0 and is_robots:  # a line of the robot
                        add(d * l - e * m, e * l + d * m, px, py)
                    elif p[0] == 0:
                        add(l, m, self.pose.x + d * px - e * py, self.pose.y + e * px + d * py)
        for l, m in ((1, 0), (0, 1)):
            add(l, m, self.pose.x + reference.x, self.pose.y)
            for part in self.world.robot if self.world.box else ():
                for x, y, z in part.corners:
                    px, py = Fraction(x, z * scale), Fraction(y, z * scale)
                    add(l, m, self.pose.x + d * px - e * py, self.pose.y + e * px + d * py)
        return found

    def controls(self, gears: Sequence[int], any_vehicle: bool) -> Iterator[tuple[Fraction, Fraction]]:
        found = self.curvatures()
        if not any_vehicle and not self.vehicle.turns_in_place:
            low, high = -1 / self.vehicle.radii[1], 1 / self.vehicle.radii[0]
            found = {k for k in found if low < k < high} | {low, high}
        listed = sorted(found)
        ends = [] if not any_vehicle and not self.vehicle.turns_in_place else [listed[0] - 1, listed[-1] + 1]
        for v in gears:
            for k in (*listed, *((a + b) / 2 for a, b in pairwise(listed)), *ends):
                yield v * ONE, v * k
        if ends:
            yield ZERO, ONE
            yield ZERO, -ONE

    def is_held(self, gears: Sequence[int]) -> bool:
        """True if no motion but a straight one keeps the contacts, and none leaves."""
        signs = ((self.sign(v, w), w) for v, w in self.controls(gears, any_vehicle=False))
        return all(held < 0 or (held == 0 and w == 0) for held, w in signs)

    def goes_on(self, v: Fraction, rail: list[Pose], gears: Sequence[int]) -> bool:
        """True if the rail has a pose straight ahead, and no other motion begins between the two."""
        (c, s), pose = self.axle.rotation, self.pose
        others = [(other.x - pose.x, other.y - pose.y) for other in rail if other.tau == pose.tau]
        end = min((d for x, y in others if c * y == s * x and (d := v * (c * x + s * y)) > 0), default=None)
        if end is None:
            return False
        ends = sorted({ZERO, end, *(length for length in self.changes(v) if 0 < length < end)})
        between = [self.moved(v * length) for length in (*ends[1:-1], *((a + b) / 2 for a, b in pairwise(ends)))]
        return all(there in rail or Contacts(self.world, self.vehicle, there).is_held(gears) for there in between)

    def changes(self, v: Fraction) -> list[Fraction]:
        """Lengths of straight ways up to where a sign may change."""
        course = next(self.motion(v, ZERO).courses(self.pose, self.world.scale))
        sides = (pair.heights(i) for pair in self.pairs(course) for i in range(len(pair.sides)))
        heights = chain(beyond(self.world, course), *sides)
        found = [Fraction(-p[0], p[1]) for p in heights if len(p) > 1 and p[1]]
        c, s = self.axle.rotation
        for wall in self.world.walls:
            for x, y, z in wall.corners:
                by = Fraction(x, z * self.world.scale) - self.axle.x, Fraction(y, z * self.world.scale) - self.axle.y
                found.append((c * by[0] + s * by[1]) / v)
        return found

    def moved(self, length: Fraction) -> Pose:
        c, s = self.axle.rotation
        return Pose(self.pose.x + c * length, self.pose.y + s * length, self.pose.tau)

def check_held(answer: Held, scene: Scene) -> str:
    """Sentence that states the result."""
    world = World(scene)
    answer.check_moved(world)
    check_pose(world, answer.start, "start")
    check_pose(world, answer.goal, "goal")
    gears = (1, -1) if not answer.vehicle.forward_only else (1,) if answer.at == "start" else (-1,)
    for k, pose in enumerate(answer.rail):
        check_pose(world, pose, f"rail {k}")
        contacts = Contacts(world, answer.vehicle, pose)
        for v, w in contacts.controls(gears, any_vehicle=False):
            leaves = contacts.sign(v, w)
            refute_if(leaves > 0, f"rail {k}: a first motion leaves")
            if leaves < 0:
                continue
            goes_on = w == 0 and contacts.goes_on(v, answer.rail, gears)
            refute_if(not goes_on, f"rail {k}: it can go on along its contacts, which is not in the answer")
    if answer.of == "paths":
        contacts = Contacts(world, answer.vehicle, answer.rail[0])
        for v, w in contacts.controls((1, -1), any_vehicle=True):
            refute_if(contacts.sign(v, w, first_only=True) >= 0, "it is of finitely many pieces only")
    way = f"leave its {answer.at}" if answer.at == "start" else f"arrive at its {answer.at}"
    said = f"no path of finitely many lines and arcs lets {answer.vehicle.text} {way}"
    if answer.of == "paths":
        said = f"no path of finite length lets a vehicle with this axle {way}, whatever its turning radius"
    return f"From {answer.end('start')} to {answer.end('goal')}: {said}."

# === Cars without reverse gear: boxes of axle poses ===
SAFE = Fraction(1, 1 << 40)  # of lengths, in the size of the scene, and of angles

@cache
def turned(part: int, count: int) -> tuple[Fraction, Fraction]:
    """Cosine and sine of part / count of half a turn, with an error below 2^-60."""
    angle, parts, term = Fraction(round(angle_to(None) * part / count * (1 << 90)), 1 << 90), [ZERO, ZERO], ONE
    for k in range(60):
        parts[k % 2] += term * (1, 1, -1, -1)[k % 4]
        term = Fraction(round(term * angle / (k + 1) * (1 << 90)), 1 << 90)
    return Fraction(round(parts[0] * (1 << 64)), 1 << 64), Fraction(round(parts[1] * (1 << 64)), 1 << 64)

class Unreached(Answer):
    """Boxes that a car without reverse gear reaches from one end; back from its goal it is turned by half a turn."""

    def __init__(self, data: dict[str, Any]) -> None:
        super().__init__(data, **dict.fromkeys(("vehicle", "at", "pieces", "grid", "boxes"), REQUIRED))
        self.check_decimals("start", self.start)
        self.vehicle = Vehicle(self.got["vehicle"])
        refuse_if(not self.vehicle.forward_only, "vehicle: expected a car without reverse gear")
        self.at = one_of(self.got["at"], "at", "start", "goal")
        rings = [items(ring, "pieces", 3) for ring in items(self.got["pieces"], "pieces", 1)]
        self.pieces = [[read_point(point, "pieces") for point in ring] for ring in rings]
        names = ("corner", "side", "step", "columns", "rows", "slices")
        grid = members(self.got["grid"], "grid", **dict.fromkeys(names, REQUIRED))
        self.corner = numbers(grid["corner"], "corner", 2)
        self.side, self.step = number(grid["side"], "side"), number(grid["step"], "step")
        self.columns, self.rows, self.slices = (whole(grid[k], k, 1, 1 << 20) for k in names[3:])
        count = self.columns * self.rows * self.slices
        refuse_if(min(self.side, self.step) <= 0, "grid: expected lengths above 0")
        refuse_if(self.slices < 8 or count >= 1 << 28, "grid: too few or too many boxes")
        try:
            stream = zlib.decompressobj()
            packed = base64.b64decode(self.got["boxes"], validate=True)
            self.bits = stream.decompress(packed, (count + 7) // 8 + 1)
        except (binascii.Error, zlib.error, TypeError, ValueError):
            raise BadFileError("boxes: expected base64 of zlib") from None
        refute_if(self.step > 3 * min(self.vehicle.radii), "grid.step: longer than three times the turning radius")
        is_whole = len(self.bits) == (count + 7) // 8 and stream.eof
        refuse_if(not is_whole, "boxes: expected a bit for each box of the grid")

class Spread:
    """What follows the boxes of an answer. Each slice has an integer: bits of rows of `width`, the last ones empty."""

    def __init__(self, answer: Unreached, world: World) -> None:
        self.answer, car, scale = answer, answer.vehicle, world.scale
        back = answer.at == "goal"
        self.radii = car.radii[::-1] if back else car.radii
        half_turn = (lambda tau: tau_sum(tau, None)) if back else (lambda tau: tau)
        ends = [car.axle_at(pose) for pose in (answer.start, answer.goal)]
        self.begin, self.end = (Pose(q.x, q.y, half_turn(q.tau)) for q in (ends[::-1] if back else ends))
        c, s = Pose(ZERO, ZERO, half_turn(car.heading)).rotation

        def of_axle(x: Any, y: Any) -> Point:
            x, y = x - car.axle[0], y - car.axle[1]
            return c * x + s * y, c * y - s * x

        self.robot = [[of_axle(x, y) for x, y in ring] for ring in answer.pieces]
        self.reference, self.bounds = of_axle(ZERO, ZERO), [Fraction(b, scale) for b in world.bounds]
        self.far = max(abs(x) + abs(y) for ring in self.robot for x, y in ring)
        walls = [[(Fraction(x, scale), Fraction(y, scale)) for x, y in p.points] for p in world.walls]
        length = answer.side * max(answer.columns, answer.rows) + answer.step + sum(map(abs, answer.corner))
        self.size = length + self.far + max((abs(x) + abs(y) for ring in walls for x, y in ring), default=ZERO)
        if world.box:
            x0, y0, x1, y1 = (Fraction(b, scale) for b in world.box)
            a, b = -4 * self.size, 4 * self.size
            beyond = ((a, a, x0, b), (x1, a, b, b), (a, a, b, y0), (a, y1, b, b))
            walls += [[(u, v), (w, v), (w, z), (u, z)] for u, v, w, z in beyond]
        self.safe = 16 * self.size * SAFE
        self.unit = math.lcm(2 * answer.side.denominator, *(x.denominator for x in answer.corner))
        self.unit <<= max(0, (math.ceil(4 / self.safe) // self.unit).bit_length())
        self.walls = [self.in_units(ring) for ring in walls]
        self.half = angle_to(None) / answer.slices
        self.turns = math.floor(answer.step / min(self.radii) / (2 * self.half)) + 2
        further = range(-self.turns, self.turns + 1)
        self.steps = {(k, q): self.after(k, q) for k in range(answer.slices) for q in further}
        self.rim = max(abs(x) for boxes in self.steps.values() for box in boxes for x in box)
        self.width = (answer.columns + self.rim + 7) // 8 * 8
        self.full = (1 << answer.columns) - 1
        self.listed = [self.joined([self.listed_row(k, j) for j in range(answer.rows)]) for k in range(answer.slices)]

    def in_units(self, ring: Ring) -> Ring:
        return [(round(x * self.unit), round(y * self.unit)) for x, y in ring]

    def listed_row(self, k: int, j: int) -> int:
        first = (k * self.answer.rows + j) * self.answer.columns
        part = self.answer.bits[first // 8 : (first + self.answer.columns + 7) // 8]
        return int((int.from_bytes(part, "little") >> first % 8) & self.full)

    def joined(self, rows: Sequence[int]) -> int:
        return int.from_bytes(b"".join(row.to_bytes(self.width // 8, "little") for row in rows), "little")

    def landing(self, low: Fraction, high: Fraction, off: Fraction) -> Fractions | None:
        """Rectangle ahead in which a step ends that turns by low to high: its least, most, and half its width."""
        step, (left, right) = self.answer.step, (1 / r for r in self.radii)
        low, high = max(low - SAFE, -step * right), min(high + SAFE, step * left)
        if low > high:
            return None
        most = min(max(step * (left - right) / 2, low), high)
        bend = step * max(left, right) / 2
        wide = max(ZERO, (most + step * right) * (step * left - most) / (2 * (left + right))) + step * bend**3 / 6
        return step * (1 - (bend * bend + off * off) / 2) - wide * off, step + wide * off, wide + step * off

    def meets(self, ahead: Point, box: Fractions, x: Any, y: Any, half: Any) -> bool:
        """Whether a square about (x, y) meets a rectangle ahead of the origin."""
        (c, s), (least, most, wide), reach = ahead, box, half * (abs(ahead[0]) + abs(ahead[1])) + self.safe
        return bool(least - reach <= c * x + s * y <= most + reach and abs(c * y - s * x) <= wide + reach)

    def around(self, ahead: Point, box: Fractions, half: Any) -> list[Fraction]:
        """Bounds x0, x1, y0, y1 of the middles of squares that meet a rectangle."""
        (c, s), (least, most, wide) = ahead, box
        corners = [(c * u - s * v, s * u + c * v) for u in (least, most) for v in (-wide, wide)]
        return [f(p[k] for p in corners) + g * (half + self.safe) for k in (0, 1) for f, g in ((min, -1), (max, 1))]

    def after(self, k: int, q: int) -> list[tuple[int, int]]:
        """Boxes (i, j) of slice k + q that follow box (0, 0) of slice k."""
        side, box = self.answer.side, self.landing(2 * (q - 1) * self.half, 2 * (q + 1) * self.half, self.half + SAFE)
        if box is None:
            return []
        ahead = turned((2 * k + 1 + q) % (2 * self.answer.slices), self.answer.slices)
        x0, x1, y0, y1 = (b / side for b in self.around(ahead, box, side))
        columns, rows = range(math.ceil(x0), math.floor(x1) + 1), range(math.ceil(y0), math.floor(y1) + 1)
        near = ((i, j) for j in rows for i in columns)
        return [(i, j) for i, j in near if self.meets(ahead, box, i * side, j * side, side)]

    def first(self) -> Iterator[tuple[int, int, int]]:
        """Boxes of all poses within a step of travel from the first."""
        side, slices, theta = self.answer.side, self.answer.slices, angle_to(self.begin.tau)
        x, y = self.begin.x - self.answer.corner[0], self.begin.y - self.answer.corner[1]
        most = self.answer.step / min(self.radii) + SAFE
        for q in range(math.floor((theta - most) / (2 * self.half)), math.floor((theta + most) / (2 * self.half)) + 1):
            box = self.landing(2 * q * self.half - theta, 2 * (q + 1) * self.half - theta, self.half / 2 + SAFE)
            if box is None:
                continue
            box = (-box[2], *box[1:])
            middle = (theta + (2 * q + 1) * self.half) / 2
            ahead = turned(round(middle / angle_to(None) * (1 << 62)) % (1 << 63), 1 << 62)
            x0, x1, y0, y1 = self.around(ahead, box, side / 2)
            for j in range(math.floor((y + y0) / side - 1), math.floor((y + y1) / side) + 1):
                for i in range(math.floor((x + x0) / side - 1), math.floor((x + x1) / side) + 1):
                    u, v = (i + Fraction(1, 2)) * side - x, (j + Fraction(1, 2)) * side - y
                    if self.meets(ahead, box, u, v, side / 2):
                        yield q % slices, i, j

    def forbidden(self, k: int) -> int:
        """Boxes of a slice in which every pose is forbidden."""
        answer, slices = self.answer, self.answer.slices
        ends, shrink = (turned(2 * k, slices), turned(2 * k + 2, slices)), turned(1, slices)[0]
        rows = [0] * answer.rows
        for ring in self.robot:
            core = [(-self.far, -self.far), (self.far, -self.far), (self.far, self.far), (-self.far, self.far)]
            for (ax, ay), (bx, by) in edges_of(ring):
                u, v = by - ay, ax - bx
                for c, s in ends:
                    n, reach = (c * u - s * v, s * u + c * v), u * ax + v * ay
                    reach = min(reach, reach * shrink) - (answer.side / 2 + self.safe) * (abs(n[0]) + abs(n[1]))
                    core = cut(core, n, reach)
            shape = [(-x, -y) for x, y in self.in_units(core)]
            for wall in self.walls if shape else ():
                self.fill(rows, convex_hull((x + a, y + b) for x, y in wall for a, b in shape))
        if self.bounds:
            self.fill_beyond(rows, [(c, s) for c, s in ends], shrink)
        return self.joined(rows)

    def fill(self, rows: list[int], hull: Ring) -> None:
        """Add the boxes with their middles inside a convex polygon."""
        side, middle = self.answer.side * self.unit, self.answer.side / 2
        d, x0, y0 = int(side), *(int((x + middle) * self.unit) for x in self.answer.corner)
        low, high = min(y for _, y in hull), max(y for _, y in hull)
        sides = [(p, q) for p, q in edges_of(hull) if p[1] != q[1]]
        for j in range(max(0, (low - y0) // d + 1), min(len(rows), -((y0 - high) // d))):
            y, begin, end = y0 + j * d, 0, self.answer.columns
            for (ax, ay), (bx, by) in sides:
                if ay <= y <= by:  # on the right
                    end = min(end, -(-((ax - x0) * (by - ay) + (y - ay) * (bx - ax)) // (d * (by - ay))))
                if by <= y <= ay:
                    begin = max(begin, ((ax - x0) * (by - ay) + (y - ay) * (bx - ax)) // (d * (by - ay)) + 1)
            if begin < end:
                rows[j] |= (1 << end) - (1 << begin)

    def fill_beyond(self, rows: list[int], ends: list[Point], shrink: Fraction) -> None:
        """Add the boxes with the reference point out of the bounds."""
        (x, y), answer, more = self.reference, self.answer, self.answer.side / 2 + self.safe
        arms = [(c * x - s * y, s * x + c * y) for c, s in ends]
        limits = []
        for axis in (0, 1):
            least, most = (f(arm[axis] for arm in arms) for f in (min, max))
            least, most = min(least, least / shrink) - more, max(most, most / shrink) + more
            limits.append((self.bounds[axis] - most, self.bounds[axis + 2] - least))
        for j in range(answer.rows):
            height = answer.corner[1] + (j + Fraction(1, 2)) * answer.side
            if not limits[1][0] <= height <= limits[1][1]:
                rows[j] = self.full
                continue
            begin, end = ((limit - answer.corner[0]) / answer.side - Fraction(1, 2) for limit in limits[0])
            begin, end = (min(max(k, 0), answer.columns) for k in (math.ceil(begin), math.floor(end) + 1))
            rows[j] |= self.full ^ ((1 << end) - (1 << begin) if begin < end else 0)

    def check(self) -> None:
        answer, width = self.answer, self.width
        near = []
        for x, low in zip((self.end.x, self.end.y), answer.corner, strict=True):
            near.append({math.floor((x - low + by) / answer.side) for by in (-self.safe, self.safe)})
        counts = zip(near, (answer.columns, answer.rows), strict=True)
        beyond = any(not 0 <= i < count for axis, count in counts for i in axis)
        angle = angle_to(self.end.tau)
        for k in {math.floor((angle + by) / (2 * self.half)) % answer.slices for by in (-SAFE, SAFE)}:
            for i in near[0]:
                for j in near[1]:
                    within = 0 <= i < answer.columns and 0 <= j < answer.rows
                    refute_if(within and self.listed[k] >> (j * width + i) & 1, "a listed box holds the other end")
        follow = [0] * answer.slices
        for k, i, j in self.first():
            refute_if(not (0 <= i < answer.columns and 0 <= j < answer.rows), "the first step leaves the grid")
            follow[k] |= 1 << (j * width + i)
        for (k, q), boxes in self.steps.items():
            for i, j in boxes if self.listed[k] else ():
                by, there = j * width + i, (k + q) % answer.slices
                follow[there] |= self.listed[k] << by if by >= 0 else self.listed[k] >> -by
        inner = (1 << max(0, answer.columns - 2 * self.rim)) - 1 << self.rim
        kept = [inner if self.rim <= j < answer.rows - self.rim else 0 for j in range(answer.rows)]
        rim = self.joined([self.full ^ row for row in kept])
        grid = self.joined([self.full] * answer.rows)
        leaves = any(boxes & rim for boxes in self.listed)
        refute_if(leaves and beyond, "a step may leave the grid, and the other end is beyond")
        for k, listed in enumerate(self.listed):
            left = (follow[k] | rim * leaves) & grid & ~listed
            wrong = left and left & ~self.forbidden(k)
            refute_if(wrong, f"a box of slice {k} follows, and is neither listed nor forbidden")

def cut(ring: Ring, normal: Point, reach: Fraction) -> Ring:
    """The part of a convex polygon with normal . p <= reach."""
    over = [dot(normal, p) - reach for p in ring]
    part: Ring = []
    for k, (p, u) in enumerate(zip(ring, over, strict=True)):
        q, v = ring[k - len(ring) + 1], over[k - len(ring) + 1]
        part += [p] * (u <= 0)
        if u * v < 0:
            part.append((p[0] + u / (u - v) * (q[0] - p[0]), p[1] + u / (u - v) * (q[1] - p[1])))
    return part

def area(ring: Ring) -> Any:
    """Twice the area."""
    return sum((cross(p, q) for p, q in edges_of(ring)), ZERO)

def check_unreached(answer: Unreached, scene: Scene) -> str:
    """Sentence that states the result."""
    world = World(scene)
    for ring in answer.pieces:
        left, hull = area(ring), convex_hull(ring)
        refute_if(area(hull) != left or len(hull) != len(ring), "a piece is not convex")
        for part in world.robot:
            rest = [(x * world.scale, y * world.scale) for x, y in ring]
            for (ax, ay), (bx, by) in edges_of(part.points):
                rest = cut(rest, (by - ay, ax - bx), (by - ay) * ax + (ax - bx) * ay)
            left -= area(rest) / world.scale**2
        refute_if(left != 0, "a piece is not inside the robot")
    answer.check_moved(world)
    check_pose(world, answer.start, "start")
    check_pose(world, answer.goal, "goal")
    Spread(answer, world).check()
    return f"No path of {answer.vehicle.text} leads from {answer.end('start')} to {answer.end('goal')}."

# === The command ===
def verdict(scene: str, answer: str) -> tuple[int, str]:
    """Check the texts of two files; return an exit code, and a line that states the result or the fault."""
    try:
        world, data = read_scene(decoded(scene)), decoded(answer)
        kinds: dict[str, type[PathAnswer | Proof | Held | Unreached]] = {
            "path": PathAnswer, "separated": Proof, "stuck": Held, "unreachable": Unreached
        }  # fmt: skip
        parsed = kinds[one_of(data.get("answer") if isinstance(data, dict) else None, "answer", *kinds)](data)
        part = parsed.check_asked(world)
        is_path = isinstance(parsed, PathAnswer)
        refuse_if(world.is_round and not is_path, "a proof among round shapes; `cfree verify` reads it")
        if isinstance(parsed, Held):
            proved = check_held(parsed, part)
        elif isinstance(parsed, Unreached):
            proved = check_unreached(parsed, part)
        else:
            proved = check_path(parsed, world, part) if isinstance(parsed, PathAnswer) else check_proof(parsed, part)
        return VERIFIED, f"{proved} verified"
    except RefutedError as error:
        return REFUTED, f"REFUTED: {error}"
    except BadFileError as error:
        return UNREADABLE, f"cannot be read: {error}"

def main(names: list[str]) -> int:
    try:
        scene, answer = (Path(name).read_text(encoding="utf-8-sig") for name in names)
        code, said = verdict(scene, answer)
    except (OSError, ValueError) as error:
        code, said = UNREADABLE, f"{error}; give two files, a scene and an answer"
    try:
        print(said, flush=True)
    except OSError as error:  # a closed pipe, a full disk: 1 would mean refuted
        with contextlib.suppress(OSError):
            sys.stderr.write(f"standard output: {error}\n")
        sys.stdout = sys.stderr = None
        return UNREADABLE
    return code

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
