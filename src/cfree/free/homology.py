"""Betti numbers of cells, from the Euler numbers of the closed surfaces around them.

A cell is homotopic to a compact body in R^2 x S^1, an open solid torus, which is a part of R^3. So its homology has no
torsion, b1 is the sum of the surfaces' genera, and b2 is one less than their number. The unbounded cell has one more
torus around it. docs/theory/cells.md has the proof.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Homology:
    """Betti numbers of a cell; its homology groups are free, so that these numbers give them.

    Attributes
    ----------
    b0 : int
        1: a cell is connected.
    b1 : int
        Rank of H_1, the number of independent loops. A robot that can turn all the way round has such a loop, and so
        has each pillar that it can go around.
    b2 : int
        Rank of H_2: the islands of forbidden poses in the cell. A pillar in it, at all orientations, is one.
    """

    b0: int
    b1: int
    b2: int

    @property
    def euler(self) -> int:
        """The Euler characteristic, b0 - b1 + b2: half of that of the cell's boundary."""
        return self.b0 - self.b1 + self.b2


def homology_of(genera: list[int], bounded: bool) -> Homology:
    """Return the homology of a cell from the genera of the closed surfaces that bound it.

    Examples
    --------
    >>> homology_of([1], True)         # a solid torus: a disc that turns in a room
    Homology(b0=1, b1=1, b2=0)
    >>> homology_of([1], False)        # a disc and one pillar: the space around a torus in a solid torus
    Homology(b0=1, b1=2, b2=1)
    """
    around = [] if bounded else [1]
    return Homology(1, sum(genera + around), len(genera + around) - 1)
