"""Read the text of files: places in JSON, exact numbers, faults; replace files as a whole."""
