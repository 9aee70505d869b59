"""Slices of a built boundary, and the whole boundary, beside slices made by shapely."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import shapely
from measure import REAL, SCENES, Report, timed
from shapely_slices import Pieces, pieces_of, sums_by_hull, sums_by_merging

import cfree

SEGMENTS, FORBIDDEN, WHOLE = 50, 10, 100
Sums = Callable[[list[Pieces], list[Pieces], float], np.ndarray]


@dataclass(frozen=True, slots=True)
class Case:
    """A scene without bounds and workspace, which the baseline does not take."""

    name: str
    scene: cfree.Scene
    robot: list[Pieces]
    obstacles: list[Pieces]
    thetas: list[float]

    @classmethod
    def of(cls, name: str, count: int) -> Case:
        scene = replace(cfree.load_scene(SCENES / f"{name}.json"), bounds=None, workspace=None)
        thetas = np.random.default_rng(7).uniform(0, 2 * math.pi, count).tolist()
        return cls(name, scene, pieces_of(scene.robot), pieces_of(scene.obstacles), thetas)

    def shapely_slices(self, sums: Sums) -> float:
        """Length of all outlines."""
        unions = (shapely.union_all(sums(self.robot, self.obstacles, theta)) for theta in self.thetas)
        return sum(union.length for union in unions)


def run(quick: bool) -> list[Report]:
    names = ["nest_shirts"] if quick else REAL
    reports = [whole(names), slices(names, "the real scenes")]
    if not quick:
        small = [path.stem for path in sorted(SCENES.glob("*.json")) if path.stem not in REAL]
        reports.append(slices(small, "the small shipped scenes"))
    return reports


def whole(names: list[str]) -> Report:
    """One boundary against as many slices as `WHOLE`."""
    report = Report(
        f"Whole boundary, features included, against {WHOLE} slices by shapely at random orientations",
        ("scene", "trapezoids", "boundary ms", "all threads ms", "slices by hulls ms", "ratio",
         "slices by merged edges ms", "ratio"),
    )  # fmt: skip
    for name in names:
        case = Case.of(name, WHOLE)
        one, all_cores, hulls, merged = timed(
            lambda case=case: cfree.boundary(case.scene, threads=1),
            lambda case=case: cfree.boundary(case.scene),
            lambda case=case: case.shapely_slices(sums_by_hull),
            lambda case=case: case.shapely_slices(sums_by_merging),
            rounds=3,
        )
        count = len(cfree.boundary(case.scene).trapezoids)
        report.rows.append((
            name, f"{count:,}", one.text(), all_cores.text(), hulls.text(), f"{hulls.best / one.best:.1f}",
            merged.text(), f"{merged.best / one.best:.1f}",
        ))  # fmt: skip
        report.figure(f"whole boundary, times faster than {WHOLE} slices", name, hulls.best / one.best, ">=", 1)
    report.notes.append("boundary: one thread, and one thread for its ratios")
    return report


def slices(names: list[str], shown: str) -> Report:
    """Mean over random orientations of one slice: segments, polygons, and the two baselines."""
    report = Report(
        f"One slice of a built boundary, mean over random orientations: {shown}",
        ("scene", "segments", "look-up ms", "segments µs", "forbidden µs", "by hulls ms", "ratios",
         "by merged edges ms", "ratios", "length differs by"),
    )  # fmt: skip
    for name in names:
        case = Case.of(name, 25)
        if not case.obstacles:
            continue
        boundary = cfree.boundary(case.scene)
        (look_up,) = timed(lambda boundary=boundary: type(boundary).slicer.func(boundary), rounds=3)
        many = np.random.default_rng(8).uniform(0, 2 * math.pi, 1000).tolist()
        segments, forbidden, hulls, merged = timed(
            lambda boundary=boundary, many=many: [boundary.slice(theta).segments for theta in many],
            lambda boundary=boundary, many=many: [boundary.slice(theta).forbidden for theta in many[:200]],
            lambda case=case: case.shapely_slices(sums_by_hull),
            lambda case=case: case.shapely_slices(sums_by_merging),
            rounds=5,
        )
        k = len(case.thetas)
        each = {"segments": segments.best / len(many), "forbidden": forbidden.best / 200}
        rivals = {"hulls": hulls.best / k, "merged": merged.best / k}
        ratios = {r: [rivals[r] / each["segments"], rivals[r] / each["forbidden"]] for r in rivals}
        report.rows.append((
            name, f"{mean_segments(boundary, case):,.0f}", look_up.text(), segments.text("µs", len(many)),
            forbidden.text("µs", 200), hulls.text("ms", k), pair(ratios["hulls"]), merged.text("ms", k),
            pair(ratios["merged"]), f"{difference(boundary, case):.0e}",
        ))  # fmt: skip
        report.figure("slice, segments: times faster than shapely", name, ratios["hulls"][0], ">=", SEGMENTS)
        report.figure("slice, polygons: times faster than shapely", name, ratios["hulls"][1], ">=", FORBIDDEN)
        report.figure("slice, length differs from shapely's by", name, difference(boundary, case), "<=", 1e-9)
    report.notes.append("ratios: segments, polygons")
    return report


def pair(ratios: list[float]) -> str:
    return ", ".join(f"{ratio:.3g}" for ratio in ratios)


def mean_segments(boundary: cfree.Boundary, case: Case) -> float:
    return float(np.mean([len(boundary.slice(theta).segments) for theta in case.thetas]))


def difference(boundary: cfree.Boundary, case: Case) -> float:
    """Relative difference of the total length: the check that both computed the same."""
    ours = sum(
        float(np.linalg.norm(np.diff(boundary.slice(theta).segments, axis=1), axis=-1).sum()) for theta in case.thetas
    )
    return abs(ours / case.shapely_slices(sums_by_hull) - 1)
