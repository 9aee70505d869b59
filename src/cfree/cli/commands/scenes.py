"""Commands for scenes alone: check a file, and convert it to another format."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from cfree.cli import drawing, options, reading
from cfree.cli.faults import one_line_faults
from cfree.cli.files import bar, check_outputs, read_shapes, scene_of
from cfree.cli.options import FILE, examples, file_option
from cfree.cli.terminal import print_json
from cfree.words import counted

if TYPE_CHECKING:
    from cfree.formats.shapes import Shapes
    from cfree.scene.scene import Scene


@click.command(cls=drawing.Command, epilog=examples(
    "cfree check scene.json",
    "cfree check scene.json --json | jq .patches",
    "cfree check map.yaml --robot nav2_params.yaml",
))  # fmt: skip
@options.scene
@drawing.drawing
@reading.strict
@file_option("--picture", metavar="PNG", help="Draw the scene, and what was lost: .png, .svg, .pdf ...")
@options.as_json
def check(scene: Path, picture: Path | None, as_json: bool) -> None:
    """Validate a scene and describe it.

    Counts vertices, pieces and expected patches, and tests whether start and goal are free. SCENE is of any format that
    cfree convert reads. All losses, guesses and changes of reading are listed; --picture draws them: lost lines red,
    guessed outlines hatched, joined gaps as dots.
    """
    with one_line_faults():
        from cfree.cli.describe import describe

        written = check_outputs(scene, {"picture": picture})
        shapes, robot = read_shapes(scene)
        if picture and robot is None and not shapes.of("robot"):
            _draw(shapes, picture)  # the error about the missing robot comes next
        loaded = scene_of(shapes, robot, scene, most=None)
        with bar("counting"):
            facts = {"file": str(scene)} | describe(loaded) | _facts(shapes) | reading.facts(loaded.reading)
        if picture:
            _draw(loaded, picture)
        facts |= {"files": written} if written else {}
        if as_json:
            print_json(facts)
        else:
            from cfree.cli.report import print_scene

            print_scene(facts)


@click.command(cls=drawing.Command, epilog=examples(
    "cfree convert plan.svg scene.json",
    "cfree convert part.dxf scene.json --tolerance 0.01 --role DIMENSIONS=ignore",
    "cfree convert part.dxf scene.json --heal 1e-6",
    "cfree convert map.yaml scene.json --robot nav2_params.yaml",
    'cfree convert map.yaml scene.json --unknown free --robot "[[0.3, 0.2], [-0.3, 0.2], [-0.3, -0.2], [0.3, -0.2]]"',
    "cfree convert scene.json scene.svg",
    "cfree convert round.json polygons.json --outer 0.01",
))  # fmt: skip
@click.argument("source", type=FILE, metavar="IN")
@click.argument("target", type=FILE, metavar="OUT")
@drawing.drawing
@reading.strict
@click.option(
    "--outer", type=float, metavar="E", help="Replace round shapes by polygons around them, within E scene units."
)
@click.option(
    "--inner", type=float, metavar="E", help="Replace round shapes by polygons inside them, within E scene units."
)
@options.as_json
def convert(source: Path, target: Path, outer: float | None, inner: float | None, as_json: bool) -> None:
    """Convert a scene from one format to another.

    IN is JSON, GeoJSON, WKT, SVG, DXF, a ROS map's YAML, nav2 parameters, URDF, or nesting JSON; OUT is .json,
    .geojson, .svg or .dxf. Losses, guesses and changes of reading are listed, and kept in the file.
    """
    with one_line_faults():
        from cfree.cli.report import print_rows
        from cfree.formats.conversion import written
        from cfree.formats.scene_file import check_scene_path
        from cfree.scene.reading_lines import as_read

        check_scene_path(target)
        files = check_outputs(source, {"scene": target})
        shapes, robot = read_shapes(source)
        scene = scene_of(shapes, robot, source)
        if not scene.curved:
            options.refuse("only for round shapes, and this scene has none", "outer", "inner")
        scene, notes = written(scene, target, outer, inner, drawing.tolerance())
        reading.report(notes, target)
        facts = _facts(shapes) | {"robot": len(scene.robot), "obstacles": len(scene.obstacles)}
        if as_json:
            print_json({"file": str(source), **facts, "files": files, **reading.facts()})
            return
        rows: dict[str, Any] = {"read as": facts["format"], "robot": counted(len(scene.robot), "polygon")}
        rows["obstacles"] = counted(len(scene.obstacles), "polygon")
        rows[reading.AS_READ] = as_read(scene.reading)
        print_rows(scene.name or str(source), rows, files)


def _draw(value: Scene | Shapes, file: Path) -> None:
    from cfree.plot.answer import picture
    from cfree.plot.boundary import save_figure

    with bar("picture"):
        save_figure(picture(value), file)


def _facts(shapes: Shapes) -> dict[str, Any]:
    return {"format": shapes.form, "changed": list(shapes.changed), "dropped": list(shapes.dropped)}
