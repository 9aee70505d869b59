"""Control nets evaluate to S(t, tau) exactly; their weights are those of 1 + tau^2, and positive."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import strategies
from cfree.contact.contact import EdgeVertex, VertexEdge, contacts
from cfree.contact.surface import contact_surface
from cfree.exact.orientation import Location
from cfree.polygons.polygon import Polygon
from cfree.rational.bezier import BezierPatch, bezier_patch, bezier_patches, save_bezier
from cfree.rational.model import RationalSurface, rational_surface
from shapes import Shape

SQUARE = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
TRIANGLE = Polygon([(-1, -1), (3, -1), (0, 2)])
pairs = st.tuples(strategies.polygons(), strategies.polygons())
ts = st.fractions(0, 1, max_denominator=30)
locals_ = st.fractions(-1, 1, max_denominator=30)
intervals = st.tuples(locals_, locals_).filter(lambda ends: ends[0] != ends[1]).map(lambda ends: tuple(sorted(ends)))


def drawn(shapes: tuple[Shape, Shape], data: st.DataObject) -> RationalSurface:
    A, O = Polygon(*shapes[0]), Polygon(*shapes[1])
    return rational_surface(A, O, data.draw(st.sampled_from(contacts(A, O))))


def tau_of(chart: int, local: Fraction) -> Fraction | None:
    """tan(theta / 2) of theta = chart pi + 2 atan(local)."""
    return local if chart == 0 else -1 / local if local else None


# the net is the surface


@pytest.mark.slow
@given(pairs, ts, ts, intervals, st.sampled_from([0, 1]), st.data())
def test_nets_evaluate_to_the_surface_exactly(
    shapes: tuple[Shape, Shape],
    t: Fraction,
    part: Fraction,
    ends: tuple[Fraction, Fraction],
    chart: int,
    data: st.DataObject,
) -> None:
    S = drawn(shapes, data)
    patch = bezier_patch(S.surface, *ends, chart=chart)
    local = ends[0] + part * (ends[1] - ends[0])
    x, y, _ = S.point(t, tau_of(chart, local))
    assert patch(t, local) == (x, y, local)
    if 1 + ends[0] * ends[1] > 0:
        assert bezier_patch(S.surface, *ends, chart=chart, dimension=2)(t, local) == (x, y)


@pytest.mark.slow
@settings(max_examples=60)
@given(pairs, ts, ts, st.data())
def test_patches_cover_what_is_inside_phi_and_nothing_else(
    shapes: tuple[Shape, Shape], t: Fraction, part: Fraction, data: st.DataObject
) -> None:
    S = drawn(shapes, data)
    parts = bezier_patches(S)
    assert len(parts) in (1, 2)  # a patch spans less than half a turn
    first, last = S.Phi.inside(53)
    (low, _), (_, high) = parts[0].interval, parts[-1].interval
    assert (tau_of(parts[0].chart, low), tau_of(parts[-1].chart, high)) == (first, last)
    if len(parts) == 2:
        assert parts[0].interval[1] == 1 == -parts[1].interval[0] and parts[0].chart != parts[1].chart
    for patch in parts:
        low, high = patch.interval
        local = low + part * (high - low)
        tau = tau_of(patch.chart, local)
        assert patch(t, local)[:2] == S.point(t, tau)[:2]
        assert S.locate(t, tau) is not Location.OUTSIDE
        assert min(patch.weights) > 0


@pytest.mark.slow
@given(pairs, intervals, st.data())
def test_corners_are_points_and_rows_are_tangent(
    shapes: tuple[Shape, Shape], ends: tuple[Fraction, Fraction], data: st.DataObject
) -> None:
    S = drawn(shapes, data)
    patch = bezier_patch(S.surface, *ends)
    for k in (0, 1):
        assert patch.points[k][0] == S.point(k, ends[0]) and patch.points[k][-1] == S.point(k, ends[1])
        # the helix leaves its first point towards the second: dx/dtau = -M' a
        (ax, ay), tau = S.surface.helix(k).fixed, ends[0]
        w = (1 + tau * tau) ** 2
        dc, ds = -4 * tau / w, 2 * (1 - tau * tau) / w
        velocity = (-(dc * ax - ds * ay), -(ds * ax + dc * ay), Fraction(1))
        step = [b - a for a, b in zip(*patch.points[k][:2], strict=True)]
        factor = step[2]
        assert factor > 0 and step == [factor * v for v in velocity]


@given(intervals)
def test_weights_are_the_bernstein_coefficients_of_one_plus_tau_squared(ends: tuple[Fraction, Fraction]) -> None:
    u, v = ends
    S = contact_surface(TRIANGLE, SQUARE, VertexEdge(0, 0))
    weights = bezier_patch(S, u, v).weights
    assert weights == (1 + u * u, 1 + (u * u + 2 * u * v) / 3, 1 + (2 * u * v + v * v) / 3, 1 + v * v)
    assert min(weights) >= Fraction(2, 3)
    for s in (Fraction(k, 7) for k in range(8)):
        tau = (1 - s) * u + s * v
        assert sum(math.comb(3, k) * s**k * (1 - s) ** (3 - k) * w for k, w in enumerate(weights)) == 1 + tau * tau


@given(st.tuples(*[st.fractions(-9, 9, max_denominator=12)] * 2).filter(lambda ends: ends[0] < ends[1]))
def test_the_middle_weight_is_positive_below_half_a_turn(ends: tuple[Fraction, Fraction]) -> None:
    u, v = ends
    S = contact_surface(TRIANGLE, SQUARE, EdgeVertex(0, 0))
    span = 2 * math.atan(v) - 2 * math.atan(u)
    if 1 + u * v > 0:
        assert bezier_patch(S, u, v, dimension=2).weights == (1 + u * u, 1 + u * v, 1 + v * v)
        assert span < math.pi + 1e-12
    else:
        assert span > math.pi - 1e-12
        with pytest.raises(ValueError, match="cut the interval where its angle spans less"):
            bezier_patch(S, u, v, dimension=2)


def test_the_least_weight_of_a_chart_is_reached() -> None:
    assert bezier_patch(contact_surface(SQUARE, SQUARE, VertexEdge(0, 0)), -1, 1).weights == (
        2,
        Fraction(2, 3),
        Fraction(2, 3),
        2,
    )


# arrays and files


def evaluated(points: np.ndarray, weights: np.ndarray, t: float, s: float) -> np.ndarray:
    """Bernstein's sum, in doubles."""
    d = weights.shape[1] - 1
    basis = np.outer([1 - t, t], [math.comb(d, k) * s**k * (1 - s) ** (d - k) for k in range(d + 1)]) * weights
    value: np.ndarray = np.tensordot(basis, points, 2) / basis.sum()
    return value


def test_arrays_are_the_net_in_doubles() -> None:
    S = contact_surface(TRIANGLE, SQUARE, EdgeVertex(1, 2))
    for dimension in (2, 3):
        patch = bezier_patch(S, "-1/3", "2/5", dimension=dimension)  # type: ignore[arg-type]
        points, weights = patch.arrays()
        assert points.shape == (2, dimension + 1, dimension) and weights.shape == (2, dimension + 1)
        for t, s in ((0.0, 0.0), (0.3, 0.8), (1.0, 0.5)):
            tau = Fraction(-1, 3) + Fraction(s) * Fraction(11, 15)
            np.testing.assert_allclose(evaluated(points, weights, t, s), [float(c) for c in patch(t, tau)], rtol=1e-14)


def test_files_hold_exact_numbers(tmp_path: Path) -> None:
    patches = bezier_patches(rational_surface(TRIANGLE, SQUARE, VertexEdge(1, 2)))
    file = tmp_path / "patch.json"
    save_bezier(patches, file)
    read = json.loads(file.read_text())
    assert [set(entry) for entry in read] == [{"chart", "interval", "degrees", "weights", "points"}] * len(patches)
    for entry, patch in zip(read, patches, strict=True):
        rebuilt = BezierPatch(
            entry["chart"],
            tuple(map(Fraction, entry["interval"])),
            tuple(map(Fraction, entry["weights"])),
            tuple(tuple(tuple(map(Fraction, point)) for point in row) for row in entry["points"]),
        )
        assert rebuilt == patch
        assert entry["degrees"] == [1, 3]


# bad input

SURFACE = contact_surface(TRIANGLE, SQUARE, VertexEdge(0, 0))


@pytest.mark.parametrize("ends", [(0, 0), (1, 0), ("1/2", 0.25)])
def test_an_interval_needs_a_width(ends: tuple[int, int]) -> None:
    with pytest.raises(ValueError, match="has no width; give start < stop"):
        bezier_patch(SURFACE, *ends)


@pytest.mark.parametrize("bad", [math.nan, math.inf, "x", None, "inf"])
def test_ends_are_finite_numbers(bad: object) -> None:
    with pytest.raises((TypeError, ValueError), match=r"give|write it like"):
        bezier_patch(SURFACE, 0, bad)  # type: ignore[arg-type]


def test_there_are_two_charts() -> None:
    with pytest.raises(ValueError, match="no chart 2; give 0 or 1"):
        bezier_patch(SURFACE, 0, 1, chart=2)


@pytest.mark.parametrize("place", [(2, 0), (-1, 0), (0, 2), (0, "-1/1000"), (math.nan, 0), (0, math.nan)])
def test_nets_are_not_used_beyond_their_ends(place: tuple[float, float]) -> None:
    with pytest.raises(ValueError, match="give a"):
        bezier_patch(SURFACE, 0, 1)(*place)
