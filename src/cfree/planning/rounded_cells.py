"""Proofs by the exact cells of rounded shapes: docs/theory/rounded-shapes.md.

The robot's disc, or those of the obstacles, become a little smaller, and bounds a little larger. If start and goal are
then in different cells, a closed surface of contacts of the smaller shapes separates them, and at each of its poses the
true shapes overlap.
"""

from __future__ import annotations

import os
import time
from dataclasses import dataclass
from fractions import Fraction
from itertools import count

import cfree._core as _core
from cfree.exact.pose import Pose
from cfree.libraries import np
from cfree.planning.options import Options
from cfree.planning.separation import Pieces, Separated
from cfree.planning.smaller_shapes import smaller
from cfree.polygons.polygon import Polygon
from cfree.scene.features import SceneFeatures, features_of_cores
from cfree.scene.frame import frame_of
from cfree.scene.rounded import Cores, rounded_shapes
from cfree.scene.scene import Bounds, Scene, grown_scene, robot_radius

SMALLER = 100  # least power of 1/2 by which discs are smaller; or twice the digits of the scene's numbers
WORK = 15_000  # most pairs of a patch and a pillar near it for which cells are computed: some seconds
FEW = 2_000  # the same, for half a second
PATCHES = 6  # of two vertices, about: an edge of each on the other one, and four quadrants


@dataclass(frozen=True, eq=False)
class RoundCells:
    """Cells of shapes that are a little smaller than a scene's, for proofs about any poses.

    Attributes
    ----------
    scene : Scene
    clearance : Fraction
    cores : Cores
        The smaller shapes.
    bounds : four numbers, optional
        Bounds that are larger than the scene's.
    """

    scene: Scene
    clearance: Fraction
    cores: Cores
    bounds: Bounds | None
    _features: SceneFeatures
    _boundary: _core.Boundary
    _space: _core.FreeSpace

    def proof(self, start: Pose, goal: Pose) -> Separated | None:
        """Return a proof that no motion joins two free poses; None if they are in the closure of one cell."""
        space, features = self._space, self._features
        first, second = (set(space.cells_at(*features.in_chart(pose))) for pose in (start, goal))
        if first & second:
            return None
        surfaces, depth = space.surfaces, space.depth
        bounding = surfaces.free_inside.view(np.bool_)
        # the outer surface of the deeper cell has the other pose outside
        outer = {int(cell): k for k, cell in zip(count(), space.cell_of.tolist()) if bounding[k]}
        deepest = max((outer[cell] for cell in first | second if cell in outer), key=lambda k: int(depth[k]))
        faces = np.flatnonzero(surfaces.component == deepest).astype(np.int32)
        scene = self.scene
        given = {"scene": None, "curved": scene} if scene.curved else {"scene": scene}
        return Separated(
            start,
            goal,
            "closed",
            Pieces._of_faces(features, self._boundary, faces),
            bounds=self.bounds,
            units=scene.units,
            frame=frame_of(scene),
            clearance=self.clearance,
            rounded=self.cores,
            **given,
        )


def round_cells(scene: Scene, options: Options, most: int = WORK) -> RoundCells | None:
    """Compute the cells of shapes that are a little smaller than a scene's, with the options' clearance.

    Parameters
    ----------
    scene : Scene
    options : Options
    most : int
        Most pairs of a patch and a pillar near it.

    Returns
    -------
    RoundCells, or None
        None if shapes are not polygons, segments and points grown by discs, the robot's parts by one radius, if
        neither the robot nor all obstacles have discs, or if that would take longer.
    """
    clearance = options.clearance
    shapes = rounded_shapes(grown_scene(scene, clearance) if clearance else scene)
    if shapes is None or not shapes.is_round:
        return None
    by = Fraction(1, 2 ** max(SMALLER, 2 * _digits(scene, shapes)))
    cores, bounds = _smaller(shapes, by, is_in_workspace=scene.workspace is not None), None
    if cores is None:
        return None
    if scene.bounds:
        far = by * Fraction(robot_radius(scene))
        x0, y0, x1, y1 = scene.bounds
        bounds = x0 - far, y0 - far, x1 + far, y1 + far
    end = None if options.max_seconds is None else time.monotonic() + options.max_seconds
    features = features_of_cores(cores, scene, bounds)
    if work_for(features) > most:
        return None
    has_slits = _core.may_have_slits(features.core)
    try:
        boundary = _core.compute_boundary(
            features.core, os.cpu_count() or 1, has_slits, lambda _: end is None or time.monotonic() < end
        )
        if not boundary.trimmed.all():
            return None
        space = _core.free_space(_core.glue(boundary, 1))
    except RuntimeError:  # a tie that the core does not resolve: other ways to an answer are left
        return None
    return RoundCells(scene, clearance, cores, bounds, features, boundary, space)


def separated_by_cells(scene: Scene, start: Pose, goal: Pose, options: Options) -> Separated | None:
    """Return a proof that no motion joins two free poses; None if cells give none."""
    cells = round_cells(scene, options)
    return None if cells is None else cells.proof(start, goal)


def _smaller(shapes: Cores, by: Fraction, *, is_in_workspace: bool) -> Cores | None:
    """Make the robot or all obstacles smaller, preferably by their discs; None if neither can be."""
    robot = shapes.robot, lambda parts: Cores(parts, shapes.obstacles)
    others = shapes.obstacles, lambda parts: Cores(shapes.robot, parts)
    sides = [robot] if is_in_workspace or not shapes.obstacles else [robot, others]
    for side, with_parts in sorted(sides, key=lambda pair: not all(shape.radius for shape in pair[0])):
        parts = [smaller(shape, by) for shape in side]
        if all(parts):
            return with_parts(tuple(filter(None, parts)))
    return None


def _digits(scene: Scene, shapes: Cores) -> int:
    """Return the most bits of a denominator among the numbers of a scene."""
    all_shapes = (*shapes.robot, *shapes.obstacles)
    most = [shape.radius.denominator for shape in all_shapes]
    most += [number.denominator for shape in all_shapes for arc in shape.arcs for number in arc.numbers]
    for core in (shape.core for shape in all_shapes):
        most += [core.denominator] if isinstance(core, Polygon) else [c.denominator for point in core for c in point]
    most += [Fraction(bound).denominator for bound in scene.bounds or ()]
    most += [scene.workspace.denominator] if isinstance(scene.workspace, Polygon) else []
    return max(number.bit_length() for number in most)


def work_for(features: SceneFeatures) -> int:
    """Return how many pairs of a patch and a pillar near it there are, about."""
    robot, others = features.robot, features.obstacles
    size = np.ptp(robot.near, axis=0) + 2 * robot.radius.max()
    rings = len(others.previous)
    ends = np.stack([others.near[others.v[:rings]], others.near[others.w[:rings]]])
    radius = others.radius[:rings, None]
    low, high = ends.min(axis=0) - radius, ends.max(axis=0) + radius
    starts = others.core.piece[:-1]
    corners = others.core.piece_vertex
    grown = others.radius[corners, None]
    first = np.minimum.reduceat(others.near[corners] - grown, starts)
    last = np.maximum.reduceat(others.near[corners] + grown, starts)
    boxes = zip(low, high, strict=True)
    near = sum(int(((first <= b + size) & (a <= last + size)).all(axis=1).sum()) for a, b in boxes)
    return near * len(robot.previous) * PATCHES * len(robot.pieces)
