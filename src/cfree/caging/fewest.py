"""The fewest of given finger places that cage a body, with a proof that fewer do not.

A path out among some fingers is blocked by others. Every cage has one of these, or the body would leave it on that
path. So a cage hits the blocking fingers of each path, and a smallest set that hits those of all paths found so far has
no more fingers than any cage. If it cages, it is a smallest cage; else its path out is one more to hit.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

from cfree.arguments import checked
from cfree.caging.cage import Cage, cage_of
from cfree.caging.fingers import FIRST, Finger, setting, to_body, to_fingers
from cfree.collision.motion_checker import is_free_motion
from cfree.errors import UndecidedError, UnsupportedError
from cfree.exact.pose import Pose, PoseLike
from cfree.paths.path import Path
from cfree.scene.scene import AnyShape
from cfree.value import Value
from cfree.words import counted


@dataclass(frozen=True, eq=False, repr=False)
class Escape(Value):
    """A path out, and the fingers that block it: each cage has one of them.

    Attributes
    ----------
    path : Path
    blocking : tuple of int
        All fingers that the body overlaps on the path; perhaps some more that it nearly touches.
    """

    path: Path
    blocking: tuple[int, ...]

    def __repr__(self) -> str:
        return f"Escape({self.path!r}, blocking={self.blocking})"


@dataclass(frozen=True, eq=False, repr=False)
class FewestFingers(Value):
    """The answer of `fewest_fingers`; true if some of the places cage the body.

    Attributes
    ----------
    fingers : tuple of int
        The chosen places; empty if even all places do not cage it.
    cage : Cage
        The cage of these, with its proof; or the path out among all.
    escapes : tuple of Escape
        The proof that fewer do not cage it: no smaller set of places hits the blocking fingers of each.
    """

    fingers: tuple[int, ...]
    cage: Cage
    escapes: tuple[Escape, ...]

    def __bool__(self) -> bool:
        return bool(self.cage)

    def __repr__(self) -> str:
        if not self:
            return "FewestFingers(all fingers do not cage it)"
        paths = counted(len(self.escapes), "path")
        return f"FewestFingers(fingers {', '.join(map(str, self.fingers))} cage it; {paths} out of fewer)"

    def verified(self) -> bool:
        """True if the cage is verified, and no smaller set of places hits the blocking fingers of each path.

        Examples
        --------
        >>> square = [(0, 0), (2, 0), (2, 2), (0, 2)]
        >>> fewest_fingers(square, [(1, 0), (2, 1), (1, 2), (0, 1), (3, 3)]).verified()
        True
        """
        if not self.cage.verified():
            return False
        sets = [set(escape.blocking) for escape in self.escapes]
        places = sorted(set().union(*sets))
        fewer = combinations(places, min(len(places), len(self.fingers) - 1)) if self.fingers else ()
        return all(any(not one & set(few) for one in sets) for few in fewer)


@checked
def fewest_fingers(
    body: Any,
    places: Sequence[Any],
    pose: PoseLike = (0, 0, 0),
    *,
    progress: Callable[[int], object] | None = None,
) -> FewestFingers:
    """Find the least number of given finger places that cage a body, and such places.

    Parameters
    ----------
    body, pose
        As in `is_caged`.
    places : sequence of points and shapes
        The fingers to choose from. The body may overlap none of them.
    progress : callable, optional
        Called with the number of sets of places decided so far.

    Returns
    -------
    FewestFingers
        True with the places and a proof that fewer do not cage the body; false if all of them together do not.

    Raises
    ------
    ForbiddenPoseError, InvalidPoseError
        If the body overlaps a finger at the pose.
    UndecidedError
        If a set of places stays undecided; the message has the bounds that are proved.

    Examples
    --------
    >>> square = [(0, 0), (2, 0), (2, 2), (0, 2)]
    >>> found = fewest_fingers(square, [(1, 0), (2, 1), (3, 3), (1, 2), (0, 1), (-1, 1)])
    >>> found.fingers
    (0, 1, 3, 4)
    """
    shapes, start = to_body(body, pose)
    tips = to_fingers(places)
    return fewest_of(shapes, tips, start, [f"finger {k}" for k in range(len(tips))], progress=progress)


def fewest_of(
    shapes: tuple[AnyShape, ...],
    tips: tuple[Finger, ...],
    start: Pose,
    names: Sequence[str],
    *,
    units: str = "",
    progress: Callable[[int], object] | None = None,
) -> FewestFingers:
    """Decide as `fewest_fingers` does, from exact values, with different names of the fingers."""
    whole = cage_of(shapes, tips, start, units=units, names=names, improve=0)
    if not whole:
        return FewestFingers((), whole, (Escape(whole.answer, ()),) if isinstance(whole.answer, Path) else ())
    escapes = list[Escape]()
    known = set[frozenset[int]]()
    while True:
        chosen = smallest_hitting([set(escape.blocking) for escape in escapes])
        try:
            those = [names[k] for k in chosen]
            cage = cage_of(shapes, tuple(tips[k] for k in chosen), start, units=units, names=those, improve=0)
        except UndecidedError as error:
            raise UndecidedError(
                f"at least {len(chosen)} and at most {len(whole.holding)} fingers cage the body; "
                f"of {', '.join(those)}: {error}"
            ) from None
        known.add(frozenset(chosen))
        if progress is not None:
            progress(len(known))
        if not isinstance(cage.answer, Path):
            return FewestFingers(tuple(chosen), cage, tuple(escapes))
        others = [k for k in range(len(tips)) if k not in chosen]
        escapes.append(Escape(cage.answer, _blocking(shapes, tips, start, cage.answer, others)))


def smallest_hitting(sets: Sequence[set[int]]) -> list[int]:
    """Return the first smallest set of numbers that has one of each set.

    Examples
    --------
    >>> smallest_hitting([{1, 2}, {2, 3}, {4}]), smallest_hitting([])
    ([2, 4], [])
    """
    for most in range(len(sets) + 1):
        if (hitting := _hitting(sets, most)) is not None:
            return sorted(hitting)
    raise ValueError("a set without numbers cannot be hit")


def _hitting(sets: Sequence[set[int]], most: int) -> list[int] | None:
    if not sets:
        return []
    if most == 0:
        return None
    _, shortest = min((len(one), k) for k, one in enumerate(sets))
    for k in sorted(sets[shortest]):
        rest = _hitting([one for one in sets if k not in one], most - 1)
        if rest is not None:
            return [k, *rest]
    return None


def _blocking(
    body: tuple[AnyShape, ...], tips: tuple[Finger, ...], start: Pose, path: Path, others: Sequence[int]
) -> tuple[int, ...]:
    """Return the fingers that a path does not clear for certain."""
    return tuple(k for k in others if not _is_clear(body, tips[k], start, path))


def _is_clear(body: tuple[AnyShape, ...], finger: Finger, start: Pose, path: Path) -> bool:
    scene = setting(body, [finger], start, FIRST).scene
    try:
        return all(is_free_motion(scene, pose, motion) for pose, motion in zip(path.poses, path.motions, strict=False))
    except UnsupportedError:
        return False
