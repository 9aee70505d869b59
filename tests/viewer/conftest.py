"""Debian's chromium; where it is not installed, what needs it says so and is skipped."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from pages import CHROMIUM, SWIFTSHADER, Tried, bare_page


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    playwright = pytest.importorskip(
        "playwright.sync_api", reason="playwright is not installed: the page was not tried"
    )
    if not CHROMIUM.exists():
        pytest.skip("chromium is not installed: the page was not tried in a browser")
    with playwright.sync_playwright() as running:
        found = running.chromium.launch(executable_path=str(CHROMIUM), args=SWIFTSHADER)
        yield found
        found.close()


@pytest.fixture(scope="module")
def tried(browser: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Tried]:
    """The page as it is without a scene of one's own."""
    tried = Tried(browser, bare_page(tmp_path_factory.mktemp("page")))
    tried.ready("paper_fig9")
    yield tried
    tried.close()
