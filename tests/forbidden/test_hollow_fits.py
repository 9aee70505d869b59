"""Exact fits in concave arcs: kinds and places by hand, hairs of room, frames, plans, verification, random scenes."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction as F
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cfree
import cfree.verify
from cfree import Curved, Pose, Scene, boundary
from cfree.curves import Arc, Circle
from cfree.forbidden.isolated import isolated_at, isolated_lines
from cfree.free.space import NO_CELL
from hollow_fits import FAMILIES, HollowOracle, compared, filleted, slot_ring
from round_fits import box, grown, points

PLATE = box(-9, -9, 9, 9)
HAIR = F(1, 2**60)
Turn = tuple[F, F]
TURNS: list[Turn] = [(F(1), F(0)), (F(4, 5), F(3, 5)), (F(-5, 13), F(12, 13)), (F(0), F(-1))]
Part = tuple[str, list[tuple[float, float, float]]]


def plate(*holes: Any, turn: Turn = (F(1), F(0)), by: object = 0, factor: object = 1) -> Curved:
    """A plate with holes, turned, scaled and moved along the x-axis."""
    (c, s), f = turn, F(factor)  # type: ignore[arg-type]

    def place(p: Any) -> Any:
        x, y = F(p[0]), F(p[1])
        return f * (c * x - s * y) + F(by), f * (s * x + c * y)  # type: ignore[arg-type]

    def ring(items: Any) -> Any:
        if isinstance(items, Circle):
            return Circle(place(items.center), f * F(items.radius))  # type: ignore[arg-type]
        return [Arc(place(p.to), center=place(p.center)) if isinstance(p, Arc) else place(p) for p in items]

    return Curved(ring(PLATE), [*map(ring, holes)])


def round_hole(radius: object, at: tuple[object, object] = (0, 0)) -> Circle:
    return Circle((F(at[0]), F(at[1])), F(radius))  # type: ignore[arg-type]


def disc(radius: object, at: tuple[object, object] = (0, 0)) -> Any:
    return grown(points(at), radius)


def peg(half: object = 2, radius: object = 1) -> Any:
    h = F(half)  # type: ignore[arg-type]
    return grown(points((-h, 0), (h, 0)), radius)


def square(radius: object = F(1, 2), half: object = 1) -> Any:
    h = F(half)  # type: ignore[arg-type]
    return grown(box(-h, -h, h, h), radius)


def found_in(scene: Scene) -> list[Part]:
    """The isolated parts, after the exact poses on them and beside them have been tested, and the boundary verified."""
    result = boundary(scene, threads=1)
    oracle = HollowOracle(scene)
    missing, roomy, _ = oracle.missing_on_helices(result, 0)
    assert not oracle.faults(result) and not missing and not roomy
    parts = [result.isolated_part(k) for k in range(len(result.isolated))]
    return [(part.kind, sorted((x, y, math.degrees(t)) for x, y, t in part.ends)) for part in parts]


def kinds(found: list[Part]) -> list[str]:
    return sorted(kind for kind, _ in found)


def places(found: list[Part]) -> list[tuple[float, float, float]]:
    """Places of points, the angles from 0 to 360 degrees."""
    return sorted((round(x, 9) + 0, round(y, 9) + 0, round(t % 360, 7)) for _, ((x, y, t), *_) in found)


def turning(found: list[Part]) -> float:
    assert {kind for kind, _ in found} == {"curve"}
    return sum(abs(ends[0][2] - ends[-1][2]) if len(ends) > 1 else 0 for _, ends in found)


# --- a disc in its hole ---


@pytest.mark.parametrize("reference", [(0, 0), (1, 2), (30, -7)])
def test_a_disc_in_a_hole_of_its_radius_has_a_curve_for_all_angles(reference: tuple[int, int]) -> None:
    found = found_in(Scene(disc(1, reference), [plate(round_hole(1))]))
    assert turning(found) == pytest.approx(360)
    for _, ends in found:
        for x, y, degrees in ends:
            turn = complex(*reference) * complex(math.cos(math.radians(degrees)), math.sin(math.radians(degrees)))
            assert abs(complex(x, y) + turn) < 1e-9


def test_a_robot_with_a_round_hole_around_a_pin_of_its_radius_has_a_curve_for_all_angles() -> None:
    robot = Curved(box(-3, -2, 4, 2), [round_hole(F(3, 2))])
    assert turning(found_in(Scene(robot, [disc(F(3, 2), (5, 1))]))) == pytest.approx(360)


def test_a_wall_beside_the_hole_leaves_the_curve_of_an_arm_a_part() -> None:
    """A disc with an arm turns in its hole until the arm meets a wall; both lie in one plane."""
    hole = Curved(PLATE, [round_hole(1), box(3, -8, 8, 8)])
    robot = [disc(1), disc(F(1, 2), (5, 0))]
    found = found_in(Scene(robot, [hole]))
    assert kinds(found) == ["curve"]
    assert 0 < turning(found) < 180


def test_bounds_leave_the_curve_of_a_disc_a_part() -> None:
    """The reference point is 2 beside the disc's center, and keeps to the right."""
    scene = Scene(disc(1, (2, 0)), [plate(round_hole(1))], bounds=(0, -9, 9, 9))
    found = found_in(scene)
    assert turning(found) == pytest.approx(180)
    assert min(x for _, ends in found for x, *_ in ends) == pytest.approx(0, abs=1e-9)


def test_a_disc_in_a_larger_hole_has_no_exact_fit() -> None:
    assert not found_in(Scene(disc(1), [plate(round_hole(F(3, 2)))]))


@pytest.mark.parametrize(
    "pins",
    [
        [disc(1, (F(4, 5), F(8, 5))), disc(1, (F(4, 5), F(-8, 5)))],
        [disc(F(1, 2), (F(11, 10), F(6, 5))), disc(1, (F(4, 5), F(-8, 5)))],
    ],
)
def test_pins_in_a_larger_hole_leave_a_disc_one_place_for_all_angles(pins: list[Any]) -> None:
    found = found_in(Scene(disc(1), [plate(round_hole(3)), *pins]))
    assert turning(found) == pytest.approx(360)
    assert np.array([end[:2] for _, ends in found for end in ends]) == pytest.approx(np.tile([2, 0], (4, 1)))


@pytest.mark.parametrize("turn", [(F(1), F(0)), (F(0), F(1)), (F(4, 5), F(3, 5))])
def test_a_place_between_quadrants_of_a_concave_arc_is_not_taken_for_one_of_a_trapezoid_there(turn: Turn) -> None:
    """Places on its quadrants were compared in the order of a convex arc."""
    (c, s), pins = turn, [(-2, F(7, 2)), (F(7, 10), F(-2, 5))]
    turned = [disc(F(1, 2), (c * F(x) - s * F(y), s * F(x) + c * F(y))) for x, y in pins]
    found = found_in(Scene(disc(2), [plate(round_hole(4)), *turned]))
    assert turning(found) == pytest.approx(360)
    assert np.array([end[:2] for _, ends in found for end in ends]) == pytest.approx(np.tile([-2 * s, 2 * c], (4, 1)))  # type: ignore[list-item]


def test_a_pin_that_leaves_a_disc_one_place_between_itself_and_the_hole() -> None:
    """Both circles are about places left of the disc, that of the pin around that of the hole."""
    pin = disc(F(5, 2), (F(-3, 2), 0))
    found = found_in(Scene(disc(1), [plate(round_hole(3)), pin]))
    assert turning(found) == pytest.approx(360)
    assert np.array([end[:2] for _, ends in found for end in ends]) == pytest.approx(np.tile([2, 0], (4, 1)))


@pytest.mark.slow
def test_bars_and_triangles_inscribed_in_a_round_hole_turn_in_it() -> None:
    hole = plate(round_hole(5))
    bar, triangle = grown(points((-4, 0), (4, 0)), 1), cfree.Polygon(points((5, 0), (-3, 4), (-3, -4)))
    diamond = cfree.Polygon(points((5, 0), (0, 1), (-5, 0), (0, -1)))
    for robot in (bar, triangle, diamond):
        found = found_in(Scene(robot, [hole]))
        assert turning(found) == pytest.approx(360)
        assert np.array([end[:2] for _, ends in found for end in ends]) == pytest.approx(0, abs=1e-9)


def test_a_triangle_on_less_than_half_of_a_hole_has_room() -> None:
    assert not found_in(Scene(cfree.Polygon(points((5, 0), (3, 4), (-3, 4))), [plate(round_hole(5))]))


# --- held at one orientation ---


def two_discs_in_holes(apart: object, turn: Turn = (F(1), F(0))) -> Scene:
    """Discs 6 apart in holes with half a unit of room, whose centers are as far apart as given."""
    far, (c, s) = F(apart), turn  # type: ignore[arg-type]
    holes = [round_hole(F(3, 2)), round_hole(F(3, 2), (c * far, s * far))]
    return Scene([disc(1), disc(1, (6, 0))], [Curved(box(-20, -20, 20, 20), holes)])


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("apart", [5, 7])
def test_two_holes_too_near_or_too_far_but_for_one_orientation_have_two_points(apart: int, turn: Turn) -> None:
    found = found_in(two_discs_in_holes(apart, turn))
    theta = math.degrees(math.atan2(turn[1], turn[0]))
    assert kinds(found) == ["point", "point"]
    assert sorted(t for *_, t in places(found)) == pytest.approx(sorted([theta % 360, (theta + 180) % 360]))


@pytest.mark.parametrize("apart", [7 + HAIR, 5 - HAIR, 7 - HAIR, F(13, 2)])
def test_a_hair_more_or_less_between_two_holes_leaves_no_exact_fit(apart: F) -> None:
    assert not found_in(two_discs_in_holes(apart))


def test_holes_that_leave_a_point_between_room_before_and_after_have_no_exact_fit() -> None:
    """Discs half a unit apart in holes half a unit apart, which are opposite there."""
    holes = [round_hole(F(3, 2)), round_hole(F(3, 2), (F(1, 2), 0))]
    parts = [Curved(PLATE, [holes[0]]), Curved(PLATE, [holes[1]])]
    assert not found_in(Scene([disc(1), disc(1, (F(1, 2), 0))], parts))


# --- pegs in slots ---


@pytest.mark.parametrize("turn", TURNS)
def test_a_peg_in_a_slot_of_its_shape_has_two_points_half_a_turn_apart(turn: Turn) -> None:
    found = found_in(Scene(peg(), [plate(slot_ring(2, 1), turn=turn)]))
    theta = math.degrees(math.atan2(turn[1], turn[0]))
    assert kinds(found) == ["point", "point"]
    assert sorted(t for *_, t in places(found)) == pytest.approx(sorted([theta % 360, (theta + 180) % 360]))
    assert all(abs(x) < 1e-9 and abs(y) < 1e-9 for x, y, _ in places(found))


@pytest.mark.parametrize("turn", TURNS[:2])
def test_a_shorter_peg_has_two_segments(turn: Turn) -> None:
    found = found_in(Scene(peg(1), [plate(slot_ring(2, 1), turn=turn)]))
    assert kinds(found) == ["segment", "segment"]
    for _, (first, last) in found:
        assert math.dist(first[:2], last[:2]) == pytest.approx(2)


def test_a_longer_peg_has_no_exact_fit() -> None:
    assert not found_in(Scene(peg(F(9, 4)), [plate(slot_ring(2, 1))]))


def test_a_slot_in_the_robot_around_a_peg_of_its_shape_has_two_points() -> None:
    robot = Curved(box(-5, -3, 5, 3), [slot_ring(2, 1)])
    found = found_in(Scene(robot, [peg()]))
    assert kinds(found) == ["point", "point"] and sorted(t for *_, t in places(found)) == pytest.approx([0, 180])


def test_two_discs_in_two_holes_have_one_point_and_two_if_they_are_equal() -> None:
    holes = plate(round_hole(1), round_hole(F(1, 2), (3, 0)))
    assert places(found_in(Scene([disc(1), disc(F(1, 2), (3, 0))], [holes]))) == [(0, 0, 0)]
    holes = plate(round_hole(1), round_hole(1, (3, 0)))
    assert places(found_in(Scene([disc(1), disc(1, (3, 0))], [holes]))) == [(0, 0, 0), (3, 0, 180)]


# --- rounded corners in fillets ---


@pytest.mark.parametrize("turn", TURNS)
def test_a_rounded_square_in_a_hole_with_its_fillets_has_four_points(turn: Turn) -> None:
    ring = filleted(F(-3, 2), F(-3, 2), F(3, 2), F(3, 2), F(1, 2))
    found = found_in(Scene(square(), [plate(ring, turn=turn)]))
    theta = math.degrees(math.atan2(turn[1], turn[0]))
    assert kinds(found) == ["point"] * 4
    assert sorted(t for *_, t in places(found)) == pytest.approx(sorted((theta + 90 * k) % 360 for k in range(4)))


@pytest.mark.slow
def test_smaller_fillets_leave_the_same_points_and_larger_ones_none() -> None:
    def fits(fillet: object) -> int:
        return len(found_in(Scene(square(), [plate(filleted(F(-3, 2), F(-3, 2), F(3, 2), F(3, 2), fillet))])))

    assert (fits(F(1, 4)), fits(F(1, 2)), fits(F(3, 4))) == (4, 4, 0)


def test_a_rounded_square_in_a_longer_hole_has_a_segment_each_quarter_turn() -> None:
    ring = filleted(F(-5, 2), F(-3, 2), F(5, 2), F(3, 2), F(1, 2))
    assert kinds(found_in(Scene(square(), [plate(ring)]))) == ["segment"] * 4


# --- bays ---


def bay(depth: object, wide: object = 1) -> Curved:
    """A block with a bay that opens downwards: walls as far apart as a disc of radius `wide`, and a half circle."""
    w, d = F(wide), F(depth)  # type: ignore[arg-type]
    walls = [(-w, -d), (-w, F(0))] if d else [(-w, F(0))]
    back = [(w, -d)] if d else []
    end = Arc((w, F(0)), center=(F(0), F(0)), clockwise=True)
    return Curved([(-5, 3), (-5, -d), *walls, end, *back, (5, -d), (5, 3)])


def test_a_disc_in_a_bay_of_its_radius_has_room_below_it() -> None:
    assert not found_in(Scene(disc(1), [bay(0)]))


@pytest.mark.slow
def test_a_disc_in_a_deep_bay_is_between_walls_that_are_trapezoids() -> None:
    assert not found_in(Scene(disc(1), [bay(2)]))


def test_a_peg_whose_end_fits_a_deep_bay_has_a_segment_out_of_it_each_way() -> None:
    found = found_in(Scene(grown(points((0, 0), (0, -3)), 1), [bay(2)]))
    assert kinds(found) == ["segment", "segment"]
    assert sorted(math.dist(a[:2], b[:2]) for _, (a, b) in found) == pytest.approx([2, 2])


# --- hairs, frames, files ---

FITS: dict[str, Callable[[F], Scene]] = {
    "disc": lambda more: Scene(disc(1 + more), [plate(round_hole(1))]),
    "peg": lambda more: Scene(peg(radius=1 + more), [plate(slot_ring(2, 1))]),
    "slanted peg": lambda more: Scene(peg(radius=1 + more), [plate(slot_ring(2, 1), turn=TURNS[1])]),
    "square": lambda more: Scene(
        square(F(1, 2) + more), [plate(filleted(F(-3, 2), F(-3, 2), F(3, 2), F(3, 2), F(1, 2)))]
    ),
    "pin": lambda more: Scene(Curved(box(-5, -3, 5, 3), [slot_ring(2, 1)]), [peg(radius=1 + more)]),
}
CELLS = {"disc": 1, "peg": 2, "slanted peg": 2, "square": 4, "pin": 2}


@pytest.mark.slow
@pytest.mark.parametrize("hair", [F(1, 2**20), HAIR])
@pytest.mark.parametrize("name", FITS)
def test_a_hair_less_leaves_little_cells_and_a_hair_more_nothing(name: str, hair: F) -> None:
    assert len(boundary(FITS[name](F(0))).isolated)
    less, more = boundary(FITS[name](-hair)), boundary(FITS[name](hair))
    assert not len(less.isolated) and not len(more.isolated)
    assert [sum(cell.bounded for cell in cfree.free_space(b).cells) for b in (less, more)] == [CELLS[name], 0]


@pytest.mark.parametrize("factor", [F(1), F(1, 2**40), F(2**30)])
@pytest.mark.parametrize("by", [0, 10**9, F(1, 3)])
def test_frames_and_scales_do_not_change_the_parts(by: object, factor: F) -> None:
    scene = Scene(peg(2 * factor, factor), [plate(slot_ring(2, 1), turn=TURNS[1], by=by, factor=factor)])
    found = boundary(scene)
    assert [part.kind for part in map(found.isolated_part, range(len(found.isolated)))] == ["point", "point"]
    for k in range(2):
        (x, y, _), _ = found.isolated_part(k).ends
        assert (x, y) == pytest.approx((float(by), 0), abs=1e-9 * float(factor))  # type: ignore[arg-type]


def test_parts_in_concave_arcs_go_through_files(tmp_path: Path) -> None:
    for name in ("disc", "peg"):
        result = boundary(FITS[name](F(0)))
        cfree.save(result, tmp_path / f"{name}.npz")
        assert cfree.load(tmp_path / f"{name}.npz") == result


def test_slices_and_pictures_have_them() -> None:
    result = boundary(FITS["peg"](F(0)))
    assert len(isolated_lines(result)) == 2
    assert len(isolated_at(result, 0.0)) == 1 and not isolated_at(result, 1.0)
    assert len(isolated_at(boundary(FITS["disc"](F(0))), 1.0)) >= 1


@pytest.mark.slow
def test_threads_do_not_change_fits_in_concave_arcs() -> None:
    one, two = (boundary(FITS["square"](F(0)), threads=count).isolated for count in (1, 2))
    assert one == two


def test_a_fit_in_a_concave_arc_is_in_no_cell_and_not_in_the_regularized_boundary() -> None:
    result = boundary(FITS["disc"](F(0)))
    assert not len(result.regularized.isolated)
    assert cfree.free_space(result).locate(Pose(0, 0)) == NO_CELL


# --- plans ---


MOVES: dict[str, tuple[Callable[[], Scene], Pose, Pose]] = {
    "a disc in its hole": (lambda: FITS["disc"](F(0)), Pose(0, 0), Pose(0, 0, "77deg")),
    "a bar in a hole of its length": (
        lambda: Scene(grown(points((-4, 0), (4, 0)), 1), [plate(round_hole(5))]), Pose(0, 0), Pose(0, 0, "90deg")
    ),
    "a short peg along its slot": (
        lambda: Scene(peg(1), [plate(slot_ring(2, 1), turn=TURNS[1])]),
        Pose(F(-4, 5), F(-3, 5), {"tau": F(1, 3)}), Pose(F(4, 5), F(3, 5), {"tau": F(1, 3)}),
    ),
    "a peg out of a bay": (
        lambda: Scene(grown(points((0, 0), (0, -3)), 1), [bay(2)]), Pose(0, 0), Pose(0, -8)
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", MOVES)
def test_a_path_leads_along_a_fit_in_concave_arcs(name: str) -> None:
    made, start, goal = MOVES[name]
    path = cfree.plan(made(), start, goal)
    assert isinstance(path, cfree.Path) and cfree.verify.answer(made(), path).verified


@pytest.mark.slow
@pytest.mark.parametrize("name", ["peg", "pin"])
def test_no_path_leaves_a_fit_in_concave_arcs(name: str) -> None:
    scene = FITS[name](F(0))
    answer = cfree.plan(scene, Pose(0, 0), Pose(14, 0))
    assert isinstance(answer, cfree.Separated) and cfree.verify.answer(scene, answer).verified


@pytest.mark.slow
@pytest.mark.parametrize("name", ["peg", "square"])
def test_no_path_turns_what_is_held_on_all_sides(name: str) -> None:
    scene = FITS[name](F(0))
    answer = cfree.plan(scene, Pose(0, 0), Pose(0, 0, "180deg"))
    assert isinstance(answer, cfree.Separated) and cfree.verify.answer(scene, answer).verified


# --- verification ---


@pytest.mark.slow
@pytest.mark.parametrize("name", FITS)
def test_fits_in_concave_arcs_are_verified_and_false_ones_refuted(name: str) -> None:
    result = boundary(FITS[name](F(0)))
    checked = cfree.verify.boundary(result, slices=4)
    assert checked.verified and "0 parts" not in str(checked)


# --- random scenes ---


def four_discs(turn: Turn, *, wall: bool) -> Scene:
    """Two discs of the robot in round holes, two beside discs: at one angle, and half a turn on, all slide around."""
    (c, s), places = turn, points((0, 0), (20, 0), (0, 40), (20, 40))
    first, second, third, fourth = [(c * x - s * y, s * x + c * y) for x, y in places]
    holes = [Curved(box(x - 6, y - 6, x + 6, y + 6), [round_hole(4, (x, y))]) for x, y in (first, fourth)]
    others = [disc(2, second), disc(2, third), *([box(-1, 2, 1, 5)] if wall else [])]
    return Scene([disc(1, p) for p in places], [*holes, *others])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("turn", "wall"),
    [
        pytest.param((F(1), F(0)), True, marks=pytest.mark.long),
        ((F(4, 5), F(3, 5)), False),
        pytest.param((F(0), F(1)), True, marks=pytest.mark.long),
    ],
)
def test_arcs_to_slide_along_at_one_orientation(turn: Turn, wall: bool) -> None:
    """At other angles the circles part, and those in holes leave room on one side, those beside discs on the other."""
    scene = four_discs(turn, wall=wall)
    arcs = [ends for kind, ends in found_in(scene) if kind == "arc"]
    assert len(arcs) == 8
    angle = math.degrees(math.atan2(float(turn[1]), float(turn[0])))
    assert {round(end[2] % 180, 9) for ends in arcs for end in ends} == {round(angle % 180, 9)}
    around = [line for line in isolated_at(boundary(scene), math.radians(angle)) if len(line) > 2]
    assert all(np.allclose(np.hypot(*line.T), 3) for line in around)
    length = sum(float(np.hypot(*np.diff(line, axis=0).T).sum()) for line in around)
    hidden = math.acos(2 / 3)  # from the top to where the disc touches the wall
    assert length == pytest.approx(3 * (math.tau - (2 * (math.pi / 2 - hidden) if wall else 0)), rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("family", FAMILIES)
def test_random_fits_in_concave_arcs_agree_with_exact_poses(family: str) -> None:
    for seed in range(2):
        _, faults, _ = compared(family, seed, lines=False)
        assert not faults
