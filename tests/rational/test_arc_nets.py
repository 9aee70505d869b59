"""Bezier nets of surfaces of an arc on an arc, evaluated with equality."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

from arc_shapes import CAP, CAR, DISC, STADIUM
from cfree import Curved, Pose
from cfree.contact import ArcArc, ArcArcSurface, arc_surface
from cfree.rational import arc_bezier_net, save_bezier

SHARES = [Fraction(k, 7) for k in range(8)]


def surface() -> ArcArcSurface:
    S = arc_surface(CAR, STADIUM, ArcArc(1, 0))
    assert isinstance(S, ArcArcSurface)
    return S


@pytest.mark.parametrize("charts", [(0, 0), (1, 0), (0, 1), (1, 1)])
@pytest.mark.parametrize("dimension", [2, 3])
def test_nets_evaluate_to_the_surface_of_two_arcs_exactly(charts: tuple[int, int], dimension: int) -> None:
    S = surface()
    net = arc_bezier_net(S, "-1/2", "2/3", "1/5", 1, charts=charts, dimension=dimension)  # type: ignore[arg-type]
    assert (len(net.points), len(net.points[0])) == (3, dimension + 1)
    half = Pose(0, 0, "180deg")
    for i in SHARES:
        for j in SHARES:
            kappa, tau = Fraction(-1, 2) + i * Fraction(7, 6), Fraction(1, 5) + j * Fraction(4, 5)
            psi, theta = (Pose(0, 0, {"tau": value}) for value in (kappa, tau))
            if charts[0]:
                psi = psi @ half
            if charts[1]:
                theta = theta @ half
            exact = S.pose(*({"tau": "inf" if q.tau is None else q.tau} for q in (psi, theta)))
            assert net(kappa, tau) == ((exact.x, exact.y) if dimension == 2 else (exact.x, exact.y, tau))


def test_points_are_sums_and_weights_are_positive_products() -> None:
    net = arc_bezier_net(surface(), "-1/3", "1/2", "-1/4", "4/5")
    points, weights = net.arrays()
    assert (weights > 0).all() and np.linalg.matrix_rank(weights) == 1
    sums = points[..., :2] - points[:1, :, :2]
    assert np.allclose(sums, sums[:, :1])


def test_the_whole_patch_is_one_net_of_bidegree_2_2_symbolically() -> None:
    """In kappa and the tangent lambda of half the robot's own normal: (x, y), cos theta and sin theta."""
    k, l, sigma, px, py, ax, ay = sp.symbols("k l sigma px py ax ay", real=True)

    def rotation(t: sp.Expr) -> sp.Matrix:
        return sp.Matrix([[1 - t**2, -2 * t], [2 * t, 1 - t**2]]) / (1 + t**2)

    theta = -rotation(k) * rotation(-l)  # psi + pi - chi
    r = sp.Matrix([px, py]) - theta * sp.Matrix([ax, ay]) + sigma * rotation(k)[:, 0]
    for value in (*r, theta[0, 0], theta[1, 0]):
        numerator = sp.Poly(sp.cancel(sp.together(value * (1 + k**2) * (1 + l**2))), k, l)
        assert numerator.degree(k) <= 2 and numerator.degree(l) <= 2


def test_bad_nets_are_refused() -> None:
    S = surface()
    with pytest.raises(ValueError, match="the interval"):
        arc_bezier_net(S, 1, 1, 0, 1)
    with pytest.raises(ValueError, match="the weights are"):
        arc_bezier_net(S, -1, 1, 0, 1)
    with pytest.raises(ValueError, match="there is no chart 2"):
        arc_bezier_net(S, 0, 1, 0, 1, charts=(2, 0))
    with pytest.raises(ValueError, match=r"kappa = 2 is not in \[0, 1\]"):
        arc_bezier_net(S, 0, 1, 0, 1)(2, 0)
    irrational = arc_surface(CAP, DISC, ArcArc(2, 0))
    helix = arc_surface(Curved([(0, 0), (1, 0), (0, 1)]), CAP, ArcArc(0, 0))
    for one, word in ((irrational, "irrational"), (helix, "0, its surface a helix")):
        assert isinstance(one, ArcArcSurface)
        with pytest.raises(ValueError, match=rf"sigma is {word}"):
            arc_bezier_net(one, 0, 1, 0, 1)


def test_files_hold_exact_numbers_of_nets(tmp_path: Path) -> None:
    net = arc_bezier_net(surface(), 0, 1, 0, "1/3")
    save_bezier([net], tmp_path / "net.json")
    (read,) = json.loads((tmp_path / "net.json").read_text())
    assert read["degrees"] == [2, 3] and read["intervals"] == [["0", "1"], ["0", "1/3"]]
    assert [[Fraction(c) for c in point] for point in read["points"][1]] == [list(point) for point in net.points[1]]
