"""Poses q = (r, theta) of the robot.

Paper, section 1.1: a(q) = r + R(theta) a in the geometrical model (eqs. 1, 3), and the same with
tau = tan(theta / 2) in the rational model (eq. 2).
"""

from __future__ import annotations

import math
import reprlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from cfree.arguments import checked
from cfree.errors import InvalidPoseError
from cfree.exact.half_angle import (
    Angle,
    half_angle_rotation,
    normalize_angles,
    read_angle,
    sum_of_angles,
    theta_from,
    to_chart,
    to_rational,
)
from cfree.exact.number import ExactPoint, Number, is_single
from cfree.exact.orientation import Vector
from cfree.libraries import ArrayLike, Floats, NDArray, is_array, np
from cfree.value import Value


@dataclass(frozen=True, slots=True, init=False)
class Pose:
    """Exact pose: position of the reference point and rotation of the robot.

    Parameters
    ----------
    x, y : int, float, Fraction, Decimal or str
        Position, in the scene's unit of length.
    theta : the same in radians, or "90deg", or "1.5rad", or {"tau": "p/q"}
        Any value, normalised to [0, 2 pi). Radians within one ulp of a multiple of pi/2 mean that multiple, and
        multiples of 90 degrees are exact. The half turn is {"tau": "inf"} or {"tau": None}. Other angles in radians or
        degrees are replaced by the simplest tau within rounding of the tangent of their half.

    Attributes
    ----------
    x, y : Fraction
    tau : Fraction or None
        tan(theta / 2), in lowest terms; None is the half turn.
    theta : float, radians
        The angle as given, normalised to [0, 2 pi).
    theta_error : float, radians
        Bound on the distance of the input angle from 2 atan(tau); 0 if `tau` was the input.

    Notes
    -----
    Equality compares x, y and tau, exactly.

    Examples
    --------
    >>> import math
    >>> q = Pose(1, "1/2", "90deg")
    >>> q.tau, q.cos, q.sin
    (Fraction(1, 1), Fraction(0, 1), Fraction(1, 1))
    >>> q.apply_exact([(2, 0)])
    ((Fraction(1, 1), Fraction(5, 2)),)
    >>> Pose(0, 0, math.pi) == Pose(0, 0, {"tau": "inf"})
    True
    >>> Pose(0, 0, 2 * math.atan(1 / 3)).tau
    Fraction(1, 3)
    """

    x: Fraction
    y: Fraction
    tau: Fraction | None
    theta: float = field(compare=False)
    theta_error: float = field(compare=False)

    def __init__(self, x: Number, y: Number, theta: Angle = 0) -> None:
        object.__setattr__(self, "x", to_rational("x", x))
        object.__setattr__(self, "y", to_rational("y", y))
        for name, value in zip(("tau", "theta", "theta_error"), read_angle(theta), strict=True):
            object.__setattr__(self, name, value)

    @property
    def rotation(self) -> tuple[int, int, int]:
        """Integers (c, s, w) with cos theta = c / w, sin theta = s / w, w = sqrt(c^2 + s^2)."""
        return half_angle_rotation(self.tau)

    @property
    def integers(self) -> tuple[int, int, int]:
        """Integers (X, Y, W) with x = X / W, y = Y / W."""
        x, y = self.x, self.y
        unit = math.lcm(x.denominator, y.denominator)
        return x.numerator * (unit // x.denominator), y.numerator * (unit // y.denominator), unit

    @property
    def cos(self) -> Fraction:
        """Exact cosine of the angle 2 atan(tau)."""
        c, _, w = self.rotation
        return Fraction(c, w)

    @property
    def sin(self) -> Fraction:
        """Exact sine of the angle 2 atan(tau)."""
        _, s, w = self.rotation
        return Fraction(s, w)

    @property
    def chart(self) -> tuple[int, Fraction]:
        """Chart and exact coordinate in it; an angle on the border belongs to chart 0.

        Examples
        --------
        >>> Pose(0, 0, "180deg").chart, Pose(0, 0, {"tau": 2}).chart
        ((1, Fraction(0, 1)), (1, Fraction(-1, 2)))
        """
        return to_chart(self.tau)

    @checked
    def apply(self, points: ArrayLike) -> Floats:
        """Move points of the robot, (..., 2) floats, to this pose.

        Examples
        --------
        >>> Pose(1, 0, "90deg").apply([[2, 0], [0, 3]])
        array([[ 1.,  2.],
               [-2.,  0.]])
        """
        a = np.asarray(points, dtype=np.float64)
        c, s = float(self.cos), float(self.sin)
        x, y = c * a[..., 0] - s * a[..., 1], s * a[..., 0] + c * a[..., 1]
        return np.stack((float(self.x) + x, float(self.y) + y), axis=-1)

    @checked
    def apply_exact(self, points: Iterable[Vector]) -> tuple[ExactPoint, ...]:
        """Move exact points of the robot to this pose: eq. (3) in the rational model."""
        c, s, w = self.rotation
        moved = []
        for a, b in points:  # integers are faster
            (m, i), (n, j) = a.as_integer_ratio(), b.as_integer_ratio()
            m, n, unit = m * j, n * i, w * i * j
            moved.append((self.x + Fraction(c * m - s * n, unit), self.y + Fraction(s * m + c * n, unit)))
        return tuple(moved)

    def __matmul__(self, other: Pose) -> Pose:
        """Compose poses: first `other`, then this one. Exact; the errors of the angles add up.

        Examples
        --------
        >>> Pose(1, 0, "90deg") @ Pose(1, 0, "90deg") == Pose(1, 1, "180deg")
        True
        """
        ((x, y),) = self.apply_exact([(other.x, other.y)])
        return pose_at(x, y, sum_of_angles(self.tau, other.tau), self.theta_error + other.theta_error)

    def inverse(self) -> Pose:
        """Pose that undoes this one.

        Examples
        --------
        >>> q = Pose(3, "1/7", {"tau": "2/5"})
        >>> q @ q.inverse() == Pose(0, 0, 0) == q.inverse() @ q
        True
        """
        tau = None if self.tau is None else -self.tau
        c, s, w = half_angle_rotation(tau)
        x, y = Fraction(s * self.y - c * self.x, w), Fraction(-s * self.x - c * self.y, w)
        return pose_at(x, y, tau, self.theta_error)


PoseLike = Pose | Sequence[Any]  # or (x, y, theta), as `Pose` takes them


OnePose = Pose | tuple[Number, Number, Angle]  # the same, for functions that also take many poses


PLAIN = frozenset({tuple, list, Pose})  # kinds of poses that the core is asked about first, beside arrays


def is_plain(poses: object) -> bool:
    """True if the core is asked about these poses first."""
    return type(poses) in PLAIN or is_plain_array(poses)


def is_plain_array(value: object) -> bool:
    """True if a value is an array and of no subclass."""
    return is_array(value) and type(value) is np.ndarray


def for_core(poses: Any) -> Any:
    """Return plain poses as the core reads them: lists for arrays of three numbers, and nothing for larger arrays.

    Examples
    --------
    >>> for_core(np.array([1, 2, 0.5])), for_core((1, 2, 0)), for_core(np.zeros((9, 3)))
    ([1.0, 2.0, 0.5], (1, 2, 0), ())
    """
    if not is_plain_array(poses):
        return poses
    return poses.tolist() if poses.size == 3 else ()


def one_pose(value: object, name: str) -> Pose | None:
    """Return the pose if the value is one pose; None if it is many.

    Examples
    --------
    >>> one_pose((1, 2, 0), "poses") == Pose(1, 2), one_pose([(1, 2, 0)], "poses")
    (True, None)
    """
    if isinstance(value, Pose):
        return value
    if not (isinstance(value, Sequence) or is_array(value)) or isinstance(value, str) or len(value) != 3:
        return None
    is_one = all(is_single(part) and not isinstance(part, Pose) for part in value)
    return to_pose(value, name) if is_one else None  # type: ignore[arg-type]


def to_pose(value: PoseLike, name: str = "pose") -> Pose:
    """Convert to a pose: a `Pose`, or x, y and theta as `Pose` takes them.

    Raises
    ------
    InvalidPoseError, TypeError
        If the value is neither; the message has `name`.

    Examples
    --------
    >>> to_pose((1, "1/2", "90°"), "start") == Pose(1, "1/2", "90deg")
    True
    >>> to_pose((1, 2), "start")
    Traceback (most recent call last):
        ...
    cfree.errors.InvalidPoseError: start: (1, 2) is no pose; give a Pose, or x, y and theta
    """
    if isinstance(value, Pose):
        return value
    if isinstance(value, str | bytes | Mapping | set) or not isinstance(value, Iterable):
        raise TypeError(f"{name}: {reprlib.repr(value)} is no pose; give a Pose, or x, y and theta")
    numbers = tuple(value)
    if len(numbers) != 3:
        raise InvalidPoseError(f"{name}: {reprlib.repr(value)} is no pose; give a Pose, or x, y and theta")
    try:
        return Pose(*numbers)
    except InvalidPoseError as error:
        raise InvalidPoseError(f"{name}: {error}") from None


@checked
@dataclass(frozen=True, eq=False, repr=False)
class Poses(Value):
    """Many poses in double precision; indexing gives an exact `Pose`.

    Parameters
    ----------
    xy : (n, 2) float64
    theta : (n,) float64, radians
        Any values, normalised to [0, 2 pi). Values within one ulp of a multiple of pi/2 mean that multiple.

    Examples
    --------
    >>> turns = Poses([[0, 0], [1, 0]], np.radians([0, 90]))
    >>> turns[1] == Pose(1, 0, "90deg")
    True
    >>> turns.apply([[2, 0]])[:, 0]
    array([[2., 0.],
           [1., 2.]])
    """

    xy: Floats
    theta: Floats

    def __init__(self, xy: ArrayLike, theta: ArrayLike) -> None:
        positions, angles = np.array(xy, dtype=np.float64), np.array(theta, dtype=np.float64)
        if angles.ndim != 1 or positions.shape != (len(angles), 2):
            raise InvalidPoseError(f"shapes {positions.shape} of xy and {angles.shape} of theta; give (n, 2) and (n,)")
        bad = np.flatnonzero(~(np.isfinite(positions).all(axis=1) & np.isfinite(angles)))
        if len(bad):
            k = int(bad[0])
            raise InvalidPoseError(f"pose {k}: {positions[k]}, {angles[k]} is not finite; give finite numbers")
        object.__setattr__(self, "xy", _read_only(positions))
        object.__setattr__(self, "theta", _read_only(normalize_angles(angles)))

    @classmethod
    @checked
    def from_poses(cls, poses: Iterable[Pose]) -> Poses:
        """Round poses to doubles."""
        rows = [(float(q.x), float(q.y), q.theta) for q in poses]
        table = np.array(rows, dtype=np.float64).reshape(-1, 3)
        return cls(table[:, :2], table[:, 2])

    def __len__(self) -> int:
        return len(self.theta)

    def __getitem__(self, index: int) -> Pose:
        return Pose(float(self.xy[index, 0]), float(self.xy[index, 1]), float(self.theta[index]))

    def __iter__(self) -> Iterator[Pose]:
        return (self[k] for k in range(len(self)))

    @checked
    def apply(self, points: ArrayLike) -> Floats:
        """Move points (k, 2) of the robot to every pose: (n, k, 2)."""
        a = np.asarray(points, dtype=np.float64)
        return self.xy[:, None, :] + _rotate(self.theta[:, None], a)

    def __matmul__(self, other: Poses) -> Poses:
        """Compose row by row: first the pose of `other`, then this one."""
        return Poses(self.xy + _rotate(self.theta, other.xy), self.theta + other.theta)

    def inverse(self) -> Poses:
        """Poses that undo these."""
        return Poses(-_rotate(-self.theta, self.xy), -self.theta)


def pose_at(x: Fraction, y: Fraction, tau: Fraction | None, theta_error: float = 0.0) -> Pose:
    """Return the pose of exact numbers; they are not checked.

    Examples
    --------
    >>> pose_at(Fraction(1), Fraction(2), Fraction(1)) == Pose(1, 2, "90deg")
    True
    """
    pose = object.__new__(Pose)
    values = (x, y, tau, theta_from(tau), theta_error)
    for name, value in zip(Pose.__slots__, values, strict=True):
        object.__setattr__(pose, name, value)
    return pose


def _split(theta: Floats) -> tuple[NDArray[np.int64], Floats]:
    """Split into the nearest number of quarter turns and the rest, 0 within one ulp."""
    quarter_turns = np.rint(theta / (np.pi / 2))
    rest = theta - quarter_turns * (np.pi / 2)
    rest = np.where(np.abs(rest) <= np.spacing(np.abs(theta)), 0.0, rest)
    return quarter_turns.astype(np.int64), rest


def _rotate(theta: Floats, points: Floats) -> Floats:
    """Rotate points (..., 2) by theta (...), exactly at multiples of pi/2."""
    quarter_turns, rest = _split(theta)
    c0, s0 = np.cos(rest), np.sin(rest)
    turned = quarter_turns % 4
    c = np.choose(turned, (c0, -s0, -c0, s0))
    s = np.choose(turned, (s0, c0, -s0, -c0))
    x, y = points[..., 0], points[..., 1]
    return np.stack((c * x - s * y, s * x + c * y), axis=-1)


def _read_only(array: Floats) -> Floats:
    array.setflags(write=False)
    return array
