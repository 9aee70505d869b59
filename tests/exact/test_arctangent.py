"""Arctangents are as close as they say."""

from fractions import Fraction

import pytest
from flint import arb, ctx, fmpq
from hypothesis import given
from hypothesis import strategies as st

from cfree.exact.arctangent import arctangent, pi


def off(found: Fraction, true: arb) -> Fraction:
    """At most how far it is off."""
    apart = abs(arb(fmpq(found.numerator, found.denominator)) - true).upper()
    mantissa, exponent = map(int, apart.man_exp())
    return Fraction(mantissa) * Fraction(2) ** exponent


@given(st.fractions(), st.integers(-2000, 2000), st.integers(1, 800))
def test_arctangents_err_less_than_is_said(value: Fraction, power: int, bits: int) -> None:
    tangent = value * Fraction(2) ** power
    with ctx.workprec(bits + 200):
        assert off(arctangent(tangent, bits), arb(fmpq(tangent.numerator, tangent.denominator)).atan()) < Fraction(
            1, 1 << bits
        )


@pytest.mark.slow
@pytest.mark.parametrize("bits", [10, 128, 1000, 20_000])
def test_pi_errs_less_than_is_said(bits: int) -> None:
    with ctx.workprec(bits + 200):
        assert off(pi(bits), arb.pi()) < Fraction(1, 1 << bits)
