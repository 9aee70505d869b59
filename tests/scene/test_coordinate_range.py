"""The range of coordinates: what works in one scene, and what is refused."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest

import cfree
from cfree.errors import FormatError, UnsupportedError
from cfree.scene import features

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def triangle(x: Fraction, size: Fraction) -> list[tuple[Fraction, Fraction]]:
    return [(x, Fraction(0)), (x + size, size / 3), (x, size)]


def mixed(small: Fraction) -> cfree.Scene:
    """Near a unit robot: two obstacles as small as this, which touch, one as large as its inverse, and one like it."""
    near = [triangle(Fraction(3), small), triangle(Fraction(3) + small, small)]
    return cfree.Scene([SQUARE], [*near, triangle(Fraction(10), 1 / small), triangle(Fraction(9, 2), Fraction(1))])


@pytest.mark.parametrize("exponent", [100, 148])
def test_lengths_of_all_sizes_meet_in_one_scene(exponent: int) -> None:
    usual, extreme = (cfree.boundary(mixed(Fraction(1, 10**e)), threads=1) for e in (3, exponent))
    assert extreme.stats.live_patches == usual.stats.live_patches
    assert extreme.stats.trapezoids == usual.stats.trapezoids
    assert extreme.stats.decided_exactly > usual.stats.decided_exactly


def test_doubles_of_all_sizes_meet_in_one_scene() -> None:
    result = cfree.boundary(cfree.Scene([SQUARE], [[(3, 0), (3 + 1e-9, 1e-100), (3, 1)], [(9, 0), (1e100, 1), (9, 2)]]))
    assert result.stats.live_patches == result.stats.patches == 48


@pytest.mark.parametrize(
    ("obstacle", "message"),
    [
        ([(0, 0), ("1e151", 0), (0, 1)], "obstacle 1: the coordinate 1e151 is larger than 1e150; scale the scene"),
        ([(0, 0), ("-1e2000", 0), (0, 1)], "outer ring: point 1 lies beyond 4e307; scale the coordinates"),
        ([(0, 0), ("1e-400", 0), (0, 1)], "obstacle 1: with its denominator 1e400 the scene's coordinates"),
        ([(0, 0), ("1e150", 0), (0, "1e-190")], "integers of 1,130 bits or more, and 1,110 are allowed"),
    ],
)
def test_what_is_out_of_range_is_named(obstacle: list[tuple[object, object]], message: str) -> None:
    with pytest.raises((UnsupportedError, ValueError)) as caught:
        cfree.Scene([SQUARE], [SQUARE, obstacle])
    assert message in str(caught.value)


def test_many_denominators_are_refused() -> None:
    primes = [p for p in range(1000, 3000) if all(p % k for k in range(2, 55))]
    shapes = [[(0, 0), (Fraction(1, p), 0), (0, 1)] for p in primes]
    cfree.Scene([SQUARE], shapes[:90])
    with pytest.raises(UnsupportedError, match="in few denominators"):
        cfree.Scene([SQUARE], shapes)


@pytest.mark.parametrize(
    ("scene", "place"),
    [
        ({"robot": {"outer": SQUARE}, "obstacles": [{"outer": [[0, 0], ["1e151", 0], [0, 1]]}]}, "obstacles[0]"),
        ({"robot": {"outer": [[0, 0], [1, 0], [0, "1e-400"]]}}, "robot"),
        ({"robot": [{"outer": [[0, 0], [1, 0], [0, "1e-400"]]}]}, "robot[0]"),
        ({"robot": {"outer": SQUARE}, "bounds": [0, 0, 1, "1e160"]}, "bounds[3]"),
    ],
)
def test_a_file_out_of_range_has_line_and_column(scene: dict[str, object], place: str, tmp_path: Path) -> None:
    file = tmp_path / "scene.json"
    file.write_text(json.dumps(scene))
    with pytest.raises(FormatError, match=r"scene\.json:1:") as caught:
        cfree.load_scene(file)
    assert f" {place}: " in str(caught.value)


@pytest.mark.parametrize(
    ("limit", "message"),
    [
        ("MOST_ROBOT_FEATURES", "robot: 8 edges and diagonals; fewer than 8 have numbers"),
        ("MOST_OBSTACLE_FEATURES", "obstacles: 8 edges and diagonals"),
        ("MOST_PATCHES", "4 vertices of the robot and 4 of the obstacles: 32 contact patches"),
    ],
)
def test_more_than_have_numbers_is_refused(limit: str, message: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(features, limit, 32 if limit == "MOST_PATCHES" else 8)
    with pytest.raises(UnsupportedError, match=message):
        cfree.boundary(cfree.Scene([SQUARE], [SQUARE]))
