"""The free space: its cells, and which of them a pose is in."""
