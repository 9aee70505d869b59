"""Noding: edges share nothing but ends, in exact numbers; the filter in doubles drops no pair that meets."""

import random
from fractions import Fraction

import numpy as np
import pytest
import shapely

from cfree.polygons import noding
from cfree.polygons.noding import CrowdedError, orientation
from nodings import decimals, noded, share_ends_only, soup


@pytest.mark.parametrize(
    ("segments", "edges", "points"),
    [
        pytest.param([((0, 0), (2, 2)), ((0, 2), (2, 0))], 4, 5, id="crossing"),
        pytest.param([((0, 0), (4, 0)), ((1, 0), (1, 3))], 3, 4, id="T junction"),
        pytest.param([((0, 0), (4, 0)), ((2, 0), (6, 0))], 3, 4, id="overlap"),
        pytest.param([((0, 0), (4, 0)), ((3, 0), (1, 0))], 3, 4, id="inside, reversed"),
        pytest.param([((0, 0), (4, 0)), ((4, 0), (0, 0))], 1, 2, id="twice"),
        pytest.param([((0, 0), (0, 0))], 0, 1, id="point"),
    ],
)
def test_segments_are_cut_where_they_meet(segments: list[object], edges: int, points: int) -> None:
    graph = noded([(tuple(map(Fraction, p)), tuple(map(Fraction, q)), k) for k, (p, q) in enumerate(segments)])  # type: ignore[misc,str-unpack]
    assert (len(graph.alive()), len(graph.points)) == (edges, points)


@pytest.mark.parametrize("digits", [0, 1, 3])
@pytest.mark.parametrize("seed", range(4))
def test_edges_of_a_noding_share_ends_only(seed: int, digits: int) -> None:
    graph = noded(soup(random.Random(seed), 30, digits))
    assert share_ends_only(graph)


@pytest.mark.parametrize("seed", range(3))
def test_a_noding_has_as_many_edges_as_that_of_shapely(seed: int) -> None:
    segments = soup(random.Random(seed), 800, 3)
    lines = [shapely.LineString([tuple(map(float, p)), tuple(map(float, q))]) for p, q, _ in segments if p != q]
    assert len(noded(segments).alive()) == len(shapely.unary_union(lines).geoms)


def test_segments_added_later_are_cut_into_the_noding() -> None:
    segments = soup(random.Random(5), 30, 1)
    once, later = noded(segments), noded(segments[:20])
    later.add(segments[20:])
    assert len(later.alive()) == len(once.alive())
    assert share_ends_only(later)


def test_t_junctions_that_only_decimals_have_are_cut() -> None:
    rng = random.Random(7)
    missed = 0
    for _ in range(300):  # each decimal point is on its line; its double mostly is not
        a, b = decimals(rng.randrange(10**7) / 1000, rng.randrange(10**7) / 1000), decimals(rng.random(), 0.1)
        share = Fraction(rng.randrange(1, 10), 10)
        middle = a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share
        graph = noded([(a, b, 0), (middle, (middle[0] + 5, middle[1] + 50), 1)])
        missed += len(graph.alive()) != 3
    assert not missed


def test_proven_signs_are_right() -> None:
    rng = random.Random(3)
    points = []
    for _ in range(3000):
        p, q = ((rng.uniform(-1000, 1000), rng.uniform(-1000, 1000)) for _ in range(2))
        t, scale = rng.uniform(-1, 2), 10.0 ** rng.uniform(-16, -9)
        r = p[0] + (q[0] - p[0]) * t + rng.uniform(-scale, scale), p[1] + (q[1] - p[1]) * t + rng.uniform(-scale, scale)
        points.append((p, q, r))
    p, q, r = (np.array([triple[k] for triple in points]) for k in range(3))
    signs = noding._signs(p, q, r, 4000.0)
    for triple, sign in zip(points, signs.tolist(), strict=True):
        moved = [[Fraction(x) + Fraction(rng.choice((-1, 0, 1))) * Fraction(4000) / 2**53 for x in v] for v in triple]
        value = orientation(*map(tuple, moved))  # type: ignore[arg-type]
        assert not sign or sign * value > 0
    assert 0.05 < np.mean(signs == 0) < 0.95


def test_removed_sources_leave_the_uses_of_others() -> None:
    graph = noded([((Fraction(0), Fraction(0)), (Fraction(2), Fraction(0)), 0)] * 2)
    graph.add([((Fraction(0), Fraction(0)), (Fraction(1), Fraction(0)), 1)])
    graph.remove({0})
    assert [graph.uses[edge] for edge in graph.alive()] == [[(1, 1)]]


def test_a_denominator_that_is_too_large_leaves_fractions() -> None:
    thirds = [(Fraction(1, 3**k), Fraction(k)) for k in range(1, 1400, 100)]
    segments = [(thirds[k - 1], p, k) for k, p in enumerate(thirds)]
    graph = noded(segments)
    assert graph.scale == 1
    assert share_ends_only(graph)


def test_segments_that_all_cross_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(noding, "MOST_MEETINGS", 1000)
    star = [((Fraction(k), Fraction(0)), (Fraction(100 - k), Fraction(50)), k) for k in range(60)]
    with pytest.raises(CrowdedError):
        noded(star)
