"""Random cages against flooding, which knows some poses to be joined and some not; and in other forms.

A scene is a small body among fingers around it. `flood` gives poses with room: those of one certain class are joined,
those of different possible classes are not. So `is_caged` must give one answer in a certain class, and all poses that
escape must be in one possible class. The first answer of each scene is verified. Discs are between polygons inside and
around them, points within small squares: a cage of the smaller fingers is one of the larger.
"""

from __future__ import annotations

import argparse
import math
import random
import sys
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parent))

import cfree
import flood
import oracles
from cfree.caging import is_caged
from shapes import PlainScene, Shape

STEPS = 40
POSES = 3  # certain classes of which a pose is decided


def polygon(rng: random.Random, count: int, size: float, least: float = 0.3) -> list[tuple[float, float]]:
    """A star-shaped polygon with vertices on a grid of sixteenths."""
    while True:
        angles = sorted(rng.uniform(0, math.tau) for _ in range(count))
        ring = [
            (round(16 * r * math.cos(a)) / 16, round(16 * r * math.sin(a)) / 16)
            for a, r in ((a, size * rng.uniform(least, 1)) for a in angles)
        ]
        try:
            return [*map(tuple, cfree.Polygon(ring).vertices.tolist())]  # type: ignore[arg-type]
        except ValueError:
            continue


def fingers_around(rng: random.Random, most: int) -> list[list[tuple[float, float]]]:
    """Small polygons on a ring around the origin."""
    count, radius, turn = rng.randint(3, most), rng.uniform(1.2, 1.8), rng.uniform(0, math.tau)
    apart = 2 * radius * math.sin(math.pi / count)
    result = []
    for k in range(count):
        angle = turn + (k + rng.uniform(-0.3, 0.3)) * math.tau / count
        x, y = (round(16 * radius * f(angle)) / 16 for f in (math.cos, math.sin))
        result.append([(x + u, y + v) for u, v in polygon(rng, rng.randint(4, 6), apart * rng.uniform(0.5, 0.85), 0.7)])
    return result


def check(seed: int) -> Counter[str]:
    """Decide some poses of one scene, and compare; raise an `AssertionError` for a difference."""
    rng = random.Random(seed)
    body, fingers = (
        polygon(rng, rng.randint(4, 7), rng.uniform(0.4, 0.9), rng.choice((0.3, 0.8))),
        fingers_around(rng, 6),
    )
    plain = plain_scene(body, fingers)
    numbers = Counter[str]()
    try:
        joined = flood.flood(plain, STEPS)
    except oracles.AtALoss:  # shapely's unions contradict each other
        return Counter({"scenes that shapely does not unite": 1})
    order = list(range(len(joined.theta)))
    rng.shuffle(order)
    order.sort(key=lambda k: math.hypot(*joined.xy[k]))  # those near the middle are caged
    first = [next(k for k in order if joined.certain[k] == c) for c in dict.fromkeys(joined.certain[order].tolist())]
    chosen = list(dict.fromkeys([*first[:POSES], first[-1], rng.choice(order)]))
    answers: dict[int, bool] = {}
    for k in chosen:
        pose = cfree.Pose(*joined.xy[k].tolist(), float(joined.theta[k]))
        try:
            cage = is_caged(body, fingers, pose)
        except cfree.UndecidedError:
            numbers["undecided"] += 1
            continue
        answers[k] = bool(cage)
        assert k != chosen[0] or cage.verified(), (seed, k)
    for j in answers:
        for k in answers:
            assert joined.certain[j] != joined.certain[k] or answers[j] == answers[k], ("joined", seed, j, k)
            escaped = not answers[j] and not answers[k]
            assert not escaped or joined.possible[j] == joined.possible[k], ("separated", seed, j, k)
    outer = [k for k in answers if not answers[k]]
    for k, is_held in answers.items():
        kind = "caged" if is_held else "escapes"
        if is_held:
            known = all(joined.possible[k] != joined.possible[j] for j in outer) and bool(outer)
        else:
            known = any(j != k and joined.certain[k] == joined.certain[j] for j in outer)
        numbers[f"{kind}, {'confirmed by flooding' if known else 'not contradicted'}"] += 1
    numbers["scenes"] += 1
    numbers["scenes with a cage"] += any(answers.values())
    return numbers + (_in_other_forms(rng, body, seed) if seed % 4 == 0 else Counter[str]())


def plain_scene(body: list[tuple[float, float]], fingers: Sequence[list[tuple[float, float]]]) -> PlainScene:
    """The scene for the oracles, in bounds that the body can leave all fingers in."""
    reach = max(abs(c) for finger in fingers for p in finger for c in p) + 2 * oracles.robot_radius([(body, [])])
    shapes: list[Shape] = [(finger, []) for finger in fingers]
    return PlainScene([(body, [])], shapes, (-reach, -reach, reach, reach), None)


def _in_other_forms(rng: random.Random, body: list[tuple[float, float]], seed: int) -> Counter[str]:
    """Compare discs with polygons inside and around them, and points with squares around them."""
    numbers = Counter[str]()
    count, radius, turn = rng.randint(3, 7), rng.uniform(0.6, 1.3), rng.uniform(0, math.tau)
    centers = [
        (radius * math.cos(turn + k * math.tau / count), radius * math.sin(turn + k * math.tau / count))
        for k in range(count)
    ]
    r = rng.uniform(0.05, 0.3)
    discs = [cfree.Curved.circle(center, r) for center in centers]
    forms: dict[str, list[Any]] = {
        "inside": [p for disc in discs for p in disc.inner(r / 50)],
        "discs": discs,
        "around": [p for disc in discs for p in disc.outer(r / 50)],
        "points": list(centers),
        "squares": [[(x - 0.01, y), (x, y - 0.01), (x + 0.01, y), (x, y + 0.01)] for x, y in centers],
    }
    verdicts: dict[str, bool | None] = {}
    for name, fingers in forms.items():
        try:
            cage = is_caged(body, fingers)
        except cfree.InvalidPoseError:
            continue
        except cfree.UndecidedError:
            numbers[f"{name} undecided"] += 1
            continue
        assert cage.verified(), (seed, name)
        verdicts[name] = bool(cage)
    for smaller, larger in (("inside", "discs"), ("discs", "around"), ("points", "squares"), ("points", "discs")):
        if verdicts.get(smaller) and larger in verdicts:
            assert verdicts[larger], (seed, smaller, larger)
            numbers[f"{larger} caged as {smaller} do"] += 1
        elif smaller in verdicts and verdicts.get(larger) is False:
            assert not verdicts[smaller], (seed, smaller, larger)
            numbers[f"{smaller} let go as {larger} do"] += 1
    return numbers


def main() -> None:
    """Compare so many scenes, and print the numbers."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    total, begin = Counter[str](), time.time()
    for seed in range(options.seed, options.seed + options.count):
        total += check(seed)
        if (seed + 1 - options.seed) % 50 == 0:
            print(f"{seed + 1 - options.seed} scenes, {time.time() - begin:.0f} s: {dict(total)}", flush=True)
    print(f"no difference in {total['scenes']:,} scenes: {dict(total)}")


if __name__ == "__main__":
    main()
