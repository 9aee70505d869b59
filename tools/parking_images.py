"""Make the pictures of vehicles in README.md and docs: `python tools/parking_images.py`, with the extra `test`."""

from fractions import Fraction
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from PIL import Image

import cfree
from cfree.film.path_film import PathStage
from cfree.palette import BARRIER, GHOST, INK, ROBOT, paler
from cfree.paths.travel import Travel
from cfree.plot.boundary import new_figure
from cfree.plot.gears import Gears, Wheels, draw_axle_track, draw_stands, draw_vehicle, gear_handles
from cfree.plot.path import Track
from cfree.plot.workspace import draw_robot, draw_surroundings, path_of, rings_of, rings_of_geometry

ROOT = Path(__file__).parents[1]
SCENE, FOLDER = ROOT / "examples" / "scenes" / "parking_bay.json", ROOT / "docs" / "images"
LARGER = Fraction("1.14")
WINDOW = (-8.3, -0.3, 7.9, 9.5)
SHARE = 0.75  # of the path at which the film's frame is
TOUCHING = 0.03  # metres


def scaled(scene: cfree.Scene, factor: Fraction) -> cfree.Scene:
    """Return the scene with a larger robot."""
    robot = [[(factor * x, factor * y) for x, y in part.exact_vertices] for part in scene.robot]
    its = scene.vehicle
    car = cfree.Car(its.radii, [factor * x for x in its.axle], wheelbase=factor * its.wheelbase)
    ends = {"start": scene.start, "goal": scene.goal}
    return cfree.Scene(robot, scene.obstacles, workspace=scene.workspace, vehicle=car, **ends)


def reached(scene: cfree.Scene, pose: cfree.Pose) -> tuple[Any, list[cfree.Pose]]:
    """Return the region that the robot covers in all poses of a cell, and its two most turned poses."""
    boundary = cfree.boundary(scene)
    space = cfree.free_space(boundary)
    (cell,) = space.locate(cfree.Poses.from_poses([pose])).tolist()
    box, covered, poses = shapely.box(*WINDOW), [], []
    for theta in pose.theta + np.radians(np.arange(-60, 60, 0.1)):
        free = shapely.difference(box, boundary.slice(float(theta)).forbidden)
        for part in (part for part in shapely.get_parts(free) if part.area > 0):
            x, y = part.representative_point().coords[0]
            if space.locate(cfree.Poses([(x, y)], [theta])).tolist() == [cell]:
                places = shapely.get_coordinates(part.segmentize(0.1))
                poses.append(cfree.Pose(x, y, float(theta)))
                rows = cfree.Poses(places, np.full(len(places), theta))
                covered += [shapely.Polygon(ring) for ring in rows.apply(scene.robot[0].vertices)]
    return shapely.union_all(covered), [poses[0], poses[-1]]


def panel(figure: Figure, place: tuple[float, float, float, float], scene: cfree.Scene) -> Any:
    """Add axes without numbers that show the obstacles."""
    ax: Any = figure.add_axes(place)
    draw_surroundings(ax, scene)
    (x0, y0, x1, y1) = WINDOW
    ax.set(xlim=(x0, x1), ylim=(y0, y1), aspect="equal", xticks=[], yticks=[])
    for side in ax.spines.values():
        side.set_visible(False)
    return ax


def contacts(scene: cfree.Scene, pose: cfree.Pose) -> np.ndarray[Any, Any]:
    """Return the points (n, 2) at which the robot almost touches obstacles and workspace."""
    robot = shapely.Polygon(pose.apply(scene.robot[0].vertices))
    bodies = [body.to_shapely().exterior for body in (*scene.obstacles, scene.workspace) if body is not None]
    near = [shapely.shortest_line(robot, body) for body in bodies if robot.distance(body) < TOUCHING]
    return np.array([line.coords[1] for line in near])


def hero(scene: cfree.Scene, path: cfree.Path) -> Figure:
    """Return the car that parks, beside the car that cannot."""
    assert cfree.max_scale(scene).hi <= LARGER
    larger = scaled(scene, LARGER)
    proof = cfree.plan(larger)
    assert isinstance(proof, cfree.Separated)
    assert proof.of == "closed"
    figure = new_figure((12, 4.5))
    left = panel(figure, (0.005, 0.085, 0.485, 0.8), scene)
    gears = Gears.of(path, scene, Travel(path, scene))
    assert gears is not None
    draw_stands(left, scene, gears)
    draw_vehicle(left, scene, path.start, gears.wheels, gears.curvature("start"), faint=False)
    draw_vehicle(left, scene, path.goal, gears.wheels, 0.0, faint=True)
    draw_axle_track(left, gears)
    right = panel(figure, (0.51, 0.085, 0.485, 0.8), larger)
    region, turned = reached(larger, proof.goal)
    right.add_patch(PathPatch(path_of(rings_of_geometry(region)), facecolor=paler(GHOST, 0.55), linewidth=0, zorder=1))
    wall = path_of(rings_of([scene.obstacles[k] for k in proof.obstacles if k >= 0]))
    right.add_patch(PathPatch(wall, facecolor=paler(BARRIER, 0.7), edgecolor=BARRIER, linewidth=1.8, zorder=2.5))
    wheels = Wheels.of(larger, larger.vehicle)
    draw_vehicle(right, larger, proof.start, wheels, 0.0, faint=False)
    draw_robot(right, larger, proof.goal, faint=True, mark=False)
    for pose in turned:
        shape = path_of(pose.apply(ring) for ring in rings_of(larger.robot))
        right.add_patch(PathPatch(shape, fill=False, edgecolor=ROBOT, linewidth=1.4, zorder=3.1))
        right.plot(*contacts(larger, pose).T, "o", markersize=9, color="none", mec=BARRIER, mew=1.8, zorder=6)
    text: Any = {"ha": "center", "va": "center", "color": INK}
    share = f"{float(100 * (LARGER - 1)):g} %"
    figure.text(0.2475, 0.945, f"A car parks: {path.cusps} changes of direction", fontsize=15, weight="bold", **text)
    figure.text(0.7525, 0.945, f"The same car, {share} larger: proved impossible", fontsize=15, weight="bold", **text)
    figure.legend(
        handles=gear_handles(gears), loc="center", bbox_to_anchor=(0.2475, 0.045), ncols=3, frameon=False, fontsize=12.5
    )
    below = "It fits the lane, and the bay. Light: all that it reaches from there."
    figure.text(0.7525, 0.045, below, fontsize=12.5, **text)
    return figure


def held() -> cfree.Stuck:
    """Return the proof that a car between two boxes cannot drive off."""
    boxes = [[(2, -1), (3, -1), (3, 1), (2, 1)], [(-3, -1), (-2, -1), (-2, 1), (-3, 1)]]
    car = [(-2, -1), (2, -1), (2, 1), (-2, 1)]
    proof = cfree.plan(
        cfree.Scene(car, boxes, start=(0, 0, 0), goal=(0, "3.5", 0), units="m", vehicle=cfree.Car(4, axle=(-1, 0)))
    )
    assert isinstance(proof, cfree.Stuck)
    return proof


def drawn(figure: Any) -> Image.Image:
    """Return the picture of a figure."""
    data = BytesIO()
    figure.savefig(data, dpi=250)
    return Image.open(data)


def save(image: Image.Image, file: str, width: int) -> None:
    """Write a picture of this width with few colours."""
    size = width, round(image.height * width / image.width)
    small = image.convert("RGB").resize(size, Image.Resampling.LANCZOS)
    small.quantize(200, kmeans=2, dither=Image.Dither.NONE).save(FOLDER / file, optimize=True)


def frame(scene: cfree.Scene, path: cfree.Path) -> Image.Image:
    """Return a frame of the film of a path."""
    track = Track.of(path, scene)
    stage = PathStage(track, cfree.boundary(scene), (1280, 720))
    return Image.fromarray(stage.draw(SHARE * track.travel.total, SHARE))


if __name__ == "__main__":
    scene = cfree.load_scene(SCENE)
    path = cfree.plan(scene)
    assert isinstance(path, cfree.Path)
    save(drawn(hero(scene, path)), "parking-bay.png", 1600)
    save(drawn(cfree.plot.plot_path(path, scene).figure), "vehicle.png", 1100)
    save(drawn(held().plot()), "stuck.png", 900)
    save(frame(scene, path), "film-vehicle.png", 1280)
