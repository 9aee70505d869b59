"""Exact numbers: rationals, orientations, surds, algebraic numbers, poses."""
