"""Rounded shapes, which the core trims exactly: points, segments, and polygons with arcs as sides, grown by discs.

Polygons, grown polygons, discs, and shapes of lines and arcs of rational radii are rounded shapes.
docs/theory/rounded-shapes.md.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING

from cfree.curves.crossings import crossing
from cfree.curves.curved import Curved
from cfree.curves.drawn import Line
from cfree.curves.pieces import direction_of, quarters_of
from cfree.curves.rings import Circle, Piece, Span
from cfree.errors import InvalidPolygonError
from cfree.exact.number import ExactPoint, rational_root
from cfree.exact.vectors import cross, dot, minus
from cfree.polygons.polygon import Polygon
from cfree.scene.complement import complement
from cfree.scene.grown_cores import CoreArc, Cores, Rounded
from cfree.scene.hull_triangles import HullTriangle, hull_triangle, meeting

if TYPE_CHECKING:
    from cfree.scene.scene import AnyShape, Scene


FINEST_CUTS = 5  # of a quarter circle in halves, for chords that meet no other side
FINEST_FILLETS = 8  # the same where some are concave
WIDENINGS = [Fraction(1, 2**k) for k in range(2, 7)]  # how far points are beyond the tangents of concave arcs


def rounded(shape: AnyShape) -> Rounded | None:
    """Return a shape as a grown core; None if it is none, or a radius is irrational.

    Examples
    --------
    >>> disc = rounded(Curved.circle((1, 2), "1/3"))
    >>> disc.core == ((1, 2),), disc.radius
    (True, Fraction(1, 3))
    >>> from cfree.curves import Arc
    >>> stadium = Curved([(0, 0), (4, 0), Arc((4, 2), center=(4, 1)), (0, 2), Arc((0, 0), center=(0, 1))])
    >>> [tuple(map(int, p)) for p in rounded(stadium).core], rounded(Curved.ellipse((0, 0), (1, 2))) is None
    ([(4, 1), (0, 1)], True)
    >>> half = rounded(Curved([(1, 0), Arc((-1, 0), center=(0, 0))]))
    >>> [tuple(map(int, p)) for p in half.core.exact_vertices], half.radius, len(half.arcs)
    ([(1, 0), (0, 1), (-1, 0)], Fraction(0, 1), 2)
    """
    if isinstance(shape, Polygon):
        return Rounded(shape, Fraction(0))
    if shape.grown and shape.is_polygon:
        return Rounded(shape._base(), shape.grown)
    if isinstance(shape.path, Circle) and not shape.holes:
        return Rounded((shape.path.center,), shape.path.radius + shape.grown)
    found = None if shape.holes else _convex(shape.curves[0])
    found = found or _with_arcs(shape)
    return None if found is None else Rounded(found.core, found.radius + shape.grown, found.arcs)


def _convex(ring: Sequence[Piece]) -> Rounded | None:
    """Return a convex ring of lines and of arcs of one radius, all tangent."""
    radius, centers = None, list[ExactPoint]()
    for before, piece in zip([ring[-1], *ring[:-1]], ring, strict=True):
        if cross(direction_of(before, at_end=True), direction_of(piece, at_end=False)) != 0:
            return None
        if dot(direction_of(before, at_end=True), direction_of(piece, at_end=False)) < 0:
            return None
        if isinstance(piece, Line):
            continue
        if not isinstance(piece, Span) or not piece.is_circular:
            return None
        square = dot(piece.u, piece.u)
        if radius is not None and square != radius * radius:
            return None
        radius = rational_root(square)
        if radius is None or piece.sense != _turn(ring):
            return None
        if piece.center not in centers:
            centers.append(piece.center)
    if radius is None:
        return None
    core: Polygon | tuple[ExactPoint, ...] = tuple(centers) if len(centers) < 3 else Polygon(centers)
    return Rounded(core, radius)


def _turn(ring: Sequence[Piece]) -> int:
    """Return the sense of the first arc: that of a convex ring."""
    return next(piece.sense for piece in ring if isinstance(piece, Span))


# --- arcs in place of sides ---

Side = tuple[ExactPoint, ExactPoint, Span | None]


def _with_arcs(shape: Curved) -> Rounded | None:
    """Return a shape of lines and arcs, as a polygon of chords and of lines beyond concave arcs; None if it is none."""
    rings: list[list[Side]] = []
    for r, ring in enumerate(shape.curves):
        sides = _sides(ring, is_hole=r > 0)
        if sides is None:
            return None
        rings.append(sides)
    if any(arc and arc.sense < 0 for ring in rings for *_, arc in ring):
        return _on_hulls(rings)
    for cuts in range(FINEST_CUTS + 1):
        if (found := _on_chords([list(_cut(ring, 2**cuts)) for ring in rings])) is not None:
            return found
    return None


def _sides(ring: Sequence[Piece], *, is_hole: bool) -> list[Side] | None:
    """Return lines and quarters of arcs, the shape on their left; None if there are others, or cusps."""
    sides: list[Side] = []
    for piece in ring:
        if isinstance(piece, Line):
            sides.append((piece.start, piece.end, None))
            continue
        if not isinstance(piece, Span) or not piece.is_circular or rational_root(dot(piece.u, piece.u)) is None:
            return None
        for center, u, v, rest in quarters_of(piece):
            part = Span(center, u, v, 0, rest) if rest < 1 else Span(center, u, v, 1, Fraction(0))
            sides.append((part.at(0, Fraction(0)), part.end, part))
    within = [float(cross(start, end)) for start, end, _ in sides]  # twice the area
    beyond = [arc.sense * (arc.sweep - math.sin(arc.sweep)) * float(dot(arc.u, arc.u)) for *_, arc in sides if arc]
    if (math.fsum(within + beyond) < 0) != is_hole:
        sides = [(end, start, arc and _reversed(arc)) for start, end, arc in reversed(sides)]
    for before, after in zip([sides[-1], *sides[:-1]], sides, strict=True):
        into, out = _towards(before, at_end=True), _towards(after, at_end=False)
        if cross(into, out) == 0 and dot(into, out) < 0:
            return None
    return sides


def _reversed(arc: Span) -> Span:
    u = minus(arc.end, arc.center)
    return Span(arc.center, u, (arc.sense * u[1], -arc.sense * u[0]), arc.quarters, arc.rest)


def _towards(side: Side, *, at_end: bool) -> ExactPoint:
    start, end, arc = side
    return direction_of(arc or Line(start, end), at_end=at_end)


def _cut(ring: Sequence[Side], parts: int) -> Iterator[Side]:
    for start, end, arc in ring:
        if arc is None or parts == 1:
            yield start, end, arc
            continue
        places = [start, *(arc.at(0, _half_tangent(arc.sweep * k / parts)) for k in range(1, parts)), end]
        for first, last in pairwise(places):
            yield first, last, arc


def _half_tangent(angle: float) -> Fraction:
    """Return a simple number near the tangent of half an angle below a quarter turn."""
    return Fraction(round(math.tan(angle / 2) * 256), 256)


def _on_chords(rings: Sequence[Sequence[Side]]) -> Rounded | None:
    """Return the polygon of chords with its arcs; None if it is no polygon, or has not all ends of arcs as vertices."""
    try:
        outer, *holes = ([start for start, _, _ in ring] for ring in rings)
        core = Polygon(outer, holes)
    except InvalidPolygonError:
        return None
    arcs = []
    for start, end, arc in (side for ring in rings for side in ring):
        if arc is None:
            continue
        radius = rational_root(dot(arc.u, arc.u))
        assert radius is not None, "it has been looked at"
        arcs.append(CoreArc(start, end, arc.center, radius))
    vertices, next_of = core.exact_vertices, core.next
    chords = {(vertices[k], vertices[int(next_of[k])]) for k in range(len(vertices))}
    if any((arc.start, arc.end) not in chords for arc in arcs):
        return None
    return Rounded(core, Fraction(0), tuple(arcs))


def _on_hulls(rings: Sequence[Sequence[Side]]) -> Rounded | None:
    """Return the polygon of chords of convex arcs, and of lines beyond concave ones.

    Arcs are cut in halves while their triangles meet others; None if they are as fine as may be.
    """
    sides = [(r, 0, side) for r, ring in enumerate(rings) for side in ring]  # ring, and number of cuts
    while True:
        for wider in WIDENINGS:
            triangles = [hull_triangle(*side, wider) for *_, side in sides]
            if not (found := meeting(triangles)):
                cut = [[side for ring, _, side in sides if ring == r] for r in range(len(rings))]
                return _with_fillets(cut, {side[:2]: one for (*_, side), one in zip(sides, triangles, strict=True)})
        coarse = {n for n in found if sides[n][2][2] and sides[n][1] < FINEST_FILLETS}
        if not coarse:
            return None
        sides = [part for n, one in enumerate(sides) for part in (_halves(*one) if n in coarse else [one])]


def _halves(ring: int, cuts: int, side: Side) -> list[tuple[int, int, Side]]:
    start, end, arc = side
    assert arc is not None, "lines are not cut"
    tangent = math.tan(arc.sweep / 4)
    middle = arc.at(0, Fraction(tangent).limit_denominator(max(8, math.ceil(2 / tangent))))
    return [(ring, cuts + 1, (p, q, _part(arc, p, q))) for p, q in ((start, middle), (middle, end))]


def _part(arc: Span, start: ExactPoint, end: ExactPoint) -> Span:
    """Return an arc from one of its points to another one, less than half a turn."""
    u, w = minus(start, arc.center), minus(end, arc.center)
    tangent = abs(cross(u, w)) / (dot(u, u) + dot(u, w))
    v = (-arc.sense * u[1], arc.sense * u[0])
    return Span(arc.center, u, v, 0, tangent) if tangent < 1 else Span(arc.center, u, v, 1, Fraction(0))


def _with_fillets(
    rings: Sequence[Sequence[Side]], triangles: dict[tuple[ExactPoint, ExactPoint], HullTriangle]
) -> Rounded:
    corners: list[list[ExactPoint]] = []
    arcs = []
    for ring in rings:
        corners.append([])
        for start, end, arc in ring:
            corners[-1].append(start)
            if arc is None:
                continue
            beyond = triangles[start, end].beyond if arc.sense < 0 else None
            if beyond is not None:
                corners[-1].append(beyond[0])
            radius = rational_root(dot(arc.u, arc.u))
            assert radius is not None, "it has been looked at"
            arcs.append(CoreArc(start, end, arc.center, radius, beyond))
    outer, *holes = corners
    return Rounded(Polygon(outer, holes), Fraction(0), tuple(arcs))


def is_disc_about_reference(scene: Scene) -> bool:
    """True if all of the robot's shapes are discs about its reference point: nothing depends on its orientation."""
    paths = [shape.path if isinstance(shape, Curved) and not shape.holes else None for shape in scene.robot]
    return all(isinstance(path, Circle) and not any(path.center) for path in paths)


REMEDY = "give scene.outer(error) or scene.inner(error), on the command line what cfree convert --outer writes"


def why_not_rounded(scene: Scene, remedy: str = REMEDY) -> str:
    """Explain which shape keeps a scene from being one of rounded shapes, and what to do.

    Examples
    --------
    >>> from cfree.scene.scene import Scene
    >>> print(why_not_rounded(Scene(Curved.circle((0, 0), 1), [Curved.ellipse((3, 0), (1, 2))])))
    obstacle 0: not bounded by lines and arcs of rational radii, without cusps; ...
    """
    names = [f"robot[{k}]" if len(scene.robot) > 1 else "robot" for k in range(len(scene.robot))]
    around = complement(scene)
    names += [*scene.obstacle_names, *["workspace"] * len(around)]
    all_shapes: list[AnyShape] = [*scene.robot, *scene.obstacles, *around]
    shapes = list(zip(names, all_shapes, strict=True))
    cores = [(name, rounded(shape)) for name, shape in shapes]
    name = next(name for name, core in cores if core is None)
    shape = next(shape for other, shape in shapes if other == name)
    if isinstance(shape, Curved) and all(_sides(ring, is_hole=r > 0) for r, ring in enumerate(shape.curves)):
        return f"{name}: {crossing(shape.curves, (shape.path, *shape.holes))}; move them apart, or {remedy}"
    if isinstance(shape, Curved) and rounded(shape.healed()):
        healing = "heal it, on the command line by --heal LENGTH, in Python by Curved.healed()"
        return f"{name}: an arc of irrational radius; {healing}; or {remedy}"
    return f"{name}: not bounded by lines and arcs of rational radii, without cusps; {remedy}"


def known_cores(scene: Scene) -> Cores:
    """Return the cores of those shapes of a scene that are rounded."""
    around = complement(scene)
    robot, obstacles = ([rounded(shape) for shape in shapes] for shapes in (scene.robot, (*scene.obstacles, *around)))
    return Cores(tuple(filter(None, robot)), tuple(filter(None, obstacles)), len(around))


def rounded_shapes(scene: Scene) -> Cores | None:
    """Return the cores of a scene; None if a shape is not rounded."""
    cores = known_cores(scene)
    is_whole = len(cores.robot) == len(scene.robot) and len(cores.obstacles) == len(scene.obstacles) + cores.frames
    return cores if is_whole else None
