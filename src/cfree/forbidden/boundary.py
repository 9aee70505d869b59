"""The boundary of the forbidden space: every contact patch, trimmed by all obstacles.

`boundary` is the driver: it computes the features of the scene, then patches and pillars in the core, which give
trapezoids. C_forb is open: touching is allowed, and the boundary itself is free.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable
from functools import cached_property
from typing import Any

import cfree._core as _core
from cfree.arguments import checked
from cfree.collector import collection_paused
from cfree.collision.pose_checker import PoseChecker
from cfree.errors import InvariantError, LaboriousSceneError
from cfree.exact.half_angle import Angle
from cfree.forbidden.cell_complex import CellComplex, glue
from cfree.forbidden.columns import Trapezoids
from cfree.forbidden.labour import refuse_laborious
from cfree.forbidden.mesh import Mesh, triangulated
from cfree.forbidden.patch import IsolatedPart, Patches, Trapezoid
from cfree.forbidden.record import BoundaryRecord, Stats
from cfree.forbidden.slice import Slice
from cfree.scene.features import SceneFeatures, grown_features
from cfree.scene.scene import Scene
from cfree.value import Shown

PHASES = ("trim", "collect", "isolated", "exact")
DECIDED = ("decided_by_identity", "decided_by_filter", "decided_by_intervals", "decided_exactly")
COUNTS = ("live_patches", "pairs", *DECIDED)


@checked
def boundary(
    scene: Scene,
    *,
    threads: int | None = None,
    max_seconds: float | None = None,
    max_memory: float | None = None,
    progress: Callable[[float], object] | None = None,
    reuse: Boundary | None = None,
) -> Boundary:
    """Trim every contact patch of a scene.

    Parameters
    ----------
    scene : Scene
    threads : int, optional
        All cores by default. The result has the same bytes for any number.
    max_seconds : float, optional
        Stop trimming after that many seconds: the result is then marked as incomplete. With `math.inf` it goes on.
    max_memory : float, optional
        Stop in the same way once this process has used that many bytes, checked ten times a second.
    progress : callable, optional
        Called with the completed share, from 0 to 1, a few times a second.
    reuse : Boundary, optional
        The boundary of another scene with the same robot. Obstacles are matched by their vertices, in any order. Only
        patches within the robot's reach of a changed one are trimmed; all others are taken from there. The result has
        the same bytes as without.

    Returns
    -------
    Boundary

    Raises
    ------
    ValueError
        If there are no threads, or a limit is negative.
    LaboriousSceneError
        If a scene of fewer than 2,000 vertices would take some 10 seconds of one core or more, by an estimate of
        counts, and neither `max_seconds`, `max_memory` nor `reuse` is given.
    InvariantError
        If the computation contradicts itself: a fault of cfree. Its `state` is the scene.
    UnsupportedError
        If a shape is not rounded, that is, bounded by lines and arcs of rational radii, without cusps: polygons, discs,
        stadiums, grown polygons, half discs, lenses, brackets with fillets, plates with round holes.
    KeyboardInterrupt
        Within a second of Ctrl-C.

    Notes
    -----
    Time is about linear in the number of pairs of a patch and a pillar near it; memory about 90 bytes a trapezoid.

    Nothing is taken from the boundary given as `reuse` among round shapes, or if it was read from a file or unpickled;
    if a quarter of the obstacles' vertices has become decimals, decimals of more than six digits, or simple fractions
    such as thirds; or if the origin of a scene far from 0 has moved. Doubles, and shapes turned by any angle, change
    nothing elsewhere. `Boundary.kept_patches` counts the patches that were taken.

    Rounded shapes are exact, not replaced by polygons, and so are exact fits among them (`Boundary.isolated`): discs in
    round holes and pegs in round slots included.

    Examples
    --------
    >>> triangles = Scene(robot=[(0, 0), (2, 0), (0, 1)], obstacles=[[(5, 5), (8, 5), (6, 7)]])
    >>> result = boundary(triangles)
    >>> result.stats.patches, result.stats.live_patches
    (18, 18)
    >>> more = boundary(triangles.with_obstacle([(50, 5), (80, 5), (60, 7)]), reuse=result)
    >>> more.kept_patches, more.stats.patches
    (18, 36)
    """
    if threads is not None and threads < 1:
        raise ValueError(f"threads: {threads}; give at least 1")
    for name, limit in (("max_seconds", max_seconds), ("max_memory", max_memory)):
        if limit is not None and not limit >= 0:
            raise ValueError(f"{name}: {limit}; give 0 or more")
    goes_on = scene.curved or any(given is not None for given in (max_seconds, max_memory, reuse))
    count = threads or os.cpu_count() or 1
    return _computed(scene, False, count, max_seconds, max_memory, progress, reuse, may_refuse=not goes_on)


def _computed(
    scene: Scene,
    regularized: bool,
    threads: int,
    max_seconds: float | None = None,
    max_memory: float | None = None,
    progress: Callable[[float], object] | None = None,
    reuse: Boundary | None = None,
    *,
    may_refuse: bool = False,
) -> Boundary:
    start = time.perf_counter()
    with collection_paused():
        features = grown_features(scene)
        core_scene = features.core

    def go_on(share: float) -> bool:
        if progress is not None:
            progress(share)
        if max_seconds is not None and time.perf_counter() - start > max_seconds:
            return False
        return max_memory is None or memory_used() <= max_memory

    curved = scene.curved or (reuse is not None and reuse.scene.curved)
    try:
        if may_refuse:
            refuse_laborious(scene, features)
        prepared = time.perf_counter()
        core = _core.compute_boundary(
            core_scene, threads, regularized, go_on, reuse=None if reuse is None or curved else reuse._handle
        )
    except LaboriousSceneError:  # a RuntimeError as well
        raise
    except RuntimeError as error:
        raise InvariantError(str(error), state=scene) from error
    if progress is not None:
        progress(1.0)
    result = boundary_of(scene, features, core)
    result.stats.seconds.update(features=prepared - start, total=time.perf_counter() - start)
    return result


def boundary_of(scene: Scene, features: SceneFeatures, core: _core.Boundary) -> Boundary:
    """Wrap a boundary that the core has computed."""
    seconds = {phase: getattr(core.tally, f"{phase}_seconds") for phase in PHASES}
    seconds["total"] = sum(seconds[phase] for phase in PHASES[:3])
    counts = {name: getattr(core.tally, name) for name in COUNTS}
    stats = Stats(patches=len(core.trimmed), trapezoids=len(core.trapezoids.patch), seconds=seconds, **counts)
    return Boundary._of(scene, features, core, stats)


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
    return Boundary(scene, grown_features(scene), kind, robot, obstacle, trapezoids, isolated, stats, trimmed).shared


def memory_used() -> int:
    """Return the most memory that this process has used so far, in bytes."""
    import resource

    used = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return used if sys.platform == "darwin" else 1024 * used


class Boundary(BoundaryRecord, Shown):
    """Boundary of the forbidden space of a scene; see `boundary` and `load`.

    Attributes
    ----------
    scene : Scene
    trapezoids : Trapezoids
        The trimmed patches, as arrays.
    isolated : IsolatedParts
        Exact fits that no trapezoid reaches: curves, segments at one orientation, and points. All that are listed are
        free and have no room beside them. In concave arcs two kinds are left out: places at one orientation that
        several pairs of opposite contacts hold together, and arcs to slide along at one orientation.
    stats : Stats
    trimmed : (P,) bool
        True for patches that have been trimmed: all of them, unless a limit of time or memory stopped the computation.
    patch_kind : (P,) uint8
        1 v-e, 2 e-v, 3 bounds, 4 an arc on an arc; see `PatchKind`.
    ruled : (P, 8) float64
        Coefficients p, q, a, g of ``S(t, phi) = p + t q - R(phi) (a + t g)`` for each patch. For an arc on an arc this
        is the centre of the circle of radius `patch_radius`, and q = g = 0.
    """

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (*self._content, self.stats)

    @property
    def kept_patches(self) -> int:
        """The number of patches that were taken from the boundary given as `reuse`; 0 after reading or unpickling."""
        return self._handle.tally.kept_patches

    @cached_property
    def patches(self) -> Patches:
        """All patches, live or not, as a sequence of `Patch`."""
        return Patches(self)

    @cached_property
    def complex(self) -> CellComplex:
        """The trapezoids glued into closed surfaces; computed at first use."""
        self.require_complete()
        return glue(self)

    @cached_property
    def checker(self) -> PoseChecker:
        """The scene prepared for `cfree.is_free`; computed at first use."""
        return PoseChecker(self.scene, self.features)

    @cached_property
    def regularized(self) -> Boundary:
        """The boundary of the interior of the closure of the forbidden space: without parts of no width.

        It has no isolated parts, no slits between bounds and a wall, and none that a disc fills exactly; computed at
        first use.
        """
        self.require_complete()
        return _computed(self.scene, True, os.cpu_count() or 1)

    @checked
    def isolated_part(self, k: int) -> IsolatedPart:
        """Return isolated part k with its curves and angles named."""
        return IsolatedPart.of(self, range(len(self.isolated))[k])

    @checked
    def trapezoid(self, k: int) -> Trapezoid:
        """Return trapezoid k with its curves and angles named."""
        return Trapezoid.of(self, range(len(self.trapezoids))[k])

    @checked
    def slice(self, theta: Angle) -> Slice:
        """Return the contact segments at one orientation.

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
        self.require_complete()
        return Slice(self, theta)

    @checked
    def mesh(self, error: float, *, angle_scale: float | None = None, off_surface: bool = False) -> Mesh:
        """Return closed triangle meshes within a stated distance of the boundary.

        Parameters
        ----------
        error : float
            Greatest distance of a point of a triangle to the boundary, and of a point of the boundary to the triangles,
            in the scene's unit of length.
        angle_scale : float, optional
            Length per radian, w below; by default the robot's radius about its reference point.
        off_surface : bool
            Allow vertices within e-v faces to be a third of the error off the boundary: up to 3 % fewer triangles on
            large faces. Among round shapes it has no effect.

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
        Distances are measured by dx^2 + dy^2 + w^2 dtheta^2. The bound is proved in docs/theory/meshes.md for exact
        arithmetic; points are computed in doubles. It does not hold for trapezoids between angles less than 1e-9
        radians apart. Their triangles are within 1e-9 (2 r + w) of them, r the robot's radius, and they may reach
        beyond their triangles. Time is about linear in the triangles. Isolated parts have none. The bound holds among
        rounded shapes as well, whose meshes have more triangles than they need.

        Examples
        --------
        >>> triangles = Scene(robot=[(0, 0), (2, 0), (0, 1)], obstacles=[[(5, 5), (8, 5), (6, 7)]])
        >>> mesh = boundary(triangles).mesh(0.01)
        >>> mesh.error, mesh.angle_scale
        (0.01, 2.0)
        >>> len(mesh.vertices) - len(mesh.seam) - len(mesh.triangles) // 2   # V - E + F of a torus
        0
        """
        self.require_complete()
        return triangulated(self, self.complex, error, angle_scale, off_surface)


def regularize_by(threads: int, boundary: Boundary) -> None:
    """Compute `Boundary.regularized` with a number of threads, unless it is there."""
    boundary.require_complete()
    if "regularized" not in boundary.__dict__:
        boundary.regularized = _computed(boundary.scene, True, threads)
