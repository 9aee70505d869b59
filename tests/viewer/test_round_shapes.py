"""Round shapes in the page, in a real browser: drawn round, touched exactly, moved as a whole, saved as they are.

Rounded shapes have their own boundary: true arcs in slices, patches of arcs in their colour, contacts by name, cells.
"""

from __future__ import annotations

import json
import re
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import cfree
from cfree import Pose, verify
from cfree.curves import Arc
from cfree.scene.rounded import rounded_shapes
from pages import Tried

pytestmark = pytest.mark.slow

DISC = cfree.Curved.circle((0, 0), "1/2")
FLOOR = [(-6, -2), (6, -2), (6, "-1/2"), (-6, "-1/2")]
HILL = cfree.Curved([(-1, -2), (1, -2), Arc((-1, -2), through=(0, "1/3"))], [])
MOUND = cfree.Curved([(-1, -2), (1, -2), Arc((-1, -2), through=("1/2", "3/10"))], [])  # of an irrational radius


@pytest.fixture
def floor(tried: Tried) -> Tried:
    obstacles = [FLOOR, cfree.Curved.circle((0, "5/2"), 1), MOUND]
    tried.show(cfree.Scene(DISC, obstacles, start=(-5, 0, 0), goal=(5, 0, 0), name="floor"))
    return tried


def saved_and_verified(tried: Tried, folder: Path) -> cfree.Path | cfree.Separated:
    """The saved answer, which is one of the saved scene."""
    scene = cfree.load_scene(tried.saved("scene", folder / "scene.json"))
    answer = cfree.load(tried.saved("answer", folder / "answer.json"))
    assert scene.curved and verify.answer(scene, answer).verified
    return answer


def test_round_shapes_are_drawn_round_and_their_path_is_saved_and_verified(floor: Tried, tmp_path: Path) -> None:
    assert [" ".join(d).count("A") for d in zip(floor.outlines(), strict=True)] == [0, 4, 3]
    assert "A0.5 0.5" in str(floor.page.locator(".body.robot .shape").get_attribute("d"))
    floor.say("#facts", "obstacle 2: drawn as a polygon around the arcs, within 0.0")
    floor.say("#way", "A motion exists")
    floor.say("#pose", "Touching obstacle 0. Allowed.")
    path = saved_and_verified(floor, tmp_path)
    assert isinstance(path, cfree.Path) and (path.start, path.goal) == (Pose(-5, 0), Pose(5, 0))
    assert "polygons" not in json.loads((tmp_path / "answer.json").read_text())


def test_a_disc_dragged_gently_onto_an_arc_touches_it(tried: Tried) -> None:
    scene = cfree.Scene(DISC, [HILL], start=(0, 2, 0), name="hill")
    tried.show(scene)
    tried.say("#pose", "Free, in cell 0; ")
    pixels = tried.page.evaluate("document.querySelector('#workspace svg > g').transform.baseVal[0].matrix.a")
    tried.drag("robot", 0, pixels * (2 - 5 / 6) + 4)  # the arc is at 1/3, the radius 1/2
    told = tried.page.locator("#pose")
    told.filter(has_text=re.compile(r"^Touching(:.*)? \S*obstacle 0\. Allowed\.$")).wait_for(timeout=30_000)
    tried.drag("robot", 0, 60)
    tried.say("#pose", "Forbidden: the robot overlaps obstacle 0.")


def test_a_round_obstacle_moves_as_a_whole_and_stays_exact(floor: Tried, tmp_path: Path) -> None:
    page = floor.page
    page.locator("#edit-shapes").click()
    before = floor.outlines()
    floor.built(lambda: floor.pull(page.locator(".obstacle").nth(1), 20, 30))
    assert page.locator(".vertex").count() == 0 and floor.outlines()[0] == before[0]
    moved = cfree.load_scene(floor.saved("scene", tmp_path / "moved.json")).obstacles[1]
    assert isinstance(moved, cfree.Curved) and moved.size == 2 and moved != cfree.Curved.circle((0, "5/2"), 1)
    floor.built(lambda: page.locator("#undo").click())
    assert floor.outlines() == before


def test_other_curves_are_refused_with_the_remedy(tried: Tried) -> None:
    ellipse = {"ellipse": {"center": [0, 0], "radii": [1, 2]}}
    tried.give(json.dumps({"robot": {"circle": {"center": [0, 0], "radius": 1}}, "obstacles": [ellipse]}))
    tried.say("#edit", "obstacles[0].ellipse: the page takes lines and circular arcs; `cfree convert` with --outer")


TRIANGLE = cfree.Curved([("-0.6", "-0.4"), ("0.8", "-0.4"), (0, "0.8")], grown="1/5")
PILLARS = [((0, 2), "0.5"), (("2.2", "0.3"), "0.7"), ((-2, 0), "0.4"), (("0.4", "-2.2"), "0.6")]
DISCS = [cfree.Curved.circle(at, radius) for at, radius in PILLARS]
KITE = [(-2, -1), (0, "-1.6"), ("1.2", 0), ("-0.4", 1)]
STADIUM = cfree.Curved(
    [(-1, "-0.25"), (1, "-0.25"), Arc((1, "0.25"), center=(1, 0)), (-1, "0.25"), Arc((-1, "-0.25"), center=(-1, 0))]
)
SLOT = [[(1, "0.3"), (6, "0.3"), (6, "2.5"), (1, "2.5")], [(1, "-2.5"), (6, "-2.5"), (6, "-0.3"), (1, "-0.3")]]
PARKED = [[(1, "0.9"), ("4.2", "0.9"), ("4.2", 2), (1, 2)], [("9.8", "0.9"), ("11.2", "0.9"), ("11.2", 2), ("9.8", 2)]]
CAR = [("-0.75", "-0.65"), ("3.05", "-0.65"), ("3.05", "0.65"), ("-0.75", "0.65")]
ROUNDED = {
    "disc": cfree.Scene(
        DISC, [KITE, cfree.Curved.circle(("2.2", 2), "0.4")], start=(-3, "0.5", 0), goal=("1.6", -2, 0), name="disc"
    ),
    "stadium": cfree.Scene(STADIUM, SLOT, start=("-1.5", -2, 1), goal=(4, 0, 0), name="stadium"),
    "car park": cfree.Scene(
        cfree.Curved(CAR, grown="0.25"),
        [*(cfree.Curved(ring, grown="0.3") for ring in PARKED), cfree.Curved.circle(("6.5", "5.2"), "0.4")],
        workspace=[(0, 0), (12, 0), (12, 8), (0, 8)],
        start=(2, "6.8", 0),
        goal=("5.8", "1.4", 0),
        name="car park",
    ),
    "triangle": cfree.Scene(TRIANGLE, DISCS, start=(0, 0, 0), goal=(4, 3, "90deg"), name="triangle"),
}
LENS = cfree.Curved([("-0.8", 0), Arc(("0.8", 0), center=(0, "0.6")), Arc(("-0.8", 0), center=(0, "-0.6"))])
DOME = cfree.Curved([(2, -1), (4, -1), (4, 0), Arc((2, 0), center=(3, 0))])
HALF = cfree.Curved([(1, 0), Arc((-1, 0), center=(0, 0))])
ROUNDED |= {
    "lens": cfree.Scene(
        LENS,
        [DOME, cfree.Curved.circle((-2, 2), "0.7"), cfree.Curved(KITE, grown="0.2")],
        start=(-4, 1, 0),
        goal=(4, 2, "90deg"),
        name="lens",
    ),
    "several radii": cfree.Scene(
        [HALF, cfree.Curved.circle((0, "-0.2"), "0.2")],
        [DOME, cfree.Curved.circle((-2, 2), "0.7"), KITE],
        bounds=(-6, -4, 6, 5),
        start=(-4, 1, 0),
        goal=(4, 3, "90deg"),
        name="several radii",
    ),
}
LEGEND = {
    "lens": ["arc or vertex on edge", "arc or vertex on arc or vertex", "smooth joint", "edge on edge"],
    "several radii": [
        "arc or vertex on edge",
        "edge on arc or vertex",
        "arc or vertex on arc or vertex",
        "helix, smooth joint",
        "edge on edge",
    ],
    "disc": ["arc on edge", "arc on arc or vertex", "smooth joint"],
    "stadium": ["arc on edge", "edge on vertex", "arc on vertex", "smooth joint", "edge on edge"],
    "car park": ["arc on edge", "edge on arc", "arc on arc", "smooth joint", "edge on edge"],
    "triangle": ["edge on arc", "arc on arc", "smooth joint"],
}


@pytest.fixture
def opened(tried: Tried, request: pytest.FixtureRequest) -> Tried:
    tried.show(ROUNDED[request.param])
    return tried


def colours(tried: Tried) -> set[tuple[int, int, int]]:
    """Colours of the right view, without many that are rare."""
    pixels = np.asarray(Image.open(BytesIO(tried.page.locator("#space canvas").screenshot())).convert("RGB"))
    found, counts = np.unique(pixels.reshape(-1, 3), axis=0, return_counts=True)
    return {tuple(map(int, colour)) for colour in found[counts > 5]}


@pytest.mark.long
@pytest.mark.parametrize("opened", ROUNDED, indirect=True)
def test_rounded_shapes_have_their_own_boundary_slices_and_legend(
    opened: Tried, request: pytest.FixtureRequest
) -> None:
    name = request.node.callspec.params["opened"]
    page, scene = opened.page, ROUNDED[name]
    assert page.locator("#legend span").all_inner_texts() == LEGEND[name]
    cells = len(cfree.free_space(cfree.boundary(scene)))
    opened.say("#facts", f"{cells} cell{'s' if cells > 1 else ''} · ")
    assert "polygon" not in page.locator("#facts").inner_text()
    opened.say("#pose", "Free, in cell")
    opened.say("#way", "A motion exists")
    forbidden, arcs = opened.slice(), str(page.locator(".slice .arc-arc").get_attribute("d"))
    assert forbidden.count("A") == arcs.count("A") > 0 and len(forbidden) < 20_000
    radii = {float(r) for r in re.findall(r"A(\S+) ", forbidden)}
    cores = rounded_shapes(scene)
    assert cores is not None
    robot, others = (
        {radius + arc for core in shapes for radius in [core.radius] for arc in [0, *(arc.radius for arc in core.arcs)]}
        for shapes in (cores.robot, cores.obstacles)
    )
    assert {round(r, 9) for r in radii} <= {round(float(r + s), 9) for r in robot for s in [*others, 0]}
    before = colours(opened)
    assert any(r > g + 40 and b > g + 20 for r, g, b in before)  # arcs on arcs, in their own colour
    for by, legend in [
        ("gaussian", "-1 or less (dark), 0, 1 or more"),
        ("mean", "bulging (dark)"),
        ("cell", "each cell"),
    ]:
        page.select_option("#colour", by)
        assert legend in page.locator("#scale").inner_text()
        page.wait_for_timeout(500)
        assert colours(opened) != before


@pytest.mark.parametrize("opened", ["triangle"], indirect=True)
def test_picked_patches_of_arcs_are_named_and_their_pose_is_exactly_in_contact(opened: Tried) -> None:
    page = opened.page
    view_box = page.locator("#space canvas").bounding_box()
    for share in np.linspace(0.3, 0.7, 15):
        page.mouse.click(view_box["x"] + share * view_box["width"], view_box["y"] + 0.6 * view_box["height"])
        page.wait_for_timeout(300)
        told = page.locator("#picked").inner_text()
        if told.startswith("robot arc"):
            break
    assert re.match(r"robot arc \d on arc 0 of obstacle \d\nS\(ψ, φ\) at ψ = .*\nK = .*", told), told
    opened.say("#pose", f"Touching: {told.splitlines()[0]}")
    assert page.locator(".marks .arc").count() == 2


@pytest.mark.parametrize("opened", ["triangle"], indirect=True)
def test_cells_follow_drags_of_round_robots_and_obstacles(opened: Tried, tmp_path: Path) -> None:
    page = opened.page
    pixels = page.evaluate("document.querySelector('#workspace svg > g').transform.baseVal[0].matrix.a")
    opened.drag("robot", 0, -pixels / 2 - 4)  # the gap above is 1/2
    opened.say("#pose", "Touching: robot arc 2 on arc 0 of obstacle 0. Allowed.")
    page.locator("#edit-shapes").click()
    before = opened.slice()
    opened.built(lambda: opened.pull(page.locator(".obstacle").nth(1), -30, 25))
    opened.say("#facts", "1 cell · ")
    assert opened.slice() != before
    moved = cfree.load_scene(opened.saved("scene", tmp_path / "moved.json"))
    assert len(cfree.free_space(cfree.boundary(moved))) == 1
    assert isinstance(saved_and_verified(opened, tmp_path), cfree.Path)


def test_a_round_robot_in_a_ring_of_discs_is_proved_to_stay_there(tried: Tried, tmp_path: Path) -> None:
    near = [(2, 0), (-2, 0), (0, 2), (0, -2), *((x, y) for x in ("1.5", "-1.5") for y in ("1.5", "-1.5"))]
    ring = [cfree.Curved.circle(at, "0.6") for at in near]
    scene = cfree.Scene(TRIANGLE, ring, start=(0, 0, 0), goal=(5, 0, 0), name="ring")
    tried.show(scene)
    tried.say("#facts", "2 cells")
    tried.say("#way", "No motion, not even touching: separated by obstacles 0, 1, 2, 3 and 4 more.")
    proof = saved_and_verified(tried, tmp_path)
    assert isinstance(proof, cfree.Separated) and proof.rounded is not None
