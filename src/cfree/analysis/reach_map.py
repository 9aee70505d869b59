"""`reach`: the places and orientations that a machine reaches, as regions of slices at a grid of orientations.

Cells of the free space decide what is reached, exactly. Each slice is cut from their closed surfaces at one
orientation; its free parts that belong to the cells of a start are the region there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, reduce
from typing import Any, Literal

from cfree.arguments import checked
from cfree.collision.nearest_free import require_free
from cfree.curves.curved import Curved
from cfree.curves.drawn import Line
from cfree.curves.rings import Span
from cfree.errors import InvalidPoseError, UnsupportedError
from cfree.exact.number import ExactPoint, to_fraction
from cfree.exact.pose import Pose, PoseLike, to_pose
from cfree.exact.vectors import dot, minus
from cfree.forbidden.boundary import boundary
from cfree.free.space import FreeSpace, free_space
from cfree.libraries import Floats, NDArray, np, shapely
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import AnyShape, Scene, box_of, polygons_around, with_ends, with_shapes, with_vehicle
from cfree.value import Value
from cfree.vehicles.vehicle import Car, Vehicle
from cfree.words import counted

Which = Literal["some", "every", "turning"]
Progress = Callable[[float], object]
MOST_ORIENTATIONS = 3600
MOST_PIXELS = 1 << 26
SHARE = 1000  # pixels of the longer side, unless a resolution is given
NOT_FREE, NOT_REACHED, REACHED = 0, 205, 254  # greys of a ROS map in trinary mode: occupied, unknown, free
ROUNDED_UP = 1 + 2.0**-50


@dataclass(frozen=True, eq=False, repr=False)
class ReachMap(Value):
    """Positions of the robot's reference point at a grid of orientations, reached from some starts; see `reach`.

    Attributes
    ----------
    scene : Scene
    starts : tuple of Pose
    theta : (n,) float64
        The orientations, in radians.
    reached, free : tuple of shapely geometries
        For each orientation the positions that are reached, and all free ones. They are cut from cells exactly, and
        their coordinates are rounded to doubles.
    """

    scene: Scene
    starts: tuple[Pose, ...]
    theta: Floats
    reached: tuple[Any, ...]
    free: tuple[Any, ...]

    def __repr__(self) -> str:
        share = sum(region.area for region in self.reached) / (sum(region.area for region in self.free) or 1.0)
        return f"ReachMap({counted(len(self.theta), 'orientation')}, {share:.1%} of the free poses)"

    @cached_property
    def some(self) -> Any:
        """The positions reached at some of the orientations, a shapely geometry."""
        return shapely.union_all(list(self.reached))

    @cached_property
    def every(self) -> Any:
        """The positions reached at every one of the orientations; in between, the robot may not fit there."""
        return reduce(shapely.intersection, self.reached)

    @cached_property
    def turning(self) -> Any:
        """The positions that are reached and at which the robot can turn all the way round in place.

        A vehicle turns about its axle point, another robot about its reference point; the positions are those of the
        reference point at orientation 0. A disc that holds the robot in all orientations is free there, so a robot
        with a hollow around that point may turn at more places.
        """
        return _turning(self)

    @checked
    def counts(self, resolution: float | None = None) -> NDArray[np.int32]:
        """Return the number of orientations at which each pixel's middle is reached, rows from the top.

        `resolution` is that of `image`.
        """
        shape, (x0, y0, _, _), size = self._shape(resolution), self.extent, self.resolution(resolution)
        counts = np.zeros(shape, np.int32)
        for region in self.reached:
            counts += _covered(region, (x0, y0), size, shape)
        return counts[::-1]

    @checked
    def image(self, resolution: float | None = None, which: Which = "some") -> NDArray[np.uint8]:
        """Return greys by pixel, rows from the top: 254 reached, 205 free but not reached, 0 not free.

        Parameters
        ----------
        resolution : float, optional
            Side of a pixel, by default a thousandth of the map's longer side. The middle of a pixel decides.
        which : "some", "every" or "turning"
            Reached at some orientation, at every one, or with room to turn all the way round in place. Free is at some
            orientation.

        Raises
        ------
        ValueError
            If the resolution is not positive, or gives more than 67 million pixels.

        Examples
        --------
        >>> room = [(0, 0), (4, 0), (4, 3), (0, 3)]
        >>> wall = [(2, 0), ("2.1", 0), ("2.1", 3), (2, 3)]
        >>> scene = Scene([(0, 0), (1, 0), (1, "0.1"), (0, "0.1")], [wall], workspace=room)
        >>> reach(scene, [(1, 1, 0)], 8).image(1.0).tolist()[1]
        [254, 254, 205, 205]
        """
        shape, (x0, y0, _, _), size = self._shape(resolution), self.extent, self.resolution(resolution)
        image = np.full(shape, NOT_FREE, np.uint8)
        image[_covered(shapely.union_all(list(self.free)), (x0, y0), size, shape)] = NOT_REACHED
        image[_covered(getattr(self, which), (x0, y0), size, shape)] = REACHED
        return image[::-1]

    @checked
    def resolution(self, wanted: float | None = None) -> float:
        """Return the side of a pixel: the one that is wanted, or a thousandth of the longer side of the map."""
        x0, y0, x1, y1 = self.extent
        if wanted is not None and not 0 < wanted < math.inf:
            raise ValueError(f"resolution: {wanted}; give a length above 0")
        return max(x1 - x0, y1 - y0) / SHARE if wanted is None else wanted

    def _shape(self, resolution: float | None) -> tuple[int, int]:
        """Return the number of rows and columns of pixels."""
        x0, y0, x1, y1 = self.extent
        size = self.resolution(resolution)
        rows, columns = (max(1, math.ceil((high - low) / size - 1e-9)) for low, high in ((y0, y1), (x0, x1)))
        if columns * rows > MOST_PIXELS:
            pixels = f"{columns:,} x {rows:,} pixels; give one that makes {MOST_PIXELS:,} at most"
            raise ValueError(f"resolution: {resolution} gives {pixels}")
        return rows, columns

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """The box around obstacles, workspace and free positions: xmin, ymin, xmax, ymax."""
        scene = self.scene
        shapes = [*scene.obstacles, *([scene.workspace] if scene.workspace else [])]
        free = shapely.union_all(list(self.free))
        boxes = np.array([*map(box_of, shapes), *([] if free.is_empty else [free.bounds])])
        return (*boxes[:, :2].min(axis=0).tolist(), *boxes[:, 2:].max(axis=0).tolist())


@checked
def reach(
    scene: Scene,
    starts: Sequence[PoseLike] | None = None,
    orientations: int = 72,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
) -> ReachMap:
    """Compute the places and orientations that a machine reaches from some starts.

    Parameters
    ----------
    scene : Scene
        Of polygons and rounded shapes.
    starts : sequence of Pose or (x, y, theta), optional
        By default the scene's start.
    orientations : int
        Number of orientations, at equal steps from 0.
    threads : int, optional
        All cores by default.
    progress : callable, optional
        Called with the completed share, from 0 to 1.

    Returns
    -------
    ReachMap

    Raises
    ------
    InvalidPoseError
        If there is no start, or one is forbidden, an exact fit, or one of a vehicle that touches something: contacts
        may hold a vehicle.
    UnsupportedError
        If the vehicle has no reverse gear: it may not reach all of a cell.
    ValueError
        If `orientations` is not between 1 and 3600.

    Notes
    -----
    Reached is the closure of the cells of the starts, without the poses beyond passages that are exactly as wide as the
    robot. A car with both gears and a differential drive reach every pose inside of a cell of their start, so the map
    holds for them as for a robot that moves sideways; see docs/theory/vehicles.md. In an unbounded scene the map ends
    beyond the obstacles.

    Examples
    --------
    >>> room, wall = [(0, 0), (9, 0), (9, 5), (0, 5)], [(4, 0), (5, 0), (5, 4), (4, 4)]
    >>> bench = Scene([(-1, "-0.25"), (1, "-0.25"), (1, "0.25"), (-1, "0.25")], [wall], workspace=room)
    >>> around = reach(bench, [(2, 2, 0)])
    >>> around
    ReachMap(72 orientations, 100.0% of the free poses)
    >>> larger = Scene([(-1, "-0.6"), (1, "-0.6"), (1, "0.6"), (-1, "0.6")], [wall], workspace=room)
    >>> reach(larger, [(2, 2, 0)]).some.bounds[2] < 4 < around.some.bounds[2]
    True
    """
    if not 1 <= orientations <= MOST_ORIENTATIONS:
        raise ValueError(f"orientations: {orientations}; give 1 to {MOST_ORIENTATIONS}")
    if starts is None:
        starts = [] if scene.start is None else [scene.start]
    if not len(starts):
        raise InvalidPoseError("no start: the scene has none, and none was given; give x, y and theta")
    refuse_forward_only(scene.vehicle)
    poses = tuple(to_pose(pose, f"starts[{k}]") for k, pose in enumerate(starts))
    for k, pose in enumerate(poses):
        require_free(scene, pose, f"starts[{k}]")
    space = free_space(boundary(scene, threads=threads, max_seconds=math.inf), threads=threads)
    cells = {cell for k, pose in enumerate(poses) for cell in _cells_of(space, pose, f"starts[{k}]")}
    theta: Floats = np.linspace(0.0, math.tau, orientations, endpoint=False)
    reached, free = list[Any](), list[Any]()
    for k in range(orientations):
        parts = free_parts(space, f"{360 * k / orientations!r}deg", poses)
        free.append(shapely.union_all([part for part, _ in parts]))
        reached.append(shapely.union_all([part for part, cell in parts if cell in cells]))
        if progress is not None:
            progress((k + 1) / orientations)
    return ReachMap(scene, poses, theta, tuple(reached), tuple(free))


@checked
def turning_circle(robot: Any, vehicle: Vehicle | None = None) -> float:
    """Return the diameter of the smallest circle in which a machine turns all the way round, from wall to wall.

    Parameters
    ----------
    robot : shape or sequence of shapes, or a Scene
        Of a scene its robot, and its vehicle unless another is given.
    vehicle : Car or DifferentialDrive, optional
        A differential drive turns about its axle point, and a car in its tightest arc, to the side where that needs
        less room. Without a vehicle the robot turns about its reference point.

    Returns
    -------
    float
        Rounded up. Of curves other than arcs of circles it is that of polygons around them.

    Examples
    --------
    >>> from cfree import Car, DifferentialDrive
    >>> car = [(-1, -1), (3, -1), (3, 1), (-1, 1)]
    >>> turning_circle(car, DifferentialDrive()), turning_circle(car, Car(4))
    (6.324555320336..., 11.6619037896...)
    """
    scene = robot if isinstance(robot, Scene) else Scene(robot)
    vehicle = scene.vehicle if vehicle is None else vehicle
    if vehicle is None:
        return 2 * _farthest(scene, (to_fraction(0), to_fraction(0)))
    if not isinstance(vehicle, Car):
        return 2 * _farthest(scene, vehicle.axle)
    frame, (left, right) = vehicle.frame, vehicle.radii
    centers = frame.apply_exact([(to_fraction(0), left), (to_fraction(0), -right)])
    return 2 * min(_farthest(scene, center) for center in centers)


def refuse_forward_only(vehicle: Vehicle | None) -> None:
    """Raise an UnsupportedError for a car without reverse gear, which does not reach all of a cell.

    Examples
    --------
    >>> refuse_forward_only(Car(4, gears="forward"))
    Traceback (most recent call last):
        ...
    cfree.errors.UnsupportedError: vehicle: a car without reverse gear may not reach all of a cell; leave it out ...
    """
    if isinstance(vehicle, Car) and vehicle.gears == "forward":
        raise UnsupportedError(
            "vehicle: a car without reverse gear may not reach all of a cell; leave it out for an answer that holds "
            "all that it can do, or ask cfree.plan for one goal"
        )


def _farthest(scene: Scene, center: ExactPoint) -> float:
    """Return the distance of a robot's farthest point from a point of its plane, rounded up."""
    return max(_reach(part, center) for part in scene.robot) * ROUNDED_UP


def _reach(part: AnyShape, center: ExactPoint) -> float:
    if isinstance(part, Polygon):
        return math.sqrt(max(dot(v, v) for v in (minus(p, center) for p in part.exact_vertices)))
    outer = part.curves[0]
    pieces = [piece for piece in outer if isinstance(piece, Line) or (isinstance(piece, Span) and piece.is_circular)]
    if len(pieces) == len(outer):
        return max(_reach_of(piece, center) for piece in pieces) + float(part.grown)
    return max(_reach(polygon, center) for polygon in polygons_around(part))


def _reach_of(piece: Line | Span, center: ExactPoint) -> float:
    """Return the distance of the farthest point of a line or an arc of a circle, without its start."""
    last = minus(piece.end, center)
    away = math.sqrt(dot(last, last))
    if isinstance(piece, Line):
        return away
    out = minus(piece.center, center)
    angle = math.atan2(dot(out, piece.v), dot(out, piece.u)) % math.tau if any(out) else 0.0
    return max(away, math.sqrt(dot(out, out)) + math.sqrt(dot(piece.u, piece.u))) if angle <= piece.sweep else away


def _cells_of(space: FreeSpace, pose: Pose, name: str) -> set[int]:
    """Return the cells whose closure contains a start."""
    cells = space._cells_at(pose)
    if not cells:
        raise InvalidPoseError(f"{name} is free, but an exact fit, in the closure of no cell; move it")
    if space.boundary.scene.vehicle is not None and space.nearby(pose).on:
        raise InvalidPoseError(f"{name} touches an obstacle, whose contact may hold a vehicle; move it away from there")
    return cells


def free_parts(space: FreeSpace, angle: str, ends: Sequence[Pose] = ()) -> list[tuple[Any, int]]:
    """Return the free regions of the reference point at an orientation, and the cell of each.

    In an unbounded scene they end beyond the obstacles and some poses.
    """
    surfaces = space.surfaces
    forbidden = surfaces.slice(angle).forbidden
    frame = surfaces.features.rim or _around(space.boundary.scene, ends)
    parts = shapely.get_parts(shapely.box(*frame).difference(forbidden)).tolist()
    parts = [part for part in parts if part.geom_type == "Polygon" and part.area > 0]
    places = [part.representative_point() for part in parts]
    return [(part, space.locate(Pose(point.x, point.y, angle))) for part, point in zip(parts, places, strict=True)]


def _around(scene: Scene, ends: Sequence[Pose]) -> tuple[float, float, float, float]:
    """Return a box well beyond the obstacles of an unbounded scene, and some poses."""
    boxes = np.array([*map(box_of, scene.obstacles), *((float(p.x), float(p.y)) * 2 for p in ends or [Pose(0, 0)])])
    far = 2 * _farthest(scene, (to_fraction(0), to_fraction(0)))
    x0, y0 = boxes[:, :2].min(axis=0) - far
    x1, y1 = boxes[:, 2:].max(axis=0) + far
    return float(x0), float(y0), float(x1), float(y1)


def _turning(reached: ReachMap) -> Any:
    scene = reached.scene
    center = (to_fraction(0), to_fraction(0)) if scene.vehicle is None else scene.vehicle.axle
    disc = Curved.circle(center, _farthest(scene, center))
    space = free_space(boundary(with_vehicle(with_shapes(with_ends(scene, None, None), [disc]), None)))
    places = shapely.union_all([part for part, cell in free_parts(space, "0deg", reached.starts) if cell >= 0])
    return places.intersection(reached.reached[0])


def _covered(region: Any, corner: tuple[float, float], size: float, shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """Return the pixels, by rows from below, whose middles are in a region: edges toggle all to their right."""
    rows, columns = shape
    toggles = np.zeros((rows, columns + 1), bool)
    for ring in shapely.get_rings(shapely.get_parts(region)).tolist():
        points = (shapely.get_coordinates(ring) - corner) / size - 0.5
        for (x, y), (u, v) in zip(points[:-1].tolist(), points[1:].tolist(), strict=True):
            (x, y), (u, v) = ((x, y), (u, v)) if y < v else ((u, v), (x, y))
            k = np.arange(max(0, math.ceil(y)), min(rows, math.ceil(v)))
            if len(k):
                place = np.ceil(x + (k - y) * ((u - x) / (v - y)))
                np.logical_xor.at(toggles, (k, np.clip(place, 0, columns).astype(int)), True)
    return np.logical_xor.accumulate(toggles, axis=1)[:, :-1]
