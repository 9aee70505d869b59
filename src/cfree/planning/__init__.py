"""Paths: quick searches first, then walks on the boundary of a cell, and ways through exact fits.

`planner` puts them together; `rrt_connect` joins random poses, `face_graph` and `boundary_walk` follow trapezoids
(`exact_face` is one), `exact_fits` knows poses without room around them. Nothing but a check of
`cfree.collision.motion_checker` says that a motion is free.
"""
