"""Options for reading SCENE and ROBOT, the same for every command: drawings, maps, footprints, units."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from cfree.cli.options import Word

if TYPE_CHECKING:
    from cfree.exact.pose import Pose
    from cfree.formats.drawings.source import Reading
    from cfree.formats.fitting import Pivot
    from cfree.formats.shapes import Shapes
    from cfree.scene.scene import Scene

_VALUES, _NAMED, _FORM = (f"cfree.cli.drawing:{name}" for name in ("values", "named", "form"))
SECTION = "Reading SCENE and ROBOT"
_DRAWINGS = ("SVG", "DXF")
_MAPS = ("ROS map",)
_POLYGONS = (*_DRAWINGS, "GeoJSON", "WKT", "scene", "nesting")
FORMS: dict[str, tuple[str, ...]] = {
    "tolerance": (*_DRAWINGS, "GeoJSON", "URDF", "nav2 parameters"),
    "unknown": _MAPS,
    "roles": (*_DRAWINGS, "GeoJSON", "WKT", "URDF", "nesting", "nav2 parameters"),
    "join": _DRAWINGS,
    "join_holes": _DRAWINGS,
    "heal": (*_DRAWINGS, "scene"),
    "strokes": (*_DRAWINGS, "GeoJSON"),
    "repair": _POLYGONS,
    "holes": ("SVG",),
    "language": ("SVG",),
    "fills": ("DXF",),
    "space": ("DXF",),
    "map_rules": _MAPS,
    "occupied": _MAPS,
    "free_thresh": _MAPS,
    "unknown_grey": _MAPS,
    "despeckle": _MAPS,
    "min_area": _DRAWINGS,
}
"""Formats of files on which an option has an effect; the others have one on every file."""


class Option(click.Option):
    """An option about reading; its value is kept with the command, not passed to it."""

    def __init__(self, *names: Any, **settings: Any) -> None:
        super().__init__(*names, expose_value=False, callback=_keep, **settings)


class Command(click.Command):
    """A command whose help lists the options about reading in a section of their own."""

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        sections: dict[str, list[tuple[str, str]]] = {"Options": [], SECTION: []}
        for parameter in self.get_params(ctx):
            if record := parameter.get_help_record(ctx):
                sections[SECTION if isinstance(parameter, Option) else "Options"].append(record)
        for title, records in sections.items():
            if records:
                with formatter.section(title):
                    formatter.write_dl(records)


def _keep(context: click.Context, parameter: click.Parameter, value: Any) -> None:
    values = context.meta.setdefault(_VALUES, {})
    values[parameter.name] = value
    if parameter.name and context.get_parameter_source(parameter.name) is ParameterSource.COMMANDLINE:
        context.meta.setdefault(_NAMED, {})[parameter.name] = parameter.opts[0]


def drawing(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options about reading to a command."""
    for names, settings in reversed(_OPTIONS):
        command = click.option(*names, cls=Option, **settings)(command)
    return command


_OPTIONS: list[tuple[tuple[str, ...], dict[str, Any]]] = [
    (("--robot",), {"metavar": "ROBOT", "help": 'Take the robot from a file, or a footprint "[[0.3, 0.2], ...]".'}),
    (("--role", "roles"), {"multiple": True, "metavar": "NAME=ROLE",
     "help": "Give a layer, group or name a role: robot, obstacle, workspace or ignore."}),
    (("--tolerance",), {"type": float, "metavar": "E", "show_default": "size / 1000",
     "help": "Limit the error of polygons for curves, in the scene's unit."}),
    (("--units",), {"metavar": "UNIT", "help": "Name the unit of a file that names none: mm, m, in ..."}),
    (("--scale",), {"metavar": "S", "help": "Multiply the lengths of SCENE by S, as in 0.001 or 1/12."}),
    (("--pivot",), {"metavar": "PIVOT", "help": "Move the robot's reference point to its centroid, or to X,Y."}),
    (("--frame",), {"metavar": "NAME", "help": "Name the frame of the scene in answers, as in the header of ROS poses.",
     "show_default": "a map's: map"}),
    (("--padding",), {"type": click.FloatRange(min=0), "default": 0.0, "metavar": "D",
     "help": "Pad the robot by D, as nav2 pads a footprint."}),
    (("--join",), {"type": click.FloatRange(min=0), "metavar": "D", "show_default": "size / 1,000,000",
     "help": "Close gaps of a drawing up to D; 0 closes none."}),
    (("--join-holes",), {"is_flag": True, "help": "Let outlines that --join closes be holes."}),
    (("--heal",), {"type": click.FloatRange(min=0), "default": 0.0, "metavar": "LENGTH", "show_default": "none",
     "help": "Make arcs exactly tangent to lines and arcs if that moves them by LENGTH at most."}),
    (("--strokes",), {"metavar": "WIDTH", "default": "ignore", "show_default": True,
     "help": "Make walls of unfilled lines of SCENE, of this width or as drawn; ignore: none."}),
    (("--holes",), {"type": Word(["outlines", "nested"]), "default": "outlines", "show_default": True,
     "help": "Make holes in SVG of outlines drawn in pieces alone, or of all nested unfilled elements."}),
    (("--fills",), {"type": Word(["outlines", "hatches"]), "default": "outlines", "show_default": True,
     "help": "Fill DXF outlines, or the hatches of a layer alone."}),
    (("--space",), {"metavar": "LAYOUT", "help": "Read this layout of SCENE, a DXF file.", "default": "",
     "show_default": "model space"}),
    (("--language",), {"metavar": "LANG", "default": "en", "show_default": True,
     "help": "Choose branches of SVG by this language."}),
    (("--repair/--no-repair",), {"default": None, "show_default": "in drawings, not in JSON",
     "help": "Mend outlines that cross themselves by their fill rule."}),
    (("--min-area",), {"type": click.FloatRange(min=0), "default": 0.0, "metavar": "A",
     "help": "Leave out obstacles of a drawing of less area; an assumption of the answer."}),
    (("--unknown",), {"type": Word(["obstacle", "free"]), "default": "obstacle", "show_default": True,
     "help": "Treat unknown cells of a map as this."}),
    (("--map-rules",), {"type": Word(["strict", "nav2", "nav2-old", "ros1"]), "default": "strict", "show_default": True,
     "help": "Read the greys of a map as this server does; strict: a cell is free only if it is for all."}),
    (("--occupied",), {"type": click.IntRange(1, 100), "metavar": "N", "show_default": "1",
     "help": "Forbid cells of a map in scale or raw mode from N of 100 up."}),
    (("--free-thresh",), {"type": click.FloatRange(0, 1), "metavar": "T", "show_default": "the map's",
     "help": "Take this threshold of free cells."}),
    (("--unknown-grey",), {"type": click.IntRange(0, 255), "metavar": "G", "help": "Take this grey as unknown."}),
    (("--despeckle",), {"type": click.IntRange(min=0), "default": 0, "metavar": "N",
     "help": "Free occupied specks of fewer than N cells; an assumption of the answer."}),
]  # fmt: skip


def refuse_all(why: str) -> None:
    """Refuse all options about reading that are on the command line.

    Raises
    ------
    ValueError
        If there is one; the message names it and the reason.
    """
    if names := [*_named().values()]:
        raise ValueError(f"{', '.join(names)}: {why}; leave {'it' if len(names) == 1 else 'them'} out")


def refuse(why: str, *names: str) -> None:
    """Refuse some options about reading that are on the command line.

    Raises
    ------
    ValueError
        If there is one; the message names it and the reason.
    """
    for name in names:
        if name in _named():
            raise ValueError(f"{_named()[name]}: {why}; leave it out")


def refuse_unused(forms: tuple[str, ...], *, curved: bool) -> None:
    """Refuse options that have no effect on files of these formats.

    Raises
    ------
    ValueError
        If there is one; the message names it and the formats on which it has an effect.
    """
    for name, option in _named().items():
        wanted = FORMS.get(name)
        if wanted and not set(wanted) & set(forms) and not (name == "tolerance" and curved):
            kinds = " or ".join(", ".join(wanted).rsplit(", ", 1))
            read = " and ".join(dict.fromkeys(forms))
            raise ValueError(f"{option}: only for {kinds}, and this file is read as {read}; leave it out")


def tolerance() -> float | None:
    """Return the value of --tolerance."""
    error: float | None = _values().get("tolerance")
    return error


def options_of_reading(*, curves: bool = True) -> Reading:
    """Return the options of reading on the command line; with `curves` curves stay curves.

    Raises
    ------
    ValueError
        If a value makes no sense, with the option, the value and the remedy.
    """
    from dataclasses import fields

    from cfree.formats.drawings.source import Reading

    values = dict(_values())
    values |= {
        "roles": _roles(values.get("roles", ())),
        "strokes": _strokes(values.get("strokes", "ignore")),
        "scale": _scale(values.get("scale")),
        "units": values.get("units") or "",
    }
    names = {field.name for field in fields(Reading)}
    return Reading(**{name: value for name, value in values.items() if name in names}, curves=curves)


def pivot() -> Pivot | None:
    """Return the value of --pivot.

    Raises
    ------
    ValueError
        If it is neither "centroid" nor a point.
    """
    from cfree.exact.number import to_fraction

    text: str | None = _values().get("pivot")
    if text is None:
        return None
    if text == "centroid":
        return "centroid"
    try:
        x, y = map(to_fraction, text.split(","))
    except ValueError:
        raise ValueError(f'--pivot: {text!r}; give centroid, or X,Y as in "0.5,1/3"') from None
    return x, y


def framed(shapes: Shapes) -> Shapes:
    """Return shapes whose scene has the frame of --frame, if it is given."""
    from dataclasses import replace

    name: str | None = _values().get("frame")
    if name is None:
        return shapes
    source = {**shapes.settings.get("source", {}), "frame": name}
    return replace(shapes, settings={**shapes.settings, "source": source})


def robot(reading: Reading) -> Any:
    """Read the polygon of a footprint, or the shapes of a file; None if there is no --robot."""
    from cfree.formats.drawings.footprints import footprint
    from cfree.formats.scene_file import read_shapes

    text: str | None = _values().get("robot")
    if text is None:
        return None
    if text.lstrip()[:1] in ("[", "("):
        return footprint(text)
    return read_shapes(text, reading.of_robot)


def remedy_for_solids(scene: Scene, poses: Sequence[Pose]) -> str:
    """Return the options that change a closed line of a drawing around a pose, or nothing if there is none."""
    context = click.get_current_context()
    if context.meta.get(_FORM) not in _DRAWINGS or _values().get("strokes") != "ignore":
        return ""
    from shapely import Point

    from cfree.scene.scene import polygons_for, size_of

    names = [
        name
        for name, shape in zip(scene.obstacle_names, scene.obstacles, strict=True)
        for polygon in polygons_for(shape, size_of(shape) / 100, True)
        if any(polygon.to_shapely().contains(Point(float(pose.x), float(pose.y))) for pose in poses)
    ]
    if not names:
        return ""
    role = f"--role {names[0]!r}=workspace".replace("'", '"') if " " in names[0] else f"--role {names[0]}=workspace"
    return f"; if the lines of {names[0]} are walls: --strokes drawn, or --strokes WIDTH; if they are the room: {role}"


def keep_form(form: str) -> None:
    """Keep the format of SCENE for `remedy_for_solids`."""
    click.get_current_context().meta[_FORM] = form


def words() -> list[str]:
    """Return the options about reading that are on the command line."""
    result = []
    for name, option in _named().items():
        value = _values()[name]
        if isinstance(value, bool):
            result.append(option if value else f"--no-{option.removeprefix('--')}")
        else:
            result += [word for one in (value if isinstance(value, tuple) else [value]) for word in (option, str(one))]
    return result


def _values() -> dict[str, Any]:
    context = click.get_current_context(silent=True)
    return {} if context is None else context.meta.get(_VALUES, {})


def _named() -> dict[str, str]:
    context = click.get_current_context(silent=True)
    return {} if context is None else context.meta.get(_NAMED, {})


def _roles(texts: tuple[str, ...]) -> dict[str, str]:
    pairs = [text.rpartition("=") for text in texts]
    if wrong := next((text for text, (_, sign, _) in zip(texts, pairs, strict=True) if not sign), None):
        raise ValueError(f'--role: {wrong!r}; write it like "walls=obstacle"')
    return {name: role for name, _, role in pairs}


def _strokes(text: str) -> float | str:
    if text in ("ignore", "drawn"):
        return text
    try:
        return float(text)
    except ValueError:
        return text


def _scale(text: str | None) -> Fraction | None:
    from cfree.exact.number import to_fraction

    if text is None:
        return None
    try:
        return to_fraction(text)
    except ValueError:
        raise ValueError(f"--scale: {text!r}; give a number above 0, such as 0.001 or 1/12") from None
