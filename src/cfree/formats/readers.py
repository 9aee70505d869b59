"""Choose the reader of a file by its suffix; for JSON and text, by its content."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from contextlib import suppress
from importlib import import_module
from os import PathLike
from pathlib import Path
from typing import Any

from cfree.formats.drawings.geojson_features import AtOnce, ReadFeature
from cfree.formats.drawings.source import Progress, Reading, Source, shapes_of
from cfree.formats.scenes.scene_values import Fault, scene_from_plain
from cfree.formats.shapes import Shapes
from cfree.formats.text.archive import is_archive
from cfree.formats.text.findings import Findings, InvalidFileError, read_text, whole
from cfree.formats.text.json_text import read_literals, read_members, with_numbers
from cfree.scene.reading import together
from cfree.scene.scene import Scene, with_reading

DRAWINGS = {
    ".svg": "svg.read_svg",
    ".svgz": "svg.read_svg",
    ".dxf": "dxf.read_dxf",
    ".yaml": "ros.read_yaml",
    ".yml": "ros.read_yaml",
    ".map": "movingai.read_map",
    ".urdf": "urdf.read_urdf",
}
"""Readers in `drawings/` of files with these suffixes."""
IMAGES = {".pgm", ".ppm", ".pbm", ".png", ".bmp", ".gif", ".jpg", ".jpeg", ".tif", ".tiff", ".webp"}
"""Suffixes of images that maps refer to."""
YAML = (".yaml", ".yml")
MOST_BESIDE, MOST_HEAD = 50, 1 << 14
"""Maximum number of files searched beside an image, and of characters read from each."""


def is_drawing(path: str | PathLike[str]) -> bool:
    """True if the suffix has a reader of its own."""
    return Path(path).suffix.lower() in DRAWINGS


def read_file(
    path: str | PathLike[str], reading: Reading | None = None, progress: Progress | None = None
) -> Shapes | Scene:
    """Read a file: a scene if it is complete, else shapes; drawings report their progress, see `Source`."""
    file = os.fspath(path)
    refuse_other_kinds(file)
    if is_drawing(file):
        module, name = DRAWINGS[Path(file).suffix.lower()].split(".")
        reader = getattr(import_module(f"cfree.formats.drawings.{module}"), name)
        shapes: Shapes = reader(Source(file, reading=reading, progress=progress))
        return shapes
    findings = Findings(file, read_text(Path(file)))
    return read_wkt(findings, reading) if is_wkt(findings) else read_json_file(findings, reading)


def refuse_other_kinds(file: str) -> None:
    """Refuse boundaries, and images of maps.

    Raises
    ------
    InvalidFileError
        If the file is one of these, with its kind and the remedy.
    """
    path = Path(file)
    if is_archive(file):
        fault = "a boundary or free space, no scene; give the scene that it was computed for"
    elif path.suffix.lower() in IMAGES and path.is_file():
        fault = f"an image; give the file that describes it, {_yaml_of(path)}"
    else:
        return
    raise InvalidFileError(file, [whole(fault)])


def _yaml_of(image: Path) -> str:
    """Return the file beside an image that has its name or refers to it, or a description of such a file."""
    beside = [file for suffix in YAML for file in sorted(image.parent.glob(f"*{suffix}"))[:MOST_BESIDE]]
    for file in sorted(beside, key=lambda file: file.stem != image.stem):
        with suppress(OSError):
            with file.open(encoding="utf-8", errors="replace") as stream:
                head = stream.read(MOST_HEAD)
            if file.stem == image.stem or re.search(rf"^image:.*\b{re.escape(image.name)}\b", head, re.MULTILINE):
                return str(file)
    return f"a YAML file with the line image: {image.name}"


def is_wkt(findings: Findings) -> bool:
    """True if a file is WKT by its suffix or its content."""
    if Path(findings.file).suffix.lower() == ".wkt":
        return True
    return findings.text.lstrip()[:1] not in "{[" and bool(re.search("POLYGON", findings.text, re.IGNORECASE))


def read_wkt(findings: Findings, reading: Reading | None = None) -> Shapes:
    """Read the shapes of WKT."""
    from cfree.formats.drawings.wkt import wkt_shapes

    source = Source(findings.file, reading=reading)
    source.findings = findings
    return shapes_of(source, "WKT", wkt_shapes(findings, source), {}, "begin its line with robot:")


def quick_scene(data: object) -> Scene | None:
    """Return the scene of JSON with literals, if it has no fault; models are imported only for a record of reading."""
    if not isinstance(data, Mapping) or "reading" not in data:
        return scene_from_plain(data)
    from cfree.formats.scenes.reading_format import read_notes

    try:
        notes = read_notes(data["reading"])
    except Fault:
        return None
    scene = scene_from_plain({key: value for key, value in data.items() if key != "reading"})
    return scene and with_reading(scene, notes)


def read_json_file(findings: Findings, reading: Reading | None = None) -> Shapes | Scene:
    """Read a scene, GeoJSON, or a nesting instance from JSON."""
    source = Source(findings.file, reading=reading)
    source.findings = findings
    if not source.reading.repair and not findings:
        made = AtOnce()
        data = read_members(findings, made)
        if scene := quick_scene(data):
            return scene
        is_geojson = isinstance(data, ReadFeature) or (isinstance(data, Mapping) and "type" in data)
        if is_geojson and made.keeps_properties and not (isinstance(data, Mapping) and "answer" in data):
            return _read_geojson(source, data)
        del data
    data = read_literals(findings)
    if isinstance(data, Mapping) and "answer" in data and "robot" not in data:
        fault = "an answer of cfree plan, no scene; give the scene that it is for"
        raise InvalidFileError(findings.file, [whole(fault)])
    if isinstance(data, Mapping) and "type" in data:
        return _read_geojson(source, data)
    if isinstance(data, Mapping) and data.keys() & {"items", "Items"}:
        from cfree.formats.drawings.nesting import read_nesting

        instance: Shapes = read_nesting(source, with_numbers(data))
        return instance
    from cfree.formats.scenes.scene_format import scene_from_models

    data = with_numbers(data)
    if not source.reading.repair or not isinstance(data, Mapping):
        return scene_from_models(findings, data)
    from cfree.formats.drawings.mending import mended_scene

    scene = scene_from_models(findings, mended_scene(source, dict(data)))
    return with_reading(scene, together(scene.reading, tuple(source.notes)))


def _read_geojson(source: Source, data: object) -> Shapes:
    """Read the shapes of decoded GeoJSON."""
    from cfree.formats.drawings.geojson import geojson_shapes

    settings: dict[str, Any] = {}
    shapes = geojson_shapes(source.findings, with_numbers(data), settings, source)
    return shapes_of(source, "GeoJSON", shapes, settings, 'give its feature the property "role": "robot"')
