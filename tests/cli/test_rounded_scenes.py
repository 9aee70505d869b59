"""Commands among rounded shapes: exact boundaries, slices and meshes; polygons only for other curves."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
import trimesh
from click.testing import CliRunner

import cfree
from arc_rings import BAY, plate, shape
from cfree.cli.app import app
from cfree.cli.describe import expected_patches
from cfree.forbidden.kinds import KINDS
from cfree.scene.features import grown_features
from cfree.scene.scene import with_ends
from rounded_scenes import MIXED, SCENES, disc, stadium

OVAL = '{"ellipse": {"center": [3, 3], "radii": [2, 1]}}'
DISC = '{"circle": {"center": [0, 0], "radius": "1/2"}}'
OTHER = '{"circle": {"center": [7, 0], "radius": "1/4"}}'


def run(*arguments: object) -> Any:
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def facts(*arguments: object) -> Any:
    result = run(*arguments, "--json")
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)


@pytest.fixture
def discs(tmp_path: Path) -> Path:
    path = tmp_path / "discs.json"
    scene = cfree.Scene(disc(0, 0, 1), [disc(4, 0, 1), stadium(4, 6, 2)], start=(0, 3, 0), goal=(12, 3, 0))
    cfree.save(scene, path)
    return path


@pytest.fixture
def oval(tmp_path: Path) -> Path:
    path = tmp_path / "oval.json"
    path.write_text(f'{{"robot": {DISC}, "obstacles": [{OVAL}, {OTHER}]}}')
    return path


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_boundary_does_not_replace_rounded_shapes(name: str, tmp_path: Path) -> None:
    cfree.save(SCENES[name], tmp_path / "scene.json")
    found = facts("boundary", tmp_path / "scene.json")
    expected = cfree.boundary(SCENES[name]).stats
    assert (found["patches"], found["trapezoids"]) == (expected.patches, expected.trapezoids)
    assert (found["reading"], found["isolated"]) == ([], len(cfree.boundary(SCENES[name]).isolated))
    rounds = sum(isinstance(x, cfree.Curved) for x in (*SCENES[name].robot, *SCENES[name].obstacles))
    assert found["round"] == rounds
    text = " ".join(run("boundary", tmp_path / "scene.json").stdout.split())
    assert f"round shapes, exact {rounds} " in text and "isolated parts (exact fits)" in text


@pytest.mark.slow
def test_boundary_writes_exact_files_meshes_and_pictures(discs: Path, tmp_path: Path) -> None:
    names = [tmp_path / f"a.{suffix}" for suffix in ("npz", "glb", "png")]
    result = run("boundary", discs, "-o", names[0], "--mesh", names[1], "--picture", names[2], "--error", "0.05")
    assert result.exit_code == 0, result.output
    assert cfree.load(names[0]) == cfree.boundary(cfree.load_scene(discs))
    assert names[2].stat().st_size > 10_000
    for suffix in ("glb", "ply", "obj", "stl"):
        assert run("boundary", names[0], "--mesh", tmp_path / f"b.{suffix}", "--error", "0.05").exit_code == 0
        shape: Any = trimesh.load(tmp_path / f"b.{suffix}")
        parts = shape.geometry.values() if suffix == "glb" else [shape]
        assert sum(len(part.faces) for part in parts) > 100


def test_only_other_curves_become_polygons(oval: Path) -> None:
    found = facts("boundary", oval)
    (note,) = found["reading"]
    assert (found["round"], note["what"], note["count"]) == (2, "polygon around a round shape", 1)
    finer = facts("boundary", oval, "--tolerance", "1e-4")
    assert finer["reading"][0]["size"] == 1e-4 and finer["patches"] > found["patches"]


def test_parts_of_several_radii_are_exact(tmp_path: Path) -> None:
    path = tmp_path / "parts.json"
    path.write_text(f'{{"robot": [{DISC}, {OTHER}], "obstacles": [{OTHER}]}}')
    found = facts("boundary", path)
    assert found["round"] == 3 and not found["reading"]


@pytest.mark.slow
def test_a_slice_has_arcs(discs: Path, tmp_path: Path) -> None:
    found = facts("slice", discs, "--theta", "30deg", "-o", tmp_path / "s.geojson", "--picture", tmp_path / "s.png")
    assert math.isclose(found["length arc-arc"], 2 * math.tau * 2) and math.isclose(found["length e-v"], 0)
    assert math.isclose(found["length v-e"], 4)
    assert math.isclose(found["forbidden area"], 2 * 4 * math.pi + 2 * 4, rel_tol=1e-4)
    region, *contacts = json.loads((tmp_path / "s.geojson").read_text())["features"]
    assert 0 < region["properties"]["error"] == found["chords of arcs within"] < 1e-3
    assert {contact["properties"]["kind"] for contact in contacts} == {"v-e", "arc-arc"}


def test_check_counts_the_patches_of_the_exact_boundary(discs: Path, oval: Path) -> None:
    found = facts("check", discs)
    assert (found["round"], found["exact"], found["obstacles"]["vertices"]) == (3, 3, 3)
    text = " ".join(run("check", discs).stdout.split())
    assert "14 contact patches before trimming: 2 v-e, 0 e-v, 12 arc-arc" in text
    assert "3 shapes: 3 exact, counted as cores" in text
    text = " ".join(run("check", oval).stdout.split())
    assert "3 shapes: 2 exact, counted as cores; 1 counted as polygons around them" in text


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_expected_patches_are_those_of_the_boundary(name: str) -> None:
    scene = SCENES[name]
    expected = expected_patches(scene, grown_features(scene))
    kinds = cfree.boundary(scene).patch_kind.tolist()
    assert expected == {text: kinds.count(kind) for kind, text in KINDS.items()} | {"total": len(kinds)}


@pytest.mark.slow
def test_expected_patches_of_concave_arcs_are_those_of_the_boundary() -> None:
    robot = cfree.Curved([(0, 0), (2, 0), (0, 1)], grown="1/4")
    for scene in (cfree.Scene(robot, [shape(BAY), plate(14, 0)]), cfree.Scene([plate()], [robot, disc(9, 0, 4)])):
        kinds = cfree.boundary(scene).patch_kind.tolist()
        assert expected_patches(scene, grown_features(scene))["total"] == len(kinds)


def test_verify_takes_exact_boundaries_and_older_ones_of_polygons(discs: Path, tmp_path: Path) -> None:
    exact, older = tmp_path / "exact.npz", tmp_path / "older.npz"
    assert run("boundary", discs, "-o", exact).exit_code == 0
    from cfree.formats.conversion import straightened

    cfree.save(cfree.boundary(straightened(cfree.load_scene(discs), 0.2)[0]), older)
    assert run("verify", discs, exact, "--slices", "2").exit_code == 0
    assert run("verify", discs, older, "--slices", "0", "--sample", "10", "--tolerance", "0.2").exit_code == 0


def test_plan_takes_an_exact_boundary(discs: Path, tmp_path: Path) -> None:
    assert run("boundary", discs, "-o", tmp_path / "a.npz").exit_code == 0
    assert facts("plan", tmp_path / "a.npz")["answer"] == facts("plan", discs)["answer"]


def test_a_film_of_a_separation_takes_no_other_curves(oval: Path, tmp_path: Path) -> None:
    scene = cfree.load_scene(oval)
    cfree.save(with_ends(scene, cfree.Pose(0, 0), cfree.Pose(9, 9)), oval)
    for options in ((), ("--tolerance", "0.01")):
        result = run("film", oval, "-o", tmp_path / "a.gif", "--storyboard", "separation", *options)
        assert result.exit_code == 2
        (line,) = result.stderr.splitlines()
        assert "obstacle 0: not bounded by lines and arcs" in line and "cfree convert --inner" in line


@pytest.mark.slow
def test_proofs_among_round_shapes_are_filmed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By the shapes' own surface, where a gap is closed by a hair, and by polygons inside them; to a place as well."""
    shown: list[tuple[Any, Any]] = []

    def seen(answer: Any, found: Any, file: Path, **_: Any) -> None:
        shown.append((answer, found))
        file.touch()

    monkeypatch.setattr("cfree.film.film_separation", seen)
    scene, answer, film = tmp_path / "scene.json", tmp_path / "answer.json", tmp_path / "a.gif"
    hall = [(0, 0), (12, 0), (12, 6), (0, 6)]
    for hair, goal in ((Fraction(1, 2**60), "10,3,0"), (Fraction(1, 2), "10,3")):
        posts = [disc(6, 3 + sign * (Fraction(3, 2) - hair), Fraction(1, 2)) for sign in (-1, 1)]
        closed = cfree.Scene(disc(0, 0, 1), posts, workspace=hall, start=(2, 3, 0))
        cfree.save(closed, scene)
        assert run("plan", scene, "--goal", goal, "-o", answer, "--film", film).exit_code == 1
        assert run("film", scene, answer, "-o", film).exit_code == 0
        (first, found), (second, again) = shown[-2:]
        assert first == second and (first.rounded is not None) == (hair < 1e-9)
        assert found.scene == again.scene == closed


def test_rounded_scenes_of_files_have_their_shapes(tmp_path: Path) -> None:
    cfree.save(MIXED, tmp_path / "scene.json")
    assert cfree.load_scene(tmp_path / "scene.json") == MIXED
