"""Bounds of the error of driving through a jump of curvature, against numeric integration."""

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from cfree.paths import Ramp
from cfree.paths.ramps import ramp_length

CURVATURES = st.floats(-0.5, 0.5)
COUNT = 2000


def errors(planned: np.ndarray, driven: np.ndarray, step: float) -> tuple[float, float]:
    """Return the greatest distance and the greatest difference of headings, from curvatures at even steps."""
    headings = [np.cumsum(c) * step - c * step / 2 for c in (planned, driven)]  # in the middle of each step
    places = [np.cumsum(np.exp(1j * heading)) * step for heading in headings]
    return float(np.abs(places[0] - places[1]).max()), float(np.abs(headings[0] - headings[1]).max())


@settings(deadline=None, max_examples=100)
@given(CURVATURES, CURVATURES, st.floats(0.1, 3), st.floats(0.2, 2), st.floats(0.5, 4), st.integers(0, 10**6))
def test_wheels_that_turn_from_the_joint_on_keep_within_the_bounds(
    before: float, beyond: float, speed: float, rate: float, wheelbase: float, seed: int
) -> None:
    """The wheels turn at their rate, at any speeds up to the limit."""
    length = ramp_length(speed, rate, wheelbase, before, beyond)
    ramp = Ramp(0, length, abs(beyond - before))
    step = length / COUNT
    speeds = speed * np.random.default_rng(seed).uniform(0.3, 1, 8).repeat(COUNT // 8)
    one, other = math.atan(wheelbase * before), math.atan(wheelbase * beyond)
    turned = np.minimum(np.cumsum(rate * step / speeds), abs(other - one))
    driven = np.tan(one + np.sign(other - one) * turned) / wheelbase
    off, heading = errors(np.full(COUNT, beyond), driven, step)
    assert off <= ramp.sideways * (1 + 1e-2) + 1e-12 and heading <= ramp.heading * (1 + 1e-2) + 1e-12
    assert abs(turned[-1] - abs(other - one)) < 1e-2  # the length suffices


@settings(deadline=None, max_examples=100)
@given(CURVATURES, CURVATURES, st.floats(0.1, 3), st.floats(0.2, 2), st.floats(0.5, 4))
def test_an_even_change_around_the_joint_keeps_within_the_bounds_and_ends_with_the_right_heading(
    before: float, beyond: float, speed: float, rate: float, wheelbase: float
) -> None:
    length = ramp_length(speed, rate, wheelbase, before, beyond)
    ramp = Ramp(0, length, abs(beyond - before))
    shares = (np.arange(COUNT) + 0.5) / COUNT
    driven, planned = before + (beyond - before) * shares, np.where(shares < 0.5, before, beyond)
    off, heading = errors(planned, driven, length / COUNT)
    assert off <= ramp.centred_sideways * (1 + 1e-2) + 1e-12
    assert heading <= ramp.centred_heading * (1 + 1e-2) + 1e-12
    assert abs((driven - planned).sum()) <= 1e-9 * COUNT
    wheels = np.diff(np.arctan(wheelbase * driven)) / (length / COUNT / speed) if length > 1e-9 else np.zeros(1)
    assert np.abs(wheels).max() <= rate * (1 + 1e-6)


def test_the_bounds_are_reached_by_small_jumps() -> None:
    ramp, shares = Ramp(0, 0.1, 0.1), (np.arange(COUNT) + 0.5) / COUNT
    off, heading = errors(np.full(COUNT, 0.1), 0.1 * shares, 0.1 / COUNT)
    assert 0.99 < off / ramp.sideways < 1.01 and 0.99 < heading / ramp.heading < 1.01


@given(st.floats(0.01, 1), st.floats(0, 1), st.floats(0, 10))
def test_points_of_the_robot_are_off_by_no_more_than_the_room(length: float, jump: float, reach: float) -> None:
    ramp = Ramp(0, length, jump)
    assert ramp.room(reach) >= ramp.sideways + 2 * reach * math.sin(ramp.heading / 2) - 1e-12
