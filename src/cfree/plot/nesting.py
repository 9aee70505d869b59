"""Pictures of layouts, and of no-fit and inner-fit regions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from cfree.libraries import Floats, shapely
from cfree.nesting.checking import overlaps, statement
from cfree.nesting.layout import Nesting
from cfree.nesting.nofit import NFP, InnerFit
from cfree.nesting.rounded import RoundedFit
from cfree.nesting.writing import fine
from cfree.palette import CATEGORIES, FORBIDDEN, FREE, INK, LOST, MARK, OBSTACLE_RIM, WALL, paler
from cfree.plot.names import put_inside
from cfree.plot.workspace import path_of
from cfree.scene.scene import AnyShape

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_LABELS = 60  # parts with their numbers


def picture_of_nesting(nesting: Nesting) -> Figure:
    """Draw sheets and parts, one panel for each used sheet; parts that overlap are red."""
    from matplotlib.figure import Figure

    found = overlaps(nesting)
    wrong = {k for one in found for k in one.parts}
    sheets: list[int | None] = [*nesting.used] if nesting.sheets else [None]
    sheets = sheets or [0]
    columns = min(len(sheets), 3)
    rows = -(-len(sheets) // columns)
    figure = Figure(figsize=(6.4 * columns, 4.8 * rows), layout="constrained")
    names = [*dict.fromkeys(one.part.name for one in nesting.placed)]
    colours = {name: paler(CATEGORIES[k % len(CATEGORIES)], 0.35) for k, name in enumerate(names)}
    for panel, sheet in enumerate(sheets):
        ax = figure.add_subplot(rows, columns, panel + 1)
        if sheet is not None:
            _draw(ax, nesting.sheets[sheet], facecolor=WALL, edgecolor=INK, linewidth=1.2, zorder=0)
            ax.set_title(f"sheet {sheet}" if len(nesting.sheets) > 1 else "", fontsize=10)
        for k, one in enumerate(nesting.placed):
            if sheet is None or one.sheet == sheet:
                colour = LOST if k in wrong else colours[one.part.name]
                for shape in one.shapes:
                    _draw(ax, shape, facecolor=colour, edgecolor=OBSTACLE_RIM, linewidth=0.6, alpha=0.9)
        ax.set_xlabel(nesting.units)
        _finish(ax)
    share = f"{100 * nesting.density:.1f} % of the used sheets; " if nesting.sheets else ""
    left = sum(part.quantity for part in nesting.left)
    figure.suptitle(f"{share}{statement(found)}{f'; {left} left' if left else ''}", fontsize=11)
    if len(nesting.placed) <= MOST_LABELS:
        figure.draw_without_rendering()  # gives the axes their places
        for ax, sheet in zip(figure.axes, sheets, strict=True):
            for k, one in enumerate(nesting.placed):
                if sheet is None or one.sheet == sheet:
                    _number(ax, k, fine(one.shapes[0])[0].to_shapely())
    return figure


def picture_of_fit(fit: NFP | InnerFit | RoundedFit) -> Figure:
    """Draw the positions at which a part overlaps, or is inside, and mark exact fits."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 4.8), layout="constrained")
    ax = figure.add_subplot()
    if isinstance(fit, RoundedFit):
        for line in fit.lines:
            ax.plot(*np.asarray(line).T, color=INK, linewidth=1.2)
    else:
        rings = [np.array([[float(c) for c in p] for p in ring]) for ring in fit.rings]
        fill = FREE if isinstance(fit, InnerFit) else FORBIDDEN
        if rings:
            from matplotlib.patches import PathPatch

            ax.add_patch(PathPatch(path_of(rings), facecolor=fill, edgecolor=INK, linewidth=1.2))
    for segment in fit.segments:
        ax.plot(*np.array([[float(c) for c in p] for p in segment]).T, color=MARK, linewidth=2.5)
    for p in fit.points:
        ax.plot(float(p[0]), float(p[1]), "o", color=MARK, markersize=6)
    ax.set_title(repr(fit).strip("<>"), fontsize=10)
    _finish(ax)
    return figure


def _draw(ax: Axes, shape: AnyShape, **style: Any) -> None:
    from matplotlib.patches import PathPatch

    rings: list[Floats] = [ring for polygon in fine(shape) for ring in polygon.rings]
    ax.add_patch(PathPatch(path_of(rings), **style))


def _number(ax: Axes, k: int, part: shapely.Geometry) -> None:
    """Write a part's number on it."""
    point = part.representative_point()
    text = ax.text(point.x, point.y, str(k), ha="center", va="center", fontsize=7, color=INK)
    put_inside(ax, text, part)


def _finish(ax: Axes) -> None:
    ax.set_aspect("equal")
    ax.autoscale_view()
    ax.margins(0.03)
