"""Collision checks of poses, one or millions, each decided exactly.

The core compares convex pieces in doubles with a proven error bound, and marks the poses that this leaves uncertain:
those in contact, or within about 1e-13 of the size of the scene. These are decided in integers, one by one. A single
pose is passed to the core unchanged.
"""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from fractions import Fraction
from typing import Any, overload

import cfree._core as _core
from cfree.arguments import checked
from cfree.collector import collection_paused
from cfree.collision.arcs import ArcScene, arcs_of
from cfree.errors import InvalidPoseError, UndecidedError
from cfree.exact.pose import OnePose, Pose, PoseLike, Poses, for_core, is_plain, one_pose, to_pose
from cfree.libraries import ArrayLike, Floats, NDArray, is_array, np
from cfree.scene.features import SceneFeatures, scene_features
from cfree.scene.scene import Scene, robot_radius
from cfree.value import Value, kept

FORBIDDEN, FREE, UNCERTAIN = 0, 1, 2  # the core's verdicts
BLOCK = 1 << 22  # poses between two checks for Ctrl-C
FARTHEST = 1e300  # coordinates beyond are as far as this
ROUNDING, DEEPEST = 2.0**-44, 20  # of sums of a few doubles; halvings of a sweep

Limits = tuple[Fraction | float, Fraction | float, Fraction | float, Fraction | float]


@overload
def is_free(
    scene: Scene | PoseChecker, poses: OnePose, *, threads: int | None = None, tolerance: float | None = None
) -> bool: ...
@overload
def is_free(
    scene: Scene | PoseChecker,
    poses: Poses | Sequence[PoseLike] | ArrayLike,
    *,
    threads: int | None = None,
    tolerance: float | None = None,
) -> NDArray[np.bool_]: ...
def is_free(
    scene: Scene | PoseChecker,
    poses: OnePose | Poses | Sequence[PoseLike] | ArrayLike,
    *,
    threads: int | None = None,
    tolerance: float | None = None,
) -> bool | NDArray[np.bool_]:
    """True if a pose is free, decided exactly. Touching is free, because the forbidden space is open.

    Parameters
    ----------
    scene : Scene or PoseChecker
        Either caches its preparation.
    poses : Pose or (x, y, theta), Poses, sequence of the former, or (n, 3) float64
        Columns x, y, theta in radians. Row k means the exact pose ``Poses(...)[k]``: the doubles x and y are taken
        exactly, theta is replaced by the rational half-angle tangent that `Pose` takes for it.
    threads : int, optional
        All cores by default. The result does not depend on it.
    tolerance : float, optional
        As in `plan`; for scenes with round shapes only. Segments and circular arcs are decided without it.

    Returns
    -------
    bool, or (n,) bool
        One for each pose. In a scene with ellipses, Bézier curves or splines (n,) object: None where polygons within
        the tolerance do not decide, because the shapes touch or nearly touch.

    Raises
    ------
    InvalidPoseError
        If poses are not finite, or have another shape.

    Notes
    -----
    A pose is free if no interior of a convex piece of the robot meets one of the obstacles' pieces (or the
    complement of the workspace), and the reference point is in the bounds. Shapes of segments and circular arcs are
    not approximated: their boundaries are cut where they meet, exactly. A scene is prepared once, in time about
    linear in the vertices, and caches the result. A pose takes time in the number of pieces near by: a single one, in
    doubles or as a `Pose`, about a microsecond. A pose in contact or nearly so takes a few more.

    Examples
    --------
    >>> from cfree.curves.curved import Curved
    >>> from cfree.scene.scene import Scene
    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> scene = Scene(robot=square, obstacles=square, bounds=(-2, -2, 2, 2))
    >>> is_free(scene, Pose(1, 0)), is_free(scene, Pose("0.999", 0)), is_free(scene, Pose(3, 0))
    (True, False, False)
    >>> is_free(scene, [[1, 0, 0], [1, 1, math.pi / 2], [1, 1, math.pi]])
    array([ True,  True, False])
    >>> disc = Scene(Curved.circle((0, 0), 1), [Curved.circle((3, 0), 2)])
    >>> is_free(disc, Pose(0, 0)), is_free(disc, Pose("1e-30", 0))
    (True, False)
    """
    if tolerance is None and is_plain(poses) and _is_count(threads):
        if type(scene) is PoseChecker:
            return scene.is_free(poses, threads=threads)
        if isinstance(scene, Scene) and not scene.curved:
            free = _of_one(kept(scene, _prepared)[0], poses)
            if free is not None:
                return free
        elif isinstance(scene, Scene) and type(poses) is Pose and (arcs := arcs_of(scene)) is not None:
            return arcs.is_free(poses)
    return _is_free(scene, poses, threads=threads, tolerance=tolerance)


@checked
def _is_free(
    scene: Scene | PoseChecker,
    poses: OnePose | Poses | Sequence[PoseLike] | ArrayLike,
    *,
    threads: int | None,
    tolerance: float | None,
) -> bool | NDArray[np.bool_]:
    if isinstance(scene, Scene) and scene.curved:
        if tolerance is not None and not 0 < tolerance < math.inf:
            raise ValueError(f"tolerance {tolerance}: give a length above 0")
        arcs = arcs_of(scene)
        if arcs is not None:
            return _among_arcs(arcs, poses, threads)
        free: NDArray[np.bool_] = _among_curves(scene, poses, threads, tolerance)
        return free
    if tolerance is not None:
        raise ValueError(f"tolerance {tolerance}: of scenes with round shapes; leave it out")
    checker = scene if isinstance(scene, PoseChecker) else PoseChecker(scene)
    return checker.is_free(poses, threads=threads)


def _is_count(threads: int | None) -> bool:
    """True if the number of threads is valid; one pose needs only the current thread."""
    return threads is None or (type(threads) is int and threads > 0)


def _of_one(core: _core.PoseChecker, poses: Any) -> bool | NDArray[np.bool_] | None:
    """Return the verdict for one `Pose`, for one in doubles, or for a table of one row; None for anything else."""
    free: Any = core.is_free(for_core(poses))
    return np.array(free) if type(free) is list else free


def _among_arcs(arcs: ArcScene, poses: Any, threads: int | None) -> bool | NDArray[np.bool_]:
    if threads is not None and threads < 1:
        raise ValueError(f"threads: {threads}; give at least 1")
    if (pose := one_pose(poses, "poses")) is not None:
        return arcs.is_free(pose)
    table = rows_of(poses)
    if isinstance(table, list):
        return np.array([arcs.is_free(pose) for pose in table], bool)
    return arcs.are_free(table, threads)


def _among_curves(scene: Scene, poses: Any, threads: int | None, tolerance: float | None) -> Any:
    """Return True where a pose is free among outer polygons, False where it is forbidden by inner ones, else None."""
    from cfree.collision.approximations import Approximations

    near = Approximations(scene, tolerance)
    pose = one_pose(poses, "poses")
    rows: Any = [pose] if pose is not None else poses
    if isinstance(rows, list | tuple) and not _is_table(rows):
        rows = [to_pose(row, f"poses[{k}]") for k, row in enumerate(rows)]
        table = np.array([[float(row.x), float(row.y), row.theta] for row in rows])
    else:
        rows = table = _table(rows)
    verdicts, unknown = np.full(len(rows), None, dtype=object), np.arange(len(rows))
    while len(unknown):
        for outward in (True, False):
            undecided = [rows[k] for k in unknown] if isinstance(rows, list) else rows[unknown]
            try:
                checker = PoseChecker(near.scene(outward=outward))
            except UndecidedError:  # no polygons, so no verdict
                continue
            free = checker.is_free(undecided, threads=threads)
            verdicts[unknown[free == outward]] = outward
            unknown = unknown[free != outward]
            if not len(unknown):
                break
        else:
            if not near.refine(table[unknown]):
                break
    return verdicts[0] if pose is not None else verdicts


@checked
class PoseChecker(Value):
    """A scene prepared for many calls of `is_free`.

    Parameters
    ----------
    scene : Scene
        Polygons, and shapes of segments and circular arcs.

    Raises
    ------
    UnsupportedError
        If a shape has other curves.

    Examples
    --------
    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> checker = PoseChecker(Scene(robot=square, obstacles=square))
    >>> [checker.is_free(Pose(x, 0, "45deg")) for x in (1, 2)]
    [False, True]
    """

    _arcs: ArcScene | None = None

    def __init__(self, scene: Scene, features: SceneFeatures | None = None) -> None:
        self.scene = scene
        self._arcs = arcs_of(scene) if scene.curved else None
        if self._arcs is None:
            self._handle, self.limits = kept(scene, _prepared) if features is None else _prepared_with(scene, features)

    @property
    def _content(self) -> tuple[Scene]:
        return (self.scene,)

    @overload
    def is_free(self, poses: OnePose, *, threads: int | None = None) -> bool: ...
    @overload
    def is_free(
        self, poses: Poses | Sequence[PoseLike] | ArrayLike, *, threads: int | None = None
    ) -> NDArray[np.bool_]: ...
    def is_free(
        self, poses: OnePose | Poses | Sequence[PoseLike] | ArrayLike, *, threads: int | None = None
    ) -> bool | NDArray[np.bool_]:
        """See `cfree.is_free`."""
        if self._arcs is None and is_plain(poses) and _is_count(threads):
            free = _of_one(self._handle, poses)
            if free is not None:
                return free
        return self._is_free(poses, threads=threads)

    @checked
    def _is_free(
        self, poses: OnePose | Poses | Sequence[PoseLike] | ArrayLike, *, threads: int | None
    ) -> bool | NDArray[np.bool_]:
        if threads is not None and threads < 1:
            raise ValueError(f"threads: {threads}; give at least 1")
        if (pose := one_pose(poses, "poses")) is not None:
            return is_free_at(self, pose)
        table = rows_of(poses)
        if isinstance(table, list):
            return np.array([is_free_at(self, pose) for pose in table], bool)
        return are_free(self, table, threads)

    @checked
    def verdicts(self, table: Floats, threads: int | None = None) -> NDArray[np.uint8]:
        """Return FORBIDDEN or FREE where doubles are certain, else UNCERTAIN; rows x, y and theta in [0, 2 pi)."""
        return _verdicts(self, table, threads)

    @checked
    def sweep_is_free(self, start: ArrayLike, by: ArrayLike) -> bool:
        """True if all poses are certainly free while x, y and theta change evenly; False may mean too close to decide.

        Parameters
        ----------
        start : (x, y, theta)
            In radians.
        by : (dx, dy, dtheta)
            The whole change.

        Notes
        -----
        If position and angle both change, this is neither a translation nor a rotation about a pole. The motion is
        halved until the robot, grown by as much as it moves in a part, keeps its distance. Contact never counts as
        free.

        Examples
        --------
        >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
        >>> checker = PoseChecker(Scene(robot=square, obstacles=[(3, 0), (4, 0), (4, 3)]))
        >>> checker.sweep_is_free((0, 0, 0), (1.5, 0, 0.5)), checker.sweep_is_free((0, 0, 0), (9, 0, 0.5))
        (True, False)
        """
        first, change = (np.asarray(each, float).tolist() for each in (start, by))
        if self._arcs is not None:
            return _is_sweep_free(self.scene, self._arcs, first, change)
        return self._handle.sweep_is_free(first, change)


def is_free_at(checker: PoseChecker, pose: Pose) -> bool:
    """True if a pose is free, decided exactly; it is not checked."""
    if checker._arcs is not None:
        return checker._arcs.is_free(pose)
    free: Any = checker._handle.is_free(pose)
    if free is None:  # on a limit, or nearly so
        x0, y0, x1, y1 = checker.limits
        is_within = x0 <= pose.x <= x1 and y0 <= pose.y <= y1
        free = is_within and checker._handle.is_free(pose, is_within)
    return bool(free)


def are_free(checker: PoseChecker, table: Floats, threads: int | None = None) -> NDArray[np.bool_]:
    """True for each free pose, decided exactly: rows x, y and theta in [0, 2 pi), which are not checked."""
    if checker._arcs is not None:
        return checker._arcs.are_free(table, threads)
    verdicts = _verdicts(checker, table, threads)
    for k in np.flatnonzero(verdicts == UNCERTAIN).tolist():
        verdicts[k] = FREE if checker._handle.is_free(table[k].tolist()) else FORBIDDEN
    free: NDArray[np.bool_] = verdicts == FREE
    return free


def _verdicts(checker: PoseChecker, table: Floats, threads: int | None) -> NDArray[np.uint8]:
    verdicts = np.empty(len(table), np.uint8)
    core = checker._handle if checker._arcs is None else checker._arcs.poses
    for k in range(0, len(table), BLOCK):
        rows = slice(k, k + BLOCK)
        core.check(table[rows], threads or os.cpu_count() or 1, verdicts[rows])
    return verdicts


def _is_sweep_free(scene: Scene, arcs: ArcScene, start: list[float], by: list[float]) -> bool:
    """See `PoseChecker.sweep_is_free`; distances are those of segments and arcs."""
    x0, y0, x1, y1 = scene.bounds or (-math.inf, -math.inf, math.inf, math.inf)
    if not all(x0 <= start[0] + u * by[0] <= x1 and y0 <= start[1] + u * by[1] <= y1 for u in (0, 1)):
        return False
    if not arcs.is_free(Pose(*start)):
        return False
    radius = robot_radius(scene)
    moved = (math.hypot(*by[:2]) + radius * abs(by[2])) * (1 + ROUNDING)
    slack = ROUNDING * (math.hypot(*start[:2]) + moved + radius * (1 + abs(start[2])))
    parts = [(0.5, 1)]  # middle, and how often halved
    while parts:
        middle, depth = parts.pop()
        half = math.ldexp(1, -depth)
        reach = half * moved + slack
        low, high = arcs.distance(Pose(*(c + middle * d for c, d in zip(start, by, strict=True))), 2 * reach)
        if low > reach:
            continue
        if high <= slack or depth == DEEPEST:
            return False
        parts += [(middle - half / 2, depth + 1), (middle + half / 2, depth + 1)]
    return True


def _prepared(scene: Scene) -> tuple[_core.PoseChecker, Limits]:
    return _prepared_with(scene, scene_features(scene))


def _prepared_with(scene: Scene, features: SceneFeatures) -> tuple[_core.PoseChecker, Limits]:
    with collection_paused():
        x0, y0, x1, y1 = limits = limits_of(scene)
        doubles = [_least_double(x0), _least_double(y0), -_least_double(-x1), -_least_double(-y1)]
        return _core.PoseChecker(features.core, doubles), limits


def clamped(x: Fraction) -> float:
    """The nearest double; what is beyond `FARTHEST` is as far as that."""
    try:
        return max(-FARTHEST, min(FARTHEST, float(x)))
    except OverflowError:
        return FARTHEST if x > 0 else -FARTHEST


def rows_of(poses: Any) -> Floats | list[Pose]:
    """Rows x, y and theta if these are plain numbers; else exact poses."""
    if isinstance(poses, list | tuple) and not _is_table(poses):
        return [to_pose(pose, f"poses[{k}]") for k, pose in enumerate(poses)]
    return _table(poses)


def _is_table(rows: Sequence[Any]) -> bool:
    """True if these are rows of plain numbers, which are poses in double precision."""
    return all(
        (isinstance(row, Sequence) or is_array(row)) and all(isinstance(c, int | float) for c in row) for row in rows
    )


def _table(poses: Any) -> Floats:
    """Return rows x, y, theta of finite numbers, theta in [0, 2 pi)."""
    if isinstance(poses, Poses):
        return np.column_stack([poses.xy, poses.theta])
    table = np.ascontiguousarray(poses, dtype=np.float64)
    if table.ndim != 2 or table.shape[1] != 3:
        raise InvalidPoseError(f"poses have the shape {table.shape}; give (n, 3): x, y, theta")
    theta = table[:, 2]
    if np.isfinite(table).all() and theta.min(initial=0) >= 0 and theta.max(initial=0) < math.tau:
        return table
    return _table(Poses(table[:, :2], theta))


def limits_of(scene: Scene) -> Limits:
    """Return limits of the reference point: the bounds, and the workspace's box widened by the robot's reach.

    The core has only a frame around the workspace, twice as thick as the robot's reach.
    """
    x0, y0, x1, y1 = scene.bounds or (-math.inf, -math.inf, math.inf, math.inf)
    if scene.workspace is None:
        return x0, y0, x1, y1
    reach = max(abs(x) + abs(y) for part in scene.robot for x, y in part.exact_vertices)
    xs, ys = zip(*scene.workspace.exact_vertices, strict=True)
    return max(x0, min(xs) - reach), max(y0, min(ys) - reach), min(x1, max(xs) + reach), min(y1, max(ys) + reach)


def _least_double(value: Fraction | float) -> float:
    """Return the least double that is not below a number."""
    double = float(value)
    return double if double >= value else math.nextafter(double, math.inf)
