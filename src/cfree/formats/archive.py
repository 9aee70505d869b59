"""Which files are archives of arrays, as boundaries are written."""

from __future__ import annotations

from os import PathLike


def is_archive(path: str | PathLike[str]) -> bool:
    """Does the file begin as a NumPy archive does? No scene does; what cannot be read is none."""
    try:
        with open(path, "rb") as file:
            return file.read(2) == b"PK"
    except (OSError, ValueError):  # a name with a null byte is none of a file
        return False
