"""What is in a file, before it is a scene: polygons with roles, poses and bounds, and what reading changed.

A shape's role says what it is for: ``robot``, ``obstacle`` (unless said otherwise) or ``workspace``; a ``part`` has
no place yet and is in no scene.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from cfree.arguments import checked
from cfree.errors import UnsupportedError
from cfree.formats.findings import InvalidFileError, whole
from cfree.formats.source import Source
from cfree.polygons.polygon import Polygon
from cfree.scene.scene import AnyShape, Scene, shapes_in

Role = Literal["robot", "obstacle", "workspace", "part"]
ROLES = ("robot", "obstacle", "workspace")
PART, IGNORE = "part", "ignore"
_MARK = re.compile(r"(robot|obstacle|workspace)(?![a-z])", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Shape:
    """A polygon of a file, or a round shape, and what it is for."""

    role: str
    name: str | None
    polygon: AnyShape


@dataclass(frozen=True, slots=True)
class Shapes:
    """The shapes of a file, and what reading did to them; `load_shapes` makes it.

    Attributes
    ----------
    form : str
        What kind of file it was, such as ``"SVG"``.
    shapes : tuple of Shape
        In the order of the file; each has a ``role``, a ``name`` or None, and a ``polygon``.
    settings : mapping
        What else of a scene the file says: bounds, start, goal, units and so on, as `Scene` takes them.
    changed, dropped : tuple of str
        What is in the file in another way, and what is in it but not here; one line for all of a kind.
    """

    form: str
    shapes: tuple[Shape, ...]
    settings: Mapping[str, Any] = field(default_factory=dict, hash=False)
    changed: tuple[str, ...] = ()
    dropped: tuple[str, ...] = ()
    file: str = ""
    remedy: str = ""

    @property
    def polygons(self) -> tuple[Polygon, ...]:
        """All of them, whatever their roles."""
        found = tuple(shape.polygon for shape in self.shapes if isinstance(shape.polygon, Polygon))
        if len(found) < len(self.shapes):
            raise UnsupportedError(f"{self.file}: there are round shapes; take the scene, and its outer(error)")
        return found

    @checked
    def of(self, role: Role) -> list[Shape]:
        """Those of one role: "robot", "obstacle", "workspace" or "part"."""
        return [shape for shape in self.shapes if shape.role == role]

    @checked
    def scene(self, robot: Any = None) -> Scene:
        """The scene that they make.

        Parameters
        ----------
        robot : shape or sequence of shapes, optional
            Instead of the file's robot; needed where it has none.

        Raises
        ------
        FormatError
            If there is no robot, or more than one workspace.
        """
        parts = [shape.polygon for shape in self.of("robot")] if robot is None else shapes_in(robot, "robot")
        rooms = self.of("workspace")
        if not parts:
            raise InvalidFileError(self.file, [whole(f"there is no robot; {self.remedy}")])
        if len(rooms) > 1:
            raise InvalidFileError(self.file, [whole(f"{len(rooms)} workspaces; give one polygon")])
        obstacles = self.of("obstacle")
        return Scene(
            robot=parts,
            obstacles=[shape.polygon for shape in obstacles],
            obstacle_names=[shape.name for shape in obstacles],
            workspace=rooms[0].polygon if rooms else None,
            **self.settings,
        )


def shapes_of(source: Source, form: str, shapes: list[Shape], settings: Mapping[str, Any], remedy: str) -> Shapes:
    """What a reader has found; raises the problems that it noted."""
    source.findings.fail_if_any()
    return Shapes(
        form,
        tuple(shapes),
        dict(settings),
        _lines(source.changed),
        _lines(source.dropped),
        source.findings.file,
        remedy,
    )


def _lines(counted: Counter[str]) -> tuple[str, ...]:
    return tuple(message if count == 1 else f"{message} ({count:,} times)" for message, count in counted.items())


def role_of(source: Source, *names: str | None) -> tuple[str, str | None]:
    """Role and name of a shape that is in groups or on a layer of these names, the innermost first.

    A name that begins with a role has it, in capital or small letters.

    Examples
    --------
    >>> role_of(Source("a.svg"), None, "Robot 2", "walls"), role_of(Source("a.svg"), "wall", "house")
    (('robot', None), ('obstacle', 'wall'))
    """
    given = [name for name in names if name]
    for name in given:
        if wanted := source.reading.roles.get(name):
            return wanted, name
    for name in given:
        if found := _MARK.match(name):
            role = found[1].lower()
            if role != "obstacle":
                return role, None
            return role, name if name.lower() != role else next((other for other in given if other != name), None)
    return "obstacle", given[0] if given else None
