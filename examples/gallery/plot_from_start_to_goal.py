"""
From start to goal
==================

Can the robot get there? A path of motions that are proved free, or a proof that there is none.
"""

import cfree

# %%
# A scene
# -------
#
# A table, a wall with a door, and the room around them. Any coordinates will do: integers, floats, fractions, "1/3".
# The table is turned by 20 degrees at the end.

table = [(-1, "-0.4"), (1, "-0.4"), (1, "0.4"), (-1, "0.4")]
door = "0.9"
wall = [
    [(-4, "-0.1"), (-1, "-0.1"), (-1, "0.1"), (-4, "0.1")],
    [("-0.1", "-0.1"), (4, "-0.1"), (4, "0.1"), ("-0.1", "0.1")],
]
room = [(-4, -3), (4, -3), (4, 3), (-4, 3)]
start, goal = cfree.Pose(-2, 2), cfree.Pose(2, -2, "20deg")
scene = cfree.Scene(table, wall, workspace=room, start=start, goal=goal, units="m", name="through the door")

# %%
# A path
# ------
#
# The door is 0.9 m wide, the table 0.8: it has to go through sideways. Each motion is a translation, or a rotation
# about a pole, and free as a whole: that is decided exactly, without steps.

path = cfree.plan(scene)
print(path)
print(path.motions[0])
print("free:", path.is_free(cfree.MotionChecker(scene)))

# %%
# The path keeps a distance where there is room. ``objective="clear"`` keeps as far from obstacles as possible;
# ``narrowest`` lists the narrow places, with certified distances.

clear = cfree.plan(scene, objective="clear", improve=1.0)
for place in cfree.narrowest(clear, scene):
    print(f"{place.found:.4f} m (certainly {place.least:.4f}) to {scene.obstacle_names[place.obstacle[0]]}")

# %%
# On the left the table along its path, on the right the path among the contact patches: the door is the gap between
# them.

space = cfree.free_space(cfree.boundary(scene))
figure = cfree.plot.picture(clear, scene, space.boundary)

# %%
# Drag the table's goal, the table itself, or make the door narrower: the same core runs in the page.

page = cfree.viewer.page(scene, clear)

# %%
# ``max_scale`` is the largest factor for the table's size, ``max_margin`` the largest clearance of any path:

print("scale", cfree.max_scale(scene, start, goal, tolerance=0.05))
print("margin", cfree.max_margin(scene, start, goal, tolerance=0.05), "m")

# %%
# A proof
# -------
#
# With a table of 0.95 m there is no path. The proof is a closed surface of contacts in the configuration space, with
# start and goal on two sides. "closed" means that not even a motion that touches the door frame leads through.

wide = [(-1, "-0.475"), (1, "-0.475"), (1, "0.475"), (-1, "0.475")]
too_wide = cfree.Scene(wide, wall, workspace=room, start=start, goal=goal, units="m", name="too wide")
proof = cfree.plan(too_wide)
print(proof)
print(cfree.nearest_miss(too_wide, start, goal))
figure = cfree.plot.picture(proof, too_wide)

# %%
# Other exact code checks both answers, as ``cfree verify SCENE ANSWER.json`` does:

for answer, its in ((clear, scene), (proof, too_wide)):
    print(cfree.verify.answer(its, answer).verdict)

# %%
# An exact fit
# ------------
#
# A table exactly as wide as the door gets through: touching is allowed. A table wider by 2e-12 does not.

for width in ("0.45", "0.450000000001"):
    fit = [(-1, f"-{width}"), (1, f"-{width}"), (1, width), (-1, width)]
    print(width, cfree.plan(cfree.Scene(fit, wall, workspace=room), start, goal))

# %%
# At a junction of corridors as wide as a square, the square can only turn while a vertex slides on the floor and an
# edge on a corner. Then the reference point moves on a rational curve, and this motion is decided exactly like the
# others.

corridors = [(-9, 0), (9, 0), (9, 2), (1, 2), (1, 9), (-1, 9), (-1, 2), (-9, 2)]
junction = cfree.Scene([(-1, -1), (1, -1), (1, 1), (-1, 1)], workspace=corridors, name="a T of corridors")
turned = cfree.plan(junction, cfree.Pose(-5, 1), cfree.Pose(5, 1, "90deg"))
for motion in turned.motions:
    print(type(motion).__name__, f"{motion.turn:.4f}")
print(cfree.verify.answer(junction, turned).verdict)
figure = cfree.plot.picture(turned, junction)

# %%
# Many questions
# --------------
#
# The free space of a scene answers many queries: its cells, the cell of each pose, and paths between poses.

print(space, [round(cell.volume, 3) for cell in space.cells])
poses = [cfree.Pose(x, y) for x in (-2, 0, 2) for y in (-2, 2)]
print(space.locate(poses))
for answer in cfree.plan_many(space, [(poses[0], pose) for pose in poses[1:]]):
    print(answer)

# %%
# Other programs read poses from a CSV file, a ROS message or GeoJSON. JSON files hold everything exactly.

print("x, y:", clear.sample(step=0.5).xy[:3].round(3).tolist(), "...")
