"""A process that does work in small parts, and is replaced when one hangs or crashes."""

from __future__ import annotations

import contextlib
import multiprocessing
import signal
from collections.abc import Callable, Iterator
from multiprocessing.connection import Connection
from typing import Any


class Lost(Exception):
    """The work ended without an answer; says how."""


class Worker:
    """Runs `work` on what it is asked, in a process of its own.

    Parameters
    ----------
    work : callable
        Of what may be sent to a process, to what may be sent back.
    patience : float, seconds
        After which it is killed.
    """

    def __init__(self, work: Callable[[Any], Any], patience: float) -> None:
        self.work, self.patience = work, patience
        self._start()

    def _start(self) -> None:
        context = multiprocessing.get_context("fork")
        self.connection, theirs = context.Pipe()
        self.process = context.Process(target=_serve, args=(self.work, theirs, self.connection), daemon=True)
        self.process.start()
        theirs.close()

    def ask(self, question: Any) -> Any:
        """The answer; `Lost` if there is none in time, or the process has died."""
        self.connection.send(question)
        try:
            if self.connection.poll(self.patience):
                return self.connection.recv()
            fate = f"hangs for {self.patience:g} s"
        except EOFError:
            fate = "crashes"
        self.process.kill()
        self.process.join()
        if fate == "crashes":
            fate += f", exit code {self.process.exitcode}"
        self._start()
        raise Lost(fate)


def _serve(work: Callable[[Any], Any], connection: Connection, other: Connection) -> None:
    """Until the one who asks is gone, whose end a forked process has, too."""
    other.close()
    with contextlib.suppress(EOFError, BrokenPipeError):
        while True:
            connection.send(work(connection.recv()))


@contextlib.contextmanager
def limited(seconds: float) -> Iterator[None]:
    """A TimeoutError in the middle after so much time of all cores, if Python is there to raise it."""

    def stop(*_: Any) -> None:
        raise TimeoutError(f"not finished after {seconds:g} s")

    signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
