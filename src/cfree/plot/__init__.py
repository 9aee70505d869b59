"""Pictures of boundaries, paths and answers, and the drawing of faces from back to front."""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.plot.answer import picture as picture
    from cfree.plot.answer import plot_path_space as plot_path_space
    from cfree.plot.blockers import plot_blockers as plot_blockers
    from cfree.plot.boundary import plot_boundary as plot_boundary
    from cfree.plot.boundary import plot_overview as plot_overview
    from cfree.plot.boundary import plot_slice as plot_slice
    from cfree.plot.boundary import plot_workspace as plot_workspace
    from cfree.plot.cages import plot_cage as plot_cage
    from cfree.plot.cages import plot_disassembly as plot_disassembly
    from cfree.plot.cages import plot_immobility as plot_immobility
    from cfree.plot.cages import plot_leaving as plot_leaving
    from cfree.plot.depths import plot_depths as plot_depths
    from cfree.plot.depths import plot_faces as plot_faces
    from cfree.plot.development import plot_development as plot_development
    from cfree.plot.intersections import plot_intersection as plot_intersection
    from cfree.plot.loops import plot_loops as plot_loops
    from cfree.plot.paint import painted as painted
    from cfree.plot.path import plot_path as plot_path
    from cfree.plot.rational import plot_models as plot_models
    from cfree.plot.reach import plot_audit as plot_audit
    from cfree.plot.reach import plot_reach as plot_reach

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "answer": "picture plot_path_space",
        "blockers": "plot_blockers",
        "boundary": "plot_boundary plot_overview plot_slice plot_workspace",
        "cages": "plot_cage plot_disassembly plot_immobility plot_leaving",
        "depths": "plot_depths plot_faces",
        "development": "plot_development",
        "intersections": "plot_intersection",
        "loops": "plot_loops",
        "paint": "painted",
        "path": "plot_path",
        "rational": "plot_models",
        "reach": "plot_audit plot_reach",
    },
)
