"""Options that take one of a few words: the same words as in Python, and every other one is refused in one line."""

import reprlib
from collections.abc import Iterator
from typing import Literal, get_args, get_type_hints

import click
import pytest
from click.testing import CliRunner

import cfree
from cfree.analysis.aisles import Kind
from cfree.analysis.reach_map import Which
from cfree.cli.app import app
from cfree.cli.options import Word
from cfree.film import Storyboard
from cfree.formats.answers.answer_file import Form
from cfree.nesting.compaction import Side
from cfree.nesting.placement import Toward
from cfree.paths.path import Objective
from cfree.paths.stops import Stops
from cfree.plot.rendered import Renderer
from cfree.vehicles.vehicle import Gears

SCENE = "examples/scenes/flat.json"
NEEDED = {"film": [SCENE, "-o", "film.gif"], "figures": ["-o", "figures"], "convert": [SCENE, "scene.svg"]}
OF_READING = {f"--{name.replace('_', '-')}": hint for name, hint in get_type_hints(cfree.load_shapes).items()}
SAME = {name: OF_READING[name] for name in ("--unknown", "--map-rules", "--holes", "--fills")} | {
    "--objective": Objective, "--format": Form, "--storyboard": Storyboard, "--renderer": Renderer,
    "--toward": Toward, "--compact": Side,
    "--kind": Kind, "--which": Which,
    "--critical": Literal["spread", "close", "size", "clearance", "all"],
    "--gears": Gears, "--stops": Stops, "--vehicle": Literal["car", "differential", "forklift", "any"],
}  # fmt: skip


def options() -> Iterator[tuple[str, click.Parameter]]:
    for name, command in app.commands.items():
        for option in command.params:
            if isinstance(option.type, click.Choice):
                yield name, option


OPTIONS = [*options()]


def test_the_options_of_words_are_found() -> None:
    assert {option.opts[0] for _, option in OPTIONS} == {*SAME}


@pytest.mark.parametrize(("command", "option"), OPTIONS, ids=[f"{name} {option.opts[0]}" for name, option in OPTIONS])
def test_a_word_that_is_no_option_is_refused_in_one_line(command: str, option: click.Parameter) -> None:
    assert isinstance(option.type, Word)
    words, name = [*option.type.choices], option.opts[0]
    assert tuple(words) == get_args(SAME[name])
    *others, last = [f'"{word}"' for word in words]
    listed = f"{', '.join(others)} or {last}"
    for wrong in ("occupied", "", words[0].upper(), f" {words[0]}", ",".join(words)):
        result = CliRunner().invoke(app, [command, *NEEDED.get(command, [SCENE]), name, wrong])
        assert (result.exit_code, result.stdout) == (2, "")
        assert result.stderr == f"error: {name}: {reprlib.repr(wrong)}; give {listed}\n"


@pytest.mark.parametrize("wrong", ["bmp", "", "svg,bmp", "PNG"])
def test_a_format_of_figures_that_is_none_is_refused_in_one_line(wrong: str) -> None:
    result = CliRunner().invoke(app, ["figures", "-o", "figures", "--format", wrong])
    assert result.exit_code == 2
    assert result.stderr == f'error: --format: {wrong.split(",")[-1]!r}; give "svg", "pdf" or "png"\n'


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["check", SCENE, "--role", "walls=occupied"], 'error: roles: walls: \'occupied\'; give "robot", "obstacle"'),
        (["plan", SCENE, "--prefer", "upward=3"], "error: --prefer: 'upward=3': no 'upward'; give some of sideways"),
    ],
)
def test_a_word_in_a_pair_that_is_no_option_is_refused_in_one_line(arguments: list[str], said: str) -> None:
    result = CliRunner().invoke(app, arguments)
    assert result.exit_code == 2 and result.stderr.startswith(said) and result.stderr.count("\n") == 1
