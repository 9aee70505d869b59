"""Closed surfaces of rounded shapes: Euler numbers of scenes made by hand, most of them with ties."""

from __future__ import annotations

import pytest

import cfree._core as core
from rounded_ties import SCENES, features_of


@pytest.mark.parametrize("name", SCENES)
def test_euler_numbers_are_those_counted_by_hand(name: str) -> None:
    *_, euler, surfaces = SCENES[name]
    cells = core.glue(core.compute_boundary(features_of(name).scene, 1, False, lambda share: True), 1)
    assert cells.vertices - len(cells.twin) // 2 + len(cells.component) == euler
    assert cells.components == surfaces
