"""The command ``cfree nest``: place parts on sheets, check a layout, compact it."""

from __future__ import annotations

import re
import time
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from cfree.cli import drawing, options, reading
from cfree.cli.faults import INCOMPLETE, REFUTED, fail, one_line_faults
from cfree.cli.files import bar, check_outputs
from cfree.cli.options import FILE, Word, examples, file_option
from cfree.cli.terminal import print_json, status
from cfree.cli.values import require_near
from cfree.words import counted

if TYPE_CHECKING:
    from cfree.nesting.checking import Overlap
    from cfree.nesting.layout import Nesting
    from cfree.nesting.reading import Job

PLACING = ("sheet", "strip", "sheets", "copies", "rotations", "gap", "kerf", "toward", "max_seconds")
SIDES = ["left", "right", "down", "up"]


@click.command(cls=drawing.Command, epilog=examples(
    "cfree nest parts.dxf --sheet 1000x500 --units mm --gap 2 --kerf 0.2 -o layout.dxf --picture layout.png",
    "cfree nest parts.svg --sheet plate.svg --copies 4 --rotations any -o layout.svg",
    "cfree nest instance.json -o layout.geojson             # items, bins or a strip; orientations of the file",
    "cfree nest layout.svg --check                          # exit code 1 if parts overlap",
    "cfree nest layout.svg --compact left -o compacted.svg",
))  # fmt: skip
@click.argument("source", type=FILE, metavar="FILE")
@drawing.drawing
@reading.strict
@click.option("--sheet", metavar="SHEET", help='Take sheets of this size, as in "1000x500", or from a file.',
              show_default="those of FILE")  # fmt: skip
@click.option("--strip", metavar="HEIGHT", help="Take a strip of this height and of open length.")
@click.option("--sheets", type=click.IntRange(1, 1000), default=1, metavar="N", show_default=True,
              help="Take up to N copies of --sheet.")  # fmt: skip
@click.option("--copies", type=click.IntRange(1, 100_000), default=1, metavar="N", show_default=True,
              help="Cut each part of a drawing N times as often as drawn.")  # fmt: skip
@click.option("--rotations", default="4", metavar="WHICH", show_default=True,
              help='Turn parts by so many steps of a full turn, by angles as in "0deg,90deg", or by any.')  # fmt: skip
@click.option("--gap", default="0", metavar="D", show_default=True,
              help="Keep cuts D apart, and off the edge of the sheet.")  # fmt: skip
@click.option("--kerf", default="0", metavar="W", show_default=True, help="Add the width W of the cut.")
@click.option("--toward", type=Word(["bottom", "left"]), show_default="bottom; of a strip: left",
              help="Place parts lowest, or leftmost.")  # fmt: skip
@click.option("--check", is_flag=True, help="Check the layout in FILE, exactly; place nothing.")
@click.option("--compact", type=Word(SIDES), metavar="SIDE",
              help="Slide and turn the parts of the layout in FILE to this side: left, right, down or up.")  # fmt: skip
@click.option("--max-seconds", type=click.FloatRange(min=0), metavar="S", show_default="no limit",
              help="Stop placing after S seconds; the rest of the parts is left.")  # fmt: skip
@file_option("--output", "-o", metavar="FILE", help="Write the layout: .svg, .dxf or .geojson.")
@options.picture
@options.as_json
def nest(
    source: Path,
    sheet: str | None,
    strip: str | None,
    sheets: int,
    copies: int,
    rotations: str,
    gap: str,
    kerf: str,
    toward: str | None,
    check: bool,
    compact: str | None,
    max_seconds: float | None,
    output: Path | None,
    picture: Path | None,
    as_json: bool,
) -> None:
    """Place parts on sheets without any overlap, or check a layout, or compact it.

    FILE is nesting JSON with items, and bins or a strip height, or a drawing: workspaces, and layers or names that
    begin with sheet, stock, bin or container, are sheets; all else are parts. Parts are placed bottom-left, the largest
    first, exactly: into exact fits and holes as well. A packer that searches, such as sparrow, packs denser. Exit code
    0: parts are placed, and those without a place are listed as left; 1: no part has a place, or parts overlap; 2: bad
    input; 3: no part was placed within --max-seconds.
    """
    with one_line_faults():
        began = time.monotonic()
        written = check_outputs(source, {"layout": output, "picture": picture})
        _refuse_other_tasks(check, compact)
        job = _read(source)
        nesting, facts = job.nesting, dict[str, Any]()
        if compact:
            nesting, facts = _compacted(nesting, compact)
        elif not check:
            nesting = _placed(job, sheet, strip, sheets, copies, rotations, gap, kerf, toward, max_seconds)
            if not nesting.placed and max_seconds is not None and time.monotonic() - began >= max_seconds:
                fail("no part was placed in time; give more --max-seconds", INCOMPLETE)
        with status() as say:
            say("checking ...")
            from cfree.nesting.checking import overlaps

            found = overlaps(nesting)
        if output:
            nesting.save(output)
        if picture:
            from cfree.plot.boundary import save_figure

            with bar("picture"):
                save_figure(nesting.plot(), picture)
        _report(source, nesting, found, facts, written, as_json)
        if found:
            raise click.exceptions.Exit(REFUTED)
        if not (nesting.placed or check or compact):
            fail("no part has a place on a sheet; give a larger sheet, a smaller gap, or more rotations", REFUTED)


def _refuse_other_tasks(check: bool, compact: str | None) -> None:
    if check and compact:
        raise ValueError("--check and --compact: give one of them")
    if check or compact:
        options.refuse(
            "only to place parts",
            "sheet",
            "strip",
            "sheets",
            "copies",
            "rotations",
            "gap",
            "kerf",
            "toward",
            "max_seconds",
        )


def _read(source: Path) -> Job:
    from cfree.nesting.reading import read_job

    with status() as say:
        say("reading ...")
        job, form = read_job(source, drawing.options_of_reading())
    if form == "nesting":
        drawing.refuse_all("only for drawings, and this file is read as nesting JSON")
    drawing.refuse("nesting has no robot", "robot", "pivot", "padding")
    drawing.refuse("layouts have no frame", "frame")
    drawing.refuse_unused((form,), curved=any(part.is_round for part in (one.part for one in job.nesting.placed)))
    reading.report(job.record, source)
    return job


def _placed(
    job: Job,
    sheet: str | None,
    strip: str | None,
    sheets: int,
    copies: int,
    rotations: str,
    gap: str,
    kerf: str,
    toward: str | None,
    max_seconds: float | None,
) -> Nesting:
    from cfree.nesting.layout import all_parts, with_quantity
    from cfree.nesting.placement import place

    parts = [with_quantity(part, part.quantity * copies) for part in all_parts(job.nesting)]
    if not parts and not job.nesting.sheets:
        raise ValueError("no part: the file has no closed shape; draw one")
    if not parts:
        raise ValueError("no part: the file has only sheets; draw parts on other layers, or give them other names")
    stock, is_strip = _stock(job, parts, sheet, strip, sheets)
    chosen: Any = toward or ("left" if is_strip else "bottom")
    with bar("placing") as progress:
        nesting = place(
            parts, stock, rotations=_rotations(rotations), gap=_length(gap, "--gap"), kerf=_length(kerf, "--kerf"),
            toward=chosen, max_seconds=max_seconds, progress=progress,
        )  # fmt: skip
    return _named(nesting, job.nesting, is_strip)


def _named(nesting: Nesting, source: Nesting, is_strip: bool) -> Nesting:
    """Return a layout with the name and unit of its file; a strip is cut off at its last part."""
    from cfree.nesting.layout import Nesting

    sheets: Any = nesting.sheets
    if is_strip and nesting.placed:
        from cfree.nesting.reading import cut_off

        sheets = [cut_off(nesting)]
    return Nesting(sheets, nesting.placed, nesting.left, source.units, source.name)


def _stock(job: Job, parts: Sequence[Any], sheet: str | None, strip: str | None, count: int) -> tuple[Any, bool]:
    """Return the sheets to use, and True if it is a strip of open length."""
    from cfree.nesting.layout import shape_box
    from cfree.nesting.reading import strip_for

    if sheet and strip:
        raise ValueError("--sheet and --strip: give one of them")
    if strip:
        return [strip_for(parts, _length(strip, "--strip", least=False))], True
    if sheet:
        return _sheets_of(sheet) * count, False
    options.refuse("only with --sheet", "sheets")
    if not job.nesting.sheets:
        raise ValueError('no sheet: give --sheet 1000x500, --strip 500, or a layer named "sheet"')
    if job.is_strip:
        return [strip_for(parts, shape_box(job.nesting.sheets[0])[3])], True
    return list(job.nesting.sheets), False


def _sheets_of(text: str) -> list[Any]:
    """Return the sheet of a size "WxH", or those in a file."""
    if not Path(text).exists():
        width, height = _size(text)
        return [[(0, 0), (width, 0), (width, height), (0, height)]]
    from cfree.nesting.reading import load_nesting

    nesting = load_nesting(text)
    shapes = nesting.sheets or tuple(shape for one in nesting.placed for shape in one.shapes)
    if not shapes:
        raise ValueError(f"--sheet: {text} has no shape; draw a closed outline")
    return list(shapes)


def _size(text: str) -> tuple[Fraction, Fraction]:
    """Read a size such as "1000x500"."""
    from cfree.exact.number import to_fraction

    try:
        width, height = map(to_fraction, re.split("[xX×*]", text))
    except ValueError:
        raise ValueError(f'--sheet: {text!r} is no size and no file; give a size as in "1000x500"') from None
    for name, value in (("width", width), ("height", height)):
        if value <= 0:
            raise ValueError(f"--sheet: {text}: its {name} is {value}; give a width and a height above 0")
    require_near(f"--sheet: {text}", width, height)
    return width, height


def _length(text: str, name: str, *, least: bool = True) -> Fraction:
    from cfree.exact.number import to_fraction

    try:
        value = to_fraction(text)
    except ValueError:
        raise ValueError(f'{name}: {text!r} is no length; give a number as in "2.5"') from None
    if value < 0 or (value == 0 and not least):
        raise ValueError(f"{name}: {text}; give a length{', 0 or more' if least else ' above 0'}")
    require_near(f"{name}: {text}", value)
    return value


def _rotations(text: str) -> Any:
    """Return "any", a number of steps, or angles."""
    if text == "any":
        return text
    if re.fullmatch(r"[-+]?\d+", text.strip()):
        return int(text)
    from cfree.cli.values import read_angle

    try:
        return [read_angle(word.strip(), "--rotations") for word in text.split(",")]
    except ValueError as error:
        raise ValueError(f'{error}; or give any, or a number of steps of a full turn, as in "4"') from None


def _compacted(nesting: Nesting, side: str) -> tuple[Nesting, dict[str, Any]]:
    from cfree.collision.motion import Rotation
    from cfree.nesting.compaction import compact

    chosen: Any = side
    with bar("compacting") as progress:
        result = compact(nesting, chosen, progress=progress)
    turns = sum(isinstance(each.motion, Rotation) for each in result.motions)
    return result.nesting, {"slides": len(result.motions) - turns, "turns": turns}


def _report(
    source: Path,
    nesting: Nesting,
    found: tuple[Overlap, ...],
    facts: dict[str, Any],
    written: dict[str, str],
    as_json: bool,
) -> None:
    from cfree.cli.report import print_rows
    from cfree.nesting.checking import SHEET

    x0, y0, x1, y1 = nesting.box
    sheets = counted(len(nesting.used), "sheet")
    left = {part.name: part.quantity for part in nesting.left}
    if as_json:
        print_json({
            "file": str(source), "parts": len(nesting.placed), "left": left, "sheets": len(nesting.used),
            "density": nesting.density, "box": [x0, y0, x1, y1], **facts,
            "overlaps": [
                {"parts": [part for part in one.parts if part != SHEET],
                 "depth": [one.depth.lo, one.depth.hi],
                 "vector": None if one.vector is None else [*map(str, one.vector)]}
                for one in found
            ],
            "placed": [
                {"part": one.part.name, "sheet": one.sheet, "x": str(one.pose.x), "y": str(one.pose.y),
                 "theta": one.pose.theta}
                for one in nesting.placed
            ],
            "files": written,
        })  # fmt: skip
        return
    is_on_sheets = bool(nesting.sheets and nesting.placed)
    rows: dict[str, Any] = {"parts": f"{len(nesting.placed)} placed{f' on {sheets}' if is_on_sheets else ''}"}
    if is_on_sheets:
        rows["used"] = f"{100 * nesting.density:.2f} % of the area"
    if nesting.placed:
        rows["extent"] = f"{x1 - x0:.6g} x {y1 - y0:.6g}{' ' + nesting.units if nesting.units else ''}"
    if facts:
        rows["motions"] = f"{counted(facts['slides'], 'slide')}, {counted(facts['turns'], 'turn')}, all proved free"
    if left:
        rows["left"] = ", ".join(f"{name} ({number})" for name, number in left.items())
    rows["check"] = f"{counted(len(found), 'overlap')}" if found else "no overlap, exactly"
    for k, one in enumerate(found[: reading.MOST_LINES]):
        rows["deepest" if not k else f"next {k}"] = str(one)
    print_rows(nesting.name or str(source), rows, written)
