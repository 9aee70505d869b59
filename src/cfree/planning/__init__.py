"""Paths: quick searches first, then walks on the boundary of a cell, and ways through exact fits.

`planner` puts them together; `search` joins random poses, `corridor` and `walk` follow trapezoids (`sheet` is one),
`passages` knows poses without room around them. Nothing but a check of `cfree.motion_check` says that a motion is free.
"""
