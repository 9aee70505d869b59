"""Figure 19: lines of curvature and asymptotic lines of an e-v patch."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from mpl_toolkits.mplot3d.axes3d import Axes3D

from cfree.arguments import checked
from cfree.contact.contact import angle_range
from cfree.figures.curvature import OBSTACLE, ROBOT, SURFACE
from cfree.figures.space import Floats, around, curve, draw_frame, grid, legend, paint, set_space, sheet
from cfree.geometry.local import LocalGeometry, local_geometry
from cfree.palette import EDGE_VERTEX, FRAME, INK, VERTEX_EDGE, paler
from cfree.plot.pieces import Pieces

Family = Callable[[LocalGeometry], float]
"""A function from the forms at a point to a direction there."""

PHI = angle_range(ROBOT, OBSTACLE, SURFACE.contact)
STEP = 0.01  # step of arc length
LINES = 14  # lines of a family


@checked
def lines_of_curvature(ax: Axes3D) -> Axes3D:
    """Figure 19: lines of curvature, which cross at right angles."""
    _draw(ax, families("principal_directions"), (VERTEX_EDGE, INK))
    legend(ax, [("-" + VERTEX_EDGE, r"along $\xi_1$"), ("-" + INK, r"along $\xi_2$")])
    return ax


@checked
def asymptotic_lines(ax: Axes3D) -> Axes3D:
    """Figure 19: asymptotic lines: the rulings, and another family."""
    _draw(ax, families("asymptotic_directions"), (FRAME, INK))
    legend(ax, [("-" + FRAME, r"rulings, $\xi = 0$"), ("-" + INK, r"along $\xi = \arctan\frac{2v}{F}$")])
    return ax


def families(name: str) -> list[Family]:
    """Return the two directions that forms have under a name."""
    return [lambda at, k=k: float(getattr(at, name)[k]) for k in (0, 1)]  # type: ignore[misc]


def _draw(ax: Axes3D, chosen: Sequence[Family], colours: tuple[str, str]) -> None:
    t, phi = np.linspace(0, 1, 25), np.linspace(PHI.phi_min, PHI.phi_max, 91)
    points = grid(SURFACE, t, phi)
    ends = math.degrees(phi[0]) - 10, math.degrees(phi[-1]) + 10
    set_space(ax, around(points, 0.25), angle_scale=1.0, degrees=ends, zoom=0.95)
    draw_frame(ax)
    parts: list[Pieces] = [sheet(points, paler(EDGE_VERTEX, 0.5), 1.0)]
    for family, colour in zip(chosen, colours, strict=True):
        parts += [curve(SURFACE(*rows.T), colour, 1.3) for rows in lines_along(family)]
    paint(ax, parts)


def lines_along(family: Family) -> list[Floats]:
    """Return lines, rows t and phi, that follow a direction over the patch.

    Forms do not depend on phi: one line, moved along phi, gives all of a family. A family of constant t consists of
    helices.
    """
    one = np.concatenate((_trace(family, -1.0)[:0:-1], _trace(family, 1.0)))
    low, high = PHI.phi_min - one[:, 1].max(), PHI.phi_max - one[:, 1].min()
    lines = []
    for shift in np.linspace(low, high, LINES + 2)[1:-1]:
        moved = one + np.array([0.0, shift])
        inside = moved[(moved[:, 1] >= PHI.phi_min) & (moved[:, 1] <= PHI.phi_max)]
        if len(inside) > 3:
            lines.append(inside)
    return lines


def _trace(family: Family, sign: float) -> Floats:
    """Trace rows t and phi from the middle ruling to the end of the edge, or over the patch's height."""
    rows = [np.array([0.5, 0.0])]
    while 0 <= rows[-1][0] <= 1 and abs(rows[-1][1]) < math.tau and len(rows) < 2000:
        middle = rows[-1] + 0.5 * STEP * sign * _rate(family, rows[-1][0])
        rows.append(rows[-1] + STEP * sign * _rate(family, middle[0]))
    trace = np.array(rows)
    trace[:, 0] = trace[:, 0].clip(0, 1)
    return trace


def _rate(family: Family, t: float) -> Floats:
    """Return the rates of t and phi by length in a direction; xi is measured from S_t in the tangent plane."""
    forms = local_geometry(SURFACE.ruled, min(max(t, 0.0), 1.0), 0.0)
    xi, E, F, v = family(forms), float(forms.E), float(forms.F), float(forms.v)
    across = math.sin(xi) / v
    return np.array([math.cos(xi) / math.sqrt(E) - F * across / math.sqrt(E), math.sqrt(E) * across])
