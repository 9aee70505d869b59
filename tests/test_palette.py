"""The palette: what is shown together is told apart, also by eyes that lack a cone; no other file names a colour."""

from __future__ import annotations

import math
import re
from itertools import combinations, pairwise
from pathlib import Path

import numpy as np
import pytest
from matplotlib import colormaps
from matplotlib.colors import to_rgb

from cfree import palette

SIMULATED = {
    "none": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
    "protanopia": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deuteranopia": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritanopia": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}
"""The matrices of Machado, Oliveira and Fernandes (2009), severity 1."""
TOGETHER = (
    "VERTEX_EDGE EDGE_VERTEX ARC_ARC HELIX EDGE_EDGE", "VERTEX_EDGE EDGE_VERTEX PATH", "VERTEX_EDGE EDGE_VERTEX INK",
    "ROBOT OBSTACLE PATH BARRIER", "GHOST OBSTACLE PATH BARRIER", "ROBOT OBSTACLE EDGE_EDGE", "FRAME OBSTACLE",
    "LOST GUESSED PATH OBSTACLE ROBOT", "AHEAD BACK IN_PLACE ROBOT OBSTACLE BARRIER", "AHEAD BACK IN_PLACE GHOST",
    "GHOST FRAME", "OBSTACLE FORBIDDEN", "FRAME VERTEX_EDGE", "BOUND VERTEX_EDGE EDGE_VERTEX",
)  # fmt: skip


def seen(colour: object, deficiency: str) -> tuple[float, float, float]:
    """L*a*b* of a colour as it is simulated."""
    rgb = np.array(to_rgb(colour))  # type: ignore[arg-type]
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    linear = (np.array(SIMULATED[deficiency]) @ linear).clip(0, 1)
    to_xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    ratio = (np.array(to_xyz) @ linear) / (0.9505, 1.0, 1.089)
    f = np.where(ratio > 0.008856, np.cbrt(ratio), 7.787 * ratio + 16 / 116)
    return float(116 * f[1] - 16), float(500 * (f[0] - f[1])), float(200 * (f[1] - f[2]))


@pytest.mark.parametrize("deficiency", SIMULATED)
def test_what_is_shown_together_is_told_apart(deficiency: str) -> None:
    for names in TOGETHER:
        for one, other in combinations(names.split(), 2):
            apart = math.dist(*(seen(getattr(palette, name), deficiency) for name in (one, other)))
            assert apart > 20, (one, other)


@pytest.mark.parametrize("deficiency", SIMULATED)
def test_amounts_grow_lighter_and_signs_lie_apart(deficiency: str) -> None:
    amounts = [seen(colormaps[palette.SEQUENTIAL](k / 8), deficiency)[0] for k in range(9)]
    assert all(light - dark > 3 for dark, light in pairwise(amounts))
    low, middle, high = (seen(colormaps[palette.DIVERGING](share), deficiency) for share in (0.0, 0.5, 1.0))
    assert min(math.dist(low, high), math.dist(low, middle), math.dist(middle, high)) > 25


def test_figures_and_pictures_name_no_colours_of_their_own() -> None:
    source = Path(palette.__file__).parent
    folders = ("figures", "plot", "film", "forbidden", "viewer")
    drawn = [path for folder in folders for path in source.glob(f"{folder}/*.py")]
    for path in drawn:
        assert not re.findall(r"#[0-9a-fA-F]{6}", path.read_text()), path.name
