"""Make a scene of a robot and an occupancy grid in memory: a numpy array, or the data of a ROS OccupancyGrid."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from cfree.exact.number import Number, to_fraction
from cfree.exact.pose import Pose
from cfree.formats.drawings.cells import FREE, OCCUPIED, UNKNOWN, States, cell_shapes
from cfree.formats.drawings.map_image import MOST_CELLS
from cfree.formats.drawings.source import Reading, Source, shapes_of
from cfree.scene.scene import Scene, shapes_in

_ROBOT = "give a shape, or several"


def scene_from_grid(
    robot: Any,
    array: Any,
    resolution: Number,
    origin: Sequence[Number] | Pose,
    occupied: int,
    unknown: Literal["obstacle", "free"],
    rows: Literal["up", "down"],
) -> Scene:
    """Implement `Scene.from_grid`."""
    parts = shapes_in(robot, "robot")
    side = to_fraction(resolution)
    if side <= 0:
        raise ValueError(f"resolution: {resolution} is no length; give one above 0")
    if not 1 <= occupied <= 100:
        raise ValueError(f"occupied: {occupied}; give a value from 1 to 100")
    pose = origin if isinstance(origin, Pose) else _pose(origin)
    source = Source("the grid", reading=Reading(unknown=unknown))
    states = _states(source, array, occupied)
    shapes = cell_shapes(source, states if rows == "up" else states[::-1], side, pose, "unknown")
    return shapes_of(source, "grid", shapes, {}, _ROBOT).scene(parts)


def _states(source: Source, array: Any, occupied: int) -> States:
    values, known = _values(array)
    if values.dtype == bool:
        return np.where(known, np.where(values, OCCUPIED, FREE), UNKNOWN).astype(np.int8)
    if occupied > 1 and (values[known] == 1).any() and (values[known] <= 1).all():
        raise ValueError("array: no value above 1; multiply by 100, or give occupied=1 if 1 is occupied")
    inside = known & (values >= 0) & (values <= 100)
    beyond = known & ~inside & (values != -1)
    source.note("info", "value outside of 0 to 100, unknown", "unknown", count=int(beyond.sum()))
    low = inside & (values > 0) & (values < occupied)
    what, remedy = "free cell with a value above 0", f"occupied={occupied}"
    source.note("assumption", what, "less", count=int(low.sum()), remedy=remedy)
    return np.where(inside, np.where(values >= occupied, OCCUPIED, FREE), UNKNOWN).astype(np.int8)


def _values(array: Any) -> tuple[NDArray[Any], NDArray[np.bool_]]:
    """Return the values of a grid, and a mask of those that a masked array does not hide."""
    given = array if isinstance(array, np.ndarray) else np.asarray(array)
    known = ~np.ma.getmaskarray(given)
    values: NDArray[Any] = np.ma.getdata(given)
    if values.ndim != 2 or not values.size:
        shape = " x ".join(map(str, values.shape)) or "one value"
        raise ValueError(f"array: {shape}; give rows of cells: np.reshape(data, (info.height, info.width))")
    if values.size > MOST_CELLS:
        raise ValueError(f"array: {values.size:,} cells; give at most {MOST_CELLS:,}")
    if values.dtype.kind not in "biuf":
        raise ValueError(f"array: values of type {values.dtype}; give integers from 0 to 100, -1 for unknown, or bool")
    if values.dtype.kind == "f":
        if not np.isfinite(values[known]).all():
            raise ValueError("array: a value that is not finite; give -1 for unknown")
        if (values[known] <= 1).all():
            raise ValueError("array: floats from 0 to 1; multiply by 100, as occupancies are from 0 to 100")
    return values, known


def _pose(origin: Sequence[Number]) -> Pose:
    numbers = tuple(origin)
    if len(numbers) != 3:
        raise ValueError(f"origin: {numbers}; give (x, y, yaw)")
    return Pose(*numbers)
