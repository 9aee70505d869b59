"""`verify.boundary` among rounded shapes: true boundaries pass, and changed ones do not."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import fields, replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from flint import arb

import cfree
import cfree.verify
import facing_arcs
from arc_rings import BRACKET, CONCAVE, RINGS, plate, random_arcs, random_concave, shape
from cfree import Curved, Polygon, Scene, boundary
from cfree.curves import Arc
from cfree.exact.pose import pose_at
from cfree.forbidden.boundary import Boundary
from cfree.forbidden.columns import IsolatedParts, Trapezoids
from cfree.scene.rounded import rounded, rounded_shapes
from cfree.verify.result import MEASURED, PROVED, SAMPLED, SKIPPED
from cfree.verify.round_algebra import Turn, precision
from cfree.verify.round_boundary import _Covering
from cfree.verify.round_world import RoundWorld, _has_fillets_inside
from facing_arcs import FAMILIES
from rounded_scenes import MIXED, ONE_RADIUS, SCENES, SQUARE, TRIANGLE, disc, grown, random_scene
from rounded_ties import SCENES as TIES
from rounded_ties import scene_of

ROOM = Scene(disc(0, 0, "1/3"), [disc(1, 1, "1/2")], workspace=[(-3, -3), (4, -3), (4, 4), (0, 1), (-3, 4)])
IN_BOUNDS = Scene(grown(TRIANGLE, "1/5"), [grown(SQUARE, "1/10", 2, 1)], bounds=(-4, -4, 6, 6))


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_boundaries_of_rounded_shapes_are_verified(name: str) -> None:
    result = cfree.verify.boundary(boundary(SCENES[name]), SCENES[name])
    assert result.verified, result
    assert {check.name: check.how for check in result.checks}["closed surfaces"] == PROVED


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_boundaries_of_random_rounded_scenes_are_verified(seed: int) -> None:
    scene = random_scene(seed)
    result = cfree.verify.boundary(boundary(scene), scene, slices=4, seed=seed)
    assert result.verified, result


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize(
    ("make", "seed"), [*((random_arcs, k) for k in range(2, 8)), *((random_concave, k) for k in range(10))]
)
def test_boundaries_of_random_shapes_with_arcs_are_verified(make: Callable[[int], Scene], seed: int) -> None:
    """Convex arcs, of a robot of one part or two, and concave ones."""
    scene = make(seed)
    result = cfree.verify.boundary(boundary(scene), scene, slices=4, seed=seed)
    assert result.verified, result
    assert {check.name: check.how for check in result.checks}["closed surfaces"] == PROVED


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(20))
def test_poses_are_covered_among_concave_arcs_where_exact_tests_forbid_them(seed: int) -> None:
    """Convex pieces and pairs of a fillet and a vertex, against segments and arcs at rational poses."""
    scene, rng = random_concave(seed), random.Random(seed)
    cores = rounded_shapes(scene)
    assert cores is not None and cores.has_concave
    covered = 0
    with precision(200):
        covering = _Covering(RoundWorld(scene, cores))
        for _ in range(150):
            x, y, tau = rng.randint(-(2**20), 2**20), rng.randint(-(2**20), 2**20), rng.randint(-64, 64)
            pose = pose_at(Fraction(x, 2**16), Fraction(y, 2**16), Fraction(tau, 64))
            place = arb(x) / 2**16, arb(y) / 2**16
            found = covering.covers_place(place, Turn.of(0, arb(tau) / 64), arb(2) ** -40)
            covered += found
            assert found != cfree.is_free(scene, pose), pose
    assert covered


@pytest.mark.slow
@pytest.mark.parametrize("family", FAMILIES)
def test_poses_are_covered_among_facing_arcs_where_exact_tests_forbid_them(family: str) -> None:
    """Convex pieces, and pairs of a fillet and a vertex or an arc, at rational poses around contacts."""
    made, rng = facing_arcs.scene(family, 7), random.Random(7)
    cores = rounded_shapes(made)
    assert cores is not None
    covered = 0
    with precision(200):
        world = RoundWorld(made, cores)
        assert world.arc_fillet_pairs or family in ("channels", "tears")
        covering = _Covering(world)
        for pose in facing_arcs.poses(made, boundary(made), rng):
            x, y, tau = (Fraction(round((c or 0) * 2**24), 2**24) for c in (pose.x, pose.y, pose.tau))
            pose = pose_at(x, y, tau)
            place = arb(x.numerator) / x.denominator, arb(y.numerator) / y.denominator
            turn = Turn.of(0, arb(tau.numerator) / tau.denominator)
            found = covering.covers_place(place, turn, arb(2) ** -60)
            covered += found
            assert found != cfree.is_free(made, pose), pose
    assert covered


@pytest.mark.parametrize("name", [*CONCAVE, "plate"])
def test_fillets_have_to_be_in_their_shape(name: str) -> None:
    """Points beyond an arc that are too far out or too near are found."""
    core = rounded(plate() if name == "plate" else shape(CONCAVE[name]))
    assert core is not None and core.has_concave
    assert _has_fillets_inside(core)
    k = next(k for k, arc in enumerate(core.arcs) if arc.beyond)
    arc = core.arcs[k]
    assert arc.beyond is not None
    inner, outer = arc.beyond
    for share in (Fraction(-1), Fraction(100)):
        far = inner[0] + share * (outer[0] - inner[0]), inner[1] + share * (outer[1] - inner[1])
        other = replace(arc, beyond=(inner, far))
        assert not _has_fillets_inside(replace(core, arcs=(*core.arcs[:k], other, *core.arcs[k + 1 :])))


def test_a_fillet_covers_what_no_piece_does() -> None:
    """A disc that is larger than a fillet's circle allows, in the corner, and one that is as large."""
    for radius, is_covered in ((1, False), (Fraction(5, 2), True)):
        scene = Scene(disc(0, 0, radius), [shape(BRACKET)])  # walls at 2, the arc of radius 3 about (5, 5)
        cores = rounded_shapes(scene)
        assert cores is not None
        with precision(200):
            world = RoundWorld(scene, cores)
            place, turn, near = (arb(41) / 10, arb(41) / 10), Turn.of(0, arb(0)), arb(2) ** -40
            assert _Covering(world).covers_place(place, turn, near) is is_covered
            assert any(pair.overlaps(turn, place, near) for pair in world.fillet_pairs) is is_covered


def test_obstacles_may_reach_beyond_bounds() -> None:
    scene = Scene(grown(SQUARE, "1/8"), [[(0, 0), (9, 0), (9, 2), (2, 9), (0, 9)]], bounds=(-3, -3, 3, 3))
    result = cfree.verify.boundary(boundary(scene), scene, slices=4)
    assert result.verified, result


def test_a_free_surface_in_a_round_hole_that_is_left_out_is_refuted() -> None:
    scene = Scene(disc(0, 0, 1), [plate()])
    right = boundary(scene)
    hole = right.complex.component[np.flatnonzero(right.patch_radius[right.trapezoids.patch] < 0)[0]]
    found = cfree.verify.boundary(rows(right, np.flatnonzero(right.complex.component != hole)), scene, slices=2)
    assert {finding.kind for finding in found.findings} == {"nothing missing"}


@pytest.mark.slow
@pytest.mark.parametrize("name", TIES)
def test_boundaries_with_ties_are_verified(name: str) -> None:
    scene = scene_of(name)
    if scene is None or not scene.curved:
        return  # a point or a segment without radius is no shape of a scene
    result = cfree.verify.boundary(boundary(scene), scene, slices=4)
    assert result.verified, result


@pytest.mark.parametrize("scene", [ROOM, IN_BOUNDS], ids=["workspace", "bounds"])
def test_boundaries_in_workspaces_and_bounds_are_verified(scene: Scene) -> None:
    result = cfree.verify.boundary(boundary(scene), scene, slices=3)
    assert result.verified, result


def test_a_file_of_a_rounded_boundary_is_verified_for_its_scene_alone(tmp_path: Path) -> None:
    cfree.save(boundary(MIXED), tmp_path / "mixed.npz")
    assert cfree.verify.boundary(tmp_path / "mixed.npz", MIXED, slices=1).verified
    other = cfree.verify.boundary(tmp_path / "mixed.npz", ONE_RADIUS)
    assert [finding.kind for finding in other.findings] == ["scene"]


def test_a_sample_says_what_it_leaves_out() -> None:
    result = cfree.verify.boundary(boundary(MIXED), sample=5, deep=True)
    ways = {check.name: check.how for check in result.checks}
    assert result.verified
    assert ways["closed surfaces"] == ways["nothing missing"] == ways["Gauss map"] == SKIPPED
    assert {check.how for check in cfree.verify.boundary(boundary(MIXED), slices=1).checks} >= {PROVED, MEASURED}


def peg() -> Boundary:
    """A rounded square in a slot of its width: four segments."""
    square = grown([(-1, -1), (1, -1), (1, 1), (-1, 1)], "1/2")
    walls = [[(-5, y), (5, y), (5, y + 1), (-5, y + 1)] for y in (Fraction(3, 2), Fraction(-5, 2))]
    return boundary(cfree.Scene(square, [Polygon(wall) for wall in walls]))


def with_parts(result: Boundary, **table: Any) -> Boundary:
    """The same boundary with other columns of isolated parts."""
    columns = {field.name: np.array(getattr(result.isolated, field.name)) for field in fields(IsolatedParts)} | table
    contacts = (np.array(getattr(result, f"contact_{name}")) for name in ("kind", "robot", "obstacle"))
    return Boundary(
        result.scene, result.features, *contacts, result.trapezoids, IsolatedParts(**columns),
        replace(result.stats), np.array(result.trimmed),
    )  # fmt: skip


def test_exact_fits_are_free_and_without_room() -> None:
    result = cfree.verify.boundary(peg(), slices=1)
    found = next(check for check in result.checks if check.name == "isolated parts")
    assert result.verified and (found.how, found.extent.partition(":")[0]) == (SAMPLED, "4 parts")


def test_wrong_exact_fits_are_refuted() -> None:
    right = peg()
    parts, table = right.isolated, right.trapezoids
    other = next(k for k in range(len(table)) if table.lower[k] not in (parts.lower[0], parts.upper[0]))
    wrong = [
        with_parts(right, lower=np.where(np.arange(4) == 0, table.lower[other], parts.lower)),
        with_parts(
            right, **{f"to_{x}": np.roll(getattr(parts, f"to_{x}"), 1) for x in ("first", "second", "lo", "hi")}
        ),
        with_parts(right, patch=np.full(4, 7, np.int32), lower_patch=np.full(4, 7, np.int32)),
    ]
    for bad in wrong:
        kinds = {finding.kind for finding in cfree.verify.boundary(bad, slices=0).findings}
        assert kinds == {"isolated parts"}


@pytest.mark.slow
def test_wrong_exact_fits_in_concave_arcs_are_refuted() -> None:
    """A peg in a slot of its shape: its points at another angle, and turned into curves."""
    ends = [Arc((2, 1), center=(2, 0)), Arc((-2, -1), center=(-2, 0))]
    rim = [(-2, -1), (2, -1), ends[0], (-2, 1), ends[1]]
    right = cfree.boundary(Scene(Curved(rim), [Curved([(-5, -3), (5, -3), (5, 3), (-5, 3)], [rim])]))
    assert cfree.verify.boundary(right, slices=0).verified and len(right.isolated) == 2

    def at_chart_end(end: str, tau: float) -> dict[str, Any]:
        names = {f"{end}_{x}": np.zeros(2, np.uint64) for x in ("first", "second")}
        return names | {f"{end}_{x}": np.full(2, tau) for x in ("lo", "hi")}

    wrong = [
        with_parts(right, **at_chart_end("from", -1), **at_chart_end("to", -1)),
        with_parts(right, **at_chart_end("to", 1)),
    ]
    for bad in wrong:
        assert {finding.kind for finding in cfree.verify.boundary(bad, slices=0).findings} == {"isolated parts"}


def changed(result: Boundary, table: dict[str, Any], kind: Any = None) -> Boundary:
    """The same boundary with other columns."""
    columns = {field.name: np.array(getattr(result.trapezoids, field.name)) for field in fields(Trapezoids)} | table
    kinds = np.array(result.contact_kind if kind is None else kind)
    return Boundary(
        result.scene, result.features, kinds, np.array(result.contact_robot), np.array(result.contact_obstacle),
        Trapezoids(**columns), result.isolated, replace(result.stats), np.array(result.trimmed),
    )  # fmt: skip


def rows(result: Boundary, chosen: Any) -> Boundary:
    return changed(result, {f.name: np.array(getattr(result.trapezoids, f.name)[chosen]) for f in fields(Trapezoids)})


def column(result: Boundary, name: str, k: int, value: Any) -> Boundary:
    array = np.array(getattr(result.trapezoids, name))
    array[k] = value
    return changed(result, {name: array})


def dropped(result: Boundary, rng: random.Random) -> Boundary:
    return rows(result, np.delete(np.arange(len(result.trapezoids)), rng.randrange(len(result.trapezoids))))


def doubled(result: Boundary, rng: random.Random) -> Boundary:
    k = rng.randrange(len(result.trapezoids))
    return rows(result, np.insert(np.arange(len(result.trapezoids)), k, k))


def without_a_surface(result: Boundary, rng: random.Random) -> Boundary:
    component = result.complex.component
    return rows(result, np.flatnonzero(component != rng.choice(component.tolist())))


def with_a_surface_twice(result: Boundary, rng: random.Random) -> Boundary:
    times = 1 + (result.complex.component == rng.choice(result.complex.component.tolist()))
    return rows(result, np.repeat(np.arange(len(result.trapezoids)), times))


def in_the_other_chart(result: Boundary, rng: random.Random) -> Boundary:
    k = rng.randrange(len(result.trapezoids))
    return column(result, "chart", k, 1 - result.trapezoids.chart[k])


def with_another_curve(result: Boundary, rng: random.Random) -> Boundary:
    name, k = rng.choice(["lower", "upper"]), rng.randrange(len(result.trapezoids))
    codes = getattr(result.trapezoids, name)
    others = codes[codes != codes[k]]
    return column(result, name, k, others[rng.randrange(len(others))])


def with_curves_exchanged(result: Boundary, rng: random.Random) -> Boundary:
    k, t = rng.randrange(len(result.trapezoids)), result.trapezoids
    return column(column(result, "lower", k, t.upper[k]), "upper", k, t.lower[k])


def on_the_other_branch(result: Boundary, rng: random.Random) -> Boundary:
    """Only curves with a branch: kinds 1 to 3, and bits 1 or 3."""
    codes = result.trapezoids.lower
    (with_branch,) = np.nonzero(((codes >> 61) < 4) & ((codes >> 59 & 1) == 1))
    k = int(rng.choice(with_branch.tolist()))
    return column(result, "lower", k, codes[k] ^ np.uint64(2 << 59))


def with_a_shorter_angle(result: Boundary, rng: random.Random) -> Boundary:
    """It ends where another trapezoid of the chart does."""
    t, k = result.trapezoids, rng.randrange(len(result.trapezoids))
    (others,) = np.nonzero((t.chart == t.chart[k]) & (t.to_lo != t.to_lo[k]))
    other = int(rng.choice(others.tolist()))
    names = [f"to_{name}" for name in ("first", "second", "lo", "hi", "place")]
    table = {name: np.array(getattr(t, name)) for name in names}
    for name in names:
        table[name][k] = table[name][other]
    return changed(result, table)


def with_a_moved_interval(result: Boundary, rng: random.Random) -> Boundary:
    t = result.trapezoids
    (named,) = np.nonzero(t.from_first > 0)
    k = int(rng.choice(named.tolist()))
    return column(column(result, "from_lo", k, t.from_lo[k] + 1e-7), "from_hi", k, t.from_hi[k] + 1e-7)


def on_another_quadrant(result: Boundary, rng: random.Random) -> Boundary:
    kind = np.array(result.contact_kind)
    live = np.unique(result.trapezoids.patch)
    patch = int(rng.choice(live[kind[live] & 15 == 3].tolist()))
    kind[patch] = (kind[patch] + 16) % 64
    return changed(result, {}, kind)


MUTANTS: list[Callable[[Boundary, random.Random], Boundary]] = [
    dropped, doubled, without_a_surface, with_a_surface_twice, in_the_other_chart, with_another_curve,
    with_curves_exchanged, on_the_other_branch, with_a_shorter_angle, with_a_moved_interval, on_another_quadrant,
]  # fmt: skip


NO_BRANCH = (0, 2, 4)


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("mutant", MUTANTS, ids=lambda f: f.__name__)
def test_a_changed_boundary_is_refuted(mutant: Callable[[Boundary, random.Random], Boundary]) -> None:
    for seed, scene in {0: MIXED, 2: IN_BOUNDS, 4: random_arcs(4), 5: random_concave(5)}.items():
        result = boundary(scene)
        rng = random.Random(20 + seed if mutant is with_another_curve else seed)  # a joint's other names are right
        if mutant is on_the_other_branch and seed in NO_BRANCH:
            continue  # no lower curve has one
        found = cfree.verify.boundary(mutant(result, rng), scene, slices=3)
        assert not found.verified, (mutant.__name__, seed)


def test_a_trapezoid_that_is_left_out_is_refuted() -> None:
    result = cfree.verify.boundary(dropped(boundary(MIXED), random.Random(1)), MIXED, slices=2)
    assert {finding.kind for finding in result.findings} >= {"closed surfaces"}


@pytest.mark.slow
def test_a_boundary_of_arcs_with_long_numbers_is_verified() -> None:
    """Places are decided with as many bits as the numbers need."""
    by = Fraction(1, 5) + Fraction(1, 5 * 2**60)
    scene = Scene(shape(RINGS["half"], "1/3", 0, by), [disc(0, 2, 1), grown(SQUARE, "1/7", 2, 1)])
    result = cfree.verify.boundary(boundary(scene), scene, slices=2)
    assert result.verified, result


def test_deep_verification_among_round_shapes_has_degrees() -> None:
    result = boundary(IN_BOUNDS)
    whole, sampled = (
        cfree.verify.boundary(result, IN_BOUNDS, slices=0, sample=k, deep=True).checks[-1] for k in (None, 3)
    )
    assert (whole.name, whole.how) == ("Gauss map", "MEASURED") and "half its Euler number" in whole.extent
    assert sampled.how == "SKIPPED"


def test_obstacles_far_beyond_bounds_are_no_missing_contacts() -> None:
    scene = Scene(disc(0, 0, 1), [disc(40, 3, 5), disc(0, 0, 1)], bounds=(-1, -1, 3, 1))
    assert cfree.verify.boundary(boundary(scene), scene, slices=2).verified
