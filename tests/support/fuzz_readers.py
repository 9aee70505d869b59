"""Check readers with damaged and hostile drawings, maps and footprints: each is read, or refused with one error.

    python tests/support/fuzz_readers.py --count 100000 --seed 7

File k is the same for ever, is read with random options, and may take little processor time and memory. One file in a
thousand is a bomb of `hostile.py`; one in ten goes through ``cfree check`` as well. Faults are crashes, hangs, wrong
errors and notes of a wrong shape; they are shown, and the last lines count all files.
"""

from __future__ import annotations

import argparse
import gzip
import json
import math
import random
import re
import resource
import sys
import tempfile
import time
import traceback
from collections import Counter
from contextlib import suppress
from pathlib import Path
from typing import Any

from click.testing import CliRunner

import drawings
import hostile
from cfree.cli.app import app
from cfree.errors import CfreeError, FormatError
from cfree.formats.scene_file import load_shapes
from cfree.formats.scenes.reading_format import read_notes
from cfree.formats.scenes.reading_text import records
from cfree.formats.shapes import Shapes
from cfree.scene.reading import EFFECTS, KINDS, MOST_ITEMS, MOST_POINTS, Note
from workers import Lost, Worker, limited

PATIENCE = 120.0  # seconds of processor time for one file
MEMORY = 4 << 30  # bytes of address space for all that is done
BOMBS = 1000  # one file in so many is one
MOST = 10_000  # parts of a bomb
COMMANDS = 10  # one file in so many goes through the command
NUMBERS = ["0", "-1", "1e308", "-1e308", "1e400", "nan", "inf", "1e-320", "0.1", "99999999999999999999", ".", "1/3", ""]
TOKENS = ["<", ">", "&a;", "[", "]", "{", "}", '"', "'", "\n", "\0", "*a", "&a ", ": ", "- ", "url(#a)", "ä", "%", "#"]
TOKENS += ["../", "\x1b[2J", "\u2028", "\ufeff", "\ud800"]
ELEMENTS = {".svg": rb"<[^<>]*>", ".urdf": rb"<[^<>]*>", ".dxf": rb"[^\n]*\n[^\n]*\n", ".wkt": rb"[^ ,()]+|[,()]"}
"""Pieces of a file that are swapped, repeated or left out as a whole; words and brackets in files of other kinds."""
OPTIONS: dict[str, list[Any]] = {
    "tolerance": [1e-6, 0.01, 5.0, 1e9],
    "curves": [True, True, True],
    "roles": [{"walls": "ignore"}, {"part": "robot"}, {"lake": "workspace"}, {"robot": "obstacle", "off": "robot"}],
    "units": ["mm", "in", "m", "parsec"],
    "scale": ["1/1000", 25.4, 1e-300, "1e200", 0],
    "join": [0, 1e-6, 0.01, 2.0, 1e9],
    "join_holes": [True],
    "strokes": ["drawn", "drawn", 0.1, 5.0, 1e-9, 1e9, 1e300],
    "repair": [True, True, False],
    "holes": ["nested"],
    "fills": ["hatches"],
    "space": ["Layout1", "model", "\udcff"],
    "language": ["de", ""],
    "min_area": [0.5, 1e9],
    "unknown": ["free"],
    "map_rules": ["nav2", "nav2-old", "ros1"],
    "occupied": [1, 65, 100],
    "free_thresh": [0.0, 0.25, 1.0, math.nan],
    "unknown_grey": [205, 0, 255],
    "despeckle": [2, 50, 10**9],
    "padding": [0.01, 3.0, 1e300],
}
_WORD = re.compile(rb"[\w.+-]+|[^\w\s]")


def file_of(number: int, most: int = MOST) -> tuple[str, bytes, bytes]:
    """Name and content of a file, and of the image beside a map."""
    rng = random.Random(f"reader {number}")
    if number % BOMBS == BOMBS - 1:
        bomb = sorted(hostile.BOMBS)[number // BOMBS % len(hostile.BOMBS)]
        return *hostile.made(bomb, rng, most), hostile.image(rng, round(10 ** rng.uniform(0.5, 6)))
    name, content = rng.choice(sorted(drawings.files().items()))
    image = drawings.PGM.encode() if rng.random() < 0.5 else drawings.png([[0, 254], [205, 0]])
    if name == "map.yaml" and rng.random() < 0.5:
        return name, content, changed(rng, image)
    if name == "b.svgz" and rng.random() < 0.8:
        return name, gzip.compress(changed(rng, gzip.decompress(content), ".svg"), mtime=0), image
    return name, changed(rng, content, Path(name).suffix), image


def changed(rng: random.Random, content: bytes, suffix: str = "") -> bytes:
    """One to four changes: bits, tokens, numbers, pieces left out, repeated or moved, the end cut off."""
    text = bytearray(content)
    for _ in range(rng.choice([1, 1, 2, 4])):
        if not text:
            break
        place = rng.randrange(len(text))
        match rng.randrange(11):
            case 0:
                text[place] ^= 1 << rng.randrange(8)
            case 1:
                if rng.random() < 0.3:
                    del text[place:]
            case 2:
                text[place:place] = rng.choice(TOKENS).encode("utf-8", "surrogatepass")
            case 3 | 4 | 5:
                numbers = [k for k in range(place, min(len(text), place + 200)) if chr(text[k]).isdigit()]
                if numbers:
                    end = numbers[0]
                    while end < len(text) and chr(text[end]).isdigit():
                        end += 1
                    text[numbers[0] : end] = rng.choice(NUMBERS).encode()
            case 6:
                del text[place : place + rng.randint(1, 60)]
            case 7:
                piece = bytes(text[place : place + rng.randint(1, 200)])
                text[place:place] = piece * rng.choice([1, 2, 50])
            case 8:
                other = rng.randrange(len(text))
                text[place:place] = text[other : other + rng.randint(1, 80)]
            case _:
                text = bytearray(rearranged(rng, bytes(text), suffix))
    return bytes(text)


def rearranged(rng: random.Random, content: bytes, suffix: str) -> bytes:
    """Swap, repeat or leave out whole elements, tags or words."""
    pattern = re.compile(ELEMENTS[suffix]) if suffix in ELEMENTS else _WORD
    spans = [match.span() for match in pattern.finditer(content)]
    if len(spans) < 2:
        return content
    (a, b), (c, d) = sorted(rng.sample(spans, 2))
    match rng.randrange(4):
        case 0:
            return content[:a] + content[c:d] + content[b:c] + content[a:b] + content[d:]
        case 1:
            return content[:b] + content[a:b] * rng.choice([1, 2, 30]) + content[b:]
        case 2:
            return content[:c] + content[a:b] + content[d:]
        case _:
            return content[:a] + content[b:]


def options_of(number: int) -> dict[str, Any]:
    """Random options of `load_shapes`; none for every third file."""
    rng = random.Random(f"options {number}")
    names = rng.sample(sorted(OPTIONS), rng.choice([0, 1, 2, 3, 5, 8]))
    return {name: rng.choice(OPTIONS[name]) for name in names if number % 3}


def words_of(options: dict[str, Any]) -> list[str]:
    """Return the options as words of the command line; all but `curves`."""
    words = []
    for name, value in options.items():
        option = f"--{name.replace('_', '-')}"
        if name == "roles":
            words += [word for key, role in value.items() for word in ("--role", f"{key}={role}")]
        elif isinstance(value, bool):
            words += [option if value else "--no-repair"] if name != "curves" else []
        else:
            words += [option, str(value)]
    return words


def wrong_note(note: Note) -> str:
    """Return a fault of a note's shape, or an empty text."""
    places = [note.at, *(item.at for item in note.items), *(p for item in note.items for p in item.points)]
    sizes = [note.size, *(item.size for item in note.items)]
    checks = {
        "kind": note.kind in KINDS,
        "effect": note.effect in EFFECTS,
        "count": type(note.count) is int and note.count > 0,
        "what": isinstance(note.what, str) and bool(note.what),
        "where": isinstance(note.where, str),
        "remedy": isinstance(note.remedy, str),
        "items": len(note.items) <= MOST_ITEMS and all(len(item.points) <= MOST_POINTS for item in note.items),
        "handles": all(isinstance(item.handle, str) for item in note.items),
        "places": all(
            p is None or (len(p) == 2 and all(type(x) is float and math.isfinite(x) for x in p)) for p in places
        ),
        "sizes": all(size is None or (isinstance(size, float | int) and size >= 0) for size in sizes),
        "one line": "\n" not in str(note),
    }
    return ", ".join(name for name, is_right in checks.items() if not is_right)


def fault_of_shapes(shapes: Shapes, is_scene: bool) -> str:
    """Return a fault of the record of reading: notes of a wrong shape, or that a file does not give back."""
    notes = [] if is_scene else shapes.reading  # a scene file's own notes are kept as they are
    if wrong := next((f"{text}: {note!r}" for note in notes if (text := wrong_note(note))), ""):
        return f"a note with a wrong {wrong[:1000]}"
    read_notes(json.loads(json.dumps(records(shapes.reading, with_points=True), allow_nan=False)))
    if not shapes.shapes and not shapes.reading and not is_scene:
        return "no shapes, and no note"
    return ""


def used(question: tuple[int, str, int]) -> tuple[str, str, str, float, int]:
    """Return a file's name, the result of reading it, its fault, seconds, and the greatest memory so far in MiB.

    The memory of this process is limited from now on.
    """
    number, folder, parts = question
    if resource.getrlimit(resource.RLIMIT_AS)[0] != MEMORY:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    begin = time.process_time()
    with limited(PATIENCE):
        name, came, wrong = result_of(number, Path(folder), parts)
    seconds = time.process_time() - begin
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss >> 10
    return name, came, wrong, seconds, most


def result_of(number: int, folder: Path, most: int = MOST) -> tuple[str, str, str]:
    """Return a file's name or its kind of bomb, the result of reading it in a word, and its fault or an empty text."""
    name, content, image = file_of(number, most)
    options, file = options_of(number), folder / name
    file.write_bytes(content)
    (folder / "map.pgm").write_bytes(image)
    try:
        came, wrong = _read(file, options)
        if number % COMMANDS == 0 and not wrong:
            came, wrong = _checked(file, options)
    except Exception as error:
        came, wrong = type(error).__name__, traceback.format_exc()
    return bomb_of(number) or name, came, wrong and f"{options}\n{wrong}"


def bomb_of(number: int) -> str:
    return sorted(hostile.BOMBS)[number // BOMBS % len(hostile.BOMBS)] if number % BOMBS == BOMBS - 1 else ""


def _read(file: Path, options: dict[str, Any]) -> tuple[str, str]:
    try:
        shapes = load_shapes(file, **options)
    except FormatError as error:
        return type(error).__name__, "" if str(error) else "an error without a message"
    except ValueError as error:
        is_about_option = str(error).startswith(tuple(options))
        return "option refused", "" if is_about_option else traceback.format_exc()
    wrong = fault_of_shapes(shapes, shapes.form == "scene")
    if shapes.of("robot"):
        with suppress(CfreeError):
            shapes.scene()
    return "shapes", wrong


def _checked(file: Path, options: dict[str, Any]) -> tuple[str, str]:
    """Run ``cfree check``; nothing but success and one clear refusal is right."""
    result = CliRunner().invoke(app, ["check", str(file), *words_of(options)])
    text = result.stdout + result.stderr
    if result.exit_code not in (0, 2) or "Traceback" in text:
        return "check", f"exit code {result.exit_code}: {text[-3000:]}"
    if result.exit_code and not ("error: " in text.lower() or "Usage" in text):
        return "check", f"refused without a reason: {text[-1000:]}"
    return f"check {result.exit_code}", ""


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--step", type=int, default=1, help="1000, with the seed 999: bombs alone")
    parser.add_argument("--most", type=int, default=MOST, help="greatest number of parts of a bomb")
    options = parser.parse_args()
    begin, slowest, largest = time.monotonic(), (0.0, 0), (0, 0)
    kinds, wrong = Counter[tuple[str, str]](), set()
    with tempfile.TemporaryDirectory() as folder, suppress(KeyboardInterrupt):
        worker = Worker(used, 20 * PATIENCE)
        for number in range(options.seed, options.seed + options.count * options.step, options.step):
            try:
                name, came, text, seconds, most = worker.ask((number, folder, options.most))
            except Lost as error:
                name, came, text, seconds, most = bomb_of(number) or file_of(number)[0], str(error), str(error), 0.0, 0
            slowest, largest = max(slowest, (seconds, number)), max(largest, (most, -number))
            kinds[name, came] += 1
            place = (came, *text.strip().splitlines()[-3:])
            if text and place not in wrong:
                wrong.add(place)
                print(f"--- file {number}, {name}: {came}", text, sep="\n", flush=True)
    seconds = time.monotonic() - begin
    for (name, came), count in sorted(kinds.items()):
        print(f"{name:<22} {came:<20} {count:>9,}")
    print(f"{kinds.total():,} files, {kinds.total() / seconds:,.0f} a second")
    print(f"slowest: {slowest[1]}, {slowest[0]:.2f} s; largest: {-largest[1]}, {largest[0]:,} MiB; {len(wrong)} faults")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
