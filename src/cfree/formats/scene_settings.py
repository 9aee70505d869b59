"""What a scene has beside its shapes, in files of shapes: GeoJSON's properties, SVG's and DXF's own text."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from pydantic import TypeAdapter, ValidationError

from cfree.exact.pose import Pose
from cfree.formats.findings import Findings
from cfree.formats.json_positions import Path
from cfree.formats.scene_format import Bounds, Configuration, Goal, Plain, Text, report
from cfree.scene.scene import Scene

ADAPTERS: dict[str, TypeAdapter[Any]] = {
    "bounds": TypeAdapter(Bounds),
    "start": TypeAdapter(Configuration),
    "goal": TypeAdapter(Goal),
    "goals": TypeAdapter(list[Goal]),
    "units": TypeAdapter(Text),
    "note": TypeAdapter(Text),
    "scene": TypeAdapter(Text),
    "source": TypeAdapter(dict[str, Text]),
    "check": TypeAdapter(Plain),
}


def read_settings(findings: Findings, data: object, path: Path) -> dict[str, Any]:
    """Settings of a scene among the members of an object, others left alone; faults go to `findings`."""
    found: dict[str, Any] = {}
    if not isinstance(data, dict):
        return found
    for key, adapter in ADAPTERS.items():
        if data.get(key) is None:
            continue
        try:
            found["name" if key == "scene" else key] = adapter.validate_python(data[key])
        except ValidationError as error:
            for item in error.errors(include_url=False, include_input=False):
                report(findings, (*path, key, *item["loc"]), item)
    if found.get("goal") is not None and found.pop("goals", None):
        findings.under((*path, "goals"), 'there is a "goal", too; give one of them')
    return found


def settings_of(scene: Scene) -> dict[str, Any]:
    """The same of a scene, as values that JSON has; exact numbers as texts."""
    found: dict[str, Any] = {
        "bounds": [_exact(value) for value in scene.bounds] if scene.bounds else None,
        "start": _goal(scene.start) if scene.start else None,
        "goal": _goal(scene.goal) if scene.goal else None,
        "goals": [_goal(goal) for goal in scene.goals],
        "units": scene.units,
        "note": scene.note,
        "scene": scene.name,
        "source": dict(scene.source),
        "check": dict(scene.check),
    }
    return {key: value for key, value in found.items() if value}


def _goal(goal: Any) -> list[Any]:
    if not isinstance(goal, Pose):
        return [_exact(value) for value in goal]
    return [_exact(goal.x), _exact(goal.y), {"tau": "inf" if goal.tau is None else str(goal.tau)}]


def _exact(value: Fraction) -> int | str:
    return int(value) if value.denominator == 1 else str(value)
