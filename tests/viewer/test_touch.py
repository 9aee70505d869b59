"""The page under fingers: what is dragged follows and stays, what is cancelled goes back, two fingers zoom."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

import cfree
from cfree import view
from pages import PHONE, TABLET, Fingers, Place, Tried

pytestmark = pytest.mark.slow

#  start      goal
#        robot
#  square          obstacle
SCENE = cfree.Scene(
    robot=[(0, 0), (1, 0), (1, 1), (0, 1)],
    obstacles=[[(6, 0), (9, 0), (9, 3), (6, 3)]],
    bounds=(-2, -2, 12, 10),
    start=(1, 7, 0),
    goal=(8, 7, 0),
    name="apart",
)
BODIES = ["robot", "start", "goal"]
PLACES = "all => all.map(one => one.getAttribute('transform'))"


@pytest.fixture(scope="module", params=[PHONE, pytest.param(TABLET, marks=pytest.mark.long)], ids=["phone", "tablet"])
def device(browser: Any, request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Tried]:
    file = view(SCENE, html=tmp_path_factory.mktemp("page") / "page.html", browser=False)
    tried = Tried(browser, file, **request.param)
    tried.ready("apart")
    yield tried
    tried.close()


@pytest.fixture
def page(device: Tried) -> Any:
    """The page as it begins, but for the robot, which has been moved away from its start."""
    device.show(SCENE)
    device.page.locator(".body.robot").focus()
    for key in ["Shift+ArrowDown", "Shift+ArrowRight", "ArrowDown"]:
        device.page.keyboard.press(key)
        settled(device.page)
    device.page.evaluate("document.activeElement.blur()")
    return device.page


def middle(page: Any, selector: str) -> Place:
    box = page.locator(selector).bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def point(page: Any, who: str) -> Place:
    return middle(page, f".body.{who} .point")


def pose(page: Any, who: str) -> str:
    return str(page.locator(f".body.{who}").get_attribute("transform"))


def shown(page: Any) -> list[float]:
    """Scale and place of the drawing."""
    text = page.locator("#workspace > svg > g").get_attribute("transform")
    return [float(number) for number in text[len("matrix(") : -1].split()]


def scale(page: Any) -> float:
    """Pixels a unit."""
    return shown(page)[0]


def is_near(found: Place, x: float, y: float) -> bool:
    return abs(found[0] - x) < 3 and abs(found[1] - y) < 3


def settled(page: Any) -> None:
    """Wait until bodies and drawing have stayed where they are for 0.3 s: contacts and the grid draw a body to them."""
    places = None
    while places != (places := page.locator("#workspace > svg [transform]").evaluate_all(PLACES)):
        page.wait_for_timeout(300)


def edited(page: Any) -> None:
    page.locator("#edit-shapes").click()
    settled(page)


@pytest.mark.long
@pytest.mark.parametrize("who", BODIES)
def test_a_body_follows_the_finger_that_drags_it(page: Any, who: str) -> None:
    x, y = point(page, who)
    for dx, dy in ((24, 30), (-16, -44)):
        Fingers(page).drag((x, y), dx, dy)
        settled(page)
        x, y = x + dx, y + dy
        assert is_near(point(page, who), x, y)
    assert page.evaluate("scrollY") == 0


@pytest.mark.parametrize("who", BODIES)
def test_a_cancelled_drag_restores_the_pose_before_it(page: Any, who: str) -> None:
    before, way, (x, y) = pose(page, who), page.locator("#way").inner_text(), point(page, who)
    Fingers(page).drag((x, y), 30, 25, end="Cancel")
    settled(page)
    assert pose(page, who) == before
    assert page.locator("#way:not(.old)").inner_text() == way
    Fingers(page).drag((x, y), 20, 15)
    settled(page)
    assert is_near(point(page, who), x + 20, y + 15)
    page.locator("#undo").click()  # a drag that was cancelled is no step
    settled(page)
    assert pose(page, who) == before


def test_the_robot_is_turned_by_its_knob(page: Any) -> None:
    x, y = middle(page, ".body.robot .knob")
    Fingers(page).drag((x, y), -20, -60)
    settled(page)
    turned = pose(page, "robot")
    assert 30 < float(turned.partition("rotate(")[2][:-1]) < 100
    Fingers(page).drag(middle(page, ".body.robot .knob"), 40, 20, end="Cancel")
    settled(page)
    assert pose(page, "robot") == turned


def test_the_hidden_knob_of_a_goal_lets_fingers_through(page: Any) -> None:
    before, view = pose(page, "goal"), shown(page)
    Fingers(page).drag(middle(page, ".body.goal .knob"), 10, 30)
    settled(page)
    assert pose(page, "goal") == before and shown(page) != view


def test_handles_come_again_with_the_next_edit(page: Any) -> None:
    for _ in range(2):
        edited(page)
        page.locator(".obstacle").tap()
        assert page.locator(".handles .vertex").count() == 4 and page.locator(".handles .knob").count() == 1
        edited(page)
        assert page.locator(".handles *").count() == 0


@pytest.mark.long
@pytest.mark.parametrize("handle", [".obstacle", ".handles [data-spot='0 0']", ".handles .knob"])
def test_an_obstacle_follows_the_finger_and_goes_back_when_cancelled(page: Any, handle: str) -> None:
    edited(page)
    page.locator(".obstacle").tap()
    outline = page.locator(".obstacle")
    before, at = outline.get_attribute("d"), middle(page, handle)
    Fingers(page).drag(at, 15, -25, end="Cancel")
    settled(page)
    assert outline.get_attribute("d") == before
    assert page.locator("#undo").is_disabled() or page.locator("#edit").inner_text() == ""
    Fingers(page).drag(at, 15, -25)
    settled(page)
    moved = outline.get_attribute("d")
    assert moved != before
    if handle != ".handles .knob":
        assert is_near(middle(page, handle), at[0] + 15, at[1] - 25)
    page.locator("#undo").click()
    settled(page)
    assert outline.get_attribute("d") == before


def test_a_double_tap_on_an_edge_adds_a_corner(page: Any) -> None:
    edited(page)
    page.locator(".obstacle").tap()
    (ax, ay), (bx, by) = (middle(page, f".handles [data-spot='0 {k}']") for k in (0, 1))
    for _ in range(2):
        page.touchscreen.tap((ax + bx) / 2, (ay + by) / 2)
    settled(page)
    assert page.locator(".handles .vertex").count() == 5


def test_two_fingers_zoom_around_their_middle(page: Any) -> None:
    at, before = point(page, "goal"), scale(page)
    Fingers(page).pinch(at, 60, 120)
    settled(page)
    assert scale(page) == pytest.approx(2 * before, rel=0.02) and is_near(point(page, "goal"), *at)
    Fingers(page).pinch(at, 120, 40)
    settled(page)
    assert scale(page) == pytest.approx(2 / 3 * before, rel=0.02) and is_near(point(page, "goal"), *at)
    assert page.evaluate("visualViewport.scale") == 1  # the page has not been zoomed


def test_a_cancelled_pinch_restores_the_view_before_it(page: Any) -> None:
    before = shown(page)
    Fingers(page).pinch(point(page, "goal"), 60, 120, end="Cancel")
    settled(page)
    assert shown(page) == pytest.approx(before)


@pytest.mark.parametrize("who", BODIES)
def test_a_second_finger_makes_a_pinch_of_a_drag(page: Any, who: str) -> None:
    before, size, (x, y) = pose(page, who), scale(page), point(page, who)
    fingers = Fingers(page)
    fingers.touch("Start", (x, y))
    fingers.glide([(x, y)], [(x + 20, y + 20)])
    fingers.touch("Start", (x + 20, y + 20), (x + 60, y + 20))
    fingers.glide([(x + 20, y + 20), (x + 60, y + 20)], [(x, y + 20), (x + 80, y + 20)])
    fingers.touch("End")
    settled(page)
    assert pose(page, who) == before and scale(page) == pytest.approx(2 * size, rel=0.02)


def test_one_finger_moves_the_drawing_and_taps_tell_the_cell(page: Any) -> None:
    (x, y), (_, low) = point(page, "goal"), middle(page, "#workspace > svg")
    floor = point(page, "start")[0] - 10, low + 60  # nothing is there
    Fingers(page).drag(floor, 30, 20)
    settled(page)
    assert is_near(point(page, "goal"), x + 30, y + 20)
    Fingers(page).drag(floor, 30, 20, end="Cancel")
    settled(page)
    assert is_near(point(page, "goal"), x + 30, y + 20)
    page.touchscreen.tap(*floor)
    page.locator("#picked").filter(has_text="ell").wait_for(timeout=10_000)


def test_taps_draw_an_obstacle(page: Any) -> None:
    edited(page)
    page.locator("#draw").click()
    x, y = middle(page, "#workspace > svg")
    corners = [(x - 20, y - 10), (x + 20, y - 10), (x + 20, y + 20)]
    for corner in corners:
        page.touchscreen.tap(*corner)
        page.wait_for_timeout(60)
    Fingers(page).pinch((x, y), 40, 60)  # puts no corner
    assert page.locator(".handles .vertex").count() == 3
    page.keyboard.press("Enter")
    settled(page)
    assert page.locator(".obstacle").count() == 2


def test_the_page_scrolls_beside_the_drawing(page: Any) -> None:
    height, inner = page.evaluate("[document.documentElement.scrollHeight, innerHeight]")
    begin = middle(page, "#way")
    Fingers(page).drag(begin, 0, -150)
    settled(page)
    assert (page.evaluate("scrollY") > 50) == (height > inner)
    page.evaluate("scrollTo(0, 0)")
    Fingers(page).drag(middle(page, "#workspace > svg"), 0, -100)
    settled(page)
    assert page.evaluate("scrollY") == 0
