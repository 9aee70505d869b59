"""Questions, a scene with a start and a goal, whose answer is known or found hard; moved about without changing it.

A question is named by its family and number: the same name is the same question for ever.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Literal

import fuzz
from cfree import MotionChecker, Polygon, Pose, Scene
from cfree.errors import InvalidPolygonError
from compared import plain_of, scene_of
from shapes import PlainScene, Point, Shape, box, comb, l_shape, mapped, moved, random_lattice_shape

Verdict = Literal["path", "closed", "interior", "forbidden"]


@dataclass(frozen=True)
class Question:
    """A query for a path from start to goal.

    Attributes
    ----------
    known : the right answer, None if it is unknown
    origin : the question of which this is a carried copy
    """

    plain: PlainScene
    start: Pose
    goal: Pose
    known: Verdict | None = None
    origin: Question | None = None

    @property
    def scene(self) -> Scene:
        scene = scene_of(self.plain)
        return Scene(scene.robot, scene.obstacles, bounds=scene.bounds, workspace=scene.workspace,
                     start=self.start, goal=self.goal)  # fmt: skip

    @property
    def reversed(self) -> Question:
        return replace(self, start=self.goal, goal=self.start, origin=None)

    @classmethod
    def of(cls, scene: Scene) -> Question:
        assert scene.start and scene.goal
        return cls(plain_of(scene), scene.start, scene.goal)


# --- the same question elsewhere ---


def carried(question: Question, world: Pose, size: Fraction = Fraction(1), body: Pose | None = None) -> Question:
    """Scale all of it, then move the world, then change the robot's frame to one that stands in it as `body`.

    Bounds keep to the axes and to their reference point. With them the world turns by right angles and the frame's
    origin stays.
    """
    body = body or Pose(0, 0)
    back, plain = body.inverse(), question.plain

    def there(shape: Shape) -> Shape:
        return mapped(shape, lambda x, y: _at(world, size * x, size * y))

    def within(shape: Shape) -> Shape:
        return mapped(shape, lambda x, y: _at(back, size * x, size * y))

    def pose(q: Pose) -> Pose:
        return world @ Pose(size * q.x, size * q.y, {"tau": q.tau}) @ body

    bounds = None
    if plain.bounds:
        assert 0 in (world.cos, world.sin) and body.x == body.y == 0
        x0, y0, x1, y1 = (size * Fraction(v) for v in plain.bounds)
        (x0, x1), (y0, y1) = (sorted(axis) for axis in zip(_at(world, x0, y0), _at(world, x1, y1), strict=True))
        bounds = x0, y0, x1, y1
    moved_plain = PlainScene(
        [within(shape) for shape in plain.robot],
        [there(shape) for shape in plain.obstacles],
        bounds,
        plain.workspace and there(plain.workspace),
    )
    return Question(moved_plain, pose(question.start), pose(question.goal), question.known, question)


def _at(pose: Pose, x: Fraction | int, y: Fraction | int) -> Point:
    return pose.apply_exact([(Fraction(x), Fraction(y))])[0]


def elsewhere(rng: random.Random, question: Question) -> Question:
    """Carry it elsewhere, or not: turned by a long rational, far off, in another size, with another reference point."""
    tau: Fraction | None = rng.choice([Fraction(0), Fraction(1), None, fuzz.rational(rng, rng.randint(1, 8))])
    if rng.random() < 0.2:
        tau = fuzz.rational(rng, rng.randint(5, 40))
    x, y = rng.choice([(0, 0), (0, 0), (rng.randint(-9, 9), Fraction(1, 3)), (10**9, -(10**9)), (2**30, 7)])
    size = rng.choice([Fraction(1)] * 3 + [Fraction(2) ** rng.randint(-60, 60), fuzz.rational(rng, 3) ** 2])
    tilt = rng.choice([Fraction(0), Fraction(0), fuzz.rational(rng, 2), fuzz.rational(rng, 12)])
    away = rng.choice([(0, 0), (0, 0), (rng.randint(-100, 100), rng.randint(-100, 100)), (10**6, 1)])
    body = Pose(*away, {"tau": tilt})
    if question.plain.bounds:
        tau = rng.choice([Fraction(0), Fraction(1), None, Fraction(-1)])
        body = Pose(0, 0, {"tau": body.tau})
    shift = Fraction(x), Fraction(y)
    reach = Pose(size * body.x, size * body.y, {"tau": body.tau})
    return carried(question, Pose(*shift, {"tau": tau}), size, reach)


# --- known answers: fits that are exact, or not by a hair ---


def hair(rng: random.Random, *, negative: bool = True) -> Fraction:
    """0, or a power of two down to 2^-300, of either sign."""
    if rng.random() < 0.4:
        return Fraction(0)
    small = Fraction(1, 2 ** rng.choice([rng.randint(4, 20), rng.randint(20, 60), rng.randint(60, 300)]))
    return small * rng.choice([1, -1]) if negative else small


def blocks(rng: random.Random, a: Fraction | int, b: Fraction | int) -> list[Shape]:
    """A robot whose hull is the box [0, a] x [0, b]."""
    s, t = Fraction(a, 4), Fraction(b, 4)
    (u,), (v,) = [[(0, 0), (a, 0), (a, b), (a - s, b), (a - s, t), (s, t), (s, b), (0, b)]], [box(0, 0, a, b)[0]]
    hole = [(s, t), (s, b - t), (a - s, b - t), (a - s, t)]
    corners = [[(0, 0), (s, 0), (0, t)], [(a, 0), (a, t), (a - s, 0)], [(a, b), (a - s, b), (a, b - t)],
               [(0, b), (0, b - t), (s, b)]]  # fmt: skip
    one: list[Shape] = [(v, [])]
    return rng.choice([
        one, one, one, [(u, [])], [(v, [hole])], [box(0, 0, s, b), box(a - s, 0, a, b)], [(c, []) for c in corners],
        [box(0, 0, a, t), box(s, t, a - s, b - t), box(0, b - t, a, b)],
    ])  # fmt: skip


def within(rng: random.Random, robot: list[Shape], ring: list[Point], start: Pose, goal: Pose, known: Verdict | None
           ) -> Question:  # fmt: skip
    """Put a question in a region: the workspace, a hole of an obstacle, or (of a lattice region) nothing else."""
    if rng.random() < 0.5:
        return Question(PlainScene(robot, [], None, (ring, [])), start, goal, known)
    xs, ys = zip(*ring, strict=True)
    rim = box(min(xs) - 1, min(ys) - 1, max(xs) + 1, max(ys) + 1)[0]
    return Question(PlainScene(robot, [(rim, [ring[::-1]])]), start, goal, known)


def slot(rng: random.Random) -> Question:
    """A box of 1 x 1, 1 x 2 or 1 x 4 through a slot as wide as it, or not by a hair."""
    d, b = hair(rng), rng.choice([1, 1, 2, 4])
    w, long, room = 1 + d, 3 * b + 2, 2 * b + 2
    ring = [(-room, -room), (room, -room), (room, 0), (w, 0), (w, long), (room, long), (room, long + room),
            (-room, long + room), (-room, long), (0, long), (0, 0), (-room, 0)]  # fmt: skip
    known: Verdict = "path" if d >= 0 else "closed"
    goal = rng.choice([Pose(0, long + 1), Pose(-1, long + Fraction(1, 3))])
    start = rng.choice([Pose(0, -b), Pose(-1, -b - 1), Pose(-1, -b - Fraction(1, 7))])
    if b == 1 and rng.random() < 0.3:
        start = Pose(1, -2, {"tau": 1})
    return within(rng, blocks(rng, 1, b), ring, start, goal, known)


def room(rng: random.Random) -> Question:
    """A rectangle turns in a square room as wide as its diagonal is long, or not by a hair."""
    a, b, diagonal = rng.choice([(3, 4, 5), (5, 12, 13), (8, 15, 17), (4, 3, 5), (20, 21, 29)])
    d = hair(rng)
    s = diagonal * (1 + d)
    goal = rng.choice([Pose(b, 0, "90deg"), Pose(a, b, "180deg"), Pose(b, s - a, "90deg")])
    return within(rng, blocks(rng, a, b), box(0, 0, s, s)[0], Pose(0, 0), goal, "path" if d >= 0 else "closed")


def _in_box(rng: random.Random, w: int, h: int) -> list[Shape]:
    """A robot that reaches all four sides of the box [0, w] x [0, h]."""
    t = Fraction(1, 3)
    return rng.choice([
        [box(0, 0, w, h)], [([(0, 0), (w, 0), (0, h)], [])], [([(0, 0), (w, 0), (w, h)], [])],
        [([(0, 0), (w, 0), (w * t, h)], [])], [([(0, h * t), (w * t, 0), (w, h * t), (w * t, h)], [])],
        [([(0, 0), (w, 0), (w, h * t), (w * t, h * t), (w * t, h), (0, h)], [])],
        [([(0, 0), (w * t, 0), (w * t, h * t)], []), ([(w, h), (w * t, h), (w, h * t)], [])],
        blocks(rng, w, h),
    ])  # fmt: skip


def channel(rng: random.Random) -> Question:
    """Push through channels as wide as the robot: round one or two right-angled corners, or through a junction."""
    w, h = rng.choice([(1, 1), (1, 1), (2, 2), (1, 2), (3, 2)])
    x, y, more = w + rng.randint(1, 4), h + rng.randint(1, 4), rng.randint(1, 3)
    # a wider channel may let the robot turn; it is a path still
    d = rng.choice([Fraction(0), Fraction(0), hair(rng, negative=False)])
    w1, h1 = w + d, h + d
    elbow = [(0, 0), (x, 0), (x, h1), (w1, h1), (w1, y), (0, y)]
    bend = [(0, 0), (x, 0), (x, y - h1), (x + more, y - h1), (x + more, y), (x - w1, y), (x - w1, h1), (0, h1)]
    junction = [(more, 0), (more + w1, 0), (more + w1, y), (more + x, y), (more + x, y + h1), (0, y + h1), (0, y),
                (more, y)]  # fmt: skip
    ring, start, goal = rng.choice([
        (elbow, Pose(x - w, 0), Pose(0, y - h)),
        (bend, Pose(0, 0), Pose(x + more - w, y - h)),
        (junction, Pose(more, 0), Pose(0, y)),
        (junction, Pose(0, y), Pose(more + x - w, y)),
    ])  # fmt: skip
    if ring is bend and y < 2 * h1:
        ring, start, goal = elbow, Pose(x - w, 0), Pose(0, y - h)
    return within(rng, _in_box(rng, w, h), ring, start, goal, "path")


def peg(rng: random.Random) -> Question:
    """A stepped peg into a stepped hole, from above and turned."""
    d = hair(rng, negative=False)
    steps, ring, right = rng.randint(1, 3), [], []
    for k in range(steps):
        right += [(k + 1, 2 * k), (k + 1, 2 * k + 2)]
    ring = [*right, *[(-x, y) for x, y in reversed(right)]]
    hole = [(x + d, y) for x, y in right]
    top, wide = 2 * steps, 3 * steps + 5
    rim = [(-wide, top), *[(-x, y) for x, y in reversed(hole)], *hole, (wide, top), (wide, -1), (-wide, -1)]
    block = list(dict.fromkeys(rim))[::-1]
    start = Pose(0, top + rng.randint(0, 2), {"tau": rng.choice([Fraction(0), Fraction(0), Fraction(1), None])})
    if start.tau != 0:
        start = Pose(0, 4 * top + 2, {"tau": start.tau})
    return Question(PlainScene([(ring, [])], [(block, [])]), start, Pose(0, 0), "path")


def key(rng: random.Random) -> Question:
    """A polygon in a hole of its own shape, or one wider by a hair, does not get out of it."""
    shape = rng.choice([(random_lattice_shape(rng, 3, 5)[0], []), l_shape(), comb(2, 1), box(0, 0, 2, 1)])
    xs, ys = zip(*shape[0], strict=True)
    rim = box(min(xs) - 1, min(ys) - 1, max(xs) + 1, max(ys) + 1)[0]
    (x, y), grown = shape[0][0], 1 + (hair(rng, negative=False) if _is_convex(shape[0]) else 0)
    hole = [(x + grown * (u - x), y + grown * (v - y)) for u, v in shape[0]]
    return Question(PlainScene([shape], [(rim, [hole[::-1]])]), Pose(0, 0), Pose(max(xs) + 9, 0), "closed")


def _is_convex(ring: list[Point]) -> bool:
    return len(Polygon(ring).exact_vertices) == len(fuzz.convex_ring(ring))


def corner(rng: random.Random) -> Question:
    """A rod of 8 x 1 round a right angle: critical where it is level, in a corridor whose walls rise at 45 degrees."""
    d = hair(rng)
    w, far = 5 + d, 40
    ring = [(-far, -far), (-far, -far - w), (0, -w), (far, -far - w), (far, -far), (0, 0)]
    robot = [moved(shape, -4, 0) for shape in blocks(rng, 8, 1)]
    is_box = robot == [box(-4, 0, 4, 1)]  # others may have room for the inner corner
    known: Verdict | None = "path" if d >= 0 else "closed" if is_box else None
    return within(rng, robot, ring, Pose(-25, -28, "45deg"), Pose(25, -28, "-45deg"), known)


def gap(rng: random.Random) -> Question:
    """Nearly a disc, 6 wide at its narrowest, through a gap between two walls."""
    octagon = [(3, 2), (2, 3), (-2, 3), (-3, 2), (-3, -2), (-2, -3), (2, -3), (3, -2)]
    d = hair(rng)
    half = 3 + d / 2
    walls = [([(-1, half), (1, half), (1, 60), (-1, 60)], []), ([(-1, -half), (-1, -60), (1, -60), (1, -half)], [])]
    plain = PlainScene([(octagon, [])], walls, (-20, -20, 20, 20))
    return Question(plain, Pose(-10, 5), Pose(10, -5, "30deg"), "path" if d >= 0 else "closed")


# --- unknown answers ---


def random_question(rng: random.Random, plain: PlainScene) -> Question | None:
    """Question of two free poses, often on the lattice, at right angles, or in contact; if possible no simple path."""
    try:
        checker = MotionChecker(scene_of(plain))
    except InvalidPolygonError:
        return None
    free: list[Pose] = []
    for _ in range(60):
        pose = _pose(rng, plain)
        if pose in free or not checker.joins([pose, pose]):
            continue
        free.append(pose)
        for other in free[:-1]:
            if checker.first_free(simple_ways(other, pose)) is None:
                return Question(plain, other, pose)
        if len(free) == 5:
            break
    return Question(plain, *free[:2]) if len(free) > 1 else None


def simple_ways(start: Pose, goal: Pose) -> list[list[Pose]]:
    """A turn and a straight way in either order, and one motion."""
    turned, moved = (Pose(p.x, p.y, {"tau": q.tau}) for p, q in ((start, goal), (goal, start)))
    return [[start, turned, goal], [start, moved, goal], [start, goal]]


def _pose(rng: random.Random, plain: PlainScene) -> Pose:
    turns = [Fraction(0), Fraction(1), Fraction(-1), None, Fraction(rng.randint(-5, 5), rng.randint(1, 5))]
    tau = rng.choice(turns)
    world = [p for shape in [*plain.obstacles, *([plain.workspace] if plain.workspace else [])] for p in shape[0]]
    if plain.bounds:
        x0, y0, x1, y1 = plain.bounds
        if rng.random() < 0.5:
            x, y = rng.choice([x0, x1, (x0 + x1) / Fraction(2)]), rng.choice([y0, y1, (2 * y0 + y1) / Fraction(3)])
            return Pose(x, y, {"tau": tau})
        world = [(x0, y0), (x1, y1)]
    b = rng.choice(world or [(0, 0)])
    if rng.random() < 0.5:  # a vertex on a vertex
        a = rng.choice([p for shape in plain.robot for p in shape[0]])
        ra = _at(Pose(0, 0, {"tau": tau}), *a)
        return Pose(b[0] - ra[0], b[1] - ra[1], {"tau": tau})
    step = Fraction(1, rng.choice([1, 2, 7]))
    return Pose(b[0] + step * rng.randint(-9, 9), b[1] + step * rng.randint(-9, 9), {"tau": tau})


KNOWN: dict[str, Callable[[random.Random], Question]] = {
    f.__name__: f for f in (slot, room, channel, peg, key, corner, gap)
}
FAMILIES = (*KNOWN, *fuzz.KINDS)


def question(family: str, number: int) -> Question | None:
    """Question of a family; None where the scene is not valid, or free poses were not found."""
    rng = random.Random(f"{family} {number}")
    if family in KNOWN:
        asked: Question | None = KNOWN[family](rng)
    else:
        asked = random_question(rng, fuzz.scene(family, number))
    return asked and (elsewhere(rng, asked) if rng.random() < 0.6 else asked)
