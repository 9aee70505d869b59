"""Commands for scenes alone: check a file, and convert it to another format."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from cfree.cli import options, reading
from cfree.cli.faults import one_line_faults
from cfree.cli.files import bar, check_outputs
from cfree.cli.options import FILE, Decorator, Word, examples, file_option
from cfree.cli.terminal import print_json
from cfree.words import counted

if TYPE_CHECKING:
    from cfree.formats.shapes import Shapes
    from cfree.scene.scene import Scene

WITH_NAMES = "SVG", "DXF", "URDF", "nesting"  # formats whose shapes have names, for --role
WITH_CURVES = "SVG", "DXF", "URDF", "nav2 parameters"  # formats whose curves become polygons


def _reading(command: Any) -> Any:
    """Add the options for reading drawings and maps."""
    options_of_reading: list[Decorator] = [
        click.option("--tolerance", type=float, metavar="E",
                     help="Limit the error of polygons for curves, in the drawing's units.",
                     show_default="drawing's size / 1000"),
        click.option("--unknown", type=Word(["obstacle", "free"]), default="obstacle", show_default=True,
                     help="Treat unknown cells of a map as this."),
        click.option("--role", "roles", multiple=True, metavar="NAME=ROLE",
                     help="Give a layer, group or name a role: robot, obstacle, workspace or ignore."),
        click.option("--robot", metavar="ROBOT",
                     help='Replace the robot by that of a file, or by a footprint "[[0.3, 0.2], ...]".'),
    ]  # fmt: skip
    for option in reversed(options_of_reading):
        command = option(command)
    return command


@click.command(epilog=examples(
    "cfree check scene.json",
    "cfree check scene.json --json | jq .patches",
    "cfree check map.yaml --robot nav2_params.yaml",
))  # fmt: skip
@options.scene
@_reading
@reading.strict
@file_option("--picture", metavar="PNG", help="Draw the scene, and what was lost: .png, .svg, .pdf ...")
@options.as_json
def check(
    scene: Path, tolerance: float | None, unknown: str, roles: tuple[str, ...], robot: str | None, picture: Path | None,
    as_json: bool,
) -> None:  # fmt: skip
    """Validate a scene and describe it.

    Counts vertices, pieces and expected patches, and tests whether start and goal are free. SCENE is of any format that
    cfree convert reads. All losses, guesses and changes of reading are listed; --picture draws them: lost lines red,
    guessed outlines hatched, joined gaps as dots.
    """
    with one_line_faults():
        from cfree.cli.describe import describe

        written = check_outputs(scene, {"picture": picture})
        shapes, loaded = _read(scene, tolerance, unknown, roles, robot, most=None)
        _refuse_unused(shapes, robot)
        with bar("counting"):
            facts = {"file": str(scene)} | describe(loaded) | _facts(shapes) | reading.facts(loaded.reading)
        if picture:
            from cfree.plot.answer import picture as drawn
            from cfree.plot.boundary import save_figure

            with bar("picture"):
                save_figure(drawn(loaded), picture)
        if as_json:
            print_json(facts | ({"files": written} if written else {}))
        else:
            from cfree.cli.report import print_scene

            print_scene(facts)


@click.command(epilog=examples(
    "cfree convert plan.svg scene.json",
    "cfree convert part.dxf scene.json --tolerance 0.01 --role DIMENSIONS=ignore",
    "cfree convert map.yaml scene.json --robot nav2_params.yaml",
    'cfree convert map.yaml scene.json --unknown free --robot "[[0.3, 0.2], [-0.3, 0.2], [-0.3, -0.2], [0.3, -0.2]]"',
    "cfree convert scene.json scene.svg",
    "cfree convert round.json polygons.json --outer 0.01",
))  # fmt: skip
@click.argument("source", type=FILE, metavar="IN")
@click.argument("target", type=FILE, metavar="OUT")
@_reading
@reading.strict
@click.option(
    "--outer", type=float, metavar="E", help="Replace round shapes by polygons around them, within E scene units."
)
@click.option(
    "--inner", type=float, metavar="E", help="Replace round shapes by polygons inside them, within E scene units."
)
@options.as_json
def convert(
    source: Path, target: Path, tolerance: float | None, unknown: str, roles: tuple[str, ...], robot: str | None,
    outer: float | None, inner: float | None, as_json: bool,
) -> None:  # fmt: skip
    """Convert a scene from one format to another.

    IN is JSON, GeoJSON, WKT, SVG, DXF, a ROS map's YAML, nav2 parameters, URDF, or nesting JSON; OUT is .json,
    .geojson, .svg or .dxf. Losses, guesses and changes of reading are listed, and kept in the file.
    """
    with one_line_faults():
        from cfree.cli.report import print_rows
        from cfree.formats.conversion import is_without_curves, written
        from cfree.formats.scene_file import check_scene_path
        from cfree.scene.reading_lines import as_read

        check_scene_path(target)
        files = check_outputs(source, {"scene": target})
        shapes, scene = _read(source, tolerance, unknown, roles, robot)
        if not scene.curved:
            options.refuse("only for round shapes, and this scene has none", "outer", "inner")
        by_name = outer is None and inner is None and is_without_curves(target)
        _refuse_unused(shapes, robot, becoming_polygons=scene.curved and by_name)
        scene, notes = written(scene, target, outer, inner, tolerance)
        reading.report(notes, target)
        facts = _facts(shapes) | {"robot": len(scene.robot), "obstacles": len(scene.obstacles)}
        if as_json:
            print_json({"file": str(source), **facts, "files": files, **reading.facts()})
            return
        rows: dict[str, Any] = {"read as": facts["format"], "robot": counted(len(scene.robot), "polygon")}
        rows["obstacles"] = counted(len(scene.obstacles), "polygon")
        rows[reading.AS_READ] = as_read(scene.reading)
        print_rows(scene.name or str(source), rows, files)


def _read(
    file: Path,
    tolerance: float | None,
    unknown: str,
    roles: tuple[str, ...],
    robot: str | None,
    most: int | None = reading.MOST_LINES,
) -> tuple[Shapes, Scene]:
    from cfree.formats.scene_file import load_shapes

    with bar("reading"):
        pairs = [role.rpartition("=") for role in roles]
        if wrong := next((role for role, (_, sign, _) in zip(roles, pairs, strict=True) if not sign), None):
            raise ValueError(f'--role: {wrong!r}; write it like "walls=obstacle"')
        named = {name: role for name, _, role in pairs}
        how: dict[str, Any] = {"tolerance": tolerance, "unknown": unknown, "roles": named}
        shapes = load_shapes(file, **how)
        other = None if robot is None else _robot(robot, tolerance)
    return shapes, reading.made(shapes, file, other, most)


def _refuse_unused(shapes: Shapes, robot: str | None, *, becoming_polygons: bool = False) -> None:
    """Refuse options of reading that have no effect on files of this format."""
    if shapes.form != "ROS map":
        options.refuse(f"only for a ROS map, and this file is read as {shapes.form}", "unknown")
    if shapes.form not in WITH_NAMES:
        options.refuse(f"only for {', '.join(WITH_NAMES)}, and this file is read as {shapes.form}", "roles")
    has_other = robot is not None and not _is_footprint(robot)
    if shapes.form not in WITH_CURVES and not has_other and not becoming_polygons:
        options.refuse(f"only for {', '.join(WITH_CURVES)}, and this file is read as {shapes.form}", "tolerance")


def _robot(text: str, tolerance: float | None) -> Any:
    """Read the polygon of a footprint, or the shapes of a file."""
    from cfree.formats.drawings.footprints import footprint
    from cfree.formats.scene_file import load_shapes

    if _is_footprint(text):
        return footprint(text)
    return load_shapes(text, tolerance=tolerance)


def _is_footprint(text: str) -> bool:
    return text.lstrip()[:1] in ("[", "(")


def _facts(shapes: Shapes) -> dict[str, Any]:
    return {"format": shapes.form, "changed": list(shapes.changed), "dropped": list(shapes.dropped)}
