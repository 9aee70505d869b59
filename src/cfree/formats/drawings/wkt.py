"""Read polygons from well-known text with their decimals as written.

Each line has one geometry, POLYGON or MULTIPOLYGON. A word and a colon may precede it: ``robot:``, ``obstacle:`` and
``workspace:`` give its role, any other word names an obstacle. Heights and measures (Z, M) are ignored, as is
``SRID=4326;``; an EMPTY geometry is no polygon.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import NoReturn, TypeVar

from cfree.errors import InvalidPolygonError
from cfree.exact.number import ExactPoint, to_fraction
from cfree.formats.drawings.mending import mended, repairable
from cfree.formats.drawings.source import Source
from cfree.formats.shapes import IGNORE, ROLES, Shape
from cfree.formats.text.findings import Findings
from cfree.formats.text.json_positions import shortened
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import explained, flat_shape

T = TypeVar("T")
Placed = tuple[int, list[ExactPoint]]
"""A ring, and its place in the text."""
_LABEL = re.compile(r"\s*(?:([^:()]*):)?\s*(?:SRID\s*=\s*[0-9]+\s*;\s*)?", re.IGNORECASE)
_KIND = re.compile(r"(POLYGON|MULTIPOLYGON)(Z|M|ZM)?")
_LENGTHS = {"": (2, 3, 4), "Z": (3,), "M": (3,), "ZM": (4,)}  # numbers of a point
_TOKEN = re.compile(r"[(),]|[^\s(),]+")


def wkt_shapes(findings: Findings, source: Source | None = None) -> list[Shape]:
    """Read the shapes of a text, except empty lines and lines that begin with #; faults go to `findings`.

    With a source that has the option `repair`, polygons that cross themselves or overlap are repaired, and noted.

    Examples
    --------
    >>> text = "robot: POLYGON ((0 0, 1 0, 0 0.1))\\nMULTIPOLYGON (((3 0, 4 0, 4 1)), ((6 0, 7 0, 7 1)))"
    >>> [shape.role for shape in wkt_shapes(Findings("a.wkt", text))]
    ['robot', 'obstacle', 'obstacle']
    """
    lines = [match for match in re.finditer(r"[^\r\n]+", findings.text) if match[0].strip()]
    return [
        shape
        for match in lines
        if not match[0].lstrip().startswith("#")
        for shape in _Line(findings, match.start(), match.end(), source).shapes()
    ]


class _SyntaxFault(Exception):
    """A fault after which the rest of the line cannot be read."""


class _Line:
    """One line being read: `token` at `offset` is next, or "" at the end."""

    def __init__(self, findings: Findings, start: int, end: int, source: Source | None) -> None:
        self.findings = findings
        self.source = source
        self.mender = source if source and source.reading.repair else None
        label = _LABEL.match(findings.text, start, end)
        assert label is not None  # it matches the empty text
        self.label = (label[1] or "").strip()
        self.lengths = _LENGTHS[""]
        self.tokens = self._scan(label.end(), end)
        self.token, self.offset = next(self.tokens)

    def shapes(self) -> list[Shape]:
        """Return the shapes of the line; none, if it has a fault."""
        kind, start = self.token.upper(), self.offset
        if kind.startswith(("POINT", "LINESTRING", "MULTIPOINT", "MULTILINESTRING")):
            self.findings.at(start, self.label, flat_shape(kind))
            return []
        try:
            known = _KIND.fullmatch(kind)
            if not known:
                self._refuse("POLYGON (...) or MULTIPOLYGON (...)")
            self._advance()
            dimensions = known[2] or (self.token.upper() if self.token.upper() in _LENGTHS else "")
            if dimensions and not known[2]:
                self._advance()
            self.lengths = _LENGTHS[dimensions]
            parts = self._list(self._rings) if known[1] == "MULTIPOLYGON" else [self._rings()]
            if self.token:
                self._refuse("the end of the line")
        except _SyntaxFault:
            return []
        name = self.label if self.label not in ("", *ROLES) else None
        wanted = self.source.reading.roles.get(self.label) if self.source else None
        role = wanted or (self.label if self.label in ROLES else "obstacle")
        if self.source and role == IGNORE:
            self.source.note("assumption", "polygon that is ignored", "less", where=self.label)
            return []
        rings = [part for part in parts if part]
        if self.mender:
            try:
                polygons = mended(self.mender, [[ring for _, ring in part] for part in rings], role, name)
            except InvalidPolygonError as error:
                self.findings.at(start, self.label, explained(error))
                return []
        else:
            polygons = [polygon for part in rings if (polygon := self._polygon(part))]
        return [Shape(role, name, polygon) for polygon in polygons]

    def _rings(self) -> list[Placed]:
        """Return the rings of a polygon with their places; none, if one has a fault."""
        known_problems = len(self.findings)
        placed = [(offset, ring) for offset, ring in self._list(self._ring) if ring]
        return placed if len(self.findings) == known_problems else []

    def _polygon(self, placed: list[Placed]) -> Polygon | None:
        offsets, rings = zip(*placed, strict=True)
        try:
            return Polygon(rings[0], rings[1:])
        except InvalidPolygonError as error:
            self.findings.at(offsets[error.ring or 0], self.label, repairable(error))
            return None

    def _ring(self) -> tuple[int, list[ExactPoint]]:
        return self.offset, self._list(self._point)

    def _point(self) -> ExactPoint:
        values = [self._coordinate(), self._coordinate()]
        while self.token not in ("", "(", ")", ","):
            values.append(self._coordinate())
        if len(values) not in self.lengths:
            self._refuse(f"{' to '.join(map(str, self.lengths[::2]))} numbers a point")
        return values[0], values[1]

    def _coordinate(self) -> Fraction:
        if self.token in ("", "(", ")", ","):
            self._refuse("two numbers x y")
        try:
            return to_fraction(self.token)
        except ValueError as error:
            self.findings.at(self.offset, self.label, str(error))
            return Fraction(0)
        finally:
            self._advance()

    def _list(self, item: Callable[[], T]) -> list[T]:
        """Return the items between brackets; none, if EMPTY."""
        if self.token.upper() == "EMPTY":
            self._advance()
            return []
        items: list[T] = []
        separator = "("
        while self.token == separator:
            self._advance()
            items.append(item())
            separator = ","
        if not items or self.token != ")":
            self._refuse('"," or ")"' if items else '"("')
        self._advance()
        return items

    def _refuse(self, expected: str) -> NoReturn:
        got = shortened(self.token) or "the end of the line"
        self.findings.at(self.offset, self.label, f"expected {expected}, got {got}")
        raise _SyntaxFault

    def _advance(self) -> None:
        self.token, self.offset = next(self.tokens)

    def _scan(self, start: int, end: int) -> Iterator[tuple[str, int]]:
        for match in _TOKEN.finditer(self.findings.text, start, end):
            yield match[0], match.start()
        yield "", end
