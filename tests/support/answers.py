"""Answers that are right: paths that touch, slide and keep away, proofs of all sorts."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path as FilePath

from cfree import (
    Curved,
    Path,
    Pose,
    Rotation,
    Scene,
    Separated,
    Slide,
    Translation,
    boundary,
    free_space,
    plan,
    save,
    separation,
)
from cfree.collision import Touch
from cfree.curves import Arc
from cfree.scene.scene import with_ends
from compared import scene_of
from shapes import PlainScene, box, l_shape
from spaces import ROD, TIGHT, hollow


def corridor() -> tuple[Scene, Path]:
    """A rod in corridors around a block: it turns where there is room, and touches the block on its way."""
    walls = [hollow((-6, -3, 26, 26), (-4, -1, 24, 24)), box(8, 3, 20, 20)]
    up, round_it = Translation((0, 3)), Rotation((0, 3), {"tau": "-inf"})
    quarter = Rotation((0, 3), {"tau": "1/2"}), Rotation((0, 3), {"tau": "1/3"})
    on = Translation((0, 17)), Rotation((0, 20), {"tau": -1}), Translation((10, 2))
    scene = scene_of(PlainScene([ROD], walls, bounds=(0, 0, 10, 22)))
    path = Path(Pose(0, 0), [up, round_it, *quarter, *on], scene=scene)
    return with_ends(scene, path.start, path.goal), path


def rounded() -> tuple[Scene, Path]:
    """A stadium in corridors as wide as it: it turns in a room of radius sqrt(10), and touches a disc."""
    arcs = Arc((1, 3), center=(0, 0)), Arc((-3, 1), center=(0, 0))
    room = Curved([(-9, -1), (-3, -1), arcs[0], (1, 9), (-1, 9), (-1, 3), arcs[1], (-9, 1)])
    robot = Curved([(-1, -1), (1, -1), Arc((1, 1), center=(1, 0)), (-1, 1), Arc((-1, -1), center=(-1, 0))])
    path = Path(Pose(-5, 0), [Translation((5, 0)), Rotation((0, 0), {"tau": 1}), Translation((0, 5))])
    disc = Curved.circle(("5/2", 0), "1/2")
    scene = Scene(robot, [disc], workspace=room, start=path.start, goal=path.goal)
    return scene, replace(path, scene=scene)


def tee() -> tuple[Scene, Path]:
    """A square turns from one corridor as wide as it into another: two contacts slide at the same time."""
    walls = [(-9, 0), (9, 0), (9, 2), (1, 2), (1, 9), (-1, 9), (-1, 2), (-9, 2)]
    touches = Touch("vertex-edge", (0, 0), (-2, 1)), Touch("edge-vertex", (0, 2), (-2, 6))
    turn = Slide(touches, [0, 0, -2, 2], [0, 2, -2], [1, 0, 1], 1)
    parts = [turn.until("1/3"), turn.between("1/3", 1)]
    path = Path(Pose(-5, 1), [Translation((5, 0)), *parts, Translation((0, 6))])
    scene = Scene(box(-1, -1, 1, 1)[0], workspace=walls, start=path.start, goal=path.goal)
    return scene, replace(path, scene=scene)


@cache
def separations() -> tuple[tuple[Scene, Separated], ...]:
    """Scenes and proofs: by obstacles, closed; by bounds and an obstacle; by a workspace; interior; of two parts."""
    two = [box(0, 0, 2, 1), box(3, 0, 4, 1)]
    narrow, gate = [[box(-9, -1, -x, 1), box(x, -1, 9, 1)] for x in (Fraction(9, 10), 1)]
    scenes = [
        (PlainScene([ROD], [TIGHT]), Pose(0, 0), Pose(0, 0, "180deg")),
        (PlainScene([ROD], [box(-1, -9, 1, 9)], bounds=(-6, -6, 6, 6)), Pose(-5, "1/3"), Pose(5, 0, {"tau": "1/30"})),
        (PlainScene([ROD], narrow, workspace=box(-9, -9, 9, 9)), Pose(0, 5), Pose(0, -5, "7deg")),
        (PlainScene([box(-1, -1, 1, 1)], gate, workspace=box(-9, -9, 9, 9)), Pose(0, 5), Pose("1/3", -5, "7deg")),
        (PlainScene(two, [hollow((-9, -9, 9, 9), (-7, -7, 7, 7))]), Pose(0, 0), Pose(20, 0)),
    ]
    pairs = []
    for plain, start, goal in scenes:
        scene = scene_of(plain)
        proof = separation(free_space(boundary(scene, threads=1)), start, goal)
        assert proof is not None
        pairs.append((scene, proof))
    assert [proof.of for _, proof in pairs] == ["closed", "closed", "closed", "interior", "closed"]
    return tuple(pairs)


@cache
def distances() -> tuple[tuple[Scene, Path | Separated], ...]:
    """A path and a proof in a gate with 1/2 to spare on both sides of a robot of two convex pieces."""
    robot, walls = l_shape("3/2", "1/2")[0], [box(-9, -1, "-5/4", 1)[0], box("5/4", -1, 9, 1)[0]]
    scene = Scene([(Fraction(x) - 1, Fraction(y) - 1) for x, y in robot], walls, workspace=box(-9, -9, 9, 9)[0])
    answers = [plan(scene, (-1, 4, 0), (0, -4, 0), clearance=c) for c in ("1/4", "3/5")]
    assert [type(answer) for answer in answers] == [Path, Separated]
    return tuple((scene, answer) for answer in answers)


def text_of(answer: Path | Separated) -> str:
    with tempfile.TemporaryDirectory() as folder:
        save(answer, f"{folder}/answer.json")
        return FilePath(folder, "answer.json").read_text()
