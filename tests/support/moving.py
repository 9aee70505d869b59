"""Motions and paths that several tests take, at random or through a T of corridors as wide as the robot."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import strategies as st

import strategies
from cfree import Path, Polygon, Pose, Rotation, Scene, Slide, Translation
from cfree.collision import Touch


def box(x0: object, y0: object, x1: object, y1: object) -> Polygon:
    return Polygon([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])  # type: ignore[list-item]


def pose_of(values: tuple[Fraction, Fraction, Fraction | None]) -> Pose:
    x, y, tau = values
    return Pose(x, y, {"tau": tau})


small = st.fractions(-6, 6, max_denominator=3)

points = st.tuples(small, small)

turns = st.one_of(
    st.sampled_from(["90deg", "-90deg", "180deg", "-180deg", "0deg"]), st.builds(lambda t: {"tau": t}, small)
)

motions = st.one_of(st.builds(Translation, points), st.builds(Rotation, points, turns))

poses = st.builds(pose_of, strategies.poses(6))

paths = st.builds(Path, poses, st.lists(motions, max_size=4))

UNIT_SQUARE = Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)])

SQUARE = [(-1, -1), (1, -1), (1, 1), (-1, 1)]

CORRIDORS = [(-9, 0), (9, 0), (9, 2), (1, 2), (1, 9), (-1, 9), (-1, 2), (-9, 2)]

TEE = Scene(SQUARE, workspace=CORRIDORS)

ON_FLOOR, ON_CORNER = Touch("vertex-edge", (0, 0), (-2, 1)), Touch("edge-vertex", (0, 2), (-2, 6))

CURVE = [0, 0, -2, 2], [0, 2, -2], [1, 0, 1]


def turning(tau: object = 1) -> Slide:
    """Slide from one corridor as wide as the square into the other: by up to a quarter turn."""
    return Slide((ON_FLOOR, ON_CORNER), *CURVE, tau)  # type: ignore[arg-type]


def way() -> Path:
    return Path(Pose(-5, 1), [Translation((5, 0)), turning("1/3"), turning(1).between("1/3", 1), Translation((0, 6))])
