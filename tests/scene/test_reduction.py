"""The smallest scene of a fault, and who raises it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

import cfree.forbidden.boundary as forbidden
from cfree import InvariantError, Scene, boundary, save
from cfree.cli.app import app
from cfree.formats.scene_file import scene_from_text
from cfree.scene.reduction import smallest_scene
from compared import scene_of
from shapes import PlainScene, box, frame, random_scene


def test_what_does_not_matter_is_left_out() -> None:
    plain = PlainScene([box(0, 0, 1, 1), box(2, 0, 3, 1)], [frame(), box(9, 9, 10, 10)], bounds=(-9, -9, 20, 20))
    scene = scene_of(plain._replace(workspace=box(-20, -20, 30, 30)))
    smallest = smallest_scene(scene, lambda s: any(len(p.ring_offsets) == 3 for p in s.obstacles))  # a hole
    assert [len(p) for p in smallest.robot] == [3]
    assert [len(p) for p in smallest.obstacles] == [7]  # a square with a triangular hole
    assert smallest.bounds is None and smallest.workspace is None


def test_a_scene_that_is_already_smallest_stays() -> None:
    scene = Scene([(0, 0), (1, 0), (0, 1)])
    assert smallest_scene(scene, lambda s: True) == scene


@pytest.mark.parametrize("place", ["_computed", "glue"])
def test_a_contradiction_is_reported_with_its_smallest_scene(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, place: str
) -> None:
    original = getattr(forbidden, place)

    def broken(about: Any, *arguments: Any, **options: Any) -> Any:
        scene = about if isinstance(about, Scene) else about.scene
        if len(scene.obstacles) > 1:  # stands for a contradiction in the core
            raise InvariantError("no sample decides", state=scene)
        return original(about, *arguments, **options)

    monkeypatch.setattr(forbidden, place, broken)
    scene = scene_of(random_scene(4, "nonconvex"))
    with pytest.raises(InvariantError, match="no sample decides") as raised:
        boundary(scene).complex  # noqa: B018
    assert raised.value.state == scene

    save(scene, tmp_path / "scene.json")
    result = CliRunner().invoke(app, ["boundary", str(tmp_path / "scene.json"), "--mesh", str(tmp_path / "mesh.ply")])
    assert result.exit_code == 4 and "please report" in result.stderr
    printed = scene_from_text("printed", result.stderr.split("with this scene:\n")[1])
    assert len(printed.obstacles) == 2
