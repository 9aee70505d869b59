"""A picture of a v-e patch unrolled into the plane."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from cfree.contact import VertexEdge, angle_range
from cfree.development import development
from cfree.mesh import COLOURS
from cfree.polygon import Polygon
from cfree.surface import contact_surface

if TYPE_CHECKING:
    from matplotlib.axes import Axes

HELICES, RULINGS, POINTS = 9, 13, 241  # lines drawn, and points of a curve


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
        If the contact has no patch, or is e-v: those patches cannot be unrolled.

    Notes
    -----
    See `development`; here the ruling of phi_min is at 0. Rulings are drawn at equal steps of phi, helices of t.
    """
    from matplotlib.collections import LineCollection
    from matplotlib.figure import Figure

    S, Phi = contact_surface(robot, obstacle, contact), angle_range(robot, obstacle, contact)
    origin = development(S.ruled, 0.0, Phi.phi_min, angle_scale=angle_scale)

    def unrolled(t: float | np.ndarray, phi: float | np.ndarray) -> np.ndarray:
        return development(S.ruled, t, phi, angle_scale=angle_scale) - origin

    phi = Phi.phi_min + Phi.phi_range * np.linspace(0, 1, POINTS)
    helices = unrolled(np.linspace(0, 1, HELICES)[:, None], phi)
    at = Phi.phi_min + Phi.phi_range * np.linspace(0, 1, RULINGS)
    rulings = unrolled(np.array([0.0, 1.0]), at[:, None])

    ax = ax or Figure(figsize=(8, 5), facecolor="white", layout="constrained").add_subplot()
    rim = np.concatenate([helices[0], helices[-1, ::-1]])
    ax.fill(*rim.T, facecolor=COLOURS[1], alpha=0.25, linewidth=0)
    ax.add_collection(LineCollection(list(rulings), colors="#d9a400", linewidths=0.9))
    ax.add_collection(LineCollection(list(helices[1:-1]), colors="black", linewidths=0.6))
    ax.add_collection(LineCollection([*helices[[0, -1]], *rulings[[0, -1]]], colors="black", linewidths=1.5))
    for name, ruling in ((r"$\phi_{\min}$", rulings[0]), (r"$\phi_{\max}$", rulings[-1])):
        degrees = math.degrees(Phi.phi_min if ruling is rulings[0] else Phi.phi_max) % 360
        ax.annotate(f"{name} = {degrees:.4g}°", ruling[1], (0, 6), textcoords="offset points", ha="center")
    ax.set(aspect="equal", xlabel="distance across the rulings", ylabel="along the rulings", frame_on=True)
    ax.margins(0.08, 0.12)
    ax.set_title(f"patch of the contact (v{contact.i} - e{contact.j}), unrolled")
    ax.spines[["top", "right"]].set_visible(False)
    return ax
