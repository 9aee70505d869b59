"""Read ROS files: occupancy maps (map_server's YAML beside an image), and the YAML of parameters with footprints.

Each cell of a map is a square; its side is the resolution. The lower left corner of the image is at the origin, turned
by its yaw. Cells become polygons exactly. The rules of the map servers decide which cells are occupied, see
`map_rules.py`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from cfree.errors import CfreeError
from cfree.exact.number import to_fraction
from cfree.exact.pose import Pose
from cfree.formats.drawings.cells import BETWEEN, FREE, OCCUPIED, UNKNOWN, Place, States, cell_shapes
from cfree.formats.drawings.map_image import MapImage, read_image
from cfree.formats.drawings.map_rules import SAVED_UNKNOWN, SERVERS, Mode, Thresholds, Values, published
from cfree.formats.drawings.nav2 import ROBOT, read_parameters
from cfree.formats.drawings.source import Source, read_bytes, shapes_of
from cfree.formats.drawings.yaml_nodes import above_zero, fault, members, read_nodes, written
from cfree.formats.shapes import Shapes
from cfree.scene.reading import Effect, Kind

T = TypeVar("T")
Flags = NDArray[np.bool_]
MODES: dict[str, Mode] = {"trinary": "trinary", "scale": "scale", "raw": "raw"}


def read_yaml(source: Source) -> Shapes:
    """Read a map if there is an ``image``, else footprints."""
    root = read_nodes(source)
    if "image" in (keys := members(root)):
        return _map(source, keys)
    return read_parameters(source, root)


def _map(source: Source, keys: dict[str, Any]) -> Shapes:
    resolution = _read(source, keys, "resolution", above_zero, Fraction(1))
    origin = _read(source, keys, "origin", _pose, Pose(0, 0))
    limits = Thresholds(
        _read(source, keys, "occupied_thresh", _share, 0.65),
        _read(source, keys, "free_thresh", _share, 0.196),
        _read(source, keys, "negate", _truth, False),
        _read(source, keys, "mode", _mode, "trinary"),
    )
    for key in ("image", "resolution", "origin"):
        if key not in keys:
            source.findings.at(0, "", f'key "{key}" is missing; add it')
    source.findings.fail_if_any()
    for key in ("occupied_thresh", "free_thresh"):
        if key not in keys and limits.mode != "raw":
            source.note("info", "default threshold", where=key)
    if limits.occupied < limits.free and limits.mode != "raw":
        source.note("warning", "occupied_thresh below free_thresh", "unknown")
    image = _image(source, keys["image"])
    cells = _Cells(source, image, Place(resolution, origin))
    values = cells.values(limits)
    states = _states(values)
    if (grey := source.reading.unknown_grey) is not None:
        states = cells.with_unknown_grey(states, grey)
    elif limits.mode != "raw":
        is_trap = (image.colours.greys == SAVED_UNKNOWN) & (states == FREE)
        what, remedy = "free cell, unknown to map_saver", "--free-thresh 0.196"
        cells.note("warning", what, "less", is_trap, f"grey {SAVED_UNKNOWN}", f"{remedy} or --unknown-grey 205")
    states = cells.with_occupied(states, values)
    shapes = cell_shapes(source, states[image.pixels][::-1], resolution, origin, "unknown")  # the first row is the top
    return shapes_of(source, "ROS map", shapes, {"units": "m", "source": {"frame": "map"}}, ROBOT)


class _Cells:
    """The cells of an image while it is read: decisions about colours, and notes about the cells that have them."""

    def __init__(self, source: Source, image: MapImage, place: Place) -> None:
        self.source, self.place = source, place
        self.colours, self.pixels, self.counts = image.colours, image.pixels, image.counts

    def note(self, kind: Kind, what: str, effect: Effect, are: Flags, where: str = "", remedy: str = "") -> None:
        """Note the cells of some colours, with the place of the first."""
        count = int(self.counts[are].sum())
        if count:
            columns = self.pixels.shape[1]
            row, column = divmod(int(are[self.pixels].argmax()), columns)
            middle = self.place.middle(self.pixels.shape[0] - 1 - row, column)
            self.source.note(kind, what, effect, count=count, where=where, at=middle, remedy=remedy)

    def values(self, limits: Thresholds) -> Values:
        """Return what the requested map server publishes for each colour; note where servers disagree."""
        reading = self.source.reading
        rules, own = reading.map_rules, limits
        if reading.free_thresh is not None:
            limits = replace(limits, free=reading.free_thresh)
        values = published(rules, self.colours, limits)
        what = "free cell by another threshold"
        is_freed = (values == FREE) & (published(rules, self.colours, own) != FREE)
        self.note("assumption", what, "less", is_freed, remedy=f"--free-thresh {limits.free:g}")
        self.source.note("info", f"cells by the {rules} rules")
        if rules == "strict":
            servers = [published(server, self.colours, limits) for server in SERVERS]
            is_disputed = (values != FREE) & np.any([other == FREE for other in servers], axis=0)
            what, remedy = "forbidden cell that some map servers free", "--map-rules ros1, nav2 or nav2-old"
            self.note("info", what, "more", is_disputed, remedy=remedy)
        else:
            strict = published("strict", self.colours, limits)
            unknown_is_free = reading.unknown == "free"
            is_disputed = _are_free(values, unknown_is_free) & ~_are_free(strict, unknown_is_free)
            what = "free cell that another map server forbids"
            self.note("assumption", what, "less", is_disputed, remedy="--map-rules strict")
        return values

    def with_unknown_grey(self, states: States, grey: int) -> States:
        """Return states in which the cells of a grey are unknown."""
        is_grey = self.colours.greys == grey
        if self.source.reading.unknown == "free":
            what = "forbidden cell, taken as unknown"
            self.note("assumption", what, "less", is_grey & (states > FREE), remedy=f"--unknown-grey {grey}")
        return np.where(is_grey, np.int8(UNKNOWN), states)

    def with_occupied(self, states: States, values: Values) -> States:
        """Return states in which cells in between are obstacles, from a requested value up."""
        is_between = states == BETWEEN
        present = values[is_between & (self.counts > 0)]
        if not present.size:
            return states
        where = f"values {present.min()} to {present.max()}"
        least = self.source.reading.occupied
        if least is None:
            what = "forbidden cell in between"
            self.note("guess", what, "more", is_between, where, "--occupied 65")
            return states
        is_freed = is_between & (values < least)
        what = "cell in between, freed by its value"
        self.note("assumption", what, "less", is_freed, where, f"--occupied {least}")
        states = np.where(is_between, np.int8(OCCUPIED), states)
        return np.where(is_freed, np.int8(FREE), states)


def _states(values: Values) -> States:
    states = np.full(values.shape, BETWEEN, dtype=np.int8)
    states[values == 0] = FREE
    states[values < 0] = UNKNOWN
    states[values >= 100] = OCCUPIED
    return states


def _are_free(values: Values, unknown_is_free: bool) -> Flags:
    return np.isin(values, [FREE, UNKNOWN] if unknown_is_free else [FREE])


def _image(source: Source, node: Any) -> MapImage:
    """Read the image beside the file, or below."""
    name, folder = written(source, node), source.folder.resolve()
    try:
        file = (folder / name).resolve()
        inside = file.is_relative_to(folder)
    except (OSError, ValueError, RuntimeError):
        inside = False
    if not inside:
        fault(source, node, "image", f"{name[:60]!r} is outside of the map's folder; put it beside the map")
        source.findings.fail_if_any()
    image = None
    try:
        image = read_image(read_bytes(str(file)))
    except CfreeError as error:
        fault(source, node, "image", str(error))
    except Exception as error:  # Pillow's readers raise errors of many types
        reason = str(error).partition("<")[0].strip() or type(error).__name__
        fault(source, node, "image", f"{name[:60]}: {reason}; give a PGM, PNG or BMP image")
    source.findings.fail_if_any()
    assert image is not None
    if image.has_palette:
        kind: Kind = "warning" if source.reading.map_rules == "ros1" else "info"
        source.note(kind, "image with a palette: ROS 1 takes numbers of colours for greys", "unknown")
    return image


# values


def _read(source: Source, keys: dict[str, Any], key: str, reader: Callable[[str], T], default: T) -> T:
    if key not in keys:
        return default
    try:
        return reader(written(source, keys[key]))
    except ValueError as error:
        fault(source, keys[key], key, str(error))
        return default


def _share(text: str) -> float:
    value = to_fraction(text)
    if not 0 <= value <= 1:
        raise ValueError(f"{text[:60]}; give a number from 0 to 1")
    return float(value)


def _truth(text: str) -> bool:
    known = {"0": False, "1": True, "false": False, "true": True, "no": False, "yes": True}
    if text.lower() not in known:
        raise ValueError(f"{text[:60]!r}; give 0 or 1")
    return known[text.lower()]


def _mode(text: str) -> Mode:
    if text.lower() not in MODES:
        raise ValueError(f"{text[:60]!r}; give trinary, scale or raw")
    return MODES[text.lower()]


def _pose(text: str) -> Pose:
    try:
        x, y, yaw = map(to_fraction, text.strip("[] ").split(","))
    except ValueError:
        raise ValueError(f"{text[:60]}; give [x, y, yaw]") from None
    if max(abs(x), abs(y), abs(yaw)) > 10**9:
        raise ValueError(f"{text[:60]}; give numbers below 1e9")
    return Pose(x, y, yaw)
