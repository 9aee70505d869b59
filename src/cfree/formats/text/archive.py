"""Recognise archives of arrays, which hold boundaries."""

from __future__ import annotations

from os import PathLike


def is_archive(path: str | PathLike[str]) -> bool:
    """True if the file begins as a NumPy archive, which no scene does; False if it cannot be read."""
    try:
        with open(path, "rb") as file:
            return file.read(2) == b"PK"
    except (OSError, ValueError):  # a name with a null byte is none of a file
        return False
