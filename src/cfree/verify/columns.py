"""Many pieces of contact surfaces at once: doubles with a bound decide the certain ones, `Trapezoid` the others.

Polynomials are exact, in columns of Python's integers. Values in doubles show that most keep their sign between the two
angles of a piece. Others are monotone, and vanish at one of these, as its name says, or have the same sign at both.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from itertools import pairwise
from math import comb
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cfree.verify.surfaces import ZERO, Fault, Form, Surface, helix, meeting
from cfree.verify.trapezoids import NAMES
from cfree.verify.world import EDGE_VERTEX, HELIX, VERTEX_EDGE, Name, name_of

if TYPE_CHECKING:
    from cfree.verify.trapezoids import Reader

Rows = NDArray[Any]  # of Python's integers: forms, or polynomials in tau with the constant term first
Mask = NDArray[np.bool_]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Codes = NDArray[np.uint64]
DEGREE = 4  # at most
NOWHERE = Surface(ZERO, ZERO, ZERO, ZERO)  # what names no surface
NEVER: Form = 0, 0, 0
ALWAYS: Form = -1, 0, 0  # a limit that always holds
WIDE, PARTS = 0.25, 4  # intervals that are cut where doubles decide nothing
ERROR, LEAST = 2.0**-28, 2.0**-1000
BITS, NARROW, STEPS = 192, 160, 4  # of places by Newton's method


class Columns:
    """The pieces of a reader's table.

    Attributes
    ----------
    contact : (N,) uint64
        Their contacts, packed like the names of curves.
    names : set of int
        Names of surfaces, those of contacts among them.
    angles : Angles
    start, stop : (N,) int64
        Numbers of their angles.
    named : (N,) bool
        True if it is certain that both angles are what they are named by, and both curves have no pole between them.
    proved : (N,) bool
        True if it is certain, too, that `Trapezoid.check` finds no fault.
    """

    def __init__(self, reader: Reader) -> None:
        kind, robot, obstacle = (column.astype(np.uint64) for column in reader.contacts)
        self.reader, self.table = reader, reader.table
        self.contact: Codes = kind << np.uint64(61) | robot << np.uint64(31) | obstacle
        self._resolve()
        self.angles = Angles(self)
        self.start, self.stop = self.angles.numbers
        sound = self.angles.proved[self.start] & self.angles.proved[self.stop]
        sound &= np.isin(kind, (VERTEX_EDGE, EDGE_VERTEX))
        self.named, self.proved = sound.copy(), sound.copy()
        self._prove(np.flatnonzero(sound))
        more = np.flatnonzero(sound & ~self.proved)
        if len(more):  # narrower intervals may decide
            self.angles.narrow(np.unique([self.start[more], self.stop[more]]))
            self._prove(more)

    def _resolve(self) -> None:
        """Compute the forms of all curves that are named, each once on each contact."""
        t, world = self.table, self.reader.world
        named = ["lower", "upper", "from_first", "from_second", "to_first", "to_second"]
        contacts, contact = np.unique(self.contact, return_inverse=True)
        names, name = np.unique(np.concatenate([getattr(t, column) for column in named]), return_inverse=True)
        pairs, rows = np.unique(np.tile(contact, len(named)) * len(names) + name, return_inverse=True)
        self._rows: dict[str, Ints] = dict(zip(named, rows.reshape(len(named), -1), strict=True))
        on, by = np.divmod(pairs, max(1, len(names)))
        surfaces = [_surface(world.contact, code) for code in contacts.tolist()]
        self.surfaces = [surfaces[k] for k in contact.tolist()]
        self._resolved = np.array([surface is not NOWHERE for surface in self.surfaces], bool)
        limits = np.array([(*s.limits, ALWAYS, ALWAYS)[:2] for s in self.surfaces], object)
        self._limits = limits.reshape(-1, 2, 3).transpose(1, 0, 2)
        others = [_surface(world.surface, code) for code in names.tolist()]
        known = zip((*contacts.tolist(), *names.tolist()), (*surfaces, *others), strict=True)
        self.names = {code for code, surface in known if surface is not NOWHERE}
        is_helix = names[by] >> np.uint64(61) == HELIX
        self._forms = [np.zeros((len(pairs), 3), object) for _ in range(2)]
        forms = meeting(_in_columns(surfaces, on[~is_helix]), _in_columns(others, by[~is_helix]))
        for form, values in zip(self._forms, forms, strict=True):
            form[~is_helix] = np.stack(values, axis=1)
        for k in np.flatnonzero(is_helix).tolist():
            try:
                both = helix(surfaces[on[k]], *world.vertices(name_of(int(names[by[k]]))))
            except (Fault, IndexError):
                both = NEVER, NEVER
            for form, value in zip(self._forms, both, strict=True):
                form[k] = value

    def forms(self, piece: int) -> Iterator[tuple[Form, Form]]:
        """Yield numerator and denominator of the two curves of a piece."""
        for column in ("lower", "upper"):
            n, d = (tuple(form[self._rows[column][piece]].tolist()) for form in self._forms)
            yield n, d

    def angles_named(self, names: Codes, pieces: Ints) -> Rows:
        """Forms of angles that one pair of features names, on the contacts of pieces."""
        forms = np.zeros((len(names), 3), object)
        for k, (code, piece) in enumerate(zip(names.tolist(), pieces.tolist(), strict=True)):
            try:
                forms[k] = self.reader.world.angle(self.surfaces[piece], name_of(code))
            except (Fault, IndexError):
                continue
        return forms

    def rows(self, column: str) -> Ints:
        """Numbers of the forms of the curves that a column names."""
        return self._rows[column]

    def curves(self, rows: Ints, chart: NDArray[np.uint8]) -> list[Rows]:
        """Numerators and denominators of curves in charts; a denominator of 0 is no curve."""
        return [polynomials(form[rows], chart) for form in self._forms]

    def _prove(self, some: Ints) -> None:
        """Find those of some pieces, with angles that are proved, of which all is certain.

        Notes
        -----
        Start is before stop. From start to stop contacts are in their range, and 0 <= lower <= upper <= 1 has no pole.
        """
        chart, angles = self.table.chart[some], self.angles
        (n, d), (m, e) = (self.curves(self._rows[column][some], chart) for column in ("lower", "upper"))
        sign, other = self._signs_of_all([d, e], some)
        self.named[some] = sign * other != 0
        in_order = angles.above[self.start[some]] < angles.below[self.stop[some]]
        result = self.named[some] & self._resolved[some] & in_order
        limits = [polynomials(limit[some], chart) for limit in self._limits]
        room = e - m
        inside = [n, room, times(m, d) - times(n, e), *limits]
        low, high, order, *of_limits = self._signs_of_all(inside, some, inside=True)
        for poly, its, expected in ((n, low, sign), (room, high, other)):
            other_signs = np.flatnonzero(its * expected <= 0)
            result[other_signs] &= ~poly[other_signs].any(axis=1)
        result &= order * sign * other > 0
        for its in of_limits:
            result &= its < 0
        self.proved[some] = result

    def _signs_of_all(self, polys: Sequence[Rows], pieces: Ints, *, inside: bool = False) -> list[Ints]:
        """Return `_signs` of several polynomials of each piece, found at once."""
        rows = np.zeros((len(polys), len(pieces), DEGREE + 1), object)
        for row, poly in zip(rows, polys, strict=True):
            row[:, : poly.shape[1]] = poly
        signs = self._signs(rows.reshape(-1, DEGREE + 1), np.tile(pieces, len(polys)), inside=inside)
        return list(signs.reshape(len(polys), -1))

    def _signs(self, poly: Rows, pieces: Ints, *, inside: bool = False) -> Ints:
        """Signs from start to stop, or strictly between them; 0 if it is not certain that there is one.

        Notes
        -----
        Of a monotone polynomial the signs at both ends decide, or if it vanishes at one of them that at the other. A
        convex one is negative between places where it is not positive.
        """
        angles, start, stop = self.angles, self.start[pieces], self.stop[pieces]
        span = Span(angles.lo[start], angles.hi[stop])
        taylor = span.taylor(poly)
        signs: Ints = span.signs_of(taylor)
        wide = np.flatnonzero((signs == 0) & (span.hi - span.lo > WIDE))
        if len(wide):
            of_parts = np.array([part.signs(poly[wide]) for part in span.some(wide).parts()])
            signs[wide] = np.where((of_parts == of_parts[0]).all(axis=0), of_parts[0], 0)
        some = np.flatnonzero(signs == 0)
        some = some[poly[some].any(axis=1)]
        if not len(some):
            return signs
        poly, span, start, stop = poly[some], span.some(some), start[some], stop[some]
        terms = [term[some] for term in taylor]
        slope, bend = (span.signs_of(terms, order) for order in (1, 2))
        first, last = (
            self._signs_at_ends(poly, span, terms, at, ends, inside=inside)
            for at, ends in ((start, angles.below), (stop, angles.above))
        )
        if inside:
            of_monotone = np.where(first == 0, last, np.where((last == 0) | (last == first), first, 0))
            is_beyond = (bend * first <= 0) & (bend * last <= 0)
        else:
            of_monotone, is_beyond = np.where(first == last, first, 0), (bend * first < 0) & (bend * last < 0)
        signs[some] = np.where(slope != 0, of_monotone, np.where(is_beyond, -bend, 0))
        return signs

    def _signs_at_ends(
        self, poly: Rows, span: Span, taylor: Sequence[Floats], angles: Ints, ends: Rows, *, inside: bool
    ) -> Ints:
        """Signs at the outer ends of angles; 0 of those with a root at the angle, if only what is inside counts."""
        signs = span.signs_near(taylor, ends[angles])
        doubtful = np.flatnonzero(signs == 0)
        if inside:
            doubtful = doubtful[~self.angles.is_root(poly[doubtful], angles[doubtful])]
        signs[doubtful] = signs_at(poly[doubtful], ends[angles[doubtful]])
        return signs


class Angles:
    """The ends of all pieces, each once.

    Attributes
    ----------
    numbers : (2, N) int64
        Those of the angles at which pieces start and stop.
    first, second : (A,) uint64
        Their names.
    chart : (A,) uint8
    lo, hi : (A,) float64
    rows : (A, 5)
        Primitive polynomials with a root there.
    ends : (A,) int64
        -1 or 1 at the end of a chart, else 0.
    below, above : (A,)
        Doubles or fractions, with the angle in between: `lo` and `hi`, or nearer ones.
    proved : (A,) bool
        True if a root is the only one in its interval, and in the chart, for certain.
    meet : (A,) bool
        True if its two curves have no pole in the interval, for certain.
    """

    def __init__(self, columns: Columns) -> None:
        t = columns.table
        first, second, lo, hi, place = (
            np.concatenate([getattr(t, f"{end}_{name}") for end in ("from", "to")]) for name in NAMES
        )
        by, other = (
            np.concatenate([columns.rows(f"{end}_{name}") for end in ("from", "to")]) for name in ("first", "second")
        )
        chart, known = np.tile(t.chart, 2), dict[Any, int]()
        keys = zip(*(column.tolist() for column in (by, other, lo, hi, place, chart)), strict=True)
        self.numbers: Ints = np.array([known.setdefault(key, len(known)) for key in keys], np.int64).reshape(2, -1)
        _, once = np.unique(self.numbers, return_index=True)
        self.first, self.second, self.chart = first[once], second[once], chart[once]
        place, by, other = place[once], by[once], other[once]
        sound = (lo[once] > -2) & (lo[once] <= hi[once]) & (hi[once] < 2)
        self.lo, self.hi = lo, hi = np.where(sound, lo[once], 0.0), np.where(sound, hi[once], 0.0)
        self.below, self.above = lo.astype(object), hi.astype(object)
        (n, d), (m, e) = (columns.curves(rows, self.chart) for rows in (by, other))
        span, is_pair, is_end = Span(lo, hi), self.second != 0, self.first == 0
        self.meet: Mask = is_pair & (span.signs(d) * span.signs(e) != 0)
        self.rows = times(n, e) - times(m, d)
        single = np.flatnonzero(~is_pair & ~is_end)
        forms = columns.angles_named(self.first[single], once[single] % max(1, len(t)))
        self.rows[single] = 0
        self.rows[single, :3] = polynomials(forms, self.chart[single])
        whole = np.where(is_end & (abs(lo) == 1), lo, 0).astype(np.int64)
        self.rows[is_end] = 0
        self.rows[is_end, 0], self.rows[is_end, 1] = -whole[is_end], 1
        self.rows = primitive(self.rows)
        at_end = {k: (values_at(self.rows, k) == 0) & (lo <= k) & (k <= hi) for k in (-1, 1)}
        self.ends: Ints = at_end[1].astype(np.int64) - at_end[-1]
        in_chart = ((lo >= -1) | at_end[-1]) & ((hi <= 1) | at_end[1])
        named = np.where(is_pair, d.any(axis=1) & e.any(axis=1), ~is_end | ((lo == hi) & (whole != 0)))
        self.proved: Mask = sound & named.astype(bool) & (place == 0) & in_chart & (span.signs(self.rows, 1) != 0)
        self.proved &= signs_at(self.rows, lo) * signs_at(self.rows, hi) <= 0

    def narrow(self, some: Ints) -> None:
        """Narrow the intervals of some angles, by Newton's method: where the sign still changes the root is."""
        one, by = 1 << BITS, 1 << BITS - NARROW
        rows = self.rows[some]
        places = np.array([n * one // d for n, d in _ratios((self.lo[some] + self.hi[some]) / 2)], object)
        for _ in range(STEPS):
            value, slope, power = rows[:, -1], 0 * places, 1
            for column in rows.T[-2::-1]:
                power *= one
                value, slope = value * places + column * power, slope * places + value
            slope[slope == 0] = 1
            places = places - value // slope
        below, above = places - by, places + by  # over `one`
        is_above = [n * one <= x * d for (n, d), x in zip(_ratios(self.below[some]), below.tolist(), strict=True)]
        is_below = [x * d <= n * one for (n, d), x in zip(_ratios(self.above[some]), above.tolist(), strict=True)]
        inside: Mask = np.array(is_above, bool) & np.array(is_below, bool)
        first, last = (_signs_over(rows[inside], ends[inside], one) for ends in (below, above))
        inside[inside] = first * last < 0
        for its, ends in ((self.below, below), (self.above, above)):
            its[some[inside]] = [Fraction(x, one) for x in ends[inside].tolist()]

    def is_root(self, poly: Rows, angles: Ints) -> Mask:
        """True if polynomials other than 0 vanish at angles, for certain: they are multiples of those of the angles."""
        ends, rows = self.ends[angles], self.rows[angles]
        at_end = np.where(ends == 1, values_at(poly, 1), values_at(poly, -1)) == 0
        top = DEGREE - (rows != 0)[:, ::-1].argmax(axis=1)
        poly, each = without_factor(poly), np.arange(len(rows))
        is_multiple = (poly * rows[each, top, None] == rows * poly[each, top, None]).all(axis=1) & rows.any(axis=1)
        vanishes: Mask = np.where(ends != 0, at_end, is_multiple).astype(bool)
        return vanishes


class Span:
    """Intervals of tau, in doubles.

    Notes
    -----
    Coefficients are rounded, and divided by the greatest. For a degree of at most 4 and |tau| < 2, no coefficient of a
    Taylor polynomial is greater than 2^6, and no sum here than 2^12. Each takes fewer than 100 operations, and is off
    by less than 2^-34. `ERROR` is more.
    """

    def __init__(self, lo: Floats, hi: Floats) -> None:
        self.lo, self.hi = lo, hi
        self._middle, self._radius = (lo + hi) / 2, abs(hi - lo) / 2 + 2.0**-50

    def some(self, rows: Ints) -> Span:
        return Span(self.lo[rows], self.hi[rows])

    def parts(self) -> list[Span]:
        """Return parts that cover each interval."""
        ends = [self.lo + (self.hi - self.lo) * (k / PARTS) for k in range(PARTS)] + [self.hi]
        return [Span(lo, hi) for lo, hi in pairwise(ends)]

    def signs(self, poly: Rows, order: int = 0) -> Ints:
        """Signs of a derivative on the whole closed interval; 0 if it is not certain that there is one."""
        return self.signs_of(self.taylor(poly), order)

    def signs_of(self, taylor: Sequence[Floats], order: int = 0) -> Ints:
        """Return `signs`, of Taylor polynomials.

        Notes
        -----
        Its value in the middle is greater than all else of its Taylor polynomial there at the ends.
        """
        terms = [comb(k, order) * c for k, c in enumerate(taylor) if k >= order]
        rest = np.zeros(len(self.lo))
        for term in reversed(terms[1:]):
            rest = (rest + abs(term)) * self._radius
        return np.where(abs(terms[0]) > rest + ERROR, np.sign(terms[0]), 0).astype(np.int64)

    def signs_near(self, taylor: Sequence[Floats], places: Rows) -> Ints:
        """Signs at places in the intervals; 0 if it is not certain that there is one."""
        offset, value = places.astype(float) - self._middle, np.zeros(len(places))
        for term in reversed(taylor):
            value = value * offset + term
        return np.where(abs(value) > ERROR, np.sign(value), 0).astype(np.int64)

    def taylor(self, poly: Rows) -> list[Floats]:
        """Coefficients at the middle."""
        try:
            rounded = poly.astype(float)
        except OverflowError:
            rounded = (poly / abs(poly).max(axis=1, initial=1)[:, None]).astype(float)
        c = list((rounded / np.maximum(abs(rounded).max(axis=1, initial=0), LEAST)[:, None]).T)
        for k in range(len(c) - 1):
            for j in range(len(c) - 2, k - 1, -1):
                c[j] = c[j] + self._middle * c[j + 1]
        return c


def _surface(make: Callable[[Name], Surface], code: int) -> Surface:
    try:
        return make(name_of(code))
    except (Fault, IndexError):
        return NOWHERE


def _in_columns(surfaces: Sequence[Surface], rows: Ints) -> Surface:
    """Return one surface whose coordinates are columns."""
    table = np.array([(*s.a, *s.g, *s.b, *s.q) for s in surfaces], object).reshape(-1, 8)[rows]
    a, b, c, d, e, f, g, h = table.T
    return Surface((a, b), (c, d), (e, f), (g, h))


def polynomials(forms: Rows, chart: NDArray[np.uint8]) -> Rows:
    """(1 + tau^2) times forms, in charts."""
    (a, b, c), sign = forms.T, 1 - 2 * chart.astype(object)
    b = sign * b
    return np.stack([a + b, 2 * sign * c, a - b], axis=1)


def times(p: Rows, q: Rows) -> Rows:
    """Products of quadratic polynomials."""
    (a, b, c), (d, e, f) = p.T, q.T
    return np.stack([a * d, a * e + b * d, a * f + b * e + c * d, b * f + c * e, c * f], axis=1)


def primitive(poly: Rows) -> Rows:
    """Polynomials of degree 4 at most without common divisors, and without the factor 1 + tau^2."""
    rows = without_factor(poly)
    lead = np.zeros(len(rows), object)
    for column in rows.T:
        lead = np.where(column != 0, column, lead)
    divisor = np.gcd.reduce(rows, axis=1) * np.where(lead < 0, -1, 1)
    divisor[divisor == 0] = 1
    result: Rows = rows // divisor[:, None]
    return result


def without_factor(poly: Rows) -> Rows:
    """Polynomials of degree 4 at most without the factor 1 + tau^2, in five columns."""
    rows = np.zeros((len(poly), DEGREE + 1), object)
    rows[:, : poly.shape[1]] = poly
    a, b, c, d, e = rows.T
    whole = (a + e == c) & (b == d)
    rows[whole] = np.stack([a, b, e, 0 * a, 0 * a], axis=1)[whole]
    return rows


def values_at(poly: Rows, tau: int) -> Rows:
    """Values at 1 or -1."""
    values: Rows = poly[:, ::2].sum(axis=1) + tau * poly[:, 1::2].sum(axis=1)
    return values


def signs_at(poly: Rows, tau: Rows) -> Ints:
    """Exact signs at doubles or fractions."""
    fractions = _ratios(tau)
    p, q = (np.array(column, object) for column in zip(*fractions, strict=True)) if fractions else (tau, tau)
    return _signs_over(poly, p, q)


def _ratios(numbers: Rows) -> list[tuple[int, int]]:
    """Numerators and denominators of doubles or fractions."""
    return [value.as_integer_ratio() for value in numbers.tolist()]


def _signs_over(poly: Rows, p: Rows, q: Any) -> Ints:
    """Exact signs at p / q, q > 0."""
    value, power = poly[:, -1], q
    for column in poly.T[-2::-1]:
        value, power = value * p + column * power, power * q
    return np.array([(x > 0) - (x < 0) for x in value.tolist()], np.int64)
