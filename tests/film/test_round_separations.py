"""Films of separations among rounded shapes: the surface is closed, the robot stays on its side, the words are true."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import shapely

import cfree
from arc_rings import BAY, plate, shape
from cfree import Curved, Pose, Scene
from cfree.collision.pose_checker import is_free
from cfree.curves import Arc
from cfree.film.montage import views
from cfree.film.separation_film import answer_of, separation_film
from cfree.film.storyboard import Shot
from cfree.forbidden.boundary import Boundary
from cfree.planning.separation import Separated
from cfree.plot.answer import surface_of
from cfree.scene.scene import with_ends

HALL = [(0, 0), (12, 0), (12, 6), (0, 6)]
ENDS: Any = {"start": (2, 3, 0), "goal": (10, 3, 0)}
SQUARE = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
STADIUM = Curved([(0, 0), (2, 0), Arc((2, 1), center=(2, "1/2")), (0, 1), Arc((0, 0), center=(0, "1/2"))])


def posts(x: Any, *ys: Any, radius: Any = 1) -> list[Curved]:
    return [Curved.circle((x, y), radius) for y in ys]


def disc() -> Scene:
    """A disc about its reference point: nothing depends on theta."""
    return Scene(Curved.circle((0, 0), 1), posts(6, 1, 3, 5), workspace=HALL, **ENDS)


def stadium() -> Scene:
    round_room = Curved.circle((0, 0), 8)
    row = posts(0, -7, -4, "-1.25", "1.25", 4, 7, radius="1.2")
    return Scene(STADIUM, row, workspace=round_room, start=(-5, 0, 0), goal=(4, 0, 0))


def hole() -> Scene:
    return Scene(SQUARE, [plate()], start=(0, 0, 0), goal=(9, 9, 0))


def fillets() -> Scene:
    """A robot with a round bay among discs: the discs are made smaller."""
    cage = [Curved.circle((x, y), 4) for x, y in ((5, 3), (-5, 3), (0, -6))]
    return Scene(shape(BAY, by="3/10"), cage, start=(0, 0, 0), goal=(17, 0, 0), bounds=(-20, -20, 20, 20))


def two_parts() -> Scene:
    robot = [STADIUM, Curved([(0, 0), (1, 0), (1, 1)], grown="1/3")]
    walls = [
        Curved([(6, 0), (7, 0), (7, 2), (6, 2)], grown="1/2"),
        Curved([(6, 4), (7, 4), (7, 6), (6, 6)], grown="3/4"),
    ]
    return Scene(robot, walls, workspace=HALL, start=(2, 3, 0), goal=(9, 3, 0))


SCENES: dict[str, tuple[Callable[[], Scene], str]] = {
    "disc": (disc, "surface of a slightly smaller robot"),
    "stadium": (stadium, "surface of a slightly smaller robot"),
    "hole": (hole, "surface of a slightly smaller robot"),
    "fillets": (fillets, "surface of slightly smaller obstacles"),
    "two parts": (two_parts, "surface of a slightly smaller robot"),
}
QUICK = "disc"


def is_around(surface: Boundary, pose: Pose) -> bool:
    """True if a surface is around a pose, by a ray in its slice; each end of a line there is the end of another one."""
    lines = [np.asarray(line) for line in surface.slice(pose.theta).lines]
    ends = np.array([end for line in lines for end in (line[0], line[-1])]).reshape(-1, 2)
    apart = np.hypot(*(ends[:, None] - ends[None]).transpose(2, 0, 1))
    assert ((apart < 1e-6).sum(axis=1) % 2 == 0).all(), "an open end"
    x, y = float(pose.x), float(pose.y) + 7e-6  # beside ends of lines
    steps = np.concatenate([np.stack((line[:-1], line[1:]), axis=1) for line in lines])
    (ax, ay), (bx, by) = steps[:, 0].T, steps[:, 1].T
    level = (ay <= y) != (by <= y)
    at = ax[level] + (y - ay[level]) / (by - ay)[level] * (bx - ax)[level]
    return bool((at < x).sum() % 2)


def moments_of(shots: list[Shot]) -> list[Pose]:
    return [moment.pose for shot in shots for moment in shot.moments]


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[] if name == QUICK else [pytest.mark.slow]) for name in SCENES]
)
def test_the_robot_stays_on_its_side_of_a_closed_surface_that_is_named(name: str) -> None:
    make, said = SCENES[name]
    scene = make()
    found = cfree.boundary(scene)
    answer = answer_of(found)
    assert answer.rounded is not None and answer.curved == scene
    stage, shots = separation_film(found, answer, 20, (160, 90), 4)
    surface, poses = surface_of(answer, scene), moments_of(shots)
    side = is_around(surface, answer.start)
    assert is_around(surface, answer.goal) != side
    assert all(is_around(surface, pose) == side for pose in poses[::2])
    assert all(is_free(scene, pose) for pose in poses) and poses[0] == answer.start
    assert np.ptp([float(pose.x) for pose in poses]) > 0.3  # it moves
    x0, y0, x1, y1 = stage.plane._window  # and all of it is seen
    assert all(x0 < float(q.x) < x1 and y0 < float(q.y) < y1 for q in poses)
    seen = [view for view, _ in views(stage, shots, 4)]
    assert {view.surface for view in seen[: len(shots[0].moments)]} == {""} and seen[-1].surface == said
    if name == QUICK:
        stage.draw(seen[-1])
        assert stage.caption.get_text() == said
    heights = np.ptp(stage.space.angles, axis=1)
    assert (seen[-1].shown[:, 1] - seen[-1].shown[:, 0]).sum() == pytest.approx(heights.sum(), rel=1e-3)


@pytest.mark.slow
def test_polygons_inside_the_shapes_are_named_and_counted_as_the_shapes() -> None:
    """No smaller shapes are known of a bay in a round hole; the ring of the hole has several polygons inside."""
    obstacles = [Curved.circle((30, 0), 1), plate(0, 0, 5, 4)]
    scene = Scene(shape(BAY, by="3/10"), obstacles, start=(0, 0, 0), goal=(12, 0, 0))
    found = cfree.boundary(scene)
    answer = answer_of(found)
    assert answer.rounded is None and answer.scene is not None and answer.curved == scene
    stage, shots = separation_film(found, answer, 20, (160, 90), 4)
    assert shots[-1].surface == "surface of polygons inside the shapes"
    assert shots[-1].note == "separated by $O_{2}$"
    assert all(is_free(scene, pose) for pose in moments_of(shots))
    assert stage.plane.scene == scene  # the robot and the hole are round


@pytest.mark.parametrize("is_round", [True, False])
def test_a_film_of_a_clearance_keeps_it(is_round: bool) -> None:
    gap = posts(6, 1, 5, radius="1/2") if is_round else [[(5, 0), (7, 0), (7, "5/2"), (5, "5/2")]]
    scene = Scene(Curved.circle((0, 0), 1) if is_round else SQUARE, gap, workspace=HALL, **ENDS)
    clearance = Fraction(6, 10) if is_round else Fraction(4, 5)
    answer = cfree.plan(scene, clearance=clearance)
    assert isinstance(answer, Separated) and not isinstance(cfree.plan(scene), Separated)
    _, shots = separation_film(cfree.boundary(scene), answer, 30, (160, 90), 4)
    assert shots[-1].title == f"No path of clearance {float(clearance):g}: each ends at the surface"
    poses = moments_of(shots)
    room = shapely.Polygon(HALL).difference(shapely.union_all([o.to_shapely() for o in scene.outer(1e-3).obstacles]))
    robot = scene.outer(1e-3).robot[0].vertices
    for pose in poses:
        assert room.exterior.distance(shapely.Polygon(pose.apply(robot))) > float(clearance) - 3e-3
    assert max(float(pose.x) for pose in poses) < 6 < float(answer.goal.x)


def test_ends_that_are_forbidden_or_joined_have_no_film() -> None:
    scene = with_ends(disc(), Pose(2, 3), Pose(6, 3))
    with pytest.raises(cfree.InvalidPoseError, match=r"goal .* is forbidden"):
        answer_of(cfree.boundary(scene))
    with pytest.raises(ValueError, match="there is a path from start to goal"):
        answer_of(cfree.boundary(with_ends(scene, Pose(2, 3), Pose(3, 3))))
    with pytest.raises(cfree.UnsupportedError, match=r"scene\.inner"):
        cfree.boundary(Scene(SQUARE, [Curved.ellipse((6, 3), (1, 4))], workspace=HALL, **ENDS))
