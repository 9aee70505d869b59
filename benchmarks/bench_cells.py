"""Which cell a pose is in: `FreeSpace.locate`, beside a count of crossings over the whole slice in doubles."""

from __future__ import annotations

import numpy as np
from bench_free import pieces_of, uniform
from families import FAMILIES, SceneArrays
from measure import REAL, SCENES, Report, each, timed

import cfree

COUNT, SINGLE, SCANNED = 20_000, 200, 200


def run(quick: bool) -> Report:
    report = Report(
        "Which cell: uniform poses in the bounds",
        ("scene", "trapezoids", "cells", "free", "cells ms", "one pose µs", "bulk µs/pose", "2 threads",
         "whole slice µs", "ratio", "differ"),
        notes=[
            "cells: free_space of a built boundary; one pose: locate(Pose), free ones; bulk: locate(Poses), 1 thread",
            "whole slice: segments at the orientation, crossings to the left counted by surface, numpy; doubles",
        ],
    )  # fmt: skip
    scenes = {name: cfree.load_scene(SCENES / f"{name}.json") for name in (REAL[:1] if quick else REAL)}
    scenes |= {f"{n} {family}": made(FAMILIES[family](n)) for family, n in (() if quick else (("convex", 1000),))}
    for name, scene in scenes.items():
        compare(name, scene, report)
    return report


def made(arrays: SceneArrays) -> cfree.Scene:
    return cfree.Scene(arrays.robot, arrays.rings())


def compare(name: str, scene: cfree.Scene, report: Report) -> None:
    boundary = cfree.boundary(scene)
    table = uniform(scene, pieces_of(boundary.features.obstacles), 11)[:COUNT]
    (cells,) = timed(lambda: cfree.free_space(boundary), rounds=1, warm_up=False)
    space = cfree.free_space(boundary)
    poses = cfree.Poses(table[:, :2], table[:, 2])
    found = space.locate(poses)
    free = [poses[k] for k in np.flatnonzero(found >= 0)[:SINGLE].tolist()]
    one, bulk, both, whole = timed(
        lambda: [space.locate(pose) for pose in free],
        lambda: space.locate(poses, threads=1),
        lambda: space.locate(poses, threads=2),
        lambda: [by_whole_slice(space, *row) for row in table[:SCANNED].tolist()],
        rounds=5,
    )
    differ = sum(by_whole_slice(space, *row) != found[k] for k, row in enumerate(table[:SCANNED].tolist()))
    ratio = whole.best / SCANNED / (bulk.best / COUNT)
    report.rows.append((
        name, f"{len(boundary.trapezoids):,}", str(len(space)), f"{np.mean(found >= 0):.0%}", cells.text(),
        one.text("µs", len(free)), bulk.text("µs", COUNT), both.text("µs", COUNT), whole.text("µs", SCANNED),
        f"{ratio:.0f}", str(differ),
    ))  # fmt: skip
    report.figure("locate, one pose", name, 1e6 * one.best / len(free), "<=", 1000, " µs")
    rows, core = table[:SINGLE].tolist(), space.boundary.checker._handle
    above = each(space.locate, rows) - each(lambda row: space._handle.locate_one(core, row), rows)
    report.figure("locate, one pose, above the core", name, above, "<=", 2, "µs")


def by_whole_slice(space: cfree.FreeSpace, x: float, y: float, theta: float) -> int:
    cut = space.surfaces.slice(theta)
    (x0, y0), (x1, y1) = cut.segments[:, 0].T, cut.segments[:, 1].T
    crossed = ((y0 > y) != (y1 > y)) & (((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) > 0) == (y1 < y0))
    parity = np.bincount(space.component[cut.trapezoids[crossed]], minlength=len(space.parent)) % 2
    around = np.flatnonzero(parity)
    if len(around) == 0:
        return space.outside
    deepest = around[np.argmax(space.depth[around])]
    return int(space.cell_of[deepest]) if space.free_inside[deepest] else -1
