"""Exact test, by squares of rationals, that the robot at a pose keeps a distance from everything."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from cfree.arguments import checked
from cfree.errors import InvalidPoseError
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.libraries import Floats, Ints, np
from cfree.scene.features import WORKSPACE
from cfree.scene.naming import placed
from cfree.scene.scene import Scene

ROUNDING = 2.0**-40  # relative to the coordinates: exceeds the rounding of the boxes


@checked
def require_distance(scene: Scene, pose: Pose, distance: Fraction, name: str = "pose") -> None:
    """Check, exactly, that the robot keeps a distance from obstacles and workspace at a free pose.

    Raises
    ------
    InvalidPoseError
        If it is nearer.

    Examples
    --------
    >>> scene = Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)], obstacles=[[(4, 4), (9, 4), (9, 9), (4, 9)]])
    >>> require_distance(scene, Pose(0, 0), Fraction(4))
    >>> require_distance(scene, Pose(0, 0), Fraction(5), "start")
    Traceback (most recent call last):
    cfree.errors.InvalidPoseError: start: 4.24264 away from obstacle 0, 5 x 5 at (6.5, 6.5), and the clearance \
is 5; move it, or give a clearance of less than 4.24264
    """
    nearest = min(_nearer(scene, pose, distance), default=None)
    if nearest is not None:
        square, obstacle = nearest
        away = f"{float(square) ** 0.5:.6g}"
        remedy = f"move it, or give a clearance of less than {away}" if square else "it touches; move it"
        raise InvalidPoseError(
            f"{name}: {away} away from {placed(scene, obstacle)}, and the clearance is {float(distance):g}; {remedy}"
        )


def _nearer(scene: Scene, pose: Pose, distance: Fraction) -> Iterator[tuple[Fraction, int]]:
    """Yield squared distances between a vertex and an edge that are less than a distance, and the obstacles.

    Nothing overlaps, so the least distance from an obstacle is one of these.
    """
    shapes = [*enumerate(scene.obstacles), *([(WORKSPACE, scene.workspace)] if scene.workspace else [])]
    for part in scene.robot:
        points, placed = pose.apply_exact(part.exact_vertices), pose.apply(part.vertices)
        own = _boxes(placed, part.next)
        for number, shape in shapes:
            largest = max(float(np.abs(placed).max()), *map(abs, shape.bounds))
            room = float(distance) + ROUNDING * (float(distance) + largest)
            for i, j in _close(own, _boxes(shape.vertices, shape.next), room):
                edge = points[i], points[int(part.next[i])]
                other = shape.exact_vertices[j], shape.exact_vertices[int(shape.next[j])]
                square = min(square_distance(other[0], *edge), square_distance(edge[0], *other))
                if square < distance * distance:
                    yield square, number


def _boxes(vertices: Floats, after: Ints) -> Floats:
    """Return boxes (n, 4), xmin, ymin, xmax, ymax, of the edges that begin at each vertex."""
    ends = vertices, vertices[after]
    return np.concatenate([np.minimum(*ends), np.maximum(*ends)], axis=1)


def _close(some: Floats, others: Floats, room: float) -> Iterator[tuple[int, int]]:
    """Yield pairs of edges whose boxes are at most `room` apart."""
    low, high = some[:, :2].min(axis=0) - room, some[:, 2:].max(axis=0) + room
    for j in np.flatnonzero(((others[:, 2:] >= low) & (others[:, :2] <= high)).all(axis=1)).tolist():
        near = (some[:, 2:] >= others[j, :2] - room) & (some[:, :2] <= others[j, 2:] + room)
        yield from ((i, j) for i in np.flatnonzero(near.all(axis=1)).tolist())


def square_distance(point: ExactPoint, a: ExactPoint, b: ExactPoint) -> Fraction:
    """Return the squared distance of a point from a segment.

    Examples
    --------
    >>> square_distance((0, 2), (-1, 0), (1, 0)), square_distance((4, 4), (-1, 0), (1, 0))
    (Fraction(4, 1), 25)
    """
    (x, y), (u, v) = (point[0] - a[0], point[1] - a[1]), (b[0] - a[0], b[1] - a[1])
    along, whole = x * u + y * v, u * u + v * v
    if along <= 0:
        return x * x + y * y
    if along >= whole:
        return (point[0] - b[0]) ** 2 + (point[1] - b[1]) ** 2
    return Fraction((x * v - y * u) ** 2, whole)
