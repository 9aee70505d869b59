"""
Cage a part
===========

Two fingers hold a part without touching it: no motion leads it away, and there is a proof. How far may the fingers
open, how few suffice, and when can the part not move at all?
"""

import cfree
from cfree.caging import critical_spread, fewest_fingers, immobility, is_caged

# %%
# A cage
# ------
#
# The part has two notches. A finger is a point, a disc, a polygon or another round shape; each stands still.

part = [(0, 0), (1, 0), (1, 2), (3, 2), (3, 0), (4, 0), (4, 5), (3, 5), (3, 3), (1, 3), (1, 5), (0, 5)]
fingers = [cfree.Curved.circle((2, 1), "1/4"), cfree.Curved.circle((2, 4), "1/4")]
cage = is_caged(part, fingers)
print(cage)
print("verified by other code:", cage.verified())

# %%
# Pale is what the part sweeps on a grid of its free poses. The closed surface at the right, around these poses, is the
# proof.

figure = cage.plot()

# %%
# Move the part: it cannot leave. Then move a finger away, by *Edit*.

page = cfree.viewer.page(cage.scene, cage.answer)

# %%
# One finger is not enough: the answer is a path.

free = is_caged(part, fingers[:1])
print(free.path)

# %%
# When the cage opens
# -------------------
#
# At the first number the part is still caged, with a proof, at the second one it escapes, on a path. The puncture is
# the place where it slips out.

opening = critical_spread(part, fingers)
print(opening)

figure = opening.opened.plot()

# %%
# The fewest fingers
# ------------------
#
# Each path out needs one of the fingers that block it. So no smaller set of these places is a cage.

places = [*fingers, (2, -1), (5, 2), (-1, 2)]
found = fewest_fingers(part, places)
print(found, found.fingers, "verified:", found.verified())

# %%
# Immobile
# --------
#
# Three points hold a triangle if their normals meet, by curvature alone; a little beside, and it turns.

triangle = [(0, 0), (12, 0), (0, 5)]
held = immobility(triangle, [(2, 0), (0, 2), ("36/13", "50/13")])
loose = immobility(triangle, [("2.5", 0), (0, 2), ("36/13", "50/13")])
print(held.sentence())
print(loose.sentence())

figure = held.plot()

# %%
# The same loose, with the velocity at which it leaves the points:

figure = loose.plot()
