"""Random scenes of concave arcs that face convex ones against exact tests of poses, and with both sides exchanged.

python tests/support/fuzz_facing.py --count 2000 --seed 7 --families fits both
python tests/support/fuzz_facing.py --one fits 31
"""

from __future__ import annotations

import argparse
import random
import sys
import time
import traceback
from collections import Counter

from cfree import UnsupportedError
from facing_arcs import FAMILIES, faults, scene


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--families", nargs="*", default=[*FAMILIES])
    parser.add_argument("--poses", action="store_true")
    parser.add_argument("--one", nargs=2, metavar=("FAMILY", "SEED"))
    args = parser.parse_args()
    chosen = (
        [(args.one[0], int(args.one[1]))]
        if args.one
        else [(args.families[k % len(args.families)], args.seed + k) for k in range(args.count)]
    )
    counts, wrong = Counter[str](), 0
    for family, seed in chosen:
        start = time.perf_counter()
        try:
            found = list(faults(scene(family, seed), random.Random(seed), is_compared=not args.poses))
        except UnsupportedError as error:
            counts[f"{family}: refused"] += 1
            print(f"{family} {seed}: refused: {error}", flush=True)
            continue
        except Exception:
            found = [traceback.format_exc()]
        counts[family] += 1
        seconds = time.perf_counter() - start
        if found:
            wrong += 1
            print(f"{family} {seed}: {len(found)} faults, the first: {found[0]}", flush=True)
        elif args.one or seconds > 30:
            print(f"{family} {seed}: {seconds:.1f} s", flush=True)
    print(f"{sum(counts.values())} scenes, {wrong} wrong: {dict(counts)}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
