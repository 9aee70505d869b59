"""Listener to a long call of the core: receives its phases and progress, and can stop it."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from typing import Any

from cfree.errors import UndecidedError

Phase = Callable[[str], AbstractContextManager[Any]]
TOLD = "free space"  # the phase that reports its share to `progress` if it has no context


class OutOfWork(UndecidedError):
    """Raised within the planner when the contact patches for a query are used up."""


class Work:
    """Limit of the contact patches trimmed for one query, summed over all its scenes.

    Parameters
    ----------
    patches : int
    """

    def __init__(self, patches: int) -> None:
        self.patches = self.left = patches

    def spend(self, patches: int) -> None:
        """Subtract patches from those left.

        Raises
        ------
        OutOfWork
            If too few are left.
        """
        self.left -= patches
        if self.left < 0:
            raise OutOfWork(f"{self.patches:,} contact patches were not enough")


class Caller:
    """Listener of one call.

    Parameters
    ----------
    phase : callable
        Returns a context for the phase with a name. The context's value is called with the completed share, or is None.
    progress : callable, optional
        Called with the completed share of the free space, unless its phase's context has a callable value.
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
        """Begin a phase."""
        context = self._phase(name)
        share = context.__enter__()
        self._open.append((context, share if callable(share) else self._progress if name == TOLD else None))

    def end(self) -> None:
        """End the phase that began last."""
        context, _ = self._open.pop()
        context.__exit__(None, None, None)

    def share(self, share: float) -> None:
        """Report the completed share of the phase that began last."""
        report = self._open[-1][1] if self._open else self._progress
        if report is not None:
            report(share)

    def spend(self, patches: int) -> None:
        """Subtract contact patches from those left, if their number is limited."""
        if self._work is not None:
            self._work.spend(patches)

    def look(self) -> None:
        """Raise `KeyboardInterrupt` if the call is to stop; called ten times a second."""
        if self._stop is not None and self._stop.is_set():
            raise KeyboardInterrupt
