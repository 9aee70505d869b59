"""Readable objects over the arrays of a boundary: patches, trapezoids, and the names of their curves and angles."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, overload

from cfree.contact.kind import Kind
from cfree.contact.surface import evaluate
from cfree.errors import InvariantError
from cfree.exact.half_angle import theta_in
from cfree.forbidden.kinds import KINDS, PatchKind
from cfree.libraries import ArrayLike, NDArray, np
from cfree.scene.features import BOUNDS, WORKSPACE, ShapeFeatures, unpacked
from cfree.value import Value

if TYPE_CHECKING:
    from cfree.forbidden.columns import Trapezoids
    from cfree.forbidden.record import BoundaryRecord


@dataclass(frozen=True, slots=True)
class Place:
    """A vertex, or an edge, in the user's own numbering.

    Attributes
    ----------
    polygon : int
        Index into ``scene.robot`` or ``scene.obstacles``; -1 for the bounds (or the reference point), -2 for the
        workspace.
    name : str
        The obstacle's name.
    ring : int
        0 the outer ring, k + 1 the hole k.
    index : int
        Vertex of the `Polygon`, counted over all its rings; for an edge, the vertex where t = 0.
    end : int or None
        For an edge, the vertex where t = 1. Edges of the workspace run against its rings: forbidden is on their left.
        A critical angle may be named by a diagonal of a convex piece: then the two are not neighbours. -1 is a corner
        of the finite frame that stands for everything outside the bounds or the workspace.
    """

    polygon: int
    name: str
    ring: int
    index: int
    end: int | None = None


@dataclass(frozen=True, slots=True)
class Contact:
    """A contact type with its two features, the robot's first: "v-e", "e-v", "v-v" or "e-e"."""

    kind: str
    robot: Place
    obstacle: Place


@dataclass(frozen=True, slots=True)
class CriticalAngle:
    """An orientation named by the features that define it.

    Attributes
    ----------
    kind : str
        "chart end"; "parallel": two edges become parallel; "helix": a v-v helix meets the patch's
        surface; "crossing": two curves on the patch meet.
    features : tuple of Contact
        None, one or two of them.
    interval : (float, float)
        An interval of tau, in the chart, that contains it.
    place : int
        0: it is the only root there; else its number among the roots that doubles cannot separate.
    theta : float, radians
    """

    kind: str
    features: tuple[Contact, ...]
    interval: tuple[float, float]
    place: int
    theta: float


@dataclass(frozen=True, slots=True)
class Trapezoid:
    """A part of a patch between two critical angles and two curves."""

    index: int
    patch: int
    chart: int
    lower: Contact
    upper: Contact
    start: CriticalAngle
    stop: CriticalAngle

    @classmethod
    def of(cls, boundary: BoundaryRecord, k: int) -> Trapezoid:
        t = boundary.trapezoids
        return cls(
            index=k,
            patch=int(t.patch[k]),
            chart=int(t.chart[k]),
            lower=contact(boundary, int(t.lower[k])),
            upper=contact(boundary, int(t.upper[k])),
            start=_angle(boundary, t, "from", k),
            stop=_angle(boundary, t, "to", k),
        )


@dataclass(frozen=True, slots=True)
class IsolatedPart:
    """A free curve, a segment at one orientation, or a point that is on no trapezoid.

    Attributes
    ----------
    index : int
    kind : str
        "curve", "segment" or "point".
    patch : int
        A contact that holds along it.
    lower, upper : Contact
        The curves on the patch that bound it: for a curve the curve itself, for a segment its two ends.
    start, stop : CriticalAngle
        Equal for a segment and a point.
    ends : ((float, float, float), (float, float, float))
        (x, y, theta) of its two ends, rounded; equal for a point.
    """

    index: int
    kind: str
    patch: int
    lower: Contact
    upper: Contact
    start: CriticalAngle
    stop: CriticalAngle
    ends: tuple[tuple[float, float, float], tuple[float, float, float]]

    @classmethod
    def of(cls, boundary: BoundaryRecord, k: int) -> IsolatedPart:
        p = boundary.isolated
        theta = np.array([p.theta_from[k], p.theta_to[k]])
        patch, t = np.array([p.lower_patch[k], p.upper_patch[k]]), np.array([p.first_t[k], p.last_t[k]])
        (x0, y0), (x1, y1) = boundary.evaluate(patch, t, theta).tolist()
        return cls(
            index=k,
            kind={1: "curve", 2: "segment", 3: "point"}[int(p.kind[k])],
            patch=int(p.patch[k]),
            lower=contact(boundary, int(p.lower[k])),
            upper=contact(boundary, int(p.upper[k])),
            start=_angle(boundary, p, "from", k),
            stop=_angle(boundary, p, "to", k),
            ends=((x0, y0, float(theta[0])), (x1, y1, float(theta[1]))),
        )


def _angle(boundary: BoundaryRecord, columns: Trapezoids, end: str, k: int) -> CriticalAngle:
    first, second = int(getattr(columns, f"{end}_first")[k]), int(getattr(columns, f"{end}_second")[k])
    lo, hi = float(getattr(columns, f"{end}_lo")[k]), float(getattr(columns, f"{end}_hi")[k])
    features = tuple(contact(boundary, code) for code in (first, second) if code)
    if not features:
        kind = "chart end"
    elif len(features) == 2:
        kind = "crossing"
    else:
        kind = "parallel" if features[0].kind == "e-e" else "helix"
    place = int(getattr(columns, f"{end}_place")[k])
    return CriticalAngle(kind, features, (lo, hi), place, float(theta_in(int(columns.chart[k]), 0.5 * (lo + hi))))


def contact(boundary: BoundaryRecord, code: int) -> Contact:
    """Return the contact that a packed pair of features names."""
    kind, i, j = unpacked(code)
    kind = Kind(kind)
    robot_edge = kind in (Kind.EDGE_VERTEX, Kind.EDGE_EDGE)
    obstacle_edge = kind in (Kind.VERTEX_EDGE, Kind.EDGE_EDGE)
    return Contact(kind.short, robot_place(boundary, i, robot_edge), obstacle_place(boundary, j, obstacle_edge))


def robot_place(boundary: BoundaryRecord, feature: int, is_edge: bool) -> Place:
    polygon, index, end = _owner(boundary.features.robot, feature, is_edge)
    if polygon == BOUNDS:
        return Place(polygon, "reference point", 0, 0)
    return Place(polygon, "robot", _ring(boundary.scene.robot[polygon].ring_offsets, index), index, end)


def obstacle_place(boundary: BoundaryRecord, feature: int, is_edge: bool) -> Place:
    scene = boundary.scene
    polygon, index, end = _owner(boundary.features.obstacles, feature, is_edge)
    if polygon == BOUNDS:
        return Place(polygon, "bounds", 0, index, end)
    if polygon == WORKSPACE:
        if scene.workspace is None:
            raise InvariantError("a feature of a workspace in a scene that has none", state=feature)
        return Place(polygon, "workspace", _ring(scene.workspace.ring_offsets, index), index, end)
    name = scene.obstacle_names[polygon]
    return Place(polygon, name, _ring(scene.obstacles[polygon].ring_offsets, index), index, end)


def _owner(shape: ShapeFeatures, feature: int, is_edge: bool) -> tuple[int, int, int | None]:
    """Return polygon, vertex and, for an edge, the vertex where it ends."""
    start, end = (int(shape.v[feature]), int(shape.w[feature])) if is_edge else (feature, feature)
    owners = shape.owner_vertex
    if max(start, end) >= len(owners):
        return BOUNDS, -1, -1 if is_edge else None
    return int(shape.owner_polygon[start]), int(owners[start]), int(owners[end]) if is_edge else None


def _ring(offsets: Sequence[int], vertex: int) -> int:
    return int(np.searchsorted(offsets, vertex, side="right")) - 1


@dataclass(frozen=True, slots=True)
class Patch:
    """A contact patch: one robot feature against one obstacle feature, trimmed or not.

    Attributes
    ----------
    index : int
    kind : str
        "v-e", "e-v" or "bound".
    robot, obstacle : Place
    phi_min, phi_range : float, radians
        Orientations of the contact before trimming: phi_min to phi_min + phi_range (paper, eq. 6).
    trapezoids : range
        Its live parts.
    """

    index: int
    kind: str
    robot: Place
    obstacle: Place
    phi_min: float
    phi_range: float
    trapezoids: range
    _ruled: NDArray[np.float64] = field(repr=False, compare=False)

    @property
    def is_live(self) -> bool:
        """True if any part of it is on the boundary of the forbidden space."""
        return len(self.trapezoids) > 0

    def surface(self, t: ArrayLike, phi: ArrayLike) -> NDArray[np.float64]:
        """Return points S(t, phi) = (x, y, phi) of the contact surface, eqs. (5) and (8), like a call of `Surface`."""
        return evaluate(self._ruled, t, phi)


class Patches(Value, Sequence[Patch]):
    """Patches of a boundary, each made when it is read."""

    def __init__(self, boundary: BoundaryRecord) -> None:
        self._boundary = boundary

    @property
    def _content(self) -> tuple[BoundaryRecord]:
        return (self._boundary,)

    def __len__(self) -> int:
        return len(self._boundary.contact_kind)

    @overload
    def __getitem__(self, index: int) -> Patch: ...
    @overload
    def __getitem__(self, index: slice) -> list[Patch]: ...
    def __getitem__(self, index: int | slice) -> Patch | list[Patch]:
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        k, b = range(len(self))[index], self._boundary
        on_edge = bool(b.contact_kind[k] == Kind.VERTEX_EDGE)
        return Patch(
            index=k,
            kind=KINDS[PatchKind(b.patch_kind[k])],
            robot=robot_place(b, int(b.contact_robot[k]), not on_edge),
            obstacle=obstacle_place(b, int(b.contact_obstacle[k]), on_edge),
            phi_min=float(b.phi_min[k]),
            phi_range=float(b.phi_range[k]),
            trapezoids=range(int(b.patch_start[k]), int(b.patch_start[k + 1])),
            _ruled=b.ruled[k],
        )

    def __iter__(self) -> Iterator[Patch]:
        return (self[k] for k in range(len(self)))
