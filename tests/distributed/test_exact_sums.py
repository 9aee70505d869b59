"""Sums without rounding, against those of fractions."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from cfree.distributed.exact_sums import exact_sums

DOUBLES = st.floats(allow_nan=False, allow_infinity=False)


@given(st.lists(st.tuples(DOUBLES, st.integers(0, 2)), max_size=40))
def test_sums_are_those_of_fractions(rows: list[tuple[float, int]]) -> None:
    values, group = np.array([x for x, _ in rows], float), np.array([g for _, g in rows], np.int64)
    expected = [sum((Fraction(x) for x, g in rows if g == k), Fraction(0)) for k in range(3)]
    assert exact_sums(values, group, 3) == expected
