"""Roots of polynomials as exact numbers, and keys of numbers in their fields."""

from fractions import Fraction

from flint import fmpz_poly
from hypothesis import assume, given
from hypothesis import strategies as st

from cfree.exact.algebraic import LEAST, Number, factors, roots, variations

eighths = st.integers(-15, 15).map(lambda n: Fraction(n, 8))


@given(st.tuples(*[st.integers(-30, 30)] * 3), eighths, eighths)
def test_roots_of_quadratics_have_the_index_that_variations_count(
    coefficients: tuple[int, int, int], lo: Fraction, hi: Fraction
) -> None:
    assume(coefficients[2] != 0 and lo < hi)
    found = roots(fmpz_poly(list(coefficients)), lo, hi)
    for root, _ in found:
        if len(root.poly) == 3:
            assert root.key == (root.poly, variations(root.poly, LEAST) - variations(root.poly, root.lo))
    irreducible = [poly for poly, _ in factors(coefficients) if len(poly) == 3]
    number = sum(variations(poly, lo) - variations(poly, hi) for poly in irreducible)
    assert sum(len(root.poly) == 3 for root, _ in found) == number


@given(st.integers(-5, 5), st.integers(-5, 5), st.integers(1, 5))
def test_numbers_are_equal_if_their_keys_are(a: int, b: int, c: int) -> None:
    ((root, _),) = roots(fmpz_poly([-2, 0, 1]), Fraction(0), Fraction(3, 2))
    x: Number = (a + b * root.value) / c
    same: Number = (2 * a + b * root.value * 2) / (2 * c)
    other: Number = x + Fraction(1, 7)
    assert x.key == same.key and x == same and hash(x) == hash(same)
    assert x.key != other.key and x != other
