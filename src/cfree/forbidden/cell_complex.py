"""The boundary as a cell complex: trapezoids glued into closed surfaces.

Faces are trapezoids. The boundary of a face is a loop of coedges, counter-clockwise in its (t, theta), which is the
view from the free side. A coedge has a *twin* on the face across it; where more than two faces meet at an edge, space
is free between twins. So every component is a closed surface without boundary, and a side without a partner is an
error.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from cfree.arguments import checked
from cfree.errors import InvariantError
from cfree.forbidden.columns import Ints
from cfree.libraries import Floats, NDArray, np
from cfree.value import Value

if TYPE_CHECKING:
    from cfree.forbidden.record import BoundaryRecord

SIDES = ("from", "upper", "to", "lower")


@dataclass(frozen=True, eq=False, repr=False)
class CellComplex(Value):
    """Vertices, edges and faces of the boundary, with their incidence.

    Attributes
    ----------
    first : (F + 1,) int32
        Face f is trapezoid f; its loop is the coedges ``first[f]`` up to ``first[f + 1]``, in order.
    face, twin : (H,) int32
        The face of a coedge, and the coedge across it, which runs the other way.
    side : (H,) uint8
        Its side of the trapezoid: 0 the wall at the first angle, 1 the upper curve, 2 the wall at the last angle,
        3 the lower curve.
    vertex : (H,) int32
        The vertex where it starts. Surfaces that touch only in a point have a vertex there each.
    edge : (H,) int32
        The geometric edge it runs along; coedges of several pairs of twins may share one.
    component : (F,) int32
        The closed surface a face belongs to.
    x, y, theta : (V,) float64
        Coordinates of the vertices, rounded; theta in [-pi/2, 3 pi/2].
    near : (V, 2) float64
        x and y from the frame of the boundary's features, with more digits in scenes that are far away.
    vertices, edges, components : int
        Their numbers; there are H / 2 pairs of twins.
    """

    first: Ints
    face: Ints
    side: NDArray[np.uint8]
    twin: Ints
    edge: Ints
    vertex: Ints
    component: Ints
    x: Floats
    y: Floats
    theta: Floats
    near: Floats
    edges: int
    vertices: int
    components: int

    @cached_property
    def euler(self) -> NDArray[np.int64]:
        """(components,) V - E + F of each closed surface: 2 minus twice its genus.

        Examples
        --------
        >>> import cfree
        >>> scene = cfree.Scene(robot=[(0, 0), (2, 0), (0, 1)], obstacles=[[(5, 5), (8, 5), (6, 7)]])
        >>> cfree.boundary(scene).complex.euler.tolist()   # theta goes round: a torus
        [0]
        """
        vertex_component = np.empty(self.vertices, np.int32)
        vertex_component[self.vertex] = self.component[self.face]
        counts = (vertex_component, self.component[self.face], self.component)
        v, h, f = (np.bincount(x, minlength=self.components) for x in counts)
        euler: NDArray[np.int64] = v - h // 2 + f
        return euler

    @cached_property
    def pinched(self) -> Ints:
        """Edges at which more than two faces meet."""
        return np.flatnonzero(np.bincount(self.edge, minlength=self.edges) > 2).astype(np.int32)

    @checked
    def loop(self, face: int) -> range:
        """Return the coedges around a face, counter-clockwise from the lower end of its first wall."""
        return range(int(self.first[face]), int(self.first[face + 1]))

    @checked
    def before(self, coedge: int) -> int:
        """Return the previous coedge in the loop."""
        loop = self.loop(int(self.face[coedge]))
        return coedge - 1 if coedge > loop.start else loop.stop - 1

    @checked
    def around_vertex(self, coedge: int) -> Iterator[int]:
        """Yield the coedges that start at the same vertex, counter-clockwise as seen from the free side.

        Examples
        --------
        >>> import cfree
        >>> scene = cfree.Scene(robot=[(0, 0), (2, 0), (0, 1)], obstacles=[[(5, 5), (8, 5), (6, 7)]])
        >>> cells = cfree.boundary(scene).complex
        >>> around = list(cells.around_vertex(0))
        >>> set(cells.vertex[around]) == {cells.vertex[0]}
        True
        """
        h = coedge
        while True:
            yield h
            h = int(self.twin[self.before(h)])
            if h == coedge:
                return

    @checked
    def at_edge(self, edge: int) -> Ints:
        """Return the coedges along a geometric edge."""
        order, start = self._by_edge
        return order[start[edge] : start[edge + 1]]

    @checked
    def neighbours(self, face: int) -> Ints:
        """Return the faces across the coedges of a face, in the order of its loop."""
        loop = self.loop(face)
        return self.face[self.twin[loop.start : loop.stop]]

    @cached_property
    def _by_edge(self) -> tuple[Ints, NDArray[np.int64]]:
        order = np.argsort(self.edge, kind="stable").astype(np.int32)
        return order, np.searchsorted(self.edge[order], np.arange(self.edges + 1))


def glue(boundary: BoundaryRecord) -> CellComplex:
    """Match the sides of all trapezoids, exactly, by the names of their ends.

    Raises
    ------
    InvariantError
        If a side has no partner or a surface is not closed: a fault of cfree. Its `state` is the scene.

    Notes
    -----
    Time is about linear in the trapezoids.
    """
    core, features = boundary._complex_handle, boundary.features
    x, y = (core.xy + features.moved(core.theta)).T.copy()
    x.flags.writeable = y.flags.writeable = False
    loops = core.first, core.face, core.side, core.twin, core.edge, core.vertex, core.component
    cells = CellComplex(*loops, x, y, core.theta, core.xy, core.edges, core.vertices, core.components)
    if np.any(cells.euler % 2 != 0) or np.any(cells.euler > 2):
        wrong = f"Euler numbers {cells.euler.tolist()}; those of closed surfaces are even and at most 2"
        raise InvariantError(wrong, state=boundary.scene)
    return cells
