"""
Round shapes
============

Discs, arcs, splines and rounded corners: paths and proofs that hold for the true curves.
"""

import cfree
from cfree.curves import Arc, Spline

# %%
# Shapes
# ------
#
# A trolley with rounded corners is a rectangle grown by a disc. Pillars are discs, and a counter is a path of lines and
# arcs; a pond is a closed spline. All of their numbers are exact.

trolley = cfree.Curved([("-0.6", "-0.2"), ("0.6", "-0.2"), ("0.6", "0.2"), ("-0.6", "0.2")], grown="0.15")
pillars = [cfree.Curved.circle((x, y), "0.3") for x, y in ((3, "1.2"), (3, "2.8"), ("4.6", 2), (9, 1), (9, "2.4"))]
counter = cfree.Curved([(6, 0), ("7.6", 0), ("7.6", "1.5"), Arc(("6.8", "2.3"), center=("6.8", "1.5")), (6, "2.3")])
pond = cfree.Curved([(6, "5.2"), Spline([(5, "3.6"), (7, 3), ("8.8", "4"), ("8.4", "5.4"), (7, "4.6"), (6, "5.2")])])
room = [(0, 0), (11, 0), (11, 6), (0, 6)]
ends = {"start": cfree.Pose("1.3", 2), "goal": cfree.Pose(10, "1.4", "90deg")}
scene = cfree.Scene(trolley, [*pillars, counter, pond], workspace=room, units="m", name="a trolley", **ends)
print(scene)

# %%
# A path
# ------
#
# For the pond's spline the planner searches a scene of polygons around the shapes, which forbids all that is forbidden
# here. So the path is free for the shapes themselves. The answer holds these polygons, and they are checked against the
# curves in rationals. Among lines and circular arcs alone it would need none.

path = cfree.plan(scene)
print(path, path.scene, sep="\n")
print(cfree.verify.answer(scene, path).verdict)
figure = cfree.plot.picture(path, scene)

# %%
# `is_free` decides about poses, among lines and circular arcs exactly: the last of these discs touches the other, which
# is free. Among splines, Bézier curves and ellipses it returns None where polygons within the tolerance do not decide.

disc = cfree.Curved.circle((0, 0), 1)
two = cfree.Scene(disc, [cfree.Curved.circle((3, 0), 1)])
print(cfree.is_free(two, [(0, 0, 0), (2, 0, 0), (1, 0, 0)]))

# %%
# A proof
# -------
#
# ``grown`` adds room all around the trolley. With 0.2 m more it does not get to the goal. The proof uses a scene of
# polygons inside of the shapes: poses that no path joins there are not joined among the shapes either.

wide = scene.grown("0.2")
proof = cfree.plan(wide)
print(proof, proof.scene, sep="\n")
print(cfree.verify.answer(wide, proof).verdict)
figure = cfree.plot.picture(proof, wide)

# %%
# Polygons
# --------
#
# Functions that accept no curves accept polygons around them, ``outer``, or inside, ``inner``, with a stated error. The
# whole boundary of the forbidden space is between those of the two.

for polygons in (scene.outer(0.02), scene.inner(0.02)):
    space = cfree.free_space(cfree.boundary(polygons))
    print(polygons, [f"{cell.volume:.2f}" for cell in space.cells])
