"""The scenes in `cases`: their counts, their slices, and the same scenes elsewhere."""

from fractions import Fraction
from functools import cache
from itertools import islice

import pytest

from cfree import Boundary, UnsupportedError, boundary, load_scene
from compared import mistakes, plain_of, scene_of
from compared_exactly import AFTER, BEFORE, differences, slice_segments
from expected import CASES, cases, half_tangent, slice_facts, topology
from shapes import PlainScene
from variants import variants

NAMES = [str(path.relative_to(CASES).with_suffix("")) for path in cases()]
GENERIC = [Fraction(577_215, 1_000_003), Fraction(-1_618_033, 1_000_003)]  # critical in none of them
HAIRS = ("hair", "1e-", "near", "sliver", "needle", "mixed", "miss")  # too fine for doubles


@cache
def case(name: str) -> tuple[PlainScene, Boundary]:
    scene = load_scene(CASES / f"{name}.json")
    return plain_of(scene), boundary(scene, threads=1)


def angles(name: str) -> list[str]:
    return [at["tau"] for at in case(name)[1].scene.check["slices"]]


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_cases_have_the_counts_they_say(name: str) -> None:
    plain, result = case(name)
    slices = [slice_facts(plain, tau) for tau in angles(name)]
    assert result.scene.check == {**topology(result), "live_patches": result.stats.live_patches, "slices": slices}


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_slices_of_cases_are_exact(name: str) -> None:
    plain, result = case(name)
    taus = [*GENERIC, *map(half_tangent, angles(name))]
    assert not [line for tau in taus for line in differences(result, tau, plain)]


@pytest.mark.parametrize("name", [name for name in NAMES if not any(hair in name for hair in HAIRS)])
def test_slices_of_cases_are_those_of_shapely(name: str) -> None:
    plain, result = case(name)
    assert not [line for k in range(6) for line in mistakes(plain, result, 0.15 + k)]


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_cases_elsewhere_have_the_same_topology(name: str) -> None:
    """Each in a third of the variants, those that its turn brings."""
    plain, result = case(name)
    for variant in islice(variants(plain), NAMES.index(name) % 3, None, 3):
        try:
            other = boundary(scene_of(variant.plain), threads=1)
        except UnsupportedError:  # the scene is close to the largest there is
            assert name == "beyond_doubles"
            continue
        assert topology(other) == topology(result), variant.name
        if variant.same_axes:
            assert other.stats.live_patches == result.stats.live_patches, variant.name
            assert other.stats.trapezoids == result.stats.trapezoids, variant.name
        for tau in [*map(half_tangent, angles(name)), GENERIC[0]]:
            there = slice_segments(other, variant.half_tangent(tau), BEFORE if variant.mirrored else AFTER)
            assert there == variant.image(slice_segments(result, tau)), (variant.name, tau)
