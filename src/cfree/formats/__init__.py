"""Scene files: one file a format, the collection of their faults, and where in the text they are."""
