"""Critical angles of a boundary as exact numbers: tau in the chart of what begins or ends there."""

from __future__ import annotations

from fractions import Fraction

from flint import fmpz_poly

from cfree.exact.algebraic import Root, roots
from cfree.forbidden.columns import Trapezoids
from cfree.forbidden.record import BoundaryRecord


def critical_angle(boundary: BoundaryRecord, table: Trapezoids, k: int, last: bool) -> Root:
    """The first or last angle of a row of its trapezoids or isolated parts."""
    ((root, _),) = roots(*_equation(boundary, table, k, last))
    return root


def rational_critical_angle(boundary: BoundaryRecord, table: Trapezoids, k: int, last: bool) -> Fraction | None:
    """The same if it is rational."""
    polynomial, lo, hi = _equation(boundary, table, k, last)
    if lo == hi:
        return lo
    for factor, _ in polynomial.factor()[1]:
        if factor.degree() == 1:
            tau = Fraction(-int(factor[0]), int(factor[1]))
            if lo <= tau <= hi:
                return tau
    return None


def _equation(boundary: BoundaryRecord, table: Trapezoids, k: int, last: bool) -> tuple[fmpz_poly, Fraction, Fraction]:
    """A polynomial, and an interval in which the angle is its only root."""
    end = "to" if last else "from"
    first, second, lo, hi, place = (
        getattr(table, f"{end}_{name}")[k].item() for name in ("first", "second", "lo", "hi", "place")
    )
    if lo == hi:
        tau = Fraction(lo)
        return fmpz_poly([-tau.numerator, tau.denominator]), tau, tau
    patch = getattr(table, f"{end}_patch", table.patch)[k]
    columns = boundary.contact_kind, boundary.contact_robot, boundary.contact_obstacle
    contact = [int(column[patch]) for column in columns]
    terms, (low, p), (high, q) = boundary.core.root(contact, int(table.chart[k]), first, second, lo, hi, place)
    return fmpz_poly(terms), Fraction(low, 1 << p), Fraction(high, 1 << q)
