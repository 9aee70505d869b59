"""Convex pieces with arcs: the verifier's distances, in balls and in doubles, against the planner's exact decisions."""

from __future__ import annotations

import random
from itertools import product

import pytest
from flint import arb

from arc_rings import random_arcs
from cfree import Pose
from cfree.collision.arcs import arcs_of
from cfree.scene.rounded import rounded_shapes
from cfree.verify.parity import chart_of
from cfree.verify.round_algebra import Turn, precision
from cfree.verify.round_slices import pillar_of
from cfree.verify.round_world import RoundWorld, is_apart


@pytest.mark.parametrize("seed", range(8))
def test_pieces_are_apart_just_where_the_robot_is_free(seed: int) -> None:
    scene, rng = random_arcs(seed), random.Random(seed)
    shapes, exact = rounded_shapes(scene), arcs_of(scene)
    assert shapes is not None and exact is not None
    world, met = RoundWorld(scene, shapes), set[bool]()
    ((robot, obstacles),) = world.layers
    with precision(128):
        for _ in range(25):
            pose = Pose(rng.uniform(-14, 14), rng.uniform(-14, 14), rng.uniform(0, 6.28))
            chart, tau = chart_of(pose)
            turn = Turn.of(chart, arb(tau.numerator) / arb(tau.denominator))
            place = arb(pose.x.numerator) / arb(pose.x.denominator), arb(pose.y.numerator) / arb(pose.y.denominator)
            at, turned = (complex(*(float(c.mid()) for c in pair)) for pair in (place, (turn.cos, turn.sin)))
            pairs = [*product(robot, obstacles)]
            rooms = [float(pillar_of(a, b, turned).room(_one(at))[0]) for a, b in pairs]
            if min(map(abs, rooms)) < 1e-9:
                continue
            apart = [is_apart(a, b, turn, place, arb(2) ** -60) for a, b in pairs]
            assert apart == [room > 0 for room in rooms]
            assert all(apart) == exact.is_free(pose)
            met.add(all(apart))
    assert met == {True, False}


def _one(place: complex):  # type: ignore[no-untyped-def]
    import numpy as np

    return np.array([place])


def test_a_pillar_is_as_far_away_as_points_on_its_rim() -> None:
    """The distance from a half disc to a point, in all directions."""
    import math

    from arc_rings import RINGS, shape
    from cfree import Curved, Scene

    scene = Scene(Curved.circle((0, 0), "1/2"), [shape(RINGS["half"])])
    shapes = rounded_shapes(scene)
    assert shapes is not None
    ((robot, obstacles),) = RoundWorld(scene, shapes).layers
    for k in range(24):
        u = complex(math.cos(k * math.pi / 12), math.sin(k * math.pi / 12))
        place = 9 * u
        least = min(float(pillar_of(a, b, 1).room(_one(place))[0]) for a, b in product(robot, obstacles))
        corner = min(abs(place - 5), abs(place + 5))
        flat = abs(place.imag) if abs(place.real) <= 5 else corner
        assert math.isclose(least, (4 if u.imag >= 0 else flat) - 0.5, abs_tol=1e-9)
