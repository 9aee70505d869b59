"""Census of triple contacts among all contact surfaces of Definition 1, pseudo contacts included.

A contact surface is the set of all poses with a fixed vertex on a fixed edge, even if other parts overlap. The
boundaries in `arrangement` are parts of some of these surfaces; here `triple` intersects every three whole surfaces.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import combinations
from math import comb

from cfree.arguments import checked
from cfree.arrangements.statistics import pseudo_vertex_bound
from cfree.arrangements.triples import TripleContact, triple_of
from cfree.contact.contact import EdgeVertex, VertexEdge
from cfree.contact.surface import Surface, contact_surface
from cfree.curves.curved import REFUSED
from cfree.errors import UnsupportedError
from cfree.exact.algebraic import Exact, ratio
from cfree.exact.forms import value_at
from cfree.exact.orientation import Location
from cfree.scene.scene import Scene
from cfree.words import counted

MOST_TRIPLES = 10_000
RELATIONS = ("points", "curve", "parallel", "identical")


@checked
@dataclass(frozen=True, slots=True, repr=False)
class Census:
    """All poses on three contact surfaces of a scene; see `census`.

    Attributes
    ----------
    surfaces : tuple of Surface
        Every vertex of the robot on every edge of an obstacle, and every edge on every vertex, reflex ones included.
    relations : dict of str to int
        Number of triples with each relation, "points", "curve", "parallel" or "identical": see `Triple.relation`.
    inside, rim : tuple of TripleContact
        Different poses on three surfaces that meet in points, by orientation: the poses inside all three surfaces of
        some triple, and the other poses, at the end of an edge.
    bound : int
        Greatest possible number of poses: 4 for each three surfaces.
    """

    surfaces: tuple[Surface, ...]
    relations: dict[str, int] = field(hash=False)
    inside: tuple[TripleContact, ...]
    rim: tuple[TripleContact, ...]
    bound: int

    def __repr__(self) -> str:
        counts = f"{counted(len(self.surfaces), 'surface')}, {counted(sum(self.relations.values()), 'triple')}"
        return f"Census({counts}: {counted(len(self.inside), 'triple contact')} inside, {len(self.rim)} at rims)"


@checked
def census(scene: Scene, *, max_triples: int = MOST_TRIPLES) -> Census:
    """Find every pose on three contact surfaces of Definition 1, pseudo contacts included, exactly.

    Parameters
    ----------
    scene : Scene
        Its robot and obstacles count. Bounds and workspace do not: the paper has no such obstacles.
    max_triples : int
        More triples of surfaces are refused.

    Returns
    -------
    Census

    Raises
    ------
    UnsupportedError
        If there are more triples; or round shapes, then the message names the remedy.

    Notes
    -----
    k surfaces make k (k - 1) (k - 2) / 6 triples, which take some milliseconds each: ten seconds for two quadrangles.

    Examples
    --------
    >>> from cfree import Scene
    >>> square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    >>> census(Scene(square, [square]), max_triples=100)
    Traceback (most recent call last):
        ...
    cfree.errors.UnsupportedError: 32 contact surfaces make 4,960 triples, more than max_triples=100; give more
    """
    if scene.curved:
        raise UnsupportedError(f"the census of triple contacts: {REFUSED}")
    surfaces = tuple(
        contact_surface(robot, obstacle, kind(i, j))
        for robot in scene.robot
        for obstacle in scene.obstacles
        for kind in (VertexEdge, EdgeVertex)
        for i in range(len(robot))
        for j in range(len(obstacle))
    )
    count = comb(len(surfaces), 3)
    if count > max_triples:
        made = f"{counted(len(surfaces), 'contact surface')} make {counted(count, 'triple')}"
        raise UnsupportedError(f"{made}, more than max_triples={max_triples:,}; give more")
    relations = dict.fromkeys(RELATIONS, 0)
    by_place: dict[tuple[Exact, ...], TripleContact] = {}
    for three in combinations(surfaces, 3):
        meeting = triple_of(three, outside=False)
        relations[meeting.relation] += 1
        for contact in meeting.poses:
            key = _place(contact)
            if key not in by_place or contact.location is Location.INSIDE:
                by_place[key] = contact
    poses = sorted(by_place.values(), key=lambda contact: contact.angle)
    inside = tuple(pose for pose in poses if pose.location is Location.INSIDE)
    rim = tuple(pose for pose in poses if pose.location is not Location.INSIDE)
    return Census(surfaces, relations, inside, rim, pseudo_vertex_bound(len(surfaces)))


def _place(contact: TripleContact) -> tuple[Exact, ...]:
    """Key of a pose, equal for equal poses: x and y at one angle are numbers of one field."""
    x, y, w = (value_at(form, contact.angle) for form in (contact.curve.x, contact.curve.y, contact.curve.w))
    return contact.angle, ratio(x, w), ratio(y, w)
