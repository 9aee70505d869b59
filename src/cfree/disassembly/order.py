"""`removal_order`: an order in which parts are taken out one at a time, or a proof that there is none.

Taking a part out frees space and forbids nothing. So a part that can leave now can leave later as well, and it never
harms to take it out first: if any order exists, this one takes out all parts. If it stops, each part left has a proof
that it cannot leave the others, and no order takes out any of them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from cfree.arguments import checked
from cfree.disassembly.assembly import Assembly
from cfree.disassembly.leaving import Leaving, leaving
from cfree.errors import IncompleteError
from cfree.lazy import registered
from cfree.value import Value


@dataclass(frozen=True, eq=False, repr=False)
class Disassembly(Value):
    """The answer of `removal_order`; true if all parts that are not fixed can be taken out.

    Attributes
    ----------
    assembly : Assembly
    removed : tuple of Leaving
        The parts in the order in which they leave, each with its path among those that are left.
    held : tuple of Leaving
        The parts that cannot leave, each with a proof. If any is left undecided, these proofs hold only as long as it
        stays.
    undecided : tuple of (str, str)
        Each part that stayed undecided, and the reason.
    """

    assembly: Assembly
    removed: tuple[Leaving, ...]
    held: tuple[Leaving, ...] = ()
    undecided: tuple[tuple[str, str], ...] = ()

    def __bool__(self) -> bool:
        return not self.held and not self.undecided

    def __repr__(self) -> str:
        parts = [f"order: {', '.join(self.order) or 'none'}"]
        parts += [f"held: {', '.join(one.part for one in self.held)}"] if self.held else []
        parts += [f"undecided: {', '.join(name for name, _ in self.undecided)}"] if self.undecided else []
        return f"Disassembly({'; '.join(parts)})"

    @property
    def order(self) -> tuple[str, ...]:
        """The names of the parts in the order in which they leave."""
        return tuple(one.part for one in self.removed)

    @property
    def assembly_order(self) -> tuple[str, ...]:
        """The order in which the parts are put together: each comes in on its path backwards."""
        return self.order[::-1]

    def verified(self) -> bool:
        """True if independent code confirms each path and each proof."""
        return all(one.verified() for one in (*self.removed, *self.held))

    def plot(self) -> Any:
        """Draw each step: the part that leaves, its path, and the parts that are left; then the parts that are held.

        Returns
        -------
        matplotlib figure
        """
        return registered("disassembly figure")(self)


@checked
def removal_order(
    assembly: Assembly,
    *,
    max_seconds: float | None = None,
    progress: Callable[[float], object] | None = None,
) -> Disassembly:
    """Find an order in which the parts can be taken out, one at a time.

    Parameters
    ----------
    assembly : Assembly
    max_seconds : float, optional
        Time limit of each decision; a part for which it runs out is undecided.
    progress : callable, optional
        Called with the completed share, from 0 to 1.

    Returns
    -------
    Disassembly
        True with the order and a path for each part. Else the parts that no such order takes out, each with a proof.

    Raises
    ------
    InvalidPoseError
        If two parts overlap.

    Notes
    -----
    A part moves alone, and far away before the next one moves. Two parts that only come apart together, or that take
    turns, count as held.

    Examples
    --------
    >>> frame = [(0, 0), (4, 0), (4, 3), (3, 3), (3, 1), (1, 1), (1, 3), (0, 3)]
    >>> lid, peg = [(0, 3), (4, 3), (4, 4), (0, 4)], [(1, 1), (3, 1), (3, 2), (1, 2)]
    >>> found = removal_order(Assembly({"frame": frame, "peg": peg, "lid": lid}, fixed=["frame"]))
    >>> found.order, found.assembly_order, bool(found)
    (('lid', 'peg'), ('peg', 'lid'), True)
    """
    left, removed = list(assembly.movable), list[Leaving]()
    count = len(left)
    while True:
        held, undecided = list[Leaving](), list[tuple[str, str]]()
        for k, name in enumerate(left):
            if progress is not None:
                progress((len(removed) + k / (len(left) + 1)) / (count or 1))
            try:
                one = leaving(assembly, name, [other.part for other in removed], max_seconds=max_seconds)
            except IncompleteError as error:
                undecided.append((name, str(error)))
                continue
            if one:
                removed.append(one)
                left.remove(name)
                break
            held.append(one)
        else:
            if progress is not None:
                progress(1.0)
            return Disassembly(assembly, tuple(removed), tuple(held), tuple(undecided))
