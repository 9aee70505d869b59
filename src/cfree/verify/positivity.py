"""Where polynomials with integer coefficients are positive, and one number between any two of their roots."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from operator import mul

from flint import fmpz_poly

from cfree.exact.algebraic import Root, between, part, roots, sign
from cfree.verify.course import ALL, Interval, Poly, bernstein, bernstein_rows


def is_nowhere_positive(poly: Poly, interval: Interval) -> bool:
    """True if Bernstein coefficients prove it: all are <= 0, or (f, m, g) with f, g <= 0 and m^2 <= f g.

    Notes
    -----
    For a quadratic the result is exact. For other polynomials False may be wrong, but not True.
    """
    rows = bernstein_rows(len(poly) - 1, interval)
    if all(sum(map(mul, row, poly)) <= 0 for row in rows):
        return True
    if len(poly) != 3:
        return False
    f, m, g = bernstein(poly, interval)
    return f <= 0 and g <= 0 and m * m <= f * g


def positive(poly: Poly) -> Fraction | None:
    """Some u in [0, 1] at which a polynomial is positive, if there is one."""
    if is_nowhere_positive(poly, ALL):
        return None
    return next((u for u in samples([poly], ALL) if sign(poly, u) > 0), None)


def samples(polys: list[Poly], interval: Interval) -> Iterator[Fraction]:
    """One number between any two neighbouring roots in an interval."""
    lo, hi = Fraction(interval[0], interval[2]), Fraction(interval[1], interval[2])
    ends = {root.key: root for f in polys if any(f[1:]) for root, _ in roots(fmpz_poly(list(f)), lo, hi)}
    ends |= {end.key: end for end in map(Root.of, (lo, hi))}
    for one, other in pairwise(sorted(ends.values())):
        part(one, other)
        yield between(one.hi, other.lo)
