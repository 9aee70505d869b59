"""Files of shapes from other programs: drawings, maps, geometry, robots, nesting; one file a format."""
