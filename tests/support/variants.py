"""Equivalent scenes: turned, mirrored, scaled and moved exactly, with the maps that lead there."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction

from exact_slices import Segments, ends, oriented, united
from oracles import exact_rotation
from shapes import PlainScene, Point, Shape, mapped

Map = Callable[[Point], Point]


@dataclass(frozen=True)
class Variant:
    """A scene whose boundary is the image of another's.

    Attributes
    ----------
    world : map of reference points, and of obstacles.
    turn : tan(theta/2) of the angle added to each orientation.
    mirrored : True if orientations change their sign, and left is right.
    same_axes : True if every edge keeps its direction, so that owners and the ends of charts are the same.
    """

    name: str
    plain: PlainScene
    world: Map
    turn: Fraction | None = Fraction(0)
    mirrored: bool = False
    same_axes: bool = True

    def half_tangent(self, tau: Fraction | None) -> Fraction | None:
        """Half-angle tangent in the variant of an orientation of the first scene."""
        return added(-tau if self.mirrored and tau else tau, self.turn)

    def image(self, segments: Segments) -> Segments:
        parts = [(self.world(p), self.world(q)) for p, q in ends(segments)]
        return united(oriented(q, p) if self.mirrored else oriented(p, q) for p, q in parts)


def added(first: Fraction | None, second: Fraction | None) -> Fraction | None:
    """Half-angle tangent of the sum of two angles."""
    if first is None or second is None:
        finite = second if first is None else first
        return Fraction(0) if finite is None else (-1 / finite if finite else None)
    return (first + second) / (1 - first * second) if first * second != 1 else None


def variants(plain: PlainScene) -> Iterator[Variant]:
    """Turned worlds, turned robots, both mirrored, both scaled, worlds far from the origin."""
    for tau in (Fraction(1),) if plain.bounds else (Fraction(1, 2), Fraction(1, 5)):  # bounds keep to the axes
        turn = rotation(tau)
        yield Variant(f"world turned by {tau}", changed(plain, turn, same), turn, tau, same_axes=False)
        yield Variant(f"robot turned by {tau}", changed(plain, same, turn), same, -tau, same_axes=False)
    mirror: Map = lambda p: (-p[0], p[1])  # noqa: E731
    yield Variant("mirrored", changed(plain, mirror, mirror), mirror, mirrored=True, same_axes=False)
    for factor in (Fraction(2) ** 30, Fraction(2) ** -30, Fraction(3) ** 20, Fraction(3) ** -20):
        scale = scaling(factor)
        yield Variant(f"scaled by {factor}", changed(plain, scale, scale), scale)
    far: Map = lambda p: (p[0] + 10**6, p[1] + 2**40)  # noqa: E731
    yield Variant("far away", changed(plain, far, same), far)


def same(p: Point) -> Point:
    return p


def rotation(tau: Fraction) -> Map:
    c, s = exact_rotation(tau)
    return lambda p: (c * p[0] - s * p[1], s * p[0] + c * p[1])


def scaling(factor: Fraction) -> Map:
    return lambda p: (factor * p[0], factor * p[1])


def changed(plain: PlainScene, world: Map, robot: Map) -> PlainScene:
    """Scene with one map for the robot, one for all else; corners of bounds stay corners."""

    def moved(shape: Shape, change: Map) -> Shape:
        return mapped(shape, lambda x, y: change((Fraction(x), Fraction(y))))

    bounds = None
    if plain.bounds:
        x0, y0, x1, y1 = map(Fraction, plain.bounds)
        (x0, x1), (y0, y1) = (sorted(axis) for axis in zip(world((x0, y0)), world((x1, y1)), strict=True))
        bounds = x0, y0, x1, y1
    return PlainScene(
        [moved(shape, robot) for shape in plain.robot],
        [moved(shape, world) for shape in plain.obstacles],
        bounds,
        plain.workspace and moved(plain.workspace, world),
    )
