"""Separations: found where cells differ, verified independently, and in files."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from click.testing import CliRunner

import cfree.verify
from cfree import (
    FormatError,
    FreeSpace,
    InvalidPoseError,
    Pose,
    Scene,
    Separated,
    UnsupportedError,
    boundary,
    free_space,
    largest_disc,
    load_scene,
    save,
    separation,
)
from cfree.cli.app import app
from cfree.formats.answers.answer_file import load_answer
from cfree.planning.separation import Insets
from cfree.polygons.polygon import Polygon
from compared import scene_of
from reference_ears import clip_ears
from reference_features import scene_features
from reference_pieces import outline
from shapes import KINDS, PlainScene, box, random_scene
from spaces import INSIDE, OUTSIDE, ROD, TIGHT, hollow, room, space_of

ROOT = Path(__file__).parents[2]


def proved(space: FreeSpace, start: Pose, goal: Pose) -> Separated:
    proof = separation(space, start, goal)
    assert proof is not None
    result = cfree.verify.answer(space.boundary.scene, proof)
    assert result.verified, result
    return proof


@pytest.mark.parametrize("gap", [Fraction(1, 10**9), Fraction(1, 2), *(1 - Fraction(1, 10**k) for k in (5, 9, 15, 40))])
def test_a_throat_that_is_too_narrow(gap: Fraction | int) -> None:
    assert proved(room(gap), INSIDE, OUTSIDE).of == "closed"


@pytest.mark.slow
@pytest.mark.parametrize("gap, of", [(1, "interior"), *((1 - Fraction(1, 2**k), "closed") for k in (30, 170, 300))])
def test_a_throat_narrower_by_however_little_is_closed(gap: Fraction | int, of: str) -> None:
    assert proved(room(gap), INSIDE, OUTSIDE).of == of


def test_a_throat_that_is_wide_enough() -> None:
    assert separation(room(1 + Fraction(1, 10**30)), INSIDE, OUTSIDE) is None


def test_a_pose_in_the_closure_of_two_cells_is_joined_with_both() -> None:
    # a diagonal of five units stands upright in a corridor of five
    space = free_space(boundary(Scene(box(-2, "-3/2", 2, "3/2")[0], [], workspace=box(0, 0, 30, 5)[0])))
    upright, level, on_end = (Pose(15, "5/2", angle) for angle in ({"tau": "1/2"}, 0, "90deg"))
    cells = space.locate([level, on_end]).tolist()
    assert cells[0] != cells[1]
    assert [space.common_cell(upright, q) for q in (level, on_end)] == cells
    assert separation(space, upright, level) is separation(space, on_end, upright) is None
    assert proved(space, level, on_end).of == "interior"


def test_cages_and_what_forms_them() -> None:
    space = space_of(PlainScene([ROD], [box(20, 20, 30, 30), TIGHT]))
    proof = proved(space, Pose(0, 0), Pose(0, 0, "180deg"))
    assert proof.of == "closed" and proof.obstacles == (1,)
    assert proved(space, Pose(0, 0), Pose(99, 0)).obstacles == (1,)
    assert separation(space, Pose(0, 0), Pose(0, 0, "5deg")) is None


def test_bounds_and_workspace() -> None:
    wall = box(-1, -9, 1, 9)[0]
    start, goal = Pose(-4, 0), Pose(5, 0, {"tau": "1/30"})
    by_bounds = Scene(ROD[0], [wall], bounds=(-6, -6, 6, 6))
    proof = proved(free_space(boundary(by_bounds)), start, goal)
    assert proof.of == "closed" and set(proof.obstacles) == {-1, 0} and proof.bounds is not None
    assert min(abs(b) for b in proof.bounds) > 6
    by_workspace = Scene(ROD[0], [wall], workspace=box(-9, -4, 9, 4)[0])
    assert set(proved(free_space(boundary(by_workspace)), start, goal).obstacles) == {-2, 0}


def test_a_robot_of_parts_with_holes_one_too_thin_for_the_inset() -> None:
    ring, thin = hollow((-2, -2, 2, 2), (-1, -1, 1, 1)), box(3, 0, 4, Fraction(1, 10**8))
    pin = box(Fraction(-1, 4), Fraction(-1, 4), Fraction(1, 4), Fraction(1, 4))
    space = space_of(PlainScene([ring, thin], [pin]))
    proof = proved(space, Pose(0, 0), Pose(20, 0))  # it stands around the pin
    assert proof.of == "closed" and [len(part.ring_offsets) - 2 for part in proof.robot] == [1]


@pytest.mark.slow
def test_critical_orientations_and_level_vertices() -> None:
    """Rays along edges, through vertices, at critical angles and at the ends of charts."""
    space = space_of(PlainScene([box(0, 0, 1, 1)], [hollow((-4, -4, 8, 8), (-3, -3, 7, 7)), box(0, 0, 2, 2)]))
    for degrees in (0, 45, 90, 135, 180, 270, 315):
        for y in (-1, 0, 1, 2, 3):
            proved(space, Pose(4, y + 1, f"{degrees}deg"), Pose(12, y, f"{degrees}deg"))


def walled(kind: str, seed: int) -> FreeSpace:
    """A random scene, and a frame with walls as thick as the robot through the middle of it."""
    plain, rng = random_scene(seed, kind), random.Random(seed)
    xs, ys = zip(*(point for outer, _ in (*plain.obstacles, *plain.robot) for point in outer), strict=True)
    x0, x1, y0, y1 = (Fraction(of(axis)) for axis in (xs, ys) for of in (min, max))
    x, y = (lo + (hi - lo) * Fraction(rng.randrange(2, 7), 9) for lo, hi in ((x0, x1), (y0, y1)))
    thick = max(abs(Fraction(c)) for outer, _ in plain.robot for point in outer for c in point)
    w, h = ((hi - lo) * Fraction(rng.randrange(1, 7), 9) + thick for lo, hi in ((x0, x1), (y0, y1)))
    frame = hollow((x - w - thick, y - h - thick, x + w + thick, y + h + thick), (x - w, y - h, x + w, y + h))
    return space_of(plain._replace(obstacles=[*plain.obstacles, frame]))


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_cells_that_differ_are_separated(kind: str) -> None:
    rng = random.Random(kind)
    tried = 0
    for seed in range(6):
        space = walled(kind, seed)
        poses = [largest_disc(cell)[0] for cell in space.cells if largest_disc(cell)]
        for _ in range(min(2, len(poses) - 1)):
            tried += proved(space, *rng.sample(poses, 2)).of == "closed"
    assert tried >= 3


def test_one_cell_and_forbidden_poses() -> None:
    space = room("1/9")
    assert separation(space, INSIDE, Pose("1/2", 0, "90deg")) is None
    with pytest.raises(InvalidPoseError, match="goal \\(2, 0, 0 deg\\) is forbidden"):
        separation(space, INSIDE, Pose(2, 0))


def test_the_second_proof_is_quick() -> None:
    space = room("1/9")
    insets = Insets(space.boundary.scene)
    separation(space, INSIDE, OUTSIDE, insets=insets)
    assert insets._handle.known == 1
    separation(space, INSIDE, Pose(-9, 0), insets=insets)
    assert insets._handle.known == 1


@pytest.mark.slow
@pytest.mark.parametrize(("name", "obstacles"), [("nest_swim", (0, 26)), ("street_Berlin", (-1, 0, 1))])
def test_real_scenes_that_are_not_connected(name: str, obstacles: tuple[int, ...], tmp_path: Path) -> None:
    scene = load_scene(ROOT / f"examples/scenes/{name}.json")
    assert scene.start and scene.goal
    proof = proved(free_space(boundary(scene)), scene.start, scene.goal)
    assert proof.of == "closed" and set(obstacles) <= set(proof.obstacles) and len(proof.pieces) < 1000
    save(proof, tmp_path / "proof.json")
    assert cfree.verify.answer(scene, tmp_path / "proof.json").verified


@pytest.mark.slow
def test_ends_that_touch_and_exact_fits() -> None:
    """Of the interior: no path from there keeps a distance."""
    fit = space_of(PlainScene([box(0, 0, 1, 1)], [hollow((-1, -1, 6, 3), (0, 0, 4, 2)), box(1, 0, 4, 1)]))
    assert fit.locate([Pose(0, 0), Pose("1/2", 1)]).tolist() == [-2, -2]  # a corridor as wide as the robot
    proof = proved(fit, Pose("1/2", 1), Pose(0, 0))
    assert proof.of == "interior" and len(proof.pieces) == 0
    assert proved(fit, Pose(3, 1), Pose(20, 0)).of == "closed"  # by the frame
    gate = room(1)
    start = Pose("-3/2", "3/2")  # in a corner
    assert proved(gate, start, OUTSIDE).of == "interior"
    assert separation(gate, start, INSIDE) is None
    assert gate.locate(Pose("5/2", 0)) == -2 and proved(gate, Pose("5/2", 0), OUTSIDE).of == "interior"


def test_files_hold_separations_exactly(tmp_path: Path) -> None:
    space = space_of(PlainScene([ROD], [box(-1, -9, 1, 9)], bounds=(-6, -6, 6, 6)))
    for proof in (proved(space, Pose(-5, 0), Pose(5, "1/3")), proved(room(1), INSIDE, OUTSIDE)):
        save(proof, tmp_path / "proof.json")
        again = load_answer(tmp_path / "proof.json")
        assert again == proof and isinstance(again, Separated) and again.obstacles == proof.obstacles
    with pytest.raises(UnsupportedError, match=r"written as \.json"):
        save(proof, tmp_path / "proof.csv")


def triangles_of(polygon: Polygon) -> list[tuple[int, int, int]]:
    v, rings = polygon.numerators, outline(polygon)
    return clip_ears(v, rings)[::-1]


def test_proofs_hold_however_polygons_are_cut_into_pieces(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Angles may be named by diagonals; another version may draw others, and other programs none."""
    plain = random_scene(36, "axis_parallel")
    space = space_of(plain)
    proof = proved(space, Pose(4, -2), Pose(99, 0))
    assert {item.kind for item in proof.pieces.auxiliary} == {"edge"}
    save(proof, tmp_path / "proof.json")
    again = load_answer(tmp_path / "proof.json")
    assert isinstance(again, Separated) and again == proof
    bare = replace(again, pieces=replace(again.pieces, auxiliary=()))
    assert bare != proof and not cfree.verify.answer(space.boundary.scene, bare).verified
    monkeypatch.setattr(Polygon, "pieces", property(triangles_of))
    monkeypatch.setattr("cfree.verify.world.scene_features", scene_features)
    assert cfree.verify.answer(scene_of(plain), load_answer(tmp_path / "proof.json")).verified


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            '"answer": "separated"',
            '"answer": "no"',
            'answer: expected "path", "separated", "stuck", "unreachable" or "all separated", got "no"',
        ),
        ('"of": "closed"', '"of": "open"', 'of: expected "closed" or "interior", got "open"'),
        ('"of": "closed"', '"of": "interior"', '"rounded" belongs to "of": "closed" only'),
        ('"kind": "vertex-edge"', '"kind": "vertex"', r'surface\[\d+\].contact.kind: expected "vertex-edge"'),
        ('"robot": [0, ', '"robot": [-3, ', r"surface\[0\].contact.robot: expected \[polygon, vertex\], .* got \[-3, "),
        ('"chart": 0', '"chart": 2', r"surface\[\d+\].chart: expected 0 or 1, got 2"),
        ('"lower": [', '"lower": [9, ', r"surface\[0\].lower: expected \[kind, robot feature, obstacle feature\]"),
        ('"lower"', '"lowr"', r'surface\[0\].lowr: unknown key "lowr"; did you mean "lower"\?'),
        ('"tau": [', '"tau": [3, ', r"surface\[0\].from.tau: expected an interval \[lo, hi\]"),
        ('"names": [[', '"names": [[1, 1, 1], [1, 1, 1], [', r"surface\[\d+\].(from|to).names: expected .*at most 2"),
        ('"obstacles": [', '"obstacles": [7, ', '"obstacles" are not those of the surface'),
        ('"goal"', '"gaol"', "gaol: unknown key"),
        ('"outer": [[', '"outer": [["x", ', r"smaller_robot\[0\].outer\[0\]: expected a point"),
    ],
)
def test_faults_of_files_say_place_value_and_remedy(tmp_path: Path, old: str, new: str, message: str) -> None:
    file = tmp_path / "proof.json"
    save(proved(space_of(PlainScene([ROD], [TIGHT])), Pose(0, 0), Pose(9, 9)), file)
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))
    with pytest.raises(FormatError, match=message):
        load_answer(file)


def test_the_command(tmp_path: Path) -> None:
    space = space_of(PlainScene([ROD], [TIGHT]))
    save(space.boundary.scene, tmp_path / "scene.json")
    save(proved(space, Pose(0, 0), Pose(9, 9)), tmp_path / "proof.json")
    texts = {"good": (tmp_path / "proof.json").read_text()}
    texts["wrong"] = texts["good"].replace('"lower": [1', '"lower": [2', 1)
    texts["bad"] = texts["good"][:-20]
    for (name, text), (code, said) in zip(
        texts.items(), [(0, "No path leads from"), (1, "REFUTED"), (2, "error: ")], strict=True
    ):
        (tmp_path / f"{name}.json").write_text(text)
        done = CliRunner().invoke(app, ["verify", str(tmp_path / "scene.json"), str(tmp_path / f"{name}.json")])
        assert done.exit_code == code and said in done.output
