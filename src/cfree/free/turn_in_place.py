"""Free orientations at a fixed position, in closed form, exact fits included.

Turned about a fixed point P, a point a of the robot is at P + R a. The sign of A + B cos + C sin decides if a vertex of
the robot is beyond the line of an obstacle's edge. The same form decides it for a vertex of an obstacle and an edge of
the robot. Two convex polygons are apart if for an edge of one all vertices of the other are on its line or beyond it:
if these forms are at most 0. See docs/theory/motions.md, "Turning in place".
"""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise

from cfree.arguments import checked
from cfree.collision.pose_checker import limits_of
from cfree.exact.angle_interval import AngleInterval
from cfree.exact.angle_set import Arcs, Form, union_of_intersections, where_not_positive
from cfree.exact.number import ExactPoint, Number, common_denominator, to_fraction
from cfree.exact.pose import Pose, PoseLike, to_pose
from cfree.forbidden.boundary import Boundary
from cfree.scene.features import BODY, Point, ShapeFeatures, scene_features
from cfree.scene.scene import Scene

ORIGIN: ExactPoint = (Fraction(0), Fraction(0))


@checked
def turn_in_place(
    scene: Scene | Boundary, pose: PoseLike, pole: tuple[Number, Number] | None = None
) -> tuple[AngleInterval, ...]:
    """Return all free orientations of the robot turned about a point that stays in place.

    Parameters
    ----------
    scene : Scene or Boundary
    pose : Pose or (x, y, theta)
        Its orientation does not matter if the pole is its reference point, and it need not be free.
    pole : pair of numbers, optional
        The point that stays in place, in the world; by default the reference point.

    Returns
    -------
    tuple of AngleInterval
        Orientations theta of the robot: disjoint closed intervals in counter-clockwise order, some of them single
        orientations. Empty if none is free; one interval without ends if all are.

    Notes
    -----
    Ends are exact: roots of polynomials of degree at most 2 in tan(theta / 2). Time is about linear in the products of
    the vertices of the robot's convex pieces and those of the obstacles within reach.

    Examples
    --------
    A rod of length 10 and width 2 is between walls 4 above and 4 below; then its side is on the upper wall:

    >>> walls = [[(-20, 4), (20, 4), (20, 5), (-20, 5)], [(-20, -5), (20, -5), (20, -4), (-20, -4)]]
    >>> scene = Scene(robot=[(-5, -1), (5, -1), (5, 1), (-5, 1)], obstacles=walls)
    >>> first, second = turn_in_place(scene, Pose(0, 0))
    >>> [[round(math.degrees(theta), 4) for theta in interval.theta] for interval in (first, second)]
    [[139.6388, 220.3612], [319.6388, 400.3612]]
    >>> second.stop.polynomial  # 5 sin + cos = 4, in tan(theta / 2)
    (3, -10, 5)
    >>> [(interval.theta, interval.is_single) for interval in turn_in_place(scene, Pose(0, 3))]
    [((0.0, 0.0), True), ((3.141592653589793, 3.141592653589793), True)]
    """
    pose = to_pose(pose, "pose")
    P = (pose.x, pose.y) if pole is None else (to_fraction(pole[0]), to_fraction(pole[1]))
    back = Pose(0, 0, {"tau": pose.tau}).inverse()
    (of_pole,) = back.apply_exact([(P[0] - pose.x, P[1] - pose.y)])  # in the robot's frame
    return free_orientations(scene.scene if isinstance(scene, Boundary) else scene, P, of_pole)


def free_orientations(scene: Scene, P: ExactPoint, of_pole: ExactPoint = ORIGIN) -> tuple[AngleInterval, ...]:
    """Return the orientations of `turn_in_place` about a point that is at `of_pole` in the robot's frame.

    By default that is the reference point. The arguments are not checked.
    """
    features, limits = scene_features(scene), limits_of(scene)
    finite = [limit for limit in limits if isinstance(limit, Fraction)]
    unit = math.lcm(features.scale, common_denominator([*P, *of_pole, *finite]))
    x, y, ax, ay = (int(c * unit) for c in (*P, *of_pole))
    sets = [where_not_positive(form) for form in _limit_forms(limits, unit, (x, y), (ax, ay))]
    robot = _pieces(features.robot, unit, (ax, ay))
    reach = max(x * x + y * y for piece in robot for x, y in piece)
    for obstacle in _pieces(features.obstacles, unit, (x, y)):
        (x0, x1), (y0, y1) = ((min(axis), max(axis)) for axis in zip(*obstacle, strict=True))
        if max(x0, -x1, 0) ** 2 + max(y0, -y1, 0) ** 2 < reach:
            sets += [_apart(part, obstacle) for part in robot]
    free = union_of_intersections([sets])
    if isinstance(free, bool):
        return (AngleInterval(None, None),) if free else ()
    intervals = [AngleInterval(start.exact, stop.exact) for start, stop in free]
    return tuple(sorted(intervals, key=lambda interval: interval.theta))


def _pieces(shape: ShapeFeatures, unit: int, origin: Point) -> list[list[Point]]:
    """Return the convex pieces in integers, relative to a point."""
    factor, (x, y) = unit // shape.scale, origin
    points = [(factor * p - x, factor * q - y) for p, q in shape.vertices]
    layers = zip(shape.pieces, shape.core.piece_layer, strict=True)
    return [[points[v] for v in piece] for piece, layer in layers if layer == BODY]


def _limit_forms(limits: tuple[Fraction | float, ...], unit: int, pole: Point, of_pole: Point) -> list[Form]:
    """Return forms at most 0 where the reference point, at the pole minus R of_pole, is within the limits."""
    (x, y), (ax, ay) = pole, of_pole
    forms = []
    for k, (p, B, C) in enumerate(((x, ax, -ay), (y, ay, ax)) * 2):
        if isinstance(limit := limits[k], Fraction):
            sign = 1 if k < 2 else -1
            forms.append((sign * (int(limit * unit) - p), sign * B, sign * C))
    return forms


def _apart(robot: list[Point], obstacle: list[Point]) -> Arcs:
    """Return the angles at which the interiors of two convex polygons, the robot's turned, have no common point."""
    families = []
    for (x, y), (z, w) in pairwise([*obstacle, obstacle[0]]):
        ex, ey = z - x, w - y
        families.append([(ey * x - ex * y, ex * v - ey * u, ex * u + ey * v) for u, v in robot])
    for (x, y), (z, w) in pairwise([*robot, robot[0]]):
        gx, gy = z - x, w - y
        families.append([(gy * x - gx * y, gx * v - gy * u, -gx * u - gy * v) for u, v in obstacle])
    return union_of_intersections([[where_not_positive(form) for form in forms] for forms in families])
