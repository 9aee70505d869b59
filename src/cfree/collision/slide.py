"""Motions along two contacts: for exact fits, where free space is too thin for translations and rotations.

As the robot turns by 2 atan(t), its reference point moves by (x(t), y(t)) / d(t), to where the lines of two contacts
meet: polynomials of degree at most 4 (docs/theory/motions.md). The parameter u in [0, 1] of a slide is t / tau.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from cfree.arguments import checked
from cfree.errors import InvalidPoseError
from cfree.exact.half_angle import to_rational
from cfree.exact.number import ExactPoint, Number, angle, to_fraction
from cfree.exact.pose import Pose, PoseLike, Poses, to_pose
from cfree.libraries import ArrayLike, Floats, np

if TYPE_CHECKING:
    from flint import fmpq_poly

DEGREE = 4
PARTS = 16  # parts of a slide for which speeds are bounded
Terms = tuple[Fraction, ...]  # of a polynomial, the constant first
Feature = tuple[int, int]  # polygon, and vertex; an edge by the vertex where it begins


@checked
@dataclass(frozen=True)
class Touch:
    """Two features that touch.

    Attributes
    ----------
    kind : "vertex-edge" or "edge-vertex"
        The robot's feature comes first.
    robot, obstacle : (polygon, vertex)
        Numbered as in `docs/answer-format.md`: -1 is the bounds and the reference point, -2 the workspace.
    """

    kind: Literal["vertex-edge", "edge-vertex"]
    robot: Feature
    obstacle: Feature


@checked
@dataclass(frozen=True, init=False)
class Slide:
    """Turn by less than half a turn, the reference point on a rational curve: two contacts are kept.

    Parameters
    ----------
    contacts : pair of Touch
        For information; `cfree.verify` checks that they are kept, and nothing else uses them.
    x, y, d : sequences of numbers
        Coefficients of polynomials in t, the constant first, five at most. When the robot has turned by 2 atan(t), the
        reference point has moved by (x(t), y(t)) / d(t). In the world, in the scene's unit of length.
    tau : number
        Tangent of half the whole angle.

    Raises
    ------
    InvalidPoseError
        If it does not begin at the robot's position, has too many coefficients, or the Bernstein coefficients of d
        for t from 0 to tau are not all of one sign.

    Examples
    --------
    >>> on_floor, on_wall = Touch("vertex-edge", (0, 0), (0, 2)), Touch("vertex-edge", (0, 1), (1, 1))
    >>> ladder = Slide((on_floor, on_wall), [0, 0, 2], [0, 2], [1, 0, 1], 1)  # x, y = 1 - cos, sin of the angle
    >>> ladder.apply(Pose(0, 0)) == Pose(1, 1, "90deg"), [*map(str, ladder.moved(Fraction(1, 2)))]
    (True, ['2/5', '4/5'])
    >>> ladder.reversed().apply(ladder.apply(Pose(0, 0))) == Pose(0, 0)
    True
    """

    kind: ClassVar[Literal["slide"]] = "slide"
    pole: ClassVar[None] = None
    contacts: tuple[Touch, Touch]
    x: Terms
    y: Terms
    d: Terms
    tau: Fraction

    def __init__(
        self, contacts: tuple[Touch, Touch], x: Iterable[Number], y: Iterable[Number], d: Iterable[Number], tau: Number
    ) -> None:
        first, last = contacts
        all_terms = {name: _terms(name, values) for name, values in (("x", x), ("y", y), ("d", d))}
        end = to_rational("tau", tau)
        x0, y0 = all_terms["x"][0], all_terms["y"][0]
        if x0 or y0:
            raise InvalidPoseError(f"x begins with {x0}, y with {y0}; both have to begin with 0")
        begin = all_terms["d"][0] or Fraction(1)
        all_terms = {name: tuple(c / begin for c in terms) for name, terms in all_terms.items()}
        if min(control_points(all_terms["d"], end)) <= 0:
            raise InvalidPoseError(f"d may be zero for t between 0 and {end}; end before, or in several slides")
        for name, terms in all_terms.items():
            object.__setattr__(self, name, terms)
        object.__setattr__(self, "contacts", (first, last))
        object.__setattr__(self, "tau", end)

    @property
    def turn(self) -> float:
        """Signed angle in radians."""
        return 2 * angle(self.tau.denominator, self.tau.numerator)

    @property
    def vector(self) -> ExactPoint:
        """The whole displacement of the reference point."""
        return self.moved(self.tau)

    @property
    def numbers(self) -> dict[str, Any]:
        """Coefficients and half-angle tangent, by their names in files."""
        return {"x": self.x, "y": self.y, "d": self.d, "tau": self.tau}

    @checked
    def apply(self, pose: PoseLike) -> Pose:
        """Return the pose at the end, exactly."""
        pose = to_pose(pose, "pose")
        return self.at(pose, 1)

    @checked
    def at(self, pose: PoseLike, u: Number) -> Pose:
        """Return the pose at the parameter u in [0, 1], exactly."""
        pose = to_pose(pose, "pose")
        t = to_fraction(u) * self.tau
        dx, dy = self.moved(t)
        return Pose(pose.x + dx, pose.y + dy, {"tau": (Pose(0, 0, {"tau": t}) @ pose).tau})

    @checked
    def moved(self, t: Fraction) -> ExactPoint:
        """Return the displacement of the reference point after a turn by 2 atan(t)."""
        x, y, d = (_value(terms, t) for terms in (self.x, self.y, self.d))
        return x / d, y / d

    @checked
    def until(self, u: Number) -> Slide:
        """Return the part of the motion from 0 to u."""
        return Slide(self.contacts, self.x, self.y, self.d, to_fraction(u) * self.tau)

    @checked
    def between(self, u: Number, v: Number) -> Slide:
        """Return the part of the motion from u to v, backwards if v is less."""
        first, last = to_fraction(u) * self.tau, to_fraction(v) * self.tau
        x, y, d = (_beyond(terms, first) for terms in (self.x, self.y, self.d))
        dx, dy = (_poly((c,)) for c in self.moved(first))
        tau = (last - first) / (1 + last * first)
        return Slide(self.contacts, terms_of(x - dx * d), terms_of(y - dy * d), terms_of(d), tau)

    def reversed(self) -> Slide:
        """Return the motion back."""
        return self.between(1, 0)

    @checked
    def sample(self, pose: PoseLike, shares: ArrayLike) -> Poses:
        """Return poses at shares of the angle, (n,), in double precision."""
        pose = to_pose(pose, "pose")
        s = np.asarray(shares, dtype=np.float64)
        x, y, d = _values(self, np.tan(0.5 * self.turn * s))
        return Poses(np.stack((float(pose.x) + x / d, float(pose.y) + y / d), axis=1), pose.theta + s * self.turn)

    @checked
    def share(self, u: Number) -> float:
        """Return the share of the angle turned at u."""
        return self.until(u).turn / self.turn if self.turn else 0.0

    @checked
    def parameter(self, share: float) -> Fraction:
        """Return the parameter at which a share of the angle is turned, up to rounding."""
        return Fraction(min(math.tan(share * self.turn / 2) / float(self.tau), 1.0)) if self.tau else Fraction(0)

    @checked
    def length(self, pose: PoseLike) -> float:
        """Return the path length of the reference point, which is the same from any pose.

        Quadrature makes it exact up to rounding, or to a thousandth where the point turns back.
        """
        nodes, weights = np.polynomial.legendre.leggauss(64)
        half = 0.5 * self.turn
        t = np.tan(half * (1 + nodes) / 2)
        (x, y, d), (dx, dy, dd) = _values(self, t), _values(self, t, 1)
        speed = np.hypot(dx * d - x * dd, dy * d - y * dd) / d**2 * (1 + t * t)
        return float(abs(half) / 2 * (weights * speed).sum())

    @checked
    def reach(self, pose: PoseLike, points: ArrayLike) -> float:
        """Return a bound, up to rounding, of the path lengths of some points of the robot, (..., 2), from any pose."""
        x, y = np.asarray(points, np.float64).reshape(-1, 2).T
        radius = float(np.hypot(x, y).max())
        parts = [self.between(Fraction(k, PARTS), Fraction(k + 1, PARTS)) for k in range(PARTS)]
        return abs(self.turn) * (max(map(_speed, parts)) / 2 + radius)


def _speed(slide: Slide) -> float:
    """Return a bound of the reference point's path length per half angle turned.

    Notes
    -----
    The derivative of x / d is (x' d - x d') / d^2, that of t is 1 + t^2. Polynomials are between their Bernstein
    coefficients.
    """
    d = _poly(slide.d)
    most = []
    for f in map(_poly, (slide.x, slide.y)):
        slope = terms_of(f.derivative() * d - f * d.derivative())
        most.append(
            float(max(map(abs, control_points(slope, slide.tau))) / min(control_points(slide.d, slide.tau)) ** 2)
        )
    return math.hypot(*most) * float(1 + slide.tau**2)


def control_points(terms: Terms, tau: Fraction) -> list[Fraction]:
    """Return the Bernstein coefficients of a polynomial for t from 0 to tau, between which its values are.

    Examples
    --------
    >>> control_points((Fraction(1), Fraction(-2), Fraction(1)), Fraction(1)) == [1, 0, 0]
    True
    """
    n = len(terms) - 1
    scaled = [c * tau**k / math.comb(n, k) for k, c in enumerate(terms)]
    return [sum((math.comb(i, k) * c for k, c in enumerate(scaled[: i + 1])), Fraction(0)) for i in range(n + 1)]


def terms_of(poly: fmpq_poly) -> Terms:
    """Return the coefficients of a polynomial."""
    return tuple(Fraction(int(c.p), int(c.q)) for c in poly.coeffs()) or (Fraction(0),)


def _terms(name: str, values: Iterable[Number]) -> Terms:
    """Return the coefficients of a polynomial of degree 4, filled up with zeros."""
    try:
        terms = [to_fraction(value) for value in values]
    except (TypeError, ValueError) as error:
        raise InvalidPoseError(f"{name}: {error}; give coefficients, the constant first") from None
    while terms and terms[-1] == 0:
        terms.pop()
    if len(terms) > DEGREE + 1:
        raise InvalidPoseError(f"{name} has degree {len(terms) - 1}; give at most {DEGREE}")
    return (*terms, *[Fraction(0)] * (DEGREE + 1 - len(terms)))


def _value(terms: Terms, t: Fraction) -> Fraction:
    value = Fraction(0)
    for c in reversed(terms):
        value = value * t + c
    return value


def _values(slide: Slide, t: Floats, derivative: int = 0) -> Floats:
    """Return x, y, d or their derivatives, (3, n), in doubles."""
    rows = np.array([[float(c) for c in terms] for terms in (slide.x, slide.y, slide.d)])
    return np.asarray(
        np.polynomial.polynomial.polyval(t, np.polynomial.polynomial.polyder(rows.T, derivative)), np.float64
    )


def _beyond(terms: Terms, s: Fraction) -> fmpq_poly:
    """Return a polynomial at (r + s) / (1 - r s), times the power of the denominator that makes it one in r."""
    above, below = _poly((s, Fraction(1))), _poly((Fraction(1), -s))
    parts = (_poly((c,)) * above**k * below ** (DEGREE - k) for k, c in enumerate(terms))
    return sum(parts, _poly(()))


def _poly(terms: Iterable[Fraction]) -> fmpq_poly:
    from flint import fmpq, fmpq_poly  # here: most paths have no slides

    return fmpq_poly([fmpq(c.numerator, c.denominator) for c in terms])
