"""Contents of the boundary of the forbidden space: scene, features and columns; and poses on it.

`cfree.forbidden.boundary` computes it; slices, meshes and the cell complex are made from it.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple, Self

import cfree._core as _core
from cfree.arguments import checked
from cfree.contact.kind import Kind
from cfree.errors import IncompleteError, InvariantError
from cfree.exact.half_angle import tau_in
from cfree.forbidden.columns import COLUMNS, ISOLATED_COLUMNS, Ints, IsolatedParts, Trapezoids
from cfree.forbidden.kinds import PatchKind
from cfree.libraries import ArrayLike, Floats, Int32s, NDArray, np
from cfree.scene.features import BOUNDS, SceneFeatures
from cfree.scene.scene import Scene
from cfree.value import Value
from cfree.words import counted


@dataclass(frozen=True, slots=True)
class Stats:
    """Statistics of the computation: counts, ways of deciding, seconds per phase.

    Attributes
    ----------
    patches, live_patches : int
        Patches before trimming, and those with live parts: contact patches and the sides of the bounds.
    trapezoids : int
    pairs : int
        Pairs of a patch and a pillar near it.
    decided_by_identity, decided_by_filter, decided_by_intervals, decided_exactly : int
        Numbers of signs and orders, by the method that decided them: equal features; doubles with an error bound;
        intervals in twice their precision; exact integers.
    seconds : dict of str to float
        Times by phase: features, trim, collect, isolated, and their total. `exact` is the part of `trim` that
        exact integers took, summed over threads. Empty for a boundary read from a file.
    """

    patches: int
    live_patches: int
    trapezoids: int
    pairs: int
    decided_by_identity: int
    decided_by_filter: int
    decided_by_intervals: int
    decided_exactly: int
    seconds: dict[str, float] = field(compare=False)


class PatchCounts(NamedTuple):
    """Counts of contact patches and of sides of the bounds, each live and in all."""

    live_contacts: int
    contacts: int
    live_bounds: int
    bounds: int

    def __str__(self) -> str:
        counts = f"{self.live_contacts:,} of {counted(self.contacts, 'contact patch')}"
        sides = f" and {self.live_bounds:,} of {counted(self.bounds, 'side')} of the bounds"
        return counts + (sides if self.bounds else "")


class BoundaryRecord(Value):
    """The trimmed patches of a scene; `cfree.forbidden.boundary.Boundary` lists the attributes."""

    def __init__(
        self,
        scene: Scene,
        features: SceneFeatures,
        kind: NDArray[np.uint8],
        robot: Ints,
        obstacle: Ints,
        trapezoids: Trapezoids,
        isolated: IsolatedParts,
        stats: Stats,
        trimmed: NDArray[np.uint8],
    ) -> None:
        self.scene = scene
        self.features = features
        self.contact_kind = kind
        self.contact_robot = robot
        self.contact_obstacle = obstacle
        self.trapezoids = trapezoids
        self.isolated = isolated
        self.stats = stats
        self.trimmed = np.asarray(trimmed, bool)
        columns = [getattr(trapezoids, name) for name in COLUMNS]
        columns += [getattr(isolated, name) for name in ISOLATED_COLUMNS]
        for array in (kind, robot, obstacle, self.trimmed, *columns):
            array.flags.writeable = False

    @classmethod
    def _of(cls, scene: Scene, features: SceneFeatures, core: _core.Boundary, stats: Stats) -> Self:
        """Wrap a boundary of the core; arrays are views of its memory."""
        patches, parts = core.patches, core.isolated
        contacts = patches.kind, patches.robot, patches.obstacle
        trapezoids = Trapezoids(*(getattr(core.trapezoids, name) for name in COLUMNS))
        isolated = IsolatedParts(
            *(getattr(parts.parts if name in COLUMNS else parts, name) for name in ISOLATED_COLUMNS)
        )
        boundary = cls(scene, features, *contacts, trapezoids, isolated, stats, core.trimmed.view(np.bool_))
        boundary._handle = core
        return boundary

    @cached_property
    def _handle(self) -> _core.Boundary:
        """The core's own boundary, shared by slices, surfaces and cells."""
        patches = _core.Patches(self.contact_kind, self.contact_robot, self.contact_obstacle)
        trapezoids = _core.Trapezoids(*(getattr(self.trapezoids, name) for name in COLUMNS))
        parts = _core.Trapezoids(*(getattr(self.isolated, name) for name in COLUMNS))
        isolated = _core.IsolatedParts(
            parts, *(getattr(self.isolated, name) for name in ISOLATED_COLUMNS[len(COLUMNS) :])
        )
        return _core.Boundary(self.features.core, patches, self.trimmed.view(np.uint8), trapezoids, isolated)

    @property
    def shared(self) -> Self:
        """The same boundary with arrays that are views of the core's memory."""
        return self._of(self.scene, self.features, self._handle, self.stats)

    @cached_property
    def _complex_handle(self) -> _core.CellComplex:
        """The trapezoids glued in the core; see `cfree.forbidden.cell_complex`."""
        return _glued(self, os.cpu_count() or 1)

    @property
    def _content(self) -> tuple[Any, ...]:
        """The contents without statistics."""
        patches = self.contact_kind, self.contact_robot, self.contact_obstacle
        return self.scene, *patches, self.trapezoids, self.isolated, self.trimmed

    @property
    def patch_counts(self) -> PatchCounts:
        """Contact patches and sides of the bounds, each live and in all.

        Examples
        --------
        >>> import cfree
        >>> print(cfree.boundary(cfree.load_scene("examples/scenes/paper_fig9.json")).patch_counts)
        18 of 18 contact patches and 4 of 4 sides of the bounds
        """
        live = np.zeros(len(self.contact_kind), bool)
        live[self.trapezoids.patch] = True
        of_bounds = self.patch_kind == PatchKind.BOUND
        return PatchCounts(
            int(live[~of_bounds].sum()), int((~of_bounds).sum()), int(live[of_bounds].sum()), int(of_bounds.sum())
        )

    def __repr__(self) -> str:
        s = self.stats
        fits = f", {counted(len(self.isolated), 'isolated part')}" if len(self.isolated) else ""
        part = "" if self.complete else f"INCOMPLETE: {self.trimmed.sum()} of {counted(s.patches, 'patch')} trimmed; "
        return f"Boundary({part}{self.patch_counts} live, {counted(s.trapezoids, 'trapezoid')}{fits})"

    @property
    def complete(self) -> bool:
        """True if every patch has been trimmed. An incomplete boundary raises on every query about free space."""
        return bool(self.trimmed.all())

    def require_complete(self) -> None:
        """Raise `IncompleteError` if a limit stopped the computation."""
        if not self.complete:
            done = f"{self.trimmed.sum()} of {counted(len(self.trimmed), 'patch')} trimmed"
            raise IncompleteError(f"incomplete: {done} before a limit stopped it; compute it again with a higher limit")

    @cached_property
    def patch_kind(self) -> NDArray[np.uint8]:
        polygon, kind = self.features.obstacles.owner_polygon, self.contact_kind & 15
        kind = np.where(kind == Kind.VERTEX_VERTEX, PatchKind.ARC_ARC, kind)
        return np.where(polygon[self.contact_obstacle] == BOUNDS, PatchKind.BOUND, kind).astype(np.uint8)

    @cached_property
    def patch_radius(self) -> Floats:
        """Radius of the circle of each arc-arc patch, (P,): the sum of both shapes' radii; 0 for other patches.

        That of a concave arc is negative, and so is this sum: free space is inside the circle.
        """
        return np.where(self.contact_kind & 15 == Kind.VERTEX_VERTEX, self._radii, 0.0)

    @property
    def _radii(self) -> Floats:
        """The sum of the radii of both features of each patch."""
        i, j = self._starts
        sums: Floats = self.features.robot.radius[i] + self.features.obstacles.radius[j]
        return sums

    @property
    def _starts(self) -> tuple[Int32s, Int32s]:
        """Vertices of both features of each patch; of an edge that at its beginning."""
        a, b, i, j = self.features.robot, self.features.obstacles, self.contact_robot, self.contact_obstacle
        return (
            np.where(self.contact_kind == Kind.EDGE_VERTEX, a.v[i], i),
            np.where(self.contact_kind == Kind.VERTEX_EDGE, b.v[j], j),
        )

    @cached_property
    def patch_start(self) -> NDArray[np.int64]:
        """First trapezoid of each patch: those of patch k are ``patch_start[k]`` up to ``patch_start[k + 1]``."""
        return np.searchsorted(self.trapezoids.patch, np.arange(len(self.contact_kind) + 1))

    @cached_property
    def ruled(self) -> Floats:
        ruled = self.ruled_near.copy()
        i, j = self._starts
        ruled[:, 0:2], ruled[:, 4:6] = self.features.obstacles.xy[j], self.features.robot.xy[i]
        ruled = self._moved_outwards(ruled)
        ruled.flags.writeable = False
        return ruled

    @cached_property
    def ruled_near(self) -> Floats:
        """The rows of `ruled` in the features' frame; see `evaluate_near`."""
        a, b = self.features.robot, self.features.obstacles
        on_edge, on_vertex = self.contact_kind == Kind.VERTEX_EDGE, self.contact_kind == Kind.EDGE_VERTEX
        i, j = self._starts
        ruled = np.zeros((len(i), 8))
        ruled[:, 0:2], ruled[:, 4:6] = b.near[j], a.near[i]
        ruled[on_edge, 2:4] = (b.near[b.w] - b.near[b.v])[self.contact_obstacle[on_edge]]
        ruled[on_vertex, 6:8] = (a.near[a.w] - a.near[a.v])[self.contact_robot[on_vertex]]
        return self._moved_outwards(ruled)

    def _moved_outwards(self, ruled: Floats) -> Floats:
        """Move the lines of grown shapes outwards by the sum of their radii: p of v-e patches, a of e-v patches."""
        if self.scene.curved:
            for kind, start, edge in ((Kind.VERTEX_EDGE, 0, 2), (Kind.EDGE_VERTEX, 4, 6)):
                rows = self.contact_kind == kind
                x, y = ruled[rows, edge], ruled[rows, edge + 1]
                length = np.hypot(x, y)
                share = np.divide(self._radii[rows], length, out=np.zeros_like(length), where=length > 0)
                ruled[rows, start] += share * y
                ruled[rows, start + 1] -= share * x
        return ruled

    @cached_property
    def phi_min(self) -> Floats:
        """The first orientation of each patch, (P,) radians in [0, 2 pi) (paper, 3.1.1 and 3.2.1)."""
        a, b = self.features.robot, self.features.obstacles
        on_edge = self.contact_kind == Kind.VERTEX_EDGE
        # along concave arcs normals turn clockwise
        g, f, is_arc = self.contact_robot, self.contact_obstacle, self.patch_kind == PatchKind.ARC_ARC
        g = np.where(is_arc & (a.turning[g] < 0), a.previous[g], g)
        f = np.where(on_edge | (is_arc & (b.turning[f] < 0)), f, b.previous[f])
        along, past = (a.near[a.w] - a.near[a.v])[g], (b.near[b.w] - b.near[b.v])[f]
        cross, dot = along[:, 0] * past[:, 1] - along[:, 1] * past[:, 0], (along * past).sum(axis=1)
        angle = np.mod(np.arctan2(-cross, -dot), 2 * np.pi)
        angle[self.phi_range == 2 * np.pi] = 0.0  # of a disc
        return np.where(self.patch_kind == PatchKind.BOUND, 0.0, np.where(angle < 2 * np.pi, angle, 0.0))

    @cached_property
    def phi_range(self) -> Floats:
        """The angle range of each patch, (P,) radians: pi - rho_i, pi - omega_j, or 2 pi for bounds.

        For an arc on an arc it is the sum of both, at most 2 pi: the range of all four quadrants.
        """
        at_robot = self.features.robot.turning[self.contact_robot]
        at_obstacle = self.features.obstacles.turning[self.contact_obstacle]
        turning = np.where(self.contact_kind == Kind.VERTEX_EDGE, at_robot, at_obstacle)
        both = np.minimum(np.abs(at_robot) + np.abs(at_obstacle), 2 * np.pi)
        turning = np.where(self.patch_kind == PatchKind.ARC_ARC, both, turning)
        return np.where(self.patch_kind == PatchKind.BOUND, 2 * np.pi, turning)

    @checked
    def evaluate(self, patch: ArrayLike, t: ArrayLike, theta: ArrayLike) -> Floats:
        """Return reference points S(t, theta) on patches, eqs. (5) and (8), or of an arc on an arc.

        Parameters
        ----------
        patch : (k,) int
        t : (k,) float, along the edge; on a quadrant of a circle tan(psi / 2), psi counted from its beginning
            If the radius is negative, psi counts clockwise from the quadrant's end.
        theta : (k,) float, radians

        Returns
        -------
        (k, 2) float64
        """
        return self.evaluate_near(patch, t, theta) + self.features.moved(theta)

    @checked
    def evaluate_near(self, patch: ArrayLike, t: ArrayLike, theta: ArrayLike) -> Floats:
        """Return the same points from the features' frame: areas are equal, and far scenes lose no digits."""
        which, t, theta = np.asarray(patch), np.asarray(t, float), np.asarray(theta, float)
        s = self.ruled_near[which]
        ax, ay = s[..., 4] + t * s[..., 6], s[..., 5] + t * s[..., 7]
        c, n = np.cos(theta), np.sin(theta)
        x, y = s[..., 0] + t * s[..., 2] - (c * ax - n * ay), s[..., 1] + t * s[..., 3] - (n * ax + c * ay)
        if self.scene.curved:
            rho = self.patch_radius[which]
            turns = np.pi / 2 * ((self.contact_kind[which] >> 4) + (rho < 0))
            psi = turns + np.where(rho < 0, -2, 2) * np.arctan(t)
            x, y = x + rho * np.cos(psi), y + rho * np.sin(psi)
        return np.stack([x, y], axis=-1)

    @checked
    def limits(self, trapezoid: ArrayLike, theta: ArrayLike) -> tuple[Floats, Floats]:
        """Return the limits of t of trapezoids at orientations within them.

        Parameters
        ----------
        trapezoid : (k,) int
        theta : (k,) float, radians

        Returns
        -------
        lower, upper : (k,) float64
        """
        chosen = np.ascontiguousarray(trapezoid, np.int32)
        return self._slicer.limits(chosen, np.ascontiguousarray(tau_in(self.trapezoids.chart[chosen], theta)))

    @cached_property
    def _slicer(self) -> _core.Slicer:
        """The core's object that computes slices and limits."""
        return _core.Slicer(self._handle)


def glue_by(threads: int, boundary: BoundaryRecord, reuse: BoundaryRecord | None = None) -> None:
    """Compute `_complex_handle` with a number of threads, unless it is there; take faces of another boundary's."""
    if "_complex_handle" not in boundary.__dict__:
        before = None if reuse is None else reuse.__dict__.get("_complex_handle")
        boundary._complex_handle = _glued(boundary, threads, before)


def _glued(boundary: BoundaryRecord, threads: int, reuse: _core.CellComplex | None = None) -> _core.CellComplex:
    try:
        return _core.glue(boundary._handle, threads, reuse)
    except RuntimeError as error:
        raise InvariantError(f"the boundary is not closed: {error}", state=boundary.scene) from error
