"""Check that a separation is a proof: its pieces are contacts without a boundary mod 2, with the poses on two sides."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from cfree.forbidden.columns import ISOLATED_COLUMNS, IsolatedParts
from cfree.planning.separation import Pieces
from cfree.scene.scene import Scene
from cfree.verify.closing import odd_ends
from cfree.verify.columns import Columns
from cfree.verify.inside import is_near, strictly_inside
from cfree.verify.motions import touches
from cfree.verify.parity import around, is_inside
from cfree.verify.result import Finding
from cfree.verify.surfaces import Fault
from cfree.verify.trapezoids import Reader, Trapezoid
from cfree.verify.world import Feature, numbers
from cfree.words import counted

if TYPE_CHECKING:
    from cfree.planning.separation import Separated
    from cfree.verify.world import World

INSIDE, CONTACTS, CLOSED, SIDES = "smaller robot", "contacts", "closed surface", "two sides"
BLOCK = 100  # pieces between two reports


def separation_findings(proof: Separated, world: World, report: Callable[[float], object]) -> Iterator[Finding]:
    """Findings about a separation in a scene."""
    scene, apart = world.scene, False
    if proof.of == "closed":
        yield from _not_inside(proof, scene)
        scene = Scene(proof.robot or scene.robot, scene.obstacles, bounds=proof.bounds, workspace=scene.workspace)
    elif proof.of != "interior" or proof.robot or proof.bounds or proof.clearance:
        yield Finding(INSIDE, proof.of, 'a smaller robot, and a clearance, belong to "closed"')
    else:
        apart = any(touches(world, pose) for pose in (proof.start, proof.goal))
    try:
        reader = _reader(proof.pieces, scene)
    except Fault as fault:
        yield Finding(CONTACTS, "the surface", str(fault))
        return
    columns, trapezoid = Columns(reader), lru_cache(maxsize=None)(reader.trapezoid)
    unproved = np.flatnonzero(~columns.proved).tolist()
    refuted = False
    for done, k in enumerate(unproved):
        if done % BLOCK == 0:
            report(done / len(unproved))
        try:
            piece = trapezoid(k)
            piece.check(piece.turn())
        except Fault as fault:
            yield Finding(CONTACTS, f"piece {k}", str(fault))
            refuted = True
        except IndexError:
            yield Finding(CONTACTS, f"piece {k}", "it names a feature that does not exist")
            refuted = True
    if refuted:
        return
    if odd := odd_ends(columns, trapezoid):
        yield Finding(CLOSED, "the surface", f"sides of its pieces end at {counted(odd, 'place')} without a partner")
    if not apart:
        yield from _one_side(proof, columns, trapezoid)


def _not_inside(proof: Separated, scene: Scene) -> Iterator[Finding]:
    """Findings about the smaller robot; with a clearance, cores are inside, and it is nearer to them than that."""
    if not proof.robot or len(proof.cores) != (len(proof.robot) if proof.clearance else 0):
        yield Finding(INSIDE, "smaller robot", "there is none, or not as many cores as its polygons")
    for k, (part, core) in enumerate(zip(proof.robot, proof.cores, strict=False)):
        if not is_near(part, core, proof.clearance):
            yield Finding(INSIDE, f"polygon {k}", "its core is not convex, or it is not everywhere nearer to that")
    for k, part in enumerate(proof.cores or proof.robot):
        if not any(strictly_inside(part, polygon) for polygon in scene.robot):
            yield Finding(INSIDE, f"polygon {k}", "it is not strictly inside one of the robot's polygons")
    if proof.bounds:
        x0, y0, x1, y1 = scene.bounds or proof.bounds
        X0, Y0, X1, Y1 = proof.bounds
        if not (x0 > X0 and y0 > Y0 and x1 < X1 and y1 < Y1):
            yield Finding(INSIDE, "larger bounds", "the scene's bounds are not strictly inside them")


def _one_side(proof: Separated, columns: Columns, trapezoid: Callable[[int], Trapezoid]) -> Iterator[Finding]:
    inside, scale = [], columns.reader.world.scale
    for name, pose in (("start", proof.start), ("goal", proof.goal)):
        try:
            inside.append(is_inside(pose, scale, map(trapezoid, around(columns, pose, scale))))
        except Fault as fault:
            yield Finding(SIDES, name, str(fault))
    if len(inside) == 2 and inside[0] == inside[1]:
        where = "inside" if inside[0] else "outside"
        yield Finding(SIDES, "start and goal", f"both are {where} the surface")


# --- from names in an answer to numbers of features ---


def _reader(pieces: Pieces, scene: Scene) -> Reader:
    columns: dict[str, Any] = {name: np.empty(0, np.int32) for name in ISOLATED_COLUMNS}
    contacts = pieces.kind, np.empty(0, np.int32), np.empty(0, np.int32)
    auxiliary: dict[Feature, Any] = {(item.of, item.kind, item.number): item.points for item in pieces.auxiliary}
    reader = Reader(scene, contacts, pieces.table, IsolatedParts(**columns), auxiliary)
    world = reader.world
    robot, obstacle = numbers(world.robot, pieces.robot.tolist()), numbers(world.obstacles, pieces.obstacle.tolist())
    reader.contacts = pieces.kind, robot, obstacle
    return reader
