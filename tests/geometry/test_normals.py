"""The degree of the Gauss map: half of Euler's number, unless what is glued does not belong together."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import cfree.verify
import shapes
from cfree.errors import IncompleteError, UnsupportedError
from cfree.forbidden.boundary import Boundary, boundary
from cfree.formats.scene_file import load_scene
from cfree.geometry import gauss_bonnet, gauss_map
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene
from examples import FOLDER, POLYGONS
from regluing import exchanged, reglued

CASES = Path(__file__).parents[1] / "cases"


def made(name: str) -> Boundary:
    return boundary(load_scene(FOLDER / f"{name}.json"), threads=1)


def radius(result: Boundary) -> float:
    return float(np.hypot(*result.features.robot.xy.T).max())


LARGE = ("benchmr_warehouse", "nest_swim", "street_Berlin")
PATHS = [pytest.param(path, marks=[pytest.mark.long] if path.stem in LARGE else []) for path in POLYGONS]


@pytest.mark.slow
@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_degree_is_half_the_euler_number_on_all_example_scenes(path: Path) -> None:
    result = boundary(load_scene(path), threads=1)
    found = gauss_map(result, angle_scale=radius(result))
    np.testing.assert_allclose(2 * found.degree, result.complex.euler, atol=1e-6)
    assert found.error.max(initial=0.0) < 1e-4


@pytest.mark.parametrize("name", ["symmetry/square_that_just_turns", "fits/bar_in_open_corridor"])
def test_vertices_whose_normals_are_all_around(name: str) -> None:
    result = boundary(load_scene(CASES / f"{name}.json"), threads=1)  # tips of spikes; saddles
    found = gauss_map(result, angle_scale=radius(result))
    np.testing.assert_allclose(2 * found.degree, result.complex.euler, atol=1e-9)


def test_edges_too_short_for_doubles_leave_the_degree_open() -> None:
    chain = boundary(load_scene(CASES / "meshes" / "nearly_collinear_chain.json"), threads=1)
    assert gauss_map(chain).error.tolist() == [math.inf] * chain.complex.components
    found = cfree.verify.boundary(chain, slices=0, deep=True)
    assert found.verified and "doubles leave degrees open" in found.checks[-1].extent
    fingerprint = boundary(load_scene(CASES / "crossings" / "one_fingerprint.json"), threads=1)
    with pytest.raises(UnsupportedError, match="no length in doubles"):
        gauss_map(fingerprint)


@pytest.mark.slow
@pytest.mark.parametrize("folder", ["fits", "tangencies", "flats", "bounds", "symmetry", "chains"])
def test_degree_is_half_the_euler_number_where_much_is_degenerate(folder: str) -> None:
    for path in sorted((CASES / folder).glob("*.json")):
        result = boundary(load_scene(path), threads=1)
        found = gauss_map(result, angle_scale=radius(result))
        np.testing.assert_allclose(2 * found.degree, result.complex.euler, atol=1e-6, err_msg=path.stem)


def swept(result: Boundary, surface: int) -> float:
    """How many radians of orientation a closed surface has."""
    of = result.complex.component == surface
    table = result.trapezoids
    total, reached = 0.0, -math.inf
    for start, stop in sorted(zip(table.theta_from[of].tolist(), table.theta_to[of].tolist(), strict=True)):
        total += max(0.0, stop - max(start, reached))
        reached = max(reached, stop)
    return total


def test_degree_of_surfaces_that_wrap_around_theta() -> None:
    # a torus around one obstacle, one around the circle of orientations, and a surface of genus 24 that goes round
    for name, euler in (("paper_fig9", [0, 0]), ("degenerate_no_obstacles", [0]), ("five_convex", [-46])):
        result = made(name)
        for surface in range(len(euler)):
            assert swept(result, surface) == pytest.approx(math.tau)
        np.testing.assert_allclose(gauss_map(result).degree, np.array(euler) / 2, atol=1e-9)


def test_degree_of_surfaces_that_do_not_wrap_around_theta() -> None:
    result = made("sofa_corner")  # four balls, and the torus around everything
    found = gauss_map(result)
    np.testing.assert_allclose(np.sort(found.degree), [0, 1, 1, 1, 1], atol=1e-9)
    for surface in np.flatnonzero(found.degree > 0.5):
        assert swept(result, int(surface)) < 2


@pytest.mark.slow
@pytest.mark.parametrize("kind", shapes.KINDS)
def test_degrees_are_the_same_in_every_metric_and_areas_are_not(kind: str) -> None:
    for seed in range(3):
        plain = shapes.random_scene(seed, kind)
        robot, obstacles = ([Polygon(*shape) for shape in side] for side in (plain.robot, plain.obstacles))
        workspace = Polygon(*plain.workspace) if plain.workspace else None
        result = boundary(Scene(robot=robot, obstacles=obstacles, bounds=plain.bounds, workspace=workspace), threads=1)
        small, large = (gauss_map(result, angle_scale=w) for w in (0.5, 4.0))
        if (
            max(small.error.max(), large.error.max()) > 0.1
        ):  # regular up to rounding: doubles cannot tell, and it is said
            assert kind == "regular"
            continue
        np.testing.assert_allclose(2 * small.degree, result.complex.euler, atol=1e-6)
        np.testing.assert_allclose(small.degree, large.degree, atol=1e-6)
        assert not np.allclose(small.faces, large.faces)


def test_areas_at_edges_and_vertices_are_the_curvature_there() -> None:
    # of a gluing that is right: term by term, by other formulas
    result = made("five_convex")
    cells, found, sums = result.complex, gauss_map(result), gauss_bonnet(result)
    np.testing.assert_allclose(found.edges, (sums.sides + sums.sides[cells.twin]) / 2, atol=1e-7)
    assert len(found.vertices) == cells.vertices
    np.testing.assert_allclose(np.sort(found.vertices), np.sort(sums.vertices), atol=1e-7)


def test_sheets_at_a_pinched_edge_may_be_glued_across_free_or_forbidden_space_and_not_otherwise() -> None:
    result = boundary(load_scene(CASES / "tangencies" / "pinch_at_one_angle.json"), threads=1)
    cells = result.complex
    assert len(cells.pinched)
    np.testing.assert_allclose(2 * gauss_map(result).degree, cells.euler, atol=1e-9)
    for edge in cells.pinched.tolist():
        around = cells.at_edge(edge).tolist()
        first = around[0]
        off = []
        for other in set(around) - {first, int(cells.twin[first])}:
            wrong = reglued(cells, exchanged(cells, first, other))
            degree = gauss_map(glued_otherwise(result, complex=wrong)).degree
            off.append(round(float(abs(2 * degree - wrong.euler).max()), 6))
        assert sorted(off) == [0, 2]  # the third way pairs sheets that run the same way
        glued_otherwise(result, complex=cells)


def glued_otherwise(result: Boundary, **columns: object) -> Boundary:
    for name, values in columns.items():
        result.__dict__[name] = values
    return result


@pytest.mark.parametrize("name", ["paper_fig9", "five_convex", "degenerate_workspace", "comb_hook"])
def test_wrong_partners_change_the_degree_and_not_the_sum_of_curvature(name: str) -> None:
    result = made(name)
    cells, rng = result.complex, np.random.default_rng(7)
    tries, seen = 12, 0
    for _ in range(tries):
        h, other = map(int, rng.choice(len(cells.twin), 2, replace=False))
        wrong = reglued(cells, exchanged(cells, h, other))
        broken = glued_otherwise(result, complex=wrong)
        np.testing.assert_allclose(gauss_bonnet(broken).euler, wrong.euler, atol=1e-7)  # "agrees"
        seen += bool(abs(2 * gauss_map(broken).degree - wrong.euler).max() > 0.5)
    assert seen > 0.6 * tries  # not all: sides of two surfaces in one place may be exchanged


@pytest.mark.parametrize("name", ["paper_fig9", "five_convex", "degenerate_workspace"])
def test_random_labels_of_vertices_are_seen_by_the_degree_and_not_by_the_sum_of_curvature(name: str) -> None:
    result = made(name)
    cells, rng = result.complex, np.random.default_rng(11)
    if cells.components > 1:  # labels of one surface
        result = boundary(Scene(result.scene.robot, result.scene.obstacles), threads=1)
        cells = result.complex
    assert cells.components == 1
    labels = rng.integers(0, cells.vertices // 2, len(cells.vertex)).astype(np.int32)
    labels[: cells.vertices // 2] = np.arange(cells.vertices // 2)
    wrong = replace(cells, vertex=labels, vertices=cells.vertices // 2)
    broken = glued_otherwise(result, complex=wrong)
    assert wrong.euler != cells.euler
    np.testing.assert_allclose(gauss_bonnet(broken).euler, wrong.euler, atol=1e-7)  # "agrees"
    assert abs(2 * gauss_map(broken).degree - wrong.euler).max() > 0.5


def test_incomplete_boundaries_have_no_degree() -> None:
    stopped = boundary(load_scene(FOLDER / "benchmr_parking1.json"), max_seconds=0)
    if not stopped.complete:
        with pytest.raises(IncompleteError):
            gauss_map(stopped)


def test_the_length_of_a_radian_is_positive() -> None:
    with pytest.raises(ValueError, match="angle_scale"):
        gauss_map(made("paper_fig9"), angle_scale=-1)
