"""An SVG element with everything that those around it give: matrix, viewport, style, names and clips."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import NoReturn

from cfree.curves.drawn import Affine
from cfree.formats.drawings.source import Source
from cfree.formats.drawings.svg_clips import Clip
from cfree.formats.drawings.svg_curves import Group
from cfree.formats.drawings.svg_forms import Form
from cfree.formats.drawings.svg_lengths import Axis, Measure
from cfree.formats.drawings.svg_style import SIZES, Style
from cfree.formats.drawings.xml_tree import Node

Sizes = tuple[Fraction | None, Fraction | None]


@dataclass(frozen=True, slots=True)
class State:
    """The values that an element hands down.

    Attributes
    ----------
    frame : Affine
        From user units to the scene.
    names : tuple of str
        Names of the element and of those around it, the innermost first.
    group : Group
        The group of its unfilled curves.
    sizes : pair, optional
        Width and height of a use, for its target.
    unsure : bool
        True inside of an element with a rule of a style sheet that was not obeyed.
    """

    frame: Affine
    measure: Measure
    style: Style
    names: tuple[str, ...]
    group: Group
    clips: tuple[Clip, ...] = ()
    sizes: Sizes | None = None
    unsure: bool = False


@dataclass(frozen=True, slots=True)
class Element:
    """An element, its state, and the properties that it sets."""

    source: Source
    node: Node
    state: State
    declared: Mapping[str, str]

    @property
    def name(self) -> str:
        """The innermost name; empty if there is none."""
        return self.state.names[0] if self.state.names else ""

    @property
    def handle(self) -> str:
        """The id, or else the line."""
        return self.node.attributes.get("id") or f"line {self.node.line}"

    def refuse(self, message: str) -> NoReturn:
        """Refuse the file because of this element."""
        self.source.refuse(message, self.node.line, place=self.node.tag[:40])

    def text(self, key: str) -> str:
        """Return an attribute that CSS may override; the empty string if it is missing."""
        value = self.declared.get(key) if key in SIZES else None
        return value if value is not None else self.node.attributes.get(key, "")

    def length(self, key: str, axis: Axis) -> Fraction | None:
        """Return the length of an attribute; None if it is missing or "auto"."""
        text = self.text(key).strip()
        if not text or text.lower() == "auto":
            return None
        try:
            return self.state.measure.length(self.source, text, axis)
        except ValueError as error:
            raise ValueError(f"{key}: {error}") from None

    def corner(self) -> tuple[Fraction, Fraction]:
        """Return x and y."""
        return self.length("x", "x") or Fraction(0), self.length("y", "y") or Fraction(0)

    def sizes(self) -> Sizes:
        """Return width and height, None where they are missing."""
        return self.length("width", "x"), self.length("height", "y")

    def form(self, frame: Affine | None = None) -> Form:
        """Return its outline in a frame; by default, in the scene's."""
        if self.declared.get("d", "none").lower() != "none":
            raise ValueError("d in a style is not read; write it as an attribute")
        return Form(self.source, self.node.tag, self.text, self.length, frame or self.state.frame)
