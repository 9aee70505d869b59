"""The README's code runs and prints what it shows; links, files and names on all pages lead somewhere."""

from __future__ import annotations

import doctest
import importlib
import re
import shlex
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest

import cfree
from public import NAMES

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "benchmarks/README.md")]
PAGES += sorted(page for page in (ROOT / "docs").rglob("*.md") if not {"_build", "gallery"} & {*page.parts})
FILES = {
    str(path.relative_to(ROOT))
    for folder in ("src", "cpp", "tests", "tools", "benchmarks", "examples", "docs")
    for path in (ROOT / folder).rglob("*")
}
EVERY_PAGE = pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))


@pytest.mark.slow
def test_the_code_prints_what_it_shows(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    result = doctest.testfile(str(ROOT / "README.md"), module_relative=False)
    assert result.attempted >= 8
    assert result.failed == 0


@pytest.mark.slow
def test_the_job_of_the_readme_runs_as_it_is_written(tmp_path: Path) -> None:
    (job,) = re.findall(r"```sh\n(cfree convert .*?)```", (ROOT / "README.md").read_text(), re.S)
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    for line in job.splitlines():
        _, *words = shlex.split(line)
        subprocess.run([sys.executable, "-m", "cfree", *words], cwd=tmp_path, check=True, capture_output=True)
    written = {file.name for file in tmp_path.iterdir() if file.is_file()}
    assert written == {"office.json", "answer.json", "answer.png", "poses.csv"}
    assert (tmp_path / "poses.csv").read_text().startswith("x,y,theta,t\n0.7,0.6,0.0,0.0\n")


@pytest.mark.slow
def test_the_car_of_the_readme_parks_and_the_larger_one_of_its_picture_cannot() -> None:
    text = " ".join((ROOT / "README.md").read_text().split())
    (percent,) = {*re.findall(r"the same car, (\d+) % larger", text)}
    factor = 1 + Fraction(int(percent), 100)
    scene = cfree.load_scene(ROOT / "examples" / "scenes" / "parking_bay.json")
    largest = cfree.max_scale(scene)
    assert factor - Fraction(1, 100) < largest.lo and largest.hi <= factor
    path = cfree.plan(scene, improve=0)
    assert isinstance(path, cfree.Path) and cfree.is_drivable(path, cfree.Car(3, axle=(Fraction(-5, 4), 0)))
    robot = [[(factor * x, factor * y) for x, y in part.exact_vertices] for part in scene.robot]
    larger = cfree.Scene(robot, scene.obstacles, workspace=scene.workspace, start=scene.start, goal=scene.goal)
    assert cfree.is_free(larger, larger.start) and cfree.is_free(larger, larger.goal)  # it fits the lane and the bay
    proof = cfree.plan(larger)
    assert isinstance(proof, cfree.Separated) and proof.of == "closed"


def test_the_readme_is_read_in_a_minute_in_the_words_of_the_field() -> None:
    text = (ROOT / "README.md").read_text()
    assert text.count("\n") <= 120
    assert not re.findall(r"\b(?:pillars?|trapezoids?|live)\b", text)
    assert {"make demo", "make test"} <= {line.split("#")[0].strip() for line in text.splitlines()}


def test_sentences_of_pages_are_short() -> None:
    long = [found for page in PAGES if page.parent.name != "theory" for found in sentences(page) if words(found) > 40]
    assert len(long) <= 10, long


def sentences(page: Path) -> list[str]:
    """Split a page: a blank line, a list item, an image and a table row each end a sentence; code is left out."""
    text = re.sub(r"```.*?```", "", page.read_text(), flags=re.S)
    blocks = re.split(r"\n\s*\n|\n(?=\s*[-*|] |\s*\d+\. |!\[)|\|", re.sub(r"\$[^$]*\$", "formula", text))
    return [sentence for block in blocks for sentence in re.split(r"(?<=[.!?:;])\s+", " ".join(block.split()))]


def words(sentence: str) -> int:
    return len(sentence.split())


@EVERY_PAGE
def test_links_lead_to_files(page: Path) -> None:
    for link in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", page.read_text()):
        if not link.startswith(("http", "gallery/")):  # pages of the gallery are made by Sphinx
            assert (page.parent / link).exists(), link


@EVERY_PAGE
def test_files_and_folders_that_are_named_exist(page: Path) -> None:
    text = page.read_text()
    for name in re.findall(
        r"[\w./]*\w\.(?:py|pyi|cpp|hpp)\b|\b(?:tests|examples)/[\w/]+\.\w+|(?<=`)[\w/]+/(?=`)", text
    ):
        assert any(f"/{file}".endswith(f"/{name.strip('/')}") for file in FILES), name


@EVERY_PAGE
def test_names_of_the_package_exist(page: Path) -> None:
    text = page.read_text()
    for name in re.findall(r"\bcfree(?:\.[A-Za-z_]\w*)+", text):
        assert exists(name), name
    for kind, name in re.findall(r"`([A-Z]\w+)\.(\w+)", text):
        if owner := next((owner for public, owner in NAMES.items() if public.split(".")[-1] == kind), None):
            assert hasattr(owner, name) or re.search(rf"^ +.*\b{name}\b.* : ", owner.__doc__, re.M), f"{kind}.{name}"


def exists(name: str) -> bool:
    """Whether a dotted name is a module, or an attribute of one."""
    first, *rest = name.split(".")
    found: object = importlib.import_module(first)
    try:
        for k, part in enumerate(rest):
            if not hasattr(found, part):
                importlib.import_module(".".join([first, *rest[: k + 1]]))
            found = getattr(found, part)
    except ImportError as error:
        return error.name == "ompl"  # an extra that some platforms do not have
    return True


def test_the_reference_lists_every_public_name() -> None:
    listed = {line.strip() for line in (ROOT / "docs" / "api.md").read_text().splitlines() if line.startswith("   ")}
    assert {*NAMES} - {"__version__"} <= listed
    assert all(exists(f"cfree.{name}") for name in listed if not name.startswith(":"))


@pytest.mark.slow
def test_pages_and_names_in_sources_exist() -> None:
    titles = {title for page in PAGES for title in re.findall(r"^#+ (.*)$", page.read_text(), re.M)}
    for folder in ("src", "cpp", "tests", "tools", "examples/gallery", "benchmarks"):
        for file in (ROOT / folder).rglob("*"):
            if file.suffix in (".py", ".cpp", ".hpp"):
                text = file.read_text()
                for page in re.findall(r"\bdocs/[\w/-]+\.md", text):
                    assert (ROOT / page).exists(), f"{file}: {page}"
                assert {*re.findall(r"\btheory, \"([^\"]+)\"", text)} <= titles, file
                for name in {*re.findall(r"\bcfree(?:\.[A-Za-z_]\w*)+", text)}:
                    assert exists(name), f"{file}: {name}"


def test_sources_of_the_core_open_with_what_they_do() -> None:
    for file in (ROOT / "cpp").rglob("*.?pp"):
        assert "tests" in file.parts[-2:] or file.read_text().startswith("// "), file


def test_the_readme_says_of_sampling_planners_what_the_comparison_measured() -> None:
    readme, table = ((ROOT / name).read_text() for name in ("README.md", "docs/comparison.md"))
    head, row = (
        next(line for line in table.splitlines() if line.startswith(start)) for start in ("| scene |", "| nest_swim |")
    )
    said = dict(zip(head.split("|"), row.split("|"), strict=True))
    assert "**f**" in said[" RRTConnect, 1 % "] and "**–**" in said[" RRTConnect, 0.1 % "]  # a false path, no answer
    said_here = (
        "A sampling planner cannot tell: it runs until its time limit, or [returns a false path](docs/comparison.md)."
    )
    assert said_here in " ".join(readme.split())
