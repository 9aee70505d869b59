"""Proofs by the exact cells of rounded shapes: docs/theory/rounded-shapes.md.

The robot, or all obstacles, become a little smaller, and bounds a little larger. If start and goal are then in
different cells, a closed surface of contacts of the smaller shapes separates them, and at each of its poses the true
shapes overlap.
"""

from __future__ import annotations

import os
import time
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import count
from threading import Lock

import cfree._core as _core
from cfree.exact.pose import Pose
from cfree.libraries import np
from cfree.planning.options import Options
from cfree.planning.separation import Pieces, Separated
from cfree.planning.smaller_shapes import smaller
from cfree.polygons.polygon import Polygon
from cfree.scene.features import SceneFeatures, features_of_cores
from cfree.scene.frame import frame_of
from cfree.scene.grown_cores import Cores
from cfree.scene.rounded import rounded_shapes
from cfree.scene.scene import Bounds, Scene, grown_scene, robot_radius
from cfree.value import kept

SMALLER = 100  # least power of 1/2 by which shapes are smaller; or twice the digits of the scene's numbers
WORK = 30_000  # most pairs of a patch and a pillar near it for which cells are computed: some seconds
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

    The scene caches the result.

    Parameters
    ----------
    scene : Scene
    options : Options
    most : int
        Most pairs of a patch and a pillar near it.

    Returns
    -------
    RoundCells, or None
        None if shapes are not polygons with arcs, segments and points, some of them grown by discs; if neither the
        robot nor all obstacles can be made smaller; or if that would take longer.
    """
    end = None if options.max_seconds is None else time.monotonic() + options.max_seconds
    made, clearance = kept(scene, _Made.none_for), options.clearance
    if not made.lock.acquire(timeout=-1 if end is None else options.max_seconds or 0.0):
        return None
    try:
        if clearance not in made.cells:
            shapes = _shapes_for(scene, clearance)
            features = None if shapes is None else features_of_cores(shapes[0], scene, shapes[1])
            if features is not None and work_for(features) > most:
                return None
            made.cells[clearance] = None
            if shapes is not None and features is not None:
                try:
                    made.cells[clearance] = _computed(*shapes, features, end)
                except TimeoutError:
                    del made.cells[clearance]
                    return None
        cells = made.cells[clearance]
    finally:
        made.lock.release()
    return None if cells is None else RoundCells(scene, clearance, *cells)


Cells = tuple[Cores, Bounds | None, SceneFeatures, _core.Boundary, _core.FreeSpace]


@dataclass(eq=False)
class _Made:
    """Cells by clearance, None where there are none; several threads may ask for them."""

    lock: Lock = field(default_factory=Lock)
    cells: dict[Fraction, Cells | None] = field(default_factory=dict)

    @classmethod
    def none_for(cls, scene: Scene) -> _Made:
        return cls()


def _shapes_for(scene: Scene, clearance: Fraction) -> tuple[Cores, Bounds | None] | None:
    """Return smaller shapes and larger bounds; None if there are none, or if all shapes are polygons."""
    shapes = rounded_shapes(grown_scene(scene, clearance) if clearance else scene)
    if shapes is None or not shapes.is_round:
        return None
    by = Fraction(1, 2 ** max(SMALLER, 2 * _digits(scene, shapes)))
    cores, bounds = _smaller(shapes, by, is_in_workspace=scene.workspace is not None), None
    if cores is None:
        return None
    if scene.bounds:
        far = by * Fraction(robot_radius(scene) or 1.0)
        x0, y0, x1, y1 = scene.bounds
        bounds = x0 - far, y0 - far, x1 + far, y1 + far
    return cores, bounds


def _computed(cores: Cores, bounds: Bounds | None, features: SceneFeatures, end: float | None) -> Cells | None:
    """Return the cells; None if the core does not resolve a tie. Raises TimeoutError."""
    has_slits = _core.may_have_slits(features.core)
    try:
        boundary = _core.compute_boundary(
            features.core, os.cpu_count() or 1, has_slits, lambda _: end is None or time.monotonic() < end
        )
        if not boundary.trimmed.all():
            raise TimeoutError
        return cores, bounds, features, boundary, _core.free_space(_core.glue(boundary, 1))
    except RuntimeError:  # other ways to an answer are left
        return None


def separated_by_cells(scene: Scene, start: Pose, goal: Pose, options: Options) -> Separated | None:
    """Return a proof that no motion joins two free poses; None if cells give none."""
    cells = round_cells(scene, options)
    return None if cells is None else cells.proof(start, goal)


def _smaller(shapes: Cores, by: Fraction, *, is_in_workspace: bool) -> Cores | None:
    """Make the robot or all obstacles smaller, preferably by their discs; None if neither can be."""
    sides = [shapes.robot] if is_in_workspace or not shapes.obstacles else [shapes.robot, shapes.obstacles]
    for side in sorted(sides, key=lambda parts: not all(shape.radius for shape in parts)):
        if (parts := smaller(side, by)) is not None:
            return replace(shapes, robot=parts) if side is shapes.robot else replace(shapes, obstacles=parts)
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
    radius = np.abs(others.radius[:rings, None])  # below 0 at concave arcs
    low, high = ends.min(axis=0) - radius, ends.max(axis=0) + radius
    starts = others.core.piece[:-1]
    corners = others.core.piece_vertex
    grown = others.radius[corners, None]
    first = np.minimum.reduceat(others.near[corners] - grown, starts)
    last = np.maximum.reduceat(others.near[corners] + grown, starts)
    boxes = zip(low, high, strict=True)
    near = sum(int(((first <= b + size) & (a <= last + size)).all(axis=1).sum()) for a, b in boxes)
    return near * len(robot.previous) * PATCHES * len(robot.pieces)
