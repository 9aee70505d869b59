"""Who waits for a long call of the core: is told of its phases, and asked whether to go on."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from typing import Any

from cfree.errors import UndecidedError

Phase = Callable[[str], AbstractContextManager[Any]]
TOLD = "free space"  # the phase whose share is told without a context for it


class OutOfWork(UndecidedError):
    """Raised within the planner when the contact patches for a question are used up."""


class Work:
    """Contact patches that may be trimmed for one question, whatever the number of scenes it is asked of.

    Parameters
    ----------
    patches : int
    """

    def __init__(self, patches: int) -> None:
        self.patches = self.left = patches

    def spend(self, patches: int) -> None:
        """Count patches.

        Raises
        ------
        OutOfWork
            If none are left.
        """
        self.left -= patches
        if self.left < 0:
            raise OutOfWork(f"{self.patches:,} contact patches were not enough")


class Caller:
    """One for each call.

    Parameters
    ----------
    phase : callable
        Gives a context for the phase with a name, which gives what to call with its share, or None.
    progress : callable, optional
        Called with the share of the free space that is computed, unless its context gives what to call.
    max_seconds : float, optional
    stop : threading.Event, optional
        Ends the call when it is set.
    work : Work, optional
        Ends the call when it is used up.
    """

    def __init__(
        self,
        phase: Phase = nullcontext,
        progress: Callable[[float], object] | None = None,
        max_seconds: float | None = None,
        stop: threading.Event | None = None,
        work: Work | None = None,
    ) -> None:
        self.threads = os.cpu_count() or 1
        self.max_seconds = max_seconds
        self._phase, self._progress, self._stop, self._work = phase, progress, stop, work
        self.is_limited = work is not None
        self._open: list[tuple[AbstractContextManager[Any], Callable[[float], object] | None]] = []

    def begin(self, name: str) -> None:
        """Of a phase."""
        context = self._phase(name)
        share = context.__enter__()
        self._open.append((context, share if callable(share) else self._progress if name == TOLD else None))

    def end(self) -> None:
        """Of the phase that has begun last."""
        context, _ = self._open.pop()
        context.__exit__(None, None, None)

    def share(self, share: float) -> None:
        """Of the phase that has begun last."""
        told = self._open[-1][1] if self._open else self._progress
        if told is not None:
            told(share)

    def spend(self, patches: int) -> None:
        """Count contact patches, if their number is limited."""
        if self._work is not None:
            self._work.spend(patches)

    def look(self) -> None:
        """Ten times a second."""
        if self._stop is not None and self._stop.is_set():
            raise KeyboardInterrupt
