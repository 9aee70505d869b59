"""Contacts of a robot and an obstacle: their types, orientations and surfaces (the paper, sections 1 to 3)."""
