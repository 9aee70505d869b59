"""Local geometry of contact surfaces: fundamental forms, normal, curvatures, directions.

Paper, section 4, for both kinds of surface and for many at once. A surface is given as in `cfree.contact.surface`,

    S(t, phi) = (p + t q - R(phi) (a + t g), w phi),    one of q and g is 0,

by eight numbers p, q, a, g: `Surface.ruled`, or rows of `Boundary.ruled`. The third coordinate is also a length:
w = angle_scale is the length of one radian, 1 in the paper. All t and phi are allowed. Values outside [0, 1] and
outside the contact's angle range belong to the surface, not to the patch.

With S_t = (U, 0), S_phi = (V, w), L = |U|, and V = k along U and s across it, everything follows from L, s, k and w:

    E = L^2    F = L k    G = w^2 + s^2 + k^2    v = sqrt(E G - F^2) = L sqrt(w^2 + s^2)
    e = 0      f = -w |g|^2 / v                  g = -w F / v

On e-v surfaces s is the signed position of the contact point along the robot's edge, from the foot of the perpendicular
from the reference point, and |k| is that perpendicular's length. On v-e surfaces s and k change with phi, and f is 0.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

import cfree._core as _core
from cfree.arguments import checked
from cfree.exact.number import finite
from cfree.geometry.ruled import Floats, check_scale, read_ruled
from cfree.value import Value


@dataclass(frozen=True, eq=False, repr=False)
class LocalGeometry(Value):
    """First and second fundamental forms at points of contact surfaces, and derived quantities.

    Every array has the common shape (...) of the input that made it; see `local_geometry`.

    Attributes
    ----------
    E, F, G : (...) float64
        First fundamental form: S_t.S_t in length^2, S_t.S_phi in length^2 / radian, S_phi.S_phi in length^2 / radian^2.
    e, f, g : (...) float64
        Second fundamental form, for the normal towards the free side, in length, length / radian, length / radian^2.
    v : (...) float64
        sqrt(E G - F^2), the area element, in length^2 / radian; never 0.
    frame : (..., 3, 3) float64
        Rows: the unit vector along the ruling, the unit tangent across it with increasing phi, the unit normal. The
        coordinates are x, y, angle_scale * theta.
    gaussian_curvature : (...) float64
        K of Lemma 2, in 1 / length^2: negative on e-v surfaces, 0 on v-e surfaces.
    mean_curvature : (...) float64
        H of Lemma 2, in 1 / length, for the normal towards the free side.
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
        """Unit normal S_t x S_phi / v, (..., 3), towards the free side of a patch.

        Its two first coordinates are along the normal n of the contact line; its third is the effect of a rotation.
        """
        return self.frame[..., 2, :]

    @checked
    def normal_curvature(self, xi: ArrayLike) -> Floats:
        """Normal curvature in a direction, eq. (10), in 1 / length.

        Parameters
        ----------
        xi : (...) float, radians
            Angle from the ruling, S_t, towards increasing phi.
        """
        xi = finite("xi", xi)
        sine, cosine = np.sin(xi), np.cos(xi)
        kappa: Floats = 2 * sine * (self.mean_curvature * sine + self.f / self.v * cosine)
        return kappa

    @property
    def asymptotic_directions(self) -> Floats:
        """Angles xi in [0, pi] at which the normal curvature vanishes, (..., 2): the ruling's, and another.

        The other is arctan(2 v / F) on e-v surfaces, pi / 2 where F = 0. On v-e surfaces it is the ruling again, as 0
        or pi. Where also H = 0, the surface is flat to second order and every direction is asymptotic.
        """
        other = 2 * self.principal_directions[..., 0]
        return np.stack([np.zeros_like(other), other], axis=-1)

    @property
    def principal_directions(self) -> Floats:
        """Angles xi_1 in [0, pi / 2] and xi_2 = xi_1 + pi / 2 of least and greatest normal curvature, (..., 2).

        On e-v surfaces 2 xi_1 is the angle of the vector (F, 2 v): arctan(2 v / F), or pi / 2 where F = 0. Where F < 0,
        the paper's arctan is negative, and its xi_1 is xi_2 here.
        """
        xi = np.arctan2(-self.f / self.v, self.mean_curvature) / 2
        return np.stack([xi, xi + math.pi / 2], axis=-1)

    @property
    def principal_curvatures(self) -> Floats:
        """Normal curvatures kappa_1 <= kappa_2 in the principal directions, (..., 2), in 1 / length."""
        H, root_of_minus_K = self.mean_curvature, self.f / self.v
        large = H + np.copysign(np.hypot(H, root_of_minus_K), H)  # nothing cancels
        small = -np.divide(root_of_minus_K**2, large, out=np.zeros_like(large), where=large != 0)
        return np.stack([np.minimum(large, small), np.maximum(large, small)], axis=-1)

    @property
    def dupin_conic(self) -> Floats:
        """Coefficients (A, B, C) of Dupin's indicatrix A X^2 + 2 B X Y + C Y^2 = +-1, (..., 3), in 1 / length.

        X runs along the ruling, Y across it, both in the tangent plane. A = 0, as rulings are asymptotic. The conic is
        two hyperbolas with the same asymptotes on e-v surfaces, and two lines along the ruling on v-e surfaces; it is
        empty where these are flat.
        """
        H, B = self.mean_curvature, self.f / self.v
        return np.stack([np.zeros_like(H), B, 2 * H], axis=-1)

    @checked
    def dupin_radius(self, xi: ArrayLike) -> Floats:
        """Radius of Dupin's indicatrix in a direction, in sqrt(length): 1 / sqrt(abs(normal curvature)), or infinite.

        Parameters
        ----------
        xi : (...) float, radians
            Angle from the ruling, towards increasing phi.
        """
        bend = np.sqrt(np.abs(self.normal_curvature(xi)))
        radius: Floats = np.divide(1.0, bend, out=np.full_like(bend, np.inf), where=bend > 0)
        return radius

    @checked
    def tangent(self, xi: ArrayLike) -> Floats:
        """Unit tangent in the direction xi (radians, from the ruling), (..., 3), in x, y, angle_scale * theta."""
        xi = finite("xi", xi)[..., None]
        return np.cos(xi) * self.frame[..., 0, :] + np.sin(xi) * self.frame[..., 1, :]


@checked
def local_geometry(ruled: ArrayLike, t: ArrayLike, phi: ArrayLike, *, angle_scale: float = 1.0) -> LocalGeometry:
    """Fundamental forms, normal, curvatures and directions at points of contact surfaces.

    Parameters
    ----------
    ruled : (..., 8) float
        `Surface.ruled`, or rows of `Boundary.ruled`; its leading shape, t and phi are broadcast against each other.
    t : (...) float
        Parameter along the ruling; beyond [0, 1] the points are on the surface, not on the patch.
    phi : (...) float, radians
        The same holds beyond the contact's angle range. On e-v surfaces only the frame depends on it.
    angle_scale : float, length per radian
        1 in the paper.

    Returns
    -------
    LocalGeometry

    Raises
    ------
    ValueError
        If a number is not finite, `angle_scale` is not positive, or a row is no contact surface.

    Notes
    -----
    Section 4, Lemma 2 and eq. (10) are the case of e-v surfaces and angle_scale 1. Time is linear in the number of
    points.

    Examples
    --------
    >>> from cfree.contact import EdgeVertex, contact_surface
    >>> from cfree import Polygon
    >>> square = Polygon([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    >>> S = contact_surface(square, square, EdgeVertex(0, 2))
    >>> local = local_geometry(S.ruled, [0, 0.5, 1], 0)
    >>> local.gaussian_curvature
    array([-0.25, -1.  , -0.25])
    >>> local.mean_curvature
    array([0.1767767, 0.5      , 0.1767767])
    """
    w = check_scale(angle_scale)
    rows, t, phi = np.concatenate(read_ruled(ruled), axis=-1), finite("t", t), finite("phi", phi)
    shape = np.broadcast_shapes(rows.shape[:-1], t.shape, phi.shape)
    flat = np.ascontiguousarray(np.broadcast_to(rows, (*shape, 8)).reshape(-1, 8))
    t, phi = (np.ascontiguousarray(np.broadcast_to(values, shape).reshape(-1)) for values in (t, phi))
    table = _core.local_geometry(flat, t, phi, w).reshape(*shape, 18)
    forms, frame, curvatures = np.split(table, [7, 16], axis=-1)
    E, F, G, e, f, g, v = np.moveaxis(forms, -1, 0)
    return LocalGeometry(E, F, G, e, f, g, v, frame.reshape(*shape, 3, 3), curvatures[..., 0], curvatures[..., 1])
