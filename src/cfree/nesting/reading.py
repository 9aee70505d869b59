"""Read layouts and parts from nesting JSON, and from drawings of any kind."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from cfree.arguments import checked
from cfree.curves.similar import similar
from cfree.exact.pose import Pose
from cfree.formats.drawings.nesting import NestingReader
from cfree.formats.drawings.source import Reading, Source
from cfree.formats.readers import is_drawing
from cfree.formats.scene_file import load_shapes, read_shapes
from cfree.formats.shapes import Shape, Shapes
from cfree.formats.text.archive import is_archive
from cfree.formats.text.findings import Findings, InvalidFileError, read_text, whole
from cfree.formats.text.json_text import read_literals, with_numbers
from cfree.nesting.layout import Nesting, Part, Placed, shape_box, union, with_quantity
from cfree.polygons.polygon import Polygon
from cfree.scene.reading import Note
from cfree.scene.scene import AnyShape

SHEET_NAMES = ("sheet", "stock", "bin", "container")
"""First words of layers, groups and names whose shapes are sheets."""
_SHEET = re.compile(rf"\s*(?:{'|'.join(SHEET_NAMES)})s?(?![^\W\d_])", re.IGNORECASE)
MOST_SHEETS = 1000
ITEM_KEYS = frozenset({"items", "Items"})


@dataclass(frozen=True)
class Job:
    """A file about nesting.

    Attributes
    ----------
    nesting : Nesting
        Sheets; parts in their places; parts without a place.
    is_strip : bool
        True if the sheet is a strip of open length.
    record : tuple of Note
        The record of reading.
    """

    nesting: Nesting
    is_strip: bool
    record: tuple[Note, ...]


@checked
def load_nesting(path: str | PathLike[str], **options: Any) -> Nesting:
    """Read the sheets and parts of a file of any kind.

    Parameters
    ----------
    path : path
        Nesting JSON: an instance with `items` and `bins` or a `strip_height`, with or without a solution. Or a drawing
        or scene of any kind that `load_shapes` reads: its workspaces, and the shapes on layers or with names that begin
        with "sheet", "stock", "bin" or "container", are sheets; all others are parts in their places.
    options
        Options of `load_shapes`; curves stay curves. Nesting JSON takes none.

    Returns
    -------
    Nesting
        Congruent shapes that are moved without a turn are copies of one part, whose origin is the lower left corner of
        its box. Items that the solution does not place are in `left`.

    Raises
    ------
    FormatError
        If the file cannot be read.

    Examples
    --------
    >>> load_nesting("examples/drawings/nest.json")
    <Nesting of 4 parts on 1 sheet, 38.0 % used>
    """
    if (job := _json_job(path)) is None:
        return job_of(load_shapes(path, curves=True, **options)).nesting
    if options:
        raise ValueError(f"{', '.join(options)}: only for drawings, and {fspath(path)} is nesting JSON; leave it out")
    return job.nesting


def read_job(path: str | PathLike[str], reading: Reading) -> tuple[Job, str]:
    """Read a file with the options of the command line; return its format as well."""
    if (job := _json_job(path)) is not None:
        return job, "nesting"
    shapes = read_shapes(path, reading)
    return job_of(shapes), shapes.form


def _json_job(path: str | PathLike[str]) -> Job | None:
    """Read nesting JSON; None if the file is of another kind."""
    if is_drawing(path) or is_archive(path) or Path(path).suffix.lower() not in (".json", ""):
        return None
    findings = Findings(fspath(path), read_text(Path(path)))
    if not findings.text.lstrip().startswith("{"):
        return None
    data = read_literals(findings)
    if not isinstance(data, dict) or not data.keys() & ITEM_KEYS or "type" in data:
        return None
    source = Source(findings.file)
    source.findings = findings
    return _instance(source, with_numbers(data))


def _instance(source: Source, data: Any) -> Job:
    reader = NestingReader(source)
    items = reader.items(data)
    bins, height = reader.bins(data), reader.strip_height(data)
    layouts = [(container, [*_places(reader, rows, items, path)]) for container, rows, path in reader.all_layouts(data)]
    length = reader.strip_width(data)
    source.findings.fail_if_any()
    parts = {
        number: Part(polygons, name, max(1, reader.demand[number]), [f"{d:.9g}deg" for d in degrees] or None)
        for number, (name, degrees, polygons) in items.items()
        if polygons
    }
    counts = Counter(number for _, places in layouts for number, _ in places)
    rest = {number: reader.demand[number] - counts[number] for number in parts}
    if height is not None:
        sheets: list[AnyShape] = [_rectangle(length or _generous(parts.values(), height), height)]
        where = [0] * len(layouts)
    else:
        sheets, where = _stock(bins, [container for container, _ in layouts], sum(max(0, n) for n in rest.values()))
    placed = [
        Placed(parts[number], pose, sheet)
        for sheet, (_, places) in zip(where, layouts, strict=True)
        for number, pose in places
    ]
    if not items:
        raise InvalidFileError(source.findings.file, [whole("items: there is none; give at least one")])
    left = [with_quantity(part, rest[number]) for number, part in parts.items() if rest[number] > 0]
    name = data.get("name", data.get("Name", ""))
    nesting = Nesting(sheets, placed, left, name=name if isinstance(name, str) else "")
    return Job(nesting, height is not None, tuple(note for note in source.notes if note.kind != "info"))


def _places(reader: NestingReader, rows: list[Any], items: Any, path: Any) -> Iterable[tuple[int, Pose]]:
    for k, one in enumerate(rows):
        place = reader.place_of(one, items, (*path, k))
        if place is not None:
            yield place


def _stock(bins: dict[int, tuple[int, list[Any]]], used: list[Any], demand: int) -> tuple[list[AnyShape], list[int]]:
    """Return sheets, and the sheet of each layout: first those of the layouts, then the rest of the stock."""
    stock = {number: count for number, (count, shapes) in bins.items() if shapes}
    if not stock:
        return [], [0] * len(used)
    first = next(iter(stock))
    names = [number if number in stock else first for number in used]
    for number in names:
        stock[number] -= stock[number] > 0
    for number, count in stock.items():
        more = demand if count < 0 else min(count, demand)
        names += [number] * min(more, MOST_SHEETS - len(names))
    return [bins[number][1][0] for number in names], [*range(len(used))]


def _rectangle(width: Fraction, height: Fraction) -> Polygon:
    return Polygon([(0, 0), (width, 0), (width, height), (0, height)])


def _generous(parts: Iterable[Part], height: Fraction) -> Fraction:
    """Return a length of a strip that is enough for all parts one after the other, in whole units."""
    boxes = [(part.quantity, *map(float, union(map(shape_box, part.shapes)))) for part in parts]
    lengths = [count * math.hypot(x1 - x0, y1 - y0) for count, x0, y0, x1, y1 in boxes]
    return Fraction(math.ceil(sum(lengths)) + 1)


def strip_for(parts: Iterable[Part], height: Fraction) -> Polygon:
    """Return a strip of a height that is long enough for all parts."""
    return _rectangle(_generous(parts, height), height)


def cut_off(nesting: Nesting) -> Polygon:
    """Return the strip of a layout, cut off where its last part ends."""
    (_, _, _, height), ends = (
        shape_box(nesting.sheets[0]),
        [shape_box(s)[2] for one in nesting.placed for s in one.shapes],
    )
    return _rectangle(max(ends), height)


def job_of(shapes: Shapes) -> Job:
    """Return the sheets and parts of a drawing."""
    sheets = [shape.polygon for shape in shapes.shapes if _is_sheet(shape)]
    parts: dict[AnyShape, Part] = {}
    placed: list[Placed] = []
    for shape in shapes.shapes:
        if not _is_sheet(shape):
            x, y = shape_box(shape.polygon)[:2]
            own = similar(shape.polygon, shift=(-x, -y))
            part = parts.setdefault(own, Part(own, shape.name or f"part {len(parts)}"))
            placed.append(Placed(part, Pose(x, y), _sheet_at(sheets, shape.polygon)))
    units = str(shapes.settings.get("units", ""))
    name = str(shapes.settings.get("name", "")) or Path(shapes.file).stem
    return Job(Nesting(sheets, placed, units=units, name=name), False, shapes.record)


def _is_sheet(shape: Shape) -> bool:
    return shape.role == "workspace" or _SHEET.match(shape.name or "") is not None


def _sheet_at(sheets: list[AnyShape], shape: AnyShape) -> int:
    """Return the sheet that a part lies on: the one whose box overlaps its box most."""
    x0, y0, x1, y1 = shape_box(shape)

    def shared(k: int) -> Fraction:
        u0, v0, u1, v1 = shape_box(sheets[k])
        return max(Fraction(0), min(x1, u1) - max(x0, u0)) * max(Fraction(0), min(y1, v1) - max(y0, v0))

    return max(range(len(sheets)), key=shared, default=0)
