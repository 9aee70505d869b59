"""The commands about fleets and buildings: ``cfree reach``, ``cfree aisle`` and ``cfree audit``."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from cfree.cli import drawing, options, reading
from cfree.cli.faults import REFUTED, one_line_faults
from cfree.cli.files import bar, check_outputs, read_scene, read_shapes, scene_of, without_curves
from cfree.cli.options import FILE, Word, examples, file_option
from cfree.cli.terminal import columns, print_json, printable, status, terminal_width
from cfree.cli.values import read_angle, read_length, read_pose, read_vehicle
from cfree.words import counted, ends, near

if TYPE_CHECKING:
    from cfree.analysis.aisles import Kind
    from cfree.analysis.margins import Interval
    from cfree.analysis.reach_map import Which
    from cfree.formats.shapes import Shapes
    from cfree.scene.scene import Scene
    from cfree.vehicles.vehicle import Vehicle

KINDS = ("straight", "turn", "corner", "junction", "bay", "door")
EXACT = 1e-12  # share of a width: ends that are no farther apart are one number, rounded outwards


@click.command(cls=drawing.Command, epilog=examples(
    "cfree reach scene.json --picture reach.png",
    "cfree reach map.yaml --robot robot.yaml --start 1,1,0 --start 8,2,90deg -o reach.yaml --resolution 0.05",
    "cfree reach scene.json -o reach.geojson --orientations 360",
    "cfree reach scene.json -o turning.yaml --which turning",
))  # fmt: skip
@options.scene
@drawing.drawing
@reading.strict
@click.option("--start", metavar="X,Y,THETA", multiple=True, help="Start there; repeat to start at any of several.",
              show_default="the scene's")  # fmt: skip
@click.option("--orientations", type=click.IntRange(1, 3600), default=72, show_default=True, metavar="N",
              help="Take N orientations at equal steps.")  # fmt: skip
@file_option("--output", "-o", metavar="FILE", help="Write a ROS map, .yaml with a .png beside it, or .geojson.")
@click.option("--resolution", metavar="R", help="Side of a pixel of the ROS map.", show_default="longer side / 1000")
@click.option("--which", type=Word(["some", "every", "turning"]), default="some", show_default=True, metavar="WORD",
              help='Mark free in the ROS map: reached at "some" orientation, at "every" one, or with room for '
              '"turning" round in place.')  # fmt: skip
@options.vehicle
@options.picture
@options.threads
@options.as_json
def reach(
    scene: Path, start: tuple[str, ...], orientations: int, output: Path | None, resolution: str | None, which: Which,
    vehicle: str | None, turning_radius: str | None, axle: str | None, heading: str | None, gears: str | None,
    picture: Path | None, threads: int | None, as_json: bool,
) -> None:  # fmt: skip
    """Map the places and orientations that a machine reaches.

    Cells of the free space decide, exactly; they are cut at a grid of orientations. The map holds for a machine that
    moves in any direction, for a car with both gears and for a differential drive. SCENE is of any format that cfree
    convert reads.
    """
    with one_line_faults():
        starts: list[Any] = [read_pose(text, "--start") for text in start]
        side = None if resolution is None else float(read_length(resolution, "--resolution"))
        if output is None or output.suffix.lower() != ".yaml":
            options.refuse("only for a ROS map; give -o FILE.yaml", "resolution", "which")
        files = check_outputs(scene, {"map": output, "picture": picture})
        from cfree.analysis.reach_map import reach, turning_circle
        from cfree.cli.report import print_result
        from cfree.formats.answers.reach_file import check_reach_path, image_of, save_reach

        if output is not None and check_reach_path(output) == ".yaml" and picture == image_of(output):
            raise ValueError(f"--picture: {picture} is the image of the map; give another name")
        loaded = _driven(read_scene(scene, "rounded"), read_vehicle(vehicle, turning_radius, axle, heading, gears))
        with bar("slices") as progress:
            reached = reach(loaded, starts or None, orientations, threads=threads, progress=progress)
        if output is not None:
            save_reach(reached, output, side, which)
            if output.suffix.lower() == ".yaml":
                files["image"] = str(image_of(output))
        if picture is not None:
            from cfree.plot.boundary import save_figure
            from cfree.plot.reach import plot_reach

            with bar("picture"):
                save_figure(plot_reach(reached).figure, picture)
        unit = f" {loaded.units}" if loaded.units else ""
        areas = {name: getattr(reached, name).area for name in ("some", "every", "turning")}
        if as_json:
            facts: dict[str, Any] = {"orientations": orientations, "areas": areas}
            facts |= {"turning_circle": turning_circle(loaded)}
        else:
            square = f"{unit}^2" if unit else ""
            facts = {"orientations": orientations, "reached at some": f"{areas['some']:.4g}{square}"}
            facts |= {"reached at every one": f"{areas['every']:.4g}{square}"}
            facts |= {"room to turn round": f"{areas['turning']:.4g}{square}"}
            facts |= {"turning circle": f"{turning_circle(loaded):.4g}{unit}"}
        print_result(loaded.name or str(scene), scene, facts, files, as_json)


@click.command(epilog=examples(
    'cfree aisle "[[1, 0.45], [-1, 0.45], [-1, -0.45], [1, -0.45]]" --kind corner',
    "cfree aisle forklift.yaml --kind bay --opening 1.2 --vehicle forklift --axle 0.6,0",
    "cfree aisle bed.svg --kind door --aisle 1.8",
    "cfree aisle bed.svg",
))  # fmt: skip
@click.argument("machine")
@click.option("--kind", type=Word(KINDS), metavar="WORD", show_default="all of the first four",
              help='Go along a "straight" aisle, "turn" round in it, go around a "corner", turn off at a "junction" or '
              'into a "bay" of a given opening; or find the smallest "door" at a given aisle.')  # fmt: skip
@click.option("--opening", metavar="W", help="Width of the bay's opening.")
@click.option("--aisle", metavar="W", help="Width of the aisle, for a door.")
@options.vehicle
@click.option("--tolerance", type=float, default=0.01, show_default=True, metavar="T",
              help="Limit the width of the interval, relative to its ends.")  # fmt: skip
@options.as_json
def aisle(
    machine: str, kind: Kind | None, opening: str | None, aisle: str | None, vehicle: str | None,
    turning_radius: str | None, axle: str | None, heading: str | None, gears: str | None, tolerance: float,
    as_json: bool,
) -> None:  # fmt: skip
    """Find the smallest aisle in which a machine does a manoeuvre.

    MACHINE is a file of shapes, all of which are the machine unless some have the role robot; or a footprint
    "[[x, y], ...]". At the upper width there is a motion, at the lower width none, for any number of manoeuvres: both
    are proved.
    """
    with one_line_faults():
        from cfree.analysis.aisles import KINDS_WITHOUT_WIDTH, smallest_aisle
        from cfree.analysis.reach_map import turning_circle
        from cfree.cli.report import print_result

        front: Any = 0
        if vehicle is None and heading is not None:
            front, heading = read_angle(heading, "--heading"), None
        alone = _alone(machine)
        scene = _driven(alone, read_vehicle(vehicle, turning_radius, axle, heading, gears))
        known: dict[str, Any] = {
            name: None if text is None else read_length(text, f"--{name}")
            for name, text in (("opening", opening), ("aisle", aisle))
        }
        kinds = (kind,) if kind else KINDS_WITHOUT_WIDTH
        results = {}
        for one in kinds:
            with bar(one) as progress:
                results[one] = smallest_aisle(
                    scene, one, **known, heading=front, tolerance=tolerance, progress=progress
                )
        circle = turning_circle(scene)
        if as_json:
            widths = {name: {"lo": width.lo, "hi": width.hi} for name, width in results.items()}
            print_json({"machine": machine, "widths": widths, "turning_circle": circle})
            return
        unit = f" {alone.units}" if alone.units else ""
        rows = {name: _width(width, unit) for name, width in results.items()}
        print_result("smallest aisle", Path(machine), rows | {"turning circle": f"{circle:.5g}{unit}"}, {}, False)


@click.command(cls=drawing.Command, epilog=examples(
    'cfree audit flat.json --machine "bed=[[1, 0.45], [-1, 0.45], [-1, -0.45], [1, -0.45]]" --picture audit.png',
    "cfree audit plan.svg --strokes drawn --machine bed.svg --machine wheelchair.json -o doors.csv",
    "cfree audit map.yaml --machine truck=forklift.yaml --place store=2,3 --place dock=9,3",
    "cfree audit plan.dxf --machine bed.svg --opening W1=3.2,4,3.2,5.1 --proofs proofs",
))  # fmt: skip
@click.argument("plan", type=FILE)
@drawing.drawing
@reading.strict
@click.option("--machine", "machines", multiple=True, metavar="[NAME=]FILE",
              help='A machine: a file of its shapes, or a footprint "[[x, y], ...]"; repeat for several.',
              show_default="the plan's robot")  # fmt: skip
@click.option("--place", "places", multiple=True, metavar="NAME=X,Y", help="Name the room of this point.")
@click.option("--opening", "openings", multiple=True, metavar="NAME=X,Y,U,V",
              help="Audit this opening from wall to wall; repeat for several.", show_default="those found")  # fmt: skip
@click.option("--widest", metavar="W", help="Look for openings up to this width.",
              show_default="the largest machine's diameter")  # fmt: skip
@click.option("--missing/--no-missing", default=True, show_default=True, help="Find missing widths; takes longest.")
@file_option("--output", "-o", metavar="FILE", help="Write the doors as .csv, or doors and rooms as .geojson.")
@click.option("--proofs", type=FILE, metavar="FOLDER", help="Write each proof with its scene, for cfree verify.")
@options.picture
@options.as_json
def audit(
    plan: Path, machines: tuple[str, ...], places: tuple[str, ...], openings: tuple[str, ...], widest: str | None,
    missing: bool, output: Path | None, proofs: Path | None, picture: Path | None, as_json: bool,
) -> None:  # fmt: skip
    """Find the doors of a floor plan that machines cannot pass, with proofs and missing widths.

    PLAN is of any format that cfree convert reads; closed lines that are walls need --strokes. Exit code 0: all doors
    are passed; 1: some are not.
    """
    with one_line_faults():
        named_places = {name: _numbers(text, name, 2, "--place") for name, text in _named(places, "--place")}
        named_openings = {
            name: (numbers[:2], numbers[2:])
            for name, text in _named(openings, "--opening")
            for numbers in [_numbers(text, name, 4, "--opening")]
        }
        limit = None if widest is None else float(read_length(widest, "--widest"))
        files = check_outputs(plan, {"audit": output, "picture": picture})
        from cfree.analysis.audit import audit
        from cfree.cli.report import print_rows
        from cfree.formats.answers.audit_file import check_audit_path, door_facts, save_audit, save_proofs

        if output is not None:
            check_audit_path(output)
        _refuse_twice([*map(_machine_name, machines)], "--machine", "NAME=FILE")
        shapes = {text: read_machine(_machine_file(text)) for text in machines}
        loaded, robot = read_shapes(plan)
        if shapes and robot is not None:
            raise ValueError("--robot: and --machine; give one of them")
        if not shapes and robot is None and not loaded.of("robot"):
            raise ValueError(f"{plan}: there is no machine; give --machine with a file or a footprint")
        scene = scene_of(loaded, next(iter(shapes.values()), robot), plan)
        robots = {_machine_name(text): _as_in(loaded, scene, shape, text) for text, shape in shapes.items()}
        scene = without_curves(scene, plan, keep_rounded=True)
        with bar("doors") as progress:
            result = audit(
                scene, robots or None, openings=named_openings or None, places=named_places, widest=limit,
                missing=missing, progress=progress,
            )  # fmt: skip
        if output is not None:
            save_audit(result, output)
        pairs = [] if proofs is None else save_proofs(result, proofs)
        if picture is not None:
            from cfree.plot.boundary import save_figure
            from cfree.plot.reach import plot_audit

            with bar("picture"):
                save_figure(plot_audit(result), picture)
        facts = [door_facts(door) for door in result.doors]
        if as_json:
            proved = [{"scene": str(one), "proof": str(other)} for one, other in pairs]
            print_json({"file": str(plan), "doors": facts, "proofs": proved, "files": files, **reading.facts()})
        else:
            rows: dict[str, Any] = {"machines": len(result.machines), "rooms": len(result.rooms)}
            rows["doors"] = len(result.doors) // len(result.machines)
            rows["proved impassable"] = len(result.blocked)
            print_rows(scene.name or str(plan), rows, files)
            if result.doors:
                print("\n".join(_table(result)))
            else:
                print(" no door was found: none of a suitable width is between two rooms; give --widest or --opening")
            if pairs:
                one, other = pairs[0]
                print(printable(f" proofs   {len(pairs)} in {proofs}; check each like: cfree verify {one} {other}"))
        sys.exit(REFUTED if any(door.result != "passes" for door in result.doors) else 0)


def read_machine(text: str) -> Any:
    """Read the shapes of a machine from a file, or its footprint."""
    from cfree.formats.drawings.footprints import footprint
    from cfree.formats.drawings.source import Reading
    from cfree.formats.scene_file import read_shapes as read

    if text.lstrip()[:1] in ("[", "("):
        return [footprint(text)]
    with status() as say:
        say("reading ...")
        shapes = read(text, Reading(curves=True).of_robot)
    if not shapes.shapes:
        raise ValueError(f"{text}: nothing in it can be the machine; draw its outline closed")
    return shapes


def _as_in(plan: Shapes, scene: Scene, shapes: Any, text: str) -> Any:
    """Return the robot that a machine is among the shapes of a plan, in their unit, and report what is new in that."""
    from cfree.scene.scene import Scene

    file = Path(_machine_file(text))
    own = drawing.framed(plan).scene(shapes, drawing.pivot())
    reading.report([note for note in own.reading if note not in scene.reading], file)
    return without_curves(Scene(own.robot), file, keep_rounded=True).robot


def _alone(text: str) -> Scene:
    """Return a scene of a machine alone; polygons around them replace curves but exact ones."""
    from cfree.scene.scene import Scene

    shapes, units = read_machine(text), ""
    if not isinstance(shapes, list):
        reading.report(shapes.record, Path(text))
        units = str(shapes.settings.get("units") or "")
        shapes = [shape.polygon for shape in shapes.of("robot") or shapes.shapes]
    return without_curves(Scene(shapes, units=units), Path(text), keep_rounded=True, remedy="")


def _width(width: Interval, unit: str) -> str:
    if width.hi - width.lo <= EXACT * width.hi:
        return f"more than {width.hi:.5g}{unit}"
    low, high = ends(width.lo, width.hi, 5)
    return f"{low}{unit} is too narrow, {high}{unit} will do"


def _driven(scene: Scene, vehicle: Vehicle | Any | None) -> Scene:
    from cfree.scene.scene import vehicle_for, with_vehicle

    return with_vehicle(scene, vehicle_for(scene, vehicle))


def _machine_file(text: str) -> str:
    _, sign, file = text.partition("=")
    return file if sign and not Path(text).exists() else text


def _machine_name(text: str) -> str:
    """Return the name before "=", or the file's; of a footprint "machine"."""
    file = _machine_file(text)
    if file != text:
        return text.partition("=")[0]
    return "machine" if text.lstrip()[:1] in ("[", "(") else Path(text).stem


def _named(texts: tuple[str, ...], option: str) -> list[tuple[str, str]]:
    pairs = [text.rpartition("=") for text in texts]
    if wrong := next((text for text, (name, sign, _) in zip(texts, pairs, strict=True) if not sign or not name), None):
        raise ValueError(
            f'{option}: {wrong!r}; write it like "kitchen={"1,2" if option == "--place" else "1,2,1,2.9"}"'
        )
    _refuse_twice([name for name, _, _ in pairs], option, "NAME=...")
    return [(name, value) for name, _, value in pairs]


def _refuse_twice(names: list[str], option: str, form: str) -> None:
    if twice := next((name for name in names if names.count(name) > 1), None):
        raise ValueError(f"{option}: the name {twice!r} is there twice; give {form} with different names")


def _numbers(text: str, name: str, count: int, option: str) -> list[Any]:
    from cfree.exact.number import to_fraction

    try:
        numbers = [to_fraction(part) for part in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) != count:
        raise ValueError(f"{option}: {name}={text}; give {counted(count, 'number')} after the name")
    return numbers


def _table(result: Any) -> list[str]:
    from cfree.analysis.audit import WORDS

    rows = [["machine", "door", "width", "at", "between", "", "missing"]]
    for door in result.doors:
        where = ", ".join(near(value, door.width) for value in door.middle)
        missing = " to ".join(ends(door.missing.lo, door.missing.hi, 3)) if door.missing else ""
        rows.append([
            printable(door.machine), printable(door.name), near(door.width, door.width), where,
            printable(" - ".join(door.rooms)), WORDS[door.result], missing,
        ])  # fmt: skip
    return columns(rows, "<<><<<<", max(terminal_width(), 100))
