"""The configuration space as one frame shows it: faces and curves, cut at the robot's orientation, from back to front.

The eye is above the box, so that what is below a level plane never hides what is above it: first everything below the
plane of the current orientation is drawn, then the plane, then what is above it, each part sorted by depth.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import to_rgb
from numpy.typing import ArrayLike, NDArray

from cfree.forbidden.mesh import COLOURS
from cfree.plot.depth_sort import Colours, shaded
from cfree.plot.strips import Strips, step_for, strips
from cfree.scene.scene import robot_radius

if TYPE_CHECKING:
    from matplotlib.collections import PolyCollection

    from cfree.forbidden.boundary import Boundary

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Window = tuple[float, float, float, float]

HELIX, EDGE_EDGE = Colours.helix, Colours.edge_edge
STEPS = math.radians(4), math.radians(15)
ROWS = 8_000
CELLS = 18  # a face is at most this part of the window wide
HEIGHT = 0.82  # of the box, its longer side being 1
ELEVATION, DISTANCE = math.radians(27), 4.2
ON_FACE = 0.02
BACK = 0.08  # opacity of the forbidden side
FOG = 0.22
AZIMUTHS = math.radians(-78), math.radians(-12)  # within one quadrant the axes keep their places


@dataclass(frozen=True)
class Pieces:
    """Quadrilaterals with two corners at one theta and two above; those of a curve have no width.

    Attributes
    ----------
    corners : (n, 4, 3) float64, theta in degrees
    rgb : (n, 3) float64
    width : (n,) float64
        Line width of a curve in points, 0 for a face.
    part : (n,) int64
        Part in the sense of `cfree.plot.strips.Strips`, or -1.
    owner : (n,) int64
        The face whose border a curve is, or -1 if it is seen from all sides; itself for a face.
    lift : (n,) float64
        By how much a piece counts as nearer than it is: curves are drawn over the faces they lie on.
    """

    corners: Floats
    rgb: Floats
    width: Floats
    part: Ints
    owner: Ints
    lift: Floats


class Eye:
    """Projection of the box to a panel, in pixels from its lower left corner.

    Parameters
    ----------
    window : four floats
        x0, y0, x1, y1 of the box.
    width, height : float
        Of the panel, in pixels.
    azimuth : float, radians
    """

    def __init__(self, window: Window, width: float, height: float, azimuth: float) -> None:
        x0, y0, x1, y1 = window
        self.side = max(x1 - x0, y1 - y0)
        self.middle = np.array([0.5 * (x0 + x1), 0.5 * (y0 + y1), 180.0])
        self.unit = np.array([1 / self.side, 1 / self.side, HEIGHT / 360])
        self.azimuth = azimuth
        box = np.array([(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (0.0, 360.0)])
        seen = [self._flat(box, azimuth)[0] for azimuth in np.linspace(*AZIMUTHS, 9)]
        low, high = np.min([s.min(axis=0) for s in seen], axis=0), np.max([s.max(axis=0) for s in seen], axis=0)
        # one scale and one place for all azimuths: the box turns, and nothing else
        self.scale = min(0.8 * width / (high[0] - low[0]), 0.88 * height / (high[1] - low[1]))
        self.offset = 0.5 * np.array([1.0 * width, 1.04 * height]) - 0.5 * self.scale * (low + high)

    def __call__(self, points: ArrayLike) -> tuple[Floats, Floats]:
        """Places (..., 2) and depths (...) of points (..., 3), theta in degrees."""
        flat, depth = self._flat(np.asarray(points, dtype=np.float64), self.azimuth)
        return self.offset + self.scale * flat, depth

    def _flat(self, points: Floats, azimuth: float) -> tuple[Floats, Floats]:
        p = (points - self.middle) * self.unit
        c, s, ce, se = math.cos(azimuth), math.sin(azimuth), math.cos(ELEVATION), math.sin(ELEVATION)
        depth = DISTANCE - p @ np.array([ce * c, ce * s, se])
        flat = p @ np.array([[-s, -se * c], [c, -se * s], [0, ce]])
        return flat / depth[..., None], depth


def pieces_of(boundary: Boundary, window: Window) -> tuple[Pieces, Floats]:
    """Faces, helices and e-e lines of all patches but the bounds; and (parts, 2) their angles in degrees."""
    rows = strips(boundary, step_for(boundary, ROWS, STEPS))
    degrees = np.degrees(rows.theta)
    parts = int(rows.part.max(initial=-1)) + 1
    angles = np.stack((np.full(parts, np.inf), np.full(parts, -np.inf)), axis=1)
    np.minimum.at(angles[:, 0], rows.part, degrees)
    np.maximum.at(angles[:, 1], rows.part, degrees)
    faces, first = _faces(boundary, rows, window)
    return joined([faces, *_curves(boundary, rows, first)]), angles


def _faces(boundary: Boundary, rows: Strips, window: Window) -> tuple[Pieces, Ints]:
    """All faces, and the first face of each strip."""
    kind = boundary.patch_kind[boundary.trapezoids.patch[rows.trapezoid[rows.joined]]]
    ends = _raised(rows)
    here, after = ends[rows.joined], ends[rows.joined + 1]
    width = np.hypot(*(here[:, 1] - here[:, 0])[:, :2].T), np.hypot(*(after[:, 1] - after[:, 0])[:, :2].T)
    widest = max(window[2] - window[0], window[3] - window[1]) / CELLS
    count = np.where(kind == 3, 0, np.maximum(1, np.ceil(np.maximum(*width) / widest))).astype(np.int64)
    strip = np.repeat(np.arange(len(count)), count)
    first = np.cumsum(count) - count
    s = ((np.arange(len(strip)) - first[strip]) / count[strip])[:, None]
    e = s + 1 / count[strip][:, None]
    ways = ((here, s), (here, e), (after, e), (after, s))
    corners = np.stack([(1 - k) * row[strip, 0] + k * row[strip, 1] for row, k in ways], axis=1)
    table = np.array([to_rgb(COLOURS[k]) for k in (1, 1, 2)])
    rgb = shaded(table[kind[strip]], corners, robot_radius(boundary.scene))
    part = rows.part[rows.joined][strip]
    return Pieces(corners, rgb, np.zeros(len(part)), part, np.arange(len(part)), np.zeros(len(part))), first


def _curves(boundary: Boundary, rows: Strips, first: Ints) -> list[Pieces]:
    """Sides that are v-v helices, and the ends of v-e patches, which are e-e lines."""
    ends, table = _raised(rows), boundary.trapezoids
    of = rows.trapezoid[rows.joined]
    kind = boundary.patch_kind[table.patch]
    few = min(1.0, max(0.25, math.sqrt(600 / max(1, len(table)))))
    found = []

    def add(strip: Ints, start: Floats, stop: Floats, colour: str) -> None:
        corners = np.stack((start, start, stop, stop), axis=1)
        rgb, width = np.tile(to_rgb(colour), (len(strip), 1)), np.full(len(strip), 2.2 * few)
        part = rows.part[rows.joined[strip]]
        found.append(Pieces(corners, rgb, width, part, first[strip], np.full(len(strip), ON_FACE)))

    for side, curve in enumerate((table.lower_kind, table.upper_kind)):
        strip = np.flatnonzero((curve[of] == 3) & (kind[of] != 3))
        row = rows.joined[strip]
        add(strip, ends[row, side], ends[row + 1, side], HELIX)
    phi_min, phi_max = boundary.phi_min, boundary.phi_min + boundary.phi_range
    for row, angle, phi in ((rows.joined, table.theta_from, phi_min), (rows.joined + 1, table.theta_to, phi_max)):
        own_end = (kind == 1) & _same_angle(angle, phi[table.patch])
        strip = np.flatnonzero(own_end[of] & _same_angle(angle[of], rows.theta[row]))
        add(strip, ends[row[strip], 0], ends[row[strip], 1], EDGE_EDGE)
    return found


def line_pieces(points: Floats, colour: str, width: float, lift: float) -> Pieces:
    """A polyline (n, 3), theta in degrees; broken where theta runs through 0."""
    start, stop = points[:-1], points[1:]
    near = np.abs(stop[:, 2] - start[:, 2]) < 180
    start, stop = start[near], stop[near]
    low = np.where((start[:, 2] <= stop[:, 2])[:, None], start, stop)
    high = np.where((start[:, 2] <= stop[:, 2])[:, None], stop, start)
    n = len(low)
    corners = np.stack((low, low, high, high), axis=1)
    nobody = np.full(n, -1)
    return Pieces(corners, np.tile(to_rgb(colour), (n, 1)), np.full(n, width), nobody, nobody, np.full(n, lift))


def joined(pieces: list[Pieces]) -> Pieces:
    """All in one; faces first, so that owners keep their numbers."""
    names = Pieces.__dataclass_fields__
    return Pieces(**{name: np.concatenate([getattr(part, name) for part in pieces]) for name in names})


def within(pieces: Pieces, low: Floats, high: Floats) -> tuple[Pieces, NDArray[np.bool_]]:
    """What is between angles in degrees, one pair a piece, cut there; and which pieces that was."""
    bottom, top = pieces.corners[:, 0, 2], pieces.corners[:, 3, 2]
    level = bottom == top
    kept = np.where(
        level, (bottom >= low) & (bottom <= high) & (low < high), (np.maximum(bottom, low) < np.minimum(top, high))
    )
    corners, height = pieces.corners[kept], np.where(level, 1.0, top - bottom)[kept]
    s = (np.clip((low[kept] - bottom[kept]) / height, 0, 1))[:, None]
    e = (np.clip((high[kept] - bottom[kept]) / height, 0, 1))[:, None]
    (a, b, c, d), e = np.moveaxis(corners, 1, 0), np.where(level[kept][:, None], 1.0, e)
    cut = np.stack((a + s * (d - a), b + s * (c - b), b + e * (c - b), a + e * (d - a)), axis=1)
    rest = (getattr(pieces, name)[kept] for name in ("rgb", "width", "part", "owner", "lift"))
    return Pieces(cut, *rest), kept


def paint(onto: PolyCollection, pieces: Pieces, eye: Eye, fronts: NDArray[np.bool_], opacity: float) -> None:
    """Put pieces into a collection, from back to front.

    Parameters
    ----------
    onto : PolyCollection
    pieces : Pieces
    eye : Eye
    fronts : (n,) bool
        Whether the free side of a piece, or of its owner, faces the eye.
    opacity : float
        Of what faces it.
    """
    flat: Any
    flat, depths = eye(pieces.corners)
    depth = depths.mean(axis=1)
    is_curve = pieces.width > 0
    alpha = opacity * np.where(fronts, 1.0, np.where(is_curve, 0.0, BACK))
    alpha[is_curve & (pieces.owner < 0)] = max(opacity, 0.35)
    fog = FOG * np.clip((depth - DISTANCE + 0.7) / 1.4, 0, 1)
    rgb = pieces.rgb + (1 - pieces.rgb) * fog[:, None]
    order = np.argsort(pieces.lift - depth, kind="stable")
    order = order[alpha[order] > 0]
    fill: Any
    rim: Any
    fill, rim = (np.column_stack((rgb, a)) for a in (np.where(is_curve, 0, alpha), alpha))
    rim[~is_curve & (alpha < 0.9), 3] = 0
    onto.set_verts(flat[order], closed=True)
    onto.set_facecolor(fill[order])
    onto.set_edgecolor(rim[order])
    onto.set_linewidth(np.where(is_curve, pieces.width, 0.5)[order].tolist())


def facing(pieces: Pieces, eye: Eye) -> NDArray[np.bool_]:
    """Of each piece: does the free side, or that of its owner, face the eye?"""
    flat, _ = eye(pieces.corners)
    p, q = flat[:, 2] - flat[:, 0], flat[:, 3] - flat[:, 1]
    front: NDArray[np.bool_] = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0] > 0
    return (front[pieces.owner] if len(front) else front) | (pieces.owner < 0)


def _raised(rows: Strips) -> Floats:
    degrees = np.broadcast_to(np.degrees(rows.theta)[:, None, None], (len(rows.theta), 2, 1))
    return np.concatenate((rows.points, degrees), axis=-1)


def _same_angle(first: Floats, second: Floats) -> NDArray[np.bool_]:
    """Equal up to rounding and whole turns; for the eye only."""
    return np.abs(np.mod(first - second + math.pi, math.tau) - math.pi) < 1e-9
