"""Compare a boundary's slices with the oracles; `python compared.py SCENE.json` prints the faults of one scene file."""

from __future__ import annotations

import json
import sys
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

import oracles
from cfree import Boundary, Polygon, Scene, _core, boundary, load_scene
from cfree.forbidden.boundary import boundary_of
from cfree.forbidden.patch import Contact, Patch, Place
from cfree.scene.features import scene_features
from shapes import PlainScene, Shape

Point = tuple[Fraction, Fraction]


def scene_of(plain: PlainScene) -> Scene:
    return Scene(
        robot=[Polygon(*shape) for shape in plain.robot],
        obstacles=[Polygon(*shape) for shape in plain.obstacles],
        bounds=plain.bounds,
        workspace=None if plain.workspace is None else Polygon(*plain.workspace),
    )


def plain_of(scene: Scene) -> PlainScene:
    """Exact coordinates of the scene."""

    def shape(polygon: Polygon) -> Shape:
        outer, *holes = (list(polygon.exact_vertices[i:j]) for i, j in pairwise(polygon.ring_offsets))
        return outer, holes

    workspace = None if scene.workspace is None else shape(scene.workspace)
    return PlainScene([*map(shape, scene.robot)], [*map(shape, scene.obstacles)], scene.bounds, workspace)


def part_of(scene: Scene) -> Boundary:
    """A boundary stopped at the first look at limits after some patches, on one thread."""
    features = scene_features(scene)
    return boundary_of(scene, features, _core.compute_boundary(features.core, 1, False, lambda share: share == 0))


def length(segments: NDArray[np.float64]) -> float:
    return float(np.hypot(*(segments[:, 1] - segments[:, 0]).T).sum())


def slit_length(segments: NDArray[np.float64], tolerance: float) -> float:
    """Length of the parts of segments that lie on each other with opposite directions, both counted.

    Between them is a free part of no width: C_forb is open, its closure, which the oracle unites, is not.
    """
    vectors = segments[:, 1] - segments[:, 0]
    lengths = np.hypot(*vectors.T)
    long = lengths > tolerance
    segments, lengths, vectors = segments[long], lengths[long], vectors[long] / lengths[long, None]
    sine = vectors[:, None, 0] * vectors[None, :, 1] - vectors[:, None, 1] * vectors[None, :, 0]
    total = 0.0
    for i, j in zip(*np.nonzero((np.abs(sine) < 1e-7) & (vectors @ vectors.T < 0)), strict=True):
        away = segments[j] - segments[i, 0]
        if np.abs(vectors[i, 0] * away[:, 1] - vectors[i, 1] * away[:, 0]).max() < tolerance:
            along = np.sort(away @ vectors[i])
            total += max(0.0, min(lengths[i], along[1]) - max(0.0, along[0]))
    return total


def mistakes(plain: PlainScene, result: Boundary, angle: Any, tolerance: float = 1e-9) -> list[str]:
    """Differences between a slice and the oracle's: region, perimeter, validity; none if all is well.

    The tolerance is relative to the size of the scene.
    """
    cut = result.slice(angle)
    forbidden = cut.forbidden
    oracle = oracles.forbidden_slice(plain.robot, plain.obstacles, cut.theta, plain.bounds, plain.workspace)
    if result.features.rim is not None:  # both without end: compare the free parts
        rim = shapely.box(*result.features.rim)
        window = oracles.window(plain.robot, plain.obstacles, plain.bounds, plain.workspace)
        forbidden, oracle = rim.difference(forbidden), window.difference(oracle)
    size = max(1e-300, *np.ptp(np.reshape([*oracle.bounds, *forbidden.bounds], (-1, 2)), axis=0), oracle.length)
    wrong = [] if shapely.is_valid(cut.forbidden) else ["the forbidden region is not valid"]
    difference = forbidden.symmetric_difference(oracle).area
    if not difference <= tolerance * size * size:
        wrong.append(f"theta {angle}: the regions differ by {difference:.3g}, oracle {oracle.area:.6g}")
    mine = length(cut.segments)
    if not abs(mine - oracle.length) <= tolerance * size:
        slits = slit_length(cut.segments, tolerance * size)
        if not abs(mine - slits - oracle.length) <= 10 * tolerance * size:
            wrong.append(f"theta {angle}: length {mine:.12g}, {slits:.3g} of it slits; oracle {oracle.length:.12g}")
    return wrong


# --- what names mean, from the scene's polygons ---


def vertex(scene: Scene, place: Place, *, of_robot: bool) -> Point:
    """The exact vertex that a place names."""
    if place.polygon == -1:
        if of_robot:
            return Fraction(0), Fraction(0)
        assert scene.bounds is not None
        x0, y0, x1, y1 = scene.bounds
        return [(x0, y0), (x0, y1), (x1, y1), (x1, y0)][place.index]
    polygon = polygon_of(scene, place, of_robot=of_robot)
    assert polygon.ring_offsets[place.ring] <= place.index < polygon.ring_offsets[place.ring + 1]
    return polygon.exact_vertices[place.index]


def edge(scene: Scene, place: Place, *, of_robot: bool) -> tuple[Point, Point]:
    """Start and vector of the exact edge that a place names."""
    assert place.end is not None
    p = vertex(scene, place, of_robot=of_robot)
    ring = place.ring if place.polygon == -1 else ring_of(polygon_of(scene, place, of_robot=of_robot), place.end)
    q = vertex(scene, Place(place.polygon, place.name, ring, place.end), of_robot=of_robot)
    return p, (q[0] - p[0], q[1] - p[1])


def ring_of(polygon: Polygon, index: int) -> int:
    return next(k for k, end in enumerate(polygon.ring_offsets[1:]) if index < end)


def polygon_of(scene: Scene, place: Place, *, of_robot: bool) -> Polygon:
    if place.polygon == -2:
        assert scene.workspace is not None
        return scene.workspace
    return (scene.robot if of_robot else scene.obstacles)[place.polygon]


def rotation(chart: int, tau: Fraction) -> Point:
    """Exact cosine and sine of 2 atan(tau), or of that and a half turn."""
    c, s = oracles.exact_rotation(tau)
    return (-c, -s) if chart else (c, s)


def turned(turn: Point, p: Point) -> Point:
    return turn[0] * p[0] - turn[1] * p[1], turn[1] * p[0] + turn[0] * p[1]


def placed(scene: Scene, contact: Contact, turn: Point) -> tuple[Point, Point]:
    """A contact's point and direction in a slice: forbidden on the left; a v-v contact has no direction."""
    zero = Fraction(0), Fraction(0)
    (a, along), (b, direction) = (vertex(scene, contact.robot, of_robot=True), zero), (zero, zero)
    b = vertex(scene, contact.obstacle, of_robot=False)
    if contact.kind == "v-e":
        b, direction = edge(scene, contact.obstacle, of_robot=False)
    if contact.kind == "e-v":
        a, along = edge(scene, contact.robot, of_robot=True)
        direction = turned(turn, (-along[0], -along[1]))
    ra = turned(turn, a)
    return (b[0] - ra[0], b[1] - ra[1]), direction


def cross(p: Point, q: Point) -> Fraction:
    return p[0] * q[1] - p[1] * q[0]


def minus(p: Point, q: Point) -> Point:
    return p[0] - q[0], p[1] - q[1]


def main(path: Path) -> None:
    scene = load_scene(path)
    plain, result = plain_of(scene), boundary(scene, threads=1)
    angles = scene.check.get("angles", [0.1, 1.3, 2.9, 4.4])
    wrong = [line for angle in angles for line in mistakes(plain, result, angle, scene.check.get("tolerance", 1e-9))]
    print(json.dumps(wrong, indent=1))
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main(Path(sys.argv[1]))


def own_contact(patch: Patch) -> Contact:
    return Contact("v-e" if patch.kind == "bound" else patch.kind, patch.robot, patch.obstacle)
