"""The binding of the core."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from cfree.contact.kind import Kind


def test_the_committed_stub_is_that_of_the_binding(request: pytest.FixtureRequest, tmp_path: Path) -> None:
    fresh = tmp_path / "_core.pyi"
    command = [sys.executable, "-m", "nanobind.stubgen", "-q", "-m", "cfree._core", "-o", str(fresh)]
    subprocess.run(command, check=True, cwd=request.config.rootpath)
    committed = request.config.rootpath / "src" / "cfree" / "_core.pyi"
    assert fresh.read_text() == committed.read_text(), "run `make stub`"


def test_kinds_are_those_of_the_core() -> None:
    from cfree import _core

    assert {kind.name: kind.value for kind in Kind} == {kind.name: kind.value for kind in _core.Kind}


def test_no_two_types_of_the_core_have_one_name(request: pytest.FixtureRequest) -> None:
    """They are in one namespace, and the linker keeps one of two functions of one name."""
    places: dict[str, list[str]] = {}
    for file in sorted((request.config.rootpath / "cpp").glob("[is]*/**/*.?pp")):
        outside = re.sub(r"(?ms)^namespace \{\n.*?^\}  // namespace$", "", file.read_text())
        for name in re.findall(r"(?m)^(?:struct|class) (\w+)(?: final)?(?: : [^{;]*)? \{", outside):
            places.setdefault(name, []).append(file.name)
    assert len(places) > 150
    assert {name: files for name, files in places.items() if len(files) > 1} == {}


COMMENT = re.compile(r"//.*")
NUMBER = re.compile(r"(?<![\w.])(?:\d+\.\d*|\.\d+|\d+(?=[eE]))(?:[eE][+-]?\d+)?")
# computed from the exact structure, in doubles
COMPUTED = (
    "cell_facts",
    "columns",
    "contact_curve",
    "face_mesher",
    "lattice",
    "layout",
    "limits",
    "mesh",
    "mesh_face",
    "quadrature",
    "round_curve",
    "round_face",
    "rows",
    "slice",
    "surface",
    "triangulation",
    "wall_points",
)
# guesses: motions are then decided, trapezoids that seem to be neighbours glued
GUESSED = (
    "balance",
    "configuration",
    "driver",
    "driving",
    "follow",
    "forward",
    "motion_guess",
    "nearness",
    "ridge",
    "reeds_shepp",
    "rrt_connect",
    "shortcut",
    "shortening",
    "surface_explorer",
    "way",
)
# limits and notation of numbers as they come in and go out
WRITTEN = ("coordinate_range", "ratio")
# constants of mathematics
CONSTANTS = ("elementary",)
NOT_DECIDING = {name + suffix for name in COMPUTED + GUESSED + WRITTEN + CONSTANTS for suffix in (".cpp", ".hpp")}


def tolerances(source: str) -> list[str]:
    """Decimal literals that are no short binary fraction: 1e-9, 0.0001; hexadecimal powers of two are none."""
    lines = [COMMENT.sub("", line) for line in source.splitlines()]
    found = [match for line in lines for match in NUMBER.findall(line)]
    return [text for text in found if "e" in text.lower() or not (16 * float(text)).is_integer()]


def test_no_tolerance_decides(request: pytest.FixtureRequest) -> None:
    core = request.config.rootpath / "cpp"
    files = [*core.glob("src/*/*.?pp"), *core.glob("include/cfree/*/*.hpp")]
    deciding = [file for file in files if file.name not in NOT_DECIDING]
    assert {"ball.hpp", "predicates.cpp", "roots.cpp", "angles.cpp", "trim.cpp"} <= {file.name for file in deciding}
    assert {file.name: found for file in deciding if (found := tolerances(file.read_text()))} == {}


def test_no_function_of_a_library_decides_a_double(request: pytest.FixtureRequest) -> None:
    """Theirs differ from machine to machine; roundings and square roots do not.

    Which tangent stands for radians is what `Pose` says, by Python's library: the core calls the same.
    """
    core = request.config.rootpath / "cpp"
    theirs = re.compile(r"\bstd::(sin|cos|tan|asin|acos|atan2?|hypot|pow|exp|log2?|log10|cbrt)\(")
    files = [*core.glob("src/*/*.?pp"), *core.glob("include/cfree/*/*.hpp")]
    assert {file.name for file in files if theirs.search(file.read_text())} == {"radians.cpp"}


@pytest.mark.parametrize("line", ["if (x < 1e-9) return;", "x + .001", "y = 4E-16;", "abs(x)<0.1", "return 1e9 * x;"])
def test_a_tolerance_is_found(line: str) -> None:
    assert tolerances(line)
    assert not tolerances("x = 0.5 + 2.0 * 0x1p-53 + 0.4375 - e1 + x1e2 + 3;  // 1e-9")
