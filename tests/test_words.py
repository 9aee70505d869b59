"""Counted nouns and long lists."""

import re
from pathlib import Path

import pytest

import cfree
from cfree.planning.separation import Separated
from cfree.words import MOST_NAMES, counted, listed

SOURCE = Path(__file__).parents[1] / "src" / "cfree"
NOUNS = "polygon|vert|patch|motion|piece|hole|goal|proof|cell|surface|trapezoid|tile|shard|segment|obstacle|point|slide"


@pytest.mark.parametrize(
    ("noun", "plural"),
    [
        ("polygon", "polygons"),
        ("vertex", "vertices"),
        ("contact patch", "contact patches"),
        ("exact slice", "exact slices"),
        ("entity in paper space", "entities in paper space"),
        ("cell of grey 205 (map_saver's unknown)", "cells of grey 205 (map_saver's unknown)"),
        ("outline closed only by a join", "outlines closed only by a join"),
        ("box", "boxes"),
        ("key", "keys"),
        ("POLYLINE: no outline", "POLYLINEs: no outline"),
        ("number rounded to 14 digits", "numbers rounded to 14 digits"),
        ("line shorter than the joining distance", "lines shorter than the joining distance"),
        ("shape below the least area", "shapes below the least area"),
        ("gap that is closed, and may make holes", "gaps that are closed, and may make holes"),
        ("outline that crosses or touches itself: solid", "outlines that cross or touch themselves: solid"),
        ("end that misses its begin", "ends that miss their begin"),
        ("entity on a layer that is off", "entities on a layer that is off"),
        ("polyline with a width, read as a wall", "polylines with a width, read as walls"),
    ],
)
def test_one_is_singular_and_all_else_plural(noun: str, plural: str) -> None:
    assert counted(1, noun) == f"1 {noun}"
    assert [counted(n, noun) for n in (0, 2, 1234)] == [f"0 {plural}", f"2 {plural}", f"1,234 {plural}"]


def test_long_lists_are_cut_at_eight_and_say_of_how_many() -> None:
    names = [f"n{k}" for k in range(53)]
    assert listed(names) == "; ".join(names[:MOST_NAMES]) + "; ... of 53"
    assert listed(names[:8]) == "; ".join(names[:8]) and listed([]) == ""


def test_values_count_one_of_a_kind_in_the_singular() -> None:
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    frame = cfree.Polygon([(-9, -9), (9, -9), (9, 9), (-9, 9)], [[(-8, -8), (8, -8), (8, 8), (-8, 8)]])
    scene = cfree.Scene(square, [frame])
    space = cfree.free_space(cfree.boundary(scene))
    values = scene, frame, space, space.boundary, space.boundary.slice("10deg"), cfree.Path((0, 0, 0), [])
    one_goal = cfree.plan(scene, (0, 0, 0), [(20, 20, 0)])
    for value in (*values, one_goal, cfree.plan(scene, (0, 0, 0), (20, 20, 0))):
        assert not re.search(r"\b1 [a-z-]+(?: [a-z-]+)?s\b", repr(value)), repr(value)
    assert repr(one_goal).startswith("AllSeparated(of='closed', 1 goal, 1 proof")


def test_a_proof_by_many_obstacles_names_eight_of_them() -> None:
    posts = [[(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)] for x in range(0, 12) for y in (0, 11)]
    posts += [[(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)] for x in (0, 11) for y in range(1, 11)]
    found = cfree.plan(cfree.Scene([(0, 0), (1, 0), (1, 1), (0, 1)], posts), (5, 5, 0), (20, 5, 0))
    assert isinstance(found, Separated) and len(found.obstacles) > MOST_NAMES
    assert repr(found).endswith(f", ... of {len(found.obstacles)}))") and repr(found).count(",") < 12


def test_no_message_puts_an_s_after_any_number() -> None:
    """Messages count by `counted`; a number that is never 1 stands in the text as it is."""
    pattern = re.compile(r"\{len\([^{}]*\)(?::,)?\} (?:[a-z]+ )?(?:" + NOUNS + r")[a-z]*s\b")
    never_one = {"shapes; counted", "workspaces; give", "polygons; give one", "control points", "pivots; mark"}
    for file in SOURCE.rglob("*.py"):
        for line in file.read_text().splitlines():
            assert not pattern.search(line) or any(words in line for words in never_one), f"{file.name}: {line.strip()}"
