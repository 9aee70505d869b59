"""Opaque faces and curves on them, in true depth order, on axes with three dimensions.

Faces are drawn by PyVista where it is installed (the extra ``render``), and else by matplotlib, as vectors, from back
to front. Curves are vectors always: those parts of them that no face hides. Both see what the axes' camera sees.
"""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any, Literal, cast

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from mpl_toolkits.mplot3d import proj3d
from numpy.typing import NDArray

from cfree.errors import UnsupportedError
from cfree.plot.depth_sort import FOG
from cfree.plot.pieces import CURVE, SECTION, Floats, Pieces
from cfree.plot.visible import polylines, seen_parts

Renderer = Literal["matplotlib", "pyvista"]

MISSING = "surfaces in true depth order need PyVista: pip install 'cfree[render]'"


def best_renderer() -> Renderer:
    """PyVista where it is installed."""
    return "pyvista" if find_spec("pyvista") else "matplotlib"


def require(renderer: Renderer) -> None:
    """Raise UnsupportedError, which says how to get it, if a renderer is missing."""
    if renderer == "pyvista" and not find_spec("pyvista"):
        raise UnsupportedError(MISSING)


class Solid(PolyCollection):
    """Pieces of which the side that is turned away is not drawn.

    Parameters
    ----------
    pieces : Pieces
    renderer : "matplotlib" or "pyvista", optional
        The best there is, if not given.
    """

    def __init__(self, pieces: Pieces, renderer: Renderer | None = None) -> None:
        super().__init__([], closed=True, joinstyle="round", clip_on=False)
        self.pieces = pieces
        self.renderer = renderer
        self._flat: Floats = np.empty((0, 4, 3))
        self._rgb: Floats = np.empty((0, 3))
        self._curves = LineCollection([], capstyle="round", joinstyle="round", clip_on=False)

    def do_3d_projection(self) -> float:
        """Project, choose what is seen; called before each drawing."""
        pieces, axes = self.pieces, cast(Any, self.axes)
        if not len(pieces.corners):
            return 0.0
        x, y, z = proj3d.proj_transform(*pieces.corners.reshape(-1, 3).T, axes.M)
        flat = np.stack((x, y, np.asarray(z)), axis=-1).reshape(-1, 4, 3)
        depth = flat[..., 2].mean(axis=1)
        near, far = float(depth.min()), float(depth.max())
        p, q = flat[:, 2] - flat[:, 0], flat[:, 3] - flat[:, 1]
        front = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0] > 0
        fog = np.where(pieces.sort == SECTION, 0.0, FOG * (depth - near) / max(far - near, 1e-300))
        rgb = pieces.rgb + (1 - pieces.rgb) * fog[:, None]
        is_face = pieces.sort < CURVE
        order = np.flatnonzero(front & is_face)
        # a section is cut where all else ends: it hides what is behind it
        order = order[np.lexsort((-depth[order], pieces.sort[order] == SECTION))]
        self._flat, self._rgb = flat[order], rgb[order]
        self.set_verts(self._flat[..., :2], closed=True)  # type: ignore[arg-type]
        self.set_facecolor(self._rgb)  # type: ignore[arg-type]
        self.set_edgecolor(self._rgb)  # type: ignore[arg-type]
        self.set_linewidth(np.where(pieces.sort[order] == SECTION, 0.8, 0.4).tolist())  # hides seams
        self._choose_curves(flat, np.flatnonzero(~is_face & (front[pieces.owner] | (pieces.owner < 0))))
        return near

    def _choose_curves(self, flat: Floats, chosen: NDArray[np.int64]) -> None:
        """The parts of curves that are seen, as lines."""
        rows = np.column_stack((self.pieces.rgb, self.pieces.width))[chosen]
        looks, first, look = np.unique(rows, axis=0, return_index=True, return_inverse=True)
        # what was given later is drawn above
        rank = np.argsort(np.argsort(first))
        looks, look = looks[np.argsort(first)], rank[look.reshape(-1)]
        parts, seen = seen_parts(flat[chosen][:, :2], self._flat)
        lines, of = polylines(parts, seen, np.repeat(look, len(parts) // max(1, len(chosen))))
        above = np.argsort(of, kind="stable")
        lines, of = [lines[k] for k in above], [of[k] for k in above]
        self._curves.set_segments(lines)
        self._curves.set_color(looks[of, :3])  # type: ignore[arg-type]
        self._curves.set_linewidth(looks[of, 3].tolist())

    def shows(self, points: Floats) -> NDArray[np.bool_]:
        """Which of the points (n, 3), projected as the faces were last, no face hides."""
        parts, seen = seen_parts(np.stack((points, points), axis=1), self._flat)
        return seen.reshape(len(points), -1)[:, 0] if len(parts) else np.zeros(0, bool)

    def draw(self, renderer: Any) -> None:
        """Faces by the renderer that is chosen, curves above them."""
        if not self.get_visible():
            return
        if (self.renderer or best_renderer()) == "pyvista" and len(self._flat):
            self._draw_image(renderer)
        else:
            super().draw(renderer)
        axes: Any = self.axes
        self._curves.axes = axes
        self._curves.set_figure(axes.figure)
        self._curves.set_transform(axes.transData)
        self._curves.draw(renderer)

    def _draw_image(self, renderer: Any) -> None:
        from cfree.plot.rendered import image_of

        axes: Any = self.axes
        finer = renderer.get_image_magnification()
        flat = self._flat.copy()
        flat[..., :2] = axes.transData.transform(flat[..., :2].reshape(-1, 2)).reshape(-1, 4, 2)
        low = np.floor(flat.min(axis=(0, 1))[:2]) - 1
        size = np.ceil((flat.max(axis=(0, 1))[:2] - low + 1) * finer).astype(int)
        flat[..., :2] = (flat[..., :2] - low) * finer
        gc = renderer.new_gc()
        renderer.draw_image(gc, *low.tolist(), image_of(flat, self._rgb, (int(size[0]), int(size[1])))[::-1])
        gc.restore()
