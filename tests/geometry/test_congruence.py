"""Remark 3: classes of congruence against a search for the isometry."""

from __future__ import annotations

import cmath
import math
from fractions import Fraction
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import strategies
from cfree.contact.contact import EdgeVertex, VertexEdge, VertexVertex, angle_range, contact_curves, contacts
from cfree.contact.surface import contact_helix, contact_surface
from cfree.exact.pose import Pose
from cfree.geometry.congruence import arc_classes, helix_classes, patch_classes, surface_classes
from cfree.geometry.rulings import striction_parameter
from cfree.polygons.polygon import Polygon
from shapes import Shape

Contacts = tuple[tuple[VertexEdge | EdgeVertex | VertexVertex, ...], ...]
SQUARE = Polygon([(-1, -1), (1, -1), (1, 1), (-1, 1)])
KITE = Polygon([(-2, 0), (0, -1), (1, 0), (0, 1)])  # its own mirror image


def samples(A: Polygon, O: Polygon, contact: VertexEdge | EdgeVertex | VertexVertex) -> np.ndarray:
    """Corners of a patch and points between them, (2, 5, 3); an arc counts as a patch of no width."""
    r = angle_range(A, O, contact)
    phi = r.phi_min + r.phi_range * np.linspace(0, 1, 5)
    if isinstance(contact, VertexVertex):
        return np.tile(contact_helix(A, O, contact)(phi), (2, 1, 1))
    S = contact_surface(A, O, contact)
    return S(np.array([[0.0], [1.0]]), phi)


def are_congruent(X: np.ndarray, Y: np.ndarray, tolerance: float) -> bool:
    """Does an isometry of C carry the samples onto each other? Its parts in plane and circle need not match in sign."""
    if abs(np.ptp(X[..., 2]) - np.ptp(Y[..., 2])) > tolerance:
        return False
    first = gram(X)
    return any(
        np.abs(first - gram(Y[::ends, ::turned])).max() < tolerance * (1 + abs(first).max())
        for ends in (1, -1)
        for turned in (1, -1)
    )


def gram(X: np.ndarray) -> np.ndarray:
    """Products of the plane vectors from the middle: all that isometries of the plane leave alone."""
    plane = X[..., :2].reshape(-1, 2)
    centred = plane - plane.mean(axis=0)
    return centred @ centred.T


def check(A: Polygon, O: Polygon, classes: Contacts, every: list, tolerance: float = 1e-9) -> None:
    assert sorted(c for members in classes for c in members) == sorted(every) or len(every) == 0
    number = {contact: k for k, members in enumerate(classes) for contact in members}
    X = {contact: samples(A, O, contact) for contact in every}
    for one, other in combinations(every, 2):
        assert (number[one] == number[other]) == are_congruent(X[one], X[other], tolerance), (one, other)


robots = st.one_of(
    strategies.convex_polygons(4),
    strategies.simple_polygons(3),
    st.sampled_from([([(-1, -1), (1, -1), (1, 1), (-1, 1)], []), ([(-2, 0), (0, -1), (1, 0), (0, 1)], [])]),
)


@pytest.mark.slow
@settings(max_examples=60)
@given(robots, robots, st.tuples(st.integers(-3, 0), st.integers(-3, 0)))
def test_patches_are_congruent_just_if_an_isometry_is_found(one: Shape, other: Shape, by: tuple[int, int]) -> None:
    A = Polygon([(x + by[0], y + by[1]) for x, y in one[0]])
    O = Polygon(*other)
    for kind in (VertexEdge, EdgeVertex):
        every = [contact for contact in contacts(A, O) if isinstance(contact, kind)]
        classes = tuple(members for members in patch_classes(A, O) if isinstance(members[0], kind))
        check(A, O, classes, every)


@settings(max_examples=40)
@given(robots, robots, st.tuples(st.integers(-3, 0), st.integers(-3, 0)))
def test_arcs_are_congruent_just_if_an_isometry_is_found(one: Shape, other: Shape, by: tuple[int, int]) -> None:
    A = Polygon([(x + by[0], y + by[1]) for x, y in one[0]])
    O = Polygon(*other)
    every = [curve for curve in contact_curves(A, O) if isinstance(curve, VertexVertex)]
    check(A, O, arc_classes(A, O), every)


def test_mirror_images_are_congruent() -> None:
    # reflecting the plane and the circle together; corners 1 and 3 of the kite are mirror images
    classes = {contact: members for members in patch_classes(KITE, SQUARE) for contact in members}
    assert classes[VertexEdge(1, 0)] is classes[VertexEdge(3, 2)]
    assert classes[EdgeVertex(0, 0)] is classes[EdgeVertex(3, 1)]
    assert classes[VertexEdge(0, 0)] is not classes[VertexEdge(2, 0)]
    assert len(patch_classes(KITE, SQUARE)) == 3 + 2


def test_equal_surfaces_can_have_different_patches() -> None:
    # a_0 and a_2 have one radius, but not one corner
    A, O = Polygon([(0, -5), (3, 0), (0, 5), (-1, 0)]), SQUARE
    B = Polygon([(0, -5), (3, 0), (3, 4), (-1, 0)])
    for robot, same in ((A, True), (B, False)):
        for classes, expected in ((surface_classes, True), (patch_classes, same)):
            found = next(members for members in classes(robot, O) if VertexEdge(0, 0) in members)
            assert (VertexEdge(2, 0) in found) == expected


@pytest.mark.slow
@given(strategies.polygons(), strategies.polygons())
def test_classes_of_surfaces_are_unions_of_those_of_patches(one: Shape, other: Shape) -> None:
    A, O = Polygon(*one), Polygon(*other)
    number = {contact: k for k, members in enumerate(surface_classes(A, O)) for contact in members}
    assert len(number) == 2 * len(A) * len(O)
    for members in patch_classes(A, O):
        assert len({number[contact] for contact in members}) == 1
    number = {contact: k for k, members in enumerate(helix_classes(A, O)) for contact in members}
    assert len(number) == len(A) * len(O)
    for arcs in arc_classes(A, O):
        assert len({number[arc] for arc in arcs}) == 1


@given(strategies.polygons(), strategies.polygons())
def test_remark_3_helices_of_one_vertex_are_of_one_class(one: Shape, other: Shape) -> None:
    A, O = Polygon(*one), Polygon(*other)
    classes = {helix: k for k, members in enumerate(helix_classes(A, O)) for helix in members}
    for i in range(len(A)):
        assert len({classes[VertexVertex(i, j)] for j in range(len(O))}) == 1


@pytest.mark.slow
@given(strategies.polygons(), strategies.half_tangents(), strategies.half_tangents())
def test_classes_do_not_change_when_the_scene_is_turned(
    shape: Shape, tau: Fraction | None, other: Fraction | None
) -> None:
    def turned(polygon: Polygon, tau: Fraction | None) -> Polygon:
        ring = Pose(0, 0, {"tau": "inf" if tau is None else tau}).apply_exact(polygon.exact_vertices)
        return Polygon(ring)

    A, O = Polygon(shape[0]), KITE
    for classes in (surface_classes, patch_classes, helix_classes, arc_classes):
        assert classes(turned(A, tau), turned(O, other)) == classes(A, O)


def test_an_isometry_of_equal_v_e_surfaces() -> None:
    A, O = Polygon([(0, -5), (3, 4), (-5, 0)]), Polygon([(1, 1), (3, 1), (5, 3), (3, 6), (1, 3)])
    one, other = VertexEdge(0, 0), VertexEdge(1, 4)
    assert any(one in members and other in members for members in surface_classes(A, O))
    S, T = contact_surface(A, O, one), contact_surface(A, O, other)
    a, b, q, r = (complex(*map(float, u)) for u in (S.a, T.a, S.q, T.q))
    M, c = r / q, cmath.phase(r / q * a / b)
    t, phi = np.linspace(0, 1, 4), np.linspace(0, 7, 9)[:, None]
    carried, reached = (X[..., 0] + 1j * X[..., 1] for X in (S(t, phi), T(t, phi + c)))
    difference = reached - M * carried
    np.testing.assert_allclose(difference, difference[0, 0], atol=1e-12)


def test_there_is_no_tolerance() -> None:
    tiny = Fraction(1, 10**40)
    box = Polygon([(-1, -1), (1, -1), (1, 1 + tiny), (-1, 1 + tiny)])
    assert [len(members) for members in surface_classes(SQUARE, box)] == [8, 8, 16]
    assert len(helix_classes(box, SQUARE)) == 2


# regular polygons


def regular(n: int, radius: float = 1.0, phase: float = 0.2) -> list[tuple[float, float]]:
    corners = [cmath.rect(radius, phase + math.tau * k / n) for k in range(n)]
    return [(c.real, c.imag) for c in corners]


@pytest.mark.parametrize(("n", "m"), [(3, 3), (3, 5), (4, 6), (5, 4), (6, 3), (7, 8)])
def test_remark_3_for_regular_polygons(n: int, m: int) -> None:
    # only squares have rational corners: the others are congruent as far as doubles go
    A, O = Polygon(regular(n)), Polygon(regular(m, 2.0, 0.7))
    for kind in (VertexEdge, EdgeVertex):
        first, *others = (samples(A, O, contact) for contact in contacts(A, O) if isinstance(contact, kind))
        assert all(are_congruent(first, other, 1e-12) for other in others)
    first, *others = (samples(A, O, c) for c in contact_curves(A, O) if isinstance(c, VertexVertex))
    assert all(are_congruent(first, other, 1e-12) for other in others)


def test_remark_3_for_squares_and_its_erratum() -> None:
    assert [len(m) for m in patch_classes(SQUARE, SQUARE)] == [16, 16]
    assert [len(m) for m in surface_classes(SQUARE, SQUARE)] == [16, 16]
    # the reference point in a corner: radii 0, 2 and 2 sqrt 2
    corner = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    assert [len(m) for m in helix_classes(corner, SQUARE)] == [4, 8, 4]
    assert [len(m) for m in patch_classes(corner, SQUARE)] == [4, 8, 4, 8, 8]


def test_remark_3_of_one_vertex_and_a_regular_obstacle() -> None:
    """Surfaces and helices of one vertex are one class, whatever the robot; patches and arcs are not in general."""
    A = Polygon([(0, -5), (4, 3), (-1, 6), (-7, 1)])
    surfaces, helices = surface_classes(A, SQUARE), helix_classes(A, SQUARE)
    patches, arcs = patch_classes(A, SQUARE), arc_classes(A, SQUARE)
    radii = [x * x + y * y for x, y in A.exact_vertices]
    assert len(set(radii)) == 4 - radii.count(25) + 1
    for i in range(4):
        same_radius = {k for k in range(4) if radii[k] == radii[i]}
        for kind, classes in ((VertexEdge, surfaces), (VertexVertex, helices)):
            (members,) = (members for members in classes if kind(i, 0) in members)
            assert set(members) == {kind(k, j) for k in same_radius for j in range(4)}
        for kind, classes in ((VertexEdge, patches), (VertexVertex, arcs)):
            (members,) = (members for members in classes if kind(i, 0) in members)
            assert {kind(i, j) for j in range(4)} <= set(members)
    # a_0 and a_1 have one radius and different corners
    assert VertexEdge(1, 0) in next(members for members in surfaces if VertexEdge(0, 0) in members)
    assert VertexEdge(1, 0) not in next(members for members in patches if VertexEdge(0, 0) in members)
    assert VertexVertex(1, 0) not in next(members for members in arcs if VertexVertex(0, 0) in members)


def test_remark_3_patches_of_equal_corners_differ_where_the_reference_point_is_elsewhere_in_them() -> None:
    # opposite corners of a parallelogram are equal; they are as far from the reference point, and at other angles
    shift = Fraction(23, 10), Fraction(3, 2)
    A = Polygon([(x - shift[0], y - shift[1]) for x, y in ((0, 0), (4, 0), (5, 2), (1, 2))])
    one, other = VertexEdge(0, 0), VertexEdge(2, 0)
    surfaces, patches = surface_classes(A, SQUARE), patch_classes(A, SQUARE)
    assert other in next(members for members in surfaces if one in members)
    assert angle_range(A, SQUARE, one).phi_range == angle_range(A, SQUARE, other).phi_range
    assert other not in next(members for members in patches if one in members)
    assert not are_congruent(samples(A, SQUARE, one), samples(A, SQUARE, other), 1e-9)


@given(strategies.convex_polygons())
def test_remark_5_ends_of_an_e_v_surface_are_congruent_just_if_the_striction_curve_is_in_the_middle(
    shape: Shape,
) -> None:
    A = Polygon(*shape)
    classes = {helix: k for k, members in enumerate(helix_classes(A, SQUARE)) for helix in members}
    for i in range(len(A)):
        t = striction_parameter(contact_surface(A, SQUARE, EdgeVertex(i, 0)))
        ends = VertexVertex(i, 0), VertexVertex(int(A.next[i]), 0)
        assert (classes[ends[0]] == classes[ends[1]]) == (t == Fraction(1, 2))


def test_remark_3_for_squares_has_one_class_of_arcs() -> None:
    assert [len(m) for m in arc_classes(SQUARE, SQUARE)] == [16]
    corner = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    assert [len(m) for m in arc_classes(corner, SQUARE)] == [4, 8, 4]


def test_a_pair_of_nothing_equal() -> None:
    A, O = Polygon([(0, 1), (5, 2), (1, 7)]), Polygon([(0, 0), (4, 1), (2, 6)])
    assert len(patch_classes(A, O)) == len(contacts(A, O))
