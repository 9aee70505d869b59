"""Scenes as they look: round shapes by so many edges that they are round to the eye."""

from __future__ import annotations

from cfree.errors import UnsupportedError
from cfree.paths.path import Path
from cfree.planning.separation import Separated
from cfree.scene.scene import Scene, largest_of

EDGES = 4000  # parts of the largest shape's size that nobody sees


def of_polygons(answer: Path | Separated, scene: Scene) -> Scene:
    """The scene of polygons that an answer is about.

    Raises
    ------
    UnsupportedError
        If the scene has round shapes, and the answer does not bring polygons for them.
    """
    if not scene.curved:
        return scene
    if answer.scene is None:
        raise UnsupportedError("the scene has round shapes, and the answer no polygons for them; give its own scene")
    return answer.scene


def looks(answer: Path | Separated, scene: Scene) -> Scene:
    """The same scene with the round shapes that the answer is for, if it is for such."""
    if answer.curved is None:
        return scene
    found = smooth(answer.curved, outward=isinstance(answer, Path))
    return found if len(found.obstacles) == len(scene.obstacles) else scene


def smooth(scene: Scene, *, outward: bool = True) -> Scene:
    """Polygons that look round."""
    if not scene.curved:
        return scene
    error = largest_of(scene) / EDGES
    return scene.outer(error) if outward else scene.inner(error)
