"""Draw a city in tiles: `python draw_city.py PICTURE [BLOCKS]`.

A path from a street to the farthest courtyard with a door, the proof for one without, and the tiles that either has read.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import matplotlib
import numpy as np
from bench_shards import STREET, places
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from write_city import write_city

import cfree
from cfree.distributed import boundary
from cfree.palette import PALETTE

matplotlib.use("Agg")
TILE = 1_000


def main() -> None:
    picture, blocks = Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 144
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        side = write_city(folder, blocks)
        found = boundary([folder / "robot.json", folder / "city.geojsonl"], folder=folder / "tiles", tile=TILE)
        *_, (_, x, y), (_, u, v) = places(side)
        way, shut = found.plan(STREET, (x, y, 0)), found.plan(STREET, (u, v, 0))
        assert isinstance(way, cfree.Path) and isinstance(shut, cfree.Separated)
        assert shut.scene is not None
        store, boxes = found.work.store, found.work.division.boxes
        figure = Figure(figsize=(8, 8), layout="constrained")
        ax = figure.add_subplot()
        for x0, y0, x1, y1 in boxes:
            ax.fill([x0, x1, x1, x0], [y0, y0, y1, y1], facecolor="none", edgecolor=PALETTE.frame, linewidth=0.7)
        near = {int(name.split()[-1]) for name in shut.scene.obstacle_names if name}
        for number, polygon in enumerate(store.polygons(range(len(store)))):
            colour = PALETTE.barrier if number in near else PALETTE.obstacle
            rings = [polygon.vertices[i:j] for i, j in zip(polygon.ring_offsets, polygon.ring_offsets[1:])]
            path = matplotlib.path.Path.make_compound_path(
                *(matplotlib.path.Path(np.vstack([ring, ring[:1]]), closed=True) for ring in rings)
            )
            ax.add_patch(matplotlib.patches.PathPatch(path, facecolor=colour, edgecolor="none"))
        ax.plot(*way.sample(1.0).xy.T, color=PALETTE.path, linewidth=1.4)
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main()
