"""Poses a second, on one thread: `is_free` beside a separating-axis test in doubles compiled by numba, and FCL.

Single poses and motions as well: what a call from Python takes, and what of it is the core's.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from copy import copy
from functools import cache
from importlib.util import find_spec
from typing import Any

import numpy as np
from measure import POLYGONS, REAL, SCENES, Report, each, timed

import cfree
from cfree.paths.clearance import distances_beside
from cfree.paths.path import STILL
from cfree.scene.features import BODY, ShapeFeatures, scene_features

COUNT, CALLS, NUMBA_COUNT, FCL_COUNT = 1_000_000, 5, 200_000, 4_000
ALONE = 2_000  # poses, one a call
Rival = Callable[[np.ndarray], np.ndarray]


def run(quick: bool) -> Report:
    report = Report(
        "Free or not: uniform poses in the bounds, one thread",
        ("scene", "pieces", "free", "prepare ms", "cfree ns/pose", "Mposes/s", "again ns", "uncertain", "numba ns/pose",
         "ratio", "differ", "FCL µs/pose", "ratio", "differ"),
        notes=[
            f"cfree: {CALLS} calls of a million new poses each, preparing included; again: the last million once more",
            "prepare: features and grid; ratios: to one thread; differ: poses on which the rival says otherwise",
        ],
    )  # fmt: skip
    for name in ("benchmr_parking1",) if quick else REAL:
        alone(name, cfree.load_scene(SCENES / f"{name}.json"), report)
    missing = [name for name in ("numba", "fcl") if find_spec(name) is None]
    if missing:
        report.notes.append(f"nothing to compare: no {', no '.join(missing)}; pip install -e '.[bench]'")
        return report
    small = sorted(path.stem for path in POLYGONS if path.stem not in REAL)
    ratios: dict[str, tuple[float, float]] = {}
    for name in ("nest_shirts", "five_convex") if quick else (*REAL, *small):
        scene = cfree.load_scene(SCENES / f"{name}.json")
        if scene.obstacles:
            ratios[name] = compare(name, scene, report)
    for k, (rival, target) in enumerate((("numba", 5), ("FCL", 100))):
        what = f"is_free, times faster than {rival}"
        for name in sorted(ratios.keys() & REAL):
            report.figure(what, name, ratios[name][k], ">=", target)
        rest = {name: pair[k] for name, pair in ratios.items() if name not in REAL}
        worst = min(rest, key=lambda name: rest[name])
        report.figure(what, f"the worst of {len(rest)} small scenes: {worst}", rest[worst], ">=", target)
    return report


def alone(name: str, scene: cfree.Scene, report: Report) -> None:
    """One pose a call, by the slowest of all ways to ask; one motion and one path without motions, above the core."""
    poses, motion = uniform(scene, pieces_of(scene_features(scene).obstacles), 0)[:ALONE], cfree.Translation((0, 1))
    checker, motions = cfree.PoseChecker(scene), cfree.MotionChecker(scene)
    rows, tables = list(map(tuple, poses.tolist())), list(poses.reshape(-1, 1, 3))
    path = cfree.Path(cfree.Pose(*next(row for row in rows if checker.is_free(row))), [])
    distances, same = distances_beside(path, scene), [path] * ALONE
    least = 2 * path.poses, (STILL,), distances.robot, 1e-3 * distances.radius
    asked = max(
        each(checker.is_free, rows),
        each(lambda row: cfree.is_free(scene, row), rows),
        each(checker.is_free, tables),
        each(lambda table: cfree.is_free(scene, table), tables),
    )
    moved = each(lambda row: cfree.is_free_motion(scene, row, motion), rows)
    moved_in_core = each(lambda row: motions._handle.is_free(row, motion, False), rows)
    cleared = each(lambda path: cfree.clearance(path, scene), same)
    cleared_in_core = each(lambda path: distances._handle.least(*least), same)
    free_in_core = each(lambda path: checker._handle.is_free(path.start), same)
    report.figure("is_free, one pose a call", name, asked, "<=", 3, "µs")
    report.figure("of that the core", name, each(checker._handle.is_free, rows), "<=", 3, "µs")
    report.figure("is_free_motion, above the core", name, moved - moved_in_core, "<=", 2, "µs")
    above = cleared - cleared_in_core - free_in_core
    report.figure("clearance of one pose, above the core", name, above, "<=", 2, "µs")


def compare(name: str, scene: cfree.Scene, report: Report) -> tuple[float, float]:
    features = scene_features(scene)
    robot, obstacles = pieces_of(features.robot), pieces_of(features.obstacles)
    calls = [uniform(scene, obstacles, seed) for seed in range(CALLS)]
    poses = calls[-1]
    checker, by_numba, by_fcl = cfree.PoseChecker(scene), numba_test(robot, obstacles), fcl_test(robot, obstacles)
    (prepare,) = timed(lambda: cfree.PoseChecker(copy(scene)).is_free(poses[:1], threads=1), rounds=3)

    def ask() -> None:
        fresh = cfree.PoseChecker(copy(scene))  # a scene keeps what is prepared for it, a copy does not
        for new in calls:
            fresh.is_free(new, threads=1)

    ours, again, numbas, fcls = timed(
        ask,
        lambda: checker.is_free(poses, threads=1),
        lambda: by_numba(poses[:NUMBA_COUNT]),
        lambda: by_fcl(poses[:FCL_COUNT]),
        rounds=5,
    )
    free = checker.is_free(poses)
    verdicts = np.empty(len(poses), np.uint8)
    checker._handle.check(poses, 1, verdicts)
    differ = [int((rival(poses[:n]) != free[:n]).sum()) for rival, n in ((by_numba, NUMBA_COUNT), (by_fcl, FCL_COUNT))]
    best = ours.best / (CALLS * COUNT)
    ratios = numbas.best / NUMBA_COUNT / best, fcls.best / FCL_COUNT / best
    uncertain = str(int((verdicts == 2).sum()))
    report.rows.append((
        name, f"{len(robot)} x {len(obstacles)}", f"{free.mean():.0%}", prepare.text(),
        ours.text("µs", CALLS * COUNT / 1e3), f"{1e-6 / best:.1f}", again.text("µs", COUNT / 1e3), uncertain,
        numbas.text("µs", NUMBA_COUNT / 1e3), f"{ratios[0]:.1f}", str(differ[0]),
        fcls.text("µs", FCL_COUNT), f"{ratios[1]:.0f}", str(differ[1]),
    ))  # fmt: skip
    return ratios


def pieces_of(shape: ShapeFeatures) -> list[np.ndarray]:
    pieces = zip(shape.pieces, shape.core.piece_layer, strict=True)
    return [shape.xy[piece] for piece, layer in pieces if layer == BODY]


def uniform(scene: cfree.Scene, obstacles: list[np.ndarray], seed: int) -> np.ndarray:
    """Uniform in the bounds, else in the box of the workspace, else of the obstacles."""
    points = scene.workspace.vertices if scene.workspace else np.concatenate(obstacles)
    box = np.array(scene.bounds, float) if scene.bounds else np.array([*points.min(axis=0), *points.max(axis=0)])
    return np.random.default_rng(seed).uniform((*box[:2], 0), (*box[2:], 2 * math.pi), (COUNT, 3))


def flat(pieces: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    return np.concatenate(pieces), np.cumsum([0, *map(len, pieces)])


def numba_test(robot: list[np.ndarray], obstacles: list[np.ndarray]) -> Rival:
    free, tables = numba_kernel(), numba_tables(robot, obstacles)
    return lambda poses: free(poses, *tables)


def numba_tables(robot: list[np.ndarray], obstacles: list[np.ndarray]) -> tuple[np.ndarray, ...]:
    boxes = np.array([[*piece.min(axis=0), *piece.max(axis=0)] for piece in obstacles])
    return *flat(robot), *flat(obstacles), boxes


@cache
def numba_kernel() -> Any:
    """All pairs of pieces: boxes first, then all edges as axes, until one separates. Doubles, no error bound."""
    import numba

    @numba.njit
    def separates(v, first, last, w, start, stop):
        for k in range(first, last):
            m = k + 1 if k + 1 < last else first
            nx, ny = v[m, 1] - v[k, 1], v[k, 0] - v[m, 0]
            apart = True
            for j in range(start, stop):
                if nx * (w[j, 0] - v[k, 0]) + ny * (w[j, 1] - v[k, 1]) < 0:
                    apart = False
                    break
            if apart:
                return True
        return False

    @numba.njit
    def free(poses, a, a_first, b, b_first, boxes):
        out, v = np.ones(len(poses), np.bool_), np.empty_like(a)
        for n in range(len(poses)):
            c, s = math.cos(poses[n, 2]), math.sin(poses[n, 2])
            for k in range(len(a)):
                v[k, 0] = poses[n, 0] + c * a[k, 0] - s * a[k, 1]
                v[k, 1] = poses[n, 1] + s * a[k, 0] + c * a[k, 1]
            for i in range(len(a_first) - 1):
                x0, y0, x1, y1 = np.inf, np.inf, -np.inf, -np.inf
                for k in range(a_first[i], a_first[i + 1]):
                    x0, x1 = min(x0, v[k, 0]), max(x1, v[k, 0])
                    y0, y1 = min(y0, v[k, 1]), max(y1, v[k, 1])
                for j in range(len(b_first) - 1):
                    if x0 >= boxes[j, 2] or boxes[j, 0] >= x1 or y0 >= boxes[j, 3] or boxes[j, 1] >= y1:
                        continue
                    p, q, r, t = a_first[i], a_first[i + 1], b_first[j], b_first[j + 1]
                    if not separates(b, r, t, v, p, q) and not separates(v, p, q, b, r, t):
                        out[n] = False
                        break
                if not out[n]:
                    break
        return out

    return free


def fcl_test(robot: list[np.ndarray], obstacles: list[np.ndarray]) -> Rival:
    """Prisms of height 1 in a dynamic tree of boxes, one call a pose and piece of the robot."""
    import fcl

    def prism(ring: np.ndarray) -> fcl.CollisionObject:
        n = len(ring)
        points = np.concatenate([np.c_[ring, np.full(n, z)] for z in (-0.5, 0.5)])
        sides = [(k, (k + 1) % n, n + (k + 1) % n, n + k) for k in range(n)]
        caps = [tuple(range(n))[::-1], tuple(range(n, 2 * n))]
        faces = np.concatenate([[len(face), *face] for face in (*sides, *caps)])
        return fcl.CollisionObject(fcl.Convex(points, n + 2, faces))

    parts, manager = [prism(ring) for ring in robot], fcl.DynamicAABBTreeCollisionManager()
    manager.registerObjects([prism(ring) for ring in obstacles])
    manager.setup()

    def is_free(x: float, y: float, theta: float) -> bool:
        c, s = math.cos(theta), math.sin(theta)
        place = fcl.Transform(np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]), np.array([x, y, 0]))
        for part in parts:
            part.setTransform(place)
            found = fcl.CollisionData()
            manager.collide(part, found, fcl.defaultCollisionCallback)
            if found.result.is_collision:
                return False
        return True

    return lambda poses: np.array([is_free(*pose) for pose in poses.tolist()])
