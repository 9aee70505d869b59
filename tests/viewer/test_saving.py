"""What the page saves is read by the package, and by others."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

import cfree
from cfree import view
from cfree.cli.app import app
from pages import Tried

ROOT = Path(__file__).parents[2]
PLACES = {
    "paper_fig9": ROOT / "examples/scenes",
    "peg_in_hole": ROOT / "viewer/gallery",
    "caged_part": ROOT / "viewer/gallery",
    "nest_swim": ROOT / "examples/scenes",
}


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.long] if name == "nest_swim" else []) for name in PLACES]
)
def test_answers_and_scenes_are_verified(browser: Any, tmp_path: Path, name: str) -> None:
    scene = cfree.load_scene(PLACES[name] / f"{name}.json")
    tried = Tried(browser, view(scene, html=tmp_path / "page.html", browser=False))
    tried.ready(name)
    tried.answered()
    said = tried.page.locator("#way").inner_text()
    files = [tried.saved(what, tmp_path / f"{what}.json") for what in ("scene", "answer")]
    tried.close()
    saved = cfree.load_scene(files[0])  # its angles are the page's
    assert (saved.robot, saved.obstacles, saved.bounds, saved.name) == (
        scene.robot,
        scene.obstacles,
        scene.bounds,
        name,
    )
    answer = cfree.load(files[1])
    assert isinstance(answer, cfree.Path) == said.startswith("A motion exists")
    assert (answer.start, answer.goal) == (saved.start, saved.goal)
    verified = CliRunner().invoke(app, ["verify", *map(str, files)])
    assert verified.exit_code == 0, verified.output


@pytest.mark.slow
def test_pictures_and_model(browser: Any, tmp_path: Path) -> None:
    trimesh = pytest.importorskip("trimesh")
    scene = cfree.load_scene(ROOT / "examples/scenes/paper_fig9.json")
    tried = Tried(browser, view(scene, html=tmp_path / "page.html", browser=False))
    tried.ready("paper_fig9")
    tried.say("#way", "A motion exists")
    png, svg, glb = (tried.saved(what, tmp_path / f"boundary.{what}") for what in ("png", "svg", "glb"))
    tried.close()
    pixels = np.asarray(Image.open(png).convert("RGB"))
    halves = np.array_split(pixels, 2, axis=1)
    assert min(len(np.unique(half.reshape(-1, 3), axis=0)) for half in halves) > 100
    root = ElementTree.parse(svg).getroot()
    assert root.tag.endswith("svg") and len(root.findall(".//{*}path")) > 5
    model = trimesh.load(glb, force="mesh")
    radius = max(np.hypot(*vertex) for vertex in scene.robot[0].vertices)
    (x0, y0, z0), (x1, y1, z1) = model.bounds
    assert len(model.faces) > 500 and z1 - z0 == pytest.approx(2 * np.pi * radius, rel=1e-3)
    assert -5.5 < x0 < x1 < 5.5 and -4.5 < y0 < y1 < 4.5
