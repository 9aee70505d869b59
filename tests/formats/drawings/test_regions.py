"""Regions of drawings: curves of a layer enclose what they enclose, however they are cut, doubled or ordered."""

import math
import random
from fractions import Fraction
from itertools import pairwise

import pytest
import shapely
from shapely.ops import polygonize

from cfree.curves.drawn import Arc, Cubic, Line, Ring, arc_of_circle, bulged, reversed_ring
from cfree.curves.hulls import Outline, polygon_of
from cfree.errors import InvalidPolygonError
from cfree.formats.drawings import regions
from cfree.formats.drawings.content import Curve
from cfree.formats.drawings.regions import clipped, filled_outlines
from cfree.formats.drawings.source import Reading, Source
from cfree.polygons import noding
from cfree.polygons.polygon import Polygon
from enclosures import (
    area,
    box,
    changed,
    closed,
    edges,
    is_connected,
    is_in,
    lines,
    notes,
    outlines,
    pieces,
    point,
    region,
    ring,
    sweep,
)


def filled(rings: list[Ring], even_odd: bool = False, **options: object) -> list[Polygon]:
    source = Source("a.svg", reading=Reading(**options))  # type: ignore[arg-type]
    return [polygon_of(outline, 0.01) for outline in filled_outlines(source, rings, even_odd)]


# --- filled rings ---

STAR = ring(
    *(
        (round(50 + 40 * math.sin(k * 0.8 * math.pi), 3), round(50 + 40 * math.cos(k * 0.8 * math.pi), 3))
        for k in range(5)
    )
)


def test_a_pentagram_is_whole_by_nonzero_and_hollow_by_even_odd() -> None:
    whole, hollow = filled([STAR]), filled([STAR], True)
    assert len(whole) == 1
    assert len(whole[0].exact_rings[0]) == 10
    assert len(hollow) == 5  # five tips, which touch in points
    shape = shapely.Polygon([tuple(map(float, s.start)) for s in STAR])  # type: ignore[union-attr]
    assert area(hollow) == pytest.approx(shapely.make_valid(shape).area)


@pytest.mark.parametrize("even_odd", [False, True])
def test_spikes_and_repeated_points_vanish(even_odd: bool) -> None:
    spiky = ring((0, 0), (4, 0), (4, 0), (9, 0), (4, 0), (4, 4), (2, 4), (2, 7), (2, 4), (0, 4))
    assert edges(filled([spiky], even_odd)) == edges([Polygon([(0, 0), (4, 0), (4, 4), (0, 4)])])


def test_overlapping_subpaths_are_united_by_nonzero() -> None:
    a, b = box(0, 0, 4, 4), box(2, 2, 4, 4)
    assert area(filled([a, b])) == 28
    assert area(filled([a, b], True)) == 24
    assert area(filled([a, reversed_ring(b)])) == 24


def test_a_ring_within_another_is_a_hole_by_its_direction() -> None:
    a, b = box(0, 0, 4, 4), box(1, 1, 2, 2)
    assert [area(filled([a, inner])) for inner in (b, reversed_ring(b))] == [16, 12]
    assert area(filled([a, b], True)) == 12


def test_a_ring_on_a_line_is_noted() -> None:
    source = Source("a.svg")
    assert not filled_outlines(source, [ring((0, 0), (4, 0), (2, 0))], False)
    assert notes(source) == {"lost ring on a line: it forbids nothing; give it width": 1}


def test_without_repair_a_ring_that_crosses_itself_is_refused() -> None:
    with pytest.raises(InvalidPolygonError, match=r"crosses or touches itself at .*--repair"):
        filled([ring((0, 0), (4, 4), (4, 0), (0, 4))], repair=False)
    assert filled([box(0, 0, 1, 1)], repair=False)
    with pytest.raises(InvalidPolygonError, match="--repair"):
        outlines(closed(ring((0, 0), (4, 4), (4, 0), (0, 4))), repair=False)


@pytest.mark.parametrize("seed", range(6))
def test_random_rings_are_filled_by_their_rule(seed: int) -> None:
    rng = random.Random(seed)
    points = [(rng.randrange(30), rng.randrange(30)) for _ in range(12)]
    points = [p for k, p in enumerate(points) if p != points[k - 1]]
    by_parity, by_winding = filled([ring(*points)], True), filled([ring(*points)])
    for _ in range(200):
        x, y = rng.uniform(0, 30), rng.uniform(0, 30)
        winding = 0
        for (x0, y0), (x1, y1) in zip(points, [*points[1:], points[0]], strict=True):
            if (y0 > y) != (y1 > y) and x < x0 + (y - y0) * (x1 - x0) / (y1 - y0):
                winding += 1 if y1 > y0 else -1
        assert is_in(by_parity, (x, y)) == (winding % 2 == 1)
        assert is_in(by_winding, (x, y)) == (winding != 0)


# --- curves of a layer ---

SQUARE = {"square": Polygon([(0, 0), (40, 0), (40, 40), (0, 40)])}
TAILS = [(0, 0, -9, -7), (40, 20, 47, 20)]
DRAWN = {
    "pieces": pieces(box(0, 0, 40, 40)),
    "overshoots": lines((-3, 0, 43, 0), (40, -2, 40, 44), (45, 40, -1, 40), (0, 41, 0, -5)),
    "overlaps": lines((0, 0, 30, 0), (20, 0, 40, 0), (40, 0, 40, 40), (40, 40, 5, 40), (10, 40, 0, 40), (0, 40, 0, 0)),
    "tails": [*pieces(box(0, 0, 40, 40)), *lines(*TAILS)],
    "rooms": [*pieces(box(0, 0, 40, 40)), *lines((13, 0, 13, 40), (13, 20, 40, 20))],
    "twice": [*pieces(box(0, 0, 40, 40)), *pieces(reversed_ring(box(0, 0, 40, 40)))],
    "rounded again": [*pieces(box(0, 0, 40, 40)), *pieces(box(4e-6, -4e-6, 40, 40))],
    "missed corner": lines((0, 0, 40, 0), (40, "0.00003", 40, 40), (40, 40, 0, 40), (0, 40, 0, "0.00002")),
    "short of a side": [*pieces(box(0, 0, 40, 40)), *lines((10, "0.00002", 10, 40))],
    "closed": closed(box(0, 0, 40, 40)),
    "closed twice": closed(box(0, 0, 40, 40), reversed_ring(box(0, 0, 40, 40))),
    "closed and in pieces": [*closed(box(0, 0, 40, 40)), *pieces(box(0, 0, 40, 40))],
    "a closed ring, and a wall in it": [*closed(box(0, 0, 40, 40)), *lines((10, 0, 10, 40))],
    "a closed ring, and lines that go on": [
        *closed(box(0, 0, 40, 20)),
        *lines((0, 20, 0, 40), (0, 40, 40, 40), (40, 40, 40, 20)),
    ],
    "rooms side by side": closed(box(0, 0, 10, 40), box(10, 0, 30, 15), box(10, 15, 30, 25)),
    "rings that overlap": closed(box(0, 0, 40, 25), box(0, 20, 40, 20)),
}


@pytest.mark.parametrize("name", DRAWN)
def test_a_square_is_a_square_however_it_is_drawn(name: str) -> None:
    found = region(DRAWN[name])
    assert area(found) == pytest.approx(1600, abs=1e-3)
    if "corner" not in name and "short" not in name and "rounded" not in name and "side by side" not in name:
        assert edges(found) == edges(SQUARE.values())


@pytest.mark.parametrize("name", DRAWN)
def test_what_encloses_nothing_is_noted(name: str) -> None:
    lost = {key: count for key, count in notes(outlines(DRAWN[name])[1]).items() if key.startswith("lost")}
    expected = {"tails": {"lost open line": 2}, "overshoots": {"lost open line": 4}}
    assert lost == expected.get(name, {})


@pytest.mark.parametrize(
    ("curves", "expected"),
    [
        pytest.param(
            closed(box(0, 0, 90, 90), box(10, 10, 70, 70), box(20, 20, 10, 10)), 8100 - 4900 + 100, id="nested"
        ),
        pytest.param(pieces(box(0, 0, 90, 90), box(10, 10, 70, 70), box(20, 20, 10, 10)), 8100 - 4900 + 100, id="soup"),
        pytest.param(
            closed(box(0, 0, 90, 90), ring((0, 0), (45, 18), (27, 54))), 8100 - 972, id="hole touches a corner"
        ),
        pytest.param(closed(box(0, 0, 90, 90), box(0, 10, 20, 20)), 8100 - 400, id="hole shares a part of a side"),
        pytest.param(
            closed(box(0, 0, 90, 90), box(10, 10, 20, 20), box(30, 10, 20, 20)), 8100 - 800, id="holes side by side"
        ),
        pytest.param(
            closed(box(0, 0, 90, 90), box(20, 20, 20, 20), box(30, 30, 20, 20)), 8100 - 600, id="holes that overlap"
        ),
        pytest.param(closed(box(0, 0, 9, 9), box(20, 0, 9, 9)), 162, id="neighbours"),
        pytest.param([*pieces(box(0, 0, 90, 90)), *closed(box(10, 10, 20, 20))], 8100 - 400, id="lines around a ring"),
        pytest.param(
            [*closed(box(0, 0, 90, 90), box(40, 40, 9, 9)), *lines((-9, 44, 99, 44))],
            8100 - 81,
            id="a line across a hole",
        ),
        pytest.param(lines((0, 0, 9, 0), (9, 0, 9, 9)), 0, id="open"),
    ],
)
def test_rings_nest(curves: list[Curve], expected: float) -> None:
    assert area(region(curves)) == expected


def test_a_ring_around_overlapping_rings_is_no_hole() -> None:
    _, source = outlines(closed(box(0, 0, 90, 90), box(20, 20, 20, 20), box(30, 30, 20, 20)))
    (note,) = source.notes
    assert (note.kind, note.effect, note.count, note.where) == ("guess", "more", 2, "A")
    assert note.at is not None


@pytest.mark.parametrize("seed", range(12))
def test_soups_enclose_the_same_however_they_are_drawn(seed: int) -> None:
    rng = random.Random(seed)
    curves = pieces(
        *(box(rng.randrange(30), rng.randrange(30), rng.randrange(1, 9), rng.randrange(1, 9)) for _ in range(6))
    )
    for _ in range(12):
        x, y = rng.randrange(30), rng.randrange(30)
        curves += lines((x, y, x + rng.randrange(1, 9), y + rng.randrange(-8, 9)))
    before = region(curves, join=0)
    for _ in range(3):
        assert edges(region(changed(rng, curves), join=0)) == edges(before)


@pytest.mark.parametrize("seed", range(8))
def test_connected_soups_enclose_all_their_faces(seed: int) -> None:
    rng = random.Random(seed)
    curves = lines(
        *((rng.randrange(12), rng.randrange(12), 20 + rng.randrange(9), rng.randrange(30)) for _ in range(14))
    )
    drawn = [
        [tuple(map(float, end)) for end in (s.start, s.end)] for c in curves for s in c.segments if isinstance(s, Line)
    ]
    union = shapely.unary_union([shapely.LineString(line) for line in drawn])
    hulls = shapely.unary_union([shapely.Polygon(part.exterior) for part in polygonize(union)])
    around = [shapely.Polygon(part.exterior) for part in getattr(hulls, "geoms", [hulls])]
    assert area(region(curves, join=0)) == pytest.approx(sum(part.area for part in around))


def test_a_line_that_divides_a_hole_is_noted() -> None:
    curves = [*closed(box(0, 0, 90, 90), box(10, 10, 70, 70)), *lines((40, 10, 40, 80))]
    found, source = outlines(curves)
    assert area(polygon_of(outline, 0.01) for outline in found) == 8100 - 4900
    assert notes(source) == {"lost line between free regions": 1}


def test_a_ring_that_crosses_itself_is_solid_as_a_whole_but_a_hole_only_where_it_is_odd() -> None:
    alone = region(closed(STAR))
    assert area(alone) == area(filled([STAR]))
    within = region(closed(box(0, 0, 100, 100), STAR))
    assert area(within) == pytest.approx(10_000 - area(filled([STAR], True)))
    _, source = outlines(closed(STAR))
    assert list(notes(source)) == ["guess outline that crosses or touches itself: all that it encloses"]


def test_an_ambiguous_workspace_gets_the_least() -> None:
    overlapping = closed(box(0, 0, 40, 25), box(0, 20, 40, 20))
    assert area(region(overlapping, workspace=True)) == 1600 - 200
    assert area(region(closed(STAR), workspace=True)) == area(filled([STAR], True))
    pocket = DRAWN["a closed ring, and lines that go on"]
    assert area(region(pocket, workspace=True)) == 800


def test_outlines_beside_hatches_are_solid_unless_hatches_alone_are() -> None:
    curves = closed(box(0, 0, 4, 4))
    assert area(region(curves, hatched=True)) == 16
    found, source = outlines(curves, hatched=True, fills="hatches")
    assert not found
    assert [note.kind for note in source.notes] == ["assumption"]


def test_a_layer_that_crosses_too_often_is_left_out_and_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(noding, "MOST_MEETINGS", 500)
    found, source = outlines(lines(*((k, 0, 100 - k, 50) for k in range(50))))
    assert not found
    (note,) = source.notes
    assert (note.kind, note.count, note.remedy) == ("lost", 50, "--role A=ignore")


# --- arcs ---

B = math.tan(math.pi / 8)


def rounded(x: float, y: float, w: float, h: float, r: float) -> Ring:
    xs, ys = [round(v, 6) for v in (x, x + r, x + w - r, x + w)], [round(v, 6) for v in (y, y + r, y + h - r, y + h)]
    tips = [
        (xs[1], ys[0]),
        (xs[2], ys[0]),
        (xs[3], ys[1]),
        (xs[3], ys[2]),
        (xs[2], ys[3]),
        (xs[1], ys[3]),
        (xs[0], ys[2]),
        (xs[0], ys[1]),
    ]
    result: Ring = []
    for k, a in enumerate(tips):
        b = tips[(k + 1) % 8]
        result.append(bulged(a, b, B) if k % 2 else Line(point(*a), point(*b)))
    return result


@pytest.mark.parametrize("draw", [closed, pieces])
def test_lines_and_arcs_stay_lines_and_arcs(draw: object) -> None:
    (outline,), _ = outlines(draw(rounded(10, 10, 40, 30, 5)))  # type: ignore[operator]
    assert sum(isinstance(segment, Line) for segment in outline.outer) == 4
    assert sum(isinstance(segment, Arc) for segment in outline.outer) == 4
    assert sweep(outline.outer) == pytest.approx(math.tau)
    assert is_connected(outline.outer)


def test_a_circle_stays_a_circle() -> None:
    (outline,), _ = outlines(closed(box(0, 0, 100, 100), [arc_of_circle((50, 50), 20)]))
    assert [type(segment) for hole in outline.holes for segment in hole] == [Arc]
    assert sweep(outline.holes[0]) == math.tau


def test_arcs_that_are_drawn_twice_in_parts_are_one_outline() -> None:
    whole, half = [arc_of_circle((50, 50), 20)], [arc_of_circle((50, 50), 20, 1, 4)]
    found, source = outlines([*closed(whole), *pieces(half), *pieces([arc_of_circle((50, 50), 20, 3, 0.5)])])
    assert len(found) == 1
    assert sweep(found[0].outer) == pytest.approx(math.tau)
    assert not [note for note in source.notes if note.kind == "lost"]


def test_arcs_cut_by_lines_end_on_the_lines() -> None:
    curves = [*pieces([arc_of_circle((0, 0), 20, 0.1, 3)]), *lines((-30, 4, 30, 5))]
    (outline,), _ = outlines(curves)
    kinds = sorted(type(segment).__name__ for segment in outline.outer)
    assert kinds == ["Arc", "Line"]
    (arc,) = (segment for segment in outline.outer if isinstance(segment, Arc))
    for t in (arc.first, arc.last):
        x, y = arc.at(t)
        assert y == pytest.approx(4.5 + x / 60, abs=1e-9)
    assert is_connected(outline.outer)


def test_lines_that_end_on_arcs_are_joined_to_them() -> None:
    angle = 0.7
    x, y = (round(20 * value, 6) for value in (math.cos(angle), math.sin(angle)))
    curves = [*pieces([arc_of_circle((0, 0), 20, 0, math.pi)]), *lines((x, y, x, 0), (x, 0, -20, 0))]
    found, source = outlines(curves)
    expected = 200 * (math.pi - angle) + x * y / 2
    assert area(polygon_of(outline, 0.01) for outline in found) == pytest.approx(expected, rel=2e-3)
    assert notes(source)["lost open line"] == 1  # the rest of the arc


def test_an_arc_that_is_a_point_is_no_circle() -> None:
    half, speck = [arc_of_circle((0, 0), 20, 0, math.pi)], [arc_of_circle((0, 0), 20, 1, 1 + 1e-9)]
    curves = [Curve(part, False, "", 1e-6) for part in (half, speck)]
    found, _ = outlines([*curves, *lines((-20, 0, 20, 0))])
    assert area(polygon_of(outline, 0.01) for outline in found) == pytest.approx(200 * math.pi, rel=1e-2)


def test_thin_rings_between_circles_keep_their_hole() -> None:
    (outline,), _ = outlines(closed([arc_of_circle((0, 0), 50)], [arc_of_circle((0.0003, 0), 49.999)]))
    assert [sweep(part) for part in outline.rings] == [math.tau, math.tau]


def test_bezier_curves_stay_bezier_curves() -> None:
    curve = Cubic(((0, 0), (0, 30), (40, 30), (40, 0)))
    (outline,), _ = outlines([*pieces([curve]), *pieces([curve]), *lines((0, 0, 40, 0))])
    assert sorted(type(segment).__name__ for segment in outline.outer) == ["Cubic", "Line"]


@pytest.mark.parametrize("seed", range(6))
def test_polygons_contain_every_drawn_point_of_an_obstacle(seed: int) -> None:
    rng = random.Random(seed)
    rings = [
        rounded(10 * k, rng.uniform(0, 9), rng.uniform(8, 20), rng.uniform(8, 20), rng.uniform(1, 3)) for k in range(4)
    ]
    found = shapely.unary_union([polygon.to_shapely() for polygon in region(closed(*rings))])
    for outline in rings:
        for segment in outline:
            if isinstance(segment, Arc):
                samples = [segment.at(segment.first + (segment.last - segment.first) * k / 16) for k in range(17)]
                assert all(found.distance(shapely.Point(p)) < 1e-6 for p in samples)


@pytest.mark.parametrize("turn", [1, -1])
def test_arcs_of_one_circle_keep_their_direction(turn: int) -> None:
    def disc(radius: float, sense: int) -> Ring:
        angles = [sense * math.tau * k / 3 for k in range(4)]
        return [arc_of_circle((0, 0), radius, *pair) for pair in pairwise(angles)]

    assert area(filled([disc(5, turn), disc(3, -turn)])) == pytest.approx(16 * math.pi, rel=0.01)
    assert area(filled([disc(5, turn), disc(3, turn)])) == pytest.approx(25 * math.pi, rel=0.01)


# --- clips ---


def area_of(found: list[Outline]) -> float:
    return area(polygon_of(outline, 0.01) for outline in found)


def test_clips_are_exact() -> None:
    plate = Outline(box(0, 0, 10, 10), (box(2, 2, 4, 4),))
    clip = Outline(ring((1, 1), ("20", 1), (1, "20")))
    third = clipped(Source("a.svg"), [plate], [clip])
    shape = shapely.Polygon([(0, 0), (10, 0), (10, 10), (0, 10)], [[(2, 2), (6, 2), (6, 6), (2, 6)]])
    assert area_of(third) == pytest.approx(shape.intersection(shapely.Polygon([(1, 1), (20, 1), (1, 20)])).area)
    assert all(isinstance(value, Fraction) for o in third for s in o.outer if isinstance(s, Line) for value in s.start)


def test_clips_unite_their_members_and_keep_arcs() -> None:
    left, right = Outline(box(0, 0, 6, 10)), Outline(box(4, 0, 6, 10))
    disc = Outline([arc_of_circle((5, 5), 4)])
    (outline,) = clipped(Source("a.svg"), [disc], [left, right])
    assert [type(segment) for segment in outline.outer] == [Arc]
    assert not clipped(Source("a.svg"), [disc], [Outline(box(20, 20, 1, 1))])
    assert not clipped(Source("a.svg"), [], [disc])


def test_chords_are_finer_than_the_tolerance() -> None:
    assert regions.FINER >= 8
