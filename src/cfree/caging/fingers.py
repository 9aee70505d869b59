"""Fingers: points, discs and polygons; and triangles that stand for points.

Shapes are closures of their interiors, so a point forbids nothing in a `Scene`. Here a point has a tiny triangle with
a corner at it. A body that does not overlap the triangle does not have the point in its interior: a path among
triangles is a path among the points. And if each triangle lies within a distance e of its point, and a smaller body
at least e inside the body, then the smaller body overlaps a triangle only where the body has the point in its interior:
a proof for the smaller body among triangles is a proof for the body among the points.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, log2
from typing import Any

from cfree.analysis.leaving import UNITS, require_start
from cfree.collision.pose_checker import is_free
from cfree.curves.curved import Curved
from cfree.curves.rings import Circle
from cfree.curves.similar import moved_shape
from cfree.errors import InvalidPoseError, UndecidedError
from cfree.exact.number import ExactPoint, is_single, to_fraction
from cfree.exact.pose import Pose, PoseLike, to_pose
from cfree.exact.vectors import cross, dot, minus
from cfree.polygons.offset import inset
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import AnyShape, Scene, polygons_for, shapes_in, size_of
from cfree.words import coordinate

Finger = ExactPoint | AnyShape
FIRST, NEXT, MOST = 10, 10, 50  # sizes of triangles: bits below that of the body
ROUNDING = 2.0**-40  # shares of a polygon's extent from the origin: far more than the error of shapely's distances
HALVINGS = 30  # of a triangle beside a body that is near its point


@dataclass(frozen=True)
class Setting:
    """A body among fingers, as scenes without points.

    Attributes
    ----------
    scene : Scene
        Triangles replace points: a path in it is free among the fingers.
    smaller : Scene
        The same with a smaller body, if there are points: a proof in it holds for the body. Else `scene`.
    within : Fraction
        Distance of the triangles from their points, at most, and of the smaller body from the body's rim, at least; 0
        without points.
    """

    scene: Scene
    smaller: Scene
    within: Fraction


def is_point(finger: Finger) -> bool:
    """True for a point."""
    return isinstance(finger, tuple)


def to_fingers(fingers: Iterable[Any]) -> tuple[Finger, ...]:
    """Return points and shapes, exactly.

    Raises
    ------
    InvalidPolygonError
        If a finger is neither.

    Examples
    --------
    >>> to_fingers([(1, "1/2"), Curved.circle((0, 0), 1)])
    ((Fraction(1, 1), Fraction(1, 2)), <Curved in (-1, -1, 1, 1), 0 holes>)
    """
    result = list[Finger]()
    for k, item in enumerate(fingers):
        if (
            not isinstance(item, Polygon | Curved)
            and not is_single(item)
            and len(item) == 2
            and all(map(is_single, item))
        ):
            try:
                x, y = map(to_fraction, item)
            except ValueError as error:
                raise ValueError(f"fingers[{k}]: {error}") from None
            result.append((x, y))
        else:
            result += shapes_in([item], f"fingers[{k}]")
    return tuple(result)


def center_of(finger: Finger) -> ExactPoint:
    """Return the point that tells the place of a finger: the middle of its box."""
    if isinstance(finger, tuple):
        return finger
    if isinstance(finger, Curved):
        x0, y0, x1, y1 = finger.box
    else:
        xs, ys = zip(*finger.exact_rings[0], strict=True)
        x0, y0, x1, y1 = min(xs), min(ys), max(xs), max(ys)
    return (x0 + x1) / 2, (y0 + y1) / 2


def shifted(finger: Finger, by: ExactPoint) -> Finger:
    """Return a finger at another place, not turned."""
    if isinstance(finger, tuple):
        return finger[0] + by[0], finger[1] + by[1]
    return moved_shape(finger, Pose(*by))


def spread(fingers: Sequence[Finger], scale: Fraction, about: ExactPoint) -> tuple[Finger, ...]:
    """Return fingers whose places are scaled about a point; their shapes stay.

    Examples
    --------
    >>> spread(to_fingers([(1, 0), (3, 0)]), Fraction(2), (Fraction(2), Fraction(0)))
    ((Fraction(0, 1), Fraction(0, 1)), (Fraction(4, 1), Fraction(0, 1)))
    """
    result = []
    for finger in fingers:
        x, y = minus(center_of(finger), about)
        result.append(shifted(finger, ((scale - 1) * x, (scale - 1) * y)))
    return tuple(result)


def setting(
    body: Sequence[AnyShape],
    fingers: Sequence[Finger],
    pose: Pose,
    bits: int,
    units: str = "",
    names: Sequence[str] = (),
) -> Setting:
    """Return scenes of a body among fingers, with triangles so many bits smaller than the body.

    Fingers without names are named "finger 0" and so on.

    Raises
    ------
    InvalidPoseError
        If the body overlaps a finger at the pose, or has a point in its interior.
    UndecidedError
        If a point is on a curve of the body other than an arc, or almost.
    """
    size = Fraction(2) ** (ceil(log2(max(map(size_of, body)))) - bits)
    names = names or [f"finger {k}" for k in range(len(fingers))]
    shapes = [
        _triangle(body, finger, pose, size, k) if isinstance(finger, tuple) else finger
        for k, finger in enumerate(fingers)
    ]
    scene = Scene(body, shapes, obstacle_names=names, start=pose, units=units)
    require_start(scene, pose)
    if not any(map(is_point, fingers)):
        return Setting(scene, scene, Fraction(0))
    within = max(_size_at(finger, shape) for finger, shape in zip(fingers, shapes, strict=True))
    smaller = [inner for part in body for inner in _smaller(part, within)]
    if not smaller:
        return Setting(scene, scene, within)
    return Setting(scene, Scene(smaller, shapes, obstacle_names=names, start=pose, units=units), within)


def _smaller(part: AnyShape, within: Fraction) -> list[AnyShape]:
    """Return shapes inside a part of a body, at least so far from its rim."""
    if disc := radius_of(part):
        center, radius = disc
        return [Curved.circle(center, radius - within)] if radius > within else []
    inner = polygons_for(part, float(within) / 4, False)
    return [less for polygon in inner for less in inset(polygon, 2 * within) if is_within(less, polygon, within)]


def radius_of(shape: AnyShape) -> tuple[ExactPoint, Fraction] | None:
    """Return the center and the radius of a disc; None for other shapes."""
    if isinstance(shape, Curved) and isinstance(shape.path, Circle) and not shape.holes and not shape.grown:
        return shape.path.center, shape.path.radius
    return None


def _triangle(body: Sequence[AnyShape], point: ExactPoint, pose: Pose, size: Fraction, k: int) -> Polygon:
    """Return a triangle with a corner at a point, at most so large, that the body does not overlap."""
    x, y = point
    where = f"({coordinate(float(x))}, {coordinate(float(y))})"
    almost = False
    for _ in range(HALVINGS):
        for u, v in UNITS:
            a, b = (15 * u - v, 15 * v + u), (15 * u + v, 15 * v - u)
            corners = [(x + size * p / 16, y + size * q / 16) for p, q in (b, a)]
            triangle = Polygon([point, *corners])
            free = is_free(Scene(body, [triangle]), pose)
            if free:
                return triangle
            almost = almost or free is None
        size /= 2
    if almost:
        raise UndecidedError(
            f"undecided: finger {k} at {where} touches the body, or almost does, at a curve that "
            "is not an arc; move the finger off it, or give polygons for the body: scene.outer(error)"
        )
    raise InvalidPoseError(
        f"pose: finger {k} at {where} is inside the body, or in a notch of it that is too narrow; "
        "move the finger or the body"
    )


def _size_at(finger: Finger, shape: AnyShape) -> Fraction:
    """Return a bound of the distance of a triangle's corners from its point; 0 for other fingers."""
    if not isinstance(finger, tuple) or not isinstance(shape, Polygon):
        return Fraction(0)
    return max(abs(a - b) for corner in shape.exact_rings[0] for a, b in zip(corner, finger, strict=True)) * Fraction(
        3, 2
    )


def is_within(inner: Polygon, outer: Polygon, by: Fraction) -> bool:
    """True if a polygon is inside another one, at least a distance from its rim; decided exactly.

    Examples
    --------
    >>> outer = Polygon([(0, 0), (4, 0), (4, 4), (0, 4)])
    >>> inner = Polygon([(1, 1), (3, 1), (3, 3), (1, 3)])
    >>> is_within(inner, outer, Fraction(1)), is_within(inner, outer, Fraction(9, 8))
    (True, False)
    """
    if not inner._handle.is_inside(outer._handle):
        return False
    rough = inner.to_shapely().boundary.distance(outer.to_shapely().boundary)
    if rough - ROUNDING * max(map(abs, outer.bounds)) > by:
        return True
    sides = [_sides(polygon) for polygon in (inner, outer)]
    return all(_square_distance(a, b) >= by * by for a in sides[0] for b in sides[1])


Side = tuple[ExactPoint, ExactPoint]


def _sides(polygon: Polygon) -> list[Side]:
    return [(p, q) for ring in polygon.exact_rings for p, q in zip(ring, [*ring[1:], ring[0]], strict=True)]


def _square_distance(one: Side, other: Side) -> Fraction:
    """Return the square of the distance of two segments that do not cross."""
    return min(
        *(_square_from(p, other) for p in one),
        *(_square_from(p, one) for p in other),
    )


def _square_from(p: ExactPoint, side: Side) -> Fraction:
    a, b = side
    along, to = minus(b, a), minus(p, a)
    share = dot(along, to) / dot(along, along)
    if 0 < share < 1:
        return cross(along, to) ** 2 / dot(along, along)
    end = minus(p, a if share <= 0 else b)
    return dot(end, end)


def to_body(body: Any, pose: PoseLike) -> tuple[tuple[AnyShape, ...], Pose]:
    """Return the shapes of a body, and its pose."""
    if not (shapes := tuple(shapes_in(body, "body"))):
        raise ValueError("body: there is no shape; give at least one")
    return shapes, to_pose(pose, "pose")
