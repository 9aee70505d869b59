"""`Car` and `DifferentialDrive`: the motions that a machine on wheels can do, in exact numbers.

The *axle point* is the middle of the axle that does not steer, *forward* a heading; both are fixed in the robot's
frame. The axle point moves forward or backward, never sideways. A motion is therefore a straight line along forward,
or a turn about a pole on the axle line, which is the line through the axle point across forward.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, ClassVar, Literal

from cfree.arguments import checked
from cfree.errors import InvalidVehicleError
from cfree.exact.half_angle import Angle, number_and_unit, read_angle
from cfree.exact.number import LARGEST, ExactPoint, Number, simplest_between, to_fraction
from cfree.exact.pose import Pose
from cfree.words import is_abbreviation

Gears = Literal["both", "forward"]
Radius = Number | tuple[Number, Number]


@checked
@dataclass(frozen=True, init=False, repr=False)
class Car:
    """A car: it drives straight on, or in arcs of at least its turning radius.

    The wheels may turn while it stands. Its radius is that of the track of the axle point. Lengths are in the scene's
    unit.

    Parameters
    ----------
    turning_radius : number, or (left, right)
        Least radius of an arc, more than 0; or one to the left and one to the right.
    axle : pair of numbers
        The middle of the axle that does not steer, in the robot's frame, inside the robot or not.
    heading : angle
        Forward in the robot's frame, counter-clockwise from its x axis: a multiple of "90deg", or an angle with a
        rational tangent of its half, like {"tau": "1/2"}.
    gears : "both" or "forward"
        "forward" has no reverse gear.
    wheelbase : number, optional
        Distance of the axles, more than 0. It limits no motion: only the times of its stops depend on it, see `timed`.

    Attributes
    ----------
    radii : pair of Fraction
        Least radius to the left, and to the right.
    axle : pair of Fraction
    heading : Fraction or None
        Tangent of half the angle; None is the half turn.
    wheelbase : Fraction or None

    Raises
    ------
    InvalidVehicleError
        If a radius is not above 0, a number is not finite or beyond 1e150, or the heading has no rational form.
    ValueError
        If `gears` is another word.

    Notes
    -----
    A car that reverses gets from every pose that touches nothing to every other one of the same cell of the free
    space, whatever its turning radius.

    Examples
    --------
    >>> Car(4, axle=("-1.3", "0.111"))
    Car(4, axle=(-13/10, 111/1000))
    >>> Car((4, 5), heading="90deg", gears="forward")
    Car((4, 5), axle=(0, 0), heading=90deg, gears='forward')
    >>> Car(0)
    Traceback (most recent call last):
        ...
    cfree.errors.InvalidVehicleError: turning_radius: 0; give a length above 0
    """

    kind: ClassVar[Literal["car"]] = "car"
    radii: tuple[Fraction, Fraction]
    axle: ExactPoint
    heading: Fraction | None
    gears: Gears
    wheelbase: Fraction | None = field(compare=False)

    def __init__(
        self,
        turning_radius: Radius,
        axle: Sequence[Number] = (0, 0),
        heading: Angle = 0,
        gears: Gears = "both",
        wheelbase: Number | None = None,
    ) -> None:
        values = {"radii": _radii(turning_radius), "axle": _axle(axle), "heading": _heading(heading), "gears": gears}
        values |= {"wheelbase": None if wheelbase is None else _wheelbase(wheelbase)}
        for name, value in values.items():
            object.__setattr__(self, name, value)

    @classmethod
    @checked
    def with_wheelbase(
        cls,
        wheelbase: Number,
        steering_angle: Angle,
        axle: Sequence[Number] = (0, 0),
        heading: Angle = 0,
        gears: Gears = "both",
    ) -> Car:
        """Return the car with this wheelbase and greatest steering angle: its radius is wheelbase / tan(angle).

        The angle is that of the bicycle model: of one wheel in the middle of the front axle. The radius is rounded up,
        by at most a millionth of a millionth.

        Parameters
        ----------
        wheelbase : number
            Distance of the axles, more than 0.
        steering_angle : angle
            More than 0 and less than 90 degrees: "35deg", or radians.
        axle, heading, gears
            As for `Car`.

        Returns
        -------
        Car

        Raises
        ------
        InvalidVehicleError
            If one of them is out of range.

        Examples
        --------
        >>> Car.with_wheelbase(2, {"tau": "1/2"}).turning_radius
        Fraction(3, 2)
        >>> car = Car.with_wheelbase("2.7", "35deg")
        >>> float(car.turning_radius), float(car.wheelbase)
        (3.8559996..., 2.7)
        """
        length = _wheelbase(wheelbase)
        tau, _, error = _read("steering_angle", steering_angle)
        if tau is None or not 0 < tau < 1 or _is_beyond_a_turn(steering_angle):
            raise InvalidVehicleError(
                f"steering_angle: {steering_angle}; give an angle above 0 and below a right angle, such as '35deg'"
            )
        if not error:
            return cls(length * (1 - tau * tau) / (2 * tau), axle, heading, gears, length)
        # the angle meant errs from that of tau by at most 2^-49 of the tangent
        low = tau * (1 - Fraction(1, 2**48))
        radius = length * (1 - low * low) / (2 * low)
        return cls(simplest_between(radius, radius * (1 + Fraction(1, 10**12))), axle, heading, gears, length)

    @property
    def turning_radius(self) -> Fraction:
        """The least radius of arcs to both sides."""
        return max(self.radii)

    @property
    def frame(self) -> Pose:
        """The pose in the robot's frame with the axle point as its place and forward as its x axis."""
        return Pose(*self.axle, {"tau": self.heading})

    def __repr__(self) -> str:
        left, right = self.radii
        radius = str(left) if left == right else f"({left}, {right})"
        gears = "" if self.gears == "both" else f", gears={self.gears!r}"
        base = "" if self.wheelbase is None else f", wheelbase={self.wheelbase}"
        return f"Car({radius}, axle={_text(self.axle)}{_heading_text(self.heading)}{gears}{base})"


@checked
@dataclass(frozen=True, init=False, repr=False)
class DifferentialDrive:
    """A machine that drives straight on, in arcs of any radius, and turns in place about its axle point.

    So do two driven wheels on one axle, and a forklift or tricycle whose steered wheel turns to a right angle.

    Parameters
    ----------
    axle : pair of numbers
        The middle of the axle that does not steer, in the robot's frame and the scene's unit, inside the robot or not.
    heading : angle
        Forward in the robot's frame, as of a `Car`.

    Attributes
    ----------
    axle : pair of Fraction
    heading : Fraction or None
        Tangent of half the angle; None is the half turn.

    Raises
    ------
    InvalidVehicleError
        If a number is not finite or beyond 1e150, or the heading has no rational form.

    Examples
    --------
    >>> DifferentialDrive(axle=("-1/2", 0))
    DifferentialDrive(axle=(-1/2, 0))
    """

    kind: ClassVar[Literal["differential"]] = "differential"
    gears: ClassVar[Gears] = "both"
    wheelbase: ClassVar[None] = None
    radii: ClassVar[tuple[Fraction, Fraction]] = (Fraction(0), Fraction(0))
    turning_radius: ClassVar[Fraction] = Fraction(0)
    axle: ExactPoint
    heading: Fraction | None

    def __init__(self, axle: Sequence[Number] = (0, 0), heading: Angle = 0) -> None:
        for name, value in {"axle": _axle(axle), "heading": _heading(heading)}.items():
            object.__setattr__(self, name, value)

    @property
    def frame(self) -> Pose:
        """The pose in the robot's frame with the axle point as its place and forward as its x axis."""
        return Pose(*self.axle, {"tau": self.heading})

    def __repr__(self) -> str:
        return f"DifferentialDrive(axle={_text(self.axle)}{_heading_text(self.heading)})"


Vehicle = Car | DifferentialDrive


def described(vehicle: Vehicle, units: str = "") -> str:
    """Name a vehicle in a sentence, its radii with their unit if that is an abbreviation.

    Examples
    --------
    >>> described(Car((4, 5), gears="forward")), described(Car("3.5"), "m")
    ('a car with turning radii of 4 and 5 and no reverse gear', 'a car with a turning radius of 3.5 m')
    """
    if isinstance(vehicle, DifferentialDrive):
        return "a differential drive"
    left, right = map(_length, vehicle.radii)
    unit = f" {units}" if is_abbreviation(units) else ""
    radius = f"a turning radius of {left}{unit}" if left == right else f"turning radii of {left} and {right}{unit}"
    return f"a car with {radius}{'' if vehicle.gears == 'both' else ' and no reverse gear'}"


def _length(value: Fraction) -> str:
    return f"{float(value):.6g}"


def _radii(value: Any) -> tuple[Fraction, Fraction]:
    sides = value if isinstance(value, tuple | list) else (value, value)
    if len(sides) != 2:
        raise InvalidVehicleError(f"turning_radius: {value}; give one length, or two, to the left and to the right")
    left, right = (_number("turning_radius", side) for side in sides)
    if min(left, right) <= 0:
        side = "" if left == right else " to the left" if left <= 0 else " to the right"
        raise InvalidVehicleError(f"turning_radius: {sides[left > 0]}{side}; give a length above 0")
    if min(left, right) < Fraction(1, LARGEST):
        raise InvalidVehicleError("turning_radius: a length below 1e-150; scale the scene")
    return left, right


def _axle(value: Any) -> ExactPoint:
    parts = () if isinstance(value, str | bytes) else tuple(value)
    if len(parts) != 2:
        raise InvalidVehicleError(f"axle: {value!r}; give two numbers, x and y in the robot's frame")
    return _number("axle", parts[0]), _number("axle", parts[1])


def _wheelbase(value: Number) -> Fraction:
    length = _number("wheelbase", value)
    if length <= 0:
        raise InvalidVehicleError(f"wheelbase: {value}; give a length above 0")
    return length


def _heading(value: Angle) -> Fraction | None:
    tau, _, error = _read("heading", value)
    if error:
        assert tau is not None, "the half turn is exact"
        near = tau.limit_denominator(1000)
        degrees = math.degrees(2 * math.atan(float(near)))
        remedy = f'a multiple of 90deg, or {{"tau": "{near}"}}, which is {degrees:.9g}deg'
        number, unit = number_and_unit(value)  # type: ignore[arg-type]
        if not unit and abs(to_fraction(number)) > Fraction(math.tau):
            remedy = f"'{value}deg' if degrees are meant"
        raise InvalidVehicleError(
            f"heading: {value}{'' if unit else 'rad'}; the tangent of its half is not rational: give {remedy}"
        )
    return tau


def _read(name: str, value: Angle) -> tuple[Fraction | None, float, float]:
    try:
        return read_angle(value)
    except ValueError as error:
        raise InvalidVehicleError(f"{name}: {str(error).removeprefix('theta: ')}") from None


def _number(name: str, value: Number) -> Fraction:
    try:
        exact = to_fraction(value)
    except ValueError as error:
        raise InvalidVehicleError(f"{name}: {error}") from None
    if abs(exact) > LARGEST:
        raise InvalidVehicleError(f"{name}: a length beyond 1e150; scale the scene")
    return exact


def _is_beyond_a_turn(value: Angle) -> bool:
    """True if an angle is more than a right angle, although its tangent may not be."""
    if isinstance(value, dict):
        return False
    number, unit = number_and_unit(value)  # type: ignore[arg-type]
    size = to_fraction(number)
    return not 0 < size < (90 if unit == "deg" else Fraction(math.pi) / 2)


def _text(point: ExactPoint) -> str:
    return f"({point[0]}, {point[1]})"


def _heading_text(tau: Fraction | None) -> str:
    if tau == 0:
        return ""
    names: dict[Fraction | None, str] = {None: "180deg", Fraction(1): "90deg", Fraction(-1): "-90deg"}
    return f", heading={names.get(tau, f'tau {tau}')}"
