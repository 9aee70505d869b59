"""The command ``cfree view``: a scene in the browser."""

from __future__ import annotations

from pathlib import Path

import click

from cfree.cli import drawing, options, reading
from cfree.cli.faults import one_line_faults
from cfree.cli.files import answer_for, bar, check_outputs, read_scene, without_curves
from cfree.cli.options import FILE, examples, file_option
from cfree.cli.terminal import printable


@click.command(
    cls=drawing.Command,
    epilog=examples("cfree view scene.json", "cfree view scene.json answer.json --html page.html --no-browser"),
)
@options.scene
@drawing.drawing
@reading.strict
@click.argument("answer", type=FILE, required=False)
@file_option("--html", metavar="HTML", help="Write the page: .html; it needs no other file and no server.")
@click.option("--browser/--no-browser", help="Open the page in the browser, or not.", default=True, show_default=True)
def view(scene: Path, answer: Path | None, html: Path | None, browser: bool) -> None:
    """Show a scene in the browser, to be dragged and turned.

    Shows its configuration space beside it, exact like all answers. ANSWER is a path or a proof written by cfree plan
    -o for this scene; an answer for another scene is refused. SCENE is JSON, GeoJSON, WKT, SVG, DXF or another format
    that cfree convert reads. Lines and circular arcs stay as they are; other curves become polygons around them.
    """
    with one_line_faults():
        from cfree.collision.arcs import arcs_of
        from cfree.planning.goals import AllSeparated
        from cfree.viewer.browser import view as show

        for source in (scene, answer):
            if html and source:
                check_outputs(source, {"page": html})
        loaded = read_scene(scene)
        if answer is None and loaded.curved and arcs_of(loaded) is None:
            loaded = without_curves(loaded, scene)
        with bar("reading"):
            shown = answer_for(loaded, answer) if answer else None
        if isinstance(shown, AllSeparated):
            raise ValueError(f"{answer}: proofs for several goals, and the page shows one; plan with one goal")
        print(printable(str(show(loaded, shown, html=html, browser=browser))))
