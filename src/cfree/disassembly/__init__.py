"""Taking parts out of an assembly: which part can leave, in which order, and what blocks it."""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.disassembly.assembly import Assembly as Assembly
    from cfree.disassembly.leaving import Blocking as Blocking
    from cfree.disassembly.leaving import Leaving as Leaving
    from cfree.disassembly.leaving import can_leave as can_leave
    from cfree.disassembly.leaving import missing_gap as missing_gap
    from cfree.disassembly.leaving import what_blocks as what_blocks
    from cfree.disassembly.order import Disassembly as Disassembly
    from cfree.disassembly.order import removal_order as removal_order

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "assembly": "Assembly",
        "leaving": "Blocking Leaving can_leave missing_gap what_blocks",
        "order": "Disassembly removal_order",
    },
)
