"""Kinds of patches, and their colours in every picture."""

from __future__ import annotations

from enum import IntEnum

from cfree.contact.kind import Kind


class PatchKind(IntEnum):
    """Whose contacts a patch holds; those of the reference point with the bounds are a kind of their own."""

    VERTEX_EDGE = Kind.VERTEX_EDGE
    EDGE_VERTEX = Kind.EDGE_VERTEX
    BOUND = 3


KINDS = {PatchKind.VERTEX_EDGE: "v-e", PatchKind.EDGE_VERTEX: "e-v", PatchKind.BOUND: "bound"}
COLOURS = {PatchKind.VERTEX_EDGE: "#d7301f", PatchKind.EDGE_VERTEX: "#3a9a3a", PatchKind.BOUND: "#b4b9c1"}
"""Colour of each kind of patch: the paper's red and green, and light grey for the bounds."""
