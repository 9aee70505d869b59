"""Development of v-e contact surfaces: unroll them into the plane.

Paper, section 3.1: such a surface is a cylinder. Its rulings all have the direction of E_j, and its cross-section is a
sinusoid: at phi the line is R(phi) a away from E_j. In the plane, a ruling becomes a vertical segment of the same
length, and the distance of two rulings is the length of the sinusoid between them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from cfree.arguments import checked
from cfree.exact.number import finite
from cfree.geometry.elliptic import second_kind
from cfree.geometry.ruled import Floats, Ruled, check_scale, read_ruled


@checked
def develop(ruled: ArrayLike, t: ArrayLike, phi: ArrayLike, *, angle_scale: float = 1.0) -> Floats:
    """Unroll points of v-e surfaces into the plane, by an isometry.

    Parameters
    ----------
    ruled : (..., 8) float
        `Surface.ruled` or rows of `Boundary.ruled`, of v-e contacts; broadcast against t and phi.
    t : (...) float
        Parameter along the ruling; beyond [0, 1] the points are on the surface, not on the patch.
    phi : (...) float, radians
        Any values; in the contact's angle range the points are on the patch. The surface does not close after a turn.
    angle_scale : float, length per radian

    Returns
    -------
    (..., 2) float64
        Lengths: across the rulings, from the ruling of phi = 0, and along them, from the line through the origin.

    Raises
    ------
    ValueError
        If a surface belongs to an e-v contact: it has K < 0, so no part of it is isometric to a part of the plane. Also
        if a number is not finite, or `angle_scale` is not positive.

    Notes
    -----
    With the unit vector u of E_j the point is (integral of sqrt(w^2 + (u.R(phi) a)^2) dphi, u.(p + t q - R(phi) a)).
    Its derivatives have the products E, F and G of the surface. The integral is elliptic, of the second kind.

    Examples
    --------
    >>> from cfree import Polygon
    >>> from cfree.contact import VertexEdge, contact_surface
    >>> S = contact_surface(Polygon([(0, 0), (1, 0), (0, 1)]), Polygon([(3, 1), (5, 1), (3, 4)]), VertexEdge(0, 0))
    >>> develop(S.ruled, [0, 1], [0, 0.5])
    array([[0. , 3. ],
           [0.5, 5. ]])
    """
    w = check_scale(angle_scale)
    rows, t, phi = read_ruled(ruled), finite("t", t), finite("phi", phi)
    if rows.is_edge_vertex.any():
        raise ValueError("ruled: a surface of an e-v contact is not developable; give those of v-e contacts")
    u = rows.ruling(phi)
    s, _ = rows.across_and_along(t, phi)  # -u.R(phi) a
    along = u[..., 0] * rows.p[..., 0] + u[..., 1] * rows.p[..., 1] + t * rows.L + s
    return np.stack(np.broadcast_arrays(distance_across(rows, np.zeros(()), phi, w), along), axis=-1)


def distance_across(rows: Ruled, phi_from: Floats, phi_to: Floats, w: float) -> Floats:
    """Length of the cross-section of v-e surfaces between two rulings; values of other surfaces mean nothing.

    Notes
    -----
    ``u.R(phi) a = |a| sin(psi)``, where psi grows with phi.
    """
    (qx, qy), (ax, ay) = (np.moveaxis(vector, -1, 0) for vector in (rows.q, rows.a))
    first = np.arctan2(qx * ax + qy * ay, qy * ax - qx * ay)
    n = (np.hypot(ax, ay) / w) ** 2
    length: Floats = w * (second_kind(first + phi_to, n) - second_kind(first + phi_from, n))
    return length
