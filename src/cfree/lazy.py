"""Names imported when first used, so `import cfree` is quick: public names, and functions of later packages."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from importlib import import_module
from types import MappingProxyType
from typing import Any

_FUNCTIONS: dict[str, tuple[str, str]] = {}  # module and name of each registered function


def lazy_names(
    package: str, homes: Mapping[str, str], packages: str = "", moved: Mapping[str, str] = MappingProxyType({})
) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Return ``__getattr__``, ``__dir__`` and ``__all__`` of a package.

    Parameters
    ----------
    package : str
    homes : mapping of str to str
        Public names, separated by blanks, by their file in the package.
    packages : str, optional
        Subpackages that are attributes of it without an import, separated by blanks.
    moved : mapping of str to str, optional
        Names that were public here, separated by blanks, by the subpackage that has them now.
    """
    home = {name: file for file, names in homes.items() for name in names.split()}
    others = packages.split()
    left = {name: subpackage for subpackage, names in moved.items() for name in names.split()}

    def __getattr__(name: str) -> Any:
        if name in others:
            return import_module(f"{package}.{name}")
        if name in left:
            raise AttributeError(f"{package}.{name} is now {package}.{left[name]}.{name}")
        if name not in home:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = getattr(import_module(f"{package}.{home[name]}"), name)
        setattr(sys.modules[package], name, value)
        return value

    def __dir__() -> list[str]:
        return sorted([*home, *others])

    return __getattr__, __dir__, list(home)


def register(name: str, module: str, function: str) -> None:
    """Register a function of a later package for earlier ones; `registered` imports it.

    Only `cfree/__init__.py` calls this, so that no other file names a package after its own.
    """
    _FUNCTIONS[name] = module, function


def registered(name: str) -> Callable[..., Any]:
    """Import a registered function and return it."""
    module, function = _FUNCTIONS[name]
    result: Callable[..., Any] = getattr(import_module(module), function)
    return result
