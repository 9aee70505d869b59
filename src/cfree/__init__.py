"""The exact configuration space of a planar robot that translates and rotates among polygons."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cfree.forbidden import Boundary as Boundary
    from cfree.forbidden import boundary as boundary
    from cfree.errors import CfreeError as CfreeError
    from cfree.errors import FormatError as FormatError
    from cfree.errors import InvalidPolygonError as InvalidPolygonError
    from cfree.errors import InvalidPoseError as InvalidPoseError
    from cfree.errors import InvariantError as InvariantError
    from cfree.errors import UnsupportedError as UnsupportedError
    from cfree.io import load_scene as load_scene
    from cfree.polygon import Polygon as Polygon
    from cfree.pose import Pose as Pose
    from cfree.pose import Poses as Poses
    from cfree.scene import Scene as Scene
    from cfree.slice import Slice as Slice
    from cfree.storage import load_boundary as load_boundary

__version__ = "0.1.0"

# where each public name lives; imported when first used, so that `import cfree` is quick
_HOMES = {
    "Boundary": "forbidden",
    "CfreeError": "errors",
    "FormatError": "errors",
    "InvalidPolygonError": "errors",
    "InvalidPoseError": "errors",
    "InvariantError": "errors",
    "Polygon": "polygon",
    "Pose": "pose",
    "Poses": "pose",
    "Scene": "scene",
    "Slice": "slice",
    "UnsupportedError": "errors",
    "boundary": "forbidden",
    "load_boundary": "storage",
    "load_scene": "io",
}
__all__ = ["__version__", *_HOMES]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'cfree' has no attribute {name!r}")
    value = getattr(import_module(f"cfree.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *_HOMES])
