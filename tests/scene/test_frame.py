"""The name of the world's frame, from a map to an answer."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import cfree
import drawings
from cfree.scene.frame import frame_of


@pytest.fixture
def room(tmp_path: Path) -> cfree.formats.Shapes:
    grey = [[0] * 9, *([[0, 254, 254, 254, 254, 254, 254, 254, 0]] * 4), [0] * 9]
    (tmp_path / "m.png").write_bytes(drawings.png(grey))
    (tmp_path / "m.yaml").write_text("image: m.png\nresolution: 1\norigin: [0, 0, 0]\nfree_thresh: 0.196\n")
    return cfree.load_shapes(tmp_path / "m.yaml")


@pytest.mark.parametrize(
    "robot", [[(0, 0), (1, 0), (0, 1)], cfree.Curved.circle((0, 0), "1/2")], ids=["polygon", "disc"]
)
def test_the_frame_of_a_map_is_that_of_its_answers(room: cfree.formats.Shapes, robot: Any, tmp_path: Path) -> None:
    scene = room.scene(robot)
    assert frame_of(scene) == "map"
    path = cfree.plan(scene, (2, 2, 0), (6, 3, 0))
    assert isinstance(path, cfree.Path)
    assert path.frame == "map"
    cfree.save(path, tmp_path / "path.json")
    assert json.loads((tmp_path / "path.json").read_text())["frame"] == "map"
    cfree.save(path, tmp_path / "path.yaml")
    assert 'frame_id: "map"' in (tmp_path / "path.yaml").read_text()


def test_the_frame_of_a_map_is_that_of_its_proofs(room: cfree.formats.Shapes) -> None:
    scene = room.scene([(0, 0), (1, 0), (0, 1)])
    walled = cfree.Scene(
        scene.robot,
        [*scene.obstacles, [(4, 0), (5, 0), (5, 6), (4, 6)]],
        workspace=scene.workspace,
        source=scene.source,
    )
    proof = cfree.plan(walled, (2, 2, 0), (6, 3, 0))
    assert isinstance(proof, cfree.Separated)
    assert proof.frame == "map"


def test_other_scenes_are_in_the_frame_world() -> None:
    assert frame_of(cfree.Scene([(0, 0), (1, 0), (0, 1)])) == "world"
