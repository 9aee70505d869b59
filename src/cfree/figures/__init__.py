"""The paper's figures 1 to 10 drawn from computed data, in coordinates of our own, and four that go on from there.

Indices count from 1 in the figures, as in the paper. `draw_all` writes them, as ``cfree figures`` does.
"""

from __future__ import annotations

import errno
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib import import_module
from os import PathLike
from pathlib import Path

from matplotlib.figure import Figure

from cfree.arguments import checked
from cfree.errors import UnsupportedError
from cfree.figures.style import FORMATS, styled, write


@dataclass(frozen=True, slots=True)
class Entry:
    """A figure: its number, what it shows (the stem of its file), its caption, and who draws it."""

    number: int
    name: str
    caption: str
    drawn_by: str

    @property
    def stem(self) -> str:
        """Name of its files, without suffix."""
        return f"{self.number:02}-{self.name}"


FIGURES = (
    Entry(
        1, "rest-and-moved", "The robot at rest and in a pose q = (r, theta), and an obstacle.", "poses.rest_and_moved"
    ),
    Entry(2, "contacts", "A contact with O1, a pseudo contact with O2, three contacts with O3.", "poses.contacts"),
    Entry(3, "vertex-edge-range", "The orientations of a v-e contact.", "ranges.vertex_edge"),
    Entry(4, "edge-vertex-range", "The orientations of an e-v contact.", "ranges.edge_vertex"),
    Entry(5, "vertex-vertex", "A v-v contact: C(phi).", "curves.vertex_vertex"),
    Entry(6, "edge-edge", "An e-e contact: C(t), which goes on beyond t = 1.", "curves.edge_edge"),
    Entry(7, "vertex-edge-surface", "A v-e contact surface.", "surfaces.vertex_edge"),
    Entry(8, "edge-vertex-surface", "An e-v contact surface.", "surfaces.edge_vertex"),
    Entry(9, "pillar", "All contact patches of two triangles.", "surfaces.pillar"),
    Entry(10, "directions", "Asymptotic and principal directions on an e-v surface.", "curvature.directions"),
    Entry(11, "curvature", "Gaussian curvature of an e-v surface.", "curvature.gaussian"),
    Entry(12, "five-obstacles", "The boundary among five obstacles.", "scenes.five_obstacles"),
    Entry(13, "slices", "A stack of slices, and the surface they are cut from.", "scenes.slices"),
    Entry(14, "gauss-bonnet", "Where a closed surface has its curvature.", "curvature_sum.gauss_and_bonnet"),
)


@checked
def draw(number: int) -> Figure:
    """One figure, to be shown or written within `styled`.

    Examples
    --------
    >>> with styled():
    ...     draw(1).get_size_inches().round(1).tolist()
    [7.2, 5.7]
    """
    module, function = _entry(number).drawn_by.split(".")
    figure: Figure = getattr(import_module(f"cfree.figures.{module}"), function)()
    return figure


@checked
def draw_all(
    directory: str | PathLike[str], *, only: Iterable[int] | None = None, formats: Iterable[str] = FORMATS,
    progress: Callable[[float], object] | None = None,
) -> list[Path]:  # fmt: skip
    """Write the figures into a directory, which is made if missing; each file whole or not at all.

    Parameters
    ----------
    directory : path
    only : numbers of figures, optional
        All if not given.
    formats : of "svg", "pdf", "png"
        Surfaces in space, and the curves on them, are pixels in all three; other lines and letters are not.
    progress : callable, optional
        Called with the share that is done, from 0 to 1.

    Returns
    -------
    list of Path
        The files, in the order of the figures.

    Raises
    ------
    ValueError
        If there is no such figure.
    UnsupportedError
        If there is no such format.
    NotADirectoryError
        If `directory` is a file.

    Examples
    --------
    >>> draw_all("never", only=[15])
    Traceback (most recent call last):
        ...
    ValueError: figure 15: there are the figures 1 to 14
    """
    folder, chosen, suffixes = (
        Path(directory),
        [e.number for e in FIGURES] if only is None else list(only),
        list(formats),
    )
    entries = [_entry(number) for number in dict.fromkeys(chosen)]
    for suffix in suffixes:
        if suffix not in FORMATS:
            raise UnsupportedError(f"format {suffix!r}: figures are written as {', '.join(FORMATS)}")
    if folder.exists() and not folder.is_dir():
        raise NotADirectoryError(errno.ENOTDIR, "is a file; give a directory", str(folder))
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for done, entry in enumerate(entries):
        if progress is not None:
            progress(done / len(entries))
        with styled():
            figure = draw(entry.number)
            for suffix in dict.fromkeys(suffixes):
                files.append(folder / f"{entry.stem}.{suffix}")
                write(figure, files[-1])
    if progress is not None:
        progress(1.0)
    return files


def _entry(number: int) -> Entry:
    for entry in FIGURES:
        if entry.number == number:
            return entry
    raise ValueError(f"figure {number}: there are the figures 1 to {FIGURES[-1].number}")
