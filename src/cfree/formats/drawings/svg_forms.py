"""Basic shapes of SVG, and paths, as parts in the scene's frame."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from math import pi, tau

from cfree.curves.drawn import Affine, Arc, Line, Ring, Vector
from cfree.exact.number import ExactPoint
from cfree.formats.drawings.source import Source
from cfree.formats.drawings.svg_lengths import Axis
from cfree.formats.drawings.svg_paths import Subpath, read_numbers, read_path
from cfree.formats.drawings.svg_transforms import placing

FORMS = {"path", "rect", "circle", "ellipse", "polygon", "polyline", "line"}
Box = tuple[Fraction, Fraction, Fraction, Fraction]


@dataclass(frozen=True, slots=True)
class Form:
    """An element with an outline.

    Attributes
    ----------
    text : callable
        Returns the value of an attribute, or the empty string.
    length : callable
        Returns the length of an attribute, which is 0 if it is missing; None for "auto".
    frame : Affine
        From its coordinates to the scene's.
    """

    source: Source
    tag: str
    text: Callable[[str], str]
    length: Callable[[str, Axis], Fraction | None]
    frame: Affine

    def parts(self) -> tuple[list[Subpath], int | None]:
        """Return its parts, and the place of a fault in its numbers; a size of 0 draws nothing."""
        match self.tag:
            case "path":
                return read_path(self.source, self.text("d"), self.frame)
            case "polygon" | "polyline":
                return self._corners(closed=self.tag == "polygon")
            case "line":
                x1, y1, x2, y2 = (self._number(key, "x" if key[0] == "x" else "y") for key in ("x1", "y1", "x2", "y2"))
                return self._chain([(x1, y1), (x2, y2)], closed=False), None
            case "rect":
                return self._rectangle(), None
        return self._ellipse(), None

    def _number(self, key: str, axis: Axis) -> Fraction:
        return self.length(key, axis) or Fraction(0)

    def _size(self, key: str, axis: Axis) -> Fraction:
        value = self._number(key, axis)
        if value < 0:
            self.source.note("lost", f"{self.tag} of a size below 0", "less")
        return max(value, Fraction(0))

    def _corners(self, closed: bool) -> tuple[list[Subpath], int | None]:
        text = self.text("points")
        values, fault = read_numbers(text)
        if fault is None and len(values) % 2:
            fault = len(text)
        self.source.spend(len(values) // 2)
        digits = [-exponent for value in values[:64] if isinstance(exponent := value.as_tuple().exponent, int)]
        unit = 10.0 ** -max(digits, default=0) if any(digit > 0 for digit in digits) else 0.0
        pairs = [*zip(values[::2], values[1::2], strict=False)]
        return self._chain(pairs, closed, unit), fault

    def _chain(
        self, points: list[tuple[Fraction, Fraction]] | list[tuple[Decimal, Decimal]], closed: bool, unit: float = 0.0
    ) -> list[Subpath]:
        place = placing(self.frame)
        corners = [place(x, y) for x, y in points]
        after = [*corners[1:], *corners[:1]] if closed else corners[1:]
        ring: Ring = [Line(a, b) for a, b in zip(corners, after, strict=False) if a != b]
        return [Subpath(ring, closed, unit)] if ring else []

    def _radii(self, low: str, high: str) -> tuple[Fraction, Fraction]:
        """Return both radii; a missing one equals the other."""
        rx = self.length(low, "x") if self.text(low) else None
        ry = self.length(high, "y") if self.text(high) else None
        rx, ry = rx if rx is not None else ry, ry if ry is not None else rx
        return max(rx or Fraction(0), Fraction(0)), max(ry or Fraction(0), Fraction(0))

    def _ellipse(self) -> list[Subpath]:
        x, y = self._number("cx", "x"), self._number("cy", "y")
        rx, ry = (self._size("r", "diagonal"),) * 2 if self.tag == "circle" else self._radii("rx", "ry")
        if not rx or not ry:
            return []
        return [Subpath([self._arc((x, y), rx, ry, 0.0, tau, (x + rx, y), (x + rx, y))], True)]

    def _arc(
        self, center: ExactPoint, rx: Fraction, ry: Fraction, first: float, last: float, a: ExactPoint, b: ExactPoint
    ) -> Arc:
        place = placing(self.frame)

        def rounded(p: ExactPoint) -> Vector:
            x, y = place(*p)
            return float(x), float(y)

        m = [float(entry) for entry in self.frame[:4]]
        u, v = (m[0] * float(rx), m[1] * float(rx)), (m[2] * float(ry), m[3] * float(ry))
        return Arc(rounded(center), u, v, first, last, (place(*a), place(*b)))

    def _rectangle(self) -> list[Subpath]:
        x, y, w, h = self.box_of_rectangle()
        if not w or not h:
            return []
        rx, ry = self._radii("rx", "ry")
        rx, ry = min(rx, w / 2), min(ry, h / 2)
        if not rx or not ry:
            return self._chain([(x, y), (x + w, y), (x + w, y + h), (x, y + h)], closed=True)
        left, right, low, high = x + rx, x + w - rx, y + ry, y + h - ry
        corners = [
            ((right, y), (right, low), (x + w, low)),
            ((x + w, high), (right, high), (right, y + h)),
            ((left, y + h), (left, high), (x, high)),
            ((x, low), (left, low), (left, y)),
        ]
        place = placing(self.frame)
        ring: Ring = []
        before = corners[-1][2]
        for k, (begin, center, end) in enumerate(corners):
            if before != begin:
                ring.append(Line(place(*before), place(*begin)))
            first = (k - 1) * pi / 2
            ring.append(self._arc(center, rx, ry, first, first + pi / 2, begin, end))
            before = end
        return [Subpath(ring, True)]

    def box_of_rectangle(self) -> Box:
        """Return x, y, width and height of a rectangle."""
        x, y = self._number("x", "x"), self._number("y", "y")
        return x, y, self._size("width", "x"), self._size("height", "y")


def extent(rings: Sequence[Ring]) -> Box:
    """Return the box of lines, and of ellipses and their quarters: least x and y, greatest x and y."""
    points: list[ExactPoint] = []
    for ring in rings:
        for segment in ring:
            if isinstance(segment, Line):
                points += (segment.start, segment.end)
            elif isinstance(segment, Arc):
                count = 4 if segment.closed else 1
                turns = (segment.first + k * (segment.last - segment.first) / count for k in range(count + 1))
                points += [(Fraction(x), Fraction(y)) for x, y in map(segment.at, turns)]
    xs, ys = zip(*points, strict=True)
    return min(xs), min(ys), max(xs), max(ys)
