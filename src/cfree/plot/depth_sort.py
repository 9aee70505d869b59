"""Faces and curves in three dimensions: those in front hide those behind.

The free side of a patch is shaded and opaque; the forbidden side is a ghost, or is not drawn at all. So the near walls
show the free space behind them, as in a doll's house. The section of the forbidden space at theta = 360 degrees is
grey.

PyVista draws faces where it is installed (the extra ``render``): as pixels, each in its true depth. Otherwise
matplotlib draws them from back to front, sorted each time the view changes. Curves are lines above the faces, vectors
in vector formats: the parts of them that no opaque face hides. Both renderers use the camera of the axes.
"""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from matplotlib.artist import allow_rasterization
from matplotlib.collections import LineCollection, PolyCollection
from mpl_toolkits.mplot3d import proj3d
from numpy.typing import NDArray

from cfree.plot.pieces import CURVE, ON_TOP, OVER, SECTION, WALL, Floats, Pieces
from cfree.plot.rendered import Renderer, best_renderer, image_of
from cfree.plot.visible import polylines, seen_parts

AHEAD = 0.012  # share of the depth: curves lie on their faces, whose middles may be nearer
FOG = 0.25
GLASS, GHOST, DIMMEST, SOLID = 0.3, 0.06, 0.35, 0.9
RIM = 0.6  # width of the faces' rims, in typographic points: they hide seams
HIDING = 0.5  # least opacity of a face that hides curves


class Painting(PolyCollection):
    """The pieces on axes with three dimensions.

    Parameters
    ----------
    pieces : Pieces
    ghost : float
        Opacity of the side of a face that is turned away.
    opacity : float or (n,) float64
        Opacity of all pieces, or of each.
    renderer : "matplotlib" or "pyvista", optional
        The renderer of faces; by default the best installed one.
    """

    def __init__(
        self, pieces: Pieces, ghost: float = GHOST, opacity: Floats | float = 1.0, renderer: Renderer | None = None
    ) -> None:
        super().__init__([], closed=True, joinstyle="round")
        self.renderer = renderer
        self._pieces = pieces
        self._ghost = ghost
        self._opacity = opacity
        self._faces: Floats = np.empty((0, 4, 3))
        self._rgba: Floats = np.empty((0, 4))
        self._lines = LineCollection([], capstyle="round", joinstyle="round")

    def do_3d_projection(self) -> float:
        """Project and choose the visible pieces; called before each drawing."""
        pieces, axes = self._pieces, cast(Any, self.axes)
        if not len(pieces.corners):
            return 0.0
        x, y, z = proj3d.proj_transform(*pieces.corners.reshape(-1, 3).T, axes.M)
        flat = np.stack((x, y, np.asarray(z)), axis=-1).reshape(-1, 4, 3)
        depth = flat[..., 2].mean(axis=1)
        span = float(depth.min()), float(depth.max())
        look = _Look(pieces, flat[..., :2], depth, span, self._ghost, self._opacity)
        faces = look.order[pieces.sort[look.order] < CURVE]
        look.put(self, flat[..., :2], faces)
        self._faces, self._rgba = flat[faces], np.column_stack((look.rgb, look.alpha))[faces]
        curves = np.flatnonzero((pieces.sort >= CURVE) & (look.alpha > 0))
        self._choose_lines(flat[curves][:, :2], pieces.sort[curves], look, curves)
        return span[0]

    def _choose_lines(self, ends: Floats, sort: NDArray[np.int64], look: _Look, curves: NDArray[np.int64]) -> None:
        """Choose and join the visible parts of curves, in the order of their sort, later ones above."""
        rows = np.column_stack((sort, look.rgb[curves], look.alpha[curves], look.pieces.width[curves]))
        looks, first, look_of_curve = np.unique(rows, axis=0, return_index=True, return_inverse=True)
        above = np.argsort(np.lexsort((first, looks[:, 0])))
        parts, seen = seen_parts(ends, self._faces[self._rgba[:, 3] >= HIDING])
        count = len(parts) // max(1, len(ends))
        seen |= np.repeat(sort == ON_TOP, count)
        lines, number = polylines(parts, seen, np.repeat(look_of_curve.reshape(-1), count))
        order = np.argsort(above[number], kind="stable") if lines else np.empty(0, np.int64)
        shown = looks[np.array(number, dtype=np.int64)[order]]
        self._lines.set_segments([lines[k] for k in order.tolist()])
        self._lines.set_color(shown[:, 1:5])  # type: ignore[arg-type]
        self._lines.set_linewidth(shown[:, 5].tolist())

    def shows(self, points: Floats) -> NDArray[np.bool_]:
        """Return True for each of the points (n, 3) that no face hides, by the last projection of the faces."""
        _, seen = seen_parts(np.stack((points, points), axis=1), self._faces)
        return seen.reshape(len(points), -1)[:, 0]

    def draw(self, renderer: Any) -> None:
        """Draw faces by the chosen renderer, and curves above them."""
        if not self.get_visible():
            return
        self._draw_faces(renderer)
        axes: Any = self.axes
        lines = self._lines
        lines.axes = axes
        lines.set_figure(axes.figure)
        lines.set_transform(axes.transData)
        lines.set_clip_on(self.get_clip_on())
        lines.set_clip_path(self.get_clip_path())
        lines.clipbox = self.clipbox
        lines.draw(renderer)

    draw._supports_rasterization = True  # type: ignore[attr-defined]  # of faces; lines stay lines

    @allow_rasterization  # type: ignore[untyped-decorator]
    def _draw_faces(self, renderer: Any) -> None:
        if (self.renderer or best_renderer()) == "pyvista" and len(self._faces):
            self._draw_image(renderer)
        else:
            super().draw(renderer)

    def _draw_image(self, renderer: Any) -> None:
        """Draw the faces within the figure, as fine as the renderer's pixels."""
        axes: Any = self.axes
        finer = renderer.get_image_magnification()
        faces = self._faces.copy()
        faces[..., :2] = axes.transData.transform(faces[..., :2].reshape(-1, 2)).reshape(-1, 4, 2)
        all_of_it = faces[..., :2].reshape(-1, 2)
        low = np.maximum(np.floor(all_of_it.min(axis=0)) - 1, 0)
        high = np.minimum(np.ceil(all_of_it.max(axis=0)) + 1, axes.figure.bbox.max)
        if not (low < high).all():
            return
        width, height = np.ceil((high - low) * finer).astype(int).tolist()
        faces[..., :2] = (faces[..., :2] - low) * finer
        gc = renderer.new_gc()
        cast(Any, self)._set_gc_clip(gc)
        renderer.draw_image(gc, *low.tolist(), image_of(faces, self._rgba, (width, height))[::-1])
        gc.restore()


def paint(
    onto: PolyCollection, pieces: Pieces, flat: Floats, depth: Floats, span: tuple[float, float], *,
    ghost: float, opacity: Floats | float = 1.0,
) -> None:  # fmt: skip
    """Put pieces into a collection, faces and curves from back to front.

    Parameters
    ----------
    onto : PolyCollection
    pieces : Pieces
    flat : (n, 4, 2) float64
        Their corners, projected by the camera.
    depth : (n,) float64
        Depths of their middles.
    span : (float, float)
        Nearest and farthest depth possible.
    ghost : float
        Opacity of the side of a face that is turned away.
    opacity : float or (n,) float64
        Opacity of all, or of each; curves that are always visible are not fainter than `DIMMEST`.
    """
    look = _Look(pieces, flat, depth, span, ghost, opacity)
    look.put(onto, flat, look.order)


class _Look:
    """Colours and opacities of pieces as the camera sees them, and their order from back to front."""

    def __init__(
        self, pieces: Pieces, flat: Floats, depth: Floats, span: tuple[float, float], ghost: float,
        opacity: Floats | float,
    ) -> None:  # fmt: skip
        near, far = span
        p, q = flat[:, 2] - flat[:, 0], flat[:, 3] - flat[:, 1]
        self.pieces = pieces
        self.is_curve = is_curve = pieces.sort >= CURVE
        front = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0] > 0
        front = np.where(is_curve, front[pieces.owner] | (pieces.owner < 0), front)

        clear = np.isin(pieces.sort, (SECTION, ON_TOP, OVER))
        fog = np.where(clear, 0.0, FOG * np.clip((depth - near) / max(far - near, 1e-300), 0, 1))
        self.rgb = pieces.rgb + (1 - pieces.rgb) * fog[:, None]
        alpha = np.where(front, 1.0, ghost)
        alpha[pieces.sort == WALL] = np.where(front[pieces.sort == WALL], GLASS, 0)
        alpha[(pieces.sort == CURVE) & ~front] = 0
        alpha *= opacity
        free = is_curve & (pieces.owner < 0)
        alpha[free] = np.broadcast_to(np.maximum(opacity, DIMMEST), len(alpha))[free]
        self.alpha = alpha
        rank = depth - AHEAD * (far - near) * (is_curve + 1.0 * (pieces.sort == OVER))
        rank[pieces.sort == SECTION] += np.where(front[pieces.sort == SECTION], -10, 10) * (far - near)
        rank[pieces.sort == ON_TOP] -= 20 * (far - near)
        order = np.argsort(-rank, kind="stable")
        self.order = order[alpha[order] > 0]

    def put(self, onto: PolyCollection, flat: Floats, order: NDArray[np.int64]) -> None:
        """Put pieces into a collection, in an order."""
        is_curve, alpha = self.is_curve, self.alpha
        fill, rim = (np.column_stack((self.rgb, part)) for part in (np.where(is_curve, 0, alpha), alpha))
        rim[(alpha < SOLID) & ~is_curve, 3] = 0  # rims of transparent faces would be twice as dark
        onto.set_verts(flat[order], closed=True)  # type: ignore[arg-type]
        onto.set_facecolor(fill[order])  # type: ignore[arg-type]
        onto.set_edgecolor(rim[order])  # type: ignore[arg-type]
        # one width for all if there are only faces: matplotlib is slow with many
        width = np.where(is_curve, self.pieces.width, RIM)[order]
        onto.set_linewidth(width.tolist() if is_curve[order].any() else RIM)
