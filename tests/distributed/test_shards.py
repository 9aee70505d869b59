"""Boundaries in folders: the same trapezoids, surfaces and cells as in one process, for any tiles."""

from __future__ import annotations

import random
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cfree
import cfree._core as _core
import fuzz_routes
from cfree.curves import Circle
from cfree.distributed import Sharded, boundary
from cfree.distributed.part import Part
from cfree.distributed.store import SceneStore, store_scene
from cfree.distributed.trim import digest, trim_tile
from compared import scene_of
from examples import POLYGONS
from round_tiles import round_scene, tile_faults
from shapes import KINDS, random_scene

SCENES = Path(__file__).parents[2] / "examples" / "scenes"
TRIANGLE = [(0, 0), (2, 0), (0, 1)]


def stored(scene: cfree.Scene, folder: Path) -> SceneStore:
    return store_scene(scene, [], folder)


def check_tiles(scene: cfree.Scene, folder: Path, counts: tuple[int, ...] = (1, 7, 64)) -> None:
    """The same for all numbers of tiles, and the same as in memory."""
    space = cfree.free_space(cfree.boundary(scene))
    digests = set()
    for tiles in counts:
        found = boundary(scene, folder=folder / str(tiles), tiles=tiles)
        surfaces = found.surfaces
        volumes = found.cells.volume.tobytes(), found.cells.volume_error.tobytes()
        digests.add((found.digest, found.trapezoids, *volumes))
        assert np.array_equal(surfaces.faces, np.bincount(space.component, minlength=len(space.parent)))
        assert np.array_equal(surfaces.euler, space.complex.euler)
        for name in ("parent", "free_inside", "turns", "cell_of"):
            assert np.array_equal(getattr(surfaces, name), getattr(space, name)), name
        volume, error = found.cells.volume, found.cells.volume_error
        bounded = np.isfinite(space.volumes)
        assert np.array_equal(np.isfinite(volume), bounded) and np.all(error[bounded] <= 1e-6 * (1 + volume[bounded]))
        assert np.all(abs(volume[bounded] - space.volumes[bounded]) <= (error + space.volume_errors)[bounded])
        assert found.cells.caged.tolist() == [cell.caged for cell in space.cells]
        if tiles <= 7:
            check_cells_of_poses(found, space)
    assert len(digests) == 1


def check_cells_of_poses(found: Sharded, space: cfree.FreeSpace) -> None:
    """Of poses anywhere, and of those in contact, in line with vertices, at critical orientations and chart borders."""
    scene, rng = space.boundary.scene, random.Random(5)
    points = [p for polygon in (*scene.obstacles, scene.workspace) if polygon for p in polygon.exact_vertices]
    points = points or [(Fraction(0), Fraction(0))]
    x0, y0, x1, y1 = (float(f(p[k] for p in points)) + s for f, s in ((min, -2), (max, 2)) for k in (0, 1))
    poses = cfree.Poses(
        [(rng.uniform(x0, x1), rng.uniform(y0, y1)) for _ in range(100)], [rng.uniform(0, 7) for _ in range(100)]
    )
    assert found.locate(poses).tolist() == space.locate(poses).tolist()
    special = []
    for tau in ("0", "1", "-1", "inf", "1/2", "-3"):
        turned = cfree.Pose(0, 0, {"tau": tau}).apply_exact([rng.choice(scene.robot[0].exact_vertices)])[0]
        for p, q in (rng.choices(points, k=2) for _ in range(8)):
            special += [cfree.Pose(p[0] - turned[0], y - turned[1], {"tau": tau}) for y in (p[1], q[1])]
            special.append(cfree.Pose(rng.uniform(x0, x1), q[1] - turned[1], {"tau": tau}))
    special += [pose for pose in (scene.start, scene.goal) if pose is not None]
    assert found.locate(special).tolist() == space.locate(special).tolist()


@pytest.mark.slow
@pytest.mark.parametrize(
    "path",
    [
        pytest.param(path, marks=() if path.stem == "degenerate_island" else pytest.mark.slow)
        for path in POLYGONS
        if path.stem not in ("benchmr_warehouse", "nest_swim", "street_Berlin")
    ],
    ids=lambda path: path.stem,
)
def test_example_scenes_are_the_same_in_any_tiles(path: Path, tmp_path: Path) -> None:
    """Every other one in 64, which takes as long as the rest."""
    check_tiles(cfree.load_scene(path), tmp_path, (1, 7, 64)[: 2 + POLYGONS.index(path) % 2])


@pytest.mark.slow
@pytest.mark.parametrize("kind", sorted(KINDS))
def test_random_scenes_are_the_same_in_any_tiles(kind: str, tmp_path: Path) -> None:
    check_tiles(scene_of(random_scene(11, kind)), tmp_path, (1, 5))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_borders_run_through_vertices_and_along_edges(seed: int, tmp_path: Path) -> None:
    """Squares on a lattice, some of them touching, in a hall; far away from the origin, and at quotients."""
    rng = random.Random(seed)
    at, unit = (0, Fraction(1)) if seed % 2 else (10**9, Fraction(1, 3))

    def box(x: Any, y: Any, w: Any, h: Any) -> list[tuple[Any, Any]]:
        corners = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]
        return [(at + unit * a, at + unit * b) for a, b in corners]

    places = rng.sample([(x, y) for x in range(4) for y in range(4)], 9)
    squares = [box(3 * x, 3 * y, 2 + rng.randint(0, 1), 2 + rng.randint(0, 1)) for x, y in places]
    robot = [(0, 0), (unit, 0), (unit, 2 * unit), (0, 2 * unit)]
    check_tiles(cfree.Scene(robot, squares, workspace=box(-3, -3, 18, 18)), tmp_path, (1, 4, 16))


@pytest.mark.slow
@pytest.mark.parametrize(("cosine", "sine"), [("1", "0"), ("3/5", "4/5"), ("-20/29", "21/29")])
@pytest.mark.parametrize("offset", ["0", "1000000000", "-1000000000/3"])
@pytest.mark.parametrize("seed", range(2))
def test_volumes_are_the_same_where_walls_of_many_tiles_are_in_line(
    seed: int, offset: str, cosine: str, sine: str, tmp_path: Path
) -> None:
    """Rooms whose walls have doors, of lengths with many digits: each tile holds other walls of one line."""
    rng = random.Random(seed)
    c, s, at = Fraction(cosine), Fraction(sine), Fraction(offset)

    def digits(low: int, high: int) -> Fraction:
        return Fraction(rng.randint(1000 * low, 1000 * high), 1000)

    def wall(x0: Fraction, y0: Fraction, x1: Fraction, y1: Fraction) -> list[tuple[Fraction, Fraction]]:
        corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
        return [(at + c * x - s * y, 2 * at + s * x + c * y) for x, y in corners]

    thick, size, count = Fraction(3, 20), 4, 3
    walls = []
    for k in range(count + 1):
        across = [Fraction(size * k), size * k + thick]
        for j in range(count):
            begin, end = size * j + thick, Fraction(size * (j + 1))
            is_closed = k in (0, count) or rng.random() < 0.3
            jambs = begin + digits(1, 2), end - digits(0, 1) - thick / 2
            for x0, x1 in [(begin, end)] if is_closed else [(begin, jambs[0]), (jambs[1], end)]:
                walls += [wall(x0, across[0], x1, across[1]), wall(across[0], x0, across[1], x1)]
    robot = [(0, 0), (digits(1, 2), 0), (digits(0, 1), digits(1, 2))]
    check_tiles(cfree.Scene(robot, walls), tmp_path, (1, 3, 16))


@pytest.mark.slow
def test_edges_and_polygons_lead_over_many_tiles(tmp_path: Path) -> None:
    """A wall along all others, and a comb around them, with bounds."""
    teeth = [p for k in range(9) for p in ((4 * k, 0), (4 * k, -3), (4 * k + 1, -3), (4 * k + 1, 0))]
    comb = [(-2, 1), (-2, -0), *teeth, (36, 0), (36, 1)][::-1]
    stones = [[(4 * k + 2, -5), (4 * k + 3, -5), (4 * k + 2, -4)] for k in range(9)]
    floor = [(-5, -9), (40, -9), (40, -8), (-5, -8)]
    check_tiles(cfree.Scene(TRIANGLE, [comb, *stones, floor], bounds=(-4, -8, 39, 2)), tmp_path, (1, 5, 40))


@pytest.mark.slow
@pytest.mark.parametrize(("family", "seed"), [("chain", 1), ("stadiums", 1), ("fits", 1)])
def test_rounded_shapes_are_the_same_in_any_tiles(family: str, seed: int, tmp_path: Path) -> None:
    """Tangent chains, corridors as wide as the robot, and concave arcs; shards are verified."""
    is_verified = family == "chain"
    assert [*tile_faults(round_scene(family, seed), tmp_path, (1, 4), is_verified=is_verified)] == []


@pytest.mark.slow
def test_a_surface_whose_widest_faces_coincide_with_others_is_nested(tmp_path: Path) -> None:
    """Grown walls, some of them in one place: hundreds of faces have no pair of poses beside them."""
    assert [*tile_faults(fuzz_routes.maze(257, is_round=True), tmp_path, (2,))] == []


def test_a_round_workspace_and_its_holes_are_in_tiles(tmp_path: Path) -> None:
    """A disc in a ring, cut by a wall: two cells, of one volume by symmetry; a path around, and a proof."""
    ring = cfree.Curved(Circle((0, 0), 4), [Circle((0, 0), 2)])
    walls = [[(2, -1), (4, -1), (4, 1), (2, 1)], [(-4, -1), (-2, -1), (-2, 1), (-4, 1)]]
    scene = cfree.Scene(cfree.Curved.circle((0, 0), "1/2"), walls, workspace=ring)
    assert [*tile_faults(scene, tmp_path, (1, 3))] == []
    found = boundary(scene, folder=tmp_path / "3", tiles=3)
    assert len(found.cells) == 2 and found.cells.volume[0] == pytest.approx(found.cells.volume[1], rel=1e-9)
    poses = [cfree.Pose(*place) for place in [(0, 3), ("-3/2", "5/2"), (0, -3)]]
    path, proof = found.plan(*poses[:2]), found.plan(poses[0], poses[2])
    assert isinstance(path, cfree.Path) and isinstance(proof, cfree.Separated)
    for answer in (path, proof):
        assert cfree.verify.answer(*found.scene_for(answer)).verified


def test_round_shapes_of_other_kinds_are_refused_by_number(tmp_path: Path) -> None:
    shapes = [cfree.Curved.circle((9, 0), 1), cfree.Curved.ellipse((0, 9), (1, 2))]
    with pytest.raises(cfree.UnsupportedError, match=r"obstacle 1: not bounded by lines and arcs .*scene.outer"):
        boundary(cfree.Scene(TRIANGLE, shapes), folder=tmp_path / "ellipse")


def test_trapezoids_are_those_of_the_whole(tmp_path: Path) -> None:
    """Column for column, the core asked at once and with its own constants."""
    scene = cfree.load_scene(SCENES / "comb_hook.json")
    store = stored(scene, tmp_path / "scene")
    part = Part(store, np.arange(len(store)))
    features = np.arange(len(part.features.obstacles.previous))
    shard = trim_tile(part, part.vertices[features])
    whole = _core.compute_boundary(
        cfree.scene.features.scene_features(scene).core, 1, False, lambda share: True, features=features.tolist()
    )
    rows = whole.trapezoids
    assert np.array_equal(part.codes(shard["keys"])[shard["lower"]], rows.lower)
    assert np.array_equal(shard["angle_tau"][shard["from"], 0], rows.from_lo)
    assert np.array_equal(shard["angle_tau"][shard["to"], 1], rows.to_hi)
    named = cfree.boundary(scene).trapezoids
    assert np.array_equal(whole.trapezoids.tau_from if hasattr(rows, "tau_from") else rows.from_lo, named.from_lo)
    assert digest(shard) != 0


def test_obstacles_are_read_as_they_were(tmp_path: Path) -> None:
    holed = cfree.Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(2, 2), (2, "10/3"), (3, 2)]])
    scene = cfree.Scene(TRIANGLE, [holed, [(20, 0), ("61/3", 0), (20, 10**40)]], bounds=(-5, -5, 99, 99))
    store = store_scene(scene, [], tmp_path / "scene")
    assert tuple(store.shapes([0, 1])) == scene.obstacles
    assert store.scene([1]).obstacles == scene.obstacles[1:] and store.head.bounds == scene.bounds


def test_nothing_at_all_has_a_boundary(tmp_path: Path) -> None:
    found = boundary(cfree.Scene(TRIANGLE), folder=tmp_path / "empty")
    assert (found.trapezoids, len(found.cells), found.obstacles) == (0, 1, 0)
