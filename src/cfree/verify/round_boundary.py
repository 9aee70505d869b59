"""Check a whole boundary of rounded shapes: its trapezoids, their matching, and slices.

Names, angles, curves and sides are those of `round_pieces.py` and `round_closure.py`, decided in balls: places that are
nearer to each other than `NEAREST` of the scene's size count as one. docs/verify.md.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction

import numpy as np
from flint import arb

from cfree.exact.pose import Pose
from cfree.forbidden.boundary import Boundary
from cfree.scene.complement import complement
from cfree.scene.grown_cores import Cores
from cfree.scene.rounded import rounded_shapes
from cfree.scene.scene import AnyShape, Scene
from cfree.verify.degrees import DEGREE, by_degrees
from cfree.verify.result import MEASURED, PROVED, REFUTED, SAMPLED, SKIPPED, Check, Finding, Verification
from cfree.verify.round_algebra import Turn, precision
from cfree.verify.round_closure import loose
from cfree.verify.round_inside import is_same
from cfree.verify.round_isolated import IsolatedParts
from cfree.verify.round_pieces import Piece, Reader, Scale
from cfree.verify.round_proof import Features, RoundSeparation
from cfree.verify.round_separation import scale_of, side_findings, size_of
from cfree.verify.round_slices import SURE, compared, pillar_of
from cfree.verify.round_surfaces import middle
from cfree.verify.round_world import ArcFilletPair, FilletPair, Part, Place, RoundWorld, is_apart
from cfree.words import counted

PIECES, TRAPEZOIDS, FREE = "convex pieces", "names, angles, domains", "not forbidden"
CLOSED, ISOLATED, MISSING = "closed surfaces", "isolated parts", "nothing missing"
NEAREST = Fraction(1, 1 << 64)
BLOCK = 100  # trapezoids between two reports
ANYWHERE = Pose(0, 0)


def round_boundary(
    stored: Boundary, slices: int, sample: int | None, seed: int, deep: bool, report: Callable[[float], object]
) -> Verification:
    """Check a boundary with options that are in order; see `cfree.verify.boundary`."""
    begin = time.perf_counter()
    cores = rounded_shapes(stored.scene)
    assert cores is not None, "the boundary has its features"
    count = len(stored.trapezoids)
    chosen = range(count) if sample is None else sorted(random.Random(seed).sample(range(count), min(sample, count)))
    proof, world = _as_pieces(stored, cores), RoundWorld(stored.scene, cores)
    findings = list(_findings_of_cores(cores, stored.scene, complement(stored.scene), world))
    scale, bits = scale_of(size_of(proof) * NEAREST, size_of(proof), max(1, count))
    number, pieces = 0, list[Piece]()
    with precision(bits):
        reader, covering = Reader(proof, scale), _Covering(world)
        for finding in _findings_of_trapezoids(reader, covering, chosen, pieces, report):
            findings.append(finding)
        fits = IsolatedParts(stored, reader, covering.covers_place, world.size)
        findings += fits.findings(ISOLATED)
        whole = len(pieces) == count
        if whole:
            findings += side_findings(pieces, scale, CLOSED, "trapezoid")
            places = random.Random(f"slices {seed}")
            for k in range(slices):
                report((1 + k / max(1, slices)) / 2)
                chart, angle = places.randrange(2), places.randint(-(1 << scale.bits), 1 << scale.bits)
                parts, wrong = compared(world, pieces, scale, chart, angle)
                where = f"tau = {float(scale.tau(angle).mid()):.9g}, chart {chart}"
                findings += [Finding(MISSING, where, text) for text in wrong]
                number += parts
    report(1.0)
    checks = _checks(
        world, proof, len(chosen), slices if whole else 0, number, (fits.checked, len(stored.isolated)), whole=whole
    )
    if deep:
        if whole and not findings:
            of_degrees, differing = by_degrees(stored)
            findings += differing
        else:
            of_degrees = Check(DEGREE, SKIPPED, "needs a boundary in which nothing else is wrong")
        checks += (of_degrees,)
    kinds = {finding.kind for finding in findings}
    checks = tuple(Check(x.name, REFUTED, x.extent) if x.name in kinds else x for x in checks)
    return Verification(checks, tuple(findings), (), time.perf_counter() - begin, reading=stored.scene.reading)


def findings_of_rows(
    stored: Boundary, cores: Cores, around: Sequence[AnyShape], chosen: Sequence[int], own: set[int]
) -> Iterator[Finding]:
    """Findings about some rows of a part of a boundary, and about the sides of its own if all of these are chosen.

    Parameters
    ----------
    stored : Boundary
        Its scene has some obstacles of the whole, and its trapezoids are some of the whole's.
    cores : Cores
        Those of the scene, and of the complement of the whole scene's workspace.
    around : sequence of shapes
        This complement.
    chosen : sequence of int
        Rows that are looked at, in order.
    own : set of int
        Those of them that are the part's own.
    """
    proof, world = _as_pieces(stored, cores), RoundWorld(stored.scene, cores)
    yield from _findings_of_cores(cores, stored.scene, around, world)
    size, pieces, rows = size_of(proof), list[Piece](), list[int]()
    scale, bits = scale_of(size * NEAREST, size, max(1, len(proof)))
    with precision(bits):
        reader, covering = Reader(proof, scale), _Covering(world)
        for k in chosen:
            where, piece = _place_of(proof, k), reader.piece_or_fault(k)
            if isinstance(piece, Piece):
                rows.append(k)
                pieces.append(piece)
                if k in own and covering.covers(piece, scale):
                    yield Finding(FREE, where, "forbidden in the middle")
            elif k in own:
                yield Finding(TRAPEZOIDS, where, piece)
        if len(chosen) < len(proof):
            return
        for text, owners in loose(pieces, scale):
            if mine := [rows[k] for k in owners if rows[k] in own]:
                yield Finding(CLOSED, f"rows {mine}", text)


def checks_of_rows(count: int, total: int) -> tuple[Check, ...]:
    """Checks that `findings_of_rows` makes, if nothing is wrong with so many trapezoids."""
    every = counted(total, "trapezoid") if count == total else f"{count:,} of {counted(total, 'trapezoid')}"
    near = f"up to {float(NEAREST):.1g} of the size"
    return (
        Check(PIECES, PROVED, "those of the cores tile them"),
        Check(
            TRAPEZOIDS,
            PROVED if count == total else SAMPLED,
            f"{every}: angles in order, curves within patches, {near}",
        ),
        Check(FREE, SAMPLED, f"{every}: nothing covers the middle at one angle each"),
    )


def _place_of(proof: RoundSeparation, k: int) -> str:
    table = proof.table
    return f"trapezoid {k} (patch {table.patch[k]}, theta {table.theta_from[k]:.6g} to {table.theta_to[k]:.6g})"


def _as_pieces(stored: Boundary, cores: Cores) -> RoundSeparation:
    """Return the trapezoids in the form of the pieces of a separation, whose poses have no meaning here."""
    features, patch, scene = stored.features, stored.trapezoids.patch, stored.scene
    return RoundSeparation(
        cores.robot,
        cores.obstacles,
        Features.numbered(features.robot),
        Features.numbered(features.obstacles),
        stored.contact_kind[patch],
        stored.contact_robot[patch],
        stored.contact_obstacle[patch],
        stored.trapezoids,
        ANYWHERE,
        ANYWHERE,
        scene.bounds,
        cores.straight(scene.workspace),
        cores.frames,
    )


def _findings_of_cores(cores: Cores, scene: Scene, around: Sequence[AnyShape], world: RoundWorld) -> Iterator[Finding]:
    names = [f"robot[{k}]" for k in range(len(scene.robot))] + [f"obstacle {k}" for k in range(len(scene.obstacles))]
    names += ["workspace"] * len(around)
    shapes: list[AnyShape] = [*scene.robot, *scene.obstacles, *around]
    for name, core, shape in zip(names, [*cores.robot, *cores.obstacles], shapes, strict=True):
        if not is_same(core, shape):
            yield Finding(PIECES, name, "it is not its core, grown by its radius")
    for name in world.untiled:
        yield Finding(PIECES, name, "its convex pieces do not tile it")


def _findings_of_trapezoids(
    reader: Reader,
    covering: _Covering,
    chosen: Sequence[int],
    pieces: list[Piece],
    report: Callable[[float], object],
) -> Iterator[Finding]:
    """Findings about trapezoids; those that are sound go into `pieces`."""
    for done, k in enumerate(chosen):
        if done % BLOCK == 0:
            report(done / (2 * len(chosen)))
        where = _place_of(reader.proof, k)
        piece = reader.piece_or_fault(k)
        if not isinstance(piece, Piece):
            yield Finding(TRAPEZOIDS, where, piece)
            continue
        pieces.append(piece)
        if covering.covers(piece, reader.scale):
            yield Finding(FREE, where, "forbidden in the middle")


class _Covering:
    """Decides if two pieces overlap in the middle of a trapezoid."""

    def __init__(self, world: RoundWorld) -> None:
        self._size = world.size
        self._fillet_pairs: list[FilletPair | ArcFilletPair] = [*world.fillet_pairs, *world.arc_fillet_pairs]
        self._pairs: list[tuple[Part, Part]] = [(a, b) for some, others in world.layers for a in some for b in others]
        ends = [[_around(part) for part in side] for side in zip(*self._pairs, strict=True)]
        self._centers = np.array([[center for center, _ in side] for side in ends])
        self._reach = np.array([[radius for _, radius in side] for side in ends]).sum(axis=0)

    def covers(self, piece: Piece, scale: Scale) -> bool:
        turn = scale.turn(piece.chart, (piece.start + piece.stop) // 2)
        ends = piece.lower.point(turn), piece.upper.point(turn)
        return self.covers_place(middle(piece.surface, *ends, turn), turn, scale.near)

    def covers_place(self, place: Place, turn: Turn, near: arb) -> bool:
        """True if two pieces overlap by more than a distance where the robot is at a place."""
        at, turned = (complex(*(float(c.mid()) for c in pair)) for pair in (place, (turn.cos, turn.sin)))
        here, there = self._centers
        is_near = np.abs(there - turned * here - at) < self._reach + SURE * self._size
        for k in np.flatnonzero(is_near):
            robot, obstacle = self._pairs[k]
            pillar = pillar_of(robot, obstacle, turned)
            if pillar.room(np.array([at]))[0] > SURE * self._size:
                continue
            if not is_apart(robot, obstacle, turn, place, near):
                return True
        return any(pair.overlaps(turn, place, near) for pair in self._fillet_pairs)


def _around(part: Part) -> tuple[complex, float]:
    """Center and radius of a disc around a piece."""
    center = complex(part.rough.mean())
    return center, float((np.abs(part.rough - center) + part.radii).max())


def _of_fits(checked: int, total: int) -> Check:
    """Check of the isolated parts, of which so many were looked at."""
    if checked < total and not checked:
        return Check(ISOLATED, SKIPPED, f"{counted(total, 'part')}, each at the limit of a curve")
    some = counted(total, "part") if checked == total else f"{checked} of {counted(total, 'part')}"
    return Check(ISOLATED, SAMPLED, f"{some}: free, and without room beside them, at one place each")


def _checks(
    world: RoundWorld,
    proof: RoundSeparation,
    count: int,
    slices: int,
    number: int,
    fits: tuple[int, int],
    *,
    whole: bool,
) -> tuple[Check, ...]:
    """Checks made, if nothing is wrong."""
    total = len(proof)
    robot, obstacles = world.layers[0]
    near = f"up to {float(NEAREST):.1g} of the size"
    closed = f"every side of {counted(total, 'trapezoid')} has a partner, {near}"
    return (
        Check(PIECES, PROVED, f"{len(robot)} of the robot, {len(obstacles)} of the obstacles tile the cores"),
        *checks_of_rows(count, total)[1:],
        Check(CLOSED, PROVED, closed) if whole else Check(CLOSED, SKIPPED, "needs every trapezoid"),
        _of_fits(*fits),
        Check(MISSING, MEASURED, f"{counted(slices, 'slice')}, {counted(number, 'part')} of contacts, in doubles")
        if whole and slices
        else Check(MISSING, SKIPPED, "needs every trapezoid" if slices else "no slices wanted"),
    )
