"""Write a city of any size as files that are read one shape after the other.

    python write_city.py FOLDER BLOCKS [SEED]

robot.json is a car, city.geojsonl has the obstacles: blocks of 60 by 60 around a courtyard with a door and four sheds,
streets of 14; every eleventh courtyard has no door. places.json has poses: in a street, in courtyards with a door and
in some without. Row after row, so that no more than one is in memory.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

PITCH = 74.0
CAR = [(-2.25, -0.6), (-1.95, -0.9), (1.95, -0.9), (2.25, -0.6), (2.25, 0.6), (1.95, 0.9), (-1.95, 0.9), (-2.25, 0.6)]
Ring = list[tuple[float, float]]


def is_closed(row: int, column: int) -> bool:
    """Whether a block's courtyard has no door."""
    return (7 * row + 3 * column) % 11 == 5


def block(rng: np.random.Generator, closed: bool) -> list[list[Ring]]:
    """Polygons of a block with its corner at the origin, each as its rings, the outer one first."""
    door = float(rng.integers(14, 44))
    court: Ring = [(12, 12), (12, 48), (48, 48), (48, 12)]
    if closed:
        facade = [[(0.0, 0.0), (60.0, 0.0), (60.0, 60.0), (0.0, 60.0)], court]
    else:
        facade = [[(door + 3, 0), (60, 0), (60, 60), (0, 60), (0, 0), (door, 0), (door, 12), *court, (door + 3, 12)]]
    sheds = []
    for u in (15, 35):
        for v in (18, 36):
            x, y = u + rng.uniform(0, 4), v + rng.uniform(0, 4)
            w = rng.uniform(2, 5)
            sheds.append([[(x, y), (x + w, y), (x + w, y + 3), (x, y + 3)]])
    return [facade, *sheds]


def row_of(side: int, row: int, seed: int) -> Iterator[list[list[Ring]]]:
    """All polygons of one row of blocks; the same whatever else is written."""
    rng = np.random.default_rng([seed, row])
    for column in range(side):
        x0, y0 = PITCH * column, PITCH * row
        for rings in block(rng, is_closed(row, column)):
            yield [[(round(x0 + x, 3), round(y0 + y, 3)) for x, y in ring] for ring in rings]


def main() -> None:
    folder, blocks, seed = Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 0
    side = max(1, round(blocks**0.5))
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "robot.json").write_text(json.dumps({"robot": {"outer": CAR}, "obstacles": []}))
    with (folder / "city.geojsonl").open("w", encoding="utf-8") as file:
        for row in range(side):
            for rings in row_of(side, row, seed):
                shape = {"type": "Polygon", "coordinates": [[*ring, ring[0]] for ring in rings]}
                file.write(json.dumps({"type": "Feature", "properties": {}, "geometry": shape}) + "\n")
    corners = [(row, column) for row in range(min(side, 40)) for column in range(min(side, 40))]
    places: dict[str, list[list[float]]] = {"street": [[-7, -7, 0]], "open": [], "closed": []}
    for row, column in corners:
        places["closed" if is_closed(row, column) else "open"].append([PITCH * column + 30, PITCH * row + 33, 0])
    (folder / "places.json").write_text(json.dumps({name: found[:100] for name, found in places.items()}))


if __name__ == "__main__":
    main()
