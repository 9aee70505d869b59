"""Grown cores inside shapes of a scene, exactly; the margin by which they are smaller."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from math import isqrt
from typing import Any

from flint import fmpq

from cfree.curves.curved import Curved
from cfree.curves.drawn import Line
from cfree.curves.rings import Circle
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import AnyShape
from cfree.verify.arcs import exact
from cfree.verify.curves import _Arc, _parts
from cfree.verify.round_proof import Core, RoundSeparation

Point = Any  # of fmpq
Wrong = Iterator[tuple[str, str]]


def largest_radius(core: Core, shape: AnyShape) -> Fraction | None:
    """Radius by which a core can be grown in a shape: the shape is just that; None if it is not.

    Examples
    --------
    >>> disc = Curved.circle((1, 2), "1/3")
    >>> largest_radius(((Fraction(1), Fraction(2)),), disc), largest_radius(((Fraction(1), Fraction(1)),), disc)
    (Fraction(1, 3), None)
    """
    if isinstance(shape, Polygon):
        return Fraction(0) if isinstance(core, Polygon) and core == shape else None
    if shape.grown and shape.is_polygon:
        same = isinstance(core, Polygon) and core == Polygon(shape.path, shape.holes)  # type: ignore[arg-type]
        return Fraction(shape.grown) if same else None
    if shape.holes:
        return None
    if isinstance(shape.path, Circle):
        return Fraction(shape.path.radius) + Fraction(shape.grown) if core == (shape.path.center,) else None
    radius = _rim_radius(core, shape)
    return None if radius is None else radius + Fraction(shape.grown)


def _rim_radius(core: Core, shape: Curved) -> Fraction | None:
    """Radius, if a ring of lines and arcs is the rim of a convex core grown by it.

    A ring is a simple closed curve, and so is the rim. It is all of the rim if every point of it is on the rim.
    """
    if isinstance(core, Polygon):
        if len(core.exact_rings) != 1:
            return None
        corners = [*map(exact, core.exact_rings[0])]
    else:
        corners = [*map(exact, core)]
    count = len(corners)
    if count > 2 and not all(
        _cross(_minus(q, p), _minus(r, q)) > 0
        for p, q, r in zip(corners, corners[1:] + corners[:1], corners[2:] + corners[:2], strict=True)
    ):
        return None
    radius: fmpq | None = None
    for piece in shape.curves[0]:
        for part in [piece] if isinstance(piece, Line) else _parts(piece):
            if isinstance(part, Line):
                continue
            if not isinstance(part, _Arc) or part.center not in corners:
                return None
            square = _dot(part.u, part.u)
            if square != _dot(part.v, part.v) or _dot(part.u, part.v) != 0:
                return None
            root = fmpq(isqrt(int(square.p)), isqrt(int(square.q)))
            if root * root != square or (radius is not None and root != radius):
                return None
            radius = root
            k = corners.index(part.center)
            first, _, last = (_minus(p, part.center) for p in part.hull())
            # within the cone of normals of both edges, which holds a quarter turn between two of its directions
            before, after = corners[k - 1], corners[(k + 1) % count]
            for n in (first, last):
                if count > 1 and not (
                    _dot(n, _minus(after, part.center)) <= 0 and _dot(n, _minus(before, part.center)) <= 0
                ):
                    return None
    if radius is None:
        return None
    for piece in shape.curves[0]:
        if isinstance(piece, Line) and not _is_beside(exact(piece.start), exact(piece.end), corners, radius):
            return None
    return Fraction(int(radius.p), int(radius.q))


def _is_beside(p: Point, q: Point, corners: list[Point], radius: Any) -> bool:
    """True if a segment is an edge of a convex core, or a part of it, moved outwards by a radius."""
    for a, b in pairwise([*corners, corners[0]]):
        e = _minus(b, a)
        long = _dot(e, e)
        if all(
            (h := _cross(e, _minus(x, a))) <= 0
            and h * h == radius * radius * long
            and 0 <= _dot(e, _minus(x, a)) <= long
            for x in (p, q)
        ):
            return True
    return False


def margin(proof: RoundSeparation, scene: Any) -> tuple[Fraction | None, list[tuple[str, str]]]:
    """Distance by which the scene's shapes are larger at least, and all that is not inside them."""
    wrong: list[tuple[str, str]] = []
    own: list[Fraction] = []
    if len(proof.obstacles) != len(scene.obstacles) or len(proof.radii) != len(proof.obstacles) or not proof.robot:
        return None, [("the scene", "the proof has other numbers of shapes")]
    for k, core in enumerate(proof.robot):
        radii = [r for shape in scene.robot if (r := largest_radius(core, shape)) is not None]
        if not radii:
            wrong.append((f"robot's core {k}", "no shape of the robot is this core, grown"))
        else:
            own.append(max(radii) - proof.radius)
    others: list[Fraction] = []
    for k, (core, radius, shape) in enumerate(zip(proof.obstacles, proof.radii, scene.obstacles, strict=True)):
        largest = largest_radius(core, shape)
        if largest is None:
            wrong.append((f"obstacle {k}", "its shape is not this core, grown"))
        elif radius < 0 or radius > largest:
            wrong.append((f"obstacle {k}", "its radius is larger than the scene's"))
        else:
            others.append(largest - radius)
    if wrong:
        return None, wrong
    if proof.radius < 0 or min(own) < 0:
        return None, [("robot", "its radius is larger than the scene's")]
    least = min(own) + min(others, default=Fraction(0))
    if proof.workspace is not None and (scene.workspace is None or proof.workspace != scene.workspace):
        return None, [("workspace", "it is not the scene's")]
    if proof.workspace is not None:
        least = min(least, min(own))
    if proof.bounds is not None:
        if scene.bounds is None:
            return None, [("bounds", "the scene has none")]
        (x0, y0, x1, y1), (p, q, r, s) = scene.bounds, proof.bounds
        least = min(least, x0 - p, y0 - q, r - x1, s - y1)
    if least <= 0:
        return None, [("margin", "the smaller shapes are not strictly inside of the scene's")]
    return least, []


def _minus(p: Point, q: Point) -> Point:
    return p[0] - q[0], p[1] - q[1]


def _dot(u: Point, v: Point) -> Any:
    return u[0] * v[0] + u[1] * v[1]


def _cross(u: Point, v: Point) -> Any:
    return u[0] * v[1] - u[1] * v[0]
