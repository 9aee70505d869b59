"""The whole exception tree.

    CfreeError
      InvalidPolygonError (ValueError)     not simple, too few vertices, no area; carries ring and edges
      InvalidPoseError    (ValueError)     not finite, not an angle, not free
        ForbiddenPoseError                 not free; carries a free pose near by (cfree.collision.nearest_free)
      InvalidVehicleError (ValueError)     a turning radius, axle or heading that no vehicle has
      FormatError         (ValueError)     unreadable file; carries path, line, column
      UnsupportedError    (NotImplementedError)  a documented limit of the method
        LaboriousSceneError                few vertices whose boundary takes long; carries the number of pairs
      IncompleteError     (RuntimeError)   a query of a boundary whose computation a limit stopped
        UndecidedError                     a clearance too near to the largest, carries lo and hi;
                                           or round shapes too near to each other, carries error;
                                           or too many manoeuvres, carries a path of the robot as a proof
      InvariantError      (RuntimeError)   our bug, please report; carries the smallest state seen

Messages give the place, the value and the remedy.
"""

from __future__ import annotations

import math


class CfreeError(Exception):
    """Base of every exception cfree raises on purpose."""


class InvalidPolygonError(CfreeError, ValueError):
    """Rings that do not bound a polygon.

    Parameters
    ----------
    message : str
        Place, value and remedy.
    ring : int, optional
        0 is the outer ring, k + 1 is hole k.
    edges : tuple of int, optional
        Edges at fault: edge k of a ring goes from input point k to the next point that is a vertex.

    Examples
    --------
    >>> InvalidPolygonError("outer ring: 2 points; give at least 3", ring=0).ring
    0
    """

    def __init__(self, message: str, *, ring: int | None = None, edges: tuple[int, ...] = ()) -> None:
        super().__init__(message)
        self.ring = ring
        self.edges = edges


class InvalidPoseError(CfreeError, ValueError):
    """A position or an angle that `cfree.Pose` does not accept, or a pose that is not free."""


class InvalidVehicleError(CfreeError, ValueError):
    """A turning radius, an axle point or a heading that `Car` and `DifferentialDrive` do not accept."""


class FormatError(CfreeError, ValueError):
    """A file that cannot be read, with its `path`, `line` and `column` (from 1) where known."""

    def __init__(
        self, message: str, *, path: str | None = None, line: int | None = None, column: int | None = None
    ) -> None:
        super().__init__(message)
        self.path = path
        self.line = line
        self.column = column


class UnsupportedError(CfreeError, NotImplementedError):
    """A documented limit of the method."""


class LaboriousSceneError(UnsupportedError):
    """A boundary of a scene of few vertices that would take long, estimated before it is computed.

    Parameters
    ----------
    message : str
    pairs : int
        Estimated number of pairs of a contact patch and a pillar near it.
    """

    def __init__(self, message: str, *, pairs: int = 0) -> None:
        super().__init__(message)
        self.pairs = pairs


class IncompleteError(CfreeError, RuntimeError):
    """A query that needs a complete boundary, made on one that a limit of time or memory stopped."""


class UndecidedError(IncompleteError):
    """An undecided question: a clearance too near to the largest possible, or polygons too coarse for round shapes.

    Or a path of a vehicle that needs too many manoeuvres, or leads along contacts.

    Parameters
    ----------
    message : str
    lo, hi : float
        Bounds of the largest clearance: some path keeps `lo`, or it is 0; none keeps more than `hi`, or it is infinite.
    error : float
        Smallest error tried for the polygons of the round shapes that matter, or 0.
    path : Path or None
        The proof that a path of a vehicle that reverses exists: a path of the robot that touches nothing.
    manoeuvres : int
        Estimate of the motions that such a path needs, or 0.
    margin : float
        Length by which the robot is smaller, at most, in the boxes that may lead a car without reverse gear to its
        goal; or 0.
    """

    def __init__(
        self,
        message: str,
        *,
        lo: float = 0.0,
        hi: float = math.inf,
        error: float = 0.0,
        path: object = None,
        manoeuvres: int = 0,
        margin: float = 0.0,
    ) -> None:
        super().__init__(message)
        self.margin = margin
        self.path = path
        self.manoeuvres = manoeuvres
        self.lo = lo
        self.hi = hi
        self.error = error


class InvariantError(CfreeError, RuntimeError):
    """A bug in cfree: a broken invariant. `state` is the smallest failing state found. Please report it."""

    def __init__(self, message: str, *, state: object = None) -> None:
        super().__init__(message)
        self.what = message
        self.state = state

    def __str__(self) -> str:
        return f"{self.what}; this is a bug in cfree, please report it"
