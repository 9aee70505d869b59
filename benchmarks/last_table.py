"""Compare the figures of a run with those of an earlier one, and find the worst case of each."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from measure import Figure

WORSE = 1.1  # a figure that is worse by more is a regression


def read_figures(file: Path) -> list[Figure]:
    """Read the figures that a run has written as JSON."""
    reports = json.loads(file.read_text())["reports"]
    return [Figure(**figure) for report in reports for figure in report["figures"]]


def regressions(before: Sequence[Figure], after: Sequence[Figure]) -> list[tuple[Figure, Figure, float]]:
    """Return figures that got worse: before, after, and by which factor, the worst first."""
    known = {(figure.what, figure.case): figure for figure in before}
    pairs = [(known[key], figure) for figure in after if (key := (figure.what, figure.case)) in known]
    found = [(old, new, factor) for old, new in pairs if (factor := _worse(new, old.value)) > WORSE]
    return sorted(found, key=lambda row: -row[2])


def worst_cases(figures: Sequence[Figure]) -> list[tuple[Figure, float]]:
    """Return the case of each kind of figure that is the farthest behind its target, and its share of the target."""
    worst: dict[str, tuple[Figure, float]] = {}
    for figure in figures:
        share = _worse(figure, figure.target)
        if figure.what not in worst or share > worst[figure.what][1]:
            worst[figure.what] = figure, share
    return list(worst.values())


def _worse(figure: Figure, other: float) -> float:
    """How many times as bad a figure is as another value of it."""
    bad, good = (figure.value, other) if figure.relation == "<=" else (other, figure.value)
    return bad / good if good > 0 else float("inf") if bad > 0 else 1.0
