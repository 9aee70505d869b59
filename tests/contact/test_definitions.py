from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import strategies
from cfree.contact.contact import EdgeEdge, EdgeVertex, VertexEdge, VertexVertex, angle_range, contacts
from cfree.contact.definitions import contact_features, is_contact, is_forbidden, is_pseudo_contact
from cfree.exact.orientation import Location
from cfree.exact.pose import Pose
from cfree.polygons.polygon import Polygon
from shapes import Shape

SQUARE = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
L_SHAPE = Polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])
RING = Polygon([(0, 0), (6, 0), (6, 6), (0, 6)], [[(2, 2), (4, 2), (4, 4), (2, 4)]])


def pose_of(values: tuple[Fraction, Fraction, Fraction | None]) -> Pose:
    x, y, tau = values
    return Pose(x, y, {"tau": "inf" if tau is None else tau})


def moved(robot: Polygon, pose: Pose) -> Polygon:
    points = pose.apply_exact(robot.exact_vertices)
    outer, *holes = (points[first:end] for first, end in pairwise(robot.ring_offsets))
    return Polygon(outer, holes)


poses = strategies.poses(4).map(pose_of)


@pytest.mark.parametrize(
    ("x", "y", "features", "contact"),
    [
        (3, 0, (), False),
        (2, 2, (VertexVertex(0, 2),), True),
        (2, 1, (VertexEdge(0, 1), EdgeVertex(3, 2), EdgeEdge(3, 1)), True),
        (2, 0, (VertexVertex(0, 1), VertexVertex(3, 2), EdgeEdge(3, 1)), True),
        (1, 1, (), False),
        (0, 2, (VertexVertex(0, 3), VertexVertex(1, 2), EdgeEdge(0, 2)), True),
    ],
)
def test_two_squares_touch_as_section_1_2_defines(x: int, y: int, features: tuple[object, ...], contact: bool) -> None:
    pose = Pose(x, y, 0)
    assert contact_features(SQUARE, SQUARE, pose) == features
    assert is_contact(SQUARE, SQUARE, pose) == contact
    assert is_pseudo_contact(SQUARE, SQUARE, pose) == (x < 3)


@settings(max_examples=40)
@given(strategies.polygons(), strategies.polygons(), strategies.half_tangents(), st.data())
def test_contact_types_are_those_of_the_table_of_section_1_2(
    one: Shape, other: Shape, tau: Fraction | None, data: st.DataObject
) -> None:
    A, O, turned = Polygon(*one), Polygon(*other), pose_of((Fraction(0), Fraction(0), tau))
    third, where = Fraction(1, 3), data.draw(st.sampled_from(["vertex", "edge", "both", "edges"]))
    if where == "edges":  # of one direction, or of opposite ones
        O = Polygon(turned.apply_exact(A.exact_vertices[: A.ring_offsets[1]]))
        turned = turned @ Pose(0, 0, data.draw(st.sampled_from(["0deg", "180deg"])))
    n, m, tau = range(len(A)), range(len(O)), turned.tau
    i, j = data.draw(st.sampled_from(n)), data.draw(st.sampled_from(m))
    if where == "edges":
        i = j
    # at that orientation, with a point of the robot's rim on a point of the obstacle's
    s, t = {"vertex": (0, third), "edge": (third, 0), "both": (0, 0), "edges": (third, third)}[where]
    (a, b), (c, d) = turned.apply_exact([A.exact_vertices[i], A.exact_vertices[int(A.next[i])]]), edge_of(O, j)
    p, q = ([v + share * (w - v) for v, w in zip(*ends, strict=True)] for share, ends in ((s, (a, b)), (t, (c, d))))
    pose = pose_of((q[0] - p[0], q[1] - p[1], tau))
    a = pose.apply_exact(A.exact_vertices)
    b = O.exact_vertices
    EA, EO = [(a[i], a[int(A.next[i])]) for i in n], [edge_of(O, j) for j in m]
    expected = {VertexEdge(i, j) for i in n for j in m if is_inside(a[i], *EO[j])}
    expected |= {EdgeVertex(i, j) for i in n for j in m if is_inside(b[j], *EA[i])}
    expected |= {VertexVertex(i, j) for i in n for j in m if a[i] == b[j]}
    expected |= {EdgeEdge(i, j) for i in n for j in m if overlap(EA[i], EO[j])}
    assert set(contact_features(A, O, pose)) == expected and expected
    assert is_pseudo_contact(A, O, pose)


Point = tuple[Fraction, Fraction]


def edge_of(polygon: Polygon, k: int) -> tuple[Point, Point]:
    return polygon.exact_vertices[k], polygon.exact_vertices[int(polygon.next[k])]


def along(p: Point, a: Point, b: Point) -> Fraction | None:
    """Share of the way from a to b at which p is; None beside that line."""
    (ux, uy), (vx, vy) = (b[0] - a[0], b[1] - a[1]), (p[0] - a[0], p[1] - a[1])
    return None if ux * vy != uy * vx else (ux * vx + uy * vy) / (ux * ux + uy * uy)


def is_inside(p: Point, a: Point, b: Point) -> bool:
    share = along(p, a, b)
    return share is not None and 0 < share < 1


def overlap(one: tuple[Point, Point], other: tuple[Point, Point]) -> bool:
    """Do two edges have more than one point in common?"""
    shares = [along(p, *other) for p in one]
    if None in shares:
        return False
    low, high = sorted(share for share in shares if share is not None)
    return low < 1 and high > 0


def test_a_square_fills_a_hole_without_forbidden_overlap() -> None:
    assert is_contact(SQUARE, RING, Pose(2, 2, 0))
    assert is_forbidden(SQUARE, RING, Pose(2, Fraction(2) + Fraction(1, 10**50), 0))
    assert is_forbidden(RING, RING, Pose(0, 0, 0))
    assert not is_pseudo_contact(Polygon([(0, 0), (1, 0), (0, 1)]), RING, Pose("9/4", "9/4", 0))


def test_containment_is_forbidden_without_any_contact() -> None:
    small = Polygon([(0, 0), (1, 0), (0, 1)])
    pose = Pose("1/2", "1/2", 0)
    assert is_forbidden(small, RING, pose)
    assert not is_pseudo_contact(small, RING, pose)
    assert is_forbidden(RING, small, pose.inverse())


@pytest.mark.slow
@settings(max_examples=60)
@given(strategies.polygons(), strategies.polygons(), poses)
def test_interiors_meet_exactly_if_shapely_finds_a_common_area(one: Shape, other: Shape, pose: Pose) -> None:
    A, O = Polygon(*one), Polygon(*other)
    area = moved(A, pose).to_shapely().intersection(O.to_shapely()).area
    if is_forbidden(A, O, pose):
        assert area > 0
    else:
        assert area < 1e-9


@pytest.mark.slow
@settings(max_examples=60)
@given(strategies.polygons(), strategies.polygons(), poses)
def test_the_roles_of_robot_and_obstacle_can_be_exchanged(one: Shape, other: Shape, pose: Pose) -> None:
    A, O = Polygon(*one), Polygon(*other)
    swapped = {
        VertexEdge: lambda c: EdgeVertex(c.j, c.i),
        EdgeVertex: lambda c: VertexEdge(c.j, c.i),
        VertexVertex: lambda c: VertexVertex(c.j, c.i),
        EdgeEdge: lambda c: EdgeEdge(c.j, c.i),
    }
    features = {swapped[type(c)](c) for c in contact_features(A, O, pose)}
    assert features == set(contact_features(O, A, pose.inverse()))
    assert is_forbidden(A, O, pose) == is_forbidden(O, A, pose.inverse())


@settings(max_examples=60)
@given(
    strategies.convex_polygons(),
    strategies.convex_polygons(),
    strategies.half_tangents(),
    st.fractions(Fraction(1, 9), Fraction(8, 9), max_denominator=9),
    st.data(),
)
def test_a_pseudo_contact_of_a_convex_pair_is_a_contact_exactly_on_the_angle_range(
    one: Shape, other: Shape, tau: Fraction | None, t: Fraction, data: st.DataObject
) -> None:
    A, O = Polygon(*one), Polygon(*other)
    contact = data.draw(st.sampled_from(contacts(A, O)))
    turned = pose_of((Fraction(0), Fraction(0), tau))
    a, b = A.exact_vertices, O.exact_vertices
    i, j, k, m = contact.i, contact.j, int(A.next[contact.i]), int(O.next[contact.j])
    along_a, along_b = (t, Fraction(0)) if isinstance(contact, EdgeVertex) else (Fraction(0), t)
    on_robot = tuple((1 - along_a) * p + along_a * q for p, q in zip(a[i], a[k], strict=True))
    on_obstacle = tuple((1 - along_b) * p + along_b * q for p, q in zip(b[j], b[m], strict=True))
    ((x, y),) = turned.apply_exact([on_robot])
    pose = pose_of((on_obstacle[0] - x, on_obstacle[1] - y, tau))
    assert contact in contact_features(A, O, pose)
    assert is_pseudo_contact(A, O, pose)
    c, s, _ = pose.rotation
    place = angle_range(A, O, contact).locate((c, s))
    assert is_contact(A, O, pose) == (place is not Location.OUTSIDE)


def test_features_agree_with_distances_in_doubles() -> None:
    rng = np.random.default_rng(3)
    for _ in range(50):
        pose = Pose(*(float(v) for v in rng.uniform(-3, 3, 3)))
        assert contact_features(L_SHAPE, SQUARE, pose) == ()
        outline = Polygon(pose.apply(L_SHAPE.vertices)).to_shapely()
        assert is_pseudo_contact(L_SHAPE, SQUARE, pose) == outline.exterior.intersects(SQUARE.to_shapely().exterior)
