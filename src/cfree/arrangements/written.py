"""Arrangements as JSON: vertices, edges, faces and cells, by number; `Arrangement` defines the words.

| key | one for each | content |
|---|---|---|
| vertices | vertex | pose [x, y, theta], kind, degree, pairs |
| edges | edge | kind, vertices (none if it is closed), faces around it |
| faces | face | contact [kind, robot feature, obstacle feature], owners, cells [outer, inner], depth, euler |
| cells | cell | pairs, depth, euler, surfaces, volume (null if infinite) |
| statistics | | counts, as `ArrangementStatistics` |

Features are numbers of vertices, or of the edges that start there, over all polygons one after another. Owners and
pairs are [polygon of the robot, obstacle], where obstacle -1 is the bounds and -2 the workspace.
"""

from __future__ import annotations

import json
import math
from dataclasses import asdict
from itertools import pairwise
from os import PathLike
from typing import Any

from cfree.arguments import checked
from cfree.arrangements.arranged import EDGE_KINDS, VERTEX_KINDS, Arrangement
from cfree.formats.text.atomic import checked_suffix, replacing


@checked
def arrangement_json(whole: Arrangement) -> dict[str, Any]:
    """Convert an arrangement to JSON, with the keys of `cfree.arrangements.written`.

    Examples
    --------
    >>> from cfree import Scene
    >>> from cfree.arrangements import arrangement
    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> written = arrangement_json(arrangement(Scene(square, [square])))
    >>> written["cells"][1]["pairs"], written["cells"][1]["depth"], len(written["faces"])
    ([[0, 0]], 1, 32)
    """
    sheets = whole.sheets
    contact = zip(
        *(x[whole.face_patch].tolist() for x in (sheets.contact_kind, sheets.contact_robot, sheets.contact_obstacle)),
        strict=True,
    )
    start, around = whole.edge_start.tolist(), whole.edge_face.tolist()
    statistics = asdict(whole.statistics)
    return {
        "arrangement": 1,
        "vertices": [
            {"pose": pose, "kind": VERTEX_KINDS[kind], "degree": degree, "pairs": pairs}
            for pose, kind, degree, pairs in _rows(
                whole.vertex_pose, whole.vertex_kind, whole.vertex_degree, whole.vertex_pairs
            )
        ],
        "edges": [
            {"kind": EDGE_KINDS[kind], "vertices": ends if ends[0] >= 0 else [], "faces": around[i:j]}
            for (kind, ends), (i, j) in zip(_rows(whole.edge_kind, whole.edge_vertices), pairwise(start), strict=True)
        ],
        "faces": [
            {
                "contact": [("v-e", "e-v")[kind - 1], robot, obstacle],
                "owners": [list(pair) for pair in whole.sets[owners]],
                "cells": cells,
                "depth": depth,
                "euler": euler,
            }
            for (kind, robot, obstacle), (owners, cells, depth, euler) in zip(
                contact, _rows(whole.face_owners, whole.face_cells, whole.face_depth, whole.face_euler), strict=True
            )
        ],
        "cells": [
            {
                "pairs": [list(pair) for pair in cell.pairs],
                "depth": cell.depth,
                "euler": cell.euler,
                "surfaces": cell.surfaces,
                "volume": cell.volume if math.isfinite(cell.volume) else None,
            }
            for cell in whole.cells
        ],
        "statistics": statistics,
    }


@checked
def save_arrangement(whole: Arrangement, path: str | PathLike[str]) -> None:
    """Write an arrangement as JSON, completely or not at all; see `arrangement_json`.

    Raises
    ------
    UnsupportedError
        If the file is not called ``.json``.
    OSError
        If it cannot be written.
    """
    checked_suffix(path, "arrangement", (".json",))
    with replacing(path) as unfinished:
        unfinished.write_text(json.dumps(arrangement_json(whole)) + "\n", encoding="utf-8")


def _rows(*columns: Any) -> zip[Any]:
    return zip(*(column.tolist() for column in columns), strict=True)
