"""One contact surface in both models, side by side: section 5's trade-off in a figure.

Both have the same grid: helices, and rulings every 10 degrees. The geometrical model has it even, with every angle. The
rational model is exact throughout, but equal angles take ever more room; the half turn is at infinity.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.colors import to_rgba_array
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cfree.arguments import checked
from cfree.contact.contact import EdgeVertex, VertexEdge
from cfree.contact.surface import Surface, contact_surface
from cfree.exact.orientation import Location
from cfree.forbidden.kinds import COLOURS, PatchKind
from cfree.palette import FAINT, INK, LIGHT, RIM, WALL
from cfree.polygons.polygon import Polygon
from cfree.rational.model import RationalRange, rational_range, to_rational

Floats = NDArray[np.float64]

SHOWN = 4  # the rational model is drawn for |tau| <= SHOWN
TICKS = (-4, -2, -1, 0, 1, 2, 4)
STEP, HELICES, SIDE = 10, 8, 6  # degrees between rulings, strips between helices, points on a side of a cell


@checked
def plot_models(robot: Polygon, obstacle: Polygon, contact: VertexEdge | EdgeVertex) -> Figure:
    """Draw a contact surface in the geometrical and in the rational model; its patch in colour, the rest grey.

    Parameters
    ----------
    robot, obstacle : Polygon
    contact : VertexEdge or EdgeVertex
        A contact that has a patch.

    Returns
    -------
    matplotlib figure
        The rational model is cut off at tau = -4 and 4, which is about 152 degrees.

    Raises
    ------
    ValueError
        If the vertex is reflex: it has no patch.
    """
    import mpl_toolkits.mplot3d  # noqa: F401  registers the projection
    from matplotlib import rc_context
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    S, Phi = contact_surface(robot, obstacle, contact), rational_range(robot, obstacle, contact)
    figure = Figure(figsize=(11, 5.8), facecolor="white")
    with rc_context({"grid.color": FAINT, "grid.linewidth": 0.6}):
        geometrical: Any = figure.add_axes((0.01, 0.09, 0.46, 0.85), projection="3d")
        rational: Any = figure.add_axes((0.48, 0.09, 0.46, 0.85), projection="3d")
    colour = COLOURS[PatchKind.VERTEX_EDGE if isinstance(contact, VertexEdge) else PatchKind.EDGE_VERTEX]

    corners, on_patch = cells(S, Phi, 180)
    _draw(geometrical, corners * (1, 1, 180 / math.pi), np.where(on_patch, colour, RIM), 180)
    geometrical.set_zticks(range(-180, 181, 90), labels=[f"{angle}°" for angle in range(-180, 181, 90)])
    geometrical.tick_params(axis="z", pad=7)
    geometrical.set_zlabel("θ", labelpad=10)

    corners, on_patch = cells(S, Phi, math.degrees(2 * math.atan(SHOWN)))
    _draw(rational, to_rational(corners), np.where(on_patch, colour, RIM), SHOWN)
    rational.set_zticks(TICKS, labels=[f"{tau} ({math.degrees(2 * math.atan(tau)):.0f}°)" for tau in TICKS])
    rational.tick_params(axis="z", pad=15)
    rational.set_zlabel("τ = tan(θ/2)", labelpad=26)

    figure.text(0.24, 0.95, "geometrical model: even, not exact", ha="center", fontsize=12)
    figure.text(0.71, 0.95, "rational model: exact, not even", ha="center", fontsize=12)
    kind = "v-e" if isinstance(contact, VertexEdge) else "e-v"
    names = {colour: f"patch: {kind} contacts, angle in Φ", RIM: "the rest of the surface: pseudo contacts"}
    handles = [Patch(color=shade, label=name) for shade, name in names.items()]
    figure.legend(handles=handles, loc="lower center", ncols=2, frameon=False)
    return figure


def cells(S: Surface, Phi: RationalRange, limit: float) -> tuple[Floats, NDArray[np.bool_]]:
    """Return outlines (n, 2 SIDE, 3) of cells between helices and rulings, theta in [-pi, pi], and the patch's mask."""
    ends = [math.degrees(Phi.start.theta), math.degrees(Phi.end.theta)]
    even = range(-180, 181, STEP)
    degrees = np.unique([angle for angle in (*even, *ends, -limit, limit) if abs(angle) <= limit])
    middle = np.tan(np.radians(degrees[:-1] + degrees[1:]) / 4)
    is_patch = [Phi.locate(tau) is not Location.OUTSIDE for tau in middle]
    along = np.linspace(0, 1, SIDE)
    theta = np.radians(degrees[:-1, None] * (1 - along) + degrees[1:, None] * along)
    t = np.arange(HELICES + 1) / HELICES
    points = S(t[:, None, None], theta)
    outlines = np.concatenate((points[:-1], points[1:, :, ::-1]), axis=2)
    return outlines.reshape(-1, 2 * SIDE, 3), np.tile(is_patch, HELICES)


def _draw(space: Any, outlines: Floats, colours: NDArray[np.str_], height: float) -> None:
    """Draw cells in their shade, sorted by depth; the axis of the angle goes from -height to height."""
    from matplotlib.ticker import MaxNLocator
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    low, high = outlines.min(axis=(0, 1)), outlines.max(axis=(0, 1))
    margin = 0.04 * (high - low)[:2].max()
    width, depth, _ = high - low + (2 * margin, 2 * margin, 0)
    tall = 1.25 * max(width, depth)
    scaled = outlines * (1, 1, tall / (2 * height))
    normal = np.cross(scaled[:, SIDE] - scaled[:, 0], scaled[:, -1] - scaled[:, SIDE - 1])
    lit = np.abs(normal @ np.array(LIGHT)) / (np.linalg.norm(normal, axis=1) * np.linalg.norm(LIGHT) + 1e-300)
    rgb = to_rgba_array(colours)[:, :3] * (0.7 + 0.3 * lit)[:, None]
    space.add_collection3d(Poly3DCollection(outlines, facecolors=rgb, edgecolors=INK, linewidths=0.35))
    (x0, y0), (x1, y1) = low[:2] - margin, high[:2] + margin
    space.set(xlim=(x0, x1), ylim=(y0, y1), zlim=(-height, height), xlabel="x", ylabel="y")
    space.set_box_aspect((width, depth, tall), zoom=0.92)
    for axis in (space.xaxis, space.yaxis):
        axis.set_major_locator(MaxNLocator(5))
    for axis in (space.xaxis, space.yaxis, space.zaxis):
        axis.set_pane_color(WALL)
