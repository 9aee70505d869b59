"""Paths: sequences of motions, their lengths, and their clearance."""
