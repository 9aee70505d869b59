"""Write paths as JSON text, exactly; `docs/answer-format.md` describes it, `path_format.py` reads it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from cfree.collision.motion import Motion
from cfree.errors import UnsupportedError
from cfree.exact.number import MAX_DIGITS
from cfree.exact.pose import Pose
from cfree.formats.answers.effect import Effect, Written
from cfree.formats.scenes.reading_text import records
from cfree.formats.scenes.scene_values import vehicle_record
from cfree.formats.text.json_positions import Path as Place
from cfree.formats.text.json_text import json_line
from cfree.paths.path import Path
from cfree.polygons.polygon import Polygon
from cfree.scene.digest import Stamp
from cfree.scene.goals import Moved
from cfree.scene.scene import Scene

if TYPE_CHECKING:
    from cfree.planning.proof import Proof


def path_text(path: Path, stamp: Stamp, keeps: Callable[[Fraction], bool]) -> str:
    """Return the JSON of a path; reading it gives an equal path.

    Parameters
    ----------
    path : Path
    stamp : Stamp
        The stamp of its scene.
    keeps : callable
        True if the path keeps such a clearance on all sides.
    """
    effect = Effect(path, path.goal, stamp)
    decimals = effect.decimals()
    leeway = effect.leeway(decimals)
    head = answer_head("path", path, stamp, decimals)
    head["decimals"] = "free" if leeway is not None and keeps(leeway) else "approximate"
    if path.vehicle:
        head["vehicle"] = vehicle_record(path.vehicle)
    if path.clearance:
        head["clearance"] = _exactly(path.clearance)
    if path.disc:
        head["disc"] = [_exactly(point) for point in path.disc]
    lines = ",\n".join(f"  {json_line(_record(k, motion, decimals))}" for k, motion in enumerate(path.motions))
    members = [*(f'"{key}": {json_line(value)}' for key, value in head.items()), f'"motions": [\n{lines}\n]']
    return "{" + ",\n ".join(members) + "}\n"


def answer_head(kind: str, answer: Path | Proof, stamp: Stamp, decimals: Written) -> dict[str, Any]:
    """Return the members with which every answer begins."""
    return {
        "version": 1,
        "units": answer.units,
        "frame": answer.frame,
        "answer": kind,
        "scene": {"sha256": stamp.sha256, "robot": _exactly(stamp.robot), **_reading(stamp)},
        **({"whole": asdict(answer.whole)} if answer.whole else {}),
        **({"polygons": _polygons(answer.scene)} if answer.scene and has_polygons(answer) else {}),
        "start": _numbers(decimals, ("start",), 3),
        "goal": _numbers(decimals, ("goal",), 3),
        "exact": {"start": exact_pose(answer.start), "goal": exact_pose(answer.goal)},
        **({"moved": _asked(answer.moved)} if answer.moved else {}),
    }


def _reading(stamp: Stamp) -> dict[str, Any]:
    """Return the scene's record of reading, if there is one."""
    return {"reading": records(stamp.reading)} if stamp.reading else {}


def _asked(moved: Moved) -> dict[str, Any]:
    """Return the requested start and goal, exactly."""
    ends = {"start": moved.start, "goal": moved.goal}
    return {name: exact_pose(end) if isinstance(end, Pose) else _exactly(end) for name, end in ends.items() if end}


def has_polygons(answer: Path | Proof) -> bool:
    """True if the answer's scene has polygons in place of the round shapes of the scene it answers."""
    return answer.curved is not None or (answer.scene is not None and answer.stamp is not None)


def _polygons(scene: Scene) -> dict[str, Any]:
    room = scene.workspace
    return {
        "robot": [*map(polygon_record, scene.robot)],
        "obstacles": [*map(polygon_record, scene.obstacles)],
        **({"workspace": polygon_record(room)} if room else {}),
        **({"bounds": [*map(str, scene.bounds)]} if scene.bounds else {}),
    }


def polygon_record(polygon: Polygon) -> dict[str, Any]:
    """Return the exact rings of a polygon as JSON members."""
    outer, *holes = ([[str(x), str(y)] for x, y in ring] for ring in polygon.exact_rings)
    return {"outer": outer, "holes": holes} if holes else {"outer": outer}


def _record(k: int, motion: Motion, decimals: Written) -> dict[str, Any]:
    place, point = ("motions", k), "vector" if motion.pole is None else "pole"
    contacts = [asdict(contact) for contact in motion.contacts]
    return {
        "type": motion.kind,
        **({"contacts": contacts} if contacts else {}),
        point: _numbers(decimals, (*place, point)),
        **({} if motion.kind == "translation" else {"angle": decimals[(*place, "angle")]}),
        "to": _numbers(decimals, (*place, "to"), 3),
        "exact": {name: _exactly(value) for name, value in motion.numbers.items()},
    }


def _numbers(decimals: Written, place: Place, count: int = 2) -> list[Decimal]:
    return [decimals[(*place, k)] for k in range(count)]


def exact_pose(pose: Pose) -> list[Any]:
    """Return the exact numbers of a pose as JSON."""
    return [_exactly(pose.x), _exactly(pose.y), {"tau": "inf" if pose.tau is None else _exactly(pose.tau)}]


def _exactly(value: Any) -> Any:
    """Return exact JSON of a number, of a text that stands for one, or of a tuple of them."""
    if isinstance(value, str):
        return value
    if isinstance(value, tuple):
        return [*map(_exactly, value)]
    bits = value.numerator.bit_length() + value.denominator.bit_length()
    if bits > 3 * MAX_DIGITS:  # a digit has 3.3 bits
        digits = f"about {bits * 0.301:.0f} digits, and files hold {MAX_DIGITS}"
        raise UnsupportedError(f"a number of the path has {digits}; give start and goal in fewer")
    return str(value)
