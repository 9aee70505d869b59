"""Rows of docs/theory/errata.md that a number can show: what is printed fails, and what is meant holds."""

from __future__ import annotations

import cmath
import math
import re
from fractions import Fraction

import numpy as np
import pytest

from cfree import Polygon, Pose
from cfree.contact import (
    EdgeEdge,
    EdgeVertex,
    VertexEdge,
    VertexVertex,
    angle_range,
    contact_features,
    contact_segment,
    contact_surface,
    edge_edge_range,
    is_contact,
    is_forbidden,
    rotation_about,
)
from cfree.geometry import local_geometry, surface_classes

TRIANGLE = Polygon([(-1, -1), (3, -1), (0, 2)])
SQUARE = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
KITE = Polygon([(3, 0), (5, 1), (4, 3), (3, 2)])
PAIRS = [(A, O) for A in (TRIANGLE, SQUARE, KITE) for O in (TRIANGLE, SQUARE, KITE)]


def test_every_row_has_a_place_what_is_printed_what_is_meant_and_why(request: pytest.FixtureRequest) -> None:
    page = (request.config.rootpath / "docs" / "theory" / "errata.md").read_text()
    head, *rows = [row.split(" | ") for row in re.findall(r"^\| (.*) \|$", page, re.M)]
    assert head == ["place", "printed", "meant", "why"] and len(rows) >= 25
    assert all(len(row) == 4 and all(cell.strip() for cell in row) for row in rows)


@pytest.mark.parametrize(("A", "O"), PAIRS)
def test_1_1_an_edge_runs_from_its_first_vertex_to_the_next(A: Polygon, O: Polygon) -> None:
    # E_i^A(q) is printed from a_{i+1}(q) to a_i(q): the condition before (7) then gives phi_min + pi, where edges run
    # alongside and interiors meet
    for i in range(len(A)):
        for j in range(len(O)):
            found = angle_range(A, O, VertexEdge(i, j))
            u, v = complex(*A.edge(i)), complex(*O.edge(j))
            meant, printed = (cmath.phase(-v / edge) for edge in (u, -u))
            assert math.remainder(found.phi_min - meant, math.tau) == pytest.approx(0, abs=1e-12)
            assert abs(math.remainder(found.phi_min - printed, math.tau)) == pytest.approx(math.pi)
            S, middle = contact_surface(A, O, VertexEdge(i, j)), found.phi_range / 2
            assert is_contact(A, O, S.pose("1/2", meant + middle))
            assert is_forbidden(A, O, S.pose("1/2", printed + middle))


def test_3_2_1_at_phi_max_the_vertex_is_on_the_line_and_beyond_the_edge() -> None:
    long = Polygon([(-5, 0), (5, 0), (0, 4)])  # an edge of 10 on the vertices of a square of side 2
    for j in range(4):
        found, S = angle_range(long, SQUARE, EdgeVertex(0, j)), contact_surface(long, SQUARE, EdgeVertex(0, j))
        b, E = SQUARE.vertices[j], SQUARE.edge(j)
        for t, share in ((0.1, 0.5), (0.2, 1.0), (0.5, 2.5), (0.9, 4.5)):
            pose = Pose(*S(t, found.phi_max))
            a = pose.apply(long.vertices[0]) - b
            assert E[0] * a[1] - E[1] * a[0] == pytest.approx(0, abs=1e-9)  # on the line of E_j
            assert a @ E / (E @ E) == pytest.approx(share)  # in its units: beyond the segment above 1


@pytest.mark.parametrize(("A", "O"), PAIRS)
def test_3_2_1_equation_9_has_two_solutions_and_the_next_one_takes_the_first(A: Polygon, O: Polygon) -> None:
    for i in range(len(A)):
        for j in range(len(O)):
            u, v, t = complex(*A.edge(i)), complex(*O.edge(int(O.previous[j]))), 0.25
            phi_min = angle_range(A, O, EdgeVertex(i, j)).phi_min
            for phi, is_first in ((phi_min, True), (phi_min + math.pi, False)):
                rest = (1 - t) * cmath.exp(1j * phi) * u  # a_{i+1}(q) - b_j
                assert (rest.conjugate() * v).imag == pytest.approx(0, abs=1e-12)  # parallel: (9)
                assert (abs(rest + (1 - t) * abs(u) * v / abs(v)) < 1e-12) == is_first


def test_remark_3_needs_equal_sides_and_no_regular_polygon() -> None:
    # of regular obstacles with different sides one vertex has surfaces with rulings of different lengths
    small, large = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)]), SQUARE
    lengths = {
        math.hypot(*contact_surface(TRIANGLE, O, VertexEdge(0, j)).ruled[2:4]) for O in (small, large) for j in range(4)
    }
    assert lengths == {1, 2}  # isometries keep them
    # a rhombus is not regular, its sides are equal: one class for each distance of a vertex
    rhombus = Polygon([(0, 0), (5, 0), (8, 4), (3, 4)])
    assert len({*np.hypot(*rhombus.edges.T)}) == 1 and len({*rhombus.interior_angles.round(9)}) == 2
    for O, classes in ((rhombus, 3), (KITE, 9)):
        distances = {x * x + y * y for x, y in TRIANGLE.exact_vertices}
        sides = {x * x + y * y for x, y in (O.exact_edge(j) for j in range(4))}
        found = [members for members in surface_classes(TRIANGLE, O) if isinstance(members[0], VertexEdge)]
        assert len(found) == len(distances) * len(sides) <= classes
        one_vertex = [members for members in found if any(contact.i == 0 for contact in members)]
        assert len(one_vertex) == len(sides)


def test_equation_4_is_a_vertical_line_about_the_reference_point() -> None:
    line, phi = rotation_about((3, "1/2"), (0, 0)), np.linspace(0, 7, 30)
    assert (line(phi)[:, :2] == (3, 0.5)).all() and line.radius == line.curvature() == 0
    assert all(rotation_about((3, 0), a).curvature() > 0 for a in ((1, 0), ("1/1000", 0)))


def test_1_1_a_vertex_at_the_reference_point_has_no_angle() -> None:
    rest = [(1, "90deg"), (1, "180deg")]
    polygons = {Polygon.from_polar([(0, alpha), *rest]) for alpha in (0, "45deg", "300deg")}
    assert len(polygons) == 1  # alpha_1 may be anything
    assert polygons.pop().polar[0].tolist() == [0, 0]  # by convention


def test_equation_10_measures_xi_from_the_ruling_towards_increasing_phi() -> None:
    rng = np.random.default_rng(2)
    for _ in range(20):
        row, t, phi, xi = np.append(rng.normal(size=6), rng.normal(size=2)), *rng.uniform(0, 1, 3)
        row[2:4] = 0
        at = local_geometry(row, t, phi)
        E, F, v = float(at.E), float(at.F), float(at.v)
        S_t, S_phi = np.array([math.sqrt(E), 0]), np.array([F, v]) / math.sqrt(E)  # in the frame (ruling, across it)
        form = np.array([[0, float(at.f)], [float(at.f), float(at.g)]])

        def curvature(
            tangent: np.ndarray, S_t: np.ndarray = S_t, S_phi: np.ndarray = S_phi, form: np.ndarray = form
        ) -> float:
            """II(X, X) of a unit tangent in that frame."""
            dt, dphi = np.linalg.solve(np.column_stack((S_t, S_phi)), tangent)
            return float(np.array([dt, dphi]) @ form @ np.array([dt, dphi]))

        printed = E * math.sin(xi) * (F * math.sin(xi) - 2 * v * math.cos(xi)) / v**3
        along = np.array([math.cos(xi), math.sin(xi)])
        assert curvature(along) == pytest.approx(printed)
        assert curvature(along * (1, -1)) != pytest.approx(printed)  # clockwise
        assert curvature(along[::-1]) != pytest.approx(printed)  # from across the ruling
        beta = math.atan2(S_phi[1], S_phi[0])  # from S_phi
        assert curvature(np.array([math.cos(beta + xi), math.sin(beta + xi)])) != pytest.approx(printed)


@pytest.mark.parametrize(("i", "j", "L"), [(0, 2, Fraction(1)), (0, 1, Fraction(5, 2))])
def test_3_3_2_e_e_contacts_are_an_open_range_and_the_closed_one_is_its_closure(i: int, j: int, L: Fraction) -> None:
    A = SQUARE if L == 1 else Polygon([(0, 0), (5, 0), (0, 3)])
    contact, theta = EdgeEdge(i, j), {1: "270deg", 2: "0deg"}[j]
    S, end = contact_segment(A, SQUARE, contact).surface, 1 + L
    assert edge_edge_range(A, SQUARE, contact) == (0, float(end))
    for t in (Fraction(k, 8) * end for k in range(9)):
        q = S.pose(t, theta, beyond=True)
        assert is_contact(A, SQUARE, q)
        # by section 1.2 edges in contact have more than one point in common: not so at both ends
        assert (contact in contact_features(A, SQUARE, q)) == (0 < t < end)
    corners = VertexVertex(i, j), VertexVertex(int(A.next[i]), int(SQUARE.next[j]))
    for t, corner in zip((Fraction(0), end), corners, strict=True):
        assert corner in contact_features(A, SQUARE, S.pose(t, theta, beyond=True))
