"""The command ``cfree film``: films of scenes and answers."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from cfree.cli import drawing, options, reading
from cfree.cli.faults import one_line_faults
from cfree.cli.files import check_outputs
from cfree.cli.options import FILE, Word, examples, file_option
from cfree.cli.values import read_pixels

if TYPE_CHECKING:
    from cfree.film import Storyboard


@click.command(
    cls=drawing.Command,
    epilog=examples(
        "cfree film scene.json -o film.mp4",
        "cfree film scene.json answer.json -o way.gif",
        "cfree film paper_fig9.json five_convex.json -o paper.mp4 --seconds 60",
        "cfree film scene.json -o path.gif --storyboard path --seconds 5 --fps 10",
        "cfree film scene.json -o turn.gif --storyboard turntable",
    ),
)
@click.argument("scenes", type=FILE, metavar="SCENE... [ANSWER]", nargs=-1, required=True)
@drawing.drawing
@reading.strict
@file_option("--output", "-o", metavar="FILE", help="Write the film: .mp4 or .gif.", required=True)
@click.option(
    "--storyboard",
    type=Word(["paper", "path", "separation", "turntable"]),
    metavar="NAME",
    help='Choose "paper" (slices, a helix, patches, the whole boundary, a path), "path", "separation" or "turntable".',
    default="paper",
    show_default=True,
)
@click.option(
    "--seconds",
    type=float,
    metavar="S",
    help="Set the length of the film in seconds.",
    show_default="GIF 6; else 30, separation 12, turntable 8, an answer's path 6 to 22",
)
@click.option("--fps", type=int, metavar="N", help="Set the frames a second.", default=25, show_default=True)
@click.option(
    "--size",
    metavar="WxH",
    help="Set width and height in pixels, even numbers.",
    show_default="1280x720; 640x360 for a GIF",
)
def film(
    scenes: tuple[Path, ...], output: Path, storyboard: Storyboard, seconds: float | None, fps: int, size: str | None
) -> None:
    """Make a film of the robot and of its configuration.

    Shows the robot among the obstacles, and its point in the configuration space. Scenes follow one after the other;
    each is JSON, GeoJSON, WKT, SVG, DXF or another format that cfree convert reads, or a boundary written by cfree
    boundary -o. All storyboards but the turntable need the start and the goal of each scene. After one scene ANSWER may
    follow, a path or a proof for it, written by cfree plan -o: then the film shows this answer.
    """
    with one_line_faults():
        from cfree.cli.films import film_answer, film_scenes
        from cfree.cli.report import print_rows
        from cfree.formats.answers.answer_file import is_answer

        for scene in scenes:
            written = check_outputs(scene, {"film": output})
        pixels = read_pixels(size or ("640x360" if output.suffix.lower() == ".gif" else "1280x720"))
        if is_answer(scenes[-1]):
            if len(scenes) != 2:
                raise ValueError(f"{scenes[-1]}: an answer; give it after one scene, its own")
            options.refuse("not with an answer, which has a storyboard of its own", "storyboard")
            rows = film_answer(*scenes, output, seconds, fps, pixels)
        else:
            rows = film_scenes(scenes, output, storyboard, seconds, fps, pixels)
        print_rows(", ".join(map(str, scenes)), rows, written)
