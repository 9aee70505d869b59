"""Scales, margins, misses and blockers among round shapes, against closed forms."""

from __future__ import annotations

import math
import pickle
from fractions import Fraction
from typing import Any

import pytest
import shapely

import cfree.verify
from cfree import Curved, Scene, blockers, boundary, max_margin, max_scale, nearest_miss
from cfree.analysis import among_rounds, margins
from cfree.analysis.among_rounds import Decisions
from cfree.analysis.blockers import Blockers, _without
from cfree.analysis.inset_shapes import inset_shapes
from cfree.analysis.margins import Interval
from cfree.curves import Arc, Circle
from cfree.planning import curved
from cfree.polygons.polygon import Polygon
from shapes import box

HALL = box(0, -3, 6, 3)[0]
POSTS = [Curved.circle((x, 0), 1) for x in (0, 3, 6)]  # gaps of 1


def hall(robot: Any, obstacles: Any = POSTS) -> Scene:
    return Scene(robot, obstacles, workspace=HALL, start=(3, 2, 0), goal=(3, -2, 0))


def disc(radius: Any) -> Curved:
    return Curved.circle((0, 0), radius)


def stadium(half: Any, radius: Any) -> Curved:
    a, r = Fraction(half), Fraction(radius)
    return Curved([(-a, -r), (a, -r), Arc((a, r), center=(a, 0)), (-a, r), Arc((-a, -r), center=(-a, 0))])


def is_within(found: Interval, truth: float, tolerance: float) -> bool:
    return found.lo <= truth <= found.hi <= (1 + tolerance) * found.lo and not found.undecided


@pytest.mark.parametrize("radius", ["0.49", "0.5", "0.6", Fraction(1, 2**20)])
def test_the_largest_scale_of_a_disc_between_discs(radius: Any) -> None:
    assert max_scale(hall(disc(radius))).exact == Fraction(1, 2) / Fraction(radius)


@pytest.mark.slow
def test_the_largest_scale_of_a_half_disc_that_goes_through_turned() -> None:
    half = Curved([(0, "-0.45"), Arc((0, "0.45"), center=(0, 0))])  # as deep as 0.45: through a corridor by its depth
    walls = [box(-9, -1, 2, 1)[0], box(3, -1, 9, 1)[0]]
    shares: list[float] = []
    found = max_scale(hall(half, walls), tolerance=0.05, progress=shares.append)
    assert found.lo <= 1 / 0.45 <= found.hi <= 1.05 * found.lo
    assert shares == sorted(shares) and shares[-1] == 1


@pytest.mark.slow
def test_the_end_poses_limit_a_scale_exactly() -> None:
    """A round robot beside a disc, at its start: free up to the contact, and no farther."""
    scene = Scene(stadium("1/4", "3/4"), [Curved.circle((3, 0), 1)], start=(0, 0, 0), goal=(0, 9, 0))
    assert is_within(max_scale(scene, tolerance=2.0**-12), 2, 2.0**-12)
    assert max_margin(scene, tolerance=2.0**-12).exact == 1


@pytest.mark.slow
def test_the_largest_scale_of_a_robot_that_lies_on_the_floor_about_its_contact() -> None:
    """At each scale it touches the floor; the ceiling of 2 limits it."""
    lying = Curved.circle((0, "1/2"), "1/2")
    scene = Scene(lying, workspace=box(-5, 0, 5, 2)[0], start=(-2, 0, 0), goal=(2, 0, 0))
    found = max_scale(scene, tolerance=0.05)
    assert found.lo <= 2 <= found.hi and found.lo > 1.9 and found.hi < 2.1


def test_the_largest_margin_of_a_disc_between_discs() -> None:
    found = max_margin(hall(disc("0.4")))
    assert found.exact == Fraction(1, 10) and found.lo < found.exact < found.hi == 0.1
    assert str(found.at) == "between obstacle 1, 2 x 2 at (3, 0) and obstacle 2, 2 x 2 at (6, 0) at (4.5, 0)"
    with pytest.raises(ValueError, match="not joined without touching"):
        max_margin(hall(disc("0.6")))


def test_the_largest_margin_of_a_robot_in_contact_is_0() -> None:
    scene = Scene(disc(1), [Curved.circle((0, -1), 1), Curved.circle((3, 5), 1)], start=(0, 1, 0), goal=(0, 5, 0))
    found = max_margin(scene)
    assert found.exact == found.lo == found.hi == 0 and str(found.at).endswith("at the start")


@pytest.mark.slow
@pytest.mark.long
def test_an_interval_that_stays_wide_says_why(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(among_rounds, "WORK", 4_000)
    monkeypatch.setattr(curved, "round_cells", lambda *_: None)
    monkeypatch.setattr(margins, "widest_way", lambda *_: None)
    found = max_scale(hall(disc("0.49")), tolerance=0.0003)
    assert found.lo <= 0.5 / 0.49 <= found.hi and 1.0003 * found.lo < found.hi < 1.1 * found.lo
    assert "round shapes do not decide" in found.undecided and found.undecided in repr(found)
    assert repr(Interval(1.0, 2.0)) == "Interval(lo=1.0, hi=2.0)"
    assert repr(Interval(1.0, 2.0, "too near")) == "Interval(lo=1.0, hi=2.0, undecided='too near')"


@pytest.mark.slow
@pytest.mark.parametrize(
    "robot", [disc("0.55"), stadium(1, "0.55"), Curved(box("-0.3", "-0.3", "0.3", "0.3")[0], grown="0.25")]
)
def test_the_nearest_miss_between_discs(robot: Curved) -> None:
    miss = nearest_miss(hall(robot), tolerance=0.1)
    assert miss is not None and miss.lo <= 0.05 <= miss.hi <= 1.1 * miss.lo and not miss.undecided
    assert miss.exact == Fraction(1, 20)
    (place,) = miss.bottlenecks
    assert 1 in place.obstacles and "obstacle 1, 2 x 2 at (3, 0)" in str(miss)  # found by samples, on one side of it


@pytest.mark.slow
@pytest.mark.long
def test_the_nearest_miss_of_an_open_ring_ends_after_counted_work(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its corners are not rational when it is inset, so that it becomes polygons, whose searches in vain take long."""
    (a, b), (c, d) = ((4 * radius / 5, 3 * radius / 5) for radius in (Fraction(3, 5), Fraction(3, 10)))
    outer, inner = Arc((a, -b), center=(0, 0)), Arc((c, d), center=(0, 0), clockwise=True)
    left, answered = list[int](), Decisions._answered

    def counted(self: Decisions, number: Fraction, scene: Scene) -> bool | None:
        left.append(self._left)
        return answered(self, number, scene)

    monkeypatch.setattr(Decisions, "_answered", counted)
    monkeypatch.setattr(among_rounds, "TOTAL", 20_000)
    monkeypatch.setattr(among_rounds, "PATCHES", 0)  # no bottlenecks
    miss = nearest_miss(hall(Curved([(a, b), outer, (c, -d), inner])))
    assert sum(patches < 0 for patches in left) <= 1  # the second question about one number
    assert miss is not None and 0.001 < miss.lo <= miss.hi < 0.02
    assert "round shapes do not decide" in miss.undecided


@pytest.mark.slow
def test_a_miss_of_nothing_and_one_that_nothing_mends() -> None:
    with pytest.raises(ValueError, match="start and goal are joined"):
        nearest_miss(hall(disc("0.49")))
    with pytest.raises(ValueError, match="start and goal are joined"):
        nearest_miss(hall(disc("0.5")))  # it fits exactly
    shell = Curved(Circle((3, 2), 2), [Circle((3, 2), 1)])
    assert nearest_miss(hall(disc("0.49"), [shell])) is None


@pytest.mark.slow
def test_blockers_are_the_obstacles_without_which_a_path_exists() -> None:
    """Each obstacle of the fence; not the post that stands apart, nor the rounded box that is two polygons."""
    fence = [Curved.circle((x, 0), "0.9") for x in (0, 2, 4, 6)]
    angle = Curved([(1, 1), (2, 1), (2, "1.2"), ("1.2", "1.2"), ("1.2", 2), (1, 2)], grown="0.05")
    scene = hall(stadium("0.2", "0.3"), [angle, *fence])
    found = blockers(scene)
    assert [blocker.obstacle for blocker in found] == [1, 2, 3, 4] and not found.undecided
    for blocker in found:
        assert cfree.verify.answer(_without(scene, blocker.obstacle), blocker.path).verified
    assert blockers(hall(disc("0.3"), [Curved(Circle((3, 2), 2), [Circle((3, 2), 1)])])).undecided == {}
    with pytest.raises(ValueError, match="nothing is in the way"):
        blockers(hall(disc("0.3")))


@pytest.mark.slow
def test_an_obstacle_whose_removal_leaves_the_question_open_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without the plug, which is obstacle 0, the gap is narrower than the disc by 2**-129: cells decide that."""
    monkeypatch.setattr(curved, "PATCHES", 10_000)
    tight = [Curved.circle((x, 0), 1 + Fraction(1, 2**130)) for x in (0, 3)]
    plug = Curved.circle(("1.5", 0), "0.1")
    scene = hall(disc("0.5"), [plug, *tight, box(4, -1, 9, 1)[0]])
    decided = blockers(scene)
    assert not decided.undecided and [blocker.obstacle for blocker in decided] == [1, 2, 3]
    monkeypatch.setattr(curved, "round_cells", lambda *_: None)
    found = blockers(scene)
    assert 0 in found.undecided and [blocker.obstacle for blocker in found] == [1, 2, 3]
    assert "obstacle 0 is undecided" in repr(found)


def test_blockers_are_a_tuple_and_name_the_undecided() -> None:
    found = Blockers((), {3: "polygons do not decide"})
    assert found == () and repr(found) == "(); obstacle 3 is undecided"
    again = pickle.loads(pickle.dumps(found))
    assert again == found and again.undecided == {3: "polygons do not decide"}


RINGS: list[Any] = [
    stadium(2, 1),
    Curved([(0, 0), (4, 0), (4, 2), Arc((2, 4), center=(2, 2)), (0, 4)]),  # one round corner, three sharp ones
    Curved(Circle((0, 0), 5), [Circle((0, 0), 2)]),
    Curved([(-3, 0), (3, 0), Arc((-3, 0), center=(0, 0))]),  # a half disc: its corners are not rational
]


@pytest.mark.parametrize("shape", RINGS)
@pytest.mark.parametrize("by", [Fraction(1, 4), Fraction(1, 2**20), Fraction(3, 4)])
def test_insets_are_those_of_the_round_shape(shape: Curved, by: Fraction) -> None:
    def region(shapes: Any, outward: bool) -> Any:
        for shape in shapes:
            parts = [shape] if isinstance(shape, Polygon) else getattr(shape, "outer" if outward else "inner")(1e-3)
            yield from (part.to_shapely() for part in parts)

    fine = shapely.union_all([part.to_shapely() for part in shape.inner(1e-5)])
    expected = fine.buffer(-float(by), quad_segs=64)
    for outward in (True, False):
        found = shapely.union_all([*region(inset_shapes([shape], by, 1e-3, outward=outward), outward)])
        assert shapely.hausdorff_distance(found.boundary, expected.boundary) < 5e-3
        assert found.area > expected.area - 1e-4 if outward else found.area < expected.area + 1e-4


def test_smooth_rings_and_rational_corners_stay_round() -> None:
    assert all(
        isinstance(part, Curved)
        for shape in RINGS[:3]
        for part in inset_shapes([shape], Fraction(1, 4), 1, outward=True)
    )
    assert inset_shapes([stadium(2, 1)], Fraction(1), 0.1, outward=True) == []
    (core,) = inset_shapes([Curved(box(0, 0, 2, 2)[0], grown=1)], Fraction(1), 0.1, outward=True)
    assert isinstance(core, Polygon) and core.exact_area == 4


def test_what_takes_polygons_only_still_refuses_round_shapes() -> None:
    with pytest.raises(cfree.UnsupportedError, match="obstacle 0: not bounded by lines and arcs"):
        boundary(Scene(disc("0.4"), [Curved.ellipse((3, 0), (1, 2))]))
    assert math.isinf(max_scale(Scene(disc(1), start=(0, 0, 0), goal=(1, 0, 0))).hi)


def test_no_smaller_robot_is_found_where_no_polygon_is_inside_the_robot() -> None:
    low, high = (Arc((1, 0), through=("1/2", "-10001/100000")), Arc((0, 0), through=("1/2", "-10000/100000")))
    wall = [(4, -9), (5, -9), (5, 9), (4, 9)]
    with pytest.raises(cfree.UndecidedError, match="no polygon is inside"):
        cfree.nearest_miss(Scene(Curved([(0, 0), low, high]), [wall], bounds=(-9, -9, 9, 9)), (0, 0, 0), (7, 0, 0))


def test_a_margin_of_a_gap_that_is_just_closed_is_refused() -> None:
    walls = [[(0, "0.995"), (6, "0.995"), (6, 9), (0, 9)], [(0, -9), (6, -9), (6, "-0.995"), (0, "-0.995")]]
    room = [(-9, -9), (14, -9), (14, 9), (-9, 9)]
    scene = Scene(Curved.circle((0, 0), 1), walls, workspace=room, start=(-3, 0, 0), goal=(9, 0, 0))
    with pytest.raises(ValueError, match="not joined without touching"):
        cfree.max_margin(scene)
