"""The independent checker: it finds nothing in what cfree computes, and its parts agree with the oracles."""

from __future__ import annotations

import random
import subprocess
import sys
from collections import Counter
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from flint import fmpz_poly
from hypothesis import given, settings

import cfree.verify
import oracles
import strategies
from cfree import Boundary, FormatError, Polygon, Scene, boundary, load_scene, save
from cfree.exact.algebraic import Number, between, roots
from cfree.polygons.minkowski import convex_sum
from cfree.verify.matching import matched
from cfree.verify.missing import free_contacts
from cfree.verify.polygons import Ring, corners, roughly, tile
from cfree.verify.section import Interval, Pillar, Section, crossing, left_over
from cfree.verify.surfaces import Line, Turn, Vector, cross, minus
from cfree.verify.trapezoids import Reader
from cfree.verify.world import World
from compared import plain_of, scene_of
from examples import POLYGONS
from reading_only import READING_ONLY
from shapes import KINDS, PlainScene, random_scene

TESTS = Path(__file__).parents[1]
SCENES = TESTS.parent / "examples" / "scenes"
REAL = {"benchmr_parking1", "benchmr_warehouse", "nest_shirts", "nest_swim", "street_Berlin"}
SMALL = [path for path in POLYGONS if path.stem not in REAL]
CASES = sorted((TESTS / "cases").rglob("*.json"))
FLAT = SCENES / "flat.json"
TAUS = [Fraction(1, 7), Fraction(-5, 9), Fraction(2, 3)]


def euler_of(result: Boundary) -> list[int]:
    """From the checker's own matching."""
    columns = result.contact_kind, result.contact_robot, result.contact_obstacle
    reader = Reader(result.scene, columns, result.trapezoids, result.isolated)
    matching = matched(reader, {k: reader.trapezoid(k).sides() for k in range(len(result.trapezoids))})
    assert not matching.unmatched and matching.pinched == len(result.complex.pinched)
    return matching.euler


def verified(scene: Scene, **options: object) -> cfree.verify.Verification:
    return cfree.verify.boundary(boundary(scene, threads=1), scene, **options)  # type: ignore[arg-type]


# --- what cfree computes ---


@pytest.mark.slow
@pytest.mark.parametrize("path", [*SMALL, *CASES], ids=lambda path: path.stem)
def test_every_small_scene_verifies(path: Path) -> None:
    """Euler numbers are those of the core's cell complex."""
    good = boundary(load_scene(path), threads=1)
    result = cfree.verify.boundary(good, slices=2)
    assert not result.findings
    assert {check.how for check in result.checks} == {"PROVED", "SAMPLED"}
    assert list(result.euler) == sorted(good.complex.euler.tolist())


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_random_scenes_verify(kind: str) -> None:
    assert not verified(scene_of(random_scene(0, kind)), slices=2).findings


@pytest.mark.slow
@given(strategies.scenes())
@settings(max_examples=10)
def test_small_integer_scenes_verify(plain: PlainScene) -> None:
    assert not verified(scene_of(plain), slices=2).findings


@pytest.mark.slow
def test_a_sample_of_the_warehouse_verifies() -> None:
    result = verified(load_scene(SCENES / "benchmr_warehouse.json"), sample=400, slices=1)
    assert not result.findings
    assert [check.how for check in result.checks] == [
        "PROVED", "SAMPLED", "SAMPLED", "SAMPLED", "SKIPPED", "PROVED", "SAMPLED",
    ]  # fmt: skip
    assert result.checks[1].extent.startswith("400 of ")


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_euler_numbers_of_random_scenes_are_those_of_the_cell_complex(kind: str) -> None:
    for seed in range(100, 103):
        result = boundary(scene_of(random_scene(seed, kind)), threads=1)
        assert euler_of(result) == sorted(result.complex.euler.tolist()), seed


# --- the interface ---


@pytest.fixture(scope="module")
def flat(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("verify") / "flat.npz"
    save(boundary(load_scene(FLAT)), path)
    return path


@pytest.mark.slow
def test_progress_is_reported() -> None:
    shares: list[float] = []
    found = boundary(load_scene(FLAT.with_name("five_convex.json")))
    one, two = (cfree.verify.boundary(found, slices=20, progress=call) for call in (None, shares.append))
    assert one.verified and replace(one, seconds=0) == replace(two, seconds=0)
    assert shares == sorted(shares) and shares[-1] == 1 and len(shares) > 20


@pytest.mark.slow
def test_the_core_reads_the_scene_and_nothing_else(flat: Path) -> None:
    program = f"{READING_ONLY}\nimport cfree.verify\nprint(cfree.verify.boundary({str(flat)!r}, slices=1).verified)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.stdout == "True\n", done.stderr


def test_an_incomplete_boundary_is_not_verified(tmp_path: Path) -> None:
    part = boundary(load_scene(FLAT))
    part.trimmed = np.arange(len(part.trimmed)) > 0  # all but one
    save(part, tmp_path / "part.npz")
    for source in (part, tmp_path / "part.npz"):
        result = cfree.verify.boundary(source, part.scene)
        assert not result.verified and "REFUTED" in result.verdict
        assert [finding.kind for finding in result.findings] == ["incomplete"]
        assert f"{len(part.trimmed) - 1:,} of {len(part.trimmed):,} patches trimmed" in str(result)


def test_another_scene_is_a_finding(flat: Path) -> None:
    scene = load_scene(FLAT)
    other = Scene(scene.robot, scene.obstacles[1:], bounds=scene.bounds, workspace=scene.workspace)
    result = cfree.verify.boundary(flat, other)
    assert [finding.kind for finding in result.findings] == ["scene"]
    assert "obstacles" in str(result) and "REFUTED" in str(result)


def test_bad_arguments_and_files_are_refused(flat: Path) -> None:
    with pytest.raises(ValueError, match="slices -1"):
        cfree.verify.boundary(flat, slices=-1)
    with pytest.raises(FormatError):
        cfree.verify.boundary(FLAT)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["triangle_pair", "square_pair", "l_in_u"])
def test_a_coordinate_that_changes_a_little_is_detected(name: str) -> None:
    good = boundary(load_scene(TESTS / "cases" / f"{name}.json"))
    plain, rng = plain_of(good.scene), random.Random(0)
    for shapes in ("robot", "obstacles"):
        for k in range(len(getattr(plain, shapes)[0][0])):
            (ring, holes), *others = getattr(plain, shapes)
            moved = [*ring]
            moved[k] = ring[k][0] + Fraction(rng.choice([-1, 1]), 10 ** rng.randrange(2, 10)), ring[k][1]
            scene = scene_of(plain._replace(**{shapes: [(moved, holes), *others]}))
            columns = good.contact_kind, good.contact_robot, good.contact_obstacle
            bad = Boundary(scene, good.features, *columns, good.trapezoids, good.isolated, good.stats, good.trimmed)
            assert not cfree.verify.boundary(bad, slices=1).verified


# --- parts of it ---


def test_roots_are_counted_compared_and_known_under_every_name() -> None:
    p = fmpz_poly([-1, 0, 2]) * fmpz_poly([-1, 3]) ** 2 * fmpz_poly([1, 0, 1])  # +-1/sqrt 2, 1/3 twice, +-i
    found = roots(p, Fraction(-1), Fraction(1))
    assert [multiplicity for _, multiplicity in found] == [1, 2, 1]
    for (root, _), x in zip(found, (-(0.5**0.5), 1 / 3, 0.5**0.5), strict=True):
        assert float(root.lo) <= x <= float(root.hi)
    ((again, _),) = roots(fmpz_poly([-1, 0, 2]) * fmpz_poly([5, 1]), Fraction(7, 10), Fraction(8, 10))
    assert again.key == found[2][0].key != found[0][0].key
    assert found[0][0] < found[2][0] and again == found[2][0] and not again < found[2][0]
    assert not roots(p, Fraction(9, 10), Fraction(1))


def test_roots_agree_with_floating_point() -> None:
    rng = np.random.default_rng(0)
    for _ in range(300):
        coefficients = rng.integers(-9, 10, rng.integers(2, 6))
        if not coefficients[1:].any():
            continue
        p = fmpz_poly(coefficients.tolist())
        expected = [x.real for x in np.roots(coefficients[::-1]) if abs(x.imag) < 1e-5 and -1.00001 < x.real < 1.00001]
        found = [float(root.lo + root.hi) / 2 for root, k in roots(p, Fraction(-1), Fraction(1)) for _ in range(k)]
        assert len(found) == len(expected)


def test_between_is_strictly_between() -> None:
    rng = random.Random(0)
    for _ in range(200):
        lo = Fraction(rng.randrange(-(10**6), 10**6), rng.randrange(1, 10**9))
        hi = lo + Fraction(rng.randrange(1, 10**6), 10 ** rng.randrange(1, 40))
        assert lo < between(lo, hi) < hi


def test_tiling_is_judged_exactly() -> None:
    square = [(0, 0), (4, 0), (4, 4), (0, 4)]
    lower, upper = [(0, 0), (4, 0), (4, 4)], [(0, 0), (4, 4), (0, 4)]
    assert tile([lower, upper], [square]) and tile([square], [square])
    assert tile([[(0, 0), (2, 0), (2, 4), (0, 4)], [(2, 0), (4, 0), (4, 4), (2, 4)]], [square])  # a vertex on an edge
    for bad in (
        [lower],
        [lower, upper, upper],
        [lower, [(0, 0), (4, 4), (0, 5)]],
        [lower[::-1], upper],
        [[*square[::-1]]],
    ):
        assert not tile(bad, [square])
    star = [(0, 0), (4, 1), (8, 0), (4, 8)]
    assert not tile([star], [star])  # not convex


@pytest.mark.parametrize("name", ["degenerate_workspace", "sofa_corner", "degenerate_bounds_on_walls"])
def test_free_contacts_agree_with_the_oracle(name: str) -> None:
    """Between and beside the free intervals of contacts."""
    scene = load_scene(SCENES / f"{name}.json")
    world, plain, answers = World(scene), plain_of(scene), Counter[bool]()
    for tau in TAUS:
        turn = Turn.of(0, tau)
        section = Section(world, turn)
        for surface in list(world.contacts())[::7]:
            if any(turn.value(limit) > 0 for limit in surface.limits):
                continue
            free, line = section.on_contact(surface), turn.line(surface)
            for t in (Fraction(k, 6) for k in range(7)):
                x, y = (Fraction(c) / (turn.w * world.scale) for c in line.point(t))
                expected = oracles.exact_is_forbidden(
                    plain.robot, plain.obstacles, x, y, tau, plain.bounds, plain.workspace
                )
                assert any(lo <= t <= hi for lo, hi in free) != expected
                answers[expected] += 1
    assert min(answers[True], answers[False]) > 10


def test_sums_are_the_oracles_hulls() -> None:
    scene = load_scene(SCENES / "five_convex.json")
    world, plain = World(scene), plain_of(scene)
    for tau in TAUS:
        turn = Turn.of(0, tau)
        (part,) = ([(-x, -y) for x, y in map(turn, part)] for part in world.parts)
        mine = [convex_sum([turn.fixed(p) for p in wall], part) for wall in world.obstacle_pieces]
        size = turn.w * world.scale
        area = sum(oracles.ring_area([(Fraction(x, size), Fraction(y, size)) for x, y in ring]) for ring in mine)
        hulls = [
            oracles.exact_hull((bx - ax, by - ay) for bx, by in outer for ax, ay in placed)
            for outer, _ in plain.obstacles
            for placed in [oracles.exact_place(plain.robot[0][0], Fraction(0), Fraction(0), tau)]
        ]
        assert area == sum(map(oracles.ring_area, hulls))


def pillar(ring: Ring) -> Pillar:
    return Pillar(ring, roughly(ring, 1))


def test_what_squares_leave_of_a_line() -> None:
    square, beside = pillar([(0, 0), (4, 0), (4, 4), (0, 4)]), pillar([(4, 0), (8, 0), (8, 4), (4, 4)])
    half, third = Fraction(1, 2), Fraction(1, 3)

    def left(pillars: list[Pillar], start: Vector, along: Vector) -> list[Interval]:
        line = Line(start, along)
        return left_over(pillars, line, roughly([start, line.point(1)], 1))

    assert left([square], (-4, 1), (8, 0)) == [(0, half), (1, 1)]
    assert left([square], (0, 0), (4, 0)) == [(0, 1)]  # along an edge
    assert left([square], (-4, 1), (4, 0)) == [(0, 1)]  # up to it
    assert left([square, beside], (-4, 1), (12, 0)) == [(0, third), (2 * third, 2 * third), (1, 1)]
    assert left([square, beside], (1, 1), (7, 0)) == [(Fraction(3, 7), Fraction(3, 7)), (1, 1)]
    assert Line((0, 1), (6, -3)).key == Line((4, -1), (-2, 1)).key == (-half, 1)


@pytest.mark.slow
def test_a_line_crosses_a_pillar_where_it_is_over_every_edge_whatever_the_doubles_say() -> None:
    rng, found = random.Random(0), Counter[bool]()
    for _ in range(2000):
        points = [(Fraction(rng.randint(-3, 3)), Fraction(rng.randint(-3, 3))) for _ in range(rng.randint(3, 9))]
        ring, start, along = list(oracles.exact_hull(points)), points[0], (rng.randint(-4, 4), rng.randint(-4, 4))
        if len(ring) < 3 or not any(along):
            continue
        if rng.randrange(2):
            start = Fraction(rng.randint(-5, 5)), Fraction(rng.randint(-5, 5))
        line = Line(start, along)
        lo, hi = Fraction(0), Fraction(1)  # as far as [0, 1]
        for _, p, q in corners(ring):
            height, slope = cross(minus(q, p), minus(start, p)), cross(minus(q, p), along)
            if slope > 0:
                lo = max(lo, -height / slope)
            elif slope < 0:
                hi = min(hi, -height / slope)
            elif height <= 0:
                hi = lo
        rough = roughly(ring, 1) * rng.choice([1, 1, 0, 1j, -1])
        passed = crossing(Pillar(ring, rough), line, roughly([start, line.point(1)], 1))
        assert (passed and (max(passed[0], 0), min(passed[1], 1))) == ((lo, hi) if lo < hi else None)
        found[passed is None] += 1
    assert min(found.values()) > 200


@pytest.mark.parametrize("name", ["sofa_corner", "flat", "degenerate_overlapping"])
def test_slices_have_the_oracles_perimeter(name: str) -> None:
    scene = load_scene(SCENES / f"{name}.json")
    world, plain = World(scene), plain_of(scene)
    for tau in TAUS:
        turn = Turn.of(0, tau)
        found = free_contacts(world, turn).segments
        total = sum(
            float(q - p) * (np.hypot(1, float(slope)) if slope is not None else 1)
            for (slope, _), parts in found.items()
            for p, q in parts
        )
        theta = 2 * np.arctan(float(tau))
        oracle = oracles.forbidden_slice(plain.robot, plain.obstacles, theta, plain.bounds, plain.workspace)
        if plain.bounds or plain.workspace:
            oracle = oracles.free_slice(plain.robot, plain.obstacles, theta, plain.bounds, plain.workspace)
        assert total / (turn.w * world.scale) == pytest.approx(oracle.length, rel=1e-9)


def test_an_irrational_angle_is_as_good_as_a_rational_one() -> None:
    """At tan(theta / 2) = sqrt(2) - 1, a turn by 45 degrees, against doubles."""
    scene = load_scene(SCENES / "degenerate_hexagons.json")
    world = World(scene)
    ((root, _),) = roots(fmpz_poly([-1, 2, 1]), Fraction(0), Fraction(1))
    exact, rounded = Turn(0, root), Turn.of(0, Fraction(2**0.5 - 1))
    assert exact.c == exact.s and (exact.c * exact.c * 2 == exact.w * exact.w)
    one, other = free_contacts(world, exact), free_contacts(world, rounded)
    sizes = []
    for turn, places in ((exact, one), (rounded, other)):
        lengths = [q - p for parts in places.segments.values() for p, q in parts]
        approx = [float(x.rounded(Fraction(1, 10**12)) if isinstance(x, Number) else x) for x in [*lengths, turn.w]]
        sizes.append(sorted(x / approx[-1] for x in approx[:-1]))
    assert len(sizes[0]) > 10 and sizes[0] == pytest.approx(sizes[1], rel=1e-9)


def test_a_point_is_enclosed_if_pillars_take_every_direction() -> None:
    """A robot of no size to speak of, between boxes; its reference point at their corners and in gaps."""
    robot = Polygon([(0, 0), (1, 0), (0, 1)])
    rim = [(-9, -9), (9, -9), (9, 9), (-9, 9)]
    section = Section(World(Scene(robot, [Polygon(rim, [[(0, 0), (0, 1), (1, 0)]])])), Turn.of(0, Fraction(0)))
    assert section.encloses((0, 0))  # in its hole
    assert not section.encloses((0, -1))  # forbidden
    slot = [(-9, 0), (9, 0), (9, 1), (-9, 1)]
    walls = [[(-9, -1), (9, -1), (9, 0), (-9, 0)], [(-9, 1), (9, 1), (9, 2), (-9, 2)]]
    section = Section(World(Scene(robot, walls)), Turn.of(0, Fraction(0)))
    assert slot and section.encloses((0, 0), along=(1, 0)) and not section.encloses((0, 0))
    assert not section.encloses((0, 0), along=(0, 1))
    section = Section(World(Scene(robot, walls[:1])), Turn.of(0, Fraction(0)))
    assert not section.encloses((0, 0), along=(1, 0))  # nothing above


def test_a_polygon_whose_pieces_do_not_tile_is_a_finding(monkeypatch: pytest.MonkeyPatch) -> None:
    good = boundary(Scene(robot=[(0, 0), (1, 0), (0, 1)], obstacles=[[(3, 0), (6, 0), (6, 3)]]))
    monkeypatch.setattr(Polygon, "pieces", property(lambda self: ((0, 1, 2), (0, 1, 2))))
    result = cfree.verify.boundary(good, slices=0)
    assert [finding.kind for finding in result.findings] == ["convex pieces"] * 2
