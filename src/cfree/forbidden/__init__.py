"""The boundary of the forbidden space: trimmed contact patches, their complex, slices and meshes."""
