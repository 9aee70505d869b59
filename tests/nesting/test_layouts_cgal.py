"""Layouts of round parts, placed and compacted, do not overlap by CGAL's sets of circle segments."""

from __future__ import annotations

import random
import subprocess
from itertools import combinations

import pytest

import compared_with_cgal
from cfree.nesting import Nesting, Part, compact, place
from compared_with_cgal import OWN_KINDS, placed, rings_of, text_of


def pairs(nesting: Nesting) -> list[str]:
    """All pairs of parts in their places, in the form of the program."""
    shapes = [placed(rings_of(one.part.shapes[0]), one.pose) for one in nesting.placed]
    return [f"{text_of(first)}\n{text_of(second)}" for first, second in combinations(shapes, 2)]


@pytest.mark.slow
@pytest.mark.skipif(compared_with_cgal.compiler() is None, reason="no compiler that finds CGAL and GMP")
def test_layouts_of_round_parts_do_not_overlap_by_cgal() -> None:
    program = compared_with_cgal.compiled()
    texts: list[str] = []
    for seed in range(4):
        r = random.Random(f"layout by cgal {seed}")
        parts = [Part(r.choice(OWN_KINDS)(r), f"part {k}") for k in range(5)]
        nesting = place(parts, [(0, 0), (30, 0), (27, 25), (0, 25)])
        assert len(nesting.placed) > 1
        texts += pairs(nesting) + pairs(compact(nesting, "down", turning=False, passes=1).nesting)
    done = subprocess.run([program], input="\n".join(texts), capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["0"] * len(texts) and len(texts) > 20


@pytest.mark.slow
@pytest.mark.skipif(compared_with_cgal.compiler() is None, reason="no compiler that finds CGAL and GMP")
def test_the_program_tells_overlaps() -> None:
    """The same program finds two copies of a part in one place."""
    program = compared_with_cgal.compiled()
    part = Part(OWN_KINDS[0](random.Random(0)), "part")
    rings = text_of(rings_of(part.shapes[0]))
    done = subprocess.run([program], input=f"{rings}\n{rings}", capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["1"]
