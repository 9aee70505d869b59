"""A second opinion on the shards of a folder: each alone, then the matching of its sides with those around it."""

from __future__ import annotations

import random
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from cfree.collector import collection_paused
from cfree.distributed.rows import Rows
from cfree.distributed.shard import read_shard
from cfree.distributed.tasks import GLUED, TRIMMED, Work, opened
from cfree.distributed.trim import MODULUS, digest
from cfree.errors import FormatError
from cfree.forbidden.boundary import Boundary, boundary_of
from cfree.verify.driver import BLOCK, CLOSED, refuted, trapezoid_checks, trapezoid_findings
from cfree.verify.matching import matched
from cfree.verify.result import PROVED, SKIPPED, Check, Finding, Verification
from cfree.verify.round_boundary import checks_of_rows, findings_of_rows
from cfree.verify.trapezoids import Reader, Side
from cfree.words import counted

SHARDS = "shards"


@dataclass(frozen=True)
class TileCheck:
    """Results for a tile.

    Attributes
    ----------
    trapezoids, checked : int
        Numbers of all trapezoids, and of those checked.
    digest : int
    findings : tuple of Finding
        Faults of the tile.
    """

    trapezoids: int
    checked: int
    digest: int
    findings: tuple[Finding, ...]


def verify_task(folder: str, stamp: str, tile: int, sample: int | None, seed: int) -> TileCheck:
    """Check a tile's trapezoids by the code of `cfree.verify`: all with all of their sides, or some of them."""
    work, name = opened(folder, stamp), f"tile {tile}"
    try:
        shard = work.shard(TRIMMED, tile)
        for stage in (work.surfaces, GLUED):
            work.shard(stage, tile)
    except FormatError as error:
        return TileCheck(0, 0, 0, (Finding(SHARDS, name, str(error)),))
    count = len(shard["kind"])
    chosen = set(range(count))
    if sample is not None and sample < count:
        chosen = set(random.Random(f"{seed} {tile}").sample(range(count), sample))
    with collection_paused():
        findings = _findings(work, tile, chosen, len(chosen) == count) if chosen else iter(())
        wrong = tuple(Finding(finding.kind, f"{name}, {finding.where}", finding.text) for finding in findings)
    return TileCheck(count, len(chosen), digest(shard), wrong)


def _findings(work: Work, tile: int, chosen: set[int], is_all: bool) -> Iterator[Finding]:
    """Findings about some rows of a tile, and, if they are all, about their sides."""
    rows = work.rows(tile, TRIMMED, around=is_all, obstacles=work.division.listed("obstacles", tile))
    scene = work.store.scene(rows.part.numbers)
    stored = boundary_of(scene, rows.part.features, rows.core)
    if work.store.is_round:
        yield from _round_findings(work, rows, stored, tile, chosen, is_all)
        return
    contacts = stored.contact_kind, stored.contact_robot, stored.contact_obstacle
    reader = Reader(scene, contacts, stored.trapezoids, stored.isolated)
    loops: dict[int, list[Side | None]] = {}
    own = []
    for k, (where, row) in enumerate(zip(rows.tile.tolist(), rows.row.tolist(), strict=True)):
        if where != tile:
            loops[k] = reader.trapezoid(k).sides()
        elif row in chosen:
            own.append(k)
    for begin in range(0, len(own), BLOCK):
        yield from trapezoid_findings(reader, own[begin : begin + BLOCK], loops)
    if is_all:
        for owners, number in sorted(matched(reader, loops).unmatched.items()):
            if mine := [int(rows.row[k]) for k in owners if rows.tile[k] == tile]:
                yield Finding(CLOSED, f"rows {mine}", f"{counted(number, 'edge')} of their sides without a partner")


def _round_findings(
    work: Work, rows: Rows, stored: Boundary, tile: int, chosen: set[int], is_all: bool
) -> Iterator[Finding]:
    """The same among round shapes."""
    own = {k for k in range(len(rows.row)) if rows.tile[k] == tile and int(rows.row[k]) in chosen}
    looked_at = range(len(rows.row)) if is_all else sorted(own)
    cores = work.store.cores(stored.scene.obstacles)
    yield from findings_of_rows(stored, cores, work.store.complement, looked_at, own)


def cells_findings(folder: Path, key: str) -> list[Finding]:
    """Findings for damage to the file of closed surfaces and cells."""
    try:
        read_shard(folder / "cells.npz", key)
    except FormatError as error:
        return [Finding(SHARDS, "cells", str(error))]
    return []


def summary(
    checks: Sequence[TileCheck], wrong: Sequence[Finding], expected: str, begin: float, *, is_round: bool
) -> Verification:
    """Join results of all tiles and findings about other files; the digest of the whole must be the expected one."""
    findings = [*wrong, *(finding for check in checks for finding in check.findings)]
    total = f"{sum(check.digest for check in checks) % MODULUS:064x}"
    if total != expected:
        findings.append(Finding(SHARDS, "the manifest", f"digest {expected}, and that of the shards is {total}"))
    count, looked_at = (sum(getattr(check, name) for check in checks) for name in ("trapezoids", "checked"))
    closed = Check(CLOSED, SKIPPED, "needs every trapezoid")
    if looked_at == count:
        closed = Check(CLOSED, PROVED, "all sides have partners")
    shards = f"those of {counted(len(checks), 'tile')} are as they were written; their digest is that of the manifest"
    of_rows = checks_of_rows if is_round else trapezoid_checks
    lines = (Check(SHARDS, PROVED, shards), *of_rows(looked_at, count), closed)
    return Verification(refuted(lines, findings), tuple(findings), (), time.perf_counter() - begin)
