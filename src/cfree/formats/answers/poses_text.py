"""Write sampled paths as text: CSV, a ROS message, GeoJSON; `docs/answer-format.md` describes them."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from itertools import repeat
from typing import TYPE_CHECKING, Any

from cfree.exact.pose import Poses
from cfree.formats.scenes.reading_text import records
from cfree.paths.path import Path

if TYPE_CHECKING:
    from cfree.scene.scene import Scene


def csv_text(path: Path, step: float, turn: float, seconds: Sequence[float] | None = None) -> str:
    """Return poses as lines x,y,theta, with t if times are given."""
    head = "x,y,theta\n" if seconds is None else "x,y,theta,t\n"
    ends = ("" if seconds is None else f",{t!r}" for t in seconds or repeat(0.0))
    rows = zip(_rows(path, step, turn), ends, strict=seconds is not None)
    return head + "".join(f"{x!r},{y!r},{theta!r}{end}\n" for (x, y, theta), end in rows)


def ros_text(path: Path, step: float, turn: float, seconds: Sequence[float] | None = None) -> str:
    """Return poses as a ROS 2 message nav_msgs/Path in YAML; stamps are zero without times."""
    frame = _quoted(path.frame)
    lines = [f"header: {_header(frame, 0.0)}", "poses:"]
    for (x, y, theta), t in zip(_rows(path, step, turn), seconds or repeat(0.0), strict=False):
        z, w = math.sin(theta / 2), math.cos(theta / 2)
        lines += [
            f"- header: {_header(frame, t)}",
            "  pose:",
            f"    position: {{x: {_decimal(x)}, y: {_decimal(y)}, z: 0.0}}",
            f"    orientation: {{x: 0.0, y: 0.0, z: {_decimal(z)}, w: {_decimal(w)}}}",
        ]
    return "\n".join(lines) + "\n"


def _header(frame: str, t: float) -> str:
    sec, nanosec = divmod(round(t * 10**9), 10**9)
    return f"{{stamp: {{sec: {sec}, nanosec: {nanosec}}}, frame_id: {frame}}}"


def geojson_text(path: Path, scene: Scene, step: float, turn: float, seconds: Sequence[float] | None = None) -> str:
    """Return the path of the reference point and the robot's outlines as a GeoJSON feature collection."""
    poses, thetas = path.sample(step, turn), path.angles(step, turn).tolist()
    places = [(0, 0.0), *((k, s) for k, shares in enumerate(path.shares(step, turn)) for s in shares.tolist())]
    if not path.motions:
        poses, thetas, places = Poses.from_poses([path.start] * 2), thetas * 2, places * 2
        seconds = seconds and [*seconds, *seconds]
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
        when = {} if seconds is None else {"t": seconds[n]}
        features.append(_feature(shape, role=role, x=x, y=y, theta=theta, motion=motion, share=share, **when))
    lines = ",\n".join(f"  {json.dumps(feature)}" for feature in features)
    head = f'"type": "FeatureCollection", "units": {json.dumps(path.units)}, "frame": {json.dumps(path.frame)}'
    if scene.reading:
        head += f', "reading": {json.dumps(records(scene.reading))}'
    return f'{{{head},\n "features": [\n{lines}\n]}}\n'


def _rows(path: Path, step: float, turn: float) -> Iterator[tuple[float, float, float]]:
    """Yield poses along a path; theta is not wrapped."""
    thetas = path.angles(step, turn).tolist()
    for (x, y), theta in zip(path.sample(step, turn).xy.tolist(), thetas, strict=True):
        yield x, y, theta


def _feature(geometry: dict[str, Any], **properties: Any) -> dict[str, Any]:
    return {"type": "Feature", "properties": properties, "geometry": geometry}


def _decimal(value: float) -> str:
    """Write a number so that YAML 1.1 reads no text: it needs a point, which 1e-07 lacks."""
    text = repr(value)
    return text if "." in text or "e" not in text else text.replace("e", ".0e")


def _quoted(text: str) -> str:
    """Quote any text for YAML."""
    plain = ((c, c.isascii() and c.isprintable()) for c in text)
    return '"' + "".join(json.dumps(c)[1:-1] if is_plain else f"\\U{ord(c):08x}" for c, is_plain in plain) + '"'
