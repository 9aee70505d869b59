"""Scenes of rounded shapes in folders of tiles, compared with the same in one process; and random ones."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from fractions import Fraction
from pathlib import Path

import numpy as np

import cfree
import facing_arcs
import rounded_families as families
from cfree import Curved, Polygon, Pose, Scene
from cfree.collision.nearest_free import centers
from cfree.curves import Arc
from cfree.distributed import Sharded, boundary
from cfree.exact.number import rational_root

FACING = ("mixed", "turned", "both", "fits", "lattice", "blended")
TAUS = ("0", "1", "-1", "inf", "1/2", "-3")


def round_scene(family: str, seed: int) -> Scene:
    """A random scene, the same for ever."""
    if family in FACING:
        return facing_arcs.scene(family, seed)
    plain = families.scene(family, seed)
    robot, obstacles = ([_shape(shape) for shape in shapes] for shapes in (plain.robot, plain.obstacles))
    workspace = Polygon(plain.workspace) if plain.workspace else None
    return Scene(robot, obstacles, workspace=workspace, bounds=plain.bounds)


def _shape(shape: families.Shape) -> Curved | Polygon:
    """A grown core; a segment of irrational length is replaced by its first end, and what has no area by a disc."""
    points, radius = shape.core, shape.radius
    if len(points) < 3:
        radius = radius or Fraction(1, 8)
    if len(points) > 2:
        return Curved(points, grown=radius) if radius else Polygon(points)
    p, q = points[0], points[-1]
    length = rational_root((q[0] - p[0]) ** 2 + (q[1] - p[1]) ** 2)
    if not length:
        return Curved.circle(p, radius)
    u, v = (radius * (q[1] - p[1]) / length, radius * (p[0] - q[0]) / length)
    a, b, c, d = (p[0] + u, p[1] + v), (q[0] + u, q[1] + v), (q[0] - u, q[1] - v), (p[0] - u, p[1] - v)
    return Curved([a, b, Arc(c, center=q), d, Arc(a, center=p)])


def tile_faults(scene: Scene, folder: Path, counts: Sequence[int], *, is_verified: bool = False) -> Iterator[str]:
    """Differences between numbers of tiles, and from the cells of the whole."""
    whole = cfree.boundary(scene)
    space = cfree.free_space(whole)
    results = set()
    for tiles in counts:
        found = boundary(scene, folder=folder / str(tiles), tiles=tiles)
        surfaces, volume, error = found.surfaces, found.cells.volume, found.cells.volume_error
        results.add((found.digest, found.trapezoids, volume.tobytes(), error.tobytes()))
        pairs = {name: (getattr(surfaces, name), getattr(space, name)) for name in ("turns", "cell_of", "free_inside")}
        pairs["parent"] = surfaces.parent, space.parent
        pairs["faces"] = surfaces.faces, np.bincount(space.component, minlength=len(space.parent))
        pairs["euler"] = surfaces.euler, space.complex.euler
        pairs["caged"] = found.cells.caged, np.array([cell.caged for cell in space.cells], bool)
        yield from (
            f"{tiles} tiles: {name}" for name, (ours, theirs) in pairs.items() if not np.array_equal(ours, theirs)
        )
        bounded = np.isfinite(space.volumes)
        if len(volume) != len(bounded):
            yield f"{tiles} tiles: number of cells"
            return
        difference = np.abs(volume[bounded] - space.volumes[bounded])
        if not np.all(difference <= (error + space.volume_errors)[bounded]):
            yield f"{tiles} tiles: volumes {volume} {space.volumes}"
        yield from location_faults(found, space)
        if is_verified:
            checked = found.verify()
            yield from (f"{tiles} tiles: {finding}" for finding in checked.findings[:3])
    if len(results) > 1:
        yield f"{len(results)} results for {counts} tiles"


def location_faults(found: Sharded, space: cfree.FreeSpace, seed: int = 5) -> Iterator[str]:
    """Poses whose cells differ: anywhere, and with a center on a center or beside it, at rational orientations."""
    scene, rng = space.boundary.scene, random.Random(seed)
    others = (*scene.obstacles, *([scene.workspace] if scene.workspace else []))
    boxes = np.array([cfree.scene.scene.box_of(shape) for shape in others] or [(-1.0, -1.0, 1.0, 1.0)])
    (x0, y0), (x1, y1) = boxes[:, :2].min(axis=0) - 2, boxes[:, 2:].max(axis=0) + 2
    xy = [(rng.uniform(x0, x1), rng.uniform(y0, y1)) for _ in range(40)]
    poses = cfree.Poses(xy, [rng.uniform(0, 7) for _ in xy])
    if found.locate(poses).tolist() != space.locate(poses).tolist():
        yield "cells of random poses"
    fixed = centers(others) or [(Fraction(0), Fraction(0))]
    moving = centers(scene.robot) or [(Fraction(0), Fraction(0))]
    special = []
    for tau in TAUS:
        (turned,) = Pose(0, 0, {"tau": tau}).apply_exact([rng.choice(moving)])
        for by in (Fraction(0), Fraction(1, 2), Fraction(1)):
            p = rng.choice(fixed)
            special.append(Pose(p[0] - turned[0] + by * rng.randint(-4, 4), p[1] - turned[1], {"tau": tau}))
    if found.locate(special).tolist() != space.locate(special).tolist():
        yield f"cells of special poses {found.locate(special).tolist()} {space.locate(special).tolist()}"
    if found.is_free(special).tolist() != cfree.is_free(scene, special).tolist():
        yield "free poses"
