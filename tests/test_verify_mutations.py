"""One thing wrong in a boundary, and `verify` says so; `mutations.py` prints the table."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from cfree import Boundary, boundary, load_scene
from mutations import MUTATIONS, Mutation, detected, mutants, says_the_same

ROOT = Path(__file__).parents[1]
FILES = (
    "tests/cases/triangle_pair.json",
    "tests/cases/l_in_u.json",
    "tests/cases/obstacle_on_bounds.json",
    "examples/scenes/degenerate_collinear_walls.json",
)


@cache
def good(file: str) -> Boundary:
    return boundary(load_scene(ROOT / file), threads=1)


@pytest.mark.parametrize("mutate", MUTATIONS, ids=lambda mutate: mutate.__name__)
def test_one_wrong_thing_is_detected(mutate: Mutation) -> None:
    tried = 0
    for file in FILES:
        for bad in mutants(good(file), mutate, 4):
            result = detected(bad)
            assert not result.verified or says_the_same(good(file), bad), file
            tried += not result.verified
    assert tried >= 4
