"""Files of a folder that others may be writing to: complete or absent, and checked against their checksums.

Every file has a SHA-256: JSON and shards in themselves, all others in the JSON or the shard written after them.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree.errors import FormatError
from cfree.formats.boundaries.header import FAULTS, signed
from cfree.formats.text.atomic import replacing

Shard = dict[str, NDArray[Any]]
VERSION = 4
REMEDY = "compute the boundary into this folder again, which mends it: cfree boundary SCENE --folder FOLDER"


def damaged(path: Path, what: object = "damaged") -> FormatError:
    """Error that names the remedy for a damaged file of a folder."""
    return FormatError(f"{path}: {what}; {REMEDY}", path=str(path))


def _refused(path: Path, error: Exception) -> FormatError:
    return damaged(path, (error.strerror or "cannot be read") if isinstance(error, OSError) else "damaged")


def write_shard(path: Path, arrays: Mapping[str, NDArray[Any]], key: str) -> None:
    """Write columns with the key of their source, and a checksum; all of it or nothing."""
    header = json.dumps(signed({"version": VERSION, "key": key}, arrays))
    with replacing(path) as unfinished, unfinished.open("wb") as file:
        np.savez(file, header=np.frombuffer(header.encode(), np.uint8), **dict[str, Any](arrays))


def read_shard(path: Path, key: str | None = None) -> Shard:
    """The columns of a shard.

    Raises
    ------
    FormatError
        If it is not there, damaged, or computed from something else; the error names the remedy.
    """
    try:
        with path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
            arrays = {name: archive[name] for name in archive.files}
        header = json.loads(arrays.pop("header").tobytes())
        if header["version"] != VERSION:
            raise damaged(path, f"version {header['version']}, and this cfree reads {VERSION}")
        if key is not None and header["key"] != key:
            raise damaged(path, "computed from something else")
        if signed(header, arrays) != header:
            raise damaged(path)
    except FormatError:
        raise
    except (OSError, *FAULTS) as error:
        raise _refused(path, error) from error
    return arrays


def write_json(path: Path, value: Mapping[str, Any]) -> None:
    """Write an object with its SHA-256, `_sum_of`."""
    with replacing(path) as unfinished:
        text = json.dumps({**value, "sha256": _sum_of(value)}, indent=1)
        unfinished.write_text(text + "\n", encoding="utf-8")


def read_json(path: Path) -> dict[str, Any]:
    """Object that `write_json` has written.

    Raises
    ------
    FormatError
        If it is not there, or damaged; the error names the remedy.
    """
    try:
        value = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError) as error:
        raise _refused(path, error) from error
    if not isinstance(value, dict) or value.pop("sha256", None) != _sum_of(value):
        raise damaged(path)
    return value


def _sum_of(value: Mapping[str, Any]) -> str:
    return hashlib.sha256(json.dumps(value).encode()).hexdigest()


def changed(path: Path) -> tuple[int, int]:
    """Size of a file, and the time of its last change."""
    try:
        status = path.stat()
    except OSError as error:
        raise _refused(path, error) from error
    return status.st_size, status.st_mtime_ns


def file_sums(paths: Iterable[Path]) -> dict[str, str]:
    """The SHA-256 of files, by their names."""
    sums = {}
    for path in paths:
        with path.open("rb") as file:
            sums[path.name] = hashlib.file_digest(file, "sha256").hexdigest()
    return sums


def check_sums(folder: Path, sums: Mapping[str, str]) -> None:
    """Check that files are unchanged.

    Raises
    ------
    FormatError
        If one is not there, or another; the error names the remedy.
    """
    for name, digest in sums.items():
        path = folder / name
        try:
            (sha256,) = file_sums([path]).values()
        except OSError as error:
            raise _refused(path, error) from error
        if sha256 != digest:
            raise damaged(path)


def key_of(*parts: object) -> str:
    """Short text that identifies the source of a computation."""
    return hashlib.sha256(json.dumps(parts).encode()).hexdigest()[:32]
