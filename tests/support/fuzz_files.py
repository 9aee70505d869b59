"""Use files with flipped bits and right checksums: refused, or used without a crash or a hang.

Three in four are of boundaries and cells, the others answers and scenes.

    python tests/support/fuzz_files.py --seconds 600 --seed 7

File k is the same for ever. Results other than answers and errors of cfree are shown; the last line counts all.
"""

from __future__ import annotations

import argparse
import json
import random
import sys
import tempfile
import time
import traceback
from collections import Counter
from functools import cache
from itertools import count
from pathlib import Path as FilePath
from typing import Any

import numpy as np

import cfree.verify
import fuzz
from answers import corridor, tee, text_of
from cfree import FreeSpace, Pose, Scene, boundary, free_space, load_scene, plan, save
from cfree.errors import CfreeError
from cfree.formats.boundaries.boundary_file import load_boundary, load_space, signed
from cfree.formats.scene_file import scene_text
from cfree.geometry.integrals import trapezoid_areas
from compared import scene_of
from shapes import PlainScene, box
from workers import Lost, Worker

PATIENCE = 60.0  # seconds for all that is done with one file
KINDS = ("boxes", "corridor", "chain", "fit")
SCENES = 12  # scenes that have files


@cache
def saved(number: int) -> dict[str, Any]:
    """The arrays of a small scene's boundary, with its cells."""
    scene = scene_of(_plain(number))
    with tempfile.TemporaryDirectory() as folder:
        save(free_space(boundary(scene, threads=1)), f"{folder}/cells.npz")
        with np.load(f"{folder}/cells.npz") as archive:
            return dict(archive)


def _plain(number: int) -> PlainScene:
    for k in count(1000 * number):
        plain = fuzz.scene(KINDS[number % len(KINDS)], k)
        try:
            scene_of(plain)
        except ValueError:
            continue
        return plain
    raise AssertionError


def damaged(rng: random.Random) -> tuple[str, dict[str, Any]]:
    """Damage a column by one to three flipped bits, or cut or lengthen it; return its name, and all columns."""
    arrays = dict(saved(rng.randrange(SCENES)))
    name = rng.choice([key for key, array in arrays.items() if array.size])
    array = arrays[name].copy()
    if rng.random() < 0.05:
        arrays[name] = array[:-1] if rng.random() < 0.5 else np.concatenate([array, array[-1:]])
        return name, arrays
    flat = array.view(np.uint8).reshape(-1)
    for _ in range(rng.randint(1, 3)):
        flat[rng.randrange(flat.size)] ^= 1 << rng.randrange(8)
    if array.dtype == bool:
        array = (array.view(np.uint8) & 1).astype(bool)
    arrays[name] = array
    return name, arrays


def sealed(arrays: dict[str, Any]) -> dict[str, Any]:
    """Columns with the matching digest, if the header can be read."""
    try:
        header = json.loads(arrays["header"].tobytes())
        header = signed(header, {name: array for name, array in arrays.items() if name != "header"})
    except (ValueError, AttributeError):
        return arrays
    return arrays | {"header": np.frombuffer(json.dumps(header).encode(), np.uint8)}


@cache
def texts() -> list[tuple[str, Scene, bytes]]:
    """Files of answers and of scenes: their kind, the scene, the bytes."""
    closed = scene_of(PlainScene([box(0, 0, 1, 2)], [box(0, -3, 1, 9)], bounds=(-9, -2, 9, 5)))
    start, goal = Pose(-5, 0), Pose(5, 0)
    pairs: list[tuple[Scene, Any]] = [corridor(), tee(), (closed, plan(closed, start, goal, improve=0))]
    answers = [("answer", scene, text_of(answer).encode()) for scene, answer in pairs]
    return [*answers, *(("scene", scene, scene_text(scene).encode()) for scene, _ in pairs)]


def used(number: int) -> tuple[str, str, str]:
    """Column of a damaged file, or its kind, the result of using it, and its fault."""
    rng = random.Random(f"file {number}")
    with tempfile.TemporaryDirectory() as folder:
        file = FilePath(folder) / ("damaged.json" if number % 4 == 3 else "damaged.npz")
        if number % 4 == 3:
            column, scene, text = rng.choice(texts())
            flipped = bytearray(text)
            for _ in range(rng.randint(1, 3)):
                flipped[rng.randrange(len(flipped))] ^= 1 << rng.randrange(7)
            file.write_bytes(flipped)
        else:
            column, arrays = damaged(rng)
            with file.open("wb") as stream:
                np.savez(stream, **sealed(arrays))
        try:
            if column == "answer":
                return column, "verified" if cfree.verify.answer(scene, file).verified else "rejected", ""
            return column, _scene(file) if number % 4 == 3 else _everything(file, rng), ""
        except CfreeError as error:
            return column, type(error).__name__, ""
        except Exception as error:
            return column, type(error).__name__, traceback.format_exc()


def _everything(file: FilePath, rng: random.Random) -> str:
    """Ask questions of all kinds to a file."""
    stored = load_boundary(file)
    taus = [rng.choice([0, 1, None, "1/3", "-7/5"]) for _ in range(2)]
    ask = {
        "slice": lambda: [stored.slice({"tau": tau}).forbidden for tau in taus],
        "cells": lambda: stored.complex.euler,
        "areas": lambda: trapezoid_areas(stored),
        "verify": lambda: cfree.verify.boundary(stored, slices=2),
        "space": lambda: _space(load_space(file)),
        "glued": lambda: _space(free_space(stored)),
    }
    names = rng.sample(list(ask), 3)
    for name in names:
        ask[name]()
    return "answers"


def _scene(file: FilePath) -> str:
    scene = load_scene(file)
    if scene.start and scene.goal:
        plan(scene, improve=0, max_seconds=5)
    return "answers"


def _space(space: FreeSpace) -> None:
    poses = [Pose(x, y, {"tau": tau}) for x, y, tau in ((0, 0, 0), (30, 30, 1), (1, 2, None), (3, 1, "1/3"))]
    cells = space.locate(poses).tolist()
    free = [pose for pose, cell in zip(poses, cells, strict=True) if cell >= 0]
    if len(free) > 1:
        plan(space, free[0], free[1], improve=0)
    assert all(cell.theta_range for cell in space.cells)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=600)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    end, worker, came, wrong = time.monotonic() + options.seconds, Worker(used, PATIENCE), Counter[str](), set()
    for number in count(options.seed):
        if time.monotonic() > end:
            break
        try:
            column, what, text = worker.ask(number)
        except Lost as error:
            column, what, text = "?", str(error), str(error)
        came[what] += 1
        place = text.strip().splitlines()[-3:] if text else []
        if text and (what, *place[:1]) not in wrong:
            wrong.add((what, *place[:1]))
            print(f"--- file {number}, {column}: {what}", text, sep="\n", flush=True)
    print(f"{sum(came.values()):,} files: {dict(came)}\ngo on with --seed {number}")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
