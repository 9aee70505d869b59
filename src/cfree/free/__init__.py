"""The free space: its cells, and location of poses in them."""
