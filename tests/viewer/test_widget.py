"""The page in a notebook's cell: its Python side alone, and both sides joined by a model as a notebook has it."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import cfree
from cfree import Pose

ROBOT, WALL = [(0, 0), (2, 0), (0, 1)], [(4, 0), (5, 0), (5, 7), (4, 7)]
ROOM = [(0, 0), (9, 0), (9, 9), (0, 9)]


def scene_of(wall: Any = WALL) -> cfree.Scene:
    return cfree.Scene(ROBOT, [wall], workspace=ROOM, start=(1, 1, 0), goal=(6, 1, 0), name="room")


@pytest.fixture(scope="module", autouse=True)
def anywidget() -> Any:
    return pytest.importorskip("anywidget", reason="anywidget is not installed: the widget was not tried")


def words(x: str, y: str, tau: str) -> dict[str, str]:
    return {"x": x, "y": y, "tau": tau}


def test_without_anywidget_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "anywidget", None)
    monkeypatch.delitem(sys.modules, "cfree.viewer.widget", raising=False)
    with pytest.raises(ImportError, match=r"pip install 'cfree\[notebook\]'"):
        cfree.widget(scene_of())


def test_what_is_shown_is_read_back() -> None:
    scene = scene_of()
    for value in (scene, cfree.boundary(scene), cfree.free_space(cfree.boundary(scene)), cfree.plan(scene)):
        widget = cfree.widget(value)
        assert (widget.scene, widget.start, widget.goal) == (scene, scene.start, scene.goal)
    path = cfree.plan(scene)
    assert isinstance(path, cfree.Path) and cfree.widget(path).answer is path
    assert len(cfree.widget(scene, path).poses.splitlines()) == len(path.poses)


@pytest.mark.slow
def test_values_display_themselves_as_the_page_and_as_a_picture() -> None:
    scene = scene_of()
    live, picture = "application/vnd.jupyter.widget-view+json", "image/svg+xml"
    formatter = pytest.importorskip("IPython.core.formatters").DisplayFormatter()
    for value in (scene, cfree.boundary(scene), cfree.free_space(cfree.boundary(scene)), cfree.plan(scene)):
        assert {live, picture} <= set(formatter.format(value)[0])
    many = cfree.Scene(ROBOT, [[(x, y), (x + 1, y), (x, y + 1)] for x in range(0, 290, 5) for y in range(0, 290, 5)])
    unknown = cfree.Path(scene.start, cfree.plan(scene).motions)
    for value in (scene.robot[0], many, unknown):
        shown = set(formatter.format(value)[0])
        assert picture in shown and live not in shown


def test_what_is_dragged_is_read_back_exactly() -> None:
    widget = cfree.widget(scene_of())
    seen: list[Any] = []
    widget.observe(lambda change: seen.append(change.new), "goal")
    widget.set_state({"goal": words("13/2", "0.1", "inf"), "start": words("1", "1", "1/7"), "poses": ""})
    assert seen == [widget.goal] == [Pose("13/2", "0.1", "180deg")] and widget.start == Pose(1, 1, {"tau": "1/7"})
    assert (widget.scene.start, widget.scene.goal) == (widget.start, widget.goal)
    with pytest.raises(cfree.ForbiddenPoseError, match="goal"):
        widget.answer  # noqa: B018


def test_path_of_the_page_is_believed_only_if_it_is_free() -> None:
    widget = cfree.widget(scene_of())
    around, through = "1 1 0\n1 7.5 0\n6 7.5 0\n6 1 0", "1 1 0\n6 1 0"
    widget.set_state({"poses": around})
    assert [motion.length(pose) for pose, motion in zip(widget.answer.poses, widget.answer.motions, strict=False)] == [
        6.5,
        5,
        6.5,
    ]
    widget.set_state({"poses": through, "goal": words("6", "1", "0"), "start": words("1", "1.5", "0")})
    assert widget.answer.start == widget.start  # of another question
    widget.set_state({"start": words("1", "1", "0")})
    assert len(widget.answer.motions) > 1 and widget.answer.is_free(cfree.MotionChecker(widget.scene))


def test_round_shapes_are_shown_exactly_and_their_path_is_believed_only_if_it_is_free() -> None:
    disc, floor = cfree.Curved.circle((0, 0), 1), [(-9, -2), (9, -2), (9, -1), (-9, -1)]
    scene = cfree.Scene(disc, [floor, cfree.Curved.circle((0, 3), 2)], start=(-5, 0, 0), goal=(5, 0, 0))
    widget = cfree.widget(scene)
    assert widget.scene == scene
    widget.set_state({"poses": "-5 0 0\n5 0 0"})
    assert len(widget.answer.motions) == 1 and widget.answer.curved == scene and widget.answer.scene is None
    widget.set_state({"goal": words("5", "1", "0"), "poses": "-5 0 0\n5 1 0"})
    assert widget.answer.goal == Pose(5, 1) and len(widget.answer.motions) > 1  # the page's path is not free
    with pytest.raises(cfree.UnsupportedError, match="the page takes lines and circular arcs"):
        cfree.widget(cfree.Scene(cfree.Curved.ellipse((0, 0), (1, 2)), []))


def test_vehicle_of_the_page_drives_in_python() -> None:
    car = cfree.Car(1, axle=("1/2", 0))
    widget = cfree.widget(
        cfree.Scene(ROBOT, [WALL], workspace=ROOM, start=("1.5", "1.5", 0), goal=("6.5", 2, 0), vehicle=car)
    )
    assert widget.vehicle == widget.scene.vehicle == widget.answer.vehicle == car
    record = {"type": "car", "turning_radius": ["2", "5/2"], "axle": ["0", "0.1"], "heading": {"tau": "1"}}
    widget.set_state({"vehicle": record})
    assert widget.vehicle == cfree.Car((2, "5/2"), axle=(0, "0.1"), heading="90deg") == widget.answer.vehicle
    widget.set_state({"poses": "3/2 3/2 0\n3/2 15/2 0\n13/2 15/2 0\n13/2 2 0"})
    assert widget.answer.is_free(cfree.MotionChecker(widget.scene)) and len(widget.answer.motions) != 3  # sideways
    widget.set_state({"vehicle": None})
    assert widget.answer.vehicle is widget.scene.vehicle is None and len(widget.answer.motions) == 3
    widget.vehicle = cfree.DifferentialDrive()
    assert widget.get_state(["vehicle"])["vehicle"] == {"type": "differential", "axle": ["0", "0"]}


def test_another_scene_is_shown() -> None:
    widget, other = cfree.widget(scene_of()), scene_of([(4, 0), (5, 0), (5, 9), (4, 9)])
    widget.scene = other
    assert widget.scene == other and isinstance(widget.answer, cfree.Separated)
    assert isinstance(cfree.widget(widget.answer).answer, cfree.Separated)


def test_answer_without_a_scene_is_refused(tmp_path: Path) -> None:
    cfree.save(cfree.plan(scene_of()), tmp_path / "answer.json")
    answer = cfree.load(tmp_path / "answer.json")
    with pytest.raises(ValueError, match=r"widget\(scene, answer\)"):
        cfree.widget(answer)
    assert cfree.widget(scene_of(), answer).answer is answer


def test_notebook_keeps_a_picture() -> None:
    (data, _) = cfree.widget(scene_of())._repr_mimebundle_()
    assert data["image/svg+xml"].startswith("<svg") and "application/vnd.jupyter.widget-view+json" in data


MODEL = """async ([script, state]) => {
  const calls = {};
  let changed = {};
  window.sent = [];
  window.model = {
    get: (name) => state[name],
    set(name, value) {
      if (JSON.stringify(state[name]) === JSON.stringify(value)) return;
      state[name] = changed[name] = value;
      for (const call of calls[`change:${name}`] ?? []) call();
    },
    save_changes() { sent.push(changed); changed = {}; },
    on: (event, call) => { (calls[event] ??= new Set()).add(call); },
    off: (event, call) => { calls[event].delete(call); },
    count: () => Object.values(calls).reduce((sum, of) => sum + of.size, 0),
  };
  const { default: widget } = await import(URL.createObjectURL(new Blob([script], { type: "text/javascript" })));
  window.end = widget.render({ model, el: document.body });
}"""


class Cell:
    """A widget and its page, and what is said between them."""

    def __init__(self, browser: Any, scene: cfree.Scene) -> None:
        self.widget = cfree.widget(scene)
        self.page = browser.new_page(viewport={"width": 1000, "height": 640})
        self.faults: list[str] = []
        self.page.on("console", lambda message: self.faults.append(message.text) if message.type == "error" else None)
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        state = self.widget.get_state(["page", "source", "robot", "start", "goal", "vehicle", "poses", "height"])
        self.page.evaluate(MODEL, [self.widget._esm, state])
        self.frame = self.page.frame_locator("iframe")

    def ready(self, name: str) -> None:
        self.frame.locator(f"body[data-ready='{name}']").wait_for(timeout=60_000)

    def heard(self, name: str) -> None:
        """What the page has told goes to Python, once it has told of something."""
        self.page.wait_for_function("name => sent.some(of => name in of)", arg=name, timeout=30_000)
        for changed in self.page.evaluate("sent.splice(0)"):
            self.widget.set_state(changed)


@pytest.fixture
def cell(browser: Any) -> Iterator[Cell]:
    made = Cell(browser, scene_of())
    made.ready("room")
    yield made
    made.page.close()
    assert not made.faults, made.faults


@pytest.mark.slow
def test_goal_is_dragged_in_a_cell_and_read_in_python(cell: Cell) -> None:
    cell.frame.locator("#way").filter(has_text="A motion exists").wait_for()
    cell.heard("poses")
    before = cell.widget.goal
    assert cell.widget.answer == cell.widget._shown(cell.widget.scene)
    box = cell.frame.locator(".body.goal .point").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    cell.page.mouse.move(x, y)
    cell.page.mouse.down()
    cell.page.mouse.move(x + 6, y - 30, steps=4)
    cell.page.mouse.up()
    cell.heard("goal")
    assert cell.widget.goal.y > before.y and cell.widget.goal.tau == before.tau
    assert cell.widget.answer.goal == cell.widget.goal


@pytest.mark.slow
def test_wheel_is_left_to_the_notebook_until_the_cell_is_clicked_in(cell: Cell) -> None:
    box = cell.frame.locator("#workspace svg").bounding_box()
    world = cell.frame.locator("#workspace svg > g").first

    def after_wheel() -> str:
        cell.page.mouse.move(box["x"] + 200, box["y"] + 100)
        cell.page.mouse.wheel(0, 40)
        cell.page.wait_for_timeout(300)
        return str(world.get_attribute("transform"))

    before = str(world.get_attribute("transform"))
    assert after_wheel() == before
    cell.frame.locator("#workspace h2").click(position={"x": 2, "y": 2}, force=True)
    assert after_wheel() != before


@pytest.mark.slow
@pytest.mark.long
def test_ways_to_move_are_switched_on_both_sides(cell: Cell) -> None:
    cell.frame.locator("#way").filter(has_text="A motion exists").wait_for()
    cell.frame.locator("#drive label:has([value=differential])").click()
    cell.frame.locator("#way").filter(has_text="A machine that turns in place drives there").wait_for()
    cell.heard("vehicle")
    assert isinstance(cell.widget.vehicle, cfree.DifferentialDrive)
    record = {"type": "car", "turning_radius": "1", "axle": ["1/2", "1/3"]}
    cell.page.evaluate("([name, value]) => model.set(name, value)", ["vehicle", record])
    cell.frame.locator("#way").filter(has_text="A car drives there").wait_for()
    assert cell.frame.locator("#axle-y").input_value() == "1/3"
    cell.page.evaluate("([name, value]) => model.set(name, value)", ["vehicle", None])
    cell.frame.locator("#way").filter(has_text="A motion exists").wait_for()


@pytest.mark.slow
def test_page_follows_python(cell: Cell) -> None:
    show = "([name, value]) => model.set(name, value)"
    cell.frame.locator("#way").filter(has_text="A motion exists").wait_for()
    cell.page.evaluate(show, ["goal", words("7", "5", "1")])
    cell.frame.locator(".body.goal[aria-label*='x 7.000, y 5.000, turned by 90.0']").wait_for()
    closed = scene_of([(4, 0), (5, 0), (5, 9), (4, 9)])
    cell.page.evaluate(show, ["source", cfree.widget(closed).source])
    cell.frame.locator("#way").filter(has_text="No motion, not even touching: separated by").wait_for()
    assert cell.frame.locator("#share").is_hidden()
    cell.page.evaluate("end()")
    assert cell.page.locator("iframe").count() == 0 and cell.page.evaluate("model.count()") == 0
