"""Check a separation among rounded shapes in an answer: `round_separation.py` checks the surface."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from cfree.libraries import NDArray, np
from cfree.planning.separation import Separated
from cfree.scene.features import ShapeFeatures, features_of_cores
from cfree.scene.grown_cores import Cores
from cfree.scene.scene import Scene, grown_scene
from cfree.verify.arc_motions import ArcWorld
from cfree.verify.motions import end_findings
from cfree.verify.result import Finding
from cfree.verify.round_proof import Features, RoundSeparation
from cfree.verify.round_separation import CONTACTS, INSIDE, round_separation_findings

TEXTS = {
    INSIDE: "{far}all shapes of the proof are in the scene's, and those of one side strictly",
    CONTACTS: "{count}: the smaller shapes touch at every pose of them, so that the scene's overlap",
}


def rounded_findings(
    proof: Separated, cores: Cores, scene: Scene, report: Callable[[float], object]
) -> Iterator[Finding]:
    """Findings about a separation among grown cores in a scene of segments and arcs."""
    true = grown_scene(scene, proof.clearance) if proof.clearance else scene
    world = ArcWorld(scene)
    yield from end_findings(proof, world.with_robot(proof.clearance) if proof.clearance else world)
    surface = surface_of(proof, cores, scene)
    if surface is None:
        yield Finding(CONTACTS, "pieces", "one names a feature that no core has")
        return
    yield from round_separation_findings(surface, true, report)


def surface_of(proof: Separated, cores: Cores, scene: Scene) -> RoundSeparation | None:
    """Return a separation in the form that is checked; None if a piece names no vertex of a core."""
    features = features_of_cores(cores, scene, proof.bounds)
    robot, obstacle = (
        _numbers(shape, pairs)
        for shape, pairs in ((features.robot, proof.pieces.robot), (features.obstacles, proof.pieces.obstacle))
    )
    if robot is None or obstacle is None:
        return None
    return RoundSeparation(
        cores.robot,
        cores.obstacles,
        Features.numbered(features.robot),
        Features.numbered(features.obstacles),
        proof.pieces.kind,
        robot,
        obstacle,
        proof.pieces.table,
        proof.start,
        proof.goal,
        proof.bounds,
        cores.straight(scene.workspace),
        cores.frames,
    )


def _numbers(shape: ShapeFeatures, pairs: NDArray[np.int32]) -> NDArray[np.int32] | None:
    """Return the numbers of vertices that are given by polygon and vertex."""
    owners = zip(shape.owner_polygon.tolist(), shape.owner_vertex.tolist(), strict=True)
    number = {owner: k for k, owner in enumerate(owners)}
    found = [number.get((polygon, vertex)) for polygon, vertex in pairs.tolist()]
    if None in found:
        return None
    return np.array(found, np.int32)
