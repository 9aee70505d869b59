"""A picture of a v-e patch unrolled into the plane."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes

from cfree.arguments import checked
from cfree.contact.contact import VertexEdge, angle_range
from cfree.contact.surface import contact_surface
from cfree.forbidden.kinds import COLOURS, PatchKind
from cfree.geometry.development import develop
from cfree.palette import EDGE_EDGE, INK
from cfree.polygons.polygon import Polygon

HELICES, RULINGS, POINTS = 9, 13, 241  # lines drawn, and points of a curve


@checked
def plot_development(
    robot: Polygon, obstacle: Polygon, contact: VertexEdge, *, angle_scale: float = 1.0, ax: Axes | None = None
) -> Axes:
    """Draw a v-e patch unrolled: its helices black, its rulings yellow, lengths and angles as on the surface.

    Parameters
    ----------
    robot, obstacle : Polygon
    contact : VertexEdge
    angle_scale : float, length per radian
        1 in the paper.
    ax : matplotlib axes, optional

    Returns
    -------
    matplotlib axes

    Raises
    ------
    ValueError
        If the contact has no patch, or is e-v: e-v patches cannot be unrolled.

    Notes
    -----
    See `develop`; here the ruling of phi_min is at 0. Rulings are drawn at equal steps of phi, helices of t.
    """
    from matplotlib.collections import LineCollection
    from matplotlib.figure import Figure

    S, Phi = contact_surface(robot, obstacle, contact), angle_range(robot, obstacle, contact)
    origin = develop(S.ruled, 0.0, Phi.phi_min, angle_scale=angle_scale)

    def unrolled(t: float | np.ndarray, phi: float | np.ndarray) -> np.ndarray:
        return develop(S.ruled, t, phi, angle_scale=angle_scale) - origin

    phi = Phi.phi_min + Phi.phi_range * np.linspace(0, 1, POINTS)
    helices = unrolled(np.linspace(0, 1, HELICES)[:, None], phi)
    angles = Phi.phi_min + Phi.phi_range * np.linspace(0, 1, RULINGS)
    rulings = unrolled(np.array([0.0, 1.0]), angles[:, None])

    ax = ax or Figure(figsize=(8, 5), facecolor="white", layout="constrained").add_subplot()
    rim = np.concatenate([helices[0], helices[-1, ::-1]])
    ax.fill(*rim.T, facecolor=COLOURS[PatchKind.VERTEX_EDGE], alpha=0.25, linewidth=0)
    ax.add_collection(LineCollection(list(rulings), colors=EDGE_EDGE, linewidths=1.2))
    ax.add_collection(LineCollection(list(helices[1:-1]), colors=INK, linewidths=0.6))
    ax.add_collection(LineCollection([*helices[[0, -1]], *rulings[[0, -1]]], colors=INK, linewidths=1.5))
    for name, angle, ruling, side in (("min", Phi.phi_min, rulings[0], -1), ("max", Phi.phi_max, rulings[-1], 1)):
        text = rf"$\phi_{{\{name}}}$ = {math.degrees(angle) % 360:.4g}°"
        ax.annotate(
            text, ruling.mean(axis=0), (8 * side, 0), textcoords="offset points", rotation="vertical",
            ha="right" if side < 0 else "left", va="center",
        )  # fmt: skip
    ax.set(aspect="equal", xlabel="across the rulings", ylabel="along the rulings")
    ax.margins(0.2, 0.06)
    ax.set_title(f"patch of the contact (v{contact.i} - e{contact.j}), unrolled")
    ax.spines[["top", "right"]].set_visible(False)
    return ax
