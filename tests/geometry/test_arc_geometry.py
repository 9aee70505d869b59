"""Geometry of the surface of an arc on an arc: by symbols, by finite differences, and by integration."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import product

import numpy as np
import pytest
import sympy as sp

from arc_shapes import BAY, CAP, CAR, CONVEX, DISC, STADIUM, TRIANGLE
from cfree import Curved, Polygon, UnsupportedError
from cfree.contact import (
    AngleRange,
    ArcArc,
    ArcArcSurface,
    ArcEdge,
    EdgeArc,
    OffsetSurface,
    arc_contacts,
    arc_range,
    arc_surface,
    shape_features,
)
from cfree.geometry import (
    arc_geometry,
    is_developable,
    is_helicoid,
    is_minimal,
    line_of_curvature,
    local_geometry,
    meeting_volume,
    parabolic_angles,
    zero_mean_angles,
)

RANDOM = np.random.default_rng(11)
ROWS = np.column_stack([RANDOM.normal(size=(60, 4)), RANDOM.choice([-1, 1], 60) * RANDOM.uniform(0.2, 2, 60)])
PSI, PHI = RANDOM.uniform(0, math.tau, (2, 60))
W = 1.7


def points(rows: np.ndarray, psi: np.ndarray, phi: np.ndarray, w: float = W) -> np.ndarray:
    """S from its definition, in complex numbers."""
    px, py, ax, ay, sigma = np.moveaxis(rows, -1, 0)
    z = px + 1j * py - np.exp(1j * phi) * (ax + 1j * ay) + sigma * np.exp(1j * psi)
    return np.stack([z.real, z.imag, w * phi], axis=-1)


def derivatives(rows: np.ndarray, psi: np.ndarray, phi: np.ndarray) -> list[np.ndarray]:
    """S_psi, S_phi, S_psipsi, S_psiphi, S_phiphi by finite differences."""
    h = 1e-4

    def S(a: int, b: int) -> np.ndarray:
        return points(rows, psi + a * h, phi + b * h)

    return [
        (S(1, 0) - S(-1, 0)) / (2 * h), (S(0, 1) - S(0, -1)) / (2 * h),
        (S(1, 0) - 2 * S(0, 0) + S(-1, 0)) / h**2, (S(1, 1) - S(1, -1) - S(-1, 1) + S(-1, -1)) / (4 * h * h),
        (S(0, 1) - 2 * S(0, 0) + S(0, -1)) / h**2,
    ]  # fmt: skip


def dot(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    return (u * v).sum(axis=-1)


@pytest.fixture(scope="module")
def symbols() -> dict[str, sp.Expr]:
    """The forms, K and H from the definition, in a = |a|, sigma, w and delta, where nothing else matters."""
    psi, phi, sigma = sp.symbols("psi phi sigma", real=True, nonzero=True)
    a, w = sp.symbols("a w", positive=True)
    S = sp.Matrix([-a * sp.cos(phi) + sigma * sp.cos(psi), -a * sp.sin(phi) + sigma * sp.sin(psi), w * phi])
    first, second = S.diff(psi), S.diff(phi)
    u = sp.Matrix([sp.cos(psi), sp.sin(psi)])
    s = (second[:2, 0].T * u)[0]
    D = sp.sqrt(w**2 + s**2)
    N = sp.Matrix([w * u[0], w * u[1], -s]) / D
    forms = {"E": first.dot(first), "F": first.dot(second), "G": second.dot(second)}
    forms |= {"e": S.diff(psi, 2).dot(N), "f": S.diff(psi, phi).dot(N), "g": S.diff(phi, 2).dot(N)}
    names = {"psi": psi, "phi": phi, "sigma": sigma, "a": a, "w": w, "D": D, "s": s, "c": a * sp.cos(psi - phi)}
    normal = {"N.S_psi": N.dot(first), "N.S_phi": N.dot(second), "N.N": N.dot(N)}
    return names | forms | normal


def is_zero(expression: sp.Expr) -> bool:
    return sp.simplify(sp.expand_trig(expression)) == 0


@pytest.mark.slow
def test_forms_are_those_of_the_definition_symbolically(symbols: dict[str, sp.Expr]) -> None:
    v = symbols
    assert is_zero(v["N.S_psi"]) and is_zero(v["N.S_phi"]) and is_zero(v["N.N"] - 1)
    assert is_zero(v["s"] + v["a"] * sp.sin(v["psi"] - v["phi"]))
    assert is_zero(v["E"] - v["sigma"] ** 2) and is_zero(v["F"] + v["sigma"] * v["c"])
    assert is_zero(v["G"] - v["a"] ** 2 - v["w"] ** 2)
    assert is_zero(v["e"] + v["sigma"] * v["w"] / v["D"]) and v["f"] == 0 and is_zero(v["g"] - v["w"] * v["c"] / v["D"])
    assert is_zero(v["E"] * v["G"] - v["F"] ** 2 - v["sigma"] ** 2 * v["D"] ** 2)


@pytest.mark.slow
def test_curvatures_are_those_of_the_forms_symbolically(symbols: dict[str, sp.Expr]) -> None:
    v = symbols
    area = v["E"] * v["G"] - v["F"] ** 2
    K = (v["e"] * v["g"] - v["f"] ** 2) / area
    H = (v["e"] * v["G"] - 2 * v["f"] * v["F"] + v["g"] * v["E"]) / (2 * area)
    sigma, w, D, c, a = (v[name] for name in ("sigma", "w", "D", "c", "a"))
    assert is_zero(K + w**2 * c / (sigma * D**4))
    assert is_zero(H - w * (sigma * c - a**2 - w**2) / (2 * sigma * D**3))


@pytest.mark.slow
def test_there_are_no_umbilics_and_no_minimal_surface_symbolically() -> None:
    """H^2 - K is a sum of squares that do not vanish together, and H = 0 fixes the angle delta."""
    sigma = sp.symbols("sigma", real=True, nonzero=True)
    a, w = sp.symbols("a w", positive=True)
    c, s = sp.symbols("c s", real=True)
    H, K = (
        w * (sigma * c - a**2 - w**2) / (2 * sigma * (w**2 + s**2) ** sp.Rational(3, 2)),
        -(w**2) * c / (sigma * (w**2 + s**2) ** 2),
    )
    claimed = (
        w**2 * ((sigma * c + w**2 + s**2 - c**2) ** 2 + 4 * c**2 * (w**2 + s**2)) / (4 * sigma**2 * (w**2 + s**2) ** 3)
    )
    assert sp.simplify((H**2 - K - claimed).subs(a, sp.sqrt(c**2 + s**2))) == 0
    delta = sp.symbols("delta", real=True)
    zero = sigma * a * sp.cos(delta) - a**2 - w**2
    assert sp.simplify(zero.diff(delta)) == -a * sigma * sp.sin(delta)  # not 0 on any interval
    assert sp.simplify(zero.subs(a, 0)) == -(w**2)
    # |sigma| a >= a^2 + w^2 has solutions a only from |sigma| = 2 w on
    assert sp.simplify(a**2 + w**2 - 2 * w * a - (a - w) ** 2) == 0


@pytest.mark.slow
def test_slopes_of_lines_of_curvature_symbolically(symbols: dict[str, sp.Expr]) -> None:
    v, m = symbols, sp.symbols("m", real=True)
    rows = sp.Matrix([[1, -m, m**2], [v["E"], v["F"], v["G"]], [v["e"], v["f"], v["g"]]])  # do Carmo, 3.3
    sigma, w, D, c, a = (v[name] for name in ("sigma", "w", "D", "c", "a"))
    quadratic = sigma * c * m**2 - (sigma * c + a**2 + w**2) * m + c**2
    assert is_zero(rows.det() * D / (sigma * w) - quadratic) or is_zero(rows.det() * D / (sigma * w) + quadratic)


@pytest.mark.slow
def test_asymptotic_slopes_symbolically(symbols: dict[str, sp.Expr]) -> None:
    v = symbols
    assert is_zero(v["e"] * v["c"] / v["sigma"] + v["g"])  # e m^2 + g = 0 with m^2 = c / sigma


def test_forms_and_curvatures_are_those_of_finite_differences() -> None:
    at = arc_geometry(ROWS, PSI, PHI, angle_scale=W)
    first, second, *seconds = derivatives(ROWS, PSI, PHI)
    N = np.cross(first, second)
    area = np.linalg.norm(N, axis=-1)
    N *= (np.sign(N[:, 0] * np.cos(PSI) + N[:, 1] * np.sin(PSI)) / area)[:, None]  # towards the free side, along u
    E, F, G = dot(first, first), dot(first, second), dot(second, second)
    e, f, g = (dot(vector, N) for vector in seconds)
    for ours, theirs in ((at.E, E), (at.F, F), (at.G, G), (at.v, area)):
        assert ours == pytest.approx(theirs, abs=1e-6)
    for ours, theirs in ((at.e, e), (at.f, f), (at.g, g), (at.normal, N)):
        assert ours == pytest.approx(theirs, abs=1e-6)
    K, H = (e * g - f * f) / area**2, (e * G - 2 * f * F + g * E) / (2 * area**2)
    assert at.gaussian_curvature == pytest.approx(K, rel=1e-5, abs=1e-5)
    assert at.mean_curvature == pytest.approx(H, rel=1e-5, abs=1e-5)
    assert at.frame[:, 0] == pytest.approx(first / np.sqrt(E)[:, None], abs=1e-6)
    assert np.einsum("nij,nkj->nik", at.frame, at.frame) == pytest.approx(np.tile(np.eye(3), (60, 1, 1)), abs=1e-12)
    assert (dot(at.frame[:, 1], second) > 0).all()


def test_the_normal_points_to_the_free_side() -> None:
    """For both signs of sigma: moving away from the obstacle along u is moving along N."""
    at = arc_geometry(ROWS, PSI, PHI, angle_scale=W)
    assert (at.normal[:, 0] * np.cos(PSI) + at.normal[:, 1] * np.sin(PSI) > 0).all()


def test_normal_curvatures_and_principal_directions() -> None:
    at = arc_geometry(ROWS, PSI, PHI, angle_scale=W)
    first, second, *seconds = derivatives(ROWS, PSI, PHI)
    for xi in (0.0, 0.7, 2.0):
        direction = at.tangent(xi)
        # the coordinates of the tangent in S_psi and S_phi
        parts = np.array([np.linalg.lstsq(np.column_stack(pair), d, rcond=None)[0]
                          for *pair, d in zip(first, second, direction, strict=True)])  # fmt: skip
        p, q = parts.T
        bend = (
            p * p * dot(seconds[0], at.normal)
            + 2 * p * q * dot(seconds[1], at.normal)
            + q * q * dot(seconds[2], at.normal)
        )
        assert at.normal_curvature(xi) == pytest.approx(bend, rel=1e-4, abs=1e-4)
    least, greatest = np.moveaxis(at.principal_curvatures, -1, 0)
    for k, kappa in ((0, least), (1, greatest)):
        assert at.normal_curvature(at.principal_directions[:, k]) == pytest.approx(kappa)
    every = np.stack([at.normal_curvature(xi) for xi in np.linspace(0, math.pi, 400)])
    assert every.min(axis=0) == pytest.approx(least, abs=1e-3) and every.max(axis=0) == pytest.approx(
        greatest, abs=1e-3
    )
    assert least * greatest == pytest.approx(at.gaussian_curvature)
    assert (least + greatest) / 2 == pytest.approx(at.mean_curvature)
    assert (greatest > least).all()  # no umbilics


def test_asymptotic_directions_exist_exactly_where_k_is_not_positive() -> None:
    at = arc_geometry(ROWS, PSI, PHI, angle_scale=W)
    elliptic = at.gaussian_curvature > 0
    xi = at.asymptotic_directions
    assert 0 < elliptic.sum() < 60 and np.isnan(xi[elliptic]).all() and np.isfinite(xi[~elliptic]).all()
    for k in (0, 1):
        bend = at.normal_curvature(np.nan_to_num(xi[:, k]))
        assert bend[~elliptic] == pytest.approx(0, abs=1e-12)
    # dpsi / dphi = +-sqrt(c / sigma)
    q = np.sin(xi) * (np.sqrt(at.E) / at.v)[:, None]
    p = (np.cos(xi) - (at.F / np.sqrt(at.E))[:, None] * q) / np.sqrt(at.E)[:, None]
    slopes = np.sort((p / q)[~elliptic], axis=-1)
    root = np.sqrt((-at.F / at.E)[~elliptic])
    assert slopes == pytest.approx(np.stack([-root, root], axis=-1), rel=1e-6)


def test_parabolic_curves_part_elliptic_from_hyperbolic_points() -> None:
    for centre, obstacle in ((("1/2", 1), Curved.circle((0, 0), 2)), ((-1, 0), Curved.circle((1, 1), 1))):
        S = arc_surface(Curved.circle(centre, 1), obstacle, ArcArc(0, 0))
        assert isinstance(S, ArcArcSurface)
        angles = parabolic_angles(S)
        assert len(angles) == 2 and angles[1] - angles[0] == pytest.approx(math.pi)
        for chi in angles:
            phi = np.linspace(0, 6, 9)
            assert arc_geometry(S.circular, phi + chi, phi).gaussian_curvature == pytest.approx(0, abs=1e-12)
            sides = arc_geometry(S.circular, phi + chi + np.array([[-0.01], [0.01]]), phi).gaussian_curvature
            assert (sides[0] * sides[1] < 0).all()


def test_elliptic_points_are_those_whose_arc_is_nearer_to_the_obstacle_than_the_reference_point() -> None:
    at = arc_geometry(ROWS, PSI, PHI, angle_scale=W)
    x, y = (
        (np.exp(1j * PHI) * (ROWS[:, 2] + 1j * ROWS[:, 3])).real,
        (np.exp(1j * PHI) * (ROWS[:, 2] + 1j * ROWS[:, 3])).imag,
    )
    nearer = x * np.cos(PSI) + y * np.sin(PSI) < 0
    assert np.array_equal(at.gaussian_curvature > 0, nearer == (ROWS[:, 4] > 0))


@pytest.mark.parametrize("sign", [1, -1])
def test_zero_mean_curvature_needs_sigma_of_two_radians(sign: int) -> None:
    """Exactly: none below |sigma| |a| = |a|^2 + w^2, one angle there, two above."""

    def surface(sigma: str, a: str) -> ArcArcSurface:
        if sign > 0:
            S = arc_surface(Curved.circle((a, 0), sigma), Polygon([(0, 0), (1, 0), (0, 1)]), ArcArc(0, 0))
        else:  # a vertex at a in a hole
            tip = Polygon([(a, 0), (9, 0), (0, 9)])
            i = [arc.centre for arc in shape_features(tip).arcs].index((Fraction(a), 0))
            hole = Curved([(-99, -99), (99, -99), (99, 99), (-99, 99)], [Curved.circle((0, 0), sigma).path])
            S = arc_surface(tip, hole, ArcArc(i, 4))
        assert isinstance(S, ArcArcSurface) and S.sign == sign
        return S

    # w = 1: at a = 1 the least sigma is 2; at a = 2 it is 5 / 2; at a = 1/2 it is 5 / 2
    for a, least in (("1", "2"), ("2", "5/2"), ("1/2", "5/2")):
        tie = Fraction(least)
        counts = [
            len(zero_mean_angles(surface(str(tie + change), a)))
            for change in (Fraction(-1, 10**30), 0, Fraction(1, 10**30))
        ]
        assert counts == [0, 1, 2]
        S = surface(str(2 * tie), a)
        for chi in zero_mean_angles(S):
            at = arc_geometry(S.circular, chi + 0.3, 0.3)
            assert at.mean_curvature == pytest.approx(0, abs=1e-14) and at.gaussian_curvature < 0
    assert (
        zero_mean_angles(surface("2", "1"), angle_scale="0.99")
        != ()
        == zero_mean_angles(surface("2", "1"), angle_scale="1.01")
    )
    with pytest.raises(ValueError, match="angle_scale: 0"):
        zero_mean_angles(surface("2", "1"), angle_scale=0)


def test_irrational_sums_of_radii_are_compared_exactly() -> None:
    """sigma = sqrt(2) + 1 and |a| = 1: H = 0 needs w^2 <= sqrt(2)."""
    S = arc_surface(CAP, Curved.circle((0, 0), 1), ArcArc(2, 0))
    assert isinstance(S, ArcArcSurface) and S.a == (0, -1) and S.sigma is None
    below = Fraction(math.isqrt(math.isqrt(2 * 10**120)), 10**30)  # of 2^(1/4)
    assert len(zero_mean_angles(S, angle_scale=below)) == 2
    assert len(zero_mean_angles(S, angle_scale=below + Fraction(1, 10**30))) == 0


def test_mean_curvature_vanishes_nowhere_on_surfaces_below_the_bound() -> None:
    random = np.random.default_rng(3)
    rows = np.column_stack(
        [random.normal(size=(500, 4)) * 2, random.choice([-1, 1], 500) * random.uniform(0.1, 2 * W, 500)]
    )
    at = arc_geometry(rows[:, None], np.linspace(0, 7, 200), 0.0, angle_scale=W)
    assert (np.sign(at.mean_curvature) == -np.sign(rows[:, 4:])).all()


def test_predicates_of_all_kinds_of_surfaces() -> None:
    tube, tin = (arc_surface(Curved.circle(centre, 1), STADIUM, ArcArc(0, 0)) for centre in ((1, 0), (0, 0)))
    assert [is_developable(S) for S in (tube, tin)] == [False, True]
    assert not any(is_minimal(S) or is_helicoid(S) for S in (tube, tin))
    rolled = arc_surface(Curved.circle((0, 0), 1), TRIANGLE, ArcEdge(0, 0))
    assert is_developable(rolled) and is_minimal(rolled) and not is_helicoid(rolled)
    # the edge y = -1/2 of the flat box moved by -1/2, 1/2, ... to the reference point
    flat = [(-1, "1/2"), (2, "1/2"), (2, 2), (-1, 2)]
    for grown, radius, minimal in (
        ("0", "1/2", True),
        ("1/4", "1/4", True),
        ("1/4", "1/3", False),
        ("0", "2/5", False),
    ):
        robot = Curved(flat, grown=grown) if grown != "0" else Polygon(flat)
        S = arc_surface(robot, Curved.circle((0, 0), radius), EdgeArc(0, 0))
        assert isinstance(S, OffsetSurface) and is_minimal(S) == minimal == is_helicoid(S) and not is_developable(S)
        H = local_geometry(S.ruled, [0.1, 0.8], 1.0).mean_curvature
        assert (np.abs(H) < 1e-15).all() == minimal
    # irrational lengths: the line x + y = 2, moved by sqrt(2), and by a little more
    far = Polygon([(2, 0), (0, 2), (5, 5)])
    k = next(k for k, e in enumerate(shape_features(far).edges) if {e.start[0], e.start[0] + e.along[0]} == {0, 2})
    (bow,) = (j for j, arc in enumerate(shape_features(CAP).arcs) if arc.signed_square)
    S = arc_surface(far, CAP, EdgeArc(k, bow))
    assert isinstance(S, OffsetSurface) and S.exact is None and is_minimal(S)
    near = Curved([(2, 0), (0, 2), (5, 5)], grown=Fraction(1, 10**40))
    assert not is_minimal(arc_surface(near, CAP, EdgeArc(k, bow)))


def test_offset_surfaces_have_the_geometry_of_section_4() -> None:
    """Curvatures of an edge on an arc are those of finite differences of its points."""
    S = arc_surface(CAR, CAP, EdgeArc(0, 2))
    assert isinstance(S, OffsetSurface)
    h, (t, phi) = 1e-4, (0.4, 1.1)

    def x(a: float, b: float) -> np.ndarray:
        return S(t + a * h, phi + b * h)

    first, second = (x(1, 0) - x(-1, 0)) / (2 * h), (x(0, 1) - x(0, -1)) / (2 * h)
    N = np.cross(first, second)
    N /= np.linalg.norm(N)
    f, g = (
        dot(x(1, 1) - x(1, -1) - x(-1, 1) + x(-1, -1), N) / (4 * h * h),
        dot(x(0, 1) - 2 * x(0, 0) + x(0, -1), N) / h**2,
    )
    E, F, G = dot(first, first), dot(first, second), dot(second, second)
    at = local_geometry(S.ruled, t, phi)
    assert at.gaussian_curvature == pytest.approx(-f * f / (E * G - F * F), rel=1e-4)
    assert at.mean_curvature == pytest.approx((g * E - 2 * f * F) / (2 * (E * G - F * F)), rel=1e-4)


def test_all_depends_on_psi_minus_phi_alone() -> None:
    turned = arc_geometry(ROWS, PSI + 1, PHI + 1, angle_scale=W)
    at = arc_geometry(ROWS, PSI, PHI, angle_scale=W)
    for name in ("E", "F", "G", "e", "g", "gaussian_curvature", "mean_curvature"):
        assert getattr(turned, name) == pytest.approx(getattr(at, name), abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("family", ["least", "greatest"])
def test_lines_of_curvature_go_along_principal_directions(family: str) -> None:
    rows, psi, phi = ROWS[:4], PSI[:4], PHI[:4]
    lengths = np.linspace(0.0, 3.0, 61)[:, None]
    line = line_of_curvature(rows, psi, phi, lengths, family, angle_scale=W)  # type: ignore[arg-type]
    assert line.error.max() < 1e-8
    curve = points(rows, line.psi, line.phi)
    step = np.linalg.norm(np.diff(curve, axis=0), axis=-1)
    assert step == pytest.approx(0.05, rel=2e-2)
    middle = line_of_curvature(rows, psi, phi, (lengths[1:] + lengths[:-1]) / 2, family, angle_scale=W)  # type: ignore[arg-type]
    at = arc_geometry(rows, middle.psi, middle.phi, angle_scale=W)
    along = np.diff(curve, axis=0) / step[..., None]
    assert np.abs(dot(along, at.tangent(middle.xi))) == pytest.approx(1, abs=2e-3)
    kappa = at.principal_curvatures[..., 0 if family == "least" else 1]
    assert at.normal_curvature(middle.xi) == pytest.approx(kappa)
    # Rodrigues: the normal turns within the line's own direction
    change = np.diff(arc_geometry(rows, line.psi, line.phi, angle_scale=W).normal, axis=0) / step[..., None]
    assert change == pytest.approx(-kappa[..., None] * along, abs=2e-2)


def test_lines_of_curvature_cross_parabolic_curves() -> None:
    """The direction along which a family runs turns into S_psi there; it must not turn back."""
    line = line_of_curvature([0, 0, 1, 0, 2], 1.2, 0.0, np.linspace(0, 6, 200), "least")
    assert (np.abs(np.diff(line.xi)) < 0.2).all()
    assert arc_geometry([0, 0, 1, 0, 2], line.psi, line.phi).gaussian_curvature.min() < 0
    assert arc_geometry([0, 0, 1, 0, 2], line.psi, line.phi).gaussian_curvature.max() > 0


def test_total_curvature_of_a_patch_is_a_difference_of_slopes() -> None:
    """sign(sigma) t_j [s / sqrt(w^2 + s^2)] between the ends of the robot's cone."""
    for A, O, contact in ((CAR, STADIUM, ArcArc(1, 0)), (DISC, CAP, ArcArc(0, 2))):
        S = arc_surface(A, O, contact)
        assert isinstance(S, ArcArcSurface)
        x, weights = np.polynomial.legendre.leggauss(60)
        psi = S.obstacle.first + S.obstacle.width * (x[:, None] + 1) / 2
        nu = S.robot.first + S.robot.width * (x + 1) / 2
        at = arc_geometry(S.circular, psi, psi + math.pi - nu, angle_scale=W)
        numeric = (
            np.einsum("ij,i,j", at.gaussian_curvature * at.v, weights, weights) * S.obstacle.width * S.robot.width / 4
        )
        ends = arc_geometry(S.circular, 0.0, math.pi - (S.robot.first + np.array([0, S.robot.width])), angle_scale=W)
        # the slope is minus the normal's third coordinate
        assert numeric == pytest.approx(S.obstacle.width * (ends.normal[0, 2] - ends.normal[1, 2]) * S.sign, abs=1e-9)


def slice_area(patches: list[tuple[OffsetSurface | ArcArcSurface, AngleRange]], theta: float) -> float:
    """Area within the rim of the forbidden region at one orientation, by Green's theorem over its contacts."""
    total = 0.0
    for S, Phi in patches:
        if (theta - Phi.phi_min) % math.tau > Phi.phi_range:
            continue
        if isinstance(S, OffsetSurface):
            (x, y, _), (u, v, _) = S([0, 1], theta)
            total += x * v - y * u
            continue
        (low, high), (first, last) = ((arc.first, arc.first + arc.width) for arc in (S.obstacle, S.robot))
        px, py, ax, ay, sigma = S.circular
        centre = px + 1j * py - np.exp(1j * theta) * (ax + 1j * ay)
        for turns in (-2, -1, 0, 1, 2):  # psi in both cones
            shift = theta - math.pi + turns * math.tau
            start, stop = max(low, first + shift), min(high, last + shift)
            if start < stop:
                swept = np.exp(1j * stop) - np.exp(1j * start)
                total += sigma * (centre.conjugate() * swept).imag + sigma**2 * (stop - start)
    return total / 2


@pytest.mark.slow
@pytest.mark.parametrize(("robot", "obstacle"), [*product(CONVEX, CONVEX)][::2])
def test_the_volume_of_a_pair_is_the_integral_of_its_slices(robot: str, obstacle: str) -> None:
    """2 pi (A + B) + per per, from the contacts of each slice alone."""
    A, O = CONVEX[robot], CONVEX[obstacle]
    thetas = math.tau * (np.arange(240) + 0.37) / 240
    patches = [(arc_surface(A, O, contact), arc_range(A, O, contact)) for contact in arc_contacts(A, O)]
    volume = math.tau * np.mean([slice_area(patches, theta) for theta in thetas.tolist()])
    assert volume == pytest.approx(meeting_volume(A, O), rel=3e-4)


def test_the_volume_of_polygons_is_the_same_by_their_features() -> None:
    whole = Curved([(-1, -1), (2, "-1/2"), (0, 1)])
    assert meeting_volume(whole, CAR) == pytest.approx(meeting_volume(TRIANGLE, CAR), rel=1e-14)


def test_volumes_of_other_shapes_are_refused() -> None:
    with pytest.raises(ValueError, match="robot: not convex"):
        meeting_volume(BAY, DISC)
    with pytest.raises(UnsupportedError, match="ring 0, piece 0"):
        meeting_volume(DISC, Curved.ellipse((0, 0), (2, 1)))
