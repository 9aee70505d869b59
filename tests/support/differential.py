"""Compare the core's predicates with those of `reference`, one random query after another."""

from __future__ import annotations

import math
import random
from collections import Counter
from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cmp_to_key
from itertools import pairwise
from typing import Any

from cfree import _core
from cfree.exact.number import to_fraction
from cfree.scene.features import unpacked
from hard_scenes import Rings
from reference import (
    EDGE_EDGE,
    EDGE_VERTEX,
    VERTEX_EDGE,
    VERTEX_VERTEX,
    Angle,
    Feature,
    Junction,
    Predicates,
    Shape,
    rational,
    same_feature,
    sign_at,
)
from reference_features import LARGEST_BITS, SceneFeatures, ShapeFeatures

Event = tuple[int, int, float, float, int]
Sample = tuple[float, tuple[int, int] | None]
FIRST_WALL: Event = (0, 0, -1.0, -1.0, -1)
LAST_WALL: Event = (0, 0, 1.0, 1.0, -1)


def pack(feature: Sequence[int]) -> int:
    kind, robot, obstacle = feature
    return kind << 61 | robot << 31 | obstacle


def value(sample: Sample) -> Fraction:
    tau, fine = sample
    return Fraction(tau) if fine is None else Fraction(fine[0], 2 ** fine[1])


def prepared(rings: Rings) -> tuple[ShapeFeatures, ShapeFeatures]:
    """Both shapes with integer coordinates, as in `scene_features`; every ring with the diagonals of its fan."""
    numbers = [to_fraction(c) for part in rings for ring in part for p in ring for c in p]
    scale = math.lcm(*(x.denominator for x in numbers))
    both = ShapeFeatures(scale), ShapeFeatures(scale)
    for features, part in zip(both, rings, strict=True):
        for ring in part:
            first, n = len(features.vertices), len(ring)
            points = [(int(to_fraction(x) * scale), int(to_fraction(y) * scale)) for x, y in ring]
            columns = {"convex": [True], "emit": [True], "layer": [0], "owner_polygon": [0], "owner_vertex": [0]}
            features.add_ring(points, **{name: column * n for name, column in columns.items()})
            for k in range(1, n - 1):
                features.add_piece([first, first + k, first + k + 1], 0)
    widest = max(abs(c) for features in both for p in features.vertices for c in p)
    for features in both:
        features.shift = max(0, widest.bit_length() - LARGEST_BITS)
    return both


class Surface:
    """One surface of a scene in one chart, for the core and for the reference."""

    def __init__(self, rings: Rings, contact: Feature, chart: int) -> None:
        self.rings, self.contact, self.chart = rings, contact, chart
        robot, obstacles = prepared(rings)
        self.shift = robot.shift
        self.core = _core.Predicates(SceneFeatures(robot, obstacles, robot.scale, None).core, pack(contact), chart)
        self.shapes = [
            Shape(s.vertices, list(zip(s.v.tolist(), s.w.tolist(), strict=True))) for s in (robot, obstacles)
        ]
        self.reference = Predicates(*self.shapes, contact, chart)
        self.angles: dict[Event, Angle] = {}

    def __repr__(self) -> str:
        return f"Surface({self.rings}, {self.contact}, {self.chart})"

    def angle(self, event: Event) -> Angle:
        """Exact angle that an event of the core stands for."""
        if event not in self.angles:
            first, second, lo, hi, _ = event
            features = Feature(*unpacked(first)), Feature(*unpacked(second))
            roots = self.reference.roots_within(*features, Fraction(lo), Fraction(hi))
            place = self.core.place(event)
            assert len(roots) == 1 if place == 0 else place <= len(roots), (event, place, roots)
            self.angles[event] = angle = roots[place - 1] if place else roots[0]
            assert self.reference.place(angle, *features, Fraction(lo), Fraction(hi)) == place
            # the columns of a file suffice to restore it
            again = self.core.restored((first, second, lo, hi, -1), place)
            assert self.core.order(event, again) == 0 or not first
        return self.angles[event]

    def check_roots(self, events: list[Event], expected: list[Angle]) -> list[Event]:
        assert [self.angle(event) for event in events] == expected, (events, expected)
        return events

    def poles(self, curve: Feature) -> list[Event] | None:
        """Zeros of a curve's denominator; None if it is zero everywhere."""
        if self.reference.curve(curve)[1] == 0:
            return None
        if curve.kind in (self.contact.kind, VERTEX_VERTEX):
            return []
        on_edge = curve.kind == EDGE_VERTEX
        g, f = (curve.robot, self.contact.obstacle) if on_edge else (self.contact.robot, curve.obstacle)
        return self.core.parallel_roots(g, f, FIRST_WALL, LAST_WALL)[0]

    def spans(self, p: Feature, q: Feature) -> list[tuple[Event, Event]]:
        """The parts of the chart where both curves are finite."""
        poles = [self.poles(p), self.poles(q)]
        if None in poles:
            return []
        return list(pairwise(self.sorted([FIRST_WALL, LAST_WALL, *poles[0], *poles[1]])))

    def sorted(self, events: Sequence[Event]) -> list[Event]:
        """Different angles in order, one event each."""
        ordered = sorted(events, key=cmp_to_key(lambda x, y: self.angle(x).compare(self.angle(y))))
        return ordered[:1] + [y for x, y in pairwise(ordered) if self.angle(x) < self.angle(y)]

    # --- one predicate each; the arguments hold the whole query ---

    def check_offset(self, s: int, v: int, samples: Sequence[Sample], from_: Event, to: Event) -> list[Event]:
        f, true = self.core.offset(s, v), self.reference.offset(s, v)
        self.check_filtered(f, true, from_, to)
        for sample in samples:
            expected = self.reference.offset_sign(s, v, value(sample))
            assert self.core.offset_sign(s, v, sample) == expected, ("offset_sign", s, v, sample)
        events, all_zero = self.core.offset_roots(s, v, from_, to)
        expected, zero = self.reference.offset_roots(s, v, self.angle(from_), self.angle(to))
        assert all_zero == zero, ("offset_roots", s, v)
        return self.check_roots(events, expected)

    def check_parallel(self, g: int, f: int, samples: Sequence[Sample], from_: Event, to: Event) -> list[Event]:
        self.check_filtered(self.core.parallel(g, f), self.reference.parallel(g, f), from_, to)
        for sample in samples:
            expected = self.reference.parallel_sign(g, f, value(sample))
            assert self.core.parallel_sign(g, f, sample) == expected, ("parallel_sign", g, f, sample)
        events, _ = self.core.parallel_roots(g, f, from_, to)
        return self.check_roots(events, self.reference.parallel_roots(g, f, self.angle(from_), self.angle(to))[0])

    def check_filtered(self, f: Sequence[float], true: Any, from_: Event, to: Event) -> None:
        """Check that doubles are as near to the exact values as claimed, at every knot; a certain sign is right."""
        a, b, c, err = f
        knots = sorted({-1.0, 1.0, from_[2], from_[3], to[2], to[3]})
        scale = Fraction(1, 4**self.shift)
        if all(map(math.isfinite, f)):
            for p in knots:
                for q in knots:
                    polar = a * (1 + p * q) + b * (1 - p * q) + c * (p + q)
                    x, y = Fraction(p), Fraction(q)
                    exact = int(true[0]) + int(true[1]) * (x + y) / 2 + int(true[2]) * x * y
                    assert abs(Fraction(polar) - exact * scale) <= Fraction(err), ("bound", f, p, q)
        lo, hi = from_[2], to[3]
        certain = self.core.sign_on(tuple(f), lo, hi)
        if certain:
            assert certain == self.reference.sign_on(true, Fraction(lo), Fraction(hi)), ("sign_on", f, lo, hi)

    def check_cross(self, of_robot: bool, e: int, f: int) -> None:
        expected = self.reference.cross_sign(of_robot, e, f)
        assert self.core.cross_sign(of_robot, e, f) == expected, ("cross_sign", of_robot, e, f)

    def check_code(self, x: Feature, y: Feature) -> None:
        same = self.core.code(pack(x)) == self.core.code(pack(y))
        assert same == same_feature(*self.shapes, x, y), ("code", x, y)

    def check_range_end(self, g: int, f: int, is_start: bool) -> None:
        chart, event = self.core.range_end(g, f, is_start)
        true_chart, angle = self.reference.range_end(g, f, is_start)
        assert chart == true_chart, ("range_end", g, f, is_start, chart)
        assert self.angle(event) == angle, ("range_end", g, f, is_start, event)

    def check_order(self, x: Event, y: Event) -> int:
        expected = self.reference.order(self.angle(x), self.angle(y))
        assert self.core.order(x, y) == expected, ("order", x, y, expected)
        return expected

    def check_order_at(self, x: Event, sample: Sample) -> None:
        expected = self.reference.order(self.angle(x), value(sample))
        assert self.core.order(x, sample) == expected, ("order", x, sample, expected)

    def check_between(self, x: Event, y: Event, attempt: int) -> Sample:
        sample = self.core.between(x, y, attempt)
        tau = value(sample)
        assert self.angle(x).compare(Angle.of(tau)) < 0 < self.angle(y).compare(Angle.of(tau)), (
            "between",
            x,
            y,
            sample,
        )
        return sample

    def check_compare(self, p: Feature, q: Feature, from_: Event, to: Event) -> list[Event]:
        """Check on an interval where the denominators of both curves have a sign; they are flipped to be positive."""
        start, end = self.angle(from_), self.angle(to)
        middle = self.reference.between(start, end)
        flipped = [self.reference.curve(x)[1](rational(middle)) < 0 for x in (p, q)]
        events, signs, strict = self.core.compare(pack(p), flipped[0], pack(q), flipped[1], from_, to)
        cuts, true = self.reference.compare(p, q, start, end)
        self.check_roots(events, cuts)
        assert signs == true, ("compare", p, q, from_, to, events, signs, true)
        if strict:  # also at the ends
            difference = self.reference.polynomial(p, q)
            assert sign_at(difference, start) != 0 != sign_at(difference, end), ("strict", p, q, from_, to)
        sample = self.core.between(from_, to, 1)
        assert self.core.order_at(pack(p), pack(q), sample) == self.reference.order_at(p, q, value(sample)), (
            "order_at",
            p,
            q,
            sample,
        )
        return events


# --- random queries ---


def samples_near(surface: Surface, events: Sequence[Event], rng: random.Random) -> Iterator[Sample]:
    yield from ((tau, None) for tau in (0.0, -1.0, 1.0, rng.uniform(-1, 1), rng.choice([-1, 1]) * rng.random() ** 20))
    for event in rng.sample(events, min(2, len(events))):
        lo, hi = event[2:4]
        for tau in (lo, hi, math.nextafter(lo, -2), math.nextafter(hi, 2), (lo + hi) / 2):
            if -1 <= tau <= 1:
                yield tau, None
        angle = surface.angle(event)
        for bits in (60, rng.randint(70, 400)):  # just before and after the root
            below = math.floor((angle.lo + angle.hi) / 2 * 2**bits)
            for n in (below, below + 1):
                if abs(n) <= 2**bits:
                    yield Fraction(n, 2**bits).__float__(), (n, bits)


def ask(surface: Surface, rng: random.Random, queries: int = 12) -> int:
    """Query every predicate some times; return the number of queries. An AssertionError names the wrong answer."""
    A, O = surface.shapes
    on_edge = surface.contact.kind == VERTEX_EDGE
    events, asked = [FIRST_WALL, LAST_WALL], 0

    def vertex(shape: Shape) -> int:
        return rng.randrange(len(shape.vertices))

    def edge(shape: Shape) -> int:
        return rng.randrange(len(shape.edges))

    def any_feature(kind: int) -> Feature:
        i = vertex(A) if kind in (VERTEX_EDGE, VERTEX_VERTEX) else edge(A)
        return Feature(kind, i, vertex(O) if kind in (EDGE_VERTEX, VERTEX_VERTEX) else edge(O))

    def any_curve() -> Feature:
        kind = rng.choice([VERTEX_EDGE, EDGE_VERTEX, VERTEX_VERTEX])
        i, j = surface.contact.robot, surface.contact.obstacle
        if kind == VERTEX_EDGE:
            return Feature(kind, i if on_edge and rng.random() < 0.2 else vertex(A), edge(O))
        if kind == EDGE_VERTEX:
            return Feature(kind, edge(A), vertex(O) if on_edge or rng.random() < 0.8 else j)
        return Feature(kind, i, rng.choice(O.edges[j])) if on_edge else Feature(kind, rng.choice(A.edges[i]), j)

    def some_span() -> tuple[Event, Event]:
        if rng.random() < 0.3:
            return FIRST_WALL, LAST_WALL
        ordered = surface.sorted(events)
        k = rng.randrange(len(ordered) - 1)
        m = k + 1 if rng.random() < 0.5 else rng.randrange(k + 1, len(ordered))
        return ordered[k], ordered[m]

    def part_of(span: tuple[Event, Event]) -> tuple[Event, Event]:
        start, end = map(surface.angle, span)
        inside = [x for x in surface.sorted(events) if start < surface.angle(x) and surface.angle(x) < end]
        ends = [span[0], *inside, span[1]]
        k, m = sorted(rng.sample(range(len(ends)), 2))
        return ends[k], ends[m]

    for _ in range(queries):
        s, v, g, f = vertex(A), vertex(O), edge(A), edge(O)
        samples = list(samples_near(surface, events, rng))
        events += surface.check_offset(s, v, samples, *some_span())
        events += surface.check_parallel(g, f, samples, *some_span())
        surface.check_cross(True, g, edge(A))
        surface.check_cross(False, f, edge(O))
        for kind in (VERTEX_EDGE, EDGE_VERTEX, VERTEX_VERTEX, EDGE_EDGE) * 2:
            x, other = any_feature(kind), any_feature(kind)  # one of the two features the same
            surface.check_code(x, x._replace(**rng.choice([{"robot": other.robot}, {"obstacle": other.obstacle}])))
        surface.check_range_end(g, f, rng.random() < 0.5)
        for sample in samples:
            surface.check_order_at(rng.choice(events), sample)
        for _ in range(4):
            x, y = rng.choice(events), rng.choice(events)
            near = [z for z in events if z != x and z[2] <= x[3] and x[2] <= z[3]]
            if near and rng.random() < 0.7:
                y = rng.choice(near)
            order = surface.check_order(x, y)
            if order:
                surface.check_between(*((x, y) if order < 0 else (y, x)), rng.randrange(40))
        asked += 3 * len(samples) + 25
        for _ in range(2):
            p, q = any_curve(), any_curve()
            spans = surface.spans(p, q)
            if spans:
                span = rng.choice(spans)
                events += surface.check_compare(p, q, *(part_of(span) if rng.random() < 0.5 else span))
                asked += 1
            assert surface.core.vanishes(pack(p), pack(q)) == (surface.reference.polynomial(p, q) == 0)
        events = [*rng.sample(events, min(len(events), 14)), FIRST_WALL, LAST_WALL]
    return asked


def ask_junctions(surface: Surface, rng: random.Random, queries: int = 20) -> Counter[str]:
    """Query several lines at some critical angles of a surface; count the answers to each question."""
    A, O = surface.shapes
    vertices, edges = (range(len(A.vertices)), range(len(O.vertices))), (range(len(A.edges)), range(len(O.edges)))
    asked: Counter[str] = Counter()

    def any_line() -> Feature:
        if rng.random() < 0.5:
            return Feature(VERTEX_EDGE, rng.choice(vertices[0]), rng.choice(edges[1]))
        return Feature(EDGE_VERTEX, rng.choice(edges[0]), rng.choice(vertices[1]))

    def curve_on(s: Feature) -> Feature:
        """Another surface, or one of the two helices at its ends."""
        if rng.random() < 0.6:
            return any_line()
        if s.kind == VERTEX_EDGE:
            return Feature(VERTEX_VERTEX, s.robot, rng.choice(O.edges[s.obstacle]))
        return Feature(VERTEX_VERTEX, rng.choice(A.edges[s.robot]), s.obstacle)

    events = [FIRST_WALL, LAST_WALL]
    events += surface.core.offset_roots(rng.choice(vertices[0]), rng.choice(vertices[1]), FIRST_WALL, LAST_WALL)[0]
    g, f = rng.choice(edges[0]), rng.choice(edges[1])
    meet = [Feature(VERTEX_EDGE, A.edges[g][0], f), Feature(EDGE_VERTEX, g, O.edges[f][0])]  # one line where parallel
    events += surface.core.parallel_roots(g, f, FIRST_WALL, LAST_WALL)[0] * 3
    for _ in range(6):
        p, q = curve_on(surface.contact), curve_on(surface.contact)
        for span in surface.spans(p, q):
            events += surface.check_compare(p, q, *span)
    for event in rng.sample(events, min(len(events), 3)):
        true = Junction(*surface.shapes, surface.chart, surface.angle(event))
        core = _core.Junction(surface.core, event, rng.random() < 0.5)
        lines = [surface.contact, *meet, any_line(), any_line()]

        def check(name: str, mine: int, expected: int, *about: object, where: Event = event) -> int:
            assert mine == expected, (name, where, *about, mine, expected)
            asked[f"{name} {expected}"] += 1
            return expected

        beside = Surface(surface.rings, rng.choice(lines), surface.chart)
        other = beside.core.offset_roots(rng.choice(vertices[0]), rng.choice(vertices[1]), FIRST_WALL, LAST_WALL)[0]
        for another in [*other, *beside.core.parallel_roots(g, f, FIRST_WALL, LAST_WALL)[0], LAST_WALL]:
            expected = surface.angle(event).compare(beside.angle(another))
            check("order of angles", _core.order(surface.core, event, beside.core, another), expected, beside, another)
        for _ in range(queries):
            x, y = rng.choice(lines), rng.choice([*lines, any_line()])
            one_line = False
            check("turn", core.turn(pack(x), pack(y)), true.turn(x, y), x, y)
            if check("parallel", core.parallel(pack(x), pack(y)), true.parallel(x, y), x, y):
                side = check("side", core.side(pack(x), pack(y)), true.side(x, y), x, y)
                low, high = core.offset(pack(x), pack(y))
                assert (low <= 0 or side > 0) and (high >= 0 or side < 0), ("offset", event, x, y, low, high, side)
                one_line = side == 0
            a, b = rng.choice(vertices[0]), rng.choice(vertices[1])
            check("side_of_helix", core.side_of_helix(pack(x), a, b), true.side_of_helix(x, a, b), x, a, b)
            c, d = curve_on(x), curve_on(x)
            p, q = true.place(x, c), true.place(x, d)
            if p is None or q is None:
                continue
            first, last = (pack(x), pack(c)), (pack(x), pack(d))
            z = rng.choice(lines)
            same = true.same_place(p, q)
            check("is_same_curve", _core.is_same_curve(surface.core, first, last), same, x, c, d)
            check("lies_on", _core.lies_on(surface.core, first, pack(z)), true.lies_on(p, z), x, c, z)
            check("side_of_place", core.side_of_place(pack(z), first), true.side_of_place(z, p), z, x, c)
            order = check("order", core.order(pack(x), first, last), true.order(x, p, q), x, c, d)
            low, high = core.range(pack(x), first)
            for t, beyond in ((low, 1), (high, -1)):
                assert math.isinf(t) or true.order_to(x, p, Fraction(t)) in (0, beyond), (
                    "range",
                    event,
                    x,
                    c,
                    low,
                    high,
                )
            asked["range"] += math.isfinite(low) and high - low < 1e-6
            value = true.value(x, p)
            if abs(value) < 2:  # on the patch, and a little beyond
                error = abs(Fraction(core.value(pack(x), first)) - value)
                assert error < Fraction(1, 2**30), ("value", event, x, c)
            if one_line:
                check("order", core.order(pack(y), first, last), true.order(y, p, q), y, x, c, d)
                if order and true.is_on_patch(x, p) and true.is_on_patch(x, q):
                    for after in (False, True):
                        mine = core.across(pack(x), pack(y), first, last, after)
                        check("across", mine, true.across(x, y, p, q, after), x, y, c, d, after)
    return asked


def random_surface(rings: Rings, rng: random.Random) -> Surface:
    """A surface of a ring vertex and a ring edge; the first ones often, as some families are made around them."""
    n, m = (1 if rng.random() < 0.5 else sum(map(len, part)) for part in rings)
    contact = Feature(rng.choice([VERTEX_EDGE, EDGE_VERTEX]), rng.randrange(n), rng.randrange(m))
    return Surface(rings, contact, rng.randint(0, 1))
