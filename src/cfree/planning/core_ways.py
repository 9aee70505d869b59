"""Conversion of poses, paths and slides to and from the core's form."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from cfree.collision.slide import Slide, Touch
from cfree.contact.kind import Kind
from cfree.exact.pose import Pose, pose_at
from cfree.scene.features import SceneFeatures, ShapeFeatures

Numbers = tuple[int, int, int, int, int, int]  # x and y as quotients, and the direction of half the angle
Contact = Sequence[int]  # kind, robot and obstacle feature
Slides = dict[tuple[Pose, Pose], Slide]  # by the poses that they join; `motion_between` joins all others


def numbers_of(pose: Pose) -> Numbers:
    """Convert a pose to the core's numbers."""
    q, p = (0, 1) if pose.tau is None else (pose.tau.denominator, pose.tau.numerator)
    return pose.x.numerator, pose.x.denominator, pose.y.numerator, pose.y.denominator, q, p


def end_of(pose: Pose) -> tuple[Numbers, tuple[float, float, float]]:
    """Convert a pose to the core's numbers, and to doubles."""
    return numbers_of(pose), (float(pose.x), float(pose.y), pose.theta)


def from_numbers(numbers: Sequence[int]) -> Pose:
    """Convert the core's numbers to a pose."""
    a, b, c, d, q, p = numbers
    return pose_at(Fraction(a, b), Fraction(c, d), Fraction(p, q) if q else None)


def way_of(way: tuple[Sequence[Numbers], Sequence[Any]], features: SceneFeatures, slides: Slides) -> list[Pose]:
    """Convert a path from the core to poses; its slides are added to `slides`."""
    numbers, its_slides = way
    for start, goal, *slide in its_slides:
        slides[from_numbers(start), from_numbers(goal)] = slide_of(slide, features)
    return [*map(from_numbers, numbers)]


def slide_of(numbers: Any, features: SceneFeatures) -> Slide:
    """Convert a slide from the core, without the poses that it joins."""
    (first, last), x, y, d, q, p = numbers
    return Slide((_touch(features, first), _touch(features, last)), x, y, d, Fraction(p, q))


def _touch(features: SceneFeatures, contact: Contact) -> Touch:
    """Convert a contact from the core to the names of files."""
    kind, i, j = contact

    def feature(shape: ShapeFeatures, k: int) -> tuple[int, int]:
        return int(shape.owner_polygon[k]), int(shape.owner_vertex[k])

    robot, obstacle = feature(features.robot, i), feature(features.obstacles, j)
    return Touch("vertex-edge" if kind == Kind.VERTEX_EDGE else "edge-vertex", robot, obstacle)
