"""Paths, or proofs that there are none: the core finds poses and surfaces, here they become objects.

`planner` asks it, for one pair of poses; `goals`, `many` and `clearance` ask several times. Nothing but a check of the
core says that a motion is free.
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
