"""What is drawn of surfaces and boundaries in figures 7 to 9, 12, 13, 17, 18 and 20 is true."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest
import shapely
from matplotlib.colors import rgb_to_hsv, to_hex, to_rgb
from matplotlib.patches import PathPatch
from mpl_toolkits.mplot3d import proj3d
from mpl_toolkits.mplot3d.art3d import Text3D

from cfree import Polygon, Pose, palette
from cfree.contact import EdgeVertex, Surface, VertexEdge, angle_range, contact_surface, contacts
from cfree.figures import depth, pillars, plane, scenes, surfaces
from cfree.figures.space import seen
from cfree.forbidden.boundary import boundary
from cfree.geometry import patch_classes
from cfree.plot.depth_sort import Painting
from cfree.plot.pieces import CURVE, SURFACE
from cfree.scene.scene import Scene
from drawn import faces, figure, outlines, strokes

A, O = surfaces.TRIANGLE, surfaces.OTHER


@pytest.mark.parametrize(
    ("number", "contact", "colour"),
    [(7, VertexEdge(1, 0), palette.VERTEX_EDGE), (8, EdgeVertex(0, 1), palette.EDGE_VERTEX)],
)
def test_figures_7_and_8_draw_a_surface_its_helices_and_its_rulings(number: int, contact: Any, colour: str) -> None:
    S, Phi = contact_surface(A, O, contact), angle_range(A, O, contact)
    found = faces(number)
    corners = found.corners.reshape(-1, 3)
    t = on_surface(S, corners)
    assert t.min() == pytest.approx(0, abs=1e-9) and t.max() == pytest.approx(1)
    assert corners[:, 2].min() == 0 and corners[:, 2].max() == pytest.approx(360)
    # in full colour where there is contact, and only there
    inside = np.mod(np.radians(found.corners[..., 2].mean(axis=1)) - Phi.phi_min, math.tau) < Phi.phi_range
    saturation = np.ptp(found.rgb, axis=1) / found.rgb.max(axis=1)
    assert saturation[inside].min() > saturation[~inside].max() + 0.2
    assert np.corrcoef(found.rgb[inside].mean(axis=0), to_rgb(colour))[0, 1] > 0.95
    # helices: t is constant along each, and they go all the way up
    black = strokes(number, palette.INK)
    ends = on_surface(S, black.reshape(-1, 3)).reshape(-1, 2)
    assert ends[:, 0] == pytest.approx(ends[:, 1], abs=1e-9)
    assert np.unique(ends.round(9)).tolist() == [0, 0.25, 0.5, 0.75, 1]
    assert np.ptp(black[..., 2], axis=1).sum() == pytest.approx(5 * 360)
    # rulings: level, as long as the edge; those of phi_min and phi_max once more
    yellow = strokes(number, palette.EDGE_EDGE)
    edge = math.hypot(*S.ruled[2:4], *S.ruled[6:8])
    assert np.ptp(yellow[..., 2], axis=1).max() < 1e-9
    assert np.hypot(*(yellow[:, 1] - yellow[:, 0])[:, :2].T).sum() == pytest.approx(27 * edge)
    on_surface(S, yellow.reshape(-1, 3))
    levels = np.degrees(np.mod([Phi.phi_min, Phi.phi_max], math.tau))
    assert all(np.abs(yellow[..., 2] - level).min() < 1e-9 for level in levels)


def on_surface(S: Surface, points: np.ndarray) -> np.ndarray:
    """t of points (n, 3) that are on a surface, theta in degrees."""
    phi = np.radians(points[:, 2])
    start, stop = S(0, phi)[:, :2], S(1, phi)[:, :2]
    along = stop - start
    t = ((points[:, :2] - start) * along).sum(axis=1) / (along * along).sum(axis=1)
    assert np.abs(start + t[:, None] * along - points[:, :2]).max() < 1e-9
    return t


@pytest.mark.slow
@pytest.mark.parametrize("k", [0, 2])
def test_figure_9_draws_all_patches_helices_and_segments_of_two_triangles(k: int) -> None:
    # each curve is painted with both patches beside it
    yellow = strokes(9, palette.EDGE_EDGE, k)
    lengths = np.add.outer(*(np.hypot(*shape.edges.T) for shape in (A, O)))
    assert np.hypot(*(yellow[:, 1] - yellow[:, 0])[:, :2].T).sum() == pytest.approx(2 * lengths.sum())
    heights = np.ptp(strokes(9, palette.HELIX, k)[..., 2], axis=1).sum()
    angles = np.add.outer(A.interior_angles, O.interior_angles)
    assert heights == pytest.approx(2 * np.degrees(2 * math.pi - angles).sum())
    # the robot touches the obstacle at the middle of every face
    for x, y, degrees in faces(9, k).corners[::40].mean(axis=1):
        placed = shapely.Polygon(plane.placed(A.vertices, (x, y, math.radians(degrees))))
        assert placed.distance(O.to_shapely()) < 0.01 and placed.intersection(O.to_shapely()).area < 0.01


def test_figure_9_names_the_patches_that_are_seen() -> None:
    named: set[str] = set()
    for k in (0, 2):
        ax = figure(9).axes[k]
        eye = np.array([math.cos(math.radians(ax.azim)), math.sin(math.radians(ax.azim))])
        for text in [text for text in ax.texts if "-$" in text.get_text()]:
            kind, i, j = re.findall(r"\$(\w)_(\d)\$-\$\w_(\d)\$", text.get_text())[0]
            contact = (VertexEdge if kind == "v" else EdgeVertex)(int(i) - 1, int(j) - 1)
            point = np.array([text.get_position_3d()])
            t, phi = on_surface(contact_surface(A, O, contact), point)[0], math.radians(point[0, 2])
            Phi = angle_range(A, O, contact)
            assert 0.2 < t < 0.8 and 0.2 < ((phi - Phi.phi_min) % math.tau) / Phi.phi_range < 0.8
            # the side of the pillar that is turned to the camera
            assert (point[0, :2] - np.mean([pillars.WINDOW[:2], pillars.WINDOW[2:]], axis=0)) @ eye > -0.2
            named.add(text.get_text())
    assert len(named) >= 9 and len(contacts(A, O)) == 18
    drawn = figure(9).axes[1]
    assert outlines(drawn, palette.ROBOT)[0] == pytest.approx(A.vertices)
    assert np.diff(outlines(drawn, palette.OBSTACLE)[0], axis=0) == pytest.approx(np.diff(O.vertices, axis=0))


def test_figure_12_draws_five_obstacles_and_both_poses() -> None:
    plan, space = figure(12).axes
    drawn = outlines(plan, palette.OBSTACLE)
    assert len(drawn) == 5
    for corners, obstacle in zip(drawn, scenes.FIVE.obstacles, strict=True):
        assert corners == pytest.approx(obstacle.vertices)
    for corners, pose in zip(outlines(plan, palette.ROBOT), (scenes.FIVE.start, scenes.FIVE.goal), strict=True):
        assert pose is not None and corners == pytest.approx(pose.apply(scenes.FIVE.robot[0].vertices))
    assert space.get_zlim() == (0, 360) and len(strokes(12, palette.HELIX, 1)) > 100


@pytest.mark.slow
def test_figure_12_shows_where_the_pillars_of_two_obstacles_meet() -> None:
    found, (_, space) = scenes.five_boundary(), figure(12).axes
    (painting,) = [c for c in space.collections if isinstance(c, Painting)]
    owner = found.features.obstacles.owner_polygon[found.contact_obstacle]
    corners = []
    for degrees in range(5, 360, 15):
        cut = found.slice(f"{degrees}deg")
        of, starts = owner[cut.patches], {tuple(p): k for k, (p, _) in enumerate(cut.segments.tolist())}
        for k, (_, end) in enumerate(cut.segments.tolist()):
            after = starts.get(tuple(end))
            if after is not None and {int(of[k]), int(of[after])} == {2, 3}:
                corners.append((*end, math.radians(degrees)))
    # two on each level, on both sides of the pillars; a little above the crease, which is drawn with flat faces
    azimuth = math.radians(space.azim)
    above = np.array(corners) + 0.12 * np.array([math.cos(azimuth), math.sin(azimuth), 0.3])
    assert len(corners) > 12 and seen(space, painting, above).mean() > 0.3


def test_figure_13_draws_slices_at_equal_steps() -> None:
    stack, _ = figure(13).axes
    heights = [c._pieces.corners[..., 2] for c in stack.collections if isinstance(c, Painting)]
    levels = [float(z.min()) for z in heights]
    assert all(np.ptp(z) == 0 for z in heights) and levels == pytest.approx(np.linspace(0, 360, scenes.SLICES).tolist())


def test_slices_are_drawn_at_their_height_with_closed_rims() -> None:
    found = boundary(Scene(robot=A, obstacles=O), threads=1)
    inside, *rim = scenes.slice_pieces(found, 70.0)
    assert (inside.sort == SURFACE).all() and len(rim) == 6  # a hexagon
    points = np.concatenate([part.corners for part in rim])
    assert (points[..., 2] == 70).all() and all((part.sort == CURVE).all() for part in rim)
    assert np.abs((points[:, 1] - points[:, 0]).sum(axis=0)).max() < 1e-12
    cut = found.slice("70deg")
    p, q, r = (inside.corners[:, k, :2] for k in range(3))
    areas = 0.5 * ((q - p)[:, 0] * (r - p)[:, 1] - (q - p)[:, 1] * (r - p)[:, 0])
    assert areas.sum() == pytest.approx(cut.forbidden.area)


def test_figure_17_unrolls_the_patch_it_draws() -> None:
    contact = VertexEdge(1, 0)
    S, Phi = contact_surface(A, O, contact), angle_range(A, O, contact)
    on_surface(S, faces(17).corners.reshape(-1, 3))
    levels = np.radians(faces(17).corners[..., 2])
    assert (levels.min(), levels.max()) == pytest.approx((Phi.phi_min, Phi.phi_max))
    flat = figure(17).axes[1]
    # half of the faces: the sheet has two sides
    p = faces(17).corners * (1, 1, math.pi / 180)
    area = 0.25 * np.linalg.norm(np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1]), axis=1).sum()
    (patch,) = [shapely.Polygon(polygon.get_xy()) for polygon in flat.patches if polygon.get_fill()]
    assert patch.area == pytest.approx(area, rel=1e-3)


@pytest.mark.parametrize(("k", "robot", "sizes"), [(2, pillars.REGULAR, [16, 16]), (3, pillars.KITE, [4, 4, 8, 8, 8])])
def test_figure_18_gives_each_class_of_congruent_patches_a_colour(k: int, robot: Polygon, sizes: list[int]) -> None:
    classes, found = patch_classes(robot, pillars.REGULAR), faces(18, k)
    assert sorted(len(members) for members in classes) == sizes
    hues = {}
    for members in classes:
        for contact in members:
            S, Phi = contact_surface(robot, pillars.REGULAR, contact), angle_range(robot, pillars.REGULAR, contact)
            middle = S(0.5, Phi.phi_min + 0.45 * Phi.phi_range) * (1, 1, 180 / math.pi)
            middle[2] %= 360
            nearest = np.linalg.norm((found.corners.mean(axis=1) - middle) * (1, 1, 0.01), axis=1).argmin()
            hues.setdefault(members, set()).add(round(float(rgb_to_hsv(found.rgb[nearest])[0]), 1))
    assert all(len(of_one) == 1 for of_one in hues.values())
    legend = figure(18).axes[k].get_legend()
    shades = {to_hex(handle.get_facecolor()) for handle in legend.legend_handles}
    named = sorted(int(text.get_text().split()[2]) for text in legend.get_texts())
    assert len(shades) == len(classes) and named == sizes


def test_figure_20_counts_the_obstacles_that_are_overlapped() -> None:
    ax = figure(20).axes[1]
    turned = Pose(0, 0, depth.THETA).apply(depth.THREE.robot[0].vertices)
    names = [text.get_text() for text in ax.get_legend().get_texts()]
    shades = [to_hex(handle.get_facecolor()) for handle in ax.get_legend().legend_handles]
    of = dict(zip(shades, map(int, names), strict=True))
    regions = [patch for patch in ax.patches if isinstance(patch, PathPatch)]
    depths = set()
    for patch in regions:
        rings = [shapely.Polygon(ring) for ring in patch.get_path().to_polygons()]
        point = rings[0].difference(shapely.union_all(rings[1:])).representative_point()
        placed = shapely.Polygon(turned + np.array([point.x, point.y]))
        overlapped = sum(placed.intersection(body.to_shapely()).area > 0 for body in depth.THREE.obstacles)
        assert of[to_hex(patch.get_facecolor())] == overlapped
        depths.add(overlapped)
    assert {1, 2, 3} <= depths and len(regions) >= 7


@pytest.mark.parametrize(("number", "k"), [(9, 0), (9, 2), (12, 1)])
def test_theta_stands_at_the_left_and_grows_upwards_from_wherever_it_is_seen(number: int, k: int) -> None:
    ax = figure(number).axes[k]
    ax.M = ax.get_proj()
    texts = [text for text in ax.texts if isinstance(text, Text3D)]
    at = {text.get_text(): proj3d.proj_transform(*text.get_position_3d(), ax.M)[:2] for text in texts}
    turns = [at[name][1] for name in (r"$\pi/2$", r"$\pi$", r"$3\pi/2$", r"$2\pi$")]
    assert turns == sorted(turns)
    assert at[r"$\theta$"][0] < min(x for name, (x, _) in at.items() if name != r"$\theta$")
