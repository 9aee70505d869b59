"""Places on lines are compared as fractions are."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from cfree.distributed.nesting import Place

NUMBERS = st.tuples(st.integers(-(10**20), 10**20), st.integers(1, 10**20))


@given(NUMBERS, NUMBERS, st.integers(1, 5), st.integers(-1, 1))
def test_places_are_in_the_order_of_their_fractions(
    one: tuple[int, int], other: tuple[int, int], factor: int, step: int
) -> None:
    close = one[0] * 2**90 + step, one[1] * 2**90
    for a, b in ((one, other), (one, close), (one, (factor * one[0], factor * one[1]))):
        p, q = Fraction(*a), Fraction(*b)
        assert (Place.of(*a) < Place.of(*b), Place.of(*a) > Place.of(*b), Place.of(*a) == Place.of(*b)) == (
            p < q,
            p > q,
            p == q,
        )
