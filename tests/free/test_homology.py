"""Homology of cells: known spaces, slices as another way to it, and loops that generate it."""

from __future__ import annotations

import math
import random
from collections import Counter
from typing import Any

import numpy as np
import pytest
import shapely

import cfree
from cfree.free import Homology, Loop, surface_loops
from compared import scene_of
from shapes import PlainScene
from sliced_homology import Unclear, rank, sliced_homology

ROOM = [(0, 0), (20, 0), (20, 20), (0, 20)]
DISC = cfree.Curved.circle((0, 0), 1)
ROD = [(-4, "-0.25"), (4, "-0.25"), (4, "0.25"), (-4, "0.25")]


def box(x: Any, y: Any, w: Any = 1, h: Any = 1) -> list[tuple[Any, Any]]:
    return [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]


def homologies(scene: cfree.Scene) -> list[Homology]:
    return [cell.homology for cell in cfree.free_space(cfree.boundary(scene)).cells]


@pytest.mark.parametrize("pillars", [0, 1, 2, 4])
def test_a_disc_among_pillars_has_a_loop_around_each_and_one_turn(pillars: int) -> None:
    """The cell is the floor of the disc's center times a circle."""
    places = [(4, 4), (15, 4), (4, 15), (15, 15)][:pillars]
    obstacles = [box(x, y) for x, y in places]
    assert homologies(cfree.Scene(DISC, obstacles, workspace=ROOM)) == [Homology(1, pillars + 1, pillars)]
    assert homologies(cfree.Scene(DISC, obstacles)) == [Homology(1, pillars + 1, pillars)]  # without walls around


def test_a_robot_alone_has_a_solid_torus() -> None:
    (cell,) = cfree.free_space(cfree.boundary(cfree.Scene(ROD))).cells
    assert cell.homology == Homology(1, 1, 0) and cell.homology.euler == 0 and not cell.bounded
    assert surface_loops(cell) == ()


def test_a_rod_that_cannot_turn_has_balls_and_one_that_can_a_solid_torus() -> None:
    corridor = [(0, 0), (30, 0), (30, 5), (0, 5)]
    assert homologies(cfree.Scene(ROD, workspace=corridor)) == [Homology(1, 0, 0)] * 2
    assert homologies(cfree.Scene(ROD, workspace=ROOM)) == [Homology(1, 1, 0)]


def test_a_rod_goes_round_a_pillar_that_keeps_it_from_turning() -> None:
    """In a ring 5 wide a rod 8 long goes round, and turns by that alone: a loop that turns once."""
    ring = cfree.Polygon(box(-30, -30, 60, 60), [box(-25, -25, 50, 50)[::-1]])
    cells = cfree.free_space(cfree.boundary(cfree.Scene(ROD, workspace=ring))).cells
    assert [(cell.homology, cell.turns) for cell in cells] == [(Homology(1, 1, 0), 1)] * 2  # either end ahead
    narrow = cfree.Polygon(box(-28, -28, 56, 56), [box(-25, -25, 50, 50)[::-1]])  # corners stop the rod
    assert homologies(cfree.Scene(ROD, workspace=narrow)) == [Homology(1, 0, 0)] * 8


def test_a_pillar_that_a_rod_passes_on_both_sides_without_turning_is_a_ring() -> None:
    corridor, pillar = [(0, 0), (60, 0), (60, 5), (0, 5)], box(30, 2)
    for number in homologies(cfree.Scene(ROD, [pillar], workspace=corridor)):
        assert number == Homology(1, 1, 0)


def test_a_hollow_around_a_small_obstacle_in_a_cell_is_a_shell() -> None:
    """The rod is too long to turn beside an obstacle that it forbids at some orientations only: no shell."""
    for length, number in ((1, Homology(1, 2, 1)), (40, None)):
        rod = [(-length, "-0.25"), (length, "-0.25"), (length, "0.25"), (-length, "0.25")]
        cells = homologies(cfree.Scene(rod, [box(10, 10)], workspace=ROOM))
        assert cells == ([number] if number else [])


def test_the_euler_number_is_half_of_that_of_the_surfaces() -> None:
    scene = cfree.load_scene("examples/scenes/flat.json")
    space = cfree.free_space(cfree.boundary(scene))
    for cell in space.cells:
        assert 2 * cell.homology.euler == space.complex.euler[list(cell.components)].sum()
        assert (cell.homology.b0, cell.homology.b2) == (1, len(cell.components) - 1)
    assert max(cell.homology.b1 for cell in space.cells) == 23


def random_scene(seed: int) -> PlainScene:
    """A crooked rod among convex obstacles in a crooked room; decimals of two digits."""
    rng = random.Random(seed)

    def convex(x: float, y: float, radius: float, count: int) -> list[tuple[float, float]]:
        while True:
            turns = [rng.uniform(0, math.tau) for _ in range(count)]
            points = [(round(x + radius * math.cos(t), 2), round(y + radius * math.sin(t), 2)) for t in turns]
            hull = shapely.orient_polygons(shapely.convex_hull(shapely.MultiPoint(points)))
            if hull.area > 0.05:
                return list(hull.exterior.coords[:-1])

    half = rng.uniform(1.5, 5) / 2
    corners = (-half, -0.3), (half, -0.3), (half, 0.4), (-half, 0.2)
    robot = [(round(x + rng.uniform(-0.1, 0.1), 2), round(y + rng.uniform(-0.1, 0.1), 2)) for x, y in corners]
    places = [(rng.uniform(2, 10), rng.uniform(2, 10), rng.uniform(0.5, 2), rng.randrange(3, 6)) for _ in range(3)]
    obstacles = [(convex(*place), []) for place in places[: rng.randrange(1, 4)]]
    room = [(0.03, 0.11), (12.07, -0.09), (11.93, 11.87), (-0.13, 12.17)]
    return PlainScene([(robot, [])], obstacles, None, (room, []))


@pytest.mark.slow
@pytest.mark.long
def test_homology_is_that_of_slices_glued_by_mayer_and_vietoris() -> None:
    compared = Counter[tuple[int, int, int]]()
    for seed in range(12):
        plain = random_scene(seed)
        boundary = cfree.boundary(scene_of(plain))
        table = boundary.trapezoids
        try:
            expected = sliced_homology(plain, [*table.theta_from.tolist(), *table.theta_to.tolist()])
        except Unclear:
            continue
        numbers = [cell.homology for cell in cfree.free_space(boundary).cells]
        assert Counter((h.b0, h.b1, h.b2) for h in numbers) == expected, seed
        compared += expected
    assert len(compared) >= 4 and any(b2 for _, _, b2 in compared) and any(b1 > 2 for _, b1, _ in compared)


@pytest.mark.parametrize("obstacles", [[], [box(4, 4)], [box(4, 4), box(14, 12, 2, 3)]])
def test_loops_generate_the_homology_of_the_surfaces(obstacles: list[Any]) -> None:
    scene = cfree.Scene([(0, 0), (3, 0), (0, 1)], obstacles, workspace=ROOM)
    space = cfree.free_space(cfree.boundary(scene))
    for cell in space.cells:
        loops = surface_loops(cell)
        assert len(loops) == 2 * cell.homology.b1
        assert math.gcd(*(loop.turns for loop in loops)) == cell.turns
        edge = np.minimum(np.arange(len(space.complex.twin)), space.complex.twin)
        for loop in loops:
            check_closed(space, loop)
        columns: list[set[object]] = []
        for face in space.faces(cell.index).tolist():
            columns.append(mod_2(edge[list(space.complex.loop(face))].tolist()))
        boundaries = rank([set(column) for column in columns])
        assert boundaries == len(columns) - len(cell.components)
        assert rank(columns + [mod_2(edge[loop.coedges].tolist()) for loop in loops]) == boundaries + len(loops)


def mod_2(edges: list[int]) -> set[object]:
    return {edge for edge, times in Counter[object](edges).items() if times % 2}


def check_closed(space: Any, loop: Loop) -> None:
    complex = space.complex
    for h, following in zip(loop.coedges.tolist(), np.roll(loop.coedges, -1).tolist(), strict=True):
        around = complex.loop(int(complex.face[h]))
        after = h + 1 if h + 1 < around.stop else around.start
        assert complex.vertex[after] == complex.vertex[following]
    first, last = loop.points[0], loop.points[-1]
    assert (first[:2] == last[:2]).all() and last[2] - first[2] == pytest.approx(math.tau * loop.turns, abs=1e-9)


def test_a_loop_that_turns_is_in_every_cell_in_which_the_robot_turns_round() -> None:
    space = cfree.free_space(cfree.boundary(cfree.load_scene("examples/scenes/flat.json")))
    turning = [cell for cell in space.cells if cell.full_turn]
    assert turning
    for cell in turning:
        assert math.gcd(*(loop.turns for loop in surface_loops(cell))) == 1
