"""The command ``cfree plan``: a path from start to goal, or a proof that there is none."""

from __future__ import annotations

import sys
from contextlib import nullcontext, redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from cfree.cli import drawing, options, reading
from cfree.cli.faults import one_line_faults
from cfree.cli.files import check_outputs, planner_of
from cfree.cli.options import Word, examples, file_option
from cfree.cli.values import read_goals, read_length, read_pose, read_preferences, read_seconds, read_vehicle

if TYPE_CHECKING:
    from cfree.formats.answers.answer_file import Form
    from cfree.paths.path import Objective


@click.command(
    cls=drawing.Command,
    epilog=examples(
        "cfree plan scene.json",
        "cfree plan scene.json --start 0,0,90deg --goal 5,1/3,tau:1/2 -o way.json --picture way.png",
        "cfree plan scene.json -o way.csv --improve 2s",
        "cfree plan scene.json -o - --format csv --step 0.05 --speed 0.5 > way.csv",
        "cfree plan scene.json --clearance 0.3",
        "cfree plan scene.json --goal 5,3 --nearest-free",
        "cfree plan scene.json --prefer sideways=5,turning=2 --picture way.png",
        "cfree plan scene.json --vehicle car --turning-radius 4 --axle -1.3,0.111 --prefer backward=3",
        "cfree plan scene.json --vehicle car --turning-radius 4 -o way.yaml --per-gear --speed 1 --acceleration 0.5",
        "cfree plan scene.json --what-if --picture blockers.png",
        "cfree plan scene.json --goal 5,3 --goal 7,1,90deg",
    ),
)
@options.scene
@drawing.drawing
@reading.strict
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
@click.option(
    "--acceleration",
    metavar="A",
    help="Limit a vehicle's acceleration along its path; with --speed.",
    show_default="no limit",
)
@click.option(
    "--steer-rate",
    metavar="ANGLE",
    help="Limit the angle by which the wheels turn in a second; with --speed.",
    show_default="no limit",
)
@click.option(
    "--wheelbase", metavar="LENGTH", help="Distance of the axles, for --steer-rate.", show_default="the car's own"
)
@click.option(
    "--stops",
    type=Word(["all", "cusps"]),
    metavar="WORD",
    help='Stand at "all" jumps of curvature while the wheels turn, or at "cusps" only: the answer has the error.',
    show_default="all",
)
@click.option("--per-gear", is_flag=True, help="Write a ROS file for each run in one gear: way-1-forward.yaml, ...")
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
    help='Set costs relative to driving ahead, as "sideways=5,backward=2,turning=3"; the answer lists such motions. '
    'For a vehicle also "cusp=2,stop=0.5": lengths that a change of direction, and another stop, cost.',
)
@options.vehicle
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
@file_option("--part", metavar="JSON", help="Write the scene with the needed obstacles; if SCENE is a folder.")
@options.max_seconds
@options.as_json
def plan(
    scene: Path, start: str | None, goal: tuple[str, ...], output: Path | None, form: Form | None, step: str | None,
    turn: str | None, speed: str | None, acceleration: str | None, steer_rate: str | None, wheelbase: str | None,
    stops: str | None, per_gear: bool, clearance: str | None, nearest_free: bool, improve: str | None,
    objective: Objective, prefer: str | None, vehicle: str | None, turning_radius: str | None, axle: str | None,
    heading: str | None, gears: str | None, picture: Path | None, film: Path | None, miss: bool, what_if: bool,
    part: Path | None, max_seconds: float | None, as_json: bool,
) -> None:  # fmt: skip
    """Find a path from start to goal, or prove that there is none.

    Each motion is proved free. SCENE is JSON, GeoJSON, WKT, SVG, DXF or another format that cfree convert reads; or a
    boundary written by cfree boundary -o; or a folder written by cfree boundary --folder, of which only tiles near the
    path are read: to a far goal it leads through the portals kept there. Exit code 0: a path; 1: proved impossible; 2:
    bad input; 3: undecided, by a limit, because only paths that touch may exist, because the clearance is too near to
    the largest, because round shapes almost touch, or because a vehicle needs too many manoeuvres.
    """
    with one_line_faults():
        from cfree.cli.answering import Answering, Sampling
        from cfree.cli.report import print_result

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
        limits = {"speed": speed, "acceleration": acceleration, "steer_rate": steer_rate, "wheelbase": wheelbase}
        poses = Sampling.of(output, form, step, turn, limits | {"stops": stops}, per_gear)
        seconds = None if improve is None else read_seconds(improve)
        if seconds == 0 and objective != "clear":
            options.refuse("only for a path that is improved, and --improve 0 gives the first", "objective")
        ends = read_pose(start, "--start"), read_goals(goal)
        room = None if clearance is None else read_length(clearance, "--clearance")
        how: dict[str, Any] = {"clearance": room, "improve": seconds, "objective": objective}
        driver = read_vehicle(vehicle, turning_radius, axle, heading, gears)
        planner: Any = planner_of(scene, max_seconds, read_preferences(prefer), driver)
        poses.require_fit(planner.vehicle)
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

            save_scene(answering.scene, part)
        rows = answering.rows(poses.limits, for_machines=as_json, nearest_miss=miss, what_if=what_if)
        if scene.is_dir():
            rows["tiles read"] = planner.sharded.tiles_read
        with redirect_stdout(sys.stderr) if printed else nullcontext():
            print_result(answering.planner.scene.name or str(scene), scene, rows, answering.files, as_json)
    if answering.exit_code:
        raise click.exceptions.Exit(answering.exit_code)
