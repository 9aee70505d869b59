"""Read ROS files: occupancy maps (map_server's YAML beside an image), and footprints in nav2's parameters.

Each cell of a map is a square; its side is the resolution. The lower left corner of the image is at the origin, turned
by its yaw. Cells become polygons exactly. A cell is an obstacle if it is darker than ``occupied_thresh``, free if
lighter than ``free_thresh``, else unknown.
"""

from __future__ import annotations

import warnings
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree.curves.drawn import Ring, arc_of_circle
from cfree.curves.hulls import Outline, polygon_of
from cfree.errors import CfreeError, FormatError
from cfree.exact.number import to_fraction
from cfree.exact.pose import Pose
from cfree.formats.drawings.footprints import footprint
from cfree.formats.drawings.grid import Mask, outlines
from cfree.formats.drawings.source import Source, read_bytes, shapes_of, tolerance_of
from cfree.formats.drawings.yaml_nodes import every, members, read_nodes, written
from cfree.formats.shapes import Shape, Shapes
from cfree.polygons.polygon import Polygon
from cfree.words import counted

MOST_CELLS = 1 << 26
_IMAGES = ["PPM", "PNG", "BMP"]
_ROBOT = "give one: --robot with a footprint or a file, or shapes.scene(robot)"


def read_yaml(source: Source) -> Shapes:
    """Read a map if there is an ``image``, else footprints."""
    root = read_nodes(source)
    if "image" in (keys := members(root)):
        return _map(source, keys)
    return _parameters(source, root)


# footprints


def _parameters(source: Source, root: Any) -> Shapes:
    polygons: dict[Polygon, Any] = {}
    radii: list[tuple[Fraction, Any]] = []
    for key, node in every(root, ("footprint", "robot_radius", "footprint_padding")):
        text = written(source, node)
        try:
            if key == "footprint" and text.strip() not in ("", "[]"):
                polygons.setdefault(footprint(text), node)
            elif key == "robot_radius":
                radii.append((_above_zero(text), node))
            elif key == "footprint_padding" and to_fraction(text):
                source.note("lost", f"{key} {text}: the robot is not grown by it", "less")
        except (FormatError, ValueError) as error:
            _fault(source, node, key, str(error).removeprefix("footprint: "))
    if not polygons:
        for radius, node in radii:
            polygon = _disc(source, radius)
            polygons.setdefault(polygon, node)
    elif radii:
        source.note("lost", "robot_radius: there is also a footprint", "less", count=len(radii))
    if len(polygons) > 1:
        for node in list(polygons.values())[1:]:
            _fault(
                source, node, "footprint", f"another one than in line {_line(next(iter(polygons.values())))}; keep one"
            )
    elif not polygons and not len(source.findings):
        source.findings.at(0, "", 'no "image" of a map, no "footprint" and no "robot_radius"; give one of them')
    shapes = [Shape("robot", None, polygon) for polygon in polygons]
    return shapes_of(source, "nav2 parameters", shapes, {"units": "m"}, _ROBOT)


def _disc(source: Source, radius: Fraction) -> Polygon:
    ring: Ring = [arc_of_circle((0.0, 0.0), float(radius))]
    tolerance = tolerance_of(source, [ring])
    source.note("info", f"robot_radius {float(radius):g}: a polygon around the disc, within {tolerance:g}")
    return polygon_of(Outline(ring), tolerance, spend=source.spend)


# maps


def _map(source: Source, keys: dict[str, Any]) -> Shapes:
    resolution = _read(source, keys, "resolution", _above_zero, Fraction(1))
    occupied = _read(source, keys, "occupied_thresh", _share, Fraction(65, 100))
    free = _read(source, keys, "free_thresh", _share, Fraction(196, 1000))
    negate = _read(source, keys, "negate", _truth, False)
    mode = _read(source, keys, "mode", _mode, "trinary")
    origin = _read(source, keys, "origin", _pose, Pose(0, 0))
    for key in ("image", "resolution", "origin"):
        if key not in keys:
            source.findings.at(0, "", f'key "{key}" is missing; add it')
    source.findings.fail_if_any()
    values, opaque = _image(source, keys["image"])
    table = [_state(Fraction(v), occupied, free, negate, mode) for v in range(256)]
    states = np.array(table, dtype=np.int8)[values]
    if mode == "scale":
        states[~opaque] = -1
    states = states[::-1]  # the first row of an image is its top
    marked: Mask = states > 0
    unknown = int((states < 0).sum())
    if source.reading.unknown == "obstacle":
        marked |= states < 0
    rows, columns = marked.shape
    if origin.theta_error:
        off = origin.theta_error * float(resolution) * (rows + columns)
        source.note("info", f"yaw of the origin: within {origin.theta_error:.1g} radians, cells within {off:.1g}")
    if unknown:
        what = "obstacles" if source.reading.unknown == "obstacle" else "free"
        source.note("info", f"{counted(unknown, 'unknown cell')}: {what}")

    def placed(ring: list[tuple[int, int]]) -> list[Any]:
        return list(origin.apply_exact([(x * resolution, y * resolution) for x, y in ring]))

    shapes = [
        Shape("obstacle", None, Polygon(placed(outer), [placed(hole) for hole in holes]))
        for outer, *holes in outlines(marked, source.spend)
    ]
    if source.reading.unknown == "obstacle":
        edge = placed([(0, 0), (columns, 0), (columns, rows), (0, rows)])
        shapes.append(Shape("workspace", None, Polygon(edge)))
        source.note("info", "the outside of the map is also unknown: the map's edge is the workspace")
    return shapes_of(source, "ROS map", shapes, {"units": "m"}, _ROBOT)


def _state(value: Fraction, occupied: Fraction, free: Fraction, negate: bool, mode: str) -> int:
    """Return the state of a grey value: 1 occupied, 0 free, -1 unknown."""
    if mode == "raw":
        share = value / 100
        if share > 1:
            return -1
    else:
        share = value / 255 if negate else 1 - value / 255
    return 1 if share > occupied or (mode == "raw" and share >= occupied) else 0 if share < free else -1


def _image(source: Source, node: Any) -> tuple[NDArray[np.uint8], Mask]:
    """Return grey values by rows from the top, and a mask of the opaque cells."""
    from io import BytesIO

    from PIL import Image

    name, folder = written(source, node), source.folder.resolve()
    try:
        file = (folder / name).resolve()
        inside = file.is_relative_to(folder)
    except (OSError, ValueError, RuntimeError):
        inside = False
    if not inside or Path(name).is_absolute():
        _fault(source, node, "image", f"{name[:60]!r} is outside of the map's folder; put it beside the map")
        source.findings.fail_if_any()
    try:
        raw = read_bytes(str(file))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with Image.open(BytesIO(raw), formats=_IMAGES) as image:
                width, height = image.size
                if width * height > MOST_CELLS:
                    raise ValueError(f"{width} x {height} cells; give at most {MOST_CELLS:,}")
                alpha = image.convert("LA").getchannel("A") if "A" in image.getbands() or image.info else None
                pixels = np.asarray(image if image.mode in ("L", "1") else _grey(image))
                opaque = np.full(pixels.shape, True) if alpha is None else np.asarray(alpha) == 255
    except CfreeError as error:
        _fault(source, node, "image", str(error))
    except Exception as error:  # Pillow's readers raise errors of many types
        reason = str(error).partition("<")[0].strip() or type(error).__name__
        _fault(source, node, "image", f"{name[:60]}: {reason}; give a PGM, PNG or BMP image")
    source.findings.fail_if_any()
    values = pixels.astype(np.uint8) * (255 if pixels.dtype == bool else 1)
    return values, opaque


def _grey(image: Any) -> Any:
    """Return the average of the channels, as map_server computes it."""
    if image.mode.startswith("I") or image.mode == "F":
        most = 65535 if np.asarray(image).max(initial=0) > 255 else 255
        return np.asarray(image, dtype=np.float64) * 255 // most
    return np.asarray(image.convert("RGB"), dtype=np.uint32).sum(axis=2) // 3


# values


def _read(source: Source, keys: dict[str, Any], key: str, reader: Any, default: Any) -> Any:
    if key not in keys:
        return default
    try:
        return reader(written(source, keys[key]))
    except ValueError as error:
        _fault(source, keys[key], key, str(error))
        return default


def _above_zero(text: str) -> Fraction:
    value = to_fraction(text)
    if not Fraction(1, 10**9) < value < 10**9:
        raise ValueError(f"{text[:60]}; give a length above 0, from 1e-9 to 1e9")
    return value


def _share(text: str) -> Fraction:
    value = to_fraction(text)
    if not 0 <= value <= 1:
        raise ValueError(f"{text[:60]}; give a number from 0 to 1")
    return value


def _truth(text: str) -> bool:
    known = {"0": False, "1": True, "false": False, "true": True, "no": False, "yes": True}
    if text.lower() not in known:
        raise ValueError(f"{text[:60]!r}; give 0 or 1")
    return known[text.lower()]


def _mode(text: str) -> str:
    if text not in ("trinary", "scale", "raw"):
        raise ValueError(f"{text[:60]!r}; give trinary, scale or raw")
    return text


def _pose(text: str) -> Pose:
    try:
        x, y, yaw = map(to_fraction, text.strip("[] ").split(","))
    except ValueError:
        raise ValueError(f"{text[:60]}; give [x, y, yaw]") from None
    if max(abs(x), abs(y), abs(yaw)) > 10**9:
        raise ValueError(f"{text[:60]}; give numbers below 1e9")
    return Pose(x, y, yaw)


def _fault(source: Source, node: Any, place: str, message: str) -> None:
    source.findings.at(node.start_mark.index, place, message)


def _line(node: Any) -> int:
    return int(node.start_mark.line) + 1
