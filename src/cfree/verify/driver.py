"""The driver: blocks of trapezoids, and slices, in this process or in several; then what they add up to."""

from __future__ import annotations

import multiprocessing
import os
import random
import signal
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from cfree.storage import load_boundary
from cfree.verify.result import PROVED, REFUTED, SAMPLED, SKIPPED, Check, Finding, Verification
from cfree.verify.slices import compared
from cfree.verify.surfaces import Fault
from cfree.verify.trapezoids import Contacts, Reader

if TYPE_CHECKING:
    from cfree.forbidden import Boundary
    from cfree.scene import Scene
    from cfree.trapezoids import Trapezoids

BLOCK = 200  # trapezoids checked between two reports

# names of the checks
PIECES, ANGLES, DOMAINS = "convex pieces", "names and angles", "domains"
FREE, CLOSED, MISSING = "not forbidden", "closed surface", "nothing missing"


@dataclass
class Part:
    """What one block of trapezoids, or one slice, contributed."""

    findings: list[Finding] = field(default_factory=list)
    sides: dict[bytes, tuple[int, tuple[int, ...]]] = field(default_factory=dict)  # sum of an end, its trapezoids
    trapezoids: int = 0
    slices: int = 0
    segments: int = 0


def boundary(
    boundary: Boundary | str | os.PathLike[str],
    scene: Scene | None = None,
    *,
    slices: int = 8,
    sample: int | None = None,
    seed: int = 0,
    workers: int = 1,
    progress: Callable[[float], object] | None = None,
) -> Verification:
    """Check a boundary, from its scene's exact coordinates and without the code that computed it.

    Parameters
    ----------
    boundary : Boundary or path
        A file written by `Boundary.save`, or one in memory.
    scene : Scene, optional
        Has to be the scene in the file; if it is not, that is the only finding.
    slices : int
        Orientations at which the whole slice is computed again, every second one next to a critical angle.
    sample : int, optional
        Check that many trapezoids, chosen at random, and no sides; all by default.
    seed : int
        Of the random choices.
    workers : int
        Processes. More than one start Python anew: a script needs ``if __name__ == "__main__":``.
    progress : callable, optional
        Called with the share that is done, from 0 to 1.

    Returns
    -------
    Verification

    Raises
    ------
    FormatError
        If the file cannot be read.

    Notes
    -----
    Time is about linear in the number of trapezoids, plus that of the slices: contacts times pillars near them.

    Examples
    --------
    >>> import cfree, cfree.verify
    >>> scene = cfree.Scene(robot=[(0, 0), (2, 0), (0, 1)], obstacles=[[(5, 5), (8, 5), (6, 7)]])
    >>> result = cfree.verify.boundary(cfree.boundary(scene), scene, slices=2)
    >>> result.verified, result.findings
    (True, ())
    """
    begin = time.perf_counter()
    if slices < 0 or workers < 1 or (sample is not None and sample < 0):
        raise ValueError(f"slices {slices}, sample {sample}, workers {workers}; give counts, and at least one worker")
    given = load_boundary(boundary) if isinstance(boundary, (str, os.PathLike)) else boundary
    if scene is not None and (differing := differences(scene, given.scene)):
        text = f"not the scene of the boundary: {differing} differ"
        return Verification((), (Finding("scene", differing, text),), time.perf_counter() - begin)

    count = len(given.trapezoids)
    chosen: Sequence[int] = range(count)
    if sample is not None and sample < count:
        chosen = sorted(random.Random(seed).sample(chosen, sample))
    tasks: list[Task] = [("slice", [seed, k]) for k in range(slices)]
    tasks += [("trapezoids", chosen[k : k + BLOCK]) for k in range(0, len(chosen), BLOCK)]
    source = given.scene, (given.contact_kind, given.contact_robot, given.contact_obstacle), given.trapezoids
    whole, reader = Part(), Reader(*source)
    with _mapping(reader, source, min(workers, len(tasks))) as work:
        for done, part in enumerate(work(tasks)):
            _merge(whole, part)
            if progress is not None:
                progress((done + 1) / len(tasks))

    findings = [Finding(PIECES, name, "its convex pieces do not tile it") for name in reader.world.untiled]
    findings += sorted(whole.findings, key=str)
    if len(chosen) == count:
        findings += _unmatched(whole, reader)
    checks = _checks(whole, reader, count, {finding.kind for finding in findings})
    return Verification(checks, tuple(findings), time.perf_counter() - begin)


def differences(scene: Scene, other: Scene) -> str:
    """Which geometry of two scenes differs, exactly."""
    names = ("robot", "obstacles", "bounds", "workspace")
    return ", ".join(name for name in names if getattr(scene, name) != getattr(other, name))


# --- work ---

Task = tuple[str, Sequence[int]]


def perform(reader: Reader, task: Task) -> Part:
    kind, numbers = task
    return slice_part(reader, *numbers) if kind == "slice" else trapezoid_part(reader, numbers)


def trapezoid_part(reader: Reader, numbers: Sequence[int]) -> Part:
    """Checks 1 to 4 of some trapezoids."""
    part = Part(trapezoids=len(numbers))
    for k in numbers:
        kind = ANGLES
        try:
            trapezoid = reader.trapezoid(k)
            turn = trapezoid.turn()
            kind = CLOSED
            for key, sign in trapezoid.ends():
                total, members = part.sides.get(key, (0, ()))
                part.sides[key] = total + sign, (*members, k)
            kind = DOMAINS
            trapezoid.check(turn)
            kind = FREE
            trapezoid.sample(reader.world, turn)
        except Fault as fault:
            part.findings.append(Finding(kind, _place(reader, [k]), str(fault)))
    return part


def slice_part(reader: Reader, seed: int, number: int) -> Part:
    """One slice."""
    _, segments, wrong = compared(reader, seed, number)
    return Part([Finding(MISSING, where, text) for where, text in wrong], slices=1, segments=segments)


def _merge(whole: Part, part: Part) -> None:
    whole.findings += part.findings
    whole.trapezoids += part.trapezoids
    whole.slices += part.slices
    whole.segments += part.segments
    for key, (total, members) in part.sides.items():
        before, others = whole.sides.get(key, (0, ()))
        whole.sides[key] = before + total, others + members


@contextmanager
def _mapping(reader: Reader, source: Any, workers: int) -> Iterator[Callable[[list[Task]], Iterable[Part]]]:
    if workers <= 1:
        yield lambda tasks: (perform(reader, task) for task in tasks)
        return
    context = multiprocessing.get_context("spawn")
    with context.Pool(workers, _begin, source) as pool:  # leaving it ends the processes
        yield lambda tasks: pool.imap_unordered(_perform, tasks)


_reader: Any = None  # of a worker process


def _begin(scene: Scene, contacts: Contacts, table: Trapezoids) -> None:
    global _reader
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the process that started this one
    _reader = Reader(scene, contacts, table)


def _perform(task: Task) -> Part:
    return perform(_reader, task)


# --- the result ---


def _unmatched(whole: Part, reader: Reader) -> list[Finding]:
    """Ends of sides that do not cancel, gathered by the trapezoids they belong to."""
    open_ends: dict[tuple[int, ...], int] = {}
    for total, members in whole.sides.values():
        if total:
            owners = tuple(sorted(set(members)))
            open_ends[owners] = open_ends.get(owners, 0) + 1
    return [
        Finding(CLOSED, _place(reader, owners), f"{number} ends of their sides find no partner")
        for owners, number in sorted(open_ends.items())
    ]


def _parts(whole: Part, count: int) -> int:
    """Into how many parts the ends in common join the trapezoids; pinched surfaces are joined, too."""
    parent = list(range(count))

    def root(k: int) -> int:
        while parent[k] != k:
            parent[k] = k = parent[parent[k]]
        return k

    for _, (first, *others) in whole.sides.values():
        for k in others:
            parent[root(k)] = root(first)
    return sum(parent[k] == k for k in range(count))


def _place(reader: Reader, numbers: Sequence[int]) -> str:
    t = reader.table
    listed = ", ".join(
        f"{k} (patch {t.patch[k]}, theta {t.theta_from[k]:.6g} to {t.theta_to[k]:.6g})" for k in numbers[:4]
    )
    return f"trapezoid {listed}{' ...' if len(numbers) > 4 else ''}"


def _checks(whole: Part, reader: Reader, count: int, refuted: set[str]) -> tuple[Check, ...]:
    world, n = reader.world, whole.trapezoids
    all_of_them = n == count
    every = f"{n:,} trapezoids" if all_of_them else f"{n:,} of {count:,} trapezoids"
    proved = PROVED if all_of_them else SAMPLED
    closed = SKIPPED, "needs every trapezoid"
    if all_of_them:
        closed = PROVED, f"{len(whole.sides):,} ends of sides cancel; {_parts(whole, n):,} connected parts"
    rows = (
        (PIECES, PROVED, f"{len(world.parts)} of the robot, {len(world.walls)} of the obstacles: convex, tiling them"),
        (ANGLES, proved, f"{every}: both angles are isolated roots of what they are named by, in order, in the chart"),
        (DOMAINS, proved, f"{every}: contact in range and 0 <= lower <= upper <= 1 from first to second angle"),
        (FREE, SAMPLED, f"{every}: on the contact, inside no obstacle, at one exact point each"),
        (CLOSED, *closed),
        (MISSING, SAMPLED, f"{whole.slices} exact slices, {whole.segments:,} segments: computed anew, and the same"),
    )
    return tuple(Check(name, REFUTED if name in refuted else how, extent) for name, how, extent in rows)
