"""Arguments are checked and read once, in public functions; the inner ones get poses and one record of options."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator
from dataclasses import FrozenInstanceError, fields
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

import pytest

import cfree
from cfree import Pose, Scene
from cfree.planning import pose_planner
from cfree.planning.options import Options, to_distance, to_seconds

INNER = ("pose_planner", "goals", "clearance", "moved_ends", "near_poles", "keep_clear", "core_ways")
PLANNING = FilePath(cfree.__file__).parent / "planning"
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
SCENE = Scene(SQUARE, [[(3, -5), (4, -5), (4, 1), (3, 1)]], bounds=(-9, -9, 9, 9), start=(0, 0, 0), goal=(6, 0, 0))


def functions() -> Iterator[tuple[str, ast.FunctionDef]]:
    """All functions of the package, each with its file."""
    for file in sorted(PLANNING.glob("*.py")):
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.FunctionDef):
                yield f"{file.stem}.{node.name}", node


def test_only_checked_functions_take_what_is_like_a_pose() -> None:
    takers = {}
    for name, node in functions():
        hints = [ast.unparse(a.annotation) for a in (*node.args.args, *node.args.kwonlyargs) if a.annotation]
        if any("PoseLike" in hint for hint in hints):
            takers[name] = {ast.unparse(mark) for mark in node.decorator_list} & {"checked", "overload"}
    assert "plan.plan" in takers and "planner.plan" in takers
    assert [name for name, marks in takers.items() if not marks] == []


def test_inner_functions_convert_no_poses() -> None:
    readers = {"to_pose", "require_free", "nearest_free", "turn_in_place", "motion_between"}
    for name in INNER:
        imports = [
            n for n in ast.walk(ast.parse((PLANNING / f"{name}.py").read_text())) if isinstance(n, ast.ImportFrom)
        ]
        assert {alias.name for node in imports for alias in node.names} & readers == set(), name


def test_options_of_plan_are_one_frozen_record() -> None:
    wanted = {"clearance", "improve", "objective", "preferences"}
    wanted |= {"tolerance", "nearest_free", "max_seconds", "progress", "vehicle"}
    assert wanted <= set(inspect.signature(cfree.plan).parameters)
    assert {item.name for item in fields(Options)} - {"exact_discs", "phase", "stop", "work"} == wanted
    with pytest.raises(FrozenInstanceError):
        Options().improve = 1.0  # type: ignore[misc]


def test_inner_functions_get_options_whole() -> None:
    names = {item.name for item in fields(Options)}
    for name, node in functions():
        if name.split(".")[0] in INNER:
            assert len({argument.arg for argument in (*node.args.args, *node.args.kwonlyargs)} & names) <= 1, name


def test_a_query_is_handed_on_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[tuple[Any, ...]] = []

    def way(self: Any, start: Pose, goal: Pose, options: Options) -> list[Pose]:
        seen.append((start, goal, options))
        return [start, start]

    monkeypatch.setattr(pose_planner.PosePlanner, "way", way)
    preferences = cfree.Preferences(sideways=2)
    cfree.plan(SCENE, (0, "1/3", 0), improve=0, objective="short", preferences=preferences, max_seconds=9)
    cfree.Planner(SCENE, None, 9, preferences).plan((0, "1/3", 0), (6, 0, 0), improve=0, objective="short")
    for start, goal, options in seen:
        assert (start, goal) == (Pose(0, "1/3"), Pose(6, 0)) and isinstance(options, Options)
        assert (options.improve, options.objective, options.preferences, options.max_seconds) == (
            0, "short", preferences, 9,
        )  # fmt: skip
    assert len(seen) == 2


def test_options_are_read_exactly_and_refused_with_a_remedy() -> None:
    assert (to_distance(None), to_distance("1/3"), to_distance(0.5)) == (0, Fraction(1, 3), Fraction(1, 2))
    assert (to_seconds(None), to_seconds(0), to_seconds(2.5)) == (None, 0, 2.5)
    for clearance in (0, -1, "-1/3"):
        with pytest.raises(ValueError, match="give a length above 0"):
            to_distance(clearance)
    for improve in (-1, float("inf"), float("nan")):
        with pytest.raises(ValueError, match="give seconds, 0 or more"):
            to_seconds(improve)


def test_a_position_too_far_for_the_core_is_refused_by_each_public_planner() -> None:
    far = (10**151, 0, 0)
    round_scene = Scene(cfree.Curved.circle((0, 0), 1), [cfree.Curved.circle((4, 0), 1)])
    curved = cfree.planning.curved.CurvedPlanner(cfree.Planner(round_scene))
    for scene, asked in ((SCENE, cfree.Planner(SCENE)), (round_scene, curved)):
        for ask in (lambda *ends, scene=scene: cfree.plan(scene, *ends), asked.plan):
            with pytest.raises(cfree.InvalidPoseError, match="goal: its position is beyond 1e150"):
                ask((0, 0, 0), far)
        for several in (lambda *ends, scene=scene: cfree.plan(scene, *ends), asked.plan_any):
            with pytest.raises(cfree.InvalidPoseError, match="goal 1: its position is beyond 1e150"):
                several((0, 0, 0), [(1, 1), far[:2]])


def test_shared_time_is_divided_and_no_time_stays_none() -> None:
    assert [Options(improve=seconds).shared(4).improve for seconds in (None, 0, 2.0)] == [None, 0, 0.5]
