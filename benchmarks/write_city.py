"""Write the city of `families` as files that are read one shape after the other.

    python write_city.py FOLDER BLOCKS [SEED]

robot.json is the car, city.geojsonl has the obstacles, in units of a thousandth; every eleventh courtyard has no door.
places.json has poses: in a street, in courtyards with a door, and in some without. Row after row, so that no more than
one is in memory.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path

from families import BLOCK, CAR, city_row

Ring = list[list[float]]
OUTSIDE, COURTYARD = slice(1, 17), slice(19, 23)


def is_closed(row: int, column: int) -> bool:
    """Whether a block's courtyard has no door."""
    return (7 * row + 3 * column) % 11 == 5


def polygons_of(side: int, row: int, seed: int) -> Iterator[list[Ring]]:
    """Of one row of blocks, each as its rings, the outer one first."""
    facades, sheds = city_row(side, row, seed)
    for column, (facade, four) in enumerate(zip(facades.round(3), sheds.round(3), strict=True)):
        rings = [facade[OUTSIDE], facade[COURTYARD]] if is_closed(row, column) else [facade]
        yield [ring.tolist() for ring in rings]
        yield from ([shed.tolist()] for shed in four)


def write_city(folder: Path, blocks: int, seed: int = 0, grown: float = 0.0) -> int:
    """Write it, with a car grown by a disc; the number of blocks along a side."""
    side = max(1, round(blocks**0.5))
    folder.mkdir(parents=True, exist_ok=True)
    car = {"outer": CAR.tolist()} | ({"grown": grown} if grown else {})
    (folder / "robot.json").write_text(json.dumps({"robot": car, "obstacles": []}))
    with (folder / "city.geojsonl").open("w", encoding="utf-8") as file:
        for row in range(side):
            for rings in polygons_of(side, row, seed):
                shape = {"type": "Polygon", "coordinates": [[*ring, ring[0]] for ring in rings]}
                file.write(json.dumps({"type": "Feature", "properties": {}, "geometry": shape}) + "\n")
    corners = [(row, column) for row in range(min(side, 40)) for column in range(min(side, 40))]
    places: dict[str, list[list[float]]] = {"street": [[-7, -7, 0]], "open": [], "closed": []}
    for row, column in corners:
        kind = "closed" if is_closed(row, column) else "open"
        places[kind].append([BLOCK * column + 30, BLOCK * row + 30, 0])
    (folder / "places.json").write_text(json.dumps({name: found[:100] for name, found in places.items()}))
    return side


if __name__ == "__main__":
    write_city(Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 0)
