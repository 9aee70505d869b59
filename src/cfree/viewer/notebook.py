"""The page in a notebook."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any

from cfree.arguments import checked
from cfree.collision.arcs import arcs_of
from cfree.curves.curved import Curved
from cfree.forbidden.boundary import Boundary
from cfree.free.space import FreeSpace
from cfree.paths.path import Path
from cfree.planning.separation import Separated
from cfree.scene.scene import Scene

MOST_VERTICES = 10_000  # vertices of a scene shown by itself in the page: more are too slow
CURVE_VERTICES = 16  # vertices that the page draws in place of a curve, about


@checked
def widget(
    value: Scene | Boundary | FreeSpace | Path | Separated, answer: Path | Separated | None = None
) -> Any:  # a `Widget`, whose base class is not always installed
    """Show the page of `view` in a notebook's cell, and read back the dragged poses.

    Parameters
    ----------
    value : Scene, Boundary, FreeSpace, Path or Separated
        The value to show; an answer is shown with its scene.
    answer : Path or Separated, optional
        The answer, as in `view`.

    Returns
    -------
    Widget
        End a cell with it. Its `scene`, `robot`, `start`, `goal` and `answer` are exactly those of the page whenever
        they are read; set one, and the page follows.

    Raises
    ------
    ValueError
        If an answer read from a file is to be shown alone: the file does not contain its scene.
    ImportError
        If anywidget is not installed: ``pip install 'cfree[notebook]'``.

    Notes
    -----
    The page has 2.0 MB, which the notebook keeps for each widget if it saves their state.
    """
    from cfree.viewer.widget import Widget

    scene = _scene(value)
    if scene is None:
        raise ValueError("this answer was read from a file, without its scene; give widget(scene, answer)")
    return Widget(scene, value if answer is None and isinstance(value, Path | Separated) else answer)


def live(value: object, **options: Any) -> Any:
    """Return the notebook display of a value: the widget and its picture; None to show the picture alone."""
    if not isinstance(value, Scene | Boundary | FreeSpace | Path | Separated) or find_spec("anywidget") is None:
        return None
    scene = _scene(value)
    if scene is None or not _is_small(scene):
        return None
    return widget(value)._repr_mimebundle_(**options)


def _is_small(scene: Scene) -> bool:
    """True if the page shows a scene quickly."""
    if scene.curved and arcs_of(scene) is None:
        return False
    shapes = (*scene.robot, *scene.obstacles)
    sizes = (CURVE_VERTICES * sum(map(len, s.curves)) if isinstance(s, Curved) else len(s) for s in shapes)
    return sum(sizes) <= MOST_VERTICES


def _scene(value: Scene | Boundary | FreeSpace | Path | Separated) -> Scene | None:
    """Return the scene of a value; None for an answer from a file."""
    if isinstance(value, FreeSpace):
        return value.boundary.scene
    if isinstance(value, Path | Separated) and value.curved and arcs_of(value.curved):
        return value.curved
    return value if isinstance(value, Scene) else value.scene
