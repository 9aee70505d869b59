"""The page in the package is the one that its sources make; scenes are put into it whole."""

from __future__ import annotations

import html.parser
import json
import re
from importlib.resources import files
from pathlib import Path

import pytest

import cfree
from cfree.viewer import page
from page_hash import page_hash, tokens

ROOT = Path(__file__).parents[2]
TEXT = files("cfree.viewer").joinpath("page.html").read_text(encoding="utf-8")
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


@pytest.mark.slow  # only `make check` asks for a page of the newest core
def test_page_is_made_of_these_sources() -> None:
    made_of = re.search(r"<!-- inputs (\w+) -->", TEXT)
    assert made_of and made_of[1] == page_hash(), "the core or the viewer has changed: `make viewer`"


def test_comments_and_white_space_of_the_core_do_not_ask_for_another_page() -> None:
    text = """
        // a comment
        const double x = 1'000.5e-3, y = 'a' + R"(// no comment)"[0];  /* one */ int z;
    """
    same = """const double x=1'000.5e-3,y='a'+R"(// no comment)"[0];int/**/z ;"""
    assert [*tokens(text)] == [*tokens(same)] != [*tokens(same.replace("-3", "-4"))]
    assert "".join(tokens('s = "/* kept */";')) == 's="/* kept */";'


def test_page_is_one_file_of_at_most_four_megabytes() -> None:
    assert len(TEXT.encode()) <= 4 << 20
    assert not re.search(r"""(?:src|href)\s*=\s*["'](?!#|data:)""", re.sub(r"(?s)<script.*?</script>", "", TEXT))


def test_modules_of_the_page_import_in_no_circle() -> None:
    modules = (ROOT / "viewer" / "src").glob("*.ts")
    left = {module.stem: set(re.findall(r'from "\./(\w+)"', module.read_text())) for module in modules}
    while ready := {name for name, needed in left.items() if not needed & left.keys()}:
        left = {name: needed for name, needed in left.items() if name not in ready}
    assert not left


class Scripts(html.parser.HTMLParser):
    """The texts of scripts by their id."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: dict[str, str] = {}
        self.name = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.name = dict(attrs).get("id") or "" if tag == "script" else ""
        assert tag != "img"

    def handle_data(self, data: str) -> None:
        self.found[self.name] = self.found.get(self.name, "") + data


def test_names_do_not_end_the_script_that_they_are_in() -> None:
    name = "</script><img src=x onerror=alert(1)><!--"
    scene = cfree.Scene(
        SQUARE, [[(3, 0), (4, 0), (4, 1)]], obstacle_names=[name], start=(0, 0, 0), goal=(0, 3, "180deg")
    )
    given = json.loads(Scripts(page(scene, cfree.plan(scene))).found["given"])
    assert json.loads(given["scene"])["obstacles"][0]["name"] == name
    assert given["poses"].splitlines()[-1] == "0 3 inf" and given["goal"] == {"x": "0", "y": "3", "tau": "inf"}
