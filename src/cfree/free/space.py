"""Cells of the free space, bounded by the closed surfaces of a boundary; location of poses in them.

Cells are the components of the interior of C_free. The components of `Boundary.complex` are closed surfaces; each has
an inside, and rays decide, exactly, how they are nested. docs/theory/cells.md has the proofs.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any, overload

import cfree._core as _core
from cfree.arguments import checked
from cfree.collision.pose_checker import FORBIDDEN as CERTAINLY_FORBIDDEN
from cfree.collision.pose_checker import FREE as MAY_BE_FREE
from cfree.collision.pose_checker import is_free
from cfree.errors import InvalidPoseError, InvariantError
from cfree.exact.half_angle import chart_of, tau_in_chart
from cfree.exact.pose import OnePose, Pose, PoseLike, Poses, for_core, is_plain, one_pose, to_pose
from cfree.forbidden.boundary import Boundary, boundary_of, regularize_by
from cfree.forbidden.cell_complex import CellComplex
from cfree.forbidden.columns import Ints
from cfree.forbidden.record import glue_by
from cfree.free.homology import Homology, homology_of
from cfree.libraries import Floats, NDArray, np
from cfree.scene.features import SceneFeatures
from cfree.scene.scene import Scene
from cfree.value import Shown, Value
from cfree.words import counted

FORBIDDEN, NO_CELL = -1, -2
BLOCK = 1 << 16  # poses between two checks for Ctrl-C


@dataclass(frozen=True, eq=False)
class Cell(Value, Shown):
    """A component of the interior of C_free.

    Attributes
    ----------
    index : int
        Its number in `FreeSpace.cells`.
    components : tuple of int
        The closed surfaces that bound it: for a bounded cell, first the one around it, then those of the islands in it.
    bounded : bool
        True if its positions are bounded: always with `bounds` or `workspace`, else for all cells but one.
    caged : bool
        True if obstacles alone enclose it: it is bounded, and no face of its boundary belongs to `bounds` or
        `workspace`. A face that they have in common with an obstacle belongs to one of the two.
    turns : int
        Total turns of the loops in it, in theta, are the multiples of this number of full turns. It is 0 if the robot
        always has to turn back, and 1 if it can turn all the way round and return to its pose.
    theta_range : (float, float), radians
        The orientations in it, from the first in [0, 2 pi) to the last: more than a turn apart if it winds up without
        closing. (0, 2 pi) if `turns` is not 0.
    """

    index: int
    components: tuple[int, ...]
    bounded: bool
    caged: bool
    turns: int
    theta_range: tuple[float, float]
    free_space: FreeSpace = field(repr=False)

    @property
    def full_turn(self) -> bool:
        """True if it contains a loop that goes round once in theta."""
        return self.turns == 1

    @property
    def volume(self) -> float:
        """The volume in length^2 radians, infinite if unbounded; see `FreeSpace.volumes`."""
        return float(self.free_space.volumes[self.index])

    @property
    def homology(self) -> Homology:
        """The Betti numbers: b1 is the sum of the genera of its surfaces, b2 their number less 1; no torsion.

        Where forbidden parts touch in a single pose, that pose counts as free.

        Examples
        --------
        >>> import cfree
        >>> room, pillar = [(0, 0), (9, 0), (9, 9), (0, 9)], [(4, 4), (5, 4), (5, 5), (4, 5)]
        >>> scene = cfree.Scene([(0, 0), (1, 0), (0, 1)], [pillar], workspace=room)
        >>> cfree.free_space(cfree.boundary(scene)).cells[0].homology     # a turn, and a way around the pillar
        Homology(b0=1, b1=2, b2=1)
        """
        euler = self.free_space.complex.euler[list(self.components)]
        return homology_of([(2 - number) // 2 for number in euler.tolist()], self.bounded)


@dataclass(frozen=True)
class Nearby:
    """Trapezoids at a pose, and beside it.

    Attributes
    ----------
    on : list of int
        The trapezoids that contain it, ends included.
    end : list of int
        For each of them: -1 if it begins at the pose's orientation, 1 if it ends there, else 0.
    crossed : list of int
        The trapezoids that the ray from it towards -x crosses just after its orientation.
    generic : bool
        True if none of these begins or ends at its orientation.
    """

    on: list[int]
    end: list[int]
    crossed: list[int]
    generic: bool


class FreeSpace(Value, Shown):
    """Cells of the free space of a boundary; see `free_space`.

    Attributes
    ----------
    boundary : Boundary
    surfaces : Boundary
        The boundary whose closed surfaces bound the cells: `boundary`, or ``boundary.regularized`` if `bounds` or
        grown shapes may leave slits of no width, which are not in the interior.
    component : (F,) int32
        The closed surface of each trapezoid of `surfaces`.
    parent : (C,) int32
        The next closed surface around each closed surface, or -1.
    free_inside : (C,) bool
        True if space is free just inside a closed surface: it is then the outer boundary of a cell, else of an island.
    cell_of : (C,) int32
        The cell that a closed surface bounds.
    cells : tuple of Cell
        An unbounded one comes first.
    """

    def __init__(
        self,
        boundary: Boundary,
        component: Ints,
        parent: Ints,
        free_inside: NDArray[np.bool_],
        turns: Ints | None = None,
        lift: Ints | None = None,
        core: _core.FreeSpace | None = None,
    ) -> None:
        self.boundary = boundary
        self.surfaces = bounding_surfaces(boundary)
        self._handle = core or _in_core(self.surfaces, component, parent, free_inside)
        surfaces = self._handle.surfaces
        self.component, self.parent = surfaces.component, surfaces.parent
        if turns is not None and lift is not None:
            self._turned = turns, lift
        self.free_inside = surfaces.free_inside.view(np.bool_)
        self.cell_of, self.depth = self._handle.cell_of, self._handle.depth
        self.outside = 0 if boundary.features.rim is None else FORBIDDEN

    @property
    def _content(self) -> tuple[Any, ...]:
        return self.boundary, self.component, self.parent, self.free_inside, self.turns, self.lift

    def __len__(self) -> int:
        return len(self.cells)

    def __repr__(self) -> str:
        n, caged = len(self.cells), sum(cell.caged for cell in self.cells)
        surfaces = counted(len(self.parent), "closed surface")
        return f"FreeSpace({counted(n, 'cell')}, {caged} caged, {surfaces})"

    @cached_property
    def _turned(self) -> tuple[Ints, Ints]:
        return _core.turns_of(self.surfaces._complex_handle)

    @property
    def turns(self) -> Ints:
        """(C,) int32. Greatest common divisor of the full turns of each closed surface's loops in theta."""
        return self._turned[0]

    @property
    def lift(self) -> Ints:
        """(F,) int32. Full turns to add to a trapezoid's orientations to continue its neighbours', if `turns` is 0."""
        return self._turned[1]

    @property
    def complex(self) -> CellComplex:
        """The complex of `surfaces`."""
        return self.surfaces.complex

    @cached_property
    def cells(self) -> tuple[Cell, ...]:
        count = int(self.cell_of.max(initial=self.outside)) + 1
        members: list[list[int]] = [[] for _ in range(count)]
        for k in np.lexsort((np.arange(len(self.parent)), ~self.free_inside)).tolist():
            members[self.cell_of[k]].append(k)
        caged = self._handle.caged(self.surfaces.features.obstacles.owner_polygon).view(np.bool_)
        ranges = self._theta_ranges()
        cells = []
        for k, components in enumerate(members):
            bounded = k != self.outside
            turns = int(np.gcd.reduce(self.turns[components])) if bounded else 1
            theta = ranges[components[0]] if bounded and turns == 0 else (0.0, math.tau)
            cells.append(Cell(k, tuple(components), bounded, bool(caged[k]), turns, theta, self))
        return tuple(cells)

    def _theta_ranges(self) -> list[tuple[float, float]]:
        """Return the orientations of each closed surface; only for those that do not go round in theta."""
        table, component, turn = self.surfaces.trapezoids, self.component, math.tau * self.lift
        low, high = np.full(len(self.parent), np.inf), np.full(len(self.parent), -np.inf)
        np.minimum.at(low, component, table.theta_from + turn)
        np.maximum.at(high, component, table.theta_to + turn)
        start = np.mod(low, math.tau)
        return list(zip(start.tolist(), (start + (high - low)).tolist(), strict=True))

    @checked
    def faces(self, cell: int) -> Ints:
        """Return the trapezoids of `surfaces` that bound a cell."""
        return np.flatnonzero(self.cell_of[self.component] == range(len(self))[cell]).astype(np.int32)

    @property
    def volumes(self) -> Floats:
        """Volumes (cells,) in length^2 radians (times a length per radian: length^3); infinite if unbounded.

        Notes
        -----
        The divergence theorem is integrated exactly along t, and over theta by quadrature; `volume_errors` estimates
        the error. It is relative to the volumes inside the closed surfaces, not to their difference.
        """
        return self._volumes[0]

    @property
    def volume_errors(self) -> Floats:
        """Estimates of the errors of `volumes`, (cells,), in the same unit; infinite if unbounded.

        Notes
        -----
        The quadrature error is bounded by the integrand's size on ellipses in the complex plane. The rounding error is
        estimated by counting operations, to first order, so the sum is no bound: docs/theory/volumes.md.

        Examples
        --------
        >>> import cfree
        >>> scene = cfree.Scene([(0, 0), (1, 0), (0, 1)], bounds=(0, 0, 3, 2))
        >>> space = cfree.free_space(cfree.boundary(scene))   # the reference point may be anywhere in the bounds
        >>> bool(abs(space.volumes[0] - 12 * math.pi) <= space.volume_errors[0] < 1e-11)
        True
        """
        return self._volumes[1]

    @cached_property
    def _volumes(self) -> tuple[Floats, Floats]:
        return self._handle.volumes()

    @checked
    def areas(self, *, angle_scale: float = 1.0) -> Floats:
        """Return the areas of the cells' boundaries, (cells,), in length^2.

        Parameters
        ----------
        angle_scale : float, length per radian
            1 in the paper.

        Notes
        -----
        Sums of `cfree.geometry.trapezoid_areas` of `surfaces`; the measured error is about 1e-12 of the total.
        """
        from cfree.geometry.integrals import trapezoid_areas

        areas = trapezoid_areas(self.surfaces, angle_scale=angle_scale)
        return np.bincount(self.cell_of[self.component], areas, len(self)).astype(np.float64)

    @overload
    def locate(self, poses: OnePose, *, threads: int | None = None) -> int: ...
    @overload
    def locate(self, poses: Poses | Iterable[PoseLike], *, threads: int | None = None) -> Ints: ...
    def locate(self, poses: OnePose | Poses | Iterable[PoseLike], *, threads: int | None = None) -> int | Ints:
        """Locate poses: return the cell of each one, exactly.

        Parameters
        ----------
        poses : Pose or (x, y, theta), Poses, or sequence of the former
            The doubles of `Poses` are taken exactly: the orientation is that of the rounded half-angle tangent.
        threads : int, optional
            All cores by default. The result does not depend on it.

        Returns
        -------
        int, or (n,) int32
            Number of the cell; -1 if forbidden. A pose on the boundary is free: its cell is the first that a face
            through it bounds. -2 if it is free, in no cell and on no face: an exact fit, in the closure of no cell.

        Notes
        -----
        Time per free pose is about proportional to the faces at its height to the left of it, at its orientation.
        Forbidden poses are mostly recognised as by `is_free`. Each pose takes some microseconds.
        """
        is_fast = is_plain(poses) and (threads is None or (type(threads) is int and threads > 0))
        if is_fast and not self.boundary.scene.curved:
            cell = self._handle.locate_one(self.boundary.checker._handle, for_core(poses))
            if cell is not None:
                return cell
        return self._located(poses, threads=threads)

    @checked
    def _located(self, poses: OnePose | Poses | Iterable[PoseLike], *, threads: int | None) -> int | Ints:
        if threads is not None and threads < 1:
            raise ValueError(f"threads: {threads}; give at least 1")
        if (pose := one_pose(poses, "poses")) is not None:
            return self._locate(pose)
        if not isinstance(poses, Poses):
            many = [to_pose(pose, f"poses[{k}]") for k, pose in enumerate(poses)]  # type: ignore[arg-type]
            return np.array([self._locate(pose) for pose in many], np.int32)
        cells = np.full(len(poses), FORBIDDEN, np.int32)
        for k in range(0, len(poses), BLOCK):
            xy, theta = poses.xy[k : k + BLOCK], poses.theta[k : k + BLOCK]
            # verdicts allow for the tangents' rounding, so that "forbidden" is certain
            verdicts = self._verdicts(np.column_stack([xy, theta]), threads)
            possible = np.flatnonzero(verdicts != CERTAINLY_FORBIDDEN)
            chart, tau = chart_of(theta[possible])
            cell = self._handle.locate(xy[possible], chart.astype(np.int32), tau, threads or os.cpu_count() or 1)
            for m in np.flatnonzero(cell == FORBIDDEN).tolist():
                x, y = xy[possible[m]].tolist()
                if self.boundary.checker.is_free(Pose(x, y, {"tau": tau_in_chart(int(chart[m]), Fraction(tau[m]))})):
                    cell[m] = NO_CELL
            cells[k + possible] = cell
        return cells

    def _verdicts(self, table: Floats, threads: int | None) -> NDArray[np.uint8]:
        """Return `CERTAINLY_FORBIDDEN` where a pose is; rows x, y and theta in [0, 2 pi)."""
        scene = self.boundary.scene
        if not scene.curved:
            return self.boundary.checker.verdicts(table, threads)
        free = is_free(scene, Poses(table[:, :2], table[:, 2]), threads=threads)
        return np.where(free, MAY_BE_FREE, CERTAINLY_FORBIDDEN).astype(np.uint8)

    def _locate(self, pose: Pose) -> int:
        if not self.boundary.checker.is_free(pose):
            return FORBIDDEN
        cell = self._handle.locate_exactly(*self.boundary.features.in_chart(pose))
        return NO_CELL if cell == FORBIDDEN else cell

    @checked
    def nearby(self, pose: PoseLike) -> Nearby:
        """Return the trapezoids of `surfaces` that contain a pose, and those that a ray from it crosses; exactly."""
        pose = to_pose(pose, "pose")
        return Nearby(*self._handle.nearby(*self.boundary.features.in_chart(pose)))

    @checked
    def common_cell(self, start: PoseLike, goal: PoseLike) -> int | None:
        """Return the first cell whose closure contains both poses; None if there is none."""
        first, second = (self._cells_at(to_pose(pose, name)) for pose, name in ((start, "start"), (goal, "goal")))
        return min(first & second, default=None)

    def _cells_at(self, pose: Pose) -> set[int]:
        """Return the cells whose closure contains a pose."""
        if not self.boundary.checker.is_free(pose):
            return set()
        return set(self._handle.cells_at(*self.boundary.features.in_chart(pose))) - {FORBIDDEN}

    @checked
    def angle(self, face: int, last: bool, bits: int) -> tuple[Fraction, Fraction]:
        """Return an interval of tau, in its chart, at most 2**-bits wide, around an end angle of a trapezoid."""
        low, p, high, q = self._handle.angle(face, last, bits)
        return Fraction(low, 1 << p), Fraction(high, 1 << q)

    @checked
    def reachable(self, start: PoseLike) -> Cell:
        """Return the cell whose closure contains a start: the poses that the robot can reach from there.

        Every pose of a cell can be reached from every other without contact. By sliding through a passage exactly as
        wide as the robot, more may be reachable. For a start on the boundary of several cells it is the first.

        Raises
        ------
        InvalidPoseError
            If the start is forbidden; the message names the parts that overlap, and a free pose near by. Also if the
            start is an exact fit in the closure of no cell.

        Examples
        --------
        >>> import cfree
        >>> room = [(0, 0), (9, 0), (9, 9), (0, 9)]
        >>> scene = cfree.Scene([(0, 0), (2, 0), (0, 1)], [[(4, 0), (5, 0), (5, 9), (4, 9)]], workspace=room)
        >>> space = cfree.free_space(cfree.boundary(scene))
        >>> space.reachable(Pose(1, 1)).index == space.reachable(Pose(1, 5)).index != space.reachable(Pose(6, 1)).index
        True
        """
        start = to_pose(start, "start")
        from cfree.collision.nearest_free import require_free

        require_free(self.boundary.checker, start, "start")
        cell = self.locate(start)
        if cell == NO_CELL:
            raise InvalidPoseError("start is free, but an exact fit, in the closure of no cell; see Boundary.isolated")
        return self.cells[cell]


@checked
def free_space(boundary: Boundary, *, threads: int | None = None, reuse: FreeSpace | None = None) -> FreeSpace:
    """Compute the cells of the free space of a boundary.

    Parameters
    ----------
    boundary : Boundary
        Must be complete.
    threads : int, optional
        All cores by default. The result does not depend on it.
    reuse : FreeSpace, optional
        The free space of another scene with the same robot, such as the scene before an obstacle moved. Only faces
        beside those that have changed are glued again. The result has the same bytes as without.

    Returns
    -------
    FreeSpace

    Raises
    ------
    ValueError
        If there are no threads.
    IncompleteError
        If the boundary is incomplete.
    InvariantError
        If the computation contradicts itself: a fault of cfree.

    Notes
    -----
    A corridor exactly as wide as the robot is in no cell, and neither is a place where free space is pinched.

    Nothing is taken from the space given as `reuse` where `boundary` takes nothing from its boundary, and if walls may
    leave slits of no width at `bounds`. Vertices of `FreeSpace.complex` are then placed at first use, in the time of
    gluing all faces, as their last digits depend on all of them.

    Examples
    --------
    >>> import cfree
    >>> hollow = cfree.Polygon([(-1, -1), (10, -1), (10, 10), (-1, 10)], [[(0, 0), (0, 9), (9, 9), (9, 0)]])
    >>> scene = cfree.Scene(robot=[(0, 0), (2, 0), (0, 1)], obstacles=[hollow])
    >>> space = cfree.free_space(cfree.boundary(scene))
    >>> space
    FreeSpace(2 cells, 1 caged, 2 closed surfaces)
    >>> space.locate([cfree.Pose(20, 0), cfree.Pose(4, 4), cfree.Pose(8, 8)]).tolist()
    [0, 1, -1]
    >>> space.cells[1].caged, space.cells[1].full_turn
    (True, True)
    >>> more = scene.with_obstacle([(5, 5), (6, 5), (6, 6)])
    >>> free_space(cfree.boundary(more, reuse=space.boundary), reuse=space)
    FreeSpace(2 cells, 1 caged, 3 closed surfaces)
    """
    if threads is not None and threads < 1:
        raise ValueError(f"threads: {threads}; give at least 1")
    boundary.require_complete()
    bounding = bounding_surfaces(boundary, threads)
    before = reuse.surfaces if reuse is not None and bounding is boundary else None
    glue_by(threads or os.cpu_count() or 1, bounding, before)
    try:
        core = _core.free_space(bounding._complex_handle)
    except RuntimeError as error:
        raise InvariantError(str(error), state=boundary.scene) from error
    return _of_core(boundary, core)


def built_space(
    scene: Scene, features: SceneFeatures, core: _core.Boundary, surfaces: _core.CellComplex, cells: _core.FreeSpace
) -> FreeSpace:
    """Wrap a free space that the core has built: the boundary, the surfaces that bound the cells, and the cells."""
    boundary = boundary_of(scene, features, core)
    if _core.may_have_slits(features.core):
        boundary.regularized = boundary_of(scene, features, surfaces.boundary)
    bounding_surfaces(boundary)._complex_handle = surfaces
    return _of_core(boundary, cells)


def _of_core(boundary: Boundary, core: _core.FreeSpace) -> FreeSpace:
    surfaces = core.surfaces
    inside = surfaces.free_inside.view(np.bool_)
    return FreeSpace(boundary, surfaces.component, surfaces.parent, inside, core=core)


def bounding_surfaces(boundary: Boundary, threads: int | None = None) -> Boundary:
    """Return the boundary of the interior of the free space."""
    if not _core.may_have_slits(boundary.features.core):
        return boundary
    regularize_by(threads or os.cpu_count() or 1, boundary)
    return boundary.regularized


def _in_core(boundary: Boundary, component: Ints, parent: Ints, free_inside: NDArray[np.bool_]) -> _core.FreeSpace:
    surfaces = _core.Surfaces(component, parent, free_inside.view(np.uint8))
    return _core.FreeSpace(boundary._handle, surfaces)
