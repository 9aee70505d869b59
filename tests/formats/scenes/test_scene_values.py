"""Scenes are read in two ways, at once and by models that find every fault: both mean the same."""

import json
import random
import tracemalloc
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest

from cfree.errors import FormatError
from cfree.formats.readers import quick_scene
from cfree.formats.scene_file import scene_from_text
from cfree.formats.scenes.scene_format import scene_from_models
from cfree.formats.scenes.scene_values import shape_at_once
from cfree.formats.text.findings import Findings
from cfree.formats.text.json_text import read_literals, read_members, with_numbers
from cfree.scene.scene import Scene
from examples import POLYGONS
from scene_texts import place_in

ROOT = Path(__file__).parents[3]
RICH = {
    "version": 1,
    "name": "K\u00fcche",
    "note": "",
    "units": "m",
    "source": {"licence": "MIT"},
    "robot": [{"outer": [[0, 0], [1, 0], ["0", 1.5]], "holes": [[[0.1, 0.1], [0.2, 0.1], [0.1, "1/5"]]]}],
    "obstacles": [
        {"name": None, "outer": [[3, 0], [4, 0], [3, 1e0]]},
        {"name": "a", "outer": [[5, 0], [6, 0], [5, 1]]},
        [[7, 0], ["8", 0], [7, "1/3"]],
    ],
    "workspace": {"outer": [[-9, -9], [9, -9], [9, 9], [-9, 9]], "holes": []},
    "bounds": [-8, "-8", 8.5, 8],
    "start": [0, 0.5, "90deg"],
    "goal": [0, "1/3", {"tau": 0.5}],
    "check": {"free": True, "list": [1, 2.5, None]},
    "reading": [
        {
            "kind": "lost",
            "what": "open line",
            "effect": "less",
            "count": 39,
            "where": "walls",
            "at": [1, -2.5],
            "size": 3,
            "remedy": "--join 0.1",
            "file": "a.dxf",
            "items": [{"handle": "5F", "at": [1, 2], "size": 0.5, "points": [[1, 2]]}],
        },
        {"kind": "zebra", "what": "stripe"},
    ],
}
ODD: tuple[Any, ...] = (
    None, True, 0, 1, -1.5, 1e400, 2, "", "1", "x", "1/0", "90deg", "\ud800", [], {}, [0, 0], [0, 0, 0], [0, 0, 1, 1],
    [1, 1, 0, 0], {"tau": None}, {"tau": "inf"}, {"a": "\ud800"}, "n" * 1001, {"outer": [[0, 0], [1, 0]]}, [[]],
    {"outer": [[0, 0], [1, 0], [0, 1]]}, {"outer": [[0, 0], [1, 0], [0, 1]], "name": None},
)  # fmt: skip


def both(text: str) -> tuple[Scene | None, Scene | None]:
    """What the quick reader says, and what the models say."""
    findings = Findings("scene.json", text)
    data, quick = read_literals(findings), quick_scene(read_members(Findings("scene.json", text), shape_at_once))
    if quick is None and not findings:  # a polygon where none is expected
        quick = quick_scene(data)
    try:
        return quick, scene_from_models(findings, with_numbers(read_literals(Findings("scene.json", text))))
    except FormatError:
        return quick, None


@pytest.mark.parametrize("text", [*(file.read_text() for file in POLYGONS), json.dumps(RICH)])
def test_a_scene_without_faults_is_read_at_once(text: str) -> None:
    quick, checked = both(text)
    assert quick is not None and quick == checked
    assert repr(quick.check) == repr(checked.check) and repr(quick.reading) == repr(checked.reading)


@pytest.mark.slow
def test_whatever_is_changed_both_say_the_same() -> None:
    rng, kept = random.Random(3), 0
    for _ in range(600):
        data = deepcopy(RICH)
        around, step = place_in(data, rng, 0.3)
        if rng.random() < 0.2:
            del around[step]
        elif rng.random() < 0.1 and isinstance(around, dict):
            around["other"] = 1
        else:
            around[step] = rng.choice(ODD)
        quick, checked = both(json.dumps(data))
        assert quick == checked and (quick is None or quick.reading == checked.reading), json.dumps(data)  # type: ignore[union-attr]
        kept += quick is not None
    assert 40 < kept < 560


def test_numbers_of_polygons_are_not_kept_while_others_are_read() -> None:
    rings = [[[9 * k + 0.1, 0.2], [9 * k + 1.3, 0.4], [9 * k + 0.5, 1.6], [9 * k + 0.7, 0.8]] for k in range(500)]
    text = json.dumps({"robot": rings[0], "obstacles": [{"outer": ring} for ring in rings]})
    scene_from_text("scene.json", text)
    tracemalloc.start()
    kept = scene_from_text("scene.json", text)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert len(kept.obstacles) == 500 and peak < 2000 * 150  # two numbers as written, in a list, take 200 bytes
