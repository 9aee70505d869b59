"""Tasks of tiles run here, one after the other, or on a cluster."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from cfree.errors import CfreeError

Task = Callable[..., Any]


class TaskError(CfreeError, RuntimeError):
    """A task that ends the processes it runs in; `tile` is the number of its tile."""

    def __init__(self, message: str, tile: int) -> None:
        super().__init__(message)
        self.tile = tile

    def __reduce__(self) -> tuple[Any, ...]:
        return TaskError, (str(self), self.tile)


def check_client(client: Any) -> None:
    """Check that it is a client of Dask's, or None."""
    if client is not None and not hasattr(client, "submit"):
        raise TypeError(f"client: {client!r} is a {type(client).__name__}; give a distributed.Client or None")


def run(task: Task, tiles: Sequence[tuple[int, tuple[Any, ...]]], client: Any) -> Iterator[tuple[int, Any]]:
    """Results of a task for some tiles, as they come.

    Parameters
    ----------
    task : callable
    tiles : pairs
        Pairs of a number, and the arguments of the task.
    client : distributed.Client, optional
        Its workers must share the folder; without one the tasks run here.

    Raises
    ------
    TaskError
        If a task has ended as many workers as the scheduler allows.
    ConnectionError
        If the cluster is gone.
    """
    if client is None:
        for tile, arguments in tiles:
            yield tile, task(*arguments)
        return
    from distributed import as_completed

    futures = {client.submit(task, *arguments, pure=False): tile for tile, arguments in tiles}
    try:
        for future in as_completed(list(futures)):
            tile = futures.pop(future)
            yield tile, _result(future, tile)
            future.release()  # the result is in its file
    finally:
        if futures:
            client.cancel(list(futures))


def _result(future: Any, tile: int) -> Any:
    from concurrent.futures import CancelledError

    from distributed.comm.core import CommClosedError
    from distributed.scheduler import KilledWorker

    try:
        return future.result()
    except (CancelledError, CommClosedError) as error:
        raise ConnectionError("the cluster is gone; finished files are kept: start both again") from error
    except KilledWorker as error:
        raise TaskError(
            f"tile {tile} has ended every worker that began it, perhaps for lack of memory; "
            "make tiles smaller, give workers more memory, or run without a cluster",
            tile,
        ) from error
