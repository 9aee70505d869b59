"""The trimmed patches and the exact fits, as columns."""

from __future__ import annotations

from dataclasses import dataclass, fields

from cfree.exact.half_angle import theta_in
from cfree.libraries import Codes, Floats, Int32s, NDArray, np
from cfree.value import Value

Ints = Int32s
CURVE, SEGMENT, POINT = 1, 2, 3


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Trapezoids(Value):
    """The live parts of the patches, as columns of equal length T.

    In its patch's domain (t, theta) a trapezoid lies between two critical angles and two curves. Curves and angles are
    named by the features that define them, packed as ``kind << 61 | robot feature << 31 | obstacle feature``.
    `Boundary.trapezoid` returns readable objects; ``docs/boundary-format.md`` defines every column.

    Attributes
    ----------
    patch : (T,) int32
    chart : (T,) uint8, 0 or 1
    lower, upper : (T,) uint64
        Names of the two curves.
    from_first, from_second, to_first, to_second : (T,) uint64
        Names of the two angles.
    from_lo, from_hi, to_lo, to_hi : (T,) float64
        Isolating intervals of tau in the chart.
    from_place, to_place : (T,) uint8
        0: the only root in the interval. If doubles cannot separate roots: its number among those there.
    """

    patch: Ints
    chart: NDArray[np.uint8]
    lower: Codes
    upper: Codes
    from_first: Codes
    from_second: Codes
    from_lo: Floats
    from_hi: Floats
    from_place: NDArray[np.uint8]
    to_first: Codes
    to_second: Codes
    to_lo: Floats
    to_hi: Floats
    to_place: NDArray[np.uint8]

    def __len__(self) -> int:
        return len(self.patch)

    @property
    def tau_from(self) -> Floats:
        return 0.5 * (self.from_lo + self.from_hi)

    @property
    def tau_to(self) -> Floats:
        return 0.5 * (self.to_lo + self.to_hi)

    @property
    def theta_from(self) -> Floats:
        """Radians, in [-pi/2, 3 pi/2]."""
        return theta_in(self.chart, self.tau_from)

    @property
    def theta_to(self) -> Floats:
        """Radians, in [-pi/2, 3 pi/2]; not less than `theta_from`."""
        return theta_in(self.chart, self.tau_to)

    @property
    def lower_kind(self) -> NDArray[np.uint8]:
        """Kind of the lower curve: 1 on a v-e surface, 2 on an e-v surface, 3 a v-v helix."""
        return (self.lower >> np.uint64(61)).astype(np.uint8)

    @property
    def upper_kind(self) -> NDArray[np.uint8]:
        return (self.upper >> np.uint64(61)).astype(np.uint8)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class IsolatedParts(Trapezoids):
    """Exact fits that are on no trapezoid: free curves, segments, arcs and points.

    They have the same columns as `Trapezoids`, of trapezoids without width, and the patches that name their curves and
    angles. No two of them overlap, and none lies on a trapezoid of the boundary, though it may end on one.

    Attributes
    ----------
    lower_patch, upper_patch, from_patch, to_patch : (T,) int32
        The patch on whose surface the name of `lower`, `upper` or an angle is meant.
    first_t, last_t : (T,) float64
        Its two ends: t on the surface of `lower_patch` at `theta_from`, and on that of `upper_patch` at `theta_to`.
    """

    lower_patch: Ints
    upper_patch: Ints
    from_patch: Ints
    to_patch: Ints
    first_t: Floats
    last_t: Floats

    @property
    def kind(self) -> NDArray[np.uint8]:
        """Kinds: 1 a curve over an interval of orientations, 2 a segment or an arc at one orientation, 3 a point."""
        turns = (self.from_first != self.to_first) | (self.from_second != self.to_second) | (self.from_lo != self.to_lo)
        turns |= (self.from_place != self.to_place) | (self.from_patch != self.to_patch)
        is_point = (self.lower == self.upper) & (self.lower_patch == self.upper_patch)
        return np.where(turns, CURVE, np.where(is_point, POINT, SEGMENT)).astype(np.uint8)

    def rows(self, which: slice) -> IsolatedParts:
        """Return some of the parts."""
        return IsolatedParts(*(getattr(self, name)[which] for name in ISOLATED_COLUMNS))


COLUMNS = tuple(f.name for f in fields(Trapezoids))
ISOLATED_COLUMNS = tuple(f.name for f in fields(IsolatedParts))
CODED = ("lower", "upper", "from_first", "from_second", "to_first", "to_second")
