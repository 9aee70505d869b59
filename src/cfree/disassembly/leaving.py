"""`can_leave`: a path on which a part leaves the others, or a proof that they hold it; the parts that block it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from cfree.analysis.blockers import blockers
from cfree.analysis.leaving import holding, is_outside, leave
from cfree.analysis.margins import NearestMiss, nearest_miss
from cfree.arguments import checked
from cfree.collision.nearest_free import ForbiddenPoseError
from cfree.disassembly.assembly import Assembly
from cfree.errors import InvalidPoseError, UndecidedError
from cfree.lazy import registered
from cfree.paths.path import Path
from cfree.planning.separation import Separated
from cfree.scene.scene import Scene
from cfree.value import Value

Progress = Callable[[float], object]


@dataclass(frozen=True, eq=False, repr=False)
class Leaving(Value):
    """The answer of `can_leave`; true if the part can leave.

    Attributes
    ----------
    part : str
    answer : Path or Separated
        A path on which it leaves while the others stay; or a proof that no motion leads it away, not even one that
        touches the others.
    scene : Scene
        The part among the others, with start and goal: `cfree.verify.answer(scene, answer)` checks the answer.
    """

    part: str
    answer: Path | Separated
    scene: Scene

    def __bool__(self) -> bool:
        return isinstance(self.answer, Path)

    def __repr__(self) -> str:
        held = "" if self else f" held by {', '.join(self.holding)}"
        return f"Leaving({self.part!r}: {self.answer if self else 'it cannot leave,'}{held})"

    @property
    def path(self) -> Path | None:
        """The path on which the part leaves; None if it cannot."""
        return self.answer if isinstance(self.answer, Path) else None

    @property
    def proof(self) -> Separated | None:
        """The proof that it cannot leave; None if it can."""
        return self.answer if isinstance(self.answer, Separated) else None

    @property
    def holding(self) -> tuple[str, ...]:
        """The parts whose contacts form the proof: these alone hold it. Empty if it can leave."""
        return () if self.proof is None else holding(self.scene, self.proof)

    def verified(self) -> bool:
        """True if independent code confirms the answer.

        Examples
        --------
        >>> can_leave("a", Assembly({"a": [(0, 0), (1, 0), (0, 1)], "b": [(2, 0), (3, 0), (3, 1)]})).verified()
        True
        """
        from cfree.verify.answers import answer as verified_answer

        return verified_answer(self.scene, self.answer).verified and is_outside(self.scene, self.answer.goal)

    def plot(self) -> Any:
        """Draw the part with its path, or the parts that hold it.

        Returns
        -------
        matplotlib figure
        """
        return registered("leaving figure")(self)


@checked
def can_leave(
    part: str,
    assembly: Assembly,
    *,
    gone: Sequence[str] = (),
    max_seconds: float | None = None,
    progress: Progress | None = None,
) -> Leaving:
    """Decide if one part can be taken out while the others stand still.

    Parameters
    ----------
    part : str
    assembly : Assembly
    gone : sequence of str
        Parts that are already taken out.
    max_seconds : float, optional
        Time limit.
    progress : callable, optional
        Called with the completed share, from 0 to 1.

    Returns
    -------
    Leaving
        True with a path to a place beyond all parts, or false with a proof. The part turns if it has to.

    Raises
    ------
    ForbiddenPoseError, InvalidPoseError
        If it overlaps another part.
    UndecidedError
        If only motions that touch all the way may lead out, or round shapes almost fit.
    IncompleteError
        If `max_seconds` ran out.

    Notes
    -----
    Straight motions along edges are tried first, also those that fit exactly.

    Examples
    --------
    >>> frame = [(0, 0), (4, 0), (4, 3), (3, 3), (3, 1), (1, 1), (1, 3), (0, 3)]
    >>> lid, peg = [(0, 3), (4, 3), (4, 4), (0, 4)], [(1, 1), (3, 1), (3, 2), (1, 2)]
    >>> parts = Assembly({"frame": frame, "peg": peg, "lid": lid}, fixed=["frame"])
    >>> can_leave("peg", parts)
    Leaving('peg': it cannot leave, held by frame, lid)
    >>> can_leave("peg", parts, gone=["lid"]).path
    Path(1 motion, length 4.21875, turning 0)
    """
    for name in gone:
        assembly.index(name, "gone")
    return leaving(assembly, part, gone, improve=None, max_seconds=max_seconds, progress=progress)


def leaving(
    assembly: Assembly,
    part: str,
    gone: Sequence[str],
    *,
    improve: float | None = None,
    max_seconds: float | None = None,
    progress: Progress | None = None,
) -> Leaving:
    """Decide as `can_leave` does."""
    scene = assembly.scene(part, gone)
    start = scene.start
    assert start is not None
    try:
        answer = leave(scene, start, improve=improve, max_seconds=max_seconds, progress=progress)
    except ForbiddenPoseError as error:
        fault = str(error).split(": ", 1)[1].split(";")[0]
        raise InvalidPoseError(f"part {part!r} overlaps another one: {fault}; move one of them") from None
    if isinstance(answer, Separated) and answer.of != "closed":
        raise UndecidedError(
            f"undecided: {part!r} cannot leave at a distance from the other parts; a motion that touches them all the "
            "way may lead out. Make it a little smaller, or larger"
        )
    if isinstance(answer, Path):
        return Leaving(part, answer, _ending_at(scene, answer))
    return Leaving(part, answer, scene)


def _ending_at(scene: Scene, path: Path) -> Scene:
    names, units, start, goal = scene.obstacle_names, scene.units, path.start, path.goal
    return Scene(
        scene.robot, scene.obstacles, obstacle_names=names, start=start, goal=goal, units=units, name=scene.name
    )


@dataclass(frozen=True, eq=False, repr=False)
class Blocking(Value):
    """The parts that block another one.

    Attributes
    ----------
    part : str
    leaving : Leaving
        The proof; `leaving.holding` are the parts whose contacts form it.
    single : tuple of str
        Parts without which it can leave: each of them alone. Empty if two or more must be taken out first.
    paths : tuple of Path
        Its paths without these.
    undecided : tuple of str
        Parts without which it stayed undecided.
    """

    part: str
    leaving: Leaving
    single: tuple[str, ...]
    paths: tuple[Path, ...]
    undecided: tuple[str, ...] = ()

    def __repr__(self) -> str:
        names = " or ".join(self.single) if self.single else "no single part"
        return f"Blocking({self.part!r} is held by {', '.join(self.leaving.holding)}; it can leave without {names})"


@checked
def what_blocks(part: str, assembly: Assembly, *, gone: Sequence[str] = ()) -> Blocking:
    """Find each single part without which another one can leave; `blockers` in terms of parts.

    Parameters
    ----------
    part, assembly, gone
        As in `can_leave`.

    Returns
    -------
    Blocking

    Raises
    ------
    ValueError
        If the part can leave.
    UndecidedError
        As from `can_leave`.

    Examples
    --------
    >>> frame = [(0, 0), (4, 0), (4, 3), (3, 3), (3, 1), (1, 1), (1, 3), (0, 3)]
    >>> lid, peg = [(0, 3), (4, 3), (4, 4), (0, 4)], [(1, 1), (3, 1), (3, 2), (1, 2)]
    >>> what_blocks("peg", Assembly({"frame": frame, "peg": peg, "lid": lid}))
    Blocking('peg' is held by frame, lid; it can leave without frame or lid)
    """
    held = can_leave(part, assembly, gone=gone)
    if held:
        raise ValueError(f"part {part!r} can leave: nothing blocks it; see the path of can_leave")
    names, scene = held.scene.obstacle_names, held.scene
    several = {name for name in names if names.count(name) > 1}
    opening = dict[str, Path]()
    undecided = list[str]()
    if any(name not in several for name in names):
        found = blockers(scene)
        opening |= {names[one.obstacle]: one.path for one in found if names[one.obstacle] not in several}
        undecided += [names[k] for k in found.undecided if names[k] not in several]
    for name in dict.fromkeys(names):
        if name in several:
            try:
                answer = leaving(assembly, part, [*gone, name]).answer
            except UndecidedError:
                undecided.append(name)
                continue
            if isinstance(answer, Path):
                opening[name] = answer
    ordered = [name for name in assembly.names if name in opening]
    return Blocking(part, held, tuple(ordered), tuple(opening[name] for name in ordered), tuple(undecided))


@checked
def missing_gap(
    part: str,
    assembly: Assembly,
    *,
    gone: Sequence[str] = (),
    tolerance: float = 0.01,
    progress: Progress | None = None,
) -> NearestMiss | None:
    """Find by how much a part is too large to leave, and where; `nearest_miss` in terms of parts.

    Parameters
    ----------
    part, assembly, gone
        As in `can_leave`.
    tolerance, progress
        As in `nearest_miss`.

    Returns
    -------
    NearestMiss, or None if no smaller part of this shape can leave
        With all edges moved inwards by `hi` the part leaves, with `lo` it does not. Each gap that it passes is too
        narrow by up to twice as much.

    Raises
    ------
    ValueError
        If it can leave.

    Examples
    --------
    >>> hook = [(0, 0), (6, 0), (6, 4), (4, 4), (4, 3), (5, 3), (5, 1), (1, 1), (1, 3), (2, 3), (2, 4), (0, 4)]
    >>> parts = Assembly({"slot": hook, "slider": [("3/2", "3/2"), ("9/2", "3/2"), ("9/2", 2), ("7/2", 2), ("7/2", 5),
    ...     ("5/2", 5), ("5/2", 2), ("3/2", 2)]}, fixed=["slot"])
    >>> miss = missing_gap("slider", parts)
    >>> 0 < miss.lo < miss.hi < 0.5
    True
    """
    held = can_leave(part, assembly, gone=gone)
    if held:
        raise ValueError(f"part {part!r} can leave: no gap is missing")
    return nearest_miss(held.scene, tolerance=tolerance, progress=progress)
