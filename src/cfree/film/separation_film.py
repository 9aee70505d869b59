"""The film of a separation: the proof of a scene, and the boundary, the surface and the words that show a proof."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from cfree.collision.nearest_free import refuse_forbidden
from cfree.film.frame import Stage
from cfree.film.separation_shots import separation_shots, separation_window
from cfree.forbidden.boundary import boundary as boundary_among
from cfree.formats.answers.path_text import has_polygons
from cfree.free.space import free_space
from cfree.planning.curved import CurvedPlanner
from cfree.planning.options import Options
from cfree.planning.planner import Planner
from cfree.planning.rounded_cells import round_cells
from cfree.planning.separation import Separated
from cfree.plot.answer import surface_of
from cfree.scene.rounded import rounded_shapes
from cfree.scene.scene import grown_scene, required
from cfree.scene.smooth import smooth_geometries

if TYPE_CHECKING:
    from cfree.exact.pose import Pose
    from cfree.film.storyboard import Shot
    from cfree.forbidden.boundary import Boundary
    from cfree.paths.path import Path
    from cfree.planning.proof import Proof
    from cfree.scene.scene import Scene

DIGITS = 6  # of the share of a polygon that is outside of a shape, which may be rounding


def answer_of(boundary: Boundary) -> Separated:
    """Return the proof that there is no path between the ends of a scene.

    Raises
    ------
    ValueError
        If there is a path, or the scene has no ends.
    UndecidedError
        If neither is proved among round shapes.
    """
    scene = boundary.scene
    start, goal = required(scene, None, None)
    answer = (_among_rounds if scene.curved else _among_polygons)(boundary, start, goal)
    if not isinstance(answer, Separated):
        raise ValueError("there is a path from start to goal, and no proof; film it with the storyboard path")
    return answer


def _among_polygons(boundary: Boundary, start: Pose, goal: Pose) -> Path | Proof:
    return Planner(boundary.scene, free_space(boundary)).plan(start, goal)


def _among_rounds(boundary: Boundary, start: Pose, goal: Pose) -> Path | Proof | None:
    """Return a proof, preferably by the round shapes' own surface; or a path, None if cells know that there is one."""
    scene, space = boundary.scene, free_space(boundary)
    for name, pose in (("start", start), ("goal", goal)):
        refuse_forbidden(boundary.checker, pose, name)
    if space.common_cell(start, goal) is not None:
        return None
    cells = round_cells(scene, Options(), most=sys.maxsize)  # a few times the work of the boundary
    proof = None if cells is None else cells.proof(start, goal)
    return CurvedPlanner(Planner(scene, space)).plan(start, goal) if proof is None else proof


def separation_film(
    boundary: Boundary, answer: Separated, frames: int, size: tuple[int, int], fps: int
) -> tuple[Stage, list[Shot]]:
    """Return the film of a separation: its stage and its shots.

    The robot moves among the shapes of the boundary's scene, which may be round ones where the answer has polygons. If
    the answer is for a clearance, it keeps this clearance.

    Raises
    ------
    ValueError
        If no surface separates start and goal, but exact fits do.
    """
    if not len(answer.pieces):
        raise ValueError("nothing to show: no surface separates start and goal, but exact fits do")
    scene = boundary.scene
    surface = surface_of(answer, scene)
    window = separation_window(answer, surface)
    if answer.clearance:
        boundary = boundary_among(grown_scene(scene, answer.clearance))
    words = _blocking(answer, scene), surface_in_words(answer, scene)
    shots = separation_shots(boundary, answer, window, frames, *words)
    return Stage(boundary, size, fps, surface, window, scene), shots


def surface_in_words(answer: Separated, scene: Scene) -> str:
    """Describe the shapes whose contacts form the surface, among round shapes or for a clearance; else return "".

    Examples
    --------
    >>> import cfree
    >>> disc, posts = cfree.Curved.circle((0, 0), 1), [cfree.Curved.circle((0, y), 1) for y in (-3, 0, 3)]
    >>> scene = cfree.Scene(disc, posts, bounds=(-9, -3, 9, 3), start=(-5, 0, 0), goal=(5, 0, 0))
    >>> surface_in_words(answer_of(cfree.boundary(scene)), scene)
    'surface of a slightly smaller robot'
    """
    if answer.rounded:
        shapes = rounded_shapes(grown_scene(scene, answer.clearance) if answer.clearance else scene)
        is_robot = shapes is None or shapes.robot != answer.rounded.robot
        return f"surface of {'a slightly smaller robot' if is_robot else 'slightly smaller obstacles'}"
    if answer.cores or has_polygons(answer):
        return "surface of polygons inside the shapes"
    return ""


def _blocking(answer: Separated, scene: Scene) -> list[int]:
    """Return the blocking obstacles, by their numbers in a scene; polygons in an answer are inside its round shapes."""
    if answer.rounded or answer.scene is None or not scene.curved:
        return [*answer.obstacles]
    import shapely

    shapes = smooth_geometries(scene, scene.obstacles)
    tree, found = shapely.STRtree(shapes), list[int]()
    for number in answer.obstacles:
        if number < 0:
            found.append(number)
            continue
        polygon = answer.scene.obstacles[number].to_shapely()
        around = tree.query_nearest(polygon.representative_point()).tolist()
        outside = [round(polygon.difference(shapes[k]).area / polygon.area, DIGITS) for k in around]
        found.append(min(zip(outside, (shapes[k].area for k in around), around, strict=True))[2])
    return [*dict.fromkeys(found)]
