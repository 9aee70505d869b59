"""Paths: quick searches first, then walks on the boundary of a cell, and ways through exact fits.

`planner` puts them together; `rrt_connect` joins random poses, `boundary_walk` follows trapezoids, `exact_fits` leads
through places without room, all three in the core. Nothing but a check of the core says that a motion is free.
"""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.planning.separation import Pieces as Pieces

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "separation": "Pieces",
    },
)
