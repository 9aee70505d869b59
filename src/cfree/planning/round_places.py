"""Free places among round shapes: polygons decide, or a pose that is free among segments and arcs themselves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from fractions import Fraction

from cfree.collision.approximations import Approximations
from cfree.collision.arcs import ArcScene, arcs_of
from cfree.errors import UndecidedError
from cfree.exact.angle_interval import AngleInterval
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose, pose_at
from cfree.free.turn_in_place import free_orientations
from cfree.libraries import np
from cfree.planning.contact_fits import Fits
from cfree.planning.goals import pose_in
from cfree.planning.narrow_fits import NEAR
from cfree.scene.scene import Scene

STRAIGHT = Fraction(0), Fraction(1), None, Fraction(-1)  # half-angle tangents of quarter turns
SHARES = (0.02, 0.25, 0.5, 0.75, 0.98)  # of an interval of orientations, at which shapes that overlap are looked up


def is_free_place(scene: Scene, place: ExactPoint, tolerance: float | None = None) -> bool | None:
    """Decide whether some orientation at a place is free, among round shapes.

    Parameters
    ----------
    scene : Scene
    place : pair of Fraction
    tolerance : float, optional
        The least error of polygons, as in `cfree.plan`.

    Returns
    -------
    bool or None
        None if polygons within the tolerance decide neither way.
    """
    near, arcs = Approximations(scene, tolerance), arcs_of(scene)
    while True:
        within = _intervals(near, place, outward=False)
        if within == ():
            return False
        if _intervals(near, place, outward=True) or (arcs and _has_pose(scene, arcs, near, within or (), place)):
            return True
        if not near.refine(np.array([(*map(float, place), theta) for theta in _samples(within or ())])):
            return None


def _intervals(near: Approximations, place: ExactPoint, *, outward: bool) -> tuple[AngleInterval, ...] | None:
    """Return the free orientations among polygons; None if there are no such polygons."""
    with suppress(UndecidedError):
        return tuple(free_orientations(near.scene(outward=outward), place))
    return None


def _has_pose(
    scene: Scene, arcs: ArcScene, near: Approximations, intervals: Sequence[AngleInterval], place: ExactPoint
) -> bool:
    """True if an orientation of these intervals is free, or one parallel to something near."""
    origin, fits, (x, y) = Pose(0, 0), Fits(scene), map(float, place)
    poses = [pose for interval in intervals if (pose := pose_in(interval, origin, place))]
    error = NEAR * max(near.errors)
    taus = [*STRAIGHT, *(tau for pose in poses for tau in fits.angles(x, y, pose.theta, error))]
    return any(map(arcs.is_free, dict.fromkeys([*poses, *(pose_at(*place, tau) for tau in taus)])))


def _samples(intervals: Sequence[AngleInterval]) -> Iterator[float]:
    for first, last in (interval.theta for interval in intervals):
        yield from (first + share * (last - first) for share in SHARES)
