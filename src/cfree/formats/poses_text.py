"""Texts of sampled paths: CSV, a ROS message, GeoJSON; `docs/answer-format.md` describes them."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from cfree.exact.pose import Poses
from cfree.paths.path import Path

if TYPE_CHECKING:
    from cfree.scene.scene import Scene


def csv_text(path: Path, step: float, turn: float) -> str:
    """Poses as lines x,y,theta."""
    return "x,y,theta\n" + "".join(f"{x!r},{y!r},{theta!r}\n" for x, y, theta in _rows(path, step, turn))


def ros_text(path: Path, step: float, turn: float) -> str:
    """Poses as a ROS 2 message nav_msgs/Path in YAML; all stamps are zero."""
    header = f"{{stamp: {{sec: 0, nanosec: 0}}, frame_id: {_quoted(path.frame)}}}"
    lines = [f"header: {header}", "poses:"]
    for x, y, theta in _rows(path, step, turn):
        z, w = math.sin(theta / 2), math.cos(theta / 2)
        lines += [
            f"- header: {header}",
            "  pose:",
            f"    position: {{x: {_decimal(x)}, y: {_decimal(y)}, z: 0.0}}",
            f"    orientation: {{x: 0.0, y: 0.0, z: {_decimal(z)}, w: {_decimal(w)}}}",
        ]
    return "\n".join(lines) + "\n"


def geojson_text(path: Path, scene: Scene, step: float, turn: float) -> str:
    """The way of the reference point and the robot's outlines, as a GeoJSON feature collection."""
    poses, thetas = path.sample(step, turn), path.angles(step, turn).tolist()
    places = [(0, 0.0), *((k, s) for k, shares in enumerate(path.shares(step, turn)) for s in shares.tolist())]
    if not path.motions:
        poses, thetas, places = Poses.from_poses([path.start] * 2), thetas * 2, places * 2
    roles = ["start", *["pose"] * (len(places) - 2), "goal"]
    way = {"type": "LineString", "coordinates": poses.xy.tolist()}
    features = [_feature(way, role="trace", length=path.length, turning=path.turning)]
    outlines = [poses.apply(ring).tolist() for part in scene.robot for ring in part.rings]
    parts = [len(part.ring_offsets) - 1 for part in scene.robot]
    for n, (role, (motion, share)) in enumerate(zip(roles, places, strict=True)):
        rings = iter([*outline[n], outline[n][0]] for outline in outlines)
        polygons = [[next(rings) for _ in range(count)] for count in parts]
        kind: str = "Polygon" if len(polygons) == 1 else "MultiPolygon"
        coordinates: list[Any] = polygons[0] if len(polygons) == 1 else polygons
        (x, y), theta = poses.xy[n].tolist(), thetas[n]
        shape = {"type": kind, "coordinates": coordinates}
        features.append(_feature(shape, role=role, x=x, y=y, theta=theta, motion=motion, share=share))
    lines = ",\n".join(f"  {json.dumps(feature)}" for feature in features)
    head = f'"type": "FeatureCollection", "units": {json.dumps(path.units)}, "frame": {json.dumps(path.frame)}'
    return f'{{{head},\n "features": [\n{lines}\n]}}\n'


def _rows(path: Path, step: float, turn: float) -> Iterator[tuple[float, float, float]]:
    """Poses along a path, theta not wrapped."""
    thetas = path.angles(step, turn).tolist()
    for (x, y), theta in zip(path.sample(step, turn).xy.tolist(), thetas, strict=True):
        yield x, y, theta


def _feature(geometry: dict[str, Any], **properties: Any) -> dict[str, Any]:
    return {"type": "Feature", "properties": properties, "geometry": geometry}


def _decimal(value: float) -> str:
    """A number that YAML 1.1 does not take for text: 1e-07 has no point."""
    text = repr(value)
    return text if "." in text or "e" not in text else text.replace("e", ".0e")


def _quoted(text: str) -> str:
    """Text in quotes as YAML reads it, whatever is in it."""
    plain = ((c, c.isascii() and c.isprintable()) for c in text)
    return '"' + "".join(json.dumps(c)[1:-1] if is_plain else f"\\U{ord(c):08x}" for c, is_plain in plain) + '"'
