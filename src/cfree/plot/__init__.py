"""Pictures: boundaries, paths, answers, and how they are drawn from back to front."""
