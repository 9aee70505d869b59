"""The core's convex pieces of a polygon, by other means.

1. Triangulate: constrained Delaunay in doubles, by GEOS, which may be wrong; its cover is then checked exactly.
2. If the check fails (points too close for doubles), clip ears exactly: O(n^2), rarely needed.
3. Flip edges until the triangles are the constrained Delaunay ones that the core has, whatever was there before.
4. Remove diagonals while both sides stay convex (Hertel and Mehlhorn: at most 4 times the least number).

A piece may run along several true edges and diagonals that lie on one line; their common vertices are not
listed. Vertices of different rings that coincide are known by the least of their indices.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import chain

from cfree.errors import InvariantError
from cfree.exact.number import IntPoint
from cfree.exact.orientation import Orientation, orient
from cfree.polygons.polygon import Polygon
from reference_ears import clip_ears
from reference_sweep import Nesting, sweep

Ring = list[int]
Triangle = tuple[int, int, int]


def convex_pieces(polygon: Polygon) -> tuple[tuple[int, ...], ...]:
    """Convex pieces that cover a polygon exactly and do not overlap.

    Parameters
    ----------
    polygon : Polygon

    Returns
    -------
    tuple of tuple of int
        Vertices of each piece, counter-clockwise, strictly convex, least index first; the pieces are sorted.
    """
    if polygon.is_convex:
        return (tuple(range(len(polygon))),)
    v, rings = polygon.numerators, outline(polygon)
    triangles = delaunay(v, rings)
    if not is_cover(v, rings, triangles):
        triangles = clip_ears(v, rings)
        if not is_cover(v, rings, triangles):
            raise InvariantError("ears do not cover their polygon", state=(v, rings, triangles))
    return tuple(sorted(_merge(v, rings, flipped(v, rings, triangles))))


def is_cover(v: Sequence[IntPoint], rings: Sequence[Ring], triangles: Iterable[Triangle]) -> bool:
    """True if triangles cover the region of rings, each point inside once. Exact.

    Notes
    -----
    Let all triangles be counter-clockwise, and let each of their edges meet its reverse or be an edge of the rings, all
    of which occur. Then the triangles' indicators add up to the winding number of the rings.
    """
    used = [edge for a, b, c in triangles for edge in ((a, b), (b, c), (c, a))]
    directed, own = set(used), set(_edges(rings))
    return (
        len(directed) == len(used)
        and own <= directed
        and all(((b, a) in directed) != ((a, b) in own) for a, b in used)
        and all(orient(v[a], v[b], v[c]) is Orientation.LEFT for a, b, c in triangles)
    )


def outline(polygon: Polygon) -> list[Ring]:
    """Rings of vertices, in which points of other rings that touch an edge are vertices too."""
    v, following = polygon.numerators, polygon.next.tolist()
    touching: dict[int, list[int]] = {}
    if len(polygon.ring_offsets) > 2:
        nesting = sweep(v, polygon.ring_offsets)
        assert isinstance(nesting, Nesting)  # a polygon's rings do not cross
        touching = nesting.touching
    known: dict[IntPoint, int] = {}
    names = [known.setdefault(point, k) for k, point in enumerate(v)]
    rings: list[Ring] = [[] for _ in polygon.ring_offsets[1:]]
    for ring, first in zip(rings, polygon.ring_offsets, strict=False):
        k = first
        while not ring or k != first:
            ring.append(names[k])
            on_edge = sorted({names[m] for m in touching.get(k, ())}, key=v.__getitem__)
            ring += on_edge if v[k] < v[following[k]] else on_edge[::-1]
            k = following[k]
    return rings


def _edges(rings: Iterable[Ring]) -> list[tuple[int, int]]:
    return [edge for ring in rings for edge in zip(ring, (*ring[1:], ring[0]), strict=True)]


def delaunay(v: Sequence[IntPoint], rings: Sequence[Ring]) -> list[Triangle]:
    """Triangles by floating-point arithmetic, in a frame that the polygon fills; none if that breaks down."""
    import shapely

    x0, y0 = (min(c) for c in zip(*v, strict=True))
    x1, y1 = (max(c) for c in zip(*v, strict=True))
    framed = [[((v[k][0] - x0) / (x1 - x0), (v[k][1] - y0) / (y1 - y0)) for k in ring] for ring in rings]
    names = dict(zip(chain(*framed), chain(*rings), strict=True))
    if len(names) < len(set(chain(*rings))):
        return []  # doubles cannot separate the points
    try:
        collection = shapely.constrained_delaunay_triangles(shapely.Polygon(framed[0], framed[1:]))
    except shapely.GEOSException:
        return []
    corners = shapely.get_coordinates(collection).reshape(-1, 4, 2)[:, :3].tolist()
    try:
        triangles = [(names[tuple(a)], names[tuple(b)], names[tuple(c)]) for a, b, c in corners]
    except KeyError:
        return []  # not the polygon's points: rings that collapse in doubles lead to anything
    return [(a, b, c) if orient(v[a], v[b], v[c]) is Orientation.LEFT else (a, c, b) for a, b, c in triangles]


def flipped(v: Sequence[IntPoint], rings: Sequence[Ring], triangles: Sequence[Triangle]) -> list[Triangle]:
    """The constrained Delaunay triangulation of the box's frame; on circles of many points, fans from the least."""
    xs, ys = zip(*(v[k] for ring in rings for k in ring), strict=True)
    width, height = max(xs) - min(xs), max(ys) - min(ys)

    def inside(a: int, b: int, c: int, d: int) -> int:
        rows = [(v[k][0] - v[d][0], v[k][1] - v[d][1]) for k in (a, b, c)]
        (ax, ay, al), (bx, by, bl), (cx, cy, cl) = ((x, y, (x * height) ** 2 + (y * width) ** 2) for x, y in rows)
        return al * (bx * cy - by * cx) + bl * (cx * ay - cy * ax) + cl * (ax * by - ay * bx)

    opposite = {edge: c for a, b, c in triangles for edge, c in (((a, b), c), ((b, c), a), ((c, a), b))}
    stack = [(a, b) for a, b in opposite if a < b]
    while stack:
        a, b = stack.pop()
        if (a, b) not in opposite or (b, a) not in opposite:
            continue
        c, d = opposite[a, b], opposite[b, a]
        side = inside(a, b, c, d)
        if side > 0 or (side == 0 and min(c, d) < min(a, b)):
            del opposite[a, b], opposite[b, a]
            opposite |= {(a, d): c, (d, c): a, (c, a): d, (d, b): c, (b, c): d, (c, d): b}
            stack += [(a, d), (d, b), (b, c), (c, a)]
    return sorted({min((a, b, c), (b, c, a), (c, a, b)) for (a, b), c in opposite.items()})


def _merge(v: Sequence[IntPoint], rings: Sequence[Ring], triangles: Sequence[Triangle]) -> list[tuple[int, ...]]:
    """Faces left after diagonals are removed while both their ends stay convex."""
    # half-edge 3k + m runs from corner m of triangle k to its next corner
    origin = [k for triangle in triangles for k in triangle]
    following = [h + 1 if h % 3 < 2 else h - 2 for h in range(len(origin))]
    preceding = [h - 1 if h % 3 else h + 2 for h in range(len(origin))]
    half_edge = {(origin[h], origin[following[h]]): h for h in range(len(origin))}
    alive = [True] * len(origin)

    def is_convex_without(h: int, back: int) -> bool:
        """True if the corner at the origin of h is convex without h and its reverse (below 2 pi at every vertex)."""
        before, after = origin[preceding[h]], origin[following[following[back]]]
        return orient(v[before], v[origin[h]], v[after]) is not Orientation.RIGHT

    for a, b in _least_useful_first(v, rings, sorted(e for e in half_edge if e[0] < e[1] and e[::-1] in half_edge)):
        h, back = half_edge[a, b], half_edge[b, a]
        if is_convex_without(h, back) and is_convex_without(back, h):
            for one, other in ((h, back), (back, h)):
                following[preceding[one]] = following[other]
                preceding[following[other]] = preceding[one]
                alive[one] = False
    faces = []
    for h in range(len(origin)):
        face = []
        while alive[h]:
            alive[h] = False
            face.append(origin[h])
            h = following[h]
        if face:
            faces.append(_corners_only(v, face))
    return faces


def _least_useful_first(
    v: Sequence[IntPoint], rings: Sequence[Ring], diagonals: list[tuple[int, int]]
) -> list[tuple[int, int]]:
    """Diagonals by the number of reflex vertices each of them would cure alone, longer ones first, then by numbers."""
    neighbours = {b: (a, c) for ring in rings for a, b, c in _around(ring)}

    def cures(a: int, b: int) -> bool:
        before, after = neighbours[a]
        return (
            orient(v[before], v[a], v[after]) is Orientation.RIGHT
            and orient(v[before], v[a], v[b]) is not Orientation.RIGHT
            and orient(v[b], v[a], v[after]) is not Orientation.RIGHT
        )

    def usefulness(diagonal: tuple[int, int]) -> tuple[int, int]:
        a, b = diagonal
        return cures(a, b) + cures(b, a), -((v[a][0] - v[b][0]) ** 2) - (v[a][1] - v[b][1]) ** 2

    return sorted(diagonals, key=usefulness)


def _corners_only(v: Sequence[IntPoint], face: Sequence[int]) -> tuple[int, ...]:
    """The face without straight vertices, from its least index on."""
    corners = [b for a, b, c in _around(face) if orient(v[a], v[b], v[c]) is not Orientation.COLLINEAR]
    first = corners.index(min(corners))
    return (*corners[first:], *corners[:first])


def _around(ring: Sequence[int]) -> Iterable[tuple[int, int, int]]:
    """Each vertex of a ring between its neighbours."""
    return zip((ring[-1], *ring[:-1]), ring, (*ring[1:], ring[0]), strict=True)
