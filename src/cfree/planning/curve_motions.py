"""Motions along curves of trapezoids and of isolated parts: rotations about a vertex, or slides along two contacts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from cfree.contact.kind import Kind
from cfree.exact.pose import Pose
from cfree.planning.double_contact import same_line, slide
from cfree.planning.exact_face import Contact, Sheet
from cfree.scene.features import unpacked

if TYPE_CHECKING:
    from cfree.collision.motion_checker import MotionChecker
    from cfree.collision.slide import Slide


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

    def along(self, pose: Pose, goal: Pose, sheet: Sheet, code: int) -> bool:
        """Is there one free motion to another pose on the same curve of a sheet?"""
        if int(unpacked(code)[0]) == Kind.VERTEX_VERTEX:
            return self.checker.joins([pose, goal])
        return self.slid(pose, goal, sheet.contact, code)
