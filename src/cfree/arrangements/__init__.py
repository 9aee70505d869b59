"""Intersections of contact surfaces before any trimming, and the arrangement of the boundaries of all pairs.

`intersection` has the curve of two surfaces, `triple` the poses on three, `census` the poses of all triples.
`arrangement` has every vertex, edge, face and cell that the boundaries of all pairs form, with the depth of each cell.
"""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.arrangements.arranged import Arrangement as Arrangement
    from cfree.arrangements.arranged import arrangement as arrangement
    from cfree.arrangements.curve import IntersectionCurve as IntersectionCurve
    from cfree.arrangements.intersections import Intersection as Intersection
    from cfree.arrangements.intersections import SharedLine as SharedLine
    from cfree.arrangements.intersections import intersection as intersection
    from cfree.arrangements.regions import planar_cells as planar_cells
    from cfree.arrangements.statistics import ArrangementStatistics as ArrangementStatistics
    from cfree.arrangements.statistics import DepthCell as DepthCell
    from cfree.arrangements.triple_census import Census as Census
    from cfree.arrangements.triple_census import census as census
    from cfree.arrangements.triples import Triple as Triple
    from cfree.arrangements.triples import TripleContact as TripleContact
    from cfree.arrangements.triples import triple as triple
    from cfree.arrangements.written import arrangement_json as arrangement_json
    from cfree.arrangements.written import save_arrangement as save_arrangement

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "arranged": "Arrangement arrangement",
        "triple_census": "Census census",
        "curve": "IntersectionCurve",
        "intersections": "Intersection SharedLine intersection",
        "regions": "planar_cells",
        "statistics": "ArrangementStatistics DepthCell",
        "written": "arrangement_json save_arrangement",
        "triples": "Triple TripleContact triple",
    },
)
