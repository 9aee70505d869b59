"""`save` writes every value in a file of its kind; `load` reads them by their content."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from os import PathLike, fspath
from pathlib import Path as FilePath
from typing import Any

from cfree.analysis.reach_map import ReachMap, Which
from cfree.arguments import checked
from cfree.collector import collection_paused
from cfree.exact.half_angle import Rate
from cfree.forbidden.boundary import Boundary
from cfree.forbidden.mesh import Mesh
from cfree.forbidden.slice import Slice
from cfree.formats.answers.answer_file import Form, save_path, save_separation
from cfree.formats.answers.reach_file import save_reach
from cfree.formats.boundaries.boundary_file import load_archive, save_boundary, save_space
from cfree.formats.boundaries.mesh_file import save_mesh
from cfree.formats.boundaries.slice_geojson import save_slice
from cfree.formats.readers import is_drawing, is_wkt, read_json_file, read_wkt, refuse_other_kinds
from cfree.formats.scene_file import load_scene, save_scene
from cfree.formats.text.archive import is_archive
from cfree.formats.text.findings import Findings, read_text
from cfree.formats.text.json_text import read_literals, with_numbers
from cfree.free.space import FreeSpace
from cfree.paths.path import Path
from cfree.paths.stops import Stops
from cfree.planning.goals import AllSeparated
from cfree.planning.proof import Proof
from cfree.planning.separation import Separated
from cfree.planning.stuck import Stuck
from cfree.planning.unreachable import Unreachable
from cfree.scene.scene import Scene


@checked
def save(
    value: Scene | Boundary | FreeSpace | Path | Proof | AllSeparated | Mesh | Slice | ReachMap,
    path: str | PathLike[str],
    *,
    step: float | None = None,
    turn: float = math.radians(5),
    speed: float | None = None,
    acceleration: float | None = None,
    steer_rate: Rate | None = None,
    wheelbase: float | None = None,
    stops: Stops = "all",
    per_gear: bool = False,
    scene: Scene | None = None,
    form: Form | None = None,
    resolution: float | None = None,
    which: Which = "some",
) -> None:
    """Write a value to a file, all of it or nothing.

    Parameters
    ----------
    value : Scene, Boundary, FreeSpace, Path, Separated, Stuck, Unreachable, AllSeparated, Mesh, Slice or ReachMap
    path : path
        The suffix gives the format. Scenes: ``.json``, ``.geojson``, ``.svg`` or ``.dxf``. Boundaries: ``.npz``, or
        ``.parquet`` for a table of trapezoids. Free spaces: ``.npz``. Meshes: ``.glb``, ``.ply``, ``.obj`` or
        ``.stl``. Slices: ``.geojson``. Separations: ``.json``. Maps of reach: ``.yaml``, a ROS map with its image
        beside it, or ``.geojson``. Paths: ``.json``; for poses ``.csv``, ``.yaml`` (a ROS
        nav_msgs/Path) or ``.geojson`` with the robot's outlines.
    step, turn : float
        Sampling steps of paths, see `Path.sample`. The default step is a twentieth of the robot's radius, or a
        hundredth of the path length if the path has no robot.
    speed : float, optional
        Maximum speed of any point of the robot along a path, in lengths a second. It adds times to the poses, in
        seconds.
    acceleration, steer_rate, wheelbase, stops
        Further limits of a vehicle on its path, see `timed`; with `speed` only.
    per_gear : bool
        Write a ``.yaml`` for each run of a vehicle in one gear: ``way-1-forward.yaml``, ``way-2-backward.yaml``.
    scene : Scene, optional
        The scene of a path that was read from a file: needed for ``.geojson``, and for ``.json`` if that file had none.
    form : "json", "csv", "ros" or "geojson", optional
        The form of a path for file names with the suffix ``.txt`` or none.
    resolution, which
        Pixels of a map of reach, and the positions that are free in it; see `ReachMap.image`.

    Raises
    ------
    UnsupportedError
        If the suffix is another.
    ValueError
        If a scene is missing, an option of paths is given for another value, or `form` is another word.
    OSError
        If the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> scene = Scene(robot=[(0, 0), (1, 0), (0, 1)])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save(scene, f"{folder}/scene.json")
    ...     load(f"{folder}/scene.json") == scene
    True
    """
    if isinstance(value, Path) and resolution is None and which == "some":
        limits: dict[str, Any] = {"acceleration": acceleration, "steer_rate": steer_rate, "wheelbase": wheelbase}
        limits |= {"step": step, "turn": turn, "speed": speed, "stops": stops, "per_gear": per_gear}
        return save_path(value, path, **limits, scene=scene, form=form)
    options: dict[str, Any] = {"step": step, "speed": speed, "acceleration": acceleration, "steer_rate": steer_rate}
    options |= {"wheelbase": wheelbase, "stops": None if stops == "all" else stops, "per_gear": per_gear or None}
    options |= {"scene": scene, "form": form}
    if not isinstance(value, ReachMap) and (resolution is not None or which != "some"):
        raise ValueError(f"resolution, which: a {type(value).__name__} is no map of reach; leave them out")
    if wrong := next((name for name, option in options.items() if option is not None), None):
        raise ValueError(f"{wrong}: a {type(value).__name__} is no path; leave it out")
    match value:
        case Scene():
            save_scene(value, path)
        case Boundary():
            save_boundary(value, path)
        case FreeSpace():
            save_space(value, path)
        case Separated() | Stuck() | Unreachable() | AllSeparated():
            save_separation(value, path)
        case Mesh():
            save_mesh(value, path)
        case Slice():
            save_slice(value, path)
        case ReachMap():
            save_reach(value, path, resolution, which)


@checked
def load(path: str | PathLike[str]) -> Scene | Boundary | FreeSpace | Path | Proof | AllSeparated:
    """Read a scene, a boundary, a free space, a path or a separation; the file's content gives its kind.

    Raises
    ------
    FormatError
        If the file cannot be read, with place, value and remedy of every fault, ``file:line:column`` first.
    """
    with collection_paused():
        if is_archive(path):
            return load_archive(path)
        refuse_other_kinds(fspath(path))
        if is_drawing(path):
            return load_scene(path)
        text = read_text(FilePath(path))
        findings = Findings(fspath(path), text)
        if is_wkt(findings):
            return read_wkt(findings).scene()
        if re.search(r'"answer"|\\u', text):  # a key may be written with escapes
            data = read_literals(findings)
            if isinstance(data, Mapping) and "answer" in data:
                from cfree.formats.answers.answer_format import answer_from_json

                return answer_from_json(findings, with_numbers(data)).answer
            findings = Findings(fspath(path), text)
        content = read_json_file(findings)
        return content if isinstance(content, Scene) else content.scene()
