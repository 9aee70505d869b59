"""Read MovingAI's maps of benchmarks for path finding: a letter a cell, the first row at the top."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from cfree.exact.pose import Pose
from cfree.formats.drawings.cells import FREE, OCCUPIED, cell_shapes
from cfree.formats.drawings.map_image import MOST_CELLS
from cfree.formats.drawings.source import MOST_BYTES, Source, shapes_of
from cfree.formats.shapes import Shapes
from cfree.formats.text.findings import Findings, read_text

_FREE, _SWAMP, _FORBIDDEN = ".G", "S", "@OTW"
_STATES = {**dict.fromkeys(_FREE + _SWAMP, FREE), **dict.fromkeys(_FORBIDDEN, OCCUPIED)}


def read_map(source: Source) -> Shapes:
    """Read the map: cells are squares of side 1, and its edge is the workspace."""
    text = read_text(Path(source.findings.file), MOST_BYTES)
    source.findings = Findings(source.findings.file, text)
    lines = text.splitlines()
    height, width, first = _head(source, lines)
    rows = lines[first : first + height]
    if len(rows) < height:
        source.refuse(f"{len(rows)} rows of {height}; give all of them", len(lines) + 1)
    for k, line in enumerate(lines[first + height :]):
        if line.strip():
            source.refuse(f"more than {height} rows; set the height", first + height + k + 1)
    table = np.full(256, -1, dtype=np.int8)
    for letter, state in _STATES.items():
        table[ord(letter)] = state
    letters = np.empty((height, width), dtype=np.uint8)
    for k, row in enumerate(rows):
        if len(row) != width:
            source.refuse(f"{len(row)} letters, the width is {width}; give as many", first + k + 1)
        letters[k] = np.frombuffer(row.encode("ascii", "replace"), dtype=np.uint8)
    states = table[letters]
    if (states < 0).any():
        y, x = (int(k) for k in np.argwhere(states < 0)[0])
        message = f"{rows[y][x]!r} is no cell; give one of {_FREE + _SWAMP + _FORBIDDEN}"
        source.refuse(message, first + y + 1, x + 1)
    source.note("info", "swamp: free", count=int((letters == ord(_SWAMP)).sum()))
    shapes = cell_shapes(source, states[::-1], 1, Pose(0, 0), "always")
    return shapes_of(source, "MovingAI map", shapes, {}, "give one: --robot with a footprint or a file")


def _head(source: Source, lines: list[str]) -> tuple[int, int, int]:
    """Return height, width, and the number of lines before the first row."""
    sizes: dict[str, int] = {}
    for k, line in enumerate(lines[:8]):
        match line.split():
            case ["map"] if len(sizes) == 2:
                if sizes["height"] * sizes["width"] > MOST_CELLS:
                    source.refuse(f"more than {MOST_CELLS:,} cells; give fewer", k + 1)
                return sizes["height"], sizes["width"], k + 1
            case ["height" | "width" as name, number] if number.isdecimal() and 0 < len(number) < 9 and int(number):
                sizes[name] = int(number)
            case ["type", _] | []:
                pass
            case _:
                break
    source.refuse('no map of MovingAI; begin it with the lines "type octile", "height 9", "width 9" and "map"')
