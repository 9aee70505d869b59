"""Place parts on sheets: bottom-left over exact inner-fit and no-fit polygons, edges touching, holes filled.

The lowest, then leftmost position of a part is a vertex of its inner-fit region, of a no-fit polygon, or a crossing of
two of their edges. Such candidates are collected in doubles. One that is inside a no-fit polygon by more than a margin
is dropped; in the order of the rest, exact numbers compute each position and decide if it is free.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise, product
from typing import Any, Literal

import numpy as np

from cfree.arguments import checked
from cfree.curves.curved import Curved
from cfree.errors import InvariantError, UnsupportedError
from cfree.exact.half_angle import Angle, read_angle, sum_of_angles
from cfree.exact.number import ExactPoint, Number, rational_root, to_fraction
from cfree.exact.pose import Pose, pose_at
from cfree.libraries import Floats, NDArray
from cfree.nesting.checking import overlaps
from cfree.nesting.layout import ROUND_SHARE, Nesting, Part, Placed, all_parts, around, with_quantity, within
from cfree.nesting.nofit import turned
from cfree.nesting.outlines import outlines
from cfree.nesting.sums import Sums, box_of, complement, sums_of
from cfree.polygons.disc import around_disc
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import shapes_in

MOST_PARTS = 10**6
SIDES_OF_GAP = 16  # of the polygon around a disc that keeps parts apart
MARGIN = 1e-8  # share of the size: candidates that far inside of a no-fit polygon are dropped in doubles
FAR = 2.0**-20  # share of the coordinates that the size is at least, for rounding far from the origin
MOST_ANGLES = 16  # orientations tried for a part that may be turned by any angle
MOST_SIMPLE = 10**6  # common denominator of simple fractions
QUARTERS: tuple[Fraction | None, ...] = (Fraction(0), Fraction(1), None, Fraction(-1))  # tau of quarter turns
DECIMALS = 11  # of positions, below the size

NEARBY = sorted(product(range(-5, 7), repeat=2), key=lambda step: abs(step[0]) + abs(step[1]))

Tau = Fraction | None
Toward = Literal["bottom", "left"]
Segment = tuple[ExactPoint, ExactPoint]


@checked
def place(
    parts: Any,
    sheets: Any = None,
    *,
    rotations: Literal["any"] | int | Sequence[Angle] = 4,
    gap: Number = 0,
    kerf: Number = 0,
    toward: Toward = "bottom",
    max_seconds: float | None = None,
    progress: Callable[[float], object] | None = None,
) -> Nesting:
    """Place parts on sheets, each at its lowest position, then the leftmost: no overlap, exactly.

    Parameters
    ----------
    parts : Nesting, or sequence of Part or shapes
        The largest are placed first, each as often as it is wanted. Holes of placed parts are filled. All parts of a
        `Nesting` are placed anew.
    sheets : shape or sequence of shapes, optional
        Each is used once, in this order; holes in it are faults that stay free. Those of the `Nesting` by default.
    rotations : "any", int or sequence of Angle
        Orientations of parts without their own: so many steps of a full turn, or these angles. "any" tries up to 16
        orientations that lay a long edge of the part along an edge of the sheet or of a placed part.
    gap : number
        Least distance between the cuts of two parts, and of a cut from the edge of the sheet.
    kerf : number
        Width of the cut around each part: parts keep gap + kerf from each other, gap + kerf / 2 from the sheet's edge.
    toward : "bottom" or "left"
        "left" places each part leftmost, then lowest, as on a strip of open length.
    max_seconds : float, optional
        Stop then; parts without a place are in `Nesting.left`.
    progress : callable, optional
        Called with the completed share, from 0 to 1.

    Returns
    -------
    Nesting
        Its `left` has all parts that found no place.

    Raises
    ------
    ValueError
        If there is no part or no sheet, there are more than a million parts, or a length is negative.

    Notes
    -----
    The position of each part is exact: a decimal of about twelve digits if one is free within a billionth of the size,
    else the vertex itself. The layout is a heuristic: bottom-left in the order of area. Packers that search for hours,
    such as sparrow, pack denser. Round parts are placed as polygons around them within a thousandth of their size,
    sheets as polygons inside. With a gap parts are up to 2 % of it farther apart where they do not face along an axis.
    The result is checked by `overlaps` before it is returned.

    Examples
    --------
    A bar fits its slot exactly, though that leaves no room to move:

    >>> plate = Part([(0, 0), (6, 0), (6, 1), (1, 1), (1, 2), (6, 2), (6, 4), (0, 4)], "plate")
    >>> bar = Part([(0, 0), (5, 0), (5, 1), (0, 1)], "bar")
    >>> result = place([plate, bar], [(0, 0), (6, 0), (6, 4), (0, 4)])
    >>> result, [tuple(map(str, (one.pose.x, one.pose.y))) for one in result.placed]
    (<Nesting of 2 parts on 1 sheet, 100.0 % used>, [('0', '0'), ('1', '1')])
    """
    given = parts if isinstance(parts, Nesting) else None
    wanted = _parts(all_parts(given) if given is not None else parts)
    own = given.sheets if given is not None else ()
    stock = own if sheets is None else tuple(shapes_in(sheets, "sheets"))
    if not stock:
        raise ValueError("sheets: there is none; give at least one polygon")
    space, width = to_fraction(gap), to_fraction(kerf)
    for name, length in (("gap", space), ("kerf", width)):
        if length < 0:
            raise ValueError(f"{name}: {length}; give a length, 0 or more")
    if (count := sum(part.quantity for part in wanted)) > MOST_PARTS:
        raise ValueError(f"parts: {count:,} with all copies; give {MOST_PARTS:,} at most")
    sizes = [shape.size for part in wanted for shape in part.shapes if isinstance(shape, Curved)]
    error = 2 * max(sizes, default=0.0) / ROUND_SHARE
    nester = _Nester(wanted, stock, space + width, space + width / 2, _angles(rotations), toward, error)
    order = [part for part in sorted(wanted, key=lambda part: -part.area) for _ in range(part.quantity)]
    end = None if max_seconds is None else time.monotonic() + max_seconds
    left: dict[int, int] = {}
    for k, part in enumerate(order):
        if (end is not None and time.monotonic() > end) or not nester.add(part):
            left[id(part)] = left.get(id(part), 0) + 1
        if progress is not None:
            progress((k + 1) / len(order))
    rest = [with_quantity(part, left[id(part)]) for part in wanted if id(part) in left]
    result = Nesting(stock, nester.placed, rest, given.units if given else "", given.name if given else "")
    if wrong := overlaps(result):
        raise InvariantError(f"place made an overlap: {wrong[0]}", state=result)
    return result


def _parts(parts: Any) -> list[Part]:
    items = [parts] if isinstance(parts, Part) else parts
    if isinstance(items, Sequence) and any(isinstance(item, Part) for item in items):
        wanted = [item if isinstance(item, Part) else Part(item) for item in items]
    else:
        wanted = [Part(shape) for shape in shapes_in(parts, "parts")]
    if not wanted:
        raise ValueError("parts: there is none; give at least one")
    return wanted


def _angles(rotations: Any) -> tuple[Tau, ...] | None:
    """Return half-angle tangents of orientations; None stands for any."""
    if isinstance(rotations, str):
        return None
    if isinstance(rotations, int):
        if not 1 <= rotations <= 360:
            raise ValueError(f"rotations: {rotations}; give 1 to 360 steps of a full turn")
        return tuple(read_angle(f"{Fraction(360 * k, rotations)}deg")[0] for k in range(rotations))
    if not len(rotations):
        raise ValueError("rotations: there is none; give at least one angle")
    return tuple(dict.fromkeys(read_angle(angle)[0] for angle in rotations))


@dataclass(frozen=True)
class _Obstacle:
    """A region that a part's reference point must keep out of, for a fixed part at the origin.

    Attributes
    ----------
    sums : Sums
    edges : list of pairs of points
    points : list of points
        Exact fits.
    places : (n, 2, 2) float64
        The edges, rounded.
    inside : shapely geometry
        All positions that are certainly inside.
    """

    sums: Sums
    edges: list[Segment]
    points: list[ExactPoint]
    places: Floats
    inside: Any

    @classmethod
    def of(cls, sums: Sums) -> _Obstacle:
        import shapely

        rings, segments, points = outlines(sums)
        edges = [edge for ring in rings for edge in pairwise((*ring, ring[0]))] + [*segments]
        region = shapely.build_area(
            shapely.GeometryCollection([shapely.LinearRing([tuple(map(float, p)) for p in ring]) for ring in rings])
        )
        thin = [shapely.LineString([tuple(map(float, p)) for p in segment]) for segment in segments]
        thin += [shapely.Point(*map(float, p)) for p in points]
        margin = MARGIN * sums.size
        inside = region.buffer(-margin, join_style="mitre")
        if thin:
            inside = inside.difference(shapely.union_all(thin).buffer(margin))
        shapely.prepare(inside)
        return cls(sums, edges, [*points], _rounded(edges), inside)

    def turned(self, quarter: int) -> _Obstacle:
        """Return it turned by quarter turns, exactly; the disc of a gap is as symmetric."""
        import shapely

        c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[quarter]
        if c == 1:
            return self

        def at(p: Any) -> Any:
            return c * p[0] - s * p[1], s * p[0] + c * p[1]

        inside = shapely.transform(self.inside, lambda xy: np.column_stack(at(xy.T)))
        shapely.prepare(inside)
        return _Obstacle(
            Sums(
                self.sums.scale,
                tuple(tuple(map(at, ring)) for ring in self.sums.rings),
                tuple((at(p), at(q)) for p, q in self.sums.edges),
            ),
            [(at(p), at(q)) for p, q in self.edges],
            [*map(at, self.points)],
            np.stack(at(np.moveaxis(self.places, -1, 0)), axis=-1),
            inside,
        )


def _rounded(edges: Sequence[Segment]) -> Floats:
    return np.array([[[float(c) for c in p] for p in edge] for edge in edges], float).reshape(-1, 2, 2)


class _Field:
    """Candidates for the position of one part at one orientation on one sheet.

    The limits are those of positions at which the part's box is in the sheet's; the extent is that of the sheet.
    """

    def __init__(
        self, fit: _Obstacle, limits: Segment, extent: float, toward: Toward, error: float, simple: int
    ) -> None:
        self.fit, self.limits, self.toward, self.simple = fit, limits, toward, simple
        self.box = box = np.array([[float(c) for c in corner] for corner in limits])
        self.size = max(extent, FAR * float(np.abs(box).max()))
        self.step = max(MARGIN * self.size, error)  # positions are equally low within it
        self.unit = Fraction(10) ** (math.floor(math.log10(self.size)) - DECIMALS)
        self.origin: ExactPoint = Fraction(0), Fraction(0)
        self.obstacles: list[tuple[_Obstacle, ExactPoint]] = []
        self.places: Floats = np.empty((0, 2, 2))
        self.owner: NDArray[np.int64] = np.empty(0, np.int64)  # of each edge: obstacle, and its own edge
        self.index: NDArray[np.int64] = np.empty(0, np.int64)
        self.xy: Floats = np.empty((0, 2))
        self.pairs: NDArray[np.int64] = np.empty((0, 2), np.int64)  # edges that cross; -1 and a number of `exact`
        self.exact: list[ExactPoint] = []
        if limits[0][0] <= limits[1][0] and limits[0][1] <= limits[1][1]:
            self.add(fit, self.origin)

    def add(self, obstacle: _Obstacle, shift: ExactPoint) -> None:
        """Add an obstacle, and the candidates that it makes."""
        import shapely

        x, y = map(float, shift)
        places = obstacle.places + np.array([x, y])
        margin = MARGIN * self.size
        if len(self.xy):
            keep = ~shapely.contains_xy(obstacle.inside, self.xy[:, 0] - x, self.xy[:, 1] - y)
            self.xy, self.pairs = self.xy[keep], self.pairs[keep]
        near = np.flatnonzero(
            (places.min(axis=1) <= self.box[1] + margin).all(axis=1)
            & (places.max(axis=1) >= self.box[0] - margin).all(axis=1)
        )
        first = len(self.owner)
        ends = [(p[0] + shift[0], p[1] + shift[1]) for k in near.tolist() for p in obstacle.edges[k]]
        ends += [(p[0] + shift[0], p[1] + shift[1]) for p in obstacle.points]
        ends = list(dict.fromkeys(ends))
        numbers = np.arange(len(self.exact), len(self.exact) + len(ends))
        self.exact += ends
        xy = np.array([[float(c) for c in p] for p in ends], float).reshape(-1, 2)
        pairs = np.column_stack([np.full(len(ends), -1), numbers])
        self.obstacles.append((obstacle, shift))
        crossings, crossed = _crossings(places[near], self.places)
        crossed += [first, 0]
        self.places = np.concatenate([self.places, places[near]])
        self.owner = np.concatenate([self.owner, np.full(len(near), len(self.obstacles) - 1)])
        self.index = np.concatenate([self.index, near])
        self._take(np.concatenate([xy, crossings]), np.concatenate([pairs, crossed]))

    def _take(self, xy: Floats, pairs: NDArray[np.int64]) -> None:
        """Take candidates that are within the box and not certainly inside of an obstacle."""
        import shapely

        margin = MARGIN * self.size
        keep = ((xy >= self.box[0] - margin) & (xy <= self.box[1] + margin)).all(axis=1)
        xy, pairs = xy[keep], pairs[keep]
        for obstacle, shift in self.obstacles:
            if not len(xy):
                return
            keep = ~shapely.contains_xy(obstacle.inside, xy[:, 0] - float(shift[0]), xy[:, 1] - float(shift[1]))
            xy, pairs = xy[keep], pairs[keep]
        self.xy, self.pairs = np.concatenate([self.xy, xy]), np.concatenate([self.pairs, pairs])

    def best(self) -> ExactPoint | None:
        """Return the lowest, then leftmost free position; by `toward` the leftmost, then lowest one."""
        major, minor = (1, 0) if self.toward == "bottom" else (0, 1)
        order = np.lexsort((self.xy[:, minor], np.round(self.xy[:, major] / self.step)))
        for n, k in enumerate(order.tolist()):
            position = self._position(*self.pairs[k].tolist())
            if position is not None and self.is_free(position):
                drop = order[:n]  # these are forbidden, and stay so
                self.xy, self.pairs = np.delete(self.xy, drop, axis=0), np.delete(self.pairs, drop, axis=0)
                return self._short(position)
        self.xy, self.pairs = self.xy[:0], self.pairs[:0]
        return None

    def is_free(self, position: ExactPoint) -> bool:
        """True if the part at this position overlaps nothing, decided exactly."""
        (x0, y0), (x1, y1) = self.limits
        x, y = position
        if not (x0 <= x <= x1 and y0 <= y <= y1):
            return False
        return not any(
            obstacle.sums.cover((x - shift[0], y - shift[1])) for obstacle, shift in reversed(self.obstacles)
        )

    def _position(self, a: int, b: int) -> ExactPoint | None:
        """Return an exact candidate: a vertex, or where the lines of two edges cross."""
        if a < 0:
            return self.exact[b]
        (p, q), (r, s) = self._edge(a), self._edge(b)
        u, v, w, z = q[0] - p[0], q[1] - p[1], s[0] - r[0], s[1] - r[1]
        cross = u * z - v * w
        if not cross:
            return None
        share = ((r[0] - p[0]) * z - (r[1] - p[1]) * w) / cross
        return p[0] + share * u, p[1] + share * v

    def _edge(self, k: int) -> Segment:
        obstacle, (x, y) = self.obstacles[int(self.owner[k])]
        p, q = obstacle.edges[int(self.index[k])]
        return (p[0] + x, p[1] + y), (q[0] + x, q[1] + y)

    def _short(self, position: ExactPoint) -> ExactPoint:
        """Return a free position of few decimals beside one of many, if there is one.

        Simple fractions such as thirds stay if the shapes have them.
        """
        if all((self.simple * c / self.unit).denominator == 1 for c in position):
            return position
        i, j = (math.floor(c / self.unit) for c in position)
        for dx, dy in NEARBY:
            near = (i + dx) * self.unit, (j + dy) * self.unit
            if self.is_free(near):
                return near
        return position


def _crossings(new: Floats, old: Floats) -> tuple[Floats, NDArray[np.int64]]:
    """Return places where new edges cross old ones, and the numbers of both; ends that touch count."""
    none = np.empty((0, 2)), np.empty((0, 2), np.int64)
    if not len(new) or not len(old):
        return none
    margin = MARGIN * float(max(np.abs(new).max(), np.abs(old).max()))
    low, high, lower, upper = new.min(axis=1), new.max(axis=1), old.min(axis=1), old.max(axis=1)
    meet = (low[:, None] <= upper + margin).all(axis=2) & (high[:, None] >= lower - margin).all(axis=2)
    a, b = np.nonzero(meet)
    if not len(a):
        return none
    p, r = new[a, 0], old[b, 0]
    d, e = new[a, 1] - p, old[b, 1] - r
    cross = d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0]
    lengths = np.hypot(*d.T), np.hypot(*e.T)
    slanted = np.abs(cross) > 1e-12 * lengths[0] * lengths[1]
    off = r - p
    with np.errstate(divide="ignore", invalid="ignore"):
        t = (off[:, 0] * e[:, 1] - off[:, 1] * e[:, 0]) / cross
        s = (off[:, 0] * d[:, 1] - off[:, 1] * d[:, 0]) / cross
        slack = margin / lengths[0], margin / lengths[1]
        keep = slanted & (t >= -slack[0]) & (t <= 1 + slack[0]) & (s >= -slack[1]) & (s <= 1 + slack[1])
    return p[keep] + t[keep, None] * d[keep], np.column_stack([a[keep], b[keep]])


@dataclass
class _Kind:
    """A part with its polygons, the same for all copies."""

    part: Part
    polygons: list[Polygon]
    at: dict[Tau, list[Polygon]] = field(default_factory=dict)

    def turned(self, tau: Tau) -> list[Polygon]:
        if tau not in self.at:
            self.at[tau] = turned(self.polygons, pose_at(Fraction(0), Fraction(0), tau))
        return self.at[tau]


class _Nester:
    """The state of a placement."""

    def __init__(
        self,
        parts: Sequence[Part],
        stock: Sequence[Any],
        apart: Fraction,
        inset: Fraction,
        angles: tuple[Tau, ...] | None,
        toward: Toward,
        error: float,
    ) -> None:
        self.angles, self.toward, self.error = angles, toward, error
        self.sheets = [_one_inside(sheet, k) for k, sheet in enumerate(stock)]
        self.apart, self.inset = _disc(apart), _disc(inset)
        self.placed: list[Placed] = []
        self._kinds = {id(part): _Kind(part, around(part.shapes)) for part in parts}
        self.simple = 1  # common denominator of the shapes, but for decimals
        for polygon in (*self.sheets, *(polygon for kind in self._kinds.values() for polygon in kind.polygons)):
            self._allow(polygon)
        self._fields: dict[tuple[int, Tau, int], tuple[_Field, list[int]]] = {}
        self._between: dict[tuple[int, Tau, int, Tau], _Obstacle] = {}

    def add(self, part: Part) -> bool:
        """Place a part on the first sheet on which it has a place; False if there is none."""
        kind = self._kinds[id(part)]
        for sheet in range(len(self.sheets)):
            places = [(tau, at) for tau in self._orientations(kind, sheet) if (at := self._best(kind, tau, sheet))]
            if places:
                tau, (x, y) = min(places, key=lambda each: self._key(kind, *each))
                self.placed.append(Placed(part, pose_at(x, y, tau), sheet))
                return True
        return False

    def _allow(self, polygon: Polygon) -> None:
        """Take the denominator of a shape for a simple one, unless that makes too large numbers."""
        rest = polygon.denominator
        for prime in (2, 5):
            while rest % prime == 0:
                rest //= prime
        both = math.lcm(self.simple, rest)
        self.simple = both if both <= MOST_SIMPLE else self.simple

    def _key(self, kind: _Kind, tau: Tau, at: ExactPoint) -> tuple[Fraction, ...]:
        """Return how far the part reaches: up, then to the right; by `toward` the other way round."""
        _, _, x, y = box_of(kind.turned(tau))
        right, top = at[0] + x, at[1] + y
        return (top, right) if self.toward == "bottom" else (right, top)

    def _best(self, kind: _Kind, tau: Tau, sheet: int) -> ExactPoint | None:
        key = id(kind.part), tau, sheet
        if key not in self._fields:
            self._fields[key] = self._field(kind, tau, sheet), [0]
        candidates, done = self._fields[key]
        for one in self.placed[done[0] :]:
            if one.sheet == sheet:
                candidates.add(self._obstacle(one, kind, tau), (one.pose.x, one.pose.y))
        done[0] = len(self.placed)
        return candidates.best()

    def _field(self, kind: _Kind, tau: Tau, sheet: int) -> _Field:
        parts, container = kind.turned(tau), self.sheets[sheet]
        (x0, y0, x1, y1), (u0, v0, u1, v1) = box_of([container]), box_of(parts)
        limits, extent = ((x0 - u0, y0 - v0), (x1 - u1, y1 - v1)), float(max(x1 - x0, y1 - y0))
        fit = _Obstacle.of(sums_of(complement(container, parts), parts, self.inset))
        return _Field(fit, limits, extent, self.toward, self.error, self.simple)

    def _obstacle(self, one: Placed, kind: _Kind, tau: Tau) -> _Obstacle:
        fixed, own = self._kinds[id(one.part)], one.pose.tau
        key = id(fixed.part), own, id(kind.part), tau
        if key not in self._between:
            quarter = QUARTERS.index(own) if own in QUARTERS else 0
            if quarter:  # both parts turned back, and the result forth
                own, tau = (sum_of_angles(each, QUARTERS[-quarter]) for each in (own, tau))
            basic = id(fixed.part), own, id(kind.part), tau
            if basic not in self._between:
                self._between[basic] = _Obstacle.of(sums_of(fixed.turned(own), kind.turned(tau), self.apart))
            self._between[key] = self._between[basic].turned(quarter)
        return self._between[key]

    def _orientations(self, kind: _Kind, sheet: int) -> Iterable[Tau]:
        if kind.part.rotations is not None:
            return kind.part.rotations
        return self.angles if self.angles is not None else self._along_edges(kind, sheet)

    def _along_edges(self, kind: _Kind, sheet: int) -> list[Tau]:
        """Return orientations that lay a long edge of the part along one of the sheet, then of parts placed last."""
        own = _long_edges(kind.polygons)
        targets = [_long_edges([self.sheets[sheet]], outward=False)]
        recent = [one for one in self.placed if one.sheet == sheet][: -MOST_ANGLES - 1 : -1]
        for one in recent:
            edges = _long_edges(self._kinds[id(one.part)].turned(one.pose.tau))
            targets.append([(-x, -y) for x, y in edges])
        taus: dict[Tau, None] = {Fraction(0): None}
        for edges in targets:
            for b in edges[:4]:
                for a in own[:4]:
                    tau = _aligning(a, b)
                    if not any(_is_same(tau, other) for other in taus):
                        taus[tau] = None
                    if len(taus) == MOST_ANGLES:
                        return [*taus]
        return [*taus]


def _one_inside(sheet: Any, k: int) -> Polygon:
    """Return a sheet as a polygon; of a round sheet one inside."""
    polygons = within([sheet])
    if len(polygons) != 1:
        raise UnsupportedError(f"sheets[{k}]: no polygon can be proved to be inside; give a polygon")
    return polygons[0]


def _disc(radius: Fraction) -> list[ExactPoint]:
    """Return a convex polygon around a disc; none for a radius of 0."""
    return list(around_disc(radius, SIDES_OF_GAP)) if radius else []


def _long_edges(polygons: Sequence[Polygon], outward: bool = True) -> list[ExactPoint]:
    """Return edge vectors of the hull, or of the outer ring, the longest first."""
    import shapely

    if not outward:
        ring = list(polygons[0].exact_rings[0])
    else:
        points = [p for polygon in polygons for p in polygon.exact_vertices]
        by_place = {(float(x), float(y)): (x, y) for x, y in points}
        hull = shapely.orient_polygons(shapely.MultiPoint([*by_place]).convex_hull)
        ring = [by_place[x, y] for x, y in hull.exterior.coords[:-1]]
    edges = [(q[0] - p[0], q[1] - p[1]) for p, q in pairwise((*ring, ring[0]))]
    return sorted(edges, key=lambda e: -(e[0] ** 2 + e[1] ** 2))


def _aligning(a: ExactPoint, b: ExactPoint) -> Tau:
    """Return the turn from one direction to another: exact if its tangent is rational, else of few digits."""
    dot, cross = a[0] * b[0] + a[1] * b[1], a[0] * b[1] - a[1] * b[0]
    if not cross:
        return Fraction(0) if dot > 0 else None
    root = rational_root(dot * dot + cross * cross)
    if root is not None:
        return cross / (root + dot)
    return Fraction(math.tan(math.atan2(cross, dot) / 2)).limit_denominator(10**5)


def _is_same(tau: Tau, other: Tau) -> bool:
    angles = (Pose(0, 0, {"tau": each}).theta for each in (tau, other))
    first, second = angles
    return abs(math.remainder(first - second, math.tau)) < 1e-4
