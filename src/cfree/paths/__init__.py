"""Paths: sequences of motions, their lengths, and their clearance."""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.paths.clearance import Clearance as Clearance
    from cfree.paths.driven import Driven as Driven
    from cfree.paths.driving import Drivable as Drivable
    from cfree.paths.preferences import Unwanted as Unwanted
    from cfree.paths.ramps import Ramp as Ramp
    from cfree.paths.stops import Stop as Stop
    from cfree.paths.timing import Timed as Timed

_HOMES = {"clearance": "Clearance", "driven": "Driven", "driving": "Drivable", "preferences": "Unwanted"}
_HOMES |= {"ramps": "Ramp", "stops": "Stop", "timing": "Timed"}
__getattr__, __dir__, __all__ = lazy_names(__name__, _HOMES)
