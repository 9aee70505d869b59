"""Run the checks: trapezoids, isolated parts, and slices, one after the other; then the matching of all sides.

`deep` counts the Euler characteristic again in two ways that use no vertices, edges and faces.
"""

from __future__ import annotations

import os
import random
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace

from cfree.arguments import checked
from cfree.collector import collection_paused
from cfree.exact.algebraic import Exact
from cfree.forbidden.boundary import Boundary
from cfree.forbidden.columns import CURVE
from cfree.formats.boundaries.boundary_file import read_boundary
from cfree.scene.reading import together
from cfree.scene.scene import Scene
from cfree.verify.angles import orientation
from cfree.verify.degrees import DEGREE, by_degrees
from cfree.verify.euler import euler_from_slices
from cfree.verify.heights import covered
from cfree.verify.isolated import IsolatedPart
from cfree.verify.matching import Matching, matched
from cfree.verify.missing import compared
from cfree.verify.result import PROVED, REFUTED, SAMPLED, SKIPPED, Check, Finding, Verification
from cfree.verify.round_boundary import round_boundary
from cfree.verify.surfaces import Fault, Surface, Turn
from cfree.verify.trapezoids import Reader, Side
from cfree.words import counted

BLOCK = 500  # trapezoids between two reports

# names of the checks
PIECES, ANGLES, DOMAINS, FREE = "convex pieces", "names and angles", "domains", "not forbidden"
CLOSED, ISOLATED, MISSING = "closed surfaces", "isolated parts", "nothing missing"
EULER = "Euler by slices"


@checked
def boundary(
    boundary: Boundary | str | os.PathLike[str],
    scene: Scene | None = None,
    *,
    slices: int = 12,
    sample: int | None = None,
    seed: int = 0,
    deep: bool = False,
    progress: Callable[[float], object] | None = None,
) -> Verification:
    """Check a boundary, from its scene's exact coordinates and without the code that computed it.

    Parameters
    ----------
    boundary : Boundary or path
        A file written by `cfree.save`, or a boundary in memory.
    scene : Scene, optional
        Must be the scene in the file; if it is not, that is the only finding.
    slices : int
        Orientations at which the whole slice is computed again: half of them critical angles.
    sample : int, optional
        Check that many trapezoids, chosen at random, and no sides; all by default.
    seed : int
        Seed of the random choices.
    deep : bool
        Count Euler numbers in two more ways, if all else is well: by slices at and between all critical angles, and by
        the degree of the Gauss map.
    progress : callable, optional
        Function called with the share done, from 0 to 1.

    Returns
    -------
    Verification

    Raises
    ------
    FormatError
        If the file cannot be read.

    Notes
    -----
    Time is about linear in the number of trapezoids, plus the time of the slices: contacts times pillars near them.
    `deep` takes two slices for each critical angle; it suits scenes of up to some hundreds of trapezoids.

    Examples
    --------
    >>> import cfree, cfree.verify
    >>> scene = cfree.Scene(robot=[(0, 0), (2, 0), (0, 1)], obstacles=[[(5, 5), (8, 5), (6, 7)]])
    >>> result = cfree.verify.boundary(cfree.boundary(scene), scene, slices=2)
    >>> result.verified, result.findings, result.euler
    (True, (), (0,))
    """
    if slices < 0 or (sample is not None and sample < 0):
        raise ValueError(f"slices {slices}, sample {sample}; give counts")
    with collection_paused():
        return _verified(boundary, scene, slices, sample, seed, deep, progress or (lambda done: None))


def _verified(
    boundary: Boundary | str | os.PathLike[str], scene: Scene | None, slices: int, sample: int | None, seed: int,
    deep: bool, report: Callable[[float], object],
) -> Verification:  # fmt: skip
    """Check with options that are in order; see `boundary`."""
    begin = time.perf_counter()
    stored = read_boundary(boundary) if isinstance(boundary, (str, os.PathLike)) else boundary
    if (finding := _unfit(stored, scene)) is not None:
        return Verification((), (finding,), (), time.perf_counter() - begin)
    if stored.scene.curved:
        result = round_boundary(stored, slices, sample, seed, deep, report)
        return replace(result, reading=together(result.reading, scene.reading if scene else ()))
    contacts = stored.contact_kind, stored.contact_robot, stored.contact_obstacle
    reader = Reader(stored.scene, contacts, stored.trapezoids, stored.isolated)
    count, parts = len(stored.trapezoids), len(stored.isolated)
    chosen = range(count) if sample is None else sorted(random.Random(seed).sample(range(count), min(sample, count)))
    findings = [Finding(PIECES, name, "its convex pieces do not tile it") for name in reader.world.untiled]
    loops: dict[int, list[Side | None]] = {}
    for done in range(0, len(chosen), BLOCK):
        report(done / (2 * len(chosen)))
        findings += trapezoid_findings(reader, chosen[done : done + BLOCK], loops)
    for k in range(parts):
        findings += isolated_findings(reader, k)
    places = 0
    for k in range(slices):
        report((1 + k / slices) / 2)
        number, wrong = compared(reader, orientation(reader, seed, k))
        findings += [Finding(MISSING, where, text) for where, text in wrong]
        places += number
    matching = matched(reader, loops) if len(chosen) == count else None
    if matching is not None:
        findings += [
            Finding(CLOSED, _place(reader, owners), f"{counted(number, 'edge')} of their sides without a partner")
            for owners, number in sorted(matching.unmatched.items())
        ]
    deeper: tuple[Check, ...] = ()
    if deep and matching is not None and not findings:
        deeper, findings = _counted_again(stored, reader, matching, report)
    elif deep:
        deeper = tuple(
            Check(name, SKIPPED, "needs a boundary in which nothing else is wrong") for name in (EULER, DEGREE)
        )
    report(1.0)
    checks = (
        _checks(reader, matching, len(chosen), f"{counted(slices, 'exact slice')}, {counted(places, 'free contact')}")
        + deeper
    )
    euler = tuple(matching.euler) if matching is not None else ()
    reading = together(stored.scene.reading, scene.reading if scene else ())
    seconds = time.perf_counter() - begin
    return Verification(refuted(checks, findings), tuple(findings), euler, seconds, reading=reading)


def _counted_again(
    stored: Boundary, reader: Reader, matching: Matching, report: Callable[[float], object]
) -> tuple[tuple[Check, ...], list[Finding]]:
    """Count Euler numbers again: of all surfaces together by slices, and of each by the Gauss map."""
    findings = []
    total, slices = euler_from_slices(reader, report)
    if total is not None and total != sum(matching.euler):
        findings.append(Finding(EULER, "all surfaces", f"{total} by slices, {sum(matching.euler)} by V - E + F"))
    by_slices = f"{slices:,} exact slices, at critical angles and between them: together {total}, as V - E + F"
    of_slices = Check(EULER, SAMPLED, by_slices)
    if total is None:
        of_slices = Check(EULER, SKIPPED, "free sheets of no width, between bounds and a wall, are not in slices")
    of_degrees, wrong = by_degrees(stored, matching.euler)
    return (of_slices, of_degrees), findings + wrong


def _unfit(boundary: Boundary, scene: Scene | None) -> Finding | None:
    """Finding that explains why nothing can be checked, if there is a reason."""
    if scene is not None and (differing := differences(scene, boundary.scene)):
        return Finding("scene", differing, f"not the scene of the boundary: {differing} differ")
    if not boundary.complete:
        done = f"{boundary.trimmed.sum():,} of {counted(len(boundary.trimmed), 'patch')} trimmed"
        return Finding("incomplete", done, "a limit stopped the computation; nothing is known about the others")
    return None


def differences(scene: Scene, other: Scene) -> str:
    """Names of the parts of the geometry in which two scenes differ, exactly."""
    names = ("robot", "obstacles", "bounds", "workspace")
    return ", ".join(name for name in names if getattr(scene, name) != getattr(other, name))


def trapezoid_findings(
    reader: Reader, numbers: Sequence[int], loops: dict[int, list[Side | None]]
) -> Iterator[Finding]:
    """Findings about some trapezoids, except for the matching of their sides, which go into `loops`."""
    sound, inside = list[int](), list[tuple[Surface, Turn, Exact, Exact]]()
    for k in numbers:
        kind = ANGLES
        try:
            trapezoid = reader.trapezoid(k)
            turn = trapezoid.turn()
            kind = DOMAINS
            lower, upper = trapezoid.check(turn)
            loops[k] = trapezoid.sides()
        except (Fault, IndexError) as fault:
            yield Finding(kind, _place(reader, [k]), _text(fault))
        else:
            sound.append(k)
            inside.append((trapezoid.surface, turn, lower, upper))
    for item in covered(reader.world, inside):
        _, turn, lower, upper = inside[item]
        text = f"forbidden at tau = {turn.tau}, somewhere from t = {lower} to {upper}"
        yield Finding(FREE, _place(reader, [sound[item]]), text)


def isolated_findings(reader: Reader, k: int) -> list[Finding]:
    """Findings about an isolated part."""
    try:
        IsolatedPart(reader, k).check()
    except (Fault, IndexError) as fault:
        return [Finding(ISOLATED, f"isolated part {k}", _text(fault))]
    return []


def _text(fault: Exception) -> str:
    return str(fault) if isinstance(fault, Fault) else "it names a feature, or a patch, that does not exist"


# --- the result ---


def _place(reader: Reader, numbers: Sequence[int]) -> str:
    t = reader.table
    listed = ", ".join(
        f"{k} (patch {t.patch[k]}, theta {t.theta_from[k]:.6g} to {t.theta_to[k]:.6g})" for k in numbers[:4]
    )
    return f"trapezoid {listed}{' ...' if len(numbers) > 4 else ''}"


def trapezoid_checks(count: int, total: int) -> tuple[Check, ...]:
    """Checks that `trapezoid_findings` makes, if nothing is wrong with so many trapezoids."""
    every = counted(total, "trapezoid") if count == total else f"{count:,} of {counted(total, 'trapezoid')}"
    proved = PROVED if count == total else SAMPLED
    return (
        Check(ANGLES, proved, f"{every}: both angles are isolated roots of what they are named by, in order"),
        Check(DOMAINS, proved, f"{every}: contact in range and 0 <= lower <= upper <= 1 from first to second angle"),
        Check(FREE, SAMPLED, f"{every}: nothing covers any of it at one exact angle each"),
    )


def refuted(checks: Iterable[Check], findings: Iterable[Finding]) -> tuple[Check, ...]:
    """Return the same checks; those with a finding are refuted."""
    kinds = {finding.kind for finding in findings}
    return tuple(replace(check, how=REFUTED) if check.name in kinds else check for check in checks)


def _checks(reader: Reader, matching: Matching | None, count: int, slices: str) -> tuple[Check, ...]:
    """Checks made, if nothing is wrong."""
    world, total, parts = reader.world, len(reader.table), reader.isolated
    closed = Check(CLOSED, SKIPPED, "needs every trapezoid")
    if matching is not None:
        numbers = ", ".join(f"{times:,} of {euler}" for euler, times in sorted(Counter(matching.euler).items()))
        pinched = f" ({matching.pinched:,} where more than two meet)" if matching.pinched else ""
        surfaces = f"{counted(len(matching.euler), 'surface')}; Euler numbers: {numbers or 'none'}"
        closed = Check(CLOSED, PROVED, f"{counted(matching.edges, 'edge')} with partners{pinched}; {surfaces}")
    curves = int((parts.kind == CURVE).sum())
    note = f"; {counted(curves, 'curve')}, sampled at three angles each" if curves else ""
    return (
        Check(
            PIECES, PROVED, f"{len(world.parts)} of the robot, {len(world.obstacle_pieces)} of the obstacles tile them"
        ),
        *trapezoid_checks(count, total),
        closed,
        Check(
            ISOLATED,
            SAMPLED if curves else PROVED,
            f"{counted(len(parts), 'part')}: free, no width, on no trapezoid{note}",
        ),
        Check(MISSING, SAMPLED, f"{slices}: computed anew, and the same"),
    )
