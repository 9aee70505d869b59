"""No-fit polygons at all orientations: slices, events, and changes of topology."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
import shapely

import cfree
from cfree import Curved, Polygon
from cfree.curves import Arc
from cfree.nesting import NFP, RotationalNFP, nfp

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
SLOT = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (3, 2), (3, 3), (0, 3)]
PLATE = Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(2, 2), (2, 5), (6, 2)]])
TRIANGLE = [(0, 0), (2, 0), (0, 2)]


@pytest.mark.parametrize("degrees", range(5, 360, 35))
def test_a_slice_is_the_no_fit_polygon(degrees: int) -> None:
    turning = RotationalNFP(PLATE, TRIANGLE)
    exact = turning.nfp(f"{degrees}deg")
    cut = turning.slice(f"{degrees}deg").forbidden
    assert exact == nfp(PLATE, TRIANGLE, f"{degrees}deg")
    assert shapely.symmetric_difference(cut, exact.to_shapely()).area < 1e-9


def test_polygons_at_many_angles_are_those_of_the_slices() -> None:
    angles = [0, "45deg", *(math.radians(k + 0.5) for k in range(0, 360, 7)), {"tau": "1/3"}]
    far = [Polygon([(x, 0), (x + 1, 0), (x, 1)]) for x in (0, 9)]  # two regions
    disc = Curved.circle((0, 0), 1)
    for fixed, moving in ((PLATE, TRIANGLE), (SLOT, SQUARE), (far, SQUARE), (PLATE, disc)):
        turning = RotationalNFP(fixed, moving)
        regions = turning.polygons(angles)
        assert len(regions) == len(angles) and all(map(shapely.is_valid, regions))
        for theta, region in zip(angles, regions, strict=True):
            assert shapely.equals_exact(region.normalize(), turning.slice(theta).forbidden.normalize())
    assert {part.geom_type for part in RotationalNFP(far, SQUARE).polygons(angles)} == {"MultiPolygon"}
    assert {len(part.interiors) for part in RotationalNFP(PLATE, TRIANGLE).polygons(angles)} == {0, 1}
    assert RotationalNFP(PLATE, TRIANGLE).polygons([]) == []


def test_events_are_all_angles_of_parallel_edges_and_more() -> None:
    events = {round(math.degrees(event.theta), 6) for event in RotationalNFP(SLOT, SQUARE).events}
    assert events == {0, 90, 180, 270}


def test_topology_changes_where_the_part_begins_to_fit_into_the_hole() -> None:
    turning = RotationalNFP(PLATE, TRIANGLE)
    changes = turning.topology_changes
    assert changes
    for change in changes:
        for turn, expected in ((-1e-6, change.before), (1e-6, change.after)):
            fit = turning.nfp(change.angle.theta + turn)
            assert isinstance(fit, NFP)
            signs = [_area(ring) > 0 for ring in fit.rings]
            assert (sum(signs), len(signs) - sum(signs)) == expected


def _area(ring: object) -> float:
    assert isinstance(ring, tuple)
    return float(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:] + ring[:1], strict=True)))


def test_exact_fits_are_events_of_the_topology() -> None:
    turning = RotationalNFP(SLOT, SQUARE)
    assert [change.exact_fits for change in turning.topology_changes] == [1, 1, 1, 1]
    assert [fit.tolist() for fit in turning.exact_fits(0.0)] == [[[1, 1], [3, 1]]]
    assert not turning.exact_fits(0.1)


def test_rings_of_round_parts_change_at_events_alone() -> None:
    """By polygons near two discs and a stadium, 4 degrees apart: gaps open and close four times in a turn."""
    ends = [Arc((2, "1/2"), center=(2, 0)), Arc((0, "-1/2"), center=(0, 0))]
    stadium = Curved([(0, "-1/2"), (2, "-1/2"), ends[0], (0, "1/2"), ends[1]])
    turning = RotationalNFP([Curved.circle((0, 0), 1), Curved.circle(("7/2", 0), 1)], stadium)
    assert turning.slice(0.3).error < 1e-3
    changes = turning.topology_changes
    assert {change.angle.theta for change in changes} <= {event.theta for event in turning.events}
    rough = cfree.boundary(turning.boundary.scene.outer(1e-4))
    degrees = np.arange(1, 364, 4)
    rings = [rough.slice(math.radians(k)).forbidden for k in degrees]
    counts = [len(getattr(region, "geoms", [region])) for region in rings]
    assert len(changes) == sum(a != b for a, b in pairwise(counts)) == 4
    for change, k in zip(changes, np.flatnonzero(np.diff(counts)), strict=True):
        assert math.radians(degrees[k]) < change.angle.theta < math.radians(degrees[k + 1])
        assert (change.before[0], change.after[0]) == (counts[k], counts[k + 1])


def test_two_discs_have_no_events() -> None:
    assert not RotationalNFP(SQUARE, SQUARE).topology_changes
