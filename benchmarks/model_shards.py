"""What a run of `bench_shards.py` says of others: schedules of its measured tasks on more workers, for more vertices.

    python bench_shards.py 25000 2 > run.json
    python model_shards.py run.json

First the run's own schedule is simulated, with its own workers, to be compared with what it took. Then tasks are drawn
from those measured, as many as there would be tiles; what the process that asks does alone grows with the vertices.
"""

from __future__ import annotations

import heapq
import json
import random
import sys
from pathlib import Path
from typing import Any

STAGES = {"trim": "trim_task", "glue": "glue_task", "nest": "nest_task", "volumes": "measure_task"}
SUBMITTING = 0.001
"""Seconds of the scheduler for one task, which it gives out one after the other."""
CASES = ((10**6, 2), (10**6, 16), (10**7, 16), (10**8, 160), (10**9, 1600))
HOUR, MINUTE = 3600, 60


def makespan(seconds: list[float], workers: int) -> float:
    """Seconds until the last task is done, each given to the worker that is free first, none before it is submitted."""
    free = [0.0] * workers
    for k, task in enumerate(seconds):
        begin = max(heapq.heappop(free), SUBMITTING * k)
        heapq.heappush(free, begin + task)
    return max(free)


def alone(run: dict[str, Any]) -> dict[str, float]:
    """Seconds a vertex of what the asking process does while no worker has anything to do."""
    waits = {stage: makespan(run["tasks"].get(task, []), run["workers"]) for stage, task in STAGES.items()}
    seconds = run["seconds"]
    rest = {stage: max(0.0, seconds[stage] - waits[stage]) for stage in ("nest", "volumes")}
    return {stage: value / run["vertices"] for stage, value in ({"read": seconds["read"]} | rest).items()}


def predicted(run: dict[str, Any], vertices: int, workers: int) -> dict[str, float]:
    """Seconds of each stage."""
    source, more = random.Random(0), vertices / run["vertices"]
    serial = {stage: vertices * value for stage, value in alone(run).items()}
    stages = {"read": serial["read"]}
    for stage, task in STAGES.items():
        measured = run["tasks"].get(task, [])
        tasks = measured if more == 1 else source.choices(measured, k=max(1, round(more * len(measured))))
        stages[stage] = makespan(tasks, workers) + serial.get(stage, 0.0)
    return stages


def main() -> None:
    run = json.loads(Path(sys.argv[1]).read_text().splitlines()[-1])
    per = {stage: sum(run["tasks"][task]) / run["trapezoids"] for stage, task in STAGES.items()}
    print("{vertices:,} vertices, {trapezoids:,} trapezoids, {tiles} tiles, {workers} workers".format(**run))
    print("microseconds a trapezoid: " + ", ".join(f"{stage} {1e6 * value:.2f}" for stage, value in per.items()))
    print("microseconds a vertex, the asking process alone: "
          + ", ".join(f"{stage} {1e6 * value:.1f}" for stage, value in alone(run).items()))  # fmt: skip
    print(
        "share of others' trapezoids that gluing holds {halo:.2%}, of sides into them {border:.3%}".format(
            **run["borders"]
        )
    )
    guess = predicted(run, run["vertices"], run["workers"])
    for stage in guess:
        print(f"{stage:8} simulated {guess[stage]:8.1f} s, measured {run['seconds'][stage]:8.1f} s")
    print(f"{'all':8} simulated {sum(guess.values()):8.1f} s, measured {run['seconds']['all']:8.1f} s")
    for vertices, workers in CASES:
        stages = predicted(run, vertices, workers)
        total = sum(stages.values())
        text = f"{total / HOUR:.1f} h" if total > HOUR else f"{total / MINUTE:.1f} min"
        shares = ", ".join(f"{stage} {value / total:.0%}" for stage, value in stages.items())
        print(f"{vertices:>13,} vertices, {workers:>5,} workers: {text:>9}: {shares}")


if __name__ == "__main__":
    main()
