"""Contact surfaces of circular arcs: poses placed by them touch, exactly where radii are rational."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import product

import numpy as np
import pytest
import shapely

from arc_shapes import BAY, CAP, CAR, CONVEX, DISC, PLATE, SHAPES, STADIUM, TRIANGLE, Shape, dense, placed, touching
from cfree import Curved, Polygon, Pose, Rotation, Scene, is_free
from cfree.contact import (
    ArcArc,
    ArcArcSurface,
    ArcEdge,
    EdgeArc,
    EdgeVertex,
    OffsetSurface,
    VertexEdge,
    angle_range,
    arc_contacts,
    arc_curves,
    arc_range,
    arc_surface,
    contact_surface,
    contacts,
    shape_features,
    tiling,
)
from cfree.curves import Arc
from cfree.exact.orientation import Location, Order, compare_directions

NEAR, STEP = 0.01, 1e-4  # of a contact; off it
PAIRS = [
    (a, o) for a, o in product(SHAPES, SHAPES) if {a, o} & {"disc", "stadium", "bay", "fillet", "moon", "plate", "cap"}
]


def near(shape: shapely.Polygon, point: np.ndarray) -> shapely.Geometry:
    return shape.intersection(shapely.Point(point).buffer(NEAR))


@pytest.mark.slow
@pytest.mark.parametrize(("robot", "obstacle"), PAIRS[::3])
def test_shapes_touch_at_random_poses_of_patches_and_overlap_nowhere_near(robot: str, obstacle: str) -> None:
    A, O = SHAPES[robot], SHAPES[obstacle]
    a, o = dense(A), dense(O)
    random = np.random.default_rng(len(robot) + 31 * len(obstacle))
    every = arc_contacts(A, O)
    for k in random.permutation(len(every))[:12]:
        contact = every[k]
        if (robot == "corner" and isinstance(contact, EdgeArc)) or (
            obstacle == "corner" and isinstance(contact, ArcEdge)
        ):
            continue  # beside its reflex vertex the edge of a grown shape ends before its core
        pose, point, u = touching(A, O, contact, tuple(random.uniform(0.15, 0.85, 2)))
        here, there = placed(a, pose), near(o, point)
        assert here.boundary.distance(shapely.Point(point)) < 1e-5 > o.boundary.distance(shapely.Point(point))
        assert near(here, point).intersection(there).area < 1e-2 * NEAR * STEP
        away, into = pose.copy(), pose.copy()
        away[:2] += STEP * u
        into[:2] -= STEP * u
        assert near(placed(a, away), point).distance(there) > 0
        assert near(placed(a, into), point).intersection(there).area > 0  # cusps are thin


@pytest.mark.slow
@pytest.mark.parametrize(("robot", "obstacle"), [*product(CONVEX, CONVEX)])
def test_convex_shapes_touch_without_overlap_at_all_poses_of_all_patches(robot: str, obstacle: str) -> None:
    A, O = CONVEX[robot], CONVEX[obstacle]
    a, o = dense(A), dense(O)
    random = np.random.default_rng(5)
    for contact in arc_contacts(A, O):
        pose, _, u = touching(A, O, contact, tuple(random.uniform(0, 1, 2)))
        here = placed(a, pose)
        assert here.distance(o) < 2e-5 and here.intersection(o).area < 2e-5
        pose[:2] += STEP * u
        assert placed(a, pose).distance(o) > 0.8 * STEP


@pytest.mark.parametrize(("robot", "obstacle"), [*product(("disc", "stadium", "car"), ("disc", "stadium", "car"))])
def test_exact_poses_of_patches_are_free_and_forbidden_a_little_further_in(robot: str, obstacle: str) -> None:
    """Decided by the core's exact arcs, which know nothing about contact surfaces."""
    A, O = SHAPES[robot], SHAPES[obstacle]
    scene, tiny = Scene(A, [O]), Fraction(1, 2**70)
    random = np.random.default_rng(9)
    for contact in arc_contacts(A, O):
        S = arc_surface(A, O, contact)
        if not isinstance(S, ArcArcSurface):
            continue
        psi = S.obstacle.first + random.uniform(0.05, 0.95) * S.obstacle.width
        phi = psi + math.pi - (S.robot.first + random.uniform(0.05, 0.95) * S.robot.width)
        pose = S.pose(psi, phi)
        ((u, v),) = Pose(0, 0, psi).apply_exact([(tiny, 0)])
        assert is_free(scene, pose) is True
        assert is_free(scene, Pose(pose.x - u, pose.y - v) @ Pose(0, 0, {"tau": pose.tau})) is False


@pytest.mark.slow
def test_beyond_the_ranges_convex_shapes_overlap() -> None:
    a, o = dense(STADIUM), dense(CAR)
    S = arc_surface(STADIUM, CAR, ArcArc(0, 1))
    assert isinstance(S, ArcArcSurface)
    corners = S.parallelogram
    for k in range(4):  # outwards across each side of the parallelogram, just off its middle
        middle = (corners[k] + corners[(k + 1) % 4]) / 2
        psi, phi = middle + 0.3 * (middle - corners.mean(axis=0))
        assert placed(a, S(psi, phi)).intersection(o).area > 1e-3


def test_local_possibility_is_that_of_signed_curvature() -> None:
    def bowl(radius: int) -> Curved:
        return Curved([(-9, -9), (9, -9), (9, 9), (-9, 9)], [Curved.circle((0, 0), radius).path])

    ball = Curved.circle((0, 0), 2)
    possible = [arc_surface(ball, bowl(r), ArcArc(0, 4)).is_possible for r in (1, 2, 3)]
    assert possible == [False, True, True]
    assert [len(arc_contacts(ball, bowl(r))) for r in (1, 2, 3)] == [8, 8, 9]  # 4 edges and 4 vertices outside
    assert [arc_curves(ball, bowl(r)) for r in (1, 2, 3)] == [(), (ArcArc(0, 4),), ()]
    i = [arc.signed_square < 0 for arc in shape_features(BAY).arcs].index(True)
    hollow = arc_surface(BAY, PLATE, ArcArc(i, 4))
    assert [arc.signed_square < 0 for arc in (hollow.robot, hollow.obstacle)] == [True, True] and not hollow.is_possible
    with pytest.raises(ValueError, match=rf"ArcArc\(i={i}, j=4\) is never a contact"):
        arc_range(BAY, PLATE, ArcArc(i, 4))
    with pytest.raises(ValueError, match="is never a contact"):
        arc_range(BAY, TRIANGLE, ArcEdge(i, 0))


def test_signs_of_sums_of_roots_are_exact() -> None:
    """A convex arc of radius sqrt(2) + 2^-60 or so does not fit into one of sqrt(2)."""

    def cap(far: Fraction) -> ArcArcSurface:
        bow = Curved([(-1, 0), (1, 0), Arc((-1, 0), center=(0, -far))])
        bite = Curved([(-5, -5), (5, -5), (5, 0), (1, 0), Arc((-1, 0), center=(0, 1), clockwise=True), (-5, 0)])
        j = [arc.signed_square < 0 for arc in shape_features(bite).arcs].index(True)
        S = arc_surface(bow, bite, ArcArc(2, j))
        assert isinstance(S, ArcArcSurface)
        return S

    tiny = Fraction(1, 2**60)
    assert [cap(1 + change).sign for change in (-tiny, Fraction(0), tiny)] == [-1, 0, 1]
    assert [cap(1 + change).is_possible for change in (-tiny, Fraction(0), tiny)] == [True, True, False]
    assert cap(Fraction(1)).sigma == 0 and cap(1 + tiny).sigma is None


def test_polygons_have_their_own_contacts_as_arcs_of_radius_0() -> None:
    square = Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    for contact in contacts(TRIANGLE, square):
        ours = (ArcEdge if isinstance(contact, VertexEdge) else EdgeArc)(contact.i, contact.j)
        S = arc_surface(TRIANGLE, square, ours)
        assert isinstance(S, OffsetSurface) and S.exact == contact_surface(TRIANGLE, square, contact)
        one, other = arc_range(TRIANGLE, square, ours), angle_range(TRIANGLE, square, contact)
        assert (one.phi_min, one.phi_range) == pytest.approx((other.phi_min, other.phi_range))
        for mine, theirs in ((one.start, other.start), (one.end, other.end)):
            assert compare_directions(mine, theirs) is Order.SAME


def test_surfaces_of_arcs_and_edges_are_those_of_polygons_with_an_offset() -> None:
    flat = Polygon([(-1, "-1/2"), (2, "-1/2"), (2, "1/2"), (-1, "1/2")])
    for kind, polygonal in ((ArcEdge, VertexEdge), (EdgeArc, EdgeVertex)):
        for i, j in product(range(4), range(3)):
            S, core = arc_surface(CAR, TRIANGLE, kind(i, j)), contact_surface(flat, TRIANGLE, polygonal(i, j))
            assert isinstance(S, OffsetSurface) and S.core == core and S.offset == pytest.approx(1 / 3)
            points = S([0.0, 0.7], 1.3) - core([0.0, 0.7], 1.3)
            assert np.hypot(*points[:, :2].T) == pytest.approx([1 / 3] * 2) and points[0] == pytest.approx(points[1])


def test_poses_on_rational_surfaces_are_exact() -> None:
    S = arc_surface(CAR, STADIUM, ArcArc(1, 0))
    assert isinstance(S, ArcArcSurface) and S.sigma == Fraction(4, 3)
    psi, theta = {"tau": "1/3"}, {"tau": "-2/5"}
    pose, turn = S.pose(psi, theta), Pose(0, 0, psi)
    ((x, y),) = pose.apply_exact([S.a])
    ((u, v),) = turn.apply_exact([(Fraction(4, 3), 0)])
    assert (x - S.p[0], y - S.p[1]) == (u, v)
    assert np.allclose(S(turn.theta, pose.theta)[:2], [float(pose.x), float(pose.y)])
    edge = arc_surface(CAR, TRIANGLE, EdgeArc(2, 1))
    assert isinstance(edge, OffsetSurface) and edge.exact is not None  # its length is 3
    assert np.allclose(edge.exact(0.25, 1.0), edge(0.25, 1.0))
    assert edge.pose("1/4", "90deg") == edge.helix("1/4").pose("90deg")


def test_irrational_surfaces_have_no_exact_poses_and_say_so() -> None:
    with pytest.raises(ValueError, match=r"ArcArc\(i=2, j=0\): sum of the radii irrational"):
        arc_surface(CAP, STADIUM, ArcArc(2, 0)).pose(0, 0)
    with pytest.raises(ValueError, match=r"ArcEdge\(i=0, j=0\): radius or length of the edge irrational"):
        arc_surface(DISC, TRIANGLE, ArcEdge(0, 0)).helix(0)


@pytest.mark.parametrize("angle", ["30deg", "-90deg", {"tau": "3/7"}])
def test_both_families_of_helices_are_rotations(angle: object) -> None:
    """Turning about the robot's own centre keeps psi; turning about the obstacle's centre keeps psi - phi."""
    S = arc_surface(CAR, STADIUM, ArcArc(1, 0))
    assert isinstance(S, ArcArcSurface)
    psi, theta = {"tau": "1/3"}, {"tau": "-2/5"}
    start, turned = S.pose(psi, theta), Pose(0, 0, theta) @ Pose(0, 0, angle)  # type: ignore[arg-type]
    about_robot = S.helix(psi)
    motion = Rotation(about_robot.centre, angle)  # type: ignore[arg-type]
    assert motion.apply(start) == S.pose(psi, {"tau": turned.tau})
    assert list(start.apply_exact([S.a])) == [about_robot.centre]
    chi = Pose(0, 0, psi) @ Pose(0, 0, theta).inverse()
    rolling = S.rolling_helix({"tau": chi.tau})
    assert rolling.centre == S.p and rolling.pose(theta) == start
    rolled = Rotation(S.p, angle).apply(start)  # type: ignore[arg-type]
    further = Pose(0, 0, psi) @ Pose(0, 0, angle)  # type: ignore[arg-type]
    assert rolled == S.pose({"tau": further.tau}, {"tau": turned.tau})


def test_ranges_are_as_wide_as_the_turns() -> None:
    A, O = shape_features(STADIUM), shape_features(CAR)
    for contact in arc_contacts(STADIUM, CAR):
        width = {
            ArcEdge: lambda i, _: A.arcs[i].width, EdgeArc: lambda _, j: O.arcs[j].width,
            ArcArc: lambda i, j: A.arcs[i].width + O.arcs[j].width,
        }[type(contact)](contact.i, contact.j)  # fmt: skip
        assert arc_range(STADIUM, CAR, contact).phi_range == pytest.approx(width)
    whole = arc_range(DISC, STADIUM, ArcArc(0, 0))
    assert whole.phi_range == math.tau and whole.locate((3, -4)) is Location.INSIDE


def test_the_exact_parallelogram_is_that_of_the_angles() -> None:
    random = np.random.default_rng(7)
    for A, O, contact in ((CAR, STADIUM, ArcArc(1, 0)), (STADIUM, STADIUM, ArcArc(0, 1)), (DISC, CAP, ArcArc(0, 1))):
        S = arc_surface(A, O, contact)
        assert isinstance(S, ArcArcSurface)
        assert S.parallelogram[:, 1].max() - S.parallelogram[:, 1].min() == pytest.approx(
            S.robot.width + S.obstacle.width
        )
        for _ in range(200):
            normal, turn = random.integers(-9, 10, (2, 2)).tolist()
            if not any(normal) or not any(turn):
                continue
            psi, phi = math.atan2(normal[1], normal[0]), math.atan2(turn[1], turn[0])
            shares = [(angle - arc.first) % math.tau / arc.width
                      for angle, arc in ((psi, S.obstacle), (psi + math.pi - phi, S.robot))]  # fmt: skip
            place = S.locate(tuple(normal), tuple(turn))
            if any(min(abs(s), abs(s - 1), abs(s - math.tau / a.width)) < 1e-9
                   for s, a in zip(shares, (S.obstacle, S.robot), strict=True) if not a.is_whole):  # fmt: skip
                assert place is not Location.INSIDE
            else:
                assert (place is Location.INSIDE) == all(s < 1 for s in shares)


def test_grids_are_points_of_the_surface() -> None:
    S = arc_surface(DISC, CAR, ArcArc(0, 2))
    assert isinstance(S, ArcArcSurface)
    psi, phi = np.linspace(0, 1, 3), np.linspace(2, 5, 4)
    assert np.array_equal(S.grid(psi, phi), S(psi[None, :], phi[:, None])[..., :2])


def test_a_disc_in_a_hole_of_its_radius_turns_about_the_common_centre() -> None:
    A: Shape = Curved.circle(("1/2", 0), 2)
    S = arc_surface(A, PLATE, ArcArc(0, 4))
    assert isinstance(S, ArcArcSurface) and S.sigma == 0 and S.sign == 0
    helix = S.helix(0)
    assert helix.centre == (0, 0) and helix.fixed == (Fraction(1, 2), 0) and helix == S.helix("90deg")


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_a_circle_of_several_arcs_is_the_same_disc(count: int) -> None:
    """Joints between arcs are smooth: no vertices, and a torus again."""
    points = [(5, 0), (0, 5), (-5, 0), (0, -5)][: max(count, 2) if count != 3 else 3]
    arcs = [Arc(end, center=(0, 0)) for end in [*points[1:], points[0]]] if count > 1 else [Arc((5, 0), center=(0, 0))]
    ring = Curved([(5, 0), *arcs])
    features = shape_features(ring)
    assert len(features.arcs) == count and not features.edges
    assert (features.area, features.perimeter) == pytest.approx((25 * math.pi, 10 * math.pi))
    for other in (ring, DISC, TRIANGLE, CAR):
        assert tiling(ring, other).euler_number == tiling(other, ring).euler_number == 0


def test_arcs_of_more_than_half_a_turn_have_their_whole_range() -> None:
    key = Curved([(3, -4), (9, -4), (9, 4), (3, 4), Arc((3, -4), center=(0, 0))])
    k = [arc.signed_square for arc in shape_features(key).arcs].index(25)
    Phi = arc_range(key, TRIANGLE, ArcEdge(k, 0))
    assert Phi.phi_range == shape_features(key).arcs[k].width > 1.2 * math.pi
    assert arc_range(key, key, ArcArc(k, k)).phi_range == math.tau
    S = arc_surface(key, key, ArcArc(k, k))
    assert isinstance(S, ArcArcSurface) and S.sigma == 10
    assert S.locate((-1, 0), (-1, 0)) is Location.INSIDE and S.locate((1, 0), (-1, 0)) is Location.OUTSIDE


def test_features_that_do_not_exist_are_named() -> None:
    for contact, words in (
        (ArcEdge(7, 0), "arc of the robot 7: there are 3"), (ArcEdge(0, 9), "edge of the obstacle 9: there are 4"),
        (EdgeArc(-1, 0), "edge of the robot -1: there are 3"), (ArcArc(0, 4), "arc of the obstacle 4: there are 4"),
    ):  # fmt: skip
        for function in (arc_surface, arc_range):
            with pytest.raises(ValueError, match=words):
                function(TRIANGLE, CAR, contact)
