"""Round shapes as polygons with so many edges that they look round: for pictures, outlines and names of edges."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate
from typing import TYPE_CHECKING

from cfree.libraries import shapely
from cfree.scene.scene import AnyShape, Scene, largest_of, polygons_for

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

EDGES = 4000  # one part of so many of the largest shape's size is invisible


def smooth(scene: Scene, *, outward: bool = True) -> Scene:
    """Replace round shapes by polygons that look round."""
    if not scene.curved:
        return scene
    return scene.outer(_error(scene)) if outward else scene.inner(_error(scene))


def smooth_geometries(scene: Scene, shapes: Sequence[AnyShape]) -> list[BaseGeometry]:
    """Return some of a scene's shapes for drawing, each as one geometry without seams."""
    error = _error(scene)
    return [shapely.union_all([p.to_shapely() for p in polygons_for(shape, error, outward=True)]) for shape in shapes]


def smoothed(scene: Scene, obstacle: int) -> int:
    """Return the obstacle that a polygon of `smooth` replaces; bounds and workspace keep their numbers."""
    if not scene.curved or obstacle < 0:
        return obstacle
    ends = accumulate(len(polygons_for(shape, _error(scene), outward=True)) for shape in scene.obstacles)
    return next(k for k, end in enumerate(ends) if obstacle < end)


def _error(scene: Scene) -> float:
    return largest_of(scene) / EDGES
