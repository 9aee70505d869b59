"""Shapes that are smaller by a hair, strictly inside of rounded ones: docs/theory/rounded-shapes.md."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import chain

from cfree.curves.pieces import power_of_two
from cfree.exact.number import ExactPoint
from cfree.exact.vectors import cross, dot, minus
from cfree.polygons.offset import inset
from cfree.polygons.polygon import Polygon
from cfree.scene.grown_cores import CoreArc, Rounded

PLACE_BITS = 11  # of a center of scaling, in the core's size
FLAT = 1e-9  # share of a core's size that a kernel has at least


def smaller(shapes: Sequence[Rounded], by: Fraction) -> tuple[Rounded, ...] | None:
    """Return shapes that are smaller by about a part of their sizes, each strictly inside; None if one has none.

    Discs of a grown core are smaller. A core without a disc is scaled about a point from which all of its rim is seen,
    if possible about one for all of them. A polygon without such a point has its edges moved inwards. A core with
    concave arcs and without a disc has none.

    Examples
    --------
    >>> triangle = Rounded(Polygon([(0, 0), (4, 0), (0, 4)]), Fraction(0))
    >>> [part] = smaller([triangle], Fraction(1, 8))
    >>> part.core.exact_area
    Fraction(49, 8)
    >>> [part] = smaller([Rounded(triangle.core, Fraction(1))], Fraction(1, 8))
    >>> part.radius
    Fraction(7, 8)
    """
    sharp = [shape for shape in shapes if not shape.radius]
    if any(shape.has_concave for shape in sharp):
        return None
    common = center_of_view(sharp) if len(sharp) > 1 else None
    result = list[Rounded]()
    for shape in shapes:
        if shape.radius:
            result.append(replace(shape, radius=shape.radius * (1 - by)))
        elif (part := _without_disc(shape, by, common)) is not None:
            result.append(part)
        else:
            return None
    return tuple(result)


def _without_disc(shape: Rounded, by: Fraction, center: ExactPoint | None) -> Rounded | None:
    assert isinstance(shape.core, Polygon), "other cores have a radius"
    center = center or center_of_view([shape])
    if center is not None:
        return _scaled(shape, center, 1 - by)
    if shape.arcs:
        return None
    x0, y0, x1, y1 = map(Fraction, shape.core.bounds)
    parts = inset(shape.core, by * power_of_two(max(x1 - x0, y1 - y0)) / 2)
    return Rounded(parts[0], Fraction(0)) if len(parts) == 1 else None


def _scaled(shape: Rounded, center: ExactPoint, factor: Fraction) -> Rounded:
    assert isinstance(shape.core, Polygon)

    def image(p: ExactPoint) -> ExactPoint:
        return center[0] + factor * (p[0] - center[0]), center[1] + factor * (p[1] - center[1])

    outer, *holes = ([*map(image, ring)] for ring in shape.core.exact_rings)
    arcs = [CoreArc(image(a.start), image(a.end), image(a.center), a.radius * factor) for a in shape.arcs]
    return Rounded(Polygon(outer, holes), Fraction(0), tuple(arcs))


def center_of_view(shapes: Sequence[Rounded]) -> ExactPoint | None:
    """Return a point on the inner side of all tangents of polygons with arcs; None if there is none, or hardly.

    Examples
    --------
    >>> center_of_view([Rounded(Polygon([(0, 0), (4, 0), (4, 2), (0, 2)]), Fraction(0))])
    (Fraction(2, 1), Fraction(1, 1))
    >>> horseshoe = [(0, 0), (3, 0), (3, 2), (2, 2), (2, 1), (1, 1), (1, 2), (0, 2)]
    >>> center_of_view([Rounded(Polygon(horseshoe), Fraction(0))]) is None
    True
    """
    boxes = [shape.core.bounds for shape in shapes if isinstance(shape.core, Polygon)]
    lefts, bottoms, rights, tops = zip(*boxes, strict=True)
    x0, y0, x1, y1 = min(lefts), min(bottoms), max(rights), max(tops)
    size = max(x1 - x0, y1 - y0, *(2 * float(arc.radius) for shape in shapes for arc in shape.arcs), 0.0)
    kernel = [complex(x0 - size, y0 - size), complex(x1 + size, y0 - size)]
    kernel += [complex(x1 + size, y1 + size), complex(x0 - size, y1 + size)]
    for place, along in chain.from_iterable(map(_tangents, shapes)):
        kernel = _cut(kernel, place, along / abs(along))
        if not kernel:
            return None
    middle = sum(kernel) / len(kernel)
    unit = power_of_two(Fraction(size)) / 2**PLACE_BITS
    if min(abs(p - middle) for p in kernel) < FLAT * size:
        return None
    center = round(Fraction(middle.real) / unit) * unit, round(Fraction(middle.imag) / unit) * unit
    return center if all(_sees_all(center, shape) for shape in shapes) else None


def _tangents(shape: Rounded) -> Iterator[tuple[complex, complex]]:
    """Yield places on the rim and directions along it, the interior on the left: edges, and some tangents of arcs."""
    for start, end, arc in _sides(shape):
        if arc is None:
            yield complex(*start), complex(*end) - complex(*start)
            continue
        center = complex(*arc.center)
        first, last = complex(*start) - center, complex(*end) - center
        for k in range(5):
            out = first * (4 - k) + last * k
            out *= float(arc.radius) / abs(out)
            yield center + out, 1j * out


def _sides(shape: Rounded) -> Iterator[tuple[ExactPoint, ExactPoint, CoreArc | None]]:
    assert isinstance(shape.core, Polygon)
    arcs = {(arc.start, arc.end): arc for arc in shape.arcs}
    vertices, after = shape.core.exact_vertices, shape.core.next
    for k, start in enumerate(vertices):
        end = vertices[int(after[k])]
        yield start, end, arcs.get((start, end))


def _cut(region: Sequence[complex], place: complex, along: complex) -> list[complex]:
    """Cut a convex region along a line; what is on its left is left."""
    heights = [(along.conjugate() * (p - place)).imag for p in region]
    result = list[complex]()
    for k, (p, h) in enumerate(zip(region, heights, strict=True)):
        q, g = region[k - 1], heights[k - 1]
        if (g > 0) != (h > 0):
            result.append(q + (p - q) * (g / (g - h)))
        if h > 0:
            result.append(p)
    return result


def _sees_all(point: ExactPoint, shape: Rounded) -> bool:
    """True if a point is left of all edges and of all tangents of arcs."""
    for start, end, arc in _sides(shape):
        if arc is None:
            if cross(minus(end, start), minus(point, start)) <= 0:
                return False
            continue
        to, first, last = (minus(p, arc.center) for p in (point, start, end))
        square = arc.radius * arc.radius
        if dot(to, first) >= square or dot(to, last) >= square:
            return False
        if cross(first, to) >= 0 and cross(to, last) >= 0 and dot(to, to) >= square:
            return False
    return True
