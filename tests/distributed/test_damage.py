"""A finished folder that was damaged: every file in every way. Asked again it is mended; a question names the file."""

from __future__ import annotations

import random
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

import cfree
from cfree.cli.app import app
from cfree.distributed import Sharded, boundary
from cfree.errors import FormatError
from stones import SCENE

SLITS = cfree.load_scene(Path(__file__).parents[2] / "examples" / "scenes" / "degenerate_two_part_robot.json")
SCENES = {"stones": SCENE, "slits": SLITS}
POSES = [(-5, -5, 0), (1, 1, 0), (45, 45, 1), (7, 7, "45deg"), (4, 5, "1/3")]


def flipped(data: bytes, place: float) -> bytes:
    """One bit."""
    k = min(int(place * len(data)), len(data) - 1)
    return data[:k] + bytes([data[k] ^ 1 << random.Random(place).randrange(8)]) + data[k + 1 :]


KINDS: dict[str, Callable[[bytes], bytes] | None] = {
    "missing": None,
    "empty": lambda data: b"",
    "cut": lambda data: data[: len(data) // 2],
    "a byte less": lambda data: data[:-1],
    "a byte more": lambda data: data + b"\0",
    "zeros": lambda data: bytes(len(data)),
    "a bit of the first byte": lambda data: flipped(data, 0),
    "a bit after a third": lambda data: flipped(data, 1 / 3),
    "a bit after two thirds": lambda data: flipped(data, 2 / 3),
    "a bit of the last byte": lambda data: flipped(data, 1),
}
QUESTIONS: dict[str, Callable[[Sharded], Any]] = {
    "plan": lambda found: found.plan((-2.75, -2.75, 0), (-2.75, -2.875, 0), improve=0).goal,
    "is_free": lambda found: found.is_free(POSES).tolist(),
    "locate": lambda found: found.locate(POSES).tolist(),
    "cells": lambda found: found.cells.volume.tolist(),
    "surfaces": lambda found: found.surfaces.faces.tolist(),
    "tiles": lambda found: [found.tile(k)["start"].tolist() for k in range(found.tiles)],
    "digest": lambda found: found.digest,
}


@pytest.fixture(scope="module", params=SCENES)
def made(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Sharded]:
    folder = tmp_path_factory.mktemp("sound") / "city"
    return request.param, boundary(SCENES[request.param], folder=folder, tiles=3)


def files_of(folder: Path) -> list[Path]:
    return sorted(path.relative_to(folder) for path in folder.rglob("*") if path.is_file())


def damage(path: Path, kind: str) -> bool:
    """True if the file is another one now; an empty one cannot be cut."""
    change, before = KINDS[kind], path.read_bytes()
    if change is None:
        path.unlink()
        return True
    if before:
        path.write_bytes(change(before))
    return bool(before) and path.read_bytes() != before


def answers(folder: Path) -> dict[str, Any]:
    return {name: ask(Sharded(folder)) for name, ask in QUESTIONS.items()}


def check_damage(name: str, sound: Sharded, file: Path, kind: str, folder: Path) -> None:
    shutil.copytree(sound.folder, folder)
    if not damage(folder / file, kind):
        return
    expected = answers(sound.folder)
    for question, ask in QUESTIONS.items():
        try:
            assert ask(Sharded(folder)) == expected[question], question  # a file that it does not need
        except FormatError as error:
            text = str(error)
            assert "\n" not in text and "cfree boundary SCENE --folder" in text
            assert str(folder / file) in text or file.name == "manifest.json"
    assert boundary(SCENES[name], folder=folder, tiles=3) == sound
    assert files_of(folder) == files_of(sound.folder)
    assert answers(folder) == expected
    if file.suffix not in (".npz", ".json"):  # some bits of an archive mean nothing, nor does the last line end
        assert (folder / file).read_bytes() == (sound.folder / file).read_bytes()


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
def test_every_damaged_file_is_mended_by_asking_again(kind: str, made: tuple[str, Sharded], tmp_path: Path) -> None:
    name, sound = made
    for number, file in enumerate(files_of(sound.folder)):
        check_damage(name, sound, file, kind, tmp_path / str(number))


@pytest.mark.parametrize("file", ["manifest.json", "scene/box.bin", "trim/000001.npz"])
def test_a_damaged_file_is_mended_by_asking_again(file: str, tmp_path: Path) -> None:
    sound = boundary(SLITS, folder=tmp_path / "sound", tiles=3)
    check_damage("slits", sound, Path(file), "a bit after a third", tmp_path / "damaged")


def test_what_is_sound_is_not_made_again(tmp_path: Path) -> None:
    sound = boundary(SCENE, folder=tmp_path, tiles=3)
    before = {file: (tmp_path / file).stat().st_mtime_ns for file in files_of(tmp_path)}
    (tmp_path / "glue" / "000001.npz").unlink()
    assert boundary(SCENE, folder=tmp_path, tiles=3) == sound
    after = {file: (tmp_path / file).stat().st_mtime_ns for file in files_of(tmp_path)}
    assert [str(file) for file in before if before[file] != after[file]] == ["glue/000001.npz"]


@pytest.mark.slow
def test_folders_without_half_of_their_files_are_mended(tmp_path: Path, made: tuple[str, Sharded]) -> None:
    name, sound = made
    for seed in range(6):
        folder = tmp_path / str(seed)
        shutil.copytree(sound.folder, folder)
        rng = random.Random(seed)
        kept = rng.choice(["source.json", "plan.json", "manifest.json", "scene/facts.json"])  # tells whose it is
        for file in files_of(folder):
            if str(file) != kept and rng.random() < 0.5:
                damage(folder / file, rng.choice([*KINDS]))
        assert boundary(SCENES[name], folder=folder, tiles=3) == sound
        assert answers(folder) == answers(sound.folder)


def test_damage_after_a_question_is_noticed_by_the_next(tmp_path: Path) -> None:
    found = boundary(SCENE, folder=tmp_path, tiles=3)
    assert not found.is_free((1, 1, 0))
    (tmp_path / "scene" / "box.bin").write_bytes(b"")
    with pytest.raises(FormatError, match=r"box\.bin: damaged; compute the boundary into this folder again"):
        found.is_free((1, 1, 0))
    assert not boundary(SCENE, folder=tmp_path, tiles=3).is_free((1, 1, 0))


def test_a_folder_that_tells_nothing_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "source.json").write_text("{}")
    with pytest.raises(FormatError, match="no file tells that it is of this scene; give another, or delete it"):
        boundary(SCENE, folder=tmp_path)
    assert (tmp_path / "source.json").read_text() == "{}"


def test_a_damaged_folder_is_one_line_of_the_command(tmp_path: Path) -> None:
    boundary(SCENE, folder=tmp_path, tiles=3)
    (tmp_path / "manifest.json").write_bytes(b"")
    for words in (["plan", tmp_path], ["verify", tmp_path]):
        result = CliRunner().invoke(app, [str(word) for word in words])
        assert result.exit_code == 2 and result.stderr.count("\n") == 1
        assert "manifest.json: damaged; compute the boundary into this folder again" in result.stderr


def test_verify_finds_damaged_shards_of_every_stage(tmp_path: Path) -> None:
    sound = boundary(SLITS, folder=tmp_path / "sound", tiles=2)
    for name in ("trim/000000.npz", "glue/000001.npz", "regular/000000.npz", "cells.npz"):
        folder = tmp_path / name.replace("/", "-")
        shutil.copytree(sound.folder, folder)
        damage(folder / name, "cut")
        result = Sharded(folder).verify(sample=1)
        assert [finding.text for finding in result.findings if f"{name}: damaged" in finding.text], name
