"""Every value in files of its own kind: one file a format, their faults collected, and where in the text they are."""
