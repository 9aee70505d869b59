"""Geometry of contact surfaces: the paper's section 4, for both kinds of surface.

`local` has forms, curvatures and directions at a point; `rulings` has the properties that follow from the rulings.
`integrals` has areas and integrals of K. `curvature_sum` adds up curvature on closed surfaces, and `normals` counts how
often their normals cover the sphere. `development` unrolls v-e surfaces, with `elliptic` integrals. `geodesics` has
straight curves on a surface; `congruence` finds equal helices, surfaces and patches. `kinematic` measures the forbidden
poses of convex shapes; `ruled` reads the eight numbers of a surface. `arcs` has all this for an arc on an arc.
"""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.geometry.arcs import ArcGeometry as ArcGeometry
    from cfree.geometry.arcs import ArcLine as ArcLine
    from cfree.geometry.arcs import arc_geometry as arc_geometry
    from cfree.geometry.arcs import line_of_curvature as line_of_curvature
    from cfree.geometry.arcs import parabolic_angles as parabolic_angles
    from cfree.geometry.arcs import zero_mean_angles as zero_mean_angles
    from cfree.geometry.congruence import arc_classes as arc_classes
    from cfree.geometry.congruence import helix_classes as helix_classes
    from cfree.geometry.congruence import patch_classes as patch_classes
    from cfree.geometry.congruence import surface_classes as surface_classes
    from cfree.geometry.curvature_sum import GaussBonnet as GaussBonnet
    from cfree.geometry.curvature_sum import gauss_bonnet as gauss_bonnet
    from cfree.geometry.development import develop as develop
    from cfree.geometry.geodesics import Geodesic as Geodesic
    from cfree.geometry.geodesics import geodesic as geodesic
    from cfree.geometry.integrals import patch_areas as patch_areas
    from cfree.geometry.integrals import patch_curvatures as patch_curvatures
    from cfree.geometry.integrals import trapezoid_areas as trapezoid_areas
    from cfree.geometry.integrals import trapezoid_curvatures as trapezoid_curvatures
    from cfree.geometry.kinematic import meeting_volume as meeting_volume
    from cfree.geometry.local import LocalGeometry as LocalGeometry
    from cfree.geometry.local import local_geometry as local_geometry
    from cfree.geometry.normals import GaussMap as GaussMap
    from cfree.geometry.normals import gauss_map as gauss_map
    from cfree.geometry.rulings import distribution_parameters as distribution_parameters
    from cfree.geometry.rulings import is_developable as is_developable
    from cfree.geometry.rulings import is_helicoid as is_helicoid
    from cfree.geometry.rulings import is_minimal as is_minimal
    from cfree.geometry.rulings import striction_curve as striction_curve
    from cfree.geometry.rulings import striction_is_on_patch as striction_is_on_patch
    from cfree.geometry.rulings import striction_parameter as striction_parameter
    from cfree.geometry.rulings import striction_parameters as striction_parameters

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "arcs": "ArcGeometry ArcLine arc_geometry line_of_curvature parabolic_angles zero_mean_angles",
        "congruence": "arc_classes helix_classes patch_classes surface_classes",
        "development": "develop",
        "curvature_sum": "GaussBonnet gauss_bonnet",
        "geodesics": "Geodesic geodesic",
        "integrals": "patch_areas patch_curvatures trapezoid_areas trapezoid_curvatures",
        "kinematic": "meeting_volume",
        "local": "LocalGeometry local_geometry",
        "normals": "GaussMap gauss_map",
        "rulings": "distribution_parameters is_developable is_helicoid is_minimal "
        "striction_curve striction_is_on_patch striction_parameter striction_parameters",
    },
)
