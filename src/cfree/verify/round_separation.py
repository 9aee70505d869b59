"""Check that a separation among grown cores is a proof, independently of the core library.

Every piece is a contact of smaller shapes; sides of pieces have partners; start and goal are on two sides. The scene's
shapes are larger by a rational margin. So all this may be decided in balls, up to distances far below the margin:
docs/theory/separations.md, Proposition 83.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator, Sequence
from fractions import Fraction
from typing import Any

from flint import arb, fmpq

from cfree.verify.result import Finding
from cfree.verify.round_algebra import precision
from cfree.verify.round_closure import loose
from cfree.verify.round_inside import margin
from cfree.verify.round_pieces import Piece, Reader, Scale
from cfree.verify.round_proof import RoundSeparation
from cfree.verify.round_sides import is_inside
from cfree.verify.round_surfaces import UNDECIDED, UndecidedError
from cfree.words import counted, listed

INSIDE, CONTACTS, CLOSED, SIDES = "smaller shapes", "contacts", "closed surface", "two sides"
BLOCK = 100  # pieces between two reports


def round_separation_findings(
    proof: RoundSeparation, scene: Any, report: Callable[[float], object] = lambda _: None
) -> Iterator[Finding]:
    """Findings about a separation among grown cores in a scene; none if it is a proof.

    Parameters
    ----------
    proof : RoundSeparation
    scene : Scene
        With the true shapes.
    report : function, optional
        Called with the share of pieces that are done.
    """
    least, wrong = margin(proof, scene)
    for where, text in wrong:
        yield Finding(INSIDE, where, text)
    if least is None:
        return
    size = size_of(proof)
    scale, bits = scale_of(least, size, len(proof))
    with precision(bits):
        yield from _findings(proof, least, size, scale, report)


def size_of(proof: RoundSeparation) -> Fraction:
    """Number that no coordinate and no radius exceeds."""
    points = [*proof.robot_features.points, *proof.obstacle_features.points]
    radii = [*proof.robot_features.radii, *proof.obstacle_features.radii]
    return max([Fraction(1), *radii, *(abs(c) for p in points for c in p)])


def scale_of(least: Fraction, size: Fraction, count: int) -> tuple[Scale, int]:
    """Precision for a margin: distances of the surface's gaps, all together, are far below it."""
    share = size / least
    digits = max(0, share.numerator.bit_length() - share.denominator.bit_length() + 1) + count.bit_length() + 24
    extent = max(0, size.numerator.bit_length() - size.denominator.bit_length() + 1)
    # places may move with the square root of an angle's change
    angles = 2 * digits + 2 * extent + 64
    bits = angles + 64
    near = least.numerator.bit_length() - least.denominator.bit_length() - 1 - count.bit_length() - 16
    return Scale(arb(2) ** near, bits), 3 * bits + 4 * extent + 128


def _findings(
    proof: RoundSeparation, least: Fraction, size: Fraction, scale: Scale, report: Callable[[float], object]
) -> Iterator[Finding]:
    reader, pieces = Reader(proof, scale), list[Piece]()
    for k in range(len(proof)):
        if k % BLOCK == 0:
            report(k / len(proof))
        piece = reader.piece_or_fault(k)
        if isinstance(piece, Piece):
            pieces.append(piece)
        else:
            yield Finding(CONTACTS, f"piece {k}", piece)
    if len(pieces) < len(proof):
        return
    decided = yield from side_findings(pieces, scale, CLOSED, "piece")
    if decided:
        yield from _two_sides(proof, pieces, scale, least, size)


def side_findings(pieces: Sequence[Piece], scale: Scale, kind: str, name: str) -> Generator[Finding, None, bool]:
    """Yield findings about sides without partner, of a kind; return True if all sides are decided."""
    try:
        for where, numbers in loose(pieces, scale):
            owners = listed([str(n) for n in numbers[:6]], "and")
            yield Finding(kind, where, f"a side of {counted(len(numbers), name)} ({owners}) has no partner")
    except UndecidedError as reason:
        yield Finding(kind, f"the {kind}", f"{UNDECIDED}{reason}")
        return False
    return True


def _two_sides(
    proof: RoundSeparation, pieces: list[Piece], scale: Scale, least: Fraction, size: Fraction
) -> Iterator[Finding]:
    inside = []
    shift = arb(fmpq(least.numerator, least.denominator)) / 16
    turn = shift / (arb(fmpq(size.numerator, size.denominator)) * 4)
    for name, pose in (("start", proof.start), ("goal", proof.goal)):
        try:
            inside.append(is_inside(pose, pieces, scale, shift, turn))
        except UndecidedError as reason:
            yield Finding(SIDES, name, f"{UNDECIDED}{reason}")
    if len(inside) == 2 and inside[0] == inside[1]:
        where = "inside" if inside[0] else "outside"
        yield Finding(SIDES, "start and goal", f"both are {where} the surface")
