"""Motions in contact: along a slice, around an obstacle while turning, over a patch.

Every pose is computed exactly on its contact surface (eqs. 5 and 8), in the trimmed part: so it touches and is free.
Among rounded shapes it is computed in doubles, and moved away from the contact by a billionth of the robot's radius: so
it is free.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cfree.contact.contact import EdgeVertex, VertexEdge
from cfree.contact.features import shape_features
from cfree.contact.surface import Surface
from cfree.exact.pose import Pose
from cfree.forbidden.kinds import PatchKind
from cfree.forbidden.patch import Contact, Patch, Place
from cfree.plot.strips import strips
from cfree.polygons.polygon import Polygon
from cfree.scene.features import WORKSPACE
from cfree.scene.scene import robot_radius

if TYPE_CHECKING:
    from cfree.forbidden.boundary import Boundary
    from cfree.scene.scene import AnyShape, Scene

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Point = tuple[float, float]

HELIX_CURVE = 3  # kind of a trapezoid's curve that is a v-v helix
INSIDE = 1e-6  # distance of t from its limits, so that rounding cannot leave them
AWAY = 1e-9  # radii of the robot by which a pose among rounded shapes is off its contact
NEAR, CHORDS = 1e-9, 64  # relative rounding of an arc's numbers, chords along it
AT_END = 1e-9  # difference of t from 0 or 1 on a curve that ends an edge


@dataclass(frozen=True, eq=False)
class Touch:
    """A contact of rounded shapes in the plane.

    Attributes
    ----------
    point : (2,) float64
    normal : (2,) float64
        The obstacle's outward unit normal there.
    robot, obstacle : (n, 2) float64
        The edge, or the arc, that touches; one point for a vertex.
    """

    point: Floats
    normal: Floats
    robot: Floats
    obstacle: Floats


@dataclass(frozen=True, slots=True)
class Moment:
    """An exact pose, and the contact shown in it: the content of one frame; among rounded shapes its place as well."""

    pose: Pose
    contact: Contact | None = None
    touch: Touch | None = None


@dataclass(frozen=True, slots=True)
class Column:
    """Trapezoids of one patch on top of each other, with the same limits where they meet.

    A trapezoid of an arc on an arc has many parts beside each other.

    Attributes
    ----------
    patch : int
    parts : tuple of int
        Parts as in `cfree.plot.strips.Strips`, from below.
    trapezoids : tuple of int
    angles : tuple of float, radians in [0, 2 pi]
        Angles at which the parts begin and the last one ends.
    side : 0, 1 or None
        The side (t = 0 or 1) that is a helix over its whole height, if there is one: of a vertex on a vertex, or of an
        arc's centre at the end of an edge or a quadrant.
    """

    patch: int
    parts: tuple[int, ...]
    trapezoids: tuple[int, ...]
    angles: tuple[float, ...]
    side: int | None


def shape_of(scene: Scene, place: Place) -> Polygon:
    """Return the obstacle, or the workspace, of a place."""
    shape = scene.workspace if place.polygon == WORKSPACE else scene.obstacles[place.polygon]
    assert shape is not None
    return shape


def surface_of(scene: Scene, patch: Patch) -> Surface:
    """Return the exact contact surface of a v-e or e-v patch."""
    i, j = patch.robot, patch.obstacle
    robot, obstacle = scene.robot[i.polygon].exact_vertices, shape_of(scene, j).exact_vertices
    zero = Fraction(0), Fraction(0)
    a, p = robot[i.index], obstacle[j.index]
    if patch.kind == "v-e":
        assert j.end is not None
        (x, y) = obstacle[j.end]
        return Surface(VertexEdge(i.index, j.index), p, (x - p[0], y - p[1]), a, zero)
    assert i.end is not None
    (x, y) = robot[i.end]
    return Surface(EdgeVertex(i.index, j.index), p, zero, a, (x - a[0], y - a[1]))


def corner_contact(patch: Patch, side: int) -> Contact:
    """Return the v-v contact at an end of a patch's edge: t = 0 or 1."""

    def corner(place: Place) -> Place:
        index = place.index if side == 0 or place.end is None else place.end
        return Place(place.polygon, place.name, place.ring, index)

    return Contact("v-v", corner(patch.robot), corner(patch.obstacle))


@dataclass(frozen=True, slots=True)
class Ring:
    """A closed curve of contacts with obstacles in a slice, measured by length, the forbidden side on its left.

    Attributes
    ----------
    theta : float, radians
    trapezoid : (k,) int32
        Trapezoids whose segments form the curve.
    ends : (k,) float64
        Length from the start to the end of each segment.
    offset : float
        Length on the first segment at which the ring begins.
    gap : float
        Distance from that place to the point given to `near`.
    """

    boundary: Boundary
    theta: float
    trapezoid: NDArray[np.int32]
    ends: Floats
    offset: float
    gap: float

    @classmethod
    def near(cls, boundary: Boundary, theta: float, point: Point) -> Ring | None:
        """Return the ring nearest to a point; None if there is none, or it is not closed, or has a bound."""
        cut = boundary.slice(theta)
        if not len(cut.segments):
            return None
        owner = np.repeat(np.arange(len(cut.lines)), [len(line) - 1 for line in cut.lines])
        start = np.concatenate([line[:-1] for line in cut.lines])
        step = np.concatenate([np.diff(line, axis=0) for line in cut.lines])
        chord = np.hypot(*step.T)
        share = ((point - start) * step).sum(axis=1) / np.where(chord > 0, chord, 1) ** 2
        share = np.clip(share, 0, 1)
        gaps = np.hypot(*(start + share[:, None] * step - point).T)
        nearest = int(gaps.argmin())
        first = int(owner[nearest])
        length = np.bincount(owner, chord, minlength=len(cut.lines))
        order = [first]
        while (after := _next(cut.segments, order[-1])) not in order:
            order.append(after)
        if after != first or (boundary.patch_kind[cut.patches[order]] == PatchKind.BOUND).any():
            return None
        before = np.flatnonzero(owner == first)
        offset = float(share[nearest] * chord[nearest] + chord[before[before < nearest]].sum())
        return cls(boundary, theta, cut.trapezoids[order], np.cumsum(length[order]), offset, float(gaps[nearest]))

    @property
    def perimeter(self) -> float:
        return float(self.ends[-1])

    def at(self, distance: float) -> tuple[int, float]:
        """Return trapezoid and t at this length from the beginning of the ring."""
        place = (distance + self.offset) % self.perimeter
        k = min(int(np.searchsorted(self.ends, place, side="right")), len(self.ends) - 1)
        start = self.ends[k - 1] if k else 0.0
        share = (place - start) / max(self.ends[k] - start, 1e-300)
        return int(self.trapezoid[k]), across(self.boundary, int(self.trapezoid[k]), self.theta, share)

    def moment(self, distance: float) -> Moment:
        trapezoid, t = self.at(distance)
        return touching(self.boundary, int(self.boundary.trapezoids.patch[trapezoid]), t, self.theta)

    def distance_to(self, point: Point) -> float:
        """Return the length along the ring to the place nearest to a point."""
        steps = np.linspace(0, self.perimeter, 2000, endpoint=False)
        places = [self.at(s) for s in steps]
        patch = self.boundary.trapezoids.patch[[trapezoid for trapezoid, _ in places]]
        xy = self.boundary.evaluate(patch, [t for _, t in places], self.theta)
        return float(steps[np.hypot(*(xy - point).T).argmin()])


def touching(boundary: Boundary, patch: int, t: float, theta: float) -> Moment:
    """Return the exact pose at t and theta on a patch, and its contact; among rounded shapes see `round_touching`."""
    record = boundary.patches[patch]
    if boundary.scene.curved:
        return round_touching(boundary, record, t, theta)
    pose = surface_of(boundary.scene, record).pose(t, theta)
    return Moment(pose, Contact(record.kind, record.robot, record.obstacle))


def round_touching(boundary: Boundary, patch: Patch, t: float, theta: float) -> Moment:
    """Return a pose at t and theta on a patch among rounded shapes, a little off it, and its contact.

    The centre of the robot's arc is at R a + r. From the obstacle's edge, or from the centre of its arc, the contact
    point is the obstacle's own radius away along the normal.
    """
    scene, k = boundary.scene, patch.index
    own, others = boundary.features.robot.radius, boundary.features.obstacles.radius
    rho, sigma = float(own[boundary.contact_robot[k]]), float(others[boundary.contact_obstacle[k]])
    px, py, qx, qy, ax, ay, gx, gy = boundary.ruled[k].tolist()
    (place,) = boundary.evaluate([k], [t], [theta])
    at, turn = Pose(float(place[0]), float(place[1]), theta), _turned(theta)
    part = scene.robot[patch.robot.polygon]
    if patch.kind == "v-e":
        along, centre = np.array([qx, qy]), at.apply((ax, ay))
        normal = _right_of(along)
        point = centre - rho * normal
        robot = at.apply(_arc(part, (ax, ay), rho, -normal @ turn))
        obstacle = np.array([point - t * along, point + (1 - t) * along])
    elif patch.kind == "e-v":
        along = turn @ (gx, gy)
        normal = -_right_of(along)
        point = np.array([px, py]) + sigma * normal
        robot = np.array([point - t * along, point + (1 - t) * along])
        obstacle = _arc_of_obstacle(scene, patch.obstacle, (px, py), sigma, normal)
    else:
        assert patch.quadrant is not None
        is_back = bool(boundary.patch_radius[k] < 0)
        psi = math.pi / 2 * (patch.quadrant + is_back) + (-2 if is_back else 2) * math.atan(t)
        normal = np.array([math.cos(psi), math.sin(psi)])
        point = np.array([px, py]) + sigma * normal
        robot = at.apply(_arc(part, (ax, ay), rho, -normal @ turn))
        obstacle = _arc_of_obstacle(scene, patch.obstacle, (px, py), sigma, normal)
    x, y = (place + AWAY * robot_radius(scene) * normal).tolist()
    return Moment(
        Pose(x, y, theta), Contact(patch.kind, patch.robot, patch.obstacle), Touch(point, normal, robot, obstacle)
    )


def _turned(theta: float) -> Floats:
    return np.array([[math.cos(theta), -math.sin(theta)], [math.sin(theta), math.cos(theta)]])


def _right_of(along: Floats) -> Floats:
    """Return the unit normal on the right of a direction."""
    normal: Floats = np.array([along[1], -along[0]]) / math.hypot(*along)
    return normal


def _arc_of_obstacle(scene: Scene, place: Place, centre: Point, radius: float, normal: Floats) -> Floats:
    if place.polygon == WORKSPACE:  # outside of it is forbidden
        assert scene.workspace is not None
        return _arc(scene.workspace, centre, -radius, -normal)
    return _arc(scene.obstacles[place.polygon], centre, radius, normal)


def _arc(shape: AnyShape, centre: Point, radius: float, normal: Floats) -> Floats:
    """Return points along the arc of a shape that has this centre, signed radius and normal; of a vertex only one."""
    near = NEAR * (abs(radius) + math.hypot(*centre) + 1.0)
    for arc in shape_features(shape).arcs:
        if abs(arc.signed_radius - radius) < near and math.dist(centre, map(float, arc.centre)) < near:
            psi = (math.atan2(normal[1], normal[0]) - arc.first + NEAR) % math.tau
            if psi <= arc.width + 2 * NEAR:
                return arc.points(CHORDS)
    return np.array([centre]) + radius * normal


def roll(boundary: Boundary, start: Point, angles: Sequence[float], distance: float) -> list[Moment] | None:
    """Move along the contacts while the robot turns; None if they come to an end.

    Parameters
    ----------
    boundary : Boundary
    start : (float, float)
        A point near the first position.
    angles : (n,) float, radians
        Orientations, close to each other.
    distance : float
        Total length of the slide, the forbidden side on the left.
    """
    here, moments = start, []
    reach = 3 * robot_radius(boundary.scene) * float(np.abs(np.diff(angles)).max(initial=0)) + 1e-3 * abs(distance)
    for k, theta in enumerate(angles):
        ring = Ring.near(boundary, theta, here)
        if ring is None or (k and ring.gap > reach):
            return None
        moment = ring.moment(distance / len(angles) if k else 0.0)
        moments.append(moment)
        here = float(moment.pose.x), float(moment.pose.y)
    return moments


def columns(boundary: Boundary) -> list[Column]:
    """Divide all patches, except for those at bounds, into columns, none of which crosses theta = 0."""
    rows, table = strips(boundary, math.inf), boundary.trapezoids
    if not len(rows.part):
        return []
    first = np.flatnonzero(np.diff(rows.part, prepend=-1))  # first row of each part
    last = np.append(first[1:], len(rows.part)) - 1
    # blocks: a trapezoid's parts beside each other
    begin = np.flatnonzero(rows.share[first, 0] == 0)
    end = np.append(begin[1:], len(first)) - 1
    low, high = rows.theta[first[begin]], rows.theta[last[begin]]
    bottom, top = (np.stack([rows.t[row[begin], 0], rows.t[row[end], 1]], axis=1) for row in (first, last))
    trapezoid = rows.trapezoid[first[begin]]
    patch = table.patch[trapezoid]
    order = np.lexsort((bottom[:, 0], low, patch))
    order = order[boundary.patch_kind[patch[order]] != PatchKind.BOUND]
    groups: list[list[int]] = []
    for block in order.tolist():
        below = groups[-1][-1] if groups else block
        joined = (
            patch[below] == patch[block]
            and abs(high[below] - low[block]) < 1e-9
            and bool(np.allclose(top[below], bottom[block], atol=1e-6))
        )
        if joined and groups:
            groups[-1].append(block)
        else:
            groups.append([block])
    ends = np.stack([bottom, top])
    result = []
    for blocks in groups:
        if boundary.scene.curved:
            helices = [bool((np.abs(ends[:, blocks, side] - side) < AT_END).all()) for side in (0, 1)]
        else:
            kinds = table.lower_kind, table.upper_kind
            helices = [bool((kind[trapezoid[blocks]] == HELIX_CURVE).all()) for kind in kinds]
        side = helices.index(True) if any(helices) else None
        parts = tuple(part for block in blocks for part in range(int(begin[block]), int(end[block]) + 1))
        angles = (*low[blocks].tolist(), float(high[blocks[-1]]))
        result.append(Column(int(patch[blocks[0]]), parts, tuple(trapezoid[blocks].tolist()), angles, side))
    return result


def over_column(boundary: Boundary, column: Column, shares: Any, angles: Any) -> list[Moment]:
    """Return poses on a column: at angles within it, and at shares (0 to 1) of its width there."""
    moments = []
    for share, theta in zip(shares, angles, strict=True):
        k = int(np.searchsorted(column.angles[1:-1], theta, side="right"))
        t = across(boundary, column.trapezoids[k], theta, share)
        moments.append(touching(boundary, column.patch, t, theta))
    return moments


def along_helix(boundary: Boundary, column: Column, angles: Any) -> list[Moment]:
    """Return poses on the helix at the side of a column."""
    assert column.side is not None
    if boundary.scene.curved:
        return over_column(boundary, column, [column.side] * len(angles), angles)
    patch = boundary.patches[column.patch]
    helix = surface_of(boundary.scene, patch).helix(column.side)
    contact = corner_contact(patch, column.side)
    return [Moment(helix.pose(float(theta)), contact) for theta in angles]


def outward(boundary: Boundary, patch: int, moment: Moment) -> Floats:
    """Return the unit vector of the plane from a patch to its free side, at one of its moments."""
    if moment.touch is not None:
        return moment.touch.normal
    theta = moment.pose.theta
    _, _, qx, qy, _, _, gx, gy = boundary.ruled[patch].tolist()
    c, s = math.cos(theta), math.sin(theta)
    x, y = qx - (c * gx - s * gy), qy - (s * gx + c * gy)  # S_t: the forbidden side is on its left
    return np.array([y, -x]) / math.hypot(x, y)


def across(boundary: Boundary, trapezoid: int, theta: float, share: float) -> float:
    """Return t at a share of the width of a trapezoid; of an arc on an arc evenly in the angle."""
    (lower,), (upper,) = boundary.limits([trapezoid], [theta])
    lower, upper, inside = max(float(lower), 0.0), min(float(upper), 1.0), INSIDE + (1 - 2 * INSIDE) * share
    if boundary.patch_kind[boundary.trapezoids.patch[trapezoid]] == PatchKind.ARC_ARC:
        low, high = math.atan(lower), math.atan(upper)
        return math.tan(low + (high - low) * inside)
    return lower + (upper - lower) * inside


def _next(segments: Floats, k: int) -> int:
    """Return the segment that begins at the end of another one."""
    return int(np.hypot(*(segments[:, 0] - segments[k, 1]).T).argmin())
