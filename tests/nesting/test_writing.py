"""Layouts written as SVG, DXF and GeoJSON, and read again."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

import cfree
from cfree import Curved
from cfree.curves import Arc, Bezier, Circle
from cfree.nesting import Nesting, Part, Placed, load_nesting, overlaps, place, save_nesting

STADIUM = Curved(
    [(0, 0), (4, 0), Arc((4, 2), center=(4, 1)), (0, 2), Arc((0, 0), center=(0, 1))], [Circle((2, 1), "1/2")]
)
SHEET = [(0, 0), (14, 0), (14, 7), (0, 7)]


@pytest.fixture(scope="module")
def nesting() -> Nesting:
    parts = [Part(STADIUM, "stadium", 3), Part([(0, 0), (1, 0), (0, 2)], "wedge", 5)]
    return place(parts, [SHEET, SHEET], rotations=2)


@pytest.mark.parametrize("suffix", ["svg", "dxf", "geojson"])
def test_a_written_layout_is_read_again_without_overlap(nesting: Nesting, suffix: str, tmp_path: Path) -> None:
    file = tmp_path / f"layout.{suffix}"
    nesting.save(file)
    again = load_nesting(file)
    assert len(again.placed) == len(nesting.placed) and len(again.sheets) == 2
    assert overlaps(again) == () and again.density == pytest.approx(nesting.density, abs=2e-3)


@pytest.mark.parametrize("suffix", ["svg", "dxf", "geojson"])
def test_sheets_are_side_by_side(suffix: str, tmp_path: Path) -> None:
    square = Part([(0, 0), ("1/3", 0), ("1/3", 2), (0, 2)], "strip", 8)
    nesting = place(square, [[(0, 0), (1, 0), (1, 2), (0, 2)], [(-3, 0), ("-1.5", 0), ("-1.5", 2), (-3, 2)]])
    assert len(nesting.used) == 2
    nesting.save(tmp_path / f"a.{suffix}")
    again = load_nesting(tmp_path / f"a.{suffix}")
    assert [one.sheet for one in again.placed] == [one.sheet for one in nesting.placed]
    assert all(found.depth.hi < 1e-12 for found in overlaps(again)) and (suffix != "geojson" or overlaps(again) == ())


def test_arcs_stay_arcs_and_one_arc_stays_one(nesting: Nesting, tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    save_nesting(nesting, tmp_path / "layout.svg")
    text = (tmp_path / "layout.svg").read_text()
    assert text.count(" A ") == 3 * 4  # two half circles, and a circle in two halves
    nesting.save(tmp_path / "layout.dxf")
    lines = [*ezdxf.readfile(tmp_path / "layout.dxf").modelspace()]
    bulges = [bulge for line in lines for *_, bulge in line.get_points("xyb")]
    assert sum(abs(abs(bulge) - 1) < 1e-12 for bulge in bulges) == 3 * 4 and {line.dxftype() for line in lines} == {
        "LWPOLYLINE"
    }


def test_geojson_is_exact_and_has_the_poses(tmp_path: Path) -> None:
    wedge = Placed(Part([(0, 0), (1, 0), (0, 2)], "wedge"), ("1/3", 2, "90deg"))
    save_nesting(Nesting([SHEET], [wedge]), tmp_path / "a.geojson")
    data = json.loads((tmp_path / "a.geojson").read_text())
    assert data["features"][1]["properties"] == {
        "role": "obstacle", "name": "wedge", "sheet": 0, "x": "1/3", "y": "2", "tau": "1", "degrees": 90.0
    }  # fmt: skip
    assert data["features"][1]["geometry"]["coordinates"][0][0] == ["1/3", 2]


def test_curves_that_a_format_lacks_are_fine_polygons(tmp_path: Path) -> None:
    drop = Part(Curved([(0, 0), Bezier([(4, 0), (4, 4), (2, 3)]), (0, 3)]), "drop")
    oval = Part(Curved.ellipse((0, 0), (2, 1), "20deg"), "oval")
    grown = Part(Curved([(0, 0), (2, 0), (0, 1)], grown="1/2"), "grown")
    placed = [Placed(part, (x, 3, 0)) for part, x in ((drop, 1), (oval, 7), (grown, 11))]
    layout = Nesting([SHEET], placed, units="mm")
    for suffix in ("svg", "dxf", "geojson"):
        save_nesting(layout, tmp_path / f"a.{suffix}")
        again = load_nesting(tmp_path / f"a.{suffix}")
        assert math.isclose(again.area, layout.area, rel_tol=2e-3)
    assert load_nesting(tmp_path / "a.svg").units == "mm"


def test_another_suffix_is_refused_with_those_that_are_written(tmp_path: Path) -> None:
    with pytest.raises(cfree.UnsupportedError, match=r"no layout format; name the file \.svg, \.dxf or \.geojson$"):
        Nesting([SHEET], []).save(tmp_path / "a.step")
