"""Query the core's predicates for any time: ``python tests/support/fuzz_predicates.py --seconds 60 --seed 1``.

It prints the number of queries for each family of scenes. It stops at the first answer that differs from the reference,
prints the scene and the query, and exits with 1; `--family` and `--seed` as printed repeat it.
"""

from __future__ import annotations

import argparse
import random
import sys
import time
import traceback
from collections import Counter

from differential import ask, ask_junctions, random_surface
from hard_scenes import FAMILIES, distinct


def fuzz(seconds: float, seed: int, families: list[str]) -> int:
    asked: Counter[str] = Counter()
    scenes: Counter[str] = Counter()
    end, number = time.monotonic() + seconds, seed
    while time.monotonic() < end:
        for name in families:
            rng = random.Random(f"{name} {number}")
            surface = random_surface(distinct(FAMILIES[name](rng)), rng)
            try:
                asked[name] += ask(surface, rng) + ask_junctions(surface, rng).total()
            except Exception:
                traceback.print_exc(file=sys.stdout)
                print(f"family {name}, seed {number}: {surface}")
                return 1
            scenes[name] += 1
        number += 1
    for name in families:
        print(f"{name:15} {scenes[name]:8,} surfaces {asked[name]:12,} questions")
    print(f"seeds {seed} to {number - 1}: no difference")
    return 0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", type=int, default=0, help="the first; each round takes the next")
    parser.add_argument("--family", choices=FAMILIES, action="append", help="all, if none is given")
    chosen = parser.parse_args()
    sys.exit(fuzz(chosen.seconds, chosen.seed, chosen.family or list(FAMILIES)))


if __name__ == "__main__":
    main()
