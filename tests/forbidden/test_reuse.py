"""A boundary that takes patches of another one is, byte by byte, the boundary computed anew."""

import pickle
import random
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

import cfree
from cfree.forbidden.boundary import Boundary, boundary
from cfree.forbidden.columns import COLUMNS, ISOLATED_COLUMNS
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene
from changes import BAR, box, changed, random_scene
from compared import part_of, scene_of
from shapes import star_among_squares

ROOT = Path(__file__).parents[2]


HOW = (
    "decided_by_identity",
    "decided_by_filter",
    "decided_by_intervals",
    "decided_exactly",
)  # depends on what came before
HOUSES = [box(10 * x, 10 * y, 3, 2 + x) for x in range(4) for y in range(3)]
WALL = box(5, -20, 1, 60)


def assert_same_bytes(one: Boundary, other: Boundary) -> None:
    for name in ("contact_kind", "contact_robot", "contact_obstacle", "trimmed"):
        assert getattr(one, name).tobytes() == getattr(other, name).tobytes(), name
    for name in COLUMNS:
        assert getattr(one.trapezoids, name).tobytes() == getattr(other.trapezoids, name).tobytes(), name
    for name in ISOLATED_COLUMNS:
        assert getattr(one.isolated, name).tobytes() == getattr(other.isolated, name).tobytes(), name
    one_, other_ = (replace(x.stats, **dict.fromkeys(HOW, 0)) for x in (one, other))
    assert one_ == other_
    assert one == other


def reused(before: Scene | Boundary, after: Scene, least: int = 1) -> Boundary:
    """Reuse a boundary, of which so many patches at least must be kept; the result must be the one computed anew."""
    old = before if isinstance(before, Boundary) else boundary(before, threads=1)
    new = boundary(after, threads=1, reuse=old)
    assert_same_bytes(new, boundary(after, threads=1))
    assert new.kept_patches >= least
    return new


# examples


def test_only_patches_within_reach_of_a_change_are_trimmed_again() -> None:
    scene = Scene(BAR, HOUSES)
    per_house = boundary(scene).stats.patches // len(HOUSES)
    for after, count in (
        (scene.moved(0, (1, 0, 0)), 11),
        (scene.without_obstacle(5), 11),
        (scene.moved(3, (200, 0, 0)), 11),
    ):
        assert reused(scene, after).kept_patches == count * per_house
    assert reused(scene, scene.with_obstacle(box(100, 0, 1, 1))).kept_patches == 12 * per_house
    assert reused(scene, scene.moved(0, (0, 7, 0))).kept_patches < 11 * per_house  # next to another house


def test_all_is_kept_if_nothing_has_changed() -> None:
    scene = Scene(BAR, HOUSES, bounds=(-5, -5, 50, 40))
    again = Scene([*BAR.exact_rings], [house.exact_rings[0] for house in HOUSES], bounds=(-5, -5, 50, 40))
    kept = reused(scene, again)
    assert kept.kept_patches == kept.stats.patches


def test_obstacles_are_matched_in_any_order() -> None:
    scene = Scene(BAR, HOUSES)
    order = [5, 0, 11, 3, 7, 1, 9, 2, 10, 8, 4, 6]
    kept = reused(scene, Scene(BAR, [HOUSES[k] for k in order]))
    assert kept.kept_patches == kept.stats.patches
    assert reused(scene, Scene(BAR, [HOUSES[k] for k in order]).moved(2, (1, 1, "90deg"))).kept_patches


def test_names_and_texts_of_a_scene_do_not_matter() -> None:
    scene = Scene(BAR, HOUSES, name="a", obstacle_names=[f"house {k}" for k in range(12)], start=(0, -5, 0))
    kept = reused(scene, Scene(BAR, HOUSES, units="m"))
    assert kept.kept_patches == kept.stats.patches


def test_an_obstacle_first_on_a_line_gives_its_name_to_the_next_when_it_leaves() -> None:
    scene = Scene(BAR, [box(10 * k, 0, 2, 2) for k in range(4)])
    reused(scene, scene.moved(0, (0, 50, 0)), 40)
    reused(scene, scene.without_obstacle(0), 40)
    reused(scene.without_obstacle(0), Scene(BAR, [box(-20, 0, 2, 2), *scene.obstacles[1:]]), 40)


def test_obstacles_that_touch_or_coincide_are_matched_one_by_one() -> None:
    twins = Scene(BAR, [HOUSES[0], HOUSES[0], box(3, 0, 1, 1), *HOUSES[3:]])
    for k in range(4):
        reused(twins, twins.without_obstacle(k))
        reused(twins, twins.moved(k, (1, 0, 0)))
    reused(twins, Scene(BAR, [HOUSES[3], box(3, 0, 1, 1), HOUSES[0], *HOUSES[4:], HOUSES[0]]))
    reused(twins, twins.with_obstacle(HOUSES[0]))


def test_edges_that_two_obstacles_share_belong_to_the_right_one_in_another_order() -> None:
    pair = [box(0, 0, 2, 2), Polygon([(0, 0), (2, 0), (1, -1)]), Polygon([(0, 0), (2, 0), (1, -2)])]
    reused(Scene(BAR, [*pair, *HOUSES[3:]]), Scene(BAR, [*HOUSES[3:], *reversed(pair)]), 50)


def test_a_workspace_and_bounds_count_as_obstacles() -> None:
    room = box(-5, -5, 60, 60)
    scene = Scene(BAR, HOUSES, workspace=room)
    reused(scene, scene.moved(5, (1, 0, 0)))
    reused(scene, Scene(BAR, HOUSES, workspace=box(-5, -5, 61, 60)))
    scene = Scene(BAR, HOUSES, bounds=(-5, -5, 50, 40))
    reused(scene, scene.moved(5, (1, 0, 0)))
    reused(scene, scene.moved(5, (100, 0, 0)))  # the rim around all patches grows
    reused(scene, Scene(BAR, HOUSES, bounds=(-4, -5, 50, 40)))
    reused(scene, Scene(BAR, HOUSES), 0)  # without its reference point the robot is another


def test_exact_fits_are_listed_anew() -> None:
    gap = [box(0, 0, 5, 5), box(0, 6, 5, 5), box(20, 0, 5, 5), box(20, 6, 5, 5)]
    scene = Scene(BAR, gap)
    assert len(boundary(scene).isolated) > 0
    for change in (
        scene.moved(0, (0, -1, 0)),
        scene.moved(3, (1, 0, 0)),
        scene.without_obstacle(1),
        scene.with_obstacle(box(5, 0, 1, 11)),
    ):
        reused(scene, change)
    assert len(reused(scene.moved(0, (0, -1, 0)), scene).isolated) == len(boundary(scene).isolated)


def test_robots_of_several_parts() -> None:
    scene = Scene([box(0, 0, 1, 1), box(2, 0, 1, 1), box(1, 0, 1, "1/8")], HOUSES)
    reused(scene, scene.moved(4, (3, 1, 0)), 300)


def test_scenes_far_from_the_origin() -> None:
    far = Scene(BAR, HOUSES).moved(0, (0, 0, 0))
    far = Scene(BAR, [Polygon([(x + 10**9, y) for x, y in house.exact_vertices]) for house in HOUSES])
    reused(far, far.moved(5, (1, 0, 0)))


@pytest.mark.parametrize(
    "pose",
    [
        (0.1, 0.2, 0),
        (1e-9, 0, 0),
        (0.3, -0.7, 0.4),
        (0, 0, "30deg"),
        ("0.5", 0, "-1deg"),
        (2**-40, 0, 0),
        ("1/1000003", 0, 0),
    ],
)
def test_moves_by_doubles_and_turns_by_any_angle_change_nothing_elsewhere(pose: tuple[float, float, float]) -> None:
    scene = Scene(BAR, [box("0.1", k * k + Fraction(k, 10), 2, 3) for k in range(12)])
    for k in (0, 5):
        moved = scene.moved(k, pose)
        reused(scene, moved, 200)
        reused(moved, scene, 200)
        reused(moved, moved.moved(8, (0.1, 0, "17deg")), 200)
        reused(moved, moved.moved(k, (0.1, 0, "17deg")), 200)


@pytest.mark.parametrize(
    ("x", "shift", "is_new"),
    [
        (0, "0.1", True),
        (0, "0.0000001", True),
        (0, "1/3", True),
        (0, 0.1, False),
        ("0.1", "0.3", False),
        ("0.1", "0.0000001", True),
        ("0.1", "-5/21", True),
    ],
)
def test_a_denominator_changes_all_once_a_quarter_of_the_vertices_has_it(
    x: int | str, shift: float | str, is_new: bool
) -> None:
    scene, kept = Scene(BAR, [box(x, k * k, 2, 3) for k in range(12)]), []
    for k in range(5):
        scene, before = scene.moved(k, (shift, 0, 0)), scene
        kept.append(reused(before, scene, 0).kept_patches)
    assert [count > 200 for count in kept] == [True, True, not is_new, True, True]
    assert kept[2] == 0 or not is_new


def test_decimals_of_six_digits_change_nothing_elsewhere_among_decimals() -> None:
    scene = Scene(BAR, [box("0.1", k * k, 2, 3) for k in range(12)])
    for k in range(5):
        scene, before = scene.moved(k, ("0.000001", 0, 0)), scene
        reused(before, scene, 200)


def test_simple_fractions_are_doubles_as_long_as_they_are_few() -> None:
    thirds = Scene(BAR, [box(Fraction(k, 3), k * k, 2, 3) for k in range(12)])
    reused(thirds, thirds.moved(5, ("1/3", 0.1, "20deg")), 200)
    many = Scene(BAR, [box(Fraction(1, 10**k + 3), k * k * 3, 2, 3) for k in range(12)])
    reused(many, many.moved(5, ("1/3", 0.1, "20deg")), 0)
    reused(many, many.moved(5, (0, 0.1, "20deg")), 100)


def test_moves_by_doubles_among_doubles() -> None:
    scene = Scene(BAR, [box(0.1 * k * k, 7.3 * k, 1.7, 2.9) for k in range(12)])
    reused(scene, scene.moved(5, (0.5, 0.25, "90deg")), 200)


# properties


def test_many_changes_one_after_another() -> None:
    scene, old = Scene(BAR, [*HOUSES, WALL]), boundary(Scene(BAR, [*HOUSES, WALL]))
    for k in range(12):
        scene = scene.moved(k, (1, k % 3 - 1, 0))
        old = reused(old, scene)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(40))
def test_random_changes(seed: int) -> None:
    generator = random.Random(seed)
    scene, size, digits = random_scene(generator)
    old = boundary(scene)
    for _ in range(4):
        scene = changed(generator, scene, size, digits)
        old = reused(old, scene, 0)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["benchmr_warehouse", "nest_swim", "street_Berlin"])
def test_an_obstacle_of_a_real_scene_moved(name: str) -> None:
    scene = cfree.load_scene(ROOT / "examples" / "scenes" / f"{name}.json")
    old = boundary(scene)
    for k in (0, len(scene.obstacles) // 2):
        new = reused(old, scene.moved(k, ("0.5", 0, 0)))
        assert new.kept_patches > new.stats.patches // 2


# limits


def test_threads_do_not_matter() -> None:
    scene = Scene(BAR, [*HOUSES, WALL])
    moved, old = scene.moved(3, (1, 0, 0)), boundary(scene)
    assert_same_bytes(boundary(moved, threads=2, reuse=old), boundary(moved, threads=1, reuse=old))


@pytest.mark.parametrize("spikes", [6, 16])
def test_slices_covered_by_one_pillar_are_cut_off_as_anew(spikes: int) -> None:
    scene = scene_of(star_among_squares(spikes))
    assert reused(boundary(scene), scene.moved(7, (1, "1/2", "1/3"))).kept_patches > 0


@pytest.mark.slow
def test_a_boundary_that_is_not_complete_gives_what_it_has() -> None:
    scene = scene_of(star_among_squares())
    part = part_of(scene)
    assert not part.trimmed.all()
    assert 0 < reused(part, scene).kept_patches <= part.trimmed.sum()
    moved, whole = scene.moved(0, ("0.5", 0, 0)), boundary(scene)
    stopped = boundary(moved, threads=1, max_seconds=0, reuse=whole)
    assert 0 < stopped.trimmed.sum() < len(stopped.trimmed)
    assert boundary(moved, reuse=whole).kept_patches <= stopped.trimmed.sum()
    reused(stopped, moved, stopped.kept_patches)


@pytest.mark.parametrize(
    "other",
    [
        Scene(box(0, 0, 2, 2), HOUSES),  # another robot
        Scene(BAR, [Polygon([(x / 3, y) for x, y in house.exact_vertices]) for house in HOUSES]),  # other places
        Scene(BAR, [box(1000, 1000, 1, 1)]),
        Scene(BAR),
    ],
)
def test_nothing_is_kept_where_nothing_is_the_same(other: Scene) -> None:
    assert reused(other, Scene(BAR, HOUSES), 0).kept_patches == 0


def test_nothing_is_kept_of_a_boundary_without_its_parts_without_width(tmp_path: Path) -> None:
    scene = Scene(BAR, HOUSES)
    old = boundary(scene)
    cfree.save(old, tmp_path / "old.npz")
    for copy in (cfree.load(tmp_path / "old.npz"), pickle.loads(pickle.dumps(old))):
        assert copy.kept_patches == 0
        assert reused(copy, scene, 0).kept_patches == 0


def test_reuse_takes_a_boundary() -> None:
    with pytest.raises(TypeError, match=r"reuse: .* give a Boundary"):
        boundary(Scene(BAR, HOUSES), reuse=Scene(BAR, HOUSES))  # type: ignore[arg-type]


def test_roots_by_exact_integers_are_isolated_again_if_the_denominator_changes() -> None:
    """Their last digits depend on it: here between the denominators 1 and 4."""
    hook = Polygon([(9, 7), (13, 7), (13, 8), (10, 8), (10, 11), (9, 11)])
    robot = [box(0, 0, 1, 1), box(2, 0, 1, 1)]
    scene = Scene(robot, [box(14, 6, 1, 1), hook, box(13, 9, 4, 2), box(500, 500, 1, 1)])
    assert boundary(scene).stats.decided_exactly
    for denominator in (2, 4, 8, 2**30):
        reused(scene, scene.moved(3, (Fraction(1, denominator), 0, 0)))
