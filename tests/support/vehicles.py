"""Random rooms and vehicles, and paths integrated from their controls alone."""

from __future__ import annotations

import math
import random
from collections.abc import Iterable, Iterator
from fractions import Fraction
from typing import Any

import numpy as np
import shapely

from cfree import Car, DifferentialDrive, InvalidPolygonError, Path, PoseChecker, Rotation, Scene, Translation
from cfree.exact.pose import Pose

SIDE = 16  # of a room
ROBOTS: list[list[tuple[Any, Any]]] = [
    [("-1.5", "-0.6"), ("1.5", "-0.6"), ("1.5", "0.6"), ("-1.5", "0.6")],
    [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)],
    [("-0.5", "-1"), ("1/2", -1), (0, "3/2")],
]
VEHICLES: list[Car | DifferentialDrive] = [
    Car("5/2", axle=("-0.9", 0)),
    DifferentialDrive(axle=("-0.5", 0)),
    Car("1/2", axle=(0, 0), heading="90deg"),
    Car((4, 3), axle=("1.5", "0.2")),
    DifferentialDrive(axle=(0, 2), heading={"tau": "1/7"}),
    Car(6, axle=("-3", "1/3"), heading=math.pi),
]


FORWARD = [Car(car.radii, car.axle, {"tau": car.heading}, "forward") for car in VEHICLES if isinstance(car, Car)]


def room(rng: random.Random) -> Scene:
    """Random triangles to pentagons in a square room, with a start and a goal that are free."""
    while True:
        obstacles = []
        for _ in range(rng.randint(4, 20)):
            x, y, first, count = rng.uniform(0, SIDE), rng.uniform(0, SIDE), rng.uniform(0, 6.28), rng.randint(3, 5)
            radius, angles = rng.uniform(0.4, 2), (first + k * math.tau / count for k in range(count))
            obstacles.append([(round(x + radius * math.cos(a), 2), round(y + radius * math.sin(a), 2)) for a in angles])
        square = [(0, 0), (SIDE, 0), (SIDE, SIDE), (0, SIDE)]
        inside: dict[str, Any] = {"workspace": square} if rng.random() < 0.7 else {"bounds": (1, 1, SIDE - 1, SIDE - 1)}
        try:
            scene = Scene(rng.choice(ROBOTS), obstacles, **inside)
        except InvalidPolygonError:
            continue
        checker, free = PoseChecker(scene), list[Pose]()
        for _ in range(200):
            pose = round(rng.uniform(1, SIDE - 1), 3), round(rng.uniform(1, SIDE - 1), 3), rng.uniform(0, 6.28)
            if checker.is_free([pose], threads=1)[0]:
                free.append(Pose(*pose))
            if len(free) == 2:
                return Scene(scene.robot, obstacles, **inside, start=free[0], goal=free[1])


def integrated(path: Path, step: float = 0.05) -> Iterator[tuple[float, float, float]]:
    """Yield poses of the robot, by Runge and Kutta from the controls: gear, curvature, and length or angle.

    Nothing but `path.driving`, the start and the vehicle's frame is used.
    """
    vehicle = path.vehicle
    assert vehicle is not None
    frame, start = vehicle.frame, path.start
    fx, fy, heading = float(frame.x), float(frame.y), frame.theta
    c, s = math.cos(start.theta), math.sin(start.theta)
    state = np.array([float(start.x) + c * fx - s * fy, float(start.y) + s * fx + c * fy, start.theta + heading])

    def robot() -> tuple[float, float, float]:
        x, y, theta = state[0], state[1], state[2] - heading
        return (
            x - (math.cos(theta) * fx - math.sin(theta) * fy),
            y - (math.sin(theta) * fx + math.cos(theta) * fy),
            theta,
        )

    yield robot()
    for part in path.driving:
        in_place = part.gear == "turning"
        sign = -1 if part.gear == "backward" else 1
        speed, rate = (0.0, math.copysign(1, part.angle)) if in_place else (sign, sign * part.curvature)
        duration = abs(part.angle) if in_place else part.length
        count = max(1, math.ceil(duration * max(1.0, abs(rate)) / step))

        def slope(q: np.ndarray, speed: float = speed, rate: float = rate) -> np.ndarray:
            return np.array([speed * math.cos(q[2]), speed * math.sin(q[2]), rate])

        h = duration / count
        for _ in range(count):
            k1 = slope(state)
            k2 = slope(state + h / 2 * k1)
            k3 = slope(state + h / 2 * k2)
            state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + slope(state + h * k3))
            yield robot()


def faults(scene: Scene, path: Path, near: float = 1e-6) -> list[str]:
    """Faults of a path by integration and shapely: it misses the goal, overlaps something, or turns too sharply."""
    wrong = list[str]()
    assert path.vehicle is not None
    poses = list(integrated(path))
    x, y, theta = poses[-1]
    goal = path.goal
    off = max(abs(x - float(goal.x)), abs(y - float(goal.y)), abs(math.remainder(theta - goal.theta, math.tau)))
    if off > near:
        wrong.append(f"it ends {off:.3g} from the goal")
    if path.vehicle.kind == "car":
        left, right = map(float, path.vehicle.radii)
        for part in path.driving:
            if part.gear == "turning":
                wrong.append("a car turns in place")
            elif part.curvature > 1 / left * (1 + 1e-12) or -part.curvature > 1 / right * (1 + 1e-12):
                wrong.append(f"curvature {part.curvature}")
            if path.vehicle.gears == "forward" and part.gear != "forward":
                wrong.append(f"gear {part.gear}")
    obstacles = [obstacle.to_shapely() for obstacle in scene.obstacles]
    if scene.workspace is not None:
        outside = scene.workspace.to_shapely()
        x0, y0, x1, y1 = outside.bounds
        obstacles.append(shapely.box(x0 - 50, y0 - 50, x1 + 50, y1 + 50).difference(outside))
    tree = shapely.STRtree(obstacles)
    robot = shapely.union_all([part.to_shapely() for part in scene.robot])
    points = shapely.get_coordinates(robot)
    table = np.array(poses)
    c, s = np.cos(table[:, 2]), np.sin(table[:, 2])
    moved = np.stack(
        [
            table[:, :1] + c[:, None] * points[:, 0] - s[:, None] * points[:, 1],
            table[:, 1:2] + s[:, None] * points[:, 0] + c[:, None] * points[:, 1],
        ],
        axis=2,
    )
    bodies = shapely.polygons([shapely.linearrings(ring) for ring in moved])
    these, those = tree.query(bodies, predicate="intersects")
    for k, j in zip(these.tolist(), those.tolist(), strict=True):
        if bodies[k].intersection(obstacles[j]).area > near:
            wrong.append(f"it overlaps obstacle {j} at {poses[k]}")
            break
    if scene.bounds is not None:
        x0, y0, x1, y1 = map(float, scene.bounds)
        if not ((x0 - near <= table[:, 0]) & (table[:, 0] <= x1 + near)).all():
            wrong.append("it leaves the bounds")
        if not ((y0 - near <= table[:, 1]) & (table[:, 1] <= y1 + near)).all():
            wrong.append("it leaves the bounds")
    return wrong


def drive(vehicle: Car | DifferentialDrive, start: Pose, parts: Iterable[tuple[str, Any, Any]], scene: Scene) -> Path:
    """Return a path of parts: ("line", length, 0), ("arc", radius, tau) or ("turn", 0, tau), tau of half the angle."""
    motions, robot = list[Translation | Rotation](), start
    for kind, size, tau in parts:
        axle = robot @ vehicle.frame
        c, s = axle.cos, axle.sin
        if kind == "line":
            motion: Translation | Rotation = Translation((c * Fraction(size), s * Fraction(size)))
        else:
            motion = Rotation((axle.x - s * Fraction(size), axle.y + c * Fraction(size)), {"tau": str(tau)})
        motions.append(motion)
        robot = motion.apply(robot)
    return Path(start, motions, scene=scene, vehicle=vehicle)
