"""The page with a scene, in the browser."""

from __future__ import annotations

import os
import tempfile
import webbrowser
from pathlib import Path as FilePath

from cfree.arguments import checked
from cfree.formats.text.atomic import checked_suffix, replacing
from cfree.paths.path import Path
from cfree.planning.separation import Separated
from cfree.scene.scene import Scene
from cfree.viewer.page_text import page


@checked
def view(
    scene: Scene,
    answer: Path | Separated | None = None,
    *,
    html: str | os.PathLike[str] | None = None,
    browser: bool = True,
) -> FilePath:
    """Show a scene in the browser: drag the robot, turn it, and see the configuration space.

    Parameters
    ----------
    scene : Scene
    answer : Path or Separated, optional
        The path is shown as it is. Of a proof the page takes start and goal, and finds the separating surface again. It
        also finds a path with slides again.
    html : path, optional
        Where to write the page, which needs no other file; default a new temporary file.
    browser : bool
        True to open it.

    Returns
    -------
    pathlib.Path
        The page.

    Raises
    ------
    ValueError
        If the answer was read from a file and is for another scene.
    UnsupportedError
        If the suffix is neither .html nor .htm.

    Examples
    --------
    >>> scene = Scene(robot=[(0, 0), (1, 0), (0, 1)], obstacles=[[(2, 0), (3, 0), (3, 1)]])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     view(scene, html=f"{folder}/scene.html", browser=False).name
    'scene.html'
    """
    if html is None:
        handle, html = tempfile.mkstemp(suffix=".html", prefix="cfree-")
        os.close(handle)
    check_page_path(html)
    target = FilePath(os.path.realpath(html))
    with replacing(target) as unfinished:
        unfinished.write_text(page(scene, answer), encoding="utf-8", newline="\n")
    if browser:
        webbrowser.open(target.as_uri())
    return target


def check_page_path(path: str | os.PathLike[str]) -> str:
    """Return the suffix of a file that `view` can write.

    Examples
    --------
    >>> check_page_path("parking.pdf")
    Traceback (most recent call last):
        ...
    cfree.errors.UnsupportedError: parking.pdf: no page format; name the file .html or .htm
    """
    return checked_suffix(path, "page", (".html", ".htm"))
