"""Figures of benchmarks against those of an earlier run."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


@pytest.fixture(autouse=True)
def _benchmarks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))


def test_figures_worse_by_more_than_a_tenth_are_regressions(tmp_path: Path) -> None:
    from last_table import read_figures, regressions
    from measure import Figure

    before = [
        Figure("time", "maze 0", 1.0, "<=", 2.0), Figure("time", "trap 0", 1.0, "<=", 2.0),
        Figure("speedup", "nest 0", 4.0, ">=", 2.0), Figure("time", "gone", 1.0, "<=", 2.0),
    ]  # fmt: skip
    after = [
        Figure("time", "maze 0", 1.09, "<=", 2.0), Figure("time", "trap 0", 1.2, "<=", 2.0),
        Figure("speedup", "nest 0", 2.0, ">=", 2.0), Figure("time", "new", 9.0, "<=", 2.0),
    ]  # fmt: skip
    file = tmp_path / "last.json"
    file.write_text(json.dumps({"reports": [{"figures": [asdict(figure) for figure in before]}]}))
    assert read_figures(file) == before
    assert [(new.case, round(factor, 2)) for _, new, factor in regressions(before, after)] == [
        ("nest 0", 2.0),
        ("trap 0", 1.2),
    ]


def test_the_worst_case_of_a_figure_is_the_farthest_behind_its_target() -> None:
    from last_table import worst_cases
    from measure import Figure

    figures = [
        Figure("time", "a", 1.0, "<=", 2.0),
        Figure("time", "b", 1.0, "<=", 0.5),
        Figure("gain", "a", 1, ">=", 3),
    ]
    assert [(figure.case, share) for figure, share in worst_cases(figures)] == [("b", 2.0), ("a", 3.0)]
