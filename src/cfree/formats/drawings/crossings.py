"""Refuse rings that cross or touch themselves, if the option `repair` is off."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable

from cfree.errors import InvalidPolygonError
from cfree.formats.drawings.mesh import Mesh


def refuse_crossings(mesh: Mesh, edges: Iterable[int], rings: Collection[int]) -> None:
    """Raise an error if one of the rings visits a point twice.

    Raises
    ------
    InvalidPolygonError
        With the point and the remedy.
    """
    graph = mesh.graph
    degree: dict[tuple[int, int], int] = defaultdict(int)
    for edge in edges:
        for owner, _ in mesh.owners(edge):
            for node in graph.edges[edge]:
                degree[owner, node] += 1
    for (owner, node), count in degree.items():
        if owner in rings and count > 2:
            x, y = graph.place(node)
            raise InvalidPolygonError(
                f"a ring crosses or touches itself at ({x:.6g}, {y:.6g}); --repair fills it by its rule"
            )
