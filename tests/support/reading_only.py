"""The beginning of a program in which all of the core is missing but what reads scenes."""

READING_ONLY = """
import sys, types
import cfree
from cfree import _core
kept = types.ModuleType("cfree._core")
for name in ("Polygon", "SceneFeatures", "range_fault", "read_radians"):
    setattr(kept, name, getattr(_core, name))
sys.modules["cfree._core"] = cfree._core = kept
"""
