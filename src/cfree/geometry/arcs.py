"""Geometry of the contact surface of an arc on an arc: forms, curvatures, directions, lines of curvature.

S(psi, phi) = (p - R(phi) a + sigma u(psi), w phi) with w = `angle_scale` is the sum of a circle and a helix, and a
screw motion about p maps it to itself: all below depends on delta = psi - phi - arg(a) alone. With c = |a| cos(delta),
s = -|a| sin(delta) and D = sqrt(w^2 + s^2),

    E = sigma^2      F = -sigma c    G = |a|^2 + w^2    v = sqrt(E G - F^2) = |sigma| D
    e = -sigma w/D   f = 0           g = w c / D
    K = -w^2 c / (sigma D^4)         H = w (sigma c - |a|^2 - w^2) / (2 sigma D^3)

for the normal (w u, -s) / D towards the free side. docs/theory/arcs.md derives them. Surfaces of an arc on an edge, or
of an edge on an arc, are v-e and e-v surfaces with an offset: `local_geometry` takes their `ruled`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from cfree.arguments import checked
from cfree.contact.arcs import ArcArcSurface
from cfree.exact.number import Number, finite, to_fraction
from cfree.exact.orientation import Order
from cfree.exact.surd import Surd
from cfree.geometry.ruled import Floats, check_scale
from cfree.value import Value

CLOSE = 1e-10  # tolerance per length
MOST_STEPS = 1 << 13


@dataclass(frozen=True, eq=False, repr=False)
class ArcGeometry(Value):
    """First and second fundamental forms at points of surfaces of an arc on an arc, and derived quantities.

    Every array has the common shape (...) of the input that made it; see `arc_geometry`. The names are those of
    `LocalGeometry`, with psi in the place of t.

    Attributes
    ----------
    E, F, G : (...) float64
        First fundamental form, in length^2 / radian^2.
    e, f, g : (...) float64
        Second fundamental form, for the normal towards the free side, in length / radian^2; f is 0.
    v : (...) float64
        sqrt(E G - F^2), the area element, in length^2 / radian^2; never 0.
    frame : (..., 3, 3) float64
        Rows: the unit tangent along increasing psi, the unit tangent across it with increasing phi, the unit normal.
        The coordinates are x, y, angle_scale * theta.
    gaussian_curvature, mean_curvature : (...) float64
        K in 1 / length^2 and H in 1 / length, for the normal towards the free side.
    """

    E: Floats
    F: Floats
    G: Floats
    e: Floats
    f: Floats
    g: Floats
    v: Floats
    frame: Floats
    gaussian_curvature: Floats
    mean_curvature: Floats

    @property
    def normal(self) -> Floats:
        """Unit normal towards the free side of a patch, (..., 3)."""
        return self.frame[..., 2, :]

    @checked
    def normal_curvature(self, xi: ArrayLike) -> Floats:
        """Normal curvature in a direction, in 1 / length.

        Parameters
        ----------
        xi : (...) float, radians
            Angle from the tangent along psi, S_psi / |S_psi|, towards increasing phi.
        """
        double = 2 * finite("xi", xi)
        half, twist = self._half_difference_and_twist
        kappa: Floats = self.mean_curvature + half * np.cos(double) + twist * np.sin(double)
        return kappa

    @property
    def asymptotic_directions(self) -> Floats:
        """Angles xi at which the normal curvature vanishes, (..., 2); NaN at elliptic points, twice one at parabolic.

        In the parameters dpsi / dphi = +-sqrt(c / sigma).
        """
        first = self.principal_directions[..., 0]
        share = np.clip(self.mean_curvature / np.hypot(*self._half_difference_and_twist), -1.0, 1.0)
        away = np.where(self.gaussian_curvature > 0, np.nan, np.arccos(share) / 2)
        return np.stack([first - away, first + away], axis=-1)

    @property
    def principal_directions(self) -> Floats:
        """Angles xi_1 in [0, pi) and xi_2 = xi_1 + pi / 2 of least and greatest normal curvature, (..., 2).

        They are never undetermined: these surfaces have no umbilics.
        """
        half, twist = self._half_difference_and_twist
        xi = np.mod(np.arctan2(-twist, -half) / 2, math.pi)
        return np.stack([xi, xi + math.pi / 2], axis=-1)

    @property
    def principal_curvatures(self) -> Floats:
        """Normal curvatures kappa_1 < kappa_2 in the principal directions, (..., 2), in 1 / length."""
        H = self.mean_curvature
        large = H + np.copysign(np.hypot(*self._half_difference_and_twist), H)  # nothing cancels; never 0
        small = self.gaussian_curvature / large
        return np.stack([np.minimum(large, small), np.maximum(large, small)], axis=-1)

    @checked
    def tangent(self, xi: ArrayLike) -> Floats:
        """Unit tangent in the direction xi (radians), (..., 3), in x, y, angle_scale * theta."""
        xi = finite("xi", xi)[..., None]
        return np.cos(xi) * self.frame[..., 0, :] + np.sin(xi) * self.frame[..., 1, :]

    @property
    def _half_difference_and_twist(self) -> tuple[Floats, Floats]:
        """Half the difference of the normal curvatures along both tangents of the frame, and their mixed value."""
        along = self.e / self.E
        return along - self.mean_curvature, -self.F * along / self.v


@checked
def arc_geometry(circular: ArrayLike, psi: ArrayLike, phi: ArrayLike, *, angle_scale: float = 1.0) -> ArcGeometry:
    """Fundamental forms, normal, curvatures and directions at points of surfaces of an arc on an arc.

    Parameters
    ----------
    circular : (..., 5) float
        `ArcArcSurface.circular`: p, a, sigma; its leading shape, psi and phi are broadcast against each other.
    psi, phi : (...) float, radians
        Any angles; points beyond the parallelogram are on the surface, not on the patch.
    angle_scale : float, length per radian
        1 in the paper.

    Raises
    ------
    ValueError
        If a number is not finite, `angle_scale` is not positive, or sigma is 0: that surface is a helix.

    Examples
    --------
    Discs about their reference points make a cylinder. One about another point makes a tube, elliptic where its own
    centre is nearer to the obstacle than the reference point is, with K > 0.

    >>> float(arc_geometry([0, 0, 0, 0, 2], 0, 0).mean_curvature)
    -0.25
    >>> arc_geometry([0, 0, 1, 0, 2], [0, np.pi / 2, np.pi], 0).gaussian_curvature.round(9) + 0.0
    array([-0.5,  0. ,  0.5])
    """
    w = check_scale(angle_scale)
    rows, psi, phi = read_circular(circular), finite("psi", psi), finite("phi", phi)
    psi, phi, *columns = np.broadcast_arrays(psi, phi, *np.moveaxis(rows, -1, 0))
    ax, ay, sigma = columns[2:]
    c, s = _along_and_across(ax, ay, psi - phi)
    square = ax * ax + ay * ay + w * w
    D = np.hypot(w, s)
    e, g = -sigma * w / D, w * c / D
    zero, ux, uy, sign = np.zeros_like(D), np.cos(psi), np.sin(psi), np.sign(sigma)
    first = np.stack([-sign * uy, sign * ux, zero], axis=-1)
    # S_phi = (V, w), V = s u + c' u' with u' along psi; across psi remains (s u, w)
    second = np.stack([s * ux / D, s * uy / D, w / D], axis=-1)
    normal = np.stack([w * ux / D, w * uy / D, -s / D], axis=-1)
    frame = np.stack([first, second, normal], axis=-2)
    K, H = -w * w * c / (sigma * D**4), w * (sigma * c - square) / (2 * sigma * D**3)
    return ArcGeometry(sigma * sigma, -sigma * c, square, e, zero, g, np.abs(sigma) * D, frame, K, H)


@checked
def parabolic_angles(surface: ArcArcSurface) -> tuple[float, ...]:
    """Return the two angles chi = psi - phi at which K = 0, ascending in [0, 2 pi), in radians.

    Their curves are helices (`ArcArcSurface.rolling_helix`), and part elliptic from hyperbolic points. The tuple is
    empty if the robot's arc is about the reference point: the surface is then a cylinder, and K = 0 everywhere.

    Examples
    --------
    >>> from cfree import Curved
    >>> from cfree.contact import ArcArc, arc_surface
    >>> S = arc_surface(Curved.circle((0, 2), 1), Curved.circle((0, 0), 2), ArcArc(0, 0))
    >>> parabolic_angles(S) == (0.0, math.pi)
    True
    """
    if not any(surface.a):
        return ()
    x, y = map(float, surface.a)
    return tuple(sorted(_turn(angle) for angle in (math.atan2(x, -y), math.atan2(-x, y))))


@checked
def zero_mean_angles(surface: ArcArcSurface, *, angle_scale: Number = 1) -> tuple[float, ...]:
    """Return the angles chi = psi - phi at which the mean curvature is 0, ascending in [0, 2 pi), in radians.

    Parameters
    ----------
    surface : ArcArcSurface
    angle_scale : number
        Length per radian; it is exact, and so is the decision how many angles there are.

    Notes
    -----
    H = 0 means ``sigma |a| cos(delta) = |a|^2 + w^2``. There are two angles if ``|sigma| |a| > |a|^2 + w^2``, one if
    both are equal, else none. So there is none if ``|sigma| < 2 w``.

    Examples
    --------
    >>> from cfree import Curved
    >>> from cfree.contact import ArcArc, arc_surface
    >>> for radius in ("0.99", 1, 2):
    ...     S = arc_surface(Curved.circle((1, 0), 1), Curved.circle((0, 0), radius), ArcArc(0, 0))
    ...     print([round(math.degrees(chi)) for chi in zero_mean_angles(S)])
    []
    [0]
    [48, 312]
    """
    w = to_fraction(angle_scale)
    if w <= 0:
        raise ValueError(f"angle_scale: {angle_scale}; give a length per radian above 0")
    (x, y), least = surface.a, surface.a[0] ** 2 + surface.a[1] ** 2 + w * w
    square = x * x + y * y
    if square == 0:
        return ()
    # |sigma|^2 of two radii with rational squares has one square root
    one, other = surface.robot.signed_square, surface.obstacle.signed_square
    product, sign = abs(one * other), 1 if (one > 0) == (other > 0) else -1
    root = Surd(0, Fraction(2 * sign, product.denominator), product.numerator * product.denominator)
    sigma_square = Surd(abs(one) + abs(other) + root.p, root.q, root.n)
    order = sigma_square.compare(least * least / square)
    if order is Order.BEFORE:
        return ()
    size, direction = math.sqrt(square), math.atan2(float(y), float(x)) + (math.pi if surface.sign < 0 else 0.0)
    if order is Order.SAME:
        return (_turn(direction),)
    away = math.acos(min(1.0, float(least) / (abs(float(surface.circular[4])) * size)))
    return tuple(sorted((_turn(direction - away), _turn(direction + away))))


@dataclass(frozen=True, eq=False, repr=False)
class ArcLine(Value):
    """Points of lines of curvature; see `line_of_curvature`.

    Attributes
    ----------
    psi, phi : (...) float64
        Coordinates on the surface.
    xi : (...) float64, radians
        Direction there, from S_psi towards increasing phi.
    error : (...) float64
        Distance by which halving the steps has moved the point, as a length.
    """

    psi: Floats
    phi: Floats
    xi: Floats
    error: Floats


@checked
def line_of_curvature(
    circular: ArrayLike, psi: ArrayLike, phi: ArrayLike, length: ArrayLike, family: Literal["least", "greatest"],
    *, angle_scale: float = 1.0,
) -> ArcLine:  # fmt: skip
    """Follow lines of curvature of surfaces of an arc on an arc from points, over lengths.

    Parameters
    ----------
    circular : (..., 5) float
        `ArcArcSurface.circular`; all arguments are broadcast against each other.
    psi, phi : (...) float, radians
        Starting point.
    length : (...) float
        Length in the metric dx^2 + dy^2 + angle_scale^2 dtheta^2; backwards if negative.
    family : {"least", "greatest"}
        Lines along the least or the greatest normal curvature.

    Notes
    -----
    Their slopes m = dpsi / dphi solve ``sigma c m^2 - (sigma c + |a|^2 + w^2) m + c^2 = 0``, whose discriminant is
    positive: both families cover the surface without singularities. As m depends on psi - phi alone, all lines of one
    family are congruent. Runge and Kutta's method of order four, with steps halved until that moves points less than
    1e-10 of the longest length.

    Examples
    --------
    On a cylinder the circle is a line of curvature.

    >>> line = line_of_curvature([0, 0, 0, 0, 2], 0, 0, np.pi, "least")
    >>> float(line.psi.round(9)), float(line.phi)
    (1.570796327, 0.0)
    """
    w, rows = check_scale(angle_scale), read_circular(circular)
    start = [finite(name, values) for name, values in (("psi", psi), ("phi", phi), ("length", length))]
    shape = np.broadcast_shapes(rows.shape[:-1], *(values.shape for values in start))
    rows = np.broadcast_to(rows, (*shape, 5))
    psi, phi, length = (np.broadcast_to(values, shape).astype(np.float64) for values in start)
    which = 0 if family == "least" else 1

    def slope(state: Floats, before: Floats) -> tuple[Floats, Floats]:
        forms = arc_geometry(rows, state[0], state[1], angle_scale=w)
        xi = forms.principal_directions[..., which]
        xi = xi + math.pi * np.round((before - xi) / math.pi)  # the one of two opposite directions that goes on
        D = forms.v / np.sqrt(forms.E)
        turn = np.sin(xi) / D
        along = (np.cos(xi) - forms.F / np.sqrt(forms.E) * turn) / np.sqrt(forms.E)
        return np.stack([along, turn]), xi

    def run(steps: int) -> Floats:
        state, h = np.stack([psi, phi]), length / steps
        xi = arc_geometry(rows, psi, phi, angle_scale=w).principal_directions[..., which]
        for _ in range(steps):
            a, xi = slope(state, xi)
            b, middle = slope(state + h / 2 * a, xi)
            c, middle = slope(state + h / 2 * b, middle)
            d, _ = slope(state + h * c, middle)
            state = state + h / 6 * (a + 2 * b + 2 * c + d)
        _, xi = slope(state, xi)
        return np.stack([*state, xi])

    enough, steps, coarse = CLOSE * float(np.abs(length).max(initial=0.0)), 16, run(8)
    while True:
        fine = run(steps)
        forms = arc_geometry(rows, fine[0], fine[1], angle_scale=w)
        dpsi, dphi, _ = fine - coarse
        error: Floats = np.sqrt(np.maximum(forms.E * dpsi**2 + 2 * forms.F * dpsi * dphi + forms.G * dphi**2, 0.0))
        if error.max(initial=0.0) <= enough or steps == MOST_STEPS:
            return ArcLine(fine[0], fine[1], fine[2], error)
        coarse, steps = fine, 2 * steps


def read_circular(circular: ArrayLike) -> Floats:
    """Check rows of five numbers p, a, sigma.

    Examples
    --------
    >>> read_circular([0, 0, 1, 0, 0])
    Traceback (most recent call last):
        ...
    ValueError: circular: row [0. 0. 1. 0. 0.] has sigma 0, a helix and no surface; see arc_curves()
    """
    rows = finite("circular", circular)
    if rows.ndim == 0 or rows.shape[-1] != 5:
        raise ValueError(f"circular: shape {rows.shape}; give rows p, a, sigma of five numbers: ArcArcSurface.circular")
    if (rows[..., 4] == 0).any():
        row = rows[rows[..., 4] == 0][0]
        raise ValueError(f"circular: row {row} has sigma 0, a helix and no surface; see arc_curves()")
    return rows


def _along_and_across(ax: Floats, ay: Floats, chi: Floats) -> tuple[Floats, Floats]:
    """R(phi) a . u(psi), and V . u(psi) with V = -J R(phi) a: the parts c and s at chi = psi - phi."""
    x, y = np.cos(chi), np.sin(chi)
    return ax * x + ay * y, ay * x - ax * y


def _turn(angle: float) -> float:
    """Reduce an angle to [0, 2 pi)."""
    turned = angle % math.tau
    return turned if turned < math.tau else 0.0
