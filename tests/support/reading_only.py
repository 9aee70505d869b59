"""The beginning of a program whose core has only the reader of scenes."""

READING_ONLY = """
import sys, types
import cfree
from cfree import _core
kept = types.ModuleType("cfree._core")
for name in ("Polygon", "SceneFeatures", "range_fault", "read_radians"):
    setattr(kept, name, getattr(_core, name))
sys.modules["cfree._core"] = cfree._core = kept
"""
