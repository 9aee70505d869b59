"""Compact a layout: each part slides, and turns, towards one side until it touches; every motion is proved free."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal

from cfree.arguments import checked
from cfree.collision.arcs import curves_of
from cfree.collision.motion import Rotation, Translation
from cfree.collision.motion_checker import FirstContact, first_contact, is_free_motion
from cfree.contact.contact import EdgeVertex, VertexEdge
from cfree.curves.curved import Curved
from cfree.exact.half_angle import half_angle_rotation, sum_of_angles
from cfree.exact.number import ExactPoint, Number, simplest_between, to_fraction
from cfree.exact.pose import Pose
from cfree.nesting.checking import overlaps
from cfree.nesting.layout import Nesting, Part, Placed, around, shape_box, union, within
from cfree.scene.scene import AnyShape, Scene, size_of
from cfree.words import counted

SIDES = {"left": (-1, 0), "right": (1, 0), "down": (0, -1), "up": (0, 1)}
Side = Literal["left", "right", "down", "up"]
STEPS = 8  # most slides along contacts of one part in a pass
LEAST = Fraction(1, 10**6)  # share of the size: less is no progress
STEP_BACK = Fraction(1, 10**4)  # share of the size
MOST_TURN = math.radians(30)
BITS = 40  # of turns, and of positions of few digits
LONG = 100  # bits of a position above which one of few digits is taken
ROOM_BITS = 14  # of the distance, in shares of the size, of polygons from curves other than arcs
STILL = Fraction(0), Fraction(0)


@dataclass(frozen=True)
class PartMotion:
    """A motion of one part.

    Attributes
    ----------
    part : int
        Index in `Nesting.placed`.
    start : Pose
        Place before the motion.
    motion : Translation or Rotation
        Free as a whole, while all other parts stay.
    """

    part: int
    start: Pose
    motion: Translation | Rotation


@dataclass(frozen=True, repr=False)
class Compacted:
    """A layout after its compaction.

    Attributes
    ----------
    nesting : Nesting
    motions : tuple of PartMotion
        In their order: they lead from the given layout to this one, and no part ever enters another.
    """

    nesting: Nesting
    motions: tuple[PartMotion, ...]

    def __repr__(self) -> str:
        turns = sum(isinstance(each.motion, Rotation) for each in self.motions)
        motions = f"{counted(len(self.motions) - turns, 'slide')} and {counted(turns, 'turn')}"
        return f"<Compacted by {motions}: {self.nesting!r}>"


@checked
def compact(
    nesting: Nesting,
    direction: Side | tuple[Number, Number] = "left",
    *,
    turning: bool = True,
    passes: int = 4,
    progress: Callable[[float], object] | None = None,
) -> Compacted:
    """Slide and turn the parts of a layout towards one side until they touch, by motions proved free.

    Parameters
    ----------
    nesting : Nesting
        Without overlaps.
    direction : "left", "right", "down", "up", or (x, y)
    turning : bool
        Turn parts about a contact as well, if this moves their center in the direction.
    passes : int
        Greatest number of times that each part moves; it ends earlier if no part makes progress.
    progress : callable, optional
        Called with the completed share, from 0 to 1.

    Returns
    -------
    Compacted

    Raises
    ------
    ValueError
        If parts overlap, with the deepest pair; or if the direction has no length.

    Notes
    -----
    A part slides straight, then along the edge that stops it, and turns about the corner that touches. Slides between
    polygons end in exact contact; polygons around them replace parts with other curves than arcs. The order of the
    parts is that in which they lie in the direction. It is a descent: parts do not jump over others.

    Examples
    --------
    >>> from cfree.nesting.layout import Part
    >>> square = Part([(0, 0), (2, 0), (2, 2), (0, 2)], "square")
    >>> sheet = [(0, 0), (9, 0), (9, 2), (0, 2)]
    >>> result = compact(Nesting([sheet], [Placed(square, (1, 0, 0)), Placed(square, ("5.5", 0, 0))]), "left")
    >>> [str(one.pose.x) for one in result.nesting.placed], len(result.motions)
    (['0', '2'], 2)
    """
    x, y = (to_fraction(c) for c in (SIDES[direction] if isinstance(direction, str) else direction))
    if not (x or y):
        raise ValueError(f"direction: {direction}; give a vector that is not zero")
    if passes < 1:
        raise ValueError(f"passes: {passes}; give at least 1")
    if wrong := overlaps(nesting):
        raise ValueError(f"nesting: {wrong[0]}; free it first")
    given, motions = nesting, list[PartMotion]()
    nesting = _with_arcs(nesting)
    placed = list(nesting.placed)
    for n in range(passes):
        order = sorted(range(len(placed)), key=lambda k: -_front(placed[k], (x, y)))
        before = len(motions)
        for done, k in enumerate(order):
            mover = _Mover(nesting, placed, k, (x, y), turning)
            motions += [PartMotion(k, start, motion) for start, motion in mover.motions()]
            placed[k] = placed[k].at(mover.pose)
            if progress is not None:
                progress((n + (done + 1) / len(order)) / passes)
        if len(motions) == before:
            break
    if progress is not None:
        progress(1.0)
    places = [one.at(end.pose) for one, end in zip(given.placed, placed, strict=True)]
    return Compacted(Nesting(given.sheets, places, given.left, given.units, given.name), tuple(motions))


def _with_arcs(nesting: Nesting) -> Nesting:
    """Return a layout of lines and arcs: polygons replace other curves, a little larger ones parts, inner ones sheets.

    Whether two of the curves touch cannot be decided, so that their polygons keep a distance from them.
    """

    def larger(shape: AnyShape) -> list[AnyShape]:
        if curves_of(shape) is not None:
            return [shape]
        room = 2.0**-ROOM_BITS * size_of(shape)
        return [Curved(outer, holes, grown=room) for outer, *holes in (one.exact_rings for one in around([shape]))]

    parts = {id(one.part): [new for shape in one.part.shapes for new in larger(shape)] for one in nesting.placed}
    placed = [Placed(Part(parts[id(one.part)], one.part.name), one.pose, one.sheet) for one in nesting.placed]
    sheets = [sheet if curves_of(sheet) is not None else max(within([sheet]), key=size_of) for sheet in nesting.sheets]
    return Nesting(sheets, placed)


def _front(placed: Placed, direction: ExactPoint) -> float:
    """Return how far the box of a part reaches in a direction."""
    return max(
        float(x * direction[0] + y * direction[1])
        for x0, y0, x1, y1 in map(shape_box, placed.shapes)
        for x, y in ((x0, y0), (x1, y0), (x0, y1), (x1, y1))
    )


class _Mover:
    """One part that moves while the others stay."""

    def __init__(self, nesting: Nesting, placed: list[Placed], part: int, direction: ExactPoint, turning: bool) -> None:
        self.pose: Pose = placed[part].pose
        self.direction, self.turning = direction, turning
        self.shapes, sheet = placed[part].part.shapes, placed[part].sheet
        self.workspace = nesting.sheets[sheet] if nesting.sheets else None
        others = [one for k, one in enumerate(placed) if k != part and one.sheet == sheet]
        self.others = [(shape_box(shape), shape) for one in others for shape in one.shapes]
        own = [shape_box(shape) for shape in placed[part].shapes]
        sheets = [] if self.workspace is None else [shape_box(self.workspace)]
        x0, y0, x1, y1 = union([*own, *sheets, *(box for box, _ in self.others)])
        self.size = x1 - x0 + y1 - y0
        u0, v0, u1, v1 = union(map(shape_box, self.shapes))
        self.middle: ExactPoint = (u0 + u1) / 2, (v0 + v1) / 2
        self.radius = to_fraction(math.hypot(*(float(max(abs(a), abs(b))) for a, b in ((u0, u1), (v0, v1)))) * 1.001)

    def scene(self, vector: ExactPoint) -> Scene:
        """Return the part among all that a motion may meet: a turn where it is, or a translation by a vector."""
        (x, y), (dx, dy), r = (self.pose.x, self.pose.y), vector, 3 * self.radius
        low, high = (min(x, x + dx) - r, min(y, y + dy) - r), (max(x, x + dx) + r, max(y, y + dy) + r)
        near = [
            shape
            for (x0, y0, x1, y1), shape in self.others
            if x0 <= high[0] and y0 <= high[1] and x1 >= low[0] and y1 >= low[1]
        ]
        return Scene(self.shapes, near, workspace=self.workspace)

    def motions(self) -> Iterator[tuple[Pose, Translation | Rotation]]:
        """Yield proved motions, until none makes progress; `pose` is the place after the last."""
        for _ in range(STEPS):
            moved = False
            for motion in self._next():
                if is_free_motion(self.scene(motion.vector if motion.pole is None else STILL), self.pose, motion):
                    yield self.pose, motion
                    self.pose = motion.apply(self.pose)
                    moved = True
                    break
            if not moved:
                return

    def _next(self) -> Iterator[Translation | Rotation]:
        """Yield motions that may be made next, the best sort first."""
        straight, contact, scene = self._slid(self.direction)
        if straight is not None:
            yield straight
        if contact is None or contact.contact is None:
            return
        along = self._edge(scene, contact)
        if along is not None:
            side = along[0] * self.direction[0] + along[1] * self.direction[1]
            if side:
                slid, _, _ = self._slid(along if side > 0 else (-along[0], -along[1]))
                if slid is not None:
                    yield slid
        if self.turning and (pole := self._corner(scene, contact)) is not None:
            yield from self._turns(pole)

    def _slid(self, direction: ExactPoint) -> tuple[Translation | None, FirstContact | None, Scene]:
        """Return the longest free translation, if long enough, the contact that ends it, and the scene."""
        length = to_fraction(math.hypot(*map(float, direction)))
        whole = Translation((direction[0] * self.size / length, direction[1] * self.size / length))
        scene = self.scene(whole.vector)
        contact = first_contact(scene, self.pose, whole)
        if contact is None:
            return None, None, scene  # nothing is there to touch
        share = contact.at.neighbours(BITS)[0]
        if share < LEAST:
            return None, self._named(scene, whole, contact), scene
        motion = whole.until(share)
        if contact.width:  # among round shapes: the contact itself, if it is at a simple number
            nearer = whole.until(simplest_between(share, share + contact.width))
            motion = nearer if is_free_motion(scene, self.pose, nearer) else motion
        if max(map(_bits, motion.apply(self.pose).integers)) > LONG:
            motion = self._shorter(scene, motion)
        return motion, contact, scene

    def _shorter(self, scene: Scene, motion: Translation) -> Translation:
        """Return a translation that ends a little earlier at a place of few digits; the same if none is free."""
        (x, y), end = motion.vector, motion.apply(self.pose)
        unit = to_fraction(2.0 ** (math.frexp(float(self.size))[1] - BITS))
        length = to_fraction(math.hypot(float(x), float(y)))
        for back in (2, 8, 64, 1024):
            share = back * unit / length
            place = [round((c - share * d) / unit) * unit for c, d in ((end.x, x), (end.y, y))]
            short = Translation((place[0] - self.pose.x, place[1] - self.pose.y))
            if share < 1 and is_free_motion(scene, self.pose, short):
                return short
        return motion

    def _named(self, scene: Scene, whole: Translation, contact: FirstContact) -> FirstContact:
        """Return a contact that stops a part at once, with the features that touch: it is entered from a step back."""
        step = whole.until(STEP_BACK)
        back = step.reversed()
        if contact.contact is not None or not is_free_motion(scene, self.pose, back):
            return contact
        return (
            first_contact(scene, back.apply(self.pose), Translation((2 * step.vector[0], 2 * step.vector[1])))
            or contact
        )

    def _edge(self, scene: Scene, contact: FirstContact) -> ExactPoint | None:
        """Return the direction of the edge of a contact."""
        if isinstance(contact.contact, VertexEdge):
            return _other(scene, contact).exact_edge(contact.contact.j)  # type: ignore[no-any-return]
        if isinstance(contact.contact, EdgeVertex):
            (x, y), (c, s, w) = scene.robot[contact.robot].exact_edge(contact.contact.i), self.pose.rotation
            return Fraction(c * x - s * y, w), Fraction(s * x + c * y, w)
        return None

    def _corner(self, scene: Scene, contact: FirstContact) -> ExactPoint | None:
        """Return the vertex of a contact."""
        if isinstance(contact.contact, VertexEdge):
            vertex = scene.robot[contact.robot].exact_vertices[contact.contact.i]
            return self.pose.apply_exact([vertex])[0]
        if isinstance(contact.contact, EdgeVertex):
            return _other(scene, contact).exact_vertices[contact.contact.j]  # type: ignore[no-any-return]
        return None

    def _ended(self, tau: Fraction, pole: ExactPoint) -> Fraction:
        """Return the turn to a simple orientation nearby, such as a quarter turn, if that is free; else the same."""
        end = sum_of_angles(tau, self.pose.tau)
        if end is None:
            return tau
        simple = end.limit_denominator(1000)
        other = sum_of_angles(simple, None if self.pose.tau is None else -self.pose.tau)
        if other is None or abs(other - tau) > 2 * LEAST * abs(tau):
            return tau
        scene = self.scene(STILL)
        return other if is_free_motion(scene, self.pose, Rotation(pole, {"tau": other})) else tau

    def _turns(self, pole: ExactPoint) -> Iterator[Rotation]:
        """Yield a rotation about a contact that moves the middle of the part in the direction."""
        (middle,) = self.pose.apply_exact([self.middle])
        (x, y), (u, v) = (float(middle[0] - pole[0]), float(middle[1] - pole[1])), map(float, self.direction)
        wanted = math.atan2(x * v - y * u, x * u + y * v)
        angle = max(-MOST_TURN, min(MOST_TURN, wanted))
        tau = Fraction(math.tan(angle / 2)).limit_denominator(1000)
        if not tau:
            return
        whole = Rotation(pole, {"tau": tau})
        contact = first_contact(self.scene(STILL), self.pose, whole)
        if contact is not None:
            tau = self._ended(_shorter(whole.until(contact.at.neighbours(BITS)[0]).tau), pole)
        c, s, w = half_angle_rotation(tau)
        gain = (c - w) * (x * u + y * v) + s * (x * v - y * u)
        if tau and gain / w > float(LEAST * self.size) * math.hypot(u, v):
            yield Rotation(pole, {"tau": tau})


def _other(scene: Scene, contact: FirstContact) -> Any:
    return scene.workspace if contact.obstacle < 0 else scene.obstacles[contact.obstacle]


def _shorter(tau: Fraction | None) -> Fraction:
    """Return a tangent of few digits, nearer to 0 by little."""
    assert tau is not None  # turns are less than half a turn
    size = simplest_between(abs(tau) * (1 - LEAST), abs(tau)) if tau else tau
    return size if tau > 0 else -size


def _bits(number: int) -> int:
    return number.bit_length()
