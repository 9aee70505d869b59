"""Poses, and ways with the slides on them, as the core takes and gives them."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from cfree.collision.slide import Slide, Touch
from cfree.contact.kind import Kind
from cfree.exact.pose import Pose
from cfree.scene.features import SceneFeatures, ShapeFeatures

Numbers = tuple[int, int, int, int, int, int]  # x and y as quotients, and the direction of half the angle
Contact = Sequence[int]  # kind, robot and obstacle feature
Slides = dict[tuple[Pose, Pose], Slide]  # by the poses that they join; `motion_between` joins all others


def numbers_of(pose: Pose) -> Numbers:
    """A pose as the core takes it."""
    q, p = (0, 1) if pose.tau is None else (pose.tau.denominator, pose.tau.numerator)
    return pose.x.numerator, pose.x.denominator, pose.y.numerator, pose.y.denominator, q, p


def end_of(pose: Pose) -> tuple[Numbers, tuple[float, float, float]]:
    """The same, and rounded."""
    return numbers_of(pose), (float(pose.x), float(pose.y), pose.theta)


def from_numbers(numbers: Sequence[int]) -> Pose:
    """A pose as the core gives it."""
    a, b, c, d, q, p = numbers
    return Pose(Fraction(a, b), Fraction(c, d), {"tau": Fraction(p, q) if q else None})


def way_of(found: tuple[Sequence[Numbers], Sequence[Any]], features: SceneFeatures, slides: Slides) -> list[Pose]:
    """Poses of a way that the core gives; the slides on it are added to those known."""
    numbers, on_it = found
    for start, goal, *slide in on_it:
        slides[from_numbers(start), from_numbers(goal)] = slide_of(slide, features)
    return [*map(from_numbers, numbers)]


def slide_of(found: Any, features: SceneFeatures) -> Slide:
    """A slide that the core gives, without the poses that it joins."""
    (first, last), x, y, d, q, p = found
    return Slide((_touch(features, first), _touch(features, last)), x, y, d, Fraction(p, q))


def _touch(features: SceneFeatures, contact: Contact) -> Touch:
    """A contact as files name it."""
    kind, i, j = contact

    def feature(shape: ShapeFeatures, k: int) -> tuple[int, int]:
        return int(shape.owner_polygon[k]), int(shape.owner_vertex[k])

    robot, obstacle = feature(features.robot, i), feature(features.obstacles, j)
    return Touch("vertex-edge" if kind == Kind.VERTEX_EDGE else "edge-vertex", robot, obstacle)
