"""Phi in half-angle tangents: exactly the contacts of a convex pair, and as close as is asked for."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cfree.contact.contact import (
    EdgeEdge,
    VertexEdge,
    VertexVertex,
    angle_range,
    contact_curves,
    contacts,
)
from cfree.contact.definitions import is_contact
from cfree.exact.half_angle import chart_intervals
from cfree.exact.orientation import Location
from cfree.exact.surd import Surd
from cfree.polygons.polygon import Polygon
from cfree.rational.model import (
    rational_helix,
    rational_range,
    rational_surface,
)
from rational_pairs import (
    SQUARE,
    TRIANGLE,
    M,
    convex_pairs,
    inner,
    pairs,
    polygons,
    taus,
)
from shapes import Shape


@settings(max_examples=60)
@given(convex_pairs, inner, taus, st.data())
def test_a_convex_pair_is_in_contact_exactly_in_phi(
    shapes: tuple[Shape, Shape], t: Fraction, tau: Fraction | None, data: st.DataObject
) -> None:
    A, O = polygons(shapes)
    contact = data.draw(st.sampled_from(contacts(A, O)))
    S = rational_surface(A, O, contact)
    where = S.locate(t, tau)
    assert is_contact(A, O, S.surface.pose(t, {"tau": tau})) is (where is not Location.OUTSIDE)
    corners = [c for c in contact_curves(A, O) if isinstance(c, VertexVertex)]
    C = rational_helix(A, O, data.draw(st.sampled_from(corners)))
    assert is_contact(A, O, C.helix.pose({"tau": tau})) is (C.locate(tau) is not Location.OUTSIDE)


@pytest.mark.slow
@given(pairs, taus, st.data())
def test_intervals_of_tau_say_the_same_as_directions(
    shapes: tuple[Shape, Shape], tau: Fraction | None, data: st.DataObject
) -> None:
    A, O = polygons(shapes)
    contact = data.draw(st.sampled_from((*contacts(A, O), *contact_curves(A, O))))
    Phi = rational_range(A, O, contact)
    if tau is None:
        inside = any(None in interval for interval in Phi.domain)
    elif isinstance(contact, EdgeEdge):
        (interval,) = Phi.domain
        inside = interval[0] == Surd(tau)
    else:
        inside = any(
            (low is None or low.compare(tau).value != "after") and (high is None or high.compare(tau).value != "before")
            for low, high in Phi.domain
        )
    assert inside is (Phi.locate(tau) is not Location.OUTSIDE)


@given(pairs, st.data())
def test_ends_are_those_of_the_range_in_radians(shapes: tuple[Shape, Shape], data: st.DataObject) -> None:
    A, O = polygons(shapes)
    contact = data.draw(st.sampled_from((*contacts(A, O), *contact_curves(A, O))))
    Phi, r = rational_range(A, O, contact), angle_range(A, O, contact)
    for end, phi in ((Phi.start, r.phi_min), (Phi.end, r.phi_max)):
        assert math.isclose(math.remainder(end.theta - phi, math.tau), 0, abs_tol=1e-14)
        if end.tau is not None and math.isqrt(end.n) ** 2 == end.n:
            assert Phi.locate(end.tau.p) is Location.BOUNDARY


def test_a_range_through_infinity_is_two_intervals() -> None:
    triangle = Polygon([(0, 0), (2, 0), (1, 1)])
    Phi = rational_range(triangle, SQUARE, VertexEdge(2, 2))
    assert Phi.domain == ((Surd(1, 1, 2), None), (None, Surd(-1, -1, 2)))
    assert Phi.locate(10**50) is Phi.locate(-(10**50)) is Phi.locate(None) is Location.INSIDE
    assert Phi.locate(2) is Phi.locate(0) is Location.OUTSIDE
    begins = rational_range(SQUARE, SQUARE, VertexEdge(0, 0))
    assert begins.domain == ((None, Surd(-1)),) and begins.locate(None) is Location.BOUNDARY
    ends = rational_range(SQUARE, SQUARE, VertexEdge(0, 3))
    assert ends.domain == ((Surd(1), None),) and ends.locate(None) is Location.BOUNDARY
    alone = rational_range(SQUARE, SQUARE, EdgeEdge(0, 0))
    assert alone.domain == ((None, None),) and alone.locate(10**9) is Location.OUTSIDE
    assert alone.locate(None) is Location.BOUNDARY


@settings(max_examples=60)
@given(pairs, st.integers(2, 60), st.data())
def test_outer_ends_are_just_outside(shapes: tuple[Shape, Shape], bits: int, data: st.DataObject) -> None:
    A, O = polygons(shapes)
    Phi = rational_range(A, O, data.draw(st.sampled_from(contacts(A, O))))
    for end, tau in zip((Phi.start, Phi.end), Phi.outside(bits), strict=True):
        assert Phi.locate(tau) is not Location.INSIDE
        c, s = M(tau, (Fraction(1), Fraction(0)))
        assert (c * end.s - s * end.c) ** 2 <= end.n * Fraction(4, 4**bits)  # the sine of the angle between


@pytest.mark.slow
@settings(max_examples=60)
@given(pairs, st.integers(1, 60), st.data())
def test_inner_ends_are_just_inside(shapes: tuple[Shape, Shape], bits: int, data: st.DataObject) -> None:
    A, O = polygons(shapes)
    Phi = rational_range(A, O, data.draw(st.sampled_from(contacts(A, O))))
    try:
        inside = Phi.inside(bits)
    except ValueError as error:
        assert "give more bits" in str(error)
        assert (Phi.end.theta - Phi.start.theta) % math.tau < 2.0 ** (2 - bits) + 1e-12
        return
    for end, tau in zip((Phi.start, Phi.end), inside, strict=True):
        assert Phi.locate(tau) is not Location.OUTSIDE
        c, s = M(tau, (Fraction(1), Fraction(0)))
        assert (c * end.s - s * end.c) ** 2 <= end.n * Fraction(4, 4**bits)
    for chart, low, high in chart_intervals(*inside):
        for local in (low, (low + high) / 2, high):
            between_ends = local if chart == 0 else None if local == 0 else -1 / local
            assert Phi.locate(between_ends) is not Location.OUTSIDE


def test_rational_ends_are_kept_whatever_the_precision() -> None:
    A = Polygon([(0, 0), (4, 0), (4, 3)])  # a 3-4-5 triangle
    Phi = rational_range(A, SQUARE, VertexEdge(2, 2))
    ends = Phi.start.tau, Phi.end.tau
    assert all(tau is not None and tau.q == 0 for tau in ends)
    assert Phi.inside(1) == Phi.outside(1) == tuple(tau.p for tau in ends if tau is not None)


def test_a_range_too_narrow_for_the_precision_says_so() -> None:
    nearly_straight = Polygon([(0, 0), (1000, -1), (2000, 0), (1000, 1000)])
    narrow = rational_range(nearly_straight, TRIANGLE, VertexEdge(1, 1))
    with pytest.raises(ValueError, match=r"multiples of 2\^-4; give more bits"):
        narrow.inside(4)
    first, last = narrow.inside(40)
    assert narrow.locate(first) is narrow.locate(last) is Location.INSIDE
    with pytest.raises(ValueError, match="single orientation"):
        rational_range(SQUARE, SQUARE, EdgeEdge(0, 0)).inside(53)


def test_an_outer_range_does_not_pass_itself() -> None:
    # a corner in a corner leaves less than a hundredth of a turn out of the helix's range
    spike = Polygon([(0, 0), (1000, -1), (1000, 2)])
    Phi = rational_range(spike, spike, VertexVertex(0, 0))
    with pytest.raises(ValueError, match="give more bits"):
        Phi.outside(4)
    first, last = Phi.outside(40)
    assert Phi.locate(first) is Phi.locate(last) is Location.OUTSIDE
