"""Compare polygons for thin and flat round shapes, and verdicts about poses, with exact points of their rims.

    python tests/support/fuzz_thin.py --count 100000 --seed 0

A case is an exact point of a rim. It may not be outside of the polygon around the shape, nor inside of the other one. A
pose at which a corner is a little beyond the rim, or a little within, may not get the wrong verdict.
"""

from __future__ import annotations

import argparse
import random
import time
from collections import Counter
from contextlib import suppress
from fractions import Fraction

import cfree
from cfree.verify.curves import mismatches
from thin_shapes import FAMILIES, rim_points, side, thin_shape, touching

POINTS = 8  # of each ring
SCENE = [(0, 0), (1, 0), (0, 1)]


def faults(seed: int) -> tuple[Counter[str], list[str]]:
    """Numbers of cases of each kind for one shape, and its faults."""
    rng = random.Random(f"thin {seed}")
    family, thin = rng.choice(FAMILIES), Fraction(1, 2 ** rng.randrange(5, 81))
    shape = thin_shape(rng, family, thin)
    error = shape.size * 10 ** -rng.uniform(1.5, 5)
    counted, wrong = Counter[str](), list[str]()
    for inside in (False, True):
        try:
            polygons = shape.inner(error) if inside else shape.outer(error)
        except cfree.UndecidedError:
            polygons = ()
        if not polygons:
            counted[f"{family}: none {'inside' if inside else 'around'}"] += 1
            continue
        for ring in (shape.path, *shape.holes):
            for p in rim_points(ring, rng, POINTS):
                counted["points"] += 1
                place = side(p, polygons[0].exact_rings)
                if place > 0 if inside else place < 0:
                    kind = "inner" if inside else "outer"
                    wrong.append(f"{family} {float(thin):g}: {kind}({error:g}) has {p} on the wrong side")
        scene = cfree.Scene(SCENE, [shape])
        text = [*mismatches(scene, scene.inner(error) if inside else scene.outer(error), outward=not inside)]
        counted["polygons verified"] += 1
        wrong += [f"{family} {float(thin):g}: {verdict}" for verdict in text]
    for scene, pose, is_free, kind in touching(rng, thin):
        try:
            verdict = cfree.is_free(scene, pose)
        except cfree.UnsupportedError:
            counted["beyond the range of numbers"] += 1
            continue
        counted[f"poses, {kind}: {'undecided' if verdict is None else 'decided'}"] += 1
        if verdict is (not is_free):
            wrong.append(f"{kind} {float(thin):g}: {pose} in {scene} is called {'free' if verdict else 'forbidden'}")
    return counted, wrong


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=100_000, help="Cases: points and poses.")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    counted, begin, seed, bad = Counter[str](), time.monotonic(), options.seed, 0
    with suppress(KeyboardInterrupt):
        while sum(counted.values()) < options.count:
            counts, wrong = faults(seed)
            counted += counts
            bad += len(wrong)
            for text in wrong:
                print(f"seed {seed}: {text}", flush=True)
            seed += 1
    seconds = time.monotonic() - begin
    print(f"seeds {options.seed} to {seed - 1}, {sum(counted.values())} cases, {bad} wrong, {seconds:.0f} s")
    for kind, count in sorted(counted.items()):
        print(f"  {kind}: {count}")


if __name__ == "__main__":
    main()
