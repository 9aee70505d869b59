"""Cages: bodies that fingers hold without gripping them; how much room is left, and immobility."""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.caging.cage import Cage as Cage
    from cfree.caging.cage import is_caged as is_caged
    from cfree.caging.contacts import Contact as Contact
    from cfree.caging.contacts import Gap as Gap
    from cfree.caging.critical import Critical as Critical
    from cfree.caging.critical import Puncture as Puncture
    from cfree.caging.critical import critical_clearance as critical_clearance
    from cfree.caging.critical import critical_size as critical_size
    from cfree.caging.critical import critical_spread as critical_spread
    from cfree.caging.fewest import Escape as Escape
    from cfree.caging.fewest import FewestFingers as FewestFingers
    from cfree.caging.fewest import fewest_fingers as fewest_fingers
    from cfree.caging.immobile import Immobility as Immobility
    from cfree.caging.immobile import immobility as immobility

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "cage": "Cage is_caged",
        "contacts": "Contact Gap",
        "critical": "Critical Puncture critical_clearance critical_size critical_spread",
        "fewest": "Escape FewestFingers fewest_fingers",
        "immobile": "Immobility immobility",
    },
)
