"""Paths, or proofs that there are none, made from the poses and surfaces that the core finds.

`plan`, `planner` and `many` are public: they check and convert all arguments. `pose_planner` calls the core for one
pair of poses; `goals`, `clearance` and `curved` call it several times. Every motion of a path is proved free by a check
of the core.
"""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.planning.separation import Pieces as Pieces
    from cfree.planning.unreachable import BoxGrid as BoxGrid
    from cfree.planning.widest_way import NarrowPlace as NarrowPlace
    from cfree.scene.goals import Moved as Moved

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "moved_ends": "Moved",
        "separation": "Pieces",
        "unreachable": "BoxGrid",
        "widest_way": "NarrowPlace",
    },
)
