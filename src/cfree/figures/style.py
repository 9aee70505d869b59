"""One look for all figures: colours, letters, and files."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from cfree.formats.atomic import replacing

FORMATS = ("svg", "pdf", "png")
INK, GREY, FAINT = "#20242b", "#8a92a0", "#d9dce2"


@dataclass(frozen=True, slots=True)
class Palette:
    """The colours that mean something; grey and black are the same in all palettes."""

    robot: str
    robot_moved: str
    obstacle: str
    frame: str
    vertex_edge: str
    edge_vertex: str
    helix: str
    edge_edge: str
    asymptotic: str
    principal: str
    scale: str  # a colour map of matplotlib


PAPER = Palette(
    robot="#1d7a3f",
    robot_moved="#8fce9b",
    obstacle="#d8493a",
    frame="#1f3fbf",
    vertex_edge="#d7301f",
    edge_vertex="#3a9a3a",
    helix="#1f3fbf",
    edge_edge="#f5c518",
    asymptotic="#1f3fbf",
    principal="#c8102e",
    scale="magma",
)

SAFE = Palette(
    robot="#009e73",
    robot_moved="#8ed3c0",
    obstacle="#d55e00",
    frame="#0072b2",
    vertex_edge="#d55e00",
    edge_vertex="#56b4e9",
    helix="#003f7f",
    edge_edge="#f0e442",
    asymptotic="#0072b2",
    principal="#d55e00",
    scale="cividis",
)
"""After Okabe and Ito, for readers who do not tell red from green."""


@contextmanager
def styled() -> Iterator[None]:
    """Settings of matplotlib that hold while a figure is made and written."""
    from matplotlib import rc_context

    settings: Any = {
        "font.family": "STIXGeneral",
        "mathtext.fontset": "stix",
        "font.size": 13,
        "axes.linewidth": 0.8,
        "axes.edgecolor": INK,
        "axes.labelcolor": INK,
        "text.color": INK,
        "xtick.color": INK,
        "ytick.color": INK,
        "legend.frameon": False,
        "pdf.fonttype": 42,
        "svg.hashsalt": "cfree",  # the same bytes each time
    }
    with rc_context(settings):
        yield


def new_figure(width: float, height: float) -> Figure:
    """A white figure without a window; inches."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), facecolor="white")
    FigureCanvasAgg(figure)
    return figure


def write(figure: Figure, path: Path) -> None:
    """Write a figure, whole or not at all, and with the same bytes each time."""
    undated: dict[str, dict[str, Any]] = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}, ".png": {}}
    with replacing(path) as unfinished:
        dpi, form = 150 if path.suffix == ".png" else 300, path.suffix[1:]
        figure.savefig(unfinished, dpi=dpi, format=form, metadata=undated[path.suffix])
