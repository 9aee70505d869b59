"""Arguments and options that several commands share."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import click
from click.core import ParameterSource

from cfree.cli.faults import one_line_faults

FILE = click.Path(path_type=Path)
COMPUTED = "only for a computation, and this boundary is already computed"
"""The reason to refuse limits of a computation for the file of a boundary."""


class Word(click.Choice[str]):
    """One of a few words; any other is refused in one line that names the option, the word and the allowed words."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        from cfree.arguments import one_of

        name = param.opts[0] if param is not None else "word"
        with one_line_faults():
            one_of(name, value, self.choices)
        return str(value)


Decorator = Callable[[Callable[..., Any]], Callable[..., Any]]


def file_option(*names: str, metavar: str, help: str, required: bool = False) -> Decorator:
    """Make an option for a file to write."""
    return click.option(*names, type=FILE, metavar=metavar, help=help, required=required)


scene = click.argument("scene", type=FILE)
picture = file_option("--picture", metavar="PNG", help="Write a figure: .png, .svg, .pdf ...")
threads = click.option(
    "--threads", type=click.IntRange(min=1), metavar="N", help="Use N threads.", show_default="all cores"
)
max_seconds = click.option(
    "--max-seconds", type=click.FloatRange(min=0), metavar="S",
    help="Limit the time of trimming to S seconds; then stop, incomplete.", show_default="no limit",
)  # fmt: skip
max_memory = click.option(
    "--max-memory",
    metavar="SIZE",
    help='Limit the memory to "500MB" or "4GB"; then stop, incomplete.',
    show_default="no limit",
)
workers = click.option("--workers", type=click.IntRange(min=1), metavar="N", help="Use N processes, by Dask.",
                       show_default="this process")  # fmt: skip
scheduler = click.option("--scheduler", metavar="ADDRESS", help="Use a Dask cluster that can access the folder.")
verbose = click.option("--verbose", "-v", is_flag=True, help="Show the counters of the work as well.")
as_json = click.option("--json", "as_json", is_flag=True, help="Print JSON, for machines.")


def refuse(why: str, *names: str, remedy: str = "") -> None:
    """Refuse options on the command line that would have no effect.

    Parameters
    ----------
    why : str
        The condition under which they have an effect.
    names : str
        Names of the command's parameters.
    remedy : str
        The remedy; by default to leave them out.

    Raises
    ------
    ValueError
        If any of the options is on the command line.
    """
    context = click.get_current_context()
    refused = [
        parameter.opts[0]
        for parameter in context.command.params
        if parameter.name in names and context.get_parameter_source(parameter.name) is ParameterSource.COMMANDLINE
    ]
    if refused:
        remedy = remedy or f"leave {'it' if len(refused) == 1 else 'them'} out"
        raise ValueError(f"{', '.join(refused)}: {why}; {remedy}")


def examples(*lines: str) -> str:
    """Format the end of a command's help: example lines that are not wrapped."""
    return "\b\nExamples:\n" + "\n".join(f"  {line}" for line in lines)


def vehicle(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of a vehicle, which `read_vehicle` reads, to a command."""
    for option in reversed(_VEHICLE):
        command = option(command)
    return command


_VEHICLE = (
    click.option(
        "--vehicle",
        type=Word(["car", "differential", "forklift", "any"]),
        metavar="WORD",
        help='Drive as a "car", "differential" drive or "forklift", about its fixed axle; "any" moves sideways.',
        show_default="the scene's",
    ),
    click.option("--turning-radius", metavar="R", help="Limit the arcs of a car; or LEFT,RIGHT."),
    click.option(
        "--axle", metavar="X,Y", help="Place the middle of the fixed axle, in the robot's frame.", show_default="0,0"
    ),
    click.option("--heading", metavar="ANGLE", help="Turn forward in the robot's frame.", show_default="0deg"),
    click.option(
        "--gears",
        type=Word(["both", "forward"]),
        metavar="WORD",
        help='Let a car go in "both" gears, or "forward" only.',
        show_default="both",
    ),
)
