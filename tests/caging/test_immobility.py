"""Immobility: results of the literature, the free space of the core, and a search for motions."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import numpy as np
import pytest

import cfree
from cfree.caging import immobility
from cfree.curves import Arc
from cfree.curves.similar import moved_shape

TRIANGLE, INCIRCLE = [(0, 0), (12, 0), (0, 5)], [(2, 0), (0, 2), ("36/13", "50/13")]
SQUARE = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
DISC = cfree.Curved.circle


def test_three_points_with_normals_that_meet_hold_a_triangle_to_second_order() -> None:
    answer = immobility(TRIANGLE, INCIRCLE)
    assert answer and answer.order == 2 and len(answer.contacts) == 3


@pytest.mark.parametrize("moved", ["1/100", "-1/100"])
def test_three_points_with_normals_that_do_not_meet_let_a_triangle_turn(moved: str) -> None:
    answer = immobility(TRIANGLE, [(2 + Fraction(moved), 0), *INCIRCLE[1:]])
    assert answer.verdict == "mobile" and answer.order == 1


def test_four_points_hold_a_triangle_to_first_order() -> None:
    answer = immobility(TRIANGLE, [(1, 0), (5, 0), (0, 2), ("36/13", "50/13")])
    assert answer and answer.order == 1


def test_a_disc_is_never_held_against_rotation() -> None:
    for fingers in ([(0, -1), (1, 0), (0, 1), (-1, 0)], [DISC(("9/5", "12/5"), 2), DISC(("-9/5", "12/5"), 2), (0, -1)]):
        answer = immobility(DISC((0, 0), 1), fingers)
        assert answer.verdict == "mobile" and answer.motion is not None
        assert isinstance(answer.motion, cfree.Rotation) and answer.motion.pole == (0, 0)


@pytest.mark.parametrize("radius", ["1/1000", "1/2", "3"])
def test_opposite_fingers_hold_a_square_whatever_their_radius(radius: str) -> None:
    r = Fraction(radius)
    answer = immobility(SQUARE, [DISC((x * (1 + r), y * (1 + r)), r) for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))])
    assert answer and answer.order == 2


def test_two_points_in_notches_hold_to_first_order_and_on_flat_edges_not_at_all() -> None:
    notched = [(-3, -1), (-1, -1), (0, "-1/2"), (1, -1), (3, -1), (3, 1), (1, 1), (0, "1/2"), (-1, 1), (-3, 1)]
    assert immobility(notched, [(0, "-1/2"), (0, "1/2")]).order == 1
    assert immobility(SQUARE, [(0, -1), (0, 1)]).verdict == "mobile"


@pytest.mark.parametrize(("radius", "verdict"), [("1/2", "immobile"), ("9/10", "immobile")])
def test_two_discs_in_dents_of_larger_radius_hold_a_body_by_curvature(radius: str, verdict: str) -> None:
    """Concave arcs of radius 1 on both sides of a bar; smaller discs at their deepest places."""
    body = cfree.Curved(
        [(-3, -2), (-1, -2), Arc((1, -2), center=(0, -2), clockwise=True), (3, -2), (3, 2), (1, 2),
         Arc((-1, 2), center=(0, 2), clockwise=True), (-3, 2)]
    )  # fmt: skip
    r = Fraction(radius)
    answer = immobility(body, [DISC((0, -1 - r), r), DISC((0, 1 + r), r)])
    assert answer.verdict == verdict and answer.order == 2


def stadium_in_dents(a: Fraction, lower: Fraction, upper: Fraction) -> str:
    """The verdict about a stadium with ends of radius 1 and centers (0, -a) and (0, a), in dents of larger radii."""
    body = cfree.Curved([(1, -a), (1, a), Arc((-1, a), center=(0, a)), (-1, -a), Arc((1, -a), center=(0, -a))])

    def dent(radius: Fraction) -> cfree.Curved:
        """Below the stadium; mirrored, above it."""
        y = radius - a - 1
        x, rim = radius * Fraction(4, 5), y - radius * Fraction(3, 5)
        low = y - radius - 1
        return cfree.Curved(
            [(-x - 1, rim), (-x - 1, low), (x + 1, low), (x + 1, rim), (x, rim),
             Arc((-x, rim), center=(0, y), clockwise=True)]
        )  # fmt: skip

    turned = moved_shape(dent(upper), cfree.Pose(0, 0, "180deg"))
    return immobility(body, [dent(lower), turned]).verdict


@pytest.mark.parametrize(("lower", "upper"), [("5/4", "5"), ("2", "2"), ("3/2", "3")])
def test_dents_hold_a_stadium_if_it_is_longer_than_their_radii_allow(lower: str, upper: str) -> None:
    """The sum of both forms is negative if and only if 2 a > R + R' - 2: both centers may roll in their dents."""
    r, s = Fraction(lower), Fraction(upper)
    limit = (r + s - 2) / 2
    assert stadium_in_dents(limit * Fraction(101, 100), r, s) == "immobile"
    assert stadium_in_dents(limit * Fraction(999, 1000), r, s) != "immobile"
    assert stadium_in_dents(limit / 2, r, s) == "mobile"


def test_two_discs_on_bulges_do_not_hold_a_body() -> None:
    body = cfree.Curved([(-3, -1), Arc((3, -1), through=(0, -2)), (3, 1), Arc((-3, 1), through=(0, 2))])
    answer = immobility(body, [DISC((0, -3), 1), DISC((0, 3), 1)])
    assert answer.verdict == "mobile" and answer.order == 2


def test_a_square_in_a_hole_of_its_size_is_held_to_first_order() -> None:
    hole = cfree.Polygon([(-2, -2), (2, -2), (2, 2), (-2, 2)], [[(-1, -1), (-1, 1), (1, 1), (1, -1)]])
    assert immobility(SQUARE, [hole]).order == 1


def test_a_finger_that_misses_by_any_distance_does_not_touch() -> None:
    answer = immobility(TRIANGLE, [(2, Fraction(-1, 10**30)), *INCIRCLE[1:]])
    assert answer.verdict == "mobile" and {contact.finger for contact in answer.contacts} == {1, 2}


def test_a_body_without_contacts_is_mobile_and_an_overlap_is_refused() -> None:
    assert immobility(SQUARE, [(3, 0)]).verdict == "mobile" and not immobility(SQUARE, [(3, 0)]).contacts
    with pytest.raises(cfree.InvalidPoseError, match="finger 0"):
        immobility(SQUARE, [(0, 0)])
    with pytest.raises(cfree.UnsupportedError, match="arcs"):
        immobility(cfree.Curved.ellipse((0, 0), (1, 2)), [(0, 2)])


def test_the_pose_of_the_body_does_not_matter() -> None:
    pose = cfree.Pose("7/3", -2, {"tau": "2/5"})
    fingers = pose.apply_exact([(Fraction(x), Fraction(y)) for x, y in INCIRCLE])
    assert immobility(TRIANGLE, fingers, pose).order == 2


def touched(seed: int) -> tuple[cfree.Polygon, list[cfree.Polygon]]:
    """A small polygon on a grid, and fingers with a corner on its rim."""
    rng = random.Random(seed)

    def polygon(points: list[tuple[Fraction, Fraction]]) -> cfree.Polygon | None:
        try:
            return cfree.Polygon(points)
        except ValueError:
            return None

    body = None
    while body is None:
        body = polygon(
            [(Fraction(rng.randint(0, 4)), Fraction(rng.randint(0, 4))) for _ in range(rng.choice((3, 4, 5)))]
        )
    ring, fingers = body.exact_rings[0], list[cfree.Polygon]()
    for _ in range(rng.randint(2, 5)):
        k, share = rng.randrange(len(ring)), Fraction(rng.choice(("0", "1/4", "1/3", "1/2", "1/2", "2/3")))
        (x, y), (u, v) = ring[k], ring[(k + 1) % len(ring)]
        a = x + share * (u - x), y + share * (v - y)
        for _ in range(20):
            others = [(a[0] + rng.randint(-3, 3), a[1] + rng.randint(-3, 3)) for _ in range(rng.choice((2, 3)))]
            finger = polygon([a, *others])
            if finger is not None and cfree.is_free(cfree.Scene(body, [finger]), cfree.Pose(0, 0)):
                fingers.append(finger)
                break
    return body, fingers


def test_edges_in_one_line_on_two_sides_of_a_corner_do_not_make_a_held_body_mobile() -> None:
    """A turn moves the corner below the finger's edge, and the edge behind it into the finger, both to second order."""
    body = [(0, 0), (3, 0), (2, 2), (1, 2)]
    fingers = [
        [(2, 2), (3, 2), (5, 3), (2, 5)],
        [("8/3", "2/3"), ("14/3", "2/3"), ("8/3", "8/3")],
        [("3/4", "3/2"), ("-9/4", "-3/2"), ("-5/4", "-3/2")],
        [(0, 0), (-2, -1), (2, -1)],
        [(1, 0), (-1, -1), (0, -1), (2, 0)],
    ]
    assert cfree.free_space(cfree.boundary(cfree.Scene(body, fingers))).locate(cfree.Pose(0, 0)) == -2
    assert immobility(body, fingers).verdict != "mobile"


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, 240, 40))
def test_held_bodies_are_isolated_in_the_free_space_and_mobile_ones_are_not(first: int) -> None:
    """The core decides it by other means: a pose in the closure of no cell is an exact fit."""
    for seed in range(first, first + 40):
        body, fingers = touched(seed)
        answer = immobility(body, fingers)
        boundary = cfree.boundary(cfree.Scene(body, fingers))
        cell = int(cfree.free_space(boundary).locate(cfree.Pose(0, 0)))
        assert not answer or cell == -2, seed
        assert cell < 0 or answer.verdict == "mobile", seed
        assert answer.verdict != "mobile" or cell >= 0 or (answer.order is None and len(boundary.isolated)), seed


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(60))
def test_no_short_motion_is_found_where_a_body_is_immobile_and_one_where_it_is_mobile(seed: int) -> None:
    """Poses near by, at random and along the velocity: all forbidden, or one free."""
    body, fingers = touched(seed)
    answer, rng = immobility(body, fingers), np.random.default_rng(seed)
    scene = cfree.Scene(body, fingers)
    if answer:
        for size in (1e-1, 1e-2, 1e-3):
            offsets = rng.normal(size=(4000, 3))
            offsets *= size / np.linalg.norm(offsets, axis=1)[:, None]
            free = cfree.is_free(scene, cfree.Poses(offsets[:, :2], offsets[:, 2]))
            assert not free.any() or size == 1e-1  # a pose farther away may be free
    elif answer.order == 1 and answer.velocity is not None:
        x, y, turning = answer.velocity
        t = Fraction(1, 10**7)
        tau = Fraction(math.tan(float(t * turning) / 2))
        assert cfree.is_free(scene, cfree.Pose(t * x, t * y, {"tau": tau}))
