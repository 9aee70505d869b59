"""Check the Euler numbers of surfaces by the degree of their Gauss map; see docs/theory/surface-geometry.md."""

from __future__ import annotations

import numpy as np

from cfree.errors import UnsupportedError
from cfree.forbidden.boundary import Boundary
from cfree.geometry.normals import gauss_map
from cfree.verify.result import MEASURED, SKIPPED, Check, Finding

DEGREE = "Gauss map"
SURE = 1e-3  # limit of errors of degrees
NEAR = 0.25  # largest distance of twice a degree from an Euler number, a whole one


def by_degrees(stored: Boundary, matched: list[int] | None = None) -> tuple[Check, list[Finding]]:
    """Compare twice the degree of each surface with its Euler number, and these with those of a second matching."""
    radius = float(np.hypot(*stored.features.robot.xy.T).max(initial=0.0))
    try:
        gauss = gauss_map(stored, angle_scale=radius or 1.0)
    except UnsupportedError as error:
        return Check(DEGREE, SKIPPED, str(error)), []
    if gauss.error.max(initial=0.0) > SURE:
        return Check(DEGREE, SKIPPED, f"doubles leave degrees open by {gauss.error.max():.1e}"), []
    euler, double = stored.complex.euler, 2 * gauss.degree
    findings, off = [], float(np.abs(double - euler).max(initial=0.0))
    if off > NEAR or (matched is not None and sorted(euler.tolist()) != sorted(matched)):
        degrees = ", ".join(f"{x:.3f}" for x in gauss.degree)
        again = "" if matched is None else f", and {matched} as matched here"
        findings.append(Finding(DEGREE, "all surfaces", f"degrees {degrees}; Euler numbers {euler.tolist()}{again}"))
    extent = f"the degree of every surface is half its Euler number, or off by {off / 2:.1e} at most"
    return Check(DEGREE, MEASURED, extent), findings
