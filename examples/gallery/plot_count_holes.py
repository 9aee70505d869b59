"""
Count the holes of a configuration space
========================================

Cells of the free space are bodies with handles and cavities. Their Betti numbers come from counting faces, edges and
vertices; loops on their surfaces show them.
"""

import cfree

# %%
# A room with a pillar
# --------------------
#
# A rod in a room goes around a pillar, and turns. How many independent loops has its cell? Longer rods can no longer
# turn everywhere: they pass the pillar at some orientations only, and each of these passages is a loop more.

hall, pillar = [(0, 0), (20, 0), (20, 9), (0, 9)], [(9, 4), (10, 4), (10, 5), (9, 5)]


def cells(robot: list[tuple[float, float]]) -> tuple[cfree.free.Cell, ...]:
    return cfree.free_space(cfree.boundary(cfree.Scene(robot, [pillar], workspace=hall))).cells


for length in (1, 2, 4, 6):
    rod = [(-length / 2, 0), (length / 2, 0), (length / 2, 0.5), (-length / 2, 0.5)]
    for cell in cells(rod):
        print(length, "long:", cell.homology, "Euler number", cell.homology.euler, "turns", cell.turns)

# %%
# For the short rod the cell is the room without the pillar, times a circle: one loop around the pillar, one in theta,
# and the pillar at all orientations as an island. Its b2 counts islands. The island of the long rods is joined to the
# walls, and b2 is 0.
#
# The count again
# ---------------
#
# The Euler number of a cell is half of that of the closed surfaces around it, which counts their faces.

(cell,) = cells([(-2, 0), (2, 0), (2, 0.5), (-2, 0.5)])
complex = cell.free_space.complex
print(sum(int(complex.euler[k]) for k in cell.components) / 2, cell.homology.euler)

# %%
# Loops
# -----
#
# Each handle of a surface has two loops of edges; together they generate the first homology group. `turns` counts how
# often a loop goes round in theta.

triangle = [(0, 0), (2, 0), (0, 1)]
scene = cfree.Scene(triangle, [pillar], workspace=hall)
(cell,) = cfree.free_space(cfree.boundary(scene)).cells
print(cell.homology, [loop.turns for loop in cfree.free.surface_loops(cell)])
figure = cfree.plot.plot_loops(cell).figure

# %%
# Click a free place in the page: it tells the cell of that pose.

page = cfree.viewer.page(scene)
