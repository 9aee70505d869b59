"""Slides: consistent, exact, and judged free alike by the core, by `verify`, and pose by pose."""

from __future__ import annotations

import copy
import json
import math
import random
from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations, pairwise
from pathlib import Path as FilePath
from typing import Any

import numpy as np
import pytest
import yaml
from flint import fmpz_poly
from hypothesis import given, settings
from hypothesis import strategies as st

import cfree._core as _core
import cfree.verify
import strategies
from cfree import FormatError, MotionChecker, Path, Pose, PoseChecker, Rotation, Scene, Slide, clearance, is_free, save
from cfree.cli.report import Shapes, answer_facts
from cfree.collision import Touch
from cfree.errors import InvalidPoseError, UnsupportedError
from cfree.formats.answers.answer_file import load_answer as load
from cfree.paths.clearance import narrowest
from cfree.planning.core_ways import numbers_of, slide_of
from cfree.scene.features import SceneFeatures
from cfree.verify.course import Course, place_of
from cfree.verify.motions import CONTINUOUS, ENDS, FREE, KEPT
from cfree.verify.positivity import is_nowhere_positive, positive
from compared import scene_of
from moving import CORRIDORS, CURVE, ON_CORNER, ON_FLOOR, SQUARE, TEE, box, poses, turning, way
from shapes import PlainScene

F = Fraction
START = Pose(0, 1)


small, shares = st.fractions(-3, 3, max_denominator=4), st.fractions(0, 1, max_denominator=9)
quarters = st.fractions("-1/4", "1/4", max_denominator=8)
curves = st.builds(
    lambda x, y, d, tau: Slide((ON_FLOOR, ON_CORNER), [0, *x], [0, *y], [1, *d], tau),
    *[st.lists(small, max_size=4)] * 2,
    st.lists(quarters, max_size=4),
    st.fractions("-8/9", "8/9", max_denominator=9).filter(bool),
)


def contact_line(features: SceneFeatures, contact: tuple[int, int, int], tau: Fraction | None) -> tuple[Any, Any]:
    """P and U: the reference point is on the line P + s U where two features touch, at an orientation."""
    kind, i, j = contact
    A, O, turn = features.robot, features.obstacles, Pose(0, 0, {"tau": tau})

    def vertex(shape: Any, k: int) -> Any:
        return tuple(F(c, features.scale) for c in shape.vertices[k])

    a = vertex(A, i)
    P = minus(vertex(O, j), *turn.apply_exact([a]))
    if kind == 1:
        return P, minus(vertex(O, O.w[j]), vertex(O, j))
    return P, minus(*turn.apply_exact([a, vertex(A, A.w[i])]))


def minus(u: Any, v: Any) -> tuple[Fraction, Fraction]:
    return u[0] - v[0], u[1] - v[1]


def cross(u: Any, v: Any) -> Fraction:
    return u[0] * v[1] - u[1] * v[0]


def slide_along(features: SceneFeatures, pose: Pose, first: Any, last: Any, tau: Fraction) -> Slide | None:
    """Along two contacts that a pose is in, as the core has it; it need not be free."""
    found = _core.slide_along(features.core, numbers_of(pose), first, last, tau.denominator, tau.numerator)
    return slide_of(found[2:], features) if found else None


def contact_slides(scene: Scene, rng: random.Random, count: int) -> Iterator[tuple[Pose, Slide]]:
    """From poses at which the lines of two contacts meet, degenerate ones among them."""
    features: SceneFeatures = MotionChecker(scene).features
    n, m = len(features.robot.previous), len(features.obstacles.previous)
    for _ in range(count):
        first, last = ((rng.choice((1, 2)), rng.randrange(n), rng.randrange(m)) for _ in "ab")
        turned = rng.choice([F(0), F(1), F(rng.randrange(-8, 9), rng.randrange(1, 9)), None])
        (P, U), (Q, V) = (contact_line(features, contact, turned) for contact in (first, last))
        if (across := cross(U, V)) == 0:
            continue
        s = cross(minus(Q, P), V) / across
        pose = Pose(P[0] + s * U[0], P[1] + s * U[1], {"tau": turned})
        tau = F(rng.choice((-1, 1)), rng.choice((1, 2, 8, 64, 1024)))
        if (slide := slide_along(features, pose, first, last, tau)) is not None:
            yield pose, slide


def verdicts(scene: Scene, pose: Pose, slide: Slide) -> tuple[bool, bool]:
    """Is it free, by the core and by `verify`? What is forbidden there is so for exact poses."""
    by_core = MotionChecker(scene).is_free(pose, slide)
    findings = cfree.verify.answer(scene, Path(pose, [slide])).findings
    for finding in findings:
        if finding.kind == FREE:
            assert not is_free(scene, slide.at(pose, finding.text.split("u = ")[1].split(",")[0]))
    return by_core, not {finding.kind for finding in findings} & {FREE, ENDS}


# --- what a slide is ---


@pytest.mark.slow
@settings(max_examples=150, deadline=None)
@given(curves, poses, shares, shares, shares)
def test_parts_are_where_the_whole_is(slide: Slide, pose: Pose, u: Fraction, v: Fraction, w: Fraction) -> None:
    assert slide.at(pose, 0) == pose and slide.at(pose, 1) == slide.apply(pose)
    assert slide.reversed().apply(slide.apply(pose)) == pose
    assert slide.reversed().reversed() == slide
    assert slide.until(u).apply(pose) == slide.at(pose, u)
    part = slide.between(u, v)
    assert part.apply(slide.at(pose, u)) == slide.at(pose, v)
    place = part.at(slide.at(pose, u), w)
    turned = (Pose(0, 0, {"tau": place.tau}) @ Pose(0, 0, {"tau": pose.tau}).inverse()).tau
    assert turned is not None
    x, y = slide.moved(turned)  # by as much as it has turned
    assert place == Pose(pose.x + x, pose.y + y, {"tau": place.tau})


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(curves, poses)
def test_samples_length_and_reach(slide: Slide, pose: Pose) -> None:
    s = np.linspace(0, 1, 2001)
    samples = slide.sample(pose, s)
    for k in range(0, 2001, 500):
        exact = slide.at(pose, F(math.tan(s[k] * slide.turn / 2)) / slide.tau)
        assert np.allclose(samples.xy[k], [float(exact.x), float(exact.y)], atol=1e-9)
        assert math.remainder(samples.theta[k] - exact.theta, math.tau) == pytest.approx(0, abs=1e-9)
    steps = np.hypot(*np.diff(samples.xy, axis=0).T)
    assert steps.sum() == pytest.approx(slide.length(pose), rel=1e-3, abs=1e-9)
    corners = samples.apply(np.array([[2.0, 1.0], [-1.0, -2.0]]))
    fastest = np.linalg.norm(np.diff(corners, axis=0), axis=2).max() * 2000
    assert fastest <= slide.reach(pose, [(2, 1), (-1, -2)]) * (1 + 1e-9)


@pytest.mark.parametrize(
    ("x", "y", "d", "tau", "message"),
    [
        ([1], [0], [1], 1, "x begins with 1, y with 0; both have to begin with 0"),
        ([0], [0] * 5 + [1], [1], 1, "y has degree 5; give at most 4"),
        ([0], [0], [1, -1], 1, "d may be zero for t between 0 and 1; end before"),
        ([0], [0], [0, 1], 1, "d may be zero"),
        ([0], [0], [], 1, "d may be zero|both have to begin"),
        ([0, "x"], [0], [1], 1, "x: 'x' is no number"),
    ],
)
def test_what_is_no_slide_is_refused(x: list, y: list, d: list, tau: int, message: str) -> None:
    with pytest.raises(InvalidPoseError, match=message):
        Slide((ON_FLOOR, ON_CORNER), x, y, d, tau)


def test_huge_turns_have_an_angle() -> None:
    assert Slide((ON_FLOOR, ON_CORNER), [0], [0], [1], "1e400").turn == math.pi


# --- is it free? ---


@pytest.mark.parametrize("tau", ["1/16", "1/2", 1])
def test_a_square_turns_in_corridors_as_wide_as_it(tau: object) -> None:
    assert verdicts(TEE, START, turning(tau)) == (True, True)
    assert cfree.verify.answer(TEE, Path(START, [turning(tau)])).verified
    assert verdicts(TEE, START, Slide((ON_FLOOR, ON_CORNER), *CURVE, f"-{tau}")) == (False, False)
    x, y, d = ([*terms, *[0] * 5][:5] for terms in CURVE)
    for terms in (x, y, d):
        for k in range(1, 5):
            terms[k] += F(1, 10**30)
            above = verdicts(TEE, START, Slide((ON_FLOOR, ON_CORNER), x, y, d, tau))  # type: ignore[arg-type]
            terms[k] -= F(2, 10**30)
            below = verdicts(TEE, START, Slide((ON_FLOOR, ON_CORNER), x, y, d, tau))  # type: ignore[arg-type]
            terms[k] += F(1, 10**30)
            assert above[0] == above[1] and below[0] == below[1] and False in (*above, *below)


@pytest.mark.slow
@settings(max_examples=100, deadline=None)
@given(strategies.scenes(), poses, curves)
def test_slides_are_free_where_all_their_poses_are(plain: PlainScene, pose: Pose, slide: Slide) -> None:
    scene = scene_of(plain)
    by_core, by_verify = verdicts(scene, pose, slide)
    assert by_core == by_verify
    if by_core:
        checker = PoseChecker(scene)
        assert all(checker.is_free(slide.at(pose, F(k, 60))) for k in range(61))
    assert MotionChecker(scene).is_free(slide.apply(pose), slide.reversed()) == by_core


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(strategies.scenes(), st.randoms(use_true_random=False))
def test_slides_along_contacts_are_free_where_all_their_poses_are(plain: PlainScene, rng: random.Random) -> None:
    scene = scene_of(plain)
    checker = PoseChecker(scene)
    for pose, slide in contact_slides(scene, rng, 4):
        by_core, by_verify = verdicts(scene, pose, slide)
        assert by_core == by_verify
        if by_core:
            assert all(checker.is_free(slide.at(pose, F(k, 20))) for k in range(21))


@pytest.mark.slow
def test_slides_along_contacts_in_corridors() -> None:
    """Both answers are met, and contacts are kept."""
    features, found = MotionChecker(TEE).features, []
    every = [(kind, i, j) for kind in (1, 2) for i in range(4) for j in range(len(features.obstacles.previous))]
    for u in (0, F(1, 2), F(5, 7), 1):
        pose = turning().at(START, u)
        lines = [(c, *contact_line(features, c, pose.tau)) for c in every]
        touching = [c for c, P, U in lines if cross(U, minus((pose.x, pose.y), P)) == 0]
        for tau in (F(1, 16), F(-1, 16), F(-3, 4)):
            for first, last in combinations(touching, 2):
                if (slide := slide_along(features, pose, first, last, tau)) is None:
                    continue
                by_core, by_verify = verdicts(TEE, pose, slide)
                assert by_core == by_verify
                found.append(by_core)
                kinds = {finding.kind for finding in cfree.verify.answer(TEE, Path(pose, [slide])).findings}
                assert not kinds & {CONTINUOUS, KEPT}
    assert found.count(True) > 20 and found.count(False) > 50


def test_a_slide_has_no_first_contact() -> None:
    with pytest.raises(UnsupportedError, match="call is_free for parts"):
        MotionChecker(TEE).first_contact(START, turning())  # type: ignore[arg-type]


# --- what verify says ---


@settings(max_examples=200, deadline=None)
@given(st.lists(st.integers(-9, 9), min_size=1, max_size=7))
def test_polynomials_are_nowhere_positive(terms: list[int]) -> None:
    last = len(terms) - 1  # values times 500^last
    values = [sum(c * k**n * 500 ** (last - n) for n, c in enumerate(terms)) for k in range(501)]
    found = positive(tuple(terms))
    assert (found is not None) >= (max(values) > 0)
    if found is not None:
        assert 0 < found < 1 and sum(c * found**n for n, c in enumerate(terms)) > 0
    if is_nowhere_positive(tuple(terms), (1, 3, 4)):
        assert max(values[125:376]) <= 0
    square = tuple(-int(c) for c in (fmpz_poly(terms) ** 2).coeffs()) or (0,)
    assert positive(square) is None


@pytest.mark.slow
@settings(max_examples=80, deadline=None)
@given(curves, poses, st.integers(0, 7))
def test_boxes_hold_the_sweep(slide: Slide, pose: Pose, k: int) -> None:
    course, ring = Course(place_of(pose, 6), slide, 6), [(12, 0), (-6, 6), (-6, -12)]
    assert course.is_defined and course.at(F(0)) == place_of(pose, 6)
    assert course.at(F(1)) == place_of(slide.apply(pose), 6)
    lo_x, lo_y, hi_x, hi_y = course.box(ring, (k, k + 1, 8), 100)
    for u in (F(8 * k + j, 64) for j in range(9)):
        for x, y in slide.at(pose, u).apply_exact([(2, 0), (-1, 1), (-1, -2)]):
            assert lo_x <= x * 6 / 100 <= hi_x and lo_y <= y * 6 / 100 <= hi_y


def forged(**changes: object) -> Slide:
    """A slide that its constructor would refuse."""
    slide = copy.copy(turning("1/2"))
    for name, value in changes.items():
        object.__setattr__(slide, name, value)
    return slide


def test_a_formula_that_makes_no_sense_is_found() -> None:
    zero = F(0)
    for bad in (
        forged(d=(F(1), F(-4), zero, zero, zero)),
        forged(d=(F(1), F(-2), zero, zero, zero)),  # zero at the end
        forged(d=(zero, F(1), zero, zero, zero)),
        forged(d=(F(-1), zero, F(-1), zero, zero)),
        forged(x=(F(1), zero, zero, zero, zero)),
    ):
        path = Path(START, [bad])
        object.__setattr__(path, "poses", (START, START))
        assert CONTINUOUS in {finding.kind for finding in cfree.verify.answer(TEE, path).findings}


@pytest.mark.parametrize(
    ("contact", "message"),
    [
        (Touch("vertex-edge", (0, 1), (-2, 1)), "the vertex is not on the edge's line"),
        (Touch("vertex-edge", (0, 0), (-2, 2)), "the vertex is not on the edge's line"),
        (Touch("edge-vertex", (0, 0), (-2, 1)), "a contact at a reflex vertex"),
        (Touch("edge-vertex", (0, 2), (-2, 3)), "the vertex is not on the edge's line"),
        (Touch("edge-vertex", (0, 3), (-2, 6)), "the vertex is not on the edge's line"),
        (Touch("vertex-edge", (0, 9), (-2, 1)), "there is no vertex 9 of polygon 0"),
        (Touch("vertex-edge", (0, 0), (3, 1)), "there is no vertex 1 of polygon 3"),
        (Touch("vertex-edge", (0, 0), (-1, 1)), "there is no vertex 1 of polygon -1"),
    ],
)
def test_a_contact_that_is_not_kept_is_found(contact: Touch, message: str) -> None:
    for contacts in ((contact, ON_CORNER), (ON_FLOOR, contact)):
        (finding,) = cfree.verify.answer(TEE, Path(START, [Slide(contacts, *CURVE, "1/2")])).findings
        assert finding.kind == KEPT and message in finding.text
    assert cfree.verify.answer(TEE, Path(START, [Slide((ON_CORNER, ON_FLOOR), *CURVE, "1/2")])).verified


def test_a_vertex_may_not_leave_its_edge() -> None:
    """A ladder with its feet on a floor and a wall that ends."""
    ladder = [(0, 0), (0, -5), (1, 0)]
    foot, head = Touch("vertex-edge", (0, 1), (0, 2)), Touch("vertex-edge", (0, 0), (1, 1))
    slip = Slide((foot, head), [0], [0, 0, -10], [1, 0, 1], "1/2")  # the foot comes to (4, 0), the head to (0, 3)
    for bottom, right, top, kept in ((0, 4, 5, True), (0, 3, 5, False), (3, 4, 5, True), (1, 9, 4, False)):
        scene = Scene(ladder, [box(0, -1, right, 0), box(-1, bottom, 0, top)])
        found = cfree.verify.answer(scene, Path(Pose(0, 5), [slip])).findings
        assert {finding.kind for finding in found} == (set() if kept else {KEPT}), (bottom, right, top)


def test_the_reference_point_may_slide_on_bounds() -> None:
    """Corners count clockwise from the lower left: edge 1 is the upper one, edge 3 the lower one."""
    scene = Scene(SQUARE, [box(-9, 1, 9, 2)], bounds=(-4, 0, 4, 9))
    on_bounds, on_ceiling = Touch("vertex-edge", (-1, 0), (-1, 3)), Touch("vertex-edge", (0, 2), (0, 0))
    rest = Slide((on_bounds, on_bounds), [0, 4], [0], [1, 0, 1], "-1/16")
    found = cfree.verify.answer(Scene(SQUARE, bounds=(-4, 0, 4, 9)), Path(Pose(0, 0), [rest]))
    assert found.verified, found.findings
    for contacts in ((on_bounds, on_ceiling), (Touch("vertex-edge", (-1, 0), (-1, 1)), on_bounds)):
        found = cfree.verify.answer(scene, Path(Pose(0, 0), [Slide(contacts, [0, 4], [0], [1, 0, 1], "-1/16")]))
        assert KEPT in {finding.kind for finding in found.findings}
    beyond = Slide((on_bounds, on_bounds), [0, 80], [0], [1, 0, 1], "1/16")
    assert {f.kind for f in cfree.verify.answer(scene, Path(Pose(0, 0), [beyond])).findings} >= {KEPT, FREE}


# --- files ---


@pytest.mark.slow
@settings(max_examples=100, deadline=None)
@given(st.lists(curves, max_size=3), poses)
def test_files_hold_slides_exactly(tmp_path_factory: pytest.TempPathFactory, moves: list[Slide], start: Pose) -> None:
    file, path = tmp_path_factory.mktemp("slides") / "way.json", Path(start, moves)
    save(path, file, scene=TEE)
    again = load(file)
    assert again == path and again.poses == path.poses


@pytest.mark.parametrize(
    ("place", "value", "message"),
    [
        ("exact", None, r'motions\[1\]: key "exact" is missing; add it'),
        ("exact.d", ["1", "-4"], r"motions\[1\]: d may be zero for t between 0 and 1/3; end before"),
        ("exact.d", [], r"motions\[1\]: d may be zero"),
        ("exact.x", ["1"], r"motions\[1\]: x begins with 1, y with 0; both have to begin with 0"),
        ("exact.x", ["0"] * 5 + ["1"], r"motions\[1\]: x has degree 5; give at most 4"),
        ("exact.y", "0", r'motions\[1\]\.exact\.y: expected a list, got "0"'),
        ("exact.y", ["0", "z"], r'motions\[1\]\.exact\.y\[1\]: expected a number or "p/q", got "z"'),
        ("exact.y", None, r'motions\[1\]\.exact: key "y" is missing'),
        ("exact.tau", "inf", r"motions\[1\]\.exact\.tau: Infinity is not finite; give a finite number"),
        ("exact.tau", "1/4", "the motions do not lead to the exact goal"),
        ("vector", [0.0, 0.4], r"motions\[1\].vector\[0\]: 0.0 beside the exact -0.1333\d* moves the robot by 0.133,"),
        ("vector", [1], r"motions\[1\]\.vector: expected a point \[x, y\], got \[ 1 \]"),
        ("angle", 0.6, r"motions\[1\].angle: 0.6 beside the exact 0.643\d* moves the robot by 0.087,"),
        ("angle", "x", r'motions\[1\]\.angle: expected radians or "90deg", got "x"'),
        ("contacts", [], r"motions\[1\]\.contacts: expected .*got \[\]"),
        ("contacts.0.kind", "edge-edge", r'motions\[1\]\.contacts\[0\]\.kind: expected "vertex-edge" or "edge-vertex"'),
        ("contacts.1.robot", [0], r"motions\[1\]\.contacts\[1\]\.robot: expected \[polygon, vertex\]"),
        ("contacts.1.robt", [0, 1], r'contacts\[1\]\.robt: unknown key "robt"; did you mean "robot"\?'),
        ("type", "glide", r'motions\[1\]: expected a motion with "type": "translation", "rotation" or "slide"'),
    ],
)
def test_faults_say_place_value_and_remedy(tmp_path: FilePath, place: str, value: Any, message: str) -> None:
    file = tmp_path / "way.json"
    save(way(), file, scene=TEE)
    data = json.loads(file.read_text())
    *outer, last = place.split(".")
    target: Any = data["motions"][1]
    for step in outer:
        target = target[int(step) if step.isdigit() else step]
    if value is None:
        del target[last]
    else:
        target[last] = value
    file.write_text(json.dumps(data, indent=1))
    with pytest.raises(FormatError, match=rf"way\.json:\d+:\d+ .*({message})"):
        load(file)


def test_the_example_of_the_format_page_is_a_slide(request: pytest.FixtureRequest, tmp_path: FilePath) -> None:
    page = (request.config.rootpath / "docs" / "answer-format.md").read_text()
    motion = page.split("**Slides.**")[1].split("```json\n")[1].split("```")[0]
    file = tmp_path / "way.json"
    save(Path(START, [turning("1/2")]), file, scene=TEE)
    written = file.read_text()
    assert '"decimals": "approximate"' in written  # they do not say where it goes
    file.write_text(written.split('"motions": [')[0] + f'"motions": [{motion}]}}')
    assert load(file) == Path(START, [turning("1/2")])
    (again,) = json.loads(written)["motions"]
    assert json.loads(motion) == again | {"exact": json.loads(motion)["exact"]}


@pytest.mark.slow
def test_a_path_with_slides_is_of_use_everywhere(tmp_path: FilePath) -> None:
    path = way()
    assert path.goal == Pose(0, 7, "90deg") and path.is_free(MotionChecker(TEE))
    assert path.turning == pytest.approx(math.pi / 2) and path.length > 11
    assert cfree.verify.answer(TEE, path).verified
    facts = answer_facts(path, Shapes(TEE, TEE, list))
    assert facts["slides"] == 2 and facts["translations"] == 2
    for form in ("csv", "yaml", "geojson"):
        save(path, tmp_path / f"way.{form}", step=0.1, scene=TEE)
    samples = path.sample(0.1)
    rows = [[*map(float, row.split(","))] for row in (tmp_path / "way.csv").read_text().splitlines()[1:]]
    assert np.allclose(rows, np.c_[samples.xy, samples.theta], rtol=0, atol=1e-15)
    assert (np.hypot(*np.diff(samples.xy, axis=0).T) <= 0.1 + 1e-9).mean() > 0.9  # even shares of angle, not of length
    assert len(yaml.safe_load((tmp_path / "way.yaml").read_text())["poses"]) == len(samples)
    trace, *outlines = json.loads((tmp_path / "way.geojson").read_text())["features"]
    assert len(outlines) == len(samples) and trace["properties"]["length"] == path.length
    inside = cfree.Polygon(CORRIDORS).to_shapely().buffer(1e-9)
    assert all(inside.contains(cfree.Polygon(f["geometry"]["coordinates"][0]).to_shapely()) for f in outlines)
    least = clearance(path, TEE)
    assert least is not None and least.least == 0
    assert len(narrowest(path, TEE, 2)) >= 1
    half = path.after(path.length / 2)
    assert isinstance(half, Pose) and all(map(is_free, [TEE] * 5, [path.at(F(k, 4) + 1) for k in range(5)]))
    for a, b in pairwise(path.poses):
        assert a != b
    assert Rotation((0, 0), "90deg").turn == pytest.approx(path.turning)
