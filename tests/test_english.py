"""Plain English, held by numbers that only fall: first words, long sentences, names that exist."""

import ast
import importlib.util
import inspect
import pkgutil
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import cfree

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src" / "cfree"

ODD_WORD = re.compile(
    r"(Of|What|Which|Whether|Those|That|As|By|For|With|Where|How|In|From|Over|Without|If|On|At|To|Who|Whose|Nothing|Not"
    r"|Is|Are|Has|Does|Can|So)\b"
)
ODD_SHARE = 0.02  # of all docstrings

LONG = 40  # words
LONG_SENTENCES = {"docs": 10, "docs/theory": 5}

OTHERS = frozenset({"ompl"})  # packages with the name of a module of this one
FILE = re.compile(r"\.(py|hpp|cpp|ts|js|css|html|md|jsonl?|toml|yaml|txt|csv|npz|png|svg|gif|dxf|pgm|stl|ply|obj|glb)$")


def texts(path: Path) -> Iterator[tuple[int, str]]:
    """Line and text of every docstring of a file, those below attributes included."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str):
            yield node.lineno, node.value.value


def docstrings(path: Path) -> Iterator[tuple[int, str]]:
    """Line and text of the docstrings of a file's module, classes and functions."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            text = ast.get_docstring(node)
            if text:
                yield getattr(node, "lineno", 1), text


def is_odd(docstring: str) -> bool:
    """True if a docstring begins with a word that hides its subject."""
    return ODD_WORD.match(docstring) is not None


@pytest.mark.slow
def test_docstrings_begin_with_a_verb_or_their_subject() -> None:
    every = [
        (f"{file.relative_to(SOURCE)}:{line}", text) for file in SOURCE.rglob("*.py") for line, text in docstrings(file)
    ]
    odd = [f"{place}: {text.splitlines()[0]}" for place, text in every if is_odd(text)]
    assert len(every) > 2000
    assert len(odd) <= ODD_SHARE * len(every), f"{len(odd)} of {len(every)} docstrings:\n" + "\n".join(odd)


@pytest.mark.parametrize(
    ("docstring", "odd"), [("Of a pose.", True), ("What: all.", True), ("Is it?", True), ("Offset of a pose.", False)]
)
def test_first_words_are_told_apart(docstring: str, odd: bool) -> None:
    assert is_odd(docstring) is odd


def sentences(page: str) -> Iterator[str]:
    """Sentences of a Markdown page; a formula, a piece of code and a link's text without its address are in them."""
    page = re.sub(r"^(`{3,}).*?^\1`*\s*$", "\n\n", page, flags=re.S | re.M)
    page = re.sub(r"\$\$.*?\$\$|\$[^$]+\$|`[^`]+`", " formula ", page, flags=re.S)
    page = re.sub(r"!\[[^\]]*\]\([^)]*\)", "\n\n", page)
    page = re.sub(r"(\[[^\]]*\])\([^)]*\)", r"\1", page)
    page = re.sub(r"^(?=\s*(?:[-*+]|\d+\.) |\s*\||#)|(?<=\|)$", "\n\n", page, flags=re.M)
    for block in re.split(r"\n\s*\n", page):
        yield from re.split(r"(?<=[.!?])[*_)\]\"']*\s+", block)


def words(sentence: str) -> int:
    """Number of words of a sentence, without marks that stand alone."""
    return sum(bool(re.search(r"\w", word)) for word in sentence.split())


@pytest.mark.parametrize("folder", LONG_SENTENCES)
def test_few_sentences_are_long(folder: str) -> None:
    long = [
        f"{page.name}: {words(sentence)} words: {' '.join(sentence.split())}"
        for page in sorted((ROOT / folder).glob("*.md"))
        for sentence in sentences(page.read_text())
        if words(sentence) > LONG
    ]
    assert len(long) <= LONG_SENTENCES[folder], f"{len(long)} sentences:\n" + "\n".join(long)


def test_sentences_end_at_stops_blank_lines_items_images_and_rows() -> None:
    page = "# One two\nThree $a + b + c$\nfour. Five\n\n- six seven\n- eight\n\n| nine | ten |\n| x | y |\n\n"
    page += "```\nno no\n```\n"
    page += "![not a word](image.png)\n*Eleven twelve.* [Thirteen fourteen](a-page.md) `no = code`.\n"
    counts = [words(sentence) for sentence in sentences(page) if words(sentence)]
    assert counts == [5, 1, 2, 1, 2, 2, 2, 3]


@cache
def modules() -> dict[str, list[ModuleType]]:
    """Modules of the package by the last part of their names."""
    by_name: dict[str, list[ModuleType]] = {}
    for module in pkgutil.walk_packages(cfree.__path__, "cfree."):
        if module.name != "cfree.ompl" or importlib.util.find_spec("ompl"):  # an extra that some platforms do not have
            by_name.setdefault(module.name.rpartition(".")[2], []).append(importlib.import_module(module.name))
    return by_name


@cache
def classes() -> dict[str, list[type]]:
    """Classes of the package, those of the core included, by name."""
    by_name: dict[str, list[type]] = {}
    for module in (module for same in modules().values() for module in same):
        for name, value in vars(module).items():
            if isinstance(value, type) and value.__module__.startswith("cfree") and value not in by_name.get(name, []):
                by_name.setdefault(name, []).append(value)
    return by_name


@cache
def all_modules() -> frozenset[str]:
    """Full names of all modules of the package."""
    return frozenset(module.__name__ for same in modules().values() for module in same)


@cache
def fields(owner: type) -> frozenset[str]:
    """Fields of a class's instances: those annotated, and those assigned to `self`."""
    names: set[str] = set()
    for base in getattr(owner, "__mro__", ()):
        if base.__module__.startswith("cfree.") and base.__module__ != "cfree._core":
            names |= {
                *vars(base).get("__annotations__", ()),
                *re.findall(r"\bself\.(\w+)[^=\n]* = ", inspect.getsource(base)),
            }
    return frozenset(names)


def has(owner: Any, name: str) -> bool:
    """True if a module or a class has a name: an attribute, or a field of its instances."""
    if isinstance(owner, ModuleType):
        return hasattr(owner, name) or f"{owner.__name__}.{name}" in all_modules()
    return hasattr(owner, name) or name in fields(owner)


def resolves(name: str) -> bool:
    """True if a dotted name is none of this package, or names something that exists."""
    head, *rest = name.split(".")
    if head == "cfree":
        owner: Any = cfree
        for part in rest:
            if not has(owner, part):
                return False
            owner = getattr(owner, part, None)
            if owner is None:
                return True
        return True
    owners = [*classes().get(head, []), *modules().get(head, [])]
    if head.islower():  # a value named after its class
        owners += [owner for named, same in classes().items() if named.lower().endswith(head) for owner in same]
    if head in OTHERS or not owners:
        return head[0].islower()  # of another package: classes are named by their own names only
    return any(has(owner, rest[0]) for owner in owners)


def names(docstring: str) -> Iterator[str]:
    """Dotted names in the code of a docstring, those of files left out."""
    for code in re.findall(r"`([^`]+)`", docstring):
        for name in re.findall(r"(?<![\w.\"'/-])[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)+", code):
            if not FILE.search(name):
                yield name


@pytest.mark.slow
def test_names_in_docstrings_exist() -> None:
    stale = [
        f"{file.relative_to(SOURCE)}:{line}: {name}"
        for file in sorted(SOURCE.rglob("*.py"))
        for line, text in texts(file)
        for name in names(text)
        if not resolves(name)
    ]
    assert not stale, "\n".join(stale)


@pytest.mark.parametrize(
    "name",
    [
        "cfree.plan",
        "cfree.forbidden.boundary.Boundary",
        "Boundary.slice",
        "Pose.x",
        "scene.robot",
        "InvalidFileError.problems",
        "numpy.nothing",
    ],
)
def test_names_that_exist_resolve(name: str) -> None:
    assert resolves(name)


@pytest.mark.parametrize("name", ["Path.stale", "Stale.save", "Boundary.stale", "scene.stale"])
def test_stale_names_do_not_resolve(name: str) -> None:
    assert not resolves(name)


@pytest.mark.parametrize("name", ["stale", "forbidden.stale"])
def test_stale_names_of_the_package_do_not_resolve(name: str) -> None:
    assert not resolves(f"cfree.{name}")
