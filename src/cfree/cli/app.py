"""The command line: parse, call, print. Heavy modules are imported in the commands, so that help is quick."""

from __future__ import annotations

import math
import os
import sys
from contextlib import nullcontext, redirect_stdout
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from cfree.cli import options
from cfree.cli.faults import INCOMPLETE, REFUTED, fail, one_line_faults, own_exit_codes
from cfree.cli.files import answer_for, bar, check_outputs, computed, planner_of, read_source
from cfree.cli.options import FILE, Word, examples, file_option
from cfree.cli.scenes import check, convert
from cfree.cli.terminal import print_json, printable
from cfree.cli.values import (
    read_angle,
    read_goals,
    read_length,
    read_numbers,
    read_pixels,
    read_pose,
    read_preferences,
    read_seconds,
    read_size,
)
from cfree.formats.text.archive import is_archive
from cfree.words import counted

if TYPE_CHECKING:
    from cfree.film import Storyboard
    from cfree.forbidden.boundary import Boundary
    from cfree.formats.answers.answer_file import Form
    from cfree.paths.path import Objective
    from cfree.plot.rendered import Renderer
    from cfree.verify.result import Verification


def main() -> None:
    """Run the command ``cfree``."""
    with own_exit_codes():
        app(prog_name="cfree")


@click.group(
    no_args_is_help=True,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog=examples(
        "cfree boundary examples/scenes/flat.json --picture flat.png",
        'eval "$(_CFREE_COMPLETE=bash_source cfree)"  # completion; also zsh_source, fish_source',
    ),
)
@click.version_option(package_name="cfree", message="cfree %(version)s", help="Print the version and exit.")
def app() -> None:
    """Compute the exact configuration space of a planar robot that translates and rotates among polygons."""


app.add_command(check)
app.add_command(convert)


@app.command(
    epilog=examples(
        "cfree boundary scene.json --picture scene.png",
        "cfree boundary scene.json -o scene.npz --mesh scene.glb --threads 1",
        "cfree boundary robot.json --obstacles city.geojsonl --folder city --workers 4",
    )
)
@options.scene
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
@file_option("--folder", metavar="DIR", help="Compute tile by tile, with cells, into a folder; or resume there.")
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

    Trims every contact patch. SCENE is JSON, GeoJSON, WKT, SVG, DXF or another format that cfree convert reads. If a
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
            _refuse_limits("max_seconds", "max_memory", *(() if mesh else ("threads",)))
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
        from cfree.cli.report import boundary_facts, boundary_rows

        rows = boundary_facts(result) if as_json else boundary_rows(result, verbose=verbose)
        print_result(result.scene.name or str(scene), scene, rows, written, as_json)


def _boundary_in_folder(
    scene: Path, folder: Path, as_json: bool, obstacles: tuple[Path, ...], tiles: int | None, workers: int | None,
    scheduler: str | None,
) -> None:  # fmt: skip
    from cfree.cli import folders

    others = "output", "picture", "mesh", "error", "threads", "max_seconds", "max_memory"
    options.refuse("not with --folder", *others)
    result = folders.make(scene, obstacles, folder, tiles, workers, scheduler)
    print_result(result.head.name or str(scene), scene, folders.facts(result, for_machines=as_json), {}, as_json)


def _refuse_limits(*names: str) -> None:
    options.refuse("only for a computation, and this boundary is already computed", *names)


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


@app.command(
    epilog=examples(
        "cfree plan scene.json",
        "cfree plan scene.json --start 0,0,90deg --goal 5,1/3,tau:1/2 -o way.json --picture way.png",
        "cfree plan scene.json -o way.csv --improve 2s",
        "cfree plan scene.json -o - --format csv --step 0.05 --speed 0.5 > way.csv",
        "cfree plan scene.json --clearance 0.3",
        "cfree plan scene.json --goal 5,3 --nearest-free",
        "cfree plan scene.json --prefer sideways=5,turning=2 --picture way.png",
        "cfree plan scene.json --what-if --picture blockers.png",
        "cfree plan scene.json --goal 5,3 --goal 7,1,90deg",
    )
)
@options.scene
@click.option(
    "--start",
    metavar="X,Y,THETA",
    help='Start at "1,1/2,30deg"; theta also "0.5rad", "tau:1/3".',
    show_default="the scene's",
)
@click.option(
    "--goal",
    metavar="X,Y[,THETA]",
    multiple=True,
    help="End there; X,Y allows any orientation. Repeat to allow any of several goals.",
    show_default="the scene's",
)
@file_option("--output", "-o", metavar="FILE", help="Write the answer, path or proof; - is standard output.")
@click.option(
    "--format",
    "form",
    type=Word(["json", "csv", "ros", "geojson"]),
    metavar="FORM",
    help="Choose the form of -o: json, exact; or sampled poses of a path: csv, geojson, ros.",
    show_default="by the file's name, else json",
)
@click.option(
    "--step",
    metavar="LENGTH",
    help="Limit the distance between sampled poses, in scene units.",
    show_default="robot's radius / 20",
)
@click.option("--turn", metavar="ANGLE", help="Limit the rotation between sampled poses.", show_default="5deg")
@click.option(
    "--speed",
    metavar="SPEED",
    help="Limit the speed of every point of the robot, in scene units a second; adds times to sampled poses.",
)
@click.option("--clearance", metavar="LENGTH", help="Keep this distance from obstacles and workspace, in scene units.")
@click.option(
    "--nearest-free", is_flag=True, help="Move a start or goal that is not free to the nearest free pose found."
)
@click.option(
    "--improve",
    metavar="TIME",
    help='Improve the path for this time: "2s" or "500ms"; 0 gives the first path.',
    show_default="a fixed number of attempts",
)
@click.option(
    "--objective",
    type=Word(["balanced", "short", "clear"]),
    metavar="WORD",
    default="balanced",
    show_default=True,
    help='Prefer paths that are "balanced", "short", or "clear": as far from obstacles as possible.',
)
@click.option(
    "--prefer",
    metavar="FACTORS",
    help='Set costs relative to driving ahead, as "sideways=5,backward=2,turning=3"; the answer lists such motions.',
)
@options.picture
@file_option("--film", metavar="FILE", help="Write a film of the path or the proof: .mp4 or .gif.")
@click.option(
    "--nearest-miss",
    "miss",
    is_flag=True,
    help="If there is no path: find how much the robot must shrink, and where. About 12 times slower.",
)
@click.option(
    "--what-if",
    is_flag=True,
    help="If there is no path: find single obstacles whose removal opens one; --picture shows them.",
)
@click.option(
    "--tolerance",
    type=float,
    metavar="E",
    help="Limit the refinement of polygons for round shapes: their least error, in scene units.",
    show_default="refined until decided",
)
@file_option("--part", metavar="JSON", help="Write the scene with the needed obstacles; if SCENE is a folder.")
@options.max_seconds
@options.as_json
def plan(
    scene: Path, start: str | None, goal: tuple[str, ...], output: Path | None, form: Form | None, step: str | None,
    turn: str | None, speed: str | None, clearance: str | None, nearest_free: bool, improve: str | None,
    objective: Objective, prefer: str | None, picture: Path | None, film: Path | None, miss: bool, what_if: bool,
    tolerance: float | None, part: Path | None, max_seconds: float | None, as_json: bool,
) -> None:  # fmt: skip
    """Find a path from start to goal, or prove that there is none.

    Each motion is proved free. SCENE is JSON, GeoJSON, WKT, SVG, DXF or another format that cfree convert reads; or a
    boundary written by cfree boundary -o; or a folder written by cfree boundary --folder, of which only tiles near the
    path are read. Exit code 0: a path; 1: proved impossible; 2: bad input; 3: undecided, by a limit, because only paths
    that touch may exist, because the clearance is too near to the largest, or because round shapes almost touch.
    """
    with one_line_faults():
        from cfree.cli.answering import Answering, Sampling

        printed = str(output) == "-"
        if output is None:
            options.refuse(
                "only for the file that -o writes", "form", remedy="give -o FILE, or -o - for standard output"
            )
        if not scene.is_dir():
            options.refuse("only for a folder written by cfree boundary --folder", "part")
        if printed and as_json:
            raise ValueError("-o -: --json prints to standard output as well; leave one of them out")
        written = check_outputs(
            scene, {"answer": None if printed else output, "picture": picture, "film": film, "part": part}
        )
        poses = Sampling.of(output, form, step, turn, speed)
        seconds = None if improve is None else read_seconds(improve)
        if seconds == 0 and objective != "clear":
            options.refuse("only for a path that is improved, and --improve 0 gives the first", "objective")
        ends = read_pose(start, "--start"), read_goals(goal)
        room = None if clearance is None else read_length(clearance, "--clearance")
        how: dict[str, Any] = {"clearance": room, "improve": seconds, "objective": objective}
        planner: Any = planner_of(scene, max_seconds, read_preferences(prefer), tolerance)
        if (miss or what_if) and planner.scene.curved:
            raise ValueError(
                "--nearest-miss, --what-if: only for polygons; convert round shapes by cfree convert --inner"
            )
        if nearest_free and scene.is_dir():
            raise ValueError("--nearest-free: not in a folder; give the scene itself")
        answering = Answering.of(planner, ends, written, how, nearest_free=nearest_free)
        if output:
            answering.write(output, poses)
        if picture:
            answering.draw(picture, what_if=what_if)
        if film:
            answering.film(film)
        if part:
            from cfree.formats.scene_file import save_scene

            save_scene(answering.planner.scene, part)
        rows = answering.rows(for_machines=as_json, nearest_miss=miss, what_if=what_if)
        if scene.is_dir():
            rows["tiles read"] = planner.sharded.tiles_read
        with redirect_stdout(sys.stderr) if printed else nullcontext():
            print_result(answering.planner.scene.name or str(scene), scene, rows, answering.files, as_json)
    if answering.exit_code:
        raise click.exceptions.Exit(answering.exit_code)


@app.command(
    "slice",
    epilog=examples(
        "cfree slice scene.json --theta 30deg --picture slice.png",
        "cfree slice scene.npz --theta tau:1/3 -o slice.geojson",
    ),
)
@options.scene
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
    boundary -o.
    """
    with one_line_faults():
        angle = read_angle(theta, "--theta")
        written = check_outputs(scene, {"geojson": output, "picture": picture})
        from cfree.cli.describe import describe_slice

        if is_archive(scene):
            _refuse_limits("threads")
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


@app.command(
    epilog=examples(
        "cfree film scene.json -o film.mp4",
        "cfree film scene.json answer.json -o way.gif",
        "cfree film paper_fig9.json five_convex.json -o paper.mp4 --seconds 60",
        "cfree film scene.json -o path.gif --storyboard path --seconds 5 --fps 10",
        "cfree film scene.json -o turn.gif --storyboard turntable",
    )
)
@click.argument("scenes", type=FILE, metavar="SCENE... [ANSWER]", nargs=-1, required=True)
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


@app.command(
    epilog=examples("cfree view scene.json", "cfree view scene.json answer.json --html page.html --no-browser")
)
@options.scene
@click.argument("answer", type=FILE, required=False)
@file_option("--html", metavar="HTML", help="Write the page: .html; it needs no other file and no server.")
@click.option("--browser/--no-browser", help="Open the page in the browser, or not.", default=True, show_default=True)
def view(scene: Path, answer: Path | None, html: Path | None, browser: bool) -> None:
    """Show a scene in the browser, to be dragged and turned.

    Shows its configuration space beside it, exact like all answers. ANSWER is a path or a proof written by cfree plan
    -o for this scene; an answer for another scene is refused. SCENE is JSON, GeoJSON, WKT, SVG, DXF or another format
    that cfree convert reads.
    """
    with one_line_faults():
        from cfree.formats.scene_file import load_scene
        from cfree.planning.goals import AllSeparated
        from cfree.viewer.browser import view as show

        for source in (scene, answer):
            if html and source:
                check_outputs(source, {"page": html})
        with bar("reading"):
            loaded = load_scene(scene)
            shown = answer_for(loaded, answer) if answer else None
        if isinstance(shown, AllSeparated):
            raise ValueError(f"{answer}: proofs for several goals, and the page shows one; plan with one goal")
        print(printable(str(show(loaded, shown, html=html, browser=browser))))


@app.command(
    epilog=examples(
        "cfree verify scene.json scene.npz",
        "cfree verify scene.json answer.json",
        "cfree verify scene.json scene.npz --deep",
        "cfree verify city --sample 100",
    )
)
@options.scene
@click.argument("file", type=FILE, required=False)
@click.option(
    "--sample", type=click.IntRange(min=0), metavar="N", help="Check N random trapezoids of a boundary, no sides.",
    show_default="all",
)  # fmt: skip
@click.option(
    "--slices", type=click.IntRange(min=0), metavar="N", help="Recompute a boundary's slices at N random orientations.",
    default=12, show_default=True,
)  # fmt: skip
@click.option("--seed", type=int, metavar="N", help="Seed the random choices.", default=0, show_default=True)
@click.option(
    "--deep", is_flag=True,
    help="Count a boundary's Euler numbers by slices and by the degree of the Gauss map; for small scenes.",
)  # fmt: skip
@options.workers
@options.scheduler
@options.as_json
def verify(
    scene: Path, file: Path | None, sample: int | None, slices: int, seed: int, deep: bool, workers: int | None,
    scheduler: str | None, as_json: bool,
) -> None:  # fmt: skip
    """Check a boundary or an answer by independent exact code.

    The result distinguishes proved from sampled checks. FILE is a boundary written by cfree boundary -o, or an answer:
    a path or a proof. SCENE may be a folder written by cfree boundary --folder: then each shard and its borders are
    checked (--sample counts for each tile), or FILE, a path in it. Exit code 0: verified; 1: refuted; 2: a file that
    cannot be read.
    """
    with one_line_faults():
        if deep and (file is None or scene.is_dir() or not is_archive(file)):
            raise ValueError("--deep: is for a boundary in one file, as cfree boundary -o writes it; leave it out")
        if scene.is_dir():
            from cfree.cli import folders

            options.refuse("only for a boundary in one file", "slices")
            if file is not None:
                shard_options = "sample", "seed", "workers", "scheduler"
                options.refuse("only for shards, and an answer has none", *shard_options)
            elif sample is None:
                options.refuse("only for the random choices of --sample", "seed", remedy="give --sample as well")
            with folders.cluster(workers, scheduler) as client:
                result = folders.verified(scene, file, sample, seed, client)
            return _print_verified(result, file or scene, as_json)
        if file is None:
            raise ValueError("FILE: there is none; give a boundary or an answer")
        options.refuse("only for shards in a folder", "workers", "scheduler")
        if not is_archive(file):
            options.refuse("only for a boundary", "sample", "slices", "seed")
        elif sample is None and slices == 0:
            options.refuse("only for random choices, and there are none", "seed")
        from cfree.formats.scene_file import load_scene
        from cfree.verify.answers import answer as verified_answer
        from cfree.verify.driver import boundary as verified_boundary

        loaded = load_scene(scene)
        with bar("verify") as progress:
            if is_archive(file):
                result = verified_boundary(
                    file, loaded, sample=sample, slices=slices, seed=seed, deep=deep, progress=progress
                )
            else:
                result = verified_answer(loaded, file, progress=progress)
        _print_verified(result, file, as_json)


def _print_verified(result: Verification, file: Path, as_json: bool) -> None:
    if as_json:
        print_json({"file": str(file), "verified": result.verified, **asdict(result)})
    else:
        from cfree.cli.report import print_verification

        print_verification(str(file), result)
    if not result.verified:
        raise click.exceptions.Exit(REFUTED)


@app.command(epilog=examples("cfree figures -o pictures", "cfree figures -o pictures --only 7,9 --format svg"))
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

    Draws figures 1 to 10 of the paper, and ten more.
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


def print_result(title: str, source: Path, rows: dict[str, Any], files: dict[str, str], as_json: bool) -> None:
    """Print the result and the files written: as a table, or as JSON."""
    if as_json:
        print_json({"file": str(source), **rows, "files": files})
    else:
        from cfree.cli.report import print_rows

        print_rows(title, rows, files)
