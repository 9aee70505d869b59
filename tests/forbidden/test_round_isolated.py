"""Isolated parts among rounded shapes: kinds and places by hand, and exact tests of poses at them and beside them."""

from __future__ import annotations

import math
import pickle
from collections.abc import Callable
from fractions import Fraction as F
from pathlib import Path

import numpy as np
import pytest

import cfree
from cfree import Curved, Scene, boundary
from cfree.collision.arcs import arcs_of
from cfree.curves import Arc
from cfree.forbidden.isolated import isolated_at, isolated_lines
from cfree.free.space import NO_CELL
from round_fits import FAMILIES, Oracle, Shape, box, compared, grown, points

Made = Callable[[], Scene]
HOLE = [(5, 0), (-3, 4), (-3, -4)]  # on a circle of radius 5 around the origin, on all sides of it
HAIRS = F(1, 2**20), F(1, 2**60)


def disc(x: object, y: object, radius: object) -> Shape:
    return grown(points((x, y)), radius)


def slot_of(peg: Shape, half: object, more: object = 0, turn: tuple[F, F] = (F(1), F(0))) -> Scene:
    """A peg in a slot around the x-axis, turned."""
    c, s = turn
    high = F(half) + F(more)  # type: ignore[arg-type]
    walls = [box(-5, high, 5, high + 1), box(-5, -F(half) - 1, 5, -F(half))]  # type: ignore[arg-type]
    return Scene(peg, [cfree.Polygon([(c * x - s * y, s * x + c * y) for x, y in wall]) for wall in walls])


def stadium_in_slot(more: object = 0, turn: tuple[F, F] = (F(1), F(0))) -> Scene:
    return slot_of(grown(points((0, 0), (2, 0)), 1), 1, more, turn)


def square_in_room(radius: object = F(1, 2)) -> Scene:
    return Scene(grown(box(-1, -1, 1, 1), radius), [], workspace=box(F(-3, 2), F(-3, 2), F(3, 2), F(3, 2)))


def discs_in_holes(*places: tuple[int, int], more: object = 0) -> Scene:
    """Discs of the robot, each in a hole between three discs."""
    holes = [disc(x + a, y + b, 3 - F(more)) for x, y in places for a, b in HOLE]  # type: ignore[arg-type]
    return Scene([disc(x, y, 2) for x, y in places], holes)


def found_in(scene: Scene) -> list[tuple[str, list[tuple[float, float, float]]]]:
    result = boundary(scene, threads=1)
    assert not Oracle(scene).faults(result)
    parts = [result.isolated_part(k) for k in range(len(result.isolated))]
    return [(part.kind, sorted((x, y, math.degrees(t)) for x, y, t in part.ends)) for part in parts]


def segments(found: list[tuple[str, list[tuple[float, float, float]]]]) -> np.ndarray:
    assert {kind for kind, _ in found} <= {"segment"}
    return np.array(sorted(ends for _, ends in found))


def test_a_stadium_in_a_slot_of_its_width_has_two_segments() -> None:
    found = segments(found_in(stadium_in_slot()))
    assert found == pytest.approx(np.array([[(-7, 0, 0), (5, 0, 0)], [(-5, 0, 180), (7, 0, 180)]]))


def test_a_slanted_slot_has_the_same_segments_turned() -> None:
    found = segments(found_in(stadium_in_slot(turn=(F(4, 5), F(3, 5)))))
    theta = math.degrees(math.atan2(3, 4))
    along = np.array([0.8, 0.6])
    ends = {(round(t - theta), round(float(np.dot(along, (x, y))), 9)) for part in found for x, y, t in part}
    assert ends == {(0, -7), (0, 5), (180, -5), (180, 7)}


def test_a_rounded_square_in_a_slot_has_a_segment_each_quarter_turn() -> None:
    found = segments(found_in(slot_of(grown(box(-1, -1, 1, 1), F(1, 2)), F(3, 2))))
    expected = [[(-6, 0, t), (6, 0, t)] for t in (-90, 0, 90, 180)]
    assert found == pytest.approx(np.array(expected), abs=1e-9)


@pytest.mark.parametrize("made", [square_in_room, lambda: Scene(box(-1, -1, 1, 1), rounded_frame())])
def test_a_square_in_a_square_has_four_points(made: Made) -> None:
    found = found_in(made())
    assert [kind for kind, _ in found] == ["point"] * 4
    assert sorted(round(t) for _, ((_, _, t), _) in found) == [-90, 0, 90, 180]
    assert np.array([end[:2] for _, ends in found for end in ends]) == pytest.approx(0, abs=1e-9)


def rounded_frame() -> list[Shape]:
    walls = [box(-3, 2, 3, 3), box(-3, -3, 3, -2), box(2, -3, 3, 3), box(-3, -3, -2, 3)]
    return [grown(wall, 1) for wall in walls]


def turns_of(found: list[tuple[str, list[tuple[float, float, float]]]]) -> float:
    assert {kind for kind, _ in found} == {"curve"}
    return sum(abs(a[2] - b[2]) for _, (a, b) in found)


@pytest.mark.parametrize("reference", [(0, 0), (1, 2), (30, -7)])
def test_a_disc_among_three_has_a_curve_for_all_angles(reference: tuple[int, int]) -> None:
    scene = Scene(disc(*reference, 2), [disc(x, y, 3) for x, y in HOLE])
    found = found_in(scene)
    assert turns_of(found) == pytest.approx(360)
    for _, ends in found:
        for x, y, degrees in ends:
            turn = complex(*reference) * complex(math.cos(math.radians(degrees)), math.sin(math.radians(degrees)))
            assert abs(complex(x, y) + turn) < 1e-9


def test_three_discs_of_the_robot_around_a_disc_have_a_curve_for_all_angles() -> None:
    found = found_in(Scene([disc(x, y, 3) for x, y in HOLE], [disc(0, 0, 2)]))
    assert turns_of(found) == pytest.approx(360)
    assert np.array([end[:2] for _, ends in found for end in ends]) == pytest.approx(0, abs=1e-9)


def test_a_disc_between_two_discs_and_a_wall_has_a_curve_for_all_angles() -> None:
    others = [disc(F(8, 5), F(6, 5), 1), disc(F(-8, 5), F(6, 5), 1), cfree.Polygon(box(-5, -2, 5, -1))]
    assert turns_of(found_in(Scene(disc(0, 0, 1), others))) == pytest.approx(360)


@pytest.mark.slow
def test_two_discs_in_two_holes_have_a_point_where_circles_coincide() -> None:
    """All surfaces through it come in pairs that are one circle at this angle."""
    scene = discs_in_holes((0, 0), (30, 0))
    found = [ends[0] for kind, ends in found_in(scene) if kind == "point"]
    assert [tuple(round(v, 9) + 0 for v in end) for end in found if abs(end[0]) < 1] == [(0, 0, 0)]


def test_free_space_pinched_between_two_discs_is_no_exact_fit() -> None:
    assert not found_in(Scene(disc(0, 0, 1), [disc(2, 0, 1), disc(-2, 0, 1)]))


def test_a_disc_in_a_corridor_is_on_trapezoids_of_both_walls() -> None:
    scene = slot_of(disc(0, 0, 1), 1)
    assert not found_in(scene) and len(boundary(scene).trapezoids)


ROOMY: dict[str, Callable[[F], Scene]] = {
    "slot": lambda more: stadium_in_slot(more),
    "slanted slot": lambda more: stadium_in_slot(more, (F(4, 5), F(3, 5))),
    "square": lambda more: square_in_room(F(1, 2) - more),
    "hole": lambda more: discs_in_holes((0, 0), more=more),
}


@pytest.mark.parametrize("hair", HAIRS)
@pytest.mark.parametrize("name", ROOMY)
def test_a_hair_more_or_less_room_leaves_no_exact_fit(name: str, hair: F) -> None:
    assert not len(boundary(ROOMY[name](hair)).isolated)
    assert not len(boundary(ROOMY[name](-hair)).isolated)


def test_scenes_without_exact_fits_have_none() -> None:
    triangle = Curved([(0, 0), (1, 0), (0, 1)], grown="1/5")
    assert not found_in(Scene(triangle, [disc(0, 0, 1), disc(4, 0, 1), disc(0, 4, 1)]))


def test_parallel_edges_of_the_robot_leave_no_forbidden_point() -> None:
    """At the angle at which both lines are one, a curve of one on the other has a place by continuity."""
    robot = Curved([(1, 1), (3, 1), (3, 2), (2, 2), (2, 3), (1, 3)], grown=1)
    form = [(-4, -1), (F(-14, 5), F(3, 5)), (F(-18, 5), F(6, 5)), (F(-21, 5), F(2, 5)), (-5, 1), (F(-28, 5), F(1, 5))]
    room = box(F(-43, 5), -4, F(1, 5), F(21, 5))
    assert not found_in(Scene(robot, [Curved(form, grown="1/4")], workspace=room))


def test_lines_are_one_where_an_edge_ends_at_an_arc() -> None:
    """The end of an arc is no vertex of a ring, and has no edge before it."""
    robot = Curved([(-1, -1), (1, -1), Arc((1, 1), center=(1, 0)), (-1, 1)])
    walls = [box(F(39, 4), 10, F(41, 4), 18), box(4, F(79, 4), 10, F(81, 4)), box(10, F(79, 4), 12, F(81, 4))]
    assert not found_in(Scene(robot, [*walls, box(F(39, 4), 20, F(41, 4), 21)]))


SEEDS = [
    pytest.param(family, seed, marks=[pytest.mark.slow, pytest.mark.long] if seed == 2 else pytest.mark.slow)
    for family in FAMILIES
    for seed in range(3)
]


@pytest.mark.parametrize(("family", "seed"), SEEDS)
def test_parts_are_free_and_without_room_and_none_is_missing(family: str, seed: int) -> None:
    _, faults, _ = compared(family, seed)
    assert not faults


def test_exact_fits_go_through_files_and_pickles(tmp_path: Path) -> None:
    scene = stadium_in_slot()
    result = boundary(scene)
    cfree.save(result, tmp_path / "slot.npz")
    again = cfree.load(tmp_path / "slot.npz")
    assert again == result == pickle.loads(pickle.dumps(result))
    assert len(again.isolated) == 2 and "2 isolated parts" in repr(again)


def test_threads_do_not_change_them() -> None:
    scene = discs_in_holes((0, 0))
    one, two = (boundary(scene, threads=count).isolated for count in (1, 2))
    assert one == two


def test_a_regularized_boundary_has_none() -> None:
    assert not len(boundary(stadium_in_slot()).regularized.isolated)


def test_an_exact_fit_is_in_no_cell() -> None:
    space = cfree.free_space(boundary(stadium_in_slot()))
    assert space.locate(cfree.Pose(0, 0)) == NO_CELL


def test_pictures_have_their_lines() -> None:
    result = boundary(stadium_in_slot())
    assert sorted(float(np.ptp(line[:, 0])) for line in isolated_lines(result)) == pytest.approx([12, 12])
    assert len(isolated_at(result, 0.0)) == 1 and not isolated_at(result, 1.0)
    curve = boundary(discs_in_holes((0, 0)))
    for line in isolated_lines(curve):
        assert line[:, :2] == pytest.approx(0, abs=1e-9)


def test_many_poses_are_decided_as_one_by_one_where_the_reference_point_is_outside_of_the_robot() -> None:
    """From 16,384 poses on, boxes of poses are decided together."""
    scene = Scene(grown(box(1, 0, 3, 1), F(1, 2)), [grown(box(-1, -1, 1, 1), F(1, 2))])
    arcs = arcs_of(scene)
    assert arcs is not None
    r = np.random.default_rng(1)
    table = np.column_stack([r.uniform(-4, 4, (20_000, 2)), r.uniform(0, math.tau, 20_000)])
    many = arcs.are_free(table, 1)
    few = [bool(arcs_of(scene).poses.is_free(row.tolist())) for row in table[:300]]  # type: ignore[union-attr]
    assert many[:300].tolist() == few
