"""The examples of docs/theory and of the page for geometers, and the list of what is in the paper."""

from __future__ import annotations

import doctest
import re
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image


def pages(root: Path) -> list[Path]:
    """The pages in the order in which their examples follow each other: the first names the others."""
    first = root / "docs" / "theory" / "index.md"
    listed = first.read_text().split(":hidden:")[1].split("```")[0].split()
    return [first, *(first.with_name(f"{name}.md") for name in listed)]


@pytest.mark.slow
def test_the_examples_of_the_theory_pages_hold(request: pytest.FixtureRequest) -> None:
    session: dict[str, object] = {"__name__": "__main__"}
    attempted = 0
    for page in pages(request.config.rootpath):
        examples = doctest.DocTestParser().get_doctest(page.read_text(), session, page.name, str(page), 0)
        result = doctest.DocTestRunner().run(examples, clear_globs=False)
        assert result.failed == 0, page.name
        session = examples.globs
        attempted += result.attempted
    assert attempted >= 144


@pytest.mark.slow
def test_the_examples_for_geometers_hold(
    request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    result = doctest.testfile(str(request.config.rootpath / "docs" / "for-geometers.md"), module_relative=False)
    assert result.failed == 0 and result.attempted >= 70
    with (
        Image.open("three-contacts.png") as image,
        Image.open(request.config.rootpath / "docs" / "images" / "three-contacts.png") as shown,
    ):
        drawn, kept = (np.asarray(one.convert("L").resize((70, 75)), float) for one in (image, shown))
    assert np.abs(drawn - kept).mean() < 4  # the page shows what the example draws


def test_the_first_theory_page_lists_all_others(request: pytest.FixtureRequest) -> None:
    first, *others = pages(request.config.rootpath)
    assert {*first.parent.glob("*.md")} == {first, *others}
    links = re.findall(r"^\| \[.*\]\((.*)\) \|", first.read_text(), re.M)
    assert links == [page.name for page in others]


def test_every_statement_has_a_number_of_its_own_that_the_list_gives_with_its_page(
    request: pytest.FixtureRequest,
) -> None:
    first, *others = pages(request.config.rootpath)
    folder = first.parent
    listed = re.findall(r"^\| (\d+) \| (.+) \| \[(.*)\]\((.*)\) \|$", (folder / "statements.md").read_text(), re.M)
    assert [int(number) for number, *_ in listed] == list(range(1, len(listed) + 1)) and len(listed) >= 55
    stated = {}
    for page in others:
        if page.name != "statements.md":
            for number in re.findall(r"\*\*[^*]*?Proposition (\d+)[^*]*\*\*", page.read_text()):
                assert number not in stated, number
                stated[number] = page
    assert {number: folder / page for number, _, _, page in listed} == stated
    for _, _, title, page in listed:
        assert (folder / page).read_text().startswith(f"# {title}\n")
    texts = [*(path for name in ("docs", "src") for path in (request.config.rootpath / name).rglob("*.*"))]
    for path in texts:
        if path.suffix in (".md", ".py"):  # who cites a number cites one that there is
            assert set(re.findall(r"Proposition (\d+)", path.read_text())) <= set(stated), path


def test_words_have_a_meaning_and_the_page_that_uses_them(request: pytest.FixtureRequest) -> None:
    page = request.config.rootpath / "docs" / "theory" / "notation.md"
    rows = re.findall(r"^\| ([^|]+) \| ([^|]+) \| (\[.*\)) \|$", page.read_text().split("## Words")[1], re.M)
    words = [word for row, _, _ in rows for word in row.split(", ")]
    assert len(words) == len(set(words)) >= 35 and [row for row, _, _ in rows] == sorted(row for row, _, _ in rows)
    for row, meaning, places in rows:
        assert len(meaning) > 10
        text = "".join((page.parent / name).read_text() for name in re.findall(r"\((.*?)\)", places)).lower()
        text = " ".join(text.split())
        for word in row.split(", "):
            assert re.search(rf"\b{word.removesuffix(' side')}", text), word
    assert "wall" in words


def test_the_paper_is_covered_by_code_and_tests_that_exist(request: pytest.FixtureRequest) -> None:
    root = request.config.rootpath
    page = (root / "docs" / "theory" / "paper.md").read_text()
    rows = [row.split(" | ") for row in re.findall(r"^\| (.*) \|$", page, re.M)[1:]]
    listed = " ".join(row[0] for row in rows)
    for number in (*range(1, 11), *(f"Lemma {k}" for k in (1, 2, 3)), *(f"Remark {k}" for k in range(1, 7))):
        name = f"({number})" if isinstance(number, int) else number
        assert name in listed, name
    for k in range(1, 11):
        assert re.search(rf"Figures? (\d, )?{k}\b", listed), f"Figure {k}"
    files = [path.read_text() for path in (root / "tests").rglob("test_*.py")]
    written = "".join(files)
    for _, _, code, tests in rows:
        names = re.findall(r"`(test_\w+)`", tests)
        assert names and len(names) == tests.count(",") + 1, tests
        for name in names:  # of one test, so that it can be run with `pytest -k`
            assert written.count(f"def {name}(") == 1, name
        beside = "".join(text for text in files if any(f"def {name}(" in text for name in names))
        for name in re.findall(r"`cfree\.([\w.]+)`", code):
            assert re.search(rf"\b{name.split('.')[-1]}\b", beside), f"{name}: no test of its row names it"
            found: Any = import_module("cfree")
            for part in name.split("."):
                found = getattr(found, part, None) or import_module(f"{found.__name__}.{part}")
