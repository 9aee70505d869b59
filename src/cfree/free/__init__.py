"""The free space: its cells and their homology, and location of poses in them."""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.free.homology import Homology as Homology
    from cfree.free.loops import Loop as Loop
    from cfree.free.loops import surface_loops as surface_loops
    from cfree.free.space import Cell as Cell

__getattr__, __dir__, __all__ = lazy_names(
    __name__, {"homology": "Homology", "space": "Cell", "loops": "Loop surface_loops"}
)
