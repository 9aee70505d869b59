"""One thing wrong in a boundary, and `verify` says so; `mutations.py` prints the table."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from cfree import Boundary, boundary, load_scene
from mutations import OF_ISOLATED_PARTS, OF_TRAPEZOIDS, Mutation, detected, mutants, says_the_same

ROOT = Path(__file__).parents[2]
FILES = (
    "tests/cases/triangle_pair.json",
    "tests/cases/l_in_u.json",
    "tests/cases/obstacle_on_bounds.json",
    "examples/scenes/degenerate_collinear_walls.json",
)

FITS = (
    "examples/scenes/degenerate_collinear_walls.json",
    "examples/scenes/degenerate_exact_fit.json",
    "examples/scenes/degenerate_own_hole.json",
    "examples/scenes/degenerate_workspace.json",
)


@cache
def good(file: str) -> Boundary:
    return boundary(load_scene(ROOT / file), threads=1)


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("mutate", OF_TRAPEZOIDS, ids=lambda mutate: mutate.__name__)
def test_one_wrong_thing_is_detected(mutate: Mutation) -> None:
    tried = 0
    for file in FILES:
        for bad in mutants(good(file), mutate, 3):
            result = detected(bad)
            assert not result.verified or says_the_same(good(file), bad), file
            tried += not result.verified
    assert tried >= 2


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("mutate", OF_ISOLATED_PARTS, ids=lambda mutate: mutate.__name__)
def test_a_wrong_isolated_part_is_detected(mutate: Mutation) -> None:
    tried = 0
    for file in FITS:
        for bad in mutants(good(file), mutate, 2):
            assert not detected(bad, slices=12).verified or says_the_same(good(file), bad), file
            tried += 1
    assert tried >= 4
