"""Travel along a path, counting all points of the robot, not only its reference point: for pictures and films."""

from __future__ import annotations

from typing import TYPE_CHECKING

from cfree.libraries import ArrayLike, Floats, Ints, np

if TYPE_CHECKING:
    from cfree.paths.path import Path
    from cfree.scene.scene import Scene


GHOSTS, APART = 15, 0.6  # most poses of a path in a picture, and least distance of two in robot radii
SAME = 1e-9  # in robot radii: a picture shows less as no motion


class Travel:
    """Places on a path by the travel of the robot: in each motion the path length of its farthest moving point.

    Parameters
    ----------
    path : Path
    scene : Scene
        The scene of the robot that moves.

    Attributes
    ----------
    total : float
        Travel of the whole path.
    until : (motions + 1,) float64
        Travel before each motion, and at the end.

    Examples
    --------
    >>> from cfree import Path, Pose, Rotation, Scene, Translation
    >>> rod = Scene(robot=[(0, 0), (4, 0), (4, 1)])
    >>> path = Path(Pose(0, 0), [Translation((5, 0)), Rotation((9, 1), "90deg")])  # (4, 1) is the pole, then
    >>> travel = Travel(path, rod)
    >>> round(travel.total - 5, 6), round(float(np.hypot(4, 1) * np.pi / 2), 6)
    (6.476559, 6.476559)
    >>> travel.at([0.0, 2.5, travel.total]).round(6).tolist()
    [[0.0, 0.0, 0.0], [2.5, 0.0, 0.0], [10.0, -3.0, 1.570796]]
    """

    def __init__(self, path: Path, scene: Scene) -> None:
        robot = np.concatenate([part.vertices for part in scene.robot])
        self._motions, self._poses = path.motions, path.poses
        lengths = [motion.reach(pose, robot) for pose, motion in zip(path.poses, path.motions, strict=False)]
        turns = [motion.turn for motion in path.motions]
        self.until = np.cumsum([0.0, *lengths])
        self._theta = path.start.theta + np.cumsum([0.0, *turns])
        self.total = float(self.until[-1])

    def places(self, travel: ArrayLike) -> tuple[Ints, Floats]:
        """Return motions (n,), and the completed share of each (n,), after some travel; there must be motions."""
        s = np.asarray(travel, dtype=np.float64)
        motion = np.clip(np.searchsorted(self.until, s, side="right") - 1, 0, len(self._motions) - 1)
        length = np.diff(self.until)[motion]
        return motion, np.clip((s - self.until[motion]) / np.where(length > 0, length, 1.0), 0.0, 1.0)

    def at(self, travel: ArrayLike) -> Floats:
        """Return rows x, y, theta, (n, 3), after some travel (n,); theta continues from the start's, not wrapped."""
        s = np.asarray(travel, dtype=np.float64)
        rows = np.empty((len(s), 3))
        if not self._motions:
            rows[:] = float(self._poses[0].x), float(self._poses[0].y), self._poses[0].theta
            return rows
        motion, share = self.places(s)
        rows[:, 2] = self._theta[motion] + share * np.diff(self._theta)[motion]
        for k in np.unique(motion):
            chosen = motion == k
            rows[chosen, :2] = self._motions[k].sample(self._poses[k], share[chosen]).xy
        return rows


def ghosts(rows: Floats, scene: Scene) -> Ints:
    """Select rows x, y, theta of a path at which to draw the robot: at even steps, without turns in place.

    A turn is in place if the reference point or the centroid stays.
    """
    import shapely

    from cfree.scene.scene import robot_radius

    centroid = shapely.multipolygons([part.to_shapely() for part in scene.robot]).centroid
    x, y, theta = rows.T
    turned = np.exp(1j * theta) * complex(centroid.x, centroid.y)
    steps = np.abs(np.diff([x + 1j * y, x + 1j * y + turned], axis=1)).min(axis=0)
    radius = robot_radius(scene)
    until = np.concatenate(([0.0], np.cumsum(np.where(steps > SAME * radius, steps, 0.0))))
    count = int(min(GHOSTS, until[-1] / (APART * radius)))
    return np.searchsorted(until, np.linspace(0, until[-1], count + 2)[1:-1])
