"""Shapes moved by a rigid motion: every point of them is, exactly."""

from fractions import Fraction

import pytest

from cfree.curves.curved import Curved
from cfree.curves.drawn import Line
from cfree.curves.rings import Arc, Bezier, Circle, Ellipse, Span, Spline
from cfree.curves.similar import moved_shape, similar
from cfree.exact.pose import Pose
from cfree.polygons.polygon import Polygon

POSES = [Pose(3, "-1/7", {"tau": "2/5"}), Pose("1/3", 0, "180deg"), Pose(0, 0, "90deg"), Pose(-5, 2, {"tau": -3})]
SHAPES = [
    Polygon([(1, 0), (9, 0), (9, 7), (1, 7)], [[(2, 2), (4, 2), (3, 3)]]),
    Curved([(0, 0), (4, 0), (4, "5/3")], [[("3/2", "1/4"), (2, "1/4"), (2, "1/2")]], grown="1/9"),
    Curved.circle((1, "1/2"), 2),
    Curved.ellipse((1, 2), (3, 1), {"tau": "1/3"}),
    Curved.ellipse((1, 2), (3, 1), "180deg"),
    Curved([(0, 0), (4, 0), Arc((4, 2), center=(4, 1)), (0, 2), Arc((0, 0), through=(-1, 1))]),
    Curved([(3, 0), Arc((0, 2), center=(0, 0), conjugate=(0, 2)), (0, 0)]),
    Curved([(3, 0), Arc((0, -3), center=(0, 0), clockwise=True), (0, 0)]),
    Curved([(0, 0), Bezier([(2, -1), (4, 0)]), Bezier([(5, 2), (3, 4), (1, 3)])]),
    Curved([(0, 0), (4, 0), Spline([(5, 1), (4, 3), (2, 4), (0, 3)])]),
    Curved([(-9, -9), (9, -9), (9, 9), (-9, 9)], [Circle((0, 0), 3), Ellipse((6, 6), (2, 1), "30deg")]),
]


def points_of(shape: Polygon | Curved) -> list[tuple[Fraction, Fraction]]:
    """Points of a shape's boundary: vertices; of curves their ends, control points, points along spans, and centers."""
    if isinstance(shape, Polygon):
        return list(shape.exact_vertices)
    points = []
    for ring, path in zip(shape.curves, (shape.path, *shape.holes), strict=True):
        for piece in ring:
            if isinstance(path, Circle):  # its span begins to the right of the center, wherever it is moved
                points.append(piece.center)
            elif isinstance(piece, Span):
                points += [piece.at(q, Fraction(k, 5)) for q in range(piece.quarters) for k in range(5)] + [piece.end]
            else:
                points += [piece.start, piece.end] if isinstance(piece, Line) else piece.points
    return points


@pytest.mark.parametrize("pose", POSES)
@pytest.mark.parametrize("shape", SHAPES)
def test_a_moved_shape_has_the_moved_points(shape: Polygon | Curved, pose: Pose) -> None:
    moved = moved_shape(shape, pose)
    assert points_of(moved) == list(pose.apply_exact(points_of(shape)))
    assert getattr(moved, "grown", 0) == getattr(shape, "grown", 0)
    assert moved_shape(moved, pose.inverse()) == shape


@pytest.mark.parametrize("shape", SHAPES)
def test_a_scaled_shape_has_the_scaled_points(shape: Polygon | Curved) -> None:
    factor, shift = Fraction(3, 7), (Fraction(1), Fraction(-2))
    scaled = similar(shape, factor, shift)
    assert points_of(scaled) == [(factor * x + 1, factor * y - 2) for x, y in points_of(shape)]
    assert getattr(scaled, "grown", 0) == factor * getattr(shape, "grown", 0)
