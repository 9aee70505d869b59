"""Scenes of few vertices whose boundary takes long: refused in time, with counts, unless a limit is given."""

import math
import random
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

import cfree
import cfree.forbidden.boundary as driver
from cfree import Boundary, LaboriousSceneError, Scene, boundary, load_scene, save
from cfree import Path as Way
from cfree.cli.app import app
from cfree.forbidden import labour as labours
from cfree.forbidden.labour import FIRST_LOOK, MOST_STEPS, SECOND_LOOK, labour
from cfree.scene.features import scene_features
from examples import POLYGONS

Ring = list[tuple[float, float]]


def star(points: int, x: float = 0.0, turn: float = 0.0) -> Ring:
    angles = [turn + math.pi * k / points for k in range(2 * points)]
    return [(x + r * math.cos(a), r * math.sin(a)) for a, r in zip(angles, [5.0, 2.0] * points, strict=True)]


def comb(teeth: int, gap: float = 1.2) -> Ring:
    """Upright teeth of width 1 on a bar."""
    tops = [(k * (1 + gap), 6.0) for k in range(teeth)]
    ring = [(0.0, -1.0), (tops[-1][0] + 1, -1.0)]
    for x, top in reversed(tops):
        ring += [(x + 1, top), (x, top)] + ([(x, 0.0), (x - gap, 0.0)] if x > 0 else [])
    return ring


def bars(count: int, seed: int) -> list[Ring]:
    choose = random.Random(seed)
    places = [(choose.uniform(-8, 8), choose.uniform(-8, 8)) for _ in range(count)]
    turns = [0.1 + math.pi * (0.5 + k) / 2 for k in range(4)]
    return [[(x + 0.3 * math.cos(a), y + 0.3 * math.sin(a)) for a in turns] for x, y in places]


def two_stars(points: int = 60) -> Scene:
    return Scene(star(points), [star(points, x=12, turn=0.01)], start=(-10, 0, 0), goal=(25, 0, 0))


def two_combs(teeth: int = 60) -> Scene:
    turned = [(-x, 20.0 - y) for x, y in comb(teeth)]
    return Scene(comb(teeth), [turned], start=(0, -30, 0), goal=(0, 80, math.pi))


def bars_among_bars(count: int = 40) -> Scene:
    return Scene(bars(count, 4), bars(count, 5), start=(-25, 0, 0), goal=(25, 0, 0))


@pytest.mark.parametrize(
    ("scene", "vertices", "patches", "pairs"),  # the pairs that the whole boundary counts
    [
        pytest.param(two_stars(), "120 vertices of the robot among 120", "14,400", 8_831_040, marks=pytest.mark.slow),
        pytest.param(two_combs(), "240 vertices of the robot among 240", "58,560", 9_537_926, marks=pytest.mark.slow),
        (bars_among_bars(), "160 vertices of the robot among 160", "51,200", 1_987_421),
    ],
    ids=["two stars of 60 points", "two combs of 60 teeth", "40 bars among 40"],
)
def test_a_laborious_boundary_is_refused_with_its_counts(
    scene: Scene, vertices: str, patches: str, pairs: int
) -> None:
    with pytest.raises(LaboriousSceneError) as refused:
        boundary(scene)
    said = str(refused.value)
    assert said.startswith(f"{vertices}: {patches} contact patches") and "\n" not in said
    assert "cfree.plan" in said and "max_seconds=math.inf" in said
    assert refused.value.pairs == pytest.approx(pairs, rel=0.1)


def test_a_limit_or_another_boundary_goes_on() -> None:
    scene = bars_among_bars()
    for limit in ({"max_seconds": 0.01}, {"max_memory": 1.0}):
        assert not boundary(scene, **limit).complete  # type: ignore[arg-type]
    few = Scene(bars(2, 4), bars(2, 5))
    assert boundary(few, reuse=boundary(few), max_seconds=math.inf).complete


@pytest.mark.slow
def test_plan_takes_a_scene_whose_boundary_is_refused() -> None:
    scene = bars_among_bars()
    assert isinstance(cfree.plan(scene, scene.start, scene.goal, improve=0), Way)  # type: ignore[arg-type]


def test_the_command_refuses_in_one_line(tmp_path: Path) -> None:
    save(bars_among_bars(), tmp_path / "bars.json")
    for command in (["boundary"], ["slice", "--theta", "0"]):
        result = CliRunner().invoke(app, [*command, str(tmp_path / "bars.json")])
        assert result.exit_code == 2 and result.stderr.count("\n") == 1 and "51,200 contact patches" in result.stderr
        assert "cfree boundary --max-seconds inf" in result.stderr
    result = CliRunner().invoke(app, ["boundary", str(tmp_path / "bars.json"), "--max-seconds", "0.01"])
    assert result.exit_code == 3


def test_an_estimate_is_about_what_a_boundary_counts() -> None:
    scene = load_scene("examples/scenes/benchmr_parking1.json")
    estimate, stats = labour(scene_features(scene), 512), boundary(scene).stats
    assert estimate.pairs == pytest.approx(stats.pairs, rel=0.2)
    signs = stats.decided_by_filter + stats.decided_by_intervals + stats.decided_exactly
    assert estimate.signs == pytest.approx(signs, rel=0.2)
    whole = labour(scene_features(scene), stats.patches)
    assert (whole.pairs, whole.patches) == (stats.pairs, stats.patches)


def test_no_example_is_near_the_limit() -> None:
    for file in POLYGONS:
        assert labour(scene_features(load_scene(file)), FIRST_LOOK).steps < MOST_STEPS / 20, file


def test_six_stars_that_take_eleven_seconds_are_refused() -> None:
    others = [[(x, y + 8 * j) for x, y in star(30, x=8 * i, turn=0.01 * i)] for i in range(3) for j in range(2)]
    with pytest.raises(LaboriousSceneError, match="21,600 contact patches"):
        boundary(Scene(star(30), others))


@pytest.mark.parametrize("gap", [0.0, 2**-20])
def test_a_near_fit_of_a_few_seconds_is_not_refused(gap: float) -> None:
    """A polygon of 60 sides in its own hole, in floats: more than ten million signs in balls, most of them cheap."""
    around = [0.1 + math.tau * k / 60 for k in range(60)]
    hole = [((1 + gap) * math.cos(a), (1 + gap) * math.sin(a)) for a in reversed(around)]
    frame = cfree.Polygon([(-2, -2), (2, -2), (2, 2), (-2, 2)], [hole])
    scene = Scene([(math.cos(a), math.sin(a)) for a in around], [frame])
    assert labour(scene_features(scene), SECOND_LOOK).steps < MOST_STEPS


def test_larger_scenes_and_fewer_patches_are_not_estimated(monkeypatch: pytest.MonkeyPatch) -> None:
    looked: list[int] = []

    def recorded(features: Any, samples: int) -> labours.Labour:
        looked.append(samples)
        return labours.Labour(0, 0, 0, 2 * MOST_STEPS if samples == SECOND_LOOK else MOST_STEPS)

    monkeypatch.setattr(labours, "labour", recorded)
    boundary(Scene(star(5), [star(5, x=12)]))
    assert looked == []
    monkeypatch.setattr(labours, "FEW_PATCHES", 0)
    with pytest.raises(LaboriousSceneError):
        boundary(Scene(star(5), [star(5, x=12)]))
    assert looked == [FIRST_LOOK, SECOND_LOOK]
    monkeypatch.setattr(labours, "MANY_VERTICES", 20)
    assert boundary(Scene(star(5), [star(5, x=12)])).complete


def test_a_fault_of_the_estimate_is_reported_as_a_bug(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise RuntimeError("no sample decides")

    monkeypatch.setattr(labours, "FEW_PATCHES", 0)
    monkeypatch.setattr(labours._core, "sampled_count", fail)
    scene = Scene(star(5), [star(5, x=12)])
    with pytest.raises(cfree.InvariantError, match="no sample decides; this is a bug") as error:
        boundary(scene)
    assert error.value.state is scene


def test_queries_that_need_a_boundary_go_on(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise AssertionError("asked for an estimate")

    monkeypatch.setattr(driver, "refuse_laborious", refuse)
    scene = Scene(star(3), [star(3, x=12)])
    assert len(cfree.plan_many(scene, [((-9, 0, 0), (25, 0, 0))])) == 1
    assert isinstance(cfree.boundary(scene, max_seconds=math.inf), Boundary)
