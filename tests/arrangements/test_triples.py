"""Poses with three contacts: against interpolated determinants, roots in doubles, and poses made to touch."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import meetings
import strategies
from cfree import Polygon, Pose
from cfree.arrangements import intersection, triple
from cfree.contact import EdgeVertex, VertexEdge, contact_features, contact_surface, is_contact
from cfree.contact.surface import Surface
from cfree.exact import AlgebraicAngle, AngleInterval
from cfree.exact.number import to_fraction
from cfree.exact.orientation import Location
from cfree.rational import rational_surface
from meetings import cross, line_at, parameter
from rational_pairs import M

TRIANGLE = Polygon([(0, 0), (4, 0), (0, 3)])
HALL = Polygon([(0, 0), (9, 0), (9, 9), (0, 9)])


# example


def test_a_square_in_a_corner() -> None:
    """Three vertices of a unit square on two walls of a corner and on the line x + y = 2."""
    square, corner = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)]), Polygon([(0, 0), (9, 0), (0, 9)])
    slope = Polygon([(2, 0), (3, 3), (0, 2)])
    touched = (corner, 0, 0), (corner, 3, 2), (slope, 2, 2)
    found = triple(*(contact_surface(square, O, VertexEdge(i, j)) for O, i, j in touched))
    # vertex 0 at (x, 0), vertex 3 at (x - sin, cos), so x = sin; vertex 2 at (cos, cos + sin), so 2 cos + sin = 2
    assert found.relation == "points" and found.lines == ()
    assert [(pose.pose, pose.multiplicity) for pose in found.poses] == [
        (Pose(0, 0), 1), (Pose("4/5", 0, {"tau": "1/2"}), 1)
    ]  # fmt: skip
    assert found.polynomial == (0, -1, 2)
    assert [pose.location for pose in found.poses] == [Location.BOUNDARY, Location.INSIDE] and len(found.contacts) == 2
    assert found.poses[1].t == (pytest.approx(0.8 / 9), pytest.approx(1 - 0.6 / 9), pytest.approx(0.3))


def test_three_parallel_walls_are_touched_where_heights_agree() -> None:
    def walls(*heights: Any) -> list[Surface]:
        shapes = [Polygon([(0, h), (9, h), (9, to_fraction(h) + 1)]) for h in heights]
        return [contact_surface(TRIANGLE, O, VertexEdge(i, 0)) for i, O in enumerate(shapes)]

    # heights of the vertices: 0, 4 sin and 3 cos
    found = triple(*walls(0, 2, "1"))
    assert (found.relation, found.lines, found.poses, found.polynomial) == ("parallel", (), (), (0,))
    found = triple(*walls(0, "12/5", "12/5"))
    assert found.relation == "parallel" and found.contacts == ()
    (line,) = found.lines
    assert line.angle == AlgebraicAngle.of(Pose(0, 0, {"tau": "1/3"})) and line.tangency is None
    assert line.t_range == (pytest.approx(0.2), pytest.approx((9 - 3.2) / 9))


def test_surfaces_at_one_vertex_have_a_curve_in_common() -> None:
    at_corner = [(VertexEdge(0, 0)), VertexEdge(0, 3), EdgeVertex(0, 0)]
    found = triple(*(contact_surface(TRIANGLE, HALL, contact) for contact in at_corner))
    assert found.relation == "curve" and found.curve is not None and found.poses == ()
    assert found.curve.harmonics == ((0, 0, 0, 0, 0), (0, 0, 0, 0, 0), (1, 0, 0, 0, 0))  # the vertex is the origin
    assert found.ranges == (AngleInterval(None, None),) and found.lines == ()
    at_corner[2] = EdgeVertex(2, 0)
    patches = triple(*(rational_surface(TRIANGLE, HALL, contact) for contact in at_corner))
    assert [part.theta for part in patches.ranges] == [(math.pi, math.pi)]  # the patches' only common angle


def test_one_surface_three_times_and_twice() -> None:
    one, other = (contact_surface(TRIANGLE, HALL, VertexEdge(0, j)) for j in (0, 1))
    assert triple(one, one, one).relation == "identical" and triple(one, one, one).ranges == (
        AngleInterval(None, None),
    )
    twice, pair = triple(one, one, other), intersection(one, other)
    assert (twice.relation, twice.curve, twice.ranges) == ("curve", pair.curve, pair.ranges)


def test_a_double_zero_is_where_curves_touch() -> None:
    """A rod of length 2 with its ends on two walls at right angles: its middle is 1 from the corner, and no more."""

    def on(a: tuple[int, int], p: tuple[Any, Any], q: tuple[int, int]) -> Surface:
        return Surface(VertexEdge(0, 0), *(exact(v) for v in (p, q, a, (0, 0))))

    def exact(v: tuple[Any, Any]) -> tuple[Fraction, Fraction]:
        return to_fraction(v[0]), to_fraction(v[1])

    walls = on((-1, 0), (0, 0), (9, 0)), on((1, 0), (0, 0), (0, 9))
    for height, times in (("1", [2]), ("0.99", [1, 1]), ("1.01", [])):
        found = triple(*walls, on((0, 0), (-1, height), (2, 0)))
        assert [pose.multiplicity for pose in found.poses] == times
        assert all(pose.xy[1] == float(height) for pose in found.poses)


# differential


def determinant(surfaces: tuple[Surface, ...], tau: Fraction | None) -> Fraction:
    """Of three lines; 0 if they have a point in common or are all parallel."""
    rows = [(*U, cross(P, U)) for P, U in (line_at(s, tau) for s in surfaces)]
    (a, b, c), (d, e, f), (g, h, i) = rows
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def interpolated(surfaces: tuple[Surface, ...]) -> list[Fraction]:
    """Coefficients of (1 + tau^2)^2 times the determinant, from its values at five numbers; checked at a sixth."""
    at = [Fraction(n) for n in (-2, -1, 0, 1, 2, 3)]
    values = [determinant(surfaces, tau) * (1 + tau**2) ** 2 for tau in at]
    coefficients = [Fraction(0)] * 5
    for k in range(5):
        term = [values[k]]
        for n in (m for m in range(5) if m != k):
            term = [(a - at[n] * b) / (at[k] - at[n]) for a, b in zip([0, *term], [*term, 0], strict=True)]
        coefficients = [a + b for a, b in zip(coefficients, term, strict=True)]
    assert sum(c * at[5] ** k for k, c in enumerate(coefficients)) == values[5]
    return coefficients


@pytest.mark.slow
@settings(max_examples=40)
@given(meetings.surfaces(3))
def test_poses_are_the_zeros_of_the_determinant_and_on_all_three_lines(three: tuple[Surface, Surface, Surface]) -> None:
    found, polynomial = triple(*three), interpolated(three)
    assert (found.relation == "points") == any(polynomial)
    kinds = {any(s.g) for s in three}
    if found.relation == "points":
        assert len(found.polynomial) <= (5 if len(kinds) == 2 else 3)
        # the same but for a number and factors 1 + tau^2, which have no zeros
        ours: list[Any] = list(found.polynomial)
        while len(ours) < 5:
            ours = [a + b for a, b in zip([*ours, 0, 0], [0, 0, *ours], strict=True)]
        k = next(k for k, c in enumerate(ours) if c)
        assert polynomial[k] and [c * polynomial[k] / ours[k] for c in ours] == polynomial
        # every real root, found in doubles, has its pose, or a line, or three parallel lines that are apart
        angles = [a.angle for a in (*found.poses, *found.lines)]
        scale = float(max(map(abs, polynomial)))
        for root in np.roots([float(c / Fraction(scale)) for c in reversed(polynomial)]):
            if abs(root.imag) < 1e-9 * (1 + abs(root)) and not any(
                abs(math.remainder(2 * math.atan(root.real) - angle.theta, math.tau)) < 1e-4 for angle in angles
            ):
                near = Fraction(float(root.real)).limit_denominator(10**4)
                lines = [line_at(s, near) for s in three]
                sizes = [math.hypot(*map(float, U)) for _, U in lines]
                for i, j in ((0, 1), (1, 2), (0, 2)):
                    assert abs(float(cross(lines[i][1], lines[j][1]))) < 1e-3 * sizes[i] * sizes[j]
    for pose in found.poses:
        low, high = (AlgebraicAngle.of(Pose(0, 0, {"tau": tau})) for tau in pose.angle.neighbours(200))
        assert low == high == pose.angle or low != pose.angle != high
        if pose.pose is not None:
            point, tau = (pose.pose.x, pose.pose.y), pose.pose.tau
            ts = [parameter(line_at(s, tau), point) for s in three]
            assert None not in ts and pose.t == pytest.approx([float(t) for t in ts if t is not None], abs=1e-15)
            inside, on = all(0 < t < 1 for t in ts), all(0 <= t <= 1 for t in ts)  # type: ignore[operator]
            assert pose.location is (Location.INSIDE if inside else Location.BOUNDARY if on else Location.OUTSIDE)
        else:
            x, y = pose.near(200)
            for s, t in zip(three, pose.t, strict=True):
                (Px, Py), U = line_at(s, pose.angle.neighbours(200)[0])
                off = cross((x - Px, y - Py), U) / (abs(U[0]) + abs(U[1]))
                assert abs(off) < Fraction(1, 2**150)
                assert t == pytest.approx(
                    float(((x - Px) * U[0] + (y - Py) * U[1]) / (U[0] ** 2 + U[1] ** 2)), abs=1e-15
                )
    assert [a.angle.theta for a in found.poses] == sorted(a.angle.theta for a in found.poses)
    for line in found.lines:
        pairs = [intersection(*pair) for pair in (three[:2], three[1:])]
        assert all(pair.relation == "identical" or line.angle in [a.angle for a in pair.lines] for pair in pairs)


@pytest.mark.slow
@settings(max_examples=30)
@given(meetings.surfaces(3))
def test_the_order_of_three_does_not_matter(three: tuple[Surface, Surface, Surface]) -> None:
    a, b, c = three
    one, other = triple(a, b, c), triple(c, a, b)
    assert (one.relation, one.polynomial, one.curve, one.ranges) == (
        other.relation,
        other.polynomial,
        other.curve,
        other.ranges,
    )
    assert [(p.angle, p.multiplicity, p.location, p.xy) for p in one.poses] == [
        (p.angle, p.multiplicity, p.location, p.xy) for p in other.poses
    ]


# poses made to touch


@pytest.mark.slow
@settings(max_examples=40)
@given(strategies.convex_polygons(), strategies.poses(), st.data())
def test_a_pose_with_three_contacts_is_found(shape: Any, q: Any, data: st.DataObject) -> None:
    """Obstacles are put so that in the pose each is touched; the pose is then among what is found."""
    robot, (x, y, tau) = Polygon(*shape), q
    pose = Pose(x, y, {"tau": tau})
    surfaces, patches = [], []
    for _ in range(3):
        i, turn = data.draw(st.integers(0, len(robot) - 1)), data.draw(strategies.half_tangents())
        a, b = (pose.apply_exact([robot.exact_vertices[k]])[0] for k in (i, int(robot.next[i])))
        if data.draw(st.booleans()):  # an edge through the vertex
            u, v = M(turn, (Fraction(1), Fraction(0)))
            obstacle = Polygon([(a[0] - u, a[1] - v), (a[0] + u, a[1] + v), (a[0] - v, a[1] + u)])
            contact: Any = VertexEdge(i, obstacle.exact_vertices.index((a[0] - u, a[1] - v)))
        else:  # a vertex on the edge
            middle = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
            obstacle = Polygon([middle, (middle[0] + 1, middle[1]), (middle[0], middle[1] + 1)])
            contact = EdgeVertex(i, obstacle.exact_vertices.index(middle))
        assert contact in contact_features(robot, obstacle, pose)
        surfaces.append(contact_surface(robot, obstacle, contact))
        patches.append(rational_surface(robot, obstacle, contact))
        # both are convex
        assert (patches[-1].Phi.locate(tau) is not Location.OUTSIDE) == is_contact(robot, obstacle, pose)
    found, here = triple(*surfaces), AlgebraicAngle.of(pose)
    if found.relation == "points" and here not in [line.angle for line in found.lines]:
        (same,) = [p for p in found.poses if p.angle == here]
        assert same.pose == pose and same.location is Location.INSIDE and same in found.contacts
        where = [patch.Phi.locate(tau) for patch in patches]
        best = [p.location for p in triple(*patches).poses if p.angle == here]
        ranks = (Location.INSIDE, Location.BOUNDARY, Location.OUTSIDE)
        assert best == [max(where, key=ranks.index)]
    elif found.relation == "curve" and here not in [line.angle for line in found.lines]:
        assert found.curve is not None
        assert found.curve.pose({"tau": tau}) == pose or crossing_is_shared(surfaces, here)
        assert crossing_is_shared(surfaces, here) or any(part.contains(here) for part in found.ranges)
    elif found.relation != "identical":
        (line,) = [line for line in found.lines if line.angle == here]
        assert line.t_range is not None


def crossing_is_shared(surfaces: list[Surface], here: AlgebraicAngle) -> bool:
    pairs = (surfaces[:2], surfaces[1:], surfaces[::2])
    return any(here in [line.angle for line in intersection(*pair).lines] for pair in pairs)
