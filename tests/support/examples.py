"""The example scenes: all of them, and those of polygons, which every function takes."""

from __future__ import annotations

from pathlib import Path

FOLDER = Path(__file__).parents[2] / "examples" / "scenes"
EXAMPLES = sorted(FOLDER.glob("*.json"))
POLYGONS = [path for path in EXAMPLES if not path.stem.startswith("round_")]  # a test holds them to their names
