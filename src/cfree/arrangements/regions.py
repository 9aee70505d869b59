"""Slices of an arrangement as regions of the plane."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from cfree.arguments import checked
from cfree.arrangements.arranged import ON_SURFACE, Arrangement
from cfree.exact.half_angle import Angle
from cfree.exact.pose import Pose

if TYPE_CHECKING:
    from shapely import Polygon
else:
    Polygon = Any  # shapely is imported where it is used


@checked
def planar_cells(whole: Arrangement, theta: Angle) -> list[tuple[Polygon, int]]:
    """Bounded regions of a slice, each with the cell that contains it.

    Parameters
    ----------
    whole : Arrangement
    theta : float in radians, "30deg" or {"tau": "p/q"}
        Orientation as in `Arrangement.slice`.

    Returns
    -------
    list of (shapely Polygon, int)
        Coordinates are rounded to about 1e-10 of the whole. The cell is decided exactly, at one point of each region.

    Examples
    --------
    >>> from cfree import Scene
    >>> from cfree.arrangements import arrangement
    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> whole = arrangement(Scene(square, [[(0, 0), (2, 0), (2, 1), (0, 1)], [(1, 0), (3, 0), (3, 1), (1, 1)]]))
    >>> sorted((region.area, int(whole.cell_depth[cell])) for region, cell in planar_cells(whole, 0))
    [(2.0, 1), (2.0, 1), (4.0, 2)]
    """
    import shapely

    cut = whole.slice(theta)
    if not len(cut.segments):
        return []
    lines = shapely.multilinestrings(shapely.linestrings(cut.segments))
    x0, y0, x1, y1 = lines.bounds
    joined = shapely.node(shapely.set_precision(lines, 1e-10 * max(x1 - x0, y1 - y0)))
    regions = []
    for region in shapely.get_parts(shapely.polygonize(shapely.get_parts(joined))):
        point = region.representative_point()
        cell = whole.cell(Pose(point.x, point.y, theta))
        if cell != ON_SURFACE:
            regions.append((region, cell))
    return regions
