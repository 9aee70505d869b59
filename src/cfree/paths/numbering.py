"""Paths among some obstacles of a scene, with their numbers in the whole."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from cfree.collision.slide import Slide, Touch
from cfree.paths.path import Path


def has_slides(path: Path) -> bool:
    """True if some of its motions slide along contacts."""
    return any(isinstance(motion, Slide) for motion in path.motions)


def renumbered(path: Path, numbers: Sequence[int] | Mapping[int, int]) -> Path:
    """Path whose slides name obstacles by other numbers: obstacle k has the number numbers[k]."""
    motions = tuple(
        Slide((_touch(m.contacts[0], numbers), _touch(m.contacts[1], numbers)), m.x, m.y, m.d, m.tau)
        if isinstance(m, Slide)
        else m
        for m in path.motions
    )
    return replace(path, motions=motions)


def _touch(touch: Touch, numbers: Sequence[int] | Mapping[int, int]) -> Touch:
    polygon, vertex = touch.obstacle
    return touch if polygon < 0 else replace(touch, obstacle=(numbers[polygon], vertex))
