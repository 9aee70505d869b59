"""Meshes coloured by properties of each triangle: curvatures, contact types, cells."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from cfree.arguments import checked
from cfree.forbidden.boundary import Boundary
from cfree.forbidden.mesh import Mesh
from cfree.free.space import FreeSpace
from cfree.geometry.local import LocalGeometry, local_geometry
from cfree.libraries import Floats
from cfree.palette import CATEGORIES, DIVERGING, SEQUENTIAL


@checked
def painted(mesh: Mesh, space: FreeSpace, by: Literal["K", "H", "contact", "cell"]) -> Mesh:
    """Return the same mesh with other colours, for `cfree.save` as ``.glb``, ``.ply`` or ``.obj``.

    Parameters
    ----------
    mesh : Mesh
        A mesh of ``space.surfaces``.
    space : FreeSpace
    by : "K", "H", "contact" or "cell"
        Coloured property: the Gaussian curvature, from dark blue where it is least to yellow where it is 0; the mean
        curvature, from blue below 0 over grey to red above; the contact type; or the cell that the surface bounds,
        eight colours in turn.

    Returns
    -------
    Mesh

    Raises
    ------
    ValueError
        If the mesh has other trapezoids than the free space.

    Notes
    -----
    Curvatures are those of the contact surface at the triangle's middle, in the mesh's own metric (Lemma 2).

    Examples
    --------
    >>> import cfree
    >>> scene = cfree.Scene(robot=[(0, 0), (2, 0), (0, 1)], obstacles=[[(5, 5), (8, 5), (6, 7)]])
    >>> space = cfree.free_space(cfree.boundary(scene))
    >>> mesh = painted(space.surfaces.mesh(0.05), space, "K")
    >>> len(np.unique(mesh.colours[mesh.kind == 1], axis=0)), len(np.unique(mesh.colours[mesh.kind == 2], axis=0)) > 9
    (1, True)
    """
    patch = space.surfaces.trapezoids.patch
    if mesh.trapezoid.max(initial=-1) >= len(patch) or not np.array_equal(mesh.patch, patch[mesh.trapezoid]):
        raise ValueError("mesh: not of this free space; give a mesh of its surfaces: space.surfaces.mesh(error)")
    if by == "contact":
        return replace(mesh, paint=None)
    if by == "cell":
        return replace(mesh, paint=_categories()[space.cell_of[space.component[mesh.trapezoid]] % len(CATEGORIES)])
    middles = _middles(mesh, space.surfaces)
    if by == "K":
        K = middles.gaussian_curvature
        return replace(mesh, paint=_mapped(SEQUENTIAL, 1 - K / min(float(K.min(initial=0.0)), -1e-300)))
    H = middles.mean_curvature
    most = max(float(np.abs(H).max(initial=0.0)), 1e-300)
    return replace(mesh, paint=_mapped(DIVERGING, (1 + H / most) / 2))


def _middles(mesh: Mesh, boundary: Boundary) -> LocalGeometry:
    """Return the local geometry of the surfaces at the middles of the triangles."""
    rows, middle = boundary.ruled[mesh.patch], mesh.vertices[mesh.triangles].mean(axis=1)
    phi = middle[:, 2] / mesh.angle_scale
    p, q, a, g = (rows[:, k : k + 2] for k in (0, 2, 4, 6))
    ruling, arm = q - _turned(g, phi), p - _turned(a, phi)
    t = ((middle[:, :2] - arm) * ruling).sum(axis=1) / (ruling**2).sum(axis=1)
    return local_geometry(rows, t, phi, angle_scale=mesh.angle_scale)


def _turned(vectors: Floats, phi: Floats) -> Floats:
    c, s = np.cos(phi), np.sin(phi)
    x, y = vectors.T
    return np.column_stack([c * x - s * y, s * x + c * y])


def _mapped(name: str, values: NDArray[np.generic]) -> NDArray[np.uint8]:
    """Map values from 0 to 1 to colours."""
    import matplotlib

    colours: NDArray[np.uint8] = matplotlib.colormaps[name](values, bytes=True)
    return colours.reshape(-1, 4)


def _categories() -> NDArray[np.uint8]:
    from matplotlib.colors import to_rgba_array

    colours: NDArray[np.uint8] = np.rint(255 * to_rgba_array(CATEGORIES)).astype(np.uint8)
    return colours
