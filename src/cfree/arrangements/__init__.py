"""Contact surfaces among each other, before any trimming.

`intersection` has the curve of two surfaces, `triple` the poses on three.
"""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.arrangements.curve import IntersectionCurve as IntersectionCurve
    from cfree.arrangements.intersections import Intersection as Intersection
    from cfree.arrangements.intersections import SharedLine as SharedLine
    from cfree.arrangements.intersections import intersection as intersection
    from cfree.arrangements.triples import Triple as Triple
    from cfree.arrangements.triples import TripleContact as TripleContact
    from cfree.arrangements.triples import triple as triple

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "curve": "IntersectionCurve",
        "intersections": "Intersection SharedLine intersection",
        "triples": "Triple TripleContact triple",
    },
)
