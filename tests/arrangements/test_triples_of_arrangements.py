"""Vertices of an arrangement where three surfaces cross, and poses on three patches: found separately, the same."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from itertools import combinations, product

import pytest

import cfree
from cfree import Polygon
from cfree.arrangements import Intersection, arrangement, intersection, triple
from cfree.contact import contacts
from cfree.exact.orientation import Location
from cfree.rational import rational_surface

ROBOT = Polygon([(-1, "-0.6"), ("1.2", "-0.4"), ("-0.3", 1)])


def around(seed: int) -> tuple[Polygon, ...]:
    """Three triangles about a place that is too narrow for the robot to be free of all."""
    rng = random.Random(seed)
    found = []
    for k in range(3):
        turn, far = 2.1 * k + rng.uniform(-0.5, 0.5), rng.uniform(0.4, 1.2)
        corners = [(far, rng.uniform(-0.3, 0.3)), (far + 2, -1), (far + 2, 1)]
        c, s = math.cos(turn), math.sin(turn)
        found.append(Polygon([(f"{c * x - s * y:.3f}", f"{s * x + c * y:.3f}") for x, y in corners]))
    return tuple(found)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [2])
def test_triple_contacts_are_the_vertices_of_the_arrangement(seed: int) -> None:
    obstacles = around(seed)
    whole = arrangement(cfree.Scene(ROBOT, obstacles))
    crossings = whole.vertex_pose[whole.vertex_kind == 0].tolist()
    patches = [[rational_surface(ROBOT, O, contact) for contact in contacts(ROBOT, O)] for O in obstacles]
    # three patches have a pose in common only if two and two have one
    meet: dict[tuple[int, int, int, int], Intersection] = {}
    for k, m in combinations(range(3), 2):
        for i, j in product(range(len(patches[k])), range(len(patches[m]))):
            pair = intersection(patches[k][i], patches[m][j])
            if pair.ranges or any(line.t_range for line in pair.lines):
                meet[k, i, m, j] = pair
    found, on_lines = [], []
    for (_, i, _, j), n in product([key for key in meet if key[0] == 0 and key[2] == 1], range(len(patches[2]))):
        if (0, i, 2, n) in meet and (1, j, 2, n) in meet:
            pairs = [meet[key] for key in ((0, i, 1, j), (0, i, 2, n), (1, j, 2, n))]
            for pose in triple(patches[0][i], patches[1][j], patches[2][n]).contacts:
                assert pose.location is Location.INSIDE
                # the robot's edge at two corners: a segment ends there
                shared = any(pose.angle == line.angle for pair in pairs for line in pair.lines)
                (on_lines if shared else found).append((*pose.xy, pose.angle.theta))
    assert len(found) == len(crossings) > 0
    for one, other in ((found, crossings), (crossings, found), (on_lines, whole.vertex_pose.tolist())):
        for pose_of_one in one:
            assert min(apart(pose_of_one, vertex) for vertex in other) < 1e-12


def apart(p: Sequence[float], q: Sequence[float]) -> float:
    return math.hypot(p[0] - q[0], p[1] - q[1]) + abs(math.remainder(p[2] - q[2], math.tau))
