"""Arrangement of the boundaries of all pairs of a scene: vertices, edges, faces, and cells with their depth.

A *pair* is a polygon of the robot and an obstacle; F is the set of poses in which their interiors meet. The surfaces
are the boundaries of all F, one for each pair; for convex shapes they are the paper's contact patches (Definition 2).
They are not the paper's contact surfaces (Definition 1), which continue where the pair overlaps: see
`cfree.arrangements.census`. The *depth* of a pose is the number of pairs with the pose in F; depth 0 is free.
docs/theory/arrangement.md has the proofs.
"""

from __future__ import annotations

import os
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

import cfree._core as _core
from cfree.arguments import checked
from cfree.arrangements.statistics import ArrangementStatistics, DepthCell, counted, vertex_bounds
from cfree.curves.curved import REFUSED
from cfree.errors import InvariantError, UnsupportedError
from cfree.exact.half_angle import Angle
from cfree.exact.pose import PoseLike, to_pose
from cfree.forbidden.boundary import memory_used
from cfree.forbidden.columns import Ints
from cfree.forbidden.record import BoundaryRecord, Stats
from cfree.forbidden.slice import Slice
from cfree.libraries import Floats
from cfree.scene.features import BOUNDS, WORKSPACE, scene_features
from cfree.scene.scene import Scene
from cfree.value import Value

MOST_VERTICES = 2_000_000
BYTES_PER_PIECE = 1_000  # upper bound, including all derived data
ON_SURFACE = -1
VERTEX_KINDS = ("triple contact", "helix crossing", "end")
EDGE_KINDS = ("helix", "crossing", "segment")

Pair = tuple[int, int]


@checked
def arrangement(scene: Scene, *, threads: int | None = None, max_memory: float | None = None) -> Arrangement:
    """Intersect the boundaries of all pairs: the whole configuration space, not only its free part.

    A pair is a polygon of the robot and an obstacle. Its boundary consists of contact patches, where the two touch. The
    paper's contact surfaces also have the pseudo contacts, at poses where the two overlap. Two surfaces of one pair may
    cross there, which is not a vertex here; `census` counts these crossings.

    Parameters
    ----------
    scene : Scene
        The complement of its `workspace` is one obstacle, for all polygons of the robot. The complement of its `bounds`
        is another, for the reference point. So depth 0 is the free space inside them.
    threads : int, optional
        Number of threads, all cores by default. The result does not depend on it.
    max_memory : float, optional
        Greatest number of bytes that this process may use.

    Returns
    -------
    Arrangement

    Raises
    ------
    UnsupportedError
        If there are more than 2 million vertices, or memory does not suffice: pieces of surfaces are counted before
        anything is computed from them. If surfaces meet in an undecided way; the message names the pairs. If a shape
        is round; the message names the remedy.
    InvariantError
        If the computation contradicts itself: a bug in cfree.

    Notes
    -----
    Time is about linear in the number of pairs of a patch and a pillar near it, times the pieces that the patch is cut
    into: some 10 microseconds and 600 bytes a piece. All signs are exact. If a polygon of the robot fits one obstacle
    exactly, with zero clearance (`Boundary.isolated`), the pair counts as overlapping.

    Examples
    --------
    Two triangles that overlap, and a triangle as the robot:

    >>> from cfree.arrangements import arrangement
    >>> scene = Scene([(0, 0), (2, 0), (0, 1)], [[(5, 5), (8, 5), (6, 7)], [(6, 6), (9, 6), (7, 8)]])
    >>> whole = arrangement(scene)
    >>> whole
    Arrangement(87 vertices, 145 edges, 58 faces, 4 cells, depth at most 2)
    >>> [(cell.depth, cell.pairs, cell.euler) for cell in whole.cells]
    [(0, (), 0), (1, ((0, 0),), 0), (1, ((0, 1),), 0), (2, ((0, 0), (0, 1)), 0)]
    >>> whole.depth((6, 5.5, 0)), whole.depth((20, 0, 0))
    (2, 0)
    >>> len(whole.vertex_pose) - len(whole.edge_kind) + len(whole.face_patch) == whole.euler == 0
    True
    >>> whole.statistics.vertices_by_kind["end"]
    84
    """
    if threads is not None and threads < 1:
        raise ValueError(f"threads: {threads}; give at least 1")
    if max_memory is not None and not max_memory >= 0:
        raise ValueError(f"max_memory: {max_memory}; give 0 or more")
    if scene.curved:
        raise UnsupportedError(f"the arrangement: {REFUSED}")
    features = scene_features(scene)
    most = 8 * MOST_VERTICES
    if max_memory is not None:
        most = min(most, int(max(0.0, max_memory - memory_used()) / BYTES_PER_PIECE))
    try:
        core = _core.arrange(features.made, threads or os.cpu_count() or 1, most, MOST_VERTICES)
    except ValueError as error:
        raise UnsupportedError(f"the arrangement: {error}") from error
    except RuntimeError as error:
        raise InvariantError(f"the arrangement: {error}", state=scene) from error
    return Arrangement(scene, core)


class Arrangement(Value):
    """Arrangement of the boundaries of all pairs of a scene; see `arrangement`.

    A *face* is a part of one contact patch that no other surface crosses. Its inner side is in F of its pair, its outer
    side is not. Surfaces of several pairs may coincide; such a face has all of them as owners. Faces end, or meet other
    faces, at *edges*; edges do so at *vertices*. Faces consist of *pieces*, which are trapezoids.

    Attributes
    ----------
    scene : Scene
    sheets : BoundaryRecord
        Pieces, as trapezoids of patches.
    vertex_pose : (V, 3) float64
        x, y and theta, rounded; theta in [-pi/2, 3 pi/2].
    vertex_kind : (V,) uint8
        0: three surfaces cross; 1: a helix meets a surface; 2: a segment of edge-edge contacts ends, among others.
    vertex_degree : (V,) int32
        Number of ends of edges there.
    vertex_pairs : (V,) int32
        Number of pairs whose boundary contains it.
    edge_kind : (E,) uint8
        0: a helix, vertex on vertex; 1: two surfaces cross; 2: a segment at one orientation, edge on edge.
    edge_vertices : (E, 2) int32
        First and last vertex; both are -1 if the edge is closed.
    edge_start, edge_face : (E + 1,) and (n,) int32
        The faces around edge e, counter-clockwise, are ``edge_face[edge_start[e]:edge_start[e + 1]]``.
    face_patch : (F,) int32
        Its patch in `sheets`; for coincident faces, the first one's.
    face_cells : (F, 2) int32
        Cells on its outer and its inner side.
    face_owners : (F,) int32
        Number, in `sets`, of the set of pairs whose boundary contains it.
    face_euler, cell_euler : (F,) and (C,) int32
        Euler characteristic: 1 for a disc or a ball. A cell has half of that of the closed surfaces around it.
    cell_set : (C,) int32
        Number, in `sets`, of the set of pairs that overlap in it.
    cell_depth : (C,) int64
    sets : tuple of tuple of (int, int)
        Sets of pairs (polygon of the robot, obstacle). The obstacle is -2 for the workspace. For the bounds it is -1,
        and the polygon is the number of the robot's polygons.
    """

    def __init__(self, scene: Scene, core: _core.Arrangement) -> None:
        self.scene, self._handle = scene, core
        self.features = scene_features(scene)
        stats = Stats(len(core.boundary.patches.kind), 0, len(core.face_of), 0, 0, 0, 0, 0, {})
        self.sheets = BoundaryRecord._of(scene, self.features, core.boundary, stats)
        near = core.xy + self.features.moved(core.theta)
        self.vertex_pose: Floats = np.column_stack([near, core.theta])
        self.vertex_kind, self.vertex_degree = core.vertex_kind, core.vertex_degree
        self.vertex_pairs = core.vertex_pairs
        self.edge_kind, self.edge_vertices = core.edge_kind, core.edge_vertices
        self.edge_start, self.edge_face = core.edge_start, core.edge_face
        self.face_patch: Ints = core.boundary.trapezoids.patch[core.face_first]
        self.face_cells: Ints = np.column_stack([core.face_outer, core.face_inner])
        self.face_owners: Ints = core.owners[core.face_first]
        self.face_euler, self.cell_euler, self.cell_set = core.face_euler, core.cell_euler, core.cell_set
        self.cell_depth = self._set_sizes[core.cell_set]
        if self.euler != int(self.cell_euler.sum()):
            raise InvariantError(f"V - E + F = {self.euler}, of cells {self.cell_euler.sum()}", state=scene)

    @property
    def _content(self) -> tuple[Any, ...]:
        faces = self.face_patch, self.face_cells, self.face_owners, self.face_euler
        edges = self.edge_kind, self.edge_vertices, self.edge_face
        return self.scene, self.vertex_pose, *edges, *faces, self.cell_set, self.cell_euler

    def __reduce__(self) -> tuple[Any, ...]:
        return arrangement, (self.scene,)

    def __repr__(self) -> str:
        counts = len(self.vertex_pose), len(self.edge_kind), len(self.face_patch), len(self.cell_set)
        names = "vertices", "edges", "faces", "cells"
        listed = ", ".join(f"{n} {name}" for n, name in zip(counts, names, strict=True))
        return f"Arrangement({listed}, depth at most {self.cell_depth.max()})"

    @property
    def euler(self) -> int:
        """Euler characteristic of all surfaces together: vertices minus edges with ends, plus that of each face.

        It is the sum of those of the cells: the whole space R^2 x S^1 has characteristic 0, with compact support.
        """
        ending = int((self.edge_vertices[:, 0] >= 0).sum())
        return len(self.vertex_pose) - ending + int(self.face_euler.sum())

    @cached_property
    def sets(self) -> tuple[tuple[Pair, ...], ...]:
        obstacles = len(self.scene.obstacles)

        def pair(number: int) -> Pair:
            robot, obstacle = divmod(number, obstacles + 2)
            return robot, obstacle if obstacle < obstacles else WORKSPACE if obstacle == obstacles else BOUNDS

        start, member = self._handle.set_start.tolist(), self._handle.set_member.tolist()
        return tuple(tuple(map(pair, member[i:j])) for i, j in pairwise(start))

    @property
    def volumes(self) -> Floats:
        """Volumes of the cells, (C,), in length^2 radians, infinite for the first; see `FreeSpace.volumes`."""
        return self._volumes[0]

    @property
    def volume_errors(self) -> Floats:
        """Estimated errors of the volumes, (C,); see `FreeSpace.volume_errors`."""
        return self._volumes[1]

    @cached_property
    def _volumes(self) -> tuple[Floats, Floats]:
        return self._handle.volumes()

    @cached_property
    def cells(self) -> tuple[DepthCell, ...]:
        """All cells; the unbounded one comes first."""
        rows = zip(
            self.cell_set.tolist(),
            self.cell_euler.tolist(),
            self._handle.cell_surfaces.tolist(),
            self.volumes.tolist(),
            strict=True,
        )
        return tuple(DepthCell(k, self.sets[pairs], *row) for k, (pairs, *row) in enumerate(rows))

    @cached_property
    def statistics(self) -> ArrangementStatistics:
        """Counts of vertices, edges, faces and cells by kind."""
        return ArrangementStatistics(
            vertices=len(self.vertex_pose),
            edges=len(self.edge_kind),
            faces=len(self.face_patch),
            cells=len(self.cell_set),
            max_depth=int(self.cell_depth.max()),
            vertices_by_kind=counted(self.vertex_kind, VERTEX_KINDS),
            vertices_by_degree=counted(self.vertex_degree),
            vertices_by_pairs=counted(self.vertex_pairs),
            edges_by_kind=counted(self.edge_kind, EDGE_KINDS),
            faces_by_contact=counted(self.sheets.contact_kind[self.face_patch] - 1, ("v-e", "e-v")),
            faces_by_depth=counted(self.face_depth),
            cells_by_depth=counted(self.cell_depth),
            bounds=vertex_bounds(self.features),
        )

    @property
    def face_depth(self) -> NDArray[np.int64]:
        """Depth on each face, (F,): the number of pairs that overlap there, without the face's owners."""
        return self.depth_of_pieces[self._handle.face_first]

    @cached_property
    def depth_of_pieces(self) -> NDArray[np.int64]:
        """Depth on each piece, (T,); see `face_depth`."""
        size = self._set_sizes
        outer, inner, owners = size[self._handle.outer], size[self._handle.inner], size[self._handle.owners]
        depths: NDArray[np.int64] = (outer + inner - owners) // 2
        return depths

    @property
    def _set_sizes(self) -> NDArray[np.int64]:
        start = self._handle.set_start.astype(np.int64)
        sizes: NDArray[np.int64] = start[1:] - start[:-1]
        return sizes

    @checked
    def cell(self, pose: PoseLike) -> int:
        """Number of the cell that contains a pose, decided exactly; -1 if the pose is on a surface."""
        return self._place(pose)[0]

    @checked
    def depth(self, pose: PoseLike) -> int:
        """Number of pairs whose interiors meet at a pose, decided exactly."""
        cell, on = self._place(pose)
        if cell != ON_SURFACE:
            return int(self.cell_depth[cell])
        sets = [set(self.sets[k]) for piece in on for k in (self._handle.outer[piece], self._handle.inner[piece])]
        return len(set.intersection(*sets))

    def _place(self, pose: PoseLike) -> tuple[int, list[int]]:
        return self._handle.locate(*self.features.in_chart(to_pose(pose, "pose")))

    @checked
    def slice(self, theta: Angle) -> Slice:
        """Segments of all surfaces at one orientation, which `cfree.plot.plot_depths` draws.

        Parameters
        ----------
        theta : float in radians, "30deg" or {"tau": "p/q"}
            At a critical angle it is the slice of the orientations just after it.

        Returns
        -------
        Slice
            Its `trapezoids` are pieces.
        """
        return Slice(self.sheets, theta)
