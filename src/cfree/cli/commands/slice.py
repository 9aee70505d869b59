"""The command ``cfree slice``: the forbidden space at one orientation of the robot."""

from __future__ import annotations

from pathlib import Path

import click

from cfree.cli import drawing, options, reading
from cfree.cli.faults import one_line_faults
from cfree.cli.files import bar, check_outputs, computed, read_source
from cfree.cli.options import examples, file_option
from cfree.cli.values import read_angle
from cfree.formats.text.archive import is_archive


@click.command(
    "slice",
    cls=drawing.Command,
    epilog=examples(
        "cfree slice scene.json --theta 30deg --picture slice.png",
        "cfree slice scene.npz --theta tau:1/3 -o slice.geojson",
    ),
)
@options.scene
@drawing.drawing
@reading.strict
@click.option(
    "--theta", metavar="ANGLE", help='Cut at this orientation: "30deg", "0.5rad" or "tau:1/3".', required=True
)
@file_option("--output", "-o", metavar="GEOJSON", help="Write the region and its contact segments.")
@options.picture
@options.threads
@options.as_json
def cut(scene: Path, theta: str, output: Path | None, picture: Path | None, threads: int | None, as_json: bool) -> None:
    """Cut the forbidden space at one orientation of the robot.

    SCENE is JSON, GeoJSON, WKT, SVG, DXF or another format that cfree convert reads, or a boundary written by cfree
    boundary -o. Discs, stadiums and grown polygons stay as they are; polygons within --tolerance replace other curves.
    """
    with one_line_faults():
        angle = read_angle(theta, "--theta")
        written = check_outputs(scene, {"geojson": output, "picture": picture})
        from cfree.cli.describe import describe_slice
        from cfree.cli.report import print_result

        if is_archive(scene):
            options.refuse(options.COMPUTED, "threads")
        result = computed(read_source(scene), threads)
        section = result.slice(angle)
        if output:
            from cfree.formats.boundaries.slice_geojson import save_slice

            save_slice(section, output)
        if picture:
            from cfree.plot.boundary import plot_slice, save_figure

            with bar("picture"):
                save_figure(plot_slice(section).figure, picture)
        print_result(f"slice of {result.scene.name or scene}", scene, describe_slice(section), written, as_json)
