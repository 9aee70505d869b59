"""Ways off a free pose, onto trapezoids that it can go on along: every cell in whose closure it is, is entered.

A pose on the boundary of a cell is on a trapezoid of it; if that begins or ends at the pose's orientation, a rotation
about the point of contact, or where it has no width there a slide along its curve, leads into it: these stay on it.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import TYPE_CHECKING

from cfree.contact.kind import Kind
from cfree.errors import InvariantError
from cfree.exact.pose import Pose
from cfree.planning.double_contact import same_line, slide
from cfree.planning.exact_face import Faces, Sheet, between
from cfree.planning.face_graph import Landing
from cfree.scene.features import unpacked

if TYPE_CHECKING:
    from cfree.collision.motion_checker import MotionChecker
    from cfree.collision.slide import Slide

MOST_HALVINGS = 4096  # of the way to the other end of a trapezoid: more than any scene needs


class Departures:
    """Ways off poses.

    Parameters
    ----------
    slides : dict
        The slides found are added to it, by the poses that they join; `motion_between` joins all others.
    """

    def __init__(self, faces: Faces, checker: MotionChecker, slides: dict[tuple[Pose, Pose], Slide]) -> None:
        self.faces = faces
        self.checker = checker
        self.slides = slides
        self._known: dict[Pose, dict[int, list[Landing]]] = {}

    def of(self, pose: Pose) -> dict[int, list[Landing]]:
        """Cells on whose boundary a free pose is, with the trapezoids there."""
        if pose not in self._known:
            found: dict[int, list[Landing]] = {}
            nearby = self.faces.space.nearby(pose)
            for face, end in zip(nearby.on, nearby.end, strict=True):
                way = self._inwards(self.faces.sheet(face), pose, end)
                found.setdefault(self.faces.cell_at(face), []).append(Landing(face, way))
            self._known[pose] = found
        return self._known[pose]

    def slid(self, pose: Pose, goal: Pose, sheet: Sheet, code: int) -> bool:
        """Is there a free slide to another pose along a curve of a sheet? It is noted then."""
        turn = (Pose(0, 0, {"tau": goal.tau}) @ Pose(0, 0, {"tau": pose.tau}).inverse()).tau
        if not turn:
            return False
        kind, i, j = map(int, unpacked(code))
        for other in same_line(sheet.features, (kind, i, j)):
            found = slide(sheet.features, pose, sheet.contact, other, turn)
            if found is not None and found.apply(pose) == goal and self.checker.is_free(pose, found):
                self.slides[pose, goal] = found
                return True
        return False

    def along_curve(self, pose: Pose, goal: Pose, sheet: Sheet, code: int) -> bool:
        """Is there one free motion to another pose on the same curve of a sheet?"""
        if int(unpacked(code)[0]) == Kind.VERTEX_VERTEX:
            return self.checker.joins([pose, goal])
        return self.slid(pose, goal, sheet, code)

    def _inwards(self, sheet: Sheet, pose: Pose, end: int) -> tuple[Pose, ...]:
        """From a pose on a trapezoid, which begins (-1) or ends (1) at its orientation or does not, to one within."""
        if end == 0:
            return (pose,)
        tau, far = sheet.local(pose), sheet.low if end > 0 else sheet.high
        lower, upper = sheet.limits(tau)
        t = sheet.t_of(pose, tau)
        if lower < upper and not lower < t < upper:
            t = between(lower, upper)
        begin = sheet.pose(t, tau)
        head = (pose,) if begin == pose else (pose, begin)
        if lower < upper:
            return (*head, self._shortened(tau, far, lambda to: self._turned(sheet, t, tau, to)))
        return (*head, self._shortened(tau, far, lambda to: self._along(sheet, begin, to)))

    def _shortened(self, tau: Fraction, far: Fraction, way: Callable[[Fraction], Pose | None]) -> Pose:
        """Where a way leads, to an orientation within: nearer and nearer to where it begins."""
        for _ in range(MOST_HALVINGS):
            far = between(min(tau, far), max(tau, far))
            if (found := way(far)) is not None:
                return found
        raise InvariantError("no way onto a trapezoid", state=(tau, far))

    def _turned(self, sheet: Sheet, t: Fraction, tau: Fraction, to: Fraction) -> Pose | None:
        """Turned about the point of contact, if that stays on the trapezoid."""
        lower, upper = sheet.limits(to)
        begin, end = sheet.pose(t, tau), sheet.turned(t, tau, to)
        return end if lower <= t <= upper and self.checker.joins([begin, end]) else None

    def _along(self, sheet: Sheet, begin: Pose, to: Fraction) -> Pose | None:
        """Along one of its curves."""
        for code, t in zip(sheet.codes, sheet.limits(to), strict=True):
            end = sheet.pose(t, to)
            if self.along_curve(begin, end, sheet, code):
                return end
        return None
