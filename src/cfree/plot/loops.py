"""Loops on the closed surfaces of a cell, drawn among its contact patches."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from mpl_toolkits.mplot3d.axes3d import Axes3D
from numpy.typing import NDArray

from cfree.arguments import checked
from cfree.free.loops import Loop, surface_loops
from cfree.free.space import Cell
from cfree.palette import CATEGORIES
from cfree.plot.boundary import plot_boundary
from cfree.words import counted

SAMPLES = 12  # points along a curve of a trapezoid
ROUNDING = 1e-9


@checked
def plot_loops(cell: Cell, ax: Axes3D | None = None) -> Axes3D:
    """Draw loops on the surfaces of a cell, whose classes generate its first homology group, among the patches.

    Parameters
    ----------
    cell : Cell
    ax : matplotlib axes with ``projection="3d"``, optional

    Returns
    -------
    matplotlib axes with three dimensions
        The title has the cell's Betti numbers. Patches hide no loop.

    Examples
    --------
    >>> import cfree
    >>> scene = cfree.Scene([(0, 0), (1, 0), (0, 1)], workspace=[(0, 0), (9, 0), (9, 9), (0, 9)])
    >>> ax = plot_loops(cfree.free_space(cfree.boundary(scene)).cells[0])
    >>> ax.get_title()
    'cell 0: b0 = 1, b1 = 1, b2 = 0; 2 loops on 1 closed surface'
    """
    ax = plot_boundary(cell.free_space.surfaces, ax)
    loops = surface_loops(cell)
    for k, loop in enumerate(loops):
        for x, y, theta in _lines(cell, loop):
            colour = CATEGORIES[k % len(CATEGORIES)]
            ax.plot(x, y, np.degrees(theta), color="white", linewidth=4, zorder=1e6 + 2 * k)
            ax.plot(x, y, np.degrees(theta), color=colour, linewidth=2.2, zorder=1e6 + 2 * k + 1)
    numbers = cell.homology
    title = f"cell {cell.index}: b0 = {numbers.b0}, b1 = {numbers.b1}, b2 = {numbers.b2}"
    surfaces = counted(len(cell.components), "closed surface")
    ax.set_title(f"{title}; {counted(len(loops), 'loop')} on {surfaces}")
    return ax


def _lines(cell: Cell, loop: Loop) -> list[NDArray[np.float64]]:
    """Return the lines of a loop, rows x, y and theta in [0, 2 pi], cut where theta goes on at 0."""
    complex, surfaces = cell.free_space.complex, cell.free_space.surfaces
    points: list[NDArray[np.float64]] = [loop.points[:1].T]
    for h, (start, stop) in zip(loop.coedges.tolist(), pairwise(loop.points), strict=True):
        if complex.side[h] in (1, 3) and start[2] != stop[2]:
            face = int(complex.face[h])
            theta = np.linspace(start[2], stop[2], SAMPLES)[1:-1]
            faces = np.full(len(theta), face)
            limits = surfaces.limits(faces, theta)[0 if complex.side[h] == 3 else 1]
            xy = surfaces.evaluate(surfaces.trapezoids.patch[faces], limits, theta)
            points.append(np.vstack([xy.T, theta]))
        points.append(stop[:, None])
    line = np.concatenate(points, axis=1)
    low, high = line[2].min() / math.tau, line[2].max() / math.tau
    for turn in range(math.ceil(low), math.floor(high) + 1):  # poses at whole turns end one line and begin another
        for k in np.flatnonzero((line[2, :-1] - math.tau * turn) * (line[2, 1:] - math.tau * turn) < 0)[::-1].tolist():
            share = (math.tau * turn - line[2, k]) / (line[2, k + 1] - line[2, k])
            line = np.insert(line, k + 1, line[:, k] + share * (line[:, k + 1] - line[:, k]), axis=1)
    middle = np.floor((line[2, :-1] + line[2, 1:]) / 2 / math.tau + ROUNDING)
    lines = []
    for steps in np.split(np.arange(len(middle)), np.flatnonzero(np.diff(middle)) + 1):
        part = line[:, steps[0] : steps[-1] + 2].copy()
        part[2] -= math.tau * middle[steps[0]]
        lines.append(part)
    return lines
