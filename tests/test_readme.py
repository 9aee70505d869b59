"""The README's code runs and prints what it shows; its links lead somewhere."""

from __future__ import annotations

import doctest
import re

import pytest


def test_the_code_prints_what_it_shows(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    root = request.config.rootpath
    monkeypatch.chdir(root)
    result = doctest.testfile(str(root / "README.md"), module_relative=False)
    assert result.attempted >= 8
    assert result.failed == 0


@pytest.mark.parametrize(
    "page", ["README.md", "CONTRIBUTING.md", "docs/architecture.md", "docs/boundary-format.md", "docs/figures.md"]
)
def test_links_lead_to_files(request: pytest.FixtureRequest, page: str) -> None:
    file = request.config.rootpath / page
    links = re.findall(r"\]\(([^)#]+)\)", file.read_text())
    assert links
    for link in links:
        assert (file.parent / link).exists(), link
