"""The content of a file before it is a scene: polygons with roles, poses and bounds, and the changes of reading.

A shape's role is ``robot``, ``obstacle`` (the default) or ``workspace``; a ``part`` has no place yet
and is in no scene.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from cfree.arguments import checked
from cfree.errors import UnsupportedError
from cfree.formats.text.findings import InvalidFileError, whole
from cfree.polygons.polygon import Polygon
from cfree.scene.reading import Note
from cfree.scene.scene import AnyShape, Scene, shapes_in

Role = Literal["robot", "obstacle", "workspace", "part"]
ROLES = ("robot", "obstacle", "workspace")
PART, IGNORE = "part", "ignore"


_CHANGED = ("guess", "assumption", "joined", "near", "mended", "info")


@dataclass(frozen=True, slots=True)
class Shape:
    """A polygon or a round shape of a file, and its role."""

    role: str
    name: str | None
    polygon: AnyShape


@dataclass(frozen=True, slots=True)
class Shapes:
    """The shapes of a file, and the changes of reading; `load_shapes` makes it.

    Attributes
    ----------
    form : str
        The format of the file, such as ``"SVG"``.
    shapes : tuple of Shape
        The shapes in the order of the file; each has a ``role``, a ``name`` or None, and a ``polygon``.
    settings : mapping
        The file's other members of a scene: bounds, start, goal, units and so on, as arguments of `Scene`.
    reading : tuple of Note
        Losses, guesses and changes of reading, the most serious first.
    """

    form: str
    shapes: tuple[Shape, ...]
    settings: Mapping[str, Any] = field(default_factory=dict, hash=False)
    reading: tuple[Note, ...] = ()
    file: str = ""
    remedy: str = ""

    @property
    def changed(self) -> tuple[str, ...]:
        """Lines about the parts that reading changed; `reading` has them as notes."""
        return tuple(_line(note) for note in self.reading if note.kind in _CHANGED)

    @property
    def dropped(self) -> tuple[str, ...]:
        """Lines about the parts that reading dropped; `reading` has them as notes."""
        return tuple(_line(note) for note in self.reading if note.kind not in _CHANGED)

    @property
    def polygons(self) -> tuple[Polygon, ...]:
        """All polygons, with any role."""
        polygons = tuple(shape.polygon for shape in self.shapes if isinstance(shape.polygon, Polygon))
        if len(polygons) < len(self.shapes):
            raise UnsupportedError(f"{self.file}: there are round shapes; take the scene, and its outer(error)")
        return polygons

    @checked
    def of(self, role: Role) -> list[Shape]:
        """Return the shapes of one role: "robot", "obstacle", "workspace" or "part"."""
        return [shape for shape in self.shapes if shape.role == role]

    @checked
    def scene(self, robot: Any = None) -> Scene:
        """Return the scene of these shapes.

        Parameters
        ----------
        robot : shape or sequence of shapes, optional
            A robot to replace the file's; needed if the file has none.

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


def _line(note: Note) -> str:
    return note.what if note.count == 1 else f"{note.what} ({note.count:,} times)"
