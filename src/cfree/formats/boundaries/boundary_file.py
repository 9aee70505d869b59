"""Read and write boundaries: NumPy archives with the scene's text; ``docs/boundary-format.md`` describes them."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

import cfree._core as _core
from cfree.arguments import checked
from cfree.contact.kind import Kind
from cfree.errors import FormatError, UnsupportedError
from cfree.forbidden.boundary import Boundary, boundary_of
from cfree.forbidden.columns import COLUMNS, ISOLATED_COLUMNS, IsolatedParts, Trapezoids
from cfree.forbidden.record import Stats
from cfree.formats.boundaries.header import FAULTS, signed
from cfree.formats.text.atomic import checked_suffix, replacing
from cfree.free.space import FreeSpace
from cfree.scene.features import SceneFeatures, grown_features, unpacked
from cfree.scene.rounded import rounded_shapes, why_not_rounded

CELL_COLUMNS = ("component", "parent", "free_inside", "turns", "lift")
PATCH_COLUMNS = ("contact_kind", "contact_robot", "contact_obstacle", "trimmed")
FORMAT = "cfree-boundary"
AMONG_POLYGONS, AMONG_ROUNDED = 3, 4
"""Versions of files: those with round shapes have circles and branches, which the older version had no names for."""
CIRCLES = [Kind.VERTEX_VERTEX | quadrant << 4 for quadrant in range(4)]
MOST_DEFLATED = 1032
"""Maximum number of bytes that one deflated byte can hold."""


def save_boundary(
    boundary: Boundary, path: str | os.PathLike[str], cells: Mapping[str, NDArray[Any]] | None = None
) -> None:
    """Write a boundary, with its cells if given; equal boundaries give equal files. Parquet holds the trapezoids."""
    from cfree.formats.scene_file import scene_text

    if check_boundary_path(path) == ".parquet":
        if cells:
            raise UnsupportedError(f"{os.fspath(path)}: cells are written as .npz only; name the file so")
        from cfree.formats.boundaries.boundary_table import save_table

        return save_table(boundary, path)
    arrays: dict[str, Any] = {"scene": np.frombuffer(scene_text(boundary.scene).encode(), np.uint8)}
    arrays |= {key: getattr(boundary, key) for key in PATCH_COLUMNS}
    arrays |= {name: getattr(boundary.trapezoids, name) for name in COLUMNS}
    arrays |= {f"isolated_{name}": getattr(boundary.isolated, name) for name in ISOLATED_COLUMNS}
    arrays |= cells or {}
    stats = {key: value for key, value in asdict(boundary.stats).items() if key != "seconds"}
    version = AMONG_ROUNDED if boundary.scene.curved else AMONG_POLYGONS
    header = signed({"format": FORMAT, "version": version, "stats": stats}, arrays)
    with replacing(path) as unfinished, unfinished.open("wb") as file:
        np.savez_compressed(file, header=np.frombuffer(json.dumps(header).encode(), np.uint8), **arrays)


def check_boundary_path(path: str | os.PathLike[str]) -> str:
    """Return the suffix of a file that `save_boundary` can write."""
    return checked_suffix(path, "boundary", (".npz", ".parquet"))


@checked
def load_boundary(path: str | os.PathLike[str]) -> Boundary:
    """Read a boundary written by `save`.

    Raises
    ------
    FormatError
        If the file is missing, truncated, damaged, or not of this format and version.
    """
    return _load(os.fspath(path))[0]


def read_boundary(path: str | os.PathLike[str]) -> Boundary:
    """Read a boundary and check only the form of its columns, without the core; `cfree.verify` judges their content."""
    return _read(os.fspath(path))[0]


def save_space(space: FreeSpace, path: str | os.PathLike[str]) -> None:
    """Write scene, boundary and nesting to one file, which `load_space` and `load_boundary` read."""
    save_boundary(space.boundary, path, {f"cells_{name}": getattr(space, name) for name in CELL_COLUMNS})


@checked
def load_space(path: str | os.PathLike[str]) -> FreeSpace:
    """Read a free space written by `save`.

    Raises
    ------
    FormatError
        If the file is missing, truncated, not of this format and version, or of a boundary without its cells.
    """
    name = os.fspath(path)
    return _space(name, *_load(name))


def load_archive(path: str | os.PathLike[str]) -> Boundary | FreeSpace:
    """Read the free space of an archive, or its boundary if it has no cells."""
    name = os.fspath(path)
    boundary, arrays = _load(name)
    return _space(name, boundary, arrays) if _cells(arrays) else boundary


def _space(name: str, boundary: Boundary, arrays: Mapping[str, NDArray[Any]]) -> FreeSpace:
    columns = _cells(arrays)
    wrong = _cells_misfit(boundary, **columns) if columns else "no cells are in it"
    if not wrong:
        component, parent, free_inside, turns, lift = (columns[column] for column in CELL_COLUMNS)
        space = FreeSpace(boundary, component, parent, free_inside, turns, lift)
        if len(space.component) == len(space.surfaces.trapezoids):
            return space
        wrong = "cells_component does not fit the rest"
    raise FormatError(f"{name}: {wrong}; make it again with `cfree.save`", path=name)


def _cells(arrays: Mapping[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
    """Return the columns of cells; none, if one is missing."""
    names = {f"cells_{column}": column for column in CELL_COLUMNS}
    return {names[key]: arrays[key] for key in names} if names.keys() <= arrays.keys() else {}


def _load(name: str) -> tuple[Boundary, dict[str, NDArray[Any]]]:
    """Read a boundary that contradicts neither its scene nor itself; return all columns of its file as well."""
    boundary, arrays = _read(name)
    if wrong := _inconsistent(boundary):
        raise _misfit(name, wrong)
    return boundary.shared, arrays


def _misfit(name: str, column: str) -> FormatError:
    return FormatError(f"{name}: {column} does not fit the rest; make it again with `cfree boundary`", path=name)


def _read(name: str) -> tuple[Boundary, dict[str, NDArray[Any]]]:
    def fault(what: str) -> FormatError:
        return FormatError(f"{name}: {what}", path=name)

    try:
        with open(name, "rb") as file, np.load(file, allow_pickle=False) as archive:
            if "header" not in archive:
                raise fault("a NumPy archive, but not a boundary; make one with `cfree boundary SCENE -o FILE`")
            header = json.loads(_member(archive, "header").tobytes())
            if header["format"] != FORMAT:
                raise fault(f'format {header["format"]!r}; expected "{FORMAT}"')
            if header["version"] not in (AMONG_POLYGONS, AMONG_ROUNDED):
                versions = f"versions {AMONG_POLYGONS} and {AMONG_ROUNDED}"
                raise fault(f"version {header['version']}; this cfree reads {versions}: compute it again")
            arrays = {key: _member(archive, key) for key in archive.files if key != "header"}
        if signed(header, arrays) != header:
            raise fault("damaged: it is not what was written; make it again with `cfree boundary`")
        stats = Stats(**header["stats"], seconds={})
        text = arrays["scene"].tobytes().decode()
        kind, robot, obstacle, trimmed = (arrays[k] for k in PATCH_COLUMNS)
        trapezoids = Trapezoids(*(arrays[column] for column in COLUMNS))
        isolated = IsolatedParts(*(arrays[f"isolated_{column}"] for column in ISOLATED_COLUMNS))
    except OSError as error:
        raise fault(f"{error.strerror or 'not a boundary file'}; give a file that `cfree boundary` wrote") from None
    except FormatError:
        raise
    except FAULTS:
        raise fault("truncated, damaged, or not a boundary file; make it again with `cfree boundary`") from None
    from cfree.formats.scene_file import scene_from_text

    scene = scene_from_text(f"{name}:scene", text)
    if scene.curved != (header["version"] == AMONG_ROUNDED):
        shapes = "round shapes" if scene.curved else "polygons"
        raise fault(f"version {header['version']}, but the scene has {shapes}; make it again with `cfree boundary`")
    if scene.curved and rounded_shapes(scene) is None:
        raise fault(f"{why_not_rounded(scene)}: no boundary has such a scene")
    features = grown_features(scene)
    wrong = misfit(features, kind, robot, obstacle, trapezoids, isolated)
    if trimmed.dtype != bool or trimmed.shape != np.shape(kind):
        wrong = "trimmed"
    if wrong:
        raise _misfit(name, wrong)
    return Boundary(scene, features, kind, robot, obstacle, trapezoids, isolated, stats, trimmed), arrays


def _member(archive: Any, name: str) -> NDArray[Any]:
    """Read an array, if its shape fits its size in the archive, and its packed bytes can hold that size."""
    info = archive.zip.getinfo(f"{name}.npy")
    with archive.zip.open(info) as member:
        if np.lib.format.read_magic(member) != (1, 0):
            raise ValueError
        shape, _, dtype = np.lib.format.read_array_header_1_0(member)
        size = member.tell() + math.prod(shape) * dtype.itemsize
    if size != info.file_size or size > MOST_DEFLATED * info.compress_size:
        raise ValueError
    array: NDArray[Any] = archive[name]
    return array


def _cells_misfit(boundary: Boundary, component: Any, parent: Any, free_inside: Any, turns: Any, lift: Any) -> str:
    """Return the fault of a column of cells, or an empty text."""
    faces, count = np.size(component), np.size(parent)
    types = {"component": (component, "i4", faces), "parent": (parent, "i4", count)}
    types |= {"free_inside": (free_inside, "?", count), "turns": (turns, "i4", count), "lift": (lift, "i4", faces)}
    for name, (array, dtype, length) in types.items():
        if array.dtype != dtype or array.shape != (length,):
            return f"cells_{name} does not fit the rest"
    if not np.array_equal(np.unique(component), np.arange(count)):
        return "cells_component does not number closed surfaces"
    if np.any((parent < -1) | (parent >= count)):
        return "cells_parent does not fit the rest"
    above = np.append(parent, -1)  # the last entry: no surface is around
    for _ in range(count.bit_length()):
        above = above[above]
    if np.any(above != -1):
        return "cells_parent is no nesting"
    free_around = np.where(parent >= 0, free_inside[parent], boundary.features.rim is None)
    return "cells_free_inside does not fit the rest" if np.any(~free_inside & ~free_around) else ""


def misfit(
    features: SceneFeatures, kind: Any, robot: Any, obstacle: Any, trapezoids: Trapezoids, isolated: IsolatedParts
) -> str:
    """Return the name of an array with a wrong type, length or value, or an empty text."""
    patches = np.size(kind)
    a, b = features.robot, features.obstacles
    edges, others = len(a.v) - 1, len(b.v) - 1

    def fits(array: Any, dtype: str, length: int, low: float, high: float) -> bool:
        if array.dtype != dtype or array.shape != (length,):
            return False
        return bool(np.all((array >= low) & (array <= high)))

    def column_fits(name: str, array: Any, count: int) -> bool:
        if name.endswith(("_lo", "_hi")):
            return fits(array, "f8", count, -1.001, 1.001)
        if name.endswith("patch"):
            return fits(array, "i4", count, 0, patches - 1)
        if name == "chart" or name.endswith("_place"):
            return fits(array, "u1", count, 0, 1 if name == "chart" else 4)
        if name.endswith("_t"):
            return fits(array, "f8", count, -np.inf, np.inf)
        if not fits(array, "u8", count, 0, ((6 if is_round else 5) << 61) - 1):
            return False
        _, i, j = unpacked(array[array > 0])
        return bool(np.all(i <= edges) and np.all(j <= others))

    is_round = bool(a.radius.any() or b.radius.any())
    contacts = {"contact_kind": (kind, "u1", 1, max(CIRCLES)), "contact_robot": (robot, "i4", 0, len(a.previous) - 1)}
    contacts["contact_obstacle"] = (obstacle, "i4", 0, len(b.previous) - 1)
    for name, (array, dtype, low, high) in contacts.items():
        if not fits(array, dtype, patches, low, high):
            return name
    if not np.isin(kind, [Kind.VERTEX_EDGE, Kind.EDGE_VERTEX, *(CIRCLES if is_round else [])]).all():
        return "contact_kind"
    for name in COLUMNS:
        if not column_fits(name, getattr(trapezoids, name), np.size(trapezoids.patch)):
            return name
    if np.any(np.diff(trapezoids.patch) < 0):
        return "patch"
    for name in ISOLATED_COLUMNS:
        if not column_fits(name, getattr(isolated, name), np.size(isolated.patch)):
            return f"isolated_{name}"
    return ""


def _inconsistent(boundary: Boundary) -> str:
    """Return the name of a column that contradicts the scene or the other columns, exactly, or an empty text."""
    if not boundary.scene.curved:
        return _core.misfit(boundary._handle, os.cpu_count() or 1)
    plain = _differing(boundary, regularized=False)
    return plain and _differing(boundary, regularized=True) and plain


def _differing(boundary: Boundary, *, regularized: bool) -> str:
    """Return the name of a column that differs from the boundary of the scene, which is computed again.

    Of an incomplete boundary only patches are compared: no question can be put to it.
    """
    threads, complete = os.cpu_count() or 1, boundary.complete
    core = _core.compute_boundary(boundary.features.core, threads, regularized, lambda share: complete)
    own = boundary_of(boundary.scene, boundary.features, core)
    columns = {name: (getattr(boundary, name), getattr(own, name)) for name in PATCH_COLUMNS[:3]}
    if complete:
        columns |= {name: (getattr(boundary.trapezoids, name), getattr(own.trapezoids, name)) for name in COLUMNS}
        isolated = {name: (getattr(boundary.isolated, name), getattr(own.isolated, name)) for name in ISOLATED_COLUMNS}
        columns |= {f"isolated_{name}": pair for name, pair in isolated.items()}
    return next((name for name, (ours, theirs) in columns.items() if not np.array_equal(ours, theirs)), "")
