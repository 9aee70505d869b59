"""
OMPL, without collisions
========================

Sampling planners test a motion at some of its poses, and may miss a collision between them. `cfree.ompl` gives OMPL a
test of whole motions. The car park is a scene of the benchmark Bench-MR; it comes with a start and a goal.

OMPL is needed: ``pip install 'cfree[ompl]'``.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from ompl import util

import cfree
import cfree.ompl

util.setLogLevel(util.LogLevel.LOG_ERROR)
examples = Path("examples") if Path("examples").exists() else Path("..")
scene = cfree.load_scene(examples / "scenes/benchmr_parking1.json")
setup = cfree.ompl.simple_setup(scene)
print(setup.solve(60.0))
setup.simplifySolution(1.0)

# %%
# The path of OMPL becomes rotations and translations from an exact pose to an exact pose, proved free once more.

path = cfree.ompl.to_path(setup.getSolutionPath(), scene)
print(len(path.motions), "motions, free:", path.is_free(cfree.MotionChecker(scene)))
clearance = cfree.clearance(path, scene)
print(f"at least {clearance.least:.3g} from everything, nearest to obstacle {clearance.obstacle[0]}")

# %%
# The robot along it:

axes = cfree.plot.plot_workspace(scene)
step = max(np.ptp(scene.robot[0].vertices, axis=0)) / 3
for corners in path.sample(step).apply(scene.robot[0].vertices):
    axes.add_patch(plt.Polygon(corners, facecolor="#2a7ab8", alpha=0.12, edgecolor="none"))
places = path.sample(step / 10).xy
axes.plot(*places.T, color="#2a7ab8", linewidth=1.2)
figure = axes.figure

# %%
# The same car park in the page, with the path:

page = cfree.viewer.page(scene, path)
