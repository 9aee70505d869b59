"""Pictures of contact surfaces that meet: two with their curve, three with the poses on all of them."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import combinations
from typing import Any

import numpy as np
from mpl_toolkits.mplot3d.axes3d import Axes3D
from numpy.typing import NDArray

from cfree.arguments import checked
from cfree.arrangements.intersections import Intersection, intersection
from cfree.arrangements.triples import Triple
from cfree.contact.contact import VertexEdge
from cfree.exact.angle_interval import AngleInterval
from cfree.exact.orientation import Location
from cfree.forbidden.kinds import COLOURS, PatchKind
from cfree.palette import EDGE_EDGE, INK
from cfree.plot.boundary import new_figure, new_space, set_space
from cfree.plot.depth_sort import Painting
from cfree.plot.pieces import joined, of_sheet
from cfree.rational.model import RationalSurface

Floats = NDArray[np.float64]

ROWS, CELLS, POINTS = 121, 13, 721  # samples of a surface over a full turn, across it, and of a curve
SEEN_THROUGH = 0.75
NAMES = {PatchKind.VERTEX_EDGE: "v-e", PatchKind.EDGE_VERTEX: "e-v"}


@checked
def plot_intersection(found: Intersection | Triple, ax: Axes3D | None = None) -> Axes3D:
    """Draw the surfaces of an intersection, or of three contacts, and their common points, theta upwards.

    Parameters
    ----------
    found : Intersection or Triple
    ax : matplotlib axes with ``projection="3d"``, optional

    Returns
    -------
    matplotlib axes with three dimensions

    Notes
    -----
    v-e surfaces are orange, e-v surfaces blue; a `RationalSurface` is drawn as its patch. Curves are black where they
    are on both surfaces, and thin where edges count as lines. Poses on three surfaces are dots, hollow if an edge or
    patch ends before.
    """
    if ax is None:
        ax = new_space(new_figure((7, 7.5)), (0.02, 0.09, 0.9, 0.9))
    space: Any = ax
    space.computed_zorder = False
    sheets = [_sheet(surface) for surface in found.surfaces]
    points = np.concatenate([sheet.reshape(-1, 3) for sheet in sheets])
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 0.05 * max(*(high - low)[:2], 1e-300)
    window = low[:2] - margin, high[:2] + margin
    kinds = _draw_sheets(space, found, sheets)
    if isinstance(found, Intersection):
        _draw_pair(space, found, window)
    else:
        for pair in combinations(found.surfaces, 2):
            _draw_pair(space, intersection(*pair), window)
        _draw_poses(space, found)
    set_space(space, (*window[0].tolist(), *window[1].tolist()), "", height=1.1, zoom=1.0)
    handles = {artist.get_label(): artist for artist in (*kinds, *space.lines)}
    shown = {name: handle for name, handle in handles.items() if not name.startswith("_")}
    space.legend(shown.values(), shown.keys(), loc="upper center", bbox_to_anchor=(0.5, -0.01), ncols=3, frameon=False)
    return ax


def _kind(surface: Any) -> PatchKind:
    contact = surface.surface.contact if isinstance(surface, RationalSurface) else surface.contact
    return PatchKind.VERTEX_EDGE if isinstance(contact, VertexEdge) else PatchKind.EDGE_VERTEX


def _sheet(surface: Any) -> Floats:
    """Sample points (rows, CELLS, 3) of a surface, or of its patch, theta in degrees, with a row at a full turn."""
    low, high = 0.0, math.tau
    if isinstance(surface, RationalSurface):
        if surface.Phi is None:
            return np.empty((0, CELLS, 3))
        low = surface.Phi.start.theta % math.tau
        high = low + (surface.Phi.end.theta - surface.Phi.start.theta) % math.tau
    S = surface.surface if isinstance(surface, RationalSurface) else surface
    theta = np.linspace(low, high, ROWS)
    theta = np.union1d(theta, [math.tau]) if low < math.tau < high else theta
    rows: Floats = S(np.linspace(0, 1, CELLS), theta[:, None]) * (1, 1, 180 / math.pi)
    return rows


def _draw_sheets(space: Any, found: Intersection | Triple, sheets: list[Floats]) -> list[Any]:
    """Draw all surfaces, each half transparent; return legend handles of their colours."""
    from matplotlib.patches import Patch

    kinds = [_kind(surface) for surface, sheet in zip(found.surfaces, sheets, strict=True) if len(sheet)]
    parts = [of_sheet(p, COLOURS[kind], 1.0) for p, kind in zip([p for p in sheets if len(p)], kinds, strict=True)]
    if parts:
        pieces = joined(parts)
        turned = _turned(pieces.corners, pieces.corners[..., 2].mean(axis=1))
        painting = Painting(replace(pieces, corners=turned), ghost=0, opacity=SEEN_THROUGH)
        painting.set_zorder(1)
        space.add_collection(painting, autolim=False)
    return [Patch(color=COLOURS[kind], alpha=SEEN_THROUGH, label=NAMES[kind]) for kind in NAMES if kind in kinds]


def _turned(faces: Floats, degrees: Floats) -> Floats:
    """Return faces beyond a full turn, lowered by a turn."""
    lower: Floats = faces - np.stack((*np.zeros((2, len(faces))), 360.0 * (degrees > 360)), axis=-1)[:, None]
    return lower


def _draw_pair(space: Any, pair: Intersection, window: tuple[Floats, Floats]) -> None:
    """Draw the curve, thin within the window, thick where it is on both surfaces; and shared lines."""
    drawn = {line.get_label() for line in space.lines}

    def draw(points: Floats, name: str, **look: Any) -> None:
        space.plot(*(points * (1, 1, 180 / math.pi)).T, label=f"_{name}" if name in drawn else name, **look)
        drawn.add(name)

    if pair.curve is not None:
        points = pair.curve(np.linspace(0, math.tau, POINTS))
        outside = ((points[:, :2] < window[0]) | (points[:, :2] > window[1])).any(axis=1)
        points[outside, :2] = np.nan
        draw(points, "edges as lines", color=INK, linewidth=0.7, linestyle=(0, (4, 3)), zorder=2)
        for part in pair.ranges:
            for low, high in _within_a_turn(part):
                draw(pair.curve(np.linspace(low, high, POINTS)), "curve on both", color=INK, linewidth=2.4, zorder=3)
    for line in pair.lines:
        if line.t_range is not None:
            surface = pair.surfaces[0]
            S = surface.surface if isinstance(surface, RationalSurface) else surface
            draw(S(line.t_range, line.angle.theta), "shared line", color=EDGE_EDGE, linewidth=2.4, zorder=4)


def _within_a_turn(part: AngleInterval) -> list[tuple[float, float]]:
    start, stop = part.theta
    return [(start, stop)] if stop <= math.tau else [(start, math.tau), (0.0, stop - math.tau)]


def _draw_poses(space: Any, found: Triple) -> None:
    for is_contact, name, fill in ((True, "three contacts", INK), (False, "three, edges as lines", "white")):
        chosen = [pose for pose in found.poses if (pose.location is not Location.OUTSIDE) == is_contact]
        if chosen:
            points = np.array([(*pose.xy, math.degrees(pose.angle.theta)) for pose in chosen])
            space.plot(
                *points.T, "o", color=INK, markerfacecolor=fill, markersize=7, label=name, zorder=5, linestyle="none"
            )
