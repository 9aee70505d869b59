"""Names of obstacles: number, size and place."""

from fractions import Fraction

import pytest

from cfree import Curved, Scene
from cfree.scene.naming import all_placed, numbered, placed
from shapes import box

SQUARE = box(0, 0, 1, 1)[0]


@pytest.mark.parametrize(
    ("ring", "said"),
    [
        (box("3.175", "-1.425", "3.225", "-1.375")[0], "0.05 x 0.05 at (3.2, -1.4)"),
        (box(0, 0, 5, "0.16")[0], "5 x 0.16 at (2.5, 0.08)"),
        (box(123456, 654321, 123457, 654322)[0], "1 x 1 at (123456.5, 654321.5)"),
        (box(-1, -1, 1, 1)[0], "2 x 2 at (0, 0)"),
        (box(0, 0, 1347, 20)[0], "1347 x 20 at (674, 10)"),
        (
            box(1, 1, Fraction(10**9 + 1, 10**9), Fraction(10**9 + 1, 10**9))[0],
            "1e-09 x 1e-09 at (1.0000000005, 1.0000000005)",
        ),
    ],
)
def test_an_obstacle_has_a_number_a_size_and_a_place(ring: list[tuple[object, object]], said: str) -> None:
    assert placed(Scene(SQUARE, [SQUARE, ring]), 1) == f"obstacle 1, {said}"


def test_a_name_stands_beside_the_number() -> None:
    scene = Scene(SQUARE, [SQUARE, SQUARE], obstacle_names=["desk", None], workspace=box(-9, -9, 9, 9)[0])
    assert [numbered(scene, k) for k in (0, 1, -1, -2)] == [
        "obstacle 0 (desk)",
        "obstacle 1",
        "the bounds",
        "the workspace",
    ]
    assert placed(scene, 0) == "obstacle 0 (desk), 1 x 1 at (0.5, 0.5)" and placed(scene, -2) == "the workspace"


def test_the_pieces_of_a_round_shape_have_its_number_and_are_named_once() -> None:
    ell = Curved([(5, 0), (8, 0), (8, 1), (6, 1), (6, 3), (5, 3)], grown="1/10")
    scene = Scene(SQUARE, [SQUARE, ell]).outer(0.01)
    assert len(scene.obstacles) > 2
    assert [name.partition(",")[0] for name in all_placed(scene, range(len(scene.obstacles))).split("; ")] == [
        "obstacle 0",
        "obstacle 1",
    ]


def test_the_pieces_of_named_round_shapes_have_their_numbers() -> None:
    ell = Curved([(5, 0), (8, 0), (8, 1), (6, 1), (6, 3), (5, 3)], grown="1/10")
    disc = Curved.circle((20, 0), 1)
    scene = Scene(SQUARE, [ell, disc, ell, SQUARE], obstacle_names=["a", "b", None, "c"]).outer(0.01)
    names = [numbered(scene, k) for k in range(len(scene.obstacles))]
    assert list(dict.fromkeys(names)) == ["obstacle 0 (a)", "obstacle 1 (b)", "obstacle 2", "obstacle 3 (c)"]


def test_of_many_obstacles_eight_are_named() -> None:
    scene = Scene(SQUARE, [SQUARE] * 53)
    assert all_placed(scene, range(53)).count("obstacle") == 8 and all_placed(scene, range(53)).endswith("; ... of 53")
