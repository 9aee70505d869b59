"""Nesting: exact fits that no-fit polygons keep, 360 of them by angle, and the area that a placement uses.

Rivals: shapely (union of the sums of convex pieces, prepared beforehand), and pyclipper's Minkowski sum of outlines, if
it is installed: `pip install pyclipper`. The placement's rival is the same bottom-left fill in doubles: inner fit less
shapely's no-fit polygons, the lowest vertex left. Packers that search, such as sparrow, pack denser than both.
"""

from __future__ import annotations

import math
import random
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import shapely
from measure import SCENES, Report, timed
from shapely_slices import pieces_of, sums_by_merging

import cfree
from cfree import Polygon
from cfree.nesting import Nesting, Part, Placed, RotationalNFP, nfp, overlaps, place

try:
    import pyclipper
except ImportError:
    pyclipper = None

ANGLES = [math.radians(k + 0.5) for k in range(360)]
SCALE = 10**6  # of pyclipper's integers
Region = Callable[[Polygon, Polygon, float], Any]


def run(quick: bool) -> Report:
    columns = ("what", "cfree", "shapely", "pyclipper")
    report = Report("Nesting beside shapely and pyclipper", columns)
    _fits(report, 10 if quick else 200)
    for name, fixed, moving in _pairs()[: 1 if quick else None]:
        _angles(report, name, fixed, moving, 1 if quick else 3)
    for name, parts, sheet, rotations in _instances(quick):
        _placements(report, name, parts, sheet, rotations)
    if pyclipper is None:
        report.notes.append("pyclipper is not installed: pip install pyclipper")
    return report


# --- exact fits ---


def _fits(report: Report, count: int) -> None:
    """Count the exact fits that the no-fit polygons of each keep: a position that touches all around is outside."""
    cases = [*_exact_fits(count)]
    kept = {"cfree": 0, "shapely": 0, "pyclipper": 0}
    for fixed, moving, position in cases:
        kept["cfree"] += not nfp(fixed, moving).overlaps(position)
        kept["shapely"] += not _by_shapely(fixed, moving, 0.0).contains(shapely.Point(*position))
        if pyclipper is not None:
            kept["pyclipper"] += not _by_pyclipper(fixed, moving, 0.0).contains(shapely.Point(*position))
    shown = [f"{kept[name]} of {len(cases)}" for name in kept]
    report.rows.append(("exact fits kept", *(shown if pyclipper is not None else [*shown[:2], "-"])))
    report.figure("exact fits kept", "keys, slots, own holes", kept["cfree"] / len(cases), ">=", 1.0)


def _exact_fits(count: int) -> Iterator[tuple[Polygon, Polygon, tuple[float, float]]]:
    """Yield a key in its slot, and random triangles in holes of their own shape."""
    slot = Polygon([(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (3, 2), (3, 3), (0, 3)])
    yield slot, Polygon([(0, 0), (1, 0), (1, 1), (0, 1)]), (2.0, 1.0)
    draw = random.Random(0)
    for _ in range(count):
        x, y = draw.randint(-4, 4), draw.randint(-4, 4)
        ring = [(0, 0), (draw.randint(3, 9), draw.randint(0, 2)), (draw.randint(0, 2), draw.randint(3, 9))]
        hole = [(a + x, b + y) for a, b in ring]
        yield Polygon([(-20, -20), (20, -20), (20, 20), (-20, 20)], [hole]), Polygon(ring), (float(x), float(y))


def _by_shapely(fixed: Polygon, moving: Polygon, theta: float) -> Any:
    return shapely.union_all(sums_by_merging(pieces_of([moving]), pieces_of([fixed]), theta))


def _by_pyclipper(fixed: Polygon, moving: Polygon, theta: float) -> Any:
    """Return the union of the sums of outlines, as nesting programs compute it; holes of the fixed part are lost."""
    c, s = math.cos(theta), math.sin(theta)
    pattern = np.round(-SCALE * (moving.rings[0] @ np.array([[c, s], [-s, c]]))).astype(np.int64)
    path = np.round(SCALE * fixed.rings[0]).astype(np.int64)
    loops = pyclipper.MinkowskiSum(pattern.tolist(), path.tolist(), True)
    clip = pyclipper.Pyclipper()
    clip.AddPaths(loops, pyclipper.PT_SUBJECT, True)
    united = clip.Execute(pyclipper.CT_UNION, pyclipper.PFT_NONZERO, pyclipper.PFT_NONZERO)
    return shapely.Polygon(np.array(max(united, key=pyclipper.Area)) / SCALE)


# --- all angles ---


def _pairs() -> list[tuple[str, Polygon, Polygon]]:
    swim, shirts = (cfree.load_scene(SCENES / f"nest_{name}.json").obstacles for name in ("swim", "shirts"))
    plate = Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(2, 2), (2, 6), (6, 6), (6, 2)]])
    bracket = Polygon([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)])
    return [
        ("swim, 36 and 32 vertices", swim[0], swim[3]),
        ("shirts, 2 parts", shirts[0], shirts[40]),
        ("plate with a hole, bracket", plate, bracket),
    ]


def _angles(report: Report, name: str, fixed: Polygon, moving: Polygon, rounds: int) -> None:
    """Time 360 no-fit polygons as valid geometries, the preparation of all rivals included."""
    solids, robot = pieces_of([fixed]), pieces_of([moving])

    def own() -> None:
        RotationalNFP(fixed, moving).polygons(ANGLES)

    def rings() -> None:
        turning = RotationalNFP(fixed, moving)
        for theta in ANGLES:
            turning.slice(theta)

    def by_shapely() -> None:
        for theta in ANGLES:
            shapely.union_all(sums_by_merging(robot, solids, theta))

    def by_pyclipper() -> None:
        for theta in ANGLES:
            _by_pyclipper(fixed, moving, theta)

    calls = [own, rings, by_shapely, *([by_pyclipper] if pyclipper is not None else [])]
    times = timed(*calls, rounds=rounds)
    rival = times[3].text() if pyclipper is not None else "-"
    texts = f"{times[0].text()}; edges alone {times[1].text()}", times[2].text(), rival
    report.rows.append((f"360 angles, ms: {name}", *texts))
    report.figure("360 no-fit polygons: time of shapely's", name, times[2].best / times[0].best, ">=", 20.0)
    target = 20.0 if len(fixed) + len(moving) > 50 else 5.0
    report.figure("the same, edges alone", name, times[2].best / times[1].best, ">=", target)
    if pyclipper is not None:
        report.figure("the same, time of pyclipper's", name, times[3].best / times[0].best, ">=", 1.0)


# --- placements ---


def _instances(quick: bool) -> Iterator[tuple[str, list[Part], Polygon, int]]:
    layout = cfree.nesting.load_nesting(SCENES.parent / "drawings" / "nest.json")
    offcut = [Part(one.part.shapes, one.part.name) for one in layout.placed]
    yield "nest.json", offcut, Polygon([(0, 0), (40, 0), (40, 10), (0, 10)]), 4
    if quick:
        return
    for name, height, count in (("shirts", 40, 99), ("swim", 5752, 24)):
        shapes = [shape for shape in cfree.load_scene(SCENES / f"nest_{name}.json").obstacles if len(shape.rings) == 1]
        yield f"{name}, {count} parts", _grouped(shapes[:count]), _strip(shapes[:count], height), 2


def _grouped(shapes: list[Polygon]) -> list[Part]:
    """Return parts of shapes; those that are moved copies, up to the digits written, are one part."""
    parts: dict[Any, list[Any]] = {}
    for shape in shapes:
        x, y, *_ = shape.bounds
        key = tuple(map(tuple, np.round(shape.vertices - (x, y), 2).tolist()))
        parts.setdefault(frozenset(key), [shape, 0])[1] += 1
    return [Part(_at_origin(shape), f"part {k}", count) for k, (shape, count) in enumerate(parts.values())]


def _at_origin(shape: Polygon) -> Polygon:
    xs, ys = zip(*shape.exact_vertices, strict=True)
    return Polygon([(x - min(xs), y - min(ys)) for x, y in shape.exact_vertices])


def _strip(shapes: list[Polygon], height: int) -> Polygon:
    longest = max(shape.bounds[2] - shape.bounds[0] for shape in shapes)
    width = math.ceil(3 * sum(shape.area for shape in shapes) / height + longest)
    return Polygon([(0, 0), (width, 0), (width, height), (0, height)])


def _placements(report: Report, name: str, parts: list[Part], strip: Polygon, rotations: int) -> None:
    start = time.perf_counter()
    own = place(parts, strip, rotations=rotations, toward="left")
    middle = time.perf_counter()
    rival = _bottom_left(parts, strip, rotations)
    end = time.perf_counter()
    shares = [one.area / (one.box[2] * strip.bounds[3]) for one in (own, rival)]
    faults = [len(overlaps(one)) for one in (own, rival)]
    seconds = middle - start, end - middle
    texts = [
        f"{100 * share:.2f} % used, {wrong} overlaps, {spent:.0f} s"
        for share, wrong, spent in zip(shares, faults, seconds, strict=True)
    ]
    report.rows.append((f"placed: {name}", *texts, "-"))
    report.figure("area used, of the same fill in doubles", name, shares[0] / shares[1], ">=", 0.98)
    report.figure("overlaps", name, faults[0], "<=", 0)


def _bottom_left(parts: list[Part], strip: Polygon, rotations: int) -> Nesting:
    """Fill a strip from the left in doubles: each part at the leftmost, then lowest vertex of what shapely leaves."""
    x1, y1 = strip.bounds[2:]
    placed: list[tuple[Any, int, float, float]] = []
    sums: dict[tuple[int, int, int, int], Any] = {}
    result: list[Placed] = []
    order = [part for part in sorted(parts, key=lambda part: -part.area) for _ in range(part.quantity)]
    for part in order:
        best = None
        for k in range(rotations):
            theta = 2 * math.pi * k / rotations
            c, s = math.cos(theta), math.sin(theta)
            turned = part.shapes[0].vertices @ np.array([[c, s], [-s, c]])  # type: ignore[union-attr]
            (u0, v0), (u1, v1) = turned.min(axis=0), turned.max(axis=0)
            if v1 - v0 > y1 or u1 - u0 > x1:
                continue
            free = shapely.box(-u0, -v0, x1 - u1, y1 - v1)
            near = []
            for other, j, x, y in placed:
                key = id(other), j, id(part), k
                if key not in sums:
                    sums[key] = _sum(other, part, 2 * math.pi * j / rotations, theta)
                near.append(shapely.transform(sums[key], lambda xy, x=x, y=y: xy + np.array([x, y])))
            free = free.difference(shapely.union_all(near)) if near else free
            corners = shapely.get_coordinates(free)
            if len(corners):
                x, y = min(map(tuple, corners.tolist()))
                if best is None or (x + u1, y + v1) < best[0]:
                    best = (x + u1, y + v1), k, x, y
        if best is not None:
            _, k, x, y = best
            placed.append((part, k, x, y))
            result.append(Placed(part, (x, y, f"{360 * k / rotations}deg")))
    return Nesting([strip], result)


def _sum(fixed: Part, moving: Part, turned: float, theta: float) -> Any:
    solid, robot = fixed.shapes[0], moving.shapes[0]
    assert isinstance(solid, Polygon) and isinstance(robot, Polygon)
    c, s = math.cos(turned), math.sin(turned)
    outer, *holes = (ring @ np.array([[c, s], [-s, c]]) for ring in solid.rings)
    return _by_shapely(Polygon(outer, holes), robot, theta)


if __name__ == "__main__":
    for row in run(quick=False).rows:
        print(" | ".join(row))
