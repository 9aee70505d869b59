"""Registered functions are imported when they are called for, and not before."""

from __future__ import annotations

import subprocess
import sys

import pytest

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


@pytest.mark.parametrize("name", " ".join(cfree._MOVED.values()).split())
def test_a_name_that_moved_says_where_it_is(name: str) -> None:
    with pytest.raises(AttributeError, match=rf"^cfree\.{name} is now cfree\.(\w+)\.{name}$") as caught:
        getattr(cfree, name)
    home = str(caught.value).split(".")[-2]
    assert getattr(getattr(cfree, home), name).__name__ == name and name not in dir(cfree)
