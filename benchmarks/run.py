"""Benchmarks of cfree against baselines measured in the same run; see README.md beside this file.

python benchmarks/run.py [NAME ...] [--quick] [--json FILE] [--against FILE]
"""

from __future__ import annotations

import argparse
import importlib
import json
import os
import sys
import time
from dataclasses import asdict
from pathlib import Path

from last_table import read_figures, regressions, worst_cases
from measure import Figure, Report, machine

from cfree.cli.terminal import columns

BENCHES = (
    "boundary",
    "moved",
    "frames",
    "exact",
    "growth",
    "vertices",
    "threads",
    "slice",
    "surface",
    "mesh",
    "free",
    "cells",
    "city",
    "shards",
    "routes",
    "plan",
    "paths",
    "tight",
    "vehicles",
    "curves",
    "round",
    "fits",
    "nesting",
    "scene",
    "page",
    "start",
)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(BENCHES)}; all by default")
    parser.add_argument("--quick", action="store_true", help="small scenes and few rounds: only to see that it runs")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all figures there, too")
    parser.add_argument(
        "--against", type=Path, metavar="FILE",
        help="print figures that are worse by more than 10 percent than in this table; by default that of --json",
    )  # fmt: skip
    options = parser.parse_args()
    if unknown := set(options.names) - set(BENCHES):
        parser.error(f"no benchmark {', '.join(sorted(unknown))}; give some of {', '.join(BENCHES)}")
    last = options.against or options.json
    if options.against and not options.against.exists():
        parser.error(f"--against {options.against}: no such file; give one that --json has written")
    before = read_figures(last) if last and last.exists() else []
    about = machine()
    for key, value in about.items():
        print(f"{key:<10} {value}")
    print("times: median (range) after a warm-up; ratios: of the fastest rounds\n")
    start, reports = time.perf_counter(), []
    for name in options.names or BENCHES:
        result = importlib.import_module(f"bench_{name}").run(options.quick)
        for report in result if isinstance(result, list) else [result]:
            reports.append(report)
            print_report(report)
    seconds = time.perf_counter() - start
    about["load"] += f", {os.getloadavg()[0]:.1f} at the end"
    missed = print_verdicts(reports)
    if before:
        print_regressions(before, [figure for report in reports for figure in report.figures], last)
    print(f"{seconds:.0f} s in all; load {about['load']}")
    if options.json:
        facts = {"machine": about, "seconds": seconds, "reports": [asdict(report) for report in reports]}
        options.json.write_text(json.dumps(facts, indent=1) + "\n")
    return 1 if missed else 0


def print_report(report: Report) -> None:
    table = columns([report.columns, *report.rows], "<".ljust(len(report.columns), ">"))
    print(report.title, *table, *report.notes, "", sep="\n")


def print_verdicts(reports: list[Report]) -> int:
    """All figures against their targets; how many miss."""
    rows = [["figure", "case", "measured", "target", "verdict"]]
    for figure in (figure for report in reports for figure in report.figures):
        measured, target = f"{figure.value:.3g}{figure.unit}", f"{figure.relation} {figure.target:g}{figure.unit}"
        rows.append([figure.what, figure.case, measured, target, "PASS" if figure.passes else "FAIL"])
    print("Targets", *columns(rows, "<<>><"), sep="\n")
    worst = [
        [figure.what, figure.case, f"{figure.value:.3g}{figure.unit}", f"{share:.2f}"]
        for figure, share in worst_cases([figure for report in reports for figure in report.figures])
    ]
    print("\nWorst cases", *columns([["figure", "case", "measured", "of target"], *worst], "<<>>"), sep="\n")
    return sum(row[-1] == "FAIL" for row in rows)


def print_regressions(before: list[Figure], after: list[Figure], file: Path) -> None:
    """All figures that got worse since an earlier run."""
    rows = [
        [new.what, new.case, f"{old.value:.3g}{old.unit}", f"{new.value:.3g}{new.unit}", f"{factor:.2f}"]
        for old, new, factor in regressions(before, after)
    ]
    head = f"\nWorse than in {file} by more than 10 %"
    if rows:
        print(head, *columns([["figure", "case", "before", "now", "times as bad"], *rows], "<<>>>"), sep="\n")
    else:
        print(f"{head}: none")


if __name__ == "__main__":
    sys.exit(main())
