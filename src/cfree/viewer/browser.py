"""The page with a scene inside, as text and in the browser."""

from __future__ import annotations

import json
import os
import tempfile
import webbrowser
from importlib.resources import files
from pathlib import Path as FilePath

from cfree.arguments import checked
from cfree.collision.slide import Slide
from cfree.exact.pose import Pose
from cfree.formats.atomic import replacing
from cfree.formats.scene_file import scene_text
from cfree.paths.path import Path
from cfree.planning.separation import Separated
from cfree.scene.scene import Scene

GIVEN = '<script type="application/json" id="given">null</script>'


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
        The path is shown as it is, of a proof start and goal: the page finds the surface between them again. A path
        with slides is looked for again, too.
    html : path, optional
        Where to write the page, which holds all it needs; a new temporary file unless given.
    browser : bool
        Whether to open it.

    Returns
    -------
    pathlib.Path
        The page.

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
    target = FilePath(os.path.realpath(html))
    with replacing(target) as unfinished:
        unfinished.write_text(page(scene, answer), encoding="utf-8", newline="\n")
    if browser:
        webbrowser.open(target.as_uri())
    return target


@checked
def page(scene: Scene, answer: Path | Separated | None = None) -> str:
    """The page as HTML; see `view`."""
    given: dict[str, object] = {"scene": scene_text(scene)}
    if answer is not None:
        given |= {"start": _words(answer.start), "goal": _words(answer.goal)}
    if isinstance(answer, Path) and not any(isinstance(motion, Slide) for motion in answer.motions):
        given["poses"] = "\n".join(" ".join(_words(pose).values()) for pose in answer.poses)
    text = files("cfree.viewer").joinpath("page.html").read_text(encoding="utf-8")
    before, found, after = text.partition(GIVEN)
    assert found, "the page has a place for what is given"
    return f"{before}{GIVEN.replace('null', _script(given))}{after}"


def _script(value: object) -> str:
    """JSON that no name in it can end."""
    return json.dumps(value).replace("<", "\\u003c")


def _words(pose: Pose) -> dict[str, str]:
    """Exact numbers as texts."""
    return {"x": str(pose.x), "y": str(pose.y), "tau": "inf" if pose.tau is None else str(pose.tau)}
