"""Proofs by the exact cells of rounded shapes: docs/theory/rounded-shapes.md.

The robot's disc, or those of the obstacles, become a little smaller. If start and goal are then in different cells, a
closed surface of contacts of the smaller shapes separates them, and at each of its poses the true shapes overlap.
"""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from itertools import count

import cfree._core as _core
from cfree.exact.pose import Pose
from cfree.libraries import np
from cfree.planning.options import Options
from cfree.planning.separation import Pieces, Separated
from cfree.scene.features import features_of_cores
from cfree.scene.frame import frame_of
from cfree.scene.rounded import Cores, Rounded, rounded_shapes
from cfree.scene.scene import Scene, grown_scene

SMALLER = 10, 40, 100  # powers of 1/2 by which discs are smaller, one after the other
PAIRS = 4_000  # most pairs of corners for which cells are computed: some seconds


def separated_by_cells(scene: Scene, start: Pose, goal: Pose, options: Options) -> Separated | None:
    """Return a proof that no motion joins two poses; None if cells give none.

    The scene's shapes must be polygons, segments and points grown by discs, the robot's parts by one radius, with discs
    on the robot or on all obstacles, and few.
    """
    clearance = options.clearance
    shapes = rounded_shapes(grown_scene(scene, clearance) if clearance else scene)
    if shapes is None or shapes.has_arcs or scene.bounds is not None or (radius := shapes.robot_radius) is None:
        return None
    corners = [sum(len(part.handle) for part in parts) for parts in (shapes.robot, shapes.obstacles)]
    is_grown = radius or (shapes.obstacles and all(other.radius for other in shapes.obstacles))
    if corners[0] * corners[1] > PAIRS or not is_grown or (scene.workspace and not radius):
        return None
    end = math.inf if options.max_seconds is None else time.monotonic() + options.max_seconds
    for power in SMALLER:
        cores = _smaller(shapes, Fraction(1, 2**power))
        pieces = _surface(scene, cores, start, goal, lambda _: time.monotonic() < end)
        if pieces is not None:
            given = {"scene": None, "curved": scene} if scene.curved else {"scene": scene}
            return Separated(
                start,
                goal,
                "closed",
                pieces,
                units=scene.units,
                frame=frame_of(scene),
                clearance=clearance,
                rounded=cores,
                **given,
            )
    return None


def _smaller(shapes: Cores, by: Fraction) -> Cores:
    def less(shape: Rounded) -> Rounded:
        return replace(shape, radius=shape.radius * (1 - by))

    if shapes.robot[0].radius:
        return Cores(tuple(map(less, shapes.robot)), shapes.obstacles)
    return Cores(shapes.robot, tuple(map(less, shapes.obstacles)))


def _surface(scene: Scene, cores: Cores, start: Pose, goal: Pose, go_on: Callable[[float], bool]) -> Pieces | None:
    features = features_of_cores(cores, scene)
    boundary = _core.compute_boundary(features.core, os.cpu_count() or 1, False, go_on)
    if not boundary.trimmed.all():
        return None
    complex_ = _core.glue(boundary, 1)
    space = _core.free_space(complex_)
    first, second = (set(space.cells_at(*features.in_chart(pose))) for pose in (start, goal))
    if first & second:
        return None
    surfaces, depth = space.surfaces, space.depth
    bounding = surfaces.free_inside.view(np.bool_)
    # the outer surface of the deeper cell has the other pose outside
    outer = {int(cell): k for k, cell in zip(count(), space.cell_of.tolist()) if bounding[k]}
    deepest = max((outer[cell] for cell in first | second if cell in outer), key=lambda k: int(depth[k]))
    return Pieces._of_faces(features, boundary, np.flatnonzero(surfaces.component == deepest).astype(np.int32))
