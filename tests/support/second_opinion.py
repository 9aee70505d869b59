"""Check an answer by `cfree.verify` and by `tools/check_answer.py`, which must agree."""

from __future__ import annotations

import importlib.util
import sys
import tempfile
from dataclasses import replace
from pathlib import Path as FilePath
from typing import Any

import cfree.verify
from cfree import FormatError, Path, Scene, UnsupportedError, save
from cfree.formats.scene_file import scene_text
from cfree.planning.proof import Proof
from cfree.verify.result import Verification

TOOL = FilePath(__file__).parents[2] / "tools/check_answer.py"


def _loaded() -> Any:
    spec = importlib.util.spec_from_file_location("check_answer", TOOL)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    sys.modules["check_answer"] = module
    spec.loader.exec_module(module)
    return module


check_answer = _loaded()


def verified(scene: Scene, file: FilePath) -> Verification:
    """Verification of an answer in a file by `cfree.verify`.

    Raises
    ------
    AssertionError
        If the other checker disagrees.
    FormatError, UnsupportedError
        If both cannot read the file.
    """
    code, said = check_answer.verdict(scene_text(scene), file.read_text(encoding="utf-8"))
    try:
        result = cfree.verify.answer(scene, file)
    except (FormatError, UnsupportedError) as error:
        assert code == 2, f"a bad file for cfree, and not for check_answer: {error}; {said}"
        raise
    assert code == (0 if result.verified else 1), f"check_answer: {said}; cfree.verify: {result}"
    assert not result.verified or said == f"{result.proved} verified", f"{said}; {result.proved}"
    return result


def verified_in_a_file(scene: Scene, answer: Path | Proof) -> Verification:
    """Verification of an answer in memory, which is saved first."""
    known = replace(answer, scene=scene) if isinstance(answer, Path) and answer.curved is None else answer
    with tempfile.TemporaryDirectory() as folder:
        file = FilePath(folder, "answer.json")
        save(known, file)
        return verified(scene, file)
