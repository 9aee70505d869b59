"""Tiling of one convex pair's contact surface: parallelograms of arcs, strips of edges, segments between the strips.

At one orientation the forbidden region of a convex pair is convex, and each outward normal psi has one contact. So the
contacts form a torus of (psi, phi). Joints of the obstacle, where two of its arcs meet, are the lines psi = const of
it, those of the robot the lines psi - phi = const. They cut it into parallelograms, one for each pair of arcs. A joint
with an edge is as wide as that edge: its line becomes a strip, and where two strips cross they meet in one e-e segment.
docs/theory/arcs.md has the count.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from cfree.arguments import checked
from cfree.contact.arcs import Shape
from cfree.contact.features import ArcFeature, EdgeFeature, ShapeFeatures, shape_features, signed_root
from cfree.exact.orientation import Orientation, turn

Key = tuple[Fraction, Fraction]


@dataclass(frozen=True, slots=True)
class Tiling:
    """Numbers of the cells in which a convex pair's contact surface is divided; see `tiling`.

    Attributes
    ----------
    parallelograms : int
        Patches of two arcs; two vertices have none, as theirs is a helix.
    strips : int
        Patches of an arc and an edge.
    vertices, edges : int
        Places where patches meet. The edges are parts of e-e segments, and of the helices on both sides of a strip.
    """

    parallelograms: int
    strips: int
    vertices: int
    edges: int

    @property
    def faces(self) -> int:
        """Number of patches."""
        return self.parallelograms + self.strips

    @property
    def euler_number(self) -> int:
        """V - E + F, which is 0: the surface is a torus."""
        return self.vertices - self.edges + self.faces


@dataclass(frozen=True, slots=True)
class _Joint:
    """Place between an arc and the next: the edges there, all with one normal; none where arcs meet smoothly."""

    edges: tuple[EdgeFeature, ...]

    @property
    def places(self) -> list[Fraction]:
        """Ends of the edges along the joint, in lengths of the first edge."""
        places = [Fraction(0)]
        for edge in self.edges:
            (x, y), (u, v) = edge.along, self.edges[0].along
            places.append(places[-1] + (x * u + y * v) / (u * u + v * v))
        return places


@checked
def tiling(robot: Shape, obstacle: Shape) -> Tiling:
    """Count the cells of one convex pair's contact surface, exactly, ties included.

    Raises
    ------
    ValueError
        If a shape is not convex.

    Notes
    -----
    Pairs in general position, n arcs and n edges on m and m, have nm parallelograms, 2 nm strips, 7 nm edges and 4 nm
    vertices. Two edges of one length have three places in common instead of four.

    Examples
    --------
    >>> from cfree import Curved, Polygon
    >>> triangle, disc = Polygon([(0, 0), (3, 0), (1, 2)]), Curved.circle((0, 0), 1)
    >>> round_triangle = Curved([(0, 0), (4, 0), (1, 3)], grown=1)
    >>> tiling(round_triangle, triangle)
    Tiling(parallelograms=9, strips=18, vertices=36, edges=63)
    >>> [tiling(disc, shape).euler_number for shape in (disc, triangle, round_triangle)]
    [0, 0, 0]
    """
    A, O = shape_features(robot), shape_features(obstacle)
    for name, shape in (("robot", A), ("obstacle", O)):
        if not shape.is_convex:
            raise ValueError(f"{name}: not convex; its patches are trimmed and tile no torus")
    (arcs_A, joints_A), (arcs_O, joints_O) = _cycle(A), _cycle(O)
    vertices = edges = 0
    for one in joints_A:
        for other in joints_O:
            places = {_place(one, x, other, y) for x in one.places for y in other.places}
            vertices += len(places)
            edges += len(places) - 1
    # both sides of a strip, or the one line of a joint without edges, from each crossing to the next
    strips = 0
    for joints, others in ((joints_A, arcs_O), (joints_O, arcs_A)):
        for joint in joints:
            edges += (len(joint.edges) + 1) * len(others)
            strips += len(joint.edges) * len(others)
    parallelograms = len(arcs_A) * len(arcs_O)
    for a in arcs_A:
        for o in arcs_O:
            if a.signed_square or o.signed_square:
                continue
            # the parallelogram of two vertices is a helix of three parts; if its turns are equal, two corners are one
            equal = _have_equal_widths(a, o)
            parallelograms -= 1
            edges -= 1 + equal
            vertices -= equal
    return Tiling(parallelograms, strips, vertices, edges)


def _cycle(shape: ShapeFeatures) -> tuple[list[ArcFeature], list[_Joint]]:
    """Arcs of a convex ring in order, and the joint after each."""
    (ring,) = shape.rings
    first = next(k for k, feature in enumerate(ring) if isinstance(feature, ArcFeature))
    arcs: list[ArcFeature] = []
    edges: list[list[EdgeFeature]] = []
    for feature in (*ring[first:], *ring[:first]):
        if isinstance(feature, ArcFeature):
            arcs.append(feature)
            edges.append([])
        else:
            edges[-1].append(feature)
    return arcs, [_Joint(tuple(joint)) for joint in edges]


def _place(a: _Joint, x: Fraction, b: _Joint, y: Fraction) -> Key:
    """Position of the robot along a joint if its place x is at the obstacle's place y, since both run opposite ways.

    Positions are x |E_A| + y |E_O|; pairs of one position have one key.
    """
    if a.edges and b.edges:
        (p, q), (u, v) = a.edges[0].along, b.edges[0].along
        ratio = signed_root((p * p + q * q) / (u * u + v * v))
        if ratio is not None:
            return Fraction(0), x * ratio + y
    return x, y


def _have_equal_widths(a: ArcFeature, b: ArcFeature) -> bool:
    """True if two vertices have equal interior angles, exactly."""
    (p, q), (u, v) = ((_rotation(arc)) for arc in (a, b))
    return turn((p, q), (u, v)) is Orientation.COLLINEAR and p * u + q * v > 0


def _rotation(arc: ArcFeature) -> tuple[int, int]:
    """Direction of the rotation from the first normal to the last."""
    (x, y), (u, v) = arc.start, arc.end
    return x * u + y * v, x * v - y * u
