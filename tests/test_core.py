"""The binding of the core."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest


def test_the_committed_stub_is_that_of_the_binding(request: pytest.FixtureRequest, tmp_path: Path) -> None:
    fresh = tmp_path / "_core.pyi"
    command = [sys.executable, "-m", "nanobind.stubgen", "-q", "-m", "cfree._core", "-o", str(fresh)]
    subprocess.run(command, check=True, cwd=request.config.rootpath)
    committed = request.config.rootpath / "src" / "cfree" / "_core.pyi"
    assert fresh.read_text() == committed.read_text(), "run `make stub`"
