"""Poses and motions among shapes of segments and arcs, against oracles that share no code with the core.

Fine polygons with a known error decide most poses, winding numbers of convolutions those of one simply connected shape
about another. A far obstacle at 2**80 leaves doubles without digits, so that exact
numbers alone decide the same poses. Motions are compared with their poses, in steps and around the first contact, and
with the same motions backwards.
"""

from __future__ import annotations

import argparse
import math
import random
from fractions import Fraction
from typing import Any

import shapely
from shapely import affinity

import cfree
import convolution
from cfree import Curved
from cfree.collision.arcs import arcs_of
from cfree.collision.motion import Motion, Rotation, Translation
from cfree.curves import Arc
from cfree.exact.pose import Pose

FINE = 128  # chords of a quarter turn
FAR = 2**80


def point(random_: random.Random, size: int = 8, parts: int = 4) -> tuple[Fraction, Fraction]:
    """A point on a coarse grid, so that contacts are frequent."""
    return tuple(Fraction(random_.randint(-size * parts, size * parts), parts) for _ in range(2))  # type: ignore[return-value]


def stadium(r: random.Random) -> Curved:
    """A stadium, along an axis or aslant in Pythagorean directions."""
    (x, y), h, w = point(r), Fraction(r.randint(1, 6), 4), r.randint(1, 4)
    (a, b), (c, d) = r.choice([((1, 0), (0, 1)), ((Fraction(3, 5), Fraction(4, 5)), (Fraction(-4, 5), Fraction(3, 5)))])

    def at(u: Any, v: Any) -> tuple[Any, Any]:
        return x + u * a + v * c, y + u * b + v * d

    return Curved([at(0, -h), at(w, -h), Arc(at(w, h), center=at(w, 0)), at(0, h), Arc(at(0, -h), center=at(0, 0))])


def bay(r: random.Random) -> Curved:
    """A block with a half-round bay."""
    (x, y), h = point(r), Fraction(r.randint(1, 6), 4)
    path = [(-2, -2), (2, -2), (2, 0), (h, 0), Arc((-h, 0), center=(0, 0), clockwise=True), (-2, 0)]
    return moved(path, x, y)


def moved(path: list[Any], x: Any, y: Any) -> Curved:
    """The path elsewhere."""
    items: list[Any] = []
    for item in path:
        if isinstance(item, tuple):
            items.append((item[0] + x, item[1] + y))
        elif item.center:
            to, center = ((p[0] + x, p[1] + y) for p in (item.to, item.center))
            items.append(Arc(to, center=center, clockwise=item.clockwise))
        else:
            to, through = ((p[0] + x, p[1] + y) for p in (item.to, item.through))
            items.append(Arc(to, through=through))
    return Curved(items)


def cap(r: random.Random) -> Curved:
    """A chord and an arc through three points: any radius, also of more than half a turn."""
    while True:
        p, q, m = (point(r, 2) for _ in range(3))
        if (q[0] - p[0]) * (m[1] - p[1]) != (q[1] - p[1]) * (m[0] - p[0]):
            x, y = point(r, 5)
            return moved([p, Arc(q, through=m)], x, y)


def moon(r: random.Random) -> Curved:
    """Two arcs between two points, one convex and one concave."""
    (x, y), (a, b) = point(r), sorted(r.sample(range(1, 9), 2))
    return moved([(0, -1), Arc((0, 1), through=(Fraction(b, 4), 0)), Arc((0, -1), through=(Fraction(a, 4), 0))], x, y)


def fillet(r: random.Random) -> Curved:
    """A corner with a concave arc tangent to both sides: two cusps."""
    x, y = point(r)
    return moved([(0, 0), (1, 0), Arc((0, 1), center=(1, 1), clockwise=True)], x, y)


def disc(r: random.Random) -> Curved:
    return Curved.circle(point(r), Fraction(r.randint(1, 8), 4))


def ring_shape(r: random.Random) -> Curved:
    """A disc with a round hole."""
    (x, y), outer = point(r), r.randint(2, 6)
    hole = [(x + Fraction(outer, 2), y), Arc((x + Fraction(outer, 2), y), center=(x, y))]
    return Curved([(x + outer, y), Arc((x + outer, y), center=(x, y))], [hole])


def grown(r: random.Random) -> Curved:
    (x, y), a, b = point(r), r.randint(1, 3), r.randint(-1, 3)
    return Curved([(x, y), (x + a, y), (x + b, y + a)], grown=Fraction(r.randint(1, 6), 4))


def polygon(r: random.Random) -> cfree.Polygon:
    (x, y), a, b = point(r), r.randint(1, 3), r.randint(-1, 3)
    return cfree.Polygon([(x, y), (x + a, y), (x + b, y + a)])


KINDS = [stadium, bay, cap, moon, fillet, disc, ring_shape, grown, polygon]


def region(shape: Any) -> tuple[Any, float]:
    """A fine polygon for a shape, and the bound of its error."""
    if isinstance(shape, cfree.Polygon):
        return shape.to_shapely(), 0.0
    if shape.grown:
        base, radius = shape._base().to_shapely(), float(shape.grown)
        return base.buffer(radius, quad_segs=FINE), radius * (math.pi / 4 / FINE) ** 2 / 2
    rings, error = [], 0.0
    for curve in shape.curves:
        points = []
        for piece in curve:
            if hasattr(piece, "quarters"):
                u, v = (complex(*map(float, p)) for p in (piece.u, piece.v))
                sweep = piece.quarters * math.pi / 2 + 2 * math.atan(float(piece.rest))
                count, c = math.ceil(sweep / (math.pi / 2) * FINE), complex(*map(float, piece.center))
                points += [c + u * math.cos(sweep * k / count) + v * math.sin(sweep * k / count) for k in range(count)]
                error = max(error, abs(u) * (sweep / count) ** 2 / 8)
            else:
                points.append(complex(*map(float, piece.start)))
        rings.append([(p.real, p.imag) for p in points])
    return shapely.Polygon(rings[0], rings[1:]).buffer(0), error


def truth(robot: list[Any], others: list[Any], pose: Pose) -> bool | None:
    """True or False if fine polygons decide, else None."""
    x, y, t = float(pose.x), float(pose.y), pose.theta
    for a, e in robot:
        placed = affinity.affine_transform(a, [math.cos(t), -math.sin(t), math.sin(t), math.cos(t), x, y])
        for b, f in others:
            error = 2 * (e + f) + 1e-9
            if placed.distance(b) > error:
                continue
            both = placed.intersection(b)
            if both.buffer(-error).is_empty:
                return None
            return False
    return True


def by_winding(scene: cfree.Scene, pose: Pose) -> bool | None:
    """True or False by winding numbers of convolutions; None for shapes with holes or grown, and near contacts."""
    free: bool | None = True
    for a in scene.robot:
        for b in scene.obstacles:
            rims = []
            for shape in (a, b):
                if isinstance(shape, cfree.Polygon) or shape.holes or shape.grown:
                    return None
                (ring,) = shape.curves
                rims.append(convolution.features(ring))
            robot = convolution.reflected(rims[0], pose.theta)
            turns = convolution.winding(rims[1], robot, complex(float(pose.x), float(pose.y)))
            free = None if turns is None or free is None else free and turns == 0
    return free


def rational_pose(r: random.Random, size: int = 6) -> Pose:
    x, y = point(r, size, r.choice([4, 4, 3, 1000]))
    return Pose(x, y, {"tau": r.choice([0, 0, 1, Fraction(1, 2), Fraction(1, 3), Fraction(r.randint(-99, 99), 20)])})


def motion_of(r: random.Random) -> Motion:
    if r.random() < 0.5:
        return Translation(point(r, 6))
    return Rotation(
        point(r, 6), {"tau": r.choice([1, -1, Fraction(1, 2), "inf", Fraction(r.randint(-40, 40) or 1, 20)])}
    )


def scene_of(r: random.Random) -> cfree.Scene:
    robot: list[Any] = [r.choice(KINDS)(r) for _ in range(r.choice([1, 1, 2]))]
    return cfree.Scene(robot, [r.choice(KINDS)(r) for _ in range(r.randint(1, 3))])


def exactly(scene: cfree.Scene) -> cfree.Scene:
    """The scene with an obstacle so far away that doubles have no digits left."""
    far = [(FAR, FAR), (FAR + 1, FAR), (FAR, FAR + 1)]
    return cfree.Scene(scene.robot, [*scene.obstacles, far])


def run(seed: int, poses: int, motions: int) -> dict[str, int]:
    """Compare one scene's poses and motions with the oracles; return counts."""
    r = random.Random(seed)
    scene = scene_of(r)
    near, slow = arcs_of(scene), arcs_of(exactly(scene))
    assert near is not None and slow is not None
    robot, others = [region(s) for s in scene.robot], [region(s) for s in scene.obstacles]
    counts = {"poses": 0, "undecided by polygons": 0, "decided by winding numbers": 0, "motions": 0, "free motions": 0}
    for _ in range(poses):
        pose = rational_pose(r)
        free = near.is_free(pose)
        assert free == slow.is_free(pose), (seed, pose, free)
        known = truth(robot, others, pose)
        assert known in (None, free), (seed, pose, free, known)
        turns = by_winding(scene, pose)
        assert turns in (None, free), (seed, pose, free, turns)
        counts["poses"] += 1
        counts["decided by winding numbers"] += turns is not None
        counts["undecided by polygons"] += known is None
    for _ in range(motions):
        pose, motion = rational_pose(r), motion_of(r)
        _check_motion(seed, scene, pose, motion, counts)
    return counts


def _check_motion(seed: int, scene: cfree.Scene, pose: Pose, motion: Motion, counts: dict[str, int]) -> None:
    arcs = arcs_of(scene)
    assert arcs is not None
    place = seed, pose, motion
    free, contact = arcs.is_motion_free(pose, motion), arcs.first_contact(pose, motion)
    assert free == (contact is None), (place, free, contact)
    end = motion.apply(pose)
    assert arcs.is_motion_free(end, motion.reversed()) == free, place
    shares = [Fraction(k, 24) for k in range(25)]
    limit = Fraction(1) if contact is None else contact[0]
    for u in shares:
        if u <= limit:
            assert arcs.is_free(motion.at(pose, u)) or (contact is not None and limit == 0), (place, u, contact)
    if contact is not None and (contact[0] > 0 or arcs.is_free(pose)):
        low, high = contact[:2]
        assert high - low <= Fraction(1, 2**60), place
        assert arcs.is_free(motion.at(pose, low)), (place, contact)
        after = [min(Fraction(1), high + Fraction(1, 2**k)) for k in (20, 24, 28, 32, 36, 40)]
        assert any(not arcs.is_free(motion.at(pose, u)) for u in after), (place, contact)
        assert arcs.is_motion_free(pose, motion.until(low)), (place, contact)
    counts["motions"] += 1
    counts["free motions"] += free


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000, help="scenes")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--poses", type=int, default=100)
    parser.add_argument("--motions", type=int, default=20)
    options = parser.parse_args()
    total: dict[str, int] = {}
    for seed in range(options.seed, options.seed + options.count):
        for name, count in run(seed, options.poses, options.motions).items():
            total[name] = total.get(name, 0) + count
    print(", ".join(f"{count} {name}" for name, count in total.items()))


if __name__ == "__main__":
    main()
