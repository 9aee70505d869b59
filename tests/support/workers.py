"""A process that does work in small parts, and is replaced when one hangs or crashes."""

from __future__ import annotations

import contextlib
import multiprocessing
import signal
from collections.abc import Callable, Iterator
from multiprocessing.connection import Connection
from typing import Any


class Lost(Exception):
    """The work ended without an answer; the message gives the reason."""


class Worker:
    """A process that runs `work` on its questions.

    Parameters
    ----------
    work : callable
        Function from a value that can be sent to a process, to one that can be sent back.
    patience : float, seconds
        Time after which it is killed.
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
        """Answer of the process; `Lost` if there is none in time, or the process has died."""
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
    """Serve until the other end is closed; a forked process has a copy of it, which is closed first."""
    other.close()
    with contextlib.suppress(EOFError, BrokenPipeError):
        while True:
            connection.send(work(connection.recv()))


@contextlib.contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Raise a TimeoutError in the middle after so much time of all cores, if Python is there to raise it."""

    def stop(*_: Any) -> None:
        raise TimeoutError(f"not finished after {seconds:g} s")

    signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
