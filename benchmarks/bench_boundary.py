"""Core time of the whole boundary on one thread, a patch, beside the design's untuned trial."""

from __future__ import annotations

from dataclasses import replace

from families import convex
from measure import REAL, SCENES, Report, Times, checksum, measured

import cfree
from cfree.forbidden.columns import COLUMNS

# patches, seconds of the trial's core on one thread: obstacles united beforehand, no bounds
TRIAL = {
    "60 convex": (1_976, 0.14),
    "benchmr_parking1": (8_840, 0.73),
    "benchmr_warehouse": (70_560, 6.3),
    "nest_shirts": (4_432, 0.35),
    "nest_swim": (15_100, 1.6),
    "street_Berlin": (8_488, 0.56),
    "5000 convex": (172_964, 13.7),
}
AT_LEAST = 3.0


class Build:
    """Makes the boundary of a scene when called, and returns the seconds of trimming."""

    def __init__(self, case: str, threads: int) -> None:
        self.scene, self.threads = scene_of(case), threads
        self.phases: list[dict[str, float]] = []

    def __call__(self) -> float:
        self.boundary = cfree.boundary(self.scene, threads=self.threads)
        self.phases.append(self.boundary.stats.seconds)
        return self.phases[-1]["trim"]

    def times(self, phase: str) -> Times:
        return Times(tuple(p[phase] for p in self.phases[1:]))  # the first call warms up

    def checksum(self) -> str:
        return checksum(getattr(self.boundary.trapezoids, name) for name in COLUMNS)


def run(quick: bool) -> Report:
    report = Report(
        "Whole boundary, one thread: core time a patch against the trial",
        ("scene", "patches", "live", "trapezoids", "features ms", "trim ms", "collect ms",
         "trim µs/patch", "trial", "ratio", "checksum"),
    )  # fmt: skip
    for case, (patches, seconds) in TRIAL.items():
        if quick and case == "5000 convex":
            continue
        build = Build(case, threads=1)
        (trim,) = measured(build, rounds=3 if quick or case == "5000 convex" else 7)
        stats = build.boundary.stats
        trial = seconds / patches
        ratio = trial / (trim.best / stats.patches)
        report.rows.append((
            case, f"{stats.patches:,}", f"{stats.live_patches:,}", f"{stats.trapezoids:,}",
            *(build.times(phase).text() for phase in ("features", "trim", "collect")),
            trim.text("µs", stats.patches), f"{1e6 * trial:.0f}", f"{ratio:.1f}", build.checksum(),
        ))  # fmt: skip
        report.figure("core time a patch, times faster than the trial", case, ratio, ">=", AT_LEAST)
    return report


def scene_of(case: str) -> cfree.Scene:
    """A real scene without its bounds, or random convex obstacles."""
    if case in REAL:
        return replace(cfree.load_scene(SCENES / f"{case}.json"), bounds=None)
    arrays = convex(int(case.split()[0]))
    return cfree.Scene(arrays.robot, arrays.rings())
