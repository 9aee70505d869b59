"""Hypothesis strategies for exact shapes, poses and scenes; mostly degenerate ones."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from typing import Any

from hypothesis import strategies as st

import shapes
from shapes import PlainScene, Shape, box, monotone_ring, moved, quarter_turned, scaled


def fractions(limit: int = 8, denominator: int = 12) -> st.SearchStrategy[Fraction]:
    """Rationals in [-limit, limit] with small denominators, 0 and integers among them."""
    return st.fractions(-limit, limit, max_denominator=denominator)


def half_tangents() -> st.SearchStrategy[Fraction | None]:
    """tau = tan(theta/2): any angle, the multiples of a right angle often; None is the half turn."""
    right_angles = st.sampled_from([Fraction(0), Fraction(1), Fraction(-1), None])
    return st.one_of(right_angles, fractions(1), fractions(8))


def poses(limit: int = 12) -> st.SearchStrategy[tuple[Fraction, Fraction, Fraction | None]]:
    """Exact poses (x, y, tau)."""
    return st.tuples(fractions(limit), fractions(limit), half_tangents())


def point_sets(size: int = 6) -> st.SearchStrategy[list[tuple[int, int]]]:
    """3 to 9 distinct lattice points of a square, not all collinear."""
    points = st.tuples(st.integers(0, size), st.integers(0, size))
    chosen = st.lists(points, min_size=3, max_size=9, unique=True)
    return chosen.filter(lambda them: bool(monotone_ring(them)))


@st.composite
def convex_polygons(draw: st.DrawFn, size: int = 6) -> Shape:
    """Strictly convex, with small integer vertices."""
    points = draw(point_sets(size))
    return convex_ring(points), []


@st.composite
def simple_polygons(draw: st.DrawFn, size: int = 6) -> Shape:
    """Simple, mostly non-convex, with small integer vertices; neighbours may be collinear."""
    return quarter_turned((monotone_ring(draw(point_sets(size))), []), draw(st.integers(0, 3)))


@st.composite
def holed_polygons(draw: st.DrawFn, size: int = 5) -> Shape:
    """A box about one or two simple holes that keep clear of each other."""
    holes = [monotone_ring(draw(point_sets(size)))]
    if draw(st.booleans()):
        holes.append(moved((monotone_ring(draw(point_sets(size))), []), size + 1, 0)[0])
    outer = box(-1, -1, 1 + max(x for hole in holes for x, _ in hole), size + 1)[0]
    return quarter_turned((outer, [hole[::-1] for hole in holes]), draw(st.integers(0, 3)))


@st.composite
def fraction_polygons(draw: st.DrawFn) -> Shape:
    """Any of the above under a rational affine map that keeps orientation."""
    shape = draw(st.one_of(convex_polygons(), simple_polygons(), holed_polygons()))
    shear, stretch = draw(fractions(2)), draw(st.fractions(Fraction(1, 4), 4, max_denominator=9))
    dx, dy = draw(fractions()), draw(fractions())
    return shapes.mapped(shape, lambda x, y: (x + shear * y + dx, stretch * y + dy))


def polygons() -> st.SearchStrategy[Shape]:
    """Any valid polygon: convex, simple, holed, with rational vertices, nearly regular."""
    regular = st.builds(shapes.rational_regular, st.integers(3, 9), st.integers(1, 3))
    return st.one_of(convex_polygons(), simple_polygons(), holed_polygons(), fraction_polygons(), regular)


def boxes(size: int = 6) -> st.SearchStrategy[Shape]:
    side = st.integers(1, 4)
    corner = st.integers(0, size)
    return st.builds(lambda x, y, w, h: box(x, y, x + w, y + h), corner, corner, side, side)


def axis_parallel_scenes() -> st.SearchStrategy[PlainScene]:
    robots, obstacles = st.lists(boxes(2), min_size=1, max_size=2), st.lists(boxes(), min_size=1, max_size=4)
    return st.builds(_scene, robots, obstacles)


@st.composite
def congruent_scenes(draw: st.DrawFn) -> PlainScene:
    """Robot and obstacles are one shape, moved and turned by right angles: all edges pairwise parallel."""
    shape = draw(st.one_of(convex_polygons(4), simple_polygons(4)))

    def copy() -> Shape:
        turned = quarter_turned(shape, draw(st.integers(0, 3)))
        return moved(turned, draw(st.integers(-6, 6)), draw(st.integers(-6, 6)))

    return PlainScene([copy()], [copy() for _ in range(draw(st.integers(1, 3)))])


@st.composite
def collinear_scenes(draw: st.DrawFn) -> PlainScene:
    """Boxes that hang from one line, apart, touching or overlapping: their tops are one line's parts."""
    hung = []
    for x in draw(st.lists(st.integers(0, 10), min_size=2, max_size=4)):
        width, depth = draw(st.integers(1, 3)), draw(st.integers(1, 4))
        hung.append(box(x, -depth, x + width, 0))
    return PlainScene([draw(convex_polygons(3))], hung)


@st.composite
def touching_scenes(draw: st.DrawFn) -> PlainScene:
    """A convex polygon cut along diagonals from one vertex, some parts left out."""
    ring = draw(convex_polygons(8).filter(lambda shape: len(shape[0]) > 3))[0]
    fan = [([ring[0], p, q], []) for p, q in pairwise(ring[1:])]
    chosen = draw(st.lists(st.sampled_from(range(len(fan))), min_size=1, unique=True))
    return PlainScene([draw(simple_polygons(3))], [fan[k] for k in chosen])


def overlapping_scenes() -> st.SearchStrategy[PlainScene]:
    """Lattice shapes in one small square, repeated ones too."""
    crowd = st.lists(st.one_of(simple_polygons(4), convex_polygons(4)), min_size=2, max_size=4)
    return st.builds(_scene, st.lists(simple_polygons(3), min_size=1, max_size=2), crowd)


@st.composite
def fitting_scenes(draw: st.DrawFn) -> PlainScene:
    """A box with a hole of the robot's own shape; perhaps something in it."""
    shape = draw(st.one_of(convex_polygons(4), simple_polygons(4)))
    xs, ys = zip(*shape[0], strict=True)
    wall = box(min(xs) - 1, min(ys) - 1, max(xs) + 1, max(ys) + 1)[0], [shape[0][::-1]]
    others = draw(st.lists(st.one_of(convex_polygons(3), boxes(4)), max_size=2))
    return PlainScene([moved(shape, draw(st.integers(-5, 2)), draw(st.integers(-5, 2)))], [wall, *others])


@st.composite
def bounded_scenes(draw: st.DrawFn) -> PlainScene:
    """Bounds on the lattice, where walls are too."""
    x, y, width, height = draw(st.tuples(*[st.integers(-4, 4)] * 2, *[st.integers(1, 8)] * 2))
    return draw(scenes())._replace(bounds=(x, y, x + width, y + height))


@st.composite
def walled_scenes(draw: st.DrawFn) -> PlainScene:
    """A workspace with sides on those of obstacles, or as large as the robot."""
    plain = draw(scenes())
    return plain._replace(workspace=draw(st.one_of(boxes(), holed_polygons(), st.sampled_from(plain.robot))))


def generic_scenes() -> st.SearchStrategy[PlainScene]:
    small = fraction_polygons().map(lambda shape: scaled(shape, Fraction(1, 3)))
    obstacles = st.lists(fraction_polygons(), min_size=1, max_size=3)
    return st.builds(_scene, st.lists(small, min_size=1, max_size=2), obstacles)


def scenes() -> st.SearchStrategy[PlainScene]:
    """Small exact scenes without bounds, most of them degenerate."""
    return st.one_of(
        axis_parallel_scenes(),
        congruent_scenes(),
        collinear_scenes(),
        touching_scenes(),
        overlapping_scenes(),
        generic_scenes(),
    )


def _scene(robot: list[Shape], obstacles: list[Shape]) -> PlainScene:
    return PlainScene(robot, obstacles)


def convex_ring(points: list[tuple[Any, Any]]) -> list[tuple[Any, Any]]:
    """Hull of points not all collinear: counter-clockwise, strictly convex (gift wrapping)."""
    start = here = min(points)
    ring = []
    while not ring or here != start:
        ring.append(here)
        best = next(p for p in points if p != here)
        for p in points:
            (ux, uy), (vx, vy) = ((q[0] - here[0], q[1] - here[1]) for q in (best, p))
            turn = ux * vy - uy * vx
            if turn < 0 or (turn == 0 and abs(vx) + abs(vy) > abs(ux) + abs(uy)):
                best = p
        here = best
    return ring
