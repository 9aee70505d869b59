"""The boundary of the forbidden space: every contact patch, trimmed by all obstacles.

`boundary` is the driver: features of the scene, patches and pillars in the core, trapezoids out. C_forb is open:
touching is allowed, and the boundary itself is free.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

import cfree
from cfree.arguments import checked
from cfree.collector import collection_paused
from cfree.errors import IncompleteError, InvariantError
from cfree.exact.half_angle import Angle, tau_in
from cfree.forbidden.columns import CODED, COLUMNS, ISOLATED_COLUMNS, Floats, Ints, IsolatedParts, Trapezoids
from cfree.forbidden.patch import IsolatedPart, Patches, Trapezoid
from cfree.scene.features import BOUNDS, SceneFeatures, scene_features
from cfree.scene.scene import Scene
from cfree.value import Value

VERTEX_EDGE, EDGE_VERTEX, VERTEX_VERTEX, EDGE_EDGE = 1, 2, 3, 4  # the core's kinds of feature pairs


@dataclass(frozen=True, slots=True)
class Stats:
    """What was computed: counts, who decided, seconds per phase.

    Attributes
    ----------
    patches, live_patches : int
        Contact patches before trimming, and those of which something is left.
    trapezoids : int
    pairs : int
        Pairs of a patch and a pillar near it.
    decided_by_identity, decided_by_filter, decided_by_intervals, decided_exactly : int
        Signs and orders, by the rung that decided them: equal features; doubles with an error bound; intervals in
        twice their precision; exact integers.
    seconds : dict of str to float
        By phase: features, trim, collect, isolated, and total, of all. `intervals` and `exact` are the parts of
        `trim` that those two rungs took, summed over threads. Empty for a boundary read from a file.
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


@checked
def boundary(
    scene: Scene,
    *,
    threads: int | None = None,
    max_seconds: float | None = None,
    max_memory: float | None = None,
    progress: Callable[[float], object] | None = None,
) -> Boundary:
    """Trim every contact patch of a scene.

    Parameters
    ----------
    scene : Scene
    threads : int, optional
        All cores by default. The result has the same bytes for any number.
    max_seconds : float, optional
        Stop trimming after that many seconds: the result is then marked as incomplete.
    max_memory : float, optional
        The same once this process has used so many bytes, looked at ten times a second.
    progress : callable, optional
        Called with the share that is done, from 0 to 1, a few times a second.

    Returns
    -------
    Boundary

    Raises
    ------
    ValueError
        If there are no threads, or a limit is negative.
    InvariantError
        If the computation contradicts itself: a fault of cfree. Its `state` is the smallest scene found that does.
    KeyboardInterrupt
        Within a second of Ctrl-C.

    Notes
    -----
    Time is about linear in the number of pairs of a patch and a pillar near it; memory about 90 bytes a trapezoid.

    Examples
    --------
    >>> triangles = Scene(robot=[(0, 0), (2, 0), (0, 1)], obstacles=[[(5, 5), (8, 5), (6, 7)]])
    >>> result = boundary(triangles)
    >>> result.stats.patches, result.stats.live_patches
    (18, 18)
    """
    if threads is not None and threads < 1:
        raise ValueError(f"threads: {threads}; give at least 1")
    for name, limit in (("max_seconds", max_seconds), ("max_memory", max_memory)):
        if limit is not None and not limit >= 0:
            raise ValueError(f"{name}: {limit}; give 0 or more")
    try:
        return _computed(scene, False, threads or os.cpu_count() or 1, max_seconds, max_memory, progress)
    except InvariantError as error:
        from cfree.scene.reduction import smallest_scene

        raise InvariantError(error.what, state=smallest_scene(scene, _contradicts_itself)) from error


def _contradicts_itself(scene: Scene) -> bool:
    try:
        _computed(scene, False, 1)
    except InvariantError:
        return True
    return False


def _computed(
    scene: Scene,
    regularized: bool,
    threads: int,
    max_seconds: float | None = None,
    max_memory: float | None = None,
    progress: Callable[[float], object] | None = None,
) -> Boundary:
    from cfree import _core

    start = time.perf_counter()
    with collection_paused():
        features = scene_features(scene)
        shapes = features.robot.near_shape(), features.obstacles.near_shape()
    prepared = time.perf_counter()
    job = _core.Job(*shapes, threads=threads, regularized=regularized)
    try:
        while not _has_ended(job, scene):
            if progress is not None:
                progress(job.progress())
            if max_seconds is not None and time.perf_counter() - start > max_seconds:
                job.finish_early()
            if max_memory is not None and memory_used() > max_memory:
                job.finish_early()
    except BaseException:
        job.cancel()
        raise
    if progress is not None:
        progress(1.0)
    tally = job.tally()
    kind, robot, obstacle = job.patches()
    trapezoids = Trapezoids(*job.trapezoids())
    columns, *others = job.isolated()
    isolated = IsolatedParts(*columns, *others)
    if regularized:
        isolated = isolated.rows(slice(0))
    for name in CODED:
        features.use_names(getattr(trapezoids, name))
        features.use_names(getattr(isolated, name))
    phases = {key.removesuffix("_seconds"): tally[key] for key in tally if key.endswith("_seconds")}
    seconds = {"features": prepared - start, **phases, "total": time.perf_counter() - start}
    counts = {key: tally[key] for key in tally if not key.endswith("_seconds")}
    stats = Stats(patches=len(kind), trapezoids=len(trapezoids), seconds=seconds, **counts)
    return Boundary(scene, features, kind, robot, obstacle, trapezoids, isolated, stats, job.trimmed())


def _restored(
    scene: Scene,
    kind: Any,
    robot: Any,
    obstacle: Any,
    trapezoids: Trapezoids,
    isolated: Any,
    trimmed: Any,
    stats: Stats,
) -> Boundary:
    return Boundary(scene, scene_features(scene), kind, robot, obstacle, trapezoids, isolated, stats, trimmed)


def memory_used() -> int:
    """The most memory this process has used so far, in bytes."""
    import resource

    used = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return used if sys.platform == "darwin" else 1024 * used


def _has_ended(job: Any, scene: Scene) -> bool:
    try:
        return bool(job.wait(0.1))
    except RuntimeError as error:
        raise InvariantError(str(error), state=scene) from error


class Boundary(Value):
    """Boundary of the forbidden space of a scene; see `boundary` and `load_boundary`.

    Attributes
    ----------
    scene : Scene
    trapezoids : Trapezoids
        The trimmed patches, as arrays.
    isolated : IsolatedParts
        Free poses that no trapezoid reaches: curves, segments at one orientation, and points, where the robot fits
        exactly.
    stats : Stats
    trimmed : (P,) bool
        Which patches have been trimmed: all of them, unless a limit of time or memory stopped the computation.
    patch_kind : (P,) uint8
        1 v-e, 2 e-v, 3 the wall of the bounds.
    ruled : (P, 8) float64
        Coefficients p, q, a, g of ``S(t, phi) = p + t q - R(phi) (a + t g)`` for each patch.
    """

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
        self.trimmed = trimmed.astype(bool)
        columns = [getattr(trapezoids, name) for name in COLUMNS]
        columns += [getattr(isolated, name) for name in ISOLATED_COLUMNS]
        for array in (kind, robot, obstacle, self.trimmed, *columns):
            array.flags.writeable = False

    @property
    def _content(self) -> tuple[Any, ...]:
        """Without what it took to compute it."""
        patches = self.contact_kind, self.contact_robot, self.contact_obstacle
        return self.scene, *patches, self.trapezoids, self.isolated, self.trimmed

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (*self._content, self.stats)

    def __repr__(self) -> str:
        s = self.stats
        fits = f", {len(self.isolated)} isolated parts" if len(self.isolated) else ""
        part = "" if self.complete else f"INCOMPLETE: {self.trimmed.sum()} of {s.patches} patches trimmed; "
        return f"Boundary({part}{s.live_patches} of {s.patches} patches live, {s.trapezoids} trapezoids{fits})"

    @property
    def complete(self) -> bool:
        """Whether every patch has been trimmed. What is not complete answers no question about what is free."""
        return bool(self.trimmed.all())

    def require_complete(self) -> None:
        """Raise `IncompleteError` if a limit stopped the computation."""
        if not self.complete:
            done = f"{self.trimmed.sum()} of {len(self.trimmed)} patches were trimmed"
            raise IncompleteError(f"incomplete: {done} before a limit stopped it; compute it again with a higher limit")

    @cached_property
    def patch_kind(self) -> NDArray[np.uint8]:
        polygon = self.features.obstacles.owner_polygon
        return np.where(polygon[self.contact_obstacle] == BOUNDS, 3, self.contact_kind).astype(np.uint8)

    @cached_property
    def patches(self) -> Patches:
        """All patches, live or not, as a sequence of `Patch`."""
        return Patches(self)

    @cached_property
    def patch_start(self) -> NDArray[np.int64]:
        """Trapezoids of patch k are ``patch_start[k]`` up to ``patch_start[k + 1]``."""
        return np.searchsorted(self.trapezoids.patch, np.arange(len(self.contact_kind) + 1))

    @cached_property
    def complex(self) -> cfree.CellComplex:
        """The trapezoids glued into closed surfaces; computed when first asked for."""
        from cfree.forbidden.cell_complex import glue

        self.require_complete()
        return glue(self)

    @cached_property
    def checker(self) -> cfree.Checker:
        """The scene prepared for `cfree.is_free`; when first asked for."""
        from cfree.collision.pose_checker import Checker

        return Checker(self.scene, self.features)

    @cached_property
    def regularized(self) -> Boundary:
        """The boundary of the interior of the closure of the forbidden space: without parts of no width.

        Isolated parts are left out, and slits between bounds and a wall; computed again when first asked for.
        """
        self.require_complete()
        return _computed(self.scene, True, os.cpu_count() or 1)

    @checked
    def isolated_part(self, k: int) -> IsolatedPart:
        """Isolated part k with its curves and angles named."""
        return IsolatedPart.of(self, range(len(self.isolated))[k])

    @checked
    def trapezoid(self, k: int) -> Trapezoid:
        """Trapezoid k with its curves and angles named."""
        return Trapezoid.of(self, range(len(self.trapezoids))[k])

    @cached_property
    def ruled(self) -> Floats:
        ruled = self._ruled_near.copy()
        ruled[:, 0:2] = self.features.obstacles.xy[self.contact_obstacle]
        ruled[:, 4:6] = self.features.robot.xy[self.contact_robot]
        ruled.flags.writeable = False
        return ruled

    @cached_property
    def _ruled_near(self) -> Floats:
        a, b = self.features.robot, self.features.obstacles
        on_edge = self.contact_kind == VERTEX_EDGE
        i, j = self.contact_robot, self.contact_obstacle
        ruled = np.zeros((len(i), 8))
        ruled[:, 0:2], ruled[:, 4:6] = b.near[j], a.near[i]
        ruled[on_edge, 2:4] = (b.near[b.w] - b.near[b.v])[j[on_edge]]
        ruled[~on_edge, 6:8] = (a.near[a.w] - a.near[a.v])[i[~on_edge]]
        return ruled

    @cached_property
    def phi_min(self) -> Floats:
        """(P,) radians in [0, 2 pi): where each patch begins (paper, 3.1.1 and 3.2.1)."""
        a, b = self.features.robot, self.features.obstacles
        on_edge = self.contact_kind == VERTEX_EDGE
        f = np.where(on_edge, self.contact_obstacle, b.previous[self.contact_obstacle])
        g, f = (a.near[a.w] - a.near[a.v])[self.contact_robot], (b.near[b.w] - b.near[b.v])[f]
        cross, dot = g[:, 0] * f[:, 1] - g[:, 1] * f[:, 0], (g * f).sum(axis=1)
        angle = np.mod(np.arctan2(-cross, -dot), 2 * np.pi)
        return np.where(self.patch_kind == 3, 0.0, np.where(angle < 2 * np.pi, angle, 0.0))

    @cached_property
    def phi_range(self) -> Floats:
        """(P,) radians: pi - rho_i, pi - omega_j, or 2 pi for bounds."""
        at_robot = self.features.robot.turning[self.contact_robot]
        at_obstacle = self.features.obstacles.turning[self.contact_obstacle]
        turning = np.where(self.contact_kind == VERTEX_EDGE, at_robot, at_obstacle)
        return np.where(self.patch_kind == 3, 2 * np.pi, turning)

    @checked
    def evaluate(self, patch: ArrayLike, t: ArrayLike, theta: ArrayLike) -> Floats:
        """Reference point S(t, theta) on patches, eqs. (5) and (8).

        Parameters
        ----------
        patch : (k,) int
        t : (k,) float, along the edge
        theta : (k,) float, radians

        Returns
        -------
        (k, 2) float64
        """
        return self.evaluate_near(patch, t, theta) + self.features.moved(theta)

    @checked
    def evaluate_near(self, patch: ArrayLike, t: ArrayLike, theta: ArrayLike) -> Floats:
        """The same from the features' frame, which keeps areas and has all digits in scenes that are far away."""
        s, t, theta = self._ruled_near[np.asarray(patch)], np.asarray(t, float), np.asarray(theta, float)
        ax, ay = s[..., 4] + t * s[..., 6], s[..., 5] + t * s[..., 7]
        c, n = np.cos(theta), np.sin(theta)
        x, y = s[..., 0] + t * s[..., 2] - (c * ax - n * ay), s[..., 1] + t * s[..., 3] - (n * ax + c * ay)
        return np.stack([x, y], axis=-1)

    @checked
    def limits(self, trapezoid: ArrayLike, theta: ArrayLike) -> tuple[Floats, Floats]:
        """Limits of t of trapezoids at orientations within them.

        Parameters
        ----------
        trapezoid : (k,) int
        theta : (k,) float, radians

        Returns
        -------
        lower, upper : (k,) float64
        """
        chosen = np.ascontiguousarray(trapezoid, np.int32)
        chart = self.trapezoids.chart[chosen]
        tau = np.ascontiguousarray(tau_in(chart, theta))
        lower, upper = np.empty(len(chosen)), np.empty(len(chosen))
        self.slicer.limits(chosen, chart.astype(np.int32), tau, lower, upper)
        return lower, upper

    @checked
    def slice(self, theta: Angle) -> cfree.Slice:
        """The contact segments at one orientation.

        Parameters
        ----------
        theta : float in radians, "30deg" or {"tau": "p/q"}
            At a critical angle the slice is that of the orientations just after it.

        Returns
        -------
        Slice

        Notes
        -----
        Time is proportional to the output, after a look-up; nothing is trimmed again.
        """
        from cfree.forbidden.slice import Slice

        self.require_complete()
        return Slice(self, theta)

    @checked
    def mesh(self, error: float, *, angle_scale: float | None = None) -> cfree.Mesh:
        """Closed triangle meshes within a stated distance of the boundary.

        Parameters
        ----------
        error : float
            Greatest distance of a point of a triangle to the boundary, in the scene's unit of length.
        angle_scale : float, optional
            Length per radian, w below; the robot's radius about its reference point if not given.

        Returns
        -------
        Mesh

        Raises
        ------
        ValueError
            If `error` or `angle_scale` is not positive and finite.
        UnsupportedError
            If there would be more than 10 million triangles; the message names an error that is possible.

        Notes
        -----
        Distances are those of dx^2 + dy^2 + w^2 dtheta^2. The bound is proved in docs/theory.md, "Meshes", for exact
        arithmetic; points are computed in doubles. Time is about linear in the triangles. Isolated parts have none.

        Examples
        --------
        >>> triangles = Scene(robot=[(0, 0), (2, 0), (0, 1)], obstacles=[[(5, 5), (8, 5), (6, 7)]])
        >>> mesh = boundary(triangles).mesh(0.01)
        >>> mesh.error, mesh.angle_scale
        (0.01, 2.0)
        >>> len(mesh.vertices) - len(mesh.seam) - len(mesh.triangles) // 2   # V - E + F of a torus
        0
        """
        from cfree.forbidden.mesh import triangulated

        self.require_complete()
        return triangulated(self, error, angle_scale)

    @cached_property
    def slicer(self) -> Any:
        from cfree import _core

        a, b, t = self.features.robot, self.features.obstacles, self.trapezoids
        return _core.Slicer(
            a.near_shape(), b.near_shape(), a.near.ravel(), b.near.ravel(),
            self.contact_kind, self.contact_robot, self.contact_obstacle,
            t.patch, t.chart, t.lower, t.upper, t.tau_from, t.tau_to, self.features.frame,
        )  # fmt: skip

    @checked
    def save(self, path: str | os.PathLike[str]) -> None:
        """Write scene and boundary to one file, all of it or nothing; `load_boundary` reads it."""
        from cfree.formats.boundary_file import save_boundary

        save_boundary(self, path)
