"""`smallest_aisle`: the least width of an aisle in which a machine does a manoeuvre, with a proof on both sides.

The aisle's legs are cut off where the machine is wholly inside of one: a motion that goes farther along a leg can stay
at its end instead, so legs without end change nothing. docs/theory/separations.md has the proof.
"""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise
from typing import Any, Literal

from cfree.analysis.among_rounds import Progress
from cfree.analysis.margins import Interval, bisected, bracket, check_tolerance
from cfree.analysis.reach_map import refuse_forward_only
from cfree.arguments import checked
from cfree.exact.half_angle import Angle
from cfree.exact.number import ExactPoint, Number, to_fraction
from cfree.exact.pose import Pose
from cfree.forbidden.boundary import boundary
from cfree.free.space import free_space
from cfree.polygons.hull import convex_hull
from cfree.scene.scene import Scene, polygons_for, robot_radius, size_of
from cfree.vehicles.vehicle import Vehicle

Kind = Literal["straight", "turn", "corner", "junction", "bay", "door"]
KINDS_WITHOUT_WIDTH: tuple[Kind, ...] = ("straight", "turn", "corner", "junction")
Extent = tuple[Fraction, Fraction, Fraction, Fraction]
Room = tuple[list[ExactPoint], Pose, Pose]
QUARTER, HALF = Pose(0, 0, "90deg"), Pose(0, 0, "180deg")
ROUND = 2.0**-12  # error of polygons for the width of round shapes, in sizes


@checked
def smallest_aisle(
    robot: Any,
    kind: Kind = "corner",
    *,
    opening: Number | None = None,
    aisle: Number | None = None,
    vehicle: Vehicle | None = None,
    heading: Angle = 0,
    tolerance: float = 0.01,
    progress: Progress | None = None,
) -> Interval:
    """Find the least width of an aisle in which a machine does a manoeuvre.

    Parameters
    ----------
    robot : shape or sequence of shapes, or a Scene
        The machine, with its load; of a scene its robot, and its vehicle unless another is given.
    kind : "straight", "turn", "corner", "junction", "bay" or "door"
        "straight": go along an aisle. "turn": turn by half a turn in it. "corner": go around a right-angled corner of
        two aisles of that width. "junction": turn off into a second aisle of that width at a right angle, where the
        first one goes on. "bay": turn from the aisle into an opening of given width at a right angle, such as a rack's
        bay or a door. "door": the least width of such an opening at an aisle of given width. The machine goes with its
        front ahead before and after.
    opening : number, optional
        Width of the opening, for "bay".
    aisle : number, optional
        Width of the aisle, for "door".
    vehicle : Car or DifferentialDrive, optional
        Gives the heading. A machine that drives straight on goes along a straight aisle with its front ahead; one
        without a vehicle goes as narrow as it can. See Notes for the others.
    heading : angle
        The machine's front in its own frame, counter-clockwise from its x axis, unless it is a vehicle.
    tolerance : float
        Greatest width of the interval, relative to its ends.
    progress : callable, optional
        Called with the completed share, from 0 to 1.

    Returns
    -------
    Interval
        In an aisle `hi` wide there is a motion that keeps a distance, in one `lo` wide there is none.

    Raises
    ------
    ValueError
        If the opening or the aisle is missing, or as narrow as the machine; or the tolerance is not positive.
    UnsupportedError
        If the vehicle has no reverse gear, or the machine has curves other than circles and grown polygons.

    Notes
    -----
    A car with both gears and a differential drive get wherever a robot does that may move sideways, with as many
    manoeuvres as that takes. So the interval holds for them, whatever the turning radius: below `lo` no driver gets
    through. `turning_circle` tells how wide an aisle must be to turn without manoeuvres.

    Examples
    --------
    >>> bed = [(-1, "-0.45"), (1, "-0.45"), (1, "0.45"), (-1, "0.45")]
    >>> smallest_aisle(bed, "straight")
    Interval(lo=0.8999999999999998, hi=0.9000000000000001)
    >>> corner = smallest_aisle(bed, "corner")
    >>> corner.lo < (1 + 0.9) / 2**0.5 < corner.hi          # half its length and its width, at 45 degrees
    True
    >>> half = smallest_aisle(bed, "turn")
    >>> half.lo < (2**2 + 0.9**2) ** 0.5 < half.hi         # its diagonal
    True
    """
    scene = robot if isinstance(robot, Scene) else Scene(robot)
    vehicle = scene.vehicle if vehicle is None else vehicle
    refuse_forward_only(vehicle)
    check_tolerance(tolerance)
    front = Pose(0, 0, heading) if vehicle is None else Pose(0, 0, {"tau": vehicle.heading})
    ahead = front.inverse()
    known = _known(scene, kind, opening, aisle, ahead)
    if kind == "straight":
        return _straight(scene, None if vehicle is None else ahead)
    far = to_fraction(robot_radius(scene)) * (1 + Fraction(1, 2**20))
    extents = [_extent(scene, turn @ ahead) for turn in (Pose(0, 0), QUARTER)]

    def is_too_narrow(width: Fraction) -> bool:
        room, start, goal = _room(kind, width, known, far, ahead, extents)
        space = free_space(boundary(Scene(scene.robot, workspace=room), max_seconds=math.inf))
        return space.common_cell(start, goal) is None

    lo, hi = bracket(is_too_narrow, far)
    if not lo or not hi:
        raise ValueError(f"kind: no width of a {kind} is between too narrow and wide enough")
    lo, hi = bisected(is_too_narrow, lo, hi, tolerance, progress)
    return Interval(float(lo), float(hi))


def _known(scene: Scene, kind: Kind, opening: Number | None, aisle: Number | None, ahead: Pose) -> Fraction:
    """Return the width that is given, for the two kinds that need one; 0 for the others."""
    name, value, least = "", None, Fraction(0)
    if kind == "bay":
        name, value, (x0, _, x1, _) = "opening", opening, _extent(scene, QUARTER @ ahead)
        least = x1 - x0
    elif kind == "door":
        name, value, (_, y0, _, y1) = "aisle", aisle, _extent(scene, ahead)
        least = y1 - y0
    for other, size in (("opening", opening), ("aisle", aisle)):
        if size is not None and other != name:
            raise ValueError(f'{other}: not for kind "{kind}"; leave it out')
    if not name:
        return least
    if value is None:
        raise ValueError(f'{name}: missing; kind "{kind}" needs the width of the {name}')
    known = to_fraction(value)
    if known <= least:
        raise ValueError(f"{name}: {float(known):g}, and the machine is {float(least):g} wide; give a larger one")
    return known


def _room(kind: Kind, width: Fraction, known: Fraction, far: Fraction, ahead: Pose, extents: list[Extent]) -> Room:
    """Return the floor of a manoeuvre, its start and its goal. Wider aisles hold the floors of narrower ones.

    Notes
    -----
    The first aisle is below y = 0, along x; the second one goes up. Start and goal touch walls that stay in place.
    """
    (_, bottom, _, top), (left, _, right, _) = extents
    long, w, zero = 3 * far, width, Fraction(0)
    start = Pose(-far * Fraction(3, 2), -top) @ ahead
    if kind == "turn":
        floor = [(-long, -w), (long, -w), (long, zero), (-long, zero)]
        return floor, Pose(0, -top) @ ahead, Pose(0, bottom) @ HALF @ ahead
    goal = Pose(-left, far * Fraction(3, 2)) @ QUARTER @ ahead
    if kind == "corner":
        return [(-long, -w), (w, -w), (w, long), (zero, long), (zero, zero), (-long, zero)], start, goal
    depth, gap = (w, w) if kind == "junction" else (w, known) if kind == "bay" else (known, w)
    if kind == "bay":
        goal = Pose(gap / 2 - (left + right) / 2, far * Fraction(3, 2)) @ QUARTER @ ahead
    floor = [(-long, -depth), (gap + long, -depth), (gap + long, zero), (gap, zero), (gap, long), (zero, long)]
    return [*floor, (zero, zero), (-long, zero)], start, goal


def _extent(scene: Scene, pose: Pose) -> Extent:
    """Return the box around the robot in a pose: xmin, ymin, xmax, ymax; of round shapes, one a little larger."""
    points = [
        point
        for part in scene.robot
        for polygon in polygons_for(part, size_of(part) * ROUND, True)
        for point in pose.apply_exact(polygon.exact_vertices)
    ]
    (x0, x1), (y0, y1) = ((min(axis), max(axis)) for axis in zip(*points, strict=True))
    return x0, y0, x1, y1


def _straight(scene: Scene, ahead: Pose | None) -> Interval:
    """Return the width across a heading, or the least width across any."""
    bounds = []
    for outward in (False, True):
        polygons = [p for part in scene.robot for p in polygons_for(part, size_of(part) * ROUND, outward)]
        points = [point for polygon in polygons for point in polygon.exact_vertices]
        if ahead is None:
            bounds.append(math.sqrt(float(_least_width(points))))
        else:
            heights = [y for _, y in ahead.apply_exact(points)]
            bounds.append(float(max(heights) - min(heights)))
    lo, hi = bounds
    return Interval(lo * (1 - 2.0**-52), math.nextafter(hi * (1 + 2.0**-53), math.inf))


def least_width(scene: Scene) -> float:
    """Return the least width of a scene's robot across any direction."""
    return _straight(scene, None).hi


def _least_width(points: list[ExactPoint]) -> Fraction:
    """Return the square of the least width of a convex hull: it is across one of the hull's edges."""
    hull = convex_hull(points)
    widths = []
    for (x, y), (u, v) in pairwise([*hull, hull[0]]):
        dx, dy = u - x, v - y
        most = max(dx * (q - y) - dy * (p - x) for p, q in hull)
        widths.append(most * most / (dx * dx + dy * dy))
    return min(widths)
