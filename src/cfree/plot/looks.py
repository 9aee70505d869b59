"""Scenes for pictures: round shapes with so many edges that they look round."""

from __future__ import annotations

from dataclasses import replace

from cfree.errors import UnsupportedError
from cfree.paths.path import Path
from cfree.planning.separation import Separated
from cfree.planning.stuck import Stuck
from cfree.scene.scene import Scene
from cfree.scene.smooth import smooth


def of_polygons(answer: Path | Separated | Stuck, scene: Scene) -> Scene:
    """Return the scene of polygons that an answer is about; of one among true shapes, polygons that look round.

    Raises
    ------
    UnsupportedError
        If the scene has round shapes, and the answer has no polygons for them.
    """
    if not scene.curved:
        return scene
    if answer.scene is None and (isinstance(answer, Path) or (isinstance(answer, Separated) and answer.rounded)):
        return smooth(scene)
    if answer.scene is None:
        raise UnsupportedError("the scene has round shapes, and the answer no polygons for them; give its own scene")
    return answer.scene


def own(path: Path, scene: Scene) -> Path:
    """Return a path with its round shapes, if it was read from a file without them."""
    return replace(path, curved=scene) if scene.curved and path.scene is None else path


def looks(answer: Path | Separated | Stuck, scene: Scene) -> Scene:
    """Return the same scene with its round shapes, if the answer is for round shapes."""
    if answer.curved is None:
        return scene
    round_scene = smooth(answer.curved, outward=isinstance(answer, Path))
    return round_scene if len(round_scene.obstacles) == len(scene.obstacles) else scene
