"""The content of a drawing between its reader and the scene: filled rings, and the unfilled curves of a layer."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from cfree.curves.drawn import Ring

Cap = Literal["butt", "square", "round"]
Join = Literal["miter", "round", "bevel"]


@dataclass(frozen=True, slots=True)
class Drawn:
    """Rings that are filled together, and the names of their groups, the innermost first."""

    rings: list[Ring]
    names: tuple[str, ...]
    line: int = 1
    even_odd: bool = True


@dataclass(frozen=True, slots=True)
class Curve:
    """A connected curve as it is drawn.

    Attributes
    ----------
    segments : Ring
        Each begins at the end of the one before.
    closed : bool
        True if the file closes it: the last point is the first one.
    handle : str
        Handle, id or line of the element in the file.
    rounding : float
        Bound of the distance of an end from the point that was meant, by the digits that are written.
    width : float
        Width of its stroke as drawn, in the scene's unit; 0 if it has none.
    cap, join : str
        Forms of its ends, "butt", "square" or "round", and of its corners, "miter", "round" or "bevel".
    miter : float
        Greatest length of a corner's miter, divided by the width.
    """

    segments: Ring
    closed: bool = False
    handle: str = ""
    rounding: float = 0.0
    width: float = 0.0
    cap: Cap = "square"  # if unknown: no other is larger
    join: Join = "miter"
    miter: float = 4.0


@dataclass(frozen=True, slots=True)
class Lines:
    """Unfilled curves of one layer or group, which may close outlines together, and the names of their groups."""

    curves: list[Curve] = field(default_factory=list)
    names: tuple[str, ...] = ()
    line: int = 1
