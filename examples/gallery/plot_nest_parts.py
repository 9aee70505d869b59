"""
Nest parts
==========

Parts of a drawing on a sheet: no-fit polygons with their exact fits, a layout without overlap, checked and compacted.
"""

import math
from pathlib import Path

import cfree
from cfree.nesting import Nesting, Part, RotationalNFP, can_be_cut_free, compact, load_nesting, nfp, overlaps, place

# %%
# No-fit polygons
# ---------------
#
# A key fits its slot on a segment of positions, which has no width. The picture marks it.

slot = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (3, 2), (3, 3), (0, 3)]
key = [(0, 0), (1, 0), (1, 1), (0, 1)]
fit = nfp(slot, key)
print(fit, fit.segments)
figure = fit.plot()

# %%
# At which angles does a triangle fit into a hole? The no-fit polygon then has a hole as well.

plate = cfree.Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(2, 2), (6, 2), (2, 5)]])
turning = RotationalNFP(plate, [(0, 0), (2, 0), (0, 2)])
for change in turning.topology_changes:
    print(f"{math.degrees(change.angle.theta):8.4f} degrees: holes {change.before[1]} -> {change.after[1]}")

# %%
# Turn the triangle in the page: its forbidden region at an angle is the no-fit polygon.

page = cfree.viewer.page(cfree.Scene([(0, 0), (2, 0), (0, 2)], [plate], start=("2.5", "2.5", 0)))

# %%
# Place
# -----
#
# The drawing has a sheet and five parts. Each goes to its lowest position, then the leftmost, decided exactly; the plug
# goes into the hole of the frame.

examples = Path("examples") if Path("examples").exists() else Path("..")
job = load_nesting(examples / "drawings/parts.svg")
layout = place(job)
print(layout, overlaps(layout))
figure = layout.plot()

# %%
# Cuts 0.2 wide, with a gap of 2 between them:

cut = place(job, [[(0, 0), (150, 0), (150, 100), (0, 100)]], gap=2, kerf="0.2")
figure = cut.plot()

# %%
# Check and compact
# -----------------
#
# Two of these parts overlap by a thousandth. The answer has the least translation that frees them.

wedge = Part([(0, 0), (4, 0), (0, 3)], "wedge")
tile = Part([(0, 0), (3, 0), (3, 3), (0, 3)], "tile")
sheet = [(0, 0), (14, 0), (14, 8), (0, 8)]
wrong = Nesting([sheet], [cfree.nesting.Placed(tile, (1, 1, 0)), cfree.nesting.Placed(tile, ("3.999", 2, 0))])
print(*overlaps(wrong))

# %%
# Compaction slides and turns parts by motions that are free as a whole.

loose = Nesting(
    [sheet],
    [cfree.nesting.Placed(tile, (2, 2, "20deg")), cfree.nesting.Placed(wedge, (7, 3, "40deg"))],
)
result = compact(loose, "down")
print(result)
figure = result.nesting.plot()

# %%
# Each part of this layout can leave the sheet, past the other one.

print([can_be_cut_free(result.nesting, k) for k in range(2)])
