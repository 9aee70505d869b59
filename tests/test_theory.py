"""The examples of docs/theory.md, and the names of code it mentions."""

from __future__ import annotations

import doctest
import importlib
import importlib.util
import re

import pytest

import cfree


def test_the_examples_of_the_theory_page_hold(request: pytest.FixtureRequest) -> None:
    result = doctest.testfile(str(request.config.rootpath / "docs" / "theory.md"), module_relative=False)
    assert result.attempted > 30
    assert result.failed == 0


def test_names_on_the_theory_page_exist(request: pytest.FixtureRequest) -> None:
    text = (request.config.rootpath / "docs" / "theory.md").read_text()
    for module, name in re.findall(r"`(cfree\.[a-z_]+)\.(\w+)`", text):
        if importlib.util.find_spec(module):
            assert hasattr(importlib.import_module(module), name), f"{module} has no {name}"


def test_the_paper_is_covered_by_code_and_tests_that_exist(request: pytest.FixtureRequest) -> None:
    root = request.config.rootpath
    section = (root / "docs" / "theory.md").read_text().split("## 3.")[1].split("###")[0]
    rows = [row.split(" | ") for row in re.findall(r"^\| (.*) \|$", section, re.M)[1:]]
    listed = " ".join(row[0] for row in rows)
    for number in (*range(1, 11), *(f"Lemma {k}" for k in (1, 2, 3)), *(f"Remark {k}" for k in range(1, 7))):
        name = f"({number})" if isinstance(number, int) else number
        assert name in listed, name
    for k in range(1, 11):
        assert re.search(rf"Figures? (\d, )?{k}\b", listed), f"Figure {k}"
    written = " ".join(path.read_text() for path in (root / "tests").rglob("test_*.py"))
    for _, _, code, test in rows:
        assert f"def {test.strip('`')}(" in written, test
        for name in re.findall(r"`cfree\.(\w+)`", code):
            assert hasattr(cfree, name) or importlib.util.find_spec(f"cfree.{name}"), name
