"""Exact collision checks of whole motions, in closed form and without steps: docs/theory/motions.md.

The core decides; this module converts motions to integers and its answers to objects.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Any

import cfree._core as _core
from cfree.arguments import checked
from cfree.collision.arcs import ArcScene, arcs_of
from cfree.collision.motion import Motion, Rotation, Translation, joining
from cfree.collision.slide import Slide
from cfree.contact.arcs import ArcContact
from cfree.contact.contact import EdgeVertex, VertexEdge
from cfree.contact.kind import Kind
from cfree.errors import UnsupportedError
from cfree.exact.number import common_denominator
from cfree.exact.pose import Pose, PoseLike, for_core, is_plain, to_pose
from cfree.exact.surd import Surd
from cfree.scene.features import BODY, BOUNDS, WORKSPACE, SceneFeatures, ShapeFeatures, scene_features
from cfree.scene.scene import Scene
from cfree.value import Value, kept

PLAIN_MOTIONS = frozenset({Translation, Rotation})  # kinds of motions that the core reads


@dataclass(frozen=True)
class FirstContact:
    """The place where a motion becomes forbidden.

    Attributes
    ----------
    at : Surd
        The motion is free up to this parameter, itself included, and forbidden right after it; see
        `cfree.collision.motion`. 0 may also mean that the first pose is forbidden.
    robot : int
        The robot's polygon.
    obstacle : int
        The obstacle; -1 stands for the bounds, -2 for the workspace.
    contact : VertexEdge or EdgeVertex; among round shapes ArcEdge, EdgeArc or ArcArc; optional
        The contact that is entered, in the numbering of the two polygons, the workspace's for -2; of round shapes, in
        that of `cfree.contact.shape_features`. None if the first pose is forbidden, for bounds, and if a diagonal of
        the convex pieces is the last to separate them.
    width : Fraction
        The motion is forbidden right after a parameter that is at most this above `at`: 0 between polygons, at most
        2**-60 between round shapes.
    """

    at: Surd
    robot: int
    obstacle: int
    contact: VertexEdge | EdgeVertex | ArcContact | None
    width: Fraction = field(default=Fraction(0), repr=False)


@checked
class MotionChecker(Value):
    """Exact checks of many motions in one scene.

    Parameters
    ----------
    scene : Scene
        Polygons, and shapes of segments and circular arcs.

    Raises
    ------
    UnsupportedError
        If a shape has other curves.

    Notes
    -----
    The scene is prepared once, in O((n + m) log(n + m)) time and a few times as much as `Polygon.pieces` takes. A check
    reads only the obstacles near the motion, in doubles with proven bounds. Pairs of convex pieces of p and q edges
    that touch on the way are decided in exact integers, in O((p q)^2) time.

    Examples
    --------
    >>> from cfree.collision.motion import Translation
    >>> from cfree.scene.scene import Scene
    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> walls = [[(3, 0), (4, 0), (4, 1)], [(0, 1), (2, 1), (2, 2), (0, 2)]]
    >>> checker = MotionChecker(Scene(robot=square, obstacles=walls))
    >>> checker.is_free(Pose(0, 0), Translation((2, 0))), checker.is_free(Pose(0, 0), Translation(("2.001", 0)))
    (True, False)
    >>> checker.first_contact(Pose(0, 0), Translation((4, 0)))
    FirstContact(at=Surd(p=Fraction(1, 2), q=Fraction(0, 1), n=0), robot=0, obstacle=0, contact=VertexEdge(i=1, j=2))
    """

    _arcs: ArcScene | None = None

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._arcs = arcs_of(scene) if scene.curved else None
        if self._arcs is None:
            self._handle = kept(scene, _prepared)

    @property
    def _content(self) -> tuple[Scene]:
        return (self._scene,)

    @cached_property
    def features(self) -> SceneFeatures:
        """The polygons in the core's form."""
        return scene_features(self._scene)

    @cached_property
    def _rim(self) -> tuple[Fraction, Fraction, Fraction, Fraction] | None:
        return None if self._scene.workspace is None else _extent(self.features.obstacles)

    @property
    def units(self) -> tuple[int, int]:
        """Units of the core: its integers are coordinates times the first, its doubles these over 2 to the second."""
        return self.features.scale, self.features.core.shift

    def is_free(self, pose: PoseLike, motion: Motion) -> bool:
        """True if every pose of a motion is free, decided exactly. Touching is free, also all the way.

        Examples
        --------
        >>> from cfree.collision.motion import Rotation
        >>> from cfree.scene.scene import Scene
        >>> rod, room = [(-4, -3), (4, -3), (4, 3), (-4, 3)], [(-5, -5), (5, -5), (5, 5), (-5, 5)]
        >>> checker = MotionChecker(Scene(robot=rod, obstacles=[], workspace=room))
        >>> checker.is_free(Pose(0, 0), Rotation((0, 0), "90deg"))  # its corners are 5 from the pole
        True
        >>> checker.is_free(Pose(0, 0), Rotation((0, "1e-30"), "90deg"))
        False
        """
        if self._arcs is None and is_plain(pose) and type(motion) in PLAIN_MOTIONS:
            free = _of_one(self._handle, pose, motion)
            if free is not None:
                return free
        return self._is_free(pose, motion)

    @checked
    def _is_free(self, pose: PoseLike, motion: Motion) -> bool:
        return self._decided(to_pose(pose, "pose"), motion)

    def _decided(self, pose: Pose, motion: Motion) -> bool:
        if self._arcs is not None:
            return self._arcs.is_motion_free(pose, motion)
        if isinstance(motion, Slide):
            return self._outside(pose) is None and self._handle.is_slide_free(self._slide_integers(pose, motion))
        return bool(self._handle.is_free(pose, motion, motion.kind == "rotation"))

    @checked
    def joins(self, poses: Sequence[Pose]) -> bool:
        """True if the motions of `motion_between` from each of these poses to the next are free."""
        return all(self.is_free(a, joining(a, b)) for a, b in pairwise(poses))

    @checked
    def first_free(self, ways: Iterable[Sequence[Pose]]) -> Sequence[Pose] | None:
        """Return the first free one of some paths, each a sequence of poses."""
        return next(filter(self.joins, ways), None)

    @checked
    def first_contact(self, pose: PoseLike, motion: Motion) -> FirstContact | None:
        """Return the place where a motion first becomes forbidden; None if it is free.

        Raises
        ------
        UnsupportedError
            If the motion is a slide: call `is_free` for parts of it.
        """
        return self._first_contact(to_pose(pose, "pose"), motion)

    def _first_contact(self, pose: Pose, motion: Motion) -> FirstContact | None:
        if self._arcs is not None:
            return _first_among_arcs(self._scene, self._arcs, pose, motion)
        if isinstance(motion, Slide):
            raise UnsupportedError("a slide has no first contact; call is_free for parts of it, from Slide.between")
        if (outside := self._outside(pose)) is not None:
            return FirstContact(Surd(0), outside[0], outside[1], None)
        collision = self._handle.first_collision(*self._integers(pose, motion))
        if collision is None:
            return None
        polynomial, robot_piece, obstacle_piece, kind, i, j = collision
        robot, obstacles = self.features.robot, self.features.obstacles
        part, obstacle = _polygon(robot, robot_piece), _polygon(obstacles, obstacle_piece)
        contact: VertexEdge | EdgeVertex | None = None
        count = len(robot.previous), len(obstacles.previous)
        if kind and obstacle != BOUNDS and i < count[0] and j < count[1] and obstacles.owner_vertex[j] >= 0:
            i, j = int(robot.owner_vertex[i]), int(obstacles.owner_vertex[j])
            if kind == Kind.VERTEX_EDGE and obstacle == WORKSPACE and self._scene.workspace:
                j = int(self._scene.workspace.previous[j])  # its complement runs the other way
            contact = VertexEdge(i, j) if kind == Kind.VERTEX_EDGE else EdgeVertex(i, j)
        return FirstContact(_crossing(polynomial) if kind else Surd(0), part, obstacle, contact)

    def _outside(self, pose: Pose) -> tuple[int, int] | None:
        """Return a robot polygon and -1 or -2 if the first pose is outside the bounds or beyond the workspace's frame.

        Later poses can only leave through the frames around the bounds and the workspace.
        """
        if self._scene.bounds is not None:
            x0, y0, x1, y1 = self._scene.bounds
            if not (x0 <= pose.x <= x1 and y0 <= pose.y <= y1):
                return 0, BOUNDS
        if self._rim is not None:
            x0, y0, x1, y1 = self._rim
            for k, part in enumerate(self._scene.robot):
                ((x, y),) = pose.apply_exact([part.exact_vertices[0]])
                if not (x0 < x < x1 and y0 < y < y1):
                    return k, WORKSPACE
        return None

    def _slide_integers(self, pose: Pose, slide: Slide) -> list[int]:
        """Return a slide in the core's form: polynomials in u."""
        scale, q, p = self.features.scale, slide.tau.denominator, slide.tau.numerator
        x = [scale * (pose.x * d + c) for c, d in zip(slide.x, slide.d, strict=True)]
        y = [scale * (pose.y * d + c) for c, d in zip(slide.y, slide.d, strict=True)]
        terms = [c * slide.tau**k for values in (x, y, slide.d) for k, c in enumerate(values)]
        whole = common_denominator(terms)
        return [*pose.rotation, q, p, *(int(c * whole) for c in terms)]

    def _integers(self, pose: Pose, motion: Translation | Rotation) -> tuple[bool, tuple[int, ...]]:
        """Return a motion in the core's form."""
        vx, vy = motion.pole or motion.vector
        unit = math.lcm(pose.x.denominator, pose.y.denominator, vx.denominator, vy.denominator)
        scale = unit * self.features.scale
        x, y, along, across = (v.numerator * (scale // v.denominator) for v in (pose.x, pose.y, vx, vy))
        half = (motion.first, *motion.half) if motion.pole else (1, 1, 0)
        return motion.kind == "rotation", (*pose.rotation, x, y, unit, along, across, *half)


def is_free_motion(scene: Scene, pose: PoseLike, motion: Motion) -> bool:
    """True if every pose of a motion is free, decided exactly. The scene caches its preparation.

    Examples
    --------
    >>> from cfree.collision.motion import Rotation
    >>> from cfree.scene.scene import Scene
    >>> square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    >>> scene = Scene(robot=square, obstacles=[[(2, -2), (3, -2), (3, 2), (2, 2)]])
    >>> is_free_motion(scene, Pose(0, 0), Rotation((0, 0), "90deg"))
    True
    >>> is_free_motion(scene, Pose("0.6", 0), Rotation(("0.6", 0), "90deg"))
    False
    """
    if is_plain(pose) and type(motion) in PLAIN_MOTIONS and isinstance(scene, Scene) and not scene.curved:
        free = _of_one(kept(scene, _prepared), pose, motion)
        if free is not None:
            return free
    return _is_free_motion(scene, pose, motion)


@checked
def _is_free_motion(scene: Scene, pose: PoseLike, motion: Motion) -> bool:
    return MotionChecker(scene)._decided(to_pose(pose, "pose"), motion)


def _of_one(core: _core.MotionChecker, pose: Any, motion: Motion) -> bool | None:
    """Return the verdict of the core, if the pose is a `Pose`, or one in doubles."""
    return core.is_free(for_core(pose), motion, type(motion) is Rotation)


def _prepared(scene: Scene) -> _core.MotionChecker:
    return _core.MotionChecker(scene_features(scene).core)


@checked
def first_contact(scene: Scene, pose: PoseLike, motion: Motion) -> FirstContact | None:
    """Return the place where a motion first becomes forbidden; None if it is free.

    Examples
    --------
    >>> from cfree.collision.motion import Rotation
    >>> from cfree.scene.scene import Scene
    >>> rod = [(-5, -1), (5, -1), (5, 0), (-5, 0)]
    >>> scene = Scene(robot=rod, obstacles=[[(-9, 3), (9, 3), (9, 9), (-9, 9)]])
    >>> found = first_contact(scene, Pose(0, 0), Rotation((0, 0), "90deg"))  # (5, 0) arrives at (4, 3)
    >>> print(found.at, found.contact)
    1/3 VertexEdge(i=2, j=0)
    """
    return MotionChecker(scene)._first_contact(to_pose(pose, "pose"), motion)


def _first_among_arcs(scene: Scene, arcs: ArcScene, first: Pose, motion: Motion) -> FirstContact | None:
    contact = arcs.first_contact(first, motion)
    if contact is None:
        return None
    low, high, part, obstacle = contact
    from cfree.collision.entered import entered_contact

    is_entered = low > 0 or arcs.is_free(first)
    entered = entered_contact(scene, part, obstacle, motion.at(first, low), motion) if is_entered else None
    return FirstContact(Surd(low), part, obstacle, entered, high - low)


def _crossing(polynomial: list[int]) -> Surd:
    """Return the zero at which a quadratic (or linear) polynomial, its constant first, is increasing."""
    c, b, a = (*polynomial, 0)[:3]
    if a == 0:
        return Surd(Fraction(-c, b))
    return Surd(Fraction(-b, 2 * a), Fraction(1, 2 * a), b * b - 4 * a * c)


def _polygon(shape: ShapeFeatures, piece: int) -> int:
    if shape.core.piece_layer[piece] != BODY:
        return BOUNDS if len(shape.pieces[piece]) > 1 else 0
    return int(shape.owner_polygon[shape.pieces[piece][0]])


def _extent(shape: ShapeFeatures) -> tuple[Fraction, Fraction, Fraction, Fraction]:
    """Return the outer rim of the frame around the workspace, which encloses everything."""
    points = [p for p, layer in zip(shape.vertices, shape.core.layer, strict=False) if layer == BODY]
    xs, ys = ([Fraction(c, shape.scale) for c in axis] for axis in zip(*points, strict=True))
    return min(xs), min(ys), max(xs), max(ys)
