"""Orientations as tangents of half their angle: the only Python file that converts angles to rationals.

tau = tan(theta / 2), paper, section 1.1 and eq. 2. The half turn has no tau: it is written `None`.

A *chart* writes every angle by a number in [-1, 1]: theta = 2 atan(tau) + chart * pi. Chart 0 holds
[-pi/2, pi/2], chart 1 holds [pi/2, 3 pi/2]; they tile the circle with rational end points.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from typing import Literal

import cfree._core as _core
from cfree.errors import InvalidPoseError
from cfree.exact.arctangent import pi
from cfree.exact.number import ExactPoint, Number, simplest_between, to_fraction
from cfree.libraries import ArrayLike, Floats, NDArray, np

MOST_EXACT = 2**53  # all integers up to it are doubles
Rate = float | str  # an angle a second: radians, or a text such as "30deg" or "0.5rad"
# radians, also as "1.5rad"; degrees as in "90deg" or "90°"; or the half-angle tangent: {"tau": "1/3"}, {"tau": "inf"},
# {"tau": None}
Angle = Number | Mapping[str, Number | None]


def to_rate(rate: Rate | None, name: str) -> float | None:
    """Read a rate of turning, an angle a second, in radians; None stays None.

    Raises
    ------
    ValueError
        If it is no angle above 0.

    Examples
    --------
    >>> to_rate("180deg", "rate"), to_rate("1/2", "rate"), to_rate(0.35, "rate")
    (3.141592653589793, 0.5, 0.35)
    """
    if not isinstance(rate, str):
        return rate
    try:
        value, unit = number_and_unit(rate)
        number = float(to_fraction(value))
    except (ValueError, OverflowError):
        number, unit = 0.0, ""
    if not 0 < number < math.inf:
        raise ValueError(f'{name}: {rate!r}; give an angle a second above 0 such as "30deg"')
    return math.radians(number) if unit == "deg" else number


def half_angle_rotation(tau: Fraction | None) -> tuple[int, int, int]:
    """Integers (c, s, w) of the rotation by 2 atan(tau): c / w its cosine, s / w its sine.

    Notes
    -----
    The paper's M^tau: c / w = (1 - tau^2) / (1 + tau^2), s / w = 2 tau / (1 + tau^2), and M^inf = R^pi.

    Examples
    --------
    >>> half_angle_rotation(Fraction(1, 2)), half_angle_rotation(None)
    ((3, 4, 5), (-1, 0, 1))
    """
    if tau is None:
        return -1, 0, 1
    p, q = tau.numerator, tau.denominator
    return q * q - p * p, 2 * p * q, q * q + p * p


def rational_rotation(tau: ArrayLike) -> tuple[Floats, Floats]:
    """Cosine and sine of the rotation by 2 atan(tau), in doubles; both infinities are the half turn.

    Examples
    --------
    >>> rational_rotation([0.5, math.inf])
    (array([ 0.6, -1. ]), array([0.8, 0. ]))
    """
    chart, local = _split_tau(tau)
    base, w = 1.0 - 2 * chart, 1 + local * local
    return base * (1 - local * local) / w, base * 2 * local / w + 0.0


def tau_of(theta: ArrayLike) -> Floats:
    """Half-angle tangent of angles in radians, in doubles; the half turn is inf.

    Examples
    --------
    >>> tau_of([0, math.pi / 2, math.pi])
    array([ 0.,  1., inf])
    """
    chart, local = chart_of(theta)
    tau = np.where((chart == 1) & (local == 0), np.inf, local)
    return np.divide(-1, local, out=tau, where=(chart == 1) & (local != 0))


def theta_of_tau(tau: ArrayLike) -> Floats:
    """Angle in [0, 2 pi) of half-angle tangents, in doubles.

    Examples
    --------
    >>> theta_of_tau([0, 1, math.inf, -1]) / math.pi
    array([0. , 0.5, 1. , 1.5])
    """
    return theta_of(*_split_tau(tau))


def half_tangent(tau: Number | None) -> Fraction | None:
    """Read an exact half-angle tangent; None, inf, -inf, "inf", "-inf" and "1/0" are the half turn.

    Raises
    ------
    InvalidPoseError
        If `tau` is none of these and no number.

    Examples
    --------
    >>> half_tangent("0.5"), half_tangent("inf")
    (Fraction(1, 2), None)
    """
    if type(tau) is Fraction:  # the usual type, and slow to compare with texts
        return tau
    return None if tau in (None, "inf", "-inf", "1/0", math.inf, -math.inf) else to_rational("tau", tau)


def chart_of_direction(x: int, y: int) -> tuple[int, tuple[int, int]]:
    """Chart of a direction (cos, sin) up to length, and the direction in it: at most a right angle from (1, 0).

    Examples
    --------
    >>> chart_of_direction(-3, 4)
    (1, (3, -4))
    """
    return (0, (x, y)) if x >= 0 else (1, (-x, -y))


def seen_in_chart(chart: int, a: ExactPoint) -> ExactPoint:
    """Rotate a point of the robot by the zero angle of a chart.

    Examples
    --------
    >>> seen_in_chart(1, (Fraction(2), Fraction(0))) == (-2, 0)
    True
    """
    return a if chart == 0 else (-a[0], -a[1])


def tau_in_chart(chart: int, local: Fraction) -> Fraction | None:
    """Half-angle tangent of an exact coordinate in a chart.

    Examples
    --------
    >>> tau_in_chart(1, Fraction(-1, 2)), tau_in_chart(1, Fraction(0))
    (Fraction(2, 1), None)
    """
    if chart == 0:
        return local
    return -1 / local if local else None


def chart_intervals(start: Fraction | None, stop: Fraction | None) -> tuple[tuple[int, Fraction, Fraction], ...]:
    """Parts (chart, from, to) of the angles from 2 atan(start) counter-clockwise to 2 atan(stop); the two differ.

    Examples
    --------
    >>> chart_intervals(Fraction(1, 2), None) == ((0, Fraction(1, 2), 1), (1, -1, 0))
    True
    """
    chart, low = to_chart(start)
    last, high = to_chart(stop)
    if low == 1:
        chart, low = 1 - chart, Fraction(-1)
    if high == -1:
        last, high = 1 - last, Fraction(1)
    parts = []
    while chart != last or low >= high:
        parts.append((chart, low, Fraction(1)))
        chart, low = 1 - chart, Fraction(-1)
    return *parts, (chart, low, high)


def chart_of(theta: ArrayLike) -> tuple[NDArray[np.int64], Floats]:
    """Chart and coordinate of angles in radians, in doubles; see `Pose.chart` for the exact twin.

    Examples
    --------
    >>> chart, tau = chart_of([0.0, math.pi])
    >>> chart, tau
    (array([0, 1]), array([0., 0.]))
    """
    angles = normalize_angles(theta)
    chart = ((angles > np.pi / 2) & (angles < 3 * np.pi / 2)).astype(np.int64)
    local = angles - np.where(angles >= 3 * np.pi / 2, math.tau, np.pi * chart)
    border = np.abs(np.abs(local) - np.pi / 2) <= np.spacing(angles)
    return chart, np.where(border, np.sign(local), np.tan(local / 2))


def place_of(theta: Angle) -> tuple[float, int, float]:
    """Angle in [0, 2 pi), chart and coordinate of one angle, as doubles; fast for a float.

    Examples
    --------
    >>> place_of("90deg"), place_of(3.0)
    ((1.5707963267948966, 0, 1.0), (3.0, 1, -0.0709148443026524))
    """
    # the fast case excludes other turns and right angles: these need the true pi
    if isinstance(theta, float) and 0 <= theta < math.tau and abs(math.remainder(theta, math.pi / 2)) > 1e-9:
        chart = math.pi / 2 < theta < 3 * math.pi / 2
        local = theta - math.pi if chart else math.remainder(theta, math.tau)
        return theta, int(chart), math.tan(local / 2)
    tau, angle, _ = read_angle(theta)
    number, exact = to_chart(tau)
    return angle, number, float(exact)


def theta_of(chart: ArrayLike, tau: ArrayLike) -> Floats:
    """Angle in [0, 2 pi) of coordinates in charts, in doubles.

    Examples
    --------
    >>> theta_of([0, 1, 0], [1.0, 0.0, -1.0]) / math.pi
    array([0.5, 1. , 1.5])
    """
    return normalize_angles(theta_in(chart, tau))


def theta_in(chart: ArrayLike, tau: ArrayLike) -> Floats:
    """Angle in [-pi/2, 3 pi/2] of coordinates in charts; it grows with tau in each chart."""
    theta: Floats = 2 * np.arctan(np.asarray(tau, dtype=np.float64)) + np.asarray(chart) * np.pi
    return theta


def tau_in(chart: ArrayLike, theta: ArrayLike) -> Floats:
    """Coordinate of angles in charts that hold them."""
    tau: Floats = np.tan((np.asarray(theta, dtype=np.float64) - np.asarray(chart) * np.pi) / 2)
    return tau


def normalize_angles(theta: ArrayLike) -> Floats:
    """Normalise angles in radians to [0, 2 pi)."""
    angles = np.mod(np.asarray(theta, dtype=np.float64), math.tau)
    return np.where(angles < math.tau, angles, 0.0)


def to_chart(tau: Fraction | None) -> tuple[int, Fraction]:
    """Chart of a half-angle tangent and its exact coordinate there; an angle on the border belongs to chart 0."""
    if tau is None:
        return 1, Fraction(0)
    return (0, tau) if abs(tau) <= 1 else (1, -1 / tau)


def _split_tau(tau: ArrayLike) -> tuple[NDArray[np.int64], Floats]:
    """Charts and coordinates of half-angle tangents, in doubles."""
    tangent = np.asarray(tau, dtype=np.float64)
    if np.isnan(tangent).any():
        raise InvalidPoseError("tau: nan is no number; give a number, or inf for the half turn")
    chart = np.abs(tangent) > 1
    return chart.astype(np.int64), np.divide(-1, tangent, out=tangent.copy(), where=chart)


def read_angle(theta: Angle) -> tuple[Fraction | None, float, float]:
    """Read an angle as tau, theta in [0, 2 pi) and the bound on their distance."""
    if isinstance(theta, Mapping):
        tau = _read_tau(theta)
        return tau, theta_from(tau), 0.0
    value, unit = number_and_unit(theta)
    if unit == "deg":
        degrees = to_rational("theta", value)
        quarter_turns = round(degrees / 90)
        rest = (degrees - 90 * quarter_turns) / 180 * pi(128)
        return _rationalize(quarter_turns, rest)
    if isinstance(theta, float) or (type(theta) is int and abs(theta) <= MOST_EXACT):
        read = _core.read_radians(theta)
        if read is not None:
            p, q, angle, error = read
            return Fraction(p, q) if q else None, angle, error
    return read_radians(value)


def read_radians(theta: Number) -> tuple[Fraction | None, float, float]:
    """Read radians of any kind and size, to the same values; the core's twin reads doubles below 2^63.

    Examples
    --------
    >>> read_radians("0.5") == read_angle(0.5)
    True
    """
    radians = to_rational("theta", theta)
    try:
        ulp = math.ulp(float(radians))
    except OverflowError:
        raise InvalidPoseError(f"theta: {theta!r} is too large; give an angle in [0, 2 pi)") from None
    size = int(abs(radians)).bit_length()
    right_angle = pi(192 + size - size % 64) / 2
    quarter_turns = round(radians / right_angle)
    rest = radians - quarter_turns * right_angle
    return _rationalize(quarter_turns, rest if abs(rest) > ulp else Fraction(0))


def number_and_unit(theta: Number) -> tuple[Number, Literal["deg", "rad", ""]]:
    """Split an angle into its number and its unit; only a text can end with a unit.

    Examples
    --------
    >>> number_and_unit("90deg"), number_and_unit(" 22.5° "), number_and_unit("1.5 rad"), number_and_unit(1.5)
    (('90', 'deg'), ('22.5', 'deg'), ('1.5 ', 'rad'), (1.5, ''))
    """
    text = theta.strip() if isinstance(theta, str) else ""
    units: dict[str, Literal["deg", "rad"]] = {"deg": "deg", "°": "deg", "rad": "rad"}
    suffix = next((unit for unit in units if text.endswith(unit)), None)
    return (theta, "") if suffix is None else (text.removesuffix(suffix), units[suffix])


def require_unit(text: str) -> None:
    """Refuse an angle typed as text without a unit, unless it is at most a whole turn in radians.

    Raises
    ------
    InvalidPoseError
        If the unit is missing: most likely degrees were meant.

    Examples
    --------
    >>> require_unit("3"), require_unit("-720deg")
    (None, None)
    >>> require_unit("90")
    Traceback (most recent call last):
    cfree.errors.InvalidPoseError: theta: 90 is more than a whole turn in radians; write 90deg or 90rad
    """
    text = text.strip()
    if not number_and_unit(text)[1] and abs(to_rational("theta", text)) > Fraction(math.tau):
        raise InvalidPoseError(f"theta: {text} is more than a whole turn in radians; write {text}deg or {text}rad")


def _read_tau(theta: Mapping[str, Number | None]) -> Fraction | None:
    if set(theta) != {"tau"}:
        raise InvalidPoseError(f'theta: {dict(theta)!r:.60} is no angle; give {{"tau": "p/q"}} or radians')
    return half_tangent(theta["tau"])


def _rationalize(quarter_turns: int, rest: Fraction) -> tuple[Fraction | None, float, float]:
    """Return tau, theta and error of the angle quarter_turns * pi/2 + rest, |rest| <= pi/4.

    Notes
    -----
    Relative errors of tan(rest / 2): 1.6 * 2^-53 from rounding rest, 2^-52 allowed to the library's tangent,
    2^-53 for the simplest fraction. The angle errs by less than tau, relatively: below 2^-50 |rest| in all.
    """
    tangent = Fraction(math.tan(float(rest) / 2))
    margin = abs(tangent) / 2**53
    tau: Fraction | None = simplest_between(tangent - margin, tangent + margin)
    for _ in range(quarter_turns % 4):
        tau = sum_of_angles(tau, Fraction(1))
    quarters = 4 if rest < 0 and quarter_turns % 4 == 0 else quarter_turns % 4
    theta = float(quarters * pi(128) / 2 + rest)
    return tau, theta if theta < math.tau else 0.0, abs(float(rest)) * 2.0**-50


def sum_of_angles(tau: Fraction | None, other: Fraction | None) -> Fraction | None:
    """Half-angle tangent of the sum: (tau + other) / (1 - tau other)."""
    if tau is None and other is None:
        return Fraction(0)
    if tau is None or other is None:
        finite = other if tau is None else tau
        return -1 / finite if finite else None
    below = 1 - tau * other
    return (tau + other) / below if below else None


def theta_from(tau: Fraction | None) -> float:
    """Angle 2 atan(tau) in [0, 2 pi), a double.

    Examples
    --------
    >>> theta_from(Fraction(1)), theta_from(None)
    (1.5707963267948966, 3.141592653589793)
    """
    if tau is None:
        return math.pi
    if abs(tau.numerator) > tau.denominator:
        return math.pi - 2 * math.atan(float(1 / tau))
    theta = 2 * math.atan(float(tau)) % math.tau
    return theta if theta < math.tau else 0.0


def to_rational(name: str, value: Number) -> Fraction:
    """Exact value of a number; the error for anything else names the argument."""
    try:
        return to_fraction(value)
    except ValueError as error:
        raise InvalidPoseError(f"{name}: {error}") from None
