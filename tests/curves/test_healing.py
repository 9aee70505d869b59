"""Arcs that are tangent but for rounding become exactly tangent."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from typing import Any

import pytest

import cfree
from cfree import Curved, Pose, Scene
from cfree.curves import Arc, Bezier
from cfree.curves.drawn import Line
from cfree.curves.rings import Span


def tangent_joints(shape: Curved) -> tuple[int, int]:
    """Joints of a line and an arc, and how many of them are exactly smooth."""
    joints = smooth = 0
    for curve in shape.curves:
        for k, piece in enumerate(curve):
            for arc, line, at in ((piece, curve[k - 1], "start"), (curve[k - 1], piece, "end")):
                if isinstance(arc, Span) and isinstance(line, Line):
                    place = arc.at(0, Fraction(0)) if at == "start" else arc.end
                    radius = place[0] - arc.center[0], place[1] - arc.center[1]
                    along = line.end[0] - line.start[0], line.end[1] - line.start[1]
                    joints += 1
                    smooth += radius[0] * along[0] + radius[1] * along[1] == 0
    return joints, smooth


def rounded_polygon(points: list[tuple[float, float]], radius: float, digits: int) -> list[Any]:
    """A polygon with rounded corners, in decimals as a drawing has them."""
    path: list[Any] = []
    count = len(points)

    def decimal(z: complex) -> tuple[str, str]:
        return f"{z.real:.{digits}f}", f"{z.imag:.{digits}f}"

    for k in range(count):
        p, m, q = (complex(*points[j % count]) for j in (k - 1, k, k + 1))
        d, e = (m - p) / abs(m - p), (q - m) / abs(q - m)
        turn = math.atan2((d.conjugate() * e).imag, (d.conjugate() * e).real)
        length = radius * abs(math.tan(turn / 2))
        side = 1j if turn > 0 else -1j
        center = m - length * d + radius * side * d
        middle = center + radius * (m - center) / abs(m - center)
        start, end = m - length * d, m + length * e
        path += [decimal(start), Arc(decimal(end), through=decimal(middle))]
    return path


@pytest.mark.parametrize("digits", [6, 9, 12])
def test_rounded_corners_in_decimals_become_tangent(digits: int) -> None:
    shape = Curved(rounded_polygon([(0, 0), (5, 0), (6, 3), (3, 1.7), (0.3, 4)], 0.25, digits))
    healed = shape.healed(10.0 ** (3 - digits))
    assert tangent_joints(shape)[1] < 10 and tangent_joints(healed) == (10, 10)
    radii = {math.sqrt(piece.u[0] ** 2 + piece.u[1] ** 2) for piece in healed.curves[0] if isinstance(piece, Span)}
    assert radii == {0.25}
    for one, other in zip(shape.curves[0], healed.curves[0], strict=True):
        assert math.dist(map(float, one.end), map(float, other.end)) < 10.0 ** (5 - digits)  # type: ignore[union-attr]


def test_random_polygons_become_tangent() -> None:
    rng, count = random.Random(3), 0
    for _ in range(20):
        angles = sorted(rng.uniform(0, 2 * math.pi) for _ in range(5))
        if min(b - a for a, b in zip(angles, [*angles[1:], angles[0] + 2 * math.pi], strict=True)) < 0.5:
            continue
        points = [(3 * math.cos(t), 3 * math.sin(t)) for t in angles]
        healed = Curved(rounded_polygon(points, 0.1, 10)).healed(1e-7)
        assert tangent_joints(healed) == (10, 10)
        count += 1
    assert count > 3


def test_a_stadium_by_bulges_becomes_one_of_its_width() -> None:
    """Half turns between parallel lines, whose middle points are rounded."""
    ends = ("2", "0.9999999999"), ("0", "1")
    path = [
        ("0", "-1"),
        ("2", "-1"),
        Arc(ends[0], through=("3.0000000001", "0")),
        ends[1],
        Arc((0, -1), through=("-1", "1e-11")),
    ]
    with_corners = Curved(path)
    exact = Curved([(0, -1), (2, -1), Arc((2, 1), center=(2, 0)), (0, 1), Arc((0, -1), center=(0, 0))])
    corridor = [[(-9, 1), (9, 1), (9, 3), (-9, 3)], [(-9, -3), (9, -3), (9, -1), (-9, -1)]]
    assert not cfree.is_free(Scene(with_corners, corridor), Pose(0, 0))
    healed = with_corners.healed(1e-8)
    assert tangent_joints(healed) == (4, 4)
    assert math.isclose(float(healed.box[3] - healed.box[1]), float(exact.box[3] - exact.box[1]), abs_tol=1e-8)


def test_half_turns_in_two_arcs_become_tangent() -> None:
    """A rounded box whose corners meet, as SVG draws it."""
    path = [
        (0, 0),
        (6, 0),
        Arc((8, "2.000000000001"), through=("7.41421356237", "0.58578643763")),
        Arc((6, 4), through=("7.41421356237", "3.41421356237")),
        (0, 4),
    ]
    healed = Curved(path).healed(1e-9)
    assert tangent_joints(healed) == (2, 2)
    assert [piece.center for piece in healed.curves[0] if isinstance(piece, Span)] == [(6, 2)]


def test_exactly_tangent_arcs_stay_at_any_tolerance() -> None:
    radius = Fraction("0.30000000001")
    path = [(0, 0), (2 - radius, 0), Arc((2, radius), center=(2 - radius, radius)), (2, 3), (0, 3)]
    for tolerance in (1e-9, 1e-3, 10.0, 1e300):
        assert Curved(path).healed(tolerance).path == Curved(path).path


@pytest.mark.parametrize("tolerance", [1e-5, 0.1, 1e9])
def test_no_end_moves_farther_than_the_rounding_needs(tolerance: float) -> None:
    shape = Curved(rounded_polygon([(0, 0), (5, 0), (6, 3), (3, 1.7), (0.3, 4)], 0.25, 7))
    healed = shape.healed(tolerance)
    assert tangent_joints(healed) == (10, 10)
    for one, other in zip(shape.curves[0], healed.curves[0], strict=True):
        assert math.dist(map(float, one.end), map(float, other.end)) < 2e-6  # type: ignore[union-attr]


def test_arcs_that_need_more_stay_and_others_are_healed() -> None:
    path = [
        (0, 0),
        (4, 0),
        Arc(("5", "1"), through=("4.70710678", "0.29289322")),
        (5, 4),
        Arc((4, 5), through=("4.71", "4.71")),
        (0, 5),
    ]
    healed = Curved(path).healed(1e-6)
    assert tangent_joints(healed) == (4, 2)
    assert healed.path[2].center == (4, 1) and healed.curves[0][3] == Curved(path).curves[0][3]  # type: ignore[union-attr,index]


def test_what_is_not_nearly_tangent_stays() -> None:
    bay = Curved([(-2, -2), (2, -2), (2, 0), (1, 0), Arc((-1, 0), center=(0, 0), clockwise=True), (-2, 0)])
    assert bay.healed().path == bay.path
    disc = Curved.circle((0, 0), 1)
    assert disc.healed() == disc
    curve = Curved([(0, 0), (3, 0), Bezier([(4, 1), (3, 3)]), (0, 3)])
    assert curve.healed() == curve
    grown = Curved([(0, 0), (1, 0), (0, 1)], grown=1)
    assert grown.healed() is grown
    with pytest.raises(ValueError, match="tolerance"):
        disc.healed(0)
