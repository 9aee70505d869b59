"""Write sampled paths as text: CSV, a ROS message, GeoJSON; `docs/answer-format.md` describes them."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from itertools import repeat
from typing import TYPE_CHECKING, Any

from cfree.exact.pose import Pose, Poses
from cfree.formats.scenes.reading_text import records
from cfree.paths.path import Path

if TYPE_CHECKING:
    from cfree.scene.scene import Scene


def csv_text(path: Path, step: float, turn: float, seconds: Sequence[float] | None = None) -> str:
    """Return poses as lines x,y,theta, with t if times are given, and for a vehicle gear,curvature,axle_x,axle_y.

    The gear is 1 forward, -1 backward, 0 in place; the curvature is positive to the left, and inf in place. Both are
    those of the motion that leads to the pose.
    """
    heads = [
        "x,y,theta",
        *(["t"] if seconds is not None else []),
        *(["gear,curvature,axle_x,axle_y"] if path.vehicle else []),
    ]
    rows = [f"{x!r},{y!r},{theta!r}" for x, y, theta in _rows(path, step, turn)]
    if seconds is not None:
        rows = [f"{row},{t!r}" for row, t in zip(rows, seconds, strict=True)]
    if path.vehicle:
        driven = zip(rows, _driven(path, step, turn), strict=True)
        rows = [f"{row},{gear},{curvature!r},{x!r},{y!r}" for row, (gear, curvature, x, y) in driven]
    return "\n".join([",".join(heads), *rows]) + "\n"


def ros_text(path: Path, step: float, turn: float, seconds: Sequence[float] | None = None) -> str:
    """Return poses as a ROS 2 message nav_msgs/Path in YAML; stamps are zero without times.

    For a vehicle they are those of its axle: the axle point, and forward.
    """
    frame = _quoted(path.frame)
    lines = [f"header: {_header(frame, 0.0)}", "poses:"]
    for (x, y, theta), t in zip(_of_axle(path, _rows(path, step, turn)), seconds or repeat(0.0), strict=False):
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
    driven = [*_driven(path, step, turn)] * (1 if path.motions else 2) if path.vehicle else []
    for n, (role, (motion, share)) in enumerate(zip(roles, places, strict=True)):
        rings = iter([*outline[n], outline[n][0]] for outline in outlines)
        polygons = [[next(rings) for _ in range(count)] for count in parts]
        kind: str = "Polygon" if len(polygons) == 1 else "MultiPolygon"
        coordinates: list[Any] = polygons[0] if len(polygons) == 1 else polygons
        (x, y), theta = poses.xy[n].tolist(), thetas[n]
        shape = {"type": kind, "coordinates": coordinates}
        when: dict[str, Any] = {} if seconds is None else {"t": seconds[n]}
        if driven:
            gear, curvature, *axle = driven[n]
            when |= {"gear": gear, "curvature": curvature if math.isfinite(curvature) else None, "axle": axle}
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


def _driven(path: Path, step: float, turn: float) -> Iterator[tuple[int, float, float, float]]:
    """Yield gear, curvature and axle point at each of the poses; the start has those of the first motion."""
    gears = {"forward": 1, "backward": -1, "turning": 0}
    of_motion = {k: part for part in path.driving for k in range(part.first, part.last + 1)}
    motions = [0, *(k for k, shares in enumerate(path.shares(step, turn)) for _ in shares)]
    for k, (x, y, _) in zip(motions, _of_axle(path, _rows(path, step, turn)), strict=True):
        part = of_motion.get(k)
        yield (0, 0.0, x, y) if part is None else (gears[part.gear], part.curvature, x, y)


def _of_axle(path: Path, rows: Iterator[tuple[float, float, float]]) -> Iterator[tuple[float, float, float]]:
    """Yield the poses of the vehicle's axle; those of the robot without a vehicle."""
    frame = path.vehicle.frame if path.vehicle else Pose(0, 0)
    a, b, heading = float(frame.x), float(frame.y), math.remainder(frame.theta, math.tau)
    for x, y, theta in rows:
        c, s = math.cos(theta), math.sin(theta)
        yield (x + (c * a - s * b), y + (s * a + c * b), theta + heading) if path.vehicle else (x, y, theta)


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
