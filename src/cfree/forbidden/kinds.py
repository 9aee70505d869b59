"""Kinds of patches, and their colours in every picture."""

from __future__ import annotations

from enum import IntEnum

from cfree.contact.kind import Kind
from cfree.palette import ARC_ARC, BOUND, EDGE_VERTEX, VERTEX_EDGE


class PatchKind(IntEnum):
    """Kind of contact on a patch; contacts of the reference point with the bounds are a kind of their own."""

    VERTEX_EDGE = Kind.VERTEX_EDGE
    EDGE_VERTEX = Kind.EDGE_VERTEX
    BOUND = 3
    ARC_ARC = 4
    """An arc on an arc or on a vertex: a quadrant of a circle."""


KINDS = {
    PatchKind.VERTEX_EDGE: "v-e",
    PatchKind.EDGE_VERTEX: "e-v",
    PatchKind.BOUND: "bound",
    PatchKind.ARC_ARC: "arc-arc",
}
COLOURS = {PatchKind.VERTEX_EDGE: VERTEX_EDGE, PatchKind.EDGE_VERTEX: EDGE_VERTEX, PatchKind.BOUND: BOUND}
COLOURS[PatchKind.ARC_ARC] = ARC_ARC
