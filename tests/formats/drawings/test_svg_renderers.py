"""Renderers as oracles: they fill what is read, and what the generator means."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray
from shapely import affinity

import cfree
import rendered
import svg_drawings

WIDTH = 400
pytestmark = pytest.mark.slow


def covered(region: shapely.Geometry) -> NDArray[np.bool_]:
    """True for each pixel whose middle is in a region of the page."""
    shapely.prepare(region)
    middles = (np.arange(WIDTH) + 0.5) * 100 / WIDTH
    return np.asarray(shapely.contains_xy(region, *np.meshgrid(middles, middles)))


def apart(filled: NDArray[np.bool_], painted: NDArray[np.float64]) -> int:
    """Count the pixels that one side fills and the other does not, but for those beside an edge."""
    inner = np.zeros_like(filled)
    same = [filled[1 + dy : WIDTH - 1 + dy, 1 + dx : WIDTH - 1 + dx] for dy in (-1, 0, 1) for dx in (-1, 0, 1)]
    inner[1:-1, 1:-1] = np.all([part == same[4] for part in same], axis=0)
    return int(np.count_nonzero(inner & (filled != (painted > 0.5))))


@pytest.mark.long
@pytest.mark.parametrize("renderer", rendered.PACKAGES)
@pytest.mark.parametrize("name", svg_drawings.WAYS)
def test_renderers_fill_what_is_read(name: str, renderer: str, tmp_path: Path) -> None:
    if reason := rendered.missing(renderer):
        pytest.skip(reason)
    if renderer not in svg_drawings.TRUSTED.get(name, tuple(rendered.PACKAGES)):
        pytest.skip(f"{renderer} does not draw this as the specification has it")
    for seed in range(2):
        drawing = svg_drawings.make(name, seed)
        if not drawing.painted:
            pytest.skip("nothing is filled")
        painted = rendered.picture(renderer, drawing.text, WIDTH)
        assert apart(covered(drawing.truth), painted) == 0, f"seed {seed}: the generator errs"
        (tmp_path / "a.svg").write_text(drawing.text)
        shapes = cfree.load_shapes(tmp_path / "a.svg", tolerance=0.02)
        region = affinity.scale(
            shapely.union_all([s.polygon.to_shapely() for s in shapes.shapes]), 1, -1, origin=(0, 0)
        )
        if not any(note.effect == "more" for note in shapes.reading):
            assert apart(covered(region), painted) == 0, f"seed {seed}"
