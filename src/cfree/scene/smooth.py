"""Round shapes as polygons with so many edges that they look round: for pictures, outlines and names of edges."""

from __future__ import annotations

from cfree.scene.scene import Scene, largest_of

EDGES = 4000  # one part of so many of the largest shape's size is invisible


def smooth(scene: Scene, *, outward: bool = True) -> Scene:
    """Replace round shapes by polygons that look round."""
    if not scene.curved:
        return scene
    error = largest_of(scene) / EDGES
    return scene.outer(error) if outward else scene.inner(error)
