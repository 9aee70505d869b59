"""Verify the scenes of `fuzz.py`: ``python tests/support/fuzz_verify.py 10000 --seed 1``.

Euler numbers are also compared with those of the core's cell complex. It prints findings and, at the end, the first
scene with a finding made small; it exits with 1 if there is one.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from itertools import count as numbers
from itertools import islice

import cfree.verify
import fuzz
from cfree import boundary
from cfree.errors import InvalidPolygonError
from cfree.formats.scene_file import scene_text
from compared import scene_of
from shapes import PlainScene


def findings(plain: PlainScene, slices: int, seed: int) -> list[str] | None:
    """Findings of `verify`; None if the scene is not valid."""
    try:
        scene = scene_of(plain)
    except InvalidPolygonError:
        return None
    result = boundary(scene, threads=1)
    verification = cfree.verify.boundary(result, slices=slices, seed=seed)
    wrong = [str(finding) for finding in verification.findings]
    if not wrong and list(verification.euler) != sorted(result.complex.euler.tolist()):
        wrong = [f"Euler numbers {verification.euler}, {result.complex.euler.tolist()} in the core"]
    return wrong


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("count", type=int, help="scenes")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--slices", type=int, default=4)
    chosen = parser.parse_args()
    verified: Counter[str] = Counter()
    refuted = []
    names = ((kind, k) for k in numbers(chosen.seed * 10_000_000) for kind in fuzz.KINDS)
    for kind, number in islice(names, chosen.count):
        wrong = findings(fuzz.scene(kind, number), chosen.slices, number)
        if wrong:
            refuted.append((kind, number))
            print(f"{kind} {number}", *wrong[:5], sep="\n  ", flush=True)
        verified["not valid" if wrong is None else "refuted" if wrong else kind] += 1
        if sum(verified.values()) % 500 == 0:
            print(dict(verified), flush=True)
    print(f"{chosen.count:,} scenes, {len(refuted)} refuted: {dict(verified)}")
    if refuted:
        kind, number = refuted[0]
        small = fuzz.reduced(fuzz.scene(kind, number), lambda other: bool(findings(other, chosen.slices, number)))
        print(f"{kind} {number}, reduced:", scene_text(scene_of(small)), sep="\n")
    sys.exit(bool(refuted))


if __name__ == "__main__":
    main()
