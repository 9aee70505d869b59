"""First contacts among round shapes name the features that come together."""

from __future__ import annotations

import random
from fractions import Fraction
from typing import Any

import pytest

import cfree
from cfree import Curved, Pose, Scene
from cfree.collision.motion import Rotation, Translation
from cfree.contact import ArcArc, ArcEdge, EdgeArc, VertexEdge
from cfree.curves import Arc, Circle
from fuzz_arcs import motion_of, point

STADIUM = Curved([(-1, -1), (1, -1), Arc((1, 1), center=(1, 0)), (-1, 1), Arc((-1, -1), center=(-1, 0))])
DISC = Curved.circle((0, 0), 1)
SLAB = [(-9, -5), (9, -5), (9, -3), (-9, -3)]
BAY = Curved([(-2, -2), (2, -2), (2, 0), (1, 0), Arc((-1, 0), center=(0, 0), clockwise=True), (-2, 0)])

ENTERED: dict[str, tuple[Any, Any, Any, Any]] = {
    "disc on disc": (Scene(DISC, [Curved.circle((5, 1), 2)]), (0, 0), Translation((9, 0)), ArcArc(0, 0)),
    "disc on edge": (Scene(DISC, [SLAB, DISC]), (4, 0), Translation((0, -9)), ArcEdge(0, 2)),
    "disc on vertex": (Scene(DISC, [[(0, 0), (4, 0), (4, 4)]]), (-5, 0), Translation((9, 0)), ArcArc(0, 0)),
    "edge on disc": (Scene([(0, 0), (4, 0), (4, 1), (0, 1)], [DISC]), (-2, 5), Translation((0, -9)), EdgeArc(0, 0)),
    "vertex on disc": (Scene([(0, 0), (4, 4), (0, 4)], [DISC]), (0, 5), Translation((0, -9)), ArcArc(0, 0)),
    "second arc of a stadium": (
        Scene(STADIUM, [SLAB]),
        (0, 0),
        Rotation((0, -3), "90deg"),
        ArcEdge(1, 2),
    ),
    "second arc of a stadium, turning": (
        Scene(STADIUM, [SLAB]),
        (0, "-1.5"),
        Rotation((0, "-1.5"), "90deg"),
        ArcEdge(1, 2),
    ),
    "disc in a round workspace": (
        Scene(DISC, workspace=Curved.circle((0, 0), 5)),
        (0, 0),
        Translation((0, 9)),
        ArcArc(0, 0),
    ),
    "reflex vertex of a workspace": (
        Scene(DISC, workspace=[(-5, -5), (5, -5), (5, 0), (0, 0), (0, 5), (-5, 5)]),
        (-3, -3),
        Translation((9, 9)),
        ArcArc(0, 3),
    ),
    "edge of a workspace": (
        Scene(DISC, workspace=[(-5, -5), (5, -5), (5, 5), (-5, 5)]),
        (0, 0),
        Translation((9, 1)),
        ArcEdge(0, 1),
    ),
    "disc in a hole of its radius": (
        Scene(DISC, [Curved([(-5, -5), (5, -5), (5, 5), (-5, 5)], [Circle((0, 0), 1)])]),
        (0, 0),
        Translation((1, 1)),
        ArcArc(0, 4),
    ),
    "disc in a bay of its radius": (Scene(DISC, [BAY]), (0, 5), Translation((0, -9)), ArcArc(0, 4)),
    "grown corner": (
        Scene(Curved([(0, 0), (2, 0), (0, 2)], grown="1/2"), [DISC]),
        (-7, 0),
        Translation((9, 0)),
        ArcArc(1, 0),
    ),
}


@pytest.mark.parametrize("name", ENTERED)
def test_the_features_that_meet_are_named(name: str) -> None:
    scene, (x, y), motion, expected = ENTERED[name]
    found = cfree.first_contact(scene, Pose(x, y), motion)
    assert found is not None
    assert found.contact == expected


def test_bounds_and_a_forbidden_begin_have_no_contact() -> None:
    scene = Scene(DISC, [SLAB, DISC], bounds=(-6, -6, 6, 6))
    for pose, motion, obstacle in (((4, 4), (9, 0), -1), ((0, -4), (9, 0), 0)):
        found = cfree.first_contact(scene, Pose(*pose), Translation(motion))
        assert found is not None and (found.obstacle, found.contact) == (obstacle, None)


def _triangle(rng: random.Random) -> list[tuple[Fraction, Fraction]]:
    while True:
        p, q, r = (point(rng, 3) for _ in range(3))
        if (q[0] - p[0]) * (r[1] - p[1]) > (q[1] - p[1]) * (r[0] - p[0]):
            return [p, q, r]


@pytest.mark.parametrize("seed", range(3))
def test_polygons_among_round_shapes_have_the_contacts_of_polygons(seed: int) -> None:
    """A disc far away makes the scene a round one. Where vertices meet, or edges do, either names one of the pairs."""
    rng, named = random.Random(seed), list[bool]()
    while len(named) < 40:
        robot, wall = _triangle(rng), [(x + 6, y) for x, y in _triangle(rng)]
        pose, onto = Pose(*point(rng, 2)), Translation((rng.randint(4, 9), rng.randint(-3, 3)))
        motion = rng.choice([motion_of(rng), onto, Rotation((3, rng.randint(-6, 6)), "180deg")])
        one = cfree.first_contact(Scene(robot, [wall]), pose, motion)
        other = cfree.first_contact(Scene(robot, [wall, Curved.circle((900, 900), 1)]), pose, motion)
        assert (one is None) == (other is None)
        if one is not None and other is not None and one.contact is not None:
            assert other.contact is not None and other.obstacle == 0
            kind = ArcEdge if isinstance(one.contact, VertexEdge) else EdgeArc
            named.append(other.contact == kind(one.contact.i, one.contact.j))
    assert sum(named) >= 36
