"""Slices against the oracle, in doubles and exactly."""

import math
import random
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, Phase, assume, given, settings
from hypothesis import strategies as st

import oracles
import strategies
from cfree import boundary, load_scene
from cfree.forbidden.patch import Contact, Patch, contact
from compared import cross, length, minus, mistakes, placed, plain_of, rotation, scene_of
from examples import FOLDER, POLYGONS
from shapes import KINDS, PlainScene, box, random_scene

thorough = settings(
    deadline=None,
    derandomize=True,
    max_examples=40,
    suppress_health_check=[HealthCheck.too_slow],
    database=None,
    phases=[Phase.explicit, Phase.generate],  # scenes shrink too slowly
)


def test_a_unit_square_about_a_unit_square_is_an_octagon_or_a_square() -> None:
    #   +-----+        at 45 degrees:    +---+
    #   |     |  2 x 2                  /     \
    #   |     |  at 0                   |     |  sides 1, sqrt 1/2 each
    #   +-----+                          \   /
    result = boundary(scene_of(PlainScene([box(0, 0, 1, 1)], [box(3, 3, 4, 4)])))
    assert result.slice(0.0).forbidden.symmetric_difference(shapely.box(2, 2, 4, 4)).area < 1e-9
    octagon = result.slice("45deg")
    assert len(octagon.segments) == 8
    assert math.isclose(octagon.forbidden.area, 2 + 2 * math.sqrt(2))
    assert np.allclose(np.hypot(*(octagon.segments[:, 1] - octagon.segments[:, 0]).T), 1)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_slices_agree_with_united_sums_of_pieces(kind: str) -> None:
    for seed in range(12):
        plain = random_scene(seed, kind)
        result = boundary(scene_of(plain), threads=1)
        rng = random.Random(seed)
        wrong = [line for _ in range(7) for line in mistakes(plain, result, rng.uniform(0, 2 * math.pi))]
        assert not wrong, (kind, seed, wrong)


@pytest.mark.slow
@pytest.mark.parametrize("path", POLYGONS, ids=lambda path: path.stem)
def test_slices_of_the_shipped_scenes_agree(path: Path) -> None:
    scene = load_scene(path)
    plain, result = plain_of(scene), boundary(scene)
    rng = random.Random(path.stem)
    wrong = [line for _ in range(4) for line in mistakes(plain, result, rng.uniform(0, 2 * math.pi))]
    assert not wrong


@pytest.mark.slow
@thorough
@given(
    strategies.scenes(),
    st.none() | strategies.boxes(3).map(lambda shape: (*shape[0][0], shape[0][2][0] + 3, shape[0][2][1] + 3)),
    st.none() | strategies.holed_polygons(7) | strategies.simple_polygons(9),
    st.lists(st.floats(0, 6.28).map(lambda x: 0.999 * x + 0.00133), min_size=2, max_size=3),
)
def test_slices_of_degenerate_scenes_agree(plain, bounds, workspace, angles) -> None:
    plain = plain._replace(bounds=bounds, workspace=workspace)
    result = boundary(scene_of(plain), threads=1)
    assert not [line for angle in angles for line in mistakes(plain, result, angle)]


@pytest.mark.slow
@pytest.mark.parametrize("angle", ["0deg", "90deg", "180deg", "270deg", math.pi, 3 * math.pi / 2, {"tau": "inf"}])
def test_slices_at_right_angles_are_those_just_after(angle) -> None:
    for kind in ("convex", "touching", "axis_parallel", "integer_grid", "bounds", "workspace"):
        for seed in range(8):
            plain = random_scene(seed, kind)
            result = boundary(scene_of(plain), threads=1)
            now, after = result.slice(angle), result.slice(result.slice(angle).theta + 1e-7)
            assert now.trapezoids.tolist() == after.trapezoids.tolist()
            assert abs(now.forbidden.area - after.forbidden.area) < 1e-4
            assert np.abs(now.segments - after.segments).max(initial=0) < 1e-3, (kind, seed)


def test_slices_at_right_angles_keep_their_digits() -> None:
    result = boundary(load_scene(FOLDER / "degenerate_collinear_walls.json"))
    now, after = result.slice("0deg"), result.slice(1e-7)
    assert np.abs(now.segments - after.segments).max() < 2e-6


@pytest.mark.slow
@thorough
@given(strategies.scenes(), st.fractions(-1, 1, max_denominator=9), st.booleans())
def test_segments_are_free_and_forbidden_on_their_left_exactly(plain: PlainScene, tau: Fraction, half: bool) -> None:
    scene = scene_of(plain)
    result = boundary(scene, threads=1)
    columns = result.trapezoids
    at = float(tau)
    near = (np.abs(columns.tau_from - at) < 1e-9) | (np.abs(columns.tau_to - at) < 1e-9)
    assume(not (near & (columns.chart == half)).any() and abs(at) < 1)
    whole = (-1 / tau if tau else None) if half else tau
    turn = rotation(half, tau)
    cut = result.slice({"tau": "inf" if whole is None else str(whole)})
    hulls = oracles.exact_hulls(plain.robot, plain.obstacles, whole)
    ends = []
    for k in cut.trapezoids[:12].tolist():
        origin, along = placed(scene, contact_of(result.patches[int(columns.patch[k])]), turn)
        t = []
        for curve in (contact(result, int(columns.lower[k])), contact(result, int(columns.upper[k]))):
            point, direction = placed(scene, curve, turn)
            if curve.kind == "v-v":
                u = minus(point, origin)
                assert cross(along, u) == 0
                t.append((u[0] * along[0] + u[1] * along[1]) / (along[0] ** 2 + along[1] ** 2))
            else:
                t.append(cross(minus(point, origin), direction) / cross(along, direction))
        assert t[0] < t[1]
        ends.append((origin, along, t))
    for origin, along, t in ends:
        m = (t[0] + t[1]) / 2
        middle = origin[0] + m * along[0], origin[1] + m * along[1]
        scale = Fraction(1, 10**18)
        left = middle[0] - scale * along[1], middle[1] + scale * along[0]
        right = middle[0] + scale * along[1], middle[1] - scale * along[0]
        assert not oracles.in_some_hull(middle, hulls)
        assert oracles.in_some_hull(left, hulls)
        if oracles.in_some_hull(right, hulls):  # a slit: another segment lies there, in the opposite direction
            assert len(cut.trapezoids) > 40 or any(
                cross(v, along) == 0
                and v[0] * along[0] + v[1] * along[1] < 0
                and cross(v, minus(middle, p)) == 0
                and s[0] <= ((middle[0] - p[0]) * v[0] + (middle[1] - p[1]) * v[1]) / (v[0] ** 2 + v[1] ** 2) <= s[1]
                for p, v, s in ends
            )


def contact_of(patch: Patch) -> Contact:
    return Contact("v-e" if patch.kind == "bound" else patch.kind, patch.robot, patch.obstacle)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_middles_of_segments_touch_and_do_not_overlap(kind: str) -> None:
    for seed in range(3):
        plain = random_scene(seed, kind)
        result = boundary(scene_of(plain), threads=1)
        theta = random.Random(seed).uniform(0, 2 * math.pi)
        where = plain.robot, plain.obstacles
        segments = result.slice(theta).segments
        for p, q in segments[:: max(1, len(segments) // 12)]:
            middle, across = (p + q) / 2, np.array([p[1] - q[1], q[0] - p[0]])
            if np.hypot(*across) < 1e-5:
                continue
            pose = (*middle, theta)
            assert oracles.boundary_contact_distance(*where, pose, plain.bounds, plain.workspace) < 1e-12
            assert plain.workspace or oracles.overlap_area(*where, pose) < 1e-12
            left, right = middle + 1e-9 * across, middle - 1e-9 * across
            slice_ = oracles.forbidden_slice(*where, theta, plain.bounds, plain.workspace)
            assert shapely.contains(slice_, shapely.Point(left))
            assert not shapely.contains(slice_, shapely.Point(right)) or seen_twice(segments, p, q)


def seen_twice(segments, p, q) -> bool:
    """Does a segment of opposite direction pass through the middle of pq?"""
    u = (q - p) / np.hypot(*(q - p))
    v = segments[:, 1] - segments[:, 0]
    away = (p + q) / 2 - segments[:, 0]
    off = np.abs(v[:, 0] * away[:, 1] - v[:, 1] * away[:, 0]) / np.maximum(np.hypot(*v.T), 1e-300)
    along = (away * v).sum(axis=1) / np.maximum((v * v).sum(axis=1), 1e-300)
    return bool(((off < 1e-9) & (v @ u < 0) & (along >= 0) & (along <= 1)).any())


def test_a_slit_as_wide_as_the_robot_has_two_sides() -> None:
    # ####|  |####    robot 1 x 1 at 0 degrees: both sides of the slit touch, nothing is between them
    plain = PlainScene([box(0, 0, 1, 1)], [box(0, 0, 2, 4), box(3, 0, 5, 4)])
    cut = boundary(scene_of(plain)).slice({"tau": "0"})
    assert cut.forbidden.is_valid
    assert length(cut.segments) > 0
