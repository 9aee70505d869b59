"""Boundary files: round trips, equal bytes, and one clear error for everything else."""

import io
import json
import pickle
import time
import zipfile
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import fuzz_files
from cfree import Boundary, FormatError, InvariantError, boundary, load_scene, save
from cfree.forbidden.columns import COLUMNS
from cfree.formats.answers.answer_file import load_answer
from cfree.formats.boundaries.boundary_file import load_boundary
from cfree.formats.text import findings
from compared import scene_of
from fuzz_files import sealed
from shapes import KINDS, random_scene
from workers import Worker


@pytest.fixture(scope="module")
def result() -> Boundary:
    return boundary(scene_of(random_scene(3, "workspace")), threads=1)


@pytest.fixture(scope="module")
def saved(result: Boundary, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("saved") / "boundary.npz"
    save(result, path)
    return path


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_saving_and_loading_changes_nothing(kind: str, tmp_path: Path) -> None:
    first, path = boundary(scene_of(random_scene(11, kind)), threads=1), tmp_path / "b.npz"
    save(first, path)
    again = load_boundary(path)
    assert again.scene == first.scene
    for column in COLUMNS:
        assert np.array_equal(getattr(first.trapezoids, column), getattr(again.trapezoids, column))
        assert getattr(first.trapezoids, column).dtype == getattr(again.trapezoids, column).dtype
    assert list(first.patches) == list(again.patches)
    for theta in (0.3, 2.0, 3.5, 5.1):
        assert np.array_equal(first.slice(theta).segments, again.slice(theta).segments)
        assert first.slice(theta).forbidden.equals(again.slice(theta).forbidden)
    save(again, tmp_path / "c.npz")
    assert path.read_bytes() == (tmp_path / "c.npz").read_bytes()


def test_equal_boundaries_make_equal_files(result: Boundary, saved: Path, tmp_path: Path) -> None:
    save(boundary(result.scene, threads=2), tmp_path / "b.npz")
    assert saved.read_bytes() == (tmp_path / "b.npz").read_bytes()


def refused(path: Path) -> str:
    start = time.perf_counter()
    with pytest.raises(FormatError) as error:
        load_boundary(path)
    assert time.perf_counter() - start < 1
    assert str(path) in str(error.value)
    assert "\n" not in str(error.value)
    return str(error.value)


def test_truncated_files_are_refused(saved: Path, tmp_path: Path) -> None:
    whole, path = saved.read_bytes(), tmp_path / "cut.npz"
    for size in {*range(0, 64, 7), *range(0, len(whole), len(whole) // 60), len(whole) - 1}:
        path.write_bytes(whole[:size])
        refused(path)


@pytest.mark.slow
def test_damaged_files_are_refused_or_the_same(result: Boundary, saved: Path, tmp_path: Path) -> None:
    whole, path = saved.read_bytes(), tmp_path / "damaged.npz"
    rng = np.random.default_rng(0)
    for place in rng.integers(0, len(whole), 150).tolist():
        path.write_bytes(whole[:place] + bytes([whole[place] ^ 0x55]) + whole[place + 1 :])
        try:
            again = load_boundary(path)
        except FormatError as error:
            assert str(path) in str(error)
            continue
        assert np.array_equal(again.trapezoids.lower, result.trapezoids.lower)


FOREIGN = {
    "empty": b"",
    "text": b"not a boundary\n" * 100,
    "json": b'{"version": 1}',
    "zeros": bytes(10_000),
    "pickle": pickle.dumps({"header": 1}),
    "npy": b"\x93NUMPY\x01\x00",
}


@pytest.mark.parametrize("name", FOREIGN)
def test_foreign_bytes_are_refused(name: str, tmp_path: Path) -> None:
    path = tmp_path / "foreign.npz"
    path.write_bytes(FOREIGN[name])
    refused(path)


def test_pictures_arrays_and_archives_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "foreign.npz"
    Image.new("RGB", (9, 9)).save(path, "PNG")
    refused(path)
    with path.open("wb") as file:
        np.save(file, np.arange(9))
    refused(path)
    with path.open("wb") as file:
        np.savez(file, a=np.arange(9))
    assert "not a boundary" in refused(path)
    with path.open("wb") as file:
        np.savez(file, header=np.array([{"format": "cfree-boundary"}], dtype=object))
    refused(path)


def test_archives_with_other_members_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "foreign.npz"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("header.npy", b"rubbish")
    refused(path)


def changed(saved: Path, path: Path, **arrays: object) -> Path:
    with np.load(saved) as archive:
        kept = {name: archive[name] for name in archive.files}
    kept |= arrays
    kept = sealed({name: array for name, array in kept.items() if array is not None})
    with path.open("wb") as file:
        np.savez(file, **kept)
    return path


def test_other_formats_and_versions_are_named(saved: Path, tmp_path: Path) -> None:
    with np.load(saved) as archive:
        header = json.loads(archive["header"].tobytes())

    def with_header(**values: object) -> Path:
        text = json.dumps(header | values).encode()
        return changed(saved, tmp_path / "other.npz", header=np.frombuffer(text, np.uint8))

    assert "version 99" in refused(with_header(version=99))
    assert "'painting'" in refused(with_header(format="painting"))
    refused(with_header(version=None))
    for text in (b"[]", b"3", b"\xff\xfe", b"{"):
        refused(changed(saved, tmp_path / "other.npz", header=np.frombuffer(text, np.uint8)))


def test_headers_with_other_stats_are_refused(saved: Path, tmp_path: Path) -> None:
    with np.load(saved) as archive:
        header = json.loads(archive["header"].tobytes())
    for stats in ({"rubbish": 1}, None):
        text = json.dumps(header | {"stats": stats}).encode()
        refused(changed(saved, tmp_path / "other.npz", header=np.frombuffer(text, np.uint8)))


@pytest.mark.parametrize("name", ["scene", "patch", "lower", "to_hi", "contact_kind"])
def test_a_missing_array_is_an_error(saved: Path, tmp_path: Path, name: str) -> None:
    refused(changed(saved, tmp_path / "less.npz", **{name: None}))


def test_a_scene_that_is_none_is_an_error(saved: Path, tmp_path: Path) -> None:
    path = changed(saved, tmp_path / "wrong.npz", scene=np.frombuffer(b'{"robot": []}', np.uint8))
    with pytest.raises(FormatError, match=r"wrong\.npz"):
        load_boundary(path)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("patch", np.array([10**6], np.int32)),
        ("patch", np.zeros(3)),
        ("lower", np.zeros(1, np.uint64)),
        ("contact_kind", np.full(2, 9, np.uint8)),
        ("contact_robot", np.full(5, -7, np.int32)),
        ("to_hi", np.array(["text"])),
    ],
)
def test_arrays_that_do_not_fit_are_an_error(saved: Path, tmp_path: Path, name: str, value: object) -> None:
    refused(changed(saved, tmp_path / "wrong.npz", **{name: value}))


def test_features_out_of_range_are_an_error(saved: Path, tmp_path: Path) -> None:
    with np.load(saved) as archive:
        for name in ("contact_robot", "contact_obstacle", "patch", "lower"):
            array = archive[name].copy()
            array[0] = np.iinfo(array.dtype).max // 2
            refused(changed(saved, tmp_path / "wrong.npz", **{name: array}))


def columns(saved: Path) -> dict[str, np.ndarray]:
    with np.load(saved) as archive:
        return dict(archive)


def test_one_flipped_bit_in_any_column_is_refused(saved: Path, tmp_path: Path) -> None:
    arrays = columns(saved)
    for name in (name for name in arrays if arrays[name].size and name != "header"):
        flipped = arrays[name].copy()
        flipped.view(np.uint8)[flipped.nbytes // 2] ^= 1
        with (tmp_path / "flipped.npz").open("wb") as file:
            np.savez(file, **(arrays | {name: flipped}))
        assert "not what was written" in refused(tmp_path / "flipped.npz")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["from_place", "to_place", "chart"])
def test_angles_that_are_none_are_refused(saved: Path, tmp_path: Path, name: str) -> None:
    # gluing would look for them for ever
    array, bit = columns(saved)[name], 1 if name == "chart" else 2
    accepted = 0
    for k in range(0, len(array), len(array) // 9):
        wrong = array.copy()
        wrong[k] ^= bit
        try:
            assert load_boundary(changed(saved, tmp_path / "wrong.npz", **{name: wrong})).complex
            accepted += 1
        except FormatError as error:
            assert f"trapezoid {k} does not fit" in str(error)
        except InvariantError:  # one that can be, but is not of this boundary
            assert name == "chart"
    assert accepted == 0


def test_curves_in_the_wrong_order_are_refused(saved: Path, tmp_path: Path) -> None:
    arrays = columns(saved)
    lower, upper = arrays["lower"].copy(), arrays["upper"].copy()
    lower[5], upper[5] = upper[5], lower[5]
    assert "trapezoid 5 does not fit" in refused(changed(saved, tmp_path / "wrong.npz", lower=lower, upper=upper))


@pytest.mark.slow
def test_files_with_flipped_bits_and_right_digests_end(tmp_path: Path) -> None:
    worker = Worker(fuzz_files.used, 60.0)
    came = Counter(worker.ask(number)[1] for number in range(60))
    refusals = {"FormatError", "InvalidFileError", "rejected"}
    assert sum(came[name] for name in refusals) > 30
    assert set(came) <= {*refusals, "IncompleteError", "InvariantError", "answers", "verified"}


@pytest.mark.parametrize("shape", ["(200000000000,)", "(-1,)", "(3, 70000000000)"])
def test_headers_that_claim_more_than_there_is_are_refused(saved: Path, tmp_path: Path, shape: str) -> None:
    head = f"{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}".ljust(117) + "\n"
    with zipfile.ZipFile(saved) as archive, zipfile.ZipFile(tmp_path / "claims.npz", "w") as other:
        for name in archive.namelist():
            data = archive.read(name)
            other.writestr(name, b"\x93NUMPY\x01\x00v\x00" + head.encode() + bytes(80) if name == "to_lo.npy" else data)
    refused(tmp_path / "claims.npz")


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="no file without end")
def test_a_file_without_end_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(findings, "LARGEST", 1 << 20)
    refused(Path("/dev/zero"))
    for load in (load_scene, load_answer):
        with pytest.raises(FormatError, match="/dev/zero: more than 1 MiB"):
            load("/dev/zero")


def test_missing_files_and_folders_are_named(tmp_path: Path) -> None:
    refused(tmp_path / "nothing.npz")
    refused(tmp_path)


def test_a_failed_save_leaves_the_old_file(result: Boundary, saved: Path, tmp_path: Path) -> None:
    old = tmp_path / "old.npz"
    old.write_bytes(b"old")
    with pytest.raises(OSError, match=r"old\.npz"):
        save(result, old / "b.npz")
    assert old.read_bytes() == b"old"
    save(result, old)
    assert old.read_bytes() == saved.read_bytes()
    assert [file.name for file in tmp_path.iterdir()] == ["old.npz"]


def test_numpy_reads_the_file_without_pickle(saved: Path) -> None:
    with np.load(io.BytesIO(saved.read_bytes()), allow_pickle=False) as archive:
        assert set(COLUMNS) <= set(archive.files)
        assert json.loads(archive["header"].tobytes())["format"] == "cfree-boundary"
