"""The exact configuration space of a planar robot that translates and rotates among polygons."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cfree.analysis.bottleneck import Pinch as Pinch
    from cfree.analysis.fits import Fit as Fit
    from cfree.analysis.fits import fits as fits
    from cfree.analysis.margins import Interval as Interval
    from cfree.analysis.margins import NearestMiss as NearestMiss
    from cfree.analysis.margins import max_margin as max_margin
    from cfree.analysis.margins import max_scale as max_scale
    from cfree.analysis.margins import nearest_miss as nearest_miss
    from cfree.analysis.turn_in_place import turn_in_place as turn_in_place
    from cfree.collision.motion import Rotation as Rotation
    from cfree.collision.motion import Translation as Translation
    from cfree.collision.motion import motion_between as motion_between
    from cfree.collision.motion import rotations as rotations
    from cfree.collision.motion_checker import FirstContact as FirstContact
    from cfree.collision.motion_checker import MotionChecker as MotionChecker
    from cfree.collision.motion_checker import first_contact as first_contact
    from cfree.collision.motion_checker import is_free_motion as is_free_motion
    from cfree.collision.nearest_free import free_nearby as free_nearby
    from cfree.collision.nearest_free import require_free as require_free
    from cfree.collision.pose_checker import Checker as Checker
    from cfree.collision.pose_checker import is_free as is_free
    from cfree.collision.slide import Slide as Slide
    from cfree.collision.slide import Touch as Touch
    from cfree.contact.contact import AngleRange as AngleRange
    from cfree.contact.contact import EdgeEdge as EdgeEdge
    from cfree.contact.contact import EdgeVertex as EdgeVertex
    from cfree.contact.contact import VertexEdge as VertexEdge
    from cfree.contact.contact import VertexVertex as VertexVertex
    from cfree.contact.contact import angle_range as angle_range
    from cfree.contact.contact import contact_curves as contact_curves
    from cfree.contact.contact import contacts as contacts
    from cfree.contact.contact import edge_edge_range as edge_edge_range
    from cfree.contact.definitions import contact_features as contact_features
    from cfree.contact.definitions import is_contact as is_contact
    from cfree.contact.definitions import is_forbidden as is_forbidden
    from cfree.contact.definitions import is_pseudo_contact as is_pseudo_contact
    from cfree.contact.surface import EdgeEdgeSegment as EdgeEdgeSegment
    from cfree.contact.surface import Helix as Helix
    from cfree.contact.surface import Surface as Surface
    from cfree.contact.surface import contact_helix as contact_helix
    from cfree.contact.surface import contact_segment as contact_segment
    from cfree.contact.surface import contact_surface as contact_surface
    from cfree.contact.surface import helix_through as helix_through
    from cfree.contact.surface import rotation_about as rotation_about
    from cfree.contact.surface import rotation_of_combination as rotation_of_combination
    from cfree.errors import CfreeError as CfreeError
    from cfree.errors import FormatError as FormatError
    from cfree.errors import IncompleteError as IncompleteError
    from cfree.errors import InvalidPolygonError as InvalidPolygonError
    from cfree.errors import InvalidPoseError as InvalidPoseError
    from cfree.errors import InvariantError as InvariantError
    from cfree.errors import UnsupportedError as UnsupportedError
    from cfree.exact.angle_interval import AlgebraicAngle as AlgebraicAngle
    from cfree.exact.angle_interval import AngleInterval as AngleInterval
    from cfree.exact.pose import Pose as Pose
    from cfree.exact.pose import Poses as Poses
    from cfree.exact.surd import ExactAngle as ExactAngle
    from cfree.exact.surd import Surd as Surd
    from cfree.film import film_path as film_path
    from cfree.film import save_film as save_film
    from cfree.forbidden.boundary import Boundary as Boundary
    from cfree.forbidden.boundary import boundary as boundary
    from cfree.forbidden.cell_complex import CellComplex as CellComplex
    from cfree.forbidden.mesh import Mesh as Mesh
    from cfree.forbidden.mesh import save_mesh as save_mesh
    from cfree.forbidden.slice import Slice as Slice
    from cfree.formats.answer_file import load_answer as load_answer
    from cfree.formats.boundary_file import load_boundary as load_boundary
    from cfree.formats.scene_file import load_polygons as load_polygons
    from cfree.formats.scene_file import load_scene as load_scene
    from cfree.free.space import Cell as Cell
    from cfree.free.space import FreeSpace as FreeSpace
    from cfree.free.space import free_space as free_space
    from cfree.geometry.area import patch_areas as patch_areas
    from cfree.geometry.area import trapezoid_areas as trapezoid_areas
    from cfree.geometry.congruence import arc_classes as arc_classes
    from cfree.geometry.congruence import helix_classes as helix_classes
    from cfree.geometry.congruence import patch_classes as patch_classes
    from cfree.geometry.congruence import surface_classes as surface_classes
    from cfree.geometry.development import develop as develop
    from cfree.geometry.local import LocalGeometry as LocalGeometry
    from cfree.geometry.local import local_geometry as local_geometry
    from cfree.geometry.rulings import distribution_parameters as distribution_parameters
    from cfree.geometry.rulings import is_developable as is_developable
    from cfree.geometry.rulings import is_helicoid as is_helicoid
    from cfree.geometry.rulings import is_minimal as is_minimal
    from cfree.geometry.rulings import striction_curve as striction_curve
    from cfree.geometry.rulings import striction_is_on_patch as striction_is_on_patch
    from cfree.geometry.rulings import striction_parameter as striction_parameter
    from cfree.geometry.rulings import striction_parameters as striction_parameters
    from cfree.paths.clearance import narrowest as narrowest
    from cfree.paths.path import Clearance as Clearance
    from cfree.paths.path import Path as Path
    from cfree.planning.planner import Planner as Planner
    from cfree.planning.planner import plan as plan
    from cfree.planning.planner import plan_many as plan_many
    from cfree.planning.separation import Pieces as Pieces
    from cfree.planning.separation import Separated as Separated
    from cfree.planning.separation import separation as separation
    from cfree.plot.answer import picture as picture
    from cfree.plot.answer import plot_path_space as plot_path_space
    from cfree.plot.boundary import plot_boundary as plot_boundary
    from cfree.plot.boundary import plot_overview as plot_overview
    from cfree.plot.boundary import plot_slice as plot_slice
    from cfree.plot.boundary import plot_workspace as plot_workspace
    from cfree.plot.development import plot_development as plot_development
    from cfree.plot.path import plot_path as plot_path
    from cfree.plot.rational import plot_models as plot_models
    from cfree.polygons.polygon import Polygon as Polygon
    from cfree.rational.bezier import BezierPatch as BezierPatch
    from cfree.rational.bezier import bezier_patch as bezier_patch
    from cfree.rational.bezier import bezier_patches as bezier_patches
    from cfree.rational.bezier import save_bezier as save_bezier
    from cfree.rational.model import RationalHelix as RationalHelix
    from cfree.rational.model import RationalRange as RationalRange
    from cfree.rational.model import RationalSegment as RationalSegment
    from cfree.rational.model import RationalSurface as RationalSurface
    from cfree.rational.model import rational_helix as rational_helix
    from cfree.rational.model import rational_range as rational_range
    from cfree.rational.model import rational_segment as rational_segment
    from cfree.rational.model import rational_surface as rational_surface
    from cfree.rational.model import to_geometrical as to_geometrical
    from cfree.rational.model import to_rational as to_rational
    from cfree.scene.scene import Scene as Scene

__version__ = "0.1.0"

# where each public name lives; imported when first used, so that `import cfree` is quick
_HOMES = {
    "exact.angle_interval": "AlgebraicAngle AngleInterval",
    "formats.answer_file": "load_answer",
    "forbidden.cell_complex": "CellComplex",
    "contact.contact": "AngleRange EdgeEdge EdgeVertex VertexEdge VertexVertex angle_range contact_curves contacts "
    "edge_edge_range",
    "errors": "CfreeError FormatError IncompleteError InvalidPolygonError InvalidPoseError InvariantError "
    "UnsupportedError",
    "film": "film_path save_film",
    "analysis.fits": "Fit fits",
    "forbidden.boundary": "Boundary boundary",
    "free.space": "Cell FreeSpace free_space",
    "collision.pose_checker": "Checker is_free",
    "geometry.area": "patch_areas trapezoid_areas",
    "geometry.congruence": "arc_classes helix_classes patch_classes surface_classes",
    "geometry.development": "develop",
    "geometry.local": "LocalGeometry local_geometry",
    "plot.development": "plot_development",
    "geometry.rulings": "distribution_parameters is_developable is_helicoid is_minimal striction_curve "
    "striction_is_on_patch striction_parameter striction_parameters",
    "collision.nearest_free": "free_nearby require_free",
    "formats.scene_file": "load_polygons load_scene",
    "analysis.margins": "Interval NearestMiss max_margin max_scale nearest_miss",
    "forbidden.mesh": "Mesh save_mesh",
    "collision.motion": "Rotation Translation motion_between rotations",
    "collision.motion_checker": "FirstContact MotionChecker first_contact is_free_motion",
    "paths.path": "Clearance Path",
    "paths.clearance": "narrowest",
    "analysis.bottleneck": "Pinch",
    "planning.planner": "Planner plan plan_many",
    "plot.boundary": "plot_boundary plot_overview plot_slice plot_workspace",
    "plot.answer": "picture plot_path_space",
    "plot.path": "plot_path",
    "polygons.polygon": "Polygon",
    "exact.pose": "Pose Poses",
    "rational.bezier": "BezierPatch bezier_patch bezier_patches save_bezier",
    "rational.model": "RationalHelix RationalRange RationalSegment RationalSurface rational_helix rational_range "
    "rational_segment rational_surface to_geometrical to_rational",
    "plot.rational": "plot_models",
    "exact.surd": "ExactAngle Surd",
    "scene.scene": "Scene",
    "planning.separation": "Pieces Separated separation",
    "forbidden.slice": "Slice",
    "collision.slide": "Slide Touch",
    "formats.boundary_file": "load_boundary",
    "contact.surface": "EdgeEdgeSegment Helix Surface contact_helix contact_segment contact_surface helix_through "
    "rotation_about rotation_of_combination",
    "contact.definitions": "contact_features is_contact is_forbidden is_pseudo_contact",
    "analysis.turn_in_place": "turn_in_place",
}
_PACKAGES = ("figures", "ompl", "verify")  # whose names stay their own
_MODULE = {name: module for module, names in _HOMES.items() for name in names.split()}
__all__ = ["__version__", *_MODULE]


def __getattr__(name: str) -> Any:
    if name in _PACKAGES:
        return import_module(f"cfree.{name}")
    if name not in _MODULE:
        raise AttributeError(f"module 'cfree' has no attribute {name!r}")
    value = getattr(import_module(f"cfree.{_MODULE[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*__all__, *_PACKAGES])
