"""Scenes as texts: read, refused, and in the formats of other programs."""

import os
import random
from pathlib import Path
from typing import Any

import pytest

from cfree.errors import FormatError
from cfree.formats.scene_file import load_scene
from cfree.scene.scene import Scene

GEOJSON = """{"type": "FeatureCollection", "name": "map", "features": [
  {"type": "Feature", "properties": {"role": "robot", "colour": 3}, "id": 1,
   "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [0, 0.1], [0, 0]]]}},
  {"type": "Feature", "properties": {"name": "lakes"},
   "geometry": {"type": "MultiPolygon", "coordinates": [
     [[[5, 5, 80], [9, 5], [5, 9], [5, 5]], [[6, 6], [6, 7], [7, 6]]], [[[1, 5], [2, 5], [1, 6]]]]}},
  {"type": "Feature", "properties": {"role": "workspace"},
   "geometry": {"type": "Polygon", "coordinates": [[[-9, -9], [20, -9], [20, 20], [-9, 20]]]}},
  {"type": "Feature", "properties": null, "geometry": {"type": "GeometryCollection", "geometries": [
     {"type": "Polygon", "coordinates": [[[11, 5], [12, 5], [11, 6]]]}]}}
]}"""
WKT = """# a map
robot: POLYGON ((0 0, 1 0, 0 0.1, 0 0))

lakes: MULTIPOLYGON (((5 5, 9 5, 5 9, 5 5), (6 6, 6 7, 7 6)), ((1 5,2 5,1 6)))
workspace: Polygon((-9 -9, 20 -9, 20 20, -9 20))
POLYGON ((11 5, 12 5, 1.1e1 6))
"""


def place_in(data: Any, rng: random.Random, stop: float) -> tuple[Any, Any]:
    """Return a list or an object somewhere in JSON, and a key of it: one goes down, and stops with a probability."""
    part = data
    while isinstance(part, (dict, list)) and part:
        around, step = part, rng.choice([*part] if isinstance(part, dict) else range(len(part)))
        part = part[step]
        if rng.random() < stop:
            break
    return around, step


def read(directory: Path, text: str | bytes, name: str = "scene.json") -> Scene:
    file = directory / name
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    return load_scene(file)


def faults(directory: Path, text: str | bytes, name: str = "scene.json") -> list[str]:
    """Lines of the message, without the directory."""
    with pytest.raises(FormatError) as caught:
        read(directory, text, name)
    assert caught.value.path == str(directory / name)
    return str(caught.value).replace(f"{directory}{os.sep}", "").split("\n")
