"""Separations: closed surfaces in C that prove that no motion leads from one pose to another.

docs/theory/separations.md has the proofs, docs/answer-format.md the files. `cfree.verify.answer` checks them without
this code.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from typing import Literal, NoReturn

import cfree._core as _core
from cfree.arguments import checked
from cfree.collision.motion_checker import MotionChecker
from cfree.contact.kind import Kind
from cfree.errors import InvalidPoseError
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose, PoseLike, to_pose
from cfree.forbidden.columns import CODED, COLUMNS, Ints, Trapezoids
from cfree.free.space import FORBIDDEN, FreeSpace
from cfree.libraries import NDArray, np
from cfree.planning.caller import Caller
from cfree.planning.core_ways import numbers_of
from cfree.polygons.polygon import Polygon, polygon_of
from cfree.scene.digest import Stamp, Whole
from cfree.scene.features import SceneFeatures, unpacked
from cfree.scene.frame import frame_of
from cfree.scene.goals import Moved, text_of
from cfree.scene.grown_cores import Cores
from cfree.scene.scene import Bounds, Scene
from cfree.value import Answer, Shown, Value
from cfree.words import counted, listed

NO_TRUTH_VALUE = "a proof that there is no path is neither true nor false; ask isinstance(answer, cfree.Path)"


@dataclass(frozen=True)
class Auxiliary:
    """A point, or a line through two points, that names an angle or a curve and is no feature of the scene.

    Attributes
    ----------
    of : "robot" or "obstacles"
        The shape in whose frame it is, and among whose features it has its number.
    kind : "vertex" or "edge"
    number : int
    points : one exact point, or two
    """

    of: Literal["robot", "obstacles"]
    kind: Literal["vertex", "edge"]
    number: int
    points: tuple[ExactPoint, ...]


@dataclass(frozen=True, eq=False, repr=False)
class Pieces(Value):
    """A closed surface made of pieces of contact surfaces, as columns of equal length N.

    Attributes
    ----------
    kind : (N,) uint8
        Contacts: 1 a vertex of the robot on an edge of an obstacle, 2 an edge of the robot on a vertex of an obstacle;
        among grown cores 3 plus 16 times the quadrant: discs about two vertices.
    robot, obstacle : (N, 2) int32
        Polygon, and its vertex or the one where its edge begins. -1 is the bounds, and the reference point. -2 is the
        workspace's complement: vertices are the workspace's, and its edges run against the workspace's rings.
    table : Trapezoids
        Their angles and curves; patch k belongs to contact k.
    auxiliary : tuple of Auxiliary
        Names in the table that are no features of the scene: diagonals of convex pieces, corners beyond the bounds.
    """

    kind: NDArray[np.uint8]
    robot: Ints
    obstacle: Ints
    table: Trapezoids
    auxiliary: tuple[Auxiliary, ...] = ()

    def __len__(self) -> int:
        return len(self.kind)

    @classmethod
    def _of(cls, core: _core.Separation) -> Pieces:
        """Wrap the trapezoids of a separating surface of the core."""
        features = SceneFeatures.of(core.features)
        pieces = cls._of_faces(features, core.boundary, core.faces)
        return replace(pieces, auxiliary=tuple(_auxiliary(features, pieces.table)))

    @classmethod
    def _of_faces(cls, features: SceneFeatures, boundary: _core.Boundary, faces: Ints) -> Pieces:
        """Wrap some trapezoids of a boundary of the core, without auxiliary names."""
        patches, trapezoids = boundary.patches, boundary.trapezoids
        patch = trapezoids.patch[faces]
        robot, obstacle = (
            np.column_stack([shape.owner_polygon[number[patch]], shape.owner_vertex[number[patch]]])
            for shape, number in ((features.robot, patches.robot), (features.obstacles, patches.obstacle))
        )
        columns = {name: getattr(trapezoids, name)[faces] for name in COLUMNS}
        columns["patch"] = np.arange(len(faces), dtype=np.int32)
        return cls(patches.kind[patch], robot, obstacle, Trapezoids(**columns))


def _auxiliary(features: SceneFeatures, table: Trapezoids) -> Iterator[Auxiliary]:
    """Yield the points and lines that a table names and the rings of the scene's polygons do not have."""
    codes = np.unique(np.concatenate([getattr(table, name) for name in CODED]))
    kind, i, j = unpacked(codes[codes > 0])
    for side, shape, number, first in (
        ("robot", features.robot, i, Kind.VERTEX_EDGE),
        ("obstacles", features.obstacles, j, Kind.EDGE_VERTEX),
    ):
        is_vertex = (kind == first) | (kind == Kind.VERTEX_VERTEX)
        owned = np.append(shape.owner_vertex >= 0, False)
        foreign = ~owned[np.minimum(number, len(owned) - 1)]
        for name, chosen in (("vertex", is_vertex), ("edge", ~is_vertex)):
            for k in np.unique(number[foreign & chosen]).tolist():
                ends = (k,) if name == "vertex" else (int(shape.v[k]), int(shape.w[k]))
                points = [[Fraction(c, shape.scale) for c in shape.vertices[end]] for end in ends]
                yield Auxiliary(side, name, k, tuple((x, y) for x, y in points))  # type: ignore[arg-type]


@dataclass(frozen=True, repr=False)
class Separated(Shown, Answer):
    """A proof that no motion joins two poses.

    It has no truth value: ``if cfree.plan(scene):`` raises a `TypeError` where no path exists.
    ``isinstance(answer, cfree.Path)`` tells paths from proofs.

    Attributes
    ----------
    start, goal : Pose or (x, y, theta)
    of : "closed" or "interior"
        "closed": no path at all joins them, not even one that touches obstacles all the way. "interior": no path that
        keeps a distance from obstacles, bounds and workspace joins them.
    pieces : Pieces
        The separating surface, which is closed.
    obstacles : tuple of int
        The blocking obstacles, whose contacts form it; -1 is the bounds, -2 the workspace.
    robot : tuple of Polygon
        If closed, the robot whose contacts form the surface; it is strictly inside the scene's robot: a little smaller,
        or one convex polygon where gates are narrower than the robot. For a clearance, each part of it is instead
        within that distance of one of `cores`.
    bounds : four numbers, optional
        If closed, and the scene has bounds: larger bounds, with the scene's strictly inside.
    units, frame : str
        Unit of length, and name of the world's frame, for files.
    scene : Scene, optional
        The scene of the proof; None if it was read from a file.
    stamp : Stamp, optional
        The scene's stamp in the file.
    clearance : Fraction
        If not 0: no path that keeps at least this distance from obstacles and workspace joins them.
    cores : tuple of Polygon
        For a clearance: convex polygons inside the scene's robot, one for each polygon of `robot`.
    curved : Scene, optional
        The scene with round shapes, if it is a proof for these; `scene` has polygons inside them.
    moved : Moved, optional
        The requested start and goal, if they were moved to free poses.
    whole : Whole, optional
        The scene of which `scene` has only some obstacles, if a folder was asked.
    rounded : Cores, optional
        The grown cores whose contacts form the surface, instead of `robot`; discs of theirs are smaller than the
        scene's, or than a clearance.
    """

    start: Pose
    goal: Pose
    of: Literal["closed", "interior"]
    pieces: Pieces = field(repr=False)
    robot: tuple[Polygon, ...] = field(default=(), repr=False)
    bounds: Bounds | None = field(default=None, repr=False)
    units: str = field(default="", compare=False, repr=False)
    frame: str = field(default="world", compare=False, repr=False)
    scene: Scene | None = field(default=None, compare=False, repr=False)
    stamp: Stamp | None = field(default=None, compare=False, repr=False)
    clearance: Fraction = field(default=Fraction(0), repr=False)
    cores: tuple[Polygon, ...] = field(default=(), repr=False)
    curved: Scene | None = field(default=None, compare=False, repr=False)
    moved: Moved | None = field(default=None, repr=False)
    whole: Whole | None = field(default=None, compare=False, repr=False)
    rounded: Cores | None = field(default=None, repr=False)

    def __bool__(self) -> NoReturn:
        raise TypeError(f"{type(self).__name__}: {NO_TRUTH_VALUE}")

    def __repr__(self) -> str:
        obstacles = listed([str(k) for k in self.obstacles], ", ")
        pieces = counted(len(self.pieces), "piece")
        return f"Separated(of={self.of!r}, {pieces} of ({obstacles}))"

    @cached_property
    def obstacles(self) -> tuple[int, ...]:
        return tuple(np.unique(self.pieces.obstacle[:, 0]).tolist())

    @classmethod
    def _of(cls, core: _core.Separation, scene: Scene, start: Pose, goal: Pose) -> Separated:
        """Wrap a proof of the core about a scene."""
        pieces = Pieces._of(core)
        if not core.is_closed:
            return cls(start, goal, "interior", pieces, units=scene.units, frame=frame_of(scene), scene=scene)
        robot, bounds = tuple(map(polygon_of, core.robot)), None
        if core.bounds is not None:
            x0, y0, x1, y1 = (Fraction(n, d) for n, d in core.bounds)
            bounds = x0, y0, x1, y1
        return cls(start, goal, "closed", pieces, robot, bounds, scene.units, frame_of(scene), scene=scene)

    def reversed(self) -> Separated:
        """Return the same proof with start and goal swapped, without the requested ones."""
        return replace(self, start=self.goal, goal=self.start, moved=None)


class Insets:
    """Scenes with a slightly smaller robot, in bounds larger by as much; their results are cached.

    Parameters
    ----------
    scene : Scene

    Attributes
    ----------
    powers : list of int
        Insets that a proof may need, as powers of two of the robot's size.
    size : int
        Exponent of the power of two that is about as large as the robot.
    """

    def __init__(self, scene: Scene) -> None:
        self.checker = MotionChecker(scene)
        self._handle = _core.Insets(self.checker.features.made)
        self.powers, self.size = self._handle.powers, self._handle.size


@checked
def separation(
    space: FreeSpace,
    start: PoseLike,
    goal: PoseLike,
    powers: Sequence[int] | None = None,
    insets: Insets | None = None,
) -> Separated | None:
    """Prove that no motion joins two free poses; return None if they are in the closure of one cell, and so joined.

    Parameters
    ----------
    space : FreeSpace
    start, goal : Pose or (x, y, theta)
        Must be free.
    powers : sequence of int, optional
        The insets to try for "closed", in this order, as exponents of 2 relative to the robot's size. By default from
        -20 on, doubled each time, as long as the digits of the scene suggest that a gap may be that narrow.
    insets : Insets, optional
        Insets of the space's scene. If several calls share them, they are computed once.

    Returns
    -------
    Separated, or None
        ``of`` is "closed" if they are also separated for a robot smaller by 2**-20 of its size or less, else
        "interior".

    Raises
    ------
    InvalidPoseError
        If a pose is forbidden.

    Notes
    -----
    For a smaller robot only the closed surfaces around the two poses are computed, unless these touch something.

    Examples
    --------
    >>> import cfree
    >>> hollow = cfree.Polygon([(-1, -1), (10, -1), (10, 10), (-1, 10)], [[(0, 0), (0, 9), (9, 9), (9, 0)]])
    >>> space = cfree.free_space(cfree.boundary(cfree.Scene([(0, 0), (2, 0), (0, 1)], [hollow])))
    >>> proof = separation(space, cfree.Pose(4, 4), cfree.Pose(20, 0))
    >>> proof.of, proof.obstacles
    ('closed', (0,))
    """
    start = to_pose(start, "start")
    goal = to_pose(goal, "goal")
    cells = space.locate([start, goal]).tolist()
    for name, pose, cell in zip(("start", "goal"), (start, goal), cells, strict=True):
        if cell == FORBIDDEN:
            raise InvalidPoseError(f"{name} {text_of(pose)} is forbidden")
    if start == goal or space.common_cell(start, goal) is not None:
        return None
    scene = space.boundary.scene
    insets = insets or Insets(scene)
    known = known_scene(insets.checker, space)
    chosen = insets.powers if powers is None else list(powers)
    proof = _core.separation(known, insets._handle, numbers_of(start), numbers_of(goal), chosen, Caller())
    return Separated._of(proof, scene, start, goal)


def known_scene(checker: MotionChecker, space: FreeSpace | None = None) -> _core.KnownScene:
    """Return the core's cache of results about a checker's scene, with its free space if that is known."""
    known = _core.KnownScene(checker.features.made, checker._handle)
    if space is not None:
        known.keep(space.boundary._handle, space.surfaces._complex_handle, space._handle)
    return known
