"""The tutorials of the documentation run as notebooks, and print what they should."""

from __future__ import annotations

import ast
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from matplotlib.figure import Figure

import cfree
from cfree import clearance
from notebooks import notebooks

EXAMPLES = Path(__file__).parents[1] / "examples"
Run = Callable[[str], tuple[dict[str, Any], str]]


def code(name: str) -> list[str]:
    """Return the code of the cells of a notebook, without the first one, which tells where pictures go."""
    cells = json.loads((EXAMPLES / "notebooks" / f"{name}.ipynb").read_text())["cells"]
    first, *rest = ("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
    assert first == "%matplotlib inline"
    return rest


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    """Runs the notebook of a tutorial in its folder; returns its names, and what it printed.

    A cell ends with its picture or the page, or shows nothing.
    """
    pytest.importorskip("anywidget", reason="the extra `notebook` is not installed")
    monkeypatch.chdir(EXAMPLES / "notebooks")

    def names_and_output(name: str) -> tuple[dict[str, Any], str]:
        names: dict[str, Any] = {"__name__": "__main__"}
        shown = list[str]()
        for k, cell in enumerate(code(name)):
            *body, last = ast.parse(cell).body
            ending = ast.Expression(last.value) if isinstance(last, ast.Expr) else None
            exec(compile(ast.Module(body if ending else [*body, last], []), f"{name}, cell {k}", "exec"), names)
            if ending and (value := eval(compile(ending, f"{name}, cell {k}", "eval"), names)) is not None:
                assert isinstance(value, Figure) or "_repr_mimebundle_" in dir(value), (k, value)
                shown.append(type(value).__name__)
        assert shown.count("Figure") == sum("\nfigure = " in f"\n{cell}" for cell in code(name))
        return names, capsys.readouterr().out

    return names_and_output


def test_each_tutorial_has_its_notebook_as_the_tool_writes_it() -> None:
    written = {path.name: path.read_text() for path in (EXAMPLES / "notebooks").glob("*.ipynb")}
    assert written == notebooks(), "run `make notebooks`"
    trades = {
        "count_holes",
        "nest_parts",
        "cage_a_part",
        "take_apart",
        "audit_a_floor_plan",
        "park_a_car",
        "ompl_without_collisions",
    }
    assert {f"{name}.ipynb" for name in (*trades, "teach_a_lesson")} <= {*written}


@pytest.mark.slow
def test_the_paper_in_15_minutes(run: Run) -> None:
    _, said = run("paper_in_15_minutes")
    assert "'VertexEdge': 9, 'EdgeVertex': 9, 'VertexVertex': 9, 'EdgeEdge': 9" in said
    assert "Euler number [0]" in said
    assert said.rstrip().endswith("True")  # the robot's point is at the obstacle's vertex, exactly


def test_ompl_without_collisions(run: Run) -> None:
    pytest.importorskip("ompl", reason="the extra `ompl` is not installed")
    found, said = run("ompl_without_collisions")
    assert "motions, free: True" in said and found["clearance"].least > 0


@pytest.mark.slow
def test_from_start_to_goal(run: Run) -> None:
    found, said = run("from_start_to_goal")
    assert "free: True" in said and "not even one that touches. verified" in said
    assert found["proof"].of == "closed" and clearance(found["clear"], found["scene"]).least > 0.01


@pytest.mark.slow
def test_park_a_car(run: Run) -> None:
    found, said = run("park_a_car")
    assert "free: True - drivable: True" in said and "a car with a turning radius of 3 m can drive it. verified" in said
    assert found["proof"].of == "closed" and "not even one that touches. verified" in said
    assert found["held"].sentence() in said and found["path"].goal == found["scene"].goal


@pytest.mark.slow
def test_round_shapes(run: Run) -> None:
    found, said = run("round_shapes")
    assert "is free of collisions. verified" in said and "not even one that touches. verified" in said
    assert "[ True False  True]" in said
    assert found["path"].curved is found["scene"] and found["proof"].curved is found["wide"]


@pytest.mark.slow
def test_nest_parts(run: Run) -> None:
    names, said = run("nest_parts")
    assert "exact fits: 1 segment, 0 points" in said and "holes 0 -> 1" in said
    assert "tile (part 0) and tile (part 1): 0.001 deep" in said and said.rstrip().endswith("[True, True]")
    assert not cfree.nesting.overlaps(names["cut"]) and len(names["cut"].placed) == 5


@pytest.mark.slow
def test_audit_a_floor_plan(run: Run) -> None:
    found, said = run("audit_a_floor_plan")
    assert [door.result for door in found["result"].doors] == ["blocked"] * 4 + ["passes"] * 8
    assert "not even one that touches. verified" in said and said.rstrip().endswith(
        "room to turn round in the hall: False"
    )


@pytest.mark.slow
def test_cage_a_part(run: Run) -> None:
    found, said = run("cage_a_part")
    assert said.count("verified by other code: True") == 1 and "(0, 1) verified: True" in said
    assert found["cage"] and not found["free"] and found["held"].order == 2 and not found["loose"]


@pytest.mark.slow
def test_take_it_apart(run: Run) -> None:
    found, said = run("take_apart")
    assert "out: wedge, left block, right block" in said and "enclosed at its orientation: True" in said
    assert "verified by other code: True" in said and found["out"].path.turning > 1


@pytest.mark.slow
def test_teach_a_lesson(run: Run) -> None:
    names, said = run("teach_a_lesson")
    assert "0deg 9.0\n45deg 10.657\n" in said and "2 cells; turns: [0, 0]" in said
    assert "not even one that touches. verified" in said and names["proof"].of == "closed"


@pytest.mark.slow
def test_count_holes(run: Run) -> None:
    _, said = run("count_holes")
    counts = [line.split("(")[1].split(")")[0] for line in said.splitlines() if "long" in line]
    assert counts == ["b0=1, b1=2, b2=1"] * 2 + ["b0=1, b1=5, b2=0"] * 2 and "\n-4.0 -4\n" in said
