"""Scenes with concave arcs that fit exactly, at random, against exact tests of poses: see `round_fits`.

python tests/support/hollow_fits.py --count 40
"""

from __future__ import annotations

import argparse
import dataclasses
import itertools
import random
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from fractions import Fraction as F
from typing import Any

import cfree
from cfree import Boundary, Curved, Scene
from cfree.curves import Arc, Circle
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose, pose_at
from cfree.forbidden.isolated import isolated_at
from cfree.scene.rounded import rounded_shapes
from round_fits import BESIDE, TURNS, Draw, Oracle, box, distance, points

Ring = Sequence[Any]  # points and arcs
MOST = 24  # poses on helices in one scene


def slot_ring(half: object, radius: object) -> Ring:
    """Ring of a slot along the x-axis whose ends are half circles about (-half, 0) and (half, 0)."""
    h, r = F(half), F(radius)  # type: ignore[arg-type]
    ends = Arc((h, r), center=(h, F(0))), Arc((-h, -r), center=(-h, F(0)))
    return [(-h, -r), (h, -r), ends[0], (-h, r), ends[1]] if h else Circle((F(0), F(0)), r)  # type: ignore[return-value]


def filleted(x0: object, y0: object, x1: object, y1: object, radius: object) -> Ring:
    """Ring of a rectangle whose corners are quarter circles."""
    a, b, c, d, r = (F(v) for v in (x0, y0, x1, y1, radius))  # type: ignore[arg-type]
    return [
        (a + r, b),
        (c - r, b),
        Arc((c, b + r), center=(c - r, b + r)),
        (c, d - r),
        Arc((c - r, d), center=(c - r, d - r)),
        (a + r, d),
        Arc((a, d - r), center=(a + r, d - r)),
        (a, b + r),
        Arc((a + r, b), center=(a + r, b + r)),
    ]


class HollowDraw(Draw):
    """Random scenes with arcs around the origin, in a random frame."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        if self.far[0] > 1000:  # doubles there tell nothing of smaller scenes apart
            self.factor = max(self.factor, F(1))

    def placed(self, ring: Ring, *, moves: bool) -> Ring:
        """The ring in the frame of the obstacles, or of the robot if it moves."""

        def place(p: ExactPoint) -> ExactPoint:
            (c, s), f = (F(1), F(0)) if moves else self.turned, self.factor
            (x0, y0), (a, b) = (F(0), F(0)) if moves else self.far, self.reference if moves else (F(0), F(0))
            x, y = F(p[0]) + a, F(p[1]) + b
            return f * (c * x - s * y) + x0, f * (s * x + c * y) + y0

        if isinstance(ring, Circle):
            return Circle(place(ring.center), self.factor * F(ring.radius))  # type: ignore[arg-type, return-value]

        def item(p: Any) -> Any:
            return dataclasses.replace(p, to=place(p.to), center=place(p.center)) if isinstance(p, Arc) else place(p)

        return [*map(item, ring)]

    def hollow(self, outer: Ring, holes: Sequence[Ring], *, moves: bool = False) -> Curved:
        """A shape with arcs in its rings."""
        return Curved(self.placed(outer, moves=moves), [self.placed(hole, moves=moves) for hole in holes])


# --- scenes ---


def hole(r: HollowDraw) -> Scene:
    """A disc in a round hole of its own radius, or of another; perhaps with pins that leave it one place, or none."""
    own = r.randint(1, 3)
    room = r.choice([own, own, own + 2, own + F(1, 2)])
    others: list[Any] = [r.hollow(box(-9, -9, 9, 9), [Circle((F(0), F(0)), F(room))])]  # type: ignore[list-item]
    if room == own + 2:  # the disc touches the hole where its center is 2 from the middle
        pin = r.choice([(F(-6, 5), F(-8, 5)), (F(2), F(0)), (F(8, 5), F(6, 5))])
        away = r.choice([F(1), F(1, 2)])  # pins inside of the hole, which the disc at `pin` touches
        for x, y in r.sample([(F(3, 5), F(4, 5)), (F(-3, 5), F(4, 5)), (F(1), F(0)), (F(0), F(-1))], r.randint(1, 2)):
            others.append(r.still(points((pin[0] - x * (own + away), pin[1] - y * (own + away))), away))
    return Scene([r.moving(points((0, 0)), own)], others)


def slot(r: HollowDraw) -> Scene:
    """A peg in a slot with round ends of its own radius: as long as the peg, longer, or shorter; perhaps more holes."""
    half, radius = r.parts(1, 4, 2), r.parts(1, 3, 2)
    longer = r.choice([F(0), F(0), F(1), F(-1, 4)])
    holes: list[Ring] = [slot_ring(half + longer, radius)]
    robot = [r.moving(points((-half, 0), (half, 0)), radius)]
    if r.random() < 0.3:  # a second peg in a hole of its own
        (x, y), second = r.choice([(F(0), F(12)), (F(-9), F(12)), (F(12), F(5))]), r.parts(1, 3, 2)
        robot.append(r.moving(points((x, y)), second))
        hole_of_second = Circle((x, y), second + r.choice([F(0), F(1, 2)]))
        holes.append(hole_of_second)  # type: ignore[arg-type]
    return Scene(robot, [r.hollow(box(-25, -25, 25, 25), holes)])


def bay(r: HollowDraw) -> Scene:
    """A disc, a stadium or a rounded box at a bay with a round end, mostly of its radius, which opens downwards."""
    radius, wide, deep = r.parts(1, 3, 2), r.choice([F(0), F(0), F(1)]), r.choice([F(0), F(1), F(3)])
    own, w, top = radius + r.choice([F(0), F(0), F(0), F(-1, 4)]), radius + wide, radius + 2
    ring: list[Any] = [(F(-9), top), (F(-9), -deep), (-w, -deep)]
    ring += [(-w, F(0))] if deep else []
    ring += [Arc((-wide, radius), center=(-wide, F(0)), clockwise=True)]
    ring += [(wide, radius)] if wide else []
    ring += [Arc((w, F(0)), center=(wide, F(0)), clockwise=True)]
    ring += [(w, -deep)] if deep else []
    ring += [(F(9), -deep), (F(9), top)]
    core = r.choice(
        [points((0, 0)), points((0, 0), (0, -2)), points((0, 0), (0, -1)), points((-1, 0), (1, 0)), box(-1, -2, 1, 0)]
    )
    return Scene([r.moving(core, own)], [r.hollow(ring, [])])


def room(r: HollowDraw) -> Scene:
    """A rounded rectangle in a rectangular hole with fillets, of its size or a little larger; radii equal or not."""
    a, b, radius = r.parts(1, 3, 1), r.parts(1, 3, 1), r.parts(1, 3, 2)
    fillet = r.choice([radius, radius, radius / 2, radius + F(1, 4)])
    more = r.choice([(F(0), F(0)), (F(0), F(0)), (F(1), F(0)), (F(0), F(1, 2))])
    w, h = a + radius + more[0], b + radius + more[1]
    core = r.choice([box(-a, -b, a, b), points((-a, 0), (a, 0)), box(-b, -a, b, a)])
    return Scene(
        [r.moving(core, radius)], [r.hollow(box(-20, -20, 20, 20), [filleted(-w, -h, w, h, min(fillet, w, h))])]
    )


def link(r: HollowDraw) -> Scene:
    """A robot with a round hole or a slot around pins of its radius, and perhaps a wall beside it."""
    half, radius = r.choice([F(0), F(1), F(3, 2)]), r.parts(1, 3, 2)
    longer = r.choice([F(0), F(0), F(1, 2)])
    robot = [r.hollow(box(-6, -5, 6, 5), [slot_ring(half + longer if half else F(0), radius)], moves=True)]
    others = [r.still(points((-half, 0), (half, 0)) if half else points((0, 0)), radius)]
    if r.random() < 0.5:
        others.append(r.still(box(-9, 5, 9, 6), 0))
    if r.random() < 0.3:
        others.append(r.still(box(6, -9, 7, 9), 0))
    return Scene(robot, others)


def pair(r: HollowDraw) -> Scene:
    """Two or three discs of the robot, and as many round holes, some of equal radii."""
    places = r.sample([(F(0), F(0)), (F(10), F(0)), (F(0), F(10)), (F(6), F(8)), (F(-8), F(6))], r.randint(2, 3))
    radii = [r.parts(1, 3, 2) for _ in places]
    holes = [Circle(p, radius + r.choice([F(0), F(0), F(1, 2)])) for p, radius in zip(places, radii, strict=True)]
    robot = [r.moving(points(p), radius) for p, radius in zip(places, radii, strict=True)]
    return Scene(robot, [r.hollow(box(-30, -30, 30, 30), holes)])  # type: ignore[arg-type]


def inscribed(r: HollowDraw) -> Scene:
    """A polygon, grown or not, or discs, with some corners on the rim of a round hole, or almost."""
    own, more = r.choice([F(0), F(0), F(1), F(1, 2)]), r.choice([F(0), F(0), F(0), F(1, 4)])
    around = [(5, 0), (3, 4), (0, 5), (-3, 4), (-4, 3), (-5, 0), (-3, -4), (0, -5), (3, -4), (4, -3)]
    chosen = sorted(r.sample(range(len(around)), r.randint(2, 4)))
    corners = points(*(around[k] for k in chosen))
    hole_of_all: Ring = Circle((F(0), F(0)), 5 + own + more)  # type: ignore[assignment]
    if len(corners) == 2:
        (x, y), (u, v) = corners
        turn = x * v - y * u  # seen from the middle, which is the third corner
        if turn < 0:
            corners.reverse()
        corners += points((0, 0)) if turn else points(((y - v) / 6, (u - x) / 6))
    if r.random() < 0.2:
        return Scene([r.hollow(box(-12, -12, 12, 12), [hole_of_all], moves=True)], [r.still(corners, own)])
    robot = [r.moving([p], own) for p in corners] if own and r.random() < 0.4 else [r.moving(corners, own)]
    return Scene(robot, [r.hollow(box(-12, -12, 12, 12), [hole_of_all])])


def extreme(r: HollowDraw) -> Scene:
    """Two discs of the robot, one or both in larger holes, as far apart as these or a wall allow, or almost."""
    apart, own, second = r.randint(3, 7), r.parts(1, 3, 2), r.parts(1, 3, 2)
    room, more = r.parts(1, 3, 2), r.choice([F(0), F(0), F(1)])
    (c, s), hair = r.choice(TURNS), r.choice([F(0), F(0), F(0), F(1, 2**16), -F(1, 2**16), F(1, 2)])
    far = apart + r.choice([1, 1, -1]) * (room + more) + hair
    far = max(far, room + more + own + second + F(1, 2))
    robot = [r.moving(points((0, 0)), own), r.moving(points((apart, 0)), second)]
    first: Ring = Circle((F(0), F(0)), own + room)  # type: ignore[assignment]
    if r.random() < 0.5:
        last: Ring = Circle((c * far, s * far), second + more)  # type: ignore[assignment]
    else:
        x0, half = far - second - more, F(second + 1)
        corners = [(x0, -half), (x0 + 2 * second + 2, -half), (x0 + 2 * second + 2, half), (x0, half)]
        last = [(c * x - s * y, s * x + c * y) for x, y in corners]
    return Scene(robot, [r.hollow(box(-25, -25, 25, 25), [first, last])])


def both(r: HollowDraw) -> Scene:
    """A robot with a hole around a pin, and a disc of it in a hole among the obstacles: concave arcs on both sides."""
    (x, y), first, second = r.choice([(F(12), F(0)), (F(0), F(15)), (F(-12), F(9))]), r.parts(1, 3, 2), r.parts(1, 3, 2)
    more = r.choice([F(0), F(0), F(1, 2)]), r.choice([F(0), F(0), F(1, 2)])
    ring = r.hollow(box(-4, -3, 3, 4), [Circle((F(0), F(0)), first + more[0])], moves=True)  # type: ignore[list-item]
    plate = box(x - 5, y - 4, x + 4, y + 5)
    others = [r.still(points((0, 0)), first), r.hollow(plate, [Circle((x, y), second + more[1])])]  # type: ignore[list-item]
    if r.random() < 0.3:
        others.append(r.hollow(box(-30, -30, 30, 30), [box(-25, -25, 25, 25)]))
    return Scene([ring, r.moving(points((x, y)), second)], others)


def part_of_disc(radius: Fraction, kind: str) -> Ring:
    """A half disc, a quarter, or a disc without a segment, of this radius about the origin."""
    r, o = radius, (F(0), F(0))
    if kind == "half":
        return [(F(0), r), Arc((F(0), -r), center=o)]
    if kind == "quarter":
        return [o, (r, F(0)), Arc((F(0), r), center=o)]
    return [(3 * r / 5, 4 * r / 5), Arc((3 * r / 5, -4 * r / 5), center=o)]


def shaft(r: HollowDraw) -> Scene:
    """A part of a disc in a round hole of its radius, or a larger one, or in a hole of its own shape."""
    own, kind = r.parts(1, 3, 2), r.choice(["half", "quarter", "cut"])
    ring = part_of_disc(own, kind)
    room = r.choice([own, own, own + F(1, 2), own * F(5, 4)])
    bored: Ring = Circle((F(0), F(0)), room) if r.random() < 0.6 else part_of_disc(r.choice([own, room]), kind)  # type: ignore[assignment]
    others = [r.hollow(box(-9, -9, 9, 9), [bored])]
    if r.random() < 0.4:
        others.append(r.still(box(-F(1, 4), own / 2, F(1, 4), own), 0))
    return Scene([r.hollow(ring, [], moves=True)], others)


def key(r: HollowDraw) -> Scene:
    """A peg with one round end in a slot: of its radius or another, as long as the slot or shorter."""
    half, radius = r.parts(1, 4, 2), r.parts(1, 3, 2)
    own = radius + r.choice([F(0), F(0), F(0), F(-1, 4)])
    flat = r.choice([-half - radius, -half, F(0), -half + F(1, 2)])
    ring = [(flat, -own), (half, -own), Arc((half, own), center=(half, F(0))), (flat, own)]
    return Scene([r.hollow(ring, [], moves=True)], [r.hollow(box(-25, -25, 25, 25), [slot_ring(half, radius)])])


def pocket(r: HollowDraw) -> Scene:
    """A rectangle with some round corners in a pocket with fillets, of its size or larger; radii equal or not."""
    w, h, radius = r.parts(2, 4, 1), r.parts(2, 4, 1), r.parts(1, 3, 2)
    more = r.choice([(F(0), F(0)), (F(0), F(0)), (F(1), F(0)), (F(0), F(1, 2))])
    fillet = r.choice([radius, radius, radius / 2, radius + F(1, 4)])
    corners = [(-w, -h, 1, 0, 0, 1), (w, -h, 0, 1, -1, 0), (w, h, -1, 0, 0, -1), (-w, h, 0, -1, 1, 0)]
    ring: list[Any] = []
    for x, y, a, b, c, d in corners:  # along the next side, and back along the last one
        if r.random() < 0.35:
            ring.append((x, y))
            continue
        before, after = (x + radius * c, y + radius * d), (x + radius * a, y + radius * b)
        ring += [before, Arc(after, center=(x + radius * (a + c), y + radius * (b + d)))]
    wide, high = w + more[0], h + more[1]
    bored = filleted(-wide, -high, wide, high, min(fillet, wide, high))
    return Scene([r.hollow(ring, [], moves=True)], [r.hollow(box(-25, -25, 25, 25), [bored])])


def slides(r: HollowDraw) -> Scene:
    """Discs of the robot in round holes and beside discs, so that all slide along one circle, or almost."""
    along, hair = F(r.randint(2, 4)), r.choice([F(0), F(0), F(0), F(1, 4), -F(1, 4)])
    places = points((0, 0), r.choice([(12, 0), (9, 12), (-12, 5)]), (0, 24), (0, 0))
    (x, y), (u, v) = places[1:3]
    places[3] = (x + u, y + v)
    robot, others = [], list[Any]()
    for k, p in enumerate(places[: r.choice([2, 3, 4, 4, 4])]):
        own = r.choice([F(1), F(1, 2), F(3, 2)])
        robot.append(r.moving(points(p), own))
        if k in (0, 3):
            room: Ring = Circle(p, along + own + (hair if k else 0))  # type: ignore[assignment]
            others.append(r.hollow(box(p[0] - 6, p[1] - 6, p[0] + 6, p[1] + 6), [room]))
        else:
            others.append(r.still(points(p), along - own))
    if r.random() < 0.5:  # something that leaves a part of the circle
        others.append(r.still(box(-2, along, F(1, 2), along + 1), r.choice([F(0), F(1, 2)])))
    return Scene(robot, [other for other in others if other is not None])


FAMILIES: dict[str, Callable[[HollowDraw], Scene]] = {
    f.__name__: f for f in (hole, slot, bay, room, link, pair, inscribed, extreme, both, shaft, key, pocket, slides)
}


def scene(family: str, seed: int) -> Scene:
    return FAMILIES[family](HollowDraw(f"hollow {family} {seed}"))


# --- the oracle ---


def centers(where: Scene) -> tuple[list[tuple[ExactPoint, Fraction]], list[tuple[ExactPoint, Fraction]]]:
    """Centers and radii of the arcs of both sides, below 0 if concave; the vertices of grown cores are arcs."""
    cores = rounded_shapes(where)
    assert cores is not None
    sides = []
    for shapes in (cores.robot, cores.obstacles):
        found = dict[tuple[ExactPoint, Fraction], None]()
        for shape in shapes:
            core = shape.core
            corners = core.vertices if hasattr(core, "vertices") else core
            found |= {((F(x), F(y)), shape.radius): None for x, y in corners}
            found |= {
                (arc.center, shape.radius + (arc.radius if not arc.beyond else -arc.radius)): None for arc in shape.arcs
            }
        sides.append([*found])
    return sides[0], sides[1]


def middles(centers_of_one: Sequence[tuple[ExactPoint, Fraction]], hollow: Fraction) -> Iterator[ExactPoint]:
    """Places at which two or three arcs touch a concave one of this radius from inside, the middle of their centers."""
    for some in itertools.chain.from_iterable(itertools.combinations(centers_of_one, n) for n in (2, 3)):
        if len({s for _, s in some}) > 1:
            continue
        (x, y), (u, v) = some[0][0], some[1][0]
        at = (x + u) / 2, (y + v) / 2
        if len(some) == 3:
            (a, b), (c, d) = (u - x, v - y), (some[2][0][0] - x, some[2][0][1] - y)
            if not (turn := 2 * (a * d - b * c)):
                continue
            p, q = a * a + b * b, c * c + d * d
            at = x + (d * p - b * q) / turn, y + (a * q - c * p) / turn
        if (at[0] - x) ** 2 + (at[1] - y) ** 2 == (hollow - some[0][1]) ** 2:
            yield at


class HollowOracle(Oracle):
    """Exact tests of poses, those on helices of equal radii as well."""

    def on_helices(self, seed: int) -> Iterator[Pose]:
        """Poses with the center of an arc on that of another of its radius, at simple angles and where others meet."""
        robot, obstacles = centers(self.scene)
        pairs = [(p, q) for p, s in robot for q, t in obstacles if s and s == -t]
        for q, t in obstacles:
            pairs += [(p, q) for p in middles([one for one in robot if one[1] >= 0], -t)] if t < 0 else []
        for p, t in robot:
            pairs += [(p, q) for q in middles([one for one in obstacles if one[1] >= 0], -t)] if t < 0 else []
        pairs = [*dict.fromkeys(pairs)]
        r = random.Random(seed)
        taus: dict[Fraction | None, None] = dict.fromkeys([F(0), F(1), F(-1), None])
        for c, s in TURNS:
            taus |= dict.fromkeys([s / (1 + c), -s / (1 + c), -(1 + c) / s if s else None, (1 + c) / s if s else None])
        taus |= dict.fromkeys(F(r.randint(-40, 40), 16) for _ in range(3))
        places = [(p, q, tau) for p, q in pairs for tau in taus]
        for (x, y), (u, v), tau in r.sample(places, min(MOST, len(places))):
            d = 1 + tau * tau if tau is not None else F(1)
            c, s = (F(-1), F(0)) if tau is None else ((1 - tau * tau) / d, 2 * tau / d)
            yield pose_at(u - c * x + s * y, v - s * x - c * y, tau)

    def on_arcs(self, seed: int) -> Iterator[Pose]:
        """Poses at which a concave arc's circle is that of two convex ones: the places of each are as far apart."""
        robot, obstacles = centers(self.scene)
        pairs = [(p, q, s + t) for p, s in robot for q, t in obstacles if s + t]
        hollow = [(p, q, rho) for p, q, rho in pairs if rho < 0]
        turned = dict[tuple[ExactPoint, ExactPoint, Fraction, Fraction, Fraction], None]()
        for (a, b, rho), (c, d, radius) in itertools.product(hollow, pairs):
            (x, y), (u, v) = (c[0] - a[0], c[1] - a[1]), (d[0] - b[0], d[1] - b[1])
            square = x * x + y * y
            if radius == -rho and square and square == u * u + v * v:
                turned[a, b, radius, (x * u + y * v) / square, (x * v - y * u) / square] = None
        r = random.Random(seed)
        for (x, y), (u, v), radius, c, s in r.sample([*turned], min(MOST, len(turned))):
            for p, q in [(F(1), F(0)), (F(0), F(-1)), *TURNS, *((-p, q) for p, q in TURNS)]:
                tau = None if c == -1 else s / (1 + c)
                yield pose_at(u - c * x + s * y + radius * p, v - s * x - c * y + radius * q, tau)

    def missing_on_helices(self, found: Boundary, seed: int) -> tuple[list[Pose], list[Pose], int]:
        """Free poses on helices and on arcs without room that no part holds; those listed with room; number without."""
        from cfree.planning.contact_fits import Fits

        fits, missing, roomy, number = Fits(self.scene), [], [], 0
        for pose in itertools.chain(self.on_helices(seed), self.on_arcs(seed)):
            if not self.arcs.is_free(pose):
                continue
            at = float(pose.x), float(pose.y), pose.theta
            is_listed = any(distance(line, at[:2]) < 1e-7 * self.size for line in isolated_at(found, pose.theta))
            has_room = bool(self.free_beside(at, BESIDE * self.size, turning=False)) or (
                not is_listed and self._has_room(fits, pose, at)
            )
            number += not has_room
            if is_listed and has_room:
                roomy.append(pose)
            slits = [line for line in found.slice(pose.theta).segments if distance(line, at[:2]) < 1e-6 * self.size]
            if not is_listed and not has_room and len(slits) < 2:
                missing.append(pose)
        return missing, roomy, number


def compared(family: str, seed: int, *, lines: bool = True) -> tuple[Boundary, list[str], int]:
    """The boundary of a scene, its faults, and how many fits were found without it."""
    where = scene(family, seed)
    found, oracle = cfree.boundary(where, threads=1), HollowOracle(where)
    missing, roomy, number = oracle.missing_on_helices(found, seed)
    faults = oracle.faults(found) + [f"missing {p}" for p in missing] + [f"has room {p}" for p in roomy]
    if lines:
        others, more = oracle.missing(found, seed)
        faults, number = faults + [f"missing {p}" for p in others], number + more
    return found, faults, number


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--families", nargs="*", default=[*FAMILIES])
    parser.add_argument("--fast", action="store_true", help="look on helices of equal radii alone for missing fits")
    options = parser.parse_args()
    scenes = parts = without = bad = refused = 0
    for seed in range(options.seed, options.seed + options.count):
        for family in options.families:
            try:
                found, faults, number = compared(family, seed, lines=not options.fast)
            except cfree.UnsupportedError:
                refused += 1
                continue
            scenes, parts, without, bad = scenes + 1, parts + len(found.isolated), without + number, bad + bool(faults)
            for fault in faults[:3]:
                print(family, seed, fault, flush=True)
    print(f"{scenes} scenes, {parts} parts, {without} poses found without them, {refused} refused, {bad} with faults")


if __name__ == "__main__":
    main()
