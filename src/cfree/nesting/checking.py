"""Check a layout exactly: every pair of parts that overlaps, how deep, and the least translation that frees it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from cfree.analysis.margins import Interval
from cfree.arguments import checked
from cfree.collision.pose_checker import is_free
from cfree.errors import UndecidedError
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose, pose_at
from cfree.nesting.layout import Nesting, Placed, around, label, shape_box, union, within
from cfree.nesting.nofit import NFP, InnerFit, inner_fit_of, nfp_of, turned
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import AnyShape, Scene
from cfree.words import counted

SHEET = -1  # in place of a part: the edge of its sheet
Box = tuple[Fraction, Fraction, Fraction, Fraction]


@dataclass(frozen=True, repr=False)
class Overlap:
    """Two parts that overlap, or a part that is not inside its sheet.

    Attributes
    ----------
    parts : (int, int)
        Indices in `Nesting.placed`; the second is -1 for the edge of the sheet.
    depth : Interval
        Length of the least translation that frees the pair; both ends are infinite if none does. Between polygons the
        ends are next to each other, between round shapes as far apart as polygons around and inside of them tell.
    vector : pair of Fraction, or None
        A translation of the first part, as long as the upper end of the depth, after which the two do not overlap.
    names : (str, str)
    """

    parts: tuple[int, int]
    depth: Interval
    vector: ExactPoint | None
    names: tuple[str, str]

    def __repr__(self) -> str:
        return f"<Overlap of {self}>"

    def __str__(self) -> str:
        first, second = self.names
        what = f"{first} and {second}" if self.parts[1] != SHEET else f"{first} and the edge of the sheet"
        if self.vector is None:
            return f"{what}: no translation puts it inside"
        x, y = map(float, self.vector)
        return f"{what}: {self.depth.hi:.6g} deep, free after ({x:.6g}, {y:.6g})"


@checked
def overlaps(nesting: Nesting) -> tuple[Overlap, ...]:
    """Check a layout exactly, and return all overlaps, the deepest first.

    Parameters
    ----------
    nesting : Nesting

    Returns
    -------
    tuple of Overlap
        Empty exactly if no two parts of a sheet overlap, and all parts are inside of their sheets. Touching is allowed.

    Raises
    ------
    UndecidedError
        If two shapes with ellipses, Bézier curves or splines touch, or nearly so.

    Notes
    -----
    Pairs are decided by the exact pose checker among segments and arcs, and not by no-fit polygons. The depth is the
    distance to the nearest free position, exits through holes included.

    Examples
    --------
    >>> from cfree.nesting.layout import Part
    >>> square = Part([(0, 0), (2, 0), (2, 2), (0, 2)], "square")
    >>> layout = Nesting([[(0, 0), (9, 0), (9, 2), (0, 2)]], [Placed(square, (0, 0, 0)), Placed(square, ("1.5", 0, 0))])
    >>> print(*overlaps(layout))
    square (part 0) and square (part 1): 0.5 deep, free after (-0.5, 0)
    """
    found = [*_pairs(nesting), *_outside(nesting)]
    return tuple(sorted(found, key=lambda one: -one.depth.hi))


def _pairs(nesting: Nesting) -> Iterator[Overlap]:
    boxes = [[shape_box(shape) for shape in one.shapes] for one in nesting.placed]
    hulls = [union(each) for each in boxes]
    order = sorted(range(len(hulls)), key=lambda k: hulls[k][0])
    for n, i in enumerate(order):
        for j in order[n + 1 :]:
            if hulls[j][0] >= hulls[i][2]:
                break
            if nesting.placed[i].sheet == nesting.placed[j].sheet and _meet(hulls[i], hulls[j]):
                first, second = sorted((i, j))
                one, other = nesting.placed[first], nesting.placed[second]
                if overlap(one, other):
                    yield Overlap((first, second), *_freed(one, other), (label(nesting, first), label(nesting, second)))


def _outside(nesting: Nesting) -> Iterator[Overlap]:
    for k, one in enumerate(nesting.placed if nesting.sheets else ()):
        sheet = nesting.sheets[one.sheet]
        if not _decided(Scene(one.part.shapes, workspace=sheet), one.pose):
            yield Overlap((k, SHEET), *_returned(one, sheet), (label(nesting, k), f"sheet {one.sheet}"))


def overlap(one: Placed, other: Placed) -> bool:
    """True if two placed parts overlap, decided exactly."""
    return not _decided(Scene(one.part.shapes, other.shapes), one.pose)


def _decided(scene: Scene, pose: Pose) -> bool:
    free = is_free(scene, pose)
    if free is None:
        raise UndecidedError("two shapes touch or nearly touch, and polygons for their curves do not decide")
    return bool(free)


def _meet(a: Box, b: Box) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def _freed(one: Placed, other: Placed) -> tuple[Interval, ExactPoint | None]:
    """Return the depth of an overlap, and a translation of the first part that ends it."""
    place, turn = (one.pose.x, one.pose.y), pose_at(Fraction(0), Fraction(0), one.pose.tau)
    moving, fixed = turned(one.part.shapes, turn), other.shapes
    outer = _shift(nfp_of(around(fixed), around(moving)), place)
    if _straight((*moving, *fixed)):
        return _interval(outer, outer), outer
    inside, within_fixed = within(moving), within(fixed)
    least = _shift(nfp_of(within_fixed, inside), place) if inside and within_fixed else None
    return _interval(least or (Fraction(0), Fraction(0)), outer), outer


def _returned(one: Placed, sheet: AnyShape) -> tuple[Interval, ExactPoint | None]:
    """Return how far a part is outside of its sheet, and a translation that puts it inside."""
    place, turn = (one.pose.x, one.pose.y), pose_at(Fraction(0), Fraction(0), one.pose.tau)
    moving = turned(one.part.shapes, turn)
    inside = within([sheet])
    outer = _shift(inner_fit_of(inside[0], around(moving)), place) if inside else None
    if outer is None:
        return Interval(math.inf, math.inf), None
    if _straight((*moving, sheet)):
        return _interval(outer, outer), outer
    small = within(moving)
    least = _shift(inner_fit_of(around([sheet])[0], small), place) if small else None
    return _interval(least or (Fraction(0), Fraction(0)), outer), outer


def _shift(fit: NFP | InnerFit, place: ExactPoint) -> ExactPoint | None:
    """Return the vector from a position to the nearest one that is allowed."""
    if isinstance(fit, NFP) and not fit.sums.cover(place):
        return Fraction(0), Fraction(0)
    nearest = fit.nearest(place)
    return None if nearest is None else (nearest[0] - place[0], nearest[1] - place[1])


def _interval(least: ExactPoint | None, most: ExactPoint | None) -> Interval:
    """Return doubles around the lengths of two vectors."""
    assert least is not None and most is not None  # something is always free far away
    low, high = (math.sqrt(v[0] ** 2 + v[1] ** 2) for v in (least, most))
    for _ in range(2):  # rounded twice
        low, high = math.nextafter(low, 0.0), math.nextafter(high, math.inf) if high else high
    return Interval(low, high)


def _straight(shapes: tuple[AnyShape, ...]) -> bool:
    return all(isinstance(shape, Polygon) for shape in shapes)


def statement(found: tuple[Overlap, ...]) -> str:
    """Return one line about the overlaps of a layout."""
    if not found:
        return "no overlap"
    return f"{counted(len(found), 'overlap')}; {found[0]}"
