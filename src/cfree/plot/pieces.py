"""What there is to draw of a boundary in three dimensions: faces and curves, as quadrilaterals."""

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

CROWDED = 100_000  # curves of more trapezoids would hide the patches
SURFACE, WALL, SECTION, CURVE, ON_TOP, OVER = 0, 1, 2, 3, 4, 5


@dataclass(frozen=True)
class Detail:
    """How fine a boundary is divided.

    Attributes
    ----------
    rows : int
        Steps in theta are as small as this many rows allow,
    steps : (float, float)
        within these limits, in radians.
    cells : int
        A face is at most this part of the window wide, so that its middle stands for its depth.
    """

    rows: int
    steps: tuple[float, float]
    cells: int


FINE = Detail(25_000, (math.radians(1.5), math.radians(15)), 100)


@dataclass(frozen=True)
class Colours:
    """Colours of patches and curves: the palette's unless others are given."""

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
        SURFACE, WALL, SECTION, CURVE; ON_TOP: a curve that nothing hides; OVER: one that is drawn over other curves.
    owner : (n,) int
        The face whose border a curve is, or -1 if it is always seen; itself for a face.
    width : (n,) float64
        Of curves, in typographic points.
    part : (n,) int
        Part of the boundary in the sense of `cfree.plot.strips.Strips`, or -1.
    """

    corners: Floats
    rgb: Floats
    sort: Ints
    owner: Ints
    width: Floats
    part: Ints

    def chosen(self, mask: Mask) -> Pieces:
        """Some of the pieces, without the curves on faces that are not among them."""
        if not len(mask):
            return self
        kept = mask & (mask[self.owner] | (self.owner < 0))
        number = np.cumsum(kept) - 1
        owner = np.where(self.owner < 0, -1, number[self.owner])
        columns = {column.name: getattr(self, column.name)[kept] for column in fields(self)}
        return Pieces(**columns | {"owner": owner[kept]})

    def between(self, low: Floats | float, high: Floats | float) -> Pieces:
        """What is between angles in degrees, the same for all or one pair a piece; corners move along rising sides."""
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
    """Everything there is to draw of a boundary: patches, helices and e-e segments, and the section at a full turn."""
    patches = patches_of(boundary, window, colours, line, detail)
    return joined([patches, _section(boundary, window, len(patches.corners))])


def patches_of(
    boundary: Boundary, window: Window, colours: Colours | None = None, line: float = 1.3, detail: Detail = FINE,
    tiny: float = 0.0,
) -> Pieces:  # fmt: skip
    """Patches, helices and e-e segments of a boundary.

    Curves are `line` points wide, or less where there are so many that they would hide the patches. Patches that are
    narrower than the share `tiny` of the window, or lower than that of a turn, have none.
    """
    colours = colours or Colours()
    rows = strips(boundary, step_for(boundary, detail.rows, detail.steps))
    widest = math.hypot(window[2] - window[0], window[3] - window[1]) / detail.cells
    corners, strip, first = faces_of(rows, widest)
    kind = boundary.patch_kind[boundary.trapezoids.patch[rows.trapezoid[rows.joined]]][strip]
    table = np.array(
        [(0.0, 0.0, 0.0), *map(to_rgb, (colours.vertex_edge, colours.edge_vertex, COLOURS[PatchKind.BOUND]))]
    )
    rgb = shaded(table[kind], corners, robot_radius(boundary.scene))
    n = len(corners)
    part = rows.part[rows.joined][strip]
    faces = Pieces(corners, rgb, np.where(kind == PatchKind.BOUND, WALL, SURFACE), np.arange(n), np.zeros(n), part)
    lined = _lined(boundary, rows, tiny * max(window[2] - window[0], window[3] - window[1]), tiny * 360)
    curves = _curves(boundary, rows, first, colours, lined) if len(boundary.trapezoids) <= CROWDED else []
    thinner = min(1.0, max(0.25, math.sqrt(3000 / max(1, sum(len(part.corners) for part in curves)))))
    split = [_split(replace(part, width=part.width + line * thinner), widest) for part in curves]
    return joined([faces, *split])


def of_line(points: Floats, colour: str, width: float, sort: int = CURVE) -> Pieces:
    """A polyline, (k, 3) with theta in degrees, that is seen from all sides."""
    start, stop = points[:-1], points[1:]
    corners = np.stack((start, stop, stop, start), axis=1)
    return of_one_colour(corners, colour, sort, np.full(len(corners), -1), width)


def of_sheet(points: Floats, colour: str | Floats, angle_scale: float) -> Pieces:
    """Both sides of a grid of points (m, n, 3), theta in degrees, in one colour or one for each face (m - 1, n - 1, 3).

    Each side is a face of its own, lit from its own side, so that the one turned away need not be drawn.
    """
    corners = np.stack((points[:-1, :-1], points[:-1, 1:], points[1:, 1:], points[1:, :-1]), axis=2).reshape(-1, 4, 3)
    n = len(corners)
    rgb = np.tile(to_rgb(colour), (n, 1)) if isinstance(colour, str) else colour.reshape(-1, 3)
    both = np.concatenate((corners, corners[:, ::-1]))
    lit = shaded(np.concatenate((rgb, rgb)), both, angle_scale)
    return Pieces(both, lit, np.full(2 * n, SURFACE), np.full(2 * n, -1), np.zeros(2 * n), np.full(2 * n, -1))


def faces_of(rows: Strips, widest: float) -> tuple[Floats, Ints, Ints]:
    """Corners of all faces, the strip that each is a part of, and the first face of each strip."""
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
    """Curves in parts as short as faces are wide: a part's middle must stand for its depth, too."""
    start, stop = curves.corners[:, 0], curves.corners[:, 1]
    count = np.maximum(1, np.ceil(np.hypot(*(stop - start)[:, :2].T) / widest)).astype(np.int64)
    of = np.repeat(np.arange(len(count)), count)
    s = ((np.arange(len(of)) - (np.cumsum(count) - count)[of]) / count[of])[:, None]
    e = s + 1 / count[of][:, None]
    here, after = ((1 - k) * start[of] + k * stop[of] for k in (s, e))
    corners = np.stack((here, after, after, here), axis=1)
    columns = {column.name: getattr(curves, column.name)[of] for column in fields(curves)}
    return Pieces(**columns | {"corners": corners})


def _section(boundary: Boundary, window: Window, first: int) -> Pieces:
    """The forbidden region at theta = 360 degrees."""
    import shapely

    region = shapely.intersection(boundary.slice(-1e-6).forbidden, shapely.box(*window))
    corners = level(region, 360.0)
    return of_one_colour(corners, FORBIDDEN, SECTION, first + np.arange(len(corners)))


def level(region: BaseGeometry, degrees: float) -> Floats:
    """Triangles of a region of the plane at one height, (n, 4, 3), the last corner twice."""
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
    """Strips of patches that are as wide and as high at least, in the mean."""
    patch = boundary.trapezoids.patch[rows.trapezoid[rows.joined]]
    below, above = (np.degrees(rows.theta[rows.joined + k]) for k in (0, 1))
    ends = rows.points[rows.joined]
    across = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    low, high = np.full(len(boundary.patch_kind), np.inf), np.full(len(boundary.patch_kind), -np.inf)
    np.minimum.at(low, patch, below)
    np.maximum.at(high, patch, above)
    height, area = (high - low)[patch], np.bincount(patch, across * (above - below), len(low))[patch]
    found: Mask = (height >= degrees) & (area >= width * height)
    return found


def _curves(boundary: Boundary, rows: Strips, first: Ints, colours: Colours, lined: Mask) -> list[Pieces]:
    """Sides of trapezoids: v-v helices, e-e lines at the patches' own ends, and where the bounds cut the patches.

    Only of those strips that are lined.
    """
    ends, of = _with_degrees(rows.points, rows.theta), rows.trapezoid[rows.joined]
    table = boundary.trapezoids
    kind = boundary.patch_kind[table.patch]
    found = []

    def add(strip: Ints, start: Floats, stop: Floats, colour: str, owner: Ints) -> None:
        strip, owner = strip[lined[strip]], owner[lined[strip]]
        corners = np.stack((start[strip], stop[strip], stop[strip], start[strip]), axis=1)
        part = rows.part[rows.joined[strip]]
        found.append(replace(of_one_colour(corners, colour, CURVE, owner), part=part))

    for side, curve in enumerate((table.lower_kind, table.upper_kind)):
        here, after, on_bounds = ends[rows.joined, side], ends[rows.joined + 1, side], kind[of] == PatchKind.BOUND
        helix, cut = (
            ((curve[of] == Kind.VERTEX_VERTEX) & ~on_bounds).nonzero()[0],
            ((curve[of] != Kind.VERTEX_VERTEX) & on_bounds).nonzero()[0],
        )
        add(helix, here, after, colours.helix, first[helix])
        add(cut, here, after, GREY, np.full(len(cut), -1))
    phi_min, phi_max = boundary.phi_min, boundary.phi_min + boundary.phi_range
    for row, angle, phi in ((rows.joined, table.theta_from, phi_min), (rows.joined + 1, table.theta_to, phi_max)):
        own_end = (kind != PatchKind.BOUND) & _same_angle(angle, phi[table.patch])
        (strip,) = np.nonzero(own_end[of] & _same_angle(angle[of], rows.theta[row]))
        add(strip, ends[row, 0], ends[row, 1], colours.edge_edge, first[strip])
    return found


def _same_angle(first: Floats, second: Floats) -> NDArray[np.bool_]:
    """Equal up to rounding and whole turns; for the eye only."""
    return np.abs(np.mod(first - second + math.pi, math.tau) - math.pi) < 1e-9


def of_one_colour(corners: Floats, colour: str, sort: int, owner: Ints, width: float = 0.0) -> Pieces:
    """Pieces of one colour, not shaded."""
    n = len(corners)
    rgb, width_of, nowhere = np.tile(to_rgb(colour), (n, 1)), np.full(n, width), np.full(n, -1)
    return Pieces(corners, rgb, np.full(n, sort), owner, width_of, nowhere)


def _with_degrees(points: Floats, theta: Floats) -> Floats:
    degrees = np.broadcast_to((theta / math.tau * 360)[:, None, None], (len(theta), 2, 1))
    return np.concatenate((points, degrees), axis=-1)


def shaded(rgb: Floats, corners: Floats, angle_scale: float) -> Floats:
    """Colours as the light leaves them: darker away from it, a little lighter towards it."""
    scaled = corners * (1.0, 1.0, math.radians(angle_scale))
    normal = np.cross(scaled[:, 2] - scaled[:, 0], scaled[:, 3] - scaled[:, 1])
    length = np.linalg.norm(normal, axis=1)
    lit = normal @ (np.array(LIGHT) / np.linalg.norm(LIGHT)) / np.where(length > 0, length, 1.0)
    shade = (0.82 + 0.3 * lit)[:, None]
    shaded: Floats = np.where(shade < 1, rgb * shade, 1 - (1 - rgb) * (2 - shade))
    return shaded.clip(0, 1)


def joined(parts: list[Pieces]) -> Pieces:
    """Pieces as one; owners are counted in the whole already."""
    names = [column.name for column in fields(Pieces)]
    return Pieces(**{name: np.concatenate([getattr(part, name) for part in parts]) for name in names})
