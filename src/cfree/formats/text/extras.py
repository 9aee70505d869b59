"""Import packages of cfree's extras when they are needed."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def needed(package: str, extra: str, what: str) -> Any:
    """Import a package.

    Raises
    ------
    ImportError
        If the package is missing, with the command that installs it.

    Examples
    --------
    >>> needed("no_such_package", "svg", "SVG")
    Traceback (most recent call last):
        ...
    ImportError: SVG needs no_such_package; install it: pip install 'cfree[svg]'
    """
    try:
        return import_module(package)
    except ImportError as error:
        message = f"{what} needs {package}; install it: pip install 'cfree[{extra}]'"
        raise ImportError(message, name=package) from error
