"""Rational numbers between two bounds, one of which may be the number sought, and the proof that it is.

At the number itself a path exists, but only one that touches, if only at its ends. A smaller robot is inside a larger
one. So paths keep a distance on one side of that number, and on the other side there are none.
docs/theory/separations.md, "Misses and margins, exactly".
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction

from cfree.errors import IncompleteError, InvalidPoseError, UnsupportedError
from cfree.exact.number import ExactPoint, simplest_between
from cfree.exact.pose import Pose
from cfree.exact.surd import Surd
from cfree.exact.vectors import cross, dot, unit
from cfree.forbidden.boundary import boundary
from cfree.free.space import free_space
from cfree.paths.path import Path
from cfree.planning.encounters import Feature, encounters
from cfree.planning.plan import plan
from cfree.planning.widest_way import features_of, features_of_shape
from cfree.polygons.polygon import Polygon
from cfree.scene.features import BOUNDS
from cfree.scene.rounded import rounded_shapes
from cfree.scene.scene import AnyShape, Scene

TRIES = 3  # numbers that are tried, the simplest first
DIGITS = 20  # most digits of decimal numbers that are tried
OFFSETS = 200  # most parallel lines whose distances are tried
Robot = Callable[[Fraction], Scene | None]


def exact_value(
    scene_at: Robot, lo: Fraction, hi: Fraction, likely: Iterable[Fraction], ends: tuple[Pose, Pose]
) -> Surd | None:
    """Return the number from `lo` to `hi` at which only paths that touch exist, if it is one of those tried.

    Parameters
    ----------
    scene_at : callable
        Returns the scene with the robot that belongs to a number; None if it has no exact form.
    likely : iterable of Fraction
        Numbers to try; the simplest between the bounds is one more, and so is the shortest decimal number.
    ends : (Pose, Pose)
    """
    numbers = {
        simplest_between(lo, hi),
        _shortest_between(lo, hi),
        *(number for number in likely if lo <= number <= hi),
    }
    for number in sorted(numbers, key=lambda x: (x.denominator, x))[:TRIES]:
        scene = scene_at(number)
        if scene is not None and only_touches(scene, *ends):
            return Surd(number)
    return None


def _shortest_between(lo: Fraction, hi: Fraction) -> Fraction:
    """Return the first decimal number of the fewest digits after the point between two numbers, or the first number."""
    scales = (10**k for k in range(DIGITS))
    return next((Fraction(math.ceil(lo * scale), scale) for scale in scales if math.ceil(lo * scale) <= hi * scale), lo)


def only_touches(scene: Scene, start: Pose, goal: Pose) -> bool:
    """True if a path joins two poses, and none that keeps a distance all along; False also if that is undecided."""
    try:
        if free_space(boundary(scene)).common_cell(start, goal) is None:
            return isinstance(plan(scene, start, goal, improve=0.0, vehicle="any"), Path)
        return any(_is_in_contact(scene, end) for end in (start, goal))
    except (IncompleteError, InvalidPoseError, UnsupportedError):
        return False


def _is_in_contact(scene: Scene, pose: Pose) -> bool:
    """True if the robot touches something at a free pose; False also if shapes are not rounded."""
    cores = rounded_shapes(scene)
    if cores is None:
        return False
    own = [_moved(f, pose) for part in cores.robot for f in features_of_shape(part, BOUNDS)]
    others = [*features_of(cores, scene.workspace)]
    return any(met.growth == 0 for f in own for g in others if f.may_touch(g) for met in encounters(f, g))


def _moved(feature: Feature, pose: Pose) -> Feature:
    return feature.mapped(lambda p: pose.apply_exact([p])[0], lambda x: x)


def widths_and_gaps(scene: Scene) -> Iterator[tuple[Fraction, Fraction]]:
    """Yield widths of the robot across its edges, each with distances of parallel edges that face each other.

    Only those of edges with rational unit normals, of polygons.

    Examples
    --------
    >>> walls = [[(-9, -1), (-1, -1), (-1, 1), (-9, 1)], [(1, -1), (9, -1), (9, 1), (1, 1)]]
    >>> scene = Scene([(0, 0), (3, 0), (3, 2), (0, 2)], walls)
    >>> sorted((int(width), int(gap)) for width, gap in widths_and_gaps(scene))
    [(2, 2), (3, 2)]
    """
    corners = [p for part in scene.robot if isinstance(part, Polygon) for p in part.exact_vertices]
    widths = set[Fraction]()
    for normal, _ in _sides(scene.robot):
        reach = [dot(normal, p) for p in corners]
        widths.add(max(reach) - min(reach))
    offsets = defaultdict[ExactPoint, set[Fraction]](set)
    for (x, y), offset in _sides(scene.obstacles):
        offsets[x, y].add(offset)
    for (x, y), offset in _sides([scene.workspace] if scene.workspace else []):
        offsets[-x, -y].add(-offset)
    gaps = {
        -other - offset
        for (x, y), near in offsets.items()
        if len(near) <= OFFSETS >= len(offsets.get((-x, -y), ()))
        for offset in near
        for other in offsets.get((-x, -y), ())
        if other + offset < 0
    }
    return ((width, gap) for width in widths for gap in gaps)


def shrinks_into_itself(shapes: Sequence[AnyShape]) -> bool:
    """True if polygons see all of their points from the origin, which is inside of each: smaller ones are inside."""
    return all(
        isinstance(shape, Polygon) and all(cross(p, q) > 0 for ring in shape.exact_rings for p, q in _edges(ring))
        for shape in shapes
    )


def _sides(shapes: Sequence[AnyShape]) -> Iterator[tuple[ExactPoint, Fraction]]:
    """Yield the outer normal of each edge of polygons, if it is rational, and the edge's place along it."""
    for shape in shapes:
        for ring in shape.exact_rings if isinstance(shape, Polygon) else ():
            for p, q in _edges(ring):
                if direction := unit((q[0] - p[0], q[1] - p[1])):
                    normal = direction[1], -direction[0]
                    yield normal, dot(normal, p)


def _edges(ring: Sequence[ExactPoint]) -> Iterator[tuple[ExactPoint, ExactPoint]]:
    return zip(ring, [*ring[1:], ring[0]], strict=True)
