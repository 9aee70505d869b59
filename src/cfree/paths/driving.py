"""`is_drivable`: decide exactly if a vehicle can drive a path."""

from __future__ import annotations

from dataclasses import dataclass

from cfree.arguments import checked
from cfree.paths.driven import first_fault
from cfree.paths.path import Path
from cfree.vehicles.vehicle import Vehicle


@checked
@dataclass(frozen=True)
class Drivable:
    """The answer of `is_drivable`; true if the vehicle can drive the whole path.

    Parameters
    ----------
    motion : int or None
        The first motion that it cannot do, counted from 0.
    why : str
        The reason; empty if it can drive the path.
    """

    motion: int | None = None
    why: str = ""

    def __bool__(self) -> bool:
        return self.motion is None


@checked
def is_drivable(path: Path, vehicle: Vehicle) -> Drivable:
    """Decide exactly if a vehicle can drive a path.

    Collisions do not matter here: `Path.is_free` decides about them. Nor does the path's own vehicle.

    Parameters
    ----------
    path : Path
        Of any origin, such as of a planner without vehicles.
    vehicle : Car or DifferentialDrive

    Returns
    -------
    Drivable
        True or false; if false, the first motion that the vehicle cannot do, and why.

    Examples
    --------
    >>> from cfree import Car, Path, Pose, Rotation, Translation
    >>> path = Path(Pose(0, 0), [Translation((3, 0)), Rotation((3, 2), "90deg"), Translation((1, 0))])
    >>> is_drivable(path[:2], Car(2)), bool(is_drivable(path[:2], Car(2)))
    (Drivable(motion=None, why=''), True)
    >>> is_drivable(path[:2], Car(3))
    Drivable(motion=1, why='its radius is 2, and the least to the left is 3')
    >>> is_drivable(path, Car(2))
    Drivable(motion=2, why='it moves the axle point sideways')
    """
    fault = first_fault(vehicle, path.poses, path.motions)
    return Drivable(*fault) if fault else Drivable()
