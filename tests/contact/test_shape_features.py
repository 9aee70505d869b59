"""Edges and arcs of shapes: normals, radii and turns, from the shapes' definitions."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
import shapely

from arc_shapes import BAY, CAP, CAR, CONVEX, DISC, FILLET, MOON, PLATE, SHAPES, STADIUM, TRIANGLE, dense, normal, unit
from cfree import Curved, UnsupportedError
from cfree.contact import shape_features
from cfree.curves import Arc, Bezier

INWARD = 1e-3


@pytest.mark.parametrize("name", SHAPES)
def test_points_of_features_are_on_the_rim_and_their_normals_lead_outside(name: str) -> None:
    shape = dense(SHAPES[name])
    features = shape_features(SHAPES[name])
    places = [(np.array(edge.start, float) + 0.4 * np.array(edge.along, float), normal(edge), float(edge.offset))
              for edge in features.edges]  # fmt: skip
    for arc in features.arcs:
        if arc.is_convex or arc.signed_square:
            u = unit(arc.first + 0.3 * arc.width)
            places.append((np.array(arc.centre, float), u, arc.signed_radius))
    for core, u, rho in places:
        point = core + rho * u
        assert shape.boundary.distance(shapely.Point(point)) < 1e-5
        assert not shape.contains(shapely.Point(point + INWARD * u))
        if rho:  # below a sharp vertex -u may leave the shape
            assert shape.contains(shapely.Point(point - INWARD * u))


@pytest.mark.parametrize("name", SHAPES)
def test_turns_of_a_ring_add_up_to_a_full_turn(name: str) -> None:
    for k, ring in enumerate(shape_features(SHAPES[name]).rings):
        turns = [(1 if f.is_convex else -1) * f.width for f in ring if hasattr(f, "width")]
        assert math.fsum(turns) == pytest.approx(-math.tau if k else math.tau)


@pytest.mark.parametrize("name", [*CONVEX, "bay", "fillet", "moon", "plate"])
def test_area_and_perimeter_are_those_of_the_shape(name: str) -> None:
    features, shape = shape_features(SHAPES[name]), dense(SHAPES[name])
    assert features.area == pytest.approx(shape.area, rel=1e-5)
    assert features.perimeter == pytest.approx(shape.length, rel=1e-5)


def test_numbers_of_features() -> None:
    counts = {name: (len(f.arcs), len(f.edges)) for name, f in ((n, shape_features(s)) for n, s in SHAPES.items())}
    assert counts == {
        "triangle": (3, 3), "disc": (1, 0), "stadium": (2, 2), "car": (4, 4), "cap": (3, 1), "corner": (6, 6),
        "bay": (7, 5), "fillet": (4, 2), "moon": (4, 0), "plate": (5, 4),
    }  # fmt: skip
    assert [f.is_convex for f in map(shape_features, SHAPES.values())] == [True] * 5 + [False] * 5


def test_signed_radii_are_exact() -> None:
    assert [arc.radius for arc in shape_features(CAR).arcs] == [Fraction(1, 3)] * 4
    assert shape_features(DISC).arcs[0].radius == Fraction(3, 4) and shape_features(DISC).arcs[0].is_whole
    (bow,) = (arc for arc in shape_features(CAP).arcs if arc.signed_square)
    assert bow.signed_square == 2 and bow.radius is None and bow.signed_radius == math.sqrt(2)
    assert [arc.radius for arc in shape_features(BAY).arcs if arc.signed_square] == [-1]
    assert [arc.radius for arc in shape_features(PLATE).arcs if arc.signed_square] == [-2]
    assert sorted(arc.signed_square for arc in shape_features(MOON).arcs) == [Fraction(-25, 4), 0, 0, 4]


def test_smooth_joints_have_no_vertex_and_cusps_turn_by_half_a_turn() -> None:
    assert all(arc.signed_square for arc in shape_features(STADIUM).arcs)
    cusps = [arc for arc in shape_features(FILLET).arcs if not arc.signed_square and arc.width > 3]
    assert [arc.width for arc in cusps] == [math.pi, math.pi] and all(arc.is_convex for arc in cusps)
    # as a hole its tips lead into the material: the interior angle is a full turn
    cut = Curved([(-9, -9), (9, -9), (9, 9), (-9, 9)], [FILLET.path])
    tips = [arc for arc in shape_features(cut).arcs if not arc.signed_square and arc.width > 3]
    assert [arc.width for arc in tips] == [math.pi, math.pi] and not any(arc.is_convex for arc in tips)
    (bow,) = (arc for arc in shape_features(cut).arcs if arc.signed_square)
    assert bow.radius == 3


def test_a_ring_in_either_direction_has_the_same_features() -> None:
    turned = Curved([(-1, 1), (2, 1), Arc((2, -1), center=(2, 0), clockwise=True), (-1, -1),
                     Arc((-1, 1), center=(-1, 0), clockwise=True)])  # fmt: skip
    assert set(shape_features(turned).arcs) == set(shape_features(STADIUM).arcs)


def test_other_curves_are_refused_with_their_place() -> None:
    leaf = Curved([(0, 0), (2, 0), Bezier([(2, 2), (0, 2)])])
    with pytest.raises(UnsupportedError, match=r"ring 0, piece 1: .*give shape\.outer"):
        shape_features(leaf)
    assert shape_features(TRIANGLE).is_convex
