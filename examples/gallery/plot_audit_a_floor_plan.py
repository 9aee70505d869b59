"""
Audit a floor plan
==================

Which doors of a clinic can a bed not pass? Each answer is a proof, with the width that is missing.
"""

from pathlib import Path

import cfree
from cfree.plot import plot_audit, plot_reach

# %%
# A plan and machines
# -------------------
#
# The plan is drawn in SVG; the machines are outlines. Walls are filled shapes, and doors the gaps between them.

plans = (Path("examples") if Path("examples").exists() else Path("..")) / "plans"
machines = {}
for name in ("bed", "wheelchair"):
    machines[name] = [shape.polygon for shape in cfree.load_shapes(plans / f"{name}.geojson").of("robot")]
plan = cfree.load_shapes(plans / "clinic.svg").scene(robot=machines["bed"])
print(plan)

# %%
# Doors
# -----
#
# They are found: narrow places with wider floor on both sides. A point of a room gives it a name.

result = cfree.audit(plan, machines, places={"ward": (2, -2), "hall": (7, -5)})
for door in result.doors:
    print(door)
figure = plot_audit(result)

# %%
# A proof
# -------
#
# A closed surface of contacts parts the two rooms in the configuration space. Other code checks it.

door = result.blocked[0]
print(cfree.verify.answer(result.machines["bed"], door.proofs[0]).verdict)

page = cfree.viewer.page(result.machines["bed"], door.proofs[0])

# %%
# Wide enough, and yet blocked
# ----------------------------
#
# One of the doors is wider than the bed. The hall is too narrow to turn into it: how wide would it have to be?

print(cfree.smallest_aisle(machines["bed"], "bay", opening="1.0"))

# %%
# Reach
# -----
#
# The bed starts in the hall; yellow places are reached at all orientations.

reached = cfree.reach(plan, [(7, -5, 0)])
figure = plot_reach(reached).figure
print("room to turn round in the hall:", reached.turning.intersects(result.rooms["hall"].buffer(-0.01)))
