"""Doubles and exact half planes against the exact sections: the same free contacts, and the same parts covered."""

from __future__ import annotations

import random
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from flint import fmpz_poly

from cfree import Scene, boundary, load_scene
from cfree.exact.algebraic import Number, Root, near, ratio, roots
from cfree.verify.heights import HalfPlanes, Segments, columns, covered, heights, left_over, rough_rotation
from cfree.verify.section import Section
from cfree.verify.surfaces import Turn, minus
from cfree.verify.trapezoids import Reader, Trapezoid
from cfree.verify.world import World, sides
from compared import scene_of
from examples import POLYGONS
from shapes import KINDS, random_scene

TESTS = Path(__file__).parents[1]
SCENES = TESTS.parent / "examples" / "scenes"
SMALL = [path for path in POLYGONS if path.stat().st_size < 4_000]
CASES = sorted((TESTS / "cases").rglob("*.json"))


def turns_of(scene: Scene, count: int, seed: int = 0) -> list[Turn]:
    """Critical ones, rational and not, and others."""
    found = boundary(scene, threads=1)
    reader = Reader(
        scene, (found.contact_kind, found.contact_robot, found.contact_obstacle), found.trapezoids, found.isolated
    )
    rng, t = random.Random(seed), found.trapezoids
    turns = [Turn.of(chart, Fraction(tau)) for chart in (0, 1) for tau in (0, 1)]
    turns += [Turn.of(rng.randrange(2), Fraction(rng.randint(-99, 99), 100)) for _ in range(count)]
    for k in rng.sample(range(len(t)), min(count, len(t))):
        turns.append(Turn(int(t.chart[k]), reader.angle(t, k, "from", int(t.patch[k]))))
    return turns


def check_sections(scene: Scene, count: int) -> None:
    world = World(scene)
    for turn in turns_of(scene, count):
        section, expected = Section(world, turn), {}
        for surface in world.contacts():
            if all(turn.value(limit) <= 0 for limit in surface.limits) and (free := section.on_contact(surface)):
                expected[surface] = free
        assert dict(left_over(world, turn)) == expected, str(turn)


@pytest.mark.slow
@pytest.mark.parametrize("path", [*SMALL, *CASES[::3]], ids=lambda path: path.stem)
def test_free_contacts_are_those_of_the_exact_section(path: Path) -> None:
    check_sections(load_scene(path), 2)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_free_contacts_of_random_scenes_are_those_of_the_exact_section(kind: str) -> None:
    check_sections(scene_of(random_scene(3, kind)), 3)


def test_free_contacts_of_touching_squares_are_those_of_the_exact_section() -> None:
    check_sections(load_scene(SCENES / "degenerate_touching_squares.json"), 1)


@pytest.mark.parametrize("name", ["degenerate_workspace", "sofa_corner", "degenerate_bounds_on_walls", "comb_hook"])
def test_parts_of_contacts_are_covered_where_the_exact_section_says_so(name: str) -> None:
    scene = load_scene(SCENES / f"{name}.json")
    world, rng, items, expected = World(scene), random.Random(1), [], []
    surfaces = list(world.contacts())
    while len(items) < 300:
        surface, turn = rng.choice(surfaces), Turn.of(rng.randrange(2), Fraction(rng.randint(-9, 9), 10))
        if all(turn.value(limit) < 0 for limit in surface.limits):
            free = Section(world, turn).on_contact(surface)
            places = sorted(
                {Fraction(0), Fraction(1), Fraction(rng.randint(1, 9), 10), *(t for ends in free for t in ends)}
            )
            lower, upper = sorted(rng.sample(places, 2))
            items.append((surface, turn, lower, upper))
            if not any(lo <= lower and upper <= hi for lo, hi in free):
                expected.append(len(items) - 1)
    assert covered(world, items) == expected and 0 < len(expected) < len(items)


def test_heights_in_doubles_are_within_their_bounds_of_the_exact_ones() -> None:
    """Also of coordinates far beyond doubles, and at irrational angles."""
    for scale in (1, 10**20, Fraction(1, 10**30)):
        robot = [(0, 0), (3 * scale, scale / 7 if isinstance(scale, Fraction) else scale), (scale, 2 * scale)]
        wall = [(5 * scale, 5 * scale), (9 * scale, 6 * scale), (7 * scale, 11 * scale), (5 * scale, 8 * scale)]
        scene = Scene(robot, [wall])
        world = World(scene)
        for turn in turns_of(scene, 4):
            surfaces = [s for s in world.contacts() if all(turn.value(limit) <= 0 for limit in s.limits)]
            contacts = [columns([getattr(s, name) for s in surfaces], world.unit) for name in "agbq"]
            segments = Segments.of([turn], contacts, np.array([[0.0], [1.0]]))
            piece, part = world.pillars[0]
            above, bound = heights(piece, part, segments)
            exact = HalfPlanes(turn)
            for k, surface in enumerate(surfaces):
                for edge in range(len(bound)):
                    height, slope = exact.over(piece, part, edge, turn.line(surface))
                    unit = world.unit**2 * (turn.w if edge < len(piece.ring) else turn.w * turn.w)
                    for t in (0, 1):
                        true = float(near(ratio(height + slope * t, unit), 90))
                        assert abs(above[t, edge, k] - true) <= bound[edge]


def test_signs_of_directions_are_exact() -> None:
    rng = random.Random(2)
    fixed = [(rng.randint(-5, 5) * 10**k, rng.randint(1, 5)) for k in (0, 1, 15, 17, 40) for _ in range(4)]
    turned = [*fixed, *(minus((0, 0), u) for u in fixed)]
    for turn in (Turn.of(0, Fraction(0)), Turn.of(1, Fraction(1)), Turn.of(0, Fraction(1, 3))):
        found = sides(fixed, turned, turn)
        for i, f in enumerate(fixed):
            for j, e in enumerate(turned):
                x, y = turn(e)
                exact = f[0] * y - f[1] * x
                assert found[i, j] == (exact > 0) - (exact < 0)


def test_rotations_are_rounded_within_their_bound() -> None:
    rng = random.Random(4)
    for _ in range(500):
        turn = Turn.of(rng.randrange(2), Fraction(rng.randint(-(10**9), 10**9), 10**9))
        c, s = rough_rotation(turn)
        assert abs(Fraction(c) - Fraction(turn.c, turn.w)) < Fraction(1, 1 << 50)
        assert abs(Fraction(s) - Fraction(turn.s, turn.w)) < Fraction(1, 1 << 50)


def test_a_polynomial_that_keeps_its_sign_in_doubles_has_no_root_there() -> None:
    """Also of long coefficients, and with roots at ends, which are left to exact numbers."""
    rng, kept, changing = random.Random(5), 0, 0
    for number in range(2000):
        scale = 10 ** rng.choice([0, 3, 20, 200])
        given = [rng.randint(-9 * scale, 9 * scale) for _ in range(rng.randint(2, 6))]
        given[-1] = given[-1] or 1
        start, stop = sorted(Root.of(Fraction(rng.randint(-64, 64), 64)) for _ in range(2))
        if start == stop:
            continue
        poly = fmpz_poly(given)
        if number % 3 == 0:
            poly *= fmpz_poly([-start.lo.numerator, start.lo.denominator])
        piece = Trapezoid.__new__(Trapezoid)
        piece.start, piece.stop = start, stop
        piece._interval = float(start.lo + stop.lo) / 2, float(stop.lo - start.lo) / 2 + 2.0**-50
        inside = [(root, times) for root, times in roots(poly, start.lo, stop.lo) if start < root < stop]
        coefficients = [int(c) for c in poly.coeffs()]
        if piece._keeps_sign(coefficients):
            kept += 1
            assert not roots(poly, start.lo, stop.lo)
        assert piece._changes(poly) == any(times % 2 for _, times in inside)
        assert piece._vanishes(poly) == bool(roots(poly, start.lo, stop.lo))
        changing += piece._changes(poly)
    assert kept > 300 and changing > 300


def test_numbers_of_a_field_have_one_order_in_doubles_and_exactly() -> None:
    rng = random.Random(6)
    (_, (root, _)) = roots(fmpz_poly([-2, 0, 3]), Fraction(-1), Fraction(1))
    x = root.value
    for _ in range(300):
        a, b, c, d = (rng.randint(-(10**k), 10**k) for k in (2, 2, 20, 200))
        one, other = x * a + c, x * b + rng.choice([c, d, c + 1])
        exact = (one.poly - other.poly) * 1
        value = Number(root, exact).rounded(Fraction(1, 10**300))
        assert (one < other, one > other, one == other) == (value < 0, value > 0, value == 0)
        assert (one < c) == (x * a < 0) and (one > c) == (x * a > 0)
