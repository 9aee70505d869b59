"""The boundary of the forbidden space: trimmed contact patches, their complex, slices and meshes."""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.forbidden.cell_complex import CellComplex as CellComplex
    from cfree.forbidden.mesh import Mesh as Mesh
    from cfree.forbidden.slice import Slice as Slice

__getattr__, __dir__, __all__ = lazy_names(__name__, {"cell_complex": "CellComplex", "mesh": "Mesh", "slice": "Slice"})
