"""Packages import one way, and no files import each other in a circle."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

SOURCE = Path(__file__).parents[1] / "src"
CPP = SOURCE.parent / "cpp"
PAGE = (SOURCE.parent / "docs" / "architecture.md").read_text()
CORE = "cfree._core"
ORDER = """
    lazy libraries errors collector value arguments palette words
    exact vehicles polygons curves scene contact collision forbidden geometry free paths planning analysis formats
    verify nesting caging disassembly distributed rational arrangements ompl plot figures film viewer cli __main__
""".split()  # noqa: SIM905
"""Each imports only from those before it."""


def modules() -> dict[str, Path]:
    """All files of the package by name."""
    files = {path.relative_to(SOURCE).with_suffix(""): path for path in SOURCE.rglob("*.py")}
    return {".".join(name.parts).removesuffix(".__init__"): path for name, path in files.items()}


MODULES = modules()


def imported(text: str) -> Iterator[str]:
    """Files of the package named by any import statement: in functions and under TYPE_CHECKING, too."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name.split(".")[0] == "cfree")
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "imports are absolute"
            if node.module and node.module.split(".")[0] == "cfree":
                names = (f"{node.module}.{alias.name}" for alias in node.names)
                yield from (name if name in MODULES or name == CORE else node.module for name in names)


def named(text: str) -> Iterator[str]:
    """Files of the package named by a whole string, such as an argument of `import_module`.

    The beginning of f"cfree.formats.{name}" stands for some file of that package, and ends with a dot.
    """
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Constant) and re.fullmatch(r"cfree\.(\w+[.:])*\w*", str(node.value)):
            parts = re.split(r"[.:]", node.value)
            names = [name for k in range(len(parts), 1, -1) if (name := ".".join(parts[:k])) in MODULES]
            yield from names[:1] if parts[-1] else [node.value]


def package(name: str) -> str:
    return name.split(".")[1]


@pytest.mark.parametrize("name", [name for name in MODULES if name != "cfree"])
def test_imports_lead_down(name: str) -> None:
    text = MODULES[name].read_text()
    for other in (*imported(text), *named(text)):
        assert other != "cfree", "importing the public package makes a circle"
        assert other == CORE or ORDER.index(package(other)) <= ORDER.index(package(name)), other


def test_imports_within_formats_lead_down() -> None:
    """`formats/__init__.py` lists the order of the parts of the package."""
    text = MODULES["cfree.formats"].read_text()
    order = re.findall(r"^\d+\. `(\w+)(?:/|\.py)`", text, re.MULTILINE)
    files = {name: name.split(".")[2] for name in MODULES if name.startswith("cfree.formats.")}
    assert sorted(order) == sorted(set(files.values()))
    for name, part in files.items():
        for other in imported(MODULES[name].read_text()):
            assert other not in files or order.index(files[other]) <= order.index(part), f"{name} imports {other}"


@pytest.mark.slow
def test_no_files_import_each_other_in_a_circle() -> None:
    graph = dict[str, set[str]]()
    for name, path in MODULES.items():
        text = path.read_text()
        graph[name] = {other for other in imported(text) if other != name}
        graph[name] |= {other for other in named(text) if not f"{name}.".startswith(f"{other}.")}
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        pytest.fail(f"circle: {' <- '.join(error.args[1])}")


def test_hidden_imports_are_read() -> None:
    text = """
        from typing import TYPE_CHECKING
        if TYPE_CHECKING:
            from cfree.film import save_film
        def late():
            import cfree.verify.world
            import cfree._core
    """
    lines = [line.removeprefix("        ") for line in text.splitlines()]
    assert set(imported("\n".join(lines))) == {"cfree.film", "cfree.verify.world", CORE}


def test_strings_that_name_modules_are_read() -> None:
    text = """
        import_module("cfree.viewer.notebook").live()
        register("picture", "cfree.plot", "picture")
        later = "cfree.verify.world"
        import_module(f"cfree.formats.{later}")
        resolve_name("cfree.viewer.pictures:picture")
        raise ImportError("cfree.ompl needs OMPL", "cfree.Scene", "cfree")
    """
    lines = [line.removeprefix("        ") for line in text.splitlines()]
    seen = ["cfree.viewer.notebook", "cfree.plot", "cfree.verify.world", "cfree.formats.", "cfree.viewer.pictures"]
    assert sorted(named("\n".join(lines))) == sorted(seen)


def test_includes_of_the_core_lead_down() -> None:
    table = PAGE.split("| folder of `cpp/src`")[1].split("`cpp/bindings`")[0]
    folders = re.findall(r"^\| `(\w+)/`", table, re.MULTILINE)
    assert sorted(folders) == sorted(path.name for path in (CPP / "src").iterdir())
    for path in (*CPP.glob("include/cfree/*/*.hpp"), *CPP.glob("src/*/*.?pp")):
        for other in re.findall(r'#include "(?:cfree/)?(\w+)/', path.read_text()):
            assert folders.index(other) <= folders.index(path.parent.name), f"{path.relative_to(CPP)} includes {other}"


def test_the_architecture_page_lists_the_packages_in_their_order() -> None:
    table = PAGE.split("## The packages")[1].split("`__init__.py`")[0]
    rows = [row.split("|")[1] for row in table.splitlines() if row.startswith("| `")]
    assert re.findall(r"`(\w+)(?:\.py|/)`", " ".join(rows)) == ORDER[:-1]
