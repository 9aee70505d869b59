"""One function for many scenes."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Iterable
from typing import Any, TypeVar

from cfree.arguments import checked
from cfree.distributed.running import check_client, run

T = TypeVar("T")


@checked
def map(
    function: Callable[..., Any],
    items: Iterable[Any],
    *,
    client: Any = None,
    progress: Callable[..., object] | None = None,
) -> list[Any]:
    """Results of a function for many scenes, or any other items, in their order.

    Parameters
    ----------
    function : callable
        Function of one argument. Workers of a cluster must be able to import it.
    items : iterable
        Pairs of parts to be nested, scenes of a study of parameters ...
    client : distributed.Client, optional
        Without one the calls are made here, one after the other.
    progress : callable, optional
        Function called with the number of results, and that of all items.

    Returns
    -------
    list
        Results of the function.

    Raises
    ------
    TaskError
        If one call ends every worker that begins it; `tile` is its number.
    ImportError
        If a worker cannot import the function, or a class of its argument.

    Examples
    --------
    >>> import cfree
    >>> scenes = [cfree.Scene([(0, 0), (1, 0), (0, 1)], [[(x, 0), (x + 1, 0), (x, 1)]]) for x in (2, 4)]
    >>> [found.stats.trapezoids for found in map(cfree.boundary, scenes)]
    [26, 26]
    """
    check_client(client)
    arguments = list(items)
    results: dict[int, Any] = {}
    calls = [(k, (item,)) for k, item in enumerate(arguments)]
    task: Callable[..., Any] = function
    if client is not None:
        import cloudpickle

        # in bytes, so that the call fails, and not the worker, if a worker cannot import something
        task, calls = _call, [(k, (cloudpickle.dumps((function, item)),)) for k, item in enumerate(arguments)]
    for number, result in run(task, calls, client):
        results[number] = result
        if progress is not None:
            progress(len(results), len(arguments))
    return [results[k] for k in range(len(arguments))]


def _call(packed: bytes) -> Any:
    """Call a function with its argument, both packed by the client."""
    function, item = pickle.loads(packed)
    return function(item)
