"""Scenes: a robot, its obstacles and bounds, and their features as the core takes them."""
