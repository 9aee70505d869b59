"""Critical angles of a boundary as exact numbers: tau in the chart of the row that begins or ends there."""

from __future__ import annotations

from fractions import Fraction

from flint import fmpz_poly

from cfree.exact.algebraic import Root, roots
from cfree.forbidden.columns import Trapezoids
from cfree.forbidden.record import BoundaryRecord

KIND = 15  # bits of a contact's kind; those above are its quadrant


def critical_angle(boundary: BoundaryRecord, table: Trapezoids, k: int, last: bool) -> Root:
    """Return the first or last angle of a row of its trapezoids or isolated parts."""
    end = "to" if last else "from"
    first, second, lo, hi, place = (
        getattr(table, f"{end}_{name}")[k].item() for name in ("first", "second", "lo", "hi", "place")
    )
    if lo == hi:
        return Root.of(Fraction(lo))
    patch = getattr(table, f"{end}_patch", table.patch)[k]
    columns = boundary.contact_kind, boundary.contact_robot, boundary.contact_obstacle
    contact = [int(column[patch]) for column in columns]
    contact[0] &= KIND  # all quadrants of a circle have the same polynomials
    terms, (low, p), (high, q) = boundary._handle.root(contact, int(table.chart[k]), first, second, lo, hi, place)
    ((root, _),) = roots(fmpz_poly(terms), Fraction(low, 1 << p), Fraction(high, 1 << q))
    return root
