"""Texts of a picture that touch: boxes of all drawn texts, slanting ones at their angle."""

from collections.abc import Iterator
from itertools import combinations
from unittest.mock import patch

import shapely
from matplotlib.backend_bases import RendererBase
from matplotlib.figure import Figure
from matplotlib.text import Text
from shapely.affinity import rotate

SHARED = 0.5  # pixels by which boxes may overlap: their edges are rounded


def written(figure: Figure) -> list[tuple[str, shapely.Polygon]]:
    """All texts that are drawn, and their boxes in pixels."""
    texts: list[tuple[str, shapely.Polygon]] = []
    draw = Text.draw

    def noted(self: Text, renderer: RendererBase) -> None:
        draw(self, renderer)
        if self.get_visible() and self.get_text().strip():
            texts.append((self.get_text().strip(), _box(self, renderer)))

    with patch.object(Text, "draw", noted):
        figure.draw_without_rendering()
    return texts


def touching(figure: Figure) -> Iterator[tuple[str, str]]:
    """Pairs of texts whose boxes have more than an edge in common."""
    boxes = [(text, box.buffer(-SHARED)) for text, box in written(figure)]
    return ((a, b) for (a, first), (b, second) in combinations(boxes, 2) if first.intersects(second))


def _box(text: Text, renderer: RendererBase) -> shapely.Polygon:
    around, angle = text.get_window_extent(renderer), text.get_rotation()
    text.set_rotation(0)
    level = text.get_window_extent(renderer)
    text.set_rotation(angle)
    x, y, w, h = (around.x0 + around.x1) / 2, (around.y0 + around.y1) / 2, level.width / 2, level.height / 2
    return rotate(shapely.box(x - w, y - h, x + w, y + h), angle, origin=(x, y))
