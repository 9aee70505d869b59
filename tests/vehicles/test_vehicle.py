import math
import pickle
from fractions import Fraction
from typing import Any

import pytest

from cfree import Car, DifferentialDrive, InvalidVehicleError, Scene, plan


def test_numbers_are_exact() -> None:
    car = Car("4.1", axle=("-1.3", "1/3"), heading={"tau": "1/7"})
    assert (car.turning_radius, car.axle) == (Fraction(41, 10), (Fraction(-13, 10), Fraction(1, 3)))
    assert car.heading == car.frame.tau == Fraction(1, 7)
    assert DifferentialDrive(heading=math.pi).heading is None


def test_radii_to_both_sides_may_differ() -> None:
    car = Car((3, "3.5"))
    assert (car.radii, car.turning_radius) == ((3, Fraction(7, 2)), Fraction(7, 2))


@pytest.mark.parametrize(
    "vehicle", [Car(4), Car((1, 2), (3, 4), "90deg", "forward"), DifferentialDrive((1, 0), "180deg")]
)
def test_vehicles_are_compared_and_copied_by_content(vehicle: Car | DifferentialDrive) -> None:
    copy = pickle.loads(pickle.dumps(vehicle))
    assert copy == vehicle and hash(copy) == hash(vehicle)
    assert copy != Car(5)


@pytest.mark.parametrize("radius", [0, -1, "0", (4, 0), (-4, 4), math.nan, math.inf, "x", (1, 2, 3), ()])
def test_radii_that_no_car_has_are_refused(radius: object) -> None:
    with pytest.raises((InvalidVehicleError, TypeError), match="turning_radius"):
        Car(radius)  # type: ignore[arg-type]


@pytest.mark.parametrize("axle", [(math.nan, 0), (0, math.inf), (1,), (1, 2, 3), "12", ("a", "b")])
def test_axles_that_are_no_points_are_refused(axle: object) -> None:
    for make in (lambda: Car(1, axle), lambda: DifferentialDrive(axle)):  # type: ignore[arg-type]
        with pytest.raises((InvalidVehicleError, TypeError), match="axle"):
            make()


@pytest.mark.parametrize("heading", ["30deg", 0.3, "1rad", math.nan, "north", {"tau": "x"}])
def test_headings_without_a_rational_form_are_refused(heading: object) -> None:
    for make in (lambda: Car(1, heading=heading), lambda: DifferentialDrive(heading=heading)):  # type: ignore[arg-type]
        with pytest.raises(InvalidVehicleError, match="heading"):
            make()


def test_a_refused_heading_names_one_near_by() -> None:
    with pytest.raises(InvalidVehicleError, match=r'^heading: 30deg; .*\{"tau": "209/780"\}, which is 29.9999\d*deg$'):
        Car(1, heading="30deg")


def test_a_heading_beyond_a_turn_was_meant_in_degrees() -> None:
    with pytest.raises(InvalidVehicleError, match=r"^heading: 45rad; .*: give '45deg' if degrees are meant$"):
        Car(1, heading=45)
    with pytest.raises(InvalidVehicleError, match=r"^heading: 0.3rad; .*: give a multiple of 90deg, or \{"):
        Car(1, heading=0.3)


@pytest.mark.parametrize(
    ("radius", "said"),
    [
        (0, "0; give a length above 0"),
        ("-1/2", "-1/2; give a length above 0"),
        ((3, 0), "0 to the right; give a length above 0"),
        ((-2, 0), "-2 to the left; give a length above 0"),
        (math.nan, "nan is not finite; give a finite number"),
        ("x", "'x' is no number; write it like '0.1', '-2e3' or '1/3'"),
        ("1e151", "a length beyond 1e150; scale the scene"),
        ("1e-151", "a length below 1e-150; scale the scene"),
        (10**4000, "a length beyond 1e150; scale the scene"),
    ],
)
def test_the_error_of_a_radius_has_name_value_and_remedy(radius: Any, said: str) -> None:
    with pytest.raises(InvalidVehicleError) as caught:
        Car(radius)
    assert str(caught.value) == f"turning_radius: {said}"


def test_axles_beyond_all_lengths_are_refused() -> None:
    for make in (lambda axle: Car(1, axle), DifferentialDrive):
        with pytest.raises(InvalidVehicleError, match=r"^axle: a length beyond 1e150; scale the scene$"):
            make(("-1e151", 0))
        assert make((0, "1e150")).axle[1] == 10**150


def test_a_word_for_a_vehicle_is_refused_with_all_that_it_may_be() -> None:
    with pytest.raises(ValueError, match=r"^vehicle: 'car'; give a Car or a DifferentialDrive or \"any\"$"):
        plan(Scene([(0, 0), (1, 0), (0, 1)]), (0, 0, 0), (1, 0, 0), vehicle="car")  # type: ignore[arg-type]


@pytest.mark.parametrize("heading", [0, "0deg", "90deg", "-90deg", "450deg", math.pi, math.pi / 2, {"tau": "inf"}])
def test_right_angles_are_rational(heading: object) -> None:
    assert Car(1, heading=heading).heading in (0, 1, -1, None)  # type: ignore[arg-type]


@pytest.mark.parametrize("degrees", [1, 20, 35, 44.9, 60, 89])
def test_the_radius_of_a_wheelbase_is_rounded_up(degrees: float) -> None:
    radius = Car.with_wheelbase("2.7", f"{degrees}deg").turning_radius
    exact = 2.7 / math.tan(math.radians(degrees))
    assert exact * (1 - 1e-15) < radius < exact * (1 + 3e-12)


@pytest.mark.parametrize(
    ("wheelbase", "angle"),
    [(0, "35deg"), (-1, "35deg"), (2, 0), (2, "-30deg"), (2, "90deg"), (2, "370deg"), (2, math.nan)],
)
def test_wheelbases_and_steering_angles_out_of_range_are_refused(wheelbase: object, angle: object) -> None:
    with pytest.raises(InvalidVehicleError, match=r"wheelbase|steering_angle"):
        Car.with_wheelbase(wheelbase, angle)  # type: ignore[arg-type]


def test_unknown_gears_are_refused() -> None:
    with pytest.raises(ValueError, match="gears"):
        Car(1, gears="reverse")  # type: ignore[arg-type]
