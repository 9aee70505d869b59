"""Scenes: a robot, its obstacles and bounds, and their features in the core's form."""
