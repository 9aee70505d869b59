"""Closed meshes: one triangle on each side of every edge, and the Euler numbers of the cells."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from cfree.forbidden.boundary import Boundary
from cfree.forbidden.mesh import Mesh


def check_closed(mesh: Mesh, result: Boundary) -> None:
    """Every edge has one triangle on each side, and every surface the Euler number of its cells."""
    cells = result.complex
    assert np.isfinite(mesh.vertices).all()
    low, high = mesh.seam.T
    assert np.array_equal(mesh.vertices[low, :2], mesh.vertices[high, :2])
    if len(mesh.seam):
        assert set(mesh.vertices[low, 2]) == {-0.5 * math.pi * mesh.angle_scale}
        assert set(mesh.vertices[high, 2]) == {1.5 * math.pi * mesh.angle_scale}
    assert len(np.unique(low)) == len(np.unique(high)) == len(mesh.seam)
    identified = np.arange(len(mesh.vertices))
    identified[high] = low
    corners = identified[mesh.triangles]
    start, end = corners.ravel(), np.roll(corners, -1, axis=1).ravel()
    assert np.all(start != end)
    edges = np.stack([start, end], axis=1)
    found, count = np.unique(edges, axis=0, return_counts=True)
    assert np.all(count == 1)
    assert np.array_equal(found, np.unique(edges[:, ::-1], axis=0))
    component = cells.component[mesh.trapezoid]
    of_vertex = np.full(len(mesh.vertices), -1)
    of_vertex[corners] = component[:, None]
    assert np.all(of_vertex[corners] == component[:, None])
    counts = (of_vertex[of_vertex >= 0], np.repeat(component, 3), component)
    v, h, f = (np.bincount(x, minlength=cells.components) for x in counts)
    assert np.array_equal(v - h // 2 + f, cells.euler)
    check_fans(corners)


def check_fans(corners: Any) -> None:
    """The triangles at each vertex are one fan: nothing is pinched."""
    after = {}
    for a, b, c in corners.tolist():
        after[a, b], after[b, c], after[c, a] = c, a, b
    seen: set[tuple[int, int]] = set()
    fans: dict[int, int] = {}
    for a, b in after:
        if (a, b) in seen:
            continue
        fans[a] = fans.get(a, 0) + 1
        while (a, b) not in seen:
            seen.add((a, b))
            b = after[a, b]
    assert set(fans.values()) <= {1}
