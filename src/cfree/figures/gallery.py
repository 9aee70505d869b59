"""All figures: their parts, how to draw and how to write them."""

from __future__ import annotations

import errno
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib import import_module
from os import PathLike
from pathlib import Path
from typing import Literal

from matplotlib.figure import Figure

from cfree.arguments import checked, one_of
from cfree.figures.style import FORMATS, styled, write
from cfree.plot.depth_sort import Painting
from cfree.plot.rendered import require

Box = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class Panel:
    """A part of a figure: the function that draws it, the place of its axes, True for axes with three dimensions."""

    drawn_by: str
    place: Box
    in_space: bool = False


@dataclass(frozen=True, slots=True)
class Entry:
    """A figure: its number, its name (the stem of its file), its caption, its size in inches, its parts."""

    number: int
    name: str
    caption: str
    size: tuple[float, float]
    panels: tuple[Panel, ...]

    @property
    def stem(self) -> str:
        """Name of the figure's files, without suffix."""
        return f"{self.number:02}-{self.name}"


def _plane(number: int, name: str, caption: str, height: float, drawn_by: str) -> Entry:
    """Make the entry of a figure of the plane, 7.2 inches wide."""
    return Entry(number, name, caption, (7.2, height), (Panel(drawn_by, (0, 0, 1, 1)),))


def _space(number: int, name: str, caption: str, drawn_by: str) -> Entry:
    """Make the entry of a figure of the configuration space."""
    return Entry(number, name, caption, (6.2, 6.6), (Panel(drawn_by, (0.02, 0.09, 0.96, 0.91), True),))


LEFT, RIGHT = (0.01, 0.09, 0.49, 0.91), (0.505, 0.09, 0.49, 0.91)

FIGURES = (
    _plane(1, "rest-and-moved", "The robot at rest and in a pose, and an obstacle.", 5.69, "poses.rest_and_moved"),
    _plane(2, "contacts", "A contact, a pseudo contact, and three contacts at once.", 5.97, "poses.contacts"),
    _plane(3, "vertex-edge-range", "The orientations of a v-e contact.", 4.03, "ranges.vertex_edge_range"),
    _plane(4, "edge-vertex-range", "The orientations of an e-v contact.", 5.04, "ranges.edge_vertex_range"),
    _plane(5, "vertex-vertex", "A v-v contact: C(phi).", 5.02, "curves.vertex_vertex"),
    _plane(6, "edge-edge", "An e-e contact: C(t), which goes on beyond t = 1.", 3.6, "curves.edge_edge"),
    _space(7, "vertex-edge-surface", "A v-e contact surface and its patch.", "surfaces.vertex_edge_surface"),
    _space(8, "edge-vertex-surface", "An e-v contact surface and its patch.", "surfaces.edge_vertex_surface"),
    Entry(
        9, "pillar", "All contact patches of two triangles, from both sides.", (10.6, 6.6),
        (
            Panel("pillars.pillar", (0.0, 0.11, 0.58, 0.89), True),
            Panel("pillars.pillar_workspace", (0.62, 0.7, 0.36, 0.28)),
            Panel("pillars.pillar_from_behind", (0.61, 0.0, 0.38, 0.7), True),
        ),
    ),
    Entry(
        10, "directions", "Directions, normal section and indicatrix at a point of an e-v surface.", (10.4, 5.0),
        (
            Panel("curvature.directions", (0.0, -0.2, 0.62, 1.4), True),
            Panel("curvature.indicatrix", (0.62, 0.06, 0.37, 0.88)),
        ),
    ),
    Entry(
        11, "curvature", "Gaussian curvature of an e-v surface.", (9.4, 5.4),
        (
            Panel("curvature.gaussian_curvature", (0.0, 0.0, 0.66, 1.0), True),
            Panel("curvature.curvature_along", (0.74, 0.2, 0.23, 0.6)),
        ),
    ),
    Entry(
        12, "five-obstacles", "The boundary among five obstacles.", (10.4, 5.8),
        (
            Panel("scenes.five_obstacles", (0.01, 0.17, 0.33, 0.76)),
            Panel("scenes.five_pillars", (0.35, 0.09, 0.65, 0.91), True),
        ),
    ),
    Entry(
        13, "slices", "A stack of slices, and the surface they are cut from.", (10.4, 5.6),
        (Panel("scenes.slice_stack", LEFT, True), Panel("scenes.slice_source", RIGHT, True)),
    ),
    Entry(
        14, "gauss-bonnet", "Where a closed surface has its curvature.", (7.2, 4.4),
        (Panel("curvature_sum.gauss_and_bonnet", (0.11, 0.15, 0.86, 0.8)),),
    ),
    Entry(
        15, "helicoid", "Lemma 3: a helicoid, and an e-v surface that is none.", (10.4, 6.4),
        (
            Panel("minimal.edge_through", (0.12, 0.75, 0.24, 0.23)),
            Panel("minimal.edge_beside", (0.6, 0.75, 0.24, 0.23)),
            Panel("minimal.helicoid", (0.01, 0.06, 0.46, 0.72), True),
            Panel("minimal.generic", (0.46, 0.06, 0.54, 0.72), True),
        ),
    ),
    Entry(
        16, "helices", "Remark 2: helices through a pose.", (10.4, 5.4),
        (
            Panel("helices.turns_about_points", (0.01, 0.08, 0.42, 0.84)),
            Panel("helices.helices_through_a_pose", (0.46, 0.02, 0.53, 0.98), True),
        ),
    ),
    Entry(
        17, "development", "A v-e patch beside its development.", (10.4, 5.2),
        (
            Panel("unrolled.patch_in_space", (0.02, 0.02, 0.54, 0.98), True),
            Panel("unrolled.patch_unrolled", (0.6, 0.14, 0.38, 0.8)),
        ),
    ),
    Entry(
        18, "congruence", "Remark 3: patches by classes of congruence.", (10.4, 7.0),
        (
            Panel("pillars.squares", (0.11, 0.87, 0.28, 0.12)),
            Panel("pillars.kite_and_square", (0.61, 0.87, 0.28, 0.12)),
            Panel("pillars.congruent_squares", (0.01, 0.1, 0.49, 0.77), True),
            Panel("pillars.congruent_kite", (0.505, 0.1, 0.49, 0.77), True),
        ),
    ),
    Entry(
        19, "lines", "Lines of curvature and asymptotic lines of an e-v patch.", (10.4, 5.2),
        (Panel("lines.lines_of_curvature", LEFT, True), Panel("lines.asymptotic_lines", RIGHT, True)),
    ),
    Entry(
        20, "depth", "A slice of the arrangement: how many obstacles are overlapped where.", (10.4, 5.2),
        (
            Panel("depth.three_obstacles", (0.01, 0.05, 0.38, 0.9)),
            Panel("depth.depth_in_a_slice", (0.47, 0.27, 0.51, 0.66)),
        ),
    ),
    Entry(
        21, "disc", "A disc among polygons: arcs on edges and on vertices.", (10.4, 5.8),
        (
            Panel("arcs.disc_among_polygons", (0.01, 0.12, 0.4, 0.84)),
            Panel("arcs.disc_pillars", (0.39, 0.09, 0.61, 0.91), True),
        ),
    ),
    Entry(
        22, "rounded-pillar", "A triangle's pillar, and a rounded square's beside it.", (10.4, 7.4),
        (
            Panel("pillars.pillar_workspace", (0.07, 0.83, 0.36, 0.16)),
            Panel("arcs.rounded_workspace", (0.565, 0.83, 0.36, 0.16)),
            Panel("pillars.pillar", (0.01, 0.09, 0.49, 0.75), True),
            Panel("arcs.rounded_pillar", (0.505, 0.09, 0.49, 0.75), True),
        ),
    ),
    Entry(
        23, "arc-curvature", "Gaussian curvature of the surface of an arc on an arc.", (10.4, 5.6),
        (
            Panel("arcs.arc_curvature", (0.055, 0.06, 0.59, 0.94), True),
            Panel("arcs.arc_curvature_around", (0.71, 0.2, 0.27, 0.62)),
        ),
    ),
    Entry(
        24, "rounded-boundary", "The boundary of a rounded triangle, and of a disc.", (10.4, 7.4),
        (
            Panel("rounded.shapes_in_the_plane", (0.2, 0.78, 0.6, 0.21)),
            Panel("rounded.rounded_triangles", (0.025, 0.07, 0.475, 0.72), True),
            Panel("rounded.disc_boundary", (0.515, 0.07, 0.475, 0.72), True),
        ),
    ),
)  # fmt: skip


@checked
def draw(number: int) -> Figure:
    """Draw one figure, to be shown or written within `styled`.

    Examples
    --------
    >>> with styled():
    ...     draw(1).get_size_inches().round(1).tolist()
    [7.2, 5.7]
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    entry = _entry(number)
    figure = Figure(figsize=entry.size, facecolor="white")
    FigureCanvasAgg(figure)
    for panel in entry.panels:
        module, function = panel.drawn_by.split(".")
        ax = figure.add_axes(panel.place, projection="3d" if panel.in_space else None)
        getattr(import_module(f"cfree.figures.{module}"), function)(ax)
    return figure


@checked
def draw_all(
    directory: str | PathLike[str], *, only: Iterable[int] | None = None, formats: Iterable[str] = FORMATS,
    renderer: Literal["matplotlib", "pyvista"] | None = None, progress: Callable[[float], object] | None = None,
) -> list[Path]:  # fmt: skip
    """Write the figures into a directory, which is made if missing; each file whole or not at all.

    Parameters
    ----------
    directory : path
    only : numbers of figures, optional
        The figures to write; default all.
    formats : of "svg", "pdf", "png"
    renderer : "matplotlib" or "pyvista", optional
        The renderer of surfaces in space: matplotlib as vectors from back to front, or PyVista (``pip install
        'cfree[render]'``) as pixels in true depth order. Default: PyVista if it is installed. Everything else is
        vectors, from the same camera.
    progress : callable, optional
        Called with the share that is done, from 0 to 1.

    Returns
    -------
    list of Path
        The files, in the order of the figures.

    Raises
    ------
    ValueError
        If there is no such figure or format.
    UnsupportedError
        If the renderer is "pyvista" and PyVista is not installed.
    NotADirectoryError
        If `directory` is a file.

    Examples
    --------
    >>> draw_all("never", only=[25])
    Traceback (most recent call last):
        ...
    ValueError: figure 25: there are the figures 1 to 24
    """
    folder, chosen, suffixes = (
        Path(directory),
        [e.number for e in FIGURES] if only is None else list(only),
        list(formats),
    )
    entries = [_entry(number) for number in dict.fromkeys(chosen)]
    for suffix in suffixes:
        one_of("formats", suffix, FORMATS)
    if renderer is not None:
        require(renderer)
    if folder.exists() and not folder.is_dir():
        raise NotADirectoryError(errno.ENOTDIR, "is a file; give a directory", str(folder))
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for done, entry in enumerate(entries):
        if progress is not None:
            progress(done / len(entries))
        with styled():
            figure = draw(entry.number)
            for painting in figure.findobj(Painting):
                painting.renderer = painting.renderer or renderer
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
