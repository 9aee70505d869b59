"""Rings of round shapes: whole circles and ellipses, or paths of arcs, Bézier curves and splines.

`cfree.Curved` is a shape bounded by such rings; `cfree.Scene` takes it wherever it takes a polygon.
"""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.curves.rings import Arc as Arc
    from cfree.curves.rings import Bezier as Bezier
    from cfree.curves.rings import Circle as Circle
    from cfree.curves.rings import Ellipse as Ellipse
    from cfree.curves.rings import Spline as Spline

__getattr__, __dir__, __all__ = lazy_names(__name__, {"rings": "Arc Bezier Circle Ellipse Spline"})
