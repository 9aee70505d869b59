"""Passages ever tighter: how long decisions and paths take, and how many motions a path has.

A rod of 8 x 1 round a right angle whose walls rise at 45 degrees; the clearance is that where it is level. Below zero
it does not get round. OMPL's RRTConnect, fine as in `bench_plan`, for comparison where it is installed.
"""

from __future__ import annotations

import os
from fractions import Fraction
from importlib.util import find_spec

from measure import Report, Times, timed

import cfree

CAP = min(5.0, float(os.environ.get("CAP", 5)))
CLEARANCES = [Fraction(1, 10**k) for k in (1, 2, 4, 6, 9, 12)]


def run(quick: bool) -> Report:
    report = Report(
        "Passages ever tighter",
        ("clearance", "decision ms", "answer", "answer ms", "motions", "least clearance, proved", "RRTConnect, fine"),
        notes=[
            "decision: free space of a scene just read, cells of start and goal; answer: path or proof, that included",
            f"RRTConnect: ms to its first exact solution in one run, or not in {CAP:g} s",
        ],
    )
    chosen = [*CLEARANCES, Fraction(0), *(-c for c in reversed(CLEARANCES))]
    decisions = [compare(clearance, report) for clearance in (chosen[:2] if quick else chosen)]
    best = [times.best for times in decisions]
    report.figure(
        "tight passage, slowest decision to fastest", f"{len(best)} clearances", max(best) / min(best), "<=", 2
    )
    motions = [int(row[4]) for row in report.rows[: len(CLEARANCES)]]
    report.figure(
        "tight passage, motions at the tightest to the widest", "0.1 to 1e-12", motions[-1] / motions[0], "<=", 12
    )
    return report


def scene_of(clearance: Fraction) -> cfree.Scene:
    d, far = 5 + clearance, 40
    workspace = [(-far, -far), (-far, -far - d), (0, -d), (far, -far - d), (far, -far), (0, 0)]
    ends = {"start": cfree.Pose(-25, -28, "45deg"), "goal": cfree.Pose(25, -28, "-45deg")}
    return cfree.Scene([(-4, 0), (4, 0), (4, 1), (-4, 1)], workspace=workspace, **ends)


def compare(clearance: Fraction, report: Report) -> Times:
    scene = scene_of(clearance)
    assert scene.start and scene.goal
    decision, answering = timed(
        lambda: cfree.free_space(cfree.boundary(scene)).locate([scene.start, scene.goal]),
        lambda: cfree.plan(cfree.free_space(cfree.boundary(scene)), scene.start, scene.goal),
        rounds=5,
    )
    answer = cfree.plan(cfree.free_space(cfree.boundary(scene)), scene.start, scene.goal)
    found = isinstance(answer, cfree.Path)
    least = cfree.clearance(answer, scene) if found else None
    report.rows.append((
        f"{float(clearance):g}", decision.text(), "path" if found else f"separated, {answer.of}", answering.text(),
        str(len(answer.motions)) if found else "0", f"{least.least:.2g}" if least else "–", rival(scene),
    ))  # fmt: skip
    return decision


def rival(scene: cfree.Scene) -> str:
    if any(find_spec(name) is None for name in ("numba", "ompl")):
        return "not installed"
    from bench_plan import STEPS
    from bench_plan import rival as runs

    result = runs(lambda: scene, STEPS["fine"], CAP, 1)
    return f"{1e3 * result.seconds[0]:.3g}" + (", clips" if result.clip else "") if result.solved else "no"
