"""Figure 20: a slice of the arrangement of all contact surfaces, by the number of pairs that overlap."""

from __future__ import annotations

from matplotlib.axes import Axes

from cfree.arguments import checked
from cfree.arrangements.arranged import arrangement
from cfree.exact.pose import Pose
from cfree.figures.plane import label, set_plane, shape
from cfree.palette import OBSTACLE, ROBOT
from cfree.plot.depths import plot_depths
from cfree.scene.scene import Scene

THREE = Scene(
    robot=[("-0.9", "-0.5"), ("1", "-0.4"), ("-0.1", "0.8")],
    obstacles=[
        [(0, 0), (2, "-0.3"), ("1.5", "1.4")],
        [("2.2", "0.6"), ("3.6", "0.1"), ("3.9", "1.8"), ("2.7", "2.1")],
        [("1.1", "1.9"), ("2.5", "2.4"), ("1.4", "3.7")],
    ],
)
THETA = "40deg"


@checked
def depth_in_a_slice(ax: Axes) -> Axes:
    """Figure 20: cells of the arrangement at one orientation, darker where the robot overlaps more obstacles."""
    plot_depths(arrangement(THREE), THETA, ax)
    return ax


@checked
def three_obstacles(ax: Axes) -> Axes:
    """Figure 20: the three obstacles, and the robot at that orientation."""
    set_plane(ax, (-1.7, -1.2, 5.2, 5.0))
    for k, obstacle in enumerate(THREE.obstacles):
        shape(ax, obstacle.vertices, OBSTACLE)
        label(ax, obstacle.vertices.mean(axis=0), f"$O_{k + 1}$", colour=OBSTACLE, size=14)
    pose = Pose(0, "3.6", THETA)
    shape(ax, pose.apply(THREE.robot[0].vertices), ROBOT)
    label(ax, (float(pose.x), float(pose.y)), "$A$", colour=ROBOT, size=14)
    return ax
