"""Benchmarks of cfree against baselines measured in the same run; see README.md beside this file.

python benchmarks/run.py [NAME ...] [--quick] [--json FILE]
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

from measure import Report, machine
from rich.console import Console
from rich.table import Table

BENCHES = (
    "boundary",
    "exact",
    "growth",
    "threads",
    "slice",
    "surface",
    "mesh",
    "free",
    "cells",
    "plan",
    "tight",
    "fits",
    "scene",
    "start",
)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(BENCHES)}; all by default")
    parser.add_argument("--quick", action="store_true", help="small scenes and few rounds: only to see that it runs")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all figures there, too")
    options = parser.parse_args()
    if unknown := set(options.names) - set(BENCHES):
        parser.error(f"no benchmark {', '.join(sorted(unknown))}; give some of {', '.join(BENCHES)}")
    console = Console(highlight=False, width=None if sys.stdout.isatty() else 200)
    about = machine()
    for key, value in about.items():
        console.print(f"{key:<10} {value}")
    console.print("times: median (range) after a warm-up; ratios: of the fastest rounds\n")
    start, reports = time.perf_counter(), []
    for name in options.names or BENCHES:
        result = importlib.import_module(f"bench_{name}").run(options.quick)
        for report in result if isinstance(result, list) else [result]:
            reports.append(report)
            print_report(console, report)
    seconds = time.perf_counter() - start
    about["load"] += f", {os.getloadavg()[0]:.1f} at the end"
    missed = print_verdicts(console, reports)
    console.print(f"{seconds:.0f} s in all; load {about['load']}")
    if options.json:
        facts = {"machine": about, "seconds": seconds, "reports": [asdict(report) for report in reports]}
        options.json.write_text(json.dumps(facts, indent=1) + "\n")
    return 1 if missed else 0


def print_report(console: Console, report: Report) -> None:
    table = Table(title=report.title, title_justify="left", box=None, pad_edge=False)
    for k, column in enumerate(report.columns):
        table.add_column(column, justify="right" if k else "left", no_wrap=not console.is_terminal)
    for row in report.rows:
        table.add_row(*row)
    console.print(table)
    for note in report.notes:
        console.print(note, markup=False)
    console.print()


def print_verdicts(console: Console, reports: list[Report]) -> int:
    """All figures against their targets; how many miss."""
    table = Table(title="Targets", title_justify="left", box=None, pad_edge=False)
    for column in ("figure", "case", "measured", "target", "verdict"):
        table.add_column(column, justify="right" if column in ("measured", "target") else "left")
    missed = 0
    for figure in (figure for report in reports for figure in report.figures):
        verdict = "[green]PASS" if figure.passes else "[bold red]FAIL"
        target = f"{figure.relation} {figure.target:g}{figure.unit}"
        table.add_row(figure.what, figure.case, f"{figure.value:.3g}{figure.unit}", target, verdict)
        missed += not figure.passes
    console.print(table)
    return missed


if __name__ == "__main__":
    sys.exit(main())
