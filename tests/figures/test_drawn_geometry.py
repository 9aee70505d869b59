"""What is drawn of the geometry of surfaces in figures 10, 11, 14 to 16 and 19 is true, by finite differences."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from matplotlib.colors import rgb_to_hsv, to_hex, to_rgb

from cfree import palette
from cfree.contact import EdgeVertex, Surface, contact_surface
from cfree.figures import curvature, helices, lines, minimal, scenes
from cfree.forbidden.boundary import boundary
from drawn import axes, faces, figure, outlines, strokes


def shape_at(S: Surface, t: float, phi: float, h: float = 1e-4) -> tuple[np.ndarray, Callable[[np.ndarray], float]]:
    """Unit normal, and the normal curvature in a direction, by finite differences."""
    at = lambda u, v: S(t + u * h, phi + v * h)  # noqa: E731
    first = (at(1, 0) - at(-1, 0)) / (2 * h), (at(0, 1) - at(0, -1)) / (2 * h)
    N = np.cross(*first)
    N /= np.linalg.norm(N)

    def curving(along: np.ndarray) -> float:
        u, v = np.linalg.lstsq(np.column_stack(first), along, rcond=None)[0]
        return float((at(u, v) - 2 * at(0, 0) + at(-u, -v)) @ N / h**2)

    return N, curving


# figure 10


def test_figure_10_draws_the_directions_at_its_point() -> None:
    t0, phi0 = curvature.POINT
    scaled = [
        (np.column_stack(line.get_data_3d()) * (1, 1, math.pi / 180), to_hex(line.get_color()))
        for line in axes(10).lines
    ]
    p = curvature.SURFACE(t0, phi0)
    (dot,) = [points for points, _ in scaled if len(points) == 1]
    assert dot[0] == pytest.approx(p)
    N, curving = shape_at(curvature.SURFACE, t0, phi0)
    found: dict[str, list[Any]] = {}
    for points, colour in scaled:
        if len(points) == 2 and colour == palette.INK:
            assert points[0] == pytest.approx(p)
            assert np.cross(points[1] - points[0], N) == pytest.approx(np.zeros(3), abs=1e-9)
        elif len(points) == 2:
            assert points.mean(axis=0) == pytest.approx(p)
            along = points[1] - points[0]
            along /= np.linalg.norm(along)
            assert along @ N == pytest.approx(0, abs=1e-9)
            found.setdefault(colour, []).append((along, curving(along)))
    asymptotic, principal = found[to_hex(palette.FRAME)], found[to_hex(palette.VERTEX_EDGE)]
    assert [k for _, k in asymptotic] == pytest.approx([0, 0], abs=1e-4)
    (u, k1), (v, k2) = principal
    assert u @ v == pytest.approx(0, abs=1e-9)
    turns = [curving(math.cos(a) * u + math.sin(a) * v) for a in np.linspace(0, math.pi, 181)]
    assert {round(min(turns), 4), round(max(turns), 4)} == {round(k1, 4), round(k2, 4)}
    bisected = [abs(direction @ u) for direction, _ in asymptotic]
    assert bisected[0] == pytest.approx(bisected[1])  # principal directions halve the angles


def test_figure_10_draws_a_normal_section_on_the_surface() -> None:
    N, curving = shape_at(curvature.SURFACE, *curvature.POINT)
    p, along = curvature.SURFACE(*curvature.POINT), curvature.AT.tangent(curvature.AT.principal_directions[1])
    drawn = strokes(10, palette.PATH)
    points = np.concatenate((drawn[:, 0], drawn[-1:, 1])) * (1, 1, math.pi / 180)
    assert (points - p) @ np.cross(N, along) == pytest.approx(np.zeros(len(points)), abs=1e-9)
    assert np.linalg.norm(points - p, axis=1).min() < 0.01
    # its curvature at the point is the normal curvature: the circle through three points near by
    k = int(np.linalg.norm(points - p, axis=1).argmin())
    a, b, c = points[k - 4], points[k], points[k + 4]
    sides = [np.linalg.norm(v) for v in (b - a, c - b, c - a)]
    assert 2 * np.linalg.norm(np.cross(b - a, c - a)) / np.prod(sides) == pytest.approx(abs(curving(along)), rel=0.01)
    # and the camera looks at the side that N points to
    ax = axes(10)
    elevation, azimuth = math.radians(ax.elev), math.radians(ax.azim)
    eye = np.array(
        [math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth), math.sin(elevation)]
    )
    assert N @ eye > 0.5


def test_figure_10_draws_the_indicatrix_of_its_point() -> None:
    _, curving = shape_at(curvature.SURFACE, *curvature.POINT)
    branches = [line for line in figure(10).axes[1].lines if to_hex(line.get_color()) == to_hex(palette.PATH)]
    assert len(branches) == 4
    for line in branches:
        for x, y in line.get_xydata()[::200]:
            kappa = curving(x * curvature.AT.frame[0] + y * curvature.AT.frame[1])
            assert kappa == pytest.approx(-1 if line.is_dashed() else 1, abs=1e-3)
    said = [text.get_text() for text in figure(10).axes[1].texts]
    names = sorted(text for text in said if "II" in text)
    assert names == 2 * [r"$\mathrm{II}(X, X) = -1$"] + 2 * [
        r"$\mathrm{II}(X, X) = 1$"
    ]  # of vectors, not of directions
    assert not any("kappa" in text for text in said)


# figure 11


def test_figure_11_draws_k_and_h_of_section_4() -> None:
    A = curvature.ROBOT.vertices
    a, g = A[0], A[1] - A[0]
    graph = figure(11).axes[-1]
    K, H = (line.get_xydata() for line in graph.lines[:2])
    assert [line.get_label() for line in graph.lines[:2]] == ["$K(t)$", "$H(t)$"]
    E, F = g @ g, a[0] * A[1][1] - a[1] * A[1][0]
    v2 = E * (1 + ((a + K[:, :1] * g) ** 2).sum(axis=1)) - F**2
    assert K[:, 1] == pytest.approx(-(E**2) / v2**2) and H[:, 1] == pytest.approx(E * F / (2 * v2**1.5))
    star = -(a @ g) / E
    assert graph.lines[2].get_xdata() == pytest.approx([star, star])
    assert K[K[:, 1].argmin(), 0] == pytest.approx(star, abs=3e-3)
    white = strokes(11, "white").reshape(-1, 3)
    assert curvature.SURFACE(star, np.radians(white[:, 2]))[:, :2] == pytest.approx(white[:, :2])


def test_figure_11_lets_the_darkest_part_be_seen_on_its_background() -> None:
    darkest = faces(11).rgb.sum(axis=1).min()
    assert sum(to_rgb(palette.WALL)) - darkest > 1.8 and darkest > 0.15  # neither the wall's white nor the ink's black


# figure 14


def test_figure_14_adds_up_to_eulers_number_in_every_metric() -> None:
    (ax,) = figure(14).axes
    *parts, total, zero = ax.lines
    assert [line.get_label() for line in parts] == ["at vertices", "on faces", "along edges"]
    values = np.array([line.get_ydata() for line in parts])
    np.testing.assert_allclose(values.sum(axis=0), total.get_ydata(), atol=1e-12)
    chi = int(boundary(scenes.FIVE).complex.euler.sum())
    np.testing.assert_allclose(total.get_ydata(), chi, atol=1e-8)
    assert str(chi) in total.get_label() and not np.any(zero.get_ydata())
    assert (values[1] < 0).all() and np.ptp(values[1]) > 1


# figure 15: Lemma 3


def test_figure_15_shows_a_minimal_surface_and_one_that_is_none() -> None:
    for k, robot, is_minimal in ((2, minimal.THROUGH, True), (3, minimal.BESIDE, False)):
        S = contact_surface(robot, minimal.CORNER, EdgeVertex(0, 0))
        for t, phi in ((0.2, 0.3), (0.5, 2.0), (0.8, 4.0)):
            N, curving = shape_at(S, t, phi)
            u = np.cross(N, (0.3, 0.5, 0.7))
            u /= np.linalg.norm(u)
            twice_the_mean = curving(u) + curving(np.cross(N, u))
            assert (abs(twice_the_mean) < 1e-4) == is_minimal
        # grey, which is no curvature, everywhere; or not
        saturation = rgb_to_hsv(faces(15, k).rgb)[:, 1]
        assert (saturation.max() < 0.05) if is_minimal else (saturation.max() > 0.3)
        # the striction curve: upright if it is the axis
        blue = strokes(15, palette.FRAME, k).reshape(-1, 3)
        assert (np.ptp(blue[:, :2], axis=0).max() < 1e-9) == is_minimal and np.ptp(blue[:, 2]) == pytest.approx(360)
    for k, robot in ((0, minimal.THROUGH), (1, minimal.BESIDE)):
        (drawn,) = outlines(figure(15).axes[k], palette.ROBOT)
        assert drawn == pytest.approx(robot.vertices)


# figure 16: Remark 2


def test_figure_16_draws_helices_that_share_a_pose_and_keep_a_point() -> None:
    x, y, theta = float(helices.POSE.x), float(helices.POSE.y), math.degrees(helices.POSE.theta)
    for point, colour in zip(helices.FIXED, helices.COLOURS, strict=True):
        ends = strokes(16, colour, 1).reshape(-1, 3)
        assert np.abs(ends - (x, y, theta)).max(axis=1).min() < 0.02 * 90
        kept = np.array(helices.POSE.apply([[float(c) for c in point]]))[0]
        a, phi = np.array([float(c) for c in point]), np.radians(ends[:, 2])
        turned = np.column_stack((np.cos(phi) * a[0] - np.sin(phi) * a[1], np.sin(phi) * a[0] + np.cos(phi) * a[1]))
        assert ends[:, :2] + turned == pytest.approx(np.tile(kept, (len(ends), 1)))
        circle = next(line for line in figure(16).axes[0].lines if to_hex(line.get_color()) == to_hex(colour))
        assert np.hypot(*(circle.get_xydata() - kept).T) == pytest.approx(math.hypot(*a))


# figure 19


@pytest.mark.slow
@pytest.mark.parametrize(("name", "k"), [("principal", 0), ("principal", 1), ("asymptotic", 0), ("asymptotic", 1)])
def test_figure_19_draws_lines_of_curvature_and_asymptotic_lines(name: str, k: int) -> None:
    colours = {"principal": (palette.VERTEX_EDGE, palette.INK), "asymptotic": (palette.FRAME, palette.INK)}
    drawn = strokes(19, colours[name][k], 0 if name == "principal" else 1) * (1, 1, math.pi / 180)
    assert len(drawn) > 100
    S = curvature.SURFACE
    for start, stop in drawn[:: len(drawn) // 25]:
        phi = (start[2] + stop[2]) / 2
        base, ruling = S(0, phi), S(1, phi) - S(0, phi)
        t = float(((start + stop) / 2 - base) @ ruling / (ruling @ ruling))
        N, curving = shape_at(S, t, phi)
        along = (stop - start) / np.linalg.norm(stop - start)
        across = np.cross(N, along)
        if name == "asymptotic":
            assert curving(along) == pytest.approx(0, abs=0.03)
        else:  # the second fundamental form has no mixed term
            mixed = (curving((along + across) / math.sqrt(2)) - curving((along - across) / math.sqrt(2))) / 2
            assert mixed == pytest.approx(0, abs=0.03)
        assert lines.PHI.phi_min - 1e-9 <= phi <= lines.PHI.phi_max + 1e-9 and -1e-6 < t < 1 + 1e-6


def test_lines_of_figure_19_cover_the_patch() -> None:
    for k, colour in ((0, palette.VERTEX_EDGE), (0, palette.INK), (1, palette.FRAME), (1, palette.INK)):
        ends = strokes(19, colour, k).reshape(-1, 3) * (1, 1, math.pi / 180)
        for t in (0.1, 0.5, 0.9):
            for share in (0.1, 0.5, 0.9):
                point = curvature.SURFACE(t, lines.PHI.phi_min + share * lines.PHI.phi_range)
                assert np.linalg.norm(ends - point, axis=1).min() < 0.45
