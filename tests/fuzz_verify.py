"""The scenes of `fuzz.py`, verified: ``python tests/fuzz_verify.py 10000 --seed 1``.

Euler numbers are compared with those of the core's cell complex, too. Stops at the first scene with a finding, makes it
small, prints it, and exits with 1.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from functools import partial
from itertools import count as numbers
from itertools import islice

import cfree.verify
import fuzz
from cfree import boundary
from cfree.errors import InvalidPolygonError
from cfree.io import scene_text
from compared import scene_of
from shapes import PlainScene


def findings(plain: PlainScene, slices: int, seed: int) -> list[str] | None:
    """What `verify` finds; None if the scene is not valid."""
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
    names = ((kind, k) for k in numbers(chosen.seed * 10_000_000) for kind in fuzz.KINDS)
    for kind, number in islice(names, chosen.count):
        plain = fuzz.scene(kind, number)
        wrong = findings(plain, chosen.slices, number)
        if wrong:
            print(f"{kind} {number}", *wrong[:5], sep="\n")
            refuted = partial(findings, slices=chosen.slices, seed=number)
            small = fuzz.reduced(plain, lambda other, refuted=refuted: bool(refuted(other)))  # type: ignore[misc]
            print(scene_text(scene_of(small)), *(refuted(small) or [])[:5], sep="\n")
            sys.exit(1)
        verified["not valid" if wrong is None else kind] += 1
        if sum(verified.values()) % 500 == 0:
            print(sum(verified.values()), dict(verified), flush=True)
    print(f"{chosen.count:,} scenes, no finding: {dict(verified)}")


if __name__ == "__main__":
    main()
