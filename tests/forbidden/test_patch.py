"""Names of patches, curves and critical angles mean the features they say."""

import cmath
import math
import random
from collections.abc import Callable
from fractions import Fraction
from functools import partial
from pathlib import Path

import flint
import numpy as np
import pytest

from cfree import Boundary, Scene, boundary, load_scene
from cfree.forbidden.patch import Contact, CriticalAngle, contact
from compared import cross, edge, minus, own_contact, placed, rotation, scene_of, vertex
from shapes import PlainScene, box, frame, random_scene

SCENES = Path(__file__).parents[2] / "examples" / "scenes"
NAMED = (
    "convex",
    "nonconvex",
    "holed",
    "overlapping",
    "touching",
    "axis_parallel",
    "regular",
    "integer_grid",
    "bounds",
)


def results(kinds=NAMED, seeds=range(4)) -> list[Boundary]:
    return [boundary(scene_of(random_scene(seed, kind)), threads=1) for kind in kinds for seed in seeds]


def test_patches_of_two_triangles_name_every_pair_once() -> None:
    scene = Scene(robot=[(0, 0), (2, 0), (0, 1)], obstacles=[[(5, 5), (8, 5), (6, 7)]], obstacle_names=["rock"])
    patches = boundary(scene).patches
    assert len(patches) == 18
    names = {(patch.kind, patch.robot.index, patch.obstacle.index) for patch in patches}
    assert names == {(kind, i, j) for kind in ("v-e", "e-v") for i in range(3) for j in range(3)}
    assert {patch.obstacle.name for patch in patches} == {"rock"}
    assert patches[-1] == patches[17] and patches[2:4] == [patches[2], patches[3]]
    with pytest.raises(IndexError):
        patches[18]


@pytest.mark.slow
def test_surfaces_are_those_of_the_features_named() -> None:
    rng = random.Random(1)
    for result in results():
        scene = result.scene
        places, expected, found = [], [], []
        for patch in result.patches:
            t, phi = rng.random(), rng.uniform(0, 6)
            c, s = math.cos(phi), math.sin(phi)
            if patch.kind == "e-v":
                (ax, ay), (dx, dy) = ((float(x), float(y)) for x, y in edge(scene, patch.robot, of_robot=True))
                ax, ay = ax + t * dx, ay + t * dy
                bx, by = map(float, vertex(scene, patch.obstacle, of_robot=False))
            else:
                ax, ay = map(float, vertex(scene, patch.robot, of_robot=True))
                (bx, by), (dx, dy) = ((float(x), float(y)) for x, y in edge(scene, patch.obstacle, of_robot=False))
                bx, by = bx + t * dx, by + t * dy
            places.append((patch.index, t, phi))
            expected.append((bx - (c * ax - s * ay), by - (s * ax + c * ay)))
            found.append(patch.surface(t, phi)[:2])
        assert np.allclose(found, expected, atol=1e-12)
        assert np.allclose(result.evaluate(*zip(*places, strict=True)), expected, atol=1e-12)


def test_places_name_polygon_ring_and_vertex_of_the_input() -> None:
    scene = Scene(
        robot=scene_of(PlainScene([box(0, 0, 1, 1), box(1, 0, 2, 3)], [])).robot,
        obstacles=scene_of(PlainScene([box(9, 9, 10, 10)], [frame(20, 1), box(30, 0, 31, 1)])).obstacles,
        obstacle_names=["ring", "box"],
    )
    for patch in boundary(scene).patches:
        polygon = scene.obstacles[patch.obstacle.polygon]
        assert patch.obstacle.name == scene.obstacle_names[patch.obstacle.polygon]
        i, j = polygon.ring_offsets[patch.obstacle.ring : patch.obstacle.ring + 2]
        assert i <= patch.obstacle.index < j
        assert patch.robot.index < len(scene.robot[patch.robot.polygon].vertices)


@pytest.mark.slow
def test_trapezoids_lie_in_the_orientations_of_their_patch() -> None:
    for result in results():
        patch = result.trapezoids.patch
        for theta in (result.trapezoids.theta_from, result.trapezoids.theta_to):
            after = (theta - result.phi_min[patch] + 1e-9) % (2 * math.pi)
            assert (after <= result.phi_range[patch] + 2e-9).all()
        live = np.unique(patch)
        assert [k for k, p in enumerate(result.patches) if p.is_live] == live.tolist()
        assert result.stats.live_patches == len(live)


def inside(result: Boundary, k: int, rng: random.Random) -> Fraction:
    columns = result.trapezoids
    lo, hi = Fraction(float(columns.from_hi[k])), Fraction(float(columns.to_lo[k]))
    return lo + (hi - lo) * rng.randint(1, 99) / 100


@pytest.mark.slow
def test_curves_of_trapezoids_are_where_the_surfaces_named_meet() -> None:
    rng = random.Random(2)
    for result in results():
        columns, scene = result.trapezoids, result.scene
        for k in rng.sample(range(len(columns)), min(len(columns), 60)):
            if columns.to_lo[k] - columns.from_hi[k] < 1e-6:
                continue
            chart, tau = int(columns.chart[k]), inside(result, k, rng)
            turn = rotation(chart, tau)
            theta = 2 * math.atan(tau) + math.pi * chart
            limits = [float(limit[0]) for limit in result.limits([k], [theta])]
            assert -1e-9 <= limits[0] <= limits[1] <= 1 + 1e-9
            origin, along = placed(scene, own_contact(result.patches[int(columns.patch[k])]), turn)
            for code, t in zip((columns.lower[k], columns.upper[k]), limits, strict=True):
                curve = contact(result, int(code))
                point, direction = placed(scene, curve, turn)
                u = minus(point, origin)
                if curve.kind == "v-v":
                    exact = (u[0] * along[0] + u[1] * along[1]) / (along[0] ** 2 + along[1] ** 2)
                    assert abs(cross(along, u)) <= 1e-25  # zero, but where doubles made collinear walls
                else:
                    exact = cross(u, direction) / cross(along, direction)
                assert abs(float(exact) - t) < 1e-6


def condition(scene: Scene, own: Contact, angle: CriticalAngle, chart: int, tau: Fraction) -> Fraction:
    """Zero where the angle is: edges parallel, the helix on the surface, three lines through one point."""
    turn = rotation(chart, tau)
    if angle.kind == "parallel":
        (pair,) = angle.features
        _, g = edge(scene, pair.robot, of_robot=True)
        _, f = edge(scene, pair.obstacle, of_robot=False)
        c, s = turn
        return cross((c * g[0] - s * g[1], s * g[0] + c * g[1]), f)
    lines = [placed(scene, one, turn) for one in (own, *angle.features)]
    (p, u), (q, v) = lines[0], lines[1]
    if angle.kind == "helix":
        return cross(u, minus(q, p))
    (r, w) = lines[2]
    if angle.features[0].kind == "v-v":
        return cross(w, minus(r, q))
    if angle.features[1].kind == "v-v":
        return cross(v, minus(q, r))
    return cross(minus(q, p), v) * cross(u, w) - cross(minus(r, p), w) * cross(u, v)


def squarefree(value: Callable[[Fraction], Fraction]) -> Callable[[Fraction], Fraction]:
    """A condition, times a power of 1 + tau^2, without multiple factors."""
    tau = flint.fmpq_poly([0, 1])
    p = flint.fmpq_poly()
    nodes = range(-2, 3)
    for i in nodes:
        exact = value(Fraction(i)) * (1 + i * i) ** 2
        basis = flint.fmpq_poly([flint.fmpq(exact.numerator, exact.denominator)])
        for j in nodes:
            if j != i:
                basis = basis * (tau - j) / (i - j)
        p += basis
    p = p // p.gcd(p.derivative())

    def at(x: Fraction) -> Fraction:
        y = p(flint.fmpq(x.numerator, x.denominator))
        return Fraction(int(y.p), int(y.q))

    return at


@pytest.mark.slow
def test_critical_angles_are_isolated_roots_of_their_conditions() -> None:
    rng = random.Random(3)
    checked = 0
    for result in results(("convex", "nonconvex", "overlapping", "integer_grid", "bounds")):
        for k in rng.sample(range(len(result.trapezoids)), min(len(result.trapezoids), 40)):
            trapezoid = result.trapezoid(k)
            own = own_contact(result.patches[trapezoid.patch])
            for angle in (trapezoid.start, trapezoid.stop):
                lo, hi = map(Fraction, angle.interval)
                if any(feature.obstacle.index < 0 for feature in angle.features):
                    continue  # a corner of the frame around the bounds
                if angle.kind == "chart end":
                    assert lo == hi and abs(lo) == 1
                    continue
                assert 0 <= hi - lo < 1e-6
                if angle.place == 0:
                    signs = [condition(result.scene, own, angle, trapezoid.chart, tau) for tau in (lo, hi)]
                    if signs[0] * signs[1] > 0:  # a touch
                        simple = squarefree(partial(condition, result.scene, own, angle, trapezoid.chart))
                        signs = [simple(tau) for tau in (lo, hi)]
                    assert signs[0] * signs[1] <= 0
                    checked += 1
            assert trapezoid.start.interval[1] <= trapezoid.stop.interval[1]
    assert checked > 500


COUNTED = {"chart end": 0, "parallel": 1, "helix": 1, "crossing": 2}  # the features that name an angle


@pytest.mark.parametrize("name", ["comb_hook", "sofa_corner"])
def test_every_angle_has_a_name(name: str) -> None:
    """The edges that it names are parallel there, the helix is on the patch, or the two curves on it meet."""
    result = boundary(load_scene(SCENES / f"{name}.json"))
    scene, columns, kinds = result.scene, result.trapezoids, set()
    for k in range(len(columns)):
        trapezoid = result.trapezoid(k)
        own, rounded = own_contact(result.patches[trapezoid.patch]), (columns.theta_from[k], columns.theta_to[k])
        for angle, theta in zip((trapezoid.start, trapezoid.stop), rounded, strict=True):
            kinds.add(angle.kind)
            assert len(angle.features) == COUNTED[angle.kind] and angle.theta == pytest.approx(theta, abs=1e-9)
            if any(feature.obstacle.index < 0 for feature in angle.features):
                continue  # a corner of the frame around the bounds
            if angle.kind == "parallel":
                assert angle.features[0].kind == "e-e"
                u, v = sides(scene, angle.features[0], angle.theta)
                assert abs((u.conjugate() * v).imag) < 1e-9 * abs(u * v)
            elif angle.kind != "chart end":
                p, u = line(scene, own, angle.theta)
                t = []
                for feature in angle.features:
                    q, v = line(scene, feature, angle.theta)
                    if feature.kind == "v-v":  # on the patch's line
                        assert abs((u.conjugate() * (q - p)).imag) < 1e-8 * abs(u)
                        t.append((u.conjugate() * (q - p)).real / abs(u) ** 2)
                    elif abs(D := (u.conjugate() * v).imag) > 1e-9 * abs(u * v):
                        t.append(((q - p).conjugate() * v).imag / D)
                assert np.ptp(t) < 1e-6
    assert kinds == set(COUNTED)


def test_every_curve_has_a_name() -> None:
    """Points of a trapezoid's curves are on the helix, or on the line of the surface, that their names say."""
    result = boundary(scene_of(random_scene(2, "bounds")))
    columns, kinds = result.trapezoids, set()
    middle = (columns.theta_from + columns.theta_to) / 2
    limits = result.limits(np.arange(len(columns)), middle)
    for codes, t in zip((columns.lower, columns.upper), limits, strict=True):
        points = result.evaluate(columns.patch, t, middle) @ (1, 1j)
        for code, theta, x in zip(codes.tolist(), middle.tolist(), points.tolist(), strict=True):
            curve = contact(result, code)
            kinds.add(curve.kind)
            start, along = line(result.scene, curve, theta)
            off = x - start
            assert abs(off if curve.kind == "v-v" else (along.conjugate() * off).imag / abs(along)) < 1e-9
    assert kinds == {"v-v", "v-e", "e-v"}


def sides(scene: Scene, contact: Contact, theta: float) -> tuple[complex, complex]:
    """The edges of a contact of two, the robot's turned."""
    (_, u), (_, v) = edge(scene, contact.robot, of_robot=True), edge(scene, contact.obstacle, of_robot=False)
    return cmath.exp(1j * theta) * complex(*u), complex(*v)


def line(scene: Scene, contact: Contact, theta: float) -> tuple[complex, complex]:
    """Start and direction of a contact's line; of a v-v helix, its point."""
    places = (contact.obstacle, False), (contact.robot, True)
    b, a = (complex(*vertex(scene, place, of_robot=of_robot)) for place, of_robot in places)
    v, u = (0j if place.end is None else complex(*edge(scene, place, of_robot=robot)[1]) for place, robot in places)
    R = cmath.exp(1j * theta)
    return b - R * a, v - R * u


def test_places_on_the_workspace_are_the_users() -> None:
    rim, holes = box(0, 0, 20, 20)[0], [box(8, 8, 9, 9)[0][::-1], box(3, 3, 4, 4)[0][::-1]]
    scene = scene_of(PlainScene([box(0, 0, 1, 2)], [], workspace=(rim, holes)))
    for patch in boundary(scene).patches:
        place = patch.obstacle
        if patch.kind == "e-v":
            t, phi = 0.0, 0.3
            a = np.array(vertex(scene, patch.robot, of_robot=True), float)
            turn = np.array([[math.cos(phi), -math.sin(phi)], [math.sin(phi), math.cos(phi)]])
            expected = np.array(vertex(scene, place, of_robot=False), float) - turn @ a
            assert np.allclose(patch.surface(t, phi)[:2], expected)
    named = {(patch.obstacle.ring, patch.obstacle.index) for patch in boundary(scene).patches}
    assert len(named) == 12
