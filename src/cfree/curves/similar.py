"""Shapes scaled, turned and moved, exactly."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from cfree.curves.curved import Curved
from cfree.curves.rings import Arc, Bezier, Circle, Ellipse, GivenRing, Segment, Spline
from cfree.exact.half_angle import sum_of_angles
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose, pose_at
from cfree.polygons.polygon import Polygon

AnyShape = Polygon | Curved
ZERO, ONE = Fraction(0), Fraction(1)


def similar(shape: AnyShape, factor: Fraction = ONE, shift: ExactPoint = (ZERO, ZERO)) -> AnyShape:
    """Return a shape scaled about the origin by a factor above 0, then moved.

    Examples
    --------
    >>> similar(Polygon([(0, 0), (4, 0), (0, 4)]), Fraction(1, 2), (Fraction(1), Fraction(0))).bounds
    (1.0, 0.0, 3.0, 2.0)
    >>> similar(Curved.circle((1, 0), 2), Fraction(3)).path
    Circle(center=(Fraction(3, 1), Fraction(0, 1)), radius=Fraction(6, 1))
    """
    return _image(shape, _Similarity(factor, pose_at(*shift, ZERO)))


def moved_shape(shape: AnyShape, pose: Pose) -> AnyShape:
    """Return a shape turned about the origin, then shifted.

    Examples
    --------
    >>> moved_shape(Polygon([(0, 0), (4, 0), (0, 2)]), Pose(1, 0, "90deg")).bounds
    (-1.0, 0.0, 1.0, 4.0)
    >>> moved_shape(Curved.circle((1, 0), 2), Pose(0, "1/2", "180deg")).path
    Circle(center=(Fraction(-1, 1), Fraction(1, 2)), radius=Fraction(2, 1))
    """
    return _image(shape, _Similarity(ONE, pose))


@dataclass(frozen=True)
class _Similarity:
    """A map of the plane: scaled about the origin, then moved to a pose."""

    factor: Fraction
    pose: Pose

    def point(self, p: ExactPoint) -> ExactPoint:
        (x, y), pose = self.vector(p), self.pose
        return x + pose.x, y + pose.y

    def vector(self, p: ExactPoint) -> ExactPoint:
        (x, y), (c, s, w) = p, self.pose.rotation
        unit = self.factor / w
        return unit * (c * x - s * y), unit * (s * x + c * y)

    def points(self, points: tuple[ExactPoint, ...]) -> list[ExactPoint]:
        return [self.point(p) for p in points]


def _image(shape: AnyShape, by: _Similarity) -> AnyShape:
    if isinstance(shape, Polygon):
        first, *others = map(by.points, shape.exact_rings)
        return Polygon(first, others)
    outer, *holes = (_ring(ring, by) for ring in (shape.path, *shape.holes))
    return Curved(outer, holes, grown=shape.grown * by.factor)


def _ring(ring: GivenRing, by: _Similarity) -> GivenRing:
    match ring:
        case Circle(center, radius):
            return Circle(by.point(center), radius * by.factor)
        case Ellipse(center, (a, b), turned):
            angle = {"tau": sum_of_angles(by.pose.tau, turned.tau)}
            return Ellipse(by.point(center), (a * by.factor, b * by.factor), angle)
        case _:
            return tuple(_segment(item, by) for item in ring)


def _segment(item: Segment, by: _Similarity) -> Segment:
    match item:
        case Arc(to, through, center, clockwise, conjugate):
            return Arc(
                by.point(to),
                through and by.point(through),
                center and by.point(center),
                clockwise,
                conjugate and by.vector(conjugate),
            )
        case Bezier(points):
            return Bezier(by.points(points))
        case Spline(points):
            return Spline(by.points(points))
        case _:
            return by.point(item)
