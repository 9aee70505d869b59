"""Shapes of segments and circular arcs, convex and concave, as polygons of many sides, and points of their contacts."""

from __future__ import annotations

import math

import numpy as np
import shapely
from numpy.typing import NDArray

from cfree import Curved, Polygon
from cfree.contact import ArcArcSurface, ArcEdge, arc_range, arc_surface, shape_features
from cfree.contact.arcs import ArcContact
from cfree.contact.features import EdgeFeature
from cfree.curves import Arc, Circle
from round_shapes import rim

Floats = NDArray[np.float64]
Shape = Polygon | Curved
SIDES = 1200  # of an arc

TRIANGLE = Polygon([(-1, -1), (2, "-1/2"), (0, 1)])
DISC = Curved.circle(("1/2", "-1/4"), "3/4")
STADIUM = Curved([(-1, -1), (2, -1), Arc((2, 1), center=(2, 0)), (-1, 1), Arc((-1, -1), center=(-1, 0))])
CAR = Curved([(-1, "-1/2"), (2, "-1/2"), (2, "1/2"), (-1, "1/2")], grown="1/3")
CAP = Curved([(-1, 0), (1, 0), Arc((-1, 0), center=(0, -1))])  # the radius is sqrt(2)
CORNER = Curved([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], grown="1/4")
BAY = Curved([(-2, -1), (2, -1), (2, 1), (1, 1), Arc((-1, 1), center=(0, 1), clockwise=True), (-2, 1)])
FILLET = Curved([(0, 0), (3, 0), Arc((0, 3), center=(3, 3), clockwise=True)])  # with two cusps
MOON = Curved([(0, -2), Arc((0, 2), center=(0, 0)), Arc((0, -2), center=("-3/2", 0), clockwise=True)])
PLATE = Curved([(-3, -3), (3, -3), (3, 3), (-3, 3)], [Circle((0, 0), 2)])
CONVEX = {"triangle": TRIANGLE, "disc": DISC, "stadium": STADIUM, "car": CAR, "cap": CAP}
SHAPES = CONVEX | {"corner": CORNER, "bay": BAY, "fillet": FILLET, "moon": MOON, "plate": PLATE}


def unit(angle: float | Floats) -> Floats:
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def normal(edge: EdgeFeature) -> Floats:
    x, y = map(float, edge.along)
    return np.array([y, -x]) / math.hypot(x, y)


def dense(shape: Shape) -> shapely.Polygon:
    """The shape from its definition alone, with SIDES sides an arc."""
    if isinstance(shape, Polygon):
        return shape.to_shapely()
    if shape.grown:
        return shapely.Polygon(np.array(shape.path, float)).buffer(float(shape.grown), quad_segs=SIDES)
    return shapely.Polygon(rim(shape.path, SIDES), [rim(hole, 4 * SIDES) for hole in shape.holes])


def placed(shape: shapely.Polygon, pose: Floats) -> shapely.Polygon:
    x, y, theta = pose.tolist()
    c, s = math.cos(theta), math.sin(theta)
    return shapely.affinity.affine_transform(shape, [c, -s, s, c, x, y])


def touching(
    robot: Shape, obstacle: Shape, contact: ArcContact, shares: tuple[float, float]
) -> tuple[Floats, Floats, Floats]:
    """A pose of a contact patch, the point where the shapes touch, and the obstacle's normal there.

    The shares, in (0, 1), are the place in the patch.
    """
    S = arc_surface(robot, obstacle, contact)
    A, O = shape_features(robot), shape_features(obstacle)
    one, other = shares
    if isinstance(S, ArcArcSurface):
        psi = S.obstacle.first + one * S.obstacle.width
        phi = psi + math.pi - (S.robot.first + other * S.robot.width)
        return S(psi, phi), np.array(S.p, float) + S.obstacle.signed_radius * unit(psi), unit(psi)
    Phi = arc_range(robot, obstacle, contact)
    phi = Phi.phi_min + other * Phi.phi_range
    pose = S(one, phi)
    if isinstance(contact, ArcEdge):
        edge = O.edges[contact.j]
        n = normal(edge)
        point = np.array(edge.start, float) + one * np.array(edge.along, float) + float(edge.offset) * n
        return pose, point, n
    (x, y), (c, s) = normal(A.edges[contact.i]), unit(phi)
    n = -np.array([c * x - s * y, s * x + c * y])
    arc = O.arcs[contact.j]
    return pose, np.array(arc.centre, float) + arc.signed_radius * n, n
