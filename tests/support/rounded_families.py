"""Random scenes of rounded shapes, most of them full of ties: cores of fractions with radii, by families.

A core is a ring of points counter-clockwise, two points, or one. `scene(family, seed)` is the same for ever.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import NamedTuple

Point = tuple[Fraction, Fraction]
Core = tuple[Point, ...]
HALF = Fraction(1, 2)
TURNS = [(1, 0), (Fraction(3, 5), Fraction(4, 5)), (Fraction(-20, 29), Fraction(21, 29)), (0, 1), (-1, 0)]


class Shape(NamedTuple):
    """A core grown by a radius."""

    core: Core
    radius: Fraction


class RoundScene(NamedTuple):
    """Robot's parts, of one radius, and obstacles; a workspace or bounds of the reference point."""

    robot: tuple[Shape, ...]
    obstacles: tuple[Shape, ...]
    workspace: Core | None = None
    bounds: tuple[Fraction, ...] | None = None


def core(points: Iterable[tuple[object, object]]) -> Core:
    return tuple((Fraction(x), Fraction(y)) for x, y in points)  # type: ignore[arg-type]


def mapped(
    points: Core, x: object = 0, y: object = 0, turn: tuple[object, object] = (1, 0), factor: object = 1
) -> Core:
    """Points scaled and turned, then moved."""
    (c, s), f = (Fraction(v) for v in turn), Fraction(factor)  # type: ignore[arg-type]
    dx, dy = Fraction(x), Fraction(y)  # type: ignore[arg-type]
    return tuple((f * (c * px - s * py) + dx, f * (s * px + c * py) + dy) for px, py in points)


def rectangle(w: object, h: object) -> Core:
    """A rectangle around the origin, of half sides."""
    a, b = Fraction(w), Fraction(h)  # type: ignore[arg-type]
    return ((-a, -b), (a, -b), (a, b), (-a, b))


L_SHAPE = core([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])
U_SHAPE = core([(0, 0), (3, 0), (3, 2), (2, 2), (2, 1), (1, 1), (1, 2), (0, 2)])
T_SHAPE = core([(1, 0), (2, 0), (2, 1), (3, 1), (3, 2), (0, 2), (0, 1), (1, 1)])
Z_SHAPE = core([(0, 0), (2, 0), (2, 1), (3, 1), (3, 2), (1, 2), (1, 1), (0, 1)])
TRIANGLE = core([(0, 0), (2, 0), (0, 1)])
SQUARE = rectangle(HALF, HALF)
POINT = core([(0, 0)])


def regular(n: int, size: Fraction, digits: int = 12) -> Core:
    """A polygon of n corners on a circle, nearly regular and symmetric about the x-axis."""
    points = []
    for k in range(n):
        tau = Fraction(round(math.tan(math.pi * min(k, n - k) / n) * digits), digits) if 2 * k != n else None
        c, s = (Fraction(-1), Fraction(0)) if tau is None else ((1 - tau**2) / (1 + tau**2), 2 * tau / (1 + tau**2))
        points.append((size * c, size * (s if 2 * k < n else -s)))
    return tuple(points)


def frame(inner: Core, outer: Core, radius: Fraction) -> list[Shape]:
    """Pieces between two rings of equally many corners."""
    n = len(inner)
    return [Shape((outer[k], outer[(k + 1) % n], inner[(k + 1) % n], inner[k]), radius) for k in range(n)]


class Draw(random.Random):
    """Random numbers on lattices."""

    def on(self, low: object, high: object, parts: int = 2) -> Fraction:
        """A multiple of 1/parts between two numbers."""
        return Fraction(self.randint(math.ceil(Fraction(low) * parts), math.floor(Fraction(high) * parts)), parts)  # type: ignore[arg-type]

    def radius(self, parts: int = 4) -> Fraction:
        return self.on(Fraction(1, parts), 1, parts)

    def room(self) -> Fraction:
        """Room in a fit: none, a little more or less, or much."""
        return self.choice(
            [Fraction(0), Fraction(1, 2 ** self.randint(3, 60)), -Fraction(1, 2 ** self.randint(3, 60)), HALF]
        )

    def any_core(self) -> Core:
        """A small core at the origin."""
        length = self.on(HALF, 2)
        return self.choice(
            [
                POINT, core([(0, 0), (length, 0)]), core([(0, 0), (0, length)]),
                core([(0, 0), (length, self.on(0, 2))]), rectangle(self.on(HALF, 2), self.on(HALF, 1)),
                TRIANGLE, L_SHAPE, mapped(U_SHAPE, factor=HALF),
            ]
        )  # fmt: skip


def generic(r: Draw) -> RoundScene:
    """No ties but by chance."""

    def shape(size: int) -> Shape:
        points = mapped(r.any_core(), r.on(-size, size, 97), r.on(-size, size, 97), r.choice(TURNS), r.on(HALF, 1, 31))
        return Shape(points, r.on(Fraction(1, 8), 1, 53))

    one = r.random() < 0.5
    others = [shape(4) for _ in range(r.randint(1, 4))]
    return RoundScene((shape(1),), tuple(Shape(x.core, others[0].radius if one else x.radius) for x in others))


def lattice(r: Draw) -> RoundScene:
    """Equal discs on a lattice, gaps often as wide as the robot."""
    pitch, columns, rows = r.on(1, 3), r.randint(1, 3), r.randint(1, 2)
    s = r.choice([pitch / 4, pitch / 2, pitch / 3, pitch / 5])
    own = r.choice([pitch / 4, pitch / 2 - s, pitch / 8, pitch / 3]) or pitch / 8
    robot = r.choice(
        [POINT, core([(0, 0), (pitch, 0)]), core([(-pitch / 2, 0), (pitch / 2, 0)]), mapped(SQUARE, factor=pitch),
         core([(0, 0), (2 * pitch, 0)]), core([(0, 0), (pitch, 0), (0, pitch)]), core([(0, 0), (pitch / 2, 0)])]
    )  # fmt: skip
    others = [Shape(((pitch * k, pitch * m),), s) for k in range(columns) for m in range(rows)]
    return RoundScene((Shape(robot, own),), tuple(others))


def stadiums(r: Draw) -> RoundScene:
    """Stadiums on one axis or on parallel ones."""
    s, own, length = r.radius(), r.radius(), r.on(HALF, 2)
    robot = Shape(core([(r.choice([0, -length, -length / 2]), 0), (length, 0)]), own)
    others, x = [], Fraction(0)
    turn = r.choice(TURNS)
    for _ in range(r.randint(1, 3)):
        end = x + r.choice([length, r.on(HALF, 2)])
        y = r.choice([Fraction(0), 2 * (s + own), s + own, 2 * s])
        others.append(Shape(mapped(core([(x, y), (end, y)]), turn=turn), s))
        x = end + r.choice([2 * s, 2 * (s + own), HALF, s + own, Fraction(0)])
    return RoundScene((robot,), tuple(others))


def chain(r: Draw) -> RoundScene:
    """Discs that touch each other, or leave just the robot through."""
    own, x, y, others = r.radius(), Fraction(0), Fraction(0), list[Shape]()
    s = r.radius()
    for _ in range(r.randint(2, 5)):
        others.append(Shape(((x, y),), s))
        after = r.choice([s, r.radius()])
        c, d = r.choice(TURNS[:4])
        by = s + after + r.choice([Fraction(0), Fraction(0), 2 * own, own])
        x, y, s = x + by * c, y + by * d, after
    robot = r.choice(
        [POINT, core([(0, 0), (r.radius(), 0)]), mapped(SQUARE, factor=r.radius()), mapped(TRIANGLE, factor=HALF)]
    )
    return RoundScene((Shape(robot, own),), tuple(others))


def fit(r: Draw) -> RoundScene:
    """Rounded rectangles in rounded frames, exactly or almost."""
    w, h = r.on(HALF, 1, 4), r.on(Fraction(1, 4), 1, 4)
    own, s = r.on(0, HALF, 8), r.on(0, HALF, 8)
    if own + s == 0:
        own = Fraction(1, 8)
    a, b = w + own + s + r.room(), h + own + s + r.room()
    a, b = max(a, Fraction(1, 8)), max(b, Fraction(1, 8))
    others = frame(rectangle(a, b), rectangle(a + 1, b + 1), s)
    if r.random() < 0.4:
        others.pop()
    robot = rectangle(w, h) if r.random() < 0.6 else core([(-w, 0), (w, 0)]) if r.random() < 0.5 else POINT
    if len(robot) < 3 and own + s == 0:
        own = Fraction(1, 8)
    return RoundScene((Shape(robot, own),), tuple(others))


def letters(r: Draw) -> RoundScene:
    """Grown L, U, T and Z."""
    forms = [L_SHAPE, U_SHAPE, T_SHAPE, Z_SHAPE]
    own, s = r.choice([Fraction(1, 4), r.radius(8)]), r.choice([Fraction(1, 4), r.radius(8)])
    robot = mapped(r.choice([*forms, POINT, SQUARE]), r.on(-1, 1), r.on(-1, 1), factor=r.choice([HALF, 1]))
    others = [
        Shape(mapped(r.choice(forms), r.on(-4, 4), r.on(-4, 4), r.choice(TURNS[:2]), r.choice([HALF, 1])), s)
        for _ in range(r.randint(1, 2))
    ]
    return RoundScene((Shape(robot, own),), tuple(others))


def boxes(r: Draw) -> RoundScene:
    """Axis-parallel rectangles and segments on a lattice."""

    def box(size: int) -> Core:
        x, y, w, h = r.on(-size, size), r.on(-size, size), r.on(0, 2), r.on(0, 2)
        if w == 0 or h == 0:
            return core([(x, y), (x + w, y + h)]) if w + h else ((x, y),)
        return core([(x, y), (x + w, y), (x + w, y + h), (x, y + h)])

    own, s = r.on(Fraction(1, 4), 1, 4), r.on(Fraction(1, 4), 1, 4)
    others = [Shape(box(3), r.choice([s, s, s + Fraction(1, 4)])) for _ in range(r.randint(1, 4))]
    return RoundScene((Shape(box(1), own),), tuple(others))


def polygons(r: Draw) -> RoundScene:
    """Nearly regular polygons, some of them the robot's."""
    n, size = r.choice([3, 4, 5, 6, 8]), r.on(HALF, 2)
    form, own = regular(n, size), r.radius()
    others = []
    for _ in range(r.randint(1, 3)):
        other = form if r.random() < 0.6 else regular(r.choice([3, 4, 5, 6]), r.on(HALF, 2))
        others.append(Shape(mapped(other, r.on(-4, 4), r.on(-4, 4), r.choice(TURNS)), r.choice([own, own, r.radius()])))
    return RoundScene((Shape(form, own),), tuple(others))


def congruent(r: Draw) -> RoundScene:
    """One shape, turned and moved, as robot and as each obstacle."""
    form = r.choice(
        [TRIANGLE, L_SHAPE, SQUARE, rectangle(1, HALF), core([(0, 0), (2, 0)]), Z_SHAPE, core([(0, 0), (3, 0), (0, 4)])]
    )
    own = r.radius()
    turns = [(c, s) for c, s in TURNS]
    others = [Shape(mapped(form, r.on(-4, 4), r.on(-4, 4), r.choice(turns)), own) for _ in range(r.randint(1, 3))]
    return RoundScene((Shape(form, own),), tuple(others))


def collinear(r: Draw) -> RoundScene:
    """Edges on one line, on one or both sides, of one radius or moved to one line by several."""
    x, s, others = Fraction(0), r.radius(), list[Shape]()
    turn = r.choice(TURNS)
    for _ in range(r.randint(2, 4)):
        w, h = r.on(HALF, 2), r.choice([-1, 1, 1]) * r.on(HALF, 1)
        radius = r.choice([s, s, r.radius()])
        y = (s - radius) * (1 if h < 0 else -1)  # both rims on one line
        ring = core([(x, y), (x + w, y), (x + w, y + h), (x, y + h)])
        others.append(Shape(mapped(ring if h > 0 else ring[::-1], turn=turn), radius))
        x += w + r.choice([Fraction(0), 2 * s, HALF, 1])
    robot = r.choice([POINT, core([(0, 0), (1, 0)]), rectangle(HALF, HALF), TRIANGLE, L_SHAPE])
    return RoundScene((Shape(robot, r.radius()),), tuple(others))


def parts(r: Draw) -> RoundScene:
    """A robot of several parts, apart or not."""
    own, s = r.radius(8), r.radius()
    cores = [mapped(r.any_core(), r.on(-2, 2), r.on(-2, 2), factor=HALF) for _ in range(r.randint(2, 3))]
    others = [
        Shape(mapped(r.any_core(), r.on(-4, 4), r.on(-4, 4)), r.choice([s, s, r.radius()]))
        for _ in range(r.randint(1, 3))
    ]
    return RoundScene(tuple(Shape(c, own) for c in cores), tuple(others))


def radii(r: Draw) -> RoundScene:
    """Obstacles of different radii around one place, some of them 0."""
    others = []
    for _ in range(r.randint(2, 4)):
        form = mapped(r.any_core(), r.on(-3, 3), r.on(-3, 3))
        s = r.choice([Fraction(0), r.radius(), r.on(1, 4), Fraction(1, 64)])
        others.append(Shape(form, s))
    return RoundScene(
        (Shape(mapped(r.any_core(), r.on(-1, 1), r.on(-1, 1)), r.choice([Fraction(0), r.radius(8)])),), tuple(others)
    )


def grid(r: Draw) -> RoundScene:
    """Corners and radii on one coarse lattice, so that edges are as long as radii; some in 3-4-5 triangles."""

    def any_form() -> Core:
        a, b = r.randint(1, 2), r.randint(1, 2)
        return r.choice(
            [
                POINT, core([(0, 0), (a, 0)]), core([(0, 0), (0, a)]), core([(0, 0), (a, 0), (a, b), (0, b)]),
                core([(0, 0), (a, 0), (0, b)]), core([(0, 0), (3, 0), (0, 4)]), core([(0, 0), (4, 3)]), L_SHAPE,
            ]
        )  # fmt: skip

    def radius() -> Fraction:
        return r.choice([Fraction(0), HALF, Fraction(1), Fraction(1), Fraction(2), Fraction(5, 2)])

    own, s = r.choice([Fraction(0), HALF, Fraction(1)]), radius()
    others = [
        Shape(mapped(any_form(), r.randint(-3, 3), r.randint(-3, 3)), r.choice([s, s, radius()]))
        for _ in range(r.randint(1, 4))
    ]
    return RoundScene((Shape(mapped(any_form(), r.randint(-1, 1), r.randint(-1, 1)), own),), tuple(others))


def permanent(r: Draw) -> RoundScene:
    """A disc as the robot, its centre elsewhere: shapes touch from inside or outside at every angle, or meet."""
    own, others = r.choice([Fraction(0), HALF, Fraction(1)]), list[Shape]()
    for _ in range(r.randint(2, 5)):
        x, y = r.choice([(0, 0), (3, 0), (0, 4), (-3, 0), (0, -4), (2, 0), (0, 2), (4, 0), (1, 1)])
        form = r.choice(
            [POINT, POINT, core([(0, 0), (2, 0)]), core([(0, 0), (0, 2)]), rectangle(1, 1), rectangle(2, HALF)]
        )
        others.append(
            Shape(mapped(form, x, y), r.choice([Fraction(1), Fraction(2), Fraction(3), Fraction(4), Fraction(5), HALF]))
        )
    return RoundScene((Shape(core([r.choice([(0, 0), (1, 0), (3, 4)])]), own),), tuple(others))


def double(r: Draw) -> RoundScene:
    """Cores that are there twice, with one radius or several; parts of the robot twice."""
    form, own = mapped(r.any_core(), r.on(-1, 1), r.on(-1, 1)), r.radius()
    others = []
    for _ in range(r.randint(1, 2)):
        one = mapped(r.any_core(), r.on(-3, 3), r.on(-3, 3))
        s = r.radius()
        others += [Shape(one, s), Shape(one, r.choice([s, s, r.radius(), Fraction(0)]))]
        if len(one) > 2 and r.random() < 0.5:
            others.append(Shape((one[1], one[2]), s))
    robot = [form, r.choice([form, mapped(form, 1), form[:2]])] if r.random() < 0.5 else [form]
    return RoundScene(tuple(Shape(c, own) for c in robot), tuple(others))


FAMILIES: dict[str, Callable[[Draw], RoundScene]] = {
    f.__name__: f
    for f in (
        generic,
        lattice,
        stadiums,
        chain,
        fit,
        letters,
        boxes,
        polygons,
        congruent,
        collinear,
        parts,
        radii,
        grid,
        permanent,
        double,
    )
}


def all_mapped(
    scene: RoundScene, x: object = 0, y: object = 0, turn: tuple[object, object] = (1, 0), factor: object = 1
) -> RoundScene:
    """The scene in another frame: obstacles moved, the robot only scaled."""
    f = Fraction(factor)  # type: ignore[arg-type]
    assert scene.bounds is None or tuple(turn) == (1, 0)
    workspace = None if scene.workspace is None else mapped(scene.workspace, x, y, turn, f)
    dx, dy = Fraction(x), Fraction(y)  # type: ignore[arg-type]
    bounds = scene.bounds and tuple(f * v + d for v, d in zip(scene.bounds, (dx, dy, dx, dy), strict=True))
    return RoundScene(
        tuple(Shape(mapped(c, factor=f), f * s) for c, s in scene.robot),
        tuple(Shape(mapped(c, x, y, turn, f), f * s) for c, s in scene.obstacles),
        workspace, bounds,
    )  # fmt: skip


def with_other_reference(scene: RoundScene, x: Fraction, y: Fraction) -> RoundScene:
    """The robot's reference point elsewhere: it is at (-x, -y) of the old coordinates."""
    return scene._replace(robot=tuple(Shape(mapped(c, x, y), s) for c, s in scene.robot))


def mirrored(scene: RoundScene) -> RoundScene:
    """The scene with y turned over."""

    def over(points: Core) -> Core:
        ring = tuple((x, -y) for x, y in points)
        return ring[::-1] if len(ring) > 2 else ring

    bounds = scene.bounds and (scene.bounds[0], -scene.bounds[3], scene.bounds[2], -scene.bounds[1])
    return RoundScene(
        tuple(Shape(over(c), s) for c, s in scene.robot),
        tuple(Shape(over(c), s) for c, s in scene.obstacles),
        None if scene.workspace is None else over(scene.workspace), bounds,
    )  # fmt: skip


def swapped(scene: RoundScene) -> RoundScene | None:
    """The obstacles as the robot among its parts; None if they have several radii, or there are walls."""
    if scene.workspace or scene.bounds or len({s for _, s in scene.obstacles}) > 1:
        return None
    return RoundScene(scene.obstacles, scene.robot)


def with_radius_moved(scene: RoundScene, by: Fraction) -> RoundScene | None:
    """A part of the obstacles' radii given to the robot, which forbids the same poses; None if it cannot be."""
    own = scene.robot[0].radius + by
    others = [s - by for _, s in scene.obstacles]
    if scene.workspace or own < 0 or min(others, default=Fraction(0)) < 0:
        return None
    moved = zip(scene.obstacles, others, strict=True)
    return RoundScene(
        tuple(Shape(c, own) for c, _ in scene.robot), tuple(Shape(x.core, s) for x, s in moved), None, scene.bounds
    )


def is_defined(scene: RoundScene) -> bool:
    """True if some radius is above 0, and no two thin cores meet without one."""
    own = scene.robot[0].radius
    radii = [s for _, s in scene.obstacles]
    if not any([own, *radii]):
        return False
    thin = any(len(c) < 3 for c, _ in scene.robot)
    return own > 0 or not thin or all(s > 0 for s in radii)


def almost(r: Draw, made: RoundScene) -> RoundScene:
    """The scene with one obstacle a little off, in place or in radius: ties become near ties."""
    k, by = r.randrange(len(made.obstacles)), Fraction(r.choice([-1, 1]), 2 ** r.randint(10, 90))
    one = made.obstacles[k]
    if one.radius > 0 and r.random() < 0.5:
        other = Shape(one.core, one.radius + by)
    else:
        other = Shape(mapped(one.core, *r.choice([(by, 0), (0, by), (by, by)])), one.radius)
    return made._replace(obstacles=(*made.obstacles[:k], other, *made.obstacles[k + 1 :]))


def scene(family: str, seed: int) -> RoundScene:
    """A scene of a family, half of them changed: almost, far, turned by long rationals, walled in."""
    r = Draw(f"{family} {seed}")
    while True:
        made = FAMILIES[family](r)
        if is_defined(made):
            break
    x0, x1, y0, y1 = (f(p[k] for c, _ in made.obstacles for p in c) for k in (0, 1) for f in (min, max))
    by = r.on(HALF, 4)
    change = r.choice(["none"] * 6 + ["almost"] * 2 + ["far", "long", "turned", "bounds", "workspace", "reference"])
    if change == "almost":
        return almost(r, made)
    if change == "far":
        return all_mapped(made, 10**9, Fraction(-(10**9), 3))
    if change == "reference":
        return with_other_reference(made, Fraction(10**9), Fraction(10**9, 7))
    if change == "long":
        tau = Fraction(r.randint(1, 10**9), 10**9 + 7)
        turn = (1 - tau**2) / (1 + tau**2), 2 * tau / (1 + tau**2)
        return all_mapped(made, Fraction(r.randint(1, 10**20), 10**20 + 39), 0, turn)
    if change == "turned":
        return all_mapped(made, turn=r.choice(TURNS[1:3]))
    if change == "bounds":
        return made._replace(bounds=(x0 - by, y0 - by, x1 + r.on(HALF, 4), y1 + by))
    if change == "workspace":
        return made._replace(
            workspace=core([(x0 - by, y0 - by), (x1 + by, y0 - by), (x1 + by, y1 + by), (x0 - by, y1 + by)])
        )
    return made
