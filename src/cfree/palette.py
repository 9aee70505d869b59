"""Palette of all pictures: the meaning of each colour, with fonts, camera and light.

Colour-blind readers can tell apart all colours that are shown together; `tests/test_palette.py` computes it. Forbidden
things are grey: the obstacles dark, the forbidden space light.
"""

from __future__ import annotations

from typing import Any

# the workspace
ROBOT = "#009e73"
GHOST = "#8ed3c0"  # the robot in other poses
OBSTACLE = "#4d5561"
OBSTACLE_RIM = "#2e343d"
FRAME = "#0072b2"  # the robot's local frame, angles
PATH = "#9326e0"
BARRIER = "#96290f"  # separating surfaces, and obstacles that limit a clearance
MARK = "#d6008f"  # highlights: exact fits, violations of preferences
AHEAD, BACK, IN_PLACE = "#1a4fd6", "#e69f00", "#d65db1"  # gears of a vehicle; turns in place
LOST, GUESSED = "#e60000", "#f5a300"  # drawn in a file: not read, or read by a guess
FREE, FORBIDDEN = "#d6e6f5", "#dcdfe5"

# the boundary of the forbidden space
VERTEX_EDGE, EDGE_VERTEX, BOUND = "#d55e00", "#2b8cd6", "#b4b9c1"
HELIX, EDGE_EDGE = "#003f7f", "#f5c518"  # v-v and e-e contacts
ARC_ARC = "#cc79a7"  # an arc on an arc or on a vertex

# colours without a meaning of their own
INK, GREY, RIM, FAINT, WALL = "#20242b", "#6b7280", "#b4b9c1", "#d9dce2", "#f6f7f9"

CATEGORIES = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#5b3f8c")
"""Colours in turn for cells or classes of congruent patches; the first seven are those of Okabe and Ito."""
SEQUENTIAL, DIVERGING = "viridis", "coolwarm"
"""Colour maps of matplotlib, for amounts and for signed values."""

VIEW = (24.0, -58.0)
"""Elevation and azimuth of the camera, in degrees: x runs along the near edge, y to the right and back."""
FOCAL_LENGTH = 1.8
LIGHT = (-0.55, -0.65, 0.52)

LETTERS: dict[str, Any] = {
    "font.family": "DejaVu Sans",
    "mathtext.fontset": "stix",  # formulas as in the paper
    "font.size": 13,
    "axes.linewidth": 0.8,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "text.color": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "legend.frameon": False,
}
"""Settings of matplotlib (`rcParams`) for figures that cfree creates."""


def paler(colour: str, share: float) -> str:
    """Mix a colour with this share of white.

    Examples
    --------
    >>> paler("#000000", 0.5)
    '#808080'
    """
    return "#" + "".join(f"{round(255 * share + (1 - share) * c):02x}" for c in bytes.fromhex(colour[1:]))
