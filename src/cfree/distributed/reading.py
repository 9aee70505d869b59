"""Sources of scenes for shards: a scene, or files that are read one shape after the other."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from cfree.collector import collection_paused
from cfree.distributed.shard import key_of
from cfree.errors import FormatError, InvalidPolygonError
from cfree.formats.drawings.geojson import geojson_shapes
from cfree.formats.scene_file import load_scene, load_shapes
from cfree.formats.text.findings import Findings
from cfree.formats.text.json_text import read_json
from cfree.polygons.polygon import Polygon
from cfree.scene.digest import stamp_of
from cfree.scene.reading import Note
from cfree.scene.scene import Scene

PathLike = str | os.PathLike[str]
Source = Scene | PathLike | Sequence[PathLike]
LINES = (".geojsonl", ".ndjson", ".jsonl")
PARQUET = (".parquet", ".geoparquet")
BLOCK = 1 << 20


def files_of(source: Source) -> list[Path]:
    """Files of a source, folders replaced by their files; none for a scene."""
    if isinstance(source, Scene):
        return []
    sources = [source] if isinstance(source, str | os.PathLike) else source
    files: list[Path] = []
    for path in map(Path, sources):
        files += sorted(p for p in path.iterdir() if p.is_file() and p.name[0] != ".") if path.is_dir() else [path]
    if not files:
        raise FormatError("no files: give a scene, or the file of one followed by files of obstacles")
    return files


def source_key(source: Source) -> str:
    """Short text that differs for different shapes."""
    if isinstance(source, Scene):
        return key_of("scene", stamp_of(source).sha256)
    digests = []
    for path in files_of(source):
        digest = hashlib.sha256()
        try:
            with path.open("rb") as file:
                while block := file.read(BLOCK):
                    digest.update(block)
        except OSError as error:
            raise FormatError(f"{path}: {error.strerror}", path=str(path)) from error
        digests.append(digest.hexdigest())
    return key_of("files", *digests)


def read_source(source: Source, notes: list[Note]) -> tuple[Scene, Iterator[Polygon]]:
    """Scene of a source, and the obstacles beside its own.

    Parameters
    ----------
    source : Scene, path, or sequence of paths
        The first file is a scene; each other is GeoJSON, WKT, GeoJSON in lines (``.geojsonl``, ``.ndjson``), or
        GeoParquet, all of whose polygons are obstacles. A folder stands for its files in the order of their names.
    notes : list of Note
        Gets the records of reading of the files of obstacles, each after its obstacles.
    """
    if isinstance(source, Scene):
        return source, iter(())
    first, *others = files_of(source)
    return load_scene(first), (polygon for path in others for polygon in _polygons(path, notes))


def notes_of(path: Path) -> tuple[Note, ...]:
    """Record of reading of one file; tables and GeoJSON in lines have none."""
    streamed = path.is_dir() or path.suffix.lower() in (*LINES, *PARQUET)
    return () if streamed else load_shapes(path).record


def _polygons(path: Path, notes: list[Note]) -> Iterator[Polygon]:
    suffix = path.suffix.lower()
    if suffix in LINES:
        yield from _in_lines(path)
    elif suffix in PARQUET:
        yield from _in_table(path)
    else:
        shapes = load_shapes(path)
        notes += shapes.record
        yield from shapes.polygons


def _in_lines(path: Path) -> Iterator[Polygon]:
    """One GeoJSON object a line; a fault is reported with its line."""
    number = 1
    try:
        with path.open(encoding="utf-8") as file, collection_paused():
            while line := file.readline():
                if text := line.strip("\x1e \t\r\n"):
                    findings = Findings(f"{path}:{number}", text)
                    shapes = geojson_shapes(findings, read_json(findings))
                    findings.fail_if_any()
                    for shape in shapes:
                        assert isinstance(shape.polygon, Polygon), "GeoJSON has no others"
                        yield shape.polygon
                number += 1
    except MemoryError as error:
        raise _fault(path, f"line {number}: too large for memory; cut the polygon into several") from error


def _in_table(path: Path) -> Iterator[Polygon]:
    """The column ``geometry`` of a table, as WKB; a group of rows at a time."""
    try:
        import pyarrow
        from pyarrow.parquet import ParquetFile
    except ImportError as error:
        message = "GeoParquet needs pyarrow; install it: pip install 'cfree[parquet]'"
        raise ImportError(message, name="pyarrow") from error
    import shapely

    row = 0
    try:
        with ParquetFile(path) as table:
            if "geometry" not in table.schema_arrow.names:
                raise _fault(path, f'no column "geometry" among {", ".join(table.schema_arrow.names)}')
            for batch in table.iter_batches(columns=["geometry"]):
                for value in batch.column(0).to_pylist():
                    row += 1
                    for part in shapely.get_parts(shapely.from_wkb(value)) if value is not None else ():
                        if part.geom_type != "Polygon":
                            raise _fault(path, f"row {row}: a {part.geom_type}; give polygons")
                        yield Polygon(part.exterior.coords[:], [ring.coords[:] for ring in part.interiors])
    except (pyarrow.ArrowException, shapely.errors.ShapelyError, TypeError, InvalidPolygonError) as error:
        raise _fault(path, f"row {row}: {error}" if row else str(error)) from error


def _fault(path: Path, message: str) -> FormatError:
    return FormatError(f"{path}: {message}", path=str(path))
