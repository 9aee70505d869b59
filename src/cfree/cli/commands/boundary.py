"""The command ``cfree boundary``: the boundary of the forbidden space, in a file or in the files of a folder."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import TYPE_CHECKING

import click

from cfree.cli import drawing, options, reading
from cfree.cli.faults import INCOMPLETE, fail, one_line_faults
from cfree.cli.files import bar, check_outputs, computed, read_source
from cfree.cli.options import FILE, examples, file_option
from cfree.cli.values import read_size
from cfree.formats.text.archive import is_archive
from cfree.words import counted

if TYPE_CHECKING:
    from cfree.forbidden.boundary import Boundary


@click.command(
    cls=drawing.Command,
    epilog=examples(
        "cfree boundary scene.json --picture scene.png",
        "cfree boundary scene.json -o scene.npz --mesh scene.glb --threads 1",
        "cfree boundary robot.json --obstacles city.geojsonl --folder city --workers 4",
    ),
)
@options.scene
@drawing.drawing
@reading.strict
@file_option("--output", "-o", metavar="FILE", help="Write the boundary to a file.")
@options.picture
@file_option("--mesh", metavar="GLB", help="Write a mesh: .glb, .ply, .obj or .stl.")
@click.option(
    "--error",
    type=float,
    metavar="E",
    help="Limit the distance of the mesh to the boundary, in scene units.",
    show_default="robot's radius / 100",
)
@options.threads
@options.max_seconds
@options.max_memory
@file_option("--folder", metavar="DIR", help="Compute it in tiles, with cells and portals, into a folder; or resume.")
@click.option("--obstacles", multiple=True, type=FILE, metavar="FILE", help="Add obstacles from a file; with --folder.")
@click.option("--tiles", type=click.IntRange(min=1), metavar="N", help="Divide into N tiles; with --folder.",
              show_default="one per 20,000 vertices")  # fmt: skip
@options.workers
@options.scheduler
@options.verbose
@options.as_json
def boundary(
    scene: Path, output: Path | None, picture: Path | None, mesh: Path | None, error: float | None,
    threads: int | None, max_seconds: float | None, max_memory: str | None, folder: Path | None,
    obstacles: tuple[Path, ...], tiles: int | None, workers: int | None, scheduler: str | None, verbose: bool,
    as_json: bool,
) -> None:  # fmt: skip
    """Compute the boundary of the forbidden space.

    Trims every contact patch. SCENE is JSON, GeoJSON, WKT, SVG, DXF or another format that cfree convert reads. Discs,
    stadiums and grown polygons stay as they are; polygons within --tolerance replace other curves. If a
    limit stops the work, the part done so far is written, marked as incomplete, and the exit code is 3. With --folder
    the boundary is computed tile by tile, of any size, by any number of processes; the same command resumes an
    interrupted run.
    """
    with one_line_faults():
        if folder is not None:
            return _boundary_in_folder(scene, folder, as_json, obstacles, tiles, workers, scheduler)
        tile_options = "obstacles", "tiles", "workers", "scheduler"
        options.refuse("only for a boundary in tiles", *tile_options, remedy="these need --folder")
        if error is not None and not (mesh and 0 < error < math.inf):
            raise ValueError(f"--error: {error}; give a length above 0, with --mesh")
        written = check_outputs(scene, {"boundary": output, "mesh": mesh, "picture": picture})
        if is_archive(scene):
            options.refuse(options.COMPUTED, "max_seconds", "max_memory", *(() if mesh else ("threads",)))
        most = None if max_memory is None else read_size(max_memory)
        result = computed(read_source(scene), threads, max_seconds, most)
        if output:
            from cfree.formats.boundaries.boundary_file import save_boundary

            with bar("writing"):
                save_boundary(result, output)
        if not result.complete:
            saved = f"; the part done is in {output}" if output else ""
            fail(
                f"incomplete: {result.trimmed.sum():,} of {counted(result.stats.patches, 'patch')} trimmed{saved}",
                INCOMPLETE,
            )
        if mesh:
            from cfree.forbidden.record import glue_by

            with bar("surfaces"):
                glue_by(threads or os.cpu_count() or 1, result)
        _draw_boundary(result, mesh, error, picture)
        from cfree.cli.report import boundary_facts, boundary_rows, print_result

        rows = boundary_facts(result) if as_json else boundary_rows(result, verbose=verbose)
        print_result(result.scene.name or str(scene), scene, rows, written, as_json)


def _boundary_in_folder(
    scene: Path, folder: Path, as_json: bool, obstacles: tuple[Path, ...], tiles: int | None, workers: int | None,
    scheduler: str | None,
) -> None:  # fmt: skip
    from cfree.cli import folders
    from cfree.cli.report import print_result

    others = "output", "picture", "mesh", "error", "threads", "max_seconds", "max_memory"
    options.refuse("not with --folder", *others)
    result = folders.make(scene, obstacles, folder, tiles, workers, scheduler)
    print_result(result.head.name or str(scene), scene, folders.facts(result, for_machines=as_json), {}, as_json)


def _draw_boundary(result: Boundary, mesh: Path | None, error: float | None, picture: Path | None) -> None:
    """Write a mesh and a figure of it, if wanted."""
    if mesh:
        from cfree.formats.boundaries.mesh_file import save_mesh
        from cfree.scene.scene import robot_radius

        with bar("mesh"):
            save_mesh(result.mesh(robot_radius(result.scene) / 100 if error is None else error), mesh)
    if picture:
        from cfree.plot.boundary import plot_overview, save_figure

        with bar("picture"):
            save_figure(plot_overview(result), picture)
