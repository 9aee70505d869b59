"""The core in the page among rounded shapes: the same bytes as in Python, closed meshes, true arcs, proofs by cells."""

from __future__ import annotations

import hashlib
import json
import math
from collections import Counter
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cfree
from cfree import Curved, Pose, Scene, verify
from cfree.contact import ArcArc, arc_surface
from cfree.curves import Arc
from cfree.formats.scene_file import scene_text
from cfree.geometry import arc_geometry
from cfree.scene.rounded import rounded, rounded_shapes
from page_core import NODE, asked, columns_of, said

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(NODE is None, reason="node is not installed: the page's core was not run"),
]

TRIANGLE = [("-0.6", "-0.4"), ("0.8", "-0.4"), (0, "0.8")]
KITE = [(-2, -1), (0, "-1.6"), ("1.2", 0), ("-0.4", 1)]
WALL = [("2.5", -3), ("3.2", -3), ("3.2", "0.6"), ("2.5", "0.2")]
BOX = [(-1, "-0.4"), (1, "-0.4"), (1, "0.4"), (-1, "0.4")]
L = [(-4, 2), ("0.5", 2), ("0.5", "2.6"), ("-3.4", "2.6"), ("-3.4", 4), (-4, 4)]
ROOM = [(-5, -3), (5, -3), (5, 3), (-5, 3)]


def disc(x: float | str, y: float | str, radius: float | str | Fraction) -> Curved:
    return Curved.circle((x, y), radius)


def stadium(half: int, radius: str) -> Curved:
    low, high = (f"-{radius}", radius)
    first, last = Arc((half, high), center=(half, 0)), Arc((-half, low), center=(-half, 0))
    return Curved([(-half, low), (half, low), first, (-half, high), last])


def ring(radius: str) -> list[Curved]:
    near = "1.5"
    corners = [(near, near), (f"-{near}", near), (near, f"-{near}"), (f"-{near}", f"-{near}")]
    return [disc(x, y, radius) for x, y in [(2, 0), (-2, 0), (0, 2), (0, -2), *corners]]


GROWN = Curved(TRIANGLE, grown="1/5")
HALF = Curved([(1, 0), Arc((-1, 0), center=(0, 0))])
LENS = Curved([("-0.8", 0), Arc(("0.8", 0), center=(0, "0.6")), Arc(("-0.8", 0), center=(0, "-0.6"))])
DOME = Curved([(2, -1), (4, -1), (4, 0), Arc((2, 0), center=(3, 0))])
UNEQUAL = Curved(  # a rectangle with corners of different radii
    [
        (("0.2"), 0),
        ("2.5", 0),
        Arc((3, "0.5"), center=("2.5", "0.5")),
        (3, 1),
        Arc((2, 2), center=(2, 1)),
        ("0.3", 2),
        Arc((0, "1.7"), center=("0.3", "1.7")),
        (0, "0.2"),
        Arc(("0.2", 0), center=("0.2", "0.2")),
    ]
)
NOTCHED = Curved([(5, 0), Arc((-5, 0), center=(0, 0)), (-1, 0), (3, 3), (1, 0)])  # whose chords are cut
PLATE = Curved([(-3, -3), (4, -3), (4, 3), (-3, 3)], [Curved.circle(("0.5", 0), 2).path])
BAY = Curved([(2, -2), (5, -2), (5, 2), (2, 2), (2, 1), Arc((2, -1), center=(2, 0), clockwise=True)])
BRACKET = Curved(
    [(-4, -3), (3, -3), (3, -2), (-2, -2), Arc((-3, -1), center=(-2, -1), clockwise=True), (-3, 3), (-4, 3)]
)
HALL = Curved([(-6, -4), (4, -4), Arc((6, -2), center=(4, -2)), (6, 4), (-6, 4)], [Curved.circle((2, 1), 1).path])
SLOT = [[(1, "0.3"), (6, "0.3"), (6, "2.5"), (1, "2.5")], [(1, "-2.5"), (6, "-2.5"), (6, "-0.3"), (1, "-0.3")]]
SCENES = {
    "disc among polygons": Scene(disc(0, 0, "1/2"), [KITE, WALL, disc("2.2", 2, "0.4"), L]),
    "stadium in a slot": Scene(stadium(1, "1/4"), [*SLOT, disc(-1, 2, "1/2")]),
    "grown triangle among discs": Scene(GROWN, ring("0.6")),
    "polygon among discs": Scene(TRIANGLE, ring("1/2")),
    "grown rectangle in a room": Scene(Curved(BOX, grown="0.1"), [Curved(KITE, grown="0.2")], workspace=ROOM),
    "disc in a gap of its own width": Scene(
        disc(0, "0.25", "0.375"),
        [
            [("0.25", "2.5"), (1, "2.25"), ("1.5", "2.5"), (2, 4)],
            Curved(
                [(1, "0.5"), (5, "0.5"), Arc((5, "1.5"), center=(5, 1)), (1, "1.5"), Arc((1, "0.5"), center=(1, 1))]
            ),
        ],
    ),
    "half disc among a kite and a disc": Scene(HALF, [KITE, disc(3, 1, 1)]),
    "lens and a dome": Scene(LENS, [DOME, disc(3, 3, "0.5")]),
    "unequal corners in a room": Scene(
        UNEQUAL,
        [KITE, disc(4, 0, 1), Curved([*SLOT[0], (1, "1.4")], grown="0.2")],
        workspace=[(-6, -6), (9, -6), (9, 6), (-6, 6)],
    ),
    "polygon about a notched half disc": Scene(TRIANGLE, [NOTCHED]),
    "discs of two radii": Scene([disc(0, 0, "1/2"), disc(1, 0, "1/3")], [KITE, LENS]),
    "parts of several radii in bounds": Scene([GROWN, disc(-1, 0, "1/3"), HALF], [DOME, KITE], bounds=(-6, -6, 6, 6)),
    "half disc in a round hole": Scene(HALF, [PLATE]),
    "grown triangle and a bay": Scene(GROWN, [BAY, DOME]),
    "bracket among a lens and a polygon": Scene(BRACKET, [LENS, WALL]),
    "lens in a bracket": Scene(LENS, [BRACKET, BAY]),
    "grown triangle in a hall": Scene(GROWN, [KITE], workspace=HALL),
    "triangle in a round room": Scene(TRIANGLE, [LENS], workspace=disc(0, 0, 4)),
    "two discs in bounds": Scene([disc(0, 0, "1/2"), disc(1, 0, "1/2")], [KITE, disc(3, 0, 1)], bounds=(-6, -6, 6, 6)),
}


def opened(scene: Scene, *calls: list[Any]) -> list[dict[str, Any]]:
    """Answers to calls after a scene has been opened and its boundary computed."""
    first, counts, *answers = asked(["open", scene_text(scene)], ["boundary"], *calls)
    assert "around" not in first and "fault" not in counts, (first, counts)
    return answers


def values(answer: dict[str, Any], name: str) -> np.ndarray[Any, Any]:
    return np.array(answer[name]["values"])


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.long] if name == "lens in a bracket" else []) for name in SCENES]
)
def test_boundary_and_cells_of_rounded_shapes_have_the_same_bytes(name: str) -> None:
    [found] = opened(SCENES[name], ["columns"])
    expected = columns_of(SCENES[name])
    assert set(found) == set(expected)
    for column, content in expected.items():
        assert found[column]["sha256"] == hashlib.sha256(np.ascontiguousarray(content).tobytes()).hexdigest(), column


def mesh_of(scene: Scene, error: float = 0.02) -> tuple[dict[str, Any], np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    """Mesh columns, the vertices and the triangles of the page."""
    [mesh] = opened(scene, ["all mesh", error, 1e6])
    return mesh, values(mesh, "xyz").reshape(-1, 3), values(mesh, "corners").reshape(-1, 3)


@pytest.mark.long
@pytest.mark.parametrize("name", SCENES)
def test_meshes_of_rounded_shapes_are_closed(name: str) -> None:
    _, xyz, corners = mesh_of(SCENES[name])
    # one vertex for all patches at a point, and for both ends of the turn
    names: dict[tuple[float, ...], int] = {}
    theta = np.where(xyz[:, 2] > 1.5 * math.pi - 1e-9, xyz[:, 2] - 2 * math.pi, xyz[:, 2])
    points = np.column_stack([xyz[:, :2], theta]).round(7) + 0.0
    vertex = np.array([names.setdefault(tuple(p), len(names)) for p in points.tolist()])
    edges = Counter[tuple[int, int]]()
    for a, b, c in vertex[corners].tolist():
        edges.update([(a, b), (b, c), (c, a)])
    assert all(edges[p, q] == edges[q, p] for p, q in edges if p != q)


@pytest.mark.parametrize(
    ("robot", "obstacle"),
    [(GROWN, disc(2, 1, "0.7")), (GROWN, Curved(KITE, grown="0.3")), (disc(1, 0, "1/2"), KITE), (KITE, disc(0, 0, 1))],
    ids=["triangle-disc", "triangle-kite", "disc off its point-kite", "kite-disc"],
)
def test_meshes_have_the_volume_of_the_pillar_of_a_pair(robot: Any, obstacle: Any) -> None:
    mesh, xyz, corners = mesh_of(Scene(robot, [obstacle]), 0.005)
    p, q, r = (xyz[corners[:, k]] for k in range(3))
    across = np.cross(q - p, r - p)[:, 0] / 2  # area as seen along x
    volume = float((across * (p + q + r)[:, 0] / 3).sum())

    def parts(shape: Any) -> tuple[float, float, float]:  # area, perimeter, radius of the core
        found = rounded(shape if isinstance(shape, Curved) else cfree.Polygon(shape))
        assert found is not None
        if not isinstance(found.core, cfree.Polygon):
            return 0.0, 0.0, float(found.radius)
        points = [complex(*map(float, p)) for p in found.core.vertices]
        turned = [*points[1:], points[0]]
        area = sum((a.conjugate() * b).imag for a, b in zip(points, turned, strict=True)) / 2
        perimeter = sum(abs(b - a) for a, b in zip(points, turned, strict=True))
        return area, perimeter, float(found.radius)

    (A, a, r1), (O, o, r2) = parts(robot), parts(obstacle)
    rho = r1 + r2
    expected = 2 * math.pi * (A + O) + a * o + 2 * math.pi * rho * (a + o) + 2 * math.pi**2 * rho**2
    assert volume == pytest.approx(expected, rel=0.01)
    assert 2 in values(mesh, "kind")


def test_normals_and_curvatures_of_arcs_on_arcs_are_those_of_python() -> None:
    scene = Scene(disc(1, "0.5", "1/2"), [disc(2, 1, "0.7")])
    mesh, xyz, _ = mesh_of(scene)
    length = math.hypot(1, 0.5) + 0.5
    circular = arc_surface(scene.robot[0], scene.obstacles[0], ArcArc(0, 0)).circular
    c, s = np.cos(xyz[:, 2]), np.sin(xyz[:, 2])
    away = xyz[:, :2] - np.column_stack([2 - (c - s / 2), 1 - (s + c / 2)])
    assert np.allclose(np.hypot(*away.T), 1.2)
    there = arc_geometry(circular, np.arctan2(away[:, 1], away[:, 0]), xyz[:, 2], angle_scale=length)
    assert np.allclose(values(mesh, "normal").reshape(-1, 3), there.normal)
    assert np.allclose(values(mesh, "gaussian"), there.gaussian_curvature * length**2)
    assert np.allclose(values(mesh, "mean"), there.mean_curvature * length)
    # a saddle on one side, bulging on the other
    assert values(mesh, "gaussian").min() < -0.1 and values(mesh, "gaussian").max() > 0.1


def test_slices_have_the_radii_of_their_arcs() -> None:
    scene = Scene(disc(0, 0, "1/2"), [disc(2, 0, 1), [(-3, 0), (-2, 0), (-2, 1)]])
    [cut] = opened(scene, ["all slice", 0.3])
    kind, bend = values(cut, "kind"), values(cut, "segments.bend")
    assert set(kind[bend > 0]) == {2} and set(kind[bend == 0]) == {0}
    assert set(bend) == {0.0, 0.5, 1.5}
    rings, start = values(cut, "bend"), values(cut, "start")
    assert set(rings) == {-1e300, 0.0, 0.5, 1.5}  # the first: a point of a chord
    for first, last in pairwise(start.tolist()):
        points = values(cut, "xy").reshape(-1, 2)[first:last]
        if 1.5 in rings[first:last]:
            assert np.allclose(np.hypot(points[:, 0] - 2, points[:, 1]), 1.5)


def test_a_slice_in_a_round_hole_has_its_radius_below_0() -> None:
    plate = Curved([(-3, -3), (3, -3), (3, 3), (-3, 3)], [Curved.circle((0, 0), "3/2").path])
    [cut] = opened(Scene(disc(0, 0, "1/2"), [plate]), ["all slice", 0.3])
    for name in ("bend", "segments.bend"):
        assert set(values(cut, name)) - {-1e300} == {-1.0, 0.0, 0.5}
    xy, bend = values(cut, "xy").reshape(-1, 2), values(cut, "bend")
    assert np.allclose(np.hypot(*xy[bend == -1].T), 1)


NAMED = ("kind", "robot_vertex", "obstacle", "obstacle_vertex")
PICKED = [*SCENES][::2]


@pytest.mark.long
@pytest.mark.parametrize("name", PICKED)
def test_picked_poses_are_in_contact(name: str) -> None:
    mesh, xyz, corners = mesh_of(SCENES[name], 0.2)
    face, owner = values(mesh, "face").tolist(), values(mesh, "owner")
    last = dict(zip(face, range(len(face)), strict=True)).values()  # a triangle of each trapezoid
    chosen = [t for t in last if owner[corners[t, 0]] >= 0][::5]
    places = [xyz[corners[t]].mean(axis=0).tolist() for t in chosen]
    picked = opened(SCENES[name], *(["picked", face[t], *place] for t, place in zip(chosen, places, strict=True)))
    verdicts = opened(SCENES[name], *(["pose", answer["pose"]] for answer in picked))
    exact = 0
    for answer, verdict, (x, y, _) in zip(picked, verdicts, places, strict=True):
        assert math.dist(verdict["place"]["values"][:2], (x, y)) < 0.3
        if verdict["free"]["values"] == [0]:
            continue  # the triangle is beyond the rim of its patch
        contact = tuple(answer[f"contact.{column}"]["values"][0] for column in NAMED)
        touching = {*zip(*(verdict[f"touching.{column}"]["values"] for column in NAMED), strict=True)}
        # next to an edge of irrational length that is moved outwards
        assert contact in touching or (contact[0] != 2 and verdict["clearance"]["values"][0] < 1e-6)
        exact += contact in touching
    assert exact > len(chosen) / 4


def proved(scene: Scene, folder: Path) -> cfree.Separated:
    """The proof of the page, as it is saved, which Python verifies."""
    assert scene.start is not None and isinstance(scene.goal, Pose)
    question = ["plan", said(scene.start), said(scene.goal), "", 0]
    _, answer, written = asked(["open", scene_text(scene)], question, ["written"])
    assert answer["verdict"] == "apart" and answer["closed"]["values"] == [1], answer
    file = folder / "answer.json"
    file.write_text(written["answer"].replace("{sha256}", hashlib.sha256(written["scene"].encode()).hexdigest()))
    proof = cfree.load(file)
    assert isinstance(proof, cfree.Separated) and verify.answer(scene, proof).verified
    assert list(proof.obstacles) == sorted(answer["obstacles"]["values"])
    return proof


@pytest.mark.parametrize("robot", [GROWN, TRIANGLE, disc(0, 0, "1/2")], ids=["grown", "polygon", "disc"])
def test_cells_of_smaller_shapes_prove_that_there_is_no_motion(robot: Any, tmp_path: Path) -> None:
    proof = proved(Scene(robot, ring("0.6"), start=(0, 0, 0), goal=(5, 0, 0)), tmp_path)
    assert proof.rounded is not None and "polygons" not in json.loads((tmp_path / "answer.json").read_text())
    given = rounded_shapes(Scene(robot, ring("0.6")))
    assert given is not None
    radii, smaller = ([x.radius for x in (*cores.robot, *cores.obstacles)] for cores in (given, proof.rounded))
    assert all(r <= s for r, s in zip(smaller, radii, strict=True)) and radii != smaller


def gap_of(width: Fraction, at: Fraction = Fraction(0)) -> Scene:
    """A disc of diameter 1 in a room that two walls with round ends divide, but for a gap."""
    walls = []
    for side in (-1, 1):
        end = at + side * (width / 2 + Fraction(1, 2))
        walls += [disc(end, 0, "1/2"), [(6 * side, "-0.2"), (end, "-0.2"), (end, "0.2"), (6 * side, "0.2")]]
    return Scene(disc(0, 0, "1/2"), walls, workspace=ROOM, start=(-2, -2, 0), goal=("2.3", 2, 0))


def test_a_gap_too_narrow_by_a_part_of_2_to_the_60_is_proved_closed(tmp_path: Path) -> None:
    assert -2 in proved(gap_of(1 - Fraction(1, 2**60)), tmp_path).obstacles


@pytest.mark.parametrize(
    ("width", "verdict", "joined"),
    [(1 + Fraction(1, 1000), "path", 1), (1 + Fraction(1, 10**18), "round", 1), (Fraction(1), "round", 0)],
)
def test_cells_tell_of_gaps_where_searches_find_nothing(width: Fraction, verdict: str, joined: int) -> None:
    scene = gap_of(width, at=Fraction(1, 3))  # a search comes to multiples of a power of two
    assert scene.start is not None and isinstance(scene.goal, Pose)
    ends = said(scene.start), said(scene.goal)
    answer, cells = opened(scene, ["plan", *ends, "", 0], ["joined", *ends])
    assert answer["verdict"] == verdict and cells["joined"]["values"] == [joined]


@pytest.mark.parametrize(("gap", "joined"), [(Fraction(6, 10), 1), (Fraction(4, 10), 0)])
def test_cells_of_arcs_as_sides_tell_whether_poses_are_joined(gap: Fraction, joined: int) -> None:
    high = gap / 2 + 1
    upper = Curved([(-1, high), Arc((1, high), center=(0, high)), (1, 5), (-1, 5)])
    lower = Curved([(1, -high), Arc((-1, -high), center=(0, -high)), (-1, -5), (1, -5)])
    [cells] = opened(Scene(disc(0, 0, "1/4"), [upper, lower], bounds=(-4, -4, 4, 4)), ["joined", "-3 0 0", "3 0 0"])
    assert cells["joined"]["values"] == [joined]


def test_shapes_that_are_not_rounded_are_named_with_the_error_of_their_polygons() -> None:
    hill = Curved([(-1, -2), (1, -2), Arc((-1, -2), through=("1/2", "3/10"))], [])  # of an irrational radius
    scene = Scene(disc(0, 0, "1/2"), [KITE, hill, disc(4, 0, 1)])
    read, counts, cut, pose = asked(["open", scene_text(scene)], ["boundary"], ["all slice", 0], ["pose", "9 0 0"])
    assert read["around.shapes"]["values"] == [1] and 0 < read["around"]["values"][0] < 0.01
    assert "fault" not in counts
    assert 1.5 in cut["segments.bend"]["values"]  # the disc is exact
    assert "cells" not in pose  # of another boundary
    two = Scene([disc(0, 0, "1/2"), hill], [KITE])
    assert asked(["open", scene_text(two)])[0]["around.shapes"]["values"] == [-3]


def test_the_outline_of_a_grown_polygon_with_a_short_edge_between_hollows_is_the_union() -> None:
    notch = [(-2, 0), (2, 0), (2, 2), ("0.1", 2), ("0.1", 1), ("-0.1", 1), ("-0.1", 2), (-2, 2)]
    [read] = asked(["open", scene_text(Scene(disc(0, 0, 1), [Curved(notch, grown="1/2")]))])
    xy, bend = np.array(read["obstacles.xy"]["values"]).reshape(-1, 2), read["obstacles.bend"]["values"]
    assert set(bend) == {0.0, 0.5} and xy[:, 1].max() == 2.5
    assert min(math.dist(p, (0, 2 + math.sqrt(0.24))) for p in xy.tolist()) < 1e-9  # the arcs of both corners meet
