"""A scene's shapes in the core's form."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fractions import Fraction

    from cfree.polygons.polygon import Polygon


def core_shapes(
    robot: Sequence[Polygon],
    obstacles: Sequence[Polygon],
    workspace: Polygon | None,
    bounds: Sequence[Fraction] | None,
) -> tuple[Any, ...]:
    """Return polygons and bounds in the core's form."""
    return (
        [part._handle for part in robot],
        [obstacle._handle for obstacle in obstacles],
        workspace and workspace._handle,
        bounds and list(bounds),
    )
