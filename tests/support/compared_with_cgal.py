"""Poses among segments and arcs at rational angles, against CGAL's sets of circle segments, where it is installed.

    python tests/support/compared_with_cgal.py --count 200 --seed 0

Half of the poses are exact contacts of two arcs, vertices or edges, or a little deeper or off them.
"""

from __future__ import annotations

import argparse
import hashlib
import math
import random
import shutil
import subprocess
import tempfile
from collections import Counter
from collections.abc import Iterable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import cfree
from cfree import Curved, Polygon, Pose
from cfree.collision.arcs import Curve, arcs_of, curves_of
from cfree.contact.features import ArcFeature, EdgeFeature, shape_features
from cfree.exact.number import ExactPoint, rational_root
from cfree.exact.pose import pose_at
from fuzz_arcs import KINDS, grown, point, rational_pose

SOURCE = Path(__file__).with_name("round_overlaps.cpp")
TINY = Fraction(1, 2**60)
UNITS = [(1, 0), (0, 1), (-1, 0), (0, -1), *((Fraction(a, 5), Fraction(b, 5)) for a in (3, -3) for b in (4, -4))]
UNITS += [(Fraction(a, 13), Fraction(b, 13)) for a in (5, -5) for b in (12, -12)]
Rings = list[list[Curve]]


def compiler() -> str | None:
    """A compiler that finds CGAL's headers, if there is one."""
    program = shutil.which("g++") or shutil.which("clang++")
    header = "#include <CGAL/Gps_circle_segment_traits_2.h>\n#include <gmp.h>\n"
    if program is None:
        return None
    found = subprocess.run([program, "-M", "-x", "c++", "-"], input=header.encode(), capture_output=True, check=False)
    return program if found.returncode == 0 else None


def compiled() -> Path:
    """Compile the program that compares regions; it takes a minute, so that it is kept beside the other builds."""
    program, folder = compiler(), Path(__file__).parents[2] / "build"
    assert program is not None, "no compiler that finds CGAL"
    target = folder / f"round_overlaps-{hashlib.sha256(SOURCE.read_bytes()).hexdigest()[:12]}"
    if not target.exists():
        folder.mkdir(exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=folder, delete=False) as unfinished:
            options = ["-std=c++17", "-O1", "-DNDEBUG", "-w"]
            subprocess.run([program, *options, str(SOURCE), "-o", unfinished.name, "-lgmp", "-lmpfr"], check=True)
        Path(unfinished.name).replace(target)
    return target


def convex_grown(r: random.Random) -> Curved:
    """A rectangle, or a triangle with sides of rational lengths, grown."""
    (x, y), a = point(r), Fraction(r.randint(1, 6), 4)
    points = r.choice([[(0, 0), (4, 0), (4, 3)], [(0, 0), (4, 0), (4, 1), (0, 1)], [(0, 0), (3, 4), (-3, 4)]])
    return Curved([(x + a * u, y + a * v) for u, v in points], grown=Fraction(r.randint(1, 6), 4))


OWN_KINDS = [convex_grown, *(kind for kind in KINDS if kind is not grown)]


def rings_of(shape: Polygon | Curved) -> Rings:
    """Rings of a shape, the inside on the left; a grown one is convex, and its sides have rational lengths."""
    curves = curves_of(shape)
    assert curves is not None
    radius, rings = curves
    if radius:
        return [_grown(rings[0], radius)]
    return [_turned(ring, hole=k > 0) for k, ring in enumerate(rings)]


def _grown(ring: list[Curve], radius: Fraction) -> list[Curve]:
    ring = _turned(ring, hole=False)
    sides = list[tuple[ExactPoint, ExactPoint, ExactPoint]]()
    for p, q, *_ in ring:
        along = q[0] - p[0], q[1] - p[1]
        length = rational_root(along[0] ** 2 + along[1] ** 2)
        assert length
        off = along[1] * radius / length, -along[0] * radius / length
        sides.append((_sum(p, off), _sum(q, off), q))
    result = list[Curve]()
    for k, (p, q, center) in enumerate(sides):
        result += [(p, q, center, 0), (q, sides[(k + 1) % len(sides)][0], center, 1)]
    return result


def _turned(ring: list[Curve], *, hole: bool) -> list[Curve]:
    """The ring, or its reverse: arcs are of at most a quarter turn, so that their area is near that of their chords."""
    area = 0.0
    for (a, b), (c, d), (x, y), turn in ring:
        area += float(a * d - b * c)
        if turn:
            square = float((a - x) ** 2 + (b - y) ** 2)
            sine = float((a - x) * (d - y) - (b - y) * (c - x)) * turn / square
            sweep = math.atan2(sine, float((a - x) * (c - x) + (b - y) * (d - y)) / square)
            area += turn * square * (sweep - sine)
    return ring if (area > 0) is not hole else [(q, p, center, -turn) for p, q, center, turn in reversed(ring)]


def _sum(p: ExactPoint, q: Iterable[Fraction]) -> ExactPoint:
    (x, y), (u, v) = p, q
    return x + u, y + v


def placed(rings: Rings, pose: Pose) -> Rings:
    return [[(*pose.apply_exact([p, q, c]), turn) for p, q, c, turn in ring] for ring in rings]  # type: ignore[misc]


def text_of(rings: Rings) -> str:
    lines = [str(len(rings))]
    for ring in rings:
        lines.append(str(len(ring)))
        lines += [" ".join([*(str(x) for p in points for x in p), str(turn)]) for *points, turn in ring]
    return "\n".join(lines)


def touching_poses(r: random.Random, robot: Polygon | Curved, obstacle: Polygon | Curved) -> Iterator[Pose]:
    """Poses in which two features touch, or the circles or lines that they are on; and a little deeper, and off."""
    turned = Pose(0, 0, {"tau": r.choice([0, 1, Fraction(1, 2), Fraction(-1, 3)])})
    own, other = r.choice(shape_features(robot).rings[0]), r.choice(shape_features(obstacle).rings[0])
    share = r.choice([Fraction(0), Fraction(1, 2), Fraction(1)])
    n: ExactPoint | None = r.choice(UNITS)  # the obstacle's normal
    if isinstance(other, EdgeFeature):
        n = _unit((other.along[1], -other.along[0]))
    elif isinstance(own, EdgeFeature):
        ((u, v),) = turned.apply_exact([(-own.along[1], own.along[0])])
        n = _unit((u, v))
    (one, near), (two, far) = _middle(own, share), _middle(other, share)
    if n is None or near is None or far is None:
        return
    ((x, y),) = turned.apply_exact([one])
    for more in (Fraction(0), TINY, -TINY):
        off = near + far + more
        yield pose_at(two[0] - x + off * n[0], two[1] - y + off * n[1], turned.tau)


def _middle(feature: ArcFeature | EdgeFeature, share: Fraction) -> tuple[ExactPoint, Fraction | None]:
    """Center of an arc, or a point of an edge, and how far the shape reaches beyond it, if that is rational."""
    if isinstance(feature, EdgeFeature):
        return _sum(feature.start, (share * x for x in feature.along)), feature.offset
    return feature.centre, feature.radius


def _unit(vector: ExactPoint) -> ExactPoint | None:
    length = rational_root(vector[0] ** 2 + vector[1] ** 2)
    return (vector[0] / length, vector[1] / length) if length else None


def compared(program: Path, count: int, seed: int = 0, poses: int = 20) -> Counter[str]:
    """Compare poses in some scenes; return counts."""
    texts, verdicts = list[str](), list[tuple[Any, bool, int]]()
    for k in range(seed, seed + count):
        r = random.Random(f"cgal {k}")
        scene = cfree.Scene([r.choice(OWN_KINDS)(r) for _ in range(r.choice([1, 1, 2]))], [r.choice(OWN_KINDS)(r)])
        arcs, parts, (other,) = arcs_of(scene), [*map(rings_of, scene.robot)], map(rings_of, scene.obstacles)
        assert arcs is not None
        tried = [rational_pose(r) for _ in range(poses // 2)]
        while len(tried) < poses:
            tried += touching_poses(r, r.choice(scene.robot), scene.obstacles[0])
        for pose in tried:
            verdicts.append(((k, pose), arcs.is_free(pose), len(parts)))
            texts += [f"{text_of(placed(part, pose))}\n{text_of(other)}" for part in parts]
    done = subprocess.run([program], input="\n".join(texts), capture_output=True, text=True, check=True)
    overlaps, counts = iter(done.stdout.split()), Counter[str]()
    for place, is_free, parts_of_it in verdicts:
        truth = "1" not in [next(overlaps) for _ in range(parts_of_it)]
        assert truth is is_free, f"CGAL: {truth}, cfree: {is_free} at {place}"
        counts["free" if is_free else "forbidden"] += 1
    assert next(overlaps, None) is None
    return counts


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=200, help="scenes")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    print(dict(compared(compiled(), options.count, options.seed)))


if __name__ == "__main__":
    main()
