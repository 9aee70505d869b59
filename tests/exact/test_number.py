import math
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cfree.exact.number import angle, common_denominator, simplest_between, to_fraction, to_ratio


@pytest.mark.parametrize(
    ("value", "exact"),
    [
        (3, Fraction(3)),
        (0.1, Fraction(3602879701896397, 36028797018963968)),
        ("0.1", Fraction(1, 10)),
        (Decimal("0.1"), Fraction(1, 10)),
        ("1/3", Fraction(1, 3)),
        (" -2 / 4 ", Fraction(-1, 2)),
        ("2/-4", Fraction(-1, 2)),
        ("-2.5e-3", Fraction(-1, 400)),
        (Fraction(2, 7), Fraction(2, 7)),
        (np.float64(0.5), Fraction(1, 2)),
        (np.float32(0.1), Fraction(float(np.float32(0.1)))),
        (np.int16(-4), Fraction(-4)),
        (-0.0, Fraction(0)),
        (1e308, Fraction(10**308) + (Fraction(1e308) - 10**308)),
        (5e-324, Fraction(1, 2**1074)),
    ],
)
def test_a_number_is_the_rational_it_is_written_as(value: object, exact: Fraction) -> None:
    assert to_fraction(value) == exact
    assert to_ratio(value) == (exact.numerator, exact.denominator)


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (math.nan, "nan is not finite"),
        (-math.inf, "-inf is not finite"),
        (np.float32("inf"), "inf is not finite"),
        (Decimal("NaN"), "NaN is not finite"),
        ("inf", "Infinity is not finite"),
        ("1/0", "divides by zero"),
        (True, "truth value"),
        (np.True_, "truth value"),
        ("abc", "no number"),
        ("", "no number"),
        ("1/2/3", "no number"),
        (None, "no number"),
        ([1], "no number"),
        (1j, "no number"),
        ("1e999999999", "digits"),
        (Decimal("1e-999999"), "digits"),
        ("7" * 10_000_000, "10000000 characters"),
        ({"a": "b" * 1000}, r"bbb\.\.\.bbb"),
    ],
)
def test_what_is_no_finite_number_is_refused_with_its_value(value: object, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        to_fraction(value)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_floats_survive_a_round_trip(value: float) -> None:
    assert float(to_fraction(value)) == value
    assert to_fraction(repr(value)) == Fraction(repr(value))


@given(st.lists(st.fractions(), min_size=1, max_size=8))
def test_common_denominator_is_the_least_that_makes_all_whole(fractions: list[Fraction]) -> None:
    denominator = common_denominator(fractions)
    assert all((f * denominator).denominator == 1 for f in fractions)
    assert math.gcd(denominator, *(int(f * denominator) for f in fractions)) == 1


def test_the_common_denominator_of_nothing_is_one() -> None:
    assert common_denominator([]) == 1


@given(st.fractions(-50, 50, max_denominator=60), st.fractions(0, 1, max_denominator=30))
def test_simplest_between_beats_every_smaller_denominator(low: Fraction, width: Fraction) -> None:
    high = low + width
    best = simplest_between(low, high)
    assert low <= best <= high
    assert best == 0 or not low <= 0 <= high
    for denominator in range(1, best.denominator):
        assert math.floor(high * denominator) < low * denominator


@given(st.integers(-(10**6), 10**6), st.integers(-(10**6), 10**6), st.integers(0, 400))
def test_angles_do_not_depend_on_length(x: int, y: int, power: int) -> None:
    if x or y:
        assert angle(x * 10**power, y * 10**power) == angle(x, y)
        assert math.isclose(angle(x, y), math.atan2(y, x), rel_tol=1e-15)
