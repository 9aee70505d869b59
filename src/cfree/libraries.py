"""numpy, shapely and flint, imported when first used: loading them takes longer than most plans.

Files that a plain plan imports take them from here. `tests/test_lazy.py` keeps them off its way.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any, ForwardRef, TypeGuard

if TYPE_CHECKING:
    import flint
    import numpy as np
    import shapely
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[Any]
    Floats = NDArray[np.float64]
    Ints = NDArray[np.int64]
    Int32s = NDArray[np.int32]
    Codes = NDArray[np.uint64]
    Flags = NDArray[np.bool_]
else:

    class _Later(ModuleType):
        """A module that is imported when an attribute of it is first used."""

        def __getattr__(self, name: str) -> Any:
            module = import_module(self.__name__)
            vars(self).update(vars(module))
            self.__class__ = ModuleType  # from now on as quick as the module
            return getattr(module, name)

    class _ArrayOf:
        """`numpy.typing.NDArray`, of hints that are read as late."""

        def __getitem__(self, kind: Any) -> Any:
            return import_module("numpy.typing").NDArray[kind]

    def _hint(text: str) -> ForwardRef:
        """Return a type of numpy that `typing.get_type_hints` resolves."""
        return ForwardRef(text, module=__name__)

    flint, np, shapely = _Later("flint"), _Later("numpy"), _Later("shapely")
    NDArray = _ArrayOf()
    ArrayLike = _hint("np.typing.ArrayLike")
    Array, Floats, Ints = _hint("NDArray[Any]"), _hint("NDArray[np.float64]"), _hint("NDArray[np.int64]")
    Int32s, Codes, Flags = _hint("NDArray[np.int32]"), _hint("NDArray[np.uint64]"), _hint("NDArray[np.bool_]")

__all__ = [
    "Array", "ArrayLike", "Codes", "Flags", "Floats", "Int32s", "Ints", "NDArray", "flint", "is_array", "is_numpy",
    "np", "shapely",
]  # fmt: skip


def is_array(value: object) -> TypeGuard[Array]:
    """True if a value is an array of numpy, which it cannot be before numpy is imported.

    Examples
    --------
    >>> is_array(np.zeros(2)), is_array([0.0, 0.0])
    (True, False)
    """
    return is_numpy(value, "ndarray")


def is_numpy(value: object, kind: str) -> bool:
    """True if a value is of a type of numpy, given by its name.

    Examples
    --------
    >>> is_numpy(np.float32(1), "floating"), is_numpy(1.0, "floating")
    (True, False)
    """
    return "numpy" in sys.modules and isinstance(value, getattr(np, kind))
