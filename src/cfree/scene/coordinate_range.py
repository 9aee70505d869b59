"""The documented range of a scene's coordinates, checked once, where a scene is made.

Coordinates become integers over one common denominator. If these have few enough bits (``coordinate_range.hpp``),
the core's doubles neither overflow nor underflow, and its exact integers stay fast. Lengths from 1e-150 to 1e150 may
meet in one scene.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import cfree._core as _core
from cfree.scene.core_shapes import core_shapes

if TYPE_CHECKING:
    from fractions import Fraction

    from cfree.polygons.polygon import Polygon

Path = tuple[str | int, ...]  # as in a scene file


def range_fault(
    robot: Sequence[Polygon],
    obstacles: Sequence[Polygon],
    workspace: Polygon | None,
    bounds: Sequence[Fraction] | None,
) -> tuple[Path, str] | None:
    """Return the first place outside the range, and a message; None if there is none.

    Examples
    --------
    >>> from cfree import Polygon
    >>> far = Polygon([(0, 0), ("1e200", 0), (0, 1)])
    >>> range_fault([far], [], None, None)  # doctest: +ELLIPSIS
    (('robot', 0), 'the coordinate 1e200 is larger than 1e150; scale the scene')
    """
    fault = _core.range_fault(*core_shapes(robot, obstacles, workspace, bounds))
    if fault is None:
        return None
    kind, index, message = fault
    return ((kind,) if index < 0 else (kind, index)), message
