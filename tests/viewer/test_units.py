"""The page's modules that need no browser: their unit tests under node, and their format."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

VIEWER = Path(__file__).parents[2] / "viewer"
NODE = shutil.which("node")
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(NODE is None, reason="node is not installed: the page's unit tests did not run"),
    pytest.mark.skipif(
        not (VIEWER / "node_modules" / "prettier").exists(),
        reason="viewer/node_modules is missing: `make viewer-test` installs it",
    ),
]


def ended(*command: str) -> None:
    done = subprocess.run([str(NODE), *command], cwd=VIEWER, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_unit_tests_of_the_page() -> None:
    ended("test.mjs")


def test_typescript_is_formatted() -> None:
    files = sorted(str(file) for pattern in ("*.mjs", "src/*.ts", "tests/*.mjs") for file in VIEWER.glob(pattern))
    ended("node_modules/prettier/bin/prettier.cjs", "--check", *files)
