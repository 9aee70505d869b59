"""Joins and guesses: gaps are bridged, listed, and never free what may be forbidden."""

import random
from decimal import Decimal
from itertools import combinations

import pytest

from cfree.curves.drawn import Line, Ring
from cfree.formats.drawings.content import Curve
from cfree.polygons.polygon import Polygon
from enclosures import area, box, closed, is_in, lines, notes, outlines, pieces, point, region, ring


def with_gap(outline: Ring, gap: float, side: int = 0) -> list[Curve]:
    """Return the lines of a ring, the one of a side shorter by a gap."""
    curves = pieces(outline)
    (line,) = curves[side].segments
    assert isinstance(line, Line)
    (x, y), (z, w) = (tuple(map(float, end)) for end in (line.start, line.end))
    share = gap / max(abs(z - x), abs(w - y))
    end = point(round(z - share * (z - x), 9), round(w - share * (w - y), 9))
    curves[side] = Curve([Line(line.start, end)], False, curves[side].handle)
    return curves


def test_gaps_up_to_a_millionth_of_the_size_are_joined_and_listed() -> None:
    curves = with_gap(box(0, 0, 40, 40), 3e-5)
    found, source = outlines(curves)
    assert len(found) == 1
    (note,) = source.notes
    assert (note.kind, note.what, note.where, note.count) == ("joined", "bridged gap", "A", 1)
    assert note.size == pytest.approx(3e-5)
    assert note.at == pytest.approx((40, 0), abs=1e-4)
    assert note.items[0].handle == "line 0"
    assert not region(curves, join=0)
    assert not region(with_gap(box(0, 0, 40, 40), 5e-5))


def test_ends_within_the_rounding_of_their_digits_are_one_point() -> None:
    curves = [Curve(c.segments, False, c.handle, rounding=1e-3) for c in with_gap(box(0, 0, 40, 40), 1.5e-3)]
    for options in ({}, {"join": 0.0}):
        found, source = outlines(curves, **options)
        assert [len(outline.outer) for outline in found] == [4]
        assert not notes(source)


def test_an_open_line_names_the_least_distance_that_closes_it() -> None:
    curves = with_gap(box(0, 0, 40, 40), 0.0123)
    found, source = outlines(curves)
    assert not found
    (note,) = source.notes
    assert (note.kind, note.what, note.effect, note.count) == ("lost", "open line", "less", 4)
    assert note.size == 40
    first = note.items[0]
    assert (first.handle, first.at) == ("line 0", pytest.approx((39.9877, 0)))
    assert first.size == pytest.approx(0.0123)
    assert note.remedy == "--join 0.0124"
    assert region(curves, join=float(note.remedy.removeprefix("--join ")))


@pytest.mark.parametrize("gap", ["0.1", "0.2", "0.3", "0.7", "1.1"])
def test_a_gap_is_closed_by_a_distance_of_the_same_decimals(gap: str) -> None:
    end = str(20 + Decimal(gap))
    slot = lines((55, 20, 95, 20), (95, 20, 95, 40), (95, 40, 55, 40), (55, 40, 55, end))
    for join, count in ((float(gap) - 1e-6, 0), (float(gap), 1)):
        _, source = outlines([*closed(box(0, 0, 120, 60)), *slot], join=join)
        assert len([note for note in source.notes if note.kind == "joined"]) == count


def test_lines_that_nothing_closes_want_a_width() -> None:
    _, source = outlines(lines((0, 0, 40, 0), (0, 9, 40, 9)))
    (note,) = source.notes
    assert note.remedy == "--strokes 0.1"


def test_lost_lines_and_guessed_outlines_have_points_for_pictures() -> None:
    _, source = outlines(lines((0, 0, 40, 0), (40, 0, 40, 9), (5, 20, 9, 20)))
    (note,) = source.notes
    assert [item.points for item in note.items if item.points] == [
        ((0, 0), (40, 0)), ((40, 0), (40, 9)), ((5, 20), (9, 20)),
    ]  # fmt: skip
    _, source = outlines(with_gap(box(0, 0, 40, 40), 0.05, side=1), join=0.1)
    (guess,) = (note for note in source.notes if note.kind == "guess")
    ring = guess.items[0].points
    assert ring[0] == ring[-1] and {(0, 0), (40, 40), (0, 40)} <= set(ring)


def test_a_bridge_moves_no_curve() -> None:
    curves = with_gap(box(0, 0, 1000, 40), 0.05, side=1)  # a side of 1000 that turned would lose 25
    joined = region(curves, join=0.1)
    assert area(joined) >= 40_000
    assert area(joined) <= 40_000 + 4 * 0.05**2


def test_a_corner_that_both_sides_miss_is_covered() -> None:
    curves = lines((0, 0, "9.7", 0), (10, "0.3", 10, 10), (10, 10, 0, 10), (0, 10, 0, 0))
    joined = region(curves, join=0.5)
    assert is_in(joined, (9.95, 0.05))
    assert not is_in(region(curves, join=0.5, workspace=True), (9.8, 0.2))


def test_overshoots_are_not_joined() -> None:
    curves = lines((-3e-5, 0, 40, 0), (40, 0, 40, 40), (40, 40, 0, 40), (0, 40, 0, -2e-5))
    found, source = outlines(curves)
    assert [len(outline.outer) for outline in found] == [4]
    assert notes(source) == {"near line shorter than the joining distance": 2}


def test_an_overshoot_is_not_joined_to_the_line_that_it_crosses() -> None:
    (outline,), _ = outlines(lines((0, 0, "40.00003", 0), (30, -20, 50, 20), (50, 20, 0, 0)))
    assert len(outline.outer) == 3


def test_an_end_joins_the_inside_of_a_line() -> None:
    wall = [*pieces(box(0, 0, 40, 40)), *lines((20, "40.00003", 20, 60), (20, 60, 40, 60), (40, 60, 40, "40.00001"))]
    found = region(wall)
    assert area(found) == pytest.approx(1600 + 400)
    assert point(20, 40) in {p for polygon in found for p in polygon.exact_vertices}


def test_a_curve_that_nearly_closes_joins_its_own_end() -> None:
    corners = ring((0, 0), (40, 0), (40, 40), (0, 40))[:3]
    curve = Curve([*corners, Line(point(0, 40), point(0, "0.00002"))])
    assert area(region([curve])) == pytest.approx(1600)


# --- guesses ---


def test_a_loop_in_a_plate_that_only_a_guess_closes_is_no_hole() -> None:
    plate = closed(box(0, 0, 100, 60))
    curves = [*plate, *with_gap(box(20, 20, 30, 20), 0.05)]
    assert area(region(curves)) == 6000
    assert area(region(curves, join=0.1)) == 6000
    _, source = outlines(curves, join=0.1)
    guess = next(note for note in source.notes if note.kind == "guess")
    assert (guess.effect, guess.remedy, guess.size) == ("more", "--join-holes", pytest.approx(0.05))
    found, source = outlines(curves, join=0.1, join_holes=True)
    assert [len(outline.holes) for outline in found] == [1]
    assert [note.kind for note in source.notes] == ["assumption"]


def test_a_desk_in_a_room_that_only_a_guess_closes_stays_forbidden() -> None:
    room, desk = with_gap(box(0, 0, 100, 60), 0.05), closed(box(20, 20, 20, 20))
    assert is_in(region([*room, *desk]), (30, 30))
    assert is_in(region([*room, *desk], join=0.1), (30, 30))
    assert not is_in(region([*room, *desk], join=0.1, join_holes=True), (30, 30))


def test_a_pocket_that_a_guess_closes_beside_a_ring_is_solid_and_its_hole_is_free() -> None:
    plate = closed(box(0, 0, 100, 60), box(20, 20, 20, 20))
    pocket = lines((50, 60, 50, 90), (50, 90, 80, 90), (80, 90, 80, "60.05"))
    found = region([*plate, *pocket], join=0.1)
    assert is_in(found, (60, 70))
    assert not is_in(found, (30, 30))


def test_a_workspace_gets_what_all_guesses_leave() -> None:
    room, desk = closed(box(0, 0, 100, 60)), with_gap(box(20, 20, 20, 20), 0.05)
    found = region([*room, *desk], join=0.1, workspace=True)
    assert is_in(found, (60, 30))
    assert not is_in(found, (30, 30))
    opened = [*with_gap(box(0, 0, 100, 60), 0.05), *with_gap(box(20, 20, 20, 20), 0.05)]
    found = region(opened, join=0.1, workspace=True)
    assert is_in(found, (60, 30))
    assert not is_in(found, (30, 30))


def nest(rng: random.Random) -> tuple[list[list[Curve]], list[Curve]]:
    """Rings in each other and beside each other, with gaps, and rings without."""
    rings: list[Ring] = []
    x, y, w, h = 0.0, 0.0, 80.0, 80.0
    for _ in range(rng.randrange(2, 5)):
        rings.append(box(x, y, w, h))
        if rng.random() < 0.4 and w > 24:
            rings.append(box(x + w / 2 + 2, y + 4, w / 2 - 6, h - 8))
            w = w / 2
        x, y, w, h = x + 3, y + 3, w - 6, h - 6
    loose = [k for k in range(len(rings)) if rng.random() < 0.6]
    drawn = [curve for k, one in enumerate(rings) if k not in loose for curve in pieces(one)]
    return [with_gap(rings[k], 0.05, rng.randrange(4)) for k in loose], drawn


def as_drawn(curves: list[Curve]) -> list[Curve]:
    """Close the gap of a ring by a line."""
    tips = [end for curve in curves for s in curve.segments if isinstance(s, Line) for end in (s.start, s.end)]
    a, b = (tip for tip in tips if tips.count(tip) == 1)
    return [*curves, Curve([Line(a, b)])]


@pytest.mark.parametrize("seed", range(15))
def test_guesses_forbid_what_any_subset_of_them_forbids(seed: int) -> None:
    rng = random.Random(seed)
    loose, drawn = nest(rng)
    readings: list[list[Polygon]] = []
    for size in range(len(loose) + 1):
        for chosen in combinations(range(len(loose)), size):
            curves = [c for k, part in enumerate(loose) for c in (as_drawn(part) if k in chosen else part)]
            readings.append(region([*drawn, *curves], join=0))
    joined = region([*drawn, *(curve for part in loose for curve in part)], join=0.1)
    for _ in range(60):
        p = rng.uniform(-2, 82) + 0.001234, rng.uniform(-2, 82) + 0.004321
        if min(abs(value - round(value * 2) / 2) for value in p) > 0.1:  # edges and squares are near halves
            assert is_in(joined, p) == any(is_in(reading, p) for reading in readings)


@pytest.mark.parametrize("seed", range(15))
def test_guesses_never_free_what_a_subset_forbids_in_a_mess(seed: int) -> None:
    rng = random.Random(seed)
    curves = pieces(box(0, 0, 40, 40), box(5, 5, 30, 30))
    gaps: list[Curve] = []
    for k in range(3):  # boxes with gaps that hang on walls by lines with gaps
        x, y = rng.randrange(8, 22), rng.randrange(8, 22)
        curves += with_gap(
            box(x + 0.37 * k, y + 0.21 * k, rng.randrange(4, 9), rng.randrange(4, 9)), 0.05, rng.randrange(4)
        )
    curves += lines((5.06, 17.13, 30, 17.13), (17.77, 5, 17.77, 34.93))
    joined = region(curves, join=0.1)
    ends = [s for c in curves for s in c.segments if isinstance(s, Line)]
    tips = [end for s in ends for end in (s.start, s.end)]
    loose = [tip for tip in dict.fromkeys(tips) if tips.count(tip) == 1]
    for a, b in combinations(loose, 2):
        if abs(a[0] - b[0]) <= 0.06 and abs(a[1] - b[1]) <= 0.06:
            gaps.append(Curve([Line(a, b)]))
    probes = [(rng.uniform(-1, 41), rng.uniform(-1, 41)) for _ in range(40)]
    for size in range(len(gaps) + 1):
        for chosen in combinations(gaps, size):
            reading = region([*curves, *chosen], join=0)
            assert all(is_in(joined, p) for p in probes if is_in(reading, p))


@pytest.mark.parametrize("wall", [(20, 0, 20, 15), (20, 0, 20, 40), (15, 20, 25, 20)])
def test_lines_inside_of_a_workspace_are_lost(wall: tuple[float, float, float, float]) -> None:
    room = [*closed(box(0, 0, 40, 40)), *lines(wall)]
    losses = [note for note in outlines(room, workspace=True)[1].notes if note.kind == "lost"]
    assert [(note.effect, note.count, note.items[0].handle) for note in losses] == [("less", 1, "line 0")]
    assert not notes(outlines(closed(box(0, 0, 40, 40)), workspace=True)[1])


def test_a_guess_of_a_workspace_has_its_own_words_and_loses_no_line() -> None:
    _, source = outlines(with_gap(box(0, 0, 40, 40), 0.05), join=0.1, workspace=True)
    assert [note.what for note in source.notes if note.kind in ("lost", "guess")] == [
        "outline that only a join closes: only its inside is allowed"
    ]
