"""Facts about the scenes in `cases`, and their update.

python tests/support/expected.py                    list differences from the files
python tests/support/expected.py --write            fill in facts that the files lack
python tests/support/expected.py --write --force    replace facts that differ; review the difference
"""

from __future__ import annotations

import argparse
import json
import re
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from cfree import Boundary, boundary, load_scene
from cfree.forbidden.kinds import KINDS, PatchKind
from compared import plain_of
from exact_slices import area, ends, exact_slice
from shapes import PlainScene

CASES = Path(__file__).parents[1] / "cases"


def cases() -> list[Path]:
    """All scene files."""
    return sorted(CASES.rglob("*.json"))


def half_tangent(text: str) -> Fraction | None:
    return None if text == "inf" else Fraction(text)


def topology(result: Boundary) -> dict[str, Any]:
    """Facts that no motion, scaling or mirroring of a scene changes."""
    kinds = result.isolated.kind
    return {
        "patches": result.stats.patches,
        "live_surfaces": live_surfaces(result),
        "euler": sorted(result.complex.euler.tolist()),
        "isolated": {kind: int((kinds == k).sum()) for k, kind in enumerate(("curve", "segment", "point"), 1)},
    }


def live_surfaces(result: Boundary) -> dict[str, int]:
    """Surfaces with a live patch, by kind; the patch that owns a piece shared by several may depend on the axes."""
    live = np.unique(result.trapezoids.patch)
    kind, i, j = (
        column[live].astype(np.uint64)
        for column in (result.contact_kind, result.contact_robot, result.contact_obstacle)
    )
    codes = kind << np.uint64(61) | i << np.uint64(31) | j
    codes = result.features.core.named(codes)
    surfaces = {
        (KINDS[PatchKind(kind)], code) for kind, code in zip(result.patch_kind[live], codes.tolist(), strict=True)
    }
    return {name: sum(kind == name for kind, _ in surfaces) for name in KINDS.values() if name != "arc-arc"}


def slice_facts(plain: PlainScene, tau: str) -> dict[str, Any]:
    """Facts of the exact slice: maximal oriented segments, slits and isolated points of the free part, area.

    The area is that of the forbidden part, if it is bounded, else minus that of the free part.
    """
    exact = exact_slice(plain, half_tangent(tau))
    return {
        "tau": tau,
        "segments": len(ends(exact.segments)),
        "slits": len(ends(exact.slits)) // 2,
        "points": len(exact.points),
        "area": float(area(exact.segments)),
    }


def facts(path: Path) -> dict[str, Any]:
    """The `check` of a case as it should be."""
    scene = load_scene(path)
    result, plain = boundary(scene, threads=1), plain_of(scene)
    slices = [slice_facts(plain, entry["tau"]) for entry in scene.check["slices"]]
    return {**topology(result), "live_patches": result.stats.live_patches, "slices": slices}


def text_of(check: dict[str, Any]) -> str:
    """Facts in JSON, a slice a line."""
    slices = ",\n".join("    " + json.dumps(entry) for entry in check["slices"])
    return json.dumps({**check, "slices": []}).replace('"slices": []', f'"slices": [\n{slices}\n  ]')


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--force", action="store_true")
    options = parser.parse_args()
    differing = 0
    for path in cases():
        text, known = path.read_text(), load_scene(path).check
        current = facts(path)
        if known == current:
            continue
        is_new = set(known) == {"slices"} and all(set(entry) == {"tau"} for entry in known["slices"])
        if options.write and (is_new or options.force):
            path.write_text(re.sub(r'"check": .*', "", text, flags=re.DOTALL) + f'"check": {text_of(current)}\n}}\n')
            print(f"{path.relative_to(CASES)}: written")
        else:
            differing += 1
            print(f"{path.relative_to(CASES)}: {'has no facts yet' if is_new else 'differs'}\n  {known}\n  {current}")
    return int(differing > 0)


if __name__ == "__main__":
    sys.exit(main())
