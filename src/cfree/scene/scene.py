"""Scene: a robot, the obstacles it may not overlap, and the region it must stay in.

The robot's polygons are given in the robot's own frame, whose origin is the reference point; everything else
in the world. Shapes are closures of their interiors: a segment or a point forbids nothing.
"""

from __future__ import annotations

import math
import reprlib
from collections.abc import Iterable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from typing import Any, Literal

import cfree._core as _core
from cfree.arguments import checked
from cfree.collector import collection_paused
from cfree.curves.curved import Curved
from cfree.curves.rings import Circle
from cfree.curves.similar import moved_shape
from cfree.errors import InvalidPolygonError, InvalidPoseError, UndecidedError, UnsupportedError
from cfree.exact.number import Number, is_single, to_fraction
from cfree.exact.pose import Pose, PoseLike, to_pose
from cfree.lazy import registered
from cfree.libraries import is_array
from cfree.polygons.polygon import Polygon, polygon_of
from cfree.scene.coordinate_range import range_fault
from cfree.scene.goals import Goal, to_goals
from cfree.scene.reading import Note, in_order
from cfree.scene.reading_lines import losses
from cfree.value import Keeping, Shown
from cfree.vehicles.vehicle import Vehicle
from cfree.words import counted, listed

Bounds = tuple[Fraction, Fraction, Fraction, Fraction]
AnyShape = Polygon | Curved
SIDES_OF_ROUND = 256  # parts of a robot's size: error of the polygon that tells its radius


@checked
@dataclass(frozen=True, slots=True, init=False, repr=False)
class Scene(Shown, Keeping):
    """A robot among obstacles.

    Parameters
    ----------
    robot : shape or sequence of shapes
        One or more polygons that move together, in a frame whose origin is the reference point. A shape is a
        `Polygon`, an (n, 2) array, a list of points, a shapely polygon or multipolygon, or a `Curved`.
    obstacles : shape or sequence of shapes
        They may touch and overlap. There may be none.
    obstacle_names : sequence of (str or None), optional
        One for each shape; all polygons of a multipolygon get its name. Unnamed ones are called
        ``"obstacle 0"`` and so on, by their index.
    bounds : four numbers, optional
        (xmin, ymin, xmax, ymax): the rectangle the reference point stays in.
    workspace : shape, optional
        The whole robot stays in this one polygon.
    start, goal : Pose or (x, y, theta), optional
        Configurations, theta as `Pose` takes it. A goal may also be a place (x, y), at which any orientation will do.
    goals : sequence of such, optional
        Several goals instead of one: any one of them will do. The attribute also holds a place given as `goal`.
    vehicle : Car or DifferentialDrive, optional
        The machine that `plan` drives; by default the robot moves in any direction. The robot's shapes decide what
        is free, for any vehicle.
    units, name, note : str, optional
        Unit of length, title and remarks.
    source : mapping of str to str, optional
        Origin of the data, and their licence.
    check : mapping, optional
        Facts about the scene that have been checked, as JSON.
    version : int, optional
        Version of the scene format.
    reading : sequence of Note, optional
        Losses, guesses and changes of reading, if it was read from a file: the attribute has the most serious first.
        It is no part of the value. Scenes made from this one keep it.

    Raises
    ------
    InvalidPolygonError
        If a shape is not a polygon, or the robot is empty.
    ValueError
        If the bounds are empty, names and obstacles differ in number, or there are both a goal and goals.
    UnsupportedError
        If a coordinate is larger than 1e150, or all of them over one common denominator are integers of more than 1110
        bits. Lengths from 1e-150 to 1e150 may meet in one scene.

    Notes
    -----
    `plan`, `max_scale`, `max_margin`, `nearest_miss`, `blockers`, `nearest_free`, `is_free`, `verify.answer` and
    pictures accept round shapes; `is_free_motion` and `first_contact` those of segments and circular arcs; `boundary`,
    what is made of it, and folders of tiles rounded ones. Everything else accepts polygons only: use the scenes of
    `outer` or `inner`.

    Examples
    --------
    >>> scene = Scene(robot=[(0, 0), (1, 0), (0, 1)], obstacles=[[(3, 0), (4, 0), ("10/3", "1/3")]])
    >>> scene
    Scene(robot: 3 vertices; 1 obstacle: 3 vertices)
    >>> scene.obstacle_names
    ('obstacle 0',)
    """

    robot: tuple[Polygon, ...]
    obstacles: tuple[Polygon, ...]
    obstacle_names: tuple[str, ...]
    bounds: Bounds | None
    workspace: Polygon | None
    start: Pose | None
    goal: Pose | None
    goals: tuple[Goal, ...]
    vehicle: Vehicle | None
    units: str
    name: str
    note: str
    source: Mapping[str, str] = field(hash=False)
    check: Mapping[str, object] = field(hash=False)
    version: int
    reading: tuple[Note, ...] = field(compare=False)
    curved: bool = field(init=False, compare=False)  # True if some of its shapes are round

    def __init__(
        self,
        robot: Any,
        obstacles: Any = (),
        *,
        obstacle_names: Sequence[str | None] | None = None,
        bounds: Sequence[Number] | None = None,
        workspace: Any = None,
        start: PoseLike | None = None,
        goal: PoseLike | Sequence[PoseLike] | None = None,
        goals: Sequence[PoseLike] = (),
        vehicle: Vehicle | None = None,
        units: str = "",
        name: str = "",
        note: str = "",
        source: Mapping[str, str] | None = None,
        check: Mapping[str, object] | None = None,
        version: int = 1,
        reading: Sequence[Note] = (),
    ) -> None:
        robot_parts = [
            polygon for k, item in enumerate(_items(robot, "robot")) for polygon in _shapes(item, f"robot[{k}]")
        ]
        if not robot_parts:
            raise InvalidPolygonError("the robot is empty; give at least one polygon")
        items = _items(obstacles, "obstacles")
        names: Sequence[str | None] = [None] * len(items) if obstacle_names is None else obstacle_names
        if len(names) != len(items):
            raise ValueError(
                f"{counted(len(names), 'name')} for {counted(len(items), 'obstacle')}; give one for each, or None"
            )
        if goal is not None and len(goals):
            raise ValueError("goal and goals: give one of them")
        aims = to_goals(list(goals) if goal is None else goal) if goal is not None or len(goals) else ()
        aim = aims if isinstance(aims, Pose) else aims[0] if len(aims) == 1 else None
        aim = aim if isinstance(aim, Pose) else None
        shapes, given = list[AnyShape](), list[str | None]()
        with collection_paused():
            plain = _core.Polygon.of_each(items)  # lists of points, all at once
            for k, (item, its_name, core) in enumerate(zip(items, names, plain, strict=True)):
                place = f"obstacle {k}" + (f" ({its_name})" if its_name else "")
                parts = [polygon_of(core)] if core else _shapes(item, place)
                shapes += parts
                given += [its_name] * len(parts)
        values = {
            "robot": tuple(robot_parts),
            "obstacles": tuple(shapes),
            "obstacle_names": tuple(its_name or default_name(k) for k, its_name in enumerate(given)),
            "bounds": None if bounds is None else _rectangle(bounds),
            "workspace": None if workspace is None else _one(workspace),
            "start": None if start is None else to_pose(start, "start"),
            "goal": aim,
            "goals": aims if aim is None else (),
            "vehicle": vehicle,
            "units": units,
            "name": name,
            "note": note,
            "source": dict(source or {}),
            "check": dict(check or {}),
            "version": version,
            "reading": in_order(reading),
        }
        shown = (*robot_parts, *shapes, values["workspace"])
        values["curved"] = any(isinstance(shape, Curved) for shape in shown)
        for key, value in values.items():
            object.__setattr__(self, key, value)
        if not self.curved:
            _refuse_far(self)

    def __repr__(self) -> str:
        title = f"{self.name!r}, " if self.name else ""
        parts, count = len(self.robot), len(self.obstacles)
        robot = f"{parts} {'shapes' if self.curved else 'polygons'}, " if parts > 1 else ""
        obstacles = counted(count, "obstacle") + (f": {_edges(self.obstacles)}" if count else "")
        lost = losses(self.reading)
        worst = f"; {lost[0].label}: {lost[0].things}" if lost else ""
        return f"Scene({title}robot: {robot}{_edges(self.robot)}; {obstacles}{worst})"

    @classmethod
    @checked
    def from_grid(
        cls,
        robot: Any,
        array: Any,
        resolution: Number,
        origin: Sequence[Number] | Pose = (0, 0, 0),
        occupied: int = 65,
        unknown: Literal["obstacle", "free"] = "obstacle",
        rows: Literal["up", "down"] = "up",
    ) -> Scene:
        """Return the scene of a robot among the occupied cells of a grid.

        Parameters
        ----------
        robot : shape or sequence of shapes
        array : (rows, columns) array of int or bool
            Occupancies from 0, free, to 100, occupied, such as the data of a ROS OccupancyGrid, reshaped to
            (height, width). All values outside of 0 to 100 and masked ones are unknown. True is occupied.
        resolution : number
            Side of a cell.
        origin : (x, y, yaw) or Pose
            Pose of the lower left corner of the grid.
        occupied : int
            Cells from this value up are obstacles; all from 0 up that are below are free.
        unknown : "obstacle" or "free"
            Meaning of unknown cells. If they are obstacles, the edge of the grid is the workspace.
        rows : "up" or "down"
            Direction in which the rows follow each other: upwards in an OccupancyGrid, downwards in an image.

        Raises
        ------
        ValueError
            If the array has not two dimensions, or all its numbers are from 0 to 1, unless `occupied` is 1.

        Examples
        --------
        >>> grid = [[0, 0, 100], [0, -1, 100]]
        >>> scene = Scene.from_grid([(0, 0), (1, 0), (0, 1)], grid, "0.05", unknown="free")
        >>> [polygon.bounds for polygon in scene.obstacles]
        [(0.1, 0.0, 0.15, 0.1)]
        """
        scene: Scene = registered("scene_from_grid")(robot, array, resolution, origin, occupied, unknown, rows)
        return scene

    def plot(self) -> Any:
        """Draw obstacles, bounds, workspace, start and goal with `cfree.plot.picture`; return the matplotlib figure."""
        return registered("figure")(self)

    @checked
    def outer(self, error: float) -> Scene:
        """Return a scene of polygons in which every pose that is forbidden here is forbidden.

        A path in it is also a path here. Robot and obstacles grow, the workspace shrinks.

        Parameters
        ----------
        error : float
            Greatest distance of a polygon's boundary from the boundary of its round shape. If doubles cannot reach it,
            the least error that they can reach is used.

        Raises
        ------
        UndecidedError
            If no polygon can be proved to be inside the workspace: it is too thin for doubles, or has cusps.
        """
        return with_polygons(self, [error] * len(shapes_of(self)), outward=True)

    @checked
    def inner(self, error: float) -> Scene:
        """Return a scene of polygons in which every pose that is free here is free.

        If no path exists in it, none exists here. Robot and obstacles shrink, the workspace grows. Parameters and
        errors are those of `outer`, but here the robot may be the shape without a polygon inside.
        """
        return with_polygons(self, [error] * len(shapes_of(self)), outward=False)

    @checked
    def grown(self, by: Number) -> Scene:
        """Return the scene with the robot grown by a distance: its Minkowski sum with a disc of that radius.

        Raises
        ------
        UnsupportedError
            If it has curves other than circles.

        Examples
        --------
        >>> Scene([(0, 0), (1, 0), (0, 1)]).grown("1/2").robot
        (<Curved in (-0.5, -0.5, 1.5, 1.5), 0 holes>,)
        """
        return with_shapes(self, [_grown(shape, to_fraction(by)) for shape in self.robot])

    @checked
    def moved(self, obstacle: int | str, pose: PoseLike) -> Scene:
        """Return the scene with one obstacle moved from its place by a rigid motion, exactly.

        Parameters
        ----------
        obstacle : int or str
            Its index or name.
        pose : Pose or (x, y, theta)
            The motion: the obstacle is turned about the origin by theta, then shifted by x and y.

        Raises
        ------
        IndexError, ValueError
            If no obstacle has this index or name, or several have the name.
        InvalidPoseError
            If `pose` is no pose.
        UnsupportedError
            If the obstacle leaves the range of coordinates.

        Notes
        -----
        Everything else stays, but for `check`: its facts were those of another scene.

        Examples
        --------
        >>> scene = Scene([(0, 0), (1, 0), (0, 1)], [[(3, 0), (4, 0), (4, 2)]], obstacle_names=["desk"])
        >>> scene.moved("desk", ("1/2", 0, 0)).obstacles[0].bounds
        (3.5, 0.0, 4.5, 2.0)
        >>> scene.moved(0, (0, 0, "90deg")).moved(0, (0, 0, "-90deg")) == scene
        True
        """
        k = obstacle_index(self, obstacle)
        shapes = list[AnyShape](self.obstacles)
        shapes[k] = moved_shape(shapes[k], to_pose(pose))
        return _with_obstacle_list(self, shapes, self.obstacle_names)

    @checked
    def with_obstacle(self, obstacle: Any, name: str | None = None) -> Scene:
        """Return the scene with one more obstacle, after the others.

        Parameters
        ----------
        obstacle : shape
            All polygons of a multipolygon get the name.
        name : str, optional

        Raises
        ------
        InvalidPolygonError
            If it is no shape.
        UnsupportedError
            If it leaves the range of coordinates.

        Examples
        --------
        >>> scene = Scene([(0, 0), (1, 0), (0, 1)], [[(3, 0), (4, 0), (4, 2)]])
        >>> scene.with_obstacle([(5, 5), (6, 5), (6, 6)], "desk").obstacle_names
        ('obstacle 0', 'desk')
        """
        added = _shapes(obstacle, "obstacle" + (f" ({name})" if name else ""))
        count = len(self.obstacles)
        names = [name or default_name(count + k) for k in range(len(added))]
        return _with_obstacle_list(self, [*self.obstacles, *added], [*self.obstacle_names, *names])

    @checked
    def without_obstacle(self, obstacle: int | str) -> Scene:
        """Return the scene without one of its obstacles, given by index or name.

        Obstacles after it have an index less by one; so have those of them that are named by their index.

        Raises
        ------
        IndexError, ValueError
            If no obstacle has this index or name, or several have the name.

        Examples
        --------
        >>> wall, desk = [(3, 0), (4, 0), (4, 2)], [(5, 5), (6, 5), (6, 6)]
        >>> scene = Scene([(0, 0), (1, 0), (0, 1)], [wall, desk])
        >>> scene.without_obstacle(0) == Scene(scene.robot, [desk])
        True
        """
        gone = obstacle_index(self, obstacle)
        shapes, names = list(self.obstacles), list[str]()
        del shapes[gone]
        for k, name in enumerate(self.obstacle_names):
            if k != gone:
                names.append(default_name(len(names)) if name == default_name(k) else name)
        return _with_obstacle_list(self, shapes, names)


def obstacle_index(scene: Scene, obstacle: int | str) -> int:
    """Return the index of an obstacle that is given by its index or name.

    Raises
    ------
    IndexError, ValueError
        As from `Scene.moved`.

    Examples
    --------
    >>> scene = Scene([(0, 0), (1, 0), (0, 1)], [[(3, 0), (4, 0), (4, 2)]], obstacle_names=["desk"])
    >>> obstacle_index(scene, 0), obstacle_index(scene, "desk")
    (0, 0)
    >>> obstacle_index(scene, "disk")
    Traceback (most recent call last):
        ...
    ValueError: obstacle: 'disk' is the name of none; did you mean 'desk'?
    """
    names = scene.obstacle_names
    if not isinstance(obstacle, str):
        if 0 <= obstacle < len(names):
            return int(obstacle)
        numbers = f"an index from 0 to {len(names) - 1}, or a name" if names else "with_obstacle adds some"
        raise IndexError(f"obstacle: {obstacle}, and the scene has {counted(len(names), 'obstacle')}; {numbers}")
    places = [k for k, name in enumerate(names) if name == obstacle]
    if len(places) > 1:
        numbers = listed(list(map(str, places)), ", ")
        raise ValueError(f"obstacle: {obstacle!r} is the name of obstacles {numbers}; give an index")
    if not places:
        from difflib import get_close_matches

        similar = get_close_matches(obstacle, names, 1)
        remedy = f"did you mean {similar[0]!r}?" if similar else "give an index, or a name of obstacle_names"
        raise ValueError(f"obstacle: {obstacle!r} is the name of none; {remedy}")
    return places[0]


def _with_obstacle_list(scene: Scene, obstacles: Sequence[AnyShape], names: Sequence[str]) -> Scene:
    """Return the scene with other obstacles; of its values only `check` does not stay."""
    other = copy(scene)
    values: dict[str, Any] = {"obstacles": tuple(obstacles), "obstacle_names": tuple(names), "check": {}}
    for key, value in values.items():
        object.__setattr__(other, key, value)
    return _examined(other)


def grown_scene(scene: Scene, by: Fraction) -> Scene:
    """Return the scene with its robot grown by a disc, whatever its curves; for planners."""
    robot = [part._grown_by(by) if isinstance(part, Curved) else _grown(part, by) for part in scene.robot]
    return with_shapes(scene, robot)


def with_shapes(scene: Scene, robot: Sequence[AnyShape]) -> Scene:
    """Return the scene with another robot, some of whose shapes may be round."""
    other = copy(scene)
    object.__setattr__(other, "robot", tuple(robot))
    return _examined(other)


def _examined(scene: Scene) -> Scene:
    """Return a new scene whose shapes have changed, unless a coordinate is out of range."""
    object.__setattr__(scene, "curved", any(isinstance(shape, Curved) for shape in shapes_of(scene)))
    if not scene.curved:
        _refuse_far(scene)
    return scene


def shapes_of(scene: Scene) -> tuple[AnyShape, ...]:
    """Return the shapes of the robot, the obstacles, and the workspace, if there is one; round or not."""
    return *scene.robot, *scene.obstacles, *([scene.workspace] if scene.workspace else [])


def round_count(shapes: Iterable[AnyShape]) -> int:
    """Count the round shapes."""
    return sum(isinstance(shape, Curved) for shape in shapes)


def largest_of(scene: Scene) -> float:
    """Return the longer side of the largest box around a shape."""
    return max(map(size_of, shapes_of(scene)))


def with_polygons(scene: Scene, errors: Sequence[float | None], *, outward: bool, always: bool = False) -> Scene:
    """Replace round shapes by polygons, with an error for each in the order of `shapes_of`; outward forbids more.

    A shape without an error stays as it is.
    With `always`, a shape that has no polygons on that side gets those on the other one: such a scene proves nothing.
    """
    if not scene.curved:
        return scene
    error_of = iter(errors)

    def replaced(shape: AnyShape) -> tuple[AnyShape, ...]:
        error = next(error_of)
        if error is None:
            return (shape,)
        polygons = polygons_for(shape, error, outward)
        return polygons or (polygons_for(shape, error, not outward) if always else ())

    robot = [polygon for shape in scene.robot for polygon in replaced(shape)]
    named = list[tuple[str, AnyShape]]()
    for k, (name, shape) in enumerate(zip(scene.obstacle_names, scene.obstacles, strict=True)):
        for polygon in replaced(shape):
            # a polygon whose number has changed keeps the number of its shape as a name
            is_moved = name != default_name(k) and len(named) != k
            named.append((f"{default_name(k)} ({name})" if is_moved else name, polygon))
    room = scene.workspace
    room_error = next(error_of, None)
    rooms = (room,) if room is None or room_error is None else polygons_for(room, room_error, not outward)
    if not robot or (room and not rooms):
        raise UndecidedError(
            f"no polygon inside the {'workspace' if robot else 'robot'} can be proved: it is too thin, or has cusps",
            error=max(filter(None, errors)),
        )
    settings = {key: getattr(scene, key) for key in ("bounds", "start", "vehicle", "units", "name", "reading")}
    return Scene(
        robot,
        [polygon for _, polygon in named],
        obstacle_names=[name for name, _ in named],
        workspace=rooms[0] if rooms else None,
        goals=[scene.goal] if scene.goal else scene.goals,
        **settings,
    )


def polygons_for(shape: AnyShape, error: float, outward: bool) -> tuple[Polygon, ...]:
    """Return polygons around a shape, or inside it."""
    if isinstance(shape, Polygon):
        return (shape,)
    error = max(error, shape.least_error)
    return shape.outer(error) if outward else shape.inner(error)


def _refuse_far(scene: Scene) -> None:
    """Raise `UnsupportedError` if a coordinate is out of range."""
    if fault := range_fault(scene.robot, scene.obstacles, scene.workspace, scene.bounds):
        (kind, *index), message = fault
        place = scene.obstacle_names[int(index[0])] if kind == "obstacles" else f"{kind}{index or ''}"
        raise UnsupportedError(f"{place}: {message}")


def _grown(shape: AnyShape, by: Fraction) -> Curved:
    if isinstance(shape, Polygon):
        outer, *holes = shape.exact_rings
        return Curved(outer, holes, grown=by)
    if shape.grown:
        return Curved(shape.path, shape.holes, grown=shape.grown + by)
    if isinstance(shape.path, Circle) and not shape.holes:
        return Curved.circle(shape.path.center, shape.path.radius + by)
    raise UnsupportedError("grown: of polygons and circles only; give scene.outer(error) first")


def _edges(shapes: Sequence[AnyShape]) -> str:
    """Write the number of vertices, and of round shapes."""
    count = sum(len(shape) for shape in shapes if isinstance(shape, Polygon))
    curved = round_count(shapes)
    texts = [counted(count, "vertex")] if count or not curved else []
    return ", ".join([*texts, *([f"{curved} round"] if curved else [])])


def size_of(shape: AnyShape) -> float:
    """Return the longer side of the box around a shape."""
    x0, y0, x1, y1 = box_of(shape)
    return float(max(x1 - x0, y1 - y0))


def box_of(shape: AnyShape) -> tuple[float, float, float, float]:
    """Return the box around a shape: xmin, ymin, xmax, ymax."""
    x0, y0, x1, y1 = shape.box if isinstance(shape, Curved) else shape.bounds
    return float(x0), float(y0), float(x1), float(y1)


def robot_radius(scene: Scene) -> float:
    """Return the distance of the robot's farthest vertex from its reference point; of a round one, a little more."""
    return max(map(_radius, scene.robot))


@lru_cache
def _radius(part: AnyShape) -> float:
    return max(math.hypot(x, y) for polygon in polygons_around(part) for x, y in polygon.doubles)


def polygons_around(part: AnyShape) -> Sequence[Polygon]:
    """Return polygons whose outer rings are around a shape, with few sides if it is round; holes may be left out."""
    if isinstance(part, Polygon):
        return [part]
    if part.holes and not part.grown:
        part = Curved(part.path)
    return polygons_for(part, size_of(part) / SIDES_OF_ROUND, True)


def with_robot(scene: Scene, robot: Sequence[Polygon], bounds: Bounds | None) -> Scene:
    """Return a scene of polygons with another robot and other bounds, without start, goal and texts.

    Raises
    ------
    UnsupportedError
        As from `Scene`.

    Examples
    --------
    >>> scene = Scene([(0, 0), (1, 0), (0, 1)], [[(5, 5), (6, 5), (6, 6)]], start=(0, 0, 0), name="a wall")
    >>> with_robot(scene, scene.robot, None) == Scene(scene.robot, scene.obstacles)
    True
    """
    other = copy(scene)
    values: dict[str, Any] = {"robot": tuple(robot), "bounds": bounds, "start": None, "goal": None, "goals": ()}
    values |= {"units": "", "name": "", "note": "", "source": {}, "check": {}, "version": 1}
    for key, value in values.items():
        object.__setattr__(other, key, value)
    _refuse_far(other)
    return other


def with_bounds(scene: Scene, box: Sequence[float]) -> Scene:
    """Return the scene with bounds that are the common part of its own and a box of doubles, which is not empty.

    Examples
    --------
    >>> scene = with_bounds(Scene([(0, 0), (1, 0), (0, 1)], bounds=(0, 0, 9, 9)), (-1, 2, 5, 20))
    >>> tuple(map(str, scene.bounds))
    ('0', '2', '5', '9')
    """
    other = copy(scene)
    x0, y0, x1, y1 = map(Fraction, box)
    if (own := scene.bounds) is not None:
        x0, y0, x1, y1 = max(x0, own[0]), max(y0, own[1]), min(x1, own[2]), min(y1, own[3])
    object.__setattr__(other, "bounds", (x0, y0, x1, y1))
    return other


def with_ends(scene: Scene, start: Pose | None, goal: Pose | None) -> Scene:
    """Return the scene with another start and goal; None keeps its own.

    Examples
    --------
    >>> scene = Scene([(0, 0), (1, 0), (0, 1)], start=(0, 0, 0), goals=[(1, 1), (2, 2)])
    >>> with_ends(scene, None, Pose(5, 5)).goal == Pose(5, 5), with_ends(scene, None, None) == scene
    (True, True)
    """
    other = copy(scene)
    if start is not None:
        object.__setattr__(other, "start", start)
    if goal is not None:
        object.__setattr__(other, "goal", goal)
        object.__setattr__(other, "goals", ())
    return other


def with_vehicle(scene: Scene, vehicle: Vehicle | None) -> Scene:
    """Return the scene with another vehicle; None is a robot that moves in any direction.

    Examples
    --------
    >>> from cfree import Car
    >>> scene = Scene([(0, 0), (1, 0), (0, 1)])
    >>> with_vehicle(scene, Car(4)).vehicle
    Car(4, axle=(0, 0))
    """
    other = copy(scene)
    object.__setattr__(other, "vehicle", vehicle)
    return other


def vehicle_for(scene: Scene, vehicle: Vehicle | Literal["any"] | None) -> Vehicle | None:
    """Return the vehicle of a query: the scene's, unless another is given; "any" is none."""
    return scene.vehicle if vehicle is None else None if vehicle == "any" else vehicle


def default_name(index: int) -> str:
    """Return the name of an obstacle that has none.

    Examples
    --------
    >>> default_name(3)
    'obstacle 3'
    """
    return f"obstacle {index}"


def _items(value: Any, name: str) -> list[Any]:
    """Return the shapes of an argument that is one shape or several."""
    if isinstance(value, Polygon | Curved) or hasattr(value, "geom_type") or _is_ring(value):
        return [value]
    if not isinstance(value, Iterable) or isinstance(value, (str, bytes, Mapping)):
        kind = type(value).__name__
        raise InvalidPolygonError(f"{name}: {kind} is no shape; give points, a Polygon, or a shapely geometry")
    return list(value)


def _is_ring(value: Any) -> bool:
    """True if a value is a ring of points, not several rings."""
    if is_array(value):
        return value.ndim == 2
    return (
        isinstance(value, Sequence)
        and len(value) > 0
        and (isinstance(value[0], Sequence) or is_array(value[0]))
        and not isinstance(value[0], str)
        and all(is_single(coordinate) for coordinate in value[0])
        and len(value[0]) > 0
    )


def _shapes(item: Any, place: str) -> list[AnyShape]:
    """Return the polygons of one shape, or the round shape; `place` begins the message if it is neither."""
    if isinstance(item, Polygon | Curved):
        return [item]
    try:
        if hasattr(item, "geom_type"):
            return [*_from_geometry(item)]
        return [Polygon(item)]
    except InvalidPolygonError as error:
        message = f"{place}: {explained(error)}"
        raise InvalidPolygonError(message, ring=error.ring, edges=error.edges) from None


def _from_geometry(geometry: Any) -> list[Polygon]:
    if hasattr(geometry, "geoms"):
        return [polygon for part in geometry.geoms for polygon in _from_geometry(part)]
    if geometry.geom_type != "Polygon":
        raise InvalidPolygonError(flat_shape(geometry.geom_type))
    return [Polygon.from_shapely(geometry)]


NO_INTERIOR = "shapes are closures of their interiors: a segment or a point forbids nothing"


def flat_shape(kind: str) -> str:
    """Return the reason why a kind of geometry is refused.

    Examples
    --------
    >>> flat_shape("Point")
    'Point: shapes are closures of their interiors: a segment or a point forbids nothing; give it width'
    """
    return f"{kind}: {NO_INTERIOR}; give it width"


def explained(error: InvalidPolygonError) -> str:
    """Return the message of an error, with the reason if the points make only a segment or a point."""
    message = str(error)
    few = "at least 3" in message and not message.startswith("outer ring: 0")
    return f"{message}: {NO_INTERIOR}" if error.ring == 0 and (few or "on one line" in message) else message


def shapes_in(value: Any, name: str) -> list[AnyShape]:
    """Return the polygons and round shapes of one shape, or of several."""
    return [shape for item in _items(value, name) for shape in _shapes(item, name)]


def _one(value: Any) -> AnyShape:
    shapes = shapes_in(value, "workspace")
    if len(shapes) != 1:
        raise InvalidPolygonError(f"workspace: {len(shapes)} polygons; give one, whose holes are forbidden")
    if isinstance(shapes[0], Curved) and shapes[0].grown:
        raise UnsupportedError("workspace: a grown shape; give the ring of its lines and arcs")
    return shapes[0]


def _rectangle(bounds: Sequence[Number]) -> Bounds:
    values = tuple(bounds)
    if len(values) != 4:
        raise ValueError(
            f"bounds: {reprlib.repr(bounds)} has {counted(len(values), 'number')}; give xmin, ymin, xmax, ymax"
        )
    try:
        xmin, ymin, xmax, ymax = map(to_fraction, values)
    except ValueError as error:
        raise ValueError(f"bounds: {error}") from None
    if xmin >= xmax or ymin >= ymax:
        raise ValueError(f"bounds {tuple(bounds)} are empty; give xmin < xmax and ymin < ymax")
    return xmin, ymin, xmax, ymax


def with_obstacles(scene: Scene, obstacles: Sequence[AnyShape], names: Sequence[str] | None = None) -> Scene:
    """Return the scene with these obstacles, and no others."""
    return Scene(
        scene.robot,
        obstacles,
        obstacle_names=names,
        bounds=scene.bounds,
        workspace=scene.workspace,
        start=scene.start,
        goal=scene.goal,
        goals=scene.goals,
        vehicle=scene.vehicle,
        units=scene.units,
        name=scene.name,
        reading=scene.reading,
    )


def with_reading(scene: Scene, notes: Sequence[Note]) -> Scene:
    """Return the scene with another record of reading."""
    other = copy(scene)
    object.__setattr__(other, "reading", in_order(notes))
    return other


def required(scene: Scene, start: PoseLike | None, goal: PoseLike | None) -> tuple[Pose, Pose]:
    """Return start and goal; those of the scene replace None.

    Raises
    ------
    InvalidPoseError
        If there is neither.
    """
    ends = []
    for name, end in (("start", start), ("goal", goal)):
        pose = getattr(scene, name) if end is None else end
        if pose is None:
            has = "several, or a place" if name == "goal" and scene.goals else "none"
            raise InvalidPoseError(f"no {name}: the scene has {has}, and none was given; give x, y and theta")
        ends.append(to_pose(pose, name))
    return ends[0], ends[1]
