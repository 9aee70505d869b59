"""The boundary in three dimensions, drawn from back to front.

Faces and curves go into one list, sorted by depth each time the view changes. The free side of a patch is
shaded and opaque; the forbidden side is a ghost, so that one looks through the near walls into the free space,
as into a doll's house. At theta = 360 degrees the forbidden space is cut: the section is grey.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgb
from mpl_toolkits.mplot3d import proj3d
from numpy.typing import NDArray

from cfree.forbidden.mesh import COLOURS
from cfree.plot.strips import Strips, step_for, strips
from cfree.scene.scene import robot_radius

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

    from cfree.forbidden.boundary import Boundary

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Window = tuple[float, float, float, float]

STEPS = math.radians(1.5), math.radians(15)
ROWS = 25_000  # the steps are as small as this many rows allow
CELLS = 100  # a face is at most this part of the window wide, so that its middle stands for its depth
CROWDED = 100_000  # curves of more trapezoids would hide the patches
SECTION_COLOUR, CUT = "#d9d9de", "#7a808c"
AHEAD = 0.012  # of the depth: curves lie on their faces, whose middles may be nearer
LIGHT = np.array([-0.55, -0.65, 0.52])
GLASS, GHOST = 0.3, 0.06
SURFACE, WALL, SECTION, CURVE, ON_TOP, OVER = 0, 1, 2, 3, 4, 5


@dataclass(frozen=True)
class Colours:
    """Colours of patches and curves: the paper's unless others are given."""

    vertex_edge: str = COLOURS[1]
    edge_vertex: str = COLOURS[2]
    helix: str = "#1f3fbf"
    edge_edge: str = "#f5c518"


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
    """

    corners: Floats
    rgb: Floats
    sort: Ints
    owner: Ints
    width: Floats


class Painting(PolyCollection):
    """The pieces on axes with three dimensions.

    Parameters
    ----------
    pieces : Pieces
    ghost : float
        Opacity of the side of a face that is turned away.
    """

    def __init__(self, pieces: Pieces, ghost: float = GHOST) -> None:
        super().__init__([], closed=True, joinstyle="round")
        self._pieces = pieces
        self._ghost = ghost

    def do_3d_projection(self) -> float:
        """Project, choose what is seen, sort by depth; called before each drawing."""
        pieces = self._pieces
        if not len(pieces.corners):
            return 0.0
        axes: Any = self.axes
        x, y, z = proj3d.proj_transform(*pieces.corners.reshape(-1, 3).T, axes.M)
        flat: Any = np.stack((x, y), axis=-1).reshape(-1, 4, 2)
        depth = np.asarray(z).reshape(-1, 4).mean(axis=1)
        near, far = depth.min(), depth.max()
        p, q = flat[:, 2] - flat[:, 0], flat[:, 3] - flat[:, 1]
        front = (p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0] > 0)[pieces.owner] | (pieces.owner < 0)

        clear = np.isin(pieces.sort, (SECTION, ON_TOP, OVER))
        fog = np.where(clear, 0.0, 0.25 * (depth - near) / max(far - near, 1e-300))
        rgb = pieces.rgb + (1 - pieces.rgb) * fog[:, None]
        alpha = np.where(front, 1.0, self._ghost)
        alpha[pieces.sort == WALL] = np.where(front[pieces.sort == WALL], GLASS, 0)
        alpha[(pieces.sort == CURVE) & ~front] = 0
        is_curve = pieces.sort >= CURVE
        rank = depth - AHEAD * (far - near) * (is_curve + 1.0 * (pieces.sort == OVER))
        rank[pieces.sort == SECTION] += np.where(front[pieces.sort == SECTION], -10, 10) * (far - near)
        rank[pieces.sort == ON_TOP] -= 20 * (far - near)
        order = np.argsort(-rank)
        order = order[alpha[order] > 0]

        colour = np.column_stack((rgb, alpha))
        inside: Any = colour.copy()
        rim: Any = colour.copy()
        inside[is_curve, 3] = 0
        rim[(alpha < 1) & ~is_curve, 3] = 0
        self.set_verts(flat[order], closed=True)
        self.set_facecolor(inside[order])
        self.set_edgecolor(rim[order])
        self.set_linewidth(np.where(is_curve, pieces.width, 0.4)[order].tolist())
        return float(near)


def pieces_of(boundary: Boundary, window: Window, colours: Colours | None = None, line: float = 1.3) -> Pieces:
    """Everything there is to draw of a boundary: patches, helices and e-e segments, and the section at a full turn."""
    patches = patches_of(boundary, window, colours, line)
    return joined([patches, _section(boundary, window, len(patches.corners))])


def patches_of(boundary: Boundary, window: Window, colours: Colours | None = None, line: float = 1.3) -> Pieces:
    """Patches, helices and e-e segments of a boundary.

    Curves are `line` points wide, or less where there are so many that they would hide the patches.
    """
    colours = colours or Colours()
    rows = strips(boundary, step_for(boundary, ROWS, STEPS))
    corners, kind, cell = _faces(boundary, rows, window)
    table = np.array([(0.0, 0.0, 0.0), *map(to_rgb, (colours.vertex_edge, colours.edge_vertex, COLOURS[3]))])
    rgb = shaded(table[kind], corners, robot_radius(boundary.scene))
    n = len(corners)
    faces = Pieces(corners, rgb, np.where(kind == 3, WALL, SURFACE), np.arange(n), np.zeros(n))
    curves = _curves(boundary, rows, cell, colours) if len(boundary.trapezoids) <= CROWDED else []
    thinner = min(1.0, max(0.25, math.sqrt(3000 / max(1, sum(len(part.corners) for part in curves)))))
    split = [_split(replace(part, width=part.width + line * thinner), _widest(window)) for part in curves]
    return joined([faces, *split])


def of_line(points: Floats, colour: str, width: float, sort: int = CURVE) -> Pieces:
    """A polyline, (k, 3) with theta in degrees, that is seen from all sides."""
    start, stop = points[:-1], points[1:]
    corners = np.stack((start, stop, stop, start), axis=1)
    return of_one_colour(corners, colour, sort, np.full(len(corners), -1), width)


def _faces(boundary: Boundary, rows: Strips, window: Window) -> tuple[Floats, NDArray[np.uint8], Ints]:
    """Corners and kind of all faces, and the first face of each strip."""
    ends = _with_degrees(rows.points, rows.theta)
    here, after = ends[rows.joined], ends[rows.joined + 1]
    width = np.hypot(*(here[:, 1] - here[:, 0])[:, :2].T), np.hypot(*(after[:, 1] - after[:, 0])[:, :2].T)
    count = np.maximum(1, np.ceil(np.maximum(*width) / _widest(window))).astype(np.int64)
    strip = np.repeat(np.arange(len(count)), count)
    first = np.cumsum(count) - count
    s = ((np.arange(len(strip)) - first[strip]) / count[strip])[:, None]
    e = s + 1 / count[strip][:, None]
    here, after = here[strip], after[strip]
    corners = np.stack(
        [(1 - k) * row[:, 0] + k * row[:, 1] for row, k in ((here, s), (here, e), (after, e), (after, s))], axis=1
    )
    kind = boundary.patch_kind[boundary.trapezoids.patch[rows.trapezoid[rows.joined]]]
    return corners, kind[strip], first


def _widest(window: Window) -> float:
    return math.hypot(window[2] - window[0], window[3] - window[1]) / CELLS


def _split(curves: Pieces, widest: float) -> Pieces:
    """Curves in parts as short as faces are wide: a part's middle must stand for its depth, too."""
    start, stop = curves.corners[:, 0], curves.corners[:, 1]
    count = np.maximum(1, np.ceil(np.hypot(*(stop - start)[:, :2].T) / widest)).astype(np.int64)
    of = np.repeat(np.arange(len(count)), count)
    s = ((np.arange(len(of)) - (np.cumsum(count) - count)[of]) / count[of])[:, None]
    e = s + 1 / count[of][:, None]
    here, after = ((1 - k) * start[of] + k * stop[of] for k in (s, e))
    corners = np.stack((here, after, after, here), axis=1)
    return Pieces(corners, curves.rgb[of], curves.sort[of], curves.owner[of], curves.width[of])


def _section(boundary: Boundary, window: Window, first: int) -> Pieces:
    """The forbidden region at theta = 360 degrees."""
    import shapely

    region = shapely.intersection(boundary.slice(-1e-6).forbidden, shapely.box(*window))
    corners = level(region, 360.0)
    return of_one_colour(corners, SECTION_COLOUR, SECTION, first + np.arange(len(corners)))


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


def _curves(boundary: Boundary, rows: Strips, cell: Ints, colours: Colours) -> list[Pieces]:
    """Sides of trapezoids: v-v helices, e-e lines at the patches' own ends, and where the bounds cut the patches."""
    ends, of = _with_degrees(rows.points, rows.theta), rows.trapezoid[rows.joined]
    table = boundary.trapezoids
    kind = boundary.patch_kind[table.patch]
    found = []

    def add(strip: Ints, start: Floats, stop: Floats, colour: str, owner: Ints) -> None:
        corners = np.stack((start[strip], stop[strip], stop[strip], start[strip]), axis=1)
        found.append(of_one_colour(corners, colour, CURVE, owner))

    for side, curve in enumerate((table.lower_kind, table.upper_kind)):
        here, after, on_wall = ends[rows.joined, side], ends[rows.joined + 1, side], kind[of] == 3
        helix, cut = ((curve[of] == 3) & ~on_wall).nonzero()[0], ((curve[of] != 3) & on_wall).nonzero()[0]
        add(helix, here, after, colours.helix, cell[helix])
        add(cut, here, after, CUT, np.full(len(cut), -1))
    phi_min, phi_max = boundary.phi_min, boundary.phi_min + boundary.phi_range
    for row, angle, phi in ((rows.joined, table.theta_from, phi_min), (rows.joined + 1, table.theta_to, phi_max)):
        own_end = (kind != 3) & _same_angle(angle, phi[table.patch])
        (strip,) = np.nonzero(own_end[of] & _same_angle(angle[of], rows.theta[row]))
        add(strip, ends[row, 0], ends[row, 1], colours.edge_edge, cell[strip])
    return found


def _same_angle(first: Floats, second: Floats) -> NDArray[np.bool_]:
    """Equal up to rounding and whole turns; for the eye only."""
    return np.abs(np.mod(first - second + math.pi, math.tau) - math.pi) < 1e-9


def of_one_colour(corners: Floats, colour: str, sort: int, owner: Ints, width: float = 0.0) -> Pieces:
    """Pieces of one colour, not shaded."""
    n = len(corners)
    return Pieces(corners, np.tile(to_rgb(colour), (n, 1)), np.full(n, sort), owner, np.full(n, width))


def _with_degrees(points: Floats, theta: Floats) -> Floats:
    degrees = np.broadcast_to((theta / math.tau * 360)[:, None, None], (len(theta), 2, 1))
    return np.concatenate((points, degrees), axis=-1)


def shaded(rgb: Floats, corners: Floats, angle_scale: float) -> Floats:
    """Colours as the light leaves them: darker away from it, a little lighter towards it."""
    scaled = corners * (1.0, 1.0, math.radians(angle_scale))
    normal = np.cross(scaled[:, 2] - scaled[:, 0], scaled[:, 3] - scaled[:, 1])
    length = np.linalg.norm(normal, axis=1)
    lit = normal @ (LIGHT / np.linalg.norm(LIGHT)) / np.where(length > 0, length, 1.0)
    shade = (0.78 + 0.34 * lit)[:, None]
    shaded: Floats = np.where(shade < 1, rgb * shade, 1 - (1 - rgb) * (2 - shade))
    return shaded.clip(0, 1)


def joined(parts: list[Pieces]) -> Pieces:
    """Pieces as one; owners are counted in the whole already."""
    return Pieces(
        np.concatenate([part.corners for part in parts]),
        np.concatenate([part.rgb for part in parts]),
        np.concatenate([part.sort for part in parts]),
        np.concatenate([part.owner for part in parts]),
        np.concatenate([part.width for part in parts]),
    )
