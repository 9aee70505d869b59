"""Faces and curves in three dimensions, drawn from back to front.

They are in one list, sorted by depth each time the view changes. The free side of a patch is shaded and opaque; the
forbidden side is a ghost, so that one looks through the near walls into the free space, as into a doll's house. At
theta = 360 degrees the forbidden space is cut: the section is grey.
"""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from matplotlib.collections import PolyCollection
from mpl_toolkits.mplot3d import proj3d

from cfree.plot.pieces import CURVE, ON_TOP, OVER, SECTION, WALL, Floats, Pieces

AHEAD = 0.012  # of the depth: curves lie on their faces, whose middles may be nearer
FOG = 0.25
GLASS, GHOST, DIMMEST, SOLID = 0.3, 0.06, 0.35, 0.9


class Painting(PolyCollection):
    """The pieces on axes with three dimensions.

    Parameters
    ----------
    pieces : Pieces
    ghost : float
        Opacity of the side of a face that is turned away.
    opacity : float or (n,) float64
        Of all pieces, or of each.
    """

    def __init__(self, pieces: Pieces, ghost: float = GHOST, opacity: Floats | float = 1.0) -> None:
        super().__init__([], closed=True, joinstyle="round")
        self._pieces = pieces
        self._ghost = ghost
        self._opacity = opacity

    def do_3d_projection(self) -> float:
        """Project, choose what is seen, sort by depth; called before each drawing."""
        corners, axes = self._pieces.corners, cast(Any, self.axes)
        if not len(corners):
            return 0.0
        x, y, z = proj3d.proj_transform(*corners.reshape(-1, 3).T, axes.M)
        flat, depth = np.stack((x, y), axis=-1).reshape(-1, 4, 2), np.asarray(z).reshape(-1, 4).mean(axis=1)
        span = float(depth.min()), float(depth.max())
        paint(self, self._pieces, flat, depth, span, ghost=self._ghost, opacity=self._opacity)
        return span[0]


def paint(
    onto: PolyCollection, pieces: Pieces, flat: Floats, depth: Floats, span: tuple[float, float], *,
    ghost: float, opacity: Floats | float = 1.0,
) -> None:  # fmt: skip
    """Put pieces into a collection, from back to front.

    Parameters
    ----------
    onto : PolyCollection
    pieces : Pieces
    flat : (n, 4, 2) float64
        Their corners as the eye sees them.
    depth : (n,) float64
        How far their middles are.
    span : (float, float)
        Nearest and farthest depth of all there may be.
    ghost : float
        Opacity of the side of a face that is turned away.
    opacity : float or (n,) float64
        Of all, or of each; curves that are always seen are not fainter than `DIMMEST`.
    """
    near, far = span
    p, q = flat[:, 2] - flat[:, 0], flat[:, 3] - flat[:, 1]
    front = (p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0] > 0)[pieces.owner] | (pieces.owner < 0)
    is_curve = pieces.sort >= CURVE

    clear = np.isin(pieces.sort, (SECTION, ON_TOP, OVER))
    fog = np.where(clear, 0.0, FOG * np.clip((depth - near) / max(far - near, 1e-300), 0, 1))
    rgb = pieces.rgb + (1 - pieces.rgb) * fog[:, None]
    alpha = np.where(front, 1.0, ghost)
    alpha[pieces.sort == WALL] = np.where(front[pieces.sort == WALL], GLASS, 0)
    alpha[(pieces.sort == CURVE) & ~front] = 0
    alpha *= opacity
    free = is_curve & (pieces.owner < 0)
    alpha[free] = np.broadcast_to(np.maximum(opacity, DIMMEST), len(alpha))[free]
    rank = depth - AHEAD * (far - near) * (is_curve + 1.0 * (pieces.sort == OVER))
    rank[pieces.sort == SECTION] += np.where(front[pieces.sort == SECTION], -10, 10) * (far - near)
    rank[pieces.sort == ON_TOP] -= 20 * (far - near)
    order = np.argsort(-rank, kind="stable")
    order = order[alpha[order] > 0]

    fill, rim = (np.column_stack((rgb, part)) for part in (np.where(is_curve, 0, alpha), alpha))
    glass = (alpha < SOLID) & ~is_curve
    rim[glass, 3] = 0  # where faces are seen through, their rims would be twice as dark
    onto.set_verts(flat[order], closed=True)  # type: ignore[arg-type]
    onto.set_facecolor(fill[order])  # type: ignore[arg-type]
    onto.set_edgecolor(rim[order])  # type: ignore[arg-type]
    onto.set_antialiased((~glass)[order].tolist())  # smoothed on both sides a common edge of glass would be seen
    onto.set_linewidth(np.where(is_curve, pieces.width, 0.4)[order].tolist())
