"""Analysis of a scene: margins, bottlenecks, blocking obstacles, fits of a part in a hole, reach, floor plans."""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.analysis.audit import Audit as Audit
    from cfree.analysis.audit import Door as Door
    from cfree.analysis.blockers import Blocker as Blocker
    from cfree.analysis.bottleneck import Bottleneck as Bottleneck
    from cfree.analysis.fits import Fit as Fit
    from cfree.analysis.margins import Interval as Interval
    from cfree.analysis.margins import NearestMiss as NearestMiss
    from cfree.analysis.reach_map import ReachMap as ReachMap

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "audit": "Audit Door",
        "blockers": "Blocker",
        "bottleneck": "Bottleneck",
        "fits": "Fit",
        "margins": "Interval NearestMiss",
        "reach_map": "ReachMap",
    },
)
