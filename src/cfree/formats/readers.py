"""Which reader reads which file: by the suffix of its name, and JSON and text by what is in it."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from contextlib import suppress
from importlib import import_module
from os import PathLike
from pathlib import Path
from typing import Any

from cfree.formats.archive import is_archive
from cfree.formats.findings import Findings, InvalidFileError, read_text, whole
from cfree.formats.json_text import read_literals, with_numbers
from cfree.formats.scene_values import scene_from_plain
from cfree.formats.shapes import Shapes, shapes_of
from cfree.formats.source import Reading, Source
from cfree.scene.scene import Scene

DRAWINGS = {
    ".svg": "svg.read_svg",
    ".svgz": "svg.read_svg",
    ".dxf": "dxf.read_dxf",
    ".yaml": "ros.read_yaml",
    ".yml": "ros.read_yaml",
    ".urdf": "urdf.read_urdf",
}
"""Suffixes of files that only their own readers open."""
IMAGES = {".pgm", ".ppm", ".pbm", ".png", ".bmp", ".gif", ".jpg", ".jpeg", ".tif", ".tiff", ".webp"}
"""Suffixes of images, which maps name."""
YAML = (".yaml", ".yml")
MOST_BESIDE, MOST_HEAD = 50, 1 << 14
"""Files beside an image that are looked at, and characters of each."""


def is_drawing(path: str | PathLike[str]) -> bool:
    """Has it a reader of its own?"""
    return Path(path).suffix.lower() in DRAWINGS


def read_file(path: str | PathLike[str], reading: Reading | None = None) -> Shapes | Scene:
    """What is in a file: a scene if it says all of one."""
    file = os.fspath(path)
    refuse_other_kinds(file)
    if is_drawing(file):
        module, name = DRAWINGS[Path(file).suffix.lower()].split(".")
        found: Shapes = getattr(import_module(f"cfree.formats.{module}"), name)(Source(file, reading=reading))
        return found
    findings = Findings(file, read_text(Path(file)))
    return read_wkt(findings) if is_wkt(findings) else read_json_file(findings, read_literals(findings), reading)


def refuse_other_kinds(file: str) -> None:
    """See that a file is no boundary, and no image of a map.

    Raises
    ------
    InvalidFileError
        If it is one: what it is, and what to give instead.
    """
    path = Path(file)
    if is_archive(file):
        fault = "a boundary or free space, no scene; give the scene that it was computed for"
    elif path.suffix.lower() in IMAGES and path.is_file():
        fault = f"an image; give what says how to read it, {_yaml_of(path)}"
    else:
        return
    raise InvalidFileError(file, [whole(fault)])


def _yaml_of(image: Path) -> str:
    """The file beside an image of its name, or that names it; or words for it."""
    beside = [file for suffix in YAML for file in sorted(image.parent.glob(f"*{suffix}"))[:MOST_BESIDE]]
    for file in sorted(beside, key=lambda file: file.stem != image.stem):
        with suppress(OSError):
            with file.open(encoding="utf-8", errors="replace") as stream:
                head = stream.read(MOST_HEAD)
            if file.stem == image.stem or re.search(rf"^image:.*\b{re.escape(image.name)}\b", head, re.MULTILINE):
                return str(file)
    return f"a YAML file with the line image: {image.name}"


def is_wkt(findings: Findings) -> bool:
    """By the name of the file, or by what is in it."""
    if Path(findings.file).suffix.lower() == ".wkt":
        return True
    return findings.text.lstrip()[:1] not in "{[" and bool(re.search("POLYGON", findings.text, re.IGNORECASE))


def read_wkt(findings: Findings) -> Shapes:
    """The shapes that WKT holds."""
    from cfree.formats.wkt import wkt_shapes

    source = Source(findings.file)
    source.findings = findings
    return shapes_of(source, "WKT", wkt_shapes(findings), {}, "begin its line with robot:")


def read_json_file(findings: Findings, data: object, reading: Reading | None = None) -> Shapes | Scene:
    """The scene, the GeoJSON, or the nesting instance that JSON with literals is."""
    source = Source(findings.file, reading=reading)
    source.findings = findings
    if isinstance(data, Mapping) and "answer" in data and "robot" not in data:
        fault = "an answer of cfree plan, no scene; give the scene that it is for"
        raise InvalidFileError(findings.file, [whole(fault)])
    if isinstance(data, Mapping) and "type" in data:
        from cfree.formats.geojson import geojson_shapes

        settings: dict[str, Any] = {}
        shapes = geojson_shapes(findings, with_numbers(data), settings)
        return shapes_of(source, "GeoJSON", shapes, settings, 'give its feature the property "role": "robot"')
    if isinstance(data, Mapping) and data.keys() & {"items", "Items"}:
        from cfree.formats.nesting import read_nesting

        found: Shapes = read_nesting(source, with_numbers(data))
        return found
    if not findings and (scene := scene_from_plain(data)):
        return scene
    from cfree.formats.scene_format import scene_from_models

    return scene_from_models(findings, with_numbers(data))
