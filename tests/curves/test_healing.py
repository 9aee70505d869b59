"""Arcs that are tangent but for rounding become exactly tangent."""

from __future__ import annotations

import cmath
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
from cfree.exact.number import rational_root


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


def has_rational_radius(arc: Span) -> bool:
    return rational_root(arc.u[0] ** 2 + arc.u[1] ** 2) is not None


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
    assert healed.path[2].center == (4, 1)  # type: ignore[union-attr,index]
    other, drawn = healed.curves[0][3], Curved(path).curves[0][3]
    assert isinstance(other, Span) and isinstance(drawn, Span)
    assert other.end == drawn.end and not has_rational_radius(drawn) and has_rational_radius(other)


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


# --- chains of arcs ---


def smooth_joints(shape: Curved) -> tuple[int, int]:
    """Joints at which an arc has no corner of more than 0.01, and how many of them are exactly smooth."""

    def direction(piece: Any, *, is_end: bool) -> tuple[Fraction, Fraction]:
        if isinstance(piece, Line):
            return piece.end[0] - piece.start[0], piece.end[1] - piece.start[1]
        (x, y), (a, b) = piece.end if is_end else piece.at(0, Fraction(0)), piece.center
        return piece.sense * (b - y), piece.sense * (x - a)

    joints = smooth = 0
    for curve in shape.curves:
        for before, after in zip((curve[-1], *curve), curve, strict=False):
            if isinstance(before, Span) or isinstance(after, Span):
                (a, b), (c, d) = direction(before, is_end=True), direction(after, is_end=False)
                joints += a * c + b * d > 0 and abs(float(a * d - b * c)) < 0.01 * float(a * c + b * d)
                smooth += a * c + b * d > 0 and a * d == b * c
    return joints, smooth


def chain_of(start: complex, angle: float, arcs: list[tuple[float, float]]) -> list[tuple[complex, complex]]:
    """Middles and ends of arcs, each by its radius and the angle that it turns, from a point and a direction."""
    items = list[tuple[complex, complex]]()
    for radius, turn in arcs:
        center = start + math.copysign(radius, turn) * cmath.rect(1, angle + math.pi / 2)
        middle, end = (center + (start - center) * cmath.rect(1, turn * share) for share in (0.5, 1.0))
        items.append((middle, end))
        start, angle = end, angle + turn
    return items


def path_of(
    points: list[complex], items: list[tuple[complex, complex]], after: list[complex], digits: int
) -> list[Any]:
    """A path of lines, arcs and lines, in decimals."""

    def decimal(z: complex) -> tuple[str, str]:
        return f"{z.real:.{digits}f}", f"{z.imag:.{digits}f}"

    arcs = [Arc(decimal(end), through=decimal(middle)) for middle, end in items]
    return [*map(decimal, points), *arcs, *map(decimal, after)]


BENDS = [(2.3, 1.1), (3.1, 0.7), (1.7, -0.9), (2.9, -0.4), (1.3, 1.6)]


@pytest.mark.parametrize("digits", [6, 9, 12])
@pytest.mark.parametrize("count", [1, 2, 3, 5])
@pytest.mark.parametrize("angle", [0.0, 0.3])
@pytest.mark.parametrize("ends", ["lines", "a line and a corner", "a corner and a line", "corners"])
def test_chains_of_arcs_in_decimals_become_tangent(digits: int, count: int, angle: float, ends: str) -> None:
    items = chain_of(0j, angle, BENDS[:count])
    last, turned = items[-1][1], angle + sum(turn for _, turn in BENDS[:count])
    before, after = -3 * cmath.rect(1, angle), last + 3 * cmath.rect(1, turned)
    points = [before, 0j] if ends in ("lines", "a line and a corner") else [0j]
    more = [after] if ends in ("lines", "a corner and a line") else []
    shape = Curved(path_of(points, items, [*more, last + 30j - 9, -40 + 40j, -30 - 3j], digits))
    joints = {"lines": count + 1, "corners": count - 1}.get(ends, count)
    healed = shape.healed(10.0 ** (3 - digits))
    assert smooth_joints(shape)[0] == joints == smooth_joints(healed)[0]
    assert smooth_joints(healed)[1] == joints, smooth_joints(shape)
    for one, other in zip(shape.curves[0], healed.curves[0], strict=True):
        assert math.dist(map(float, one.end), map(float, other.end)) <= 10.0 ** (3 - digits)  # type: ignore[union-attr]
    again = healed.healed(10.0 ** (3 - digits))
    assert smooth_joints(again)[1] == joints


OVAL = [(1.9, 0.8), (0.7, math.pi - 0.8)] * 2
CIRCLE = [(1.3, 2.1), (1.3, 1.9), (1.3, math.tau - 4.0)]
HALVES = [(1.7, math.pi - 0.4), (1.7, math.pi + 0.4)]


@pytest.mark.parametrize("digits", [6, 9, 12])
@pytest.mark.parametrize("arcs", [OVAL, CIRCLE, HALVES], ids=["oval", "circle", "circle of two arcs"])
def test_closed_chains_become_tangent(digits: int, arcs: list[tuple[float, float]]) -> None:
    items = chain_of(1 + 2j, 0.3, arcs)
    path = path_of([1 + 2j], [*items[:-1], (items[-1][0], 1 + 2j)], [], digits)
    shape = Curved(path)
    healed = shape.healed(10.0 ** (3 - digits))
    assert smooth_joints(shape)[1] < len(arcs) and smooth_joints(healed) == (len(arcs), len(arcs))
    assert max(abs(float(a - b)) for a, b in zip(shape.box, healed.box, strict=True)) < 10.0 ** (4 - digits)


def test_arcs_that_are_tangent_stay() -> None:
    """Two half discs side by side, and an S of two arcs: exactly tangent already."""
    path = [(0, 0), Arc((4, 0), center=(2, 0), clockwise=True), Arc((8, 0), center=(6, 0)), (8, -3), (0, -3)]
    assert Curved(path).healed(1e-3).path == Curved(path).path


# --- arcs between corners ---


def with_arcs(seed: int) -> Curved:
    """A ring of lines and arcs through doubles with a corner at each joint, convex and concave, small and large."""
    r = random.Random(seed)
    while True:
        count = r.randint(2, 6)
        far = r.choice([0, 0, 1000])
        points = [(1 + r.random()) * cmath.exp(math.tau * 1j * (k + 0.6 * r.random()) / count) for k in range(count)]
        points = [complex(round(z.real, 4) + far, round(z.imag, 4)) for z in points]
        path: list[Any] = [(points[0].real, points[0].imag)]
        for p, q in zip(points, [*points[1:], points[0]], strict=True):
            rise = r.choice([r.uniform(-0.2, 0.45), 0.9])
            m = (p + q) / 2 - 1j * (abs(rise) if count == 2 else rise) * (q - p)
            end = (q.real, q.imag)
            path.append(Arc(end, through=(m.real, m.imag)) if count == 2 or r.random() < 0.6 else end)
        try:
            return Curved(path)
        except cfree.CfreeError:
            continue


@pytest.mark.parametrize("seed", range(12))
def test_arcs_between_corners_get_rational_radii_and_keep_their_ends(seed: int) -> None:
    tolerance = 10.0 ** -random.Random(seed).randint(4, 12)
    drawn = with_arcs(seed)
    healed = drawn.healed(tolerance)
    for before, after in zip(drawn.curves[0], healed.curves[0], strict=True):
        if not isinstance(before, Span):
            assert after == before
            continue
        assert isinstance(after, Span) and has_rational_radius(after)
        assert after.end == before.end and after.at(0, Fraction(0)) == before.at(0, Fraction(0))
        middles = [_middle(arc) for arc in (before, after)]
        assert math.dist(*middles) <= tolerance + 1e-13 * max(map(abs, middles[0]))
    assert healed.healed(tolerance) == healed


def _middle(arc: Span) -> tuple[float, float]:
    c, s = math.cos(arc.sweep / 2), math.sin(arc.sweep / 2)
    x, y = (float(o) + c * float(p) + s * float(q) for o, p, q in zip(arc.center, arc.u, arc.v, strict=True))
    return x, y
