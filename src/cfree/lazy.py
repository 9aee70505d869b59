"""Import public names of a package from their files on first use, so that `import cfree` is quick."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any


def lazy_names(
    package: str, homes: Mapping[str, str], packages: str = ""
) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Return ``__getattr__``, ``__dir__`` and ``__all__`` of a package.

    Parameters
    ----------
    package : str
    homes : mapping of str to str
        File in the package -> its public names, separated by blanks.
    packages : str, optional
        Subpackages that are imported on first use, under their own names.
    """
    home = {name: file for file, names in homes.items() for name in names.split()}
    others = packages.split()

    def __getattr__(name: str) -> Any:
        if name in others:
            return import_module(f"{package}.{name}")
        if name not in home:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = getattr(import_module(f"{package}.{home[name]}"), name)
        setattr(sys.modules[package], name, value)
        return value

    def __dir__() -> list[str]:
        return sorted([*home, *others])

    return __getattr__, __dir__, list(home)
