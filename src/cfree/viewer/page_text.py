"""The page as text, with the scene and the answer inside."""

from __future__ import annotations

import json
from importlib.resources import files

from cfree.arguments import checked
from cfree.collision.arcs import arcs_of
from cfree.collision.slide import Slide
from cfree.errors import UnsupportedError
from cfree.exact.pose import Pose
from cfree.formats.scene_file import scene_text
from cfree.formats.scenes.scene_values import vehicle_record
from cfree.paths.path import Path
from cfree.planning.separation import Separated
from cfree.scene.scene import Scene, with_reading

GIVEN = '<script type="application/json" id="given">null</script>'
OTHER_CURVES = "the page takes lines and circular arcs; give scene.outer(error), polygons around other curves"


def text_for_page(scene: Scene) -> str:
    """Return the JSON text of a scene, for the page, which takes no record of reading.

    Raises
    ------
    UnsupportedError
        If the scene has ellipses, Bézier curves or splines.
    """
    if scene.curved and arcs_of(scene) is None:
        raise UnsupportedError(OTHER_CURVES)
    return scene_text(with_reading(scene, ()))


@checked
def page(scene: Scene, answer: Path | Separated | None = None) -> str:
    """Return the page as HTML; see `view`."""
    data: dict[str, object] = {"scene": text_for_page(scene)}
    if answer is not None:
        from cfree.verify.answers import other_scene

        if finding := other_scene(scene, answer):
            raise ValueError(f"answer: {finding}")
        data |= {"start": words(answer.start), "goal": words(answer.goal)}
    if isinstance(answer, Path):
        data["vehicle"] = None if answer.vehicle is None else vehicle_record(answer.vehicle)
    if poses := poses_text(answer):
        data["poses"] = poses
    return _page_of(data)


def hosted_page() -> str:
    """Return the page for a frame, which receives its scene by messages; see `viewer/src/host.ts`."""
    return _page_of("host")


def _page_of(data: object) -> str:
    text = files("cfree.viewer").joinpath("page.html").read_text(encoding="utf-8")
    before, marker, after = text.partition(GIVEN)
    assert marker, "the page has a place for its data"
    return f"{before}{GIVEN.replace('null', _script(data))}{after}"


def _script(value: object) -> str:
    """Return JSON in which no name can end the script."""
    return json.dumps(value).replace("<", "\\u003c")


def words(pose: Pose) -> dict[str, str]:
    """Write the exact numbers of a pose as texts."""
    return {"x": str(pose.x), "y": str(pose.y), "tau": "inf" if pose.tau is None else str(pose.tau)}


def poses_text(answer: Path | Separated | None) -> str:
    """Write the poses of a path, one a line; empty for a path with slides, which the page finds again."""
    if not isinstance(answer, Path) or any(isinstance(motion, Slide) for motion in answer.motions):
        return ""
    return "\n".join(" ".join(words(pose).values()) for pose in answer.poses)
