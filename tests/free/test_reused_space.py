"""A free space that takes faces of another one is, byte by byte, the free space computed anew."""

import pickle
import random
from pathlib import Path

import numpy as np
import pytest

import cfree
from cfree.forbidden.boundary import boundary
from cfree.free.space import FreeSpace, free_space
from cfree.scene.scene import Scene
from changes import BAR, box, changed, random_scene

ROOT = Path(__file__).parents[2]
HOUSES = [box(10 * x, 10 * y, 3, 2 + x) for x in range(4) for y in range(3)]
RING = cfree.Polygon([(50, 0), (70, 0), (70, 20), (50, 20)], [[(52, 2), (52, 18), (68, 18), (68, 2)]])
SPACE_COLUMNS = ("component", "parent", "free_inside", "cell_of", "turns", "lift", "depth")
COMPLEX_COLUMNS = ("first", "face", "side", "twin", "edge", "vertex", "component", "x", "y", "theta", "near")


def assert_same_bytes(one: FreeSpace, other: FreeSpace) -> None:
    for name in SPACE_COLUMNS:
        assert getattr(one, name).tobytes() == getattr(other, name).tobytes(), name
    for name in COMPLEX_COLUMNS:
        assert getattr(one.complex, name).tobytes() == getattr(other.complex, name).tobytes(), name
    for name in ("edges", "vertices", "components"):
        assert getattr(one.complex, name) == getattr(other.complex, name)
    assert [cell.__dict__ | {"free_space": None} for cell in one.cells] == [
        cell.__dict__ | {"free_space": None} for cell in other.cells
    ]


def space_of(scene: Scene) -> FreeSpace:
    return free_space(boundary(scene, threads=1), threads=1)


def reused(before: Scene | FreeSpace, after: Scene) -> FreeSpace:
    old = before if isinstance(before, FreeSpace) else space_of(before)
    new = free_space(boundary(after, threads=1, reuse=old.boundary), threads=1, reuse=old)
    assert_same_bytes(new, space_of(after))
    return new


# examples


def test_cells_of_a_scene_of_which_one_obstacle_moves() -> None:
    scene = Scene(BAR, [*HOUSES, RING])
    assert len(reused(scene, scene.moved(0, (0, 7, 0)))) == 2
    assert len(reused(scene, scene.without_obstacle(12))) == 1
    assert len(reused(scene.without_obstacle(12), scene)) == 2
    assert len(reused(scene, scene.with_obstacle(box(59, 1, 2, 18)))) == 3  # a wall through the ring


def test_faces_of_kept_patches_are_not_glued_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """A space that cannot be reused costs more: here its complex is missing."""
    scene = Scene(BAR, HOUSES)
    old, calls = space_of(scene), []
    glue = cfree._core.glue
    monkeypatch.setattr(cfree._core, "glue", lambda *given: calls.append(given) or glue(*given))
    free_space(boundary(scene.moved(0, (1, 0, 0)), threads=1, reuse=old.boundary), threads=1, reuse=old)
    assert calls[0][2] is old.surfaces._complex_handle


def test_the_boundary_may_be_computed_anew() -> None:
    scene = Scene(BAR, [*HOUSES, RING])
    old, moved = space_of(scene), scene.moved(3, (1, 0, 0))
    assert_same_bytes(free_space(boundary(moved, threads=1), threads=1, reuse=old), space_of(moved))


def test_volumes_and_places_are_those_computed_anew() -> None:
    scene = Scene(BAR, [*HOUSES, RING])
    moved = scene.moved(3, (1, 0, 0))
    new, anew = reused(scene, moved), space_of(moved)
    assert new.volumes.tobytes() == anew.volumes.tobytes()
    poses = [cfree.Pose(x, y) for x in range(-2, 72, 6) for y in range(-2, 30, 5)]
    assert new.locate(poses).tolist() == anew.locate(poses).tolist()
    assert new.boundary.mesh(0.5).vertices.tobytes() == anew.boundary.mesh(0.5).vertices.tobytes()


def test_threads_do_not_matter() -> None:
    scene = Scene(BAR, [*HOUSES, RING])
    old, moved = space_of(scene), scene.moved(3, (1, 0, 0))
    new = boundary(moved, threads=1, reuse=old.boundary)
    assert_same_bytes(free_space(new, threads=2, reuse=old), space_of(moved))


# properties


def test_many_changes_one_after_another() -> None:
    scene = Scene(BAR, [*HOUSES, RING])
    old = space_of(scene)
    for k in range(12):
        scene = scene.moved(k, (1, k % 3 - 1, 0))
        old = reused(old, scene)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(40))
def test_random_changes(seed: int) -> None:
    generator = random.Random(1000 + seed)
    scene, size, digits = random_scene(generator)
    old = space_of(scene)
    for _ in range(4):
        scene = changed(generator, scene, size, digits)
        old = reused(old, scene)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["benchmr_warehouse", "nest_swim", "street_Berlin"])
def test_an_obstacle_of_a_real_scene_moved(name: str) -> None:
    scene = cfree.load_scene(ROOT / "examples" / "scenes" / f"{name}.json")
    old = space_of(scene)
    for k in (0, len(scene.obstacles) // 2):
        reused(old, scene.moved(k, ("0.5", 0, 0)))
        reused(old, scene.moved(k, (0.123, 0.4, 0.3)))


# limits


def test_nothing_is_taken_without_a_boundary_to_match() -> None:
    scene = Scene(BAR, HOUSES)
    moved = scene.moved(0, (1, 0, 0))
    copy = pickle.loads(pickle.dumps(space_of(scene)))
    assert_same_bytes(free_space(boundary(moved, threads=1), threads=1, reuse=copy), space_of(moved))
    other = space_of(Scene(box(0, 0, 2, 2), HOUSES))  # another robot
    assert_same_bytes(free_space(boundary(moved, threads=1), threads=1, reuse=other), space_of(moved))


def test_slits_at_bounds_are_computed_anew() -> None:
    scene = Scene(BAR, [box(2, 0, 1, 1), box(7, 5, 1, 1), box(30, 30, 1, 1)], bounds=(0, 0, 40, 40))
    old = space_of(scene)
    assert old.surfaces is not old.boundary
    reused(old, scene.moved(1, (1, 0, 0)))


def test_round_shapes_are_computed_anew() -> None:
    disc = cfree.Curved.circle((0, 0), 1)
    scene = Scene(BAR, [disc, box(9, 9, 1, 1)])
    old, moved = space_of(scene), scene.moved(1, (1, 0, 0))
    assert_same_bytes(free_space(boundary(moved, threads=1), threads=1, reuse=old), space_of(moved))


def test_reuse_takes_a_free_space() -> None:
    old = space_of(Scene(BAR, HOUSES))
    with pytest.raises(TypeError, match=r"reuse: .* give a FreeSpace"):
        free_space(old.boundary, reuse=old.boundary)  # type: ignore[arg-type]


def test_places_of_vertices_are_there_though_they_were_not_glued() -> None:
    scene = Scene(BAR, HOUSES)
    new = reused(scene, scene.moved(0, (1, 0, 0)))
    assert np.isfinite(new.complex.x).all()
    assert len(new.complex.x) == new.complex.vertices
