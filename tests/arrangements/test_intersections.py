"""Where two contact surfaces meet: against lines that are placed and crossed one orientation at a time."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import pytest
from flint import fmpz_poly
from hypothesis import given, settings
from hypothesis import strategies as st

import meetings
from cfree import Polygon, Pose
from cfree.arrangements import IntersectionCurve, intersection, triple
from cfree.contact import EdgeVertex, VertexEdge, VertexVertex, contact_features, contact_surface
from cfree.contact.surface import Surface
from cfree.exact import AlgebraicAngle, AngleInterval
from cfree.exact.orientation import Location
from cfree.rational import rational_surface
from meetings import cross, crossing, difference, line_at, parameter
from rational_pairs import M, Vec, taus

TRIANGLE = Polygon([(-1, 0), (1, 0), (0, 2)])
BOX = Polygon([(0, 0), (9, 0), (9, 2), (0, 2)])
FEW = settings(max_examples=40)


def surface(robot: Polygon, obstacle: Polygon, kind: type, i: int, j: int) -> Surface:
    return contact_surface(robot, obstacle, kind(i, j))


# example


def test_a_ladder_between_floor_and_wall() -> None:
    ladder, room = Polygon([(-1, 0), (3, 0), (0, 1)]), Polygon([(0, 0), (9, 0), (9, 9), (0, 9)])
    found = intersection(surface(ladder, room, VertexEdge, 0, 0), surface(ladder, room, VertexEdge, 1, 3))
    # the left end on y = 0, the right end on x = 0: x = -3 cos, y = sin
    assert found.curve is not None and found.curve.degree == 2
    assert found.curve.harmonics == ((0, -3, 0, 0, 0), (0, 0, 1, 0, 0), (1, 0, 0, 0, 0))
    # the left end is on the floor from 90 to 270 degrees, the right end above it up to 180
    assert [part.theta for part in found.ranges] == [(math.pi / 2, math.pi)]
    assert found.lines == () and not found.is_empty


def test_an_edge_about_two_vertices_is_a_limacon() -> None:
    robot, bar = Polygon([(0, 0), (2, 0), (0, 2)]), Polygon([(0, 0), (1, 0), (0, 1)])
    found = intersection(surface(robot, bar, EdgeVertex, 0, 0), surface(robot, bar, EdgeVertex, 2, 1))
    # the corner of a right angle that passes through (0, 0) and (1, 0): on Thales' circle
    assert found.curve is not None
    theta = np.linspace(0, 6, 7)
    x, y, _ = found.curve(theta).T
    assert np.hypot(x - 0.5, y) == pytest.approx(0.5) and found.curve.degree == 4
    assert found.curve.harmonics == (
        (Fraction(1, 2), 0, 0, Fraction(1, 2), 0),
        (0, 0, 0, 0, Fraction(1, 2)),
        (1, 0, 0, 0, 0),
    )


# property


@pytest.mark.slow
@FEW
@given(meetings.surfaces(2), st.lists(taus, min_size=3, max_size=6))
def test_lines_meet_where_the_curve_is_and_nowhere_else(pair: tuple[Surface, Surface], at: list[Any]) -> None:
    found = intersection(*pair)
    assert found.relation == "curve" or all(not line.tangency for line in found.lines)
    if found.curve:
        both_turn_or_stand = any(pair[0].g) == any(pair[1].g)
        assert found.curve.degree <= (2 if not any((*pair[0].g, *pair[1].g)) else 4)
        assert not (both_turn_or_stand and (found.lines or found.curve.asymptotes))
        at += [tau for angle in found.curve.asymptotes for tau in angle.neighbours(90)]
    at += [tau for line in found.lines for tau in line.angle.neighbours(90)]
    at += [tau for part in found.ranges for end in (part.start, part.stop) if end for tau in end.neighbours(90)]
    shared = {line.angle: line for line in found.lines}
    for tau in at:
        one, other = (line_at(s, tau) for s in pair)
        here = AlgebraicAngle.of(Pose(0, 0, {"tau": tau}))
        is_inside = any(part.contains(here) for part in found.ranges)
        point = crossing(one, other)
        if point is not None:
            assert found.curve is not None and found.curve.point(tau) == point and here not in shared
            ts = [parameter(line, point) for line in (one, other)]
            assert is_inside == all(t is not None and 0 <= t <= 1 for t in ts)
        elif parameter(one, other[0]) is not None:  # one line
            ends = sorted(parameter(one, (x + s * u, y + s * v)) for (x, y), (u, v) in [other] for s in (0, 1))  # type: ignore[type-var]
            low, high = max(ends[0], 0), min(ends[1], 1)
            assert found.relation == "identical" or here in shared
            t_range = found.overlap if found.relation == "identical" else shared[here].t_range
            assert t_range == (pytest.approx((float(low), float(high)), abs=1e-15) if low <= high else None)
        else:
            assert found.relation != "identical" and here not in shared and not is_inside
            if found.curve:
                assert here in found.curve.asymptotes
                with pytest.raises(ValueError, match="asymptote"):
                    found.curve.point(tau)


@pytest.mark.slow
@FEW
@given(meetings.surfaces(2))
def test_the_order_of_surfaces_does_not_matter(pair: tuple[Surface, Surface]) -> None:
    one, other = intersection(*pair), intersection(*pair[::-1])
    assert (one.relation, one.curve, one.ranges) == (other.relation, other.curve, other.ranges)
    assert [(a.angle, a.multiplicity, a.tangency, bool(a.t_range)) for a in one.lines] == [
        (b.angle, b.multiplicity, b.tangency, bool(b.t_range)) for b in other.lines
    ]


@pytest.mark.slow
@FEW
@given(meetings.surfaces(2))
def test_surfaces_are_tangent_where_it_is_said_and_nowhere_else(pair: tuple[Surface, Surface]) -> None:
    found = intersection(*pair)
    for line in found.lines:
        tau = line.angle.neighbours(300)[0]
        (Px, Py), (Ux, Uy) = line_at(pair[0], tau)
        sines = [sine_squared(pair, tau, (Px + t * Ux, Py + t * Uy)) for t in (-1, Fraction(1, 3), 1)]
        assert (max(sines) < NEAR) == (line.multiplicity == 2)
        if found.curve:
            assert line.tangency == found.curve.rounded(line.angle)
            assert sine_squared(pair, tau, found.curve.near(line.angle, 300)) < NEAR < max(sines)
    if found.curve:
        angles = [line.angle for line in found.lines]
        for tau in (Fraction(n, 3) for n in range(-9, 10)):
            here = AlgebraicAngle.of(Pose(0, 0, {"tau": tau}))
            if here not in angles and here not in found.curve.asymptotes:
                assert sine_squared(pair, tau, found.curve.point(tau)) > NEAR


NEAR = Fraction(1, 10**80)


def sine_squared(pair: tuple[Surface, Surface], tau: Fraction | None, x: Vec) -> Fraction:
    """Of the angle between the normals of two surfaces at a pose on both: gradients of (x - P) x U."""
    gradients = []
    for s in pair:
        P, U = line_at(s, tau)
        (ax, ay), (gx, gy) = M(tau, s.a), M(tau, s.g)
        turning = cross((-ay, ax), U) + cross(difference(x, P), (gy, -gx))  # P' = -J R a, U' = -J R g
        gradients.append((U[1], -U[0], turning))
    (a, b, c), (d, e, f) = gradients
    normal = b * f - c * e, c * d - a * f, a * e - b * d
    return sum(k * k for k in normal) / sum(k * k for k in (a, b, c)) / sum(k * k for k in (d, e, f))


@pytest.mark.slow
@FEW
@given(meetings.surfaces(2), taus)
def test_harmonics_are_the_curve_and_it_is_in_lowest_terms(pair: tuple[Surface, Surface], tau: Fraction | None) -> None:
    curve = intersection(*pair).curve
    if curve is None or tau in [t for angle in curve.asymptotes for t in angle.neighbours(60)]:
        return
    check_harmonics(curve, tau)
    for divisor in ((1, 0, 1), (0, 1), (1, 1), (-1, 1), (2, 1)):  # 1 + tau^2, tau, ...
        remainders = [fmpz_poly(list(row)) % fmpz_poly(list(divisor)) for row in (curve.x, curve.y, curve.w)]
        assert len(curve.w) == 1 or any(remainder != 0 for remainder in remainders)
    assert len(curve.w) == 1 or any(row[-1] for row in (curve.x, curve.y, curve.w))


def check_harmonics(curve: IntersectionCurve, tau: Fraction | None) -> None:
    (c, s) = M(tau, (Fraction(1), Fraction(0)))
    waves = (1, c, s, c * c - s * s, 2 * c * s)
    x, y, w = (sum(k * wave for k, wave in zip(row, waves, strict=True)) for row in curve.harmonics)
    assert (x, y) == tuple(w * value for value in curve.point(tau))


def test_a_line_shared_once_leaves_degree_3_and_shared_twice_2() -> None:
    # the edge from (0, 0) to (1, 0) along y = 0 at 0 degrees only: the vertex (0, 1) is on the line y = 1 then
    robot, bar = Polygon([(0, 0), (1, 0), (0, 1)]), Polygon([(5, 0), (4, -3), (7, -2)])
    hall = Polygon([(0, 1), (9, 1), (9, 4)])
    pair = contact_surface(robot, hall, VertexEdge(2, 0)), contact_surface(robot, bar, EdgeVertex(0, 0))
    found = intersection(*pair)
    assert [round(math.degrees(line.angle.theta)) for line in found.lines] == [0]
    assert found.curve is not None and found.curve.degree == 3
    assert [round(math.degrees(angle.theta)) for angle in found.curve.asymptotes] == [180]
    for tau in (Fraction(0), Fraction(1, 3), Fraction(-7)):
        check_harmonics(found.curve, tau)
    helix = intersection(surface(robot, bar, VertexEdge, 0, 0), surface(robot, bar, EdgeVertex, 0, 0))
    assert helix.curve is not None and (helix.curve.degree, len(helix.lines)) == (0, 2)  # the reference point stays


# patches


def test_a_patch_counts_for_its_angles_alone() -> None:
    contacts = [(BOX, VertexEdge(0, 2)), (Polygon([(4, 3), (6, 4), (5, 5)]), EdgeVertex(0, 0))]
    whole = [contact_surface(TRIANGLE, O, contact) for O, contact in contacts]
    patches = [rational_surface(TRIANGLE, O, contact) for O, contact in contacts]
    on_surfaces, on_patches, on_one = (intersection(*pair).ranges for pair in (whole, patches, (whole[0], patches[1])))
    seen = set()
    for tau in [Fraction(n, 7) for n in range(-30, 31)] + [None]:
        on, one, all_of_it = (any(p.contains({"tau": tau}) for p in r) for r in (on_patches, on_one, on_surfaces))
        inside = [S.Phi is not None and S.Phi.locate(tau) is not Location.OUTSIDE for S in patches]
        assert on == (all_of_it and all(inside)) and one == (all_of_it and inside[1])
        seen.add((on, one, all_of_it))
    assert seen == {(True, True, True), (False, True, True), (False, False, True), (False, False, False)}


def test_a_reflex_vertex_has_no_patch_to_meet() -> None:
    corner = Polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])
    none, some = rational_surface(TRIANGLE, corner, EdgeVertex(0, 3)), rational_surface(TRIANGLE, BOX, VertexEdge(0, 2))
    assert intersection(none, some).ranges == () != intersection(none.surface, some.surface).ranges
    found = triple(none, some, contact_surface(TRIANGLE, BOX, VertexEdge(1, 1)))
    assert found.contacts == () and found.poses


def is_end(end: VertexVertex, contact: VertexEdge | EdgeVertex) -> bool:
    """Of triangles."""
    i, j = (contact.i, contact.j)
    if isinstance(contact, VertexEdge):
        return end.i == i and end.j in (j, (j + 1) % 3)
    return end.j == j and end.i in (i, (i + 1) % 3)


@settings(max_examples=25)
@given(st.data())
def test_poses_of_a_range_have_both_contacts(data: st.DataObject) -> None:
    robot, other = Polygon([(-2, 0), (2, -1), (1, 2)]), Polygon([(0, 0), (3, 1), (2, 4)])
    index, kind = st.integers(0, 2), st.sampled_from([VertexEdge, EdgeVertex])
    contacts = [data.draw(kind)(data.draw(index), data.draw(index)) for _ in range(2)]
    found = intersection(*(contact_surface(robot, other, contact) for contact in contacts))
    inside = [part.start.neighbours(60)[1] for part in found.ranges if part.start and not part.is_single]
    for tau in inside + data.draw(st.lists(taus, min_size=3, max_size=3)):
        if found.curve and tau not in [t for a in found.curve.asymptotes for t in a.neighbours(1)]:
            features = contact_features(robot, other, found.curve.pose({"tau": tau}))
            ends = [f for f in features if isinstance(f, VertexVertex)]
            have = [contact in features or any(is_end(end, contact) for end in ends) for contact in contacts]
            assert all(have) == any(part.contains({"tau": tau}) for part in found.ranges)


# parallel and identical surfaces


def test_parallel_surfaces_share_lines_touch_or_are_apart() -> None:
    def between_floor_and(height: str) -> list[tuple[float, int, Any]]:
        box = Polygon([(0, 0), (9, 0), (9, height), (0, height)])
        found = intersection(surface(TRIANGLE, box, VertexEdge, 0, 0), surface(TRIANGLE, box, VertexEdge, 1, 2))
        assert found.relation == "parallel" and found.curve is None and found.ranges == ()
        assert found.is_empty == (not found.lines)
        return [(round(math.degrees(a.angle.theta), 9), a.multiplicity, a.t_range) for a in found.lines]

    # the vertices are 2 apart; the second is on the line from right to left, above the first
    left, right = (pytest.approx(t) for t in (math.sqrt(3) / 9, 1 - math.sqrt(3) / 9))
    assert between_floor_and("1") == [(30, 1, (0, right)), (150, 1, (left, 1))]
    assert between_floor_and("2") == [(90, 2, (0, 1))]
    assert between_floor_and("2.0000000000000000000001") == []

    # the same for a bar of the robot, 2 wide, and two corners
    bar = Polygon([(0, 0), (9, 0), (9, 2), (0, 2)])
    for distance, times in (("3", [1, 1]), ("2", [2]), ("1.99", [])):
        corners = [Polygon([(0, y), (1, y), (0, 5)]) for y in ("0", distance)]
        found = intersection(*(surface(bar, O, EdgeVertex, i, 0) for O, i in zip(corners, (0, 2), strict=True)))
        assert found.relation == "parallel" and [line.multiplicity for line in found.lines] == times


def test_one_line_is_one_surface() -> None:
    two = Polygon([(0, 0), (1, 0), (1, 5), (4, 5), (4, 0), (6, 0), (6, 9), (0, 9)])
    near, far = (surface(TRIANGLE, two, VertexEdge, 2, j) for j in (0, 4))
    found = intersection(near, far)
    assert (found.relation, found.overlap, found.ranges) == ("identical", None, ())
    again = intersection(near, surface(TRIANGLE, BOX, VertexEdge, 2, 0))
    assert (again.overlap, again.ranges) == ((0, 1), (AngleInterval(None, None),))
    assert intersection(surface(TRIANGLE, BOX, VertexEdge, 2, 0), near).overlap == (0, Fraction(1, 9))
    patches = rational_surface(TRIANGLE, BOX, VertexEdge(2, 0)), rational_surface(TRIANGLE, two, VertexEdge(2, 0))
    Phi = patches[0].Phi
    (both,) = intersection(*patches).ranges
    assert Phi is not None
    for angle, end in zip((both.start, both.stop), (Phi.start, Phi.end), strict=True):
        assert angle is not None and math.remainder(angle.theta - end.theta, math.tau) == pytest.approx(0, abs=1e-15)
    other = intersection(near, surface(TRIANGLE, two, VertexEdge, 1, 0))
    assert other.relation == "parallel"  # another vertex


def test_a_shared_vertex_and_a_shared_line() -> None:
    # both at vertex 0 of the robot and of the box: the v-v helix is the curve
    found = intersection(surface(TRIANGLE, BOX, VertexEdge, 0, 0), surface(TRIANGLE, BOX, EdgeVertex, 0, 0))
    assert found.curve is not None and found.curve.harmonics[0] == (0, 1, 0, 0, 0) and found.curve.degree == 2
    assert found.ranges == (AngleInterval(None, None),)
    assert [round(math.degrees(line.angle.theta)) for line in found.lines] == [0, 180]
    assert [line.tangency for line in found.lines] == [(1, 0), (-1, 0)]


def test_a_surface_without_an_edge_is_refused() -> None:
    zero = Fraction(0), Fraction(0)
    nothing = Surface(VertexEdge(0, 0), zero, zero, zero, zero)
    with pytest.raises(ValueError, match="no edge"):
        intersection(nothing, surface(TRIANGLE, BOX, VertexEdge, 0, 0))


# the curve


def curves() -> dict[str, IntersectionCurve]:
    robot = Polygon([("-1.3", "0.2"), (1, "-0.4"), ("0.3", 2)])
    obstacle = Polygon([(3, 1), ("6.1", "1.7"), (5, 4), ("2.5", "3.3")])
    far = Polygon([(x + 10**9, y - 10**9) for x, y in obstacle.exact_vertices])
    found = {}
    for name, O, (one, other) in [
        ("two v-e", obstacle, (VertexEdge(0, 0), VertexEdge(1, 1))),
        ("two e-v", obstacle, (EdgeVertex(0, 0), EdgeVertex(1, 1))),
        ("both", obstacle, (VertexEdge(0, 0), EdgeVertex(1, 2))),
        ("far", far, (EdgeVertex(0, 0), EdgeVertex(1, 1))),
    ]:
        curve = intersection(contact_surface(robot, O, one), contact_surface(robot, O, other)).curve
        assert curve is not None
        found[name] = curve
    return found


@pytest.mark.parametrize(("name", "curve"), curves().items())
def test_tangent_curvature_and_torsion_are_those_of_the_harmonics(name: str, curve: IntersectionCurve) -> None:
    scale = 0.7

    def place(theta: Any) -> Any:
        c = [1, mpmath.cos(theta), mpmath.sin(theta), mpmath.cos(2 * theta), mpmath.sin(2 * theta)]
        x, y, w = (sum(mpmath.mpf(k.numerator) / k.denominator * f for k, f in zip(row, c)) for row in curve.harmonics)  # noqa: B905
        return x / w, y / w, scale * theta

    with mpmath.workdps(40):
        for theta in (0.3, 1.9, 3.7, 5.8):
            at = curve(theta)
            assert [float(v) for v in place(theta)] == pytest.approx([*at[:2], scale * at[2]], rel=1e-14)
            d1, d2, d3 = (
                np.array([float(mpmath.diff(lambda u, k=k: place(u)[k], theta, n)) for k in range(3)])
                for n in (1, 2, 3)
            )
            normal, speed = np.cross(d1, d2), np.linalg.norm(d1)
            assert curve.tangent(theta, angle_scale=scale) == pytest.approx(d1 / speed, rel=1e-9)
            assert curve.curvature(theta, angle_scale=scale) == pytest.approx(
                np.linalg.norm(normal) / speed**3, rel=1e-9
            )
            assert curve.torsion(theta, angle_scale=scale) == pytest.approx(normal @ d3 / (normal @ normal), rel=1e-8)


@pytest.mark.parametrize("name", ["two v-e", "two e-v", "both", "far"])
def test_the_length_is_that_of_a_fine_polyline_and_within_its_error(name: str) -> None:
    curve = curves()[name]
    ends = [AlgebraicAngle.of(Pose(0, 0, {"tau": t})) for t in ("1/3", -3)]
    for interval in (AngleInterval(*ends), AngleInterval(*ends[::-1]), AngleInterval(None, None)):
        length, error = curve.length(interval, angle_scale=0.7)
        if any(interval.contains(angle) for angle in curve.asymptotes):
            assert (length, error) == (math.inf, 0)
            continue
        assert 0 < error < 1e-14 * length
        points = curve(np.linspace(*interval.theta, 20_001)) * (1, 1, 0.7)
        polyline = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
        assert length == pytest.approx(polyline, rel=1e-7) and (name == "far" or length >= polyline - 1e-10)
    assert curve.length(AngleInterval(ends[0], ends[0])) == (0, pytest.approx(0, abs=1e-25))


@pytest.mark.slow
def test_at_an_asymptote_there_is_nothing() -> None:
    slope, corner = Polygon([(0, 0), (4, 0), (0, 3)]), Polygon([(0, 0), (1, 5), (-3, 5)])
    pair = contact_surface(slope, BOX, VertexEdge(1, 0)), contact_surface(slope, corner, EdgeVertex(0, 0))
    curve = intersection(*pair).curve
    assert curve is not None and [angle.theta for angle in curve.asymptotes] == []
    pair = contact_surface(slope, BOX, VertexEdge(2, 0)), contact_surface(slope, corner, EdgeVertex(0, 1))
    curve = intersection(*pair).curve
    assert curve is not None and [angle.theta for angle in curve.asymptotes] == [0, math.pi]
    assert not np.isfinite(curve([0.0, math.pi])[:, :2]).any() and np.isfinite(curve(1.0)).all()
    for of in (curve.tangent, curve.curvature, curve.torsion):
        assert np.isnan(of([0.0, math.pi])).all() and np.isfinite(of([0.5, 1.0])).all()
    near = [AlgebraicAngle.of(Pose(0, 0, {"tau": tau})) for tau in (Fraction(1, 10**9), 1)]
    assert curve.length(AngleInterval(*near))[0] > 1e8
    nearer = AlgebraicAngle.of(Pose(0, 0, {"tau": Fraction(1, 10**60)}))
    assert curve.length(AngleInterval(nearer, near[1]))[0] > 1e59
    assert curve.length(AngleInterval(*near[::-1])) == (math.inf, 0)


def test_lengths_add_up_over_irrational_ends() -> None:
    found = intersection(*(contact_surface(TRIANGLE, BOX, c) for c in (VertexEdge(0, 0), EdgeVertex(1, 1))))
    assert found.curve is not None and found.ranges
    for part in found.ranges:
        assert part.start is not None and part.stop is not None
        middle = AlgebraicAngle.of(Pose(0, 0, sum(part.theta) / 2))
        whole, *halves = (
            found.curve.length(part),
            found.curve.length(AngleInterval(part.start, middle)),
            found.curve.length(AngleInterval(middle, part.stop)),
        )
        assert abs(whole[0] - sum(value for value, _ in halves)) <= whole[1] + sum(error for _, error in halves) + 1e-14


def test_points_at_exact_angles_are_as_near_as_is_asked_for() -> None:
    found = intersection(*(contact_surface(TRIANGLE, BOX, c) for c in (VertexEdge(0, 0), EdgeVertex(1, 1))))
    assert found.curve is not None
    angle = next(a for part in found.ranges for a in (part.start, part.stop) if a and len(a.polynomial) > 2)
    near, nearer = found.curve.near(angle, 40), found.curve.near(angle, 400)
    assert all(abs(a - b) <= Fraction(1, 2**39) for a, b in zip(near, nearer, strict=True))
    assert found.curve.rounded(angle) == pytest.approx([float(c) for c in nearer], rel=3e-16)
    assert found.curve(angle.theta)[:2] == pytest.approx([float(c) for c in nearer], abs=1e-14)
