"""The core's predicates and polynomials against their references in Python."""

from __future__ import annotations

import math
import random
from collections import Counter
from fractions import Fraction
from typing import Any

import pytest
from flint import fmpz_poly
from hypothesis import given, settings
from hypothesis import strategies as st

from cfree import _core
from differential import FIRST_WALL, LAST_WALL, Event, Surface, ask, ask_junctions, pack, random_surface
from hard_scenes import FAMILIES, Ring, Rings, distinct
from reference import (
    EDGE_VERTEX,
    VERTEX_EDGE,
    VERTEX_VERTEX,
    Angle,
    Feature,
    rational,
    real_roots,
    sign_after,
    sign_at,
    sign_before,
)

TRIANGLE: Ring = [(0, 0), (3, 0), (1, 2)]
BOX: Ring = [(0, 0), (2, 0), (2, 1), (0, 1)]

# --- examples ---


def test_an_edge_is_parallel_to_another_at_the_angle_between_them() -> None:
    # E_0 = (2, 1) turns into (3, 0) at tan(theta) = -1/2: tau = 2 - sqrt(5)
    surface = Surface(Rings([[(0, 0), (2, 1), (0, 2)]], [TRIANGLE]), Feature(VERTEX_EDGE, 0, 0), 0)
    (event,), _ = surface.core.parallel_roots(0, 0, FIRST_WALL, LAST_WALL)
    assert surface.angle(event).polynomial == fmpz_poly([-1, -4, 1])
    assert event[2] < 2 - math.sqrt(5) < event[3]


@pytest.mark.parametrize("epsilon", [Fraction(1, n) for n in (2**30, 2**110, 10**100, 2**1000)])
def test_a_double_root_moved_by_nearly_nothing_is_two_or_none(epsilon: Fraction) -> None:
    # a_1 runs on a circle of radius 5 about a_0, which is on the x-axis; b_2 is at height 5
    def roots(height: Any) -> tuple[Surface, list[Event]]:
        surface = Surface(
            Rings([[(0, 0), (3, 4), (0, 1)]], [[(0, 0), (1, 0), (0, height)]]), Feature(VERTEX_EDGE, 0, 0), 0
        )
        return surface, surface.check_offset(1, 2, [(1 / 3, None), (0.3, None)], FIRST_WALL, LAST_WALL)

    surface, (touch,) = roots(5)
    assert surface.angle(touch).lo == Fraction(1, 3)
    assert roots(5 + epsilon)[1] == []
    surface, (first, second) = roots(5 - epsilon)
    close = epsilon < Fraction(1, 2**106)
    assert (surface.core.place(first), surface.core.place(second)) == ((1, 2) if close else (0, 0))
    assert surface.check_order(first, second) == -1
    at = surface.check_between(first, second, 0)
    others = [surface.check_between(first, second, attempt) for attempt in range(40)]
    assert len(set(others)) == 40
    assert (at[1] is not None) == close
    surface.check_offset(1, 2, [at], FIRST_WALL, LAST_WALL)
    surface.check_order_at(first, at)
    surface.check_order_at(second, at)


@pytest.mark.parametrize("contact", [Feature(VERTEX_EDGE, 0, 0), Feature(EDGE_VERTEX, 0, 0)])
@pytest.mark.parametrize("chart", [0, 1])
def test_one_line_both_ways_is_one_curve(contact: Feature, chart: int) -> None:
    # edges 1 and 7 are the one that two boxes share
    beside: Ring = [(2, 0), (4, 0), (4, 1), (2, 1)]
    surface = Surface(Rings([BOX, beside], [BOX, beside]), contact, chart)
    for i in range(8):
        for p, q in (
            (Feature(VERTEX_EDGE, i, 1), Feature(VERTEX_EDGE, i, 7)),
            (Feature(EDGE_VERTEX, 1, i), Feature(EDGE_VERTEX, 7, i)),
        ):
            spans = surface.spans(p, q)
            assert spans
            assert not any(surface.check_compare(p, q, *span) for span in spans)
            assert surface.core.vanishes(pack(p), pack(q))


def test_a_wall_is_ordered_against_samples() -> None:
    surface = Surface(Rings([TRIANGLE], [BOX]), Feature(VERTEX_EDGE, 0, 0), 0)
    for wall in (FIRST_WALL, LAST_WALL):
        for tau in (-1.0, math.nextafter(-1, 0), 0.0, math.nextafter(1, 0), 1.0):
            surface.check_order_at(wall, (tau, None))
        surface.check_order_at(wall, (0.0, (1, 80)))


def test_a_scene_beyond_doubles_is_decided() -> None:
    # as integers, coordinates of 1,100 ones
    height = 1 - Fraction(1, 2**1100)
    surface = Surface(Rings([TRIANGLE], [[(0, 0), (2, 0), (0, height)]]), Feature(VERTEX_EDGE, 0, 1), 1)
    assert ask(surface, random.Random(1)) > 100


def test_a_root_next_to_a_parallel_is_another_though_the_opposite_of_the_parallel_is_a_root() -> None:
    # the helix meets the line at theta = pi and where tan(theta / 2) = epsilon; E_2 is antiparallel to it at 0
    epsilon = Fraction(1, 2**60)
    robot: Ring = [(0, 0), (1, -epsilon), (3, 1), (0, 1)]
    surface = Surface(Rings([robot], [[(0, 0), (1, 0), (0, epsilon)]]), Feature(VERTEX_EDGE, 0, 0), 0)
    (root,) = surface.check_offset(1, 2, [], FIRST_WALL, LAST_WALL)
    (parallel,) = surface.check_parallel(2, 0, [], FIRST_WALL, LAST_WALL)
    assert (surface.angle(root).lo, surface.angle(parallel).lo) == (epsilon, 0)
    assert surface.check_order(parallel, root) == -1 == -surface.check_order(root, parallel)


@pytest.mark.parametrize("epsilon", [Fraction(1, 2**40), Fraction(1, 2**200)])
def test_a_place_is_found_on_a_line_next_to_where_it_is_at_infinity(epsilon: Fraction) -> None:
    # a_0 is on f_0 and on f_2, which slopes by epsilon and crosses f_0 a unit before b_0; g_0, of two units, is on b_0.
    # Where g_0 is parallel to f_2, an epsilon away, the place on it is at infinity; some epsilons away it is about b_0.
    def turned(x: Any, y: Any) -> tuple[Any, Any]:
        return 4 * x - 3 * y, 3 * x + 4 * y

    obstacle: Ring = [turned(0, 0), turned(1, 0), turned(1, 2 * epsilon), turned(-1, 0)]
    on_edge, on_vertex, slope = Feature(VERTEX_EDGE, 0, 0), Feature(EDGE_VERTEX, 0, 0), Feature(VERTEX_EDGE, 0, 2)
    surface = Surface(Rings([[(0, 0), (10, 0), (0, 1)]], [obstacle]), on_edge, 0)
    (parallel,), _ = surface.core.parallel_roots(0, 0, FIRST_WALL, LAST_WALL)
    junction = _core.Junction(surface.core, parallel, False)
    assert junction.side(pack(on_edge), pack(on_vertex)) == 0
    assert junction.value(pack(on_vertex), (pack(on_edge), pack(slope))) == pytest.approx(1 / 2, abs=1e-9)


def test_bounds_hold_where_products_underflow() -> None:
    # one far vertex, so that the core's doubles of the others are about 2^-535
    for number in range(40):
        rng = random.Random(number)

        def ring(*far: Any, rng: random.Random = rng) -> Ring:
            return [(rng.getrandbits(30), rng.getrandbits(30)) for _ in range(4)] + list(far)

        kind = rng.choice([VERTEX_EDGE, EDGE_VERTEX])
        surface = Surface(Rings([ring()], [ring((2**664 - 1, 0))]), Feature(kind, 0, 0), 0)
        for k in range(4):
            surface.check_offset(k, 3 - k, [(0.3, None)], FIRST_WALL, LAST_WALL)
            surface.check_parallel(k, k % 3, [(0.3, None)], FIRST_WALL, LAST_WALL)


# --- families of hard scenes ---


@pytest.mark.slow
@pytest.mark.parametrize("family", FAMILIES)
def test_the_core_and_the_reference_agree(family: str) -> None:
    for number in range(8):
        rng = random.Random(f"{family} {number}")
        assert ask(random_surface(distinct(FAMILIES[family](rng)), rng), rng, 6) > 100


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("family", FAMILIES)
def test_the_core_and_the_reference_agree_where_several_surfaces_meet(family: str) -> None:
    asked: Counter[str] = Counter()
    for number in range(3):
        rng = random.Random(f"{family} {number}")
        asked += ask_junctions(random_surface(distinct(FAMILIES[family](rng)), rng), rng)
    assert asked["side 0"] and asked["order 0"] + asked["side_of_place 0"]


@st.composite
def small_rings(draw: st.DrawFn) -> Rings:
    """Small integer coordinates, some of them an ulp or much less away."""
    near = st.sampled_from([0, 0, 0, 0, 2.0**-52, -(2.0**-53), 1e-100])
    number = st.builds(lambda n, e: n + Fraction(e), st.integers(-2, 2), near)
    ring = st.lists(st.tuples(number, number), min_size=3, max_size=4, unique=True)
    return Rings([draw(ring)], draw(st.lists(ring, min_size=1, max_size=2)))


@pytest.mark.slow
@settings(max_examples=60)
@given(small_rings(), st.sampled_from([VERTEX_EDGE, EDGE_VERTEX]), st.integers(0, 1), st.integers(0, 99))
def test_the_core_and_the_reference_agree_on_small_scenes(rings: Rings, kind: int, chart: int, seed: int) -> None:
    ask(Surface(rings, Feature(kind, 0, 0), chart), random.Random(seed), 2)


# --- images of a scene ---

SAMPLES = [k / 8 for k in range(-8, 9)] + [math.nextafter(0, 1), 1 / 3, math.nextafter(1, 0)]


def decisions(surface: Surface, *, mirrored: bool = False) -> list[Any]:
    """Numbers of roots, orders, signs at samples; of a mirrored scene, those of the scene itself."""
    core, flip = surface.core, -1 if mirrored else 1
    n, m = (len(shape.edges) for shape in surface.shapes)
    found: list[Any] = []
    events: list[Event] = []
    for s in range(len(surface.shapes[0].vertices)):
        for v in range(len(surface.shapes[1].vertices)):
            roots, zero = core.offset_roots(s, v, FIRST_WALL, LAST_WALL)
            found.append((zero, len(roots), [flip * core.offset_sign(s, v, (flip * tau, None)) for tau in SAMPLES]))
            events += roots[::flip]
    for g in range(n):
        for f in range(m):
            roots, _ = core.parallel_roots(g, f, FIRST_WALL, LAST_WALL)
            found.append((len(roots), [flip * core.parallel_sign(g, f, (flip * tau, None)) for tau in SAMPLES]))
            events += roots
    found += [[flip * core.order(x, y) for y in events[:40]] for x in events[:40]]
    helices = [Feature(VERTEX_VERTEX, 0, 0)]
    curves = helices + [Feature(kind, k, k) for kind in (VERTEX_EDGE, EDGE_VERTEX) for k in range(3)]
    for p in curves:
        for q in curves:
            orders = []
            for from_, to in surface.spans(p, q)[::flip]:
                middle = rational(surface.reference.between(surface.angle(from_), surface.angle(to)))
                flipped = (surface.reference.curve(x)[1](middle) < 0 for x in (p, q))
                (x, y) = flipped
                _, signs, _ = core.compare(pack(p), x, pack(q), y, from_, to)
                orders.append(signs[::flip])
            found.append(orders)
    return found


@pytest.mark.slow
@pytest.mark.parametrize("family", ["lattice", "congruent", "collinear", "tangent", "right_angles", "disturbed"])
@pytest.mark.parametrize("kind", [VERTEX_EDGE, EDGE_VERTEX])
def test_images_of_a_scene_are_decided_alike(family: str, kind: int) -> None:
    c, s = Fraction(3, 5), Fraction(-4, 5)

    def both(image: Any) -> Rings:
        return rings.mapped(image, image)

    for number in range(5):
        rings = distinct(FAMILIES[family](random.Random(f"{family} {number}")))
        contact = Feature(kind, 0, 0)
        for chart in (0, 1):
            expected = decisions(Surface(rings, contact, chart))
            for scale in (2**70, Fraction(1, 2**70), 3**40, Fraction(1, 3**40)):
                scaled = both(lambda x, y, scale=scale: (scale * x, scale * y))
                assert decisions(Surface(scaled, contact, chart)) == expected
            turned = both(lambda x, y: (c * x - s * y, s * x + c * y))
            assert decisions(Surface(turned, contact, chart)) == expected
            far = rings.mapped(lambda x, y: (x - 10**30, y), lambda x, y: (x, y + 10**30))
            assert decisions(Surface(far, contact, chart)) == expected
            half_turned = rings.mapped(lambda x, y: (-x, -y), lambda x, y: (x, y))
            assert decisions(Surface(half_turned, contact, 1 - chart)) == expected
            mirror = both(lambda x, y: (-x, y))
            assert decisions(Surface(mirror, contact, chart), mirrored=True) == expected


# --- polynomials ---


def dyadic(x: Fraction) -> tuple[int, int]:
    return x.numerator, x.denominator.bit_length() - 1


def fraction(x: tuple[int, int]) -> Fraction:
    return Fraction(x[0], 2 ** x[1])


def integers(polynomial: fmpz_poly) -> list[int]:
    return [int(c) for c in polynomial.coeffs()]


@st.composite
def polynomials(draw: st.DrawFn, degree: int = 4) -> fmpz_poly:
    """Products of factors that tend to repeat, or are nearly the same; not zero."""
    large = draw(st.sampled_from([1, 1, 2**60, 3**70, 2**400]))
    linear = st.builds(
        lambda a, b, e: fmpz_poly([a * large + e, b * large]), st.integers(-3, 3), st.integers(1, 3), st.integers(-1, 1)
    )
    quadratic = st.builds(
        lambda a, b, c: fmpz_poly([a * large, b, c]), st.integers(-3, 3), st.integers(-3, 3), st.integers(1, 3)
    )
    factors = draw(st.lists(st.one_of(linear, quadratic), min_size=1, max_size=4))
    result = fmpz_poly([draw(st.sampled_from([1, -1, 5]))])
    for factor in [*factors, *draw(st.lists(st.sampled_from(factors), max_size=2))]:
        if result.degree() + factor.degree() <= degree:
            result *= factor
    return result


dyadics = st.builds(lambda n, k: Fraction(n, 2**k), st.integers(-(2**80), 2**80), st.sampled_from([79, 80, 90, 200]))
simple = st.builds(lambda n, k: Fraction(n, 2**k), st.integers(-16, 16), st.integers(3, 5))


@given(polynomials(), dyadics | simple)
def test_the_sign_of_a_polynomial_at_a_dyadic(p: fmpz_poly, tau: Fraction) -> None:
    exact = p(rational(tau))
    assert _core.sign_at(integers(p), dyadic(tau)) == (exact > 0) - (exact < 0)


@pytest.mark.slow
@given(polynomials(), polynomials())
def test_the_common_divisor_is_that_of_flint_but_for_a_constant(p: fmpz_poly, q: fmpz_poly) -> None:
    def normal(r: fmpz_poly) -> fmpz_poly:
        primitive = r // r.content()
        return primitive if primitive[primitive.degree()] > 0 else -primitive

    mine = fmpz_poly(_core.greatest_common_divisor(integers(p), integers(q)))
    assert normal(mine) == normal(p.gcd(q))
    squarefree = fmpz_poly([1])
    for factor, _ in p.factor()[1]:
        squarefree *= factor
    assert normal(fmpz_poly(_core.squarefree(integers(p)))) == normal(squarefree)


@given(polynomials(), simple, simple, st.sampled_from([1, 10, 56]))
def test_intervals_isolate_the_roots_between_two_numbers(p: fmpz_poly, lo: Fraction, hi: Fraction, bits: int) -> None:
    if p.degree() < 1 or lo >= hi:
        return
    found = _core.isolate(_core.squarefree(integers(p)), dyadic(lo), dyadic(hi), bits)
    start, end = Angle.of(lo), Angle.of(hi)
    true = [root.angle for root in real_roots(p) if start < root.angle and not end < root.angle]
    assert len(found) == len(true)
    for angle, (below, above) in zip(true, found, strict=True):
        below, above = fraction(below), fraction(above)
        assert above - below <= Fraction(1, 2**bits)
        assert Angle.of(below) < angle and not Angle.of(above) < angle
        inside = [x for x in true if Angle.of(below) < x and not Angle.of(above) < x]
        assert inside == [angle]


def roots_of(p: fmpz_poly) -> list[tuple[Angle, tuple[list[int], tuple[int, int], tuple[int, int]]]]:
    """Where the sign changes in (-2, 2), also as the core takes it: an interval no narrower than it must be."""
    result = []
    ends = Angle.of(Fraction(-2)), Angle.of(Fraction(2))
    inside = [root for root in real_roots(p) if root.angle not in ends]
    for x, multiplicity in inside:
        lo, hi = Fraction(-2), Fraction(2)
        others = [y for y, _ in real_roots(p) if y != x]
        while lo != hi and any(y.compare(Angle.of(lo)) >= 0 >= y.compare(Angle.of(hi)) for y in others):
            mid = (lo + hi) / 2
            order = x.compare(Angle.of(mid))
            lo, hi = (lo, mid) if order < 0 else (mid, hi) if order > 0 else (mid, mid)
        if multiplicity % 2:
            result.append((x, (integers(p), dyadic(lo), dyadic(hi))))
    return result


@pytest.mark.slow
@settings(max_examples=200)
@given(polynomials(), polynomials())
def test_roots_of_polynomials_are_ordered_and_put_into_others(p: fmpz_poly, q: fmpz_poly) -> None:
    for x, mine in roots_of(p):
        assert _core.sign_at(integers(q), mine) == sign_at(q, x)
        assert _core.sign_before(integers(q), mine) == sign_before(q, x)
        assert _core.sign_after(integers(q), mine) == sign_after(q, x)
        for y, other in roots_of(q):
            assert _core.compare(mine, other) == x.compare(y)
