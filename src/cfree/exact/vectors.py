"""Exact vectors of the plane: differences, products, unit vectors."""

from __future__ import annotations

from fractions import Fraction

from cfree.exact.number import ExactPoint, rational_root

NONE, ALL = Fraction(0), Fraction(1)


def minus(p: ExactPoint, q: ExactPoint) -> ExactPoint:
    """Return the vector to a point from another one."""
    return p[0] - q[0], p[1] - q[1]


def along(p: ExactPoint, t: Fraction, d: ExactPoint) -> ExactPoint:
    """Return p + t d."""
    return p[0] + t * d[0], p[1] + t * d[1]


def cross(u: ExactPoint, v: ExactPoint) -> Fraction:
    """Return the cross product, positive if `v` is to the left of `u`."""
    return u[0] * v[1] - u[1] * v[0]


def dot(u: ExactPoint, v: ExactPoint) -> Fraction:
    """Return the scalar product."""
    return u[0] * v[0] + u[1] * v[1]


def unit(v: ExactPoint) -> ExactPoint | None:
    """Return the unit vector in a direction, None if it is irrational or the vector is zero."""
    length = rational_root(dot(v, v))
    return (v[0] / length, v[1] / length) if length else None


def foot(point: ExactPoint, p: ExactPoint, q: ExactPoint) -> tuple[Fraction, Fraction]:
    """Return the square of a point's distance from a segment, and the share of the segment up to the nearest point."""
    d, v = minus(q, p), minus(point, p)
    share, whole = dot(v, d), dot(d, d)
    if share <= 0:
        return dot(v, v), NONE
    if share >= whole:
        v = minus(point, q)
        return dot(v, v), ALL
    return Fraction(cross(d, v) ** 2, whole), Fraction(share, whole)
