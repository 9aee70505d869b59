"""
Take it apart
=============

Three parts in a frame, and a key in its housing: which part leaves first, which one is held, and by what?
"""

from pathlib import Path

import cfree
from cfree.disassembly import Assembly, can_leave, missing_gap, removal_order, what_blocks

# %%
# An order
# --------
#
# Each shape of the file is a part at its place. The frame stays.

examples = Path("examples") if Path("examples").exists() else Path("..")
shapes = cfree.load_shapes(examples / "cages/frame.geojson").shapes
parts = Assembly({shape.name: shape.polygon for shape in shapes}, fixed=["frame"])
found = removal_order(parts)
print("out:", ", ".join(found.order), "- put together:", ", ".join(found.assembly_order))
print("verified by other code:", found.verified())

figure = found.plot()

# %%
# What blocks
# -----------
#
# The left block is held as long as the wedge is there. The proof is a closed surface of contacts.

held = can_leave("left block", parts)
print(held)
print(what_blocks("left block", parts))

figure = held.plot()

# %%
# How much is missing
# -------------------
#
# A smaller block would leave: with all edges moved inwards by the second number.

print(missing_gap("left block", parts))

# %%
# A puzzle that needs turning
# ---------------------------
#
# At the orientation in which it lies, the place of the key is enclosed: it leaves with a turn, or not at all.

shapes = cfree.load_shapes(examples / "cages/puzzle.geojson").shapes
puzzle = Assembly({shape.name: shape.polygon for shape in shapes}, fixed=["housing"])
out = can_leave("key", puzzle)
print(out.path, "- verified:", out.verified())
cut = cfree.boundary(out.scene).slice(0)
print("enclosed at its orientation:", any(part.interiors for part in getattr(cut.forbidden, "geoms", [cut.forbidden])))

figure = out.plot()

# %%
# Drag the key: it stops where it touches the housing.

page = cfree.viewer.page(out.scene, out.answer)
