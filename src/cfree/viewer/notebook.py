"""The page in a notebook."""

from __future__ import annotations

from typing import Any

from cfree.arguments import checked
from cfree.forbidden.boundary import Boundary
from cfree.free.space import FreeSpace
from cfree.paths.path import Path
from cfree.planning.separation import Separated
from cfree.scene.scene import Scene


@checked
def widget(
    value: Scene | Boundary | FreeSpace | Path | Separated, answer: Path | Separated | None = None
) -> Any:  # a `Widget`, which needs what is not always installed
    """The page of `view` in a notebook's cell: drag in it, and read what has become of it.

    Parameters
    ----------
    value : Scene, Boundary, FreeSpace, Path or Separated
        What to show; of an answer the scene that it is about.
    answer : Path or Separated, optional
        As in `view`.

    Returns
    -------
    Widget
        End a cell with it. Its `scene`, `robot`, `start`, `goal` and `answer` are what is seen in the page, exactly,
        whenever they are read; set to something else, the page follows.

    Raises
    ------
    ValueError
        If an answer read from a file is to be shown alone: it does not know its scene.
    ImportError
        If anywidget is not installed: ``pip install 'cfree[notebook]'``.

    Notes
    -----
    The page has 1.5 MB, which the notebook keeps for each widget if it saves their state.
    """
    from cfree.viewer.widget import Widget

    if isinstance(value, Path | Separated):
        if value.scene is None:
            raise ValueError("this answer was read from a file, without its scene; give widget(scene, answer)")
        return Widget(value.scene, value if answer is None else answer)
    boundary = value.boundary if isinstance(value, FreeSpace) else value
    return Widget(boundary.scene if isinstance(boundary, Boundary) else boundary, answer)
