"""Poses among segments and arcs agree with CGAL's sets of circle segments, where it is installed."""

from __future__ import annotations

import pytest

import compared_with_cgal


@pytest.mark.slow
@pytest.mark.skipif(compared_with_cgal.compiler() is None, reason="no compiler that finds CGAL and GMP")
def test_poses_at_rational_orientations_agree_with_cgal() -> None:
    counts = compared_with_cgal.compared(compared_with_cgal.compiled(), count=40)
    assert min(counts["free"], counts["forbidden"]) > 150, counts
