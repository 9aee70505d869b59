"""Polygons for thin and flat round shapes, and verdicts about poses among them, against exact points of their rims.

    python tests/support/fuzz_thin.py --count 100000 --seed 0

A case is an exact point of a rim. It may not be outside of the polygon around the shape, nor inside of the other one.
A pose at which a corner is a little beyond the rim, or a little within, may not be told to be what it is not.
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
    """How many cases of each kind one shape gives, and what is wrong."""
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
                at = side(p, polygons[0].exact_rings)
                if at > 0 if inside else at < 0:
                    kind = "inner" if inside else "outer"
                    wrong.append(f"{family} {float(thin):g}: {kind}({error:g}) has {p} on the wrong side")
        scene = cfree.Scene(SCENE, [shape])
        text = [*mismatches(scene, scene.inner(error) if inside else scene.outer(error), outward=not inside)]
        counted["polygons verified"] += 1
        wrong += [f"{family} {float(thin):g}: {found}" for found in text]
    for scene, pose, is_free, kind in touching(rng, thin):
        try:
            found = cfree.is_free(scene, pose)
        except cfree.UnsupportedError:
            counted["beyond the range of numbers"] += 1
            continue
        counted[f"poses, {kind}: {'undecided' if found is None else 'decided'}"] += 1
        if found is (not is_free):
            wrong.append(f"{kind} {float(thin):g}: {pose} in {scene} is said to be {'free' if found else 'forbidden'}")
    return counted, wrong


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=100_000, help="Cases: points and poses.")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    counted, begin, seed, bad = Counter[str](), time.monotonic(), options.seed, 0
    with suppress(KeyboardInterrupt):
        while sum(counted.values()) < options.count:
            found, wrong = faults(seed)
            counted += found
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
