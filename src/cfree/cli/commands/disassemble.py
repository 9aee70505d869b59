"""The command ``cfree disassemble``: which parts of a file can be taken out, and in which order."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from cfree.cli import drawing, options, reading
from cfree.cli.faults import INCOMPLETE, REFUTED, fail, one_line_faults
from cfree.cli.files import bar, check_outputs, read_shapes, scene_of
from cfree.cli.options import examples, file_option
from cfree.words import counted

if TYPE_CHECKING:
    from cfree.disassembly.assembly import Assembly
    from cfree.disassembly.leaving import Leaving
    from cfree.formats.shapes import Shapes

ROBOT = "robot"
Rows = dict[str, Any]


@click.command(
    cls=drawing.Command,
    epilog=examples(
        "cfree disassemble examples/cages/puzzle.geojson --fixed housing",
        "cfree disassemble parts.svg --fixed frame --picture steps.png -o steps",
        "cfree disassemble parts.json --part lid --gap",
        "cfree verify steps/1-lid.scene.json steps/1-lid.answer.json",
    ),
)
@click.argument("parts", type=options.FILE)
@drawing.drawing
@reading.strict
@click.option("--fixed", metavar="NAME", multiple=True, help="Do not take out this part. Repeat for several.")
@click.option("--part", "only", metavar="NAME", help="Decide about this part alone: can it leave, what blocks it?")
@click.option("--gap", is_flag=True, help="If --part cannot leave: find by how much it is too large, and where.")
@file_option("--output", "-o", metavar="FOLDER", help="Write scene and answer of each step, for cfree verify.")
@options.picture
@options.max_seconds
@options.as_json
def disassemble(
    parts: Path, fixed: tuple[str, ...], only: str | None, gap: bool, output: Path | None, picture: Path | None,
    max_seconds: float | None, as_json: bool,
) -> None:  # fmt: skip
    """Find an order in which parts can be taken out, one at a time, or prove that some cannot.

    Each shape of PARTS is a part at its place, named by its name or layer; shapes of one name move together. A part may
    turn. The file is JSON, GeoJSON, SVG, DXF or another format that cfree convert reads; a robot is a part at the
    start. Exit code 0: all parts that are not fixed can be taken out (with --part: it can leave); 1: proved impossible;
    2: bad input; 3: undecided, by a limit or because only motions that touch may lead out.
    """
    with one_line_faults():
        written = check_outputs(parts, {"picture": picture})
        if only is None:
            options.refuse("only for one part", "gap", remedy="give --part as well")
        if output and output.exists() and not output.is_dir():
            raise ValueError(f"-o {output}: this is a file; give the name of a folder")
        assembly = _assembly(parts, fixed)
        _refuse_fixed(assembly, only)
        from cfree.cli.report import print_result
        from cfree.errors import IncompleteError

        try:
            if only is None:
                code, rows, answer, steps = _in_order(assembly, max_seconds, as_json=as_json)
            else:
                code, rows, answer, steps = _of_one(assembly, only, max_seconds, gap=gap, as_json=as_json)
        except IncompleteError as error:
            fail(str(error), INCOMPLETE)
        if output:
            _write(output, steps)
            rows["written"] = f"{2 * len(steps)} files in {output}"
        if picture:
            from cfree.plot.boundary import save_figure

            with bar("picture"):
                save_figure(answer.plot().figure, picture)
        print_result(str(parts), parts, rows, written, as_json)
    if code:
        raise click.exceptions.Exit(code)


def _assembly(source: Path, fixed: tuple[str, ...]) -> Assembly:
    """Read the parts of a file."""
    from cfree.disassembly.assembly import Assembly

    shapes, robot = read_shapes(source)
    named: dict[str, list[Any]] = {}
    units = str(shapes.settings.get("units") or "")
    if robot is not None or shapes.of("robot"):
        units = _add_robot(named, shapes, robot, source)
    else:
        shapes = drawing.framed(shapes)
        reading.report(shapes.record, source)
        drawing.keep_form(shapes.form)
        _refuse_walls(shapes.settings.get("bounds"), shapes.of("workspace"))
        for k, shape in enumerate(shapes.of("obstacle")):
            named.setdefault(shape.name or f"part {k}", []).append(shape.polygon)
    if not named:
        raise ValueError(f"{source}: there are no parts; give --role NAME=obstacle for what is one")
    return Assembly(named, fixed, units)


def _refuse_fixed(assembly: Assembly, only: str | None) -> None:
    """Refuse a question about parts that are not taken out."""
    if only is None and not assembly.movable:
        count = counted(len(assembly.names), "part")
        raise ValueError(f"--fixed: all of the {count}, so that there is none to take out; leave one of them out")
    if only in assembly.fixed:
        raise ValueError(f"--part: {only!r} is fixed, and is not taken out; leave out --fixed for it")


def _add_robot(named: dict[str, list[Any]], shapes: Shapes, robot: Any, source: Path) -> str:
    """Add the robot at the start of the scene, and the obstacles; return the unit."""
    from cfree.curves.similar import moved_shape
    from cfree.scene.scene import default_name

    scene = scene_of(shapes, robot, source)
    _refuse_walls(scene.bounds, scene.workspace)
    if scene.start is None:
        raise ValueError(f"{source}: the robot has no start, and so no place as a part; give it one, or leave it out")
    named[scene.name or ROBOT] = [moved_shape(part, scene.start) for part in scene.robot]
    for k, (name, shape) in enumerate(zip(scene.obstacle_names, scene.obstacles, strict=True)):
        named.setdefault(f"part {k}" if name == default_name(k) else name, []).append(shape)
    return scene.units


def _refuse_walls(bounds: Any, workspace: Any) -> None:
    if bounds is not None or workspace:
        kind, it = ("bounds", "them") if bounds is not None else ("a workspace", "it")
        raise ValueError(f"the file has {kind}, out of which nothing can leave; leave {it} out, or make {it} a part")


Answered = tuple[int, Rows, Any, "list[Leaving]"]


def _in_order(assembly: Assembly, max_seconds: float | None, *, as_json: bool) -> Answered:
    from cfree.disassembly.order import removal_order

    with bar("parts") as progress:
        found = removal_order(assembly, max_seconds=max_seconds, progress=progress)
    code = 0 if found else INCOMPLETE if found.undecided else REFUTED
    steps = [*found.removed, *found.held]
    if as_json:
        held = {step.part: step.holding for step in found.held}
        facts = {"order": found.order, "fixed": assembly.fixed, "held": held, "undecided": dict(found.undecided)}
        return code, facts, found, steps
    rows: Rows = {"parts": f"{len(assembly.names)}, {len(assembly.fixed)} fixed"}
    for k, step in enumerate(found.removed):
        rows[f"{k + 1}. out"] = _path_text(step)
    for step in found.held:
        rows[f"{step.part} cannot leave"] = f"held by {', '.join(step.holding)}; proved"
    for name, why in found.undecided:
        rows[f"{name} undecided"] = why.removeprefix("undecided: ")
    rows["answer"] = (
        "all parts can be taken out, one at a time"
        if found
        else f"undecided: {', '.join(name for name, _ in found.undecided)}"
        if found.undecided
        else f"no order takes out {', '.join(step.part for step in found.held)}, one at a time; proved"
    )
    return code, rows, found, steps


def _of_one(assembly: Assembly, part: str, max_seconds: float | None, *, gap: bool, as_json: bool) -> Answered:
    from cfree.disassembly.leaving import can_leave, missing_gap, what_blocks

    with bar(part) as progress:
        step = can_leave(part, assembly, max_seconds=max_seconds, progress=progress)
    if step and as_json:
        return 0, {"leaves": True}, step, [step]
    if step:
        none = {"gap": "none is missing"} if gap else {}
        return 0, {"answer": f"{part} can leave", "path": _path_text(step), **none}, step, [step]
    with bar("blocking parts"):
        blocking = what_blocks(part, assembly)
    miss = None
    if gap:
        with bar("gap") as progress:
            miss = missing_gap(part, assembly, progress=progress)
    if as_json:
        facts: Rows = {"leaves": False, "held by": step.holding, "without": blocking.single}
        if gap:
            facts["gap"] = None if miss is None else [miss.lo, miss.hi]
            facts["places"] = [] if miss is None else [str(place) for place in miss.bottlenecks]
        return REFUTED, facts, step, [step]
    rows: Rows = {
        "answer": f"{part} cannot leave, not even on a motion that touches; proved",
        "held by": ", ".join(step.holding),
        "it can leave without": " or ".join(blocking.single) or "no single part",
    }
    if gap:
        places = "" if miss is None or miss.bottlenecks else "; no single narrow place was found"
        rows["gap"] = "no smaller part of this shape can leave" if miss is None else f"{miss}{places}"
    return REFUTED, rows, step, [step]


def _path_text(step: Leaving) -> str:
    import math

    path = step.path
    if path is None:
        return ""
    turning = f", turning {math.degrees(path.turning):.4g} deg" if path.turning else ", straight"
    return f"{step.part}: {counted(len(path), 'motion')}, length {path.length:.4g}{turning}"


def _write(folder: Path, steps: list[Leaving]) -> None:
    import re

    from cfree.formats.files import save

    folder.mkdir(parents=True, exist_ok=True)
    for k, step in enumerate(steps):
        name = re.sub(r"[^\w-]+", "-", step.part).strip("-") or "part"
        save(step.scene, folder / f"{k + 1}-{name}.scene.json")
        save(step.answer, folder / f"{k + 1}-{name}.answer.json")
