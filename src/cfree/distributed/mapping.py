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
    """Results of a function for many scenes, or whatever else it takes, in their order.

    Parameters
    ----------
    function : callable
        Of one argument. Workers of a cluster have to be able to import it.
    items : iterable
        Pairs of parts to be nested, scenes of a study of parameters ...
    client : distributed.Client, optional
        Without one the calls are made here, one after the other.
    progress : callable, optional
        Called with how many of how many are done.

    Returns
    -------
    list
        What the function returns.

    Raises
    ------
    TaskError
        If one call ends every worker that begins it; `tile` is its number.
    ImportError
        If a worker cannot import the function, or what its argument is made of.

    Examples
    --------
    >>> import cfree
    >>> scenes = [cfree.Scene([(0, 0), (1, 0), (0, 1)], [[(x, 0), (x + 1, 0), (x, 1)]]) for x in (2, 4)]
    >>> [found.stats.trapezoids for found in map(cfree.boundary, scenes)]
    [26, 26]
    """
    check_client(client)
    given = list(items)
    found: dict[int, Any] = {}
    calls = [(k, (item,)) for k, item in enumerate(given)]
    task: Callable[..., Any] = function
    if client is not None:
        import cloudpickle

        # in bytes, so that it is the call that fails where a worker cannot import something, and not the worker
        task, calls = _call, [(k, (cloudpickle.dumps((function, item)),)) for k, item in enumerate(given)]
    for number, result in run(task, calls, client):
        found[number] = result
        if progress is not None:
            progress(len(found), len(given))
    return [found[k] for k in range(len(given))]


def _call(given: bytes) -> Any:
    """A function and its argument, as the client has packed them."""
    function, item = pickle.loads(given)
    return function(item)
