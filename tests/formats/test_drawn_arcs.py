"""Arcs of drawings that could be drawn with rational centers and radii are exact as read, without healing."""

import math
import random
from pathlib import Path

import ezdxf
import pytest

import cfree
from cfree import Curved
from cfree.curves.drawn import Line
from cfree.scene.rounded import rounded


def svg(r: random.Random) -> str:
    """Rounded rectangles, quarters, halves, three quarters and 3-4-5 arcs, in decimals of some digits, near and far."""
    shapes = []
    for k in range(4):
        x, y = (round(30 * k + r.choice([0, 5e3]) + r.uniform(0, 9), r.randint(0, 4)) for _ in "xy")
        w, h, radius = (round(r.uniform(4, 9), 3), round(r.uniform(4, 9), 3), round(r.uniform(0.1, 2), 3))
        a, b, c = r.choice([(3, 4, 5), (4, 3, 5), (5, 12, 13), (12, 5, 13)])
        shapes += [
            f'<rect x="{x}" y="{y}" width="{w}" height="{h}" rx="{radius}"/>',
            f'<path d="M{x} {y} h{radius} a{radius} {radius} 0 0 1 {radius} {radius} v{h} h-{2 * radius:.3f} z"/>',
            f'<path d="M{x} {y} h{w} a{radius} {radius} 0 0 1 0 {2 * radius:.3f} h-{w} z"/>',
            f'<path d="M{x} {y} a{radius} {radius} 0 1 1 {radius} {radius} v-{radius} z"/>',
            f'<path d="M{x} {y} l{2 * a} 0 a{c} {c} 0 0 1 -{a - b if a > b else 0} {c} z"/>' if a > b else "",
        ]
    return "".join(shapes)


@pytest.mark.parametrize("seed", range(6))
def test_simple_arcs_of_svg_have_their_rational_centers(seed: int, tmp_path: Path) -> None:
    r = random.Random(seed)
    unit = r.choice(["mm", "in", "px"])
    size = f'width="100{unit}" height="100{unit}" viewBox="0 0 100 100"'
    text = f'<svg xmlns="http://www.w3.org/2000/svg" {size}><g id="walls">{svg(r)}</g></svg>'
    (tmp_path / "a.svg").write_text(text)
    shapes = [s.polygon for s in cfree.load_shapes(tmp_path / "a.svg", curves=True).shapes]
    curved = [shape for shape in shapes if isinstance(shape, Curved)]
    simple = [shape for shape in curved if all(isinstance(p, Line) or is_simple(p.sweep) for p in shape.curves[0])]
    assert len(curved) >= 16 and len(simple) >= 16
    assert [shape for shape in simple if rounded(shape) is None] == []


def is_simple(sweep: float) -> bool:
    """True for whole numbers of quarter turns."""
    return abs(sweep / (math.pi / 2) - round(sweep / (math.pi / 2))) < 1e-9


@pytest.mark.parametrize("seed", range(4))
def test_bulges_of_quarter_and_half_turns_are_exact(seed: int, tmp_path: Path) -> None:
    r = random.Random(seed)
    document = ezdxf.new()  # type: ignore[attr-defined]
    quarter = math.tan(math.pi / 8)
    for k in range(5):
        x = 20.0 * k + r.choice([0, 1e4])
        y, w, h, c = (round(r.uniform(*span), 6) for span in ((-9, 9), (4, 8), (4, 8), (0.1, 1)))
        box = [(x + c, y, 0), (x + w, y, quarter), (x + w + c, y + c, 0), (x + w + c, y + h, 0), (x + c, y + h, 0)]
        slot = [(x, y + 20, 0), (x + w, y + 20, 1), (x + w, y + 20 + 2 * c, 0), (x, y + 20 + 2 * c, 1)]
        for points in (box, slot):
            rows = [(round(px, 6), round(py, 6), bulge) for px, py, bulge in points]
            document.modelspace().add_lwpolyline(rows, format="xyb", close=True, dxfattribs={"layer": "walls"})
    document.saveas(tmp_path / "a.dxf")
    for shape in cfree.load_shapes(tmp_path / "a.dxf", curves=True).shapes:
        assert isinstance(shape.polygon, Curved) and rounded(shape.polygon) is not None


def test_an_arc_that_is_nearly_a_quarter_stays_as_drawn(tmp_path: Path) -> None:
    document = ezdxf.new()  # type: ignore[attr-defined]
    rows = [(0, 0, 0.4142136), (1, 1, 0), (0, 1, 0)]
    document.modelspace().add_lwpolyline(rows, format="xyb", close=True, dxfattribs={"layer": "walls"})
    document.saveas(tmp_path / "a.dxf")
    (shape,) = cfree.load_shapes(tmp_path / "a.dxf", curves=True).shapes
    assert isinstance(shape.polygon, Curved) and rounded(shape.polygon) is None
    assert rounded(shape.polygon.healed(1e-6)) is not None
    assert shape.polygon.box[2] > 1, "it leaves the corner"
