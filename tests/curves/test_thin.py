"""Thin and flat round shapes: their polygons are around them, or inside, and no verdict is wrong."""

import itertools
from fractions import Fraction
from typing import Any

import pytest

import cfree
import cfree.verify
from cfree import Pose
from cfree.curves import Arc, Bezier, Circle, Ellipse
from cfree.curves.hulls import Outline, polygon_of
from cfree.curves.pieces import exact_of, is_proved
from cfree.curves.rings import exact_ring
from cfree.planning import curved
from cfree.verify.curves import mismatches
from fuzz_thin import faults

SQUARE = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
PROBE = [(0, 0), (1, 1), (-1, 1)]
THIN = [Fraction(1, 2**k) for k in (5, 12, 20, 34, 52, 60, 80)]


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(40))
def test_no_point_of_a_rim_is_on_the_wrong_side(seed: int) -> None:
    counted, wrong = faults(seed)
    assert wrong == [] and sum(counted.values()) > 10


@pytest.mark.parametrize("thin", THIN)
def test_a_thin_ellipse_stays_as_thin_as_it_is(thin: Fraction) -> None:
    shape = cfree.Curved.ellipse((0, 0), (1, thin))
    (around,), (within,) = shape.outer(0.01), shape.inner(0.01)
    area = 3.14159265 * float(thin)
    assert 0.9 * area < float(within.exact_area) < area < float(around.exact_area) < 1.1 * area
    scene = cfree.Scene(SQUARE, [shape])
    assert cfree.is_free(scene, Pose(0, 1 + 2 * thin)) and not cfree.is_free(scene, Pose(0, 1 + thin / 2))


@pytest.mark.parametrize("thin", THIN)
def test_a_square_that_fits_between_thin_things_gets_through(thin: Fraction) -> None:
    """Inside of them was larger than they are: then there was "no path at all"."""
    walls = [cfree.Curved.ellipse((0, k * (1 + 3 * thin)), (3, thin)) for k in (-1, 1)]
    scene = cfree.Scene(SQUARE, walls, start=(-6, 0, 0), goal=(6, 0, 0), bounds=(-7, -1, 7, 1))
    path = cfree.plan(scene, improve=0.0)
    assert isinstance(path, cfree.Path) and cfree.verify.answer(scene, path).verified


@pytest.mark.parametrize("part", ["hole", "workspace"])
@pytest.mark.parametrize("thin", THIN)
def test_a_robot_too_high_for_its_hole_is_not_free(thin: Fraction, part: str) -> None:
    ring = Ellipse((0, 0), (4, thin))
    shape = cfree.Curved([(-5, -5), (5, -5), (5, 5), (-5, 5)], [ring]) if part == "hole" else cfree.Curved(ring)
    robot = [(0, 0), (1, 0), (0, 100 * thin)]
    scene = cfree.Scene(robot, [shape]) if part == "hole" else cfree.Scene(robot, workspace=shape)
    assert cfree.is_free(scene, Pose(0, 0)) is False
    with pytest.raises(cfree.InvalidPoseError, match="start"):
        cfree.plan(scene, (0, 0, 0), (1, 0, 0))


@pytest.mark.parametrize("bulge", [Fraction(1, 2**k) for k in (9, 30, 45, 52, 60, 70)])
@pytest.mark.parametrize("kind", ["arc", "cubic"])
def test_a_nearly_straight_curve_is_not_its_chord(bulge: Fraction, kind: str) -> None:
    """It bulges into a square that stands on its chord."""
    curve: Any = Arc((0, 0), through=(1, bulge))
    if kind == "cubic":
        curve = Bezier([(Fraction(4, 3), bulge), (Fraction(2, 3), bulge), (0, 0)])
    floor = cfree.Curved([(0, 0), (0, -1), (2, -1), (2, 0), curve])
    scene = cfree.Scene([(0, 0), (1, 0), (1, 1), (0, 1)], [floor])
    assert cfree.is_free(scene, Pose("1/2", 0)) is not True
    assert cfree.is_free(scene, Pose("1/2", "1/100")) is True
    for error, outward in itertools.product((0.1, 1e-4), (True, False)):
        polygons = scene.outer(error) if outward else scene.inner(error)
        assert list(mismatches(scene, polygons, outward=outward)) == []


@pytest.mark.parametrize("thin", THIN)
def test_a_thin_lens_turned_by_a_rational_is_a_shape(thin: Fraction) -> None:
    def at(x: Fraction | int, y: Fraction | int) -> tuple[Fraction, Fraction]:
        return Fraction(4, 5) * x - Fraction(3, 5) * y, Fraction(3, 5) * x + Fraction(4, 5) * y  # tau = 1/3

    lens = cfree.Curved([at(1, 0), Arc(at(-1, 0), through=at(0, thin)), Arc(at(1, 0), through=at(0, -thin))])
    assert lens.outer(0.01) and lens.inner(0.01)
    scene = cfree.Scene([at(0, 0), at(1, 1), at(-1, 1)], [lens])
    assert cfree.is_free(scene, Pose(*at(0, 2 * thin))) is True
    assert cfree.is_free(scene, Pose(*at(0, thin / 2))) is False


def moon(thin: object) -> cfree.Curved:
    return cfree.Curved([(1, 0), Arc((-1, 0), through=(0, 1)), Arc((1, 0), through=(0, 1 + Fraction(thin)))])  # type: ignore[arg-type]


def test_what_is_too_thin_for_doubles_is_undecided_with_the_reason() -> None:
    thin = moon("1e-12")
    assert thin.inner(0.01) == () and thin.outer(0.01)
    assert moon("1e-3").inner(0.01)
    arcs = cfree.Scene(thin, [PROBE])  # decided without polygons
    assert cfree.is_free(arcs, Pose(0, 0)) is False
    ellipse = cfree.Curved.ellipse((50, 50), (1, 2))
    scene = cfree.Scene(thin, [PROBE, ellipse], start=(0, 0, 0), goal=(9, 0, 0))
    assert cfree.is_free(scene, Pose(0, 0)) is None and cfree.is_free(scene, Pose(9, 0)) is True
    with pytest.raises(cfree.UndecidedError, match="no polygon inside the robot can be proved: it is too thin"):
        cfree.plan(scene)
    inside = cfree.Scene([(0, 0), ("1e-15", 0), (0, "1e-15")], workspace=thin)
    assert cfree.is_free(inside, Pose(0, "1.0000000000005")) is True and cfree.is_free(inside, Pose(0, 0)) is False


def test_an_obstacle_too_thin_for_doubles_is_left_out_inside_and_the_answer_is_verified() -> None:
    pillars = [cfree.Curved.circle((x, 0), 1) for x in (-3, 0, 3)]
    hall = [(-3, -4), (3, -4), (3, 4), (-3, 4)]
    arch = cfree.Curved([(4, 0), Arc((2, 0), through=(3, 1)), Arc((4, 0), through=(3, 1 + Fraction(1, 10**12)))])
    scene = cfree.Scene(
        cfree.Curved.circle((0, 0), "0.51"), [arch, *pillars], workspace=hall, start=(0, 3, 0), goal=(0, -3, 0)
    )
    proof = cfree.plan(scene)
    assert isinstance(proof, cfree.Separated) and cfree.verify.answer(scene, proof).verified


def test_a_hole_too_thin_for_doubles_is_filled_outside() -> None:
    slit = [(1, 0), Arc((-1, 0), through=(0, 1)), Arc((1, 0), through=(0, 1 + Fraction(1, 10**12)))]
    plate = cfree.Curved([(-3, -3), (3, -3), (3, 3), (-3, 3)], [slit, Circle((0, -1), "1/2")])
    scene = cfree.Scene([(0, 0), (1, 0), (0, 1)], [plate])
    assert [len(polygon.exact_rings) for polygon in (*plate.outer(0.01), *plate.inner(0.01))] == [2, 3]
    for polygons, outward in ((scene.outer(0.01), True), (scene.inner(0.01), False)):
        assert list(mismatches(scene, polygons, outward=outward)) == []
    assert cfree.is_free(scene, Pose(0, -1)) is False


def test_the_box_is_that_of_the_curve() -> None:
    flat = cfree.Curved([(0, 0), (0, -1), (2, -1), (2, 0), Arc((0, 0), through=(1, Fraction(1, 10**6)))])
    assert flat.box == (0, -1, 2, Fraction(1, 10**6)) and flat.size == 2
    far = cfree.Scene([(0, 0), (1, 0), (0, 1)], [flat])
    assert cfree.is_free(far, Pose(3, 0)) is True
    quarter = cfree.Curved([(1, 0), Arc((0, 1), center=(0, 0)), (0, 0)])
    assert quarter.box == (0, 0, 1, 1)
    slanted = cfree.Curved([(3, 1), Arc((1, 2), center=(0, 0), conjugate=(1, 2)), (0, 0)]).box
    assert slanted[:2] == (0, 0) and all(
        0 <= x - root < 1e-12 for x, root in zip(slanted[2:], (10**0.5, 5**0.5), strict=True)
    )
    wave = cfree.Curved([(0, 0), Bezier([(0, 3), (1, 3), (1, 0)])]).box
    assert wave[:3] == (0, 0, 1) and 0 <= wave[3] - Fraction(9, 4) < Fraction(1, 10**5)


def test_a_polygon_that_is_not_around_its_curve_is_refused_by_the_core() -> None:
    circle = exact_ring(Circle((0, 0), 1))
    around, inside = ([(r, r), (-r, r), (-r, -r), (r, -r)] for r in (1, Fraction(7, 10)))
    assert is_proved(cfree.Polygon(around), 0, circle, within=False)
    assert is_proved(cfree.Polygon(inside), 0, circle, within=True)
    assert not is_proved(cfree.Polygon(inside), 0, circle, within=False)
    assert not is_proved(cfree.Polygon(around), 0, circle, within=True)
    beside = [(x + 5, y) for x, y in inside]
    assert not is_proved(cfree.Polygon(beside), 0, circle, within=True)
    by = Fraction(1, 2**90)
    cut = [(1 - by, 1), (-1, 1), (-1, -1), (1 - by, -1)]
    assert not is_proved(cfree.Polygon(cut), 0, circle, within=False)
    open_curve = circle[:0] + exact_ring(((Fraction(1), Fraction(0)), Arc((0, 1), center=(0, 0))))[:1]
    assert not is_proved(cfree.Polygon(around), 0, open_curve, within=False)


def test_outlines_in_doubles_are_proved_as_well() -> None:
    from cfree.curves.drawn import Arc as DrawnArc
    from cfree.curves.drawn import arc_of_circle

    for thin in (1e-3, 1e-6, 1e-9, 1e-12):
        ring: list[Any] = [DrawnArc((5.0, 3.0), (2.0, 1.0), (-thin, 2 * thin), 0.0, 6.283185307179586)]
        curve = exact_of(ring)
        for inside in (False, True):
            polygon = polygon_of(Outline(ring), 0.01, inside)
            assert is_proved(polygon, 0, curve, within=inside)
    whole = polygon_of(Outline([arc_of_circle((0, 0), 1)]), 0.1, True)
    assert len(whole) < 20


@pytest.mark.slow
def test_a_question_that_only_a_touch_decides_ends_and_more_is_asked_for_by_seconds_or_tolerance(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(curved, "PATCHES", 5000)
    walls = [cfree.Curved.circle((0, y), 1) for y in (-2, 2)]
    walls.append(cfree.Curved.ellipse((50, 50), (2, 1)))  # with it the polygons decide
    scene = cfree.Scene(cfree.Curved.circle((0, 0), 1), walls, bounds=(-4, -4, 4, 4), start=(-3, 0, 0), goal=(3, 0, 0))
    with pytest.raises(cfree.UndecidedError, match="contact patches were not enough; give max_seconds") as caught:
        cfree.plan(scene)
    assert 0 < caught.value.error < 0.01
    with pytest.raises(cfree.UndecidedError, match="1 seconds were not enough; give more"):
        cfree.plan(scene, max_seconds=1)
    with pytest.raises(cfree.UndecidedError, match="these touch, or all but do"):
        cfree.plan(scene, tolerance=0.004)


@pytest.mark.slow
def test_a_clearance_at_the_threshold_ends_with_its_interval() -> None:
    walls = [cfree.Curved.circle((0, y), 1) for y in (-3, 3)]
    walls.append(cfree.Curved.ellipse((50, 50), (2, 1)))  # with it the polygons decide
    scene = cfree.Scene(cfree.Curved.circle((0, 0), 1), walls, bounds=(-4, -2, 4, 2), start=(-3, 0, 0), goal=(3, 0, 0))
    with pytest.raises(cfree.UndecidedError, match="the largest clearance that a path keeps is between") as caught:
        cfree.plan(scene, clearance=1, tolerance=0.01)
    assert 0.9 < caught.value.lo <= 1 <= caught.value.hi < 1.1
