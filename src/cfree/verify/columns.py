"""Many pieces of contact surfaces at once: doubles with a bound decide the certain ones, `Trapezoid` the others.

Polynomials are exact, in columns of Python's integers. Values in doubles show that most keep their sign between the two
angles of a piece. Others are monotone, and vanish at one of these, as its name says, or have the same sign at both.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import comb
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cfree.verify.surfaces import ZERO, Fault, Form, Surface, helix, meeting
from cfree.verify.trapezoids import NAMES
from cfree.verify.world import HELIX, Name, name_of

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
ERROR = 2.0**-28
BITS, NARROW, STEPS = 192, 160, 4  # of places by Newton's method


class Columns:
    """The pieces of a reader's table.

    Attributes
    ----------
    contact : (N,) uint64
        Their contacts, packed like the names of curves.
    names : set of int
        Names of surfaces, those of contacts among them.
    start, stop : Angles
    named : (N,) bool
        True if it is certain that both angles are what they are named by, and both curves have no pole between them.
    proved : (N,) bool
        True if it is certain, too, that `Trapezoid.check` finds no fault.
    """

    def __init__(self, reader: Reader) -> None:
        kind, robot, obstacle = (column.astype(np.uint64) for column in reader.contacts)
        self.reader, self.table = reader, reader.table
        self.contact: Codes = kind << np.uint64(61) | robot << np.uint64(31) | obstacle
        self._sign = 1 - 2 * self.table.chart.astype(object)
        self._resolve()
        self.start, self.stop = Angles(self, "from"), Angles(self, "to")
        self.named: Mask = self.start.proved & self.stop.proved
        self.proved: Mask = self.named.copy()
        self._prove(np.flatnonzero(self.proved))
        if not self.proved.all():  # narrower intervals may decide
            more = np.flatnonzero(self.start.proved & self.stop.proved & ~self.proved)
            for angles in (self.start, self.stop):
                angles.narrow(more)
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
        forms = meeting(_in_columns(surfaces, on), _in_columns(others, by))
        self._forms = [np.stack(form, axis=1) for form in forms]
        for k in np.flatnonzero(names[by] >> np.uint64(61) == HELIX).tolist():
            try:
                both = helix(surfaces[on[k]], *world.vertices(name_of(int(names[by[k]]))))
            except (Fault, IndexError):
                both = NEVER, NEVER
            for form, value in zip(self._forms, both, strict=True):
                form[k] = value

    def row(self, column: str) -> Ints:
        """Numbers of pairs of a contact and the name in a column."""
        return self._rows[column]

    def curve(self, column: str) -> list[Rows]:
        """Numerators and denominators of the curves that a column names; a denominator of 0 is no curve."""
        return [self.polynomial(form[self._rows[column]]) for form in self._forms]

    def polynomial(self, forms: Rows) -> Rows:
        """(1 + tau^2) times a form of each piece, in its chart."""
        a, b, c = forms.T
        return np.stack([a + self._sign * b, 2 * self._sign * c, a - self._sign * b], axis=1)

    def _prove(self, some: Ints) -> None:
        """Find those of some pieces, all proved before, of which all is certain.

        Notes
        -----
        Start is before stop. From start to stop contacts are in their range, and 0 <= lower <= upper <= 1 has no pole.
        """
        (n, d), (m, e) = (tuple(poly[some] for poly in self.curve(column)) for column in ("lower", "upper"))
        sign, other = self._signs(d, some), self._signs(e, some)
        self.named[some] = sign * other != 0
        result = self.named[some] & self._resolved[some] & (self.start.above[some] < self.stop.below[some])
        for poly, its in ((n, sign), (e - m, other)):
            result &= (self._signs(poly, some, inside=True) * its > 0) | ~poly.any(axis=1)
        result &= self._signs(times(m, d) - times(n, e), some, inside=True) * sign * other > 0
        for limit in self._limits:
            result &= self._signs(self.polynomial(limit)[some], some, inside=True) < 0
        self.proved[some] = result

    def _signs(self, poly: Rows, pieces: Ints, *, inside: bool = False) -> Ints:
        """Signs from start to stop, or strictly between them; 0 if it is not certain that there is one.

        Notes
        -----
        Of a monotone polynomial the signs at both ends decide, or if it vanishes at one of them that at the other. One
        that vanishes at both is negative between them if its second derivative is positive.
        """
        span = Span(self.start.lo[pieces], self.stop.hi[pieces])
        signs: Ints = span.signs(poly)
        some = np.flatnonzero((signs == 0) & poly.any(axis=1))
        if not len(some):
            return signs
        poly, pieces, span = poly[some], pieces[some], span.some(some)
        first, last = signs_at(poly, self.start.below[pieces]), signs_at(poly, self.stop.above[pieces])
        result = np.where(first == last, first, 0)
        slopes, at_both = span.signs(poly, 1), np.zeros(len(some), bool)
        if inside:
            rows = primitive(poly)
            at_start, at_stop = (angles.is_root(rows, pieces) for angles in (self.start, self.stop))
            result, at_both = np.where(at_start, last, np.where(at_stop, first, result)), at_start & at_stop
        signs[some] = np.where(at_both, -span.signs(poly, 2), np.where(slopes != 0, result, 0))
        return signs


class Angles:
    """One end of all pieces.

    Attributes
    ----------
    first, second : (N,) uint64
        Their names.
    lo, hi : (N,) float64
    rows : (N, 5)
        Primitive polynomials with a root there.
    ends : (N,) int64
        -1 or 1 at the end of a chart, else 0.
    below, above : (N,)
        Doubles or fractions, with the angle in between: these or nearer ones.
    proved : (N,) bool
        True if a root is the only one in its interval, and in the chart, for certain.
    meet : (N,) bool
        True if its two curves have no pole in the interval, for certain.
    """

    def __init__(self, columns: Columns, end: str) -> None:
        first, second, lo, hi, place = (getattr(columns.table, f"{end}_{name}") for name in NAMES)
        self.first, self.second, self.lo, self.hi = first, second, lo, hi
        self.below, self.above = lo.astype(object), hi.astype(object)
        (n, d), (m, e) = columns.curve(f"{end}_first"), columns.curve(f"{end}_second")
        span, is_pair = Span(lo, hi), second != 0
        self.meet: Mask = is_pair & (span.signs(d) * span.signs(e) != 0)
        self.rows = times(n, e) - times(m, d)
        self.rows[~is_pair, :3] = columns.polynomial(self._forms(columns, end, ~is_pair))[~is_pair]
        is_end = first == 0
        whole = np.where(is_end & (abs(lo) == 1), lo, 0).astype(np.int64)
        self.rows[is_end] = 0
        self.rows[is_end, 0], self.rows[is_end, 1] = -whole[is_end], 1
        self.rows = primitive(self.rows)
        at_end = {k: (values_at(self.rows, k) == 0) & (lo <= k) & (k <= hi) for k in (-1, 1)}
        self.ends: Ints = at_end[1].astype(np.int64) - at_end[-1]
        in_chart = ((lo >= -1) | at_end[-1]) & ((hi <= 1) | at_end[1])
        named = ~is_end | ((lo == hi) & (whole != 0) & ~is_pair)
        self.proved: Mask = named & (place == 0) & in_chart & (lo <= hi)
        self.proved &= (span.signs(self.rows, 1) != 0) & (signs_at(self.rows, lo) * signs_at(self.rows, hi) <= 0)

    def narrow(self, some: Ints) -> None:
        """Narrow the intervals of some angles, by Newton's method: where the sign still changes the root is."""
        one, by = 1 << BITS, 1 << BITS - NARROW
        rows = self.rows[some]
        places = np.array([int(Fraction(x) * one) for x in ((self.lo[some] + self.hi[some]) / 2).tolist()], object)
        for _ in range(STEPS):
            value, slope, power = rows[:, -1], 0 * places, 1
            for column in rows.T[-2::-1]:
                power *= one
                value, slope = value * places + column * power, slope * places + value
            slope[slope == 0] = 1
            places = places - value // slope
        below, above = (
            np.array([Fraction(x, one) for x in ends.tolist()], object) for ends in (places - by, places + by)
        )
        inside = (self.below[some] <= below) & (above <= self.above[some])
        inside[inside] = signs_at(rows[inside], below[inside]) * signs_at(rows[inside], above[inside]) < 0
        self.below[some[inside]], self.above[some[inside]] = below[inside], above[inside]

    def _forms(self, columns: Columns, end: str, which: Mask) -> Rows:
        """Forms of the angles that one pair of features names."""
        forms = np.zeros((len(which), 3), object)
        rows, known = columns.row(f"{end}_first"), dict[int, Form]()
        for k in np.flatnonzero(which & (self.first != 0)).tolist():
            if (form := known.get(rows[k])) is None:
                try:
                    form = columns.reader.world.angle(columns.surfaces[k], name_of(int(self.first[k])))
                except (Fault, IndexError):
                    form = NEVER
                known[rows[k]] = form
            forms[k] = form
        return forms

    def is_root(self, rows: Rows, some: Ints) -> Mask:
        """True if a polynomial, primitive, vanishes at the angle of a piece, for certain."""
        ends = self.ends[some]
        at_end = np.where(ends == 1, values_at(rows, 1), values_at(rows, -1)) == 0
        vanishes: Mask = np.where(ends != 0, at_end, (rows == self.rows[some]).all(axis=1)).astype(bool)
        return vanishes


class Span:
    """Intervals of tau, in doubles.

    Notes
    -----
    Coefficients are divided by the greatest. For a degree of at most 4 and |tau| < 2, no coefficient of a Taylor
    polynomial is greater than 2^6, and no sum here than 2^12. Each takes fewer than 100 operations, and is off by less
    than 2^-34. `ERROR` is more.
    """

    def __init__(self, lo: Floats, hi: Floats) -> None:
        self.lo, self.hi = lo, hi
        self._middle, self._radius = (lo + hi) / 2, (hi - lo) / 2 + 2.0**-50

    def some(self, rows: Ints) -> Span:
        return Span(self.lo[rows], self.hi[rows])

    def signs(self, poly: Rows, order: int = 0) -> Ints:
        """Signs of a derivative on the whole closed interval; 0 if it is not certain that there is one.

        Notes
        -----
        Its value in the middle is greater than all else of its Taylor polynomial there at the ends.
        """
        terms = [comb(k, order) * c for k, c in enumerate(self._taylor(poly)) if k >= order]
        rest = np.zeros(len(poly))
        for term in reversed(terms[1:]):
            rest = (rest + abs(term)) * self._radius
        return np.where(abs(terms[0]) > rest + ERROR, np.sign(terms[0]), 0).astype(np.int64)

    def _taylor(self, poly: Rows) -> list[Floats]:
        """Coefficients at the middle."""
        most = abs(poly).max(axis=1, initial=1)
        c = list((poly / most[:, None]).astype(float).T)
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


def times(p: Rows, q: Rows) -> Rows:
    """Products of quadratic polynomials."""
    (a, b, c), (d, e, f) = p.T, q.T
    return np.stack([a * d, a * e + b * d, a * f + b * e + c * d, b * f + c * e, c * f], axis=1)


def primitive(poly: Rows) -> Rows:
    """Polynomials of degree 4 at most without common divisors, and without the factor 1 + tau^2."""
    rows = np.zeros((len(poly), DEGREE + 1), object)
    rows[:, : poly.shape[1]] = poly
    a, b, c, d, e = rows.T
    whole = (a + e == c) & (b == d)
    rows[whole] = np.stack([a, b, e, 0 * a, 0 * a], axis=1)[whole]
    lead = np.zeros(len(rows), object)
    for column in rows.T:
        lead = np.where(column != 0, column, lead)
    divisor = np.gcd.reduce(rows, axis=1) * np.where(lead < 0, -1, 1)
    divisor[divisor == 0] = 1
    result: Rows = rows // divisor[:, None]
    return result


def values_at(poly: Rows, tau: int) -> Rows:
    """Values at 1 or -1."""
    values: Rows = poly[:, ::2].sum(axis=1) + tau * poly[:, 1::2].sum(axis=1)
    return values


def signs_at(poly: Rows, tau: Rows) -> Ints:
    """Exact signs at doubles or fractions."""
    fractions = [value.as_integer_ratio() for value in tau.tolist()]
    p, q = (np.array(column, object) for column in zip(*fractions, strict=True)) if fractions else (tau, tau)
    value, power = poly[:, -1], q
    for column in poly.T[-2::-1]:
        value, power = value * p + column * power, power * q
    return np.array([(x > 0) - (x < 0) for x in value.tolist()], np.int64)
