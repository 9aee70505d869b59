"""Cages: proofs, paths out, points, and the numbers at which they open."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

import cfree
from cfree.caging import critical_clearance, critical_size, critical_spread, fewest_fingers, is_caged
from cfree.caging.critical import puncture
from cfree.caging.fewest import smallest_hitting
from cfree.caging.fingers import is_within, setting, to_body, to_fingers
from fuzz_cages import check

SQUARE = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
POINTS = [("1.1", 0), (0, "1.1"), ("-1.1", 0), (0, "-1.1")]
H = [(0, 0), (1, 0), (1, 2), (3, 2), (3, 0), (4, 0), (4, 5), (3, 5), (3, 3), (1, 3), (1, 5), (0, 5)]
DISC = cfree.Curved.circle


def test_two_points_in_the_notches_of_an_h_cage_it() -> None:
    cage = is_caged(H, [(2, 1), (2, 4)])
    assert cage and cage.proof is not None and cage.path is None
    assert cage.proof.of == "closed" and cage.holding == (0, 1) and cage.verified()


def test_a_body_that_is_not_caged_has_a_path_out_to_a_pose_beyond_all_fingers() -> None:
    cage = is_caged(H, [(2, 1)])
    assert not cage and cage.path is not None and cage.proof is None and cage.holding == ()
    assert cage.verified() and cage.path.is_free(cfree.MotionChecker(cage.scene))
    near = replace(cage, answer=cfree.Path(cage.pose, [cfree.Translation((0, "1/2"))]))
    assert not near.verified()


@pytest.mark.parametrize("gap", ["1.9", "2.1"])
def test_three_points_around_a_disc_cage_it_if_the_gaps_are_less_than_its_diameter(gap: str) -> None:
    side = Fraction(gap)  # of a triangle, nearly equilateral
    points = [
        (-side / 2, -side * Fraction("0.2887")),
        (side / 2, -side * Fraction("0.2887")),
        (0, side * Fraction("0.5773")),
    ]
    assert bool(is_caged(DISC((0, 0), 1), points)) == (side < 2)


def test_points_are_exact_also_in_gaps_that_differ_by_a_billionth_from_the_body() -> None:
    over, under = [(-9, 1), (9, 1), (9, 2), (-9, 2)], [(-9, -1), (9, -1), (9, 0), (-9, 0)]
    stop, height = [(2, 0), (3, 0), (3, 1), (2, 1)], Fraction("0.9999")
    bar = [(0, 0), (1, 0), (1, height), (0, height)]
    for share, caged in (("0.999999999", True), ("1.000000001", False)):
        cage = is_caged(bar, [over, stop, under, (-2, height * Fraction(share))])
        assert bool(cage) == caged and cage.verified()


def test_a_gap_exactly_as_wide_as_the_body_is_a_way_out_if_a_straight_motion_takes_it() -> None:
    walls = [[(-9, 1), (9, 1), (9, 2), (-9, 2)], [(-9, -1), (9, -1), (9, 0), (-9, 0)]]
    assert not is_caged([(0, 0), (1, 0), (1, 1), (0, 1)], walls)


def test_contact_is_allowed_and_overlap_is_refused_with_the_finger() -> None:
    assert is_caged(SQUARE, [(1, 0), (0, 1), (-1, 0), (0, -1)])
    with pytest.raises(cfree.InvalidPoseError, match=r"finger 1 at \(0, 0\.5\) is inside the body"):
        is_caged(SQUARE, [(3, 0), (0, "0.5")])
    with pytest.raises(cfree.InvalidPoseError, match=r"finger 0"):
        is_caged(SQUARE, [DISC((1, 0), "0.5")])


def test_a_body_without_shapes_is_refused() -> None:
    with pytest.raises(ValueError, match=r"^body: there is no shape; give at least one$"):
        is_caged([], [(1, 2)])


def test_a_point_on_an_ellipse_is_undecided_and_not_called_inside() -> None:
    ellipse = cfree.Curved.ellipse((0, 0), (2, 1))
    for point in ((2, 0), (0, 1), ("1.2", "0.8")):
        with pytest.raises(cfree.UndecidedError, match=r"finger 0 at .* touches the body, or almost does, at a curve"):
            is_caged(ellipse, [point])
    with pytest.raises(cfree.InvalidPoseError, match=r"finger 0 at \(1, 0\) is inside the body"):
        is_caged(ellipse, [(1, 0)])


def test_shapes_with_other_curves_are_decided_by_polygons_around_and_inside_of_them() -> None:
    ellipse, tips = cfree.Curved.ellipse((0, 0), (2, 1)), [(0, "1.1"), (0, "-1.1"), ("2.1", 0), ("-2.1", 0)]
    assert is_caged(ellipse, tips).verified() and not is_caged(ellipse, tips[:1])
    with pytest.raises(cfree.InvalidPoseError, match="is forbidden"):
        is_caged(ellipse, [DISC((0, 1), "1/2")])


def test_an_exact_fit_of_points_is_undecided_and_says_so() -> None:
    bracket = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]  # its corners are sqrt(2) apart, as two of the points
    points = [(Fraction("1.2"), Fraction("1.2")), (Fraction("-0.2"), 1), (1, Fraction("-0.2"))]
    with pytest.raises(cfree.UndecidedError, match="move a finger"):
        is_caged(bracket, points)


def test_a_smaller_body_of_a_proof_keeps_its_distance_from_the_rim() -> None:
    body, pose = to_body(H, (0, 0, 0))
    place = setting(body, to_fingers([(2, 1), (2, 4)]), pose, 10)
    assert place.within > 0 and all(is_within(part, body[0], place.within) for part in place.smaller.robot)
    cage = is_caged(H, [(2, 1), (2, 4)])
    assert not replace(cage, within=cage.within * 4).verified()
    assert not replace(cage, within=cage.within / 4).verified()
    assert not replace(cage, fingers=to_fingers([(2, 1), (2, "4.1")])).verified()


def test_the_scene_of_a_cage_is_verified_from_its_files(tmp_path: object) -> None:
    from pathlib import Path

    folder = Path(str(tmp_path))
    cage = is_caged(SQUARE, POINTS)
    cfree.save(cage.scene, folder / "scene.json")
    cfree.save(cage.answer, folder / "answer.json")
    assert cfree.verify.answer(cfree.load_scene(folder / "scene.json"), folder / "answer.json").verified


@pytest.mark.slow
def test_the_critical_spread_of_four_points_around_a_square_is_that_of_a_gap_as_wide_as_its_side() -> None:
    found = critical_spread(SQUARE, POINTS, tolerance=0.002)
    assert found.escapes is not None and found.opened is not None
    assert 1.1 * found.caged <= 2**0.5 <= 1.1 * found.escapes and found.escapes - found.caged <= 0.002
    assert found.cage.verified() and found.opened.verified() and bool(found.cage) and not found.opened
    for cage, scale in ((found.cage, found.caged), (found.opened, found.escapes)):
        assert cage.fingers[0] == (Fraction("1.1") * Fraction(scale), 0)
    assert found.puncture is not None and len(found.puncture.fingers) == 2
    assert abs(found.puncture.fingers[0] - found.puncture.fingers[1]) in (1, 3)  # neighbours


@pytest.mark.slow
def test_round_fingers_open_later_by_their_diameter() -> None:
    found = critical_spread(SQUARE, [DISC(point, "1/10") for point in POINTS])
    assert found.escapes is not None
    low, high = (1.1 * scale * 2**0.5 - 0.2 for scale in (found.caged, found.escapes))
    assert low <= 2 <= high


@pytest.mark.slow
def test_size_and_clearance_at_which_a_square_escapes() -> None:
    size, clearance = critical_size(SQUARE, POINTS), critical_clearance(SQUARE, POINTS)
    assert size.escapes is not None and clearance.escapes is not None
    assert size.escapes <= 1.1 / 2**0.5 <= size.caged
    assert clearance.caged <= 1 - 1.1 / 2**0.5 <= clearance.escapes
    for found in (size, clearance):
        assert found.cage.verified() and found.opened is not None and found.opened.verified()


def test_fingers_that_close_on_a_body_end_at_a_contact() -> None:
    found = critical_spread(SQUARE, POINTS, direction="close")
    assert found.escapes is None and found.puncture is None and "finger 0" in found.end
    assert found.caged >= 1 / 1.1 and "still caged" in str(found)


def test_numbers_of_a_body_that_is_not_caged_are_refused() -> None:
    with pytest.raises(ValueError, match="not caged"):
        critical_size(SQUARE, POINTS[:2])
    with pytest.raises(ValueError, match="tolerance 0: give a number above 0"):
        critical_size(SQUARE, POINTS, tolerance=0)


def test_a_body_inside_of_one_finger_stays_caged_at_any_size() -> None:
    ring = cfree.Polygon([(-3, -3), (3, -3), (3, 3), (-3, 3)], [[(-2, -2), (-2, 2), (2, 2), (2, -2)]])
    found = critical_clearance(SQUARE, [ring])
    assert found.escapes is None and "nothing is left" in found.end


def test_the_fewest_fingers_are_proved_by_paths_that_only_they_all_block() -> None:
    found = fewest_fingers(SQUARE, [*POINTS, (2, 2), (-2, 2), (3, 0)])
    assert found.fingers == (0, 1, 2, 3) and found.verified()
    assert [escape.blocking for escape in found.escapes] == [(1,), (3,), (0, 6), (2,)]
    assert not replace(found, escapes=found.escapes[:1]).verified()


def test_no_set_of_fingers_is_better_than_the_fewest_by_trying_all() -> None:
    from itertools import combinations

    places = [(2, 1), (2, 4), (-1, 2), (5, 3), (2, -2)]
    found = fewest_fingers(H, places)
    sizes = [len(some) for n in range(len(places)) for some in combinations(places, n) if is_caged(H, some)]
    assert len(found.fingers) == min(sizes) == 2


def test_places_that_do_not_cage_even_together_are_reported_with_the_path() -> None:
    found = fewest_fingers(SQUARE, POINTS[:3])
    assert not found and found.fingers == () and found.cage.path is not None and found.verified()


def test_smallest_hitting_sets() -> None:
    assert smallest_hitting([{0, 1}, {1, 2}, {2, 0}]) == [0, 1]
    with pytest.raises(ValueError, match="cannot be hit"):
        smallest_hitting([set()])


def test_the_puncture_is_between_the_fingers_that_the_path_passes() -> None:
    wide = [(3, 0), (0, "1.1"), ("-1.1", 0), (0, "-1.1")]
    opened = is_caged(SQUARE, wide)
    place = puncture(opened)
    assert not opened and place is not None and {1, 3} & {*place.fingers}


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_random_cages_agree_with_flooding(seed: int) -> None:
    assert check(seed)["scenes"] <= 1
