"""Exact rings, against points of them in doubles."""

import math
import random
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import cfree
from cfree.curves import Arc, Bezier, Circle, Ellipse, Spline
from cfree.curves.drawn import Line
from cfree.curves.rings import Cubic, Piece, Span, exact_ring, given_ring
from round_shapes import Floats, rim

HALF = Fraction(1, 2)


def points_of(piece: Piece, s: Floats) -> Floats:
    """On a piece, in doubles."""
    match piece:
        case Line(start, end):
            control = np.array([start, end], float)
            return np.outer(1 - s, control[0]) + np.outer(s, control[1])
        case Cubic(points):
            control = np.array(points, float)
            return np.column_stack([math.comb(3, k) * s**k * (1 - s) ** (3 - k) for k in range(4)]) @ control
    t = s * (piece.quarters * math.pi / 2 + 2 * math.atan(piece.rest))
    return np.array(piece.center, float) + np.outer(np.cos(t), np.array(piece.u, float)) + np.outer(
        np.sin(t), np.array(piece.v, float)
    )  # fmt: skip


RINGS: dict[str, Any] = {
    "circle": Circle((1, 2), "1/3"),
    "ellipse": Ellipse((1, 0), (2, 1), "30deg"),
    "ellipse of any angle": Ellipse((0, "1/7"), (2, 3), 1.234),
    "quarter": [(1, 0), Arc((0, 1), center=(0, 0)), (0, 0)],
    "three quarters": [(1, 0), Arc((0, 1), center=(0, 0), clockwise=True), (0, 0)],
    "whole turn": [(2, 1), Arc((2, 1), center=(0, 1))],
    "through": [(1, 0), Arc((0, 1), through=("3/5", "4/5"))],
    "through, clockwise": [(0, 1), Arc((1, 0), through=(5, 7))],
    "nearly all": [(5, 0), Arc((3, -4), center=(0, 0))],
    "of an ellipse": [(2, 0), Arc((0, 1), center=(0, 0), conjugate=(0, 1)), (0, 0)],
    "of an ellipse, other way": [(2, 0), Arc((0, 1), center=(0, 0), conjugate=(0, 1), clockwise=True), (0, 0)],
    "of a slanted one": [(3, 1), Arc((1, 2), center=(0, 0), conjugate=(1, 2)), (0, 0)],
    "quadratic": [(0, 0), Bezier([(1, 0), (1, 1)])],
    "cubic": [(0, 0), Bezier([(2, 0), (2, 1), (0, 1)])],
    "spline of four": [(0, 0), Spline([(2, 0), (2, 2), (0, 2)])],
    "spline of seven": [(0, 0), Spline([(2, 0), (3, 1), (2, 2), (1, 3), (0, 2), (-1, 1)])],
}


@pytest.mark.parametrize("name", RINGS)
def test_exact_rings_are_what_is_given(name: str) -> None:
    ring = given_ring(RINGS[name])
    pieces = exact_ring(ring)
    exact = np.concatenate([points_of(piece, np.linspace(0, 1, 400)) for piece in pieces])
    for point in rim(ring, 64):
        assert np.hypot(*(exact - point).T).min() < 0.06
    many = rim(ring, 4000)
    for point in exact[::7]:
        assert np.hypot(*(many - point).T).min() < 0.02 or any(isinstance(piece, Line) for piece in pieces)
    for piece, after in zip(pieces, [*pieces[1:], *pieces[:1]], strict=True):
        end = piece.end if isinstance(piece, Line | Span) else piece.points[-1]
        start = after.start if isinstance(after, Line) else after.points[0] if isinstance(after, Cubic) else after.at(
            0, Fraction(0)
        )  # fmt: skip
        assert end == start  # exactly


def test_arcs_of_pythagorean_triples_end_where_they_are_said_to() -> None:
    rng = random.Random(5)
    for _ in range(200):
        m, n = rng.randrange(1, 50), rng.randrange(1, 50)
        a, b, c = m * m - n * n, 2 * m * n, m * m + n * n
        end = Fraction(a, c) * rng.choice([-1, 1]), Fraction(b, c) * rng.choice([-1, 1])
        for clockwise in (False, True):
            (span, *_) = exact_ring(given_ring([(1, 0), Arc(end, center=(0, 0), clockwise=clockwise), (0, 0)]))
            assert isinstance(span, Span) and span.end == end and 0 <= span.rest < 1
            sweep = span.quarters * math.pi / 2 + 2 * math.atan(span.rest)
            angle = math.atan2(-end[1] if clockwise else end[1], end[0]) % math.tau
            assert math.isclose(sweep, angle or math.tau, abs_tol=1e-12)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: cfree.Curved([(1, 0), Arc((0, "1.0001"), center=(0, 0)), (0, 0)]), "a point that it goes through"),
        (lambda: cfree.Curved([(1, 0), Arc((3, 0), through=(2, 0))]), "on one line"),
        (lambda: cfree.Curved([(0, 0), Arc((3, 0), center=(0, 0))]), "parallel, or 0"),
        (lambda: cfree.Curved([Arc((3, 0), center=(0, 0)), (0, 0)]), "begins with a point"),
        (lambda: cfree.Curved([]), "begins with a point"),
        (lambda: Arc((1, 0)), "give one of them"),
        (lambda: Arc((1, 0), through=(0, 1), center=(0, 0)), "give one of them"),
        (lambda: Arc((1, 0), through=(0, 1), clockwise=True), "about a center"),
        (lambda: Bezier([(1, 0)]), "2 or 3 points"),
        (lambda: Spline([(1, 0), (2, 0)]), "3 points or more"),
        (lambda: cfree.Curved.circle((0, 0), 0), "above 0"),
        (lambda: cfree.Curved.circle((0, 0), -1), "above 0"),
        (lambda: cfree.Curved.ellipse((0, 0), (1, 2, 3)), "2 radii"),
        (lambda: cfree.Curved([(0, 0), (2, 2), Arc((2, 0), through=(3, 1)), (0, 2)]), "cross"),
        (lambda: cfree.Curved([(0, 0), (1, 0), (1, 1)], grown=-1), "0 or more"),
        (lambda: cfree.Curved([(0, 0), (1, 0)], grown=1), "at least 3"),
        (lambda: cfree.Curved(Circle((0, 0), 1), grown=1), "of polygons only"),
    ],
)
def test_what_is_no_shape_is_refused(make: Any, message: str) -> None:
    with pytest.raises((cfree.InvalidPolygonError, cfree.UnsupportedError), match=message):
        make()
