"""Critical angles of grown cores as roots of polynomials, enclosed in balls."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf, nextafter

from flint import arb, arb_poly, ctx

from cfree.verify.round_algebra import Trig
from cfree.verify.round_surfaces import Fault, UndecidedError


def quadratic_roots(form: Trig, chart: int) -> list[arb] | None:
    """Balls that hold all real roots in [-2, 2] of a form; None if all its coefficients may be zero."""
    c, b, a = form.coefficients(chart)
    half = b / 2
    if a.contains(0):
        if half.contains(0):
            return None if c.contains(0) else []
        # one root is near -c / b; the other is far away, unless a is not small
        if abs(a).upper() * 8 > abs(half).lower():
            raise UndecidedError("a quadratic whose first coefficient may be zero")
        first = -c / b
        spread = (abs(a) * 16 * (1 + abs(first)) ** 2 / abs(b)).upper()
        return [first + arb(0, spread)]
    square = half * half - a * c
    if square.upper() < 0:
        return []
    low = square.lower()
    if low > 0:
        s = square.sqrt()
    else:
        top = square.upper().sqrt().upper() / 2
        s = arb(top, top)
    # the root without cancellation first
    q = -half - s if half > 0 else -half + s
    return [q / a, (c / q) if not q.contains(0) else (-half - s if not half > 0 else -half + s) / a]


def root_in(poly: arb_poly, low: float, high: float, place: int, width: arb) -> arb:
    """The root that an interval of doubles isolates, or the one of a place among several, with an error of `width`."""
    lo, hi = arb(low), arb(high)
    if place == 0:
        if low == high:
            if not poly(lo).contains(0):
                raise Fault("it is no root of its polynomial")
            return lo
        root = simple_root(poly, lo, hi, width)
        if root is not None and not poly.derivative()(lo.union(hi)).contains(0):
            return root
    roots = real_roots(poly, arb(nextafter(low, -inf)), arb(nextafter(high, inf)), width)
    if len(roots) != 1 and place == 0:
        raise Fault(f"{len(roots)} roots in the interval of an angle")
    if place > len(roots):
        raise Fault(f"an angle is root {place} of {len(roots)} in its interval")
    return roots[max(place, 1) - 1]


def simple_root(poly: arb_poly, lo: arb, hi: arb, width: arb) -> arb | None:
    """Root between two numbers at which certain signs are opposite; None if they are not."""
    below, above = poly(lo), poly(hi)
    if below.contains(0) or above.contains(0) or (below > 0) == (above > 0):
        return None
    slope, x = poly.derivative(), (lo + hi) / 2
    for _ in range(ctx.prec):  # near another root, a step only halves the distance
        there = slope(x)
        step = x - poly(x) / there if not there.contains(0) else None
        if step is not None and lo < step < hi:
            x = step.mid()
            if _changes(poly, x - width, x + width, below > 0):
                return x
            # keep a bracket, in case Newton's steps do not arrive
            value = poly(x)
            if not value.contains(0):
                lo, hi = (x, hi) if (value > 0) == (below > 0) else (lo, x)
            continue
        middle = ((lo + hi) / 2).mid()
        value = poly(middle)
        if value.contains(0):
            x = middle
            if _changes(poly, x - width, x + width, below > 0):
                return x
            raise UndecidedError("an angle that bits do not isolate")
        lo, hi = (middle, hi) if (value > 0) == (below > 0) else (lo, middle)
        x = ((lo + hi) / 2).mid()
    raise UndecidedError("an angle that Newton's steps do not find")


def _changes(poly: arb_poly, lo: arb, hi: arb, is_positive: bool) -> bool:
    below, above = poly(lo), poly(hi)
    return bool(below > 0 > above) if is_positive else bool(below < 0 < above)


def real_roots(poly: arb_poly, lo: arb, hi: arb, width: arb) -> list[arb]:
    """Roots in an interval: between neighbouring roots of the derivative, and at these where the value may be zero."""
    coefficients = trimmed(poly)
    if len(coefficients) < 2:
        return []
    poly = arb_poly(coefficients)
    places = [lo, *real_roots(poly.derivative(), lo, hi, width), hi]
    result: list[arb] = []
    for k, x in enumerate(places):
        near = x if k in (0, len(places) - 1) else x + arb(0, width)
        root: arb | None = x
        if not poly(near).contains(0):
            root = simple_root(poly, x, places[k + 1], width) if k + 1 < len(places) else None
        if root is not None and not (result and result[-1] + 4 * width >= root):
            result.append(root)
    return result


def trimmed(poly: arb_poly) -> list[arb]:
    """Coefficients without leading ones that may be zero."""
    coefficients: Sequence[arb] = poly.coeffs()
    count = len(coefficients)
    while count and coefficients[count - 1].contains(0):
        count -= 1
    return list(coefficients[:count])
