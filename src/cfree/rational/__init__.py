"""Rational model of the configuration space: the paper's section 5.

`model` has contacts in exact fractions, `bezier` has patches as rational Bezier surfaces, `arcs` those of an arc on an
arc.
"""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.rational.arcs import BezierNet as BezierNet
    from cfree.rational.arcs import arc_bezier_net as arc_bezier_net
    from cfree.rational.bezier import BezierPatch as BezierPatch
    from cfree.rational.bezier import bezier_patch as bezier_patch
    from cfree.rational.bezier import bezier_patches as bezier_patches
    from cfree.rational.bezier import save_bezier as save_bezier
    from cfree.rational.model import RationalHelix as RationalHelix
    from cfree.rational.model import RationalRange as RationalRange
    from cfree.rational.model import RationalSegment as RationalSegment
    from cfree.rational.model import RationalSurface as RationalSurface
    from cfree.rational.model import rational_edge_edge_surface as rational_edge_edge_surface
    from cfree.rational.model import rational_helix as rational_helix
    from cfree.rational.model import rational_range as rational_range
    from cfree.rational.model import rational_segment as rational_segment
    from cfree.rational.model import rational_surface as rational_surface
    from cfree.rational.model import to_geometrical as to_geometrical
    from cfree.rational.model import to_rational as to_rational

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "arcs": "BezierNet arc_bezier_net",
        "bezier": "BezierPatch bezier_patch bezier_patches save_bezier",
        "model": "RationalHelix RationalRange RationalSegment RationalSurface rational_edge_edge_surface "
        "rational_helix rational_range rational_segment rational_surface to_geometrical to_rational",
    },
)
