"""Mend the tags of a DXF file before ezdxf reads it, and count the digits of its numbers.

A DXF file is a list of tags: a line with a code, and a line with a value. Programs leave out the markers of subclasses
(code 100) that ezdxf needs, or the version. ezdxf takes a file without a version for R12, which has no subclasses. An
entity with a broken number is taken out, so that it does not cost the whole file.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

BINARY = b"AutoCAD Binary DXF"
OLDEST = b"AC1015"
"""The version from which on entities have subclasses."""
MARKERS: dict[bytes, tuple[bytes, ...]] = {
    b"LWPOLYLINE": (b"AcDbPolyline",),
    b"SPLINE": (b"AcDbSpline",),
    b"ELLIPSE": (b"AcDbEllipse",),
    b"HATCH": (b"AcDbHatch",),
    b"MLINE": (b"AcDbMline",),
    b"MTEXT": (b"AcDbMText",),
}
"""Subclass of each entity that came after R12."""
_MEASURED = {b"LINE", b"ARC", b"CIRCLE", b"LWPOLYLINE", b"VERTEX", b"ELLIPSE", b"SPLINE"}
_SEQUENCES = {b"POLYLINE": {b"VERTEX", b"SEQEND"}, b"INSERT": {b"ATTRIB", b"SEQEND"}}
_PARTS = {b"VERTEX", b"ATTRIB", b"SEQEND"}
_STRUCTURE = {b"SECTION", b"ENDSEC", b"BLOCK", b"ENDBLK", b"EOF"}
_COMMON = {8, 6, 62, 67, 48, 60, 370, 410, 420}
_POINTS, _RADIUS, _ANGLES = {10, 11, 20, 21}, 40, {50, 51}
_FLOATS = {*range(10, 60), *range(110, 150), *range(210, 240), *range(460, 470), *range(1010, 1060)}
_BINARY, _GROUP = {*range(310, 320), 1004}, 102
_INTEGERS = {*range(60, 80), *range(90, 100), *range(170, 180), *range(270, 290), *range(370, 390)}


@dataclass(frozen=True, slots=True)
class Entity:
    """An entity of the file, and its fault if it was taken out."""

    kind: str
    handle: str
    layer: str
    line: int
    fault: str = ""


@dataclass(slots=True)
class Tags:
    """A DXF file for ezdxf.

    Attributes
    ----------
    raw : bytes
        The file, mended.
    unit, unit_of_angles : float
        One in the last decimal place that is written for lengths, and for angles in degrees; 0 if none is written.
    lines : dict, optional
        Line of each entity in the file, by handle; None if the file has no lines.
    entities : list of Entity
        All that are left, polylines with their vertices as one.
    lost : list of Entity
        All that were taken out.
    mended : int
        Number of entities that got markers.
    """

    raw: bytes
    unit: float = 0.0
    unit_of_angles: float = 0.0
    lines: dict[str, int] | None = None
    entities: list[Entity] = field(default_factory=list)
    lost: list[Entity] = field(default_factory=list)
    mended: int = 0


Probe = Callable[[Sequence[tuple[int, bytes]]], str]


def mended(raw: bytes, probe: Probe | None = None) -> Tags:
    """Return a file with markers and a version, without the entities that have broken numbers.

    A binary file and a file that is no list of tags come back unchanged.

    Parameters
    ----------
    raw : bytes
    probe : callable, optional
        Called with the tags of each entity; a text is its fault, and the entity is taken out.

    Examples
    --------
    >>> text = b"0 SECTION 2 ENTITIES 0 ELLIPSE 8 walls 10 1.25 20 3 0 ENDSEC 0 EOF"
    >>> tags = mended(text.replace(b" ", b"\\n"))
    >>> tags.mended, tags.unit, b"AcDbEllipse" in tags.raw, b"$ACADVER" in tags.raw
    (1, 0.01, True, True)
    """
    if raw.startswith(BINARY):
        return Tags(raw)
    codes, values, broken = _pairs(raw.splitlines())
    return _Pass(raw, codes, values, broken, probe).tags if len(broken) < len(codes) else Tags(raw)


def essential(raw: bytes) -> bytes:
    """Return a text file without tables and objects, which a file with damaged ones can be read without."""
    codes, values, _ = _pairs(raw.splitlines())
    rows: list[bytes] = []
    section = b""
    for k, (code, value) in enumerate(zip(codes, values, strict=True)):
        if code == 0 and value == b"SECTION":
            section = values[k + 1] if k + 1 < len(values) else b""
        if section in (b"BLOCKS", b"ENTITIES"):
            rows += (b"%d" % code, value)
    header: list[bytes] = []
    for k, name in enumerate(values[:-1]):
        if codes[k] == 9 and name in (b"$ACADVER", b"$INSUNITS") and codes[k + 1] in (1, 70) and name not in header:
            header += (b"9", name, b"%d" % codes[k + 1], values[k + 1])
    start = (b"0", b"SECTION", b"2", b"HEADER", *header, b"0", b"ENDSEC")
    return b"\n".join([*start, *rows, b"0", b"EOF", b""])


def _pairs(rows: Sequence[bytes]) -> tuple[list[int], list[bytes], list[int]]:
    """Return codes and values, and the tags before which lines were left out since they are no codes."""
    try:
        codes = [int(row) for row in rows[: len(rows) // 2 * 2 : 2]]
        return codes, [row.strip() for row in rows[1::2]][: len(codes)], []
    except ValueError:
        pass
    codes, values, broken, k = [], list[bytes](), list[int](), 0
    while k + 1 < len(rows):
        try:
            codes.append(int(rows[k]))
        except ValueError:
            broken.append(len(codes))
            k += 1
        else:
            values.append(rows[k + 1].strip())
            k += 2
    return codes, values, broken


class _Pass:
    """One pass over the tags of a file."""

    def __init__(
        self, raw: bytes, codes: Sequence[int], values: Sequence[bytes], broken: Sequence[int], probe: Probe | None
    ) -> None:
        self.codes, self.values, self.broken, self.probe = codes, values, broken, probe
        self.lines: dict[str, int] = {}
        self.tags = Tags(raw, lines=self.lines)
        self.places, self.places_of_angles = 0, 0
        self.header: int | None = None  # the tag after which the header's variables begin
        self.version: int | None = None
        pieces: list[tuple[int, int, list[tuple[int, bytes]] | None]] = []
        newer = False
        for first, end, section in self.entities():
            if section == b"HEADER":
                self.look_at_header(first, end)
            elif section in (b"ENTITIES", b"BLOCKS") and values[first] not in _STRUCTURE:
                entity = self.entity(first, end)
                (self.tags.lost if entity.fault else self.tags.entities).append(entity)
                if entity.fault:
                    pieces.append((first, end, []))
                    continue
                newer = self.measure(first, end) or newer
                if marked := self.marked(first, end):
                    pieces.append((first, end, marked))
        self.tags.unit = 10.0**-self.places if self.places else 0.0
        self.tags.unit_of_angles = 10.0**-self.places_of_angles if self.places_of_angles else 0.0
        if newer:
            self.set_version(pieces)
        if pieces or broken:
            self.tags.raw = self.written(sorted(pieces, key=lambda piece: piece[0]))

    def entities(self) -> Iterator[tuple[int, int, bytes]]:
        """Yield first tag, end and section of each entity; polylines with their vertices."""
        zeros = [k for k, code in enumerate(self.codes) if code == 0]
        ends = [*zeros[1:], len(self.codes)]
        section, k = b"", 0
        while k < len(zeros):
            first, end, kind = zeros[k], ends[k], self.values[zeros[k]]
            followers = _SEQUENCES.get(kind, ())
            k += 1
            while k < len(zeros) and self.values[zeros[k]] in followers:
                end = ends[k]
                k += 1
                if self.values[zeros[k - 1]] == b"SEQEND":
                    break
            if kind == b"SECTION":
                section = next((self.values[j] for j in range(first, end) if self.codes[j] == 2), b"")
            yield first, end, section

    def look_at_header(self, first: int, end: int) -> None:
        for j in range(first, end):
            if self.codes[j] == 2 and self.header is None:
                self.header = j
            elif self.codes[j] == 9 and self.values[j] == b"$ACADVER" and j + 1 < end:
                self.version = j + 1

    def fault(self, first: int, end: int) -> str:
        """Return the fault of an entity: a number that cannot be read, or a line that is missing."""
        place = bisect_left(self.broken, first + 1)
        if place < len(self.broken) and self.broken[place] <= end:
            return "a line is missing, or there is one too many"
        kind, is_open = self.values[first], False
        kinds = [first, *(j for j in range(first + 1, end) if self.codes[j] == 0)]
        if kind in _PARTS or (self.values[kinds[-1]] != b"SEQEND" and (len(kinds) > 1 or kind == b"POLYLINE")):
            return "a part of it is missing"
        for code, value in zip(self.codes[first:end], self.values[first:end], strict=True):
            try:
                if code in _FLOATS:
                    float(value)
                elif code in _INTEGERS:
                    int(float(value))
                elif code in _BINARY:
                    bytes.fromhex(value.decode("ascii"))
            except (ValueError, OverflowError):
                return f"{value[:20].decode(errors='replace')!r} is no number"
            if code == _GROUP:
                if is_open != (value == b"}"):
                    return "a group of tags that has no end"
                is_open = not is_open
        if self.probe:
            ends = [*kinds[1:], end]
            parts = (zip(self.codes[j:k], self.values[j:k], strict=True) for j, k in zip(kinds, ends, strict=True))
            return next(filter(None, (self.probe(list(part)) for part in parts)), "")
        return "a group of tags that has no end" if is_open else ""

    def entity(self, first: int, end: int) -> Entity:
        """Return an entity with its fault."""
        end_of_head = next((j for j in range(first + 1, end) if self.codes[j] == 0), end)
        handle = layer = ""
        for code, value in zip(self.codes[first:end_of_head], self.values[first:end_of_head], strict=True):
            if code == 5 and not handle:
                handle = value.decode(errors="replace").upper()
            elif code == 8 and not layer:
                layer = value.decode(errors="replace")
        kind = self.values[first].decode(errors="replace")
        return Entity(kind, handle, layer or "0", 2 * first + 1, self.fault(first, end))

    def measure(self, first: int, end: int) -> bool:
        """Count decimal places, and keep lines; True if an entity came after R12."""
        kind, newer = self.values[first], self.values[first] in MARKERS
        for j in range(first, end):
            code, value = self.codes[j], self.values[j]
            if code == 0:
                kind = value
            elif code == 5:
                self.lines.setdefault(value.decode(errors="replace").upper(), 2 * first + 1)
            elif kind in _MEASURED and b"." in value:
                if code in _POINTS or (code == _RADIUS and kind in (b"ARC", b"CIRCLE")):
                    self.places = max(self.places, _places(value))
                elif code in _ANGLES and kind == b"ARC":
                    self.places_of_angles = max(self.places_of_angles, _places(value))
        return newer

    def marked(self, first: int, end: int) -> list[tuple[int, bytes]]:
        """Return an entity's tags with its markers, or an empty list if it has them."""
        markers = MARKERS.get(self.values[first], ())
        if all(marker in self.values[first:end] for marker in markers):
            return []
        self.tags.mended += 1
        tags = [tag for tag in zip(self.codes[first:end], self.values[first:end], strict=True) if tag[0] != 100]
        start = next((k for k, tag in enumerate(tags) if tag[0] == 10), len(tags))
        groups: tuple[list[tuple[int, bytes]], ...] = ([], [], [])
        for k, tag in enumerate(tags[1:], 1):
            owned = tag[0] == 5 or (tag[0] == 330 and k < start)
            groups[0 if owned else 1 if tag[0] in _COMMON else 2].append(tag)
        handles, common, rest = groups
        return [tags[0], *handles, (100, b"AcDbEntity"), *common, *((100, name) for name in markers), *rest]

    def set_version(self, pieces: list[tuple[int, int, list[tuple[int, bytes]] | None]]) -> None:
        """Give a file with newer entities a version that has them."""
        if self.version is not None:
            if self.values[self.version] < OLDEST:
                pieces.append((self.version, self.version + 1, [(1, OLDEST)]))
            return
        variable = [(9, b"$ACADVER"), (1, OLDEST)]
        if self.header is not None:
            pieces.append((self.header + 1, self.header + 1, variable))
        else:
            pieces.append((0, 0, [(0, b"SECTION"), (2, b"HEADER"), *variable, (0, b"ENDSEC")]))

    def written(self, pieces: Sequence[tuple[int, int, list[tuple[int, bytes]] | None]]) -> bytes:
        rows: list[bytes] = []
        last = 0
        for first, end, tags in [*pieces, (len(self.codes), len(self.codes), [])]:
            for code, value in zip(self.codes[last:first], self.values[last:first], strict=True):
                rows += (b"%d" % code, value)
            for code, value in tags or ():
                rows += (b"%d" % code, value)
            last = end
        return b"\n".join(rows) + b"\n"


def _places(value: bytes) -> int:
    """Return the number of decimal places of a number, at most 17."""
    digits, _, exponent = value.lower().partition(b"e")
    places = len(digits.partition(b".")[2]) - (int(exponent) if exponent else 0)
    return min(max(places, 0), 17)


def described(entity: Entity) -> str:
    """Return the handle and the line of an entity.

    Examples
    --------
    >>> described(Entity("ARC", "6E", "walls", 812))
    '6E, line 812'
    """
    return ", ".join(filter(None, (entity.handle, f"line {entity.line}")))
