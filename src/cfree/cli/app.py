"""The command line: parse, call, print. Heavy modules are imported in the commands, so that help is quick."""

from __future__ import annotations

import click

from cfree.cli import reading
from cfree.cli.commands.boundary import boundary
from cfree.cli.commands.cage import cage
from cfree.cli.commands.disassemble import disassemble
from cfree.cli.commands.figures import figures
from cfree.cli.commands.film import film
from cfree.cli.commands.nest import nest
from cfree.cli.commands.plan import plan
from cfree.cli.commands.reach import aisle, audit, reach
from cfree.cli.commands.scenes import check, convert
from cfree.cli.commands.slice import cut
from cfree.cli.commands.verify import verify
from cfree.cli.commands.view import view
from cfree.cli.faults import own_exit_codes
from cfree.cli.options import examples


def main() -> None:
    """Run the command ``cfree``."""
    with own_exit_codes():
        app(prog_name="cfree")


@click.group(
    cls=reading.Commands,
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


SCENES = check, convert, boundary, plan, cut, film, view, verify, figures
TRADES = nest, cage, disassemble, reach, aisle, audit
for command in SCENES + TRADES:
    app.add_command(command)
