"""Registered functions are imported when they are called for, and not before."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import get_args, get_type_hints

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

import cfree
from cfree import lazy


def test_a_registered_function_is_imported_at_its_use(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lazy, "_FUNCTIONS", {})
    monkeypatch.delitem(sys.modules, "this", raising=False)
    lazy.register("zen", "this", "s")
    assert "this" not in sys.modules
    assert str(lazy.registered("zen")).startswith("Gur Mra")


def test_cfree_is_imported_without_what_it_registers() -> None:
    code = "import cfree, cfree.value, sys; print([name for name in sys.modules if name.startswith('cfree')])"
    modules = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    assert "cfree.lazy" in modules
    assert "viewer" not in modules
    assert "plot" not in modules


LIBRARIES = ("numpy", "shapely", "flint", "pydantic")
LOADED = f"[name for name in {LIBRARIES} if name in sys.modules]"
PARKING = Path(__file__).parents[1] / "examples" / "scenes" / "benchmr_parking1.json"


@pytest.mark.slow
@pytest.mark.parametrize("options", [[], ["--json"], ["-o", "path.json"], ["--improve", "0"]])
def test_a_plain_plan_loads_no_large_library(options: list[str], tmp_path: Path) -> None:
    """Loading numpy alone takes longer than the plan; the rest of the process is measured in `bench_start.py`."""
    code = f"import sys; from cfree.cli.app import app; app(sys.argv[1:], standalone_mode=False); print({LOADED})"
    command = [sys.executable, "-c", code, "plan", str(PARKING), *options]
    run = subprocess.run(command, check=True, capture_output=True, text=True, cwd=tmp_path)
    assert run.stdout.splitlines()[-1] == "[]"


def test_a_library_is_imported_when_an_attribute_is_used() -> None:
    code = (
        "import sys; from cfree.libraries import np, is_array; assert not is_array([1]);"
        f"before = {LOADED}; a = np.zeros(1); assert is_array(a); print(before, {LOADED}, type(np).__name__)"
    )
    run = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert run.stdout.strip() == "[] ['numpy'] module"


def test_hints_of_arrays_are_those_of_numpy() -> None:
    hints = get_type_hints(cfree.is_free)
    assert set(get_args(ArrayLike)) <= set(get_args(hints["poses"]))
    assert get_type_hints(cfree.Pose.apply)["return"] == NDArray[np.float64]


@pytest.mark.parametrize("name", " ".join(cfree._MOVED.values()).split())
def test_a_name_that_moved_says_where_it_is(name: str) -> None:
    with pytest.raises(AttributeError, match=rf"^cfree\.{name} is now cfree\.(\w+)\.{name}$") as caught:
        getattr(cfree, name)
    home = str(caught.value).split(".")[-2]
    assert getattr(getattr(cfree, home), name).__name__ == name and name not in dir(cfree)
