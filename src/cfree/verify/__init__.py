"""An independent check of computed boundaries: `cfree.verify.boundary`, and ``cfree verify`` on the command line.

Nothing here calls the C++ core, and no sign is decided but in Python's integers and fractions and in python-flint. From
the scene's exact coordinates and the file:

=================  ==========================================================================================  =======
convex pieces      those of robot and obstacles are convex and tile them                                       PROVED
critical angles    the polynomial that the names define has exactly one root in the interval (or the place-th
                   is meant), in the chart, and the first is less than the second                              PROVED
domains            from the first angle to the second the contact is in its range, and
                   0 <= lower <= upper <= 1 without a pole                                                     PROVED
not forbidden      an exact point of every trapezoid is on its contact and inside no pair of pieces            SAMPLED
closed surface     the oriented boundary of the sum of all trapezoids is zero: on every curve, and on every
                   line at every critical angle, what ends there begins there                                  PROVED
nothing missing    at some exact angles, the slice computed from scratch is the file's slice                   SAMPLED
=================  ==========================================================================================  =======

"Not forbidden" says nothing about the rest of a trapezoid, "nothing missing" nothing about other angles. Curves are told
apart by their equations in the configuration space, angles by their irreducible polynomials, points by elements of the
angle's number field; 32-byte hashes stand for them when they are counted.

Files, each importing only from those before it: `algebra` (roots), `surfaces` (contacts and curves), `world` (the scene),
`trapezoids`, `slices`, `result`, `driver`.
"""

from cfree.verify.driver import boundary as boundary
from cfree.verify.result import Check as Check
from cfree.verify.result import Finding as Finding
from cfree.verify.result import Verification as Verification

__all__ = ["Check", "Finding", "Verification", "boundary"]
