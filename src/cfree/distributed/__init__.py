"""Boundaries too large for one process: scenes divided into tiles, on this machine or on a cluster."""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.distributed.building import boundary as boundary
    from cfree.distributed.mapping import map as map
    from cfree.distributed.running import TaskError as TaskError
    from cfree.distributed.sharded import Sharded as Sharded

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "building": "boundary",
        "mapping": "map",
        "running": "TaskError",
        "sharded": "Sharded",
    },
)
