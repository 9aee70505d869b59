"""Write separations as JSON text, exactly; `docs/answer-format.md` describes it, `separation_format.py` reads it."""

from __future__ import annotations

import base64
import json
from typing import Any

from cfree.forbidden.columns import COLUMNS
from cfree.formats.answers.effect import Effect
from cfree.formats.answers.path_text import answer_head, exact_pose, polygon_record
from cfree.formats.scenes.scene_values import vehicle_record
from cfree.formats.text.json_text import json_line
from cfree.paths.path import Path
from cfree.planning.goals import AllSeparated
from cfree.planning.proof import Proof
from cfree.planning.separation import Pieces, Separated
from cfree.planning.stuck import Stuck
from cfree.planning.unreachable import Unreachable
from cfree.polygons.polygon import Polygon
from cfree.scene.digest import Stamp
from cfree.scene.features import branch_bits, unpacked
from cfree.scene.grown_cores import CoreArc, Rounded

KINDS = {1: "vertex-edge", 2: "edge-vertex", 3: "vertex-vertex"}
KIND, QUADRANT = 15, 4  # bits of a contact's kind, and bits below its quadrant
VERTEX_VERTEX = 3
ENDS = ("from", "to")


def separation_text(proof: Separated, stamp: Stamp) -> str:
    """Return the JSON of a separation; reading it gives an equal one."""
    decimals = Effect(Path(proof.start, ()), proof.goal, stamp).decimals()
    head: dict[str, Any] = {
        **answer_head("separated", proof, stamp, decimals),
        "of": proof.of,
        "obstacles": proof.obstacles,
    }
    if proof.robot:
        head["smaller_robot"] = [polygon_record(part) for part in proof.robot]
    if proof.bounds:
        head["larger_bounds"] = [*map(str, proof.bounds)]
    if proof.clearance:
        head["clearance"] = str(proof.clearance)
    if proof.cores:
        head["cores"] = [polygon_record(part) for part in proof.cores]
    if proof.rounded:
        head["rounded"] = {
            name: [_rounded_record(part) for part in parts]
            for name, parts in (("robot", proof.rounded.robot), ("obstacles", proof.rounded.obstacles))
        }
        if proof.rounded.frames:
            head["rounded"]["frames"] = proof.rounded.frames
    if proof.pieces.auxiliary:
        head["auxiliary"] = [
            {"of": a.of, "kind": a.kind, "number": a.number, "points": [[str(x), str(y)] for x, y in a.points]}
            for a in proof.pieces.auxiliary
        ]
    lines = ",\n".join(f"  {json.dumps(record)}" for record in _records(proof.pieces))
    members = [*(f'"{key}": {json_line(value)}' for key, value in head.items()), f'"surface": [\n{lines}\n]']
    return "{" + ",\n ".join(members) + "}\n"


def stuck_text(proof: Stuck, stamp: Stamp) -> str:
    """Return the JSON of a vehicle that is stuck; reading it gives an equal proof."""
    decimals = Effect(Path(proof.start, ()), proof.goal, stamp).decimals()
    head: dict[str, Any] = {
        **answer_head("stuck", proof, stamp, decimals),
        "vehicle": vehicle_record(proof.vehicle),
        "at": proof.at,
        "of": proof.of,
        "obstacles": proof.obstacles,
        "rail": [exact_pose(pose) for pose in proof.rail],
    }
    return "{" + ",\n ".join(f'"{key}": {json_line(value)}' for key, value in head.items()) + "}\n"


def unreachable_text(proof: Unreachable, stamp: Stamp) -> str:
    """Return the JSON of a proof by boxes; reading it gives an equal proof."""
    decimals, grid = Effect(Path(proof.start, ()), proof.goal, stamp).decimals(), proof.grid
    head: dict[str, Any] = {
        **answer_head("unreachable", proof, stamp, decimals),
        "vehicle": vehicle_record(proof.vehicle),
        "at": proof.at,
        "pieces": [[[str(x), str(y)] for x, y in piece] for piece in proof.pieces],
        "grid": {
            "corner": [*map(str, grid.corner)],
            "side": str(grid.side),
            "step": str(grid.step),
            "columns": grid.columns,
            "rows": grid.rows,
            "slices": grid.slices,
        },
        "boxes": base64.b64encode(proof.boxes).decode(),
    }
    return "{" + ",\n ".join(f'"{key}": {json_line(value)}' for key, value in head.items()) + "}\n"


def proof_text(proof: Proof, stamp: Stamp) -> str:
    """Return the JSON of one proof."""
    if isinstance(proof, Separated):
        return separation_text(proof, stamp)
    return stuck_text(proof, stamp) if isinstance(proof, Stuck) else unreachable_text(proof, stamp)


def all_separated_text(answer: AllSeparated, stamp: Stamp) -> str:
    """Return the JSON of separations from all goals; reading it gives an equal answer."""
    head = {"version": 1, "answer": "all separated", "of": answer.of}
    members = [f'"{key}": {json.dumps(value)}' for key, value in head.items()]
    if answer.places:
        members.append(f'"places": {json.dumps([[str(x), str(y)] for x, y in answer.places])}')
    proofs = ",\n".join(proof_text(proof, stamp).rstrip() for proof in answer.proofs)
    return "{" + ",\n ".join([*members, f'"proofs": [\n{proofs}\n]']) + "}\n"


def _records(pieces: Pieces) -> list[dict[str, Any]]:
    t, records = pieces.table, []
    rows = zip(pieces.kind.tolist(), pieces.robot.tolist(), pieces.obstacle.tolist(), strict=True)
    columns = zip(*(getattr(t, name).tolist() for name in COLUMNS), strict=True)
    for (kind, robot, obstacle), values in zip(rows, columns, strict=True):
        row = dict(zip(COLUMNS, values, strict=True))
        contact = {"kind": KINDS[kind & KIND], "robot": robot, "obstacle": obstacle}
        is_circle = kind & KIND == VERTEX_VERTEX
        record: dict[str, Any] = {"contact": contact | ({"quadrant": kind >> QUADRANT} if is_circle else {})}
        record["chart"] = row["chart"]
        for end in ENDS:
            codes = [row[f"{end}_first"], row[f"{end}_second"]]
            angle = {"names": [_parts(c) for c in codes if c], "tau": [row[f"{end}_lo"], row[f"{end}_hi"]]}
            record[end] = angle | ({"place": row[f"{end}_place"]} if row[f"{end}_place"] else {})
        records.append(record | {side: _parts(row[side]) for side in ("lower", "upper")})
    return records


def _parts(code: int) -> list[int]:
    """Return kind, robot feature, obstacle feature and, if it is not 0, the branch of a packed pair."""
    branch = branch_bits(code)
    return [*unpacked(code), *([branch] if branch else [])]


def _arc_record(arc: CoreArc) -> dict[str, Any]:
    places = {"start": arc.start, "end": arc.end, "center": arc.center}
    record: dict[str, Any] = {name: [*map(str, place)] for name, place in places.items()} | {"radius": str(arc.radius)}
    return record | ({"beyond": [[*map(str, place)] for place in arc.beyond]} if arc.beyond else {})


def _rounded_record(shape: Rounded) -> dict[str, Any]:
    radius: dict[str, Any] = {"radius": str(shape.radius)}
    if shape.arcs:
        radius["arcs"] = [_arc_record(arc) for arc in shape.arcs]
    if isinstance(shape.core, Polygon):
        return polygon_record(shape.core) | radius
    return {"points": [[str(x), str(y)] for x, y in shape.core]} | radius
