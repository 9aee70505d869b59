"""The free space: its cells, and location of poses in them."""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.free.space import Cell as Cell

__getattr__, __dir__, __all__ = lazy_names(__name__, {"space": "Cell"})
