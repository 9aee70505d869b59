"""The content of a file before it is a scene: polygons with roles, poses and bounds, and the record of reading.

A shape's role is ``robot``, ``obstacle`` (the default) or ``workspace``; a ``part`` has no place yet
and is in no scene.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from pathlib import PurePath
from typing import Any, Literal

from cfree.arguments import checked
from cfree.curves.similar import similar
from cfree.errors import UnsupportedError
from cfree.exact.number import Number, to_fraction
from cfree.formats.fitting import about_pivot, far_reference, scaled_note, scaled_settings, settings_about
from cfree.formats.padding import Record, padded_robot
from cfree.formats.text.findings import InvalidFileError, whole
from cfree.formats.units import factor, unit_of
from cfree.lazy import registered
from cfree.polygons.polygon import Polygon
from cfree.scene.reading import Note, of_file, together, without_places
from cfree.scene.reading_lines import counts, losses
from cfree.scene.scene import AnyShape, Scene, shapes_in
from cfree.words import counted

Role = Literal["robot", "obstacle", "workspace", "part"]
ROLES = ("robot", "obstacle", "workspace")
DRAWN = ("SVG", "DXF")  # formats in which the robot is drawn at its place
PADDED = ("nav2 parameters", "URDF")  # formats whose readers pad the robot
PART, IGNORE = "part", "ignore"


_CHANGED = ("guess", "assumption", "joined", "near", "mended", "info")


@dataclass(frozen=True, slots=True)
class Shape:
    """A polygon or a round shape of a file, and its role."""

    role: str
    name: str | None
    polygon: AnyShape


@dataclass(frozen=True, slots=True, repr=False)
class Shapes:
    """The shapes of a file, and the record of reading; `load_shapes` makes it.

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
    roles : mapping of str to bool
        The names that the option `roles` gives a role; False for those that nothing in the file has.
    padding : Fraction
        The option `padding`, in the file's unit. The scene's robot is padded by it, unless the reader has done so.

    Examples
    --------
    >>> import cfree
    >>> shapes = cfree.load_shapes("examples/scenes/flat.json")
    >>> shapes
    <Shapes of flat.json (scene): 1 robot, 39 obstacles; no losses>
    >>> shapes.layers["outer walls"]
    <Shapes of flat.json (scene): 1 obstacle; no losses>
    """

    form: str
    shapes: tuple[Shape, ...]
    settings: Mapping[str, Any] = field(default_factory=dict, hash=False)
    reading: tuple[Note, ...] = ()
    file: str = ""
    remedy: str = ""
    roles: Mapping[str, bool] = field(default_factory=dict, hash=False, compare=False)
    padding: Fraction = field(default=Fraction(0), compare=False)

    def __repr__(self) -> str:
        roles = [shape.role for shape in self.shapes]
        numbers = ", ".join(counted(roles.count(role), role) for role in dict.fromkeys(_ORDER) if role in roles)
        lost = losses(self.reading)
        worst = f"{counts(lost)}: {lost[0].text}" if lost else "no losses"
        return f"<Shapes of {PurePath(self.file).name} ({self.form}): {numbers or 'none'}; {worst}>"

    @property
    def layers(self) -> dict[str, Shapes]:
        """Shapes and notes by layer, group or name, in the order of the file; shapes without a name by their role."""
        names = [shape.name or shape.role for shape in self.shapes]
        names += [note.where for note in self.reading if note.where]
        return {
            name: replace(
                self,
                shapes=tuple(shape for shape in self.shapes if (shape.name or shape.role) == name),
                reading=tuple(note for note in self.reading if note.where == name),
            )
            for name in dict.fromkeys(names)
        }

    def plot(self) -> Any:
        """Draw shapes and record of reading with `cfree.plot.picture`; return the matplotlib figure."""
        return registered("figure")(self)

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

    def scaled(self, ratio: Number) -> Shapes:
        """Return the shapes with all lengths multiplied by a number above 0, exactly; poses and bounds as well.

        Examples
        --------
        >>> import cfree
        >>> cfree.load_shapes("examples/scenes/flat.json").scaled("1/1000").scene().robot[0].bounds[2]
        0.0007
        """
        try:
            factor = to_fraction(ratio)
        except (TypeError, ValueError) as error:
            raise type(error)(f"ratio: {error}") from None
        if factor <= 0:
            raise ValueError(f"ratio: {ratio}; give a number above 0")
        if factor == 1:
            return self
        return replace(
            self,
            shapes=tuple(replace(shape, polygon=similar(shape.polygon, factor)) for shape in self.shapes),
            settings=scaled_settings(self.settings, factor),
            reading=tuple(scaled_note(note, float(factor)) for note in self.reading),
        )

    @checked
    def scene(self, robot: Any = None, pivot: Literal["centroid"] | Sequence[Number] | None = None) -> Scene:
        """Return the scene of these shapes, with the record of reading.

        Parameters
        ----------
        robot : shape, sequence of shapes, or Shapes, optional
            A robot to replace the file's; needed if the file has none. Of the shapes of another file these are its
            robot, or all of them if there is none, in the units of this file; the scene has the records of both files.
        pivot : "centroid" or (x, y), optional
            The robot's reference point: its centroid, or a point in its coordinates. Poses of the file still describe
            the same places of the robot; without a start, the robot's place in a drawing is the start.

        Raises
        ------
        FormatError
            If there is no robot, or more than one workspace.
        """
        if isinstance(robot, Shapes):
            settings = self.settings
            other, alike = in_units_of(robot, self)
            parts = [shape.polygon for shape in other.of("robot") or other.shapes]
            record = without_places(of_file(map(_for_robot, other.record), other.file))  # places are in another frame
            its = together(record, alike)
            theirs, own = (str(some.get("units") or "") for some in (other.settings, settings))
            if theirs and (not own or (unit_of(theirs) and not unit_of(own))):
                settings = {**settings, "units": theirs}
            if not parts:
                raise InvalidFileError(other.file, [whole("nothing in it can be the robot; draw its outline closed")])
        else:
            parts = [shape.polygon for shape in self.of("robot")] if robot is None else shapes_in(robot, "robot")
            settings, its = self.settings, ()
        its = together(its, _unused([self.roles, *([robot.roles] if isinstance(robot, Shapes) else [])]))
        rooms = self.of("workspace")
        if not parts:
            raise InvalidFileError(self.file, [whole(f"there is no robot; {self._remedy}")])
        if len(rooms) > 1:
            raise InvalidFileError(self.file, [whole(f"{len(rooms)} workspaces; give one polygon")])
        if pivot is not None:
            parts, point = about_pivot(parts, pivot)
            settings = settings_about(settings, point, is_placed=robot is None and self.form in DRAWN)
        if by := self._padding_of(robot):
            changes = Record()
            parts = padded_robot(changes, parts, by)
            its = together(its, of_file(changes.notes, robot.file if isinstance(robot, Shapes) else self.file))
        its = together(its, far_reference(parts) if self.form != "scene" or robot is not None else ())
        obstacles = self.of("obstacle")
        nothing = () if obstacles or rooms or self.form == "scene" else of_file([_NOTHING_FORBIDS], self.file)
        return Scene(
            robot=parts,
            obstacles=[shape.polygon for shape in obstacles],
            obstacle_names=[shape.name for shape in obstacles],
            workspace=rooms[0].polygon if rooms else None,
            reading=together(self.record, its, nothing),
            **settings,
        )

    def _padding_of(self, robot: Any) -> Fraction:
        """Return the padding of the scene's robot, in this file's unit; 0 if the robot's reader has padded it."""
        if not isinstance(robot, Shapes):
            return Fraction(0) if robot is None and self.form in PADDED else self.padding
        ratio = factor(str(robot.settings.get("units", "")), str(self.settings.get("units", "")))
        return Fraction(0) if robot.form in PADDED else robot.padding * (ratio or 1)

    @property
    def _remedy(self) -> str:
        named = "--robot" in self.remedy or self.form == "nesting"
        return self.remedy if named else f"{self.remedy}, or give --robot with a file or a footprint"

    @property
    def record(self) -> tuple[Note, ...]:
        """The record of reading with the name of the file in each note; a scene's own is unchanged."""
        return self.reading if self.form == "scene" else of_file(self.reading, self.file)


def in_units_of(robot: Shapes, scene: Shapes) -> tuple[Shapes, tuple[Note, ...]]:
    """Return a robot's shapes in the unit of the scene, and notes.

    A file without a unit is taken to have that of the other.
    """
    own, wanted = (str(shapes.settings.get("units", "")) for shapes in (robot, scene))
    if ratio := factor(own, wanted):
        what = f"robot in {own}, converted to {wanted}"
        return robot.scaled(ratio), (Note("info", what),) if ratio != 1 else ()
    if named := unit_of(own) or unit_of(wanted):
        missing = PurePath((scene if unit_of(own) else robot).file).name
        return robot, (Note("info", f"no unit in {missing}, taken as {named}", remedy="--units"),)
    return robot, ()


_ORDER = (*ROLES, PART)
_NOTHING_FORBIDS = Note("info", "nothing forbids a pose: no obstacle and no workspace")


def _unused(roles: Sequence[Mapping[str, bool]]) -> Iterator[Note]:
    """Yield a warning for each name with a role that no file has, which is probably misspelt."""
    for name in dict.fromkeys(name for some in roles for name in some):
        if not any(some.get(name) for some in roles):
            yield Note("warning", f'role without effect: nothing is called "{name}"', remedy="--role")


def _for_robot(note: Note) -> Note:
    """Return a note about a robot's file; lines of a robot have no option that makes walls of them."""
    return replace(note, remedy="close the outline in the drawing") if note.remedy.startswith("--strokes") else note


def _line(note: Note) -> str:
    return note.what if note.count == 1 else f"{note.what} ({note.count:,} times)"
