"""The tutorials of the documentation run, and say what they say."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

from cfree import clearance

GALLERY = Path(__file__).parents[1] / "examples" / "gallery"


@pytest.mark.slow
def test_the_paper_in_15_minutes(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(GALLERY.parents[1])
    runpy.run_path(str(GALLERY / "plot_paper_in_15_minutes.py"))
    said = capsys.readouterr().out
    assert "'VertexEdge': 9, 'EdgeVertex': 9, 'VertexVertex': 9, 'EdgeEdge': 9" in said
    assert "Euler number [0]" in said
    assert said.rstrip().endswith("True")  # the robot's point is at the obstacle's vertex, exactly


def test_ompl_without_collisions(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("ompl", reason="the extra `ompl` is not installed")
    monkeypatch.chdir(GALLERY.parents[1])
    found = runpy.run_path(str(GALLERY / "plot_ompl_without_collisions.py"))
    said = capsys.readouterr().out
    assert "motions, free: True" in said and found["clearance"].least > 0


@pytest.mark.slow
def test_from_start_to_goal(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(GALLERY.parents[1])
    found = runpy.run_path(str(GALLERY / "plot_from_start_to_goal.py"))
    said = capsys.readouterr().out
    assert "free: True" in said and "not even one that touches. verified" in said
    assert found["proof"].of == "closed" and clearance(found["clear"], found["scene"]).least > 0.01


@pytest.mark.slow
def test_round_shapes(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(GALLERY.parents[1])
    found = runpy.run_path(str(GALLERY / "plot_round_shapes.py"))
    said = capsys.readouterr().out
    assert "is free of collisions. verified" in said and "not even one that touches. verified" in said
    assert "[True False None]" in said
    assert found["path"].curved is found["scene"] and found["proof"].curved is found["wide"]
