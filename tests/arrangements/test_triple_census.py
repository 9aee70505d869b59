"""All triple contacts of Definition 1's contact surfaces: against sign changes of determinants in doubles."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import combinations

import numpy as np
import pytest

from cfree import Curved, Scene, UnsupportedError
from cfree.arrangements import arrangement, census
from cfree.contact import VertexEdge
from cfree.contact.surface import Surface

TRIANGLES = Scene([(0, 0), (2, 0), (0, 1)], [[(5, 5), (8, "5.1"), (6, 7)]])
SQUARE = [(-1, -1), (1, -1), (1, 1), (-1, 1)]


def lines(surface: Surface, theta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    start, end = surface(0, theta)[..., :2], surface(1, theta)[..., :2]
    return start, end - start


def cross(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]


def determinant(three: tuple[Surface, ...], theta: np.ndarray) -> np.ndarray:
    (p, u), (q, v), (r, w) = (lines(s, theta) for s in three)
    return cross(u, v) * cross(r, w) - cross(u, w) * cross(q, v) + cross(v, w) * cross(p, u)


def met(three: tuple[Surface, ...]) -> list[tuple[float, float, float]]:
    """Poses strictly inside all three, by bisection between 1,000 orientations."""
    theta = np.linspace(0, math.tau, 1001) + 0.00123
    value = determinant(three, theta)
    if np.abs(value).max() < 1e-12:
        return []  # a curve, or parallel lines
    found = []
    (changes,) = np.nonzero(value[1:] * value[:-1] < 0)
    lows, highs = theta[changes], theta[changes + 1]
    for _ in range(45):
        middle = (lows + highs) / 2
        before = determinant(three, middle) * value[changes] > 0
        lows, highs = np.where(before, middle, lows), np.where(before, highs, middle)
    for low in lows.tolist():
        (p, u), (q, v), (r, w) = (lines(s, np.array(low)) for s in three)
        pairs = [(p, u, q, v), (p, u, r, w), (q, v, r, w)]
        a, b, c, d = max(pairs, key=lambda pair: abs(cross(pair[1], pair[3])))
        if abs(cross(b, d)) < 1e-9:
            continue
        x = a + b * (cross(c - a, d) / cross(b, d))
        t = [((x - start) @ along) / (along @ along) for start, along in ((p, u), (q, v), (r, w))]
        if all(1e-9 < s < 1 - 1e-9 for s in t):
            found.append((*x.tolist(), low % math.tau))
    return found


@pytest.mark.slow
@pytest.mark.long
def test_the_census_of_two_triangles_has_the_triple_contacts_that_the_arrangement_has_not() -> None:
    found = census(TRIANGLES)
    assert len(found.surfaces) == 18 and sum(found.relations.values()) == 816 == math.comb(18, 3)
    inside = [(*pose.xy, pose.angle.theta) for pose in found.inside]
    expected = [pose for three in combinations(found.surfaces, 3) for pose in met(three)]

    def apart(p: tuple[float, ...], q: tuple[float, ...]) -> float:
        return math.hypot(p[0] - q[0], p[1] - q[1]) + abs(math.remainder(p[2] - q[2], math.tau))

    assert len(inside) > 10
    for one, other in ((inside, expected), (expected, inside)):
        assert all(min(apart(p, q) for q in other) < 1e-8 for p in one)
    assert min(apart(p, q) for p, q in combinations(inside, 2)) > 1e-9  # each once
    assert arrangement(TRIANGLES).statistics.vertices_by_kind["triple contact"] == 0
    assert len(found.inside) + len(found.rim) <= found.bound == 4 * 816


def test_reflex_vertices_have_contact_surfaces_as_well() -> None:
    dart = [(0, 0), (4, -2), (1, 0), (4, 2)]
    with pytest.raises(
        UnsupportedError, match="24 contact surfaces make 2,024 triples, more than max_triples=9; give more"
    ):
        census(Scene([(0, 0), (1, 0), (0, 1)], [dart]), max_triples=9)


@pytest.mark.parametrize("ask", [census, arrangement])
def test_round_shapes_are_refused_with_the_remedy(ask: Callable[[Scene], object]) -> None:
    for scene in (
        Scene(SQUARE, [Curved.circle((5, 5), 1)]),
        Scene(Curved(SQUARE, grown=1), []),
        Scene(SQUARE, workspace=Curved.circle((0, 0), 9)),
    ):
        with pytest.raises(UnsupportedError) as refused:
            ask(scene)
        (line,) = str(refused.value).splitlines()
        assert "round shapes, and this takes polygons" in line and "cfree convert --outer or --inner" in line


@pytest.mark.slow
def test_symmetric_surfaces_meet_in_curves_as_well_as_in_points() -> None:
    found = census(Scene([(-1, -1), (1, -1), (0, 1)], [[(-1, -1), (1, -1), (0, 1)]]))
    assert found.relations["curve"] > 0 and sum(found.relations.values()) == 816
    assert repr(found).startswith("Census(18 surfaces, 816 triples: ")
    assert sum(isinstance(surface.contact, VertexEdge) for surface in found.surfaces) == 9


def test_bounds_of_an_arrangement_have_their_constants() -> None:
    whole = arrangement(TRIANGLES)
    assert whole.statistics.bounds == {"surfaces": 4 * math.comb(18, 3) + 6 * 18**2 + 4 * 18}
    assert whole.statistics.vertices <= whole.statistics.bounds["surfaces"]
