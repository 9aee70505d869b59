"""Questions about a scene: margins, bottlenecks, fits, orientations at a position."""
