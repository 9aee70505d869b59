"""The command ``cfree cage``: is the robot of a scene, as a body, caged by the obstacles, as fingers."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from cfree.cli import drawing, options, reading
from cfree.cli.faults import INCOMPLETE, REFUTED, fail, one_line_faults
from cfree.cli.files import bar, check_outputs, read_scene
from cfree.cli.options import Word, examples, file_option
from cfree.cli.values import read_length, read_pose, require_near
from cfree.words import counted

if TYPE_CHECKING:
    from cfree.caging.cage import Cage
    from cfree.caging.critical import Critical
    from cfree.exact.pose import Pose
    from cfree.scene.scene import Scene

Rows = dict[str, Any]
NUMBERED = r"finger (\d+)"
FEW = 2, 3  # numbers of a finger on the command line: a point, a disc


@click.command(
    cls=drawing.Command,
    epilog=examples(
        "cfree cage hand.json",
        "cfree cage hand.json -o cage.json --picture cage.png",
        'cfree cage part.json --finger 0,-1 --finger 1,0,0.2 --finger="-1,0" --save-scene hand.json',
        "cfree cage hand.json --critical all",
        "cfree cage hand.json --fewest",
        "cfree cage hand.json --immobility --picture contacts.svg",
    ),
)
@options.scene
@drawing.drawing
@reading.strict
@click.option(
    "--start",
    metavar="X,Y,THETA",
    help='Pose of the body: "1,1/2,30deg".',
    show_default="the scene's, else 0,0,0deg",
)
@click.option(
    "--finger",
    "more",
    metavar="X,Y[,R]",
    multiple=True,
    help="Add a finger: a point, or a disc of radius R. Repeat for several.",
)
@click.option(
    "--critical",
    type=Word(["spread", "close", "size", "clearance", "all"]),
    metavar="WORD",
    help='If it is caged: find at which "spread" of the fingers it escapes, or as they "close"; at which "size" or '
    '"clearance" of the body; or "all".',
)
@click.option(
    "--precision",
    type=click.FloatRange(min=0, min_open=True),
    metavar="SHARE",
    default=0.01,
    show_default=True,
    help="Limit the width of the intervals of --critical.",
)
@click.option("--fewest", is_flag=True, help="Find the least number of these fingers that cage the body.")
@click.option("--immobility", "held", is_flag=True, help="Decide if the body can move at all; --picture has contacts.")
@click.option("--ignore-bounds", is_flag=True, help="Leave out bounds and workspace, out of which nothing escapes.")
@file_option("--output", "-o", metavar="JSON", help="Write the answer, proof or path, for cfree verify.")
@file_option("--save-scene", "saved", metavar="JSON", help="Write the scene of the answer, for cfree verify.")
@options.picture
@options.max_seconds
@options.as_json
def cage(
    scene: Path, start: str | None, more: tuple[str, ...], critical: str | None, precision: float, fewest: bool,
    held: bool, ignore_bounds: bool, output: Path | None, saved: Path | None, picture: Path | None,
    max_seconds: float | None, as_json: bool,
) -> None:  # fmt: skip
    """Decide if fingers cage a body: no rigid motion leads it arbitrarily far away.

    The robot of SCENE is the body, its obstacles are the fingers, and more may be added. SCENE is a file that cfree
    convert reads. Exit code 0: caged, proved (with --immobility: immobile); 1: not caged, with a path out; 2: bad
    input; 3: undecided, by a limit, because only motions that touch may lead out, or round shapes almost touch.
    """
    with one_line_faults():
        written = check_outputs(scene, {"answer": output, "scene": saved, "picture": picture})
        if critical is None:
            options.refuse("only for the intervals of --critical", "precision", remedy="give --critical as well")
        if held:
            options.refuse("not with --immobility, which looks at one pose only", "critical", "fewest", "output",
                           "saved", "max_seconds")  # fmt: skip
        if fewest:
            options.refuse("not with --fewest", "critical", "max_seconds")
        place = _place(read_scene(scene), start, more, ignore_bounds=ignore_bounds)
        if output and saved is None and any(isinstance(finger, tuple) for finger in place[1]):
            raise ValueError(
                "-o: small triangles stand for fingers that are points, and cfree verify needs them; "
                "give --save-scene FILE as well"
            )
        from cfree.cli.report import print_result
        from cfree.errors import IncompleteError

        try:
            code, rows, figure = _answered(
                place, critical, precision, fewest, held, max_seconds, output, saved, as_json
            )
        except IncompleteError as error:
            fail(str(error), INCOMPLETE)
        if picture:
            from cfree.plot.boundary import save_figure

            with bar("picture"):
                save_figure(figure.plot().figure, picture)
        print_result(str(scene), scene, rows, written, as_json)
    if code:
        raise click.exceptions.Exit(code)


Place = tuple[Any, list[Any], "Pose", str, list[str]]


def _place(scene: Scene, start: str | None, more: tuple[str, ...], *, ignore_bounds: bool) -> Place:
    """Return the body, the fingers, the pose, the unit, and different names of the fingers."""
    from cfree.exact.pose import Pose

    walls = [text for text in ("bounds", "a workspace") if getattr(scene, text.split()[-1]) is not None]
    if walls and not ignore_bounds:
        raise ValueError(f"the scene has {' and '.join(walls)}, out of which nothing escapes; give --ignore-bounds")
    if not walls:
        options.refuse("only for a scene with bounds or workspace", "ignore_bounds")
    fingers = [*scene.obstacles, *map(_finger, more)]
    if not fingers:
        raise ValueError("there are no fingers: the scene has no obstacles; give --finger X,Y or --finger X,Y,R")
    pose = read_pose(start, "--start") or scene.start or Pose(0, 0)
    require_near(f"--start: {start!r}", pose.x, pose.y)
    return scene.robot, fingers, pose, scene.units, _names(scene, len(fingers))


def _names(scene: Scene, count: int) -> list[str]:
    """Return the names of a scene's obstacles if they have their own; else "finger" and the number."""
    from cfree.scene.scene import default_name

    names = [*scene.obstacle_names, *[""] * (count - len(scene.obstacles))]
    own = [name for k, name in enumerate(names) if name not in (default_name(k), "")]
    taken = {name for name in own if own.count(name) == 1 and not re.fullmatch(NUMBERED, name)}
    return [name if name in taken else f"finger {k}" for k, name in enumerate(names)]


def _named(text: str, names: list[str]) -> str:
    """Return a text with the names of fingers instead of their numbers."""
    text = re.sub(rf"obstacle \d+ \(({NUMBERED})\)", r"\1", text)
    return re.sub(NUMBERED, lambda match: names[int(match[1])] if int(match[1]) < len(names) else match[0], text)


def _finger(text: str) -> Any:
    from cfree.curves.curved import Curved
    from cfree.exact.number import to_fraction

    parts = [part.strip() for part in text.split(",")]
    if len(parts) not in FEW:
        raise ValueError(f"--finger: {text!r}; give X,Y for a point, or X,Y,R for a disc")
    try:
        x, y = map(to_fraction, parts[:2])
    except ValueError as error:
        raise ValueError(f"--finger: {text!r}: {error}; give X,Y for a point, or X,Y,R for a disc") from None
    radius = read_length(parts[2], "--finger", "a radius") if len(parts) > 2 else None
    require_near(f"--finger: {text!r}", x, y)
    return (x, y) if radius is None else Curved.circle((x, y), radius)


def _answered(
    place: Place, critical: str | None, precision: float, fewest: bool, held: bool, max_seconds: float | None,
    output: Path | None, saved: Path | None, as_json: bool,
) -> tuple[int, Rows, Any]:  # fmt: skip
    """Return the exit code, the rows to print, and the answer to draw."""
    body, fingers, pose, units, names = place
    if held:
        from cfree.caging.immobile import immobility

        with bar("contacts"):
            answer = replace(immobility(body, fingers, pose), units=units)
        code = {"immobile": 0, "mobile": REFUTED}.get(answer.verdict, INCOMPLETE)
        touched = sorted({contact.finger for contact in answer.contacts})
        if as_json:
            velocity = None if answer.velocity is None else [*map(float, answer.velocity)]
            facts: Rows = {"verdict": answer.verdict, "order": answer.order, "touching": touched, "velocity": velocity}
            facts["names"] = names
            return code, facts, answer
        return code, {"answer": answer.sentence(), "fingers in contact": _listed(touched, names)}, answer
    from cfree.caging.cage import cage_of
    from cfree.caging.fingers import to_body, to_fingers

    if fewest:
        from cfree.caging.fewest import fewest_of
        from cfree.cli.terminal import status

        with status() as say:
            say("sets of fingers ...")
            chosen = fewest_of(
                *_exact(to_body(body, pose), to_fingers(fingers)), names, units=units,
                progress=lambda n: say(f"sets of fingers {n:,} ..."),
            )  # fmt: skip
        _write(chosen.cage, output, saved)
        if as_json:
            facts = {"caged": bool(chosen), "fingers": chosen.fingers, "of": len(fingers), "names": names}
            return 0 if chosen else REFUTED, facts, chosen.cage
        if not chosen:
            return REFUTED, {"answer": "not caged, even by all fingers", **_cage_rows(chosen.cage, names)}, chosen.cage
        count = len(chosen.fingers)
        rows: Rows = {"answer": f"caged by {count} of {counted(len(fingers), 'finger')}, proved; by no fewer"}
        rows |= {"fingers": _listed(chosen.fingers, names), "paths that exclude fewer": len(chosen.escapes)}
        return 0, rows, chosen.cage
    with bar("cage") as progress:
        result = cage_of(
            *_exact(to_body(body, pose), to_fingers(fingers)),
            units=units,
            names=names,
            max_seconds=max_seconds,
            progress=progress,
        )
    _write(result, output, saved)
    if as_json:
        length = None if result.path is None else result.path.length
        facts = {"caged": bool(result), "holding": result.holding, "names": names, "length": length}
        found = _criticals(place, critical, precision) if critical and result else {}
        return (
            0 if result else REFUTED,
            {**facts, "critical": {k: _critical_facts(v) for k, v in found.items()}},
            result,
        )
    verdict = "caged: no motion leads out, not even one that touches; proved" if result else "not caged: it escapes"
    rows = {"answer": verdict, **_cage_rows(result, names)}
    if critical and not result:
        rows["critical"] = "not caged, so that nothing opens"
    elif critical:
        found = _criticals(place, critical, precision)
        rows |= {name: _named(str(one).split(" ", 1)[1], names) for name, one in found.items()}
    return 0 if result else REFUTED, rows, result


def _exact(body: Any, fingers: Any) -> tuple[Any, Any, Any]:
    shapes, pose = body
    return shapes, fingers, pose


def _cage_rows(cage: Cage, names: list[str]) -> Rows:
    if cage.path is not None:
        return {"path": f"{counted(len(cage.path), 'motion')}, length {cage.path.length:.6g}"}
    return {"fingers that hold it": _listed(cage.holding, names)}


def _critical_facts(found: Critical) -> Rows:
    place = found.puncture
    facts: Rows = {"caged": found.caged, "escapes": found.escapes, "end": found.end}
    if place is not None:
        pose = [float(place.pose.x), float(place.pose.y), place.pose.theta]
        facts |= {"puncture": {"pose": pose, "fingers": place.fingers}}
    return facts


def _criticals(place: Place, critical: str, precision: float) -> dict[str, Critical]:
    from cfree.caging import critical as numbers

    body, fingers, pose, _, _ = place
    finds: dict[str, tuple[Any, Rows]] = {
        "spread": (numbers.critical_spread, {}),
        "close": (numbers.critical_spread, {"direction": "close"}),
        "size": (numbers.critical_size, {}),
        "clearance": (numbers.critical_clearance, {}),
    }
    result: dict[str, Critical] = {}
    for name, (find, how) in finds.items():
        if critical in (name, "all"):
            with bar(name) as progress:
                found = find(body, fingers, pose, tolerance=precision, progress=progress, **how)
            result["closing spread" if name == "close" else name] = found
    return result


def _write(cage: Cage, output: Path | None, saved: Path | None) -> None:
    from cfree.formats.files import save

    if saved:
        save(cage.scene, saved)
    if output:
        save(cage.answer, output)


def _listed(numbers: Any, names: list[str]) -> str:
    return ", ".join(names[k] for k in numbers) or "none"
