"""Boundaries with one thing wrong; `python mutations.py SCENE.json ...` counts those that `verify` detects, by kind."""

from __future__ import annotations

import math
import random
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

import cfree.verify
from cfree import Boundary, boundary, load_scene
from cfree.exact.algebraic import Exact, Number
from cfree.forbidden.columns import COLUMNS, ISOLATED_COLUMNS, IsolatedParts, Trapezoids
from cfree.scene.features import unpacked
from cfree.verify import Verification
from cfree.verify.surfaces import Fault
from cfree.verify.trapezoids import Reader

Columns = dict[str, Any]
# changes columns; False if there is nothing to change
Mutation = Callable[[random.Random, Boundary, Columns], bool]
CONTACT = ("contact_kind", "contact_robot", "contact_obstacle")
ANGLE = ("first", "second", "lo", "hi", "place")


def columns_of(good: Boundary) -> Columns:
    """Copy the columns; those of isolated parts are one of them."""
    columns = {name: getattr(good.trapezoids, name).copy() for name in COLUMNS}
    columns |= {name: getattr(good, name).copy() for name in CONTACT}
    return columns | {"isolated": {name: getattr(good.isolated, name).copy() for name in ISOLATED_COLUMNS}}


def with_columns(good: Boundary, columns: Columns) -> Boundary:
    trapezoids = Trapezoids(**{name: columns[name] for name in COLUMNS})
    contacts, isolated = (columns[name] for name in CONTACT), IsolatedParts(**columns["isolated"])
    return Boundary(good.scene, good.features, *contacts, trapezoids, isolated, good.stats, good.trimmed)


def keep(columns: Columns, rows: Any) -> bool:
    for name in COLUMNS:
        columns[name] = columns[name][rows]
    return True


def pick(rng: random.Random, good: Boundary) -> int:
    return rng.randrange(len(good.trapezoids))


# --- trapezoids ---


def drop_one(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    return keep(columns, np.arange(len(good.trapezoids)) != pick(rng, good))


def drop_all(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    return keep(columns, slice(0, 0))


def duplicate_one(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    return keep(columns, np.sort([*range(len(good.trapezoids)), pick(rng, good)]))


def duplicate_all(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    return keep(columns, np.repeat(np.arange(len(good.trapezoids)), 2))


def move_to_another_patch(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    k, other = pick(rng, good), pick(rng, good)
    differs = bool(columns["patch"][k] != columns["patch"][other])
    columns["patch"][k] = columns["patch"][other]
    return differs


def change_the_chart(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    columns["chart"][pick(rng, good)] ^= 1
    return True


# --- curves ---


def swap_lower_and_upper(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    k = pick(rng, good)
    columns["lower"][k], columns["upper"][k] = columns["upper"][k], columns["lower"][k]
    return True


def swap_curves_of_two(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    k, side = pick(rng, good), columns[rng.choice(["lower", "upper"])]
    others = np.flatnonzero((columns["patch"] == columns["patch"][k]) & (side != side[k]))
    if len(others):
        side[k] = side[rng.choice(others.tolist())]
    return len(others) > 0


def swap_curves_of_two_patches(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    k, other, side = pick(rng, good), pick(rng, good), columns[rng.choice(["lower", "upper"])]
    differs = bool(side[k] != side[other])
    side[[k, other]] = side[[other, k]]
    return differs


def renamed(rng: random.Random, good: Boundary, code: int, *, of_robot: bool) -> int:
    """Another vertex or edge in a packed pair, one that names another point or line; the same if there is none."""
    kind, i, j = map(int, unpacked(code))
    shape, old, is_edge = (
        (good.features.robot, i, kind in (2, 4)) if of_robot else (good.features.obstacles, j, kind in (1, 4))
    )
    names = shape.core.line if is_edge else shape.core.point
    others = [k for k in range(len(shape.previous)) if names[k] != names[old]]
    if is_edge:
        others = [k for k in others if shape.v[k] != shape.w[k]]  # the reference point has no edge
    new = rng.choice(others) if others else old
    return kind << 61 | (new if of_robot else i) << 31 | (j if of_robot else new)


def change_a_feature(rng: random.Random, good: Boundary, column: Any) -> bool:
    k = pick(rng, good)
    old = int(column[k])
    column[k] = renamed(rng, good, old, of_robot=rng.random() < 0.5) if old else 0
    return int(column[k]) != old


def change_the_feature_of_a_curve(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    return change_a_feature(rng, good, columns[rng.choice(["lower", "upper"])])


def change_the_kind_of_a_curve(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    k, side = pick(rng, good), columns[rng.choice(["lower", "upper"])]
    kind, i, j = map(int, unpacked(int(side[k])))
    side[k] = (kind % 3 + 1) << 61 | i << 31 | j
    return True


def forget_a_curve(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    columns[rng.choice(["lower", "upper"])][pick(rng, good)] = 0
    return True


# --- angles ---


def swap_from_and_to(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    k = pick(rng, good)
    for name in ANGLE:
        start, stop = columns[f"from_{name}"], columns[f"to_{name}"]
        start[k], stop[k] = stop[k], start[k]
    return True


def take_another_angle(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    """Extend or shorten a trapezoid to another critical angle of its patch."""
    k, end, other = pick(rng, good), rng.choice(["from", "to"]), rng.choice(["from", "to"])
    near = (columns["patch"] == columns["patch"][k]) & (columns["chart"] == columns["chart"][k])
    near &= (columns[f"{other}_lo"] > columns[f"{end}_hi"][k]) | (columns[f"{other}_hi"] < columns[f"{end}_lo"][k])
    if not near.any():
        return False
    taken = rng.choice(np.flatnonzero(near).tolist())
    for name in ANGLE:
        columns[f"{end}_{name}"][k] = columns[f"{other}_{name}"][taken]
    return True


def move_an_interval(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    k, end = pick(rng, good), rng.choice(["from", "to"])
    lo, hi = columns[f"{end}_lo"], columns[f"{end}_hi"]
    by = float(hi[k] - lo[k]) * 1.5 + 2.0 ** -rng.randrange(10, 50)
    lo[k], hi[k] = lo[k] + by, hi[k] + by
    return True


def narrow_an_interval(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    """Narrow it to one of its ends: no root is left, if the end is none."""
    k, end = pick(rng, good), rng.choice(["from", "to"])
    lo, hi = columns[f"{end}_lo"], columns[f"{end}_hi"]
    was_wide = bool(lo[k] < hi[k])
    lo[k] = hi[k]
    return was_wide


def widen_an_interval(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    """Widen it to the whole chart, where that holds two roots or more."""
    for _ in range(50):
        k, end = pick(rng, good), rng.choice(["from", "to"])
        if roots_in_chart(good, k, end) > 1:
            columns[f"{end}_lo"][k], columns[f"{end}_hi"][k] = -1, 1
            return True
    return False


def change_a_place(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    columns[rng.choice(["from_place", "to_place"])][pick(rng, good)] += rng.randrange(1, 4)
    return True


def change_the_feature_of_an_angle(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    return change_a_feature(rng, good, columns[rng.choice([f"{e}_{n}" for e in ("from", "to") for n in ANGLE[:2]])])


def forget_the_name_of_an_angle(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    name, k = rng.choice(["from_first", "to_first"]), pick(rng, good)
    had_one = bool(columns[name][k])
    columns[name][k] = 0
    return had_one


# --- patches ---


def change_the_feature_of_a_patch(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    k = int(columns["patch"][pick(rng, good)])
    kind, i, j = (int(columns[name][k]) for name in CONTACT)
    old = kind << 61 | i << 31 | j
    new = renamed(rng, good, old, of_robot=rng.random() < 0.5)
    _, columns["contact_robot"][k], columns["contact_obstacle"][k] = unpacked(new)
    return new != old


def change_the_kind_of_a_patch(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    columns["contact_kind"][columns["patch"][pick(rng, good)]] ^= 3
    return True


# --- isolated parts ---


def drop_an_isolated_part(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    if not len(good.isolated):
        return False
    rows = np.arange(len(good.isolated)) != rng.randrange(len(good.isolated))
    columns["isolated"] = {name: column[rows] for name, column in columns["isolated"].items()}
    return True


def duplicate_an_isolated_part(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    if not len(good.isolated):
        return False
    k = rng.randrange(len(good.isolated))
    return add(columns, {name: column[k] for name, column in columns["isolated"].items()})


def invent_a_point(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    """Make one from a trapezoid: its corner; below, one of its walls, or one of its curves."""
    if (part := part_of(good, rng)) is None:
        return False
    part |= {f"to_{name}": part[f"from_{name}"] for name in (*ANGLE, "patch")} | {"upper": part["lower"]}
    return add(columns, with_ends(good, part))


def invent_a_segment(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    if (part := part_of(good, rng)) is None:
        return False
    part |= {f"to_{name}": part[f"from_{name}"] for name in (*ANGLE, "patch")}
    return add(columns, with_ends(good, part))


def invent_a_curve(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    part = part_of(good, rng)
    return part is not None and add(columns, with_ends(good, part | {"upper": part["lower"]}))


def lengthen_or_shorten_a_segment(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    """Move an end to another curve of its patch: one of the lengths of a v-e, e-v or v-v pair of the scene."""
    if not len(good.isolated):
        return False
    isolated, t = columns["isolated"], good.trapezoids
    k, (side, end) = rng.randrange(len(good.isolated)), rng.choice([("lower", "first"), ("upper", "last")])
    part = {name: column[k] for name, column in isolated.items()}
    curves = np.concatenate([t.lower, t.upper, isolated["lower"], isolated["upper"]])
    changed = with_ends(good, part | {side: rng.choice(curves.tolist())})
    if changed is None or abs(changed[f"{end}_t"] - part[f"{end}_t"]) < 1e-9:
        return False
    for name, column in isolated.items():
        column[k] = changed[name]
    return True


def turn_an_isolated_part(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    """Turn it to another critical angle, of a trapezoid or of another part; its curves stay."""
    if not len(good.isolated):
        return False
    isolated = columns["isolated"]
    k = rng.randrange(len(good.isolated))
    part = {name: column[k] for name, column in isolated.items()}
    other = part_of(good, rng)
    if other is None or rng.random() < 0.2:
        taken = rng.randrange(len(good.isolated))
        other = {name: column[taken] for name, column in isolated.items()}
    for name in (*ANGLE, "patch"):
        part[f"from_{name}"] = part[f"to_{name}"] = other[f"from_{name}"]
    same = part["from_lo"] == isolated["from_lo"][k] and part["chart"] == other["chart"]
    changed = with_ends(good, part | {"chart": other["chart"]})
    if same or changed is None:
        return False
    for name, column in isolated.items():
        column[k] = changed[name]
    return True


def change_the_patch_of_an_isolated_part(rng: random.Random, good: Boundary, columns: Columns) -> bool:
    """Change the patch to one of another line."""
    if not len(good.isolated):
        return False
    patch, k = columns["isolated"]["patch"], rng.randrange(len(good.isolated))
    old, patch[k] = patch[k], rng.randrange(len(good.contact_kind))
    reader = reader_of(good)
    return reader.surface(int(old)) != reader.surface(int(patch[k]))


def reader_of(good: Boundary) -> Reader:
    columns = good.contact_kind, good.contact_robot, good.contact_obstacle
    return Reader(good.scene, columns, good.trapezoids, good.isolated)


def part_of(good: Boundary, rng: random.Random) -> dict[str, Any] | None:
    """Make an isolated part from a trapezoid."""
    if not len(good.trapezoids):
        return None
    k = pick(rng, good)
    part = {name: getattr(good.trapezoids, name)[k] for name in COLUMNS}
    return part | {f"{column}_patch": part["patch"] for column in ("lower", "upper", "from", "to")}


def with_ends(good: Boundary, part: dict[str, Any]) -> dict[str, Any] | None:
    """Correct the rounded t of its ends; None if there are none."""
    reader = reader_of(good)
    # a table of one row, for the reader
    row: Any = SimpleNamespace(**{name: np.array([value]) for name, value in part.items()})
    try:
        for side, end, t in (("lower", "from", "first_t"), ("upper", "to", "last_t")):
            angle = reader.angle(row, 0, end, int(part[f"{end}_patch"]))
            curve = reader.curve(int(part[f"{side}_patch"]), int(part["chart"]), int(part[side]))
            part[t] = rounded(curve.at(angle.value))
    except (Fault, IndexError):
        return None
    return part


def rounded(x: Exact) -> float:
    return float(x.rounded(Fraction(1, 10**12)) if isinstance(x, Number) else x)


def add(columns: Columns, part: dict[str, Any] | None) -> bool:
    if part is None:
        return False
    isolated = columns["isolated"]
    columns["isolated"] = {
        name: np.append(column, np.array([part[name]], column.dtype)) for name, column in isolated.items()
    }
    return True


OF_TRAPEZOIDS: tuple[Mutation, ...] = (
    drop_one, drop_all, duplicate_one, duplicate_all, move_to_another_patch, change_the_chart, swap_lower_and_upper,
    swap_curves_of_two, swap_curves_of_two_patches, change_the_feature_of_a_curve, change_the_kind_of_a_curve,
    forget_a_curve, swap_from_and_to, take_another_angle, move_an_interval, narrow_an_interval, widen_an_interval,
    change_a_place, change_the_feature_of_an_angle, forget_the_name_of_an_angle, change_the_feature_of_a_patch,
    change_the_kind_of_a_patch,
)  # fmt: skip
OF_ISOLATED_PARTS: tuple[Mutation, ...] = (
    drop_an_isolated_part, duplicate_an_isolated_part, invent_a_point, invent_a_segment, invent_a_curve,
    lengthen_or_shorten_a_segment, turn_an_isolated_part, change_the_patch_of_an_isolated_part,
)  # fmt: skip
MUTATIONS = OF_TRAPEZOIDS + OF_ISOLATED_PARTS


def roots_in_chart(good: Boundary, k: int, end: str) -> int:
    """Number of roots in [-1, 1] of the polynomial that names an angle."""
    t = good.trapezoids
    first, second = (int(getattr(t, f"{end}_{name}")[k]) for name in ("first", "second"))
    if not first:
        return 0
    reader = reader_of(good)
    defining = reader.defining(first, second, reader.surface(int(t.patch[k])), int(t.chart[k]))
    values = np.roots([float(c) for c in reversed(defining)])
    return int(np.sum((abs(values.imag) < 1e-9) & (abs(values.real) < 1)))


# --- trying them ---


def mutants(good: Boundary, mutate: Mutation, count: int, seed: int = 0) -> Iterator[Boundary]:
    """Yield at most `count` boundaries that differ from a good one in content."""
    rng = random.Random(f"{mutate.__name__} {seed}")
    for _ in range(4 * count):
        columns = columns_of(good)
        if mutate(rng, good, columns):
            yield with_columns(good, columns)
            count -= 1
        if not count:
            return


def detected(bad: Boundary, slices: int = 2) -> Verification:
    return cfree.verify.boundary(bad, slices=slices)


def says_the_same(good: Boundary, bad: Boundary) -> bool:
    """True if the core judges that only names of curves and angles differ, and all places are the same."""
    t, s = good.trapezoids, bad.trapezoids
    if len(t) != len(s) or any(np.any(getattr(t, name) != getattr(s, name)) for name in ("patch", "chart")):
        return False
    if any(np.any(abs(getattr(t, name) - getattr(s, name)) > 1e-12) for name in ("tau_from", "tau_to")):
        return False
    if any(np.any(getattr(good, name) != getattr(bad, name)) for name in CONTACT):
        return False
    rows = np.arange(len(t))
    for share in (0.1, 0.37, 0.62, 0.9):
        theta = (1 - share) * t.theta_from + share * t.theta_to
        for mine, theirs in zip(good.limits(rows, theta), bad.limits(rows, theta), strict=True):
            if np.any(abs(mine - theirs) > 1e-9):
                return False
    ends = [[part_ends(b, k) for k in range(len(b.isolated))] for b in (good, bad)]
    return len(ends[0]) == len(ends[1]) and bool(np.all(abs(np.array(ends[0]) - np.array(ends[1])) < 1e-9))


def part_ends(boundary: Boundary, k: int) -> list[float]:
    """Ends of an isolated part: x, y and the direction theta of both."""
    ends = boundary.isolated_part(k).ends
    return [number for x, y, theta in ends for number in (x, y, math.cos(theta), math.sin(theta))]


def main(paths: list[str], count: int = 10) -> None:
    tried: Counter[str] = Counter()
    same: Counter[str] = Counter()
    caught: Counter[str] = Counter()
    by: dict[str, Counter[str]] = {}
    for path in paths:
        good = boundary(load_scene(Path(path)))
        for mutate in MUTATIONS:
            name = mutate.__name__.replace("_", " ")
            for bad in mutants(good, mutate, count):
                result = detected(bad, 12 if mutate in OF_ISOLATED_PARTS else 2)
                tried[name] += 1
                if not result.verified:
                    caught[name] += 1
                    by.setdefault(name, Counter()).update({finding.kind for finding in result.findings})
                elif says_the_same(good, bad):
                    same[name] += 1
    print("| mutation | tried | detected | only renamed | missed | found by |", "|---|--:|--:|--:|--:|---|", sep="\n")
    for name, number in tried.items():
        checks = ", ".join(f"{check} {n}" for check, n in by.get(name, Counter()).most_common(2))
        missed = number - same[name] - caught[name]
        print(f"| {name} | {number} | {caught[name]} | {same[name]} | {missed} | {checks} |")


if __name__ == "__main__":
    main(sys.argv[1:])
