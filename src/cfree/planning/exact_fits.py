"""Ways through exact fits: contact motions between cells, where free space is too thin for any clearance.

C_free is closed. Its cells may touch, and its isolated parts are free without being in any cell; `meeting_places`
knows where they meet. Every motion is checked. So a way that is found is a proof; that none is found says nothing:
`separation` has the proofs of that.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

from cfree.exact.pose import Pose
from cfree.planning.meeting_places import Holder, Places

if TYPE_CHECKING:
    from cfree.planning.boundary_walk import Walker

Node = Pose | Holder
Way = list[Pose]


class Passages:
    """Ways between cells, and from poses in no cell, through exact fits.

    Parameters
    ----------
    walker : Walker
        Of the free space.
    """

    def __init__(self, walker: Walker) -> None:
        self.walker = walker
        self.space = walker.space
        self.places = Places(walker)
        self._broken: set[tuple[Pose, Node, Pose]] = set()  # isolated parts along which no motions were found

    def path(self, start: Pose, goal: Pose, irrational: bool = False) -> Way | None:
        """Poses from start to goal, or None if no way was found: the fewest places first.

        Places at irrational orientations, which slides lead through, are left out unless asked for: they take long.
        """
        slides = self._slides if irrational else {}
        return self._path(start, goal, [start, goal, *self.places.rational, *slides], slides)

    def _path(self, start: Pose, goal: Pose, poses: list[Pose], slides: dict[Pose, Way]) -> Way | None:
        holders = {pose: self.places.holders(pose) for pose in dict.fromkeys(poses)}
        held: dict[Holder, Way] = {}
        for pose, of in holders.items():
            for holder in of:
                held.setdefault(holder, []).append(pose)

        def neighbours(node: Node, came_from: Node) -> Iterator[Node]:
            if not isinstance(node, Pose):
                yield from (q for q in held[node] if (came_from, node, q) not in self._broken)
                return
            yield from (*holders[node], *slides.get(node, ()))

        while nodes := _shortest(start, goal, neighbours):
            way = [start]
            for node, after in zip(nodes[1:], [*nodes[2:], goal], strict=True):
                if isinstance(node, Pose):
                    way += [node] if way[-1] != node else []
                    continue
                assert isinstance(after, Pose)
                found = self.places.way(way[-1], after, node)
                if found is None:
                    self._broken |= {(way[-1], node, after), (after, node, way[-1])}
                    break
                way += found[1:]
            else:
                return way
        return None

    @cached_property
    def _slides(self) -> dict[Pose, Way]:
        """Through irrational orientations, both ways."""
        found: dict[Pose, Way] = {}
        for way in (*self.places.slides(), *self.places.turns()):
            for a, b in pairwise(way):
                found.setdefault(a, []).append(b)
                found.setdefault(b, []).append(a)
        return found


def _shortest(start: Pose, goal: Pose, neighbours: Callable[[Node, Node], Iterable[Node]]) -> list[Node]:
    """Nodes from start to goal, breadth first; none if there is no way."""
    came: dict[Node, Node] = {start: start}
    queue: deque[Node] = deque([start])
    while queue:
        node = queue.popleft()
        if node == goal:
            way: list[Node] = [goal]
            while way[-1] != start:
                way.append(came[way[-1]])
            return way[::-1]
        for other in neighbours(node, came[node]):
            if other not in came:
                came[other] = node
                queue.append(other)
    return []
