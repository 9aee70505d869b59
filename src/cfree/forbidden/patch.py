"""Readable objects over the arrays of a boundary: patches, trapezoids, and the names of their curves and angles."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, overload

from cfree.contact.kind import Kind
from cfree.contact.surface import evaluate
from cfree.curves.curved import Curved
from cfree.errors import InvariantError
from cfree.exact.half_angle import theta_in
from cfree.forbidden.isolated import is_isolated_arc
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
        Vertex of the `Polygon`, counted over all its rings; for an edge, the vertex where t = 0. A rounded shape has
        the vertices of its core: the polygon that is grown, the ends of a stadium's segment, or a disc's centre. Of a
        shape with other arcs they are its corners and arcs, in order; arcs are cut at quarter circles.
    end : int or None
        For an edge, the vertex where t = 1. Edges of the workspace run against its rings: forbidden is on their left.
        A critical angle may be named by a diagonal of a convex piece: then the two are not neighbours. -1 is a corner
        of the finite frame that stands for everything outside the bounds or the workspace, or an end of an arc.
    """

    polygon: int
    name: str
    ring: int
    index: int
    end: int | None = None


@dataclass(frozen=True, slots=True)
class Contact:
    """A contact type with its two features, the robot's first.

    Attributes
    ----------
    kind : str
        "v-e", "e-v", "v-v" or "e-e"; among rounded shapes also "arc-arc", and "axis": the end of a quadrant of an
        arc's circle.
    robot, obstacle : Place
    branch : int
        Among rounded shapes: -1 where the patch enters this surface, 1 where it leaves; 0 if the two meet once. Of an
        axis: 0 to 3 quarter turns from the x-axis.
    """

    kind: str
    robot: Place
    obstacle: Place
    branch: int = 0


@dataclass(frozen=True, slots=True)
class CriticalAngle:
    """An orientation named by the features that define it.

    Attributes
    ----------
    kind : str
        "chart end"; "parallel": two edges become parallel; "helix": a v-v helix meets the patch's
        surface; "crossing": two curves on the patch meet; "touch": a surface of rounded shapes touches the patch's.
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
    """A free curve, a segment or an arc at one orientation, or a point that is on no trapezoid.

    Attributes
    ----------
    index : int
    kind : str
        "curve", "segment", "arc" or "point". An arc is less than a quarter of the circle of its patch, or just that.
    patch : int
        A contact that holds along it.
    lower, upper : Contact
        The curves on the patch that bound it: for a curve the curve itself, for a segment or an arc its two ends.
    start, stop : CriticalAngle
        Equal but for a curve.
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
            kind="arc" if is_isolated_arc(boundary, k) else {1: "curve", 2: "segment", 3: "point"}[int(p.kind[k])],
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
    elif features[0].kind == "e-e":
        kind = "parallel"
    else:
        kind = "touch" if boundary.scene.curved else "helix"
    place = int(getattr(columns, f"{end}_place")[k])
    return CriticalAngle(kind, features, (lo, hi), place, float(theta_in(int(columns.chart[k]), 0.5 * (lo + hi))))


def contact(boundary: BoundaryRecord, code: int) -> Contact:
    """Return the contact that a packed pair of features names."""
    kind, i, j = unpacked(code)
    kind, bits = Kind(kind), code >> 59 & 3
    robot_edge = kind in (Kind.EDGE_VERTEX, Kind.EDGE_EDGE)
    obstacle_edge = kind in (Kind.VERTEX_EDGE, Kind.EDGE_EDGE)
    branch = -1 if bits == 3 and kind != Kind.SEAM else bits
    is_arc = boundary.scene.curved and kind == Kind.VERTEX_VERTEX
    name = "axis" if kind == Kind.SEAM else KINDS[PatchKind.ARC_ARC] if is_arc else kind.short
    return Contact(name, robot_place(boundary, i, robot_edge), obstacle_place(boundary, j, obstacle_edge), branch)


def robot_place(boundary: BoundaryRecord, feature: int, is_edge: bool) -> Place:
    polygon, ring, index, end = _owner(boundary.features.robot, feature, is_edge)
    if polygon == BOUNDS:
        return Place(polygon, "reference point", 0, 0)
    return Place(polygon, "robot", ring, index, end)


def obstacle_place(boundary: BoundaryRecord, feature: int, is_edge: bool) -> Place:
    scene = boundary.scene
    polygon, ring, index, end = _owner(boundary.features.obstacles, feature, is_edge)
    if polygon == BOUNDS:
        return Place(polygon, "bounds", 0, index, end)
    if polygon == WORKSPACE:
        if scene.workspace is None:
            raise InvariantError("a feature of a workspace in a scene that has none", state=feature)
        # the first ring of a round one is the rim of its frame
        ring = ring - 1 if isinstance(scene.workspace, Curved) else _ring(scene.workspace.ring_offsets, index)
        return Place(polygon, "workspace", ring, index, end)
    return Place(polygon, scene.obstacle_names[polygon], ring, index, end)


def _owner(shape: ShapeFeatures, feature: int, is_edge: bool) -> tuple[int, int, int, int | None]:
    """Return polygon, ring, vertex and, for an edge, the vertex where it ends; -1 for an end of an arc that is none."""
    start, end = (int(shape.v[feature]), int(shape.w[feature])) if is_edge else (feature, feature)
    rings, ends = len(shape.owner_vertex), len(shape.xy) - len(shape.owner_of_end)
    if ends == len(shape.xy) and max(start, end) >= rings:
        return BOUNDS, 0, -1, -1 if is_edge else None
    known = next((vertex for vertex in (start, end) if vertex < rings), None)
    polygon = int(shape.owner_of_end[start - ends] if known is None else shape.owner_polygon[known])
    first, last = (int(shape.owner_vertex[vertex]) if vertex < rings else -1 for vertex in (start, end))
    return polygon, 0 if known is None else int(shape.ring[known]), first, last if is_edge else None


def _ring(offsets: Sequence[int], vertex: int) -> int:
    return int(np.searchsorted(offsets, vertex, side="right")) - 1


@dataclass(frozen=True, slots=True)
class Patch:
    """A contact patch: one robot feature against one obstacle feature, trimmed or not.

    Attributes
    ----------
    index : int
    kind : str
        "v-e", "e-v", "bound" or "arc-arc".
    robot, obstacle : Place
    phi_min, phi_range : float, radians
        Orientations of the contact before trimming: phi_min to phi_min + phi_range (paper, eq. 6).
    trapezoids : range
        Its live parts.
    quadrant : int or None
        Of an arc on an arc: the outward normal's angle psi is from quadrant * 90 degrees on, to 90 degrees more.
    """

    index: int
    kind: str
    robot: Place
    obstacle: Place
    phi_min: float
    phi_range: float
    trapezoids: range
    quadrant: int | None = None
    _ruled: NDArray[np.float64] = field(default_factory=lambda: np.zeros(8), repr=False, compare=False)
    _radius: float = field(default=0.0, repr=False, compare=False)

    @property
    def is_live(self) -> bool:
        """True if any part of it is on the boundary of the forbidden space."""
        return len(self.trapezoids) > 0

    def surface(self, t: ArrayLike, phi: ArrayLike) -> NDArray[np.float64]:
        """Return points S(t, phi) = (x, y, phi) of the contact surface, eqs. (5) and (8), like a call of `Surface`.

        On an arc-arc patch t in [0, 1] is tan(psi / 2), psi counted from the beginning of its quadrant; clockwise from
        the end if one of the arcs is concave.
        """
        points = evaluate(self._ruled, t, phi)
        if self.quadrant is not None:
            is_back = self._radius < 0
            psi = np.pi / 2 * (self.quadrant + is_back) + (-2 if is_back else 2) * np.arctan(np.asarray(t, float))
            points[..., 0] += self._radius * np.cos(psi)
            points[..., 1] += self._radius * np.sin(psi)
        return points


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
        on_edge, on_vertex = (bool(b.contact_kind[k] == kind) for kind in (Kind.VERTEX_EDGE, Kind.EDGE_VERTEX))
        return Patch(
            index=k,
            kind=KINDS[PatchKind(b.patch_kind[k])],
            robot=robot_place(b, int(b.contact_robot[k]), on_vertex),
            obstacle=obstacle_place(b, int(b.contact_obstacle[k]), on_edge),
            phi_min=float(b.phi_min[k]),
            phi_range=float(b.phi_range[k]),
            trapezoids=range(int(b.patch_start[k]), int(b.patch_start[k + 1])),
            quadrant=None if on_edge or on_vertex else int(b.contact_kind[k] >> 4),
            _ruled=b.ruled[k],
            _radius=float(b.patch_radius[k]),
        )

    def __iter__(self) -> Iterator[Patch]:
        return (self[k] for k in range(len(self)))
