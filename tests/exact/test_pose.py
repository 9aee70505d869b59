import cmath
import math
import random
from collections.abc import Iterator
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cfree import _core
from cfree.errors import InvalidPoseError
from cfree.exact.half_angle import chart_of, half_angle_rotation, normalize_angles, place_of, read_radians, theta_of
from cfree.exact.pose import Pose, Poses

numbers = st.fractions(-9, 9, max_denominator=12)
taus = st.none() | st.fractions(-5, 5, max_denominator=9)
angles = taus.map(lambda tau: {"tau": "inf" if tau is None else tau})
poses = st.builds(Pose, numbers, numbers, angles)
radians = st.floats(-1e9, 1e9) | st.floats(-7, 7)
QUARTERS = [(0, Fraction(0)), (1, Fraction(1)), (2, None), (3, Fraction(-1))]


def arctan(tau: Fraction) -> Fraction:
    """Arc tangent to 2^-150, by the series after three halvings: tan(x/2) = t / (1 + sqrt(1 + t^2))."""
    t, unit = tau, 1 << 200
    for _ in range(3):
        square = 1 + t * t
        t /= 1 + Fraction(math.isqrt(square.numerator * unit * unit // square.denominator), unit)
        t = Fraction(round(t * unit), unit)
    return 8 * sum((-1) ** k * t ** (2 * k + 1) / (2 * k + 1) for k in range(60))


PI = 16 * arctan(Fraction(1, 5)) - 4 * arctan(Fraction(1, 239))


# examples


def test_a_pose_turns_and_then_moves() -> None:
    q = Pose(1, 2, "90deg")
    assert q.apply_exact([(3, 0), (0, Fraction(1, 3))]) == ((1, 5), (Fraction(2, 3), 2))
    np.testing.assert_array_equal(q.apply([[3, 0], [0, 1]]), [[1, 5], [0, 2]])
    np.testing.assert_array_equal(q.apply([3, 0]), [1, 5])


@pytest.mark.parametrize(("quarter", "tau"), QUARTERS)
@pytest.mark.parametrize("turns", [0, 1, -3, 1000])
def test_multiples_of_a_right_angle_are_exact(quarter: int, tau: Fraction | None, turns: int) -> None:
    theta = (quarter + 4 * turns) * math.pi / 2
    for given_theta in (theta, f"{(quarter + 4 * turns) * 90}deg", np.float64(theta), repr(theta)):
        q = Pose(0, 0, given_theta)
        assert (q.tau, q.theta, q.theta_error) == (tau, quarter * math.pi / 2, 0.0)
    if theta:
        ulp = math.ulp(theta)
        assert Pose(0, 0, theta + 3 * ulp).tau != tau != Pose(0, 0, theta - 3 * ulp).tau


def test_an_angle_of_a_pythagorean_triangle_is_recognised() -> None:
    assert Pose(0, 0, math.atan2(4, 3)).cos == Fraction(3, 5)
    assert Pose(0, 0, math.atan2(-12, -5)).sin == Fraction(-12, 13)


def test_a_half_angle_tangent_is_kept_and_its_angle_given() -> None:
    assert Pose(0, 0, {"tau": "2/6"}).tau == Fraction(1, 3)
    assert math.isclose(Pose(0, 0, {"tau": -3}).theta, 2 * math.pi - 2 * math.atan(3), rel_tol=1e-15)
    for half_turn in ("inf", "1/0", math.inf, None):
        assert Pose(0, 0, {"tau": half_turn}).tau is None
        assert Pose(0, 0, {"tau": half_turn}).theta == math.pi
    assert Pose(0, 0, {"tau": "1e-900"}).theta == 0.0
    assert Pose(0, 0, {"tau": "-1e900"}).theta == math.pi


def test_degrees_are_degrees() -> None:
    for degrees in range(-720, 1000, 7):
        assert math.isclose(math.cos(Pose(0, 0, f"{degrees}deg").theta), math.cos(math.radians(degrees)), abs_tol=3e-15)
    assert Pose(0, 0, "1e300deg").theta_error < 1e-15


def radians_of_all_kinds(count: int, seed: int) -> Iterator[float]:
    """Multiples of a right angle and their neighbours, huge, tiny, subnormal, negative and ordinary angles."""
    rng = random.Random(seed)
    ends = (0.0, -0.0, math.tau, -math.tau, math.nextafter(math.tau, 0), 2.0**63, math.nextafter(2.0**63, 0), 1e308)
    for k in range(count):
        multiple = rng.randint(-400, 400) * math.pi / rng.choice((1, 2, 3, 4, 6))
        for _ in range(rng.randint(0, 4)):
            multiple = math.nextafter(multiple, rng.choice((-1, 1)) * math.inf)
        yield (
            multiple,
            rng.uniform(-10, 10),
            rng.randint(-(10**9), 10**9) * math.pi / 2,
            math.ldexp(rng.uniform(-1, 1), rng.randint(-1074, 1023)),
            math.ldexp(rng.uniform(-1, 1), rng.randint(-70, 70)),
            rng.randint(-9, 9) * 5e-324,
            math.radians(rng.randint(-720, 720)),
            2 * math.atan(rng.randint(-99, 99) / rng.randint(1, 99)),
            float(rng.randint(-(10**6), 10**6)),
            rng.choice(ends) * rng.choice((1, -1)),
        )[k % 10]


@pytest.mark.parametrize("count", [2_000, pytest.param(100_000, marks=[pytest.mark.slow, pytest.mark.long])])
def test_the_core_reads_radians_as_python_does(count: int) -> None:
    """The half-angle tangent, the angle and its error, bit for bit."""
    for theta in radians_of_all_kinds(count, seed=count):
        tau, angle, error = read_radians(Fraction(theta))
        found = _core.read_radians(theta)
        if found is None:
            assert abs(theta) >= 2.0**63
        else:
            assert found[:2] == ((1, 0) if tau is None else (tau.numerator, tau.denominator)), theta
            assert list(map(float.hex, found[2:])) == list(map(float.hex, (angle, error))), theta
        assert (Pose(0, 0, theta).tau, Pose(0, 0, theta).theta) == (tau, angle)
    assert _core.read_radians(math.nan) is None and _core.read_radians(-math.inf) is None


def test_angles_are_the_same_as_integers_and_as_doubles() -> None:
    for theta in (0, 1, -3, 355, 2**53, -(2**53), 2**53 + 1, 10**30):
        q, exact = Pose(0, 0, theta), read_radians(Fraction(theta))
        assert (q.tau, q.theta, q.theta_error) == exact
    with pytest.raises(InvalidPoseError, match="theta: True is a truth value"):
        Pose(0, 0, True)


@pytest.mark.parametrize(
    ("x", "theta", "said"),
    [
        (math.nan, 0, "x: nan is not finite"),
        ("a", 0, "x: 'a' is no number"),
        (0, math.inf, "theta: inf is not finite"),
        (0, "ninety deg", "theta: 'ninety ' is no number"),
        (0, {"tau": "1/3", "chart": 0}, "is no angle"),
        (0, {}, "is no angle"),
        (0, {"tau": math.nan}, "tau: nan is not finite"),
        (0, "1e4000", "digits"),
        (0, "1e3000", "too large"),
        (0, None, "theta: None is no number"),
    ],
)
def test_what_is_no_pose_is_refused_with_its_place(x: object, theta: object, said: str) -> None:
    with pytest.raises(InvalidPoseError, match=said):
        Pose(x, 0, theta)  # type: ignore[arg-type]


# properties


@pytest.mark.slow
@given(radians)
def test_the_replaced_angle_is_within_the_stated_error(theta: float) -> None:
    q = Pose(0, 0, theta)
    chart, tau = q.chart
    turn = (Fraction(theta) - 2 * arctan(tau) - chart * PI) / (2 * PI)
    error = abs(turn - round(turn)) * 2 * PI
    snapped = q.tau in (None, 0, 1, -1)
    assert error <= (Fraction(math.ulp(theta)) if snapped else Fraction(q.theta_error)) + Fraction(1, 2**90)
    assert q.theta_error <= 2**-50
    assert 0 <= q.theta < 2 * math.pi


@given(st.floats(0, 6.28))
def test_an_angle_within_a_turn_is_kept_as_given(theta: float) -> None:
    assert Pose(0, 0, theta).theta == theta or Pose(0, 0, theta).tau in (None, 0, 1, -1)


def test_replaced_angles_have_short_rationals() -> None:
    angles = np.random.default_rng(1).uniform(0, 2 * math.pi, 500)
    sizes = [Pose(0, 0, theta).chart[1].denominator.bit_length() for theta in angles]
    assert np.median(sizes) <= 28
    assert max(sizes) <= 53


@given(poses, st.tuples(numbers, numbers))
def test_a_vertex_is_turned_by_theta_and_then_moved_by_r(q: Pose, a: tuple[Fraction, Fraction]) -> None:
    """Eq. (3) in complex numbers, without tau."""
    turned = cmath.exp(1j * q.theta) * complex(*a) + complex(q.x, q.y)
    (exact,), rounded = q.apply_exact([a]), q.apply([float(c) for c in a])
    assert abs(complex(*exact) - turned) < 1e-12 and abs(complex(*rounded) - turned) < 1e-12


@given(st.fractions(-50, 50, max_denominator=30))
def test_the_rational_rotation_is_the_papers_m_tau(tau: Fraction) -> None:
    c, s, w = half_angle_rotation(tau)
    assert Fraction(c, w) == (1 - tau**2) / (1 + tau**2) and Fraction(s, w) == 2 * tau / (1 + tau**2)
    theta = 2 * math.atan(tau)
    assert math.isclose(c / w, math.cos(theta), abs_tol=1e-14) and math.isclose(s / w, math.sin(theta), abs_tol=1e-14)
    # M^inf = R^pi, which is the limit on both sides
    c, s, w = half_angle_rotation(None)
    assert (c, s, w) == (-1, 0, 1)
    for far in (10**9, -(10**9)):
        near = half_angle_rotation(Fraction(far))
        assert abs(near[0] / near[2] - c) < 1e-8 and abs(near[1] / near[2] - s) < 1e-8


@given(poses)
def test_a_rotation_has_determinant_one(q: Pose) -> None:
    assert q.cos**2 + q.sin**2 == 1
    assert math.isclose(float(q.cos), math.cos(q.theta), abs_tol=1e-15)
    assert math.isclose(float(q.sin), math.sin(q.theta), abs_tol=1e-15)


@pytest.mark.slow
@given(poses, poses, poses)
def test_poses_form_a_group(p: Pose, q: Pose, r: Pose) -> None:
    assert (p @ q) @ r == p @ (q @ r)
    assert p @ p.inverse() == Pose(0, 0) == p.inverse() @ p
    assert (p @ q).inverse() == q.inverse() @ p.inverse()
    assert hash(p @ Pose(0, 0)) == hash(p)


@pytest.mark.slow
@given(poses, poses, st.lists(st.tuples(numbers, numbers), max_size=4))
def test_composition_is_application_twice(p: Pose, q: Pose, points: list[tuple[Fraction, Fraction]]) -> None:
    assert (p @ q).apply_exact(points) == p.apply_exact(q.apply_exact(points))


@given(poses)
def test_charts_tile_the_circle(q: Pose) -> None:
    chart, tau = q.chart
    assert -1 <= tau <= 1
    back = Pose(0, 0, {"tau": "inf"} if chart else 0) @ Pose(q.x, q.y, {"tau": tau})
    assert back.tau == q.tau
    if abs(tau) < 1:
        float_chart, float_tau = chart_of(q.theta)
        assert float_chart == chart
        assert math.isclose(float_tau, tau, abs_tol=1e-14)


@given(radians)
def test_the_place_of_an_angle_is_that_of_its_pose(theta: float) -> None:
    q = Pose(0, 0, theta)
    angle, chart, tau = place_of(theta)
    assert angle == q.theta
    if abs(q.chart[1]) < 1 - 1e-15:  # two names of one angle
        assert chart == q.chart[0]
        assert math.isclose(tau, q.chart[1], abs_tol=1e-15)
    else:
        assert math.isclose(abs(tau), 1)


@given(st.lists(st.floats(0, 6.283), min_size=1, max_size=9))
def test_charts_in_doubles_give_the_angle_back(theta: list[float]) -> None:
    chart, tau = chart_of(theta)
    assert np.all(np.abs(tau) <= 1)
    difference = theta_of(chart, tau) - np.array(theta)
    assert np.all(np.abs(np.remainder(difference + np.pi, 2 * np.pi) - np.pi) < 4e-15)


@given(st.lists(st.tuples(st.floats(-9, 9), st.floats(-9, 9), radians), min_size=1, max_size=5))
def test_arrays_of_poses_agree_with_single_ones(rows: list[tuple[float, float, float]]) -> None:
    table = np.array(rows)
    many = Poses(table[:, :2], table[:, 2])
    points = np.array([[1.0, 2.0], [-3.0, 0.5]])
    twice = many @ many.inverse()
    for k, q in enumerate(many):
        np.testing.assert_allclose(many.apply(points)[k], q.apply(points), atol=1e-12)
        np.testing.assert_allclose((many @ many).apply(points)[k], (q @ q).apply(points), atol=1e-11)
        np.testing.assert_allclose(many.inverse().apply(points)[k], q.inverse().apply(points), atol=1e-11)
        np.testing.assert_allclose(twice.apply(points)[k], points, atol=1e-11)
    assert list(Poses.from_poses(many)) == list(many)


# degenerate


def test_charts_meet_at_right_angles_with_exact_ends() -> None:
    chart, tau = chart_of([math.pi / 2, math.pi, 3 * math.pi / 2, -math.pi / 2, 0, 2 * math.pi, -1e-300])
    np.testing.assert_array_equal(chart, [0, 1, 0, 0, 0, 0, 0])
    np.testing.assert_array_equal(tau, [1, 0, -1, -1, 0, 0, 0])
    np.testing.assert_array_equal(theta_of([1, 1], [1, -1]), [3 * math.pi / 2, math.pi / 2])


def test_normalised_angles_stay_below_a_turn() -> None:
    assert normalize_angles(-1e-300) == 0.0
    assert Pose(0, 0, -1e-300).theta == 0.0
    assert Pose(0, 0, -1e-300).tau < 0  # type: ignore[operator]


def test_huge_angles_are_reduced_by_the_true_pi() -> None:
    q = Pose(0, 0, 1e15)
    assert math.isclose(float(q.sin), math.sin(1e15), abs_tol=1e-15)  # libm reduces exactly too
    assert math.isclose(float(q.cos), math.cos(1e15), abs_tol=1e-15)


def test_right_angles_are_exact_in_arrays() -> None:
    turned = Poses(np.zeros((5, 2)), np.arange(5) * math.pi / 2).apply([[1.0, 0.0]])[:, 0]
    np.testing.assert_array_equal(turned, [[1, 0], [0, 1], [-1, 0], [0, -1], [1, 0]])


def test_shapes_and_values_of_arrays_are_checked() -> None:
    with pytest.raises(InvalidPoseError, match=r"give \(n, 2\) and \(n,\)"):
        Poses([[0, 0]], [0, 1])
    with pytest.raises(InvalidPoseError, match=r"pose 1: .*is not finite"):
        Poses([[0, 0], [0, math.nan]], [0, 1])
    with pytest.raises(ValueError, match="read-only"):
        Poses([[0, 0]], [0]).xy[0, 0] = 1
    assert len(Poses(np.empty((0, 2)), [])) == 0


def test_poses_cannot_be_changed() -> None:
    with pytest.raises(AttributeError):
        Pose(0, 0).x = Fraction(1)  # type: ignore[misc]
