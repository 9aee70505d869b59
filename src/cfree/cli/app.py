"""The command line: parse, call, print. Everything heavy is imported where it is used, so that help is quick."""

from __future__ import annotations

import math
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cfree.cli.faults import INCOMPLETE, REFUTED, fail, one_line_faults, own_exit_codes
from cfree.cli.files import bar, boundary_of, check_outputs, planner_of
from cfree.cli.options import (
    JsonOption,
    MemoryOption,
    PictureOption,
    SceneArgument,
    SecondsOption,
    SourceArgument,
    ThreadsOption,
)
from cfree.cli.terminal import print_json, printable
from cfree.cli.values import read_angle, read_numbers, read_objective, read_pixels, read_pose, read_seconds, read_size
from cfree.formats.archive import is_archive

if TYPE_CHECKING:
    from cfree.forbidden.boundary import Boundary

app = typer.Typer(
    name="cfree",
    no_args_is_help=True,
    rich_markup_mode="markdown",
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="The exact configuration space of a planar robot that translates and rotates among polygons.",
    epilog="Example: `cfree boundary examples/scenes/flat.json --picture flat.png`",
)


def main() -> None:
    """Run the command ``cfree``."""
    with own_exit_codes():
        app(prog_name="cfree")


def _print_version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        print(f"cfree {version('cfree')}")
        raise typer.Exit


@app.callback()
def _global_options(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    pass


@app.command(epilog="Examples: `cfree check scene.json`; `cfree check scene.json --json | jq .patches`")
def check(scene: SceneArgument, as_json: JsonOption = False) -> None:
    """Validate a scene and describe it: vertices, pieces, patches to expect, start and goal."""
    with one_line_faults():
        from cfree.cli.describe import describe
        from cfree.formats.scene_file import load_scene

        with bar("reading"):
            given = load_scene(scene)
        with bar("counting"):
            facts = {"file": str(scene)} | describe(given)
        if as_json:
            print_json(facts)
        else:
            from cfree.cli.report import print_scene

            print_scene(facts)


@app.command(
    epilog="Examples: `cfree boundary scene.json --picture scene.png`; "
    "`cfree boundary scene.json -o scene.npz --mesh scene.glb --threads 1`"
)
def boundary(
    scene: SourceArgument,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="FILE", help="Write the boundary, all of it.", show_default=False),
    ] = None,
    picture: PictureOption = None,
    mesh: Annotated[
        Path | None,
        typer.Option("--mesh", metavar="GLB", help="Write a mesh: .glb, .ply, .obj or .stl.", show_default=False),
    ] = None,
    error: Annotated[
        float | None,
        typer.Option(
            "--error",
            metavar="E",
            help="Greatest distance of the mesh to the boundary.",
            show_default="robot's radius / 100",
        ),
    ] = None,
    threads: ThreadsOption = None,
    max_seconds: SecondsOption = None,
    max_memory: MemoryOption = None,
    as_json: JsonOption = False,
) -> None:
    """Compute the boundary of the forbidden space: every contact patch, trimmed.

    If a limit stops it, what was done so far is written, marked as incomplete, and the exit code is 3.
    """
    with one_line_faults():
        if error is not None and not (mesh and 0 < error < math.inf):
            raise ValueError(f"--error: {error}; give a length above 0, with --mesh")
        written = check_outputs(scene, {"boundary": output, "mesh": mesh, "picture": picture})
        result = boundary_of(scene, threads, max_seconds, None if max_memory is None else read_size(max_memory))
        if output:
            from cfree.formats.boundary_file import save_boundary

            save_boundary(result, output)
        if not result.complete:
            kept = f"; what was done is in {output}" if output else ""
            fail(f"incomplete: {result.trimmed.sum():,} of {result.stats.patches:,} patches trimmed{kept}", INCOMPLETE)
        _draw_boundary(result, mesh, error, picture)
        from cfree.cli.report import boundary_facts, boundary_rows

        rows = boundary_facts(result) if as_json else boundary_rows(result)
        print_result(result.scene.name or str(scene), scene, rows, written, as_json)


def _draw_boundary(result: Boundary, mesh: Path | None, error: float | None, picture: Path | None) -> None:
    """A mesh and a figure of it, if they are asked for."""
    if mesh:
        from cfree.formats.mesh_file import save_mesh
        from cfree.scene.scene import robot_radius

        save_mesh(result.mesh(robot_radius(result.scene) / 100 if error is None else error), mesh)
    if picture:
        from cfree.plot.boundary import plot_overview, save_figure

        save_figure(plot_overview(result), picture)


@app.command(
    epilog="Examples: `cfree plan scene.json`; "
    "`cfree plan scene.json --start 0,0,90deg --goal 5,1/3,tau:1/2 -o way.json --picture way.png`; "
    "`cfree plan scene.json -o way.csv --improve 2s`. "
    "Exit code 0: a path; 1: proved impossible; 2: bad input; 3: a limit, or proved but for paths that touch."
)
def plan(
    scene: SourceArgument,
    start: Annotated[
        str | None,
        typer.Option(metavar="X,Y,THETA", help='As "1,1/2,30deg"; radians, or "tau:1/3".', show_default="the scene's"),
    ] = None,
    goal: Annotated[str | None, typer.Option(metavar="X,Y,THETA", help="The same.", show_default="the scene's")] = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="FILE", help="Write the answer: path or proof.", show_default=False),
    ] = None,
    form: Annotated[
        str | None,
        typer.Option(
            "--format",
            metavar="FORM",
            help="Of that file: json, exact; or of a path sampled poses: csv, geojson, ros.",
            show_default="by the file's name, else json",
        ),
    ] = None,
    improve: Annotated[
        str | None,
        typer.Option(
            metavar="TIME", help='How long to improve a path: "2s" or "500ms"; 0 for the first.', show_default="briefly"
        ),
    ] = None,
    objective: Annotated[str, typer.Option(metavar="WORD", help='"short", or "clear": far from obstacles.')] = "short",
    picture: PictureOption = None,
    film: Annotated[
        Path | None, typer.Option("--film", metavar="FILE", help="Of a path: .mp4 or .gif.", show_default=False)
    ] = None,
    miss: Annotated[
        bool, typer.Option("--nearest-miss", help="Of a proof: by how much, and where. Takes a dozen times as long.")
    ] = False,
    max_seconds: SecondsOption = None,
    as_json: JsonOption = False,
) -> None:
    """Find a path from start to goal, each motion of it proved free, or prove that there is none."""
    with one_line_faults():
        from cfree.cli.answering import Answering
        from cfree.formats.answer_file import form_of

        written = check_outputs(scene, {"answer": output, "picture": picture, "film": film})
        kind = form_of(output, form) if output else "json"
        seconds = None if improve is None else read_seconds(improve)
        wanted = read_objective(objective)
        ends = read_pose(start, "--start"), read_pose(goal, "--goal")
        found = Answering.of(planner_of(scene, max_seconds), ends, written, seconds=seconds, objective=wanted)
        if output:
            found.write(output, kind)
        if picture:
            found.draw(picture)
        if film:
            found.film(film)
        rows = found.rows(for_machines=as_json, nearest_miss=miss)
        print_result(found.planner.scene.name or str(scene), scene, rows, written, as_json)
    if found.exit_code:
        raise typer.Exit(found.exit_code)


@app.command(
    "slice",
    epilog="Examples: `cfree slice scene.json --theta 30deg --picture slice.png`; "
    "`cfree slice scene.npz --theta tau:1/3 -o slice.geojson`",
)
def cut(
    scene: SourceArgument,
    theta: Annotated[
        str, typer.Option(metavar="ANGLE", help='"30deg", "0.5" radians, or "tau:1/3".', show_default=False)
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", metavar="GEOJSON", help="Write region and contact segments.", show_default=False
        ),
    ] = None,
    picture: PictureOption = None,
    threads: ThreadsOption = None,
    as_json: JsonOption = False,
) -> None:
    """Cut the forbidden space at one orientation of the robot."""
    with one_line_faults():
        angle = read_angle(theta)
        written = check_outputs(scene, {"geojson": output, "picture": picture})
        from cfree.cli.describe import describe_slice

        result = boundary_of(scene, threads)
        found = result.slice(angle)
        if output:
            from cfree.formats.slice_geojson import save_slice

            save_slice(found, output)
        if picture:
            from cfree.plot.boundary import plot_slice, save_figure

            save_figure(plot_slice(found).figure, picture)
        print_result(f"slice of {result.scene.name or scene}", scene, describe_slice(found), written, as_json)


@app.command(
    epilog="Examples: `cfree film scene.json -o film.mp4`; "
    "`cfree film examples/scenes/paper_fig9.json examples/scenes/five_convex.json -o paper.mp4 --seconds 60`; "
    "`cfree film scene.json -o path.gif --storyboard path --seconds 5 --fps 10`"
)
def film(
    scenes: Annotated[
        list[Path],
        typer.Argument(
            metavar="SCENE...", help="Scene files, or boundaries, shown one after the other.", show_default=False
        ),
    ],
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="FILE", help="The film: .mp4 or .gif.", show_default=False)
    ],
    storyboard: Annotated[
        str,
        typer.Option(metavar="NAME", help='"paper": slices, a helix, patches, all of the boundary, a path; or "path".'),
    ] = "paper",
    seconds: Annotated[float, typer.Option(metavar="S", help="Length of the film.")] = 30.0,
    fps: Annotated[int, typer.Option(metavar="N", help="Frames a second.")] = 25,
    size: Annotated[
        str | None,
        typer.Option(metavar="WxH", help="Pixels, even numbers.", show_default="1280x720; 640x360 for a GIF"),
    ] = None,
) -> None:
    """Make a film: the robot among the obstacles, and the point it is in the configuration space."""
    with one_line_faults():
        from cfree.film import save_film
        from cfree.film.reel import check_options

        for scene in scenes:
            written = check_outputs(scene, {"film": output})
        pixels = read_pixels(size or ("640x360" if output.suffix.lower() == ".gif" else "1280x720"))
        check_options(len(scenes), seconds, fps, pixels, storyboard)
        found = [boundary_of(scene, None) for scene in scenes]
        with bar("film") as progress:
            save_film(found, output, seconds=seconds, fps=fps, size=pixels, storyboard=storyboard, progress=progress)
        from cfree.cli.report import print_rows

        rows: dict[str, Any] = {"frames": round(seconds * fps), "size": "x".join(map(str, pixels))}
        print_rows(", ".join(map(str, scenes)), rows, written)


@app.command(
    epilog="Examples: `cfree verify scene.json scene.npz`; `cfree verify scene.json answer.json`. "
    "Exit code 0: verified; 1: refuted; 2: a file that cannot be read."
)
def verify(
    scene: SceneArgument,
    file: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help="A boundary (`cfree boundary -o`), or an answer: a path or a proof.",
            show_default=False,
        ),
    ],
    sample: Annotated[
        int | None,
        typer.Option(metavar="N", min=0, help="Of a boundary: check N trapezoids, no sides.", show_default="all"),
    ] = None,
    slices: Annotated[int, typer.Option(metavar="N", min=0, help="Of a boundary: orientations to redo.")] = 12,
    seed: Annotated[int, typer.Option(metavar="N", help="Of the random choices.")] = 0,
    as_json: JsonOption = False,
) -> None:
    """Check a boundary or an answer by independent exact code, and say what is proved and what is sampled."""
    with one_line_faults():
        from cfree.formats.scene_file import load_scene
        from cfree.verify.answers import answer as verified_answer
        from cfree.verify.driver import boundary as verified_boundary

        given = load_scene(scene)
        with bar("verify") as progress:
            if is_archive(file):
                options = {"sample": sample, "slices": slices, "seed": seed}
                result = verified_boundary(file, given, progress=progress, **options)  # type: ignore[arg-type]
            else:
                result = verified_answer(given, file, progress=progress)
        if as_json:
            print_json({"file": str(file), "verified": result.verified, **asdict(result)})
        else:
            from cfree.cli.report import print_verification

            print_verification(str(file), result)
    if not result.verified:
        raise typer.Exit(REFUTED)


@app.command(epilog="Examples: `cfree figures -o pictures`; `cfree figures -o pictures --only 7,9 --format svg --safe`")
def figures(
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="DIR", help="Where to write, made if missing.", show_default=False)
    ],
    only: Annotated[
        str | None, typer.Option(metavar="NUMBERS", help='Some of them: "7" or "7,9".', show_default="all")
    ] = None,
    formats: Annotated[str, typer.Option("--format", metavar="FORMATS", help="Of svg, pdf and png.")] = "svg,pdf,png",
    safe: Annotated[bool, typer.Option("--safe", help="Colours for readers who do not tell red from green.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Draw the figures of the paper, from computed data, and three more."""
    with one_line_faults():
        from cfree.figures import FIGURES, draw_all

        numbers = None if only is None else read_numbers(only)
        with bar("figures") as progress:
            files = draw_all(output, only=numbers, formats=formats.split(","), safe=safe, progress=progress)
        if as_json:
            print_json({"files": [str(file) for file in files]})
        else:
            for entry in FIGURES:
                written = [str(file) for file in files if file.stem == entry.stem]
                if written:
                    print(printable(f"figure {entry.number}: {entry.caption} {' '.join(written)}"))


def print_result(title: str, source: Path, rows: dict[str, Any], files: dict[str, str], as_json: bool) -> None:
    """What was found, and the files written: on a terminal, or for machines."""
    if as_json:
        print_json({"file": str(source), **rows, "files": files})
    else:
        from cfree.cli.report import print_rows

        print_rows(title, rows, files)
