"""Motions of the robot: translations, rotations about a pole of at most half a turn, and slides; exact.

Every displacement of the plane is a translation or a rotation (Chasles). A pure rotation moves on the helix of its
pole (the paper's Lemma 1 and Remark 2), a translation on a straight line of the configuration space.

A motion has a parameter u in [0, 1] in which all of it is rational. For a translation, u is the share of the vector.
For a rotation, half the angle turned at u is the angle of (1 - u) (L, 0) + u (q, p). Here tau = p / q belongs to the
whole, and L is the length of (q, p), rounded down. So u is nearly, but not exactly, the share of the angle.

Translations, rotations and slides share one interface, so callers need not distinguish them:

    kind                            "translation", "rotation" or "slide".
    pole, vector                    The point that stays in place; if there is none, the reference point's displacement.
    tau, turn                       Half-angle tangent and angle of the whole, 0 for translations.
    contacts                        The two that a slide keeps; () for other motions.
    numbers                         The exact numbers that define it, by their names in files.
    apply, at, sample               Poses: the last one, the one at u, several at shares of the length or angle.
    until, between, reversed        Motions: parts, and the way back.
    share, parameter                The share of the length or angle done at u, and its inverse.
    length, reach                   Distances that the reference point, and other points, move from a pose.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, ClassVar, Literal

from cfree.arguments import checked
from cfree.collision.slide import Slide, Touch
from cfree.errors import InvalidPoseError
from cfree.exact.half_angle import Angle, half_angle_rotation, number_and_unit, sum_of_angles
from cfree.exact.number import ExactPoint, Number, to_fraction
from cfree.exact.number import angle as angle_of
from cfree.exact.pose import Pose, PoseLike, Poses, pose_at, to_pose
from cfree.libraries import ArrayLike, np

MOST_HALVES = 1000
ROTATION = ("pole", "tau", "clockwise", "angle_error")  # attributes of a rotation


@dataclass(frozen=True, init=False)
class Translation:
    """Straight motion without turning.

    Parameters
    ----------
    vector : pair of numbers
        In the world, in the scene's unit of length.

    Raises
    ------
    InvalidPoseError
        If it is no pair of finite numbers.

    Examples
    --------
    >>> move = Translation(("1/3", 2))
    >>> move.apply(Pose(0, 0, "90deg")) == Pose("1/3", 2, "90deg")
    True
    """

    kind: ClassVar[Literal["translation"]] = "translation"
    pole: ClassVar[None] = None
    tau: ClassVar[Fraction] = Fraction(0)
    turn: ClassVar[float] = 0.0
    contacts: ClassVar[tuple[Touch, ...]] = ()
    vector: ExactPoint

    def __init__(self, vector: tuple[Number, Number]) -> None:
        object.__setattr__(self, "vector", _point("vector", vector))

    @property
    def displacement(self) -> Pose:
        """The whole motion as an element of SE(2)."""
        return Pose(*self.vector)

    @property
    def numbers(self) -> dict[str, Any]:
        """The vector, by its name in files."""
        return {"vector": self.vector}

    @checked
    def apply(self, pose: PoseLike) -> Pose:
        """Return the pose at the end, exactly."""
        pose, (x, y) = to_pose(pose, "pose"), self.vector
        return pose_at(pose.x + x, pose.y + y, pose.tau, pose.theta_error)

    @checked
    def at(self, pose: PoseLike, u: Number) -> Pose:
        """Return the pose at the parameter u in [0, 1], exactly."""
        pose = to_pose(pose, "pose")
        return self.until(u).apply(pose)

    @checked
    def until(self, u: Number) -> Translation:
        """Return the part of the motion from 0 to u."""
        return self.between(0, u)

    @checked
    def between(self, u: Number, v: Number) -> Translation:
        """Return the part of the motion from u to v."""
        share = to_fraction(v) - to_fraction(u)
        return Translation((share * self.vector[0], share * self.vector[1]))

    def reversed(self) -> Translation:
        """Return the motion back."""
        return Translation((-self.vector[0], -self.vector[1]))

    @checked
    def sample(self, pose: PoseLike, shares: ArrayLike) -> Poses:
        """Return poses at shares of the length, (n,), in double precision."""
        pose = to_pose(pose, "pose")
        s = np.asarray(shares, dtype=np.float64)
        start, vector = np.array([float(pose.x), float(pose.y)]), np.array([float(v) for v in self.vector])
        return Poses(start + s[:, None] * vector, np.full(len(s), pose.theta))

    @checked
    def share(self, u: Number) -> float:
        """Return the share of the length done at u, which is u."""
        return float(to_fraction(u))

    @checked
    def parameter(self, share: float) -> Fraction:
        """Return the parameter at which a share of the length is done."""
        return Fraction(share)

    @checked
    def length(self, pose: PoseLike) -> float:
        """Return the path length of the reference point, which is the same from any pose."""
        return math.hypot(*map(float, self.vector))

    @checked
    def reach(self, pose: PoseLike, points: ArrayLike) -> float:
        """Return the path length of some points of the robot: all move equally far."""
        return self.length(pose)


@dataclass(frozen=True, init=False)
class Rotation:
    """Turn about a point that stays in place, by at most half a turn.

    Parameters
    ----------
    pole : pair of numbers
        In the world.
    angle : float in radians, or "-90deg", or {"tau": "p/q"}
        Counter-clockwise if positive. {"tau": "inf"} is half a turn counter-clockwise, {"tau": "-inf"} clockwise.
        An angle with an irrational half-angle tangent is replaced as in `Pose`.

    Attributes
    ----------
    tau : Fraction or None
        Tangent of half the angle; None is half a turn.
    clockwise : bool
    angle_error : float, radians
        Bound on the difference from the angle passed in.

    Raises
    ------
    InvalidPoseError
        If the angle is more than half a turn (see `rotations`), or something is no number.

    Examples
    --------
    >>> move = Rotation((1, 0), "-90deg")
    >>> move.apply(Pose(0, 0)) == Pose(1, 1, "270deg"), move.turn
    (True, -1.5707963267948966)
    """

    kind: ClassVar[Literal["rotation"]] = "rotation"
    contacts: ClassVar[tuple[Touch, ...]] = ()
    pole: ExactPoint
    tau: Fraction | None
    clockwise: bool
    angle_error: float = field(compare=False)

    def __init__(self, pole: tuple[Number, Number], angle: Angle) -> None:
        try:
            turned = Pose(0, 0, angle)
        except InvalidPoseError as error:
            raise InvalidPoseError(str(error).replace("theta", "angle", 1).replace("tau", "angle: tau", 1)) from None
        if isinstance(angle, Mapping):
            clockwise = angle["tau"] in ("-inf", -math.inf) if turned.tau is None else turned.tau < 0
        else:
            clockwise, most = _size(angle)
            if most > math.pi * (1 + 2**-51):
                raise InvalidPoseError(
                    f"angle {angle!r} is more than half a turn; divide it, as cfree.collision.rotations does"
                )
        values = (_point("pole", pole), turned.tau, clockwise, turned.theta_error)
        for name, value in zip(ROTATION, values, strict=True):
            object.__setattr__(self, name, value)

    @property
    def angle(self) -> float:
        """Signed angle in radians, in [-pi, pi]."""
        return 2 * angle_of(*self.half)

    @property
    def turn(self) -> float:
        """The signed angle, by the name that all motions share."""
        return self.angle

    @property
    def half(self) -> tuple[int, int]:
        """Integers (q, p), q >= 0, along the direction of half the angle: tau = p / q."""
        if self.tau is None:
            return 0, -1 if self.clockwise else 1
        return self.tau.denominator, self.tau.numerator

    @property
    def displacement(self) -> Pose:
        """The whole motion as an element of SE(2)."""
        turned = Pose(0, 0, {"tau": self.tau})
        ((x, y),) = turned.apply_exact([self.pole])
        return Pose(self.pole[0] - x, self.pole[1] - y, {"tau": self.tau})

    @property
    def numbers(self) -> dict[str, Any]:
        """Pole and half-angle tangent, by their names in files; "inf" or "-inf" for half a turn."""
        tau = ("-inf" if self.clockwise else "inf") if self.tau is None else self.tau
        return {"pole": self.pole, "tau": tau}

    @checked
    def apply(self, pose: PoseLike) -> Pose:
        """Return the pose at the end, exactly."""
        pose = to_pose(pose, "pose")
        (c, s, w), (x, y) = half_angle_rotation(self.tau), self.pole
        u, v = pose.x - x, pose.y - y
        return pose_at(
            x + (c * u - s * v) / w, y + (s * u + c * v) / w, sum_of_angles(self.tau, pose.tau), pose.theta_error
        )

    @checked
    def at(self, pose: PoseLike, u: Number) -> Pose:
        """Return the pose at the parameter u in [0, 1], exactly."""
        pose = to_pose(pose, "pose")
        return self.until(u).apply(pose)

    @checked
    def until(self, u: Number) -> Rotation:
        """Return the part of the motion from 0 to u."""
        share, (q, p) = to_fraction(u), self.half
        cosine, sine = (1 - share) * self.first + share * q, share * p
        if cosine:
            return Rotation(self.pole, {"tau": sine / cosine})
        return Rotation(self.pole, {"tau": "-inf" if sine < 0 else "inf"})

    @checked
    def between(self, u: Number, v: Number) -> Rotation:
        """Return the part of the motion from u to v."""
        (q0, p0), (q1, p1) = self.until(u).half, self.until(v).half
        q, p = q0 * q1 + p0 * p1, q0 * p1 - p0 * q1  # the second half angle less the first
        return Rotation(self.pole, {"tau": Fraction(p, q) if q else "-inf" if p < 0 else "inf"})

    @property
    def first(self) -> int:
        """The number L that defines the parameter."""
        q, p = self.half
        return math.isqrt(q * q + p * p)

    def reversed(self) -> Rotation:
        """Return the motion back."""
        if self.tau is None:
            return Rotation(self.pole, {"tau": "inf" if self.clockwise else "-inf"})
        return Rotation(self.pole, {"tau": -self.tau})

    @checked
    def sample(self, pose: PoseLike, shares: ArrayLike) -> Poses:
        """Return poses at shares of the angle, (n,), in double precision, equally precise near a pole and far away."""
        pose = to_pose(pose, "pose")
        s, half = np.asarray(shares, dtype=np.float64), 0.5 * self.turn
        end = self.apply(pose)
        x, y = float(end.x - pose.x), float(end.y - pose.y)
        # the chord of a share: shorter by the ratio of sines, turned back by half of the remaining angle
        scale = np.sin(s * half) / math.sin(half) if half else s
        c, n = scale * np.cos((s - 1) * half), scale * np.sin((s - 1) * half)
        xy = np.stack((float(pose.x) + c * x - n * y, float(pose.y) + n * x + c * y), axis=1)
        return Poses(xy, pose.theta + s * self.turn)

    @checked
    def share(self, u: Number) -> float:
        """Return the share of the angle turned at u."""
        return self.until(u).turn / self.turn if self.turn else 0.0

    @checked
    def parameter(self, share: float) -> Fraction:
        """Return the parameter at which a share of the angle is turned, up to rounding."""
        (q, p), half = self.half, share * self.turn / 2
        c, s = math.cos(half), math.sin(half)
        # (1 - u) (L, 0) + u (q, p) has that direction
        u = s / (c * float(Fraction(p, self.first)) - s * float(Fraction(q, self.first)) + s) if s else 0.0
        return Fraction(min(max(u, 0.0), 1.0))

    @checked
    def length(self, pose: PoseLike) -> float:
        """Return the path length of the reference point from a pose."""
        pose = to_pose(pose, "pose")
        return math.hypot(float(pose.x - self.pole[0]), float(pose.y - self.pole[1])) * abs(self.turn)

    @checked
    def reach(self, pose: PoseLike, points: ArrayLike) -> float:
        """Return the path length of the farthest moving one of some points of the robot, (..., 2)."""
        pose = to_pose(pose, "pose")
        arms = pose.apply(np.asarray(points, np.float64).reshape(-1, 2)) - [float(c) for c in self.pole]
        return float(np.hypot(*arms.T).max()) * abs(self.turn)


Motion = Translation | Rotation | Slide


@checked
def motion_between(a: PoseLike, b: PoseLike) -> Translation | Rotation:
    """Return the translation from one pose to another, or the rotation by at most half a turn (Chasles).

    Examples
    --------
    >>> motion_between(Pose(1, 0), Pose(0, 1, "90deg"))
    Rotation(pole=(Fraction(0, 1), Fraction(0, 1)), tau=Fraction(1, 1), clockwise=False, angle_error=0.0)
    """
    return joining(to_pose(a, "a"), to_pose(b, "b"))


def joining(a: Pose, b: Pose) -> Translation | Rotation:
    """Return the motion of `motion_between`; the poses are not checked."""
    if a.tau == b.tau:
        return _translation((b.x - a.x, b.y - a.y))
    (q, p), (r, s) = ((0, 1) if tau is None else (tau.denominator, tau.numerator) for tau in (a.tau, b.tau))
    cosine, sine = q * r + p * s, q * s - p * r  # of half the angle between them, times the same
    (x0, y0, unit), (x1, y1, other) = a.integers, b.integers  # faster than fractions
    x0, y0, x1, y1, unit = x0 * other, y0 * other, x1 * unit, y1 * unit, 2 * unit * other * sine
    pole = (x0 + x1) * sine - cosine * (y1 - y0), (y0 + y1) * sine + cosine * (x1 - x0)
    return _rotation((Fraction(pole[0], unit), Fraction(pole[1], unit)), Fraction(sine, cosine) if cosine else None)


def _translation(vector: ExactPoint) -> Translation:
    motion = object.__new__(Translation)
    object.__setattr__(motion, "vector", vector)
    return motion


def _rotation(pole: ExactPoint, tau: Fraction | None) -> Rotation:
    """Return a rotation by 2 atan(tau), or half a turn counter-clockwise; the numbers are not checked."""
    motion = object.__new__(Rotation)
    for name, value in zip(ROTATION, (pole, tau, tau is not None and tau < 0, 0.0), strict=True):
        object.__setattr__(motion, name, value)
    return motion


@checked
def rotations(pole: tuple[Number, Number], angle: Number) -> tuple[Rotation, ...]:
    """Divide a turn of any size about a pole into rotations of at most half a turn each, all in one direction.

    Parameters
    ----------
    angle : number in radians or "400deg"
        Half turns come first. Radians within an ulp of a multiple of pi/2 mean that multiple.

    Raises
    ------
    InvalidPoseError
        If it is more than a thousand half turns, or no number.

    Examples
    --------
    >>> [move.turn / math.pi for move in rotations((0, 0), "-450deg")]
    [-1.0, -1.0, -0.5]
    """
    clockwise, size = _size(angle)
    if size > MOST_HALVES * math.pi:
        raise InvalidPoseError(f"angle {angle!r} is more than {MOST_HALVES} half turns; give less")
    halves = round(size / math.pi)
    rest = _without_halves(angle, halves)
    if rest != 0:
        halves = math.floor(size / math.pi)
        rest = _without_halves(angle, halves)
    last = () if rest == 0 else (Rotation(pole, {"tau": rest}),)
    return (*[Rotation(pole, {"tau": "-inf" if clockwise else "inf"})] * halves, *last)


def _without_halves(angle: Number, halves: int) -> Fraction | None:
    """Return the half-angle tangent of an angle less some half turns."""
    tau = Pose(0, 0, angle).tau
    if halves % 2 == 0:
        return tau
    return Fraction(0) if tau is None else -1 / tau if tau else None


def _size(angle: Number) -> tuple[bool, float]:
    """Return the sign of an angle, True if negative, and its size in radians."""
    value, unit = number_and_unit(angle)
    size = to_fraction(value)
    return size < 0, math.radians(float(abs(size))) if unit == "deg" else float(abs(size))


def _point(name: str, values: tuple[Number, Number]) -> ExactPoint:
    try:
        x, y = values
        return to_fraction(x), to_fraction(y)
    except (TypeError, ValueError) as error:
        raise InvalidPoseError(f"{name}: {error}; give two finite numbers") from None
