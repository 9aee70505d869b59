"""Boundaries of shapes with concave arcs, against exact tests of poses, chords in shapely, and closed formulas."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import shapely

from arc_rings import BAY, BRACKET, CONCAVE, HALF, plate, random_concave, shape
from cfree import Curved, Polygon, Pose, Scene, UnsupportedError, boundary, free_space, is_free
from cfree.contact import shape_features
from cfree.curves import Arc
from cfree.formats.conversion import as_exact
from cfree.geometry import gauss_bonnet
from cfree.scene.rounded import rounded, rounded_shapes, why_not_rounded

SHAPES = {**{name: shape(ring) for name, ring in CONCAVE.items()}, "plate": plate()}
SQUARE = [("-1/2", "-1/2"), ("1/2", "-1/2"), ("1/2", "1/2"), ("-1/2", "1/2")]


def corners(*points: Any) -> Any:
    return shapely.Polygon([tuple(map(float, p)) for p in points])


@pytest.mark.parametrize("name", SHAPES)
def test_polygon_caps_and_fillets_are_the_shape(name: str) -> None:
    """Their areas add up, and fillets are beside the polygon, within larger triangles."""
    form = rounded(SHAPES[name])
    assert form is not None and any(not arc.is_convex for arc in form.arcs)
    assert isinstance(form.core, Polygon)
    area = float(form.core.area)
    core = form.core.to_shapely()
    for arc in form.arcs:
        half = math.asin(math.dist(*(map(float, p) for p in (arc.start, arc.end))) / 2 / float(arc.radius))
        segment = float(arc.radius) ** 2 * (half - math.sin(half) * math.cos(half))
        if arc.beyond is None:
            area += segment
            continue
        triangle = corners(arc.start, arc.beyond[0], arc.end)
        area += triangle.area - segment
        assert core.intersection(triangle).area < 1e-9
        assert corners(arc.start, arc.beyond[1], arc.end).covers(triangle)
    assert math.isclose(area, shape_features(SHAPES[name]).area, rel_tol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(15))
def test_cells_and_slices_of_random_scenes(seed: int) -> None:
    scene, rng = random_concave(seed), random.Random(seed)
    found = boundary(scene)
    space = free_space(found)
    assert np.all(found.complex.euler % 2 == 0)
    theta = rng.uniform(0, math.tau)
    cut = found.slice(theta)
    starts, ends = cut.segments[:, 0], cut.segments[:, 1]
    assert max(np.min(np.hypot(*(starts - end).T)) for end in ends) < 1e-6
    x0, y0, x1, y1 = cut.forbidden.bounds
    for _ in range(150):
        pose = Pose(rng.uniform(x0, x1), rng.uniform(y0, y1), rng.uniform(0, math.tau))
        assert (space.locate(pose) >= 0) == is_free(scene, pose), pose
        x, y = rng.uniform(x0, x1), rng.uniform(y0, y1)
        if shapely.boundary(cut.forbidden).distance(shapely.Point(x, y)) > 2 * cut.error:
            assert is_free(scene, Pose(x, y, theta)) == (not cut.forbidden.contains(shapely.Point(x, y)))


@pytest.mark.slow
def test_curvature_of_closed_surfaces_adds_up() -> None:
    for scene in (Scene(SQUARE, [plate()]), Scene(SQUARE, [shape(BAY)]), Scene([shape(BRACKET)], [SQUARE])):
        found = boundary(scene)
        sums = gauss_bonnet(found)
        assert np.all(abs(sums.euler - found.complex.euler) < 1e-6) and sums.gap < 1e-6
        assert np.any(found.patch_radius[found.trapezoids.patch] < 0) or scene.robot[0] == shape(BRACKET)


@pytest.mark.parametrize("at", [(0, 0), ("1", "1/2")])
def test_a_disc_in_a_round_hole_has_a_round_cell(at: tuple[Any, Any]) -> None:
    found = boundary(Scene(Curved.circle(at, 1), [plate()]))
    assert found.complex.euler.tolist() == [0, 0]
    outside, inside = free_space(found).volumes
    assert outside == math.inf and math.isclose(inside, math.tau * math.pi * 4, rel_tol=1e-9)


@pytest.mark.slow
def test_a_square_in_a_round_hole_is_where_its_corners_are_in_it() -> None:
    found = boundary(Scene(SQUARE, [plate()]))
    x, weight = np.polynomial.legendre.leggauss(40)
    ways = math.sqrt(2) * np.cos(x * math.pi / 4)  # cos + sin, from the middle of a quarter
    reach = -ways / 2 + np.sqrt(ways**2 / 4 - 0.5 + 9)  # to the circle about the farthest corner's place
    area = 4 * float(weight @ reach**2) / 2 * math.pi / 4
    assert math.isclose(free_space(found).volumes[1], math.tau * area, rel_tol=1e-9)
    # a mesh bounds the forbidden space, that is all sums of the two squares but for this cell
    mesh = found.mesh(0.02)
    x, y, z = (mesh.vertices[mesh.triangles[:, k]] for k in range(3))
    normals = np.cross(y - x, z - x) / 2
    volume = ((x + y + z)[:, :2] / 3 * normals[:, :2]).sum() / 2 / mesh.angle_scale
    expected = math.tau * (100 + 1) + 40 * 4 - math.tau * area
    assert abs(volume - expected) < 0.02 * np.hypot(*normals[:, :2].T).sum() / mesh.angle_scale


@pytest.mark.parametrize("radius", [3, "7/2"])
@pytest.mark.parametrize("ring", [BAY, BRACKET])
def test_a_disc_of_the_radius_of_an_arc_or_more_touches_it_nowhere(radius: Any, ring: Any) -> None:
    """Equal radii are an exact fit, a curve without width: the boundary has no patch there."""
    scene = Scene(Curved.circle((0, 0), radius), [shape(ring)])
    found = boundary(scene)
    assert not np.any(found.patch_radius < 0)
    assert found.complex.euler.tolist() == [0]
    hole = boundary(Scene(Curved.circle((0, 0), radius), [plate()]))
    assert len(free_space(hole)) == 1


def test_a_peg_in_a_slot_of_its_own_radius_is_an_exact_fit_without_width() -> None:
    slot = [(-5, -4), (5, -4), (5, 4), (1, 4), (1, 0, (0, 0), "concave"), (-1, 0), (-1, 4), (-5, 4)]
    peg = Curved([(1, 1), Arc((-1, 1), center=(0, 1)), (-1, -1), Arc((1, -1), center=(0, -1))])
    found = boundary(Scene(peg, [shape(slot)]))
    assert np.all(found.complex.euler % 2 == 0)
    wide = boundary(Scene(Curved([(0, -1), (1, -1), (0, 1)], grown="1/8"), [shape(slot)]))
    assert np.any(wide.patch_radius[wide.trapezoids.patch] < 0)


CUSP = Curved([(4, 0), Arc((0, 4), center=(4, 4), clockwise=True), (0, 0)])


def test_what_is_refused_has_its_reason() -> None:
    scene, message = Scene(SQUARE, [CUSP]), "without cusps"
    assert rounded_shapes(scene) is None and message in why_not_rounded(scene)
    with pytest.raises(UnsupportedError, match=message):
        boundary(scene)


def test_concave_arcs_that_are_refused_become_polygons_on_request() -> None:
    made = Scene(shape(HALF, by=Fraction(1, 5)), [CUSP, Curved.circle((0, 0), 1)])
    scene, notes = as_exact(made, 0.05)
    assert len(notes) == 1 and rounded_shapes(scene) is not None
    assert scene.robot == made.robot and scene.obstacles[1] == made.obstacles[1]


def test_arcs_next_to_each_other_are_cut_until_their_triangles_are_apart() -> None:
    """Two bays from both sides, with a thin wall between them."""
    for wall, count in ((Fraction(1, 8), 4), (Fraction(1, 64), 8)):
        top = 2 + wall
        below = [(-4, -4), (-3, -4), Arc((3, -4), center=(0, -4), clockwise=True), (4, -4)]
        above = [(4, top), (3, top), Arc((-3, top), center=(0, top), clockwise=True), (-4, top)]
        form = rounded(Curved([*below, *above]))
        assert form is not None and len(form.arcs) == count


@pytest.mark.slow
def test_walls_thinner_than_arcs_may_be_cut_are_refused() -> None:
    top = 2 + Fraction(1, 2**60)
    below = [(-4, -4), (-3, -4), Arc((3, -4), center=(0, -4), clockwise=True), (4, -4)]
    above = [(4, top), (3, top), Arc((-3, top), center=(0, top), clockwise=True), (-4, top)]
    thin = Scene(SQUARE, [Curved([*below, *above])])
    assert rounded_shapes(thin) is None and " at about (0, -1); move them apart" in why_not_rounded(thin)


@pytest.mark.slow
def test_a_disc_as_wide_as_the_gap_beside_a_hole_does_not_pass_it() -> None:
    """It touches the hole and a disc in it at once, at every orientation: that closes its ring of places."""
    hole = Scene(Curved.circle((0, 0), "1/2"), [plate(), Curved.circle(("3/2", 0), "1/2")])
    found = boundary(hole)
    assert found.complex.euler.tolist() == [0, 0]
    _, inside = free_space(found).volumes
    assert math.isclose(inside, math.tau * math.pi * (2.5**2 - 1), rel_tol=1e-9)
    turned = boundary(Scene(hole.obstacles, hole.robot))
    assert math.isclose(free_space(turned).volumes[1], inside, rel_tol=1e-9)


@pytest.mark.slow
def test_fillets_trim_bounds_as_well() -> None:
    scene = Scene(
        [(0, 0), (1, 0), (0, 1)], [shape(BAY)], bounds=(-2, -2, 8, 8), workspace=[(-9, -9), (9, -9), (9, 9), (-9, 9)]
    )
    space = free_space(boundary(scene))
    rng = random.Random(2)
    for _ in range(200):
        pose = Pose(rng.uniform(-2, 8), rng.uniform(-2, 8), rng.uniform(0, math.tau))
        assert (space.locate(pose) >= 0) == is_free(scene, pose), pose
