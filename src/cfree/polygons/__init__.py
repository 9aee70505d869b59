"""Polygons with exact coordinates: read, checked, cut into convex pieces, grown and shrunk."""
