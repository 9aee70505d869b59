"""Motions in contact: along a slice, around an obstacle while turning, over a patch.

Every pose is computed exactly on its contact surface (eqs. 5 and 8), in the trimmed part: so it touches and is free.
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
    from cfree.scene.scene import Scene

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Point = tuple[float, float]

HELIX_CURVE = 3  # kind of a trapezoid's curve that is a v-v helix
INSIDE = 1e-6  # distance of t from its limits, so that rounding cannot leave them


@dataclass(frozen=True, slots=True)
class Moment:
    """An exact pose, and the contact shown in it: the content of one frame."""

    pose: Pose
    contact: Contact | None = None


@dataclass(frozen=True, slots=True)
class Column:
    """Trapezoids of one patch on top of each other, with the same limits where they meet.

    Attributes
    ----------
    patch : int
    parts : tuple of int
        Parts as in `cfree.plot.strips.Strips`, from below.
    trapezoids : tuple of int
    angles : tuple of float, radians in [0, 2 pi]
        Angles at which the parts begin and the last one ends.
    side : 0, 1 or None
        The side (t = 0 or 1) that is a v-v helix over its whole height, if there is one.
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
        start, step = cut.segments[:, 0], cut.segments[:, 1] - cut.segments[:, 0]
        if not len(start):
            return None
        length = np.hypot(*step.T)
        share = ((point - start) * step).sum(axis=1) / np.where(length > 0, length, 1) ** 2
        share = np.clip(share, 0, 1)
        gaps = np.hypot(*(start + share[:, None] * step - point).T)
        first = int(gaps.argmin())
        order = [first]
        while (after := _next(cut.segments, order[-1])) not in order:
            order.append(after)
        if after != first or (boundary.patch_kind[cut.patches[order]] == PatchKind.BOUND).any():
            return None
        offset = float(share[first] * length[first])
        return cls(boundary, theta, cut.trapezoids[order], np.cumsum(length[order]), offset, float(gaps[first]))

    @property
    def perimeter(self) -> float:
        return float(self.ends[-1])

    def at(self, distance: float) -> tuple[int, float]:
        """Return trapezoid and t at this length from the beginning of the ring."""
        place = (distance + self.offset) % self.perimeter
        k = min(int(np.searchsorted(self.ends, place, side="right")), len(self.ends) - 1)
        start = self.ends[k - 1] if k else 0.0
        share = (place - start) / max(self.ends[k] - start, 1e-300)
        lower, upper = self.boundary.limits([self.trapezoid[k]], [self.theta])
        return int(self.trapezoid[k]), _between(lower[0], upper[0], share)

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
    """Return the exact pose at t and theta on a patch, and its contact."""
    record = boundary.patches[patch]
    pose = surface_of(boundary.scene, record).pose(t, theta)
    return Moment(pose, Contact(record.kind, record.robot, record.obstacle))


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
    """Divide all v-e and e-v patches into columns, none of which crosses theta = 0."""
    rows, table = strips(boundary, math.inf), boundary.trapezoids
    first = np.flatnonzero(np.diff(rows.part, prepend=-1))
    last = np.append(first[1:], len(rows.part)) - 1
    patch = table.patch[rows.trapezoid[first]]
    order = np.lexsort((rows.t[first, 0], rows.theta[first], patch))
    order = order[boundary.patch_kind[patch[order]] != PatchKind.BOUND]
    groups: list[list[int]] = []
    for part in order.tolist():
        below = groups[-1][-1] if groups else part
        joined = (
            patch[below] == patch[part]
            and abs(rows.theta[last[below]] - rows.theta[first[part]]) < 1e-9
            and bool(np.allclose(rows.t[last[below]], rows.t[first[part]], atol=1e-6))
        )
        if joined and groups:
            groups[-1].append(part)
        else:
            groups.append([part])
    sides = table.lower_kind, table.upper_kind
    result = []
    for parts in groups:
        trapezoids = rows.trapezoid[first[parts]]
        side = next((k for k, kind in enumerate(sides) if (kind[trapezoids] == HELIX_CURVE).all()), None)
        angles = (*rows.theta[first[parts]].tolist(), float(rows.theta[last[parts[-1]]]))
        result.append(Column(int(patch[parts[0]]), tuple(parts), tuple(trapezoids.tolist()), angles, side))
    return result


def over_column(boundary: Boundary, column: Column, shares: Any, angles: Any) -> list[Moment]:
    """Return poses on a column: at angles within it, and at shares (0 to 1) of its width there."""
    moments = []
    for share, theta in zip(shares, angles, strict=True):
        k = int(np.searchsorted(column.angles[1:-1], theta, side="right"))
        lower, upper = boundary.limits([column.trapezoids[k]], [theta])
        t = _between(lower[0], upper[0], share)
        moments.append(touching(boundary, column.patch, t, theta))
    return moments


def along_helix(boundary: Boundary, column: Column, angles: Any) -> list[Moment]:
    """Return poses on the v-v helix at the side of a column."""
    assert column.side is not None
    patch = boundary.patches[column.patch]
    helix = surface_of(boundary.scene, patch).helix(column.side)
    contact = corner_contact(patch, column.side)
    return [Moment(helix.pose(float(theta)), contact) for theta in angles]


def outward(boundary: Boundary, patch: int, theta: float) -> Floats:
    """Return the unit vector of the plane from a patch to its free side, at one orientation."""
    _, _, qx, qy, _, _, gx, gy = boundary.ruled[patch].tolist()
    c, s = math.cos(theta), math.sin(theta)
    x, y = qx - (c * gx - s * gy), qy - (s * gx + c * gy)  # S_t: the forbidden side is on its left
    return np.array([y, -x]) / math.hypot(x, y)


def _between(lower: float, upper: float, share: float) -> float:
    lower, upper = max(lower, 0.0), min(upper, 1.0)
    return lower + (upper - lower) * (INSIDE + (1 - 2 * INSIDE) * share)


def _next(segments: Floats, k: int) -> int:
    """Return the segment that begins at the end of another one."""
    return int(np.hypot(*(segments[:, 0] - segments[k, 1]).T).argmin())
