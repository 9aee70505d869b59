"""Pictures of a vehicle that is stuck: its contacts, what it touches, and some of the poses that it reaches."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from numpy.typing import NDArray

from cfree.exact.pose import Pose
from cfree.palette import BARRIER, ROBOT, paler
from cfree.planning.stuck import Stuck
from cfree.plot.boundary import plain, set_window
from cfree.plot.gears import Wheels, draw_vehicle, far_apart
from cfree.plot.headed import headed, new_picture, window_of
from cfree.plot.labels import BODY, GHOST, Labels
from cfree.plot.looks import looks, of_polygons
from cfree.plot.workspace import draw_surroundings, path_of, rings_of
from cfree.scene.features import BOUNDS, WORKSPACE
from cfree.scene.naming import numbered
from cfree.scene.scene import Scene, robot_radius
from cfree.words import MOST_NAMES

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

Floats = NDArray[np.float64]

TOUCHING = 1e-7  # robot's radii: a picture shows less as a contact
NEAR = 0.1  # robot's radii: least distance of outlines along a rail
RING = 5.0  # typographic points: radius of the mark of a contact


def picture_of_stuck(answer: Stuck, scene: Scene) -> Figure:
    """Draw start and goal of a vehicle, its contacts where it is stuck, and some poses that it reaches along them."""
    scene = of_polygons(answer, scene)
    ends = {"start": answer.start, "goal": answer.goal}
    window, shown = window_of(scene, [*ends.values(), *answer.rail]), looks(answer, scene)
    figure, ax = new_picture(window, False)
    draw_surroundings(ax, shown)
    touched = [shown.obstacles[k] for k in answer.obstacles if k >= 0]
    style: Any = {"edgecolor": BARRIER, "linewidth": 1.6, "zorder": 2.5}
    ax.add_patch(PathPatch(path_of(rings_of(touched)), facecolor=paler(BARRIER, 0.7), label="touched", **style))
    wheels = Wheels.of(scene, answer.vehicle)
    rings = rings_of(shown.robot)
    chosen = far_apart(answer.rail, [*ends.values()], robot_radius(scene), NEAR)
    others = [path_of(answer.rail[k].apply(ring) for ring in rings) for k in chosen]
    ghosts = PathCollection(others, facecolors="none", edgecolors=ROBOT, linewidths=0.9, zorder=2.8, label="reached")
    ax.add_collection(ghosts, autolim=False)
    for name, pose in ends.items():
        draw_vehicle(ax, shown, pose, wheels, 0.0, faint=name == "goal")
    set_window(ax, window, scene.units)
    contacts = list(contacts_of(answer, scene, answer.pose))
    _draw_contacts(ax, [points for _, points in contacts])
    labels = Labels(ax, scene)
    labels.avoid_robot(scene, [answer.rail[k] for k in chosen], GHOST)
    labels.avoid_robot(scene, ends.values(), BODY)
    for name, pose in ends.items():
        labels.name_robot(scene, pose, f"{name}: stuck" if name == answer.at else name)
    for k in dict.fromkeys(k for k, _ in contacts[:MOST_NAMES]):
        anchors = [points.mean(axis=0) for other, points in contacts if other == k]
        labels.put(f"touches {plain(numbered(scene, k))}", anchors, ring=RING, color=BARRIER, fontsize=9)
    labels.name_bounds(scene)
    away = "leaves its start" if answer.at == "start" else "arrives at its goal"
    headed(figure, scene, f"stuck: no motion {away}", plain(answer.sentence()))
    return figure


def contacts_of(answer: Stuck, scene: Scene, pose: Pose) -> Iterator[tuple[int, Floats]]:
    """Yield obstacles that the robot touches in a pose, with the ends of each line of contact, or one point twice."""
    near = TOUCHING * robot_radius(scene)
    robot = shapely.multilinestrings([shapely.linearrings(pose.apply(ring)) for ring in rings_of(scene.robot)])
    around = shapely.buffer(robot, near)
    for k in answer.obstacles:
        if k == BOUNDS:
            yield k, np.array([[float(pose.x), float(pose.y)]] * 2)
            continue
        body = scene.workspace if k == WORKSPACE else scene.obstacles[k]
        assert body is not None
        for part in _lines(shapely.intersection(shapely.boundary(body.to_shapely()), around)):
            yield k, shapely.get_coordinates(part)[[0, -1]]


def _lines(touching: BaseGeometry) -> Sequence[BaseGeometry]:
    parts = shapely.line_merge(touching) if touching.geom_type == "MultiLineString" else touching
    return [part for part in shapely.get_parts(parts) if not part.is_empty]


def _draw_contacts(ax: Any, contacts: Sequence[Floats]) -> None:
    """Draw lines of contact, and a ring around each contact."""
    ax.add_collection(LineCollection(contacts, colors=BARRIER, linewidths=3.0, zorder=6, label="lines"), autolim=False)
    middles = np.reshape([points.mean(axis=0) for points in contacts], (-1, 2))
    style: Any = {"markersize": 2 * RING, "markerfacecolor": "none", "color": BARRIER, "markeredgewidth": 1.6}
    ax.plot(*middles.T, "o", zorder=6.1, label="contacts", **style)
