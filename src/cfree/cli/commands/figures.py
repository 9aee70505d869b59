"""The command ``cfree figures``: the figures of the paper."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from cfree.cli import options
from cfree.cli.faults import one_line_faults
from cfree.cli.files import bar
from cfree.cli.options import Word, examples, file_option
from cfree.cli.terminal import print_json, printable
from cfree.cli.values import read_numbers

if TYPE_CHECKING:
    from cfree.plot.rendered import Renderer


@click.command(epilog=examples("cfree figures -o pictures", "cfree figures -o pictures --only 7,9 --format svg"))
@file_option("--output", "-o", metavar="DIR", help="Write into this directory, made if missing.", required=True)
@click.option("--only", metavar="NUMBERS", help='Draw some of the figures: "7" or "7,9".', show_default="all")
@click.option(
    "--format",
    "formats",
    metavar="FORMATS",
    help="Write some of svg, pdf and png.",
    default="svg,pdf,png",
    show_default=True,
)
@click.option(
    "--renderer",
    type=Word(["matplotlib", "pyvista"]),
    help="Draw surfaces by matplotlib, as vectors, or by PyVista, as pixels in true depth order.",
    show_default="pyvista if installed",
)
@options.as_json
def figures(output: Path, only: str | None, formats: str, renderer: Renderer | None, as_json: bool) -> None:
    """Draw the figures of the paper from computed data.

    Draws figures 1 to 10 of the paper, and thirteen more.
    """
    with one_line_faults():
        from cfree.arguments import one_of
        from cfree.figures import FIGURES, draw_all
        from cfree.figures.style import FORMATS
        from cfree.plot.rendered import MISSING, best_renderer

        for word in formats.split(","):
            one_of("--format", word, FORMATS)
        numbers = None if only is None else read_numbers(only)
        has_space = any(panel.in_space for e in FIGURES if numbers is None or e.number in numbers for panel in e.panels)
        if not has_space:
            options.refuse("only for figures with surfaces, and none of these has any", "renderer")
        with bar("figures") as progress:
            files = draw_all(output, only=numbers, formats=formats.split(","), renderer=renderer, progress=progress)
        if as_json:
            print_json({"files": [str(file) for file in files]})
        else:
            for entry in FIGURES:
                written = [str(file) for file in files if file.stem == entry.stem]
                if written:
                    print(printable(f"figure {entry.number}: {entry.caption} {' '.join(written)}"))
        if has_space and renderer is None and best_renderer() == "matplotlib":
            print(f"drawn by matplotlib; {MISSING}", file=sys.stderr)
