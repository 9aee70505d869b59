"""Settings of a scene in files of shapes: properties of GeoJSON, texts of SVG and DXF."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from pydantic import TypeAdapter, ValidationError

from cfree.exact.pose import Pose
from cfree.formats.scenes.reading_format import NoteModel
from cfree.formats.scenes.reading_text import records
from cfree.formats.scenes.scene_format import Bounds, Configuration, Goal, Plain, Text, VehicleValue, report
from cfree.formats.scenes.scene_values import vehicle_record
from cfree.formats.text.findings import Findings
from cfree.formats.text.json_positions import Path
from cfree.scene.scene import Scene

ADAPTERS: dict[str, TypeAdapter[Any]] = {
    "bounds": TypeAdapter(Bounds),
    "start": TypeAdapter(Configuration),
    "goal": TypeAdapter(Goal),
    "goals": TypeAdapter(list[Goal]),
    "vehicle": TypeAdapter(VehicleValue),
    "units": TypeAdapter(Text),
    "note": TypeAdapter(Text),
    "scene": TypeAdapter(Text),
    "source": TypeAdapter(dict[str, Text]),
    "check": TypeAdapter(Plain),
    "reading": TypeAdapter(list[NoteModel]),
}


def read_settings(findings: Findings, data: object, path: Path) -> dict[str, Any]:
    """Read the settings of a scene among the members of an object, ignore others; faults go to `findings`."""
    settings: dict[str, Any] = {}
    if not isinstance(data, dict):
        return settings
    for key, adapter in ADAPTERS.items():
        if data.get(key) is None:
            continue
        try:
            settings["name" if key == "scene" else key] = adapter.validate_python(data[key])
        except ValidationError as error:
            for item in error.errors(include_url=False, include_input=False):
                report(findings, (*path, key, *item["loc"]), item)
    if notes := settings.get("reading"):
        settings["reading"] = tuple(note.made for note in notes)
    if settings.get("goal") is not None and settings.pop("goals", None):
        findings.under((*path, "goals"), 'there is also a "goal"; give one of them')
    return settings


def settings_of(scene: Scene) -> dict[str, Any]:
    """Return the settings of a scene as values of JSON; exact numbers are texts."""
    settings: dict[str, Any] = {
        "bounds": [_exact(value) for value in scene.bounds] if scene.bounds else None,
        "start": _goal(scene.start) if scene.start else None,
        "goal": _goal(scene.goal) if scene.goal else None,
        "goals": [_goal(goal) for goal in scene.goals],
        "vehicle": vehicle_record(scene.vehicle) if scene.vehicle else None,
        "units": scene.units,
        "note": scene.note,
        "scene": scene.name,
        "source": dict(scene.source),
        "check": dict(scene.check),
        "reading": records(scene.reading),
    }
    return {key: value for key, value in settings.items() if value}


def _goal(goal: Any) -> list[Any]:
    if not isinstance(goal, Pose):
        return [_exact(value) for value in goal]
    return [_exact(goal.x), _exact(goal.y), {"tau": "inf" if goal.tau is None else str(goal.tau)}]


def _exact(value: Fraction) -> int | str:
    return int(value) if value.denominator == 1 else str(value)
