"""Write audits of floor plans: a table of doors as CSV, or doors and rooms as GeoJSON; and proofs, a file each.

| feature | geometry | properties |
|---|---|---|
| door, for each machine | LineString | role "door" and the columns of the table |
| room | Polygon | role "room", name |

Coordinates are those of the scene, not degrees on the globe.
"""

from __future__ import annotations

import csv
import io
import json
import re
from collections import Counter
from os import PathLike
from pathlib import Path
from typing import Any

from cfree.analysis.audit import Audit, Door
from cfree.formats.answers.answer_file import save_separation
from cfree.formats.scene_file import save_scene
from cfree.formats.text.atomic import checked_suffix, replacing


def door_facts(door: Door) -> dict[str, Any]:
    """Return the columns of a door; the missing width is empty unless it is blocked."""
    (x, y), missing = door.middle, door.missing
    return {
        "machine": door.machine,
        "door": door.name,
        "x": x,
        "y": y,
        "width": door.width,
        "from": door.rooms[0],
        "to": door.rooms[1],
        "result": door.result,
        "missing_at_least": missing.lo if missing else None,
        "missing_at_most": missing.hi if missing else None,
    }


def save_audit(audited: Audit, path: str | PathLike[str]) -> None:
    """Write an audit to a ``.csv`` or ``.geojson`` file."""
    if check_audit_path(path) == ".csv":
        text = io.StringIO()
        rows = [door_facts(door) for door in audited.doors]
        names = list(rows[0]) if rows else ["machine", "door", "result"]
        table = csv.DictWriter(text, names, lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
        content = text.getvalue()
    else:
        content = json.dumps(audit_geojson(audited)) + "\n"
    with replacing(path) as unfinished:
        unfinished.write_text(content, encoding="utf-8")


def audit_geojson(audited: Audit) -> dict[str, Any]:
    """Return the feature collection of an audit."""
    import shapely

    features = [
        _feature({"type": "LineString", "coordinates": [*map(list, door.ends)]}, role="door", **door_facts(door))
        for door in audited.doors
    ]
    features += [
        _feature(shapely.geometry.mapping(shapely.orient_polygons(room)), role="room", name=name)
        for name, room in audited.rooms.items()
    ]
    return {"type": "FeatureCollection", "features": features}


def save_proofs(audited: Audit, folder: str | PathLike[str]) -> list[tuple[Path, Path]]:
    """Write the proofs of blocked doors, and the scene of each machine; return the pairs that `cfree verify` checks."""
    Path(folder).mkdir(exist_ok=True)
    pairs = []
    for machine, scene in audited.machines.items():
        file = Path(folder, f"{_plain(machine)}-scene.json")
        proofs = [(door, proof) for door in audited.blocked if door.machine == machine for proof in door.proofs]
        if proofs:
            save_scene(scene, file)
        counts: Counter[str] = Counter()
        for door, proof in proofs:
            counts[door.name] += 1
            pairs.append((file, Path(folder, f"{_plain(machine)}-{_plain(door.name)}-{counts[door.name]}.json")))
            save_separation(proof, pairs[-1][1])
    return pairs


def _plain(name: str) -> str:
    """Return a name as a part of a file's name."""
    return re.sub(r"[^\w-]+", "-", name).strip("-") or "x"


def check_audit_path(path: str | PathLike[str]) -> str:
    """Return the suffix of a file that `save_audit` can write."""
    return checked_suffix(path, "audit", (".csv", ".geojson"))


def _feature(geometry: Any, **properties: Any) -> dict[str, Any]:
    return {"type": "Feature", "properties": properties, "geometry": geometry}
