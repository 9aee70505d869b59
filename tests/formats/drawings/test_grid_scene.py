"""`Scene.from_grid`: scenes of arrays and of OccupancyGrid data."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import cfree
from cfree import Scene
from cfree.formats.drawings import cells as map_cells
from cfree.formats.drawings import grid as grid_parts

ROBOT = [(0, 0), ("0.1", 0), (0, "0.1")]


def cells(scene: Scene) -> list[tuple[float, float, float, float]]:
    return sorted(polygon.bounds for polygon in scene.obstacles)


def test_the_data_of_an_occupancy_grid_are_rows_upwards_from_its_origin() -> None:
    data = np.array([0, 0, 100, 0, -1, 64], dtype=np.int8)  # row-major from the lower left corner
    scene = Scene.from_grid(ROBOT, data.reshape(2, 3), "0.5", (1, 2, 0))
    assert cells(scene) == [(1.5, 2.5, 2.0, 3.0), (2.0, 2.0, 2.5, 2.5)]
    assert scene.workspace == cfree.Polygon([(1, 2), ("2.5", 2), ("2.5", 3), (1, 3)])
    down = Scene.from_grid(ROBOT, data.reshape(2, 3), "0.5", (1, 2, 0), unknown="free", rows="down")
    assert (cells(down), down.workspace) == ([(2.0, 2.5, 2.5, 3.0)], None)
    lower = Scene.from_grid(ROBOT, data.reshape(2, 3), "0.5", unknown="free", occupied=64)
    assert sum(polygon.exact_area for polygon in lower.obstacles) == Fraction(1, 2)


def test_a_grid_may_be_turned() -> None:
    scene = Scene.from_grid(ROBOT, [[0, 100]], 1, (5, 5, "90deg"), unknown="free")
    assert cells(scene) == [(4, 6, 5, 7)]
    assert scene == Scene.from_grid(ROBOT, [[0, 100]], 1, cfree.Pose(5, 5, "90deg"), unknown="free")


def test_bool_masked_and_float_arrays() -> None:
    assert cells(Scene.from_grid(ROBOT, np.array([[True, False]]), 1, unknown="free")) == [(0.0, 0.0, 1.0, 1.0)]
    masked = np.ma.masked_less(np.array([[0, -1, 100]], dtype=np.int8), 0)
    assert cells(Scene.from_grid(ROBOT, masked, 1)) == [(1.0, 0.0, 3.0, 1.0)]
    assert cells(Scene.from_grid(ROBOT, masked, 1, unknown="free")) == [(2.0, 0.0, 3.0, 1.0)]
    assert cells(Scene.from_grid(ROBOT, [[0.0, 37.5, 65.0]], 1, unknown="free")) == [(2.0, 0.0, 3.0, 1.0)]
    assert cells(Scene.from_grid(ROBOT, [[0, 255, 101]], 1, unknown="free")) == []
    assert cells(Scene.from_grid(ROBOT, [[0, 255, 101]], 1)) == [(1.0, 0.0, 3.0, 1.0)]
    assert cells(Scene.from_grid(ROBOT, [[0, 1, -1]], 1, occupied=1, unknown="free")) == [(1.0, 0.0, 2.0, 1.0)]


@pytest.mark.parametrize(
    ("array", "options", "message"),
    [
        ([[0.0, 0.7], [1.0, 0.2]], {}, "array: floats from 0 to 1; multiply by 100"),
        ([[0, 1], [1, -1]], {}, "array: no value above 1; multiply by 100, or give occupied=1"),
        ([0, 100], {}, r"array: 2; give rows of cells: np.reshape\(data, \(info.height, info.width\)\)"),
        (np.zeros((0, 3), int), {}, "array: 0 x 3; give rows"),
        ([[0, float("nan")]], {}, "array: a value that is not finite; give -1 for unknown"),
        ([["#"]], {}, "array: values of type <U1; give integers"),
        ([[0, 100]], {"unknown": "occupied"}, """unknown: 'occupied'; give "obstacle" or "free\""""),
        ([[0, 100]], {"rows": "left"}, """rows: 'left'; give "up" or "down\""""),
        ([[0, 100]], {"occupied": 0}, "occupied: 0; give a value from 1 to 100"),
        ([[0, 100]], {"origin": (1, 2)}, r"origin: \(1, 2\); give \(x, y, yaw\)"),
        ([[0, 100]], {"resolution": 0}, "resolution: 0 is no length"),
    ],
)
def test_wrong_grids_are_refused_with_a_remedy(array: Any, options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Scene.from_grid(ROBOT, array, **{"resolution": 1, **options})


def test_a_grid_of_which_a_few_cells_have_changed_has_the_polygons_of_the_one_before() -> None:
    rng = np.random.default_rng(3)
    grid = np.where(rng.random((40, 40)) < 0.3, 100, 0)
    before = Scene.from_grid(ROBOT, grid, "0.5", (1, 2, 0))
    grid[20, 20:22] = 100 - grid[20, 20:22]
    after = Scene.from_grid(ROBOT, grid, "0.5", (1, 2, 0))
    kept = {id(polygon) for polygon in before.obstacles} & {id(polygon) for polygon in after.obstacles}
    assert len(kept) >= len(after.obstacles) - 4
    assert before != after


def test_polygons_that_are_kept_are_those_traced_anew() -> None:
    rng = np.random.default_rng(4)
    for _ in range(20):
        grid = np.where(rng.random((15, 15)) < 0.5, 100, 0)  # many parts that are cut where they touch in a corner
        for origin in ((0, 0, 0), (1, 2, "90deg")):
            kept = [Scene.from_grid(ROBOT, grid, "0.5", origin) for _ in range(2)]
            grid_parts._traced_before.cache_clear()
            map_cells._polygon_before.cache_clear()
            assert kept[0] == kept[1] == Scene.from_grid(ROBOT, grid, "0.5", origin)
