"""Boundary files among rounded shapes: round trips, their version, and one clear error for everything else."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cfree
from cfree import FormatError, Scene, boundary, free_space, load, save
from cfree.forbidden.boundary import Boundary
from cfree.formats.boundaries.header import signed
from rounded_scenes import MIXED, SCENES, SQUARE, disc, grown, random_scene


def version_of(path: Path) -> int:
    with np.load(path) as archive:
        version: int = json.loads(archive["header"].tobytes())["version"]
        return version


def rewritten(path: Path, target: Path, header: dict[str, Any] | None = None, **columns: Any) -> Path:
    """The same file with other columns, and a digest that fits."""
    with np.load(path) as archive:
        arrays = {key: archive[key] for key in archive.files if key != "header"} | columns
        head = json.loads(archive["header"].tobytes()) | (header or {})
    text = json.dumps(signed(head, arrays)).encode()
    np.savez_compressed(target, header=np.frombuffer(text, np.uint8), **arrays)
    return target


@pytest.fixture(scope="module")
def result() -> Boundary:
    return boundary(MIXED, threads=1)


@pytest.fixture(scope="module")
def saved(result: Boundary, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("saved") / "boundary.npz"
    save(result, path)
    return path


def check_round_trip(scene: Scene, folder: Path) -> None:
    first = boundary(scene, threads=1)
    save(first, folder / "a.npz")
    again = load(folder / "a.npz")
    assert again == first and again.scene == scene
    assert list(again.patches) == list(first.patches)
    assert np.array_equal(first.slice(0.3).segments, again.slice(0.3).segments)
    save(again, folder / "b.npz")
    assert (folder / "a.npz").read_bytes() == (folder / "b.npz").read_bytes()
    space = free_space(first)
    save(space, folder / "c.npz")
    assert load(folder / "c.npz") == space


@pytest.mark.slow
@pytest.mark.parametrize("scene", [*SCENES.values(), *map(random_scene, range(1, 6))], ids=str)
def test_saving_and_loading_rounded_boundaries_changes_nothing(scene: Scene, tmp_path: Path) -> None:
    check_round_trip(scene, tmp_path)


def test_bounds_and_workspaces_are_kept(tmp_path: Path) -> None:
    room = [(-4, -4), (6, -4), (6, 6), (-4, 6)]
    check_round_trip(Scene(disc(0, 0, "1/3"), [grown(SQUARE, "1/4")], bounds=(-3, -3, 5, 5), workspace=room), tmp_path)


def test_files_of_polygons_keep_their_version(saved: Path, tmp_path: Path) -> None:
    save(boundary(Scene(SQUARE, [[(3, 0), (5, 1), (3, 2)]])), tmp_path / "polygons.npz")
    assert (version_of(saved), version_of(tmp_path / "polygons.npz")) == (4, 3)


def test_a_version_that_does_not_fit_the_scene_is_refused(saved: Path, tmp_path: Path) -> None:
    save(boundary(Scene(SQUARE, [[(3, 0), (5, 1), (3, 2)]])), tmp_path / "polygons.npz")
    for path, version, shapes in ((saved, 3, "round shapes"), (tmp_path / "polygons.npz", 4, "polygons")):
        with pytest.raises(FormatError, match=f"version {version}, but the scene has {shapes}"):
            load(rewritten(path, tmp_path / "x.npz", {"version": version}))
    with pytest.raises(FormatError, match="version 5; this cfree reads versions 3 and 4"):
        load(rewritten(saved, tmp_path / "x.npz", {"version": 5}))


@pytest.mark.slow
def test_other_columns_than_the_scenes_are_refused(saved: Path, result: Boundary, tmp_path: Path) -> None:
    table = result.trapezoids
    upper = np.array(table.upper)
    upper[3] ^= np.uint64(1 << 59)
    kind = np.array(result.contact_kind)
    kind[kind & 15 == 3] ^= 16
    low = np.array(table.to_lo)
    low[0] = -0.5
    for name, column in (("upper", upper), ("contact_kind", kind), ("to_lo", low), ("chart", 1 - table.chart)):
        with pytest.raises(FormatError, match=f"{name} does not fit the rest"):
            load(rewritten(saved, tmp_path / "x.npz", **{name: column}))
    kind = np.array(result.contact_kind)
    kind[0] = 7
    with pytest.raises(FormatError, match="contact_kind does not fit"):
        load(rewritten(saved, tmp_path / "x.npz", contact_kind=kind))


def test_a_scene_without_rounded_shapes_is_refused(saved: Path, tmp_path: Path) -> None:
    oval = '{"robot": [[0, 0], [1, 0], [0, 1]], "obstacles": [{"ellipse": {"center": [3, 3], "radii": [2, 1]}}]}'
    with pytest.raises(FormatError, match="obstacle 0: not bounded by lines and arcs"):
        load(rewritten(saved, tmp_path / "x.npz", scene=np.frombuffer(oval.encode(), np.uint8)))


def test_incomplete_rounded_boundaries_are_saved(tmp_path: Path) -> None:
    many = Scene(grown(SQUARE, 1), [grown(SQUARE, "1/3", 3 * k, k % 7) for k in range(300)])
    part = boundary(many, max_seconds=0, threads=1)
    assert not part.complete
    save(part, tmp_path / "part.npz")
    again = load(tmp_path / "part.npz")
    assert again == part
    with pytest.raises(cfree.IncompleteError):
        again.slice(0)


def test_rounded_boundaries_are_written_as_parquet(result: Boundary, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    save(result, tmp_path / "b.parquet")
    table = parquet.read_table(tmp_path / "b.parquet")
    assert table.num_rows == len(result.trapezoids)
    assert set(table["contact_kind"].to_pylist()) == set(result.contact_kind[result.trapezoids.patch].tolist())
