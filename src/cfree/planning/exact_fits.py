"""Ways through exact fits: contact motions between cells, where free space is too thin for any clearance."""

from __future__ import annotations

from typing import TYPE_CHECKING

import cfree._core as _core
from cfree.errors import InvariantError
from cfree.exact.pose import Pose
from cfree.free.space import bounding_surfaces
from cfree.planning.core_ways import numbers_of

if TYPE_CHECKING:
    from cfree.planning.boundary_walk import Walker


class Passages:
    """Ways between cells, and from poses in no cell, through exact fits.

    That a way is found is a proof; that none is found says nothing: `separation` has the proofs of that.

    Parameters
    ----------
    walker : Walker
        Of the free space.
    """

    def __init__(self, walker: Walker) -> None:
        self._walker = walker
        whole = walker.space.boundary
        slits = None if bounding_surfaces(whole) is whole else whole.core_complex
        self._core = _core.Passages(walker.core, slits)

    def path(self, start: Pose, goal: Pose, irrational: bool = False) -> list[Pose] | None:
        """Poses from start to goal, both free, or None if no way was found: the fewest places first.

        Places at irrational orientations are left out unless asked for: they take long.

        Raises
        ------
        InvariantError
            If a cell cannot be walked in, a fault of cfree.
        """
        try:
            found = self._core.path(numbers_of(start), numbers_of(goal), irrational)
        except RuntimeError as error:
            raise InvariantError(str(error), state=(start, goal)) from error
        return None if found is None else self._walker.way_of(found)
