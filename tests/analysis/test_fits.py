"""Parts in holes, against closed forms: squares, triangles, polygons in themselves; and against exact overlap."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

import oracles
from cfree import Curved, Polygon, Pose, Scene, boundary, fits, is_free
from cfree.analysis import Fit
from cfree.curves import Arc
from cfree.exact import AngleInterval
from hollow_fits import filleted
from shapes import Point, Shape, box, l_shape, mapped

SQUARE = box(0, 0, 1, 1)[0]
ALL = AngleInterval(None, None)


def check_places(part: list[Point], hole: Polygon, found: tuple[Fit, ...]) -> None:
    for fit in found:
        assert fit.pose is not None
        assert fit.orientations.contains({"tau": fit.pose.tau})
        assert fit.place == (float(fit.pose.x), float(fit.pose.y), fit.pose.theta)
        q, shape = fit.pose, (list(hole.exact_vertices), [])
        assert not oracles.exact_is_forbidden([(part, [])], [], q.x, q.y, q.tau, None, shape)


@pytest.mark.parametrize("digits", [1, 2, 3, 6, 9, 12])
def test_a_square_in_a_slightly_larger_one(digits: int) -> None:
    c = Fraction(1, 10**digits)
    hole = Polygon(box(3, 5, 4 + c, 6 + c)[0])
    found = fits(SQUARE, hole)
    check_places(SQUARE, hole, found)
    assert len(found) == 4
    for fit in found:  # |sin| + |cos| <= 1 + c
        start, stop = fit.orientations.start, fit.orientations.stop
        assert start is not None and stop is not None
        for end, inner in ((start, 1), (stop, 0)):
            taus = end.neighbours(300)
            sizes = [abs(q.cos) + abs(q.sin) for q in (Pose(0, 0, {"tau": tau}) for tau in taus)]
            assert sizes[inner] <= 1 + c <= sizes[1 - inner]
        assert -np.subtract(*fit.orientations.theta) == pytest.approx(
            2 * (math.asin((1 + c) / math.sqrt(2)) - math.pi / 4), abs=1e-14
        )


def test_exact_fits_and_parts_that_are_too_large() -> None:
    found = fits(SQUARE, SQUARE)
    check_places(SQUARE, Polygon(SQUARE), found)
    assert [fit.orientations.theta for fit in found] == [(k * math.pi / 2,) * 2 for k in range(4)]
    assert all(fit.orientations.is_single for fit in found)
    for digits in (1, 6, 12, 40):
        assert fits(SQUARE, box(0, 0, 1, 1 - Fraction(1, 10**digits))[0]) == ()
    # as wide as the slot: it can slide, but not turn
    assert [fit.orientations.theta[0] for fit in fits(box(0, 0, 2, 1)[0], box(0, 0, 9, 1)[0])] == [0, math.pi]
    (free,) = fits(SQUARE, box(0, 0, 3, 3)[0])
    assert free.orientations == ALL


@pytest.mark.parametrize("tau", [Fraction(0), Fraction(1, 3), Fraction(-5, 2), Fraction(1), None])
def test_polygons_congruent_to_the_hole(tau: Fraction | None) -> None:
    turn = Pose(5, "1/7", {"tau": tau})
    for part in (l_shape()[0], [(0, 0), (4, 0), (1, 3)], [(0, 0), (3, 1), (5, 0), (4, 4), (1, 2)]):
        hole = Polygon(turn.apply_exact(part))
        found = fits(part, hole)
        check_places(part, hole, found)
        assert [(fit.orientations.is_single, fit.pose) for fit in found] == [(True, turn)]


def test_a_hole_with_an_island() -> None:
    hole = Polygon(box(0, 0, 10, 10)[0], [box(4, 4, 6, 6)[0]])
    assert [fit.orientations for fit in fits(box(0, 0, 3, 1)[0], hole)] == [ALL]
    turned = fits(box(0, 0, 9, 4)[0], hole)
    assert [fit.orientations.theta[0] / (math.pi / 2) for fit in turned] != []
    assert fits(box(0, 0, 9, 5)[0], hole) == ()


def triangle_fits(part: list[Point], hole: list[Point], tau: Fraction | None) -> bool:
    """Into a triangle: what its sides leave over, each times its length, has a sum that is not negative."""
    q, left = Pose(0, 0, {"tau": tau}), Fraction(0)
    turned = q.apply_exact(part)
    for (x, y), (z, w) in pairwise([*hole, hole[0]]):
        normal = Fraction(w - y), Fraction(x - z)
        left += normal[0] * x + normal[1] * y - max(normal[0] * u + normal[1] * v for u, v in turned)
    return left >= 0


def random_triangle(rng: np.random.Generator, size: int) -> list[Point]:
    while True:
        points = [tuple(p) for p in rng.integers(0, size, (3, 2)).tolist()]
        (a, b), (c, d), (e, f) = points
        area = (c - a) * (f - b) - (d - b) * (e - a)
        if area:
            return points if area > 0 else points[::-1]


@pytest.mark.slow
def test_triangles_in_triangles() -> None:
    rng, counts = np.random.default_rng(0), set()
    for _ in range(40):
        part, hole = random_triangle(rng, 8), random_triangle(rng, 11)
        found = fits(part, hole)
        check_places(part, Polygon(hole), found)
        counts.add(len(found))
        for k in range(-24, 25):
            for tau in (Fraction(k, 24), -Fraction(24, k) if k else None):
                inside = sum(fit.orientations.contains({"tau": tau}) for fit in found)
                assert inside == triangle_fits(part, hole, tau)
        for fit in found:
            for end, out in ((fit.orientations.start, 0), (fit.orientations.stop, 1)):
                if end is not None and not fit.orientations.is_single:
                    taus = end.neighbours(200)
                    assert triangle_fits(part, hole, taus[1 - out])
                    if taus[0] != taus[1]:
                        assert not triangle_fits(part, hole, taus[out])
    assert len(counts) > 2


def test_turning_the_hole_turns_the_fits() -> None:
    part, hole = [(0, 0), (5, 0), (5, 1), (0, 1)], box(0, 0, 5, 4)[0]

    def turned(x: Fraction, y: Fraction) -> Point:
        return Fraction(3 * x - 4 * y, 5), Fraction(4 * x + 3 * y, 5)

    shape: Shape = (hole, [])
    by = math.atan2(4, 3)
    first, second = fits(part, hole), fits(part, mapped(shape, lambda x, y: turned(Fraction(x), Fraction(y)))[0])
    ranges = [np.array([fit.orientations.theta for fit in found]) for found in (first, second)]
    shifted = ranges[0] + by
    shifted -= math.tau * (shifted[:, :1] >= math.tau)
    np.testing.assert_allclose(shifted[np.argsort(shifted[:, 0])], ranges[1], atol=1e-14)


# --- round shapes


def _with_ends(length: object, width: Fraction = Fraction(2)) -> Curved:
    """A stadium along the x-axis."""
    half, radius = Fraction(str(length)) / 2, width / 2
    ends = [Arc((half, radius), center=(half, 0)), Arc((-half, -radius), center=(-half, 0))]
    return Curved([(-half, -radius), (half, -radius), ends[0], (-half, radius), ends[1]])


@pytest.mark.parametrize("room", [Fraction(1, 100), Fraction(1, 2**40)])
def test_rounded_squares_and_stadiums_in_boxes(room: Fraction) -> None:
    """A square of side 1 grown by 1/2 is |sin| + |cos| + 1 wide, and a stadium 2 |sin| + 2."""
    rounded = Curved(SQUARE, grown="1/2")
    found = fits(rounded, box(0, 0, 2 + room, 2 + room)[0])
    assert len(found) == 4
    for fit in found:
        start, stop = fit.orientations.start, fit.orientations.stop
        assert start is not None and stop is not None and fit.pose is not None
        for end, inner in ((start, 1), (stop, 0)):
            sizes = [abs(q.cos) + abs(q.sin) for q in (Pose(0, 0, {"tau": tau}) for tau in end.neighbours(300))]
            assert sizes[inner] <= 1 + room <= sizes[1 - inner]
    slot = box(0, 0, 9, 2 + room)[0]
    assert [2 * math.sin(fit.orientations.theta[1]) for fit in fits(_with_ends(2), slot)] == pytest.approx(
        [-room, room], rel=1e-3
    )
    exact = fits(rounded, box(0, 0, 2, 2)[0])
    assert [fit.orientations.theta for fit in exact] == [(k * math.pi / 2,) * 2 for k in range(4)]
    assert fits(rounded, box(0, 0, 2, 2 - room)[0]) == fits(_with_ends(2), box(0, 0, 9, 2 - room)[0]) == ()


def test_what_fits_in_a_round_hole() -> None:
    """A rectangle whose corners are on the rim, a disc of its own size, and larger ones."""
    rectangle, hole = box("-6/5", "-8/5", "6/5", "8/5")[0], Curved.circle((5, 5), 2)
    for part in (rectangle, Curved.circle((1, 0), 2), Curved(SQUARE, grown="1/2")):
        (fit,) = fits(part, hole)
        assert fit.orientations == ALL and fit.pose is not None
        assert is_free(Scene(part, workspace=hole), fit.pose)
    assert fits(box("-6/5", "-8/5", "6/5", 1.7)[0], hole) == fits(Curved.circle((0, 0), "2.0000001"), hole) == ()


def _pocket(half_width: object, half_height: object, radius: object) -> Curved:
    return Curved(filleted(-half_width, -half_height, half_width, half_height, radius))  # type: ignore[operator]


DOME = Curved([(-2, 0), (2, 0), Arc((-2, 0), center=(0, 0))])


@pytest.mark.parametrize(
    ("part", "hole", "degrees"),
    [
        (box("-3.6", "-1.8", "3.6", "1.8")[0], _pocket(4, 2, 1), [0, 180]),  # its corners are in the fillets
        (_pocket(4, 2, 1), _pocket(4, 2, 1), [0, 180]),
        (_pocket(2, 2, 1), _pocket(2, 2, Fraction(1, 2)), [0, 90, 180, 270]),
        ([(-1, 0), (1, 0), (0, 2)], DOME, [0]),
        (DOME, DOME, [0]),
        (_with_ends(1), _with_ends(1), [0, 180]),
        (_with_ends(1), _with_ends(3), [0, 180]),
        (_pocket(2, 2, Fraction(1, 2)), _pocket(2, 2, 1), []),
    ],
)
def test_exact_fits_in_convex_pockets(part: Any, hole: Curved, degrees: list[float]) -> None:
    found = [fit for fit in fits(part, hole) if fit.orientations.is_single]
    assert [round(math.degrees(fit.place[2])) for fit in found] == degrees
    assert all(fit.pose is not None and is_free(Scene(part, workspace=hole), fit.pose) for fit in found)


def _angle_plate(width: object, height: object, thickness: object, radius: object, reflex: object) -> Curved:
    """An L with round corners, one of them reflex."""
    w, h, t, r, q = (Fraction(value) for value in (width, height, thickness, radius, reflex))  # type: ignore[arg-type]
    corners = [((w - r, 0), (w, r), (w - r, r)), ((w, t - r), (w - r, t), (w - r, t - r))]
    corners += [((t + q, t), (t, t + q), (t + q, t + q))]
    corners += [((t, h - r), (t - r, h), (t - r, h - r)), ((r, h), (0, h - r), (r, h - r)), ((0, r), (r, 0), (r, r))]
    ring: list[Any] = []
    for start, end, center in corners:
        ring += [start] if not ring or ring[-1].to != start else []
        ring.append(Arc(end, center=center, clockwise=center == (t + q, t + q)))
    return Curved(ring)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("part", "degrees"),
    [
        ((6, 8, 2, "1/2", "1/2"), [0]),
        ((6, 6, 2, 1, 1), [0]),  # the same in a mirror
        ((6, 8, 2, "1/2", "1/4"), [0]),  # with a sharper reflex corner than the hole's, and a rounder one
        ((6, 8, 2, "1/2", 1), []),
        ((5, 3, 2, "1/2", "1/2"), [0]),  # it slides
        ((2, 2, 1, "1/2", "1/2"), []),  # at intervals of orientations
    ],
)
def test_exact_fits_in_a_hole_that_is_not_convex(part: tuple[Any, ...], degrees: list[float]) -> None:
    hole = _angle_plate(6, 8, 2, "1/2", "1/2") if part[3] == "1/2" else _angle_plate(*part)
    found = fits(_angle_plate(*part), hole)
    assert [round(math.degrees(fit.place[2])) for fit in found if fit.orientations.is_single] == degrees
    assert all(fit.pose and is_free(Scene(_angle_plate(*part), workspace=hole), fit.pose) for fit in found)


def test_a_half_disc_turns_in_a_disc_of_its_radius() -> None:
    (fit,) = fits(Curved([(0, 2), Arc((0, -2), center=(0, 0))]), Curved.circle((0, 0), 2))
    assert fit.orientations == ALL and fit.place[:2] == (0, 0)


@pytest.mark.parametrize("seed", range(7))
def test_random_round_parts_fit_at_the_orientations_of_slices(seed: int) -> None:
    """Free positions at 60 orientations, by the boundary of the scene with chords: a little larger, or smaller."""
    rng = random.Random(seed)
    part: list[Any] = [Curved.circle((rng.randint(-4, 4) / 4, 0), "1/2"), _with_ends(rng.randint(1, 4))]
    hole: Any = box(0, 0, 3 + rng.randint(0, 8) / 4, 2 + rng.randint(1, 6) / 8)[0]
    if seed >= 6:  # in a hole that is not convex
        part = [_pocket(Fraction(rng.randint(6, 9), 8), Fraction(rng.randint(3, 6), 8), Fraction(1, 4))]
        hole = _angle_plate(4, 5, 2, Fraction(rng.randint(1, 3), 4), Fraction(1, 2))
    elif seed >= 3:  # a polygon and a part with an arc in a pocket with fillets
        part = [
            box(-1, Fraction(-rng.randint(2, 6), 8), 1, Fraction(1, 2))[0],
            _pocket(Fraction(9, 8), Fraction(3, 8), Fraction(1, 4)),
        ]
        hole = _pocket(Fraction(rng.randint(9, 12), 8), Fraction(rng.randint(6, 9), 8), Fraction(rng.randint(2, 5), 8))
    found, scene = fits(part, hole), Scene(part, workspace=hole)
    outer, inner = boundary(scene.outer(1e-4)), boundary(scene.inner(1e-4))
    for theta in np.arange(60) * 0.1047:
        is_fit = any(fit.orientations.contains(float(theta)) for fit in found)
        assert bool(len(outer.slice(theta).segments)) <= is_fit <= bool(len(inner.slice(theta).segments))
    assert all(is_free(scene, fit.pose) for fit in found if fit.pose is not None)
