"""
Park a car
==========

A car drives ahead and back in arcs, never sideways. Its path ends exactly in the bay, or there is a proof that no
path leads there.
"""

from fractions import Fraction
from pathlib import Path

import cfree

# %%
# A car
# -----
#
# The middle of the rear axle is 1.25 m behind the middle of this car, and its turning radius is 3 m: both are in the
# file of the scene, with the distance of its axles. ``cfree.Car.with_wheelbase`` takes the greatest steering angle.

examples = Path("examples") if Path("examples").exists() else Path("..")
scene = cfree.load_scene(examples / "scenes/parking_bay.json")
print(scene.vehicle)
print(f"{float(cfree.Car.with_wheelbase('2.5', '40deg').turning_radius):.3f} m")

# %%
# A path with gears
# -----------------
#
# Each part of a path is a line or an arc in one gear. All numbers are exact rationals, and each motion is proved free
# as a whole.

path = cfree.plan(scene, improve=3.0)
print(path.cusps, "changes of direction")
for part in path.driving[:3]:
    print(part.gear, f"{part.length:.2f} m, curvature {part.curvature:.3f} / m")
print("free:", path.is_free(cfree.MotionChecker(scene)), "- drivable:", bool(cfree.is_drivable(path, scene.vehicle)))

# %%
# Blue is ahead, orange back; dots are changes of direction. Front wheels have the angle of the motion that follows.

figure = path.plot(scene)

# %%
# Drag the goal, or the middle of the narrowest arc, which changes the turning radius:

page = cfree.viewer.page(scene, path)

# %%
# In space the path changes its gear at sharp corners: there the car stands.

figure = path.plot(scene, cfree.boundary(scene))

# %%
# Costs choose among paths. Here a metre back costs as much as four ahead, and a change of direction 10 m.

fewer = cfree.plan(scene, preferences=cfree.Preferences(backward=4, cusp=10), improve=3.0)
back = sum(part.length for part in fewer.driving if part.gear == "backward")
print(f"{fewer.cusps} changes of direction, {back:.2f} m back")

# %%
# A differential drive turns in place about its axle point: those are the larger dots.

drive = cfree.DifferentialDrive(axle=("-1.25", 0))
turning = cfree.plan(scene, vehicle=drive, improve=1.0)
figure = turning.plot(scene)

# %%
# Too large
# ---------
#
# Up to which size does the car get into the bay? A larger one fits the bay, and the lane, but cannot turn from one
# into the other. That is proved for every motion, so for every vehicle: the surface around the goal is closed.

print(cfree.max_scale(scene))
factor = Fraction("1.14")
robot = [[(factor * x, factor * y) for x, y in part.exact_vertices] for part in scene.robot]
larger = cfree.Scene(robot, scene.obstacles, workspace=scene.workspace, start=scene.start, goal=scene.goal, units="m")
proof = cfree.plan(larger, vehicle=scene.vehicle)
print(proof)
figure = proof.plot(larger)

# %%
# Stuck
# -----
#
# Another car stands right behind, and one in front, so near that both touch. Contacts are decided exactly: no motion
# leads away, of any length and at any steering angle.

wall = [[(2, -1), (6, -1), (6, 1), (2, 1)], [(-6, -1), (-2, -1), (-2, 1), (-6, 1)]]
car = [(-2, -1), (2, -1), (2, 1), (-2, 1)]
row = cfree.Scene(car, wall, start=(0, 0, 0), goal=(0, 4, 0), vehicle=cfree.Car(4, axle=(-1, 0)), units="m")
held = cfree.plan(row)
print(held.sentence())
figure = held.plot(row)

# %%
# Second opinions
# ---------------
#
# Other exact code checks all three answers, that the car can drive the path included.

for answer, its in ((path, scene), (proof, larger), (held, row)):
    print(cfree.verify.answer(its, answer).verdict)
