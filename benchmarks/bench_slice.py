"""Slices of a built boundary, and the whole boundary, beside slices made by shapely."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import shapely
from measure import POLYGONS, REAL, SCENES, Report, timed
from shapely_slices import Pieces, pieces_of, sums_by_hull, sums_by_merging

import cfree

WHOLE = 100
TARGETS = (
    ("slice, segments: times faster than shapely", ">=", 50),
    ("slice, polygons: times faster than shapely", ">=", 10),
    ("slice, length differs from shapely's by", "<=", 1e-9),
)
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
    def of(cls, name: str) -> Case:
        scene = replace(cfree.load_scene(SCENES / f"{name}.json"), bounds=None, workspace=None)
        thetas = np.random.default_rng(7).uniform(0, 2 * math.pi, 1000).tolist()
        return cls(name, scene, pieces_of(scene.robot), pieces_of(scene.obstacles), thetas)

    def shapely_slices(self, sums: Sums, count: int) -> float:
        """Length of all outlines at the first orientations."""
        unions = (shapely.union_all(sums(self.robot, self.obstacles, theta)) for theta in self.thetas[:count])
        return sum(union.length for union in unions)


def run(quick: bool) -> list[Report]:
    whole = Report(
        f"Whole boundary, features included, against {WHOLE} slices by shapely at random orientations",
        ("scene", "trapezoids", "one thread ms", "all threads ms", "slices by hulls ms", "ratio",
         "slices by merged edges ms", "ratio"),
        notes=["ratios: to one thread"],
    )  # fmt: skip
    single = Report(
        "One slice of a built boundary, mean over random orientations",
        ("scene", "segments", "look-up ms", "segments µs", "forbidden µs", "by hulls ms", "ratios",
         "by merged edges ms", "ratios", "length differs by"),
        notes=["ratios: segments, polygons"],
    )  # fmt: skip
    small = sorted(path.stem for path in POLYGONS if path.stem not in REAL)
    ratios: dict[str, tuple[float, float, float]] = {}
    for name in ("nest_shirts", "five_convex") if quick else (*REAL, *small):
        case = Case.of(name)
        if not case.obstacles:
            continue
        try:
            boundary = cfree.boundary(case.scene)
        except cfree.UnsupportedError as error:
            single.notes.append(f"{name}: {error}")
            continue
        ratios[name] = compare(case, boundary, whole, single)
    for k, (what, relation, target) in enumerate(TARGETS):
        for name in sorted(ratios.keys() & REAL):
            single.figure(what, name, ratios[name][k], relation, target)
        rest = {name: values[k] for name, values in ratios.items() if name not in REAL}
        worst = (min if relation == ">=" else max)(rest, key=lambda name: rest[name])
        single.figure(what, f"the worst of {len(rest)} small scenes: {worst}", rest[worst], relation, target)
    return [whole, single]


def compare(case: Case, boundary: cfree.Boundary, whole: Report, single: Report) -> tuple[float, float, float]:
    """Time rivals in turn, add rows to the tables; the values of `TARGETS`. Whole boundaries only for real scenes."""
    many, few, k = case.thetas, case.thetas[:200], 25
    one, all_cores, look_up, segments, forbidden, hulls, merged = timed(
        lambda: cfree.boundary(case.scene, threads=1),
        lambda: cfree.boundary(case.scene),
        lambda: type(boundary)._slicer.func(boundary),
        lambda: [boundary.slice(theta).segments for theta in many],
        lambda: [boundary.slice(theta).forbidden for theta in few],
        lambda: case.shapely_slices(sums_by_hull, k),
        lambda: case.shapely_slices(sums_by_merging, k),
        rounds=5,
    )
    hundred = {"hulls": WHOLE / k * hulls.best / one.best, "merged": WHOLE / k * merged.best / one.best}
    if case.name in REAL:
        whole.rows.append((
            case.name, f"{len(boundary.trapezoids):,}", one.text(), all_cores.text(), hulls.text("ms", k / WHOLE),
            f"{hundred['hulls']:.1f}", merged.text("ms", k / WHOLE), f"{hundred['merged']:.1f}",
        ))  # fmt: skip
        whole.figure(f"whole boundary, times faster than {WHOLE} slices", case.name, hundred["hulls"], ">=", 1)
    ours = segments.best / len(many), forbidden.best / len(few)
    by_hulls, by_merging = ([rival.best / k / seconds for seconds in ours] for rival in (hulls, merged))
    count = sum(len(boundary.slice(theta).segments) for theta in many) / len(many)
    differs = difference(boundary, case, k)
    single.rows.append((
        case.name, f"{count:,.0f}", look_up.text(), segments.text("µs", len(many)), forbidden.text("µs", len(few)),
        hulls.text("ms", k), pair(by_hulls), merged.text("ms", k), pair(by_merging), f"{differs:.0e}",
    ))  # fmt: skip
    return *by_hulls, differs


def pair(ratios: list[float]) -> str:
    return ", ".join(f"{ratio:.3g}" for ratio in ratios)


def difference(boundary: cfree.Boundary, case: Case, count: int) -> float:
    """Relative difference of the total length: the check that both computed the same."""
    slices = (boundary.slice(theta).segments for theta in case.thetas[:count])
    length = sum(float(np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1).sum()) for segments in slices)
    return abs(length / case.shapely_slices(sums_by_hull, count) - 1)
