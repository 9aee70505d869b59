"""A fresh scene's boundary and cells, all cores, beside those of an earlier commit that is built for it.

    .venv/bin/python benchmarks/against.py COMMIT [--rounds 3]

Both take turns, each scene in a new process each time; ratios are made of the fastest rounds.
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import sys
import tempfile
import venv
from pathlib import Path

from families import large, maze
from measure import REAL, ROOT, SCENES

import cfree

TIMED = """
import sys, time, cfree
best = []
for _ in range(5):
    scene = cfree.load_scene(sys.argv[1])
    start = time.perf_counter()
    cfree.free_space(cfree.boundary(scene))
    best.append(time.perf_counter() - start)
print(min(best))
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("commit")
    parser.add_argument("--rounds", type=int, default=3, help="how often each side is timed")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        pythons = {"before": built(asked.commit, Path(folder) / "before"), "now": Path(sys.executable)}
        print("| scene | before ms | now ms | times faster |\n|---|--:|--:|--:|")
        for family, files in scenes(Path(folder)).items():
            ratios = [row(file, pythons, asked.rounds) for file in files]
            if len(files) > 1:
                print(f"| **{family}, median** | | | {statistics.median(ratios):.2f} |")


def built(commit: str, folder: Path) -> Path:
    """The Python of an environment with that commit installed."""
    subprocess.run(["git", "clone", "-q", ROOT, folder / "source"], check=True)
    subprocess.run(["git", "checkout", "-q", commit], cwd=folder / "source", check=True)
    venv.create(folder / "venv", with_pip=True)
    python = folder / "venv" / "bin" / "python"
    subprocess.run([python, "-m", "pip", "install", "-q", folder / "source"], check=True)
    return python


def scenes(folder: Path) -> dict[str, list[Path]]:
    """Files by family: the real scenes each alone, ten mazes, robots of 70 to 100 vertices."""
    found = {name: [SCENES / f"{name}.json"] for name in REAL}
    for family, make, seeds in (("maze", maze, range(10)), ("large", large, range(6, 10))):
        found[family] = [folder / f"{family} {seed}.json" for seed in seeds]
        for seed, file in zip(seeds, found[family], strict=True):
            cfree.save(make(seed), file)
    return found


def row(file: Path, pythons: dict[str, Path], rounds: int) -> float:
    """Prints the times of one scene; how many times faster it has become."""
    times: dict[str, list[float]] = {side: [] for side in pythons}
    for _ in range(rounds):
        for side, python in pythons.items():
            ended = subprocess.run([python, "-c", TIMED, file], check=True, capture_output=True, text=True)
            times[side].append(1e3 * float(ended.stdout))
    before, now = min(times["before"]), min(times["now"])
    print(f"| {file.stem} | {before:.1f} | {now:.1f} | {before / now:.2f} |", flush=True)
    return before / now


if __name__ == "__main__":
    main()
