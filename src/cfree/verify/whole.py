"""Answers of folders: they are about some obstacles of a scene, and are checked in the scene with all of them.

A separating surface among some of the obstacles separates two poses among all, so a separation is checked among its
own. A path is checked among all.
"""

from __future__ import annotations

from cfree.paths.path import Path
from cfree.planning.goals import AllSeparated
from cfree.planning.proof import Proof
from cfree.scene.digest import Whole, stamp_of
from cfree.scene.scene import Scene


def whole_of(scene: Scene, answer: Path | Proof | AllSeparated) -> Whole | None:
    """The answer's record of the whole scene, if this scene is that one."""
    whole = None if isinstance(answer, AllSeparated) else answer.whole
    return whole if whole is not None and whole.sha256 == stamp_of(scene).sha256 else None


def part_of(scene: Scene, answer: Path | Proof, whole: Whole) -> Scene | None:
    """Scene with the obstacles that an answer is about; None if its scene is another one."""
    if whole.obstacles and not whole.obstacles[-1] < len(scene.obstacles):
        return None
    obstacles = [scene.obstacles[k] for k in whole.obstacles]
    part = Scene(scene.robot, obstacles, bounds=scene.bounds, workspace=scene.workspace)
    return None if answer.stamp is not None and answer.stamp.sha256 != stamp_of(part).sha256 else part
