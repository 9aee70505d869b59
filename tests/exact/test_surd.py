"""Numbers with one square root, against decimals of 120 digits and the equations they solve."""

from __future__ import annotations

import math
from decimal import Decimal, localcontext
from fractions import Fraction

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import strategies
from cfree.exact.half_angle import half_angle_rotation
from cfree.exact.orientation import Order, Orientation, turn
from cfree.exact.surd import ExactAngle, Surd

rationals = strategies.fractions()
radicands = st.integers(0, 60) | st.integers(0, 10**30)
surds = st.builds(Surd, rationals, rationals, radicands)
coordinates = st.integers(-9, 9) | st.integers(-(10**20), 10**20)
angles = st.tuples(coordinates, coordinates).filter(any).map(lambda v: ExactAngle(*v))


def decimal(x: Surd) -> Decimal:
    with localcontext() as context:
        context.prec = 120
        p, q = (Decimal(y.numerator) / y.denominator for y in (x.p, x.q))
        return p + q * Decimal(x.n).sqrt()


def polynomial_at(x: Surd, coefficients: tuple[int, ...]) -> tuple[Fraction, Fraction]:
    """Rational part and factor of the root of a polynomial's value, lowest coefficient first."""
    value = power = (Fraction(0), Fraction(0))
    power = (Fraction(1), Fraction(0))
    for c in coefficients:
        value = value[0] + c * power[0], value[1] + c * power[1]
        power = power[0] * x.p + power[1] * x.q * x.n, power[0] * x.q + power[1] * x.p
    return value


# numbers


@given(surds, rationals)
def test_order_is_that_of_many_digits(x: Surd, y: Fraction) -> None:
    with localcontext() as context:
        context.prec = 120
        difference = decimal(x) - Decimal(y.numerator) / y.denominator
    if x.q == 0 and x.p == y:
        assert x.compare(y) is Order.SAME
    else:
        assert x.compare(y) is (Order.BEFORE if difference < 0 else Order.AFTER)


@pytest.mark.parametrize("k", range(1, 40))
def test_convergents_of_the_root_of_two_are_on_alternate_sides(k: int) -> None:
    p, q = 1, 1
    for _ in range(k):
        p, q = p + 2 * q, p + q
    assert Surd(0, 1, 2).compare(Fraction(p, q)) is (Order.BEFORE if k % 2 else Order.AFTER)
    assert Surd(0, -1, 2).compare(Fraction(-p, q)) is (Order.AFTER if k % 2 else Order.BEFORE)


@given(rationals, rationals, st.integers(0, 10**6))
def test_roots_of_squares_are_rational(p: Fraction, q: Fraction, root: int) -> None:
    assert Surd(p, q, root * root) == Surd(p + q * root)
    assert Surd(p, q, root * root).q == 0


@given(rationals, rationals, st.integers(0, 60), st.integers(1, 9))
def test_equality_is_that_of_numbers(p: Fraction, q: Fraction, n: int, k: int) -> None:
    written, otherwise = Surd(p, q * k, n), Surd(p, q, n * k * k)
    assert written == otherwise and hash(written) == hash(otherwise)
    assert (Surd(p, q, n) == Surd(p, -q, n)) is (q == 0 or n == 0)
    assert Surd(p, q, n) != "p + q sqrt(n)"


@given(surds, st.integers(0, 200))
def test_neighbours_enclose_tightly(x: Surd, bits: int) -> None:
    low, high = x.neighbours(bits)
    if x.q == 0:
        assert low == high == x.p
    else:
        assert high - low == Fraction(1, 2**bits) and (low * 2**bits).denominator == 1
        assert (x.compare(low), x.compare(high)) == (Order.AFTER, Order.BEFORE)


@given(surds)
def test_float_is_the_nearest_double(x: Surd) -> None:
    nearest = float(x)
    assert nearest == float(decimal(x))
    up, down = (Fraction(math.nextafter(nearest, d)) for d in (math.inf, -math.inf))
    assert x.compare((up + Fraction(nearest)) / 2) is not Order.AFTER
    assert x.compare((down + Fraction(nearest)) / 2) is not Order.BEFORE


def test_float_keeps_its_digits_where_the_terms_cancel() -> None:
    n = 10**40 + 1  # 10^20 - sqrt(n) is about -1 / (2 * 10^20)
    assert float(Surd(10**20, -1, n)) == -5e-21


@pytest.mark.parametrize(
    ("x", "text"),
    [
        (Surd("1/2"), "1/2"),
        (Surd(0, 1, 2), "sqrt(2)"),
        (Surd(0, -1, 2), "- sqrt(2)"),
        (Surd(-3, "-2/3", 5), "-3 - 2/3 sqrt(5)"),
        (Surd(1, 2, 3), "1 + 2 sqrt(3)"),
    ],
)
def test_surds_are_written_as_one_reads_them(x: Surd, text: str) -> None:
    assert str(x) == text


@pytest.mark.parametrize("bad", [math.nan, math.inf, "pi", None, True])
def test_what_is_no_number_is_refused(bad: object) -> None:
    with pytest.raises((TypeError, ValueError), match=r"give|write it like"):
        Surd(bad)  # type: ignore[arg-type]
    with pytest.raises((TypeError, ValueError), match=r"give|write it like"):
        Surd(0, 1, 2).compare(bad)  # type: ignore[arg-type]


def test_a_negative_number_has_no_root() -> None:
    with pytest.raises(ValueError, match="nonnegative"):
        Surd(0, 1, -2)


# angles


@given(angles, st.integers(1, 10**9))
def test_angles_are_equal_whatever_the_length(phi: ExactAngle, k: int) -> None:
    assert ExactAngle(k * phi.c, k * phi.s) == phi
    assert ExactAngle(-phi.c, -phi.s) != phi


@given(angles)
def test_cosine_and_sine_are_those_of_the_half_angle_tangent(phi: ExactAngle) -> None:
    c, s, n = phi.c, phi.s, phi.n
    assert (phi.cos.p, phi.sin.p) == (0, 0) or math.isqrt(n) ** 2 == n
    tau = phi.tau
    if tau is None:
        assert s == 0 and c < 0
        return
    assert polynomial_at(tau, (-s, 2 * c, s)) == (0, 0)
    assert (tau.compare(0) is Order.AFTER) == (s > 0) and (tau.compare(0) is Order.SAME) == (s == 0)
    # (1 + tau^2) cos = 1 - tau^2 in Q(sqrt(n)): the rational part and the factor of the root
    (square, factor), (k, l) = polynomial_at(tau, (0, 0, 1)), (phi.cos.p, phi.cos.q)
    assert ((1 + square) * k + factor * l * n, (1 + square) * l + factor * k) == (1 - square, -factor)


@given(angles)
def test_doubles_agree_with_the_tangent(phi: ExactAngle) -> None:
    assume(phi.tau is not None)
    tau = float(phi.tau)  # type: ignore[arg-type]
    assert math.isclose(2 * math.atan(tau), phi.theta, rel_tol=1e-15)


@given(angles, st.integers(0, 70))
def test_neighbours_of_an_angle_are_on_its_two_sides(phi: ExactAngle, bits: int) -> None:
    before, after = phi.neighbours(bits)
    if before == after:
        c, s, _ = half_angle_rotation(before)
        assert ExactAngle(c, s) == phi
        return
    for tau, side in ((before, Orientation.LEFT), (after, Orientation.RIGHT)):
        c, s, w = half_angle_rotation(tau)
        assert turn((c, s), (phi.c, phi.s)) is side
        # the sine of the angle between, at most 2^(1 - bits)
        sine = Fraction((c * phi.s - s * phi.c) ** 2, w * w * phi.n)
        assert sine <= Fraction(4, 4**bits)
        local = tau if tau is not None and abs(tau) <= 1 else 1 / tau if tau else Fraction(0)
        assert (local * 2**bits).denominator == 1


def test_no_direction_has_no_angle() -> None:
    with pytest.raises(ValueError, match=r"\(0, 0\) has no angle"):
        ExactAngle(0, 0)
