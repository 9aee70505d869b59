"""The scene in the core's form: integer coordinates, and an identity for every feature.

Coordinates are multiplied by one common denominator. Coincident vertices get one *point*, directed edges on one line
with one direction one *line*, parallel edges one *direction*. The core settles equality of features once, exactly.
It then names curves and critical angles by these, and most ties need no arithmetic.

There are two separate layers. The robot's polygons meet the obstacles (and the complement of `workspace`); the robot's
reference point, as a shape of its own, meets the complement of `bounds`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import cfree._core as _core
from cfree.errors import UnsupportedError
from cfree.libraries import ArrayLike, Floats, Int32s, NDArray, np
from cfree.scene.core_shapes import core_shapes
from cfree.value import kept

if TYPE_CHECKING:
    from cfree.exact.pose import Pose
    from cfree.scene.grown_cores import Cores
    from cfree.scene.scene import Bounds, Scene

Point = tuple[int, int]
BODY, REFERENCE = 0, 1  # layers
MOST_ROBOT_FEATURES, MOST_OBSTACLE_FEATURES = 2**28, 2**31  # a packed pair has 28 and 31 bits for them
MOST_PATCHES = 2**31  # numbered by int32

BOUNDS, WORKSPACE = -1, -2  # owners that are not polygons of the user's robot or obstacles
NAMES = {BOUNDS: "bounds", WORKSPACE: "workspace"}


class ShapeFeatures:
    """The robot or the obstacles.

    Attributes
    ----------
    core : _core.Shape
        Its columns, read only; ``cpp/include/cfree/scene/scene.hpp`` defines them.
    scale : int
        Common denominator of all coordinates.
    """

    def __init__(self, core: _core.Shape, near: _core.Shape, owners: _core.Owners, scale: int) -> None:
        self.core, self.scale = core, scale
        self._near, self._owners = near, owners

    @cached_property
    def xy(self) -> Floats:
        """Vertices (n, 2) in the user's units, correctly rounded."""
        return self.core.xy

    @cached_property
    def near(self) -> Floats:
        """The same from the frame's origin, so that no digits are lost far away from (0, 0)."""
        return self._near.xy

    @cached_property
    def v(self) -> Int32s:
        """Beginnings (e,) of the directed edges: edge k of a ring starts at vertex k; pieces' diagonals last."""
        return self.core.v

    @cached_property
    def w(self) -> Int32s:
        """Ends (e,) of the directed edges."""
        return self.core.w

    @cached_property
    def previous(self) -> Int32s:
        """The vertex before, (r,), for the vertices of rings, which come first."""
        return self.core.previous

    @cached_property
    def owner_polygon(self) -> Int32s:
        """Polygon (r,) of each; `BOUNDS` or `WORKSPACE` if the user gave no such polygon."""
        return self._owners.polygon

    @cached_property
    def owner_vertex(self) -> Int32s:
        """Vertex (r,) of that polygon."""
        return self._owners.vertex

    @property
    def owner_of_end(self) -> Int32s:
        """Polygon of each of the last vertices, which are ends of arcs or have the direction of one."""
        return self._owners.polygon_of_end

    @cached_property
    def ring(self) -> Int32s:
        """Ring (r,) of that polygon, by which its vertices come one after another."""
        polygon, numbers = self.owner_polygon, np.arange(len(self.previous))
        rings = np.cumsum(self.previous >= numbers)
        first = np.append(True, polygon[1:] != polygon[:-1])
        before = np.maximum.accumulate(np.where(first, numbers, 0))
        return (rings - rings[before]).astype(np.int32)

    @cached_property
    def radius(self) -> Floats:
        """Radius by which each vertex is grown, in the user's units; a convex arc's vertex is its centre."""
        radius = np.array([r / self.scale for r in self.core.radius])
        return radius if len(radius) else np.zeros(len(self.core.xy))

    @cached_property
    def vertices(self) -> tuple[Point, ...]:
        """The vertices times `scale`."""
        return self.core.vertices

    @cached_property
    def pieces(self) -> list[list[int]]:
        """The vertices of each convex piece."""
        return [part.tolist() for part in np.split(self.core.piece_vertex, self.core.piece[1:-1])]

    @cached_property
    def turning(self) -> NDArray[np.float64]:
        """Pi minus the interior angle, radians, (r,): pi at the ends of a segment, 2 pi at a point."""
        edges = self.near[self.w] - self.near[self.v]
        before, after = edges[self.previous], edges[: len(self.previous)]
        cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
        dot = (before * after).sum(axis=1)
        turning: NDArray[np.float64] = np.arctan2(cross, dot)
        turning[(cross == 0) & (dot < 0)] = np.pi
        turning[~after.any(axis=1)] = 2 * np.pi
        return turning


@dataclass(frozen=True)
class SceneFeatures:
    """Features of the robot and of the obstacles.

    Attributes
    ----------
    core : _core.Scene
        The core's own scene, shared by everything that the core makes of it.
    scale : int
        Common denominator of all coordinates.
    rim : (xmin, ymin, xmax, ymax) or None
        A rectangle around all patches, if there are bounds or a workspace.
    made : _core.SceneFeatures
        The memory that all of these are views of.
    """

    robot: ShapeFeatures
    obstacles: ShapeFeatures
    core: _core.Scene
    scale: int
    rim: tuple[float, float, float, float] | None
    made: _core.SceneFeatures

    @classmethod
    def of(cls, made: _core.SceneFeatures) -> SceneFeatures:
        """Wrap the features that the core has made of a scene."""
        core, scale = made.scene, made.scene.scale
        robot = ShapeFeatures(core.robot, core.near.robot, made.robot, scale)
        obstacles = ShapeFeatures(core.obstacles, core.near.obstacles, made.obstacles, scale)
        return cls(robot, obstacles, core, scale, made.rim, made)

    @property
    def frame(self) -> tuple[float, float, float, float]:
        """The origins of the obstacles and of the robot, from which `near` counts."""
        return self.core.frame

    def moved(self, theta: ArrayLike, frame: ArrayLike | None = None) -> NDArray[np.float64]:
        """Return the offsets (..., 2) of positions from the frame's positions, by orientation."""
        x, y, a, b = self.frame if frame is None else np.asarray(frame, float)
        c, s = np.cos(theta), np.sin(theta)
        return np.stack([x - (c * a - s * b), y - (s * a + c * b)], axis=-1)

    def in_chart(self, pose: Pose) -> tuple[tuple[int, ...], int]:
        """Return a pose in the core's form, integers x, y, unit, numerator and denominator of tau; and its chart."""
        (chart, tau), (x, y, unit) = pose.chart, pose.integers
        return (x * self.scale, y * self.scale, unit, tau.numerator, tau.denominator), chart

    @property
    def patches(self) -> int:
        """The number of contact patches."""
        (n, convex, _), (m, others, _) = (shape.core.counts for shape in (self.robot, self.obstacles))
        return convex * m + n * others


def unpacked(code: Any) -> tuple[Any, Any, Any]:
    """Return kind, robot feature and obstacle feature of a packed pair, an int or an array of uint64."""
    return code >> 61, code >> 31 & 0xFFFFFFF, code & 0x7FFFFFFF


def branch_bits(code: int) -> int:
    """Return the branch of a curve, or the end of a quadrant, that a packed pair has among grown cores; 3 is -1."""
    return code >> 59 & 3


def scene_features(scene: Scene) -> SceneFeatures:
    """Number the features of a scene of polygons for the core; the scene caches the result."""
    return kept(scene, _numbered)


def grown_features(scene: Scene) -> SceneFeatures:
    """Number the features of a scene of rounded shapes: those of their cores, with radii.

    Raises
    ------
    UnsupportedError
        If a shape is not rounded; the message names it.
    """
    return kept(scene, _grown) if scene.curved else scene_features(scene)


def _grown(scene: Scene) -> SceneFeatures:
    from cfree.scene.rounded import rounded_shapes, why_not_rounded

    shapes = rounded_shapes(scene)
    if shapes is None:
        raise UnsupportedError(why_not_rounded(scene))
    return features_of_cores(shapes, scene, scene.bounds)


def features_of_cores(
    cores: Cores, scene: Scene, bounds: Bounds | None, whole: _core.WholeScene | None = None
) -> SceneFeatures:
    """Number the features of grown cores in the workspace of a scene, and in bounds; of a part, as in the whole."""
    robot, obstacles = ([shape.handle for shape in shapes] for shapes in (cores.robot, cores.obstacles))
    _, _, workspace, limits = core_shapes((), (), cores.straight(scene.workspace), bounds)
    rounding = [shape.rounding for shape in (*cores.robot, *cores.obstacles)]
    features = SceneFeatures.of(_core.SceneFeatures(robot, obstacles, workspace, limits, whole, rounding, cores.frames))
    refuse_too_many(features)
    return features


def _numbered(scene: Scene) -> SceneFeatures:
    shapes = core_shapes(scene.robot, scene.obstacles, scene.workspace, scene.bounds)
    features = SceneFeatures.of(_core.SceneFeatures(*shapes))
    refuse_too_many(features)
    return features


def refuse_too_many(features: SceneFeatures) -> None:
    """Raise `UnsupportedError` if there are more features or patches than numbers for them."""
    for name, shape, most in (
        ("robot", features.robot, MOST_ROBOT_FEATURES),
        ("obstacles", features.obstacles, MOST_OBSTACLE_FEATURES),
    ):
        vertices, _, of_pieces = shape.core.counts
        if (count := vertices + of_pieces) >= most:
            raise UnsupportedError(f"{name}: {count:,} edges and diagonals; fewer than {most:,} have numbers: simplify")
    if (patches := features.patches) >= MOST_PATCHES:
        n, m = features.robot.core.counts[0], features.obstacles.core.counts[0]
        raise UnsupportedError(
            f"{n:,} vertices of the robot and {m:,} of the obstacles: {patches:,} contact patches; "
            f"fewer than {MOST_PATCHES:,} have numbers: simplify, or divide the obstacles"
        )
