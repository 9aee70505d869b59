"""The tutorials of the documentation run, and say what they say."""

from __future__ import annotations

import runpy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import cfree
from cfree import clearance

GALLERY = Path(__file__).parents[1] / "examples" / "gallery"


Run = Callable[[str], tuple[dict[str, Any], str]]


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    """Runs a tutorial; gives its names, and what it said."""
    monkeypatch.chdir(GALLERY.parents[1])

    def found(name: str) -> tuple[dict[str, Any], str]:
        names = runpy.run_path(str(GALLERY / name))
        return names, capsys.readouterr().out

    return found


@pytest.mark.slow
def test_the_paper_in_15_minutes(run: Run) -> None:
    _, said = run("plot_paper_in_15_minutes.py")
    assert "'VertexEdge': 9, 'EdgeVertex': 9, 'VertexVertex': 9, 'EdgeEdge': 9" in said
    assert "Euler number [0]" in said
    assert said.rstrip().endswith("True")  # the robot's point is at the obstacle's vertex, exactly


def test_ompl_without_collisions(run: Run) -> None:
    pytest.importorskip("ompl", reason="the extra `ompl` is not installed")
    found, said = run("plot_ompl_without_collisions.py")
    assert "motions, free: True" in said and found["clearance"].least > 0


@pytest.mark.slow
def test_from_start_to_goal(run: Run) -> None:
    found, said = run("plot_from_start_to_goal.py")
    assert "free: True" in said and "not even one that touches. verified" in said
    assert found["proof"].of == "closed" and clearance(found["clear"], found["scene"]).least > 0.01


@pytest.mark.slow
def test_park_a_car(run: Run) -> None:
    found, said = run("plot_park_a_car.py")
    assert "free: True - drivable: True" in said and "a car with a turning radius of 3 m can drive it. verified" in said
    assert found["proof"].of == "closed" and "not even one that touches. verified" in said
    assert found["held"].sentence() in said and found["path"].goal == found["scene"].goal


@pytest.mark.slow
def test_round_shapes(run: Run) -> None:
    found, said = run("plot_round_shapes.py")
    assert "is free of collisions. verified" in said and "not even one that touches. verified" in said
    assert "[ True False  True]" in said
    assert found["path"].curved is found["scene"] and found["proof"].curved is found["wide"]


@pytest.mark.slow
def test_nest_parts(run: Run) -> None:
    names, said = run("plot_nest_parts.py")
    assert "exact fits: 1 segment, 0 points" in said and "holes 0 -> 1" in said
    assert "tile (part 0) and tile (part 1): 0.001 deep" in said and said.rstrip().endswith("[True, True]")
    assert not cfree.nesting.overlaps(names["cut"]) and len(names["cut"].placed) == 5


@pytest.mark.slow
def test_audit_a_floor_plan(run: Run) -> None:
    found, said = run("plot_audit_a_floor_plan.py")
    assert [door.result for door in found["result"].doors] == ["blocked"] * 4 + ["passes"] * 8
    assert "not even one that touches. verified" in said and said.rstrip().endswith(
        "room to turn round in the hall: False"
    )


@pytest.mark.slow
def test_cage_a_part(run: Run) -> None:
    found, said = run("plot_cage_a_part.py")
    assert said.count("verified by other code: True") == 1 and "(0, 1) verified: True" in said
    assert found["cage"] and not found["free"] and found["held"].order == 2 and not found["loose"]


@pytest.mark.slow
def test_take_it_apart(run: Run) -> None:
    found, said = run("plot_take_apart.py")
    assert "out: wedge, left block, right block" in said and "enclosed at its orientation: True" in said
    assert "verified by other code: True" in said and found["out"].path.turning > 1
