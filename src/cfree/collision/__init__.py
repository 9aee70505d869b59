"""Exact collision checks of poses and motions; distances from obstacles."""

from typing import TYPE_CHECKING

from cfree.lazy import lazy_names

if TYPE_CHECKING:
    from cfree.collision.motion import rotations as rotations
    from cfree.collision.motion_checker import FirstContact as FirstContact
    from cfree.collision.nearest_free import free_nearby as free_nearby
    from cfree.collision.slide import Touch as Touch

__getattr__, __dir__, __all__ = lazy_names(
    __name__,
    {
        "motion": "rotations",
        "motion_checker": "FirstContact",
        "nearest_free": "free_nearby",
        "slide": "Touch",
    },
)
