"""The largest disc that gets from one place to another, exactly, and where it is stopped.

All features of the obstacles, segments, arcs and discs, grow at one rate. Where two of them meet, halfway between two
points nearest to each other, they join to a chain. When a chain first closes around start or goal alone, no disc as
large as that passes. docs/theory/separations.md, "The widest way of a disc", has the proof.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise

from cfree.exact.number import ExactPoint
from cfree.exact.orientation import Location, locate
from cfree.exact.pose import Pose
from cfree.exact.surd import Surd
from cfree.exact.vectors import cross, dot, minus
from cfree.planning.enclosure import first_enclosure
from cfree.planning.encounters import Feature, Rim, encounters
from cfree.polygons.polygon import Polygon
from cfree.scene.features import BOUNDS, WORKSPACE
from cfree.scene.grown_cores import CoreArc, Cores, Rounded
from cfree.scene.hull_triangles import meeting_of_tangents
from cfree.scene.naming import placed
from cfree.scene.rounded import rounded, rounded_shapes
from cfree.scene.scene import AnyShape, Scene


@dataclass(frozen=True)
class NarrowPlace:
    """The place that decides how large a disc gets from start to goal.

    Attributes
    ----------
    point : (float, float)
        The middle of the disc there, rounded.
    obstacles : tuple of int
        The two that it is between, or the one beside the start or goal; -1 is the bounds, -2 the workspace.
    names : tuple of str
        Their names in words, with size and place.
    end : str
        "start" or "goal" if that pose itself has no more room.

    Examples
    --------
    >>> print(NarrowPlace((0.5, 2.0), (3, 7), ("obstacle 3", "obstacle 7")))
    between obstacle 3 and obstacle 7 at (0.5, 2)
    """

    point: tuple[float, float]
    obstacles: tuple[int, ...]
    names: tuple[str, ...] = field(compare=False, repr=False)
    end: str = ""

    def __str__(self) -> str:
        x, y = self.point
        if self.end:
            return f"beside {self.names[0]} at the {self.end}"
        one, other = self.names
        where = f"between parts of {one}" if one == other else f"between {one} and {other}"
        return f"{where} at ({x:.6g}, {y:.6g})"


@dataclass(frozen=True)
class WidestWay:
    """The largest disc about one point of a robot that gets from start to goal.

    Attributes
    ----------
    disc : Rounded
        The robot.
    radius : Surd or None
        That of the largest disc; 0 if there is none, None if all discs get there.
    at : NarrowPlace or None
        The place that stops larger ones.
    """

    disc: Rounded
    radius: Surd | None
    at: NarrowPlace | None = None

    @property
    def center(self) -> ExactPoint:
        """The middle of the robot, in its frame."""
        return self.disc.points[0]

    @property
    def margin(self) -> Surd | None:
        """The largest clearance of the robot; below 0 if it does not get there, None if it is infinite."""
        return None if self.radius is None else self.radius - self.disc.radius


def widest_way(scene: Scene, start: Pose, goal: Pose) -> WidestWay | None:
    """Find the largest disc that gets from start to goal.

    Returns
    -------
    WidestWay, or None
        None if the robot is not one disc, about its reference point if there are bounds; or if shapes are not rounded.

    Examples
    --------
    >>> from cfree.curves.curved import Curved
    >>> posts = [Curved.circle((x, x), 1) for x in (0, 3)]
    >>> walls = [(-3, -3), (6, -3), (6, 6), (-3, 6)]
    >>> scene = Scene(Curved.circle((0, 0), "1/4"), posts, workspace=walls)
    >>> way = widest_way(scene, Pose("9/2", "-3/2"), Pose("-3/2", "9/2"))
    >>> print(way.radius, "=", float(way.radius), "margin", way.margin)
    -1 + 3/2 sqrt(2) = 1.1213203435596426 margin -5/4 + 3/2 sqrt(2)
    >>> print(way.at)
    between obstacle 0, 2 x 2 at (0, 0) and obstacle 1, 2 x 2 at (3, 3) at (1.5, 1.5)

    Half a disc with a handle beside a wall, in a round room:

    >>> from cfree.curves import Arc
    >>> half = Curved([(0, -3), Arc((0, 3), center=(0, 0)), (0, 1), (-12, 1), (-12, -1), (0, -1)])
    >>> wall = [(4, -3), (12, -3), (12, 3), (4, 3)]
    >>> scene = Scene(Curved.circle((0, 0), "1/4"), [half, wall], workspace=Curved.circle((0, 0), 11))
    >>> way = widest_way(scene, Pose(0, 7), Pose(0, -7))
    >>> print(way.radius, way.at.obstacles)
    1/2 (0, 1)
    """
    disc = rounded(scene.robot[0]) if len(scene.robot) == 1 else None
    if disc is None or not disc.is_disc:
        return None
    (center,) = disc.points
    if scene.bounds and any(center):
        return None
    cores = rounded_shapes(scene)
    if cores is None:
        return None
    (p,), (q,) = start.apply_exact([center]), goal.apply_exact([center])
    ends = p, q
    if any(_is_blocked(scene, cores, end) for end in ends):
        return WidestWay(disc, Surd(0))
    features = [*features_of(cores, scene.workspace)]
    if not features:
        return WidestWay(disc, None)
    rooms = [_room_at(end, features) for end in ends]
    (room, owner), end, name = min(zip(rooms, ends, ("start", "goal"), strict=True), key=lambda each: each[0][0])
    if room <= 0:
        return WidestWay(disc, Surd(0))
    stop = first_enclosure(features, scene.bounds, ends, room)
    if stop is None:
        at = NarrowPlace((float(end[0]), float(end[1])), (owner,), (placed(scene, owner),), name)
        return WidestWay(disc, room.reduced, at)
    both = tuple(BOUNDS if f is None else f.owner for f in (stop.one, stop.other))
    at = NarrowPlace(stop.place, both, tuple(placed(scene, k) for k in both))
    return WidestWay(disc, stop.growth.reduced, at)


# --- features ---


def features_of(cores: Cores, workspace: AnyShape | None) -> Iterator[Feature]:
    """Yield the features of obstacles and workspace; those of one owner follow each other."""
    own = len(cores.obstacles) - cores.frames
    for k, shape in enumerate(cores.obstacles):
        yield from features_of_shape(shape, k if k < own else WORKSPACE)
    if isinstance(workspace, Polygon):
        yield from features_of_shape(Rounded(workspace, Fraction(0)), WORKSPACE)


def features_of_shape(shape: Rounded, owner: int) -> Iterator[Feature]:
    """Yield the features of a grown core."""
    if isinstance(shape.core, Polygon):
        yield from (Feature(p, q, shape.radius, owner) for p, q in _edges(shape.core))
    else:
        yield Feature(shape.core[0], shape.core[-1], shape.radius, owner)
    for arc in shape.arcs:
        corner = arc.beyond[1] if arc.beyond else meeting_of_tangents(arc.start, arc.end, arc.center)
        rim = Rim(arc.center, arc.radius, corner, arc.is_convex)
        yield Feature(arc.start, arc.end, shape.radius, owner, rim)


def _edges(polygon: Polygon) -> Iterator[tuple[ExactPoint, ExactPoint]]:
    for ring in polygon.exact_rings:
        yield from _closed(ring)


def _closed(ring: Sequence[ExactPoint]) -> Iterator[tuple[ExactPoint, ExactPoint]]:
    return pairwise([*ring, ring[0]])


def _is_blocked(scene: Scene, cores: Cores, point: ExactPoint) -> bool:
    """True if a point is inside of an obstacle before it is grown, or outside of the workspace or the bounds."""
    x, y = point
    if scene.bounds:
        x0, y0, x1, y1 = scene.bounds
        if not (x0 <= x <= x1 and y0 <= y <= y1):
            return True
    workspace = cores.straight(scene.workspace)
    if workspace and locate(point, _edges(workspace)) is Location.OUTSIDE:
        return True
    if cores.frames:
        frame = cores.obstacles[-cores.frames].core
        assert isinstance(frame, Polygon)
        if locate(point, _closed(frame.exact_rings[0])) is Location.OUTSIDE:
            return True
    return any(_is_inside(shape, point) for shape in cores.obstacles)


def _is_inside(shape: Rounded, point: ExactPoint) -> bool:
    """True if a point is inside of a core with its arcs."""
    if not isinstance(shape.core, Polygon):
        return False
    return locate(point, _edges(shape.core)) is Location.INSIDE or any(_is_at_arc(arc, point) for arc in shape.arcs)


def _is_at_arc(arc: CoreArc, point: ExactPoint) -> bool:
    """True if a point is between an arc and its chord, or a concave arc and its corner."""
    towards = minus(point, arc.center)
    far = dot(towards, towards) - arc.radius**2
    if arc.beyond is None:
        return far < 0 and cross(minus(arc.end, arc.start), minus(point, arc.start)) < 0
    corners = arc.start, arc.beyond[1], arc.end
    return far > 0 and all(cross(minus(q, p), minus(point, p)) < 0 for p, q in _closed(corners))


def _room_at(point: ExactPoint, features: Sequence[Feature]) -> tuple[Surd, int]:
    """Return the distance of a point from the features, and the owner of the nearest."""
    here = Feature(point, point, Fraction(0), BOUNDS)
    distances = ((2 * met.growth, f.owner) for f in features for met in encounters(here, f))
    return min(distances)
