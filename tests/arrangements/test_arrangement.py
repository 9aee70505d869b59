"""The arrangement of all contact surfaces: against slices, single poses, the free space, and what is known by hand."""

from __future__ import annotations

import contextlib
import json
import math
import pickle
import random
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from matplotlib.colors import to_rgb
from shapely.affinity import rotate, translate

import cfree
import fuzz
from cfree import Pose, Scene, UnsupportedError
from cfree.arrangements import Arrangement, arrangement, arrangement_json, planar_cells, save_arrangement
from cfree.plot import plot_depths, plot_faces
from cfree.plot.depths import depth_colours
from compared import scene_of
from shapes import PlainScene
from sliced_cells import Unclear, sliced_cells

TRIANGLE = [(0, 0), (2, 0), (0, 1)]
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def cells_of(whole: Arrangement) -> Counter[tuple[frozenset[tuple[int, int]], int]]:
    """By the pairs that hold them and their Euler characteristic, but for the outer one."""
    return Counter((frozenset(cell.pairs), cell.euler) for cell in whole.cells[1:])


def test_one_convex_pair_has_the_papers_patches() -> None:
    whole = arrangement(Scene(TRIANGLE, [[(5, 5), (8, 5), (6, 7)]]))
    assert len(whole.face_patch) == 18 == len({*whole.face_patch.tolist()})
    assert whole.statistics.edges_by_kind == {"helix": 26, "crossing": 0, "segment": 26}
    # A and O: their areas, and the mixed one, the perimeters' product over 2 pi on average (kinematic formula)
    perimeters = 3 + math.sqrt(5), 3 + math.sqrt(5) + 2 * math.sqrt(2)
    volume = math.tau * (1 + 3) + perimeters[0] * perimeters[1]
    assert [cell.volume for cell in whole.cells] == pytest.approx([math.inf, volume], rel=1e-12)
    assert (whole.cell_euler == 0).all()


def test_the_same_obstacle_twice_has_one_surface_of_two_owners() -> None:
    one, two = arrangement(Scene(SQUARE, [SQUARE])), arrangement(Scene(SQUARE, [SQUARE, SQUARE]))
    assert len(one.face_patch) == len(two.face_patch)
    assert {two.sets[k] for k in two.face_owners} == {((0, 0), (0, 1))}
    assert two.cell_depth.tolist() == [0, 2]
    assert one.vertex_pose.tolist() == two.vertex_pose.tolist()


def test_two_polygons_that_share_an_edge_of_the_robot_never_overlap_an_obstacle_as_one_does_not() -> None:
    halves = [[(0, 0), (1, 0), (1, 1), (0, 1)], [(1, 0), (2, 0), (2, 1), (1, 1)]]
    parts = arrangement(Scene(halves, [SQUARE]))
    whole = arrangement(Scene([(0, 0), (2, 0), (2, 1), (0, 1)], [SQUARE]))
    assert parts.volumes[1:].sum() == pytest.approx(whole.volumes[1], rel=1e-12)


def test_an_obstacle_that_touches_another_from_within_parts_it() -> None:
    # the inner one's vertex is on the outer one's edge: along helices and segments its F touches that of the outer one
    outer, inner = [(0, 0), (4, 0), (4, 4), (0, 4)], [(2, 0), (3, 1), (2, 2), (1, 1)]
    plain = PlainScene([([(0, 0), (1, 0), (0, 1)], [])], [(outer, []), (inner, [])])
    whole = arrangement(scene_of(plain))
    assert cells_of(whole) == sliced_cells(plain, angles_of(whole))


def test_surfaces_that_touch_in_points_share_vertices_there() -> None:
    # congruent obstacles that touch: helices of both meet crosswise
    kites = [(3, 0), (1, 0), (2, -2), (3, -1)], [(2, 2), (0, 2), (1, 0), (2, 1)], [(-3, 2), (-3, 0), (-1, 1), (-2, 2)]
    plain = PlainScene([([(0, 0), (0, 2), (-2, 1), (-1, 0)], [])], [(kite, []) for kite in kites])
    whole = arrangement(scene_of(plain))
    assert cells_of(whole) == sliced_cells(plain, angles_of(whole))


def angles_of(whole: Arrangement) -> list[float]:
    table = whole.sheets.trapezoids
    return np.concatenate([table.theta_from, table.theta_to]).tolist()


def convex_scene(kind: str, number: int) -> PlainScene:
    rng = random.Random(f"{kind} {number}")

    def generic(radius: float) -> list[tuple[float, float]]:
        while True:
            points = [(rng.uniform(-radius, radius), rng.uniform(-radius, radius)) for _ in range(4)]
            hull = shapely.orient_polygons(shapely.convex_hull(shapely.MultiPoint(points)))
            if hull.area > 0.4 * radius**2:
                x, y = rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5)
                return [(round(a + x, 2), round(b + y, 2)) for a, b in hull.exterior.coords[:-1]]

    one = fuzz._convex(rng, 2)
    make: dict[str, Any] = {
        "generic": lambda: (generic(1.2), []),
        "lattice": lambda: fuzz.placed(rng, fuzz._convex(rng, 3), 2),
        "boxes": lambda: fuzz.placed(rng, fuzz._box(rng, 2), 2),
        "congruent": lambda: fuzz.placed(rng, one, 2),
    }
    robot, obstacles = rng.randint(1, 2), rng.randint(1, 3)
    return PlainScene([make[kind]() for _ in range(robot)], [make[kind]() for _ in range(obstacles)])


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["generic", "lattice", "boxes", "congruent"])
def test_cells_and_their_characteristics_are_those_of_slices(kind: str) -> None:
    compared = 0
    for number in range(6):
        plain = convex_scene(kind, number)
        whole = arrangement(scene_of(plain))
        try:
            expected = sliced_cells(plain, angles_of(whole))
        except Unclear:
            continue
        assert cells_of(whole) == expected, number
        compared += 1
    assert compared >= 3


@pytest.mark.parametrize("kind", ["lattices", "boxes", "parts", "feet", "chain", "congruent"])
def test_depths_are_those_of_shapely_at_random_poses(kind: str) -> None:
    for number in (1, 5, 9):
        plain = fuzz.scene(kind, number)._replace(bounds=None, workspace=None)
        whole, rng = arrangement(scene_of(plain)), random.Random(number)
        robot, obstacles = ([shapely.Polygon(*shape) for shape in of] for of in (plain.robot, plain.obstacles))
        x0, y0, x1, y1 = shapely.union_all(obstacles).buffer(3).bounds
        for _ in range(40):
            x, y, theta = rng.uniform(x0, x1), rng.uniform(y0, y1), rng.uniform(0, math.tau)
            placed = [translate(rotate(part, theta, (0, 0), use_radians=True), x, y) for part in robot]
            areas = [part.intersection(obstacle).area for part in placed for obstacle in obstacles]
            if not any(0 < area < 1e-9 for area in areas):
                assert whole.depth(Pose(x, y, theta)) == sum(area > 0 for area in areas)


@pytest.mark.parametrize("kind", ["lattices", "rims", "corridor", "cut", "feet"])
def test_depth_0_is_the_free_space(kind: str) -> None:
    for number in range(4):
        scene = scene_of(fuzz.scene(kind, number))
        whole, space = arrangement(scene), cfree.free_space(cfree.boundary(scene))
        free = sorted(whole.volumes[whole.cell_depth == 0])
        assert free == pytest.approx(sorted(space.volumes), rel=1e-9, abs=1e-9), number


def test_free_cells_that_touch_along_a_helix_on_the_bounds_are_two() -> None:
    # the robot's reference point is its vertex; the wedge's tip is on the upper bound, its foot on the lower one
    whole = arrangement(Scene([(0, 0), (1, -1), (0, 1)], [[(0, 2), (-1, 0), (1, 0)]], bounds=(-2, 0, 2, 2)))
    left, right = (whole.cell(Pose(x, "3/2", "135deg")) for x in (-1.5, 1.5))
    assert whole.cell_depth[[left, right]].tolist() == [0, 0] and left != right
    assert (whole.cell_depth == 0).sum() == 2


@pytest.mark.slow
def test_depth_0_is_the_free_space_where_corners_are_on_bounds() -> None:
    """Small integers, so that much touches; a vertex of each part of the robot is its reference point."""
    random_ = random.Random(7)

    def triangle(most: int) -> cfree.Polygon:
        while True:
            corners = [(random_.randint(-most, most), random_.randint(-most, most)) for _ in range(3)]
            with contextlib.suppress(cfree.InvalidPolygonError):
                return cfree.Polygon(corners)

    several = 0
    for _ in range(12):
        robot = [triangle(2) for _ in range(random_.choice([1, 2]))]
        robot = [
            cfree.Polygon([(x - part.vertices[0][0], y - part.vertices[0][1]) for x, y in part.vertices])
            for part in robot
        ]
        scene = Scene(robot, [triangle(3) for _ in range(random_.randint(1, 3))], bounds=(-2, -2, 2, 2))
        whole, space = arrangement(scene), cfree.free_space(cfree.boundary(scene))
        free = sorted(whole.volumes[whole.cell_depth == 0])
        assert free == pytest.approx(sorted(space.volumes), rel=1e-9, abs=1e-9)
        several += len(free) > 1
    assert several > 3


def test_beyond_everything_is_what_bounds_and_workspace_forbid() -> None:
    room = [(0, 0), (9, 0), (9, 9), (0, 9)]
    whole = arrangement(Scene([TRIANGLE, SQUARE], [[(4, 4), (5, 4), (5, 5)]], workspace=room, bounds=(1, 1, 8, 8)))
    assert whole.cells[0].pairs == ((0, -2), (1, -2), (2, -1))
    assert whole.depth(Pose(100, 0)) == 3 and whole.depth(Pose(2, 2)) == 0
    assert arrangement(Scene(TRIANGLE)).cells[0].pairs == ()


def test_on_a_surface_its_own_pair_does_not_count() -> None:
    whole = arrangement(Scene(SQUARE, [SQUARE, [("1/2", 0), (3, 0), (3, 1), ("1/2", 1)]]))
    assert whole.cell(Pose(-1, 0)) == -1
    assert whole.depth(Pose(-1, 0)) == 0 and whole.depth(Pose(1, 0)) == 1 and whole.depth(Pose("1/2", 0)) == 2


@pytest.fixture(scope="module")
def three() -> Arrangement:
    return arrangement(Scene(TRIANGLE, [[(5, 5), (8, 5), (6, 7)], [(6, 6), (9, 6), (7, 8)], [(3, 5), (7, 7), (4, 9)]]))


def test_what_is_counted_agrees(three: Arrangement) -> None:
    counts, edges = three.statistics, three.edge_vertices[three.edge_vertices[:, 0] >= 0]
    assert counts.vertices == sum(counts.vertices_by_kind.values()) == sum(counts.vertices_by_degree.values())
    assert np.bincount(edges.ravel(), minlength=counts.vertices).tolist() == three.vertex_degree.tolist()
    assert counts.cells == sum(counts.cells_by_depth.values()) and counts.max_depth == 3
    assert three.vertex_degree[three.vertex_kind == 0].tolist() == [6] * counts.vertices_by_kind["triple contact"]
    assert counts.vertices < counts.bounds["surfaces"]
    # crossing a face changes the depth by one where no surfaces coincide
    assert np.diff(three.cell_depth[three.face_cells], axis=1).tolist() == [[1]] * counts.faces
    assert three.face_depth.tolist() == three.cell_depth[three.face_cells[:, 0]].tolist()


def test_triple_contacts_lie_on_three_surfaces(three: Arrangement) -> None:
    features, sheets = three.features, three.sheets
    around: dict[int, set[int]] = {}
    for k, ends in enumerate(three.edge_vertices.tolist()):
        for v in ends:
            patches = three.face_patch[three.edge_face[three.edge_start[k] : three.edge_start[k + 1]]]
            around.setdefault(v, set()).update(patches.tolist())
    for v in np.flatnonzero(three.vertex_kind == 0).tolist():
        x, y, theta = three.vertex_pose[v]
        assert len(around[v]) == 3
        for k in around[v]:
            p, q, a, g = sheets.ruled[k].reshape(4, 2) @ (1, 1j)
            turn = complex(math.cos(theta), math.sin(theta))
            along, start = q - turn * g, p - turn * a
            away = complex(x, y) - start
            assert abs((along.conjugate() * away).imag) < 1e-9 * abs(along)
    assert features.scale == 1


def test_the_result_depends_on_no_threads_and_is_pickled(three: Arrangement) -> None:
    assert arrangement(three.scene, threads=1) == arrangement(three.scene, threads=2) == three
    assert pickle.loads(pickle.dumps(three)) == three


def test_what_is_too_much_is_refused(three: Arrangement) -> None:
    with pytest.raises(UnsupportedError, match="more than 0 pieces of contact surfaces"):
        arrangement(three.scene, max_memory=0)
    with pytest.raises(ValueError, match="max_memory: -1"):
        arrangement(three.scene, max_memory=-1)
    with pytest.raises(ValueError, match="threads: 0"):
        arrangement(three.scene, threads=0)


def test_regions_of_a_slice_cover_what_the_pairs_hold(three: Arrangement) -> None:
    theta, robot = 0.7, shapely.Polygon(TRIANGLE)
    area = sum(region.area * int(three.cell_depth[cell]) for region, cell in planar_cells(three, theta))
    sums = 0.0
    for obstacle in three.scene.obstacles:
        turned = rotate(robot, theta, (0, 0), use_radians=True)
        points = [(x - a, y - b) for x, y in obstacle.vertices for a, b in turned.exterior.coords]
        sums += shapely.convex_hull(shapely.MultiPoint(points)).area
    assert area == pytest.approx(sums, rel=1e-9)


def test_what_is_written_is_what_there_is(three: Arrangement, tmp_path: Path) -> None:
    save_arrangement(three, tmp_path / "three.json")
    written = json.loads((tmp_path / "three.json").read_text())
    assert written == json.loads(json.dumps(arrangement_json(three)))
    assert [cell["depth"] for cell in written["cells"]] == three.cell_depth.tolist()
    assert written["cells"][0]["volume"] is None and written["statistics"]["edges"] == len(written["edges"])
    for face in written["faces"]:
        outer, inner = ({*map(tuple, written["cells"][cell]["pairs"])} for cell in face["cells"])
        assert inner - outer == {*map(tuple, face["owners"])} and face["depth"] == len(outer)
    with pytest.raises(UnsupportedError, match=r"\.json"):
        save_arrangement(three, tmp_path / "three.txt")


def test_regions_are_drawn_in_the_colours_of_their_depths(three: Arrangement) -> None:
    ax = plot_depths(three, 0.7)
    colours = depth_colours(three)
    expected = [tuple(colours[three.cell_depth[cell]]) for _, cell in planar_cells(three, 0.7)]
    assert [to_rgb(patch.get_facecolor()) for patch in ax.patches] == expected
    (lines,) = ax.collections
    assert len(lines.get_segments()) == len(three.slice(0.7).segments)
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["0", "1", "2", "3"]


def test_faces_are_drawn_by_depth(three: Arrangement) -> None:
    everything, deep = plot_faces(three), plot_faces(three, depth=2)
    assert [text.get_text() for text in everything.get_legend().get_texts()] == ["depth 0", "depth 1", "depth 2"]
    assert [text.get_text() for text in deep.get_legend().get_texts()] == ["depth 2"]
    few, many = (len(ax.collections[0]._pieces.corners) for ax in (deep, everything))
    assert 0 < few < many
