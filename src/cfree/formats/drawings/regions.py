"""Regions of a drawing: from rings and curves to outlines with holes, by one exact noding.

`filled_outlines` fills rings by a rule, whatever they cross. `layer_outlines` finds what unfilled curves enclose, see
`enclosed.py`. `clipped` intersects outlines.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

from cfree.curves.drawn import Ring, Segment
from cfree.curves.hulls import Outline, area, box_of, rough
from cfree.formats.drawings.content import Curve
from cfree.formats.drawings.crossings import refuse_crossings
from cfree.formats.drawings.enclosed import enclosed
from cfree.formats.drawings.mesh import Mesh
from cfree.formats.drawings.source import CURVE_SHARE, Source, tolerance_of
from cfree.polygons.faces import Faces
from cfree.polygons.noding import CrowdedError

FINER = 8
"""Chords are this many times nearer to their curves than polygons have to be."""


def filled_outlines(
    source: Source, rings: Sequence[Ring], even_odd: bool, tolerance: float | None = None
) -> list[Outline]:
    """Return the outlines of rings that are filled together; they may cross themselves and each other.

    Parameters
    ----------
    rings : sequence of rings
    even_odd : bool
        Fill by the even-odd rule; if False, fill points with a winding number other than 0.
    tolerance : float, optional
        Tolerance of curves; by default the option's, or a share of the rings' size.
    """
    mesh = Mesh(_sagitta(source, rings, tolerance), source.spend)
    for k, ring in enumerate(rings):
        if ring:
            mesh.add(k, ring, closed=True)
    if not mesh.vertices:
        return []
    faces = _faces(source, mesh)
    weights: dict[int, int] = {}
    solid_rings: set[int] = set()
    for edge in faces.edges:
        by_ring: dict[int, int] = defaultdict(int)
        for owner, sign in mesh.owners(edge):
            by_ring[owner] += sign
        solid_rings |= {owner for owner, times in by_ring.items() if times}
        weights[edge] = sum(by_ring.values())
    if source.reading.repair is False:
        refuse_crossings(mesh, faces.edges, range(len(rings)))
    if flat := sum(1 for ring in rings if ring) - len(solid_rings):
        source.note("lost", "ring on a line: it forbids nothing; give it width", "less", count=flat)
    windings = faces.windings(weights)
    return outlines_of(mesh, faces, [winding % 2 != 0 if even_odd else winding != 0 for winding in windings])


def layer_outlines(
    source: Source,
    layer: str,
    curves: Sequence[Curve],
    hatched: bool = False,
    *,
    size: float | None = None,
    tolerance: float | None = None,
    workspace: bool = False,
) -> list[Outline]:
    """Return the outlines that the unfilled curves of a layer or group enclose together.

    Parameters
    ----------
    layer : str
        Name for notes.
    curves : sequence of Curve
    hatched : bool
        True if the layer has hatches, too; with the option `fills="hatches"` its outlines are then no solids.
    size : float, optional
        Longer side of the box of all entities of the file; by default that of these curves.
    tolerance : float, optional
        Tolerance of curves; by default the option's, or a share of the size.
    workspace : bool
        True if points are allowed inside; ambiguous parts are then left out.
    """
    if hatched and source.reading.fills == "hatches":
        source.note("assumption", "outline beside hatches: it forbids nothing", "less", count=len(curves), where=layer)
        return []
    if size is None:
        x0, y0, x1, y1 = box_of([curve.segments for curve in curves])
        size = max(x1 - x0, y1 - y0)
    tolerance = tolerance or source.reading.tolerance or size / CURVE_SHARE
    try:
        return outlines_of(*enclosed(source, layer, curves, size, tolerance / FINER, workspace=workspace))
    except CrowdedError:
        source.note(
            "lost", "curve of a layer with too many crossings", "less", count=len(curves), where=layer,
            remedy=f"--role {layer}=ignore",
        )  # fmt: skip
        return []


def clipped(
    source: Source, outlines: Sequence[Outline], clip: Sequence[Outline], tolerance: float | None = None
) -> list[Outline]:
    """Return the part of outlines inside of others; each sequence is the union of its members."""
    groups = outlines, clip
    rings = [ring for group in groups for outline in group for ring in outline.rings]
    mesh = Mesh(_sagitta(source, rings, tolerance), source.spend)
    for number, group in enumerate(groups):
        for outline in group:
            for k, ring in enumerate(outline.rings):
                left = area(rough(ring)) > 0
                mesh.add(2 * number + (left != (k == 0)), ring, closed=True)
    if not mesh.vertices:
        return []
    faces = _faces(source, mesh)
    windings: list[list[int]] = []
    for number in range(2):
        weights = {
            edge: sum(
                sign if owner == 2 * number else -sign for owner, sign in mesh.owners(edge) if owner // 2 == number
            )
            for edge in faces.edges
        }
        windings.append(faces.windings(weights))
    return outlines_of(mesh, faces, [a > 0 and b > 0 for a, b in zip(*windings, strict=True)])


def outlines_of(mesh: Mesh, faces: Faces, solid: Sequence[bool]) -> list[Outline]:
    """Return the outlines of solid faces, in the order of what was drawn first."""
    outlines = []
    for outer, *holes in sorted(faces.outlines(solid), key=lambda rings: mesh.first_piece(rings[0])):
        inner = tuple(mesh.outline(faces, hole) for hole in sorted(holes, key=mesh.first_piece))
        outlines.append(Outline(mesh.outline(faces, outer), inner))
    return outlines


def _sagitta(source: Source, rings: Sequence[Sequence[Segment]], tolerance: float | None) -> float:
    return (tolerance or tolerance_of(source, [list(ring) for ring in rings]) or 1.0) / FINER


def _faces(source: Source, mesh: Mesh) -> Faces:
    try:
        mesh.build()
    except CrowdedError:
        source.refuse("an outline that crosses itself too often; simplify it, or leave it out")
    return Faces(mesh.graph)
