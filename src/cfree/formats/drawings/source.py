"""A file of shapes being read: its text, the limits on reading it, and the changes and losses to report."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from pathlib import Path
from typing import Any, Literal, NoReturn

from cfree.arguments import one_of
from cfree.curves.drawn import Ring
from cfree.curves.hulls import box_of
from cfree.formats.shapes import IGNORE, ROLES, Shape, Shapes
from cfree.formats.text.findings import Findings, InvalidFileError, Problem, whole
from cfree.scene.reading import Effect, Item, Kind, Note, Notes, Place, thinned, together

MOST_BYTES = 1 << 26
"""Maximum size of a drawing or a map."""
MOST_STEPS = 3_000_000
"""Maximum number of elements, points and pieces of curves of a file, blocks and references expanded."""
REPORTED = 10_000
"""Number of steps between two reports of progress."""
WIDEST = 1e150
"""Bound of coordinates of drawings, and of widths."""
DEEPEST = 100
"""Maximum depth of groups, blocks and references."""
CURVE_SHARE = 1000
"""Default tolerance of curves: the drawing's size divided by this."""
_DRAWN = ("lost", "guess", "hidden", "paint")
"""Kinds of notes about things that are drawn and that may be in no shape."""
_MARK = re.compile(r"(robot|obstacle|workspace)(?![a-z])", re.IGNORECASE)


SCENE_ALONE = ("strokes", "min_area", "space", "units", "scale")
"""Options that have no effect on a robot's file."""


@dataclass(frozen=True, slots=True)
class Reading:
    """Options of reading, see `cfree.load_shapes`."""

    tolerance: float | None = None  # greatest error of polygons for curves
    unknown: Literal["obstacle", "free"] = "obstacle"  # unknown cells of a map
    roles: Mapping[str, str] = field(default_factory=dict)
    join: float | None = None  # greatest gap that is closed; None: 1e-6 of the drawing's size; 0: none
    join_holes: bool = False  # rings that a guess closes may be holes
    strokes: float | Literal["ignore", "drawn"] = (
        "ignore"  # unfilled lines are walls: of the drawn width, or of this one
    )
    repair: bool | None = None  # self-crossing rings by the fill rule; None: in drawings, not in JSON
    holes: Literal["outlines", "nested"] = "outlines"  # nested unfilled elements of an SVG group are holes
    fills: Literal["outlines", "hatches"] = "outlines"  # hatches alone say where a DXF layer is solid
    space: str = ""  # layout of a DXF file
    language: str = "en"  # of branches of SVG's switch
    units: str = ""  # unit of a file that names none
    scale: Fraction | None = None  # lengths are multiplied by this
    curves: bool = False  # outlines with curves become round shapes, not polygons
    heal: float = 0.0  # arcs of round shapes become exactly tangent if that moves them by no more; 0: none does
    map_rules: Literal["strict", "nav2", "nav2-old", "ros1"] = "strict"
    occupied: int | None = None  # cells of a map from this value up, of 100, are occupied
    free_thresh: float | None = None  # in place of the map's
    unknown_grey: int | None = None  # grey value of unknown cells
    despeckle: int = 0  # occupied parts of a map of fewer cells are free
    min_area: float = 0.0  # smaller shapes of a drawing are left out
    padding: float = 0.0  # of the robot, as nav2 pads a footprint

    def __post_init__(self) -> None:
        if self.tolerance is not None and not 0 < self.tolerance < math.inf:
            raise ValueError(f"tolerance: {self.tolerance} is no length; give one above 0")
        for name in ("join", "heal", "min_area", "padding", "despeckle"):
            value = getattr(self, name)
            if value is not None and not 0 <= value < math.inf:
                raise ValueError(f"{name}: {value}; give 0 or more")
        is_width = not isinstance(self.strokes, str) and 0 < self.strokes < WIDEST
        if not is_width and self.strokes not in ("ignore", "drawn"):
            raise ValueError(f'strokes: {self.strokes!r}; give a width above 0 and below 1e150, "drawn" or "ignore"')
        if self.scale is not None and self.scale <= 0:
            raise ValueError(f"scale: {self.scale}; give a number above 0")
        for name, role in self.roles.items():
            one_of(f"roles: {name}", role, (*ROLES, IGNORE))

    @property
    def of_robot(self) -> Reading:
        """The options for a robot's file: none about walls, small shapes, layout and unit of the scene.

        A robot drawn by an unfilled outline is solid, so that no obstacle fits into it.
        """
        plain = Reading()
        return replace(self, **{name: getattr(plain, name) for name in SCENE_ALONE})


Progress = Callable[[int], object]
"""Called with the number of elements, points and pieces of curves that were read, now and then."""


class Source:
    """One file while it is read.

    Parameters
    ----------
    file : str
    text : str
    reading : Reading, optional
    progress : callable, optional
        Called with the number of steps so far: elements, points and pieces of curves. It may raise to end reading.
    """

    def __init__(
        self, file: str, text: str = "", reading: Reading | None = None, progress: Progress | None = None
    ) -> None:
        self.findings = Findings(file, text)
        self.reading = reading or Reading()
        self.notes = Notes()
        self.roles = dict.fromkeys(self.reading.roles, False)  # True once something has the name
        self._steps = 0
        self._progress = progress

    @property
    def folder(self) -> Path:
        return Path(self.findings.file).parent

    def wanted_role(self, name: str | None) -> str | None:
        """Return the role that the options give a name; None if they give none."""
        if name is None or name not in self.roles:
            return None
        self.roles[name] = True
        return self.reading.roles[name]

    def spend(self, steps: int = 1) -> None:
        """Count steps; refuse a file that takes too many of them. The count is the same on every machine."""
        self._steps += steps
        if self._steps > MOST_STEPS:
            self.refuse(f"more than {MOST_STEPS:,} elements and points, references expanded; give a smaller file")
        if self._progress is not None and self._steps % REPORTED < steps:
            self._progress(self._steps)

    def note(
        self,
        kind: Kind,
        what: str,
        effect: Effect = "none",
        *,
        count: int = 1,
        where: str = "",
        at: tuple[float, float] | None = None,
        size: float | None = None,
        handle: str = "",
        remedy: str = "",
        points: Sequence[Place] = (),
    ) -> None:
        """Record a difference between the file and the scene, see `Note`.

        With a handle, a place or points it is also an item. Points are for pictures: a line, or the outline of a shape,
        whose last point is then the first one, in the scene's frame.
        """
        if count:
            items = (Item(handle, at, size, thinned(points)),) if handle or at or points else ()
            self.notes.add(Note(kind, what, effect, count, where, at, size, items, remedy))

    def refuse(self, message: str, line: int = 1, column: int = 1, place: str = "") -> NoReturn:
        """Refuse the file: its rest cannot be read."""
        raise InvalidFileError(self.findings.file, [Problem(line, column, place, message)])


def tolerance_of(source: Source, rings: Sequence[Ring]) -> float:
    """Return the requested tolerance, or a share of the size of all these rings."""
    if source.reading.tolerance:
        return source.reading.tolerance
    x0, y0, x1, y1 = box_of(rings)
    return max(x1 - x0, y1 - y0) / CURVE_SHARE


def read_bytes(path: str, most: int = MOST_BYTES) -> bytes:
    """Read a whole file of limited size.

    Raises
    ------
    InvalidFileError
        If there is no such file, or it is too large.
    """
    try:
        with open(path, "rb") as stream:
            raw = stream.read(most + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        message = f"{reason}; give the path of a file that can be read"
    else:
        if len(raw) <= most:
            return raw
        message = f"more than {most >> 10:,} KiB; give a smaller file"
    raise InvalidFileError(path, [whole(message)])


def shapes_of(source: Source, form: str, shapes: list[Shape], settings: Mapping[str, Any], remedy: str) -> Shapes:
    """Return the shapes that a reader found; raise the problems that it noted."""
    source.findings.fail_if_any()
    own = {key: value for key, value in settings.items() if key != "reading"}
    if not shapes and not any(note.kind in _DRAWN or note.where or note.items for note in source.notes):
        source.note("info", f"nothing is drawn in {Path(source.findings.file).name}")
    reading = together(settings.get("reading", ()), source.notes)
    return Shapes(form, tuple(shapes), own, reading, source.findings.file, remedy, source.roles)


def role_of(source: Source, *names: str | None) -> tuple[str, str | None]:
    """Return role and name of a shape in groups or on a layer of these names, the innermost first.

    A name that begins with a role, in capital or small letters, gives this role.

    Examples
    --------
    >>> role_of(Source("a.svg"), None, "Robot 2", "walls"), role_of(Source("a.svg"), "wall", "house")
    (('robot', None), ('obstacle', 'wall'))
    """
    named = [name for name in names if name]
    for name in named:
        if wanted := source.wanted_role(name):
            return wanted, name
    for name in named:
        if mark := _MARK.match(name):
            role = mark[1].lower()
            if role != "obstacle":
                return role, None
            return role, name if name.lower() != role else next((other for other in named if other != name), None)
    return "obstacle", named[0] if named else None
