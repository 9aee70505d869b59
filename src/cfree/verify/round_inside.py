"""Rounded shapes inside shapes of a scene, exactly; the margin by which they are smaller."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import partial
from itertools import pairwise, product
from math import isqrt
from typing import Any

from flint import fmpq

from cfree.curves.curved import Curved
from cfree.curves.drawn import Line
from cfree.curves.rings import Circle
from cfree.exact.number import ExactPoint
from cfree.polygons.polygon import Polygon
from cfree.scene.complement import complement
from cfree.scene.grown_cores import Rounded, is_arc
from cfree.scene.scene import AnyShape
from cfree.verify.arcs import Part, Region, Spot, exact, is_near, is_nearer, is_of_arcs, rational, region_of
from cfree.verify.curves import _Arc, _parts
from cfree.verify.round_proof import RoundSeparation

Core = Polygon | tuple[ExactPoint, ...]
Point = Any  # of fmpq
LEAST_BITS, MOST_BITS = 1 << 14, 64  # of a margin, below 1 and above


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


def room(smaller: Rounded, shape: AnyShape) -> Fraction | None:
    """Distance by which a rounded shape is inside another shape, or a little less; None if it is not inside.

    Notes
    -----
    The rim of a core, grown by r, is all that makes contacts. It is inside a shape that is another one grown by g, if
    both have one rim and r is at most g. It also is if the core's rim is inside the other one, and is farther than
    r - g from its rim.

    Examples
    --------
    >>> square = Polygon([(0, 0), (4, 0), (4, 4), (0, 4)])
    >>> smaller = Rounded(Polygon([(1, 1), (3, 1), (3, 3), (1, 3)]), Fraction(1, 4))
    >>> room(smaller, square), room(Rounded(smaller.core, Fraction(1)), square)
    (Fraction(1, 2), None)
    """
    if smaller.radius < 0:
        return None
    if not smaller.arcs and (largest := largest_radius(smaller.core, shape)) is not None:
        return largest - smaller.radius if smaller.radius <= largest else None
    base, grown = _base(shape)
    if not is_of_arcs(base) or not all(map(is_arc, smaller.arcs)):
        return None
    region, rings = region_of(base), [*rim_parts(smaller)]
    if _is_on(rings, region):
        return grown - smaller.radius if smaller.radius <= grown else None
    if not all(region.holds(Spot.of(ring[0].p)) for ring in rings):
        return None
    return _distance([f for ring in rings for f in ring], region.parts, smaller.radius - grown)


def is_same(one: Rounded, shape: AnyShape) -> bool:
    """True if a rounded shape is just that shape.

    A ring whose vertices are different, and which is on another ring that has no other vertices, is all of it.
    """
    if not one.arcs:
        return largest_radius(one.core, shape) == one.radius
    base, grown = _base(shape)
    if not is_of_arcs(base) or not all(map(is_arc, one.arcs)):
        return False
    region, rings = region_of(base), [*rim_parts(one)]
    corners = {f.p for ring in rings for f in ring}
    return grown == one.radius and _is_on(rings, region) and all(g.p in corners for g in region.parts)


def _base(shape: AnyShape) -> tuple[AnyShape, Fraction]:
    """Shape without the disc by which it is grown, unless it is a polygon, and the disc's radius."""
    if not isinstance(shape, Curved):
        return shape, Fraction(0)
    return (shape if shape.is_polygon or not shape.grown else shape._grown_by(-shape.grown)), shape.grown


def _is_on(rings: Sequence[Sequence[Part]], region: Region) -> bool:
    """True if rings are on the rim of a region."""
    return all(any(_is_part(f, g) for g in region.parts) for ring in rings for f in ring)


def rim_parts(shape: Rounded) -> Iterator[list[Part]]:
    """Lines and arcs of a core."""
    arcs = {(arc.start, arc.end): (exact(arc.center), 1 if arc.is_convex else -1) for arc in shape.arcs}
    beyond = {arc.beyond[0] for arc in shape.arcs if arc.beyond}
    for ring in shape.core.exact_rings if isinstance(shape.core, Polygon) else [shape.core]:
        corners = [p for p in ring if p not in beyond]
        sides = pairwise([*corners, corners[0]])
        yield [Part(exact(p), exact(q), *arcs.get((p, q), (None, 0))) for p, q in sides if p != q or len(corners) == 1]


def _is_part(part: Part, whole: Part) -> bool:
    """True if a part of one rim is in a part of another."""
    ends = part.p, part.q
    return part.p != part.q and part.runs_along(whole) and all(whole.holds(Spot.of(end)) for end in ends)


def _distance(parts: Sequence[Part], others: Sequence[Part], least: Fraction) -> Fraction | None:
    """Power of two by which the distance of rims that do not meet exceeds a number; None if it hardly does."""
    smallest, more = Fraction(1, 2**LEAST_BITS), Fraction(2**MOST_BITS)
    for one, other in product(parts, others):
        near = partial(is_nearer, one) if one.p != one.q else partial(is_near, one.p)
        while near(other, rational(max(least + more, smallest))):
            more /= 2
            if more < smallest:
                return None
    return more


def margin(proof: RoundSeparation, scene: Any) -> tuple[Fraction | None, list[tuple[str, str]]]:
    """Distance by which the scene's shapes are larger at least, and all that is not inside them."""
    wrong: list[tuple[str, str]] = []
    around = complement(scene) if proof.frames else ()
    shapes = *scene.obstacles, *around
    if len(proof.obstacles) != len(shapes) or proof.frames != len(around) or not proof.robot:
        return None, [("the scene", "the proof has other numbers of shapes")]
    own, others = list[Fraction](), list[Fraction]()
    for k, part in enumerate(proof.robot):
        rooms = [r for shape in scene.robot if (r := room(part, shape)) is not None]
        own += [max(rooms)] if rooms else []
        wrong += [] if rooms else [(f"robot's core {k}", "it is not inside a shape of the robot")]
    for k, (smaller, shape) in enumerate(zip(proof.obstacles, shapes, strict=True)):
        its_room = room(smaller, shape)
        others += [] if its_room is None else [its_room]
        wrong += [(f"obstacle {k}", "its core is not inside its shape")] if its_room is None else []
    if wrong:
        return None, wrong
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
