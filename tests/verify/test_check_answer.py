"""`tools/check_answer.py` says of answers what `cfree.verify` says, and needs nothing but Python.

That it does so of mutants is asserted where they are made, in `answer_mutations.py`.
"""

from __future__ import annotations

import ast
import json
import random
import subprocess
import sys
from decimal import Decimal
from fractions import Fraction
from itertools import pairwise
from pathlib import Path as FilePath
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from answers import corridor, separations, tee
from cfree import Path, Pose, Rotation, Scene, Translation, load_scene, plan, save
from cfree.errors import InvalidPolygonError
from cfree.formats.scene_file import scene_from_text
from cfree.polygons.polygon import Polygon
from cfree.scene.digest import stamp_of
from second_opinion import TOOL, check_answer, verified_in_a_file
from shapes import box
from spaces import ROD, TIGHT

ROOT = FilePath(__file__).parents[2]
SQUARE = box("-1/2", "-1/2", "1/2", "1/2")[0]


def run(*arguments: str | FilePath) -> tuple[int, str]:
    """The command, by a Python that finds no package but its own library."""
    done = subprocess.run([sys.executable, "-I", "-S", str(TOOL), *map(str, arguments)], capture_output=True, text=True)
    assert not done.stderr, done.stderr
    return done.returncode, done.stdout


def test_nothing_is_imported_but_the_standard_library() -> None:
    imported = {
        (node.module if isinstance(node, ast.ImportFrom) else node.names[0].name).split(".")[0]  # type: ignore[union-attr]
        for node in ast.walk(ast.parse(TOOL.read_text()))
        if isinstance(node, (ast.Import, ast.ImportFrom))
    }
    assert imported <= sys.stdlib_module_names, imported - sys.stdlib_module_names
    assert len(TOOL.read_text().splitlines()) < 2570


@pytest.mark.skipif(not FilePath("/dev/full").exists(), reason="needs /dev/full")
def test_a_line_that_cannot_be_written_refutes_nothing(tmp_path: FilePath) -> None:
    with open("/dev/full", "w") as full:
        done = subprocess.run([sys.executable, str(TOOL)], stdout=full, stderr=subprocess.PIPE, text=True)
    assert (done.returncode, len(done.stderr.splitlines())) == (2, 1)
    with subprocess.Popen([sys.executable, str(TOOL)], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as command:
        assert command.stdout is not None
        command.stdout.close()
    assert command.returncode == 2


@pytest.mark.slow
def test_the_command_says_it_in_one_line_and_an_exit_code(tmp_path: FilePath) -> None:
    scene, path = corridor()
    save(scene, tmp_path / "scene.json")
    save(Path(path.start, path.motions, scene=scene), tmp_path / "way.json")
    text = (tmp_path / "way.json").read_text()
    (tmp_path / "other.json").write_text(
        text.replace('"exact": {"vector": ["0", "3"]', '"exact": {"vector": ["0", "4"]')
    )
    save(Scene(ROD[0], [TIGHT[0]]), tmp_path / "elsewhere.json")
    (tmp_path / "map.json").write_text('{"type": "FeatureCollection", "features": []}')
    scene_file, way = tmp_path / "scene.json", tmp_path / "way.json"
    for arguments, code, said in (
        ((scene_file, way), 0, "A path of 7 motions leads from"),
        ((tmp_path / "elsewhere.json", way), 1, "REFUTED: it is an answer for another scene"),
        ((scene_file, tmp_path / "other.json"), 2, "cannot be read: "),
        ((tmp_path / "map.json", way), 2, "cannot be read: GeoJSON is not read here"),
        ((scene_file, tmp_path / "none.json"), 2, "No such file"),
        ((scene_file,), 2, "give two files"),
    ):
        found = run(*arguments)
        assert found[0] == code and said in found[1] and found[1].count("\n") == 1, (arguments, found)


def test_right_answers_are_verified_by_both() -> None:
    for scene, answer in (corridor(), tee(), *separations()):
        assert verified_in_a_file(scene, answer).verified


@pytest.mark.parametrize("name", ["comb_hook", "degenerate_exact_fit", "degenerate_workspace", "sofa_corner"])
def test_answers_in_the_examples_are_verified_by_both(name: str) -> None:
    scene = load_scene(ROOT / f"examples/scenes/{name}.json")
    rng, turns = random.Random(name), ("0deg", "90deg")
    poses = [[Pose(rng.randint(-4, 9), rng.randint(-4, 9), turn) for turn in turns] for _ in range(3)]
    poses = [[scene.start, scene.goal]] if scene.start and scene.goal else poses
    asked = Scene(scene.robot, scene.obstacles, bounds=scene.bounds, workspace=scene.workspace)
    for start, goal in poses:
        try:
            found = plan(asked, start, goal, improve=0)
        except ValueError:  # a forbidden pose
            continue
        assert verified_in_a_file(asked, found).verified


def test_wrong_paths_are_refuted_by_both(tmp_path: FilePath) -> None:
    """Of exact fits, paths that are off by 1e-30; of turns, those whose corners stick out in between."""
    slot = Scene(SQUARE, [box(-9, "1/2", 9, 1)[0], box(-9, -1, 9, "-1/2")[0]])
    room = Scene(box(-4, -3, 4, 3)[0], workspace=box(-5, -5, 5, 5)[0])  # its corners are 5 from the pole
    disc = Scene([(0, 0), (3, 0), (3, 1), (0, 1)], [[(1, 3), (9, 3), (9, 9), (1, 9)]])  # corners pass at sqrt 10
    bounded = Scene(SQUARE, bounds=(0, 0, 4, 4), workspace=box(-9, -9, 9, 9)[0])
    half, turn = {"tau": "inf"}, {"tau": "3/4"}
    for scene, start, motions, free in (
        (slot, Pose(-12, 0), [Translation((24, 0))], True),
        (slot, Pose(-12, 0), [Translation((24, "1e-30"))], False),
        (slot, Pose(-12, "1e-30"), [Translation((24, 0))], False),
        (room, Pose(0, 0), [Rotation((0, 0), half), Rotation((0, 0), half)], True),
        (room, Pose(0, 0), [Rotation((0, "1e-30"), half)], False),
        (disc, Pose(0, 0), [Rotation((0, 0), turn)], True),
        (disc, Pose(0, "1e-30"), [Rotation((0, "1e-30"), turn)], False),
        (bounded, Pose(0, 0), [Translation((4, 0)), Rotation((4, 2), "-180deg"), Translation((-4, 0))], True),
        (bounded, Pose(0, 0), [Rotation((2, 0), "180deg")], False),
        (Scene(SQUARE, workspace=box(0, 0, 9, 9)[0]), Pose(30, 3), [Translation((1, 0))], False),
    ):
        assert verified_in_a_file(scene, Path(start, motions)).verified == free


def rings() -> st.SearchStrategy[list[tuple[Any, Any]]]:
    points = st.tuples(st.integers(0, 4), st.integers(0, 4))
    return st.lists(points, min_size=3, max_size=7)


@pytest.mark.slow
@settings(max_examples=300, deadline=None)
@given(rings(), st.lists(rings(), max_size=2))
def test_polygons_are_read_alike(outer: list[tuple[Any, Any]], holes: list[list[tuple[Any, Any]]]) -> None:
    """The same are refused; rings of the others are the same, and pieces cover them."""
    data = {"outer": [list(p) for p in outer], "holes": [[list(p) for p in hole] for hole in holes]}
    try:
        polygon = Polygon(outer, holes)
    except InvalidPolygonError:
        with pytest.raises(check_answer.BadFileError):
            check_answer.read_polygon(data, "polygon")
        return
    mine = check_answer.read_polygon(data, "polygon")
    points = [point for ring in mine.rings for point in ring]
    assert tuple(points) == polygon.exact_vertices
    pieces = check_answer.convex_pieces(mine.integers(mine.unit))
    doubled = sum(p[0] * q[1] - p[1] * q[0] for piece in pieces for p, q in check_answer.edges_of(piece.points))
    assert Fraction(doubled) / 2 == polygon.exact_area * mine.unit**2


@settings(max_examples=200, deadline=None)
@given(
    st.one_of(
        st.floats(-20, 20),
        st.integers(-1000, 1000).map(lambda n: f"{n}deg"),
        st.floats(-400, 400).map("{!r}deg".format),
        st.floats(-400, 400).map("{!r}°".format),
        st.floats(-20, 20).map("{!r} rad".format),
        st.floats(-6, 6).map(repr),
    )
)
def test_angles_are_read_alike(theta: Any) -> None:
    value = Decimal(repr(theta)) if isinstance(theta, float) else theta
    assert check_answer.read_angle(value, "theta") == Pose(0, 0, value).tau


def test_rings_alone_are_read_alike() -> None:
    ring, other = [[0, 0], [4, 0], [0, 3]], [[5, 5], [6, 5], [5, 6]]
    for robot, obstacles, workspace in (
        (ring, [other], None), ([ring, {"outer": other}], other, None), (ring, [], ring), (ring, [other, ring], ring)
    ):  # fmt: skip
        text = json.dumps({"robot": robot, "obstacles": obstacles, "workspace": workspace})
        found, scene = check_answer.read_scene(check_answer.decoded(text)), scene_from_text("scene.json", text)
        assert found.sha256 == stamp_of(scene).sha256


@settings(max_examples=200, deadline=None)
@given(st.lists(st.tuples(st.integers(-6, 6), st.integers(1, 4)), max_size=4), st.integers(1, 3), st.booleans())
def test_roots_are_found_each_once(linear: list[tuple[int, int]], times: int, with_surd: bool) -> None:
    poly: Any = (1,)
    for p, q in linear * times:
        poly = check_answer.times(poly, (-p, q))
    expected = {Fraction(p, q) for p, q in linear if abs(p) <= 2 * q}
    if with_surd:
        poly = check_answer.times(poly, (-2, 0, 1))  # the square roots of 2
    found = check_answer.roots_in(poly, Fraction(-2), Fraction(2))
    assert len(found) == len(expected) + 2 * with_surd
    for root in found:
        assert root.sign(poly) == 0
        order = sum(root.sign((-p, q)) == 0 for p, q in linear) * times or 1
        assert root.is_change(poly) == (order % 2 == 1)
    assert all(root.compared(other) < 0 for root, other in pairwise(found))
