"""The common style of all figures, and their files."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from cfree.formats.text.atomic import replacing
from cfree.palette import LETTERS

FORMATS = ("svg", "pdf", "png")


@contextmanager
def styled() -> Iterator[None]:
    """Apply settings of matplotlib while a figure is made and written."""
    from matplotlib import rc_context

    # searchable fonts, and the same bytes each time
    settings: Any = {**LETTERS, "pdf.fonttype": 42, "svg.hashsalt": "cfree"}
    with rc_context(settings):
        yield


def write(figure: Figure, path: Path) -> None:
    """Write a figure, whole or not at all, and with the same bytes each time."""
    undated: dict[str, dict[str, Any]] = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}, ".png": {}}
    with replacing(path) as unfinished:
        dpi, form = 150 if path.suffix == ".png" else 300, path.suffix[1:]
        figure.savefig(unfinished, dpi=dpi, format=form, metadata=undated[path.suffix])
