"""The examples of docs/theory.md, and the names of code it mentions."""

from __future__ import annotations

import doctest
import importlib
import importlib.util
import re

import pytest


def test_the_examples_of_the_theory_page_hold(request: pytest.FixtureRequest) -> None:
    result = doctest.testfile(str(request.config.rootpath / "docs" / "theory.md"), module_relative=False)
    assert result.attempted > 30
    assert result.failed == 0


def test_names_on_the_theory_page_exist(request: pytest.FixtureRequest) -> None:
    text = (request.config.rootpath / "docs" / "theory.md").read_text()
    for module, name in re.findall(r"`(cfree\.[a-z_]+)\.(\w+)`", text):
        if importlib.util.find_spec(module):
            assert hasattr(importlib.import_module(module), name), f"{module} has no {name}"
