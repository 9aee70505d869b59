"""The core in the page, run by node, and the same columns from Python."""

from __future__ import annotations

import json
import shutil
import subprocess
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

import cfree
from cfree.exact.pose import Pose

NODE = shutil.which("node")
ENGINE = Path(__file__).parents[1] / "viewer" / "engine.mjs"


def asked(*calls: list[Any]) -> list[dict[str, Any]]:
    """Answers of the page's core to calls, one after the other."""
    page = files("cfree.viewer").joinpath("page.html")
    command = [str(NODE), str(ENGINE), str(page)]
    lines = "".join(json.dumps(call) + "\n" for call in calls)
    done = subprocess.run(command, input=lines, capture_output=True, text=True, check=True, timeout=300)
    return [json.loads(line) for line in done.stdout.splitlines()]


def columns_of(scene: cfree.Scene) -> dict[str, np.ndarray[Any, Any]]:
    """The same columns as in `show_columns`, from Python."""
    boundary = cfree.boundary(scene, threads=1)
    space = cfree.free_space(boundary)
    core, cells, surfaces = boundary._handle, boundary._complex_handle, space._handle.surfaces
    tables = (
        (core.trapezoids, "patch chart lower upper from_first from_second to_first to_second"),
        (core.trapezoids, "from_lo from_hi to_lo to_hi from_place to_place"),
        (cells, "face twin edge vertex side first component xy theta"),
        (surfaces, "parent free_inside"),
        (space, "turns lift"),
    )
    return (
        {f"patches.{name}": getattr(core.patches, name) for name in ("kind", "robot", "obstacle")}
        | {name: getattr(table, name) for table, names in tables for name in names.split()}
        | {"trimmed": core.trimmed, "cell_of": space._handle.cell_of, "depth": space._handle.depth}
    )


def said(pose: Pose) -> str:
    return f"{pose.x} {pose.y} {'inf' if pose.tau is None else pose.tau}"
