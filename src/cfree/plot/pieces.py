"""Pieces of a boundary to draw in three dimensions: faces and curves, as quadrilaterals."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import to_rgb
from numpy.typing import NDArray

from cfree.contact.kind import Kind
from cfree.forbidden.kinds import COLOURS, PatchKind
from cfree.palette import EDGE_EDGE, FORBIDDEN, GREY, HELIX, LIGHT
from cfree.plot.strips import Strips, step_for, strips
from cfree.scene.scene import robot_radius

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

    from cfree.forbidden.boundary import Boundary
    from cfree.plot.workspace import Window

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]

SAME = 1e-9  # of t
CROWDED = 100_000  # trapezoids; curves of more would hide the patches
SURFACE, WALL, SECTION, CURVE, ON_TOP, OVER = 0, 1, 2, 3, 4, 5


@dataclass(frozen=True)
class Detail:
    """The fineness of a boundary's division.

    Attributes
    ----------
    rows : int
        Number of rows that steps in theta aim at.
    steps : (float, float)
        Limits of a step, in radians.
    cells : int
        A face is at most one part of this many of the window wide, so that its middle represents its depth.
    """

    rows: int
    steps: tuple[float, float]
    cells: int


FINE = Detail(25_000, (math.radians(1.5), math.radians(15)), 100)


@dataclass(frozen=True)
class Colours:
    """Colours of patches and curves: by default the palette's."""

    vertex_edge: str = COLOURS[PatchKind.VERTEX_EDGE]
    edge_vertex: str = COLOURS[PatchKind.EDGE_VERTEX]
    helix: str = HELIX
    edge_edge: str = EDGE_EDGE


@dataclass(frozen=True)
class Pieces:
    """Quadrilaterals, counter-clockwise from the free side; curves are quadrilaterals without width.

    Attributes
    ----------
    corners : (n, 4, 3) float64, theta in degrees
    rgb : (n, 3) float64
    sort : (n,) int
        SURFACE, WALL, SECTION, CURVE; ON_TOP: a curve that nothing hides; OVER: a curve drawn over other curves.
    owner : (n,) int
        The face that a curve borders, or -1 if it is always visible; a face's own number.
    width : (n,) float64
        Width of curves, in typographic points.
    part : (n,) int
        Part of the boundary as in `cfree.plot.strips.Strips`, or -1.
    """

    corners: Floats
    rgb: Floats
    sort: Ints
    owner: Ints
    width: Floats
    part: Ints

    def chosen(self, mask: Mask) -> Pieces:
        """Return the pieces of a mask, without the curves on faces that are not among them."""
        if not len(mask):
            return self
        remaining = mask & (mask[self.owner] | (self.owner < 0))
        number = np.cumsum(remaining) - 1
        owner = np.where(self.owner < 0, -1, number[self.owner])
        columns = {column.name: getattr(self, column.name)[remaining] for column in fields(self)}
        return Pieces(**columns | {"owner": owner[remaining]})

    def between(self, low: Floats | float, high: Floats | float) -> Pieces:
        """Cut off pieces at angles in degrees, one pair for all or one for each; corners move along rising sides."""
        low, high = (np.broadcast_to(angle, len(self.corners))[:, None] for angle in (low, high))
        is_curve = (self.sort >= CURVE)[:, None, None]
        other = np.where(is_curve, self.corners[:, [1, 0, 3, 2]], self.corners[:, [3, 2, 1, 0]])
        z, beyond = self.corners[..., 2], other[..., 2]
        rise = np.where(beyond == z, 1.0, beyond - z)
        share = (np.clip(z, low, high) - z) / rise
        cut = replace(self, corners=self.corners + share[..., None] * (other - self.corners))
        bottom, top = np.maximum(z, low).min(axis=1), np.minimum(z, high).max(axis=1)
        is_level = (z.min(axis=1) == z.max(axis=1)) & (low < high)[:, 0]
        return cut.chosen((bottom < top) | (is_level & (bottom == top)))


def pieces_of(
    boundary: Boundary, window: Window, colours: Colours | None = None, line: float = 1.3, detail: Detail = FINE
) -> Pieces:
    """Return all pieces of a boundary: patches, helices and e-e segments, and the section at a full turn."""
    patches = patches_of(boundary, window, colours, line, detail)
    return joined([patches, _section(boundary, window, len(patches.corners))])


def patches_of(
    boundary: Boundary, window: Window, colours: Colours | None = None, line: float = 1.3, detail: Detail = FINE,
    tiny: float = 0.0,
) -> Pieces:  # fmt: skip
    """Return patches, helices and e-e segments of a boundary.

    Curves are `line` points wide, or less if there are so many that they would hide the patches. Patches narrower than
    the share `tiny` of the window, or lower than that share of a turn, have no curves.
    """
    colours = colours or Colours()
    rows = strips(boundary, step_for(boundary, detail.rows, detail.steps))
    widest = math.hypot(window[2] - window[0], window[3] - window[1]) / detail.cells
    corners, strip, first = faces_of(rows, widest)
    kind = boundary.patch_kind[boundary.trapezoids.patch[rows.trapezoid[rows.joined]]][strip]
    table = np.array([(0.0, 0.0, 0.0), *map(to_rgb, (colours.vertex_edge, colours.edge_vertex, *_others()))])
    rgb = shaded(table[kind], corners, robot_radius(boundary.scene))
    n = len(corners)
    part = rows.part[rows.joined][strip]
    faces = Pieces(corners, rgb, np.where(kind == PatchKind.BOUND, WALL, SURFACE), np.arange(n), np.zeros(n), part)
    lined = _lined(boundary, rows, tiny * max(window[2] - window[0], window[3] - window[1]), tiny * 360)
    curves = _curves(boundary, rows, first, colours, lined) if len(boundary.trapezoids) <= CROWDED else []
    thinner = min(1.0, max(0.25, math.sqrt(3000 / max(1, sum(len(part.corners) for part in curves)))))
    split = [_split(replace(part, width=part.width + line * thinner), widest) for part in curves]
    return joined([faces, *split])


def _others() -> tuple[str, str]:
    return COLOURS[PatchKind.BOUND], COLOURS[PatchKind.ARC_ARC]


def of_line(points: Floats, colour: str, width: float, sort: int = CURVE) -> Pieces:
    """Make pieces of a polyline (k, 3), theta in degrees, visible from all sides."""
    start, stop = points[:-1], points[1:]
    corners = np.stack((start, stop, stop, start), axis=1)
    return of_one_colour(corners, colour, sort, np.full(len(corners), -1), width)


def of_sheet(points: Floats, colour: str | Floats, angle_scale: float) -> Pieces:
    """Make both sides of a grid (m, n, 3), theta in degrees, in one colour or one for each face (m - 1, n - 1, 3).

    Each side is a face of its own, lit from its own side, so that the one turned away need not be drawn.
    """
    corners = np.stack((points[:-1, :-1], points[:-1, 1:], points[1:, 1:], points[1:, :-1]), axis=2).reshape(-1, 4, 3)
    n = len(corners)
    rgb = np.tile(to_rgb(colour), (n, 1)) if isinstance(colour, str) else colour.reshape(-1, 3)
    both = np.concatenate((corners, corners[:, ::-1]))
    lit = shaded(np.concatenate((rgb, rgb)), both, angle_scale)
    return Pieces(both, lit, np.full(2 * n, SURFACE), np.full(2 * n, -1), np.zeros(2 * n), np.full(2 * n, -1))


def faces_of(rows: Strips, widest: float) -> tuple[Floats, Ints, Ints]:
    """Return the corners of all faces, the strip of each, and the first face of each strip."""
    ends = _with_degrees(rows.points, rows.theta)
    here, after = ends[rows.joined], ends[rows.joined + 1]
    width = np.hypot(*(here[:, 1] - here[:, 0])[:, :2].T), np.hypot(*(after[:, 1] - after[:, 0])[:, :2].T)
    count = np.maximum(1, np.ceil(np.maximum(*width) / widest)).astype(np.int64)
    strip = np.repeat(np.arange(len(count)), count)
    first = np.cumsum(count) - count
    s = ((np.arange(len(strip)) - first[strip]) / count[strip])[:, None]
    e = s + 1 / count[strip][:, None]
    here, after = here[strip], after[strip]
    corners = np.stack(
        [(1 - k) * row[:, 0] + k * row[:, 1] for row, k in ((here, s), (here, e), (after, e), (after, s))], axis=1
    )
    return corners, strip, first


def _split(curves: Pieces, widest: float) -> Pieces:
    """Split curves into parts as short as faces are wide, so that each part's middle represents its depth."""
    start, stop = curves.corners[:, 0], curves.corners[:, 1]
    count = np.maximum(1, np.ceil(np.hypot(*(stop - start)[:, :2].T) / widest)).astype(np.int64)
    curve = np.repeat(np.arange(len(count)), count)
    s = ((np.arange(len(curve)) - (np.cumsum(count) - count)[curve]) / count[curve])[:, None]
    e = s + 1 / count[curve][:, None]
    here, after = ((1 - k) * start[curve] + k * stop[curve] for k in (s, e))
    corners = np.stack((here, after, after, here), axis=1)
    columns = {column.name: getattr(curves, column.name)[curve] for column in fields(curves)}
    return Pieces(**columns | {"corners": corners})


def _section(boundary: Boundary, window: Window, first: int) -> Pieces:
    """Return the forbidden region at theta = 360 degrees."""
    import shapely

    region = shapely.intersection(boundary.slice(-1e-6).forbidden, shapely.box(*window))
    corners = level(region, 360.0)
    return of_one_colour(corners, FORBIDDEN, SECTION, first + np.arange(len(corners)))


def level(region: BaseGeometry, degrees: float) -> Floats:
    """Triangulate a region of the plane at one height, (n, 4, 3), the last corner twice."""
    import shapely

    triangles = shapely.constrained_delaunay_triangles(region)
    corners = np.full((shapely.get_num_geometries(triangles), 4, 3), degrees)
    if len(corners):
        rings = shapely.get_exterior_ring(shapely.get_parts(triangles))
        xy = shapely.get_coordinates(rings).reshape(-1, 4, 2)[:, :3]
        x, y = (xy[:, 1:] - xy[:, :1]).transpose(2, 1, 0)
        clockwise = x[0] * y[1] - x[1] * y[0] < 0
        xy[clockwise] = xy[clockwise][:, ::-1]
        corners[:, :3, :2], corners[:, 3, :2] = xy, xy[:, 2]
    return corners


def _lined(boundary: Boundary, rows: Strips, width: float, degrees: float) -> Mask:
    """Return a mask of strips whose patches have at least this width and height, in the mean."""
    patch = boundary.trapezoids.patch[rows.trapezoid[rows.joined]]
    below, above = (np.degrees(rows.theta[rows.joined + k]) for k in (0, 1))
    ends = rows.points[rows.joined]
    across = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    low, high = np.full(len(boundary.patch_kind), np.inf), np.full(len(boundary.patch_kind), -np.inf)
    np.minimum.at(low, patch, below)
    np.maximum.at(high, patch, above)
    height, area = (high - low)[patch], np.bincount(patch, across * (above - below), len(low))[patch]
    lined: Mask = (height >= degrees) & (area >= width * height)
    return lined


def _curves(boundary: Boundary, rows: Strips, first: Ints, colours: Colours, lined: Mask) -> list[Pieces]:
    """Return the sides of trapezoids: v-v helices, e-e lines at the patches' own ends, and cuts by the bounds.

    Only lined strips have them.
    """
    ends, trapezoid = _with_degrees(rows.points, rows.theta), rows.trapezoid[rows.joined]
    table = boundary.trapezoids
    kind = boundary.patch_kind[table.patch]
    curves = []

    def at_end(side: int) -> Mask:
        """True on smooth joints among round shapes, where a line ends; and everywhere among polygons."""
        t = rows.t[rows.joined, side]
        is_line = kind[trapezoid] != PatchKind.ARC_ARC
        is_joint: Mask = is_line & ((t < SAME) | (t > 1 - SAME))
        return is_joint if boundary.scene.curved else np.ones_like(is_joint)

    def add(strip: Ints, start: Floats, stop: Floats, colour: str, owner: Ints) -> None:
        strip, owner = strip[lined[strip]], owner[lined[strip]]
        corners = np.stack((start[strip], stop[strip], stop[strip], start[strip]), axis=1)
        part = rows.part[rows.joined[strip]]
        curves.append(replace(of_one_colour(corners, colour, CURVE, owner), part=part))

    for side, curve in enumerate((table.lower_kind, table.upper_kind)):
        here, after = ends[rows.joined, side], ends[rows.joined + 1, side]
        outer = rows.share[rows.joined, side] == side
        on_bounds = kind[trapezoid] == PatchKind.BOUND
        helix, cut = (
            ((curve[trapezoid] == Kind.VERTEX_VERTEX) & ~on_bounds & outer & at_end(side)).nonzero()[0],
            ((curve[trapezoid] != Kind.VERTEX_VERTEX) & on_bounds).nonzero()[0],
        )
        add(helix, here, after, colours.helix, first[helix])
        add(cut, here, after, GREY, np.full(len(cut), -1))
    phi_min, phi_max = boundary.phi_min, boundary.phi_min + boundary.phi_range
    for row, angle, phi in ((rows.joined, table.theta_from, phi_min), (rows.joined + 1, table.theta_to, phi_max)):
        own_end = (kind != PatchKind.BOUND) & _same_angle(angle, phi[table.patch])
        (strip,) = np.nonzero(own_end[trapezoid] & _same_angle(angle[trapezoid], rows.theta[row]))
        add(strip, ends[row, 0], ends[row, 1], colours.edge_edge, first[strip])
    return curves


def _same_angle(first: Floats, second: Floats) -> NDArray[np.bool_]:
    """Return True for angles equal up to rounding and whole turns; for pictures only."""
    return np.abs(np.mod(first - second + math.pi, math.tau) - math.pi) < 1e-9


def of_one_colour(corners: Floats, colour: str, sort: int, owner: Ints, width: float = 0.0) -> Pieces:
    """Make pieces of one colour, not shaded."""
    n = len(corners)
    rgb, width_of, nowhere = np.tile(to_rgb(colour), (n, 1)), np.full(n, width), np.full(n, -1)
    return Pieces(corners, rgb, np.full(n, sort), owner, width_of, nowhere)


def _with_degrees(points: Floats, theta: Floats) -> Floats:
    degrees = np.broadcast_to((theta / math.tau * 360)[:, None, None], (len(theta), 2, 1))
    return np.concatenate((points, degrees), axis=-1)


def shaded(rgb: Floats, corners: Floats, angle_scale: float) -> Floats:
    """Shade colours by the light: darker away from it, a little lighter towards it."""
    scaled = corners * (1.0, 1.0, math.radians(angle_scale))
    normal = np.cross(scaled[:, 2] - scaled[:, 0], scaled[:, 3] - scaled[:, 1])
    length = np.linalg.norm(normal, axis=1)
    lit = normal @ (np.array(LIGHT) / np.linalg.norm(LIGHT)) / np.where(length > 0, length, 1.0)
    shade = (0.82 + 0.3 * lit)[:, None]
    shaded: Floats = np.where(shade < 1, rgb * shade, 1 - (1 - rgb) * (2 - shade))
    return shaded.clip(0, 1)


def joined(parts: list[Pieces]) -> Pieces:
    """Join pieces whose owners are already numbered in the whole."""
    names = [column.name for column in fields(Pieces)]
    return Pieces(**{name: np.concatenate([getattr(part, name) for part in parts]) for name in names})
