"""Shapes of a file that knows polygons but not scenes: GeoJSON and WKT.

A shape's role says what it is for: ``robot``, ``obstacle`` (unless said otherwise) or ``workspace``.
"""

from __future__ import annotations

from dataclasses import dataclass

from cfree.formats.findings import Findings
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import Scene

ROLES = ("robot", "obstacle", "workspace")


@dataclass(frozen=True, slots=True)
class Shape:
    """A polygon of a file, and what it is for."""

    role: str
    name: str | None
    polygon: Polygon


def scene_from_shapes(findings: Findings, shapes: list[Shape], remedy: str) -> Scene:
    """Scene of the shapes of one file; `remedy` says how such a file marks the robot."""
    parts = {role: [shape for shape in shapes if shape.role == role] for role in ROLES}
    if not parts["robot"] and not len(findings):
        findings.at(0, "", f"there is no robot; {remedy}")
    if len(parts["workspace"]) > 1:
        findings.at(0, "", f"{len(parts['workspace'])} workspaces; give one polygon")
    findings.fail_if_any()
    return Scene(
        robot=[shape.polygon for shape in parts["robot"]],
        obstacles=[shape.polygon for shape in parts["obstacle"]],
        obstacle_names=[shape.name for shape in parts["obstacle"]],
        workspace=parts["workspace"][0].polygon if parts["workspace"] else None,
    )
