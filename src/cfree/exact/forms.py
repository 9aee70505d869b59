"""Forms in tau = tan(theta / 2): numerators of trigonometric polynomials, their zeros and signs on the circle.

A form of degree n has n + 1 integer coefficients, the constant first. If the last ones are 0, the half turn, tau
infinite, is a zero. Let C = (1, 0, -1), S = (0, 2, 0) and W = (1, 0, 1); then cos = C / W and sin = S / W. A
trigonometric polynomial of degree k is a form of degree 2 k over W^k, with the same sign.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import reduce
from itertools import pairwise
from math import gcd

from flint import fmpz_poly

from cfree.exact.algebraic import Exact, Root, at, between, part, roots, sign
from cfree.exact.angle_interval import AlgebraicAngle, AngleInterval

Form = tuple[int, ...]
Place = tuple[AlgebraicAngle, tuple[int, ...], tuple[int, ...]]
C, S, W = (1, 0, -1), (0, 2, 0), (1, 0, 1)
ONE, ZERO_ANGLE = Root.of(Fraction(1)), AlgebraicAngle(0, Root.of(Fraction(0)))


def plus(f: Form, g: Form, times: int = 1) -> Form:
    """f + times g, for forms of one degree."""
    return tuple(x + times * y for x, y in zip(f, g, strict=True))


def product(*forms: Form) -> Form:
    """Product of forms; degrees are added.

    Examples
    --------
    >>> product(C, C) == plus(product(W, W), product(S, S), -1)
    True
    """
    return reduce(_times, forms)


def common_factor(forms: Iterable[Form]) -> Form:
    """Common factor of greatest degree and content, zeros at infinity included. Every form divides a zero form.

    Examples
    --------
    >>> common_factor([(2, 2, 0), (0, 4, 4, 0)])  # 1 + tau, and infinity
    (2, 2, 0)
    """
    nonzero = [form for form in forms if any(form)]
    divisor = reduce(lambda f, g: f.gcd(g), (fmpz_poly(list(form)) for form in nonzero), fmpz_poly([0]))
    at_infinity = min(_zeros_at_infinity(form) for form in nonzero) if nonzero else 0
    return (*map(int, divisor.coeffs()), *[0] * at_infinity)


def quotient(form: Form, divisor: Form) -> Form:
    """Quotient of a division without remainder; degrees are subtracted.

    Examples
    --------
    >>> quotient((0, 2, 2, 0), (1, 1)), quotient((0, 2, 2, 0), (2, 0))
    ((0, 2, 0), (0, 1, 1))
    """
    row = [int(c) for c in (fmpz_poly(list(form)) / fmpz_poly(list(divisor))).coeffs()]
    return (*row, *[0] * (len(form) - len(divisor) + 1 - len(row)))


def reduced(forms: Sequence[Form]) -> tuple[Form, ...]:
    """Divide forms of one degree, not all 0, by their common factor."""
    divisor = common_factor(forms)
    return tuple(quotient(form, divisor) for form in forms)


def primitive(form: Form) -> Form:
    """Divide a form that is not 0 by the content of its coefficients; its last nonzero one becomes positive."""
    divisor = gcd(*form)
    last = next(c for c in reversed(form) if c)
    return tuple(c // (divisor if last > 0 else -divisor) for c in form)


def in_chart(form: Form, chart: int) -> Form:
    """Polynomial in the coordinate of a chart: tau = -1 / tau' in chart 1."""
    return form if chart == 0 else tuple((-1) ** (k % 2) * c for k, c in enumerate(form))[::-1]


def value_at(form: Form, angle: AlgebraicAngle) -> Exact:
    """Value of the form's polynomial in the angle's chart; ratios of forms of one degree are right."""
    return at(fmpz_poly(list(in_chart(form, angle.chart))), angle.coordinate)


def zeros(form: Form) -> tuple[tuple[AlgebraicAngle, int], ...]:
    """Zeros of a form that is not 0, with their multiplicities, from theta = 0 on.

    Examples
    --------
    >>> import math
    >>> [(round(math.degrees(angle.theta)), times) for angle, times in zeros(product(C, C, (0, 1), (1, 0, -3)))]
    [(0, 1), (60, 1), (90, 2), (270, 2), (300, 1)]
    """
    multiplicities = {
        AlgebraicAngle(chart, root): times
        for chart in (0, 1)
        for root, times in roots(fmpz_poly(list(in_chart(form, chart))), Fraction(-1), Fraction(1))
    }
    return tuple(sorted(multiplicities.items(), key=lambda item: (item[0] < ZERO_ANGLE, item[0])))


def signs_around(forms: Sequence[Form]) -> list[Place]:
    """Angles once round, all zeros among them, with the signs of forms there and on the way to the next angle.

    Notes
    -----
    The ends of charts are among them. All forms of odd degree change sign with the chart; products of two of them do
    not.

    Examples
    --------
    >>> import math
    >>> [(round(math.degrees(angle.theta)), there, after) for angle, there, after in signs_around([S])]
    [(270, (-1,), (-1,)), (0, (0,), (1,)), (90, (1,), (1,)), (180, (0,), (-1,))]
    """
    places: list[Place] = []
    for chart in (0, 1):
        seen = [in_chart(form, chart) for form in forms]
        vanishing: dict[Root, set[int]] = {Root.of(Fraction(-1)): set()}
        for k, form in enumerate(seen):
            if any(form):
                for root, _ in roots(fmpz_poly(list(form)), Fraction(-1), Fraction(1)):
                    vanishing.setdefault(root, set()).add(k)
        for root, after in pairwise([*sorted(vanishing.keys() - {ONE}), ONE]):
            part(root, after)
            sample = between(root.hi, after.lo)
            gap = tuple(sign(form, sample) for form in seen)
            there = tuple(0 if k in vanishing[root] else s for k, s in enumerate(gap))
            places.append((AlgebraicAngle(chart, root), there, gap))
    return places


def closed_intervals(places: Sequence[Place], inside: Sequence[tuple[bool, bool]]) -> tuple[AngleInterval, ...]:
    """Closed set of orientations, from theta = 0 on, from two flags per angle: it, and the gap after it, is inside."""
    flags = [flag for pair in inside for flag in pair]
    if all(flags):
        return (AngleInterval(None, None),)
    count = len(flags)
    starts = [k for k in range(count) if flags[k] and not flags[k - 1]]
    stops = [next(k for k in range(start, start + count) if not flags[(k + 1) % count]) for start in starts]
    parts = [AngleInterval(places[i // 2][0], places[j % count // 2][0]) for i, j in zip(starts, stops, strict=True)]
    return tuple(sorted(parts, key=lambda part: (part.start < ZERO_ANGLE, part.start)))  # type: ignore[operator]


def _times(f: Form, g: Form) -> Form:
    row = [0] * (len(f) + len(g) - 1)
    for i, x in enumerate(f):
        for j, y in enumerate(g):
            row[i + j] += x * y
    return tuple(row)


def _zeros_at_infinity(form: Form) -> int:
    return next(k for k, c in enumerate(reversed(form)) if c)
