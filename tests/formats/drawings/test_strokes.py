"""Walls of lines: never less than drawn, exact along the axes, and closed lines enclose nothing."""

import math
import random
from fractions import Fraction

import numpy as np
import pytest
import shapely

from cfree.curves.drawn import Cubic, Line, Ring, bulged, point_of
from cfree.errors import FormatError
from cfree.formats.drawings.content import Curve
from cfree.formats.drawings.source import Reading, Source
from cfree.formats.drawings.strokes import wall, walls


def chain(points: list[tuple[float, float]], closed: bool = False) -> Ring:
    after = [*points[1:], points[0]] if closed else points[1:]
    return [Line(point_of(*a), point_of(*b)) for a, b in zip(points, after, strict=False)]


def made(curve: Curve, strokes: object = "drawn") -> tuple[shapely.Geometry, Source]:
    source = Source("a.dxf", reading=Reading(strokes=strokes))  # type: ignore[arg-type]
    return shapely.unary_union([polygon.to_shapely() for polygon in walls(source, [curve], "A-WALL")]), source


def test_walls_along_the_axes_are_exact() -> None:
    curve = Curve(chain([(0, 0), (3, 0), (3, 2)]), width=0.2, cap="butt", join="miter")
    first, second = walls(Source("a", reading=Reading(strokes="drawn")), [curve])
    tenth = Fraction(1, 10)
    assert set(first.exact_vertices) == {(0, -tenth), (0, tenth), (3 + tenth, -tenth), (3, tenth)}
    assert second.exact_area == 2 * 2 * tenth + tenth * tenth


@pytest.mark.slow
def test_walls_contain_the_strokes_as_they_are_drawn() -> None:
    rng = random.Random(42)
    styles = {"butt": "flat", "square": "square", "round": "round"}
    joins = {"miter": "mitre", "round": "round", "bevel": "bevel"}
    for _ in range(150):
        turn, points = rng.uniform(0, 6), [(0.0, 0.0)]
        for _ in range(rng.randint(1, 5)):
            turn += rng.uniform(-1.7, 1.7)
            points.append((points[-1][0] + 4 * math.cos(turn), points[-1][1] + 4 * math.sin(turn)))
        width, cap, join = rng.uniform(0.01, 1), rng.choice(list(styles)), rng.choice(list(joins))
        came, _ = made(Curve(chain(points), width=width, cap=cap, join=join))  # type: ignore[arg-type]
        line = shapely.LineString(points)
        drawn = line.buffer(width / 2, cap_style=styles[cap], join_style=joins[join], mitre_limit=9)
        assert drawn.difference(came.buffer(1e-9)).area < 1e-9
        assert came.difference(line.buffer(2.2 * width)).area == 0
        grown, _ = made(Curve(chain(points)), width)
        assert line.buffer(width / 2, quad_segs=64).difference(grown.buffer(1e-9)).area < 1e-9
        assert grown.difference(line.buffer(width / 2 + width / 8, quad_segs=64)).area < 1e-9


@pytest.mark.slow
def test_walls_of_curves_contain_their_strokes() -> None:
    curve = Cubic(((0, 0), (3, 6), (5, -4), (8, 1)))
    t = np.linspace(0, 1, 501)[:, None]
    shares = np.hstack([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3])
    points = shares @ np.array(curve.points)
    came, source = made(Curve([curve], width=0.4))
    line = shapely.LineString(points)
    assert line.buffer(0.2, cap_style="flat").difference(came).area < 1e-6
    (near,) = (note for note in source.notes if note.kind == "near")
    assert near.kind == "near" and near.size is not None
    assert came.difference(line.buffer(0.2 + 1.2 * near.size, quad_segs=64)).area == 0


def test_an_arc_narrower_than_its_wall_is_filled_to_beyond_its_center() -> None:
    came, _ = made(Curve([bulged((0, 0), (2, 0), 1.0)], width=3, cap="butt"))
    assert came.contains(shapely.Point(1, 0.4))  # half the width is more than the radius


def test_closed_lines_enclose_nothing_solid() -> None:
    came, _ = made(Curve(chain([(0, 0), (10, 0), (10, 10), (0, 10)], True), True), 0.5)
    assert len(came.interiors) == 1 and came.interiors[0].is_ccw in (True, False)
    assert shapely.Polygon(came.interiors[0]).area == 9.5**2


def test_sharp_corners_beyond_the_limit_of_mitres_are_round() -> None:
    came, _ = made(Curve(chain([(0, 0), (10, 0), (0, 0.5)]), width=1, cap="butt"))
    assert came.bounds[2] == pytest.approx(10.5, abs=0.05)


def test_widths_that_vary_are_trapezoids() -> None:
    source = Source("a")
    (polygon,) = wall(source, Curve(chain([(0, 0), (4, 0)]), cap="butt"), [(2.0, 0.0)], "drawn")
    assert set(polygon.exact_vertices) == {(0, -1), (0, 1), (4, 0)}


def test_lines_without_walls_are_noted_with_count_length_and_remedy() -> None:
    lines = [Curve(chain([(0, 0), (12, 0)]), handle="6E"), Curve(chain([(0, 1), (3, 1)]))]
    for strokes, what in (("ignore", "open line"), ("drawn", "line without a width")):
        source = Source("a.dxf", reading=Reading(strokes=strokes))  # type: ignore[arg-type]
        assert walls(source, lines, "A-WALL") == []
        (note,) = source.notes
        assert (note.kind, note.what, note.effect, note.count) == ("lost", what, "less", 2)
        assert (note.where, note.size, note.at, note.remedy) == ("A-WALL", 12, (0, 0), "--strokes 0.1")
        assert note.items[0].handle == "6E"


@pytest.mark.slow
def test_a_thin_line_around_a_curve_takes_few_pieces() -> None:
    curve = Cubic(((0, 0), (300, 600), (500, -400), (800, 100)))
    source = Source("a.dxf", reading=Reading(strokes=1e-9))
    assert len(walls(source, [Curve([curve])])) < 2000


def test_an_arc_far_larger_than_its_tolerance_is_refused() -> None:
    source = Source("a.svg", reading=Reading(strokes=1.0, tolerance=1e-9))
    with pytest.raises(FormatError, match="elements and points"):
        walls(source, [Curve([bulged((0.0, 0.0), (1e140, 0.0), 1.0)])])
