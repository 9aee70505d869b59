"""The page as text, and what it is given."""

from __future__ import annotations

import json
from importlib.resources import files

from cfree.arguments import checked
from cfree.collision.slide import Slide
from cfree.curves.curved import REFUSED
from cfree.errors import UnsupportedError
from cfree.exact.pose import Pose
from cfree.formats.scene_file import scene_text
from cfree.paths.path import Path
from cfree.planning.separation import Separated
from cfree.scene.scene import Scene

GIVEN = '<script type="application/json" id="given">null</script>'


def text_of_polygons(scene: Scene) -> str:
    """JSON text of a scene, which the page can read.

    Raises
    ------
    UnsupportedError
        If it has round shapes.
    """
    if scene.curved:
        raise UnsupportedError(REFUSED)
    return scene_text(scene)


@checked
def page(scene: Scene, answer: Path | Separated | None = None) -> str:
    """The page as HTML; see `view`."""
    given: dict[str, object] = {"scene": text_of_polygons(scene)}
    if answer is not None:
        from cfree.verify.answers import other_scene

        if finding := other_scene(scene, answer):
            raise ValueError(f"answer: {finding}")
        given |= {"start": words(answer.start), "goal": words(answer.goal)}
    if poses := poses_text(answer):
        given["poses"] = poses
    return _page_of(given)


def hosted_page() -> str:
    """The page for a frame, which is told by messages what to show; see `viewer/src/host.ts`."""
    return _page_of("host")


def _page_of(given: object) -> str:
    text = files("cfree.viewer").joinpath("page.html").read_text(encoding="utf-8")
    before, found, after = text.partition(GIVEN)
    assert found, "the page has a place for what is given"
    return f"{before}{GIVEN.replace('null', _script(given))}{after}"


def _script(value: object) -> str:
    """JSON that no name in it can end."""
    return json.dumps(value).replace("<", "\\u003c")


def words(pose: Pose) -> dict[str, str]:
    """Exact numbers as texts."""
    return {"x": str(pose.x), "y": str(pose.y), "tau": "inf" if pose.tau is None else str(pose.tau)}


def poses_text(answer: Path | Separated | None) -> str:
    """Poses of a path, one a line; nothing if it has slides, which the page finds again."""
    if not isinstance(answer, Path) or any(isinstance(motion, Slide) for motion in answer.motions):
        return ""
    return "\n".join(" ".join(words(pose).values()) for pose in answer.poses)
