"""The switch between ways to move, the vehicle's handles, and what the page says and draws of its path."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

import cfree
from cfree import view
from cfree.cli.app import app
from pages import PHONE, Fingers, Tried, bare_page

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
PARK = ROOT / "viewer" / "lessons" / "park_car.json"
AXE = ROOT / "viewer" / "node_modules" / "axe-core" / "axe.min.js"
CAR, DRIVE = "A car drives there: ", "A machine that turns in place drives there: "


@pytest.fixture
def park(tried: Tried) -> Tried:
    tried.show(cfree.load_scene(PARK))
    tried.answered()
    return tried


def opened(browser: Any, folder: Path, scene: cfree.Scene | None = None, **device: Any) -> Tried:
    scene = scene or cfree.load_scene(PARK)
    tried = Tried(browser, view(scene, html=folder / "page.html", browser=False), **device)
    tried.ready(scene.name)
    tried.answered()
    return tried


def moves(tried: Tried) -> str:
    return str(tried.page.locator("#drive :checked[name=moves]").input_value())


def number(tried: Tried, which: str) -> str:
    return tried.page.locator(f"#{which}").input_value()


def test_scene_with_a_vehicle_opens_with_it(park: Tried) -> None:
    park.say("#way", CAR)
    assert moves(park) == "car"
    assert [number(park, which) for which in ("axle-x", "axle-y", "radius")] == ["0", "0", "4"]
    assert park.page.locator(".wheels rect").count() == 4 and park.page.locator(".handle:visible").count() == 3


def test_scene_without_a_vehicle_moves_in_any_direction(tried: Tried) -> None:
    tried.page.select_option("#scenes", "paper_fig9")
    tried.ready("paper_fig9")
    tried.say("#way", "A motion exists")
    assert moves(tried) == "any"
    assert tried.page.locator(".wheels rect").count() == tried.page.locator(".handle:visible").count() == 0
    assert not tried.page.locator("#radius").is_visible()


@pytest.mark.long
def test_ways_to_move_are_switched_by_keys_undone_and_kept_in_the_link(park: Tried, browser: Any) -> None:
    park.page.locator("#drive [value=car]").focus()
    park.page.keyboard.press("ArrowLeft")
    park.say("#way", DRIVE)
    assert park.page.locator(".wheels rect").count() == 2 and not park.page.locator("#radius").is_visible()
    park.page.locator("#space canvas").focus()
    park.page.keyboard.press("Control+z")
    park.say("#way", CAR)
    for said in ("A motion exists", DRIVE):
        park.page.keyboard.press("m")
        park.say("#way", said)
    park.page.wait_for_timeout(500)
    link = "#" + park.page.url.partition("#")[2]
    other = Tried(browser, bare_page(Path(park.page.url.partition("#")[0].removeprefix("file://")).parent), link)
    other.ready("park_car")
    other.say("#way", DRIVE)
    assert moves(other) == "differential"
    other.page.locator("#drive label:has([value=car])").click()
    other.say("#way", CAR)
    assert number(other, "radius") == "4"
    other.close()


def test_link_of_another_vehicle_in_another_scene(tried: Tried) -> None:
    tried.page.select_option("#scenes", "benchmr_parking1")
    tried.ready("benchmr_parking1")
    tried.page.locator("#drive label:has([value=car])").click()
    tried.say("#way", CAR)
    tried.page.wait_for_timeout(500)
    assert len(tried.page.url.partition("#")[2]) < 300
    tried.page.locator("#drive label:has([value=any])").click()
    tried.page.select_option("#scenes", "paper_fig9")
    tried.ready("paper_fig9")
    assert moves(tried) == "any"


def test_handles_change_axle_forward_and_radius(park: Tried) -> None:
    park.say("#way", CAR)
    before = str(park.page.locator(".trace .ahead").get_attribute("d"))
    park.pull(park.page.locator(".handle.left"), 0, -40)
    assert 5 < float(number(park, "radius")) < 7 and len(number(park, "radius")) < 6
    park.page.locator(f".trace .ahead:not([d='{before}'])").wait_for(timeout=30_000)
    park.pull(park.page.locator(".handle.axle"), 9, -5)
    assert 0 < float(number(park, "axle-x")) < 1 > float(number(park, "axle-y")) > 0
    park.pull(park.page.locator(".handle.forward"), 0, -25)
    assert park.page.locator("#forward").inner_text() not in ("0°", "90°")
    park.page.locator("#undo").click()
    park.page.locator("#undo").click()
    park.page.locator("#undo").click()
    assert [number(park, which) for which in ("axle-x", "axle-y", "radius")] == ["0", "0", "4"]
    assert park.page.locator("#forward").inner_text() == "0°"


def test_turning_circles_are_drawn_while_the_radius_is_dragged(park: Tried) -> None:
    circles, box = park.page.locator(".turning"), park.page.locator(".handle.left").bounding_box()
    assert not circles.is_visible()
    park.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    park.page.mouse.down()
    park.page.mouse.move(box["x"], box["y"] - 20, steps=3)
    assert circles.is_visible() and park.page.locator(".value").nth(1).text_content() == number(park, "radius")
    park.page.mouse.up()


def test_handles_are_moved_by_keys(park: Tried) -> None:
    for handle, which, key in (
        ("left", "radius", "ArrowUp"),
        ("axle", "axle-x", "ArrowRight"),
        ("axle", "axle-y", "ArrowDown"),
    ):
        before = float(number(park, which))
        park.page.locator(f".handle.{handle}").focus()
        park.page.keyboard.press(key)
        assert (float(number(park, which)) > before) == (key != "ArrowDown")
    park.page.locator(".handle.forward").focus()
    park.page.keyboard.press("ArrowUp")
    assert park.page.locator("#forward").inner_text() == "5.7°"
    assert park.page.locator(".handle.forward").get_attribute("aria-valuetext") == "5.7°"


@pytest.mark.long
def test_drag_of_a_handle_that_the_system_cancels_is_none(browser: Any, tmp_path: Path) -> None:
    phone = opened(browser, tmp_path, **PHONE)
    box = phone.page.locator(".handle.left circle").last.bounding_box()
    middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    Fingers(phone.page).drag(middle, 0, -30, "Cancel")
    phone.page.wait_for_timeout(300)
    assert number(phone, "radius") == "4"
    Fingers(phone.page).drag(middle, 0, -30)
    phone.page.wait_for_timeout(300)
    assert float(number(phone, "radius")) > 4
    assert phone.page.evaluate("document.documentElement.scrollWidth") <= PHONE["viewport"]["width"]
    phone.close()


def test_typed_numbers_stay_exact_and_others_are_refused(park: Tried) -> None:
    def enter(which: str, text: str) -> None:
        park.page.locator(f"#{which}").fill(text)
        park.page.locator(f"#{which}").press("Enter")

    enter("radius", "9/2, 5")
    assert number(park, "radius") == "9/2, 5" and park.page.locator(".handle.right").is_visible()
    for text in ("0", "-1", "much", "1, 2, 3", "1/0", ""):
        enter("radius", text)
        park.say("#edit", "give a length above 0")
        assert park.page.locator("#radius").get_attribute("aria-invalid") == "true"
    enter("axle-x", "1/3")
    assert (number(park, "axle-x"), number(park, "radius")) == ("1/3", "9/2, 5")
    assert park.page.locator("#edit").inner_text() == ""


def test_a_proof_is_one_for_a_car(tried: Tried) -> None:
    tried.page.select_option("#scenes", "caged_part")
    tried.ready("caged_part")
    tried.say("#way", "Nor can a car, whatever its turning radius.")
    tried.page.locator("#drive label:has([value=differential])").click()
    tried.say("#way", "Nor can a machine that turns in place.")
    tried.page.select_option("#scenes", "paper_fig9")
    tried.ready("paper_fig9")


def test_van_before_the_gap_is_a_proof_for_the_car(park: Tried) -> None:
    park.page.locator("#edit-shapes").click()
    van, gap = park.resting(".obstacle >> nth=2", ".body.goal .shape")
    dx = gap["x"] + gap["width"] / 2 - van["x"] - van["width"] / 2
    park.built(lambda: park.pull(park.page.locator(".obstacle").nth(2), dx, gap["y"] - van["y"] - 1.2 * van["height"]))
    park.say("#way", "No motion, not even touching: separated by ")
    park.say("#way", "Nor can a car")


def test_gears_have_colours_and_changes_of_direction_dots(park: Tried) -> None:
    park.say("#way", CAR)
    said = park.page.locator("#way").inner_text()
    changes = int(re.search(r"(\d+) changes? of direction", said)[1])  # type: ignore[index]
    dots = park.page.locator(".trace .cusps").last.get_attribute("d")
    assert changes > 0 and str(dots).count("M") == changes
    strokes = [
        park.page.locator(f".trace .{gear}").evaluate("of => getComputedStyle(of).stroke") for gear in ("ahead", "back")
    ]
    assert strokes[0] != strokes[1]


def test_front_wheels_are_steered_on_the_path(park: Tried) -> None:
    park.say("#way", CAR)
    park.page.locator("#play").click()
    park.page.locator(".front rect[transform^='rotate']:not([transform='rotate(0)'])").first.wait_for(timeout=10_000)
    park.page.keyboard.press("Escape")


@pytest.mark.long
def test_many_manoeuvres_are_counted(browser: Any, tmp_path: Path) -> None:
    scene = cfree.load_scene(ROOT / "viewer" / "gallery" / "peg_in_hole.json")
    tried = opened(browser, tmp_path, scene)
    tried.page.locator("#drive label:has([value=car])").click()
    tried.page.locator("#way").filter(has_text=re.compile(r"a car needs about [\d,]+ manoeuvres")).wait_for(
        timeout=60_000
    )
    tried.close()


def test_car_without_reverse_gear(park: Tried) -> None:
    park.say("#way", CAR)
    park.page.locator("#reverses").uncheck()
    park.page.locator("#way").filter(has_text="A way exists with a reverse gear").wait_for(timeout=60_000)


def test_saved_scene_and_answer_carry_the_vehicle(park: Tried, tmp_path: Path) -> None:
    park.say("#way", CAR)
    park.page.locator("#radius").fill("7/2")
    park.page.locator("#radius").press("Enter")
    park.page.locator("#way:not(.old)").wait_for(timeout=60_000)
    files = [park.saved(what, tmp_path / f"{what}.json") for what in ("scene", "answer")]
    scene, path = cfree.load_scene(files[0]), cfree.load(files[1])
    assert isinstance(path, cfree.Path)
    assert scene.vehicle == path.vehicle == cfree.Car("7/2")
    verified = CliRunner().invoke(app, ["verify", *map(str, files)])
    assert verified.exit_code == 0, verified.output
    park.page.keyboard.press("Escape")
    park.page.locator("#drive label:has([value=any])").click()
    assert cfree.load_scene(park.saved("scene", tmp_path / "any.json")).vehicle is None


def test_answer_that_is_driven_is_shown_as_it_is(browser: Any, tmp_path: Path) -> None:
    scene = cfree.load_scene(PARK)
    for vehicle in (cfree.Car("9/2", axle=("1/3", 0)), None):
        path = cfree.plan(scene, vehicle=vehicle or "any", improve=0)
        assert isinstance(path, cfree.Path)
        tried = Tried(browser, view(scene, path, html=tmp_path / "page.html", browser=False))
        tried.ready("park_car")
        tried.say("#way", f"{len(path.motions)} {'motion' if vehicle else 'piece'}")
        assert moves(tried) == ("car" if vehicle else "any")
        assert not vehicle or (number(tried, "axle-x"), number(tried, "radius")) == ("1/3", "9/2")
        tried.close()


@pytest.mark.skipif(not AXE.exists(), reason="axe-core is not installed (`npm ci` in viewer/): not looked for faults")
@pytest.mark.parametrize("theme", ["light", "dark"])
def test_axe_finds_no_serious_fault(park: Tried, theme: Any) -> None:
    park.page.emulate_media(color_scheme=theme)
    park.page.locator(".handle.left").focus()
    park.page.evaluate(f"{AXE.read_text()}; 0")
    found = park.page.evaluate("axe.run({ resultTypes: ['violations', 'incomplete'] })")
    faults = [
        f"{fault['id']}: {fault['help']}: {node['html'][:120]}"
        for fault in found["violations"]
        if fault["impact"] in ("serious", "critical")
        for node in fault["nodes"]
    ]
    assert not faults, "\n".join(faults)
