"""Boundaries, their tables, meshes and slices in files."""
