"""Routes across a generated city, in a folder and in memory; the way without portals in the same run.

Each measurement is in a process of its own, for its peak memory. Folders have scene, tiles and portals only: a path
reads no more. `python bench_routes.py SIDE [PLACE]` measures a city of SIDE times SIDE blocks, kept in folder PLACE.
With a rounded car it is `python bench_routes.py SIDE PLACE/tiles make-round`, and the same with `folder`.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import memory
from bench_shards import STREET
from families import BLOCK, city
from measure import Report
from memory import peak_memory
from write_city import is_closed, write_city

import cfree
from cfree.distributed.division import divide_scene
from cfree.distributed.planning import Surroundings, plan_among
from cfree.distributed.portals import groups_of, portals_task, write_rooms
from cfree.distributed.reading import read_source
from cfree.distributed.shard import write_json
from cfree.distributed.store import store_scene
from cfree.distributed.tasks import Work, opened, stamp_of
from cfree.exact.pose import Pose, to_pose
from cfree.planning.among import plan_around
from cfree.planning.options import Options

SIDES, QUICK = (20, 40, 80), (6, 12)  # blocks along a side: 2, 4 and 8 km from corner to corner
FIRST = Options(improve=0.0)
GROWN = 0.1  # metres around a rounded car


def run(quick: bool) -> Report:
    report = Report(
        "Routes across a city",
        ("km", "vertices", "portals s", "folder, first s", "another s", "default s", "peak MB", "without portals s",
         "its peak MB", "in memory, first s", "default s", "peak MB"),
    )  # fmt: skip
    rows = []
    for side in QUICK if quick else SIDES:
        with tempfile.TemporaryDirectory() as name:
            rows.append(measured(side, Path(name)))
        report.rows.append(columns_of(rows[-1]))
    last, before = rows[-1], rows[-2]
    case = f"{last['km']:.3g} km"
    report.figure("route in a folder, first question of a process", case, last["folder"]["first"], "<=", 0.4, " s")
    share = last["folder"]["first"] / last["before"]["first"]
    report.figure("the same, in the time without portals", case, share, "<=", 0.15)
    report.figure("the same, for twice the way", case, last["folder"]["first"] / before["folder"]["first"], "<=", 2.2)
    report.figure("the same, peak memory", case, last["folder"]["peak"] / 1e9, "<=", 1, " GB")
    report.figure("route in memory", case, last["memory"]["first"], "<=", 3, " s")
    report.figure("the same, peak memory", case, last["memory"]["peak"] / 1e9, "<=", 1, " GB")
    report.figure("scene file and first plan near by, a vertex", case, last["near"], "<=", 300, " bytes")
    return report


def columns_of(row: dict[str, Any]) -> tuple[str, ...]:
    folder, before, memory = row["folder"], row["before"], row["memory"]
    return (
        f"{row['km']:.1f}", f"{row['vertices']:,}", f"{row['portals']:.3g}",
        *(f"{folder[name]:.3g}" for name in ("first", "another", "default")), f"{folder['peak'] / 1e6:,.0f}",
        f"{before['first']:.3g}", f"{before['peak'] / 1e6:,.0f}",
        *(f"{memory[name]:.3g}" for name in ("first", "default")), f"{memory['peak'] / 1e6:,.0f}",
    )  # fmt: skip


def measured(side: int, place: Path) -> dict[str, Any]:
    """Processor time and peak memory of each way, in seconds and bytes."""
    folder = place / "tiles"
    made = of_child(side, folder, "make")
    row = made | {"km": math.hypot(BLOCK * side, BLOCK * side) / 1000}
    row["folder"] = of_child(side, folder, "folder")
    row["before"] = of_child(side, folder, "before")
    row["memory"] = of_child(side, folder, "memory")
    row["near"] = of_child(side, folder, "near")["near"]
    return row


def of_child(side: int, folder: Path, what: str) -> dict[str, Any]:
    command = [sys.executable, __file__, str(side), str(folder), what]
    output = subprocess.run(command, stdout=subprocess.PIPE, check=True)
    row: dict[str, Any] = json.loads(output.stdout.splitlines()[-1])
    return row


def seconds(work: Callable[[], object]) -> float:
    """Processor time of a call."""
    begin = time.process_time()
    work()
    return time.process_time() - begin


def warmed() -> None:
    """Load what a first plan loads."""
    cfree.plan(
        cfree.Scene(robot=[(0, 0), (1, 0), (0, 1)], obstacles=[[(3, -9), (4, -9), (4, 9)]]), (0, 0, 0), (9, 0, 0)
    )


def ends(side: int, is_shut: Callable[[int, int], bool] = is_closed) -> tuple[Pose, Pose]:
    """The street at one corner, and a courtyard with a door at the other."""
    column = next(c for c in range(side - 1, -1, -1) if not is_shut(side - 1, c))
    goal = BLOCK * column + 30, BLOCK * (side - 1) + 30, 0
    return to_pose(STREET, "start"), to_pose(goal, "goal")


def make(side: int, folder: Path, grown: float = 0.0) -> dict[str, Any]:
    """Write the folder of a city, without boundary and cells."""
    if not (folder / "plan.json").exists():
        write_city(folder.parent, side * side, grown=grown)
        notes: list[Any] = []
        head, obstacles = read_source([folder.parent / "robot.json", folder.parent / "city.geojsonl"], notes)
        store = store_scene(head, obstacles, folder / "scene", "routes", notes)
        divide_scene(store, max(1, store.vertices // 20_000), folder / "tiles", "routes")
        write_json(folder / "plan.json", {"key": "routes"})

    def portals() -> None:
        stamp = stamp_of(folder)
        for group in groups_of(write_rooms(Work(folder))):
            portals_task(str(folder), stamp, group)

    took = seconds(portals)
    return {"portals": took, "vertices": Work(folder).store.vertices}


def of_folder(side: int, folder: Path) -> dict[str, Any]:
    start, goal = ends(side)
    warmed()

    def asked(start: Pose, goal: Pose, improve: float | None) -> Callable[[], object]:
        return lambda: plan_among(Surroundings(opened(str(folder), stamp_of(folder))), start, goal, improve=improve)

    first = seconds(asked(start, goal, 0.0))
    peak = peak_memory()
    return {"first": first, "another": seconds(asked(goal, start, 0.0)), "default": seconds(asked(start, goal, None)),
            "peak": peak}  # fmt: skip


def without_portals(side: int, folder: Path) -> dict[str, Any]:
    start, goal = ends(side)
    warmed()
    first = seconds(lambda: plan_around(Surroundings(opened(str(folder), stamp_of(folder))), start, goal, FIRST))
    return {"first": first, "peak": peak_memory()}


def in_memory(side: int, folder: Path) -> dict[str, Any]:
    start, goal = ends(side, lambda row, column: False)
    arrays = city(side * side)
    scene = cfree.Scene(arrays.robot, arrays.rings())
    warmed()
    first = seconds(lambda: cfree.plan(scene, start, goal, improve=0))
    return {"first": first, "default": seconds(lambda: cfree.plan(scene, start, goal)), "peak": peak_memory()}


def near_by(side: int, folder: Path) -> dict[str, Any]:
    """Growth of the memory of another process by a scene file and a first plan to the next block."""
    arrays = city(side * side)
    folder.parent.mkdir(parents=True, exist_ok=True)
    path = folder.parent / "near.json"
    cfree.save(cfree.Scene(arrays.robot, arrays.rings()), path)
    command = [sys.executable, str(Path(memory.__file__)), str(path)]
    return {"near": float(subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout)}


CHILDREN = {
    "make": make,
    "make-round": partial(make, grown=GROWN),
    "folder": of_folder,
    "before": without_portals,
    "memory": in_memory,
    "near": near_by,
}

if __name__ == "__main__":
    side = int(sys.argv[1])
    if len(sys.argv) > 3:
        print(json.dumps(CHILDREN[sys.argv[3]](side, Path(sys.argv[2]))))
    else:
        place = Path(sys.argv[2]) if len(sys.argv) > 2 else Path(tempfile.mkdtemp())
        print(json.dumps(measured(side, place), indent=1))
