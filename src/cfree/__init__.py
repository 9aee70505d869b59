"""The exact configuration space of a planar robot that translates and rotates among polygons."""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names, register

if TYPE_CHECKING:
    from cfree.analysis.aisles import smallest_aisle as smallest_aisle
    from cfree.analysis.audit import audit as audit
    from cfree.analysis.blockers import blockers as blockers
    from cfree.analysis.fits import fits as fits
    from cfree.analysis.margins import max_margin as max_margin
    from cfree.analysis.margins import max_scale as max_scale
    from cfree.analysis.margins import nearest_miss as nearest_miss
    from cfree.analysis.reach_map import reach as reach
    from cfree.analysis.reach_map import turning_circle as turning_circle
    from cfree.collision.motion import Rotation as Rotation
    from cfree.collision.motion import Translation as Translation
    from cfree.collision.motion import motion_between as motion_between
    from cfree.collision.motion_checker import MotionChecker as MotionChecker
    from cfree.collision.motion_checker import first_contact as first_contact
    from cfree.collision.motion_checker import is_free_motion as is_free_motion
    from cfree.collision.nearest_free import ForbiddenPoseError as ForbiddenPoseError
    from cfree.collision.nearest_free import nearest_free as nearest_free
    from cfree.collision.nearest_free import require_free as require_free
    from cfree.collision.pose_checker import PoseChecker as PoseChecker
    from cfree.collision.pose_checker import is_free as is_free
    from cfree.collision.slide import Slide as Slide
    from cfree.curves.curved import Curved as Curved
    from cfree.errors import CfreeError as CfreeError
    from cfree.errors import FormatError as FormatError
    from cfree.errors import IncompleteError as IncompleteError
    from cfree.errors import InvalidPolygonError as InvalidPolygonError
    from cfree.errors import InvalidPoseError as InvalidPoseError
    from cfree.errors import InvalidVehicleError as InvalidVehicleError
    from cfree.errors import InvariantError as InvariantError
    from cfree.errors import LaboriousSceneError as LaboriousSceneError
    from cfree.errors import UndecidedError as UndecidedError
    from cfree.errors import UnsupportedError as UnsupportedError
    from cfree.exact.pose import Pose as Pose
    from cfree.exact.pose import Poses as Poses
    from cfree.forbidden.boundary import Boundary as Boundary
    from cfree.forbidden.boundary import boundary as boundary
    from cfree.formats.conversion import convert as convert
    from cfree.formats.drawings.footprints import footprint as footprint
    from cfree.formats.files import load as load
    from cfree.formats.files import save as save
    from cfree.formats.scene_file import load_polygons as load_polygons
    from cfree.formats.scene_file import load_scene as load_scene
    from cfree.formats.scene_file import load_shapes as load_shapes
    from cfree.free.largest_disc import largest_disc as largest_disc
    from cfree.free.space import FreeSpace as FreeSpace
    from cfree.free.space import free_space as free_space
    from cfree.free.turn_in_place import turn_in_place as turn_in_place
    from cfree.paths.clearance import clearance as clearance
    from cfree.paths.clearance import narrowest as narrowest
    from cfree.paths.driving import is_drivable as is_drivable
    from cfree.paths.path import Path as Path
    from cfree.paths.preferences import Preferences as Preferences
    from cfree.paths.preferences import unwanted as unwanted
    from cfree.paths.timing import timed as timed
    from cfree.planning.goals import AllSeparated as AllSeparated
    from cfree.planning.many import plan_many as plan_many
    from cfree.planning.plan import plan as plan
    from cfree.planning.planner import Planner as Planner
    from cfree.planning.separation import Separated as Separated
    from cfree.planning.separation import separation as separation
    from cfree.planning.stuck import Stuck as Stuck
    from cfree.planning.unreachable import Unreachable as Unreachable
    from cfree.polygons.polygon import Polygon as Polygon
    from cfree.polygons.repair import repaired as repaired
    from cfree.scene.scene import Scene as Scene
    from cfree.vehicles.vehicle import Car as Car
    from cfree.vehicles.vehicle import DifferentialDrive as DifferentialDrive
    from cfree.viewer.browser import view as view
    from cfree.viewer.notebook import widget as widget

__version__ = "0.1.0"

_HOMES = {
    "errors": "CfreeError FormatError IncompleteError "
    "InvalidPolygonError InvalidPoseError InvalidVehicleError InvariantError LaboriousSceneError UndecidedError "
    "UnsupportedError",
    "curves.curved": "Curved",
    "exact.pose": "Pose Poses",
    "polygons.polygon": "Polygon",
    "polygons.repair": "repaired",
    "scene.scene": "Scene",
    "vehicles.vehicle": "Car DifferentialDrive",
    "collision.motion": "Rotation Translation motion_between",
    "collision.slide": "Slide",
    "collision.pose_checker": "PoseChecker is_free",
    "collision.motion_checker": "MotionChecker first_contact is_free_motion",
    "collision.nearest_free": "ForbiddenPoseError nearest_free require_free",
    "forbidden.boundary": "Boundary boundary",
    "free.space": "FreeSpace free_space",
    "free.largest_disc": "largest_disc",
    "free.turn_in_place": "turn_in_place",
    "paths.path": "Path",
    "paths.driving": "is_drivable",
    "paths.clearance": "clearance narrowest",
    "paths.preferences": "Preferences unwanted",
    "paths.timing": "timed",
    "planning.goals": "AllSeparated",
    "planning.plan": "plan",
    "planning.planner": "Planner",
    "planning.many": "plan_many",
    "planning.separation": "Separated separation",
    "planning.stuck": "Stuck",
    "planning.unreachable": "Unreachable",
    "analysis.aisles": "smallest_aisle",
    "analysis.audit": "audit",
    "analysis.blockers": "blockers",
    "analysis.fits": "fits",
    "analysis.margins": "max_margin max_scale nearest_miss",
    "analysis.reach_map": "reach turning_circle",
    "formats.conversion": "convert",
    "formats.files": "load save",
    "formats.drawings.footprints": "footprint",
    "formats.scene_file": "load_polygons load_scene load_shapes",
    "viewer.browser": "view",
    "viewer.notebook": "widget",
}
_PACKAGES = (
    "analysis arrangements caging collision contact curves disassembly distributed exact figures film forbidden "
    "formats free geometry nesting ompl paths planning plot rational verify viewer"
)
_MOVED = {
    "analysis": "Blocker Fit Interval NearestMiss",
    "collision": "free_nearby",
    "forbidden": "CellComplex Mesh Slice",
    "formats": "Shapes",
    "free": "Cell",
    "paths": "Clearance Unwanted",
    "planning": "Moved",
}
register("page", "cfree.viewer.notebook", "live")
register("picture", "cfree.viewer.pictures", "picture")
register("scene_from_grid", "cfree.formats.drawings.grid_scene", "scene_from_grid")
register("drive_along", "cfree.planning.vehicles", "drive_along")
register("figure", "cfree.plot", "picture")
register("nesting_picture", "cfree.plot.nesting", "picture_of_nesting")
register("fit_picture", "cfree.plot.nesting", "picture_of_fit")
register("save_nesting", "cfree.nesting.writing", "save_nesting")
register("nesting_svg", "cfree.nesting.writing", "nesting_svg")
register("cage figure", "cfree.plot.cages", "plot_cage")
register("immobility figure", "cfree.plot.cages", "plot_immobility")
register("leaving figure", "cfree.plot.cages", "plot_leaving")
register("disassembly figure", "cfree.plot.cages", "plot_disassembly")
__getattr__, __dir__, _NAMES = lazy_names(__name__, _HOMES, _PACKAGES, _MOVED)
__all__ = ["__version__", *_NAMES]
