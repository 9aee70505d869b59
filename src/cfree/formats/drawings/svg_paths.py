"""Path data of SVG: lines, curves and arcs, summed exactly.

Relative coordinates are decimals, which are added as decimals: a path that comes back to its begin does so exactly.
Data with a fault are read up to it, as the specification has it.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from decimal import Context, Decimal, localcontext

from cfree.curves.drawn import Affine, Arc, Cubic, Line, Ring, Vector
from cfree.exact.number import ExactPoint
from cfree.formats.drawings.source import Source
from cfree.formats.drawings.svg_lengths import MOST_DIGITS, NUMBER, SPACE, number
from cfree.formats.drawings.svg_transforms import placing

EXACT = Context(prec=6 * MOST_DIGITS, Emax=10**6, Emin=-(10**6), traps=[])
"""Sums of as many numbers as a file can have are exact in it."""
_COMMAND = re.compile("[MmZzLlHhVvCcSsQqTtAa]")
_NUMBER = re.compile(NUMBER)
_GAP = rf"{SPACE}*+,?+{SPACE}*+"
_NUMBERS = re.compile(rf"{SPACE}*+(?:{NUMBER}{_GAP})*+")
_ARC = re.compile(
    rf"({NUMBER}){_GAP}({NUMBER}){_GAP}({NUMBER}){_GAP}([01]){_GAP}([01]){_GAP}({NUMBER}){_GAP}({NUMBER}){_GAP}"
)
_BLANK = re.compile(rf"{SPACE}*+")
_DIGITS = re.compile(r"\.([0-9]+)")
_COUNT = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7}


@dataclass(slots=True)
class Subpath:
    """A connected part of an element, in the scene's frame.

    Attributes
    ----------
    segments : Ring
        Each begins at the end of the one before.
    closed : bool
        True if the file closes it: the last point is the first one.
    miss : float
        Bound of the distance of its end from the point that was meant, by the digits that are written; in user units.
    """

    segments: Ring = field(default_factory=list)
    closed: bool = False
    miss: float = 0.0


def read_numbers(text: str) -> tuple[list[Decimal], int | None]:
    """Return the numbers of a list, and the place of its first fault.

    Examples
    --------
    >>> read_numbers("1-.5.5,2")
    ([Decimal('1'), Decimal('-0.5'), Decimal('0.5'), Decimal('2')], None)
    >>> read_numbers("1 x")
    ([Decimal('1')], 2)
    """
    match = _NUMBERS.match(text)
    end = match.end() if match else 0
    words = _NUMBER.findall(text, 0, end)
    if any(len(word) > 17 for word in words) or "e" in text or "E" in text:
        return [number(word) for word in words], None if end == len(text) else end
    return [*map(Decimal, words)], None if end == len(text) else end


def read_path(source: Source, text: str, frame: Affine) -> tuple[list[Subpath], int | None]:
    """Return the parts of path data, and the place of its first fault; raise a ValueError at a number out of range.

    Examples
    --------
    >>> from cfree.curves.drawn import IDENTITY
    >>> (part,), fault = read_path(Source("a.svg"), "m0 0 .1 0 0 .2-.1-.2", IDENTITY)
    >>> part.segments[-1].end, part.closed, fault
    ((Fraction(0, 1), Fraction(0, 1)), False, None)
    """
    with localcontext(EXACT):
        return _Pen(source, text, frame).drawn()


class _Pen:
    """Draw path data."""

    def __init__(self, source: Source, text: str, frame: Affine) -> None:
        self.source, self.text = source, text
        self.place = placing(frame)
        self.linear = tuple(map(float, frame[:4]))
        digits = max(map(len, _DIGITS.findall(text)), default=0)
        self.unit = 10.0**-digits / math.sqrt(2) if digits else 0.0  # half of the last digit, in x and y
        self.subpaths: list[Subpath] = []
        self.part: Subpath | None = None
        zero = Decimal(0)
        self.x = self.y = self.begin_x = self.begin_y = zero
        self.point = self.begin = self.place(zero, zero)
        self.handle: tuple[Decimal, Decimal] | None = None  # the last control point, and the commands that mirror it
        self.mirrors = ""
        self.steps = 0  # relative numbers since the last absolute ones

    def drawn(self) -> tuple[list[Subpath], int | None]:
        fault = self._read()
        return [part for part in self.subpaths if part.segments], fault

    def _read(self) -> int | None:
        commands = [*_COMMAND.finditer(self.text)]
        first = _BLANK.match(self.text)
        begin = first.end() if first else 0
        if not commands:
            return None if begin == len(self.text) else begin
        if commands[0].start() != begin or commands[0][0] not in "Mm":
            return begin
        ends = [match.start() for match in commands[1:]] + [len(self.text)]
        for match, end in zip(commands, ends, strict=True):
            self.source.spend()
            fault = self._command(match[0], self.text[match.end() : end])
            if fault is not None:
                return match.end() + fault
        return None

    def _command(self, letter: str, chunk: str) -> int | None:
        """Draw a command and its numbers; return the place of a fault in them."""
        kind = letter.upper()
        if kind == "Z":
            self._close()
            blank = _BLANK.match(chunk)
            return None if blank and blank.end() == len(chunk) else blank.end() if blank else 0
        relative = kind != letter
        if kind == "A":
            return self._arcs(chunk, relative)
        values, fault = read_numbers(chunk)
        count = _COUNT[kind]
        whole = len(values) - len(values) % count
        if fault is None and (whole < len(values) or not values):
            fault = len(chunk)
        self.source.spend(whole // count)
        if kind == "L":
            self._lines(values[:whole], relative)
            return fault
        for k in range(0, whole, count):
            row = values[k : k + count]
            if kind == "M":
                self._move(row[0], row[1], relative)
                self._lines(values[2:whole], relative)
                break
            if kind in "HV":
                x, y = (row[0], Decimal(0)) if kind == "H" else (Decimal(0), row[0])
                if relative:
                    x, y = self.x + x, self.y + y
                else:
                    x, y = (x, self.y) if kind == "H" else (self.x, y)
                self._line(x, y, relative)
                continue
            if relative:
                row = [value + (self.y if j % 2 else self.x) for j, value in enumerate(row)]
            self._curve(kind, row, relative)
        return fault

    def _move(self, x: Decimal, y: Decimal, relative: bool) -> None:
        if relative:
            x, y = self.x + x, self.y + y
        self._step(relative)
        self.x, self.y = self.begin_x, self.begin_y = x, y
        self.point = self.begin = self.place(x, y)
        self.part = self.handle = None

    def _step(self, relative: bool) -> None:
        self.steps = self.steps + 1 if relative else 1

    def _piece(self) -> Subpath:
        """Return the part that is being drawn; a new one after a move or a close."""
        if self.part is None:
            self.part = Subpath()
            self.subpaths.append(self.part)
        self.part.miss = self.unit * (self.steps + 1)
        return self.part

    def _lines(self, values: list[Decimal], relative: bool) -> None:
        if not values:
            return
        segments, place, point, x, y = self._piece().segments, self.place, self.point, self.x, self.y
        for k in range(0, len(values), 2):
            if relative:
                x += values[k]
                y += values[k + 1]
            else:
                x, y = values[k], values[k + 1]
            after = place(x, y)
            if after != point:
                segments.append(Line(point, after))
                point = after
        self.x, self.y, self.point, self.handle = x, y, point, None
        self.steps = self.steps + len(values) // 2 if relative else 1
        self._piece()

    def _line(self, x: Decimal, y: Decimal, relative: bool) -> None:
        self._step(relative)
        part, after = self._piece(), self.place(x, y)
        if after != self.point:
            part.segments.append(Line(self.point, after))
        self.x, self.y, self.point, self.handle = x, y, after, None

    def _curve(self, kind: str, row: list[Decimal], relative: bool) -> None:
        """Draw a Bézier curve with absolute control points."""
        *controls, x, y = row
        if kind in "ST":
            mirror = self.handle if self.handle and kind in self.mirrors else (self.x, self.y)
            controls = [2 * self.x - mirror[0], 2 * self.y - mirror[1], *controls]
        last = (controls[-2], controls[-1])
        start, after = self.point, self.place(x, y)
        points = [_rounded(self.place(controls[k], controls[k + 1])) for k in range(0, len(controls), 2)]
        a, b = _rounded(start), _rounded(after)
        if len(points) == 1:
            points = [_between(a, points[0]), _between(b, points[0])]
        self._step(relative)
        part = self._piece()
        if not a == points[0] == points[1] == b:
            part.segments.append(Cubic((a, points[0], points[1], b), (start, after)))
        self.x, self.y, self.point = x, y, after
        self.handle, self.mirrors = last, "CS" if kind in "CS" else "QT"

    def _close(self) -> None:
        if self.part is not None:
            if self.point != self.begin:
                self.part.segments.append(Line(self.point, self.begin))
            self.part.closed = True
        self.x, self.y, self.point = self.begin_x, self.begin_y, self.begin
        self.part = self.handle = None

    def _arcs(self, chunk: str, relative: bool) -> int | None:
        blank = _BLANK.match(chunk)
        here = blank.end() if blank else 0
        if here == len(chunk):
            return here
        while here < len(chunk):
            match = _ARC.match(chunk, here)
            if not match:
                return here
            self.source.spend()
            rx, ry, turn, large, sweep, x, y = (number(match[k]) for k in range(1, 8))
            if relative:
                x, y = self.x + x, self.y + y
            self._arc(abs(float(rx)), abs(float(ry)), float(turn), bool(large), bool(sweep), x, y, relative)
            here = match.end()
        return None

    def _arc(
        self, rx: float, ry: float, turn: float, large: bool, sweep: bool, x: Decimal, y: Decimal, relative: bool
    ) -> None:
        """Draw an arc of an ellipse: its center is computed in doubles, its ends are exact."""
        dx, dy = float(x - self.x), float(y - self.y)
        if not rx or not ry:
            self._line(x, y, relative)
            return
        self._step(relative)
        part, start, after = self._piece(), self.point, self.place(x, y)
        if after != start:
            center, u, v, first, last = center_of(dx, dy, rx, ry, turn, large, sweep)
            a, b, c, d = self.linear

            def carried(p: Vector) -> Vector:
                return a * p[0] + c * p[1], b * p[0] + d * p[1]

            origin, (mx, my) = _rounded(start), carried(center)
            part.segments.append(
                Arc((origin[0] + mx, origin[1] + my), carried(u), carried(v), first, last, (start, after))
            )
        self.x, self.y, self.point, self.handle = x, y, after, None


def center_of(
    dx: float, dy: float, rx: float, ry: float, turn: float, large: bool, sweep: bool
) -> tuple[Vector, Vector, Vector, float, float]:
    """Return an arc from the origin to (dx, dy): center, conjugate radii, first and last angle.

    Radii that are too small for the ends are enlarged.
    """
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    hx, hy = (-c * dx - s * dy) / 2 / rx, (s * dx - c * dy) / 2 / ry  # half the way back, in the ellipse's frame
    length = math.hypot(hx, hy)
    if length > 1:
        rx, ry, hx, hy = rx * length, ry * length, hx / length, hy / length
    rise = math.sqrt(max(0.0, 1 - hx * hx - hy * hy)) / math.hypot(hx, hy)
    if large == sweep:
        rise = -rise
    qx, qy = rise * hy, -rise * hx
    first = math.atan2(hy - qy, hx - qx)
    angle = math.atan2(-hy - qy, -hx - qx) - first
    if sweep and angle <= 0:
        angle += math.tau
    if not sweep and angle >= 0:
        angle -= math.tau
    u, v = (rx * c, rx * s), (-ry * s, ry * c)
    center = dx / 2 + qx * u[0] + qy * v[0], dy / 2 + qx * u[1] + qy * v[1]
    return center, u, v, first, first + angle


def _rounded(p: ExactPoint) -> Vector:
    return float(p[0]), float(p[1])


def _between(a: Vector, b: Vector) -> Vector:
    """Return the control point of a cubic from an end and the control point of a quadratic curve."""
    return a[0] + 2 * (b[0] - a[0]) / 3, a[1] + 2 * (b[1] - a[1]) / 3


def closed_by_a_line(part: Subpath) -> Ring:
    """Return the ring of a part, closed as a renderer closes what it fills."""
    if part.closed or not part.segments:
        return part.segments
    first, last = start_of(part.segments), end_of(part.segments)
    return part.segments if first == last else [*part.segments, Line(last, first)]


def start_of(segments: Ring) -> ExactPoint:
    """Return the exact first point."""
    segment = segments[0]
    tips = (segment.start, segment.end) if isinstance(segment, Line) else segment.tips
    assert tips
    return tips[0]


def end_of(segments: Ring) -> ExactPoint:
    """Return the exact last point."""
    segment = segments[-1]
    tips = (segment.start, segment.end) if isinstance(segment, Line) else segment.tips
    assert tips
    return tips[1]


def on_a_line(segments: Ring) -> bool:
    """True if all segments are straight, on one line."""
    if not all(isinstance(segment, Line) for segment in segments):
        return False
    points = [segment.end for segment in segments if isinstance(segment, Line)]
    (x, y), (p, q) = start_of(segments), points[0]
    return all((p - x) * (b - y) == (q - y) * (a - x) for a, b in points)
