"""An independent check of computed boundaries: `cfree.verify.boundary`, and ``cfree verify`` on the command line.

Nothing here calls the C++ core; every sign is one of Python's integers and fractions or of python-flint. The checks:

convex pieces, PROVED
    Those of robot and obstacles are convex and tile them.
names and angles, PROVED
    A trapezoid's patch is a contact of the scene. The polynomial that an angle's names define has one root in the
    interval, or the place-th is meant; it is in the chart, and the first angle is less than the second.
domains, PROVED
    From the first angle to the second the contact is in its range, the curves have no pole, 0 <= lower <= upper <= 1.
not forbidden, SAMPLED
    At one exact point inside every trapezoid no pair of pieces overlaps, and bounds are kept.
closed surface, PROVED
    The oriented boundary of the sum of all trapezoids is zero: on every curve, and on every line at every critical
    angle, what ends there begins there.
nothing missing, SAMPLED
    At some exact angles the boundary of the forbidden slice, computed from scratch, is the file's slice.

"Not forbidden" says nothing of the rest of a trapezoid, "nothing missing" nothing of other angles. Curves are told
apart by their equations, angles by irreducible polynomials, points by elements of the angle's number field; 32-byte
hashes stand for them when they are counted. Only `features` is believed: that it numbers features as the file does.
Isolated parts, at which the robot fits exactly, and the cell complex are not looked at.

Each file imports only from those before it: `algebra` (roots), `surfaces` (contacts and curves), `world` (the scene),
`trapezoids`, `slices`, `result`, `driver`.
"""

from cfree.verify.driver import boundary as boundary
from cfree.verify.result import Check as Check
from cfree.verify.result import Finding as Finding
from cfree.verify.result import Verification as Verification

__all__ = ["Check", "Finding", "Verification", "boundary"]
