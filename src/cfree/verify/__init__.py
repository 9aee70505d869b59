"""An independent check of boundaries and answers: `cfree.verify.boundary`, `answer`, and ``cfree verify``.

The C++ core reads the scene, and no other part of it is used here. Every sign is decided by Python's integers and
fractions or by python-flint. The checks:

convex pieces, PROVED
    The pieces of robot and obstacles are convex and tile them.
names and angles, PROVED
    A trapezoid's patch is a contact of the scene. The polynomial that an angle's names define has one root in the
    interval, or the place-th is meant. The angle is in the chart, and the first angle is less than the second.
    From the first angle to the second the contact is in its range, the curves have no pole, 0 <= lower <= upper <= 1.
not forbidden, SAMPLED
    At one exact angle in every trapezoid nothing covers any of it, from lower to upper.
closed surfaces, PROVED
    Along every edge the sides of trapezoids are partners across free space; V - E + F of the result is counted.
isolated parts, PROVED but for curves
    Each is free, is on no trapezoid and no other part, and next to it nothing is free at its angle. For a curve this is
    SAMPLED at three angles.
nothing missing, SAMPLED
    At some exact angles, critical ones among them, all free contacts computed from scratch are those of the file.

"Not forbidden" and "nothing missing" make no statement about other angles. Curves are told apart by their equations,
angles by irreducible polynomials, positions by elements of the angle's number field; 32-byte hashes stand for curves
and lines when sides are gathered. Two things are trusted: polygons hold the scene's numbers, and `features` numbers
features as the file does.

Boundaries of rounded shapes have other code, in `round_boundary`; docs/verify.md.

Each file imports only from the ones before it: `surfaces` (contacts, curves, lines), `polygons`, `world` (the scene),
`section` (the scene at one angle), `trapezoids` (the file), `isolated`, `matching`, `missing`, `angles`, `result`,
`driver`. Answers, checked by `cfree.verify.answer`, have `inside` (polygons in polygons), `motions`, `parity` (rays),
`separation`, `answers`; everything about them is PROVED.
"""

from cfree.verify.answers import answer as answer
from cfree.verify.driver import boundary as boundary
from cfree.verify.result import Check as Check
from cfree.verify.result import Finding as Finding
from cfree.verify.result import Verification as Verification

__all__ = ["Check", "Finding", "Verification", "answer", "boundary"]
