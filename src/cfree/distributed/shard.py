"""Files of a folder that others may be writing to: whole or not there, and known to be as they were written."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cfree.errors import FormatError
from cfree.formats.atomic import replacing
from cfree.formats.header import FAULTS, signed

Shard = dict[str, NDArray[Any]]
VERSION = 1


def write_shard(path: Path, arrays: Mapping[str, NDArray[Any]], key: str) -> None:
    """Write columns with the key of what they were computed from, and a checksum; all of it or nothing."""
    header = json.dumps(signed({"version": VERSION, "key": key}, arrays))
    with replacing(path) as unfinished, unfinished.open("wb") as file:
        np.savez(file, header=np.frombuffer(header.encode(), np.uint8), **dict[str, Any](arrays))


def read_shard(path: Path, key: str | None = None) -> Shard:
    """The columns of a shard.

    Raises
    ------
    FormatError
        If it is not there, damaged, or computed from something else.
    """
    try:
        with np.load(path, allow_pickle=False) as archive:
            arrays = {name: archive[name] for name in archive.files}
        header = json.loads(arrays.pop("header").tobytes())
        if header["version"] != VERSION:
            raise FormatError(f"{path}: version {header['version']}; this cfree reads {VERSION}", path=str(path))
        if key is not None and header["key"] != key:
            raise FormatError(f"{path}: computed from something else", path=str(path))
        if signed(header, arrays) != header:
            raise FormatError(f"{path}: damaged", path=str(path))
    except FormatError:
        raise
    except (OSError, *FAULTS) as error:
        raise FormatError(f"{path}: {error or 'damaged'}", path=str(path)) from error
    return arrays


def write_json(path: Path, value: object) -> None:
    with replacing(path) as unfinished:
        unfinished.write_text(json.dumps(value, indent=1) + "\n", encoding="utf-8")


def read_json(path: Path) -> dict[str, Any]:
    """An object in a JSON file.

    Raises
    ------
    FormatError
        If there is none.
    """
    try:
        value = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise FormatError(f"{path}: {error}", path=str(path)) from error
    if not isinstance(value, dict):
        raise FormatError(f"{path}: expected an object", path=str(path))
    return value


def key_of(*parts: object) -> str:
    """One short text for what something is computed from."""
    return hashlib.sha256(json.dumps(parts).encode()).hexdigest()[:32]
