"""Estimate how long a boundary takes before it is computed, and refuse what takes far longer than its size suggests.

Each contact patch of a robot of many pieces may have all pairs of its pieces and the obstacles' beside it. Edges that
are parallel but for the last digit make each pair dear. A few patches, spread over all, tell of both. The estimate is
made of counts: it is the same on every machine.
"""

from __future__ import annotations

from dataclasses import dataclass

import cfree._core as _core
from cfree.errors import LaboriousSceneError
from cfree.scene.features import SceneFeatures
from cfree.scene.scene import Scene
from cfree.words import counted

MOST_STEPS = 70_000_000  # steps of about 0.1 microseconds: with all else, some 10 s of one core
MANY_VERTICES, FEW_PATCHES = 2_000, 4_000  # no estimate for larger scenes, nor for fewer patches
FIRST_LOOK, SECOND_LOOK = 32, 128  # numbers of patches
GO_ON = "max_seconds=math.inf to go on"  # the remedy in Python


@dataclass(frozen=True)
class Labour:
    """Number of patches of a boundary; estimated pairs of a patch and a pillar near it, signs, steps of equal time."""

    patches: int
    pairs: float
    signs: float
    steps: float


def labour(features: SceneFeatures, samples: int) -> Labour:
    """Estimate the labour of a boundary from this many patches."""
    count, patches = _core.sampled_count(features.core, samples)
    by = patches / min(samples, patches)
    doubles, intervals, integers = count.decided_by_filter, count.decided_by_intervals, count.decided_exactly
    # measured: a pair with all that is computed beside its signs, and signs by rung
    steps = doubles + 3 * intervals + 110 * integers + 12 * count.pairs
    return Labour(patches, by * count.pairs, by * (doubles + intervals + integers), by * steps)


def refuse_laborious(scene: Scene, features: SceneFeatures) -> None:
    """Raise `LaboriousSceneError` if the boundary of a scene of few vertices takes long."""
    robot, obstacles = (sum(map(len, shapes)) for shapes in (scene.robot, scene.obstacles))
    if robot + obstacles >= MANY_VERTICES or features.patches < FEW_PATCHES:
        return
    if labour(features, FIRST_LOOK).steps < MOST_STEPS / 4:
        return
    estimate = labour(features, SECOND_LOOK)
    if estimate.steps <= MOST_STEPS:
        return
    raise LaboriousSceneError(
        f"{counted(robot, 'vertex', 'vertices')} of the robot among {obstacles:,}: {estimate.patches:,} contact "
        f"patches, about {_rounded(estimate.pairs)} pairs with pillars beside them, {_rounded(estimate.signs)} signs "
        f"to decide; cfree.plan needs few of them. Give simpler shapes, or {GO_ON}",
        pairs=round(estimate.pairs),
    )


def _rounded(count: float) -> str:
    """Two digits of a number, and zeros."""
    return f"{float(f'{count:.1e}'):,.0f}"
