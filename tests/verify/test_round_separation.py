"""Separations among grown cores: true surfaces have no findings, mutated ones have; sides agree with distances."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from functools import cache
from typing import Any

import numpy as np
import pytest
import shapely
import shapely.affinity

import cfree
import cfree._core as core
from cfree.curves import Arc
from cfree.curves.curved import Curved
from cfree.forbidden.boundary import boundary_of
from cfree.forbidden.columns import COLUMNS, Trapezoids
from cfree.free.space import free_space
from cfree.polygons.polygon import Polygon
from cfree.scene.features import SceneFeatures
from cfree.scene.rounded import rounded, rounded_shapes
from cfree.scene.scene import Scene
from cfree.verify.round_algebra import precision
from cfree.verify.round_inside import largest_radius
from cfree.verify.round_pieces import Reader
from cfree.verify.round_proof import Features, RoundSeparation
from cfree.verify.round_separation import round_separation_findings, scale_of, size_of
from cfree.verify.round_sides import is_inside

F = Fraction
HAIR = F(1, 2**60)
FAR = cfree.Pose(100, 0)


# --- scenes ---


def rectangle(w: Any, h: Any, x: Any = 0, y: Any = 0) -> list[tuple[F, F]]:
    return [(F(x) + p * F(w), F(y) + q * F(h)) for p, q in ((-1, -1), (1, -1), (1, 1), (-1, 1))]


def frame(a: Any, b: Any) -> Polygon:
    return Polygon(rectangle(b, b), [rectangle(a, a)])


def disc(x: Any, y: Any, radius: Any) -> Curved:
    return Curved.circle((F(x), F(y)), F(radius))


def stadium(a: Any, b: Any, radius: Any) -> Curved:
    a, b, r = F(a), F(b), F(radius)
    return Curved([(a, -r), (b, -r), Arc((b, r), center=(b, 0)), (a, r), Arc((a, -r), center=(a, 0))])


def horseshoe(x: Any, y: Any, prong: Any = 2) -> list[tuple[F, F]]:
    p = F(prong)
    ring = [(0, 0), (3, 0), (3, p), (2, p), (2, 1), (1, 1), (1, 2), (0, 2)]
    return [(F(a) + F(x), F(b) + F(y)) for a, b in ring]


SQUARE = rectangle("1/2", "1/2")
SCENES: dict[str, Scene] = {
    "stadium about a disc": Scene(stadium(-1, 1, "1/4"), [disc(0, 0, "1/4")]),
    "slanted triangle, irrational lengths": Scene(
        Curved([(0, 0), (1, "1/3"), ("1/7", 1)], grown="1/9"),
        [[(0, 0), ("3/2", "2/3"), (1, 2)], Curved([(1, 2), ("3/2", 4), (0, 3)], grown="1/5")],
    ),
    "bar turning in a frame": Scene(Curved(rectangle("9/10", "1/5"), grown="1/20"), [frame(1, "3/2")]),
    "bar that cannot turn in a frame": Scene(Curved(rectangle("11/10", "1/5"), grown="1/20"), [frame(1, "3/2")]),
    "stadium between three points": Scene(
        stadium(-1, 1, "1/10"), [disc(0, 0, "1/10"), disc("3/2", 0, "1/10"), disc("1/2", "5/4", "1/10")]
    ),
    "L in a horseshoe": Scene(
        Curved([(0, 0), ("9/10", 0), ("9/10", "9/20"), ("9/20", "9/20"), ("9/20", "9/10"), (0, "9/10")], grown="1/20"),
        [horseshoe(0, 0)],
    ),
    "square between four discs": Scene(
        Curved(SQUARE, grown="1/10"), [disc(x, y, "1/10") for x in (0, 1) for y in (0, 1)]
    ),
    "slot of the robot's width": Scene(
        Curved(SQUARE, grown="1/10"), [rectangle("1/2", "1/2"), rectangle("1/2", "1/2", "11/5")]
    ),
    "one offset line of two radii": Scene(
        Curved(SQUARE, grown="1/10"),
        [Curved(rectangle(1, "1/2", "-3/2", "-1/2"), grown="1/5"), rectangle(1, "3/5", "3/2", "-2/5")],
    ),
    "circles that coincide at one angle": Scene(
        Curved(horseshoe("-3/2", -1, "5/2"), grown="1/8"), [disc(0, 0, "1/8"), disc(2, "1/2", "1/8")]
    ),
    "split inside a band": Scene(stadium(0, "3/5", "1/20"), [disc(0, 0, 1), rectangle(2, "1/20", 0, "9/10")]),
    "two horseshoes": Scene(Curved(horseshoe("-3/2", -1), grown="1/20"), [horseshoe(1, 1), disc(5, 0, "3/10")]),
}
# with ties at all angles; the smaller robot has the radius that is stated
TIES: dict[str, tuple[Scene, Fraction]] = {
    "discs that touch all along": (
        Scene(disc(0, 0, "3/10"), [disc(x, y, "1/4") for x in (0, 1) for y in (0, 1)]),
        F(1, 4),
    ),
    "lattice of discs": (Scene(disc(0, 0, "3/5"), [disc(x, y, "1/2") for x in range(3) for y in range(3)]), F(1, 2)),
    "three circles through two points": (
        Scene(disc(0, 0, "1/5"), [disc(0, 0, "39/10"), disc(-3, 0, "49/10"), disc(3, 0, "49/10")]),
        F(1, 10),
    ),
    "edges of two radii on one offset line": (
        Scene(
            Curved([(1, 1), (0, 1), (-1, 0), (1, -1)], grown="101/1000"),
            [
                Curved([(-2, 0), (-3, 0), (-4, -1), (-3, -2), (-2, -2)], grown="1/2"),
                rectangle("1/2", "1/2", -3, 0),
            ],
        ),
        F(1, 10),
    ),
    "slit": (Scene(disc(0, 0, "3/10"), [SQUARE, rectangle("1/2", "1/2", "3/2")]), F(1, 4)),
}


def made(scene: Scene, radius: Fraction) -> tuple[Any, ...]:
    shapes = rounded_shapes(scene)
    assert shapes is not None
    parts, others = shapes.robot, shapes.obstacles
    radii = [radius] * len(parts) + [other.radius for other in others]
    handles = [part.handle for part in parts], [other.handle for other in others]
    features = core.SceneFeatures(*handles, None, None, None, [(radius, ()) for radius in radii])
    boundary = core.compute_boundary(features.scene, 1, core.may_have_slits(features.scene), lambda _: True)
    numbered = SceneFeatures.of(features)
    wrapped = boundary_of(scene, numbered, boundary)
    wrapped.regularized = wrapped
    return parts, others, numbered, boundary, free_space(wrapped)


@cache
def surfaces(scene: Scene, radius: Fraction) -> list[RoundSeparation]:
    """All closed surfaces of the robot with another radius, as proofs about far poses."""
    parts, others, features, boundary, space = made(scene, radius)
    return [
        proof_of(parts, others, features, boundary, radius, np.flatnonzero(space.component == k))
        for k in range(int(space.component.max()) + 1)
    ]


def proof_of(parts: Any, others: Any, features: Any, boundary: Any, radius: Fraction, faces: Any) -> RoundSeparation:
    table, patches = boundary.trapezoids, boundary.patches
    patch = table.patch[faces]
    columns = {name: getattr(table, name)[faces] for name in COLUMNS}
    columns["patch"] = np.arange(len(faces), dtype=np.int32)
    return RoundSeparation(
        [replace(part, radius=radius) for part in parts],
        others,
        Features.numbered(features.robot),
        Features.numbered(features.obstacles),
        np.asarray(patches.kind)[patch],
        np.asarray(patches.robot)[patch],
        np.asarray(patches.obstacle)[patch],
        Trapezoids(**columns),
        FAR,
        FAR,
    )


def robot_radius(scene: Scene) -> Fraction:
    part = rounded(scene.robot[0])
    assert part is not None
    return part.radius


def kinds(proof: RoundSeparation, scene: Scene) -> set[str]:
    return {finding.kind for finding in round_separation_findings(proof, scene)}


def start_of(proof: RoundSeparation, scene: Scene) -> cfree.Pose:
    """Random pose that the surface separates from far away."""
    rng = random.Random(1)
    for _ in range(2000):
        pose = cfree.Pose(rng.uniform(-4, 5), rng.uniform(-4, 5), rng.uniform(0, 6))
        if not kinds(replace(proof, start=pose), scene):
            return pose
    raise AssertionError("no pose is inside the surface")


# --- true surfaces ---


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_surfaces_of_a_robot_smaller_by_a_hair_are_closed_contacts(name: str) -> None:
    scene = SCENES[name]
    for proof in surfaces(scene, robot_radius(scene) - HAIR):
        assert kinds(proof, scene) == {"two sides"}  # only as both poses are far away


@pytest.mark.parametrize("name", TIES)
def test_surfaces_with_ties_at_all_angles_are_closed(name: str) -> None:
    scene, radius = TIES[name]
    for proof in surfaces(scene, radius):
        assert kinds(proof, scene) == {"two sides"}


def test_a_disc_too_large_for_a_gap_by_a_hair_is_separated() -> None:
    walls = [rectangle(2, "1/2", -3, 0), rectangle(2, "1/2", 3, 0), rectangle(5, "1/2", 0, 5)]
    walls += [rectangle("1/2", 5, s * 5, "5/2") for s in (-1, 1)]
    scene = Scene(Curved.circle((0, 0), 1 + 2 * HAIR), walls)
    proofs = [replace(p, start=cfree.Pose(0, 2), goal=cfree.Pose(0, -9)) for p in surfaces(scene, 1 + HAIR)]
    assert [not kinds(proof, scene) for proof in proofs].count(True) >= 1
    exact = [replace(p, start=cfree.Pose(0, 2), goal=cfree.Pose(0, -9)) for p in surfaces(scene, F(1) - HAIR)]
    assert all(kinds(proof, scene) == {"two sides"} for proof in exact)


def test_start_and_goal_on_one_side_are_found() -> None:
    scene = SCENES["bar turning in a frame"]
    room = cfree.Pose(0, 0)
    ways = [kinds(replace(p, start=room), scene) for p in surfaces(scene, robot_radius(scene) - HAIR)]
    assert set() in ways
    for proof in surfaces(scene, robot_radius(scene) - HAIR):
        assert kinds(replace(proof, start=room, goal=cfree.Pose(0, "1/100")), scene) == {"two sides"}


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_sides_agree_with_distances_of_cores(name: str) -> None:
    scene = SCENES[name]
    radius = robot_radius(scene) - HAIR
    proofs = surfaces(scene, radius)
    scale, bits = scale_of(HAIR, size_of(proofs[0]), sum(map(len, proofs)))
    rng, tried = random.Random(name), 0
    with precision(bits):
        pieces = [reader.piece(k) for p in proofs for reader in [Reader(p, scale)] for k in range(len(p))]
        for _ in range(60):
            pose = cfree.Pose(rng.uniform(-3, 4), rng.uniform(-3, 4), rng.uniform(0, 6.28))
            gaps = [
                flat(body.core, pose).distance(flat(other.core)) - float(radius + other.radius)
                for body in proofs[0].robot
                for other in proofs[0].obstacles
            ]
            if min(map(abs, gaps)) > 1e-6:
                tried += 1
                shift = scale.near * 2**16
                assert is_inside(pose, pieces, scale, shift, shift) == (min(gaps) < 0)
    assert tried > 30


def flat(body: Any, pose: cfree.Pose | None = None) -> Any:
    if isinstance(body, Polygon):
        rings = [[(float(x), float(y)) for x, y in ring] for ring in body.exact_rings]
        shape = shapely.Polygon(rings[0], rings[1:])
    else:
        points = [(float(x), float(y)) for x, y in body]
        shape = shapely.Point(points[0]) if len(points) == 1 else shapely.LineString(points)
    if pose is None:
        return shape
    turned = shapely.affinity.rotate(shape, pose.theta, origin=(0, 0), use_radians=True)
    return shapely.affinity.translate(turned, float(pose.x), float(pose.y))


# --- mutations ---

ENDS = ("first", "second", "lo", "hi", "place")
BRANCH, TURN = np.uint64(2 << 59), np.uint64(1 << 59)


def column(proof: RoundSeparation, **columns: Any) -> RoundSeparation:
    return replace(proof, table=replace(proof.table, **columns))


def put(values: Any, k: int, value: Any) -> Any:
    copy = values.copy()
    copy[k] = value
    return copy


def rows(proof: RoundSeparation, chosen: Any) -> RoundSeparation:
    columns = {name: getattr(proof.table, name)[chosen] for name in COLUMNS}
    columns["patch"] = np.arange(len(chosen), dtype=np.int32)
    names = ("kind", "robot_feature", "obstacle_feature")
    return replace(proof, table=Trapezoids(**columns), **{name: getattr(proof, name)[chosen] for name in names})


def with_radius(proof: RoundSeparation, radius: Fraction) -> RoundSeparation:
    """The same surface, as one of a robot with another radius."""
    features = replace(proof.robot_features, radii=(radius,) * len(proof.robot_features.radii))
    return replace(proof, robot=[replace(part, radius=radius) for part in proof.robot], robot_features=features)


def mutants(proof: RoundSeparation, k: int, rng: random.Random) -> Iterator[tuple[str, RoundSeparation]]:
    """Change piece k in every way that breaks the surface."""
    table, count = proof.table, len(proof)
    yield "a piece is left out", rows(proof, np.delete(np.arange(count), k))
    yield "a piece is there twice", rows(proof, np.append(np.arange(count), k))
    yield "the other chart", column(proof, chart=put(table.chart, k, 1 - table.chart[k]))
    yield (
        "its curves change places",
        column(proof, lower=put(table.lower, k, table.upper[k]), upper=put(table.upper, k, table.lower[k])),
    )
    end = rng.choice(("from", "to"))
    off = rng.choice((-1, 1)) * 10.0 ** -rng.randint(1, 6)
    moved = {f"{end}_{s}": put(v := getattr(table, f"{end}_{s}"), k, v[k] + off) for s in ("lo", "hi")}
    yield "an angle is moved", column(proof, **moved)
    for name in ("lower", "upper"):
        code = getattr(table, name)[k]
        if int(code) >> 61 == 5:
            yield "another end of a quadrant", column(proof, **{name: put(getattr(table, name), k, code ^ TURN)})
        elif int(code) >> 59 & 3 in (1, 3):
            yield "another branch", column(proof, **{name: put(getattr(table, name), k, code ^ BRANCH)})
    kind = int(proof.kind[k])
    if kind & 15 == 3:
        yield "another quadrant", replace(proof, kind=put(proof.kind, k, 3 + 16 * (((kind >> 4) + 1) % 4)))
    for name, features in (("robot", proof.robot_features), ("obstacle", proof.obstacle_features)):
        values = getattr(proof, f"{name}_feature")
        if len(features.points) > 1:
            other = (int(values[k]) + rng.randrange(1, len(features.points))) % len(features.points)
            yield f"another feature of the {name}", replace(proof, **{f"{name}_feature": put(values, k, other)})
        yield "no feature", replace(proof, **{f"{name}_feature": put(values, k, 1 << 20)})
        (x, y), *rest = features.points
        wrong = replace(features, points=((x + HAIR, y), *rest))
        yield f"a moved point of the {name}", replace(proof, **{f"{name}_features": wrong})
    yield "a radius of the scene", with_radius(proof, proof.robot[0].radius + HAIR)
    yield "a larger radius", with_radius(proof, proof.robot[0].radius + F(1, 100))
    yield "a negative radius", with_radius(proof, F(-1, 100))
    larger = replace(proof, obstacles=[replace(other, radius=other.radius + HAIR) for other in proof.obstacles])
    yield "a larger obstacle", larger
    radii = tuple(r + HAIR for r in proof.obstacle_features.radii)
    yield (
        "a larger obstacle, whose features are larger",
        replace(larger, obstacle_features=replace(proof.obstacle_features, radii=radii)),
    )
    yield "larger features", replace(proof, obstacle_features=replace(proof.obstacle_features, radii=radii))
    yield "fewer obstacles", replace(proof, obstacles=proof.obstacles[1:])
    yield "start is goal", replace(proof, start=proof.goal)


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [
        "stadium about a disc",
        pytest.param("slanted triangle, irrational lengths", marks=pytest.mark.long),
        pytest.param("circles that coincide at one angle", marks=pytest.mark.long),
    ],
)
def test_every_mutation_of_a_surface_is_found(name: str) -> None:
    scene, rng = SCENES[name], random.Random(name)
    for proof in surfaces(scene, robot_radius(scene) - HAIR):
        true = replace(proof, start=start_of(proof, scene))
        for k in rng.sample(range(len(true)), 3):
            for change, mutant in mutants(true, k, rng):
                assert kinds(mutant, scene), f"{change}, piece {k}"


@pytest.mark.parametrize("name", ["lattice of discs", "three circles through two points"])
def test_every_mutation_of_a_surface_with_ties_is_found(name: str) -> None:
    (scene, radius), rng = TIES[name], random.Random(name)
    proof = max(surfaces(scene, radius), key=len)
    for k in rng.sample(range(len(proof)), 4):
        for change, mutant in mutants(proof, k, rng):
            # no pose is asked for: the proof is about two far poses, so `two sides` alone would be no finding
            if change in ("a radius of the scene", "a larger radius", "start is goal"):
                continue
            assert kinds(mutant, scene) - {"two sides"}, f"{change}, piece {k}"


def test_half_of_a_surface_is_open_at_the_ends_of_a_chart() -> None:
    scene, radius = TIES["lattice of discs"]
    for proof in surfaces(scene, radius):
        half = rows(proof, np.flatnonzero(proof.table.chart == 0))
        findings = [str(finding) for finding in round_separation_findings(half, scene)]
        assert any("a side at tau = " in text for text in findings)


def test_a_curve_beyond_its_patch_or_without_a_point_is_found() -> None:
    scene = SCENES["slanted triangle, irrational lengths"]
    texts = set[str]()
    for proof in surfaces(scene, robot_radius(scene) - HAIR):
        curves = np.concatenate([proof.table.lower, proof.table.upper])
        for k in range(len(proof)):
            wrong = column(proof, upper=put(proof.table.upper, k, curves[(7 * k + 3) % len(curves)]))
            texts |= {finding.text for finding in round_separation_findings(rows(wrong, np.array([k])), scene)}
    assert {"a curve is beyond an end of its patch", "a curve that does not exist between its angles"} <= texts


# --- smaller shapes ---


def test_a_core_is_known_by_the_rim_of_its_shape() -> None:
    ends = ((F(4), F(1)), (F(0), F(1)))
    shape = Curved([(0, 0), (4, 0), Arc((4, 2), center=(4, 1)), (0, 2), Arc((0, 0), center=(0, 1))])
    assert largest_radius(ends, shape) == largest_radius(ends[::-1], shape) == 1
    assert largest_radius(((F(4), F(1)), (F(1), F(1))), shape) is None
    upper = [(4, 2), Arc((3, 3), center=(3, 2)), (1, 3), Arc((0, 2), center=(1, 2))]
    soft = Curved([(1, 0), (3, 0), Arc((4, 1), center=(3, 1)), *upper, (0, 1), Arc((1, 0), center=(1, 1))])
    square = Polygon([(1, 1), (3, 1), (3, 2), (1, 2)])
    assert largest_radius(square, soft) == 1
    assert largest_radius(Polygon([(1, 1), (3, 1), (3, 2)]), soft) is None
    assert largest_radius(square, square) == 0
    assert largest_radius(square, Curved([(1, 1), (3, 1), (3, 2), (1, 2)], grown="1/3")) == F(1, 3)


def test_a_robot_of_the_scene_s_radius_is_no_smaller_shape() -> None:
    scene = SCENES["stadium about a disc"]
    (proof,) = surfaces(scene, robot_radius(scene) - HAIR)
    findings = list(round_separation_findings(with_radius(proof, robot_radius(scene)), scene))
    assert [finding.kind for finding in findings] == ["smaller shapes"]
    assert "strictly" in findings[0].text


def test_names_without_sense_are_findings() -> None:
    scene, rng = SCENES["stadium about a disc"], random.Random(3)
    (proof,) = surfaces(scene, robot_radius(scene) - HAIR)
    true = replace(proof, start=start_of(proof, scene))
    for name in ("lower", "upper", "from_first", "from_second", "to_first", "to_second"):
        values = getattr(true.table, name)
        for kind in range(8):
            code = np.uint64(kind << 61 | rng.randrange(4) << 59 | rng.randrange(3) << 31 | rng.randrange(3))
            k = rng.randrange(len(true))
            kinds(column(true, **{name: put(values, k, code)}), scene)  # no other error
            assert kinds(column(true, **{name: put(values, k, code | np.uint64(1 << 20))}), scene)
    for end in ("lo", "hi"):
        for number in (np.nan, np.inf, -3.0):
            assert kinds(column(true, **{f"to_{end}": put(getattr(true.table, f"to_{end}"), 2, number)}), scene)
