"""The driver: blocks of trapezoids, isolated parts, and slices, in this process or in several; then the whole."""

from __future__ import annotations

import multiprocessing
import os
import random
import signal
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from cfree.storage import load_boundary
from cfree.trapezoids import CURVE
from cfree.verify.angles import orientation
from cfree.verify.isolated import IsolatedPart
from cfree.verify.matching import Matching, matched
from cfree.verify.missing import compared
from cfree.verify.result import PROVED, REFUTED, SAMPLED, SKIPPED, Check, Finding, Verification
from cfree.verify.surfaces import Fault
from cfree.verify.trapezoids import Reader, Side

if TYPE_CHECKING:
    from cfree.forbidden import Boundary
    from cfree.scene import Scene

BLOCK = 200  # trapezoids checked between two reports

# names of the checks
PIECES, ANGLES, DOMAINS, FREE = "convex pieces", "names and angles", "domains", "not forbidden"
CLOSED, ISOLATED, MISSING = "closed surfaces", "isolated parts", "nothing missing"


@dataclass
class Part:
    """What one block of trapezoids, one isolated part, or one slice contributed."""

    findings: list[Finding] = field(default_factory=list)
    loops: dict[int, list[Side | None]] = field(default_factory=dict)  # sides of trapezoids
    trapezoids: int = 0
    slices: int = 0
    contacts: int = 0


def boundary(
    boundary: Boundary | str | os.PathLike[str],
    scene: Scene | None = None,
    *,
    slices: int = 12,
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
        Orientations at which the whole slice is computed again: half of them critical angles.
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
    >>> result.verified, result.findings, result.euler
    (True, (), (0,))
    """
    begin = time.perf_counter()
    if slices < 0 or workers < 1 or (sample is not None and sample < 0):
        raise ValueError(f"slices {slices}, sample {sample}, workers {workers}; give counts, and at least one worker")
    given = load_boundary(boundary) if isinstance(boundary, (str, os.PathLike)) else boundary
    if (finding := _unfit(given, scene)) is not None:
        return Verification((), (finding,), (), time.perf_counter() - begin)

    count = len(given.trapezoids)
    chosen: Sequence[int] = range(count)
    if sample is not None and sample < count:
        chosen = sorted(random.Random(seed).sample(chosen, sample))
    tasks: list[Task] = [("slice", [seed, k]) for k in range(slices)]
    tasks += [("isolated", [k]) for k in range(len(given.isolated))]
    tasks += [("trapezoids", chosen[k : k + BLOCK]) for k in range(0, len(chosen), BLOCK)]
    contacts = given.contact_kind, given.contact_robot, given.contact_obstacle
    source = given.scene, contacts, given.trapezoids, given.isolated
    whole, reader = Part(), Reader(*source)
    with _mapping(reader, source, min(workers, len(tasks))) as work:
        for done, part in enumerate(work(tasks)):
            _merge(whole, part)
            if progress is not None:
                progress((done + 1) / len(tasks))

    findings = [Finding(PIECES, name, "its convex pieces do not tile it") for name in reader.world.untiled]
    findings += sorted(whole.findings, key=str)
    matching = matched(reader, whole.loops) if len(chosen) == count else None
    if matching is not None:
        findings += _unmatched(matching, reader)
    checks = _checks(whole, reader, matching, {finding.kind for finding in findings})
    euler = tuple(matching.euler) if matching is not None else ()
    return Verification(checks, tuple(findings), euler, time.perf_counter() - begin)


def _unfit(boundary: Boundary, scene: Scene | None) -> Finding | None:
    """Why there is nothing to check, if there is a reason."""
    if scene is not None and (differing := differences(scene, boundary.scene)):
        return Finding("scene", differing, f"not the scene of the boundary: {differing} differ")
    if not boundary.complete:
        done = f"{boundary.trimmed.sum():,} of {len(boundary.trimmed):,} patches trimmed"
        return Finding("incomplete", done, "a limit stopped the computation; nothing is known about the others")
    return None


def differences(scene: Scene, other: Scene) -> str:
    """Which geometry of two scenes differs, exactly."""
    names = ("robot", "obstacles", "bounds", "workspace")
    return ", ".join(name for name in names if getattr(scene, name) != getattr(other, name))


# --- work ---

Task = tuple[str, Sequence[int]]


def perform(reader: Reader, task: Task) -> Part:
    kind, numbers = task
    if kind == "slice":
        return slice_part(reader, *numbers)
    return isolated_part(reader, *numbers) if kind == "isolated" else trapezoid_part(reader, numbers)


def trapezoid_part(reader: Reader, numbers: Sequence[int]) -> Part:
    """All about some trapezoids but how their sides match."""
    part = Part(trapezoids=len(numbers))
    for k in numbers:
        kind = ANGLES
        try:
            trapezoid = reader.trapezoid(k)
            turn = trapezoid.turn()
            kind = DOMAINS
            trapezoid.check(turn)
            part.loops[k] = trapezoid.sides()
            kind = FREE
            trapezoid.sample(reader.world, turn)
        except (Fault, IndexError) as fault:
            part.findings.append(Finding(kind, _place(reader, [k]), _text(fault)))
    return part


def isolated_part(reader: Reader, k: int) -> Part:
    """All about an isolated part."""
    part = Part()
    try:
        IsolatedPart(reader, k).check()
    except (Fault, IndexError) as fault:
        part.findings.append(Finding(ISOLATED, f"isolated part {k}", _text(fault)))
    return part


def slice_part(reader: Reader, seed: int, number: int) -> Part:
    """One slice."""
    contacts, wrong = compared(reader, orientation(reader, seed, number))
    return Part([Finding(MISSING, where, text) for where, text in wrong], slices=1, contacts=contacts)


def _text(fault: Exception) -> str:
    return str(fault) if isinstance(fault, Fault) else "it names a feature, or a patch, that does not exist"


def _merge(whole: Part, part: Part) -> None:
    whole.findings += part.findings
    whole.loops |= part.loops
    whole.trapezoids += part.trapezoids
    whole.slices += part.slices
    whole.contacts += part.contacts


@contextmanager
def _mapping(reader: Reader, source: Any, workers: int) -> Iterator[Callable[[list[Task]], Iterable[Part]]]:
    if workers <= 1:
        yield lambda tasks: (perform(reader, task) for task in tasks)
        return
    context = multiprocessing.get_context("spawn")
    with context.Pool(workers, _begin, source) as pool:  # leaving it ends the processes
        yield lambda tasks: pool.imap_unordered(_perform, tasks)


_reader: Any = None  # of a worker process


def _begin(*source: Any) -> None:
    global _reader
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the process that started this one
    _reader = Reader(*source)


def _perform(task: Task) -> Part:
    return perform(_reader, task)


# --- the result ---


def _unmatched(matching: Matching, reader: Reader) -> list[Finding]:
    return [
        Finding(CLOSED, _place(reader, owners), f"{number} edges of their sides find no partner")
        for owners, number in sorted(matching.unmatched.items())
    ]


def _place(reader: Reader, numbers: Sequence[int]) -> str:
    t = reader.table
    listed = ", ".join(
        f"{k} (patch {t.patch[k]}, theta {t.theta_from[k]:.6g} to {t.theta_to[k]:.6g})" for k in numbers[:4]
    )
    return f"trapezoid {listed}{' ...' if len(numbers) > 4 else ''}"


def _checks(whole: Part, reader: Reader, matching: Matching | None, refuted: set[str]) -> tuple[Check, ...]:
    world, count, total = reader.world, whole.trapezoids, len(reader.table)
    every = f"{count:,} trapezoids" if count == total else f"{count:,} of {total:,} trapezoids"
    proved = PROVED if count == total else SAMPLED
    closed = SKIPPED, "needs every trapezoid"
    if matching is not None:
        numbers = ", ".join(f"{times:,} of {euler}" for euler, times in sorted(Counter(matching.euler).items()))
        pinched = f" ({matching.pinched:,} where more than two meet)" if matching.pinched else ""
        surfaces = f"{len(matching.euler):,} surfaces; Euler numbers: {numbers or 'none'}"
        closed = PROVED, f"{matching.edges:,} edges have partners{pinched}; {surfaces}"
    curves = int((reader.isolated.kind == CURVE).sum())
    parts = f"{len(reader.isolated):,} parts: free, of no width, on no trapezoid"
    parts += f"; {curves:,} are curves, looked at three angles each" if curves else ""
    slices = f"{whole.slices} exact slices, {whole.contacts:,} free contacts"
    rows = (
        (PIECES, PROVED, f"{len(world.parts)} of the robot, {len(world.walls)} of the obstacles: convex, tiling them"),
        (ANGLES, proved, f"{every}: both angles are isolated roots of what they are named by, in order, in the chart"),
        (DOMAINS, proved, f"{every}: contact in range and 0 <= lower <= upper <= 1 from first to second angle"),
        (FREE, SAMPLED, f"{every}: nothing covers any of it at one exact angle each"),
        (CLOSED, *closed),
        (ISOLATED, SAMPLED if curves else PROVED, parts),
        (MISSING, SAMPLED, f"{slices}: computed anew, and the same"),
    )
    return tuple(Check(name, REFUTED if name in refuted else how, extent) for name, how, extent in rows)
