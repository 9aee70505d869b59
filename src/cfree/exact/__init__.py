"""Exact numbers: rationals, orientations, surds, algebraic numbers, poses."""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.exact.angle_interval import AlgebraicAngle as AlgebraicAngle
    from cfree.exact.angle_interval import AngleInterval as AngleInterval
    from cfree.exact.surd import ExactAngle as ExactAngle
    from cfree.exact.surd import Surd as Surd

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "angle_interval": "AlgebraicAngle AngleInterval",
        "surd": "ExactAngle Surd",
    },
)
