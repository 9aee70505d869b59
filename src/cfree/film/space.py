"""The configuration space in a frame: the patches shown so far, cut by the plane of the robot's orientation.

The plane shows the slice: free and forbidden positions of the reference point, and the contacts between them. Patches
above it are more or less transparent, so that they never hide the robot's point.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import PathPatch
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from cfree.exact.pose import Pose
from cfree.film.box import Box
from cfree.film.camera import Camera
from cfree.forbidden.kinds import COLOURS, PatchKind
from cfree.palette import FORBIDDEN, FRAME, FREE, INK, MARK, RIM
from cfree.plot.depth_sort import paint
from cfree.plot.pieces import CURVE, OVER, SURFACE, Detail, Pieces, joined, of_line, patches_of
from cfree.plot.workspace import Window, path_of, rings_of_geometry
from cfree.scene.smooth import smooth

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from matplotlib.path import Path

    from cfree.forbidden.boundary import Boundary
    from cfree.forbidden.slice import Slice

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

TAIL = 500  # points at most of a motion's line
LINE, GHOST = 1.8, 0.08  # width of curves; opacity of the forbidden side
STAYS = 0.5  # opacity of swept patches above the plane
PALEST = 0.6  # share of white in the line of an old motion
FACETS = Detail(12_000, (math.radians(2), math.radians(15)), 40)


class Space:
    """The panel of the configuration space.

    Parameters
    ----------
    figure : matplotlib figure
    place : four floats
        Left, bottom, width, height, as shares of the figure.
    boundary : Boundary
    window : four floats
        x0, y0, x1, y1 of the box.
    names : (str, str)
        Names of the axes x and y.
    trail : float
        Frames until the line of a motion has faded.
    surface : Boundary, optional
        The patches shown, by default all of the boundary.
    """

    def __init__(
        self, figure: Figure, place: Window, boundary: Boundary, window: Window, names: tuple[str, str],
        trail: float, surface: Boundary | None = None,
    ) -> None:  # fmt: skip
        self.boundary, self.window, self._age = boundary, window, trail
        pieces = patches_of(surface or boundary, window, line=LINE, detail=FACETS)
        self.angles = _angles(pieces)
        self.obstacles = [
            ring
            for obstacle in smooth(boundary.scene).obstacles
            for ring in rings_of_geometry(shapely.clip_by_rect(obstacle.to_shapely(), *window))
        ]
        self.pieces = pieces.chosen((pieces.sort == SURFACE) | ((pieces.sort == CURVE) & (pieces.owner >= 0)))
        ax: Any = figure.add_axes(place)
        self.panel = figure.bbox.width * place[2], figure.bbox.height * place[3]
        ax.set(xlim=(0, self.panel[0]), ylim=(0, self.panel[1]))
        ax.axis("off")
        self.box = Box(ax, window, names)

        def region(colour: str, opacity: float, zorder: float) -> Any:
            return ax.add_patch(PathPatch(path_of([]), facecolor=colour, alpha=opacity, lw=0, zorder=zorder))

        self.floor = region(RIM, 0.55, 1.2)
        self.below = ax.add_collection(PolyCollection([], zorder=2, joinstyle="round"))
        self.free, self.solid = region(FREE, 0.55, 3), region(FORBIDDEN, 0.93, 3.1)
        self.level = ax.add_patch(PathPatch(path_of([]), fill=False, edgecolor=FRAME, lw=1.0, zorder=3.2))
        self.section = ax.add_collection(LineCollection([], zorder=3.3, capstyle="round"))
        self.cross = ax.add_collection(LineCollection([], colors=INK, lw=0.8, linestyles=[(0, (4, 3))], zorder=3.4))
        self.above = ax.add_collection(PolyCollection([], zorder=4, joinstyle="bevel"))
        (self.point,) = ax.plot([], [], "o", ms=9.5, color=MARK, mec="white", mew=1.8, zorder=8)
        halo = [withStroke(linewidth=2.2, foreground="white")]
        style = {"va": "bottom", "fontsize": 10.5, "weight": "bold", "zorder": 7, "path_effects": halo}
        self.tag = ax.text(0, 0, "", color=FRAME, **style)

    def draw(
        self, pose: Pose, cut: Slice, azimuth: float, shown: Floats, ghost: float,
        lines: Sequence[tuple[str, Floats]], stays: NDArray[np.bool_],
    ) -> None:  # fmt: skip
        """Draw everything for one frame; see `cfree.film.frame.View`."""
        camera = Camera(self.window, *self.panel, azimuth)
        theta = math.degrees(pose.theta)
        self.box.draw(camera)
        self.floor.set_path(_lifted(camera, self.obstacles, 0.0))
        self._draw_level(camera, theta, cut)
        self._draw_pieces(camera, theta, shown, ghost, lines, stays)
        _, y0, x1, y1 = self.window
        x, y = float(pose.x), float(pose.y)
        (here,), _ = camera([(x, y, theta)])
        self.point.set_data([here[0]], [here[1]])
        self.cross.set_segments(list(camera([[(x, y, theta), (x, y0, theta)], [(x, y, theta), (x1, y, theta)]])[0]))
        (corner,), _ = camera([(x1, y1, theta)])
        self.tag.set_text(f"θ = {theta:.0f}°")
        width = self.tag.get_window_extent().width
        self.tag.set_position((float(min(corner[0] + 0.1 * width, self.panel[0] - width)), float(corner[1])))

    def _draw_level(self, camera: Camera, theta: float, cut: Slice) -> None:
        x0, y0, x1, y1 = self.window
        frame = np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], dtype=np.float64)
        solid = _clipped(cut, self.window)
        self.solid.set_path(_lifted(camera, solid, theta))
        self.free.set_path(_lifted(camera, [frame, *(ring[::-1] for ring in solid)], theta))
        self.level.set_path(_lifted(camera, [frame], theta))
        parts = [np.stack((line[:-1], line[1:]), axis=1) for line in cut.lines]
        kinds = np.repeat(self.boundary.patch_kind[cut.patches], list(map(len, parts)))
        inside, segments = _within(np.concatenate(parts or [cut.segments]), self.window)
        chosen = inside & (kinds != PatchKind.BOUND)
        ends = np.concatenate((segments, np.full((len(kinds), 2, 1), theta)), axis=2)[chosen]
        self.section.set_segments(list(camera(ends)[0]))
        self.section.set_color([COLOURS[PatchKind(kind)] for kind in kinds[chosen]])
        self.section.set_linewidth(2.0 * min(1.0, max(0.4, math.sqrt(150 / max(1, len(parts))))))

    def _draw_pieces(
        self, camera: Camera, theta: float, shown: Floats, ghost: float, lines: Sequence[tuple[str, Floats]],
        stays: NDArray[np.bool_],
    ) -> None:  # fmt: skip
        low, high = shown[self.pieces.part].T
        ages = [0.0] * (len(lines) - 1) + [self._age]
        tubes = [piece for line, age in zip(lines, ages, strict=True) for piece in _tube(*line, age)]
        for onto, bottom, top, opacity in ((self.below, -1.0, theta, 1.0), (self.above, theta, 361.0, ghost)):
            patches = self.pieces.between(np.maximum(low, bottom), np.minimum(high, top))
            both = joined([patches, *(tube.between(bottom, top) for tube in tubes)])
            flat, depth = camera(both.corners)
            opacities = np.where(np.append(stays, False)[both.part], max(opacity, STAYS), opacity)  # part -1: False
            paint(onto, both, flat, depth.mean(axis=1), camera.span, ghost=GHOST, opacity=opacities)


def _tube(colour: str, line: Floats, trail: float) -> list[Pieces]:
    """Return a polyline with a dark rim that fades within `trail` points; 0 means it has faded."""
    if len(line) < 2:
        return []
    chosen = np.unique(np.linspace(0, len(line) - 1, TAIL).astype(int))
    points, age = line[chosen], (len(line) - 1 - chosen) / trail if trail else np.ones(len(chosen))
    cuts = np.flatnonzero(np.abs(np.diff(points[:, 2])) >= 180) + 1  # theta passes through 0 there
    tubes = []
    for shade, width, sort in ((INK, 4.2, CURVE), (colour, 2.8, OVER)):
        for part, old in zip(np.split(points, cuts), np.split(age, cuts), strict=True):
            if len(part) > 1:
                tube = of_line(part, shade, width, sort)
                paler = PALEST * np.clip(old[1:, None], 0, 1)
                tubes.append(replace(tube, rgb=tube.rgb + paler * (1 - tube.rgb)))
    return tubes


def _angles(pieces: Pieces) -> Floats:
    """Return the range of angles of each part in degrees, (parts, 2)."""
    on_part = pieces.part >= 0
    part, z = pieces.part[on_part], pieces.corners[on_part, :, 2]
    angles = np.tile((np.inf, -np.inf), (int(part.max(initial=-1)) + 1, 1))
    np.minimum.at(angles[:, 0], part, z.min(axis=1))
    np.maximum.at(angles[:, 1], part, z.max(axis=1))
    return angles


def _lifted(camera: Camera, rings: Iterable[Floats], theta: float) -> Path:
    """Project rings of the plane at one theta by the camera."""
    return path_of(camera(np.column_stack((ring, np.full(len(ring), theta))))[0] for ring in rings)


def _within(segments: Floats, window: Window) -> tuple[Mask, Floats]:
    """Clip segments (n, 2, 2) to a window: a mask of those that meet it, and their parts in it."""
    start, step = segments[:, 0], segments[:, 1] - segments[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        bounds = [(np.array(corner) - start) / step for corner in (window[:2], window[2:])]
    low, high = np.fmin(*bounds), np.fmax(*bounds)
    level = (start >= window[:2]) & (start <= window[2:])  # segments along an axis
    low = np.where(step == 0, np.where(level, 0.0, 2.0), low).max(axis=1).clip(0, None)
    high = np.where(step == 0, 1.0, high).min(axis=1).clip(None, 1)
    ends = np.stack((start + low[:, None] * step, start + high[:, None] * step), axis=1)
    return low < high, ends


def _clipped(cut: Slice, window: Window) -> list[Floats]:
    """Return the rings of the forbidden region within the window."""
    return rings_of_geometry(shapely.intersection(cut.forbidden, shapely.box(*window)))
