"""The exact configuration space of a planar robot that translates and rotates among polygons."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cfree.angle_interval import AlgebraicAngle as AlgebraicAngle
    from cfree.angle_interval import AngleInterval as AngleInterval
    from cfree.answer import load_answer as load_answer
    from cfree.cell_complex import CellComplex as CellComplex
    from cfree.cells import Cell as Cell
    from cfree.cells import FreeSpace as FreeSpace
    from cfree.cells import free_space as free_space
    from cfree.contact import AngleRange as AngleRange
    from cfree.contact import EdgeEdge as EdgeEdge
    from cfree.contact import EdgeVertex as EdgeVertex
    from cfree.contact import VertexEdge as VertexEdge
    from cfree.contact import VertexVertex as VertexVertex
    from cfree.contact import angle_range as angle_range
    from cfree.contact import contact_curves as contact_curves
    from cfree.contact import contacts as contacts
    from cfree.contact import edge_edge_range as edge_edge_range
    from cfree.errors import CfreeError as CfreeError
    from cfree.errors import FormatError as FormatError
    from cfree.errors import IncompleteError as IncompleteError
    from cfree.errors import InvalidPolygonError as InvalidPolygonError
    from cfree.errors import InvalidPoseError as InvalidPoseError
    from cfree.errors import InvariantError as InvariantError
    from cfree.errors import UnsupportedError as UnsupportedError
    from cfree.film import film_path as film_path
    from cfree.film import save_film as save_film
    from cfree.fitting import Fit as Fit
    from cfree.fitting import fits as fits
    from cfree.forbidden import Boundary as Boundary
    from cfree.forbidden import boundary as boundary
    from cfree.free import Checker as Checker
    from cfree.free import is_free as is_free
    from cfree.geometry.area import patch_areas as patch_areas
    from cfree.geometry.area import trapezoid_areas as trapezoid_areas
    from cfree.geometry.congruence import arc_classes as arc_classes
    from cfree.geometry.congruence import helix_classes as helix_classes
    from cfree.geometry.congruence import patch_classes as patch_classes
    from cfree.geometry.congruence import surface_classes as surface_classes
    from cfree.geometry.development import develop as develop
    from cfree.geometry.local import LocalGeometry as LocalGeometry
    from cfree.geometry.local import local_geometry as local_geometry
    from cfree.geometry.plot import plot_development as plot_development
    from cfree.geometry.rulings import distribution_parameters as distribution_parameters
    from cfree.geometry.rulings import is_developable as is_developable
    from cfree.geometry.rulings import is_helicoid as is_helicoid
    from cfree.geometry.rulings import is_minimal as is_minimal
    from cfree.geometry.rulings import striction_curve as striction_curve
    from cfree.geometry.rulings import striction_is_on_patch as striction_is_on_patch
    from cfree.geometry.rulings import striction_parameter as striction_parameter
    from cfree.geometry.rulings import striction_parameters as striction_parameters
    from cfree.invalid import free_nearby as free_nearby
    from cfree.invalid import require_free as require_free
    from cfree.io import load_polygons as load_polygons
    from cfree.io import load_scene as load_scene
    from cfree.margins import Interval as Interval
    from cfree.margins import NearestMiss as NearestMiss
    from cfree.margins import max_margin as max_margin
    from cfree.margins import max_scale as max_scale
    from cfree.margins import nearest_miss as nearest_miss
    from cfree.mesh import Mesh as Mesh
    from cfree.mesh import save_mesh as save_mesh
    from cfree.motion import Rotation as Rotation
    from cfree.motion import Translation as Translation
    from cfree.motion import motion_between as motion_between
    from cfree.motion import rotations as rotations
    from cfree.motion_check import FirstContact as FirstContact
    from cfree.motion_check import MotionChecker as MotionChecker
    from cfree.motion_check import first_contact as first_contact
    from cfree.motion_check import is_free_motion as is_free_motion
    from cfree.path import Clearance as Clearance
    from cfree.path import Path as Path
    from cfree.path_clearance import narrowest as narrowest
    from cfree.pinch import Pinch as Pinch
    from cfree.planning.planner import Planner as Planner
    from cfree.planning.planner import plan as plan
    from cfree.planning.planner import plan_many as plan_many
    from cfree.plot import plot_boundary as plot_boundary
    from cfree.plot import plot_overview as plot_overview
    from cfree.plot import plot_slice as plot_slice
    from cfree.plot import plot_workspace as plot_workspace
    from cfree.plot_answer import picture as picture
    from cfree.plot_answer import plot_path_space as plot_path_space
    from cfree.plot_way import plot_path as plot_path
    from cfree.polygon import Polygon as Polygon
    from cfree.pose import Pose as Pose
    from cfree.pose import Poses as Poses
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
    from cfree.rational.plot import plot_models as plot_models
    from cfree.rational.surd import ExactAngle as ExactAngle
    from cfree.rational.surd import Surd as Surd
    from cfree.scene import Scene as Scene
    from cfree.separated import Pieces as Pieces
    from cfree.separated import Separated as Separated
    from cfree.separated import separation as separation
    from cfree.slice import Slice as Slice
    from cfree.slide import Slide as Slide
    from cfree.slide import Touch as Touch
    from cfree.storage import load_boundary as load_boundary
    from cfree.surface import EdgeEdgeSegment as EdgeEdgeSegment
    from cfree.surface import Helix as Helix
    from cfree.surface import Surface as Surface
    from cfree.surface import contact_helix as contact_helix
    from cfree.surface import contact_segment as contact_segment
    from cfree.surface import contact_surface as contact_surface
    from cfree.surface import helix_through as helix_through
    from cfree.surface import rotation_about as rotation_about
    from cfree.surface import rotation_of_combination as rotation_of_combination
    from cfree.touch import contact_features as contact_features
    from cfree.touch import is_contact as is_contact
    from cfree.touch import is_forbidden as is_forbidden
    from cfree.touch import is_pseudo_contact as is_pseudo_contact
    from cfree.turn import turn_in_place as turn_in_place

__version__ = "0.1.0"

# where each public name lives; imported when first used, so that `import cfree` is quick
_HOMES = {
    "angle_interval": "AlgebraicAngle AngleInterval",
    "answer": "load_answer",
    "cell_complex": "CellComplex",
    "contact": "AngleRange EdgeEdge EdgeVertex VertexEdge VertexVertex angle_range contact_curves contacts "
    "edge_edge_range",
    "errors": "CfreeError FormatError IncompleteError InvalidPolygonError InvalidPoseError InvariantError "
    "UnsupportedError",
    "film": "film_path save_film",
    "fitting": "Fit fits",
    "forbidden": "Boundary boundary",
    "cells": "Cell FreeSpace free_space",
    "free": "Checker is_free",
    "geometry.area": "patch_areas trapezoid_areas",
    "geometry.congruence": "arc_classes helix_classes patch_classes surface_classes",
    "geometry.development": "develop",
    "geometry.local": "LocalGeometry local_geometry",
    "geometry.plot": "plot_development",
    "geometry.rulings": "distribution_parameters is_developable is_helicoid is_minimal striction_curve "
    "striction_is_on_patch striction_parameter striction_parameters",
    "invalid": "free_nearby require_free",
    "io": "load_polygons load_scene",
    "margins": "Interval NearestMiss max_margin max_scale nearest_miss",
    "mesh": "Mesh save_mesh",
    "motion": "Rotation Translation motion_between rotations",
    "motion_check": "FirstContact MotionChecker first_contact is_free_motion",
    "path": "Clearance Path",
    "path_clearance": "narrowest",
    "pinch": "Pinch",
    "planning.planner": "Planner plan plan_many",
    "plot": "plot_boundary plot_overview plot_slice plot_workspace",
    "plot_answer": "picture plot_path_space",
    "plot_way": "plot_path",
    "polygon": "Polygon",
    "pose": "Pose Poses",
    "rational.bezier": "BezierPatch bezier_patch bezier_patches save_bezier",
    "rational.model": "RationalHelix RationalRange RationalSegment RationalSurface rational_helix rational_range "
    "rational_segment rational_surface to_geometrical to_rational",
    "rational.plot": "plot_models",
    "rational.surd": "ExactAngle Surd",
    "scene": "Scene",
    "separated": "Pieces Separated separation",
    "slice": "Slice",
    "slide": "Slide Touch",
    "storage": "load_boundary",
    "surface": "EdgeEdgeSegment Helix Surface contact_helix contact_segment contact_surface helix_through "
    "rotation_about rotation_of_combination",
    "touch": "contact_features is_contact is_forbidden is_pseudo_contact",
    "turn": "turn_in_place",
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
