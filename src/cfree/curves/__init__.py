"""Shapes with round edges: circles, ellipses, arcs, Bézier curves and splines, and polygons grown by discs.

`Curved` is one of them; `cfree.Scene` takes it wherever it takes a polygon.
"""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.curves.curved import Curved as Curved
    from cfree.curves.rings import Arc as Arc
    from cfree.curves.rings import Bezier as Bezier
    from cfree.curves.rings import Circle as Circle
    from cfree.curves.rings import Ellipse as Ellipse
    from cfree.curves.rings import Spline as Spline

__getattr__, __dir__, __all__ = lazy_names(__name__, {"curved": "Curved", "rings": "Arc Bezier Circle Ellipse Spline"})
