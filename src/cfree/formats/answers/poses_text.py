"""Write sampled paths as text: CSV, a ROS message, GeoJSON; `docs/answer-format.md` describes them."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from cfree.errors import UnsupportedError
from cfree.exact.pose import Pose, Poses
from cfree.formats.scenes.reading_text import records
from cfree.paths.driven import Gear
from cfree.paths.path import Path

if TYPE_CHECKING:
    from cfree.paths.timing import Timed
    from cfree.scene.scene import Scene

GEARS: dict[Gear, int] = {"forward": 1, "backward": -1, "turning": 0}


@dataclass(frozen=True)
class Row:
    """A sampled pose, with the motion that leads to it, at the end of a pause with the motion that follows.

    Attributes
    ----------
    index : int
        Among the poses of `Path.sample`.
    motion : int
    share : float
    x, y, theta : float
        Theta is counted on from the start's.
    driven : (gear, curvature, x, y) or None
        For a vehicle; x and y are those of its axle point.
    t : float or None, seconds
    speed, turn_rate : float
        With times only: the speed of the axle point, and the rate of turning.
    """

    index: int
    motion: int
    share: float
    x: float
    y: float
    theta: float
    driven: tuple[int, float, float, float] | None
    t: float | None = None
    speed: float = 0.0
    turn_rate: float = 0.0


def rows_of(path: Path, step: float, turn: float, timed: Timed | None = None) -> list[Row]:
    """Return the poses of a path, sampled; with times two rows at each pause."""
    poses, thetas = path.sample(step, turn).xy.tolist(), path.angles(step, turn).tolist()
    places = [(0, 0.0), *((k, s) for k, shares in enumerate(path.shares(step, turn)) for s in shares.tolist())]
    times: list[tuple[int, int, Any, float, float]]
    if timed is None:
        times = [(n, motion, None, 0.0, 0.0) for n, (motion, _) in enumerate(places)]
    else:
        its = timed.rows(step, turn)
        columns = (its.index, its.motion, its.seconds, its.speeds, its.turn_rates)
        times = [*zip(*(column.tolist() for column in columns), strict=True)]
    axles = [*_of_axle(path, ((x, y, theta) for (x, y), theta in zip(poses, thetas, strict=True)))]
    driven = _driven(path)
    rows = list[Row]()
    for n, k, t, speed, rate in times:
        motion, share = places[n] if k == places[n][0] else (k, 0.0)
        how = (*driven[k], *axles[n][:2]) if driven else None
        x, y = poses[n]
        rows.append(Row(n, motion, share, x, y, thetas[n], how, t, speed, rate))
    return rows


def csv_text(path: Path, step: float, turn: float, timed: Timed | None = None) -> str:
    """Return poses as lines x,y,theta, with t if times are given, and for a vehicle gear,curvature,axle_x,axle_y.

    The gear is 1 forward, -1 backward, 0 in place; the curvature is positive to the left, and inf in place. Both are
    those of the motion that leads to the pose. With times a vehicle has speed,turn_rate as well.
    """
    heads = [
        "x,y,theta",
        *(["t"] if timed else []),
        *(["gear,curvature,axle_x,axle_y"] if path.vehicle else []),
        *(["speed,turn_rate"] if path.vehicle and timed else []),
    ]
    lines = [",".join(heads)]
    for row in rows_of(path, step, turn, timed):
        values: tuple[Any, ...] = row.x, row.y, row.theta
        values += () if row.t is None else (row.t,)
        values += row.driven or ()
        values += () if row.t is None or row.driven is None else (row.speed, row.turn_rate)
        lines.append(",".join(map(repr, values)))
    return "\n".join(lines) + "\n"


def ros_text(path: Path, step: float, turn: float, timed: Timed | None = None) -> str:
    """Return poses as a ROS 2 message nav_msgs/Path in YAML; stamps are zero without times.

    For a vehicle they are those of its axle: the axle point, and forward.
    """
    return _message(path, rows_of(path, step, turn, timed))


def ros_texts_by_gear(path: Path, step: float, turn: float, timed: Timed | None = None) -> list[tuple[str, str]]:
    """Return the gear of each run in one gear, with the poses of its axle as a ROS message.

    Runs share the pose at which the gear changes; each begins when the vehicle drives on there.
    """
    rows = rows_of(path, step, turn, timed)
    runs = [[rows[0]]]
    for row in rows[1:]:
        last = runs[-1][-1]
        if row.driven and last.driven and row.driven[0] != last.driven[0]:
            runs.append([] if row.index == last.index else [last])
        runs[-1].append(row)
    names = {gear: name for name, gear in GEARS.items()}
    return [(names[run[-1].driven[0]], _message(path, run)) for run in runs if run[-1].driven]


def _message(path: Path, rows: Sequence[Row]) -> str:
    frame = _quoted(path.frame)
    lines = [f"header: {_header(frame, 0.0)}", "poses:"]
    axles = _of_axle(path, ((row.x, row.y, row.theta) for row in rows))
    for (x, y, theta), row in zip(axles, rows, strict=True):
        z, w = math.sin(theta / 2), math.cos(theta / 2)
        lines += [
            f"- header: {_header(frame, row.t or 0.0)}",
            "  pose:",
            f"    position: {{x: {_decimal(x)}, y: {_decimal(y)}, z: 0.0}}",
            f"    orientation: {{x: 0.0, y: 0.0, z: {_decimal(z)}, w: {_decimal(w)}}}",
        ]
    return "\n".join(lines) + "\n"


def _header(frame: str, t: float) -> str:
    sec, nanosec = divmod(round(t * 10**9), 10**9)
    if sec >= 2**31:
        raise UnsupportedError(f"a time of {t:.3g} seconds: stamps of ROS end at 2^31; give larger limits")
    return f"{{stamp: {{sec: {sec}, nanosec: {nanosec}}}, frame_id: {frame}}}"


def geojson_text(path: Path, scene: Scene, step: float, turn: float, timed: Timed | None = None) -> str:
    """Return the path of the reference point and the robot's outlines as a GeoJSON feature collection."""
    poses, rows = path.sample(step, turn), rows_of(path, step, turn, timed)
    if not path.motions:
        poses, rows = Poses.from_poses([path.start] * 2), [*rows, replace(rows[0], index=1)]
    roles = ["start", *["pose"] * (len(rows) - 2), "goal"]
    way = {"type": "LineString", "coordinates": poses.xy.tolist()}
    features = [_feature(way, role="trace", length=path.length, turning=path.turning)]
    outlines = [poses.apply(ring).tolist() for part in scene.robot for ring in part.rings]
    parts = [len(part.ring_offsets) - 1 for part in scene.robot]
    for role, row in zip(roles, rows, strict=True):
        rings = iter([*outline[row.index], outline[row.index][0]] for outline in outlines)
        polygons = [[next(rings) for _ in range(count)] for count in parts]
        kind: str = "Polygon" if len(polygons) == 1 else "MultiPolygon"
        coordinates: list[Any] = polygons[0] if len(polygons) == 1 else polygons
        shape = {"type": kind, "coordinates": coordinates}
        when: dict[str, Any] = {} if row.t is None else {"t": row.t}
        if row.driven:
            gear, curvature, *axle = row.driven
            when |= {"gear": gear, "curvature": curvature if math.isfinite(curvature) else None, "axle": axle}
            when |= {} if row.t is None else {"speed": row.speed, "turn_rate": row.turn_rate}
        place = {"x": row.x, "y": row.y, "theta": row.theta, "motion": row.motion, "share": row.share}
        features.append(_feature(shape, role=role, **place, **when))
    lines = ",\n".join(f"  {json.dumps(feature)}" for feature in features)
    head = f'"type": "FeatureCollection", "units": {json.dumps(path.units)}, "frame": {json.dumps(path.frame)}'
    if scene.reading:
        head += f', "reading": {json.dumps(records(scene.reading))}'
    return f'{{{head},\n "features": [\n{lines}\n]}}\n'


def _driven(path: Path) -> list[tuple[int, float]]:
    """Return gear and curvature of each motion; nothing without a vehicle. One that moves nothing has those before."""
    if not path.vehicle:
        return []
    of_motion = {k: part for part in path.driving for k in range(part.first, part.last + 1)}
    part = path.driving[0] if path.driving else None
    driven = list[tuple[int, float]]()
    for k in range(max(1, len(path.motions))):
        part = of_motion.get(k, part)
        driven.append((0, 0.0) if part is None else (GEARS[part.gear], part.curvature))
    return driven


def _of_axle(path: Path, rows: Iterable[tuple[float, float, float]]) -> Iterator[tuple[float, float, float]]:
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
