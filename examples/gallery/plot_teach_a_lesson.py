"""
Teach a lesson
==============

Configuration spaces for a class: sums of polygons, cells, a proof that there is no path, and a number to bet on.
"""

import cfree

# %%
# A robot becomes a point
# -----------------------
#
# A square that does not turn is a point among obstacles that are grown by it. At 0 degrees the forbidden region of a
# box has the area (2 + 1)^2. Let the class guess the area at 45 degrees. It is 2^2 + 1^2 and 4 times the square root
# of 2.

square, box = [(0, 0), (1, 0), (1, 1), (0, 1)], [(3, 3), (5, 3), (5, 5), (3, 5)]
scene = cfree.Scene(square, [box], bounds=(0, 0, 9, 9), start=(1, 1, 0), goal=(7, 6, "90deg"))
boundary = cfree.boundary(scene)
for angle in ("0deg", "45deg"):
    print(angle, round(boundary.slice(angle).forbidden.intersection(cfree.Polygon(box).to_shapely().buffer(2)).area, 3))
figure = cfree.plot.plot_slice(boundary.slice("45deg")).figure

# %%
# All angles at once: the slices stand above each other, and their rims are the contact patches.

figure = cfree.plot.plot_overview(boundary)

# %%
# Drag the square in the page, and turn it by its knob. Its point in the right view stops at the surface.

page = cfree.viewer.page(scene)

# %%
# Cells
# -----
#
# A rod in a corridor: how many cells has its free space, and in which of them can the rod turn round?

rod = [(-2, 0), (2, 0), (2, "0.2"), (-2, "0.2")]
corridor = [(0, 0), (12, 0), (12, "2.5"), (0, "2.5")]
free = cfree.free_space(cfree.boundary(cfree.Scene(rod, workspace=corridor)))
print(len(free.cells), "cells; turns:", [cell.turns for cell in free.cells])

# %%
# No path, proved
# ---------------
#
# A sofa does not get round this corner. The surface separates start and goal; other code checks it.

sofa = [(-1, "-0.45"), (1, "-0.45"), (1, "0.45"), (-1, "0.45")]
flat = [(0, 0), (4, 0), (4, 4), ("2.7", 4), ("2.7", "1.3"), (0, "1.3")]
moving = cfree.Scene(sofa, workspace=flat, start=(1, "0.65", 0), goal=("3.35", 3, "90deg"), name="a sofa")
proof = cfree.plan(moving)
print(cfree.verify.answer(moving, proof).verdict)
figure = cfree.plot.picture(proof, moving)

# %%
# How much is missing? Let the class bet before this line runs. By hand, at 45 degrees, the corner needs (1 + 0.9) /
# 2 ** 0.5 = 1.3435.

print(cfree.smallest_aisle(sofa, "corner", tolerance=0.001))
