"""Analysis of a scene: margins, bottlenecks, blocking obstacles, fits of a part in a hole."""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.analysis.bottleneck import Bottleneck as Bottleneck

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "bottleneck": "Bottleneck",
    },
)
