"""The tiling of a convex pair's torus: exact counts against the places of all corners; sides that two patches share."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest

from arc_shapes import BAY, CAR, CONVEX, DISC, STADIUM, TRIANGLE, Shape
from cfree import Curved, Polygon
from cfree.contact import ArcArc, ArcArcSurface, ArcEdge, EdgeArc, arc_contacts, arc_surface, shape_features, tiling
from cfree.contact.features import ArcFeature

SQUARE = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
ROUND_SQUARE = Curved([(0, 0), (1, 0), (1, 1), (0, 1)], grown="1/3")
BIG = Curved.circle((0, 0), 2)
ALL: dict[str, Shape] = {**CONVEX, "square": SQUARE, "round square": ROUND_SQUARE, "big disc": BIG}
PAIRS = [*product(ALL, ALL)]


@pytest.mark.parametrize(("robot", "obstacle"), PAIRS)
def test_convex_pairs_are_tori(robot: str, obstacle: str) -> None:
    assert tiling(ALL[robot], ALL[obstacle]).euler_number == 0


@pytest.mark.parametrize(("robot", "obstacle"), PAIRS)
def test_parallelograms_fill_the_torus(robot: str, obstacle: str) -> None:
    A, O = shape_features(ALL[robot]), shape_features(ALL[obstacle])
    total = math.fsum(a.width * o.width for a, o in product(A.arcs, O.arcs))
    assert total == pytest.approx(math.tau**2)
    counts = tiling(ALL[robot], ALL[obstacle])
    every = arc_contacts(ALL[robot], ALL[obstacle])
    assert counts.parallelograms == sum(isinstance(contact, ArcArc) for contact in every)
    assert (
        counts.strips
        == sum(not isinstance(contact, ArcArc) for contact in every)
        == counts.faces - counts.parallelograms
    )


@pytest.mark.parametrize(("robot", "obstacle"), PAIRS)
def test_vertices_are_the_different_poses_in_which_edges_end_on_edges(robot: str, obstacle: str) -> None:
    """Corners of all parallelograms, those of two vertices included, are the vertices where edges meet edges."""
    if ALL[robot] in (DISC, BIG) and ALL[obstacle] in (DISC, BIG):
        assert tiling(ALL[robot], ALL[obstacle]).vertices == 1
        return
    A, O = shape_features(ALL[robot]), shape_features(ALL[obstacle])
    corners = []
    for i, j in product(range(len(A.arcs)), range(len(O.arcs))):
        S = arc_surface(ALL[robot], ALL[obstacle], ArcArc(i, j))
        assert isinstance(S, ArcArcSurface)
        psi, phi = S.parallelogram.T
        x, y, theta = S(psi, phi).T
        corners.append(np.column_stack([x, y, np.cos(theta), np.sin(theta)]))
    points = np.concatenate(corners)
    apart = np.linalg.norm(points[:, None] - points[None], axis=-1) > 1e-9
    first = {int(np.flatnonzero(~row)[0]) for row in apart}
    assert tiling(ALL[robot], ALL[obstacle]).vertices == len(first)


def test_general_position_has_the_numbers_of_the_theory() -> None:
    n, m = 3, 4
    counts = tiling(Curved([(0, 0), (4, 0), (1, 3)], grown=1), CAR)
    assert (counts.parallelograms, counts.strips) == (n * m, 2 * n * m)
    assert (counts.vertices, counts.edges) == (4 * n * m, 7 * n * m)


def test_strips_are_glued_to_parallelograms_along_helices() -> None:
    """Each side t = 0 or t = 1 of a strip is the side of a parallelogram, at the same angles."""
    shapes = [(TRIANGLE, CAR), (CAR, STADIUM), (STADIUM, ROUND_SQUARE)]
    for A, O in shapes:
        fA, fO = shape_features(A), shape_features(O)
        for own, other, kind in ((fO, fA, ArcEdge), (fA, fO, EdgeArc)):
            (ring,) = own.rings
            for k, feature in enumerate(ring):
                if isinstance(feature, ArcFeature):
                    continue
                before, after = ring[k - 1], ring[(k + 1) % len(ring)]
                assert isinstance(before, ArcFeature) and isinstance(after, ArcFeature)
                edge = own.edges.index(feature)
                for index, arc in enumerate(other.arcs):
                    pair = (index, edge) if kind is ArcEdge else (edge, index)
                    S = arc_surface(A, O, kind(*pair))
                    normal = math.atan2(*feature.outward[::-1])
                    share = arc.first + arc.width * np.linspace(0, 1, 5)
                    for t, end in ((0.0, before), (1.0, after)):
                        at = own.arcs.index(end)
                        P = arc_surface(A, O, ArcArc(*((index, at) if kind is ArcEdge else (at, index))))
                        assert isinstance(P, ArcArcSurface)
                        psi = np.full(5, normal) if kind is ArcEdge else share
                        phi = psi + math.pi - (share if kind is ArcEdge else normal)
                        assert S(t, phi) == pytest.approx(P(psi, phi), abs=1e-12)


def test_shapes_that_are_not_convex_tile_no_torus() -> None:
    with pytest.raises(ValueError, match="obstacle: not convex"):
        tiling(DISC, BAY)
