"""The record of reading on the screen: one line for each kind and place, and `--strict`, which makes losses errors."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from cfree.cli import drawing
from cfree.cli.faults import BAD_INPUT, fail, tell
from cfree.formats.text.archive import is_archive

if TYPE_CHECKING:
    from cfree.formats.fitting import Pivot
    from cfree.formats.shapes import Shapes
    from cfree.scene.reading import Note
    from cfree.scene.scene import Scene

MOST_LINES = 8
"""Maximum number of lines about one file; `cfree check` prints all of them."""
AS_READ = "as read"
"""Key of the line that ends a result: the worst note, and the claim that it harms."""
_NOTES, _SOURCES = "record", "record.sources"
_ANY, _LOST = f"{_NOTES}.strict", f"{_NOTES}.strict_lost"


class Commands(click.Group):
    """A group whose commands take `--strict=lost` beside `--strict`, which needs no value."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        return super().parse_args(ctx, ["--strict-lost" if word == "--strict=lost" else word for word in args])


def strict(command: Any) -> Any:
    """Add the option `--strict` to a command."""

    def keep(context: click.Context, parameter: click.Parameter, is_set: bool) -> None:
        context.meta[f"{_NOTES}.{parameter.name}"] = is_set

    flags = (
        click.option(
            "--strict", is_flag=True, expose_value=False, callback=keep,
            help="Refuse a file that is read with losses, guesses or warnings; --strict=lost: with losses.",
        ),
        click.option("--strict-lost", is_flag=True, hidden=True, expose_value=False, callback=keep),
    )  # fmt: skip
    for flag in reversed(flags):
        command = flag(command)
    return command


def made(
    shapes: Shapes, source: Path, robot: Any = None, pivot: Pivot | None = None, most: int | None = MOST_LINES
) -> Scene:
    """Return the scene of the shapes in a file, and report its record of reading, also if it cannot be made."""
    from cfree.errors import FormatError
    from cfree.scene.reading import together
    from cfree.scene.scene import with_reading

    try:
        scene = shapes.scene(robot, pivot)
    except FormatError:
        report((*shapes.record, *getattr(robot, "record", ())), source, most)
        raise
    if robot is not None and not hasattr(robot, "record"):
        scene = with_reading(scene, together(scene.reading, unit_of_text(scene.units, shapes)))
    report(scene.reading, source, most)
    return scene


def unit_of_text(units: str, shapes: Shapes) -> tuple[Note, ...]:
    """Return a note about the unit of a footprint given as text, unless it is the usual one."""
    from cfree.scene.reading import Note, of_file

    notes = () if units in ("", "m") else (Note("info", f"footprint taken in {units}"),)
    return notes if shapes.form == "scene" else of_file(notes, shapes.file)


def report(notes: Sequence[Note], source: Path, most: int | None = MOST_LINES) -> None:
    """Print the lines of a record to standard error, the most serious first.

    A file is reported once; each after the first has its name above its lines. With `--strict` end the command if there
    is a loss, and print all losses.
    """
    from cfree.scene.reading import together
    from cfree.scene.reading_lines import counts, lines, losses

    meta = click.get_current_context().meta
    if source in meta.setdefault(_SOURCES, []):
        return
    meta[_SOURCES].append(source)
    meta[_NOTES] = together(meta.get(_NOTES, ()), notes)
    refused = losses(notes) if meta.get(_ANY) else ()
    if not refused and meta.get(_LOST):
        refused = tuple(note for note in notes if note.kind == "lost")
    texts = lines(refused or notes)
    is_checkable = source.is_file() and not is_archive(source)
    shown = texts[:most] if is_checkable and not refused else texts
    if texts and len(meta[_SOURCES]) > 1:
        tell(f"{source}:")
    for text in shown:
        tell(text)
    if refused:
        fail(
            f"{source}: read with {counts(refused)}, and --strict allows none; mend the file, or leave it out",
            BAD_INPUT,
        )
    if len(shown) < len(texts):
        import shlex

        again = shlex.join(["cfree", "check", str(source), *drawing.words()])
        tell(f"and {len(texts) - len(shown):,} more: {again}")


def is_strict() -> bool:
    """True if the command refuses losses."""
    meta = click.get_current_context().meta
    return bool(meta.get(_ANY) or meta.get(_LOST))


def reported() -> tuple[Note, ...]:
    """Return the notes that this command has reported, the most serious first."""
    context = click.get_current_context(silent=True)
    notes: tuple[Note, ...] = () if context is None else context.meta.get(_NOTES, ())
    return notes


def facts(notes: Sequence[Note] | None = None) -> dict[str, Any]:
    """Return the whole record as a member of JSON: what this command has reported, unless it is given."""
    from cfree.formats.scenes.reading_text import records

    return {"reading": records(reported() if notes is None else notes)}


def last_line() -> str:
    """Return the worst note for a result that claims nothing but what it shows; empty if none harms it."""
    from cfree.scene.reading_lines import as_read

    return as_read(reported())
