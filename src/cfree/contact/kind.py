"""Kinds of pairs of a robot feature and an obstacle feature, numbered as in the core and in files."""

from __future__ import annotations

from enum import IntEnum


class Kind(IntEnum):
    """Kind of a pair of features; it names a surface, a curve or a critical angle."""

    NONE = 0
    VERTEX_EDGE = 1
    EDGE_VERTEX = 2
    VERTEX_VERTEX = 3
    EDGE_EDGE = 4
    SEAM = 5
    """End of a quadrant of a circle, where shapes are grown."""

    @property
    def short(self) -> str:
        """Abbreviation of the kind in the paper.

        Examples
        --------
        >>> Kind.VERTEX_EDGE.short
        'v-e'
        """
        robot, _, obstacle = self.name.lower().partition("_")
        return f"{robot[0]}-{obstacle[0]}"
