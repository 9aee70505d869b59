"""Travel of the robot's farthest moving point, and distances of its edges from others, against other computations."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from cfree.collision.distance import EdgeDistances
from cfree.collision.motion import Rotation, Translation
from cfree.exact.pose import Pose, Poses
from cfree.paths.path import Path
from cfree.paths.travel import Travel
from cfree.scene.scene import Scene
from moving import paths

ROBOT = [(0, 0), (3, 0), (3, 1), (1, 2)]


@pytest.mark.slow
@settings(max_examples=50, deadline=None)
@given(paths, st.floats(0, 1))
def test_rows_are_poses_of_the_path(path: Path, share: float) -> None:
    travel = Travel(path, Scene(robot=ROBOT))
    (row,) = travel.at([share * travel.total])
    if not path.motions:
        assert travel.total == 0 and row[2] == path.start.theta
        return
    (k,), (s,) = travel.places([share * travel.total])
    (pose,) = path.motions[k].sample(path.poses[k], [s])
    assert row[:2] == pytest.approx([float(pose.x), float(pose.y)], abs=1e-9)
    assert math.remainder(row[2] - pose.theta, math.tau) == pytest.approx(0, abs=1e-9)


@settings(max_examples=50, deadline=None)
@given(paths)
def test_theta_is_unrolled_and_no_vertex_outruns_the_travel(path: Path) -> None:
    scene = Scene(robot=ROBOT)
    travel = Travel(path, scene)
    steps = np.linspace(0, travel.total, 400)
    rows = travel.at(steps)
    assert np.abs(np.diff(rows[:, 2])).sum() <= path.turning + 1e-9
    assert rows[-1, 2] - rows[0, 2] == pytest.approx(sum(getattr(motion, "turn", 0.0) for motion in path.motions))
    at = Poses(rows[:, :2], rows[:, 2]).apply(scene.robot[0].vertices)
    moved = np.linalg.norm(np.diff(at, axis=0), axis=2).max(axis=1)
    assert (moved <= np.diff(steps) * (1 + 1e-6) + 1e-9).all()


def test_travel_is_the_way_of_the_farthest_vertex() -> None:
    path = Path(Pose(0, 0), [Rotation((1, 0), "180deg"), Translation((0, 7)), Rotation((5, 5), "-40deg")])
    travel = Travel(path, Scene(robot=ROBOT))
    longest = 0.0
    for k, motion in enumerate(path.motions):
        at = motion.sample(path.poses[k], np.linspace(0, 1, 4001)).apply(ROBOT)
        longest += float(np.linalg.norm(np.diff(at, axis=0), axis=2).sum(axis=0).max())
    assert travel.total == pytest.approx(longest, rel=1e-6)


def test_even_travel_is_even_within_a_motion() -> None:
    path = Path(Pose(0, 0), [Translation((4, 0)), Rotation((0, 0), "90deg"), Translation((0, 2))])
    travel = Travel(path, Scene(robot=ROBOT))
    motion, share = travel.places(np.linspace(0, travel.total, 301))
    for k in range(3):
        steps = np.diff(share[motion == k])
        assert steps == pytest.approx(steps[0], rel=1e-9)
    assert (np.diff(motion) >= 0).all()


def test_nearest_edges_are_those_of_shapely() -> None:
    random = np.random.default_rng(1)
    triangles = [random.normal(size=(3, 2)) * 2 + random.uniform(-20, 20, 2) for _ in range(12)]
    scene = Scene(robot=ROBOT, obstacles=[t for t in triangles if np.abs(t).min() > 0.1],
                  workspace=[(-40, -40), (40, -40), (40, 40), (-40, 40)])  # fmt: skip
    distances = EdgeDistances(scene)
    poses = Poses(random.uniform(-30, 30, (40, 2)), random.uniform(0, 6, 40))
    edges = poses.apply(distances.robot.reshape(-1, 2)).reshape(40, *distances.robot.shape)
    distance, edge, other = distances.nearest(edges)
    assert scene.workspace is not None
    bodies = [*scene.obstacles, scene.workspace]
    outlines = shapely.MultiLineString([shapely.boundary(body.to_shapely()) for body in bodies])
    for k, placed in enumerate(poses.apply(scene.robot[0].vertices)):
        assert distance[k] == pytest.approx(shapely.LinearRing(placed).distance(outlines), abs=1e-12)
        first, second = distances.between(edges[k, edge[k]], int(other[k]))
        assert math.dist(first, second) == pytest.approx(distance[k], abs=1e-9)
    names = {name for name, _ in distances.names}
    assert names == {*range(len(scene.obstacles)), -2}
