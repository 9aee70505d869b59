"""How the command leaves where something is wrong: a message in one line, and its exit code."""

from __future__ import annotations

import errno
import sys
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NoReturn

import typer

REFUTED, BAD_INPUT, INCOMPLETE, BUG, INTERRUPTED = 1, 2, 3, 4, 130


@contextmanager
def one_line_faults() -> Iterator[None]:
    """Say what is wrong with the input in one message, without a traceback, and leave with its exit code."""
    from cfree.errors import CfreeError, InvariantError

    try:
        yield
    except KeyboardInterrupt:
        fail("interrupted; no file was left half-written", INTERRUPTED)
    except InvariantError as error:
        from cfree.scene import Scene

        if isinstance(error.state, Scene):
            from cfree.io import scene_text

            fail(f"{error}, with this scene:\n{scene_text(error.state)}", BUG)
        fail(str(error), BUG)
    except (CfreeError, ValueError) as error:
        fail(str(error), BAD_INPUT)
    except typer.Exit:
        raise
    except OSError as error:
        if error.errno == errno.EPIPE:
            raise
        name = f"{error.filename}: " if error.filename else ""
        fail(f"{name}{error.strerror or error}", BAD_INPUT)
    except Exception:  # no answer: not to be taken for one
        traceback.print_exc()
        fail("this is a bug in cfree, please report it", BUG)


def fail(message: str, code: int) -> NoReturn:
    print(f"error: {message}", file=sys.stderr)
    raise typer.Exit(code)
