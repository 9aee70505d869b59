"""The command line: parse, call, print. Everything heavy is imported where it is used, so that help is quick."""

from __future__ import annotations

import errno
import math
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cfree.cli.faults import INCOMPLETE, REFUTED, fail, one_line_faults, own_exit_codes
from cfree.cli.terminal import json_text, printable
from cfree.cli.values import read_angle, read_numbers, read_pixels, read_pose, read_seconds, read_size

if TYPE_CHECKING:
    from cfree.forbidden.boundary import Boundary
    from cfree.paths.path import Path as Motions
    from cfree.planning.planner import Planner
    from cfree.planning.separation import Separated

app = typer.Typer(
    name="cfree",
    no_args_is_help=True,
    rich_markup_mode="markdown",
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="The exact configuration space of a planar robot that translates and rotates among polygons.",
    epilog="Example: `cfree boundary examples/scenes/flat.json --picture flat.png`",
)

SceneArgument = Annotated[
    Path, typer.Argument(metavar="SCENE", help="Scene file: JSON, GeoJSON or WKT.", show_default=False)
]
SourceArgument = Annotated[
    Path,
    typer.Argument(
        metavar="SCENE", help="Scene file, or a boundary written by `cfree boundary -o`.", show_default=False
    ),
]
PictureOption = Annotated[
    Path | None,
    typer.Option("--picture", metavar="PNG", help="Write a figure: .png, .svg, .pdf ...", show_default=False),
]
ThreadsOption = Annotated[
    int | None, typer.Option("--threads", metavar="N", min=1, help="Threads to use.", show_default="all cores")
]
SecondsOption = Annotated[
    float | None,
    typer.Option(
        "--max-seconds", metavar="S", min=0, help="Stop trimming after S seconds, incomplete.", show_default="no limit"
    ),
]
MemoryOption = Annotated[
    str | None,
    typer.Option(
        "--max-memory", metavar="SIZE", help='Stop at "500MB" or "4GB" of memory, incomplete.', show_default="no limit"
    ),
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON, for machines.")]


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

        with _bar("reading"):
            given = load_scene(scene)
        with _bar("counting"):
            facts = {"file": str(scene)} | describe(given)
        if as_json:
            _print_json(facts)
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
        written = _check_outputs(scene, {"boundary": output, "mesh": mesh, "picture": picture})
        result = _boundary_of(scene, threads, max_seconds, None if max_memory is None else read_size(max_memory))
        if output:
            from cfree.formats.boundary_file import save_boundary

            save_boundary(result, output)
        if not result.complete:
            kept = f"; what was done is in {output}" if output else ""
            fail(f"incomplete: {result.trimmed.sum():,} of {result.stats.patches:,} patches trimmed{kept}", INCOMPLETE)
        if mesh:
            from cfree.formats.mesh_file import save_mesh
            from cfree.scene.scene import robot_radius

            save_mesh(result.mesh(robot_radius(result.scene) / 100 if error is None else error), mesh)
        if picture:
            from cfree.plot.boundary import plot_overview, save_figure

            save_figure(plot_overview(result), picture)
        if as_json:
            facts = asdict(result.stats) | {"isolated": len(result.isolated)}
            _print_json({"file": str(scene), **facts, "files": written})
        else:
            from cfree.cli.report import boundary_rows, print_rows

            print_rows(result.scene.name or str(scene), boundary_rows(result), written)


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
        from cfree.cli.report import answer_facts, answer_rows, print_rows
        from cfree.errors import IncompleteError
        from cfree.formats.answer_file import form_of, save_path, save_separation
        from cfree.paths.path import Path as Motions
        from cfree.scene.scene import required

        written = _check_outputs(scene, {"answer": output, "picture": picture, "film": film})
        kind = form_of(output, form) if output else "json"
        seconds = None if improve is None else read_seconds(improve)
        if objective not in ("short", "clear"):
            raise ValueError(f'--objective: {objective!r}; give "short" or "clear"')
        ends = [read_pose(text, name) for text, name in ((start, "--start"), (goal, "--goal"))]
        planner = _planner_of(scene, max_seconds)
        begin, end = required(planner.scene, *ends)
        try:
            answer = planner.plan(begin, end, improve=seconds, objective=objective)  # type: ignore[arg-type]
        except IncompleteError as error:
            fail(str(error), INCOMPLETE)
        if output:
            if isinstance(answer, Motions):
                save_path(answer, output, step=planner.angle_scale / 20, scene=planner.scene, form=kind)
            elif kind == "json":
                save_separation(answer, output)
            else:
                _leave_out(written, "answer", f"there is no path to write as {kind}; a proof is written as .json")
        if picture:
            from cfree.plot.answer import picture as drawn
            from cfree.plot.boundary import save_figure

            space = planner.free_space
            with _bar("picture"):
                save_figure(drawn(answer, planner.scene, space.boundary), picture)
        if film and isinstance(answer, Motions):
            from cfree.film import film_path

            with _bar("film") as progress:
                film_path(answer, planner.scene, film, progress=progress)
        elif film:
            _leave_out(written, "film", "there is no path to film")
        with _bar("least clearance"):
            facts = answer_facts(answer, planner.scene) if as_json else answer_rows(answer, planner.scene)
        if miss and not isinstance(answer, Motions):
            from cfree.analysis.margins import nearest_miss

            with _bar("nearest miss") as progress:
                found = nearest_miss(planner.scene, begin, end, progress=progress)
            facts["nearest miss"] = str(found) if found else "no smaller robot gets there either"
        if as_json:
            _print_json({"file": str(scene), **facts, "files": written})
        else:
            print_rows(planner.scene.name or str(scene), facts, written)
    if code := _exit_code(answer):
        raise typer.Exit(code)


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
        written = _check_outputs(scene, {"geojson": output, "picture": picture})
        from cfree.cli.describe import describe_slice

        result = _boundary_of(scene, threads)
        found = result.slice(angle)
        if output:
            from cfree.formats.slice_geojson import save_slice

            save_slice(found, output)
        if picture:
            from cfree.plot.boundary import plot_slice, save_figure

            save_figure(plot_slice(found).figure, picture)
        facts = describe_slice(found)
        if as_json:
            _print_json({"file": str(scene), **facts, "files": written})
        else:
            from cfree.cli.report import print_rows

            print_rows(f"slice of {result.scene.name or scene}", facts, written)


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
            written = _check_outputs(scene, {"film": output})
        pixels = read_pixels(size or ("640x360" if output.suffix.lower() == ".gif" else "1280x720"))
        check_options(len(scenes), seconds, fps, pixels, storyboard)
        found = [_boundary_of(scene, None) for scene in scenes]
        with _bar("film") as progress:
            save_film(found, output, seconds=seconds, fps=fps, size=pixels, storyboard=storyboard, progress=progress)
        from cfree.cli.report import print_rows

        print_rows(
            ", ".join(map(str, scenes)), {"frames": round(seconds * fps), "size": "x".join(map(str, pixels))}, written
        )


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
        with _bar("verify") as progress:
            if _is_archive(file):
                options = {"sample": sample, "slices": slices, "seed": seed}
                result = verified_boundary(file, given, progress=progress, **options)  # type: ignore[arg-type]
            else:
                result = verified_answer(given, file, progress=progress)
        if as_json:
            _print_json({"file": str(file), "verified": result.verified, **asdict(result)})
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
        with _bar("figures") as progress:
            files = draw_all(output, only=numbers, formats=formats.split(","), safe=safe, progress=progress)
        if as_json:
            _print_json({"files": [str(file) for file in files]})
        else:
            for entry in FIGURES:
                written = [str(file) for file in files if file.stem == entry.stem]
                if written:
                    print(printable(f"figure {entry.number}: {entry.caption} {' '.join(written)}"))


# input


def _planner_of(source: Path, max_seconds: float | None) -> Planner:
    """For the scene in a file, with its free space if the file is a boundary."""
    from cfree.formats.boundary_file import load_boundary
    from cfree.formats.scene_file import load_scene
    from cfree.free.space import free_space
    from cfree.planning.planner import Planner

    if _is_archive(source):
        with _bar("cells"):
            space = free_space(load_boundary(source))
        return Planner(space.boundary.scene, space, phase=_bar)
    with _bar("reading"):
        scene = load_scene(source)
    return Planner(scene, max_seconds=max_seconds, phase=_bar)


def _exit_code(answer: Motions | Separated) -> int:
    """0 for a path, 1 for a proof that there is none; 3 if one that touches may exist."""
    of = getattr(answer, "of", None)
    return {None: 0, "closed": REFUTED}.get(of, INCOMPLETE)


def _leave_out(files: dict[str, str], name: str, why: str) -> None:
    print(printable(f"{files.pop(name)} is not written: {why}"), file=sys.stderr)


def _boundary_of(
    source: Path, threads: int | None, max_seconds: float | None = None, max_memory: float | None = None
) -> Boundary:
    """The boundary in a file, or of the scene in a file, with a bar on a terminal."""
    from cfree.forbidden.boundary import boundary
    from cfree.formats.boundary_file import load_boundary
    from cfree.formats.scene_file import load_scene

    if _is_archive(source):
        return load_boundary(source)
    with _bar("reading"):
        scene = load_scene(source)
    with _bar("boundary") as progress:
        return boundary(scene, threads=threads, max_seconds=max_seconds, max_memory=max_memory, progress=progress)


@contextmanager
def _bar(name: str) -> Iterator[Callable[[float], object] | None]:
    """What to call with the share that is done: it moves a bar on a terminal, which says what is being done."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(name, total=None)
        yield lambda share: bar.update(task, completed=share, total=1.0)


def _is_archive(path: Path) -> bool:
    """Does the file begin as a NumPy archive does? No scene does."""
    try:
        with path.open("rb") as file:
            return file.read(2) == b"PK"
    except OSError:
        return False


_CHECKS = {  # of the names of files
    "boundary": ("formats.boundary_file", "check_boundary_path"),
    "film": ("film.encode", "check_film_path"),
    "geojson": ("formats.slice_geojson", "check_slice_path"),
    "mesh": ("formats.mesh_file", "check_mesh_path"),
    "picture": ("plot.boundary", "check_picture_path"),
}


def _check_outputs(source: Path, wanted: dict[str, Path | None]) -> dict[str, str]:
    """The files to write; what cannot be written is refused before a long computation rather than after it."""
    from cfree.formats.atomic import check_place

    files = {name: path for name, path in wanted.items() if path is not None}
    for name, path in files.items():
        check_place(path)
        if path.exists() and source.exists() and path.samefile(source):
            raise FileExistsError(errno.EEXIST, "is the input; give another name", str(path))
        if name in _CHECKS:
            module, function = _CHECKS[name]
            getattr(import_module(f"cfree.{module}"), function)(path)
    return {name: str(path) for name, path in files.items()}


def _print_json(facts: dict[str, Any]) -> None:
    print(json_text(facts))
