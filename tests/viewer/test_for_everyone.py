"""The page by keys alone, and what axe-core, which looks for what keeps people out, has to say of it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import cfree
from cfree import view
from pages import Tried

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
AXE = ROOT / "viewer" / "node_modules" / "axe-core" / "axe.min.js"
BUTTONS = {"edit": "#edit-shapes", "learn": "#learn"}
REACHED = """() => {
  const of = document.activeElement;
  return of.id || (of.tagName === "CANVAS" ? "canvas" : of.getAttribute("class") ?? of.tagName);
}"""
RING = """() => {
  const of = document.activeElement, shape = of.querySelector(".shape");
  return shape ? getComputedStyle(shape).strokeWidth === "4px" : getComputedStyle(of).outlineStyle !== "none";
}"""


@pytest.fixture(scope="module")
def tried(browser: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Tried]:
    scene = cfree.load_scene(ROOT / "examples" / "scenes" / "paper_fig9.json")
    tried = Tried(browser, view(scene, html=tmp_path_factory.mktemp("page") / "page.html", browser=False))
    tried.ready("paper_fig9")
    tried.say("#way", "A motion exists")
    yield tried
    tried.close()


def press(tried: Tried, where: str, *keys: str) -> None:
    tried.page.locator(where).focus()
    for key in keys:
        tried.page.keyboard.press(key)


def place(tried: Tried, who: str) -> str:
    return str(tried.page.locator(f".body.{who}").get_attribute("transform"))


def moved(tried: Tried, who: str, before: str) -> None:
    tried.page.locator(f".body.{who}:not([transform='{before}'])").wait_for(timeout=10_000)


def test_everything_is_reached_by_tab_and_seen_to_be(tried: Tried) -> None:
    tried.page.keyboard.press("Control+y")  # nothing is undone: its button does not take part
    tried.page.evaluate("document.activeElement.blur()")
    reached, unseen = list[str](), list[str]()
    for _ in range(40):
        tried.page.keyboard.press("Tab")
        name = tried.page.evaluate(REACHED)
        if name == "BODY" or name in reached:
            break
        reached.append(name)
        if not tried.page.evaluate(RING):
            unseen.append(name)
    handles = ["body start", "body goal", "body robot", "canvas"]
    buttons = ["scenes", "open", "save", "share", "help", "edit-shapes"]
    for name in [*buttons, *handles, "theta", "play", "colour", "solid", "cut", "sweep"]:
        assert name in reached
    assert "svg" not in reached and unseen == []


def test_robot_start_and_goal_are_moved_and_turned(tried: Tried) -> None:
    for who in ("robot", "start", "goal"):
        for key in ("ArrowUp", "]", "Shift+ArrowLeft", "Alt+ArrowRight"):
            before = place(tried, who)
            press(tried, f".body.{who}", key)
            moved(tried, who, before)
    before = place(tried, "goal")
    tried.page.keyboard.press("Control+z")
    moved(tried, "goal", before)
    undone = place(tried, "goal")
    tried.page.keyboard.press("Control+y")
    moved(tried, "goal", undone)
    assert place(tried, "goal") == before


def test_views_are_turned_cut_and_coloured(tried: Tried) -> None:
    for key in ("ArrowLeft", "ArrowDown", "+", "-", "f"):
        frames = tried.page.locator("#space").get_attribute("data-frames")
        press(tried, "#space canvas", key)
        tried.page.locator(f"#space:not([data-frames='{frames}'])").wait_for()
    press(tried, "#space canvas", "x")
    assert tried.page.locator("#cut").is_checked()
    tried.page.keyboard.press("x")
    press(tried, "#space canvas", "2")
    assert tried.page.locator("#colour").input_value() != "contact"
    tried.page.keyboard.press("1")
    assert tried.page.locator("#colour").input_value() == "contact"
    degrees = tried.page.locator("#degrees").inner_text()
    tried.page.keyboard.press(".")
    tried.page.locator("#degrees").filter(has_not_text=degrees).wait_for()
    press(tried, "#colour", "x")  # letters belong to what has the focus
    assert not tried.page.locator("#cut").is_checked()


def test_path_is_played_and_stopped(tried: Tried) -> None:
    tried.say("#way", "A motion exists")
    before = place(tried, "robot")
    press(tried, "#space canvas", "Space")
    moved(tried, "robot", before)
    tried.page.keyboard.press("Escape")
    tried.say("#play", "Play")


def test_path_is_played_from_a_frame_begun_before_the_click(tried: Tried) -> None:
    place = tried.page.evaluate("""() => new Promise((seen) => {
      const asked = window.requestAnimationFrame;
      window.requestAnimationFrame = (step) => asked(() => {
        window.requestAnimationFrame = asked;
        step(performance.now() - 1000);
        seen(document.querySelector(".body.robot").getAttribute("transform"));
      });
      document.querySelector("#play").click();
    })""")
    tried.page.keyboard.press("Escape")
    tried.say("#play", "Play")
    assert place.startswith("translate(")
    assert "NaN" not in place


def test_patches_and_cells_are_told_of(tried: Tried) -> None:
    press(tried, "#space canvas", "f", "p")
    tried.say("#picked", "of obstacle 0")
    tried.say("#pose", "Touching: ")
    press(tried, "#space canvas", "Control+z", "c")
    tried.page.locator("#picked").filter(has_not_text="of obstacle 0").filter(has_text="ell 0").wait_for()


def test_shapes_are_changed_and_drawn(tried: Tried) -> None:
    outline = tried.page.locator(".obstacle").first
    before = str(outline.get_attribute("d"))
    press(tried, "#space canvas", "e")
    tried.built(lambda: press(tried, ".obstacle", "ArrowRight"))
    assert outline.get_attribute("d") != before
    tried.page.keyboard.press("Control+z")
    tried.page.locator(f".obstacle[d='{before}']").wait_for(timeout=10_000)
    tried.built(lambda: press(tried, "#space canvas", "n", "Enter"))
    tried.page.locator(".obstacle").nth(1).wait_for(timeout=10_000)
    press(tried, "#space canvas", "Control+z")
    tried.page.locator(".obstacle").nth(1).wait_for(state="detached", timeout=10_000)
    tried.say("#way:not(.old)", "A motion exists")  # Escape would stop whoever looks for it
    press(tried, "#space canvas", "Escape", "e")
    assert tried.page.locator(".obstacle").count() == 1


def test_lessons_are_walked_through(tried: Tried) -> None:
    press(tried, "#learn", "Enter")
    for step in range(1, 9):
        tried.say("#lesson-step", f"{step} of 8")
        assert len(tried.page.locator("#lessons article:visible").inner_text()) > 100
        press(tried, "#lesson-next", "Enter")
    tried.page.locator("#lessons").wait_for(state="hidden")
    assert tried.page.evaluate(REACHED) == "learn"
    tried.page.select_option("#scenes", "paper_fig9")
    tried.ready("paper_fig9")
    tried.say("#way", "A motion exists")


def test_keys_are_listed_and_the_list_is_left(tried: Tried) -> None:
    press(tried, "#space canvas", "?")
    tried.page.locator("#keys[open]").wait_for()
    tried.page.keyboard.press("Escape")
    tried.page.locator("#keys:not([open])").wait_for(state="attached")
    assert tried.page.evaluate(REACHED) == "canvas"


def test_another_scene_is_chosen(tried: Tried) -> None:
    press(tried, "#scenes", "ArrowDown")
    tried.ready("sofa_corner")
    press(tried, ".body.robot", "Control+z")
    tried.ready("paper_fig9")


def test_scenes_chosen_and_undone_in_haste(tried: Tried) -> None:
    for name in ("sofa_corner", "peg_in_hole"):
        tried.page.select_option("#scenes", name)
        assert tried.page.evaluate("document.body.dataset.ready") != "paper_fig9"
    tried.ready("peg_in_hole")
    for name in ("caged_part", "paper_fig9"):
        tried.page.select_option("#scenes", name)
        tried.ready(name)
    press(tried, ".body.robot", "Control+z", "Control+z")
    tried.ready("peg_in_hole")
    tried.page.select_option("#scenes", "paper_fig9")
    tried.ready("paper_fig9")


@pytest.mark.skipif(
    not AXE.exists(), reason="axe-core is not installed (`npm ci` in viewer/): faults were not looked for"
)
@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("part", ["page", "keys", "edit", "phone", "learn"])
def test_axe_finds_no_serious_fault(tried: Tried, theme: Any, part: str) -> None:
    page = tried.page
    page.emulate_media(color_scheme=theme)
    if part == "phone":
        page.set_viewport_size({"width": 390, "height": 844})
    if part == "keys":
        press(tried, "#space canvas", "?")
    if part in BUTTONS:
        press(tried, BUTTONS[part], "Enter")
    page.evaluate(f"{AXE.read_text()}; 0")
    found = page.evaluate("axe.run({ resultTypes: ['violations', 'incomplete'] })")
    if part in BUTTONS:
        press(tried, BUTTONS[part], "Enter")
    page.keyboard.press("Escape")
    page.set_viewport_size({"width": 1280, "height": 800})
    faults = [
        f"{fault['id']}: {fault['help']}: {node['html'][:120]} {node.get('failureSummary', '')}"
        for fault in found["violations"]
        if fault["impact"] in ("serious", "critical")
        for node in fault["nodes"]
    ]
    assert not faults, "\n".join(faults)
