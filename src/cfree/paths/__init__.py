"""Paths: motions one after the other, how far the robot goes on them, and how far it stays from everything."""
