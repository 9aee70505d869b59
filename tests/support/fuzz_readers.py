"""Check readers with damaged and hostile drawings, maps and footprints: each is read, or refused with one error.

    python tests/support/fuzz_readers.py --count 100000 --seed 7

File k is the same for ever, and may take little time and memory. Results other than shapes and errors of cfree are
shown; the last line counts all.
"""

from __future__ import annotations

import argparse
import gzip
import random
import resource
import sys
import tempfile
import time
import traceback
from collections import Counter
from contextlib import suppress
from pathlib import Path

import drawings
from cfree.errors import CfreeError
from cfree.formats.scene_file import load_shapes

PATIENCE = 20.0  # seconds of processor time for one file
MEMORY = 4 << 30  # bytes of address space for all that is done
NUMBERS = ["0", "-1", "1e308", "-1e308", "1e400", "nan", "inf", "1e-320", "0.1", "99999999999999999999", ".", "1/3", ""]
TOKENS = [
    "<",
    ">",
    "&a;",
    "[",
    "]",
    "{",
    "}",
    '"',
    "'",
    "\n",
    "\0",
    "*a",
    "&a ",
    ": ",
    "- ",
    "url(#a)",
    "ä",
    "%",
    "#",
    "../",
]


def damaged(number: int) -> tuple[str, bytes, bytes]:
    """Name and content of a file, and of the image beside a map."""
    rng = random.Random(f"reader {number}")
    name, content = rng.choice(sorted(drawings.files().items()))
    image = drawings.PGM.encode() if rng.random() < 0.5 else drawings.png([[0, 254], [205, 0]])
    if name == "map.yaml" and rng.random() < 0.5:
        return name, content, changed(rng, image)
    if name == "b.svgz" and rng.random() < 0.8:
        return name, gzip.compress(changed(rng, gzip.decompress(content)), mtime=0), image
    return name, changed(rng, content), image


def changed(rng: random.Random, content: bytes) -> bytes:
    """One to four changes: bits, tokens, numbers, pieces left out, repeated or moved, the end cut off."""
    text = bytearray(content)
    for _ in range(rng.randint(1, 4)):
        if not text:
            break
        place = rng.randrange(len(text))
        match rng.randrange(8):
            case 0:
                text[place] ^= 1 << rng.randrange(8)
            case 1:
                del text[place:]
            case 2:
                text[place:place] = rng.choice(TOKENS).encode()
            case 3 | 4:
                numbers = [k for k in range(place, min(len(text), place + 200)) if chr(text[k]).isdigit()]
                if numbers:
                    end = numbers[0]
                    while end < len(text) and chr(text[end]).isdigit():
                        end += 1
                    text[numbers[0] : end] = rng.choice(NUMBERS).encode()
            case 5:
                del text[place : place + rng.randint(1, 60)]
            case 6:
                piece = bytes(text[place : place + rng.randint(1, 200)])
                text[place:place] = piece * rng.choice([1, 2, 50])
            case 7:
                other = rng.randrange(len(text))
                text[place:place] = text[other : other + rng.randint(1, 80)]
    return bytes(text)


def used(number: int, folder: Path) -> tuple[str, str, str]:
    """Name of a damaged file, the result of reading it, and its fault."""
    name, content, image = damaged(number)
    (folder / name).write_bytes(content)
    (folder / "map.pgm").write_bytes(image)
    begin = time.process_time()
    try:
        shapes = load_shapes(folder / name)
        if shapes.of("robot"):
            shapes.scene()
        came, wrong = "shapes", ""
    except CfreeError as error:
        came, wrong = type(error).__name__, "" if str(error) else "an error without a message"
    except Exception as error:
        came, wrong = type(error).__name__, traceback.format_exc()
    if time.process_time() - begin > PATIENCE:
        wrong = wrong or f"{time.process_time() - begin:.1f} seconds"
    return name, came, wrong


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    begin, slowest = time.process_time(), (0.0, 0)
    kinds, wrong = Counter[tuple[str, str]](), set()
    with tempfile.TemporaryDirectory() as folder, suppress(KeyboardInterrupt):
        for number in range(options.seed, options.seed + options.count):
            start = time.process_time()
            name, came, text = used(number, Path(folder))
            slowest = max(slowest, (time.process_time() - start, number))
            kinds[name, came] += 1
            place = tuple(text.strip().splitlines()[-3:])
            if text and place not in wrong:
                wrong.add(place)
                print(f"--- file {number}, {name}: {came}", text, sep="\n", flush=True)
    seconds = time.process_time() - begin
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss >> 10
    for (name, came), count in sorted(kinds.items()):
        print(f"{name:<9} {came:<20} {count:>9,}")
    print(
        f"{kinds.total():,} files, {kinds.total() / seconds:,.0f} a second; slowest: {slowest[1]}, {slowest[0]:.2f} s"
    )
    print(f"{most:,} MiB; {len(wrong)} faults")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
