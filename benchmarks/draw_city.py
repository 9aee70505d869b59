"""Draw a city in tiles: `python draw_city.py PICTURE [BLOCKS]`.

Left, the tiles, and a path from a street to the farthest courtyard with a door; right, a courtyard without one, in the
colour of barriers what its proof is about.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np
from bench_shards import STREET, places
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch, Rectangle
from write_city import write_city

import cfree
from cfree.distributed import Sharded, boundary
from cfree.palette import BARRIER, FRAME, LETTERS, OBSTACLE, PATH
from cfree.plot.workspace import draw_robot, draw_surroundings, path_of, rings_of

TILE = 500
AROUND = 45.0


def main() -> None:
    picture, blocks = Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 144
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        side = write_city(folder, blocks)
        found = boundary([folder / "robot.json", folder / "city.geojsonl"], folder=folder / "tiles", tile=TILE)
        *_, (_, *far), (_, *shut) = places(side)
        draw(found, far, shut).savefig(picture, dpi=100)


def draw(found: Sharded, far: list[float], shut: list[float]) -> Figure:
    import matplotlib

    with matplotlib.rc_context(LETTERS):
        figure = Figure(figsize=(12, 6.2), layout="constrained")
        left, right = figure.subplots(1, 2)
        store = found.work.store
        every = store.scene(range(len(store)))
        left.add_patch(PathPatch(path_of(rings_of(every.obstacles)), facecolor=OBSTACLE, edgecolor="none"))
        for x0, y0, x1, y1 in found.work.division.boxes:
            left.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, fill=False, edgecolor=FRAME, linewidth=0.8))
        way = found.plan(STREET, (*far, 0))
        assert isinstance(way, cfree.Path)
        left.plot(*way.sample(1.0).xy.T, color=PATH, linewidth=1.5)
        left.set_title(f"a path of {way.length:,.0f}: {found.tiles_read} of {found.tiles} tiles read", fontsize=13)
        proof = found.plan(STREET, (*shut, 0))
        assert isinstance(proof, cfree.Separated) and proof.scene is not None
        draw_surroundings(right, every)
        about = [k for k, name in enumerate(proof.scene.obstacle_names) if k in proof.obstacles and name]
        walls = [proof.scene.obstacles[k] for k in about]
        right.add_patch(PathPatch(path_of(rings_of(walls)), facecolor=BARRIER, edgecolor="none", zorder=2))
        draw_robot(right, every, cfree.Pose(*shut, 0), faint=False)
        right.set_title(f"no way out, proved: {found.tiles_read} of {found.tiles} tiles read", fontsize=13)
        right.set(xlim=np.add(shut[0], (-AROUND, AROUND)), ylim=np.add(shut[1], (-AROUND, AROUND)))
        left.autoscale_view()
        for ax in (left, right):
            ax.set_aspect("equal")
    return figure


if __name__ == "__main__":
    main()
