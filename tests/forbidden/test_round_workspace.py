"""Boundaries and cells in round workspaces, against exact tests of poses, closed formulas and plates with a hole."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cfree
from arc_rings import CONCAVE, random_hall, shape
from cfree import Curved, Pose, Scene, boundary, free_space, is_free
from cfree.curves import Arc, Circle
from cfree.scene.complement import complement

SQUARE = [("-1/2", "-1/2"), ("1/2", "-1/2"), ("1/2", "1/2"), ("-1/2", "1/2")]
HALF, HAIR = Fraction(1, 2), Fraction(1, 2**60)
BAR = [(-1, "-1/4"), (1, "-1/4"), (1, "1/4"), (-1, "1/4")]


def room(rounding: Any, x: Any = 0, y: Any = 0) -> Curved:
    """A room of 8 by 6 whose corners are rounded."""
    r = cfree.exact.number.to_fraction(rounding)
    x0, y0, x1, y1 = x, y, x + 8, y + 6
    return Curved(
        [
            (x0 + r, y0), (x1 - r, y0), Arc((x1, y0 + r), center=(x1 - r, y0 + r)),
            (x1, y1 - r), Arc((x1 - r, y1), center=(x1 - r, y1 - r)),
            (x0 + r, y1), Arc((x0, y1 - r), center=(x0 + r, y1 - r)),
            (x0, y0 + r), Arc((x0 + r, y0), center=(x0 + r, y0 + r)),
        ]
    )  # fmt: skip


HALL = Curved(Circle((0, 0), 5), [Circle((1, 1), 1), [(-3, -1), (-2, -1), (-2, 1)]])


def test_a_disc_in_a_round_workspace_has_one_round_cell() -> None:
    found = boundary(Scene(Curved.circle((0, 0), 1), workspace=Curved.circle((1, "1/2"), 3)))
    space = free_space(found)
    assert len(space.volumes) == 1 and math.isclose(space.volumes[0], math.tau * math.pi * 4, rel_tol=1e-9)
    assert {patch.obstacle.name for patch in found.patches} == {"workspace"}


def test_nothing_is_free_in_a_workspace_that_is_too_small() -> None:
    space = free_space(boundary(Scene(Curved.circle((0, 0), "1.01"), workspace=Curved.circle((0, 0), 1))))
    assert len(space.volumes) == 0 and not len(space.boundary.trapezoids)


@pytest.mark.parametrize("at", [(0, 0), (10**9, "1/3")])
def test_a_room_with_round_corners_has_the_contacts_of_a_plate_with_it_as_a_hole(at: tuple[Any, Any]) -> None:
    x, y = map(cfree.exact.number.to_fraction, at)
    inside = room("3/2", x, y)
    scene = Scene(BAR, [Curved.circle((x + 3, y + 2), "1/2")], workspace=inside)
    plate = Curved([(x - 9, y - 9), (x + 20, y - 9), (x + 20, y + 20), (x - 9, y + 20)], [inside.path])
    other = Scene(BAR, [Curved.circle((x + 3, y + 2), "1/2"), plate])
    volume = free_space(boundary(scene)).volumes
    assert np.allclose(sorted(volume), sorted(v for v in free_space(boundary(other)).volumes if math.isfinite(v)))


def test_holes_and_obstacles_in_a_round_workspace_are_forbidden() -> None:
    scene = Scene(SQUARE, [shape(CONCAVE["bay"], 0, -2)] if "bay" in CONCAVE else [SQUARE], workspace=HALL)
    space, rng = free_space(boundary(scene)), random.Random(1)
    assert len(complement(scene)) == 3
    for _ in range(400):
        pose = Pose(rng.uniform(-6, 6), rng.uniform(-6, 6), rng.uniform(0, math.tau))
        assert (space.locate(pose) >= 0) == is_free(scene, pose), pose


@pytest.mark.slow
@pytest.mark.parametrize("robot", [BAR, Curved.circle(("1/3", 0), "1/2"), shape(CONCAVE[next(iter(CONCAVE))])])
@pytest.mark.parametrize("bounds", [None, (-3, -3, 3, "7/2")])
def test_boundaries_in_round_workspaces_are_verified(robot: Any, bounds: Any) -> None:
    scene = Scene(robot, workspace=HALL, bounds=bounds)
    result = boundary(scene)
    assert np.all(result.complex.euler % 2 == 0)
    found = cfree.verify.boundary(result, scene, slices=3)
    assert found.verified, found.findings


def test_a_boundary_in_a_round_workspace_is_written_and_read(tmp_path: Path) -> None:
    result = boundary(Scene(SQUARE, workspace=HALL))
    cfree.save(result, tmp_path / "hall.npz")
    read = cfree.load(tmp_path / "hall.npz")
    assert read.scene == result.scene and np.array_equal(read.trapezoids.patch, result.trapezoids.patch)
    assert {patch.obstacle.ring for patch in read.patches} == {0, 1, 2}


def test_a_workspace_with_an_ellipse_is_refused_by_name() -> None:
    with pytest.raises(cfree.UnsupportedError, match=r"^workspace: not bounded by lines and arcs"):
        boundary(Scene(SQUARE, workspace=Curved.ellipse((0, 0), (3, 5))))


@pytest.mark.slow
@pytest.mark.parametrize("clearance", [None, HALF / 2])
def test_a_gap_of_a_round_hall_too_narrow_by_a_hair_has_a_proof(clearance: Fraction | None, tmp_path: Path) -> None:
    walls = [Curved.circle((0, y), 3) for y in (HALF * 7, -HALF * 7)]
    for excess in (HAIR, -HAIR):
        scene = Scene(
            Curved.circle((0, 0), HALF + excess - (clearance or 0)), walls, workspace=Curved.circle((0, 0), 5)
        )
        answer = cfree.plan(scene, Pose(-2, 0), Pose(2, 0), clearance=clearance)
        assert isinstance(answer, cfree.Path) == (excess < 0)
        cfree.save(answer, tmp_path / "answer.json")
        assert cfree.verify.answer(scene, cfree.load(tmp_path / "answer.json")).verified


@pytest.mark.slow
def test_a_proof_for_another_round_workspace_is_refuted() -> None:
    walls = [Curved.circle((0, y), 3) for y in (HALF * 7, -HALF * 7)]
    robot = Curved.circle((0, 0), HALF + HAIR)
    scenes = [Scene(robot, walls, workspace=Curved.circle((0, 0), radius)) for radius in (5, 6)]
    proof = cfree.plan(scenes[0], Pose(-2, 0), Pose(2, 0))
    assert isinstance(proof, cfree.Separated)
    assert cfree.verify.answer(scenes[0], proof).verified and not cfree.verify.answer(scenes[1], proof).verified


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_cells_of_random_halls_are_those_of_exact_poses(seed: int) -> None:
    scene, rng = random_hall(seed), random.Random(seed)
    result = boundary(scene)
    space = free_space(result)
    x0, y0, x1, y1 = map(float, scene.workspace.box)  # type: ignore[union-attr]
    for _ in range(60):
        pose = Pose(rng.uniform(x0 - 1, x1 + 1), rng.uniform(y0 - 1, y1 + 1), rng.uniform(0, math.tau))
        assert (space.locate(pose) >= 0) == is_free(scene, pose), pose
    assert cfree.verify.boundary(result, scene, slices=1).verified
