"""Contact surfaces as lines P + t U that move with tau, all in forms (`cfree.exact.forms`).

P and U of all surfaces in one computation are forms of degree 2 over the same unit times W = 1 + tau^2, so that t and
signs need no denominators:

    P = p W - M a,    U = q W - M g,    M a = (C a_x - S a_y, S a_x + C a_y).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cfree.contact.surface import Surface
from cfree.exact.forms import C, Form, S, W, plus, product
from cfree.exact.number import ExactPoint, common_denominator
from cfree.exact.surd import ExactAngle
from cfree.rational.model import RationalRange, RationalSurface

Vector = tuple[Form, Form]
AnySurface = Surface | RationalSurface


@dataclass(frozen=True, slots=True)
class MovingLine:
    """Line of a contact surface, and the orientations at which it counts.

    Attributes
    ----------
    P, U : pair of Form
        Forms of degree 2, over `unit` times W.
    Phi : tuple of Form
        Forms that are all not negative exactly in the range of the contact patch; none for a whole surface.
    is_empty : bool
        True for the patch of a contact that has none.
    """

    unit: int
    P: Vector
    U: Vector
    Phi: tuple[Form, ...]
    is_empty: bool


def moving_lines(surfaces: Sequence[AnySurface]) -> tuple[MovingLine, ...]:
    """Return the lines of surfaces, in one unit.

    Raises
    ------
    ValueError
        If a surface has no edge.
    """
    plain = [whole(surface) for surface in surfaces]
    unit = common_denominator(c for s in plain for v in (s.p, s.q, s.a, s.g) for c in v)
    lines = []
    for surface, s in zip(surfaces, plain, strict=True):
        if not any((*s.q, *s.g)):
            raise ValueError(f"the surface of {s.contact} has no edge: q and g are 0; see contact_surface()")
        Phi = surface.Phi if isinstance(surface, RationalSurface) else None
        is_empty = isinstance(surface, RationalSurface) and Phi is None
        lines.append(MovingLine(unit, _moving(s.p, s.a, unit), _moving(s.q, s.g, unit), _sector(Phi), is_empty))
    return tuple(lines)


def whole(surface: AnySurface) -> Surface:
    """Return the whole surface, also for a patch."""
    return surface.surface if isinstance(surface, RationalSurface) else surface


def cross(u: Vector, v: Vector) -> Form:
    return plus(product(u[0], v[1]), product(u[1], v[0]), -1)


def dot(u: Vector, v: Vector) -> Form:
    return plus(product(u[0], v[0]), product(u[1], v[1]))


def between(P: Vector, Q: Vector) -> Vector:
    """Difference Q - P, from P to Q."""
    return plus(Q[0], P[0], -1), plus(Q[1], P[1], -1)


def _moving(p: ExactPoint, a: ExactPoint, unit: int) -> Vector:
    (px, py), (ax, ay) = ((int(x * unit), int(y * unit)) for x, y in (p, a))
    return (
        tuple(px * w - ax * c + ay * s for c, s, w in zip(C, S, W, strict=True)),
        tuple(py * w - ax * s - ay * c for c, s, w in zip(C, S, W, strict=True)),
    )


def _sector(Phi: RationalRange | None) -> tuple[Form, ...]:
    """Forms of sin(theta - phi_min) and sin(phi_max - theta): Phi is less than a half turn wide."""
    return () if Phi is None else (_after(Phi.start, 1), _after(Phi.end, -1))


def _after(phi: ExactAngle, sense: int) -> Form:
    return tuple(sense * (phi.c * s - phi.s * c) for c, s in zip(C, S, strict=True))
