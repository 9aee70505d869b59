"""Compare plans among round shapes with a truth that is known from how the scenes are made.

    python tests/support/fuzz_round.py --count 1000 --seed 0

A robot goes through a gate, out of a slot, around in a hole, or from a contact; there is room, an exact fit, or too
little room by as little as 2**-60. Scenes are turned by Pythagorean angles, scaled, and moved by up to a billion. Each
answer is verified, in memory and from a file. Undecided answers are counted by family and room.
"""

from __future__ import annotations

import argparse
import random
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

import cfree
import cfree.verify
from cfree.curves import Arc, Circle

Point = tuple[Fraction, Fraction]
TINY = Fraction(1, 2**60)
GAPS = {  # beyond an exact fit
    "room": [Fraction(1, 10), Fraction(1, 4), Fraction(1, 50)],
    "little room": [Fraction(1, 1000), Fraction(1, 10**6), TINY],
    "exact": [Fraction(0)],
    "closed": [Fraction(-1, 50), Fraction(-1, 4)],
    "just closed": [-TINY, Fraction(-1, 10**6)],
}
ROOMS = ["room", "little room", "exact", "closed"] * 4 + ["just closed"]  # the last takes long
TURNS = [Fraction(0), Fraction(0), Fraction(1, 2), Fraction(-1, 3), Fraction(2, 3), Fraction(1), Fraction(1, 5)]
SHIFTS = [(Fraction(0), Fraction(0))] * 3 + [(Fraction(7, 3), Fraction(-11, 7)), (Fraction(10**9), Fraction(-(10**9)))]
SLIM = "half disc", "crescent", "box"  # robots that are less wide if they are turned
SCALES = [Fraction(1)] * 3 + [Fraction(1, 1000), Fraction(1000)]


@dataclass(frozen=True)
class Frame:
    """A turn, a scale and a shift of the plane."""

    tau: Fraction = Fraction(0)
    scale: Fraction = Fraction(1)
    shift: Point = (Fraction(0), Fraction(0))

    def at(self, p: Sequence[Any]) -> Point:
        (x, y), t = map(Fraction, p), self.tau
        c, s = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
        return self.scale * (c * x - s * y) + self.shift[0], self.scale * (s * x + c * y) + self.shift[1]

    def ring(self, ring: Any) -> Any:
        if isinstance(ring, Circle):
            return Circle(self.at(ring.center), Fraction(ring.radius) * self.scale)
        return [self._item(item) for item in ring]

    def _item(self, item: Any) -> Any:
        if not isinstance(item, Arc):
            return self.at(item)
        through, center = item.through and self.at(item.through), item.center and self.at(item.center)
        return Arc(self.at(item.to), through=through, center=center, clockwise=item.clockwise)

    def shape(self, shape: Any) -> Any:
        if not isinstance(shape, cfree.Curved):
            return [self.at(p) for p in shape]
        holes = [self.ring(hole) for hole in shape.holes]
        return cfree.Curved(self.ring(shape.path), holes, grown=shape.grown * self.scale)

    def pose(self, x: Any, y: Any, tau: Any = 0) -> cfree.Pose:
        a, b = Fraction(tau), self.tau
        turned = {"tau": "inf"} if a * b == 1 else {"tau": (a + b) / (1 - a * b)}
        return cfree.Pose(*self.at((x, y)), turned)


@dataclass
class Case:
    """A query, and what is true of it."""

    family: str
    room: str
    robot: list[Any]
    obstacles: list[Any]
    ends: list[tuple[Any, ...]]  # x, y, tau
    workspace: Any = None
    is_joined: bool | None = True  # None if that is not known
    clearance: Fraction | None = None
    name: str = field(default="")


def box(x0: Any, y0: Any, x1: Any, y1: Any) -> list[tuple[Any, Any]]:
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def stadium(a: Any, h: Any, x: Any = 0, y: Any = 0) -> cfree.Curved:
    """Half as long as a + h, along x."""
    arcs = Arc((x + a, y + h), center=(x + a, y)), Arc((x - a, y - h), center=(x - a, y))
    return cfree.Curved([(x - a, y - h), (x + a, y - h), arcs[0], (x - a, y + h), arcs[1]])


def rounded(x0: Any, y0: Any, x1: Any, y1: Any, r: Any) -> cfree.Curved:
    return cfree.Curved(box(x0 + r, y0 + r, x1 - r, y1 - r), grown=r)


def robot_of(rng: random.Random, h: Fraction) -> tuple[str, list[Any]]:
    """A robot 2 h wide in y; no wider anywhere that it is moved along x."""
    a = Fraction(rng.randint(1, 6), 4)
    robots: dict[str, Callable[[], list[Any]]] = {
        "disc": lambda: [cfree.Curved.circle((0, 0), h)],
        "stadium": lambda: [stadium(a, h)],
        "rounded": lambda: [rounded(-a - h, -h, a + h, h, h / rng.choice([2, 3, 7]))],
        "two discs": lambda: [cfree.Curved.circle((-a, 0), h), cfree.Curved.circle((a, 0), h)],
        "half disc": lambda: [cfree.Curved([(0, -h), Arc((0, h), center=(0, 0))])],
        "crescent": lambda: [cfree.Curved([(0, -h), Arc((0, h), center=(0, 0)), Arc((0, -h), through=(h / 2, 0))])],
        "box": lambda: [box(-a, -h, a, h)],
        "disc and box": lambda: [cfree.Curved.circle((a, 0), h), box(-a, -h / 2, a, h / 2)],
    }
    name = rng.choice([*robots])
    return name, robots[name]()


def gate(rng: random.Random) -> Case:
    """Two rooms with a gate between them."""
    room = rng.choice(ROOMS)
    gap, h = rng.choice(GAPS[room]), Fraction(rng.randint(4, 12), 8)
    clearance = Fraction(rng.randint(1, 4), 16) if rng.random() < 0.25 else None
    half = h + gap / 2 + (clearance or 0)
    robot, parts = robot_of(rng, h)
    thick = Fraction(rng.randint(1, 12), 4)
    walls: dict[str, Callable[[], list[Any]]] = {
        "discs": lambda: [
            *(cfree.Curved.circle((0, sign * (half + thick)), thick) for sign in (1, -1)),
            *(box(-thick / 2, y, thick / 2, z) for y, z in ((half + thick, 9), (-9, -half - thick))),
        ],
        "rounded": lambda: [rounded(-thick, y, thick, z, thick / 4) for y, z in ((half, 9), (-9, -half))],
        "boxes": lambda: [box(-thick, y, thick, z) for y, z in ((half, 9), (-9, -half))],
        "disc and box": lambda: [
            cfree.Curved.circle((0, half + thick), thick),
            box(-thick / 2, half + thick, thick / 2, 9),
            box(-thick, -9, thick, -half),
        ],
        "stadiums": lambda: [stadium(thick, 4, 0, sign * (half + 4)) for sign in (1, -1)],
    }
    names = [name for name in walls if name != "boxes" or robot != "box"]
    wall = rng.choice(names)
    far = thick + 13
    off = [Fraction(rng.randint(-8, 8), 4) for _ in range(2)] if rng.random() < 0.7 else [Fraction(0)] * 2
    turns = [rng.choice([0, 0, Fraction(1, 4), Fraction(-2, 3)]) for _ in range(2)]
    ends = [(-far + 5, off[0], turns[0]), (far - 5, off[1], turns[1])]
    space = box(-far, -8, far, 8)
    is_joined = gap >= 0 or (None if robot in SLIM else False)
    return Case(f"gate of {wall}", room, parts, walls[wall](), ends, space, is_joined, clearance, robot)


def corridor(rng: random.Random) -> Case:
    """A dumbbell, or a corridor alone."""
    room = rng.choice([name for name in ROOMS if name != "closed"])
    gap, h = rng.choice(GAPS[room]), Fraction(rng.randint(4, 12), 8)
    robot, parts = robot_of(rng, h)
    if robot == "box":
        robot, parts = "disc", [cfree.Curved.circle((0, 0), h)]
    half, length = h + gap / 2, Fraction(rng.randint(1, 12), 2)
    x, y = length + 8, Fraction(5)
    space = [(-x, -y), (-length, -y), (-length, -half), (length, -half), (length, -y), (x, -y)]
    space += [(-a, -b) for a, b in space]
    off = [Fraction(rng.randint(-4, 4), 4) for _ in range(2)] if rng.random() < 0.7 else [Fraction(0)] * 2
    ends = [(-length - 4, off[0], 0), (length + 4, off[1], 0)]
    return Case("corridor", room, parts, [], ends, space, gap >= 0 or (None if robot in SLIM else False), None, robot)


def lattice(rng: random.Random) -> Case:
    """A disc among equal discs on a square lattice."""
    room = rng.choice(ROOMS)
    gap = rng.choice(GAPS[room])
    r, radius = Fraction(rng.randint(2, 6), 8), Fraction(rng.randint(4, 8), 8)
    pitch, n = 2 * radius + 2 * r + gap, rng.choice([2, 3, 4])
    discs = [cfree.Curved.circle((pitch * i, pitch * j), radius) for i in range(n + 1) for j in range(n + 1)]
    cells = rng.sample([(i, j) for i in range(n) for j in range(n)], 2)
    ends = [((i + Fraction(1, 2)) * pitch, (j + Fraction(1, 2)) * pitch, 0) for i, j in cells]
    # the lattice ends at the walls: the gaps there are half as wide
    space = box(0, 0, n * pitch, n * pitch) if rng.random() < 0.5 else None
    is_joined = gap >= 0
    return Case("lattice", room, [cfree.Curved.circle((0, 0), r)], discs, ends, space, is_joined, None, f"disc {n}")


def slot(rng: random.Random) -> Case:
    """A peg leaves a round slot, of its own radius or a little larger."""
    room = rng.choice(["room", "little room", "exact"])
    gap, h, a = rng.choice(GAPS[room]), Fraction(rng.randint(4, 8), 8), Fraction(rng.randint(1, 4))
    w = h + gap / 2
    block = [(-a, -6), (2 * a, -6), (2 * a, -w), (-a, -w), Arc((-a, w), center=(-a, 0), clockwise=True)]
    block += [(2 * a, w), (2 * a, 6), (-a - 6, 6), (-a - 6, -6)]
    ends = [(0, 0, 0), (4 * a + 4 * h, rng.choice([0, 1]), rng.choice([0, Fraction(1, 3)]))]
    robot = rng.choice([stadium(a, h), cfree.Curved.circle((-a, 0), h)])
    return Case("slot", room, [robot], [cfree.Curved(block)], ends, None, True, None, "peg")


def turn(rng: random.Random) -> Case:
    """A robot turns in a hole, or about a pillar, of its own radius or with more room."""
    room = rng.choice(["room", "little room", "exact"])
    gap, r = rng.choice(GAPS[room]), Fraction(rng.randint(4, 8), 4)
    (x, y), far = (Fraction(rng.randint(-4, 4), 4) for _ in range(2)), 6
    half = cfree.Curved([(x, y - r), Arc((x, y + r), center=(x, y))])
    robots = {"disc": cfree.Curved.circle((x, y), r), "half disc": half}
    inner = r / 2
    claw = [(x, y - r), Arc((x, y + r), center=(x, y)), (x, y + inner)]
    robots["claw"] = cfree.Curved([*claw, Arc((x, y - inner), center=(x, y), clockwise=True)])
    robot = rng.choice([*robots])
    ends = [(0, 0, 0), (0, 0, 0)]
    for k, tau in enumerate(rng.sample([Fraction(0), Fraction(1), Fraction(1, 2), Fraction(-2)], 2)):
        c, s = (1 - tau * tau) / (1 + tau * tau), 2 * tau / (1 + tau * tau)
        ends[k] = (-c * x + s * y, -s * x - c * y, tau)
    hole = cfree.Curved(box(-far, -far, far, far), [Circle((0, 0), r + gap)])
    obstacles = [hole, *([cfree.Curved.circle((0, 0), inner - gap / 2)] if robot == "claw" and gap < r / 4 else [])]
    return Case("turn", room, [robots[robot]], obstacles, ends, None, True, None, robot)


def contact(rng: random.Random) -> Case:
    """Start or goal, or both, in contact; room everywhere else."""
    r = Fraction(rng.randint(2, 8), 4)
    robot = rng.choice([cfree.Curved.circle((0, 0), r), stadium(1, r), rounded(-2 * r, -r, 2 * r, r, r / 3)])
    pillar, floor = cfree.Curved.circle((6, 2 * r), r), box(-12, -4, 12, -r)
    touching = (6, 0, 0)
    ends = [touching, (-rng.choice([0, 1]), rng.choice([0, 1]), 0)]  # left of the pillar
    return Case("contact", "exact", [robot], [pillar, floor], ends, None, True, None, "any")


def bent(rng: random.Random) -> Case:
    """Two corridors at a right angle, with an exact fit in each: along two lines."""
    h = Fraction(rng.randint(4, 8), 8)
    gap = rng.choice([Fraction(0), Fraction(1, 100)])
    w = h + gap / 2
    space = [(-9, -w), (w, -w), (w, 9), (-w, 9), (-w, w), (-9, w)]
    ends = [(-6, 0, 0), (0, 6, 0)]
    room, disc = "room" if gap else "exact", cfree.Curved.circle((0, 0), h)
    return Case("bent", room, [disc], [], ends, space, True, None, "disc")


FAMILIES = [gate, gate, gate, gate, corridor, corridor, lattice, slot, turn, contact, bent]


def case_of(seed: int) -> tuple[Case, cfree.Scene, cfree.Pose, cfree.Pose, dict[str, Any]]:
    """Query of a seed, in a frame of its own, and its options."""
    rng = random.Random(f"round {seed}")
    case = rng.choice(FAMILIES)(rng)
    frame = Frame(rng.choice(TURNS), rng.choice(SCALES), rng.choice(SHIFTS))
    own = Frame(scale=frame.scale)
    space = None if case.workspace is None else frame.shape(case.workspace)
    scene = cfree.Scene([own.shape(part) for part in case.robot], [*map(frame.shape, case.obstacles)], workspace=space)
    ends = [
        pose if cfree.is_free(scene, pose) else frame.pose(*end[:2])
        for pose, end in ((frame.pose(*end), end) for end in case.ends)
    ]
    if rng.random() < 0.5:
        ends.reverse()
    options: dict[str, Any] = {"improve": 0.0}
    if rng.random() < 0.15:
        options = {"improve": rng.choice([None, 0.2]), "objective": rng.choice(["balanced", "clear", "short"])}
    if case.clearance:
        options["clearance"] = case.clearance * frame.scale
    return case, scene, ends[0], ends[1], options


def fault(seed: int) -> tuple[str, str]:
    """Kind of the answer, and its fault."""
    case, scene, start, goal, options = case_of(seed)
    kind = f"{case.family}, {case.room}"
    try:
        answer = cfree.plan(scene, start, goal, **options)
    except cfree.UndecidedError:
        return f"{kind}: undecided", ""
    kind = f"{kind}: {type(answer).__name__}"
    if isinstance(answer, cfree.Path) is (not case.is_joined) and case.is_joined is not None:
        return kind, f"{case.name}: the truth is {'a path' if case.is_joined else 'none'}"
    result = cfree.verify.answer(scene, answer)
    if not result.verified:
        return kind, f"{case.name}: refuted: {result.findings[:2]}"
    with tempfile.TemporaryDirectory() as folder:
        file = FilePath(folder, "answer.json")
        cfree.save(answer, file)
        if cfree.load(file) != answer:
            return kind, f"{case.name}: another answer when it is read"
        if not cfree.verify.answer(scene, file).verified:
            return kind, f"{case.name}: refuted from its file"
    return kind, ""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    counted, begin, wrong = Counter[str](), time.monotonic(), 0
    with suppress(KeyboardInterrupt):
        for seed in range(options.seed, options.seed + options.count):
            since = time.process_time()
            try:
                kind, text = fault(seed)
            except Exception as error:
                kind, text = "error", f"{type(error).__name__}: {error}"
            counted[kind] += 1
            if text or kind.endswith("undecided"):
                wrong += bool(text)
                seconds = time.process_time() - since
                print(f"scene {seed}: {kind}: {case_of(seed)[0].name}: {text} ({seconds:.1f} s)", flush=True)
    for kind, count in sorted(counted.items()):
        print(f"{count:5}  {kind}")
    print(f"{sum(counted.values())} scenes, {wrong} faults, {time.monotonic() - begin:.0f} s")


if __name__ == "__main__":
    main()
