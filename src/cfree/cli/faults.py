"""Faults of the command: a message in one line, and an exit code.

0    done; `plan`: a path; `verify`: verified; `cage`: caged, immobile; `disassemble`: the parts can be taken out
1    `plan`, `disassemble`: proved impossible; `verify`: refuted; `cage`: not caged, mobile; `audit`: a door is not
     passed; `nest`: parts overlap, or none has a place; nothing else
2    bad input, also on the command line, and files that cannot be read or written
3    a limit of time or memory; `plan`: no path, but perhaps one that touches
4    a bug in cfree
130  Ctrl-C; 141 a closed pipe (SIGPIPE); 143 SIGTERM
"""

from __future__ import annotations

import errno
import io
import math
import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, NoReturn

import click

from cfree.cli.terminal import printable

if TYPE_CHECKING:
    from cfree.scene.scene import Scene

REFUTED, BAD_INPUT, INCOMPLETE, BUG, INTERRUPTED = 1, 2, 3, 4, 130


@contextmanager
def own_exit_codes() -> Iterator[None]:
    """End the command with a code above in every case, also outside of `one_line_faults`."""
    if hasattr(signal, "SIGPIPE"):
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # Python ignores it
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    with one_line_faults():
        try:
            yield
        finally:
            if sys.stdout is not None:
                sys.stdout.flush()


@contextmanager
def one_line_faults() -> Iterator[None]:
    """Print a fault of the input in one message, without a traceback, and exit with its code."""
    from cfree.errors import CfreeError, InvariantError

    try:
        with _interrupts():
            yield
    except click.exceptions.Exit:
        raise
    except InvariantError as error:
        from cfree.scene.scene import Scene

        if isinstance(error.state, Scene):
            from cfree.formats.scene_file import scene_text
            from cfree.scene.reduction import smallest_scene

            smallest = smallest_scene(error.state, _contradicts_itself)
            fail(f"{error}, with this scene:\n{scene_text(smallest)}", BUG)
        fail(str(error), BUG)
    except (CfreeError, ValueError) as error:
        fail(str(error), BAD_INPUT)
    except MemoryError:
        fail("out of memory", INCOMPLETE)
    except OSError as error:
        name = error.filename
        if error.errno == errno.ENOSPC and name is None:  # errors of other files have a name
            name = "standard output"
            _discard_output()
        fail(f"{name}: {error.strerror}" if name and error.strerror else str(error), BAD_INPUT)
    except Exception as error:  # exit code 1 would look like an answer
        if isinstance(error, ImportError) and "pip install 'cfree[" in str(error):
            fail(str(error), BAD_INPUT)
        import traceback

        tell("".join(traceback.format_exception(error)))
        fail("this is a bug in cfree, please report it", BUG)


@contextmanager
def _interrupts() -> Iterator[None]:
    """End the command on Ctrl-C, also if another error hides it, as when it stops the import of a compiled module."""
    try:
        yield
    except (KeyboardInterrupt, Exception) as error:
        links: list[BaseException] = [error]
        while (link := links[-1].__cause__ or links[-1].__context__) and link not in links:
            links.append(link)
        if not any(isinstance(link, KeyboardInterrupt) for link in links):
            raise
        exec("")  # else Python, interrupted in an exec of dataclasses, would end by the signal, not by the code
        fail("interrupted; no file was left half-written", INTERRUPTED)


def _contradicts_itself(scene: Scene) -> bool:
    from cfree.errors import InvariantError
    from cfree.forbidden.boundary import boundary

    try:
        return not boundary(scene, threads=1, max_seconds=math.inf).complex
    except InvariantError:
        return True


def fail(message: str, code: int) -> NoReturn:
    """Print the message and exit."""
    tell(f"error: {message}")
    sys.exit(code)


def tell(text: str) -> None:
    if sys.stderr is not None:
        with suppress(OSError, ValueError):  # standard error is closed
            print(printable(text), file=sys.stderr)


def _discard_output() -> None:
    """Drop unwritten output, so that Python does not try to write it again at the end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
