"""Motions along curves of trapezoids and of isolated parts: rotations about a vertex, or slides along two contacts."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from cfree.contact.kind import Kind
from cfree.exact.pose import Pose
from cfree.planning.double_contact import same_line, slide
from cfree.planning.exact_face import Contact, Sheet
from cfree.scene.features import unpacked

if TYPE_CHECKING:
    from cfree.collision.motion_checker import MotionChecker
    from cfree.collision.slide import Slide

Numbers = tuple[int, int, int, int, int, int]  # x and y as quotients, and the direction of half the angle


class CurveMotions:
    """One free motion each.

    Parameters
    ----------
    slides : dict
        The slides found are added to it, by the poses that they join; `motion_between` joins all others.
    """

    def __init__(self, checker: MotionChecker, slides: dict[tuple[Pose, Pose], Slide]) -> None:
        self.checker = checker
        self.slides = slides

    def slid(self, pose: Pose, goal: Pose, contact: Contact, code: int) -> bool:
        """Is there a free slide to another pose along a curve of a contact's surface? It is noted then."""
        turn = (Pose(0, 0, {"tau": goal.tau}) @ Pose(0, 0, {"tau": pose.tau}).inverse()).tau
        if not turn:
            return False
        kind, i, j = map(int, unpacked(code))
        features = self.checker.features
        for other in same_line(features, (kind, i, j)):
            found = slide(features, pose, contact, other, turn)
            if found is not None and found.apply(pose) == goal and self.checker.is_free(pose, found):
                self.slides[pose, goal] = found
                return True
        return False

    def slid_by_numbers(self, pose: Sequence[int], goal: Sequence[int], contact: Sequence[int], code: int) -> bool:
        """The same, as the core asks it."""
        kind, i, j = contact
        return self.slid(from_numbers(pose), from_numbers(goal), (kind, i, j), code)

    def along(self, pose: Pose, goal: Pose, sheet: Sheet, code: int) -> bool:
        """Is there one free motion to another pose on the same curve of a sheet?"""
        if int(unpacked(code)[0]) == Kind.VERTEX_VERTEX:
            return self.checker.joins([pose, goal])
        return self.slid(pose, goal, sheet.contact, code)


def numbers_of(pose: Pose) -> Numbers:
    """A pose as the core takes it."""
    q, p = (0, 1) if pose.tau is None else (pose.tau.denominator, pose.tau.numerator)
    return pose.x.numerator, pose.x.denominator, pose.y.numerator, pose.y.denominator, q, p


def from_numbers(numbers: Sequence[int]) -> Pose:
    """A pose as the core gives it."""
    a, b, c, d, q, p = numbers
    return Pose(Fraction(a, b), Fraction(c, d), {"tau": Fraction(p, q) if q else None})
