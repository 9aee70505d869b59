"""Boundaries in files: a NumPy archive with the scene's text inside; ``docs/boundary-format.md`` describes it."""

from __future__ import annotations

import json
import os
import zipfile
import zlib
from dataclasses import asdict
from typing import Any

import numpy as np

from cfree.errors import FormatError
from cfree.features import scene_features
from cfree.files import replacing
from cfree.forbidden import COLUMNS, Boundary, Stats, Trapezoids

FORMAT, VERSION = "cfree-boundary", 1


def save_boundary(boundary: Boundary, path: str | os.PathLike[str]) -> None:
    """Write a boundary; equal boundaries make equal files."""
    from cfree.io import scene_text

    stats = {key: value for key, value in asdict(boundary.stats).items() if key != "seconds"}
    header = {"format": FORMAT, "version": VERSION, "stats": stats}
    texts = {"header": json.dumps(header), "scene": scene_text(boundary.scene)}
    arrays: dict[str, Any] = {key: np.frombuffer(text.encode(), np.uint8) for key, text in texts.items()}
    arrays |= {key: getattr(boundary, key) for key in ("contact_kind", "contact_robot", "contact_obstacle")}
    arrays |= {name: getattr(boundary.trapezoids, name) for name in COLUMNS}
    with replacing(path) as unfinished, unfinished.open("wb") as file:
        np.savez_compressed(file, **arrays)


def load_boundary(path: str | os.PathLike[str]) -> Boundary:
    """Read a boundary written by `Boundary.save`.

    Raises
    ------
    FormatError
        If the file is missing, truncated, or not of this format and version.
    """
    name = os.fspath(path)

    def fault(what: str) -> FormatError:
        return FormatError(f"{name}: {what}", path=str(name))

    try:
        with open(name, "rb") as file, np.load(file, allow_pickle=False) as archive:
            if "header" not in archive:
                raise fault("a NumPy archive, but not a boundary; make one with `cfree boundary SCENE -o FILE`")
            header = json.loads(archive["header"].tobytes())
            if header["format"] != FORMAT:
                raise fault(f'format {header["format"]!r}; expected "{FORMAT}"')
            if header["version"] != VERSION:
                raise fault(f"version {header['version']}; this cfree reads version {VERSION}: compute it again")
            text = archive["scene"].tobytes().decode()
            kind, robot, obstacle = (archive[k] for k in ("contact_kind", "contact_robot", "contact_obstacle"))
            trapezoids = Trapezoids(*(archive[column] for column in COLUMNS))
    except OSError as error:
        raise fault(f"{error.strerror or 'not a boundary file'}; give a file that `cfree boundary` wrote") from None
    except (ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile, zlib.error) as error:
        if isinstance(error, FormatError):
            raise
        raise fault("truncated, damaged, or not a boundary file; make it again with `cfree boundary`") from None
    from cfree.io import scene_from_text

    scene = scene_from_text(f"{name}:scene", text)
    stats = Stats(**header["stats"], seconds={})
    return Boundary(scene, scene_features(scene), kind, robot, obstacle, trapezoids, stats)
