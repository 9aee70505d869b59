"""Parts of the plane that the unfilled curves of a layer enclose.

Closed curves are rings. Each connected part of the other curves counts as one ring, its outer contour: a wall that
divides it adds nothing. Tails, and lines from one part to another, belong to no ring. A ring inside of another one is a
hole, one inside of a hole is solid, and so on; rings may touch and share edges. Rings that overlap count as one: solid
where any of them is, or as a hole only where an odd number of them is.

Open curves that close a part of the outside together with rings enclose it, too.

Ends join across gaps, see `joining.py`. A gap beyond what digits explain is a guess: a ring that only a guess closes is
solid, is never a hole, and does not count in the depth of others. So the result contains what is solid if any of the
guesses are made. For a workspace everything in doubt is left out instead.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from cfree.formats.drawings.content import Curve
from cfree.formats.drawings.crossings import refuse_crossings
from cfree.formats.drawings.joining import Ends, Join, square
from cfree.formats.drawings.mesh import Mesh
from cfree.formats.drawings.source import Source
from cfree.formats.drawings.strokes import usual_width
from cfree.polygons.faces import Faces, root
from cfree.polygons.noding import CrowdedError
from cfree.scene.reading import Item, Note, Place, thinned

DEFAULT_JOIN = 1e-6
"""Default joining distance, per size of the drawing."""
ROUNDING = 1e-12
"""Bound of the rounding of a computed gap, per size of the drawing: a gap of 0.3 is closed by a distance of 0.3."""
SHORT = "line shorter than the joining distance"
MOST_NESTED = 20_000_000
"""Maximum number of pairs of a face and a ring around it."""
LINE, GUESS, RING = 1, 2, 4
"""Bits: what an edge is part of."""
Marks = dict[int, list[int]]
"""Rings that an edge bounds."""


@dataclass
class Layer:
    """Curves of one layer in a mesh, with the joins of their ends."""

    source: Source
    name: str
    curves: Sequence[Curve]
    size: float
    mesh: Mesh
    workspace: bool
    closed: set[int] = field(default_factory=set)
    joins: list[Join] = field(default_factory=list)
    guesses: set[int] = field(default_factory=set)  # numbers of joins
    squares: set[int] = field(default_factory=set)  # owners
    kinds: bytearray = field(default_factory=bytearray)

    @property
    def loose(self) -> int:
        """Number of the first owner that is a join."""
        return len(self.curves)

    def sort(self) -> None:
        """Find what each edge is part of: lines and joins, guessed joins, closed curves."""
        kinds = bytearray(len(self.mesh.graph.edges))
        for edge, uses in enumerate(self.mesh.graph.uses):
            for source, _ in uses:
                owner = self.mesh.pieces[source].owner
                if owner in self.closed:
                    kinds[edge] |= RING
                elif owner - self.loose in self.guesses:
                    kinds[edge] |= GUESS
                elif owner not in self.squares:
                    kinds[edge] |= LINE
        self.kinds = kinds

    def is_guess(self, edge: int) -> bool:
        """True if an edge is part of guessed joins only."""
        return self.kinds[edge] == GUESS

    def is_ring(self, edge: int) -> bool:
        """True if an edge is part of a closed curve."""
        return bool(self.kinds[edge] & RING)

    def lines(self, *, guess: bool) -> list[int]:
        """Return the edges of open curves and joins; with guessed joins, if wanted."""
        wanted = LINE | GUESS if guess else LINE
        return [edge for edge, kind in enumerate(self.kinds) if kind & wanted]


def enclosed(
    source: Source, name: str, curves: Sequence[Curve], size: float, sagitta: float, *, workspace: bool
) -> tuple[Mesh, Faces, list[bool]]:
    """Return the faces of the curves of a layer, and which of them are solid; note joins, guesses and losses.

    Raises
    ------
    CrowdedError
        If the curves cross too often.
    """
    layer = Layer(source, name, curves, size, Mesh(sagitta or 1.0, source.spend), workspace)
    _draw(layer)
    _join(layer)
    layer.sort()
    faces = Faces(layer.mesh.graph)
    lines = layer.lines(guess=False)
    if source.reading.repair is False:
        refuse_crossings(layer.mesh, faces.edges, layer.closed)
    alone = faces if len(lines) == len(faces.edges) else Faces(layer.mesh.graph, lines)
    solid, inside = _plain(layer, faces, alone)
    if layer.guesses:
        rings = _guessed_rings(layer, alone)
        _note_guesses(layer, rings)
        if workspace and rings and not any(solid):  # only guesses close it
            outer = max(rings, key=lambda ring: _width(layer, ring))
            rings.remove(outer)
            solid = [odd > 0 for odd in _counts(faces, [outer])]
        for face in _guessed(layer, faces, rings, inside):
            solid[face] = not workspace
    _note_losses(layer, faces, solid)
    return layer.mesh, faces, solid


def _draw(layer: Layer) -> None:
    """Put the curves into the mesh."""
    mesh, source = layer.mesh, layer.source
    tips: dict[int, tuple[int, int]] = {}
    for k, curve in enumerate(layer.curves):
        if curve.segments:
            tips[k] = mesh.add(k, curve.segments, closed=curve.closed, rounding=curve.rounding)
    reach = max(source.reading.join or 0.0, DEFAULT_JOIN * layer.size)
    mesh.build([end for k, ends in tips.items() if not layer.curves[k].closed for end in ends], reach)
    layer.closed = {k for k, (a, b) in tips.items() if mesh.node(a) == mesh.node(b)}
    drawn = {owner for edge in mesh.graph.alive() for owner, _ in mesh.owners(edge)}
    points = [k for k in tips if k not in drawn]
    layer.closed -= set(points)
    for k in points:
        place = mesh.graph.place(mesh.node(tips[k][0]))
        source.note("near", SHORT, "near", where=layer.name, at=place, size=0.0, handle=_handle(layer, k))


def _join(layer: Layer) -> None:
    """Join loose ends: up to the default distance as if drawn, beyond it as guesses."""
    source, mesh = layer.source, layer.mesh
    default, wanted = DEFAULT_JOIN * layer.size, source.reading.join
    plain = default if wanted is None else min(wanted, default)
    _bridge(layer, Ends(mesh).joins(plain), guess=False)
    if wanted is None or wanted <= default:
        return
    _bridge(layer, Ends(mesh).joins(wanted + ROUNDING * layer.size), guess=not source.reading.join_holes)
    if layer.guesses:
        _surround(layer)


def _bridge(layer: Layer, found: list[Join], *, guess: bool) -> None:
    source, mesh = layer.source, layer.mesh
    first = len(layer.joins)
    layer.joins += found
    if guess:
        layer.guesses |= set(range(first, len(layer.joins)))
    mesh.connect((join.start, join.end, layer.loose + first + k) for k, join in enumerate(found))
    for join in found:
        beyond = join.gap > max(DEFAULT_JOIN * layer.size, 2 * mesh.rounding_at(join.start))
        source.note(
            "assumption" if beyond and not guess else "joined",
            "bridged gap that may make a hole" if beyond and not guess else "bridged gap",
            "unknown" if beyond and not guess else "near",
            where=layer.name, at=mesh.graph.place(join.start), size=join.gap, handle=_handle(layer, join.owner),
            remedy="--join 0" if not guess else "",
        )  # fmt: skip


def _surround(layer: Layer) -> None:
    """Draw a square around each guessed join that closes something, so that a corner that was meant is in it."""
    mesh = layer.mesh
    faces = Faces(mesh.graph)
    closing = {
        owner - layer.loose
        for edge in faces.edges
        if faces.is_between(edge)
        for owner, _ in mesh.owners(edge)
        if owner - layer.loose in layer.guesses
    }
    owner = layer.loose + len(layer.joins)
    for number in sorted(closing):
        join = layer.joins[number]
        corners = square(mesh.graph, join.start, join.end, join.gap)
        mesh.connect((corners[k - 1], corners[k], owner) for k in range(4))
        layer.squares.add(owner)
        owner += 1


def _handle(layer: Layer, owner: int) -> str:
    return layer.curves[owner].handle if owner < layer.loose else ""


# --- rings as they are drawn ---


def _plain(layer: Layer, faces: Faces, alone: Faces) -> tuple[list[bool], list[frozenset[int]]]:
    """Return for each face if it is solid without guesses, and the rings around it."""
    parity, filled = _rings(layer, faces, alone)
    inside, contents = _memberships(layer, faces, parity, filled)
    own = _owners_of_faces(faces)
    clusters = _clusters(layer, faces, inside, own)
    depth: dict[int, int] = {}
    around = [{clusters[ring] for ring in rings if ring in clusters} for rings in inside]
    for chain in around:
        for cluster in chain:
            depth[cluster] = min(depth.get(cluster, len(chain)), len(chain) - 1)
    solid = [False] * faces.count
    for face, chain in enumerate(around):
        if not chain:
            continue
        cluster = max(chain, key=depth.__getitem__)
        odd = sum(clusters.get(ring) == cluster for ring in contents[face]) % 2 == 1
        is_hole = depth[cluster] % 2 == 1
        if layer.workspace:
            solid[face] = odd and not is_hole
        else:
            solid[face] = not (odd and is_hole)
    if not layer.workspace:
        for face in _pockets(layer, faces, alone, inside, guess=False):
            solid[face] = True
    return solid, inside


def _rings(layer: Layer, faces: Faces, alone: Faces) -> tuple[Marks, Marks]:
    """Edges at which the number of times inside of a ring changes, and those at which inside or outside changes."""
    graph = layer.mesh.graph
    times: dict[int, dict[int, int]] = defaultdict(lambda: defaultdict(int))
    for edge in faces.edges:
        for owner, _ in layer.mesh.owners(edge):
            if owner in layer.closed:
                times[owner][edge] += 1
    rings: dict[tuple[int, ...], list[int]] = {}
    repeated = 0
    for counts in times.values():
        odd = sorted(edge for edge, count in counts.items() if count % 2)
        if odd:
            repeated += tuple(odd) in rings
            rings.setdefault(tuple(odd), odd)
    if repeated:
        layer.source.note("info", "outline that is drawn again", count=repeated, where=layer.name)
    parity: Marks = defaultdict(list)
    filled: Marks = defaultdict(list)
    number = 0
    for odd in rings.values():
        contour = odd
        if len({node for edge in odd for node in graph.edges[edge]}) < len(odd):
            contour = [edge for part in contours(Faces(graph, odd)) for edge in part]
            layer.source.note(
                "guess", "outline that crosses or touches itself: all that it encloses", "more", where=layer.name,
                at=graph.place(graph.edges[odd[0]][0]),
            )  # fmt: skip
        for edge in odd:
            parity[edge].append(number)
        for edge in contour:
            filled[edge].append(number)
        number += 1
    for contour in contours(alone):
        for edge in contour:
            parity[edge].append(number)
            filled[edge].append(number)
        number += 1
    return parity, filled


def contours(faces: Faces) -> list[list[int]]:
    """Return the outer contours of the connected parts of edges that are no tails and no bridges."""
    return faces.outer_edges(edge for edge in faces.edges if faces.is_between(edge))


def _memberships(
    layer: Layer, faces: Faces, parity: Marks, filled: Marks
) -> tuple[list[frozenset[int]], list[frozenset[int]]]:
    """Rings around each face: those that fill it, and those that wind around it an odd number of times."""
    nothing: frozenset[int] = frozenset()
    inside, odd = [nothing] * faces.count, [nothing] * faces.count
    work = 0
    for half, right, left in faces.crossings():
        edge = half >> 1
        odd[left] = odd[right] ^ frozenset(parity.get(edge, ()))
        inside[left] = inside[right] ^ frozenset(filled.get(edge, ()))
        if inside[left] == odd[left]:
            inside[left] = odd[left]
        work += len(inside[left])
        if work > MOST_NESTED:
            raise CrowdedError
    return inside, odd


def _owners_of_faces(faces: Faces) -> list[int]:
    """Component whose outer contour bounds each face, -1 for the unbounded one."""
    own = [-1] * faces.count
    for half, _, left in faces.crossings():
        own[left] = faces.component[faces.origin(half)]
    return own


def _clusters(layer: Layer, faces: Faces, inside: list[frozenset[int]], own: list[int]) -> dict[int, int]:
    """Return the cluster of each ring: rings that overlap are one; a ring that equals another one is left out."""
    home: dict[int, int] = {}
    for half, right, left in faces.crossings():
        for ring in inside[left] - inside[right]:
            home.setdefault(ring, faces.component[faces.origin(half)])
    alone: dict[int, int] = defaultdict(int)
    both: dict[tuple[int, int], int] = defaultdict(int)
    place: dict[tuple[int, int], int] = {}
    work = 0
    for face, rings in enumerate(inside):
        some = sorted(ring for ring in rings if home[ring] == own[face])
        work += len(some) ** 2
        if work > MOST_NESTED:
            raise CrowdedError
        for k, ring in enumerate(some):
            alone[ring] += 1
            for other in some[k + 1 :]:
                both[ring, other] += 1
                place.setdefault((ring, other), face)
    parent = list(range(max(home, default=-1) + 1))
    same: set[int] = set()
    overlaps: list[tuple[int, int]] = []
    for (a, b), count in both.items():
        if count == alone[a] == alone[b]:
            same.add(b)
        elif count < alone[a] and count < alone[b]:
            overlaps.append((a, b))
            parent[root(parent, b)] = root(parent, a)
    if overlaps:
        where = _place_in(faces, place[overlaps[0]])
        layer.source.note(
            "guess",
            "outline that overlaps another one: as solids both, as holes what is in one",
            "more", count=len({ring for pair in overlaps for ring in pair}), where=layer.name, at=where,
        )  # fmt: skip
    return {ring: root(parent, ring) for ring in home if ring not in same}


def _place_in(faces: Faces, face: int) -> tuple[float, float] | None:
    """Return a corner of a face, in doubles."""
    for edge in faces.edges:
        for half in (2 * edge, 2 * edge + 1):
            if faces.face[half] == face:
                return faces.graph.place(faces.origin(half))
    return None


def _pockets(layer: Layer, faces: Faces, alone: Faces, inside: list[frozenset[int]], *, guess: bool) -> set[int]:
    """Return the bounded faces outside of all rings that open curves, which are `alone`, close together with rings."""
    if not layer.closed or not alone.edges:
        return set()
    edges = [edge for edge, kind in enumerate(layer.kinds) if kind and (guess or kind != GUESS)]
    whole = faces if len(edges) == len(faces.edges) else Faces(layer.mesh.graph, edges)
    closing = [e for e in alone.edges if whole.is_between(e) and not alone.is_between(e) and not layer.is_ring(e)]
    pockets = {whole.face[half] for edge in closing for half in (2 * edge, 2 * edge + 1)} - {0}
    result = set()
    for edge in edges:
        for half in (2 * edge, 2 * edge + 1):
            if whole.face[half] in pockets and not inside[faces.face[half]]:
                result.add(faces.face[half])
    return result - {0}


# --- guesses ---


def _guessed(layer: Layer, faces: Faces, rings: list[list[int]], inside: list[frozenset[int]]) -> set[int]:
    """Return the faces that are solid if some guesses are made, and the surroundings of these joins."""
    squares: dict[int, list[int]] = defaultdict(list)
    for edge in faces.edges:
        for owner, _ in layer.mesh.owners(edge):
            if owner in layer.squares:
                squares[owner].append(edge)
    around = _counts(faces, [*rings, *squares.values()])
    result = {face for face, count in enumerate(around) if count}
    if not layer.workspace:
        alone = Faces(layer.mesh.graph, layer.lines(guess=True))
        result |= _pockets(layer, faces, alone, inside, guess=True)
    return result


def _counts(faces: Faces, rings: list[list[int]]) -> list[int]:
    """Return the number of rings around each face."""
    marks: Marks = defaultdict(list)
    for number, ring in enumerate(rings):
        for edge in ring:
            marks[edge].append(number)
    around = [frozenset[int]()] * faces.count
    for half, right, left in faces.crossings():
        around[left] = around[right] ^ frozenset(marks.get(half >> 1, ()))
    return [len(some) for some in around]


def _width(layer: Layer, ring: list[int]) -> float:
    """Width of the box of some edges."""
    graph = layer.mesh.graph
    xs = [graph.place(node)[0] for edge in ring for node in graph.edges[edge]]
    return max(xs) - min(xs)


def _note_guesses(layer: Layer, rings: list[list[int]]) -> None:
    graph = layer.mesh.graph
    for ring in rings:
        gaps = [join.gap for k, join in enumerate(layer.joins) if k in layer.guesses and _is_in(layer, k, ring)]
        meaning = "only its inside is allowed" if layer.workspace else "solid, and no hole"
        layer.source.note(
            "guess", f"outline that only a join closes: {meaning}", "more", where=layer.name,
            at=graph.place(graph.edges[ring[0]][0]), size=max(gaps, default=None), remedy="--join-holes",
            points=next(iter(_chains(layer, ring)), ()),
        )  # fmt: skip


def _chains(layer: Layer, edges: Iterable[int]) -> list[list[Place]]:
    """Return edges as lines for pictures; each begins at a loose end if there is one."""
    graph, star = layer.mesh.graph, defaultdict[int, list[int]](list)
    for edge in edges:
        for node in graph.edges[edge]:
            star[node].append(edge)
    left, chains = set(edges), list[list[Place]]()
    for first in sorted(star, key=lambda node: len(star[node])):
        node, chain = first, [first]
        while onward := [edge for edge in star[node] if edge in left]:
            left.discard(onward[0])
            u, v = graph.edges[onward[0]]
            node = v if node == u else u
            chain.append(node)
        if len(chain) > 1:
            chains.append([graph.place(node) for node in chain])
    return chains


def _is_in(layer: Layer, join: int, ring: Iterable[int]) -> bool:
    return any(owner == layer.loose + join for edge in ring for owner, _ in layer.mesh.owners(edge))


def _guessed_rings(layer: Layer, alone: Faces) -> list[list[int]]:
    """Return the outer contours with guesses; within a contour without one, those of the rest of its part.

    A part that is apart from the contour without some guesses is a ring of its own then. So what the contour's own
    ring among the lines `alone` is made of is left out, and the rest is searched again.
    """
    graph, rings = layer.mesh.graph, list[list[int]]()
    drawn = _parts(layer, [edge for edge in alone.edges if alone.is_between(edge)])
    waiting = [layer.lines(guess=True)]
    while waiting:
        faces = Faces(graph, waiting.pop())
        core = [edge for edge in faces.edges if faces.is_between(edge)]
        part = _parts(layer, core)
        members: dict[int, list[int]] = defaultdict(list)
        for edge in core:
            members[part[edge]].append(edge)
        rest: list[int] = []
        for contour in faces.outer_edges(core):
            if any(map(layer.is_guess, contour)):
                rings.append(contour)
                continue
            others = [edge for edge in members[part[contour[0]]] if drawn.get(edge) != drawn[contour[0]]]
            if any(map(layer.is_guess, others)):
                rest += others
        if rest:
            waiting.append(rest)
    return rings


def _parts(layer: Layer, edges: list[int]) -> dict[int, int]:
    """Return the connected part of each edge."""
    graph = layer.mesh.graph
    numbers: dict[int, int] = {}
    parent: list[int] = []
    for edge in edges:
        u, v = (numbers.setdefault(node, len(numbers)) for node in graph.edges[edge])
        parent += range(len(parent), len(numbers))
        parent[root(parent, u)] = root(parent, v)
    return {edge: root(parent, numbers[graph.edges[edge][0]]) for edge in edges}


# --- losses ---


def _note_losses(layer: Layer, faces: Faces, solid: list[bool]) -> None:
    """Note the parts of curves that bound nothing and are in nothing solid; lines in a workspace are lost as well."""
    if layer.source.reading.strokes != "ignore":
        return  # all curves are walls
    graph, mesh = layer.mesh.graph, layer.mesh
    lost: dict[int, list[int]] = defaultdict(list)
    for edge in faces.edges:
        sides = solid[faces.face[2 * edge]], solid[faces.face[2 * edge + 1]]
        if not any(sides) or (layer.workspace and all(sides)):
            for owner in {owner for owner, _ in mesh.owners(edge) if owner < layer.loose}:
                lost[owner].append(edge)
    if not lost:
        return
    ends: dict[int, list[int]] = defaultdict(list)
    loose = Ends(mesh)
    for node, owner in loose.owners.items():
        ends[owner].append(node)
    gaps = loose.least_distances(layer.size)
    remedy = _remedy(layer, lost, [gaps[node] for owner in lost for node in ends[owner] if node in gaps])
    for owner, edges in sorted(lost.items()):
        length = sum(math.dist(*map(graph.place, graph.edges[edge])) for edge in edges)
        handle = _handle(layer, owner)
        if layer.workspace and all(_is_at_bridge(layer, node) for edge in edges for node in graph.edges[edge]):
            continue  # a part in the square around a bridge
        if length <= max(DEFAULT_JOIN * layer.size, 4 * layer.curves[owner].rounding):
            place = graph.place(graph.edges[edges[0]][0])
            layer.source.note("near", SHORT, "near", where=layer.name, at=place, size=length, handle=handle)
            continue
        is_open = any(not faces.is_between(edge) for edge in edges)
        nodes = ends[owner] or [graph.edges[edges[0]][0]]
        items = tuple(Item(handle, graph.place(node), gaps.get(node)) for node in nodes)
        items += tuple(Item(handle, points=thinned(chain)) for chain in _chains(layer, edges))
        layer.source.notes.add(
            Note(
                "lost",
                "open line" if is_open else "line between free regions",
                "less",
                1,
                layer.name,
                items[0].at,
                length,
                items,
                remedy,
            )
        )


def _is_at_bridge(layer: Layer, node: int) -> bool:
    """True if a node is in the square around a guessed join, or on it."""
    place = layer.mesh.graph.place
    guesses = (layer.joins[k] for k in layer.guesses)
    return any(math.dist(place(node), place(join.start)) <= 2 * join.gap for join in guesses)


def _remedy(layer: Layer, lost: Iterable[int], gaps: list[float]) -> str:
    """Option that closes the most gaps, or makes walls of lines."""
    used = layer.source.reading.join or DEFAULT_JOIN * layer.size
    wider = [gap for gap in gaps if gap >= used]
    if not wider:
        own = all(layer.curves[owner].width > 0 for owner in lost)
        return "--strokes drawn" if own else f"--strokes {usual_width(layer.curves):g}"
    unit = 10.0 ** (math.floor(math.log10(max(wider))) - 2)
    return f"--join {math.ceil(max(wider) / unit + 1e-6) * unit:.3g}"
