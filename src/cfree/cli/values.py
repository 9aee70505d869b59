"""Values of the options of the command line, read from their texts."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Literal

from cfree.words import counted

if TYPE_CHECKING:
    from cfree.exact.half_angle import Angle
    from cfree.exact.pose import Pose
    from cfree.paths.preferences import Preferences
    from cfree.vehicles.vehicle import Vehicle


def read_numbers(text: str) -> list[int]:
    try:
        return [int(number) for number in text.split(",")]
    except ValueError:
        raise ValueError(f'--only: {text!r}; give numbers of figures, as in "7" or "7,9"') from None


def read_angle(text: str, name: str) -> Angle:
    """Read an angle as `Pose` takes it; ``tau:p/q`` gives the tangent of its half.

    Raises
    ------
    ValueError
        If the text is no angle, or has no unit and is more than a whole turn in radians.
    """
    from cfree.exact.half_angle import require_unit
    from cfree.exact.pose import Pose

    text = text.strip()
    angle: Angle = {"tau": text.removeprefix("tau:")} if text.startswith("tau:") else text
    try:
        Pose(0, 0, angle)
        if isinstance(angle, str):
            require_unit(angle)
    except ValueError as error:
        raise ValueError(f"{name}: {str(error).removeprefix('theta: ')}") from None
    return angle


def read_pose(text: str | None, name: str) -> Pose | None:
    """Read a pose, such as "1,1/2,30deg"."""
    from cfree.exact.pose import Pose

    if text is None:
        return None
    parts = [part.strip() for part in text.split(",")]
    if len(parts) != 3:
        raise ValueError(f'{name}: {text!r}: {counted(len(parts), "number")}; give X,Y,THETA as in "1,1/2,30deg"')
    x, y, theta = parts
    angle = read_angle(theta, f"{name}: {text!r}")
    try:
        return Pose(x, y, angle)
    except ValueError as error:
        raise ValueError(f'{name}: {text!r}: {error}; give X,Y,THETA as in "1,1/2,30deg"') from None


def read_goals(texts: Sequence[str]) -> list[Any]:
    """Read poses, and places such as "1,1/2"."""
    return [text.split(",") if text.count(",") == 1 else read_pose(text, "--goal") for text in texts]


def read_seconds(text: str) -> float:
    """Read seconds, from "2s", "500ms" or "2"."""
    number, factor = (text.removesuffix("ms"), 1e-3) if text.endswith("ms") else (text.removesuffix("s"), 1.0)
    try:
        seconds = float(number) * factor
    except ValueError:
        seconds = math.nan
    if not 0 <= seconds < math.inf:
        raise ValueError(f'--improve: {text!r}; give a time such as "2s" or "500ms"')
    return seconds


def require_near(text: str, *numbers: Fraction) -> None:
    """Raise a `ValueError` if a number is beyond the range of coordinates."""
    from cfree.polygons.repair import FARTHEST

    if any(abs(number) > FARTHEST for number in numbers):
        raise ValueError(f"{text} is beyond 1e150, the largest coordinate; give a smaller number")


def read_length(text: str, name: str, what: str = "a length") -> Fraction:
    """Read a length or a speed above 0, exactly."""
    from cfree.exact.number import to_fraction

    try:
        length = to_fraction(text)
    except ValueError:
        length = Fraction(0)
    if length <= 0:
        raise ValueError(f'{name}: {text!r}; give {what} above 0 such as "0.3" or "1/3"')
    require_near(f"{name}: {text!r}", length)
    return length


def read_turn(text: str) -> float:
    """Read the largest rotation between two poses: radians above 0, at most a whole turn."""
    from cfree.exact.half_angle import number_and_unit
    from cfree.exact.number import to_fraction
    from cfree.exact.pose import Pose

    angle = read_angle(text, "--turn")
    if not isinstance(angle, str):
        return Pose(0, 0, angle).theta or math.tau
    value, unit = number_and_unit(angle)
    turn = float(to_fraction(value))
    if turn <= 0:
        raise ValueError(f"--turn: {text}; give an angle above 0 such as 5deg")
    return min(math.radians(turn) if unit == "deg" else turn, math.tau)


def read_preferences(text: str | None) -> Preferences:
    """Read the costs of motions, from "sideways=5,turning=2"."""
    from cfree.paths.preferences import Preferences

    names = Preferences.__dataclass_fields__
    try:
        pairs = [part.partition("=") for part in (text.split(",") if text is not None else ())]
        if wrong := next((name for name, _, _ in pairs if name.strip() not in names), None):
            raise ValueError(f"no {wrong.strip()!r}")
        return Preferences(**{name.strip(): float(value) for name, _, value in pairs})
    except ValueError as error:
        raise ValueError(f'--prefer: {text!r}: {error}; give some of {", ".join(names)}, as in "sideways=5"') from None


def read_vehicle(
    kind: str | None, radius: str | None, axle: str | None, heading: str | None, gears: str | None
) -> Vehicle | Literal["any"] | None:
    """Read a vehicle; None if no option is given, "any" for a robot that moves in any direction.

    Raises
    ------
    ValueError
        If an option does not belong to the vehicle, or is missing.
    """
    from cfree.errors import InvalidVehicleError
    from cfree.vehicles.vehicle import Car, DifferentialDrive

    given = {"--turning-radius": radius, "--axle": axle, "--heading": heading, "--gears": gears}
    allowed = {"car": set(given), "differential": {"--axle", "--heading"}, "forklift": {"--axle", "--heading"}}
    wrong = [name for name, value in given.items() if value is not None and name not in allowed.get(kind or "", set())]
    if wrong:
        cars = "of a car only; give --vehicle car" if kind is None else f"not of --vehicle {kind}; leave it out"
        raise ValueError(f"{', '.join(wrong)}: {'of a vehicle; give --vehicle' if kind is None else cars}")
    if kind is None or kind == "any":
        return "any" if kind else None
    if kind == "car" and radius is None:
        raise ValueError("--vehicle car: no turning radius; give --turning-radius")
    members: dict[str, Any] = {}
    if axle is not None:
        members["axle"] = _two(axle, "--axle", "two numbers such as 1.5,0")
    if heading is not None:
        members["heading"] = read_angle(heading, "--heading")
    if radius is not None:
        form = "a length, or two, to the left and to the right, such as 4,4.5"
        members["turning_radius"] = _two(radius, "--turning-radius", form) if "," in radius else radius
    if gears is not None:
        members["gears"] = gears
    try:
        return Car(**members) if kind == "car" else DifferentialDrive(**members)
    except InvalidVehicleError as error:
        name, _, rest = str(error).partition(": ")
        rest = re.sub(r'\{"tau": "([^"]+)"\}', r"tau:\1", rest)
        raise ValueError(f"--{name.replace('_', '-')}: {rest}") from None


def _two(text: str, name: str, form: str) -> tuple[str, str]:
    parts = text.split(",")
    if len(parts) != 2:
        raise ValueError(f"{name}: {text!r}; give {form}")
    return parts[0], parts[1]


def read_size(text: str) -> float:
    """Read bytes, from "500MB", "1.5 GB" or "2e9"."""
    units = {"KB": 1e3, "MB": 1e6, "GB": 1e9, "TB": 1e12}
    unit = text.strip().upper()[-2:]
    try:
        size = float(text.strip()[: -2 if unit in units else None]) * units.get(unit, 1)
    except ValueError:
        size = 0
    if not size > 0:
        raise ValueError(f'--max-memory: {text!r}; give a size such as "500MB" or "4GB"')
    return size


def read_pixels(text: str) -> tuple[int, int]:
    """Read width and height, from "1280x720"."""
    try:
        width, height = map(int, text.lower().split("x"))
    except ValueError:
        raise ValueError(f'--size: {text!r}; give width and height such as "1280x720"') from None
    return width, height
