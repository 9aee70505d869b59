"""No-fit and inner-fit regions among round shapes: segments and arcs of a slice of the boundary."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise, product
from typing import TYPE_CHECKING, Any

from cfree.arguments import checked
from cfree.collision.nearest_free import centers
from cfree.collision.pose_checker import is_free
from cfree.contact.contact_lines import ContactLine, contact_lines, crossings, facing, is_between
from cfree.exact.number import ExactPoint, Number, to_fraction
from cfree.exact.pose import Pose, pose_at
from cfree.forbidden.boundary import boundary
from cfree.forbidden.kinds import PatchKind
from cfree.forbidden.slice import Slice
from cfree.lazy import registered
from cfree.scene.scene import Scene, largest_of
from cfree.words import counted

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry
else:
    BaseGeometry = Any  # shapely is imported where it is used

Place = tuple[float, float]
Pair = tuple[ExactPoint, ExactPoint]


@dataclass(frozen=True)
class ContactEdge:
    """Positions in contact, from one to another, on a line or an arc.

    Attributes
    ----------
    start, end : (x, y)
        Rounded; the overlap is on the left.
    center : (x, y) or None
        Center of the arc; None of a line.
    radius : float
        0 of a line. The arc runs counter-clockwise; clockwise if the radius is below 0, as of a concave arc.
    """

    start: Place
    end: Place
    center: Place | None = None
    radius: float = 0.0


@dataclass(frozen=True, repr=False)
class RoundedFit:
    """Positions of a part among round shapes at one orientation.

    Attributes
    ----------
    scene : Scene
        The moving part as robot, the fixed one as obstacle or the container as workspace.
    pose : Pose
        Orientation of the part, at the origin.
    edges : tuple of ContactEdge
        Positions in contact, overlap on the left. Their order and their ends are exact, the numbers are rounded.
    segments : tuple of pairs of exact points
        Exact fits between two lines that face each other, as a disc in a slot.
    points : tuple of exact points
        Exact fits at a single position: a center on a center, as a peg in its hole, or contacts on two lines. Fits
        whose coordinates are irrational are not among them.
    """

    scene: Scene
    pose: Pose
    edges: tuple[ContactEdge, ...]
    segments: tuple[Pair, ...]
    points: tuple[ExactPoint, ...]
    _cut: Slice = field(compare=False)

    def __repr__(self) -> str:
        arcs = sum(edge.center is not None for edge in self.edges)
        found = [counted(len(self.segments), "segment"), counted(len(self.points), "point")]
        fits = f"; exact fits: {', '.join(found)}" if self.segments or self.points else ""
        return f"<RoundedFit of {counted(len(self.edges) - arcs, 'line')}, {counted(arcs, 'arc')}{fits}>"

    @checked
    def overlaps(self, position: Sequence[Number]) -> bool:
        """True if the part overlaps at this position of its reference point, decided exactly; touching does not."""
        x, y = position
        return not is_free(self.scene, pose_at(to_fraction(x), to_fraction(y), self.pose.tau))

    @property
    def area(self) -> float:
        """Area of the overlap, up to rounding; of a container, the area in which the part fits."""
        doubled = 0.0
        for edge in self.edges:
            (x, y), (u, v) = edge.start, edge.end
            doubled += x * v - y * u
            if edge.center is not None:
                a, b = edge.center
                sense = math.copysign(1.0, edge.radius)
                turn = sense * (sense * (math.atan2(v - b, u - a) - math.atan2(y - b, x - a)) % math.tau)
                doubled += edge.radius**2 * (turn - math.sin(turn))
        return abs(doubled) / 2

    def to_shapely(self) -> BaseGeometry:
        """Return the overlap as a shapely geometry; arcs are replaced by chords of a fiftieth of a radian."""
        return self._cut.forbidden

    @cached_property
    def lines(self) -> list[Any]:
        """The edges as lines to draw, (n, 2) each."""
        return self._cut.lines

    def plot(self) -> Any:
        """Draw the region, and exact fits in another colour, by matplotlib; return the figure."""
        return registered("fit_picture")(self)


def rounded_fit(scene: Scene, pose: Pose) -> RoundedFit:
    """Return the positions of a part at the orientation of a pose."""
    cut = boundary(scene).slice({"tau": pose.tau})
    points, segments = _exact_fits(scene, pose, cut)
    return RoundedFit(scene, pose, tuple(_edges(cut, pose)), segments, points, cut)


def _edges(cut: Slice, pose: Pose) -> Iterator[ContactEdge]:
    patches, record = cut.patches, cut.boundary
    on_arcs = record.patch_kind[patches] == PatchKind.ARC_ARC
    for patch, ends, is_arc in zip(patches.tolist(), cut.segments.tolist(), on_arcs.tolist(), strict=True):
        start, end = map(tuple, ends)
        if not is_arc:
            yield ContactEdge(start, end)
            continue
        px, py, _, _, ax, ay, _, _ = record.ruled[patch].tolist()
        x, y = pose.apply([ax, ay]).tolist()
        yield ContactEdge(start, end, (px - x, py - y), float(record.patch_radius[patch]))


def _exact_fits(scene: Scene, pose: Pose, cut: Slice) -> tuple[tuple[ExactPoint, ...], tuple[Pair, ...]]:
    """Return free points with forbidden positions all around, and free segments with them on both sides."""
    import shapely

    others = (*scene.obstacles, *([scene.workspace] if scene.workspace is not None else []))
    moved = pose.apply_exact(centers(scene.robot))
    places = dict.fromkeys((x - u, y - v) for (u, v), (x, y) in product(moved, centers(others)))
    lines = contact_lines(scene, pose)
    places |= dict.fromkeys(crossings(lines))
    segments = tuple(_slots(scene, pose, lines))
    region = cut.forbidden
    shapely.prepare(region)
    margin = 4 * cut.error + 1e-7 * largest_of(scene)  # slices at angles of parallel edges are less precise

    def is_covered(place: ExactPoint) -> bool:
        point = shapely.Point(*map(float, place))
        return bool(region.contains(point) and region.boundary.distance(point) > margin)

    return tuple(
        place
        for place in filter(is_covered, places)
        if not any(is_between(place, *segment) for segment in segments) and _is_free_at(scene, pose, place)
    ), segments


def _slots(scene: Scene, pose: Pose, lines: Sequence[ContactLine]) -> Iterator[Pair]:
    """Yield the free parts of lines with two contacts that face each other."""
    for first, last, line in facing(lines):
        cuts = sorted({first, last, *(at for at in line.cut_by(lines) if first < at < last)})
        free = [_is_free_at(scene, pose, line.at((a + b) / 2)) for a, b in pairwise(cuts)]
        start = None
        for k, is_open in enumerate([*free, False]):
            if is_open and start is None:
                start = cuts[k]
            if not is_open and start is not None:
                yield line.at(start), line.at(cuts[k])
                start = None


def _is_free_at(scene: Scene, pose: Pose, place: ExactPoint) -> bool:
    return bool(is_free(scene, pose_at(*place, pose.tau)))
