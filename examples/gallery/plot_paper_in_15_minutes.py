"""
The paper in 15 minutes
=======================

D. Atariah and G. Rote give the boundary of the forbidden space of one convex robot and one convex obstacle an explicit
parameterization. This page walks through their paper, section by section, from two triangles to all contact patches,
and then to a task beyond the paper: many obstacles, exactly.
"""

from collections import Counter

import numpy as np

import cfree
from cfree.figures import draw

# %%
# A robot and a pose (section 1.1)
# --------------------------------
# The robot is a polygon around its reference point, which is the origin of its own coordinates. A pose q = (x, y,
# theta) places it: a_i(q) = r + R(theta) a_i, eq. (3). Numbers are exact: fractions, integers, or doubles as they are.

robot = cfree.Polygon([(-1, "-1/2"), (1, "-1/2"), (0, 1)])
obstacle = cfree.Polygon([(-1, -1), ("3/2", "-1/2"), (0, "3/2")])

pose = cfree.Pose(3, 1, "30deg")
print(pose.apply(robot.vertices).round(3))
figure = draw(1)

# %%
# An angle whose half has a rational tangent turns rational points into rational points (the paper's rational model).

pose = cfree.Pose(3, 1, {"tau": "1/2"})
print(pose.apply_exact(robot.exact_vertices))

# %%
# Contact and pseudo contact (section 1.2)
# ----------------------------------------
# Boundaries meet. If the interiors do not, it is a contact: free, because the forbidden space is open. If they do, it
# is a pseudo contact. A contact type names the features that meet, and nothing about the interiors.

figure = draw(2)

# %%
# There are four types. Vertices on edges (v-e) and edges on vertices (e-v) make patches, vertices on vertices (v-v) and
# edges on edges (e-e) the curves between them: two triangles have nine of each.

every = [*cfree.contact.contacts(robot, obstacle), *cfree.contact.contact_curves(robot, obstacle)]
print(Counter(type(contact).__name__ for contact in every))

# %%
# Turning about a point: a helix (section 2)
# ------------------------------------------
# Lemma 1: the poses that keep the robot's point a at a point P are q(phi) = (P - R(phi) a, phi), eq. (4).

helix = cfree.contact.rotation_about((3, 0), robot.exact_vertices[0])
q = helix(np.linspace(0, 2 * np.pi, 5))
print(cfree.Poses(q[:, :2], q[:, 2]).apply(robot.vertices)[:, 0].round(6))  # vertex 0 does not move

# %%
# A vertex on an edge: eq. (5)
# ----------------------------
# Let the point P run along an edge: S(t, phi) = (b_j + t E_j - R(phi) a_i, phi). Its rulings are horizontal and all
# parallel, its helices congruent: the surface is developable.

on_edge = cfree.contact.VertexEdge(0, 1)
S = cfree.contact.contact_surface(robot, obstacle, on_edge)
print(S(t=[0, 0.5, 1], phi=0.3).round(4))
figure = draw(7)

# %%
# Only a part of the surface consists of contacts. The vertex's two edges have to leave the obstacle's edge to the
# right. This holds from phi_min on, where E_i lies along the edge, over phi_range = pi - rho_i (section 3.1.1). No
# arccosine is needed: the direction of phi_min is that of (-E_i . E_j, -E_i x E_j).

Phi = cfree.contact.angle_range(robot, obstacle, on_edge)
print(f"phi_min = {np.degrees(Phi.phi_min):.3f} degrees, phi_range = {np.degrees(Phi.phi_range):.3f} degrees")
figure = draw(3)

# %%
# An edge on a vertex: eq. (8)
# ----------------------------
# Now the point of contact runs along the robot's edge: S(t, phi) = (b_j - R(phi) (a_i + t E_i), phi). The rulings turn,
# and the surface is a saddle.

on_vertex = cfree.contact.EdgeVertex(1, 0)
S = cfree.contact.contact_surface(robot, obstacle, on_vertex)
figure = draw(8)

# %%
# Vertices on vertices, edges on edges (section 3.3)
# --------------------------------------------------
# The joints of patches have one dimension: arcs of helices C(phi), and horizontal segments C(t). The segment is longer
# than the edge: t reaches from 0 to 1 + the length of E_i over that of E_j.

print(cfree.contact.edge_edge_range(robot, obstacle, cfree.contact.EdgeEdge(0, 0)))
figure = draw(6)

# %%
# How the surfaces bend (section 4)
# ---------------------------------
# Fundamental forms, Lemma 2: K = -E^2 / v^4 and H = E F / (2 v^3) depend on t only. At the striction point t_* the
# curvature is greatest, and if the line of the robot's edge goes through the reference point, the surface is minimal:
# a helicoid (Lemma 3).

t = np.linspace(0, 1, 5)
at = cfree.geometry.local_geometry(S.ruled, t, phi=0.0)
print("K", at.gaussian_curvature.round(4))
print("H", at.mean_curvature.round(4))
print("t_*", cfree.geometry.striction_parameter(S), "minimal:", cfree.geometry.is_minimal(S))
figure = draw(10)

# %%
# Figure 9: all patches of two triangles
# --------------------------------------
# A pillar: red where a vertex of the robot touches an edge, green where an edge touches a vertex, blue helices, yellow
# segments. Inside, the robot overlaps the obstacle.

figure = draw(9)

# %%
# The same from a scene. `boundary` trims every patch by all obstacles; here there is one, and nothing is cut away. Its
# pieces are glued into one closed surface, a torus, as the angle goes round.

scene = cfree.Scene(robot, [obstacle])
boundary = cfree.boundary(scene)
print(boundary, "Euler number", boundary.complex.euler)

# %%
# Beyond the paper: many obstacles
# --------------------------------
# Pillars that overlap trim each other. Every sign in the trimming of a patch is exact.

scene = cfree.Scene(
    robot=[(-0.7, -0.5), (0.9, -0.4), (-0.2, 0.9)],
    obstacles=[
        [(1.2, 5.2), (3.6, 4.6), (3.1, 7.4)],
        [(2.2, 1.1), (4.3, 0.8), (4.8, 2.6), (2.6, 3.1)],
        [(5.3, 4), (6.7, 3.5), (7.8, 4.6), (7.2, 6), (5.7, 5.9)],
        [(8, 0.9), (9.5, 0.6), (10.6, 1.7), (10.2, 3.1), (8.8, 3.5), (7.7, 2.4)],
    ],
    bounds=(0, 0, 12, 9),
)
boundary = cfree.boundary(scene)
print(boundary, {rung: getattr(boundary.stats, f"decided_{rung}") for rung in ("by_identity", "by_filter", "exactly")})
figure = cfree.plot.plot_overview(boundary)

# %%
# The same scene to drag things in: the robot stops where it touches, and the page names the contact.

page = cfree.viewer.page(scene)

# %%
# A slice at any orientation is a look-up.

cut = boundary.slice("30deg")
figure = cfree.plot.plot_slice(cut).figure
print(cut, cut.forbidden.area)

# %%
# The rational model (section 5)
# ------------------------------
# With tau = tan(theta / 2) the surface is a rational function, and a contact can be tested with ==.

exact = cfree.rational.rational_surface(robot, obstacle, on_vertex)
x, y, tau = exact.point("1/3", "2/5")
a = [(2 * p + q) / 3 for p, q in zip(*robot.exact_vertices[1:], strict=True)]  # a_1 + t E_1 at t = 1/3
(contact,) = cfree.Pose(x, y, {"tau": tau}).apply_exact([a])
print((x, y, tau), contact == obstacle.exact_vertices[0])
figure = cfree.plot.plot_models(robot, obstacle, on_vertex)
